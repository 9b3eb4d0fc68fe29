"""Relaxation: cells press on their walls, walls pull like springs, until all are at rest (The Algorithmic Beauty of Plants,
section 7.4).

The pressure in a cell is that of a dissolved substance, a constant divided by the cell's area. It pushes each wall outward, in
proportion to the wall's length; half of the push goes to either end. So a cell can be squeezed, but never to nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lsys_kit.geometry.scene import Floats, Integers

TIME_STEP = 0.05
"""The time of one iteration."""
SHORTEST_TIME_STEP = TIME_STEP / 1_000
"""That of an iteration in which a cell would else be turned inside out."""
AT_REST = 1e-6
"""Vertices that move less in an iteration are at rest."""
MOST_ITERATIONS = 20_000
"""After so many iterations a map is taken to be at rest."""
LEAST_AREA = 1e-3
"""The area that a cell is taken to have where it has less, so that pressures are finite. A cell that a new wall divides outside
of it, because it is concave, may stay turned inside out."""


@dataclass(frozen=True)
class Forces:
    """How strong cells and walls are; with these values a single square cell has walls of length 0.2791.

    Attributes
    ----------
    stiffness
        The force of a wall, for each unit that it is longer than at rest.
    rest
        The length of a wall that does not pull.
    pressure
        The pressure in a cell of area 1.
    damping
        The force that slows a vertex, for each unit of its speed. A vertex has the mass 1.
    """

    stiffness: float = 1.0
    rest: float = 0.1
    pressure: float = 0.1
    damping: float = 1.0


DEFAULT_FORCES = Forces()
"""The forces where nothing is said."""


@dataclass(frozen=True)
class Tissue:
    """What is connected with what.

    Attributes
    ----------
    ends
        Shape (m, 2): the vertices at the ends of each wall.
    corners
        Shape (k,): the vertices around the cells, one cell after another, clockwise.
    starts
        Shape (c + 1,): where each cell begins in `corners`; the last is k.
    """

    ends: Integers
    corners: Integers
    starts: Integers

    @property
    def following(self) -> Integers:
        """For each corner the next one around its cell."""
        following = np.roll(self.corners, -1)
        following[self.starts[1:] - 1] = self.corners[self.starts[:-1]]
        return following


def relax(points: Floats, tissue: Tissue, forces: Forces = DEFAULT_FORCES) -> Iterator[Floats]:
    """The vertices at first, and after each iteration until they are at rest.

    Parameters
    ----------
    points
        Shape (n, 2): where the vertices are at first.
    tissue, forces
        What is connected with what, and how strongly.

    Examples
    --------
    >>> square = Tissue(np.array([[0, 1], [1, 2], [2, 3], [3, 0]]), np.arange(4), np.array([0, 4]))
    >>> *_, at_rest = relax(np.array([[0, 1], [1, 1], [1, 0], [0, 0.0]]), square)
    >>> print(np.ptp(at_rest, axis=0).round(3), areas(at_rest, square).round(3))
    [0.279 0.279] [0.078]
    """
    speeds, following = np.zeros_like(points), tissue.following
    room = areas(points, tissue)
    yield points
    for _ in range(MOST_ITERATIONS):
        push = force(points, tissue, following, room, forces) - forces.damping * speeds
        pace, moved, left = _integrated(points, speeds, push, tissue, room)
        speeds = speeds + push * pace
        farthest = max(np.abs(moved - points).max(), np.abs(push).max() * TIME_STEP**2)
        points, room = moved, left
        yield points
        if farthest < AT_REST:
            return


def _integrated(points: Floats, speeds: Floats, push: Floats, tissue: Tissue, room: Floats) -> tuple[float, Floats, Floats]:
    """The vertices a moment later, so short that no cell loses more than half of its area: the moment, they, and the areas."""
    pace = TIME_STEP
    while True:
        moved = points + (speeds + push * pace) * pace
        left = areas(moved, tissue)
        if pace < SHORTEST_TIME_STEP or ((left > room / 2) | (room < LEAST_AREA)).all():
            return pace, moved, left
        pace /= 2


def force(points: Floats, tissue: Tissue, following: Integers, room: Floats, forces: Forces) -> Floats:
    """The force on each vertex: of the walls that end there, and of the cells that have it as a corner."""
    first, second = tissue.ends.T
    along = points[second] - points[first]
    lengths = np.hypot(*along.T)
    pull = along * (forces.stiffness * (1 - forces.rest / np.maximum(lengths, 1e-9)))[:, None]
    sides = points[following] - points[tissue.corners]
    pressures = forces.pressure / np.maximum(room, LEAST_AREA)
    outward = np.column_stack([-sides[:, 1], sides[:, 0]]) * np.repeat(pressures, np.diff(tissue.starts))[:, None] / 2
    return (_summed_at_vertices(first, pull, len(points)) - _summed_at_vertices(second, pull, len(points))
            + _summed_at_vertices(tissue.corners, outward, len(points)) + _summed_at_vertices(following, outward, len(points)))


def _summed_at_vertices(at: Integers, pushes: Floats, size: int) -> Floats:
    """The sum of the pushes at each vertex."""
    return np.column_stack([np.bincount(at, weights=part, minlength=size) for part in pushes.T])


def areas(points: Floats, tissue: Tissue) -> Floats:
    """The area of each cell, negative for one that is turned inside out."""
    x, y = points[tissue.corners].T
    beyond, above = points[tissue.following].T
    found: Floats = np.add.reduceat(beyond * y - x * above, tissue.starts[:-1]) / 2
    return found
