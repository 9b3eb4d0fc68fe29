"""Layout: the coordinates of a stage diagram, in pixels."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations, pairwise
from typing import NamedTuple, TypeAlias

RADIUS = 17.0
BAR = 13.0
"""Half the height of a bar."""
LABEL = 22.0
"""The distance from a circle to the lower edge of its label."""
ARROW_LENGTH = 17.0
"""The length of the last segment of an arrow."""
ROUND = 10.0
"""The radius of a line's corners."""
EDGE = 14.0
"""White space around the picture."""

Point: TypeAlias = tuple[float, float]


class Texts(NamedTuple):
    """The widths of the texts of a diagram: labels by place, terms by transition, notes by arc."""

    labels: Mapping[int, float]
    terms: Mapping[int, float]
    notes: Mapping[int, float]


class BarPosition(NamedTuple):
    """The position of a bar: its centre, half its height, the line to it, and the left end of the baseline of its terms."""

    x: float
    y: float
    half: float
    line: tuple[Point, ...]
    terms: Point


class Layout(NamedTuple):
    """The positions of all parts of a diagram: for each place the centre of its circle, for each arc the vertices of its line,
    from the bar to the circle, and for each arc with a note the centre of that."""

    width: float
    height: float
    circles: Mapping[int, Point]
    bars: Mapping[int, BarPosition]
    arcs: Mapping[int, tuple[Point, ...]]
    notes: Mapping[int, Point]


def crossings(layout: Layout) -> int:
    """The number of points in which two arcs of a layout cross."""
    return sum(
        _turn(p, q, r) * _turn(p, q, s) < 0 and _turn(r, s, p) * _turn(r, s, q) < 0
        for first, second in combinations(layout.arcs.values(), 2)
        for p, q in pairwise(first)
        for r, s in pairwise(second)
    )


def crossed_notes(layout: Layout, widths: Mapping[int, float]) -> int:
    """The number of notes on arcs, of given widths, that another arc runs through."""
    return sum(
        any(
            p[0] == q[0]
            and abs(p[0] - layout.notes[arc][0]) < widths[arc] / 2
            and min(p[1], q[1]) - 7 < layout.notes[arc][1] < max(p[1], q[1]) + 7
            for other, line in layout.arcs.items()
            if other != arc
            for p, q in pairwise(line)
        )
        for arc in layout.notes
    )


def _turn(a: Point, b: Point, c: Point) -> float:
    """Twice the area of a triangle: positive or negative by the side of a line on which a point lies."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
