"""Scenes with the looks that a person chooses: whose colours shapes have, and where the widths of strokes come from."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from lsys_kit.geometry.scene import OWN, Discs, Integers, Polygons, Scene, Segments


def with_colours_of_symbols(scene: Scene, states: Collection[int] | None = None) -> Scene:
    """A scene in which shapes have the colours of their symbols: all of them, or those that modules of some states drew.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.notation.read import read
    >>> with_colours_of_symbols(scene_of(derive(read("axiom: F ;(2) F"), 0))).segments.colours.tolist()
    [-1, -1]
    """
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    return replace(scene, segments=replace(segments, colours=_colours(segments, states)),
                   polygons=replace(polygons, colours=_colours(polygons, states)),
                   discs=replace(discs, colours=_colours(discs, states)))


def _colours(shapes: Segments | Polygons | Discs, states: Collection[int] | None) -> Integers:
    """The colours of shapes, in which some have those of their symbols."""
    theirs = np.ones(len(shapes), bool) if states is None else np.isin(shapes.states, list(states))
    return np.where(theirs, OWN, np.broadcast_to(shapes.colours, len(shapes)))


def with_widths(scene: Scene, widths: str = "", factor: float = 1.0) -> Scene:
    """A scene with strokes for which the turtle has set no width, if these are chosen by "order" or "constant"; else those that
    it has set are broader by a factor.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.notation.read import read
    >>> scene = scene_of(derive(read("axiom: F !(3) F"), 0))
    >>> with_widths(scene, "order").segments.widths.tolist(), with_widths(scene, factor=2).segments.widths.tolist()
    ([-1.0], [-1.0, 6.0])
    """
    segments = scene.segments
    if not widths:
        given = np.where(segments.widths == OWN, OWN, segments.widths * factor)
        return replace(scene, segments=replace(segments, widths=given))
    return replace(scene, segments=replace(segments, widths=np.array([float(OWN)])))
