"""Relaxation of cells under turgor pressure, with edges as springs, until equilibrium (The Algorithmic Beauty of Plants,
sections 7.4 and 7.5.2).

The pressure in a cell is osmotic: a constant divided by its area, in space by its volume. So a cell can be compressed, but its
room cannot vanish. In the plane the pressure pushes each wall outward in proportion to its length; half of the force acts on
either end. On a sphere it does so too, but what would lift a vertex from the sphere is left out, and after each time step the
vertex is put back there. In space it pushes each wall in proportion to its area, and the corners of the wall share the force;
where two cells meet, the difference of their pressures acts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from lsys_kit.arrays import np
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
LEAST_ROOM = 1e-3
"""The least area or volume from which a pressure is computed, so that pressures are finite. A concave cell whose new wall lies
outside of it may stay turned inside out."""


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
SPHERE_FORCES = Forces(rest=0.0, pressure=0.5)
"""The forces on a sphere, which does not grow: walls pull as if they were all too long, so that pressures decide."""
SPACE_FORCES = Forces(rest=1.0, pressure=8.0)
"""The forces in space: with them the edges of a single cell that is a cube have the length 2."""


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

    A cellwork has edges in place of walls, and walls in place of cells.
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


@dataclass(frozen=True)
class SphereTissue(Tissue):
    """The topology of a map on a sphere, of radius 1 around the origin."""


@dataclass(frozen=True)
class SolidTissue(Tissue):
    """The topology of a cellwork: which vertices bound its edges and walls, which walls bound its cells.

    Attributes
    ----------
    cells, walls, signs
        Shape (q,): for each wall of each cell the cell, the wall, and 1 where the corners run counter-clockwise as seen from
        outside of the cell, else -1.
    """

    cells: Integers
    walls: Integers
    signs: Integers


def relax(points: Floats, tissue: Tissue, forces: Forces = DEFAULT_FORCES) -> Iterator[Floats]:
    """The positions of the vertices at first, and after each iteration until they are nearly at rest; an error, if they fly
    apart.

    Their shape is (n, 2), of a map on a sphere and of a cellwork (n, 3).

    >>> square = Tissue(np.array([[0, 1], [1, 2], [2, 3], [3, 0]]), np.arange(4), np.array([0, 4]))
    >>> *_, at_rest = relax(np.array([[0, 1], [1, 1], [1, 0], [0, 0.0]]), square)
    >>> print(np.ptp(at_rest, axis=0).round(3), areas(at_rest, square).round(3))
    [0.279 0.279] [0.078]
    """
    room_of, force_of = _GEOMETRIES[type(tissue)]
    on_sphere = isinstance(tissue, SphereTissue)
    speeds, room = np.zeros_like(points), room_of(points, tissue)
    yield points
    for _ in range(MOST_ITERATIONS):
        push = force_of(points, tissue, room, forces) - forces.damping * speeds
        if on_sphere:
            push -= (push * points).sum(axis=1)[:, None] * points
        pace = TIME_STEP
        while True:
            moved = points + (speeds + push * pace) * pace
            if on_sphere:
                moved = check_bounds(moved) / np.linalg.norm(moved, axis=1)[:, None]
            left = room_of(moved, tissue)
            if pace < SHORTEST_TIME_STEP or ((left > room / 2) | (room < LEAST_ROOM)).all():
                break
            pace /= 2
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


def force(points: Floats, tissue: Tissue, room: Floats, forces: Forces) -> Floats:
    """The force on each vertex, of the walls that end there and the cells around it.

    The two sides of a cell that meet at a corner push it as one side from the corner before to the corner behind would.
    """
    x, y = points.T.copy()
    first, second = tissue.ends.T
    across, up = x[second] - x[first], y[second] - y[first]
    pull = forces.stiffness * (1 - forces.rest / np.maximum(np.sqrt(across**2 + up**2), LEAST_LENGTH))
    push = np.repeat(forces.pressure / np.maximum(room, LEAST_ROOM) / 2, tissue.sizes)
    rising, running = y[tissue.preceding] - y[tissue.following], x[tissue.following] - x[tissue.preceding]
    parts = ((pull * across, push * rising), (pull * up, push * running))
    return np.column_stack(
        [
            np.bincount(tissue.pushed, weights=np.concatenate([pulls, -pulls, pushes]), minlength=len(points))
            for pulls, pushes in parts
        ]
    )


def _force_on_sphere(points: Floats, tissue: Tissue, room: Floats, forces: Forces) -> Floats:
    here, following = points[tissue.corners], points[tissue.following]
    pressures = np.repeat(forces.pressure / np.maximum(room, LEAST_ROOM), tissue.sizes)
    outward = cross((here + following) / 2, following - here) * (pressures / 2)[:, None]
    pushed = np.concatenate([tissue.pushed, tissue.following])
    return _summed(pushed, len(points), *_pulls(points, tissue, forces), outward, outward)


def _force_in_space(points: Floats, tissue: SolidTissue, room: Floats, forces: Forces) -> Floats:
    pressures = forces.pressure / np.maximum(room, LEAST_ROOM)
    net = np.bincount(tissue.walls, weights=tissue.signs * pressures[tissue.cells], minlength=len(tissue.sizes))
    push = np.repeat(area_vectors(points, tissue) * (net / tissue.sizes)[:, None], tissue.sizes, axis=0)
    return _summed(tissue.pushed, len(points), *_pulls(points, tissue, forces), push)


def _pulls(points: Floats, tissue: Tissue, forces: Forces) -> tuple[Floats, Floats]:
    """The forces of springs in space, on the vertices at their beginnings and at their ends."""
    first, second = tissue.ends.T
    along = points[second] - points[first]
    lengths = np.maximum(np.linalg.norm(along, axis=1), LEAST_LENGTH)
    pull = along * (forces.stiffness * (1 - forces.rest / lengths))[:, None]
    return pull, -pull


def _summed(at: Integers, size: int, *pushes: Floats) -> Floats:
    return np.column_stack([np.bincount(at, weights=part, minlength=size) for part in np.concatenate(pushes).T])


def areas(points: Floats, tissue: Tissue) -> Floats:
    """The signed area of each cell, negative if it is turned inside out."""
    x, y = points.T.copy()
    here, there = tissue.corners, tissue.following
    found: Floats = np.add.reduceat(x[there] * y[here] - x[here] * y[there], tissue.starts[:-1]) / 2
    return found


def area_vectors(points: Floats, tissue: Tissue) -> Floats:
    """For each ring of corners in space a vector at right angles to it, as long as its area is large: the corners run
    counter-clockwise around it."""
    sides = cross(points[tissue.corners], points[tissue.following])
    found: Floats = np.add.reduceat(sides, tissue.starts[:-1]) / 2
    return found


def _sphere_areas(points: Floats, tissue: Tissue) -> Floats:
    found: Floats = np.linalg.norm(area_vectors(points, tissue), axis=1)
    return found


def cross(a: Floats, b: Floats) -> Floats:
    """The cross products of rows, many times as fast as those of numpy."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=1)


def volumes(points: Floats, tissue: SolidTissue) -> Floats:
    """The volume of each cell, negative if it is turned inside out."""
    middles = np.add.reduceat(points[tissue.corners], tissue.starts[:-1]) / tissue.sizes[:, None]
    cones = (middles * area_vectors(points, tissue)).sum(axis=1) / 3
    return np.bincount(tissue.cells, weights=tissue.signs * cones[tissue.walls]).astype(np.float64, copy=False)


_GEOMETRIES: Mapping[type[Tissue], tuple[Callable[..., Floats], Callable[..., Floats]]] = {
    Tissue: (areas, force),
    SphereTissue: (_sphere_areas, _force_on_sphere),
    SolidTissue: (volumes, _force_in_space),
}
"""What room cells have, and which forces act on vertices, in the plane, on a sphere and in space."""
