"""Plots: a chart of numbers on white paper, as a picture that a notebook shows and a file keeps."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from typing import TYPE_CHECKING, NamedTuple

from lsys_kit.budget import Task
from lsys_kit.errors import ModelValueError
from lsys_kit.pictures.formats.notebook import SVGPicture
from lsys_kit.pictures.plots.lettering import literal, mathematics
from lsys_kit.pictures.shapes import Drawing, Group
from lsys_kit.pictures.sizes import document
from lsys_kit.pictures.style.palette import INK, PAPER, QUIET

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDTH, HEIGHT = 600, 360
"""The size of a plot in pixels."""
SIZE = 14
"""The size of letters in pixels."""
RULE = "#E3E8EC"
"""The lines of the grid."""
MOST_TICKS = 7
"""About how many numbers stand along an axis."""
GREATEST = 1e300
"""Greater numbers cannot be plotted."""


class Axis(NamedTuple):
    """An axis.

    Attributes
    ----------
    label
        What it measures, perhaps with mathematics (see `lettering`).
    whole
        Whether only whole numbers stand along it.
    log
        Whether it is logarithmic: equal distances are equal factors.
    """

    label: str
    whole: bool = False
    log: bool = False


class Chart(ABC):
    """What a plot shows."""

    @property
    @abstractmethod
    def text(self) -> str:
        """What is to be seen, in a line."""

    @property
    @abstractmethod
    def margins(self) -> tuple[float, float, float, float]:
        """The room to the left and right of the axes, above and below them, in pixels."""

    @property
    def height(self) -> int:
        """The height of the picture in pixels."""
        return HEIGHT

    @abstractmethod
    def paint(self, ax: Axes) -> None:
        """Draw it into axes."""


@dataclass(frozen=True)
class Plot(SVGPicture):
    """A plot.

    Attributes
    ----------
    chart
        What it shows.
    """

    chart: Chart

    @property
    def text(self) -> str:
        """What the plot shows, in words."""
        return self.chart.text

    def shown(self, most: int, enlarged: float) -> Drawing:
        """The chart with its axes."""
        with Task("The plot was not drawn"):
            return document([self._shapes], WIDTH, self.chart.height, self.text)

    @cached_property
    def _shapes(self) -> Group:
        from lsys_kit.pictures.plots.renderer import shapes_of

        return shapes_of(_figure(self.chart), WIDTH, self.chart.height)

    def __repr__(self) -> str:
        return self.text


def painted(plot: Plot, ax: Axes) -> Axes:
    """The axes with a plot drawn into them."""
    with Task("The figure was not drawn"):
        plot.chart.paint(ax)
    return ax


def _figure(chart: Chart) -> Figure:
    """A figure with a chart, in which a point is a pixel."""
    from matplotlib.figure import Figure

    left, right, above, below = chart.margins
    figure = Figure(figsize=(WIDTH / 72, chart.height / 72), dpi=72, facecolor=PAPER)
    box = (left / WIDTH, below / chart.height, (WIDTH - left - right) / WIDTH, (chart.height - above - below) / chart.height)
    chart.paint(figure.add_axes(box))
    return figure


def set_paper(ax: Axes, across: Axis, up: Axis) -> None:
    """Axes without a frame, on paper with quiet lines; the label of the vertical one stands above it, to be read level."""
    for side in ("top", "right", "left"):
        ax.spines[side].set_visible(False)
    ax.spines["bottom"].set(color=QUIET, linewidth=1)
    ax.grid(axis="y", color=RULE, linewidth=1, clip_on=False)
    ax.set_axisbelow(True)
    ax.tick_params(length=0, labelsize=SIZE - 1, labelcolor=INK, pad=6)
    ax.annotate(
        across.label,
        (0.5, 0),
        (0, -26),
        xycoords="axes fraction",
        textcoords="offset points",
        ha="center",
        va="top",
        color=INK,
        fontsize=SIZE,
    )
    ax.annotate(
        up.label,
        (0, 1),
        (0, 14),
        xycoords="axes fraction",
        textcoords="offset points",
        ha="left",
        va="bottom",
        color=INK,
        fontsize=SIZE,
    )
    for axis, one in ((ax.xaxis, across), (ax.yaxis, up)):
        _set_ticks(axis, one)


def _set_ticks(axis: object, one: Axis) -> None:
    """Round numbers along an axis, written as in a text."""
    from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator

    locator = (
        LogLocator(numticks=MOST_TICKS)
        if one.log
        else MaxNLocator(MOST_TICKS, steps=[1, 2, 5, 10], integer=one.whole, min_n_ticks=1)
    )
    axis.set_major_locator(locator)  # type: ignore[attr-defined]
    axis.set_minor_locator(NullLocator())  # type: ignore[attr-defined]
    axis.set_major_formatter(FuncFormatter(lambda value, _: tick_text(value)))  # type: ignore[attr-defined]


def tick_text(value: float) -> str:
    """A number beside an axis or in a line of text: of large ones the thousands are set apart, great ones are powers of ten.

    >>> tick_text(12000), tick_text(0.30000000000000004), tick_text(-1.5), tick_text(3e9)
    ('12,000', '0.3', '\u22121.5', '3·10⁹')
    """
    if value and not 1e-4 <= abs(value) < 1e7:
        digits, power = f"{value:.3g}".split("e") if "e" in f"{value:.3g}" else (f"{value / 1e7:.3g}", "7")
        raised = str(int(power)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
        return f"{digits}·10{raised}".removeprefix("1·").replace("-", "\u2212")
    return f"{value:,.6g}".replace("-", "\u2212") if abs(value) < 1e6 else f"{value:,.0f}".replace("-", "\u2212")


def finite(values: Sequence[object], what: str) -> tuple[float, ...]:
    """Numbers as doubles.

    Raises
    ------
    ModelValueError
        One is too great, or no number.
    """
    try:
        found = tuple(map(float, values))  # type: ignore[arg-type]
    except OverflowError:
        found = (float("inf"),)
    if not all(isfinite(value) and abs(value) < GREATEST for value in found):
        raise ModelValueError(f"{what} has values that are too great to plot, or no numbers", hint="Take fewer steps.")
    return found


def name_label(name: str) -> str:
    """A name from a model as a label: a letter or a word as mathematics, with its subscript.

    >>> name_label("t_div"), name_label("height of it")
    ('$\\\\mathit{t}_{\\\\mathrm{div}}$', 'height of it')
    """
    letter, _, subscript = name.partition("_")
    return mathematics(letter, subscript) if letter.isalnum() and letter.isascii() else literal(name)
