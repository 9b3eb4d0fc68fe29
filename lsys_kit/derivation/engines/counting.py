"""Counting: the engine of D0L systems, in which a module alone decides what becomes of it.

How often each state occurs in a word follows from how often each occurs in the word before. So the size of every step is
known before a word is built, and the word of any step is built without those between.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property, partial
from itertools import chain
from operator import attrgetter

from lsys_kit.budget import INTERVAL, Task, check_budget, counted
from lsys_kit.cache import Cache
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Codes, Word, state_counts
from lsys_kit.derivation.engines import engine
from lsys_kit.derivation.engines.columnar import ColumnarSteps, ColumnWord
from lsys_kit.derivation.engines.engine import ByteTable, Origins, check_size, check_step, compact, expand

FEWEST_NEW = 50
"""Words become columns after a step in which more new states than this are met, and they are no small part of its word."""
SMALL_PART = 1 / 8
"""A new state takes about eight times as long in the table as a module of columns takes to be numbered afterwards."""


class CountingEngine:
    """The derivation of a D0L system, in columns from where on many modules are different, if it is `columnar`."""

    def __init__(self, states: States, columnar: bool) -> None:
        self.states = states
        self._steps: list[tuple[dict[int, int], int]] = [(Counter(states.axiom), len(states.axiom))]
        self._words = Cache[int, Word](attrgetter("bytes"))
        self._bytes = ByteTable(states)
        self._columnar = columnar
        self._new = 0  # so many states were met first at the last step
        self._late: list[Word] = []
        self._late_bytes = 0

    def __getstate__(self) -> dict[str, object]:
        """All but the functions for columns, which are made again; words in columns number their states before that."""
        for word in self._late:
            word.numbers()
        return {name: value for name, value in vars(self).items() if name != "_columns"}

    @property
    def known(self) -> int:
        return len(self._steps) + len(self._late) - 1

    def size(self, step: int) -> int:
        return self._steps[step][1] if step < len(self._steps) else len(self.word(step))

    def counts(self, step: int) -> Counter[int]:
        return Counter(self._steps[step][0]) if step < len(self._steps) else state_counts(self.word(step))

    def advance(self) -> None:
        step, (before, _) = self.known + 1, self._steps[-1]
        if self._late or (self._columnar and self._many_new()):
            self._late.append(self._next_word(step))
            self._late_bytes += self._late[-1].bytes
            return
        met = len(self.states)
        if len(self.states.successors) < met:  # some successors must be computed: not for a step that is refused
            check_size(self.states, step, sum(count * self.states.width(state) for state, count in before.items()))
        after = next_counts(self.states, before, partial(check_step, self.states, step))
        check_budget()
        size = sum(after.values())
        check_size(self.states, step, size)
        self._new = len(self.states) - met
        self._steps.append((after, size))

    def _many_new(self) -> bool:
        """Whether many modules of the last word were met for the first time in it.

        They are not most of it where the turtle turns at each of them: brackets and turns are the same, or stay.
        """
        return self._new > FEWEST_NEW and self._new > SMALL_PART * self._steps[-1][1]

    @cached_property
    def _columns(self) -> ColumnarSteps:
        return ColumnarSteps(self.states)

    def _next_word(self, step: int) -> Word:
        before, columns = self.word(step - 1), self._columns
        check_step(self.states, step)
        try:
            return columns.step(
                before if isinstance(before, ColumnWord) else columns.word(before),
                partial(check_size, self.states, step, held=self._late_bytes),
            )
        except ArithmeticError:
            return self._from_table(before.numbers(), step)

    def _from_table(self, before: Sequence[int], step: int) -> Word:
        found: list[int] = []
        for number, state in enumerate(before):
            found += self.states.successors[state]
            if number % INTERVAL == 0:
                check_step(self.states, step, len(found))
        check_size(self.states, step, len(found), held=self._late_bytes)
        return Word(self.states, compact(found, len(self.states)))

    def word(self, step: int) -> Word:
        if step >= len(self._steps):
            return self._late[step - len(self._steps)]
        return self._words.found(step, lambda: self._built(step))

    def _built(self, step: int) -> Word:
        if step == 0:
            return Word(self.states, list(self.states.axiom))
        before, small = self._words.get(step - 1), self.size(step) <= engine.MOST_LISTED
        if small and before is not None:
            return Word(self.states, self._replaced(before, self._steps[step - 1][0]))
        with Task("The word was not built"):
            array = expand(self.states, [counts for counts, _ in self._steps[: step + 1]])
        return Word(self.states, array.tolist() if small else array)

    def _replaced(self, word: Word, present: dict[int, int]) -> Codes:
        """The successor of a short word, given the states that occur in it."""
        successors, table = self.states.successors, self._bytes
        if present.keys() <= table.known or all(table.add(state, successors[state]) for state in present):
            return table.replaced(bytes(word.codes))
        return list(chain.from_iterable(map(successors.__getitem__, word.codes)))

    def origins(self, step: int) -> Origins:
        parents: list[int] = []
        productions: list[int | None] = []
        for position, state in enumerate(counted(self.word(step - 1).numbers())):
            made = len(self.states.successor(state))
            parents += [position] * made
            productions += [self.states.production(state)] * made
        return Origins(parents, productions)

    def sight(self, _: int) -> None:
        """Nothing: the modules of a D0L system ask for nothing."""


def next_counts(states: States, counts: Mapping[int, int], check: Callable[[], None] = check_budget) -> dict[int, int]:
    """How often each state occurs one step later; `check` is called now and then, and may raise an error."""
    after: dict[int, int] = {}
    already, successors = after.get, states.successors
    for number, (state, count) in enumerate(counts.items(), 1):
        row = successors[state]
        for successor in row:
            after[successor] = already(successor, 0) + count
        if number % INTERVAL == 0 or len(row) > INTERVAL:
            check()
    return after
