"""Exercises that check themselves: `check("1.1", answer)` says whether an answer is right, or how it differs.

An exercise is a declaration in the folder `questions`: the question, the solution, the mistakes to be expected, hints.
The answers are in the package, where anybody can find them: this is a self-check, not an examination. What is typed is read by
the kit's grammars and never run, and its size is bounded.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from lsys_kit.budget import Task, current, limits
from lsys_kit.classroom.exercises.answers import ANSWER_KINDS, Exercise, KnownMistake
from lsys_kit.classroom.exercises.differences import proved_equal
from lsys_kit.classroom.exercises.verdict import Verdict
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.errors import LSystemError, ModelLimitError, ModelNameError, ModelValueError, require
from lsys_kit.notation.analysis.checks import suggestion

_FOLDER = files(__package__) / "questions"
BUDGET: Mapping[str, float] = {"modules": 100_000, "seconds": 2, "rules": 50}
"""The limits for an answer."""
MOST_ANSWER_CHARACTERS = 5_000
"""The greatest length of an answer."""


@dataclass(frozen=True)
class Lesson:
    """The exercises of one lesson.

    Attributes
    ----------
    name
        The name of its notebook, without the suffix; the lesson's notebook has the same name.
    title, objectives, introduction, summary
        The text around the exercises, in Markdown.
    exercises
        In their order.
    """

    name: str
    title: str
    objectives: tuple[str, ...]
    introduction: str
    summary: str
    exercises: tuple[Exercise, ...]


def check(exercise: str, answer: object = None, hint: int = 0, solution: bool = False) -> Verdict:
    """Check an answer, or ask for a hint. A self-check: the answers are in the package.

    Parameters
    ----------
    exercise
        Its id, such as "1.1".
    answer
        The answer: a text, a number, a word or a system made by the kit; `...` means none yet.
    hint
        Ask for this hint instead, counted from 1.
    solution
        Show the solution as well, after an answer that could be read.

    Returns
    -------
    Verdict
        A number from 0 to 1 that a notebook shows as a box with the reply.

    Raises
    ------
    ModelNameError
        There is no such exercise.
    ModelValueError
        It has no such hint.

    Examples
    --------
    >>> check("1.1", "al al br")
    Almost. This is the word of step 3, but the question asks for step 4. Step 0 is the axiom itself.
    >>> check("1.1", "al al bx")
    Not readable yet. The system has no symbol "bx" (line 1, column 7). Its symbols are: bl, ar, al, br.
      al al bx
            ^^
    >>> check("1.1")
    Not answered yet. Replace the ... with your word, as a text in quotation marks.
    """
    asked = exercise_of(exercise)
    require(solution, bool, 'True or False for "solution"')
    if not isinstance(hint, int) or hint:
        return _hint(asked, hint)
    if answer is None or answer is ... or (isinstance(answer, str) and answer.strip().strip("\"'") in ("", "...", "…")):
        after = " The solution is shown after an attempt." if solution else ""
        return Verdict("Not answered yet", f"Replace the ... with your {ANSWER_KINDS[asked.kind].what}.{after}")
    try:
        with limits(**_budget()), Task("It was not checked"):
            verdict = _judged(asked, answer)
    except ModelLimitError as grown:
        return Verdict("Not yet", f"Your answer is too large. {grown.message}.")
    except LSystemError as mistake:
        return Verdict("Not readable yet", str(mistake))
    return _with_solution(verdict, asked) if solution else verdict


def _budget() -> dict[str, float]:
    """The limits for an answer, or those in force where these are narrower."""
    return {name: min(most, getattr(current(), name)) for name, most in BUDGET.items()}


def exercise_of(id: str) -> Exercise:
    """The exercise with an id.

    >>> exercise_of("1.1").kind
    'word'
    """
    known = {exercise.id: exercise for lesson in lessons() for exercise in lesson.exercises}
    if not isinstance(id, str):
        raise ModelValueError('The id of an exercise must be a text such as "1.1"')
    if id.strip() not in known:
        hint = suggestion(id[:20], known) or f"Exercises are: {', '.join(known)}."
        raise ModelNameError(f'There is no exercise "{id[:20]}"', hint=hint)
    return known[id.strip()]


@cache
def lessons() -> tuple[Lesson, ...]:
    """The lessons that have exercises, in their order."""
    declared = sorted((file for file in _FOLDER.iterdir() if file.name.endswith(".toml")), key=lambda file: file.name)
    return tuple(_lesson(file.name.removesuffix(".toml"), tomllib.loads(file.read_text(encoding="utf-8"))) for file in declared)


def _lesson(name: str, declared: Mapping[str, Any]) -> Lesson:
    return Lesson(name, declared["title"], tuple(declared["objectives"]), declared["introduction"], declared["summary"],
                  tuple(map(_exercise, declared["exercise"])))


def _exercise(declared: Mapping[str, Any]) -> Exercise:
    values = {name: tuple(map(number_from, given)) for name, given in declared.get("values", {}).items()}
    slips = tuple(KnownMistake(**slip) for slip in declared.get("slips", ()))
    return Exercise(**{**declared, "hints": tuple(declared["hints"]), "slips": slips, "values": values})


def _hint(exercise: Exercise, number: object) -> Verdict:
    most = len(exercise.hints)
    if isinstance(number, bool) or not isinstance(number, int) or not 1 <= number <= most:
        raise ModelValueError(f"Exercise {exercise.id} has the hints 1 to {most}")
    rest = f' One more: check("{exercise.id}", hint={number + 1}).' if number < most else ""
    return Verdict("Hint", f"{number} of {most}: {exercise.hints[number - 1]}{rest}")


def _judged(exercise: Exercise, answer: object) -> Verdict:
    """Right, a known mistake, or how it differs: the first of these that applies."""
    kind = ANSWER_KINDS[exercise.kind]
    solution = kind.read(exercise, exercise.solution)
    if isinstance(answer, str) and len(answer) > MOST_ANSWER_CHARACTERS:
        raise ModelLimitError(f"It has {len(answer):,} characters; the limit is {MOST_ANSWER_CHARACTERS:,}",
                              limit=MOST_ANSWER_CHARACTERS)
    own = kind.read(exercise, answer)
    if kind.same(exercise, own, solution):
        return Verdict("Correct", _praise(exercise, own, solution))
    for slip in exercise.slips:
        if kind.same(exercise, own, kind.read(exercise, slip.answer)):
            return Verdict("Almost", slip.says)
    return kind.reply(exercise, own, solution)


def _praise(exercise: Exercise, own: Any, solution: Any) -> str:
    """What to add to a right answer."""
    if exercise.kind == "system":
        return f"The words of all steps from 0 to {exercise.steps} agree."
    if exercise.kind == "expression":
        return (f"It equals {solution}, whatever the values." if proved_equal(own, solution)
                else f"It equals {solution} for all the values in question.")
    return ""


def _with_solution(verdict: Verdict, exercise: Exercise) -> Verdict:
    quoted = "\n".join(f"  {line}" for line in exercise.solution.strip().splitlines())
    message = f"{verdict.message}\nThe solution:\n{quoted}\n{exercise.explanation}".lstrip()
    return Verdict(verdict.said, message, float(verdict))
