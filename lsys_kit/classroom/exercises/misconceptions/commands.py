"""Misconceptions about turtle commands, brackets and angles: from a system to those that draw something else."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from lsys_kit.classroom.exercises.misconceptions.systems import rewritten
from lsys_kit.notation.model.modules import CLOSING, OPENING, Item, Pattern
from lsys_kit.notation.model.system import LSystem

_OPPOSITE = {"+": "-", "-": "+", "/": "\\", "\\": "/", "&": "^", "^": "&"}
_OTHER_BRACKET = {"[": "(", "]": ")", "(": "[", ")": "]"}


def _spelt(system: LSystem, symbols: dict[str, str]) -> Iterator[LSystem]:
    def changed(items: Sequence[Item]) -> tuple[Item, ...]:
        return tuple(
            replace(item, symbol=symbols.get(item.symbol, item.symbol)) if isinstance(item, Pattern) else item for item in items
        )

    yield from rewritten(system, lambda rule: replace(rule, successor=changed(rule.successor)), changed)


def signs_swapped(system: LSystem) -> Iterator[LSystem]:
    """+ for -, and the other way round."""
    yield from _spelt(system, _OPPOSITE)


def bracket_sides_swapped(system: LSystem) -> Iterator[LSystem]:
    """[ ] for ( ) in a plant string, where they are branches to the two sides."""
    if system.notation == "plant-string":
        yield from _spelt(system, _OTHER_BRACKET)


def pen_up(system: LSystem) -> Iterator[LSystem]:
    """f for F: moved without drawing, or drawn where nothing should be."""
    yield from _spelt(system, {"f": "F"})
    yield from _spelt(system, {"F": "f"})


def brackets_dropped(system: LSystem) -> Iterator[LSystem]:
    """Branches drawn as parts of their stem: as if the turtle never returned."""

    def changed(items: Sequence[Item]) -> tuple[Item, ...]:
        return tuple(item for item in items if not (isinstance(item, Pattern) and item.symbol in OPENING | CLOSING))

    yield from rewritten(system, lambda rule: replace(rule, successor=changed(rule.successor)), changed)


def angle_supplement(system: LSystem) -> Iterator[LSystem]:
    """The angle between two strokes in place of that by which the turtle turns."""
    yield replace(system, angle=180 - system.angle, source="")


def angle_halved_or_doubled(system: LSystem) -> Iterator[LSystem]:
    """The angle of the whole fork in place of that of one side, or half of it."""
    yield replace(system, angle=2 * system.angle, source="")
    yield replace(system, angle=system.angle / 2, source="")
