"""The SVG of the kit, read back as the shapes from which the other formats are painted.

Only what the kit writes is read: paths, rectangles, polygons, circles, ellipses, texts and images, in groups that are moved or
enlarged; radial gradients; colours as six digits.
"""

from __future__ import annotations

import base64
import re
from collections.abc import Iterator, Mapping
from typing import Any
from xml.etree.ElementTree import Element, fromstring

from lsys_kit.budget import counted
from lsys_kit.errors import printable
from lsys_kit.pictures.formats.vector.lettering import advance
from lsys_kit.pictures.formats.vector.paths import ellipse, plain, rectangle
from lsys_kit.pictures.formats.vector.shapes import (
    Drawing,
    Font,
    Gradient,
    Look,
    Outline,
    Place,
    Raster,
    Run,
    Shape,
    Sphere,
    Stop,
    Text,
)

Attributes = Mapping[str, str]
_SVG = "{http://www.w3.org/2000/svg}"
_MOVED = re.compile(r"translate\(([^\s()]+) ([^\s()]+)\)")
_ENLARGED = re.compile(r"scale\(([^\s()]+)\)")
_GRADIENT = re.compile(r"url\(#(.*)\)")
_INHERITED = (
    "fill",
    "stroke",
    "stroke-width",
    "stroke-linecap",
    "stroke-dasharray",
    "fill-opacity",
    "stroke-opacity",
    "fill-rule",
    "font-size",
    "font-family",
    "font-weight",
    "font-style",
    "text-anchor",
    "paint-order",
)
_SHIFT = {"start": 0.0, "middle": 0.5, "end": 1.0}
SILENT = ("title", "defs", "radialGradient")


def drawing_of(svg: str) -> Drawing:
    """The shapes of a picture in SVG.

    >>> svg = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 20" width="2" height="2"><path d="M0 0h9"/></svg>'
    >>> drawing_of(svg).shapes[0].data
    'M0 0L9 0'
    """
    root = fromstring(svg)  # noqa: S314, it is the kit's own
    left, top, across, down = map(float, root.attrib["viewBox"].split())
    width, height = int(root.attrib["width"]), int(root.attrib["height"])
    scale = width / across
    title = root.find(f"{_SVG}title")
    gradients = {each.attrib["id"]: _gradient(each) for each in root.iter(f"{_SVG}radialGradient")}
    reader = _Reader(gradients, (across, down))
    shapes = counted(reader.shapes(root, {}, Place(scale, -left * scale, -top * scale)))
    return Drawing(width, height, (title.text or "") if title is not None else root.attrib.get("aria-label", ""), [*shapes])


class _Reader:
    """What reads the elements of a picture, given its gradients and the size of its view."""

    def __init__(self, gradients: Mapping[str, Gradient], view: tuple[float, float]) -> None:
        self._gradients, self._view = gradients, view

    def shapes(self, element: Element, inherited: Attributes, place: Place) -> Iterator[Shape]:
        """The shapes in an element, one after another."""
        own = {**inherited, **element.attrib}
        place, name = _placed(element, place), element.tag.removeprefix(_SVG)
        if name in ("svg", "g"):
            passed = {key: own[key] for key in _INHERITED if key in own}
            for child in element:
                yield from self.shapes(child, passed, place)
        elif name == "text":
            yield _text(element, own, place)
        elif name == "image":
            yield _raster(own, place)
        elif name not in SILENT:
            yield from self._outline(name, own, place)

    def _outline(self, name: str, own: Attributes, place: Place) -> Iterator[Shape]:
        look = _look(own)
        if gradient := _GRADIENT.fullmatch(look.fill):
            x, y, radius = (float(own[key]) for key in ("cx", "cy", "r"))
            yield Sphere(x, y, radius, self._gradients[gradient[1]], place)
            look = look._replace(fill="")
        data = self._data(name, own)
        if data and (look.fill or look.stroke):
            yield Outline(data, look, place)

    def _data(self, name: str, own: Attributes) -> str:
        """The outline of an element in the plain form."""

        def number(key: str, whole: float = 0.0) -> float:
            text = own.get(key, "0")
            return whole * float(text[:-1]) / 100 if text.endswith("%") else float(text)

        if name == "path":
            return plain(own["d"])
        if name == "polygon":
            return f"M{own['points'].replace(' ', 'L').replace(',', ' ')}Z"
        if name == "circle":
            return ellipse(number("cx"), number("cy"), number("r"), number("r"))
        if name == "ellipse":
            return ellipse(number("cx"), number("cy"), number("rx"), number("ry"))
        if name == "rect":
            width, height = number("width", self._view[0]), number("height", self._view[1])
            return rectangle(number("x"), number("y"), width, height, number("rx"))
        raise ValueError(f"The kit writes no element <{name}>")


def _placed(element: Element, place: Place) -> Place:
    """Where the units of an element lie, given those of the element around it."""
    transform = element.attrib.get("transform", "")
    moved, enlarged = _MOVED.search(transform), _ENLARGED.search(transform)
    x, y = map(float, moved.groups()) if moved else (0.0, 0.0)
    return place.within(float(enlarged[1]) if enlarged else 1.0, x, y) if transform else place


def _look(own: Attributes) -> Look:
    fill, stroke = (own.get(key, default).replace("none", "") for key, default in (("fill", "#000000"), ("stroke", "")))
    return Look(
        fill,
        stroke,
        float(own.get("stroke-width", 1)),
        own.get("stroke-linecap") == "round",
        tuple(map(float, own.get("stroke-dasharray", "").split())),
        float(own.get("fill-opacity", 1)),
        float(own.get("stroke-opacity", 1)),
        own.get("fill-rule") == "evenodd",
    )


def _gradient(element: Element) -> Gradient:
    x, y, radius = (float(element.attrib[key]) for key in ("cx", "cy", "r"))
    stops = tuple(
        Stop(float(each.attrib["offset"]), each.attrib["stop-color"], float(each.attrib.get("stop-opacity", 1)))
        for each in element
    )
    return Gradient(x, y, radius, stops)


def _raster(own: Attributes, place: Place) -> Raster:
    png = base64.b64decode(own["href"].partition(",")[2])
    return Raster(float(own.get("x", 0)), float(own.get("y", 0)), float(own["width"]), float(own["height"]), png, place)


def _text(element: Element, own: Attributes, place: Place) -> Text:
    """A text with its stretches, as wide as its letters are in the kit's font."""
    size, x, y = (float(own.get(key, default)) for key, default in (("font-size", 16), ("x", 0), ("y", 0)))
    family = next((name for name in ("monospace", "sans-serif", "serif") if name in own.get("font-family", "")), "sans-serif")
    font = Font(family, own.get("font-weight") == "bold")
    runs: list[Run] = []
    for text, its in _stretches(element, own):
        y += float(its.get("dy", 0))
        relative = its.get("font-size", "100%")
        high = size * float(relative[:-1]) / 100 if relative.endswith("%") else float(relative)
        runs.append(Run(x, y, "".join(map(printable, text)), high, its.get("font-style") == "italic"))
        x += advance(runs[-1].text, high, font)
    back = (x - float(own.get("x", 0))) * _SHIFT[own.get("text-anchor", "start")]
    halo = own.get("stroke", "") if own.get("paint-order") == "stroke" else ""
    return Text(
        [run._replace(x=run.x - back) for run in runs],
        font,
        own.get("fill", "#000000"),
        halo,
        float(own.get("stroke-width", 0)),
        place,
    )


def _stretches(element: Element, own: Attributes) -> Iterator[tuple[str, dict[str, Any]]]:
    """The stretches of a text with their attributes."""
    style = {key: own[key] for key in ("font-style",) if key in own}
    if element.text:
        yield element.text, style
    for child in element:
        if child.tag == f"{_SVG}tspan":
            yield "".join(child.itertext()), {**style, **child.attrib}
        if child.tail:
            yield child.tail, style
