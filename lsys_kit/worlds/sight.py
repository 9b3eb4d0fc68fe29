"""What the modules of a word see: a turtle in space interprets the word and answers their queries (globally sensitive growth).

Two kinds of modules ask. A query module receives values of the turtle at its place: `?P(x,y,z)` its position, `?H`, `?U` and
`?L` its heading, up and left, with x to the right, y upwards and z towards the viewer (Prusinkiewicz, James and
Mech, Synthetic Topiary, 1994). A module whose rules call a sensitive function receives the value of the function there
(Kurth's lecture slides on GROGRA).

Measured values are rounded to nine decimals: a coordinate that should be 4 is 4, and no rule depends on the last bits of a
sine.

A query module `?E` is answered by a field: one that the caller gives, or else the one that the model names.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget, counted
from lsys_kit.derivation.core.rules import Values, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.traits import QUERIES
from lsys_kit.derivation.core.words import Word
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import SPHERE, Integers, Segments
from lsys_kit.geometry.turtle.commands import initial_step
from lsys_kit.geometry.turtle.space import SPACE_HANDLERS, SpaceTurtle, TurtleFrame, Vector, initial_frame, operand, strokes_of
from lsys_kit.geometry.turtle.turtle import collected_shapes, compile_word
from lsys_kit.notation.model.arithmetic import Value, short_text
from lsys_kit.worlds.fields import Field, Question, answered, named_field, rounded
from lsys_kit.worlds.neighbours import Surroundings
from lsys_kit.worlds.sensitive_functions import NO_SHOOT, SENSITIVE_FUNCTIONS, SensitiveFunction, Shoots, Standpoints

TURTLE_QUERIES = QUERIES - {"?E"}
"""The symbols whose values are the turtle's own."""
MOST_AT_ONCE = 4_096
"""So many modules at most are answered at once; then the budget is looked at."""


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

    def stroke(self, start: Vector, end: Vector, width: float) -> None:
        self.mothers.append(self.shoot)
        super().stroke(start, end, width)


class Standpoint(NamedTuple):
    """Where a module asks: the position and frame of the turtle there, and the last shoot."""

    position: Vector
    frame: TurtleFrame
    shoot: int


class Answers:
    """What a function with some values answers to those who ask, computed when it is first asked for.

    As a rule all modules of a kind ask the same, one after another, but each may have values of its own. So the first is
    answered alone, the next together with the one behind it, and then twice as many each time.
    """

    def __init__(self, standpoints: Standpoints, function: SensitiveFunction, values: Sequence[Value]) -> None:
        self._standpoints, self._function, self._values = standpoints, function, [float(value) for value in values]
        self._found: dict[int, float] = {}
        self._block = 1

    def to(self, asking: int) -> float:
        """The answer to one who asks, by number."""
        if asking not in self._found:
            check_budget()
            block = range(asking, min(asking + self._block, len(self._standpoints)))
            answers = self._function.answer(self._standpoints[block.start : block.stop], *self._values)
            self._found.update(zip(block, answers.tolist(), strict=True))
            self._block = min(2 * self._block, MOST_AT_ONCE)
        return self._found[asking]


@dataclass(frozen=True)
class TurtleObservation:
    """What the modules of a word see.

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

    def sees(self, position: int, function: Value, *values: Value) -> Value:
        """The value of a sensitive function for the module at a position; both apices of a fork get the same."""
        key = (function, *values)
        if key not in self._answers:
            self._answers[key] = Answers(self._standpoints, _sensitive_function(function, values), values)
        return rounded(self._answers[key].to(self._numbers[position]), self.word.states.arithmetic)

    @cached_property
    def _answers(self) -> dict[Values, Answers]:
        return {}

    @cached_property
    def _numbers(self) -> dict[int, int]:
        """For each position that asks the number of its standpoint; modules behind the same shoot have the same."""
        found: dict[tuple[int, int], int] = {}
        return {
            position: found.setdefault((NO_SHOOT, position) if place.shoot == NO_SHOOT else (place.shoot, 0), len(found))
            for position, place in self.places.items()
        }

    @cached_property
    def _standpoints(self) -> Standpoints:
        first = {self._numbers[position]: place for position, place in reversed(self.places.items())}
        places = [first[number] for number in range(len(first))]
        own: Integers = np.array([place.shoot for place in places], np.int64)
        turtles = np.array([(place.position, place.frame[0]) for place in places]).reshape(-1, 2, 3)
        tips, heads = turtles[:, 0].copy(), turtles[:, 1].copy()
        drawn = np.flatnonzero(own != NO_SHOOT)
        start, tips[drawn] = self.shoots.ends[own[drawn]].transpose(1, 0, 2)
        lengths = self.shoots.lengths[own[drawn], None]
        heads[drawn] = np.divide(tips[drawn] - start, lengths, out=heads[drawn], where=lengths > 0)
        return Standpoints(self.shoots, own, self.shoots.mothers[own], tips, heads)


def _sensitive_function(number: Value, values: Sequence[Value]) -> SensitiveFunction:
    sensitive = SENSITIVE_FUNCTIONS.get(number)
    if sensitive is None:
        known = ", ".join(map(str, SENSITIVE_FUNCTIONS))
        raise ValueError(f"function {short_text(number)} is not known; functions are {known}")
    if not sensitive.least <= len(values) <= sensitive.most:
        asked = f"{sensitive.least}" if sensitive.least == sensitive.most else f"{sensitive.least} or {sensitive.most}"
        raise ValueError(f"function {short_text(number)}, {sensitive.words}, takes {asked} values, not {len(values)}")
    return sensitive


def observe(word: Word, field: Field | None = None) -> TurtleObservation:
    """Interpret a word and record what its modules see.

    >>> from lsys_kit import derive, read
    >>> print(observe(derive(read("axiom: F(2)[+F(1)?P(0,0)]F(1)?H(0,0,0)"), 0)[0]).word)
    F(2)[+F(1)?P(-1,2)]F(1)?H(0,1,0)
    >>> print(observe(derive(read("field: place(y/2)\\naxiom: F?E(0)F?E(0)"), 0)[0]).word)
    F?E(0.5)F?E(1)
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
    strokes = strokes_of(turtle)
    found = dict(_query_values(states, numbers, places))
    found.update(_field_values(states, numbers, places, field, lambda: surroundings_of(turtle, strokes)))
    for position, values in found.items():
        numbers[position] = states.number(states.modules[numbers[position]].symbol, values)
    return TurtleObservation(Word(states, numbers), Shoots(strokes, turtle.mothers), places)


def _observing_states(states: States, present: Iterable[int]) -> frozenset[int]:
    """The states whose modules ask; all of them, if a decomposition rule calls a sensitive function."""
    every = any(rule.looks for rules in states.decomposition.values() for rule in rules)
    return frozenset(
        state
        for state in present
        if every
        or states.modules[state].symbol in QUERIES
        or any(rule.looks for rule in states.rules.get(kind_of(states.modules[state]), ()))
    )


def _query_values(states: States, numbers: Sequence[int], places: Mapping[int, Standpoint]) -> Iterator[tuple[int, Values]]:
    """The positions of the query modules that ask the turtle, with the values that they receive."""
    for position, place in places.items():
        module = states.modules[numbers[position]]
        if module.symbol in TURTLE_QUERIES and module.arguments:
            if len(module.arguments) > 3:
                raise ModelValueError(f"{module} asks for more than the three values x, y and z")
            vector = {"?P": place.position, "?H": place.frame[0], "?U": place.frame[2], "?L": place.frame[1]}[module.symbol]
            values = tuple(rounded(value, states.arithmetic) for value in seen_from_the_front(vector))
            yield position, values[: len(module.arguments)]


def _field_values(
    states: States,
    numbers: Sequence[int],
    places: Mapping[int, Standpoint],
    field: Field | None,
    scene: Callable[[], Surroundings],
) -> Iterator[tuple[int, Values]]:
    """The positions of the query modules that ask a field, with the values that they receive."""
    modules = [states.modules[number] for number in numbers]
    asking = [at for at in places if modules[at].symbol == "?E" and modules[at].arguments]
    if not asking:
        return
    field = named_field(states) if field is None else field
    if field is None:
        raise ModelValueError(
            f"Nothing answers {modules[asking[0]]}: the model has no field",
            hint='Name one in the model, as in "field: light", or derive with field=...',
        )
    questions = [
        Question(
            seen_from_the_front(places[at].position),
            seen_from_the_front(places[at].frame[0]),
            modules[at].arguments,
            modules[at - 1] if at else None,
            modules[at + 1] if at + 1 < len(modules) else None,
        )
        for at in asking
    ]
    yield from zip(asking, answered(field, questions, scene(), states.arithmetic), strict=True)


def surroundings_of(turtle: SpaceTurtle, strokes: Segments) -> Surroundings:
    """What a turtle has drawn, as fields see it: x to the right, y upwards, z towards the viewer."""
    _, discs = collected_shapes((), turtle.rounds, lambda points: np.array(points, np.float64).reshape(-1, 3))
    spheres = discs.kinds == SPHERE
    ends, centres = strokes.ends.reshape(-1, 2, 3), discs.centres[spheres]
    to_front = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    return Surroundings(ends @ to_front + 0.0, centres @ to_front + 0.0, discs.radii[spheres])


def seen_from_the_front(vector: Vector) -> Vector:
    """A vector with x to the right, y upwards and z towards the viewer."""
    x, y, z = vector
    return x, z, -y + 0.0
