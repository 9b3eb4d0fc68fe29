"""A cpfg text cut into statements: lines, with the indented lines that go on with them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from heapq import merge

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.syntax.text.statements import ARROW, without_comments

KEPT = re.compile(
    r"^[ \t]*/\*[ \t]*((?:angle|heading|length):[ \t]*-?\d[\d.]*(?:e[+-]?\d+)?(?:/\d+)?"
    r"|cells:[ \t]*(?:ellipses|rectangles)|widths:[ \t]*(?:pixels|units)|colours:[ \t]*(?:natural|symbols))[ \t]*\*/[ \t]*$",
    re.MULTILINE,
)
"""A comment in which a text keeps what cpfg has in other files: `/* angle: 25.7 */`, alone on its line."""
_RANGED = re.compile(r"[ \t]*/\*[ \t]*-?[\d./]+[ \t]+\.\.[ \t]+-?[\d./]+([ \t]+by[ \t]+[\d./]+)?[ \t]*\*/")
"""A comment after a constant that gives the range of its slider."""
_KEYWORD = re.compile(
    r"#[ \t]*(define|undef|include|if\w*|el\w+|endif)\b"
    r"|(lsystem|derivation[ \t]*length|maximum[ \t]+depth|seed|ignore|consider|angle|heading|length|surface)[ \t]*:"
    r"|(productions?|decomposition|homomorphism|interpretation)\b(?![^\n]*[<>])|endlsystem\b",
    re.IGNORECASE,
)
_PHASE = re.compile(r"(start|end)[ \t]*+(each)?[ \t]*+:", re.IGNORECASE)
_AXIOM_START = re.compile(r"axiom[ \t]*:", re.IGNORECASE)
_BEGIN = re.compile(r"lsystem[ \t]*:", re.IGNORECASE)
_END = re.compile(r"endlsystem\b", re.IGNORECASE)


@dataclass(frozen=True)
class _Line:
    """A line without its comments: where it begins and ends, apart from blanks, and how far it is indented."""

    start: int
    end: int
    text: str
    indent: int


def statements(text: str) -> Iterator[tuple[int, int]]:
    r"""The offsets of the statements.

    A production or an axiom continues on the lines below that are indented further; a line with an arrow of its own continues
    only a statement without one. Statements that run around the steps end with their braces. `//` begins a comment at the
    beginning of a line and after a setting or a condition; in a word it is two rolls.

    >>> text = "Axiom: F//F\nF : 1 // always\n    --> FF\n// the end"
    >>> [text[start:end] for start, end in statements(text)]
    ['Axiom: F//F', 'F : 1 // always\n    --> FF']
    """
    begun = ended = False
    for start, end in merge(_cut(text), (match.span(1) for match in KEPT.finditer(text))):
        begins = _BEGIN.match(text, start) is not None
        if begins and begun:
            raise ModelSyntaxError("A second L-system begins here", text, start, end, "The kit has no L-systems inside others.")
        if ended:
            raise ModelSyntaxError(
                'This comes after "endlsystem"',
                text,
                start,
                end,
                'An L-system ends there: put "endlsystem" last, or leave it out.',
            )
        begun, ended = begun or begins, _END.match(text, start) is not None
        yield start, end


def _cut(text: str) -> Iterator[tuple[int, int]]:
    """The offsets of statements without comments."""
    first: _Line | None = None
    end, has_arrow, depth = 0, False, 0
    for line in _nonblank_lines(text):
        inside = depth > 0
        if inside or _PHASE.match(line.text):
            depth = max(0, depth + line.text.count("{") - line.text.count("}"))
        if first is not None and not inside and not _continues(line, first, has_arrow):
            yield first.start, end
            first = None
        if line.text.startswith("//") and (first is None or line.text[2:3].isspace()):
            continue
        if first is None:
            first, has_arrow = line, _AXIOM_START.match(line.text) is not None
        end, has_arrow = line.end, has_arrow or ARROW.search(line.text) is not None
    if first is not None:
        yield first.start, end


def _continues(line: _Line, first: _Line, has_arrow: bool) -> bool:
    """Whether a line continues a statement that begins with another; an axiom counts as having its arrow."""
    if _KEYWORD.match(first.text) or _KEYWORD.match(line.text) or _AXIOM_START.match(line.text):
        return False
    if ARROW.match(line.text):
        return not _AXIOM_START.match(first.text)
    return line.indent > first.indent and not (has_arrow and ARROW.search(line.text))


def _nonblank_lines(text: str) -> Iterator[_Line]:
    """The lines that are not blank, without comments after settings."""
    for found in re.finditer(r"[^\n]+", without_comments(text)):
        line, content = found.group(), found.group().strip()
        if not content:
            continue
        blank = line[: len(line) - len(line.lstrip())]
        start = found.start() + len(blank)
        if _KEYWORD.match(content):
            content = content.split("//")[0].rstrip()
        ranged = _RANGED.match(text, start + len(content)) if content.startswith("#") else None
        yield _Line(start, ranged.end() if ranged else start + len(content), content, len(blank.expandtabs()))
