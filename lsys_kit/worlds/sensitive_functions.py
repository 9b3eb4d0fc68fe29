"""The sensitive functions of GROGRA: what a module may ask about the shoots around it (seed 003, W. Kurth).

A shoot is a stroke. A module belongs to the shoot that was drawn last before it, on its own branch, and asks from that shoot's
tip; before the first shoot it asks from where the turtle is. Functions have the numbers that they have in GROGRA.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from lsys_kit.geometry.scene import OWN, Floats, Integers, Segments
from lsys_kit.geometry.turtle.commands import FIRST_COLOUR
from lsys_kit.notation.model.arithmetic import Value

CLOSE = 1e-9
"""What is as near to an edge as this is on it."""
WINDOW = 32
"""The nearest point is first looked for among so many on each side."""


@dataclass(frozen=True)
class EndPoints:
    """The begin and end points of some shoots.

    Attributes
    ----------
    places
        Shape (n, 3), in the order of their first coordinate, so that few have to be looked at to find the nearest.
    owners
        Shape (n,): the number of each point's shoot.
    """

    places: Floats
    owners: Integers

    def nearest(self, tip: Floats, near: Sequence[int]) -> float:
        """How far the nearest is from a tip, those of some shoots near by left out; infinite where there is no other.

        What is found among the neighbours in the order bounds the stretch in which a nearer one can be; what was found there
        may lie on the edge of it, or by a rounding error beside it.
        """
        first = self.places[:, 0]
        at = int(np.searchsorted(first, tip[0]))
        reach = self._least(tip, near, max(0, at - WINDOW), at + WINDOW)
        low, high = np.searchsorted(first, tip[0] - reach, "left"), np.searchsorted(first, tip[0] + reach, "right")
        return min(reach, self._least(tip, near, int(low), int(high)))

    def _least(self, tip: Floats, near: Sequence[int], low: int, high: int) -> float:
        distances = np.linalg.norm(self.places[low:high] - tip, axis=1)
        for number in near:
            distances[self.owners[low:high] == number] = math.inf
        return float(distances.min(initial=math.inf))


class Shoots:
    """The shoots of a word.

    Parameters
    ----------
    strokes
        They themselves, in space.
    mothers
        For each the number of the one that it grows from.

    Attributes
    ----------
    ends
        Shape (n, 2, 3): their begin and end points.
    lengths, colours
        Shape (n,).
    """

    def __init__(self, strokes: Segments, mothers: Sequence[int]) -> None:
        self.ends, self.mothers = strokes.ends.reshape(-1, 2, 3), mothers
        self.lengths: Floats = np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1)
        self.colours = np.where(strokes.colours == OWN, FIRST_COLOUR, strokes.colours)
        self._points: dict[tuple[float, float | None], EndPoints] = {}

    def chosen(self, least: float, colour: float | None = None) -> Integers:
        """The numbers of those that have at least some length, and perhaps a colour."""
        return np.flatnonzero((self.lengths >= least - CLOSE) & (True if colour is None else self.colours == colour))

    def points(self, least: float, colour: float | None = None) -> EndPoints:
        """The begin and end points of the same, put into order once."""
        if (least, colour) not in self._points:
            numbers = self.chosen(least, colour)
            places, owners = self.ends[numbers].reshape(-1, 3), np.repeat(numbers, 2)
            order = np.argsort(places[:, 0], kind="stable")
            self._points[least, colour] = EndPoints(places[order], owners[order])
        return self._points[least, colour]


@dataclass(frozen=True)
class Query:
    """Where a module stands that asks.

    Attributes
    ----------
    shoots
        All shoots.
    near
        The numbers of its own shoot and of that one's mother, which do not count as neighbours.
    tip, head
        The tip of its shoot, and where it points.
    """

    shoots: Shoots
    near: tuple[int, ...]
    tip: Floats
    head: Floats


def nearest(stand: Query, least: float, colour: float | None = None) -> float:
    """How far the nearest begin or end point of another shoot is; infinite where there is none."""
    return stand.shoots.points(least, colour).nearest(stand.tip, stand.near)


def ahead(stand: Query, angle: float, least: float, colour: float | None = None) -> float:
    """The same of the points in a cone around the heading, open by so many degrees to each side."""
    points = stand.shoots.points(least, colour)
    away = points.places - stand.tip
    distances = np.linalg.norm(away, axis=1)
    edge = math.cos(math.radians(min(max(angle, 0.0), 180.0)))
    within = (away @ stand.head >= edge * distances - CLOSE) & ~np.isin(points.owners, stand.near)
    return float(distances[within].min(initial=math.inf))


def overhead(stand: Query, least: float) -> float:
    """At how many degrees from the vertical the steepest way from the tip up to another shoot goes, seen from the front.

    It is 0 where a shoot passes straight above the tip, and infinite where none is above. Only the shoot itself is left out:
    the one that it grows from may hang over it.
    """
    others = np.setdiff1d(stand.shoots.chosen(least), stand.near[:1])
    (x0, z0), (x1, z1) = (stand.shoots.ends[others] - stand.tip)[:, :, ::2].transpose(1, 2, 0)
    along = np.divide(-x0, x1 - x0, out=np.ones_like(x0), where=np.abs(x1 - x0) > CLOSE)
    height = np.where(np.abs(x1 - x0) > CLOSE, z0 + along * (z1 - z0), np.maximum(z0, z1))
    if np.any((np.minimum(x0, x1) <= CLOSE) & (np.maximum(x0, x1) >= -CLOSE) & (height > CLOSE)):
        return 0.0
    sideways, up = np.abs(np.concatenate((x0, x1))), np.concatenate((z0, z1))
    return float(np.degrees(np.arctan2(sideways, up))[up > CLOSE].min(initial=math.inf))


def shade(stand: Query, angle: float, least: float) -> int:
    """How many other shoots begin in a cone above the tip, which is open by so many degrees to each side.

    GROGRA sums the leaves of these shoots, its N; here every shoot has 1, for leaves are not seen.
    """
    others = np.setdiff1d(stand.shoots.chosen(least), stand.near[:1])
    away = stand.shoots.ends[others, 0] - stand.tip
    edge = math.cos(math.radians(min(max(angle, 0.0), 180.0)))
    distances = np.linalg.norm(away, axis=1)
    return int(np.count_nonzero((distances > CLOSE) & (away[:, 2] >= edge * distances - CLOSE)))


def inclination(stand: Query) -> float:
    """How far the shoot leans from the vertical: 0 degrees upright, 90 level, 180 hanging."""
    return math.degrees(math.atan2(math.hypot(stand.head[0], stand.head[1]), stand.head[2]))


class SensitiveFunction(NamedTuple):
    """A sensitive function: what it answers, in words; with how many values it is asked, at least and at most."""

    words: str
    least: int
    most: int
    answer: Callable[..., Any]


SENSITIVE_FUNCTIONS: Mapping[Value, SensitiveFunction] = {
    1: SensitiveFunction("the inclination of the steepest way to a shoot above", 1, 1, overhead),
    2: SensitiveFunction("the distance to the nearest shoot", 1, 2, nearest),
    4: SensitiveFunction("the number of shoots above", 2, 2, shade),
    7: SensitiveFunction("the inclination", 0, 0, inclination),
    9: SensitiveFunction("the distance to the nearest shoot ahead", 2, 3, ahead),
}
"""The sensitive functions that are known here, by their numbers."""
