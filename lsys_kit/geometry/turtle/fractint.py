"""The handlers of the actions that only Fractint's turtle has: a second heading, mirrored turns, and a palette of 256 colours.

`+`, `-` and `|` turn the heading of `F` and `G`; `D` and `M` follow a second heading, which only `\\` and `/` turn, by degrees.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from lsys_kit.geometry.scene import OWN
from lsys_kit.geometry.turtle.commands.instructions import Instruction
from lsys_kit.geometry.turtle.handlers import Handler, forward_handler
from lsys_kit.geometry.turtle.turtle import Turtle

PALETTE_SIZE, WHITE = 256, 15
"""The number of Fractint's colours, and the one in which it draws at first."""


def _set_palette_colour(turtle: Turtle, instruction: Instruction) -> None:
    """Set a colour modulo 256; a step never leads to colour 0, that of the background."""
    colour = WHITE if turtle.colour == OWN else turtle.colour
    colour = math.floor(instruction.factor * colour + instruction.addend) % PALETTE_SIZE
    step = instruction.factor != 0
    turtle.colour = colour or (0 if not step else 1 if instruction.addend > 0 else PALETTE_SIZE - 1)


def _forward_by_second_heading(drawn: bool) -> Handler:
    forward = forward_handler(drawn, True)

    def handler(turtle: Turtle, instruction: Instruction) -> None:
        orientation, turtle.orientation = turtle.orientation, turtle.initial_orientation(turtle.second_heading)
        forward(turtle, instruction)
        turtle.orientation = orientation

    return handler


def _turn_second_heading(turtle: Turtle, instruction: Instruction) -> None:
    turtle.second_heading += turtle.mirror * instruction.addend


def _mirror_turns(turtle: Turtle, _: Instruction) -> None:
    turtle.mirror = -turtle.mirror


FRACTINT_HANDLERS: Mapping[str, Handler] = {
    "draw by second heading": _forward_by_second_heading(True),
    "move by second heading": _forward_by_second_heading(False),
    "turn second heading": _turn_second_heading,
    "mirror turns": _mirror_turns,
    "set palette colour": _set_palette_colour,
}
"""The handlers, by action."""
