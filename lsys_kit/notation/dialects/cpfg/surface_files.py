"""The files in which cpfg keeps surfaces, whose names end in .s: Bezier patches, and how a turtle holds them.

A file names the point where the surface touches the plant, the directions that become the heading and the up of the turtle,
and a size; then sixteen control points for each patch, four on a line. No model opens such a file: a person gives its text.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError, ModelSyntaxError, ModelValueError, require
from lsys_kit.notation.analysis.checks import LARGEST
from lsys_kit.notation.model.surfaces import ROW, SurfacePoint, SurfaceShape
from lsys_kit.notation.model.system import LSystem

_Vector: TypeAlias = tuple[float, float, float]
_NUMBER = r"-?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d{1,2})?"
_ROW = re.compile(rf"^[ \t]*{_NUMBER}(?:[ \t]+{_NUMBER}){{11}}[ \t\r]*$", re.MULTILINE)
"""Four control points, each with its coordinates."""
DECIMALS = 5
"""So many decimals of a coordinate are kept."""
_NAME = re.compile(r"[A-Za-z_]\w{0,63}")


def with_surface(system: LSystem, name: str, text: str) -> LSystem:
    """A system with a surface out of a file of cpfg, which `~name` draws.

    Parameters
    ----------
    system
        Any L-system.
    name
        What the surface is called; a surface of this name that the system has is replaced.
    text
        The text of the file, as in `Path("leaf.s").read_text()`. Size 1 is the size that it names.

    Raises
    ------
    ModelSyntaxError
        The text is no such file; the error gives the place.
    ModelValueError
        The name cannot be the name of a surface, or a control point is too far away.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> leaf = '''0 2 0 1 0 0
    ... CONTACT POINT  X: 0 Y: 0 Z: 0
    ... END POINT  X: 0 Y: 2 Z: 0
    ... HEADING  X: 0 Y: 1 Z: 0
    ... UP  X: 0 Y: 0 Z: 1
    ... SIZE: 2
    ... patch
    ... 0 0 0  0 0 0  0 0 0  0 0 0
    ... 0 1 0  1 1 0  1 1 0  2 1 0
    ... 0 1 0  1 1 0  1 1 0  2 1 0
    ... 0 2 0  0 2 0  0 2 0  0 2 0'''
    >>> with_surface(read("axiom: F ~L"), "L", leaf).surfaces[0].patches[0][-1]
    (1, 0, 0)
    """
    require(system, LSystem, "An L-system")
    require(name, str, "The name of a surface")
    require(text, str, "The text of a surface")
    if not _NAME.fullmatch(name):
        raise ModelValueError("A surface is called by a name", hint='Such as "L" or "leaf".')
    if len(text) > current().text:
        raise ModelLimitError(
            f"The text has {len(text):,} characters; the limit is {current().text:,}", limit=current().text, needed=len(text)
        )
    others = tuple(surface for surface in system.surfaces if surface.name != name)
    return replace(system, surfaces=(*others, SurfaceShape(name, patches=_patches(text))))


def _patches(text: str) -> tuple[tuple[SurfacePoint, ...], ...]:
    contact, heading, up = (_vector(text, keyword) for keyword in ("CONTACT POINT", "HEADING", "UP"))
    size = _size(text)
    ahead = _unit(heading, text, "HEADING")
    left = _unit(_cross(up, ahead), text, "UP")
    axes = (ahead, left, _cross(ahead, left))
    rows = [_placed(match.group(), contact, axes, size) for match in _ROW.finditer(text)]
    if not rows or len(rows) % ROW:
        raise ModelSyntaxError(
            f"A patch has four lines of four points, and here are {len(rows)} such lines",
            text,
            hint="A point is three numbers.",
        )
    return tuple(tuple(point for row in rows[first : first + ROW] for point in row) for first in range(0, len(rows), ROW))


def _vector(text: str, keyword: str) -> _Vector:
    pattern = "".join(rf"[ \t]+{axis}:[ \t]*({_NUMBER})" for axis in "XYZ")
    found = re.search(rf"^{keyword}{pattern}", text, re.MULTILINE)
    if not found:
        raise ModelSyntaxError(
            f'There is no line "{keyword}" with its X:, Y: and Z:',
            text,
            hint="The files of cpfg whose names end in .s have one.",
        )
    x, y, z = map(float, found.groups())
    return x, y, z


def _size(text: str) -> float:
    found = re.search(rf"^SIZE:[ \t]*({_NUMBER})", text, re.MULTILINE)
    if not found or not float(found[1]) > 0:
        raise ModelSyntaxError(
            'There is no line "SIZE:" with a positive number', text, *(found.span() if found else (None, None))
        )
    return float(found[1])


def _unit(vector: _Vector, text: str, keyword: str) -> _Vector:
    length = math.hypot(*vector)
    if not length:
        start = text.index(f"{keyword} ")
        raise ModelSyntaxError(
            "This direction cannot be used", text, start, start + len(keyword), "HEADING and UP are not zero, and not parallel."
        )
    x, y, z = vector
    return x / length, y / length, z / length


def _cross(a: _Vector, b: _Vector) -> _Vector:
    (ax, ay, az), (bx, by, bz) = a, b
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


def _placed(line: str, contact: _Vector, axes: Sequence[_Vector], size: float) -> list[_Vector]:
    """The points of a line, in the frame of the turtle."""
    numbers = [*map(float, line.split())]
    found: list[_Vector] = []
    for first in range(0, len(numbers), 3):
        x, y, z = (number - origin for number, origin in zip(numbers[first : first + 3], contact, strict=True))
        ahead, left, up = (round((x * u + y * v + z * w) / size, DECIMALS) + 0.0 for u, v, w in axes)
        if not all(abs(coordinate) <= LARGEST for coordinate in (ahead, left, up)):
            raise ModelValueError(
                "A control point is too far away", hint="Divided by the size that the file names, coordinates are about 1."
            )
        found.append((ahead, left, up))
    return found
