"""Why no system fits: the first step that cannot come from the one before, and its first letter that has no successor."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice

from lsys_kit.budget import check_budget
from lsys_kit.derivation.inference.problem import Conditions, Letter, Row, Table, letters_of, problem_of, tables, text_of
from lsys_kit.derivation.inference.word_equations import GivenUp, Trials
from lsys_kit.notation.model.modules import Module
from lsys_kit.translation import gettext

MOST_SUCCESSORS_TRIED, MOST_SEEN = 5_000, 150_000
"""Beyond so many trials or items of equations that are looked at, it is not said where words contradict one another."""
A_MODULE = 1 / 6
"""To write a module into an equation takes as long as looking at so many items."""
SOLUTIONS_COMPARED = 20
"""What a letter would have to become is said where so many solutions agree on it."""


@dataclass(frozen=True)
class Contradiction:
    """A step that cannot come from the one before.

    The letter of the earlier word at a `place`, from 1, is the first for which there is no successor (0 and None where that
    word has no letter). What is `needed` is what it must become as elsewhere, and what is `there` stands in its place, at the
    `begin` in the later word; None where no successor has the right length.
    """

    step: int
    place: int
    module: Module | None
    needed: Row | None = None
    there: Row = ()
    begin: int = 0

    def __str__(self) -> str:
        said: dict[str, object] = {"step": self.step, "before": self.step - 1}
        if self.module is None:
            return gettext("Step {step} cannot come from step {before}, which is empty.", **said)
        said |= {"place": self.place, "letter": str(self.module)}
        if self.needed is None:
            return gettext(
                "Step {step} cannot come from step {before}: letter {place} of step {before}, {letter}, has no successor with "
                "which all others can have theirs.",
                **said,
            )
        return gettext(
            "Step {step} cannot come from step {before}: letter {place} of step {before}, {letter}, would have to become "
            "{needed}, and there is {there}.",
            needed=text_of(self.needed),
            there=text_of(self.there),
            **said,
        )


def contradiction(words: Sequence[Row], conditions: Conditions) -> Contradiction | None:
    """Where words contradict one another, which no system fits: the first letter that has no successor; None where that is not
    soon found."""
    seen = Trials(items=MOST_SEEN)
    with suppress(GivenUp):
        steps = range(1, len(words))
        step = 1 + bisect_left(steps, True, key=lambda step: contradict(words[: step + 1], conditions, seen))
        words = words[: step + 1]
        letters = [*letters_of(words[step - 1], conditions)]
        place = bisect_left(range(1, len(letters)), True, key=lambda count: contradict(words, conditions, seen, count))
        if not letters:
            return Contradiction(step, 0, None)
        some = islice(tables(problem_of(words, conditions, place), Trials(MOST_SUCCESSORS_TRIED)), SOLUTIONS_COMPARED)
        asked = {_asked(words[step], letters[: place + 1], table, conditions) for table in some}
        needed, there, begin = asked.pop() if len(asked) == 1 else (None, (), place)
        if needed == there:
            needed, there = None, ()
        return Contradiction(step, place + 1, letters[place].module, needed, there, begin)
    return None


def _asked(word: Row, letters: Sequence[Letter], table: Table, conditions: Conditions) -> tuple[Row | None, Row, int]:
    """What the last of some letters would become, what stands in its place, and where."""
    *before, needed = (
        (letter.module,) if letter.module.symbol in conditions.unchanged else table.get(letter) for letter in letters
    )
    begin = sum(len(each or ()) for each in before)
    return needed, word[begin : begin + len(needed or ())], begin


def contradict(words: Sequence[Row], conditions: Conditions, seen: Trials, last: int | None = None) -> bool:
    """Whether no system fits words, or the first letters of their last step; `seen` says how many items may be looked at."""
    check_budget()
    trials = Trials(MOST_SUCCESSORS_TRIED, seen.items - A_MODULE * sum(map(len, words)))
    try:
        return next(tables(problem_of(words, conditions, last), trials), None) is None
    finally:
        seen.items = trials.items
