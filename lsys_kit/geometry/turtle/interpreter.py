"""The turtle interpreter: a word is compiled for a turtle, state by state, and carried out by a handler for each action.

Here are the handlers that do not depend on the dimension of a turtle. Fractint's turtle has a second heading, mirrored turns
and a palette of 256 colours: `+`, `-` and `|` turn the heading of `F` and `G`; `D` and `M` follow a second heading, which only
`\\` and `/` turn, by degrees.
"""

from __future__ import annotations

import gc
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from operator import attrgetter
from typing import Any, NamedTuple, TypeAlias

from lsys_kit.budget import counted
from lsys_kit.derivation.core.interpretation import interpretations, modules_between_checks
from lsys_kit.derivation.core.words import Word
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.geometry.scene import CIRCLE, DISC, OWN, SPHERE
from lsys_kit.geometry.turtle.commands import LARGEST, RAMP_END, RAMP_START, WIDTH, Instruction, instructions, unknown_commands
from lsys_kit.geometry.turtle.surfaces import surfaces
from lsys_kit.geometry.turtle.turtle import Outline, RoundShape, Turtle, Writing, label_text

LAST_COLOUR = 2**31 - 1
"""The greatest number of a colour."""

Handler: TypeAlias = Callable[[Any, Any], None]
"""Carries out an instruction, given a turtle and the operand of the instruction."""

_SAVED_ATTRIBUTES = (
    "position",
    "orientation",
    "length",
    "width",
    "colour",
    "gravitropism",
    "tropisms",
    "last",
    "restored",
    "mirror",
    "second_heading",
    "axis",
    "scale",
)
_saved_state = attrgetter(*_SAVED_ATTRIBUTES)


def forward_handler(drawn: bool, vertex: bool) -> Handler:
    """A handler that moves the turtle forward, with or without a stroke and a vertex of a polygon."""

    def handler(turtle: Turtle, instruction: Instruction) -> None:
        turtle.forward(_size(turtle, instruction), drawn)
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


def _set_scale(turtle: Turtle, instruction: Instruction) -> None:
    turtle.scale = max(0.0, _bounded("scale", instruction.factor * turtle.scale + instruction.addend))


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
        (
            turtle.position,
            turtle.orientation,
            turtle.length,
            turtle.width,
            turtle.colour,
            turtle.gravitropism,
            turtle.tropisms,
            turtle.last,
            turtle.restored,
            turtle.mirror,
            turtle.second_heading,
            turtle.axis,
            turtle.scale,
        ) = turtle.stack.pop()


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


def expect_surface(turtle: Turtle, _: Instruction) -> None:
    turtle.expects_surface = True


def _draw_expected_surface(turtle: Turtle, instruction: Instruction) -> None:
    if turtle.expects_surface:
        turtle.expects_surface = False
        if surface := turtle.surfaces.get(instruction.symbol):
            turtle.draw_surface(surface, _size(turtle, instruction))
        else:
            turtle.unknown[f"~{instruction.symbol}"] = None


def draw_surface(turtle: Turtle, instruction: Instruction) -> None:
    turtle.draw_surface(surfaces()[instruction.surface], _size(turtle, instruction))


def _size(turtle: Turtle, instruction: Instruction) -> float:
    """A length that is drawn or gone: the step, or an argument, at the scale of the turtle."""
    return turtle.scale * (instruction.factor * turtle.length + instruction.addend)


def _draw_round(kind: int) -> Handler:
    def handler(turtle: Turtle, instruction: Instruction) -> None:
        width = instruction.factor * _shape_width(turtle) + instruction.addend
        turtle.rounds.append(RoundShape(turtle.position, turtle.scale * abs(width) / 2, kind, turtle.state, turtle.colour))

    return handler


def _draw_box(turtle: Turtle, instruction: Instruction) -> None:
    """Draw a box ahead: `@B`, `@B(length)` or `@B(length, width)`."""
    length, width = _size(turtle, instruction), instruction.values[1] if len(instruction.values) > 1 else _shape_width(turtle)
    if length and width:
        turtle.draw_box(length, turtle.scale * abs(width))


def _shape_width(turtle: Turtle) -> float:
    """The width of shapes without an argument: that of strokes."""
    return WIDTH if turtle.width == OWN else turtle.width


def _draw_label(turtle: Turtle, instruction: Instruction) -> None:
    if instruction.values:
        turtle.labels.append(Writing(turtle.position, label_text(instruction.values), turtle.state))


COMMON_HANDLERS: Mapping[str, Handler] = {
    "draw": forward_handler(True, True),
    "move": forward_handler(False, True),
    "draw without vertex": forward_handler(True, False),
    "move without vertex": forward_handler(False, False),
    "set length": _set_length,
    "reset length": _reset("length"),
    "set length once": _set_once("length", _set_length),
    "set width": _set_width,
    "reset width": _reset("width"),
    "set width once": _set_once("width", _set_width),
    "set scale": _set_scale,
    "set gravitropism": _set_gravitropism,
    "reset gravitropism": _reset("gravitropism"),
    "set gravitropism once": _set_once("gravitropism", _set_gravitropism),
    "set colour": _set_colour,
    "step colour": _step_colour,
    "reset colour": _reset("colour"),
    "push": _push,
    "pop": _pop,
    "begin polygon": _begin_polygon,
    "record vertex": _record_vertex,
    "end polygon": _end_polygon,
    "expect surface": expect_surface,
    "draw expected surface": _draw_expected_surface,
    "draw surface": draw_surface,
    "draw circle": _draw_round(CIRCLE),
    "draw disc": _draw_round(DISC),
    "draw sphere": _draw_round(SPHERE),
    "draw box": _draw_box,
    "draw label": _draw_label,
}
"""The handlers that the turtles in the plane and in space share, by action."""


PALETTE_SIZE, WHITE = 256, 15
"""The number of Fractint's colours, and the one in which it draws at first."""


def _set_palette_colour(turtle: Turtle, instruction: Instruction) -> None:
    """Set a colour modulo 256; a step never leads to colour 0, that of the background."""
    colour = WHITE if turtle.colour == OWN else turtle.colour
    colour = math.floor(instruction.factor * colour + instruction.addend) % PALETTE_SIZE
    step = instruction.factor != 0
    turtle.colour = colour or (0 if not step else 1 if instruction.addend > 0 else PALETTE_SIZE - 1)


def _forward_by_second_heading(drawn: bool) -> Handler:
    forward = forward_handler(drawn, True)

    def handler(turtle: Turtle, instruction: Instruction) -> None:
        orientation, turtle.orientation = turtle.orientation, turtle.initial_orientation(turtle.second_heading)
        forward(turtle, instruction)
        turtle.orientation = orientation

    return handler


def _turn_second_heading(turtle: Turtle, instruction: Instruction) -> None:
    turtle.second_heading += turtle.mirror * instruction.addend


def _mirror_turns(turtle: Turtle, _: Instruction) -> None:
    turtle.mirror = -turtle.mirror


FRACTINT_HANDLERS: Mapping[str, Handler] = {
    "draw by second heading": _forward_by_second_heading(True),
    "move by second heading": _forward_by_second_heading(False),
    "turn second heading": _turn_second_heading,
    "mirror turns": _mirror_turns,
    "set palette colour": _set_palette_colour,
}
"""The handlers, by action."""


MOST_CURVED = 150
"""Where more surfaces are drawn, each is drawn by its outlines: one sees little of its curvature."""


def run_turtle(
    turtle: Turtle,
    word: Word,
    handlers: Mapping[str, Handler],
    prepare: Callable[[Instruction], Any] = lambda instruction: instruction,
) -> None:
    """Interpret a word by a turtle; actions without a handler are skipped."""
    with _without_garbage_collection():
        compiled = compile_word(word, handlers, prepare)
        turtle.unknown = dict.fromkeys(compiled.unknown)
        turtle.flat = turtle.in_plane or _surfaces_in(word, compiled) > MOST_CURVED
        for state in counted(word.numbers(), modules_between_checks(compiled.calls.values())):
            turtle.state = state
            for handler, operand in compiled.calls[state]:
                handler(turtle, operand)
        if turtle.expects_surface:
            turtle.unknown["~"] = None


def _surfaces_in(word: Word, compiled: CompiledWord) -> int:
    drawing = {
        state: many
        for state, calls in compiled.calls.items()
        if (many := sum(handler in (expect_surface, draw_surface) for handler, _ in calls))
    }
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
    system, drawn = word.states.system, interpretations(word.states, word.numbers())
    calls = {
        state: [(handlers[instruction.action], prepare(instruction)) for instruction in found if instruction.action in handlers]
        for state, found in counted(instructions(drawn, system.turtle, system.angle).items())
    }
    return CompiledWord(calls, unknown_commands(drawn, system))
