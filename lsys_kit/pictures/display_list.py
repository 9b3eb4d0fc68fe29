"""What a picture of a turtle's drawing consists of, from far to near, before it is written in any format.

Every format paints the shapes of a scene in the same order, and so does the canvas in the browser.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from lsys_kit.geometry.scene import OWN, Discs, Floats, Integers, Polygons, Scene, Segments
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


def frame_around(scenes: Sequence[Scene], width: float = WIDTH, height: float = HEIGHT) -> ViewFrame:
    """The frame that fits all that is painted of some scenes into a picture, with the round ends of broad strokes.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.notation.read import read
    >>> frame_around([scene_of(derive(read("axiom: !(0.5)F"), 0))])  # 0.5 wide, 1.5 high
    ViewFrame(scale=120.0, left=-0.25, top=1.25, width=84, height=204)
    """
    left, bottom, right, top = zip(*map(_painted_box, scenes), strict=True)
    return frame_of((min(left), min(bottom), max(right), max(top)), width, height)


def _painted_box(scene: Scene) -> tuple[float, float, float, float]:
    """Least x, least y, greatest x, greatest y of what is painted."""
    ends, reach = scene.segments.ends, np.maximum(scene.segments.widths, 0) / 2
    if not (len(ends) and reach.any()):
        return scene.box
    x, y = ends[:, ::2], ends[:, 1::2]
    left, bottom, right, top = scene.box
    return (min(left, float((x.min(axis=1) - reach).min())), min(bottom, float((y.min(axis=1) - reach).min())),
            max(right, float((x.max(axis=1) + reach).max())), max(top, float((y.max(axis=1) + reach).max())))


def frame_of(box: tuple[float, float, float, float], width: float = WIDTH, height: float = HEIGHT) -> ViewFrame:
    """The frame that fits a box into a picture, no larger than needed."""
    left, bottom, right, top = box
    across, up = max(right - left, 1e-9), max(top - bottom, 1e-9)
    scale = min((width - 2 * MARGIN) / across, (height - 2 * MARGIN) / up, 120.0)
    return ViewFrame(scale, left, top, round((right - left) * scale) + 2 * MARGIN, round((top - bottom) * scale) + 2 * MARGIN)


class Faces(NamedTuple):
    """Polygons, by their numbers."""

    numbers: Integers


class Strokes(NamedTuple):
    """Strokes of one colour and width, in tenths of a pixel, by their numbers."""

    numbers: Integers
    colour: str
    width: int


class Rounds(NamedTuple):
    """Circles, discs and spheres, by their numbers."""

    numbers: Integers


Run: TypeAlias = Faces | Strokes | Rounds
"""Shapes that are painted one after another."""


FACE, ROUND = -2, -1
"""The keys of runs that are not of strokes, whose keys are not negative."""


@dataclass(frozen=True)
class DisplayList:
    """The shapes of a scene in the order in which they are painted, as runs of shapes that look alike.

    In space there may be as many runs as strokes: whoever paints many of them takes the arrays.

    Attributes
    ----------
    numbers
        Shape (n,): the shapes in their order, each by its number among those of its kind.
    starts
        Shape (m + 1,): the index in `numbers` of the first shape of each run; the last is n.
    keys
        Shape (m,): for each run of strokes the key of its looks; `FACE` for polygons, `ROUND` for circles, discs and spheres.
    looks
        The looks of strokes.
    """

    numbers: Integers
    starts: Integers
    keys: Integers
    looks: StrokeLooks

    def __iter__(self) -> Iterator[Run]:
        """The runs, one after another."""
        colours, widths = colours_and_widths(self.keys)
        for (start, stop), key, colour, width in zip(pairwise(self.starts.tolist()), self.keys.tolist(), colours.tolist(),
                                                     widths.tolist(), strict=True):
            numbers = self.numbers[start:stop]
            if key >= 0:
                yield Strokes(numbers, self.looks.names[colour], width)
            else:
                yield Faces(numbers) if key == FACE else Rounds(numbers)


def display_list(scene: Scene, scale: float, colour_of: Mapping[int, str]) -> DisplayList:
    """The shapes of a scene in the order in which they are painted: what comes later covers what came before.

    In space that is from far to near. In the plane first polygons, then strokes, by colours and of one colour the broad ones
    first, then circles, discs and spheres.

    Parameters
    ----------
    scene
        A scene in the plane, or projected onto it.
    scale
        The pixels of a unit of length.
    colour_of
        For each state its colour.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.notation.read import read
    >>> from lsys_kit.pictures.view import project
    >>> scene = project(scene_of(derive(read("axiom: [^(90)f@O(1)][&(90)f@O(2)]FF"), 0)))  # towards the viewer, away
    >>> [(type(run).__name__, run.numbers.tolist()) for run in display_list(scene, 1, {})]
    [('Rounds', [1]), ('Strokes', [0, 1]), ('Rounds', [0])]
    """
    looks = stroke_looks(scene.segments, scale, colour_of)
    if scene.order is not None:
        return _from_far_to_near(scene, scene.order, looks)
    runs = {FACE: np.arange(len(scene.polygons)),
            **{key: np.flatnonzero(looks.keys == key) for key in np.flatnonzero(np.bincount(looks.keys)).tolist()},
            ROUND: np.arange(len(scene.discs))}
    return DisplayList(np.concatenate([*runs.values()]), np.cumsum([0, *map(len, runs.values())]), np.array([*runs]), looks)


def _from_far_to_near(scene: Scene, order: Integers, looks: StrokeLooks) -> DisplayList:
    """The shapes in their order, as long as they look alike in one run; the length of a run is often 1 or 2."""
    counts = [len(scene.polygons), len(scene.segments), len(scene.discs)]
    keys = np.concatenate([np.full(counts[0], FACE), looks.keys, np.full(counts[2], ROUND)])[order]
    numbers = order - np.repeat([0, counts[0], counts[0] + counts[1]], counts)[order]
    starts = np.flatnonzero(np.diff(keys, prepend=FACE - 1))
    return DisplayList(numbers, np.append(starts, len(order)), keys[starts], looks)


@dataclass(frozen=True)
class StrokeLooks:
    """The looks of strokes: for each a key that stands for its colour and its width; keys grow as broad strokes get thinner."""

    keys: Integers
    names: Sequence[str]


def colours_and_widths(keys: Integers) -> tuple[Integers, Integers]:
    """The numbers of the colours that keys stand for, and the widths in tenths of a pixel."""
    return keys // (BROADEST + 1), BROADEST - keys % (BROADEST + 1)


def stroke_looks(segments: Segments, scale: float, colour_of: Mapping[int, str]) -> StrokeLooks:
    """The looks of strokes: a width that the turtle has set is scaled with the drawing; others depend on the branch order."""
    thin = stroke_scale(segments, scale)
    by_order = np.array([round(10 * width * thin) for width in STROKES])
    widths = by_order[np.minimum(segments.orders, len(STROKES) - 1)]
    if (segments.widths != OWN).any():
        given = np.clip(np.rint(segments.widths * scale * 10), THINNEST, BROADEST).astype(np.int64)
        widths = np.where(segments.widths == OWN, widths, given)
    names, numbers = numbered_colours(segments.states, segments.colours, colour_of)
    return StrokeLooks(numbers * (BROADEST + 1) + (BROADEST - widths), names)


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
