"""Drawing at once: what a state becomes in so many steps is drawn once, and placed again wherever it occurs.

A turtle that comes to a module draws the same shapes wherever it is and however it is turned: they are only moved and
rotated. So the drawing of a word is put together from those of its parts, down to single modules, each by an affine map, and
the word itself is never built. The step, the width and the colour with which the turtle arrives belong to what a piece
depends on. Commands that ask where up is, or what the turtle has done before, have no such pieces: there it goes module by
module.
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import Any, TypeAlias

import numpy as np

from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.derive import Derivation
from lsys_kit.geometry.scene import Discs, Floats, Polygons, Scene, Segments
from lsys_kit.geometry.turtle.actions import Effect
from lsys_kit.geometry.turtle.commands import commands_of, initial_step, symbols_with
from lsys_kit.geometry.turtle.instructions import Instruction, instructions, unknown_commands
from lsys_kit.geometry.turtle.mode import DrawingMode, drawing_mode
from lsys_kit.geometry.turtle.space import SPACE_ACTS, SpaceTurtle, initial_frame, prepared

Key: TypeAlias = tuple[int, int, tuple[Any, ...]]
"""What a piece depends on: the state, how many steps it is from the word that is drawn, and what the turtle carries."""
PieceColumns: TypeAlias = tuple[np.ndarray[Any, Any], ...]
_CARRIED = ("length", "width", "colour", "sag", "once")
_carried = attrgetter(*_CARRIED)
OFTEN = 30
"""Pieces pay where a word has so many times more modules than there are pieces to make."""
BLOCK = 2**13
"""So many points are placed at a time: what lies between two operations stays in the processor's cache."""


@dataclass(frozen=True)
class Piece:
    """What is drawn by a module, or by what it becomes, for a turtle that starts at the origin, turned as at the very first.

    Attributes
    ----------
    strokes, corners, centres
        Points, a row for each: the starts and ends of strokes in turn, the corners of polygons, the centres of discs.
    of_strokes, of_polygons, of_discs
        What else there is to say of each: order, state, width, colour; number of corners, state, colour; radius, kind, state,
        colour. One width or colour stands for all, where they are alike.
    end, turned, carried
        Where the turtle is in the end, how it is turned, and what it carries.
    """

    strokes: Floats
    of_strokes: PieceColumns
    corners: Floats
    of_polygons: PieceColumns
    centres: Floats
    of_discs: PieceColumns
    end: Floats
    turned: Floats
    carried: tuple[Any, ...]


@dataclass(frozen=True)
class Placed:
    """A piece with its place: where it begins, how it is turned, and in how many brackets it stands."""

    piece: Piece
    at: Floats
    turned: Floats
    order: int


def draw_instanced(derivation: Derivation, step: int, angle: float) -> Scene | None:
    """The scene of a derivation's step, if it can be put together from pieces, and that pays.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> print(draw_instanced(derive(read("axiom: F\\nF -> F[+F]F[-F]F"), 7), 7, 25.7))
    78,125 segments, width 732.47, height 2187
    """
    system, states = derivation.states.system, derivation.states
    if not states.settled or not all(command.instanceable for command, _ in commands_of(system)):
        return None
    present = [derivation.counts(earlier) for earlier in range(step + 1)]
    if sum(present[-1].values()) < OFTEN * sum(map(len, present)):
        return None
    pieces = Pieces(states, angle, drawing_mode(system) is DrawingMode.PLANE)
    whole = pieces.joined(states.axiom, step)
    return _scene(whole, unknown_commands(interpretations(states, list(present[-1])), system))


class Pieces:
    """The pieces of a system's drawings, each made once.

    Parameters
    ----------
    states
        The table of states, all of which depend on themselves alone.
    angle
        By how many degrees the turtle turns.
    flat
        Whether the turtle stays in the plane.
    """

    def __init__(self, states: States, angle: float, flat: bool) -> None:
        self.states, self.angle = states, angle
        self._axes = [0, 2] if flat else [0, 1, 2]
        self._first = initial_frame(states.system.turtle, float(states.system.heading))
        self._back = np.array(self._first[:3]).T  # its inverse is its transpose
        self._opening, self._closing = (symbols_with(effect, states.system.turtle) for effect in (Effect.OPENS, Effect.CLOSES))
        self._known: dict[Key, Piece] = {}
        self._told: dict[int, list[Instruction]] = {}

    def joined(self, row: Sequence[int], steps: int) -> Piece:
        """What a row of states, the axiom, draws in so many steps."""
        turtle = SpaceTurtle(self._first, initial_step(self.states.system))
        return self._run(self._row(row, steps, _carried(turtle)))

    def _run(self, making: Generator[Key, Piece, Piece]) -> Piece:
        """A piece, after those that it asks for: with a stack of its own, however many steps there are."""
        todo: list[tuple[Key | None, Generator[Key, Piece, Piece]]] = [(None, making)]
        answer: Piece | None = None
        while True:
            key, making = todo[-1]
            try:
                wanted = making.send(answer)  # type: ignore[arg-type]
            except StopIteration as done:
                answer = done.value
                todo.pop()
                if key is None:
                    return answer
                self._known[key] = answer
                continue
            answer = self._known.get(wanted)
            if answer is None:
                todo.append((wanted, self._made(*wanted)))

    def _made(self, state: int, steps: int, carried: tuple[Any, ...]) -> Generator[Key, Piece, Piece]:
        row = self.states.successors[state] if steps else (state,)
        if row == (state,):
            return self._single(state, carried)
        return (yield from self._row(row, steps - 1, carried))

    def _row(self, row: Sequence[int], steps: int, carried: tuple[Any, ...]) -> Generator[Key, Piece, Piece]:
        """What a row of states draws: their pieces, each placed where the one before ends."""
        size, parts = len(self._axes), []
        at, turned = np.zeros(size), np.eye(size)
        stack: list[tuple[Floats, Floats, tuple[Any, ...]]] = []
        for state in row:
            symbol = self.states.modules[state].symbol
            if symbol in self._closing:
                at, turned, carried = stack.pop()
                continue
            if symbol in self._opening:
                stack.append((at, turned, carried))
            piece = yield state, steps, carried
            parts.append(Placed(piece, at, turned, len(stack)))
            at, turned, carried = at + turned @ piece.end, turned @ piece.turned, piece.carried
        if len(row) == 1:
            return parts[0].piece
        return _joined(parts, at, turned, carried)

    def _single(self, state: int, carried: tuple[Any, ...]) -> Piece:
        """What a module draws by itself."""
        turtle = SpaceTurtle(self._first, initial_step(self.states.system))
        for name, value in zip(_CARRIED, carried, strict=True):
            setattr(turtle, name, value)
        if state not in self._told:
            self._told.update(instructions(interpretations(self.states, [state]), self.states.system.turtle))
        turtle.state = state
        for order in self._told[state]:
            if order.action in SPACE_ACTS:
                SPACE_ACTS[order.action](turtle, prepared(order, self.angle))
        strokes = np.array(turtle.strokes).reshape(-1, 10).T
        points = strokes[:6].T.reshape(-1, 3)
        corners = [corner for outline in turtle.outlines for corner in outline.corners]
        opened = len(turtle.stack)  # of a bracket, which counts where it stands
        return Piece(
            np.ascontiguousarray(points[:, self._axes]),
            ((strokes[6] - opened).astype(np.int16), strokes[7].astype(np.int32), strokes[8], strokes[9].astype(np.int32)),
            self._points(corners),
            (np.array([len(outline.corners) for outline in turtle.outlines], np.int64),
             *(np.array([outline[place] for outline in turtle.outlines], np.int32) for place in (1, 2))),
            self._points([found.place for found in turtle.rounds]),
            (np.array([found.radius for found in turtle.rounds]),
             *(np.array([found[place] for found in turtle.rounds], np.int32) for place in (2, 3, 4))),
            np.array(turtle.at)[self._axes], (np.array(turtle.way[:3]).T @ self._back.T)[np.ix_(self._axes, self._axes)],
            _carried(turtle))

    def _points(self, places: Sequence[Any]) -> Floats:
        return np.ascontiguousarray(np.array(places, np.float64).reshape(-1, 3)[:, self._axes])


def _joined(parts: Sequence[Placed], end: Floats, turned: Floats, carried: tuple[Any, ...]) -> Piece:
    """Placed pieces as one."""
    drawn = [part for part in parts if len(part.piece.strokes)]
    strokes = _moved([(part, part.piece.strokes) for part in drawn], len(end))
    orders, states, widths, colours = zip(*(part.piece.of_strokes for part in drawn), strict=True) if drawn else [()] * 4
    sizes = [len(order) for order in orders]
    raised = [order + np.int16(part.order) if part.order else order for order, part in zip(orders, drawn, strict=True)]
    return Piece(
        strokes, (_together(raised, np.int16), _together(states, np.int32), _alike(widths, sizes, np.float64),
                  _alike(colours, sizes, np.int32)),
        _moved([(part, part.piece.corners) for part in parts], len(end)),
        tuple(_together([part.piece.of_polygons[place] for part in parts], np.int64) for place in range(3)),
        _moved([(part, part.piece.centres) for part in parts], len(end)),
        tuple(_together([part.piece.of_discs[place] for part in parts], np.float64 if place == 0 else np.int64)
              for place in range(4)), end, turned, carried)


def _together(columns: Sequence[np.ndarray[Any, Any]], kind: Any) -> np.ndarray[Any, Any]:
    return np.concatenate(columns, dtype=kind) if columns else np.empty(0, kind)


def _alike(columns: Sequence[np.ndarray[Any, Any]], sizes: Sequence[int], kind: Any) -> np.ndarray[Any, Any]:
    """Columns together; where one value stands for all of each, and it is the same, it stands for all."""
    if columns and all(len(column) == 1 for column in columns) and len({column[0] for column in columns}) == 1:
        return columns[0]
    return _together([np.broadcast_to(column, size) for column, size in zip(columns, sizes, strict=True)], kind)


def _moved(parts: Sequence[tuple[Placed, Floats]], size: int) -> Floats:
    """Points, each where its part is placed, block by block."""
    whole, last = np.empty((sum(len(points) for _, points in parts), size)), 0
    for part, points in parts:
        turned, at = np.ascontiguousarray(part.turned.T), np.tile(part.at, min(BLOCK, len(points)))
        straight = np.array_equal(turned, np.eye(size))  # as most of a plant's stem is
        for first in range(0, len(points), BLOCK):
            block, there = points[first:first + BLOCK], whole[last:last + BLOCK]
            there = there[:len(block)]
            if not straight:
                block = np.matmul(block, turned, out=there)
            np.add(block.reshape(-1), at[:block.size], out=there.reshape(-1))
            last += len(block)
    return whole


def _scene(piece: Piece, strange: tuple[str, ...]) -> Scene:
    """The shapes of a piece as a scene."""
    polygons = Polygons(piece.corners, np.cumsum([0, *piece.of_polygons[0]]), *piece.of_polygons[1:])
    radii, kinds, states, colours = piece.of_discs
    discs = Discs(piece.centres, radii, kinds, states, colours)
    strokes = Segments(piece.strokes.reshape(-1, 2 * piece.strokes.shape[1]), *piece.of_strokes)
    return Scene(strokes, polygons=polygons, discs=discs, unknown=strange)
