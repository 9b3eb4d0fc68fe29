"""The turtle interpreter: the state of a turtle, and the handlers of the actions that do not depend on its dimension."""

from __future__ import annotations

import gc
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from operator import attrgetter
from typing import Any, NamedTuple, TypeAlias

from lsys_kit.budget import counted, current
from lsys_kit.derivation.core.interpretation import interpretations, modules_between_checks
from lsys_kit.derivation.core.words import Word
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.geometry.scene import CIRCLE, DISC, OWN, SPHERE
from lsys_kit.geometry.turtle.commands import RAMP_END, RAMP_START, WIDTH, initial_colour
from lsys_kit.geometry.turtle.instructions import LARGEST, Instruction, instructions, unknown_commands
from lsys_kit.geometry.turtle.patches import Face
from lsys_kit.geometry.turtle.shapes import Outline, RoundShape
from lsys_kit.geometry.turtle.surfaces import Surface, surfaces, surfaces_by_symbol
from lsys_kit.notation.model.system import LSystem


class Turtle(ABC):
    """A turtle, with what it carries and what it has drawn.

    Attributes
    ----------
    position, orientation
        In the plane the number of the path step at whose end the turtle is, and its turns so far; in space a point and a
        frame.
    length, width, colour, gravitropism
        The length of a step, the width and the colour of strokes, and the strength of `RV`.
    mirror, second_heading
        Whether Fractint's turns are mirrored, -1, or not, 1; and its second heading, in degrees to the left of the first.
    tropisms
        The tropisms, by number.
    axis, patches
        The last control point of a generalised cylinder, None outside of one; the control points of patches, by their numbers.
    last
        The number of the last stroke (in the plane, of its path step); None before the first.
    restored
        The names of the attributes that the next stroke restores, with their values.
    first_width
        The width from which commands start that change it, where none has been set.
    initial
        The values of the attributes that can be reset.
    state
        The state of the module that is being interpreted.
    surfaces
        The surfaces that it can draw, by their symbols.
    flat
        Whether it draws surfaces by their outlines alone.
    """

    __slots__ = ("axis", "bracket_limit", "colour", "expects_surface", "first_width", "flat", "gravitropism", "initial", "last",
                 "length", "mirror", "open_polygons", "orientation", "outlines", "patches", "position", "restored", "rounds",
                 "second_heading", "stack", "state", "surfaces", "tropisms", "unknown", "width")

    def __init__(self, position: Any, orientation: Any, step: float, first_width: float = WIDTH) -> None:
        self.position, self.orientation = position, orientation
        self.last: Any = None
        self.length, self.width, self.colour, self.gravitropism = step, float(OWN), OWN, 0.0
        self.first_width, self.mirror, self.second_heading = first_width, 1, 0.0
        self.tropisms: Mapping[float, tuple[float, float, float]] = {}
        self.axis: Any = None
        self.patches: dict[float, dict[tuple[float, float], Any]] = {}
        self.restored: tuple[tuple[str, float], ...] = ()
        self.initial = {name: getattr(self, name) for name in ("length", "width", "colour", "gravitropism")}
        self.state, self.expects_surface = -1, False
        self.stack: list[tuple[Any, ...]] = []
        self.bracket_limit = current().brackets
        self.open_polygons: list[Outline] = []
        self.outlines: list[Outline] = []
        self.rounds: list[RoundShape] = []
        self.unknown: dict[str, None] = {}
        self.surfaces: Mapping[str, Surface] = {}
        self.flat = False

    def take_look(self, system: LSystem) -> None:
        """Take the colour with which the turtle of a system begins, as the one that can be reset, and its surfaces."""
        self.colour = self.initial["colour"] = initial_colour(system)
        self.surfaces = surfaces_by_symbol(system)

    @abstractmethod
    def forward(self, length: float, drawn: bool) -> None:
        """Move forward, with or without a stroke."""

    @abstractmethod
    def initial_orientation(self, degrees: float) -> Any:
        """The initial orientation, turned to the left by some degrees."""

    @abstractmethod
    def local_point(self, ahead: float, left: float, up: float) -> Any:
        """A point given by its coordinates in the frame of the turtle."""

    def draw_surface(self, surface: Surface, size: float) -> None:
        """Draw a surface at the position of the turtle: in the plane its outlines."""
        if size:
            self.outlines += [Outline(self.local_points(face, size), self.state, self.colour) for face in surface.outlines]

    def local_points(self, face: Face, size: float) -> list[Any]:
        """The corners of a face of a surface of some size."""
        return [self.local_point(size * ahead, size * left, size * up) for ahead, left, up in face]


MOST_CURVED = 150
"""Where more surfaces are drawn, each is drawn by its outlines: one sees little of its curvature."""
LAST_COLOUR = 2 ** 31 - 1
"""The greatest number of a colour."""

Handler: TypeAlias = Callable[[Any, Any], None]
"""Carries out an instruction, given a turtle and the operand of the instruction."""

_SAVED_ATTRIBUTES = ("position", "orientation", "length", "width", "colour", "gravitropism", "tropisms", "last", "restored",
                     "mirror", "second_heading", "axis")
_saved_state = attrgetter(*_SAVED_ATTRIBUTES)


def forward_handler(drawn: bool, vertex: bool) -> Handler:
    """A handler that moves the turtle forward, with or without a stroke and a vertex of a polygon."""
    def handler(turtle: Turtle, instruction: Instruction) -> None:
        turtle.forward(instruction.factor * turtle.length + instruction.addend, drawn)
        if vertex and turtle.open_polygons:
            turtle.open_polygons[-1].corners.append(turtle.position)
        if drawn and turtle.restored:
            for name, value in turtle.restored:
                setattr(turtle, name, value)
            turtle.restored = ()
    return handler


def _set_length(turtle: Turtle, instruction: Instruction) -> None:
    turtle.length = _bounded("step", instruction.factor * turtle.length + instruction.addend)


def _set_gravitropism(turtle: Turtle, instruction: Instruction) -> None:
    turtle.gravitropism = _bounded("strength", instruction.factor * turtle.gravitropism + instruction.addend)


def _set_width(turtle: Turtle, instruction: Instruction) -> None:
    before = turtle.first_width if turtle.width == OWN else turtle.width
    turtle.width = max(0.0, _bounded("width", instruction.factor * before + instruction.addend))


def _bounded(what: str, value: float) -> float:
    if not abs(value) <= LARGEST:
        raise ModelValueError(f"The turtle's {what} grows too large to draw: {value:.3g}")
    return value


def _set_colour(turtle: Turtle, instruction: Instruction) -> None:
    turtle.colour = max(0, min(LAST_COLOUR, round(instruction.factor * max(0, turtle.colour) + instruction.addend)))


def _step_colour(turtle: Turtle, instruction: Instruction) -> None:
    """Step through the ramp, or through the colours below it, as far as they go."""
    first, last = (RAMP_START, RAMP_END) if turtle.colour >= RAMP_START else (0, RAMP_START - 1)
    turtle.colour = max(first, min(last, round(turtle.colour + instruction.addend)))


def _reset(name: str) -> Handler:
    return lambda turtle, _: setattr(turtle, name, turtle.initial[name])


def _set_once(name: str, change: Handler) -> Handler:
    def handler(turtle: Turtle, instruction: Instruction) -> None:
        turtle.restored = ((name, getattr(turtle, name)), *turtle.restored)  # the earliest value is set last, and stays
        change(turtle, instruction)
    return handler


def _push(turtle: Turtle, _: Instruction) -> None:
    _check_depth(turtle, turtle.stack)
    turtle.stack.append(_saved_state(turtle))
    turtle.axis = None


def _pop(turtle: Turtle, _: Instruction) -> None:
    if turtle.stack:
        (turtle.position, turtle.orientation, turtle.length, turtle.width, turtle.colour, turtle.gravitropism,
         turtle.tropisms, turtle.last, turtle.restored, turtle.mirror, turtle.second_heading,
         turtle.axis) = turtle.stack.pop()


def _begin_polygon(turtle: Turtle, _: Instruction) -> None:
    _check_depth(turtle, turtle.open_polygons)
    turtle.open_polygons.append(Outline([], turtle.state, turtle.colour))


def _check_depth(turtle: Turtle, opened: Sequence[object]) -> None:
    if len(opened) >= turtle.bracket_limit:
        raise ModelLimitError(f"More than {turtle.bracket_limit:,} brackets are open at once", limit=turtle.bracket_limit)


def _record_vertex(turtle: Turtle, _: Instruction) -> None:
    if turtle.open_polygons:
        turtle.open_polygons[-1].corners.append(turtle.position)


def _end_polygon(turtle: Turtle, _: Instruction) -> None:
    if turtle.open_polygons and len((outline := turtle.open_polygons.pop()).corners) > 2:
        turtle.outlines.append(outline)


def _expect_surface(turtle: Turtle, _: Instruction) -> None:
    turtle.expects_surface = True


def _draw_expected_surface(turtle: Turtle, instruction: Instruction) -> None:
    if turtle.expects_surface:
        turtle.expects_surface = False
        if surface := turtle.surfaces.get(instruction.symbol):
            turtle.draw_surface(surface, instruction.factor * turtle.length + instruction.addend)
        else:
            turtle.unknown[f"~{instruction.symbol}"] = None


def _draw_surface(turtle: Turtle, instruction: Instruction) -> None:
    turtle.draw_surface(surfaces()[instruction.surface], instruction.factor * turtle.length + instruction.addend)


def _draw_round(kind: int) -> Handler:
    def handler(turtle: Turtle, instruction: Instruction) -> None:
        width = instruction.factor * (WIDTH if turtle.width == OWN else turtle.width) + instruction.addend
        turtle.rounds.append(RoundShape(turtle.position, abs(width) / 2, kind, turtle.state, turtle.colour))
    return handler


COMMON_HANDLERS: Mapping[str, Handler] = {
    "draw": forward_handler(True, True), "move": forward_handler(False, True),
    "draw without vertex": forward_handler(True, False), "move without vertex": forward_handler(False, False),
    "set length": _set_length, "reset length": _reset("length"), "set length once": _set_once("length", _set_length),
    "set width": _set_width, "reset width": _reset("width"), "set width once": _set_once("width", _set_width),
    "set gravitropism": _set_gravitropism, "reset gravitropism": _reset("gravitropism"),
    "set gravitropism once": _set_once("gravitropism", _set_gravitropism),
    "set colour": _set_colour, "step colour": _step_colour, "reset colour": _reset("colour"), "push": _push, "pop": _pop,
    "begin polygon": _begin_polygon, "record vertex": _record_vertex, "end polygon": _end_polygon,
    "expect surface": _expect_surface, "draw expected surface": _draw_expected_surface, "draw surface": _draw_surface,
    "draw circle": _draw_round(CIRCLE), "draw disc": _draw_round(DISC), "draw sphere": _draw_round(SPHERE),
}
"""The handlers that the turtles in the plane and in space share, by action."""


def run_turtle(turtle: Turtle, word: Word, handlers: Mapping[str, Handler],
               prepare: Callable[[Instruction], Any] = lambda instruction: instruction) -> None:
    """Interpret a word by a turtle; actions without a handler are skipped.

    Parameters
    ----------
    turtle
        The turtle, at its start.
    word
        The word.
    handlers
        The handlers of this turtle, by action.
    prepare
        The operand of an instruction: computed once for each state, not for each module.

    Raises
    ------
    ModelLimitError
        More brackets are open at once than the limit allows.
    ModelValueError
        A value is too large to draw, or symbolic.
    """
    with _without_garbage_collection():
        compiled = compile_word(word, handlers, prepare)
        turtle.unknown = dict.fromkeys(compiled.unknown)
        turtle.flat = turtle.flat or _surfaces_in(word, compiled) > MOST_CURVED
        for state in counted(word.numbers(), modules_between_checks(compiled.calls.values())):
            turtle.state = state
            for handler, operand in compiled.calls[state]:
                handler(turtle, operand)
        if turtle.expects_surface:
            turtle.unknown["~"] = None


def _surfaces_in(word: Word, compiled: CompiledWord) -> int:
    """How many surfaces a word draws."""
    drawing = {state: many for state, calls in compiled.calls.items()
               if (many := sum(handler in (_expect_surface, _draw_surface) for handler, _ in calls))}
    return sum(drawing.get(state, 0) for state in word.numbers()) if drawing else 0


@contextmanager
def _without_garbage_collection() -> Iterator[None]:
    """Without this, a word of mostly distinct modules spends half of its time in searches for cycles among its instructions."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


class CompiledWord(NamedTuple):
    """A word compiled for a turtle.

    Attributes
    ----------
    calls
        For each state the handlers to be called, each with its operand.
    unknown
        The symbols that look like commands and are none.
    """

    calls: dict[int, list[tuple[Handler, Any]]]
    unknown: tuple[str, ...]


def compile_word(word: Word, handlers: Mapping[str, Handler], prepare: Callable[[Instruction], Any]) -> CompiledWord:
    """Compile a word for a turtle with some handlers."""
    system, drawn = word.states.system, interpretations(word.states, word.numbers())
    calls = {state: [(handlers[instruction.action], prepare(instruction)) for instruction in found
                     if instruction.action in handlers]
             for state, found in counted(instructions(drawn, system.turtle, system.angle).items())}
    return CompiledWord(calls, unknown_commands(drawn, system))
