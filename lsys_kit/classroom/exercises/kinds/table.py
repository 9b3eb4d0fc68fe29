"""The kinds of answers, by their names."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds import choices, drawings, expressions, maps, nets, numbers, systems, words
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind

ANSWER_KINDS: Mapping[str, AnswerKind[Any]] = {
    "word": words.WORD,
    "words": words.WORDS,
    "number": numbers.NUMBER,
    "table": numbers.TABLE,
    "choice": choices.CHOICE,
    "symbol": choices.SYMBOL,
    "line": choices.LINE,
    "system": systems.SYSTEM,
    "map": maps.MAP,
    "expression": expressions.EXPRESSION,
    "drawing": drawings.DRAWING,
    "net": nets.NET,
}
"""The kinds of answers."""


@lru_cache(maxsize=512)
def solution_of(exercise: Exercise) -> Any:
    """The right answer to an exercise, read as a student's is."""
    return ANSWER_KINDS[exercise.kind].read(exercise, exercise.solution)
