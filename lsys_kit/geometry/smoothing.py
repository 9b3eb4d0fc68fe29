"""Curved surfaces in finer faces, where few are drawn, so that one sees no corners in them.

Each face is bent towards the planes that touch the surface at its corners.

Source: T. Boubekeur and M. Alexa, "Phong tessellation", ACM Transactions on Graphics 27 (2008), number 141.
"""

from __future__ import annotations

from dataclasses import replace

from lsys_kit.arrays import np
from lsys_kit.geometry.scene import Floats, Integers, Polygons, Scene

FINEST, MOST_FACES = 4, 1_500
"""A face is divided into so many parts along each side at most, and so that there are not many more faces than this."""
BENT = 0.75
"""How far a face is bent: the share that Boubekeur and Alexa recommend."""
_SIDES = 4


def smoothed(scene: Scene) -> Scene:
    """A scene in space whose curved surfaces have finer faces, if there are few.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.turtle.space import trace_in_space
    >>> leaf = trace_in_space(derive(read("axiom: &~L"), 0)[0])
    >>> len(leaf.polygons), len(smoothed(leaf).polygons)
    (30, 480)
    """
    faces = int(scene.polygons.smooth.sum()) if len(scene.polygons) else 0
    parts = next((parts for parts in range(FINEST, 1, -1) if faces * parts**2 <= MOST_FACES), 1)
    return scene if parts == 1 or not faces else replace(scene, polygons=_divided(scene.polygons, parts))


def _divided(polygons: Polygons, parts: int) -> Polygons:
    """Polygons in which each face of a curved surface, with three or four corners, is divided; they come behind the others."""
    chosen = np.flatnonzero(polygons.smooth)
    others = np.flatnonzero(~polygons.smooth)
    corners = _four_corners(polygons.starts, chosen)
    points, normals = _grids(polygons.points[corners], polygons.normals[corners], parts)
    numbers = _cells(parts)
    kept = np.repeat(~polygons.smooth, np.diff(polygons.starts))
    found = points[:, numbers]
    sizes = [*np.diff(polygons.starts)[others], *np.full(found.shape[0] * found.shape[1], _SIDES)]
    which = np.concatenate([others, np.repeat(chosen, len(numbers))])
    return Polygons(
        np.concatenate([polygons.points[kept], found.reshape(-1, 3)]),
        np.cumsum([0, *sizes]),
        polygons.states[which],
        polygons.colours[which],
        np.concatenate([polygons.normals[kept], normals[:, numbers].reshape(-1, 3)]),
    )


def _four_corners(starts: Integers, chosen: Integers) -> Integers:
    """The numbers of the corners of faces, shape (n, 4); of a triangle the last stands twice."""
    first, last = starts[chosen, None], starts[chosen + 1, None] - 1
    found: Integers = np.minimum(first + np.arange(_SIDES), last)
    return found


def _grids(corners: Floats, normals: Floats, parts: int) -> tuple[Floats, Floats]:
    """The points of faces that are divided, shape (n, (parts + 1) ** 2, 3), and the unit normals there."""
    rows, columns = (places.ravel() for places in np.meshgrid(*[np.linspace(0, 1, parts + 1)] * 2, indexing="ij"))
    weights = np.stack([(1 - rows) * (1 - columns), rows * (1 - columns), rows * columns, (1 - rows) * columns], axis=1)
    flat: Floats = np.einsum("gi,nik->ngk", weights, corners)
    above = np.einsum("ngik,nik->ngi", flat[:, :, None] - corners[:, None], normals)
    bent: Floats = flat - BENT * np.einsum("gi,ngi,nik->ngk", weights, above, normals)
    between = np.einsum("gi,nik->ngk", weights, normals)
    lengths = np.linalg.norm(between, axis=2, keepdims=True)
    return bent, between / np.where(lengths > 0, lengths, 1.0)


def _cells(parts: int) -> Integers:
    first = (np.arange(parts)[:, None] * (parts + 1) + np.arange(parts)).ravel()[:, None]
    found: Integers = first + np.array([0, parts + 1, parts + 2, 1])
    return found
