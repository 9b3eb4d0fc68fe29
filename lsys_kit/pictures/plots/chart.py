"""Plots: charts of numbers on white paper (curves, bars, grids), as pictures that a notebook shows and a file keeps."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from math import ceil, floor, inf, isfinite, log10, nan
from statistics import fmean, stdev
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from lsys_kit.budget import Task
from lsys_kit.errors import ModelValueError
from lsys_kit.pictures.formats.notebook import SVGPicture
from lsys_kit.pictures.plots.lettering import literal, mathematics, plain, width
from lsys_kit.pictures.shapes import Drawing, Group
from lsys_kit.pictures.sizes import document
from lsys_kit.pictures.style.colour_values import contrast
from lsys_kit.pictures.style.palette import BLUE, INK, VERMILION, tinted
from lsys_kit.pictures.style.themes import drawn_on, line, text_colour, theme

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


Point: TypeAlias = tuple[float, float]
WIDTH, HEIGHT = 600, 360
"""The size of a plot in pixels."""
SIZE = 14
"""The size of letters in pixels."""
RULE = 0.16
"""The strength of the lines of the grid, which are quiet."""
MOST_TICKS = 7
"""About how many numbers stand along an axis."""
GREATEST = 1e300
"""Greater numbers cannot be plotted."""


class Axis(NamedTuple):
    """An axis: what it measures, perhaps with mathematics (see `lettering`); whether only whole numbers stand along it; whether
    it is logarithmic, so that equal distances are equal factors."""

    label: str
    whole: bool = False
    log: bool = False

    @property
    def title(self) -> str:
        """The label, with a word about a logarithmic scale."""
        return f"{self.label} on a logarithmic scale" if self.log else self.label


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
    def paint(self, ax: Axes, size: float | None = SIZE) -> None:
        """Draw it into axes, with letters of a size; None for axes of somebody's figure, which keep their own look."""


@dataclass(frozen=True)
class Plot(SVGPicture):
    """A plot of a chart."""

    chart: Chart

    @property
    def text(self) -> str:
        return self.chart.text

    def _shown(self, most: int, enlarged: float) -> Drawing:
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
    with Task("The figure was not drawn"), drawn_on(plot.theme):
        plot.chart.paint(ax, None)
    return ax


def _figure(chart: Chart) -> Figure:
    from matplotlib.figure import Figure

    left, right, above, below = chart.margins
    figure = Figure(figsize=(WIDTH / 72, chart.height / 72), dpi=72, facecolor=theme().paper)
    box = (left / WIDTH, below / chart.height, (WIDTH - left - right) / WIDTH, (chart.height - above - below) / chart.height)
    ax = figure.add_axes(box, facecolor=theme().paper)
    for paper in (figure.patch, ax.patch):
        paper.set_visible(not theme().transparent)
    chart.paint(ax)
    return figure


def set_paper(ax: Axes, across: Axis, up: Axis, size: float | None) -> None:
    """Axes without a frame, on paper with quiet lines; the label of the vertical one stands above it, to be read level. In
    somebody's figure labels are where it has them."""
    from matplotlib.ticker import FuncFormatter, MaxNLocator, NullLocator

    ax.grid(axis="y", color=tinted(theme().quiet, RULE), linewidth=1, clip_on=False)
    ax.set_axisbelow(True)
    if size is None:
        ax.set_xlabel(across.label)
        ax.set_ylabel(up.title)
    else:
        for side in ("top", "right", "left"):
            ax.spines[side].set_visible(False)
        ax.spines["bottom"].set(color=theme().quiet, linewidth=1)
        ax.tick_params(length=0, labelsize=size - 1, labelcolor=theme().ink, pad=6)
        _write(ax, size, across.label, (0.5, 0), (0, -26), "center", "top", xycoords="axes fraction")
        _write(ax, size, up.title, (0, 1), (0, 14), "left", "bottom", xycoords="axes fraction")
    for axis, one in ((ax.xaxis, across), (ax.yaxis, up)):
        axis.set_major_locator(MaxNLocator(MOST_TICKS, steps=[1, 2, 5, 10], integer=one.whole, min_n_ticks=1))
        axis.set_minor_locator(NullLocator())
        axis.set_major_formatter(FuncFormatter(lambda value, _: tick_text(value)))


def log_ticks(low: float, high: float, whole: bool = False) -> list[float]:
    """Where numbers stand along a logarithmic axis: powers of ten, 2 and 5 times these where they are few, or round numbers.

    >>> log_ticks(1, 99), log_ticks(0.8, 6), log_ticks(1, 10**9), log_ticks(1, 3, whole=True)
    ([1.0, 2.0, 5.0, 10.0, 20.0, 50.0], [1.0, 2.0, 5.0], [1.0, 100.0, 10000.0, 1000000.0, 100000000.0], [1.0, 2.0, 3.0])
    """
    decades = log10(high / low)
    if decades < LEAST_DECADES:
        step = max(_round_step((high - low) / MOST_TICKS), float(whole))
        return [step * number for number in range(ceil(low / step), floor(high / step) + 1)]
    powers = range(floor(log10(low)), ceil(log10(high)) + 1, max(1, ceil(decades / MOST_TICKS)))
    factors = (1, 2, 5) if decades < FEW_DECADES else (1,)
    return [value for power in powers for factor in factors if low <= (value := factor * 10.0**power) <= high]


LEAST_DECADES, FEW_DECADES = 0.7, 3
"""Over fewer powers of ten numbers along a logarithmic axis are round; over few there are also 2 and 5 times these."""


def _write(
    ax: Axes, size: float | None, text: str, at: Point, away: Point, ha: str, va: str, color: str = "", **choices: Any
) -> None:
    """Write a text some pixels away from a point."""
    choices |= {"color": color or theme().ink, "fontsize": size}
    ax.annotate(text, at, away, textcoords="offset points", ha=ha, va=va, **choices)


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


def finite(values: Sequence[Any], what: str) -> tuple[float, ...]:
    """Numbers as doubles, none of them too great."""
    try:
        found = tuple(map(float, values))
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


ABOVE, BELOW, LEFT = 44, 56, 62
"""The room around the axes, in pixels."""
LABEL_DISTANCE, LEADER = 18, 16
"""Between two labels at the ends of curves, in pixels; how far a line leads to labels of which one has moved from its curve."""
NEAR = 3
"""Curves that are nowhere farther apart, in pixels, are one line to the eye."""
MOST_DOTS = 40
"""A curve of more points has no dots on it."""
DASHES = ("solid", (0, (6, 4)), (0, (2, 4)), (0, (10, 4)), (0, (8, 3, 2, 3)), (0, (3, 3)))
"""How the lines of several curves are broken, so that colour alone says nothing."""


class Curve(NamedTuple):
    """A curve: its points, from left to right; its colour; its name, perhaps with mathematics, if it needs one; whether it is
    drawn thin and pale, as one of many; whether it is nothing but its points, on a curve."""

    points: tuple[Point, ...]
    colour: str
    label: str = ""
    quiet: bool = False
    dots: bool = False


@dataclass(frozen=True)
class CurveChart(Chart):
    """Curves over one axis, perhaps with all lines solid, so that their jumps can be seen."""

    curves: tuple[Curve, ...]
    across: Axis
    up: Axis
    unbroken: bool = False

    @cached_property
    def text(self) -> str:
        (left, right), (_, most) = self._span(0), self._span(1)
        named = [plain(curve.label) for curve in self._drawn if curve.label]
        names = f" ({', '.join(named)})" if named else ""
        many = sum(not curve.dots for curve in self._drawn)
        return (
            f"{many} curve{'s' * (many != 1)}{names} of {plain(self.up.title)}, {plain(self.across.label)} from "
            f"{tick_text(left)} to {tick_text(right)}, largest {tick_text(most)}"
        )

    @cached_property
    def _drawn(self) -> tuple[Curve, ...]:
        """The curves, of which those that are one line to the eye are drawn once."""
        groups: list[list[Curve]] = []
        for curve in self.curves:
            near = (group for group in groups if curve.label and group[0].label and self._one_line(group[0], curve))
            found = next(near, None)
            if found is None:
                groups.append([curve])
            else:
                found.append(curve)
        return tuple(group[0]._replace(label=_common_label(group)) for group in groups)

    def _one_line(self, first: Curve, second: Curve) -> bool:
        """Whether two curves cannot be told apart; on a logarithmic scale wherever both are seen, at most steps."""
        if [x for x, _ in first.points] != [x for x, _ in second.points]:
            return False
        pairs = [(a, b) for (_, a), (_, b) in zip(first.points, second.points, strict=True)]
        seen = [(log10(a), log10(b)) for a, b in pairs if a > 0 and b > 0] if self.up.log else pairs
        low, high = map(log10, self._limits) if self.up.log else self._limits
        near = NEAR * (high - low) / (HEIGHT - ABOVE - BELOW)
        return first.points == second.points or (2 * len(seen) > len(pairs) and all(abs(a - b) <= near for a, b in seen))

    def _span(self, axis: int) -> tuple[float, float]:
        values = [point[axis] for curve in self.curves for point in curve.points]
        return min(values), max(values)

    @property
    def margins(self) -> tuple[float, float, float, float]:
        numbers = log_ticks(*self._limits, self.up.whole) if self.up.log else self._span(1)
        left = max(LEFT, 16 + max((width(tick_text(number), SIZE - 1) for number in numbers), default=0))
        return left, 24 + LEADER * self._led + max((width(curve.label, SIZE) for curve in self._drawn), default=0), ABOVE, BELOW

    def paint(self, ax: Axes, size: float | None = SIZE) -> None:
        """Draw the curves, those of many first."""
        if self.up.log:
            ax.set_yscale("log")
        set_paper(ax, self.across, self.up, size)
        loud = [curve for curve in self._drawn if not (curve.quiet or curve.dots)]
        for curve in self._drawn:
            broken = curve in loud and not self.unbroken
            dashes = DASHES[loud.index(curve) % len(DASHES)] if broken else "none" if curve.dots else "solid"
            self._paint_curve(ax, curve, dashes)
        self._set_limits(ax)
        self._paint_labels(ax, size)

    def _paint_curve(self, ax: Axes, curve: Curve, dashes: object) -> None:
        xs, ys = [x for x, _ in curve.points], [nan if self.up.log and y <= 0 else y for _, y in curve.points]
        if curve.quiet:
            ax.plot(xs, ys, color=line(curve.colour), alpha=0.3, linewidth=1, clip_on=False)
            return
        dots: Any = {"marker": "o" if len(xs) <= MOST_DOTS else None, "markersize": 5, "markeredgewidth": 0}
        dots |= {"label": curve.label} if curve.label else {}
        ax.plot(xs, ys, color=line(curve.colour), linewidth=2, linestyle=dashes, clip_on=False, **dots)

    def _set_limits(self, ax: Axes) -> None:
        """From the first to the last point, and from 0 where that is near."""
        left, right = self._span(0)
        ax.set_xlim((left, right) if left < right else (left - 0.5, left + 0.5))
        ax.set_ylim(*self._limits)
        if self.up.log:
            ax.set_yticks(log_ticks(*self._limits, self.up.whole))

    @cached_property
    def _limits(self) -> tuple[float, float]:
        if self.up.log:
            seen = [y for curve in self.curves for _, y in curve.points if y > 0] or [1.0]
            return min(seen) / 1.2, 1.2 * max(seen)
        least, most = self._span(1)
        bottom = 0.0 if 0 <= least <= most / 2 or least == most >= 0 else least - 0.05 * (most - least)
        return bottom, most + 0.03 * (most - bottom) if most > bottom else bottom + 1

    def _paint_labels(self, ax: Axes, size: float | None) -> None:
        """The names of curves at their ends; in somebody's figure in a legend within the axes."""
        named = [curve for curve in self._drawn if curve.label and curve.points]
        if size is None:
            if named:
                ax.legend()
            return
        room, across = HEIGHT - ABOVE - BELOW, ax.get_position().width * WIDTH
        for curve, end, place in zip(named, *self._places, strict=True):
            if self._led:
                xs, ys = (1 + 6 / across, 1 + (6 + LEADER) / across), (end / room, place / room)
                ax.plot(xs, ys, color=theme().quiet, linewidth=1, transform=ax.transAxes, clip_on=False)
            at, away = (1, place / room), (10 + LEADER * self._led, 0)
            _write(ax, size, curve.label, at, away, "left", "center", text_colour(curve.colour), xycoords="axes fraction")

    @cached_property
    def _places(self) -> tuple[list[float], list[float]]:
        """How high the curves with names end above the axis, and where the names stand, in pixels."""
        low, high = self._limits
        lasts = [curve.points[-1][1] for curve in self._drawn if curve.label and curve.points]
        heights = (
            log10(max(last, low) / low) / log10(high / low) if self.up.log else (last - low) / (high - low) for last in lasts
        )
        ends = [height * (HEIGHT - ABOVE - BELOW) for height in heights]
        return ends, spread(ends, LABEL_DISTANCE, 0)

    @property
    def _led(self) -> bool:
        """Whether lines lead from the curves to their names, as some stand elsewhere."""
        return any(abs(end - place) > LABEL_DISTANCE for end, place in zip(*self._places, strict=True))


def _common_label(curves: Sequence[Curve]) -> str:
    """The names of curves in one line: symbols as F = L, or F ≈ L if they differ a little, with the value that they always
    have; others with commas."""
    first, labels = curves[0], [curve.label for curve in curves]
    values = {y for _, y in first.points}
    if any("=" in label or "$" not in label for label in labels):
        return ", ".join(labels)
    same = all(curve.points == first.points for curve in curves)
    signs = ["=" if curve.points == first.points else "≈" for curve in curves[1:]]
    joined = " ".join((labels[0], *(f"{sign} {label}" for sign, label in sorted(zip(signs, labels[1:], strict=True)))))
    return f"{joined} = {tick_text(*values)}" if same and len(values) == 1 else joined


ROW, BAR, LEAST_BAR = 44, 0.72, 4
"""The height of a row of bars in pixels, and of its highest bar to that of the row; narrower bars stand without gaps."""


@dataclass(frozen=True)
class RowsChart(Chart):
    """Small numbers at each step as bars, a row for each curve with a scale of its own; numbers over the bars where there is
    room."""

    curves: tuple[Curve, ...]
    across: Axis
    up: Axis

    @cached_property
    def text(self) -> str:
        many = len(self.curves)
        names = ", ".join(plain(curve.label) for curve in self.curves if curve.label)
        xs, ys = zip(*(point for curve in self.curves for point in curve.points), strict=True)
        return (
            f"{many} row{'s' * (many != 1)} of bars{names and f' ({names})'} of {plain(self.up.label)}, "
            f"{plain(self.across.label)} from {tick_text(min(xs))} to {tick_text(max(xs))}, largest {tick_text(max(ys))}"
        )

    @property
    def height(self) -> int:
        return ABOVE + BELOW + ROW * len(self.curves)

    @property
    def margins(self) -> tuple[float, float, float, float]:
        left = max(LEFT, 16 + max(width(curve.label, SIZE) for curve in self.curves))
        return left, 24 + max(width(_summary(curve), SIZE - 1) for curve in self.curves), ABOVE, BELOW

    def paint(self, ax: Axes, size: float | None = SIZE) -> None:
        """Draw the rows, the first on top; in somebody's figure the values of each stand beside its name."""
        several = len({max(y for _, y in curve.points) for curve in self.curves}) > 1
        words = f"{self.up.label}, each row on a scale of its own" if several and size is not None else self.up.label
        set_paper(ax, self.across, self.up._replace(label=words), size)
        first, last = (choose(x for curve in self.curves for x, _ in curve.points) for choose in (min, max))
        left, right, _, _ = self.margins
        room = (WIDTH - left - right) / (last - first + 1)
        for row, curve in enumerate(self.curves):
            self._paint_row(ax, size, curve, -row, room)
        ax.set_xlim(first - 0.5, last + 0.5)
        ax.set_ylim(1 - len(self.curves), 1)
        names = [curve.label if size is not None else f"{curve.label} {_summary(curve)}".strip() for curve in self.curves]
        ax.set_yticks([-row for row in range(len(names))], names, va="bottom")

    def _paint_row(self, ax: Axes, size: float | None, curve: Curve, foot: float, room: float) -> None:
        xs, ys = zip(*curve.points, strict=True)
        written = size is not None and room >= 4 + max(width(tick_text(y), SIZE - 3) for y in ys)
        unit = BAR * (0.75 if written else 1) / max(*ys, 1)
        edges = [xs[0] - 0.5, *(x + 0.5 for x in xs)]
        if room < LEAST_BAR:
            ax.stairs([foot + unit * y for y in ys], edges, baseline=foot, fill=True, color=line(curve.colour), linewidth=0)
        else:
            ax.bar(xs, [unit * y for y in ys], 0.8, foot, color=line(curve.colour), linewidth=0, clip_on=False)
        if size is None:
            return
        for x, y in curve.points if written else ():
            _write(ax, size - 3, tick_text(y), (x, foot + unit * y), (0, 1), "center", "bottom")
        _write(ax, size - 1, _summary(curve), (1, foot + 0.1), (10, 0), "left", "bottom", xycoords=("axes fraction", "data"))


def _summary(curve: Curve) -> str:
    """The value of a row that has one, else the range of its values."""
    least, most = (choose(y for _, y in curve.points) for choose in (min, max))
    return f"always {tick_text(most)}" if least == most else f"{tick_text(least)} to {tick_text(most)}"


def spread(places: Sequence[float], distance: float, least: float = -inf) -> list[float]:
    """Places moved apart as little as needed, so that no two are nearer than a distance, and none is less than the least.

    >>> spread([0, 3, 50], 10), spread([0, 3, 50], 10, 0)
    ([-3.5, 6.5, 50.0], [0, 10, 50.0])
    """
    groups: list[tuple[float, int]] = []
    for place in sorted(places):
        groups.append((float(place), 1))
        while len(groups) > 1 and groups[-1][0] - groups[-2][0] < distance * (groups[-1][1] + groups[-2][1]) / 2:
            (first, some), (second, more) = groups[-2:]
            groups[-2:] = [((first * some + second * more) / (some + more), some + more)]
    found = [middle + distance * (number - (many - 1) / 2) for middle, many in groups for number in range(many)]
    for number, place in enumerate(found):
        found[number] = max(place, least if number == 0 else found[number - 1] + distance)
    order = sorted(range(len(places)), key=places.__getitem__)
    return [found[order.index(place)] for place in range(len(places))]


MOST_BARS = 24
"""The most bars of a histogram."""
ENOUGH, SURE = 10, 1.96
"""Of so many runs the mean is sure to so many of its standard deviations, 19 times in 20: as in the panel's sample."""


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
    """A histogram of values, one for each run or whatever is counted, with the mean, a band in which that of all lies 19 times
    in 20, as it does of enough runs, and the exact one where that is known."""

    values: tuple[float, ...]
    across: Axis
    counted: str = "runs"
    exact: float | None = None

    @cached_property
    def text(self) -> str:
        return (
            f"{len(self.values):,} {self.counted}, {plain(self.across.label)}: least {tick_text(min(self.values))}, mean "
            f"{tick_text(float(f'{self._mean:.6g}'))}, greatest {tick_text(max(self.values))}{self._sure}"
        )

    @property
    def _sure(self) -> str:
        """What is said of the mean of all that could be run."""
        low, high, exact = (
            tick_text(float(f"{x:.4g}")) for x in (self._mean - self._off, self._mean + self._off, self.exact or 0)
        )
        band = f"; the mean of all between {low} and {high}, 19 times in 20" if self._off else ""
        return f"{band}; exactly {exact}" if self.exact is not None else band

    @cached_property
    def _off(self) -> float:
        """How far the mean may be from that of all, where enough was run."""
        many = len(self.values) if self.counted == "runs" else 0
        return SURE * stdev(self.values) / many**0.5 if many >= ENOUGH else 0.0

    @property
    def _mean(self) -> float:
        return fmean(self.values)

    @property
    def margins(self) -> tuple[float, float, float, float]:
        return 62, 30, 44, 56

    def paint(self, ax: Axes, size: float | None = SIZE) -> None:
        """Draw a bar for each class."""
        set_paper(ax, self.across, Axis(self.counted, True), size)
        edges = class_edges(self.values)
        counts = [0] * (len(edges) - 1)
        for value in self.values:
            counts[min(int((value - edges[0]) / (edges[1] - edges[0]) + 1e-9), len(counts) - 1)] += 1
        broad = edges[1] - edges[0]
        ax.bar(
            [edge + broad / 2 for edge in edges[:-1]], counts, width=0.94 * broad, color=tinted(line(BLUE), 0.55), clip_on=False
        )
        ax.set_xlim(edges[0], edges[-1])
        top = 1.16 * max(counts)
        ax.set_ylim(0, top)
        ax.plot([self._mean] * 2, [0, top], color=line(VERMILION), linewidth=2, clip_on=False)
        left = self._mean > edges[0] + 0.7 * (edges[-1] - edges[0])
        text, away = f"mean {tick_text(float(f'{self._mean:.4g}'))}", (-6 if left else 6, 0)
        beside, sides = self._mean - self._off if left else self._mean + self._off, ("right" if left else "left", "top")
        _write(ax, size, text, (beside, top), away, *sides, text_colour(VERMILION))
        if self._off:
            ax.bar([self._mean], [0.04 * top], 2 * self._off, 0.96 * top, color=tinted(line(VERMILION), 0.45), clip_on=False)
        if self.exact is not None:
            ax.plot([self.exact] * 2, [0, top], color=line(INK), linewidth=1, linestyle="--", clip_on=False)
            text = f"exactly {tick_text(float(f'{self.exact:.4g}'))}"
            _write(ax, size, text, (beside, 0.92 * top), away, *sides, text_colour(INK))


class Share(NamedTuple):
    """A kind: its label, perhaps with mathematics, its share and its colour."""

    label: str
    share: float
    colour: str


@dataclass(frozen=True)
class ShareChart(Chart):
    """The shares of kinds, which are 1 together, "at step 12" or when that is: a bar for each, one below another."""

    shares: tuple[Share, ...]
    when: str
    kinds: str = "stages"

    @cached_property
    def text(self) -> str:
        listed = ", ".join(f"{plain(each.label)} {each.share:.1%}" for each in self.shares)
        return f"frequencies of {len(self.shares)} {self.kinds} {self.when}: {listed}"

    @property
    def height(self) -> int:
        return 60 + 30 * len(self.shares)

    @property
    def margins(self) -> tuple[float, float, float, float]:
        return 24 + max(width(each.label, SIZE) for each in self.shares), 64, 44, 16

    def paint(self, ax: Axes, size: float | None = SIZE) -> None:
        """Draw the bars, each with its share behind it."""
        label = f"share {self.when}"
        set_paper(ax, Axis("" if size else label), Axis(label if size else ""), size)
        ax.grid(visible=False)
        ax.spines["bottom"].set_visible(False)
        places = range(len(self.shares))
        amounts, fills = [each.share for each in self.shares], [tinted(line(each.colour), 0.7) for each in self.shares]
        ax.barh(places, amounts, height=0.66, color=fills, clip_on=False)
        for place, amount in zip(places, amounts, strict=True):
            _write(ax, size, f"{amount:.1%}", (amount, place), (6, 0), "left", "center")
        ax.set_yticks(places, [each.label for each in self.shares], fontsize=size)
        ax.set_xticks([])
        ax.set_xlim(0, (1.0 if size else 1.25) * max(amounts) or 1)
        ax.set_ylim(len(self.shares) - 0.5, -0.5)


LEAST_ROOM, LEAST_HEIGHT = 34, 18
"""A cell that is narrower or lower, in pixels, holds no number."""


@dataclass(frozen=True)
class GridChart(Chart):
    """A value for each pair of two variables, whose names may have mathematics and whose own values are texts in ascending
    order; the label says what the values are. Where there is none, the cell is empty."""

    across: str
    up: str
    columns: tuple[str, ...]
    rows: tuple[str, ...]
    values: Mapping[tuple[int, int], float]
    label: str

    @cached_property
    def text(self) -> str:
        values = self.values.values()
        least, most = map(number_texts(values), (min(values), max(values)))
        return (
            f"{plain(self.label)} for {plain(self.across)} from {self.columns[0]} to {self.columns[-1]} and "
            f"{plain(self.up)} from {self.rows[0]} to {self.rows[-1]}: {len(values)} values from {least} to {most}"
        )

    @property
    def height(self) -> int:
        return 110 + min(400, max(20, 40 if len(self.rows) <= 10 else 0) * len(self.rows))

    @property
    def margins(self) -> tuple[float, float, float, float]:
        return 24 + max(max(width(text, SIZE) for text in self.rows), 40), 24, 54, 56

    def paint(self, ax: Axes, size: float | None = SIZE) -> None:
        """Draw a square for each pair, the stronger the greater its value."""
        from matplotlib.patches import Rectangle

        write = number_texts(self.values.values())
        low, high = min(self.values.values()), max(self.values.values())
        left, right, above, below = self.margins
        high_enough = (self.height - above - below) / len(self.rows) >= LEAST_HEIGHT
        room = (WIDTH - left - right) / len(self.columns)
        for (column, row), value in self.values.items():
            strength = 0.12 + 0.88 * ((value - low) / (high - low) if high > low else 0.5)
            corner, fill = (column - 0.5, row - 0.5), tinted(line(BLUE), strength)
            ax.add_patch(Rectangle(corner, 1, 1, facecolor=fill, edgecolor=theme().paper, linewidth=2, clip_on=False))
            if room >= max(LEAST_ROOM, width(write(value), SIZE - 1) + 4) and high_enough:
                ink = max((theme().paper, theme().ink), key=partial(contrast, fill))
                ax.annotate(write(value), (column, row), ha="center", va="center", fontsize=SIZE - 1, color=ink)
        self._set_paper(ax, size, ceil_ratio(max(width(text, SIZE - 1) for text in self.columns) + 8, room))

    def _set_paper(self, ax: Axes, size: float | None, every: int) -> None:
        """The values of both variables along the axes, no frame."""
        for side in ("top", "right", "left", "bottom"):
            ax.spines[side].set_visible(False)
        ax.set_xlim(-0.5, len(self.columns) - 0.5)
        ax.set_ylim(-0.5, len(self.rows) - 0.5)
        ax.set_xticks(range(0, len(self.columns), every), self.columns[::every])
        rows_every = ceil_ratio(LEAST_HEIGHT * len(self.rows), self.height - sum(self.margins[2:]))
        ax.set_yticks(range(0, len(self.rows), rows_every), self.rows[::rows_every])
        ax.tick_params(length=0, labelsize=SIZE - 1, labelcolor=theme().ink, pad=6)
        write = partial(_write, ax, size, xycoords="axes fraction")
        write(self.across, (0.5, 0), (0, -26), "center", "top")
        write(self.up, (0, 1), (24 - self.margins[0], 12), "left", "bottom")
        write(self.label, (1, 1), (0, 12), "right", "bottom")


def number_texts(values: Iterable[float]) -> Callable[[float], str]:
    """A function that writes numbers with as many decimals as the greatest has among four digits; none where all are whole.

    >>> write = number_texts([2, 1.41421])
    >>> write(2), write(1.41421), number_texts([2, 30])(2)
    ('2.000', '1.414', '2')
    """
    found = [*values]
    greatest = max(map(abs, found))
    if all(value == floor(value) for value in found) or not 1e-3 <= greatest < 1e4:
        return lambda value: tick_text(float(f"{value:.4g}"))
    return lambda value: f"{value:.{3 - floor(log10(greatest))}f}".replace("-", "\u2212")


def ceil_ratio(needed: float, room: float) -> int:
    """How many cells a text spans.

    >>> ceil_ratio(30, 20), ceil_ratio(10, 20)
    (2, 1)
    """
    return max(1, -int(-needed // room))


class Level(NamedTuple):
    """A curve on which a quantity of two variables has one value: the value, the points of the curve from left to right, points
    that are marked, and whether it is the one that matters most."""

    value: float
    points: tuple[Point, ...]
    marked: tuple[Point, ...] = ()
    loud: bool = False


@dataclass(frozen=True)
class LevelChart(Chart):
    """Curves of equal growth over two variables, each with its growth beside it; the box is the range of both."""

    levels: tuple[Level, ...]
    across: Axis
    up: Axis
    box: tuple[tuple[float, float], tuple[float, float]]

    @cached_property
    def text(self) -> str:
        (left, right), (low, high) = self.box
        values = [level.value for level in self.levels]
        loud = next((f", marked: {level.value:.4g}" for level in self.levels if level.loud), "")
        ranges = (
            f"{plain(axis.label)} from {tick_text(first)} to {tick_text(last)}"
            for axis, first, last in ((self.across, left, right), (self.up, low, high))
        )
        return f"{len(values)} curves of equal growth, {min(values):.4g} to {max(values):.4g}{loud}; {', '.join(ranges)}"

    @property
    def margins(self) -> tuple[float, float, float, float]:
        return LEFT, 60, ABOVE, BELOW

    def paint(self, ax: Axes, size: float | None = SIZE) -> None:
        """Draw the curves, and the growth of each where it is nearest to the diagonal, away from the marked curve."""
        set_paper(ax, self.across, self.up, size)
        (left, right), (low, high) = self.box
        loud = max((level.value for level in self.levels if level.loud), default=inf)
        for level in self.levels:
            colour = line(VERMILION if level.loud else BLUE)
            if level.points:
                xs, ys = zip(*level.points, strict=True)
                ax.plot(xs, ys, color=colour, linewidth=2.4 if level.loud else 1.4, clip_on=False)
                at = min(level.points, key=lambda p: abs((p[0] - left) / (right - left) - (p[1] - low) / (high - low)))
                place = ((-7, -3), "right", "top") if level.value > loud else ((7, 3), "left", "bottom")
                _write(ax, size, f"{level.value:.4g}", at, *place, text_colour(colour))
            for point in level.marked:
                ax.plot(*point, marker="o", color=colour, markersize=7, clip_on=False)
        _write(ax, size, "growth on each curve", (1, 1), (0, 14), "right", "bottom", xycoords="axes fraction")
        ax.set_xlim(left, right)
        ax.set_ylim(low, high)
