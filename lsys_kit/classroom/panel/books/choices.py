"""What chance may make of each state, as a book holds it: with it the browser throws the dice itself, at any seed.

That is possible where a module alone decides among which productions is chosen, and how likely each is (S0L systems). What is
thrown is what a derivation throws: the browser has its generator (`books/chance.js`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import NamedTuple

from lsys_kit.budget import check_budget
from lsys_kit.derivation.core.chance import stretches
from lsys_kit.derivation.core.states import States
from lsys_kit.errors import LSystemError

MOST_STATES = 1_000
"""Of systems with more states a book holds the words at one seed."""


class Choice(NamedTuple):
    """What may become of a state: where the stretches of the productions end, how long all are together, and for each
    production its number, -1 for none, and the states that it makes; none of one that is never chosen."""

    ends: Sequence[float]
    total: float
    productions: Sequence[int]
    successors: Sequence[tuple[int, ...]]


LAST = Choice((), 1.0, (), ())
"""Nothing is said of what becomes of a state."""


def choices_of(states: States, steps: int) -> Mapping[int, Choice]:
    """What may become of all states that can be met in so many steps, nothing of those of the last step; none at all where more
    than the state decides, where no chance does, or where something that may come has no value.

    >>> from lsys_kit import read
    >>> choices_of(States(read("axiom: F\\nF -> F F : 1\\nF -> G : 3")), 2)[0]
    Choice(ends=(1.0,), total=4.0, productions=(0, 1), successors=((0, 0), (1,)))
    """
    found: dict[int, Choice] = {}
    if states.traits.d0l or not states.traits.s0l:
        return found
    new = {*states.axiom}
    try:
        for _ in range(steps):
            found.update((state, _choice(states, state)) for state in sorted(new))
            new = {after for state in new for row in found[state].successors for after in row} - found.keys()
            if len(found) + len(new) > MOST_STATES:
                return {}
            check_budget()
    except LSystemError:
        return {}
    return {**found, **dict.fromkeys(new, LAST)}


def _choice(states: States, state: int) -> Choice:
    module = states.modules[state]
    matched = states.matching_rules(module, states.rules)
    states.choose_rule(matched, None)  # refuses weights that are none
    likely = states.weighted(matched)
    if len(likely) < 2:
        rule = matched[0][0] if matched else None
        row = states.decompose(module) if rule is None else states.replacement(rule, module)
        return Choice((), 1.0, (-1 if rule is None else rule.number,), (row,))
    ends, total = stretches([weight for _, weight in likely])
    rows = [states.replacement(rule, module) if weight else () for rule, weight in likely]
    return Choice(tuple(filter(isfinite, ends)), total, tuple(rule.number for rule, _ in likely), tuple(rows))
