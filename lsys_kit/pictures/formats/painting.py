"""Pixels that are the same on every machine: a sheet of paper on which shapes of pictures, text and boxes are put.

Everything is drawn at three times its size and then reduced, as in `raster`.
"""

from __future__ import annotations

import copy
import io
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import chain
from typing import TYPE_CHECKING, Self, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import check_bytes
from lsys_kit.geometry.scene import Floats
from lsys_kit.pictures.formats.lettering import Mask, advance, glyph
from lsys_kit.pictures.formats.painter import Ink, Lettering, Painter, Subpath, dashed, subpaths
from lsys_kit.pictures.formats.raster import FINE, Colours, spread
from lsys_kit.pictures.shapes import Circle, Drawing, Ellipse, Gradient, Outlined, Place, Raster, Rectangle, place_within
from lsys_kit.pictures.style.colour_values import BLACK, WHITE
from lsys_kit.pictures.style.themes import drawn_on, theme

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

Point: TypeAlias = tuple[float, float]
PIXEL_BYTES = 3 * (FINE**2 + 1)
"""What a pixel takes while a sheet is painted and reduced."""
SUBSCRIPT, LOWERED = 0.7, 0.21
"""The size of a subscript and how far it is lowered, to the size of the text."""


class Sheet:
    """White paper, or a part of it with its own origin and unit.

    Parameters
    ----------
    width, height
        Its size in pixels; at first a pixel is the unit, and the left upper corner the origin.

    Attributes
    ----------
    grid, pen
        The fine grid of points that is painted on, and what paints there.
    """

    grid: Image
    pen: ImageDraw
    _pasted: list[tuple[Image, tuple[int, int]]]

    def __init__(self, width: int, height: int) -> None:
        from PIL import Image, ImageDraw

        check_bytes(width * height * PIXEL_BYTES, lambda: "The picture was not drawn")
        self._size, self._left, self._top, self._unit = (width, height), 0.0, 0.0, float(FINE)
        self.grid = Image.new("RGB", (width * FINE, height * FINE), theme().ground)
        self.pen = ImageDraw.Draw(self.grid)
        self._pasted = []

    def part(self, x: float, y: float, unit: float = 1.0) -> Self:
        """The same sheet, measured from another point with another unit."""
        part = copy.copy(self)
        part._left, part._top, part._unit = *self._at(x, y), self._unit * unit
        return part

    def text(self, x: float, y: float, text: str, size: float, colour: str = "", italic: bool = False) -> float:
        """Write a text from a point of its baseline on, and return where it ends."""
        from PIL import Image

        for letter in text:
            mask, left, top = glyph(letter, size * self._unit, italic)
            across, down = self._at(x, y)
            if mask.size:
                self.grid.paste(colour or theme().ink, (round(across) + left, round(down) + top), Image.fromarray(mask))
            x += advance(letter, size)
        return x

    def label(self, x: float, y: float, label: tuple[str, str, str], size: float, colour: str = "") -> None:
        """Write a label, given as letter, subscript and values, as mathematics is set."""
        letter, subscript, values = label
        x = self.text(x, y, letter, size, colour, letter[:1].isalpha())
        x = self.text(x, y + LOWERED * size, subscript, SUBSCRIPT * size, colour)
        self.text(x, y, values, size, colour)

    def box(self, x: float, y: float, width: float, height: float, fill: str, corner: float = 0) -> None:
        """A filled rectangle, perhaps with round corners."""
        (left, top), (right, bottom) = self._at(x, y), self._at(x + width, y + height)
        self.pen.rounded_rectangle((round(left), round(top), round(right) - 1, round(bottom) - 1), corner * self._unit, fill)

    def picture(self, x: float, y: float, image: Image) -> None:
        """A picture in its own pixels, above everything else."""
        across, down = self._at(x, y)
        self._pasted.append((image, (round(across / FINE), round(down / FINE))))

    @property
    def png(self) -> bytes:
        """The sheet as PNG."""
        buffer = io.BytesIO()
        self.image.save(buffer, "PNG")
        return buffer.getvalue()

    @property
    def image(self) -> Image:
        """The sheet as an image."""
        from PIL import Image

        image = self.grid.resize(self._size, Image.Resampling.BOX)
        for pasted, corner in self._pasted:
            image.paste(pasted, corner)
        return image

    def _at(self, x: float, y: float) -> Point:
        """A point on the fine grid."""
        return self._left + x * self._unit, self._top + y * self._unit


def label_width(label: tuple[str, str, str], size: float) -> float:
    """The width of a label, given as letter, subscript and values."""
    letter, subscript, values = label
    return advance(letter + values, size) + advance(subscript, SUBSCRIPT * size)


# --- shapes on a sheet ---

SHADES = 512
"""The steps of a gradient."""
CURVED = 4
"""From this width on, in points of the grid, the corners of a line are seen."""


def painted(drawing: Drawing, enlarged: float = 1.0, quick: bool = False) -> Image:
    """A drawing as an image, perhaps enlarged; quick where there are very many shapes."""
    sheet = Sheet(round(drawing.width * enlarged), round(drawing.height * enlarged))
    (QuickPainter if quick else PixelPainter)(sheet, Place(enlarged)).draw(drawing)
    return sheet.image


class PixelPainter(Painter):
    """What paints shapes on a sheet, on which a picture has some place."""

    def __init__(self, sheet: Sheet, place: Place) -> None:
        self._sheet, self._place = sheet, place

    def _on_grid(self, place: Place) -> Place:
        return Place(*(FINE * each for each in place_within(self._place, place)))

    def outline(self, shape: Outlined, ink: Ink, place: Place) -> None:
        """Fill an outline, then draw its line."""
        place, sheet = self._on_grid(place), self._sheet
        paths = [Subpath(_at(each.corners, place), each.closed) for each in subpaths(shape, place.scale)]
        if ink.fill:
            inside = [each.corners for each in paths if len(each.corners) > 2]
            if ink.evenodd and len(inside) > 1:
                _crossed(sheet, [*map(_whole, inside)], ink.fill)
            else:
                _with_opacity(sheet, ink.fill, ink.fill_opacity, lambda pen, colour: _fill(pen, inside, colour))
        if ink.stroke:
            dashes, width = [each * place.scale for each in ink.dashes], max(1, round(ink.width * place.scale))
            lines = [part for each in paths for part in dashed(each, dashes)] if dashes else paths
            _with_opacity(
                sheet, ink.stroke, ink.stroke_opacity, lambda pen, colour: _stroke(pen, lines, colour, width, ink.round_ends)
            )

    def sphere(self, circle: Circle, gradient: Gradient, place: Place) -> None:
        """Mix the colours of a gradient with what is there."""
        from PIL import Image

        place = self._on_grid(place)
        (x, y), radius = _at(np.array([circle.x, circle.y]), place).tolist(), circle.radius * place.scale
        left, top = int(x - radius), int(y - radius)
        side = int(2 * radius) + 2
        down, across = (np.arange(side)[:, None] + top + 0.5, np.arange(side)[None] + left + 0.5)
        colours, opacity = gradient_at(gradient, (across - x) / radius / 2 + 0.5, (down - y) / radius / 2 + 0.5)
        mask = np.where(np.hypot(across - x, down - y) <= radius, opacity, 0).astype(np.uint8)
        self._sheet.grid.paste(Image.fromarray(colours), (left, top), Image.fromarray(mask))

    def text(self, text: Lettering, place: Place) -> None:
        """Write letters, those with a halo over it."""
        place, letters = self._on_grid(place), []
        for run in text.runs:
            x = run.x
            for letter in run.text:
                mask, left, top = glyph(letter, run.size * place.scale, run.italic, text.font)
                if mask.size:
                    letters.append((mask, round(place.x + x * place.scale) + left, round(place.y + run.y * place.scale) + top))
                x += advance(letter, run.size, text.font)
        if text.halo:
            reach = round(text.halo_width * place.scale / 2)
            for mask, left, top in letters:
                self._stamp(spread(np.pad(mask, reach), reach), left - reach, top - reach, text.halo)
        for mask, left, top in letters:
            self._stamp(mask, left, top, text.colour)

    def _stamp(self, mask: Mask, left: int, top: int, colour: str) -> None:
        from PIL import Image

        self._sheet.grid.paste(colour, (left, top), Image.fromarray(mask))

    def raster(self, raster: Raster, place: Place) -> None:
        """Paint an image over what is there."""
        from PIL import Image

        place, pixels = self._on_grid(place), Image.open(io.BytesIO(raster.png)).convert("RGBA")
        left, top = _at(np.array([raster.x or 0, raster.y or 0]), place).tolist()
        size = round(raster.width * place.scale), round(raster.height * place.scale)
        seen = pixels.resize(size, Image.Resampling.BICUBIC)
        self._sheet.grid.paste(seen.convert("RGB"), (round(left), round(top)), seen.getchannel("A"))


class QuickPainter(PixelPainter):
    """What paints ellipses and rectangles as the library does: their edges lie inside, and it takes a tenth of the time."""

    def outline(self, shape: Outlined, ink: Ink, place: Place) -> None:
        """Paint an outline."""
        if not isinstance(shape, Rectangle | Ellipse):
            super().outline(shape, ink, place)
            return
        place, pen = self._on_grid(place), self._sheet.pen
        x, y, across, up = (number or 0 for number in shape[:4])
        left, top, wide, high = (x, y, across, up) if isinstance(shape, Rectangle) else (x - across, y - up, 2 * across, 2 * up)
        box = [*_at(np.array([[left, top], [left + wide, top + high]]), place).ravel().tolist()]
        edge, width = ink.stroke or None, max(1, round(ink.width * place.scale))
        if isinstance(shape, Ellipse):
            pen.ellipse(box, ink.fill, edge, width)
        elif min(wide, high) * place.scale > 2 * width:
            pen.rounded_rectangle(box, (shape.corner or 0) * place.scale, ink.fill, edge, width)
        else:
            pen.rectangle(box, ink.fill, edge, width)


def _at(points: Floats, place: Place) -> Floats:
    found: Floats = points * place.scale + (place.x, place.y)
    return found


def _whole(points: Floats) -> list[tuple[int, int]]:
    return [*map(tuple, np.floor(points).astype(int).tolist())]


def _with_opacity(sheet: Sheet, colour: str, opacity: float, paint: Callable[[ImageDraw, str | int], None]) -> None:
    """Let something be painted in a colour: at once, or through a mask as strong as it is opaque."""
    from PIL import Image, ImageDraw

    if opacity == 1:
        paint(sheet.pen, colour)
        return
    mask = Image.new("L", sheet.grid.size, 0)
    paint(ImageDraw.Draw(mask), round(255 * opacity))
    sheet.grid.paste(colour, (0, 0), mask)


def _fill(pen: ImageDraw, outlines: Sequence[Floats], colour: str | int) -> None:
    """Fill polygons, to whose edges points of the grid belong; level rectangles exactly."""
    for corners in outlines:
        if len(corners) == 4 and (corners == np.roll(corners, 1, axis=0)).any(axis=1).all():
            (left, top), (right, bottom) = corners.min(axis=0).round(), corners.max(axis=0).round()
            pen.rectangle((left, top, max(left, right - 1), max(top, bottom - 1)), colour)
        else:
            pen.polygon(_whole(corners), colour)


def _crossed(sheet: Sheet, outlines: Sequence[Sequence[tuple[int, int]]], colour: str) -> None:
    from PIL import Image, ImageChops, ImageDraw

    (left, top), (right, bottom) = (pick([*chain(*outlines)], axis=0) for pick in (np.min, np.max))
    mask = Image.new("1", (int(right - left) + 1, int(bottom - top) + 1), 0)
    for corners in outlines:
        one = Image.new("1", mask.size, 0)
        ImageDraw.Draw(one).polygon([(x - left, y - top) for x, y in corners], 1)
        mask = ImageChops.logical_xor(mask, one)
    sheet.grid.paste(colour, (int(left), int(top)), mask)


def _stroke(pen: ImageDraw, paths: Sequence[Subpath], colour: str | int, width: int, round_ends: bool) -> None:
    for path in paths:
        corners = _whole(np.vstack([path.corners, path.corners[:1]]) if path.closed else path.corners)
        pen.line(corners, colour, width, "curve" if width >= CURVED else None)
        if width >= CURVED and (round_ends or path.closed):
            for x, y in (corners[0], corners[-1]):
                reach = width / 2
                pen.ellipse((x - reach, y - reach, x + reach, y + reach), colour)


def gradient_at(gradient: Gradient, across: Floats, down: Floats) -> tuple[Colours, Colours]:
    """The colours of points in the square around a circle, whose side is 1, and how opaque they are, as bytes."""
    way = np.hypot(across - gradient.x, down - gradient.y) / gradient.radius
    places = np.minimum(way * SHADES, SHADES).astype(np.int16)
    shares, offsets = np.arange(SHADES + 1) / SHADES, [stop.offset for stop in gradient.stops]
    colours = np.array([(*bytes.fromhex(stop.colour[1:]), 255 * stop.opacity) for stop in gradient.stops])
    table = np.stack([np.interp(shares, offsets, each) for each in colours.T], axis=1).round().astype(np.uint8)
    return table[places, :3], table[places, 3]


# --- pictures without paper ---


def on_ground(render: Callable[[], Image]) -> Image:
    """An image as it is rendered in the theme in force, transparent if there is no paper.

    What is seen in front of white is brighter than in front of black by as much as shines through.
    """
    if not theme().transparent:
        return render()
    from PIL import Image

    white, black = (_on(ground, render) for ground in (WHITE, BLACK))
    cover = 255 - np.clip((white - black).max(axis=2), 0, 255)
    colours = np.where(cover[..., None] > 0, np.clip(black * 255 / np.maximum(cover, 1)[..., None], 0, 255), 255)
    return Image.fromarray(np.dstack([colours, cover]).round().astype(np.uint8), "RGBA")


def _on(ground: str, render: Callable[[], Image]) -> Floats:
    with drawn_on(replace(theme(), ground=ground)):
        return np.asarray(render().convert("RGB"), np.float64)
