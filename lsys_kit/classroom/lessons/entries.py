"""What is typed into a cell of a table: a number in any of its usual forms, or a short text; and whether it is right.

Pages without a kernel read it in the same way: `lessons/checking.js` of the panel's scripts.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction
from math import prod

MOST_CHARACTERS = 200
"""Longer entries are not looked at."""
_NUMBER = re.compile(r"([+-]?(?=\.?\d)\d{0,30}(?:\.\d{1,30})?)(?:/(\d{1,30}))?(%?)", re.ASCII)
_PRODUCT = re.compile(r"\d{1,9}(?:\^\d{1,2})?(?:[*·×]\d{1,9}(?:\^\d{1,2})?){0,9}", re.ASCII)
_SIGNS = str.maketrans({"−": "-", "–": "-"})
_SMALL_FRACTION = re.compile(r"(?<![\d.,])[¼-¾⅐-⅞]")
_OTHER_FORMS = (
    (re.compile(r"[+-]?\d{1,3}(?:[,']\d{3})+(?:\.\d+)?", re.ASCII), {",": "", "'": ""}),
    (re.compile(r"[+-]?\d{1,3}(?:\.\d{3})+(?:,\d+)?", re.ASCII), {".": "", ",": "."}),
    (re.compile(r"\A[+-]?\d*,\d+%?", re.ASCII), {",": "."}),
)
"""Numbers with marks between thousands, or with a decimal comma, and what is put in place of their marks."""
_BEFORE = re.compile(r".*[=≈~]|(?:about|approx\.?|ca\.?)(?=\s)", re.IGNORECASE | re.DOTALL)
_NOUNS = re.compile(r"(?<!\s)\s*+(?:(?<![^\W\d_])[^\W\d_]++|°)(?:\s++[^\W\d_]++){0,9}$")
_NOUN = re.compile(r"[^\W\d_]+|°")
_SHORT: Mapping[str, str] = {
    **dict.fromkeys(("y", "j", "ja"), "yes"),
    **dict.fromkeys(("n", "nein"), "no"),
    **dict.fromkeys(("l", "links"), "left"),
    **dict.fromkeys(("r", "rechts"), "right"),
}
"""What else is typed for the few words of which a cell may ask for one."""


def number_of(text: str) -> Fraction | None:
    """The number that a text is, or None: a whole number, a decimal, a fraction, a percentage, a product of powers.

    >>> number_of("3/4"), number_of(" 0.75 "), number_of("75 %"), number_of("¾"), number_of("al br")
    (Fraction(3, 4), Fraction(3, 4), Fraction(3, 4), Fraction(3, 4), None)
    >>> number_of("5^3"), number_of("3 · 4"), number_of("1/0")
    (Fraction(125, 1), Fraction(12, 1), None)
    """
    plain = _bare(text)
    if _PRODUCT.fullmatch(plain):
        powers = (factor.partition("^") for factor in re.split("[*·×]", plain))
        return Fraction(prod(int(base) ** int(power or 1) for base, _, power in powers))
    found = _NUMBER.fullmatch(plain)
    if not found or (found[2] and not int(found[2])):
        return None
    return Fraction(found[1]) / int(found[2] or 1) / (100 if found[3] else 1)


def _bare(text: str) -> str:
    """A text without blanks, with the minus sign and the fractions of a keyboard."""
    signs = "".join(text.split()).translate(_SIGNS)
    return _SMALL_FRACTION.sub(lambda found: unicodedata.normalize("NFKC", found[0]).replace("⁄", "/"), signs)


def nouns_in(*texts: str) -> frozenset[str]:
    """The nouns, among other words, by which some texts say what is counted; they may stand behind a number."""
    return frozenset(_singular(word) for text in texts for word in _NOUN.findall(text)) | {"°"}


def _singular(word: str) -> str:
    return word.lower().removesuffix("s")


def readings(entry: str, nouns: Collection[str] = ()) -> tuple[Fraction, ...]:
    """The numbers that an entry may mean; some nouns may stand behind it.

    A comma or a point may part thousands, or be the decimal one. A percentage may be a number of hundredths.

    >>> [str(each) for each in readings("2.500")], [str(each) for each in readings("20 %")]
    (['5/2', '2500'], ['1/5', '20'])
    >>> readings("N = 5 cells", ["cell"]), readings("5 walls", ["cell"])
    ((Fraction(5, 1),), ())
    """
    if len(entry) > MOST_CHARACTERS:
        return ()
    return tuple(dict.fromkeys(_numbers(_bare(_alone(entry, nouns)))))


def _alone(entry: str, nouns: Collection[str]) -> str:
    """An entry without what may stand before a number, and behind it."""
    text = entry.strip()
    before = _BEFORE.match(text)
    text = text[before.end() :] if before else text
    behind = _NOUNS.search(text)
    if behind and all(_singular(word) in nouns for word in _NOUN.findall(behind[0])):
        return text[: behind.start()]
    return text


def _numbers(plain: str) -> Iterator[Fraction]:
    texts = [plain, plain.removesuffix("%")]
    for form, marks in _OTHER_FORMS:
        if form.fullmatch(plain):
            other = "".join(marks.get(sign, sign) for sign in plain)
            texts += [other, other.removesuffix("%")]
    for text in texts:
        if (number := number_of(text)) is not None:
            yield number


def is_right(entry: str, right: Sequence[str], within: str = "0", nouns: Collection[str] = ()) -> bool:
    """Whether an entry is one of the right answers, up to blanks and capitals; numbers may be off by a given distance.

    >>> is_right("0.5", ["1/2"]), is_right("10,946", ["10946"]), is_right("1,618", ["1.6180"]), is_right("AL  br", ["al br"])
    (True, True, True, True)
    >>> is_right("1.62", ["1.618"]), is_right("1.62", ["1.618"], within="0.01"), is_right("21 cells", ["21"], "0", ["cell"])
    (False, True, True)
    >>> is_right("2.500", ["2500"]), is_right("20%", ["20"]), is_right("20%", ["0.2"]), is_right("y", ["yes"])
    (True, True, True, True)
    """
    if len(entry) > MOST_CHARACTERS:
        return False
    near, typed, numbers = number_of(within) or 0, _word(entry), readings(entry, nouns)
    return any(
        typed == _word(each) or any(abs(number - wanted) <= near for wanted in _wanted(each) for number in numbers)
        for each in right
    )


def _word(text: str) -> str:
    word = "".join(text.split()).casefold()
    return _SHORT.get(word, word)


def _wanted(text: str) -> Iterator[Fraction]:
    if (number := number_of(text)) is not None:
        yield number


def is_number_asked(right: Sequence[str]) -> bool:
    """Whether a cell asks for a number.

    >>> is_number_asked(["3", "three", "all"]), is_number_asked(["never", "none"])
    (True, False)
    """
    return any(number_of(each) is not None for each in right)
