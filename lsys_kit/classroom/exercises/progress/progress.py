"""Progress: a page of the exercises that were tried and solved, and what to do next."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from lsys_kit.classroom.exercises.exercise import Exercise, Lesson
from lsys_kit.classroom.exercises.progress.record import FILE, Record, record_so_far
from lsys_kit.classroom.exercises.registry import all_lessons
from lsys_kit.classroom.exercises.verdict import PLAIN_TEXT
from lsys_kit.errors import ModelNameError, ModelValueError, every, quotable, require, shown
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.pictures.style.palette import BLUE, GREEN, INK, ORANGE, PAPER, QUIET
from lsys_kit.translation import gettext, ngettext

SIGNS = {"solved": ("✓", GREEN), "tried": ("◐", ORANGE), "not tried": ("○", QUIET)}
"""For each state of an exercise its sign and its colour; the meaning never depends on the colour alone."""
_BOX = f"border-left:6px solid {BLUE};background:{PAPER};color:{INK};padding:6px 12px;overflow-wrap:break-word"
_COLUMNS = "display:grid;grid-template-columns:repeat(auto-fill,minmax(min(270px,100%),1fr));gap:6px 24px;margin:6px 0"
FOR_YOU = "This is for your own practice: the answers are in the kit, and a check is not an examination."


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
        label = gettext("progress")
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
    """How many exercises are solved."""
    total = sum(len(lesson.exercises) for lesson in page.lessons)
    name = page.lessons[0].title if len(page.lessons) == 1 else gettext("Exercises")
    numbers = {"name": name, "solved": page.count("solved"), "total": total, "tried": page.count("tried")}
    if numbers["tried"]:
        return gettext("{name}: {solved} of {total} solved, {tried} more tried.", **numbers)
    return gettext("{name}: {solved} of {total} solved.", name=name, solved=numbers["solved"], total=total)


def _text_rows(page: Progress) -> Iterator[str]:
    if len(page.lessons) == 1:
        yield from (_titled(page, exercise) for exercise in page.lessons[0].exercises)
        return
    width = max(len(lesson.title) for lesson in page.lessons)
    for lesson in page.lessons:
        signs = "  ".join(f"{SIGNS[page.state(each)][0]} {each.id}" for each in lesson.exercises)
        yield f"{lesson.title:{width}}  {_count(page, lesson)}  {signs}"


def _titled(page: Progress, exercise: Exercise) -> str:
    """An exercise with its sign, its title and how often it was tried."""
    tries = page.record.tried(exercise.id)
    often = " " + ngettext("({number} try)", "({number} tries)", tries) if tries > 1 else ""
    return f"{SIGNS[page.state(exercise)][0]} {exercise.id}  {exercise.title}{often}"


def _count(page: Progress, lesson: Lesson) -> str:
    return gettext("{solved} of {total}", solved=page.count("solved", lesson), total=len(lesson.exercises))


def _notes(page: Progress) -> Iterator[str]:
    """What to do next, what is wrong, and, where all lessons are shown, what becomes of it."""
    yield f"{gettext('Next:')} {_named_next(page)}." if page.next else gettext("All exercises are solved.")
    if page.record.problem:
        yield page.record.problem
    if len(page.lessons) > 1:
        kept = (
            gettext("Tries are kept in {file}, in the folder of the course.", file=FILE)
            if page.record.folder
            else gettext("Tries are forgotten when Python ends. To keep them, work in a copy of the course: lsys-kit lab.")
        )
        yield f"{kept} {gettext(FOR_YOU)}"


def _named_next(page: Progress) -> str:
    assert page.next
    lesson, exercise = page.next
    named = f"{exercise.id} {exercise.title}"
    if page.lessons == (lesson,):
        return named
    return gettext("{exercise}, in the exercises of {lesson}", exercise=named, lesson=lesson.name)


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
    return f'<a href="{escaped(os.path.relpath(notebook).replace(os.sep, "/"))}" style="color:#00629B">{escaped(text)}</a>'


def _linked(page: Progress, note: str) -> str:
    """A note, with a link to what is to do next."""
    begin = f"{gettext('Next:')} "
    if page.next is None or not note.startswith(begin):
        return escaped(note)
    lesson, _ = page.next
    return f"{begin}{_link(page, lesson, note.removeprefix(begin))}" if page.lessons != (lesson,) else escaped(note)
