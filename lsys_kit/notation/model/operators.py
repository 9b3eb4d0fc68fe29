"""The operators and functions of expressions: one table, `OPERATORS`, that says of each how it is written, what it computes,
and whether it takes and gives numbers or truths.

Angles are in degrees, as plant modellers write them and as the turtle turns; where the sine of a rational number of degrees
is rational, it is exact. Random functions draw a new number at every use.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeAlias

from lsys_kit.notation.model.arithmetic import (
    Value,
    bounded_exact,
    divide,
    equal_values,
    partial_function,
    power,
    remainder,
    rounding,
    short_text,
)

Function: TypeAlias = Callable[[tuple[Any, ...]], Any]
"""A compiled expression: from the values of its names, in a fixed order, to its own value. After the values of the names, a
random expression needs a source of random numbers (`derivation.core.chance`)."""

_HALF = Fraction(1, 2)
_SINES: Mapping[Value, Value] = {-90: -1, -30: -_HALF, 0: 0, 30: _HALF, 90: 1, 150: _HALF, 180: 0, 210: -_HALF}
"""Every rational sine of a rational number of degrees from -90 up to 270 (Niven's theorem)."""
_TANGENTS: Mapping[Value, Value] = {-45: -1, 0: 0, 45: 1}
"""The same of tangents, from -90 up to 90."""


@dataclass(frozen=True)
class Operator:
    """How an operator is computed, how tightly it binds, and which types it takes and gives.

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
    conditional
        Whether its first operand is a truth, whatever the others are.
    random
        Whether it gives a new number at every use.
    looks
        Whether it depends on what the turtle sees.
    """

    build: Callable[..., Function]
    precedence: int | None
    takes: str = "number"
    gives: str = "number"
    arity: tuple[int, int] = (2, 2)
    conditional: bool = False
    random: bool = False
    looks: bool = False

    def spelling(self, operator: str) -> str:
        return operator if self.precedence in (5, 7) and operator in "/^" else f" {operator} "

    def wanted(self, index: int) -> str:
        """What the operand with an index must be: a "number" or a "truth"."""
        return "truth" if self.conditional and index == 0 else self.takes


def _strict(function: Callable[..., object]) -> Callable[..., Function]:
    """An operator that evaluates all its operands first."""

    def build(*operands: Function) -> Function:
        if len(operands) == 2:
            left, right = operands
            return lambda v: function(left(v), right(v))
        if len(operands) == 1:
            (only,) = operands
            return lambda v: function(only(v))
        return lambda v: function(*[operand(v) for operand in operands])

    return build


def _and(left: Function, right: Function) -> Function:
    return lambda v: left(v) and right(v)


def _or(left: Function, right: Function) -> Function:
    return lambda v: left(v) or right(v)


def _if(condition: Function, left: Function, right: Function) -> Function:
    return lambda v: left(v) if condition(v) else right(v)


def _drawn(method: str) -> Callable[..., Function]:
    """A random function: its operands are evaluated, then the number is drawn by the source after the values."""

    def build(*operands: Function) -> Function:
        return lambda v: getattr(v[-1], method)(*[operand(v) for operand in operands])

    return build


def _sensed(number: Function, *operands: Function) -> Function:
    """A sensitive function of GROGRA, given by its number; the source after the values may see what the turtle sees."""

    def evaluate(v: tuple[object, ...]) -> object:
        sees = getattr(v[-1], "sees", None) if v else None
        if sees is None:
            raise ValueError(
                f"function {short_text(number(v))} depends on what the turtle sees, which a word alone does not tell"
            )
        return sees(number(v), *[operand(v) for operand in operands])

    return evaluate


def _sine(angle: Value) -> Value:
    turned = angle if -90 <= angle < 270 else (angle + 90) % 360 - 90
    return _like(angle, _SINES[turned]) if turned in _SINES else math.sin(math.radians(turned))


def _cosine(angle: Value) -> Value:
    return _sine(angle + 90)


def _tangent(angle: Value) -> Value:
    turned = angle if -90 <= angle < 90 else (angle + 90) % 180 - 90
    if turned == -90:
        raise ValueError
    return _like(angle, _TANGENTS[turned]) if turned in _TANGENTS else math.tan(math.radians(turned))


def _like(given: Value, value: Value) -> Value:
    """A value in the arithmetic of the value it was computed from."""
    return float(value) if isinstance(given, float) else value


def _inverse(function: Callable[[Value], float], known: Mapping[Value, Value]) -> Callable[[Value], Value]:
    """A function that gives degrees, exactly where those are rational."""
    return lambda x: _like(x, known[x]) if x in known else math.degrees(function(x))


_ARCSINES: Mapping[Value, Value] = {-1: -90, -_HALF: -30, 0: 0, _HALF: 30, 1: 90}
_ARCCOSINES: Mapping[Value, Value] = {value: 90 - angle for value, angle in _ARCSINES.items()}
_ARCTANGENTS: Mapping[Value, Value] = {-1: -45, 0: 0, 1: 45}


def _function(name: str, function: Callable[[Value], Value]) -> Operator:
    """A function of one number that is not defined everywhere."""
    return Operator(_strict(partial_function(name, function)), None, arity=(1, 1))


OPERATORS: Mapping[str, Operator] = {
    "||": Operator(_or, 0, "truth", "truth"),
    "&&": Operator(_and, 1, "truth", "truth"),
    "!": Operator(_strict(lambda x: not x), 2, "truth", "truth", (1, 1)),
    "==": Operator(_strict(equal_values), 3, gives="truth"),
    "!=": Operator(_strict(lambda x, y: not equal_values(x, y)), 3, gives="truth"),
    "<": Operator(_strict(lambda x, y: x < y), 3, gives="truth"),
    "<=": Operator(_strict(lambda x, y: x <= y), 3, gives="truth"),
    ">": Operator(_strict(lambda x, y: x > y), 3, gives="truth"),
    ">=": Operator(_strict(lambda x, y: x >= y), 3, gives="truth"),
    "+": Operator(_strict(lambda x, y: bounded_exact(x + y)), 4),
    "-": Operator(_strict(lambda x, y: bounded_exact(x - y)), 4),
    "*": Operator(_strict(lambda x, y: bounded_exact(x * y)), 5),
    "/": Operator(_strict(divide), 5),
    "-x": Operator(_strict(lambda x: -x), 6, arity=(1, 1)),
    "^": Operator(_strict(power), 7),
    "abs": Operator(_strict(abs), None, arity=(1, 1)),
    "floor": _function("floor", rounding(math.floor)),
    "ceil": _function("ceil", rounding(math.ceil)),
    "min": Operator(_strict(min), None, arity=(2, 16)),
    "max": Operator(_strict(max), None, arity=(2, 16)),
    "mod": Operator(_strict(lambda x, y: bounded_exact(x % y)), None),
    "rem": Operator(_strict(remainder), None),
    "if": Operator(_if, None, arity=(3, 3), conditional=True),
    "sqrt": _function("sqrt", math.sqrt),
    "exp": _function("exp", math.exp),
    "log": _function("log", math.log),
    "sin": _function("sin", _sine),
    "cos": _function("cos", _cosine),
    "tan": _function("tan", _tangent),
    "asin": _function("asin", _inverse(math.asin, _ARCSINES)),
    "acos": _function("acos", _inverse(math.acos, _ARCCOSINES)),
    "atan": _function("atan", _inverse(math.atan, _ARCTANGENTS)),
    "uniform": Operator(_drawn("uniform"), None, random=True),
    "normal": Operator(_drawn("normal"), None, random=True),
    "binomial": Operator(_drawn("binomial"), None, random=True),
    "poisson": Operator(_drawn("poisson"), None, arity=(1, 1), random=True),
    "table": Operator(_drawn("table"), None, arity=(1, 16), random=True),
    "sensed": Operator(_sensed, None, arity=(1, 16), looks=True),
}
