"""Lines on a grid of points: which points lie on them, and what is near to those.

Lines of any number are rasterised at once, and then dilated to their width.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lsys_kit.budget import check_budget, counted

Coordinates: TypeAlias = NDArray[np.floating[Any]]
Grid: TypeAlias = NDArray[np.int32]
STROKES_AT_A_TIME, POINTS_AT_A_TIME = 2**16, 2**18
"""Strokes are rasterised in blocks of at most so many strokes and points, which stay in the cache of the processor between two
operations; a longer stroke is a block of its own."""


def touched(across: Coordinates, down: Coordinates, shape: tuple[int, ...], numbers: Grid | None = None) -> NDArray[Any]:
    """The points of a grid that lie on strokes, given the columns and rows of their ends.

    If each stroke has a number, in ascending order, a point gets that of the last stroke on which it lies.

    >>> across, down = np.array([[0.5, 2.5], [1.5, 1.5]], np.float32), np.array([[0.5, 0.5], [0.5, 1.5]], np.float32)
    >>> touched(across[:1], down[:1], (2, 4)).astype(int).tolist()
    [[1, 1, 1, 0], [0, 0, 0, 0]]
    >>> touched(across, down, (2, 4), np.array([5, 7])).tolist()
    [[5, 7, 5, 0], [0, 7, 0, 0]]
    """
    found = np.zeros(shape[0] * shape[1], dtype=bool if numbers is None else np.int32)
    for first in range(0, len(across), STROKES_AT_A_TIME):
        x, y = across[first : first + STROKES_AT_A_TIME], down[first : first + STROKES_AT_A_TIME]
        wide, high = x[:, 1] - x[:, 0], y[:, 1] - y[:, 0]
        steps = np.ceil(np.maximum(np.abs(wide), np.abs(high))).astype(np.int32)
        np.maximum(steps, 1, out=steps)
        for some in _blocks(steps + 1):
            check_budget()
            counts = steps[some] + 1
            along = np.arange(int(counts.sum()), dtype=np.int32) - np.repeat(np.cumsum(counts) - counts, counts)
            column = (np.repeat(x[some, 0], counts) + np.repeat(wide[some] / steps[some], counts) * along).astype(np.int32)
            row = (np.repeat(y[some, 0], counts) + np.repeat(high[some] / steps[some], counts) * along).astype(np.int32)
            here = True if numbers is None else np.repeat(numbers[first : first + STROKES_AT_A_TIME][some], counts)
            found[row * shape[1] + column] = here
    return found.reshape(shape)


def _blocks(counts: NDArray[np.integer[Any]]) -> Iterator[slice]:
    """Stretches of strokes that have few points together."""
    ends = np.cumsum(counts, dtype=np.int64)
    first = 0
    while first < len(counts):
        before = ends[first - 1] if first else 0
        after = max(first + 1, int(np.searchsorted(ends, before + POINTS_AT_A_TIME, side="right")))
        yield slice(first, after)
        first = after


def spread(found: NDArray[Any], radius: float) -> NDArray[Any]:
    """The dilation of a set of points of a grid by a disc of a given radius; of numbers, the greatest in each disc.

    >>> spread(np.array([[0, 0, 0], [0, 1, 0], [0, 0, 0]], dtype=bool), 1).astype(int).tolist()
    [[0, 1, 0], [1, 1, 1], [0, 1, 0]]
    >>> spread(np.array([[0, 0, 5, 7]]), 1).tolist()
    [[0, 5, 7, 7]]
    >>> spread(np.array([[1], [0], [0], [0]]), 5).ravel().tolist()  # a disc larger than the grid
    [1, 1, 1, 1]
    """
    row, side, whole, height = found.copy(), 0, np.zeros_like(found), len(found)  # the row is dilated to both sides
    for up in counted(range(min(int(radius), height - 1), -1, -1), 1):
        while side < int((radius * radius - up * up) ** 0.5):
            side += 1
            np.maximum(row[:, side:], found[:, :-side], out=row[:, side:])
            np.maximum(row[:, :-side], found[:, side:], out=row[:, :-side])
        np.maximum(whole[up:], row[: height - up], out=whole[up:])
        np.maximum(whole[: height - up], row[up:], out=whole[: height - up])
    return whole
