"""The files of exercises: read, with every mistake in them found and placed; one bad file stops no other.

The kit's own files are in the folder `questions`; a teacher's have the same form.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from lsys_kit.budget import Task, counted
from lsys_kit.classroom.exercises.declared.keys import Problem, Source, exercise_problems, lesson_problems, read_exercise
from lsys_kit.classroom.exercises.exercise import Exercise, Lesson
from lsys_kit.errors import ModelFileError, quotable

QUESTIONS = Path(__file__).parent.parent / "questions"
"""The kit's own files."""


@dataclass(frozen=True)
class Questions:
    """What a folder of exercises holds: the lessons that can be read, where each exercise stands, and what is wrong."""

    lessons: tuple[Lesson, ...]
    problems: tuple[Problem, ...]
    sources: tuple[tuple[Source, tuple[tuple[int, Exercise], ...]], ...]

    @property
    def exercises(self) -> Iterator[tuple[Source, int, Exercise]]:
        """Each exercise with its file and its number there."""
        for source, found in self.sources:
            yield from ((source, number, exercise) for number, exercise in found)


def questions_in(folder: Path) -> Questions:
    """The exercises in a folder, with all mistakes in its files.

    Raises
    ------
    ModelFileError
        There is no such folder, or no file of exercises in it.
    """
    try:
        files = sorted(path for path in folder.iterdir() if path.suffix == ".toml")
    except (OSError, ValueError) as fault:
        raise ModelFileError(f'"{quotable(str(folder))}" cannot be read: {getattr(fault, "strerror", None) or fault}') from None
    if not files:
        raise ModelFileError(f'There are no files of exercises in "{quotable(str(folder))}"', hint="Their names end in .toml.")
    lessons, problems, sources = [], [], []
    for path in files:
        with Task("The exercises were not read"):
            lesson, exercises, source, wrong = _file(path)
        lessons += [lesson] if lesson else []
        sources.append((source, exercises))
        problems += wrong
    found = Questions(tuple(lessons), tuple(problems), tuple(sources))
    return Questions(found.lessons, (*found.problems, *_duplicates(found)), found.sources)


def _duplicates(found: Questions) -> Iterator[Problem]:
    first: dict[str, tuple[str, int]] = {}
    for source, number, exercise in found.exercises:
        line = source.line_of(number, "id")
        if exercise.id in first:
            file, before = first[exercise.id]
            yield Problem(
                source.file,
                line,
                exercise.id,
                f'The id "{exercise.id}" stands in {file}, line {before} too',
                "Give one of them another.",
            )
        else:
            first[exercise.id] = source.file, line


def _file(path: Path) -> tuple[Lesson | None, tuple[tuple[int, Exercise], ...], Source, list[Problem]]:
    try:
        source = Source(path.name, path.read_text(encoding="utf-8"))
        declared = tomllib.loads(source.text)
    except tomllib.TOMLDecodeError as fault:
        line = re.search(r"line (\d+)", str(fault))
        return (
            None,
            (),
            source,
            [
                Problem(
                    path.name,
                    int(line[1]) if line else 1,
                    "",
                    quotable(str(fault)),
                    "Is a quotation mark or a bracket missing?",
                )
            ],
        )
    except (OSError, UnicodeDecodeError) as fault:
        return None, (), Source(path.name, ""), [Problem(path.name, 1, "", f"It cannot be read: {fault}", "Save it as UTF-8.")]
    problems = [*counted(lesson_problems(source, declared), 1)]
    exercises: list[tuple[int, Exercise]] = []
    for number, each in enumerate(declared.get("exercise", ()) if isinstance(declared.get("exercise", ()), list) else ()):
        found = [*counted(exercise_problems(source, number, each), 1)]
        problems += found
        if not found:
            exercises.append((number, read_exercise(each)))
    lesson = Lesson(
        path.stem,
        str(declared.get("title", path.stem)),
        tuple(declared.get("objectives", ())),
        str(declared.get("introduction", "")),
        str(declared.get("summary", "")),
        tuple(e for _, e in exercises),
    )
    return lesson, tuple(exercises), source, problems
