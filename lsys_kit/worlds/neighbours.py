"""What is near: the spheres that a ray passes through, the room that they leave, and how many are in the voxels above."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from lsys_kit.budget import check_budget
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import Floats, Integers
from lsys_kit.worlds.fields import Surroundings

NEARNESS = 1e-9
"""A point as close to a boundary as this lies on it."""
_MOST_VOXELS = 2.0**52
"""Up to so many voxels each has a number that a double holds exactly."""


def crossings(places: Floats, direction: Floats, scene: Surroundings) -> Integers:
    """For each place through how many spheres a ray in a direction passes; a sphere around the place itself does not count.

    Seen along the ray, a sphere is a circle: only those whose circle holds the place are looked at.
    """
    found = np.zeros(len(places), np.int64)
    asking, spheres = _close(_flattened(places, direction), _flattened(scene.centres, direction), scene.radii.max(initial=0.0))
    away = scene.centres[spheres] - places[asking]
    along, squares, radii = products(away, direction), products(away, away), scene.radii[spheres]
    half = radii**2 - (squares - along**2)  # the square of half the ray's way through the sphere
    crossed = (half > NEARNESS) & (squares > NEARNESS**2) & (along + np.sqrt(np.maximum(half, 0.0)) > NEARNESS)
    np.add.at(found, asking[crossed], 1)
    return found


def least_clearance(places: Floats, scene: Surroundings, reach: float) -> Floats:
    """The distance from each place to the nearest sphere, at most `reach`; a sphere around the place itself does not count."""
    found = np.full(len(places), float(reach))
    asking, spheres = _close(places, scene.centres, reach + scene.radii.max(initial=0.0))
    distances = lengths_of(scene.centres[spheres] - places[asking])
    others = distances > NEARNESS
    np.minimum.at(found, asking[others], (distances - scene.radii[spheres])[others])
    return found


def around_spheres(places: Floats, scene: Surroundings) -> Integers:
    """For each place 1 if a sphere is around the very place, else 0."""
    asking, _ = _close(places, scene.centres, 0.0)
    return np.minimum(np.bincount(asking, minlength=len(places)), 1)


def counts_in_pyramids(places: Floats, points: Floats, size: float, depth: int) -> Iterator[Integers]:
    """For each place how many points are in its own voxel, then layer by layer how many are in a square of voxels above it.

    In the layer q above the voxel the square reaches q voxels to each side. Points in one row of voxels follow one another when
    they are sorted by layer, row and column, so that two searches count those in a part of a row.
    """
    if not len(points):
        return
    asking, taken = _voxels(places, size), _voxels(points, size)
    least, most = taken.min(axis=0), taken.max(axis=0)
    extent = most - least + 1
    if float(np.prod(extent)) > _MOST_VOXELS or max(np.abs(asking).max(initial=0.0), np.abs(taken).max()) > _MOST_VOXELS:
        raise ModelValueError(f"Voxels of size {size:g} are too small for what is drawn")
    keys = np.sort(_row_major(taken - least, extent))
    for layer in range(depth + 1):
        check_budget()
        found = np.zeros(len(asking), np.int64)
        first, last = (
            np.clip(asking[:, 2] + side, least[2] - outside, most[2] + 1 - outside) - least[2]
            for side, outside in ((-layer, 0), (layer, 1))
        )
        for aside in range(-layer, layer + 1):
            row = asking[:, :2] + (aside, layer) - least[:2]
            there = ((row >= 0) & (row < extent[:2])).all(axis=1)
            begins, ends = (_row_major(np.column_stack((row, column)), extent)[there] for column in (first, last))
            found[there] += np.searchsorted(keys, ends, "right") - np.searchsorted(keys, begins)
        yield found


def _voxels(places: Floats, size: float) -> Floats:
    """The voxels of places; one at a boundary, but for a rounding error, is in the voxel that begins there."""
    found: Floats = np.floor(places / size + NEARNESS)
    return found


def _row_major(voxels: Floats, extent: Floats) -> Floats:
    """The numbers of voxels: by layer, then by row, then by column."""
    found: Floats = (voxels[:, 1] * extent[0] + voxels[:, 0]) * extent[2] + voxels[:, 2]
    return found


def depths_in_outline(places: Floats, corners: Floats) -> Floats:
    """The distance of places in the plane from the nearest side of a polygon, negative outside; shape (n,).

    A place is inside if a ray to its right crosses an odd number of sides.
    """
    starts, sides = corners, np.roll(corners, -1, axis=0) - corners
    away = places[:, None] - starts
    lengths = np.einsum("sk,sk->s", sides, sides)
    along = np.clip(np.einsum("psk,sk->ps", away, sides) / np.where(lengths, lengths, 1.0), 0.0, 1.0)
    distances = np.linalg.norm(away - along[..., None] * sides, axis=2).min(axis=1)
    heights = starts[:, 1] + sides[:, 1]
    spans = (places[:, 1:] < starts[:, 1]) != (places[:, 1:] < heights)
    crossing = sides[:, 0] * away[..., 1] / np.where(sides[:, 1], sides[:, 1], 1.0) - away[..., 0]
    inside = np.count_nonzero(spans & (crossing > 0), axis=1) % 2 == 1
    found: Floats = np.where(inside, distances, -distances)
    return found


def _flattened(points: Floats, direction: Floats) -> Floats:
    """Points as they are seen along a direction: without their part in it."""
    return points - np.outer(products(points, direction), direction)


def _close(places: Floats, points: Floats, reach: float) -> tuple[Integers, Integers]:
    """The pairs of a place and a point that are no farther apart than the reach: their numbers."""
    if not len(places) or not len(points):
        return np.empty(0, np.int64), np.empty(0, np.int64)
    pairs = tree_of(places).sparse_distance_matrix(tree_of(points), reach + NEARNESS, output_type="ndarray")
    return pairs["i"], pairs["j"]


def tree_of(points: Floats) -> Any:
    """A k-d tree of points."""
    from scipy.spatial import cKDTree  # imported late: it takes longer to load than the kit

    return cKDTree(points, balanced_tree=False)


def lengths_of(vectors: Floats) -> Floats:
    """The lengths of vectors in space."""
    found: Floats = np.sqrt(products(vectors, vectors))
    return found


def products(vectors: Floats, others: Floats) -> Floats:
    """The inner products of vectors in space with others, or with one; each is the same however many there are."""
    (x, y, z), (u, v, w) = vectors.T, others.T
    found: Floats = x * u + y * v + z * w
    return found
