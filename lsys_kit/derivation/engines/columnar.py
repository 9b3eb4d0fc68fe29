"""Words in which nearly every module is different: rows of numbers, and rules that are computed for whole columns.

Numbering states does not pay where hardly one occurs twice. Then a word is a column of kinds (symbol and number of
parameters) and a column for each parameter, in doubles, and each rule is computed once for all modules that it rewrites. Only
operations that numpy computes to the last bit as Python does are used; a system with others keeps to its table of states.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.system import LSystem, Module, flat

Array: TypeAlias = np.ndarray[Any, Any]
ColumnFunction: TypeAlias = Callable[..., Any]
"""From the columns of the names to the column of an expression, which is written to `out` where that is given and there is
something to compute."""
BLOCK = 2**15
"""So many rows are computed at a time: what lies between two operations stays in the processor's cache."""

_COLUMN_OPERATIONS: Mapping[str, Callable[..., Any]] = {
    "||": np.logical_or, "&&": np.logical_and, "!": np.logical_not, "==": np.equal, "!=": np.not_equal, "<": np.less,
    "<=": np.less_equal, ">": np.greater, ">=": np.greater_equal, "+": np.add, "-": np.subtract, "*": np.multiply,
    "/": np.divide, "-x": np.negative, "abs": np.abs, "sqrt": np.sqrt, "floor": np.floor, "ceil": np.ceil,
}


def column_function(expression: Expression) -> ColumnFunction:
    """The function of an expression for whole columns.

    >>> run = column_function(Apply("*", (Name("x"), Number(2))))
    >>> run({"x": np.array([1.0, 2.5])}).tolist()
    [2.0, 5.0]
    """
    if isinstance(expression, Number):
        value = float(expression.value)
        return lambda columns, out=None: value
    if isinstance(expression, Name):
        name = expression.name
        return lambda columns, out=None: columns[name]
    operator = _COLUMN_OPERATIONS[expression.operator]
    operands = [column_function(operand) for operand in expression.operands]
    return lambda columns, out=None: operator(*[operand(columns) for operand in operands], out=out)


@dataclass(frozen=True)
class ColumnRule:
    """One production for whole columns.

    Attributes
    ----------
    names
        The names of its parameters; None where the predecessor asks for a value.
    tests
        What must be true.
    parts
        For each module of the successor its kind's number and the functions of its arguments.
    """

    names: tuple[str | None, ...]
    tests: tuple[ColumnFunction, ...]
    parts: tuple[tuple[int, tuple[ColumnFunction, ...]], ...]


class ColumnWord(Word):
    """A word as columns; it becomes a row of states when somebody looks at single modules."""

    __slots__ = ("_row", "kinds", "names", "values")

    def __init__(self, states: States, kinds: Array, values: Array, names: Sequence[ModuleKind]) -> None:
        self.states, self.kinds, self.values, self.names = states, kinds, values, names
        self._row: Array | None = None

    def __len__(self) -> int:
        return len(self.kinds)

    @property
    def codes(self) -> Array:  # type: ignore[override]
        """The numbers of the states, which are numbered now."""
        if self._row is None:
            self._row = np.array([self.states.number(self.names[kind][0], tuple(row[:self.names[kind][1]]))
                                  for kind, row in zip(self.kinds.tolist(), self.values.tolist(), strict=True)], dtype=np.int64)
        return self._row


class ColumnarSteps:
    """The steps of a system in columns.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> states = States(read("axiom: A(1) B\\nA(x) : x < 3 -> A(x+1) A(x+2)"), {}, "float")
    >>> columns = ColumnarSteps(states)
    >>> word = columns.step(columns.word([states.modules[code] for code in states.axiom]))
    >>> str(word), len(word)
    ('A(2)A(3)B', 3)
    """

    def __init__(self, states: States) -> None:
        self.states = states
        system = states.system
        modules = [*system.axiom, *(m for rule in system.productions for m in rule.modules)]
        self.kinds = list(dict.fromkeys(map(kind_of, modules)))
        self.width = max(arity for _, arity in self.kinds)
        self._constants = dict(zip((constant.name for constant in system.constants), states.constants, strict=True))
        self._rules = [[self._rule(rule, system) for rule in states.rules.get(kind, ())] for kind in self.kinds]

    def _rule(self, rule: Rule, system: LSystem) -> ColumnRule:
        production = rule.production
        asked = production.predecessor.arguments
        formal = [isinstance(a, Name) and a.name not in self._constants for a in asked]
        equal = [Apply("==", (Name(f"#{i}"), a)) for i, a in enumerate(asked) if not formal[i]]  # type: ignore[arg-type]
        condition = [production.condition] if production.condition is not None else []
        parts = tuple((self.kinds.index(kind_of(m)), tuple(map(column_function, m.arguments)))  # type: ignore[arg-type]
                      for m in flat(production.successor))
        return ColumnRule(tuple(a.name if formal[i] else None for i, a in enumerate(asked)),  # type: ignore[union-attr]
                          tuple(map(column_function, [*equal, *condition])), parts)

    def word(self, modules: Sequence[Module]) -> ColumnWord:
        """A row of modules as columns."""
        numbers = {kind: number for number, kind in enumerate(self.kinds)}
        kinds = np.array([numbers[kind_of(module)] for module in modules], dtype=np.min_scalar_type(len(self.kinds)))
        values = np.zeros((len(modules), self.width))
        for row, module in enumerate(modules):
            values[row, :len(module.arguments)] = module.arguments  # type: ignore[assignment]
        return ColumnWord(self.states, kinds, values, self.kinds)

    def bytes(self, modules: int) -> int:
        """How much a word of so many modules takes."""
        return modules * (8 * self.width + 2)

    def step(self, word: ColumnWord, check: Callable[[int], None] = lambda size: None) -> ColumnWord:
        """The next word; `check` is told its size before it is built, and may raise an error."""
        chosen = self._chosen(word)
        if len(chosen) == 1:
            sizes, starts = None, None
            total = len(word) * (len(chosen[0][1].parts) if chosen[0][1] else 1)
        else:
            sizes = np.ones(len(word), dtype=np.int64)
            for _, rule, rows in chosen:
                sizes[rows] = len(rule.parts) if rule else 1
            ends = np.cumsum(sizes)
            total = int(ends[-1]) if len(ends) else 0
            starts = ends - sizes
        check(total)
        after = ColumnWord(self.states, np.empty(total, dtype=word.kinds.dtype), np.zeros((total, self.width)), self.kinds)
        for kind, rule, rows in chosen:
            at = None if starts is None else starts[rows]
            if rule is None:
                places = slice(None) if at is None else at
                after.kinds[places], after.values[places] = kind, word.values[rows]
            else:
                for low in range(0, len(word) if at is None else len(at), BLOCK):
                    self._write(rule, word, rows, low, after, at)
        return after

    def _write(self, rule: ColumnRule, word: ColumnWord, rows: Any, low: int, after: ColumnWord, starts: Array | None) -> None:
        """Write what a rule makes of a block of rows: from given places on, or of all rows one after another."""
        block = slice(low, min(low + BLOCK, len(word) if starts is None else len(starts)))
        ours = block if starts is None else rows[block]
        columns, every = self._columns(rule, word.values[ours]), len(rule.parts)
        for offset, (made, arguments) in enumerate(rule.parts):
            at: Any = (slice(block.start * every + offset, block.stop * every, every) if starts is None
                       else starts[block] + offset)
            after.kinds[at] = made
            for place, argument in enumerate(arguments):
                self._compute(argument, columns, after.values, (at, place), word, ours)

    def _chosen(self, word: ColumnWord) -> list[tuple[int, ColumnRule | None, Any]]:
        """For each kind and rule the rows that it rewrites, a slice where that is all; None for the rows that stay."""
        found: list[tuple[int, ColumnRule | None, Array]] = []
        if len(word) and (word.kinds == word.kinds[0]).all() and not any(rule.tests for rule in self._rules[word.kinds[0]]):
            return [(word.kinds[0], next(iter(self._rules[word.kinds[0]]), None), slice(None))]
        for kind, rules in enumerate(self._rules):
            rows = np.flatnonzero(word.kinds == kind)
            for rule in rules if len(rows) else ():
                if not rule.tests:
                    found.append((kind, rule, rows))
                    rows = rows[:0]
                    break
                columns = self._columns(rule, word.values[rows])
                with np.errstate(all="ignore"):
                    matches = np.ones(len(rows), dtype=bool)
                    for test in rule.tests:
                        matches &= test(columns)
                found.append((kind, rule, rows[matches]))
                rows = rows[~matches]
            found.append((kind, None, rows))
        return [(kind, rule, rows) for kind, rule, rows in found if len(rows)]

    def _columns(self, rule: ColumnRule, values: Array) -> dict[str, Any]:
        """The columns of a rule's names."""
        columns: dict[str, Any] = dict(self._constants)
        for place, name in enumerate(rule.names):
            columns[name or f"#{place}"] = values[:, place]
        return columns

    def _compute(self, argument: ColumnFunction, columns: Mapping[str, Any], values: Array, at: tuple[Any, int],
                 word: ColumnWord, rows: Any) -> None:
        """Write a column of numbers; where one is none, raise the error that its module gives."""
        target = values[at] if isinstance(at[0], slice) else None
        with np.errstate(all="ignore"):
            found = argument(columns, out=target)
            if target is None or found is not target:
                values[at] = found
            whole = np.sum(found)
        if not np.isfinite(whole):
            self._refuse(values[at], word, rows)

    def _refuse(self, found: Array, word: ColumnWord, rows: Any) -> None:
        """Raise the error of the first module whose value is none; a mere sum may be past all numbers."""
        bad = np.flatnonzero(~np.isfinite(found))
        if len(bad):
            self.states.successor(int(word.codes[np.arange(len(word))[rows][bad[0]]]))
