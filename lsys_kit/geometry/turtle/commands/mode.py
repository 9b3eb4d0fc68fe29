"""How a system is drawn: as a filament, or by a turtle in the plane or in space. Whatever draws asks here."""

from __future__ import annotations

from enum import Enum, auto

from lsys_kit.derivation.core.interpretation import is_filament
from lsys_kit.geometry.turtle.commands.actions import Effect
from lsys_kit.geometry.turtle.commands.table import Command, commands_of
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem


class DrawingMode(Enum):
    """How the words of a system are drawn.

    Attributes
    ----------
    FILAMENT
        As cells in a row; the words of a derivation form a developmental sequence.
    PLANE
        By a turtle that stays in the plane of the picture.
    SPACE
        By a turtle in space, whose drawing can be seen from any side.
    """

    FILAMENT = auto()
    PLANE = auto()
    SPACE = auto()


def drawing_mode(system: LSystem) -> DrawingMode:
    """How the words of a system are drawn.

    >>> from lsys_kit.notation.read import read
    >>> drawing_mode(read("axiom: a\\ninterpretation:\\na -> R(2,1)")).name
    'FILAMENT'
    >>> drawing_mode(read("axiom: F[+F]F")).name, drawing_mode(read("axiom: F[&F]F")).name
    ('PLANE', 'SPACE')
    """
    if is_filament(system):
        return DrawingMode.FILAMENT
    return DrawingMode.PLANE if in_plane(system) else DrawingMode.SPACE


def in_plane(system: LSystem) -> bool:
    """Whether the turtle stays in the plane of the picture, however long a system develops.

    A roll by half a turn stays there: left and right change places.

    >>> from lsys_kit.notation.read import read
    >>> in_plane(read("axiom: F[+F]/(180)F")), in_plane(read("axiom: F[+F]/(90)F"))
    (True, False)
    """
    return all(_stays_in_plane(command, module) for command, module in commands_of(system))


def _stays_in_plane(command: Command, module: Pattern) -> bool:
    """Whether a command stays in the plane, with the argument that a module gives it."""
    if command.action == "roll" and module.arguments:
        argument = module.arguments[0]
        return isinstance(argument, Number) and argument.value % 180 == 0
    return Effect.LEAVES_PLANE not in command.effects
