"""The sensitive functions of GROGRA: what a module can ask about the shoots around it (Kurth's lecture slides on GROGRA).

A shoot is a stroke. A module belongs to the last shoot drawn before it on its own branch, and asks from the tip of that shoot;
before the first shoot it asks from the position of the turtle. The functions have the numbers that GROGRA gives them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from lsys_kit.geometry.scene import OWN, Floats, Integers, Segments
from lsys_kit.geometry.turtle.commands import FIRST_COLOUR
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.worlds.neighbours import NEARNESS, tree_of


@dataclass(frozen=True)
class EndPoints:
    """The start and end points of some shoots.

    Attributes
    ----------
    places
        Shape (n, 3).
    owners
        Shape (n,): the number of the shoot of each point.
    """

    places: Floats
    owners: Integers

    @cached_property
    def tree(self) -> Any:
        """Their k-d tree."""
        return tree_of(self.places)

    def nearest(self, tip: Floats, near: Sequence[int]) -> float:
        """The distance of the nearest point from a tip, except those of some shoots; infinite if there is none.

        Each of these shoots has two points, so that one more is sure to be another's.
        """
        if not len(self.places):
            return math.inf
        distances, numbers = self.tree.query(tip, k=[*range(1, 2 * len(near) + 2)])
        for distance, number in zip(distances.tolist(), numbers.tolist(), strict=True):
            if math.isfinite(distance) and self.owners[number] not in near:
                return float(distance)
        return math.inf


class Shoots:
    """The shoots of a word.

    Parameters
    ----------
    strokes
        The strokes in space, one for each shoot.
    mothers
        For each shoot the number of the one from which it grows.

    Attributes
    ----------
    ends
        Shape (n, 2, 3): their start and end points.
    lengths, colours
        Shape (n,).
    """

    def __init__(self, strokes: Segments, mothers: Sequence[int]) -> None:
        self.ends, self.mothers = strokes.ends.reshape(-1, 2, 3), mothers
        self.lengths: Floats = np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1)
        self.colours = np.where(strokes.colours == OWN, FIRST_COLOUR, strokes.colours)
        self._points: dict[tuple[float, float | None], EndPoints] = {}

    def chosen(self, least: float, colour: float | None = None) -> Integers:
        """The numbers of the shoots with at least some length, and of a colour if one is given."""
        return np.flatnonzero((self.lengths >= least - NEARNESS) & (True if colour is None else self.colours == colour))

    def points(self, least: float, colour: float | None = None) -> EndPoints:
        """The start and end points of the same shoots, for which a tree is built once."""
        if (least, colour) not in self._points:
            numbers = self.chosen(least, colour)
            self._points[least, colour] = EndPoints(self.ends[numbers].reshape(-1, 3), np.repeat(numbers, 2))
        return self._points[least, colour]


@dataclass(frozen=True)
class Query:
    """The standpoint of a module that asks.

    Attributes
    ----------
    shoots
        All shoots.
    near
        The numbers of its own shoot and of that shoot's mother, which do not count as neighbours.
    tip, head
        The tip of its shoot, and the direction of the shoot.
    """

    shoots: Shoots
    near: tuple[int, ...]
    tip: Floats
    head: Floats


def nearest(query: Query, least: float, colour: float | None = None) -> float:
    """The distance to the nearest start or end point of another shoot; infinite if there is none."""
    return query.shoots.points(least, colour).nearest(query.tip, query.near)


def nearest_ahead(query: Query, angle: float, least: float, colour: float | None = None) -> float:
    """The same among the points in a cone around the heading with a half-angle in degrees."""
    points = query.shoots.points(least, colour)
    away = points.places - query.tip
    distances = np.linalg.norm(away, axis=1)
    edge = math.cos(math.radians(min(max(angle, 0.0), 180.0)))
    within = (away @ query.head >= edge * distances - NEARNESS) & ~np.isin(points.owners, query.near)
    return float(distances[within].min(initial=math.inf))


def steepest_above(query: Query, least: float) -> float:
    """The angle from the vertical, in degrees, of the steepest line from the tip up to another shoot, seen from the front.

    It is 0 if a shoot passes straight above the tip, and infinite if none is above. Only the shoot itself is left out: its
    mother may hang over it.
    """
    others = np.setdiff1d(query.shoots.chosen(least), query.near[:1])
    (x0, z0), (x1, z1) = (query.shoots.ends[others] - query.tip)[:, :, ::2].transpose(1, 2, 0)
    along = np.divide(-x0, x1 - x0, out=np.ones_like(x0), where=np.abs(x1 - x0) > NEARNESS)
    height = np.where(np.abs(x1 - x0) > NEARNESS, z0 + along * (z1 - z0), np.maximum(z0, z1))
    if np.any((np.minimum(x0, x1) <= NEARNESS) & (np.maximum(x0, x1) >= -NEARNESS) & (height > NEARNESS)):
        return 0.0
    sideways, up = np.abs(np.concatenate((x0, x1))), np.concatenate((z0, z1))
    return float(np.degrees(np.arctan2(sideways, up))[up > NEARNESS].min(initial=math.inf))


def shoots_above(query: Query, angle: float, least: float) -> int:
    """The number of other shoots that start in a cone above the tip with a half-angle in degrees.

    GROGRA sums the leaves (N) of these shoots; here every shoot counts as one, because leaves are not modelled.
    """
    others = np.setdiff1d(query.shoots.chosen(least), query.near[:1])
    away = query.shoots.ends[others, 0] - query.tip
    edge = math.cos(math.radians(min(max(angle, 0.0), 180.0)))
    distances = np.linalg.norm(away, axis=1)
    return int(np.count_nonzero((distances > NEARNESS) & (away[:, 2] >= edge * distances - NEARNESS)))


def inclination(query: Query) -> float:
    """The angle of the shoot from the vertical: 0 degrees upright, 90 horizontal, 180 hanging down."""
    return math.degrees(math.atan2(math.hypot(query.head[0], query.head[1]), query.head[2]))


class SensitiveFunction(NamedTuple):
    """A sensitive function: what it returns, in words; the least and the greatest number of its values."""

    words: str
    least: int
    most: int
    answer: Callable[..., Any]


SENSITIVE_FUNCTIONS: Mapping[Value, SensitiveFunction] = {
    1: SensitiveFunction("the inclination of the steepest line to a shoot above", 1, 1, steepest_above),
    2: SensitiveFunction("the distance to the nearest shoot", 1, 2, nearest),
    4: SensitiveFunction("the number of shoots above", 2, 2, shoots_above),
    7: SensitiveFunction("the inclination", 0, 0, inclination),
    9: SensitiveFunction("the distance to the nearest shoot ahead", 2, 3, nearest_ahead),
}
"""The sensitive functions, by number."""
