"""Scenes as SVG text: the form of lesson pictures, because it scales, prints, and carries its own description.

Coordinates are whole tenths of a pixel, so that the text of a picture is the same on every machine.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import NDArray

from lsys_kit.geometry.scene import CIRCLE, OWN, Discs, Floats, Integers, Polygons, Scene, Segments
from lsys_kit.pictures.style.palette import CHOSEN, GREEN, MARK_EDGE, PAPER, tinted

WIDTH, HEIGHT = 600, 400
"""The size of the largest picture, in pixels."""
MARGIN = 12
"""White space around a drawing, in pixels."""
STROKES = (2.4, 1.7, 1.3, 1.0)
"""Stroke widths by branch order, in pixels; deeper branches have the last."""


THINNEST, BROADEST = 3, 4_000
"""The least and the greatest width of a stroke that a turtle chooses, in tenths of a pixel."""
SAMPLE = 20_000
"""The median length of strokes is estimated from at most this number of them."""


@dataclass(frozen=True)
class ViewFrame:
    """The transform from the units of a scene to tenths of a pixel."""

    scale: float
    left: float
    top: float
    width: int
    height: int

    def points(self, coordinates: Floats) -> Integers:
        """Tenths of a pixel for x and y in turn along the last axis; halves are always rounded the same way."""
        flip = np.tile([1.0, -1.0], coordinates.shape[-1] // 2)
        shift = np.tile([-self.left, self.top], coordinates.shape[-1] // 2)
        pixels = (coordinates * flip + shift) * self.scale + MARGIN
        tenths: Integers = np.floor(pixels * 10 + 0.5001).astype(np.int64)
        return tenths


def frame_of(box: tuple[float, float, float, float], width: float = WIDTH, height: float = HEIGHT) -> ViewFrame:
    """The frame that fits a box into a picture, no larger than needed."""
    left, bottom, right, top = box
    across, up = max(right - left, 1e-9), max(top - bottom, 1e-9)
    scale = min((width - 2 * MARGIN) / across, (height - 2 * MARGIN) / up, 120.0)
    return ViewFrame(scale, left, top, round((right - left) * scale) + 2 * MARGIN, round((top - bottom) * scale) + 2 * MARGIN)


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


def groups(segments: Segments, scale: float, colour_of: Mapping[int, str]) -> Iterator[tuple[str, int, NDArray[np.bool_]]]:
    """Groups of strokes with the same look: colour, width in tenths of a pixel, and a mask of the strokes; broad ones first.

    A width that the turtle has set is scaled with the drawing; other widths depend on the branch order.
    """
    thin = stroke_scale(segments, scale)
    by_order = np.array([round(10 * width * thin) for width in STROKES])
    widths = by_order[np.minimum(segments.orders, len(STROKES) - 1)]
    if (segments.widths != OWN).any():
        given = np.clip(np.rint(segments.widths * scale * 10), THINNEST, BROADEST).astype(np.int64)
        widths = np.where(segments.widths == OWN, widths, given)
    names, numbers = numbered_colours(segments.states, segments.colours, colour_of)
    both = numbers * (BROADEST + 1) + (BROADEST - widths)
    for key in np.flatnonzero(np.bincount(both)).tolist():
        yield names[key // (BROADEST + 1)], BROADEST - key % (BROADEST + 1), both == key


def numbered_colours(states: Integers, colours: Integers, colour_of: Mapping[int, str]) -> tuple[list[str], Integers]:
    """The colours in use, and for each shape the number of its own: that of its symbol, or the one that the turtle chose."""
    names = list(dict.fromkeys((*colour_of.values(), GREEN, *CHOSEN)))
    of_state = np.full(int(states.max(initial=0)) + 1, names.index(GREEN))
    for state, colour in colour_of.items():
        if state < len(of_state):
            of_state[state] = names.index(colour)
    chosen = np.array([names.index(colour) for colour in CHOSEN])
    return names, np.where(colours == OWN, of_state[states], chosen[colours % len(CHOSEN)])


def shape_colours(shapes: Polygons | Discs, colour_of: Mapping[int, str]) -> list[str]:
    """The colour of each shape."""
    names, numbers = numbered_colours(shapes.states, shapes.colours, colour_of)
    return [names[number] for number in numbers.tolist()]


def stroke_scale(segments: Segments, scale: float) -> float:
    """The factor by which dense strokes are thinned: 1 for a median length of 12 pixels or more, at least 0.3."""
    if not len(segments):
        return 1.0
    some = segments.ends[::len(segments) // SAMPLE + 1]
    lengths = np.hypot(some[:, 2] - some[:, 0], some[:, 3] - some[:, 1])
    return float(min(1.0, max(0.3, np.median(lengths) * scale / 12)))


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
