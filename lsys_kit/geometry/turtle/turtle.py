"""A turtle: what it carries, what it has drawn, and what it does at each action, in the plane and in space.

Its shapes are at its own positions. A word is compiled for a turtle, state by state, and carried out action by action.
"""

from __future__ import annotations

import gc
import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import product
from operator import attrgetter
from typing import Any, NamedTuple, TypeAlias

from lsys_kit.arrays import arrays_pay, np
from lsys_kit.budget import check_budget, counted, current
from lsys_kit.derivation.core.interpretation import interpretations, modules_between_checks
from lsys_kit.derivation.core.words import Word
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.geometry.scene import CIRCLE, DISC, OWN, SPHERE, Discs, Floats, Labels, Polygons
from lsys_kit.geometry.turtle.commands import (
    ACTIONS,
    LARGEST,
    LAST_COLOUR,
    RAMP_END,
    RAMP_START,
    WIDTH,
    Instruction,
    initial_colour,
    initial_width,
    instructions,
    unknown_commands,
)
from lsys_kit.geometry.turtle.scanning import LEAST, Branches, Carried, Commands, interpreted
from lsys_kit.geometry.turtle.surfaces import MOST_CURVED, Face, Surface, surfaces, surfaces_by_symbol
from lsys_kit.geometry.turtle.unfolding import WordBetween
from lsys_kit.notation.model.system import LSystem


class Outline(NamedTuple):
    """The outline of a polygon: the positions of its corners; of a curved surface, the normals there."""

    corners: list[Any]
    state: int
    colour: int
    normals: Sequence[object] = []


class RoundShape(NamedTuple):
    """A circle, disc or sphere."""

    place: object
    radius: float
    kind: int
    state: int
    colour: int


class Writing(NamedTuple):
    """A label."""

    place: object
    text: str
    state: int


def label_text(values: Sequence[float]) -> str:
    """What a label with some values says.

    >>> label_text((2.0, 0.25, -0.0))
    '2, 0.25, 0'
    """
    return ", ".join(f"{value + 0.0:g}" for value in values)


def rectangle(length: float, width: float) -> Face:
    """The corners of a rectangle ahead of a turtle, in its frame.

    >>> rectangle(3, 2)
    ((0.0, -1.0, 0.0), (3, -1.0, 0.0), (3, 1.0, 0.0), (0.0, 1.0, 0.0))
    """
    half = width / 2
    return (0.0, -half, 0.0), (length, -half, 0.0), (length, half, 0.0), (0.0, half, 0.0)


def box_sides(length: float, width: float) -> list[Face]:
    """The six sides of a box ahead of a turtle, or behind it where the length is negative, as wide as it is deep, in its frame.

    Each side has its corners counter-clockwise as seen from outside.

    >>> box_sides(3, 2)[0]
    ((0.0, -1.0, -1.0), (0.0, -1.0, 1.0), (0.0, 1.0, 1.0), (0.0, 1.0, -1.0))
    """
    half = width / 2
    ends = (min(length, 0.0), max(length, 0.0)), (-half, half), (-half, half)
    return [_side(ends, axis, end) for axis, end in product(range(3), (0, 1))]


def _side(ends: Sequence[tuple[float, float]], axis: int, end: int) -> Face:
    """A side of a box, given both ends of each of its axes: that at an end of one of them."""
    around = ((0, 0), (1, 0), (1, 1), (0, 1)) if end else ((0, 0), (0, 1), (1, 1), (1, 0))
    places = [(end, *others) for others in around]
    ahead, left, up = ([between[place[(which - axis) % 3]] for place in places] for which, between in enumerate(ends))
    return tuple(zip(ahead, left, up, strict=True))


def _normals_at_corners(outlines: Sequence[Outline]) -> Floats:
    if not any(outline.normals for outline in outlines):
        return np.empty((0, 3))
    return np.array([normal for outline in outlines for normal in outline.normals or [(0.0, 0.0, 0.0)] * len(outline.corners)])


def collected_labels(written: Sequence[Writing], points: Callable[[list[object]], Floats]) -> Labels:
    """The labels that a turtle has written, given a function from positions to coordinates."""
    return Labels(
        points([each.place for each in written]),
        tuple(each.text for each in written),
        np.array([each.state for each in written], np.int64),
    )


def collected_shapes(
    outlines: Sequence[Outline], rounds: Sequence[RoundShape], points: Callable[[list[object]], Floats]
) -> tuple[Polygons, Discs]:
    """The polygons and discs that a turtle has drawn, given a function from positions to coordinates."""
    sizes = [len(outline.corners) for outline in outlines]
    states, colours = (np.array([outline[field] for outline in outlines], np.int64) for field in (1, 2))
    polygons = Polygons(
        points([corner for outline in outlines for corner in outline.corners]),
        np.cumsum([0, *sizes]),
        states,
        colours,
        _normals_at_corners(outlines),
    )
    discs = Discs(
        points([found.place for found in rounds]),
        np.array([found.radius for found in rounds], np.float64),
        *(np.array([found[field] for found in rounds], np.int64) for field in (2, 3, 4)),
    )
    return polygons, discs


Handler: TypeAlias = Callable[[Any, Any], None]
"""Carries out an instruction, given a turtle and the operand of the instruction."""

PALETTE_SIZE, WHITE = 256, 15
"""The number of Fractint's colours, and the one in which it draws at first."""

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


def _forward(drawn: bool, vertex: bool) -> Handler:
    """An action that moves the turtle forward, with or without a stroke and a vertex of a polygon."""

    def handler(turtle: Turtle, instruction: Instruction) -> None:
        turtle.forward(_size(turtle, instruction), drawn)
        if vertex:
            turtle.record_vertex(turtle.position)
        if drawn and turtle.restored:
            for name, value in turtle.restored:
                setattr(turtle, name, value)
            turtle.restored = ()

    return handler


def _reset(name: str) -> Handler:
    return lambda turtle, _: setattr(turtle, name, turtle.initial[name])


def _set_once(name: str, change: Handler) -> Handler:
    def handler(turtle: Turtle, instruction: Instruction) -> None:
        turtle.restored = ((name, getattr(turtle, name)), *turtle.restored)  # the earliest value is set last, and stays
        change(turtle, instruction)

    return handler


def _draw_round(kind: int) -> Handler:
    def handler(turtle: Turtle, instruction: Instruction) -> None:
        width = instruction.factor * _shape_width(turtle) + instruction.addend
        turtle.rounds.append(RoundShape(turtle.position, turtle.scale * abs(width) / 2, kind, turtle.state, turtle.colour))

    return handler


def _by_second_heading(forward: Handler) -> Handler:
    def handler(turtle: Turtle, instruction: Instruction) -> None:
        orientation, turtle.orientation = turtle.orientation, turtle.initial_orientation(turtle.second_heading)
        forward(turtle, instruction)
        turtle.orientation = orientation

    return handler


def _size(turtle: Turtle, instruction: Instruction) -> float:
    """A length that is drawn or gone: the step, or an argument, at the scale of the turtle."""
    return turtle.scale * (instruction.factor * turtle.length + instruction.addend)


def _shape_width(turtle: Turtle) -> float:
    """The width of shapes without an argument: that of strokes."""
    return WIDTH if turtle.width == OWN else turtle.width


def _bounded(what: str, value: float) -> float:
    if not abs(value) <= LARGEST:
        raise ModelValueError(f"The turtle's {what} grows too large to draw: {value:.3g}")
    return value


class Turtle(ABC):
    """A turtle, with what it carries and what it has drawn.

    position, orientation
        In the plane the number of the path step at whose end the turtle is, and its turns so far; in space a point and a
        frame.
    length, width, colour, gravitropism
        The length of a step, the width and the colour of strokes, and the strength of `RV`.
    scale
        What multiplies all that is drawn: the lengths and the widths of strokes, and the sizes of shapes.
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
    initial
        The values of the attributes that can be reset.
    state
        The state of the module that is being interpreted.
    surfaces
        The surfaces that it can draw, by their symbols.
    in_plane, flat
        Whether it stays in the plane of the picture, where boxes are rectangles; whether it draws surfaces by their outlines.
    """

    __slots__ = (
        "axis",
        "bracket_limit",
        "colour",
        "expects_surface",
        "flat",
        "gravitropism",
        "in_plane",
        "initial",
        "labels",
        "last",
        "length",
        "mirror",
        "open_polygons",
        "orientation",
        "outlines",
        "patches",
        "position",
        "restored",
        "rounds",
        "scale",
        "second_heading",
        "stack",
        "state",
        "surfaces",
        "tropisms",
        "unknown",
        "width",
    )

    def __init__(self, position: object, orientation: object, step: float) -> None:
        self.position, self.orientation = position, orientation
        self.last: int | None = None
        self.length, self.width, self.colour, self.gravitropism = step, float(OWN), OWN, 0.0
        self.scale = 1.0
        self.mirror, self.second_heading = 1, 0.0
        self.tropisms: Mapping[float, tuple[float, float, float]] = {}
        self.axis: object = None
        self.patches: dict[float, dict[tuple[float, float], object]] = {}
        self.restored: tuple[tuple[str, float], ...] = ()
        self.initial = {name: getattr(self, name) for name in ("length", "width", "colour", "gravitropism")}
        self.state, self.expects_surface = -1, False
        self.stack: list[tuple[Any, ...]] = []
        self.bracket_limit = current().brackets
        self.open_polygons: list[Outline] = []
        self.outlines: list[Outline] = []
        self.rounds: list[RoundShape] = []
        self.labels: list[Writing] = []
        self.unknown: dict[str, None] = {}
        self.surfaces: Mapping[str, Surface] = {}
        self.in_plane = self.flat = False

    def take_look(self, system: LSystem) -> None:
        """Take the colour and width with which the turtle of a system begins, as those that can be reset, and its surfaces."""
        self.width = self.initial["width"] = initial_width(system)
        self.colour = self.initial["colour"] = initial_colour(system)
        self.surfaces = surfaces_by_symbol(system)

    @property
    def stroke_width(self) -> float:
        return self.width * self.scale if self.width > 0 else self.width

    def check_depth(self, opened: int) -> None:
        if opened >= self.bracket_limit:
            raise ModelLimitError(f"More than {self.bracket_limit:,} brackets are open at once", limit=self.bracket_limit)

    @abstractmethod
    def scanned_orientation(
        self, commands: Commands, branches: Branches, carried: Carried, prepare: Callable[[Instruction], Any]
    ) -> Any:
        """The orientation after each command, as columns, by scans along the branches."""

    @abstractmethod
    def scanned_position(self, commands: Commands, branches: Branches, carried: Carried, orientation: Any) -> Any:
        """The position after each command, as columns; all strokes are taken down."""

    @abstractmethod
    def forward(self, length: float, drawn: bool) -> None:
        """Move forward, with or without a stroke."""

    @abstractmethod
    def initial_orientation(self, degrees: float) -> object:
        """The initial orientation, turned to the left by some degrees."""

    @abstractmethod
    def local_point(self, ahead: float, left: float, up: float) -> object:
        """A point given by its coordinates in the frame of the turtle."""

    def record_vertex(self, place: object) -> None:
        if self.open_polygons:
            self.open_polygons[-1].corners.append(place)

    def draw_surface(self, surface: Surface, size: float) -> None:
        """Draw a surface at the position of the turtle: in the plane its outlines."""
        if size:
            self.draw_faces(surface.facets.outlines, size)

    def draw_box(self, length: float, width: float) -> None:
        """Draw a box ahead: in the plane a rectangle."""
        self.draw_faces([rectangle(length, width)] if self.in_plane else box_sides(length, width))

    def draw_faces(self, faces: Iterable[Face], size: float = 1.0) -> None:
        check_budget()  # one surface may have thousands of corners
        self.outlines += [Outline(self.local_points(face, size), self.state, self.colour) for face in faces]

    def local_points(self, face: Face, size: float) -> list[object]:
        """The corners of a face of a surface of some size."""
        return [self.local_point(size * ahead, size * left, size * up) for ahead, left, up in face]

    # What it does at each action of the table: the method with the name of the action

    do_draw, do_move = _forward(True, True), _forward(False, True)
    do_draw_without_vertex, do_move_without_vertex = _forward(True, False), _forward(False, False)

    def do_set_length(self, instruction: Instruction) -> None:
        self.length = _bounded("step", instruction.factor * self.length + instruction.addend)

    do_reset_length, do_set_length_once = _reset("length"), _set_once("length", do_set_length)

    def do_set_gravitropism(self, instruction: Instruction) -> None:
        self.gravitropism = _bounded("strength", instruction.factor * self.gravitropism + instruction.addend)

    do_reset_gravitropism, do_set_gravitropism_once = _reset("gravitropism"), _set_once("gravitropism", do_set_gravitropism)

    def do_set_width(self, instruction: Instruction) -> None:
        self.width = max(0.0, _bounded("width", instruction.factor * self.width + instruction.addend))

    do_reset_width, do_set_width_once = _reset("width"), _set_once("width", do_set_width)

    def do_set_scale(self, instruction: Instruction) -> None:
        self.scale = max(0.0, _bounded("scale", instruction.factor * self.scale + instruction.addend))

    def do_set_colour(self, instruction: Instruction) -> None:
        self.colour = max(0, min(LAST_COLOUR, round(instruction.factor * max(0, self.colour) + instruction.addend)))

    do_reset_colour = _reset("colour")

    def do_step_colour(self, instruction: Instruction) -> None:
        """Step through the ramp, or through the colours below it, as far as they go."""
        first, last = (RAMP_START, RAMP_END) if self.colour >= RAMP_START else (0, RAMP_START - 1)
        self.colour = max(first, min(last, round(self.colour + instruction.addend)))

    def do_push(self, _: Instruction) -> None:
        self.check_depth(len(self.stack))
        self.stack.append(_saved_state(self))
        self.axis = None

    def do_pop(self, _: Instruction) -> None:
        if self.stack:
            (
                self.position,
                self.orientation,
                self.length,
                self.width,
                self.colour,
                self.gravitropism,
                self.tropisms,
                self.last,
                self.restored,
                self.mirror,
                self.second_heading,
                self.axis,
                self.scale,
            ) = self.stack.pop()

    def do_begin_polygon(self, _: Instruction) -> None:
        self.check_depth(len(self.open_polygons))
        self.open_polygons.append(Outline([], self.state, self.colour))

    def do_record_vertex(self, _: Instruction) -> None:
        self.record_vertex(self.position)

    def do_end_polygon(self, _: Instruction) -> None:
        if self.open_polygons and len((outline := self.open_polygons.pop()).corners) > 2:
            self.outlines.append(outline)

    def do_expect_surface(self, _: Instruction) -> None:
        self.expects_surface = True

    def do_draw_expected_surface(self, instruction: Instruction) -> None:
        if self.expects_surface:
            self.expects_surface = False
            if surface := self.surfaces.get(instruction.symbol):
                self.draw_surface(surface, _size(self, instruction))
            else:
                self.unknown[f"~{instruction.symbol}"] = None

    def do_draw_surface(self, instruction: Instruction) -> None:
        self.draw_surface(surfaces()[instruction.surface], _size(self, instruction))

    do_draw_circle, do_draw_disc, do_draw_sphere = _draw_round(CIRCLE), _draw_round(DISC), _draw_round(SPHERE)

    def do_draw_box(self, instruction: Instruction) -> None:
        """Draw a box ahead: `@B`, `@B(length)` or `@B(length, width)`."""
        length, width = _size(self, instruction), instruction.values[1] if len(instruction.values) > 1 else _shape_width(self)
        if length and width:
            self.draw_box(length, self.scale * abs(width))

    def do_draw_label(self, instruction: Instruction) -> None:
        if instruction.values:
            self.labels.append(Writing(self.position, label_text(instruction.values), self.state))

    # Fractint's turtle has a second heading, mirrored turns and a palette of 256 colours: `+`, `-` and `|` turn the heading of
    # `F` and `G`; `D` and `M` follow a second heading, which only `\` and `/` turn, by degrees.

    do_draw_by_second_heading, do_move_by_second_heading = _by_second_heading(do_draw), _by_second_heading(do_move)

    def do_turn_second_heading(self, instruction: Instruction) -> None:
        self.second_heading += self.mirror * instruction.addend

    def do_mirror_turns(self, _: Instruction) -> None:
        self.mirror = -self.mirror

    def do_set_palette_colour(self, instruction: Instruction) -> None:
        """Set a colour modulo 256; a step never leads to colour 0, that of the background."""
        colour = WHITE if self.colour == OWN else self.colour
        colour = math.floor(instruction.factor * colour + instruction.addend) % PALETTE_SIZE
        step = instruction.factor != 0
        self.colour = colour or (0 if not step else 1 if instruction.addend > 0 else PALETTE_SIZE - 1)


def handlers_of(turtle: type[Turtle]) -> dict[str, Handler]:
    """What carries out each action that a kind of turtles knows."""
    methods = {action: getattr(turtle, f"do_{action.replace(' ', '_')}", None) for action in ACTIONS}
    return {action: method for action, method in methods.items() if method}


def run_turtle(
    turtle: Turtle,
    word: Word | WordBetween,
    handlers: Mapping[str, Handler],
    prepare: Callable[[Instruction], object] = lambda instruction: instruction,
) -> None:
    """Interpret a word by a turtle; actions without a handler are skipped."""
    with _without_garbage_collection():
        if isinstance(word, Word) and arrays_pay(len(word), LEAST) and interpreted(turtle, word, handlers, prepare):
            return
        compiled = compile_word(word, handlers, prepare)
        turtle.unknown = dict.fromkeys(compiled.unknown)
        turtle.flat = turtle.in_plane or _surfaces_in(word, compiled) > MOST_CURVED
        for state in counted(word.numbers(), modules_between_checks(compiled.calls.values())):
            turtle.state = state
            for handler, operand in compiled.calls[state]:
                handler(turtle, operand)
        if turtle.expects_surface:
            turtle.unknown["~"] = None


def _surfaces_in(word: Word | WordBetween, compiled: CompiledWord) -> int:
    drawing = {
        state: many
        for state, calls in compiled.calls.items()
        if (many := sum(handler in (Turtle.do_expect_surface, Turtle.do_draw_surface) for handler, _ in calls))
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

    calls
        For each state the handlers to be called, each with its operand.
    unknown
        The symbols that look like commands and are none.
    """

    calls: dict[int, list[tuple[Handler, object]]]
    unknown: tuple[str, ...]


def compile_word(
    word: Word | WordBetween, handlers: Mapping[str, Handler], prepare: Callable[[Instruction], object]
) -> CompiledWord:
    if isinstance(word, WordBetween):
        rows = counted(range(len(word.calls)))
        return CompiledWord({number: _calls_between(word, number, handlers, prepare) for number in rows}, ())
    system, drawn = word.states.system, interpretations(word.states, word.numbers())
    calls = {
        state: [(handlers[instruction.action], prepare(instruction)) for instruction in found if instruction.action in handlers]
        for state, found in counted(instructions(drawn, system.turtle, system.angle).items())
    }
    return CompiledWord(calls, unknown_commands(drawn, system))


def _calls_between(
    word: WordBetween, number: int, handlers: Mapping[str, Handler], prepare: Callable[[Instruction], object]
) -> list[tuple[Handler, object]]:
    """What is called for a module of a word between two steps; first of all it takes the look of a state."""
    found = [(handlers[each.action], prepare(each)) for each in word.calls[number] if each.action in handlers]
    return [(_look_like, word.looks[number]), *found]


def _look_like(turtle: Turtle, state: int) -> None:
    turtle.state = state
