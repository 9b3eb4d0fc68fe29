"""The strokes of drawings whose rules are looked for: read, with length 1, and as a graph of points.

A point of the plane is a complex number here, a turn the product with one: x to the right is real, y upwards imaginary.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from math import degrees
from typing import TYPE_CHECKING, Any, TypeAlias

from lsys_kit.arrays import is_array, np
from lsys_kit.budget import check_budget, counted
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.geometry.scene import Floats, Scene

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.spatial import cKDTree

Points: TypeAlias = "NDArray[np.complex128]"
MOST_STROKES = 20_000
"""So many strokes may all drawings have together."""
NEAR = 0.01
"""Ends that are nearer, in lengths of a stroke, are one point; and so much may strokes differ in length."""
MOST_COMPARED = 400
"""Turning angles are read off drawings with so many strokes at most."""
LEAST_ANGLE = 1.0
"""Turning angles are so many degrees at least."""
DEGREES_NEAR = 0.05
"""Directions that differ by fewer degrees are one."""
PARTS = 3
"""An angle between strokes is so many turns at most, where it is the smallest."""


@dataclass(frozen=True)
class Strokes:
    """The strokes of one drawing, each of length 1, as a graph.

    ends
        Shape (n, 2): the ends of each, in no order.
    """

    ends: Points

    def __len__(self) -> int:
        return len(self.ends)

    @cached_property
    def vertices(self) -> list[tuple[int, int]]:
        """For each stroke the numbers of the points at its ends; ends that lie near one another are one point."""
        points = self.ends.reshape(-1)
        first = [min(near) for near in _tree(points).query_ball_point(np.column_stack([points.real, points.imag]), NEAR)]
        return list(zip(first[::2], first[1::2], strict=True))

    def point(self, number: int) -> complex:
        return complex(self.ends.reshape(-1)[number])

    @cached_property
    def leaving(self) -> dict[int, list[tuple[int, int, float]]]:
        """For each point the strokes that leave it: the number of the stroke, the point at which it ends, its direction in
        radians."""
        found: dict[int, list[tuple[int, int, float]]] = {}
        for number, ((one, other), (begin, end)) in enumerate(zip(self.vertices, self.ends, strict=True)):
            found.setdefault(one, []).append((number, other, float(np.angle(end - begin))))
            found.setdefault(other, []).append((number, one, float(np.angle(begin - end))))
        return found

    @property
    def coordinates(self) -> Floats:
        """Shape (n, 4), as a scene has them."""
        return np.column_stack([self.ends[:, 0].real, self.ends[:, 0].imag, self.ends[:, 1].real, self.ends[:, 1].imag])

    @property
    def is_connected(self) -> bool:
        reached, left = set[int](), [self.vertices[0][0]]
        while left:
            point = left.pop()
            if point not in reached:
                reached.add(point)
                left += [end for _, end, _ in self.leaving[point]]
        return len(reached) == len(self.leaving)


def _tree(points: Points) -> cKDTree:
    from scipy.spatial import cKDTree

    return cKDTree(np.column_stack([points.real, points.imag]))


def is_drawing(given: object) -> bool:
    """Whether something is a drawing rather than a word: a picture, a scene, or strokes in an array or as rows of four numbers.

    >>> is_drawing([(0, 0, 0, 1)]), is_drawing("F+F"), is_drawing(["F", "F"])
    (True, False, False)
    """
    if isinstance(getattr(given, "scene", given), Scene):
        return True
    if is_array(given):
        return given.ndim == 2
    return isinstance(given, list | tuple) and bool(given) and (isinstance(given[0], list | tuple) or is_array(given[0]))


def read_drawings(given: Iterable[object]) -> tuple[Strokes, ...]:
    """The strokes of each drawing, their length made 1.

    >>> [abs(end - begin).tolist() for begin, end in read_drawings([[(0, 0, 0, 7)]])[0].ends]
    [1.0]
    """
    found: list[Strokes] = []
    for step, each in enumerate(counted(given, 1)):
        found.append(Strokes(_unit_strokes(_coordinates(each, step), step)))
        if sum(map(len, found)) > MOST_STROKES:
            raise ModelLimitError(
                f"The drawings up to step {step} have more than {MOST_STROKES:,} strokes",
                limit=MOST_STROKES,
                hint="Give fewer steps.",
            )
    return tuple(found)


def _coordinates(given: object, step: int) -> Floats:
    scene = getattr(given, "scene", given)
    try:
        found = np.asarray(scene.segments.ends if isinstance(scene, Scene) else given, dtype=float)
    except (TypeError, ValueError):
        found = np.empty(1)
    if not found.size:
        return np.empty((0, 4))
    if found.ndim != 2 or found.shape[1] != 4 or not np.isfinite(found).all():
        raise ModelValueError(
            f"The drawing of step {step} must be a picture in the plane, or strokes with four numbers each",
            hint="A stroke is a row of x and y of its one end, then x and y of its other.",
        )
    return found


def _unit_strokes(coordinates: Floats, step: int) -> Points:
    ends = np.column_stack([coordinates[:, 0] + 1j * coordinates[:, 1], coordinates[:, 2] + 1j * coordinates[:, 3]])
    if not len(ends):
        return ends
    lengths = abs(ends[:, 1] - ends[:, 0])
    usual = float(np.median(lengths))
    if not usual or (abs(lengths / usual - 1) > NEAR).any():
        raise ModelValueError(
            f"The strokes of step {step} differ in length", hint="Rules are found for drawings whose strokes are equally long."
        )
    return np.asarray((ends - ends.mean()) / usual)


def angle_between(drawings: Sequence[Strokes]) -> float:
    """The angle in degrees of which all angles between strokes are multiples; a right angle where all strokes are parallel.

    >>> round(angle_between(read_drawings([[(0, 0, 0, 1), (0, 1, 0.6, 1.8)]])), 6)
    36.869898
    """
    between = sorted({angle for each in drawings if len(each) <= MOST_COMPARED for angle in _between(each)})
    if not between:
        return 90.0
    for parts in range(1, PARTS + 1):
        angle = between[0] / parts
        if all(_is_multiple(other, angle) for other in between):
            return _rounded(angle)
    return _rounded(between[0])


def _between(strokes: Strokes) -> Iterator[float]:
    directions = np.unique(np.round(np.degrees(np.angle(strokes.ends[:, 1] - strokes.ends[:, 0])) % 180, 6))
    for one, other in combinations(directions.tolist(), 2):
        check_budget()
        angle = min(other - one, 180 - other + one)
        if angle > LEAST_ANGLE:
            yield angle


def _is_multiple(angle: float, unit: float) -> bool:
    multiples = unit * np.arange(-round(360 / unit), round(360 / unit) + 1)
    return bool((abs((multiples - angle + 90) % 180 - 90) < DEGREES_NEAR).any())


def _rounded(angle: float) -> float:
    """The angle with as few decimals as it has but for rounding errors."""
    return next(round(angle, places) for places in range(10) if places == 9 or abs(round(angle, places) - angle) < 2e-6)


@dataclass(frozen=True)
class Turning:
    """The turns that + and - make.

    degrees
        The angle of one of them.
    """

    degrees: float

    @property
    def most(self) -> int:
        """So many of them in one direction are as good as more."""
        return int(180 / self.degrees + 1e-9)

    @cached_property
    def several(self) -> NDArray[np.int64]:
        """The numbers of turns that differ, from right to left."""
        whole = abs(self.most * self.degrees - 180) < DEGREES_NEAR / 10
        return np.arange(-self.most + whole, self.most + 1)

    def by(self, number: object) -> Any:
        return np.exp(1j * np.radians(self.degrees) * number)

    def is_(self, radians: float, number: int) -> bool:
        """Whether an angle is so many turns to the left.

        >>> Turning(90).is_(np.pi, -2), Turning(90).is_(np.pi / 2, -1)
        (True, False)
        """
        return abs((number * self.degrees - degrees(radians) + 180) % 360 - 180) < degrees(NEAR)

    def number(self, radians: float) -> int | None:
        """How many turns an angle is, as few as possible, to the left; None where it is no multiple.

        >>> Turning(60).number(np.pi), Turning(90).number(-np.pi / 2), Turning(90).number(1)
        (3, -1, None)
        """
        off = abs((self.several * self.degrees - np.degrees(radians) + 180) % 360 - 180)
        fitting = self.several[off < np.degrees(NEAR)]
        return int(min(fitting, key=abs)) if len(fitting) else None
