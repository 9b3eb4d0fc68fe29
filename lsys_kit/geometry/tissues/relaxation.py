"""Relaxation of cells under turgor pressure, with walls as springs, until equilibrium (The Algorithmic Beauty of Plants,
section 7.4).

The pressure in a cell is osmotic: a constant divided by the area of the cell. It pushes each wall outward in proportion to the
length of the wall; half of the force acts on either end. So a cell can be compressed, but its area cannot vanish.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import Floats, Integers

TIME_STEP = 0.05
"""The time step of an iteration."""
SHORTEST_TIME_STEP = TIME_STEP / 1_000
"""The shortest time step, taken where a cell would otherwise be turned inside out."""
AT_REST = 1e-6
"""Vertices that move less than this in an iteration are nearly at rest."""
MOST_ITERATIONS = 20_000
"""After this number of iterations a map is taken to be at equilibrium."""
FARTHEST = 1e6
"""Vertices that are farther away than this fly apart: edges are some tenths to some units long."""
LEAST_LENGTH = 1e-9
"""The least length of a wall that has a direction."""
LEAST_AREA = 1e-3
"""The least area from which a pressure is computed, so that pressures are finite. A concave cell whose new wall lies outside of
it may stay turned inside out."""


@dataclass(frozen=True)
class Forces:
    """The forces of cells and walls; with the default values the walls of a single square cell have the length 0.2791.

    Attributes
    ----------
    stiffness
        The spring constant of a wall: force per unit of elongation.
    rest
        The rest length of a wall.
    pressure
        The pressure in a cell of area 1.
    damping
        The damping force on a vertex per unit of its speed. A vertex has mass 1.
    """

    stiffness: float = 1.0
    rest: float = 0.1
    pressure: float = 0.1
    damping: float = 1.0


DEFAULT_FORCES = Forces()
"""The default forces."""


@dataclass(frozen=True)
class Tissue:
    """The topology of a map: which vertices bound its walls and cells.

    Attributes
    ----------
    ends
        Shape (m, 2): the vertices at the ends of each wall.
    corners
        Shape (k,): the vertices around the cells, one cell after another, clockwise.
    starts
        Shape (c + 1,): the index in `corners` of the first corner of each cell; the last is k.
    """

    ends: Integers
    corners: Integers
    starts: Integers

    @cached_property
    def following(self) -> Integers:
        """For each corner the next one around its cell."""
        following = np.roll(self.corners, -1)
        following[self.starts[1:] - 1] = self.corners[self.starts[:-1]]
        return following

    @cached_property
    def preceding(self) -> Integers:
        """For each corner the one before it around its cell."""
        preceding = np.roll(self.corners, 1)
        preceding[self.starts[:-1]] = self.corners[self.starts[1:] - 1]
        return preceding

    @cached_property
    def pushed(self) -> Integers:
        """The vertices on which forces act: at the starts of walls, at their ends, at corners of cells."""
        return np.concatenate([*self.ends.T, self.corners])

    @cached_property
    def sizes(self) -> Integers:
        """For each cell the number of its corners."""
        return np.diff(self.starts)


def relax(points: Floats, tissue: Tissue, forces: Forces = DEFAULT_FORCES) -> Iterator[Floats]:
    """The positions of the vertices at first, and after each iteration until they are nearly at rest.

    Parameters
    ----------
    points
        Shape (n, 2): the initial positions of the vertices.
    tissue, forces
        The topology of the map, and the forces of its cells and walls.

    Raises
    ------
    ModelValueError
        The positions grow beyond all bounds.

    Examples
    --------
    >>> square = Tissue(np.array([[0, 1], [1, 2], [2, 3], [3, 0]]), np.arange(4), np.array([0, 4]))
    >>> *_, at_rest = relax(np.array([[0, 1], [1, 1], [1, 0], [0, 0.0]]), square)
    >>> print(np.ptp(at_rest, axis=0).round(3), areas(at_rest, square).round(3))
    [0.279 0.279] [0.078]
    """
    return until_rest(
        points, forces.damping, lambda at: areas(at, tissue), LEAST_AREA, lambda at, room: force(at, tissue, room, forces)
    )


def until_rest(
    points: Floats,
    damping: float,
    room_at: Callable[[Floats], Floats],
    least: float,
    force_at: Callable[[Floats, Floats], Floats],
) -> Iterator[Floats]:
    """The positions of vertices at first, and after each iteration until they are at rest, in the plane or in space.

    Parameters
    ----------
    points
        The initial positions.
    damping
        By what share of its speed each vertex is braked.
    room_at
        The areas or volumes of the cells for some positions.
    least
        The room below which a cell may be turned inside out.
    force_at
        The forces on the vertices for some positions, and the room that the cells have there.
    """
    speeds, room = np.zeros_like(points), room_at(points)
    yield points
    for _ in range(MOST_ITERATIONS):
        push = force_at(points, room) - damping * speeds
        pace, moved, left = _integrated(points, speeds, push, room, room_at, least)
        speeds = speeds + push * pace
        farthest = max(np.abs(moved - points).max(), np.abs(push).max() * TIME_STEP**2)
        points, room = check_bounds(moved), left
        yield points
        if farthest < AT_REST:
            return


def check_bounds(points: Floats) -> Floats:
    """The same positions, if they are within bounds."""
    if not np.abs(points).max() < FARTHEST:  # which NaN is not
        raise ModelValueError(
            "The relaxation blows up: vertices fly apart instead of coming to rest",
            hint="Make stiffness or pressure smaller, or damping nearer to 1.",
        )
    return points


def with_finished(error: ModelValueError, finished: Sequence[Floats]) -> ModelValueError:
    """The error of a relaxation that blows up, with the positions of the steps before it."""
    step, error.partial = len(finished), finished
    kept = "" if not step else " Step 0 is kept." if step == 1 else f" Steps 0-{step - 1} are kept."
    return error.with_hint(f"This was step {step}.{kept} {error.hint}")


def _integrated(
    points: Floats, speeds: Floats, push: Floats, room: Floats, room_at: Callable[[Floats], Floats], least: float
) -> tuple[float, Floats, Floats]:
    """One time step, short enough that no cell loses more than half of its room: its length, the positions and the room."""
    pace = TIME_STEP
    while True:
        moved = points + (speeds + push * pace) * pace
        left = room_at(moved)
        if pace < SHORTEST_TIME_STEP or ((left > room / 2) | (room < least)).all():
            return pace, moved, left
        pace /= 2


def force(points: Floats, tissue: Tissue, room: Floats, forces: Forces) -> Floats:
    """The force on each vertex, of the walls that end there and the cells around it.

    The two sides of a cell that meet at a corner push it as one side from the corner before to the corner behind would.
    """
    x, y = points.T.copy()
    first, second = tissue.ends.T
    across, up = x[second] - x[first], y[second] - y[first]
    pull = forces.stiffness * (1 - forces.rest / np.maximum(np.sqrt(across**2 + up**2), LEAST_LENGTH))
    push = np.repeat(forces.pressure / np.maximum(room, LEAST_AREA) / 2, tissue.sizes)
    rising, running = y[tissue.preceding] - y[tissue.following], x[tissue.following] - x[tissue.preceding]
    parts = ((pull * across, push * rising), (pull * up, push * running))
    return np.column_stack(
        [
            np.bincount(tissue.pushed, weights=np.concatenate([pulls, -pulls, pushes]), minlength=len(points))
            for pulls, pushes in parts
        ]
    )


def summed_at_vertices(at: Integers, pushes: Floats, size: int) -> Floats:
    """The sum of forces at each vertex."""
    return np.column_stack([np.bincount(at, weights=part, minlength=size) for part in pushes.T])


def areas(points: Floats, tissue: Tissue) -> Floats:
    """The signed area of each cell, negative if it is turned inside out."""
    x, y = points.T.copy()
    here, there = tissue.corners, tissue.following
    found: Floats = np.add.reduceat(x[there] * y[here] - x[here] * y[there], tissue.starts[:-1]) / 2
    return found
