"""The first cell of a cellwork: its edges and walls, and which side of each wall is outside."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from lsys_kit.derivation.cellworks.cellwork import CellEdge, CellWall, Cellwork, EdgeSide, WallSide
from lsys_kit.derivation.maps.map import Vertex
from lsys_kit.notation.model.cellworks import CellworkSystem


def first_cellwork(system: CellworkSystem) -> Cellwork:
    """The first cell of a cellwork system, with its walls as they are listed."""
    numbers = {corner.name: number for number, corner in enumerate(system.corners)}
    edges: list[CellEdge] = []
    known: dict[frozenset[int], int] = {}
    walls = []
    for wall in system.walls:
        corners = [numbers[name] for name in wall.corners]
        sides = []
        for a, b, edge in zip(corners, (*corners[1:], corners[0]), wall.edges, strict=True):
            number = known.setdefault(frozenset((a, b)), len(edges))
            if number == len(edges):
                edges.append(CellEdge(edge.label, *((b, a) if edge.arrow == "<" else (a, b)), bool(edge.arrow)))
            sides.append(EdgeSide(number, edges[number].start == a))
        walls.append(CellWall(wall.label, tuple(sides)))
    found = Cellwork((Vertex(),) * len(numbers), tuple(edges), tuple(walls), ())
    return Cellwork(found.vertices, found.edges, found.walls, (_outward(found, [corner.place for corner in system.corners]),))


def _outward(found: Cellwork, places: Sequence[tuple[Fraction, Fraction, Fraction]]) -> tuple[WallSide, ...]:
    """The walls of a single cell, each with the direction of its edges: counter-clockwise, as seen from outside."""
    forward = _agreeing(found.walls)
    volume = Fraction(0)
    for wall, along in zip(found.walls, forward, strict=True):
        first, *others = (places[corner] for corner in found.corners(wall))
        for one, other in pairwise(others):
            volume += _determinant(first, one, other) * (1 if along else -1)
    return tuple(WallSide(number, along == (volume >= 0)) for number, along in enumerate(forward))


def _agreeing(walls: Sequence[CellWall]) -> list[bool]:
    """For each wall of a closed surface whether its edges run as those of the first wall: neighbours run against each other."""
    at: dict[int, list[tuple[int, bool]]] = {}
    for number, wall in enumerate(walls):
        for edge, forward in wall.sides:
            at.setdefault(edge, []).append((number, forward))
    agreeing, waiting = {0: True}, [0]
    while waiting:
        number = waiting.pop()
        for edge, forward in walls[number].sides:
            for other, its in at[edge]:
                if other not in agreeing:
                    agreeing[other] = agreeing[number] == (forward != its)
                    waiting.append(other)
    return [agreeing[number] for number in range(len(walls))]


def _determinant(a: Sequence[Fraction], b: Sequence[Fraction], c: Sequence[Fraction]) -> Fraction:
    """Six times the volume of a tetrahedron with a corner at the origin."""
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
