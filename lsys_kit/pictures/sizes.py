"""Sizes of pictures in pixels, and the paper on which they lie: a picture is enlarged as a whole, with its strokes and its
text.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

from lsys_kit.errors import ModelValueError, shown, whole_number
from lsys_kit.pictures.shapes import Drawing, Look, Rectangle, Shape
from lsys_kit.pictures.style.themes import theme

Size: TypeAlias = tuple[int, int | None]
"""The width and the height of a picture in pixels; without a height, what the drawing needs."""
LEAST, GREATEST = 16, 20_000
"""The least and the greatest width and height, in pixels."""
SHARP = 2.0
"""What is pixels in an SVG file has so many for each of the file, in each direction, as screens of today have."""


def size_from(value: object) -> Size | None:
    """A size from what a person gives: a width, or a width and a height; None for the usual one.

    >>> size_from(1200), size_from((1200, 800)), size_from(None)
    ((1200, None), (1200, 800), None)

    Raises
    ------
    ModelValueError
        It is no size, or out of range.
    """
    if value is None:
        return None
    if isinstance(value, Sequence) and not isinstance(value, str):
        if len(value) != 2:
            raise ModelValueError(f"A size is a width, or a width and a height, not {shown(value)}")
        return _pixels(value[0]), _pixels(value[1])
    return _pixels(value), None


def _pixels(value: object) -> int:
    found = whole_number(value, "A size")
    if not LEAST <= found <= GREATEST:
        raise ModelValueError(f"A picture can be {LEAST:,} to {GREATEST:,} pixels wide and high, not {found:,}")
    return found


def enlargement(width: float, height: float, size: Size | None) -> float:
    """The factor by which a picture of a width and a height is enlarged to fit into a size.

    >>> enlargement(600, 400, (1200, None)), enlargement(600, 400, (1200, 400)), enlargement(600, 400, None)
    (2.0, 1.0, 1.0)
    """
    if size is None:
        return 1.0
    return size[0] / width if size[1] is None else min(size[0] / width, size[1] / height)


def final_size(width: float, height: float, size: Size | None) -> tuple[int, int]:
    """The width and the height that it has then.

    >>> final_size(600, 400, (1200, None)), final_size(600, 400, (1200, 400))
    ((1200, 800), (1200, 400))
    """
    factor = enlargement(width, height, size)
    return (round(width * factor), round(height * factor)) if size is None or size[1] is None else (size[0], size[1])


def document(shapes: Sequence[Shape], width: int, height: int, title: str, parts: int = 10) -> Drawing:
    """A picture whose units are parts of a pixel: shapes on paper, or on that of the page."""
    box = (0, 0, width * parts, height * parts)
    return Drawing(width, height, title, [*_paper(None, None, *box[2:]), *shapes], box, Look())


def _paper(left: int | None, top: int | None, width: int, height: int) -> list[Rectangle]:
    ground = theme().ground
    return [] if theme().transparent else [Rectangle(left, top, width, height, look=Look(fill=ground))]


def resized(drawing: Drawing, size: Size | None) -> Drawing:
    """A picture enlarged to a size; where that has other proportions, it lies in the middle of more paper.

    >>> found = resized(document([], 6, 4, "-"), (60, 60))
    >>> found.box, found.width, found.height
    ((0, -10, 60, 60), 60, 60)
    """
    if size is None:
        return drawing
    left, top, across, down = drawing.box
    factor, (wide, high) = enlargement(drawing.width, drawing.height, size), final_size(drawing.width, drawing.height, size)
    if size[1] is not None:
        aside, above = (
            round(side * (room / factor / own - 1) / 2)
            for side, room, own in ((across, wide, drawing.width), (down, high, drawing.height))
        )
        left, top, across, down = left - aside, top - above, across + 2 * aside, down + 2 * above
    box = (left, top, across, down)
    return replace(
        drawing, width=wide, height=high, box=box, shapes=[*(_paper(*box) if box != drawing.box else ()), *drawing.shapes]
    )
