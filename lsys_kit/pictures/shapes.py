"""The display list: the typed shapes of which every picture consists, from the first to the last painted.

Whatever is drawn becomes these shapes, and each format is one class that paints them. So a text, a dash or a mark cannot be in
one format and be missing in another. Shapes and their looks are named as in SVG, which is written from them word for word.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal, NamedTuple, TypeAlias, TypedDict

from lsys_kit.geometry.scene import Integers

Tags: TypeAlias = Mapping[str, object]
"""What a page may find a shape by: its class, or the number of what it shows."""
UNTAGGED: Tags = MappingProxyType({})


class Place(NamedTuple):
    """Where the units of a shape lie in those around it: how many of those one is, and the point of the origin."""

    scale: float = 1
    x: float = 0
    y: float = 0


def place_within(outer: Place, inner: Place | None) -> Place:
    """The place of units that lie in others, which have a place themselves.

    >>> place_within(Place(0.1, 5, 6), Place(10, 20, 30))
    Place(scale=1.0, x=7.0, y=9.0)
    """
    if inner is None:
        return outer
    return Place(outer.scale * inner.scale, outer.x + outer.scale * inner.x, outer.y + outer.scale * inner.y)


class Stop(NamedTuple):
    """A colour of a gradient: at which part of the way, and how opaque."""

    offset: float
    colour: str
    opacity: float = 1


class Gradient(NamedTuple):
    """Colours around a point, and the radius at which the last is reached, in a square around a circle, whose side is 1."""

    name: str
    x: float
    y: float
    radius: float
    stops: tuple[Stop, ...]


class Look(TypedDict, total=False):
    """How a shape looks. What a group says holds for all that is in it."""

    fill: str | Gradient
    stroke: str
    stroke_width: float
    stroke_linecap: Literal["round"]
    stroke_linejoin: Literal["round"]
    stroke_dasharray: str
    fill_opacity: float
    stroke_opacity: float
    fill_rule: Literal["evenodd"]
    font_size: float | str
    font_family: str
    font_weight: Literal["bold"]
    font_style: Literal["italic"]
    text_anchor: Literal["middle", "end"]
    paint_order: Literal["stroke"]
    dy: int


class Path(NamedTuple):
    """A line of straight pieces and curves, as SVG writes it."""

    data: str
    look: Look = Look()
    tags: Tags = UNTAGGED


class Strokes(NamedTuple):
    """Straight lines from point to point, shape (n, 4)."""

    ends: Integers
    look: Look = Look()
    tags: Tags = UNTAGGED


class Polygon(NamedTuple):
    """A polygon, by its corners."""

    corners: list[Sequence[int]]
    look: Look = Look()
    tags: Tags = UNTAGGED


class Circle(NamedTuple):
    """A circle: its centre and its radius."""

    x: float
    y: float
    radius: float
    look: Look = Look()
    tags: Tags = UNTAGGED


class Ellipse(NamedTuple):
    """An ellipse: its centre, and its half axes."""

    x: float
    y: float
    across: float
    up: float
    look: Look = Look()
    tags: Tags = UNTAGGED


class Rectangle(NamedTuple):
    """A rectangle: its left upper corner, None for that of the picture, its size, and perhaps the radius of its corners."""

    x: float | None
    y: float | None
    width: float
    height: float
    corner: float | None = None
    look: Look = Look()
    tags: Tags = UNTAGGED


class Paper(NamedTuple):
    """A ground as large as the picture."""

    colour: str


class Raster(NamedTuple):
    """An image: its left upper corner, None for that of the picture, its size, and its content as PNG."""

    x: float | None
    y: float | None
    width: float
    height: float
    png: bytes
    look: Look = Look()
    tags: Tags = UNTAGGED


class Title(NamedTuple):
    """What something is, in words, which are shown where one points at it."""

    text: str


class Span(NamedTuple):
    """A piece of text with a look of its own."""

    text: str
    look: Look


class Text(NamedTuple):
    """A text in one or several pieces, from a point of its baseline; or at the origin of its own units."""

    x: float | None
    y: float | None
    inside: str | Sequence[str | Span | Title]
    look: Look = Look()
    tags: Tags = UNTAGGED
    place: Place | None = None


class Gradients(NamedTuple):
    """The gradients that shapes behind it have."""

    gradients: Sequence[Gradient]


class Group(NamedTuple):
    """Shapes with something in common: their look, their units, or what they are."""

    shapes: Sequence[Shape]
    look: Look = Look()
    tags: Tags = UNTAGGED
    place: Place | None = None


Outlined: TypeAlias = Path | Strokes | Polygon | Circle | Ellipse | Rectangle
Shape: TypeAlias = Outlined | Text | Raster | Group | Title | Gradients | Paper


def has_pixels(shapes: Sequence[Shape]) -> bool:
    """Whether there is an image among some shapes."""
    return any(isinstance(each, Raster) or (isinstance(each, Group) and has_pixels(each.shapes)) for each in shapes)


@dataclass(frozen=True)
class Drawing:
    """A picture: its size in pixels, what it shows, in words, and its shapes.

    Attributes
    ----------
    box
        The left upper corner, the width and the height of what is seen of them, in their units.
    look
        How they look as far as they do not say.
    """

    width: int
    height: int
    title: str
    shapes: Sequence[Shape]
    box: tuple[int, int, int, int]
    look: Look

    @property
    def place(self) -> Place:
        """Where the units of the shapes lie in the picture."""
        left, top, across, _ = self.box
        scale = self.width / across
        return Place(scale, -left * scale, -top * scale)
