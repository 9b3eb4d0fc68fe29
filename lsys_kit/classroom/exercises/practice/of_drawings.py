"""Practice exercises about the turtle: where it stands in the end, in one's mind or on squared paper."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from random import Random
from string import ascii_uppercase
from typing import TypeAlias

from lsys_kit.classroom.exercises.exercise import Exercise, Option
from lsys_kit.classroom.exercises.practice.drafts import Topic, quoted_lines
from lsys_kit.translation import gettext

Place: TypeAlias = tuple[int, int]


@dataclass
class _Turtle:
    """A turtle on squared paper: its place, its heading, and what it keeps at brackets."""

    at: Place = (0, 0)
    heading: Place = (0, 1)
    kept: list[tuple[Place, Place]] = field(default_factory=list)


def _forward(turtle: _Turtle) -> None:
    (x, y), (right, up) = turtle.at, turtle.heading
    turtle.at = x + right, y + up


def _left(turtle: _Turtle) -> None:
    right, up = turtle.heading
    turtle.heading = -up, right


def _right(turtle: _Turtle) -> None:
    right, up = turtle.heading
    turtle.heading = up, -right


def _keep(turtle: _Turtle) -> None:
    turtle.kept.append((turtle.at, turtle.heading))


def _return(turtle: _Turtle) -> None:
    turtle.at, turtle.heading = turtle.kept.pop()


def _return_to_heading(turtle: _Turtle) -> None:
    turtle.heading = turtle.kept.pop()[1]


def _return_to_place(turtle: _Turtle) -> None:
    turtle.at = turtle.kept.pop()[0]


def _turn_and_move(turn: Callable[[_Turtle], None]) -> Callable[[_Turtle], None]:
    def act(turtle: _Turtle) -> None:
        turn(turtle)
        _forward(turtle)

    return act


def _nothing(_: _Turtle) -> None:
    pass


Commands: TypeAlias = Mapping[str, Callable[[_Turtle], None]]
RIGHT: Commands = {"F": _forward, "f": _forward, "+": _left, "-": _right, "[": _keep, "]": _return}
MISTAKEN: Mapping[str, Commands] = {
    "plus and minus swapped": {"+": _right, "-": _left},
    "brackets dropped": {"[": _nothing, "]": _nothing},
    "heading restored, place not": {"]": _return_to_heading},
    "place restored, heading not": {"]": _return_to_place},
    "turn moves": {"+": _turn_and_move(_left), "-": _turn_and_move(_right)},
}
"""What somebody takes the commands for who has a misconception."""


def end_of(word: str, mistaken: Commands | None = None) -> Place:
    """Where a turtle stands in the end that began at (0, 0), turned upwards, and turns by 90 degrees.

    >>> end_of("F+F"), end_of("F+F", MISTAKEN["plus and minus swapped"])
    ((-1, 1), (1, 1))
    """
    turtle, commands = _Turtle(), {**RIGHT, **(mistaken or {})}
    for symbol in word:
        commands[symbol](turtle)
    return turtle.at


def _turtle(chance: Random, level: int) -> Exercise | None:
    word = "F" + "".join(_part(chance, level) for _ in range(1 + level)) + chance.choice("+-") + "F"
    right = end_of(word)
    wrong: dict[Place, str] = {}
    for name, mistaken in MISTAKEN.items():
        wrong.setdefault(end_of(word, mistaken), name)
    if right in wrong or len(wrong) < 3:
        return None
    places = chance.sample(sorted(wrong), 3)
    places.insert(chance.randint(0, 3), right)
    options = tuple(Option(str(place), misconception=wrong.get(place, "")) for place in places)
    return Exercise(
        "",
        "",
        "choice",
        gettext(
            "A turtle begins at (0, 0), its heading upwards. F moves it one square forward, + turns it "
            "90 degrees to the left, - to the right. Draw this by hand:{listing}Where does the turtle "
            "stand in the end?",
            listing=quoted_lines(word),
        ),
        ascii_uppercase[places.index(right)],
        gettext("It stands at {right}: at ] it returns to where it was at [, and to its heading there.", right=right),
        (
            gettext("Draw it on squared paper, and mark where the turtle looks."),
            gettext("+ and - turn on the spot."),
            gettext("At [ note the place and the heading; at ] go back to both."),
        ),
        options=options,
        expects=tuple(wrong[place] for place in places if place != right),
    )


def _part(chance: Random, level: int) -> str:
    turn = chance.choice("+-")
    strokes = "F" * chance.randint(1, 1 + (level > 1))
    branch = f"[{turn}{strokes}{chance.choice(['', '+F', '-F']) if level > 1 else ''}]"
    return chance.choice([branch, f"{branch}F", f"{turn}{strokes}", f"F{branch}"])


OF_DRAWINGS = {"turtle": Topic("The turtle", 4, _turtle)}
"""In the order of the lessons."""
