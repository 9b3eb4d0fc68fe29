"""Surfaces that a model declares: a polygon, or Bezier patches (ABOP, section 5.1).

A point is given in the frame of the turtle that draws the surface: how far it is ahead, to the left, and up. The turtle is at
the origin, and a surface of size 1 is drawn as it is declared.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeAlias

from lsys_kit.notation.model.arithmetic import Value, literal_text, normalised, shortest_decimal
from lsys_kit.notation.model.expressions import TextSpan

SurfacePoint: TypeAlias = tuple[Value, Value, Value]
"""How far ahead, to the left, and up."""
LEAST_CORNERS, ROW = 3, 4
"""A polygon has at least so many corners; a patch has so many rows of so many control points."""


@dataclass(frozen=True)
class SurfaceShape:
    """A surface with a name, which `~name` draws.

    >>> print(SurfaceShape("scale", ((0, 0, 0), (1, 0, 0), (1, 1, 0.5))))
    surface scale: (0, 0) (1, 0) (1, 1, 0.5)

    Attributes
    ----------
    name
        The symbol that stands for it behind a tilde.
    polygon
        The corners of a polygon, in order; none for patches.
    patches
        For each bicubic Bezier patch its sixteen control points, row after row.
    """

    name: str
    polygon: tuple[SurfacePoint, ...] = ()
    patches: tuple[tuple[SurfacePoint, ...], ...] = ()
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        """Coordinates are exact, as settings are."""
        object.__setattr__(self, "polygon", _exact(self.polygon))
        object.__setattr__(self, "patches", tuple(map(_exact, self.patches)))

    def __str__(self) -> str:
        rows = [
            " ".join(map(_point_text, patch[first : first + ROW])) for patch in self.patches for first in range(0, ROW**2, ROW)
        ]
        lines = [("  patch " if number % ROW == 0 else "        ") + row for number, row in enumerate(rows)]
        return "\n".join([f"surface {self.name}:" + "".join(f" {_point_text(corner)}" for corner in self.polygon), *lines])


def _exact(points: tuple[SurfacePoint, ...]) -> tuple[SurfacePoint, ...]:
    return tuple((_exact_number(ahead), _exact_number(left), _exact_number(up)) for ahead, left, up in points)


def _exact_number(value: Value) -> Value:
    return normalised(shortest_decimal(value))


def _point_text(point: SurfacePoint) -> str:
    return f"({', '.join(map(literal_text, point if point[2] else point[:2]))})"
