"""Labels: what the turtle has written, each at a point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Labels:
    """Short texts at points.

    Attributes
    ----------
    points
        Shape (n, 2) or (n, 3): where the turtle wrote each.
    texts
        What it wrote.
    states
        Shape (n,): the state of the module of each.
    """

    points: NDArray[np.float64]
    texts: tuple[str, ...]
    states: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.texts)


def no_labels(dimension: int = 2) -> Labels:
    """No labels."""
    return Labels(np.empty((0, dimension)), (), np.empty(0, np.int64))
