"""Misconceptions about systems: from a system to those that somebody writes, or has in mind, instead."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any

from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, names_in
from lsys_kit.notation.model.modules import CLOSING, OPENING, Item, Pattern, Repeat, expressions_of
from lsys_kit.notation.model.system import LSystem, Production

MOST_PRODUCTIONS = 12
"""Of longer systems no pairs of productions are tried."""
_POLARITY = re.compile(r"(_?[lr]|_?left|_?right)$|^[lrLR]$")
_TURNED = {"l": "r", "r": "l", "L": "R", "R": "L", "left": "right", "right": "left"}


def _with(system: LSystem, productions: Sequence[Production]) -> LSystem:
    return replace(system, productions=tuple(productions), source="")


def rewritten(
    system: LSystem, change: Callable[[Production], Production], word: Callable[[Sequence[Pattern]], Sequence[Any]] = tuple
) -> Iterator[LSystem]:
    """The system with all its productions changed, if that changes anything."""
    wrong = replace(_with(system, [change(rule) for rule in system.productions]), axiom=tuple(word(system.axiom)))
    if wrong != system:
        yield wrong


def each_rewritten(system: LSystem, change: Callable[[Production], Production]) -> Iterator[LSystem]:
    """The system with all its productions changed, then with each alone."""
    yield from rewritten(system, change)
    rules = system.productions
    for number, rule in enumerate(rules):
        if len(rules) > 1 and change(rule) != rule:
            yield _with(system, [*rules[:number], change(rule), *rules[number + 1 :]])


# Which way, and in which order


def _turned_round(symbol: str) -> str:
    """A symbol that points the other way: al for ar, M_left for M_right.

    >>> _turned_round("al"), _turned_round("M_r"), _turned_round("F")
    ('ar', 'M_l', 'F')
    """
    found = _POLARITY.search(symbol)
    if not found:
        return symbol
    ending = found[0].lstrip("_")
    return symbol[: len(symbol) - len(ending)] + _TURNED[ending]


def _polar(system: LSystem) -> frozenset[str]:
    """The symbols whose opposite occurs too."""
    symbols = {module.symbol for module in system.modules}
    return frozenset(s for s in symbols if _turned_round(s) != s and _turned_round(s) in symbols)


def polarity_mirrored(system: LSystem) -> Iterator[LSystem]:
    """All arrows of the daughters reversed; or of the mothers, which is as if each had the production of the other."""
    polar = _polar(system)

    def turned(items: Sequence[Item]) -> tuple[Item, ...]:
        return tuple(
            replace(item, symbol=_turned_round(item.symbol)) if isinstance(item, Pattern) and item.symbol in polar else item
            for item in items
        )

    yield from each_rewritten(system, lambda rule: replace(rule, successor=turned(rule.successor)))
    yield from rewritten(system, lambda rule: replace(rule, predecessors=turned(rule.predecessors)))  # type: ignore[arg-type]
    reversed_too = [replace(rule, successor=_reversed(turned(rule.successor))) for rule in system.productions]
    if polar and _with(system, reversed_too) != system:
        yield _with(system, reversed_too)


def _reversed(items: Sequence[Item]) -> tuple[Item, ...]:
    """Modules in the reverse order; a branch keeps its brackets around it."""
    groups: list[list[Item]] = []
    depth = 0
    for item in items:
        symbol = item.symbol if isinstance(item, Pattern) else ""
        if depth:
            groups[-1].append(item)
        else:
            groups.append([item])
        depth += (symbol in OPENING) - (symbol in CLOSING)
    return tuple(item for group in reversed(groups) for item in group)


def daughters_reversed(system: LSystem) -> Iterator[LSystem]:
    """The modules of successors from right to left."""
    yield from each_rewritten(system, lambda rule: replace(rule, successor=_reversed(rule.successor)))


# Which production


def production_missing(system: LSystem) -> Iterator[LSystem]:
    """One production left out: its modules stay as they are."""
    rules = system.productions
    if len(rules) > 1:
        for number in range(len(rules)):
            yield _with(system, [*rules[:number], *rules[number + 1 :]])


def productions_swapped(system: LSystem) -> Iterator[LSystem]:
    """The successors of two productions exchanged."""
    rules = list(system.productions)
    for one, other in combinations(range(len(rules)), 2) if len(rules) <= MOST_PRODUCTIONS else ():
        if rules[one].successor != rules[other].successor:
            swapped = list(rules)
            swapped[one] = replace(rules[one], successor=_in_names_of(rules[one], rules[other]))
            swapped[other] = replace(rules[other], successor=_in_names_of(rules[other], rules[one]))
            yield _with(system, swapped)


def _in_names_of(rule: Production, other: Production) -> tuple[Item, ...]:
    """The successor of another production, with the names of the first one's parameters."""
    values = {
        theirs.name: own
        for theirs, own in zip(other.predecessor.arguments, rule.predecessor.arguments, strict=False)
        if isinstance(theirs, Name)
    }
    return tuple(
        item
        if isinstance(item, Repeat)
        else replace(item, arguments=tuple(_substituted(argument, values) for argument in item.arguments))
        for item in other.successor
    )


def is_sensible(system: LSystem) -> bool:
    """Whether every name in a system's productions is a parameter, a constant or what counts in a repeated part."""
    constants = {constant.name for constant in system.constants}
    return all(_names_used(rule) <= constants | _names_given(rule) for rule in system.productions)


def _names_used(rule: Production) -> frozenset[str]:
    others = [part for part in (rule.condition, rule.probability) if part is not None]
    return frozenset().union(*map(names_in, [*expressions_of(rule.successor), *others]))


def _names_given(rule: Production) -> set[str]:
    formal = {a.name for module in rule.parameters for a in module.arguments if isinstance(a, Name)}
    return formal | set(_indices(rule.successor))


def _indices(items: Sequence[Item]) -> Iterator[str]:
    for item in items:
        if isinstance(item, Repeat):
            yield item.index
            yield from _indices(item.body)


def last_match_first(system: LSystem) -> Iterator[LSystem]:
    """Productions tried from the last to the first."""
    if any(a.predecessor.symbol == b.predecessor.symbol for a, b in combinations(system.productions, 2)):
        yield _with(system, system.productions[::-1])


# Conditions and stages


_COMPARED = ("==", "<", "<=", ">", ">=", "!=")
_OTHER_STRICTNESS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}


def _conditions_changed(system: LSystem, change: Callable[[Expression], Expression]) -> Iterator[LSystem]:
    yield from each_rewritten(
        system, lambda rule: rule if rule.condition is None else replace(rule, condition=change(rule.condition))
    )


def _with_comparisons(expression: Expression, change: Callable[[Apply], Expression]) -> Expression:
    """An expression with each of its comparisons changed."""
    if not isinstance(expression, Apply):
        return expression
    if expression.operator in _COMPARED:
        return change(expression)
    return replace(expression, operands=tuple(_with_comparisons(operand, change) for operand in expression.operands))


def strictness_confused(system: LSystem) -> Iterator[LSystem]:
    """`<` for `<=`, or the other way round."""

    def change(found: Apply) -> Expression:
        return replace(found, operator=_OTHER_STRICTNESS.get(found.operator, found.operator))

    yield from _conditions_changed(system, lambda condition: _with_comparisons(condition, change))


def condition_one_off(system: LSystem) -> Iterator[LSystem]:
    """The bound of a condition one too small or too great."""
    for by in (-1, 1):

        def change(found: Apply, by: int = by) -> Expression:
            left, right = found.operands
            return replace(found, operands=(left, _plus(right, by)))

        yield from _conditions_changed(
            system,
            lambda condition, change=change: (  # type: ignore[misc]
                _with_comparisons(condition, change)
            ),
        )


def _plus(expression: Expression, by: int) -> Expression:
    return Number(expression.value + by) if isinstance(expression, Number) else Apply("+", (expression, Number(by)))


def condition_dropped(system: LSystem) -> Iterator[LSystem]:
    """A production without its condition."""
    yield from each_rewritten(system, lambda rule: replace(rule, condition=None))


def condition_after_the_step(system: LSystem) -> Iterator[LSystem]:
    """Conditions that are asked of the values after the step."""
    yield from rewritten(system, _asked_late)


def _asked_late(rule: Production) -> Production:
    own = next(
        (
            item
            for item in rule.successor
            if isinstance(item, Pattern)
            and item.symbol == rule.predecessor.symbol
            and len(item.arguments) == len(rule.predecessor.arguments)
        ),
        None,
    )
    if rule.condition is None or own is None:
        return rule
    later = {
        formal.name: made
        for formal, made in zip(rule.predecessor.arguments, own.arguments, strict=True)
        if isinstance(formal, Name)
    }
    return replace(rule, condition=_substituted(rule.condition, later))


def _substituted(expression: Expression, values: dict[str, Expression]) -> Expression:
    if isinstance(expression, Name):
        return values.get(expression.name, expression)
    if isinstance(expression, Apply):
        return replace(expression, operands=tuple(_substituted(operand, values) for operand in expression.operands))
    return expression


def stages_from_zero(system: LSystem) -> Iterator[LSystem]:
    """The numbers in successors one too small, as if stages were counted from 0."""
    yield from rewritten(system, lambda rule: replace(rule, successor=tuple(map(_one_less, rule.successor))))


def _one_less(item: Item) -> Item:
    if isinstance(item, Repeat):
        return item
    return replace(item, arguments=tuple(_plus(a, -1) if isinstance(a, Number) else a for a in item.arguments))


# Contexts


def context_overlooked(system: LSystem) -> Iterator[LSystem]:
    """Productions that ask for no neighbours."""
    yield from rewritten(system, lambda rule: replace(rule, left=(), right=()))


def context_sides_swapped(system: LSystem) -> Iterator[LSystem]:
    """The left context read to the right, and the right one to the left."""
    yield from rewritten(system, lambda rule: replace(rule, left=rule.right, right=rule.left))
