"""Whether two expressions are equal: by proof, or in each of some cases."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import TypeAlias

from lsys_kit.notation.model.arithmetic import Value, number_text, reason_of
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, function_of, to_sympy
from lsys_kit.translation import gettext

Valuations: TypeAlias = Mapping[str, Value]
"""A value for each name."""
MOST_NODES = 40
"""Operators, names and numbers of an expression that sympy is asked about."""
MOST_PROOF_DEGREE = 12
"""Its degree, with the exponents of its numbers: larger powers are not expanded."""


def differing_values(mine: Expression, wanted: Expression, cases: Iterable[Valuations]) -> str | None:
    """The first case in which two expressions have different values, or None.

    >>> from lsys_kit.notation.read import read_expression
    >>> differing_values(read_expression("t"), read_expression("2*t"), [{"t": 0}, {"t": 1}])
    'With t = 1 your expression gives 1, and it should give 2.'
    """
    for case in cases:
        own, right = _value_or_reason(mine, case), _value_or_reason(wanted, case)
        if not _equal_values(own, right):
            where = gettext(" and ").join(f"{name} = {number_text(value)}" for name, value in case.items())
            if isinstance(own, str):
                return gettext(
                    "With {values} your expression has no value ({reason}), and it should give {right}.",
                    values=where,
                    reason=own,
                    right=_value_text(right),
                )
            return gettext(
                "With {values} your expression gives {own}, and it should give {right}.",
                values=where,
                own=_value_text(own),
                right=_value_text(right),
            )
    return None


def _value_or_reason(expression: Expression, case: Valuations) -> Value | str:
    """The value, or in words the reason why there is none."""
    try:
        run = function_of(expression, {name: i for i, name in enumerate(case)})
        return run(tuple(case.values()))  # type: ignore[no-any-return]
    except (ArithmeticError, ValueError) as fault:
        return reason_of(fault)


def _equal_values(own: Value | str, right: Value | str) -> bool:
    """Whether two values are equal: exactly where they are exact, up to rounding where one is a double."""
    if isinstance(own, str) or isinstance(right, str):
        return False
    return math.isclose(own, right, rel_tol=1e-9) if isinstance(own, float) or isinstance(right, float) else own == right


def _value_text(value: Value | str) -> str:
    return str(value).lower() if isinstance(value, str | bool) else number_text(value)


def proved_equal(mine: Expression, wanted: Expression) -> bool:
    """Whether sympy shows that two expressions are equal whatever the values of their names.

    Also False where they are too large to be compared: sympy may never finish with a power of a power.

    >>> from lsys_kit.notation.read import read_expression
    >>> proved_equal(read_expression("(x+1)^2"), read_expression("x^2 + 2*x + 1"))
    True
    >>> proved_equal(read_expression("x^2"), read_expression("x"))
    False
    """
    if not (_is_small(mine) and _is_small(wanted)):
        return False
    import sympy

    left, right = to_sympy(mine), to_sympy(wanted)
    if isinstance(left, sympy.Rel) and isinstance(right, sympy.Rel):
        return bool(left.canonical == right.canonical)
    if not (isinstance(left, sympy.Expr) and isinstance(right, sympy.Expr)):
        return bool(left == right)
    return bool(sympy.cancel(sympy.expand(left - right)) == 0)


def _is_small(expression: Expression) -> bool:
    return _nodes(expression) <= MOST_NODES and _degree(expression) <= MOST_PROOF_DEGREE


def _nodes(expression: Expression) -> int:
    return 1 + (sum(map(_nodes, expression.operands)) if isinstance(expression, Apply) else 0)


def _degree(expression: Expression) -> float:
    """A bound for the degree of an expression; infinite where sympy might have to work out something very large."""
    if not isinstance(expression, Apply):
        return 0 if isinstance(expression, Number) else 1
    degrees = [_degree(operand) for operand in expression.operands]
    if expression.operator == "^":
        return max(1.0, degrees[0]) * _exponent(expression.operands[1])
    if expression.operator in ("&&", "||", "!"):
        return math.inf
    return sum(degrees) if expression.operator in ("*", "/") else max(degrees)


def _exponent(expression: Expression) -> float:
    if isinstance(expression, Number):
        return abs(float(expression.value))
    return 1 if isinstance(expression, Name) else math.inf


def is_rational(expression: Expression) -> bool:
    """Whether an expression is built of numbers, names and + - * / and whole powers, so that equality can be decided.

    >>> from lsys_kit.notation.read import read_expression
    >>> is_rational(read_expression("(d - s)^2 / 2")), is_rational(read_expression("max(d, s)"))
    (True, False)
    """
    if not isinstance(expression, Apply):
        return True
    if expression.operator == "^":
        base, power = expression.operands
        return is_rational(base) and isinstance(power, Number) and power.value == int(power.value) and _is_small(expression)
    return (
        expression.operator in ("+", "-", "*", "/", "-x")
        and _is_small(expression)
        and all(map(is_rational, expression.operands))
    )
