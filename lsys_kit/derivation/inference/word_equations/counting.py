"""How many solutions equations between words have, and what each letter becomes in any of them, without listing them.

Groups of equations without a common letter multiply, the successors of one letter add up; what was counted for a group is kept.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf

from lsys_kit.budget import check_budget
from lsys_kit.derivation.inference.word_equations.bounds import Bounds
from lsys_kit.derivation.inference.word_equations.equations import Equation
from lsys_kit.derivation.inference.word_equations.search import Effort, Known, Question, deduced, groups_of, question, trials_of


@dataclass(frozen=True)
class Count:
    """How many solutions there are.

    Attributes
    ----------
    solutions
        Their number.
    successors
        For each letter the words that it becomes in any of them.
    """

    solutions: int
    successors: Mapping[int, frozenset[str]] = field(default_factory=dict)

    @property
    def certain(self) -> dict[int, str]:
        """What letters become in all of them."""
        return {letter: next(iter(words)) for letter, words in self.successors.items() if len(words) == 1}

    @property
    def ways(self) -> dict[int, int]:
        """How many words the other letters become."""
        return {letter: len(words) for letter, words in sorted(self.successors.items()) if len(words) > 1}


@dataclass(frozen=True)
class _Counting:
    """Which words may be successors, what was done, and what was counted of groups."""

    usable: Callable[[str], bool]
    effort: Effort
    kept: dict[Question, Count] = field(default_factory=dict)


def count_of(
    equations: Sequence[Equation], bounds: Bounds, usable: Callable[[str], bool] = lambda word: True, trials: float = inf
) -> Count:
    """How many solutions there are with usable successors; `GivenUp` where so many trials do not suffice.

    >>> from lsys_kit.derivation.inference.word_equations.bounds import first_bounds
    >>> equations = [Equation((0, 1), "abb"), Equation((2, 3), "abba")]
    >>> found = count_of(equations, first_bounds(equations, 4, erasing=False))
    >>> found.solutions, sorted(found.successors[0])
    (6, ['a', 'ab'])
    """
    return _count(tuple(equations), bounds, _Counting(usable, Effort(trials)))


def _count(equations: tuple[Equation, ...], bounds: Bounds, counting: _Counting) -> Count:
    check_budget()
    known = deduced(equations, bounds)
    if known is None or not all(map(counting.usable, known.successors.values())):
        return Count(0)
    number, successors = 1, {letter: frozenset({word}) for letter, word in known.successors.items()}
    for group in groups_of(known):
        found = _count_of_group(group, known, counting)
        number *= found.solutions
        successors |= found.successors
    return Count(number, successors)


def _count_of_group(group: tuple[Equation, ...], known: Known, counting: _Counting) -> Count:
    key = question(group, known)
    if key not in counting.kept:
        number, successors = 0, dict[int, frozenset[str]]()
        for letter, word, rest in trials_of(group, known, counting.effort):
            found = _count(rest, known.bounds, counting) if counting.usable(word) else Count(0)
            if found.solutions:
                number += found.solutions
                for each, words in {**found.successors, letter: frozenset({word})}.items():
                    successors[each] = successors.get(each, frozenset()) | words
        counting.kept[key] = Count(number, successors)
    return counting.kept[key]
