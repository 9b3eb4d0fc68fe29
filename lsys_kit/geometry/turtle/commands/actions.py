"""The actions of the turtles, and what each of them does.

Whatever depends on the kind of a command follows from this table: whether a system stays in the plane, whether copies of a part
may be instanced, and which symbols of a word leave something to be seen. An action that is not declared instanceable is always
drawn module by module, which is slower but never wrong.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Flag, auto


class Effect(Flag):
    """What an action does.

    Attributes
    ----------
    VISIBLE
        It leaves something to be seen: a stroke, a shape, or the gap of a step forward.
    MOVES
        It changes the position of the turtle.
    TURNS
        It changes the orientation of the turtle.
    LEAVES_PLANE
        It may lead out of the plane of the picture.
    INSTANCEABLE
        What it does depends only on what the turtle carries (its step, width, colour and the like), and is moved and rotated
        with the turtle. So a copy of a part with such actions can be placed anywhere.
    OPENS, CLOSES
        It saves the state of the turtle at the beginning of a branch, or restores it at the end.
    """

    VISIBLE = auto()
    MOVES = auto()
    TURNS = auto()
    LEAVES_PLANE = auto()
    INSTANCEABLE = auto()
    OPENS = auto()
    CLOSES = auto()


_VISIBLE, _MOVES, _TURNS, _LEAVES_PLANE, _INSTANCEABLE, _OPENS, _CLOSES = Effect
_NOTHING = Effect(0)

ACTIONS: Mapping[str, Effect] = {
    "draw": _VISIBLE | _MOVES | _INSTANCEABLE,
    "move": _VISIBLE | _MOVES | _INSTANCEABLE,
    "draw without vertex": _VISIBLE | _MOVES | _INSTANCEABLE,
    "move without vertex": _VISIBLE | _MOVES | _INSTANCEABLE,
    "set position": _MOVES | _LEAVES_PLANE,
    "return to stroke": _MOVES,
    "draw by second heading": _VISIBLE | _MOVES,
    "move by second heading": _VISIBLE | _MOVES,
    "turn": _TURNS | _INSTANCEABLE,
    "turn by mirrored angle": _TURNS | _INSTANCEABLE,
    "turn back": _TURNS | _INSTANCEABLE,
    "mirror turns": _INSTANCEABLE,
    "turn second heading": _INSTANCEABLE,
    "pitch": _TURNS | _LEAVES_PLANE | _INSTANCEABLE,
    "roll": _TURNS | _LEAVES_PLANE | _INSTANCEABLE,
    "level": _TURNS | _LEAVES_PLANE,
    "gravitropism": _TURNS | _LEAVES_PLANE,
    "set tropism": _LEAVES_PLANE,
    "set heading": _TURNS | _LEAVES_PLANE,
    "set length": _INSTANCEABLE,
    "reset length": _INSTANCEABLE,
    "set length once": _INSTANCEABLE,
    "set width": _INSTANCEABLE,
    "reset width": _INSTANCEABLE,
    "set width once": _INSTANCEABLE,
    "set scale": _INSTANCEABLE,
    "set colour": _INSTANCEABLE,
    "step colour": _INSTANCEABLE,
    "reset colour": _INSTANCEABLE,
    "set palette colour": _INSTANCEABLE,
    "set gravitropism": _INSTANCEABLE,
    "reset gravitropism": _INSTANCEABLE,
    "set gravitropism once": _INSTANCEABLE,
    "push": _OPENS | _INSTANCEABLE,
    "pop": _CLOSES | _MOVES | _TURNS | _INSTANCEABLE,
    "begin polygon": _NOTHING,
    "record vertex": _NOTHING,
    "end polygon": _VISIBLE,
    "expect surface": _NOTHING,
    "draw expected surface": _VISIBLE,
    "draw surface": _VISIBLE | _INSTANCEABLE,
    "draw circle": _VISIBLE | _INSTANCEABLE,
    "draw disc": _VISIBLE | _INSTANCEABLE,
    "draw sphere": _VISIBLE | _INSTANCEABLE,
    "draw box": _VISIBLE | _INSTANCEABLE,
    "draw label": _VISIBLE,
    "begin cylinder": _LEAVES_PLANE,
    "continue cylinder": _VISIBLE | _LEAVES_PLANE,
    "end cylinder": _VISIBLE | _LEAVES_PLANE,
    "begin patch": _LEAVES_PLANE,
    "set control point": _LEAVES_PLANE,
    "draw patch": _VISIBLE | _LEAVES_PLANE,
}
"""What each action does."""
