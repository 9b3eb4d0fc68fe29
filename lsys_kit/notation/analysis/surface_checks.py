"""Do the surfaces that a model declares make sense? Each name is declared once, a polygon has corners enough, a patch has
sixteen control points, and coordinates are numbers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from lsys_kit.notation.analysis.checks import check_expression, value_of
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.model.expressions import TextSpan, names_in
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.surfaces import LEAST_CORNERS, ROW, SurfacePoint, SurfaceShape

LARGEST = 1e9
"""No coordinate is greater: a surface of size 1 is about 1 long."""


class PointList(NamedTuple):
    """The points of a polygon or of a patch, each with its coordinates as arguments; and where they begin."""

    points: tuple[Pattern, ...]
    at: TextSpan


class SurfaceText(NamedTuple):
    """A surface as it is written: its name, its points, and whether these are patches or one polygon."""

    name: str
    parts: tuple[PointList, ...]
    patched: bool
    at: TextSpan


def checked_surfaces(texts: Iterable[SurfaceText]) -> tuple[SurfaceShape, ...]:
    """The surfaces that are declared, checked."""
    found: dict[str, SurfaceShape] = {}
    for text in texts:
        if text.name in found:
            raise problem("surface twice", text.at, name=text.name)
        for part in text.parts:
            _check_number(part, text.patched)
        shapes = tuple(tuple(_point(point) for point in part.points) for part in text.parts)
        found[text.name] = SurfaceShape(text.name, () if text.patched else shapes[0], shapes if text.patched else (), text.at)
    return tuple(found.values())


def _check_number(part: PointList, patched: bool) -> None:
    count = len(part.points)
    if patched and count != ROW**2:
        raise problem("number of control points", part.at, count=count)
    if count < LEAST_CORNERS:
        raise problem("number of corners", part.at)


def _point(point: Pattern) -> SurfacePoint:
    for coordinate in point.arguments:
        for name in sorted(names_in(coordinate)):
            raise problem("name in surface", coordinate.at, name=name)
        check_expression(coordinate, ())
    values = [value_of(coordinate) for coordinate in point.arguments]
    if not all(-LARGEST <= value <= LARGEST for value in values):
        raise problem("point too far", point.at)
    ahead, left, up = (*values, 0)[:3]
    return ahead, left, up
