"""Repairs of formulas: a number, a name, a sign, a comparison, a power of them changed, left out or added."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import islice

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.expressions import agreement
from lsys_kit.classroom.exercises.repairs.of_systems import changed_once
from lsys_kit.classroom.exercises.repairs.repair import Repair
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, expression_type, names_in, walk
from lsys_kit.notation.read import read_expression

_COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
_JOINED = ("&&", "||")
_OF_NUMBERS = ("+", "-", "*", "/")
_GROUPED = (*_OF_NUMBERS, "^")
KINDS = (
    *("contrary", "grouping", "extra", "number", "name", "comparison", "joined", "operator", "sign", "power", "no_power"),
    *("order", "part", "missing"),
)
"""The kinds of changes, in the order in which they are tried."""
MOST_PAIRS = 2_000
"""So many pairs of changes are tried."""


def of_expressions(exercise: Exercise, own: Expression, solution: Expression) -> Iterator[Repair]:
    """Repairs of a formula: those of one part, then those of two."""
    names, agrees = list(exercise.values), agreement(exercise, solution)
    parts = [part for part in walk(solution) if isinstance(part, Apply) and part != solution]
    numbers = {part.value for part in walk(solution) if isinstance(part, Number)}

    def simple(part: Expression) -> Iterator[tuple[Expression, str]]:
        yield from _variants(part, names, numbers)

    def of_the_solution(part: Expression) -> Iterator[tuple[Expression, str]]:
        kind = expression_type(part)
        others = [other for other in parts if expression_type(other) == kind and other != part]
        yield from ((other, "part") for other in others)
        for sign in _JOINED if kind == "truth" else (*_OF_NUMBERS, "^"):
            yield from ((Apply(sign, (part, other)), "missing") for other in others)

    small: dict[Expression, str] = {}
    contrary = [(Apply("!", (own,)), "contrary")] if expression_type(own) == "truth" else []
    for changed, kind in (*contrary, *changed_once(own, simple), *_with_other_signs(own), *changed_once(own, of_the_solution)):
        small.setdefault(changed, kind)
    for changed, kind in sorted(small.items(), key=lambda each: KINDS.index(each[1])):
        if agrees(changed):
            yield Repair(partial(_as_it_is, changed), partial(reply, f"repair.formula_{kind}"), case=True)
    if not names_in(own) and names_in(solution):
        return
    once = dict(changed_once(own, simple))
    twice = ((other, kind) for changed, kind in once.items() for other, _ in changed_once(changed, simple))
    right = [each for each in islice(twice, MOST_PAIRS) if agrees(each[0])]
    for changed, kind in sorted(right, key=lambda each: KINDS.index(each[1])):
        yield Repair(partial(_as_it_is, changed), partial(_two_said, kind), near=False, case=True, changes=2)


def _as_it_is(changed: Expression) -> Expression:
    return changed


def _two_said(kind: str) -> str:
    return f"{reply('repair.two')} {reply(f'repair.of_two_{kind}')}"


def _variants(part: Expression, names: list[str], numbers: set[Value]) -> Iterator[tuple[Expression, str]]:
    """What may be meant in place of a part of a formula, and what kind of change that is."""
    if isinstance(part, Number):
        values = dict.fromkeys([part.value + 1, part.value - 1, *numbers])
        yield from ((Number(value), "number") for value in values if value not in (part.value, -part.value))
    elif isinstance(part, Name):
        yield from ((Name(name), "name") for name in names if name != part.name)
    else:
        yield from ((other, "grouping") for other in _grouped_otherwise(part))
        yield from _other_operators(part)
        yield from ((operand, "extra") for operand in part.operands if expression_type(operand) == expression_type(part))
    if expression_type(part) == "number":
        for number in (Number(1), Number(2)):
            yield from ((Apply(operator, (part, number)), "missing") for operator in ("+", "-", "*", "/"))
        yield Apply("^", (part, Number(2))), "no_power"
        yield Apply("-x", (part,)), "sign"
        for name in names:
            yield from ((Apply(operator, (part, Name(name))), "missing") for operator in (*_OF_NUMBERS, "^"))


_SIGN = re.compile(r"(?<= )[-+*/](?= )|(?<=[\w)])/(?=[\w(])")


def _with_other_signs(own: Expression) -> Iterator[tuple[Expression, str]]:
    """A formula with one of its signs changed as it is written, so that its parts may belong together otherwise.

    >>> from lsys_kit.notation.read import read_expression
    >>> [str(found) for found, _ in _with_other_signs(read_expression("a * 2*b"))][:3]
    ['a + 2 * b', 'a - 2 * b', 'a/2 * b']
    """
    text = str(own)
    for found in _SIGN.finditer(text):
        for sign in _OF_NUMBERS:
            if sign != found[0]:
                yield read_expression(f"{text[: found.start()]}{sign}{text[found.end() :]}"), "operator"


def _grouped_otherwise(part: Apply) -> Iterator[Expression]:
    """The same row of signs, names and numbers with one pair of parentheses more, or one less.

    >>> from lsys_kit.notation.read import read_expression
    >>> print(*_grouped_otherwise(read_expression("q^n - 1")), sep="; ")
    q^(n - 1)
    >>> print(*_grouped_otherwise(read_expression("2 * q^n")), sep="; ")
    (2 * q)^n
    """
    if len(part.operands) == 1:
        inner = part.operands[0]
        if part.operator == "-x" and isinstance(inner, Apply) and inner.operator in _GROUPED:
            yield replace(inner, operands=(replace(part, operands=inner.operands[:1]), inner.operands[1]))
        return
    if part.operator not in _GROUPED:
        return
    left, right = part.operands
    if isinstance(left, Apply) and left.operator in _GROUPED:
        yield replace(left, operands=(left.operands[0], replace(part, operands=(left.operands[1], right))))
    if isinstance(left, Apply) and left.operator == "-x":
        yield replace(left, operands=(replace(part, operands=(left.operands[0], right)),))
    if isinstance(right, Apply) and right.operator in _GROUPED:
        yield replace(right, operands=(replace(part, operands=(left, right.operands[0])), right.operands[1]))


def _other_operators(part: Apply) -> Iterator[tuple[Expression, str]]:
    operator = part.operator
    for group, kind in ((_COMPARISONS, "comparison"), (_JOINED, "joined"), (_OF_NUMBERS, "operator")):
        if operator in group:
            yield from ((replace(part, operator=other), kind) for other in group if other != operator)
    if operator in ("-", "/", "^"):
        yield replace(part, operands=part.operands[::-1]), "order"
    if operator in ("*", "^"):
        yield replace(part, operator="^" if operator == "*" else "*"), "operator" if operator == "*" else "power"
