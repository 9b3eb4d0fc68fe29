"""The solids of which meshes are made, of size 1 about the origin: the sides of a prism, a disc and a sphere."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.geometry.scene import Floats

if TYPE_CHECKING:
    from numpy.typing import NDArray

Singles: TypeAlias = "NDArray[np.float32]"
Numbers: TypeAlias = "NDArray[np.uint32]"

SIDES, THIN_SIDES, FEWEST_SIDES, ROUND = 8, 5, 3, 24
"""The number of sides of a stroke, of a thin one and of one that is hardly seen, and of corners of a disc."""


class Solid(NamedTuple):
    """Vertices, the normal at each, and triangles."""

    vertices: Singles
    normals: Singles
    triangles: Numbers


def circle(count: int) -> tuple[Floats, Floats]:
    """Cosines and sines of angles all around, the same to the last bit on every machine."""
    angles: Floats = np.arange(count, dtype=np.float64) * (2 * np.pi / count)
    cos: Floats = np.cos(angles).round(12)
    sin: Floats = np.sin(angles).round(12)
    return cos, sin


@cache
def prism_triangles(sides: int) -> tuple[Numbers, Numbers, Numbers]:
    """The triangles of a prism whose first ring of vertices is its start: its sides; its start; its end as if it were alone."""
    here = np.arange(sides)
    there = (here + 1) % sides
    walls = np.concatenate(
        [np.stack([here, there, there + sides], axis=1), np.stack([here, there + sides, here + sides], axis=1)]
    )
    start = np.array([(0, k + 1, k) for k in range(1, sides - 1)])
    return walls.astype(np.uint32), start.astype(np.uint32), start[:, [0, 2, 1]].astype(np.uint32)


@cache
def disc() -> Solid:
    cos, sin = circle(ROUND)
    rim = np.stack([cos, np.zeros(ROUND), sin], axis=1)
    fan = [(ROUND, k, (k + 1) % ROUND) for k in range(ROUND)]
    return _solid(np.vstack([rim, np.zeros(3)]), np.tile([0.0, -1.0, 0.0], (ROUND + 1, 1)), fan)


@cache
def ball(times: int = 2) -> Solid:
    """A sphere of radius 1: an icosahedron, subdivided so many times."""
    golden = (1 + 5**0.5) / 2
    corners = [np.roll(np.array([0.0, a, b * golden]), k) for k in range(3) for a in (1, -1) for b in (1, -1)]
    points = [corner / np.linalg.norm(corner) for corner in corners]
    edge = 1.1 * min(float(np.linalg.norm(points[0] - other)) for other in points[1:])
    faces = [
        (a, b, c) if np.linalg.det([points[a], points[b], points[c]]) > 0 else (a, c, b)
        for a in range(12)
        for b in range(a)
        for c in range(b)
        if max(np.linalg.norm(points[i] - points[j]) for i, j in ((a, b), (b, c), (c, a))) < edge
    ]
    for _ in range(times):
        faces = _subdivided(faces, points)
    vertices = np.array(points)
    return _solid(vertices, vertices, faces)


def _subdivided(faces: Sequence[tuple[int, int, int]], points: list[Floats]) -> list[tuple[int, int, int]]:
    """Each face of a sphere divided into four; the midpoints of the edges become new points."""
    middles: dict[frozenset[int], int] = {}

    def middle(i: int, j: int) -> int:
        if frozenset((i, j)) not in middles:
            middles[frozenset((i, j))] = len(points)
            points.append((points[i] + points[j]) / np.linalg.norm(points[i] + points[j]))
        return middles[frozenset((i, j))]

    return [
        part
        for a, b, c in faces
        for ab, bc, ca in [(middle(a, b), middle(b, c), middle(c, a))]
        for part in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    ]


def _solid(vertices: Floats, normals: Floats, triangles: Sequence[tuple[int, int, int]]) -> Solid:
    return Solid(vertices.astype(np.float32), normals.astype(np.float32), np.array(triangles, np.uint32))
