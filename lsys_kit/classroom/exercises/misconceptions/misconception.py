"""What a misconception is: what a reply says of it stands in `misconceptions.toml`, what it yields is said by functions.

Each of them is decorated with the name of its misconception, and, where it is no function from an exercise to wrong answers,
with the way in which it yields them: by what it makes of a system, of a step, of a formula. An answer has the form in which one
to the exercise is read; where a misconception does not apply to a question there is none.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeAlias, TypeVar

from lsys_kit.classroom.exercises.asked import History, answer_by
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS
from lsys_kit.files import toml_tables

WrongAnswers: TypeAlias = Callable[[Exercise], Iterator[object]]
Change = TypeVar("Change", bound=Callable[..., Any])


@dataclass(frozen=True)
class Misconception:
    """A misconception: what `misconceptions.toml` says of it, and the ways in which it yields wrong answers to a question."""

    name: str
    applies: str
    do: str
    but: str
    yields: tuple[WrongAnswers, ...]
    near: bool = False
    on_request: bool = False
    faint: bool = False
    last_resort: bool = False

    def answers(self, exercise: Exercise) -> Iterator[object]:
        """The wrong answers that it yields to a question."""
        for answers in self.yields:
            yield from answers(exercise)


DECLARED = toml_tables(__package__, "misconceptions.toml")
"""What is said of each misconception, by its name."""
YIELDS: Mapping[str, list[WrongAnswers]] = {name: [] for name in DECLARED}
"""What each yields, as its functions are met."""


def misconception(name: str, way: Callable[..., Iterator[object]] | None = None, *given: object) -> Callable[[Change], Change]:
    """A decorator of what a misconception yields to an exercise, or of what somebody with it changes in some way."""

    def kept(change: Change) -> Change:
        YIELDS[name].append(partial(way, change, *given) if way else change)
        return change

    return kept


def by_history(exercise: Exercise, history: History) -> Iterator[object]:
    """The answer of somebody who has these words in mind."""
    answer = answer_by(exercise, history)
    if answer is not None:
        yield ANSWER_KINDS[exercise.kind].read(exercise, answer) if exercise.kind in ("net", "drawing") else answer
