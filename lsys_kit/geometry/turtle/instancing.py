"""Instanced drawing: what a state becomes in a number of steps is drawn once, and copied wherever it occurs.

Wherever the turtle comes to a module and whatever its orientation, the module draws the same shapes, only moved and rotated. So
the drawing of a word is assembled from those of its parts, down to single modules, each placed by an affine transform, and the
word itself is never built. A part is drawn anew for every step length, width and colour with which the turtle arrives. Commands
that depend on more than that, such as the direction of gravity or the last stroke, cannot be instanced: a word with one of
them is drawn module by module.
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import TYPE_CHECKING, Any, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget
from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.derive import Derivation
from lsys_kit.geometry.scene import Discs, Floats, Polygons, Scene, Segments
from lsys_kit.geometry.turtle.commands import (
    DrawingMode,
    Effect,
    Instruction,
    commands_of,
    drawing_mode,
    initial_step,
    instructions,
    symbols_with,
    unknown_commands,
)
from lsys_kit.geometry.turtle.space import SPACE_HANDLERS, SpaceTurtle, initial_frame, operand

if TYPE_CHECKING:
    from numpy.typing import DTypeLike, NDArray

Key: TypeAlias = tuple[int, int, tuple[object, ...]]
"""What a prototype depends on: the state, the number of steps that remain, and what the turtle carries."""
Column: TypeAlias = "NDArray[Any]"
AttributeColumns: TypeAlias = "tuple[Column, ...]"
_CARRIED_ATTRIBUTES = ("length", "width", "colour", "gravitropism", "restored", "mirror", "scale")
_carried_by = attrgetter(*_CARRIED_ATTRIBUTES)
LEAST_REPETITION = 30
"""Instancing pays where a word has at least so many modules for each prototype."""
POINTS_AT_A_TIME = 2**13
"""Points are transformed in blocks of this size, which stay in the cache of the processor between two operations."""


@dataclass(frozen=True)
class Prototype:
    """The drawing of a module, or of what becomes of it, by a turtle that starts at the origin in its initial frame.

    strokes, corners, centres
        Points, a row for each: the starts and ends of strokes in turn, the corners of polygons, the centres of discs.
    of_strokes, of_polygons, of_discs
        Their attributes: order, state, width, colour; number of corners, state, colour; radius, kind, state, colour. A single
        width or colour holds for all.
    end, rotation, carried
        The final position of the turtle, its rotation, and what it carries.
    """

    strokes: Floats
    of_strokes: AttributeColumns
    corners: Floats
    of_polygons: AttributeColumns
    centres: Floats
    of_discs: AttributeColumns
    end: Floats
    rotation: Floats
    carried: tuple[object, ...]


@dataclass(frozen=True)
class Instance:
    """A prototype with its transform: where it begins and its rotation; and its branch order."""

    prototype: Prototype
    position: Floats
    rotation: Floats
    order: int


def draw_instanced(derivation: Derivation, step: int, angle: float) -> Scene | None:
    """The scene of a step of a derivation; None if it cannot be instanced, or if that does not pay.

    >>> from lsys_kit import derive, read
    >>> print(draw_instanced(derive(read("axiom: F\\nF -> F[+F]F[-F]F"), 7), 7, 25.7))
    78,125 segments, width 732.47, height 2187
    """
    system, states = derivation.states.system, derivation.states
    if not states.traits.d0l or not all(command.instanceable for command, _ in commands_of(system)):
        return None
    present = [derivation.counts(earlier) for earlier in range(step + 1)]
    if sum(present[-1].values()) < LEAST_REPETITION * sum(map(len, present)):
        return None
    prototypes = Prototypes(states, angle, drawing_mode(system) is DrawingMode.PLANE)
    whole = prototypes.of_row(states.axiom, step)
    return _as_scene(whole, unknown_commands(interpretations(states, list(present[-1])), system))


class Prototypes:
    """The prototypes of the drawings of a system, each made once."""

    def __init__(self, states: States, angle: float, in_plane: bool) -> None:
        self.states, self.angle = states, angle
        self._axes = [0, 2] if in_plane else [0, 1, 2]
        self._initial_frame = initial_frame(states.system.turtle, float(states.system.heading))
        self._inverse = np.array(self._initial_frame[:3])  # of an orthonormal frame: its transpose
        self._opening, self._closing = (symbols_with(effect, states.system.turtle) for effect in (Effect.OPENS, Effect.CLOSES))
        self._prototypes: dict[Key, Prototype] = {}
        self._instructions: dict[int, list[Instruction]] = {}

    def _turtle(self) -> SpaceTurtle:
        system = self.states.system
        turtle = SpaceTurtle(self._initial_frame, initial_step(system))
        turtle.take_look(system)
        turtle.in_plane = len(self._axes) == 2
        return turtle

    def of_row(self, row: Sequence[int], steps: int) -> Prototype:
        turtle = self._turtle()
        return self._run(self._of_row(row, steps, _carried_by(turtle)))

    def _run(self, task: Generator[Key, Prototype, Prototype]) -> Prototype:
        """A prototype, after those that it needs; with a stack of its own, so that many steps are no deep recursion."""
        todo: list[tuple[Key | None, Generator[Key, Prototype, Prototype]]] = [(None, task)]
        answer: Prototype | None = None
        while True:
            check_budget()
            key, task = todo[-1]
            try:
                wanted = task.send(answer)  # type: ignore[arg-type]
            except StopIteration as done:
                answer = done.value
                todo.pop()
                if key is None:
                    return answer
                self._prototypes[key] = answer
                continue
            answer = self._prototypes.get(wanted)
            if answer is None:
                todo.append((wanted, self._prototype(*wanted)))

    def _prototype(self, state: int, steps: int, carried: tuple[object, ...]) -> Generator[Key, Prototype, Prototype]:
        row = self.states.successors[state] if steps else (state,)
        if row == (state,):
            return self._of_module(state, carried)
        return (yield from self._of_row(row, steps - 1, carried))

    def _of_row(self, row: Sequence[int], steps: int, carried: tuple[object, ...]) -> Generator[Key, Prototype, Prototype]:
        """The prototype of a row of states: instances of theirs, each placed where the one before ends."""
        size, parts = len(self._axes), []
        position, rotation = np.zeros(size), np.eye(size)
        stack: list[tuple[Floats, Floats, tuple[object, ...]]] = []
        for state in row:
            symbol = self.states.modules[state].symbol
            if symbol in self._closing:
                position, rotation, carried = stack.pop()
                continue
            if symbol in self._opening:
                stack.append((position, rotation, carried))
            prototype = yield state, steps, carried
            parts.append(Instance(prototype, position, rotation, len(stack)))
            position, rotation, carried = position + rotation @ prototype.end, rotation @ prototype.rotation, prototype.carried
        if len(row) == 1:
            return parts[0].prototype
        return _merged_instances(parts, position, rotation, carried)

    def _of_module(self, state: int, carried: tuple[object, ...]) -> Prototype:
        turtle = self._turtle()
        for name, value in zip(_CARRIED_ATTRIBUTES, carried, strict=True):
            setattr(turtle, name, value)
        if state not in self._instructions:
            system = self.states.system
            self._instructions.update(instructions(interpretations(self.states, [state]), system.turtle, system.angle))
        turtle.state = state
        for instruction in self._instructions[state]:
            SPACE_HANDLERS[instruction.action](turtle, operand(instruction, self.angle))
        strokes = np.array(turtle.strokes).reshape(-1, 10).T
        points = strokes[:6].T.reshape(-1, 3)
        corners = [corner for outline in turtle.outlines for corner in outline.corners]
        opened = len(turtle.stack)  # 1 for an opening bracket, which counts in the branch order of its instance
        return Prototype(
            np.ascontiguousarray(points[:, self._axes]),
            ((strokes[6] - opened).astype(np.int16), strokes[7].astype(np.int32), strokes[8], strokes[9].astype(np.int32)),
            self._points(corners),
            (
                np.array([len(outline.corners) for outline in turtle.outlines], np.int64),
                *(np.array([outline[place] for outline in turtle.outlines], np.int32) for place in (1, 2)),
            ),
            self._points([found.place for found in turtle.rounds]),
            (
                np.array([found.radius for found in turtle.rounds]),
                *(np.array([found[place] for found in turtle.rounds], np.int32) for place in (2, 3, 4)),
            ),
            np.array(turtle.position)[self._axes],
            (np.array(turtle.orientation[:3]).T @ self._inverse)[np.ix_(self._axes, self._axes)],
            _carried_by(turtle),
        )

    def _points(self, places: Sequence[object]) -> Floats:
        return np.ascontiguousarray(np.array(places, np.float64).reshape(-1, 3)[:, self._axes])


def _merged_instances(instances: Sequence[Instance], end: Floats, rotation: Floats, carried: tuple[object, ...]) -> Prototype:
    drawn = [part for part in instances if len(part.prototype.strokes)]
    strokes = _transformed([(part, part.prototype.strokes) for part in drawn], len(end))
    orders, states, widths, colours = zip(*(part.prototype.of_strokes for part in drawn), strict=True) if drawn else [()] * 4
    sizes = [len(order) for order in orders]
    raised = [order + np.int16(part.order) if part.order else order for order, part in zip(orders, drawn, strict=True)]
    return Prototype(
        strokes,
        (
            _concatenated(raised, np.int16),
            _concatenated(states, np.int32),
            _constant_or_all(widths, sizes, np.float64),
            _constant_or_all(colours, sizes, np.int32),
        ),
        _transformed([(part, part.prototype.corners) for part in instances], len(end)),
        tuple(_concatenated([part.prototype.of_polygons[place] for part in instances], np.int64) for place in range(3)),
        _transformed([(part, part.prototype.centres) for part in instances], len(end)),
        tuple(
            _concatenated([part.prototype.of_discs[place] for part in instances], np.float64 if place == 0 else np.int64)
            for place in range(4)
        ),
        end,
        rotation,
        carried,
    )


def _concatenated(columns: Sequence[Column], kind: DTypeLike) -> Column:
    return np.concatenate(columns, dtype=kind) if columns else np.empty(0, kind)


def _constant_or_all(columns: Sequence[Column], sizes: Sequence[int], kind: DTypeLike) -> Column:
    """The columns as one; a single value, where each column has only that value."""
    if columns and all(len(column) == 1 for column in columns) and len({column[0] for column in columns}) == 1:
        return columns[0]
    return _concatenated([np.broadcast_to(column, size) for column, size in zip(columns, sizes, strict=True)], kind)


def _transformed(parts: Sequence[tuple[Instance, Floats]], size: int) -> Floats:
    """The points of some instances, transformed block by block."""
    whole, last = np.empty((sum(len(points) for _, points in parts), size)), 0
    for part, points in parts:
        rotation, at = np.ascontiguousarray(part.rotation.T), np.tile(part.position, min(POINTS_AT_A_TIME, len(points)))
        straight = np.array_equal(rotation, np.eye(size))  # as along most of a stem
        for first in range(0, len(points), POINTS_AT_A_TIME):
            block, there = points[first : first + POINTS_AT_A_TIME], whole[last : last + POINTS_AT_A_TIME]
            there = there[: len(block)]
            if not straight:
                block = np.matmul(block, rotation, out=there)
            np.add(block.reshape(-1), at[: block.size], out=there.reshape(-1))
            last += len(block)
    return whole


def _as_scene(prototype: Prototype, unknown: tuple[str, ...]) -> Scene:
    polygons = Polygons(prototype.corners, np.cumsum([0, *prototype.of_polygons[0]]), *prototype.of_polygons[1:])
    radii, kinds, states, colours = prototype.of_discs
    discs = Discs(prototype.centres, radii, kinds, states, colours)
    strokes = Segments(prototype.strokes.reshape(-1, 2 * prototype.strokes.shape[1]), *prototype.of_strokes)
    return Scene(strokes, polygons=polygons, discs=discs, unknown=unknown)
