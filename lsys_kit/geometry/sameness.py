"""Whether two drawings are the same up to position, turn and size.

A stroke is a tuple: x and y of its beginning and of its end, in space x, y and z of each. Students draw some hundred strokes,
for which no arrays are needed.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import product
from operator import mul

from lsys_kit.budget import check_budget, counted
from lsys_kit.geometry.scene import Stroke
from lsys_kit.geometry.turtle.space import Vector, cross, unit

TOLERANCE = 1e-4
"""How far two ends may be apart that are the same, where a drawing has the size 1."""
WIDE = 16
"""So many tolerances wide are the cells in which strokes are looked up by their middles."""
STROKES_BETWEEN_CHECKS = 2**8
AXES = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
LEAST_ANGLE = 1e-9
"""Points whose directions differ by less, in radians, lie on one line."""


def normalised(strokes: Sequence[Stroke]) -> list[Stroke]:
    """Strokes moved to their centre and scaled to size 1.

    >>> normalised([(3.0, 5.0, 3.0, 9.0)])
    [(0.0, -1.0, 0.0, 1.0)]
    """
    if not strokes:
        return []
    points = [point for stroke in strokes for point in _ends(stroke)]
    centre = [math.fsum(axis) / len(points) for axis in zip(*points, strict=True)]
    size = math.sqrt(math.fsum(math.dist(point, centre) ** 2 for point in points) / len(points)) or 1.0
    return [tuple((at - by) / size for at, by in zip(stroke, (*centre, *centre), strict=True)) for stroke in strokes]


def _ends(stroke: Stroke) -> tuple[Stroke, Stroke]:
    half = len(stroke) // 2
    return stroke[:half], stroke[half:]


def same_strokes(mine: Sequence[Stroke], wanted: Sequence[Stroke], tolerance: float = TOLERANCE, turned: bool = True) -> bool:
    """Whether normalised strokes are the same, after a turn unless that counts, in whatever order and direction.

    >>> square = normalised([(0, 0, 1, 0), (1, 0, 1, 1), (1, 1, 0, 1), (0, 1, 0, 0)])
    >>> same_strokes([(-y, x, -v, u) for x, y, u, v in square[::-1]], square)
    True
    """
    if len(mine) != len(wanted):
        return False
    if not mine:
        return True
    if len(mine[0]) != len(wanted[0]):
        return False
    if len(mine[0]) == 6 and turned:
        return _same_in_space(mine, wanted, tolerance)
    own, other = _ByMiddle(mine, tolerance), _ByMiddle(wanted, tolerance)
    turns = _turns(mine, wanted, tolerance) if turned else [None]
    return any(
        all(
            own.many(stroke if by is None else _turned(stroke, *by)) == other.many(stroke)
            for stroke in counted(wanted, STROKES_BETWEEN_CHECKS)
        )
        for by in turns
    )


def _turned(stroke: Stroke, cos: float, sin: float) -> Stroke:
    x, y, u, v = stroke
    return cos * x - sin * y, sin * x + cos * y, cos * u - sin * v, sin * u + cos * v


def _turns(mine: Sequence[Stroke], wanted: Sequence[Stroke], tolerance: float) -> Iterator[tuple[float, float]]:
    """The turns that bring a point of one drawing to the outermost of the other: their cosines and sines."""
    outermost, radius = max(((point, math.hypot(*point)) for stroke in mine for point in _ends(stroke)), key=lambda at: at[1])
    seen: set[float] = set()
    for x, y in (point for stroke in wanted for point in _ends(stroke)):
        if abs(math.hypot(x, y) - radius) < tolerance / 10:
            by = math.atan2(outermost[1], outermost[0]) - math.atan2(y, x)
            if (turn := round(by % math.tau, 5)) not in seen:
                check_budget()
                seen.add(turn)
                yield math.cos(by), math.sin(by)


class _ByMiddle:
    """Strokes, looked up by their middles, which have no direction."""

    def __init__(self, strokes: Sequence[Stroke], tolerance: float) -> None:
        self.tolerance, self.width = tolerance, WIDE * tolerance
        self.cells = defaultdict[tuple[int, ...], list[Stroke]](list)
        for stroke in strokes:
            self.cells[tuple(math.floor(at / self.width) for at in _middle(stroke))].append(stroke)

    def many(self, place: Stroke) -> int:
        """How many strokes there are at a place, in one direction and in the other."""
        start, end = _ends(place)
        near = product(
            *(
                {math.floor((at - self.tolerance) / self.width), math.floor((at + self.tolerance) / self.width)}
                for at in _middle(place)
            )
        )
        back = (*end, *start)
        return sum(
            (math.dist(stroke, place) <= self.tolerance) + (math.dist(stroke, back) <= self.tolerance)
            for cell in near
            for stroke in self.cells.get(cell, ())
        )


def _middle(stroke: Stroke) -> Iterator[float]:
    return ((at + to) / 2 for at, to in zip(*_ends(stroke), strict=True))


def _same_in_space(mine: Sequence[Stroke], wanted: Sequence[Stroke], tolerance: float) -> bool:
    """Whether strokes in space, in their order, are the same after a rotation: as seen from the centre towards the farthest
    point, with the point that is farthest from that line to the side."""
    own, other = ([point for stroke in strokes for point in _in_space(stroke)] for strokes in (mine, wanted))
    far = max(range(len(other)), key=lambda number: math.hypot(*other[number]))
    beside = max(range(len(other)), key=lambda number: math.hypot(*cross(other[number], other[far])))
    at_a_point = min(math.hypot(*own[far]), math.hypot(*other[far])) < tolerance
    frames = [AXES if at_a_point else _frame(points[far], points[beside]) for points in (own, other)]
    return all(
        math.dist(*(_seen(point, frame) for point, frame in zip(pair, frames, strict=True))) < tolerance
        for pair in counted(zip(own, other, strict=True), STROKES_BETWEEN_CHECKS)
    )


def _in_space(stroke: Stroke) -> tuple[Vector, Vector]:
    x, y, z, u, v, w = stroke
    return (x, y, z), (u, v, w)


def _frame(ahead: Vector, beside: Vector) -> tuple[Vector, Vector, Vector]:
    """Three unit vectors at right angles: ahead, across in the plane of both, and the third."""
    third = cross(ahead, beside)
    if math.hypot(*third) < LEAST_ANGLE * math.hypot(*ahead) ** 2:  # all lies on one line
        third = max((cross(ahead, axis) for axis in AXES[:2]), key=lambda found: math.hypot(*found))
    return unit(ahead), unit(cross(third, ahead)), unit(third)


def _seen(point: Vector, frame: tuple[Vector, Vector, Vector]) -> Vector:
    x, y, z = (sum(map(mul, axis, point)) for axis in frame)
    return x, y, z
