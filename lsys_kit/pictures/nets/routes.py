"""Routes: the rows of a stage diagram, and the route of each arc around them.

Places stand in the columns of a grid, bars to their right in the channels between the columns. An arc to the right neighbour is
direct. Every other arc leaves its bar sideways, turns up or down in the channel, runs in a lane of the gap above the row of its
target, and enters the target from above: so no arc can meet a circle. To a row that is not adjacent it runs through a margin.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from math import ceil

from lsys_kit.derivation.petri.net import Stages
from lsys_kit.errors import ModelLimitError
from lsys_kit.pictures.nets.lanes import Stretch, levels, ordered
from lsys_kit.pictures.style.labels import polar_symbols

LONGEST_ROW, MOST_ARCS = 8, 800
"""The most places in a row, and the most arcs of a diagram."""
_GAP = 1000.0
"""The distance of gaps in units of lanes."""


@dataclass(frozen=True)
class Route:
    """The route of an arc.

    Attributes
    ----------
    arc
        Its number in the net.
    source, target
        The row and column of the place whose bar it leaves, and of the place it leads to.
    way
        The direction in which it leaves the bar: -1 up, 1 down, 0 straight on.
    side
        The margin through which it runs: -1 left, 1 right, 0 none.
    """

    arc: int
    source: tuple[int, int]
    target: tuple[int, int]
    way: int
    side: int

    @property
    def direct(self) -> bool:
        """Whether the arc is the straight line to the right neighbour."""
        return self.way == self.side == 0


@dataclass(frozen=True)
class Plan:
    """A diagram without coordinates.

    Attributes
    ----------
    rows
        The places in each row, from left to right.
    bars
        For each place its transitions, from top to bottom.
    routes
        One for each arc that is shown.
    lanes
        For each arc and gap the number of its lane, counted from the row below; gap r is the one above row r.
    climbs
        For each arc through a margin the number of its lane there, counted from the rows.
    slots
        For each arc that turns off in a channel the number of its lane there, counted from the bar.
    exits
        For each transition the arcs that leave its bar, from top to bottom.
    entries
        For each place the arcs that enter it from above, from left to right.
    """

    rows: tuple[tuple[int, ...], ...]
    bars: Mapping[int, tuple[int, ...]]
    routes: tuple[Route, ...]
    lanes: Mapping[tuple[int, int], int]
    climbs: Mapping[int, int]
    slots: Mapping[int, int]
    exits: Mapping[int, tuple[int, ...]]
    entries: Mapping[int, tuple[int, ...]]


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
    pairs = polar_symbols(net.system)
    bases = {place: pairs.get(net.places[place].symbol, (net.places[place].symbol, ""))[0] for place in sorted(shown)}
    groups: dict[str, list[int]] = {}
    for place, base in bases.items():
        groups.setdefault(base if list(bases.values()).count(base) > 1 else "", []).append(place)
    return tuple(row for group in groups.values() for row in _wrapped(_chained(net, group), longest))


def _chained(net: Stages, group: Sequence[int]) -> list[int]:
    """Places in the order in which a module passes through them; a chain begins at a stage without predecessors."""
    leads, sole = _leads(net, group), _leads(net, group, sole=True)
    led = {target for place, targets in sole.items() for target in targets if target != place}
    left = sorted(group, key=lambda place: (place in led, not leads[place], place))
    chain: list[int] = []
    while left:
        following: int | None = left[0]
        while following is not None:
            chain.append(following)
            left.remove(following)
            onward = [*sole[following], *sorted(leads[following], key=lambda place: not leads.get(place))]
            following = next((place for place in onward if place in left), None)
    return chain


def _leads(net: Stages, group: Sequence[int], sole: bool = False) -> dict[int, list[int]]:
    """The targets in a group of each of its places; if `sole`, only by transitions that make one token."""
    found: dict[int, list[int]] = {place: [] for place in group}
    made = [0] * len(net.transitions)
    for arc in net.arcs:
        made[arc.transition] += arc.copies
    for arc in net.arcs:
        place = net.transitions[arc.transition].place
        if place in found and arc.place in found and not (sole and made[arc.transition] > 1):
            found[place].append(arc.place)
    return found


def _wrapped(chain: Sequence[int], longest: int) -> list[tuple[int, ...]]:
    """A chain as rows of nearly equal length."""
    size = ceil(len(chain) / ceil(len(chain) / longest))
    return [tuple(chain[i : i + size]) for i in range(0, len(chain), size)]


def planned(net: Stages, rows: Sequence[tuple[int, ...]]) -> Plan:
    """The plan of a diagram with given rows of places.

    Raises
    ------
    ModelLimitError
        There are too many arcs.
    """
    if len(net.arcs) > MOST_ARCS:
        raise ModelLimitError(
            f"A stage diagram with {len(net.arcs):,} arcs would not be legible; it may have {MOST_ARCS:,}",
            limit=MOST_ARCS,
            needed=len(net.arcs),
            hint="print(stages(system)) writes it as text.",
        )
    cells = {place: (r, c) for r, row in enumerate(rows) for c, place in enumerate(row)}
    columns = max(map(len, rows), default=0)
    bars: dict[int, list[int]] = {place: [] for place in cells}
    for number, transition in enumerate(net.transitions):
        if transition.place in bars:
            bars[transition.place].append(number)
    routes = [_route(number, net, cells, bars, rows) for number, arc in enumerate(net.arcs) if arc.place in cells]
    lanes = _lanes(routes, columns)
    climbs = _climbs(routes, lanes)
    slots = _slots(routes, lanes, columns)
    return Plan(
        tuple(rows),
        {place: tuple(own) for place, own in bars.items()},
        tuple(routes),
        lanes,
        climbs,
        slots,
        _exits(net, routes, slots, climbs),
        _entries(net, routes, lanes),
    )


def _route(
    number: int,
    net: Stages,
    cells: Mapping[int, tuple[int, int]],
    bars: Mapping[int, Sequence[int]],
    rows: Sequence[Sequence[int]],
) -> Route:
    """The route of an arc, the shorter one if there are two."""
    arc = net.arcs[number]
    place = net.transitions[arc.transition].place
    (row, column), (to, at) = cells[place], cells[arc.place]
    if (to, at) == (row, column + 1) and len(bars[place]) == 1:
        way = side = 0
    elif to in (row, row + 1):
        way, side = (-1 if to == row else 1), 0
    elif column == len(rows[row]) - 1:
        way, side = 0, 1
    else:
        way, side = (-1 if to < row else 1), (-1 if column + at < max(map(len, rows)) - 1 else 1)
    return Route(number, (row, column), (to, at), way, side)


def _stretches(route: Route, columns: int) -> list[tuple[int, Stretch]]:
    """The gaps through which an arc runs, with its stretch in each; positions are columns, channels lie half-way between."""
    (row, column), (to, at) = route.source, route.target
    gap = row if route.way < 0 else row + 1
    leave, margin, arrive = (column + 0.5, -route.way), -1.0 if route.side < 0 else float(columns), (float(at), 1)
    if route.direct:
        return []
    if not route.side:
        return [(gap, (leave, arrive))]
    if not route.way:
        return [(to, ((margin, 1 if to <= row else -1), arrive))]
    turn = 1 if to > gap else -1
    return [(gap, (leave, (margin, turn))), (to, ((margin, -turn), arrive))]


def _lanes(routes: Sequence[Route], columns: int) -> dict[tuple[int, int], int]:
    gaps: dict[int, list[tuple[int, Stretch]]] = {}
    for route in routes:
        for gap, stretch in _stretches(route, columns):
            gaps.setdefault(gap, []).append((route.arc, stretch))
    found = {}
    for gap, members in gaps.items():
        stretches = [stretch for _, stretch in members]
        for (arc, _), level in zip(members, levels(stretches, ordered(stretches)[::-1]), strict=True):
            found[arc, gap] = level
    return found


def _climbs(routes: Sequence[Route], lanes: Mapping[tuple[int, int], int]) -> dict[int, int]:
    found = {}
    for side in (-1, 1):
        members = [route for route in routes if route.side == side]
        stretches = [_climb(route, lanes) for route in members]
        for route, level in zip(members, levels(stretches, ordered(stretches)[::side]), strict=True):
            found[route.arc] = level
    return found


def _climb(route: Route, lanes: Mapping[tuple[int, int], int]) -> Stretch:
    """The stretch of an arc in its margin; positions count gaps, from the top."""
    row, to = route.source[0], route.target[0]
    gap = row if route.way < 0 else row + 1
    begin = _GAP * gap - lanes[route.arc, gap] if route.way else _GAP * row + _GAP / 2
    return (begin, -route.side), (_GAP * to - lanes[route.arc, to], -route.side)


def _slots(routes: Sequence[Route], lanes: Mapping[tuple[int, int], int], columns: int) -> dict[int, int]:
    """Lanes in the channels, such that the arcs of one bar do not cross there."""
    channels: dict[tuple[int, int], list[tuple[bool, int, int]]] = {}
    for route in routes:
        if route.way:
            gap, ((start, _), (end, _)) = _stretches(route, columns)[0]
            onward, far = end > start, -route.way * lanes[route.arc, gap]
            channels.setdefault((gap, route.source[1]), []).append((onward, -far if onward else far, route.arc))
    return {arc: slot for members in channels.values() for slot, (_, _, arc) in enumerate(sorted(members))}


def _exits(
    net: Stages, routes: Sequence[Route], slots: Mapping[int, int], climbs: Mapping[int, int]
) -> dict[int, tuple[int, ...]]:
    """The arcs of each bar from top to bottom: those that turn up, go straight on, and turn down."""
    found: dict[int, list[tuple[int, int, int]]] = {number: [] for number in range(len(net.transitions))}
    for route in routes:
        up = route.target[0] < route.source[0]
        depth = slots[route.arc] if route.way else climbs.get(route.arc, 0) * (1 if up else -1)
        found[net.arcs[route.arc].transition].append((route.way, -depth if route.way > 0 else depth, route.arc))
    return {number: tuple(arc for _, _, arc in sorted(leaving)) for number, leaving in found.items()}


def _entries(net: Stages, routes: Sequence[Route], lanes: Mapping[tuple[int, int], int]) -> dict[int, tuple[int, ...]]:
    """The arcs that enter each place: those from the left, the nearest lane first, then those from the right."""
    found: dict[int, list[tuple[bool, int, int]]] = {}
    for route in routes:
        if not route.direct:
            level = lanes[route.arc, route.target[0]]
            rightward = route.side > 0 or (route.side == 0 and route.source[1] >= route.target[1])
            found.setdefault(net.arcs[route.arc].place, []).append((rightward, -level if rightward else level, route.arc))
    return {place: tuple(arc for _, _, arc in sorted(coming)) for place, coming in found.items()}
