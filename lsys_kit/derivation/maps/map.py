"""Maps: cells side by side in the plane, each with the walls around it (The Algorithmic Beauty of Plants, chapter 7).

A map is kept as its walls and, for each cell, the walls around it as a cyclic word, read clockwise. Positions are no part of
it; geometry computes them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

from lsys_kit.budget import Task, counted
from lsys_kit.errors import every
from lsys_kit.notation.model.maps import Edge


class Wall(NamedTuple):
    """A wall: its label, the vertices at its beginning and its end, and whether it has a direction.

    A neutral wall has none; then its beginning is just one of its ends.
    """

    label: str
    start: int
    end: int
    directed: bool


class Side(NamedTuple):
    """A wall seen from a cell: its number, and whether its direction runs clockwise around the cell."""

    wall: int
    forward: bool


class Vertex(NamedTuple):
    """Where a vertex was made: between which two others, which share of the way, and on which wall of the map before.

    The vertices of the first cell were made nowhere.
    """

    between: tuple[int, int] | None = None
    share: Fraction = Fraction(0)
    wall: int | None = None


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
    >>> from lsys_kit.derivation.maps.development import develop
    >>> from lsys_kit.notation.dialects.map.dialect import read_map
    >>> divided = develop(read_map("map: ABAB\\nA -> B[-A][+A]B\\nB -> A"), 1)[-1]
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
        every(sides, Side, "The side of a wall")
        return tuple(self._edge(side) for side in counted(sides))

    def _edge(self, side: Side) -> Edge:
        wall = self.walls[side.wall]
        return Edge(wall.label, (">" if side.forward else "<") if wall.directed else "")

    def corners(self, sides: Sequence[Side]) -> list[int]:
        """The vertices at which some sides begin."""
        every(sides, Side, "The side of a wall")
        return [self.walls[wall].start if forward else self.walls[wall].end for wall, forward in sides]

    def __str__(self) -> str:
        with Task("The text of the map was not written"):
            return " | ".join("".join(map(str, self.word(cell))) for cell in counted(self.cells))


def cell_words(found: Map) -> Iterator[tuple[Edge, ...]]:
    """For each cell the letters around it, rotated to the least word: the same for cells that are alike."""
    for cell in found.cells:
        word = found.word(cell)
        first = least_rotation([(edge.label, edge.arrow) for edge in word])
        yield word[first:] + word[:first]


def least_rotation(row: Sequence[tuple[str, str]]) -> int:
    """Where a cyclic word begins when it is rotated to its least form (Booth 1980).

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
