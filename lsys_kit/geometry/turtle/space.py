"""The turtle in space, module by module (ABOP, sections 1.5 and 2.3.2, and appendix C; Kurth's lecture slides on GROGRA).

The turtle has a frame of three unit vectors at right angles: its heading H, its left L and its up U, where H x L = U. A turn
moves H towards L, a pitch moves H away from U, a roll to the left moves U towards L. The rotation matrices printed in the
book turn the wrong way if H, L and U are read as columns; here commands do what their names say.

In the picture x grows to the right, z upwards and y away from the viewer. The turtle starts at the origin with H upwards.
ABOP's turtle has L to the left and U towards the viewer, GROGRA's L to the right and U away from the viewer.

It also spans generalised cylinders and patches between points that it has passed. The axis of a generalised cylinder is a curve
through control points: between two of them a cubic Hermite curve, whose tangents have the directions of the turtle's headings
there, and are 1.2 times as long as the points are apart. It is drawn as a row of strokes whose width changes evenly; as they
follow one another, they become one tube, whose round cross sections are carried along it without twist. The control points of a
patch are those at which the turtle is told so (R. Mech and P. Prusinkiewicz, CPFG user's manual).
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable
from itertools import chain, product
from operator import mul
from typing import Any, NamedTuple, TypeAlias

from lsys_kit.arrays import is_array, np
from lsys_kit.budget import check_budget, check_bytes, counted
from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.scene import OWN, Floats, Scene, Segments, Stroke
from lsys_kit.geometry.turtle.commands import Instruction, in_plane, initial_step
from lsys_kit.geometry.turtle.scanning import DRAWS, MOVES, TURNS, Branches, Carried, Commands, added, turned
from lsys_kit.geometry.turtle.surfaces import PATCH_FACES, Surface, patch_grid
from lsys_kit.geometry.turtle.turtle import Outline, Turtle, collected_labels, collected_shapes, handlers_of, run_turtle
from lsys_kit.geometry.turtle.unfolding import WordBetween
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
    if is_array(degrees):
        return _cosines_sines(degrees)
    quarters, rest = divmod(degrees, 90.0)
    if rest == 0:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarters) % 4]
    radians = math.radians(math.fmod(degrees, 360.0))
    return math.cos(radians), math.sin(radians)


def _cosines_sines(degrees: Any) -> tuple[Any, Any]:
    quarters, rest = np.divmod(degrees, 90.0)
    radians, exact = np.radians(np.fmod(degrees, 360.0)), np.array([1.0, 0.0, -1.0, 0.0])
    cos, sin = (exact[(quarters - back).astype(np.int64) % 4] for back in (0, 1))
    return np.where(rest == 0, cos, np.cos(radians)), np.where(rest == 0, sin, np.sin(radians))


def cross(a: Vector, b: Vector) -> Vector:
    (ax, ay, az), (bx, by, bz) = a, b
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


def unit(a: Vector) -> Vector:
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


TANGENT = 1.2
"""The lengths of tangents, where their points are 1 apart."""
MOST_PARTS = 100
"""A curve has so many parts at most, and a patch so many rows and columns of faces."""
FACE_BYTES = 1_400
"""About what a face of a patch takes in memory."""
_ROWS = 4
_AXES = {"pitch": (2, 0), "roll": (2, 1)}
"""Which axis of the frame, heading, left or up, each rotation turns towards which; others turn the heading to the left."""
_NEGLIGIBLE = 1e-12
"""Smaller sines are taken for 0."""
_STROKE_COLUMNS = 10
"""How many numbers describe a stroke: both ends, branch order, state, width and colour."""


class AxisPoint(NamedTuple):
    """A control point of the axis of a generalised cylinder: where the turtle is, its heading, and the width of its strokes."""

    place: Vector
    heading: Vector
    width: float


def _here(turtle: SpaceTurtle) -> AxisPoint:
    return AxisPoint(turtle.position, turtle.orientation[0], turtle.stroke_width)


def hermite(start: AxisPoint, end: AxisPoint, parts: int) -> list[Vector]:
    """The places on a Hermite curve between its ends.

    >>> hermite(AxisPoint((0, 0, 0), (0, 0, 1), 1), AxisPoint((0, 0, 2), (0, 0, 1), 1), 2)
    [(0.0, 0.0, 1.0)]
    """
    reach = TANGENT * math.dist(start.place, end.place)
    return [_on_curve(start, end, reach, part / parts) for part in range(1, parts)]


def _on_curve(start: AxisPoint, end: AxisPoint, reach: float, t: float) -> Vector:
    weights = (1 + 2 * t) * (1 - t) ** 2, t * (1 - t) ** 2 * reach, t**2 * (3 - 2 * t), -(t**2) * (1 - t) * reach
    x, y, z = (sum(map(mul, weights, axis)) for axis in zip(start.place, start.heading, end.place, end.heading, strict=True))
    return x, y, z


def _bounded_number(value: float) -> int:
    return max(1, min(MOST_PARTS, math.floor(value + 0.5)))


def _number_of(instruction: Instruction) -> float:
    return instruction.values[0] if instruction.values else 0.0


class SpaceTurtle(Turtle):
    """A turtle in space, whose position is a point and whose orientation is a frame.

    Where it stays in the plane of the picture, or is `flat`, as it draws many surfaces, it draws these by their outlines.
    """

    __slots__ = ("start", "strokes")
    position: Vector
    orientation: TurtleFrame
    axis: AxisPoint | None

    def __init__(self, frame: TurtleFrame, step: float) -> None:
        super().__init__((0.0, 0.0, 0.0), frame, step)
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
        self.last = len(self.strokes) // _STROKE_COLUMNS
        self.strokes.extend((*start, *end, len(self.stack), self.state, width, self.colour))

    def scanned_orientation(
        self, commands: Commands, branches: Branches, carried: Carried, prepare: Callable[[Instruction], Any]
    ) -> Any:
        matrices = [np.full(len(carried.mirror), float(row == column)) for row in range(3) for column in range(3)]
        for action in TURNS:
            rows = np.flatnonzero(commands.calling(action))
            amounts: Any = commands.factor[rows], commands.addend[rows]
            cos, sin = prepare(Instruction(action, *amounts))
            a, b = _AXES.get(action, (0, 1))
            sin = sin * carried.mirror[rows] if action == "turn by mirrored angle" else sin
            for row, column, value in ((a, a, cos), (a, b, -sin), (b, a, sin), (b, b, cos)):
                matrices[3 * row + column][rows] = value
        turning = commands.calling(*TURNS)
        first = tuple(chain.from_iterable(zip(*self.orientation[:3], strict=True)))
        found = branches.along(turning, tuple(entry[turning] for entry in matrices), turned, first)
        return *(tuple(found[column::3]) for column in range(3)), np.zeros(len(turning), np.int64)

    def scanned_position(self, commands: Commands, branches: Branches, carried: Carried, orientation: Any) -> Any:
        moves, draws = commands.calling(*MOVES), commands.calling(*DRAWS)
        lengths = carried.scale * (commands.factor * carried.length + commands.addend)
        found = branches.along(moves, tuple((lengths * each)[moves] for each in orientation[0]), added, self.position)
        starts = [branches.before_each(column, first) for column, first in zip(found, self.position, strict=True)]
        columns = *starts, *found, branches.order, commands.state, carried.stroke_width, carried.colour
        self.strokes.frombytes(np.stack([column[draws] for column in columns], axis=1, dtype=np.float64).tobytes())
        return found

    def initial_orientation(self, degrees: float) -> TurtleFrame:
        head, left, up, rotations = self.start
        return *rotated_towards(head, left, *cos_sin(degrees)), up, rotations

    def draw_surface(self, surface: Surface, size: float) -> None:
        if self.in_plane or self.flat or not surface.facets.normals:
            super().draw_surface(surface, size)
            return
        check_budget()
        for face, normals in zip(surface.facets.faces, surface.facets.normals, strict=True) if size else ():
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

    def do_begin_cylinder(self, _: Instruction) -> None:
        self.axis = _here(self)

    def do_continue_cylinder(self, instruction: Instruction) -> None:
        """Draw the cylinder from its last control point to the self."""
        if self.axis is None:
            return
        before, self.axis = self.axis, _here(self)
        parts = _bounded_number(instruction.addend)
        places = [*hermite(before, self.axis, parts), self.position]
        bare = OWN in (before.width, self.axis.width)
        for number, (start, end) in enumerate(zip([before.place, *places[:-1]], places, strict=True), 1):
            share = number / parts
            self.stroke(start, end, OWN if bare else (1 - share) * before.width + share * self.axis.width)

    def do_end_cylinder(self, instruction: Instruction) -> None:
        self.do_continue_cylinder(instruction)
        self.axis = None

    def do_begin_patch(self, instruction: Instruction) -> None:
        self.patches[_number_of(instruction)] = {}

    def do_set_control_point(self, instruction: Instruction) -> None:
        """Take the position of the self as the control point of a row and a column."""
        number, row, column, *_ = (*instruction.values, 0.0, 0.0, 0.0)
        if number in self.patches:
            self.patches[number][row, column] = self.position

    def do_draw_patch(self, instruction: Instruction) -> None:
        """Draw a patch whose sixteen control points are known; rows and columns count from 0 or from 1."""
        points = self.patches.get(_number_of(instruction), {})
        rows, columns = (sorted({place[which] for place in points}) for which in (0, 1))
        if len(points) != _ROWS**2 or len(rows) != _ROWS or len(columns) != _ROWS:
            self.unknown[instruction.symbol] = None
            return
        check_bytes(FACE_BYTES * len(self.outlines), lambda: "The patches were not drawn")
        check_budget()
        control: Any = [[points[row, column] for column in columns] for row in rows]
        along, across = (_bounded_number(value) for value in (*instruction.values[1:3], *[PATCH_FACES] * 2)[:2])
        grids = patch_grid(control, along, across)
        for i, j in product(range(along), range(across)):
            places = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
            corners, normals = ([grid[a][b] for a, b in places] for grid in grids)
            self.outlines.append(Outline(corners, self.state, self.colour, normals))

    def do_turn(self, angle: tuple[float, float]) -> None:
        head, left, up, rotations = self.orientation
        head, left = rotated_towards(head, left, *angle)
        self.orientation = next_frame(head, left, up, rotations)

    do_turn_back = do_turn

    def do_turn_by_mirrored_angle(self, angle: tuple[float, float]) -> None:
        cos, sin = angle
        self.do_turn((cos, self.mirror * sin))

    def do_pitch(self, angle: tuple[float, float]) -> None:
        head, left, up, rotations = self.orientation
        up, head = rotated_towards(up, head, *angle)
        self.orientation = next_frame(head, left, up, rotations)

    def do_roll(self, angle: tuple[float, float]) -> None:
        head, left, up, rotations = self.orientation
        up, left = rotated_towards(up, left, *angle)
        self.orientation = next_frame(head, left, up, rotations)

    def do_level(self, _: Instruction) -> None:
        """Roll until L is level: it becomes that of vertical x H, unless H is vertical (ABOP, page 57)."""
        head, _left, _up, rotations = self.orientation
        across = math.hypot(head[0], head[1])
        if across > _NEGLIGIBLE:
            left = -head[1] / across, head[0] / across, 0.0
            self.orientation = head, left, cross(head, left), rotations

    def do_gravitropism(self, instruction: Instruction) -> None:
        """Bend as GROGRA's RV: H takes the direction of H - strength * vertical; a vertical H can only be reversed."""
        (hx, hy, hz), *_ = self.orientation
        strength = instruction.factor * self.gravitropism + instruction.addend
        across = math.hypot(hx, hy)
        if across > _NEGLIGIBLE:
            _rotate(self, (-hy / across, hx / across, 0.0), math.atan2(across, hz - strength) - math.atan2(across, hz))
        elif hz > 0 and strength > 1:
            self.do_pitch((-1.0, 0.0))

    def do_set_tropism(self, instruction: Instruction) -> None:
        """Set a tropism: `@Ts(e)`, or as in cpfg `@Ts(number, e)`, or with a direction `@Ts(number, e, x, y, z)`."""
        number, elasticity, *direction = instruction.values if len(instruction.values) > 1 else (1.0, *instruction.values, 0.0)
        x, y, z = direction if len(direction) == 3 else (0.0, -1.0, 0.0)
        self.tropisms = {**self.tropisms, number: _from_cpfg((elasticity * x, elasticity * y, elasticity * z))}

    def do_set_position(self, instruction: Instruction) -> None:
        x, y, z, *_ = (*instruction.values, 0.0, 0.0, 0.0)
        self.position = _from_cpfg((x, y, z))

    def do_set_heading(self, instruction: Instruction) -> None:
        """Take a heading H, and an up U as far as H lets it: `@R(x, y, z)`, or `@R(x, y, z, x, y, z)` with both."""
        x, y, z, *others = (*instruction.values, 0.0, 0.0, 0.0)
        head = _from_cpfg((x, y, z))
        if math.hypot(*head) <= _NEGLIGIBLE:
            return
        head, (_, left, up, _) = unit(head), self.orientation
        wanted = _from_cpfg((others[0], others[1], others[2])) if len(instruction.values) > 5 else up
        across = next(side for side in (cross(wanted, head), cross(up, head), left) if math.hypot(*side) > _NEGLIGIBLE)
        left = unit(across)
        self.orientation = head, left, cross(head, left), 0

    def do_return_to_stroke(self, instruction: Instruction) -> None:
        if self.last is not None:
            first = self.last * _STROKE_COLUMNS
            x, y, z, u, v, w = self.strokes[first : first + 6]
            part = instruction.factor + instruction.addend
            self.position = x + part * (u - x), y + part * (v - y), z + part * (w - z)


def _bend_by_tropism(turtle: SpaceTurtle, pull: Vector) -> None:
    """Bend towards a tropism T by the angle e |H x T| about H x T; the pull is e T (ABOP, page 58)."""
    axis = cross(turtle.orientation[0], pull)
    radians = math.hypot(*axis)
    if radians > _NEGLIGIBLE:
        _rotate(turtle, unit(axis), radians)


def _rotate(turtle: SpaceTurtle, axis: Vector, radians: float) -> None:
    cos, sin = math.cos(radians), math.sin(radians)
    ax, ay, az = axis

    def rotated(v: Vector) -> Vector:
        along = (1 - cos) * (ax * v[0] + ay * v[1] + az * v[2])
        x, y, z = cross(axis, v)
        return cos * v[0] + sin * x + along * ax, cos * v[1] + sin * y + along * ay, cos * v[2] + sin * z + along * az

    head, left, up, rotations = turtle.orientation
    turtle.orientation = next_frame(rotated(head), rotated(left), rotated(up), rotations)


def _from_cpfg(point: Vector) -> Vector:
    """A point or direction in the axes used here, given in cpfg's, where y grows upwards and z towards the viewer."""
    x, y, z = point
    return x, -z, y


_ROTATIONS = frozenset(("turn", "turn by mirrored angle", "turn back", "pitch", "roll"))
SPACE_HANDLERS = handlers_of(SpaceTurtle)


def trace_in_space(word: Word | WordBetween, angle: float | None = None) -> Scene:
    """The scene that a turtle in space draws by interpreting a word.

    >>> from lsys_kit import derive, read
    >>> bush = read("angle: 22.5\\naxiom: A\\nA -> [&F A] /(120) [&F A] /(120) [&F A]")
    >>> print(trace_in_space(derive(bush, 4)[-1]))
    120 segments, width 5.22, height 3.78, depth 4.82
    """
    turtle = turtle_after(word, float(word.states.system.angle) if angle is None else angle)
    polygons, discs = collected_shapes(turtle.outlines, turtle.rounds, _points)
    return Scene(
        strokes_of(turtle),
        polygons=polygons,
        discs=discs,
        labels=collected_labels(turtle.labels, _points),
        unknown=tuple(turtle.unknown),
    )


def turtle_after(word: Word | WordBetween, angle: float) -> SpaceTurtle:
    """The turtle that has interpreted a word."""
    system = word.states.system
    turtle = SpaceTurtle(initial_frame(system.turtle, float(system.heading)), initial_step(system))
    turtle.take_look(system)
    turtle.in_plane = in_plane(system)
    run_turtle(turtle, word, SPACE_HANDLERS, lambda instruction: operand(instruction, angle))
    return turtle


def spans_in_space(turtle: SpaceTurtle) -> list[float]:
    """How far what a turtle has drawn extends along each axis."""
    places: list[Any] = [corner for outline in turtle.outlines for corner in outline.corners]
    places += [*(each.place for each in turtle.rounds), *(each.place for each in turtle.labels)]
    found = []
    for axis in range(3):
        strokes = (turtle.strokes[first::_STROKE_COLUMNS] for first in (axis, axis + 3))
        along = [*chain(*strokes, (place[axis] for place in places))]
        found.append(max(along, default=0.0) - min(along, default=0.0))
    return found


def strokes_in_space(turtle: SpaceTurtle) -> list[Stroke]:
    """The strokes that a turtle has drawn, one after another."""
    rows = range(0, len(turtle.strokes), _STROKE_COLUMNS)
    return [tuple(turtle.strokes[first : first + 6]) for first in counted(rows)]


def strokes_of(turtle: SpaceTurtle) -> Segments:
    rows = np.array(turtle.strokes).reshape(-1, _STROKE_COLUMNS)
    orders, states, colours = (rows[:, column].astype(np.int64) for column in (6, 7, 9))
    return Segments(rows[:, :6].copy(), orders, states, rows[:, 8].copy(), colours)


def operand(instruction: Instruction, angle: float) -> tuple[float, float] | Instruction:
    """The operand of a handler: cosine and sine for a rotation, else the instruction itself.

    >>> operand(Instruction("pitch", 0.0, -90.0), 25.7)
    (0.0, -1.0)
    """
    return cos_sin(instruction.factor * angle + instruction.addend) if instruction.action in _ROTATIONS else instruction


def _points(places: list[object]) -> Floats:
    return np.array(places, np.float64).reshape(-1, 3)
