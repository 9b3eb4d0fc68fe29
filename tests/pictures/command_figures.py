"""Models that show what commands of GROGRA do to the turtle: its axes before and after, as on W. Kurth's lecture slides.

Every part of these figures is drawn by the turtle itself: an axis is a stroke with a head, a letter some strokes in the plane
of the picture. H, L and U stand for the axes head, left and up.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from lsys_kit import read
from lsys_kit.notation.model.system import LSystem

Line = Sequence[tuple[float, float]]
LETTERS: dict[str, tuple[Line, ...]] = {
    "H": (((0, 0), (0, 1)), ((0, 0.5), (0.6, 0.5)), ((0.6, 1), (0.6, 0))),
    "L": (((0, 1), (0, 0), (0.5, 0)),),
    "U": (((0, 1), (0, 0.2), (0.15, 0), (0.45, 0), (0.6, 0.2), (0.6, 1)),),
    "λ": (((0, 1), (0.13, 1), (0.6, 0)), ((0.31, 0.6), (0, 0))),
    "g": (
        ((0.5, 0.6), (0.3, 0.65), (0.1, 0.55), (0, 0.35), (0.1, 0.1), (0.3, 0), (0.5, 0.1)),
        ((0.5, 0.65), (0.5, -0.2), (0.35, -0.35), (0.1, -0.3)),
    ),
    "α": (((0.7, 0.65), (0.5, 0.1), (0.3, 0), (0.1, 0.1), (0, 0.3), (0.1, 0.55), (0.3, 0.65), (0.5, 0.55), (0.7, 0)),),
}
"""The lines of letters, to the right and up from their lower left corners."""
BLUE, GREEN, RED, BROWN, GREY, DARK = 1, 2, 4, 6, 7, 8
"""Colours of GROGRA."""
PULL = 0.6
"""How far `RV` bends in its figure."""
ARROW = "[RU(155) F(16)] [RU(-155) F(16)]"


def letter(name: str, x: float, y: float, size: float = 20) -> str:
    """A letter to the right of the turtle and above it, where the turtle's head points up and its left to the right."""
    lines = [[(x + size * u, y + size * v) for u, v in line] for line in LETTERS[name]]
    return " ".join(f"[{_way((0, 0), line[0], 'f')} {' '.join(_way(*ends, 'F') for ends in pairwise(line))}]" for line in lines)


def _way(start: tuple[float, float], end: tuple[float, float], command: str) -> str:
    across, up = end[0] - start[0], end[1] - start[1]
    turn = math.degrees(math.atan2(across, up))
    return f"RU({turn:.3f}) {command}({math.hypot(across, up):.3f}) RU({-turn:.3f})"


def axis(turn: str, back: str, colour: int, name: str, x: float, y: float) -> str:
    """An axis of the turtle with its letter, which stands upright whatever the turns are."""
    return f"[{turn} P({colour}) D(4) F(100) {ARROW} {back} D(2) P({colour}) {letter(name, x, y)}]"


def _model(*lines: str) -> LSystem:
    return read("\n".join(["turtle: grogra", *lines]))


def stroke() -> LSystem:
    """`F` draws a stroke, as long as the step λ."""
    axes = axis("", "", BLUE, "H", 8, -12) + axis("RU(90)", "RU(-90)", RED, "L", -10, 12)
    end = "[RU(90) F(12)] [RU(-90) F(12)]"
    measure = f"P({GREY}) D(1.5) RU(-90) f(24) RU(90) {end} RU(180) F(180) {end}"
    return _model(
        "axiom: T",
        "T -> F T",
        "interpretation:",
        f"T -> {axes}",
        f"F -> P({BROWN}) D(14) F(180) [{measure} RU(180) f(90) P({DARK}) D(2) {letter('λ', -32, -10)}]",
    )


def roll() -> LSystem:
    """`RH` turns left and up around head, by an angle α."""
    arc = (
        f"[RH(-a) P({GREY}) D(1.5) [RU(90) F(100)] RU(90) f(60) RL(-90 - a/20) P({DARK}) D(2) "
        "repeat(10) <F(120*sin(a/20)) RL(-a/10)>]"
    )
    axes = (
        axis("", "", BLUE, "H", 8, -12)
        + axis("RU(90)", "RU(-90) RH(-a)", RED, "L", -4, 14)
        + axis("RL(-90)", "RL(90) RH(-a)", GREEN, "U", 4, 10)
    )
    mark = f"[RH(-a/2) RU(90) f(74) RU(-90) RH(-a/2) D(2) P({DARK}) {letter('α', -4, -6)}]"
    return _model(
        "axiom: T(0)", "T(a) -> RH(50) T(a + 50)", "interpretation:", f"T(a) : a > 0 -> {arc} {mark} {axes}", f"T(a) -> {axes}"
    )


def bend() -> LSystem:
    """`RV` bends head down: to the direction of the sum of head and a vector that points down, g long."""
    first = 30.0
    second = _bent(first)
    sum = f"[P({GREY}) D(2) F(100) RG P({RED}) D(4) F({100 * PULL}) {ARROW} RU(180) f(30) D(2) {letter('g', 8, -6)}]"
    return _model(
        f"axiom: RU({first}) T({first})",
        f"T(a) : a == {first} -> B T({second})",
        f"T(a) -> B T({_bent(second)})",
        "interpretation:",
        f"T(a) -> [P({BLUE}) D(4) F(100) {ARROW} RU(-a) D(2) {letter('H', 8, -4)}]",
        f"B -> {sum} RV({PULL})",
    )


def _bent(angle: float) -> float:
    """How far from the vertical, in degrees, a head points after it has been bent down: three decimals."""
    return round(math.degrees(math.atan2(math.sin(math.radians(angle)), math.cos(math.radians(angle)) - PULL)), 3)
