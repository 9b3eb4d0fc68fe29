"""What is wrong with the exercises in a folder, beyond what keeps them from being read; `lsys-kit exercises check FOLDER`."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from lsys_kit.budget import Task, limits
from lsys_kit.classroom.exercises.asked import answer_by, asked_system, right_history, what_is_asked
from lsys_kit.classroom.exercises.check import BUDGET, picture_of
from lsys_kit.classroom.exercises.declarations import QUESTIONS, MakeProblem, Problem, Questions, questions_folder, questions_in
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.judging import judged, wrong_answers
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.kinds.drawings import Drawn
from lsys_kit.classroom.exercises.kinds.nets import places_of
from lsys_kit.classroom.exercises.kinds.numbers import FORMULA, formula_in_reply
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS, solution_of
from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS
from lsys_kit.classroom.exercises.registry import kit_questions
from lsys_kit.errors import LSystemError
from lsys_kit.notation.dialects.map.dialect import read_map
from lsys_kit.notation.read import read

_UNIT_ASKED = re.compile(r",? in (degrees|radians|per cent|steps|hours|days|centimetres|millimetres|metres)(?=[,?*])")
HINTS = 3
"""How many hints an exercise has."""


def problems_in(folder: str | Path = QUESTIONS) -> list[Problem]:
    """All that is wrong with the exercises in a folder of them or of a course, by default the kit's, and advice."""
    path = questions_folder(folder)
    found = kit_questions() if path == QUESTIONS else questions_in(path)
    problems = [*found.problems, *_lesson_problems(found)]
    taken = {} if path == QUESTIONS else {exercise.id: source.file for source, _, exercise in kit_questions().exercises}
    for source, number, exercise in found.exercises:
        problem = partial(source.problem_of, number, exercise.id)
        problems += _exercise_problems(problem, exercise)
        if exercise.id in taken:
            problems.append(problem("id", "exercise.taken"))
    return sorted(problems, key=lambda problem: (problem.file, problem.line))


def _lesson_problems(found: Questions) -> Iterator[Problem]:
    """The objectives that no exercise tests, and those that do not exist."""
    lessons = {lesson.name: lesson.objectives for lesson in found.lessons}
    unread = {problem.file for problem in found.problems}
    for source, exercises in found.sources:
        objectives = lessons.get(source.file.removesuffix(".toml"), ())
        for number, exercise in exercises:
            if exercise.objective > len(objectives):
                values = {"number": exercise.objective, "most": len(objectives)}
                yield source.problem_of(number, exercise.id, "objective", "exercise.no_such_objective", **values)
        tested = {exercise.objective for _, exercise in exercises}
        for number, objective in enumerate(() if source.file in unread else objectives, 1):
            if number not in tested:
                yield source.problem("file.untested", number=number, objective=objective)


def _exercise_problems(problem: MakeProblem, exercise: Exercise) -> Iterator[Problem]:
    unread = next(_unread(exercise), None)
    if unread is not None:
        key, mistake = unread
        yield problem(key, "exercise.unreadable", fault=mistake.message, hint=mistake.hint)
        return
    with limits(**BUDGET), Task("It was not checked"):
        solution = solution_of(exercise)
        verdict, _ = judged(exercise, exercise.solution)
    if verdict.said != "Correct":
        yield problem("solution", "exercise.not_accepted", hint=verdict.message)
    if isinstance(solution, Drawn) and not len(solution.ends):
        yield problem("solution", "exercise.draws_nothing", step=exercise.steps)
        return
    kind = ANSWER_KINDS[exercise.kind]
    if what_is_asked(exercise) and exercise.kind in ("word", "words", "number", "table", "net"):
        asked = answer_by(exercise, right_history(exercise))
        asked = kind.read(exercise, asked) if exercise.kind == "net" else asked
        if asked is None or not kind.same(exercise, asked, solution):
            yield problem("solution", "exercise.another_answer", answer=_short(asked))
    if exercise.template.split() == exercise.solution.split():
        yield problem("template", "exercise.template")
    yield from _text_problems(problem, exercise)
    yield from _slip_problems(problem, exercise)
    yield from _expected_problems(problem, exercise)
    yield from _option_problems(problem, exercise)


def _unread(exercise: Exercise) -> Iterator[tuple[str, LSystemError]]:
    readers: dict[str, Callable[[], object]] = {
        "system": lambda: exercise.system and asked_system(exercise),
        "picture": lambda: exercise.picture and picture_of(exercise),
        "given": lambda: exercise.given and (read_map if exercise.kind == "map" else read)(exercise.given),
        "also": lambda: [ANSWER_KINDS[exercise.kind].read(exercise, each) for each in exercise.also],
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
        yield problem("hints", "exercise.hints", number=len(exercise.hints), most=HINTS)
    answer = re.compile(rf"(?<!\w){re.escape(' '.join(exercise.solution.split()))}(?!\w)")
    for hint in exercise.hints:
        if exercise.kind not in ("choice", "symbol") and answer.search(" ".join(hint.split())):
            yield problem("hints", "exercise.hint_tells", hint=hint)
    if not exercise.objective:
        yield problem("id", "exercise.no_objective")
    if not exercise.explanation.strip():
        yield problem("id", "exercise.no_explanation")
    if exercise.kind == "number":
        for found in FORMULA.finditer(exercise.otherwise):
            try:
                formula_in_reply(found[1])
            except LSystemError as fault:
                yield problem("otherwise", "exercise.formula", fault=fault.message)
    if exercise.kind in ("number", "symbol", "line") and not exercise.system and not exercise.otherwise:
        yield problem("kind", "exercise.otherwise")
    if not (exercise.expects or exercise.slips or exercise.options or wrong_answers(exercise)):
        yield problem("id", "exercise.no_misconception")
    if exercise.kind == "expression" and not exercise.values:
        yield problem("kind", "exercise.values")
    if exercise.kind == "net" and not {*exercise.symbols} <= {*places_of(solution_of(exercise))}:
        yield problem("symbols", "exercise.places")
    if exercise.kind == "number" and exercise.unit and (asked := _other_unit(exercise)):
        yield problem("unit", "exercise.unit", unit=exercise.unit, asked=asked)
    if exercise.kind in ("symbol", "line") and not exercise.text:
        yield problem("kind", "exercise.text")


def _other_unit(exercise: Exercise) -> str:
    """The unit in which a question wants its answer, ", in degrees,", if it is another one than is declared."""
    named = [] if len(exercise.unit) <= 2 else [found[1] for found in _UNIT_ASKED.finditer(exercise.question)]
    wanted = exercise.unit.casefold().removesuffix("s")
    fits = any(wanted.startswith(each.removesuffix("s")) or each.startswith(wanted) for each in named)
    return "" if fits or not named else named[0]


def _slip_problems(problem: MakeProblem, exercise: Exercise) -> Iterator[Problem]:
    kind, solution = ANSWER_KINDS[exercise.kind], solution_of(exercise)
    said: dict[str, int] = {}
    for at, slip in enumerate(exercise.slips):
        try:
            with limits(**BUDGET), Task("It was not checked"):
                own = kind.read(exercise, slip.answer)
                right = kind.same(exercise, own, solution)
        except LSystemError as mistake:
            yield problem("answer", "slips.unreadable", "slips", at, fault=mistake.message, hint=mistake.hint)
            continue
        if right:
            yield problem("answer", "slips.right", "slips", at)
        alike = kind.alike or kind.same
        if slip.says in said and slip.says:
            yield problem("says", "slips.said_already", "slips", at, number=said[slip.says] + 1)
        said.setdefault(slip.says, at)
        fitting = (each.misconception for each in wrong_answers(exercise) if alike(exercise, own, each.answer))
        others = {each.name for each in fitting if each} - {slip.misconception}
        if others and not slip.misconception:
            yield problem("answer", "slips.yielded", "slips", at, name=min(others))


def _expected_problems(problem: MakeProblem, exercise: Exercise) -> Iterator[Problem]:
    reached = {wrong.misconception.name for wrong in wrong_answers(exercise) if wrong.misconception}
    for name in exercise.expects:
        if name not in reached:
            yield problem("expects", "exercise.yields_nothing", name=name, applies=MISCONCEPTIONS[name].applies)


def _option_problems(problem: MakeProblem, exercise: Exercise) -> Iterator[Problem]:
    if exercise.kind != "choice":
        if exercise.options:
            yield problem("", "options.of_a_choice", "options")
        return
    if not 2 <= len(exercise.options) <= 8:
        yield problem("kind", "options.number")
        return
    right = letters(exercise).index(solution_of(exercise))
    for at, option in enumerate(exercise.options):
        replied = option.says or option.misconception
        if at != right and not replied:
            yield problem("text", "options.no_reply", "options", at)
        if at == right and replied:
            yield problem("text", "options.right", "options", at)
