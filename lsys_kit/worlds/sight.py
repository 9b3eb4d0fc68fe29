"""What is seen of a word: a turtle in space follows it, and answers what its modules ask (seed 003, globally sensitive growth).

Two kinds of modules ask. A query module gets values that are the turtle's where it stands: `?P(x,y,z)` its position, `?H`, `?U`
and `?L` its heading, its up and its left, with x to the right, y upwards and z towards the viewer (Prusinkiewicz, James and
Mech, Synthetic Topiary, 1994). A module whose rules call a sensitive function gets the number that the function answers there.

What is measured is told to nine decimals: so a place that should be 4 is 4, and no rule is at the mercy of the last bits of a
sine.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from lsys_kit.derivation.core.rules import kind_of, number_from
from lsys_kit.derivation.core.states import QUERIES, States
from lsys_kit.derivation.core.words import Word
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.turtle.commands import initial_step
from lsys_kit.geometry.turtle.interpreter import compile_word
from lsys_kit.geometry.turtle.space import SPACE_ACTS, SpaceTurtle, TurtleFrame, Vector, initial_frame, prepared, strokes_of
from lsys_kit.notation.model.arithmetic import Value, short_text
from lsys_kit.notation.model.system import Module
from lsys_kit.worlds.sensitive_functions import SENSITIVE_FUNCTIONS, Query, Shoots

DECIMALS = 9
"""To so many decimals is told what is measured."""
OFTEN = 4_096
"""After so many modules somebody looks at the clock."""
NO_SHOOT = -1
"""The number of the shoot before the first one."""


class ShootTurtle(SpaceTurtle):
    """A turtle in space that knows for each stroke from which one it grows."""

    __slots__ = ("mothers",)

    def __init__(self, frame: TurtleFrame, step: float) -> None:
        super().__init__(frame, step)
        self.mothers: list[int] = []

    @property
    def shoot(self) -> int:
        """The number of the last stroke on its branch."""
        return NO_SHOOT if self.last is None else self.last

    def go(self, length: float, drawn: bool) -> None:
        if drawn:
            self.mothers.append(self.shoot)
        super().go(length, drawn)


class Standpoint(NamedTuple):
    """Where a module stands that asks: the turtle's position and frame, and the last shoot."""

    at: Vector
    way: TurtleFrame
    shoot: int


@dataclass(frozen=True)
class TurtleObservation:
    """What is seen of a word.

    Attributes
    ----------
    word
        The word, with the values of its query modules filled in.
    shoots
        Its strokes, in space.
    places
        Where the modules stand that ask, by their positions in the word.
    """

    word: Word
    shoots: Shoots
    places: dict[int, Standpoint]
    _known: dict[tuple[object, ...], Value] = field(default_factory=dict, compare=False, repr=False)

    def sees(self, position: int, function: Value, *values: Value) -> Value:
        """What a sensitive function answers to the module at a position; both apices of a fork get one answer.

        Raises
        ------
        ValueError
            There is no such function, or it is not asked with so many values.
        """
        sense = SENSITIVE_FUNCTIONS.get(function)
        if sense is None:
            known = ", ".join(map(str, SENSITIVE_FUNCTIONS))
            raise ValueError(f"function {short_text(function)} is not known; functions are {known}")
        if not sense.least <= len(values) <= sense.most:
            asked = f"{sense.least}" if sense.least == sense.most else f"{sense.least} or {sense.most}"
            raise ValueError(f"function {short_text(function)}, {sense.words}, is asked with {asked} values, not {len(values)}")
        place = self.places[position]
        key = (position if place.shoot == NO_SHOOT else -1, place.shoot, function, *values)
        if key not in self._known:
            answer = sense.answer(self._stand(place), *map(float, values))
            self._known[key] = measured(answer, self.word.states.arithmetic)
        return self._known[key]

    def _stand(self, place: Standpoint) -> Query:
        if place.shoot == NO_SHOOT:
            return Query(self.shoots, (), np.array(place.at), np.array(place.way[0]))
        start, tip = self.shoots.ends[place.shoot]
        length = self.shoots.lengths[place.shoot]
        head = (tip - start) / length if length else np.array(place.way[0])
        return Query(self.shoots, (place.shoot, self.shoots.mothers[place.shoot]), tip, head)


def observe(word: Word, watch: Callable[[], None] = lambda: None) -> TurtleObservation:
    """Look at a word.

    Parameters
    ----------
    word
        The word; interpretation rules are applied first.
    watch
        What looks at the clock now and then, and may raise an error.

    Raises
    ------
    ModelLimitError
        More brackets are open at once than the limit allows.
    ModelValueError
        A value is no number that can be drawn, or a query module asks for more than three.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> print(observe(derive(read("axiom: F(2)[+F(1)?P(0,0)]F(1)?H(0,0,0)"), 0)[0]).word)
    F(2)[+F(1)?P(-1,2)]F(1)?H(0,1,0)
    """
    states, system, numbers = word.states, word.states.system, word.numbers()
    turtle = ShootTurtle(initial_frame(system.turtle, float(system.heading)), initial_step(system))
    told = compile_word(word, SPACE_ACTS, lambda order: prepared(order, float(system.angle))).acts
    asking = _asking(states, told)
    places: dict[int, Standpoint] = {}
    for position, state in enumerate(numbers):
        if position % OFTEN == 0:
            watch()
        if state in asking:
            places[position] = Standpoint(turtle.at, turtle.way, turtle.shoot)
        for act, what in told[state]:
            act(turtle, what)
    for position, place in places.items():
        module = states.modules[numbers[position]]
        if module.symbol in QUERIES and module.arguments:
            numbers[position] = states.number(module.symbol, _answered(module, place, states.arithmetic))
    return TurtleObservation(Word(states, numbers), Shoots(strokes_of(turtle), turtle.mothers), places)


def _asking(states: States, present: Iterable[int]) -> frozenset[int]:
    """The states that ask; all, where decomposition rules look."""
    every = any(rule.looks for rules in states.decomposition.values() for rule in rules)
    return frozenset(state for state in present if every or states.modules[state].symbol in QUERIES
                     or any(rule.looks for rule in states.rules.get(kind_of(states.modules[state]), ())))


def _answered(module: Module, place: Standpoint, arithmetic: str) -> tuple[Value, ...]:
    """The values of a query module."""
    if len(module.arguments) > 3:
        raise ModelValueError(f"{module} asks for more than the three values x, y and z")
    head, left, up, _ = place.way
    x, y, z = {"?P": place.at, "?H": head, "?U": up, "?L": left}[module.symbol]
    return tuple(measured(value, arithmetic) for value in (x, z, -y)[:len(module.arguments)])


def measured(value: float, arithmetic: str = "exact") -> Value:
    """A number as it is told: to nine decimals, and exactly those; what is infinite stays so.

    >>> measured(0.1 + 0.2), measured(4.000000000000001), measured(math.inf)
    (Fraction(3, 10), 4, inf)
    """
    if not math.isfinite(value):
        return value
    told = round(value, DECIMALS) + 0.0
    return told if arithmetic == "float" else number_from(told)
