"""A turtle: what it carries and what it has drawn, in the plane and in space."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from typing import Any

from lsys_kit.budget import check_budget, current
from lsys_kit.geometry.scene import OWN
from lsys_kit.geometry.turtle.commands.table import WIDTH, initial_colour
from lsys_kit.geometry.turtle.patches import Face
from lsys_kit.geometry.turtle.shapes import Outline, RoundShape, Writing, box_sides, rectangle
from lsys_kit.geometry.turtle.surfaces import Surface, surfaces_by_symbol
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
        """The width of strokes, at the scale of the turtle."""
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
        """Draw flat faces, given in the frame of the turtle."""
        check_budget()  # one surface may have thousands of corners
        self.outlines += [Outline(self.local_points(face, size), self.state, self.colour) for face in faces]

    def local_points(self, face: Face, size: float) -> list[Any]:
        """The corners of a face of a surface of some size."""
        return [self.local_point(size * ahead, size * left, size * up) for ahead, left, up in face]
