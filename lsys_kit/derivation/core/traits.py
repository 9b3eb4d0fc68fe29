"""Traits: what a system has that decides how it can be derived, counted and drawn as a stage diagram.

Lindenmayer systems are classified by what a module's rewriting depends on (Rozenberg and Salomaa, The Mathematical Theory of
L Systems, 1980). In a D0L system it depends on the module alone; in an S0L system, a stochastic one, productions are chosen by
chance besides; contexts, random values, cuts, meta-rules and questions to the turtle each ask for more. Every trait is stated
so that a larger value asks for more of an engine, and what an engine can do is stated as the largest traits that it serves.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import chain
from operator import le
from typing import NamedTuple

from lsys_kit.derivation.core.rules import is_branch, rules_of
from lsys_kit.notation.model.modules import Pattern, Repeat, flat
from lsys_kit.notation.model.system import LSystem

CUT = "%"
"""The symbol that cuts off the rest of its branch (ABOP, section 1.8)."""
QUERIES = frozenset(("?P", "?H", "?U", "?L", "?E"))
"""The symbols whose values come from outside: the turtle's position, its heading, its up and its left, or what a field says."""


class Traits(NamedTuple):
    """What a system has.

    context
        How many neighbours on one side a production names at most.
    predecessor
        How many modules a production replaces together at most.
    branching_context
        Whether a right context names branches.
    stochastic
        Whether productions have probabilities.
    random
        Whether a production draws random numbers.
    sensitive
        Whether the system asks what the turtle sees, by a function or by a query module such as `?P(x,y)`.
    cut
        Whether a word may hold a module that cuts off the rest of its branch.
    meta
        Whether meta-rules shorten the words.
    decomposition
        Whether there are decomposition rules.
    varying_decomposition
        Whether what a module is decomposed into depends on more than the module.
    repetition
        Whether a successor has a part that is repeated.
    unknown
        Whether a constant is unknown.

    >>> from lsys_kit import read
    >>> signal = traits_of(read("axiom: b a a\\nb < a -> b"))
    >>> signal.context, signal.stochastic, signal.d0l
    (1, False, False)
    """

    context: int = 0
    predecessor: int = 1
    branching_context: bool = False
    stochastic: bool = False
    random: bool = False
    sensitive: bool = False
    cut: bool = False
    meta: bool = False
    decomposition: bool = False
    varying_decomposition: bool = False
    repetition: bool = False
    unknown: bool = False

    def within(self, most: Traits) -> bool:
        """Whether the system asks for no more than the given traits."""
        return all(map(le, self, most))

    @property
    def d0l(self) -> bool:
        """Whether a module alone decides what becomes of it."""
        return self.within(D0L)

    @property
    def s0l(self) -> bool:
        """Whether a module alone decides what becomes of it, but for a choice among its productions by chance."""
        return self.within(S0L)


D0L = Traits(decomposition=True, repetition=True, unknown=True)
"""The most that a deterministic system without interactions has."""
S0L = D0L._replace(stochastic=True)
COLUMNS = Traits(context=10**9, stochastic=True, random=True, decomposition=True, repetition=True)
"""The most that is computed for whole columns of modules."""
ANY = Traits(
    **{name: True for name, usual in Traits._field_defaults.items() if usual is False}, context=10**9, predecessor=10**9
)
"""What no system exceeds."""


@lru_cache(maxsize=256)
def traits_of(system: LSystem, arithmetic: str = "exact") -> Traits:
    """The traits of a system whose constants are all known."""
    rewriting, decomposing = (
        list(chain(*rules_of(system, arithmetic, section).values())) for section in ("productions", "decomposition")
    )
    rules, symbols = [*rewriting, *decomposing], {module.symbol for module in _written(system)}
    return Traits(
        context=max((len(side) for rule in rules for side in (rule.left, rule.right)), default=0),
        predecessor=max((len(rule.predecessors) for rule in rules), default=1),
        branching_context=any(is_branch(item) for rule in rules for item in rule.right),
        stochastic=any(rule.probability is not None for rule in rewriting),
        random=any(rule.random for rule in rules),
        sensitive=any(rule.looks for rule in rules) or not symbols.isdisjoint(QUERIES),
        cut=CUT in symbols,
        meta=bool(system.meta),
        decomposition=bool(decomposing),
        varying_decomposition=not all(rule.d0l for rule in decomposing),
        repetition=any(isinstance(item, Repeat) for rule in rules for item in rule.production.successor),
    )


def _written(system: LSystem) -> Iterator[Pattern]:
    """The modules that words of a system may hold, as they are written."""
    successors = (rule.successor for rules in (system.productions, system.decomposition, system.meta) for rule in rules)
    yield from flat(chain(system.axiom, *successors))
