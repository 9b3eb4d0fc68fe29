"""Words in which nearly every module is different: rows of numbers, and rules that are computed for whole columns.

Numbering states does not pay where hardly one occurs twice. Then a word is a column of kinds (symbol and number of
parameters) and a column for each parameter, and each rule is computed once for all modules that it rewrites. What columns
cannot compute as the table of states does, a division by zero above all, raises an `ArithmeticError`: such a step is the
table's.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.engines.columns import (
    Array,
    ColumnFunction,
    ExactColumns,
    ExactValues,
    FloatColumns,
    FloatValues,
    column_function,
    exact_number,
)
from lsys_kit.derivation.engines.expansion import code_type
from lsys_kit.notation.model.expressions import Apply, Name, Number
from lsys_kit.notation.model.modules import Module, flat

BLOCK_ROWS = 2**15
"""So many rows are computed at a time: what lies between two operations stays in the processor's cache."""


@dataclass(frozen=True)
class ColumnRule:
    """One production for whole columns.

    Attributes
    ----------
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

    Attributes
    ----------
    kinds
        For each module the number of its kind.
    values
        The values of all modules.
    names
        The kinds.
    """

    __slots__ = ("_row", "kinds", "names", "values")

    def __init__(self, states: States, kinds: Array, values: FloatValues | ExactValues, names: Sequence[ModuleKind]) -> None:
        self.states, self.kinds, self.values, self.names = states, kinds, values, names
        self._row: Array | None = None

    def __reduce__(self) -> tuple[object, ...]:
        return Word, (self.states, self.codes)

    def __len__(self) -> int:
        return len(self.kinds)

    @property
    def bytes(self) -> int:
        """How much memory it takes."""
        return len(self) * (self.values.bytes * max(arity for _, arity in self.names) + 10)

    @property
    def codes(self) -> Array:  # type: ignore[override]
        """The numbers of the states, which are numbered now."""
        if self._row is None:
            with Task("The modules of the word were not numbered"):
                numbers = [
                    self.states.number(self.names[kind][0], row[: self.names[kind][1]])
                    for kind, row in counted(zip(self.kinds.tolist(), self.values.rows(), strict=True))
                ]
                self._row = np.array(numbers, dtype=code_type(len(self.states)))
        return self._row


class ColumnarSteps:
    """The steps of a system in columns.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
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
        def ready(expression: Any) -> ColumnFunction:
            return column_function(expression, self.states.arithmetic)

        production = rule.production
        asked = production.predecessor.arguments
        formal = [isinstance(a, Name) and a.name not in self._constants for a in asked]
        names = tuple(a.name if formal[i] else f"#{i}" for i, a in enumerate(asked))  # type: ignore[union-attr]
        equal = [Apply("==", (Name(names[i]), a)) for i, a in enumerate(asked) if not formal[i]]
        condition = [production.condition] if production.condition is not None else []
        parts = tuple((self.kinds.index(kind_of(m)), tuple(map(ready, m.arguments))) for m in flat(production.successor))
        return ColumnRule(names, tuple(map(ready, [*equal, *condition])), parts)

    def _identity(self, kind: ModuleKind) -> ColumnRule:
        """The rule by which modules stay what they are."""
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
        return ColumnWord(self.states, kinds, columns.values(), self.kinds)

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
            return ColumnWord(self.states, kinds, columns.values(), self.kinds)

    def _collected(self, shape: tuple[int, int]) -> FloatColumns | ExactColumns:
        return ExactColumns(shape) if self.states.arithmetic == "exact" else FloatColumns(shape)

    def _write(
        self, rule: ColumnRule, named: Mapping[str, Any], kinds: Array, columns: FloatColumns | ExactColumns, at: Any
    ) -> None:
        """Write what a rule makes of a block of rows, from given places on."""
        for offset, (kind, arguments) in enumerate(rule.parts):
            places = slice(at.start + offset, at.stop, at.step) if isinstance(at, slice) else at + offset
            kinds[places] = kind
            for parameter, argument in enumerate(arguments):
                columns.write(argument, named, places, parameter)

    def _chosen(self, word: ColumnWord) -> list[tuple[ColumnRule, Any]]:
        """For each rule the rows that it rewrites, a slice where that is all."""
        if len(word) and not self._rules[word.kinds[0]][0].tests and (word.kinds == word.kinds[0]).all():
            return [(self._rules[word.kinds[0]][0], slice(None))]
        found: list[tuple[ColumnRule, Any]] = []
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

    def _named(self, rule: ColumnRule, word: ColumnWord, rows: Any) -> dict[str, Any]:
        """The columns of a rule's names."""
        number = exact_number if self.states.arithmetic == "exact" else float
        named: dict[str, Any] = {
            name: number(value) for name, value in zip(self._constants, self.states.constants, strict=True)
        }
        return named | dict(zip(rule.names, word.values.columns(rows, len(rule.names)), strict=True))


def _places(word: ColumnWord, chosen: Sequence[tuple[ColumnRule, Any]]) -> tuple[Array | None, int]:
    """Where in the next word what becomes of each module begins, None where one rule rewrites all; and its size."""
    if len(chosen) == 1:
        return None, len(word) * len(chosen[0][0].parts)
    sizes = np.ones(len(word), dtype=np.int64)
    for rule, rows in chosen:
        sizes[rows] = len(rule.parts)
    ends = np.cumsum(sizes)
    return ends - sizes, int(ends[-1]) if len(ends) else 0


def _blocks(rule: ColumnRule, size: int, rows: Any, starts: Array | None) -> Iterator[tuple[Any, Any]]:
    """The rows that a rule rewrites, in blocks, each with the places where what it makes of them begins."""
    every = len(rule.parts)
    for low in range(0, size if starts is None else len(rows), BLOCK_ROWS):
        if starts is None:
            high = min(low + BLOCK_ROWS, size)
            yield slice(low, high), slice(low * every, high * every, max(every, 1))
        else:
            block = rows[low : low + BLOCK_ROWS]
            yield block, starts[block]
