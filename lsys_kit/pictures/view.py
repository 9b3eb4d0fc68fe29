"""Orthographic projection of a scene in space onto the plane of the picture, and the order of its shapes from far to near."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from lsys_kit.geometry.scene import Floats, Integers, Scene

LEVELS = 2**15
"""Depths are compared as so many levels over the extent of a scene, so that rounding errors bring nothing forward."""


def project(scene: Scene, azimuth: float = 0.0, elevation: float = 0.0) -> Scene:
    """The orthographic projection of a scene.

    Parameters
    ----------
    scene
        A scene in space; one in the plane is returned unchanged.
    azimuth, elevation
        The azimuth and the elevation of the viewer, in degrees: 0 from the front, 90 from the right; 0 from the side, 90 from
        above.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.turtle.space import trace_in_space
    >>> from lsys_kit.notation.read import read
    >>> bush = trace_in_space(derive(read("axiom: F[&(90)F]"), 0)[0])
    >>> print(bush, project(bush), project(bush, 90), sep="; ")
    2 segments, width 0, height 1, depth 1; 2 segments, width 0, height 1; 2 segments, width 1, height 1
    """
    if scene.dimension == 2:
        return scene
    right, up, towards = axes(math.radians(azimuth), math.radians(elevation))
    plane = np.stack([right, up], axis=1)
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    ends = _mapped(segments.points, plane).reshape(-1, 4)
    return Scene(replace(segments, ends=ends), polygons=replace(polygons, points=_mapped(polygons.points, plane)),
                 discs=replace(discs, centres=_mapped(discs.centres, plane)), unknown=scene.unknown,
                 order=_far_to_near(scene, towards))


def _far_to_near(scene: Scene, towards: Floats) -> Integers:
    """The numbers of polygons, strokes and discs from far to near; what is as far away stays in this order.

    A shape is as near as its middle: the mean of its corners, the middle of a stroke, a centre.
    """
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    places = [each for each in (polygons.points, segments.points, discs.centres) if len(each)]
    if not places:
        return np.empty(0, np.int64)
    extent = max(max(each[:, axis].max() for each in places) - min(each[:, axis].min() for each in places) for axis in range(3))
    depths = np.concatenate([_means(_depths(polygons.points, towards), polygons.starts),
                             (_depths(segments.ends[:, :3], towards) + _depths(segments.ends[:, 3:], towards)) / 2,
                             _depths(discs.centres, towards)])
    levels = np.rint(depths * (LEVELS / (extent or 1.0)))
    return np.argsort((levels - levels.min()).astype(np.uint16), kind="stable")


def _depths(points: Floats, towards: Floats) -> Floats:
    """How far points lie towards the viewer."""
    depths: Floats = _mapped(points, towards[:, None])[:, 0]
    return depths


def _means(numbers: Floats, starts: Integers) -> Floats:
    """The means of the numbers of each polygon."""
    return np.add.reduceat(numbers, starts[:-1]) / np.diff(starts) if len(starts) > 1 else np.empty(0)


def axes(azimuth: float, elevation: float) -> tuple[Floats, Floats, Floats]:
    """The directions that appear as right and up, and the one towards the viewer."""
    right = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    level = np.array([math.sin(azimuth), -math.cos(azimuth), 0.0])
    vertical = np.array([0.0, 0.0, 1.0])
    return (right, math.cos(elevation) * vertical - math.sin(elevation) * level,
            math.cos(elevation) * level + math.sin(elevation) * vertical)


def _mapped(points: Floats, matrix: Floats) -> Floats:
    """The product of points and a small matrix, bit for bit the same on every machine."""
    x, y, z = points.T
    return np.stack([x * column[0] + y * column[1] + z * column[2] for column in matrix.T], axis=1)
