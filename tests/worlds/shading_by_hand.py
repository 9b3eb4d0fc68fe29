"""The shading trees of K22, grown by a small interpreter that imports nothing of the kit; means stand in place of chance.

A word is a list of modules, tuples of a name and its values; a branch is a list within it. A shoot s is drawn in the plane. A
bud asks from the tip of its last shoot how many other shoots begin in a cone of 45 degrees to each side above it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

LONG, SHORT, WHERE = 100.0, 75.0, 0.7
"""The means of uniform(80,120), uniform(60,90) and uniform(0.5,0.9)."""
OLD, BEND = 8, 0.15
Word: TypeAlias = list[Any]
Place: TypeAlias = tuple[float, float]


@dataclass(frozen=True)
class Pen:
    place: Place = (0.0, 0.0)
    slant: float = 0.0
    length: float = 100.0
    start: Place | None = None
    shoot: int | None = None

    def moved(self, distance: float) -> Place:
        return self.place[0] + distance * math.sin(self.slant), self.place[1] + distance * math.cos(self.slant)


def looked(word: Word, pen: Pen, begins: list[Place], seats: list[tuple[Place, int | None]]) -> None:
    """Draw a word: note where shoots begin, and for each bud the tip from which it asks and the number of its last shoot."""
    tip = pen.place
    for module in word:
        if isinstance(module, list):
            looked(module, pen, begins, seats)
            continue
        name, *values = module
        if name == "turn":
            pen = replace(pen, slant=pen.slant + math.radians(values[0]))
        elif name == "move":
            pen = replace(pen, place=pen.moved(values[0]))
        elif name == "L":
            pen = replace(pen, length=values[0])
        elif name == "s":
            pen = replace(pen, start=pen.place, place=pen.moved(pen.length), shoot=len(begins))
            begins.append(pen.start)
        elif name == "at":
            assert pen.start is not None
            (x, z), (u, v), part = pen.start, pen.place, values[0]
            pen = replace(pen, place=(x + part * (u - x), z + part * (v - z)))
        elif name == "RV":
            pen = replace(pen, slant=math.atan2(math.sin(pen.slant), math.cos(pen.slant) + BEND))
        elif name in ("t", "b"):
            seats.append((tip, pen.shoot))
        if name in ("move", "s"):
            tip = pen.place


def sees_the_sky(seat: tuple[Place, int | None], begins: list[Place]) -> bool:
    (x, z), own = seat
    return not any(v - z > 0 and abs(u - x) <= v - z for number, (u, v) in enumerate(begins) if number != own)


def grown(word: Word, seats: Iterator[bool], most: int) -> Word:
    """The word of the next step, given for each of its buds, in their order, whether it sees the sky."""
    found: Word = []
    cut = False
    for place, module in enumerate(word):
        if isinstance(module, list):
            branch = grown(module, seats, most)
            found += [] if cut else [branch]
            continue
        free = module[0] in ("t", "b") and next(seats)
        cut = cut or module[0] == "%"
        found += [] if cut else successor(module, word[place + 1 :], free, most)
    return found


def successor(module: tuple[Any, ...], behind: Word, free: bool, most: int) -> Word:
    name, *values = module
    dead = any(other[0] == "d" for other in behind if not isinstance(other, list))
    if name == "t" and values[0] < 0:
        return [("t", values[0] + 1, 0)]
    if name == "t" and free:
        sides = [[("at", WHERE), ("turn", angle), ("z",), ("b", 0)] for angle in (60, -60)]
        return [("L", LONG), ("s", 0, 0), *sides, ("t", values[0] + 1, 0)]
    if name == "b" and free:
        return [("L", SHORT), ("s", 0, 1), ("RV",), ("b", 0)]
    if name in ("t", "b"):
        return [(name, *values[:-1], values[-1] + 1) if values[-1] < most else ("d",)]
    if name == "z" and dead:
        return [("%",)]
    if name == "T" and dead and not any(isinstance(other, list) and living(other) for other in behind):
        return [("turn", 90)]
    if name == "s" and values[0] < OLD:
        return [("s", values[0] + 1, values[1])]
    return [("%",)] if name == "s" and values[1] else [module]


def living(branch: Word) -> bool:
    return {"z", "b"} <= {module[0] for module in branch}


def shoots(word: Word) -> int:
    return sum(shoots(module) if isinstance(module, list) else module[0] == "s" for module in word)


def numbers_of_shoots(steps: int, most: int = 3, apart: float = 600, later: int = 4) -> list[list[int]]:
    """For each step from 0 on, how many shoots each of the three trees has."""
    word: Word = [
        [("T",), ("t", -later, 0)],
        [("turn", 90), ("move", apart), ("turn", -90), ("T",), ("t", 0, 0)],
        [("turn", -90), ("move", apart), ("turn", 90), ("T",), ("t", -2 * later, 0)],
    ]
    found = [[shoots(tree) for tree in word]]
    for _ in range(steps):
        begins: list[Place] = []
        seats: list[tuple[Place, int | None]] = []
        looked(word, Pen(), begins, seats)
        word = grown(word, iter([sees_the_sky(seat, begins) for seat in seats]), most)
        found.append([shoots(tree) for tree in word])
    return found
