"""Numbers that are written as English words."""

from __future__ import annotations

import re

_SMALL = ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve", "thirteen"]
_SMALL += ["fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"]
_TENS = ["twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"]
_VALUES = {
    **{word: number for number, word in enumerate(_SMALL)},
    **{word: 10 * number for number, word in enumerate(_TENS, 2)},
}
_FACTORS = {"hundred": 100, "thousand": 1_000, "million": 1_000_000}
_FIRST = ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth", "eleventh", "twelfth"]
_ORDINALS = {word: number for number, word in enumerate(_FIRST, 1)}
_PARTS = {"half": 2, "halve": 2, "third": 3, "quarter": 4, "fourth": 4, "fifth": 5, "sixth": 6, "eighth": 8, "tenth": 10}
_ANY = "|".join([*_VALUES, *_FACTORS])
_RUN = re.compile(rf"\b(?:{_ANY})(?:(?:[\s-]+(?:and\s+)?)(?:{_ANY}))*\b", re.IGNORECASE)
_PART = re.compile(rf"\b(\d+|a)\s+({'|'.join(_PARTS)})s?\b", re.IGNORECASE)
_ORDINAL = re.compile(rf"\b(?:({'|'.join(_ORDINALS)})|(\d+)(?:st|nd|rd|th))\b", re.IGNORECASE)


def with_digits(text: str) -> str:
    """A text with digits for the numbers that are written as words.

    >>> with_digits("twenty-one cells"), with_digits("seven hundred and nine"), with_digits("three quarters")
    ('21 cells', '709', '3/4')
    >>> with_digits("2, 3 and 5"), with_digits("the third line"), with_digits("19th step")
    ('2, 3 and 5', 'the 3 line', '19 step')
    """
    text = _PART.sub(lambda found: f"{found[1].lower().replace('a', '1')}/{_PARTS[found[2].lower()]}", _RUN.sub(_digits, text))
    return _ORDINAL.sub(lambda found: found[2] or str(_ORDINALS[found[1].lower()]), text)


def _digits(found: re.Match[str]) -> str:
    """The value of a run of words; as it stands where it is none, as "two three"."""
    total = group = 0
    below = 1_000_000_000
    for word in re.split(r"[\s-]+", found[0].lower()):
        if word in _FACTORS:
            factor = _FACTORS[word]
            total, group = (total, max(group, 1) * factor) if factor == 100 else (total + max(group, 1) * factor, 0)
            below = factor
        elif word != "and":
            value = _VALUES[word]
            if value >= below:
                return found[0]
            group += value
            below = 10 if value >= 20 and value < 100 else 1
    return str(total + group)
