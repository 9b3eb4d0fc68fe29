"""What a turtle spans between points that it has passed: generalised cylinders, and patches.

The axis of a generalised cylinder is a curve through control points: between two of them a cubic Hermite curve, whose tangents
have the directions of the turtle's headings there, and are 1.2 times as long as the points are apart. It is drawn as a row of
strokes whose width changes evenly; as they follow one another, they become one tube, whose round cross sections are carried
along it without twist. The control points of a patch are those at which the turtle is told so.

Source: R. Mech and P. Prusinkiewicz, CPFG user's manual, on generalised cylinders and surfaces.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from lsys_kit.budget import check_budget, check_bytes
from lsys_kit.geometry.scene import OWN, Floats
from lsys_kit.geometry.turtle.commands.instructions import Instruction
from lsys_kit.geometry.turtle.handlers import Handler
from lsys_kit.geometry.turtle.patches import patch_grid
from lsys_kit.geometry.turtle.shapes import Outline

TANGENT = 1.2
"""The lengths of tangents, where their points are 1 apart."""
MOST_PARTS = 100
"""A curve has so many parts at most, and a patch so many rows and columns of faces."""
FACE_BYTES = 1_400
"""About what a face of a patch takes in memory."""
_ROWS = 4


class AxisPoint(NamedTuple):
    """A control point of the axis of a generalised cylinder: where the turtle is, its heading, and the width of its strokes."""

    place: tuple[float, float, float]
    heading: tuple[float, float, float]
    width: float


def _here(turtle: Any) -> AxisPoint:
    return AxisPoint(turtle.position, turtle.orientation[0], turtle.stroke_width)


def _begin_cylinder(turtle: Any, _: Instruction) -> None:
    turtle.axis = _here(turtle)


def _continue_cylinder(turtle: Any, instruction: Instruction) -> None:
    """Draw the cylinder from its last control point to the turtle."""
    if turtle.axis is None:
        return
    before, turtle.axis = turtle.axis, _here(turtle)
    parts = _bounded_number(instruction.addend)
    places = [*map(tuple, hermite(before, turtle.axis, parts).tolist()), turtle.position]
    bare = OWN in (before.width, turtle.axis.width)
    for number, (start, end) in enumerate(zip([before.place, *places[:-1]], places, strict=True), 1):
        share = number / parts
        turtle.stroke(start, end, OWN if bare else (1 - share) * before.width + share * turtle.axis.width)


def _end_cylinder(turtle: Any, instruction: Instruction) -> None:
    _continue_cylinder(turtle, instruction)
    turtle.axis = None


def hermite(start: AxisPoint, end: AxisPoint, parts: int) -> Floats:
    """The places on a Hermite curve between its ends.

    >>> hermite(AxisPoint((0, 0, 0), (0, 0, 1), 1), AxisPoint((0, 0, 2), (0, 0, 1), 1), 2).tolist()
    [[0.0, 0.0, 1.0]]
    """
    first, last = np.array(start.place), np.array(end.place)
    reach = TANGENT * float(np.linalg.norm(last - first))
    t = np.arange(1, parts)[:, None] / parts
    found: Floats = (
        (1 + 2 * t) * (1 - t) ** 2 * first
        + t * (1 - t) ** 2 * reach * np.array(start.heading)
        + t**2 * (3 - 2 * t) * last
        - t**2 * (1 - t) * reach * np.array(end.heading)
    )
    return found


def _bounded_number(value: float) -> int:
    return max(1, min(MOST_PARTS, math.floor(value + 0.5)))


def _begin_patch(turtle: Any, instruction: Instruction) -> None:
    turtle.patches[_number_of(instruction)] = {}


def _set_control_point(turtle: Any, instruction: Instruction) -> None:
    """Take the position of the turtle as the control point of a row and a column."""
    number, row, column, *_ = (*instruction.values, 0.0, 0.0, 0.0)
    if number in turtle.patches:
        turtle.patches[number][row, column] = turtle.position


def _draw_patch(turtle: Any, instruction: Instruction) -> None:
    """Draw a patch whose sixteen control points are known; rows and columns count from 0 or from 1."""
    points = turtle.patches.get(_number_of(instruction), {})
    rows, columns = (sorted({place[which] for place in points}) for which in (0, 1))
    if len(points) != _ROWS**2 or len(rows) != _ROWS or len(columns) != _ROWS:
        turtle.unknown[instruction.symbol] = None
        return
    check_bytes(FACE_BYTES * len(turtle.outlines), lambda: "The patches were not drawn")
    check_budget()
    control = np.array([[points[row, column] for column in columns] for row in rows])
    along, across = (_bounded_number(value) for value in (*instruction.values[1:3], *[PATCH_FACES] * 2)[:2])
    grids = [grid.tolist() for grid in patch_grid(control, along, across)]
    for i, j in np.ndindex(along, across):
        places = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
        corners, normals = ([tuple(grid[a][b]) for a, b in places] for grid in grids)
        turtle.outlines.append(Outline(corners, turtle.state, turtle.colour, normals))


PATCH_FACES = 5
"""A patch has so many rows and columns of faces, where no number says otherwise."""


def _number_of(instruction: Instruction) -> float:
    return instruction.values[0] if instruction.values else 0.0


CURVE_HANDLERS: Mapping[str, Handler] = {
    "begin cylinder": _begin_cylinder,
    "continue cylinder": _continue_cylinder,
    "end cylinder": _end_cylinder,
    "begin patch": _begin_patch,
    "set control point": _set_control_point,
    "draw patch": _draw_patch,
}
"""The handlers, by action."""
