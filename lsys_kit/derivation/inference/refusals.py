"""Why no system fits: the first step that cannot come from the one before, and the letter at which that shows."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice

from lsys_kit.budget import check_budget
from lsys_kit.derivation.inference.problem import Conditions, Letter, Table, letters_of, problem_of, tables
from lsys_kit.derivation.inference.word_equations.search import GivenUp
from lsys_kit.derivation.inference.words import Row, text_of
from lsys_kit.notation.model.modules import Module

MOST_SUCCESSORS_TRIED = 5_000
"""Beyond so many trials it is not said where words contradict one another."""
SOLUTIONS_COMPARED = 20
"""What a letter would have to become is said where so many solutions agree on it."""


@dataclass(frozen=True)
class Contradiction:
    """A step that cannot come from the one before.

    Attributes
    ----------
    step
        The number of the later word.
    place
        The first letter of the earlier word for which there is no successor, from 1, as a reader counts; 0 where it has none.
    module
        That letter.
    needed, there
        What it must become as elsewhere, and what stands in its place; None where no successor has the right length.
    begin
        Where that stands in the later word, from 0.
    """

    step: int
    place: int
    module: Module | None
    needed: Row | None = None
    there: Row = ()
    begin: int = 0

    def __str__(self) -> str:
        said = f"Step {self.step} cannot come from step {self.step - 1}"
        if self.module is None:
            return f"{said}, which is empty."
        where = f"{said}: letter {self.place} of step {self.step - 1}, {self.module},"
        if self.needed is None:
            return f"{where} has no successor with which all others can have theirs."
        return f"{where} would have to become {text_of(self.needed)}, and there is {text_of(self.there)}."


def contradiction(words: Sequence[Row], conditions: Conditions) -> Contradiction | None:
    """Where words contradict one another, which no system fits: the first letter that has no successor; None where that is not
    soon found."""
    with suppress(GivenUp):
        return _contradiction(words, conditions)
    return None


def _contradiction(words: Sequence[Row], conditions: Conditions) -> Contradiction:
    step = first_impossible_step(words, conditions)
    words = words[: step + 1]
    letters = [*letters_of(words[step - 1], conditions)]
    place = bisect_left(range(1, len(letters)), True, key=lambda count: first_table(words, conditions, count) is None)
    if not letters:
        return Contradiction(step, 0, None)
    some = islice(tables(problem_of(words, conditions, place), MOST_SUCCESSORS_TRIED), SOLUTIONS_COMPARED)
    asked = {_asked(words[step], letters[: place + 1], table, conditions) for table in some}
    needed, there, begin = asked.pop() if len(asked) == 1 else (None, (), place)
    if needed == there:
        needed, there = None, ()
    return Contradiction(step, place + 1, letters[place].module, needed, there, begin)


def _asked(word: Row, letters: Sequence[Letter], table: Table, conditions: Conditions) -> tuple[Row | None, Row, int]:
    """What the last of some letters would become, what stands in its place, and where."""
    *before, needed = (successor(letter, table, conditions) for letter in letters)
    begin = sum(len(each or ()) for each in before)
    return needed, word[begin : begin + len(needed or ())], begin


def first_impossible_step(words: Sequence[Row], conditions: Conditions) -> int:
    """The first step that cannot come from the one before, if those before it did."""
    return 1 + bisect_left(range(1, len(words)), True, key=lambda step: first_table(words[: step + 1], conditions) is None)


def first_table(words: Sequence[Row], conditions: Conditions, last: int | None = None) -> Table | None:
    """What a first system makes of each letter; None where there is no system."""
    check_budget()
    return next(tables(problem_of(words, conditions, last), MOST_SUCCESSORS_TRIED), None)


def successor(letter: Letter, table: Table, conditions: Conditions) -> Row | None:
    """What becomes of a letter; None where that is not known."""
    return (letter.module,) if letter.module.symbol in conditions.unchanged else table.get(letter)
