r"""What print puts around productions, and takes out of their line, reduced to lines of plain text.

An article sets its productions in an array or in aligned equations, several on a line apart by `\quad`, with the number of the
equation behind them, and a web page sets symbols in bold type; a book, a lesson or an article has a heading, a sentence or a
title over them; Mathematica prints subscripts on a line of their own, below the letters that they belong to. What says nothing
to a reader of productions becomes a blank, and where one production ends and the next begins, a new line.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise, zip_longest
from typing import NamedTuple

from lsys_kit.notation.syntax.text.statements import ARROW, LABEL, OMEGA, blank_parentheses
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, edited

MACRO = re.compile(
    r"\\(?:(?:long)?(?:rightarrow|mapsto)|to(?![A-Za-z])|xrightarrow|omega|vec|overleftarrow|overrightarrow|"
    r"begin[ \t]*+\{)"
)
_DOLLARS = re.compile(r"^[ \t]*+(\$)(?![\s<$])[^$\n]*+(\$)[,.;]?[ \t]*+$", re.MULTILINE)
"""What begins and ends a formula. A single "$" is a command of the turtle, unless the line begins and ends with one."""
_DISPLAY = re.compile(r"^[ \t]*+(?:(\\[\[(])(?:.*(\\[\])]))?|(\\[\])]))[ \t]*+$|(\$\$)", re.MULTILINE)
"""The same among macros; a bracket is one alone on a line, or both on one, and no branch after a roll."""
_ENVIRONMENT = re.compile(
    r"\\begin[ \t]*+\{(array|align(?:ed|at)?\*?|eqnarray\*?|gather(?:ed)?\*?|split|tabular)\}(?:[ \t]*+\{[^{}\n]*+\})?"
    r"(?P<rows>.*?)(?P<end>\\end[ \t]*+\{\1\}|\Z)",
    re.DOTALL,
)
_ROW_END = re.compile(r"\\\\(?:\[[^\[\]\n]*+\])?")
_NUMBER = r"[ \t]*+\(\d+[a-z]?\)(?=[ \t]*+(?:$|\$\$|\\\]|\\\\|\\end))"
_NUMBERED = re.compile(rf"\\q?quad{_NUMBER}|\\tag\*?[ \t]*+\{{[^{{}}\n]*+\}}", re.MULTILINE)
"""The number of an equation."""
_SPACE = rf"\\q?quad\b(?!{_NUMBER})|\\[,;!]"
_GAP = re.compile(_SPACE, re.MULTILINE)
_GAP_IN_ROW = re.compile(rf"{_SPACE}|(?<![\\&])&(?!&)", re.MULTILINE)
"""Between the columns of an array there may be a "&", which is a command of the turtle elsewhere."""
_ACCENT = re.compile(r"\\(bar|overline|hat|tilde|dot)[ \t]*+(?:\{[ \t]*+([A-Za-z]\w*)[ \t]*+\}|([A-Za-z]))")
_STRONG = re.compile(r"(\*\*)(?=\S)[^*\n]*+(?<=\S)(\*\*)")
_FENCE = re.compile(r"^[ \t]*+```\w*[ \t]*+$", re.MULTILINE)
_LINE = re.compile(r"[^\n]+")
_LINE_END = re.compile(r"\\\\[ \t]*+$", re.MULTILINE)
_ITEM = re.compile(r"^[ \t]*+((?:[-–*](?![^\n:]*<)|•|\d+[.)]|\(\d+\))[ \t]++)[A-Za-zωδ\\]", re.MULTILINE)
"""An item of a list, with its dash or its number; before a "<" a dash would be a neighbour."""
_BEGINS = re.compile(rf"[\s,]*+(?:{LABEL}[ \t]*+:|{OMEGA}[ \t]*+[:=])")
"""What begins a statement: a label, or the name of the axiom."""


def typesetting(plain: str) -> Iterator[Edit]:
    r"""The edits that reduce typeset productions to lines of plain text.

    >>> [*typesetting("**A** -> B")]
    [Edit(start=0, end=2, text=''), Edit(start=3, end=5, text='')]
    """
    for match in _STRONG.finditer(plain):
        yield from (Edit(match.start(group), match.end(group), "") for group in (1, 2))
    for match in _FENCE.finditer(plain):
        yield Edit(*match.span(), "")
    yield from formula_signs(plain)
    yield from _items(plain)
    if MACRO.search(plain):
        yield from _latex(plain)


def formula_signs(plain: str) -> Iterator[Edit]:
    """The edits that take the signs off lines that are formulas.

    >>> [*formula_signs("$A -> B$")]
    [Edit(start=0, end=1, text=''), Edit(start=7, end=8, text='')]
    """
    for match in _DOLLARS.finditer(plain):
        yield from (Edit(match.start(group), match.end(group), "") for group in (1, 2))


def _items(plain: str) -> Iterator[Edit]:
    """The dashes or numbers of a list, if every production is an item of it."""
    items = [*_ITEM.finditer(plain)]
    if not items:
        return
    rules = {line.start() for line in _LINE.finditer(plain) if ARROW.search(plain, *line.span())}
    if rules and rules.issubset(item.start() for item in items):
        yield from (Edit(*item.span(1), "") for item in items)


def _latex(plain: str) -> Iterator[Edit]:
    """Macros of LaTeX that say nothing, or put something over a letter; elsewhere a backslash is a roll."""
    for match in _DISPLAY.finditer(plain):
        yield from (Edit(match.start(group), match.end(group), "") for group in (1, 2, 3, 4) if match[group])
    for match in _NUMBERED.finditer(plain):
        yield Edit(*match.span(), "")
    for match in _ACCENT.finditer(plain):
        yield Edit(*match.span(), f"{match[2] or match[3]}_{'bar' if match[1] == 'overline' else match[1]} ")
    at = 0
    for match in _ENVIRONMENT.finditer(plain):
        yield from _lines(plain, at, match.start())
        yield Edit(match.start(), match.start("rows"), "\n")
        row = match.start("rows")
        for end in _ROW_END.finditer(plain, row, match.end("rows")):
            yield from _row(plain, row, end.start())
            yield Edit(*end.span(), "\n")
            row = end.end()
        yield from _row(plain, row, match.end("rows"))
        yield Edit(match.start("end"), match.end("end"), "\n")
        at = match.end()
    yield from _lines(plain, at, len(plain))


def _lines(plain: str, start: int, end: int) -> Iterator[Edit]:
    for line in _LINE.finditer(plain, start, end):
        stop = _LINE_END.search(plain, *line.span())
        yield from _row(plain, line.start(), stop.start() if stop else line.end(), _GAP)
        if stop:
            yield Edit(stop.start(), line.end(), "")


def _row(plain: str, start: int, end: int, gap_sign: re.Pattern[str] = _GAP_IN_ROW) -> Iterator[Edit]:
    """The gaps of a row: a new line where a production is complete and the next one begins, otherwise a blank."""
    gaps = [*gap_sign.finditer(plain, start, end)]
    last = _cell(plain, start, gaps[0].start() if gaps else end)
    arrow, complete = last.arrow, last.successor
    for gap, following in zip_longest(gaps, gaps[1:]):
        cell = _cell(plain, gap.end(), following.start() if following else end)
        new = cell.named or (complete and cell.predecessor)
        yield Edit(gap.start(), gap.end(), "\n" if new else " ")
        complete = cell.successor or (not new and (complete or (arrow and cell.filled)))
        arrow = cell.arrow or (arrow and not new)


class _Cell(NamedTuple):
    """What stands between two gaps: whether there is anything, a label, an arrow, and something before and behind the arrow."""

    filled: bool
    named: bool
    arrow: bool
    predecessor: bool
    successor: bool


def _cell(plain: str, start: int, end: int) -> _Cell:
    text = plain[start:end]
    arrow = ARROW.search(text)
    before, behind = (text[: arrow.start()], text[arrow.end() :]) if arrow else ("", "")
    return _Cell(*map(bool, (text.strip(), _BEGINS.match(text), arrow, before.strip(), behind.strip())))


HEADING = (
    r"(?:example|beispiel|figure|fig\.?|abbildung|abb\.?|l-system|listing|exercise|aufgabe|table|tabelle)[ \t]*+"
    r"\d[\d.]*+[ \t]*+[a-z]?[ \t]*+[:.)]?[ \t]*+"
)
SENTENCE = r"[A-ZÄÖÜ][a-zäöüß]*+(?:,?[ \t]++(?:[A-Za-zÄÖÜäöüß'’-]{2,}|a|I))+[.:!][ \t]*+"
"""Several words, of which none but "a" and "I" has one letter, with a full stop or a colon behind them."""
RULES = r"(?:(?:rewriting |production )?rules|(?:produktions)?regeln|produktionen)\b(?![ \t]*+(?:=(?!=)|[(<>]))"
_PRINTED = re.compile(
    rf"^[ \t]*+(?:(?P<rules>(?i:{RULES})[ \t]*+(?::|(?!{ARROW.pattern})))|(?:(?i:{HEADING})|{SENTENCE})$)", re.MULTILINE
)
_AND = re.compile(r"(?<![ \t])(?:[ \t]*+,)?[ \t]++(?:and|und)[ \t]++")


def headings(plain: str, notes: list[str]) -> Iterator[Edit]:
    """The edits that take out what is printed before the first production and says nothing about it.

    >>> notes = []
    >>> [*headings("Example 2\\naxiom: I", notes)], notes
    ([Edit(start=0, end=9, text='')], ['"Example 2" is passed over.'])
    """
    arrow = ARROW.search(plain)
    until = _line_end(plain, arrow.start()) if arrow else len(plain)
    for match in _PRINTED.finditer(plain, 0, until):
        if match["rules"]:
            yield Edit(*match.span("rules"), "")
            yield from _joined(plain, match.end(), _line_end(plain, match.end()))
        else:
            notes.append(f'"{match.group().strip()}" is passed over.')
            yield Edit(match.start(), match.start() + len(match.group().rstrip()), "")


def _line_end(plain: str, at: int) -> int:
    """Where a line ends that holds an offset."""
    end = plain.find("\n", at)
    return end if end >= 0 else len(plain)


def _joined(plain: str, first: int, end: int) -> Iterator[Edit]:
    """Productions joined by "and"."""
    for word in _AND.finditer(plain, first, end):
        if ARROW.search(plain, first, word.start()) and ARROW.search(plain, word.end(), end):
            yield Edit(*word.span(), "\n")


def without_headings(source: str) -> Transcript:
    """A text without what is printed around its system.

    >>> without_headings("Example 3\\nHere is another plant:\\nI -> I[A]").text
    '\\n\\nI -> I[A]'
    """
    notes: list[str] = []
    return edited(source, headings(source, notes), notes)


_ROW_OF_SIGNS = r"[ \t]++[A-Za-z0-9](?:[ \t]++[A-Za-z0-9])*+[ \t]*+"
_SUBSCRIPTS = re.compile(_ROW_OF_SIGNS)
LINE_OF_SUBSCRIPTS = re.compile(rf"\n{_ROW_OF_SIGNS}(?:\n|\Z)")
"""What a text with subscripts has."""
_LETTER = re.compile(r"(?<![\w\\])[A-Za-z](?!\w)")
_AXIOM = re.compile(r"[ \t]*+(?:axiom|start\w*|ω|\\omega)\b", re.IGNORECASE)
_BRACKETS = str.maketrans("[]", "()")


def subscripts(plain: str, joint: str, values: str = "()") -> Iterator[Edit]:
    """The edits that put each subscript behind its letter, the first behind the first.

    Parameters
    ----------
    plain
        The text without its comments.
    joint
        What stands between a letter and its subscript in a name.
    values
        The brackets around values.

    Examples
    --------
    >>> [*subscripts("a -> b\\n r    l", "_")]
    [Edit(start=1, end=1, text='_r '), Edit(start=6, end=6, text='_l '), Edit(start=7, end=14, text='')]
    """
    if not LINE_OF_SUBSCRIPTS.search(f"\n{plain}"):
        return
    lines = [match for match in re.finditer(r"[^\n]+", plain) if not match.group().isspace()]
    for above, below in pairwise(lines):
        names = above.group()
        if not _SUBSCRIPTS.fullmatch(below.group()) or not (ARROW.search(names) or _AXIOM.match(names)):
            continue
        letters = [*_LETTER.finditer(blank_parentheses(names.translate(_BRACKETS) if values == "[]" else names))]
        found = below.group().split()
        if len(letters) == len(found):
            for letter, subscript in zip(letters, found, strict=True):
                yield Edit(above.start() + letter.end(), above.start() + letter.end(), f"{joint}{subscript} ")
            yield Edit(*below.span(), "")
