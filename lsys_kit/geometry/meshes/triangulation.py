"""Triangulation of polygons: a convex one is a fan, any other is triangulated by ear clipping.

An ear is a corner whose triangle lies within the polygon; every simple polygon has at least two (Meisters, 1975).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lsys_kit.budget import counted
from lsys_kit.geometry.scene import Floats

_STRAIGHT = 1e-12
"""A corner that turns by less than this, relative to the size of the polygon, is taken for straight."""


def triangulate(points: Floats, facing: Floats) -> list[tuple[int, int, int]]:
    """The triangles of a polygon in space, as numbers of its corners.

    Parameters
    ----------
    points
        Shape (n, 3): its corners, counter-clockwise as seen from the side of its normal.
    facing
        Shape (3,): its normal.

    Returns
    -------
    list
        n - 2 triangles. A self-intersecting polygon is covered as well as possible.

    Examples
    --------
    >>> arrow = np.array([(0, 0, 0), (4, 3, 0), (0, 1, 0), (-4, 3, 0)], float)
    >>> triangulate(arrow, np.array([0, 0, 1.0]))
    [(0, 1, 2), (0, 2, 3)]
    """
    plane = _projected(points, facing)
    size = float(np.ptp(plane, axis=0).max()) if len(plane) else 0.0
    level = _STRAIGHT * size * size
    if (_corner_products(plane) >= -level).all():
        return [(0, k, k + 1) for k in range(1, len(plane) - 1)]
    left, triangles = np.arange(len(plane)), []
    while len(left) > 3:
        ear = _ear(plane, level)
        triangles.append((int(left[ear - 1]), int(left[ear]), int(left[(ear + 1) % len(left)])))
        left, plane = np.delete(left, ear), np.delete(plane, ear, axis=0)
    return [*triangles, (int(left[0]), int(left[1]), int(left[2]))]


def _projected(points: Floats, facing: Floats) -> Floats:
    """The corners projected along the axis that is closest to the normal."""
    axis = int(np.abs(facing).argmax())
    plane = points[:, [(axis + 1) % 3, (axis + 2) % 3]]
    return plane if facing[axis] > 0 else plane[:, ::-1]


def _corner_products(plane: Floats) -> Floats:
    """The cross product of the edges at each corner: positive where the outline turns left."""
    before, behind = plane - np.roll(plane, 1, axis=0), np.roll(plane, -1, axis=0) - plane
    bends: Floats = before[:, 0] * behind[:, 1] - before[:, 1] * behind[:, 0]
    return bends


def _ear(plane: Floats, level: float) -> int:
    """The first corner whose triangle contains no other corner; if there is none, the first where the outline turns left."""
    candidates = np.flatnonzero(_corner_products(plane) > level).tolist()
    for corner in counted(candidates, 1):
        a, b, c = plane[corner - 1], plane[corner], plane[(corner + 1) % len(plane)]
        within = _on_the_left(plane, a, b, level) & _on_the_left(plane, b, c, level) & _on_the_left(plane, c, a, level)
        if not (within & ~_equal_to_any(plane, (a, b, c))).any():
            return int(corner)
    return int(candidates[0]) if candidates else 0


def _on_the_left(points: Floats, a: Floats, b: Floats, level: float) -> NDArray[np.bool_]:
    """Which points lie on the line from a to b, or to its left."""
    found: NDArray[np.bool_] = (b[0] - a[0]) * (points[:, 1] - a[1]) - (b[1] - a[1]) * (points[:, 0] - a[0]) >= -level
    return found


def _equal_to_any(points: Floats, some: tuple[Floats, ...]) -> NDArray[np.bool_]:
    """Which points equal one of some."""
    found: NDArray[np.bool_] = np.any([(points == one).all(axis=1) for one in some], axis=0)
    return found
