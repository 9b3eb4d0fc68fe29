"""Words in which nearly every module is different: columns of numbers, and rules that are computed for whole columns.

Numbering states does not pay where hardly one occurs twice. Then a word is a column of kinds (symbol and number of
parameters) and a column for each parameter, and each rule is computed once for all modules that it rewrites: conditions are
masks, neighbours are columns of places, and a choice by chance is a column of random numbers. What columns cannot compute as
the module-by-module engine does, a division by zero above all, raises an `ArithmeticError`: such a step is that engine's.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property, partial, reduce
from itertools import chain
from typing import TYPE_CHECKING, Any, TypeAlias, cast, overload

from lsys_kit.arrays import np
from lsys_kit.budget import Task, counted, current
from lsys_kit.derivation.core.chance import MASK, choose, stretches, units_of
from lsys_kit.derivation.core.matching import NO_NEIGHBOUR, passing_of
from lsys_kit.derivation.core.rules import ModuleKind, Rule, Rules, Values, kind_of
from lsys_kit.derivation.core.states import EXACT_BITS, States
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.engines.columns import (
    SHORT_BITS,
    Column,
    ColumnFunction,
    Draws,
    ExactColumn,
    Mixed,
    Rows,
    column_function,
    column_of,
    single_value,
    taken,
    truths,
    values_of,
)
from lsys_kit.derivation.engines.contexts import CLOSES, OPENS, ORDINARY, PASSED, context_neighbours
from lsys_kit.derivation.engines.engine import Origins, check_size, code_type
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model.arithmetic import Value, finite, normalised
from lsys_kit.notation.model.expressions import Apply, Expression, Name, is_random, names_in
from lsys_kit.notation.model.modules import CLOSING, END, OPENING, Item, Module, Repeat, expressions_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

Array: TypeAlias = "NDArray[Any]"
Places: TypeAlias = "Array | slice"
"""Some rows of a word, as they index an array."""
Site: TypeAlias = tuple[int, int]
"""Where a rule finds a value: in which of the modules that it names, and in which parameter."""
REDUCED_BITS = 31
"""Fractions with different denominators are reduced before they are kept, if they may have more bits."""
BLOCK_ROWS = 2**15
"""So many rows are computed at a time: what lies between two operations stays in the processor's cache."""
ROWS_AT_A_TIME = 2**12
"""So many rows of an array become numbers of Python at a time."""
MODULES_LOOKED_AT, ALIKE = 512, 16
"""So many modules show whether a word has few that are different: not more than one of so many."""
MOST_CHOICES = 62
"""Of so many rules of a module those that match are noted in the bits of one number."""


@dataclass(eq=False)
class Parameter:
    """The values of one parameter, a row for each module of a word.

    numbers
        The doubles; for an exact value its numerator, as the same 64 bits.
    denominators
        Those of exact values; 0 for a double; -1 for a value that does not fit, which is among the `long` ones of its word, at
        the place that stands for the numerator. None where all values are doubles.
    bits
        As many bits as are enough for each numerator and denominator.
    """

    numbers: Array
    denominators: Array | None = None
    bits: tuple[int, int] = (0, 1)

    @property
    def bytes(self) -> int:
        return self.numbers.nbytes + (0 if self.denominators is None else self.denominators.nbytes)

    def repeated(self, times: int) -> Parameter:
        below = None if self.denominators is None else np.tile(self.denominators, times)
        return Parameter(np.tile(self.numbers, times), below, self.bits)

    def copy(self) -> Parameter:
        return Parameter(self.numbers.copy(), None if self.denominators is None else self.denominators.copy(), self.bits)

    def some(self, places: Places) -> Parameter:
        return Parameter(self.numbers[places], None if self.denominators is None else self.denominators[places], self.bits)

    def column(self, long: LongNumbers) -> Column:
        """The values, which are all of one form."""
        if self.denominators is None or not len(self.numbers) or self.denominators[0] == 0:
            return self.numbers
        above, below, bits, wide = self.numbers.view(np.int64), self.denominators, self.bits, False
        if below[0] < 0:
            above, below, bits, wide = long[0][above], long[1][above], long[2], True
        first = int(below[0])
        return ExactColumn(above, first if (below == first).all() else below, bits, wide)


LongNumbers: TypeAlias = "tuple[Any, Any, tuple[int, int]]"
"""Numerators and denominators, in whole numbers of Python, that may have more than 62 bits; and how many each has at most."""
NO_LONG_NUMBERS: LongNumbers = ((), (), (0, 1))


@dataclass(eq=False)
class Structure:
    """The kinds of a word's modules, and what follows from them alone.

    bounds
        Where the word of each run begins, if those of several are side by side, and where the last one ends.
    around
        The places of the neighbours in the sense of contexts, to the left and to the right.
    candidates
        For each rule, by its number, the places of the modules that it names, where they are of the right kinds.
    outline
        Which rule rewrites which modules, if no value and no chance has a say.
    """

    kinds: Array
    bounds: Array | None = None
    around: tuple[Array, Array] | None = None
    candidates: dict[int, tuple[Places, ...]] = field(default_factory=dict)
    outline: Outline | None = None

    def runs(self, rows: Array) -> Array:
        """The runs that some modules belong to, where there are several."""
        return np.searchsorted(cast("Array", self.bounds), rows, side="right") - 1

    def apart(self, sides: tuple[Array, Array]) -> tuple[Array, Array]:
        """Neighbours without those of other runs."""
        run = self.runs(np.arange(len(self.kinds)))
        left, right = (np.where(run[side] == run, side, NO_NEIGHBOUR) for side in sides)
        return left, right


class ColumnWord(Word):
    """A word as columns; it becomes a row of states when these are asked for.

    names
        The kinds that modules may have.
    structure
        The kinds of the modules, by their numbers.
    parameters
        The values of the modules.
    long
        Exact values of more than 62 bits.
    """

    __slots__ = ("_row", "long", "names", "parameters", "structure")

    def __init__(
        self,
        states: States,
        names: Sequence[ModuleKind],
        structure: Structure,
        parameters: Sequence[Parameter],
        long: LongNumbers,
    ) -> None:
        self.states, self.names, self.structure, self.parameters, self.long = states, names, structure, parameters, long
        self._row: array[int] | None = None

    def __reduce__(self) -> tuple[object, ...]:
        return ColumnWord, (self.states, self.names, Structure(self.kinds), self.parameters, self.long)

    def __len__(self) -> int:
        return len(self.structure.kinds)

    @property
    def kinds(self) -> Array:
        """For each module the number of its kind."""
        return self.structure.kinds

    @property
    def bytes(self) -> int:
        """About how many bytes it takes, each module for itself."""
        return self.kinds.nbytes + sum(each.bytes for each in self.parameters) + LONG_BYTES * len(self.long[0])

    @overload
    def __getitem__(self, index: int) -> Module: ...
    @overload
    def __getitem__(self, index: slice) -> Word: ...
    def __getitem__(self, index: int | slice) -> Module | Word:
        if isinstance(index, slice):
            return self._some(index)
        place = range(len(self))[index]
        return Module(*next(self._written(place, place + 1)))

    def _some(self, rows: slice) -> ColumnWord:
        parameters = [each.some(rows) for each in self.parameters]
        return ColumnWord(self.states, self.names, Structure(self.kinds[rows]), parameters, self.long)

    def __iter__(self) -> Iterator[Module]:
        return (Module(*each) for each in self.written())

    def different(self) -> frozenset[object]:
        """The modules that differ among a few of the word; none, if these are no small part of them."""
        some = self._some(slice(None, None, len(self) // MODULES_LOOKED_AT + 1))
        found = {*some.written()}
        return frozenset(found if len(found) * ALIKE <= len(some) else ())

    def counts(self) -> Mapping[str, int]:
        """How often each symbol occurs."""
        found: dict[str, int] = {}
        numbers = np.bincount(self.kinds, minlength=len(self.names)).tolist()
        for (symbol, _), number in zip(self.names, numbers, strict=True):
            if number:
                found[symbol] = found.get(symbol, 0) + number
        return found

    def written(self) -> Iterator[tuple[str, Values]]:
        """The symbol and the values of each module."""
        blocks = range(0, len(self), ROWS_AT_A_TIME)
        return chain.from_iterable(self._written(first, first + ROWS_AT_A_TIME) for first in blocks)

    def _written(self, first: int, last: int) -> Iterator[tuple[str, Values]]:
        kinds = self.kinds[first:last].tolist()
        parameters = [self._values(each.some(slice(first, last))) for each in self.parameters]
        rows = zip(*parameters, strict=True) if parameters else [()] * len(kinds)
        for kind, row in zip(kinds, rows, strict=True):
            symbol, arity = self.names[kind]
            yield symbol, row[:arity]

    def _values(self, parameter: Parameter) -> list[Value]:
        found: list[Value] = parameter.numbers.tolist()
        if parameter.denominators is not None:
            above = parameter.numbers.view(np.int64)
            for row in np.flatnonzero(parameter.denominators).tolist():
                number, below = int(above[row]), int(parameter.denominators[row])
                if below < 0:
                    number, below = self.long[0][number], self.long[1][number]
                found[row] = number if below == 1 else normalised(Fraction(number, below))
        return found

    def examples(self) -> Array:
        """For each module the state of the first of its kind, without numbers for all others."""
        kinds, places = np.unique(self.kinds, return_index=True)
        states = np.zeros(len(self.names), np.int64)
        states[kinds] = [self.states.number(*next(self._written(place, place + 1))) for place in places.tolist()]
        return states[self.kinds]

    def floats(self, parameter: int, rows: Array) -> Array:
        """The values of a parameter in some rows, as doubles."""
        some = self.parameters[parameter].some(rows)
        if some.denominators is None:
            return some.numbers
        found = np.where(some.denominators > 0, some.numbers.view(np.int64) / np.maximum(some.denominators, 1), some.numbers)
        long = np.flatnonzero(some.denominators < 0)
        found[long] = [float(value) for value in self._values(some.some(long))]
        return found

    @property
    def codes(self) -> array[int]:  # type: ignore[override]
        """The numbers of the states, which are numbered now."""
        if self._row is None:
            with Task("The modules of the word were not numbered"):
                numbers = [self.states.number(*each) for each in counted(self.written())]
                self._row = array(code_type(len(self.states)), numbers)
        return self._row


LONG_BYTES, BYTES_OF_A_VALUE = 120, 16
"""About what an exact value of more than 62 bits takes, and what any other value takes at most."""
INDEX_BITS = 24
"""So many bits are enough for the number of a repetition."""
Check: TypeAlias = Callable[[int, int], None]
"""What is called with the size and the bytes of a word before it is built."""
Expanded: TypeAlias = "tuple[Array, Sequence[Piece]]"
FewParts: TypeAlias = "Sequence[Part | Repeated]"


@dataclass(frozen=True)
class Part:
    """A module of a successor: the number of its kind and the functions of its arguments."""

    kind: int
    arguments: tuple[ColumnFunction, ...]


@dataclass(frozen=True)
class Repeated:
    """A repeated part of a successor: how often, what is written each time, and the name that counts in it.

    together
        Whether all repetitions can be computed at once: each writes as many modules, and draws no random numbers.
    """

    count: ColumnFunction
    body: FewParts
    index: str
    together: bool


@dataclass(frozen=True)
class ColumnRule:
    """One production for whole columns.

    rule
        The rule.
    number
        Its number among all for which candidates are noted.
    kind, left, right
        The numbers of the kinds that it names; those of its contexts from the nearest on, -1 for the end of a branch.
    test
        What must be true, or None.
    tested, used
        Where the values of its names are found: those that its test and its weight need, and those that its successor needs.
    weight
        The weight with which it is chosen at random, or None.
    parts
        The modules of its successor.
    repeats
        Whether some of them are repeated.
    """

    rule: Rule
    number: int
    kind: int
    left: tuple[int, ...]
    right: tuple[int, ...]
    test: ColumnFunction | None
    tested: Mapping[str, Site]
    used: Mapping[str, Site]
    weight: ColumnFunction | None
    parts: FewParts
    repeats: bool


@dataclass(frozen=True, eq=False)
class Applied:
    """A rule, and the modules that it rewrites.

    places
        The places of the modules that it names, itself first.
    drawn
        How many random numbers each of them has drawn before.
    """

    rule: ColumnRule
    places: tuple[Places, ...]
    drawn: Any = 0

    @property
    def size(self) -> int:
        own = self.places[0]
        return own.stop - own.start if isinstance(own, slice) else len(own)

    def own(self) -> Array:
        return _numbered(self.places[0])

    def some(self, which: Array) -> Applied:
        """The same rule and some of the modules."""
        if len(which) == self.size:
            return self
        drawn = self.drawn if isinstance(self.drawn, int) else self.drawn[which]
        return Applied(self.rule, tuple(_numbered(each)[which] for each in self.places), drawn)


@dataclass(frozen=True, eq=False)
class Piece:
    """A module that a rule with repetitions makes of some rows: behind how many others, its kind and its values."""

    rows: Array
    behind: Array
    kind: int
    values: Sequence[Column]


class Outline:
    """Which rule rewrites which modules of a word, and where what they become is written.

    Attributes
    ----------
    size
        The size of the next word.
    starts
        Where in it what becomes of each module begins; None where that follows from its place: each becomes one module, or one
        rule rewrites all.
    """

    def __init__(
        self,
        rules: Sequence[Sequence[ColumnRule]],
        length: int,
        applied: Sequence[Applied],
        expanded: Sequence[Expanded | None],
    ) -> None:
        self.rules, self.length, self.applied, self.expanded = rules, length, applied, expanded
        lengths = {len(each.rule.parts) for each in applied}
        plain = not any(expanded)
        self.every = len(applied[0].rule.parts) if plain and len(applied) == 1 and applied[0].size == length else None
        self.erases = not plain or 0 in lengths
        self.in_place = plain and self.every is None and lengths <= {1}
        self.size, self.starts = length, None
        if self.every is not None:
            self.size = length * self.every
        elif not self.in_place:
            ends = np.cumsum(self.sizes)
            self.size, self.starts = int(ends[-1]) if length else 0, ends - self.sizes

    @cached_property
    def sizes(self) -> Array:
        """How many modules each module becomes."""
        found = np.ones(self.length, dtype=np.int64)
        for each, expanded in zip(self.applied, self.expanded, strict=True):
            found[each.places[0]] = expanded[0] if expanded else len(each.rule.parts)
        return found

    @property
    def productions(self) -> Array:
        """The number of the production that rewrites each module, or -1."""
        found = np.full(self.length, -1, dtype=np.int64)
        for each in self.applied:
            found[each.places[0]] = each.rule.rule.number
        return found

    def bounds(self, before: Array) -> Array:
        """Where the words of several runs begin after the step, and where the last one ends."""
        if self.starts is not None:
            return np.append(self.starts, self.size)[before]
        return before if self.every is None else before * self.every

    def writer(self, word: ColumnWord) -> Writer:
        """The next word, in which so far only that is written which stays as it is."""
        if self.in_place:
            return Writer.copied(word)
        found = Writer(self.size, word.kinds.dtype, len(word.parameters))
        if self.starts is not None and self.erases:
            kept = np.ones(self.length, dtype=bool)
            for each in self.applied:
                kept[each.places[0]] = False
            rows = np.flatnonzero(kept)
            found.keep(word, rows, self.starts[rows])
        elif self.starts is not None:  # what is rewritten is written over, which takes less time than to leave it out
            found.keep(word, slice(None), self.starts)
        return found

    def place(self, rows: Places, part: int) -> Places:
        """Where a part is written of what some modules become."""
        if self.in_place:
            return rows
        if self.starts is not None:
            found: Array = self.starts[rows] + part
            return found
        assert self.every
        if isinstance(rows, slice):
            return slice(rows.start * self.every + part, rows.stop * self.every, self.every)
        return rows * self.every + part


class Writer:
    """A word that is being written: the kinds and the values of its modules."""

    def __init__(self, size: int, kinds: Any, width: int) -> None:
        self.kinds = np.empty(size, dtype=kinds)
        self.parameters = [Parameter(np.empty(size)) for _ in range(width)]
        self.long: list[LongNumbers] = [NO_LONG_NUMBERS]
        self.outgrown: list[Array] = []
        self._shared = False

    @classmethod
    def copied(cls, word: ColumnWord) -> Writer:
        """A word as it is, some of whose modules are written anew."""
        found = cls(0, word.kinds.dtype, 0)
        found.kinds, found._shared = word.kinds, True
        found.parameters = [each.copy() for each in word.parameters]
        found.long = [word.long]
        return found

    def write_kind(self, kind: int, places: Places) -> None:
        if self._shared:
            self.kinds, self._shared = self.kinds.copy(), False
        self.kinds[places] = kind

    def keep(self, word: ColumnWord, rows: Places, places: Places) -> None:
        """Copy some rows of a word."""
        self.kinds[places] = word.kinds[rows]
        self.long = [word.long]
        for to, parameter in zip(self.parameters, word.parameters, strict=True):
            to.numbers[places] = parameter.numbers[rows]
            if parameter.denominators is not None:
                self._denominators(to)[places] = parameter.denominators[rows]
                to.bits = parameter.bits

    @staticmethod
    def _denominators(to: Parameter) -> Array:
        if to.denominators is None:
            to.denominators = np.zeros(len(to.numbers), dtype=np.int64)
        return to.denominators

    def target(self, places: Places, parameter: int) -> Array | None:
        """Where doubles may be written directly."""
        to = self.parameters[parameter]
        return to.numbers[places] if isinstance(places, slice) and to.denominators is None else None

    def write(self, column: Column, places: Places, parameter: int, target: Array | None = None) -> None:
        """Write a column into some places of a parameter."""
        to = self.parameters[parameter]
        if isinstance(column, ExactColumn):
            self._write_exact(column, places, parameter)
        elif isinstance(column, Mixed):
            rows = _numbered(places)
            floats = np.array([isinstance(number, float) for number in column.numbers], dtype=bool)
            for some in filter(len, (np.flatnonzero(floats), np.flatnonzero(~floats))):
                self.write(column_of([column.numbers[row] for row in some.tolist()]), rows[some], parameter)
        else:
            if column is not target:  # else it is the result of an operation, which would have failed
                if not np.isfinite(column).all():
                    raise OverflowError
                to.numbers[places] = column
            if to.denominators is not None:
                to.denominators[places] = 0

    def _write_exact(self, column: ExactColumn, places: Places, parameter: int) -> None:
        to = self.parameters[parameter]
        most = EXACT_BITS if isinstance(column.denominators, int) else REDUCED_BITS  # over one denominator they stay short
        if max(column.bits) > most:
            column = column.reduced()
        if max(column.bits) <= SHORT_BITS:
            to.numbers.view(np.int64)[places] = column.numerators
            self._denominators(to)[places] = column.denominators
            to.bits = max(to.bits[0], column.bits[0]), max(to.bits[1], column.bits[1])
            return
        rows = _numbered(places)
        above, below = (
            np.array(np.broadcast_to(part, len(rows)), dtype=object) for part in (column.numerators, column.denominators)
        )
        if max(column.bits) <= most:
            self._write_long(above, below, column.bits, rows, parameter)
            return
        bits = np.array([max(a.bit_length(), b.bit_length()) for a, b in zip(above.tolist(), below.tolist(), strict=True)])
        short, long = np.flatnonzero(bits <= SHORT_BITS), np.flatnonzero((bits > SHORT_BITS) & (bits <= EXACT_BITS))
        if len(short):
            small = ExactColumn(above[short].astype(np.int64), below[short].astype(np.int64), (SHORT_BITS, SHORT_BITS))
            self._write_exact(small, rows[short], parameter)
        self._write_long(above[long], below[long], (EXACT_BITS, EXACT_BITS), rows[long], parameter)
        if len(outgrown := np.flatnonzero(bits > EXACT_BITS)):
            self.outgrown.append(rows[outgrown])
            floats = [a / b for a, b in zip(above[outgrown].tolist(), below[outgrown].tolist(), strict=True)]
            self.write(np.array(floats), rows[outgrown], parameter)

    def _write_long(self, above: Array, below: Array, bits: tuple[int, int], rows: Array, parameter: int) -> None:
        to = self.parameters[parameter]
        to.numbers.view(np.int64)[rows] = sum(len(part[0]) for part in self.long) + np.arange(len(rows))
        self._denominators(to)[rows] = -1
        self.long.append((above, below, bits))

    def whole(
        self, states: States, names: Sequence[ModuleKind], before: Structure | None, bounds: Array | None = None
    ) -> ColumnWord:
        """The word, when all is written; its kinds may be those of the word before."""
        if before is None or not (self._shared or (bounds is None and np.array_equal(before.kinds, self.kinds))):
            before = Structure(self.kinds, bounds)
        for each in self.parameters:
            if each.denominators is not None and not each.denominators.any():
                each.denominators = None
        return ColumnWord(states, names, before, self.parameters, self._long_numbers())

    def _long_numbers(self) -> LongNumbers:
        """The exact values of more than 62 bits that are still there, numbered anew."""
        parts = [part for part in self.long if len(part[0])]
        if not parts:
            return NO_LONG_NUMBERS
        kept: list[Array] = []
        size = 0
        for parameter in self.parameters:
            if parameter.denominators is not None and len(rows := np.flatnonzero(parameter.denominators < 0)):
                numbers = parameter.numbers.view(np.int64)
                kept.append(numbers[rows])
                numbers[rows] = size + np.arange(len(rows))
                size += len(rows)
        if not kept:
            return NO_LONG_NUMBERS
        which = np.concatenate(kept)
        above, below = (np.concatenate(side)[which] for side in ([part[0] for part in parts], [part[1] for part in parts]))
        return above, below, (max(part[2][0] for part in parts), max(part[2][1] for part in parts))


def _numbered(places: Places) -> Array:
    """The numbers of some rows."""
    return np.arange(places.start, places.stop, places.step) if isinstance(places, slice) else places


def _sliced(rows: Array) -> Places:
    """Rows as a slice, if none is left out between the first and the last."""
    if len(rows) and rows[-1] - rows[0] + 1 == len(rows):
        return slice(int(rows[0]), int(rows[-1]) + 1)
    return rows


def _block(places: Places, block: slice) -> Places:
    """Some rows of others: a slice stays one."""
    return slice(places.start + block.start, places.start + block.stop) if isinstance(places, slice) else places[block]


def _expressions(items: Iterable[Item]) -> Iterator[Expression]:
    return (each for each in expressions_of(items) if isinstance(each, Expression))


def _unchecked(size: int, taken: int) -> None:
    """No limit."""


class ColumnarSteps:
    """The steps of a system in columns, under one seed.

    >>> from lsys_kit import read
    >>> states = States(read("axiom: A(1) B\\nA(x) : x < 3 -> A(x+1) A(x/2)"))
    >>> columns = ColumnarSteps(states)
    >>> word = columns.step(columns.word([states.modules[code] for code in states.axiom]), 1)
    >>> str(word), len(word)
    ('A(2)A(0.5)B', 3)
    """

    def __init__(self, states: States, seed: int = 0) -> None:
        self.states, self.seed, system = states, seed, states.system
        self._seeds: Array = np.empty(0, dtype=np.uint64)
        self._passing = passing_of(system)
        self._constants = dict(zip((each.name for each in system.constants), states.constants, strict=True))
        modules = [*system.axiom, *(m for rule in (*system.productions, *system.decomposition) for m in rule.modules)]
        self.kinds = list(dict.fromkeys(map(kind_of, modules)))
        self._numbers = {kind: number for number, kind in enumerate(self.kinds)}
        self._type = np.min_scalar_type(len(self.kinds))
        self.width = max((arity for _, arity in self.kinds), default=0)
        if any(len(rules) > MOST_CHOICES or symbol in OPENING | CLOSING for (symbol, _), rules in states.rules.items()):
            raise ArithmeticError  # neither brackets nor modules with very many rules are rewritten in columns
        self._rules = self._ready(states.rules, 0)
        self._decomposition = self._ready(states.decomposition, len(system.productions))
        self._roles = np.array([self._role(symbol) for symbol, _ in self.kinds], dtype=np.uint8)

    def _role(self, symbol: str) -> int:
        if symbol in OPENING or symbol in CLOSING:
            return OPENS if symbol in OPENING else CLOSES
        return PASSED if symbol in self._passing.ignored else ORDINARY

    def _ready(self, rules: Rules, first: int) -> list[list[ColumnRule]]:
        """For each kind that has rules these, made ready."""
        return [[self._rule(rule, first + rule.number) for rule in found] for found in rules.values()]

    def _rule(self, rule: Rule, number: int) -> ColumnRule:
        production = rule.production
        named = [*production.left, production.predecessor, *production.right]
        place = {len(production.left): 0}  # the module itself, then those to its left and right, the nearest first
        place |= {len(production.left) - 1 - i: 1 + i for i in range(len(production.left))}
        place |= {len(production.left) + 1 + i: 1 + len(production.left) + i for i in range(len(production.right))}
        sites, equal = dict[str, Site](), dict[str, Expression]()
        for which, module in enumerate(named):
            for parameter, argument in enumerate(module.arguments):
                name = f"#{which},{parameter}"
                if isinstance(argument, Name) and argument.name not in self._constants:
                    name = argument.name
                else:
                    equal[name] = argument
                sites[name] = place[which], parameter
        asked = [Apply("==", (Name(name), argument)) for name, argument in equal.items()]
        conditions = [*asked, *([] if production.condition is None else [production.condition])]
        test = reduce(lambda left, right: Apply("&&", (left, right)), conditions) if conditions else None
        return ColumnRule(
            rule,
            number,
            self._numbers[kind_of(production.predecessor)],
            tuple(self._numbers[kind] for kind in rule.left),
            tuple(-1 if module.symbol == END else self._numbers[kind_of(module)] for module in production.right),
            None if test is None else self._function(test, self._constants),
            _sites(sites, [part for part in (test, production.probability) if part is not None]),
            _sites(sites, _expressions(production.successor)),
            None if production.probability is None else self._function(production.probability, self._constants),
            self._parts(production.successor, self._constants),
            any(isinstance(item, Repeat) for item in production.successor),
        )

    def _function(self, expression: Expression, constants: Mapping[str, Value]) -> ColumnFunction:
        return column_function(expression, constants, self.states.arithmetic)

    def _parts(self, items: Sequence[Item], constants: Mapping[str, Value]) -> FewParts:
        found: list[Part | Repeated] = []
        for item in items:
            if isinstance(item, Repeat):
                inner = {name: value for name, value in constants.items() if name != item.index}
                plain = not any(isinstance(each, Repeat) for each in item.body)
                together = plain and not any(map(is_random, _expressions(item.body)))
                count = self._function(item.count, constants)
                found.append(Repeated(count, self._parts(item.body, inner), item.index, together))
            else:
                arguments = tuple(self._function(argument, constants) for argument in item.arguments)
                found.append(Part(self._numbers[kind_of(item)], arguments))
        return found

    def word(self, modules: Sequence[Module]) -> ColumnWord:
        """A row of modules as columns."""
        writer = Writer(len(modules), self._type, self.width)
        writer.kinds[:] = [self._numbers[kind_of(module)] for module in modules]
        for parameter in range(self.width):
            rows = [row for row, module in enumerate(modules) if len(module.arguments) > parameter]
            values = Mixed([modules[row].arguments[parameter] for row in rows])
            writer.write(values, np.array(rows, dtype=np.int64), parameter)
        return writer.whole(self.states, self.kinds, None)

    def words(self, seeds: Sequence[int]) -> ColumnWord:
        """The axiom, as often as there are seeds, the words of which are from here on side by side."""
        self._seeds = np.array([seed & MASK for seed in seeds], dtype=np.uint64)
        one = self.word([self.states.modules[code] for code in self.states.axiom])
        bounds = np.arange(len(seeds) + 1) * len(one)
        parameters = [each.repeated(len(seeds)) for each in one.parameters]
        return ColumnWord(self.states, self.kinds, Structure(np.tile(one.kinds, len(seeds)), bounds), parameters, one.long)

    def step(self, word: ColumnWord, step: int, check: Check = _unchecked) -> ColumnWord:
        """The word of a step after that of the step before; `check` is called with its size and its bytes before it is built,
        and may raise an error.

        Raises
        ------
        ArithmeticError
            A value cannot be computed in columns.
        """
        with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
            outline = self._outline(word, self._rules, step - 1)
            if not self._decomposition:
                return self._replaced(word, outline, step - 1, check)
            made = self._replaced(word, outline, step - 1, _before_decomposition(check))
            made, _ = self._decomposed(made, outline.sizes, check)
            check(len(made), made.bytes)
            return made

    def after(self, before: Word, step: int, held: int) -> ColumnWord:
        """The same after any word, within the limits, where the words of other steps take so many bytes."""
        if current().bits < 2 * SHORT_BITS:
            raise OverflowError
        word = before if isinstance(before, ColumnWord) else self.word(before)
        return self.step(word, step, partial(check_size, self.states, step, held=held))

    def origins(self, word: ColumnWord, step: int) -> Origins:
        """Where the modules of the next word come from."""
        with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
            outline = self._outline(word, self._rules, step - 1)
            sizes, productions = outline.sizes, outline.productions
            if self._decomposition:
                made = self._replaced(word, outline, step - 1, _unchecked)
                _, sizes = self._decomposed(made, sizes, _unchecked)
        parents = np.repeat(np.arange(len(word)), sizes).tolist()
        applied = np.repeat(productions, sizes).tolist()
        return Origins(parents, [None if production < 0 else production for production in applied])

    def _decomposed(self, word: ColumnWord, sizes: Array, check: Check) -> tuple[ColumnWord, Array]:
        """A word whose modules are decomposed, until nothing is left to replace or the depth is reached; and how many modules
        stand then for so many that stood there in a row before."""
        asked, most = self.states.system.decomposition_depth, current().decomposition
        for depth in counted(range(most + 1 if asked is None else asked), 1):
            outline = self._outline(word, self._decomposition, 0)
            if not outline.applied:
                break
            if depth == most and asked is None:
                raise OverflowError
            ends, behind = np.cumsum(sizes), np.append(0, np.cumsum(outline.sizes))
            sizes = behind[ends] - behind[ends - sizes]
            word = self._replaced(word, outline, 0, _before_decomposition(check))
        return word, sizes

    def _outline(self, word: ColumnWord, rules: Sequence[Sequence[ColumnRule]], step: int) -> Outline:
        structure = word.structure
        if structure.outline is not None and structure.outline.rules is rules:
            return structure.outline
        applied = [each for found in rules for each in self._applied(found, word, step) if each.size]
        outline = Outline(rules, len(word), applied, [self._expanded(each, word, step) for each in applied])
        if not any(rule.test or rule.weight or rule.repeats for found in rules for rule in found):
            structure.outline = outline
        return outline

    def _replaced(self, word: ColumnWord, outline: Outline, step: int, check: Check) -> ColumnWord:
        """A word in which all modules are replaced once."""
        check(outline.size, outline.size * (word.kinds.itemsize + self.width * BYTES_OF_A_VALUE))
        writer = outline.writer(word)
        for each, expanded in zip(outline.applied, outline.expanded, strict=True):
            if expanded is None:
                for low in counted(range(0, each.size, BLOCK_ROWS), 1):
                    self._write(writer, each, slice(low, min(low + BLOCK_ROWS, each.size)), word, outline, step)
            else:
                assert outline.starts is not None
                starts = outline.starts[each.places[0]]
                for piece in expanded[1]:
                    _write_module(writer, starts[piece.rows] + piece.behind, piece.kind, piece.values)
        bounds = word.structure.bounds
        made = writer.whole(self.states, self.kinds, word.structure, None if bounds is None else outline.bounds(bounds))
        if writer.outgrown and self.states.inexact is None:
            self.states.inexact = made[int(min(map(np.min, writer.outgrown)))]
        return made

    def _write(self, writer: Writer, each: Applied, block: slice, word: ColumnWord, outline: Outline, step: int) -> None:
        """Write what a rule makes of a block of the modules that it rewrites."""
        own = _block(each.places[0], block)
        for which, rows in self._named(each, each.rule.used, block, word, step):
            some = own if which is None else _numbered(own)[which]
            places = [outline.place(some, number) for number in range(len(each.rule.parts))]

            def write(rows: Rows, some: Places = some, places: Sequence[Places] = places) -> None:
                for part, at in zip(each.rule.parts, places, strict=True):
                    assert isinstance(part, Part)
                    if not (outline.in_place and part.kind == each.rule.kind):
                        writer.write_kind(part.kind, at)
                    for parameter, argument in enumerate(part.arguments):
                        rows.out = target = writer.target(at, parameter)
                        writer.write(argument(rows), at, parameter, target)
                        rows.out = None

            rows.computed(write)

    def _named(
        self, each: Applied, sites: Mapping[str, Site], block: slice, word: ColumnWord, step: int
    ) -> Iterator[tuple[Array | None, Rows]]:
        """The columns of the names that a rule uses, for a block of its modules; where their values are of several forms, for
        those apart that are alike."""
        size = block.stop - block.start
        drawn = each.drawn if isinstance(each.drawn, int) else each.drawn[block]
        draws = self._draws(word, _numbered(_block(each.places[0], block)), step) if each.rule.rule.random else None
        columns: dict[str, Column] = {}
        read: dict[str, Parameter] = {}
        forms: Any = 0
        for name, (place, number) in sites.items():
            parameter, rows = word.parameters[number], each.places[place]
            if size != each.size:
                rows = _block(rows, block)
            if parameter.denominators is None:
                columns[name] = parameter.numbers[rows]
            else:
                read[name] = found = parameter.some(rows)
                forms = forms * 3 + np.sign(cast("Array", found.denominators)) + 1
        if isinstance(forms, int) or (forms == forms[0]).all():
            columns |= {name: found.column(word.long) for name, found in read.items()}
            yield None, Rows(columns, size, draws, drawn)
            return
        for form in np.unique(forms).tolist():
            which = np.flatnonzero(forms == form)
            ours_only = {name: taken(column, which) for name, column in columns.items()}
            ours_only |= {name: found.some(which).column(word.long) for name, found in read.items()}
            before = drawn if isinstance(drawn, int) else drawn[which]
            yield which, Rows(ours_only, len(which), draws and draws.some(which), before)

    def _draws(self, word: ColumnWord, rows: Array, step: int) -> Draws:
        """What some modules draw random numbers by."""
        bounds = word.structure.bounds
        if bounds is None:
            return Draws(self.seed, step, rows)
        run = word.structure.runs(rows)
        return Draws(self._seeds[run], step, rows - bounds[run])

    def _candidates(self, rule: ColumnRule, structure: Structure) -> tuple[Places, ...]:
        """The places of the modules that a rule names, where they are of the right kinds."""
        if rule.number not in structure.candidates:
            there = structure.kinds == rule.kind
            rows = slice(0, len(there)) if there.all() else _sliced(np.flatnonzero(there))
            found = self._found(rule, structure, _numbered(rows)) if rule.left or rule.right else [rows]
            structure.candidates[rule.number] = tuple(found)
        return structure.candidates[rule.number]

    def _found(self, rule: ColumnRule, structure: Structure, rows: Array) -> list[Places]:
        """Those of some modules whose contexts are there, and these."""
        kinds, found = structure.kinds, [rows]
        if structure.around is None:
            places = np.arange(len(kinds))
            sides = context_neighbours(places, self._roles[kinds], NO_NEIGHBOUR, self._passing.flat)
            structure.around = sides if structure.bounds is None else structure.apart(sides)
        for wanted, side in ((rule.left, 0), (rule.right, 1)):
            at = 0
            for kind in wanted:
                assert structure.around is not None
                near = structure.around[side][found[at]]
                there = near == NO_NEIGHBOUR if kind < 0 else (near != NO_NEIGHBOUR) & (kinds[near] == kind)
                found = [each[there] for each in (*found, near)]
                at = len(found) - 1
        return [*map(_sliced, found)]

    def _applied(self, rules: Sequence[ColumnRule], word: ColumnWord, step: int) -> Iterator[Applied]:
        """Which of the rules of a kind rewrites which modules."""
        first = rules[0]
        if first.test is None and first.weight is None and not (first.left or first.right):
            yield Applied(first, self._candidates(first, word.structure))
            return
        size, anew = len(word), any(rule.rule.matches_anew for rule in rules)
        free, drawn = np.ones(size, dtype=bool), np.zeros(size, dtype=np.int64) if anew else 0
        noted: Array | None = None
        matched: list[tuple[int, Applied]] = []
        for number, rule in enumerate(rules):
            each = Applied(rule, self._candidates(rule, word.structure))
            if number:
                asked = free[each.places[0]]
                if noted is not None and rule.weight is None:
                    asked = asked & (noted[each.places[0]] == 0)
                each = each.some(np.flatnonzero(asked))
            if rule.test is not None and each.size:
                each = each.some(np.flatnonzero(self._tested(each, word, step, drawn)))
            if not each.size:
                continue
            if rule.weight is None:
                free[each.places[0]] = False
                yield Applied(rule, each.places, drawn if isinstance(drawn, int) else drawn[each.places[0]])
            else:
                noted = np.zeros(size, dtype=np.int64) if noted is None else noted
                noted[each.places[0]] |= 1 << number
                matched.append((number, each))
        if noted is not None:
            yield from self._chosen(matched, noted, word, step, drawn)

    def _tested(self, each: Applied, word: ColumnWord, step: int, drawn: Any) -> Array:
        """Whether the test of a rule is true, for each of the modules for which it asks."""
        assert each.rule.test is not None
        found = np.empty(each.size, dtype=bool)
        for at, some in self._valued(each, each.rule.test, word, step, drawn):
            found[at] = truths(some, found[at].size)
        return found

    def _valued(
        self, each: Applied, function: ColumnFunction, word: ColumnWord, step: int, drawn: Any
    ) -> Iterator[tuple[Places, Any]]:
        """What a function of the values that a rule's test uses comes to, for some rows after others."""
        counts = None if isinstance(drawn, int) else drawn[each.places[0]]
        each = Applied(each.rule, each.places, 0 if counts is None else counts)
        for low in counted(range(0, each.size, BLOCK_ROWS), 1):
            block = slice(low, min(low + BLOCK_ROWS, each.size))
            for which, rows in self._named(each, each.rule.tested, block, word, step):
                at = block if which is None else which + low
                yield at, rows.computed(function)
                if counts is not None:
                    counts[at] = rows.drawn
        if counts is not None:
            drawn[each.places[0]] = counts

    def _chosen(
        self, matched: Sequence[tuple[int, Applied]], noted: Array, word: ColumnWord, step: int, drawn: Any
    ) -> Iterator[Applied]:
        """Which rule chance chooses for which modules, of those that match each."""
        weights = [self._weights(each, word, step, drawn) for _, each in matched]
        rows = np.flatnonzero(noted)
        units = units_of(self._draws(word, rows, step).keys(), drawn if isinstance(drawn, int) else drawn[rows])
        patterns, choice = noted[rows], np.empty(len(word), dtype=np.int64)
        for pattern in counted(np.unique(patterns).tolist(), 1):
            ours = np.flatnonzero(patterns == pattern)
            likely = [at for at, (number, _) in enumerate(matched) if pattern >> number & 1]
            try:
                drawn_ones = self._draw([weights[at] for at in likely], rows[ours], units[ours])
            except ValueError as fault:
                raise ArithmeticError from fault
            choice[rows[ours]] = np.array(likely)[drawn_ones]
        for at, (_, each) in enumerate(matched):
            some = each.some(np.flatnonzero(choice[each.places[0]] == at))
            yield Applied(some.rule, some.places, 1 if isinstance(drawn, int) else drawn[some.places[0]] + 1)

    def _weights(self, each: Applied, word: ColumnWord, step: int, drawn: Any) -> Value | Mapping[int, Value]:
        """The weight of a rule; for each module, by its place, where it depends on that."""
        function, found = each.rule.weight, dict[int, Value]()
        assert function is not None
        own, single = each.own(), None
        for at, column in self._valued(each, function, word, step, drawn):
            if (single := single_value(column)) is None:
                places = own[at].tolist()
                found.update(zip(places, map(finite, values_of(column, len(places))), strict=True))
        return found if single is None else finite(single)

    @staticmethod
    def _draw(weights: Sequence[Value | Mapping[int, Value]], rows: Array, units: Array) -> Any:
        """For each of some modules the number of the weight that its random number chooses."""
        if not any(isinstance(weight, dict) for weight in weights):
            ends, total = stretches(weights)  # type: ignore[arg-type]
            return np.searchsorted(ends, units * total, side="right")
        return [
            choose([weight[row] if isinstance(weight, dict) else weight for weight in weights], unit)  # type: ignore[misc]
            for row, unit in zip(counted(rows.tolist()), units.tolist(), strict=True)
        ]

    def _expanded(self, each: Applied, word: ColumnWord, step: int) -> Expanded | None:
        """What a rule with repetitions makes: how much of each module, and its modules."""
        if not each.rule.repeats:
            return None
        sizes, pieces = np.zeros(each.size, dtype=np.int64), list[Piece]()
        for which, rows in self._named(each, each.rule.used, slice(0, each.size), word, step):
            which = np.arange(each.size) if which is None else which

            def expand(rows: Rows, which: Array = which) -> tuple[Array, list[Piece]]:
                behind, made = np.zeros(len(which), dtype=np.int64), list[Piece]()
                _expand(each.rule.parts, rows, which, behind, made)
                return behind, made

            sizes[which], made = rows.computed(expand)
            pieces += made
        return sizes, pieces


def _before_decomposition(check: Check) -> Check:
    """A check of words that are to be decomposed: their sizes mean nothing, and no error is to name them."""

    def stop(size: int, taken: int) -> None:
        try:
            check(size, taken)
        except ModelLimitError:
            raise OverflowError from None

    return stop


def _write_module(writer: Writer, places: Array, kind: int, values: Sequence[Column]) -> None:
    writer.write_kind(kind, places)
    for parameter, column in enumerate(values):
        writer.write(column, places, parameter)


def _expand(parts: FewParts, rows: Rows, which: Array, behind: Array, made: list[Piece]) -> None:
    """Add the modules that parts of a successor become, behind so many for each row, which are counted on."""
    most = current()
    for part in counted(parts, 1):
        if isinstance(part, Part):
            made.append(Piece(which, behind.copy(), part.kind, [argument(rows) for argument in part.arguments]))
            behind += 1
            continue
        counts = _counts(part.count(rows), rows.size)
        size = int(behind.sum() + counts.sum() * len(part.body))
        if size > most.modules or size * BYTES_OF_A_VALUE > most.bytes:
            raise OverflowError
        if part.together:
            again = np.repeat(np.arange(rows.size), counts)
            index = np.arange(len(again)) - np.repeat(np.cumsum(counts) - counts, counts)
            before = behind[again] + index * len(part.body)
            named = {part.index: _whole(index)} if part.index else {}
            _expand(part.body, rows.some(again, **named), which[again], before, made)
            behind += counts * len(part.body)
        else:
            for number in counted(range(int(counts.max(initial=0))), 1):
                there = np.flatnonzero(counts > number)
                named = {part.index: _whole(np.full(len(there), number))} if part.index else {}
                some, before = rows.some(there, **named), behind[there]
                _expand(part.body, some, which[there], before, made)
                rows.draw_as(some, there)
                behind[there] = before


def _whole(numbers: Array) -> ExactColumn:
    return ExactColumn(numbers, 1, (INDEX_BITS, 1))


def _counts(column: Column, size: int) -> Array:
    """How often something is repeated; an `ArithmeticError`, where that is no whole number or too large."""
    if isinstance(column, ExactColumn) and not column.wide:
        column = column.reduced()
        if not np.all(np.equal(column.denominators, 1)):
            raise ArithmeticError
        found = np.broadcast_to(column.numerators, size)
    else:
        found = np.array([float(value) for value in values_of(column, size)])
    if len(found) and (found.min() < 0 or found.max() > current().repetitions or (found != np.floor(found)).any()):
        raise ArithmeticError
    return found.astype(np.int64)


def _sites(sites: Mapping[str, Site], expressions: Iterable[Expression]) -> dict[str, Site]:
    """Where the values are found of the names that some expressions use."""
    used = frozenset[str]().union(*map(names_in, expressions))
    return {name: site for name, site in sites.items() if name in used}
