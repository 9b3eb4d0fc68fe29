"""The layout of cellworks: the first cell as its model places it, each new vertex a point of its edge; then all relax."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterator, Mapping

import numpy as np

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.cellworks.cellwork import Cellwork
from lsys_kit.derivation.cellworks.development import CellworkDevelopment
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import OWN, Floats, Integers, Polygons, Scene, Segments, no_discs
from lsys_kit.geometry.tissues.cell_relaxation import SPACE_FORCES, SolidTissue, relax_in_space
from lsys_kit.geometry.tissues.relaxation import Forces, with_finished

FIRST_EDGE = 2.0
"""The mean length of the edges of the first cell before relaxation."""


def place_cellworks(development: CellworkDevelopment, forces: Forces = SPACE_FORCES) -> Iterator[Floats]:
    """The positions of the vertices of each cellwork at equilibrium.

    Parameters
    ----------
    development
        The cellworks of steps 0, 1, 2, ...
    forces
        The forces of cells and edges.

    Returns
    -------
    iterator of arrays
        For each cellwork x, y and z of its vertices, shape (vertices, 3), with z upwards.

    Raises
    ------
    ModelLimitError
        The relaxation takes too long.
    ModelValueError
        It does not come to rest: the positions grow beyond all bounds. The positions of the steps before are in `partial`.
    """
    layout = Task()
    finished: list[Floats] = []
    for step, found in enumerate(development):
        with layout, Task(f"The cells of step {step} did not come to rest"):
            start = _with_new_vertices(found, finished[-1]) if finished else _first_places(development)
            try:
                points = deque(counted(relax_in_space(start, solid_tissue(found), forces), 1), maxlen=1)[0]
            except ModelValueError as error:
                raise with_finished(error, finished) from None
        finished.append(points)
        yield points


def _first_places(development: CellworkDevelopment) -> Floats:
    """The corners of the first cell around its middle, with edges of a mean length that is set."""
    places = np.array([[float(each) for each in corner.place] for corner in development.system.corners])
    ends = solid_tissue(development[0]).ends
    mean = float(np.linalg.norm(places[ends[:, 1]] - places[ends[:, 0]], axis=1).mean())
    if not 0 < mean < np.inf:
        raise ModelValueError("The corners of the first cell all lie in one place", hint="Give them places of their own.")
    found: Floats = (places - places.mean(axis=0)) * (FIRST_EDGE / mean)
    return found


def _with_new_vertices(found: Cellwork, points: Floats) -> Floats:
    """The positions of the vertices of a cellwork, given those of the one before it: new ones divide their edges."""
    new = found.vertices[len(points) :]
    ends = np.array([vertex.between for vertex in new], dtype=np.int64).reshape(-1, 2)
    shares = np.array([float(vertex.share) for vertex in new]).reshape(-1, 1)
    return np.concatenate([points, points[ends[:, 0]] * (1 - shares) + points[ends[:, 1]] * shares])


def solid_tissue(found: Cellwork) -> SolidTissue:
    """The topology of a cellwork."""
    ends = np.array([(edge.start, edge.end) for edge in found.edges], dtype=np.int64)
    corners = np.array([corner for wall in counted(found.walls) for corner in found.corners(wall)], dtype=np.int64)
    cells, walls, forward = np.array([*found.cells_at()], dtype=np.int64).T
    starts = np.cumsum([0, *(len(wall.sides) for wall in found.walls)])
    return SolidTissue(ends, corners, starts, cells, walls, 2 * forward - 1)


def cellwork_scene(found: Cellwork, points: Floats, numbers: Mapping[str, int], lit: Collection[int], dim: int) -> Scene:
    """The outer walls of some cells as polygons, and the edges of all others as segments.

    Parameters
    ----------
    found, points
        The cellwork, and the positions of its vertices.
    numbers
        For each label of a wall the state of its polygons.
    lit
        The numbers of the cells whose walls are shown.
    dim
        The state of the segments.
    """
    around: dict[int, list[bool]] = {}
    for cell, wall, forward in found.cells_at():
        if cell in lit:
            around.setdefault(wall, []).append(forward)
    outer = {wall: forward[0] for wall, forward in around.items() if len(forward) == 1}
    shown = {side.edge for wall in around for side in found.walls[wall].sides}
    rows = [points[found.corners(found.walls[wall])][:: 1 if forward else -1] for wall, forward in outer.items()]
    rest = [(edge.start, edge.end) for number, edge in enumerate(found.edges) if number not in shown]
    return Scene(
        _segments(points, rest, dim),
        polygons=Polygons(
            np.concatenate(rows) if rows else np.empty((0, 3)),
            np.cumsum([0, *map(len, rows)]),
            _whole(numbers[found.walls[wall].label] for wall in outer),
            np.full(len(rows), OWN),
        ),
        discs=no_discs(3),
    )


def _segments(points: Floats, ends: list[tuple[int, int]], state: int) -> Segments:
    places = points[np.array(ends, dtype=np.int64).reshape(-1, 2)].reshape(-1, 6)
    return Segments(places, np.full(len(places), 3), np.full(len(places), state))


def _whole(numbers: Iterator[int]) -> Integers:
    return np.array([*numbers], dtype=np.int64)
