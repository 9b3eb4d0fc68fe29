"""How a system is drawn."""

from __future__ import annotations

from fractions import Fraction

from lsys_kit.geometry.turtle.actions import Effect
from lsys_kit.geometry.turtle.commands import Command, commands_of
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.system import LSystem, Module


def in_plane(system: LSystem) -> bool:
    """Whether the turtle stays in the plane of the picture, however long a system develops.

    A roll by half a turn stays there: left and right change places.

    >>> from lsys_kit.notation.read import read
    >>> in_plane(read("axiom: F[+F]/(180)F")), in_plane(read("axiom: F[+F]/(90)F"))
    (True, False)
    """
    return all(_stays_in_plane(command, module) for command, module in commands_of(system))


def _stays_in_plane(command: Command, module: Module) -> bool:
    """Whether a command stays in the plane, with the argument that a module gives it."""
    if command.action == "roll" and module.arguments:
        value = module.arguments[0]
        value = value.value if isinstance(value, Number) else value
        return isinstance(value, int | Fraction | float) and value % 180 == 0
    return Effect.LEAVES_PLANE not in command.effects
