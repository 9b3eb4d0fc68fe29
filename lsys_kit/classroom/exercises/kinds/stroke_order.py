"""Two drawings stroke by stroke, in the order in which they are drawn: how far one lies upon the other."""

from __future__ import annotations

import numpy as np

from lsys_kit.budget import check_budget
from lsys_kit.geometry.scene import Floats

NEAR = 1e-4
"""How far a stroke may be beside another, where the first stroke is 1 long."""


def strokes_that_fit(mine: Floats, wanted: Floats) -> int:
    """How many of the first strokes of a drawing lie on another one, if its first stroke lies on that one's first.

    Strokes are rows x, y of their beginning and of their end; those that follow one another straight on count as one line.

    >>> bent, straight = np.array([[0.0, 0, 0, 1], [0, 1, 1, 1]]), np.array([[0.0, 0, 0, 1], [0, 1, 0, 2], [0, 2, 1, 2]])
    >>> strokes_that_fit(bent, straight), strokes_that_fit(straight, straight), strokes_that_fit(straight[:1], bent)
    (1, 3, 1)
    """
    own, other = _from_the_first(mine), _from_the_first(wanted)
    for number, stroke in enumerate(own):
        check_budget()
        if not _lies_on(stroke, other):
            return number
    return len(own)


def _from_the_first(ends: Floats) -> Floats:
    """Strokes as they stand to the first: it leads from 0 to 1; shape (n, 2), complex."""
    points = ends[:, 0::2] + 1j * ends[:, 1::2]
    start, end = points[0]
    return np.asarray((points - start) / ((end - start) or 1))


def _lies_on(stroke: Floats, others: Floats) -> bool:
    """Whether a stroke is covered by others, from its beginning to its end."""
    start, end = stroke
    length = abs(end - start)
    if length < NEAR:
        return True
    along = (others - start) / (end - start)
    straight = np.abs(along.imag).max(axis=1) * length < NEAR
    spans = np.sort(along.real[straight], axis=1)
    reached = 0.0
    for low, high in spans[np.argsort(spans[:, 0])]:
        if low * length > reached * length + NEAR:
            break
        reached = max(reached, float(high))
    return bool(reached * length >= length - NEAR)
