"""Scenes as SVG text: the form of lesson pictures, because it scales, prints, and carries its own description.

Coordinates are whole tenths of a pixel, so that the text of a picture is the same on every machine.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from itertools import groupby

import numpy as np

from lsys_kit.geometry.scene import CIRCLE, Discs, Integers, Polygons, Scene, Segments
from lsys_kit.pictures.display_list import Faces, Strokes, ViewFrame, display_list, shape_colours, stroke_scale
from lsys_kit.pictures.style.palette import MARK_EDGE, PAPER, tinted


def document(body: str, width: int, height: int, description: str) -> str:
    """A whole SVG picture with its text alternative."""
    words = escape(description, quote=True)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width * 10} {height * 10}" width="{width}" '
            f'height="{height}" role="img" aria-label="{words}" style="max-width:100%;height:auto">'
            f"<title>{words}</title>{body}</svg>")


def turtle_svg(scene: Scene, frame: ViewFrame, colour_of: Mapping[int, str], marked: Collection[int] = ()) -> str:
    """A scene of a turtle as SVG, in the order in which it is painted."""
    faces, rounds = _polygons(scene.polygons, frame, colour_of), _discs(scene.discs, frame, colour_of)
    points, parts = frame.points(scene.segments.ends), []
    for kind, runs in groupby(display_list(scene, frame.scale, colour_of), type):
        if kind is Strokes:
            parts.append(_strokes_svg(scene.segments, points, [run for run in runs if isinstance(run, Strokes)], frame, marked))
        else:
            shapes, look = (faces, _FACES) if kind is Faces else (rounds, _ROUNDS)
            body = "".join(shapes[number] for run in runs for number in run.numbers.tolist())
            parts.append(f"<g {look}>{body}</g>" if body else "")
    return "".join(parts)


_FACES, _ROUNDS = 'stroke-width="6" stroke-linejoin="round"', 'stroke-width="10"'


def _polygons(polygons: Polygons, frame: ViewFrame, colour_of: Mapping[int, str]) -> list[str]:
    """Surfaces, filled, with an outline of the same colour."""
    shapes = []
    for corners, colour in zip(polygons, shape_colours(polygons, colour_of), strict=True):
        points = " ".join(map("{},{}".format, *frame.points(corners).T.tolist()))
        shapes.append(f'<polygon points="{points}" fill="{tinted(colour, 0.7)}" stroke="{colour}"/>')
    return shapes


def _discs(discs: Discs, frame: ViewFrame, colour_of: Mapping[int, str]) -> list[str]:
    """Circles, and discs and spheres, which are filled."""
    shapes = []
    for (x, y), radius, kind, colour in zip(frame.points(discs.centres).tolist(), discs.radii.tolist(), discs.kinds.tolist(),
                                            shape_colours(discs, colour_of), strict=True):
        fill = PAPER if kind == CIRCLE else tinted(colour, 0.7)
        reach = max(8, round(radius * frame.scale * 10))
        shapes.append(f'<circle cx="{x}" cy="{y}" r="{reach}" fill="{fill}" stroke="{colour}"/>')
    return shapes


def _strokes_svg(segments: Segments, points: Integers, runs: Sequence[Strokes], frame: ViewFrame,
                 marked: Collection[int]) -> str:
    """Strokes that nothing lies between: a path for each colour and width; marked strokes lie on a broad band."""
    body = []
    if marked:
        numbers = np.concatenate([run.numbers for run in runs])
        chosen = points[numbers[np.isin(segments.states[numbers], list(marked))]]
        broad = max(50, 90 * stroke_scale(segments, frame.scale))
        body += [f'<path class="marked" d="{_path(chosen)}" stroke="{MARK_EDGE}" stroke-width="{broad:.0f}" '
                 'stroke-opacity="0.45"/>'] * bool(len(chosen))
    for run in runs:
        body.append(f'<path d="{_path(points[run.numbers])}" stroke="{run.colour}" stroke-width="{run.width}"/>')
    return f'<g fill="none" stroke-linecap="round">{"".join(body)}</g>'


def _path(points: Integers) -> str:
    return "M%d %dL%d %d" * len(points) % tuple(points.ravel().tolist())


@dataclass(frozen=True)
class FilamentRow:
    """One step of a developmental sequence."""

    step: int
    scene: Scene


def background(width: int, height: int) -> str:
    """White paper, so that a picture can be read on a dark page too."""
    return f'<rect width="{width * 10}" height="{height * 10}" fill="{PAPER}"/>'


def described(parts: Iterable[str]) -> str:
    """Parts of a description, joined as a sentence."""
    return "; ".join(part for part in parts if part)
