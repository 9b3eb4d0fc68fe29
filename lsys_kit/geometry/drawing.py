"""The scene of a word: put together from pieces where many are alike, else drawn module by module, in the plane or in space."""

from __future__ import annotations

from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle.instancing import draw_instanced
from lsys_kit.geometry.turtle.mode import in_plane
from lsys_kit.geometry.turtle.plane import place_path, trace
from lsys_kit.geometry.turtle.space import trace_in_space


def scene_of(what: Derivation | Word, angle: float | None = None) -> Scene:
    """What the turtle draws of a word, or of a derivation's last one.

    Parameters
    ----------
    what
        A word; or a derivation, whose word is then often not even built.
    angle
        Degrees by which the turtle turns; by default the system's.

    Raises
    ------
    ModelLimitError
        More brackets are open at once than the limit allows.
    ModelValueError
        A value is no number that can be drawn.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> plant = derive(read("angle: 25.7\\naxiom: F\\nF -> F[+F]F[-F]F"), 7)
    >>> print(scene_of(plant))
    78,125 segments, width 732.47, height 2187
    >>> print(scene_of(plant[2], 90))
    25 segments, width 6, height 9
    """
    system = what.states.system
    turn = float(system.angle) if angle is None else angle
    if isinstance(what, Derivation):
        scene = draw_instanced(what, what.steps, turn)
        if scene is not None:
            return scene
        what = what[-1]
    if in_plane(system):
        return place_path(trace(what), turn, float(system.heading))
    return trace_in_space(what, turn)
