"""Slicing: parameters that decide nothing are removed from a system, as program slicing removes variables (Weiser 1981).

A leaf L(t) whose age t grows for ever has infinitely many states. Where no condition depends on t, nor on any value computed
from it, all leaves behave alike, and counting needs `L` only.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Set
from dataclasses import replace
from typing import TypeAlias, TypeVar

from lsys_kit.notation.model.expressions import Expression, Name, names_in
from lsys_kit.notation.model.modules import Item, Module, Pattern, Repeat, flat
from lsys_kit.notation.model.system import LSystem, Production

ArgumentPosition: TypeAlias = tuple[str, int, int]
"""A parameter: the symbol of its module, how many parameters that has, and which of them it is, from 0."""
UnitT = TypeVar("UnitT", Module, Pattern)


def slice_system(system: LSystem, wanted: Set[ArgumentPosition] = frozenset()) -> LSystem:
    """The system with only those parameters that decide which production rewrites a module, or how many modules it makes, and
    those from which wanted ones are computed.

    How many modules of each symbol a word holds is the same in both, at every step of the first that has values.
    Interpretation rules, which only draw, are left out.

    >>> from lsys_kit import read
    >>> print(slice_system(read("axiom: A(0,9)\\nA(t,x) : t < 7 -> A(t+1,x+t)\\nA(t,x) -> A(0,1) L(x)\\nL(x) -> L(x+1)")))
    axiom: A(0)
    A(t) : t < 7 -> A(t + 1)
    A(t) -> A(0)L
    L -> L
    """
    kept = deciding_positions(system, wanted)
    return replace(
        system,
        axiom=tuple(without_arguments(module, kept) for module in system.axiom),
        productions=tuple(_sliced_production(rule, kept) for rule in system.productions),
        decomposition=tuple(_sliced_production(rule, kept) for rule in system.decomposition),
        interpretation=(),
        source="",
    )


def deciding_positions(system: LSystem, wanted: Set[ArgumentPosition] = frozenset()) -> frozenset[ArgumentPosition]:
    """The parameters that decide something: those that a rule tests, or that are wanted, and those from which such a parameter
    is computed.

    Where two kinds of modules with the same symbol would become one, they keep all their parameters.

    >>> from lsys_kit import read
    >>> sorted(deciding_positions(read("axiom: A(0,9)\\nA(t,x) : t < 7 -> A(x,x)")))
    [('A', 2, 0), ('A', 2, 1)]
    """
    rules = (*system.productions, *system.decomposition)
    constants = frozenset(constant.name for constant in system.constants)
    found = (
        {*wanted}
        | {position for rule in rules for position in _deciding(rule, constants)}
        | {
            (module.symbol, len(module.arguments), i)
            for rule in system.meta
            for module in (*rule.predecessors, *flat(rule.successor))
            for i in range(len(module.arguments))
        }
    )
    while True:
        more = {position for rule in rules for position in _sources(rule, found)} | _clashes(system, found)
        if more <= found:
            return frozenset(found)
        found |= more


def _deciding(rule: Production, constants: Set[str]) -> Iterator[ArgumentPosition]:
    """The parameters in a rule's condition, its probability and its counts of repetition, and those of a given value."""
    asked = [expression for expression in (rule.condition, rule.probability) if expression is not None]
    yield from _positions_of_names(rule, (*asked, *repetitions(rule.successor)))
    for module in rule.parameters:
        for i, argument in enumerate(module.arguments):
            if not isinstance(argument, Name) or argument.name in constants:
                yield module.symbol, len(module.arguments), i


def _sources(rule: Production, found: Set[ArgumentPosition]) -> Iterator[ArgumentPosition]:
    """The parameters of which a rule makes some that are found already."""
    for module in flat(rule.successor):
        size = len(module.arguments)
        made = [argument for i, argument in enumerate(module.arguments) if (module.symbol, size, i) in found]
        yield from _positions_of_names(rule, made)  # a production's arguments are expressions


def _positions_of_names(rule: Production, expressions: Iterable[Expression]) -> Iterator[ArgumentPosition]:
    names = frozenset().union(*map(names_in, expressions))
    for module in rule.parameters:
        for i, argument in enumerate(module.arguments):
            if isinstance(argument, Name) and argument.name in names:
                yield module.symbol, len(module.arguments), i


def repetitions(items: Iterable[Item]) -> Iterator[Expression]:
    """How often the repeated parts of a successor are written."""
    for item in items:
        if isinstance(item, Repeat):
            yield item.count
            yield from repetitions(item.body)


def _clashes(system: LSystem, found: Set[ArgumentPosition]) -> set[ArgumentPosition]:
    """All parameters of the modules that share a symbol, and would have equally many parameters left."""
    sizes: dict[str, set[int]] = defaultdict(set)
    for module in (*system.axiom, *(m for rule in (*system.productions, *system.decomposition) for m in rule.modules)):
        sizes[module.symbol].add(len(module.arguments))
    return {
        (symbol, size, i)
        for symbol, all_sizes in sizes.items()
        if len({sum((symbol, size, i) in found for i in range(size)) for size in all_sizes}) < len(all_sizes)
        for size in all_sizes
        for i in range(size)
    }


def _sliced_production(rule: Production, kept: Set[ArgumentPosition]) -> Production:
    own, left, right = (
        tuple(without_arguments(module, kept) for module in modules) for modules in (rule.predecessors, rule.left, rule.right)
    )
    return replace(rule, predecessors=own, successor=_sliced_items(rule.successor, kept), left=left, right=right)


def _sliced_items(items: Iterable[Item], kept: Set[ArgumentPosition]) -> tuple[Item, ...]:
    return tuple(
        replace(item, body=_sliced_items(item.body, kept)) if isinstance(item, Repeat) else without_arguments(item, kept)
        for item in items
    )


def without_arguments(module: UnitT, kept: Set[ArgumentPosition]) -> UnitT:
    """A module without those of its parameters that decide nothing.

    >>> print(without_arguments(Module("A", (1, 2)), {("A", 2, 0)}))
    A(1)
    """
    size = len(module.arguments)
    return replace(module, arguments=tuple(a for i, a in enumerate(module.arguments) if (module.symbol, size, i) in kept))
