"""One statement, word or expression parsed by the grammar of its notation; what went wrong, as an error with its place."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from lark import Lark, TextSlice
from lark.exceptions import UnexpectedInput

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.syntax.actions import Misread
from lsys_kit.notation.syntax.diagnostics import diagnose
from lsys_kit.notation.syntax.dialect import Grammar

_SYNTAX = Path(__file__).parent
"""Where `expressions.lark` stands, which the grammars share."""


def parse(notation: Grammar, rule: str, text: str, start: int, end: int) -> Any:
    """The record of a stretch of a text."""
    if end - start > current().line:
        raise ModelLimitError(f"This line has {end - start:,} characters; the limit is {current().line:,}",
                              limit=current().line, needed=end - start, source=text, start=start)
    try:
        return _parser(notation).parse(TextSlice(text, start, end), start=rule)
    except UnexpectedInput as slip:
        raise diagnose(slip, text, start, end, notation) from None
    except Misread as misread:
        raise misread.kind(misread.message, text, *(misread.at or (None, None)), misread.hint) from None


@cache
def _parser(notation: Grammar) -> Lark:
    return Lark.open(str(_SYNTAX.parent / "dialects" / notation.file), import_paths=[str(_SYNTAX)], parser="lalr",
                     start=[*notation.starts], maybe_placeholders=False, transformer=notation.records())
