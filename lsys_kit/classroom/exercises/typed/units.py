"""Units of measure that are converted, by all their names."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction

from lsys_kit.notation.model.arithmetic import Value, normalised

_NAMES: Mapping[str, tuple[str, Value]] = {
    "° deg degree degrees grad": ("angle", 1),
    "rad radian radians radiant": ("angle", 180 / math.pi),
    "turn turns revolution revolutions umdrehung umdrehungen": ("angle", 360),
    "% percent prozent": ("share", 1),
    "mm millimetre millimetres millimeter millimeters": ("length", 1),
    "cm centimetre centimetres centimeter centimeters zentimeter": ("length", 10),
    "dm decimetre decimetres decimeter decimeters dezimeter": ("length", 100),
    "m metre metres meter meters": ("length", 1000),
    "km kilometre kilometres kilometer kilometers": ("length", 1_000_000),
}
UNITS: Mapping[str, tuple[str, Value]] = {name: unit for names, unit in _NAMES.items() for name in names.split()}
"""For each name of a unit what it measures, and how much of the first unit of that it is."""
SAME_THING = (
    frozenset(
        (
            "cell",
            "letter",
            "module",
            "symbol",
            "character",
            "char",
            "element",
            "piece",
            "zelle",
            "zellen",
            "buchstabe",
            "buchstaben",
            "modul",
            "symbole",
            "zeichen",
            "elemente",
            "stück",
            "stücke",
        )
    ),
    frozenset(("wall", "edge", "wand", "wände", "kante", "kanten")),
)
"""Words for one thing that is counted: what a word is made of, what a map is made of."""


def converted(number: Value, given: str, wanted: str) -> Value | None:
    """A number in another unit, exactly where the two are in proportion; None where they measure different things.

    >>> converted(2, "dm", "cm"), converted(1, "turn", "degrees"), converted(1, "cm", "degrees")
    (20, 360, None)
    """
    one, other = UNITS.get(given.lower()), UNITS.get(wanted.lower())
    if one is None or other is None or one[0] != other[0]:
        return None
    if one[1] == other[1]:
        return number
    if isinstance(one[1], int) and isinstance(other[1], int):
        return normalised(number * Fraction(one[1], other[1]))
    return float(number) * float(one[1]) / float(other[1])


def names_of(unit: str) -> frozenset[str]:
    """All names of a unit."""
    return next((frozenset(names.split()) for names in _NAMES if unit.lower() in names.split()), frozenset((unit.lower(),)))


def means_the_same(one: str, other: str) -> bool:
    """Whether two nouns stand for the same thing that is counted.

    >>> means_the_same("cells", "letter"), means_the_same("cells", "walls")
    (True, False)
    """
    both = {one.lower().rstrip("s"), other.lower().rstrip("s")}
    return len(both) == 1 or any(both <= group for group in SAME_THING)
