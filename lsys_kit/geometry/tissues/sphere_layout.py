"""The layout of maps on a sphere: walls are arcs of great circles, and vertices stay on the sphere, of radius 1, as they relax
(The Algorithmic Beauty of Plants, section 7.4.3).

A new vertex divides its wall. Then walls pull like springs and cells push, as in the plane; what would lift a vertex from the
sphere is left out, and after each time step it is put back there.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeAlias

import numpy as np

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.maps.development import Development
from lsys_kit.derivation.maps.map import Map
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import Floats
from lsys_kit.geometry.tissues.cell_relaxation import cross
from lsys_kit.geometry.tissues.map_layout import tissue
from lsys_kit.geometry.tissues.relaxation import (
    AT_REST,
    LEAST_AREA,
    MOST_ITERATIONS,
    TIME_STEP,
    Forces,
    Tissue,
    check_bounds,
    summed_at_vertices,
    with_finished,
)

SPHERE_FORCES = Forces(rest=0.0, pressure=0.5)
"""The forces on a sphere, which does not grow: walls pull as if they were all too long, so that pressures decide."""
Placed: TypeAlias = tuple[Floats, Mapping[int, float]]
"""The positions of the vertices of a map on a sphere, and the longitudes of its walls from pole to pole, by their numbers."""
POLES = frozenset((0, 1))
"""The vertices with which a sphere begins, the upper one and the lower one."""


def place_on_sphere(maps: Development, forces: Forces = SPHERE_FORCES) -> Iterator[Placed]:
    """For each map the positions of its vertices at equilibrium, and the longitudes of the walls from pole to pole.

    Parameters
    ----------
    maps
        The maps of steps 0, 1, 2, ...
    forces
        The forces of cells and walls.

    Returns
    -------
    iterator of pairs
        x, y and z of the vertices, shape (vertices, 3), with z towards the upper pole; and for each wall from pole to pole its
        number and its longitude, which no position of a vertex tells.

    Raises
    ------
    ModelValueError
        The relaxation blows up; the positions of the steps before are in `partial`.
    """
    layout = Task()
    points = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
    longitudes = {wall: 2 * np.pi * wall / len(maps[0].walls) for wall in range(len(maps[0].walls))}
    finished: list[Floats] = []
    for step, found in enumerate(maps):
        with layout, Task(f"The cells of step {step} did not come to rest"):
            points = _with_new_vertices(found, points, longitudes)
            longitudes = _left(found, len(finished) and len(finished[-1]), longitudes) if step else longitudes
            try:
                points = points if longitudes else _relaxed(points, tissue(found), forces)
            except ModelValueError as error:
                raise with_finished(error, finished) from None
        finished.append(points)
        yield points, longitudes


def _with_new_vertices(found: Map, points: Floats, longitudes: dict[int, float]) -> Floats:
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


def _relaxed(points: Floats, net: Tissue, forces: Forces) -> Floats:
    """The positions of the vertices at rest on the sphere."""
    speeds = np.zeros_like(points)
    for _ in counted(range(MOST_ITERATIONS), 1):
        push = _force(points, net, forces) - forces.damping * speeds
        push -= (push * points).sum(axis=1)[:, None] * points
        speeds = speeds + push * TIME_STEP
        moved = check_bounds(points + speeds * TIME_STEP)
        moved = moved / np.linalg.norm(moved, axis=1)[:, None]
        farthest, points = np.abs(moved - points).max(), moved
        if farthest < AT_REST:
            break
    return points


def _force(points: Floats, net: Tissue, forces: Forces) -> Floats:
    """The force on each vertex, of the walls that end there and the cells around it."""
    first, second = net.ends.T
    along = points[second] - points[first]
    lengths = np.linalg.norm(along, axis=1)
    pull = along * (forces.stiffness * (1 - forces.rest / np.maximum(lengths, 1e-9)))[:, None]
    here, following = points[net.corners], points[net.following]
    room = np.linalg.norm(np.add.reduceat(cross(here, following), net.starts[:-1]), axis=1) / 2
    pressures = np.repeat(forces.pressure / np.maximum(room, LEAST_AREA), np.diff(net.starts))
    outward = cross((here + following) / 2, following - here) * (pressures / 2)[:, None]
    size = len(points)
    return (
        summed_at_vertices(first, pull, size)
        - summed_at_vertices(second, pull, size)
        + summed_at_vertices(net.corners, outward, size)
        + summed_at_vertices(net.following, outward, size)
    )
