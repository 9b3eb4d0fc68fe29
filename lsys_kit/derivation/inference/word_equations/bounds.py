"""How many letters of each kind, and how many in all, the successor of each letter has at least and at most.

In an equation the counts of the successors add up to those of the known word: a linear equation with whole solutions for each
kind of letter, and one for the lengths (Parikh vectors: Rozenberg and Salomaa, The Mathematical Theory of L Systems, 1980).
Where all but one successor have few letters, the last must have many.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from lsys_kit.derivation.inference.word_equations.equations import Equation

Counts: TypeAlias = np.ndarray[Any, np.dtype[np.int64]]
"""A row for each letter: how often its successor has each kind of letter, and in the last column its length."""


@dataclass(frozen=True)
class Bounds:
    """The least and the greatest counts.

    Attributes
    ----------
    alphabet
        For each kind of letter its column.
    least, greatest
        The counts.
    """

    alphabet: dict[str, int]
    least: Counts
    greatest: Counts

    def shortest(self, letter: int) -> int:
        """The length of the shortest successor that a letter can have."""
        return int(self.least[letter, -1])

    def longest(self, letter: int) -> int:
        """The length of the longest."""
        return int(self.greatest[letter, -1])


def first_bounds(equations: Sequence[Equation], letters: int, erasing: bool) -> Bounds:
    """What is known beforehand: a successor has at least one letter, unless letters may be erased."""
    targets = [equation.target for equation in equations]
    known = [item for equation in equations for item in equation.items if isinstance(item, str)]
    alphabet = {letter: column for column, letter in enumerate(sorted(set().union(*targets, *known)))}
    least = np.zeros((letters, len(alphabet) + 1), np.int64)
    least[:, -1] = not erasing
    return Bounds(alphabet, least, np.full_like(least, max(map(len, targets), default=0)))


def counts_of(word: str, alphabet: dict[str, int]) -> Counts:
    """How often a word has each kind of letter, and its length."""
    found = np.zeros(len(alphabet) + 1, np.int64)
    for letter, count in Counter(word).items():
        found[alphabet[letter]] = count
    found[-1] = len(word)
    return found


def narrowed(bounds: Bounds, equations: Iterable[Equation]) -> Bounds | None:
    """The bounds that follow from each equation alone; None where one cannot hold.

    >>> equations = [Equation((0, 1), "abb"), Equation((0, 1, 1), "abbbb")]
    >>> found = narrowed(first_bounds(equations, 2, False), equations)
    >>> found.greatest.tolist()
    [[1, 2, 2], [0, 2, 2]]
    """
    least, greatest = bounds.least.copy(), bounds.greatest.copy()
    for equation in equations:
        letters, times, rest = _summed(equation, bounds.alphabet)
        lower, upper = least[letters], greatest[letters]
        above, below = rest - times @ lower, times @ upper - rest
        if (above < 0).any() or (below < 0).any():
            return None
        least[letters] = np.maximum(lower, upper - below // times[:, None])
        greatest[letters] = np.minimum(upper, lower + above // times[:, None])
    _add_up(least, greatest)
    return Bounds(bounds.alphabet, least, greatest) if (least <= greatest).all() else None


def _summed(equation: Equation, alphabet: dict[str, int]) -> tuple[list[int], Counts, Counts]:
    """The unknown letters of an equation, how often each occurs, and the counts that all of them together have."""
    times = Counter(equation.unknowns)
    known = "".join(item for item in equation.items if isinstance(item, str))
    rest = counts_of(equation.target, alphabet) - counts_of(known, alphabet)
    return [*times], np.array([*times.values()], np.int64), rest


def _add_up(least: Counts, greatest: Counts) -> None:
    """A length is the sum of the counts."""
    fewest, most = least[:, :-1].sum(axis=1), greatest[:, :-1].sum(axis=1)
    np.maximum(least[:, -1], fewest, out=least[:, -1])
    np.minimum(greatest[:, -1], most, out=greatest[:, -1])
    missing, spare = greatest[:, -1] - fewest, most - least[:, -1]
    np.minimum(greatest[:, :-1], least[:, :-1] + missing[:, None], out=greatest[:, :-1])
    np.maximum(least[:, :-1], greatest[:, :-1] - spare[:, None], out=least[:, :-1])
