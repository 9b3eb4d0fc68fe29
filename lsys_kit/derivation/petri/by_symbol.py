"""The net of a system with infinitely many states, or with contexts: a place stands for all modules of one symbol.

Its transitions carry the conditions of the productions. A decomposition rule is a transition that takes no time, as in
generalized stochastic Petri nets (Ajmone Marsan, Conte and Balbo 1984).

Some symbols may be unfolded: each of their states has a place then, with a transition for each production at work on it, and
all modules of any other symbol share one. Grouped by symbol again, the net has no other places, transitions and arcs. The
states are found from those in the axiom and from those that productions of other symbols make; so these have to be written
with known values there, and what becomes of them must depend on nothing else. The other symbols may have states without end,
and neighbours.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence, Set
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import NamedTuple, TypeVar

from lsys_kit.budget import check_budget
from lsys_kit.derivation.core.chance import shares
from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.traits import CUT
from lsys_kit.derivation.growth.slicing import ArgumentPosition, UnitT, deciding_positions, slice_system, without_arguments
from lsys_kit.derivation.petri.net import Arc, Place, Stages, Transition, outcomes_of
from lsys_kit.errors import ModelNameError, ModelValueError, quotable
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Expression, function_of, is_random, names_in, sensed_in
from lsys_kit.notation.model.modules import Item, Module, Pattern, flat, joined
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.write import as_written

_PlaceT = TypeVar("_PlaceT")
_KindT = TypeVar("_KindT", bound=ModuleKind | Module)


class Product(NamedTuple):
    """What a transition puts into one place, as in `Arc`; the place is named by its kind of modules, its module or its
    number."""

    place: ModuleKind | Module | int
    copies: int
    positions: tuple[int, ...]
    factor: str = ""


class Way(NamedTuple):
    """A transition that leaves a place, and what it puts where."""

    transition: Transition
    products: tuple[Product, ...]


def by_symbol(states: States) -> Stages:
    """The net whose places are kinds of modules: a symbol with a number of parameters."""
    tables = applicable_rules(states)
    kinds = reachable_kinds(states, tables)
    ways = {kind: [*ways_of_kind(states, tables, kind)] for kind in kinds}
    where = {kind: number for number, kind in enumerate(kinds)}
    return _symbols_net(states, ways, lambda module: where.get(kind_of(module)))


def _symbols_net(states: States, ways: Mapping[_KindT, Sequence[Way]], where: Callable[[Module], int | None]) -> Stages:
    """The net of kinds of modules, or single ones, given the ways out of each."""
    places = [Place(place.symbol, (place,)) if isinstance(place, Module) else Place(place[0], ()) for place in ways]
    return replace(net_of(states, places, ways, where), grouped=True, besides=tuple(_unshown(states)))


def net_of(
    states: States, places: Iterable[Place], ways: Mapping[_PlaceT, Sequence[Way]], where: Callable[[Module], int | None]
) -> Stages:
    """The net of some places, given the ways out of each, by what these name them, and the place of each module."""
    numbers: dict[object, int] = {place: number for number, place in enumerate(ways)}
    transitions: list[Transition] = []
    arcs = []
    for at_once, place in product((False, True), ways):
        for way in (way for way in ways[place] if way.transition.at_once is at_once):
            for made in way.products:
                arcs.append(Arc(len(transitions), numbers[made.place], made.copies, made.positions, made.factor))
            transitions.append(replace(way.transition, place=numbers[place]))
    start = Counter(where(states.modules[state]) for state in states.axiom)
    begun = tuple(start[number] for number in range(len(ways)))
    return Stages(states.system, tuple(places), tuple(transitions), tuple(arcs), begun, _where=where)


def spots_of(places: Iterable[_PlaceT]) -> dict[_PlaceT, list[int]]:
    """Where each place stands in a row of them, from 1."""
    spots: dict[_PlaceT, list[int]] = {}
    for spot, place in enumerate(places, 1):
        spots.setdefault(place, []).append(spot)
    return spots


def ways_of_kind(
    states: States,
    tables: Sequence[Mapping[ModuleKind, Sequence[Rule]]],
    kind: ModuleKind,
    place_of: Callable[[Pattern], ModuleKind | Module] = kind_of,
) -> Iterator[Way]:
    """The ways out of the place of all modules of a kind, by rewriting and by decomposition."""
    for at_once in (False, True):
        rules = tables[at_once].get(kind, ())
        for rule, chance in zip(rules, _chances(rules, states), strict=True):
            if len(rule.predecessors) == 1:  # others are told besides
                terms = _requirements(rule, chance, states.system)
                yield Way(
                    Transition(0, rule.number, terms, None if chance == 1 else chance, None, at_once),
                    tuple(_products(rule.production.successor, states, place_of)),
                )


def applicable_rules(states: States) -> list[dict[ModuleKind, Sequence[Rule]]]:
    """The productions for each kind of modules, and the decomposition rules, without those that are never applied."""
    return [{kind: _applicable(rules) for kind, rules in table.items()} for table in (states.rules, states.decomposition)]


def reachable_kinds(states: States, tables: Sequence[Mapping[ModuleKind, Sequence[Rule]]]) -> list[ModuleKind]:
    """The kinds of modules that may be met from the axiom on."""
    found = dict.fromkeys(map(kind_of, states.system.axiom))
    found.update(dict.fromkeys(kind_of(module) for meta in states.system.meta for module in flat(meta.successor)))
    todo = list(found)
    while todo:
        kind = todo.pop(0)
        for rule in (rule for table in tables for rule in table.get(kind, ())):
            new = [other for other in dict.fromkeys(map(kind_of, flat(rule.production.successor))) if other not in found]
            found.update(dict.fromkeys(new))
            todo += new
    return list(found)


def _applicable(rules: Sequence[Rule]) -> Sequence[Rule]:
    """The rules of one kind up to the first that always matches: no later one is ever applied."""
    for number, rule in enumerate(rules, 1):
        asked = rule.left or rule.right or rule.predecessors[1:] or rule.equalities or rule.condition or rule.probability
        if not asked:
            return rules[:number]
    return rules


def _chances(rules: Sequence[Rule], states: States) -> Sequence[Value | None]:
    """How likely each rule of one kind is, where that is constant: all have the same conditions, and constant weights."""
    written = [rule.production for rule in rules]
    weights = [constant_value(each.probability, states) for each in written]
    if len({(each.predecessors, each.left, each.right, each.condition) for each in written}) == 1:
        with suppress(ValueError, TypeError):  # no weights: one is negative or unknown
            return [None] * len(rules) if None in weights else shares([weight or 0 for weight in weights])
    return [None] * len(rules)


def constant_value(expression: Expression | None, states: States) -> Value | None:
    """The value of an expression without parameters, else None."""
    order = {constant.name: index for index, constant in enumerate(states.system.constants)}
    if expression is None or not names_in(expression) <= order.keys():
        return None
    value: Value = function_of(expression, order, states.arithmetic)(states.constants)
    return value


def _products(items: Iterable[Item], states: States, place_of: Callable[[Pattern], ModuleKind | Module]) -> Iterator[Product]:
    """For each place of modules in a successor how many, where in it they stand, and with what their number is multiplied."""
    parts = list(_counted_modules(items, states))
    places = [place_of(pattern) for pattern, _, _ in parts]
    spots = spots_of(places)
    repeated = any(times != 1 or factor for _, times, factor in parts)
    totals: Counter[tuple[ModuleKind | Module, str]] = Counter()
    for place, (_, times, factor) in zip(places, parts, strict=True):
        totals[place, factor] += times
    for (place, factor), copies in totals.items():
        if copies:
            yield Product(place, copies, () if repeated else tuple(spots[place]), factor)


def _counted_modules(items: Iterable[Item], states: States) -> Iterator[tuple[Pattern, int, str]]:
    """The modules of a successor, each with how often it is written: a number and, where that is not known, a factor."""
    for item in items:
        if isinstance(item, Pattern):
            yield item, 1, ""
            continue
        count = constant_value(item.count, states)
        known = count is not None and count == int(count)
        text = str(item.count) if str(item.count).isidentifier() else f"({item.count})"
        for pattern, times, factor in _counted_modules(item.body, states):
            if known:
                yield pattern, times * int(count or 0), factor
            else:
                yield pattern, times, " ".join(filter(None, (text, factor)))


def _requirements(rule: Rule, chance: Value | None, system: LSystem) -> str:
    """What a production asks for besides its symbol, as it is written; its weight too, where that is no probability."""
    production = rule.production
    before = f"{joined(map(str, production.left))} < " if production.left else ""
    after = f" > {joined(map(str, production.right))}" if production.right else ""
    named = before or after or any(index < len(production.predecessor.arguments) for index, _ in rule.equalities)
    context = f"{before}{production.predecessor}{after}" if named else ""
    condition, asked = "", production.condition
    if asked is not None:  # a sensitive function is called in it as the model calls it
        condition = as_written(system, asked) if any(True for _ in sensed_in(asked)) else str(asked)
    text = " : ".join(filter(None, (context, condition)))
    weight = f"with weight {production.probability}" if production.probability is not None and chance is None else ""
    return ", ".join(filter(None, (text, weight)))


def _unshown(states: States) -> Iterator[str]:
    """What the system does that no transition shows, each of which has one place before it."""
    yield from (str(rule) for rule in states.system.productions if rule.predecessors[1:])
    yield from map(str, states.system.meta)
    if states.traits.cut:
        yield f"{CUT} cuts off the rest of its branch"


def unfolded_symbols(states: States, constants: dict[str, object], symbols: Collection[str], most: int) -> Stages:
    """The net in which some symbols are unfolded, into no more places than the most; refused where there is no such symbol, or
    its stages are too many, or cannot be told."""
    kinds = reachable_kinds(states, applicable_rules(states))
    known = [symbol for symbol, _ in kinds]
    for symbol in (symbol for symbol in symbols if symbol not in known):
        names = sorted({name for name in known if name[0].isalnum()} or {*known})
        hint = suggestion(symbol, known) or f"Symbols are: {', '.join(names)}."
        raise ModelNameError(f'There is no symbol "{quotable(symbol)}" here that could be unfolded', hint=hint)
    for kind in kinds:
        if kind[0] in symbols and not _decides_alone(states, kind):
            raise _refusal(kind[0], "Its neighbours, random numbers or what the turtle sees decide what becomes of it.")
    system, chosen = states.system, frozenset(symbols)
    try:
        return _Unfolding(states, kinds, chosen, _table(system, constants), None).net(most)
    except ModelValueError:
        kept = deciding_positions(system)
        if all((symbol, size, i) in kept for symbol, size in kinds if symbol in chosen for i in range(size)):
            raise
    return _Unfolding(states, kinds, chosen, _table(slice_system(system), constants), kept).net(most)


def _refusal(symbol: str, reason: str) -> ModelValueError:
    return ModelValueError(f"The stages of {symbol} cannot be unfolded", hint=reason)


def _decides_alone(states: States, kind: ModuleKind) -> bool:
    """Whether modules of a kind, and chance, decide what becomes of them; no decomposition and no meta-rule has a say."""
    met = {kind_of(module) for rule in states.system.meta for module in (*rule.predecessors, *flat(rule.successor))}
    joined = {other for rules in states.rules.values() for rule in rules for other in rule.predecessors[1:]}
    rules = states.rules.get(kind, ())
    return kind not in {*met, *joined, *states.decomposition} and not any(
        rule.predecessors[1:] or rule.left or rule.right or rule.random or rule.looks for rule in rules
    )


def _table(system: LSystem, constants: dict[str, object]) -> States:
    return States(replace(system, decomposition=(), meta=(), interpretation=()), constants)


@dataclass(frozen=True)
class _Unfolding:
    """What is unfolded: the states of the system, all kinds of modules that may be met, the symbols that are unfolded, the
    states of the system without decomposition, perhaps without the parameters that decide nothing, and those that are left
    (None if all)."""

    states: States
    kinds: Sequence[ModuleKind]
    symbols: Set[str]
    table: States
    kept: Set[ArgumentPosition] | None

    def net(self, most: int) -> Stages:
        """The net, with no more stages than the most."""
        tables = applicable_rules(self.states)
        ways: dict[ModuleKind | Module, list[Way]] = {
            kind: [*ways_of_kind(self.states, tables, kind, partial(self._place_of_pattern, kind))]
            for kind in self.kinds
            if kind[0] not in self.symbols
        }
        exact = not any(
            way.transition.condition or way.transition.at_once or any(made.factor for made in way.products)
            for every in ways.values()
            for way in every
        )
        ways.update(self._ways_of_stages(ways, most).items())
        order = [symbol for symbol, _ in self.kinds]
        ways = {place: ways[place] for place in sorted(ways, key=lambda place: order.index(_symbol(place)))}
        net = _symbols_net(self.states, ways, partial(self._number, {place: number for number, place in enumerate(ways)}))
        return replace(net, grouped=bool(net.besides) or not exact)

    def _sliced(self, module: UnitT) -> UnitT:
        """A module with the parameters that are left."""
        return module if self.kept is None else without_arguments(module, self.kept)

    def _number(self, numbers: Mapping[ModuleKind | Module, int], module: Module) -> int | None:
        return numbers.get(self._sliced(module) if module.symbol in self.symbols else kind_of(module))

    def _ways_of_stages(self, others: Mapping[ModuleKind | Module, Sequence[Way]], most: int) -> dict[Module, list[Way]]:
        """The ways out of each stage of the symbols that are unfolded, in the order in which the stages are met."""
        axiom = (self.states.modules[state] for state in self.states.axiom)
        todo = deque(self._sliced(module) for module in axiom if module.symbol in self.symbols)
        todo += _stages_in(way for every in others.values() for way in every)
        kind = {
            (symbol, len(self._sliced(Module(symbol, (0,) * size)).arguments)): (symbol, size) for symbol, size in self.kinds
        }
        ways: dict[Module, list[Way]] = {}
        while todo:
            module = todo.popleft()
            if module in ways:
                continue
            check_budget()
            if len(ways) == most:
                raise _refusal(module.symbol, f"They are more than {most}.")
            ways[module] = [*self._ways_of_stage(kind, module)]
            todo += _stages_in(ways[module])
        return ways

    def _ways_of_stage(self, kind: Mapping[ModuleKind, ModuleKind], module: Module) -> Iterator[Way]:
        table = self.table
        for outcome in outcomes_of(table, table.number(module.symbol, module.arguments)):
            made = (table.modules[state] for state in outcome.successor)
            places = [each if each.symbol in self.symbols else kind[kind_of(each)] for each in made]
            yield Way(
                Transition(0, outcome.production, "", None if outcome.chance == 1 else outcome.chance),
                tuple(Product(place, len(found), tuple(found)) for place, found in spots_of(places).items()),
            )

    def _place_of_pattern(self, mother: ModuleKind, pattern: Pattern) -> ModuleKind | Module:
        """The place of a module that a production of a symbol makes which is not unfolded."""
        if pattern.symbol not in self.symbols:
            return kind_of(pattern)
        values = []
        for argument in self._sliced(pattern).arguments:
            value = _value(self.states, argument)
            if value is None:
                reason = f"The values with which {mother[0]} makes it are not known: unfold {mother[0]}, too."
                raise _refusal(pattern.symbol, reason)
            values.append(value)
        return Module(pattern.symbol, tuple(values))


def _symbol(place: ModuleKind | Module) -> str:
    return place.symbol if isinstance(place, Module) else place[0]


def _stages_in(ways: Iterable[Way]) -> Iterator[Module]:
    return (made.place for way in ways for made in way.products if isinstance(made.place, Module))


def _value(states: States, argument: Expression) -> Value | None:
    """The value of an expression that has one whatever the module is, else None."""
    with suppress(ArithmeticError, ValueError):
        return None if is_random(argument) or any(sensed_in(argument)) else constant_value(argument, states)
    return None
