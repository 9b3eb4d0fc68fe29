"""The turtle in the plane (ABOP, sections 1.3 and 1.6.1).

Drawing takes two passes. `trace` interprets a word once and records for each step forward how often the turtle has turned by
the angle, how many degrees it has turned besides, how far it goes, and at the end of which earlier step it starts. None of this
depends on the angle. `place_path` then computes the coordinates for a given angle, which a browser can do by itself, without
the word and its rules.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING, Any

from lsys_kit.arrays import is_array, np
from lsys_kit.budget import counted
from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.scene import Floats, Integers, Scene, Segments, Stroke
from lsys_kit.geometry.turtle.commands import Instruction, initial_step
from lsys_kit.geometry.turtle.scanning import DRAWS, MOVES, Branches, Carried, Commands, added, latter, signs
from lsys_kit.geometry.turtle.turtle import (
    Outline,
    RoundShape,
    Turtle,
    Writing,
    collected_labels,
    collected_shapes,
    handlers_of,
    run_turtle,
)
from lsys_kit.geometry.turtle.unfolding import WordBetween
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Path:
    """The steps forward of a turtle, before the angle is known.

    turns, offsets
        The heading is turns * angle + offset, in degrees from the turtle's first heading, to the left.
    lengths
        How far it goes.
    parents
        The number of the earlier step at whose end it starts; -1 for the origin.
    drawn
        Whether it leaves a stroke; a step may also lead to the corner of a leaf.
    orders
        In how many brackets it stands.
    states
        The state of its module.
    widths, colours
        As of `Segments`.
    outlines, rounds, written
        Polygons, circles and discs, and labels; their places are numbers of steps, at whose ends they are.
    unknown
        As of `Scene`.
    end
        The number of the step at whose end the turtle stops.
    """

    turns: Floats
    offsets: Floats
    lengths: Floats
    parents: Integers
    drawn: NDArray[np.bool_]
    orders: Integers
    states: Integers
    widths: Floats
    colours: Integers
    outlines: tuple[Outline, ...] = ()
    rounds: tuple[RoundShape, ...] = ()
    written: tuple[Writing, ...] = ()
    unknown: tuple[str, ...] = ()
    end: int = -1

    def __len__(self) -> int:
        return len(self.turns)


class PlaneTurtle(Turtle):
    """A turtle in the plane.

    Its position is the number of a path step, at whose end it is. Its orientation is the number of turns by the angle, further
    degrees, both to the left, and the side on which its left lies: 1, or -1 after a roll by half a turn. Its path
    steps are the rows that scans have noted, and then `steps`.
    """

    __slots__ = ("noted", "steps")
    position: int
    orientation: tuple[float, float, float]

    def __init__(self, side: int, step: float) -> None:
        super().__init__(-1, (0.0, 0.0, side), step)
        self.in_plane = True
        self.noted: Floats | tuple[()] = ()
        self.steps: list[tuple[float, float, float, int, bool, int, int, float, int]] = []

    def walked(self) -> Iterator[Sequence[float]]:
        """Its steps: turns by the angle, degrees besides, the length, the number of the step before, and the rest of them."""
        return chain(self.noted.tolist() if is_array(self.noted) else (), self.steps)

    def forward(self, length: float, drawn: bool) -> None:
        turns, offset, _ = self.orientation
        self.position = self.step(turns, offset, length, self.position, drawn)
        if drawn:
            self.last = self.position

    def initial_orientation(self, degrees: float) -> tuple[float, float, float]:
        return 0.0, degrees, 1

    def local_point(self, ahead: float, left: float, up: float) -> int:
        turns, offset, side = self.orientation
        return self.step(turns, offset + side * math.degrees(math.atan2(left, ahead)), math.hypot(ahead, left), self.position)

    def scanned_orientation(self, commands: Commands, branches: Branches, carried: Carried, _: object) -> tuple[Any, ...]:
        half = commands.calling("roll") & (commands.factor == 0) & (commands.addend % 360 == 180)
        side = self.orientation[2] * signs(half, branches)
        turning = commands.calling("turn", "turn back", "turn by mirrored angle")
        sign = np.where(commands.calling("turn by mirrored angle"), carried.mirror, side)
        change = tuple((sign * column)[turning] for column in (commands.factor, commands.addend))
        return *branches.along(turning, change, added, self.orientation[:2]), side

    def scanned_position(
        self, commands: Commands, branches: Branches, carried: Carried, orientation: tuple[Any, ...]
    ) -> Integers:
        moves = commands.calling(*MOVES)
        (position,) = branches.along(moves, (np.arange(moves.sum()),), latter, (-1,))
        lengths = carried.scale * (commands.factor * carried.length + commands.addend)
        parents = branches.before_each(position, -1)
        drawn, (turns, offsets, _) = commands.calling(*DRAWS), orientation
        rows = turns, offsets, lengths, parents, drawn, branches.order, commands.state, carried.stroke_width, carried.colour
        self.noted = np.stack([column[moves] for column in rows], axis=1, dtype=np.float64)
        return position

    def step(self, turns: float, offset: float, length: float, parent: int, drawn: bool = False) -> int:
        self.steps.append((turns, offset, length, parent, drawn, len(self.stack), self.state, self.stroke_width, self.colour))
        return len(self.noted) + len(self.steps) - 1

    def do_turn(self, instruction: Instruction) -> None:
        turns, offset, side = self.orientation
        self.orientation = turns + side * instruction.factor, offset + side * instruction.addend, side

    do_turn_back = do_turn

    def do_turn_by_mirrored_angle(self, instruction: Instruction) -> None:
        turns, offset, side = self.orientation
        self.orientation = turns + self.mirror * instruction.factor, offset, side

    def do_roll(self, instruction: Instruction) -> None:
        if instruction.factor == 0 and instruction.addend % 360 == 180:
            turns, offset, side = self.orientation
            self.orientation = turns, offset, -side

    def do_return_to_stroke(self, instruction: Instruction) -> None:
        if self.last is not None:
            turns, offset, length, parent, *_ = self.steps[self.last]
            self.position = self.step(turns, offset, length * (instruction.factor + instruction.addend), parent)


LARGEST_EXACT = 2.0**40
"""Greater angles are reduced to less than a full turn, so that their multiples are no less exact."""
_COLUMN_TYPES = {
    "turns": "f8",
    "offsets": "f8",
    "lengths": "f8",
    "parents": "i8",
    "drawn": "?",
    "orders": "i8",
    "states": "i8",
    "widths": "f8",
    "colours": "i8",
}
PLANE_HANDLERS = handlers_of(PlaneTurtle)
"""What carries out the actions that stay in the plane."""


def trace(word: Word | WordBetween) -> Path:
    """The path of a turtle that interprets a word; commands that lead out of the plane are skipped.

    >>> from lsys_kit import derive, read
    >>> path = trace(derive(read("axiom: F[+F]-(30)F(2)"), 0)[0])
    >>> path.turns.tolist(), path.offsets.tolist(), path.lengths.tolist(), path.parents.tolist()
    ([0.0, 1.0, 0.0], [0.0, 0.0, -30.0], [1.0, 1.0, 2.0], [-1, 0, 0])
    """
    turtle = turtle_in_plane(word)
    columns = list(zip(*turtle.steps, strict=True)) or [()] * len(_COLUMN_TYPES)
    noted = np.reshape(turtle.noted, (-1, len(_COLUMN_TYPES)))
    steps: dict[str, Any] = {
        name: np.concatenate([before.astype(kind), np.array(column, kind)])
        for (name, kind), before, column in zip(_COLUMN_TYPES.items(), noted.T, columns, strict=True)
    }
    return Path(
        **steps,
        outlines=tuple(turtle.outlines),
        rounds=tuple(turtle.rounds),
        written=tuple(turtle.labels),
        unknown=tuple(turtle.unknown),
        end=turtle.position,
    )


def turtle_in_plane(word: Word | WordBetween) -> PlaneTurtle:
    """The turtle that has interpreted a word."""
    system = word.states.system
    turtle = PlaneTurtle(TURTLE_DIALECTS[system.turtle].left, initial_step(system))
    turtle.take_look(system)
    run_turtle(turtle, word, PLANE_HANDLERS)
    return turtle


def strokes_in_plane(word: Word, angle: float, heading: float) -> list[Stroke]:
    """The strokes of a word, as they are drawn one after another.

    >>> from lsys_kit import derive, read
    >>> strokes_in_plane(derive(read("axiom: F[+F]fF(2)"), 0)[0], 180, 0)[::2]
    [(0.0, 0.0, 1.0, 0.0), (2.0, 0.0, 4.0, 0.0)]
    """
    places, found, angle = [(0.0, 0.0)], list[Stroke](), _within_turns(angle)
    for turns, offset, length, parent, drawn, *_ in counted(turtle_in_plane(word).walked()):
        x, y = places[int(parent) + 1]
        radians = math.radians(turns * angle + offset + heading)
        places.append((x + length * math.cos(radians), y + length * math.sin(radians)))
        if drawn:
            found.append((x, y, *places[-1]))
    return found


def _within_turns(angle: float) -> float:
    return math.fmod(angle, 360) if abs(angle) > LARGEST_EXACT else angle  # the number of turns is whole


def place_path(path: Path, angle: float, heading: float = 90.0) -> Scene:
    """The scene of a path for a turning angle and an initial heading, in degrees.

    >>> from lsys_kit import derive, read
    >>> koch = derive(read("axiom: F--F--F\\nF -> F+F--F+F"), 3)[-1]
    >>> print(place_path(trace(koch), 60, 0))
    192 segments, width 27, height 31.18
    """
    radians = np.radians(path.turns * _within_turns(angle) + path.offsets + heading)
    vectors = path.lengths[:, None] * np.column_stack([np.cos(radians), np.sin(radians)])
    ends = _summed_along_parents(vectors, path.parents)
    drawn = path.drawn
    strokes = Segments(
        np.concatenate([ends - vectors, ends], axis=1)[drawn],
        path.orders[drawn],
        path.states[drawn],
        path.widths[drawn],
        path.colours[drawn],
    )
    places = np.vstack([ends, np.zeros(2)])  # the last is the origin, which is step -1

    def points(numbers: list[object]) -> Floats:
        return places[np.array(numbers, np.int64)]

    polygons, discs = collected_shapes(path.outlines, path.rounds, points)
    return Scene(strokes, polygons=polygons, discs=discs, labels=collected_labels(path.written, points), unknown=path.unknown)


def _summed_along_parents(vectors: Floats, parents: Integers) -> Floats:
    """The sum of each vector and those of all its ancestors, by pointer jumping."""
    sums = np.vstack([vectors, np.zeros(2)])
    above = np.append(parents, -1)
    while np.any(above >= 0):
        sums = sums + sums[above]
        above = above[above]
    return sums[:-1]
