"""Deriving maps: from the first cell to the cells of any step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import overload

from lsys_kit.budget import Task, check_budget, counted
from lsys_kit.derivation.maps.divisions import dividing_walls, map_step, predecessor_of
from lsys_kit.derivation.maps.map import Map, Side, Vertex, Wall
from lsys_kit.errors import ModelLimitError, whole_number
from lsys_kit.notation.model.maps import Edge, EdgeProduction, MapSystem

MOST_MAPS_SHOWN = 400
"""How many characters of a map `repr` shows."""


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

    @property
    def notes(self) -> tuple[str, ...]:
        """Remarks: on the rules, and on markers that find no other half.

        >>> from lsys_kit.notation.dialects.map.dialect import read_map
        >>> develop(read_map("map: A>B>C>\\nA> -> D>[+A>]B>\\nC> -> B>[+A<]B>"), 1).notes
        ('Markers of A never match up to step 1: no cell has two on its sides that fit.',)
        """
        with Task("The remarks were not found"):
            return (*self.system.notes, *unmatched_markers(self.system, self._maps))

    def __len__(self) -> int:
        return len(self._maps)

    @overload
    def __getitem__(self, index: int) -> Map: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Map]: ...
    def __getitem__(self, index: int | slice) -> Map | Sequence[Map]:
        return self._maps[index]

    def __repr__(self) -> str:
        with Task("The text of the maps was not written"):
            lines = (f"{step} {found}" for step, found in enumerate(counted(self._maps, 1)))
            return "\n".join(line if len(line) <= MOST_MAPS_SHOWN else f"{line[:MOST_MAPS_SHOWN]}..." for line in lines)


def develop(system: MapSystem, steps: int) -> Development:
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
    >>> from lsys_kit.notation.dialects.map.dialect import read_map
    >>> develop(read_map("map: A>B>C>D>\\nA> -> D>[-A>]B>\\nC> -> B>[-A<]B>\\nD> -> C>"), 2)
    0 A>B>C>D>
    1 D>A>B>C> | B>B>B>A<
    2 C>D>A>B> | B>B>B>A< | B>B>B>B<D<
    """
    steps = whole_number(steps, "The number of steps")
    maps = [first_map(system)]
    productions = productions_of(system)
    with Task():
        for step in range(1, steps + 1):
            try:
                maps.append(_next_map(maps[-1], productions, step))
            except ModelLimitError as error:
                error.partial = Development(system, maps)
                kept = "Step 0 is" if step == 1 else f"Steps 0-{step - 1} are"
                raise error.with_hint(f"{kept} kept. {error.hint}") from None
    return Development(system, maps)


def productions_of(system: MapSystem) -> Mapping[Edge, EdgeProduction]:
    """The production of each wall that has one."""
    return {production.predecessor: production for production in system.productions}


def unmatched_markers(system: MapSystem, maps: Sequence[Map]) -> Iterator[str]:
    """A remark on the letters of which both halves of walls are made in a step, but never on the sides of one cell."""
    productions = productions_of(system)
    halved, joined = dict[str, None](), set[str]()
    for before, after in pairwise(maps):
        kinds = dict.fromkeys(map(predecessor_of, counted(before.walls)))
        made = [marker.edge for kind in kinds if kind in productions for marker in productions[kind].markers]
        halved |= dict.fromkeys(edge.label for edge in made if edge.turned in made)
        joined |= {wall.label for wall in dividing_walls(before, after, productions)}
    letters = ", ".join(label for label in halved if label not in joined)
    if letters:
        yield f"Markers of {letters} never match up to step {len(maps) - 1}: no cell has two on its sides that fit."


def _next_map(found: Map, productions: Mapping[Edge, EdgeProduction], step: int) -> Map:
    with Task(f"Step {step} was not reached"):
        check_budget()
        return map_step(found, productions, step)


def first_map(system: MapSystem) -> Map:
    """The first cell of a map system, or the first cells of a sphere."""
    if system.sphere:
        return _first_sphere(system.axiom)
    size = len(system.axiom)
    walls, sides = [], []
    for number, edge in enumerate(system.axiom):
        forward, ends = edge.arrow != "<", (number, (number + 1) % size)
        walls.append(Wall(edge.label, *(ends if forward else ends[::-1]), bool(edge.arrow)))
        sides.append(Side(number, forward))
    return Map((Vertex(),) * size, tuple(walls), (tuple(sides),), tuple(sides))


def _first_sphere(meridians: Sequence[Edge]) -> Map:
    """Walls from the upper pole to the lower one, and a cell between any two neighbours."""
    walls = tuple(Wall(edge.label, *((1, 0) if edge.arrow == "<" else (0, 1)), bool(edge.arrow)) for edge in meridians)
    down = [edge.arrow != "<" for edge in meridians]
    right = [*range(1, len(walls)), 0]
    cells = tuple((Side(other, down[other]), Side(number, not down[number])) for number, other in enumerate(right))
    return Map((Vertex(), Vertex()), walls, cells, ())
