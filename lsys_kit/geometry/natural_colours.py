"""Natural colours of strokes: from bark to leaves, by their width where the turtle has set one, else by their branch order.

Plants in space have them, if neither the model nor whoever draws says otherwise.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lsys_kit.geometry.scene import OWN, Floats, Integers, Scene, Segments
from lsys_kit.geometry.turtle.commands.actions import Effect
from lsys_kit.geometry.turtle.commands.mode import DrawingMode, drawing_mode
from lsys_kit.geometry.turtle.commands.table import RAMP_END, RAMP_START, commands_of, initial_colour
from lsys_kit.notation.model.system import LSystem


def has_natural_colours(system: LSystem) -> bool:
    """Whether strokes have natural colours, if they have no others: as the system says, else if it branches in space.

    >>> from lsys_kit.notation.read import read
    >>> [has_natural_colours(read(text)) for text in ("axiom: F[&F]", "axiom: F[+F]", "colours: natural\\naxiom: F[+F]")]
    [True, False, True]
    """
    if system.colours:
        return system.colours == "natural"
    branches = any(Effect.OPENS in command.effects for command, _ in commands_of(system))
    return branches and drawing_mode(system) is DrawingMode.SPACE


def coloured(scene: Scene, system: LSystem, colours: str = "") -> Scene:
    """A scene of a system, in which strokes without a chosen colour have natural ones if those of the system have.

    Whoever draws can choose "natural" ones.

    Where its turtle steps through colours, the farthest step that is drawn is the last colour of the ramp.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.turtle.space import trace_in_space
    >>> from lsys_kit.notation.read import read
    >>> tree = read("colours: natural\\naxiom: F[&F[&F]]")
    >>> coloured(trace_in_space(derive(tree, 0)[0]), tree).segments.colours.tolist()
    [16, 20, 23]
    """
    if initial_colour(system) == RAMP_START:
        return _stretched(scene)
    return _by_width_or_order(scene) if colours == "natural" or has_natural_colours(system) else scene


def _stretched(scene: Scene) -> Scene:
    """A scene whose colours of the ramp reach its end."""
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    most = max(int(colours.max(initial=RAMP_START)) for colours in (segments.colours, polygons.colours, discs.colours))
    stretch = (RAMP_END - RAMP_START) / max(min(RAMP_END, most) - RAMP_START, 1)
    return replace(
        scene,
        segments=replace(segments, colours=_along_ramp(segments.colours, stretch)),
        polygons=replace(polygons, colours=_along_ramp(polygons.colours, stretch)),
        discs=replace(discs, colours=_along_ramp(discs.colours, stretch)),
    )


def _along_ramp(colours: Integers, stretch: float) -> Integers:
    there = (colours >= RAMP_START) & (colours <= RAMP_END)
    return np.where(there, RAMP_START + np.floor((colours - RAMP_START) * stretch + 0.5).astype(np.int64), colours)


def _by_width_or_order(scene: Scene) -> Scene:
    """A scene in which strokes for which the turtle has chosen no colour have natural ones."""
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
