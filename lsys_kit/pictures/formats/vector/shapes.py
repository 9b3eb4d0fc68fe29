"""The shapes of which a picture consists, from the first to the last painted: outlines, spheres, texts and images.

Every picture of the kit is written as SVG. `reading` reads that back as a list of these shapes, and from the list each other
format is painted, by one painter for a format. So a text, a dash or a mark cannot be in one format and be missing in another.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

Point: TypeAlias = tuple[float, float]


class Place(NamedTuple):
    """Where the units of a shape lie in a picture: how many pixels a unit has, and the pixel of its origin."""

    scale: float = 1.0
    x: float = 0.0
    y: float = 0.0

    def within(self, scale: float, x: float, y: float) -> Place:
        """The place of units that lie in these.

        >>> Place(0.1, 5, 6).within(10, 20, 30)
        Place(scale=1.0, x=7.0, y=9.0)
        """
        return Place(self.scale * scale, self.x + self.scale * x, self.y + self.scale * y)


class Look(NamedTuple):
    """How an outline is painted: the colours inside and of its line, "" for none; and the line's width, ends and dashes."""

    fill: str = ""
    stroke: str = ""
    width: float = 1.0
    round_ends: bool = False
    dashes: tuple[float, ...] = ()
    fill_opacity: float = 1.0
    stroke_opacity: float = 1.0
    evenodd: bool = False


class Outline(NamedTuple):
    """A path of straight lines and cubic curves, in the form that `paths.plain` gives it."""

    data: str
    look: Look
    place: Place


class Stop(NamedTuple):
    """A colour of a gradient: at which part of the way, and how opaque."""

    offset: float
    colour: str
    opacity: float


class Gradient(NamedTuple):
    """Colours around a point, and the radius at which the last is reached, in a square around a circle, whose side is 1."""

    x: float
    y: float
    radius: float
    stops: tuple[Stop, ...]


class Sphere(NamedTuple):
    """A circle filled with a gradient."""

    x: float
    y: float
    radius: float
    gradient: Gradient
    place: Place


class Font(NamedTuple):
    """A family of letters, "sans-serif", "serif" or "monospace", and whether they are bold."""

    family: str = "sans-serif"
    bold: bool = False


class Run(NamedTuple):
    """A stretch of text: from where on its baseline, its size, and whether it leans."""

    x: float
    y: float
    text: str
    size: float
    italic: bool


class Text(NamedTuple):
    """A text in stretches, its colour, and the colour and width of a line around its letters that lies behind them."""

    runs: Sequence[Run]
    font: Font
    colour: str
    halo: str
    halo_width: float
    place: Place


class Raster(NamedTuple):
    """An image: its left upper corner, its size, and its content as PNG."""

    x: float
    y: float
    width: float
    height: float
    png: bytes
    place: Place


Shape: TypeAlias = Outline | Sphere | Text | Raster


@dataclass(frozen=True)
class Drawing:
    """The shapes of a picture, its size in pixels, and what it shows, in words."""

    width: int
    height: int
    title: str
    shapes: Sequence[Shape]
