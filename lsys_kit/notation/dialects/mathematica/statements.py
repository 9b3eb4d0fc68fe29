"""A text in Mathematica's notation cut into statements: they end at a ";", or at a line end outside all brackets."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.syntax.text.statements import ARROW

DEEPEST = 3
"""How deep comments may be nested."""
_STRING = r'"(?:[^"\\\n]|\\.)*+(?:"|\\?(?=\n|\Z))'
"""What is quoted, to the end of the line where the quotation is never closed."""


def _comment(depth: int) -> str:
    """The pattern of a comment with others in it."""
    inner = rf"|{_comment(depth - 1)}" if depth > 1 else ""
    return rf"\(\*(?:[^*(]++|\*(?!\))|\((?!\*){inner})*+\*\)"


_COMMENTS = re.compile(rf"{_STRING}|{_comment(DEEPEST)}|\(\*|\*\)")
_CUT = re.compile(rf"{_STRING}|[\[({{]|[\])}}]|(?<!/);|\s+")
_CONTINUES = re.compile(r"(:?=|&&|\|\||[,+*^<:]|(?<![-/])/|(?<!-)-|/;)$")
_CONTINUATION = re.compile(rf"{ARROW.pattern}|:?=(?!=)|&&|\|\||/;")
_PART = r"(?:(?!\w\s+(?!by\b)\w|\.\.|\bby\b|\*\)|\(\*).)+"
_RANGE = re.compile(rf";[ \t]*\(\*{_PART}\.\.{_PART}\bby\b{_PART}\*\)")
_CONSTANT = re.compile(r"[A-Za-z_]\w*\s*:?=(?!=)")


def statements(text: str) -> Iterator[tuple[int, int]]:
    """The offsets of the statements, without the ";" that ends them; the range of a constant's slider goes with it.

    >>> text = "w = 11; (* 2 .. 15 by 1 *)\\naxiom = AXIOM[\\n  a[1], b];"
    >>> [text[start:end] for start, end in statements(text)]
    ['w = 11; (* 2 .. 15 by 1 *)', 'axiom = AXIOM[\\n  a[1], b]']
    """
    bare = without_nested_comments(text)
    start = 0
    for end in _statement_ends(bare):
        stretch = bare[start:end].strip()
        if stretch:
            first = bare.index(stretch[0], start)
            slider = _RANGE.match(text, end) if _CONSTANT.match(stretch) else None
            yield first, slider.end() if slider else first + len(stretch)
        start = end + 1


def _statement_ends(bare: str) -> Iterator[int]:
    """The offsets of the ";" and line ends at which statements end, and of the end."""
    depth, start = 0, 0
    for match in _CUT.finditer(bare):
        sign = match.group()
        if sign in "[({":
            depth += 1
        elif sign in "])}":
            depth = max(0, depth - 1)
        elif depth == 0 and (sign == ";" or ("\n" in sign and not _continues(bare, start, *match.span()))):
            yield match.start()
            start = match.end()
    yield len(bare)


def _continues(bare: str, begun: int, start: int, end: int) -> bool:
    """Whether a statement continues after the blanks between two offsets, which contain a line end."""
    return start > begun and bool(_CONTINUES.search(bare, max(begun, start - 3), start) or _CONTINUATION.match(bare, end))


def without_nested_comments(text: str) -> str:
    """The text with its comments blanked, every other character in its place.

    >>> without_nested_comments('w = 11; (* a (* wide *) layer *) "(*"')
    'w = 11;                          "(*"'
    """

    def blanked(match: re.Match[str]) -> str:
        found = match.group()
        if found[0] == '"':
            return found
        if len(found) == 2:
            raise _unmatched_comment(text, match.start(), found)
        return re.sub(r"[^\n]", " ", found) if "\n" in found else " " * len(found)

    return _COMMENTS.sub(blanked, text)


def _unmatched_comment(text: str, at: int, sign: str) -> ModelSyntaxError:
    """What is wrong with the sign of a comment that belongs to none."""
    if sign == "*)":
        return ModelSyntaxError("This comment was never opened", text, at, at + 2, 'A comment begins with "(*".')
    depth = 0
    for match in re.finditer(r"\(\*|\*\)", text[at:]):
        depth += 1 if match.group() == "(*" else -1
        if depth > DEEPEST:
            return ModelSyntaxError(f"Comments are nested more than {DEEPEST} deep", text, at + match.start(), at + match.end())
    return ModelSyntaxError("This comment is never closed", text, at, at + 2, 'A comment ends with "*)".')
