"""Misconceptions about systems: from a system to those that somebody writes, or has in mind, instead."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import combinations
from typing import Any, TypeAlias

from lsys_kit.classroom.exercises.asked import Derived, History, asked_system, last_step, what_is_asked
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.drawings import Drawn
from lsys_kit.classroom.exercises.kinds.forms import is_sensible
from lsys_kit.classroom.exercises.kinds.systems import completed
from lsys_kit.classroom.exercises.kinds.table import solution_of
from lsys_kit.classroom.exercises.misconceptions.misconception import by_history, misconception
from lsys_kit.classroom.exercises.misconceptions.of_solutions import (
    OTHER_DIRECTION,
    OTHER_STRICTNESS,
    changed,
    substituted,
    with_operator,
)
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import CLOSING, OPENING, Item, Pattern, Repeat
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.worlds.derive import derive

MOST_PRODUCTIONS = 12
"""Of longer systems no pairs of productions are tried."""
ChangeOfSystem: TypeAlias = Callable[[LSystem], Iterator[LSystem]]
ChangeOfRule: TypeAlias = Callable[[Production], Production]
Items: TypeAlias = Sequence[Item]


def by_systems(change: ChangeOfSystem, exercise: Exercise) -> Iterator[object]:
    """The answers of somebody who writes another system, or has it in mind."""
    if exercise.kind == "system":
        yield from (completed(exercise, wrong) for wrong in filter(is_sensible, change(solution_of(exercise).own)))
    elif exercise.kind == "drawing":
        right = solution_of(exercise).derivation
        drawings = (Drawn(derive(wrong, right.steps)) for wrong in filter(is_sensible, change(right.states.system)))
        yield from (drawing for drawing in drawings if len(drawing.strokes))
    elif what_is_asked(exercise):
        for wrong in filter(is_sensible, change(asked_system(exercise))):
            yield from by_history(exercise, History(wrong, Derived(wrong, last_step(exercise))))


def in_mind(change: ChangeOfSystem, exercise: Exercise) -> Iterator[object]:
    """The same of a system that nobody would write."""
    return iter(()) if exercise.kind == "system" else by_systems(change, exercise)


def by_turns(change: ChangeOfSystem, exercise: Exercise) -> Iterator[object]:
    """The same of a system with another angle, in questions that do not give it."""
    return iter(()) if exercise.kind == "drawing" and exercise.system else by_systems(change, exercise)


# All productions, or one of them


def _with(system: LSystem, productions: Sequence[Production]) -> LSystem:
    return replace(system, productions=tuple(productions), source="")


def rewritten(change: ChangeOfRule, system: LSystem, word: Callable[[Sequence[Pattern]], Items] = tuple) -> Iterator[LSystem]:
    """The system with all its productions changed, and its axiom, if that changes anything."""
    axiom: Any = tuple(word(system.axiom))
    wrong = replace(_with(system, [change(rule) for rule in system.productions]), axiom=axiom)
    if wrong != system:
        yield wrong


def each_rewritten(change: ChangeOfRule, system: LSystem) -> Iterator[LSystem]:
    """The system with all its productions changed, then with each alone."""
    yield from rewritten(change, system)
    rules = system.productions
    for number, rule in enumerate(rules):
        if len(rules) > 1 and change(rule) != rule:
            yield _with(system, [*rules[:number], change(rule), *rules[number + 1 :]])


def in_all_rules(change: ChangeOfRule, exercise: Exercise) -> Iterator[object]:
    """The answers of somebody who takes all productions for others."""
    return by_systems(partial(rewritten, change), exercise)


def in_each_rule(change: ChangeOfRule, exercise: Exercise) -> Iterator[object]:
    """The answers of somebody who takes all productions for others, or one of them."""
    return by_systems(partial(each_rewritten, change), exercise)


def in_comparisons(change: Callable[[Expression], Expression], exercise: Exercise) -> Iterator[object]:
    """The same, in the conditions of productions."""

    def with_other_condition(rule: Production) -> Production:
        return rule if rule.condition is None else replace(rule, condition=changed(rule.condition, change))

    return in_each_rule(with_other_condition, exercise)


# Which way, and in which order


_POLARITY = re.compile(r"(_?[lr]|_?left|_?right)$|^[lrLR]$")
_TURNED = {"l": "r", "r": "l", "L": "R", "R": "L", "left": "right", "right": "left"}


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


@misconception("polarity mirrored", by_systems)
def polarity_mirrored(system: LSystem) -> Iterator[LSystem]:
    """All arrows of the daughters reversed; or of the mothers, which is as if each had the production of the other."""
    symbols = {module.symbol for module in system.modules}
    polar = {s: _turned_round(s) for s in symbols if _turned_round(s) != s and _turned_round(s) in symbols}

    def mothers_turned(rule: Production) -> Production:
        turned: Any = _with_symbols(polar, rule.predecessors)
        return replace(rule, predecessors=turned)

    yield from each_rewritten(partial(_with_items, partial(_with_symbols, polar)), system)
    yield from rewritten(mothers_turned, system)
    if polar:
        yield from rewritten(lambda rule: replace(rule, successor=_reversed(_with_symbols(polar, rule.successor))), system)


def _with_symbols(others: Mapping[str, str], items: Items) -> tuple[Item, ...]:
    """Modules with other symbols, where there are some for their own."""
    return tuple(
        replace(item, symbol=others.get(item.symbol, item.symbol)) if isinstance(item, Pattern) else item for item in items
    )


def _with_items(change: Callable[[Items], tuple[Item, ...]], rule: Production) -> Production:
    return replace(rule, successor=change(rule.successor))


def _reversed(items: Items) -> tuple[Item, ...]:
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


misconception("daughters reversed", in_each_rule)(partial(_with_items, _reversed))


# Which production


@misconception("production missing", by_systems)
def production_missing(system: LSystem) -> Iterator[LSystem]:
    rules = system.productions
    if len(rules) > 1:
        for number in range(len(rules)):
            yield _with(system, [*rules[:number], *rules[number + 1 :]])


@misconception("productions swapped", by_systems)
def productions_swapped(system: LSystem) -> Iterator[LSystem]:
    rules = list(system.productions)
    for one, other in combinations(range(len(rules)), 2) if len(rules) <= MOST_PRODUCTIONS else ():
        if rules[one].successor != rules[other].successor:
            swapped = list(rules)
            swapped[one] = replace(rules[one], successor=_in_names_of(rules[one], rules[other]))
            swapped[other] = replace(rules[other], successor=_in_names_of(rules[other], rules[one]))
            yield _with(system, swapped)


def _in_names_of(rule: Production, other: Production) -> tuple[Item, ...]:
    pairs = zip(other.predecessor.arguments, rule.predecessor.arguments, strict=False)
    values = {theirs.name: own for theirs, own in pairs if isinstance(theirs, Name)}
    return _with_arguments(lambda argument: substituted(argument, values), other.successor)


def _with_arguments(change: Callable[[Expression], Expression], items: Items) -> tuple[Item, ...]:
    return tuple(
        item if isinstance(item, Repeat) else replace(item, arguments=tuple(map(change, item.arguments))) for item in items
    )


@misconception("first match overlooked", by_systems)
def last_match_first(system: LSystem) -> Iterator[LSystem]:
    if any(a.predecessor.symbol == b.predecessor.symbol for a, b in combinations(system.productions, 2)):
        yield _with(system, system.productions[::-1])


# Conditions, stages and contexts


def _bound_moved(by: int, found: Expression) -> Expression:
    """A comparison with a bound that is greater by so much."""
    if not isinstance(found, Apply) or found.operator not in ("==", "<", "<=", ">", ">=", "!="):
        return found
    left, right = found.operands
    return replace(
        found, operands=(left, Number(right.value + by) if isinstance(right, Number) else Apply("+", (right, Number(by))))
    )


misconception("condition one off", in_comparisons)(partial(_bound_moved, -1))
misconception("condition one off", in_comparisons)(partial(_bound_moved, 1))
misconception("strictness confused", in_comparisons)(partial(with_operator, OTHER_STRICTNESS))


@misconception("condition dropped", in_each_rule)
def condition_dropped(rule: Production) -> Production:
    return replace(rule, condition=None)


@misconception("condition after the step", in_mind)
def condition_after_the_step(system: LSystem) -> Iterator[LSystem]:
    return rewritten(_asked_late, system)


def _asked_late(rule: Production) -> Production:
    formal = rule.predecessor
    own = next(
        (
            item
            for item in rule.successor
            if isinstance(item, Pattern) and item.symbol == formal.symbol and len(item.arguments) == len(formal.arguments)
        ),
        None,
    )
    if rule.condition is None or own is None:
        return rule
    later = {name.name: made for name, made in zip(formal.arguments, own.arguments, strict=True) if isinstance(name, Name)}
    return replace(rule, condition=substituted(rule.condition, later))


def _one_less(argument: Expression) -> Expression:
    return Number(argument.value - 1) if isinstance(argument, Number) else argument


@misconception("stages from zero", in_all_rules)
def stages_from_zero(rule: Production) -> Production:
    """The numbers in a successor one too small, as if stages were counted from 0."""
    return replace(rule, successor=_with_arguments(_one_less, rule.successor))


@misconception("stages from zero")
def all_stages_from_zero(exercise: Exercise) -> Iterator[object]:
    """The numbers of the axiom and of successors one too small, and perhaps those of conditions; where nothing is given."""
    if exercise.kind == "system" and not exercise.given:
        for change in (stages_from_zero, _bounds_from_zero):
            yield from by_systems(partial(rewritten, change, word=partial(_with_arguments, _one_less)), exercise)


def _bounds_from_zero(rule: Production) -> Production:
    rule = stages_from_zero(rule)
    return rule if rule.condition is None else replace(rule, condition=changed(rule.condition, _with_bound_from_zero))


def _with_bound_from_zero(found: Expression) -> Expression:
    if isinstance(found, Apply) and found.operator in OTHER_DIRECTION:
        return replace(found, operands=tuple(map(_one_less, found.operands)))
    return found


@misconception("context overlooked", in_all_rules)
def context_overlooked(rule: Production) -> Production:
    return replace(rule, left=(), right=())


@misconception("context sides swapped", in_all_rules)
def context_sides_swapped(rule: Production) -> Production:
    return replace(rule, left=rule.right, right=rule.left)


# What is drawn


def in_words(change: Callable[[Items], tuple[Item, ...]], exercise: Exercise) -> Iterator[object]:
    """The answers of somebody who takes commands for others, in the axiom and in successors."""
    return by_systems(lambda system: rewritten(partial(_with_items, change), system, change), exercise)


misconception("plus and minus swapped", in_words)(
    partial(_with_symbols, {"+": "-", "-": "+", "/": "\\", "\\": "/", "&": "^", "^": "&"})
)
misconception("pen up", in_words)(partial(_with_symbols, {"f": "F"}))
misconception("pen up", in_words)(partial(_with_symbols, {"F": "f"}))


@misconception("bracket sides swapped", by_systems)
def bracket_sides_swapped(system: LSystem) -> Iterator[LSystem]:
    """[ ] for ( ) in a plant string, where they are branches to the two sides."""
    others = partial(_with_symbols, {"[": "(", "]": ")", "(": "[", ")": "]"})
    return rewritten(partial(_with_items, others), system, others) if system.notation == "plant-string" else iter(())


@misconception("brackets dropped", in_words)
def brackets_dropped(items: Items) -> tuple[Item, ...]:
    """Branches drawn as parts of their stem: as if the turtle never returned."""
    return tuple(item for item in items if not (isinstance(item, Pattern) and item.symbol in OPENING | CLOSING))


@misconception("angle between strokes", by_turns)
def angle_supplement(system: LSystem) -> Iterator[LSystem]:
    yield replace(system, angle=180 - system.angle, source="")


@misconception("angle of the whole fork", by_turns)
def angle_halved_or_doubled(system: LSystem) -> Iterator[LSystem]:
    yield replace(system, angle=2 * system.angle, source="")
    yield replace(system, angle=system.angle / 2, source="")
