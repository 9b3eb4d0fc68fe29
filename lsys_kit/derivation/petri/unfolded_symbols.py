"""The net in which some symbols are unfolded: each of their states has a place, and all modules of any other symbol share one.

It is the net of `by_symbol`, with a place for each state of the symbols that are unfolded and a transition for each production
at work on it. Grouped by symbol again, it has no other places, transitions and arcs than that. The states are found from those
in the axiom and from those that productions of other symbols make; so these have to be written with known values there, and
what becomes of them must depend on nothing else. The other symbols may have states without end, and neighbours.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Collection, Iterator, Mapping, Sequence, Set
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial

from lsys_kit.budget import check_budget
from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.growth.slicing import ArgumentPosition, deciding_positions, slice_system, without_arguments
from lsys_kit.derivation.petri.by_symbol import (
    Product,
    Way,
    applicable_rules,
    constant_value,
    net_of,
    reachable_kinds,
    ways_of_kind,
)
from lsys_kit.derivation.petri.net import Stages, Transition
from lsys_kit.derivation.petri.outcomes import outcomes_of
from lsys_kit.errors import ModelNameError, ModelValueError, quotable
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Expression, is_random, sensed_in
from lsys_kit.notation.model.modules import Module, Pattern, flat
from lsys_kit.notation.model.system import LSystem


@dataclass(frozen=True)
class _Unfolding:
    """What is unfolded, and the table in which its states are found.

    Attributes
    ----------
    states
        The states of the system.
    kinds
        All kinds of modules that may be met.
    symbols
        Those that are unfolded.
    table
        The states of the system without decomposition, perhaps without the parameters that decide nothing.
    kept
        The parameters that this system has left; None if all are.
    """

    states: States
    kinds: Sequence[ModuleKind]
    symbols: Set[str]
    table: States
    kept: Set[ArgumentPosition] | None

    def sliced(self, module: Module) -> Module:
        """A module with the parameters that are left."""
        return module if self.kept is None else without_arguments(module, self.kept)


def unfolded_symbols(states: States, constants: dict[str, object], symbols: Collection[str], most: int) -> Stages:
    """The net in which some symbols are unfolded, into no more places than the most.

    Raises
    ------
    ModelNameError
        There is no such symbol.
    ModelValueError
        Its stages are too many, or cannot be told.
    """
    kinds = reachable_kinds(states, applicable_rules(states))
    for symbol in symbols:
        _check_name(symbol, [symbol for symbol, _ in kinds])
    for kind in kinds:
        if kind[0] in symbols and not _decides_alone(states, kind):
            raise _refusal(kind[0], "Its neighbours, random numbers or what the turtle sees decide what becomes of it.")
    system, chosen = states.system, frozenset(symbols)
    try:
        return _net(_Unfolding(states, kinds, chosen, _table(system, constants), None), most)
    except ModelValueError:
        kept = deciding_positions(system)
        if all((symbol, size, i) in kept for symbol, size in kinds if symbol in chosen for i in range(size)):
            raise
    return _net(_Unfolding(states, kinds, chosen, _table(slice_system(system), constants), kept), most)


def _check_name(symbol: str, known: Sequence[str]) -> None:
    if symbol not in known:
        names = sorted({name for name in known if name[0].isalnum()} or {*known})
        hint = suggestion(symbol, known) or f"Symbols are: {', '.join(names)}."
        raise ModelNameError(f'There is no symbol "{quotable(symbol)}" here that could be unfolded', hint=hint)


def _refusal(symbol: str, reason: str) -> ModelValueError:
    return ModelValueError(f"The stages of {symbol} cannot be unfolded", hint=reason)


def _decides_alone(states: States, kind: ModuleKind) -> bool:
    """Whether modules of a kind, and chance, decide what becomes of them; no decomposition and no meta-rule has a say."""
    met = {kind_of(module) for rule in states.system.meta for module in (*rule.predecessors, *flat(rule.successor))}
    joined = {other for rules in states.rules.values() for rule in rules for other in rule.predecessors[1:]}
    return kind not in {*met, *joined, *states.decomposition} and all(map(_needs_module_only, states.rules.get(kind, ())))


def _needs_module_only(rule: Rule) -> bool:
    return len(rule.predecessors) == 1 and not (rule.left or rule.right or rule.random or rule.looks)


def _table(system: LSystem, constants: dict[str, object]) -> States:
    return States(replace(system, decomposition=(), meta=(), interpretation=()), constants)


def _net(found: _Unfolding, most: int) -> Stages:
    tables = applicable_rules(found.states)
    ways: dict[ModuleKind | Module, list[Way]] = {
        kind: [*ways_of_kind(found.states, tables, kind, partial(_place_of_pattern, found, kind))]
        for kind in found.kinds
        if kind[0] not in found.symbols
    }
    exact = not any(
        way.transition.condition or way.transition.at_once or any(made.factor for made in way.products)
        for every in ways.values()
        for way in every
    )
    ways.update(_ways_of_stages(found, ways, most).items())
    order = [symbol for symbol, _ in found.kinds]
    ways = {place: ways[place] for place in sorted(ways, key=lambda place: order.index(_symbol(place)))}
    net = net_of(found.states, ways, True, partial(_number, found, {place: number for number, place in enumerate(ways)}))
    return replace(net, grouped=bool(net.besides) or not exact)


def _symbol(place: ModuleKind | Module) -> str:
    return place.symbol if isinstance(place, Module) else place[0]


def _number(found: _Unfolding, numbers: Mapping[ModuleKind | Module, int], module: Module) -> int | None:
    """The number of the place of a module."""
    return numbers.get(found.sliced(module) if module.symbol in found.symbols else kind_of(module))


def _ways_of_stages(
    found: _Unfolding, others: Mapping[ModuleKind | Module, Sequence[Way]], most: int
) -> dict[Module, list[Way]]:
    """The ways out of each stage of the symbols that are unfolded, in the order in which the stages are met."""
    axiom = (found.states.modules[state] for state in found.states.axiom)
    todo = deque(found.sliced(module) for module in axiom if module.symbol in found.symbols)
    todo += _stages_in(way for every in others.values() for way in every)
    kind = {(symbol, len(found.sliced(Module(symbol, (0,) * size)).arguments)): (symbol, size) for symbol, size in found.kinds}
    ways: dict[Module, list[Way]] = {}
    while todo:
        module = todo.popleft()
        if module in ways:
            continue
        check_budget()
        if len(ways) == most:
            raise _refusal(module.symbol, f"They are more than {most}.")
        ways[module] = [*_ways_of_stage(found, kind, module)]
        todo += _stages_in(ways[module])
    return ways


def _stages_in(ways: Iterator[Way] | Sequence[Way]) -> Iterator[Module]:
    return (made.place for way in ways for made in way.products if isinstance(made.place, Module))


def _ways_of_stage(found: _Unfolding, kind: Mapping[ModuleKind, ModuleKind], module: Module) -> Iterator[Way]:
    """The ways out of the place of one module."""
    table = found.table
    for outcome in outcomes_of(table, table.number(module.symbol, module.arguments)):
        made = (table.modules[state] for state in outcome.successor)
        places = [each if each.symbol in found.symbols else kind[kind_of(each)] for each in made]
        yield Way(
            Transition(0, outcome.production, "", None if outcome.chance == 1 else outcome.chance),
            tuple(
                Product(place, copies, tuple(spot for spot, other in enumerate(places, 1) if other == place))
                for place, copies in Counter(places).items()
            ),
        )


def _place_of_pattern(found: _Unfolding, mother: ModuleKind, pattern: Pattern) -> ModuleKind | Module:
    """The place of a module that a production of a symbol makes which is not unfolded."""
    if pattern.symbol not in found.symbols:
        return kind_of(pattern)
    kept = pattern if found.kept is None else without_arguments(pattern, found.kept)
    known = [_value(found.states, argument) for argument in kept.arguments]
    values = tuple(value for value in known if value is not None)
    if len(values) < len(known):
        raise _refusal(pattern.symbol, f"The values with which {mother[0]} makes it are not known: unfold {mother[0]}, too.")
    return Module(pattern.symbol, values)


def _value(states: States, argument: Expression) -> Value | None:
    """The value of an expression that has one whatever the module is, else None."""
    with suppress(ArithmeticError, ValueError):
        return None if is_random(argument) or any(sensed_in(argument)) else constant_value(argument, states)
    return None
