"""A statement, word or expression parsed by the grammar of its notation; a failure becomes an error with its place."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from lark import Lark, TextSlice
from lark.exceptions import UnexpectedInput

from lsys_kit.budget import check_budget, current
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.analysis.problems import ProblemFound
from lsys_kit.notation.syntax.diagnostics import diagnose
from lsys_kit.notation.syntax.dialect import Grammar
from lsys_kit.notation.syntax.wording import error_of

_SYNTAX = Path(__file__).parent
"""The folder of `expressions.lark`, which the grammars share."""


def parse(notation: Grammar, rule: str, text: str, start: int, end: int) -> Any:
    """The record of a stretch of a text."""
    check_budget()
    if end - start > current().line:
        raise ModelLimitError(
            f"This line has {end - start:,} characters; the limit is {current().line:,}",
            limit=current().line,
            needed=end - start,
            source=text,
            start=start,
        )
    try:
        return _parser(notation).parse(TextSlice(text, start, end), start=rule)
    except UnexpectedInput as unexpected:
        raise diagnose(unexpected, text, start, end, notation) from None
    except ProblemFound as error:
        raise error_of(error.problem, text, notation.spelling) from None


@cache
def _parser(notation: Grammar) -> Lark:
    return Lark.open(
        str(_SYNTAX.parent / "dialects" / notation.file),
        import_paths=[str(_SYNTAX)],
        parser="lalr",
        start=[*notation.starts],
        maybe_placeholders=False,
        transformer=notation.transformer(),
    )
