"""Fields: what answers the query modules `?E` of open systems (Mech and Prusinkiewicz, 1996).

A field is any object with a method `answer(questions, scene)`. It gets all questions of a word at once, and what is drawn of
the word, and returns a value for each question. What it returns must depend on these alone, so that a word has one successor.
Measured values are rounded, so that no rule depends on the last bits of a sine.

Ready-made are light, shadows, space, water, an outline, and a fixed function of the place: a text names one, as in
`field: light(0.25)`.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import islice
from math import cos, floor, pi, sin
from numbers import Real
from typing import NamedTuple, Protocol

from lsys_kit.arrays import is_array, np
from lsys_kit.budget import check_budget, counted
from lsys_kit.derivation.core.rules import Values, number_from
from lsys_kit.derivation.core.states import States
from lsys_kit.errors import LSystemError, ModelValueError, shown
from lsys_kit.geometry.scene import Floats
from lsys_kit.geometry.turtle.space import Vector
from lsys_kit.notation.model.arithmetic import Value, is_symbolic, reason_of
from lsys_kit.notation.model.expressions import Function, function_of
from lsys_kit.notation.model.fields import PLACE
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.worlds.neighbours import (
    Surroundings,
    around_spheres,
    counts_in_pyramids,
    crossings,
    depths_in_outline,
    least_clearance,
)

DECIMALS = 9
"""The number of decimals to which measured values are rounded."""
_PARTS = 10**DECIMALS
_READ_OFF = 1e6
"""Below, a double times the parts is so exact that the nearest whole number is the one meant."""


def rounded(value: float, arithmetic: str = "exact") -> Value:
    """A measured value, exact to nine decimals; an infinite one stays infinite.

    >>> rounded(0.1 + 0.2), rounded(4.000000000000001), rounded(math.inf)
    (Fraction(3, 10), 4, inf)
    """
    if not math.isfinite(value):
        return value
    nearest = round(value, DECIMALS) + 0.0
    if arithmetic == "float":
        return nearest
    if abs(nearest) >= _READ_OFF:
        return number_from(nearest)
    return int(nearest) if nearest.is_integer() else Fraction(round(nearest * _PARTS), _PARTS)


class Question(NamedTuple):
    """What a query module asks.

    Attributes
    ----------
    place, head
        Where it stands and in which direction the turtle looks there: x to the right, y upwards, z towards the viewer.
    values
        The values that it has, of which the answer takes the place.
    before, after
        The modules beside it in the word, or None at an end.
    """

    place: Vector
    head: Vector
    values: Values
    before: Module | None = None
    after: Module | None = None


class Field(Protocol):
    """Answers query modules `?E`."""

    def answer(self, questions: Sequence[Question], scene: Surroundings, /) -> Iterable[object]:
        """A value for each question, or as many values as the query module has."""


def answered(field: Field, questions: Sequence[Question], scene: Surroundings, arithmetic: str = "exact") -> list[Values]:
    """The values that the query modules have after a field has answered; a single number takes the place of the first.

    >>> import numpy as np
    >>> class Height:
    ...     def answer(self, questions, scene):
    ...         return [question.place[1] for question in questions]
    >>> nothing = Surroundings(np.empty((0, 2, 3)), np.empty((0, 3)), np.empty(0))
    >>> answered(Height(), [Question((0, 2.5, 0), (0, 1, 0), (0, 7))], nothing)
    [(Fraction(5, 2), 7)]
    """
    name = f"The field {type(field).__name__}"
    if isinstance(field, type):
        raise ModelValueError(
            f"{field.__name__} is a class, not a field", hint=f"Give an object of it: field={field.__name__}()."
        )
    if not callable(getattr(field, "answer", None)):
        raise ModelValueError(
            f"A field has a method answer(questions, scene), and {shown(field)} has none",
            hint='A field that a text names stands in the text, as in "field: light".',
        )
    try:
        given = field.answer(questions, scene)
        answers = None if given is None else list(counted(islice(given, len(questions) + 1)))
    except LSystemError:
        raise
    except Exception as fault:
        raise ModelValueError(f"{name} failed with {type(fault).__name__}: {fault}") from fault
    if answers is None:
        raise ModelValueError(f"{name} returned nothing", hint="It must return a value for each question.")
    if len(answers) != len(questions):
        returned = f"more than {len(questions)}" if len(answers) > len(questions) else f"{len(answers)}"
        raise ModelValueError(
            f"{name} returned {returned} values for {len(questions)} questions",
            hint="It must return a value for each question.",
        )
    return [_taken(name, question, answer, arithmetic) for question, answer in zip(questions, answers, strict=True)]


def _taken(name: str, question: Question, answer: object, arithmetic: str) -> Values:
    if isinstance(answer, Real):
        return _number(name, question, answer, arithmetic), *question.values[1:]
    if not (isinstance(answer, Sequence) or is_array(answer)) or isinstance(answer, str):
        raise ModelValueError(f"{name} answered {shown(answer)} at {_at(question)}, which is no number")
    values = list(answer)
    if len(values) != len(question.values):
        raise ModelValueError(
            f"{name} answered {len(values)} values at {_at(question)}, and the module there has {len(question.values)}"
        )
    return tuple(_number(name, question, value, arithmetic) for value in values)


def _number(name: str, question: Question, value: object, arithmetic: str) -> Value:
    if not isinstance(value, Real):
        raise ModelValueError(f"{name} answered {shown(value)} at {_at(question)}, which is no number")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ModelValueError(f"{name} answered {shown(number)} at {_at(question)}, which is no finite number")
    return rounded(number, arithmetic)


def _at(question: Question) -> str:
    return f"({', '.join(f'{coordinate + 0.0:.6g}' for coordinate in question.place)})"


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


def named_field(states: States) -> Field | None:
    """The field that a model names, with the values of its constants; None where it names none.

    >>> from lsys_kit import read
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

    def at_place(function: Function) -> Callable[[Value, Value, Value], Value]:
        return lambda *place: function((*states.constants, *(place[index] for index in which)))

    return Place(*map(at_place, _functions(states, taken)))


def _shaped(states: States, field: Pattern) -> Field:
    try:
        values = [float(function(tuple(states.constants))) for function in _functions(states)]
    except (ArithmeticError, ValueError) as fault:
        raise ModelValueError(f"The field {field} has no value: {reason_of(fault)}") from None
    return _NAMED[field.symbol](*values)


def _functions(states: States, coordinates: Sequence[str] = ()) -> list[Function]:
    """The values of the field that a model names, as functions of its constants, perhaps of coordinates too."""
    order = {name: index for index, name in enumerate([*_names(states), *coordinates])}
    return [function_of(argument, order) for argument in states.system.field.arguments] if states.system.field else []


def _names(states: States) -> list[str]:
    return [constant.name for constant in states.system.constants]


def _places(questions: Sequence[Question]) -> Floats:
    return np.array([question.place for question in questions], np.float64).reshape(-1, 3)
