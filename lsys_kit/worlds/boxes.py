"""What lies in a cone, and what is steepest above: searches in a hierarchy of boxes, for all who ask at once.

Eight neighbours share a box, eight boxes one of the next level, and so on. A box that lies wholly inside or outside is not
opened, nor is one in which nothing better can be found (bounding volume hierarchies; branch and bound).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from lsys_kit.budget import check_budget
from lsys_kit.geometry.scene import Floats, Integers
from lsys_kit.worlds.neighbours import NEARNESS, lengths_of, products, tree_of

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
        Shape (n,): the numbers of the things, so that neighbours follow one another.
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

    Attributes
    ----------
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

    def opened(level: Level, asking: Integers, numbers: Integers) -> Any:
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


def nearest_in_cones(boxes: Boxes, cones: Cones, counts: Callable[[Integers, Integers], Any], others: int) -> Floats:
    """How far the nearest point in each cone is; infinite if there is none.

    Parameters
    ----------
    boxes, cones
        The points, and the cones.
    counts
        Whether points count, given who asks and the numbers of the points.
    others
        How many points at most do not count for one who asks.
    """
    found = np.full(len(cones.tips), np.inf)

    def opened(level: Level, asking: Integers, numbers: Integers) -> Any:
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

    Parameters
    ----------
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


def _search(boxes: Boxes, asking: int, opened: Callable[[Level, Integers, Integers], Any]) -> None:
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
