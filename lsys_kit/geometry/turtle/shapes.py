"""The shapes that a turtle leaves besides strokes, while it is still on its way: at its own positions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from lsys_kit.geometry.scene import Discs, Floats, Polygons


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


def _normals_at_corners(outlines: Sequence[Outline]) -> Floats:
    """The normals at the corners of polygons, as of `Polygons`."""
    if not any(outline.normals for outline in outlines):
        return np.empty((0, 3))
    return np.array([normal for outline in outlines for normal in outline.normals or [(0.0, 0.0, 0.0)] * len(outline.corners)])


def collected_shapes(outlines: Sequence[Outline], rounds: Sequence[RoundShape],
                     points: Callable[[list[Any]], Floats]) -> tuple[Polygons, Discs]:
    """The polygons and discs that a turtle has drawn, given a function from positions to coordinates."""
    sizes = [len(outline.corners) for outline in outlines]
    states, colours = (np.array([outline[field] for outline in outlines], np.int64) for field in (1, 2))
    polygons = Polygons(points([corner for outline in outlines for corner in outline.corners]), np.cumsum([0, *sizes]),
                        states, colours, _normals_at_corners(outlines))
    discs = Discs(points([found.place for found in rounds]), np.array([found.radius for found in rounds], np.float64),
                  *(np.array([found[field] for found in rounds], np.int64) for field in (2, 3, 4)))
    return polygons, discs
