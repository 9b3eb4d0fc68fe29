"""Scenes with the looks that a person chooses: whose colours shapes have, where the widths of strokes come from, and whether
it is marked where the turtle starts.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from lsys_kit.geometry.scene import OWN, Discs, Integers, Polygons, Scene, Segments
from lsys_kit.geometry.turtle.space import initial_frame
from lsys_kit.notation.model.system import LSystem

START, START_COLOUR = 0.12, 4
"""The length of the arrow at the start as a share of the drawing, and its colour, as a turtle chooses it by number."""


def with_colours_of_symbols(scene: Scene, states: Collection[int] | None = None) -> Scene:
    """A scene in which shapes have the colours of their symbols: all of them, or those that modules of some states drew.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.notation.read import read
    >>> with_colours_of_symbols(scene_of(derive(read("axiom: F ;(2) F"), 0))).segments.colours.tolist()
    [-1, -1]
    """
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    return replace(
        scene,
        segments=replace(segments, colours=_colours(segments, states)),
        polygons=replace(polygons, colours=_colours(polygons, states)),
        discs=replace(discs, colours=_colours(discs, states)),
    )


def _colours(shapes: Segments | Polygons | Discs, states: Collection[int] | None) -> Integers:
    """The colours of shapes, in which some have those of their symbols."""
    theirs = np.ones(len(shapes), bool) if states is None else np.isin(shapes.states, list(states))
    return np.where(theirs, OWN, np.broadcast_to(shapes.colours, len(shapes)))


def with_start(scene: Scene, system: LSystem) -> Scene:
    """A scene with an arrow whose tip is where the turtle starts, and which points where it looks then.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.notation.read import read
    >>> plant = derive(read("axiom: F(10)"), 0)
    >>> with_start(scene_of(plant), plant.states.system).polygons.points.round(2).tolist()
    [[0.0, 0.0], [-0.48, -1.2], [0.48, -1.2]]
    """
    axes = [0, 2] if scene.dimension == 2 else [0, 1, 2]
    head, left = np.array(initial_frame(system.turtle, float(system.heading))[:2])[:, axes]
    size = (float(np.ptp(scene.corners, axis=0).max()) or 1.0) * START
    arrow, found = size * np.array([0 * head, left * 0.4 - head, -left * 0.4 - head]), scene.polygons
    flat = np.zeros((3, 3)) if len(found.normals) else found.normals
    return replace(
        scene,
        polygons=Polygons(
            np.concatenate([found.points, arrow]),
            np.append(found.starts, len(found.points) + 3),
            np.append(found.states, 0),
            np.append(np.broadcast_to(found.colours, len(found)), START_COLOUR),
            np.concatenate([found.normals, flat]),
        ),
    )


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
