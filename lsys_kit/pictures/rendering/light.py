"""Scenes in sun and sky: triangles in a z-buffer, on a ground that takes their shadow and fades into the paper.

What is seen at each sample of a picture is the nearest triangle there, whatever the order of the triangles (Catmull 1974). A
pixel has several samples, each in a row and a column of its own. The sun casts shadows by a shadow map (Williams 1978), blurred
on the ground by the distance from which they fall. The sky lights what looks upwards, as far as nothing near hides it, which is
seen in the depths of the picture (Mittring 2007). Leaves let a part of the light through.

Sources: E. Catmull, A Subdivision Algorithm for Computer Display of Curved Surfaces, University of Utah, 1974; L. Williams,
"Casting Curved Shadows on Curved Surfaces", SIGGRAPH 1978; M. Mittring, "Finding Next Gen: CryEngine 2", SIGGRAPH 2007.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget, check_bytes, current
from lsys_kit.derivation.core.chance import units
from lsys_kit.derivation.core.rules import real_from
from lsys_kit.errors import ModelValueError, shown
from lsys_kit.geometry.meshes.mesh import in_space, mesh_with_sheets, numbered
from lsys_kit.geometry.meshes.solids import Numbers, Singles
from lsys_kit.geometry.scene import Flags, Floats, Integers, Polygons, Scene
from lsys_kit.geometry.smoothing import smoothed
from lsys_kit.pictures.rendering.display_list import boldness
from lsys_kit.pictures.rendering.frames import MARGIN, ViewFrame
from lsys_kit.pictures.rendering.looks import numbered_colours, stroke_widths
from lsys_kit.pictures.rendering.view import (
    FROM_THE_RIGHT,
    FRONT,
    MOST_CYLINDERS,
    Axes,
    Cylinder,
    ProjectedScene,
    View,
    axes,
    cylinder_around,
    lies_flat,
    project,
    project_smoothly,
)
from lsys_kit.pictures.style.themes import COLOURS, theme

if TYPE_CHECKING:
    from numpy.typing import NDArray

Keys: TypeAlias = "NDArray[np.uint64]"
Reals: TypeAlias = "NDArray[np.floating]"
"""In single precision where there may be many."""

# --- the nearest triangle at each sample ---

TRIANGLES_AT_A_TIME, SAMPLES_AT_A_TIME = 2**15, 2**17
"""Triangles and samples are computed in blocks of so many."""
LATTICES: Mapping[int, tuple[int, ...]] = {1: (0,), 2: (0, 1), 4: (1, 3, 0, 2), 8: (0, 3, 6, 1, 4, 7, 2, 5)}
"""For each number of samples of a pixel, which lie below one another, the column of each."""
NARROWEST = 1e-3
"""A triangle of less than half this area, in columns times rows, is a line."""
NONE = -1
"""Stands for the triangle where there is none."""


class Seen(NamedTuple):
    """What is seen at each sample, from the top to the bottom and from the left to the right.

    nearness
        Shape (rows, columns): that of the triangle, 0 where there is none.
    triangles
        Its number, or `NONE`.
    """

    nearness: Singles
    triangles: NDArray[np.int32]


def offsets_of(samples: int) -> Singles:
    """How far from the left edge of their pixel samples lie, row after row."""
    return ((np.array(LATTICES[samples]) + 0.5) / samples).astype(np.float32)


def nearest(points: Singles, triangles: Numbers, shape: tuple[int, int], offsets: Singles, two_sided: Flags) -> Seen:
    """The nearest triangle at each sample of a grid.

    Of those that are equally near it is the same in whatever order they come.

    Parameters
    ----------
    points
        Shape (n, 3): the column and the row of each vertex, and how near it is, which is more than 0.
    triangles
        Shape (m, 3): the numbers of the vertices of each.
    shape
        The number of rows and columns.
    offsets
        How far samples lie to the right of the edges of columns, in a row, the next and so on, and from the beginning again.
    two_sided
        Shape (m,): which are seen from behind, too, where their corners run clockwise.

    Examples
    --------
    >>> square = np.array([[0, 0, 1], [4, 0, 1], [4, 4, 1], [0, 4, 1]], np.float32)
    >>> triangles = np.array([[0, 2, 1], [0, 3, 2]], np.uint32)
    >>> nearest(square, triangles, (4, 4), offsets_of(1), np.zeros(2, bool)).triangles.tolist()
    [[0, 0, 0, 0], [1, 0, 0, 0], [1, 1, 0, 0], [1, 1, 1, 0]]
    """
    best, which = np.zeros(shape[0] * shape[1], np.uint64), np.full(shape[0] * shape[1], NONE, np.int32)
    for first in range(0, len(triangles), TRIANGLES_AT_A_TIME):
        some = slice(first, first + TRIANGLES_AT_A_TIME)
        corners = points[triangles[some]]
        chosen = np.flatnonzero(_turns_right(corners) | two_sided[some])
        for places, keys, parts in _fragments(corners[chosen], shape, offsets):
            check_budget()
            nearer = np.flatnonzero(keys > best[places])
            places, keys = places[nearer], keys[nearer]
            np.maximum.at(best, places, keys)
            won = np.flatnonzero(best[places] == keys)
            which[places[won]] = first + chosen[parts[nearer[won]] % len(chosen)]
    nearness = (best >> np.uint64(32)).astype(np.uint32).view(np.float32)
    return Seen(nearness.reshape(shape), which.reshape(shape))


def _turns_right(corners: Singles) -> Flags:
    """Which triangles have their corners counter-clockwise as they are seen, where rows run downwards."""
    (x0, y0), (x1, y1), (x2, y2) = (corners[:, k, :2].T for k in range(3))
    found: Flags = (x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0) < 0
    return found


class _Parts(NamedTuple):
    """Triangles cut into two along the row of their middle corner: for each part its rows; where it begins and ends in row 0
    and by how much that moves in a row; how near it is at the origin, and by how much nearer in a column and in a row."""

    first: Integers
    last: Integers
    left: Floats
    left_step: Floats
    right: Floats
    right_step: Floats
    near: Floats
    across: Floats
    down: Floats


def _parts(corners: Singles, rows: int) -> _Parts:
    """The parts of triangles, the upper ones and then the lower ones."""
    points = corners.astype(np.float64)
    (x0, y0), (x1, y1), (x2, y2) = _by_rows(points)
    long, upper, lower = _edge(x0, y0, x2, y2), _edge(x0, y0, x1, y1), _edge(x1, y1, x2, y2)
    on_left = x1 < x0 + (y1 - y0) * long[1]
    sides = [
        (np.where(on_left, short, edge), np.where(on_left, edge, short))
        for one in (upper, lower)
        for short, edge in zip(one, long, strict=True)
    ]
    first, middle, last = (np.clip(np.ceil(y - 0.5), 0, rows).astype(np.int64) for y in (y0, y1, y2))
    planes = _planes(points)
    return _Parts(
        np.concatenate([first, middle]),
        np.concatenate([middle, last]),
        *(np.concatenate([sides[place][side], sides[place + 2][side]]) for side in (0, 1) for place in (0, 1)),
        *(np.tile(each, 2) for each in planes),
    )


def _by_rows(points: Floats) -> list[tuple[Floats, Floats]]:
    """The columns and rows of the corners of triangles, the uppermost first."""
    found = [(points[:, k, 0], points[:, k, 1]) for k in range(3)]
    for a, b in ((0, 1), (1, 2), (0, 1)):
        swapped = found[a][1] > found[b][1]
        upper = [np.where(swapped, *each) for each in zip(found[b], found[a], strict=True)]
        lower = [np.where(swapped, *each) for each in zip(found[a], found[b], strict=True)]
        found[a], found[b] = (upper[0], upper[1]), (lower[0], lower[1])
    return found


def _edge(x: Floats, y: Floats, to_x: Floats, to_y: Floats) -> tuple[Floats, Floats]:
    """Where the line of an edge is in row 0, and how far it moves in a row: the same for both triangles that share it."""
    down = to_y - y
    step = (to_x - x) / np.where(down > 0, down, 1.0)
    return x - (y - 0.5) * step, step


def _planes(points: Floats) -> tuple[Floats, Floats, Floats]:
    """How near the planes of triangles are in the middle of row 0 at its left, and by how much nearer in a column and a row; a
    triangle that is a line is as near everywhere as its middle."""
    one, other = points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
    area = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    area = np.where(np.abs(area) > NARROWEST, area, np.inf)
    across = (one[:, 2] * other[:, 1] - other[:, 2] * one[:, 1]) / area
    down = (other[:, 2] * one[:, 0] - one[:, 2] * other[:, 0]) / area
    middle = (points[:, 0] + points[:, 1] + points[:, 2]) / 3
    return middle[:, 2] - across * middle[:, 0] - down * (middle[:, 1] - 0.5), across, down


def _fragments(corners: Singles, shape: tuple[int, int], offsets: Singles) -> Iterator[tuple[Integers, Keys, Integers]]:
    """The samples within triangles: their places in the grid; keys, which are the greater, the nearer a triangle is there; and
    the numbers of its parts, the upper ones and then the lower ones."""
    parts, signs = _parts(corners, shape[0]), np.tile(_signs(corners), 2)
    counts = np.maximum(parts.last - parts.first, 0)
    asides = offsets[np.arange(shape[0]) % len(offsets)]
    for some in _blocks(counts):
        many = counts[some]
        row = _along(many) + np.repeat(parts.first[some], many)
        aside = asides[row]
        start, end = (
            np.ceil(np.repeat(place[some], many) + np.repeat(step[some], many) * row - aside)
            for place, step in ((parts.left, parts.left_step), (parts.right, parts.right_step))
        )
        there = np.flatnonzero((start < end) & (end > 0) & (start < shape[1]))
        which, row = np.repeat(np.arange(some.start, some.stop), many)[there], row[there]
        left = np.maximum(start[there], 0).astype(np.int64)
        wide = np.minimum(end[there], shape[1]).astype(np.int64) - left
        across = parts.across[which]
        near, places = parts.near[which] + across * (left + aside[there]) + parts.down[which] * row, row * shape[1] + left
        for part in _blocks(wide):
            size = wide[part]
            along, number = _along(size), np.repeat(which[part], size)
            nearness = np.maximum(np.repeat(near[part], size) + np.repeat(across[part], size) * along, 1e-30)
            keys = nearness.astype(np.float32).view(np.uint32).astype(np.uint64) << np.uint64(32) | signs[number]
            yield np.repeat(places[part], size) + along, keys, number


def _signs(corners: Singles) -> Keys:
    """Numbers by which triangles that are equally near are told apart, made of what they are, not of their order."""
    bits = np.ascontiguousarray(corners).view(np.uint32)
    mixed = (bits * np.array([0x9E3779B1, 0x85EBCA77, 0xC2B2AE3D], np.uint32)).sum(axis=(1, 2), dtype=np.uint32)
    found: Keys = (mixed ^ (mixed >> np.uint32(15))).astype(np.uint64)
    return found


def _blocks(counts: Integers) -> Iterator[slice]:
    """Slices of things, each of which has so many parts, with not too many parts in each slice."""
    ends, first = np.cumsum(counts, dtype=np.int64), 0
    while first < len(counts):
        before = ends[first - 1] if first else 0
        after = max(first + 1, int(np.searchsorted(ends, before + SAMPLES_AT_A_TIME, side="right")))
        yield slice(first, after)
        first = after


def _along(counts: Integers) -> Integers:
    """0, 1, 2, ... for each count."""
    ends = np.cumsum(counts)
    return np.arange(int(ends[-1]) if len(ends) else 0) - np.repeat(ends - counts, counts)


# --- what is lit, and from where ---

SUN = -50.0, 50.0
"""Where the sun stands by itself, in degrees: so far around from the viewer, and above."""
LOWEST = 5.0
"""The sun stands so many degrees above the ground at least."""
REACH = 1.2
"""How far a shadow is seen at most, in extents of what throws it."""
PENUMBRA = 0.035
"""How far the edge of a shadow is seen, as a part of the extent of the scene."""


class Sun(NamedTuple):
    """Where the sun stands, in degrees: around, 0 at the front and 90 at the right, or None for the left of the viewer; and
    above."""

    around: float | None = None
    above: float = SUN[1]

    def turned(self, angle: float) -> Sun:
        """The same for a viewer who has gone around by an angle, as if the plant had turned instead."""
        return self if self.around is None else self._replace(around=self.around + angle)


def sun_from(value: object) -> Sun | None:
    """Where the sun stands, from what a person gives: yes, no, or two angles in degrees; None if there is none.

    >>> sun_from(True), sun_from(("30", 60)), sun_from(False)
    (Sun(around=None, above=50.0), Sun(around=30.0, above=60.0), None)

    Raises
    ------
    ModelValueError
        It is neither, or the sun stands too low.
    """
    if value is True or value is False:
        return Sun() if value else None
    if not isinstance(value, Sequence) or isinstance(value, str) or len(value) != 2:
        raise ModelValueError(f'"light" is True, or two angles, around and above, not {shown(value)}', hint=_SUN_HINT)
    around, above = (real_from(angle, "light", _SUN_HINT) for angle in value)
    if not LOWEST <= above <= 90:
        raise ModelValueError(f"The sun stands {LOWEST:g} to 90 degrees above the ground, not {above:g}", hint=_SUN_HINT)
    return Sun(around % 360, above)


_SUN_HINT = "(-30, 50) is from somewhat left of the front, and from above."


@dataclass(frozen=True)
class LitScene(ProjectedScene):
    """A scene in space as it is seen from one side, in sun and sky.

    Attributes
    ----------
    solid
        The scene in space.
    cylinder
        The cylinder around all that is seen in pictures of its kind.
    base
        How high the ground lies.
    axes, rays
        The directions that appear as right and up, and that towards the viewer; the same as the sun sees it.
    sun
        Where the sun stands.
    seed
        A number for what varies from leaf to leaf.
    leafy
        Whether its surfaces are leaves, which let light through.
    """

    solid: Scene = field(default_factory=Scene)
    cylinder: Cylinder = field(default_factory=lambda: Cylinder(np.zeros(3), 0.0, 0.0))
    base: float = 0.0
    axes: Axes = field(default_factory=lambda: axes(0, 0))
    rays: Axes = field(default_factory=lambda: axes(0, 1))
    sun: Sun = field(default_factory=Sun)
    seed: int = 0
    leafy: bool = True

    @property
    def reach(self) -> float:
        """How far from the middle shadows are seen on the ground."""
        height, towards = 2 * self.cylinder.half_height, self.rays[2]
        length = height * math.hypot(towards[0], towards[1]) / float(towards[2])
        return self.cylinder.radius + min(length, REACH * max(height, 2 * self.cylinder.radius))

    @cached_property
    def box(self) -> tuple[float, float, float, float]:
        """Least x, least y, greatest x, greatest y of it with its shadow, in the plane of the picture."""
        left, bottom, right, top = super().box
        points = np.concatenate([each for each in _corners(self.solid) if len(each)] or [np.zeros((1, 3))])
        towards, middle, height = self.rays[2], self.cylinder.middle, points[:, 2:] - self.base
        fallen = points[:, :2] - middle[:2] - height * (towards[:2] / towards[2])
        far = np.hypot(fallen[:, 0], fallen[:, 1])
        fallen *= np.minimum(1.0, self.reach / np.maximum(far, 1e-30))[:, None]
        below = (points[:, :2] - middle[:2])[height[:, 0] <= NEAR_GROUND * float(np.ptp(points, axis=0).max())]
        ground = np.concatenate([fallen, below]) + middle[:2]
        x, y, _ = _placed(np.column_stack([ground, np.full(len(ground), self.base)]), self)
        aside = PENUMBRA * max(right - left, top - bottom)
        return (
            min(left, float(x.min()) - aside),
            min(bottom, float(y.min()) - aside / 2),
            max(right, float(x.max()) + aside),
            max(top, float(y.max())),
        )


def seen_smoothly(
    scenes: Sequence[Scene], view: View | None, sun: Sun | None, seeds: Sequence[int] = (), leafy: bool = True
) -> list[Scene]:
    """Scenes as they are seen from one place, with finer faces in curved surfaces; in sun and sky, if there is a sun.

    Parameters
    ----------
    scenes, view
        As for `project`.
    sun
        Where the sun stands. Then scenes in the plane are set upright.
    seeds
        For each scene a number for what varies from leaf to leaf; by default 0.
    leafy
        Whether surfaces are leaves, which let light through.
    """
    if sun is None:
        return project_smoothly(scenes, view)
    solids = [smoothed(upright(scene)) for scene in scenes]
    side = view or (FRONT if all(map(lies_flat, solids)) else FROM_THE_RIGHT)
    around = side[0] + SUN[0] if sun.around is None else sun.around
    common: dict[str, Any] = {
        "cylinder": cylinder_around(solids),
        "base": min((float(each[:, 2].min()) for solid in solids for each in _corners(solid) if len(each)), default=0.0),
        "axes": axes(*map(math.radians, side)),
        "rays": axes(math.radians(around), math.radians(sun.above)),
        "sun": sun,
        "leafy": leafy,
    }
    return [
        LitScene(**common, **{each.name: getattr(seen, each.name) for each in fields(seen)}, solid=solid, seed=seed)
        for solid, seen, seed in zip(solids, project(solids, side), seeds or [0] * len(solids), strict=True)
    ]


def upright(scene: Scene) -> Scene:
    """A scene in space; one in the plane is set upright."""
    if scene.dimension == 3:
        return scene
    return replace(
        scene,
        segments=replace(scene.segments, ends=in_space(scene.segments.points).reshape(-1, 6)),
        polygons=replace(scene.polygons, points=in_space(scene.polygons.points)),
        discs=replace(scene.discs, centres=in_space(scene.discs.centres)),
        labels=replace(scene.labels, points=in_space(scene.labels.points)),
    )


def _corners(solid: Scene) -> tuple[Floats, Floats, Floats]:
    """All points of a scene, of discs and spheres those that lie farthest along the axes."""
    ways = np.concatenate([np.eye(3), -np.eye(3)])
    rounds = (solid.discs.centres[:, None] + solid.discs.radii[:, None, None] * ways).reshape(-1, 3)
    return solid.segments.points, solid.polygons.points, rounds


def _placed(points: Reals, scene: LitScene) -> Reals:
    """Points as they are seen, of shape (3, n): to the right, up, and how many times they are magnified."""
    across, up, towards = (_along_axis(points, each, scene.cylinder.middle) for each in scene.axes)
    factors = scene.cylinder.distance / (scene.cylinder.distance - towards)
    return np.stack([across * factors, up * factors, factors])


def _along_axis(points: Reals, axis: Floats, origin: Floats | None = None) -> Reals:
    """How far points lie along an axis: bit for bit the same on every machine, as a product of matrices is not."""
    x, y, z = points.T if origin is None else (points - origin.astype(points.dtype)).T
    a, b, c = axis.astype(points.dtype)
    found: Reals = x * a + y * b + z * c
    return found


# --- surfaces ---


class Surfaces(NamedTuple):
    """Triangles with what the light finds on them.

    vertices, normals, triangles
        As of `Mesh`.
    colours
        Shape (n, 3): red, green and blue of each vertex, as parts of the light that comes back.
    thin
        Shape (n,): whether it belongs to a sheet, which has two sides and is no closed solid.
    """

    vertices: Singles
    normals: Singles
    triangles: Numbers
    colours: Singles
    thin: Flags


THINNEST = 0.8
"""The least width of strokes, in pixels."""
FLATTER = 0.3
"""A triangle is flat if the cosine of the angle between its normal and those at its corners is less than this."""
VARIED = 0.22, 0.12
"""By which parts a leaf is lighter or darker than others at most, and more yellow or blue."""
SAME = 1e-6
"""Corners of polygons that are closer than this part of the extent of the scene are one."""
MOST_ROUNDS = 64
"""Leaves of more faces in a row than this, or about twice as many, may be taken for several."""


def surfaces_of(scene: LitScene, colour_of: Mapping[int, str], sheet: Sheet) -> Surfaces:
    """The surfaces of a scene, with strokes as broad as in other pictures of it, as far as they can be seen."""
    segments, scale = scene.segments, sheet.frame.scale
    widths = stroke_widths(segments, scale, boldness(segments, scale, len(segments) <= MOST_CYLINDERS)) / (10 * scale)
    solid = replace(scene.solid, segments=replace(scene.solid.segments, widths=np.maximum(widths, THINNEST / sheet.scale)))
    mesh, thin = mesh_with_sheets(solid, 1 / sheet.scale)
    names, numbers = numbered_colours(mesh.states, mesh.colours, colour_of)
    colours = np.array([_linear(_channels(name)) for name in sunlit_colours(names)], np.float32)[numbers]
    if scene.leafy and len(solid.polygons):
        sizes = np.diff(solid.polygons.starts)
        some = np.flatnonzero(thin)[: len(solid.polygons.points)]
        colours[some] *= np.repeat(_variety(leaves(solid.polygons), scene.seed), sizes, axis=0)
    return _with_flat_ends(Surfaces(mesh.vertices, mesh.normals, mesh.triangles, np.minimum(colours, np.float32(0.95)), thin))


def _with_flat_ends(surfaces: Surfaces) -> Surfaces:
    """Surfaces in which triangles that face another way than their corners, as those that close a tube, are flat."""
    a, b, c = (surfaces.vertices[surfaces.triangles[:, k]].T for k in range(3))
    one, other = b - a, c - a
    facing = np.stack([one[k - 2] * other[k - 1] - one[k - 1] * other[k - 2] for k in range(3)])
    facing /= np.maximum(np.sqrt((facing**2).sum(axis=0)), np.float32(1e-30))
    smooth = sum((facing * surfaces.normals[surfaces.triangles[:, k]].T).sum(axis=0) for k in range(3))
    flat = np.flatnonzero((smooth < 3 * FLATTER) & ~surfaces.thin[surfaces.triangles[:, 0]])
    if not len(flat):
        return surfaces
    corners, triangles = surfaces.triangles[flat].ravel(), surfaces.triangles.copy()
    triangles[flat] = len(surfaces.vertices) + np.arange(len(corners)).reshape(-1, 3)
    return Surfaces(
        np.concatenate([surfaces.vertices, surfaces.vertices[corners]]),
        np.concatenate([surfaces.normals, np.repeat(facing.T[flat], 3, axis=0)]),
        triangles,
        np.concatenate([surfaces.colours, surfaces.colours[corners]]),
        np.concatenate([surfaces.thin, surfaces.thin[corners]]),
    )


SUNLIT = tuple(COLOURS["sunlit"].items())
"""Colours of bark and leaves, and what they are in sunlight."""


def sunlit_colours(names: Sequence[str]) -> list[str]:
    """Colours in sunlight: those of bark and leaves are natural, others as they are, and so are those that a person has chosen.

    >>> sunlit_colours(["#28A964", "#B97FB3"])
    ['#7BA53E', '#B97FB3']
    """
    chosen = {colour for _, colour in theme().symbols}
    return [name if name in chosen else dict(SUNLIT).get(name, name) for name in names]


def leaves(polygons: Polygons) -> Integers:
    """For each polygon the number of its leaf: polygons that have edges in common are one leaf.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.turtle.space import trace_in_space
    >>> twig = trace_in_space(derive(read("axiom: F[&(60)~L][^(60)~L]"), 0)[0])
    >>> np.unique(leaves(twig.polygons), return_counts=True)[1].tolist()  # two leaves, and their stalks, which meet
    [28, 4, 28]
    """
    extent = float(np.ptp(polygons.points, axis=0).max()) or 1.0
    corner = numbered(np.rint(polygons.points / (SAME * extent)).astype(np.int64))
    following = np.arange(1, len(corner) + 1)
    following[polygons.starts[1:] - 1] = polygons.starts[:-1]
    edge = numbered(np.sort(np.stack([corner, corner[following]], axis=1), axis=1))
    label, starts = np.arange(len(polygons)), polygons.starts[:-1]
    of_edge = np.empty(int(edge.max(initial=-1)) + 1, np.int64)
    for _ in range(MOST_ROUNDS):
        check_budget()
        of_edge[:] = len(polygons)
        np.minimum.at(of_edge, edge, np.repeat(label, np.diff(polygons.starts)))
        found = np.minimum.reduceat(of_edge[edge], starts)
        found = found[found]
        if (found == label).all():
            break
        label = found
    return np.unique(label, return_inverse=True)[1].astype(np.int64)


def _variety(numbers: Integers, seed: int) -> Singles:
    """By which factors the colours of leaves differ from that of all, shape (n, 3)."""
    lighter, warmer = (2 * units(seed, step, numbers) - 1 for step in (0, 1))
    bright = 1 + VARIED[0] * lighter
    return np.stack([bright * (1 + VARIED[1] * warmer), bright, bright * (1 - VARIED[1] * warmer)], axis=1).astype(np.float32)


def _linear(channels: Reals) -> Reals:
    """The linear intensities of channels of sRGB, from 0 to 1 (IEC 61966-2-1)."""
    found: Reals = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return found


def _encoded(light: Reals) -> Reals:
    """The channels of sRGB of linear intensities."""
    found: Reals = np.where(light <= 0.0031308, light * 12.92, 1.055 * np.maximum(light, 1e-6) ** (1 / 2.4) - 0.055)
    return found


# --- shadows ---

LEAST_MAP, MOST_MAP, GROUND_MAP = 640, 1_536, 384
"""The longer sides of maps of shadows, in points: that of the sun at least and at most, and about that of the ground."""
SOFT = 0.003
"""The radius of the edge of a shadow on a surface, in extents of the scene."""
TAPS = 4
"""At so many points around a sample it is seen whether the sun reaches it."""
SUN_RADIUS = 0.035
"""How broad the edge of a shadow on the ground is, in parts of the way from what throws it."""
BLURS = (0.0015, 0.004, 0.01, 0.025, 0.06)
"""The radii of the blurred maps between which the edges of shadows lie, in extents of the scene."""


class ShadowMap(NamedTuple):
    """What the sun sees: how near to it the nearest surface is, point by point.

    nearness
        0 where there is none.
    corner
        What lies at the left upper corner: so far to the right and up for the sun.
    point
        How broad a point is.
    farthest
        How near something of nearness 1 lies.
    extent
        How broad or high the map is, whichever is more.
    """

    nearness: Singles
    corner: tuple[float, float]
    point: float
    farthest: float
    extent: float

    def places(self, points: Reals, sun: Axes) -> tuple[Reals, Reals, Reals]:
        """The columns, the rows and the nearness of points in space."""
        across, up, towards = (_along_axis(points, each) for each in sun)
        one = np.float32(1 / self.point)
        return (across - np.float32(self.corner[0])) * one, (np.float32(self.corner[1]) - up) * one, self._near(towards)

    def _near(self, towards: Reals) -> Reals:
        found: Reals = (towards - np.float32(self.farthest)) * np.float32(1 / self.extent) + np.float32(1)
        return found


def shadow_map(surfaces: Surfaces, sun: Axes, side: int) -> ShadowMap:
    """What the sun sees of some surfaces, in a map whose longer side has so many points."""
    across, up, towards = (_along_axis(surfaces.vertices, each) for each in sun)
    left, top = float(across.min()), float(up.max())
    wide, high = float(across.max()) - left, top - float(up.min())
    extent = max(wide, high, 1e-12)
    shape = tuple(max(1, math.ceil(each * side / extent)) for each in (high, wide))
    found = ShadowMap(np.empty((0, 0), np.float32), (left, top), extent / side, float(towards.min()), extent)
    places = np.stack(found.places(surfaces.vertices, sun), axis=1)
    seen = nearest(places, surfaces.triangles, (shape[0], shape[1]), offsets_of(1), surfaces.thin[surfaces.triangles[:, 0]])
    return found._replace(nearness=seen.nearness)


class Ground(NamedTuple):
    """What falls on the ground: how much of the sun, and of the sky, does not reach each point of a map of it.

    shade
        What the sun's own map of the ground says, point by point.
    corner, point
        As of `ShadowMap`.
    dimness
        How much of the sky is hidden, point by point of a square around the middle.
    side
        Half the side of that square.
    """

    shade: Singles
    corner: tuple[float, float]
    point: float
    dimness: Singles
    side: float


NEAR_GROUND, HIDING = 0.1, 0.9
"""Below this height, in extents of the scene, things hide the sky from the ground under them; how much they do."""
DIM_MAP, DIM_BLUR, MOST_SCATTERED = 128, 0.035, 200_000
"""That map is so many points wide, and blurred by this part of the extent; so many points about tell what lies above."""


def ground_of(scene: LitScene, surfaces: Surfaces, sun: ShadowMap) -> Ground:
    """What falls on the ground below some surfaces."""
    every = max(1, round(max(sun.nearness.shape) / GROUND_MAP))
    rows, columns = (-(-side // every) * every for side in sun.nearness.shape)
    padded = np.zeros((rows, columns), np.float32)
    padded[: sun.nearness.shape[0], : sun.nearness.shape[1]] = sun.nearness
    tiles = padded.reshape(rows // every, every, columns // every, every)
    covered = (tiles > 0).mean(axis=(1, 3), dtype=np.float32)
    near = tiles.sum(axis=(1, 3)) / np.maximum((tiles > 0).sum(axis=(1, 3)), 1)
    point, extent = sun.point * every, sun.extent
    up = sun.corner[1] - (np.arange(rows // every) + 0.5) * point
    ground = (scene.base - up * scene.rays[1][2]) / scene.rays[2][2]
    fall = np.maximum((near - 1) * extent + sun.farthest - ground[:, None], 0).astype(np.float32)
    radii = np.array(BLURS, np.float32) * extent
    level = np.interp(np.log(np.maximum(SUN_RADIUS * fall, radii[0])), np.log(radii), np.arange(len(radii)))
    margin = math.ceil(3 * radii[-1] / point)
    shade = np.zeros((covered.shape[0] + 2 * margin, covered.shape[1] + 2 * margin), np.float32)
    for number, radius in enumerate(radii.tolist()):
        share = covered * np.clip(1 - np.abs(level - number), 0, 1).astype(np.float32)
        shade += blurred(np.pad(share, margin), radius / point)
    corner = sun.corner[0] - margin * point, sun.corner[1] + margin * point
    return Ground(np.clip(shade, 0, 1), corner, point, *_dimness(scene, surfaces, extent))


def _dimness(scene: LitScene, surfaces: Surfaces, extent: float) -> tuple[Singles, float]:
    """How much of the sky things near the ground hide from it."""
    side = scene.cylinder.radius * 1.2 + extent * 3 * DIM_BLUR
    cell = 2 * side / DIM_MAP
    places, areas = _scattered(surfaces, cell**2)
    weights = areas * np.exp(-(places[2] - scene.base) / (NEAR_GROUND * extent))
    column, row = (
        np.clip((places[k] - scene.cylinder.middle[k] + side) / cell, 0, DIM_MAP - 1).astype(np.int64) for k in (0, 1)
    )
    dense = np.bincount(row * DIM_MAP + column, weights, DIM_MAP**2).reshape(DIM_MAP, DIM_MAP) / cell**2
    return (1 - np.exp(-HIDING * blurred(dense.astype(np.float32), DIM_BLUR * extent / cell))).astype(np.float32), side


def _scattered(surfaces: Surfaces, area: float) -> tuple[Singles, Singles]:
    """Points all over surfaces, shape (3, n), one for about so much area, and how much there is to each."""
    a, b, c = (surfaces.vertices[surfaces.triangles[:, k]].T for k in range(3))
    one, other = b - a, c - a
    whole = np.sqrt(sum((one[k - 2] * other[k - 1] - one[k - 1] * other[k - 2]) ** 2 for k in range(3))) / 2
    counts = np.clip(np.ceil(whole / area), 1, MOST_SCATTERED // len(whole) + 1).astype(np.int32)
    which, number = np.repeat(np.arange(len(counts)), counts), _along(counts)
    u, v = (
        (np.float32(0.5) + number * np.float32(part)) % 1 for part in (0.7548777, 0.5698403)
    )  # evenly spread (Roberts 2018)
    folded = u + v > 1
    u, v = np.where(folded, 1 - u, u), np.where(folded, 1 - v, v)
    found: Singles = a[:, which] + one[:, which] * u + other[:, which] * v
    return found, (whole / counts)[which]


def blurred(numbers: Singles, radius: float) -> Singles:
    """A map of numbers in which each is spread about a disc of about some radius, in points: three times by a square.

    >>> spot = np.zeros((9, 9), np.float32)
    >>> spot[4, 4] = 1
    >>> found = blurred(spot, 2)
    >>> round(float(found.sum()), 5), np.allclose(found, found.T), bool(found[4, 4] == found.max())
    (1.0, True, True)
    """
    half = round(radius / 2)
    for _ in range(3 if half else 0):
        for axis in (0, 1):
            numbers = _box(numbers, half, axis)
    return numbers


def _box(numbers: Singles, half: int, axis: int) -> Singles:
    """The mean of each number and so many on both sides of it; beyond the edge there is nothing."""
    sides = [(0, 0), (0, 0)]
    sides[axis] = (half + 1, half)
    sums = np.cumsum(np.pad(numbers, sides), axis=axis, dtype=np.float32)
    many = 2 * half + 1
    ahead, behind = (sums[many:], sums[:-many]) if axis == 0 else (sums[:, many:], sums[:, :-many])
    found: Singles = (ahead - behind) * np.float32(1 / many)
    return found


def _between(found: Singles, column: Reals, row: Reals) -> Reals:
    """Numbers of a map at places between its points; 0 outside."""
    height, width = found.shape
    x, y = column - np.float32(0.5), row - np.float32(0.5)
    inside = (x >= 0) & (y >= 0) & (x < width - 1) & (y < height - 1)
    x, y = np.where(inside, x, 0), np.where(inside, y, 0)
    left, top = x.astype(np.int64), y.astype(np.int64)
    x, y = x - left, y - top
    flat, place = found.ravel(), top * width + left
    right, below = min(1, width - 1), width * min(1, height - 1)
    upper = flat[place] * (1 - x) + flat[place + right] * x
    lower = flat[place + below] * (1 - x) + flat[place + below + right] * x
    here: Reals = np.where(inside, upper * (1 - y) + lower * y, 0).astype(np.float32)
    return here


# --- what the sky reaches ---

RINGS, SPOKES = (0.25, 0.6, 1.0), 4
"""At these parts of a radius and in so many directions a picture is asked for what hides the sky; in both of each."""
HIDDEN_WITHIN, DARKEST = 0.05, 0.75
"""That radius, in extents of the scene; and how much of the sky is hidden at most."""


def openness(depth: Singles, scale: float, extent: float) -> Singles:
    """How much of the sky reaches each pixel, given how far towards the viewer it lies: hollows are dark.

    depth
        Shape (rows, columns); far away where there is nothing.
    scale
        The pixels of a unit.
    extent
        The extent of the scene.
    """
    reach, hidden = HIDDEN_WITHIN * extent, np.zeros_like(depth)
    for number, ring in enumerate(RINGS):
        for spoke in range(SPOKES):
            check_budget()
            angle = math.pi * (spoke + number / len(RINGS)) / SPOKES
            across, down = (round(ring * reach * scale * way) for way in (math.cos(angle), math.sin(angle)))
            if across or down:
                hidden += _hidden(depth, across, down, np.float32(1 / (ring * reach)))
    found: Singles = np.clip(1 - hidden * np.float32(1 / (len(RINGS) * SPOKES)), 1 - DARKEST, 1)
    return found


def _hidden(depth: Singles, across: int, down: int, one: np.float32) -> Singles:
    """How much is hidden by what lies on both sides of each pixel."""
    rows, columns = depth.shape
    total = np.zeros_like(depth)
    for x, y in ((across, down), (-across, -down)):
        here = (slice(max(0, -y), rows - max(0, y)), slice(max(0, -x), columns - max(0, x)))
        there = (slice(max(0, y), rows - max(0, -y)), slice(max(0, x), columns - max(0, -x)))
        if here[0].stop <= here[0].start or here[1].stop <= here[1].start:
            continue
        rise = np.clip((depth[there] - depth[here]) * one, -1, 4)
        total[here] += np.minimum(rise, np.maximum(np.float32(1.5) - rise / 2, 0))
    return np.clip(total, 0, 1)


# --- the picture ---

SAMPLE_BYTES, SURFACE_BYTES = 40, 120
"""About what a sample takes in memory, and a triangle with its vertices."""
SUNLIGHT, SKYLIGHT = (1.3, 1.2, 1.03), (0.5, 0.56, 0.62)
BOUNCED, SHADOW = 0.22, 0.5
"""The part of the light that the ground gives back to what looks downwards; how dark a shadow on it is at most."""
POOL, TINT = 0.2, (1.0, 0.97, 0.9)
"""How much lighter dark paper is where the sun falls on it; and the parts of red, green and blue that a shadow takes."""
EDGE, BROAD_EDGE = 0.02, 0.3
"""How broad the edge of the picture is in which shadows fade, and the light on dark paper, as parts of its longer side."""
THROUGH, LEAF = 0.8, (1.0, 1.0, 0.45)
"""How much light goes through a leaf, compared with what comes back from it, and its parts of red, green and blue."""
GLOSS, GLOSSY = 0.05, 12
"""How bright a reflection of the sun is, and how narrow."""


MANY_PIXELS = 600_000
"""A picture of more pixels has four samples for each, another eight."""


def lit_pixels(scene: LitScene, colour_of: Mapping[int, str], frame: ViewFrame, enlarged: float = 1.0) -> NDArray[np.uint8]:
    """The picture of a scene in sun and sky, in a frame that may be enlarged: shape (rows, columns, 3)."""
    sheet = Sheet(frame, enlarged, round(frame.width * enlarged), round(frame.height * enlarged))
    return rendered(scene, surfaces_of(scene, colour_of, sheet), sheet)


def rendered(scene: LitScene, surfaces: Surfaces, sheet: Sheet) -> NDArray[np.uint8]:
    """The pixels of a sheet with the surfaces of a scene."""
    samples, paper = _samples_for(sheet.width * sheet.height, len(surfaces.triangles)), _channels(theme().ground)
    if not len(surfaces.triangles):
        return np.broadcast_to(np.rint(255 * paper).astype(np.uint8), (sheet.height, sheet.width, 3)).copy()
    across, up, factors = _placed(surfaces.vertices, scene)
    points = np.stack([sheet.columns(across), sheet.rows(up) * samples, factors], axis=1).astype(np.float32)
    thin = surfaces.thin[surfaces.triangles[:, 0]]
    seen = nearest(points, surfaces.triangles, (sheet.height * samples, sheet.width), offsets_of(samples), thin)
    sunny = shadow_map(surfaces, scene.rays, min(MOST_MAP, max(LEAST_MAP, round(1.25 * max(sheet.width, sheet.height)))))
    ground = ground_of(scene, surfaces, sunny)
    sky = openness(_depth(scene, sheet, seen.nearness[samples // 2 :: samples]), sheet.scale, sunny.extent)
    image = np.empty((sheet.height, sheet.width, 3), np.uint8)
    each = max(1, SAMPLES_AT_A_TIME // (samples * sheet.width))
    for first in range(0, sheet.height, each):
        check_budget()
        band = slice(first, min(first + each, sheet.height))
        covered, colours = _surface_light(scene, surfaces, sheet, (points, seen, sunny, sky), band, samples)
        below = _ground_light(scene, sheet, ground, band, paper)
        image[band] = np.rint(255 * np.clip(colours + (1 - covered) * below, 0, 1))
    return image


def _samples_for(pixels: int, triangles: int) -> int:
    """As many samples of a pixel as there is memory for, and more for small pictures."""
    needed = {samples: SAMPLE_BYTES * pixels * samples + SURFACE_BYTES * triangles for samples in LATTICES}
    check_bytes(needed[1], lambda: "The picture was not drawn")
    usual = 8 if pixels <= MANY_PIXELS else 4
    return max(samples for samples, size in needed.items() if size <= current().bytes and samples <= usual)


class Sheet(NamedTuple):
    """The pixels of a picture: its frame, by how much that is enlarged, and the pixels across and down."""

    frame: ViewFrame
    enlarged: float
    width: int
    height: int

    @property
    def scale(self) -> float:
        """The pixels of a unit."""
        return self.frame.scale * self.enlarged

    def columns(self, across: Floats) -> Floats:
        return (across - self.frame.left) * self.scale + MARGIN * self.enlarged

    def rows(self, up: Floats) -> Floats:
        return (self.frame.top - up) * self.scale + MARGIN * self.enlarged

    def across(self, columns: Singles) -> Singles:
        """What is seen in some columns: how far to the right it lies."""
        return (columns - np.float32(MARGIN * self.enlarged)) * np.float32(1 / self.scale) + np.float32(self.frame.left)

    def up(self, rows: Singles) -> Singles:
        """How far up lies what is seen in some rows."""
        return np.float32(self.frame.top) - (rows - np.float32(MARGIN * self.enlarged)) * np.float32(1 / self.scale)

    def pixels(self, rows: slice) -> tuple[Singles, Singles]:
        """How far to the right and up the middles of pixels lie, in a row and in a column that spread over each other."""
        middle = np.float32(0.5)
        columns, lines = (np.arange(*each, dtype=np.float32) + middle for each in ((0, self.width), (rows.start, rows.stop)))
        return self.across(columns)[None, :], self.up(lines)[:, None]


def _channels(colour: str) -> Singles:
    return np.frombuffer(bytes.fromhex(colour[1:]), np.uint8).astype(np.float32) / np.float32(255)


def _depth(scene: LitScene, sheet: Sheet, nearness: Singles) -> Singles:
    """How far towards the viewer each pixel lies: a surface, the ground, or nothing."""
    distance = np.float32(scene.cylinder.distance)
    _, _, towards, there = _on_ground(scene, *sheet.pixels(slice(0, sheet.height)))
    empty = np.where(there, towards, -16 * distance)
    found: Singles = np.where(nearness > 0, distance - distance / np.maximum(nearness, np.float32(1e-6)), empty)
    return found.astype(np.float32)


def _on_ground(scene: LitScene, across: Reals, up: Reals) -> tuple[Reals, Reals, Reals, Flags]:
    """The points of the ground that are seen at places of the picture: x and y from the middle, how far towards the viewer, and
    whether there is any."""
    right, above, towards = scene.axes
    distance, height = scene.cylinder.distance, scene.cylinder.middle[2] - scene.base
    falling = (distance * towards[2] - up * above[2]).astype(np.float32)  # of the way from the eye to the plane of the picture
    eye = distance * towards[2] + height
    there = np.broadcast_to((falling > 1e-6 * distance) & (eye > 0), np.broadcast_shapes(across.shape, up.shape))
    part = np.float32(eye) / np.where(falling > 1e-6 * distance, falling, np.float32(1e30))
    x, y = (
        part * (across * np.float32(right[k]) + up * np.float32(above[k]) - np.float32(distance * towards[k]))
        + np.float32(distance * towards[k])
        for k in (0, 1)
    )
    return x, y, np.broadcast_to(np.float32(distance) * (1 - part), x.shape), there


def _ground_light(scene: LitScene, sheet: Sheet, ground: Ground, band: slice, paper: Singles) -> Singles:
    """The colours of the paper, on which shadows fall as if it were the ground; far away it is bare."""
    x, y, _, there = _on_ground(scene, *sheet.pixels(band))
    right, up, _ = scene.rays
    z = np.float32(scene.base)
    world = x + np.float32(scene.cylinder.middle[0]), y + np.float32(scene.cylinder.middle[1])
    across, upwards = (world[0] * np.float32(a[0]) + world[1] * np.float32(a[1]) + z * np.float32(a[2]) for a in (right, up))
    one = np.float32(1 / ground.point)
    shade = _between(
        ground.shade, (across - np.float32(ground.corner[0])) * one, (np.float32(ground.corner[1]) - upwards) * one
    )
    cell = np.float32(DIM_MAP / (2 * ground.side))
    dim = _between(ground.dimness, (x + np.float32(ground.side)) * cell, (y + np.float32(ground.side)) * cell)
    far = np.clip(np.hypot(x, y) * np.float32(1 / (scene.reach or 1.0)), 0, 1)
    fading = (1 - far**3) * there * _inside(sheet, band, EDGE)
    dark = 1 - (1 - np.float32(SHADOW) * shade * fading) * (1 - np.float32(SHADOW) * dim * fading)
    if theme().dark:
        paper = paper + (1 - paper) * np.float32(POOL) * (fading * (1 - far**2) * _inside(sheet, band, BROAD_EDGE))[..., None]
    found: Singles = paper * (1 - dark[..., None] * np.array(TINT, np.float32))
    return found


def _inside(sheet: Sheet, band: slice, edge: float) -> Singles:
    """How far inside the picture its pixels are, from 0 at the edge to 1, given how broad that is as a part of the picture."""
    rows, columns = (
        np.clip(np.minimum(line, many - line) / np.float32(edge * max(sheet.width, sheet.height)), 0, 1)
        for line, many in (
            (np.arange(band.start, band.stop, dtype=np.float32) + np.float32(0.5), sheet.height),
            (np.arange(sheet.width, dtype=np.float32) + np.float32(0.5), sheet.width),
        )
    )
    found: Singles = (rows * rows * (3 - 2 * rows))[:, None] * (columns * columns * (3 - 2 * columns))
    return found


Work: TypeAlias = tuple[Singles, Seen, ShadowMap, Singles]
"""Where vertices are in the picture, what is seen there, what the sun sees, and what the sky reaches."""


def _surface_light(
    scene: LitScene, surfaces: Surfaces, sheet: Sheet, work: Work, band: slice, samples: int
) -> tuple[Reals, Reals]:
    """How much of each pixel of some rows is covered by surfaces, and their colour there, as channels of sRGB, times that."""
    points, seen, sunny, sky = work
    lines = slice(band.start * samples, band.stop * samples)
    which = seen.triangles[lines]
    row, column = np.nonzero(which != NONE)
    shape = (band.stop - band.start, sheet.width)
    if not len(row):
        return np.zeros((*shape, 1), np.float32), np.zeros((*shape, 3), np.float32)
    corners, near = surfaces.triangles[which[row, column]], seen.nearness[lines][row, column]
    line = row + lines.start
    x = column.astype(np.float32) + offsets_of(samples)[line % samples]
    y = line.astype(np.float32) + np.float32(0.5)
    normals = _normals_at(points[:, :2], surfaces.normals, corners, x, y)
    place = _unprojected(scene, sheet.across(x), sheet.up(y * np.float32(1 / samples)), near)
    pixel = row // samples * sheet.width + column
    hidden = sky[band].ravel()[pixel]
    thin = surfaces.thin[corners[:, 0]]
    light = _light(scene, sunny, place, normals, thin, hidden, line % samples)
    shown = _encoded(_softly(surfaces.colours[corners[:, 0]] * light[0] + light[1]))
    many = shape[0] * shape[1]
    covered: Reals = np.bincount(pixel, minlength=many).astype(np.float32) / samples
    colours: Reals = np.stack([np.bincount(pixel, shown[:, k], many).astype(np.float32) / samples for k in range(3)], axis=1)
    return covered.reshape(*shape, 1), colours.reshape(*shape, 3)


def _normals_at(points: Singles, normals: Singles, corners: Numbers, x: Singles, y: Singles) -> Singles:
    """The unit normals of triangles at places of the picture, shape (3, n)."""
    (ax, ay), (bx, by), (cx, cy) = (points[corners[:, k]].T for k in range(3))
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    area = np.where(np.abs(area) > 1e-9, area, np.float32(1e9))
    one = np.clip(((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area, 0, 1)
    two = np.clip(((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area, 0, 1)
    weights = (np.maximum(1 - one - two, 0), one, two)
    found = sum(normals[corners[:, k]].T * weights[k] for k in range(3))
    length = np.sqrt(found[0] ** 2 + found[1] ** 2 + found[2] ** 2)
    unit: Singles = (found / np.where(length > 0, length, np.float32(1))).astype(np.float32)
    return unit


def _unprojected(scene: LitScene, across: Reals, up: Reals, near: Reals) -> Reals:
    """Points in space from where they are seen, and how many times they are magnified there; shape (3, n)."""
    away = np.float32(1) / near
    parts = across * away, up * away, np.float32(scene.cylinder.distance) * (1 - away)
    return np.stack(
        [
            sum(
                (part * np.float32(axis[k]) for part, axis in zip(parts, scene.axes, strict=True)),
                np.float32(scene.cylinder.middle[k]),
            )
            for k in range(3)
        ]
    )


def _light(
    scene: LitScene, sunny: ShadowMap, place: Reals, normals: Reals, thin: Flags, open_sky: Singles, line: Integers
) -> tuple[Reals, Reals]:
    """The light that falls on points of surfaces, and what is reflected as by a mirror, each of shape (n, 3)."""
    towards = scene.axes[2] * scene.cylinder.distance + scene.cylinder.middle
    sight = towards.astype(np.float32)[:, None] - place
    sight /= np.sqrt((sight**2).sum(axis=0))
    behind = thin & ((sight * normals).sum(axis=0) < 0)
    normals = np.where(behind, -normals, normals)
    sun = scene.rays[2].astype(np.float32)[:, None]
    facing = (normals * sun).sum(axis=0)
    extent = sunny.extent
    aside = np.sqrt(np.maximum(1 - facing**2, 0)) * np.float32(SOFT * extent) + np.float32(1.5 * sunny.point)
    outward = normals * np.where(facing < 0, -aside, aside)
    sunlit = _reached(sunny, (place + outward).T, scene.rays, line, SOFT * extent)
    front = np.maximum(facing, 0) * sunlit
    through = np.maximum(-facing, 0) * sunlit * (thin & scene.leafy)
    half = sight + sun
    half /= np.sqrt((half**2).sum(axis=0))
    gloss = np.clip((normals * half).sum(axis=0), 0, 1) ** GLOSSY * front * np.float32(GLOSS)
    upwards = np.float32(0.5) + np.float32(0.5) * normals[2]
    sky = (upwards + (1 - upwards) * np.float32(BOUNCED)) * open_sky
    sunlight, skylight, leaf = (np.array(colour, np.float32) for colour in (SUNLIGHT, SKYLIGHT, LEAF))
    green = sunlight * (leaf * np.float32(THROUGH))
    light = front[:, None] * sunlight + through[:, None] * green + sky[:, None] * skylight
    shine: Reals = gloss[:, None] * sunlight
    return light, shine


def _reached(sunny: ShadowMap, points: Reals, sun: Axes, line: Integers, soft: float) -> Singles:
    """How much of the sun reaches points, which is asked at some places around each; at others for each sample of a pixel."""
    column, row, near = sunny.places(points, sun)
    height, width = sunny.nearness.shape
    flat, found = sunny.nearness.ravel(), np.zeros(len(points), np.float32)
    turns = (np.arange(TAPS)[:, None] * len(LATTICES[8]) + np.arange(8)) * 2.399963  # the golden angle
    radii = np.sqrt((np.arange(TAPS)[:, None] + (np.arange(8) + 0.5) / 8) / TAPS) * soft / sunny.point
    for tap in range(TAPS):
        x = np.clip(column + (radii[tap] * np.cos(turns[tap])).astype(np.float32)[line], 0, width - 1).astype(np.int64)
        y = np.clip(row + (radii[tap] * np.sin(turns[tap])).astype(np.float32)[line], 0, height - 1).astype(np.int64)
        found += flat[y * width + x] <= near
    return found * np.float32(1 / TAPS)


def _softly(light: Reals) -> Reals:
    """Light that a picture can show: what is too bright comes close to white."""
    found: Reals = light / (1 + light**4) ** np.float32(0.25)
    return found
