"""What is near: the nearest points, the spheres that a ray passes through, and the room that they leave, by k-d trees."""

from __future__ import annotations

from typing import Any

import numpy as np

from lsys_kit.geometry.scene import Floats, Integers
from lsys_kit.worlds.fields import Surroundings

NEARNESS = 1e-9
"""A point as close to a boundary as this lies on it."""


def crossings(places: Floats, direction: Floats, scene: Surroundings) -> Integers:
    """For each place through how many spheres a ray in a direction passes; a sphere around the place itself does not count.

    Seen along the ray, a sphere is a circle: only those whose circle holds the place are looked at.
    """
    found = np.zeros(len(places), np.int64)
    asking, spheres = _close(_flattened(places, direction), _flattened(scene.centres, direction),
                             np.full(len(places), scene.radii.max(initial=0.0)))
    away = scene.centres[spheres] - places[asking]
    along, squares, radii = away @ direction, np.einsum("ij,ij->i", away, away), scene.radii[spheres]
    half = radii ** 2 - (squares - along ** 2)  # the square of half the ray's way through the sphere
    crossed = (half > NEARNESS) & (squares > NEARNESS ** 2) & (along + np.sqrt(np.maximum(half, 0.0)) > NEARNESS)
    np.add.at(found, asking[crossed], 1)
    return found


def least_clearance(places: Floats, scene: Surroundings, reach: float) -> Floats:
    """The distance from each place to the nearest sphere, at most `reach`; a sphere around the place itself does not count."""
    found = np.full(len(places), float(reach))
    asking, spheres = _close(places, scene.centres, np.full(len(places), reach + scene.radii.max(initial=0.0)))
    distances = np.linalg.norm(scene.centres[spheres] - places[asking], axis=1)
    others = distances > NEARNESS
    np.minimum.at(found, asking[others], (distances - scene.radii[spheres])[others])
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
    return points - np.outer(points @ direction, direction)


def _close(places: Floats, points: Floats, reaches: Floats) -> tuple[Integers, Integers]:
    """The pairs of a place and a point that are no farther apart than the reach of the place: their numbers."""
    if not len(places) or not len(points):
        return np.empty(0, np.int64), np.empty(0, np.int64)
    lists = tree_of(points).query_ball_point(places, reaches + NEARNESS)
    return (np.repeat(np.arange(len(places)), [len(numbers) for numbers in lists]),
            np.fromiter((number for numbers in lists for number in numbers), np.int64))


def tree_of(points: Floats) -> Any:
    """A k-d tree of points."""
    from scipy.spatial import cKDTree  # imported late: it takes longer to load than the kit

    return cKDTree(points)
