"""The scene of a word: a filament, or what a turtle draws, assembled from instances where that pays, else module by module."""

from __future__ import annotations

from lsys_kit.derivation.core.rules import real_from
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation
from lsys_kit.geometry.filament import filament
from lsys_kit.geometry.natural_colours import coloured
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle.commands.mode import DrawingMode, drawing_mode
from lsys_kit.geometry.turtle.instancing import draw_instanced
from lsys_kit.geometry.turtle.plane import place_path, trace
from lsys_kit.geometry.turtle.space import trace_in_space
from lsys_kit.notation.model.system import LSystem

ANGLE_HINT = "An angle is in degrees, as in angle=25.7."
"""What to write where an angle is no number."""


def scene_of(what: Derivation | Word, angle: float | None = None, colours: str = "") -> Scene:
    """The scene of a word, or of the last word of a derivation.

    Parameters
    ----------
    what
        A word; or a derivation, whose last word is often not even built.
    angle
        The turning angle in degrees; by default the system's.
    colours
        Whether strokes without a chosen colour have "natural" ones; by default as the system says.

    Raises
    ------
    ModelLimitError
        More brackets are open at once than the limit allows.
    ModelValueError
        A value cannot be drawn.

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
    return coloured(_scene_of(what, angle), what.states.system, colours)


def turning_angle(given: object, system: LSystem) -> float:
    """The turning angle that a person wants for a system, in degrees; by default the system's.

    >>> from lsys_kit.notation.read import read
    >>> turning_angle(None, read("angle: 60\\naxiom: F")), turning_angle("51/2", read("axiom: F"))
    (60.0, 25.5)

    Raises
    ------
    ModelValueError
        It is no number, or a number that is not known.
    """
    return float(system.angle) if given is None else real_from(given, "angle", ANGLE_HINT)


def _scene_of(what: Derivation | Word, angle: float | None) -> Scene:
    system = what.states.system
    turn = float(system.angle) if angle is None else angle
    mode = drawing_mode(system)
    if mode is not DrawingMode.FILAMENT and isinstance(what, Derivation):
        scene = draw_instanced(what, what.steps, turn)
        if scene is not None:
            return scene
    word = what[-1] if isinstance(what, Derivation) else what
    match mode:
        case DrawingMode.FILAMENT:
            return filament(word)
        case DrawingMode.PLANE:
            return place_path(trace(word), turn, float(system.heading))
        case DrawingMode.SPACE:
            return trace_in_space(word, turn)
