"""Arithmetic expressions: trees that are read from text, printed, run as functions and shown by sympy.

An expression is a number, a name, or an operator applied to expressions. The table `OPERATORS` says what each operator is;
everything here walks the tree. Nothing is ever compiled from text: a function is composed of the functions of its operands.

Decimal literals are rational numbers, and arithmetic is exact (see `arithmetic`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, TypeAlias

from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.arithmetic import Value, expression_of, literal_text, symbolic_functions
from lsys_kit.notation.model.operators import OPERATORS as OPERATORS
from lsys_kit.notation.model.operators import Function as Function

if TYPE_CHECKING:
    import sympy

TextSpan: TypeAlias = tuple[int, int] | None
"""The offsets in the text between which something was read."""


@dataclass(frozen=True)
class Number:
    """A literal number.

    >>> from fractions import Fraction
    >>> print(Number(Fraction(7, 10)))
    0.7
    """

    value: Value
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return literal_text(self.value)


@dataclass(frozen=True)
class Name:
    """A parameter or a constant."""

    name: str
    at: TextSpan = field(default=None, compare=False, repr=False)

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
    at: TextSpan = field(default=None, compare=False, repr=False)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "depth", 1 + max(getattr(operand, "depth", 0) for operand in self.operands))

    def __str__(self) -> str:
        return styled_text(self)


Expression: TypeAlias = Number | Name | Apply


@dataclass(frozen=True)
class Style:
    """How a notation writes expressions.

    Attributes
    ----------
    spellings
        Operators and functions that are not spelt as in `OPERATORS`.
    brackets
        The brackets around a function's operands.
    """

    spellings: Mapping[str, str] = field(default_factory=dict)
    brackets: tuple[str, str] = ("(", ")")


PLAIN_STYLE = Style()
"""The kit's own style: that of C, with `^` for powers."""


def styled_text(expression: Expression, style: Style = PLAIN_STYLE) -> str:
    """The text of an expression in a notation's style.

    >>> styled_text(Apply("sqrt", (Apply("==", (Name("x"), Number(1))),)), Style({"sqrt": "Sqrt", "==": "="}, ("[", "]")))
    'Sqrt[x = 1]'
    """
    if not isinstance(expression, Apply):
        return str(expression)
    operator, spelt = OPERATORS[expression.operator], style.spellings.get(expression.operator, expression.operator)
    if operator.precedence is None:
        return spelt + style.brackets[0] + ", ".join(styled_text(o, style) for o in expression.operands) + style.brackets[1]
    if len(expression.operands) == 1:
        tightly = 7 if expression.operator == "!" else operator.precedence  # !(t < 5): without parentheses C negates t
        return spelt[0] + _operand_text(expression.operands[0], tightly, style)
    left, right = expression.operands
    power = expression.operator == "^"
    return (
        _operand_text(left, operator.precedence + power, style)
        + operator.spelling(spelt)
        + _operand_text(right, operator.precedence + (not power), style)
    )


def _operand_text(expression: Expression, precedence: int, style: Style) -> str:
    """The operand's text, in parentheses where it binds less tightly than its surroundings."""
    own, text = None, styled_text(expression, style)
    if isinstance(expression, Apply):
        own = OPERATORS[expression.operator].precedence
    elif isinstance(expression, Number):
        own = 5 if "/" in text else 6 if text.startswith("-") else None
    return f"({text})" if own is not None and own < precedence else text


def expression_type(expression: Expression) -> str:
    """What an expression is: a "number" or a "truth"."""
    return OPERATORS[expression.operator].gives if isinstance(expression, Apply) else "number"


def walk(expression: Expression) -> Iterator[Expression]:
    """An expression and all its parts, each before its own, in the order written.

    >>> [str(part) for part in walk(Apply("+", (Name("t"), Number(1))))]
    ['t + 1', 't', '1']
    """
    waiting = [expression]
    while waiting:
        part = waiting.pop()
        yield part
        if isinstance(part, Apply):
            waiting += part.operands[::-1]


def transform(expression: Expression, change: Callable[[Expression], Expression | None]) -> Expression:
    """An expression in which parts are replaced by what a function makes of them; where that is None, their own parts are.

    >>> print(transform(Apply("+", (Name("t"), Number(1))), lambda part: Name("s") if part == Name("t") else None))
    s + 1
    """
    changed = change(expression)
    if changed is not None or not isinstance(expression, Apply):
        return expression if changed is None else changed
    operands = tuple(transform(operand, change) for operand in expression.operands)
    same = all(new is old for new, old in zip(operands, expression.operands, strict=True))
    return expression if same else replace(expression, operands=operands)


def substituted(expression: Expression, values: Mapping[str, Expression]) -> Expression:
    """An expression with others in place of some names.

    >>> print(substituted(Apply("+", (Name("t"), Number(1))), {"t": Name("s")}))
    s + 1
    """
    return transform(expression, lambda part: values.get(part.name) if isinstance(part, Name) else None)


def calls_in(expression: Expression) -> Iterator[Apply]:
    """The operators in an expression, with their operands."""
    return (part for part in walk(expression) if isinstance(part, Apply))


def names_in(expression: Expression) -> frozenset[str]:
    """The names that an expression uses.

    >>> sorted(names_in(Apply("+", (Name("t"), Name("dt")))))
    ['dt', 't']
    """
    return frozenset(part.name for part in walk(expression) if isinstance(part, Name))


def is_random(expression: Expression) -> bool:
    """Whether an expression draws a random number, so that it may have a different value at every use.

    >>> is_random(Apply("+", (Name("t"), Apply("uniform", (Number(0), Number(1))))))
    True
    """
    return any(isinstance(part, Apply) and OPERATORS[part.operator].random for part in walk(expression))


def sensed_in(expression: Expression) -> Iterator[Apply]:
    """The sensitive functions in an expression, which ask what the turtle sees.

    >>> [str(call) for call in sensed_in(Apply(">", (Apply("sensed", (Number(2), Number(1))), Number(60))))]
    ['sensed(2, 1)']
    """
    return (call for call in calls_in(expression) if OPERATORS[call.operator].looks)


def function_of(expression: Expression, order: Mapping[str, int], arithmetic: str = "exact") -> Function:
    """The function that computes an expression.

    Parameters
    ----------
    expression
        Any expression whose names are all in `order`.
    order
        For each name its index in the tuple of values that the function takes. Where the expression is random, the last
        element of that tuple draws the numbers: it has the methods `uniform`, `normal`, and so on; where the expression is
        sensitive, it has the attribute `sees`.
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

    Raises
    ------
    ModelValueError
        The expression is random: no formula can replace it.

    Examples
    --------
    >>> from fractions import Fraction
    >>> to_sympy(Apply("*", (Number(Fraction(1, 2)), Name("t"))))
    t/2
    """
    import sympy

    if isinstance(expression, Number):
        return expression_of(expression.value)
    if isinstance(expression, Name):
        return sympy.Symbol(expression.name)
    if OPERATORS[expression.operator].random:
        raise ModelValueError(f'"{expression}" is drawn anew at every use: no formula can replace it')
    return _sympy_table()[expression.operator](*map(to_sympy, expression.operands))


def _sympy_table() -> dict[str, Callable[..., sympy.Basic]]:
    import sympy

    def remainder(x: object, y: object) -> sympy.Expr:
        return sympy.sign(x) * sympy.Mod(sympy.floor(sympy.Abs(x)), sympy.floor(sympy.Abs(y)))

    return {
        "||": sympy.Or,
        "&&": sympy.And,
        "!": sympy.Not,
        "==": sympy.Eq,
        "!=": sympy.Ne,
        "<": sympy.Lt,
        "<=": sympy.Le,
        ">": sympy.Gt,
        ">=": sympy.Ge,
        "+": sympy.Add,
        "-": lambda x, y: x - y,
        "*": sympy.Mul,
        "/": lambda x, y: x / y,
        "-x": lambda x: -x,
        "^": sympy.Pow,
        "abs": sympy.Abs,
        "floor": sympy.floor,
        "ceil": sympy.ceiling,
        "min": sympy.Min,
        "max": sympy.Max,
        "mod": sympy.Mod,
        "rem": remainder,
        "if": lambda c, x, y: sympy.Piecewise((x, c), (y, True)),
        **symbolic_functions(),
        "sensed": sympy.Function("sensed"),
    }
