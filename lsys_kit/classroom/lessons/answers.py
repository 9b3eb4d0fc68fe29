"""When what was typed into a cell of a table is right: numbers by their value, anything else letter by letter."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from fractions import Fraction

MOST_CHARACTERS = 200
"""Longer entries are not looked at."""
_NUMBER = re.compile(r"([+-]?(?=\.?\d)\d{0,30}(?:\.\d{1,30})?)(?:/(\d{1,30}))?(%?)")
_THOUSANDS = re.compile(r"[+-]?\d{1,3}(,\d{3})+(\.\d+)?")
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+")


def number_of(text: str) -> Fraction | None:
    """The number that a text is, or None: a whole number, a decimal, a fraction, a percentage.

    >>> number_of("3/4"), number_of(" 0.75 "), number_of("75 %"), number_of("al br")
    (Fraction(3, 4), Fraction(3, 4), Fraction(3, 4), None)
    """
    found = _NUMBER.fullmatch(_without_blanks(text).replace("−", "-"))
    if not found or (found[2] and not int(found[2])):
        return None
    return Fraction(found[1]) / int(found[2] or 1) / (100 if found[3] else 1)


def is_right(entry: str, right: Sequence[str], within: str = "0") -> bool:
    """Whether an entry is one of the right answers, up to blanks and capitals; numbers may be off by a given distance.

    A comma may part thousands, or stand for the decimal point.

    >>> is_right("0.5", ["1/2"]), is_right("10,946", ["10946"]), is_right("1,618", ["1.6180"]), is_right("AL  br", ["al br"])
    (True, True, True, True)
    >>> is_right("1.62", ["1.618"]), is_right("1.62", ["1.618"], within="0.01"), is_right("21 cells", ["21"])
    (False, True, False)
    >>> is_right(".9", ["0.9"]), is_right(",9", ["0.9"])
    (True, True)
    """
    if len(entry) > MOST_CHARACTERS:
        return False
    near = number_of(within) or 0
    return any(
        _without_blanks(entry).casefold() == _without_blanks(each).casefold()
        or any(abs(number - wanted) <= near for number in _readings(entry) for wanted in _numbers(each))
        for each in right
    )


def _readings(entry: str) -> Iterator[Fraction]:
    """The numbers that an entry may mean."""
    text = _without_blanks(entry)
    yield from _numbers(text)
    if _THOUSANDS.fullmatch(text):
        yield from _numbers(text.replace(",", ""))
    if _DECIMAL_COMMA.fullmatch(text):
        yield from _numbers(text.replace(",", "."))


def _numbers(text: str) -> Iterator[Fraction]:
    if (number := number_of(text)) is not None:
        yield number


def _without_blanks(text: str) -> str:
    return "".join(text.split())
