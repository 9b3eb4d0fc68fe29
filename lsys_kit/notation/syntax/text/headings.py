"""What a book, a lesson or an article prints around a system: a heading, a sentence, a title over the productions."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsys_kit.notation.syntax.text.statements import ARROW
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, edited

HEADING = (r"(?:example|beispiel|figure|fig\.?|abbildung|abb\.?|l-system|listing|exercise|aufgabe|table|tabelle)[ \t]*+"
           r"\d[\d.]*+[ \t]*+[a-z]?[ \t]*+[:.)]?[ \t]*+")
_HEADING = re.compile(rf"[ \t]*+{HEADING}", re.IGNORECASE)
SENTENCE = r"[A-ZÄÖÜ][a-zäöüß]*+(?:,?[ \t]++(?:[A-Za-zÄÖÜäöüß'’-]{2,}|a|I))+[.:!][ \t]*+"
"""Several words, of which none but "a" and "I" has one letter, with a full stop or a colon behind them."""
_SENTENCE = re.compile(rf"[ \t]*+{SENTENCE}")
RULES = r"(?:(?:rewriting |production )?rules|(?:produktions)?regeln|produktionen)\b(?![ \t]*+(?:=(?!=)|[(<>]))"
_RULES = re.compile(rf"[ \t]*+({RULES}[ \t]*+(:?))", re.IGNORECASE)
_AND = re.compile(r"(?:[ \t]*+,)?[ \t]++(?:and|und)[ \t]++")


def headings(plain: str, notes: list[str]) -> Iterator[Edit]:
    """The edits that take out what is printed before the first production and says nothing about it.

    >>> notes = []
    >>> [*headings("Example 2\\naxiom: I", notes)], notes
    ([Edit(start=0, end=9, text='')], ['"Example 2" is passed over.'])
    """
    for match in re.finditer(r"[^\n]+", plain):
        line, start = match.group(), match.start()
        rules = _RULES.match(line)
        if rules and (rules[2] or rules.end() == len(line.rstrip()) or not ARROW.match(line, rules.end())):
            yield Edit(start + rules.start(1), start + rules.end(1), "")
            yield from _joined(line, start, rules.end())
        elif _HEADING.fullmatch(line) or _SENTENCE.fullmatch(line):
            notes.append(f'"{line.strip()}" is passed over.')
            yield Edit(start, start + len(line.rstrip()), "")
        if ARROW.search(line):
            break


def _joined(line: str, start: int, first: int) -> Iterator[Edit]:
    """Productions joined by "and"."""
    for word in _AND.finditer(line, first):
        if ARROW.search(line, first, word.start()) and ARROW.search(line, word.end()):
            yield Edit(start + word.start(), start + word.end(), "\n")


def without_headings(source: str) -> Transcript:
    """A text without what is printed around its system.

    >>> without_headings("Example 3\\nHere is another plant:\\nI -> I[A]").text
    '\\n\\nI -> I[A]'
    """
    notes: list[str] = []
    return edited(source, headings(source, notes), notes)
