"""Exercises in the chosen language: what a student reads of them, and no more."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

from lsys_kit.classroom.exercises.exercise import Exercise, Lesson
from lsys_kit.translation import gettext, language


def translated(exercise: Exercise) -> Exercise:
    """An exercise with its texts in the chosen language; those without a translation stay as they are."""
    return _exercise_in(language(), exercise)


@lru_cache(maxsize=512)
def _exercise_in(_: str, exercise: Exercise) -> Exercise:
    return replace(
        exercise,
        title=gettext(exercise.title),
        question=gettext(exercise.question),
        explanation=gettext(exercise.explanation),
        hints=tuple(map(gettext, exercise.hints)),
        otherwise=gettext(exercise.otherwise),
        slips=tuple(replace(slip, says=gettext(slip.says)) for slip in exercise.slips),
        options=tuple(replace(option, text=gettext(option.text), says=gettext(option.says)) for option in exercise.options),
    )


def translated_lesson(lesson: Lesson) -> Lesson:
    """The exercises of a lesson, with the texts around them, in the chosen language."""
    return replace(
        lesson,
        title=gettext(lesson.title),
        objectives=tuple(map(gettext, lesson.objectives)),
        introduction=gettext(lesson.introduction),
        summary=gettext(lesson.summary),
        exercises=tuple(map(translated, lesson.exercises)),
    )


def texts(lesson: Lesson) -> Iterator[str]:
    """The texts of a lesson's exercises that are translated, each as its file has it."""
    yield from (lesson.title, *lesson.objectives, lesson.introduction, lesson.summary)
    for exercise in lesson.exercises:
        yield from (exercise.title, exercise.question, exercise.explanation, *exercise.hints, exercise.otherwise, exercise.unit)
        yield from (slip.says for slip in exercise.slips)
        for option in exercise.options:
            yield from (option.text, option.says)
