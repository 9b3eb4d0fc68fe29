"""Scenes in space as they are seen from one side: in perspective, with the order of their shapes from far to near.

The eye looks at the middle of an upright cylinder around all that is seen, from so far that near things do not look distorted.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.derivation.core.rules import real_from
from lsys_kit.errors import ModelValueError, shown
from lsys_kit.geometry.meshes.mesh import normals_of, start_widths
from lsys_kit.geometry.scene import OWN, Floats, Integers, Labels, Polygons, Scene, Segments, no_labels
from lsys_kit.geometry.smoothing import smoothed

if TYPE_CHECKING:
    from numpy.typing import NDArray


def are_edges(segments: Segments, polygons: Polygons) -> NDArray[np.bool_]:
    """Which strokes are edges of polygons.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.turtle.space import trace_in_space
    >>> leaf = trace_in_space(derive(read("axiom: F & { . F + (120) F } F"), 0)[0])
    >>> are_edges(leaf.segments, leaf.polygons).tolist()
    [False, True, True, False]
    """
    if not (len(polygons) and len(segments)):
        return np.zeros(len(segments), bool)
    points, following = polygons.points, np.arange(1, len(polygons.points) + 1)
    following[polygons.starts[1:] - 1] = polygons.starts[:-1]
    edges = np.concatenate([np.hstack([points, points[following]]), np.hstack([points[following], points])])
    return np.isin(_keys(segments.ends), _keys(edges))


def _keys(rows: Floats) -> NDArray[np.void]:
    whole = np.ascontiguousarray(rows + 0.0)  # which makes no difference between 0 and -0
    return whole.view(np.dtype((np.void, whole.strides[0]))).ravel()


Axes: TypeAlias = tuple[Floats, Floats, Floats]
"""The directions that appear as right and up, and the one towards the viewer."""
View: TypeAlias = tuple[float, float]
"""The side of the viewer, in degrees: around, 0 at the front and 90 at the right; and above, 0 level and 90 from the top."""
FRONT, FROM_THE_RIGHT = (0, 0), (30, 15)
"""The front; and the usual view of what is in space, where few branches hide one another."""
LEVELS = 2**15
"""Depths are compared as so many levels over the extent of a scene, so that rounding errors bring nothing forward."""
DISTANCE = 4.0
"""The distance of the eye from the middle, in radii of the sphere around what is seen."""
FLAT = 1e-9
"""What is no deeper than this part of its extent lies in the plane."""
MOST_CYLINDERS = 10_000
"""Of more strokes one sees none by itself, and they are painted as plain lines."""
_VIEW_HINT = "(30, 15) is from somewhat right of the front, and from above."
EDGE_ON = 1e-9
"""How far a unit normal may point away from the viewer by rounding alone, where a polygon is seen from its edge."""


@dataclass(frozen=True)
class ProjectedScene(Scene):
    """A scene in space as it is seen from one side: its shapes in the plane of the picture, and what depth does to them.

    Attributes
    ----------
    depths
        Shape (n,): how far polygons, strokes and discs, counted in this order, lie towards the viewer.
    nearness
        Shape (n,): the same as a number from 0, the farthest place in the cylinder around the scene, to 1, the nearest.
    factors
        Shape (s, 2): how much broader each stroke is at both ends: in perspective, and where it continues a broader one.
    casing_depths
        Shape (s,): how far the casings of strokes lie towards the viewer: behind their strokes by the lengths of these, and
        behind everything where a stroke is an edge of a polygon, from which it must not be parted. Shape (0,) where strokes
        have none.
    normals
        Shape (p, 3): the unit normal of each polygon: to the right, up and towards the viewer, where it never points away.
    extent
        The greatest extent of the scene along an axis.
    """

    depths: Floats = field(default_factory=lambda: np.empty(0))
    nearness: Floats = field(default_factory=lambda: np.empty(0))
    factors: Floats = field(default_factory=lambda: np.empty((0, 2)))
    casing_depths: Floats = field(default_factory=lambda: np.empty(0))
    normals: Floats = field(default_factory=lambda: np.empty((0, 3)))
    extent: float = 0.0

    @property
    def order(self) -> Integers:
        """The numbers of polygons, strokes and discs from far to near; what is as far away stays in this order."""
        return far_to_near(self.depths, self.extent)


def view_from(value: object) -> View:
    """A view from what a person gives: two angles in degrees, around and above.

    >>> view_from(("30", 15))
    (30.0, 15.0)

    Raises
    ------
    ModelValueError
        It is no pair of angles.
    """
    if not isinstance(value, Sequence) or isinstance(value, str) or len(value) != 2:
        raise ModelValueError(f"A view is two angles, around and above, not {shown(value)}", hint=_VIEW_HINT)
    around, above = (real_from(angle, "view", _VIEW_HINT) for angle in value)
    return around, above


def far_to_near(depths: Floats, extent: float) -> Integers:
    """The numbers of shapes from far to near, given how far each lies towards the viewer.

    >>> far_to_near(np.array([1.0, -1.0, 1.0 + 1e-9]), 2.0).tolist()
    [1, 0, 2]
    """
    levels = np.rint(depths * (LEVELS / (extent or 1.0)))
    return np.argsort((levels - levels.min(initial=np.inf)).astype(np.uint16), kind="stable")


@dataclass(frozen=True)
class Cylinder:
    """The upright cylinder around what is seen: its middle, its radius and half its height. No turn leads out of it."""

    middle: Floats
    radius: float
    half_height: float

    @property
    def distance(self) -> float:
        """How far the eye is from the middle."""
        return DISTANCE * math.hypot(self.radius, self.half_height) or 1.0


def project(scenes: Sequence[Scene], view: View | None = None) -> list[Scene]:
    """Scenes as they are seen from one place.

    Parameters
    ----------
    scenes
        Scenes in space; those in the plane are returned unchanged.
    view
        The side of the viewer. By default that is the front, if all lies in the plane of the picture, otherwise 30 degrees
        around and 15 above.

    Examples
    --------
    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.turtle.space import trace_in_space
    >>> bush = trace_in_space(derive(read("axiom: F[&(90)F]"), 0)[0])
    >>> front, right = project([bush], FRONT), project([bush], (90, 0))
    >>> print(bush, *front, *right, sep="; ")
    2 segments, width 0, height 1, depth 1; 2 segments, width 0, height 1.21; 2 segments, width 1, height 1
    """
    if all(scene.dimension == 2 for scene in scenes):
        return [*scenes]
    if view is None and all(map(lies_flat, scenes)):
        return [_flattened(scene) for scene in scenes]
    cylinder = cylinder_around(scenes)
    return [_projected(scene, cylinder, view or FROM_THE_RIGHT) for scene in scenes]


def project_smoothly(scenes: Sequence[Scene], view: View | None = None) -> list[Scene]:
    """The same, with finer faces in the curved surfaces of scenes that have few."""
    return project([smoothed(scene) if len(scene.polygons) else scene for scene in scenes], view)


def lies_flat(scene: Scene) -> bool:
    """Whether all of a scene lies in the plane of the picture, as it is seen from the front.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.turtle.space import trace_in_space
    >>> [lies_flat(trace_in_space(derive(read(text), 0)[0])) for text in ("axiom: F+F", "axiom: F&F")]
    [True, False]
    """
    return scene.dimension == 2 or is_flat(_spans(scene).tolist())


def is_flat(spans: Sequence[float]) -> bool:
    """Whether what extends so far along each axis lies in the plane of the picture."""
    return spans[1] <= FLAT * max(spans)


def _spans(scene: Scene) -> Floats:
    points = _points([scene])
    return np.array(
        [
            max(each[:, axis].max() for each in points) - min(each[:, axis].min() for each in points)
            for axis in range(scene.dimension)
        ]
    )


def _points(scenes: Sequence[Scene]) -> list[Floats]:
    some = [
        each
        for scene in scenes
        for each in (scene.segments.points, scene.polygons.points, scene.discs.centres, scene.labels.points)
    ]
    return [each for each in some if len(each)] or [np.zeros((1, 3))]


def _flattened(scene: Scene) -> Scene:
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    return Scene(
        replace(segments, ends=segments.points[:, ::2].reshape(-1, 4)),
        polygons=replace(polygons, points=polygons.points[:, ::2], normals=np.empty((0, 3))),
        discs=replace(discs, centres=discs.centres[:, ::2]),
        labels=_placed(scene.labels, lambda points: points[:, ::2]),
        unknown=scene.unknown,
    )


def _placed(labels: Labels, place: Callable[[Floats], Floats]) -> Labels:
    return replace(labels, points=place(labels.points)) if len(labels) else no_labels()


def cylinder_around(scenes: Sequence[Scene]) -> Cylinder:
    """The upright cylinder around some scenes in space."""
    points = _points(scenes)
    least = np.array([min(each[:, axis].min() for each in points) for axis in range(3)])
    greatest = np.array([max(each[:, axis].max() for each in points) for axis in range(3)])
    middle = (least + greatest) / 2
    radius = max(float(np.hypot(each[:, 0] - middle[0], each[:, 1] - middle[1]).max()) for each in points)
    bulge = max(float(max(scene.discs.radii.max(initial=0), scene.segments.widths.max(initial=0) / 2)) for scene in scenes)
    return Cylinder(middle, radius + bulge, float(greatest[2] - least[2]) / 2 + bulge)


def _projected(scene: Scene, cylinder: Cylinder, view: View) -> ProjectedScene:
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    side = axes(*map(math.radians, view))
    ends, end_factors = _seen(segments.points, side, cylinder)
    corners, _ = _seen(polygons.points, side, cylinder)
    centres, factors = _seen(discs.centres, side, cylinder)
    depths = _shape_depths(scene, side[2])
    reach = cylinder.radius * math.cos(math.radians(view[1])) + cylinder.half_height * abs(math.sin(math.radians(view[1])))
    middle = float(_mapped(cylinder.middle[None], side[2][:, None])[0, 0])
    return ProjectedScene(
        replace(segments, ends=ends.reshape(-1, 4)),
        polygons=replace(polygons, points=corners),
        discs=replace(discs, centres=centres, radii=discs.radii * factors),
        unknown=scene.unknown,
        depths=depths,
        labels=_placed(scene.labels, lambda points: _seen(points, side, cylinder)[0]),
        nearness=np.clip((depths - middle) / (2 * reach or 1.0) + 0.5, 0, 1),
        extent=float(_spans(scene).max()),
        factors=_stroke_factors(segments, end_factors.reshape(-1, 2)),
        casing_depths=_casing_depths(scene, depths),
        normals=_normals(polygons, side),
    )


def _seen(points: Floats, side: Axes, cylinder: Cylinder) -> tuple[Floats, Floats]:
    """Points in the plane of the picture, and by how much they are magnified there."""
    placed = _mapped(points - cylinder.middle, np.stack(side, axis=1))
    factors = cylinder.distance / (cylinder.distance - placed[:, 2])
    return placed[:, :2] * factors[:, None], factors


def _stroke_factors(segments: Segments, factors: Floats) -> Floats:
    """How much broader than by itself a stroke is at both ends: near ones are, and so are those that continue a broader one."""
    if len(segments) > MOST_CYLINDERS or (segments.widths == OWN).any() or not (segments.widths > 0).all():
        return factors
    before = start_widths(segments, np.broadcast_to(segments.widths, len(segments)), 1.0)
    return np.stack([factors[:, 0] * before / segments.widths, factors[:, 1]], axis=1)


def _shape_depths(scene: Scene, towards: Floats) -> Floats:
    """How near each shape is: the mean of its corners, the middle of a stroke, a centre."""
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    return np.concatenate(
        [
            _means(_depths(polygons.points, towards), polygons.starts),
            (_depths(segments.ends[:, :3], towards) + _depths(segments.ends[:, 3:], towards)) / 2,
            _depths(discs.centres, towards),
        ]
    )


def _casing_depths(scene: Scene, depths: Floats) -> Floats:
    """How near the casings of strokes are, given how near each shape is; nothing where strokes have none."""
    segments, polygons = scene.segments, len(scene.polygons)
    if len(segments) > MOST_CYLINDERS:
        return np.empty(0)
    lengths = np.linalg.norm(segments.ends[:, 3:] - segments.ends[:, :3], axis=1)
    found: Floats = np.where(
        are_edges(segments, scene.polygons), -np.inf, depths[polygons : polygons + len(segments)] - lengths
    )
    return found


def _normals(polygons: Polygons, side: Axes) -> Floats:
    """The unit normals of polygons as they are seen, by Newell's method, towards the viewer."""
    normals = _mapped(normals_of(polygons.points, polygons.starts), np.stack(side, axis=1))
    return np.where(normals[:, 2:] < -EDGE_ON, -normals, normals)


def _depths(points: Floats, towards: Floats) -> Floats:
    depths: Floats = _mapped(points, towards[:, None])[:, 0]
    return depths


def _means(numbers: Floats, starts: Integers) -> Floats:
    return np.add.reduceat(numbers, starts[:-1]) / np.diff(starts) if len(starts) > 1 else np.empty(0)


def axes(around: float, above: float) -> Axes:
    """The directions that appear as right and up, and the one towards the viewer, whose side is given in radians."""
    right = np.array([math.cos(around), math.sin(around), 0.0])
    level = np.array([math.sin(around), -math.cos(around), 0.0])
    vertical = np.array([0.0, 0.0, 1.0])
    return (right, math.cos(above) * vertical - math.sin(above) * level, math.cos(above) * level + math.sin(above) * vertical)


def _mapped(points: Floats, matrix: Floats) -> Floats:
    """The product of points and a small matrix, bit for bit the same on every machine."""
    x, y, z = points.T
    return np.stack([x * column[0] + y * column[1] + z * column[2] for column in matrix.T], axis=1)
