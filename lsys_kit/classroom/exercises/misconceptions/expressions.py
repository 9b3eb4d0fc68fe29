"""Misconceptions about formulas and numbers: from the right one to those that somebody writes instead."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import combinations

from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, expression_type, names_in


def one_more(formula: Expression) -> Iterator[Expression]:
    """One added to a number."""
    if expression_type(formula) == "number":
        yield Apply("+", (formula, Number(1)))


def one_less(formula: Expression) -> Iterator[Expression]:
    """One taken from a number."""
    if expression_type(formula) == "number":
        yield Apply("-", (formula, Number(1)))


def names_exchanged(formula: Expression) -> Iterator[Expression]:
    """Two names exchanged.

    >>> from lsys_kit.notation.read import read_expression
    >>> print(*names_exchanged(read_expression("d - s + 1")))
    s - d + 1
    """
    for one, other in combinations(sorted(names_in(formula)), 2):
        exchanged = {one: Name(other), other: Name(one)}

        def change(found: Expression, exchanged: dict[str, Name] = exchanged) -> Expression:
            return exchanged.get(found.name, found) if isinstance(found, Name) else found

        yield _changed(formula, change)


def sign_reversed(formula: Expression) -> Iterator[Expression]:
    """The opposite number."""
    if expression_type(formula) == "number":
        yield Apply("-x", (formula,))


def added_for_multiplied(formula: Expression) -> Iterator[Expression]:
    """A sum in place of a product."""
    yield from _with_operator(formula, "*", "+")


def multiplied_for_raised(formula: Expression) -> Iterator[Expression]:
    """A product in place of a power of which the exponent grows: growth that is linear in place of exponential."""
    yield from _with_powers(formula, lambda power: replace(power, operator="*"), of_names=True)


def multiplied_for_squared(formula: Expression) -> Iterator[Expression]:
    """Two times a number in place of its square.

    >>> from lsys_kit.notation.read import read_expression
    >>> print(*multiplied_for_squared(read_expression("x^2 > L^2")), *power_left_out(read_expression("x^2 > L^2")), sep="; ")
    x * 2 > L * 2; x > L
    """
    yield from _with_powers(formula, lambda power: replace(power, operator="*"), of_names=False)


def power_left_out(formula: Expression) -> Iterator[Expression]:
    """A number in place of its power."""
    yield from _with_powers(formula, lambda power: power.operands[0], of_names=False)


def _with_powers(formula: Expression, change: Callable[[Apply], Expression], of_names: bool) -> Iterator[Expression]:
    """A formula with its powers changed, those with names in the exponent or the others."""

    def changed(found: Expression) -> Expression:
        is_meant = isinstance(found, Apply) and found.operator == "^" and bool(names_in(found.operands[1])) == of_names
        return change(found) if is_meant and isinstance(found, Apply) else found

    yield from _if_changed(formula, changed)


def ratio_inverted(formula: Expression) -> Iterator[Expression]:
    """Dividend and divisor exchanged."""

    def change(found: Expression) -> Expression:
        return replace(found, operands=found.operands[::-1]) if isinstance(found, Apply) and found.operator == "/" else found

    yield from _if_changed(formula, change)


_OTHER_STRICTNESS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
_OTHER_DIRECTION = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "!=", "!=": "=="}


def strictness_confused(formula: Expression) -> Iterator[Expression]:
    """`<` for `<=`, or the other way round."""
    yield from _with_operators(formula, _OTHER_STRICTNESS)


def comparison_reversed(formula: Expression) -> Iterator[Expression]:
    """`<` for `>`, or the other way round."""
    yield from _with_operators(formula, _OTHER_DIRECTION)


def radians_in_formula(formula: Expression) -> Iterator[Expression]:
    """Angles of sine, cosine and tangent in radians, where the kit's are in degrees."""

    def change(found: Expression) -> Expression:
        if not (isinstance(found, Apply) and found.operator in ("sin", "cos", "tan")):
            return found
        return replace(found, operands=(Apply("*", (found.operands[0], Number(Fraction(math.pi / 180)))),))

    yield from _if_changed(formula, change)


def _with_operator(formula: Expression, one: str, other: str) -> Iterator[Expression]:
    yield from _with_operators(formula, {one: other})


def _with_operators(formula: Expression, table: dict[str, str]) -> Iterator[Expression]:
    def change(found: Expression) -> Expression:
        return replace(found, operator=table.get(found.operator, found.operator)) if isinstance(found, Apply) else found

    yield from _if_changed(formula, change)


def _if_changed(formula: Expression, change: Callable[[Expression], Expression]) -> Iterator[Expression]:
    wrong = _changed(formula, change)
    if wrong != formula:
        yield wrong


def _changed(formula: Expression, change: Callable[[Expression], Expression]) -> Expression:
    """A formula with each of its parts changed, from the innermost on."""
    if isinstance(formula, Apply):
        formula = replace(formula, operands=tuple(_changed(operand, change) for operand in formula.operands))
    return change(formula)


# Numbers


def next_number(number: Value) -> Iterator[Value]:
    """The number one greater, and one smaller."""
    yield from (number + 1, number - 1)


def other_angle_unit(number: Value) -> Iterator[Value]:
    """Degrees for radians, or the other way round."""
    yield from (math.degrees(number), math.radians(number))


def supplement(number: Value) -> Iterator[Value]:
    """The angle between two strokes for that by which the turtle turns, or the other way round."""
    yield 180 - number


def opposite(number: Value) -> Iterator[Value]:
    """The other sign."""
    if number:
        yield -number


def inverse(number: Value) -> Iterator[Value]:
    """One divided by it."""
    if number not in (0, 1, -1):
        yield Fraction(1) / number if not isinstance(number, float) else 1 / number


def complement(number: Value) -> Iterator[Value]:
    """The rest to one: the probability of the contrary."""
    if 0 <= number <= 1:
        yield 1 - number


def percent(number: Value) -> Iterator[Value]:
    """The number of percent for the number itself."""
    if number:
        yield 100 * number
