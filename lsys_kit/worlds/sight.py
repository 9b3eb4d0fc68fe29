"""What the modules of a word see: a turtle in space interprets the word and answers their queries (globally sensitive growth).

Two kinds of modules ask. A query module receives values of the turtle at its place: `?P(x,y,z)` its position, `?H`, `?U` and
`?L` its heading, up and left, with x to the right, y upwards and z towards the viewer (Prusinkiewicz, James and
Mech, Synthetic Topiary, 1994). A module whose rules call a sensitive function receives the value of the function there
(Kurth's lecture slides on GROGRA).

Measured values are rounded to nine decimals: a coordinate that should be 4 is 4, and no rule depends on the last bits of a
sine.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from lsys_kit.budget import check_budget, counted
from lsys_kit.derivation.core.rules import kind_of, number_from
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.traits import QUERIES
from lsys_kit.derivation.core.words import Word
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.turtle.commands import initial_step
from lsys_kit.geometry.turtle.interpreter import compile_word
from lsys_kit.geometry.turtle.space import SPACE_HANDLERS, SpaceTurtle, TurtleFrame, Vector, initial_frame, operand, strokes_of
from lsys_kit.notation.model.arithmetic import Value, short_text
from lsys_kit.notation.model.modules import Module
from lsys_kit.worlds.sensitive_functions import SENSITIVE_FUNCTIONS, Query, Shoots

DECIMALS = 9
"""The number of decimals to which measured values are rounded."""
NO_SHOOT = -1
"""The number of the shoot before the first one."""


class ShootTurtle(SpaceTurtle):
    """A turtle in space that records for each stroke its mother, the stroke from which it grows."""

    __slots__ = ("mothers",)

    def __init__(self, frame: TurtleFrame, step: float) -> None:
        super().__init__(frame, step)
        self.mothers: list[int] = []

    @property
    def shoot(self) -> int:
        """The number of the last stroke on its branch."""
        return NO_SHOOT if self.last is None else self.last

    def forward(self, length: float, drawn: bool) -> None:
        if drawn:
            self.mothers.append(self.shoot)
        super().forward(length, drawn)


class Standpoint(NamedTuple):
    """Where a module asks: the position and frame of the turtle there, and the last shoot."""

    position: Vector
    frame: TurtleFrame
    shoot: int


@dataclass(frozen=True)
class TurtleObservation:
    """What the modules of a word see.

    Attributes
    ----------
    word
        The word, with the values of its query modules filled in.
    shoots
        Its strokes, in space.
    places
        The standpoints of the modules that ask, by position in the word.
    """

    word: Word
    shoots: Shoots
    places: dict[int, Standpoint]
    _known: dict[tuple[object, ...], Value] = field(default_factory=dict, compare=False, repr=False)

    def sees(self, position: int, function: Value, *values: Value) -> Value:
        """The value of a sensitive function for the module at a position; both apices of a fork get the same.

        Raises
        ------
        ValueError
            There is no such function, or it takes another number of values.
        """
        sensitive = SENSITIVE_FUNCTIONS.get(function)
        if sensitive is None:
            known = ", ".join(map(str, SENSITIVE_FUNCTIONS))
            raise ValueError(f"function {short_text(function)} is not known; functions are {known}")
        if not sensitive.least <= len(values) <= sensitive.most:
            asked = f"{sensitive.least}" if sensitive.least == sensitive.most else f"{sensitive.least} or {sensitive.most}"
            raise ValueError(f"function {short_text(function)}, {sensitive.words}, takes {asked} values, not {len(values)}")
        place = self.places[position]
        key = (position if place.shoot == NO_SHOOT else -1, place.shoot, function, *values)
        if key not in self._known:
            check_budget()
            answer = sensitive.answer(self._query(place), *map(float, values))
            self._known[key] = rounded(answer, self.word.states.arithmetic)
        return self._known[key]

    def _query(self, place: Standpoint) -> Query:
        if place.shoot == NO_SHOOT:
            return Query(self.shoots, (), np.array(place.position), np.array(place.frame[0]))
        start, tip = self.shoots.ends[place.shoot]
        length = self.shoots.lengths[place.shoot]
        head = (tip - start) / length if length else np.array(place.frame[0])
        return Query(self.shoots, (place.shoot, self.shoots.mothers[place.shoot]), tip, head)


def observe(word: Word) -> TurtleObservation:
    """Interpret a word and record what its modules see.

    Parameters
    ----------
    word
        The word; interpretation rules are applied first.

    Raises
    ------
    ModelLimitError
        More brackets are open at once than the limit allows.
    ModelValueError
        A value is too large to draw, or symbolic; or a query module asks for more than three values.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> print(observe(derive(read("axiom: F(2)[+F(1)?P(0,0)]F(1)?H(0,0,0)"), 0)[0]).word)
    F(2)[+F(1)?P(-1,2)]F(1)?H(0,1,0)
    """
    states, system, numbers = word.states, word.states.system, word.numbers()
    turtle = ShootTurtle(initial_frame(system.turtle, float(system.heading)), initial_step(system))
    calls = compile_word(word, SPACE_HANDLERS, lambda instruction: operand(instruction, float(system.angle))).calls
    asking = _observing_states(states, calls)
    places: dict[int, Standpoint] = {}
    for position, state in enumerate(counted(numbers)):
        if state in asking:
            places[position] = Standpoint(turtle.position, turtle.orientation, turtle.shoot)
        for handler, instruction in calls[state]:
            handler(turtle, instruction)
    for position, place in places.items():
        module = states.modules[numbers[position]]
        if module.symbol in QUERIES and module.arguments:
            numbers[position] = states.number(module.symbol, _query_values(module, place, states.arithmetic))
    return TurtleObservation(Word(states, numbers), Shoots(strokes_of(turtle), turtle.mothers), places)


def _observing_states(states: States, present: Iterable[int]) -> frozenset[int]:
    """The states whose modules ask; all of them, if a decomposition rule calls a sensitive function."""
    every = any(rule.looks for rules in states.decomposition.values() for rule in rules)
    return frozenset(state for state in present if every or states.modules[state].symbol in QUERIES
                     or any(rule.looks for rule in states.rules.get(kind_of(states.modules[state]), ())))


def _query_values(module: Module, place: Standpoint, arithmetic: str) -> tuple[Value, ...]:
    """The values that a query module receives."""
    if len(module.arguments) > 3:
        raise ModelValueError(f"{module} asks for more than the three values x, y and z")
    head, left, up, _ = place.frame
    x, y, z = {"?P": place.position, "?H": head, "?U": up, "?L": left}[module.symbol]
    return tuple(rounded(value, arithmetic) for value in (x, z, -y)[:len(module.arguments)])


def rounded(value: float, arithmetic: str = "exact") -> Value:
    """A measured value, exact to nine decimals; an infinite one stays infinite.

    >>> rounded(0.1 + 0.2), rounded(4.000000000000001), rounded(math.inf)
    (Fraction(3, 10), 4, inf)
    """
    if not math.isfinite(value):
        return value
    nearest = round(value, DECIMALS) + 0.0
    return nearest if arithmetic == "float" else number_from(nearest)
