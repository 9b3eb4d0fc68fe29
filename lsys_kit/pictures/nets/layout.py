"""Layout: the coordinates of a stage diagram, in pixels, computed from its plan."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate, combinations, pairwise
from typing import TypeAlias

from lsys_kit.derivation.petri.net import Stages
from lsys_kit.pictures.nets.routes import Plan, Route

RADIUS = 17.0
BAR = 13.0
"""Half the height of a bar."""
LABEL = 22.0
"""The distance from a circle to the lower edge of its label."""
LANE, SLOT, STEP = 14.0, 7.0, 6.0
"""The distances of neighbouring lanes in gaps, in channels and margins, and at the bars."""
LANDING = 24.0
"""The distance from the lowest lane to the row."""
BEFORE_BAR, BEFORE_BARS = 17.0, 30.0
"""The distance from a circle to its bar, or to several bars."""
STACKED = 38.0
"""The distance of the bars of one place."""
ARROW_LENGTH = 17.0
"""The length of the last segment of an arrow."""
ROUND = 10.0
"""The radius of a line's corners."""
EDGE = 14.0
"""White space around the picture."""

Point: TypeAlias = tuple[float, float]


@dataclass(frozen=True)
class Texts:
    """The widths of the texts of a diagram: labels by place, terms by transition, notes by arc."""

    labels: Mapping[int, float]
    terms: Mapping[int, float]
    notes: Mapping[int, float]


@dataclass(frozen=True)
class BarPosition:
    """The position of a bar: its centre, half its height, the line to it, and the left end of the baseline of its terms."""

    x: float
    y: float
    half: float
    line: tuple[Point, ...]
    terms: Point


@dataclass(frozen=True)
class Layout:
    """The positions of all parts of a diagram.

    Attributes
    ----------
    width, height
        Of the picture.
    circles
        For each place the centre of its circle.
    bars
        For each transition its bar.
    arcs
        For each arc the vertices of its line, from the bar to the circle.
    notes
        For each arc with a note the centre of the note.
    """

    width: float
    height: float
    circles: Mapping[int, Point]
    bars: Mapping[int, BarPosition]
    arcs: Mapping[int, tuple[Point, ...]]
    notes: Mapping[int, Point]


@dataclass(frozen=True)
class _Grid:
    """The reference lines of a layout: columns, rows and the base of the lanes of each gap."""

    columns: tuple[float, ...]
    rows: tuple[float, ...]
    tops: tuple[float, ...]
    bars: tuple[float, ...]
    slots: tuple[float, ...]
    margins: tuple[float, float]
    width: float
    height: float

    def lane(self, gap: int, level: int) -> float:
        """The vertical position of a lane."""
        return self.tops[gap] - LANDING - level * LANE

    def margin(self, side: int, level: int) -> float:
        """The horizontal position of a lane of a margin."""
        return self.margins[side > 0] + side * level * SLOT


def layout_of(net: Stages, plan: Plan, texts: Texts) -> Layout:
    """The layout of a plan."""
    grid = _grid(net, plan, texts)
    circles = {place: (grid.columns[c], grid.rows[r]) for r, row in enumerate(plan.rows) for c, place in enumerate(row)}
    heights = _exit_heights(plan, circles)
    bars = {
        number: bar
        for place, own in plan.bars.items()
        for number, bar in _bars(
            own, circles[place], grid.bars[_column(plan, place)], heights, plan, texts.labels[place]
        ).items()
    }
    arcs = {route.arc: _corners(route, net, plan, grid, circles, heights) for route in plan.routes}
    notes = {arc: _note(arc, width, arcs) for arc, width in texts.notes.items() if arc in arcs}
    return Layout(grid.width, grid.height, circles, bars, arcs, notes)


def crossings(layout: Layout) -> int:
    """The number of points in which two arcs of a layout cross."""
    return sum(_crossings(a, b) for a, b in combinations(layout.arcs.values(), 2))


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


def _crossings(first: Sequence[Point], second: Sequence[Point]) -> int:
    """The number of points in which two lines cross, each a sequence of vertices."""
    return sum(
        _turn(p, q, r) * _turn(p, q, s) < 0 and _turn(r, s, p) * _turn(r, s, q) < 0
        for p, q in pairwise(first)
        for r, s in pairwise(second)
    )


def _turn(a: Point, b: Point, c: Point) -> float:
    """Twice the area of a triangle: positive or negative by the side of a line on which a point lies."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _column(plan: Plan, place: int) -> int:
    return next(row.index(place) for row in plan.rows if place in row)


def _grid(net: Stages, plan: Plan, texts: Texts) -> _Grid:
    columns = [[row[c] for row in plan.rows if c < len(row)] for c in range(max(map(len, plan.rows), default=0))]
    west = [max(RADIUS + ARROW_LENGTH, *(texts.labels[place] / 2 + 6 for place in column)) for column in columns]
    bars = [max(_before_bar(plan, place, texts.labels[place]) for place in column) for column in columns]
    slots = [max(_turning(plan, place, bar, texts) for place in column) for bar, column in zip(bars, columns, strict=True)]
    east = [start + _taken(plan, c, texts) for c, start in enumerate(slots)]
    pitches = [a + b for a, b in zip(east, west[1:], strict=False)]
    if pitches and not net.grouped:
        pitches = [max(pitches)] * len(pitches)
    sides = [[plan.climbs[route.arc] for route in plan.routes if route.side == side] for side in (-1, 1)]
    room = [(max(levels) + 1) * SLOT if levels else 0.0 for levels in sides]
    first = west[0] if room[0] else max([RADIUS, *(texts.labels[place] / 2 for column in columns[:1] for place in column)])
    xs = tuple(accumulate(pitches, initial=EDGE + room[0] + first))
    right = max((x + reach for x, reach in zip(xs, east, strict=False)), default=0.0)
    ys, tops, bottom = _row_positions(plan)
    return _Grid(
        xs,
        ys,
        tops,
        tuple(bars),
        tuple(slots),
        (xs[0] - (west[0] if west else 0), right + 4),
        right + room[1] + EDGE,
        bottom + EDGE,
    )


def _before_bar(plan: Plan, place: int, label: float) -> float:
    if len(plan.bars[place]) < 2:
        return RADIUS + BEFORE_BAR * len(plan.bars[place])
    return max(RADIUS + BEFORE_BARS, label / 2 + 22)


def _turning(plan: Plan, place: int, bar: float, texts: Texts) -> float:
    """Where lines first turn off in a channel: to the right of terms and labels, with room for the note of a loop."""
    loops = (arc for arc in plan.entries.get(place, ()) if any(arc in plan.exits[t] for t in plan.bars[place]))
    return max(
        bar + 10 + _widest(texts.terms, plan.bars[place]), texts.labels[place] / 2 + 6, _widest(texts.notes, loops) + 2 * ROUND
    )


def _taken(plan: Plan, column: int, texts: Texts) -> float:
    """The width of a channel's lanes and notes."""
    ours = [route for route in plan.routes if route.source[1] == column]
    slots = [plan.slots[route.arc] for route in ours if route.arc in plan.slots]
    note = _widest(texts.notes, (route.arc for route in ours if route.direct))
    return (max(slots) * SLOT + 8 if slots else 0.0) + (note - 6 if note else 0.0)


def _widest(widths: Mapping[int, float], keys: Iterable[int]) -> float:
    return max((widths[key] + 8 for key in keys if key in widths), default=0.0)


def _row_positions(plan: Plan) -> tuple[tuple[float, ...], tuple[float, ...], float]:
    """The middle and the upper edge of each row, and the lower edge of the last."""
    middles, tops, bottom = [], [], EDGE
    for number, row in enumerate(plan.rows):
        stack = max((len(plan.bars[place]) - 1) * STACKED / 2 + BAR + 8 for place in row)
        lanes = [level for (_, gap), level in plan.lanes.items() if gap == number]
        above = LANDING + max(lanes) * LANE + (LANE if number else 0) if lanes else (18.0 if number else 0.0)
        tops.append(bottom + above)
        middles.append(tops[-1] + max(RADIUS, stack))
        bottom = middles[-1] + max(RADIUS + LABEL, stack)
    return tuple(middles), tuple(tops), bottom


def _exit_heights(plan: Plan, circles: Mapping[int, Point]) -> dict[int, float]:
    """The vertical position at which each arc leaves its bar; a direct arc leaves it in the middle."""
    direct = {route.arc for route in plan.routes if route.direct}
    found = {}
    for place, own in plan.bars.items():
        for number, bar in enumerate(own):
            leaving = plan.exits[bar]
            middle = next((i for i, arc in enumerate(leaving) if arc in direct), (len(leaving) - 1) / 2)
            step = min(STEP, (18.0 if len(own) == 1 else 10.0) / max(1.0, middle, len(leaving) - 1 - middle))
            y = circles[place][1] + (number - (len(own) - 1) / 2) * STACKED
            found.update({arc: y + (i - middle) * step for i, arc in enumerate(leaving)})
    return found


def _bars(
    own: Sequence[int], circle: Point, reach: float, heights: Mapping[int, float], plan: Plan, label: float
) -> dict[int, BarPosition]:
    """The bars of a place, and the lines to them; the line to one of several bars turns beside the label."""
    found = {}
    x, start = circle[0] + reach, (circle[0] + RADIUS, circle[1])
    bend = circle[0] + max(RADIUS + 12, label / 2 + 8)
    for number, bar in enumerate(own):
        y = circle[1] + (number - (len(own) - 1) / 2) * STACKED
        ends = [heights[arc] for arc in plan.exits[bar]] or [y]
        half = max([BAR, *(abs(end - y) + 4 for end in ends)])
        line = (start, (x, y)) if y == circle[1] else (start, (bend, circle[1]), (bend, y), (x, y))
        found[bar] = BarPosition(x, y, half, line, (x + 6, min(ends) - 5))
    return found


def _corners(
    route: Route, net: Stages, plan: Plan, grid: _Grid, circles: Mapping[int, Point], heights: Mapping[int, float]
) -> tuple[Point, ...]:
    """The vertices of the line of an arc."""
    arc, (row, column), to = route.arc, route.source, route.target[0]
    place = net.arcs[arc].place
    x, y, y_circle = grid.columns[column] + grid.bars[column], heights[arc], circles[place][1]
    if route.direct:
        return (x, y), (circles[place][0] - RADIUS, y)
    corners = [(x, y)]
    levels = []
    if route.way:
        gap = row if route.way < 0 else row + 1
        turn = grid.columns[column] + grid.slots[column] + plan.slots[arc] * SLOT
        levels.append((turn, grid.lane(gap, plan.lanes[arc, gap])))
    if route.side:
        levels.append((grid.margin(route.side, plan.climbs[arc]), grid.lane(to, plan.lanes[arc, to])))
    for turn, lane in levels:
        corners += [(turn, corners[-1][1]), (turn, lane)]
    shift = _shift(arc, plan.entries[place])
    end = circles[place][0] + shift
    return (*corners, (end, corners[-1][1]), (end, y_circle - (RADIUS**2 - shift**2) ** 0.5))


def _shift(arc: int, entries: Sequence[int]) -> float:
    """The horizontal offset from the centre at which an arc meets its circle."""
    middle = (len(entries) - 1) / 2
    return (entries.index(arc) - middle) * min(9.0, 0.7 * RADIUS / max(1.0, middle))


def _note(arc: int, width: float, arcs: Mapping[int, tuple[Point, ...]]) -> Point:
    """The position of the note of an arc: on its lane, in the widest stretch without crossings; above a direct arc."""
    corners = arcs[arc]
    if len(corners) == 2:
        return corners[1][0] - 6 - width / 2, corners[1][1] - 10
    lanes = list(pairwise(corners))[2::2]
    others = [line for other, line in arcs.items() if other != arc]
    middle = (lanes[-1][0][0] + lanes[-1][1][0]) / 2

    def fitness(free: tuple[float, float, float]) -> tuple[float, float]:
        return min(free[1] - free[0], width + 40), -abs((free[0] + free[1]) / 2 - middle)

    left, right, y = max((free for a, b in lanes for free in _free_intervals(a, b, others)), key=fitness)
    return (left + right) / 2, y


def _free_intervals(a: Point, b: Point, others: Iterable[Sequence[Point]]) -> list[tuple[float, float, float]]:
    """The intervals of a lane between the lines that cross it, each with the vertical position of the lane."""
    left, right = sorted((a[0], b[0]))
    cuts = {
        p[0]
        for line in others
        for p, q in pairwise(line)
        if p[0] == q[0] and min(p[1], q[1]) - 7 < a[1] < max(p[1], q[1]) + 7 and left < p[0] < right
    }
    return [(start, end, a[1]) for start, end in pairwise([left, *sorted(cuts), right])]
