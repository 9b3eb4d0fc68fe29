"""Widths of strokes in pixels, as The Algorithmic Beauty of Plants and cpfg have them, in the units of a drawing.

In cpfg lines of the style "pixel" are so many pixels wide, and lines of the styles "polygon" and "cylinder" so many units; the
style stands in another file than the model. So in the listings of the book: `A(1,10)` of figure 2.6 draws a stem of length 1
and width 10. A system can say which is meant, by `widths: pixels` or `widths: units`. Where it does not, its widths are pixels
if the broadest stroke has at least one: a line cannot be narrower.

A pixel is one of a picture of the usual size, and at most a unit: a drawing of more units than the picture has pixels is made
smaller with its strokes, as those of figure 2.8 with stems of 200 units. Pictures of other sizes, films and meshes scale
strokes with the drawing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lsys_kit.geometry.scene import OWN, Scene
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS
from lsys_kit.pictures.rendering.frames import HEIGHT, WIDTH, frame_of

MOST_OF_A_PICTURE = 0.5
"""The part of a picture that the broadest stroke may fill before the drawing is no longer made smaller for it."""


def in_units(scenes: Sequence[Scene], system: LSystem) -> list[Scene]:
    """Scenes of a system with the widths of their strokes in the units of lengths, such that all fit into one frame.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.notation.read import read
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
    """Whether the widths of strokes are in pixels, given the greatest."""
    return system.widths == "pixels" or (not system.widths and TURTLE_DIALECTS[system.turtle].pixels and broadest >= 1)


def _with_pixels(scene: Scene, pixel: float) -> Scene:
    """A scene with widths in units of length, given the length of a pixel."""
    widths = scene.segments.widths
    return replace(scene, segments=replace(scene.segments, widths=np.where(widths == OWN, OWN, widths * pixel)))
