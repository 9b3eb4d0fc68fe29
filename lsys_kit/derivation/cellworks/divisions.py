"""One step of a cellwork, in three phases: edges, walls, cells (The Algorithmic Beauty of Plants, 7.5).

A cell is divided where new edges form a cycle around it, in walls that it has, and all of them name the same new wall: that
wall is spanned by the cycle. The cycle parts the walls of the cell into those of its two daughters.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from lsys_kit.budget import check_step, counted
from lsys_kit.derivation.cellworks.cellwork import CellEdge, CellWall, Cellwork, EdgeSide, WallSide
from lsys_kit.derivation.cellworks.edges import DividedWall, divided_edges, divided_walls
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.cellworks import CellworkSystem

EDGE_BYTES = 900
"""About what an edge takes in memory, with its share of vertices, walls and cells."""


def cellwork_step(found: Cellwork, system: CellworkSystem, step: int) -> Cellwork:
    """The cellwork of the next step."""
    check_step(step, len(found.edges), "edges", EDGE_BYTES)
    vertices, edges, walls = [*found.vertices], list[CellEdge](), list[CellWall]()
    partings = divided_edges(found, system, vertices, edges)
    check_step(step, len(edges), "edges", EDGE_BYTES)
    becomes = {production.predecessor: production.successor for production in system.wall_productions}
    divided = divided_walls(found, partings, becomes, edges, walls)
    cells: list[tuple[WallSide, ...]] = []
    mothers: list[int] = []
    for number, cell in enumerate(counted(found.cells)):
        daughters = _divided_cell(cell, divided, edges, walls, f"Step {step}: cell {number}", system.source)
        cells += daughters
        mothers += [number] * len(daughters)
    return Cellwork(tuple(vertices), tuple(edges), tuple(walls), tuple(cells), tuple(mothers))


def _divided_cell(
    cell: Sequence[WallSide],
    divided: Sequence[DividedWall],
    edges: Sequence[CellEdge],
    walls: list[CellWall],
    called: str,
    source: str,
) -> list[tuple[WallSide, ...]]:
    """A cell divided by the wall that a cycle of new edges spans; the cell alone, where there is none."""
    sides = tuple(WallSide(new, forward) for wall, forward in cell for new in divided[wall].walls)
    borders: dict[str, list[int]] = {}
    parted = [divided[wall] for wall, _ in cell]
    for each in parted:
        if each.border is not None:
            borders.setdefault(each.new_wall, []).append(each.border)
    for label, some in borders.items():
        cycle = closed_cycle(some, edges)
        if cycle:
            walls.append(CellWall(label, cycle))
            return [*_parted(sides, walls)]
    if len(borders) > 1 and closed_cycle([edge for some in borders.values() for edge in some], edges):
        start, end = next(each.at for each in parted if each.new_wall == [*borders][-1]) or (None, None)
        raise ModelValueError(
            f"{called} has new edges in a cycle, but they do not lie in one new wall: they name {' and '.join(borders)}",
            source,
            start,
            end,
            "Markers whose edges are to bound one new wall end in the same label.",
        )
    return [sides]


def closed_cycle(some: Sequence[int], edges: Sequence[CellEdge]) -> tuple[EdgeSide, ...]:
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
        vertex, cycle = edges[edge].start, list[EdgeSide]()
        while edge in left:
            del left[edge]
            forward = edges[edge].start == vertex
            cycle.append(EdgeSide(edge, forward))
            vertex = edges[edge].end if forward else edges[edge].start
            edge = next((other for other in at[vertex] if other != edge), edge)
        if edge == first and len(cycle) > 2 and vertex == edges[first].start:
            return tuple(cycle)
    return ()


def _parted(sides: Sequence[WallSide], walls: Sequence[CellWall]) -> Iterator[tuple[WallSide, ...]]:
    """The walls of the two daughters of a cell that the last wall of all divides, which both have."""
    new, cycle = len(walls) - 1, {side.edge: side.forward for side in walls[-1].sides}
    own = _one_side(sides, walls, cycle)
    along = next(
        side.forward == forward
        for side in sides
        if side.wall in own
        for edge, forward in walls[side.wall].sides
        if edge in cycle and edge == next(iter(cycle))
    )
    outward = along != cycle[next(iter(cycle))]
    yield (*(side for side in sides if side.wall in own), WallSide(new, outward))
    yield (*(side for side in sides if side.wall not in own), WallSide(new, not outward))


def _one_side(sides: Sequence[WallSide], walls: Sequence[CellWall], cycle: Mapping[int, bool]) -> set[int]:
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
