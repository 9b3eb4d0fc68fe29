"""Repairs of systems: an axiom, a production, a part of one, an order, a setting changed, left out or added.

A change is one in a slot of the typed system, so that changes of different slots can be made together. What is put there comes
from the solution, in the names of the answer; where the answer is written in another way than the solution, numbers and
comparisons of its own are moved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import combinations, product
from typing import Any, TypeAlias

from lsys_kit.classroom.exercises.asked import system_of
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.forms import is_sensible, rules_with, with_names
from lsys_kit.classroom.exercises.kinds.systems import (
    SystemAnswer,
    asked_modules,
    bounds_of,
    completed,
    joined_names,
    names_in_other_case,
    numbers_compared,
    renamed_as_in,
    renaming,
    typed_rule,
    whole,
    words_parting,
    wrongly_replaced,
)
from lsys_kit.classroom.exercises.repairs.repair import Repair, class_of, row_change, said_of_row
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.derivation.core.states import States
from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, function_of, substituted
from lsys_kit.notation.model.modules import Module, Pattern, with_expressions
from lsys_kit.notation.model.system import LSystem, Production

BLOCKS = ("productions", "decomposition")
SETTINGS = ("angle", "heading", "length")
Changed: TypeAlias = tuple[LSystem, Callable[[], str]]
"""A changed system, and what is said of the change."""
MOST_RULES = 8
"""Of longer systems no orders, exchanges and pairs of changes are tried."""


@dataclass(frozen=True)
class Edit:
    """A change of one slot of a system.

    Attributes
    ----------
    slot
        A setting or "axiom"; or a block of productions with a number in it, or with -1 for one more.
    value
        What is put there; None leaves a production out.
    said
        What is said of it.
    near
        Whether it is small.
    besides
        What is said of it where another change is needed too, if that is something else.
    """

    slot: tuple[str, int]
    value: Any
    said: Callable[[], str]
    near: bool = True
    besides: Callable[[], str] | None = None


def applied(system: LSystem, *edits: Edit) -> LSystem:
    """A system with some slots changed."""
    blocks: dict[str, list[Production | None]] = {name: list(getattr(system, name)) for name in BLOCKS}
    settings: dict[str, Any] = {}
    for edit in edits:
        name, at = edit.slot
        if name not in BLOCKS:
            settings[name] = edit.value
        elif at < 0:
            blocks[name].append(edit.value)
        else:
            blocks[name][at] = edit.value
    rules: dict[str, Any] = {name: tuple(rule for rule in block if rule is not None) for name, block in blocks.items()}
    return replace(system, **settings, **rules)


def of_systems(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> Iterator[Repair]:
    """Repairs of an answer that is a system, or a part of one."""
    is_whole = mine.front is mine.own and bool(exercise.given)
    target = renamed_as_in(exercise, mine, wanted, wanted.behind if is_whole else wanted.own)
    make = whole if is_whole else partial(completed, exercise)
    joined = joined_names(exercise, mine)
    if joined:
        split = rules_with(mine.own, lambda symbol: joined.get(symbol, symbol).split())
        name, letters = next(iter(joined.items()))
        yield Repair(partial(make, split), partial(reply, "system.joined", name=name, letters=letters))
        mine = make(split)  # what else is wrong with it is looked for as if the letters stood apart
    others = names_in_other_case(exercise, mine)
    if others:
        own, name = next(iter(others.items()))
        yield Repair(partial(make, with_names(mine.own, others)), partial(reply, "repair.other_case", own=own, name=name))
    reached = _modules(exercise, mine, wanted)
    blamed = _blamed(exercise, mine, wanted, reached)
    given = () if is_whole or not exercise.given else system_of(exercise.given).productions
    has_axiom = not exercise.given or is_whole
    settings = SETTINGS if exercise.drawn else ()
    own_ones = _left_over(exercise, reached) if exercise.behind and not is_whole else reached
    yield from repairs_of(mine.own, target, make, own_ones, settings, has_axiom, blamed, given)


def _left_over(exercise: Exercise, modules: Sequence[Module]) -> list[Module]:
    """The modules to which no production that the question gives applies, before the others."""
    states = States(system_of(exercise.given))
    return sorted(modules, key=lambda module: _production_of(states, module) is not None)


def _blamed(
    exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer, reached: Sequence[Module]
) -> Callable[[Production], bool]:
    """Whether a production may be wrong: it applies to a module of which something else should become, or to none at all."""
    names = renaming(exercise, wanted.behind)
    with suppress(LSystemError):
        words_parting(mine.behind, wanted.behind, names, exercise.steps)
        wrong = set(wrongly_replaced(exercise, mine.behind, wanted.behind, names))
        states = States(mine.behind)
        used = {module: _production_of(states, module) for module in map(names.own, reached)}
        if wrong:
            right_ones = {used.get(module) for module in used if module not in wrong} - {used.get(module) for module in wrong}
            return lambda rule: rule not in right_ones
    return lambda _: True


def _production_of(states: States, module: Module) -> Production | None:
    state = states.number(module.symbol, module.arguments)
    number = states.production(state) if states.is_d0l(state) else None
    return None if number is None else states.system.productions[number]


def _modules(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> list[Module]:
    with suppress(LSystemError):
        return asked_modules(exercise, wanted.behind)
    return []


def repairs_of(
    own: LSystem,
    target: LSystem,
    make: Callable[[LSystem], object],
    reached: Sequence[Module] = (),
    settings: Sequence[str] = (),
    has_axiom: bool = True,
    blamed: Callable[[Production], bool] = lambda _: True,
    given: Sequence[Production] = (),
) -> Iterator[Repair]:
    """Repairs of a system, in the direction of another one, which has the same names."""
    small = [*_setting_edits(own, target, settings), *_part_edits(own, target, reached)]
    large = [
        *(_axiom_edits(own, target) if has_axiom else ()),
        *_missing(own, target, reached),
        *_superfluous(own),
        *_whole_rules(own, target, blamed, given),
    ]
    is_longer = any(len(getattr(own, block)) > len(getattr(target, block)) for block in BLOCKS)
    for edit in (*(_superfluous(own) if is_longer else ()), *small, *large):
        yield from _repairs(own, make, edit)
    for changed, said in (*_reordered(own), *_exchanged(own), *_in_the_other_block(own, target)):
        if is_sensible(changed):
            yield Repair(partial(make, changed), said)
    for edit in _blind_edits(own, target):
        yield from _repairs(own, make, edit)
    if len(own.productions) <= MOST_RULES:
        yield from _pairs(own, make, combinations(small, 2))
        yield from _pairs(own, make, (*product(small, large), *combinations(large, 2)))


def _repairs(own: LSystem, make: Callable[[LSystem], object], edit: Edit) -> Iterator[Repair]:
    changed = applied(own, edit)
    if is_sensible(changed):
        yield Repair(partial(make, changed), edit.said, edit.near)


def _pairs(own: LSystem, make: Callable[[LSystem], object], pairs: Iterable[tuple[Edit, Edit]]) -> Iterator[Repair]:
    for one, other in pairs:
        is_an_exchange = None in (one.value, other.value) and -1 in (one.slot[1], other.slot[1])  # one rule for another
        if (one.slot != other.slot or one.slot[1] == -1) and not is_an_exchange:
            changed = applied(own, one, other)
            if is_sensible(changed):
                first, second = (other, one) if one.slot[0] == "axiom" else (one, other)
                yield Repair(partial(make, changed), partial(_two_said, first, second), near=False, changes=2)


def _two_said(one: Edit, other: Edit) -> str:
    """Of two things that are to be changed the one that says more, the other when that is mended."""
    first = min((one, other), key=lambda edit: edit.slot[1] == -1)
    return f"{reply('repair.two')} {(first.besides or first.said)()}"


# The axiom, and settings


def _setting_edits(own: LSystem, target: LSystem, settings: Sequence[str]) -> Iterator[Edit]:
    for name in settings:
        if getattr(own, name) != getattr(target, name):
            said, besides = partial(reply, f"repair.{name}"), partial(reply, f"repair.{name}_too")
            yield Edit((name, 0), getattr(target, name), said, besides=besides)


def _axiom_edits(own: LSystem, target: LSystem) -> Iterator[Edit]:
    if own.axiom != target.axiom:
        yield Edit(
            ("axiom", 0), target.axiom, partial(reply, "repair.axiom"), len(own.productions) > 1, partial(reply, "system.axiom")
        )


# Parts of productions


def _part_edits(own: LSystem, target: LSystem, reached: Sequence[Module]) -> Iterator[Edit]:
    """For each production that has the same predecessor as one of the solution each part that differs, alone."""
    for block in BLOCKS:
        for at, rule in enumerate(getattr(own, block)):
            for right in _of_the_same(rule, getattr(target, block)):
                for value, said in _parts(rule, right, own, reached):
                    yield Edit((block, at), value, said)


def _of_the_same(rule: Production, others: Sequence[Production]) -> Iterator[Production]:
    """The productions for the same symbols, with the parameters of this one; those with most in common first."""
    symbols = [module.symbol for module in rule.predecessors]
    same = [other for other in others if [module.symbol for module in other.predecessors] == symbols]
    alike = [found for other in same if (found := _with_names_of(rule, other)) is not None]
    yield from sorted(alike, key=lambda other: sum(a != b for a, b in zip(_kept(rule), _kept(other), strict=True)))


def _kept(rule: Production) -> tuple[object, ...]:
    return rule.predecessors, rule.successor, rule.condition, rule.left, rule.right, rule.probability


def _with_names_of(rule: Production, other: Production) -> Production | None:
    """A production with the parameters of another one, if their predecessors have as many."""
    pairs = list(zip(rule.predecessors, other.predecessors, strict=True))
    if any(len(a.arguments) != len(b.arguments) for a, b in pairs):
        return None
    arguments = [both for a, b in pairs for both in zip(a.arguments, b.arguments, strict=True)]
    contexts = [(rule.left, other.left), (rule.right, other.right)]
    for mine, theirs in contexts:
        if [(m.symbol, len(m.arguments)) for m in mine] == [(m.symbol, len(m.arguments)) for m in theirs]:
            arguments += [
                both for a, b in zip(mine, theirs, strict=True) for both in zip(a.arguments, b.arguments, strict=True)
            ]
    values: dict[str, Expression] = {b.name: a for a, b in arguments if isinstance(a, Name) and isinstance(b, Name)}
    return _substituted(other, values)


def _substituted(rule: Production, values: Mapping[str, Expression]) -> Production:
    def change(expression: Expression) -> Expression:
        return substituted(expression, values)

    changed: dict[str, Any] = {
        name: with_expressions(getattr(rule, name), change) for name in ("predecessors", "successor", "left", "right")
    }
    for name in ("condition", "probability"):
        found = getattr(rule, name)
        changed[name] = found if found is None else change(found)
    return replace(rule, **changed)


def _parts(
    rule: Production, right: Production, own: LSystem, reached: Sequence[Module]
) -> Iterator[tuple[Production, Callable[[], str]]]:
    quoted = partial(typed_rule, rule, own)
    if rule.condition != right.condition:
        yield replace(rule, condition=right.condition), partial(_said_of_condition, rule, right, reached, quoted)
    if rule.successor != right.successor:
        yield replace(rule, successor=right.successor), partial(_said_of_successor, rule, right, quoted)
    if (rule.left, rule.right) != (right.left, right.right):
        sides = "sides" if (rule.left, rule.right) == (right.right, right.left) else "context"
        yield replace(rule, left=right.left, right=right.right), partial(_said, sides, quoted)
        if rule.successor != right.successor and rule.condition == right.condition:
            yield right, partial(_said, "context_and_successor", quoted)
    if rule.predecessors != right.predecessors:
        yield replace(rule, predecessors=right.predecessors), partial(_said, "predecessor", quoted)
    if rule.probability != right.probability:
        yield replace(rule, probability=right.probability), partial(_said, "probability", quoted)


def _said(name: str, quoted: Callable[[], str]) -> str:
    return reply(f"repair.{name}") + quoted()


def _said_of_successor(rule: Production, right: Production, quoted: Callable[[], str]) -> str:
    change = row_change(rule.successor, right.successor)
    if change == "several":
        return _said("successor", quoted)
    return f"{said_of_row(rule.successor, right.successor)} {reply('system.this_production')}{quoted()}"


def _said_of_condition(rule: Production, right: Production, reached: Sequence[Module], quoted: Callable[[], str]) -> str:
    module = _told_apart(rule, right, reached)
    kind = _kind_of_change(rule.condition, right.condition)
    if module is None:
        return _said("condition", quoted)
    return reply(f"repair.{kind}_at", module=module) + quoted()


def _kind_of_change(own: Expression | None, right: Expression | None) -> str:
    """Whether a condition is missing or too much, or whether only its comparison or its bound differs."""
    if own is None or right is None:
        return "no_condition" if own is None else "a_condition"
    if isinstance(own, Apply) and isinstance(right, Apply):
        if own.operands == right.operands:
            return "comparison"
        if own.operator == right.operator and own.operands[0] == right.operands[0]:
            return "bound"
    return "condition"


def _told_apart(rule: Production, right: Production, reached: Sequence[Module]) -> Module | None:
    """A module to which one of two productions applies and the other does not: one of the question, or one near a bound."""
    if len(rule.predecessors) != 1 or rule.left or rule.right:
        return None
    symbol, names = rule.predecessor.symbol, [a.name if isinstance(a, Name) else "" for a in rule.predecessor.arguments]
    if len(set(names)) < len(names) or not names:
        return None
    tried = [module for module in reached if module.symbol == symbol and len(module.arguments) == len(names)]
    if len(names) == 1:
        tried += [Module(symbol, (value,)) for value in _near_bounds(rule, right)]
    order = {name: at for at, name in enumerate(names)}
    for module in tried:
        with suppress(ArithmeticError, ValueError, KeyError, LSystemError):
            truths = [c is None or bool(function_of(c, order)(module.arguments)) for c in (rule.condition, right.condition)]
            if truths[0] != truths[1]:
                return module
    return None


def _near_bounds(*rules: Production) -> Iterator[Any]:
    """Numbers at the bounds of conditions, between them, and beside them."""
    bounds = sorted(numbers_compared(*rules))
    yield from bounds_of(*rules)
    yield from (bound + by for bound in bounds for by in (-1, 1, Fraction(-1, 2), Fraction(1, 2)))


# Whole productions


def _missing(own: LSystem, target: LSystem, reached: Sequence[Module]) -> Iterator[Edit]:
    """Productions of the solution for modules that stay as they are."""
    for block in BLOCKS:
        rules = getattr(own, block)
        for right in getattr(target, block):
            module = _staying(own if block == "productions" else replace(own, productions=own.decomposition), right, reached)
            if module is None:
                continue
            text = "missing_production" if block == "productions" else "missing_decomposition"
            yield Edit((block, -1), right, partial(reply, f"repair.{text}", module=module), len(rules) > 1)


def _staying(own: LSystem, right: Production, reached: Sequence[Module]) -> object | None:
    """A module that a production of the solution replaces, and none of the answer; its symbol, if it has none for that."""
    symbol = right.predecessor.symbol
    if not any(rule.predecessor.symbol == symbol for rule in own.productions):
        known = [module for module in reached if module.symbol == symbol]
        return next((module for module in known if _applies(right, module)), known[0] if known else right.predecessor)
    with suppress(LSystemError):
        states = States(own)
        for module in reached:
            state = states.number(module.symbol, module.arguments)
            stays = states.is_d0l(state) and states.production(state) is None
            if stays and module.symbol == symbol and _applies(right, module):
                return module
    return None


def _applies(rule: Production, module: Module) -> bool:
    if len(rule.predecessors) != 1 or rule.left or rule.right or len(rule.predecessor.arguments) != len(module.arguments):
        return False
    names = {a.name: at for at, a in enumerate(rule.predecessor.arguments) if isinstance(a, Name)}
    fixed = all(
        isinstance(a, Name) or (isinstance(a, Number) and a.value == value)
        for a, value in zip(rule.predecessor.arguments, module.arguments, strict=True)
    )
    with suppress(ArithmeticError, ValueError, KeyError):
        return fixed and (rule.condition is None or bool(function_of(rule.condition, names)(module.arguments)))
    return False


def _superfluous(own: LSystem) -> Iterator[Edit]:
    for block in BLOCKS:
        for at, rule in enumerate(getattr(own, block)):
            yield Edit((block, at), None, partial(_said, "extra_production", partial(typed_rule, rule, own)))


def _whole_rules(
    own: LSystem, target: LSystem, blamed: Callable[[Production], bool], given: Sequence[Production]
) -> Iterator[Edit]:
    """A production for another one: of those for the same symbols, then of all that the answer has not."""
    found: list[tuple[str, Edit]] = []
    for block in BLOCKS:
        rules = getattr(own, block)
        for at, rule in enumerate(rules):
            for right in getattr(target, block):
                if right not in rules and blamed(rule):
                    kind = _kind_of_rule(rule, right, given)
                    said = partial(_said_of_rule, kind, rule, own)
                    found.append((kind, Edit((block, at), right, said, kind == "predecessor")))
    yield from (edit for _, edit in sorted(found, key=lambda each: KINDS_OF_RULES.index(each[0])))


KINDS_OF_RULES = ("production", "predecessor", "given_already", "predecessor_too")
"""How a whole production may be wrong, in the order in which that is looked for."""


def _kind_of_rule(rule: Production, right: Production, given: Sequence[Production]) -> str:
    if [m.symbol for m in right.predecessors] == [m.symbol for m in rule.predecessors]:
        return "production"
    if rule.successor == right.successor:
        return "predecessor"
    taken = any(
        other.predecessors == rule.predecessors and not (other.left or other.right or other.condition) for other in given
    )
    return "given_already" if taken else "predecessor_too"


def _said_of_rule(kind: str, rule: Production, own: LSystem) -> str:
    if kind == "given_already":
        return reply("system.given_already", module=rule.predecessor)
    return _said(kind, partial(typed_rule, rule, own))


def _reordered(own: LSystem) -> Iterator[Changed]:
    """One production moved in front of another, where both are for the same symbol."""
    rules = own.productions
    if len(rules) > MOST_RULES:
        return
    for one, other in combinations(range(len(rules)), 2):
        if rules[one].predecessor.symbol == rules[other].predecessor.symbol:
            moved = [*rules[:one], rules[other], *rules[one:other], *rules[other + 1 :]]
            yield replace(own, productions=tuple(moved)), partial(reply, "repair.rule_order")


def _exchanged(own: LSystem) -> Iterator[Changed]:
    """The successors of two productions exchanged."""
    rules = own.productions
    for one, other in combinations(range(len(rules)), 2) if len(rules) <= MOST_RULES else ():
        if rules[one].successor != rules[other].successor:
            swapped = list(rules)
            swapped[one] = replace(rules[one], successor=rules[other].successor)
            swapped[other] = replace(rules[other], successor=rules[one].successor)
            modules = {"one": rules[one].predecessor, "other": rules[other].predecessor}
            yield replace(own, productions=tuple(swapped)), partial(reply, "repair.exchanged", **modules)


def _in_the_other_block(own: LSystem, target: LSystem) -> Iterator[Changed]:
    """A production written as a decomposition rule, or the other way round, where the solution has such a rule there."""
    for block, other in (BLOCKS, BLOCKS[::-1]):
        there = {each.predecessor.symbol for each in getattr(target, other)}
        for at, rule in enumerate(getattr(own, block)):
            if rule.predecessor.symbol not in there:
                continue
            rest = getattr(own, block)[:at] + getattr(own, block)[at + 1 :]
            moved: dict[str, Any] = {block: rest, other: (*getattr(own, other), rule)}
            said = partial(_said, f"in_{other}", partial(typed_rule, rule, own))
            yield replace(own, **moved), said


# Where the answer is written in another way


_COMPARISONS = ("<", "<=", "==", ">=", ">", "!=")


def _blind_edits(own: LSystem, target: LSystem) -> Iterator[Edit]:
    """Numbers and comparisons of the answer's own productions moved, neighbours in a successor exchanged, a module left out."""
    for block in BLOCKS:
        for at, rule in enumerate(getattr(own, block)):
            quoted = partial(typed_rule, rule, own)
            if rule.condition is not None:
                for condition, kind in changed_once(rule.condition, _moved):
                    yield Edit((block, at), replace(rule, condition=condition), partial(_said, kind, quoted))
            for successor in _rows(rule.successor):
                said = partial(_said_of_successor, rule, replace(rule, successor=successor), quoted)
                yield Edit((block, at), replace(rule, successor=successor), said)


def _rows(row: Sequence[object]) -> Iterator[tuple[object, ...]]:
    """Successors that differ by one thing: two neighbours, a sign, a pen, a number."""
    for at in range(len(row) - 1):
        if row[at] != row[at + 1]:
            yield (*row[:at], row[at + 1], row[at], *row[at + 2 :])
    others = {"+": "-", "-": "+", "F": "f", "f": "F", "/": "\\", "\\": "/", "&": "^", "^": "&"}
    for at, part in enumerate(row):
        if not isinstance(part, Pattern):
            continue
        if part.symbol in others:
            yield (*row[:at], replace(part, symbol=others[part.symbol]), *row[at + 1 :])
        for number, argument in enumerate(part.arguments):
            for changed, _ in changed_once(argument, _moved):
                arguments = (*part.arguments[:number], changed, *part.arguments[number + 1 :])
                yield (*row[:at], replace(part, arguments=arguments), *row[at + 1 :])
    for at, part in enumerate(row):
        if class_of(getattr(part, "symbol", "[")) != "bracket":
            yield (*row[:at], *row[at + 1 :])


def _moved(part: Expression) -> Iterator[tuple[Expression, str]]:
    if isinstance(part, Number):
        yield from ((replace(part, value=part.value + by), "bound") for by in (1, -1))
    elif isinstance(part, Apply) and part.operator in _COMPARISONS:
        yield from ((replace(part, operator=other), "comparison") for other in _COMPARISONS if other != part.operator)


def changed_once(
    expression: Expression, change: Callable[[Expression], Iterator[tuple[Expression, str]]]
) -> Iterator[tuple[Expression, str]]:
    """An expression with one of its parts changed, in each way in turn, and what kind of change that is.

    >>> from lsys_kit.notation.read import read_expression
    >>> [str(found) for found, _ in changed_once(read_expression("s + 1"), _moved)]
    ['s + 2', 's + 0']
    """
    yield from change(expression)
    if isinstance(expression, Apply):
        for at, operand in enumerate(expression.operands):
            for changed, kind in changed_once(operand, change):
                yield replace(expression, operands=(*expression.operands[:at], changed, *expression.operands[at + 1 :])), kind
