"""Interpretation rules: what each module of a word is drawn as, without changing the derivation (Prusinkiewicz,
Introduction to Modeling with L-systems, section 7)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lsys_kit.derivation.core.chance import Chance
from lsys_kit.derivation.core.rules import rules_of
from lsys_kit.derivation.core.states import States
from lsys_kit.notation.model.modules import CELLS, WALL, Module, Pattern, flat
from lsys_kit.notation.model.system import LSystem


def interpretations(states: States, numbers: Sequence[int]) -> dict[int, tuple[Module, ...]]:
    """For each of some states the modules that it is drawn as: itself, where no interpretation rule matches.

    >>> from lsys_kit.notation.read import read
    >>> states = States(read("axiom: A(2)[B]\\ninterpretation:\\nA(t) -> F(t) F(1)"))
    >>> {str(states.modules[s]): " ".join(map(str, drawn)) for s, drawn in interpretations(states, states.axiom).items()}
    {'A(2)': 'F(2) F(1)', '[': '[', 'B': 'B', ']': ']'}
    """
    if not states.system.interpretation:
        return {state: (states.modules[state],) for state in dict.fromkeys(numbers)}
    return {state: interpretation_of(states, states.modules[state]) for state in dict.fromkeys(numbers)}


def interpretation_of(states: States, module: Module) -> tuple[Module, ...]:
    """The modules that a module is drawn as."""
    return tuple(_image(states, module, states.system.depth))


def _image(states: States, module: Module, depth: int) -> Iterator[Module]:
    """What a module is drawn as; what that consists of is interpreted in turn, `depth` times in all."""
    rules = rules_of(states.system, states.arithmetic, "interpretation")
    chance = Chance(0, 0, 0)
    rule = states.matching_rule(module, rules, chance) if depth else None
    if rule is None:
        yield module
        return
    for made in states.apply(rule, module, None, chance):
        yield from _image(states, Module(*made), depth - 1)


def is_cell(made: Module | Pattern) -> bool:
    """Whether what a module is drawn as is a cell: with a length and a width.

    >>> is_cell(Module("L", (2, 1))), is_cell(Module("L"))
    (True, False)
    """
    return made.symbol in CELLS and len(made.arguments) >= 2


def is_filament(system: LSystem) -> bool:
    """Whether a system is drawn as cells in a row: its interpretation makes cells with a length and a width, perhaps walls.

    >>> from lsys_kit.notation.read import read
    >>> is_filament(read("axiom: a\\ninterpretation:\\na -> R(2,1)"))
    True
    """
    made = [module for rule in system.interpretation for module in flat(rule.successor) if module.symbol != WALL]
    return bool(made) and all(map(is_cell, made))
