"""What Fractint's turtle does and no other: it has a second direction, a hand that may be reversed, and 256 colours.

`+`, `-` and `|` turn the direction of `F` and `G`; the direction of `D` and `M` is another, which only `/` and its mirror image
turn, by degrees.
"""

from __future__ import annotations

from collections.abc import Mapping

from lsys_kit.geometry.commands import Instruction
from lsys_kit.geometry.interpreter import Act, Turtle, forward
from lsys_kit.geometry.scene import OWN

COLOURS, WHITE = 256, 15
"""How many colours Fractint has, and which it draws in where none was set."""


def _dye(turtle: Turtle, order: Instruction) -> None:
    """As Fractint colours: 256 of them, white before any is set, and by steps never the ground's, which is 0."""
    colour = int(order.factor * (WHITE if turtle.colour == OWN else turtle.colour) + order.addend) % COLOURS
    turtle.colour = colour or (int(order.factor) and (1 if order.addend > 0 else COLOURS - 1))


def _aside(drawn: bool) -> Act:
    ahead = forward(drawn, True)

    def act(turtle: Turtle, order: Instruction) -> None:
        way, turtle.way = turtle.way, turtle.facing(turtle.bearing)
        ahead(turtle, order)
        turtle.way = way
    return act


def _swerve(turtle: Turtle, order: Instruction) -> None:
    turtle.bearing += turtle.hand * order.addend


def _reverse(turtle: Turtle, _: Instruction) -> None:
    turtle.hand = -turtle.hand


FRACTINT: Mapping[str, Act] = {
    "draw aside": _aside(True), "move aside": _aside(False), "swerve": _swerve, "reverse": _reverse, "dye": _dye}
"""Its acts, by the names of the actions."""
