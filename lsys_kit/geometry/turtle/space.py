"""The turtle in space (ABOP, sections 1.5 and 2.3.2, and appendix C; GROGRA as seed 003 uses it), module by module.

The turtle has a frame of three unit vectors at right angles: its heading H, its left L and its up U, where H x L = U. A turn
moves H towards L, a pitch moves H away from U, a roll to the left moves U towards L. What the book prints as rotation
matrices turns the wrong way, if H, L and U are read as columns; here commands do what their names say.

In the picture x grows to the right, z upwards and y away from the viewer. The turtle starts at the origin with H upwards.
ABOP's turtle has L to the left and U towards the viewer, GROGRA's L to the right and U away from the viewer.
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np

from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.scene import Floats, Scene, Segments
from lsys_kit.geometry.turtle.commands import initial_step
from lsys_kit.geometry.turtle.instructions import Instruction
from lsys_kit.geometry.turtle.interpreter import COMMON, Act, Turtle, run_turtle, shapes_left
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS

Vector: TypeAlias = tuple[float, float, float]
TurtleFrame: TypeAlias = tuple[Vector, Vector, Vector, int]
"""H, L, U, and how many rotations ago they were made exactly orthonormal."""

OFTEN = 1_000
"""After so many rotations a frame is made orthonormal again: until then it is wrong by 1e-13 at most."""
_NOWHERE = 1e-12
"""Sines below this are those of no angle."""
_COLUMNS = 10
"""The numbers of a stroke: both ends, order, state, width and colour."""


class SpaceTurtle(Turtle):
    """A turtle in space: it is at a point, and turned as its frame says."""

    __slots__ = ("strokes",)

    def __init__(self, frame: TurtleFrame, step: float) -> None:
        super().__init__((0.0, 0.0, 0.0), frame, step)
        self.strokes = array("d")

    def go(self, length: float, drawn: bool) -> None:
        start, (hx, hy, hz) = self.at, self.way[0]
        x, y, z = start
        self.at = end = x + length * hx, y + length * hy, z + length * hz
        if drawn:
            self.last = len(self.strokes) // _COLUMNS
            self.strokes.extend((*start, *end, len(self.stack), self.state, self.width, self.colour))
            for pull in self.pulls.values():
                _pulled(self, pull)

    def spot(self, ahead: float, left: float, up: float) -> Vector:
        (x, y, z), ((hx, hy, hz), (lx, ly, lz), (ux, uy, uz), _) = self.at, self.way
        return (x + ahead * hx + left * lx + up * ux, y + ahead * hy + left * ly + up * uy,
                z + ahead * hz + left * lz + up * uz)


def initial_frame(dialect: str, heading: float = 90.0) -> TurtleFrame:
    """How the turtle is turned when it starts; the heading is an angle in the plane of the picture, 90 is up.

    >>> initial_frame("abop")
    ((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), 0)
    """
    cos, sin = cos_sin(heading)
    side = TURTLE_DIALECTS[dialect].left
    head, left = (cos, 0.0, sin), (-side * sin, 0.0, side * cos)
    return head, left, _cross(head, left), 0


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


def _cross(a: Vector, b: Vector) -> Vector:
    (ax, ay, az), (bx, by, bz) = a, b
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


def _unit(a: Vector) -> Vector:
    length = math.hypot(*a)
    return a[0] / length, a[1] / length, a[2] / length


def _towards(a: Vector, b: Vector, cos: float, sin: float) -> tuple[Vector, Vector]:
    """Both vectors after a rotation of the first towards the second."""
    (ax, ay, az), (bx, by, bz) = a, b
    return ((cos * ax + sin * bx, cos * ay + sin * by, cos * az + sin * bz),
            (cos * bx - sin * ax, cos * by - sin * ay, cos * bz - sin * az))


def _framed(head: Vector, left: Vector, up: Vector, rotations: int) -> TurtleFrame:
    """A frame after one more rotation; after many it is made orthonormal again."""
    if rotations < OFTEN:
        return head, left, up, rotations + 1
    head = _unit(head)
    up = _unit(_cross(head, left))
    return head, _cross(up, head), up, 0


def _turn(turtle: SpaceTurtle, angle: tuple[float, float]) -> None:
    head, left, up, rotations = turtle.way
    head, left = _towards(head, left, *angle)
    turtle.way = _framed(head, left, up, rotations)


def _pitch(turtle: SpaceTurtle, angle: tuple[float, float]) -> None:
    head, left, up, rotations = turtle.way
    up, head = _towards(up, head, *angle)
    turtle.way = _framed(head, left, up, rotations)


def _roll(turtle: SpaceTurtle, angle: tuple[float, float]) -> None:
    head, left, up, rotations = turtle.way
    up, left = _towards(up, left, *angle)
    turtle.way = _framed(head, left, up, rotations)


def _level(turtle: SpaceTurtle, _: Instruction) -> None:
    """Roll until L is level: it becomes that of vertical x H, unless H is vertical (ABOP, page 57)."""
    head, _left, _up, rotations = turtle.way
    across = math.hypot(head[0], head[1])
    if across > _NOWHERE:
        left = -head[1] / across, head[0] / across, 0.0
        turtle.way = head, left, _cross(head, left), rotations


def _droop(turtle: SpaceTurtle, order: Instruction) -> None:
    """Bend as GROGRA's RV: H becomes that of H - strength * vertical; a vertical H can only be turned round."""
    (hx, hy, hz), *_ = turtle.way
    strength = order.factor * turtle.sag + order.addend
    across = math.hypot(hx, hy)
    if across > _NOWHERE:
        _bend(turtle, (-hy / across, hx / across, 0.0), math.atan2(across, hz - strength) - math.atan2(across, hz))
    elif hz > 0 and strength > 1:
        _pitch(turtle, (-1.0, 0.0))


def _pulled(turtle: SpaceTurtle, pull: Vector) -> None:
    """Bend towards a tropism T by the angle e |H x T| about H x T; the pull is e T (ABOP, page 58)."""
    axis = _cross(turtle.way[0], pull)
    radians = math.hypot(*axis)
    if radians > _NOWHERE:
        _bend(turtle, _unit(axis), radians)


def _bend(turtle: SpaceTurtle, axis: Vector, radians: float) -> None:
    """Rotate the frame about a unit vector."""
    cos, sin = math.cos(radians), math.sin(radians)
    ax, ay, az = axis

    def rotated(v: Vector) -> Vector:
        along = (1 - cos) * (ax * v[0] + ay * v[1] + az * v[2])
        x, y, z = _cross(axis, v)
        return cos * v[0] + sin * x + along * ax, cos * v[1] + sin * y + along * ay, cos * v[2] + sin * z + along * az

    head, left, up, rotations = turtle.way
    turtle.way = _framed(rotated(head), rotated(left), rotated(up), rotations)


def _tropism(turtle: SpaceTurtle, order: Instruction) -> None:
    """Set a tropism: `@Ts(e)`, or `@Ts(number, e)` as in cpfg, perhaps with its direction behind, else gravity."""
    number, elasticity, *direction = order.values if len(order.values) > 1 else (1.0, *order.values, 0.0)
    x, y, z = direction if len(direction) == 3 else (0.0, -1.0, 0.0)
    turtle.pulls = {**turtle.pulls, number: _seen((elasticity * x, elasticity * y, elasticity * z))}


def _jump(turtle: SpaceTurtle, order: Instruction) -> None:
    x, y, z, *_ = (*order.values, 0.0, 0.0, 0.0)
    turtle.at = _seen((x, y, z))


def _seen(point: Vector) -> Vector:
    """A point or direction of cpfg, where y grows upwards and z towards the viewer, as it is here."""
    x, y, z = point
    return x, -z, y


def _back(turtle: SpaceTurtle, order: Instruction) -> None:
    """Go to a place on the last stroke."""
    if turtle.last is not None:
        first = turtle.last * _COLUMNS
        x, y, z, u, v, w = turtle.strokes[first:first + 6]
        part = order.factor + order.addend
        turtle.at = x + part * (u - x), y + part * (v - y), z + part * (w - z)


_ROTATIONS: Mapping[str, Act] = {"turn": _turn, "pitch": _pitch, "roll": _roll}
SPACE_ACTS: Mapping[str, Act] = {**COMMON, **_ROTATIONS, "level": _level, "gravitropism": _droop, "set tropism": _tropism,
                                 "set position": _jump, "return to stroke": _back}
"""What a turtle in space does, by the names of the actions."""


def trace_in_space(word: Word, angle: float | None = None) -> Scene:
    """What a turtle in space draws that follows a word.

    Parameters
    ----------
    word
        The word; interpretation rules are applied first.
    angle
        Degrees by which `+`, `&`, `/` and their like turn; by default the system's.

    Returns
    -------
    Scene
        Strokes and shapes in space; `unknown` has the symbols that look like commands and are none here.

    Raises
    ------
    ModelLimitError
        More brackets are open at once than the limit allows.
    ModelValueError
        A value is no number that can be drawn.

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
    turtle = SpaceTurtle(initial_frame(system.turtle, float(system.heading)), initial_step(system))
    run_turtle(turtle, word, SPACE_ACTS, lambda order: prepared(order, turn))
    polygons, discs = shapes_left(turtle.outlines, turtle.rounds, _points)
    return Scene(strokes_of(turtle), polygons=polygons, discs=discs, unknown=tuple(turtle.unknown))


def strokes_of(turtle: SpaceTurtle) -> Segments:
    """The strokes that a turtle has left, in the order of their numbers."""
    rows = np.array(turtle.strokes).reshape(-1, _COLUMNS)
    orders, states, colours = (rows[:, column].astype(np.int64) for column in (6, 7, 9))
    return Segments(rows[:, :6].copy(), orders, states, rows[:, 8].copy(), colours)


def prepared(order: Instruction, angle: float) -> Any:
    """What an act is given for an order: cosine and sine for a rotation, the order itself for anything else.

    >>> prepared(Instruction("pitch", 0.0, -90.0), 25.7)
    (0.0, -1.0)
    """
    return cos_sin(order.factor * angle + order.addend) if order.action in _ROTATIONS else order


def _points(places: list[Vector]) -> Floats:
    return np.array(places, np.float64).reshape(-1, 3)
