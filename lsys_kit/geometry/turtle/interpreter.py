"""What the turtles in the plane and in space have in common: what a turtle carries, what it does, and what it leaves behind."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from operator import attrgetter
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from lsys_kit.budget import current
from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.core.words import Word
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.geometry.scene import CIRCLE, DISC, OWN, SPHERE, Discs, Floats, Polygons
from lsys_kit.geometry.turtle.commands import WIDTH
from lsys_kit.geometry.turtle.instructions import LARGEST, Instruction, instructions, unknown_commands
from lsys_kit.geometry.turtle.surfaces import Surface, surface_called, surfaces


class Outline(NamedTuple):
    """A polygon: the places of its corners."""

    corners: list[Any]
    state: int
    colour: int


class RoundShape(NamedTuple):
    """A circle, disc or sphere."""

    place: Any
    radius: float
    kind: int
    state: int
    colour: int


class Turtle:
    """A turtle on its way.

    Attributes
    ----------
    at, way
        Where it is, and how it is turned: in the plane the number of the step at whose end it is, and its turns so far; in
        space a point and a frame.
    length, width, colour, sag
        Its step, the width and the colour of its strokes, and the strength of `RV`.
    pulls
        By its number each tropism.
    last
        The number of its last stroke, in the plane of the step that it was; None before the first.
    once
        The names of what goes back after the next stroke, with the values that they had.
    state
        The state of the module that it follows.
    """

    __slots__ = ("at", "colour", "deepest", "first", "last", "length", "once", "outlines", "pulls", "rounds", "sag", "stack",
                 "state", "tilde", "unfinished", "unknown", "way", "width")

    def __init__(self, at: Any, way: Any, step: float) -> None:
        self.at, self.way = at, way
        self.last: Any = None
        self.length, self.width, self.colour, self.sag = step, float(OWN), OWN, 0.0
        self.pulls: Mapping[float, tuple[float, float, float]] = {}
        self.once: tuple[tuple[str, float], ...] = ()
        self.first = {name: getattr(self, name) for name in ("length", "width", "colour", "sag")}
        self.state, self.tilde = -1, False
        self.stack: list[tuple[Any, ...]] = []
        self.deepest = current().brackets
        self.unfinished: list[Outline] = []
        self.outlines: list[Outline] = []
        self.rounds: list[RoundShape] = []
        self.unknown: dict[str, None] = {}

    def go(self, length: float, drawn: bool) -> None:
        """Go forward, perhaps with a stroke."""
        raise NotImplementedError

    def spot(self, ahead: float, left: float, up: float) -> Any:
        """A place near by, in the turtle's own axes."""
        raise NotImplementedError

    def stroke_width(self) -> float:
        """How wide a stroke is here."""
        return WIDTH if self.width == OWN else self.width

    def grow(self, surface: Surface, size: float) -> None:
        """Leave a surface here."""
        if size:
            self.outlines += [Outline([self.spot(size * ahead, size * left, size * up) for ahead, left, up in face],
                                      self.state, self.colour) for face in surface.faces]


MOST_COLOURS = 2 ** 31 - 1
"""Colours are numbered from 0 to this."""

Act: TypeAlias = Callable[[Any, Any], None]
"""What a turtle does when it meets an order."""

_KEPT = ("at", "way", "length", "width", "colour", "sag", "pulls", "last", "once")
_kept = attrgetter(*_KEPT)


def _forward(drawn: bool, corner: bool) -> Act:
    def act(turtle: Turtle, order: Instruction) -> None:
        turtle.go(order.factor * turtle.length + order.addend, drawn)
        if corner and turtle.unfinished:
            turtle.unfinished[-1].corners.append(turtle.at)
        if drawn and turtle.once:
            for name, value in turtle.once:
                setattr(turtle, name, value)
            turtle.once = ()
    return act


def _length(turtle: Turtle, order: Instruction) -> None:
    turtle.length = _within_reach("step", order.factor * turtle.length + order.addend)


def _sag(turtle: Turtle, order: Instruction) -> None:
    turtle.sag = _within_reach("strength", order.factor * turtle.sag + order.addend)


def _width(turtle: Turtle, order: Instruction) -> None:
    turtle.width = max(0.0, _within_reach("width", order.factor * turtle.stroke_width() + order.addend))


def _within_reach(what: str, value: float) -> float:
    if not abs(value) <= LARGEST:
        raise ModelValueError(f"The turtle's {what} grows out of reach: {value:.3g}")
    return value


def _colour(turtle: Turtle, order: Instruction) -> None:
    turtle.colour = max(0, min(MOST_COLOURS, round(order.factor * max(0, turtle.colour) + order.addend)))


def _first(name: str) -> Act:
    return lambda turtle, _: setattr(turtle, name, turtle.first[name])


def _next(name: str, change: Act) -> Act:
    def act(turtle: Turtle, order: Instruction) -> None:
        turtle.once = ((name, getattr(turtle, name)), *turtle.once)  # the earliest value is set last, and stays
        change(turtle, order)
    return act


def _open(turtle: Turtle, _: Instruction) -> None:
    _check_depth(turtle, turtle.stack)
    turtle.stack.append(_kept(turtle))


def _close(turtle: Turtle, _: Instruction) -> None:
    if turtle.stack:
        (turtle.at, turtle.way, turtle.length, turtle.width, turtle.colour, turtle.sag, turtle.pulls, turtle.last,
         turtle.once) = turtle.stack.pop()


def _outline(turtle: Turtle, _: Instruction) -> None:
    _check_depth(turtle, turtle.unfinished)
    turtle.unfinished.append(Outline([], turtle.state, turtle.colour))


def _check_depth(turtle: Turtle, opened: Sequence[object]) -> None:
    if len(opened) >= turtle.deepest:
        raise ModelLimitError(f"More than {turtle.deepest:,} brackets are open at once", limit=turtle.deepest)


def _corner(turtle: Turtle, _: Instruction) -> None:
    if turtle.unfinished:
        turtle.unfinished[-1].corners.append(turtle.at)


def _fill(turtle: Turtle, _: Instruction) -> None:
    if turtle.unfinished and len((outline := turtle.unfinished.pop()).corners) > 2:
        turtle.outlines.append(outline)


def _announce(turtle: Turtle, _: Instruction) -> None:
    turtle.tilde = True


def _called(turtle: Turtle, order: Instruction) -> None:
    if turtle.tilde:
        turtle.tilde = False
        if surface := surface_called(order.symbol):
            turtle.grow(surface, order.factor * turtle.length + order.addend)
        else:
            turtle.unknown[f"~{order.symbol}"] = None


def _surface(turtle: Turtle, order: Instruction) -> None:
    turtle.grow(surfaces()[order.surface], order.factor * turtle.length + order.addend)


def _round(kind: int) -> Act:
    def act(turtle: Turtle, order: Instruction) -> None:
        width = order.factor * turtle.stroke_width() + order.addend
        turtle.rounds.append(RoundShape(turtle.at, abs(width) / 2, kind, turtle.state, turtle.colour))
    return act


COMMON: Mapping[str, Act] = {
    "draw": _forward(True, True), "move": _forward(False, True),
    "draw without vertex": _forward(True, False), "move without vertex": _forward(False, False),
    "set length": _length, "reset length": _first("length"), "set length once": _next("length", _length),
    "set width": _width, "reset width": _first("width"), "set width once": _next("width", _width),
    "set gravitropism": _sag, "reset gravitropism": _first("sag"), "set gravitropism once": _next("sag", _sag),
    "set colour": _colour, "reset colour": _first("colour"), "push": _open, "pop": _close,
    "begin polygon": _outline, "record vertex": _corner, "end polygon": _fill,
    "expect surface": _announce, "draw expected surface": _called, "draw surface": _surface,
    "draw circle": _round(CIRCLE), "draw disc": _round(DISC), "draw sphere": _round(SPHERE),
}
"""What every turtle does, by the names of the actions."""


def run_turtle(turtle: Turtle, word: Word, acts: Mapping[str, Act],
               ready: Callable[[Instruction], Any] = lambda order: order) -> None:
    """Send a turtle along a word; orders for which it has no act are passed over.

    Parameters
    ----------
    turtle
        The turtle, at its start.
    word
        The word.
    acts
        What this turtle does, by the names of the actions.
    ready
        What an act is given for an order: worked out once for each state, not for each module.

    Raises
    ------
    ModelLimitError
        More brackets are open at once than the limit allows.
    ModelValueError
        A value is no number that can be drawn.
    """
    with _no_collection():
        told = compile_word(word, acts, ready)
        turtle.unknown = dict.fromkeys(told.unknown)
        for state in word.numbers():
            turtle.state = state
            for act, what in told.acts[state]:
                act(turtle, what)


@contextmanager
def _no_collection() -> Iterator[None]:
    """Where nearly all modules are different, Python would look for cycles among all orders again and again: half the time."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


class CompiledWord(NamedTuple):
    """What a word's modules tell a turtle: for each state the acts and what they are given; and the symbols unknown to it."""

    acts: dict[int, list[tuple[Act, Any]]]
    unknown: tuple[str, ...]


def compile_word(word: Word, acts: Mapping[str, Act], ready: Callable[[Instruction], Any]) -> CompiledWord:
    """What a word tells a turtle that has these acts."""
    system, drawn = word.states.system, interpretations(word.states, word.numbers())
    return CompiledWord({state: [(acts[order.action], ready(order)) for order in found if order.action in acts]
                 for state, found in instructions(drawn, system.turtle).items()}, unknown_commands(drawn, system))


def shapes_left(outlines: Sequence[Outline], rounds: Sequence[RoundShape],
                points: Callable[[list[Any]], Floats]) -> tuple[Polygons, Discs]:
    """The shapes that a turtle has left besides strokes, given what the coordinates of places are."""
    sizes = [len(outline.corners) for outline in outlines]
    polygons = Polygons(points([corner for outline in outlines for corner in outline.corners]), np.cumsum([0, *sizes]),
                        *(np.array([outline[field] for outline in outlines], np.int64) for field in (1, 2)))
    discs = Discs(points([found.place for found in rounds]), np.array([found.radius for found in rounds], np.float64),
                  *(np.array([found[field] for found in rounds], np.int64) for field in (2, 3, 4)))
    return polygons, discs
