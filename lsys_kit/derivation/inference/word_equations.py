"""Equations between words: the successors of some unknown letters, one behind the other, are a known word.

A letter of unknown successor is a number, a known word a text with one character for each module. What must be is put in, then
a letter with few choices is tried. Equations that have no unknown letter in common are solved apart, and what was found for a
group is kept: it is met again wherever the other letters were tried in another way. So the search is exhaustive, and a
question that falls into small ones is answered as quickly as they are. To count solutions without listing them, those of
groups are multiplied, and those of the successors of one letter added up.

In an equation the counts of the successors add up to those of the known word: a linear equation with whole solutions for each
kind of letter, and one for the lengths (Parikh vectors: Rozenberg and Salomaa, The Mathematical Theory of L Systems, 1980).
Where all but one successor have few letters, the last must have many. Where in the known word a successor can begin is a set
of positions, kept as the bits of a whole number.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import tee
from math import inf
from typing import TYPE_CHECKING, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget, counted

if TYPE_CHECKING:
    from numpy.typing import NDArray

Item: TypeAlias = int | str
"""A part of the left side: an unknown letter, or a known word."""
Successors: TypeAlias = Mapping[int, str]
"""For each letter the word that replaces it."""


@dataclass(frozen=True)
class Equation:
    """The words that stand for `items`, one behind the other, are `target`."""

    items: tuple[Item, ...]
    target: str

    @property
    def unknowns(self) -> Iterator[int]:
        """Its unknown letters, in their order, as often as they occur."""
        return (item for item in self.items if isinstance(item, int))


def put_in(equation: Equation, known: Successors) -> Equation | None:
    """The equation with known successors in place of their letters, without what is known at both ends; None where they differ.

    >>> put_in(Equation((0, 1, 0, 2), "abcab"), {0: "ab"})
    Equation(items=(1, 'ab', 2), target='cab')
    >>> put_in(Equation((0, 1), "abc"), {0: "b"}) is None
    True
    """
    items: Sequence[Item] = equation.items
    if items and isinstance(items[0], int) and isinstance(items[-1], int) and known.keys().isdisjoint(items):
        return equation
    items, target = merged([known.get(item, item) if isinstance(item, int) else item for item in items]), equation.target
    if items and isinstance(front := items[0], str):
        if not target.startswith(front):
            return None
        items, target = items[1:], target[len(front) :]
    if items and isinstance(back := items[-1], str):
        if not target.endswith(back):
            return None
        items, target = items[:-1], target[: len(target) - len(back)]
    return Equation(tuple(items), target) if items or not target else None


def merged(items: Iterable[Item]) -> list[Item]:
    """Items with neighbouring known words joined, and without empty ones.

    >>> merged([0, "a", "", "b", 1])
    [0, 'ab', 1]
    """
    found: list[Item] = []
    texts: list[str] = []
    for item in items:
        if isinstance(item, str):
            texts.append(item)
            continue
        if texts and (text := "".join(texts)):
            found.append(text)
        texts.clear()
        found.append(item)
    if texts and (text := "".join(texts)):
        found.append(text)
    return found


def linked(equations: Iterable[Equation]) -> list[list[Equation]]:
    """Equations in groups that have no unknown letter in common, so that each can be solved for itself, small groups first.

    >>> [len(group) for group in linked([Equation((0, 1), "a"), Equation((2,), "b"), Equation((1, 3), "c")])]
    [1, 2]
    """
    groups: list[tuple[set[int], list[Equation]]] = []
    for equation in equations:
        letters, together = set(equation.unknowns), [equation]
        apart = []
        for others, group in groups:
            if letters.isdisjoint(others):
                apart.append((others, group))
            else:
                letters, together = letters | others, group + together
        groups = [*apart, (letters, together)]
    return [group for letters, group in sorted(groups, key=lambda found: len(found[0]))]


Counts: TypeAlias = "NDArray[np.int64]"
"""A row for each letter: how often its successor has each kind of letter, and in the last column its length."""


@dataclass(frozen=True)
class Bounds:
    """The least and the greatest counts, and for each kind of letter its column."""

    alphabet: dict[str, int]
    least: Counts
    greatest: Counts

    def shortest(self, letter: int) -> int:
        """The length of the shortest successor that a letter can have."""
        return int(self.least[letter, -1])

    def longest(self, letter: int) -> int:
        return int(self.greatest[letter, -1])


def first_bounds(equations: Sequence[Equation], letters: int, erasing: bool) -> Bounds:
    """What is known beforehand: a successor has at least one letter, unless letters may be erased."""
    targets = [equation.target for equation in equations]
    known = [item for equation in equations for item in equation.items if isinstance(item, str)]
    alphabet = {letter: column for column, letter in enumerate(sorted(set().union(*targets, *known)))}
    least = np.zeros((letters, len(alphabet) + 1), np.int64)
    least[:, -1] = not erasing
    return Bounds(alphabet, least, np.full_like(least, max(map(len, targets), default=0)))


FEW_LETTERS = 16
"""Of so many kinds of letters each is counted by itself, which is faster than to look at letter after letter."""


def counts_of(word: str, alphabet: dict[str, int]) -> Counts:
    """How often a word has each kind of letter, and its length."""
    if len(alphabet) <= FEW_LETTERS:
        return np.array([*map(word.count, alphabet), len(word)], np.int64)
    found = np.zeros(len(alphabet) + 1, np.int64)
    for letter, count in Counter(word).items():
        found[alphabet[letter]] = count
    found[-1] = len(word)
    return found


@lru_cache(maxsize=512)
def _sums(equation: Equation, kinds: tuple[str, ...]) -> tuple[NDArray[np.int64], NDArray[np.int64], Counts]:
    """The unknown letters of an equation, how often each occurs, and what their successors have together of each kind."""
    occurring, alphabet = Counter(equation.unknowns), {kind: column for column, kind in enumerate(kinds)}
    known = "".join(item for item in equation.items if isinstance(item, str))
    rest = counts_of(equation.target, alphabet) - counts_of(known, alphabet)
    return np.array([*occurring], np.int64), np.array([*occurring.values()], np.int64), rest


def narrowed(bounds: Bounds, equations: Iterable[Equation]) -> Bounds | None:
    """The bounds that follow from each equation alone; None where one cannot hold.

    >>> equations = [Equation((0, 1), "abb"), Equation((0, 1, 1), "abbbb")]
    >>> found = narrowed(first_bounds(equations, 2, False), equations)
    >>> found.greatest.tolist()
    [[1, 2, 2], [0, 2, 2]]
    """
    least, greatest = bounds.least.copy(), bounds.greatest.copy()
    kinds = tuple(bounds.alphabet)
    for equation in equations:
        letters, times, rest = _sums(equation, kinds)
        lower, upper = least[letters], greatest[letters]
        above, below = rest - times @ lower, times @ upper - rest
        if (above < 0).any() or (below < 0).any():
            return None
        least[letters] = np.maximum(lower, upper - below // times[:, None])
        greatest[letters] = np.minimum(upper, lower + above // times[:, None])
    _add_up(least, greatest)
    return Bounds(bounds.alphabet, least, greatest) if (least <= greatest).all() else None


def _add_up(least: Counts, greatest: Counts) -> None:
    """Narrow the bounds, since a length is the sum of the counts."""
    fewest, most = least[:, :-1].sum(axis=1), greatest[:, :-1].sum(axis=1)
    np.maximum(least[:, -1], fewest, out=least[:, -1])
    np.minimum(greatest[:, -1], most, out=greatest[:, -1])
    missing, spare = greatest[:, -1] - fewest, most - least[:, -1]
    np.minimum(greatest[:, :-1], least[:, :-1] + missing[:, None], out=greatest[:, :-1])
    np.maximum(least[:, :-1], greatest[:, :-1] - spare[:, None], out=least[:, :-1])


def cuts(equation: Equation, bounds: Bounds) -> list[int] | None:
    """For each gap between the items the positions where it can be; None where the equation has no solution.

    It is known from the left where the successors up to a gap can end, from the right where those behind it can begin.

    >>> equation = Equation((0, "b", 1), "abbb")
    >>> [list(bits(gap)) for gap in cuts(equation, first_bounds([equation], 2, erasing=False))]
    [[0], [1, 2], [2, 3], [4]]
    """
    size = len(equation.target)
    last = 1 << size
    ends = [1]
    for item in equation.items:
        if isinstance(item, str):
            ends.append((ends[-1] & occurrences(item, equation.target)) << len(item))
        else:
            ends.append(smeared(ends[-1], bounds.shortest(item), min(bounds.longest(item), size)) & (2 * last - 1))
    found = [ends.pop() & last]
    for item, end in zip(reversed(equation.items), reversed(ends), strict=True):
        if isinstance(item, str):
            here = found[-1] >> len(item)
        else:
            longest = min(bounds.longest(item), size)
            here = smeared(found[-1], 0, longest - bounds.shortest(item)) >> longest
        found.append(here & end)
    return found[::-1] if found[-1] else None


def smeared(positions: int, shortest: int, longest: int) -> int:
    """All positions that are so many further on.

    >>> [*bits(smeared(0b1001, 1, 2))]
    [1, 2, 4, 5]
    """
    positions, done, wanted = positions << shortest, 1, longest - shortest + 1
    while done < wanted:
        further = min(done, wanted - done)
        positions |= positions << further
        done += further
    return positions


@lru_cache(maxsize=4096)
def occurrences(word: str, text: str) -> int:
    """The positions at which a word occurs in a text.

    >>> [*bits(occurrences("aa", "aaab"))]
    [0, 1]
    """
    found, at = 0, text.find(word)
    while at >= 0:
        found |= 1 << at
        at = text.find(word, at + 1)
    return found


def bits(positions: int) -> Iterator[int]:
    """The positions of a set, in their order."""
    while positions:
        yield _first(positions)
        positions &= positions - 1


def _first(positions: int) -> int:
    return (positions & -positions).bit_length() - 1


def _last(positions: int) -> int:
    return positions.bit_length() - 1


def parts(equation: Equation, gaps: Sequence[int]) -> Iterator[Equation]:
    """The equations into which one falls where only one position is possible for a gap.

    >>> [*parts(Equation((0, "b", 1), "abcc"), [1, 2, 4, 16])]
    [Equation(items=(0,), target='a'), Equation(items=('b',), target='b'), Equation(items=(1,), target='cc')]
    """
    begin = 0
    for end in range(1, len(gaps)):
        if gaps[end] & (gaps[end] - 1) == 0:
            yield Equation(equation.items[begin:end], equation.target[_first(gaps[begin]) : _first(gaps[end])])
            begin = end


Solution = dict[int, str]
"""For each letter its successor."""
Question: TypeAlias = tuple[tuple[Equation, ...], bytes]
"""A group of equations, and the bounds of its letters."""


class GivenUp(Exception):
    """So many successors were tried that the search was given up."""


A_LOOK, A_KIND, A_BOUND = 15, 1 / 250, 1 / 400
"""To look at some equations takes as long as looking at so many more items than they have: in all, for each item and kind of
letter, and for each of the bounds."""


def cost_of_look(equations: Iterable[Equation], bounds: Bounds) -> float:
    """How long it takes to look at equations, in items.

    >>> equations = [Equation((0, 1), "abb"), Equation((0, 1, 1), "abbbb")]
    >>> cost_of_look(equations, first_bounds(equations, 2, erasing=False))
    20.055
    """
    items = sum(len(equation.items) for equation in equations)
    return A_LOOK + items * (1 + A_KIND * len(bounds.alphabet)) + A_BOUND * bounds.least.size


@dataclass
class Trials:
    """How many more successors a search may try, how many more items of equations it may look at, and what it finds
    for questions: an iterator that is copied, never used up."""

    left: float = inf
    items: float = inf
    kept: dict[Question, Iterator[Solution]] = field(default_factory=dict)

    def spend(self, trials: float) -> None:
        self.left -= trials
        if self.left < 0:
            raise GivenUp

    def look_at(self, equations: Iterable[Equation], bounds: Bounds) -> None:
        self.items -= cost_of_look(equations, bounds)
        if self.items < 0:
            raise GivenUp


@dataclass(frozen=True)
class Known:
    """What follows from some equations without trying: successors, what is left of the equations, how many letters successors
    have, and for letters at the ends of equations the successors that are possible there."""

    successors: Solution
    equations: tuple[Equation, ...]
    bounds: Bounds
    choices: dict[int, set[str]]


def solutions(equations: Sequence[Equation], bounds: Bounds, trials: Trials | None = None) -> Iterator[Solution]:
    """All solutions, one after another; `GivenUp` where so many trials do not suffice.

    >>> equations = [Equation((0, 1), "abb"), Equation((0, 1, 1), "abbbb")]
    >>> [*solutions(equations, first_bounds(equations, 2, erasing=False))]
    [{0: 'a', 1: 'bb'}]
    """
    return _solutions(tuple(equations), bounds, trials or Trials())


def _solutions(equations: tuple[Equation, ...], bounds: Bounds, trials: Trials) -> Iterator[Solution]:
    check_budget()
    known = deduced(equations, bounds, trials)
    if known is None:
        return
    found = []
    for group in groups_of(known):
        if (key := question(group, known)) not in trials.kept:
            (trials.kept[key],) = tee(_tried(group, known, trials), 1)
        found.append(trials.kept[key])
    if all(next(copy(each), None) is not None for each in found):  # else nothing needs to be combined
        yield from (known.successors | others for others in _combined(found))


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


def _combined(groups: Sequence[Iterator[Solution]]) -> Iterator[Solution]:
    """Every solution of the first group with every one of the others."""
    if not groups:
        yield {}
        return
    for first in copy(groups[0]):
        for others in _combined(groups[1:]):
            yield first | others


def _tried(group: tuple[Equation, ...], known: Known, trials: Trials) -> Iterator[Solution]:
    for letter, word, rest in trials_of(group, known, trials):
        for found in _solutions(rest, known.bounds, trials):
            yield {letter: word} | found


def trials_of(group: tuple[Equation, ...], known: Known, trials: Trials) -> Iterator[tuple[int, str, tuple[Equation, ...]]]:
    """The letter of a group with the fewest choices, one successor after another, and what is left of the equations then."""
    letter = min(letters_in(group) & known.choices.keys(), key=lambda each: (len(known.choices[each]), each))
    for word in sorted(known.choices[letter], key=lambda each: (len(each), each)):
        trials.spend(1)
        rest = all_put_in(group, {letter: word})
        if rest is not None:
            yield letter, word, rest


def all_put_in(equations: Sequence[Equation], known: Solution) -> tuple[Equation, ...] | None:
    """Equations with known successors in place of their letters; None where one of them contradicts these."""
    found = [put_in(equation, known) for equation in equations]
    return None if None in found else tuple(dict.fromkeys(each for each in found if each and each.items))


SHORT = (60, 1_000)
"""What follows from equations whose known words have up to so many letters is put into the longer ones first."""


def deduced(equations: tuple[Equation, ...], bounds: Bounds, trials: Trials | None = None) -> Known | None:
    """What follows without trying; None where the equations contradict one another."""
    known, trials = Solution(), trials or Trials()
    for most in SHORT:
        short = tuple(equation for equation in equations if len(equation.target) <= most)
        if 0 < len(short) < len(equations):
            found = _deduced(short, bounds, trials)
            rest = None if found is None else all_put_in(equations, found.successors)
            if found is None or rest is None:
                return None
            known, equations, bounds = known | found.successors, rest, found.bounds
    found = _deduced(equations, bounds, trials)
    return found and Known(known | found.successors, found.equations, found.bounds, found.choices)


def _deduced(equations: tuple[Equation, ...], bounds: Bounds, trials: Trials) -> Known | None:
    known: Solution = {}
    while True:
        trials.look_at(equations, bounds)
        once = _deduced_once(equations, bounds)
        if once is None:
            return None
        rest = all_put_in(once.equations, once.successors)
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
            shortest, longest = _first(end) - _last(begin), _last(end) - _first(begin)
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
    front, back, size = possible_lengths(first, target, bounds), possible_lengths(last, target[::-1], bounds), len(target)
    yield first, {target[:end] for end in counted(bits(gaps[1]), 1) if end in front}
    yield last, {target[begin:] for begin in counted(bits(gaps[-2]), 1) if size - begin in back}


def possible_lengths(letter: int, text: str, bounds: Bounds) -> range:
    """How many letters of a text, from its front, may be the successor of a letter: with more of them no count becomes less.

    >>> [*possible_lengths(0, "abbbab", Bounds({"a": 0, "b": 1}, np.array([[1, 1, 1]]), np.array([[1, 2, 9]])))]
    [2, 3]
    """
    *least, shortest = bounds.least[letter].tolist()
    *greatest, longest = bounds.greatest[letter].tolist()
    longest, places = min(longest, len(text)), _places(text)
    for kind, there in places.items():
        most = greatest[bounds.alphabet[kind]]
        if most < len(there):
            longest = min(longest, there[most] - 1)
    for kind, fewest in zip(bounds.alphabet, least, strict=True):
        if fewest:
            there = places.get(kind, [])
            shortest = max(shortest, there[fewest - 1] if fewest <= len(there) else len(text) + 1)
    return range(shortest, longest + 1)


@lru_cache(maxsize=4096)
def _places(text: str) -> dict[str, list[int]]:
    """For each kind of letter how far a text must be read to have it once, twice, ..."""
    found: dict[str, list[int]] = {}
    for place, kind in enumerate(text, 1):
        found.setdefault(kind, []).append(place)
    return found


@dataclass(frozen=True)
class Count:
    """How many solutions there are, and for each letter the words that it becomes in any of them."""

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
    """Which words may be successors, and what was counted of groups."""

    usable: Callable[[str], bool]
    trials: Trials
    kept: dict[Question, Count] = field(default_factory=dict)


def count_of(
    equations: Sequence[Equation],
    bounds: Bounds,
    usable: Callable[[str], bool] = lambda word: True,
    trials: Trials | None = None,
) -> Count:
    """How many solutions there are with usable successors; `GivenUp` where so many trials do not suffice.

    >>> equations = [Equation((0, 1), "abb"), Equation((2, 3), "abba")]
    >>> found = count_of(equations, first_bounds(equations, 4, erasing=False))
    >>> found.solutions, sorted(found.successors[0])
    (6, ['a', 'ab'])
    """
    return _count(tuple(equations), bounds, _Counting(usable, trials or Trials()))


def _count(equations: tuple[Equation, ...], bounds: Bounds, counting: _Counting) -> Count:
    check_budget()
    known = deduced(equations, bounds, counting.trials)
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
        unknowns = [*group[0].unknowns]
        alone = len(group) == 1 and len({*unknowns}) == len(unknowns)
        counting.kept[key] = (_count_of_cuts if alone else _count_of_trials)(group, known, counting)
    return counting.kept[key]


def _count_of_trials(group: tuple[Equation, ...], known: Known, counting: _Counting) -> Count:
    number, successors = 0, dict[int, frozenset[str]]()
    for letter, word, rest in trials_of(group, known, counting.trials):
        found = _count(rest, known.bounds, counting) if counting.usable(word) else Count(0)
        if found.solutions:
            number += found.solutions
            for each, words in {**found.successors, letter: frozenset({word})}.items():
                successors[each] = successors.get(each, frozenset()) | words
    return Count(number, successors)


A_PART = 1 / 8
"""A look at a part of a word takes as long as so many trials, at most."""


def _count_of_cuts(group: tuple[Equation, ...], known: Known, counting: _Counting) -> Count:
    """How many solutions an equation has in which no letter occurs twice: the ways up to each gap are added up."""
    equation, target = group[0], group[0].target
    gaps = cuts(equation, known.bounds)
    assert gaps
    ways = {0: 1}
    taken: list[list[tuple[int, int]]] = []
    for item, gap in zip(equation.items, gaps[1:], strict=True):
        here, pairs = dict[int, int](), list[tuple[int, int]]()
        for begin, number in ways.items():
            for end in _ends(item, begin, target, known.bounds):
                if gap >> end & 1:
                    counting.trials.spend(A_PART)
                    if isinstance(item, str) or counting.usable(target[begin:end]):
                        pairs.append((begin, end))
                        here[end] = here.get(end, 0) + number
        ways = here
        taken.append(pairs)
    successors: dict[int, frozenset[str]] = {}
    whole = {len(target)}
    for item, pairs in zip(reversed(equation.items), reversed(taken), strict=True):
        pairs = [pair for pair in pairs if pair[1] in whole]
        whole = {begin for begin, _ in pairs}
        if isinstance(item, int):
            successors[item] = frozenset(target[begin:end] for begin, end in pairs)
    return Count(ways.get(len(target), 0), successors)


def _ends(item: Item, begin: int, target: str, bounds: Bounds) -> Sequence[int]:
    """Where an item can end that begins at a place; a known word occurs there, or no cut would be at that place."""
    if isinstance(item, str):
        return [begin + len(item)]
    lengths = possible_lengths(item, target[begin : begin + bounds.longest(item)], bounds)
    return range(begin + lengths.start, begin + lengths.stop)
