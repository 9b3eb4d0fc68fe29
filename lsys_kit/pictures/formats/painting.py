"""The shapes of a picture as pixels: painted on a sheet, one over another."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np

from lsys_kit.budget import counted
from lsys_kit.geometry.scene import Floats
from lsys_kit.pictures.formats.line_raster import spread
from lsys_kit.pictures.formats.raster import FINE
from lsys_kit.pictures.formats.sheet import Sheet
from lsys_kit.pictures.formats.vector.lettering import advance, glyph
from lsys_kit.pictures.formats.vector.paths import Subpath, dashed, subpaths
from lsys_kit.pictures.formats.vector.shapes import Drawing, Gradient, Outline, Place, Raster, Shape, Sphere, Text

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

SHADES = 512
"""The steps of a gradient."""
CURVED = 4
"""From this width on, in points of the grid, the corners of a line are seen."""


def painted(drawing: Drawing, enlarged: float = 1.0) -> Image:
    """A drawing as an image, perhaps enlarged."""
    sheet = Sheet(round(drawing.width * enlarged), round(drawing.height * enlarged))
    paint(sheet, drawing.shapes, Place(enlarged))
    return sheet.image


def paint(sheet: Sheet, shapes: Iterable[Shape], place: Place = Place()) -> None:  # noqa: B008
    """Paint shapes on a sheet, at a place."""
    for shape in counted(shapes):
        at = place.within(*shape.place)
        at = Place(at.scale * FINE, at.x * FINE, at.y * FINE)
        if isinstance(shape, Outline):
            _outline(sheet, shape, at)
        elif isinstance(shape, Sphere):
            _sphere(sheet, shape, at)
        elif isinstance(shape, Text):
            _text(sheet, shape, at)
        else:
            _raster(sheet, shape, at)


def _at(points: Floats, place: Place) -> Floats:
    """Points on the fine grid."""
    found: Floats = points * place.scale + (place.x, place.y)
    return found


def _outline(sheet: Sheet, shape: Outline, place: Place) -> None:
    look, paths = shape.look, [Subpath(_at(each.corners, place), each.closed) for each in subpaths(shape.data, place.scale)]
    if look.fill:
        inside = [each.corners for each in paths if len(each.corners) > 2]
        if look.evenodd and len(inside) > 1:
            _crossed(sheet, [*map(_whole, inside)], look.fill)
        else:
            _with_opacity(sheet, look.fill, look.fill_opacity, lambda pen, colour: _fill(pen, inside, colour))
    if look.stroke:
        dashes, width = [each * place.scale for each in look.dashes], max(1, round(look.width * place.scale))
        lines = [part for each in paths for part in dashed(each, dashes)] if dashes else paths
        _with_opacity(
            sheet, look.stroke, look.stroke_opacity, lambda pen, colour: _stroke(pen, lines, colour, width, look.round_ends)
        )


def _whole(points: Floats) -> list[tuple[int, int]]:
    """The points of the grid in which some points lie."""
    return [*map(tuple, np.floor(points).astype(int).tolist())]


def _with_opacity(sheet: Sheet, colour: str, opacity: float, paint: Callable[[ImageDraw, Any], None]) -> None:
    """Let something be painted in a colour: at once, or through a mask as strong as it is opaque."""
    from PIL import Image, ImageDraw

    if opacity == 1:
        paint(sheet.pen, colour)
        return
    mask = Image.new("L", sheet.grid.size, 0)
    paint(ImageDraw.Draw(mask), round(255 * opacity))
    sheet.grid.paste(colour, (0, 0), mask)


def _fill(pen: ImageDraw, outlines: Sequence[Floats], colour: Any) -> None:
    """Fill polygons, to whose edges points of the grid belong; level rectangles exactly."""
    for corners in outlines:
        if len(corners) == 4 and (corners == np.roll(corners, 1, axis=0)).any(axis=1).all():
            (left, top), (right, bottom) = corners.min(axis=0).round(), corners.max(axis=0).round()
            pen.rectangle((left, top, max(left, right - 1), max(top, bottom - 1)), colour)
        else:
            pen.polygon(_whole(corners), colour)


def _crossed(sheet: Sheet, outlines: Sequence[Sequence[tuple[int, int]]], colour: str) -> None:
    """Paint what lies inside an odd number of outlines."""
    from PIL import Image, ImageChops, ImageDraw

    (left, top), (right, bottom) = (pick([*chain(*outlines)], axis=0) for pick in (np.min, np.max))
    mask = Image.new("1", (int(right - left) + 1, int(bottom - top) + 1), 0)
    for corners in outlines:
        one = Image.new("1", mask.size, 0)
        ImageDraw.Draw(one).polygon([(x - left, y - top) for x, y in corners], 1)
        mask = ImageChops.logical_xor(mask, one)
    sheet.grid.paste(colour, (int(left), int(top)), mask)


def _stroke(pen: ImageDraw, paths: Sequence[Subpath], colour: Any, width: int, round_ends: bool) -> None:
    for path in paths:
        corners = _whole(np.vstack([path.corners, path.corners[:1]]) if path.closed else path.corners)
        pen.line(corners, colour, width, "curve" if width >= CURVED else None)
        if width >= CURVED and (round_ends or path.closed):
            for x, y in (corners[0], corners[-1]):
                reach = width / 2
                pen.ellipse((x - reach, y - reach, x + reach, y + reach), colour)


def _sphere(sheet: Sheet, shape: Sphere, place: Place) -> None:
    """Mix the colours of a gradient with what is there."""
    from PIL import Image

    (x, y), radius = _at(np.array([shape.x, shape.y]), place).tolist(), shape.radius * place.scale
    left, top = int(x - radius), int(y - radius)
    side = int(2 * radius) + 2
    down, across = (np.arange(side)[:, None] + top + 0.5, np.arange(side)[None] + left + 0.5)
    colours, opacity = gradient_at(shape.gradient, (across - x) / radius / 2 + 0.5, (down - y) / radius / 2 + 0.5)
    inside = np.hypot(across - x, down - y) <= radius
    sheet.grid.paste(Image.fromarray(colours), (left, top), Image.fromarray(np.where(inside, opacity, 0).astype(np.uint8)))


def gradient_at(gradient: Gradient, across: Floats, down: Floats) -> tuple[Any, Any]:
    """The colours of points in the square around a circle, whose side is 1, and how opaque they are, as bytes."""
    way = np.hypot(across - gradient.x, down - gradient.y) / gradient.radius
    places = np.minimum(way * SHADES, SHADES).astype(np.int16)
    shares, offsets = np.arange(SHADES + 1) / SHADES, [stop.offset for stop in gradient.stops]
    colours = np.array([(*bytes.fromhex(stop.colour[1:]), 255 * stop.opacity) for stop in gradient.stops])
    table = np.stack([np.interp(shares, offsets, each) for each in colours.T], axis=1).round().astype(np.uint8)
    return table[places, :3], table[places, 3]


def _text(sheet: Sheet, shape: Text, place: Place) -> None:
    """Letters, those with a halo over it."""
    letters = [*_letters(shape, place)]
    if shape.halo:
        for mask, left, top in letters:
            reach = round(shape.halo_width * place.scale / 2)
            _stamp(sheet, spread(np.pad(mask, reach), reach), left - reach, top - reach, shape.halo)
    for mask, left, top in letters:
        _stamp(sheet, mask, left, top, shape.colour)


def _letters(shape: Text, place: Place) -> Iterable[tuple[Any, int, int]]:
    """The letters of a text as points of the grid, with their left upper corners."""
    for run in shape.runs:
        x = run.x
        for letter in run.text:
            mask, left, top = glyph(letter, run.size * place.scale, run.italic, shape.font)
            if mask.size:
                yield (mask, round(place.x + x * place.scale) + left, round(place.y + run.y * place.scale) + top)
            x += advance(letter, run.size, shape.font)


def _stamp(sheet: Sheet, mask: Any, left: int, top: int, colour: str) -> None:
    from PIL import Image

    sheet.grid.paste(colour, (left, top), Image.fromarray(mask))


def _raster(sheet: Sheet, shape: Raster, place: Place) -> None:
    from PIL import Image

    image = Image.open(io.BytesIO(shape.png)).convert("RGBA")
    left, top = _at(np.array([shape.x, shape.y]), place).tolist()
    size = round(shape.width * place.scale), round(shape.height * place.scale)
    seen = image.resize(size, Image.Resampling.BICUBIC)
    sheet.grid.paste(seen.convert("RGB"), (round(left), round(top)), seen.getchannel("A"))
