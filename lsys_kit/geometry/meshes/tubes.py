"""Strokes as tubes: strokes that follow one another become one generalised cylinder, whose rings of vertices they share.

Where a tube bends, its ring lies in the plane that bisects the angle, so there is no notch. Rings are carried along a tube
without twist, by parallel transport. Along a straight line of equal strokes there is no ring between them.

Sources: J. Bloomenthal, "Modeling the Mighty Maple", SIGGRAPH 1985; A. J. Hanson and H. Ma, "Parallel Transport Approach to
Curve Framing", Indiana University, Technical Report 425, 1995.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import counted
from lsys_kit.geometry.meshes.solids import FEWEST_SIDES, Numbers, Singles, circle, prism_triangles
from lsys_kit.geometry.scene import Floats, Integers

if TYPE_CHECKING:
    from numpy.typing import NDArray

Flags: TypeAlias = "NDArray[np.bool_]"

SHARPEST = math.cos(math.radians(150))
"""The cosine of the greatest angle by which a tube bends; where it would bend more, another begins."""
STRETCHED = math.cos(math.radians(90))
"""The cosine of the greatest angle at which a ring is stretched, so that the tube keeps its width in the bend."""
STRAIGHT = 1e-9
"""Strokes whose directions differ by no more than this are on a line."""
SHAPES_AT_A_TIME = 2**12
"""Strokes and copies of round shapes are computed in blocks of so many, with a look at the budget after each."""


class Strokes(NamedTuple):
    """Strokes of some length, in an order in which each that continues another comes right behind it.

    ends
        Shape (n, 2, 3): start and end of each.
    radii
        Shape (n, 2): those at its start and at its end.
    looks
        Shape (n, 2): its state and the number of its colour.
    follows
        Whether it continues the one before.
    """

    ends: Floats
    radii: Floats
    looks: Integers
    follows: Flags

    @property
    def lengths(self) -> Floats:
        found: Floats = np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1)
        return found

    @property
    def ways(self) -> Floats:
        """The direction of each, a unit vector."""
        found: Floats = (self.ends[:, 1] - self.ends[:, 0]) / self.lengths[:, None]
        return found

    def taken(self, some: Integers | Flags) -> Strokes:
        return Strokes(self.ends[some], self.radii[some], self.looks[some], self.follows[some])


class Rings(NamedTuple):
    """The rings of tubes, and between which of them there are sides.

    vertices, normals
        Shape (m, sides, 3).
    looks
        Shape (m, 2): the state and the number of the colour of each ring.
    spans
        Shape (n, 2): the rings at the start and at the end of each stroke.
    open
        Shape (n, 2): whether a tube begins or ends there, and so has to be closed.
    """

    vertices: Singles
    normals: Singles
    looks: Integers
    spans: Integers
    open: Flags


def blocks(size: int) -> Iterator[slice]:
    """So many shapes in blocks."""
    return (slice(first, first + SHAPES_AT_A_TIME) for first in counted(range(0, size, SHAPES_AT_A_TIME), 1))


def connected(ends: Floats, radii: Floats, orders: Integers, looks: Integers, near: float) -> Strokes:
    """Strokes in the order of their tubes, equal ones on a line joined to one.

    A stroke continues the last one of its branch order, if that ends where it starts.

    ends, radii, looks
        As of `Strokes`; all strokes have a length.
    orders
        The branch order of each.
    near
        Points that are closer are one.

    >>> points = np.array([[0, 0, 0], [0, 0, 1], [0, 0, 2], [1, 0, 2]], float)
    >>> ends = np.stack([points[:-1], points[1:]], axis=1)
    >>> found = connected(ends, np.full((3, 2), 0.1), np.zeros(3, int), np.zeros((3, 2), int), 1e-9)
    >>> found.lengths.tolist(), found.follows.tolist()
    ([2.0, 1.0], [False, True])
    """
    before = _predecessors(ends, orders, near)
    first, place = _chains(before)
    order = np.lexsort((place, first))
    follows, radii = before[order] >= 0, radii[order]
    radii[follows, 0] = np.roll(radii[:, 1], 1)[follows]
    return _unbroken(_joined(Strokes(ends[order], radii, looks[order], follows)))


def _predecessors(ends: Floats, orders: Integers, near: float) -> Integers:
    """For each stroke the number of the one that it continues, or -1."""
    count = len(ends)
    grid = np.rint(ends / near).astype(np.int64)
    places = np.column_stack([np.concatenate([grid[:, 0], grid[:, 1]]), np.tile(orders, 2)])
    order = np.lexsort((np.concatenate([2 * np.arange(count), 2 * np.arange(count) + 1]), *places.T))
    same = (np.diff(places[order], axis=0) == 0).all(axis=1)
    ends_first = same & (order[:-1] >= count) & (order[1:] < count)
    before = np.full(count, -1)
    before[order[1:][ends_first]] = order[:-1][ends_first] - count
    return before


def _chains(before: Integers) -> tuple[Integers, Integers]:
    """For each stroke the first of its tube, and how many come before it there; found by doubling the stride."""
    first, place = np.where(before >= 0, before, np.arange(len(before))), (before >= 0).astype(np.int64)
    while (further := first[first] != first).any():
        place[further] += place[first[further]]
        first = first[first]
    return first, place


def _unbroken(strokes: Strokes) -> Strokes:
    """The strokes, where each at which the tube would bend too sharply for its width begins another."""
    lengths, cosines = strokes.lengths, _cosines(strokes)
    reach = strokes.radii[:, 0] * np.sqrt(np.clip(1 - cosines, 0, 2) / 2)
    room = np.minimum(lengths, np.roll(lengths, 1)) / 2
    return strokes._replace(follows=strokes.follows & (cosines > SHARPEST) & (reach <= room))


def _cosines(strokes: Strokes) -> Floats:
    ways = strokes.ways
    found: Floats = np.einsum("ij,ij->i", ways, np.roll(ways, 1, axis=0))
    return found


def _joined(strokes: Strokes) -> Strokes:
    """Equal strokes on a line as one."""
    if not len(strokes.ends):
        return strokes
    ways, even = strokes.ways, strokes.radii[:, 0] == strokes.radii[:, 1]
    on_line = (np.abs(ways - np.roll(ways, 1, axis=0)) < STRAIGHT).all(axis=1)
    goes_on = (
        strokes.follows & on_line & even & np.roll(even, 1) & (strokes.looks == np.roll(strokes.looks, 1, axis=0)).all(axis=1)
    )
    firsts = np.flatnonzero(~goes_on)
    lasts = np.append(firsts[1:], len(goes_on)) - 1
    found = strokes.taken(firsts)
    return found._replace(ends=np.stack([found.ends[:, 0], strokes.ends[lasts, 1]], axis=1))


def by_width(strokes: Strokes, thin: float) -> tuple[Strokes, Strokes]:
    """Tubes that are somewhere thicker than some radius, and thin ones."""
    tube = np.cumsum(~strokes.follows) - 1
    widest = np.zeros(int(tube.max(initial=-1)) + 1)
    np.maximum.at(widest, tube, strokes.radii.max(axis=1))
    thick = widest[tube] > thin
    return strokes.taken(thick), strokes.taken(~thick)


def as_broad(strokes: Strokes, sides: int) -> Strokes:
    """Strokes whose tubes with the fewest sides look as broad from all sides, on the average, as they are."""
    return strokes if sides > FEWEST_SIDES else strokes._replace(radii=strokes.radii * np.pi / (sides * np.sin(np.pi / sides)))


def rings(strokes: Strokes, sides: int) -> Rings:
    """The rings of tubes with some number of sides."""
    count, follows = len(strokes.ends), strokes.follows
    goes_on = np.append(follows, False)[1:]
    changes = ~follows | (strokes.looks != np.roll(strokes.looks, 1, axis=0)).any(axis=1)
    end_rings = np.cumsum(changes + np.ones(count, np.int64)) - 1
    start_rings = np.where(changes, end_rings - 1, np.roll(end_rings, 1))
    vertices, normals = np.empty((2, int(end_rings[-1]) + 1 if count else 0, sides, 3), np.float32)
    looks = np.empty((len(vertices), 2), np.int64)
    ways, radials, numbers = strokes.ways, _radials(strokes), np.arange(count)
    for some in blocks(count):
        here = numbers[some]
        around = _around(ways[some], radials[some], sides)
        bent, normal = _bent(around, ways[some], ways[here + goes_on[some]])
        normals[end_rings[here]] = normal
        vertices[end_rings[here]] = strokes.ends[some, 1, None] + strokes.radii[some, 1, None, None] * bent
        begins = here[~follows[some]]
        normals[start_rings[begins]] = around[~follows[some]]
        vertices[start_rings[begins]] = (
            strokes.ends[begins, 0, None] + strokes.radii[begins, 0, None, None] * around[~follows[some]]
        )
    again = np.flatnonzero(changes & follows)
    for whole in (vertices, normals):
        whole[start_rings[again]] = whole[end_rings[again - 1]]
    looks[end_rings], looks[start_rings[changes]] = strokes.looks, strokes.looks[changes]
    return Rings(vertices, normals, looks, np.stack([start_rings, end_rings], axis=1), np.stack([~follows, ~goes_on], axis=1))


def triangles(found: Rings) -> Numbers:
    """The triangles of tubes: sides, then what closes them."""
    sides = found.vertices.shape[1]
    walls, start, end = prism_triangles(sides)
    spans = (found.spans * sides).astype(np.uint32)
    corners = np.where(walls < sides, spans[:, None, None, 0] + walls, spans[:, None, None, 1] + walls - sides)
    caps = [spans[found.open[:, which], which, None, None] + cap for which, cap in enumerate((start, end))]
    return np.concatenate([part.reshape(-1, 3) for part in (corners, *caps)]).astype(np.uint32)


def _radials(strokes: Strokes) -> Floats:
    """For each stroke a unit vector across it; along a tube it is carried without twist."""
    ways = strokes.ways
    turns = _rotations(np.roll(ways, 1, axis=0), ways)
    turns[~strokes.follows] = (1.0, 0.0, 0.0, 0.0)
    place = np.arange(len(ways)) - np.maximum.accumulate(np.where(strokes.follows, 0, np.arange(len(ways))))
    stride = 1
    while len(late := np.flatnonzero(place >= stride)):
        turns[late] = _product(turns[late], turns[late - stride])
        stride *= 2
    carried = _rotated(turns, _across(ways)[np.arange(len(ways)) - place])
    carried -= np.einsum("ij,ij->i", carried, ways)[:, None] * ways
    radials: Floats = carried / np.linalg.norm(carried, axis=1)[:, None]
    return radials


def _across(ways: Floats) -> Floats:
    aside = np.zeros_like(ways)
    np.put_along_axis(aside, np.abs(ways).argmin(axis=1)[:, None], 1.0, axis=1)
    normals = np.cross(ways, aside)
    found: Floats = normals / np.linalg.norm(normals, axis=1)[:, None]
    return found


def _rotations(a: Floats, b: Floats) -> Floats:
    """The shortest rotations from some unit vectors to others, as quaternions; not for opposite ones."""
    found = np.column_stack([1 + np.einsum("ij,ij->i", a, b), np.cross(a, b)])
    lengths = np.linalg.norm(found, axis=1)[:, None]
    rotations: Floats = found / np.where(lengths > 0, lengths, 1.0)
    return rotations


def _product(a: Floats, b: Floats) -> Floats:
    real = a[:, 0] * b[:, 0] - np.einsum("ij,ij->i", a[:, 1:], b[:, 1:])
    return np.column_stack([real, a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])])


def _rotated(rotations: Floats, vectors: Floats) -> Floats:
    twice = 2 * np.cross(rotations[:, 1:], vectors)
    turned: Floats = vectors + rotations[:, :1] * twice + np.cross(rotations[:, 1:], twice)
    return turned


def _around(ways: Floats, radials: Floats, sides: int) -> Floats:
    """For each direction the unit vectors to the edges of a tube, shape (n, sides, 3)."""
    cos, sin = circle(sides)
    ring: Floats = radials[:, None] * cos[:, None] + np.cross(ways, radials)[:, None] * sin[:, None]
    return ring


def _bent(around: Floats, ways: Floats, towards: Floats) -> tuple[Floats, Floats]:
    """The rings where tubes bend from one direction to another: vectors to the vertices, and unit normals."""
    cosines = np.einsum("ij,ij->i", ways, towards)
    middle = ways + towards
    middle /= np.linalg.norm(middle, axis=1)[:, None]
    half = _rotations(ways, middle)
    normals = _rotated(np.repeat(half, around.shape[1], axis=0), around.reshape(-1, 3)).reshape(around.shape)
    inward = towards - ways
    lengths = np.linalg.norm(inward, axis=1)[:, None]
    inward = inward / np.where(lengths > 0, lengths, 1.0)
    stretch = np.where(cosines >= STRETCHED - 1e-9, 1 / np.sqrt(np.clip(1 + cosines, 1e-9, 2) / 2), 1.0) - 1
    along = np.einsum("nki,ni->nk", normals, inward)
    bent: Floats = normals + (stretch[:, None] * along)[:, :, None] * inward[:, None]
    return bent, normals
