"""A turtle: what it carries and what it has drawn, in the plane and in space; its shapes are at its own positions."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from lsys_kit.budget import check_budget, current
from lsys_kit.geometry.scene import OWN, Discs, Floats, Labels, Polygons
from lsys_kit.geometry.turtle.commands import WIDTH, initial_colour
from lsys_kit.geometry.turtle.surfaces import Face, Surface, surfaces_by_symbol
from lsys_kit.notation.model.system import LSystem


class Outline(NamedTuple):
    """The outline of a polygon: the positions of its corners; of a curved surface, the normals there."""

    corners: list[Any]
    state: int
    colour: int
    normals: list[Any] = []  # noqa: RUF012


class RoundShape(NamedTuple):
    """A circle, disc or sphere."""

    place: Any
    radius: float
    kind: int
    state: int
    colour: int


class Writing(NamedTuple):
    """A label."""

    place: Any
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


def collected_labels(written: Sequence[Writing], points: Callable[[list[Any]], Floats]) -> Labels:
    """The labels that a turtle has written, given a function from positions to coordinates."""
    return Labels(
        points([each.place for each in written]),
        tuple(each.text for each in written),
        np.array([each.state for each in written], np.int64),
    )


def collected_shapes(
    outlines: Sequence[Outline], rounds: Sequence[RoundShape], points: Callable[[list[Any]], Floats]
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


class Turtle(ABC):
    """A turtle, with what it carries and what it has drawn.

    Attributes
    ----------
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
    first_width
        The width from which commands start that change it, where none has been set.
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
        "first_width",
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

    def __init__(self, position: Any, orientation: Any, step: float, first_width: float = WIDTH) -> None:
        self.position, self.orientation = position, orientation
        self.last: Any = None
        self.length, self.width, self.colour, self.gravitropism = step, float(OWN), OWN, 0.0
        self.scale = 1.0
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
        self.labels: list[Writing] = []
        self.unknown: dict[str, None] = {}
        self.surfaces: Mapping[str, Surface] = {}
        self.in_plane = self.flat = False

    def take_look(self, system: LSystem) -> None:
        """Take the colour with which the turtle of a system begins, as the one that can be reset, and its surfaces."""
        self.colour = self.initial["colour"] = initial_colour(system)
        self.surfaces = surfaces_by_symbol(system)

    @property
    def stroke_width(self) -> float:
        return self.width * self.scale if self.width > 0 else self.width

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
            self.draw_faces(surface.outlines, size)

    def draw_box(self, length: float, width: float) -> None:
        """Draw a box ahead: in the plane a rectangle."""
        self.draw_faces([rectangle(length, width)] if self.in_plane else box_sides(length, width))

    def draw_faces(self, faces: Iterable[Face], size: float = 1.0) -> None:
        check_budget()  # one surface may have thousands of corners
        self.outlines += [Outline(self.local_points(face, size), self.state, self.colour) for face in faces]

    def local_points(self, face: Face, size: float) -> list[Any]:
        """The corners of a face of a surface of some size."""
        return [self.local_point(size * ahead, size * left, size * up) for ahead, left, up in face]
