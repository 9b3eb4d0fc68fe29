"""The notebooks in the folder `exercises`, made from the declarations and never edited by hand.

The output of a cell is what `check` returns when the notebook is written, so that no kernel is needed and the file is the same
on every machine. `python -m lsys_kit.classroom.exercises.notebooks exercises` writes them all.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import Any, TypeAlias

from lsys_kit.classroom.course import copy_report, put_files
from lsys_kit.classroom.exercises.check import check
from lsys_kit.classroom.exercises.declarations import MOST_BYTES, QUESTIONS, questions_in
from lsys_kit.classroom.exercises.exercise import Exercise, Lesson
from lsys_kit.classroom.exercises.kinds.choices import listing
from lsys_kit.classroom.exercises.progress import Progress, Record, progress_of
from lsys_kit.classroom.exercises.registry import known_for_a_while, translated_lesson
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.verdict import Verdict
from lsys_kit.classroom.handed_in import content_of
from lsys_kit.classroom.places import Course
from lsys_kit.errors import ModelFileError, quotable
from lsys_kit.files import file_errors, replace_file
from lsys_kit.translation import ENGLISH, language

NotebookCell: TypeAlias = dict[str, Any]


def exercise_notebook(lesson: Lesson, folder: str = "", linked: bool = True) -> str:
    """The notebook of a lesson's exercises, as the text of its file; `folder` has their questions, if these do not lie where
    they are found. It is linked with the notebook of the lesson, if there is one.

    >>> from lsys_kit.classroom.exercises.registry import lessons
    >>> json.loads(exercise_notebook(lessons()[0]))["cells"][1]["source"]
    ['from lsys_kit import check, progress']
    """
    notebook = {
        "cells": list(_with_execution_counts(_cells(lesson, folder, linked))),
        "metadata": {
            "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(notebook, indent=1, ensure_ascii=False, sort_keys=True) + "\n"


def exercise_notebooks(
    questions: str | Path = QUESTIONS, where: str = "", linked: Collection[str] | None = None
) -> dict[str, bytes]:
    """The notebooks of all lessons whose questions are in a folder, by default the kit's, by the names of their files.

    questions
        The folder.
    where
        Where the notebooks find it, if it is not where exercises are found.
    linked
        The lessons that have a notebook, by their names; by default all have one.

    Raises
    ------
    ModelFileError
        There are mistakes in the files of questions.
    """
    with known_for_a_while(Path(questions)) if Path(questions) != QUESTIONS else nullcontext():
        lessons = [lesson for lesson in map(translated_lesson, questions_in(Path(questions)).lessons) if lesson.exercises]
        return {
            f"{lesson.name}.ipynb": exercise_notebook(lesson, where, linked is None or lesson.name in linked).encode()
            for lesson in lessons
        }


OWN_QUESTIONS = "questions"
"""The folder beside notebooks of one's own exercises that has their questions, so that both are handed out together."""


def write_notebooks(folder: str | Path, questions: str | Path) -> str:
    """Write the notebooks of a folder of questions into another one, with the questions beside them, and say what became of
    them. A notebook in which somebody has worked is kept, and its new version put beside it.
    """
    notebooks = exercise_notebooks(questions, OWN_QUESTIONS, ())
    for name in [*notebooks]:
        name = name.removesuffix(".ipynb") + ".toml"
        notebooks[f"{OWN_QUESTIONS}/{name}"] = content_of(Path(questions) / name, MOST_BYTES)
    with file_errors(f'The notebooks cannot be written to "{quotable(str(folder))}"'):
        return copy_report("The notebooks are", folder, put_files(Path(folder), notebooks))


def renew_exercises(course: Course) -> None:
    """Write the notebooks of the exercises of a course that are not the kit's, where their questions have changed."""
    for place in course.places:
        if not place.is_kits and any(place.questions.glob("*.toml")):
            with_notebook = [name for name in place.names() if (place.notebooks / f"{name}.ipynb").is_file()]
            made = exercise_notebooks(place.questions, "", with_notebook)
            named = {f"{place.questions.name}/{name}": content for name, content in made.items()}
            if any(_content(place.root / name) != content for name, content in named.items()):
                with file_errors(f'The exercises cannot be written to "{quotable(str(place.questions))}"'):
                    put_files(place.root, named)


def _content(path: Path) -> bytes:
    with suppress(ModelFileError):
        return content_of(path, 2 * MOST_BYTES)
    return b""


def _cells(lesson: Lesson, folder: str, linked: bool) -> Iterator[NotebookCell]:
    yield _markdown("head", _introduction(lesson, linked))
    yield _code("import", _beginning(folder))
    for exercise in lesson.exercises:
        yield from _exercise_cells(exercise)
    back = f"[{reply('notebook.back')}](../notebooks/{lesson.name}.ipynb)" if linked else ""
    if lesson.summary or linked:
        yield _markdown("summary", "\n\n".join(filter(None, [f"## {reply('notebook.summary')}", lesson.summary, back])))
    all_lessons = reply("notebook.all_lessons")
    yield _code("progress", f'progress("{lesson.name}")   # {all_lessons}', _shown(progress_of(Record(), lesson.name)))
    yield _markdown("marks", reply("notebook.marks"))
    yield from map(_score_cell, lesson.exercises)


def _beginning(folder: str) -> str:
    """The first cell: what is imported, the language in which the notebook is written, and the folder of its questions."""
    lines = {"exercises": f"exercises({json.dumps(folder)});"} if folder else {}
    if language() != ENGLISH:
        lines["language"] = f"language({json.dumps(language())});"
    return "\n".join([f"from lsys_kit import {', '.join(sorted(['check', 'progress', *lines]))}", *lines.values()])


def _introduction(lesson: Lesson, linked: bool) -> str:
    objectives = "\n".join(f"- {objective}" for objective in lesson.objectives)
    goes_with = reply("notebook.lesson", lesson=f"[{lesson.title}](../notebooks/{lesson.name}.ipynb)") if linked else ""
    parts = [
        f"# {reply('notebook.title', title=lesson.title)}",
        f"{lesson.introduction} {goes_with}".strip(),
        f"**{reply('notebook.afterwards')}**\n\n{objectives}" if objectives else "",
        reply("notebook.how", id=lesson.exercises[0].id),
    ]
    return "\n\n".join(filter(None, parts))


def _exercise_cells(exercise: Exercise) -> Iterator[NotebookCell]:
    name = f"exercise-{exercise.id.replace('.', '-')}"
    yield _markdown(name, f"## {exercise.id} {exercise.title}\n\n{exercise.question.strip()}{listing(exercise)}")
    yield _code(f"{name}-answer", f'answer = {_template(exercise)}\ncheck("{exercise.id}", answer)', _shown(check(exercise.id)))
    if exercise.hints:
        hints = reply("notebook.hints", number=len(exercise.hints))
        yield _code(f"{name}-hints", f'# check("{exercise.id}", answer, hint=1)   # {hints}')


def _score_cell(exercise: Exercise) -> NotebookCell:
    """A locked cell that nbgrader takes a point from, or part of it (nbgrader's metadata of cells, version 3).

    The cells for answers are not declared as solutions: nbgrader would put a text of its own in the place of their templates.
    """
    name = f"score-{re.sub('[^A-Za-z0-9_-]', '-', exercise.id)}"
    cell = _code(name, f'from lsys_kit import score\n\nscore("{exercise.id}")', {"text/plain": ["0.0"]})
    flags = {"grade": True, "locked": True, "solution": False, "task": False}
    return {**cell, "metadata": {"nbgrader": {"schema_version": 3, "grade_id": name, "points": 1, **flags}}}


def _template(exercise: Exercise) -> str:
    text = exercise.template.strip("\n")
    return text if text == "..." else f'"""\n{text}\n"""' if "\n" in text else f'"{text}"'


def _markdown(name: str, text: str) -> NotebookCell:
    return {"cell_type": "markdown", "id": name, "metadata": {}, "source": _source_lines(text)}


def _code(name: str, text: str, data: Mapping[str, list[str]] | None = None) -> NotebookCell:
    output = {"data": data, "execution_count": None, "metadata": {}, "output_type": "execute_result"}
    return {**_markdown(name, text), "cell_type": "code", "execution_count": None, "outputs": [output] if data else []}


def _shown(value: Verdict | Progress) -> dict[str, list[str]]:
    return {"text/html": _source_lines(value._repr_html_()), "text/plain": _source_lines(repr(value))}


def _with_execution_counts(cells: Iterable[NotebookCell]) -> Iterator[NotebookCell]:
    """The cells with the execution counts of a first run from top to bottom."""
    number = 0
    for cell in cells:
        if cell["cell_type"] == "code":
            number += 1
            cell["execution_count"] = number
            for output in cell["outputs"]:
                output["execution_count"] = number
        yield cell


def _source_lines(text: str) -> list[str]:
    return text.splitlines(keepends=True)


if __name__ == "__main__":
    for name, content in exercise_notebooks().items():
        replace_file(Path(sys.argv[1] if len(sys.argv) > 1 else "exercises") / name, content)
