"""The turtle in the plane (seed 001; ABOP, sections 1.3 and 1.6.1).

Drawing goes in two steps. `trace` walks through a word once and notes for each step forward how often the turtle has
turned by the angle, how many degrees it has turned besides, how far it goes, and at the end of which earlier step it starts.
None of this depends on the angle. `place_path` then puts the path into the plane for a given angle; a browser can do that by
itself, without the word and without its rules.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.scene import Floats, Integers, Scene, Segments
from lsys_kit.geometry.turtle.commands import initial_step
from lsys_kit.geometry.turtle.instructions import Instruction
from lsys_kit.geometry.turtle.interpreter import COMMON, Act, Outline, RoundShape, Turtle, run_turtle, shapes_left
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS


@dataclass(frozen=True)
class Path:
    """The steps forward of a turtle, before the angle is known.

    Attributes
    ----------
    turns, offsets
        Shape (n,): the heading is turns * angle + offset, in degrees from the turtle's first heading, to the left.
    lengths
        Shape (n,): how far it goes.
    parents
        Shape (n,): the number of the earlier step at whose end it starts; -1 for the origin.
    drawn
        Shape (n,): whether it leaves a stroke; a step may also lead to the corner of a leaf.
    orders
        Shape (n,): in how many brackets it stands.
    states
        Shape (n,): the state of its module.
    widths, colours
        Shape (n,), as of `Segments`.
    outlines, rounds
        Polygons, circles and discs; their places are numbers of steps, at whose ends they are.
    unknown
        As of `Scene`.
    """

    turns: Floats
    offsets: Floats
    lengths: Floats
    parents: Integers
    drawn: np.ndarray[tuple[int], np.dtype[np.bool_]]
    orders: Integers
    states: Integers
    widths: Floats
    colours: Integers
    outlines: tuple[Outline, ...] = ()
    rounds: tuple[RoundShape, ...] = ()
    unknown: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.turns)


class _Crawler(Turtle):
    """A turtle in the plane: it is at the end of a step, and has turned left by the angle, by degrees, and perhaps over."""

    __slots__ = ("steps",)

    def __init__(self, side: int, step: float) -> None:
        super().__init__(-1, (0.0, 0.0, side), step)
        self.steps: list[tuple[float, float, float, int, bool, int, int, float, int]] = []

    def go(self, length: float, drawn: bool) -> None:
        turns, offset, _ = self.way
        self.at = self.step(turns, offset, length, self.at, drawn)
        if drawn:
            self.last = self.at

    def spot(self, ahead: float, left: float, up: float) -> int:
        turns, offset, side = self.way
        return self.step(turns, offset + side * math.degrees(math.atan2(left, ahead)), math.hypot(ahead, left), self.at)

    def step(self, turns: float, offset: float, length: float, parent: int, drawn: bool = False) -> int:
        """Note a step, and say its number."""
        self.steps.append((turns, offset, length, parent, drawn, len(self.stack), self.state, self.width, self.colour))
        return len(self.steps) - 1


def _turn(turtle: _Crawler, order: Instruction) -> None:
    turns, offset, side = turtle.way
    turtle.way = turns + side * order.factor, offset + side * order.addend, side


def _roll(turtle: _Crawler, order: Instruction) -> None:
    if order.factor == 0 and order.addend % 360 == 180:
        turns, offset, side = turtle.way
        turtle.way = turns, offset, -side


def _back(turtle: _Crawler, order: Instruction) -> None:
    if turtle.last is not None:
        turns, offset, length, parent, *_ = turtle.steps[turtle.last]
        turtle.at = turtle.step(turns, offset, length * (order.factor + order.addend), parent)


_KINDS = {"turns": np.float64, "offsets": np.float64, "lengths": np.float64, "parents": np.int64, "drawn": np.bool_,
          "orders": np.int64, "states": np.int64, "widths": np.float64, "colours": np.int64}
PLANE_ACTS: Mapping[str, Act] = {**COMMON, "turn": _turn, "roll": _roll, "return to stroke": _back}
"""What a turtle in the plane does, by the names of the actions."""


def trace(word: Word) -> Path:
    """The path of a turtle that follows a word; commands that lead out of the plane are passed over.

    Raises
    ------
    ModelLimitError
        More brackets are open at once than the limit allows.
    ModelValueError
        A value is no number that can be drawn.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> path = trace(derive(read("axiom: F[+F]-(30)F(2)"), 0)[0])
    >>> path.turns.tolist(), path.offsets.tolist(), path.lengths.tolist(), path.parents.tolist()
    ([0.0, 1.0, 0.0], [0.0, 0.0, -30.0], [1.0, 1.0, 2.0], [-1, 0, 0])
    """
    system = word.states.system
    turtle = _Crawler(TURTLE_DIALECTS[system.turtle].left, initial_step(system))
    run_turtle(turtle, word, PLANE_ACTS)
    columns = list(zip(*turtle.steps, strict=True)) or [()] * len(_KINDS)
    steps: dict[str, Any] = {name: np.array(column, kind) for (name, kind), column in zip(_KINDS.items(), columns, strict=True)}
    return Path(**steps, outlines=tuple(turtle.outlines), rounds=tuple(turtle.rounds), unknown=tuple(turtle.unknown))


def place_path(path: Path, angle: float, heading: float = 90.0) -> Scene:
    """The strokes and shapes of a path for an angle and a first heading, in degrees.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> koch = derive(read("axiom: F--F--F\\nF -> F+F--F+F"), 3)[-1]
    >>> print(place_path(trace(koch), 60, 0))
    192 segments, width 27, height 31.18
    """
    radians = np.radians(path.turns * angle + path.offsets + heading)
    vectors = path.lengths[:, None] * np.column_stack([np.cos(radians), np.sin(radians)])
    ends = _summed(vectors, path.parents)
    drawn = path.drawn
    strokes = Segments(np.concatenate([ends - vectors, ends], axis=1)[drawn], path.orders[drawn], path.states[drawn],
                       path.widths[drawn], path.colours[drawn])
    places = np.vstack([ends, np.zeros(2)])  # the last is the origin, which is step -1
    polygons, discs = shapes_left(path.outlines, path.rounds, lambda numbers: places[np.array(numbers, np.int64)])
    return Scene(strokes, polygons=polygons, discs=discs, unknown=path.unknown)


def _summed(vectors: Floats, parents: Integers) -> Floats:
    """Each vector added to the sum of its parent, the parent's parent and so on: by doubling, all at once."""
    sums = np.vstack([vectors, np.zeros(2)])
    above = np.append(parents, -1)
    while np.any(above >= 0):
        sums = sums + sums[above]
        above = above[above]
    return sums[:-1]
