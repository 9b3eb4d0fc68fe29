"""What is near: the spheres that a ray passes through, the room that they leave, how many are in voxels above and in cones.

What lies in a cone, and what is steepest above, is searched for in a hierarchy of boxes, for all who ask at once. Eight
neighbours share a box, eight boxes one of the next level, and so on. A box that lies wholly inside or outside is not opened,
nor is one in which nothing better can be found (bounding volume hierarchies; branch and bound).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import Flags, Floats, Integers


@dataclass(frozen=True)
class Surroundings:
    """What is drawn of a word, in the same axes.

    Attributes
    ----------
    strokes
        Shape (n, 2, 3): their start and end points.
    centres, radii
        Shape (m, 3) and (m,): the spheres.
    """

    strokes: Floats
    centres: Floats
    radii: Floats


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
    from scipy.spatial import cKDTree  # imported late: it takes longer to load than the kit

    return cKDTree(points, balanced_tree=False)


def lengths_of(vectors: Floats) -> Floats:
    found: Floats = np.sqrt(products(vectors, vectors))
    return found


def products(vectors: Floats, others: Floats) -> Floats:
    """The inner products of vectors in space with others, or with one; each is the same however many there are."""
    (x, y, z), (u, v, w) = vectors.T, others.T
    found: Floats = x * u + y * v + z * w
    return found


GROUP = 8
"""How many boxes share one of the next level."""
PAIRS = 400_000
"""About how many pairs of one who asks and a box are looked at at once."""


class Level(NamedTuple):
    """Boxes: their least and greatest coordinates, and how many things each holds."""

    lows: Floats
    highs: Floats
    sizes: Integers

    @property
    def single(self) -> bool:
        """Whether each box is that of one thing."""
        return bool(self.sizes[0] == 1)


class Boxes:
    """Boxes around things in the plane or in space.

    Parameters
    ----------
    lows, highs
        Shape (n, 2) or (n, 3): the least and the greatest coordinates of each thing; the same for points.

    Attributes
    ----------
    order
        The numbers of the things, so that neighbours follow one another.
    """

    def __init__(self, lows: Floats, highs: Floats) -> None:
        self.tree = tree_of((lows + highs) / 2)
        self.order: Integers = np.asarray(self.tree.indices, np.int64)
        self._things = Level(lows[self.order], highs[self.order], np.ones(len(lows), np.int64))

    @cached_property
    def levels(self) -> tuple[Level, ...]:
        """From the few boxes that hold all to those of single things."""
        found = [self._things]
        while len(found[-1].lows) > GROUP:
            starts = np.arange(0, len(found[-1].lows), GROUP)
            found.append(
                Level(
                    np.minimum.reduceat(found[-1].lows, starts),
                    np.maximum.reduceat(found[-1].highs, starts),
                    np.add.reduceat(found[-1].sizes, starts),
                )
            )
        return tuple(reversed(found))


@dataclass(frozen=True)
class Cones:
    """Cones with one half-angle.

    tips, axes
        Shape (n, 3): where they begin, and where they point.
    angle
        The half-angle, in degrees.
    """

    tips: Floats
    axes: Floats
    angle: float

    def hold(self, asking: Integers, away: Floats, distances: Floats) -> Any:
        """Whether points are in the cones, or on them, given how far they are away from the tips."""
        edge = np.cos(np.radians(self.angle))
        return products(away, self.axes[asking]) >= edge * distances - NEARNESS

    def beside(self, asking: Integers, away: Floats, distances: Floats) -> Floats:
        """How far points are from the surface of the cones, negative inside."""
        along = products(away, self.axes[asking])
        across = np.sqrt(np.maximum(distances**2 - along**2, 0.0))
        radians = np.radians(self.angle)
        found: Floats = across * np.cos(radians) - along * np.sin(radians)
        return found


def counts_in_cones(boxes: Boxes, cones: Cones) -> Integers:
    """How many points are in each cone; one at its tip does not count."""
    found = np.zeros(len(cones.tips), np.int64)

    def opened(level: Level, asking: Integers, numbers: Integers) -> Flags | None:
        away, distances, radii = _seen(level, numbers, cones.tips[asking])
        if level.single:
            inside, undecided = cones.hold(asking, away, distances) & (distances > NEARNESS), None
        else:
            beside, slack = cones.beside(asking, away, distances), _slack(distances + radii)
            inside, undecided = beside < -radii - slack, np.abs(beside) <= radii + slack
        np.add.at(found, asking[inside], level.sizes[numbers[inside]])
        return undecided

    _search(boxes, len(found), opened)
    return found


def nearest_in_cones(boxes: Boxes, cones: Cones, counts: Callable[[Integers, Integers], Flags], others: int) -> Floats:
    """How far the nearest point in each cone is; infinite if there is none.

    boxes, cones
        The points, and the cones.
    counts
        Whether points count, given who asks and the numbers of the points.
    others
        How many points at most do not count for one who asks.
    """
    found = np.full(len(cones.tips), np.inf)

    def opened(level: Level, asking: Integers, numbers: Integers) -> Flags | None:
        away, distances, radii = _seen(level, numbers, cones.tips[asking])
        if level.single:
            hit = cones.hold(asking, away, distances) & counts(asking, boxes.order[numbers])
            np.minimum.at(found, asking[hit], distances[hit])
            return None
        beside, slack = cones.beside(asking, away, distances), _slack(distances + radii)
        sure = (beside < -radii - slack) & (level.sizes[numbers] > others)
        np.minimum.at(found, asking[sure], (distances + radii)[sure])
        return (beside <= radii + slack) & (distances - radii <= found[asking] + NEARNESS)

    _search(boxes, len(found), opened)
    return found


def steepest_lines(boxes: Boxes, tips: Floats, angles: Callable[[Integers, Integers], Floats], others: int) -> Floats:
    """The least angle from the vertical, in degrees, of a line from each tip up to a thing in the plane; infinite without one.

    boxes, tips
        The things, and where is asked from: across and upwards.
    angles
        The angle for one thing each, given who asks and the numbers of the things.
    others
        How many things at most do not count for one who asks.
    """
    found = np.full(len(tips), np.inf)

    def opened(level: Level, asking: Integers, numbers: Integers) -> Any:
        if level.single:
            np.minimum.at(found, asking, angles(asking, boxes.order[numbers]))
            return None
        (left, low), (right, high) = (level.lows[numbers] - tips[asking]).T, (level.highs[numbers] - tips[asking]).T
        sure = (low > NEARNESS) & (level.sizes[numbers] > others)
        widest = np.degrees(np.arctan2(np.maximum(np.abs(left), np.abs(right)), low))
        np.minimum.at(found, asking[sure], widest[sure])
        least = np.degrees(np.arctan2(np.maximum(np.maximum(left, -right), 0.0), np.maximum(high, NEARNESS)))
        return (high > NEARNESS) & (least <= found[asking] + NEARNESS)

    _search(boxes, len(found), opened)
    return found


def _search(boxes: Boxes, asking: int, opened: Callable[[Level, Integers, Integers], Flags | None]) -> None:
    """Go down through all levels: for pairs of one who asks and a box `opened` tells which boxes are opened."""
    for rows in _blocks(asking, len(boxes.order)):
        check_budget()
        numbers = np.tile(np.arange(len(boxes.levels[0].lows)), len(rows))
        askers = np.repeat(rows, len(boxes.levels[0].lows))
        for level, finer in zip(boxes.levels, [*boxes.levels[1:], None], strict=True):
            undecided = opened(level, askers, numbers)
            if finer is not None:
                askers = np.repeat(askers[undecided], GROUP)
                numbers = (numbers[undecided, None] * GROUP + np.arange(GROUP)).ravel()
                there = numbers < len(finer.lows)
                askers, numbers = askers[there], numbers[there]


def _blocks(asking: int, things: int) -> Iterator[Integers]:
    """The numbers of those who ask, in blocks; a surface cuts about n^(2/3) of n boxes."""
    size = max(1, int(PAIRS / min(things, GROUP * things ** (2 / 3))))
    for first in range(0, asking, size):
        yield np.arange(first, min(first + size, asking))


def _seen(level: Level, numbers: Integers, tips: Floats) -> tuple[Floats, Floats, Floats]:
    """The middles of boxes, seen from tips, with their distances, and how far the corners are from the middles."""
    lows, highs = level.lows[numbers], level.highs[numbers]
    away = (lows + highs) / 2 - tips
    return away, lengths_of(away), lengths_of(highs - lows) / 2


def _slack(distances: Floats) -> Floats:
    """How far beside a cone a point may be at most that is still taken for one on it, at some distance from its tip."""
    found: Floats = np.sqrt(2 * NEARNESS * distances) + NEARNESS
    return found
