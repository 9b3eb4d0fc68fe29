"""A grid of colours and numbers: what comes of each combination of two constants."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from math import floor, log10
from typing import TYPE_CHECKING

from lsys_kit.pictures.plots.chart import SIZE, WIDTH, Chart, tick_text
from lsys_kit.pictures.plots.lettering import plain, width
from lsys_kit.pictures.style.palette import BLUE, INK, PAPER, tinted

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LEAST_ROOM, LEAST_HEIGHT = 34, 18
"""A cell that is narrower or lower, in pixels, holds no number."""
DARK = 0.68
"""From this strength of the colour on numbers are white."""


@dataclass(frozen=True)
class GridChart(Chart):
    """A value for each pair of two variables.

    Attributes
    ----------
    across, up
        The names of the variables, perhaps with mathematics.
    columns, rows
        Their values as text, in ascending order.
    values
        The value in each column and row; where there is none, the cell is empty.
    label
        What the values are.
    """

    across: str
    up: str
    columns: tuple[str, ...]
    rows: tuple[str, ...]
    values: Mapping[tuple[int, int], float]
    label: str

    @cached_property
    def text(self) -> str:
        """What the grid holds."""
        values = self.values.values()
        least, most = map(number_texts(values), (min(values), max(values)))
        return (
            f"{plain(self.label)} for {plain(self.across)} from {self.columns[0]} to {self.columns[-1]} and "
            f"{plain(self.up)} from {self.rows[0]} to {self.rows[-1]}: {len(values)} values from {least} to {most}"
        )

    @property
    def height(self) -> int:
        """Rows of the same height."""
        return 110 + min(400, max(20, 40 if len(self.rows) <= 10 else 0) * len(self.rows))

    @property
    def margins(self) -> tuple[float, float, float, float]:
        """The values of the vertical variable stand to the left."""
        return 24 + max(max(width(text, SIZE) for text in self.rows), 40), 24, 54, 56

    def paint(self, ax: Axes) -> None:
        """Draw a square for each pair, the stronger the greater its value."""
        from matplotlib.patches import Rectangle

        write = number_texts(self.values.values())
        low, high = min(self.values.values()), max(self.values.values())
        left, right, above, below = self.margins
        high_enough = (self.height - above - below) / len(self.rows) >= LEAST_HEIGHT
        room = (WIDTH - left - right) / len(self.columns)
        for (column, row), value in self.values.items():
            strength = 0.12 + 0.88 * ((value - low) / (high - low) if high > low else 0.5)
            ax.add_patch(
                Rectangle(
                    (column - 0.5, row - 0.5),
                    1,
                    1,
                    facecolor=tinted(BLUE, strength),
                    edgecolor=PAPER,
                    linewidth=2,
                    clip_on=False,
                )
            )
            if room >= max(LEAST_ROOM, width(write(value), SIZE - 1) + 4) and high_enough:
                ax.annotate(
                    write(value),
                    (column, row),
                    ha="center",
                    va="center",
                    fontsize=SIZE - 1,
                    color=PAPER if strength > DARK else INK,
                )
        self._set_paper(ax, ceil_ratio(max(width(text, SIZE - 1) for text in self.columns) + 8, room))

    def _set_paper(self, ax: Axes, every: int) -> None:
        """The values of both variables along the axes, no frame."""
        for side in ("top", "right", "left", "bottom"):
            ax.spines[side].set_visible(False)
        ax.set_xlim(-0.5, len(self.columns) - 0.5)
        ax.set_ylim(-0.5, len(self.rows) - 0.5)
        ax.set_xticks(range(0, len(self.columns), every), self.columns[::every])
        rows_every = ceil_ratio(LEAST_HEIGHT * len(self.rows), self.height - sum(self.margins[2:]))
        ax.set_yticks(range(0, len(self.rows), rows_every), self.rows[::rows_every])
        ax.tick_params(length=0, labelsize=SIZE - 1, labelcolor=INK, pad=6)
        write = partial(ax.annotate, xycoords="axes fraction", textcoords="offset points", color=INK, fontsize=SIZE)
        write(self.across, (0.5, 0), (0, -26), ha="center", va="top")
        write(self.up, (0, 1), (24 - self.margins[0], 12), ha="left", va="bottom")
        write(self.label, (1, 1), (0, 12), ha="right", va="bottom")


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
