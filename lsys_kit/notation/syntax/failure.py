"""Where a parser could not go on: the place, the text around it, and what it would have taken instead."""

from __future__ import annotations

import re
from dataclasses import dataclass

from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from lsys_kit.errors import ModelSyntaxError, named, printable
from lsys_kit.notation.syntax.text.statements import ARROW
from lsys_kit.notation.syntax.wording import Spelling
from lsys_kit.translation import gettext

TOKEN_NAMES = {
    "ARROW": "an arrow",
    "NAME": "a name",
    "SYMBOL": "a symbol",
    "NUMBER": "a number",
    "LPAR": '"("',
    "RPAR": '")"',
    "COMMA": '","',
    "COLON": '":"',
    "$END": "the end of the line",
    "RANGE": '".."',
    "IN": '"in"',
}
"""What kinds of tokens are called in messages."""


@dataclass(frozen=True)
class ParseFailure:
    """Where the parser could not go on, in the statement between two offsets.

    Attributes
    ----------
    text, source
        The text as mistakes are looked for in it, and as it was typed.
    at, found
        The offset, and the text there: none at the end of the statement.
    accepted
        The kinds of tokens with which it could have gone on.
    spelling
        How the dialect spells what messages quote.
    """

    text: str
    source: str
    start: int
    end: int
    at: int
    found: str
    accepted: frozenset[str]
    spelling: Spelling

    @property
    def statement(self) -> str:
        """The whole statement."""
        return self.text[self.start : self.end]

    @property
    def before(self) -> str:
        """The statement up to the place."""
        return self.text[self.start : self.at].rstrip()

    @property
    def after(self) -> str:
        """The statement from the place on."""
        return self.text[self.at : self.end]

    def error(
        self, message: str, hint: str | None = None, at: int | None = None, length: int | None = None
    ) -> ModelSyntaxError:
        """What is wrong, at the place or at another offset."""
        at = self.at if at is None else at
        return ModelSyntaxError(message, self.source, at, at + (length or max(1, len(self.found))), hint)


def parse_failure(
    unexpected: UnexpectedInput, source: str, text: str, start: int, end: int, spelling: Spelling
) -> ParseFailure:
    """What a parser reports about the statement between two offsets, as a failure."""
    at, found = _unexpected_text(unexpected, source, start, end)
    parser = getattr(unexpected, "interactive_parser", None)
    accepted = frozenset(kind.split("__")[-1] for kind in parser.accepts()) if parser else frozenset()
    return ParseFailure(text, source, start, end, at, found, accepted, spelling)


def _unexpected_text(unexpected: UnexpectedInput, source: str, start: int, end: int) -> tuple[int, str]:
    """The offset of what was not expected and the text there; an arrow is taken whole, wherever in it the parser failed."""
    if isinstance(unexpected, UnexpectedToken) and unexpected.token.type != "$END":
        at, found = unexpected.token.start_pos or 0, str(unexpected.token)
    elif isinstance(unexpected, UnexpectedCharacters):
        at, found = unexpected.pos_in_stream or 0, unexpected.char
    else:
        return end, ""
    for arrow in ARROW.finditer(source, max(start, at - 2), min(end, at + 16)):
        if arrow.start() <= at < arrow.end():
            return arrow.start(), arrow.group()
    return at, found


def unclosed_bracket(text: str, pair: str = "()") -> int | None:
    """The offset of the last opening bracket of a pair, or of several pairs, that is not closed."""
    opened: list[int] = []
    for match in re.finditer(f"[{re.escape(pair)}]", text):
        if match.group() in pair[::2]:
            opened.append(match.start())
        else:
            opened[-1:] = []
    return opened[-1] if opened else None


def quoted(found: str) -> str:
    """A piece of a text, as a message quotes it."""
    return named(found) if len(found) == 1 else f'"{found}"' if len(found) <= 40 else f'"{found[:40]}..."'


def excerpt(text: str) -> str:
    """The beginning of a text, as a hint quotes it."""
    return "".join(map(printable, text[:20]))


def expected_hint(accepted: frozenset[str]) -> str | None:
    """A hint that lists what is possible at the place, if that is not too much."""
    words = [gettext(word) for word in sorted({TOKEN_NAMES[name] for name in accepted if name in TOKEN_NAMES})]
    if not words or len(words) > 4:
        return None
    if len(words) == 1:
        return gettext("Possible here: {one}.", one=words[0])
    return gettext("Possible here: {some} or {last}.", some=", ".join(words[:-1]), last=words[-1])
