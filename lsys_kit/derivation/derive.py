"""Deriving: from the axiom to the word of any step.

Before a word is built its size is known exactly: how often each state occurs in it follows from how often each occurs in
the word before, as a sum of whole numbers. The word of step n is then built without the words between.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import overload

import numpy as np

from lsys_kit.budget import current
from lsys_kit.derivation.expand import code_type, expanded
from lsys_kit.derivation.states import States
from lsys_kit.derivation.words import Word
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.model import LSystem

PLAIN = 4_096
"""Words up to this length are lists, which are quicker than arrays at that size."""
STATE_BYTES = 600
"""About what one state takes in the table."""
OFTEN = 1_024
"""After how many states somebody looks at the clock."""


def derive(system: LSystem, steps: int, *, arithmetic: str = "exact", **constants: object) -> Derivation:
    """Derive a system: the words of steps 0 to `steps`.

    Parameters
    ----------
    system
        Any L-system.
    steps
        How many steps.
    arithmetic
        "exact", or "float" to compute in doubles as cpfg and L-Py do.
    **constants
        New values for declared constants: numbers, or texts such as "14/10".

    Returns
    -------
    Derivation
        A sequence of `steps + 1` words. A word is built when it is first asked for, `[-1]` without those between.

    Raises
    ------
    ModelLimitError
        A step would be too large; the error has the step, the size and, in `partial`, the derivation of the steps that fit.
    ModelValueError
        A value cannot be computed; the error names the module and the production.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> fibonacci = read("axiom: a\\na -> ab\\nb -> a")
    >>> [str(word) for word in derive(fibonacci, 3)]
    ['a', 'a b', 'a b a', 'a b a a b']
    >>> derive(fibonacci, 30).lengths[-1]
    2178309
    """
    return Derivation(States(system, constants, arithmetic)).to(steps)


class Derivation(Sequence[Word]):
    """The words of a derivation, each built when it is first asked for and then kept.

    Attributes
    ----------
    states
        The table of the states met.
    steps
        The last step.
    """

    def __init__(self, states: States, steps: int = 0, shared: Derivation | None = None) -> None:
        self.states, self.steps = states, steps
        self._counts: list[Counter[int]] = shared._counts if shared else [Counter(states.axiom)]
        self._words: dict[int, Word] = shared._words if shared else {}

    def to(self, steps: int) -> Derivation:
        """The same derivation up to another step; what is known already is not computed again.

        Raises
        ------
        ModelLimitError
            A step would be too large.
        """
        if isinstance(steps, bool) or not isinstance(steps, int | np.integer) or steps < 0:
            raise ModelValueError(f"The number of steps must be a whole number from 0 on, not {steps!r}")
        for step, counts in enumerate(self._counts[:int(steps) + 1]):
            self._check(step, counts.total())
        until = time.monotonic() + current().seconds
        while len(self._counts) <= steps:
            step, before = len(self._counts), self._counts[-1]
            self._check(step, sum(count * self.states.width(state) for state, count in before.items()))
            self._counts.append(counted(self.states, before, partial(self._watch, step, until)))
        return Derivation(self.states, int(steps), self)

    def _check(self, step: int, size: int) -> None:
        """Refuse a step whose word would be past a limit, before it is built."""
        limit = current().modules
        if size > limit:
            raise self._refusal(f"Step {step} would have {_grouped(size)} modules; the limit is {_grouped(limit)}",
                                step, limit, size, "modules")
        self._check_bytes(step, size * code_type(len(self.states)).itemsize)

    def _check_bytes(self, step: int, word: int) -> None:
        needed, limit = word + len(self.states) * STATE_BYTES, current().bytes
        if needed > limit:
            raise self._refusal(f"Step {step} would take {_grouped(needed)} bytes; the limit is {_grouped(limit)}", step, limit,
                                needed, "bytes")

    def _watch(self, step: int, until: float) -> None:
        """Refuse a step while it is counted, because it meets too many different modules."""
        self._check_bytes(step, 0)
        if time.monotonic() > until:
            seconds = current().seconds
            raise self._refusal(f"Step {step} was not reached in {seconds:g} seconds", step, seconds, None, "seconds")

    def _refusal(self, message: str, step: int, limit: float, needed: int | None, name: str) -> ModelLimitError:
        kept = Derivation(self.states, step - 1, self) if step else None
        which = f"Steps 0-{step - 1} are kept. " if step > 1 else "Step 0 is kept. " if step else ""
        return ModelLimitError(message, limit=limit, needed=needed, partial=kept,
                               hint=f"{which}Take fewer steps, or set limits({name}=...).")

    def __len__(self) -> int:
        return self.steps + 1

    @overload
    def __getitem__(self, index: int) -> Word: ...
    @overload
    def __getitem__(self, index: slice) -> list[Word]: ...
    def __getitem__(self, index: int | slice) -> Word | list[Word]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        step = index + len(self) if index < 0 else index
        if not 0 <= step <= self.steps:
            raise IndexError(f"step {index} of a derivation of {self.steps} steps")
        if step not in self._words:
            self._words[step] = self._built(step)
        return self._words[step]

    def __iter__(self) -> Iterator[Word]:
        return (self[step] for step in range(len(self)))

    def __repr__(self) -> str:
        return self.column()

    @property
    def lengths(self) -> list[int]:
        """The number of modules at each step, known without building a word."""
        return [counts.total() for counts in self._counts[:len(self)]]

    @property
    def notes(self) -> tuple[str, ...]:
        """What is worth telling: names that were read as several symbols, values that are no longer exact.

        >>> from lsys_kit.notation.read import read
        >>> derive(read("axiom: F(0)\\nF(x) -> F(x^2 + 0.1)"), 8).notes
        ('From step 7 on values outgrow 128 bits and are doubles, such as F(0.11270011762177155).',)
        """
        notes, inexact = self.states.system.notes, self.states.inexact
        for step, counts in enumerate(self._counts[:len(self)] if inexact else ()):
            if any(self.states.modules[state] == inexact for state in counts):
                return (*notes, f"From step {step} on values outgrow 128 bits and are doubles, such as {inexact}.")
        return notes

    def counts(self, step: int) -> Counter[int]:
        """How often each state occurs at a step, known without building its word."""
        return self._counts[step]

    def column(self, centred: bool = False, coding: Mapping[str, str] | None = None) -> Column:
        """The words below one another, as in seed 000's `ColumnForm`.

        Parameters
        ----------
        centred
            Whether each word stands in the middle.
        coding
            For some modules what is written in their place (see `Word.coded`).

        Examples
        --------
        >>> from lsys_kit.notation.read import read
        >>> derive(read("axiom: a\\na -> ab\\nb -> a"), 3).column(centred=True)
        0     a
        1    a b
        2   a b a
        3 a b a a b
        """
        texts = [word.coded(coding) if coding else repr(word) for word in self]
        width = max(map(len, texts)) if centred else 0
        digits = len(str(self.steps))
        return Column("\n".join(f"{step:>{digits}} {text.center(width)}".rstrip() for step, text in enumerate(texts)))

    def _built(self, step: int) -> Word:
        size = self._counts[step].total()
        before = self._words.get(step - 1)
        if step == 0:
            return Word(self.states, list(self.states.axiom))
        if size <= PLAIN and before is not None:
            return Word(self.states, [code for state in before.codes for code in self.states.successor(state)])
        array = expanded(self.states, self._counts[:step + 1])
        return Word(self.states, array.tolist() if size <= PLAIN else array)


class Column(str):
    """Lines of text that a notebook shows as they are."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def counted(states: States, counts: Counter[int], watch: Callable[[], None] = lambda: None) -> Counter[int]:
    """How often each state occurs one step later; `watch` is called now and then, and may raise an error."""
    after: Counter[int] = Counter()
    for number, (state, count) in enumerate(counts.items(), 1):
        for successor in states.successor(state):
            after[successor] += count
        if number % OFTEN == 0:
            watch()
    watch()
    return after


def lengths(system: LSystem, steps: int, *, arithmetic: str = "exact", **constants: object) -> Iterator[int]:
    """The number of modules at steps 0 to `steps`, however large: no word is built.

    >>> from lsys_kit.notation.read import read
    >>> len(str(list(lengths(read("axiom: a\\na -> ab\\nb -> a"), 10_000))[-1]))
    2090

    Raises
    ------
    ModelLimitError
        Counting takes too long, because there are too many different modules.
    """
    states = States(system, constants, arithmetic)
    counts, left = Counter(states.axiom), current().seconds
    for step in range(steps + 1):
        started = time.monotonic()
        counts = counted(states, counts, partial(_check_time, step, started + left)) if step else counts
        left -= time.monotonic() - started  # the time between two steps is the asker's
        yield counts.total()


def _check_time(step: int, until: float) -> None:
    seconds = current().seconds
    if time.monotonic() > until:
        raise ModelLimitError(f"Step {step} was not counted in {seconds:g} seconds", limit=seconds,
                              hint="Take fewer steps, or set limits(seconds=...).")


def _grouped(number: float) -> str:
    """A number with its digits in groups of three; a very long one by its number of digits."""
    text = f"{number:,}"
    return text if len(text) <= 40 else f"about 10^{len(str(int(number))) - 1}"
