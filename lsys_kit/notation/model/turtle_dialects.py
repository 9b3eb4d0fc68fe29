"""The dialects of turtle commands: whose commands the symbols of a system are.

All that distinguishes the turtle of one program from that of another stands here and in the table of commands, where each
dialect has a column. To add a dialect, add a record here, a column there, and its name to the grammars that let a text choose
its turtle.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class TurtleDialect:
    """A dialect of turtle commands.

    Attributes
    ----------
    name
        Its name in models, as in `turtle: grogra`.
    title
        Its name in a sentence: "turtle commands of GROGRA".
    length
        How far one step goes, where the system does not say.
    left
        Where the left of the turtle points in the picture at the start: 1 to the left of its heading, -1 to the right.
    width, pixels
        The width of strokes for commands that change it, where none has been set; whether widths are in pixels, where the
        system does not say.
    any_sign
        Whether any sign may be a symbol without a meaning, like a letter.
    names
        Whether commands have names of several letters.
    """

    name: str
    title: str
    length: float = 1.0
    left: int = 1
    width: float = 0.1
    pixels: bool = False
    any_sign: bool = False
    names: bool = False

    @property
    def column(self) -> str:
        """The name of its column in the table of commands.

        >>> TURTLE_DIALECTS["plant-string"].column
        'plant_string'
        """
        return self.name.replace("-", "_")


TURTLE_DIALECTS: Mapping[str, TurtleDialect] = {
    dialect.name: dialect
    for dialect in (
        TurtleDialect("abop", "The Algorithmic Beauty of Plants", width=2.4, pixels=True),
        TurtleDialect("grogra", "GROGRA", length=100.0, left=-1, names=True),
        TurtleDialect("plant-string", "plant strings"),
        TurtleDialect("fractint", "Fractint", any_sign=True),
    )
}
"""All dialects of turtle commands, by name."""


def quoted_dialects(conjunction: str) -> str:
    """The names of all dialects, in a sentence.

    >>> quoted_dialects("or")
    '"abop", "grogra", "plant-string" or "fractint"'
    """
    *names, last = (f'"{name}"' for name in TURTLE_DIALECTS)
    return f"{', '.join(names)} {conjunction} {last}"
