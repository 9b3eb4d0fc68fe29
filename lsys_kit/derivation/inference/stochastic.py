"""The stochastic system of several derivations: its productions, and how probable each of them is.

Letters of a stochastic 0L-system (S0L) choose among several successors, each for itself. Which letters of a word come from
which letter before is not seen, so that all ways to cut a word into successors are weighed: the expected counts of the
successors give their probabilities, and these the counts (the EM algorithm: A. P. Dempster, N. M. Laird and D. B. Rubin, 1977;
forward and backward along a word as L. E. Baum and others, 1970). Of the systems to which that leads from several beginnings
the one is taken that describes itself and the words in the fewest bits (J. Rissanen, Modeling by shortest data description,
1978); its probabilities are those of maximum likelihood. The question is that of J. Bernard and I. McQuillan, Stochastic
L-system inference from multiple string sequence inputs, 2023.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from math import log2, sqrt
from typing import TYPE_CHECKING, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget
from lsys_kit.derivation.inference.problem import Conditions, Row, text_of, well_nested
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model.modules import Module
from lsys_kit.translation import gettext

if TYPE_CHECKING:
    from numpy.typing import NDArray

LONGEST = 24
"""Successors have up to so many modules."""
MOST_SEARCHED, MOST_COUNTED = 600, 30_000
"""In words of so many modules together, the shortest ones, successors are looked for, and in so many they are counted."""
MOST_CELLS = 4_000_000
"""So many pairs of a module before a step and a place behind it are looked at, and of a letter and a stretch."""
MOST_SURE = 200
"""Of so many letters before a step doubles can tell whether any way to cut the word behind it is possible."""
MOST_SEARCHES = 5
"""So often they are looked for again, with a step that the successors found do not make."""
PRUNINGS = (0.0, 0.3, 0.9)
"""How much is taken away from each expected count, so that successors that are rarely needed vanish."""
MOST_ROUNDS, SURE = 60, 1e-7
"""So many rounds are made, or until the probabilities change no more than that."""
NEGLIGIBLE = 1e-6
"""Successors that are expected less often are none."""
Numbers: TypeAlias = "NDArray[np.float64]"


@dataclass(frozen=True)
class Choice:
    """A production of a stochastic system, and how well its probability is known.

    Attributes
    ----------
    letter, successor
        What is replaced, and by what.
    probability
        Its share of the times that the letter was replaced: of maximum likelihood.
    error
        The standard error of the probability.
    times, of
        How often it was used, as far as that is known, of how many times that the letter was replaced.
    """

    letter: Module
    successor: Row
    probability: Fraction
    error: float
    times: float
    of: int

    def __str__(self) -> str:
        often = f"{self.times:.10g}"
        if self.times != round(self.times):
            often = gettext("about {times}", times=f"{self.times:.1f}")
        known = gettext("all {of}", of=self.of)
        if self.error:
            share, error = f"{float(self.probability):.3g}", f"{self.error:.2g}"
            known = gettext("{share} ± {error}, {often} of {of}", share=share, error=error, often=often, of=self.of)
        return f"{self.letter} -> {text_of(self.successor)}  ({known})"


@dataclass(frozen=True)
class _Step:
    """A step: the word before and the word after, and the numbers of the stretches of the latter by length and place."""

    before: Row
    after: Row
    stretches: tuple[NDArray[np.int64], ...]


@dataclass(frozen=True)
class _Question:
    """All steps, the letters that choose, and the stretches of words that may be successors."""

    steps: tuple[_Step, ...]
    letters: tuple[Module, ...]
    stretches: tuple[Row, ...]
    lengths: NDArray[np.int64]
    unchanged: frozenset[str]


def choices_of(derivations: Sequence[Sequence[Row]], conditions: Conditions) -> tuple[Choice, ...]:
    """The productions of the stochastic system that several derivations of it suggest; none where no system fits.

    >>> from lsys_kit.derivation.inference.problem import read_words
    >>> derivations = [read_words(words) for words in (["a", "ab", "abb"], ["a", "b", "b"], ["a", "ab", "bb"])]
    >>> for choice in choices_of(derivations, Conditions()):
    ...     print(choice)
    a -> a b  (0.6 ± 0.22, 3 of 5)
    a -> b  (0.4 ± 0.22, 2 of 5)
    b -> b  (all 3)
    """
    steps = _steps(derivations)
    some, left = list[tuple[Row, Row]](), MOST_SEARCHED
    for before, after in steps:
        left -= len(before) + len(after)
        if left >= 0 or not some:
            some.append((before, after))
    for _ in range(MOST_SEARCHES):
        found = _found(some, conditions)
        if found is None:
            return ()
        whole = _question(steps, conditions, found)
        chances = _of_found(whole, found)
        strange = next(
            (step for step in whole.steps if not np.isfinite(_expected(replace(whole, steps=(step,)), chances)[1])), None
        )
        if strange is None:
            settled = _settled(whole, chances, 0.0)
            assert settled is not None
            return tuple(_choices(whole, settled, _expected(whole, settled)[0]))
        some.append((strange.before, strange.after))
    raise _too_long()


Found: TypeAlias = Mapping[Module, Sequence[Row]]
"""For each letter its successors."""


def _steps(derivations: Sequence[Sequence[Row]]) -> list[tuple[Row, Row]]:
    """The steps of all derivations, those to short words first, as far as they are counted."""
    pairs = [pair for words in derivations for pair in pairwise(words)]
    kept, left = list[tuple[Row, Row]](), MOST_COUNTED
    for before, after in sorted(pairs, key=lambda pair: len(pair[1])):
        left -= len(before) + len(after)
        if left >= 0 and len(before) * len(after) <= MOST_CELLS:
            kept.append((before, after))
    if not kept:
        raise _too_long()
    return kept


def _too_long() -> ModelLimitError:
    return ModelLimitError(
        "These words are too long for a stochastic system to be found", limit=MOST_CELLS, hint="Give the first steps alone."
    )


def _found(steps: Sequence[tuple[Row, Row]], conditions: Conditions) -> Found | None:
    """The successors that describe some steps in the fewest bits; None where no system makes them."""
    question = _question(steps, conditions)
    settled = (_settled(question, _first(question, conditions), amount) for amount in PRUNINGS)
    found = [_without_needless(question, each) for each in settled if each is not None]
    if not found:
        if any(len(before) > MOST_SURE for before, _ in steps):
            raise _too_long()
        return None
    best = min(found, key=lambda each: _bits(question, each))
    return {letter: [question.stretches[at] for at in np.flatnonzero(best[row])] for row, letter in enumerate(question.letters)}


def _of_found(question: _Question, found: Found) -> Numbers:
    """The successors that were found of each letter, with the same probability; of a letter that was not looked at all."""
    usable = np.array(
        [[stretch in found.get(letter, [stretch]) for stretch in question.stretches] for letter in question.letters]
    )
    return np.asarray(usable / np.maximum(usable.sum(axis=1, keepdims=True), 1), np.float64)


def _choices(question: _Question, chances: Numbers, counts: Numbers) -> Iterator[Choice]:
    for row, letter in enumerate(question.letters):
        total = sum(step.before.count(letter) for step in question.steps)
        likely = sorted(np.flatnonzero(chances[row]), key=lambda at: (-counts[row, at], int(question.lengths[at])))
        for at in likely:
            times = float(counts[row, at])
            sure = abs(times - round(times)) < 1e-3
            share = Fraction(round(times), total) if sure else Fraction(times / total).limit_denominator(10_000)
            error = sqrt(max(0.0, float(share * (1 - share))) / total)
            yield Choice(letter, question.stretches[at], share, error, float(round(times)) if sure else times, total)


def _question(steps: Sequence[tuple[Row, Row]], conditions: Conditions, found: Found | None = None) -> _Question:
    """The steps with the stretches of their words; where successors are known, only with these."""
    usable = None if found is None else {successor for successors in found.values() for successor in successors}
    longest = LONGEST if usable is None else max(map(len, usable), default=0)
    numbers: dict[Row, int] = {}
    read = tuple(_step(before, after, numbers, longest, usable) for before, after in steps)
    letters = dict.fromkeys(module for before, _ in steps for module in before if module.symbol not in conditions.unchanged)
    if len(letters) * len(numbers) > MOST_CELLS:
        raise _too_long()
    lengths = np.array([len(stretch) for stretch in numbers], np.int64)
    return _Question(read, tuple(letters), tuple(numbers), lengths, conditions.unchanged)


OTHER: Row = (Module(""),)
"""It stands for all stretches that are no successors."""


def _step(before: Row, after: Row, numbers: dict[Row, int], longest: int, usable: set[Row] | None) -> _Step:
    found = []
    for length in range(min(longest, len(after)) + 1):
        check_budget()
        stretches = (after[at : at + length] for at in range(len(after) - length + 1))
        known = (each if usable is None or each in usable else OTHER for each in stretches)
        found.append(np.array([numbers.setdefault(each, len(numbers)) for each in known], np.int64))
    return _Step(before, after, tuple(found))


def _first(question: _Question, conditions: Conditions) -> Numbers:
    """Every stretch that may be a successor, with the same probability, the longer ones with a lower one."""
    usable = np.array([(conditions.erasing or bool(stretch)) and well_nested(stretch) for stretch in question.stretches])
    weights = np.where(usable, 0.7 ** question.lengths.astype(np.float64), 0.0)
    return np.tile(weights / weights.sum(), (len(question.letters), 1))


def _settled(question: _Question, chances: Numbers, amount: float) -> Numbers | None:
    """The probabilities that no round changes any more; with an amount taken from each count. None where no system fits."""
    for number in range(MOST_ROUNDS):
        counts, likelihood = _expected(question, chances)
        if not np.isfinite(likelihood):
            return None
        taken = amount * min(1.0, number / 10)
        kept = np.where(counts > NEGLIGIBLE, np.maximum(counts - taken, 0.0), 0.0)
        kept = np.where(kept.sum(axis=1, keepdims=True) > 0, kept, counts)
        new = kept / np.maximum(kept.sum(axis=1, keepdims=True), 1e-300)
        if amount and not np.isfinite(_expected(question, new)[1]):  # something that is needed would be taken away
            new = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1e-300)
            amount = 0.0
        if abs(new - chances).max() < SURE:
            return np.asarray(new, np.float64)
        chances = np.asarray(new, np.float64)
    return chances


def _without_needless(question: _Question, chances: Numbers) -> Numbers:
    """The probabilities without the successors without which fewer bits describe all, the rarest ones first."""
    counts, _ = _expected(question, chances)
    least = _bits(question, chances)
    rare = sorted(zip(*np.nonzero(chances), strict=True), key=lambda at: float(counts[at]))
    for row, at in rare[:200]:
        check_budget()
        if np.count_nonzero(chances[row]) < 2:
            continue
        fewer = chances.copy()
        fewer[row, at] = 0
        fewer /= fewer.sum(axis=1, keepdims=True)
        settled = _settled(question, fewer, 0.0)
        if settled is not None and (bits := _bits(question, settled)) < least:
            chances, least = settled, bits
    return chances


def _bits(question: _Question, chances: Numbers) -> float:
    """How many bits describe the productions, their probabilities and, with these, the words."""
    _, likelihood = _expected(question, chances)
    letters = log2(len({module for step in question.steps for module in step.after}) + 1)
    rows, stretches = np.nonzero(chances)
    of_productions = float((question.lengths[stretches] + 1).sum()) * letters
    replaced = [sum(step.before.count(letter) for step in question.steps) for letter in question.letters]
    free = [int(np.count_nonzero(rows == row)) - 1 for row in range(len(question.letters))]
    of_probabilities = sum(count * log2(max(2, times)) / 2 for count, times in zip(free, replaced, strict=True))
    return of_productions + of_probabilities - likelihood


def _expected(question: _Question, chances: Numbers) -> tuple[Numbers, float]:
    """How often each letter is expected to become each stretch, and the logarithm of the likelihood, to the base 2."""
    counts, likelihood = np.zeros_like(chances), 0.0
    rows = {letter: row for row, letter in enumerate(question.letters)}
    lengths = [sorted({*question.lengths[np.flatnonzero(row)].tolist()}) for row in chances]
    for step in question.steps:
        check_budget()
        likelihood += _add_expected(step, rows, lengths, chances, counts)
        if not np.isfinite(likelihood):
            break
    return counts, likelihood


def _add_expected(
    step: _Step, rows: Mapping[Module, int], lengths: Sequence[Sequence[int]], chances: Numbers, counts: Numbers
) -> float:
    """Add what is expected of a step, and return the logarithm of its likelihood (forward and backward along its word)."""
    size = len(step.after)
    likely = {
        rows[letter]: [
            (length, chances[rows[letter], step.stretches[length]], np.zeros(size + 1 - length))
            for length in lengths[rows[letter]]
            if length < len(step.stretches)
        ]
        for letter in rows.keys() & {*step.before}
    }
    same = {module: np.array([each == module for each in step.after]) for module in {*step.before} - rows.keys()}
    forward, scales = np.zeros((len(step.before) + 1, size + 1)), np.ones(len(step.before) + 1)
    forward[0, 0] = 1.0
    for at, module in enumerate(step.before):
        here, there = forward[at], forward[at + 1]
        if module in same:
            there[1:] = here[:-1] * same[module]
        else:
            for length, chance, _ in likely[rows[module]]:
                there[length:] += here[: size + 1 - length] * chance
        scales[at + 1] = there.sum()
        if not scales[at + 1]:
            return float("-inf")
        there /= scales[at + 1]
    if not forward[-1, -1]:
        return float("-inf")
    behind = np.zeros(size + 1)
    behind[-1] = 1.0 / forward[-1, -1]
    for at in range(len(step.before) - 1, -1, -1):
        module, here, new = step.before[at], forward[at], np.zeros(size + 1)
        behind = behind / scales[at + 1]
        if module in same:
            new[:-1] = behind[1:] * same[module]
        else:
            for length, chance, expected in likely[rows[module]]:
                part = chance * behind[length:]
                new[: size + 1 - length] += part
                expected += here[: size + 1 - length] * part
        behind = new
    for row, parts in likely.items():
        for length, _, expected in parts:
            np.add.at(counts[row], step.stretches[length], expected)
    return float(np.log2(scales[1:]).sum() + np.log2(forward[-1, -1]))
