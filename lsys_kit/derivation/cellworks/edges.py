"""The first two phases of a step: edges are replaced, then walls divided (The Algorithmic Beauty of Plants, 7.5)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from lsys_kit.budget import counted
from lsys_kit.derivation.cellworks.cellwork import CellEdge, CellWall, Cellwork, EdgeSide
from lsys_kit.derivation.maps.map import Vertex
from lsys_kit.notation.model.cellworks import ANY, CellworkProduction, CellworkSystem, EdgeMarker
from lsys_kit.notation.model.expressions import TextSpan
from lsys_kit.notation.model.maps import Edge


class DividedEdge(NamedTuple):
    """An edge after its replacement: the new edges in order, and between them the vertices with their markers."""

    edges: range
    turned: Sequence[bool]
    vertices: Sequence[int]
    marked: Sequence[Sequence[EdgeMarker]]


class Mark(NamedTuple):
    """A marker seen from a wall: after how many of its sides it stands, on which edge, at which vertex, what it says, and where
    it stands in the text.

    The daughters are those before and behind the marker, on the way around the wall.
    """

    place: int
    edge: int
    vertex: int
    new_edge: Edge
    before: str
    behind: str
    new_wall: str
    at: TextSpan


class DividedWall(NamedTuple):
    """A wall after a step: the one or two walls that it became; of the new edge its number, the wall that it will bound, and
    where one of its markers stands in the text."""

    walls: range
    border: int | None = None
    new_wall: str = ""
    at: TextSpan = None


def divided_edges(found: Cellwork, system: CellworkSystem, vertices: list[Vertex], edges: list[CellEdge]) -> list[DividedEdge]:
    """Each edge, replaced by its production."""
    around: list[set[str]] = [set() for _ in found.edges]
    for wall in counted(found.walls):
        for side in wall.sides:
            around[side.edge].add(wall.label)
    productions: dict[Edge, list[CellworkProduction]] = {}
    for production in system.productions:
        productions.setdefault(production.predecessor, []).append(production)
    made = []
    for edge, labels in zip(counted(found.edges), around, strict=True):
        predecessor = Edge(edge.label, ">" if edge.directed else "")
        fitting = (each for each in productions.get(predecessor, ()) if labels.issuperset(each.walls))
        made.append(_replaced(edge, next(fitting, CellworkProduction(predecessor, (), (predecessor,))), vertices, edges))
    return made


def _replaced(edge: CellEdge, production: CellworkProduction, vertices: list[Vertex], edges: list[CellEdge]) -> DividedEdge:
    """Replace an edge, in its own direction: its vertices and edges are put behind those that there are."""
    successor, first = production.edges, len(edges)
    between = range(len(vertices), len(vertices) + len(successor) - 1)
    vertices += (Vertex((edge.start, edge.end), Fraction(part, len(successor))) for part in range(1, len(successor)))
    ends = [edge.start, *between, edge.end]
    edges += (
        CellEdge(new.label, *((b, a) if new.arrow == "<" else (a, b)), bool(new.arrow))
        for new, a, b in zip(successor, ends, ends[1:], strict=False)
    )
    return DividedEdge(range(first, len(edges)), [new.arrow == "<" for new in successor], between, production.marked)


def divided_walls(
    found: Cellwork, partings: Sequence[DividedEdge], becomes: Mapping[str, str], edges: list[CellEdge], walls: list[CellWall]
) -> list[DividedWall]:
    """Each wall, divided by a new edge between two of its markers that match, at most once; or whole, with another label."""
    made = []
    for wall in counted(found.walls):
        sides, marks = _around(wall, partings)
        pair, first = matching(marks), len(walls)
        if pair is None:
            walls.append(CellWall(becomes.get(wall.label, wall.label), tuple(sides)))
            made.append(DividedWall(range(first, first + 1)))
            continue
        one, other = pair
        forward, border = one.new_edge.arrow != "<", len(edges)
        ends = (one.vertex, other.vertex) if forward else (other.vertex, one.vertex)
        edges.append(CellEdge(one.new_edge.label, *ends, bool(one.new_edge.arrow)))
        walls += (
            CellWall(one.before, (*sides[: one.place], EdgeSide(border, forward), *sides[other.place :])),
            CellWall(one.behind, (*sides[one.place : other.place], EdgeSide(border, not forward))),
        )
        made.append(DividedWall(range(first, first + 2), border, one.new_wall, one.at))
    return made


def _around(wall: CellWall, partings: Sequence[DividedEdge]) -> tuple[list[EdgeSide], list[Mark]]:
    """The sides of a wall after the replacement of its edges, and the markers that divide it."""
    made: list[EdgeSide] = []
    marks: list[Mark] = []
    for edge, forward in wall.sides:
        parting, way = partings[edge], 1 if forward else -1
        before = len(made)
        made += (
            EdgeSide(new, turned != forward) for new, turned in zip(parting.edges[::way], parting.turned[::way], strict=True)
        )
        meetings = zip(parting.vertices[::way], parting.marked[::way], strict=True)
        for place, (vertex, markers) in enumerate(meetings, before + 1):
            some = (marker if forward else marker.turned for marker in markers[::way] if marker.wall in (wall.label, ANY))
            marks += (Mark(place, edge, vertex, marker.edge, *marker.daughters, marker.new_wall, marker.at) for marker in some)
    return made, marks


def matching(marks: Sequence[Mark]) -> tuple[Mark, Mark] | None:
    """The first two markers that match: the first one, walking around the wall, that matches one passed before.

    Markers match that have the same label, come from different edges, point one away from its edge, one toward it, or both
    nowhere; that name the same daughters on both sides of the new edge; and the same new wall.
    """
    passed: dict[tuple[Edge, str, str, str], Mark] = {}
    for mark in marks:
        other = passed.get((mark.new_edge.turned, mark.behind, mark.before, mark.new_wall))
        if other and other.edge != mark.edge:
            return other, mark
        passed.setdefault((mark.new_edge, mark.before, mark.behind, mark.new_wall), mark)
    return None
