"""Deriving maps: from the first cell to the cells of any step (The Algorithmic Beauty of Plants, section 7.1.2).

A map is kept as its walls and, for each cell, the walls around it as a cyclic word, read clockwise. In a step each wall is
replaced by its successor, and the markers between the new walls are handed to the cells on their sides; then each cell joins
two markers that match, at most once. Nothing else changes, so that a step is as quick as its walls are many.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple, overload

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.maps import LEFT, RIGHT, Edge, EdgeProduction, MapSystem, Marker

WALL_BYTES = 420
"""About what a wall takes in memory, with its share of vertices and cells."""
OFTEN = 1_000
"""After so many cells the time is looked at."""


class Wall(NamedTuple):
    """A wall: its label, the vertices at its beginning and its end, and whether it has a direction.

    A neutral wall has none; then its beginning is just one of its ends.
    """

    label: str
    start: int
    end: int
    directed: bool


class Side(NamedTuple):
    """A wall as a cell has it: its number, and whether one walks along it from its beginning to its end, with the cell on the
    right hand."""

    wall: int
    forward: bool


class Vertex(NamedTuple):
    """Where a vertex was made: between which two others, and which share of the way; None for those of the first cell."""

    between: tuple[int, int] | None = None
    share: Fraction = Fraction(0)


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
        The sides of the outermost walls, clockwise around the map: those of one big cell.
    mothers
        For each cell the number of the cell in the map before from which it came.

    Examples
    --------
    >>> from lsys_kit.notation.read_map import read_map
    >>> divided = developed(read_map("map: ABAB\\nA -> B[-A][+A]B\\nB -> A"), 1)[-1]
    >>> print(divided)
    BABA | BABA
    >>> divided.counts
    (6, 7, 2)
    """

    vertices: tuple[Vertex, ...]
    walls: tuple[Wall, ...]
    cells: tuple[tuple[Side, ...], ...]
    boundary: tuple[Side, ...]
    mothers: tuple[int, ...] = field(default=(), compare=False)

    @property
    def counts(self) -> tuple[int, int, int]:
        """How many vertices, walls and cells there are."""
        return len(self.vertices), len(self.walls), len(self.cells)

    def word(self, sides: Sequence[Side]) -> tuple[Edge, ...]:
        """The letters of some sides, as one walks along them."""
        return tuple(self._edge(side) for side in sides)

    def _edge(self, side: Side) -> Edge:
        wall = self.walls[side.wall]
        return Edge(wall.label, (">" if side.forward else "<") if wall.directed else "")

    def corners(self, sides: Sequence[Side]) -> list[int]:
        """The vertices at which some sides begin."""
        return [self.walls[wall].start if forward else self.walls[wall].end for wall, forward in sides]

    def __str__(self) -> str:
        return " | ".join("".join(map(str, self.word(cell))) for cell in self.cells)


class Development(Sequence[Map]):
    """The maps of steps 0, 1, 2, ...

    Attributes
    ----------
    system
        The map system.
    """

    def __init__(self, system: MapSystem, maps: Sequence[Map]) -> None:
        self.system, self._maps = system, tuple(maps)

    @property
    def steps(self) -> int:
        """The last step."""
        return len(self._maps) - 1

    @property
    def counts(self) -> list[tuple[int, int, int]]:
        """For each step how many vertices, walls and cells there are."""
        return [found.counts for found in self._maps]

    def __len__(self) -> int:
        return len(self._maps)

    @overload
    def __getitem__(self, index: int) -> Map: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Map]: ...
    def __getitem__(self, index: int | slice) -> Map | Sequence[Map]:
        return self._maps[index]

    def __repr__(self) -> str:
        lines = (f"{step} {found}" for step, found in enumerate(self._maps))
        return "\n".join(line if len(line) <= SHOWN else f"{line[:SHOWN]}..." for line in lines)


SHOWN = 400
"""How many characters of a map `repr` shows."""


def developed(system: MapSystem, steps: int) -> Development:
    """The maps of a map system, from the first cell on; `derive` does the same for every kind of system.

    Parameters
    ----------
    system
        A map system.
    steps
        How many steps.

    Raises
    ------
    ModelLimitError
        A map would be too large; the error has the step and, in `partial`, the maps before.

    Examples
    --------
    >>> from lsys_kit.notation.read_map import read_map
    >>> developed(read_map("map: A>B>C>D>\\nA> -> D>[-A>]B>\\nC> -> B>[-A<]B>\\nD> -> C>"), 2)
    0 A>B>C>D>
    1 D>A>B>C> | B>B>B>A<
    2 C>D>A>B> | B>B>B>A< | B>B>B>B<D<
    """
    if isinstance(steps, bool) or not isinstance(steps, int) or steps < 0:
        raise ModelValueError(f"The number of steps must be a whole number from 0 on, not {steps!r}")
    maps, until = [first_map(system)], time.monotonic() + current().seconds
    productions = {production.predecessor: production for production in system.productions}
    for step in range(1, steps + 1):
        try:
            maps.append(stepped(maps[-1], productions, step, until))
        except ModelLimitError as error:
            error.partial = Development(system, maps)
            raise error.with_hint(f"{'Step 0 is' if step == 1 else f'Steps 0-{step - 1} are'} kept. {error.hint}") from None
    return Development(system, maps)


def first_map(system: MapSystem) -> Map:
    """The first cell of a map system."""
    size = len(system.axiom)
    walls, sides = [], []
    for number, edge in enumerate(system.axiom):
        forward, ends = edge.arrow != "<", (number, (number + 1) % size)
        walls.append(Wall(edge.label, *(ends if forward else ends[::-1]), bool(edge.arrow)))
        sides.append(Side(number, forward))
    return Map((Vertex(),) * size, tuple(walls), (tuple(sides),), tuple(sides))


class Parting(NamedTuple):
    """What a wall has become: its new walls, one after another, and between them vertices with their markers."""

    walls: range
    turned: Sequence[bool]
    vertices: Sequence[int]
    marked: Sequence[Sequence[Marker]]


class Mark(NamedTuple):
    """A marker as a cell has it: behind how many of its sides it stands, on which wall of the map before, at which vertex."""

    place: int
    wall: int
    vertex: int
    edge: Edge


def stepped(found: Map, productions: Mapping[Edge, EdgeProduction], step: int, until: float) -> Map:
    """The map of the next step."""
    check_walls(sum(len(_successor(wall, productions)) for wall in found.walls), step)
    vertices, walls = [*found.vertices], list[Wall]()
    partings = [_parted(wall, productions.get(_predecessor(wall)), vertices, walls) for wall in found.walls]
    cells, mothers = [], []
    for number, cell in enumerate(found.cells):
        if number % OFTEN == 0:
            _check_time(step, until)
        daughters = _divided(*_replaced(cell, partings), walls)
        cells += daughters
        mothers += [number] * len(daughters)
    check_walls(len(walls), step)
    return Map(tuple(vertices), tuple(walls), tuple(cells), tuple(_replaced(found.boundary, partings)[0]), tuple(mothers))


def _predecessor(wall: Wall) -> Edge:
    return Edge(wall.label, ">" if wall.directed else "")


def _successor(wall: Wall, productions: Mapping[Edge, EdgeProduction]) -> tuple[Edge, ...]:
    """The walls that a wall becomes; itself, where it has no production."""
    predecessor = _predecessor(wall)
    return productions[predecessor].walls if predecessor in productions else (predecessor,)


def _parted(wall: Wall, production: EdgeProduction | None, vertices: list[Vertex], walls: list[Wall]) -> Parting:
    """Replace a wall, in its own direction: its vertices and walls are put behind those that there are."""
    edges = production.walls if production else (_predecessor(wall),)
    between = range(len(vertices), len(vertices) + len(edges) - 1)
    vertices += (Vertex((wall.start, wall.end), Fraction(part, len(edges))) for part in range(1, len(edges)))
    ends = [wall.start, *between, wall.end]
    first = len(walls)
    walls += (Wall(edge.label, *((b, a) if edge.arrow == "<" else (a, b)), bool(edge.arrow))
              for edge, a, b in zip(edges, ends, ends[1:], strict=False))
    return Parting(range(first, len(walls)), [edge.arrow == "<" for edge in edges], between,
                   _marked(production) if production else ())


def _marked(production: EdgeProduction) -> list[list[Marker]]:
    """The markers of a production, behind each wall of its successor but the last."""
    marked: list[list[Marker]] = []
    for part in production.successor:
        if isinstance(part, Marker):
            marked[-1].append(part)
        else:
            marked.append([])
    return marked[:-1]


def _replaced(sides: Sequence[Side], partings: Sequence[Parting]) -> tuple[list[Side], list[Mark]]:
    """The sides of a cell after the replacement of its walls, and the markers that point into it."""
    made: list[Side] = []
    marks: list[Mark] = []
    for wall, forward in sides:
        parting = partings[wall]
        way, inside = (1, RIGHT) if forward else (-1, LEFT)
        before = len(made)
        made += (Side(new, turned != forward)
                 for new, turned in zip(parting.walls[::way], parting.turned[::way], strict=True))
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
    return [(*sides[:first.place], Side(new, forward), *sides[second.place:]),
            (*sides[first.place:second.place], Side(new, not forward))]


def matching(marks: Sequence[Mark]) -> tuple[Mark, Mark] | None:
    """The first two markers that match: the first one, walking around the cell, that matches one passed before.

    Markers match that have the same label, come from different walls, and point one away from its wall, one toward it; or both
    nowhere.
    """
    passed: dict[Edge, list[Mark]] = {}
    for mark in marks:
        other = next((one for one in passed.get(mark.edge.turned, ()) if one.wall != mark.wall), None)
        if other:
            return other, mark
        alike = passed.setdefault(mark.edge, [])
        if len(alike) < 2 and all(one.wall != mark.wall for one in alike):  # one of two is not from the wall of a third
            alike.append(mark)
    return None


def check_walls(size: int, step: int) -> None:
    """Refuse a step whose map would be past a limit."""
    most = current()
    if size > most.modules:
        raise ModelLimitError(f"Step {step} would have {size:,} walls or more; the limit is {most.modules:,}",
                              limit=most.modules, needed=size, hint="Take fewer steps, or set limits(modules=...).")
    if size * WALL_BYTES > most.bytes:
        raise ModelLimitError(f"Step {step} would take about {size * WALL_BYTES:,} bytes; the limit is {most.bytes:,}",
                              limit=most.bytes, needed=size * WALL_BYTES, hint="Take fewer steps, or set limits(bytes=...).")


def _check_time(step: int, until: float) -> None:
    if time.monotonic() > until:
        raise ModelLimitError(f"Step {step} was not reached in {current().seconds:g} seconds", limit=current().seconds,
                              hint="Take fewer steps, or set limits(seconds=...).")


def cell_words(found: Map) -> Iterator[tuple[Edge, ...]]:
    """For each cell the letters around it, from where they read least: the same for cells that are alike."""
    for cell in found.cells:
        word = found.word(cell)
        first = least_rotation([(edge.label, edge.arrow) for edge in word])
        yield word[first:] + word[:first]


def least_rotation(row: Sequence[tuple[str, str]]) -> int:
    """Where a cyclic word must begin to read least.

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
