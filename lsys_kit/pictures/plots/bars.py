"""Bars: the distribution of a number over many runs, and the shares of kinds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import ceil, floor
from statistics import fmean
from typing import TYPE_CHECKING, NamedTuple

from lsys_kit.pictures.plots.chart import SIZE, Axis, Chart, set_paper, tick_text
from lsys_kit.pictures.plots.lettering import plain, width
from lsys_kit.pictures.style.palette import BLUE, INK, VERMILION, shaded, tinted

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_BARS = 24
"""The most bars of a histogram."""


def class_edges(values: Sequence[float]) -> list[float]:
    """The edges of the classes of a histogram: round numbers; of few whole numbers each is in the middle of a class.

    >>> class_edges([1, 2, 2, 4]), class_edges([0, 100] * 50)[:3]
    ([0.5, 1.5, 2.5, 3.5, 4.5], [0.0, 10.0, 20.0])
    """
    low, high = min(values), max(values)
    if all(value == floor(value) for value in values) and high - low < MOST_BARS:
        return [low - 0.5 + number for number in range(int(high - low) + 2)]
    step = _round_step((high - low) / min(MOST_BARS, max(5, ceil(len(values) ** 0.5)))) if high > low else 1.0
    first, last = floor(low / step), floor(high / step) + 1
    return [step * number for number in range(first, last + 1)]


def _round_step(step: float) -> float:
    """The next 1, 2 or 5 times a power of ten.

    >>> _round_step(0.13), _round_step(30.0)
    (0.2, 50.0)
    """
    power = 10.0 ** floor(float(f"{step:e}".split("e")[1]))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= step * (1 - 1e-9))


@dataclass(frozen=True)
class HistogramChart(Chart):
    """A histogram, with the mean.

    Attributes
    ----------
    values
        The values, one for each run.
    across
        What they measure.
    """

    values: tuple[float, ...]
    across: Axis

    @cached_property
    def text(self) -> str:
        """How many runs there are, the least, the mean and the greatest value."""
        return (
            f"{len(self.values):,} runs, {plain(self.across.label)}: least {tick_text(min(self.values))}, mean "
            f"{tick_text(float(f'{self._mean:.6g}'))}, greatest {tick_text(max(self.values))}"
        )

    @property
    def _mean(self) -> float:
        return fmean(self.values)

    @property
    def margins(self) -> tuple[float, float, float, float]:
        """The room around the axes."""
        return 62, 30, 44, 56

    def paint(self, ax: Axes) -> None:
        """Draw a bar for each class."""
        set_paper(ax, self.across, Axis("runs", True))
        edges = class_edges(self.values)
        counts = [0] * (len(edges) - 1)
        for value in self.values:
            counts[min(int((value - edges[0]) / (edges[1] - edges[0]) + 1e-9), len(counts) - 1)] += 1
        broad = edges[1] - edges[0]
        ax.bar([edge + broad / 2 for edge in edges[:-1]], counts, width=0.94 * broad, color=tinted(BLUE, 0.55), clip_on=False)
        ax.set_xlim(edges[0], edges[-1])
        top = 1.16 * max(counts)
        ax.set_ylim(0, top)
        ax.plot([self._mean] * 2, [0, top], color=VERMILION, linewidth=2, clip_on=False)
        left = self._mean > edges[0] + 0.7 * (edges[-1] - edges[0])
        ax.annotate(
            f"mean {tick_text(float(f'{self._mean:.4g}'))}",
            (self._mean, top),
            (-6 if left else 6, 0),
            textcoords="offset points",
            ha="right" if left else "left",
            va="top",
            color=shaded(VERMILION, 0.8),
            fontsize=SIZE,
        )


class Share(NamedTuple):
    """A kind: its label, perhaps with mathematics, its share and its colour."""

    label: str
    share: float
    colour: str


@dataclass(frozen=True)
class ShareChart(Chart):
    """The shares of kinds, which are 1 together: a bar for each, one below another.

    Attributes
    ----------
    shares
        The kinds.
    when
        When that is: "at step 12".
    kinds
        What the kinds are called: "stages".
    """

    shares: tuple[Share, ...]
    when: str
    kinds: str = "stages"

    @cached_property
    def text(self) -> str:
        """The kinds with their shares."""
        listed = ", ".join(f"{plain(each.label)} {each.share:.1%}" for each in self.shares)
        return f"frequencies of {len(self.shares)} {self.kinds} {self.when}: {listed}"

    @property
    def height(self) -> int:
        """A row of the same height for each kind."""
        return 60 + 30 * len(self.shares)

    @property
    def margins(self) -> tuple[float, float, float, float]:
        """The labels of the kinds stand to the left."""
        return 24 + max(width(each.label, SIZE) for each in self.shares), 64, 44, 16

    def paint(self, ax: Axes) -> None:
        """Draw the bars, each with its share behind it."""
        set_paper(ax, Axis(""), Axis(f"share {self.when}"))
        ax.grid(visible=False)
        ax.spines["bottom"].set_visible(False)
        places = range(len(self.shares))
        ax.barh(
            places,
            [each.share for each in self.shares],
            height=0.66,
            color=[tinted(each.colour, 0.7) for each in self.shares],
            clip_on=False,
        )
        for place, each in zip(places, self.shares, strict=True):
            ax.annotate(
                f"{each.share:.1%}",
                (each.share, place),
                (6, 0),
                textcoords="offset points",
                va="center",
                color=INK,
                fontsize=SIZE,
            )
        ax.set_yticks(places, [each.label for each in self.shares], fontsize=SIZE)
        ax.set_xticks([])
        ax.set_xlim(0, max(each.share for each in self.shares) or 1)
        ax.set_ylim(len(self.shares) - 0.5, -0.5)
