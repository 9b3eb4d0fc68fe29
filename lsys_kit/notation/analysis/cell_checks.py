"""Does a system of cells that can be read also make sense? Cells are closed, and neutral edges become the same from both ends.

A map has walls where a cellwork has edges; each dialect words the problems for itself.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterator

from lsys_kit.notation.analysis.problems import Problem, problem
from lsys_kit.notation.model.cells import (
    ANY,
    LEFT,
    RIGHT,
    CellSystem,
    CellworkSystem,
    Edge,
    EdgeMarker,
    EdgeRule,
    M,
    MapSystem,
    Marker,
)
from lsys_kit.notation.model.expressions import TextSpan

LEAST_WALLS, LEAST_MERIDIANS, LEAST_CORNERS = 3, 2, 3
"""A cell, or a wall in space, with fewer straight sides has no inside; on a sphere walls are round, and two divide it."""


def check_map(system: MapSystem) -> None:
    """The first cell has an inside, and each wall has at most one production, which can be applied from either of its ends."""
    if len(system.axiom) < (LEAST_MERIDIANS if system.sphere else LEAST_WALLS):
        raise problem(
            "undivided sphere" if system.sphere else "cell without inside",
            _row_span(system.axiom),
            walls="1 wall" if len(system.axiom) == 1 else f"{len(system.axiom)} walls",
        )
    met: set[object] = set()
    for production in system.productions:
        _check_predecessor(production.predecessor, production.predecessor, met)
        _check_successor(production, _by_sides, _row_span(production.successor), "")


def check_cellwork(system: CellworkSystem) -> None:
    """The first cell is closed, and each edge has productions that can be applied from either of its ends."""
    _check_corners(system)
    _check_surface(system)
    _check_wall_productions(system)
    met: set[object] = set()
    for production in system.productions:
        _check_predecessor(production.predecessor, (production.predecessor, frozenset(production.walls)), met)
        _check_successor(production, _by_walls, production.predecessor.at, " ")


def _check_predecessor(edge: Edge, key: object, met: set[object]) -> None:
    """A production is written in the direction of its edge, and the only one for it; in a cellwork, in the same walls."""
    if edge.arrow == "<":
        raise problem("edge against its direction", edge.at, turned=edge.turned)
    if key in met:
        raise problem("second production of edge", edge.at, edge=edge)
    met.add(key)


def _check_successor(
    production: EdgeRule[M], at_vertex: Callable[[Collection[M]], object], place: TextSpan, blank: str
) -> None:
    """Something is left; markers stand between two edges, not at the ends, where they would touch others; and an edge without
    direction, which may be read from either end, becomes the same from both.

    `at_vertex` says what the markers at a vertex mean, in which order they may ever be written.
    """
    parts, edge, turned = production.successor, production.predecessor, production.turned
    if not production.edges:
        raise problem("edge erased", place, edge=edge)
    for part in (parts[0], parts[-1]):
        if not isinstance(part, Edge):
            raise problem("marker at end", part.at)
    meant, backwards = ((each.edges, [*map(at_vertex, each.marked)]) for each in (production, turned))
    if not edge.arrow and meant != backwards:
        raise problem("neutral edge not symmetric", place, edge=edge, backwards=blank.join(map(str, turned.successor)))


def _by_sides(markers: Collection[Marker]) -> list[list[Edge]]:
    """The markers on the left and on the right."""
    return [[marker.edge for marker in markers if marker.side == side] for side in (LEFT, RIGHT)]


def _by_walls(markers: Collection[EdgeMarker]) -> dict[str, list[EdgeMarker]]:
    found: dict[str, list[EdgeMarker]] = {}
    for marker in markers:
        found.setdefault(marker.wall, []).append(marker)
    return found


def _row_span(parts: tuple[Edge | Marker, ...]) -> TextSpan:
    first, last = parts[0].at, parts[-1].at
    return (first[0], last[1]) if first and last else None


def _check_corners(system: CellworkSystem) -> None:
    """Corners have numbers of their own; walls have three of them or more, each once."""
    met: set[str] = set()
    for corner in system.corners:
        if corner.name in met:
            raise problem("corner twice", corner.at, corner=corner.name)
        met.add(corner.name)
    for wall in system.walls:
        for place, name in enumerate(wall.corners):
            if name not in met:
                raise problem("unknown corner", wall.at, wall=wall.label, corner=name)
            if name in wall.corners[:place]:
                raise problem("corner twice in wall", wall.at, wall=wall.label, corner=name)
        if len(wall.corners) < LEAST_CORNERS:
            raise problem("wall without inside", wall.at, corners=len(wall.corners))


def _check_surface(system: CellworkSystem) -> None:
    """The walls form one closed surface without holes: each edge belongs to two walls, and Euler's number is 2."""
    walls_of: dict[frozenset[str], list[int]] = defaultdict(list)
    first: dict[frozenset[str], tuple[str, Edge]] = {}
    for number, wall in enumerate(system.walls):
        for one, other, edge in wall.sides:
            ends = frozenset((one, other))
            walls_of[ends].append(number)
            begun, known = first.setdefault(ends, (one, edge))
            here = edge if begun == one else edge.turned
            if here != known:
                end = other if begun == one else one
                raise problem("edge of two kinds", wall.at, edge=f"{begun}-{end}", one=known, other=here)
    for ends, walls in walls_of.items():
        if len(walls) != 2:
            raise problem(
                "first cell not closed",
                system.walls[walls[0]].at,
                edge="-".join(sorted(ends)),
                count=f"{len(walls)} wall" + "s" * (len(walls) > 1),
            )
    euler = len(system.corners) - len(walls_of) + len(system.walls)
    if euler != 2 or len(_reached(walls_of)) != len(system.walls):
        raise problem("first cell in parts", system.walls[0].at, euler=euler)


def _reached(walls_of: dict[frozenset[str], list[int]]) -> set[int]:
    neighbours: dict[int, list[int]] = defaultdict(list)
    for one, other in walls_of.values():
        neighbours[one].append(other)
        neighbours[other].append(one)
    reached, waiting = {0}, [0]
    while waiting:
        new = [wall for wall in neighbours[waiting.pop()] if wall not in reached]
        reached.update(new)
        waiting += new
    return reached


def _check_wall_productions(system: CellworkSystem) -> None:
    met: set[str] = set()
    for production in system.wall_productions:
        if production.predecessor in met:
            raise problem("second production of wall", production.at, wall=production.predecessor)
        met.add(production.predecessor)


def unused_parts(system: CellSystem) -> Iterator[Problem]:
    """Productions of edges that never occur, and markers that never find another half, or a wall.

    >>> from lsys_kit.notation.model.cells import EdgeProduction
    >>> rule = EdgeProduction(Edge("C"), (Edge("A"),))
    >>> [problem.code for problem in unused_parts(MapSystem((Edge("A"),) * 3, (rule,)))]
    ['edge never occurs']
    """
    occurring = _occurring_edges(system)
    for production in system.productions:
        if production.predecessor not in occurring:
            subject = {"production": production, "edge": production.predecessor}
            yield Problem("edge never occurs", production.predecessor.at, subject)
    if isinstance(system, CellworkSystem):
        walls = {ANY, *system.labels, *(made.successor for made in system.wall_productions)}
        for marker in system.markers:
            if marker.wall not in walls:
                yield Problem("wall never occurs", marker.at, {"marker": marker, "wall": marker.wall})
    edges = dict.fromkeys(marker.edge for marker in system.markers)
    for edge in edges:
        if edge.turned not in edges:
            yield Problem("marker without partner", None, {"marker": edge, "partner": edge.turned})


def _occurring_edges(system: CellSystem) -> set[Edge]:
    """The edges that can occur, each in its own direction."""
    made = defaultdict[Edge, list[Edge]](list)
    for production in system.productions:
        made[production.predecessor] += production.named
    occurring: set[Edge] = set()
    waiting: list[Edge] = [*system.axiom]
    while waiting:
        edge = waiting.pop()
        edge = edge.turned if edge.arrow == "<" else edge
        if edge not in occurring:
            occurring.add(edge)
            waiting += made[edge]
    return occurring
