"""Practice exercises about the turtle: where it stands in the end, on squared paper, and where it looks, in space."""

from __future__ import annotations

from collections.abc import Mapping
from random import Random
from string import ascii_uppercase
from typing import TypeAlias

from lsys_kit.classroom.exercises.exercise import Exercise, Option
from lsys_kit.classroom.exercises.practice.drafts import Draft, Maker
from lsys_kit.translation import gettext

# On squared paper


Place: TypeAlias = tuple[int, int]
Commands: TypeAlias = Mapping[str, str]
MISTAKEN: Mapping[str, Commands] = {
    "plus and minus swapped": {"+": "-", "-": "+"},
    "brackets dropped": {"[": "", "]": ""},
    "heading restored, place not": {"]": "h"},
    "place restored, heading not": {"]": "p"},
    "turn moves": {"+": "+F", "-": "-F"},
}
"""What somebody takes the commands for who has a misconception; h and p restore the heading alone, and the place."""


def end_of(word: str, mistaken: Commands | None = None) -> Place:
    """Where a turtle stands in the end that began at (0, 0), turned upwards, and turns by 90 degrees.

    >>> end_of("F+F"), end_of("F+F", MISTAKEN["plus and minus swapped"])
    ((-1, 1), (1, 1))
    """
    at, heading = 0j, 1j
    kept: list[tuple[complex, complex]] = []
    for symbol in "".join((mistaken or {}).get(each, each) for each in word):
        match symbol:
            case "F" | "f":
                at += heading
            case "+":
                heading *= 1j
            case "-":
                heading *= -1j
            case "[":
                kept.append((at, heading))
            case _:
                place, direction = kept.pop()
                at, heading = at if symbol == "h" else place, heading if symbol == "p" else direction
    return int(at.real), int(at.imag)


def _turtle(chance: Random, level: int, draft: Draft) -> Exercise | None:
    word = "F" + "".join(_part(chance, level) for _ in range(1 + level)) + chance.choice("+-") + "F"
    right = end_of(word)
    wrong: dict[Place, str] = {}
    for name, mistaken in MISTAKEN.items():
        wrong.setdefault(end_of(word, mistaken), name)
    if right in wrong or len(wrong) < 3:
        return None
    places = chance.sample(sorted(wrong), 3)
    expects = tuple(wrong[place] for place in places)
    places.insert(chance.randint(0, 3), right)
    options = tuple(Option(str(place), misconception=wrong.get(place, "")) for place in places)
    letter = ascii_uppercase[places.index(right)]
    return draft.exercise(letter, {"options": options, "expects": expects}, listing=word, right=right)


def _part(chance: Random, level: int) -> str:
    turn = chance.choice("+-")
    strokes = "F" * chance.randint(1, 1 + (level > 1))
    branch = f"[{turn}{strokes}{chance.choice(['', '+F', '-F']) if level > 1 else ''}]"
    return chance.choice([branch, f"{branch}F", f"{turn}{strokes}", f"F{branch}"])


# In space: turns about the turtle's own axes (ABOP, section 1.5)


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


def _heading(chance: Random, level: int, draft: Draft) -> Exercise | None:
    commands = [chance.choice("+-&^/\\") for _ in range(1 + level)]
    if not {*commands} & {*"/\\"} or {*commands} <= {*"/\\"}:
        return None
    word = "F" + "".join(command + ("F" if chance.random() < 0.5 else "") for command in commands[:-1]) + commands[-1] + "F"
    right = heading_after(word)
    without_rolls, rolled = word.replace("/", "").replace("\\", ""), word.translate(str.maketrans("/\\", "\\/"))
    wrong = zip(map(heading_after, (without_rolls, rolled, word[::-1])), draft.said["replies"], strict=True)
    others = ((vector, draft.said["again"]) for vector in chance.sample([*DIRECTIONS], 6) if vector != right)
    found: dict[Vector, str] = {}
    for vector, says in (*wrong, *others):
        found.setdefault(vector, says)
    if right in found:
        return None
    shown = [(gettext(DIRECTIONS[vector]), gettext(says)) for vector, says in [*found.items()][:3]]
    direction = gettext(DIRECTIONS[right])
    return draft.choice(chance, direction, shown, listing=word, word=word, direction=direction)


OF_TURTLES: dict[str, Maker] = {"turtle": _turtle, "space": _heading}
