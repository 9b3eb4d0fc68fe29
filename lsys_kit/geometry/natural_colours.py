"""Natural colours of strokes: from bark to leaves, by their width where the turtle has set one, else by their branch order."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lsys_kit.geometry.scene import OWN, Floats, Scene, Segments
from lsys_kit.geometry.turtle.commands import RAMP_END, RAMP_START
from lsys_kit.notation.model.system import LSystem


def coloured(scene: Scene, system: LSystem) -> Scene:
    """A scene of a system, in which strokes without a chosen colour have natural ones if the system says so.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.turtle.space import trace_in_space
    >>> from lsys_kit.notation.read import read
    >>> tree = read("colours: natural\\naxiom: F[&F[&F]]")
    >>> coloured(trace_in_space(derive(tree, 0)[0]), tree).segments.colours.tolist()
    [16, 20, 23]
    """
    if system.colours != "natural":
        return scene
    segments = scene.segments
    numbers = RAMP_START + np.floor((RAMP_END - RAMP_START) * _youth(segments) + 0.5).astype(np.int64)
    return replace(scene, segments=replace(segments, colours=np.where(segments.colours == OWN, numbers, segments.colours)))


def _youth(segments: Segments) -> Floats:
    """How young strokes are, from 0 to 1: the thinner or the farther from the stem."""
    deepest, widest = int(segments.orders.max(initial=0)), float(segments.widths.max(initial=OWN))
    by_order = segments.orders / deepest if deepest else np.ones(len(segments))
    if widest <= 0:
        return by_order
    return np.where(segments.widths == OWN, by_order, 1 - np.sqrt(np.clip(segments.widths / widest, 0, 1)))
