"""What a book, a lesson or an article prints around a system: a heading, a sentence, a title over the productions."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsys_kit.notation.syntax.text.statements import ARROW
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, edited

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
