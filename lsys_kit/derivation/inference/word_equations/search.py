"""The search for all solutions of equations between words: what must be is put in, then a letter with few choices is tried.

Equations that have no unknown letter in common are solved apart, and what was found for a group is kept: it is met again
wherever the other letters were tried in another way. So the search is exhaustive, and a question that falls into small ones is
answered as quickly as they are.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from math import inf
from typing import TypeAlias

from lsys_kit.budget import check_budget, counted
from lsys_kit.derivation.inference.word_equations.bounds import Bounds, counts_of, narrowed
from lsys_kit.derivation.inference.word_equations.equations import Equation, linked, put_in
from lsys_kit.derivation.inference.word_equations.positions import bits, cuts, greatest, least, parts

Solution = dict[int, str]
"""For each letter its successor."""
Question: TypeAlias = tuple[tuple[Equation, ...], bytes]
"""A group of equations, and the bounds of its letters."""


class Kept:
    """What a search has found so far, and the search, which goes on when more is asked for."""

    def __init__(self, found: Iterator[Solution]) -> None:
        self._found, self._rest = list[Solution](), found

    def __iter__(self) -> Iterator[Solution]:
        place = 0
        while place < len(self._found) or self._extend():
            yield self._found[place]
            place += 1

    def _extend(self) -> bool:
        following = next(self._rest, None)
        if following is not None:
            self._found.append(following)
        return following is not None


class GivenUp(Exception):
    """So many successors were tried that the search was given up."""


@dataclass
class Effort:
    """What a search has done, and may do.

    Attributes
    ----------
    kept
        For groups of equations, with the bounds of their letters, what was found.
    left
        How many more successors may be tried.
    """

    left: float
    kept: dict[Question, Kept] = field(default_factory=dict)


@dataclass(frozen=True)
class Known:
    """What follows from some equations without trying.

    Attributes
    ----------
    successors
        What is known of the letters.
    equations
        What is left of the equations.
    bounds
        How many letters the successors have.
    choices
        For letters at the ends of equations the successors that are possible there.
    """

    successors: Solution
    equations: tuple[Equation, ...]
    bounds: Bounds
    choices: dict[int, set[str]]


def solutions(equations: Sequence[Equation], bounds: Bounds, trials: float = inf) -> Iterator[Solution]:
    """All solutions, one after another; `GivenUp` where so many trials do not suffice.

    >>> from lsys_kit.derivation.inference.word_equations.bounds import first_bounds
    >>> equations = [Equation((0, 1), "abb"), Equation((0, 1, 1), "abbbb")]
    >>> [*solutions(equations, first_bounds(equations, 2, erasing=False))]
    [{0: 'a', 1: 'bb'}]
    """
    return _solutions(tuple(equations), bounds, Effort(trials))


def _solutions(equations: tuple[Equation, ...], bounds: Bounds, effort: Effort) -> Iterator[Solution]:
    check_budget()
    known = deduced(equations, bounds)
    if known is None:
        return
    for found in _products([_kept(group, known, effort) for group in groups_of(known)]):
        yield known.successors | found


def groups_of(known: Known) -> list[tuple[Equation, ...]]:
    """The groups of equations that can be solved each for itself."""
    return [tuple(sorted(group, key=lambda each: each.target)) for group in linked(known.equations)]


def letters_in(group: Sequence[Equation]) -> set[int]:
    """The unknown letters of some equations."""
    return {letter for equation in group for letter in equation.unknowns}


def question(group: tuple[Equation, ...], known: Known) -> Question:
    """What tells a group from others: its equations, and the bounds of its letters."""
    letters = sorted(letters_in(group))
    return group, known.bounds.least[letters].tobytes() + known.bounds.greatest[letters].tobytes()


def _products(groups: Sequence[Kept]) -> Iterator[Solution]:
    """Every solution of the first group with every one of the others; nothing is combined where a group has none."""
    if all(next(iter(group), None) is not None for group in groups):
        yield from _combined(groups)


def _combined(groups: Sequence[Kept]) -> Iterator[Solution]:
    if not groups:
        yield {}
        return
    for first in groups[0]:
        for others in _combined(groups[1:]):
            yield first | others


def _kept(group: tuple[Equation, ...], known: Known, effort: Effort) -> Kept:
    key = question(group, known)
    if key not in effort.kept:
        effort.kept[key] = Kept(_tried(group, known, effort))
    return effort.kept[key]


def _tried(group: tuple[Equation, ...], known: Known, effort: Effort) -> Iterator[Solution]:
    """The solutions of a group."""
    for letter, word, rest in trials_of(group, known, effort):
        for found in _solutions(rest, known.bounds, effort):
            yield {letter: word} | found


def trials_of(group: tuple[Equation, ...], known: Known, effort: Effort) -> Iterator[tuple[int, str, tuple[Equation, ...]]]:
    """The letter of a group with the fewest choices, one successor after another, and what is left of the equations then."""
    letter = min(letters_in(group) & known.choices.keys(), key=lambda each: (len(known.choices[each]), each))
    for word in sorted(known.choices[letter], key=lambda each: (len(each), each)):
        effort.left -= 1
        if effort.left < 0:
            raise GivenUp
        rest = _all_put_in(group, {letter: word})
        if rest is not None:
            yield letter, word, rest


def _all_put_in(equations: Sequence[Equation], known: Solution) -> tuple[Equation, ...] | None:
    found = [put_in(equation, known) for equation in equations]
    return None if None in found else tuple(dict.fromkeys(each for each in found if each and each.items))


def deduced(equations: tuple[Equation, ...], bounds: Bounds) -> Known | None:
    """What follows without trying; None where the equations contradict one another."""
    known: Solution = {}
    while True:
        once = _deduced_once(equations, bounds)
        if once is None:
            return None
        rest = _all_put_in(once.equations, once.successors)
        if rest is None:
            return None
        known |= once.successors
        same = (once.bounds.least == bounds.least).all() and (once.bounds.greatest == bounds.greatest).all()
        if rest == equations and same:
            return Known(known, rest, bounds, once.choices)
        equations, bounds = rest, once.bounds


def _deduced_once(equations: tuple[Equation, ...], bounds: Bounds) -> Known | None:
    narrow = narrowed(bounds, equations)
    if narrow is None:
        return None
    pieces: list[Equation] = []
    choices: dict[int, set[str]] = {}
    for equation in equations:
        gaps = cuts(equation, narrow)
        if gaps is None or not _lengths_fit(equation, gaps, narrow):
            return None
        for letter, words in _at_the_ends(equation, gaps, narrow):
            choices[letter] = choices[letter] & words if letter in choices else words
        pieces += parts(equation, gaps)
    certain = {letter: next(iter(words)) for letter, words in choices.items() if len(words) == 1}
    return Known(certain, tuple(pieces), narrow, choices) if all(choices.values()) else None


def _lengths_fit(equation: Equation, gaps: Sequence[int], bounds: Bounds) -> bool:
    """Narrow the lengths to what the positions allow; whether any is left."""
    for item, begin, end in zip(equation.items, gaps, gaps[1:], strict=False):
        if isinstance(item, int):
            shortest, longest = least(end) - greatest(begin), greatest(end) - least(begin)
            bounds.least[item, -1] = max(bounds.least[item, -1], shortest)
            bounds.greatest[item, -1] = min(bounds.greatest[item, -1], longest)
            if bounds.least[item, -1] > bounds.greatest[item, -1]:
                return False
    return True


def _at_the_ends(equation: Equation, gaps: Sequence[int], bounds: Bounds) -> Iterator[tuple[int, set[str]]]:
    """The choices for the letters at both ends of an equation; what is known there has been taken away."""
    first, last, target = equation.items[0], equation.items[-1], equation.target
    assert isinstance(first, int)
    assert isinstance(last, int)
    yield first, {word for end in counted(bits(gaps[1]), 1) if _possible(first, word := target[:end], bounds)}
    yield last, {word for begin in counted(bits(gaps[-2]), 1) if _possible(last, word := target[begin:], bounds)}


def _possible(letter: int, word: str, bounds: Bounds) -> bool:
    """Whether a successor has as many letters of each kind as it must."""
    if not bounds.shortest(letter) <= len(word) <= bounds.longest(letter):
        return False
    counts = counts_of(word, bounds.alphabet)
    return bool((bounds.least[letter] <= counts).all() and (counts <= bounds.greatest[letter]).all())
