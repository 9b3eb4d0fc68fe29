"""The records of a cellwork L-system: corners, walls, productions (The Algorithmic Beauty of Plants, section 7.5).

A cellwork is cells side by side in space; walls divide them, and edges bound the walls. Edges are rewritten; markers
on the new ones say where a wall is divided, and by what edge. Where new edges go once around a cell, a new wall divides it.
`str` of a cellwork system is its text, which reads back as the same system.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import groupby
from typing import TypeAlias

from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.expressions import TextSpan
from lsys_kit.notation.model.maps import Edge
from lsys_kit.notation.model.modules import abridged_text

ANY = "*"
"""Stands for all walls."""


@dataclass(frozen=True)
class Corner:
    """A corner of the first cell: its number, and its place in space, with z upwards."""

    name: str
    place: tuple[Fraction, Fraction, Fraction]
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        places = (number_text(int(place) if place.denominator == 1 else place) for place in self.place)
        return f"{self.name}({', '.join(places)})"


@dataclass(frozen=True)
class FirstWall:
    """A wall of the first cell: its label, and the corners and edges that one meets in turn, once around it.

    >>> print(FirstWall("PQ", ("1", "2", "3"), (Edge("P", ">"), Edge("Q"), Edge("Q"))))
    wall PQ: 1 P> 2 Q 3 Q
    """

    label: str
    corners: tuple[str, ...]
    edges: tuple[Edge, ...]
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        around = (f"{corner} {edge}" for corner, edge in zip(self.corners, self.edges, strict=True))
        return f"wall {self.label}: {' '.join(around)}"


@dataclass(frozen=True)
class EdgeMarker:
    """Half of an edge to come, which divides a wall; it needs another half.

    >>> print(EdgeMarker("PQ", Edge("P"), ("PR", "QR"), "PQ"))
    [PQ: PR|P|QR, PQ]

    Attributes
    ----------
    wall
        The label of the walls that it divides; "*" for all.
    edge
        The label of the edge to come, and where it points: ">" away from the edge that is replaced, "<" toward it.
    daughters
        The labels of the two walls that the wall becomes: on the side of the beginning of the edge that is replaced, and on the
        side of its end.
    new_wall
        The label of the wall that the edge to come will bound, where it divides a cell.
    """

    wall: str
    edge: Edge
    daughters: tuple[str, str]
    new_wall: str
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        before, after = self.daughters
        return f"[{self.wall}: {before}|{self.edge}|{after}, {self.new_wall}]"

    @property
    def turned(self) -> EdgeMarker:
        """The same, where the edge that is replaced is read from its other end."""
        return replace(self, daughters=self.daughters[::-1])


EdgePart: TypeAlias = Edge | EdgeMarker
"""A part of the successor of an edge."""


@dataclass(frozen=True)
class CellworkProduction:
    """What an edge becomes in one step: edges one after another, with markers between them.

    >>> print(CellworkProduction(Edge("Q"), (), (Edge("P"),)))
    Q: * -> P

    Attributes
    ----------
    predecessor
        The edge.
    walls
        The labels of walls to all of which the edge must belong; none for any edge.
    successor
        Edges and markers.
    """

    predecessor: Edge
    walls: tuple[str, ...]
    successor: tuple[EdgePart, ...]
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return f"{self.predecessor}: {' '.join(self.walls) or ANY} -> {' '.join(map(str, self.successor))}"

    @property
    def edges(self) -> tuple[Edge, ...]:
        """The edges of the successor."""
        return tuple(part for part in self.successor if isinstance(part, Edge))

    @property
    def marked(self) -> list[tuple[EdgeMarker, ...]]:
        """The markers behind each edge of the successor but the last."""
        found: list[tuple[EdgeMarker, ...]] = []
        for marked, group in groupby(self.successor, lambda part: isinstance(part, EdgeMarker)):
            some = [*group]
            if marked:
                found[-1] = tuple(part for part in some if isinstance(part, EdgeMarker))
            else:
                found += [()] * len(some)
        return found[:-1]

    @property
    def markers(self) -> Iterator[EdgeMarker]:
        """The markers of the successor."""
        return (part for part in self.successor if isinstance(part, EdgeMarker))

    @property
    def turned(self) -> CellworkProduction:
        """The same production, read from the other end of the edge."""
        return replace(self, successor=tuple(part.turned for part in reversed(self.successor)))


@dataclass(frozen=True)
class WallProduction:
    """What a wall becomes in a step in which it is not divided.

    >>> print(WallProduction("QR", "PQ"))
    wall QR -> PQ
    """

    predecessor: str
    successor: str
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return f"wall {self.predecessor} -> {self.successor}"


@dataclass(frozen=True)
class CellworkSystem:
    """A cellwork L-system: the corners and walls of the first cell, and productions.

    Attributes
    ----------
    corners, walls
        The first cell: its walls form a closed surface.
    productions
        What edges become: of those that fit an edge the first is applied; an edge without one stays as it is.
    wall_productions
        What undivided walls become, at most one for a label; a wall without one keeps its label.
    steps
        The number of steps that the model sets, or None.
    source, notes
        The text it was read from, and notes on how it was read. Equality ignores them.
    """

    corners: tuple[Corner, ...]
    walls: tuple[FirstWall, ...]
    productions: tuple[CellworkProduction, ...] = ()
    wall_productions: tuple[WallProduction, ...] = ()
    steps: int | None = None
    source: str = field(default="", compare=False, repr=False)
    notes: tuple[str, ...] = field(default=(), compare=False, repr=False)

    def __str__(self) -> str:
        steps = () if self.steps is None else (f"steps: {self.steps}",)
        return "\n".join(
            (
                f"cellwork: {' '.join(map(str, self.corners))}",
                *steps,
                *map(str, self.walls),
                *map(str, self.productions),
                *map(str, self.wall_productions),
            )
        )

    def __repr__(self) -> str:
        return abridged_text(str(self))

    @property
    def axiom(self) -> tuple[Edge, ...]:
        """The edges of the first cell, each once."""
        found = {
            frozenset(ends): edge
            for wall in self.walls
            for *ends, edge in zip(wall.corners, (*wall.corners[1:], wall.corners[0]), wall.edges, strict=True)
        }
        return tuple(found.values())

    @property
    def markers(self) -> Iterator[EdgeMarker]:
        """The markers of all productions."""
        for production in self.productions:
            yield from production.markers
