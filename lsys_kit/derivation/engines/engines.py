"""The two ways in which a derivation runs its course, behind one door.

Where every module's fate depends on itself alone, the course counts: the size of every step is known before a word is built,
and the word of any step is built without those between. Where neighbours or chance have a say, it goes step by step. Where
rules ask for what the turtle sees, somebody looks at the word before each step: who that is, is not known here.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain
from typing import Any, Protocol, TypeAlias

import numpy as np

from lsys_kit.budget import current
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word, state_counts
from lsys_kit.derivation.engines.columnar import ColumnarSteps, ColumnWord
from lsys_kit.derivation.engines.columnar import possible as columns_possible
from lsys_kit.derivation.engines.contexts import ContextEngine, possible
from lsys_kit.derivation.engines.expansion import Letters, code_type, expand
from lsys_kit.derivation.engines.meta import apply_meta_rules
from lsys_kit.derivation.engines.stepwise import SensingFunction, Stepper
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model.arithmetic import Value

MOST_LISTED = 4_096
"""Words up to this length are lists, which are quicker than arrays at that size."""
BULK = 64
"""Words from this length on are stepped in bulk, where that is possible."""
DIFFERENT = 50
"""From so many different modules on a word may become columns, if they are most of it."""
STATE_BYTES = 600
"""About what one state takes in the table."""
OFTEN = 1_024
"""After how many states or modules somebody looks at the clock."""


class Observation(Protocol):
    """What is seen of a word."""

    @property
    def word(self) -> Word:
        """The word, with the values of its query modules filled in."""

    def sees(self, position: int, function: Value, *values: Value) -> Value:
        """What a sensitive function answers to the module at a position."""


Observer: TypeAlias = Callable[[Word, Callable[[], None]], Observation]
"""What looks at a word before a step; it is also given what looks at the clock now and then, and may raise an error."""


@dataclass(frozen=True)
class Origins:
    """Where the modules of a word come from.

    Attributes
    ----------
    parents
        For each module the position, in the word before, of the module that it comes from.
    productions
        For each module the place of the production that made it, or None where the module stayed as it was.
    """

    parents: Sequence[int]
    productions: Sequence[int | None]


class CountingEngine:
    """The course of a system in which every module's fate depends on itself alone."""

    def __init__(self, states: States) -> None:
        self.states = states
        self._steps: list[tuple[dict[int, int], int]] = [(Counter(states.axiom), len(states.axiom))]
        self._words: dict[int, Word] = {}
        self._letters = Letters(states)
        self._columns = ColumnarSteps(states) if columns_possible(states) else None
        self._late: list[ColumnWord] = []

    @property
    def known(self) -> int:
        """The last step whose size is known."""
        return len(self._steps) + len(self._late) - 1

    def size(self, step: int) -> int:
        """How many modules a known step has."""
        return self._steps[step][1] if step < len(self._steps) else len(self.word(step))

    def counts(self, step: int) -> Counter[int]:
        """How often each state occurs at a known step."""
        return Counter(self._steps[step][0]) if step < len(self._steps) else state_counts(self.word(step))

    def advance(self, until: float) -> None:
        """Make one step more known."""
        step, (before, size) = self.known + 1, self._steps[-1]
        if self._columns and (self._late or (len(before) > DIFFERENT and 2 * len(before) > size)):
            self._late.append(self._in_columns(self._columns, step, until))
            return
        if len(self.states.successors) < len(self.states):  # some have to be made: not for a step that is refused
            check_size(self.states, step, sum(count * self.states.width(state) for state, count in before.items()))
        after = next_counts(self.states, before, partial(check_time, self.states, step, until))
        check_time(self.states, step, until)
        size = sum(after.values())
        check_size(self.states, step, size)
        self._steps.append((after, size))

    def _in_columns(self, columns: ColumnarSteps, step: int, until: float) -> ColumnWord:
        """The next word, where nearly all modules are different."""
        before = self._late[-1] if self._late else columns.word(list(self.word(step - 1)))
        check_time(self.states, step, until)
        return columns.step(before, lambda size: check_size(self.states, step, size, columns.bytes(size)))

    def word(self, step: int) -> Word:
        """The word of a known step."""
        if step >= len(self._steps):
            return self._late[step - len(self._steps)]
        if step not in self._words:
            self._words[step] = self._built(step)
        return self._words[step]

    def _built(self, step: int) -> Word:
        if step == 0:
            return Word(self.states, list(self.states.axiom))
        before, small = self._words.get(step - 1), self.size(step) <= MOST_LISTED
        if small and before is not None:
            return Word(self.states, self._replaced(before, self._steps[step - 1][0]))
        array = expand(self.states, [counts for counts, _ in self._steps[:step + 1]])
        return Word(self.states, array.tolist() if small else array)

    def _replaced(self, word: Word, present: dict[int, int]) -> Sequence[int] | np.ndarray[Any, Any]:
        """What becomes of a short word, given the states that occur in it."""
        successors, letters = self.states.successors, self._letters
        if present.keys() <= letters.known or all(letters.learnt(state, successors[state]) for state in present):
            return letters.replaced(bytes(word.codes))
        return list(chain.from_iterable(map(successors.__getitem__, word.codes)))

    def origins(self, step: int) -> Origins:
        """Where the modules of a step's word come from."""
        parents: list[int] = []
        productions: list[int | None] = []
        for position, state in enumerate(self.word(step - 1).numbers()):
            made = len(self.states.successor(state))
            parents += [position] * made
            productions += [self.states.production(state)] * made
        return Origins(parents, productions)

    def sight(self, _: int) -> None:
        """Nobody looks at words whose modules ask for nothing."""


class SteppingEngine:
    """The course of a system in which neighbours or chance have a say."""

    def __init__(self, states: States, seed: int, world: Observer | None = None) -> None:
        self.states, self._world = states, world
        self._stepper = Stepper(states, seed)
        self._bulk = ContextEngine(self._stepper) if possible(self._stepper) else None
        self._steps: list[tuple[Word, Callable[[], Origins]]] = [(Word(states, list(states.axiom)), lambda: Origins((), ()))]

    @property
    def known(self) -> int:
        """The last step whose word is known."""
        return len(self._steps) - 1

    def size(self, step: int) -> int:
        """How many modules a known step has."""
        return len(self._steps[step][0])

    def counts(self, step: int) -> Counter[int]:
        """How often each state occurs at a known step."""
        return state_counts(self._steps[step][0])

    def advance(self, until: float) -> None:
        """Make one step more known: nothing is kept of it before it is finished."""
        step, before, sees = self.known + 1, self._steps[-1][0], None
        if self._world:
            sight = self._world(before, partial(check_time, self.states, step, until))
            before, sees = sight.word, sight.sees
        if self._bulk and len(before) > BULK:
            made = self._in_bulk(self._bulk, before, step)
        else:
            made = self._one_by_one(before.numbers(), step, until, sees)
        check_time(self.states, step, until)
        self._steps.append(made)

    def _in_bulk(self, bulk: ContextEngine, before: Word, step: int) -> tuple[Word, Callable[[], Origins]]:
        """The next word and its origins, all modules at once."""
        codes = np.asarray(before.codes)
        chosen = bulk.chosen(codes, step - 1)
        check_size(self.states, step, bulk.fates.size(chosen))
        word = Word(self.states, bulk.fates.replaced(chosen))

        def origins() -> Origins:
            sizes = bulk.fates.sizes()[chosen]
            productions = [replacement.production for replacement in bulk.fates.replacements]
            return Origins(np.repeat(np.arange(len(chosen)), sizes).tolist(),
                           [productions[fate] for fate in np.repeat(chosen, sizes).tolist()])

        return self._shortened(word.numbers(), origins) if self.states.system.meta else (word, origins)

    def _one_by_one(self, codes: Sequence[int], step: int, until: float,
                    sees: SensingFunction | None) -> tuple[Word, Callable[[], Origins]]:
        """The next word and its origins, module by module."""
        made = []
        size = 0
        for number, replacement in enumerate(self._stepper.replacements(codes, step - 1, sees)):
            made.append(replacement)
            size += len(replacement.states)
            if number % OFTEN == 0 or len(replacement.states) > OFTEN:
                check_time(self.states, step, until)
                check_size(self.states, step, size)
        check_size(self.states, step, size)
        word = [code for replacement in made for code in replacement.states]
        parents = [position for position, replacement in enumerate(made) for _ in replacement.states]
        productions = [replacement.production for replacement in made for _ in replacement.states]
        origins = Origins(parents, productions)
        if self.states.system.meta:
            return self._shortened(word, lambda: origins)
        return self._word(word), lambda: origins

    def _shortened(self, codes: Sequence[int], origins: Callable[[], Origins]) -> tuple[Word, Callable[[], Origins]]:
        """A word after its meta-rules, with its origins."""
        short, first = apply_meta_rules(self.states, codes)

        def after() -> Origins:
            old = origins()
            return Origins([old.parents[at] for at in first], [old.productions[at] for at in first])

        return self._word(short), after

    def _word(self, codes: Sequence[int]) -> Word:
        return Word(self.states, codes if len(codes) <= MOST_LISTED else np.array(codes, code_type(len(self.states))))

    def word(self, step: int) -> Word:
        """The word of a known step."""
        return self._steps[step][0]

    def origins(self, step: int) -> Origins:
        """Where the modules of a step's word come from."""
        return self._steps[step][1]()

    def sight(self, step: int) -> Observation | None:
        """What the next step sees of a known step's word; None where nobody looks."""
        return self._world(self.word(step), lambda: None) if self._world else None


def engine_for(states: States, seed: int, world: Observer | None = None) -> CountingEngine | SteppingEngine:
    """The course that a system's derivation takes; where it asks for what the turtle sees, in a world that answers."""
    return CountingEngine(states) if states.settled else SteppingEngine(states, seed, world if states.asks else None)


def next_counts(states: States, counts: Mapping[int, int], watch: Callable[[], None] = lambda: None) -> dict[int, int]:
    """How often each state occurs one step later; `watch` is called now and then, and may raise an error."""
    after: dict[int, int] = {}
    already, successors = after.get, states.successors
    for number, (state, count) in enumerate(counts.items(), 1):
        row = successors[state]
        for successor in row:
            after[successor] = already(successor, 0) + count
        if number % OFTEN == 0 or len(row) > OFTEN:
            watch()
    return after


def check_size(states: States, step: int, size: int, word: int | None = None) -> None:
    """Refuse a step whose word would be past a limit; it takes `word` bytes, if not those of a row of states."""
    most = current()
    if size > most.modules:
        raise ModelLimitError(f"Step {step} would have {grouped(size)} modules; the limit is {grouped(most.modules)}",
                              limit=most.modules, needed=size, hint="Take fewer steps, or set limits(modules=...).")
    needed = (size * code_type(len(states)).itemsize if word is None else word) + len(states) * STATE_BYTES
    if needed > most.bytes:
        raise ModelLimitError(f"Step {step} would take {grouped(needed)} bytes; the limit is {grouped(most.bytes)}",
                              limit=most.bytes, needed=needed, hint="Take fewer steps, or set limits(bytes=...).")


def check_time(states: States, step: int, until: float) -> None:
    """Refuse a step that takes too long, or meets too many different modules."""
    if len(states) > OFTEN:
        check_size(states, step, 0)
    if time.monotonic() > until:
        seconds = current().seconds
        raise ModelLimitError(f"Step {step} was not reached in {seconds:g} seconds", limit=seconds,
                              hint="Take fewer steps, or set limits(seconds=...).")


def grouped(number: float) -> str:
    """A number with its digits in groups of three; a very long one by its number of digits."""
    text = f"{number:,}"
    return text if len(text) <= 40 else f"about 10^{len(str(int(number))) - 1}"
