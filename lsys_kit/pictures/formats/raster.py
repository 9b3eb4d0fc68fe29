"""Rasterisation of scenes as PNG, for pictures with too many strokes for SVG and for stored notebooks.

Pictures are drawn without text at three times their size and then reduced, so that edges are smooth and pixels the same
everywhere.
"""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lsys_kit.geometry.scene import CIRCLE, Scene
from lsys_kit.pictures.display_list import MARGIN, WIDTH, ViewFrame, frame_of, groups, shape_colours
from lsys_kit.pictures.filaments import DrawnCell, filament_layout, wall_colour, wall_width
from lsys_kit.pictures.style.palette import GREEN, INK, PAPER, tinted
from lsys_kit.pictures.svg import FilamentRow

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

Coordinates: TypeAlias = NDArray[np.floating[Any]]
FINE = 3
"""The supersampling factor: a picture is drawn at this multiple of its size and then reduced."""
FLOAT32_RANGE = 1e30
"""Coordinates up to this can be computed in single precision."""
STROKES_AT_A_TIME = 2**16
"""Strokes are rasterised in blocks of this size, which stay in the cache of the processor between two operations."""


def turtle_png(scene: Scene, colour_of: Mapping[int, str]) -> bytes:
    """A scene of a turtle as PNG."""
    return _png(turtle_image(scene, colour_of, frame_of(scene.box)))


def turtle_image(scene: Scene, colour_of: Mapping[int, str], frame: ViewFrame) -> Image:
    """A scene of a turtle as an image, in a frame that contains it.

    Strokes of one colour and width are rasterised on a fine grid and then dilated to their width all at once, so that the time
    depends on the number of their points.
    """
    from PIL import Image, ImageDraw

    sheet = Image.new("RGB", (frame.width * FINE, frame.height * FINE), PAPER)
    pen = ImageDraw.Draw(sheet)
    for corners, colour in zip(scene.polygons, shape_colours(scene.polygons, colour_of), strict=True):
        pen.polygon((frame.points(corners) * (FINE / 10)).ravel().tolist(), fill=tinted(colour, 0.7), outline=colour, width=2)
    image = np.array(sheet)
    fine = frame.scale * FINE
    precision = np.dtype(np.float32 if max(map(abs, scene.box)) < FLOAT32_RANGE else np.float64)
    ends, (left, top, factor, margin) = scene.segments.ends.astype(precision), np.array(
        [frame.left, frame.top, fine, MARGIN * FINE], precision)
    across, down = (ends[:, ::2] - left) * factor + margin, (top - ends[:, 1::2]) * factor + margin
    for colour, width, chosen in groups(scene.segments, frame.scale, colour_of):
        found = touched(across[chosen], down[chosen], image.shape[:2])
        image[spread(found, width * FINE / 20)] = tuple(bytes.fromhex(colour[1:]))
    sheet = Image.fromarray(image)
    pen = ImageDraw.Draw(sheet)
    discs, middles = scene.discs, frame.points(scene.discs.centres) * (FINE / 10)
    for (x, y), radius, kind, colour in zip(middles.tolist(), discs.radii.tolist(), discs.kinds.tolist(),
                                            shape_colours(discs, colour_of), strict=True):
        reach = max(2.0, radius * fine)
        pen.ellipse((x - reach, y - reach, x + reach, y + reach), fill=PAPER if kind == CIRCLE else tinted(colour, 0.7),
                    outline=colour, width=FINE)
    return sheet.resize((frame.width, frame.height), Image.Resampling.BOX)


def touched(across: Coordinates, down: Coordinates, shape: tuple[int, int]) -> NDArray[np.bool_]:
    """The points of a grid that lie on strokes, given the columns and rows of their ends.

    >>> touched(np.array([[0.5, 2.5]], dtype=np.float32), np.array([[0.5, 0.5]], dtype=np.float32), (2, 4)).astype(int).tolist()
    [[1, 1, 1, 0], [0, 0, 0, 0]]
    """
    found = np.zeros(shape[0] * shape[1], dtype=bool)
    for first in range(0, len(across), STROKES_AT_A_TIME):
        x, y = across[first:first + STROKES_AT_A_TIME], down[first:first + STROKES_AT_A_TIME]
        wide, high = x[:, 1] - x[:, 0], y[:, 1] - y[:, 0]
        steps = np.ceil(np.maximum(np.abs(wide), np.abs(high))).astype(np.int32)
        np.maximum(steps, 1, out=steps)
        counts = steps + 1
        along = np.arange(int(counts.sum()), dtype=np.int32) - np.repeat(np.cumsum(counts) - counts, counts)
        column = (np.repeat(x[:, 0], counts) + np.repeat(wide / steps, counts) * along).astype(np.int32)
        row = (np.repeat(y[:, 0], counts) + np.repeat(high / steps, counts) * along).astype(np.int32)
        found[row * shape[1] + column] = True
    return found.reshape(shape)


def spread(found: NDArray[np.bool_], radius: float) -> NDArray[np.bool_]:
    """The dilation of a set of points of a grid by a disc of a given radius.

    >>> spread(np.array([[0, 0, 0], [0, 1, 0], [0, 0, 0]], dtype=bool), 1).astype(int).tolist()
    [[0, 1, 0], [1, 1, 1], [0, 1, 0]]
    """
    reach = int(radius)
    wide = {0: found}  # dilated to the left and right by this number of points
    for side in range(1, reach + 1):
        wider = wide[side - 1].copy()
        wider[:, side:] |= found[:, :-side]
        wider[:, :-side] |= found[:, side:]
        wide[side] = wider
    all_ = wide[reach].copy()
    for up in range(1, reach + 1):
        row = wide[int((radius * radius - up * up) ** 0.5)]
        all_[up:] |= row[:-up]
        all_[:-up] |= row[up:]
    return all_


def rows_png(rows: Sequence[FilamentRow], look: str, colour_of: Mapping[int, str]) -> bytes:
    """Filaments below one another, with a common scale, as a PNG picture."""
    from PIL import Image, ImageDraw

    sheet = filament_layout(rows, written=False)
    image = Image.new("RGB", (WIDTH * FINE, sheet.height * FINE), PAPER)
    pen = ImageDraw.Draw(image)
    for place, row in enumerate(rows):
        middle = sheet.middle(place) * FINE
        for cell in sheet.cells(row):
            _cell(pen, cell, look, middle, colour_of.get(cell.state, GREEN))
        for wall in sheet.walls(row):
            reach, colour = (wall.height + 2) * FINE, wall_colour(colour_of.get(wall.state, GREEN), wall.shade)
            pen.line([(wall.x * FINE, middle - reach), (wall.x * FINE, middle + reach)], fill=colour,
                     width=round(wall_width(wall.shade) * FINE))
    return _png(image.resize((WIDTH, sheet.height), Image.Resampling.BOX))


def _cell(pen: ImageDraw, cell: DrawnCell, look: str, middle: float, colour: str) -> None:
    x, length, width = cell.x * FINE, cell.length * FINE, cell.width * FINE
    box, fill = (x - length, middle - width, x + length, middle + width), tinted(colour, 0.28 + 0.6 * cell.shade)
    if look == "ellipses":
        pen.ellipse(box, outline=colour, fill=fill, width=FINE)
    else:
        pen.rounded_rectangle(box, min(length, width), outline=colour, fill=fill, width=FINE)
    if length > 7 and cell.way:
        tip, head = x + 0.55 * length * cell.way, 0.3 * min(length, width)
        back = tip - head * cell.way
        pen.line([(2 * x - tip, middle), (tip, middle)], fill=INK, width=FINE)
        pen.line([(back, middle - head), (tip, middle), (back, middle + head)], fill=INK, width=FINE, joint="curve")


def _png(image: object) -> bytes:
    buffer = io.BytesIO()
    image.save(buffer, "PNG")  # type: ignore[attr-defined]
    return buffer.getvalue()
