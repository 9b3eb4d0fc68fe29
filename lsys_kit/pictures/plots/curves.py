"""Curves: numbers against a step, a time or a constant, each curve with its name at its end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from lsys_kit.pictures.plots.chart import HEIGHT, SIZE, Axis, Chart, set_paper, tick_text
from lsys_kit.pictures.plots.lettering import plain, width
from lsys_kit.pictures.style.palette import shaded

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ABOVE, BELOW, LEFT = 44, 56, 62
"""The room around the axes, in pixels."""
LABEL_DISTANCE = 18
"""Between two labels at the ends of curves, in pixels."""
MOST_DOTS = 40
"""A curve of more points has no dots on it."""
DASHES = ("solid", (0, (6, 4)), (0, (2, 4)), (0, (10, 4)), (0, (8, 3, 2, 3)), (0, (3, 3)))
"""How the lines of several curves are broken, so that colour alone says nothing."""


@dataclass(frozen=True)
class Curve:
    """A curve.

    Attributes
    ----------
    points
        Its points, from left to right.
    colour
        Its colour.
    label
        Its name, perhaps with mathematics; empty where it needs none.
    quiet
        Whether it is drawn thin and pale, as one of many.
    """

    points: tuple[tuple[float, float], ...]
    colour: str
    label: str = ""
    quiet: bool = False


@dataclass(frozen=True)
class CurveChart(Chart):
    """Curves over one axis.

    Attributes
    ----------
    curves
        The curves.
    across, up
        The axes.
    unbroken
        Whether all lines are solid, so that their jumps can be seen.
    """

    curves: tuple[Curve, ...]
    across: Axis
    up: Axis
    unbroken: bool = False

    @cached_property
    def text(self) -> str:
        """The curves, from where to where they go, and the greatest value."""
        (left, right), (_, most) = self._span(0), self._span(1)
        named = [plain(curve.label) for curve in self.curves if curve.label]
        names = f" ({', '.join(named)})" if named else ""
        many = len(self.curves)
        return (
            f"{many} curve{'s' * (many != 1)}{names} of {plain(self.up.label)}, {plain(self.across.label)} from "
            f"{tick_text(left)} to {tick_text(right)}, largest {tick_text(most)}"
        )

    def _span(self, axis: int) -> tuple[float, float]:
        values = [point[axis] for curve in self.curves for point in curve.points]
        return min(values), max(values)

    @property
    def margins(self) -> tuple[float, float, float, float]:
        """The room to the right is that of the longest name."""
        return LEFT, 24 + max((width(curve.label, SIZE) for curve in self.curves), default=0), ABOVE, BELOW

    def paint(self, ax: Axes) -> None:
        """Draw the curves, those of many first."""
        if self.up.log:
            ax.set_yscale("log")
        set_paper(ax, self.across, self.up)
        loud = [curve for curve in self.curves if not curve.quiet]
        for curve in self.curves:
            broken = curve in loud and not self.unbroken
            self._paint_curve(ax, curve, DASHES[loud.index(curve) % len(DASHES)] if broken else "solid")
        self._set_limits(ax)
        self._paint_labels(ax)

    def _paint_curve(self, ax: Axes, curve: Curve, dashes: object) -> None:
        points = [point for point in curve.points if point[1] > 0] if self.up.log else [*curve.points]
        if curve.quiet:
            ax.plot(*zip(*points, strict=True), color=curve.colour, alpha=0.3, linewidth=1, clip_on=False) if points else None
            return
        dots = "o" if len(points) <= MOST_DOTS else None
        ax.plot(
            [x for x, _ in points],
            [y for _, y in points],
            color=curve.colour,
            linewidth=2,
            linestyle=dashes,
            marker=dots,
            markersize=5,
            markeredgewidth=0,
            clip_on=False,
        )

    def _set_limits(self, ax: Axes) -> None:
        """From the first to the last point, and from 0 where that is near."""
        (left, right), (least, most) = self._span(0), self._span(1)
        ax.set_xlim((left, right) if left < right else (left - 0.5, left + 0.5))
        if self.up.log:
            seen = [y for curve in self.curves for _, y in curve.points if y > 0] or [1.0]
            ax.set_ylim(min(seen) / 1.2, 1.2 * max(seen))
            return
        bottom = 0.0 if 0 <= least <= most / 2 or least == most >= 0 else least - 0.05 * (most - least)
        ax.set_ylim(bottom, most + 0.03 * (most - bottom) if most > bottom else bottom + 1)

    def _paint_labels(self, ax: Axes) -> None:
        """The names of the curves at their ends, none over another."""
        named = [curve for curve in self.curves if curve.label and curve.points]
        room = HEIGHT - ABOVE - BELOW
        to_axes = ax.transData + ax.transAxes.inverted()
        ends = [float(to_axes.transform(curve.points[-1])[1]) * room for curve in named]
        for curve, place in zip(named, spread(ends, LABEL_DISTANCE), strict=True):
            ax.annotate(
                curve.label,
                (1, place / room),
                (10, 0),
                xycoords="axes fraction",
                textcoords="offset points",
                ha="left",
                va="center",
                color=shaded(curve.colour, 0.7),
                fontsize=SIZE,
            )


def spread(places: Sequence[float], distance: float) -> list[float]:
    """Places moved apart as little as needed, so that no two are nearer than a distance.

    >>> spread([0, 3, 50], 10)
    [-3.5, 6.5, 50.0]
    """
    groups: list[tuple[float, int]] = []
    for place in sorted(places):
        groups.append((float(place), 1))
        while len(groups) > 1 and groups[-1][0] - groups[-2][0] < distance * (groups[-1][1] + groups[-2][1]) / 2:
            (first, some), (second, more) = groups[-2:]
            groups[-2:] = [((first * some + second * more) / (some + more), some + more)]
    found = [middle + distance * (number - (many - 1) / 2) for middle, many in groups for number in range(many)]
    order = sorted(range(len(places)), key=places.__getitem__)
    return [found[order.index(place)] for place in range(len(places))]
