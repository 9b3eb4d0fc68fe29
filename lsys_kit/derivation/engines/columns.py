"""Columns: the values of many modules at once, and expressions that are computed for all of them.

A column holds what the module-by-module engine would hold in each row, to the last bit, and in one of three forms:

- an array of doubles, with the operations that numpy computes to the last bit as Python does;
- an `ExactColumn`, rational numbers as numerators and denominators, in 64 bits while they are sure to fit: a `WideError` says
  that they may not, and the same is computed again with whole numbers of Python;
- `Mixed`, an array of Python's own numbers, where rows differ in their kind, or an operator is computed one by one.

What has no value in some row raises an `ArithmeticError`: then the engine that goes module by module says which module it is.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from operator import itemgetter
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar, cast

from lsys_kit.arrays import np
from lsys_kit.budget import counted, current
from lsys_kit.derivation.core.chance import Chance, keys_of, stretches, units_of
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.expressions import Apply, Expression, Name, function_of, is_random, names_in
from lsys_kit.notation.model.operators import OPERATORS

if TYPE_CHECKING:
    from numpy.typing import NDArray

_T = TypeVar("_T")
Array: TypeAlias = "NDArray[Any]"
Whole: TypeAlias = "Any"
"""An array of whole numbers, or one."""
Column: TypeAlias = "Array | float | bool | ExactColumn | Mixed"
ColumnFunction: TypeAlias = "Callable[[Rows], Any]"
SHORT_BITS, EXACT_DOUBLE = 62, 53
"""Whole numbers of so many bits are added and compared in 64; and are doubles without rounding."""


class WideError(ArithmeticError):
    """Exact numbers that may not fit into 64 bits."""


@dataclass(frozen=True, eq=False)
class ExactColumn:
    """Rational numbers, perhaps not reduced.

    numerators, denominators
        Arrays of whole numbers, of 64 bits or Python's own; or one number for all rows. Denominators are greater than 0.
    bits
        As many bits as are enough for each numerator, and for each denominator.
    wide
        Whether the numbers are Python's own.

    >>> tenths = ExactColumn(np.array([1, 25]), 10, (5, 4))
    >>> (tenths * exact_number(Fraction(1, 2)) + exact_number(1)).values(2)
    [Fraction(21, 20), Fraction(9, 4)]
    """

    numerators: Whole
    denominators: Whole
    bits: tuple[int, int]
    wide: bool = False

    def values(self, size: int) -> list[Value]:
        """The numbers, as Python has them."""
        above, below = (_spread(part, size).tolist() for part in (self.numerators, self.denominators))
        return [a if b == 1 else normalised(Fraction(a, b)) for a, b in zip(above, below, strict=True)]

    def in_python(self) -> ExactColumn:
        """The same in whole numbers of Python."""
        parts: list[Whole] = [
            part.astype(object) if isinstance(part, np.ndarray) else part for part in (self.numerators, self.denominators)
        ]
        return ExactColumn(parts[0], parts[1], self.bits, wide=True)

    def reduced(self) -> ExactColumn:
        """The same numbers in their lowest terms, with as many bits as they have."""
        above, below = self.numerators, self.denominators
        if not _same(below, 1):
            common = _common_divisor(above, below)
            above, below = above // common, below // common
        return ExactColumn(above, below, (_bits(above), _bits(below)), self.wide)

    def floats(self) -> Array | float:
        """The doubles nearest to the numbers."""
        above, below = self.numerators, self.denominators
        if isinstance(below, int) and below == 1 and not self.wide:
            return above.astype(np.float64) if isinstance(above, np.ndarray) else float(above)
        if max(self.bits) > EXACT_DOUBLE or self.wide:  # numpy would round twice
            wide = self.in_python()
            found = np.asarray(wide.numerators / wide.denominators, dtype=np.float64)
            return found if found.ndim else float(found)
        return np.asarray(above, dtype=np.float64) / np.asarray(below, dtype=np.float64)

    def __add__(self, other: ExactColumn) -> ExactColumn:
        return _added(operator.add, self, other)

    def __sub__(self, other: ExactColumn) -> ExactColumn:
        return _added(operator.sub, self, other)

    def __mul__(self, other: ExactColumn) -> ExactColumn:
        def bits(left: ExactColumn, right: ExactColumn) -> tuple[int, int]:
            return left.bits[0] + right.bits[0], left.bits[1] + right.bits[1]

        left, right, needed = _fitting(self, other, bits)
        above, below = left.numerators * right.numerators, left.denominators * right.denominators
        return ExactColumn(above, below, needed, left.wide or right.wide)

    def __truediv__(self, other: ExactColumn) -> ExactColumn:
        if not np.all(other.numerators):
            raise ZeroDivisionError
        signs: Whole = np.where(np.less(other.numerators, 0), -1, 1)
        signs = int(signs) if isinstance(other.numerators, int) else signs
        return self * ExactColumn(other.denominators * signs, abs(other.numerators), other.bits[::-1], other.wide)

    def __neg__(self) -> ExactColumn:
        return ExactColumn(-self.numerators, self.denominators, self.bits, self.wide)

    def __abs__(self) -> ExactColumn:
        return ExactColumn(abs(self.numerators), self.denominators, self.bits, self.wide)

    def __floor__(self) -> ExactColumn:
        whole: Whole = self.numerators // self.denominators
        return ExactColumn(whole, 1, (self.bits[0], 1), self.wide)

    def __ceil__(self) -> ExactColumn:
        return -math.floor(-self)


def exact_number(value: int | Fraction) -> ExactColumn:
    """A rational number as a column that is the same in all rows."""
    bits = value.numerator.bit_length(), value.denominator.bit_length()
    return ExactColumn(value.numerator, value.denominator, bits)


def _common_divisor(left: Whole, right: Whole) -> Whole:
    """The greatest common divisor; of two numbers for all rows by Python, as they may be long."""
    both = isinstance(left, int) and isinstance(right, int)
    return math.gcd(left, right) if both else np.gcd(left, right)


def _bits(whole: Whole) -> int:
    if isinstance(whole, np.ndarray):
        whole = max(abs(int(whole.max(initial=0))), abs(int(whole.min(initial=0))))
    return int(whole).bit_length()


def _fitting(
    left: ExactColumn, right: ExactColumn, bits: Callable[[ExactColumn, ExactColumn], tuple[int, int]]
) -> tuple[ExactColumn, ExactColumn, tuple[int, int]]:
    """Two columns whose result is sure to fit, reduced where they must be, and its bits; a `WideError` where it may not."""
    wide = left.wide or right.wide
    most = SHORT_BITS if not wide else current().bits // 2
    left, right = (each.in_python() if wide and not each.wide else each for each in (left, right))
    if max(needed := bits(left, right)) > most:
        left, right = left.reduced(), right.reduced()
        if max(needed := bits(left, right)) > most:
            raise OverflowError if wide else WideError
    return left, right, needed


def _added(operation: Callable[[Any, Any], Any], left: ExactColumn, right: ExactColumn) -> ExactColumn:
    """The sum or the difference, over a common denominator."""
    plain = _same(left.denominators, right.denominators)

    def bits(left: ExactColumn, right: ExactColumn) -> tuple[int, int]:
        if plain and _same(left.denominators, right.denominators):
            return max(left.bits[0], right.bits[0]) + 1, left.bits[1]
        return max(left.bits[0] + right.bits[1], right.bits[0] + left.bits[1]) + 1, left.bits[1] + right.bits[1]

    left, right, needed = _fitting(left, right, bits)
    wide = left.wide or right.wide
    if _same(left.denominators, right.denominators):
        return ExactColumn(operation(left.numerators, right.numerators), left.denominators, needed, wide)
    common = _common_divisor(left.denominators, right.denominators)
    first, second = right.denominators // common, left.denominators // common
    above = operation(left.numerators * first, right.numerators * second)
    return ExactColumn(above, left.denominators * first, needed, wide)


def _same(left: Whole, right: Whole) -> bool:
    return isinstance(left, int) and isinstance(right, int) and left == right


@dataclass(frozen=True, eq=False)
class Mixed:
    """Numbers of several kinds, as Python has them."""

    numbers: Sequence[Value]


def column_of(numbers: Sequence[Value]) -> Column:
    """Numbers in the form that they all have."""
    kinds = {isinstance(number, float) for number in numbers}
    if len(kinds) > 1:
        return Mixed(numbers)
    if True in kinds:
        return np.array(numbers, dtype=np.float64)
    above, below = ([getattr(number, part) for number in numbers] for part in ("numerator", "denominator"))
    bits = (max(map(abs, above), default=0).bit_length(), max(below, default=1).bit_length())
    kind = np.int64 if max(bits) <= SHORT_BITS else object
    whole = bits[1] == 1
    return ExactColumn(np.array(above, dtype=kind), 1 if whole else np.array(below, dtype=kind), bits, kind is object)


def values_of(column: Column, size: int) -> Sequence[Value]:
    """The numbers of a column, one for each row, as Python has them."""
    if isinstance(column, Mixed):
        return column.numbers
    if isinstance(column, ExactColumn):
        return column.values(size)
    found: list[Value] = _spread(column, size).tolist()
    return found


def taken(column: Column, rows: Array) -> Column:
    """Some rows of a column, by their numbers."""
    if isinstance(column, ExactColumn):
        above, below = (
            part[rows] if isinstance(part, np.ndarray) else part for part in (column.numerators, column.denominators)
        )
        return ExactColumn(above, below, column.bits, column.wide)
    return column[rows] if isinstance(column, np.ndarray) else column


def floats_of(column: Column) -> Array | float:
    """The doubles nearest to the numbers of a column."""
    if isinstance(column, Mixed):
        return np.array([float(number) for number in column.numbers])
    return column.floats() if isinstance(column, ExactColumn) else column


def _spread(part: Any, size: int) -> Array:
    return (
        part if isinstance(part, np.ndarray) else np.full(size, part, dtype=None if isinstance(part, bool | float) else object)
    )


@dataclass(frozen=True, eq=False)
class Draws:
    """What modules draw random numbers by: the seed of all or of each, the step, and the place of each in its word."""

    seed: int | Array
    step: int
    positions: Array

    def some(self, rows: Array) -> Draws:
        """Those of some of the modules."""
        return Draws(self.seed if isinstance(self.seed, int) else self.seed[rows], self.step, self.positions[rows])

    def keys(self) -> Array:
        return keys_of(self.seed, self.step, self.positions)

    def chances(self, drawn: Any) -> Iterator[Chance]:
        """For each module its random numbers, after so many that it has drawn before."""
        each = (np.broadcast_to(part, self.positions.shape).tolist() for part in (self.seed, self.positions, drawn))
        return (Chance(seed, self.step, position, None, before) for seed, position, before in zip(*each, strict=True))


class Rows:
    """Some modules of a word: how many they are, the columns of the names that expressions use, and their random numbers.

    Attributes
    ----------
    drawn
        How many random numbers the modules have drawn: each as many, or for each its own number.
    out
        Where the next operation with doubles may write its result.
    """

    __slots__ = ("_before", "_keys", "columns", "drawn", "draws", "out", "size")

    def __init__(self, columns: Mapping[str, Column], size: int, draws: Draws | None = None, drawn: Any = 0) -> None:
        self.columns, self.size, self.draws, self.drawn, self._before = columns, size, draws, drawn, drawn
        self._keys: Array | None = None
        self.out: Array | None = None

    def computed(self, function: Callable[[Rows], _T]) -> _T:
        """What a function comes to; with whole numbers of Python, where those of 64 bits may not suffice."""
        try:
            return function(self)
        except WideError:
            columns = {
                name: column.in_python() if isinstance(column, ExactColumn) else column for name, column in self.columns.items()
            }
            wide = Rows(columns, self.size, self.draws, self._before)
            found = function(wide)
            self.drawn = wide.drawn
            return found

    def units(self) -> Array:
        """The next random number, from 0 up to 1, of each module."""
        if self._keys is None:
            assert self.draws is not None
            self._keys = self.draws.keys()
        found = units_of(self._keys, self.drawn)
        self.drawn = self.drawn + 1
        return found

    def some(self, rows: Array, **more: Column) -> Rows:
        """Some of the modules, by their numbers; other names may be known of them."""
        columns = {name: taken(column, rows) for name, column in self.columns.items()}
        drawn = self.drawn if isinstance(self.drawn, int) else self.drawn[rows]
        return Rows({**columns, **more}, len(rows), self.draws and self.draws.some(rows), drawn)

    def draw_as(self, some: Rows, rows: Array) -> None:
        """Take over how many random numbers some of the modules have drawn."""
        if some.drawn is not self.drawn:
            self.drawn = np.array(np.broadcast_to(self.drawn, self.size))
            self.drawn[rows] = some.drawn


def _operation(name: str, exact: Callable[[Any, Any], ExactColumn], numpy: str) -> Callable[..., ColumnFunction]:
    """An operator that gives a number of two."""

    def build(left: ColumnFunction, right: ColumnFunction) -> ColumnFunction:
        one_by_one = _one_by_one(name, left, right)

        def run(rows: Rows) -> Column:
            out, rows.out = rows.out, None
            first, second = left(rows), right(rows)
            if isinstance(first, Mixed) or isinstance(second, Mixed):
                found: Column = one_by_one(rows, first, second)
                return found
            if isinstance(first, ExactColumn):
                if isinstance(second, ExactColumn):
                    return exact(first, second)
                first = first.floats()
            elif isinstance(second, ExactColumn):
                second = second.floats()
            return cast("Array", getattr(np, numpy)(first, second, out=out))

        return run

    return build


COMPARISONS = {"==": "equal", "!=": "not_equal", "<": "less", "<=": "less_equal", ">": "greater", ">=": "greater_equal"}
_TURNED = {"==": "==", "!=": "!=", "<": ">", "<=": ">=", ">": "<", ">=": "<="}
_BELOW = {"<": "<=", ">=": ">"}
_ABOVE = {"<=": "<", ">": ">="}
"""How a double compares with a rational number that is no double, in terms of the double below it, or above it."""


def _is_plain(exact: ExactColumn) -> bool:
    """Whether exact numbers can be compared with doubles at once: they are doubles, or one number."""
    return isinstance(exact.numerators, int) or (_same(exact.denominators, 1) and exact.bits[0] <= EXACT_DOUBLE)


def _against(floats: Array, name: str, exact: ExactColumn, rows: Rows) -> Array:
    """How doubles compare with such numbers."""
    near = exact.floats()
    if isinstance(near, float) and (there := Fraction(exact.numerators, exact.denominators)) != near:
        if name in ("==", "!="):
            return np.full(rows.size, name == "!=")
        name = (_BELOW if near < there else _ABOVE).get(name, name)
    found: Array = getattr(np, COMPARISONS[name])(floats, near)
    return found


def _comparison(name: str) -> Callable[..., ColumnFunction]:
    """An operator that compares two numbers."""
    numpy = COMPARISONS[name]

    def build(left: ColumnFunction, right: ColumnFunction) -> ColumnFunction:
        one_by_one = _one_by_one(name, left, right)

        def run(rows: Rows) -> Array:
            first, second = left(rows), right(rows)
            if isinstance(first, ExactColumn) and isinstance(second, ExactColumn):
                return np.asarray(getattr(np, numpy)((first - second).numerators, 0), dtype=bool)
            found: Array
            if isinstance(first, float | np.ndarray) and isinstance(second, float | np.ndarray):
                found = getattr(np, numpy)(first, second)
            elif isinstance(second, ExactColumn) and isinstance(first, np.ndarray) and _is_plain(second):
                found = _against(first, name, second, rows)
            elif isinstance(first, ExactColumn) and isinstance(second, np.ndarray) and _is_plain(first):
                found = _against(second, _TURNED[name], first, rows)
            else:
                found = one_by_one(rows, first, second)
            return found

        return run

    return build


def _one_by_one(name: str, *operands: ColumnFunction) -> Callable[..., Any]:
    """An operator as the table of operators has it, for one row after another."""
    places = [Name(str(place)) for place in range(len(operands))]
    one = function_of(Apply(name, tuple(places)), {place.name: number for number, place in enumerate(places)})
    random, truth = OPERATORS[name].random, OPERATORS[name].gives == "truth"

    def run(rows: Rows, *columns: Column) -> Column:
        values = zip(*[values_of(column, rows.size) for column in columns], strict=True)
        try:
            found = _drawn_one_by_one(one, rows, values) if random else [one(row) for row in counted(values)]
        except (ValueError, TypeError) as fault:
            raise ArithmeticError from fault
        return np.array(found, dtype=bool) if truth else column_of(found)

    return run


def _drawn_one_by_one(one: Callable[..., Any], rows: Rows, values: Iterable[tuple[Value, ...]]) -> list[Value]:
    assert rows.draws is not None
    found, after = [], []
    for row, chance in zip(counted(values), rows.draws.chances(rows.drawn), strict=True):
        found.append(one((*row, chance)))
        after.append(chance.drawn)
    rows.drawn = np.array(after, dtype=np.int64)
    return found


def _generic(name: str) -> Callable[..., ColumnFunction]:
    """An operator that is computed one by one."""

    def build(*operands: ColumnFunction) -> ColumnFunction:
        one_by_one = _one_by_one(name, *operands)
        return lambda rows: one_by_one(rows, *[operand(rows) for operand in operands])

    return build


def _of_one(name: str, exact: Callable[[ExactColumn], Column], numpy: str) -> Callable[..., ColumnFunction]:
    """An operator that gives a number of one."""

    def build(operand: ColumnFunction) -> ColumnFunction:
        one_by_one = _one_by_one(name, operand)

        def run(rows: Rows) -> Column:
            column = operand(rows)
            found: Column
            if isinstance(column, ExactColumn):
                return exact(column)
            found = one_by_one(rows, column) if isinstance(column, Mixed) else getattr(np, numpy)(column)
            return found

        return run

    return build


def _extreme(name: str, comparison: str) -> Callable[..., ColumnFunction]:
    """The least or the greatest number; of equal ones the first."""

    def build(*operands: ColumnFunction) -> ColumnFunction:
        compare = _comparison(comparison)(itemgetter(0), itemgetter(1))
        one_by_one = _one_by_one(name, *operands)

        def run(rows: Rows) -> Column:
            columns = [operand(rows) for operand in operands]
            forms = {isinstance(column, ExactColumn) for column in columns}
            if len(forms) > 1 or any(isinstance(column, Mixed) for column in columns):
                mixed: Column = one_by_one(rows, *columns)
                return mixed
            found: Column = columns[0]
            for other in columns[1:]:
                found = _merged(compare((other, found)), other, found, rows.size)  # type: ignore[arg-type]
            return found

        return run

    return build


def _merged(first: Array, yes: Column, no: Column, size: int) -> Column:
    """In each row the number of one column where a truth is so, else of the other."""
    if isinstance(yes, float | np.ndarray) and isinstance(no, float | np.ndarray):
        return np.where(first, yes, no)
    if isinstance(yes, ExactColumn) and isinstance(no, ExactColumn):
        bits = max(yes.bits[0], no.bits[0]), max(yes.bits[1], no.bits[1])
        wide = yes.wide or no.wide or max(bits) > SHORT_BITS
        kind: Any = object if wide else np.int64
        parts = ((yes.numerators, no.numerators), (yes.denominators, no.denominators))
        above, below = (np.where(first, *[np.asarray(each, dtype=kind) for each in part]) for part in parts)
        return ExactColumn(above, below, bits, wide)
    values = zip(first.tolist(), values_of(yes, size), values_of(no, size), strict=True)
    return column_of([one if truth else other for truth, one, other in values])


def truths(column: Any, size: int) -> Array:
    """Whether each row of a column is true; a number is, unless it is zero.

    >>> truths(column_of([0, Fraction(1, 2)]), 2).tolist(), truths(True, 2).tolist()
    ([False, True], [True, True])
    """
    if isinstance(column, ExactColumn | Mixed):
        column = [bool(value) for value in values_of(column, size)]
    return np.broadcast_to(np.asarray(column, dtype=bool), (size,))


def _where(rows: Rows, asked: Array, function: ColumnFunction, careful: bool) -> tuple[Any, Array | None]:
    """A column where a truth is so, and which rows it is about: all, where nothing can fail and nothing is drawn."""
    if not careful:
        return function(rows), None
    there = np.flatnonzero(asked)
    some = rows.some(there)
    found = function(some) if len(there) else None
    rows.draw_as(some, there)
    return found, there


def _junction(stops: bool) -> Callable[..., Callable[..., ColumnFunction]]:
    """`&&` and `||`, which look no further than they must."""

    def build(left: ColumnFunction, right: ColumnFunction, careful: Sequence[bool]) -> ColumnFunction:
        def run(rows: Rows) -> Array:
            first = truths(left(rows), rows.size)
            second, there = _where(rows, first != stops, right, careful[1])
            if there is None:
                both: Array = (first | truths(second, rows.size)) if stops else (first & truths(second, rows.size))
                return both
            found = np.array(first)
            if len(there):
                found[there] = truths(second, len(there))
            return found

        return run

    return build


def _choice(condition: ColumnFunction, yes: ColumnFunction, no: ColumnFunction, careful: Sequence[bool]) -> ColumnFunction:
    """`if`, which computes what it chooses."""

    def run(rows: Rows) -> Column:
        first = truths(condition(rows), rows.size)
        (one, ours), (other, theirs) = _where(rows, first, yes, careful[1]), _where(rows, ~first, no, careful[2])
        if ours is None and theirs is None:
            return _merged(first, one, other, rows.size)
        values: list[Value] = [0] * rows.size
        for found, there in ((one, ours), (other, theirs)):
            truth = first if found is one and ours is there else ~first
            places = np.flatnonzero(truth).tolist() if there is None else there.tolist()
            numbers = [] if found is None else values_of(found, rows.size if there is None else len(places))
            for number, place in enumerate(places):
                values[place] = numbers[place if there is None else number]
        return column_of(values)

    return run


def _uniform(low: ColumnFunction, high: ColumnFunction) -> ColumnFunction:
    def run(rows: Rows) -> Column:
        least, most = floats_of(low(rows)), floats_of(high(rows))
        return least + (most - least) * rows.units()

    return run


def _table(*weights: ColumnFunction) -> ColumnFunction:
    one_by_one = _one_by_one("table", *weights)

    def run(rows: Rows) -> Column:
        columns = [weight(rows) for weight in weights]
        single = [single_value(column) for column in columns]
        if None in single:
            found: Column = one_by_one(rows, *columns)
            return found
        try:
            ends, total = stretches(single)  # type: ignore[arg-type]
        except ValueError as fault:
            raise ArithmeticError from fault
        return ExactColumn(np.searchsorted(ends, rows.units() * total, side="right"), 1, (SHORT_BITS // 2, 1))

    return run


def single_value(column: Column) -> Value | None:
    """The number that a column has in all rows, if it is written as one."""
    if isinstance(column, ExactColumn) and isinstance(column.numerators, int) and isinstance(column.denominators, int):
        return normalised(Fraction(column.numerators, column.denominators))
    return column if isinstance(column, float) else None


BUILDERS: Mapping[str, Callable[..., Any]] = {
    **{name: _comparison(name) for name in COMPARISONS},
    "+": _operation("+", operator.add, "add"),
    "-": _operation("-", operator.sub, "subtract"),
    "*": _operation("*", operator.mul, "multiply"),
    "/": _operation("/", operator.truediv, "divide"),
    "-x": _of_one("-x", operator.neg, "negative"),
    "abs": _of_one("abs", abs, "abs"),
    "floor": _of_one("floor", math.floor, "floor"),
    "ceil": _of_one("ceil", math.ceil, "ceil"),
    "sqrt": _of_one("sqrt", lambda column: np.sqrt(column.floats()), "sqrt"),
    "!": lambda operand: lambda rows: np.logical_not(operand(rows)),
    "min": _extreme("min", "<"),
    "max": _extreme("max", ">"),
    "uniform": _uniform,
    "table": _table,
}
"""How operators are computed for whole columns, with the same result to the last bit; all others are computed one by one."""
CAREFUL: Mapping[str, Callable[..., ColumnFunction]] = {"&&": _junction(False), "||": _junction(True), "if": _choice}
"""Those that compute an operand in some rows only."""
SAFE = frozenset((*COMPARISONS, "+", "-", "*", "-x", "abs", "floor", "ceil", "!", "min", "max", "&&", "||", "if"))
"""Operators that may be computed where their value is not asked for."""


def column_function(expression: Expression, constants: Mapping[str, Value], arithmetic: str) -> ColumnFunction:
    """The function of an expression for whole columns.

    >>> from lsys_kit.notation.model.expressions import Number
    >>> run = column_function(Apply("*", (Name("x"), Number(2))), {}, "float")
    >>> run(Rows({"x": np.array([1.0, 2.5])}, 2)).tolist()
    [2.0, 5.0]
    """
    if isinstance(expression, Name) and expression.name not in constants:
        name = expression.name
        return lambda rows: rows.columns[name]
    if names_in(expression) <= constants.keys() and not is_random(expression):
        return _constant(expression, constants, arithmetic)
    assert isinstance(expression, Apply)
    operands = [column_function(operand, constants, arithmetic) for operand in expression.operands]
    if expression.operator in CAREFUL:
        careful = [not is_safe(operand) for operand in expression.operands]
        return CAREFUL[expression.operator](*operands, careful)
    builder: Callable[..., ColumnFunction] = BUILDERS.get(expression.operator) or _generic(expression.operator)
    return builder(*operands)


def is_safe(expression: Expression) -> bool:
    """Whether an expression may be computed where its value is not asked for: it cannot fail, and it draws nothing."""
    return not isinstance(expression, Apply) or (expression.operator in SAFE and all(map(is_safe, expression.operands)))


def _constant(expression: Expression, constants: Mapping[str, Value], arithmetic: str) -> ColumnFunction:
    """An expression whose value is the same in all rows; where it has none, that is found out when it is asked for."""
    order = {name: place for place, name in enumerate(constants)}
    try:
        value = function_of(expression, order, arithmetic)(tuple(constants.values()))
    except (ArithmeticError, ValueError):
        return _failing
    column = value if isinstance(value, bool | float) else exact_number(value)
    return lambda rows: column


def _failing(rows: Rows) -> Column:
    raise ArithmeticError
