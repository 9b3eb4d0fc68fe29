"""Counting: the engine of D0L systems, in which a module alone decides what becomes of it.

How often each state occurs in a word follows from how often each occurs in the word before. So the size of every step is
known before a word is built, and the word of any step is built without those between.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import cached_property, partial
from itertools import chain
from operator import attrgetter

from lsys_kit.budget import INTERVAL, Task, check_budget, counted
from lsys_kit.cache import Cache
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Codes, Word, state_counts
from lsys_kit.derivation.engines import engine
from lsys_kit.derivation.engines.columnar import ColumnarSteps, ColumnWord
from lsys_kit.derivation.engines.engine import ByteTable, Origins, check_size, check_step, compact, expand, many_new
from lsys_kit.derivation.engines.kept import KeptSteps


class CountingEngine:
    """The derivation of a D0L system, in columns from where on many modules are different, if it is `columnar`."""

    def __init__(self, states: States, columnar: bool) -> None:
        self.states = states
        self._steps: list[tuple[dict[int, int], int]] = [(Counter(states.axiom), len(states.axiom))]
        self._words = Cache[int, Word](attrgetter("bytes"))
        self._bytes = ByteTable(states)
        self._columnar = columnar
        self._new = 0  # so many states were met first at the last step
        self._late = KeptSteps(self._made_again)

    def __getstate__(self) -> dict[str, object]:
        """All but the functions for columns, which are made again."""
        return {name: value for name, value in vars(self).items() if name != "_columns"}

    @property
    def known(self) -> int:
        return len(self._steps) + len(self._late) - 1

    def size(self, step: int) -> int:
        return self._steps[step][1] if step < len(self._steps) else self._late[step - len(self._steps)].size

    def counts(self, step: int) -> Counter[int]:
        return Counter(self._steps[step][0]) if step < len(self._steps) else state_counts(self.word(step))

    def advance(self) -> None:
        step, (before, _) = self.known + 1, self._steps[-1]
        if self._late or (self._columnar and many_new(self._new, self._steps[-1][1])):
            self._late.add(self._next_word(self.word(step - 1), step))
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

    @cached_property
    def _columns(self) -> ColumnarSteps:
        return ColumnarSteps(self.states)

    def _made_again(self, before: Word, number: int) -> Word:
        return self._next_word(before, len(self._steps) + number)

    def _next_word(self, before: Word, step: int) -> Word:
        check_step(self.states, step)
        try:
            return self._columns.after(before, step, self._late.bytes)
        except ArithmeticError:
            return self._from_table(before.numbers(), step)

    def _from_table(self, before: Sequence[int], step: int) -> Word:
        found: list[int] = []
        for number, state in enumerate(before):
            found += self.states.successors[state]
            if number % INTERVAL == 0:
                check_step(self.states, step, len(found))
        check_size(self.states, step, len(found), held=self._late.bytes)
        return Word(self.states, compact(found, len(self.states)))

    def word(self, step: int) -> Word:
        if step >= len(self._steps):
            return self._late.word(step - len(self._steps))
        return self._words.found(step, lambda: self._built(step))

    def _built(self, step: int) -> Word:
        if step == 0:
            return Word(self.states, list(self.states.axiom))
        before, small = self._words.get(step - 1), self.size(step) <= engine.MOST_LISTED
        if small and before is not None and len(before) <= engine.MOST_LISTED:
            return Word(self.states, self._replaced(before, self._steps[step - 1][0]))
        with Task("The word was not built"):
            codes = expand(self.states, [counts for counts, _ in self._steps[: step + 1]])
        return Word(self.states, codes.tolist() if small else codes)

    def _replaced(self, word: Word, present: dict[int, int]) -> Codes:
        """The successor of a short word, given the states that occur in it."""
        successors, table = self.states.successors, self._bytes
        if present.keys() <= table.known or all(table.add(state, successors[state]) for state in present):
            return table.replaced(bytes(word.codes))
        return list(chain.from_iterable(map(successors.__getitem__, word.codes)))

    def origins(self, step: int) -> Origins:
        if isinstance(before := self.word(step - 1), ColumnWord):
            with suppress(ArithmeticError):
                return self._columns.origins(before, step)
        parents: list[int] = []
        productions: list[int | None] = []
        for position, state in enumerate(counted(before.numbers())):
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
