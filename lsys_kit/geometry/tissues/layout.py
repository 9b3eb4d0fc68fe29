"""Where cells lie: the first cell is where its system says, each new vertex a point of its edge; then all vertices relax.

The first cell of a map is a regular polygon. On a sphere walls are arcs of great circles, and vertices stay on the sphere, of
radius 1, as they relax (The Algorithmic Beauty of Plants, section 7.4.3).
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import islice
from typing import TypeAlias, TypeVar

from lsys_kit.arrays import np
from lsys_kit.budget import Task, counted
from lsys_kit.derivation.tissues.cellworks import Cellwork
from lsys_kit.derivation.tissues.development import CellworkDevelopment, Development
from lsys_kit.derivation.tissues.edges import CellEdge
from lsys_kit.derivation.tissues.maps import Map, kinds_of_cells
from lsys_kit.errors import ModelValueError, last_reached
from lsys_kit.geometry.scene import OWN, Floats, Integers, Polygons, Scene, Segments, no_discs
from lsys_kit.geometry.tissues.equilibrium import Equilibrium, equilibrium
from lsys_kit.geometry.tissues.relaxation import (
    DEFAULT_FORCES,
    SPACE_FORCES,
    SPHERE_FORCES,
    Forces,
    SolidTissue,
    SphereTissue,
    Tissue,
    relax,
)

FIRST_WALL, FIRST_EDGE = 0.28, 2.0
"""The length of a wall of the first cell of a map before relaxation, and the mean length of an edge of that of a cellwork."""
Placed: TypeAlias = tuple[Floats, Mapping[int, float]]
"""The positions of the vertices of a map on a sphere, and the longitudes of its walls from pole to pole, by their numbers."""
POLES = frozenset((0, 1))
"""The vertices with which a sphere begins, the upper one and the lower one."""
C = TypeVar("C", Map, Cellwork)
R = TypeVar("R", bound=tuple[object, ...])


def _step_by_step(
    steps: Iterable[C], start: Callable[[C, Floats | None], Floats], at_rest: Callable[[C, Floats], R]
) -> Iterator[R]:
    """For each step its cells at rest, given the initial positions of its vertices, which follow from those of the step before
    at rest, if there is one. An error has the positions of the steps before in `partial`.
    """
    layout = Task()
    finished: list[Floats] = []
    for step, found in enumerate(steps):
        with layout, Task(f"The cells of step {step} did not come to rest"):
            points = start(found, finished[-1] if finished else None)
            try:
                reached = at_rest(found, points)
            except ModelValueError as error:
                error.partial = finished
                said = f"This was step {step}. {last_reached(step)}".strip()
                raise error.with_hint(f"{said} {error.hint}") from None
        finished.append(reached[0])  # type: ignore[arg-type]
        yield reached


def _last(way: Iterator[Floats]) -> Floats:
    return deque(counted(way, 1), maxlen=1)[0]


# Maps in the plane


def place_maps(maps: Iterable[Map], forces: Forces = DEFAULT_FORCES) -> Iterator[Floats]:
    """The positions of the vertices of each map at equilibrium.

    >>> from lsys_kit import derive, read_map
    >>> square, divided = place_maps(derive(read_map("map: ABAB\\nA -> B[-A][+A]B\\nB -> A"), 1))
    >>> print(np.ptp(square, axis=0).round(2), np.ptp(divided, axis=0).round(2))
    [0.28 0.28] [0.56 0.36]
    """
    return (reached.points for reached in equilibria(maps, forces))


def equilibria(maps: Iterable[Map], forces: Forces = DEFAULT_FORCES) -> Iterator[Equilibrium]:
    """Where the relaxation of each map ends, whose vertices start from the map before it. The first wall of the first cell lies
    on top and leads to the right.

    >>> from lsys_kit import derive, read_map
    >>> maps = derive(read_map("map: ABAB\\nA -> B[-A][+A]B\\nB -> A"), 1)
    >>> [(found.iterations, found.settled) for found in equilibria(maps)]
    [(70, True), (309, True)]
    """
    return _step_by_step(maps, initial_vertices, lambda found, points: equilibrium(points, tissue(found), forces))


def relaxation_steps(maps: Sequence[Map], iterations: Sequence[int], forces: Forces = DEFAULT_FORCES) -> Iterator[Floats]:
    """The positions of the vertices of the last map after increasing numbers of iterations from the map before at equilibrium.

    >>> from lsys_kit import derive, read_map
    >>> maps = derive(read_map("map: ABAB\\nA -> B[-A][+A]B\\nB -> A"), 1)
    >>> [float(np.ptp(points[:, 0]).round(2)) for points in relaxation_steps(maps, [0, 50, 5_000])]
    [0.28, 0.64, 0.56]
    """
    *_, before = None, *place_maps(maps[:-1], forces)
    start, net = initial_vertices(maps[-1], before), tissue(maps[-1])
    end, way = equilibrium(start, net, forces), relax(start, net, forces)
    reached, points = 0, next(way)
    for iteration in iterations:
        points = (deque(counted(islice(way, iteration - reached), 1), maxlen=1) or [points])[0]
        reached = iteration
        yield end.points if iteration > end.iterations else points


def initial_vertices(found: Map, before: Floats | None) -> Floats:
    """The initial positions of the vertices of a map, given those of the map before it, if there is one."""
    return polygon(len(found.vertices)) if before is None else insert_vertices(found, before)


def polygon(corners: int) -> Floats:
    """The corners of a regular polygon, clockwise from the left end of its uppermost side."""
    angles = math.pi / 2 + math.pi / corners - 2 * math.pi / corners * np.arange(corners)
    return FIRST_WALL / 2 / math.sin(math.pi / corners) * np.column_stack([np.cos(angles), np.sin(angles)])


def insert_vertices(found: Map | Cellwork, points: Floats) -> Floats:
    """The positions of the vertices, given those of the step before: new ones divide their edges."""
    new = found.vertices[len(points) :]
    ends = np.array([vertex.between for vertex in new], dtype=np.int64).reshape(-1, 2)
    shares = np.array([float(vertex.share) for vertex in new]).reshape(-1, 1)
    return np.concatenate([points, points[ends[:, 0]] * (1 - shares) + points[ends[:, 1]] * shares])


def tissue(found: Map, kind: type[Tissue] = Tissue) -> Tissue:
    """The topology of a map."""
    return kind(*_topology(found.walls, map(found.corners, counted(found.cells))))


def _topology(edges: Iterable[CellEdge], rings: Iterable[list[int]]) -> tuple[Integers, Integers, Integers]:
    """The vertices at the ends of edges, those around rings, one ring after another, and where each ring starts and ends."""
    rings = [*rings]
    ends = np.array([(edge.start, edge.end) for edge in edges], dtype=np.int64)
    corners = np.array([corner for ring in rings for corner in ring], dtype=np.int64)
    return ends, corners, np.cumsum([0, *map(len, rings)])


def scenes(maps: Sequence[Map], places: Iterable[Floats]) -> Iterator[Scene]:
    """The walls of each map as segments, its cells as polygons.

    The state of a segment is the number of its label, that of a polygon the number of its kind: cells of one kind have the same
    walls around them. Both are numbered from 0 in the order of their first occurrence.
    """
    labels: dict[str, int] = {}
    for found, points, kinds in zip(maps, places, kinds_of_cells(maps), strict=True):
        net = tissue(found)
        drawn = np.array([labels.setdefault(wall.label, len(labels)) for wall in found.walls], dtype=np.int64)
        yield Scene(
            Segments(points[net.ends].reshape(-1, 4), np.zeros(len(drawn), np.int64), drawn),
            polygons=Polygons(points[net.corners], net.starts, np.array(kinds, dtype=np.int64), np.full(len(kinds), OWN)),
        )


# Maps on a sphere


def place_on_sphere(maps: Development, forces: Forces = SPHERE_FORCES) -> Iterator[Placed]:
    """For each map the positions of its vertices at equilibrium, with z towards the upper pole; and the longitudes of the walls
    from pole to pole, which no position of a vertex tells.
    """
    longitudes = {wall: 2 * np.pi * wall / len(maps[0].walls) for wall in range(len(maps[0].walls))}

    def start(found: Map, before: Floats | None) -> Floats:
        nonlocal longitudes
        if before is None:
            return np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
        points = _on_arcs(found, before, longitudes)
        longitudes = _left(found, len(before), longitudes)
        return points

    def at_rest(found: Map, points: Floats) -> Placed:
        return points if longitudes else _last(relax(points, tissue(found, SphereTissue), forces)), longitudes

    return _step_by_step(maps, start, at_rest)


def _on_arcs(found: Map, points: Floats, longitudes: dict[int, float]) -> Floats:
    """The positions of the vertices of a map, given those of the map before it: new ones divide their arcs."""
    new = [points]
    for vertex in found.vertices[len(points) :]:
        start, end = vertex.between or (0, 0)
        if vertex.wall in longitudes:
            share = float(vertex.share) if start == 0 else 1 - float(vertex.share)
            new.append(meridian(longitudes[vertex.wall], np.array([share])))
        else:
            new.append(arc(points[start], points[end], np.array([float(vertex.share)])))
    return np.concatenate(new)


def _left(found: Map, before: int, longitudes: dict[int, float]) -> dict[int, float]:
    """The longitudes of the walls that still lead from pole to pole; they follow one another as before."""
    divided = {vertex.wall for vertex in found.vertices[before:]}
    kept = [longitude for wall, longitude in longitudes.items() if wall not in divided]
    return dict(zip((number for number, wall in enumerate(found.walls) if {wall.start, wall.end} == POLES), kept, strict=True))


def meridian(longitude: float, shares: Floats) -> Floats:
    """Points between the poles, given the shares of the way from the upper one."""
    down = np.pi * shares
    return np.column_stack([np.sin(down) * np.cos(longitude), np.sin(down) * np.sin(longitude), np.cos(down)])


def arc(start: Floats, end: Floats, shares: Floats) -> Floats:
    """Points of the arc of a great circle between two points, given the shares of the way."""
    angle = float(np.arccos(np.clip(start @ end, -1, 1)))
    if angle < 1e-9:
        return np.repeat(start[None], len(shares), axis=0)
    found: Floats = (np.sin((1 - shares) * angle)[:, None] * start + np.sin(shares * angle)[:, None] * end) / np.sin(angle)
    return found


# Cellworks


def place_cellworks(development: CellworkDevelopment, forces: Forces = SPACE_FORCES) -> Iterator[Floats]:
    """The positions of the vertices of each cellwork at equilibrium, with z upwards."""

    def start(found: Cellwork, before: Floats | None) -> Floats:
        return _first_places(development) if before is None else insert_vertices(found, before)

    placed = _step_by_step(development, start, lambda found, points: (_last(relax(points, solid_tissue(found), forces)),))
    return (points for (points,) in placed)


def _first_places(development: CellworkDevelopment) -> Floats:
    """The corners of the first cell around its middle, with edges of a mean length that is set."""
    places = np.array([[float(each) for each in corner.place] for corner in development.system.corners])
    ends = solid_tissue(development[0]).ends
    mean = float(np.linalg.norm(places[ends[:, 1]] - places[ends[:, 0]], axis=1).mean())
    if not 0 < mean < np.inf:
        raise ModelValueError("The corners of the first cell all lie in one place", hint="Give them places of their own.")
    found: Floats = (places - places.mean(axis=0)) * (FIRST_EDGE / mean)
    return found


def solid_tissue(found: Cellwork) -> SolidTissue:
    """The topology of a cellwork."""
    cells, walls, forward = np.array([*found.cells_at()], dtype=np.int64).T
    return SolidTissue(*_topology(found.edges, map(found.corners, counted(found.walls))), cells, walls, 2 * forward - 1)


def cellwork_scene(
    found: Cellwork, points: Floats, numbers: Mapping[str, int], lit: Collection[int], dim: int, apart: float = 0.0
) -> Scene:
    """The outer walls of the cells that are lit as polygons, whose states are the numbers of their labels, and the edges of all
    others as segments, whose state is `dim`.

    Cells may stand apart: each then has all its walls, and is moved by this part of its way from the middle of those lit.
    """
    around: dict[int, list[tuple[int, bool]]] = {}
    for cell, wall, forward in found.cells_at():
        if cell in lit:
            around.setdefault(wall, []).append((cell, forward))
    seen = [(wall, *side) for wall, sides in around.items() if apart or len(sides) == 1 for side in sides]
    shown = {edge for wall in around for edge, _ in found.walls[wall].sides}
    moved = _moved_apart(found, points, lit, apart) if apart else {}
    rows = [
        points[found.corners(found.walls[wall])][:: 1 if forward else -1] + moved.get(cell, 0) for wall, cell, forward in seen
    ]
    rest = [(edge.start, edge.end) for number, edge in enumerate(found.edges) if number not in shown]
    places = points[np.array(rest, dtype=np.int64).reshape(-1, 2)].reshape(-1, 6)
    return Scene(
        Segments(places, np.full(len(places), 3), np.full(len(places), dim)),
        polygons=Polygons(
            np.concatenate(rows) if rows else np.empty((0, 3)),
            np.cumsum([0, *map(len, rows)]),
            np.array([numbers[found.walls[wall].label] for wall, *_ in seen], dtype=np.int64),
            np.full(len(rows), OWN),
        ),
        discs=no_discs(3),
    )


def _moved_apart(found: Cellwork, points: Floats, lit: Collection[int], apart: float) -> dict[int, Floats]:
    """By how much cells are moved away from the middle of them all, each by a part of its own way from there."""
    corners: dict[int, set[int]] = {cell: set() for cell in sorted(lit)}
    for cell, wall, _ in found.cells_at():
        if cell in corners:
            corners[cell].update(found.corners(found.walls[wall]))
    middles = {cell: points[sorted(each)].mean(axis=0) for cell, each in corners.items()}
    middle = np.mean([*middles.values()], axis=0)
    return {cell: apart * (each - middle) for cell, each in middles.items()}
