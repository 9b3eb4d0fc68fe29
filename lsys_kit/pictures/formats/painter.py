"""How the shapes of a picture are painted in any format: walked through in their order, each with the look that groups pass on.

A format is a painter with a method for outlines, spheres, texts and images.
"""

from __future__ import annotations

import math
import re
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from typing import NamedTuple, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import counted
from lsys_kit.geometry.scene import Floats
from lsys_kit.pictures.formats.lettering import Font, advance
from lsys_kit.pictures.shapes import (
    Circle,
    Drawing,
    Ellipse,
    Gradient,
    Gradients,
    Group,
    Look,
    Outlined,
    Paper,
    Path,
    Place,
    Polygon,
    Raster,
    Rectangle,
    Shape,
    Strokes,
    Text,
    Title,
    place_within,
)
from lsys_kit.pictures.style.labels import visible

Point: TypeAlias = tuple[float, float]
Command: TypeAlias = tuple[str, Sequence[Point]]
"""A step of a path, in absolute points: "M" to a point, "L" by a line, "C" by a cubic curve, or "Z", which closes it."""
ARC = 0.5522847498
"""How far the controls of a quarter of a circle lie along its tangents, to the radius."""
LEAST_PIECES = 3
"""A curve has so many straight pieces at least, and as many as the square root of its length: then none is seen."""
_COMMAND = re.compile(r"([MLHVQCZmlhvqcz])([^MLHVQCZmlhvqcz]*)")
_FAMILIES = ("monospace", "sans-serif", "serif")
_SHIFT = {"start": 0.0, "middle": 0.5, "end": 1.0}


class Ink(NamedTuple):
    """How an outline is painted: the colours inside and of its line, "" for none; and the line's width, ends and dashes."""

    fill: str
    stroke: str
    width: float
    round_ends: bool
    dashes: tuple[float, ...]
    fill_opacity: float
    stroke_opacity: float
    evenodd: bool


class Run(NamedTuple):
    """A stretch of text: from where on its baseline, its size, and whether it leans."""

    x: float
    y: float
    text: str
    size: float
    italic: bool


class Lettering(NamedTuple):
    """A text in stretches, its colour, and the colour and width of a line around its letters that lies behind them."""

    runs: Sequence[Run]
    font: Font
    colour: str
    halo: str
    halo_width: float


class Subpath(NamedTuple):
    """A line through corners, and whether it is closed."""

    corners: Floats
    closed: bool


class Painter(ABC):
    """What paints shapes in a format."""

    def draw(self, drawing: Drawing) -> None:
        """Paint a picture."""
        self._box = drawing.box
        self.paint(drawing.shapes, drawing.look, drawing.place)

    def paint(self, shapes: Sequence[Shape], look: Look, place: Place) -> None:
        """Paint shapes whose units lie at a place of the picture."""
        for shape in counted(shapes):
            if isinstance(shape, Title | Gradients):
                continue
            if isinstance(shape, Paper):
                shape = Rectangle(*self._box, look=Look(fill=shape.colour))
            own: Look = {**look, **shape.look}
            if isinstance(shape, Group):
                self.paint(shape.shapes, own, place_within(place, shape.place))
            elif isinstance(shape, Text):
                self.text(lettering(shape, own), place_within(place, shape.place))
            elif isinstance(shape, Raster):
                self.raster(shape, place)
            else:
                self._outlined(shape, own, place)

    def _outlined(self, shape: Outlined, look: Look, place: Place) -> None:
        fill, stroke = look.get("fill", "#000000"), look.get("stroke", "none")
        if isinstance(fill, Gradient):
            assert isinstance(shape, Circle)
            self.sphere(shape, fill, place)
            fill = ""
        ink = Ink(
            fill.replace("none", ""),
            stroke.replace("none", ""),
            look.get("stroke_width", 1),
            "stroke_linecap" in look,
            tuple(map(float, look.get("stroke_dasharray", "").split())),
            look.get("fill_opacity", 1),
            look.get("stroke_opacity", 1),
            "fill_rule" in look,
        )
        if (ink.fill or ink.stroke) and not (isinstance(shape, Path) and not shape.data):
            self.outline(shape, ink, place)

    @abstractmethod
    def outline(self, shape: Outlined, ink: Ink, place: Place) -> None:
        """Paint what is filled, or has a line around it."""

    @abstractmethod
    def sphere(self, circle: Circle, gradient: Gradient, place: Place) -> None:
        """Paint a circle filled with a gradient."""

    @abstractmethod
    def text(self, text: Lettering, place: Place) -> None:
        """Write a text."""

    @abstractmethod
    def raster(self, raster: Raster, place: Place) -> None:
        """Paint an image."""


def lettering(text: Text, look: Look) -> Lettering:
    """A text with its stretches, as wide as its letters are in the kit's font."""
    (x, y), size, family = _tenths(text.x, text.y), float(look.get("font_size", 16)), look.get("font_family", "")
    start = x
    font = Font(next((name for name in _FAMILIES if name in family), "sans-serif"), "font_weight" in look)
    runs: list[Run] = []
    for each in [text.inside] if isinstance(text.inside, str) else text.inside:
        if each == "" or isinstance(each, Title):
            continue
        written, own = (each, Look()) if isinstance(each, str) else each
        y += own.get("dy", 0)
        high = size * float(str(own["font_size"])[:-1]) / 100 if "font_size" in own else size
        runs.append(Run(x, y, visible(written), high, "font_style" in look or "font_style" in own))
        x += advance(runs[-1].text, high, font)
    back = (x - start) * _SHIFT[look.get("text_anchor", "start")]
    colour, halo = look.get("fill", "#000000"), look.get("stroke", "") if "paint_order" in look else ""
    assert isinstance(colour, str)
    return Lettering([run._replace(x=run.x - back) for run in runs], font, colour, halo, look.get("stroke_width", 0))


def commands(shape: Outlined) -> list[Command]:
    """The steps along an outline.

    >>> commands(Path("M0 0h10v5z"))
    [('M', [(0.0, 0.0)]), ('L', [(10.0, 0.0)]), ('L', [(10.0, 5.0)]), ('Z', [])]
    """
    if isinstance(shape, Path):
        return [*_steps(shape.data)]
    if isinstance(shape, Strokes):
        return [step for x, y, to_x, to_y in shape.ends.tolist() for step in (("M", [(x, y)]), ("L", [(to_x, to_y)]))]
    if isinstance(shape, Polygon):
        return _closed([(x, y) for x, y in shape.corners])
    if isinstance(shape, Rectangle):
        return _rectangle(*_tenths(*shape[:5]))
    reach = (shape.across, shape.up) if isinstance(shape, Ellipse) else (shape.radius, shape.radius)
    x, y, across, up = _tenths(shape.x, shape.y, *reach)
    ways = [(0, -1), (1, 0), (0, 1), (-1, 0), (0, -1)]
    return _of_quarters([((x, y), ways[number], ways[number + 1]) for number in range(4)], across, up)


def _tenths(*numbers: float | None) -> list[float]:
    """The numbers of a shape with one decimal, as they are written."""
    return [round(number or 0, 1) for number in numbers]


def _steps(data: str) -> Iterator[Command]:
    """The steps of a path of SVG (SVG 2, chapter 9.3)."""
    here = start = (0.0, 0.0)
    for letter, written in _COMMAND.findall(data):
        command, numbers = letter.upper(), [*map(float, written.split())]
        left, top = here if letter.islower() else (0.0, 0.0)
        if command == "Z":
            here, points = start, []
        elif command == "H":
            points = [(left + numbers[0], here[1])]
        elif command == "V":
            points = [(here[0], top + numbers[0])]
        else:
            points = [(left + x, top + y) for x, y in zip(numbers[::2], numbers[1::2], strict=True)]
        if command == "Q":
            controls = [((edge[0] + 2 * points[0][0]) / 3, (edge[1] + 2 * points[0][1]) / 3) for edge in (here, points[1])]
            points = [*controls, points[1]]
        if points:
            here = points[-1]
        if command == "M":
            start = here
        yield {"H": "L", "V": "L", "Q": "C"}.get(command, command), points if letter in "MLC" else _seven(points)


def _seven(points: Sequence[Point]) -> list[Point]:
    """Points whose numbers have seven digits: less is rounding."""
    return [(float(f"{x:.7g}"), float(f"{y:.7g}")) for x, y in points]


def _closed(corners: Sequence[Point]) -> list[Command]:
    return [*(("L" if number else "M", [corner]) for number, corner in enumerate(corners)), ("Z", [])]


def _rectangle(x: float, y: float, width: float, height: float, corner: float) -> list[Command]:
    across, up = min(corner, width / 2), min(corner, height / 2)
    if not across:
        return _closed(_seven([(x, y), (x + width, y), (x + width, y + height), (x, y + height)]))
    quarters = [
        ((x + width - across, y + up), (0, -1), (1, 0)),
        ((x + width - across, y + height - up), (1, 0), (0, 1)),
        ((x + across, y + height - up), (0, 1), (-1, 0)),
        ((x + across, y + up), (-1, 0), (0, -1)),
    ]
    return _of_quarters(quarters, across, up)


def _of_quarters(quarters: Sequence[tuple[Point, Point, Point]], across: float, up: float) -> list[Command]:
    """Quarters of ellipses, joined by straight lines: each with its centre and the directions to its ends."""
    steps: list[Command] = []
    for (x, y), (from_x, from_y), (to_x, to_y) in quarters:
        start, *controls = _seven(
            [
                (x + across * from_x, y + up * from_y),
                (x + across * (from_x + ARC * to_x), y + up * (from_y + ARC * to_y)),
                (x + across * (to_x + ARC * from_x), y + up * (to_y + ARC * from_y)),
                (x + across * to_x, y + up * to_y),
            ]
        )
        steps += [*([] if steps else [("M", [start])]), ("L", [start]), ("C", controls)]
    return [*steps, ("Z", [])]


def subpaths(shape: Outlined, scale: float = 1.0) -> list[Subpath]:
    """The corners of an outline, whose curves become straight pieces, given how many points a unit has.

    >>> [(path.corners.tolist(), path.closed) for path in subpaths(Path("M0 0L1 0M2 2L3 3L2 3Z"))]
    [([[0.0, 0.0], [1.0, 0.0]], False), ([[2.0, 2.0], [3.0, 3.0], [2.0, 3.0]], True)]
    """
    if isinstance(shape, Strokes):
        return [Subpath(each, False) for each in shape.ends.reshape(-1, 2, 2).astype(float)]
    found: list[tuple[list[Point], bool]] = []
    for command, points in commands(shape):
        if command == "M":
            found.append(([*points], False))
        elif command == "Z":
            found[-1] = (found[-1][0], True)
        else:
            corners = found[-1][0]
            corners += _curve([corners[-1], *points], scale) if command == "C" else points
    return [Subpath(np.array(corners, float), closed) for corners, closed in found]


def _curve(controls: Sequence[Point], scale: float) -> list[Point]:
    start, first, second, end = np.array(controls)
    length = float(np.hypot(*np.diff(controls, axis=0).T).sum()) * scale
    shares = np.linspace(0, 1, max(LEAST_PIECES, math.ceil(length**0.5)) + 1)[1:, None]
    rest = 1 - shares
    points = rest**3 * start + 3 * rest**2 * shares * first + 3 * rest * shares**2 * second + shares**3 * end
    return [*map(tuple, points.tolist())]


def dashed(path: Subpath, dashes: Sequence[float]) -> Iterator[Subpath]:
    """The dashes of a line: a stretch is drawn, the next left out, and so on.

    >>> [part.corners[:, 0].tolist() for part in dashed(Subpath(np.array([[0, 0], [10, 0]]), False), (4, 3))]
    [[0.0, 4.0], [7.0, 10.0]]
    """
    corners = np.vstack([path.corners, path.corners[:1]]) if path.closed else path.corners
    lengths = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(corners, axis=0).T))])
    at, number = 0.0, 0
    while at < lengths[-1]:
        end = min(at + max(dashes[number % len(dashes)], 1e-3), lengths[-1])
        if number % 2 == 0:
            inside = lengths[(lengths > at) & (lengths < end)]
            places = np.array([at, *inside, end])
            yield Subpath(np.stack([np.interp(places, lengths, corners[:, axis]) for axis in (0, 1)], axis=1), False)
        at, number = end, number + 1
