"""What a picture of a turtle's drawing consists of, from far to near, before it is written in any format.

Every format paints the shapes of a scene in the same order, and so does the canvas in the browser.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lsys_kit.geometry.scene import OWN, Discs, Floats, Integers, Polygons, Segments
from lsys_kit.pictures.style.palette import CHOSEN, GREEN

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
