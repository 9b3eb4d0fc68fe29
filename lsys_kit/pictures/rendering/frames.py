"""Frames: where the plane of a drawing lies in a picture, with white space around it, and how broad its strokes are there.

In cpfg lines of the style "pixel" are so many pixels wide, and lines of the styles "polygon" and "cylinder" so many units; the
style stands in another file than the model. So in the listings of the book: `A(1,10)` of figure 2.6 draws a stem of length 1
and width 10. A system can say which is meant, by `widths: pixels` or `widths: units`. Where it does not, its widths are pixels
if the broadest stroke has at least one: a line cannot be narrower.

A pixel is one of a picture of the usual size, and at most a unit: a drawing of more units than the picture has pixels is made
smaller with its strokes, as those of figure 2.8 with stems of 200 units. Pictures of other sizes, films and meshes scale
strokes with the drawing.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lsys_kit.geometry.scene import OWN, Floats, Integers, Labels, Scene
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS
from lsys_kit.pictures.rendering.looks import median_length
from lsys_kit.pictures.rendering.view import ProjectedScene

WIDTH, HEIGHT = 600, 400
"""The size of the largest picture, in pixels."""
MARGIN = 12
"""White space around a drawing, in pixels."""
LABEL, LABEL_GAP = 12, 5
"""The size of labels, and how far to the right of its point each begins, in pixels."""
PARTS, LEAST_PARTS = (10, 100, 1_000, 10_000), 50
"""Into how many parts a pixel may be divided, and how many of these the median stroke has at least."""


@dataclass(frozen=True)
class ViewFrame:
    """The transform from the units of a scene to parts of a pixel, by default tenths."""

    scale: float
    left: float
    top: float
    width: int
    height: int
    parts: int = 10

    def points(self, coordinates: Floats) -> Integers:
        """Parts of a pixel for x and y in turn along the last axis; halves are always rounded the same way."""
        flip = np.tile([1.0, -1.0], coordinates.shape[-1] // 2)
        shift = np.tile([-self.left, self.top], coordinates.shape[-1] // 2)
        pixels = (coordinates * flip + shift) * self.scale + MARGIN
        parts: Integers = np.floor(pixels * self.parts + 0.5001).astype(np.int64)
        return parts


def in_fine_parts(frame: ViewFrame, scene: Scene) -> ViewFrame:
    """The frame with pixels in so many parts that rounding bends no stroke to be seen: the median one is 50 long at least.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> koch = [scene_of(derive(read("angle: 60\\naxiom: F\\nF -> F+F--F+F"), step)) for step in (2, 4)]
    >>> [in_fine_parts(frame_around([scene]), scene).parts for scene in koch]
    [10, 100]
    """
    length = median_length(scene.segments) * frame.scale
    return replace(frame, parts=next(parts for parts in PARTS if parts * length >= LEAST_PARTS or parts == PARTS[-1]))


def frame_around(scenes: Sequence[Scene], width: float = WIDTH, height: float = HEIGHT) -> ViewFrame:
    """The frame that fits all that is painted of some scenes into a picture, with the round ends of broad strokes.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> frame_around([scene_of(derive(read("axiom: !(0.5)F"), 0))])  # 0.5 wide, 1.5 high
    ViewFrame(scale=120.0, left=-0.25, top=1.25, width=84, height=204, parts=10)
    """
    left, bottom, right, top = zip(*map(painted_box, scenes), strict=True)
    frame = frame_of((min(left), min(bottom), max(right), max(top)), width, height)
    written = [scene.labels for scene in scenes if len(scene.labels)]
    return replace(frame, width=max([frame.width, *(_width_with(labels, frame) for labels in written)]))


def _width_with(labels: Labels, frame: ViewFrame) -> int:
    """How broad a picture is in which some labels end before the edge."""
    places: list[float] = (frame.points(labels.points)[:, 0] / frame.parts).tolist()
    return math.ceil(max(x + label_width(text) for x, text in zip(places, labels.texts, strict=True)))


def label_width(text: str) -> float:
    """How far a label reaches to the right of its point, with space on both sides, in pixels: an upper estimate.

    >>> round(label_width("12.5"), 1)
    37.5
    """
    return 2 * LABEL_GAP + LABEL * math.fsum(0.37 if letter in "., -" else 0.84 if letter == "+" else 0.64 for letter in text)


def painted_box(scene: Scene) -> tuple[float, float, float, float]:
    """Least x, least y, greatest x, greatest y of what is painted."""
    ends, reach = scene.segments.ends, np.maximum(scene.segments.widths, 0) / 2
    if not (len(ends) and reach.any()):
        return scene.box
    if isinstance(scene, ProjectedScene):
        reach = reach * scene.factors.max(axis=1)
    x, y = ends[:, ::2], ends[:, 1::2]
    left, bottom, right, top = scene.box
    return (
        min(left, float((x.min(axis=1) - reach).min())),
        min(bottom, float((y.min(axis=1) - reach).min())),
        max(right, float((x.max(axis=1) + reach).max())),
        max(top, float((y.max(axis=1) + reach).max())),
    )


def frame_of(box: tuple[float, float, float, float], width: float = WIDTH, height: float = HEIGHT) -> ViewFrame:
    """The frame that fits a box into a picture, no larger than needed."""
    left, bottom, right, top = box
    across, up = max(right - left, 1e-9), max(top - bottom, 1e-9)
    return frame_on(box, min((width - 2 * MARGIN) / across, (height - 2 * MARGIN) / up, 120.0))


def frame_on(box: tuple[float, float, float, float], scale: float) -> ViewFrame:
    """The frame of a box on a scale."""
    left, bottom, right, top = box
    return ViewFrame(scale, left, top, round((right - left) * scale) + 2 * MARGIN, round((top - bottom) * scale) + 2 * MARGIN)


# --- widths of strokes ---

MOST_OF_A_PICTURE = 0.5
"""The part of a picture that the broadest stroke may fill before the drawing is no longer made smaller for it."""


def in_units(scenes: Sequence[Scene], system: LSystem) -> list[Scene]:
    """Scenes of a system with the widths of their strokes in the units of lengths, such that all fit into one frame.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> stem = read("axiom: !(6)F(370)")
    >>> [scene] = in_units([scene_of(derive(stem, 0))], stem)
    >>> scene.segments.widths.tolist()  # 370 units and the round ends are as high as a picture without its margins
    [6.0]
    """
    broadest = max((float(scene.segments.widths.max(initial=OWN)) for scene in scenes), default=OWN)
    if not _in_pixels(system, broadest):
        return [*scenes]
    left, bottom, right, top = zip(*(scene.box for scene in scenes), strict=True)
    box, room = (min(left), min(bottom), max(right), max(top)), min(broadest, MOST_OF_A_PICTURE * HEIGHT)
    pixel = min(1.0, 1 / frame_of(box, WIDTH - room, HEIGHT - room).scale)
    return [_with_pixels(scene, pixel) for scene in scenes]


def _in_pixels(system: LSystem, broadest: float) -> bool:
    return system.widths == "pixels" or (not system.widths and TURTLE_DIALECTS[system.turtle].pixels and broadest >= 1)


def _with_pixels(scene: Scene, pixel: float) -> Scene:
    widths = scene.segments.widths
    return replace(scene, segments=replace(scene.segments, widths=np.where(widths == OWN, OWN, widths * pixel)))
