"""Whether two drawings are the same up to position, turn and size."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget
from lsys_kit.geometry.scene import Floats

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

TOLERANCE = 1e-6
"""How far two ends may be apart that are the same, where a drawing has the size 1."""


def normalised(ends: Floats) -> Floats:
    """Strokes moved to their centre and scaled to size 1: shape (n, 4) or (n, 6), as they were.

    >>> normalised(np.array([[3.0, 5, 3, 9]])).tolist()
    [[0.0, -1.0, 0.0, 1.0]]
    """
    if not len(ends):
        return ends
    dimension = ends.shape[1] // 2
    points = ends.reshape(-1, dimension)
    points = points - points.mean(axis=0)
    size = float(np.sqrt((points**2).sum(axis=1).mean()))
    return np.asarray(points / (size or 1), dtype=float).reshape(-1, 2 * dimension)


def same_strokes(mine: Floats, wanted: Floats, tolerance: float = 100 * TOLERANCE, turned: bool = True) -> bool:
    """Whether normalised strokes are the same, after a turn unless that counts, in whatever order and direction.

    >>> square = normalised(np.array([[0.0, 0, 1, 0], [1, 0, 1, 1], [1, 1, 0, 1], [0, 1, 0, 0]]))
    >>> same_strokes(square @ np.kron(np.eye(2), np.array([[0, 1], [-1, 0]])), square)
    True
    """
    if mine.shape != wanted.shape:
        return False
    if not len(mine):
        return True
    if mine.shape[1] == 6 and turned:
        return _same_in_space(mine, wanted, tolerance)
    if not turned:
        return _covers(mine, wanted, tolerance)
    return any(_covers(mine @ np.kron(np.eye(2), turn), wanted, tolerance) for turn in _turns(mine, wanted, tolerance))


def _turns(mine: Floats, wanted: Floats, tolerance: float) -> Iterator[Floats]:
    """The turns that bring the outermost point of one drawing to a point of the other."""
    own, other = mine.reshape(-1, 2), wanted.reshape(-1, 2)
    radii = np.hypot(*own.T)
    outermost = own[int(radii.argmax())]
    angle = np.arctan2(outermost[1], outermost[0])
    seen: set[float] = set()
    for x, y in other[np.abs(np.hypot(*other.T) - radii.max()) < tolerance / 10]:
        turn = round(float(np.arctan2(y, x) - angle) % (2 * np.pi), 5)
        if turn not in seen:
            check_budget()
            seen.add(turn)
            by = np.arctan2(y, x) - angle
            yield np.array([[np.cos(by), np.sin(by)], [-np.sin(by), np.cos(by)]])


def _covers(mine: Floats, wanted: Floats, tolerance: float) -> bool:
    """Whether at each place where one drawing has strokes, the other has as many."""
    places, own, other = wanted, _both_ways(mine), _both_ways(wanted)
    if (own.query(places)[0] >= tolerance).any():
        return False
    counts = [tree.query_ball_point(places, tolerance, return_length=True) for tree in (own, other)]
    return bool((counts[0] == counts[1]).all())


def _both_ways(strokes: Floats) -> cKDTree:
    from scipy.spatial import cKDTree

    return cKDTree(np.concatenate([strokes, np.roll(strokes, strokes.shape[1] // 2, axis=1)]))


def _same_in_space(mine: Floats, wanted: Floats, tolerance: float) -> bool:
    """Whether strokes in space, in their order, are the same after a rotation (Kabsch 1976)."""
    own, other = mine.reshape(-1, 3), wanted.reshape(-1, 3)
    left, _, right = np.linalg.svd(own.T @ other)
    mirror = np.diag([1, 1, np.sign(np.linalg.det(left @ right))])
    return bool(np.allclose(own @ (left @ mirror @ right), other, atol=tolerance))
