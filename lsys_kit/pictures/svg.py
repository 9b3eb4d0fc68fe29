"""Scenes as SVG text: the form of lesson pictures, because it scales, prints, and carries its own description.

Coordinates are whole tenths of a pixel, so that the text of a picture is the same on every machine.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import NDArray

from lsys_kit.geometry.scene import CIRCLE, OWN, Cells, Discs, Floats, Integers, Polygons, Scene, Segments
from lsys_kit.pictures.palette import CHOSEN, GREEN, INK, MARK, MARK_EDGE, PAPER, QUIET, tinted

WIDTH, HEIGHT = 600, 400
"""The largest picture, in pixels."""
MARGIN = 12
"""White space around a drawing, in pixels."""
STROKES = (2.4, 1.7, 1.3, 1.0)
"""Stroke widths by branch order, in pixels; deeper branches have the last."""


THINNEST, BROADEST = 3, 4_000
"""The least and the greatest width of a stroke that a turtle chooses, in tenths of a pixel."""
SAMPLE = 20_000
"""Of so many strokes at most the lengths are looked at, to see how close they stand."""


@dataclass(frozen=True)
class Frame:
    """How a scene's units become tenths of a pixel."""

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


def frame_of(box: tuple[float, float, float, float], width: float = WIDTH, height: float = HEIGHT) -> Frame:
    """The frame that fits a box into a picture, no larger than needed."""
    left, bottom, right, top = box
    across, up = max(right - left, 1e-9), max(top - bottom, 1e-9)
    scale = min((width - 2 * MARGIN) / across, (height - 2 * MARGIN) / up, 120.0)
    return Frame(scale, left, top, round((right - left) * scale) + 2 * MARGIN, round((top - bottom) * scale) + 2 * MARGIN)


def document(body: str, width: int, height: int, description: str) -> str:
    """A whole SVG picture with its text alternative."""
    words = escape(description, quote=True)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width * 10} {height * 10}" width="{width}" '
            f'height="{height}" role="img" aria-label="{words}" style="max-width:100%;height:auto">'
            f"<title>{words}</title>{body}</svg>")


def turtle_svg(scene: Scene, frame: Frame, colour_of: Mapping[int, str], marked: Collection[int] = ()) -> str:
    """What a turtle has drawn: surfaces, then strokes, then discs."""
    parts = (polygons_svg(scene.polygons, frame, colour_of) if len(scene.polygons) else "",
             strokes_svg(scene.segments, frame, colour_of, marked),
             discs_svg(scene.discs, frame, colour_of) if len(scene.discs) else "")
    return "".join(parts)


def polygons_svg(polygons: Polygons, frame: Frame, colour_of: Mapping[int, str]) -> str:
    """Surfaces: filled, with an edge of their own colour."""
    shapes = []
    for corners, colour in zip(polygons, shape_colours(polygons, colour_of), strict=True):
        points = " ".join(map("{},{}".format, *frame.points(corners).T.tolist()))
        shapes.append(f'<polygon points="{points}" fill="{tinted(colour, 0.7)}" stroke="{colour}"/>')
    return f'<g stroke-width="6" stroke-linejoin="round">{"".join(shapes)}</g>'


def discs_svg(discs: Discs, frame: Frame, colour_of: Mapping[int, str]) -> str:
    """Circles, and discs and spheres, which are filled."""
    shapes = []
    for (x, y), radius, kind, colour in zip(frame.points(discs.centres).tolist(), discs.radii.tolist(), discs.kinds.tolist(),
                                            shape_colours(discs, colour_of), strict=True):
        fill = PAPER if kind == CIRCLE else tinted(colour, 0.7)
        reach = max(8, round(radius * frame.scale * 10))
        shapes.append(f'<circle cx="{x}" cy="{y}" r="{reach}" fill="{fill}" stroke="{colour}"/>')
    return f'<g stroke-width="10">{"".join(shapes)}</g>'


def strokes_svg(segments: Segments, frame: Frame, colour_of: Mapping[int, str], marked: Collection[int] = ()) -> str:
    """The strokes of a turtle: a path for each colour and width, marked ones on a broad band."""
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
    """The strokes that are drawn alike: their colour, their width in tenths of a pixel, and which they are; broad ones first.

    A width that the turtle has set is one of the drawing; else it goes with the branch order, deep ones alike.
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
    """How much thinner strokes are drawn where they stand close: 1 for strokes of 12 pixels or more, never below 0.3."""
    if not len(segments):
        return 1.0
    some = segments.ends[::len(segments) // SAMPLE + 1]
    lengths = np.hypot(some[:, 2] - some[:, 0], some[:, 3] - some[:, 1])
    return float(min(1.0, max(0.3, np.median(lengths) * scale / 12)))


def _path(points: Integers) -> str:
    return "M%d %dL%d %d" * len(points) % tuple(points.ravel().tolist())


@dataclass(frozen=True)
class Row:
    """One step of a developmental sequence."""

    step: int
    scene: Scene


def rows_svg(rows: Sequence[Row], colour_of: Mapping[int, str], current: int | None = None,
             marked: Collection[int] = ()) -> tuple[str, int, int]:
    """Filaments below one another, centred, with a common scale; the current row on a tinted band.

    Returns
    -------
    tuple
        The body of the picture, its width and its height in pixels.
    """
    gutter = 34
    longest = max(row.scene.width for row in rows)
    tallest = max(row.scene.height for row in rows)
    pitch_most = min(46.0, (HEIGHT - 2 * MARGIN) / len(rows))
    scale = min((WIDTH - gutter - 2 * MARGIN) / max(longest, 1e-9), 0.78 * pitch_most / max(tallest, 1e-9))
    pitch = max(14.0, min(pitch_most, tallest * scale / 0.72))
    width = WIDTH
    body = []
    for place, row in enumerate(rows):
        middle = round((MARGIN + pitch * (place + 0.5)) * 10)
        if row.step == current:
            body.append(f'<rect x="20" y="{middle - round(pitch * 5)}" width="{width * 10 - 40}" height="{round(pitch * 10)}" '
                        f'rx="40" fill="{MARK}"/>')
        weight = ' font-weight="bold"' if row.step == current else ""
        body.append(f'<text x="{gutter * 10 - 60}" y="{middle + 45}" font-size="150" text-anchor="end" '
                    f'font-family="sans-serif" fill="{INK if weight else QUIET}"{weight}>{row.step}</text>')
        left = round((gutter + (width - gutter) / 2 - row.scene.width * scale / 2) * 10)
        body.append(cells_svg(row.scene.cells, scale * 10, left, middle, colour_of, marked))
    return "".join(body), width, round(pitch * len(rows)) + 2 * MARGIN


def cells_svg(cells: Cells, scale: float, left: int, middle: int, colour_of: Mapping[int, str],
              marked: Collection[int] = ()) -> str:
    """One filament: ellipses, lighter when young, with arrows for their polarity."""
    centres = np.floor(cells.centres[:, 0] * scale + left + 0.5001).astype(int).tolist()
    radii = np.floor(cells.sizes * scale / 2 + 0.5001).astype(int).tolist()
    shades, states = cells.shades.tolist(), cells.states.tolist()
    fills = {key: tinted(colour_of.get(key[0], GREEN), 0.28 + 0.6 * key[1]) for key in set(zip(states, shades, strict=True))}
    shapes = []
    for x, (rx, ry), shade, state in zip(centres, radii, shades, states, strict=True):
        edge = f'{MARK_EDGE}" stroke-width="32' if state in marked else colour_of.get(state, GREEN)
        shapes.append(f'<ellipse cx="{x}" cy="{middle}" rx="{rx}" ry="{ry}" fill="{fills[state, shade]}" stroke="{edge}"/>')
    arrows = "".join(_arrow(x, middle, rx, ry, way)
                     for x, (rx, ry), way in zip(centres, radii, cells.polarities.tolist(), strict=True) if rx > 25 and way)
    return (f'<g stroke-width="10">{"".join(shapes)}</g>'
            f'<path d="{arrows}" fill="none" stroke="{INK}" stroke-width="9" stroke-linecap="round" stroke-linejoin="round"/>')


def _arrow(x: int, y: int, rx: int, ry: int, way: int) -> str:
    reach, head = round(0.58 * rx), max(12, round(0.32 * min(rx, ry)))
    tip = x + way * reach
    return f"M{x - way * reach} {y}H{tip}M{tip - way * head} {y - head}L{tip} {y}L{tip - way * head} {y + head}"


def background(width: int, height: int) -> str:
    """White paper, so that a picture can be read on a dark page too."""
    return f'<rect width="{width * 10}" height="{height * 10}" fill="{PAPER}"/>'


def described(parts: Iterable[str]) -> str:
    """Parts of a description, joined as a sentence."""
    return "; ".join(part for part in parts if part)
