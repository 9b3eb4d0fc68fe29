"""The turtle in space, module by module (ABOP, sections 1.5 and 2.3.2, and appendix C; Kurth's lecture slides on GROGRA).

The turtle has a frame of three unit vectors at right angles: its heading H, its left L and its up U, where H x L = U. A turn
moves H towards L, a pitch moves H away from U, a roll to the left moves U towards L. The rotation matrices printed in the
book turn the wrong way if H, L and U are read as columns; here commands do what their names say.

In the picture x grows to the right, z upwards and y away from the viewer. The turtle starts at the origin with H upwards.
ABOP's turtle has L to the left and U towards the viewer, GROGRA's L to the right and U away from the viewer.
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Mapping
from typing import Any

import numpy as np

from lsys_kit.budget import check_budget
from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.scene import Floats, Scene, Segments
from lsys_kit.geometry.turtle.commands.instructions import Instruction
from lsys_kit.geometry.turtle.commands.mode import in_plane
from lsys_kit.geometry.turtle.commands.table import WIDTH, initial_step
from lsys_kit.geometry.turtle.curves import CURVE_HANDLERS
from lsys_kit.geometry.turtle.fractint import FRACTINT_HANDLERS
from lsys_kit.geometry.turtle.frames import (
    TurtleFrame,
    Vector,
    combined,
    cos_sin,
    cross,
    initial_frame,
    next_frame,
    rotated_towards,
    unit,
)
from lsys_kit.geometry.turtle.handlers import COMMON_HANDLERS, Handler
from lsys_kit.geometry.turtle.interpreter import run_turtle
from lsys_kit.geometry.turtle.shapes import Outline, collected_labels, collected_shapes
from lsys_kit.geometry.turtle.surfaces import Surface
from lsys_kit.geometry.turtle.turtle import Turtle
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS

_NEGLIGIBLE = 1e-12
"""Smaller sines are taken for 0."""
_STROKE_COLUMNS = 10
"""How many numbers describe a stroke: both ends, branch order, state, width and colour."""


class SpaceTurtle(Turtle):
    """A turtle in space, whose position is a point and whose orientation is a frame.

    Where it stays in the plane of the picture, or is `flat`, as it draws many surfaces, it draws these by their outlines.
    """

    __slots__ = ("start", "strokes")

    def __init__(self, frame: TurtleFrame, step: float, first_width: float = WIDTH) -> None:
        super().__init__((0.0, 0.0, 0.0), frame, step, first_width)
        self.start = frame
        self.strokes = array("d")

    def forward(self, length: float, drawn: bool) -> None:
        start, (hx, hy, hz) = self.position, self.orientation[0]
        x, y, z = start
        self.position = end = x + length * hx, y + length * hy, z + length * hz
        if drawn:
            if self.axis is None:
                self.stroke(start, end, self.stroke_width)
            for pull in self.tropisms.values():
                _bend_by_tropism(self, pull)

    def stroke(self, start: Vector, end: Vector, width: float) -> None:
        """Leave a stroke."""
        self.last = len(self.strokes) // _STROKE_COLUMNS
        self.strokes.extend((*start, *end, len(self.stack), self.state, width, self.colour))

    def initial_orientation(self, degrees: float) -> TurtleFrame:
        head, left, up, rotations = self.start
        return *rotated_towards(head, left, *cos_sin(degrees)), up, rotations

    def draw_surface(self, surface: Surface, size: float) -> None:
        if self.in_plane or self.flat or not surface.normals:
            super().draw_surface(surface, size)
            return
        check_budget()
        for face, normals in zip(surface.faces, surface.normals, strict=True) if size else ():
            self.outlines.append(
                Outline(
                    self.local_points(face, size),
                    self.state,
                    self.colour,
                    [combined(self.orientation, normal) for normal in normals],
                )
            )

    def local_point(self, ahead: float, left: float, up: float) -> Vector:
        (x, y, z), (u, v, w) = self.position, combined(self.orientation, (ahead, left, up))
        return x + u, y + v, z + w


def _turn(turtle: SpaceTurtle, angle: tuple[float, float]) -> None:
    head, left, up, rotations = turtle.orientation
    head, left = rotated_towards(head, left, *angle)
    turtle.orientation = next_frame(head, left, up, rotations)


def _turn_by_mirrored_angle(turtle: SpaceTurtle, angle: tuple[float, float]) -> None:
    cos, sin = angle
    _turn(turtle, (cos, turtle.mirror * sin))


def _pitch(turtle: SpaceTurtle, angle: tuple[float, float]) -> None:
    head, left, up, rotations = turtle.orientation
    up, head = rotated_towards(up, head, *angle)
    turtle.orientation = next_frame(head, left, up, rotations)


def _roll(turtle: SpaceTurtle, angle: tuple[float, float]) -> None:
    head, left, up, rotations = turtle.orientation
    up, left = rotated_towards(up, left, *angle)
    turtle.orientation = next_frame(head, left, up, rotations)


def _level(turtle: SpaceTurtle, _: Instruction) -> None:
    """Roll until L is level: it becomes that of vertical x H, unless H is vertical (ABOP, page 57)."""
    head, _left, _up, rotations = turtle.orientation
    across = math.hypot(head[0], head[1])
    if across > _NEGLIGIBLE:
        left = -head[1] / across, head[0] / across, 0.0
        turtle.orientation = head, left, cross(head, left), rotations


def _bend_by_gravitropism(turtle: SpaceTurtle, instruction: Instruction) -> None:
    """Bend as GROGRA's RV: H takes the direction of H - strength * vertical; a vertical H can only be reversed."""
    (hx, hy, hz), *_ = turtle.orientation
    strength = instruction.factor * turtle.gravitropism + instruction.addend
    across = math.hypot(hx, hy)
    if across > _NEGLIGIBLE:
        _rotate(turtle, (-hy / across, hx / across, 0.0), math.atan2(across, hz - strength) - math.atan2(across, hz))
    elif hz > 0 and strength > 1:
        _pitch(turtle, (-1.0, 0.0))


def _bend_by_tropism(turtle: SpaceTurtle, pull: Vector) -> None:
    """Bend towards a tropism T by the angle e |H x T| about H x T; the pull is e T (ABOP, page 58)."""
    axis = cross(turtle.orientation[0], pull)
    radians = math.hypot(*axis)
    if radians > _NEGLIGIBLE:
        _rotate(turtle, unit(axis), radians)


def _rotate(turtle: SpaceTurtle, axis: Vector, radians: float) -> None:
    """Rotate the frame about a unit vector."""
    cos, sin = math.cos(radians), math.sin(radians)
    ax, ay, az = axis

    def rotated(v: Vector) -> Vector:
        along = (1 - cos) * (ax * v[0] + ay * v[1] + az * v[2])
        x, y, z = cross(axis, v)
        return cos * v[0] + sin * x + along * ax, cos * v[1] + sin * y + along * ay, cos * v[2] + sin * z + along * az

    head, left, up, rotations = turtle.orientation
    turtle.orientation = next_frame(rotated(head), rotated(left), rotated(up), rotations)


def _set_tropism(turtle: SpaceTurtle, instruction: Instruction) -> None:
    """Set a tropism: `@Ts(e)`, or as in cpfg `@Ts(number, e)`, or with a direction `@Ts(number, e, x, y, z)`."""
    number, elasticity, *direction = instruction.values if len(instruction.values) > 1 else (1.0, *instruction.values, 0.0)
    x, y, z = direction if len(direction) == 3 else (0.0, -1.0, 0.0)
    turtle.tropisms = {**turtle.tropisms, number: _from_cpfg((elasticity * x, elasticity * y, elasticity * z))}


def _set_position(turtle: SpaceTurtle, instruction: Instruction) -> None:
    x, y, z, *_ = (*instruction.values, 0.0, 0.0, 0.0)
    turtle.position = _from_cpfg((x, y, z))


def _set_heading(turtle: SpaceTurtle, instruction: Instruction) -> None:
    """Take a heading H, and an up U as far as H lets it: `@R(x, y, z)`, or `@R(x, y, z, x, y, z)` with both."""
    x, y, z, *others = (*instruction.values, 0.0, 0.0, 0.0)
    head = _from_cpfg((x, y, z))
    if math.hypot(*head) <= _NEGLIGIBLE:
        return
    head, (_, left, up, _) = unit(head), turtle.orientation
    wanted = _from_cpfg((others[0], others[1], others[2])) if len(instruction.values) > 5 else up
    across = next(side for side in (cross(wanted, head), cross(up, head), left) if math.hypot(*side) > _NEGLIGIBLE)
    left = unit(across)
    turtle.orientation = head, left, cross(head, left), 0


def _from_cpfg(point: Vector) -> Vector:
    """A point or direction in the axes used here, given in cpfg's, where y grows upwards and z towards the viewer."""
    x, y, z = point
    return x, -z, y


def _return_to_stroke(turtle: SpaceTurtle, instruction: Instruction) -> None:
    """Move to a point of the last stroke."""
    if turtle.last is not None:
        first = turtle.last * _STROKE_COLUMNS
        x, y, z, u, v, w = turtle.strokes[first : first + 6]
        part = instruction.factor + instruction.addend
        turtle.position = x + part * (u - x), y + part * (v - y), z + part * (w - z)


_ROTATIONS: Mapping[str, Handler] = {
    "turn": _turn,
    "turn by mirrored angle": _turn_by_mirrored_angle,
    "turn back": _turn,
    "pitch": _pitch,
    "roll": _roll,
}
SPACE_HANDLERS: Mapping[str, Handler] = {
    **COMMON_HANDLERS,
    **FRACTINT_HANDLERS,
    **CURVE_HANDLERS,
    **_ROTATIONS,
    "level": _level,
    "set heading": _set_heading,
    "gravitropism": _bend_by_gravitropism,
    "set tropism": _set_tropism,
    "set position": _set_position,
    "return to stroke": _return_to_stroke,
}
"""The handlers of the turtle in space, by action."""


def trace_in_space(word: Word, angle: float | None = None) -> Scene:
    """The scene that a turtle in space draws by interpreting a word.

    Parameters
    ----------
    word
        The word; interpretation rules are applied first.
    angle
        The angle of turns, pitches and rolls without an argument, in degrees; by default the system's.

    Returns
    -------
    Scene
        Strokes and shapes in space; `unknown` lists the symbols that look like commands and are none.

    Raises
    ------
    ModelLimitError
        More brackets are open at once than the limit allows.
    ModelValueError
        A value is too large to draw, or symbolic.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> bush = read("angle: 22.5\\naxiom: A\\nA -> [&F A] /(120) [&F A] /(120) [&F A]")
    >>> print(trace_in_space(derive(bush, 4)[-1]))
    120 segments, width 5.22, height 3.78, depth 4.82
    """
    system = word.states.system
    turn = float(system.angle) if angle is None else angle
    turtle = SpaceTurtle(
        initial_frame(system.turtle, float(system.heading)), initial_step(system), TURTLE_DIALECTS[system.turtle].width
    )
    turtle.take_look(system)
    turtle.in_plane = in_plane(system)
    run_turtle(turtle, word, SPACE_HANDLERS, lambda instruction: operand(instruction, turn))
    polygons, discs = collected_shapes(turtle.outlines, turtle.rounds, _points)
    return Scene(
        strokes_of(turtle),
        polygons=polygons,
        discs=discs,
        labels=collected_labels(turtle.labels, _points),
        unknown=tuple(turtle.unknown),
    )


def strokes_of(turtle: SpaceTurtle) -> Segments:
    """The strokes that a turtle has drawn, in order."""
    rows = np.array(turtle.strokes).reshape(-1, _STROKE_COLUMNS)
    orders, states, colours = (rows[:, column].astype(np.int64) for column in (6, 7, 9))
    return Segments(rows[:, :6].copy(), orders, states, rows[:, 8].copy(), colours)


def operand(instruction: Instruction, angle: float) -> Any:
    """The operand of a handler: cosine and sine for a rotation, else the instruction itself.

    >>> operand(Instruction("pitch", 0.0, -90.0), 25.7)
    (0.0, -1.0)
    """
    return cos_sin(instruction.factor * angle + instruction.addend) if instruction.action in _ROTATIONS else instruction


def _points(places: list[Vector]) -> Floats:
    return np.array(places, np.float64).reshape(-1, 3)
