"""The fields that a text can name: what answers the query modules `?E` of open systems (Mech and Prusinkiewicz, 1996).

Here stand their names and the values that they take; what they answer is found where a turtle can look around.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

PLACE = ("x", "y", "z")
"""The coordinates of the place at which a module asks: x to the right, y upwards, z towards the viewer."""


class FieldForm(NamedTuple):
    """A field that a text can name: the least and the greatest number of its values, and the names that they may use besides
    the constants."""

    least: int
    most: int
    names: tuple[str, ...] = ()


FIELD_FORMS: Mapping[str, FieldForm] = {
    "light": FieldForm(0, 1),
    "place": FieldForm(1, 16, PLACE),
    "polygon": FieldForm(6, 64),
    "shadows": FieldForm(0, 4),
    "space": FieldForm(1, 1),
    "water": FieldForm(1, 2),
}
"""The fields, by name."""
