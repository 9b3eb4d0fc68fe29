"""Ready-made fields: light, shadows, space, water, an outline, and a fixed function of the place.

A text names one, as in `field: light(0.25)`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from math import cos, floor, pi, sin
from typing import Any

import numpy as np

from lsys_kit.budget import check_budget
from lsys_kit.derivation.core.states import States
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import Floats
from lsys_kit.notation.model.arithmetic import Value, is_symbolic, reason_of
from lsys_kit.notation.model.expressions import function_of
from lsys_kit.notation.model.fields import PLACE
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.worlds.fields import Field, Question, Surroundings
from lsys_kit.worlds.neighbours import around_spheres, counts_in_pyramids, crossings, depths_in_outline, least_clearance
from lsys_kit.worlds.rounding import rounded

_SLANT = pi / 4
SKY = (
    (0.2, (0.0, 1.0, 0.0)),
    *(
        (0.1, (sin(_SLANT) * cos(turn), cos(_SLANT), sin(_SLANT) * sin(turn)))
        for turn in (eighth * pi / 4 for eighth in range(8))
    ),
)
"""The directions from which light comes, each with its part: straight from above, and at 45 degrees from eight sides."""

MOST_LAYERS = 64
"""So many layers down at most a shadow reaches."""


class Light:
    """How much light of the sky reaches a place: 1 in the open, less behind each sphere that a ray passes through.

    Chiba's method in the form of the sample objects of the Virtual Laboratory (Calgary). A sphere around the very place is the
    asker's own and does not shade it.

    Parameters
    ----------
    transmittance
        Which part of the light a sphere lets through.
    """

    def __init__(self, transmittance: float = 0.25) -> None:
        if not 0 <= transmittance <= 1:
            raise ModelValueError(f"A sphere lets a part of the light through, from 0 to 1, not {transmittance:g}")
        self.transmittance = transmittance

    def answer(self, questions: Sequence[Question], scene: Surroundings) -> Floats:
        """The part of the light that reaches each place."""
        places, found = _places(questions), np.zeros(len(questions))
        for part, direction in SKY:
            check_budget()
            found += part * self.transmittance ** crossings(places, np.array(direction), scene)
        return found


class Shadows:
    """How much light from above reaches a place: each sphere shades a pyramid of voxels below it, which widens layer by layer.

    The shadow propagation of Palubicki and others, Self-organizing tree models for image synthesis (2009). The voxel of a
    sphere gets the shadow a; those q layers below it, up to q voxels to each side, get a / b^q. What is left of the light is
    1 - s, and at least 0, where shadows add up to s. A sphere around the very place is the asker's own and does not shade it.

    Parameters
    ----------
    size
        How wide a voxel is.
    a, b
        The shadow of a sphere in its own voxel, above 0, and by what it is divided from layer to layer, above 1.
    depth
        How many layers down a shadow reaches.
    """

    def __init__(self, size: float = 1.0, a: float = 0.2, b: float = 2.0, depth: float = 4) -> None:
        if not (size > 0 and a > 0 and b > 1):
            raise ModelValueError(
                f"The field shadows(size, a, b, depth) needs a size above 0, a above 0 and b above 1, "
                f"not {size:g}, {a:g} and {b:g}"
            )
        if depth != floor(depth) or not 0 <= depth <= MOST_LAYERS:
            raise ModelValueError(f"A shadow reaches down a whole number of layers from 0 to {MOST_LAYERS}, not {depth:g}")
        self.size, self.a, self.b, self.depth = size, a, b, int(depth)

    def answer(self, questions: Sequence[Question], scene: Surroundings) -> Floats:
        """The part of the light that reaches each place."""
        places = _places(questions)
        found = 1 + self.a * around_spheres(places, scene)
        for layer, count in enumerate(counts_in_pyramids(places, scene.centres, self.size, self.depth)):
            found -= self.a / self.b**layer * count
        light: Floats = np.maximum(found, 0.0)
        return light


class Space:
    """How far it is from a place to the nearest sphere of another: negative inside it.

    Parameters
    ----------
    reach
        What is farther away is not seen, and the answer is this distance.
    """

    def __init__(self, reach: float) -> None:
        self.reach = reach

    def answer(self, questions: Sequence[Question], scene: Surroundings) -> Floats:
        """The distance from each place."""
        return least_clearance(_places(questions), scene, self.reach)


class Water:
    """Water in a column of soil, below height 0: those who ask in the same layer share what the layer has.

    Parameters
    ----------
    supply
        How much water a layer has in each step.
    thickness
        How thick a layer is.
    """

    def __init__(self, supply: float, thickness: float = 1.0) -> None:
        if not thickness > 0:
            raise ModelValueError(f"A layer of soil has a thickness above 0, not {thickness:g}")
        self.supply, self.thickness = supply, thickness

    def answer(self, questions: Sequence[Question], scene: Surroundings) -> list[float]:
        """The share of each; nothing above the soil."""
        layers = [floor(-float(rounded(question.place[1])) / self.thickness) for question in questions]
        sharing = Counter(layers)
        return [self.supply / sharing[layer] if layer >= 0 else 0.0 for layer in layers]


class Polygon:
    """How far inside an outline in the plane of the picture a place is: negative outside.

    Parameters
    ----------
    coordinates
        Those of its corners, x and y of one after x and y of the other; a side goes from the last to the first.
    """

    def __init__(self, *coordinates: float) -> None:
        if len(coordinates) % 2:
            raise ModelValueError(f"A corner of a polygon has x and y, and {len(coordinates)} values are no whole corners")
        self.corners = np.array(coordinates).reshape(-1, 2)

    def answer(self, questions: Sequence[Question], scene: Surroundings) -> Floats:
        """The distance of each place from the nearest side, negative outside."""
        return depths_in_outline(_places(questions)[:, :2], self.corners)


class Place:
    """A fixed function of the place, whatever grows there.

    Parameters
    ----------
    functions
        One for each value, of x to the right, y upwards and z towards the viewer.
    """

    def __init__(self, *functions: Callable[[Value, Value, Value], Value]) -> None:
        self.functions = functions

    def answer(self, questions: Sequence[Question], scene: Surroundings) -> list[Value | list[Value]]:
        """The values at each place."""
        found = [[function(*map(rounded, question.place)) for function in self.functions] for question in questions]
        return [values[0] if len(values) == 1 else values for values in found]


_NAMED: Mapping[str, Callable[..., Field]] = {
    "light": Light,
    "polygon": Polygon,
    "shadows": Shadows,
    "space": Space,
    "water": Water,
}
"""The fields that are shaped by numbers, by name."""


def named_field(states: States) -> Field | None:
    """The field that a model names, with the values of its constants; None where it names none.

    >>> from lsys_kit.notation.read import read
    >>> named_field(States(read("k = 1/2\\nfield: light(k/2)\\naxiom: A"))).transmittance
    0.25
    """
    field = states.system.field
    if field is None:
        return None
    unknown = [name for name, value in zip(_names(states), states.constants, strict=True) if is_symbolic(value)]
    if unknown:
        raise ModelValueError(f"The field {field} cannot answer while {unknown[0]} is unknown")
    return _place(states) if field.symbol == "place" else _shaped(states, field)


def _place(states: States) -> Place:
    """The function of the place that a model names; a constant that is called like a coordinate is the constant."""
    taken = [name for name in PLACE if name not in _names(states)]
    which = [PLACE.index(name) for name in taken]

    def at_place(function: Callable[[tuple[Any, ...]], Value]) -> Callable[[Value, Value, Value], Value]:
        return lambda *place: function((*states.constants, *(place[index] for index in which)))

    return Place(*map(at_place, _functions(states, taken)))


def _shaped(states: States, field: Pattern) -> Field:
    """A field that is shaped by numbers."""
    try:
        values = [float(function(tuple(states.constants))) for function in _functions(states)]
    except (ArithmeticError, ValueError) as fault:
        raise ModelValueError(f"The field {field} has no value: {reason_of(fault)}") from None
    return _NAMED[field.symbol](*values)


def _functions(states: States, coordinates: Sequence[str] = ()) -> list[Callable[[tuple[Any, ...]], Value]]:
    """The values of the field that a model names, as functions of its constants, perhaps of coordinates too."""
    order = {name: index for index, name in enumerate([*_names(states), *coordinates])}
    return [function_of(argument, order) for argument in states.system.field.arguments] if states.system.field else []


def _names(states: States) -> list[str]:
    return [constant.name for constant in states.system.constants]


def _places(questions: Sequence[Question]) -> Floats:
    return np.array([question.place for question in questions], np.float64).reshape(-1, 3)
