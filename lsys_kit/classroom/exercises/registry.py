"""The exercises that `check` knows, in the chosen language: those of the kit, and those of the folders that were added."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, TypeVar

from lsys_kit.classroom.exercises.declarations import QUESTIONS, Questions, questions_in
from lsys_kit.classroom.exercises.exercise import Exercise, Lesson, Option, Slip
from lsys_kit.classroom.places import Place, places, resolved
from lsys_kit.errors import ModelFileError, ModelNameError, ModelValueError, quotable, require
from lsys_kit.files import file_errors
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.translation import gettext, language

# In the chosen language


TEXTS: Mapping[type, Sequence[str]] = {
    Lesson: ("title", "objectives", "introduction", "summary"),
    Exercise: ("title", "question", "explanation", "hints", "otherwise"),
    Slip: ("says",),
    Option: ("text", "says"),
}
"""The texts of records that are translated; those without a translation stay as they are."""
Record = TypeVar("Record", Lesson, Exercise, Slip, Option)


def _with_texts(record: Record) -> Record:
    found: dict[str, Any] = {}
    for key in TEXTS[type(record)]:
        value = getattr(record, key)
        found[key] = gettext(value) if isinstance(value, str) else tuple(map(gettext, value))
    return replace(record, **found)


def translated(exercise: Exercise) -> Exercise:
    """An exercise with its texts in the chosen language."""
    return _exercise_in(language(), exercise)


@lru_cache(maxsize=512)
def _exercise_in(_: str, exercise: Exercise) -> Exercise:
    slips, options = map(_with_texts, exercise.slips), map(_with_texts, exercise.options)
    return replace(_with_texts(exercise), slips=tuple(slips), options=tuple(options))


def translated_lesson(lesson: Lesson) -> Lesson:
    """The exercises of a lesson, with the texts around them, in the chosen language."""
    return replace(_with_texts(lesson), exercises=tuple(map(translated, lesson.exercises)))


def texts(lesson: Lesson) -> Iterator[str]:
    """The texts of a lesson's exercises that are translated, each as its file has it."""
    yield from _texts_in(lesson)
    for exercise in lesson.exercises:
        yield from (*_texts_in(exercise), exercise.unit)
        for part in (*exercise.slips, *exercise.options):
            yield from _texts_in(part)


def _texts_in(record: object) -> Iterator[str]:
    for key in TEXTS[type(record)]:
        value = getattr(record, key)
        yield from [value] if isinstance(value, str) else value


# Those that there are


_added: dict[Path, Questions] = {}


@cache
def kit_questions() -> Questions:
    """The kit's own exercises."""
    return questions_in(QUESTIONS)


def lessons() -> tuple[Lesson, ...]:
    """The lessons of the kit that have exercises, in their order."""
    return tuple(map(translated_lesson, kit_questions().lessons))


def all_lessons() -> tuple[Lesson, ...]:
    """The lessons of the kit and of the folders that were added."""
    return tuple(map(translated_lesson, _once([lesson for questions in _all_questions() for lesson in questions.lessons])))


class ExerciseList(tuple[Exercise, ...]):
    """Exercises, which print as a list of their ids and titles."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "\n".join(map(repr, self))


def exercises(folder: str | Path | None = None) -> ExerciseList:
    """The exercises there are; with a folder, add those in its files, so that `check` knows them.

    Parameters
    ----------
    folder
        A folder with files like those of the kit. A file that is changed is read again when the folder is added again.

    Raises
    ------
    ModelFileError
        There are mistakes in its files; all that have none can be used all the same.

    Examples
    --------
    >>> [len(exercise.hints) for exercise in exercises()][:2]
    [3, 3]
    """
    if folder is None:
        return ExerciseList(map(translated, _once([each for found in _all_questions() for _, _, each in found.exercises])))
    require(folder, (str, Path), "The name of a folder")
    with file_errors(f'"{quotable(str(folder))}" cannot be read'):
        path = resolved(Path(folder))
    found = _added[path] = questions_in(path)
    if found.problems:
        raise ModelFileError(
            f"{len(found.problems)} mistake{'s' * (len(found.problems) > 1)}: {found.problems[0]}".rstrip("."),
            hint="lsys-kit exercises check FOLDER lists all of them.",
        )
    return ExerciseList(translated(exercise) for _, _, exercise in found.exercises)


@contextmanager
def known_for_a_while(folder: Path) -> Iterator[None]:
    """A `with` block in which the exercises of a folder are known."""
    before = dict(_added)
    try:
        exercises(folder)
        yield
    finally:
        _added.clear()
        _added.update(before)


def _once(found: Sequence[Record]) -> list[Record]:
    """What was found, without what a copy of a course has in common with it."""
    return [each for at, each in enumerate(found) if each not in found[:at]]


def _all_questions() -> Iterator[Questions]:
    """Those of the kit, of the course at hand, and of the folders that were added."""
    found = [place for place in places() if not place.is_kits]
    yield kit_questions()
    yield from (each for place in found if (each := questions_of(place)))
    yield from (each for path, each in _added.items() if path not in {place.questions.resolve() for place in found})


def questions_of(place: Place) -> Questions | None:
    """The exercises of a place, read again when a file has changed; None where there are none that can be read."""
    with suppress(OSError, ModelFileError):
        found = [path for path in place.questions.iterdir() if path.suffix == ".toml"]
        states = tuple((path.name, path.lstat().st_mtime_ns, path.lstat().st_size) for path in sorted(found))
        return _questions_as(place.questions, states) if states else None
    return None


@lru_cache(maxsize=64)
def _questions_as(folder: Path, _: object) -> Questions:
    return questions_in(folder)


def exercise_of(id: str) -> Exercise:
    """The exercise with an id.

    >>> exercise_of("1.1").id
    '1.1'
    """
    if not isinstance(id, str):
        raise ModelValueError('The id of an exercise must be a text such as "1.1"')
    wanted = id.strip()
    named = [exercise for questions in _all_questions() for _, _, exercise in questions.exercises if exercise.id == wanted]
    found = _once(named)
    if len(found) == 1:
        return translated(found[0])
    problem = next(
        (problem for questions in _all_questions() for problem in questions.problems if problem.exercise == wanted), None
    )
    if problem is not None:
        raise ModelFileError(f'Exercise "{quotable(wanted)}" cannot be used. {problem}'.rstrip("."))
    if found:
        raise ModelFileError(
            f'There are {len(found)} exercises with the id "{quotable(wanted)}"',
            hint="Give those in your own folder other ids, such as my.1.",
        )
    known = [exercise.id for exercise in exercises()]
    hint = suggestion(wanted[:20], known) or f"Exercises are: {', '.join(known)}."
    broken = next((problem for questions in _all_questions() for problem in questions.problems if not problem.exercise), None)
    raise ModelNameError(f'There is no exercise "{wanted[:20]}"', hint=f"{hint} {broken or ''}".strip())
