"""Systems as Fractint has them: `Koch { Angle 6 ... }`, and what it lacks.

A system with the kit's own turtle commands becomes one for Fractint's turtle that draws the same. That turtle turns by whole
parts of a full turn, begins to the right, and moves without a stroke by `G`. So the angle is a part that also makes up the
heading, by which the axiom turns first; and letters that tell the turtle nothing are capitals that tell Fractint's nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from math import lcm
from string import ascii_uppercase

from lsys_kit.notation.dialects.fractint.systems import entries
from lsys_kit.notation.model.arithmetic import Value, literal_text, number_text
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Module, Pattern, flat
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS

NAME = "fractint"
RESERVED = frozenset("+-/\\@|!C<>[]")
"""The commands that no rule may rewrite; `F`, `G`, `D` and `M` may be rewritten."""
LONGEST = 100
"""So many digits a number may have."""
LEAST, MOST = 1, 360
"""The parts that a full turn may have."""
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


NAMELESS = "LSystem"
LONGEST_LINE = 150
"""Longer rules are parted into several for the same symbol: Fractint reads lines of less than 160 characters."""
_SYMBOL = re.compile(r"[!-$&-:<>-Z^-`|~\[\]\\]")
_COMMAND = re.compile(r"[\\/<>@C][QI]{0,2}")
_DECIMAL = re.compile(r"\d+(\.\d+)?")


def module_text(module: Module | Pattern) -> str:
    """The text of a module: a number stands directly behind its command.

    >>> module_text(Module("@IQ", (3,)))
    '@IQ3'
    """
    return module.symbol + "".join(_number_text(argument) for argument in module.arguments)


def _number_text(argument: Expression | Value) -> str:
    """A number in digits; anything else as the kit writes it."""
    if isinstance(argument, Name | Apply):
        return str(argument)
    return literal_text(argument.value if isinstance(argument, Number) else argument)


def merged_pair(modules: Iterable[Pattern]) -> tuple[Pattern, Pattern] | None:
    """The first two neighbours that would be read as one: a command, and a digit that would be in its number.

    >>> found = merged_pair((Pattern("<", (Number(1),)), Pattern("5")))
    >>> found and "".join(map(module_text, found))
    '<15'
    """
    return next(
        (
            (left, right)
            for left, right in pairwise(modules)
            if _COMMAND.fullmatch(left.symbol) and _goes_on(left, right.symbol)
        ),
        None,
    )


def _goes_on(command: Pattern, symbol: str) -> bool:
    more = "0123456789." + ("" if command.arguments or len(command.symbol) > 2 else "QI")
    return symbol in more


def system_text(system: LSystem) -> str:
    """The text of a system, under the name that it had."""
    steps = [] if system.steps is None else [f"; steps: {system.steps}"]
    body = [
        *steps,
        f"Angle {360 / Fraction(system.angle)}",
        f"Axiom {_word(system.axiom)}",
        *(line for production in system.productions for line in _rules(production)),
    ]
    return "\n".join([f"{_name(system)} {{", *(f"  {line}" for line in body), "  }"])


def _name(system: LSystem) -> str:
    found = entries(system.source) if system.notation == NAME else []
    return found[0].name or NAMELESS if found else NAMELESS


def _word(modules: Iterable[Pattern]) -> str:
    return "".join(map(module_text, modules))


def _rules(production: Production) -> Iterator[str]:
    """The lines of a rule, none of them too long."""
    line = f"{production.predecessor.symbol}="
    for module in flat(production.successor):
        text = module_text(module)
        if len(line) + len(text) > LONGEST_LINE:
            yield line
            line = f"{production.predecessor.symbol}="
        line += text
    yield line


def missing_feature(system: LSystem) -> str | None:
    """What else a system has and the notation lacks, in words."""
    return _strange_setting(system) or _strange_rule(system) or _strange_word(system)


def _strange_setting(system: LSystem) -> str | None:
    parts = 360 / Fraction(system.angle) if system.angle else Fraction(0)
    if system.turtle != NAME:
        return untranslatable(system)
    if parts.denominator != 1 or not LEAST <= parts <= MOST:
        return f"angle of {number_text(system.angle)} degrees"
    if system.heading != 0:
        return f"starting direction of {number_text(system.heading)} degrees"
    settings = {
        "length of a step": system.length,
        "seed": system.seed,
        "depth": system.decomposition_depth,
        "depth of interpretation": None if system.depth == 1 else system.depth,
    }
    return next((name for name, value in settings.items() if value is not None), None)


def _strange_rule(system: LSystem) -> str | None:
    heads = [production.predecessor for production in system.productions]
    command = next((head.symbol for head in heads if head.symbol in RESERVED), None)
    if command:
        return f'rule for the command "{command}"'
    if not system.axiom:
        return "empty axiom"
    return "two rules for one symbol" if len({head.symbol for head in heads}) < len(heads) else None


def _strange_word(system: LSystem) -> str | None:
    words: Sequence[Sequence[Pattern]] = [system.axiom, *(tuple(flat(rule.successor)) for rule in system.productions)]
    heads = [production.predecessor for production in system.productions]
    strange = next((module for module in (*heads, *(module for word in words for module in word)) if not _fits(module)), None)
    if strange:
        return f'module "{strange}"'
    pair = next(filter(None, map(merged_pair, words)), None)
    return f'word in which "{pair[1].symbol}" follows "{module_text(pair[0])}"' if pair else None


def _fits(module: Pattern) -> bool:
    """Whether a module is a symbol alone, or a command with the digits that it takes."""
    if not _COMMAND.fullmatch(module.symbol):
        return bool(_SYMBOL.fullmatch(module.symbol)) and not module.arguments
    texts = [_number_text(argument) for argument in module.arguments]
    return not texts or (len(texts) == 1 and len(texts[0]) <= LONGEST and bool(_DECIMAL.fullmatch(texts[0])))
