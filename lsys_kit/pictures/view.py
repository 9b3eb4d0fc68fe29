"""Orthographic projection of a scene in space onto the plane of the picture, sorted from back to front."""

from __future__ import annotations

import math

import numpy as np

from lsys_kit.geometry.scene import Discs, Floats, Polygons, Scene, Segments


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
    right, up, towards = _axes(math.radians(azimuth), math.radians(elevation))
    plane = np.stack([right, up], axis=1)
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    middles = (segments.ends[:, :3] + segments.ends[:, 3:]) / 2
    order = np.argsort(np.round(_mapped(middles, towards[:, None])[:, 0], 9), kind="stable")
    ends = np.concatenate([_mapped(segments.ends[order, :3], plane), _mapped(segments.ends[order, 3:], plane)], axis=1)
    widths = segments.widths if len(segments.widths) == 1 else segments.widths[order]
    chosen = segments.colours if len(segments.colours) == 1 else segments.colours[order]
    return Scene(Segments(ends, segments.orders[order], segments.states[order], widths, chosen),
                 polygons=_polygons(polygons, plane, towards),
                 discs=Discs(_mapped(discs.centres, plane), discs.radii, discs.kinds, discs.states, discs.colours),
                 unknown=scene.unknown)


def _axes(azimuth: float, elevation: float) -> tuple[Floats, Floats, Floats]:
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


def _polygons(polygons: Polygons, plane: Floats, towards: Floats) -> Polygons:
    """The projected polygons, the farthest first."""
    if not len(polygons):
        return Polygons(np.empty((0, 2)), polygons.starts, polygons.states, polygons.colours)
    sizes = np.diff(polygons.starts)
    depths = np.add.reduceat(_mapped(polygons.points, towards[:, None])[:, 0], polygons.starts[:-1]) / sizes
    order = np.argsort(np.round(depths, 9), kind="stable")
    places = np.concatenate([np.arange(polygons.starts[one], polygons.starts[one + 1]) for one in order])
    return Polygons(_mapped(polygons.points[places], plane), np.cumsum([0, *sizes[order]]), polygons.states[order],
                    polygons.colours[order])
