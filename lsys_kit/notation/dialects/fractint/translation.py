"""A system with the kit's own turtle commands as one for Fractint's turtle, which draws the same.

Fractint's turtle turns by whole parts of a full turn, begins to the right, and moves without a stroke by `G`. So the angle is
a part that also makes up the heading, by which the axiom turns first; and letters that tell the turtle nothing are capitals
that tell Fractint's nothing.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from math import lcm
from string import ascii_uppercase

from lsys_kit.notation.dialects.fractint.actions import MOST
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.modules import Pattern, flat
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS

NAME = "fractint"
_TURNS = "+-"
_SAME: Mapping[str, str] = {"F": "F", "f": "G", "|": "|", "[": "[", "]": "]"}
_FREE = [letter for letter in ascii_uppercase if letter not in "FGDMC"]
"""The letters that tell Fractint's turtle nothing."""
_MOST_TURNS = 12
"""So many parts of a turn one sign may be at most."""


@dataclass(frozen=True)
class _Turning:
    """The parts of a full turn, how many of them `+` turns by, and how many the heading is."""

    parts: int
    turn: int
    start: int


def translated(system: LSystem) -> LSystem:
    """A system for Fractint's turtle that draws the same; the system itself where there is none, or where it is one.

    >>> from lsys_kit.notation.read import read
    >>> koch = translated(read("angle: 60\\naxiom: F\\nF -> F+f x-F"))
    >>> int(koch.angle), "".join(map(str, koch.axiom)), str(koch.productions[0])
    (30, '+++F', 'F -> F++G X--F')
    """
    if system.turtle != "abop" or untranslatable(system):
        return system
    turning, letters = _turning(system), {**_SAME, **_letters(system)}

    def word(modules: Iterable[Pattern]) -> Iterator[Pattern]:
        for module in modules:
            if module.symbol in _TURNS:
                yield from _turns(turning.turn if module.symbol == "+" else -turning.turn)
            else:
                yield replace(module, symbol=letters[module.symbol])

    def rule(production: Production) -> Production:
        return replace(
            production, predecessors=tuple(word(production.predecessors)), successor=tuple(word(flat(production.successor)))
        )

    return replace(
        system,
        turtle=NAME,
        heading=0,
        angle=Fraction(360, turning.parts),
        alphabet=(),
        axiom=(*_turns(turning.start), *word(system.axiom)),
        productions=tuple(map(rule, system.productions)),
    )


def untranslatable(system: LSystem) -> str | None:
    """What Fractint's turtle lacks of a system with other turtle commands, in words."""
    if system.turtle != "abop":
        return f"turtle commands of {TURTLE_DIALECTS[system.turtle].title}"
    strange = next(
        (
            module
            for module in system.modules
            if module.arguments or not (module.symbol in _SAME or module.symbol in _TURNS or module.symbol in _LETTERS)
        ),
        None,
    )
    if strange:
        return f'module "{strange}"'
    head = next((rule.predecessor.symbol for rule in system.productions if rule.predecessor.symbol in "+-|"), None)
    if head:
        return f'rule for the command "{head}"'
    if len(_others(system)) > len(_FREE):
        return f"more letters than {len(_FREE)}"
    turning = _turning(system)
    if turning.parts > MOST or abs(turning.turn) > _MOST_TURNS:
        return f"angle of {number_text(system.angle)} with a heading of {number_text(system.heading)} degrees"
    return None


_LETTERS = {letter for letter in (*ascii_uppercase, *ascii_uppercase.lower()) if letter not in "FfGg"}
"""The letters that tell the kit's own turtle nothing."""


def _others(system: LSystem) -> list[str]:
    """The letters of a system that tell the turtle nothing; first those that tell Fractint's nothing either."""
    return sorted({module.symbol for module in system.modules} - _SAME.keys() - {*_TURNS}, key=lambda x: (x not in _FREE, x))


def _letters(system: LSystem) -> dict[str, str]:
    """A capital for each such letter: its own, where that is free."""
    found: dict[str, str] = {}
    for letter in _others(system):
        free = [other for other in _FREE if other not in found.values()]
        found[letter] = letter.upper() if letter.upper() in free else free[-1]
    return found


def _turning(system: LSystem) -> _Turning:
    """How Fractint's turtle turns as the system's does: "|" is half a turn where a full one has an even number of parts."""
    turns = [Fraction(degrees) / 360 for degrees in (system.angle, system.heading)]
    parts = lcm(*(turn.denominator for turn in turns))
    if parts % 2 and any(module.symbol == "|" for module in system.modules):
        parts *= 2
    turn, start = (_shortest(int(turn * parts), parts) for turn in turns)
    return _Turning(parts, turn, start)


def _shortest(turn: int, parts: int) -> int:
    """A turn by the shorter way.

    >>> _shortest(3, 4), _shortest(-2, 8), _shortest(4, 8)
    (-1, -2, 4)
    """
    rest = turn % parts
    return rest if 2 * rest <= parts else rest - parts


def _turns(count: int) -> tuple[Pattern, ...]:
    return (Pattern("+" if count > 0 else "-"),) * abs(count)
