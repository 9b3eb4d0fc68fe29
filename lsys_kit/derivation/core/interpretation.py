"""Interpretation rules: what each module of a word is drawn as, without changing the derivation (Prusinkiewicz,
Introduction to Modeling with L-systems, section 7)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Sized
from itertools import islice
from typing import TypeVar

from lsys_kit.budget import INTERVAL, counted, current
from lsys_kit.derivation.core.chance import Chance
from lsys_kit.derivation.core.letters import numbered
from lsys_kit.derivation.core.rules import rules_of
from lsys_kit.derivation.core.states import MODULES_BETWEEN_CHECKS, States, popped
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model.modules import CELLS, WALL, Module, Pattern, flat
from lsys_kit.notation.model.system import LSystem

_T = TypeVar("_T")


def interpretations(states: States, numbers: Sequence[int]) -> dict[int, tuple[Module, ...]]:
    """For each of some states the modules that it is drawn as, with numbers for formulas: itself, where no interpretation rule
    matches.

    >>> from lsys_kit import read
    >>> states = States(read("axiom: A(2)[B]\\ninterpretation:\\nA(t) -> F(t) F(1)"))
    >>> {str(states.modules[s]): " ".join(map(str, drawn)) for s, drawn in interpretations(states, states.axiom).items()}
    {'A(2)': 'F(2) F(1)', '[': '[', 'B': 'B', ']': ']'}
    """
    states = numbered(states)
    if not states.system.interpretation:
        return {state: (states.modules[state],) for state in dict.fromkeys(numbers)}
    found: dict[int, tuple[Module, ...]] = {}
    size, most = 0, current().modules
    for state in counted(dict.fromkeys(numbers), MODULES_BETWEEN_CHECKS):
        found[state] = interpretation_of(states, states.modules[state])
        size += len(found[state])
        if size > most:
            raise ModelLimitError(
                f"The modules are drawn as more than {most:,} different ones",
                limit=most,
                needed=size,
                hint="Use smaller numbers of repetitions, or a smaller depth.",
            )
    return found


def interpretation_of(states: States, module: Module) -> tuple[Module, ...]:
    rules = rules_of(states.system, states.arithmetic, "interpretation")
    found: list[Module] = []
    todo = [(module, states.system.depth)]
    for part, depth in counted(popped(todo), MODULES_BETWEEN_CHECKS):
        chance = Chance(0, 0, 0)
        rule = states.matching_rule(part, rules, chance) if depth else None
        if rule is None:
            found.append(part)
        else:
            made = _bounded(states.apply(rule, part, None, chance), len(found) + len(todo), module)
            todo += [(Module(*each), depth - 1) for each in reversed(made)]
    return tuple(found)


def _bounded(made: Iterable[_T], already: int, module: Module) -> list[_T]:
    """What a module is drawn as, if it is not too much."""
    most = current().interpretation
    taken = list(islice(made, max(0, most - already) + 1))
    if already + len(taken) > most:
        raise ModelLimitError(
            f"{module} is drawn as more than {most:,} modules",
            limit=most,
            hint="Use smaller numbers of repetitions, or a smaller depth.",
        )
    return taken


def modules_between_checks(images: Iterable[Sized]) -> int:
    """After how many modules of a word to look at the budget, given what its modules are drawn as.

    >>> modules_between_checks([]), modules_between_checks(["", "abcd"]), modules_between_checks([range(10**6)])
    (1024, 256, 1)
    """
    return max(1, INTERVAL // max((1, *map(len, images))))


def is_cell(made: Module | Pattern) -> bool:
    """Whether what a module is drawn as is a cell: with a length and a width.

    >>> is_cell(Module("L", (2, 1))), is_cell(Module("L"))
    (True, False)
    """
    return made.symbol in CELLS and len(made.arguments) >= 2


def is_filament(system: LSystem) -> bool:
    """Whether a system is drawn as cells in a row: its interpretation makes cells with a length and a width, perhaps walls.

    >>> from lsys_kit import read
    >>> is_filament(read("axiom: a\\ninterpretation:\\na -> R(2,1)"))
    True
    """
    made = [module for rule in system.interpretation for module in flat(rule.successor) if module.symbol != WALL]
    return bool(made) and all(map(is_cell, made))
