"""Exercises that check themselves: `check("1.1", answer)` says whether an answer is right, or how it differs.

An exercise is a declaration in the folder `questions`. A wrong answer is compared with those that misconceptions yield; a reply
says what the answer shows, and never the solution.
The answers are in the package, where anybody can find them: this is a self-check, not an examination. What is typed is read by
the kit's grammars and never run, and its size is bounded.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from contextlib import suppress

from lsys_kit.budget import PACE, Task, current, limits
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.judging import judged, wrong_answers
from lsys_kit.classroom.exercises.progress import keep_score, keep_try
from lsys_kit.classroom.exercises.registry import exercise_of
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.verdict import Verdict
from lsys_kit.errors import LSystemError, ModelFileError, ModelLimitError, ModelValueError, require
from lsys_kit.notation.read import read
from lsys_kit.pictures.draw import draw

BUDGET: Mapping[str, float] = {"modules": 100_000, "seconds": 3 * PACE, "rules": 50}
"""The limits for an answer."""
_OF_ONE_VALUE = ("number", "table", "expression")
"""Kinds whose templates are the dots alone: in "1 + 5 + ..." they are an answer's own."""
MOST_ANSWER_CHARACTERS = 5_000
"""The greatest length of an answer."""


def check(exercise: str, answer: object = None, hint: int = 0, solution: bool = False) -> Verdict:
    """Check an answer; after a try ask for a hint or for the solution. A self-check: the answers are in the package.

    Parameters
    ----------
    exercise
        Its id, such as "1.1".
    answer
        The answer: a text, a number, a word or a system made by the kit; `...` means none yet.
    hint
        Show the hints up to this one as well, counted from 1, if the answer is a try.
    solution
        Show the solution as well, if the answer is a try: one that can be read, is not what stood there before, and could be
        meant.

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
    ModelFileError
        The file of the exercise has a mistake.

    Examples
    --------
    >>> check("1.1", "al al br")
    Almost. That is what comes out if you stop one step too early, or call the axiom step 1. The axiom is step 0, and step 1 is
    what its modules become.
    >>> check("1.1", "al al bx")
    Not readable yet. The question has no symbol "bx" (line 1, column 7). The symbols are: bl, ar, al, br.
      al al bx
            ^^
    >>> check("1.1")
    Not answered yet. Replace the ... with your word, as a text in quotation marks.
    """
    asked = exercise_of(exercise)
    verdict = checked(asked, answer, hint, solution, f'check("{asked.id}", answer')
    keep_score(asked.id, verdict)
    return verdict.with_more(keep_try(asked.id, answer, verdict))


def checked(asked: Exercise, answer: object, hint: object, solution: object, call: str) -> Verdict:
    """The verdict on an answer to an exercise, which is asked for by a call that begins so."""
    require(solution, bool, 'True or False for "solution"')
    hints = _hints(asked, hint, call)
    if _untouched(asked, answer):
        missing = reply("check.untouched", answer=reply(f"{asked.kind}.answer"))
        if os.environ.get("SERVER_SOFTWARE", "").startswith("voila"):  # which shows no code
            missing = reply("check.voila")
        after = reply("check.after_a_try") if solution or hints else ""
        return Verdict("Not answered yet", f"{missing} {after}".rstrip())
    _prepare(asked)
    try:
        with limits(**_budget()), Task(reply("check.not_checked")):
            verdict, tried = _judged(asked, answer)
    except ModelLimitError as grown:
        advice = "" if "limits(" in (grown.hint or "") else f" {(grown.hint or '').split('reached. ')[-1]}".rstrip()
        verdict = Verdict("Not yet", reply("check.too_much", reason=grown.message) + advice)
        tried = asked.kind == "system"
    except LSystemError as mistake:
        return Verdict("Not readable yet", str(mistake))
    if (hints or solution) and not tried:
        return verdict.with_more(reply("check.after_a_meant_try"))
    if not solution:
        return verdict.with_more("\n".join(hints))
    return verdict.with_more("\n".join([*hints, _solution(asked)]), picture_of(asked))


def _prepare(exercise: Exercise) -> None:
    """Work out what is compared with answers, before the time for an answer begins."""
    try:
        wrong_answers(exercise)
    except LSystemError as mistake:
        raise ModelFileError(
            f'Exercise "{exercise.id}" has a mistake in its file. {mistake.message}',
            hint="lsys-kit exercises check FOLDER says where it is.",
        ) from None


def _budget() -> dict[str, float]:
    """The limits for an answer, or those in force where these are narrower."""
    return {name: min(most, getattr(current(), name)) for name, most in BUDGET.items()}


def _untouched(exercise: Exercise, answer: object) -> bool:
    """Whether nothing has been answered: the template stands there still, or part of it."""
    if answer is None or answer is ...:
        return True
    if not isinstance(answer, str):
        return False
    text = answer.strip().strip("\"'")
    goes_on = exercise.kind in _OF_ONE_VALUE and "->" not in text and any(map(str.isalnum, text))
    is_open = ("..." in text or "…" in text) and not goes_on
    return text == "" or is_open or text.split() == exercise.template.split()


def _judged(exercise: Exercise, answer: object) -> tuple[Verdict, bool]:
    if isinstance(answer, str) and len(answer) > MOST_ANSWER_CHARACTERS:
        raise ModelLimitError(
            reply("check.too_long", number=f"{len(answer):,}", most=f"{MOST_ANSWER_CHARACTERS:,}"), limit=MOST_ANSWER_CHARACTERS
        )
    return judged(exercise, answer)


def _hints(exercise: Exercise, number: object, call: str) -> list[str]:
    most = len(exercise.hints)
    if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number <= most:
        raise ModelValueError(reply("check.no_such_hint", id=exercise.id, most=most))
    shown = [reply("check.hint", number=at, most=most, hint=hint) for at, hint in enumerate(exercise.hints[:number], 1)]
    more = [reply("check.one_more", call=f"{call}, hint={number + 1})")] if 0 < number < most else []
    return [*shown, *more]


def _solution(exercise: Exercise) -> str:
    quoted = "\n".join(f"  {line}" for line in exercise.solution.strip().splitlines())
    return f"{reply('check.solution')}\n{quoted}\n{exercise.explanation}"


def picture_of(exercise: Exercise) -> str:
    """What is drawn with the explanation of an exercise, as SVG text; empty where nothing is, or arrays are missing."""
    with suppress(ModuleNotFoundError):
        return draw(read(exercise.picture), 0).svg if exercise.picture else ""
    return ""
