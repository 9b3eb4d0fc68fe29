"""Where the cells of a map are at rest: relaxation leads close to it, Newton's method on to where all forces balance.

The forces of walls and cells are the slopes of an energy: a wall stores half its stiffness times the square of its elongation,
a cell the logarithm of its area. At rest the energy is least; its second derivatives (the Hessian matrix) say how far that is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from lsys_kit.arrays import np
from lsys_kit.budget import counted
from lsys_kit.geometry.scene import Floats
from lsys_kit.geometry.tissues.relaxation import (
    DEFAULT_FORCES,
    LEAST_LENGTH,
    LEAST_ROOM,
    MOST_ITERATIONS,
    Forces,
    Tissue,
    areas,
    force,
    relax,
)

if TYPE_CHECKING:
    from scipy.sparse import csr_array

BALANCED = 1e-10
"""Forces smaller than this on every vertex balance; a wall pulls with some tenths."""
MOST_NEWTON_STEPS = 12
"""Newton's method doubles the number of right digits in a step: from three of them on it needs three or four steps."""
FARTHEST_STEP = 0.05
"""Newton's method goes no farther than this in a step, so that it finds the equilibrium that is near and no other."""
MOST_ENTRIES = 4_000_000
"""A cell of n walls fills so many as (2 n)^2 entries of the matrix: Newton's method is not for cells of thousands of walls."""
STEADYING = 1e-9
"""The stiffness that is added in all directions, since no force keeps a map as a whole from being moved and turned."""


class Equilibrium(NamedTuple):
    """Where a relaxation ends: the positions of the vertices, shape (n, 2); the number of iterations; and whether the vertices
    are at rest there. If not, they still moved after the last iteration.
    """

    points: Floats
    iterations: int
    settled: bool


def equilibrium(points: Floats, tissue: Tissue, forces: Forces = DEFAULT_FORCES) -> Equilibrium:
    """Where vertices come to rest; an error, if they never do and fly apart.

    >>> square = Tissue(np.array([[0, 1], [1, 2], [2, 3], [3, 0]]), np.arange(4), np.array([0, 4]))
    >>> points, iterations, settled = equilibrium(np.array([[0, 1], [1, 1], [1, 0], [0, 0.0]]), square)
    >>> print(iterations, settled, areas(points, square)[0].round(9), round(((0.1 + 0.21**0.5) / 2)**2, 9))
    317 True 0.077912878 0.077912878
    """
    iterations = -1
    for _, near in zip(range(MOST_ITERATIONS + 1), counted(relax(points, tissue, forces), 1), strict=False):
        points, iterations = near, iterations + 1
    balanced = _balanced(points, tissue, forces)
    if balanced is not None:
        return Equilibrium(balanced, iterations, True)
    return Equilibrium(points, iterations, iterations < MOST_ITERATIONS)


def _balanced(points: Floats, tissue: Tissue, forces: Forces) -> Floats | None:
    """The positions near some others where all forces balance (Newton's method), or None if they are not found."""
    from scipy.sparse import eye_array  # imported late: it takes longer to load than the kit
    from scipy.sparse.linalg import spsolve

    if np.sum((2 * tissue.sizes.astype(np.float64)) ** 2) > MOST_ENTRIES:
        return None
    for _ in range(MOST_NEWTON_STEPS):
        room = areas(points, tissue)
        push = force(points, tissue, room, forces)
        if np.abs(push).max() < BALANCED:
            return points
        if room.min() < LEAST_ROOM:
            return None
        hessian = wall_hessian(points, tissue, forces) + cell_hessian(points, room, tissue, forces)
        step: Floats = spsolve((hessian + STEADYING * eye_array(points.size)).tocsc(), push.ravel()).reshape(-1, 2)
        if not np.abs(step).max() < FARTHEST_STEP:  # which NaN is not
            return None
        points = points + step
    return None


def wall_hessian(points: Floats, tissue: Tissue, forces: Forces) -> csr_array:
    """The second derivatives of the energy of walls; x and y of each vertex in turn."""
    from scipy.sparse import bsr_array, coo_array, kron

    along = points[tissue.ends[:, 1]] - points[tissue.ends[:, 0]]
    lengths, walls = np.maximum(np.hypot(*along.T), LEAST_LENGTH), np.arange(len(along))
    slack = (forces.rest / lengths)[:, None, None]
    ways = along / lengths[:, None]
    blocks = forces.stiffness * ((1 - slack) * np.eye(2) + slack * ways[:, :, None] * ways[:, None, :])
    signs = np.repeat([-1.0, 1.0], len(walls))
    apart = coo_array((signs, (np.tile(walls, 2), tissue.ends.T.ravel())), shape=(len(walls), len(points)))
    across = kron(apart, np.eye(2), "csr")
    return across.T @ bsr_array((blocks, walls, np.arange(len(walls) + 1))) @ across


def cell_hessian(points: Floats, room: Floats, tissue: Tissue, forces: Forces) -> csr_array:
    """The second derivatives of the energy of cells, minus the pressure at area 1 times the logarithm of the area."""
    from scipy.sparse import coo_array, kron

    cell = np.repeat(np.arange(len(room)), tissue.sizes)
    here, there, before = tissue.corners, tissue.following, tissue.preceding
    (x, y), many = points.T, len(points)
    slopes = np.concatenate([y[before] - y[there], x[there] - x[before]]) / 2
    axes = np.concatenate([2 * here, 2 * here + 1])
    gradient = coo_array((slopes, (np.tile(cell, 2), axes)), shape=(len(room), 2 * many)).tocsr()
    pressures = forces.pressure / room
    half = coo_array((pressures[cell] / 2, (there, here)), shape=(many, many)).tocsr()
    mixed = kron(half - half.T, np.array([[0, 1], [-1, 0]]))
    return gradient.T @ gradient.multiply((pressures / room)[:, None]) - mixed
