r"""Formats of other programs, which the kit does not read: what gives each away, what the kit lacks, and what to try.

A text is asked whose it is only where its reader has failed, so that no text in one of the kit's notations is ever called
foreign; in formats that are `tried` systems are looked for before. A sign counts at the beginning of any line, outside of
`/* comments */`; the name of a file proves nothing. `foreign.toml` has the formats, and the sources.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import PurePath

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.files import toml_tables
from lsys_kit.notation.syntax.text.statements import without_comments

_BLANKS = r"[ \t]*+"
GLANCE = 50_000
"""So many characters of a text are looked at."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ForeignFormat:
    """A format that the kit knows and does not read: a table of `foreign.toml`, whose keys are explained there."""

    name: str
    signs: Sequence[str]
    lacks: str
    advice: str
    suffixes: Sequence[str] = ()
    beside: str = ""
    tried: bool = False

    @cached_property
    def _patterns(self) -> tuple[re.Pattern[str], re.Pattern[str]]:
        signs = f"^ (?:{'|'.join(self.signs)})".replace(" ", _BLANKS)
        return re.compile(signs, re.MULTILINE | re.IGNORECASE), re.compile(self.beside.replace(" ", _BLANKS), re.MULTILINE)

    def sign_in(self, text: str) -> re.Match[str] | None:
        """What gives this format away in a text."""
        signs, beside = self._patterns
        return signs.search(text) if beside.match(text) else None


@cache
def formats() -> tuple[ForeignFormat, ...]:
    """The formats; a text is in the first one whose sign it has."""
    rows = toml_tables(__package__, "foreign.toml")["format"]
    for row in rows:
        lines = *((line, "=") for line in row.pop("with", ())), *((line, "!") for line in row.pop("without", ()))
        row["beside"] = "".join(rf"(?{sign}(?s:.*?)^ {line})" for line, sign in lines) + row.get("beside", "")
    return tuple(ForeignFormat(**row) for row in rows)


def foreign_format(text: str) -> ModelSyntaxError | None:
    """The error that says whose format a text is in that no reader of the kit could read; None where that is not known.

    >>> print(foreign_format("#lang lindenmayer racket\\n## axiom ##\\nF").message)
    This is a model in Racket's language lindenmayer, which the kit does not read
    """
    return _claim(formats(), text)


def unreadable_format(text: str) -> ModelSyntaxError | None:
    """The same, but for formats in which systems are looked for."""
    return _claim([row for row in formats() if not row.tried], text)


def name_hint(name: str) -> str | None:
    """A hint at the format in which files with such a name often are.

    >>> name_hint("tree.rgg")
    'The name ends in ".rgg": perhaps the file is a model in XL, the language of GroIMP, which the kit does not read.'
    """
    suffix = PurePath(name).suffix.lower()
    found = next((row for row in formats() if suffix in row.suffixes), None)
    return f'The name ends in "{suffix}": perhaps the file is {found.name}, which the kit does not read.' if found else None


def _claim(rows: Iterable[ForeignFormat], text: str) -> ModelSyntaxError | None:
    """The error at the first sign of the first format that has one in a text."""
    plain = _without_comments(text[:GLANCE].replace("\r\n", " \n")) if rows else ""
    for row in rows:
        sign = row.sign_in(plain)
        if sign:
            start = sign.end() - len(sign[0].lstrip())
            return ModelSyntaxError(
                f"This is {row.name}, which the kit does not read", text, start, sign.end(), f"{row.lacks}. {row.advice}"
            )
    return None


def _without_comments(text: str) -> str:
    """A text with its comments blanked, if it has such comments."""
    try:
        return without_comments(text)
    except ModelSyntaxError:
        return text
