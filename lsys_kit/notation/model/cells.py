"""The records of systems of cells: map L-systems, whose cells lie side by side in the plane or on a sphere, and cellwork
L-systems, whose cells do so in space (The Algorithmic Beauty of Plants, sections 7.1.2 and 7.5).

What is rewritten are edges: the walls of a map, and what bounds the walls of a cellwork. Markers between the new ones say
where a cell of a map, or a wall of a cellwork, is divided. Where new edges go once around a cell of a cellwork, a new wall
divides it. `str` of a system is its text, which reads back as the same system.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Self, TypeAlias, TypeVar

from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.expressions import TextSpan
from lsys_kit.notation.model.modules import abridged_text

TURNED = {"": "", ">": "<", "<": ">"}
"""The arrow of a wall, as seen from its other end."""
OTHER_SIDE = {"+": "-", "-": "+"}
"""The side of a wall, seen from its other end."""
LEFT, RIGHT = "+", "-"
"""The sides of a wall, seen in its direction."""
ANY = "*"
"""Stands for all walls of a cellwork."""


@dataclass(frozen=True)
class Edge:
    """The letter of a wall, and where the wall points.

    >>> print(Edge("A", ">"), Edge("B"))
    A> B

    Attributes
    ----------
    label
        The letter, perhaps with digits.
    arrow
        ">" along the direction in which one reads, "<" against it; empty for a neutral wall.
    """

    label: str
    arrow: str = ""
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return self.label + self.arrow

    @property
    def turned(self) -> Edge:
        """The same, read from the other end."""
        return replace(self, arrow=TURNED[self.arrow])


@dataclass(frozen=True)
class Marker:
    """Half of a wall to come, which divides the cell on one side; it needs another half.

    >>> print(Marker("-", Edge("A", ">")))
    [-A>]

    Attributes
    ----------
    side
        "+" to the left of the wall that is replaced, "-" to the right.
    edge
        The letter of the wall to come, and where it points: ">" away from the wall that is replaced, "<" toward it.
    """

    side: str
    edge: Edge
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return f"[{self.side}{self.edge}]"

    @property
    def short(self) -> str:
        """Its text."""
        return str(self)

    @property
    def turned(self) -> Marker:
        """The same, where the wall that is replaced is read from its other end."""
        return replace(self, side=OTHER_SIDE[self.side])

    @property
    def halves(self) -> tuple[object, object]:
        """Of what it is a half, and what the other half is of a marker that matches it."""
        return self.edge, self.edge.turned


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
    def short(self) -> str:
        """Its text without the walls to come."""
        return f"[{self.wall}: {self.edge}]"

    @property
    def turned(self) -> EdgeMarker:
        """The same, where the edge that is replaced is read from its other end."""
        return replace(self, daughters=self.daughters[::-1])

    @property
    def halves(self) -> tuple[object, object]:
        """Of what it is a half, and what the other half is of a marker that matches it."""
        return (self.edge, *self.daughters, self.new_wall), (self.edge.turned, *self.daughters[::-1], self.new_wall)


SuccessorPart: TypeAlias = Edge | Marker
"""A part of the successor of a wall of a map."""
AnyMarker: TypeAlias = Marker | EdgeMarker
M = TypeVar("M", bound=AnyMarker, covariant=True)


@dataclass(frozen=True)
class EdgeRule(Generic[M]):
    """What an edge becomes in one step: edges one after another, with markers between them."""

    predecessor: Edge
    successor: tuple[Edge | M, ...]

    @property
    def edges(self) -> tuple[Edge, ...]:
        """The edges of the successor."""
        return tuple(part for part in self.successor if isinstance(part, Edge))

    @property
    def markers(self) -> tuple[M, ...]:
        """The markers of the successor."""
        return tuple(part for part in self.successor if not isinstance(part, Edge))

    @property
    def named(self) -> tuple[Edge, ...]:
        """The edges of the successor and of its markers, in order."""
        return tuple(part if isinstance(part, Edge) else part.edge for part in self.successor)

    @property
    def marked(self) -> list[tuple[M, ...]]:
        """The markers behind each edge of the successor but the last."""
        found: list[tuple[M, ...]] = []
        for part in self.successor:
            if isinstance(part, Edge):
                found.append(())
            else:
                found[-1] += (part,)
        return found[:-1]

    @property
    def turned(self) -> Self:
        """The same production, read from the other end of the edge."""
        backwards: tuple[Any, ...] = tuple(part.turned for part in reversed(self.successor))
        return replace(self, successor=backwards)


@dataclass(frozen=True)
class EdgeProduction(EdgeRule[Marker]):
    """What a wall of a map becomes in one step: walls one after another, with markers between them.

    >>> print(EdgeProduction(Edge("A"), (Edge("B"), Marker("-", Edge("A")), Marker("+", Edge("A")), Edge("B"))))
    A -> B[-A][+A]B
    """

    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return f"{self.predecessor} -> {''.join(map(str, self.successor))}"


@dataclass(frozen=True)
class CellworkProduction(EdgeRule[EdgeMarker]):
    """What an edge of a cellwork becomes in one step.

    >>> print(CellworkProduction(Edge("Q"), (Edge("P"),)))
    Q: * -> P

    Attributes
    ----------
    walls
        The labels of walls to all of which the edge must belong; none for any edge.
    """

    walls: tuple[str, ...] = ()
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return f"{self.predecessor}: {' '.join(self.walls) or ANY} -> {' '.join(map(str, self.successor))}"


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

    @property
    def sides(self) -> Iterator[tuple[str, str, Edge]]:
        """The edges with the corners at their ends, in the direction in which they are listed."""
        yield from zip(self.corners, (*self.corners[1:], self.corners[0]), self.edges, strict=True)


class CellSystem:
    """A system of cells: a map L-system or a cellwork L-system.

    Attributes
    ----------
    notation
        The name of the notation in which it is written.
    steps
        The number of steps that the model sets, or None.
    source, notes
        The text it was read from, and notes on how it was read. Equality ignores them.
    """

    notation: ClassVar[str]
    productions: tuple[EdgeRule[AnyMarker], ...]
    steps: int | None
    source: str
    notes: tuple[str, ...]
    if TYPE_CHECKING:  # a field of maps

        @property
        def axiom(self) -> tuple[Edge, ...]: ...

    @property
    def kind(self) -> str:
        """What it is a system of."""
        return self.notation

    @property
    def markers(self) -> Iterator[Any]:
        """The markers of all productions."""
        for production in self.productions:
            yield from production.markers

    def __repr__(self) -> str:
        return abridged_text(str(self))


@dataclass(frozen=True, repr=False)
class MapSystem(CellSystem):
    """A map L-system: the walls of the first cell, or of the first cells of a sphere, and productions.

    Attributes
    ----------
    axiom
        The walls of the first cell, clockwise: the inside is to the right. Of a sphere the meridians from its upper pole to its
        lower one, from left to right as seen from outside; between any two that follow one another is a cell.
    productions
        At most one per wall; a wall without one stays as it is.
    sphere
        Whether the map covers a sphere.
    """

    notation = "map"

    axiom: tuple[Edge, ...]
    productions: tuple[EdgeProduction, ...]
    steps: int | None = None
    sphere: bool = False
    source: str = field(default="", compare=False, repr=False)
    notes: tuple[str, ...] = field(default=(), compare=False, repr=False)

    def __str__(self) -> str:
        steps = () if self.steps is None else (f"steps: {self.steps}",)
        first = f"{'sphere' if self.sphere else 'map'}: {''.join(map(str, self.axiom))}"
        return "\n".join((first, *steps, *map(str, self.productions)))

    @property
    def kind(self) -> str:
        """Whether its cells lie in the plane or on a sphere."""
        return "map on a sphere" if self.sphere else "map"


@dataclass(frozen=True, repr=False)
class CellworkSystem(CellSystem):
    """A cellwork L-system: the corners and walls of the first cell, and productions.

    Attributes
    ----------
    corners, walls
        The first cell: its walls form a closed surface.
    productions
        What edges become: of those that fit an edge the first is applied; an edge without one stays as it is.
    wall_productions
        What undivided walls become, at most one for a label; a wall without one keeps its label.
    """

    notation = "cellwork"

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

    @property
    def axiom(self) -> tuple[Edge, ...]:
        """The edges of the first cell, each once."""
        return tuple({frozenset(ends): edge for wall in self.walls for *ends, edge in wall.sides}.values())

    @property
    def labels(self) -> frozenset[str]:
        """The labels of the walls of the first cell, and of those that markers name."""
        made = (label for marker in self.markers for label in (*marker.daughters, marker.new_wall))
        return frozenset((*(wall.label for wall in self.walls), *made))
