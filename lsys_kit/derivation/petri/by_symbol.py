"""The net of a system with infinitely many states, or with contexts: a place stands for all modules of one symbol.

Its transitions carry the conditions of the productions. A decomposition rule is a transition that takes no time, as in
generalized stochastic Petri nets (Ajmone Marsan, Conte and Balbo 1984).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from itertools import product

from lsys_kit.derivation.core.chance import shares
from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.traits import CUT
from lsys_kit.derivation.petri.net import Arc, Place, Stages, Transition
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Expression, function_of, names_in, sensed_in
from lsys_kit.notation.model.modules import Item, Module, Pattern, Repeat, flat, joined
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.write import as_written


def by_symbol(states: States) -> Stages:
    """The net whose places are kinds of modules: a symbol with a number of parameters."""
    system = states.system
    tables = [{kind: _applicable(rules) for kind, rules in table.items()} for table in (states.rules, states.decomposition)]
    kinds = _reachable_kinds(states, tables)
    where = {kind: number for number, kind in enumerate(kinds)}
    transitions: list[Transition] = []
    arcs: list[Arc] = []
    for at_once, kind in product((False, True), kinds):
        rules = tables[at_once].get(kind, ())
        for rule, chance in zip(rules, _chances(rules, states), strict=True):
            if len(rule.predecessors) > 1:
                continue  # told besides
            arcs += [Arc(len(transitions), where[target], copies, spots, factor)
                     for target, copies, spots, factor in _products(rule.production.successor, states)]
            transitions.append(Transition(where[kind], rule.number, _requirements(rule, chance, states.system),
                                          None if chance == 1 else chance, None, at_once))
    start = Counter(kind_of(states.modules[state]) for state in states.axiom)
    return Stages(system, tuple(Place(symbol, ()) for symbol, _ in kinds), tuple(transitions), tuple(arcs),
                  tuple(start[kind] for kind in kinds), True, tuple(_unshown(states)), partial(_place, where))


def _place(where: dict[ModuleKind, int], module: Module) -> int | None:
    return where.get(kind_of(module))


def _reachable_kinds(states: States, tables: Sequence[Mapping[ModuleKind, Sequence[Rule]]]) -> list[ModuleKind]:
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
    last = next((number for number, rule in enumerate(rules, 1) if not (rule.left or rule.right or rule.predecessors[1:])
                 and not rule.equalities and rule.condition is None and rule.probability is None), len(rules))
    return rules[:last]


def _chances(rules: Sequence[Rule], states: States) -> Sequence[Value | None]:
    """How likely each rule of one kind is, where that is constant: all have the same conditions, and constant weights."""
    asked = {(rule.production.predecessors, rule.production.left, rule.production.right, rule.production.condition)
             for rule in rules}
    weights = [_constant_value(rule.production.probability, states) for rule in rules]
    if len(asked) == 1:
        with suppress(ValueError, TypeError):  # no weights: one is missing, negative or unknown
            return shares(weights)  # type: ignore[arg-type]
    return [None] * len(rules)


def _constant_value(expression: Expression | None, states: States) -> Value | None:
    """The value of an expression without parameters, else None."""
    order = {constant.name: index for index, constant in enumerate(states.system.constants)}
    if expression is None or not names_in(expression) <= order.keys():
        return None
    value: Value = function_of(expression, order, states.arithmetic)(states.constants)
    return value


def _products(items: Iterable[Item], states: States) -> Iterator[tuple[ModuleKind, int, tuple[int, ...], str]]:
    """For each kind that a successor holds how many, where in it they stand, and with what their number is multiplied."""
    parts = list(_counted_modules(items, states))
    spots: dict[ModuleKind, list[int]] = {}
    for position, (kind, _, _) in enumerate(parts, 1):
        spots.setdefault(kind, []).append(position)
    repeated = any(times != 1 or factor for _, times, factor in parts)
    totals: Counter[tuple[ModuleKind, str]] = Counter()
    for kind, times, factor in parts:
        totals[kind, factor] += times
    for (kind, factor), copies in totals.items():
        if copies:
            yield kind, copies, () if repeated else tuple(spots[kind]), factor


def _counted_modules(items: Iterable[Item], states: States) -> Iterator[tuple[ModuleKind, int, str]]:
    """The modules of a successor, each with how often it is written: a number and, where that is not known, a factor."""
    for item in items:
        if isinstance(item, Pattern):
            yield kind_of(item), 1, ""
            continue
        count = _constant_value(item.count, states)
        known = count is not None and count == int(count)
        for kind, times, factor in _counted_modules(item.body, states):
            if known:
                yield kind, times * int(count or 0), factor
            else:
                yield kind, times, " ".join(filter(None, (_factor_text(item), factor)))


def _factor_text(item: Repeat) -> str:
    text = str(item.count)
    return text if text.isidentifier() else f"({text})"


def _requirements(rule: Rule, chance: Value | None, system: LSystem) -> str:
    """What a production asks for besides its symbol, as it is written; its weight too, where that is no probability."""
    production = rule.production
    before = f"{joined(map(str, production.left))} < " if production.left else ""
    after = f" > {joined(map(str, production.right))}" if production.right else ""
    named = before or after or any(index < len(production.predecessor.arguments) for index, _ in rule.equalities)
    context = f"{before}{production.predecessor}{after}" if named else ""
    text = " : ".join(filter(None, (context, _condition_text(production, system))))
    weight = f"with weight {production.probability}" if production.probability is not None and chance is None else ""
    return ", ".join(filter(None, (text, weight)))


def _condition_text(production: Production, system: LSystem) -> str:
    """A condition; a sensitive function is called in it as the model calls it."""
    if production.condition is None:
        return ""
    asks = any(True for _ in sensed_in(production.condition))
    return as_written(system, production.condition) if asks else str(production.condition)


def _replaces_several(production: Production) -> bool:
    """Whether a production replaces several modules together, which no transition with one place before it shows."""
    return len(production.predecessors) > 1


def _unshown(states: States) -> Iterator[str]:
    """What the system does that no transition shows."""
    for rule in (*filter(_replaces_several, states.system.productions), *states.system.meta):
        yield str(rule)
    if states.traits.cut:
        yield f"{CUT} cuts off the rest of its branch"
