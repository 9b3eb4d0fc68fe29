"""Meshes: the shapes of a scene as triangles in space, for file formats and viewers.

A stroke is a tapered prism with eight sides, closed at both ends, from the width of the stroke before it to its own. A polygon
stays flat, a sphere is a subdivided icosahedron, a cell is an ellipsoid. A scene in the plane is set upright.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from lsys_kit.budget import check_bytes, current
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.geometry.scene import OWN, SPHERE, Floats, Integers, Polygons, Scene, Segments
from lsys_kit.geometry.triangulation import triangulate

Singles: TypeAlias = NDArray[np.float32]
Numbers: TypeAlias = NDArray[np.uint32]

SIDES, ROUND = 8, 24
"""The number of sides of a stroke, and of corners of a disc."""
LARGEST_COORDINATE = 1e37
"""Greater coordinates cannot be computed in single precision."""
OWN_WIDTHS = (1.0, 0.7, 0.55, 0.4)
"""Relative widths of strokes by branch order, where the turtle has set no width; the last holds for all deeper branches."""
RELATIVE_WIDTH, LEAST_WIDTH, GREATEST_WIDTH, THINNEST = 0.14, 1 / 600, 1 / 60, 1 / 2000
"""The width of such a stroke relative to the median length of strokes; its bounds, and the least width of any stroke, relative
to the extent of the scene."""
MOST_CORNERS, TRIANGLE_BYTES = 10_000, 40
"""A polygon with more corners takes too long to triangulate. A triangle takes about so much, with its share of vertices."""
_SIDE, _CAPS = 2 * SIDES, 2 * (SIDES - 2)


@dataclass(frozen=True)
class Mesh:
    """Triangles in space: x grows to the right, z upwards, and y away from the viewer.

    Attributes
    ----------
    vertices, normals
        Shape (n, 3): each vertex, in the units of the model, and the normal there.
    triangles
        Shape (m, 3): the numbers of its vertices, counter-clockwise as seen from outside.
    states, colours
        Shape (n,): for each vertex the state of its module, and the number of its colour, or `OWN`.
    """

    vertices: Singles
    normals: Singles
    triangles: Numbers
    states: Integers
    colours: Integers

    @property
    def corners(self) -> tuple[Singles, Singles]:
        """The bounding box: the least and the greatest of each coordinate; zeros for an empty mesh."""
        some = self.vertices if len(self.vertices) else np.zeros((1, 3), np.float32)
        return some.min(axis=0), some.max(axis=0)


def mesh_of(scene: Scene) -> Mesh:
    """The triangles of a scene.

    Parameters
    ----------
    scene
        A scene in space or in the plane.

    Returns
    -------
    Mesh
        First the strokes, then polygons, discs, spheres and cells, each in the order of the scene. Strokes of length 0 are
        left out.

    Raises
    ------
    ModelLimitError
        There would be more triangles than the limit allows, or a polygon has too many corners.
    ModelValueError
        It is too large for the single precision of meshes.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.notation.read import read
    >>> mesh = mesh_of(scene_of(derive(read("axiom: F(10)[&(90)F(5)]@O(2)"), 0)))
    >>> mesh.vertices.shape, mesh.triangles.shape
    ((194, 3), (376, 3))
    """
    _check_triangles(scene)
    if not max(map(abs, (*scene.corners[0], *scene.corners[1]))) < LARGEST_COORDINATE:
        raise ModelValueError("This drawing is too large for a mesh", hint="Make its steps shorter.")
    discs, cells = scene.discs, scene.cells
    balls = discs.kinds == SPHERE
    centres, radii = _in_space(discs.centres), discs.radii
    lengths, breadths = cells.sizes.T / 2
    return _merged_meshes([
        _tubes(scene.segments, _extent(scene)),
        _faces(scene.polygons),
        _copies(_disc(), centres[~balls], radii[~balls, None], discs.states[~balls], discs.colours[~balls]),
        _copies(_ball(), centres[balls], radii[balls, None], discs.states[balls], discs.colours[balls]),
        _copies(_ball(), _in_space(cells.centres), np.stack([lengths, breadths, breadths], axis=1), cells.states,
                np.full(len(cells), OWN))])


def _check_triangles(scene: Scene) -> None:
    needed = (len(scene.segments) * (_SIDE + _CAPS) + len(scene.polygons.points)
              + len(_ball().triangles) * (len(scene.discs) + len(scene.cells)))
    if needed > current().triangles:
        raise ModelLimitError(f"The drawing would have {needed:,} triangles; the limit is {current().triangles:,}",
                              limit=current().triangles, needed=needed,
                              hint="Take fewer steps, or set limits(triangles=...).")
    check_bytes(needed * TRIANGLE_BYTES, lambda: "The mesh was not made")
    most = int(np.diff(scene.polygons.starts).max(initial=0))
    if most > MOST_CORNERS:
        raise ModelLimitError(f"A polygon has {most:,} corners; {MOST_CORNERS:,} can be triangulated",
                              limit=MOST_CORNERS, needed=most, hint="Take fewer steps.")


def _in_space(points: Floats) -> Floats:
    """Points in space: those of the plane are set upright."""
    return points if points.shape[1] == 3 else np.stack([points[:, 0], np.zeros(len(points)), points[:, 1]], axis=1)


def _extent(scene: Scene) -> float:
    """The extent of a scene in its widest direction."""
    least, greatest = scene.corners
    return float((greatest - least).max())


def _merged_meshes(meshes: Sequence[Mesh]) -> Mesh:
    firsts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    triangles = [mesh.triangles + np.uint32(first) for mesh, first in zip(meshes, firsts, strict=False)]
    joined = {name: np.concatenate([getattr(mesh, name) for mesh in meshes])
              for name in ("vertices", "normals", "states", "colours")}
    return Mesh(triangles=np.concatenate(triangles), **joined)


# Strokes


def _tubes(segments: Segments, reach: float) -> Mesh:
    """Strokes as closed prisms with round shading."""
    points = _in_space(segments.points).reshape(-1, 2, 3)
    lengths = np.linalg.norm(points[:, 1] - points[:, 0], axis=1)
    there = lengths > 0
    widths = _widths(segments, lengths, reach)
    radii = np.stack([_previous_widths(segments, widths, reach), widths], axis=1)[there] / 2
    ways = (points[:, 1] - points[:, 0])[there] / lengths[there, None]
    rings = _rings(ways)
    vertices = points[there][:, :, None] + radii[:, :, None, None] * rings[:, None]
    normals = np.broadcast_to(rings[:, None], vertices.shape)
    firsts = np.arange(len(ways), dtype=np.uint32) * np.uint32(_SIDE)
    colours = np.broadcast_to(segments.colours, len(segments))[there]
    return Mesh(vertices.reshape(-1, 3).astype(np.float32), normals.reshape(-1, 3).astype(np.float32),
                (firsts[:, None, None] + _prism()).reshape(-1, 3),
                np.repeat(segments.states[there], _SIDE), np.repeat(colours, _SIDE))


def _widths(segments: Segments, lengths: Floats, reach: float) -> Floats:
    """The width of each stroke: as set by the turtle, else by its branch order."""
    usual = float(np.median(lengths)) if len(lengths) else 0.0
    own = min(max(RELATIVE_WIDTH * usual, LEAST_WIDTH * reach), GREATEST_WIDTH * reach) * np.array(OWN_WIDTHS)
    by_order = own[np.minimum(segments.orders, len(OWN_WIDTHS) - 1)]
    return np.maximum(np.where(segments.widths == OWN, by_order, segments.widths), THINNEST * reach)


def _previous_widths(segments: Segments, widths: Floats, reach: float) -> Floats:
    """The width of each stroke at its start: that of the last stroke of its branch that ends there, else its own."""
    if len(segments) < 2 or (widths == widths[0]).all():
        return widths
    grid = np.rint(segments.points / (reach * 1e-9)).astype(np.int64).reshape(len(segments), 2, -1)
    places = np.concatenate([np.column_stack([grid[:, end], segments.orders]) for end in (0, 1)])
    numbers = np.unique(places, axis=0, return_inverse=True)[1].reshape(2, -1)
    width_at = np.full(len(places), np.nan)
    width_at[numbers[1]] = widths
    found = width_at[numbers[0]]
    return np.where(np.isnan(found), widths, found)


def _rings(ways: Floats) -> Floats:
    """For each direction the radial directions of the edges of its prism, shape (n, SIDES, 3)."""
    aside = np.zeros_like(ways)
    np.put_along_axis(aside, np.abs(ways).argmin(axis=1)[:, None], 1.0, axis=1)
    first = np.cross(ways, aside)
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(ways, first)
    cos, sin = _circle(SIDES)
    ring: Floats = first[:, None] * cos[:, None] + second[:, None] * sin[:, None]
    return ring


def _circle(count: int) -> tuple[Floats, Floats]:
    """Cosines and sines of angles all around, the same to the last bit on every machine."""
    angles: Floats = np.arange(count, dtype=np.float64) * (2 * np.pi / count)
    cos: Floats = np.cos(angles).round(12)
    sin: Floats = np.sin(angles).round(12)
    return cos, sin


@cache
def _prism() -> Numbers:
    """The triangles of a prism whose first ring of vertices is its start: sides, then both ends."""
    here = np.arange(SIDES)
    there = (here + 1) % SIDES
    sides = np.concatenate([np.stack([here, there, there + SIDES], axis=1),
                            np.stack([here, there + SIDES, here + SIDES], axis=1)])
    start = np.array([(0, k + 1, k) for k in range(1, SIDES - 1)])
    return np.concatenate([sides, start, start[:, [0, 2, 1]] + SIDES]).astype(np.uint32)


# Polygons


def _faces(polygons: Polygons) -> Mesh:
    """Polygons as they are, flat."""
    points, sizes = _in_space(polygons.points), np.diff(polygons.starts)
    facing = _facing(points, polygons.starts)
    triangles = [np.array(triangulate(points[first:last], way), np.int64).reshape(-1, 3) + first
                 for (first, last), way in zip(pairwise(polygons.starts.tolist()), facing, strict=True)]
    return Mesh(points.astype(np.float32), np.repeat(facing, sizes, axis=0).astype(np.float32),
                np.concatenate([np.empty((0, 3), np.int64), *triangles]).astype(np.uint32),
                np.repeat(polygons.states, sizes), np.repeat(polygons.colours, sizes))


def _facing(points: Floats, starts: Integers) -> Floats:
    """The unit normal of each polygon, by Newell's method."""
    if len(starts) < 2:
        return np.empty((0, 3))
    following = np.arange(1, len(points) + 1)
    following[starts[1:] - 1] = starts[:-1]
    around = points - np.repeat(points[starts[:-1]], np.diff(starts), axis=0)
    sums = np.add.reduceat(np.cross(around, around[following]), starts[:-1])
    lengths = np.linalg.norm(sums, axis=1)[:, None]
    return np.where(lengths > 0, sums / np.where(lengths > 0, lengths, 1.0), (0.0, -1.0, 0.0))


# Round shapes


def _copies(shape: Mesh, centres: Floats, sizes: Floats, states: Integers, colours: Integers) -> Mesh:
    """Copies of a shape about the origin, translated and scaled along the axes; sizes have the shape (n, 1) or (n, 3)."""
    count = len(shape.vertices)
    normals = shape.normals / np.where(sizes > 0, sizes, 1.0)[:, None]
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    firsts = np.arange(len(centres), dtype=np.uint32) * np.uint32(count)
    return Mesh((centres[:, None] + sizes[:, None] * shape.vertices).reshape(-1, 3).astype(np.float32),
                normals.reshape(-1, 3).astype(np.float32), (firsts[:, None, None] + shape.triangles).reshape(-1, 3),
                np.repeat(states, count), np.repeat(colours, count))


@cache
def _disc() -> Mesh:
    """A disc of radius 1 that faces the viewer."""
    cos, sin = _circle(ROUND)
    rim = np.stack([cos, np.zeros(ROUND), sin], axis=1)
    fan = [(ROUND, k, (k + 1) % ROUND) for k in range(ROUND)]
    return _shape_mesh(np.vstack([rim, np.zeros(3)]), np.tile([0.0, -1.0, 0.0], (ROUND + 1, 1)), fan)


@cache
def _ball() -> Mesh:
    """A sphere of radius 1: an icosahedron, subdivided twice."""
    golden = (1 + 5 ** 0.5) / 2
    corners = [np.roll(np.array([0.0, a, b * golden]), k) for k in range(3) for a in (1, -1) for b in (1, -1)]
    points = [corner / np.linalg.norm(corner) for corner in corners]
    edge = 1.1 * min(float(np.linalg.norm(points[0] - other)) for other in points[1:])
    faces = [(a, b, c) if np.linalg.det([points[a], points[b], points[c]]) > 0 else (a, c, b)
             for a in range(12) for b in range(a) for c in range(b)
             if max(np.linalg.norm(points[i] - points[j]) for i, j in ((a, b), (b, c), (c, a))) < edge]
    for _ in range(2):
        faces = _subdivided(faces, points)
    vertices = np.array(points)
    return _shape_mesh(vertices, vertices, faces)


def _subdivided(faces: Sequence[tuple[int, int, int]], points: list[Floats]) -> list[tuple[int, int, int]]:
    """Each face of a sphere divided into four; the midpoints of the edges become new points."""
    middles: dict[frozenset[int], int] = {}

    def middle(i: int, j: int) -> int:
        if frozenset((i, j)) not in middles:
            middles[frozenset((i, j))] = len(points)
            points.append((points[i] + points[j]) / np.linalg.norm(points[i] + points[j]))
        return middles[frozenset((i, j))]

    return [part for a, b, c in faces for ab, bc, ca in [(middle(a, b), middle(b, c), middle(c, a))]
            for part in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]


def _shape_mesh(vertices: Floats, normals: Floats, triangles: Sequence[tuple[int, int, int]]) -> Mesh:
    none = np.empty(0, np.int64)
    return Mesh(vertices.astype(np.float32), normals.astype(np.float32), np.array(triangles, np.uint32), none, none)
