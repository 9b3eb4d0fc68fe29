"""Interpretation rules: what each module of a word is drawn as, without changing the derivation (seed 002, section 7)."""

from __future__ import annotations

from collections.abc import Sequence

from lsys_kit.derivation.rules import rules_of
from lsys_kit.derivation.states import States
from lsys_kit.notation.model import CELLS, LSystem, Module


def images(states: States, numbers: Sequence[int]) -> dict[int, tuple[Module, ...]]:
    """For each of some states the modules that it is drawn as: itself, where no interpretation rule matches.

    >>> from lsys_kit.notation.read import read
    >>> states = States(read("axiom: A(2)[B]\\ninterpretation:\\nA(t) -> F(t) F(1)"))
    >>> {str(states.modules[s]): " ".join(map(str, image)) for s, image in images(states, states.axiom).items()}
    {'A(2)': 'F(2) F(1)', '[': '[', 'B': 'B', ']': ']'}
    """
    rules = rules_of(states.system, states.arithmetic, interpretation=True)
    found: dict[int, tuple[Module, ...]] = {}
    for state in dict.fromkeys(numbers):
        module = states.modules[state]
        rule = states.matching(module, rules)
        found[state] = (module,) if rule is None else tuple(Module(*made) for made in states.made(rule, module))
    return found


def is_filament(system: LSystem) -> bool:
    """Whether a system is drawn as cells in a row: every interpretation rule makes cells with a length and a width.

    >>> from lsys_kit.notation.read import read
    >>> is_filament(read("axiom: a\\ninterpretation:\\na -> R(2,1)"))
    True
    """
    made = [module for rule in system.interpretation for module in rule.successor]
    return bool(made) and all(module.symbol in CELLS and len(module.arguments) >= 2 for module in made)
