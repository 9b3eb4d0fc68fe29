"""Frames of a turtle in space: three unit vectors at right angles, and their rotations."""

from __future__ import annotations

import math
from typing import TypeAlias

from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS

Vector: TypeAlias = tuple[float, float, float]
TurtleFrame: TypeAlias = tuple[Vector, Vector, Vector, int]
"""H, L, U, and the number of rotations since they were last made orthonormal."""

RENORMALISATION_INTERVAL = 1_000
"""The number of rotations after which a frame is made orthonormal again; until then its error is 1e-13 at most."""


def combined(frame: TurtleFrame, vector: Vector) -> Vector:
    """A vector that is given in a frame."""
    (hx, hy, hz), (lx, ly, lz), (ux, uy, uz), _ = frame
    ahead, left, up = vector
    return ahead * hx + left * lx + up * ux, ahead * hy + left * ly + up * uy, ahead * hz + left * lz + up * uz


def initial_frame(dialect: str, heading: float = 90.0) -> TurtleFrame:
    """The frame in which the turtle starts; the heading is an angle in the plane of the picture, 90 is up.

    >>> initial_frame("abop")
    ((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), 0)
    """
    cos, sin = cos_sin(heading)
    side = TURTLE_DIALECTS[dialect].left
    head, left = (cos, 0.0, sin), (-side * sin, 0.0, side * cos)
    return head, left, cross(head, left), 0


def cos_sin(degrees: float) -> tuple[float, float]:
    """Cosine and sine, exact for quarter turns.

    >>> cos_sin(-90)
    (0.0, -1.0)
    """
    quarters, rest = divmod(degrees, 90.0)
    if rest == 0:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarters) % 4]
    radians = math.radians(math.fmod(degrees, 360.0))
    return math.cos(radians), math.sin(radians)


def cross(a: Vector, b: Vector) -> Vector:
    """The cross product of two vectors."""
    (ax, ay, az), (bx, by, bz) = a, b
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


def unit(a: Vector) -> Vector:
    """The unit vector of the same direction."""
    length = math.hypot(*a)
    return a[0] / length, a[1] / length, a[2] / length


def rotated_towards(a: Vector, b: Vector, cos: float, sin: float) -> tuple[Vector, Vector]:
    """Two orthogonal unit vectors after a rotation of the first towards the second."""
    (ax, ay, az), (bx, by, bz) = a, b
    return (
        (cos * ax + sin * bx, cos * ay + sin * by, cos * az + sin * bz),
        (cos * bx - sin * ax, cos * by - sin * ay, cos * bz - sin * az),
    )


def next_frame(head: Vector, left: Vector, up: Vector, rotations: int) -> TurtleFrame:
    """The frame after one more rotation, made orthonormal from time to time."""
    if rotations < RENORMALISATION_INTERVAL:
        return head, left, up, rotations + 1
    head = unit(head)
    up = unit(cross(head, left))
    return head, cross(up, head), up, 0
