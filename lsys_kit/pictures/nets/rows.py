"""The layout of a stage diagram in rows of places, as in print.

Places stand in the columns of a grid, bars to their right in the channels between the columns. An arc to the right neighbour is
direct. Every other arc leaves its bar sideways, turns up or down in the channel, runs in a lane of the gap above the row of its
target, and enters the target from above: so no arc can meet a circle. To a row that is not adjacent it runs through a margin.
Lanes are parallel lines side by side, in an order with few crossings.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import accumulate, pairwise
from math import ceil
from typing import NamedTuple, TypeAlias

from lsys_kit.budget import counted
from lsys_kit.derivation.petri.net import Stages
from lsys_kit.errors import ModelLimitError
from lsys_kit.pictures.nets.layout import ARROW_LENGTH, BAR, EDGE, LABEL, RADIUS, ROUND, BarPosition, Layout, Point, Texts
from lsys_kit.pictures.style.labels import polar_symbols

LONGEST_ROW, MOST_ARCS = 8, 800
"""The most places in a row, and the most arcs of a diagram."""
LANE, SLOT, STEP = 14.0, 7.0, 6.0
"""The distances of neighbouring lanes in gaps, in channels and margins, and at the bars."""
LANDING = 24.0
"""The distance from the lowest lane to the row."""
BEFORE_BAR, BEFORE_BARS, STACKED = 17.0, 30.0, 38.0
"""The distance from a circle to its bar, or to several bars, and that of the bars of one place."""
_GAP = 1000.0
"""The distance of gaps in units of lanes."""

Stretch: TypeAlias = tuple[tuple[float, int], tuple[float, int]]
"""The straight part of a line that runs in a lane: for each end, the lower one first, its position along the lane and the side
to which the line turns off (-1: up or left, 1: down or right), and crosses the stretches that it meets there."""


class Route(NamedTuple):
    """The route of an arc: its number in the net; the row and column of the place whose bar it leaves, and of that to which it
    leads; the direction in which it leaves the bar (-1 up, 1 down, 0 straight on), and the margin through which it runs (-1
    left, 1 right, 0 none)."""

    arc: int
    source: tuple[int, int]
    target: tuple[int, int]
    way: int
    side: int

    @property
    def direct(self) -> bool:
        """Whether the arc is the straight line to the right neighbour."""
        return self.way == self.side == 0

    @property
    def gap(self) -> int:
        """The gap that it enters from its bar."""
        return self.source[0] + (self.way >= 0)


def shown_places(net: Stages, steering: Collection[str]) -> tuple[int, ...]:
    """The places that are drawn: all except those that are never rewritten and only steer the turtle."""
    moved = {transition.place for transition in net.transitions}
    return tuple(i for i, place in enumerate(net.places) if i in moved or place.symbol not in steering)


def rows_of(net: Stages, shown: Collection[int], longest: int = LONGEST_ROW) -> tuple[tuple[int, ...], ...]:
    """The rows of places: one for each symbol with several stages, one for all others; longer rows than allowed are wrapped.

    >>> from lsys_kit import read, stages
    >>> rows_of(stages(read("axiom: L\\nS -> L\\nL -> A\\nA -> LS")), {0, 1, 2})
    ((2, 0, 1),)
    """
    symbols, pairs = {place: net.places[place].symbol for place in sorted(shown)}, polar_symbols(net.system)
    bases = {place: pairs.get(symbol, (symbol, ""))[0] for place, symbol in symbols.items()}
    often = Counter(bases.values())
    groups: dict[str, list[int]] = {}
    for place, base in bases.items():
        groups.setdefault(base if often[base] > 1 else "", []).append(place)
    rows = []
    for chain in (_chained(net, group) for group in groups.values()):
        size = ceil(len(chain) / ceil(len(chain) / longest))
        rows += [tuple(chain[i : i + size]) for i in range(0, len(chain), size)]
    return tuple(rows)


def _chained(net: Stages, group: Sequence[int]) -> list[int]:
    """Places in the order in which a module passes through them; a chain begins at a stage without predecessors."""
    leads: dict[int, list[int]] = {place: [] for place in group}
    sole: dict[int, list[int]] = {place: [] for place in group}  # by transitions that make one token
    made: Counter[int] = Counter()
    for arc in net.arcs:
        made[arc.transition] += arc.copies
    for arc in net.arcs:
        place = net.transitions[arc.transition].place
        if place in leads and arc.place in leads:
            leads[place].append(arc.place)
            sole[place] += [arc.place] * (made[arc.transition] <= 1)
    led = {target for place, targets in sole.items() for target in targets if target != place}
    left = sorted(group, key=lambda place: (place in led, not leads[place], place))
    chain = []
    while left:
        following: int | None = left[0]
        while following is not None:
            chain.append(following)
            left.remove(following)
            onward = [*sole[following], *sorted(leads[following], key=lambda place: not leads.get(place))]
            following = next((place for place in onward if place in left), None)
    return chain


def crossings(first: Stretch, second: Stretch) -> int:
    """The number of crossings of two lines, if the lane of the first lies on the -1 side of that of the second.

    >>> crossings(((0, 1), (3, 1)), ((1, 1), (2, 1))), crossings(((1, 1), (2, 1)), ((0, 1), (3, 1)))
    (0, 2)
    """
    (low, _), (high, _) = first
    (least, _), (most, _) = second
    count = sum(side > 0 and least < end < most for end, side in first)
    count += sum(side < 0 and low < end < high for end, side in second)
    for end, side in first:
        count += sum(end == other and side > 0 > way and (end == low) == (other == least) for other, way in second)
    return count


def ordered(stretches: Sequence[Stretch]) -> list[int]:
    """The numbers of the stretches in the order of their lanes, from the -1 side.

    Initially longer stretches lie outside, and later ones before earlier ones of the same length; then each is moved to its
    best place until no move reduces the crossings.

    >>> ordered([((1, 1), (2, 1)), ((0, 1), (3, 1))])
    [1, 0]
    """
    order = sorted(range(len(stretches)), key=lambda i: (stretches[i][0][0] - stretches[i][1][0], -i))
    cost = [[crossings(a, b) for b in stretches] for a in counted(stretches, 1)]
    improved = True
    while improved:
        improved = False
        for number in counted(tuple(order), 1):
            now = order.index(number)
            rest = order[:now] + order[now + 1 :]
            totals = [sum(cost[number][other] for other in rest)]
            for other in rest:
                totals.append(totals[-1] - cost[number][other] + cost[other][number])
            best = min(range(len(totals)), key=lambda place: (totals[place], abs(place - now)))
            if totals[best] != totals[now]:
                order, improved = [*rest[:best], number, *rest[best:]], True
    return order


def levels(stretches: Sequence[Stretch], order: Sequence[int]) -> list[int]:
    """The lane of each stretch, from 0: stretches that do not overlap share a lane, and the order is kept.

    >>> levels([((0, 1), (1, 1)), ((2, 1), (3, 1)), ((0, 1), (3, 1))], [0, 1, 2])
    [0, 0, 1]
    """
    found = [0] * len(stretches)
    for place, number in enumerate(order):
        (low, _), (high, _) = stretches[number]
        others = (other for other in order[:place] if low <= stretches[other][1][0] and stretches[other][0][0] <= high)
        found[number] = max((found[other] + 1 for other in others), default=0)
    return found


def layout_in_rows(net: Stages, rows: Sequence[tuple[int, ...]], texts: Texts) -> Layout:
    """The layout of a net with given rows of places; refused where it has too many arcs."""
    if len(net.arcs) > MOST_ARCS:
        raise ModelLimitError(
            f"A stage diagram with {len(net.arcs):,} arcs would not be legible; it may have {MOST_ARCS:,}",
            limit=MOST_ARCS,
            needed=len(net.arcs),
            hint="print(stages(system)) writes it as text.",
        )
    return _Rows(net, rows, texts).layout()


class _Rows:
    """A diagram in rows: the routes of its arcs; then for each arc and gap the number of its lane, counted from the row below
    (gap r is the one above row r), for each arc through a margin that of its lane there, counted from the rows, and for each
    that turns off in a channel that of its lane there, counted from the bar; then the arcs that leave each bar, from top to
    bottom, and those that enter each place from above, from left to right; and last the coordinates."""

    def __init__(self, net: Stages, rows: Sequence[tuple[int, ...]], texts: Texts) -> None:
        self.net, self.rows, self.texts = net, rows, texts
        self.cells = {place: (r, c) for r, row in enumerate(rows) for c, place in enumerate(row)}
        self.columns = max(map(len, rows), default=0)
        self.bars: dict[int, list[int]] = {place: [] for place in self.cells}
        for number, transition in enumerate(net.transitions):
            if transition.place in self.bars:
                self.bars[transition.place].append(number)
        self.routes = [self._route(number) for number, arc in enumerate(net.arcs) if arc.place in self.cells]
        self.lanes = self._lanes()
        self.climbs = self._climbs()
        self.slots = self._slots()
        self.exits, self.entries = self._exits(), self._entries()

    def _route(self, number: int) -> Route:
        """The route of an arc, the shorter one if there are two."""
        arc = self.net.arcs[number]
        place = self.net.transitions[arc.transition].place
        (row, column), (to, at) = self.cells[place], self.cells[arc.place]
        if (to, at) == (row, column + 1) and len(self.bars[place]) == 1:
            way = side = 0
        elif to in (row, row + 1):
            way, side = (-1 if to == row else 1), 0
        elif column == len(self.rows[row]) - 1:
            way, side = 0, 1
        else:
            way, side = (-1 if to < row else 1), (-1 if column + at < self.columns - 1 else 1)
        return Route(number, (row, column), (to, at), way, side)

    def _stretches(self, route: Route) -> list[tuple[int, Stretch]]:
        """The gaps through which an arc runs, with its stretch in each; positions are columns."""
        row, (to, at) = route.source[0], route.target
        leave, arrive = (self._leaves(route), -route.way), (float(at), 1)
        margin = -1.0 if route.side < 0 else float(self.columns)
        if route.direct:
            return []
        if not route.side:
            return [(route.gap, _between(leave, arrive))]
        if not route.way:
            return [(to, _between((margin, 1 if to <= row else -1), arrive))]
        turn = 1 if to > route.gap else -1
        return [(route.gap, _between(leave, (margin, turn))), (to, _between((margin, -turn), arrive))]

    def _leaves(self, route: Route) -> float:
        """Where an arc turns off in its channel, half-way between two columns; those of the bars of one place further to the
        right, the more bars the way up or down passes, so that they do not cross what leaves these."""
        transition = self.net.arcs[route.arc].transition
        bars = self.bars[self.net.transitions[transition].place]
        passed = bars.index(transition) if route.way < 0 else len(bars) - 1 - bars.index(transition)
        return route.source[1] + 0.5 + 0.25 * passed / len(bars)

    def _lanes(self) -> dict[tuple[int, int], int]:
        gaps: defaultdict[int, list[tuple[int, Stretch]]] = defaultdict(list)
        for route in self.routes:
            for gap, stretch in self._stretches(route):
                gaps[gap].append((route.arc, stretch))
        found = {}
        for gap, members in gaps.items():
            stretches = [stretch for _, stretch in members]
            for (arc, _), level in zip(members, levels(stretches, ordered(stretches)[::-1]), strict=True):
                found[arc, gap] = level
        return found

    def _climbs(self) -> dict[int, int]:
        """The lanes in the margins; positions there count gaps, from the top."""
        found = {}
        for side in (-1, 1):
            members, stretches = [route for route in self.routes if route.side == side], []
            for arc, (row, _), (to, _), way, _ in members:
                gap = row + (way >= 0)
                begin = _GAP * gap - self.lanes[arc, gap] if way else _GAP * row + _GAP / 2
                stretches.append(_between((begin, -side), (_GAP * to - self.lanes[arc, to], -side)))
            for route, level in zip(members, levels(stretches, ordered(stretches)[::side]), strict=True):
                found[route.arc] = level
        return found

    def _slots(self) -> dict[int, int]:
        """Lanes in the channels, such that the arcs of one bar do not cross there."""
        channels: defaultdict[tuple[int, int], list[tuple[bool, int, int]]] = defaultdict(list)
        for route in self.routes:
            if route.way:
                gap, ((low, _), _) = self._stretches(route)[0]
                onward, far = low == self._leaves(route), -route.way * self.lanes[route.arc, gap]
                channels[gap, route.source[1]].append((onward, -far if onward else far, route.arc))
        return {arc: slot for members in channels.values() for slot, (_, _, arc) in enumerate(sorted(members))}

    def _exits(self) -> dict[int, list[int]]:
        """Arcs that turn up, go straight on, and turn down."""
        found: dict[int, list[tuple[int, int, int]]] = {number: [] for number in range(len(self.net.transitions))}
        for route in self.routes:
            up = route.target[0] < route.source[0]
            depth = self.slots[route.arc] if route.way else self.climbs.get(route.arc, 0) * (1 if up else -1)
            leaving = found[self.net.arcs[route.arc].transition]
            leaving.append((route.way, -depth if route.way > 0 else depth, route.arc))
        return {number: [arc for _, _, arc in sorted(leaving)] for number, leaving in found.items()}

    def _entries(self) -> dict[int, list[int]]:
        """Arcs from the left, the nearest lane first, then those from the right."""
        found: defaultdict[int, list[tuple[bool, int, int]]] = defaultdict(list)
        for route in self.routes:
            if not route.direct:
                level = self.lanes[route.arc, route.target[0]]
                rightward = route.side > 0 or (route.side == 0 and route.source[1] >= route.target[1])
                found[self.net.arcs[route.arc].place].append((rightward, -level if rightward else level, route.arc))
        return {place: [arc for _, _, arc in sorted(coming)] for place, coming in found.items()}

    def layout(self) -> Layout:
        """The coordinates."""
        width, height = self._set_columns(), self._set_rows()
        self.circles = {place: (self.xs[c], self.ys[r]) for place, (r, c) in self.cells.items()}
        self.heights = self._heights()
        bars = {number: bar for place in self.bars for number, bar in self._bars(place).items()}
        arcs = {route.arc: self._corners(route) for route in self.routes}
        notes = {arc: _note(arc, size, arcs) for arc, size in self.texts.notes.items() if arc in arcs}
        return Layout(width, height, self.circles, bars, arcs, notes)

    def _set_columns(self) -> float:
        """Find the middle of each column, the distances from there of its bars and of where lines first turn off in its
        channel, and the first lanes of both margins; the width of all."""
        labels = self.texts.labels
        columns = [[row[c] for row in self.rows if c < len(row)] for c in range(self.columns)]
        west = [max(RADIUS + ARROW_LENGTH, *(labels[place] / 2 + 6 for place in column)) for column in columns]
        self.before = [max(map(self._before_bar, column)) for column in columns]
        self.turns = [max(self._turn(p, bar) for p in column) for bar, column in zip(self.before, columns, strict=True)]
        east = [turn + self._taken(c) for c, turn in enumerate(self.turns)]
        pitches = [a + b for a, b in zip(east, west[1:], strict=False)]
        if pitches and not self.net.grouped:
            pitches = [max(pitches)] * len(pitches)
        used = [[self.climbs[route.arc] for route in self.routes if route.side == side] for side in (-1, 1)]
        room = [(max(each) + 1) * SLOT if each else 0.0 for each in used]
        first = west[0] if room[0] else max([RADIUS, *(labels[place] / 2 for column in columns[:1] for place in column)])
        self.xs = list(accumulate(pitches, initial=EDGE + room[0] + first))
        right = max((x + reach for x, reach in zip(self.xs, east, strict=False)), default=0.0)
        self.margins = self.xs[0] - (west[0] if west else 0), right + 4
        return right + room[1] + EDGE

    def _before_bar(self, place: int) -> float:
        if len(self.bars[place]) < 2:
            return RADIUS + BEFORE_BAR * len(self.bars[place])
        return max(RADIUS + BEFORE_BARS, self.texts.labels[place] / 2 + 22)

    def _turn(self, place: int, bar: float) -> float:
        """Where lines may turn off: to the right of terms and labels, with room for the note of a loop."""
        texts, bars = self.texts, self.bars[place]
        loops = (arc for arc in self.entries.get(place, ()) if any(arc in self.exits[t] for t in bars))
        return max(bar + 10 + _widest(texts.terms, bars), texts.labels[place] / 2 + 6, _widest(texts.notes, loops) + 2 * ROUND)

    def _taken(self, column: int) -> float:
        ours = [route for route in self.routes if route.source[1] == column]
        slots = [self.slots[route.arc] for route in ours if route.arc in self.slots]
        note = _widest(self.texts.notes, (route.arc for route in ours if route.direct))
        return (max(slots) * SLOT + 8 if slots else 0.0) + (note - 6 if note else 0.0)

    def _set_rows(self) -> float:
        """Find the middle and the upper edge of each row; the height of all."""
        self.ys, self.tops, bottom = list[float](), list[float](), EDGE
        for number, row in enumerate(self.rows):
            stack = max((len(self.bars[place]) - 1) * STACKED / 2 + BAR + 8 for place in row)
            lanes = [level for (_, gap), level in self.lanes.items() if gap == number]
            above = LANDING + max(lanes) * LANE + (LANE if number else 0) if lanes else (18.0 if number else 0.0)
            self.tops.append(bottom + above)
            self.ys.append(self.tops[-1] + max(RADIUS, stack))
            bottom = self.ys[-1] + max(RADIUS + LABEL, stack)
        return bottom + EDGE

    def _bar_height(self, place: int, number: int) -> float:
        return self.circles[place][1] + (number - (len(self.bars[place]) - 1) / 2) * STACKED

    def _heights(self) -> dict[int, float]:
        """Where each arc leaves its bar; a direct arc leaves it in the middle."""
        direct = {route.arc for route in self.routes if route.direct}
        found = {}
        for place, own in self.bars.items():
            for number, bar in enumerate(own):
                leaving = self.exits[bar]
                middle = next((i for i, arc in enumerate(leaving) if arc in direct), (len(leaving) - 1) / 2)
                step = min(STEP, (18.0 if len(own) == 1 else 10.0) / max(1.0, middle, len(leaving) - 1 - middle))
                y = self._bar_height(place, number)
                found.update({arc: y + (i - middle) * step for i, arc in enumerate(leaving)})
        return found

    def _bars(self, place: int) -> dict[int, BarPosition]:
        """The bars of a place, and the lines to them; the line to one of several bars turns beside the label."""
        found, (across, down) = {}, self.circles[place]
        x, start = across + self.before[self.cells[place][1]], (across + RADIUS, down)
        bend = across + max(RADIUS + 12, self.texts.labels[place] / 2 + 8)
        for number, bar in enumerate(self.bars[place]):
            y = self._bar_height(place, number)
            ends = [self.heights[arc] for arc in self.exits[bar]] or [y]
            half = max([BAR, *(abs(end - y) + 4 for end in ends)])
            line = (start, (x, y)) if y == down else (start, (bend, down), (bend, y), (x, y))
            found[bar] = BarPosition(x, y, half, line, (x + 6, min(ends) - 5))
        return found

    def _corners(self, route: Route) -> tuple[Point, ...]:
        """The vertices of the line of an arc."""
        arc, (_, column), to = route.arc, route.source, route.target[0]
        place = self.net.arcs[arc].place
        x, y = self.circles[place]
        corners, entries = [(self.xs[column] + self.before[column], self.heights[arc])], self.entries.get(place, ())
        if route.direct:
            return corners[0], (x - RADIUS, corners[0][1])
        lanes = []
        if route.way:
            lanes.append((self.xs[column] + self.turns[column] + self.slots[arc] * SLOT, route.gap))
        if route.side:
            lanes.append((self.margins[route.side > 0] + route.side * self.climbs[arc] * SLOT, to))
        for turn, gap in lanes:
            corners += [(turn, corners[-1][1]), (turn, self.tops[gap] - LANDING - self.lanes[arc, gap] * LANE)]
        middle = (len(entries) - 1) / 2
        shift = (entries.index(arc) - middle) * min(9.0, 0.7 * RADIUS / max(1.0, middle))
        return (*corners, (x + shift, corners[-1][1]), (x + shift, y - (RADIUS**2 - shift**2) ** 0.5))


def _between(one: tuple[float, int], other: tuple[float, int]) -> Stretch:
    return (one, other) if one <= other else (other, one)


def _widest(widths: Mapping[int, float], keys: Iterable[int]) -> float:
    return max((widths[key] + 8 for key in keys if key in widths), default=0.0)


def _note(arc: int, width: float, arcs: Mapping[int, tuple[Point, ...]]) -> Point:
    """The position of the note of an arc: on its lane, in the widest stretch without crossings; above a direct arc."""
    corners = arcs[arc]
    if len(corners) == 2:
        return corners[1][0] - 6 - width / 2, corners[1][1] - 10
    lanes = list(pairwise(corners))[2::2]
    middle = (lanes[-1][0][0] + lanes[-1][1][0]) / 2
    free = []
    for (x, y), (end, _) in lanes:
        left, right = sorted((x, end))
        cuts = {
            p[0]
            for other, line in arcs.items()
            for p, q in pairwise(line)
            if other != arc and p[0] == q[0] and min(p[1], q[1]) - 7 < y < max(p[1], q[1]) + 7 and left < p[0] < right
        }
        free += [(start, stop, y) for start, stop in pairwise([left, *sorted(cuts), right])]
    left, right, y = max(free, key=lambda gap: (min(gap[1] - gap[0], width + 40), -abs((gap[0] + gap[1]) / 2 - middle)))
    return (left + right) / 2, y
