"""Practice exercises about the turtle in space: where it looks after turns about its own axes (ABOP, section 1.5)."""

from __future__ import annotations

from collections.abc import Mapping
from random import Random
from typing import TypeAlias

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.practice.drafts import Topic, choice_exercise, quoted_lines
from lsys_kit.translation import gettext

Vector: TypeAlias = tuple[int, int, int]
Axes: TypeAlias = tuple[Vector, Vector, Vector]
"""The turtle's heading, its left and its up."""
START: Axes = (0, 0, 1), (-1, 0, 0), (0, -1, 0)
"""It looks upwards, its left is the viewer's left, and its back is turned to the viewer."""
DIRECTIONS: Mapping[Vector, str] = {
    (0, 0, 1): "upwards",
    (0, 0, -1): "downwards",
    (-1, 0, 0): "to the left",
    (1, 0, 0): "to the right",
    (0, -1, 0): "towards you",
    (0, 1, 0): "away from you",
}
"""x grows to the right, y away from the viewer, z upwards."""
AGAIN = "Turn a pencil with a flag, command by command."
"""The reply to a direction that nothing explains."""


def _opposite(vector: Vector) -> Vector:
    x, y, z = vector
    return -x, -y, -z


def turned(axes: Axes, command: str) -> Axes:
    """The axes after a turn by 90 degrees: + and - about the up, & and ^ about the left, \\ and / about the heading.

    >>> DIRECTIONS[turned(START, "+")[0]], DIRECTIONS[turned(START, "&")[0]], turned(START, "/")[0] == START[0]
    ('to the left', 'away from you', True)
    """
    heading, left, up = axes
    return {
        "+": (left, _opposite(heading), up),
        "-": (_opposite(left), heading, up),
        "&": (_opposite(up), left, heading),
        "^": (up, left, _opposite(heading)),
        "\\": (heading, _opposite(up), left),
        "/": (heading, up, _opposite(left)),
    }[command]


def heading_after(word: str) -> Vector:
    """The heading of the turtle behind a word."""
    axes = START
    for symbol in word.replace("F", ""):
        axes = turned(axes, symbol)
    return axes[0]


def _heading(chance: Random, level: int) -> Exercise | None:
    commands = [chance.choice("+-&^/\\") for _ in range(1 + level)]
    if not {*commands} & {*"/\\"} or {*commands} <= {*"/\\"}:
        return None
    word = "F" + "".join(command + ("F" if chance.random() < 0.5 else "") for command in commands[:-1]) + commands[-1] + "F"
    right = heading_after(word)
    wrong = [
        (
            heading_after(word.replace("/", "").replace("\\", "")),
            gettext("A roll leaves the heading as it is, but turns the axes of the turns that follow."),
        ),
        (heading_after(word.translate(str.maketrans("/\\", "\\/"))), gettext("To which side does it roll?")),
        (heading_after(word[::-1]), gettext("Take the commands in the order in which they are written.")),
    ]
    found: dict[Vector, str] = {}
    for vector, says in (*wrong, *((vector, AGAIN) for vector in chance.sample([*DIRECTIONS], 6) if vector != right)):
        found.setdefault(vector, says)
    if right in found:
        return None
    shown = [(gettext(DIRECTIONS[vector]), gettext(says)) for vector, says in [*found.items()][:3]]
    return choice_exercise(
        chance,
        gettext(
            "A turtle in space looks upwards, and you look at its back. Its own axes are its heading, its left "
            "and its up, which points to you; all turns are by 90 degrees. + and - turn it to its left and "
            "right, & and ^ pitch it down (away from its up) and up, \\ and / roll it to its left and right "
            "about its heading.{listing}In which direction is the last stroke?",
            listing=quoted_lines(word),
        ),
        gettext(DIRECTIONS[right]),
        shown,
        gettext(
            "Behind {word} it looks {direction}: each turn is about the axes that the turns before have left.",
            word=word,
            direction=gettext(DIRECTIONS[right]),
        ),
        (
            gettext("Take a pencil for the heading, with a flag on it for the up."),
            gettext("A roll does not change where the pencil points, but the flag."),
            gettext("Each turn is about the axes of the turtle as they are then, not about those of the room."),
        ),
    )


OF_SPACE = {"space": Topic("The turtle in space", 13, _heading)}
"""In the order of the lessons."""
