"""What each symbol tells the turtle, in the traditions of the seeds, side by side.

The traditions agree on most symbols and differ on some: GROGRA's `+` turns clockwise on the screen, ABOP's the other way;
in plant strings round brackets are branches and I, A, B are strokes. A symbol that is in no column tells the turtle nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal


@dataclass(frozen=True)
class Command:
    """One command.

    Attributes
    ----------
    action
        "draw" and "move" go forward, "turn" turns, "open" remembers where the turtle is, "close" returns there.
    amount
        Forward: the length without an argument. Turn and open: how many angles to the left.
    argument
        What an argument replaces: forward the length; in a turn it gives degrees, to the left where it is 1, to the right
        where it is -1.
    """

    action: Literal["draw", "move", "turn", "open", "close"]
    amount: Fraction = Fraction(0)
    argument: int = 1


_DRAW, _MOVE = Command("draw", Fraction(1)), Command("move", Fraction(1))
_LEFT, _RIGHT = Command("turn", Fraction(1), 1), Command("turn", Fraction(-1), -1)
_OPEN, _CLOSE = Command("open"), Command("close")

#    symbol   the kit's own (ABOP)           GROGRA (seed 003)              plant strings (seed 004)
_TABLE: tuple[tuple[str, Command | None, Command | None, Command | None], ...] = (
    ("F",     _DRAW,                         _DRAW,                         None),
    ("f",     _MOVE,                         _MOVE,                         None),
    ("+",     _LEFT,                         _RIGHT,                        _LEFT),
    ("-",     _RIGHT,                        _LEFT,                         _RIGHT),
    ("RU",    Command("turn", argument=-1),  Command("turn", argument=-1),  None),
    ("[",     _OPEN,                         _OPEN,                         Command("open", Fraction(1))),
    ("]",     _CLOSE,                        _CLOSE,                        _CLOSE),
    ("(",     None,                          None,                          Command("open", Fraction(-1))),
    (")",     None,                          None,                          _CLOSE),
    ("I",     None,                          None,                          Command("draw", Fraction(1))),
    ("A",     None,                          None,                          Command("draw", Fraction(2, 3))),
    ("B",     None,                          None,                          Command("draw", Fraction(1, 3))),
)

COMMANDS: Mapping[str, Mapping[str, Command]] = {
    "abop": {symbol: abop for symbol, abop, _, _ in _TABLE if abop},
    "grogra": {symbol: grogra for symbol, _, grogra, _ in _TABLE if grogra},
    "plant-string": {symbol: plant for symbol, _, _, plant in _TABLE if plant},
}
"""For each tradition its commands, by symbol."""

STEERING = frozenset(symbol for column in COMMANDS.values() for symbol, command in column.items()
                     if command.action not in ("draw", "move"))
"""Symbols that only steer the turtle: they are no part of the organism."""
