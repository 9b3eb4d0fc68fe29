"""What is wrong with the exercises in a folder, beyond what keeps them from being read; `lsys-kit exercises check FOLDER`."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeAlias

from lsys_kit.budget import Task, limits
from lsys_kit.classroom.exercises.asked import answer_by, asked_system, right_history, what_is_asked
from lsys_kit.classroom.exercises.check import BUDGET
from lsys_kit.classroom.exercises.declarations import QUESTIONS, Problem, Questions, Source, questions_in
from lsys_kit.classroom.exercises.exercise import Exercise, Lesson
from lsys_kit.classroom.exercises.judging import judged, wrong_answers
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.kinds.numbers import FORMULA, formula_in_reply
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS, solution_of
from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS
from lsys_kit.classroom.exercises.registry import kit_questions
from lsys_kit.errors import LSystemError
from lsys_kit.notation.dialects.map.dialect import read_map
from lsys_kit.notation.read import read

MakeProblem: TypeAlias = Callable[..., Problem]
HINTS = 3
"""How many hints an exercise has."""
_NEEDS_OTHERWISE = ("number", "choice", "symbol", "line")


def problems_in(folder: str | Path = QUESTIONS) -> list[Problem]:
    """All that is wrong with the exercises in a folder, by default the kit's.

    >>> problems_in()
    []
    """
    path = Path(folder)
    found = kit_questions() if path == QUESTIONS else questions_in(path)
    problems = [*found.problems, *_lesson_problems(found)]
    taken = {} if path == QUESTIONS else {exercise.id: source.file for source, _, exercise in kit_questions().exercises}
    for source, number, exercise in found.exercises:
        problems += list(_exercise_problems(source, number, exercise))
        if exercise.id in taken:
            problems.append(
                Problem(
                    source.file,
                    source.line_of(number, "id"),
                    exercise.id,
                    "The kit has an exercise with this id",
                    "Take another, such as my.1.",
                )
            )
    return sorted(problems, key=lambda problem: (problem.file, problem.line))


def _lesson_problems(found: Questions) -> Iterator[Problem]:
    """The objectives that no exercise tests, and those that do not exist."""
    for lesson, (source, exercises) in _lessons_and_sources(found):
        tested = {exercise.objective for _, exercise in exercises}
        for number, exercise in exercises:
            if exercise.objective > len(lesson.objectives):
                yield Problem(
                    source.file,
                    source.line_of(number, "objective"),
                    exercise.id,
                    f"There is no objective {exercise.objective}",
                    f"The lesson has {len(lesson.objectives)}.",
                )
        unread = any(problem.file == source.file for problem in found.problems)
        for number, objective in enumerate(() if unread else lesson.objectives, 1):
            if number not in tested:
                yield Problem(
                    source.file,
                    1,
                    "",
                    f'No exercise tests objective {number}, "{objective}"',
                    f"Write objective = {number} in one that does.",
                )


def _lessons_and_sources(found: Questions) -> Iterator[tuple[Lesson, tuple[Source, tuple[tuple[int, Exercise], ...]]]]:
    sources = {source.file.removesuffix(".toml"): (source, exercises) for source, exercises in found.sources}
    for lesson in found.lessons:
        yield lesson, sources[lesson.name]


def _exercise_problems(source: Source, number: int, exercise: Exercise) -> Iterator[Problem]:
    def problem(key: str, what: str, hint: str = "", part: str = "", at: int = 0) -> Problem:
        return Problem(source.file, source.line_of(number, key, part, at), exercise.id, what, hint)

    unread = next(_unread(exercise), None)
    if unread is not None:
        key, mistake = unread
        yield problem(key, f'"{key}" cannot be read: {mistake.message}', mistake.hint or "")
        return
    with limits(**BUDGET), Task("It was not checked"):
        solution = solution_of(exercise)
        verdict, _ = judged(exercise, exercise.solution)
    if verdict.said != "Correct":
        yield problem("solution", "The solution is not accepted", verdict.message)
    if what_is_asked(exercise) and exercise.kind in ("word", "words", "number", "table", "net"):
        asked = answer_by(exercise, right_history(exercise))
        asked = ANSWER_KINDS["net"].read(exercise, asked) if exercise.kind == "net" else asked
        if asked is None or not ANSWER_KINDS[exercise.kind].same(exercise, asked, solution):
            yield problem("solution", f"The system gives another answer: {_short(asked)}", "Look at system, steps and asks.")
    if exercise.template.split() == exercise.solution.split():
        yield problem("template", "The template is the solution")
    yield from _text_problems(problem, exercise)
    yield from _slip_problems(problem, exercise)
    yield from _expected_problems(problem, exercise)
    yield from _option_problems(problem, exercise)


def _unread(exercise: Exercise) -> Iterator[tuple[str, LSystemError]]:
    """The keys whose texts make no sense, with the errors."""
    readers: dict[str, Callable[[], object]] = {
        "system": lambda: exercise.system and asked_system(exercise),
        "given": lambda: exercise.given and (read_map if exercise.kind == "map" else read)(exercise.given),
        "solution": lambda: judged(exercise, exercise.solution),
        "steps": lambda: what_is_asked(exercise) and answer_by(exercise, right_history(exercise)),
    }
    for key, read_it in readers.items():
        try:
            with limits(**BUDGET), Task("It was not checked"):
                read_it()
        except LSystemError as mistake:
            yield key, mistake


def _short(answer: object) -> str:
    try:
        text = " ".join(map(str, answer)) if isinstance(answer, tuple) else str(answer)
    except ValueError:  # Python writes no whole number of more than 4,300 digits
        return "a number too long to write down"
    return text if len(text) <= 80 else f"{text[:80]}..."


def _text_problems(problem: MakeProblem, exercise: Exercise) -> Iterator[Problem]:
    if len(exercise.hints) != HINTS:
        yield problem("hints", f"There are {len(exercise.hints)} hints", f"Write {HINTS}, from a nudge to nearly there.")
    answer = " ".join(exercise.solution.split())
    for hint in exercise.hints:
        if exercise.kind not in ("choice", "symbol") and re.search(
            rf"(?<!\w){re.escape(answer)}(?!\w)", " ".join(hint.split())
        ):
            yield problem("hints", "A hint contains the solution", hint)
    if not exercise.objective:
        yield problem(
            "id", "It does not say which objective it tests", "Write objective = 1, the number in the list at the top."
        )
    if exercise.kind == "number":
        for fault in _unread_formulas(exercise):
            yield problem("otherwise", fault.message, "In braces stand formulas of answer.")
    if exercise.kind in _NEEDS_OTHERWISE and not exercise.system and not exercise.otherwise and exercise.kind != "choice":
        yield problem("kind", "Nothing is said of a wrong answer that nobody expects", 'Write otherwise = "...".')
    if not (exercise.expects or exercise.slips or exercise.options):
        yield problem("id", "It uncovers no misconception", 'Write expects = ["..."], or a slip.')
    if exercise.kind == "expression" and not exercise.values:
        yield problem("kind", "An expression needs values", "Write values = { s = [1, 2, 3] }.")
    if exercise.kind in ("symbol", "line") and not exercise.text:
        yield problem("kind", "The word or program is missing", 'Write text = "...".')


def _unread_formulas(exercise: Exercise) -> Iterator[LSystemError]:
    """What is wrong with the formulas in a reply."""
    for found in FORMULA.finditer(exercise.otherwise):
        try:
            formula_in_reply(found[1])
        except LSystemError as fault:
            yield fault


def _slip_problems(problem: MakeProblem, exercise: Exercise) -> Iterator[Problem]:
    """Slips that cannot be read, that are right, or that say what others say."""
    kind, solution = ANSWER_KINDS[exercise.kind], solution_of(exercise)
    said: dict[str, int] = {}
    for at, slip in enumerate(exercise.slips):
        try:
            with limits(**BUDGET), Task("It was not checked"):
                own = kind.read(exercise, slip.answer)
                right = kind.same(exercise, own, solution)
        except LSystemError as mistake:
            yield problem("answer", f"The slip cannot be read: {mistake.message}", mistake.hint or "", "slips", at)
            continue
        if right:
            yield problem("answer", "The slip is right", "", "slips", at)
        alike = kind.alike or kind.same
        if slip.says in said and slip.says:
            yield problem("says", f"It says what slip {said[slip.says] + 1} says", "", "slips", at)
        said.setdefault(slip.says, at)
        others = sorted(
            {
                wrong.misconception.name
                for wrong in wrong_answers(exercise)
                if wrong.misconception and alike(exercise, own, wrong.answer)
            }
            - {slip.misconception}
        )
        if others and not slip.misconception:
            yield problem(
                "answer",
                f'The misconception "{others[0]}" yields this answer too',
                f'Write misconception = "{others[0]}" below it; says may stay.',
                "slips",
                at,
            )


def _expected_problems(problem: MakeProblem, exercise: Exercise) -> Iterator[Problem]:
    """Misconceptions that an exercise expects and that yield nothing, or the right answer."""
    reached = {wrong.misconception.name for wrong in wrong_answers(exercise) if wrong.misconception}
    for name in exercise.expects:
        if name not in reached:
            yield problem(
                "expects",
                f'"{name}" yields no wrong answer here',
                f"It applies to: {MISCONCEPTIONS[name].applies}. Perhaps it yields the right one, or write a slip with "
                f'misconception = "{name}".',
            )


def _option_problems(problem: MakeProblem, exercise: Exercise) -> Iterator[Problem]:
    if exercise.kind != "choice":
        if exercise.options:
            yield problem("", "Only a choice has options", "", "options", 0)
        return
    if not 2 <= len(exercise.options) <= 8:
        yield problem("kind", "A choice needs 2 to 8 options", "Write [[exercise.options]].")
        return
    right = letters(exercise).index(solution_of(exercise))
    for at, option in enumerate(exercise.options):
        if at != right and not (option.says or option.misconception):
            yield problem(
                "text", "Nothing is said of this wrong option", 'Write says = "...", or misconception = "...".', "options", at
            )
        if at == right and (option.says or option.misconception):
            yield problem("text", "The right option needs no reply", "", "options", at)
