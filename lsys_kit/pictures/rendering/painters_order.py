"""The display list of a scene, in painter's order: in the plane by kinds of shapes, in space from far to near.

In space strokes are tapered cylinders in three tones with a pale casing where they cross farther ones, surfaces are shaded by
their normals, and what is far is paler.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from lsys_kit.geometry.scene import CIRCLE, SPHERE, Floats, Integers, Scene, Segments
from lsys_kit.pictures.rendering.cylinders import TONED, Cylinders, capsules, cylinders_of, seen_widths, stripes
from lsys_kit.pictures.rendering.display_list import (
    AREA,
    NO_COLOUR,
    ROUND,
    Areas,
    DisplayList,
    Lines,
    Rounds,
    in_order,
    keys_of,
)
from lsys_kit.pictures.rendering.looks import BOLDEST, BROADEST, STURDY, numbered_colours, stroke_scale, stroke_widths
from lsys_kit.pictures.rendering.view import MOST_CYLINDERS, ProjectedScene, far_to_near
from lsys_kit.pictures.style.lighting import BRIGHT, DIM, EDGE, OWN, brightness, paper_number, shade_numbers, shades
from lsys_kit.pictures.style.palette import tinted
from lsys_kit.pictures.style.themes import line, theme

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
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.notation.read import read
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
    plain = stroke_widths(segments, scale, _boldness(segments, scale, detailed))
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
    """The casings of the first strokes, then some strokes."""
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


def _boldness(segments: Segments, scale: float, detailed: bool) -> float:
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
    """What stands in each slot."""
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
    """The light and the dark stripes of cylinders."""
    light, dark = stripes(cylinders)
    return [_polygons(light, bodies + BRIGHT - OWN), _polygons(dark, bodies + DIM - OWN)]


def _polygons(corners: Floats, fills: Integers) -> Areas:
    """Polygons without edges, with as many corners each."""
    many, each = corners.shape[:2]
    return Areas(corners.reshape(-1, 2), np.arange(many + 1) * each, fills, np.full(many, NO_COLOUR))


def _joined(areas: Sequence[Areas]) -> Areas:
    """Polygons one after another."""
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
    """The display list with a palette of the shades that occur."""
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
