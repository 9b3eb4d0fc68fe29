"""One step of a map: walls are replaced, then cells divided (The Algorithmic Beauty of Plants, section 7.1.2).

Each wall is replaced by its successor, and the markers between the new walls are handed to the cells on their sides; then each
cell joins two markers that match, at most once. Nothing else changes, so the time of a step is proportional to the walls.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import permutations
from typing import NamedTuple

from lsys_kit.budget import check_step, counted
from lsys_kit.derivation.maps.map import Map, Side, Vertex, Wall
from lsys_kit.notation.model.maps import LEFT, RIGHT, Edge, EdgeProduction, Marker

WALL_BYTES = 420
"""About what a wall takes in memory, with its share of vertices and cells."""


class DividedWall(NamedTuple):
    """A wall after its replacement: the new walls in order, and between them the vertices with their markers."""

    walls: range
    turned: Sequence[bool]
    vertices: Sequence[int]
    marked: Sequence[Sequence[Marker]]


class Mark(NamedTuple):
    """A marker seen from a cell: after how many of its sides it stands, on which wall of the previous map, at which vertex."""

    place: int
    wall: int
    vertex: int
    edge: Edge


def map_step(found: Map, productions: Mapping[Edge, EdgeProduction], step: int) -> Map:
    """The map of the next step."""
    check_step(step, sum(len(_successor(wall, productions)) for wall in counted(found.walls)), "walls", WALL_BYTES)
    vertices, walls, partings = _all_parted(found, productions)
    cells, mothers = [], []
    for number, cell in enumerate(counted(found.cells)):
        daughters = _divided(*_replaced(cell, partings), walls)
        cells += daughters
        mothers += [number] * len(daughters)
    check_step(step, len(walls), "walls", WALL_BYTES)
    return Map(tuple(vertices), tuple(walls), tuple(cells), tuple(_replaced(found.boundary, partings)[0]), tuple(mothers))


class Stub(NamedTuple):
    """A marker on a wall that has just been replaced: on which wall of the map before, at which vertex, to which side of that
    wall, what it begins, and at which vertex it finds a partner, if it does.
    """

    wall: int
    vertex: int
    side: str
    edge: Edge
    partner: int | None


def replaced_map(found: Map, productions: Mapping[Edge, EdgeProduction]) -> tuple[Map, Sequence[Stub]]:
    """The map after the first phase of a step, whose walls are replaced and whose cells are not divided, and its markers."""
    vertices, walls, partings = _all_parted(found, productions)
    cells, partners = [], dict[tuple[int, int, str, Edge], int]()
    for cell in counted(found.cells):
        sides, marks = _replaced(cell, partings)
        cells.append(tuple(sides))
        inside = {wall: RIGHT if forward else LEFT for wall, forward in cell}
        for one, other in permutations(matching(marks) or (), 2):
            partners[one.wall, one.vertex, inside[one.wall], one.edge] = other.vertex
    made = (
        (number, vertex, marker.side, marker.edge)
        for number, parting in enumerate(partings)
        for vertex, markers in zip(parting.vertices, parting.marked, strict=False)
        for marker in markers
    )
    stubs = [Stub(*marker, partners.get(marker)) for marker in made]
    return Map(
        tuple(vertices), tuple(walls), tuple(cells), tuple(_replaced(found.boundary, partings)[0]), tuple(range(len(cells)))
    ), stubs


def predecessor_of(wall: Wall) -> Edge:
    """A wall as the predecessor of a production."""
    return Edge(wall.label, ">" if wall.directed else "")


def _successor(wall: Wall, productions: Mapping[Edge, EdgeProduction]) -> tuple[Edge, ...]:
    """The walls that a wall becomes; itself, where it has no production."""
    predecessor = predecessor_of(wall)
    return productions[predecessor].walls if predecessor in productions else (predecessor,)


def dividing_walls(before: Map, after: Map, productions: Mapping[Edge, EdgeProduction]) -> Sequence[Wall]:
    """The walls of a map that divide a cell of the map before it."""
    return after.walls[sum(len(_successor(wall, productions)) for wall in counted(before.walls)) :]


def _all_parted(found: Map, productions: Mapping[Edge, EdgeProduction]) -> tuple[list[Vertex], list[Wall], list[DividedWall]]:
    """The vertices and walls of a map whose walls are replaced, and what has become of each."""
    vertices, walls = [*found.vertices], list[Wall]()
    return (
        vertices,
        walls,
        [
            _parted(number, wall, productions.get(predecessor_of(wall)), vertices, walls)
            for number, wall in enumerate(counted(found.walls))
        ],
    )


def _parted(
    number: int, wall: Wall, production: EdgeProduction | None, vertices: list[Vertex], walls: list[Wall]
) -> DividedWall:
    """Replace a wall, in its own direction: its vertices and walls are put behind those that there are."""
    edges = production.walls if production else (predecessor_of(wall),)
    between = range(len(vertices), len(vertices) + len(edges) - 1)
    vertices += (Vertex((wall.start, wall.end), Fraction(part, len(edges)), number) for part in range(1, len(edges)))
    ends = [wall.start, *between, wall.end]
    first = len(walls)
    walls += (
        Wall(edge.label, *((b, a) if edge.arrow == "<" else (a, b)), bool(edge.arrow))
        for edge, a, b in zip(edges, ends, ends[1:], strict=False)
    )
    return DividedWall(
        range(first, len(walls)), [edge.arrow == "<" for edge in edges], between, _marked(production) if production else ()
    )


def _marked(production: EdgeProduction) -> list[list[Marker]]:
    """The markers of a production, behind each wall of its successor but the last."""
    marked: list[list[Marker]] = []
    for part in production.successor:
        if isinstance(part, Marker):
            marked[-1].append(part)
        else:
            marked.append([])
    return marked[:-1]


def _replaced(sides: Sequence[Side], partings: Sequence[DividedWall]) -> tuple[list[Side], list[Mark]]:
    """The sides of a cell after the replacement of its walls, and the markers that point into it."""
    made: list[Side] = []
    marks: list[Mark] = []
    for wall, forward in counted(sides):
        parting = partings[wall]
        way, inside = (1, RIGHT) if forward else (-1, LEFT)
        before = len(made)
        made += (Side(new, turned != forward) for new, turned in zip(parting.walls[::way], parting.turned[::way], strict=True))
        meetings = zip(parting.vertices[::way], parting.marked[::way], strict=False)
        for place, (vertex, markers) in enumerate(meetings, before + 1):
            marks += (Mark(place, wall, vertex, marker.edge) for marker in markers[::way] if marker.side == inside)
    return made, marks


def _divided(sides: list[Side], marks: Sequence[Mark], walls: list[Wall]) -> list[tuple[Side, ...]]:
    """A cell divided by a new wall between two markers that match; the cell alone, where none do."""
    pair = matching(marks)
    if pair is None:
        return [tuple(sides)]
    first, second = pair
    forward = first.edge.arrow != "<"
    ends = (first.vertex, second.vertex) if forward else (second.vertex, first.vertex)
    new = len(walls)
    walls.append(Wall(first.edge.label, *ends, bool(first.edge.arrow)))
    return [
        (*sides[: first.place], Side(new, forward), *sides[second.place :]),
        (*sides[first.place : second.place], Side(new, not forward)),
    ]


def matching(marks: Sequence[Mark]) -> tuple[Mark, Mark] | None:
    """The first two markers that match: the first one, walking around the cell, that matches one passed before.

    Markers match that have the same label, come from different walls, and point one away from its wall, one toward it; or both
    nowhere.
    """
    passed: dict[Edge, Mark] = {}  # keep only the first marker of each kind: the markers of one wall stand side by side
    for mark in counted(marks):
        other = passed.get(mark.edge.turned)
        if other and other.wall != mark.wall:
            return other, mark
        passed.setdefault(mark.edge, mark)
    return None
