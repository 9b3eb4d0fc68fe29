"""What was tried and solved: the record of tries, the page that shows it, and the scores of graded notebooks.

The record is a file beside the course with a line for each try, which a person can read and a spreadsheet opens. It says when
an exercise was tried, and whether it was solved, but nothing of the answer or of how near it was. Nothing is written where
there is no copy of the course, and a record that cannot be written or read stops no check.
"""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from numbers import Number
from pathlib import Path

from lsys_kit.classroom.course import MANIFEST
from lsys_kit.classroom.exercises.exercise import Exercise, Lesson
from lsys_kit.classroom.exercises.registry import all_lessons, exercise_of
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.verdict import PLAIN_TEXT, THEMED, Verdict
from lsys_kit.errors import ModelNameError, ModelValueError, every, quotable, require, shown
from lsys_kit.files import append_line
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.pictures.style.palette import BLUE, GREEN, ORANGE, QUIET
from lsys_kit.translation import gettext

# The record


FILE = "progress.csv"
"""The record, in the folder of the course."""
HEAD = "time,exercise,result"
SOLVED, TRIED = "solved", "tried"
PRACTICE = "practice: "
"""So the names of exercises begin that were made at random."""
MOST_BYTES = 1_000_000
"""A record is not made longer than that: some 30,000 tries."""
_TRIES = ("Correct", "Almost", "Not yet")
"""Verdicts on answers that could be read."""


@dataclass(frozen=True)
class Try:
    """An answer that was checked: to which exercise, and whether it was right."""

    exercise: str
    solved: bool


@dataclass(frozen=True)
class Record:
    """What was tried so far, in order.

    Attributes
    ----------
    tries
        Those in the file, then those that could not be kept there.
    folder
        The copy of the course that the file belongs to, or None.
    problem
        What is wrong with the file, in a sentence, or empty.
    """

    tries: tuple[Try, ...] = ()
    folder: Path | None = None
    problem: str = ""

    def solved(self, exercise: str) -> bool:
        """Whether an exercise was solved."""
        return Try(exercise, True) in self.tries

    def tried(self, exercise: str) -> int:
        """How often an exercise was tried, up to the first right answer.

        >>> Record((Try("1", False), Try("2", True), Try("1", True), Try("1", False))).tried("1")
        2
        """
        own = [each.solved for each in self.tries if each.exercise == exercise]
        return own.index(True) + 1 if True in own else len(own)


_seen: set[tuple[str, str | Number]] = set()
_not_kept: list[Try] = []
_said: set[str] = set()


def keep_try(exercise: str, answer: object, verdict: Verdict) -> str:
    """Keep what was tried, unless the same answer was tried before, or the exercise was solved.

    Returns
    -------
    str
        Why it could not be kept, in a sentence, if that was not said before; else nothing.
    """
    own = Try(" ".join(exercise.split()), verdict.said == "Correct")
    if verdict.said not in _TRIES or _was_seen(own.exercise, answer):
        return ""
    record = record_so_far()
    if record.solved(own.exercise):
        return ""
    problem = _append(record.folder, own) if record.folder else ""
    if problem or not record.folder:
        _not_kept.append(own)
    said_before = problem in _said
    _said.add(problem)
    return "" if said_before else problem


def _was_seen(exercise: str, answer: object) -> bool:
    if not isinstance(answer, str | Number):
        return False
    key = exercise, " ".join(answer.split()) if isinstance(answer, str) else answer
    before = key in _seen
    _seen.add(key)
    return before


def record_so_far() -> Record:
    """What was tried so far, in this copy of the course and since Python began."""
    folder = course_folder()
    if folder is None:
        return Record(tuple(_not_kept))
    try:
        kept, left_out = _read(folder / FILE)
    except OSError as fault:
        return Record(tuple(_not_kept), folder, f"{FILE} cannot be read: {fault.strerror or fault}.")
    problem = f"In {FILE} {left_out} line{'s' * (left_out > 1)} cannot be read." if left_out else ""
    return Record((*kept, *_not_kept), folder, problem)


def course_folder() -> Path | None:
    """The copy of the course in which Python runs: the current folder, or one of two above it, with the manifest."""
    with suppress(OSError):
        here = Path.cwd()
        for folder in (here, *here.parents[:2]):
            if (folder / MANIFEST).is_file() and not (folder / MANIFEST).is_symlink():
                return folder
    return None


def _append(folder: Path, own: Try) -> str:
    path, line = folder / FILE, io.StringIO()
    when = datetime.now().strftime("%Y-%m-%d %H:%M")
    csv.writer(line, lineterminator="").writerow((when, own.exercise, SOLVED if own.solved else TRIED))
    try:
        if path.is_file() and path.stat().st_size > MOST_BYTES:
            return f"This try is not kept: {FILE} is full."
        append_line(path, line.getvalue(), HEAD)
    except (OSError, ValueError) as fault:
        return f"This try is not kept in {FILE}: {getattr(fault, 'strerror', None) or fault}."
    return ""


def _read(path: Path) -> tuple[tuple[Try, ...], int]:
    """The tries in a record, and how many of its lines are none."""
    if path.is_symlink() or (path.exists() and not path.is_file()):
        raise OSError("it is no file")
    if not path.exists():
        return (), 0
    with path.open("rb") as file:
        lines = file.read(2 * MOST_BYTES).decode("utf-8-sig", "replace").splitlines()
    found = list(_tries(line for line in lines if line.strip() and line.strip() != HEAD))
    tries = tuple(each for each in found if each)
    return tries, len(found) - len(tries)


def _tries(lines: Iterable[str]) -> Iterator[Try | None]:
    for line in lines:
        row: list[str] = []
        with suppress(csv.Error):
            row = next(csv.reader([line]), [])
        yield Try(row[1], row[2] == SOLVED) if len(row) == 3 and row[2] in (SOLVED, TRIED) else None


# The page


SIGNS = {"solved": ("✓", GREEN), "tried": ("◐", ORANGE), "not tried": ("○", QUIET)}
"""For each state of an exercise its sign and its colour; the meaning never depends on the colour alone."""
_BOX = f"border-left:6px solid {BLUE};{THEMED};padding:6px 12px;overflow-wrap:break-word"
_COLUMNS = "display:grid;grid-template-columns:repeat(auto-fill,minmax(min(270px,100%),1fr));gap:6px 24px;margin:6px 0"


@dataclass(frozen=True)
class Progress:
    """What was tried and solved, displayed as a page in a notebook and as text elsewhere.

    Attributes
    ----------
    lessons
        The lessons that are shown.
    record
        What was tried.
    next
        The exercise to do next with its lesson, or None if all are solved.
    """

    lessons: tuple[Lesson, ...]
    record: Record
    next: tuple[Lesson, Exercise] | None

    def state(self, exercise: Exercise) -> str:
        """Whether an exercise is "solved", "tried" or "not tried"."""
        require(exercise, Exercise, "An exercise")
        tried = "tried" if self.record.tried(exercise.id) else "not tried"
        return "solved" if self.record.solved(exercise.id) else tried

    def count(self, state: str, *lessons: Lesson) -> int:
        """How many exercises of some lessons are in a state; of all that are shown, if none is named."""
        require(state, str, "A state of exercises")
        every(lessons, Lesson, "A lesson")
        return sum(self.state(each) == state for lesson in lessons or self.lessons for each in lesson.exercises)

    def __repr__(self) -> str:
        return "\n".join([_heading(self), *_text_rows(self), *_notes(self)])

    def _repr_html_(self) -> str:
        """The page: all text escaped, and a column for as many lessons as there is room for."""
        rows = "".join(_html_rows(self))
        label = reply("progress.progress")
        notes = "".join(f'<p style="margin:6px 0 0">{_linked(self, note)}</p>' for note in _notes(self))
        return (
            f'<div class="{PLAIN_TEXT}" role="region" aria-label="{label}" style="{_BOX}"><b>{escaped(_heading(self))}</b>'
            f'<div style="{_COLUMNS}">{rows}</div>{notes}</div>'
        )


def progress(lesson: str | int | None = None) -> Progress:
    """What was tried and solved of the exercises, and what to do next.

    In a copy of the course, as `lsys-kit lab` makes it, tries are kept in the file `progress.csv`: when an exercise was tried,
    and whether it was solved. No answer is kept, and no update of the course touches the file. An answer that cannot be read is
    no try, nor is the same answer given again, nor one to an exercise that is solved. Elsewhere tries are forgotten when Python
    ends.

    Parameters
    ----------
    lesson
        The number or name of a lesson, such as 1 or "01_all_at_once", to see its exercises one by one; by default all lessons.

    Raises
    ------
    ModelNameError
        There is no such lesson.

    Examples
    --------
    >>> from lsys_kit import check
    >>> _ = check("1.1", "bl ar bl ar ar")
    >>> "✓ 1.1  A word by hand" in repr(progress(1))
    True
    """
    return progress_of(record_so_far(), lesson)


def progress_of(record: Record, lesson: str | int | None = None) -> Progress:
    """The page of a record.

    >>> progress_of(Record(), 1).next[1].id
    '1.1'
    """
    known = all_lessons()
    seen = known if lesson is None else (_named(known, lesson),)
    return Progress(seen, record, _next(known, record, None if lesson is None else seen[0]))


def _named(lessons: Sequence[Lesson], name: object) -> Lesson:
    if isinstance(name, bool) or not isinstance(name, str | int):
        raise ModelValueError('A lesson is a number or a name, such as 1 or "01_all_at_once"')
    wanted = name.strip() if isinstance(name, str) else f"{name:02}" if 0 <= name < 100 else shown(name)
    found = [each for each in lessons if wanted in (each.name, each.name.partition("_")[0])]
    if not found:
        names = [each.name for each in lessons]
        raise ModelNameError(
            f'There is no lesson "{quotable(wanted)}" with exercises',
            hint=suggestion(wanted[:100], names) or f"Lessons are: {', '.join(names)}.",
        )
    return found[-1]


def _next(lessons: Sequence[Lesson], record: Record, lesson: Lesson | None) -> tuple[Lesson, Exercise] | None:
    """The first exercise not solved of the given lesson, else of that which was worked on last, then of those after it."""
    tried = [each.exercise for each in record.tries]
    last = next((at for id in reversed(tried) for at, each in enumerate(lessons) if id in {e.id for e in each.exercises}), 0)
    begin = last if lesson is None else lessons.index(lesson)
    ordered = (*lessons[begin:], *lessons[:begin])
    return next(((each, exercise) for each in ordered for exercise in each.exercises if not record.solved(exercise.id)), None)


# Words


def _heading(page: Progress) -> str:
    total = sum(len(lesson.exercises) for lesson in page.lessons)
    name = page.lessons[0].title if len(page.lessons) == 1 else reply("progress.exercises")
    numbers = {"name": name, "solved": page.count("solved"), "total": total, "tried": page.count("tried")}
    if numbers["tried"]:
        return reply("progress.tried_too", **numbers)
    return reply("progress.solved", name=name, solved=numbers["solved"], total=total)


def _text_rows(page: Progress) -> Iterator[str]:
    if len(page.lessons) == 1:
        yield from (_titled(page, exercise) for exercise in page.lessons[0].exercises)
        return
    width = max(len(lesson.title) for lesson in page.lessons)
    for lesson in page.lessons:
        signs = "  ".join(f"{SIGNS[page.state(each)][0]} {each.id}" for each in lesson.exercises)
        yield f"{lesson.title:{width}}  {_count(page, lesson)}  {signs}"


def _titled(page: Progress, exercise: Exercise) -> str:
    tries = page.record.tried(exercise.id)
    often = " " + reply("progress.tries", number=tries) if tries > 1 else ""
    return f"{SIGNS[page.state(exercise)][0]} {exercise.id}  {exercise.title}{often}"


def _count(page: Progress, lesson: Lesson) -> str:
    return reply("progress.count", solved=page.count("solved", lesson), total=len(lesson.exercises))


def _notes(page: Progress) -> Iterator[str]:
    """What to do next, what was practised, what is wrong, and, where all lessons are shown, what becomes of it."""
    yield f"{reply('progress.next')} {_named_next(page)}.".replace("?.", "?") if page.next else reply("progress.all_solved")
    practised = {each.exercise: each.solved for each in reversed(page.record.tries) if each.exercise.startswith(PRACTICE)}
    if practised and len(page.lessons) > 1:
        yield reply("progress.practised", number=len(practised), right=sum(practised.values()))
    if page.record.problem:
        yield page.record.problem
    if len(page.lessons) > 1:
        kept = reply("progress.kept", file=FILE) if page.record.folder else reply("progress.forgotten")
        yield f"{kept} {reply('progress.for_you')}"


def _named_next(page: Progress) -> str:
    assert page.next
    lesson, exercise = page.next
    named = f"{exercise.id} {exercise.title}"
    if page.lessons == (lesson,):
        return named
    return reply("progress.next_in", exercise=named, lesson=lesson.name)


# Markup


def _html_rows(page: Progress) -> Iterator[str]:
    if len(page.lessons) == 1:
        yield from (f"<div>{_chip(page, each, _titled(page, each))}</div>" for each in page.lessons[0].exercises)
        return
    for lesson in page.lessons:
        chips = " ".join(_chip(page, each, f"{SIGNS[page.state(each)][0]} {each.id}") for each in lesson.exercises)
        yield f"<div>{_link(page, lesson, lesson.title)} <span>({_count(page, lesson)})</span><br>{chips}</div>"


def _chip(page: Progress, exercise: Exercise, text: str) -> str:
    """An exercise with its sign, under which is a line in its colour; its state is read out, too."""
    state = page.state(exercise)
    sign, rest = text.split(" ", 1)
    name = gettext(state)
    style = f"display:inline-block;margin:2px 8px 2px 0;border-bottom:3px solid {SIGNS[state][1]}"
    return f'<span title="{name}" style="{style}"><span role="img" aria-label="{name}:">{sign}</span> {escaped(rest)}</span>'


def _link(page: Progress, lesson: Lesson, text: str) -> str:
    """A text as a link to the exercises of a lesson, where they are in the course."""
    notebook = page.record.folder / "exercises" / f"{lesson.name}.ipynb" if page.record.folder else None
    if notebook is None or not notebook.is_file():
        return escaped(text)
    there = escaped(os.path.relpath(notebook).replace(os.sep, "/"))
    return f'<a href="{there}" style="color:var(--jp-content-link-color,#00629B)">{escaped(text)}</a>'


def _linked(page: Progress, note: str) -> str:
    begin = f"{reply('progress.next')} "
    if page.next is None or not note.startswith(begin):
        return escaped(note)
    lesson, _ = page.next
    return f"{begin}{_link(page, lesson, note.removeprefix(begin))}" if page.lessons != (lesson,) else escaped(note)


# Scores


_last: dict[str, float] = {}


def keep_score(exercise: str, verdict: Verdict) -> None:
    """Keep the score of a check, in place of that of an earlier one."""
    _last[exercise] = float(verdict)


def score(exercise: str) -> float:
    """The score of the answer to an exercise that was checked last.

    Graded notebooks end with a cell `score("1.1")` for each exercise, from which nbgrader takes the points. An answer that
    cannot be run was not checked.

    Parameters
    ----------
    exercise
        Its id, such as "1.1".

    Returns
    -------
    float
        From 0 to 1: 1 if the answer was right, the share of its parts that are right if it has parts, 0 if none was checked.

    Raises
    ------
    ModelNameError
        There is no such exercise.

    Examples
    --------
    >>> from lsys_kit import check
    >>> _ = check("2.1", "2, 3, 5, 8, 13, 26")
    >>> round(score("2.1"), 2)
    0.83
    """
    return _last.get(exercise_of(exercise).id, 0.0)
