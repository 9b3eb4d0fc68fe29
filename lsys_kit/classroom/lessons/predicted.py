"""Predictions beside what came out: what was typed for a question of a lesson, and what its answer is."""

from __future__ import annotations

from functools import lru_cache

from lsys_kit.classroom.lessons.entries import is_right
from lsys_kit.classroom.lessons.kept import answered
from lsys_kit.classroom.lessons.lesson import Asked, Lesson, all_declared
from lsys_kit.classroom.panel.bundle import Data

OPEN = "open"
"""Kept behind what was typed, where its answer was not asked for yet."""


def key_of(question: str, what: str = "") -> str:
    """Under what a prediction is kept; a question that is none of the lessons' may be asked of several things."""
    return f"prediction {question}" if asked_of(question) else f"prediction {question}\n{what}"


def asked_of(question: str) -> Asked | None:
    """A question of the lessons as it is declared, or None."""
    return _asked(all_declared()).get(question)


@lru_cache(maxsize=4)
def _asked(lessons: tuple[Lesson, ...]) -> dict[str, Asked]:
    return {each.question: each for lesson in reversed(lessons) for each in lesson.predictions}


def outcome(question: str, typed: str, at_the_end: bool = False) -> Data:
    """What the answer is, and whether it was predicted; nothing of a question that no lesson asks, or of which the answer is
    said at the end of its lesson only.

    >>> outcome("Step 0 has one stroke, step 1 has five. How many has step 3?", "125")
    {'answer': '125', 'right': True}
    """
    asked = asked_of(question)
    if asked is None or (asked.later and not at_the_end):
        return {}
    return {"answer": asked.answer, **({"right": is_right(typed, asked.right)} if asked.right else {})}


def predictions_of(lesson: Lesson) -> list[Data]:
    """What was predicted in a lesson, in its order: each question, what was typed, and what came out."""
    kept = ((each.question, answered(key_of(each.question))) for each in lesson.predictions)
    return [
        {"question": question, "typed": typed[0], **outcome(question, typed[0], at_the_end=True)}
        for question, typed in kept
        if len(typed) == 1 and typed[0]
    ]
