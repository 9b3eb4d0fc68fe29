"""Cellworks: cells side by side in space, each with the walls around it (The Algorithmic Beauty of Plants, section 7.5).

A cellwork is kept as its edges, for each wall the edges once around it, and for each cell its walls, seen from outside or from
inside. Positions are no part of it; geometry computes them.

A step has three phases. Edges are replaced, then walls are divided by new edges, as the cells of a map are by new walls. Last,
a cell is divided where new edges form a cycle around it, in walls that it has, and all of them name the same new wall: that
wall is spanned by the cycle, which parts the walls of the cell into those of its two daughters.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import NamedTuple

from lsys_kit.budget import Task, check_step, counted
from lsys_kit.derivation.tissues.edges import (
    CellEdge,
    Replaced,
    Side,
    Vertex,
    around,
    corners_of,
    divided,
    edge_between,
    matching,
    replaced_edges,
)
from lsys_kit.errors import ModelValueError, every, require
from lsys_kit.notation.model.cells import ANY, CellworkProduction, CellworkSystem, Edge, EdgeMarker
from lsys_kit.notation.model.expressions import TextSpan

EDGE_BYTES = 900
"""About what an edge takes in memory, with its share of vertices, walls and cells."""


class CellWall(NamedTuple):
    """A wall: its label, and the edges once around it."""

    label: str
    sides: tuple[Side, ...]


@dataclass(frozen=True)
class Cellwork:
    """One cellwork: vertices, edges, walls, cells.

    Attributes
    ----------
    vertices
        Where each vertex was made. From step to step they keep their numbers.
    edges, walls
        The edges and walls.
    cells
        For each cell its walls.
    mothers
        For each cell the number of the cell in the cellwork before from which it came.

    Examples
    --------
    >>> from lsys_kit import derive, read_cellwork
    >>> prism = read_cellwork('''
    ... cellwork: 1(0,0,0) 2(1,0,0) 3(0,1,0) 4(0,0,1) 5(1,0,1) 6(0,1,1)
    ... wall T: 1 A 2 A 3 A
    ... wall T: 4 A 5 A 6 A
    ... wall S: 1 A 2 B 5 A 4 B
    ... wall S: 2 A 3 B 6 A 5 B
    ... wall S: 3 A 1 B 4 A 6 B
    ... B: * -> B [S: S|A|S, T] B''')
    >>> divided = derive(prism, 1)[-1]
    >>> print(divided)
    T S S S T | T S S S T
    >>> divided.counts, divided.euler
    ((9, 15, 9, 2), 1)
    """

    vertices: tuple[Vertex, ...]
    edges: tuple[CellEdge, ...]
    walls: tuple[CellWall, ...]
    cells: tuple[tuple[Side, ...], ...]
    mothers: tuple[int, ...] = field(default=(), compare=False)

    @property
    def counts(self) -> tuple[int, int, int, int]:
        """How many vertices, edges, walls and cells there are."""
        return len(self.vertices), len(self.edges), len(self.walls), len(self.cells)

    @property
    def euler(self) -> int:
        """Vertices - edges + walls - cells: 1 for every cellwork in one piece without holes."""
        vertices, edges, walls, cells = self.counts
        return vertices - edges + walls - cells

    def corners(self, wall: CellWall) -> list[int]:
        """The vertices once around a wall."""
        require(wall, CellWall, "A wall of a cellwork")
        return corners_of(wall.sides, self.edges)

    def labels(self, cell: Sequence[Side]) -> tuple[str, ...]:
        """The labels of the walls of a cell."""
        every(cell, Side, "The side of a wall")
        return tuple(self.walls[side.wall].label for side in cell)

    def cells_at(self) -> Iterator[tuple[int, int, bool]]:
        """The walls of all cells: the cell, the wall, and whether its edges run counter-clockwise as seen from outside."""
        for number, cell in enumerate(counted(self.cells)):
            yield from ((number, wall, forward) for wall, forward in cell)

    def __str__(self) -> str:
        with Task("The text of the cellwork was not written"):
            return " | ".join(" ".join(self.labels(cell)) for cell in counted(self.cells))


def first_cellwork(system: CellworkSystem) -> Cellwork:
    """The first cell of a cellwork system, with its walls as they are listed."""
    numbers = {corner.name: number for number, corner in enumerate(system.corners)}
    edges: list[CellEdge] = []
    known: dict[frozenset[str], int] = {}
    walls = []
    for wall in system.walls:
        sides = []
        for one, other, edge in wall.sides:
            number = known.setdefault(frozenset((one, other)), len(edges))
            if number == len(edges):
                edges.append(edge_between(edge, numbers[one], numbers[other]))
            sides.append(Side(number, edges[number].start == numbers[one]))
        walls.append(CellWall(wall.label, tuple(sides)))
    found = Cellwork((Vertex(),) * len(numbers), tuple(edges), tuple(walls), ())
    return replace(found, cells=(_outward(found, [corner.place for corner in system.corners]),))


def _outward(found: Cellwork, places: Sequence[tuple[Fraction, Fraction, Fraction]]) -> tuple[Side, ...]:
    """The walls of a single cell, each with the direction of its edges: counter-clockwise, as seen from outside."""
    forward = _agreeing(found.walls)
    volume = Fraction(0)
    for wall, along in zip(found.walls, forward, strict=True):
        first, *others = (places[corner] for corner in found.corners(wall))
        for one, other in pairwise(others):
            volume += _determinant(first, one, other) * (1 if along else -1)
    return tuple(Side(number, along == (volume >= 0)) for number, along in enumerate(forward))


def _agreeing(walls: Sequence[CellWall]) -> list[bool]:
    """For each wall of a closed surface whether its edges run as those of the first wall: neighbours run against each other."""
    at: dict[int, list[tuple[int, bool]]] = {}
    for number, wall in enumerate(walls):
        for edge, forward in wall.sides:
            at.setdefault(edge, []).append((number, forward))
    agreeing, waiting = {0: True}, [0]
    while waiting:
        number = waiting.pop()
        for edge, forward in walls[number].sides:
            for other, its in at[edge]:
                if other not in agreeing:
                    agreeing[other] = agreeing[number] == (forward != its)
                    waiting.append(other)
    return [agreeing[number] for number in range(len(walls))]


def _determinant(a: Sequence[Fraction], b: Sequence[Fraction], c: Sequence[Fraction]) -> Fraction:
    """Six times the volume of a tetrahedron with a corner at the origin."""
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])


class DividedWall(NamedTuple):
    """A wall after a step: the one or two walls that it became; of the new edge its number, the wall that it will bound, and
    where one of its markers stands in the text."""

    walls: range
    border: int | None = None
    new_wall: str = ""
    at: TextSpan = None


def cellwork_step(found: Cellwork, system: CellworkSystem, step: int) -> Cellwork:
    """The cellwork of the next step."""
    check_step(step, len(found.edges), "edges", EDGE_BYTES)
    vertices = [*found.vertices]
    edges, partings = replaced_edges(_rules(found, system), vertices)
    check_step(step, len(edges), "edges", EDGE_BYTES)
    walls, parted = _divided_walls(found, system, partings, edges)
    cells, mothers = list[tuple[Side, ...]](), list[int]()
    for number, cell in enumerate(counted(found.cells)):
        daughters = _divided_cell(cell, parted, edges, walls, f"Step {step}: cell {number}", system.source)
        cells += daughters
        mothers += [number] * len(daughters)
    return Cellwork(tuple(vertices), tuple(edges), tuple(walls), tuple(cells), tuple(mothers))


def _rules(found: Cellwork, system: CellworkSystem) -> Iterator[tuple[CellEdge, CellworkProduction | None]]:
    """Each edge with its production: the first one whose walls all have the edge."""
    labels: list[set[str]] = [set() for _ in found.edges]
    for wall in counted(found.walls):
        for edge, _ in wall.sides:
            labels[edge].add(wall.label)
    productions: dict[Edge, list[CellworkProduction]] = {}
    for production in system.productions:
        productions.setdefault(production.predecessor, []).append(production)
    for placed, its in zip(counted(found.edges), labels, strict=True):
        yield placed, next((each for each in productions.get(placed.kind, ()) if its.issuperset(each.walls)), None)


def _divided_walls(
    found: Cellwork, system: CellworkSystem, partings: Sequence[Replaced], edges: list[CellEdge]
) -> tuple[list[CellWall], list[DividedWall]]:
    """The walls of the next step before cells are divided, and what has become of each wall: where two of its markers match, a
    new edge divides it, which is put behind the others; where none do, it has perhaps another label.
    """
    becomes = {production.predecessor: production.successor for production in system.wall_productions}
    walls: list[CellWall] = []
    made = []
    for label, before in counted(found.walls):
        sides, marks = around(before, partings, partial(_seen, label))
        pair, first = matching(marks), len(walls)
        if pair is None:
            walls.append(CellWall(becomes.get(label, label), sides))
            made.append(DividedWall(range(first, first + 1)))
        else:
            marker = pair[0].marker
            made.append(DividedWall(range(first, first + 2), len(edges), marker.new_wall, marker.at))
            walls += map(CellWall, marker.daughters, divided(sides, pair, edges))
    return walls, made


def _seen(label: str, marker: EdgeMarker, forward: bool) -> EdgeMarker | None:
    """A marker as one meets it on the way around a wall with a label, if it divides such walls."""
    return (marker if forward else marker.turned) if marker.wall in (label, ANY) else None


def _divided_cell(
    cell: Sequence[Side],
    parted: Sequence[DividedWall],
    edges: Sequence[CellEdge],
    walls: list[CellWall],
    called: str,
    source: str,
) -> list[tuple[Side, ...]]:
    """A cell divided by the wall that a cycle of new edges spans; the cell alone, where there is none."""
    borders: dict[str, list[int]] = {}
    for wall, _ in cell:
        border = parted[wall].border
        if border is not None:
            borders.setdefault(parted[wall].new_wall, []).append(border)
    sides = tuple(Side(new, forward) for wall, forward in cell for new in parted[wall].walls)
    for label, some in borders.items():
        cycle = closed_cycle(some, edges)
        if cycle:
            walls.append(CellWall(label, cycle))
            return [*_daughters(sides, walls)]
    if len(borders) > 1 and closed_cycle([edge for some in borders.values() for edge in some], edges):
        last = [*borders][-1]
        start, end = next(parted[wall].at for wall, _ in cell if parted[wall].new_wall == last) or (None, None)
        raise ModelValueError(
            f"{called} has new edges in a cycle, but they do not lie in one new wall: they name {' and '.join(borders)}",
            source,
            start,
            end,
            "Markers whose edges are to bound one new wall end in the same label.",
        )
    return [sides]


def closed_cycle(some: Sequence[int], edges: Sequence[CellEdge]) -> tuple[Side, ...]:
    """The first cycle among some new edges of a cell, beginning with the first of its edges; nothing, if there is none.

    A vertex on the edge of a cell lies in two of its walls, so that at most two new edges of the cell end there.
    """
    at: dict[int, list[int]] = {}
    for edge in some:
        at.setdefault(edges[edge].start, []).append(edge)
        at.setdefault(edges[edge].end, []).append(edge)
    left = dict.fromkeys(some)
    while left:
        first = edge = next(iter(left))
        vertex, cycle = edges[edge].start, list[Side]()
        while edge in left:
            del left[edge]
            forward = edges[edge].start == vertex
            cycle.append(Side(edge, forward))
            vertex = edges[edge].end if forward else edges[edge].start
            edge = next((other for other in at[vertex] if other != edge), edge)
        if edge == first and len(cycle) > 2 and vertex == edges[first].start:
            return tuple(cycle)
    return ()


def _daughters(sides: Sequence[Side], walls: Sequence[CellWall]) -> Iterator[tuple[Side, ...]]:
    """The walls of the two daughters of a cell that the last wall of all divides, which both have."""
    new, cycle = len(walls) - 1, dict(walls[-1].sides)
    own, (first, way) = _one_side(sides, walls, cycle), walls[-1].sides[0]
    along = next(
        side.forward == forward
        for side in sides
        if side.wall in own
        for edge, forward in walls[side.wall].sides
        if edge == first
    )
    outward = along != way
    yield (*(side for side in sides if side.wall in own), Side(new, outward))
    yield (*(side for side in sides if side.wall not in own), Side(new, not outward))


def _one_side(sides: Sequence[Side], walls: Sequence[CellWall], cycle: Mapping[int, bool]) -> set[int]:
    """The walls of a cell that are reached from the first one without crossing a cycle of edges."""
    at: dict[int, list[int]] = {}
    for side in sides:
        for edge, _ in walls[side.wall].sides:
            at.setdefault(edge, []).append(side.wall)
    reached, waiting = {sides[0].wall}, [sides[0].wall]
    while waiting:
        for edge, _ in walls[waiting.pop()].sides:
            new = [] if edge in cycle else [wall for wall in at[edge] if wall not in reached]
            reached.update(new)
            waiting += new
    return reached
