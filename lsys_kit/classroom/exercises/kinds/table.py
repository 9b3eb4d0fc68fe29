"""The kinds of answers, by their names."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.choices import CHOICE, LINE, SYMBOL
from lsys_kit.classroom.exercises.kinds.drawings import DRAWING
from lsys_kit.classroom.exercises.kinds.expressions import EXPRESSION
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind
from lsys_kit.classroom.exercises.kinds.maps import MAP
from lsys_kit.classroom.exercises.kinds.nets import NET
from lsys_kit.classroom.exercises.kinds.numbers import NUMBER, TABLE
from lsys_kit.classroom.exercises.kinds.systems import SYSTEM
from lsys_kit.classroom.exercises.kinds.words import WORD, WORDS

ANSWER_KINDS: Mapping[str, AnswerKind] = {
    "word": WORD,
    "words": WORDS,
    "number": NUMBER,
    "table": TABLE,
    "choice": CHOICE,
    "symbol": SYMBOL,
    "line": LINE,
    "system": SYSTEM,
    "map": MAP,
    "expression": EXPRESSION,
    "drawing": DRAWING,
    "net": NET,
}
"""The kinds of answers."""


def solution_of(exercise: Exercise) -> Any:
    """The right answer to an exercise, read as a student's is."""
    return ANSWER_KINDS[exercise.kind].read(exercise, exercise.solution)
