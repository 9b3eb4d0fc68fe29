"""Does a cellwork system that can be read also make sense? The first cell is closed, neutral edges are symmetric."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from lsys_kit.notation.analysis.edge_checks import occurring_edges, unpaired_edges
from lsys_kit.notation.analysis.problems import Problem, problem
from lsys_kit.notation.model.cellworks import ANY, CellworkProduction, CellworkSystem, EdgeMarker, FirstWall
from lsys_kit.notation.model.maps import Edge

LEAST_CORNERS = 3
"""A wall with fewer straight edges has no inside."""


def check_cellwork(system: CellworkSystem) -> None:
    """The first cell is closed, and each edge has productions that can be applied from either of its ends."""
    _check_corners(system)
    _check_surface(system)
    _check_wall_productions(system)
    met: set[tuple[Edge, frozenset[str]]] = set()
    for production in system.productions:
        edge, key = production.predecessor, (production.predecessor, frozenset(production.walls))
        if edge.arrow == "<":
            raise problem("edge against its direction", edge.at, turned=edge.turned)
        if key in met:
            raise problem("second production of edge", edge.at, edge=edge)
        met.add(key)
        _check_successor(production)


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


def edges_of(wall: FirstWall) -> Iterator[tuple[str, str, Edge]]:
    """The edges of a wall of the first cell with the corners at their ends, in the direction in which they are listed."""
    yield from zip(wall.corners, (*wall.corners[1:], wall.corners[0]), wall.edges, strict=True)


def _check_surface(system: CellworkSystem) -> None:
    """The walls form one closed surface without holes: each edge belongs to two walls, and Euler's number is 2."""
    walls_of: dict[frozenset[str], list[int]] = defaultdict(list)
    first: dict[frozenset[str], tuple[str, Edge]] = {}
    for number, wall in enumerate(system.walls):
        for one, other, edge in edges_of(wall):
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
    """The walls that are reached from the first one across edges."""
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


def _check_successor(production: CellworkProduction) -> None:
    """Something is left, markers stand between edges, and a neutral edge becomes the same from both ends."""
    parts, edge = production.successor, production.predecessor
    if not production.edges:
        raise problem("edge erased", edge.at, edge=edge)
    end = next((part for part in (parts[0], parts[-1]) if isinstance(part, EdgeMarker)), None)
    if end is not None:
        raise problem("marker at end", end.at)
    if not edge.arrow and _by_walls(production) != _by_walls(production.turned):
        raise problem(
            "neutral edge not symmetric", edge.at, edge=edge, backwards=" ".join(map(str, production.turned.successor))
        )


def _by_walls(production: CellworkProduction) -> tuple[tuple[Edge, ...], list[dict[str, list[EdgeMarker]]]]:
    """The edges of a successor, and the markers at each vertex by the walls that they divide, whose order means nothing."""
    places = []
    for markers in production.marked:
        found: dict[str, list[EdgeMarker]] = {}
        for marker in markers:
            found.setdefault(marker.wall, []).append(marker)
        places.append(found)
    return production.edges, places


def unused_parts(system: CellworkSystem) -> Iterator[Problem]:
    """Productions of edges that never occur, and markers that never find another half."""
    occurring = occurring_edges((edge for wall in system.walls for edge in wall.edges), system.productions)
    for production in system.productions:
        if production.predecessor not in occurring:
            yield Problem("edge never occurs", production.at, {"production": production, "edge": production.predecessor})
    walls = {
        ANY,
        *(wall.label for wall in system.walls),
        *(made.successor for made in system.wall_productions),
        *(label for marker in system.markers for label in (*marker.daughters, marker.new_wall)),
    }
    for marker in system.markers:
        if marker.wall not in walls:
            yield Problem("wall never occurs", marker.at, {"marker": marker, "wall": marker.wall})
    for edge in unpaired_edges(marker.edge for marker in system.markers):
        yield Problem("marker without partner", None, {"marker": edge, "partner": edge.turned})
