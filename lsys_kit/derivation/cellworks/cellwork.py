"""Cellworks: cells side by side in space, each with the walls around it (The Algorithmic Beauty of Plants, section 7.5).

A cellwork is kept as its edges, for each wall the edges once around it, and for each cell its walls, seen from outside or from
inside. Positions are no part of it; geometry computes them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.maps.map import Vertex
from lsys_kit.errors import every, require


class CellEdge(NamedTuple):
    """An edge: its label, the vertices at its beginning and its end, and whether it has a direction."""

    label: str
    start: int
    end: int
    directed: bool


class EdgeSide(NamedTuple):
    """An edge as one meets it on the way around a wall: its number, and whether one follows its direction."""

    edge: int
    forward: bool


class CellWall(NamedTuple):
    """A wall: its label, and the edges once around it."""

    label: str
    sides: tuple[EdgeSide, ...]


class WallSide(NamedTuple):
    """A wall of a cell: its number, and whether its edges run counter-clockwise, as seen from outside of the cell."""

    wall: int
    forward: bool


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
    >>> from lsys_kit.derivation.cellworks.development import develop_cellwork
    >>> from lsys_kit.notation.dialects.cellwork.dialect import read_cellwork
    >>> prism = read_cellwork('''
    ... cellwork: 1(0,0,0) 2(1,0,0) 3(0,1,0) 4(0,0,1) 5(1,0,1) 6(0,1,1)
    ... wall T: 1 A 2 A 3 A
    ... wall T: 4 A 5 A 6 A
    ... wall S: 1 A 2 B 5 A 4 B
    ... wall S: 2 A 3 B 6 A 5 B
    ... wall S: 3 A 1 B 4 A 6 B
    ... B: * -> B [S: S|A|S, T] B''')
    >>> divided = develop_cellwork(prism, 1)[-1]
    >>> print(divided)
    T S S S T | T S S S T
    >>> divided.counts, divided.euler
    ((9, 15, 9, 2), 1)
    """

    vertices: tuple[Vertex, ...]
    edges: tuple[CellEdge, ...]
    walls: tuple[CellWall, ...]
    cells: tuple[tuple[WallSide, ...], ...]
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
        return [self.edges[edge].start if forward else self.edges[edge].end for edge, forward in wall.sides]

    def labels(self, cell: Sequence[WallSide]) -> tuple[str, ...]:
        """The labels of the walls of a cell."""
        every(cell, WallSide, "The side of a wall")
        return tuple(self.walls[side.wall].label for side in cell)

    def cells_at(self) -> Iterator[tuple[int, int, bool]]:
        """The walls of all cells: the cell, the wall, and whether its edges run counter-clockwise as seen from outside."""
        for number, cell in enumerate(counted(self.cells)):
            yield from ((number, wall, forward) for wall, forward in cell)

    def __str__(self) -> str:
        with Task("The text of the cellwork was not written"):
            return " | ".join(" ".join(self.labels(cell)) for cell in counted(self.cells))
