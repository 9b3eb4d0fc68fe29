"""The shapes that a turtle leaves besides strokes, while it is still on its way: at its own positions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from lsys_kit.geometry.labels import Labels
from lsys_kit.geometry.scene import Discs, Floats, Polygons
from lsys_kit.geometry.turtle.patches import Face


class Outline(NamedTuple):
    """The outline of a polygon: the positions of its corners; of a curved surface, the normals there."""

    corners: list[Any]
    state: int
    colour: int
    normals: list[Any] = []  # noqa: RUF012


class RoundShape(NamedTuple):
    """A circle, disc or sphere."""

    place: Any
    radius: float
    kind: int
    state: int
    colour: int


class Writing(NamedTuple):
    """A label."""

    place: Any
    text: str
    state: int


def label_text(values: Sequence[float]) -> str:
    """What a label with some values says.

    >>> label_text((2.0, 0.25, -0.0))
    '2, 0.25, 0'
    """
    return ", ".join(f"{value + 0.0:g}" for value in values)


def rectangle(length: float, width: float) -> Face:
    """The corners of a rectangle ahead of a turtle, in its frame.

    >>> rectangle(3, 2)
    ((0.0, -1.0, 0.0), (3, -1.0, 0.0), (3, 1.0, 0.0), (0.0, 1.0, 0.0))
    """
    half = width / 2
    return (0.0, -half, 0.0), (length, -half, 0.0), (length, half, 0.0), (0.0, half, 0.0)


def box_sides(length: float, width: float) -> list[Face]:
    """The six sides of a box ahead of a turtle, or behind it where the length is negative, as wide as it is deep, in its frame.

    Each side has its corners counter-clockwise as seen from outside.

    >>> box_sides(3, 2)[0]
    ((0.0, -1.0, -1.0), (0.0, -1.0, 1.0), (0.0, 1.0, 1.0), (0.0, 1.0, -1.0))
    """
    half = width / 2
    ends = (min(length, 0.0), max(length, 0.0)), (-half, half), (-half, half)
    return [_side(ends, axis, end) for axis, end in product(range(3), (0, 1))]


def _side(ends: Sequence[tuple[float, float]], axis: int, end: int) -> Face:
    """A side of a box, given both ends of each of its axes: that at an end of one of them."""
    around = ((0, 0), (1, 0), (1, 1), (0, 1)) if end else ((0, 0), (0, 1), (1, 1), (1, 0))
    places = [(end, *others) for others in around]
    ahead, left, up = ([between[place[(which - axis) % 3]] for place in places] for which, between in enumerate(ends))
    return tuple(zip(ahead, left, up, strict=True))


def _normals_at_corners(outlines: Sequence[Outline]) -> Floats:
    """The normals at the corners of polygons, as of `Polygons`."""
    if not any(outline.normals for outline in outlines):
        return np.empty((0, 3))
    return np.array([normal for outline in outlines for normal in outline.normals or [(0.0, 0.0, 0.0)] * len(outline.corners)])


def collected_labels(written: Sequence[Writing], points: Callable[[list[Any]], Floats]) -> Labels:
    """The labels that a turtle has written, given a function from positions to coordinates."""
    return Labels(
        points([each.place for each in written]),
        tuple(each.text for each in written),
        np.array([each.state for each in written], np.int64),
    )


def collected_shapes(
    outlines: Sequence[Outline], rounds: Sequence[RoundShape], points: Callable[[list[Any]], Floats]
) -> tuple[Polygons, Discs]:
    """The polygons and discs that a turtle has drawn, given a function from positions to coordinates."""
    sizes = [len(outline.corners) for outline in outlines]
    states, colours = (np.array([outline[field] for outline in outlines], np.int64) for field in (1, 2))
    polygons = Polygons(
        points([corner for outline in outlines for corner in outline.corners]),
        np.cumsum([0, *sizes]),
        states,
        colours,
        _normals_at_corners(outlines),
    )
    discs = Discs(
        points([found.place for found in rounds]),
        np.array([found.radius for found in rounds], np.float64),
        *(np.array([found[field] for found in rounds], np.int64) for field in (2, 3, 4)),
    )
    return polygons, discs
