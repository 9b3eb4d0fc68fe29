"""Maps: cells side by side in the plane or on a sphere, each with the walls around it (The Algorithmic Beauty of Plants,
chapter 7).

A map is kept as its walls and, for each cell, the walls around it as a cyclic word, read clockwise. Positions are no part of
it; geometry computes them. In a step walls are replaced, and cells divided by new walls between markers that match.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, permutations
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
from lsys_kit.errors import every
from lsys_kit.notation.model.cells import LEFT, RIGHT, Edge, EdgeProduction, MapSystem, Marker

WALL_BYTES = 420
"""About what a wall takes in memory, with its share of vertices and cells."""


@dataclass(frozen=True)
class Map:
    """One map: vertices, walls, cells.

    Attributes
    ----------
    vertices
        Where each vertex was made. From step to step they keep their numbers.
    walls
        Their labels, ends and directions.
    cells
        For each cell the sides around it, clockwise.
    boundary
        The sides of the outermost walls, clockwise around the map: those of one big cell. None on a sphere.
    mothers
        For each cell the number of the cell in the map before from which it came.

    Examples
    --------
    >>> from lsys_kit import derive, read_map
    >>> divided = derive(read_map("map: ABAB\\nA -> B[-A][+A]B\\nB -> A"), 1)[-1]
    >>> print(divided)
    BABA | BABA
    >>> divided.counts
    (6, 7, 2)
    """

    vertices: tuple[Vertex, ...]
    walls: tuple[CellEdge, ...]
    cells: tuple[tuple[Side, ...], ...]
    boundary: tuple[Side, ...]
    mothers: tuple[int, ...] = field(default=(), compare=False)

    @property
    def counts(self) -> tuple[int, int, int]:
        """How many vertices, walls and cells there are."""
        return len(self.vertices), len(self.walls), len(self.cells)

    @property
    def edges(self) -> tuple[CellEdge, ...]:
        """Its walls, which are to its cells what edges are to the walls of a cellwork."""
        return self.walls

    def word(self, sides: Sequence[Side]) -> tuple[Edge, ...]:
        """The letters of some sides, as one walks along them."""
        every(sides, Side, "The side of a wall")
        return tuple(self.walls[wall].met(forward) for wall, forward in counted(sides))

    def corners(self, sides: Sequence[Side]) -> list[int]:
        """The vertices at which some sides begin."""
        every(sides, Side, "The side of a wall")
        return corners_of(sides, self.walls)

    def __str__(self) -> str:
        with Task("The text of the map was not written"):
            return " | ".join("".join(map(str, self.word(cell))) for cell in counted(self.cells))


def first_map(system: MapSystem) -> Map:
    """The first cell of a map system, or the first cells of a sphere."""
    if system.sphere:
        return _first_sphere(system.axiom)
    size = len(system.axiom)
    walls, sides = [], []
    for number, edge in enumerate(system.axiom):
        walls.append(edge_between(edge, number, (number + 1) % size))
        sides.append(Side(number, edge.arrow != "<"))
    return Map((Vertex(),) * size, tuple(walls), (tuple(sides),), tuple(sides))


def _first_sphere(meridians: Sequence[Edge]) -> Map:
    """Walls from the upper pole to the lower one, and a cell between any two neighbours."""
    walls = tuple(edge_between(edge, 0, 1) for edge in meridians)
    down = [edge.arrow != "<" for edge in meridians]
    right = [*range(1, len(walls)), 0]
    cells = tuple((Side(other, down[other]), Side(number, not down[number])) for number, other in enumerate(right))
    return Map((Vertex(), Vertex()), walls, cells, ())


def map_step(found: Map, system: MapSystem, step: int) -> Map:
    """The map of the next step."""
    check_step(step, sum(_many_made(found, system)), "walls", WALL_BYTES)
    vertices, walls, partings = _replaced_walls(found, system)
    cells, mothers = list[tuple[Side, ...]](), list[int]()
    for number, cell in enumerate(counted(found.cells)):
        sides, marks = around(cell, partings, _inside)
        pair = matching(marks)
        daughters = divided(sides, pair, walls) if pair else (sides,)
        cells += daughters
        mothers += [number] * len(daughters)
    check_step(step, len(walls), "walls", WALL_BYTES)
    return Map(tuple(vertices), tuple(walls), tuple(cells), around(found.boundary, partings, _inside)[0], tuple(mothers))


class Stub(NamedTuple):
    """A marker on a wall that has just been replaced: on which wall of the map before, at which vertex, to which side of that
    wall, what it begins, and at which vertex it finds a partner, if it does.
    """

    wall: int
    vertex: int
    side: str
    edge: Edge
    partner: int | None


def replaced_map(found: Map, system: MapSystem) -> tuple[Map, Sequence[Stub]]:
    """The map after the first phase of a step, whose walls are replaced and whose cells are not divided, and its markers."""
    vertices, walls, partings = _replaced_walls(found, system)
    cells, partners = list[tuple[Side, ...]](), dict[tuple[int, int, Marker], int]()
    for cell in counted(found.cells):
        sides, marks = around(cell, partings, _inside)
        cells.append(sides)
        for one, other in permutations(matching(marks) or (), 2):
            partners[one.edge, one.vertex, one.marker] = other.vertex
    stubs = [
        Stub(number, vertex, marker.side, marker.edge, partners.get((number, vertex, marker)))
        for number, parting in enumerate(partings)
        for vertex, markers in zip(parting.vertices, parting.marked, strict=True)
        for marker in markers
    ]
    boundary = around(found.boundary, partings, _inside)[0]
    return Map(tuple(vertices), tuple(walls), tuple(cells), boundary, tuple(range(len(cells)))), stubs


def dividing_walls(before: Map, after: Map, system: MapSystem) -> Sequence[CellEdge]:
    """The walls of a map that divide a cell of the map before it."""
    return after.walls[sum(_many_made(before, system)) :]


def unmatched_markers(system: MapSystem, maps: Sequence[Map]) -> Iterator[str]:
    """A remark on the letters of which both halves of walls are made in a step, but never on the sides of one cell."""
    productions = _productions_of(system)
    halved, joined = dict[str, None](), set[str]()
    for before, after in pairwise(maps):
        kinds = dict.fromkeys(wall.kind for wall in counted(before.walls))
        made = [marker.edge for kind in kinds if kind in productions for marker in productions[kind].markers]
        halved |= dict.fromkeys(edge.label for edge in made if edge.turned in made)
        joined |= {wall.label for wall in dividing_walls(before, after, system)}
    letters = ", ".join(label for label in halved if label not in joined)
    if letters:
        yield f"Markers of {letters} never match up to step {len(maps) - 1}: no cell has two on its sides that fit."


def _productions_of(system: MapSystem) -> Mapping[Edge, EdgeProduction]:
    return {production.predecessor: production for production in system.productions}


def _many_made(found: Map, system: MapSystem) -> Iterator[int]:
    productions = _productions_of(system)
    return (len(productions[wall.kind].edges) if wall.kind in productions else 1 for wall in counted(found.walls))


def _replaced_walls(found: Map, system: MapSystem) -> tuple[list[Vertex], list[CellEdge], list[Replaced]]:
    """The vertices and walls of a map whose walls are replaced, and what has become of each."""
    vertices, productions = [*found.vertices], _productions_of(system)
    return vertices, *replaced_edges(((wall, productions.get(wall.kind)) for wall in counted(found.walls)), vertices)


def _inside(marker: Marker, forward: bool) -> Marker | None:
    """A marker, if it is on the side of its wall where a cell lies that follows the wall's direction, or goes against it."""
    return marker if marker.side == (RIGHT if forward else LEFT) else None


def cell_words(found: Map) -> Iterator[tuple[Edge, ...]]:
    """For each cell the letters around it, rotated to the least word: the same for cells that are alike."""
    return map(least_word, map(found.word, found.cells))


def kinds_of_cells(maps: Iterable[Map]) -> Iterator[list[int]]:
    """For each map the numbers of the kinds of its cells: alike in all maps are those with the same walls around them."""
    known = dict[tuple[Edge, ...], int]()
    return ([known.setdefault(word, len(known)) for word in cell_words(found)] for found in maps)


def least_word(word: Sequence[Edge]) -> tuple[Edge, ...]:
    """A cyclic word, rotated to its least form (Booth 1980)."""
    first = least_rotation([(edge.label, edge.arrow) for edge in word])
    return (*word[first:], *word[:first])


def least_rotation(row: Sequence[tuple[str, str]]) -> int:
    """Where a cyclic word begins when it is rotated to its least form.

    >>> least_rotation([("B", ""), ("A", ""), ("B", ""), ("A", "")])
    1
    """
    one, other, length = 0, 1, 0
    while max(one, other, length) < len(row):
        left, right = row[(one + length) % len(row)], row[(other + length) % len(row)]
        if left == right:
            length += 1
            continue
        one, other = (one + length + 1, other) if left > right else (one, other + length + 1)
        other += one == other
        length = 0
    return min(one, other)
