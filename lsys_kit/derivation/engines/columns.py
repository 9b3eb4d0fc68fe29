"""Arithmetic of whole columns of numbers, in doubles or exact, with the results that numbers have one by one.

In doubles a column is an array, and the operations are those that numpy computes to the last bit as Python does; what raises a
floating-point error is not for columns. Exact columns are integers over one common denominator: of 64 bits while they are sure
to fit, else Python's own. Where a row may have no exact result, or none that fits, an `ArithmeticError` is raised.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeAlias

import numpy as np

from lsys_kit.budget import current
from lsys_kit.derivation.core.application import EXACT_BITS
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.expressions import Expression, Name, Number

Array: TypeAlias = np.ndarray[Any, Any]
ColumnFunction: TypeAlias = Callable[..., Any]
"""From the columns of the names to the column of an expression, which is written to `out` where that is given and there is
something to compute."""
SHORT_BITS = 62
"""Integers of so many bits are added and compared in 64."""
ROWS_AT_A_TIME = 2**12
"""So many rows of an array become numbers of Python at a time."""


@dataclass(frozen=True, eq=False)
class ExactColumn:
    """Rational numbers with a common denominator.

    Attributes
    ----------
    numerators
        An array of integers, or one integer for all rows.
    denominator
        An integer greater than 0.
    bits
        As many bits as are enough for the absolute value of each numerator.

    Examples
    --------
    >>> tenths = ExactColumn(np.array([1, 25]), 10, 5)
    >>> found = tenths * exact_number(Fraction(1, 2)) + exact_number(1)
    >>> found.numerators.tolist(), found.denominator
    ([21, 45], 20)
    """

    numerators: Any
    denominator: int
    bits: int

    def __post_init__(self) -> None:
        if self.bits + self.denominator.bit_length() > current().bits:
            raise OverflowError
        if self.bits > SHORT_BITS and isinstance(self.numerators, np.ndarray) and self.numerators.dtype != object:
            object.__setattr__(self, "numerators", self.numerators.astype(object))

    def over(self, denominator: int) -> Any:
        """The numerators over a multiple of the denominator."""
        factor = denominator // self.denominator
        return self.numerators if factor == 1 else self.widened(factor.bit_length()).numerators * factor

    def widened(self, bits: int) -> ExactColumn:
        """The same numbers, with room for so many bits more."""
        return ExactColumn(self.numerators, self.denominator, self.bits + bits)

    def __add__(self, other: ExactColumn) -> ExactColumn:
        return _over_common(operator.add, self, other)

    def __sub__(self, other: ExactColumn) -> ExactColumn:
        return _over_common(operator.sub, self, other)

    def __mul__(self, other: ExactColumn) -> ExactColumn:
        left, right = self.widened(other.bits), other.widened(self.bits)
        return ExactColumn(left.numerators * right.numerators, self.denominator * other.denominator, left.bits)

    def __truediv__(self, other: ExactColumn) -> ExactColumn:
        if not isinstance(other.numerators, int):
            raise ArithmeticError("quotients have no common denominator")
        inverse = Fraction(other.denominator, other.numerators)
        return self * exact_number(inverse)

    def __neg__(self) -> ExactColumn:
        return ExactColumn(-self.numerators, self.denominator, self.bits)

    def __abs__(self) -> ExactColumn:
        return ExactColumn(abs(self.numerators), self.denominator, self.bits)

    def __floor__(self) -> ExactColumn:
        wide = ExactColumn(self.numerators, self.denominator, max(self.bits, self.denominator.bit_length()))
        return ExactColumn(wide.numerators // self.denominator, 1, self.bits)

    def __ceil__(self) -> ExactColumn:
        return -math.floor(-self)


def exact_number(value: Value) -> ExactColumn:
    """A rational number as a column that is the same in all rows."""
    if not isinstance(value, int | Fraction):
        raise ArithmeticError("the number is not rational")
    return ExactColumn(value.numerator, value.denominator, value.numerator.bit_length())


def _over_common(operation: Callable[[Any, Any], Any], left: ExactColumn, right: ExactColumn) -> ExactColumn:
    """A sum or a difference."""
    common = math.lcm(left.denominator, right.denominator)
    bits = 1 + max(column.bits + (common // column.denominator).bit_length() for column in (left, right))
    first, second = (ExactColumn(column.numerators, column.denominator, bits).over(common) for column in (left, right))
    return ExactColumn(operation(first, second), common, bits)


def _compared(operation: Callable[[Any, Any], Any]) -> Callable[[ExactColumn, ExactColumn], Any]:
    """A comparison of two columns, row by row."""

    def compare(left: ExactColumn, right: ExactColumn) -> Any:
        return np.asarray(operation((left - right).numerators, 0), dtype=bool)

    return compare


def _exact(operation: Callable[..., Any]) -> Callable[..., Any]:
    return lambda *operands, out=None: operation(*operands)


_TRUTHS: Mapping[str, Callable[..., Any]] = {"||": np.logical_or, "&&": np.logical_and, "!": np.logical_not}
OPERATIONS: Mapping[str, Mapping[str, Callable[..., Any]]] = {
    "float": {
        **_TRUTHS,
        "==": np.equal,
        "!=": np.not_equal,
        "<": np.less,
        "<=": np.less_equal,
        ">": np.greater,
        ">=": np.greater_equal,
        "+": np.add,
        "-": np.subtract,
        "*": np.multiply,
        "/": np.divide,
        "-x": np.negative,
        "abs": np.abs,
        "sqrt": np.sqrt,
        "floor": np.floor,
        "ceil": np.ceil,
    },
    "exact": {
        **_TRUTHS,
        **{
            sign: _exact(_compared(operation))
            for sign, operation in (
                ("==", operator.eq),
                ("!=", operator.ne),
                ("<", operator.lt),
                ("<=", operator.le),
                (">", operator.gt),
                (">=", operator.ge),
            )
        },
        "+": _exact(operator.add),
        "-": _exact(operator.sub),
        "*": _exact(operator.mul),
        "/": _exact(operator.truediv),
        "-x": _exact(operator.neg),
        "abs": _exact(abs),
        "floor": _exact(math.floor),
        "ceil": _exact(math.ceil),
    },
}
"""For each arithmetic what computes an operator for whole columns, with the results that numbers have one by one."""


def column_function(expression: Expression, arithmetic: str) -> ColumnFunction:
    """The function of an expression for whole columns.

    >>> from lsys_kit.notation.model.expressions import Apply
    >>> run = column_function(Apply("*", (Name("x"), Number(2))), "float")
    >>> run({"x": np.array([1.0, 2.5])}).tolist()
    [2.0, 5.0]
    """
    if isinstance(expression, Number):
        value = expression.value
        number = float if arithmetic == "float" else exact_number
        return lambda columns, out=None: number(value)
    if isinstance(expression, Name):
        name = expression.name
        return lambda columns, out=None: columns[name]
    operation = OPERATIONS[arithmetic][expression.operator]
    operands = [column_function(operand, arithmetic) for operand in expression.operands]
    return lambda columns, out=None: operation(*[operand(columns) for operand in operands], out=out)


def _listed(array: Array) -> Iterator[list[Any]]:
    """The rows of an array as lists."""
    for first in range(0, len(array), ROWS_AT_A_TIME):
        yield from array[first : first + ROWS_AT_A_TIME].tolist()


class FloatValues:
    """The values of a word in doubles, a row for each module."""

    bytes = 8

    def __init__(self, array: Array) -> None:
        self.array = array

    def columns(self, rows: Any, parameters: int) -> Iterator[Array]:
        """The columns of the first parameters, of some rows."""
        there = self.array[rows]
        return (there[:, parameter] for parameter in range(parameters))

    def rows(self) -> Iterable[tuple[Value, ...]]:
        """The values of each module, as numbers."""
        return map(tuple, _listed(self.array))


class FloatColumns:
    """Columns of doubles that are put together to the values of a word."""

    def __init__(self, shape: tuple[int, int]) -> None:
        self._array = np.zeros(shape)

    def write(self, argument: ColumnFunction, named: Mapping[str, Any], places: Any, parameter: int) -> None:
        """Write what an argument comes to into some places of the column of a parameter."""
        target = self._array[places, parameter] if isinstance(places, slice) else None
        found = argument(named, out=target)
        if target is None or found is not target:
            self._array[places, parameter] = found

    def values(self) -> FloatValues:
        """All that was written."""
        return FloatValues(self._array)


class ExactValues:
    """The exact values of a word: a row of numerators for each module, and one denominator."""

    def __init__(self, numerators: Array, denominator: int, bits: int) -> None:
        self.numerators, self.denominator, self.bits = numerators, denominator, bits

    @property
    def bytes(self) -> int:
        """About how many bytes one value takes."""
        return 8 if self.bits <= SHORT_BITS else 56

    def columns(self, rows: Any, parameters: int) -> Iterator[ExactColumn]:
        """The columns of the first parameters, of some rows."""
        there = self.numerators[rows]
        return (ExactColumn(there[:, parameter], self.denominator, self.bits) for parameter in range(parameters))

    def rows(self) -> Iterable[tuple[Value, ...]]:
        """The values of each module, as numbers."""
        return (tuple(normalised(Fraction(number, self.denominator)) for number in row) for row in _listed(self.numerators))


class ExactColumns:
    """Exact columns that are put together to the values of a word.

    Examples
    --------
    >>> columns = ExactColumns((2, 1))
    >>> for row, value in enumerate((Fraction(1, 2), Fraction(2, 3))):
    ...     columns.write(column_function(Number(value), "exact"), {}, row, 0)
    >>> list(columns.values().rows())
    [(Fraction(1, 2),), (Fraction(2, 3),)]
    """

    def __init__(self, shape: tuple[int, int]) -> None:
        self._shape = shape
        self._written: list[tuple[Any, int, ExactColumn]] = []

    def write(self, argument: ColumnFunction, named: Mapping[str, Any], places: Any, parameter: int) -> None:
        """Write what an argument comes to into some places of the column of a parameter."""
        self._written.append((places, parameter, argument(named)))

    def values(self) -> ExactValues:
        """All that was written; an `OverflowError`, where that may be more than the table of states keeps exactly."""
        common = math.lcm(*{column.denominator for _, _, column in self._written})
        bits = max((column.bits + (common // column.denominator).bit_length() for _, _, column in self._written), default=0)
        found = np.zeros(self._shape, dtype=np.int64 if bits <= SHORT_BITS else object)
        for places, parameter, column in self._written:
            found[places, parameter] = column.over(common)
        if bits > SHORT_BITS:
            bits = max(abs(found.max(initial=0)), abs(found.min(initial=0))).bit_length()
            found = found.astype(np.int64) if bits <= SHORT_BITS else found
        if max(bits, common.bit_length()) > EXACT_BITS:
            raise OverflowError
        return ExactValues(found, common, bits)
