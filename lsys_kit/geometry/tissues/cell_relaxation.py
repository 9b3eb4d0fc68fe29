"""Relaxation of cells in space under turgor pressure, with edges as springs, until equilibrium (The Algorithmic Beauty of
Plants, section 7.5.2).

The pressure in a cell is osmotic: a constant divided by the volume of the cell. It pushes each wall outward in proportion to
the area of the wall; its corners share the force. Where two cells meet, the difference of their pressures acts.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lsys_kit.geometry.scene import Floats, Integers
from lsys_kit.geometry.tissues.relaxation import Forces, summed_at_vertices, until_rest

SPACE_FORCES = Forces(rest=1.0, pressure=8.0)
"""The forces in space: with them the edges of a single cell that is a cube have the length 2."""
LEAST_VOLUME = 1e-3
"""The least volume from which a pressure is computed, so that pressures are finite."""


@dataclass(frozen=True)
class SolidTissue:
    """The topology of a cellwork: which vertices bound its edges and walls, which walls bound its cells.

    Attributes
    ----------
    ends
        Shape (m, 2): the vertices at the ends of each edge.
    corners
        Shape (k,): the vertices around the walls, one wall after another.
    starts
        Shape (w + 1,): the index in `corners` of the first corner of each wall; the last is k.
    cells, walls, signs
        Shape (q,): for each wall of each cell the cell, the wall, and 1 where the corners run counter-clockwise as seen from
        outside of the cell, else -1.
    """

    ends: Integers
    corners: Integers
    starts: Integers
    cells: Integers
    walls: Integers
    signs: Integers

    @property
    def following(self) -> Integers:
        """For each corner the next one around its wall."""
        following = np.roll(self.corners, -1)
        following[self.starts[1:] - 1] = self.corners[self.starts[:-1]]
        return following

    @property
    def sizes(self) -> Integers:
        """For each wall the number of its corners."""
        return np.diff(self.starts)


def relax_in_space(points: Floats, tissue: SolidTissue, forces: Forces = SPACE_FORCES) -> Iterator[Floats]:
    """The positions of the vertices at first, and after each iteration until they are at rest.

    Parameters
    ----------
    points
        Shape (n, 3): the initial positions of the vertices.
    tissue, forces
        The topology of the cellwork, and the forces of its cells and edges.

    Raises
    ------
    ModelValueError
        The positions grow beyond all bounds.
    """
    following = tissue.following
    return until_rest(
        points,
        forces.damping,
        lambda at: volumes(at, tissue, area_vectors(at, tissue, following)),
        LEAST_VOLUME,
        lambda at, room: _force(at, tissue, following, room, forces),
    )


def _force(points: Floats, tissue: SolidTissue, following: Integers, room: Floats, forces: Forces) -> Floats:
    """The force on each vertex, of the edges that end there and of the walls around it."""
    first, second = tissue.ends.T
    along = points[second] - points[first]
    lengths = np.linalg.norm(along, axis=1)
    pull = along * (forces.stiffness * (1 - forces.rest / np.maximum(lengths, 1e-9)))[:, None]
    pressures = forces.pressure / np.maximum(room, LEAST_VOLUME)
    net = np.bincount(tissue.walls, weights=tissue.signs * pressures[tissue.cells], minlength=len(tissue.sizes))
    push = area_vectors(points, tissue, following) * (net / tissue.sizes)[:, None]
    return (
        summed_at_vertices(first, pull, len(points))
        - summed_at_vertices(second, pull, len(points))
        + summed_at_vertices(tissue.corners, np.repeat(push, tissue.sizes, axis=0), len(points))
    )


def area_vectors(points: Floats, tissue: SolidTissue, following: Integers) -> Floats:
    """For each wall a vector at right angles to it, as long as it is large: its corners run counter-clockwise around it."""
    found: Floats = np.add.reduceat(cross(points[tissue.corners], points[following]), tissue.starts[:-1]) / 2
    return found


def cross(a: Floats, b: Floats) -> Floats:
    """The cross products of rows, many times as fast as those of numpy."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=1)


def volumes(points: Floats, tissue: SolidTissue, vectors: Floats) -> Floats:
    """The volume of each cell, negative if it is turned inside out."""
    middles = np.add.reduceat(points[tissue.corners], tissue.starts[:-1]) / tissue.sizes[:, None]
    cones = (middles * vectors).sum(axis=1) / 3
    return np.bincount(tissue.cells, weights=tissue.signs * cones[tissue.walls]).astype(np.float64, copy=False)
