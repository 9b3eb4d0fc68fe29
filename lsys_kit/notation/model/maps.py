"""The records of a map L-system: walls, markers, productions (The Algorithmic Beauty of Plants, section 7.1.2).

A map is cells side by side. What is rewritten are their walls; markers on the new walls say where a cell is divided. `str` of
a map system is its text, which reads back as the same system.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from lsys_kit.notation.model.expressions import TextSpan
from lsys_kit.notation.model.modules import abridged_text

TURNED = {"": "", ">": "<", "<": ">"}
"""The arrow of a wall, as seen from its other end."""
OTHER_SIDE = {"+": "-", "-": "+"}
"""The side of a wall, seen from its other end."""
LEFT, RIGHT = "+", "-"
"""The sides of a wall, seen in its direction."""


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


SuccessorPart: TypeAlias = Edge | Marker
"""A part of a successor."""


@dataclass(frozen=True)
class EdgeProduction:
    """What a wall becomes in one step: walls one after another, with markers between them.

    >>> print(EdgeProduction(Edge("A"), (Edge("B"), Marker("-", Edge("A")), Marker("+", Edge("A")), Edge("B"))))
    A -> B[-A][+A]B
    """

    predecessor: Edge
    successor: tuple[SuccessorPart, ...]
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return f"{self.predecessor} -> {''.join(map(str, self.successor))}"

    @property
    def walls(self) -> tuple[Edge, ...]:
        """The walls of the successor."""
        return tuple(part for part in self.successor if isinstance(part, Edge))

    @property
    def markers(self) -> tuple[Marker, ...]:
        """The markers of the successor."""
        return tuple(part for part in self.successor if isinstance(part, Marker))

    @property
    def turned(self) -> tuple[SuccessorPart, ...]:
        """The successor, read from the other end."""
        return tuple(
            part.turned if isinstance(part, Edge) else replace(part, side=OTHER_SIDE[part.side])
            for part in reversed(self.successor)
        )


@dataclass(frozen=True)
class MapSystem:
    """A map L-system: the walls of the first cell, or of the first cells of a sphere, and productions.

    Attributes
    ----------
    axiom
        The walls of the first cell, clockwise: the inside is to the right. Of a sphere the meridians from its upper pole to its
        lower one, from left to right as seen from outside; between any two that follow one another is a cell.
    productions
        At most one per wall; a wall without one stays as it is.
    steps
        The number of steps that the model sets, or None.
    sphere
        Whether the map covers a sphere.
    source, notes
        The text it was read from, and notes on how it was read. Equality ignores them.
    """

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

    def __repr__(self) -> str:
        return abridged_text(str(self))

    @property
    def markers(self) -> Iterator[Marker]:
        """The markers of all productions."""
        for production in self.productions:
            yield from production.markers
