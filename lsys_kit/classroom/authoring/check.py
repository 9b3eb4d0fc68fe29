"""`lsys-kit lesson check`: what a careful colleague would say of the lessons in a folder. Mistakes keep something from working;
all else is advice."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import cache
from itertools import islice
from pathlib import Path

from lsys_kit.classroom.authoring.asked import plan_findings, prediction_findings, table_findings, vote_findings
from lsys_kit.classroom.authoring.computed import bare, calculation_findings, other_words, word_findings, wrong_calculations
from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.new import TEMPLATE
from lsys_kit.classroom.authoring.panels import rule_findings, slider_findings
from lsys_kit.classroom.authoring.prose import head_findings, link_findings, markup_findings, section_findings, term_findings
from lsys_kit.classroom.authoring.said import (
    counted_findings,
    place_findings,
    reply_findings,
    system_findings,
    wording_findings,
)
from lsys_kit.classroom.authoring.teacher import teacher_findings
from lsys_kit.classroom.authoring.told import contradiction_findings, others_nearly, told_findings
from lsys_kit.classroom.authoring.written import Written, without_marks
from lsys_kit.classroom.exercises.declarations import questions_in
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.lint import problems_in
from lsys_kit.classroom.exercises.registry import kit_questions
from lsys_kit.classroom.places import MOST_ENTRIES, NAME, NO_LESSONS, Course, course_of
from lsys_kit.classroom.site import showing
from lsys_kit.classroom.site.build import found_in, run_through
from lsys_kit.errors import LSystemError


def _no_python(written: Written) -> Iterator[Finding]:
    for cell, fault in written.no_python:
        yield finding(written.at(cell, fault.lineno or 0), "no_python", fault=fault.msg)


CHECKS: tuple[Callable[[Written], Iterator[Finding]], ...] = (
    _no_python,
    vote_findings,
    table_findings,
    prediction_findings,
    plan_findings,
    head_findings,
    link_findings,
    markup_findings,
    section_findings,
    told_findings,
    contradiction_findings,
    term_findings,
    rule_findings,
    slider_findings,
    calculation_findings,
    word_findings,
    teacher_findings,
    wording_findings,
    reply_findings,
    place_findings,
    system_findings,
    counted_findings,
)
"""What is looked at without running anything."""


def findings_in(folder: Path | None = None, run: bool = True) -> list[Finding]:
    """What is found in the lessons of a folder, by default the kit's; their cells are run, if that is wanted.

    Raises
    ------
    ModelFileError
        There are no lessons in the folder.
    """
    course = course_of(folder)
    found, lessons = [*_misnamed(course)], list[Written]()
    for place, name in course.lessons:
        try:
            lessons.append(Written(course, place, name))
        except LSystemError as fault:
            found.append(finding(name, "unread", fault=fault.message, hint=fault.hint or ""))
    with ThreadPoolExecutor(max_workers=min(8, os.cpu_count() or 1)) as pool:  # each waits for a kernel
        ran = [*pool.map(_by_running, lessons)] if run else [[]] * len(lessons)
    for written, by_running in zip(lessons, ran, strict=True):
        found += _not_accepted([*(each for check in CHECKS for each in check(written)), *by_running], written)
    of_exercises = [*_of_exercises(course)]
    for written in lessons:
        of_exercises = _not_accepted(of_exercises, written, f"exercises/{written.name}.toml,")
    return [*found, *of_exercises, *_repeated_exercises(course)]


def _not_accepted(found: list[Finding], written: Written, of: str = "") -> list[Finding]:
    """Findings without the advice of a lesson, or of what begins so, that was looked at."""
    accepted = written.lesson.accepted if written.lesson else ()
    return [
        each
        for each in found
        if not (each.advice and each.where.startswith(of) and any(text in each.what for text in accepted))
    ]


def _by_running(written: Written) -> list[Finding]:
    """The cells of a lesson that fail in a real kernel."""
    try:
        notebook = run_through(written.place.notebooks / f"{written.name}.ipynb")
    except LSystemError as fault:
        return [finding(f"{written.name}.ipynb", "unread", fault=fault.message, hint=fault.hint or "")]
    found = []
    for cell, ran in zip(written.cells, notebook.cells, strict=True):
        if cell.is_code and not cell.may_fail:
            failed = [f"{each.ename}: {each.evalue}" for each in ran.get("outputs", ()) if each.output_type == "error"]
            faults = (*failed, *map(str, found_in([ran], showing.FAULT)))
            found += [finding(written.at(cell), "fails", fault=" ".join(fault.split())[:300]) for fault in faults]
    return found


def _misnamed(course: Course) -> Iterator[Finding]:
    """Notebooks that nobody would find."""
    with suppress(OSError):
        for path in sorted(islice((course.root / "notebooks").glob("*.ipynb"), MOST_ENTRIES)):
            if not NAME.fullmatch(path.stem) and path.stem not in NO_LESSONS:
                yield finding(path.name, "name", name=path.stem[:60])


def _of_exercises(course: Course) -> Iterator[Finding]:
    for place in course.places:
        wanted = course.root == place.root or not place.is_kits  # those of the kit are looked at with its own lessons
        if not wanted or not any(place.questions.glob("*.toml")):
            continue
        for each in problems_in(place.questions):
            yield Finding(_where(f"exercises/{each.file}", each.line, each.exercise), each.what, each.hint, each.advice)
        for source, number, exercise in (kit_questions() if place.is_kits else questions_in(place.questions)).exercises:
            if exercise.question.strip() in _template_questions():
                line = source.line_of(number, "question")
                yield finding(_where(f"exercises/{source.file}", line, exercise.id), "template_exercise")
            where = _where(f"exercises/{source.file}", source.line_of(number, "explanation"), exercise.id)
            yield from _said_in(exercise, _where(f"exercises/{source.file}", source.line_of(number, "question"), exercise.id))
            for given, right in others_nearly(exercise.explanation, exercise.solution) if exercise.kind == "number" else ():
                yield finding(where, "solution", given=given, right=right)


def _said_in(exercise: Exercise, where: str) -> Iterator[Finding]:
    """Of what an exercise says: that its calculations are right, and the rules in its question those of its system."""
    texts = [exercise.question, exercise.explanation, *exercise.hints, *(each.says for each in exercise.slips)]
    for left, sign, right, value, _ in wrong_calculations(without_marks("\n\n".join(texts))):
        yield finding(where, "calculation", left=left, sign=sign, right=right, value=value)
    for each in texts[1:] if exercise.kind == "word" and exercise.system else ():
        for step, said, made in other_words(exercise.system, each):
            yield finding(where, "word", step=step, word=said[:60], found=made[:60])
    there = dict(_rules_in(exercise.system))
    for left, right in _rules_in(exercise.question) if exercise.kind in ("word", "number", "table") else ():
        if left in there and bare(right) != bare(there[left]):
            yield finding(where, "other_rule", rule=f"{left} -> {right}"[:80], right=f"{left} -> {there[left]}"[:80])


def _rules_in(text: str) -> list[tuple[str, str]]:
    """The lines of a text that are rules: their left and right sides."""
    parts = (each.partition("->") for each in text.splitlines())
    return [(left.strip(), right.strip()) for left, arrow, right in parts if arrow]


@cache
def _template_questions() -> frozenset[str]:
    """What the exercises of a new lesson ask."""
    declared = tomllib.loads((TEMPLATE / "exercises.toml").read_text("utf-8"))
    return frozenset(str(each["question"]).strip() for each in declared["exercise"])


def _repeated_exercises(course: Course) -> Iterator[Finding]:
    """Exercises of two of its own lessons with one id, of which neither could be answered."""
    known: dict[str, tuple[Path, str]] = {}
    for folder in (place.questions for place in course.places if not place.is_kits and any(place.questions.glob("*.toml"))):
        for source, number, exercise in questions_in(folder).exercises:
            file = f"{folder.relative_to(course.root)}/{source.file}"
            first, named = known.setdefault(exercise.id, (folder, file))
            if first != folder:
                where = _where(file, source.line_of(number, "id"), exercise.id)
                yield finding(where, "exercise_twice", id=exercise.id, file=named)


def _where(file: str, line: int, exercise: str) -> str:
    return f"{file}, line {line}" + f", exercise {exercise}" * bool(exercise)
