"""Arithmetic expressions: trees that are read from text, printed, run as functions and shown by sympy.

An expression is a number, a name, or an operator applied to expressions. One table, `OPERATORS`, says for each operator
how it is written, what it computes and whether it deals in numbers or in truths; everything else here walks the tree.
Nothing is ever compiled from text: a function is put together from the functions of its operands.

Decimal literals are rational numbers, and arithmetic is exact (see `arithmetic`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

from lsys_kit.notation.arithmetic import Value, divide, exact, number_text, power, real, rounded

if TYPE_CHECKING:
    import sympy

Place: TypeAlias = tuple[int, int] | None
"""The offsets in the text between which something was read."""
Function: TypeAlias = Callable[[tuple[Value, ...]], Any]
"""What an expression is run as: from the values of its names, in a fixed order, to its own value."""


@dataclass(frozen=True)
class Number:
    """A literal number.

    >>> from fractions import Fraction
    >>> print(Number(Fraction(7, 10)))
    0.7
    """

    value: Value
    at: Place = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return number_text(self.value)


@dataclass(frozen=True)
class Name:
    """A parameter or a constant."""

    name: str
    at: Place = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True)
class Apply:
    """An operator of the table `OPERATORS`, applied to its operands.

    >>> print(Apply("*", (Name("x"), Apply("+", (Name("t"), Number(1))))))
    x * (t + 1)
    """

    operator: str
    operands: tuple[Expression, ...]
    at: Place = field(default=None, compare=False, repr=False)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "depth", 1 + max(getattr(operand, "depth", 0) for operand in self.operands))

    def __str__(self) -> str:
        operator = OPERATORS[self.operator]
        if operator.precedence is None:
            return f"{self.operator}({', '.join(map(str, self.operands))})"
        if len(self.operands) == 1:
            tightly = 7 if self.operator == "!" else operator.precedence  # !(t < 5): without parentheses C negates t
            return self.operator[0] + _within(self.operands[0], tightly)
        left, right = self.operands
        power = self.operator == "^"
        return (_within(left, operator.precedence + power) + operator.spelling(self.operator)
                + _within(right, operator.precedence + (not power)))


Expression: TypeAlias = Number | Name | Apply


def _within(expression: Expression, precedence: int) -> str:
    """The operand's text, in parentheses where it binds less tightly than its surroundings."""
    own: int | None = None
    if isinstance(expression, Apply):
        own = OPERATORS[expression.operator].precedence
    elif isinstance(expression, Number):
        text = str(expression)
        own = 5 if "/" in text else 6 if text.startswith("-") else None
    return f"({expression})" if own is not None and own < precedence else str(expression)


def _strict(function: Callable[..., Any]) -> Callable[..., Function]:
    """An operator that needs all its operands: run them, then it."""

    def build(*operands: Function) -> Function:
        if len(operands) == 2:
            left, right = operands
            return lambda v: function(left(v), right(v))
        if len(operands) == 1:
            (only,) = operands
            return lambda v: function(only(v))
        return lambda v: function(*[operand(v) for operand in operands])

    return build


@dataclass(frozen=True)
class Operator:
    """How an operator runs, binds and what it deals in.

    Attributes
    ----------
    build
        From the functions of the operands to the function of the whole.
    precedence
        How tightly it binds; None for a function that is written `name(...)`.
    takes, gives
        "number" or "truth".
    arity
        The least and the greatest number of operands.
    """

    build: Callable[..., Function]
    precedence: int | None
    takes: str = "number"
    gives: str = "number"
    arity: tuple[int, int] = (2, 2)

    def spelling(self, operator: str) -> str:
        return operator if self.precedence in (5, 7) and operator in "/^" else f" {operator} "


def _and(left: Function, right: Function) -> Function:
    return lambda v: left(v) and right(v)


def _or(left: Function, right: Function) -> Function:
    return lambda v: left(v) or right(v)


OPERATORS: Mapping[str, Operator] = {
    "||": Operator(_or, 0, "truth", "truth"),
    "&&": Operator(_and, 1, "truth", "truth"),
    "!": Operator(_strict(lambda x: not x), 2, "truth", "truth", (1, 1)),
    "==": Operator(_strict(lambda x, y: x == y), 3, gives="truth"),
    "!=": Operator(_strict(lambda x, y: x != y), 3, gives="truth"),
    "<": Operator(_strict(lambda x, y: x < y), 3, gives="truth"),
    "<=": Operator(_strict(lambda x, y: x <= y), 3, gives="truth"),
    ">": Operator(_strict(lambda x, y: x > y), 3, gives="truth"),
    ">=": Operator(_strict(lambda x, y: x >= y), 3, gives="truth"),
    "+": Operator(_strict(lambda x, y: exact(x + y)), 4),
    "-": Operator(_strict(lambda x, y: exact(x - y)), 4),
    "*": Operator(_strict(lambda x, y: exact(x * y)), 5),
    "/": Operator(_strict(divide), 5),
    "-x": Operator(_strict(lambda x: -x), 6, arity=(1, 1)),
    "^": Operator(_strict(power), 7),
    "abs": Operator(_strict(abs), None, arity=(1, 1)),
    "floor": Operator(_strict(real("floor", rounded(math.floor))), None, arity=(1, 1)),
    "ceil": Operator(_strict(real("ceil", rounded(math.ceil))), None, arity=(1, 1)),
    "min": Operator(_strict(min), None, arity=(2, 16)),
    "max": Operator(_strict(max), None, arity=(2, 16)),
    "sqrt": Operator(_strict(real("sqrt", math.sqrt)), None, arity=(1, 1)),
    "exp": Operator(_strict(real("exp", math.exp)), None, arity=(1, 1)),
    "log": Operator(_strict(real("log", math.log)), None, arity=(1, 1)),
}


def gives(expression: Expression) -> str:
    """What an expression is: a "number" or a "truth"."""
    return OPERATORS[expression.operator].gives if isinstance(expression, Apply) else "number"


def names_in(expression: Expression) -> frozenset[str]:
    """The names that an expression uses.

    >>> sorted(names_in(Apply("+", (Name("t"), Name("dt")))))
    ['dt', 't']
    """
    if isinstance(expression, Name):
        return frozenset((expression.name,))
    if isinstance(expression, Apply):
        return frozenset().union(*map(names_in, expression.operands))
    return frozenset()


def function_of(expression: Expression, order: Mapping[str, int], arithmetic: str = "exact") -> Function:
    """The function that an expression stands for.

    Parameters
    ----------
    expression
        Any expression whose names are all in `order`.
    order
        For each name its index in the tuple of values that the function takes.
    arithmetic
        "exact", or "float" to compute in doubles throughout, as cpfg and L-Py do.

    Examples
    --------
    >>> from fractions import Fraction
    >>> function_of(Apply("+", (Name("t"), Number(Fraction(7, 10)))), {"t": 0})((Fraction(3, 10),))
    1
    """
    if isinstance(expression, Number):
        value = float(expression.value) if arithmetic == "float" else expression.value
        return lambda v: value
    if isinstance(expression, Name):
        index = order[expression.name]
        return lambda v: v[index]
    operands = [function_of(operand, order, arithmetic) for operand in expression.operands]
    return OPERATORS[expression.operator].build(*operands)


def to_sympy(expression: Expression) -> sympy.Basic:
    """The expression as a sympy expression, to be shown as mathematics or solved; built from the tree, never from text.

    >>> from fractions import Fraction
    >>> to_sympy(Apply("*", (Number(Fraction(1, 2)), Name("t"))))
    t/2
    """
    import sympy

    if isinstance(expression, Number):
        value = expression.value
        return sympy.Float(value) if isinstance(value, float) else sympy.Rational(value.numerator, value.denominator)
    if isinstance(expression, Name):
        return sympy.Symbol(expression.name)
    table: dict[str, Callable[..., sympy.Basic]] = {
        "||": sympy.Or, "&&": sympy.And, "!": sympy.Not, "==": sympy.Eq, "!=": sympy.Ne,
        "<": sympy.Lt, "<=": sympy.Le, ">": sympy.Gt, ">=": sympy.Ge,
        "+": sympy.Add, "-": lambda x, y: x - y, "*": sympy.Mul, "/": lambda x, y: x / y, "-x": lambda x: -x,
        "^": sympy.Pow, "abs": sympy.Abs, "floor": sympy.floor, "ceil": sympy.ceiling, "min": sympy.Min,
        "max": sympy.Max, "sqrt": sympy.sqrt, "exp": sympy.exp, "log": sympy.log,
    }
    return table[expression.operator](*map(to_sympy, expression.operands))
