"""The sensitive functions of GROGRA: what a module can ask about the shoots around it (Kurth's lecture slides on GROGRA).

A shoot is a stroke. A module belongs to the last shoot drawn before it on its own branch, and asks from the tip of that shoot;
before the first shoot it asks from the position of the turtle. The functions have the numbers that GROGRA gives them. Each
answers any number of standpoints at once; what one is answered does not depend on who else asks.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from lsys_kit.arrays import np
from lsys_kit.geometry.scene import OWN, Flags, Floats, Integers, Segments
from lsys_kit.geometry.turtle.commands import FIRST_COLOUR
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.worlds.neighbours import NEARNESS, Boxes, Cones, counts_in_cones, lengths_of, nearest_in_cones, steepest_lines

NO_SHOOT = -1
FIRST_LOOK = 64
"""Among so many of the nearest points one in a cone is looked for first."""
_NEAR = 4
"""How many points a shoot and its mother have."""


@dataclass(frozen=True)
class Things:
    """The start and end points of some shoots, their start points, or the shoots themselves seen from the front.

    lows, highs
        Shape (n, 2) or (n, 3): the least and the greatest coordinates of each.
    owners
        The number of the shoot of each.
    """

    lows: Floats
    highs: Floats
    owners: Integers

    def __len__(self) -> int:
        return len(self.owners)

    @cached_property
    def boxes(self) -> Boxes:
        """Their hierarchy of boxes, with their k-d tree."""
        return Boxes(self.lows, self.highs)


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
        self.ends, self.mothers = strokes.ends.reshape(-1, 2, 3), np.array([*mothers, NO_SHOOT], np.int64)
        self.lengths: Floats = np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1)
        self.colours = np.where(strokes.colours == OWN, FIRST_COLOUR, strokes.colours)
        self._things: dict[tuple[object, ...], Things] = {}

    def chosen(self, least: float, colour: float | None = None) -> Integers:
        """The numbers of the shoots with at least some length, and of a colour if one is given."""
        return np.flatnonzero((self.lengths >= least - NEARNESS) & (True if colour is None else self.colours == colour))

    def points(self, least: float, colour: float | None = None) -> Things:
        """The start and end points of the same shoots; their boxes are built once."""
        return self._once(("points", least, colour), lambda numbers: self.ends[numbers].reshape(-1, 1, 3), 2)

    def starts(self, least: float) -> Things:
        return self._once(("starts", least, None), lambda numbers: self.ends[numbers, :1])

    def fronts(self, least: float) -> Things:
        return self._once(("fronts", least, None), lambda numbers: self.ends[numbers][:, :, ::2])

    def _once(self, key: tuple[str, float, float | None], corners: Callable[[Integers], Floats], each: int = 1) -> Things:
        if key not in self._things:
            numbers = self.chosen(*key[1:])
            found = corners(numbers)
            self._things[key] = Things(found.min(axis=1), found.max(axis=1), np.repeat(numbers, each))
        return self._things[key]


@dataclass(frozen=True)
class Standpoints:
    """Where modules ask from.

    shoots
        All shoots.
    own, mothers
        The numbers of the shoots of those who ask, and of the shoots from which these grow; neither counts as a
        neighbour. `NO_SHOOT` where there is none.
    tips, heads
        Shape (n, 3): the tips of their shoots, and the directions of the shoots.
    """

    shoots: Shoots
    own: Integers
    mothers: Integers
    tips: Floats
    heads: Floats

    def __len__(self) -> int:
        return len(self.own)

    def __getitem__(self, rows: Integers | slice) -> Standpoints:
        return Standpoints(self.shoots, self.own[rows], self.mothers[rows], self.tips[rows], self.heads[rows])

    def others(self, things: Things) -> Callable[[Integers, Integers], Flags]:
        """Whether things are those of neighbours, given who asks and the numbers of the things."""
        return lambda asking, numbers: (
            (things.owners[numbers] != self.own[asking]) & (things.owners[numbers] != self.mothers[asking])
        )


def nearest(asking: Standpoints, least: float, colour: float | None = None) -> Floats:
    """The distance to the nearest start or end point of another shoot; infinite if there is none.

    A shoot and its mother have four points, so that of five one is sure to be another's.
    """
    return _nearest_of(asking, asking.shoots.points(least, colour), _NEAR + 1, lambda *_: True)


def nearest_ahead(asking: Standpoints, angle: float, least: float, colour: float | None = None) -> Floats:
    """The same among the points in a cone around the heading with a half-angle in degrees."""
    points, cones = asking.shoots.points(least, colour), Cones(asking.tips, asking.heads, min(max(angle, 0.0), 180.0))

    def ahead(rows: Integers, numbers: Integers, distances: Floats) -> Any:
        return cones.hold(rows, points.lows[numbers] - asking.tips[rows], distances)

    found = _nearest_of(asking, points, FIRST_LOOK, ahead)
    if len(points) > FIRST_LOOK:
        far = np.flatnonzero(np.isinf(found))
        remaining = asking[far]
        found[far] = nearest_in_cones(
            points.boxes, Cones(remaining.tips, remaining.heads, cones.angle), remaining.others(points), _NEAR
        )
    return found


def _nearest_of(asking: Standpoints, points: Things, number: int, wanted: Callable[..., Flags | bool]) -> Floats:
    """The distance to the nearest of so many neighbouring points that is another shoot's, and wanted; infinite without one."""
    if not len(points):
        return np.full(len(asking), np.inf)
    distances, numbers = (part.ravel() for part in points.boxes.tree.query(asking.tips, k=[*range(1, number + 1)]))
    rows = np.repeat(np.arange(len(asking)), number)
    there = np.flatnonzero(np.isfinite(distances))
    rows, numbers, distances = rows[there], numbers[there], distances[there]
    kept = asking.others(points)(rows, numbers) & wanted(rows, numbers, distances)
    found = np.full(len(asking), np.inf)
    np.minimum.at(found, rows[kept], distances[kept])
    return found


def steepest_above(asking: Standpoints, least: float) -> Floats:
    """The angle from the vertical, in degrees, of the steepest line from the tip up to another shoot, seen from the front.

    It is 0 if a shoot passes straight above the tip, and infinite if none is above. Only the shoot itself is left out: its
    mother may hang over it.
    """
    shoots, tips = asking.shoots.fronts(least), asking.tips[:, ::2]
    if not len(shoots):
        return np.full(len(asking), np.inf)

    def angles(rows: Integers, numbers: Integers) -> Floats:
        owners = shoots.owners[numbers]
        found = _steepest(*(asking.shoots.ends[owners][:, :, ::2] - tips[rows, None]).transpose(1, 2, 0))
        return np.where(owners == asking.own[rows], np.inf, found)

    return steepest_lines(shoots.boxes, tips, angles, 1)


def _steepest(start: Floats, end: Floats) -> Floats:
    """The angle from the vertical of the steepest line from the origin up to each stroke in the plane; infinite without one."""
    (x0, z0), (x1, z1) = start, end
    sloping = np.abs(x1 - x0) > NEARNESS
    along = np.divide(-x0, x1 - x0, out=np.ones_like(x0), where=sloping)
    height = np.where(sloping, z0 + along * (z1 - z0), np.maximum(z0, z1))
    over = (np.minimum(x0, x1) <= NEARNESS) & (np.maximum(x0, x1) >= -NEARNESS) & (height > NEARNESS)
    slants = [np.where(z > NEARNESS, np.degrees(np.arctan2(np.abs(x), z)), np.inf) for x, z in (start, end)]
    found: Floats = np.where(over, 0.0, np.minimum(*slants))
    return found


def shoots_above(asking: Standpoints, angle: float, least: float) -> Integers:
    """The number of other shoots that start in a cone above the tip with a half-angle in degrees.

    GROGRA sums the leaves (N) of these shoots; here every shoot counts as one, because leaves are not modelled.
    """
    starts, upwards = asking.shoots.starts(least), np.tile((0.0, 0.0, 1.0), (len(asking), 1))
    cones = Cones(asking.tips, upwards, min(max(angle, 0.0), 180.0))
    if not len(starts):
        return np.zeros(len(asking), np.int64)
    own = np.flatnonzero(np.isin(asking.own, starts.owners))
    away = asking.shoots.ends[asking.own[own], 0] - asking.tips[own]
    distances = lengths_of(away)
    found = counts_in_cones(starts.boxes, cones)
    found[own] -= cones.hold(own, away, distances) & (distances > NEARNESS)
    return found


def inclination(asking: Standpoints) -> Floats:
    found: Floats = np.degrees(np.arctan2(np.hypot(asking.heads[:, 0], asking.heads[:, 1]), asking.heads[:, 2]))
    return found


class SensitiveFunction(NamedTuple):
    """A sensitive function: what it returns, in words; the least and the greatest number of its values."""

    words: str
    least: int
    most: int
    answer: Callable[..., Floats | Integers]


SENSITIVE_FUNCTIONS: Mapping[Value, SensitiveFunction] = {
    1: SensitiveFunction("the inclination of the steepest line to a shoot above", 1, 1, steepest_above),
    2: SensitiveFunction("the distance to the nearest shoot", 1, 2, nearest),
    4: SensitiveFunction("the number of shoots above", 2, 2, shoots_above),
    7: SensitiveFunction("the inclination", 0, 0, inclination),
    9: SensitiveFunction("the distance to the nearest shoot ahead", 2, 3, nearest_ahead),
}
