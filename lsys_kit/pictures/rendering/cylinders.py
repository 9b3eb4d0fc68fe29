"""Strokes in space as they are seen: tapered cylinders with round ends, with a light stripe along them and a dark one.

Where a cylinder is brightest follows from Lambert's law: across it the angle of its normal grows from -90 to 90 degrees, and it
is brightest where the normal comes nearest to the light.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lsys_kit.geometry.scene import Floats, Integers
from lsys_kit.pictures.rendering.looks import BROADEST, THINNEST
from lsys_kit.pictures.rendering.view import ProjectedScene
from lsys_kit.pictures.style.lighting import LIGHT

TONED = 16
"""From this width on, in tenths of a pixel, stripes can be seen."""
TAPERED = 0.06
"""From this difference of the widths at both ends on, relative to their mean, a stroke is seen to be tapered."""
LIT, DARK, RIM = np.radians([32.0, 68.0, 84.0])
"""Angles of the normal: how far the light stripe reaches from the brightest line to both sides, how far from it the dark one
begins, and where the light one ends at the latest, before the rim."""
PIECES = 6
"""The straight pieces of a round end."""


class Cylinders(NamedTuple):
    """Strokes as they are seen: shape (n, 2, 2), their ends; (n, 2), the radii there, in units of the plane, and unit vectors
    along them and to their left."""

    ends: Floats
    radii: Floats
    along: Floats
    left: Floats

    @property
    def tapered(self) -> NDArray[np.bool_]:
        """Which are seen to be broader at one end."""
        differences = np.abs(self.radii[:, 0] - self.radii[:, 1])
        tapered: NDArray[np.bool_] = differences > TAPERED * self.radii.mean(axis=1)
        return tapered

    def some(self, which: NDArray[np.bool_]) -> Cylinders:
        """Some of them."""
        return Cylinders(*(column[which] for column in self))


def seen_widths(scene: ProjectedScene, widths: Integers) -> Integers:
    """The mean widths at which strokes are seen, in tenths of a pixel, given those at which nothing magnifies them."""
    seen = widths * ((scene.factors[:, 0] + scene.factors[:, 1]) / 2)
    return np.clip(np.rint(seen), THINNEST, BROADEST).astype(np.int64)


def cylinders_of(scene: ProjectedScene, widths: Integers, unit: float, which: NDArray[np.bool_]) -> Cylinders:
    """Some of the strokes of a scene, given all widths where nothing magnifies them, and how many of these make a unit."""
    ends, radii = scene.segments.ends[which].reshape(-1, 2, 2), widths[which, None] * scene.factors[which] / (2 * unit)
    ways = ends[:, 1] - ends[:, 0]
    lengths = np.hypot(ways[:, 0], ways[:, 1])[:, None]
    along = np.where(lengths > 0, ways / np.where(lengths > 0, lengths, 1.0), (0.0, 1.0))
    return Cylinders(ends, radii, along, np.stack([-along[:, 1], along[:, 0]], axis=1))


def capsules(cylinders: Cylinders) -> Floats:
    """The outlines of cylinders with round ends, shape (n, 2 * PIECES + 2, 2)."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, PIECES + 1)[None, :, None]
    caps = []
    for end, way in ((1, 1), (0, -1)):
        arc = way * (np.cos(angles) * cylinders.along[:, None] + np.sin(angles) * cylinders.left[:, None])
        caps.append(cylinders.ends[:, end, None] + cylinders.radii[:, end, None, None] * arc)
    return np.concatenate(caps, axis=1)


def stripes(cylinders: Cylinders) -> tuple[Floats, Floats]:
    """The corners of the light and of the dark stripes, each of shape (n, 6, 2)."""
    aside = cylinders.left @ LIGHT[:2]
    brightest = np.arctan2(aside, LIGHT[2])
    away = np.where(aside < 0, 1.0, -1.0)  # to which side it grows dark
    light = _stripe(cylinders, np.maximum(brightest - LIT, -RIM), np.minimum(brightest + LIT, RIM))
    return light, _stripe(cylinders, brightest + away * DARK, away * np.pi / 2)


def _stripe(cylinders: Cylinders, first: Floats, last: Floats) -> Floats:
    """The corners of stripes between two angles of the normal, up to the round ends, which they follow."""
    corners, middle = [], (first + last) / 2
    for end, angle in ((0, middle), (0, first), (1, first), (1, middle), (1, last), (0, last)):
        way = np.sin(angle)[:, None] * cylinders.left + (2 * end - 1) * np.cos(angle)[:, None] * cylinders.along
        corners.append(cylinders.ends[:, end] + cylinders.radii[:, end, None] * way)
    return np.stack(corners, axis=1)
