"""What becomes of edges in a step, in the plane and in space (The Algorithmic Beauty of Plants, sections 7.1.2 and 7.5).

Edges surround the cells of a map and the walls of a cellwork: both are rings. Each edge is replaced by its successor, and the
markers between the new edges are handed to the rings on whose sides they are; then a ring is divided by a new edge between two
markers that match, at most once. Nothing else changes, so the time of a step is proportional to the edges.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from lsys_kit.budget import counted
from lsys_kit.notation.model.cells import AnyMarker, Edge, EdgeRule


class Vertex(NamedTuple):
    """Where a vertex was made: between which two others, which share of the way, and on which edge of the step before.

    The vertices of the first cell were made nowhere.
    """

    between: tuple[int, int] | None = None
    share: Fraction = Fraction(0)
    wall: int | None = None


class CellEdge(NamedTuple):
    """An edge: its label, the vertices at its beginning and its end, and whether it has a direction.

    A neutral edge has none; then its beginning is just one of its ends.
    """

    label: str
    start: int
    end: int
    directed: bool

    def met(self, forward: bool) -> Edge:
        """The edge as one reads it who follows its direction, or goes against it."""
        return Edge(self.label, (">" if forward else "<") if self.directed else "")

    @property
    def kind(self) -> Edge:
        """The edge as the predecessor of a production."""
        return self.met(True)


class Side(NamedTuple):
    """An edge as one meets it on the way around a ring, or a wall of a cell in space: its number, and whether one follows its
    direction; of a wall whether its edges run counter-clockwise, as seen from outside of the cell.
    """

    wall: int
    forward: bool


class Replaced(NamedTuple):
    """What has become of an edge: the new edges in order, and between them the vertices with their markers."""

    edges: range
    turned: Sequence[bool]
    vertices: Sequence[int]
    marked: Sequence[Sequence[Any]]


class Mark(NamedTuple):
    """A marker seen from a ring: after how many of its sides it stands, on which edge of the step before, at which vertex.

    What it says is as one reads it on the way around the ring.
    """

    place: int
    edge: int
    vertex: int
    marker: Any


def edge_between(edge: Edge, one: int, other: int) -> CellEdge:
    """An edge that is read from one vertex to another."""
    return CellEdge(edge.label, *((other, one) if edge.arrow == "<" else (one, other)), bool(edge.arrow))


def corners_of(sides: Iterable[Side], edges: Sequence[CellEdge]) -> list[int]:
    """The vertices at which some sides begin."""
    return [edges[edge].start if forward else edges[edge].end for edge, forward in sides]


def replaced_edges(
    rules: Iterable[tuple[CellEdge, EdgeRule[AnyMarker] | None]], vertices: list[Vertex]
) -> tuple[list[CellEdge], list[Replaced]]:
    """The edges of the next step before rings are divided, given those that there are with their productions, or None; and what
    has become of each. New vertices come behind the others.
    """
    edges: list[CellEdge] = []
    partings = []
    for number, (edge, rule) in enumerate(rules):
        successor = rule.edges if rule else (edge.kind,)
        between = range(len(vertices), len(vertices) + len(successor) - 1)
        vertices += (
            Vertex((edge.start, edge.end), Fraction(part, len(successor)), number) for part in range(1, len(successor))
        )
        ends, first = (edge.start, *between, edge.end), len(edges)
        edges += map(edge_between, successor, ends, ends[1:])
        turned = [each.arrow == "<" for each in successor]
        partings.append(Replaced(range(first, len(edges)), turned, between, rule.marked if rule else ()))
    return edges, partings


def around(
    sides: Iterable[Side], partings: Sequence[Replaced], seen: Callable[[Any, bool], object]
) -> tuple[tuple[Side, ...], list[Mark]]:
    """The sides of a ring after the replacement of its edges, and the markers that divide it, as the ring sees them: given a
    marker, and whether one follows the direction of its edge; None, if it divides another ring.
    """
    made: list[Side] = []
    marks: list[Mark] = []
    for edge, forward in counted(sides):
        parting, way = partings[edge], 1 if forward else -1
        before = len(made)
        made += (Side(new, turned != forward) for new, turned in zip(parting.edges[::way], parting.turned[::way], strict=True))
        meetings = zip(parting.vertices[::way], parting.marked[::way], strict=True)
        for place, (vertex, markers) in enumerate(meetings, before + 1):
            marks += (Mark(place, edge, vertex, marker) for each in markers[::way] if (marker := seen(each, forward)))
    return tuple(made), marks


def matching(marks: Iterable[Mark]) -> tuple[Mark, Mark] | None:
    """The first two markers that match: the first one, walking around the ring, that matches one passed before.

    Markers match that come from different edges and are the two halves of one new edge: they have the same label, and point one
    away from its edge, one toward it, or both nowhere; in a cellwork they name the same daughters on both sides of the new
    edge, and the same new wall.
    """
    passed: dict[object, Mark] = {}  # keep only the first marker of each kind: the markers of one edge stand side by side
    for mark in counted(marks):
        own, wanted = mark.marker.halves
        other = passed.get(wanted)
        if other and other.edge != mark.edge:
            return other, mark
        passed.setdefault(own, mark)
    return None


def divided(sides: Sequence[Side], pair: tuple[Mark, Mark], edges: list[CellEdge]) -> tuple[tuple[Side, ...], tuple[Side, ...]]:
    """The two parts of a ring that is divided by a new edge between two markers."""
    first, second = pair
    new, forward = len(edges), first.marker.edge.arrow != "<"
    edges.append(edge_between(first.marker.edge, first.vertex, second.vertex))
    return (
        (*sides[: first.place], Side(new, forward), *sides[second.place :]),
        (*sides[first.place : second.place], Side(new, not forward)),
    )
