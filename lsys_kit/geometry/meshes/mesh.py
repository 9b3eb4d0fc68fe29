"""Meshes: the shapes of a scene as triangles in space, for file formats and viewers.

Strokes that follow one another are a tube with eight sides, or five where it is thin, closed at both ends; each tapers from
the width of the stroke before it to its own. A polygon stays flat, a sphere is a subdivided icosahedron, a cell is an
ellipsoid. A scene in the plane is set upright.

A convex polygon is a fan, any other is triangulated by ear clipping. An ear is a corner whose triangle lies within the polygon;
every simple polygon has at least two (Meisters, 1975).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import check_bytes, check_limit, counted
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.geometry.meshes.solids import FEWEST_SIDES, SIDES, THIN_SIDES, Numbers, Singles, Solid, ball, disc
from lsys_kit.geometry.meshes.tubes import Rings, as_broad, blocks, by_width, connected, rings, triangles
from lsys_kit.geometry.scene import OWN, SPHERE, Floats, Integers, Polygons, Scene, Segments

if TYPE_CHECKING:
    from numpy.typing import NDArray

LARGEST_COORDINATE = 1e37
"""Greater coordinates cannot be computed in single precision."""
OWN_WIDTHS = (1.0, 0.7, 0.55, 0.4)
"""The usual relative widths of strokes by branch order."""
RELATIVE_WIDTH, LEAST_WIDTH, GREATEST_WIDTH, THINNEST = 0.14, 1 / 600, 1 / 60, 1 / 2000
"""The width of such a stroke relative to the median length of strokes; its bounds, and the least width of any stroke, relative
to the extent of the scene."""
MOST_CORNERS = 10_000
"""A polygon with more corners takes too long to triangulate."""
VERTEX_BYTES, TRIANGLE_BYTES = 80, 36
"""About what a vertex and a triangle take while a mesh is made."""
NEAR, THIN = 1e-9, 1 / 1000
"""Points that are closer than this are one; strokes of this radius or less are thin; relative to the extent of the scene."""
SEEN_SIDES = ((2.5, SIDES), (0.9, THIN_SIDES), (-1.0, FEWEST_SIDES))
"""How many sides strokes have in a picture, by their radii in pixels."""
FINE, FINER, FEW_SPHERES = 2, 4, 100
"""How often the faces of spheres are divided: usually; and where they may be finer because there are so few."""
_SIDE, _CAPS = 2 * SIDES, 2 * (SIDES - 2)


@dataclass(frozen=True)
class Mesh:
    """Triangles in space: x grows to the right, z upwards, and y away from the viewer.

    vertices, normals
        Shape (n, 3): each vertex, in the units of the model, and the normal there.
    triangles
        Shape (m, 3): the numbers of its vertices, counter-clockwise as seen from outside.
    states, colours
        For each vertex the state of its module, and the number of its colour, or `OWN`.
    """

    vertices: Singles
    normals: Singles
    triangles: Numbers
    states: Integers
    colours: Integers

    @property
    def corners(self) -> tuple[Singles, Singles]:
        """The bounding box: the least and the greatest of each coordinate; zeros for an empty mesh."""
        some = self.vertices if len(self.vertices) else np.zeros((1, 3), np.float32)
        return some.min(axis=0), some.max(axis=0)


def mesh_of(scene: Scene, own_widths: Sequence[float] = OWN_WIDTHS) -> Mesh:
    """The triangles of a scene.

    Parameters
    ----------
    scene
        A scene in space or in the plane.
    own_widths
        Relative widths of strokes by branch order, where the turtle has set no width; the last holds for all deeper branches.

    Returns
    -------
    Mesh
        First the strokes, then polygons, discs, spheres and cells, each in the order of the scene. Strokes of length 0 are
        left out.

    Examples
    --------
    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> mesh = mesh_of(scene_of(derive(read("axiom: F(10)[&(90)F(5)]@O(2)"), 0)))
    >>> mesh.vertices.shape, mesh.triangles.shape
    ((194, 3), (376, 3))
    """
    return _merged_meshes([mesh for mesh, _ in _parts(scene, own_widths)])


def mesh_with_sheets(scene: Scene, pixel: float) -> tuple[Mesh, NDArray[np.bool_]]:
    """The same for a picture whose pixels are so large, with as many sides of strokes as are seen, and finer spheres where they
    are few; and for each vertex whether it is one of a sheet, as polygons and discs are, which is no closed solid."""
    sides = tuple((radius * pixel, many) for radius, many in SEEN_SIDES)
    parts = _parts(scene, OWN_WIDTHS, sides, FINER if len(scene.discs) <= FEW_SPHERES else FINE)
    return _merged_meshes([mesh for mesh, _ in parts]), np.concatenate(
        [np.full(len(mesh.vertices), sheet) for mesh, sheet in parts]
    )


Sides: TypeAlias = Sequence[tuple[float, int]]
"""Radii and how many sides strokes have whose radius is greater, the greatest first."""


def _parts(
    scene: Scene, own_widths: Sequence[float], sides: Sides | None = None, fine: int = FINE
) -> Sequence[tuple[Mesh, bool]]:
    """The meshes of strokes, polygons, discs, spheres and cells, and whether each is made of sheets."""
    _check_triangles(scene)
    if not max(map(abs, (*scene.corners[0], *scene.corners[1]))) < LARGEST_COORDINATE:
        raise ModelValueError("This drawing is too large for a mesh", hint="Make its steps shorter.")
    discs, cells, extent = scene.discs, scene.cells, _extent(scene)
    balls = discs.kinds == SPHERE
    sphere = ball(fine if balls.any() else FINE)
    centres, radii = in_space(discs.centres), discs.radii
    lengths, breadths = cells.sizes.T / 2
    ellipsoids = _copies(
        ball(), in_space(cells.centres), np.stack([lengths, breadths, breadths], axis=1), cells.states, np.full(len(cells), OWN)
    )
    tubes = _tubes(scene.segments, extent, own_widths, sides or ((THIN * extent, SIDES), (-1.0, THIN_SIDES)))
    return [
        *((tube, False) for tube in tubes),
        (_faces(scene.polygons), True),
        (_copies(disc(), centres[~balls], radii[~balls, None], discs.states[~balls], discs.colours[~balls]), True),
        (_copies(sphere, centres[balls], radii[balls, None], discs.states[balls], discs.colours[balls]), False),
        (ellipsoids, False),
    ]


def _check_triangles(scene: Scene) -> None:
    vertices, needed = _size(scene)
    check_limit("triangles", needed, lambda: f"The drawing would have up to {needed:,} triangles")
    check_bytes(vertices * VERTEX_BYTES + needed * TRIANGLE_BYTES, lambda: "The mesh was not made")
    most = int(np.diff(scene.polygons.starts).max(initial=0))
    if most > MOST_CORNERS:
        raise ModelLimitError(
            f"A polygon has {most:,} corners; {MOST_CORNERS:,} can be triangulated",
            limit=MOST_CORNERS,
            needed=most,
            hint="Take fewer steps.",
        )


def _size(scene: Scene) -> tuple[int, int]:
    """How many vertices and triangles the mesh of a scene has at most."""
    balls = int((scene.discs.kinds == SPHERE).sum()) + len(scene.cells)
    copies = ((disc(), len(scene.discs) + len(scene.cells) - balls), (ball(), balls))
    return (
        len(scene.segments) * _SIDE + len(scene.polygons.points) + sum(len(shape.vertices) * n for shape, n in copies),
        len(scene.segments) * (_SIDE + _CAPS)
        + len(scene.polygons.points)
        + sum(len(shape.triangles) * n for shape, n in copies),
    )


def in_space(points: Floats) -> Floats:
    """Points in space: those of the plane are set upright."""
    return points if points.shape[1] == 3 else np.stack([points[:, 0], np.zeros(len(points)), points[:, 1]], axis=1)


def _extent(scene: Scene) -> float:
    least, greatest = scene.corners
    return float((greatest - least).max())


def _merged_meshes(meshes: Sequence[Mesh]) -> Mesh:
    meshes = [mesh for mesh in meshes if len(mesh.vertices)] or meshes[:1]
    if len(meshes) == 1:
        return meshes[0]
    firsts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    triangles = [mesh.triangles + np.uint32(first) for mesh, first in zip(meshes, firsts, strict=False)]
    joined = {
        name: np.concatenate([getattr(mesh, name) for mesh in meshes]) for name in ("vertices", "normals", "states", "colours")
    }
    return Mesh(triangles=np.concatenate(triangles), **joined)


# Strokes


def _tubes(segments: Segments, reach: float, own_widths: Sequence[float], sides: Sides) -> Iterator[Mesh]:
    """Strokes as closed tubes with round shading, the thick ones first."""
    points = in_space(segments.points).reshape(-1, 2, 3)
    lengths = np.linalg.norm(points[:, 1] - points[:, 0], axis=1)
    there = lengths > 0
    widths = _widths(segments, lengths, reach, own_widths)
    radii = np.stack([start_widths(segments, widths, reach), widths], axis=1)[there] / 2
    looks = np.column_stack([segments.states, np.broadcast_to(segments.colours, len(segments))])[there]
    strokes = connected(points[there], radii, segments.orders[there], looks, reach * NEAR)
    for radius, many in sides:
        thick, strokes = by_width(strokes, radius)
        yield _tube_mesh(rings(as_broad(thick, many), many))


def _tube_mesh(found: Rings) -> Mesh:
    states, colours = np.repeat(found.looks, found.vertices.shape[1], axis=0).T
    return Mesh(found.vertices.reshape(-1, 3), found.normals.reshape(-1, 3), triangles(found), states, colours)


def _widths(segments: Segments, lengths: Floats, reach: float, own_widths: Sequence[float]) -> Floats:
    """The width of each stroke: as set by the turtle, else by its branch order."""
    usual = float(np.median(lengths)) if len(lengths) else 0.0
    own = min(max(RELATIVE_WIDTH * usual, LEAST_WIDTH * reach), GREATEST_WIDTH * reach) * np.array(own_widths)
    by_order = own[np.minimum(segments.orders, len(own_widths) - 1)]
    return np.maximum(np.where(segments.widths == OWN, by_order, segments.widths), THINNEST * reach)


def start_widths(segments: Segments, widths: Floats, reach: float) -> Floats:
    """The width of each stroke at its start: that of the last stroke of its branch that ends there, else its own."""
    if len(segments) < 2 or (widths == widths[0]).all():
        return widths
    grid = np.rint(segments.points / (reach * NEAR)).astype(np.int64).reshape(len(segments), 2, -1)
    places = np.concatenate([np.column_stack([grid[:, end], segments.orders]) for end in (0, 1)])
    numbers = numbered(places).reshape(2, -1)
    width_at = np.full(len(places), np.nan)
    width_at[numbers[1]] = widths
    found = width_at[numbers[0]]
    return np.where(np.isnan(found), widths, found)


def numbered(rows: Integers) -> Integers:
    """A number for each row, the same for equal ones."""
    order = np.lexsort(rows.T)
    found = np.empty(len(rows), np.int64)
    found[order] = np.cumsum(np.append(False, (np.diff(rows[order], axis=0) != 0).any(axis=1)))
    return found


# Polygons


def _faces(polygons: Polygons) -> Mesh:
    """Polygons as they are; those of curved surfaces with the normals that these have."""
    points, sizes = in_space(polygons.points), np.diff(polygons.starts)
    facing, smooth = normals_of(points, polygons.starts), polygons.smooth
    spans = np.stack([polygons.starts[:-1], polygons.starts[1:]], axis=1)
    triangles = [_alike(points, each, facing[some]) for some, each in _by_corners(spans, np.flatnonzero(~smooth))]
    normals = np.repeat(facing, sizes, axis=0)
    if smooth.any():
        corners = np.repeat(smooth, sizes)
        normals[corners] = polygons.normals[corners]
    return Mesh(
        points.astype(np.float32),
        normals.astype(np.float32),
        np.concatenate([*triangles, _fans(spans[smooth])]).astype(np.uint32),
        np.repeat(polygons.states, sizes),
        np.repeat(polygons.colours, sizes),
    )


ALIKE = 1e-6
"""Outlines are affine images of one another whose corners differ by no more than this from such, in units of their sides."""


def _by_corners(spans: Integers, chosen: Integers) -> Iterator[tuple[Integers, Integers]]:
    """Some polygons, those with as many corners together: their numbers, and the numbers of their corners."""
    sizes = np.diff(spans[chosen], axis=1)[:, 0]
    for size in np.unique(sizes).tolist():
        some = chosen[sizes == size]
        yield some, spans[some, :1] + np.arange(size)


def _alike(points: Floats, corners: Integers, facing: Floats) -> Integers:
    """The triangles of polygons with as many corners: of those that are affine images of one another, as the leaves of a plant,
    one is triangulated, and all others alike."""
    kinds = numbered(_affine(points[corners], facing))
    firsts = np.unique(kinds, return_index=True)[1]
    cuts = [
        np.array(triangulate(points[corners[first]], facing[first]), np.int64).reshape(-1, 3)
        for first in counted(firsts.tolist(), 1)
    ]
    if not len(cuts):
        return np.empty((0, 3), np.int64)
    return np.take_along_axis(corners, np.stack(cuts)[kinds].reshape(len(corners), -1), axis=1).reshape(-1, 3)


def _affine(outlines: Floats, facing: Floats) -> Integers:
    """For each outline numbers that are the same for its affine images in space: the coordinates of its corners in the basis of
    its first side and of the way to the corner that is farthest from this. Of one that is no area, others."""
    sides = outlines - outlines[:, :1]
    if sides.shape[1] < 3:
        return np.zeros((len(outlines), 1), np.int64)
    one = sides[:, 1]
    areas = np.einsum("nki,ni->nk", np.cross(one[:, None], sides), facing)
    far = np.abs(areas).argmax(axis=1)
    other, whole = sides[np.arange(len(sides)), far], np.take_along_axis(areas, far[:, None], axis=1)
    single = np.abs(whole[:, 0]) <= ALIKE * (sides**2).sum(axis=2).max(axis=1)
    whole = np.where(single[:, None], 1.0, whole)
    along = np.einsum("nki,ni->nk", np.cross(sides, other[:, None]), facing) / whole
    found = np.rint(np.concatenate([along, areas / whole], axis=1) / ALIKE)
    found[single] = np.arange(len(sides))[single, None]
    return np.column_stack([found.astype(np.int64), far, single, np.sign(whole[:, 0]).astype(np.int64)])


def _fans(spans: Integers) -> Integers:
    """The triangles of small convex faces, given the numbers of the first corner of each and of the one behind its last."""
    sizes = np.diff(spans, axis=1)[:, 0] - 2
    first = np.repeat(spans[:, 0], sizes)
    second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return np.stack([first, second, second + 1], axis=1)


def normals_of(points: Floats, starts: Integers) -> Floats:
    """The unit normal of each polygon, by Newell's method."""
    if len(starts) < 2:
        return np.empty((0, 3))
    following = np.arange(1, len(points) + 1)
    following[starts[1:] - 1] = starts[:-1]
    around = points - np.repeat(points[starts[:-1]], np.diff(starts), axis=0)
    sums = np.add.reduceat(np.cross(around, around[following]), starts[:-1])
    lengths = np.linalg.norm(sums, axis=1)[:, None]
    return np.where(lengths > 0, sums / np.where(lengths > 0, lengths, 1.0), (0.0, -1.0, 0.0))


# Round shapes


def _copies(shape: Solid, centres: Floats, sizes: Floats, states: Integers, colours: Integers) -> Mesh:
    """Copies of a shape about the origin, translated and scaled along the axes; sizes have the shape (n, 1) or (n, 3)."""
    count = len(shape.vertices)
    vertices, normals = np.empty((2, len(centres), count, 3), np.float32)
    for some in blocks(len(centres)):
        vertices[some] = centres[some, None] + sizes[some, None] * shape.vertices
        outward = shape.normals / np.where(sizes[some] > 0, sizes[some], 1.0)[:, None]
        normals[some] = outward / np.linalg.norm(outward, axis=2, keepdims=True)
    firsts = np.arange(len(centres), dtype=np.uint32) * np.uint32(count)
    return Mesh(
        vertices.reshape(-1, 3),
        normals.reshape(-1, 3),
        (firsts[:, None, None] + shape.triangles).reshape(-1, 3),
        np.repeat(states, count),
        np.repeat(colours, count),
    )


_STRAIGHT = 1e-12
"""A corner that turns by less than this, relative to the size of the polygon, is taken for straight."""


def triangulate(points: Floats, facing: Floats) -> list[tuple[int, int, int]]:
    """The triangles of a polygon in space, as numbers of its corners.

    Parameters
    ----------
    points
        Shape (n, 3): its corners, counter-clockwise as seen from the side of its normal.
    facing
        Shape (3,): its normal.

    Returns
    -------
    list
        n - 2 triangles. A self-intersecting polygon is covered as well as possible.

    Examples
    --------
    >>> arrow = np.array([(0, 0, 0), (4, 3, 0), (0, 1, 0), (-4, 3, 0)], float)
    >>> triangulate(arrow, np.array([0, 0, 1.0]))
    [(0, 1, 2), (0, 2, 3)]
    """
    plane = _projected(points, facing)
    size = float(np.ptp(plane, axis=0).max()) if len(plane) else 0.0
    level = _STRAIGHT * size * size
    if (_corner_products(plane) >= -level).all():
        return [(0, k, k + 1) for k in range(1, len(plane) - 1)]
    left, triangles = np.arange(len(plane)), []
    while len(left) > 3:
        ear = _ear(plane, level)
        triangles.append((int(left[ear - 1]), int(left[ear]), int(left[(ear + 1) % len(left)])))
        left, plane = np.delete(left, ear), np.delete(plane, ear, axis=0)
    return [*triangles, (int(left[0]), int(left[1]), int(left[2]))]


def _projected(points: Floats, facing: Floats) -> Floats:
    """The corners projected along the axis that is closest to the normal."""
    axis = int(np.abs(facing).argmax())
    plane = points[:, [(axis + 1) % 3, (axis + 2) % 3]]
    return plane if facing[axis] > 0 else plane[:, ::-1]


def _corner_products(plane: Floats) -> Floats:
    """The cross product of the edges at each corner: positive where the outline turns left."""
    before, behind = plane - np.roll(plane, 1, axis=0), np.roll(plane, -1, axis=0) - plane
    bends: Floats = before[:, 0] * behind[:, 1] - before[:, 1] * behind[:, 0]
    return bends


def _ear(plane: Floats, level: float) -> int:
    """The first corner whose triangle contains no other corner; if there is none, the first where the outline turns left."""
    candidates = np.flatnonzero(_corner_products(plane) > level).tolist()
    for corner in counted(candidates, 1):
        a, b, c = plane[corner - 1], plane[corner], plane[(corner + 1) % len(plane)]
        within = _on_the_left(plane, a, b, level) & _on_the_left(plane, b, c, level) & _on_the_left(plane, c, a, level)
        if not (within & ~_equal_to_any(plane, (a, b, c))).any():
            return int(corner)
    return int(candidates[0]) if candidates else 0


def _on_the_left(points: Floats, a: Floats, b: Floats, level: float) -> NDArray[np.bool_]:
    """Which points lie on the line from a to b, or to its left."""
    found: NDArray[np.bool_] = (b[0] - a[0]) * (points[:, 1] - a[1]) - (b[1] - a[1]) * (points[:, 0] - a[0]) >= -level
    return found


def _equal_to_any(points: Floats, some: tuple[Floats, ...]) -> NDArray[np.bool_]:
    found: NDArray[np.bool_] = np.any([(points == one).all(axis=1) for one in some], axis=0)
    return found
