"""Scenes: what there is to see, as arrays of plain shapes, each with the module that it came from.

Lengths are in the model's units, x grows to the right and y upwards. A scene knows no screen, no colour and no file.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
Integers: TypeAlias = NDArray[np.int64]


@dataclass(frozen=True)
class Segments:
    """Straight strokes.

    Attributes
    ----------
    ends
        Shape (n, 4): x and y of the start, x and y of the end.
    orders
        Shape (n,): in how many brackets each stands; the branch order.
    states
        Shape (n,): the state of the module that drew it.
    """

    ends: Floats
    orders: Integers
    states: Integers

    def __len__(self) -> int:
        return len(self.ends)


@dataclass(frozen=True)
class Cells:
    """Cells of a filament: ellipses in a row.

    Attributes
    ----------
    centres
        Shape (n, 2).
    sizes
        Shape (n, 2): length along the filament, and width.
    polarities
        Shape (n,): -1 for a cell that points left, 1 for one that points right.
    shades
        Shape (n,): 0 for a young cell to 1 for an old one.
    states
        Shape (n,): the state of the module that it is.
    """

    centres: Floats
    sizes: Floats
    polarities: Integers
    shades: Floats
    states: Integers

    def __len__(self) -> int:
        return len(self.centres)


@dataclass(frozen=True)
class Scene:
    """All shapes of one word."""

    segments: Segments
    cells: Cells

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Least x, least y, greatest x, greatest y; zeros where there is nothing."""
        ends = self.segments.ends.reshape(-1, 2)
        half = self.cells.sizes / 2
        points = np.concatenate([ends, self.cells.centres - half, self.cells.centres + half])
        if not len(points):
            return 0.0, 0.0, 0.0, 0.0
        (left, bottom), (right, top) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        return left, bottom, right, top

    @property
    def width(self) -> float:
        """From the least x to the greatest, in the model's units."""
        left, _, right, _ = self.box
        return right - left

    @property
    def height(self) -> float:
        """From the least y to the greatest, in the model's units."""
        _, bottom, _, top = self.box
        return top - bottom

    def __str__(self) -> str:
        """What there is, in words: the line that stands for a picture where there is none."""
        kinds = ((self.segments, "segment"), (self.cells, "cell"))
        counted = [f"{len(shapes):,} {name}{'s' * (len(shapes) != 1)}" for shapes, name in kinds if len(shapes)]
        return f"{', '.join(counted) or 'nothing to draw'}, width {_short(self.width)}, height {_short(self.height)}"


def _short(length: float) -> str:
    """A length with at most two decimals; a rounding error of the last bits does not show."""
    return f"{length + 1e-9:.2f}".rstrip("0").rstrip(".")


NO_SEGMENTS = Segments(np.empty((0, 4)), np.empty(0, np.int64), np.empty(0, np.int64))
NO_CELLS = Cells(np.empty((0, 2)), np.empty((0, 2)), np.empty(0, np.int64), np.empty(0), np.empty(0, np.int64))
