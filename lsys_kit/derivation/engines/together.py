"""Many runs of one system side by side: the words of all seeds are one column, and only what is counted is kept.

A small plant by chance takes less time than it takes to begin with it; a thousand of them, step by step at once, take that of
one large plant. Each run has its own random numbers, its own neighbours, and the counts that it has alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import counted, current
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.engines.columnar import Check, ColumnarSteps, ColumnWord

MODULES_TOGETHER = 2**22
"""All runs together have at most so many modules; where they have more, there are fewer runs at once."""
Counts: TypeAlias = Mapping[str, int]
"""How often each symbol occurs."""


def counts_together(states: States, seeds: Sequence[int], steps: Sequence[int]) -> Iterator[list[Counts] | None]:
    """For each seed how often each symbol occurs at some steps, which ascend; None, where only the run alone can say that.

    >>> from lsys_kit import read
    >>> plant = read("axiom: F\\nF -> F[+F]F : 1/2\\nF -> F[-F]F[+F]F : 1/2")
    >>> [[step["F"] for step in run or ()] for run in counts_together(States(plant), [0, 1, 2], [0, 2])]
    [[1, 13], [1, 25], [1, 19]]
    """
    waiting = [seeds]
    while waiting:
        some = waiting.pop()
        found = None
        with suppress(ArithmeticError):
            found = _counted(states, some, steps)
        if found is not None:
            yield from found
        elif len(some) > 1:
            waiting += [some[len(some) // 2 :], some[: len(some) // 2]]
        else:
            yield None


def _counted(states: States, seeds: Sequence[int], steps: Sequence[int]) -> list[list[Counts]]:
    """The counts of all runs; an `ArithmeticError`, where they are too large together, or columns cannot do it."""
    columns = ColumnarSteps(states)
    word, found = columns.words(seeds), [list[Counts]() for _ in seeds]
    for step in counted(range(steps[-1] + 1), 1):
        if step:
            word = columns.step(word, step, _together(len(seeds)))
        if step in steps:
            for counts, run in zip(found, _symbols(word, len(seeds)), strict=True):
                counts.append(run)
    return found


def _together(runs: int) -> Check:
    """A check that the words of some runs are not too large to be computed at once."""

    def check(size: int, taken: int) -> None:
        if size > min(MODULES_TOGETHER, current().modules) or taken > current().bytes:
            raise OverflowError

    return check


def _symbols(word: ColumnWord, runs: int) -> Iterator[Counts]:
    """How often each symbol occurs in the word of each run."""
    kinds = len(word.names)
    rows = word.structure.runs(np.arange(len(word)))
    numbers = np.bincount(rows * kinds + word.kinds, minlength=runs * kinds).reshape(runs, kinds)
    for row in numbers.tolist():
        counts: dict[str, int] = {}
        for (symbol, _), number in zip(word.names, row, strict=True):
            counts[symbol] = counts.get(symbol, 0) + number
        yield counts
