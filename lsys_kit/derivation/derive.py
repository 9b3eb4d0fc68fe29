"""Deriving: from the axiom to the word of any step.

Before a word is built its size is known exactly: how often each state occurs in it follows from how often each occurs in
the word before, as a sum of whole numbers. The word of step n is then built without the words between. The length of what
a state becomes in so many steps is known too, so each piece has its place in one array: what a state becomes in k steps is
written where it is first needed, and every later occurrence is a copy of that stretch.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any, overload

import numpy as np

from lsys_kit.derivation.states import States
from lsys_kit.derivation.words import Word
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.budget import current
from lsys_kit.notation.model import LSystem

PLAIN = 4_096
"""Words up to this length are lists, which are quicker than arrays at that size."""
PIECE = 64
"""Pieces up to this length are put together as tuples and written at once."""


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
        started, budget = time.monotonic(), current()
        while len(self._counts) <= steps:
            step = len(self._counts)
            counts = counted(self.states, self._counts[-1])
            self._check(step, sum(counts.values()), len(self.states))
            if time.monotonic() - started > budget.seconds:
                raise self._refusal(f"Step {step} was not reached in {budget.seconds:g} seconds", step, budget.seconds, None,
                                    "seconds")
            self._counts.append(counts)
        for step in range(int(steps) + 1):
            self._check(step, sum(self._counts[step].values()) if step else len(self.states.axiom), len(self.states))
        return Derivation(self.states, int(steps), self)

    def _check(self, step: int, size: int, states: int) -> None:
        """Refuse a step whose word would be past a limit, before it is built."""
        budget = current()
        if size > budget.modules:
            raise self._refusal(f"Step {step} would have {_grouped(size)} modules; the limit is {_grouped(budget.modules)}",
                                step, budget.modules, size, "modules")
        bytes_needed = size * code_type(states).itemsize
        if bytes_needed > budget.bytes:
            raise self._refusal(f"Step {step} would take {_grouped(bytes_needed)} bytes; the limit is "
                                f"{_grouped(budget.bytes)}", step, budget.bytes, bytes_needed, "bytes")

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
        return [sum(counts.values()) for counts in self._counts[:len(self)]]

    def counts(self, step: int) -> Counter[int]:
        """How often each state occurs at a step, known without building its word."""
        return self._counts[step]

    def column(self, centred: bool = False) -> Column:
        """The words below one another, as in seed 000's `ColumnForm`.

        >>> from lsys_kit.notation.read import read
        >>> derive(read("axiom: a\\na -> ab\\nb -> a"), 3).column(centred=True)
        0     a
        1    a b
        2   a b a
        3 a b a a b
        """
        texts = [repr(word) for word in self]
        width = max(map(len, texts)) if centred else 0
        digits = len(str(self.steps))
        return Column("\n".join(f"{step:>{digits}} {text.center(width)}".rstrip() for step, text in enumerate(texts)))

    def _built(self, step: int) -> Word:
        size = sum(self._counts[step].values())
        before = self._words.get(step - 1)
        if step == 0:
            return Word(self.states, list(self.states.axiom))
        if size <= PLAIN and before is not None:
            successor, codes = self.states.successor, []
            for state in before.codes:
                codes += successor(state)
            return Word(self.states, codes)
        array = expanded(self.states, self._counts[:step + 1])
        return Word(self.states, array.tolist() if size <= PLAIN else array)


class Column(str):
    """Lines of text that a notebook shows as they are."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def counted(states: States, counts: Counter[int]) -> Counter[int]:
    """How often each state occurs one step later."""
    after: Counter[int] = Counter()
    for state, count in counts.items():
        for successor in states.successor(state):
            after[successor] += count
    return after


def lengths(system: LSystem, steps: int, *, arithmetic: str = "exact", **constants: object) -> Iterator[int]:
    """The number of modules at steps 0 to `steps`, however large: no word is built.

    >>> from lsys_kit.notation.read import read
    >>> len(str(list(lengths(read("axiom: a\\na -> ab\\nb -> a"), 10_000))[-1]))
    2090
    """
    states = States(system, constants, arithmetic)
    counts = Counter(states.axiom)
    for step in range(steps + 1):
        counts = counted(states, counts) if step else counts
        yield sum(counts.values())


def code_type(states: int) -> np.dtype[Any]:
    """The smallest unsigned type that numbers so many states."""
    return np.min_scalar_type(max(states - 1, 0))


def expanded(states: States, present: Sequence[Counter[int]]) -> np.ndarray[Any, Any]:
    """The word of the last step, as an array of states.

    Parameters
    ----------
    states
        The table.
    present
        For each step the states that occur in its word.

    Returns
    -------
    numpy.ndarray
        The codes, of the smallest unsigned integer type that holds them.
    """
    last = len(present) - 1
    sizes = _sizes(states, present)
    pieces = _pieces(states, present, sizes)
    word = np.empty(sum(sizes[0][state] for state in states.axiom), dtype=code_type(len(states)))
    written: dict[tuple[int, int], int] = {}
    todo = [(state, 0) for state in reversed(states.axiom)]
    at = 0
    while todo:
        state, step = todo.pop()
        size = sizes[step][state]
        if size <= PIECE:
            word[at:at + size] = pieces[step][state]
        elif (state, step) in written:
            start = written[state, step]
            word[at:at + size] = word[start:start + size]
        else:
            written[state, step] = at
            todo += [(successor, step + 1) for successor in reversed(states.successor(state))]
            continue
        at += size
    assert at == len(word) or last < 0
    return word


def _sizes(states: States, present: Sequence[Counter[int]]) -> list[dict[int, int]]:
    """For each step and state the length of what the state becomes by the last step."""
    sizes: list[dict[int, int]] = [dict.fromkeys(present[-1], 1)]
    for here in reversed(present[:-1]):
        after = sizes[-1]
        sizes.append({state: sum(after[s] for s in states.successor(state)) for state in here})
    return sizes[::-1]


def _pieces(states: States, present: Sequence[Counter[int]], sizes: Sequence[dict[int, int]]) -> list[dict[int, tuple[int, ...]]]:
    """For each step and state whose size is small, what the state becomes by the last step."""
    pieces: list[dict[int, tuple[int, ...]]] = [{state: (state,) for state in present[-1]}]
    for step in range(len(present) - 2, -1, -1):
        after = pieces[-1]
        pieces.append({state: tuple([code for s in states.successor(state) for code in after[s]])
                       for state in present[step] if sizes[step][state] <= PIECE})
    return pieces[::-1]


def _grouped(number: float) -> str:
    """A number with its digits in groups of three; a very long one by its number of digits."""
    text = f"{number:,}"
    return text if len(text) <= 40 else f"about 10^{len(str(int(number))) - 1}"
