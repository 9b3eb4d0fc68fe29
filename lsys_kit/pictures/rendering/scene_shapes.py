"""Scenes as typed shapes, in the order in which they are painted.

Coordinates are whole tenths of a pixel, or hundredths or thousandths where strokes are short.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import groupby

from lsys_kit.arrays import np
from lsys_kit.geometry.scene import Integers, Scene
from lsys_kit.pictures.rendering.display_list import NO_COLOUR, AreaRun, DisplayList, LineRun, Lines, display_list
from lsys_kit.pictures.rendering.frames import LABEL, LABEL_GAP, ViewFrame, label_width
from lsys_kit.pictures.rendering.looks import stroke_scale
from lsys_kit.pictures.shapes import Circle, Gradient, Gradients, Group, Look, Polygon, Shape, Stop, Strokes, Text
from lsys_kit.pictures.style.lighting import HIGHLIGHT, REACH, sphere_tones
from lsys_kit.pictures.style.themes import theme

AREAS, ROUNDS = 0.6, 1.0
"""The widths of the edges of polygons and of discs, in pixels."""
SMALLEST = 0.8
"""The least radius of a disc, in pixels."""


def scene_shapes(scene: Scene, frame: ViewFrame, colour_of: Mapping[int, str], marked: Collection[int] = ()) -> list[Shape]:
    """The shapes of a scene of a turtle, those of some states marked, with its labels."""
    shapes = display_list(scene, frame.scale, colour_of)
    areas, (gradients, rounds) = _areas(shapes, frame), _rounds(shapes, frame)
    broad = max(5, 9 * stroke_scale(scene.segments, frame.scale))
    points, found = frame.points(shapes.lines.ends), list[Shape](gradients)
    for kind, runs in groupby(shapes, type):
        if kind is LineRun:
            lines = [run for run in runs if isinstance(run, LineRun)]
            found.append(_lines(shapes.lines, points, lines, (frame.parts, broad), marked))
        else:
            each, width = (areas, AREAS) if kind is AreaRun else (rounds, ROUNDS)
            body = [each[number] for run in runs for number in run.numbers.tolist()]
            look = Look(stroke_width=round(width * frame.parts), stroke_linejoin="round")
            found += [Group(body, look)] if body else []
    return [*found, *label_shapes(scene, frame)]


def label_shapes(scene: Scene, frame: ViewFrame) -> list[Shape]:
    """The labels of a scene, each to the right of its point, as far as the picture goes."""
    texts = []
    for (x, y), text in zip(frame.points(scene.labels.points).tolist(), scene.labels.texts, strict=True):
        start = min(x + LABEL_GAP * frame.parts, (frame.width + LABEL_GAP - label_width(text)) * frame.parts)
        texts.append(Text(round(start), round(y + 0.36 * LABEL * frame.parts), text))
    look = Look(
        font_size=LABEL * frame.parts,
        font_family="sans-serif",
        fill=theme().ink,
        stroke=theme().paper,
        stroke_width=3 * frame.parts,
        stroke_linejoin="round",
        paint_order="stroke",
    )
    return [Group(texts, look, {"class": "label"})] if texts else []


def _areas(shapes: DisplayList, frame: ViewFrame) -> list[Shape]:
    areas, palette = shapes.areas, shapes.palette
    points, starts = frame.points(areas.points).tolist(), areas.starts.tolist()
    pairs = [*zip(areas.fills.tolist(), areas.edges.tolist(), strict=True)]
    looks = {(fill, edge): _look(palette[fill], palette, edge) for fill, edge in {*pairs}}
    return [Polygon(points[first:last], looks[pair]) for first, last, pair in zip(starts, starts[1:], pairs, strict=False)]


def _look(fill: str | Gradient, palette: Sequence[str], edge: int) -> Look:
    return Look(fill=fill) if edge == NO_COLOUR else Look(fill=fill, stroke=palette[edge])


def _rounds(shapes: DisplayList, frame: ViewFrame) -> tuple[list[Gradients], list[Shape]]:
    """Discs, and spheres with gradients, of which there is one for each of their colours."""
    rounds, palette, found = shapes.rounds, shapes.palette, list[Shape]()
    numbers = np.unique(rounds.fills[rounds.spheres]).tolist()
    gradients = {number: _gradient(palette[number]) for number in numbers}
    for (x, y), radius, fill, edge, sphere in zip(
        frame.points(rounds.centres).tolist(), *(column.tolist() for column in rounds[1:]), strict=True
    ):
        inside = gradients[fill] if sphere else "none" if fill == NO_COLOUR else palette[fill]
        reach = round(max(SMALLEST, radius * frame.scale) * frame.parts)
        found.append(Circle(x, y, reach, _look(inside, palette, edge)))
    return [Gradients([*gradients.values()])] if gradients else [], found


def _gradient(colour: str) -> Gradient:
    """The gradient of spheres of a colour; what has the same name in one page is the same."""
    x, y = 0.5 + HIGHLIGHT[0] / 2, 0.5 - HIGHLIGHT[1] / 2
    stops = tuple(Stop(share, tone) for share, tone in sphere_tones(colour))
    return Gradient(f"lsys-sphere-{colour[1:]}", round(x, 2), round(y, 2), round(REACH / 2, 2), stops)


def _lines(lines: Lines, points: Integers, runs: Sequence[LineRun], look: tuple[int, float], marked: Collection[int]) -> Group:
    """Lines that nothing lies between: strokes for each colour and width; marked ones lie on a broad band.

    The look says how many parts a pixel has, and how many pixels broad the band is.
    """
    return Group([*_lines_of(lines, points, runs, look, marked)], Look(fill="none", stroke_linecap="round"))


def _lines_of(
    lines: Lines, points: Integers, runs: Sequence[LineRun], look: tuple[int, float], marked: Collection[int]
) -> Iterator[Strokes]:
    parts, broad = look
    if marked:
        numbers = np.concatenate([run.numbers for run in runs])
        chosen = points[numbers[np.isin(lines.states[numbers], list(marked))]]
        band = Look(stroke=theme().mark_edge, stroke_width=round(broad * parts), stroke_opacity=0.45)
        yield from [Strokes(chosen, band, {"class": "marked"})] if len(chosen) else []
    for run in runs:
        yield Strokes(points[run.numbers], Look(stroke=run.colour, stroke_width=run.width * parts // 10))
