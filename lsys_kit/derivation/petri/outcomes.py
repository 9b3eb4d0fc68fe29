"""Outcomes: what may become of a state in one step, and how likely that is.

Where a module alone decides what becomes of it, it has one outcome; where chance decides which production rewrites it, one for
each of them. All outcomes of all states together are a system's stage diagram.
"""

from __future__ import annotations

from dataclasses import dataclass

from lsys_kit.budget import check_budget
from lsys_kit.derivation.core.chance import shares
from lsys_kit.derivation.core.states import UNKNOWN, States, rule_error
from lsys_kit.notation.model.arithmetic import Value


@dataclass(frozen=True)
class Outcome:
    """What may become of a state: the place of the production in the order written, from 0 (None where a module only grows
    older), the states that replace it, how likely that is, and how long it takes (None: a step)."""

    production: int | None
    successor: tuple[int, ...]
    chance: Value = 1
    span: Value | None = None


def outcomes_of(states: States, state: int) -> tuple[Outcome, ...]:
    """What may become of a state of a system without contexts; nothing where no production matches.

    >>> from lsys_kit import read
    >>> for outcome in outcomes_of(States(read("axiom: F\\nF -> F F : 0.33\\nF -> F : 0.66")), 0):
    ...     print(outcome.production, outcome.successor, outcome.chance)
    0 (0, 0) 1/3
    1 (0,) 2/3
    """
    module = states.modules[state]
    matched = states.matching_rules(module, states.rules)
    if not matched or matched[0][0].probability is None:
        return tuple(Outcome(rule.number, states.replacement(rule, module)) for rule, _ in matched)
    lots = [(rule, weight) for rule, weight in states.weighted(matched) if weight != 0]
    try:
        likely = shares([weight for _, weight in lots] or [0])
    except ValueError as fault:
        raise rule_error(states.system, module, matched[0][0], fault) from None
    except TypeError:
        raise rule_error(states.system, module, matched[0][0], ValueError(UNKNOWN)) from None
    return tuple(
        Outcome(rule.number, states.replacement(rule, module), chance) for (rule, _), chance in zip(lots, likely, strict=True)
    )


def all_outcomes(states: States, limit: int) -> list[tuple[Outcome, ...]] | None:
    """The outcomes of all states that may be met from the axiom on; None where they are more than `limit`."""
    found: list[tuple[Outcome, ...]] = []
    while len(found) < len(states):
        if len(states) > limit:
            return None
        check_budget()
        found.append(outcomes_of(states, len(found)))
    return found
