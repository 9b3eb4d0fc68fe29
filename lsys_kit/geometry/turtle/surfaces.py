"""Surfaces that `~` draws, as in `~L(2)`: leaves, needles, petals, sepals, buds, flowers and fruits, and those of a model.

The kit's own are defined in `surfaces.toml`: blades by their midrib and margin, flowers by their petals, solids by a profile.
Curved surfaces are small faces: bicubic Bezier patches (ABOP, section 5.1), and solids of revolution. A point is given in the
frame of a turtle: ahead, to the left, up. Each corner of a face has the normal that the surface has there, so that a mesh of
few faces is shaded as the smooth surface.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property, lru_cache, partial
from itertools import pairwise, product
from operator import mul
from typing import NamedTuple, TypeAlias

from lsys_kit.errors import quotable
from lsys_kit.files import Entries, toml_tables
from lsys_kit.geometry.turtle.commands import COMMANDS
from lsys_kit.notation.model.modules import flat
from lsys_kit.notation.model.surfaces import ROW, SurfacePoint, SurfaceShape
from lsys_kit.notation.model.system import LSystem

Corner: TypeAlias = tuple[float, float, float]
"""A point in the frame of the turtle: ahead, to the left, up."""
Face: TypeAlias = tuple[Corner, ...]
Grid: TypeAlias = Sequence[Sequence[Corner]]
Weights: TypeAlias = tuple[float, float, float, float]
DECIMALS = 4
"""So many decimals of a corner are kept: a surface is about 1 long."""
OUTLINED, BESIDE = 16, 0.008
"""An outline has so many corners along each side of a patch, less those that lie no farther beside it than this."""
INWARDS = 1e-3
"""Where a patch ends in a point, its normal is taken this part of its length further in."""


class Facets(NamedTuple):
    """Faces of a surface; for each corner of each face the unit normal there; and the outlines of its parts.

    Outlines are what is drawn in the plane of a picture. Surfaces without normals are flat.
    """

    faces: tuple[Face, ...] = ()
    normals: tuple[Face, ...] = ()
    outlines: tuple[Face, ...] = ()

    def mapped(self, turn: Callable[[Corner], Corner]) -> Facets:
        """The surface after a rotation.

        >>> Facets((((1.0, 2.0, 3.0),),)).mapped(lambda corner: corner[::-1]).faces
        (((3.0, 2.0, 1.0),),)
        """
        return Facets(*(tuple(tuple(map(turn, face)) for face in kind) for kind in self))


def joined_facets(parts: Sequence[Facets]) -> Facets:
    return Facets(*(tuple(face for part in parts for face in part[kind]) for kind in range(3)))


def polygon_facets(corners: Sequence[Corner]) -> Facets:
    face = tuple(map(_rounded, corners))
    return Facets((face,), (), (face,))


def patch_facets(control: Grid, along: int, across: int) -> Facets:
    """A bicubic Bezier patch as so many rows and columns of faces.

    control
        Four rows of four control points.
    along, across
        The numbers of rows and of columns.

    >>> found = patch_facets([[(row / 3, column / 3, 0.0) for column in range(4)] for row in range(4)], 1, 1)
    >>> found.faces
    (((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)),)
    >>> found.normals[0][0]
    (0.0, 0.0, 1.0)
    """
    return _grid_facets(*patch_grid(control, along, across), _boundary(patch_grid(control, OUTLINED, OUTLINED)[0]))


def patch_grid(control: Grid, along: int, across: int) -> tuple[Grid, Grid]:
    """The points of a patch at even parameters, and the normals there, as they are."""
    rows, columns = _even(along), _even(across)
    return _tensor(map(_bernstein, rows), control, map(_bernstein, columns)), _normals(control, rows, columns)


def _even(pieces: int) -> list[float]:
    return [number / pieces for number in range(pieces + 1)]


def _inside(t: float) -> float:
    return min(max(t, INWARDS), 1 - INWARDS)


def _bernstein(t: float) -> Weights:
    """Bernstein's polynomials of degree 3 at a place."""
    return (1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3


def _slopes(t: float) -> Weights:
    return -3 * (1 - t) ** 2, 3 * (1 - t) * (1 - 3 * t), 3 * t * (2 - 3 * t), 3 * t**2


def _weighted(weights: Weights, points: Iterable[Sequence[float]]) -> list[float]:
    return [sum(map(mul, weights, axis)) for axis in zip(*points, strict=True)]


def _tensor(rows: Iterable[Weights], control: Grid, columns: Iterable[Weights]) -> Grid:
    curves = [[_weighted(column, line) for line in control] for column in columns]
    return [[_corner(_weighted(row, curve)) for curve in curves] for row in rows]


def _corner(numbers: Iterable[float]) -> Corner:
    ahead, left, up = numbers
    return ahead, left, up


def _normals(control: Grid, rows: Sequence[float], columns: Sequence[float]) -> Grid:
    """The unit normals at the corners of faces: the cross products of the tangents; upwards where there is none."""
    along, across = ([*map(_inside, places)] for places in (rows, columns))
    tangents = (
        _tensor(map(_slopes, along), control, map(_bernstein, across)),
        _tensor(map(_bernstein, along), control, map(_slopes, across)),
    )
    return [[_normal(*pair) for pair in zip(*lines, strict=True)] for lines in zip(*tangents, strict=True)]


def _normal(one: Corner, other: Corner) -> Corner:
    (ax, ay, az), (bx, by, bz) = one, other
    found = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    length = math.hypot(*found)
    return _corner(each / length for each in found) if length > 0 else (0.0, 0.0, 1.0)


def _grid_facets(points: Grid, normals: Grid, outline: Sequence[Corner]) -> Facets:
    """The faces between the rows and columns of a grid of points; those without an area are left out."""
    corners, upright = ([[*map(_rounded, row)] for row in grid] for grid in (points, normals))
    found = []
    for i, j in product(range(len(points) - 1), range(len(points[0]) - 1)):
        distinct = {corners[a][b]: upright[a][b] for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))}
        if len(distinct) > 2:
            found.append((tuple(distinct), tuple(distinct.values())))
    return Facets(tuple(face for face, _ in found), tuple(normal for _, normal in found), (tuple(outline),))


def _boundary(points: Grid) -> list[Corner]:
    """The outline of a grid of points, with no more corners than are seen in the plane."""
    first, last = ([row[end] for row in points] for end in (0, -1))
    corners = [*map(_rounded, (*first[:-1], *points[-1][:-1], *last[:0:-1], *points[0][:0:-1]))]
    farthest = max(range(len(corners)), key=lambda number: math.dist(corners[number][:2], corners[0][:2]))
    halves = (_simplified(half) for half in (corners[: farthest + 1], [*corners[farthest:], corners[0]]))
    bent = [corner for half in halves for corner in half[:-1]]
    return bent if len(bent) > 2 else corners


def _simplified(line: list[Corner]) -> list[Corner]:
    """A line without the corners that lie hardly beside it (D. Douglas and T. Peucker, 1973)."""
    (x, y, _), (to_x, to_y, _) = line[0], line[-1]
    length = math.hypot(to_x - x, to_y - y)
    aside = [abs((to_x - x) * (left - y) - (to_y - y) * (ahead - x)) for ahead, left, _ in line[1:-1]] if length else []
    if max(aside, default=0.0) <= BESIDE * length:
        return [line[0], line[-1]]
    bend = aside.index(max(aside)) + 1
    return [*_simplified(line[: bend + 1])[:-1], *_simplified(line[bend:])]


def _rounded(corner: Sequence[float]) -> Corner:
    """A corner with few decimals, and no negative zeros."""
    ahead, left, up = (round(float(number), DECIMALS) + 0.0 for number in corner)
    return ahead, left, up


def turned(degrees: float) -> Callable[[Corner], Corner]:
    """A turn to the left."""
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda corner: _rounded((cos * corner[0] - sin * corner[1], sin * corner[0] + cos * corner[1], corner[2]))


def rolled(degrees: float) -> Callable[[Corner], Corner]:
    """A roll to the right, about the direction ahead."""
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda corner: _rounded((corner[0], cos * corner[1] - sin * corner[2], sin * corner[1] + cos * corner[2]))


def blade_control(midrib: Sequence[Sequence[float]], margin: Sequence[Sequence[float]], bulge: float) -> Grid:
    """The control points of the left half of a blade, from its midrib to its margin.

    midrib
        Four control points of a curve: ahead and up.
    margin
        Four of another: ahead, to the left, and up.
    bulge
        How far the blade is raised between them.
    """
    inner = [(ahead, 0.0, up) for ahead, up in midrib]
    raised = [[(0.0, 0.0, bulge * (0 < row < 3 and 0 < column < 3)) for column in range(4)] for row in range(4)]
    return [
        [
            _corner(one * (1 - share / 3) + other * share / 3 + more for one, other, more in zip(*ends, lift, strict=True))
            for share, lift in enumerate(lifts)
        ]
        for *ends, lifts in zip(inner, margin, raised, strict=True)
    ]


def mirrored_control(control: Grid) -> Grid:
    """The control points of the other half of a blade, which is seen from the same side."""
    return [[(ahead, -left, up) for ahead, left, up in reversed(row)] for row in control]


def revolved_facets(profile: Sequence[Sequence[float]], sides: int, pieces: int) -> Facets:
    """The faces of a solid whose profile turns about the direction ahead.

    profile
        The control points of cubic Bezier curves, each of which begins where the one before ends: how far ahead, and how far
        from the axis.
    sides, pieces
        The number of sides, and of pieces of each curve.

    >>> ball = revolved_facets([(-1, 0), (-1, 1.33), (1, 1.33), (1, 0)], 4, 3)
    >>> len(ball.faces), len(ball.outlines[0])
    (12, 6)
    """
    places, slopes = (_along(profile, basis, pieces) for basis in (_bernstein, _slopes))
    across = [(-out / (length or 1), ahead / (length or 1)) for ahead, out in slopes for length in [math.hypot(ahead, out)]]
    turns = [-math.tau * side / sides % math.tau for side in range(sides + 1)]
    points, normals = (
        [[(ahead, out * math.cos(turn), out * math.sin(turn)) for turn in turns] for ahead, out in each]
        for each in (places, across)
    )
    outline = [*((ahead, out, 0.0) for ahead, out in places), *((ahead, -out, 0.0) for ahead, out in places[-2:0:-1])]
    return _grid_facets(points, normals, [*dict.fromkeys(map(_rounded, outline))])


def _along(profile: Sequence[Sequence[float]], basis: Callable[[float], Weights], pieces: int) -> list[list[float]]:
    """The places along the curves of a profile, or the slopes there: just inside where a curve ends in a point."""
    weights = [basis(_inside(t) if basis is _slopes else t) for t in _even(pieces)]
    curves = [[_weighted(each, profile[first : first + 4]) for each in weights] for first in range(0, len(profile) - 1, 3)]
    return [*curves[0], *(place for curve in curves[1:] for place in curve[1:])]


MOST_CURVED = 150
"""Where more surfaces are drawn, each is drawn by its outlines: one sees little of its curvature."""
PATCH_FACES = 5
"""A patch has so many rows and columns of faces, where no number says otherwise."""


@dataclass(frozen=True)
class Surface:
    """A surface composed of faces, which are computed when they are first asked for.

    name
        Its name.
    symbols
        The symbols that stand for it after a tilde.
    computed
        Computes its faces.
    """

    name: str
    symbols: tuple[str, ...]
    computed: Callable[[], Facets] = field(repr=False)

    @cached_property
    def facets(self) -> Facets:
        """Its faces, normals and outlines."""
        return self.computed()


@cache
def surfaces() -> Mapping[str, Surface]:
    """The surfaces that the kit has, by name; each is about 1 long.

    >>> list(surfaces())
    ['leaf', 'needle', 'petal', 'sepal', 'bud', 'flower', 'rosette', 'fruit']
    >>> len(surfaces()["bud"].facets.faces)
    48
    """
    tables = toml_tables(__package__, "surfaces.toml")
    return {name: Surface(name, tuple(table["symbols"]), partial(_facets, table)) for name, table in tables.items()}


def _facets(table: Entries) -> Facets:
    if "profile" in table:
        return revolved_facets(table["profile"], table["sides"], table["pieces"])
    blade = _blade(table)
    if "petals" not in table:
        return blade
    turns = [360 * number / table["petals"] for number in range(table["petals"])]
    if "opening" in table:
        opened = blade.mapped(rolled(90)).mapped(turned(table["opening"]))
        return joined_facets([opened.mapped(rolled(turn)) for turn in turns])
    return joined_facets([blade.mapped(turned(turn)) for turn in turns])


def _blade(table: Entries) -> Facets:
    """A blade: two halves on both sides of its midrib, perhaps with a stalk."""
    control = blade_control(table["midrib"], table["margin"], table["bulge"])
    parts = [patch_facets(half, *table["faces"]) for half in (control, mirrored_control(control))]
    outline = parts[0].outlines[0]
    if "stalk" in table:
        length, width = table["stalk"]
        ahead = [length * row / 3 for row in range(ROW)]
        stalk = blade_control([(x, 0.0) for x in ahead], [(x, width / 2, 0.0) for x in ahead], 0.0)
        parts += [patch_facets(half, 1, 1) for half in (stalk, mirrored_control(stalk))]
        outline = ((0.0, 0.0, 0.0), *outline[1:], (length, width / 2, 0.0), (0.0, width / 2, 0.0))
    mirrored = tuple((ahead, 0.0 - left, up) for ahead, left, up in reversed(outline))
    return joined_facets(parts)._replace(outlines=(outline, mirrored))


@lru_cache(maxsize=256)
def declared_surface(shape: SurfaceShape) -> Surface:
    """A surface that a model declares.

    >>> scale = declared_surface(SurfaceShape("scale", ((0, 0, 0), (1, 0, 0), (1, 1, 0))))
    >>> [len(face) for face in scale.facets.faces]
    [3]
    """
    return Surface(shape.name, (shape.name,), partial(_declared_facets, shape))


def _declared_facets(shape: SurfaceShape) -> Facets:
    if shape.polygon:
        return polygon_facets([_floats(corner) for corner in shape.polygon])
    points = ([*map(_floats, patch)] for patch in shape.patches)
    controls = ([patch[first : first + ROW] for first in range(0, ROW**2, ROW)] for patch in points)
    return joined_facets([patch_facets(control, PATCH_FACES, PATCH_FACES) for control in controls])


def _floats(point: SurfacePoint) -> tuple[float, float, float]:
    ahead, left, up = map(float, point)
    return ahead, left, up


@lru_cache(maxsize=64)
def surfaces_by_symbol(system: LSystem) -> Mapping[str, Surface]:
    """The surfaces of a system, by what stands for them after a tilde: its own, and those of the kit.

    >>> from lsys_kit import read
    >>> found = surfaces_by_symbol(read("surface L: (0, 0) (1, 0) (1, 1)\\naxiom: ~L"))
    >>> found["L"].name, found["leaf"].name, len(found["L"].facets.faces)
    ('L', 'leaf', 1)
    """
    kits = {symbol: surface for surface in surfaces().values() for symbol in surface.symbols}
    return {**kits, **{shape.name: declared_surface(shape) for shape in system.surfaces}}


def passed_over(unknown: Sequence[str]) -> str:
    """What a turtle has passed over, in words; empty if that is nothing.

    >>> passed_over(["~X"])
    'no surface is called X: there are L (leaf), needle, ...; a model declares others'
    >>> passed_over(["~"])
    'passed over, because no surface is named after it: ~'
    """
    names = [symbol[1:] for symbol in unknown if symbol[0] == "~" and symbol != "~"]
    others = [symbol for symbol in unknown if symbol[0] != "~" and symbol != "@PD"]
    there_are = ", ".join(
        f"{surface.symbols[0]} ({surface.name})" if len(surface.symbols) > 1 else surface.name
        for surface in surfaces().values()
    )
    said = [
        f"passed over, without a meaning here: {quotable(' '.join(others))}" if others else "",
        f"no surface is called {quotable(' or '.join(names))}: there are {there_are}; a model declares others" if names else "",
        "@PD draws a patch whose sixteen control points are set by @PC" if "@PD" in unknown else "",
        "passed over, because no surface is named after it: ~" if "~" in unknown else "",
    ]
    return "; ".join(filter(None, said))


def surfaces_of(system: LSystem) -> Mapping[str, str]:
    """For each symbol of a system that is drawn as a surface, directly or by interpretation, the name of the surface.

    >>> from lsys_kit import read
    >>> surfaces_of(read("axiom: A\\nA -> F [+ ~ L] B\\ninterpretation:\\nB -> ~flower(2)"))
    {'L': 'leaf', 'flower': 'flower', 'B': 'flower'}
    """
    known = surfaces_by_symbol(system)
    words = [tuple(flat(word)) for word in (system.axiom, *(rule.successor for rule in system.rules))]
    called = [
        (behind.symbol, surface.name)
        for word in words
        for before, behind in pairwise(word)
        if before.symbol == "~" and (surface := known.get(behind.symbol))
    ]
    drawn = [
        (module.symbol, command.surface)
        for word in words
        for module in word
        for command in COMMANDS[system.turtle].get(module.symbol, ())
        if command.surface
    ]
    found = dict((*called, *drawn))
    for rule in system.interpretation:
        shown = next((found[module.symbol] for module in flat(rule.successor) if module.symbol in found), None)
        if shown:
            found.setdefault(rule.predecessor.symbol, shown)
    return found
