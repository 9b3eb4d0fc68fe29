"""Rasterisation of scenes as PNG, for pictures with too many strokes for SVG and for stored notebooks.

Pictures are drawn without text at three times their size and then reduced, so that edges are smooth and pixels the same
everywhere. Lines of any number are rasterised at once, and then dilated to their width.
"""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget, check_bytes, counted, current
from lsys_kit.geometry.scene import Floats, Scene
from lsys_kit.pictures.rendering.display_list import (
    AREA,
    NO_COLOUR,
    ROUND,
    Areas,
    DisplayList,
    Lines,
    Rounds,
    colours_and_widths,
    display_list,
)
from lsys_kit.pictures.rendering.frames import MARGIN, ViewFrame, frame_around
from lsys_kit.pictures.rendering.light import LitScene, lit_pixels
from lsys_kit.pictures.shapes import Raster
from lsys_kit.pictures.sizes import Size, enlargement, final_size
from lsys_kit.pictures.style.lighting import HIGHLIGHT, REACH, sphere_tones
from lsys_kit.pictures.style.themes import theme

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

Coordinates: TypeAlias = "NDArray[np.floating]"
Grid: TypeAlias = "NDArray[np.int32]"
Marks: TypeAlias = "NDArray[Any]"
"""Truths or numbers, one for each point of a grid."""
STROKES_AT_A_TIME, POINTS_AT_A_TIME = 2**16, 2**18
"""Strokes are rasterised in blocks of at most so many strokes and points, which stay in the cache of the processor between two
operations; a longer stroke is a block of its own."""


# --- lines on a grid of points ---


def touched(across: Coordinates, down: Coordinates, shape: tuple[int, ...], numbers: Grid | None = None) -> Marks:
    """The points of a grid that lie on strokes, given the columns and rows of their ends.

    If each stroke has a number, in ascending order, a point gets that of the last stroke on which it lies.

    >>> across, down = np.array([[0.5, 2.5], [1.5, 1.5]], np.float32), np.array([[0.5, 0.5], [0.5, 1.5]], np.float32)
    >>> touched(across[:1], down[:1], (2, 4)).astype(int).tolist()
    [[1, 1, 1, 0], [0, 0, 0, 0]]
    >>> touched(across, down, (2, 4), np.array([5, 7])).tolist()
    [[5, 7, 5, 0], [0, 7, 0, 0]]
    """
    found = np.zeros(shape[0] * shape[1], dtype=bool if numbers is None else np.int32)
    for first in range(0, len(across), STROKES_AT_A_TIME):
        x, y = across[first : first + STROKES_AT_A_TIME], down[first : first + STROKES_AT_A_TIME]
        wide, high = x[:, 1] - x[:, 0], y[:, 1] - y[:, 0]
        steps = np.ceil(np.maximum(np.abs(wide), np.abs(high))).astype(np.int32)
        np.maximum(steps, 1, out=steps)
        for some in _blocks(steps + 1):
            check_budget()
            counts = steps[some] + 1
            along = np.arange(int(counts.sum()), dtype=np.int32) - np.repeat(np.cumsum(counts) - counts, counts)
            column = (np.repeat(x[some, 0], counts) + np.repeat(wide[some] / steps[some], counts) * along).astype(np.int32)
            row = (np.repeat(y[some, 0], counts) + np.repeat(high[some] / steps[some], counts) * along).astype(np.int32)
            here = True if numbers is None else np.repeat(numbers[first : first + STROKES_AT_A_TIME][some], counts)
            found[row * shape[1] + column] = here
    return found.reshape(shape)


def _blocks(counts: Grid) -> Iterator[slice]:
    ends = np.cumsum(counts, dtype=np.int64)
    first = 0
    while first < len(counts):
        before = ends[first - 1] if first else 0
        after = max(first + 1, int(np.searchsorted(ends, before + POINTS_AT_A_TIME, side="right")))
        yield slice(first, after)
        first = after


def spread(found: Marks, radius: float) -> Marks:
    """The dilation of a set of points of a grid by a disc of a given radius; of numbers, the greatest in each disc.

    >>> spread(np.array([[0, 0, 0], [0, 1, 0], [0, 0, 0]], dtype=bool), 1).astype(int).tolist()
    [[0, 1, 0], [1, 1, 1], [0, 1, 0]]
    >>> spread(np.array([[0, 0, 5, 7]]), 1).tolist()
    [[0, 5, 7, 7]]
    >>> spread(np.array([[1], [0], [0], [0]]), 5).ravel().tolist()  # a disc larger than the grid
    [1, 1, 1, 1]
    """
    row, side, whole, height = found.copy(), 0, np.zeros_like(found), len(found)  # the row is dilated to both sides
    for up in counted(range(min(int(radius), height - 1), -1, -1), 1):
        while side < int((radius * radius - up * up) ** 0.5):
            side += 1
            np.maximum(row[:, side:], found[:, :-side], out=row[:, side:])
            np.maximum(row[:, :-side], found[:, side:], out=row[:, :-side])
        np.maximum(whole[up:], row[: height - up], out=whole[up:])
        np.maximum(whole[: height - up], row[up:], out=whole[: height - up])
    return whole


# --- scenes ---

Colours: TypeAlias = "NDArray[np.uint8]"
ShapePainter: TypeAlias = Callable[[int, int], None]
FINE = 3
"""The supersampling factor: a picture is drawn at this multiple of its size and then reduced."""
POINT_BYTES = 16
"""About what a point of the fine grid takes in memory."""
FLOAT32_RANGE = 1e30
"""Coordinates up to this can be computed in single precision."""

MOST_SPREADS, FEW_LINES = 6, 2_000
"""Lines of so many widths are painted at once, width after width; of more widths, those with few lines are painted in turn."""


def turtle_picture(scene: Scene, colour_of: Mapping[int, str], size: Size | None = None, enlarged: float = 1.0) -> Image:
    """A scene of a turtle as an image of a size, perhaps enlarged."""
    frame = frame_around([scene])
    wide, high = final_size(frame.width, frame.height, size)
    image = turtle_image(scene, colour_of, frame, enlarged * enlargement(frame.width, frame.height, size))
    return centred(image, (wide, high) if enlarged == 1 else (round(wide * enlarged), round(high * enlarged)))


def centred(image: Image, size: tuple[int, int]) -> Image:
    """An image in the middle of paper."""
    from PIL import Image

    if image.size == size:
        return image
    check_bytes(3 * size[0] * size[1], lambda: "The picture was not drawn")
    paper = Image.new("RGB", size, theme().ground)
    paper.paste(image, ((size[0] - image.width) // 2, (size[1] - image.height) // 2))
    return paper


def turtle_image(scene: Scene, colour_of: Mapping[int, str], frame: ViewFrame, enlarged: float = 1.0) -> Image:
    """A scene of a turtle as an image, in a frame that contains it; perhaps enlarged.

    One in sun and sky is rendered by `lit_pixels`. Of any other, in painter's order:

    Each point of a fine grid gets the number of what is seen there. Numbers grow along the display list: of two shapes the one
    with the greater number covers the other. The shape at place p has the number 2p + 1, and its edge 2p + 2; of a run of
    lines all have the number of the first.
    """
    from PIL import Image

    if isinstance(scene, LitScene):
        return Image.fromarray(lit_pixels(scene, colour_of, frame, enlarged))
    shapes = display_list(scene, frame.scale, colour_of)
    grid = FineGrid(frame, enlarged, samples_for(frame.width * enlarged, frame.height * enlarged))
    across, down = _pixels(shapes.lines.ends, scene, grid)
    spread_out = _spread_out(shapes, grid.fine)
    seen = _painted_in_turn(shapes, grid, across, down, spread_out)
    _paint_at_once(seen, shapes, across, down, spread_out)
    pixels = _colours(shapes)[seen]
    _shade_spheres(pixels, seen, shapes, grid)
    return Image.fromarray(pixels).resize((grid.width // grid.samples, grid.height // grid.samples), Image.Resampling.BOX)


def samples_for(width: float, height: float) -> int:
    """The supersampling factor of an image: less than usual for one of so many pixels that memory would not do."""
    needed = [POINT_BYTES * round(width * height) * samples**2 for samples in range(1, FINE + 1)]
    check_bytes(needed[0], lambda: "The picture was not drawn")
    return sum(size <= current().bytes for size in needed)


@dataclass(frozen=True)
class FineGrid:
    """A grid of points over a frame that is enlarged, so many in each direction of a pixel."""

    frame: ViewFrame
    enlarged: float
    samples: int

    @property
    def fine(self) -> float:
        """The points in each direction of a pixel of the frame."""
        return self.enlarged * self.samples

    @property
    def width(self) -> int:
        """How many points it has across, a multiple of those in a pixel of the image."""
        return round(self.frame.width * self.enlarged) * self.samples

    @property
    def height(self) -> int:
        """How many points it has from the top to the bottom."""
        return round(self.frame.height * self.enlarged) * self.samples

    def points(self, coordinates: Floats) -> Coordinates:
        """Places on it, rounded to parts of a pixel as in other formats."""
        parts = self.frame if self.fine == FINE else replace(self.frame, parts=1_000)
        return parts.points(coordinates) * (self.fine / parts.parts)


def _spread_out(shapes: DisplayList, fine: float) -> NDArray[np.int64]:
    """For each run of lines the square of the radius by which its points are spread, whose fraction is not seen; those with the
    same are painted at once. -1 for polygons and discs, and for broad lines of whose width there are few."""
    widths = colours_and_widths(shapes.keys)[1]
    squares = np.where(shapes.keys >= 0, np.floor((widths * fine) ** 2 / 400).astype(np.int64), -1)
    kinds, which = np.unique(squares, return_inverse=True)
    many = np.bincount(which, weights=np.diff(shapes.starts))
    if len(kinds) <= MOST_SPREADS + 1:
        return squares
    return np.where((many < FEW_LINES)[which] & (squares >= 1), -1, squares)


def _painted_in_turn(
    shapes: DisplayList, grid: FineGrid, across: Coordinates, down: Coordinates, spread_out: NDArray[np.int64]
) -> Grid:
    """The grid with the numbers of what is painted one after another: polygons, discs, and some lines."""
    from PIL import Image, ImageDraw

    sheet = Image.new("I", (grid.width, grid.height), 0)
    pen = ImageDraw.Draw(sheet)
    painters = {
        AREA: _area_painter(shapes.areas, grid, pen),
        ROUND: _round_painter(shapes.rounds, grid, pen),
        0: _line_painter(shapes.lines, grid.fine, across, down, pen),
    }
    runs = np.flatnonzero(spread_out < 0)
    columns = (np.minimum(shapes.keys, 0)[runs], shapes.starts[runs], shapes.starts[runs + 1])
    for kind, first, end in counted(zip(*(column.tolist() for column in columns), strict=True)):
        for place, which in enumerate(shapes.numbers[first:end].tolist(), first):
            painters[kind](which, 2 * (place if kind else first) + 1)
    return np.array(sheet)


def _line_painter(lines: Lines, fine: float, across: Coordinates, down: Coordinates, pen: ImageDraw) -> ShapePainter:
    def paint(which: int, number: int) -> None:
        (x, to_x), (y, to_y), reach = across[which].tolist(), down[which].tolist(), float(lines.widths[which]) * fine / 20
        length = math.hypot(to_x - x, to_y - y) or 1.0
        aside, up = reach * (y - to_y) / length, reach * (to_x - x) / length
        pen.polygon([x + aside, y + up, to_x + aside, to_y + up, to_x - aside, to_y - up, x - aside, y - up], fill=number)
        for left, top in ((x, y), (to_x, to_y)):
            pen.ellipse((left - reach, top - reach, left + reach, top + reach), fill=number)

    return paint


def _area_painter(areas: Areas, grid: FineGrid, pen: ImageDraw) -> ShapePainter:
    """A function that paints a polygon, inside with a number and its edge, if it has one, with the next."""
    corners, ends = grid.points(areas.points).ravel().tolist(), (2 * areas.starts).tolist()
    edges, edge = (areas.edges != NO_COLOUR).tolist(), max(1, round(2 * grid.fine / FINE))

    def paint(which: int, number: int) -> None:
        points = corners[ends[which] : ends[which + 1]]
        pen.polygon(points, fill=number)
        if edges[which]:
            pen.line(points + points[:2], fill=number + 1, width=edge)

    return paint


def _round_painter(rounds: Rounds, grid: FineGrid, pen: ImageDraw) -> ShapePainter:
    middles, radii = grid.points(rounds.centres).tolist(), rounds.radii.tolist()
    fills, edges = (rounds.fills != NO_COLOUR).tolist(), (rounds.edges != NO_COLOUR).tolist()
    edge = max(1, round(grid.fine))

    def paint(which: int, number: int) -> None:
        (x, y), reach = middles[which], max(2.0, radii[which] * grid.frame.scale * grid.fine)
        box = (x - reach, y - reach, x + reach, y + reach)
        pen.ellipse(box, fill=number if fills[which] else None, outline=number + edges[which], width=edge)

    return paint


def _colours(shapes: DisplayList) -> Colours:
    palette = _channels([*shapes.palette, theme().ground])
    found, lines = np.zeros((2 * len(shapes.numbers) + 2, 3), np.uint8), shapes.keys >= 0
    found[0] = palette[-1]
    found[2 * shapes.starts[:-1][lines] + 1] = palette[colours_and_widths(shapes.keys[lines])[0]]
    for key, kind in ((AREA, shapes.areas), (ROUND, shapes.rounds)):
        places = np.flatnonzero(np.repeat(shapes.keys == key, np.diff(shapes.starts)))
        which = shapes.numbers[places]
        found[2 * places + 1], found[2 * places + 2] = palette[kind.fills[which]], palette[kind.edges[which]]
    return found


def _channels(colours: Sequence[str]) -> Colours:
    return np.array([tuple(bytes.fromhex(colour[1:])) for colour in colours], np.uint8)


def _shade_spheres(pixels: Colours, seen: Grid, shapes: DisplayList, grid: FineGrid) -> None:
    rounds, keys = shapes.rounds, np.repeat(shapes.keys, np.diff(shapes.starts))
    places = np.flatnonzero(keys == ROUND)
    places = places[rounds.spheres[shapes.numbers[places]]]
    if not len(places):
        return
    owner = np.full(2 * len(keys) + 3, -1)
    owner[2 * places + 1] = shapes.numbers[places]
    rows, columns = np.nonzero(owner[seen] >= 0)
    which = owner[seen[rows, columns]]
    middles = grid.points(rounds.centres)
    radii = np.maximum(2.0, rounds.radii * grid.frame.scale * grid.fine)
    across = (columns + 0.5 - middles[which, 0]) / radii[which] - HIGHLIGHT[0]
    up = (middles[which, 1] - rows - 0.5) / radii[which] - HIGHLIGHT[1]
    pixels[rows, columns] = _tones(shapes.palette, rounds.fills[which], np.hypot(across, up) / REACH)


def _tones(palette: Sequence[str], fills: NDArray[np.int64], way: Coordinates) -> Colours:
    """The colours of points of spheres, given the numbers of the spheres' own, and how far each is from the brightest."""
    found = np.zeros((len(fills), 3), np.uint8)
    for fill in np.unique(fills).tolist():
        shares, tones = zip(*sphere_tones(palette[fill]), strict=True)
        ours, stops = fills == fill, _channels(tones).T
        found[ours] = np.stack([np.interp(way[ours], shares, stop) for stop in stops], axis=1).round()
    return found


def _pixels(ends: Coordinates, scene: Scene, grid: FineGrid) -> tuple[Coordinates, Coordinates]:
    precision = np.dtype(np.float32 if max(map(abs, scene.box)) < FLOAT32_RANGE else np.float64)
    frame, fine = grid.frame, grid.fine
    ends, (left, top, factor, margin) = (
        ends.astype(precision),
        np.array([frame.left, frame.top, frame.scale * fine, MARGIN * fine], precision),
    )
    return (ends[:, ::2] - left) * factor + margin, (top - ends[:, 1::2]) * factor + margin


def _paint_at_once(
    seen: Grid, shapes: DisplayList, across: Coordinates, down: Coordinates, spread_out: NDArray[np.int64]
) -> None:
    """Paint lines over what has smaller numbers.

    Those that are spread alike are rasterised and then dilated all at once, so that the time depends on the number of their
    points.
    """
    starts, sizes = shapes.starts, np.diff(shapes.starts)
    for square in np.unique(spread_out[spread_out >= 0]).tolist():
        runs, radius = np.flatnonzero(spread_out == square), square**0.5
        if len(runs) == 1:  # then it is enough to know where they are
            first, end = starts[runs[0] : runs[0] + 2].tolist()
            chosen = shapes.numbers[first:end]
            found = spread(touched(across[chosen], down[chosen], seen.shape), radius)
            np.maximum(seen, 2 * first + 1, out=seen, where=found)
        else:
            chosen = shapes.numbers[np.repeat(spread_out == square, sizes)]
            covering = np.repeat((2 * starts[runs] + 1).astype(np.int32), sizes[runs])
            np.maximum(seen, spread(touched(across[chosen], down[chosen], seen.shape, covering), radius), out=seen)


def encoded(image: Image) -> bytes:
    """An image as PNG."""
    buffer = io.BytesIO()
    image.save(buffer, "PNG")
    return buffer.getvalue()


def embedded(width: int, height: int, image: Image, corner: tuple[int, int] | None = None) -> Raster:
    """An image in a picture, as broad and high as it is there, perhaps with its left upper corner at some place."""
    left, top = corner or (None, None)
    return Raster(left, top, width, height, encoded(image))
