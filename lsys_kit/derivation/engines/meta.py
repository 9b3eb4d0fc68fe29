"""Meta-rules: a word is shortened after a step, until no meta-rule applies (Kurth, lecture slides, on sessile organisms)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of, rule_for
from lsys_kit.derivation.core.states import States
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.system import LSystem, Production


@lru_cache(maxsize=64)
def meta_rules(system: LSystem, arithmetic: str) -> tuple[tuple[tuple[ModuleKind, ...], Rule], ...]:
    """The meta-rules of a system: the kinds of the modules that each replaces, and the rule that replaces them.

    All modules but the last are treated like the left context of a production.
    """
    found = []
    for number, meta in enumerate(system.meta):
        *before, last = meta.predecessors
        production = Production((last,), meta.successor, meta.condition, left=tuple(before), at=meta.at)
        found.append((tuple(map(kind_of, meta.predecessors)), rule_for(system, number, production, arithmetic)))
    return tuple(found)


def apply_meta_rules(states: States, codes: Sequence[int]) -> tuple[list[int], list[int]]:
    """A word after its meta-rules, and for each module of it the position of the first module that it stands for.

    >>> from lsys_kit.notation.read import read
    >>> states = States(read("axiom: f(1) f(2) f(3) A\\nmeta: f(x) f(y) -> f(x+y)"))
    >>> codes, origins = apply_meta_rules(states, states.axiom)
    >>> [str(states.modules[code]) for code in codes], origins
    (['f(6)', 'A'], [0, 3])
    """
    rules = meta_rules(states.system, states.arithmetic)
    done: list[int] = []
    origins: list[int] = []
    for position, code in enumerate(codes):
        todo = [code]
        while todo:
            done.append(todo.pop())
            origins.append(position)
            made = _applied(states, rules, done)
            if made is not None:
                size, successor = made
                position_of_first = origins[-size]
                del done[-size:], origins[-size:]
                todo += reversed(successor)
                position = position_of_first
    return done, origins


def _applied(
    states: States, rules: Sequence[tuple[tuple[ModuleKind, ...], Rule]], done: Sequence[int]
) -> tuple[int, tuple[int, ...]] | None:
    """How many of the last modules the first matching meta-rule takes, and what it makes of them."""
    for kinds, rule in rules:
        last = [states.modules[code] for code in done[-len(kinds) :]]
        if tuple(map(kind_of, last)) != kinds:
            continue
        values: tuple[Value, ...] = tuple(value for module in last for value in module.arguments)
        if states.matches(rule, values, last[-1]):
            return len(kinds), states.applied_states(rule, last[-1], values)
    return None
