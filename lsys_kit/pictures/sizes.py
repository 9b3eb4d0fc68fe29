"""Sizes of pictures in pixels: a picture is enlarged as a whole, with its strokes, its text and its margins."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from lsys_kit.errors import ModelValueError, shown, whole_number

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
