"""Exercises that check themselves: `check("1.1", answer)` says whether an answer is right, or how it differs.

An exercise is a declaration in the folder `questions`: what is asked, the solution, the mistakes to be expected, hints.
The answers are in the package, and whoever looks for them finds them: this is a check of one's own, and no examination.
What is typed is read by the kit's grammars and never run; how large it may grow is bounded.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from lsys_kit.budget import limits
from lsys_kit.classroom.exercises.answers import ANSWER_KINDS, Exercise, KnownMistake
from lsys_kit.classroom.exercises.differences import proved_equal
from lsys_kit.classroom.exercises.verdict import Verdict
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.errors import LSystemError, ModelLimitError, ModelNameError, ModelValueError
from lsys_kit.notation.analysis.checks import suggestion

_FOLDER = files(__package__) / "questions"
BUDGET: Mapping[str, float] = {"modules": 100_000, "seconds": 2, "rules": 50}
"""How much an answer may ask for."""
MOST_CHARACTERS = 5_000
"""How long an answer may be."""


@dataclass(frozen=True)
class Lesson:
    """The exercises of one lesson.

    Attributes
    ----------
    name
        The name of its notebook, without ending: that of the lesson's own notebook, too.
    title, objectives, introduction, summary
        What stands around the exercises; Markdown.
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
        The answer: a text, a number, a word or a system that the kit made. `...` is none yet.
    hint
        Ask for this hint, counted from 1, instead.
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
    Almost. This is the word of step 3, and step 4 is asked for. Step 0 is the axiom itself.
    >>> check("1.1", "al al bx")
    Not readable yet. The system has no symbol "bx" (line 1, column 7). Its symbols are: bl, ar, al, br.
      al al bx
            ^^
    >>> check("1.1")
    Not answered yet. Replace the ... with your word, as a text in quotation marks.
    """
    asked = exercise_of(exercise)
    if hint:
        return _hint(asked, hint)
    if answer is None or answer is ... or (isinstance(answer, str) and answer.strip().strip("\"'") in ("", "...", "…")):
        after = " The solution is there after a try." if solution else ""
        return Verdict("Not answered yet", f"Replace the ... with your {ANSWER_KINDS[asked.kind].what}.{after}")
    try:
        with limits(**BUDGET):
            verdict = _judged(asked, answer)
    except ModelLimitError as grown:
        return Verdict("Not yet", f"Your answer is too large. {grown.message}.")
    except LSystemError as mistake:
        return Verdict("Not readable yet", str(mistake))
    return _with_solution(verdict, asked) if solution else verdict


def exercise_of(id: str) -> Exercise:
    """The exercise with an id.

    >>> exercise_of("1.1").kind
    'word'
    """
    known = {exercise.id: exercise for lesson in lessons() for exercise in lesson.exercises}
    if not isinstance(id, str):
        raise ModelValueError('An exercise is asked for by its id, a text such as "1.1"')
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
    """Right, a known slip, or how it differs: the first of these that applies."""
    kind = ANSWER_KINDS[exercise.kind]
    solution = kind.read(exercise, exercise.solution)
    if isinstance(answer, str) and len(answer) > MOST_CHARACTERS:
        raise ModelLimitError(f"It has {len(answer):,} characters; the limit is {MOST_CHARACTERS:,}", limit=MOST_CHARACTERS)
    own = kind.read(exercise, answer)
    if kind.same(exercise, own, solution):
        return Verdict("Correct", _praise(exercise, own, solution))
    for slip in exercise.slips:
        if kind.same(exercise, own, kind.read(exercise, slip.answer)):
            return Verdict("Almost", slip.says)
    return kind.reply(exercise, own, solution)


def _praise(exercise: Exercise, own: Any, solution: Any) -> str:
    """What more there is to say about a right answer."""
    if exercise.kind == "system":
        return f"The words of all steps from 0 to {exercise.steps} agree."
    if exercise.kind == "expression":
        return (f"It equals {solution}, whatever the values." if proved_equal(own, solution)
                else f"For all values that are asked for it equals {solution}.")
    return ""


def _with_solution(verdict: Verdict, exercise: Exercise) -> Verdict:
    quoted = "\n".join(f"  {line}" for line in exercise.solution.strip().splitlines())
    message = f"{verdict.message}\nThe solution:\n{quoted}\n{exercise.explanation}".lstrip()
    return Verdict(verdict.said, message, float(verdict))
