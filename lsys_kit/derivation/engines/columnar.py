"""Words in which nearly every module is different: rows of numbers, and rules that are computed for whole columns.

Numbering states does not pay where hardly one occurs twice. Then a word is a column of kinds (symbol and number of
parameters) and a column for each parameter, and each rule is computed once for all modules that it rewrites. What columns
cannot compute as the table of states does, a division by zero above all, raises an `ArithmeticError`: such a step is the
table's.

In doubles a column is an array, and the operations are those that numpy computes to the last bit as Python does; what raises a
floating-point error is not for columns. Exact columns are integers over one common denominator: of 64 bits while they are sure
to fit, else Python's own. Where a row may have no exact result, or none that fits, an `ArithmeticError` is raised.
"""

from __future__ import annotations

import math
import operator
from array import array
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import Task, counted, current
from lsys_kit.derivation.core.rules import ModuleKind, Rule, Values, kind_of
from lsys_kit.derivation.core.states import EXACT_BITS, States
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.engines.engine import code_type
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Module, flat

if TYPE_CHECKING:
    from numpy.typing import NDArray

Array: TypeAlias = "NDArray[Any]"
Rows: TypeAlias = Any
"""Some rows of a word, as they index an array: their numbers, or a slice."""
Column: TypeAlias = "Array | ExactColumn | float"
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

    numerators
        An array of integers, or one integer for all rows.
    denominator
        An integer greater than 0.
    bits
        As many bits as are enough for the absolute value of each numerator.

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


def _over_common(operation: Callable[..., Array | int], left: ExactColumn, right: ExactColumn) -> ExactColumn:
    common = math.lcm(left.denominator, right.denominator)
    bits = 1 + max(column.bits + (common // column.denominator).bit_length() for column in (left, right))
    first, second = (ExactColumn(column.numerators, column.denominator, bits).over(common) for column in (left, right))
    return ExactColumn(operation(first, second), common, bits)


def _compared(operation: Callable[[Array | int, int], object]) -> Callable[[ExactColumn, ExactColumn], Array]:
    def compare(left: ExactColumn, right: ExactColumn) -> Array:
        return np.asarray(operation((left - right).numerators, 0), dtype=bool)

    return compare


def _exact(operation: ColumnFunction) -> ColumnFunction:
    return lambda *operands, out=None: operation(*operands)


def _numpy(name: str) -> ColumnFunction:
    return lambda *operands, out=None: getattr(np, name)(*operands, out=out)


_TRUTHS: Mapping[str, ColumnFunction] = {"||": _numpy("logical_or"), "&&": _numpy("logical_and"), "!": _numpy("logical_not")}
OPERATIONS: Mapping[str, Mapping[str, ColumnFunction]] = {
    "float": {
        **_TRUTHS,
        "==": _numpy("equal"),
        "!=": _numpy("not_equal"),
        "<": _numpy("less"),
        "<=": _numpy("less_equal"),
        ">": _numpy("greater"),
        ">=": _numpy("greater_equal"),
        "+": _numpy("add"),
        "-": _numpy("subtract"),
        "*": _numpy("multiply"),
        "/": _numpy("divide"),
        "-x": _numpy("negative"),
        "abs": _numpy("abs"),
        "sqrt": _numpy("sqrt"),
        "floor": _numpy("floor"),
        "ceil": _numpy("ceil"),
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


def _listed(rows: Array) -> Iterator[list[int]]:
    for first in range(0, len(rows), ROWS_AT_A_TIME):
        yield from rows[first : first + ROWS_AT_A_TIME].tolist()


class FloatColumns:
    """The values of a word in doubles, a row for each module; they are written column by column."""

    bytes = 8

    def __init__(self, shape: tuple[int, int]) -> None:
        self.array = np.zeros(shape)

    def write(self, argument: ColumnFunction, named: Mapping[str, Column], places: Rows, parameter: int) -> None:
        """Write what an argument comes to into some places of the column of a parameter."""
        target = self.array[places, parameter] if isinstance(places, slice) else None
        found = argument(named, out=target)
        if target is None or found is not target:
            self.array[places, parameter] = found

    def whole(self) -> FloatColumns:
        """All that was written."""
        return self

    def columns(self, rows: Rows, parameters: int) -> Iterator[Array]:
        """The columns of the first parameters, of some rows."""
        there = self.array[rows]
        return (there[:, parameter] for parameter in range(parameters))

    def rows(self) -> Iterable[Values]:
        """The values of each module, as numbers."""
        return map(tuple, _listed(self.array))


class ExactColumns:
    """The exact values of a word: a row of numerators for each module, and one denominator; they are put together in the end.

    >>> columns = ExactColumns((2, 1))
    >>> for row, value in enumerate((Fraction(1, 2), Fraction(2, 3))):
    ...     columns.write(column_function(Number(value), "exact"), {}, row, 0)
    >>> list(columns.whole().rows())
    [(Fraction(1, 2),), (Fraction(2, 3),)]
    """

    def __init__(self, shape: tuple[int, int]) -> None:
        self._shape = shape
        self._written: list[tuple[Rows, int, ExactColumn]] = []

    def write(self, argument: ColumnFunction, named: Mapping[str, Column], places: Rows, parameter: int) -> None:
        self._written.append((places, parameter, argument(named)))

    def whole(self) -> ExactColumns:
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
        self.numerators, self.denominator, self.bits = found, common, bits
        self._written.clear()
        return self

    @property
    def bytes(self) -> int:
        """About how many bytes one value takes."""
        return 8 if self.bits <= SHORT_BITS else 56

    def columns(self, rows: Rows, parameters: int) -> Iterator[ExactColumn]:
        there = self.numerators[rows]
        return (ExactColumn(there[:, parameter], self.denominator, self.bits) for parameter in range(parameters))

    def rows(self) -> Iterable[Values]:
        return (tuple(normalised(Fraction(number, self.denominator)) for number in row) for row in _listed(self.numerators))


BLOCK_ROWS = 2**15
"""So many rows are computed at a time: what lies between two operations stays in the processor's cache."""


@dataclass(frozen=True)
class ColumnRule:
    """One production for whole columns.

    names
        The names of its parameters; `#0`, `#1`, ... where the predecessor asks for a value.
    tests
        What must be true.
    parts
        For each module of the successor its kind's number and the functions of its arguments.
    """

    names: tuple[str, ...]
    tests: tuple[ColumnFunction, ...]
    parts: tuple[tuple[int, tuple[ColumnFunction, ...]], ...]


class ColumnWord(Word):
    """A word as columns; it becomes a row of states when single modules are asked for.

    kinds
        For each module the number of its kind.
    values
        The values of all modules.
    names
        The kinds.
    """

    __slots__ = ("_row", "kinds", "names", "values")

    def __init__(self, states: States, kinds: Array, values: FloatColumns | ExactColumns, names: Sequence[ModuleKind]) -> None:
        self.states, self.kinds, self.values, self.names = states, kinds, values, names
        self._row: array[int] | None = None

    def __reduce__(self) -> tuple[object, ...]:
        return Word, (self.states, self.codes)

    def __len__(self) -> int:
        return len(self.kinds)

    @property
    def bytes(self) -> int:
        return len(self) * (self.values.bytes * max(arity for _, arity in self.names) + 10)

    @property
    def codes(self) -> array[int]:  # type: ignore[override]
        """The numbers of the states, which are numbered now."""
        if self._row is None:
            with Task("The modules of the word were not numbered"):
                numbers = [
                    self.states.number(self.names[kind][0], row[: self.names[kind][1]])
                    for kind, row in counted(zip(self.kinds.tolist(), self.values.rows(), strict=True))
                ]
                self._row = array(code_type(len(self.states)), numbers)
        return self._row


class ColumnarSteps:
    """The steps of a system in columns.

    >>> from lsys_kit import read
    >>> states = States(read("axiom: A(1) B\\nA(x) : x < 3 -> A(x+1) A(x/2)"))
    >>> columns = ColumnarSteps(states)
    >>> word = columns.step(columns.word([states.modules[code] for code in states.axiom]))
    >>> str(word), len(word)
    ('A(2)A(0.5)B', 3)
    """

    def __init__(self, states: States) -> None:
        self.states, system = states, states.system
        modules = [*system.axiom, *(m for rule in system.productions for m in rule.modules)]
        self.kinds = list(dict.fromkeys(map(kind_of, modules)))
        self.width = max(arity for _, arity in self.kinds)
        self._constants = [constant.name for constant in system.constants]
        self._rules = [[*map(self._rule, states.rules.get(kind, ())), self._identity(kind)] for kind in self.kinds]

    def _rule(self, rule: Rule) -> ColumnRule:
        def ready(expression: Expression) -> ColumnFunction:
            return column_function(expression, self.states.arithmetic)

        production = rule.production
        asked = production.predecessor.arguments
        formal = {i: a.name for i, a in enumerate(asked) if isinstance(a, Name) and a.name not in self._constants}
        names = tuple(formal.get(i, f"#{i}") for i in range(len(asked)))
        equal = [Apply("==", (Name(names[i]), a)) for i, a in enumerate(asked) if i not in formal]
        condition = [] if production.condition is None else [production.condition]
        parts = tuple((self.kinds.index(kind_of(m)), tuple(map(ready, m.arguments))) for m in flat(production.successor))
        return ColumnRule(names, tuple(map(ready, [*equal, *condition])), parts)

    def _identity(self, kind: ModuleKind) -> ColumnRule:
        names = tuple(f"#{i}" for i in range(kind[1]))
        same = tuple(column_function(Name(name), self.states.arithmetic) for name in names)
        return ColumnRule(names, (), ((self.kinds.index(kind), same),))

    def word(self, modules: Sequence[Module]) -> ColumnWord:
        """A row of modules as columns; an `ArithmeticError`, where a number is not exact and should be."""
        numbers = {kind: number for number, kind in enumerate(self.kinds)}
        kinds = np.array([numbers[kind_of(module)] for module in modules], dtype=np.min_scalar_type(len(self.kinds)))
        columns = self._collected((len(modules), self.width))
        for row, module in enumerate(modules):
            for parameter, value in enumerate(module.arguments):
                columns.write(column_function(Number(value), self.states.arithmetic), {}, row, parameter)
        return ColumnWord(self.states, kinds, columns.whole(), self.kinds)

    def step(self, word: ColumnWord, check: Callable[[int, int], None] = lambda size, taken: None) -> ColumnWord:
        """The next word; `check` is called with its size and its bytes before it is built, and may raise an error.

        Raises
        ------
        ArithmeticError
            A value cannot be computed in columns.
        """
        with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
            chosen = self._chosen(word)
            starts, size = _places(word, chosen)
            check(size, size * (word.values.bytes * self.width + 2))
            kinds, columns = np.empty(size, dtype=word.kinds.dtype), self._collected((size, self.width))
            for rule, rows in chosen:
                for block, at in counted(_blocks(rule, len(word), rows, starts), 1):
                    self._write(rule, self._named(rule, word, block), kinds, columns, at)
            return ColumnWord(self.states, kinds, columns.whole(), self.kinds)

    def _collected(self, shape: tuple[int, int]) -> FloatColumns | ExactColumns:
        return ExactColumns(shape) if self.states.arithmetic == "exact" else FloatColumns(shape)

    def _write(
        self, rule: ColumnRule, named: Mapping[str, Column], kinds: Array, columns: FloatColumns | ExactColumns, at: Rows
    ) -> None:
        """Write what a rule makes of a block of rows, from given places on."""
        for offset, (kind, arguments) in enumerate(rule.parts):
            places = slice(at.start + offset, at.stop, at.step) if isinstance(at, slice) else at + offset
            kinds[places] = kind
            for parameter, argument in enumerate(arguments):
                columns.write(argument, named, places, parameter)

    def _chosen(self, word: ColumnWord) -> list[tuple[ColumnRule, Rows]]:
        """For each rule the rows that it rewrites, a slice where that is all."""
        if len(word) and not self._rules[word.kinds[0]][0].tests and (word.kinds == word.kinds[0]).all():
            return [(self._rules[word.kinds[0]][0], slice(None))]
        found: list[tuple[ColumnRule, Rows]] = []
        for kind, rules in enumerate(self._rules):
            rows = np.flatnonzero(word.kinds == kind)
            for rule in rules:
                if not len(rows):
                    break
                named = self._named(rule, word, rows) if rule.tests else {}
                matches = np.ones(len(rows), dtype=bool)
                for test in rule.tests:
                    matches &= test(named)
                found.append((rule, rows[matches]))
                rows = rows[~matches]
        return [(rule, rows) for rule, rows in found if len(rows)]

    def _named(self, rule: ColumnRule, word: ColumnWord, rows: Rows) -> dict[str, Column]:
        number = exact_number if self.states.arithmetic == "exact" else float
        named: dict[str, Column] = {
            name: number(value) for name, value in zip(self._constants, self.states.constants, strict=True)
        }
        return named | dict(zip(rule.names, word.values.columns(rows, len(rule.names)), strict=True))


def _places(word: ColumnWord, chosen: Sequence[tuple[ColumnRule, Rows]]) -> tuple[Array | None, int]:
    """Where in the next word what becomes of each module begins, None where one rule rewrites all; and its size."""
    if len(chosen) == 1:
        return None, len(word) * len(chosen[0][0].parts)
    sizes = np.ones(len(word), dtype=np.int64)
    for rule, rows in chosen:
        sizes[rows] = len(rule.parts)
    ends = np.cumsum(sizes)
    return ends - sizes, int(ends[-1]) if len(ends) else 0


def _blocks(rule: ColumnRule, size: int, rows: Rows, starts: Array | None) -> Iterator[tuple[Rows, Rows]]:
    """The rows that a rule rewrites, in blocks, each with the places where what it makes of them begins."""
    every = len(rule.parts)
    for low in range(0, size if starts is None else len(rows), BLOCK_ROWS):
        if starts is None:
            high = min(low + BLOCK_ROWS, size)
            yield slice(low, high), slice(low * every, high * every, max(every, 1))
        else:
            block = rows[low : low + BLOCK_ROWS]
            yield block, starts[block]
