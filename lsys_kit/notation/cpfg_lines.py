"""A cpfg text cut into statements: lines, with the indented lines that go on with them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from heapq import merge

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.statements import ARROW, without_comments

KEPT = re.compile(
    r"^[ \t]*/\*[ \t]*((?:angle|heading|length):[ \t]*-?\d[\d.]*(?:e[+-]?\d+)?(?:/\d+)?)[ \t]*\*/[ \t]*$", re.MULTILINE)
"""A comment in which a text keeps what cpfg has in another file: `/* angle: 25.7 */`, alone on its line."""
_RANGED = re.compile(r"[ \t]*/\*[ \t]*-?[\d./]+[ \t]+\.\.[ \t]+-?[\d./]+([ \t]+by[ \t]+[\d./]+)?[ \t]*\*/")
"""A comment behind a constant that is the range of its slider."""
_KEYWORD = re.compile(
    r"#[ \t]*(define|undef|include|if\w*|el\w+|endif)\b|(lsystem|derivation[ \t]*length|maximum[ \t]+depth|seed|ignore|consider"
    r"|angle|heading|length)[ \t]*:|(productions?|decomposition|homomorphism|interpretation)\b(?![^\n]*[<>])|endlsystem\b",
    re.IGNORECASE)
_AXIOM = re.compile(r"axiom[ \t]*:", re.IGNORECASE)
_BEGIN = re.compile(r"lsystem[ \t]*:", re.IGNORECASE)
_END = re.compile(r"endlsystem\b", re.IGNORECASE)


@dataclass(frozen=True)
class _Line:
    """A line without its comments: where it begins and ends, apart from blanks, and whether it stands to the right."""

    start: int
    end: int
    text: str
    indented: bool


def statements(text: str) -> Iterator[tuple[int, int]]:
    r"""The offsets of the statements.

    A production or an axiom goes on over the indented lines below; but a line with an arrow of its own goes on only with what
    has none. `//` begins a comment at the beginning of a line and behind a setting or a condition; in a word it is two rolls.

    >>> text = "Axiom: F//F\nF : 1 // always\n    --> FF\n// the end"
    >>> [text[start:end] for start, end in statements(text)]
    ['Axiom: F//F', 'F : 1 // always\n    --> FF']
    """
    begun = ended = False
    for start, end in merge(_cut(text), (match.span(1) for match in KEPT.finditer(text))):
        begins = _BEGIN.match(text, start) is not None
        if begins and begun:
            raise ModelSyntaxError("A second L-system begins here", text, start, end, "The kit has none inside another.")
        if ended:
            raise ModelSyntaxError('This stands behind "endlsystem"', text, start, end,
                                   'An L-system ends there: put "endlsystem" last, or leave it out.')
        begun, ended = begun or begins, _END.match(text, start) is not None
        yield start, end


def _cut(text: str) -> Iterator[tuple[int, int]]:
    """The offsets of what is no comment."""
    open_: list[_Line] = []
    for line in _lines(text):
        if open_ and not _goes_on(line, open_):
            yield open_[0].start, open_[-1].end
            open_ = []
        if line.text.startswith("//") and (not open_ or line.text[2:3].isspace()):
            continue
        open_.append(line)
    if open_:
        yield open_[0].start, open_[-1].end


def _lines(text: str) -> Iterator[_Line]:
    """The lines in which something stands, without a comment behind a setting."""
    bare = without_comments(text)
    lines = [(match.start(), match.group()) for match in re.finditer(r"[^\n]+", bare) if match.group().strip()]
    base = min((len(line) - len(line.lstrip()) for _, line in lines if not line.lstrip().startswith("//")), default=0)
    for offset, line in lines:
        indent = len(line) - len(line.lstrip())
        said = line.strip()
        if _KEYWORD.match(said):
            said = said.split("//")[0].rstrip()
        ranged = _RANGED.match(text, offset + indent + len(said)) if said.startswith("#") else None
        yield _Line(offset + indent, ranged.end() if ranged else offset + indent + len(said), said, indent > base)


def _goes_on(line: _Line, before: list[_Line]) -> bool:
    """Whether a line goes on with the lines of a statement before it."""
    first = before[0].text
    if _KEYWORD.match(first) or _KEYWORD.match(line.text) or _AXIOM.match(line.text):
        return False
    if ARROW.match(line.text):
        return not _AXIOM.match(first)
    has_arrow = _AXIOM.match(first) or any(ARROW.search(earlier.text) for earlier in before)
    return line.indented and not (has_arrow and ARROW.search(line.text))
