"""The layout of maps: the first cell is a regular polygon, each new vertex a point of its wall; then all vertices relax."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

import numpy as np

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.maps.map import Map, cell_words
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import Floats, Polygons, Scene, Segments
from lsys_kit.geometry.tissues.equilibrium import Equilibrium, equilibrium
from lsys_kit.geometry.tissues.relaxation import DEFAULT_FORCES, Forces, Tissue, relax, with_finished
from lsys_kit.notation.model.maps import Edge

FIRST_WALL = 0.28
"""The length of a wall of the first cell before relaxation."""


def place_maps(maps: Iterable[Map], forces: Forces = DEFAULT_FORCES) -> Iterator[Floats]:
    """The positions of the vertices of each map at equilibrium, as `equilibria` finds them.

    Examples
    --------
    >>> from lsys_kit.derivation.maps.development import develop
    >>> from lsys_kit.notation.dialects.map.dialect import read_map
    >>> square, divided = place_maps(develop(read_map("map: ABAB\\nA -> B[-A][+A]B\\nB -> A"), 1))
    >>> print(np.ptp(square, axis=0).round(2), np.ptp(divided, axis=0).round(2))
    [0.28 0.28] [0.56 0.36]
    """
    return (reached.points for reached in equilibria(maps, forces))


def equilibria(maps: Iterable[Map], forces: Forces = DEFAULT_FORCES) -> Iterator[Equilibrium]:
    """Where the relaxation of each map ends, whose vertices start from the map before it.

    Parameters
    ----------
    maps
        The maps of steps 0, 1, 2, ...
    forces
        The forces of cells and walls.

    Returns
    -------
    iterator of records
        For each map x and y of its vertices, shape (vertices, 2), after how many iterations it was there, and whether it is at
        rest. The first wall of the first cell lies on top and leads to the right.

    Raises
    ------
    ModelLimitError
        The relaxation takes too long.
    ModelValueError
        It blows up; the positions of the steps before are in `partial`.

    Examples
    --------
    >>> from lsys_kit.derivation.maps.development import develop
    >>> from lsys_kit.notation.dialects.map.dialect import read_map
    >>> maps = develop(read_map("map: ABAB\\nA -> B[-A][+A]B\\nB -> A"), 1)
    >>> [(found.iterations, found.settled) for found in equilibria(maps)]
    [(70, True), (309, True)]
    """
    layout = Task()
    finished: list[Floats] = []
    for step, found in enumerate(maps):
        with layout, Task(f"The cells of step {step} did not come to rest"):
            start = initial_vertices(found, finished[-1] if finished else None)
            try:
                reached = equilibrium(start, tissue(found), forces)
            except ModelValueError as error:
                raise with_finished(error, finished) from None
        finished.append(reached.points)
        yield reached


def relaxation_steps(maps: Sequence[Map], iterations: Sequence[int], forces: Forces = DEFAULT_FORCES) -> Iterator[Floats]:
    """The positions of the vertices of the last map after increasing numbers of iterations from the map before at equilibrium.

    >>> from lsys_kit.derivation.maps.development import develop
    >>> from lsys_kit.notation.dialects.map.dialect import read_map
    >>> maps = develop(read_map("map: ABAB\\nA -> B[-A][+A]B\\nB -> A"), 1)
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


def insert_vertices(found: Map, points: Floats) -> Floats:
    """The positions of the vertices of a map, given those of the map before it: new ones divide their walls."""
    new = found.vertices[len(points) :]
    ends = np.array([vertex.between for vertex in new], dtype=np.int64).reshape(-1, 2)
    shares = np.array([float(vertex.share) for vertex in new]).reshape(-1, 1)
    return np.concatenate([points, points[ends[:, 0]] * (1 - shares) + points[ends[:, 1]] * shares])


def tissue(found: Map) -> Tissue:
    """The topology of a map."""
    ends = np.array([(wall.start, wall.end) for wall in found.walls], dtype=np.int64)
    corners = [corner for cell in counted(found.cells) for corner in found.corners(cell)]
    return Tissue(ends, np.array(corners, dtype=np.int64), np.cumsum([0, *map(len, found.cells)]))


def scenes(maps: Iterable[Map], places: Iterable[Floats]) -> Iterator[Scene]:
    """The walls of each map as segments, its cells as polygons.

    The state of a segment is the number of its label, that of a polygon the number of its kind: cells of one kind have the same
    walls around them. Both are numbered from 0 in the order of their first occurrence.
    """
    labels: dict[str, int] = {}
    kinds: dict[tuple[Edge, ...], int] = {}
    for found, points in zip(maps, places, strict=True):
        net = tissue(found)
        drawn = np.array([labels.setdefault(wall.label, len(labels)) for wall in found.walls], dtype=np.int64)
        states = np.array([kinds.setdefault(word, len(kinds)) for word in cell_words(found)], dtype=np.int64)
        own = np.full(len(states), -1)
        yield Scene(
            Segments(points[net.ends].reshape(-1, 4), np.zeros(len(drawn), np.int64), drawn),
            polygons=Polygons(points[net.corners], net.starts, states, own),
        )
