"""Scenes as SVG text: the form of lesson pictures, because it scales, prints, and carries its own description.

Coordinates are whole tenths of a pixel, so that the text of a picture is the same on every machine.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from html import escape

import numpy as np

from lsys_kit.geometry.scene import CIRCLE, Discs, Integers, Polygons, Scene, Segments
from lsys_kit.pictures.display_list import ViewFrame, groups, shape_colours, stroke_scale
from lsys_kit.pictures.style.palette import MARK_EDGE, PAPER, tinted


def document(body: str, width: int, height: int, description: str) -> str:
    """A whole SVG picture with its text alternative."""
    words = escape(description, quote=True)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width * 10} {height * 10}" width="{width}" '
            f'height="{height}" role="img" aria-label="{words}" style="max-width:100%;height:auto">'
            f"<title>{words}</title>{body}</svg>")


def turtle_svg(scene: Scene, frame: ViewFrame, colour_of: Mapping[int, str], marked: Collection[int] = ()) -> str:
    """A scene of a turtle as SVG: surfaces, then strokes, then discs."""
    parts = (polygons_svg(scene.polygons, frame, colour_of) if len(scene.polygons) else "",
             strokes_svg(scene.segments, frame, colour_of, marked),
             discs_svg(scene.discs, frame, colour_of) if len(scene.discs) else "")
    return "".join(parts)


def polygons_svg(polygons: Polygons, frame: ViewFrame, colour_of: Mapping[int, str]) -> str:
    """Surfaces, filled, with an outline of the same colour."""
    shapes = []
    for corners, colour in zip(polygons, shape_colours(polygons, colour_of), strict=True):
        points = " ".join(map("{},{}".format, *frame.points(corners).T.tolist()))
        shapes.append(f'<polygon points="{points}" fill="{tinted(colour, 0.7)}" stroke="{colour}"/>')
    return f'<g stroke-width="6" stroke-linejoin="round">{"".join(shapes)}</g>'


def discs_svg(discs: Discs, frame: ViewFrame, colour_of: Mapping[int, str]) -> str:
    """Circles, and discs and spheres, which are filled."""
    shapes = []
    for (x, y), radius, kind, colour in zip(frame.points(discs.centres).tolist(), discs.radii.tolist(), discs.kinds.tolist(),
                                            shape_colours(discs, colour_of), strict=True):
        fill = PAPER if kind == CIRCLE else tinted(colour, 0.7)
        reach = max(8, round(radius * frame.scale * 10))
        shapes.append(f'<circle cx="{x}" cy="{y}" r="{reach}" fill="{fill}" stroke="{colour}"/>')
    return f'<g stroke-width="10">{"".join(shapes)}</g>'


def strokes_svg(segments: Segments, frame: ViewFrame, colour_of: Mapping[int, str], marked: Collection[int] = ()) -> str:
    """The strokes of a turtle: a path for each colour and width; marked strokes lie on a broad band."""
    points = frame.points(segments.ends)
    body = []
    if marked:
        chosen = points[np.isin(segments.states, list(marked))]
        broad = max(50, 90 * stroke_scale(segments, frame.scale))
        body.append(f'<path class="marked" d="{_path(chosen)}" stroke="{MARK_EDGE}" stroke-width="{broad:.0f}" '
                    'stroke-opacity="0.45"/>')
    for colour, width, ours in groups(segments, frame.scale, colour_of):
        body.append(f'<path d="{_path(points[ours])}" stroke="{colour}" stroke-width="{width}"/>')
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
