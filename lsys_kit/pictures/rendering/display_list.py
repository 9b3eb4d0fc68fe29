"""The shapes of which a turtle's drawing is painted, in painter's order: what comes later covers what came before.

In the plane that is by kinds of shapes, in space from far to near. There strokes are tapered cylinders in three tones with a
pale casing where they cross farther ones, surfaces are shaded by their normals, and what is far is paler. All formats are
painted from the list, and so is the canvas in the browser, whose scripts make the same one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.geometry.scene import CIRCLE, SPHERE, Floats, Integers, Scene, Segments
from lsys_kit.pictures.rendering.looks import BOLDEST, BROADEST, STURDY, numbered_colours, stroke_scale, stroke_widths, thinnest
from lsys_kit.pictures.rendering.view import MOST_CYLINDERS, ProjectedScene, far_to_near
from lsys_kit.pictures.style.lighting import BRIGHT, DIM, EDGE, LIGHT, OWN, brightness, paper_number, shade_numbers, shades
from lsys_kit.pictures.style.palette import tinted
from lsys_kit.pictures.style.themes import line, theme

if TYPE_CHECKING:
    from numpy.typing import NDArray

NO_COLOUR = -1
"""Stands for the colour inside a shape or of its edge where there is none."""


class Lines(NamedTuple):
    """Straight lines with round ends: shape (n, 4), their ends; (n,), the widths in tenths of a pixel, the numbers of their
    colours, and the states of the modules that drew them."""

    ends: Floats
    widths: Integers
    colours: Integers
    states: Integers


class Areas(NamedTuple):
    """Polygons: their corners and starts as in `Polygons`, the numbers of the colours inside and of their edges."""

    points: Floats
    starts: Integers
    fills: Integers
    edges: Integers


class Rounds(NamedTuple):
    """Discs: shape (n, 2), their centres; (n,), the radii, the numbers of the colours inside and of the edges, and whether they
    are spheres, which are lighter towards the light and darker away from it."""

    centres: Floats
    radii: Floats
    fills: Integers
    edges: Integers
    spheres: NDArray[np.bool_]


class LineRun(NamedTuple):
    """Lines of one colour and width, in tenths of a pixel, by their numbers."""

    numbers: Integers
    colour: str
    width: int


class AreaRun(NamedTuple):
    """Polygons, by their numbers."""

    numbers: Integers


class RoundRun(NamedTuple):
    """Discs, by their numbers."""

    numbers: Integers


Run: TypeAlias = LineRun | AreaRun | RoundRun
"""Shapes that are painted one after another."""
AREA, ROUND = -2, -1
"""The keys of runs that are not of lines, whose keys are not negative."""


@dataclass(frozen=True)
class DisplayList:
    """Shapes in the order in which they are painted, as runs of shapes that look alike.

    In space there may be as many runs as strokes: whoever paints many of them takes the arrays.

    Attributes
    ----------
    lines, areas, rounds
        The shapes, in the units of the plane of the picture.
    palette
        The colours, by their numbers.
    numbers
        Shape (n,): the shapes in their order, each by its number among those of its kind.
    starts
        Shape (m + 1,): the index in `numbers` of the first shape of each run; the last is n.
    keys
        Shape (m,): for each run of lines the key of its looks; `AREA` for polygons, `ROUND` for discs.
    """

    lines: Lines
    areas: Areas
    rounds: Rounds
    palette: Sequence[str]
    numbers: Integers
    starts: Integers
    keys: Integers

    def __iter__(self) -> Iterator[Run]:
        """The runs, one after another."""
        colours, widths = colours_and_widths(self.keys)
        for (start, stop), key, colour, width in zip(
            pairwise(self.starts.tolist()), self.keys.tolist(), colours.tolist(), widths.tolist(), strict=True
        ):
            numbers = self.numbers[start:stop]
            if key >= 0:
                yield LineRun(numbers, self.palette[colour], width)
            else:
                yield AreaRun(numbers) if key == AREA else RoundRun(numbers)


def keys_of(lines: Lines) -> Integers:
    """For each line a number that stands for its colour and its width; keys grow as broad lines get thinner."""
    return lines.colours * (BROADEST + 1) + (BROADEST - lines.widths)


def colours_and_widths(keys: Integers) -> tuple[Integers, Integers]:
    """The numbers of the colours that keys stand for, and the widths in tenths of a pixel."""
    return keys // (BROADEST + 1), BROADEST - keys % (BROADEST + 1)


def in_order(lines: Lines, areas: Areas, rounds: Rounds, palette: Sequence[str], order: Integers) -> DisplayList:
    """Shapes in an order, in which lines are counted first, then areas, then rounds; as long as they look alike in one run."""
    counts = [len(lines.widths), len(areas.fills), len(rounds.radii)]
    keys = np.concatenate([keys_of(lines), np.full(counts[1], AREA), np.full(counts[2], ROUND)])[order]
    numbers = order - np.repeat([0, counts[0], counts[0] + counts[1]], counts)[order]
    starts = np.flatnonzero(np.diff(keys, prepend=AREA - 1))
    return DisplayList(lines, areas, rounds, palette, numbers, np.append(starts, len(order)), keys[starts])


# --- strokes in space, as cylinders ---

TONED = 16
"""From this width on, in tenths of a pixel, stripes can be seen."""
TAPERED = 0.06
"""From this difference of the widths at both ends on, relative to their mean, a stroke is seen to be tapered."""
LIT, DARK, RIM = map(math.radians, (32, 68, 84))
"""Angles of the normal: how far the light stripe reaches from the brightest line to both sides, how far from it the dark one
begins, and where the light one ends at the latest, before the rim."""
PIECES = 6
"""The straight pieces of a round end."""


class Cylinders(NamedTuple):
    """Strokes as they are seen: shape (n, 2, 2), their ends; (n, 2), the radii there, in units of the plane, and unit vectors
    along them and to their left."""

    ends: Floats
    radii: Floats
    along: Floats
    left: Floats

    @property
    def tapered(self) -> NDArray[np.bool_]:
        """Which are seen to be broader at one end."""
        differences = np.abs(self.radii[:, 0] - self.radii[:, 1])
        tapered: NDArray[np.bool_] = differences > TAPERED * self.radii.mean(axis=1)
        return tapered

    def some(self, which: NDArray[np.bool_]) -> Cylinders:
        """Some of them."""
        return Cylinders(*(column[which] for column in self))


def seen_widths(scene: ProjectedScene, widths: Integers) -> Integers:
    """The mean widths at which strokes are seen, in tenths of a pixel, given those at which nothing magnifies them."""
    seen = widths * ((scene.factors[:, 0] + scene.factors[:, 1]) / 2)
    return np.clip(np.rint(seen), thinnest(), BROADEST).astype(np.int64)


def cylinders_of(scene: ProjectedScene, widths: Integers, unit: float, which: NDArray[np.bool_]) -> Cylinders:
    """Some of the strokes of a scene, given all widths where nothing magnifies them, and how many of these make a unit."""
    ends, radii = scene.segments.ends[which].reshape(-1, 2, 2), widths[which, None] * scene.factors[which] / (2 * unit)
    ways = ends[:, 1] - ends[:, 0]
    lengths = np.hypot(ways[:, 0], ways[:, 1])[:, None]
    along = np.where(lengths > 0, ways / np.where(lengths > 0, lengths, 1.0), (0.0, 1.0))
    return Cylinders(ends, radii, along, np.stack([-along[:, 1], along[:, 0]], axis=1))


def capsules(cylinders: Cylinders) -> Floats:
    """The outlines of cylinders with round ends, shape (n, 2 * PIECES + 2, 2)."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, PIECES + 1)[None, :, None]
    caps = []
    for end, way in ((1, 1), (0, -1)):
        arc = way * (np.cos(angles) * cylinders.along[:, None] + np.sin(angles) * cylinders.left[:, None])
        caps.append(cylinders.ends[:, end, None] + cylinders.radii[:, end, None, None] * arc)
    return np.concatenate(caps, axis=1)


def stripes(cylinders: Cylinders) -> tuple[Floats, Floats]:
    """The corners of the light and of the dark stripes, each of shape (n, 6, 2)."""
    aside = cylinders.left @ LIGHT[:2]
    brightest = np.arctan2(aside, LIGHT[2])
    away = np.where(aside < 0, 1.0, -1.0)  # to which side it grows dark
    light = _stripe(cylinders, np.maximum(brightest - LIT, -RIM), np.minimum(brightest + LIT, RIM))
    return light, _stripe(cylinders, brightest + away * DARK, away * np.pi / 2)


def _stripe(cylinders: Cylinders, first: Floats, last: Floats) -> Floats:
    """The corners of stripes between two angles of the normal, up to the round ends, which they follow."""
    corners, middle = [], (first + last) / 2
    for end, angle in ((0, middle), (0, first), (1, first), (1, middle), (1, last), (0, last)):
        way = np.sin(angle)[:, None] * cylinders.left + (2 * end - 1) * np.cos(angle)[:, None] * cylinders.along
        corners.append(cylinders.ends[:, end] + cylinders.radii[:, end, None] * way)
    return np.stack(corners, axis=1)


# --- in painter's order ---

FILLED = 0.7
"""The strength of the colour inside a surface in the plane."""
LEAST_CASING, CASING, BROADEST_CASING = 4, 0.4, 10
"""How much broader than a stroke its casing is: so many tenths of a pixel and this part of its width; and at most."""


def display_list(scene: Scene, scale: float, colour_of: Mapping[int, str]) -> DisplayList:
    """The shapes of a scene in the order in which they are painted: what comes later covers what came before.

    Parameters
    ----------
    scene
        A scene in the plane, or one in space as it is seen from one side.
    scale
        The pixels of a unit of length.
    colour_of
        For each state its colour.

    Examples
    --------
    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.pictures.rendering.view import FRONT, project
    >>> scene = scene_of(derive(read("axiom: F@o(1)!(3)F{f+f+f}"), 0))
    >>> [(type(run).__name__, run.numbers.tolist()) for run in display_list(scene, 1, {})]
    [('AreaRun', [0]), ('LineRun', [1]), ('LineRun', [0]), ('RoundRun', [0])]
    >>> [scene] = project([scene_of(derive(read("axiom: [^(90)f@O(1)][&(90)f@O(2)]"), 0))], FRONT)
    >>> [run.numbers.tolist() for run in display_list(scene, 1, {})]  # the first is nearer
    [[1, 0]]
    """
    return _in_space(scene, scale, colour_of) if isinstance(scene, ProjectedScene) else _in_the_plane(scene, scale, colour_of)


def _in_the_plane(scene: Scene, scale: float, colour_of: Mapping[int, str]) -> DisplayList:
    """First polygons, then strokes, by colours and of one colour the broad ones first, then circles, discs and spheres."""
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    names, colours = numbered_colours(segments.states, segments.colours, colour_of)
    of_polygons, of_discs = (numbered_colours(each.states, each.colours, colour_of)[1] for each in (polygons, discs))
    widths = stroke_widths(segments, scale, stroke_scale(segments, scale))
    lines, paper = Lines(segments.ends, widths, colours, segments.states), 2 * len(names)
    keys = keys_of(lines)
    runs = {
        AREA: np.arange(len(polygons)),
        **{key: np.flatnonzero(keys == key) for key in np.flatnonzero(np.bincount(keys)).tolist()},
        ROUND: np.arange(len(discs)),
    }
    return DisplayList(
        lines,
        Areas(polygons.points, polygons.starts, of_polygons + len(names), of_polygons),
        Rounds(
            discs.centres,
            discs.radii,
            np.where(discs.kinds == CIRCLE, paper, of_discs + len(names)),
            of_discs,
            np.zeros(len(discs), bool),
        ),
        [*map(line, names), *(tinted(name, FILLED) for name in names), theme().ground],
        np.concatenate([*runs.values()]),
        np.cumsum([0, *map(len, runs.values())]),
        np.array([*runs]),
    )


def _in_space(scene: ProjectedScene, scale: float, colour_of: Mapping[int, str]) -> DisplayList:
    """From far to near; of very many strokes one sees none by itself, and they are plain lines."""
    segments, detailed = scene.segments, len(scene.segments) <= MOST_CYLINDERS
    names, colours = _colours(scene, colour_of)
    plain = stroke_widths(segments, scale, boldness(segments, scale, detailed))
    widths = seen_widths(scene, plain)
    toned = (widths >= TONED) & detailed
    cylinders = cylinders_of(scene, plain, 10 * scale, toned)
    lines = np.ones(len(segments), bool)
    lines[toned] = ~cylinders.tapered
    casings, faces, strokes, discs = _first_slots(scene, toned)
    own = shade_numbers(colours, scene.nearness, OWN)
    bodies = own[len(faces) : len(faces) + len(strokes)]
    areas = [
        _faces(scene, colours),
        _polygons(capsules(cylinders.some(cylinders.tapered)), bodies[~lines]),
        *_stripes(cylinders, bodies[toned]),
    ]
    stripes_of = strokes[toned]
    slots = [casings, strokes[lines], faces, strokes[~lines], stripes_of + 1, stripes_of + 2, discs]
    return _with_few_colours(
        _lines(segments, widths, bodies, lines, len(casings), paper_number(names)),
        _joined(areas),
        _rounds(scene, own),
        names,
        _inverse(np.concatenate(slots)),
    )


def _lines(segments: Segments, widths: Integers, colours: Integers, chosen: NDArray[np.bool_], cased: int, paper: int) -> Lines:
    if chosen.all() and not cased:
        return Lines(segments.ends, widths, colours, segments.states)
    return Lines(
        np.concatenate([segments.ends[:cased], segments.ends[chosen]]),
        np.concatenate([np.minimum(casing_widths(widths[:cased]), BROADEST), widths[chosen]]),
        np.concatenate([np.full(cased, paper), colours[chosen]]),
        np.concatenate([segments.states[:cased], segments.states[chosen]]),
    )


def casing_widths(widths: Integers) -> Integers:
    """The widths of the casings of strokes, in tenths of a pixel.

    >>> casing_widths(np.array([10, 24, 100])).tolist()
    [18, 34, 110]
    """
    more = np.minimum(LEAST_CASING + np.rint(CASING * widths).astype(np.int64), BROADEST_CASING)
    found: Integers = widths + more
    return found


def boldness(segments: Segments, scale: float, detailed: bool) -> float:
    """How broad strokes are whose widths the turtle has not set: where one sees each by itself, they look like stems."""
    return max(stroke_scale(segments, scale, BOLDEST), STURDY) if detailed else stroke_scale(segments, scale)


def _colours(scene: ProjectedScene, colour_of: Mapping[int, str]) -> tuple[list[str], Integers]:
    """The colours in use, and those of polygons, strokes and discs, by their numbers."""
    kinds = (scene.polygons, scene.segments, scene.discs)
    found = [numbered_colours(each.states, np.broadcast_to(each.colours, len(each)), colour_of) for each in kinds]
    return [*map(line, found[0][0])], np.concatenate([numbers for _, numbers in found])


def _first_slots(scene: ProjectedScene, toned: NDArray[np.bool_]) -> Sequence[Integers]:
    """Where casings, polygons, strokes and discs stand in the display list; behind a stroke with stripes there are two more.

    A casing is painted as if it were farther than its stroke by the length of that: it hides what crosses the stroke behind it,
    and not what the stroke is joined to.
    """
    polygons, strokes, discs = len(scene.polygons), len(scene.segments), len(scene.discs)
    casings = np.maximum(scene.casing_depths, scene.depths.min(initial=np.inf))
    order = far_to_near(np.concatenate([casings, scene.depths]), scene.extent)
    counts = np.ones(len(order), np.int64)
    counts[len(casings) + polygons : len(counts) - discs] += 2 * toned
    first = np.empty(len(order), np.int64)
    first[order] = np.cumsum(counts[order]) - counts[order]
    return np.split(first, np.cumsum([len(casings), polygons, strokes]))


def _inverse(slots: Integers) -> Integers:
    order = np.empty(len(slots), np.int64)
    order[slots] = np.arange(len(slots))
    return order


def _faces(scene: ProjectedScene, colours: Integers) -> Areas:
    """Polygons, as bright as they face the light, with darker edges; there are none between the faces of a curved surface."""
    many, bright = len(scene.polygons), brightness(scene.normals)
    inside, edges = (
        shade_numbers(colours[:many], scene.nearness[:many], bright + more)
        for more in (0, np.where(scene.polygons.smooth, 0, EDGE))
    )
    return Areas(scene.polygons.points, scene.polygons.starts, inside, edges)


def _stripes(cylinders: Cylinders, bodies: Integers) -> Sequence[Areas]:
    light, dark = stripes(cylinders)
    return [_polygons(light, bodies + BRIGHT - OWN), _polygons(dark, bodies + DIM - OWN)]


def _polygons(corners: Floats, fills: Integers) -> Areas:
    many, each = corners.shape[:2]
    return Areas(corners.reshape(-1, 2), np.arange(many + 1) * each, fills, np.full(many, NO_COLOUR))


def _joined(areas: Sequence[Areas]) -> Areas:
    sizes = np.concatenate([np.diff(some.starts) for some in areas])
    points, _, fills, edges = (np.concatenate(column) for column in zip(*areas, strict=True))
    return Areas(points, np.cumsum([0, *sizes]), fills, edges)


def _rounds(scene: ProjectedScene, own: Integers) -> Rounds:
    """Circles, which are empty, discs and spheres."""
    discs = scene.discs
    colours = own[len(own) - len(discs) :]
    return Rounds(
        discs.centres,
        discs.radii,
        np.where(discs.kinds == CIRCLE, NO_COLOUR, colours),
        np.where(discs.kinds == SPHERE, NO_COLOUR, colours + EDGE),
        discs.kinds == SPHERE,
    )


def _with_few_colours(lines: Lines, areas: Areas, rounds: Rounds, names: Sequence[str], order: Integers) -> DisplayList:
    used = np.unique(
        np.concatenate(
            [
                np.flatnonzero(np.bincount(lines.colours)),
                areas.fills,
                areas.edges,
                rounds.fills,
                rounds.edges,
                [paper_number(names)],
            ]
        )
    )
    used = used[used != NO_COLOUR]
    number = np.full(paper_number(names) + 2, NO_COLOUR)  # which the last stands for
    number[used] = np.arange(len(used))
    return in_order(
        lines._replace(colours=number[lines.colours]),
        areas._replace(fills=number[areas.fills], edges=number[areas.edges]),
        rounds._replace(fills=number[rounds.fills], edges=number[rounds.edges]),
        shades(names, used.tolist()),
        order,
    )
