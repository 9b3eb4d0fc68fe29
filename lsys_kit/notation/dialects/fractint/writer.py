"""Systems as Fractint has them: `Koch { Angle 6 ... }`, and what it lacks."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import pairwise

from lsys_kit.notation.dialects.fractint.actions import LEAST, LONGEST, MOST, RESERVED
from lsys_kit.notation.dialects.fractint.systems import entries
from lsys_kit.notation.dialects.fractint.translation import NAME, untranslatable
from lsys_kit.notation.model.arithmetic import literal_text, number_text
from lsys_kit.notation.model.expressions import Expression, Number
from lsys_kit.notation.model.modules import Module, Pattern, flat
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.syntax.formatting import first_missing

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


def _number_text(argument: object) -> str:
    """A number in digits; anything else as the kit writes it."""
    value = argument.value if isinstance(argument, Number) else argument
    return str(value) if isinstance(value, Expression) else literal_text(value)  # type: ignore[arg-type]


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


def lacking(system: LSystem) -> str | None:
    """The first thing that a system has and the notation lacks, in words."""
    return (
        first_missing(
            system,
            "conditions",
            "contexts",
            "predecessors of several modules",
            "probabilities",
            "repetition",
            "constants",
            "decomposition rules",
            "meta-rules",
            "interpretation rules",
            "ignored symbols",
            "field",
        )
        or _strange_setting(system)
        or _strange_rule(system)
        or _strange_word(system)
    )


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
