"""Frames: where the plane of a drawing lies in a picture, with white space around it, and how broad its strokes are there.

In cpfg lines of the style "pixel" are so many pixels wide, and lines of the styles "polygon" and "cylinder" so many units; the
style stands in another file than the model. So in the listings of the book: `A(1,10)` of figure 2.6 draws a stem of length 1
and width 10. A system can say which is meant, by `widths: pixels` or `widths: units`. Where it does not, its widths are units
as far as they are in proportion to its strokes; if the broadest is not, all are made finer or broader with it. So a model and
the same model ten times as large look alike. Widths by the pipe model are in proportion to the plant, and a pipe is equally
broad in all scenes that are shown together.

A pixel is one of a picture of the usual size, and at most a unit: a drawing of more units than the picture has pixels is made
smaller with its strokes. Pictures of other sizes, films and meshes scale strokes with the drawing.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from lsys_kit.arrays import np
from lsys_kit.geometry.drawing import has_pipe_widths
from lsys_kit.geometry.scene import OWN, Floats, Integers, Labels, Scene, Segments
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS
from lsys_kit.pictures.rendering.looks import median_length
from lsys_kit.pictures.rendering.view import ProjectedScene

Room: TypeAlias = tuple[float, float]
"""A width and a height, in pixels."""
WIDTH, HEIGHT, TALLEST, NARROWEST = 600, 400, 640, 160
"""The size of a picture in pixels: one that is higher than this has the same area, as far as to the greatest height; and the
least width."""
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
    >>> koch = [scene_of(derive(read("angle: 60\\naxiom: F\\nF -> F+F--F+F"), step)) for step in (2, 5)]
    >>> [in_fine_parts(frame_around([scene]), scene).parts for scene in koch]
    [10, 100]
    """
    length = median_length(scene.segments) * frame.scale
    return replace(frame, parts=next(parts for parts in PARTS if parts * length >= LEAST_PARTS or parts == PARTS[-1]))


def frame_around(scenes: Sequence[Scene], room: Room | None = None) -> ViewFrame:
    """The frame that fits all that is painted of some scenes, with the round ends of broad strokes, into some room; or into a
    picture of the usual area.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> frame_around([scene_of(derive(read("axiom: !(0.5)F"), 0))])  # 0.5 wide, 1.5 high
    ViewFrame(scale=120.0, left=-0.5666..., top=1.25, width=160, height=204, parts=10)
    """
    left, bottom, right, top = zip(*map(painted_box, scenes), strict=True)
    frame = frame_of((min(left), min(bottom), max(right), max(top)), room)
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


def frame_of(box: tuple[float, float, float, float], room: Room | None = None) -> ViewFrame:
    """The frame that fits a box into some room, no larger than needed; or into a picture of the usual area.

    >>> [(frame.width, frame.height) for frame in (frame_of((0, 0, 30, up)) for up in (10, 20, 60, 900))]
    [(600, 216), (594, 404), (332, 640), (160, 640)]
    """
    left, bottom, right, top = box
    across, up = max(right - left, 1e-9), max(top - bottom, 1e-9)
    if room:
        return frame_on(box, min((room[0] - 2 * MARGIN) / across, (room[1] - 2 * MARGIN) / up, LARGEST_SCALE))
    frame = frame_on(box, usual_scale(across, up))
    more = max(0, NARROWEST - frame.width)
    return replace(frame, left=left - more / 2 / frame.scale, width=frame.width + more)


LARGEST_SCALE = 120.0
"""The most pixels of a unit."""


def usual_scale(across: float, up: float, less: float = 0.0) -> float:
    """The pixels of a unit with which a box fits into a picture of the usual area, in which some room is left."""
    wide, high, highest = (size - less - 2 * MARGIN for size in (WIDTH, HEIGHT, TALLEST))
    return min(wide / across, highest / up, math.sqrt(wide * high / (across * up)), LARGEST_SCALE)


def frame_on(box: tuple[float, float, float, float], scale: float) -> ViewFrame:
    """The frame of a box on a scale."""
    left, bottom, right, top = box
    return ViewFrame(scale, left, top, round((right - left) * scale) + 2 * MARGIN, round((top - bottom) * scale) + 2 * MARGIN)


# --- widths of strokes ---

MOST_OF_A_PICTURE = 0.5
"""The part of a picture that the broadest stroke may fill before the drawing is no longer made smaller for it."""
BROAD, STOUT, FINE = 1 / 36, 1 / 8, 1 / 50
"""Strokes are in proportion if none is broader than this part of the extent of the drawing, or than this of the longest stroke,
and the broadest is no finer than this part of the extent."""


def in_units(scenes: Sequence[Scene], system: LSystem, widths: str = "") -> list[Scene]:
    """Scenes of a system with the widths of their strokes in the units of lengths, such that all fit into one frame.

    Whoever draws may have chosen where the widths come from.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> for text in ("!(0.1)F", "!(10)F", "!(10)F(10)", "!(8)F(370)", "F[+F]F"):
    ...     system = read(f"axiom: {text}")
    ...     [scene] = in_units([scene_of(derive(system, 0))], system)
    ...     scene.segments.widths.round(3).tolist()
    [0.1]
    [0.125]
    [1.25]
    [8.0]
    [0.04, 0.03, 0.03]
    """
    if has_pipe_widths(system, widths):
        pipes = [float(scene.segments.widths.min(initial=np.inf)) for scene in scenes]
        seen = [each for each in zip(map(_extent, scenes), pipes, strict=True) if 0 < each[1] < np.inf]  # others have no extent
        _, usual = max(seen, default=(0.0, 1.0))
        return [_scaled(scene, usual / pipe if 0 < pipe < np.inf else 1.0) for scene, pipe in zip(scenes, pipes, strict=True)]
    broadest = max((float(scene.segments.widths.max(initial=OWN)) for scene in scenes), default=OWN)
    pixels = system.widths == "pixels"
    if broadest <= 0 or not (pixels or (not system.widths and TURTLE_DIALECTS[system.turtle].pixels)):
        return [*scenes]
    if not pixels:
        most = max(max(BROAD * _extent(scene), STOUT * _longest(scene.segments)) for scene in scenes)
        least = FINE * max(map(_extent, scenes))
        return [_scaled(scene, max(min(1.0, most / broadest), least / broadest)) for scene in scenes]
    left, bottom, right, top = zip(*(scene.box for scene in scenes), strict=True)
    across, up = max(max(right) - min(left), 1e-9), max(max(top) - min(bottom), 1e-9)
    pixel = min(1.0, 1 / usual_scale(across, up, min(broadest, MOST_OF_A_PICTURE * HEIGHT)))
    return [_scaled(scene, pixel) for scene in scenes]


def _extent(scene: Scene) -> float:
    return float(np.ptp(scene.corners, axis=0).max())


def _longest(segments: Segments) -> float:
    """The length of the longest stroke."""
    ends = np.split(segments.ends, 2, axis=1)
    return float(np.linalg.norm(ends[1] - ends[0], axis=1).max(initial=0.0))


def _scaled(scene: Scene, unit: float) -> Scene:
    """A scene whose widths are in some unit of lengths."""
    widths = scene.segments.widths
    return replace(scene, segments=replace(scene.segments, widths=np.where(widths == OWN, OWN, widths * unit)))
