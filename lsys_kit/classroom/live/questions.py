"""What a teacher can open for a class: the votes, predictions and tables of the lessons, and the exercises."""

from __future__ import annotations

import ast
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from lsys_kit.classroom.exercises.registry import all_lessons as lessons_with_exercises
from lsys_kit.classroom.lessons.lesson import Blank, Lesson, Option, Table, declared_in, lesson, table
from lsys_kit.classroom.lessons.vote import vote
from lsys_kit.classroom.lessons.widget import prose_text
from lsys_kit.classroom.lessons.worksheet import RIGHT, marked
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.classroom.places import course_at_hand, key_of
from lsys_kit.errors import LSystemError, ModelNameError, quotable
from lsys_kit.files import file_errors

VOTE, PREDICTION, TABLE, EXERCISE = "vote", "prediction", "table", "exercise"
ROUNDS: Mapping[str, int] = {VOTE: 2, PREDICTION: 1, TABLE: 1, EXERCISE: 1}
"""How often a question of each kind is asked: a vote twice."""


@dataclass(frozen=True)
class Question:
    """A question that can be opened.

    Attributes
    ----------
    kind, about
        "vote" and the number of the lesson; or "prediction", "table" or "exercise" and what names it.
    title
        What the teacher's list says.
    lesson
        The number of its lesson.
    page
        The page on which students find it.
    """

    kind: str
    about: str
    title: str
    lesson: str
    page: str


@cache
def questions() -> Mapping[tuple[str, str], Question]:
    """All questions, lesson by lesson, by their kinds and names.

    >>> questions()["vote", "01"].page
    'notebooks/01_all_at_once.html'
    >>> questions()["prediction", "01:1"].title
    'Step 3 is al al br al br. What is the word of step 4?'
    """
    found = (declared_in(place, name) for place, name in course_at_hand().lessons)
    return {(each.kind, each.about): each for of in found if of for each in _of_lesson(of)}


def _of_lesson(of: Lesson) -> Iterator[Question]:
    number, page = of.key, f"notebooks/{of.name}.html"
    if of.vote:
        yield Question(VOTE, number, prose_text(of.vote.question), number, page)
    for place, asked in enumerate(predictions(of.name), 1):
        yield Question(PREDICTION, f"{number}:{place}", prose_text(asked), number, page)
    for each in of.tables:
        yield Question(TABLE, f"{number}:{each.id}", prose_text(each.title), number, page)
    for told in lessons_with_exercises():
        if told.name == of.name:
            for exercise in told.exercises:
                yield Question(EXERCISE, exercise.id, f"{exercise.id} {exercise.title}", number, f"exercises/{of.name}.html")


@cache
def predictions(name: str) -> tuple[str, ...]:
    """What a lesson lets students predict: the questions in its notebook, in their order."""

    place = next(place for place, each in course_at_hand().lessons if each == name)
    path = place.notebooks / f"{name}.ipynb"
    with file_errors(f'"{quotable(str(path))}" cannot be read'):
        cells = json.loads(path.read_text("utf-8"))["cells"]
    sources = ("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    return tuple(asked for source in sources for asked in _asked_in(source))


def about_prediction(text: str) -> str | None:
    """What names a prediction that a lesson asks for; None where none does.

    >>> about_prediction("Step 3 is `al al br al br`. What is the word of step 4?")
    '01:1'
    """
    known = (name for _, name in course_at_hand().lessons)
    found = (f"{key_of(name)}:{place}" for name in known for place, each in enumerate(predictions(name), 1) if each == text)
    return next(found, None)


def _asked_in(source: str) -> Iterator[str]:
    """The questions of the calls of `predict` in a cell, which is read and not run."""
    try:
        tree = ast.parse(source)
    except SyntaxError:
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "predict" and node.args:
            first = node.args[0]
            if isinstance(first, ast.Constant) and isinstance(first.value, str):
                yield first.value.strip()


def question(kind: str, about: str) -> Question:
    """The question of a kind and name.

    Raises
    ------
    ModelNameError
        There is none.
    """
    found = questions().get((kind, about))
    if found is None:
        raise ModelNameError(f'There is no {quotable(kind)} "{quotable(about)}" to open')
    return found


def named(kind: str, about: str, asked: str = "") -> Question:
    """The question that a page of the course asks, which knows its lesson and what it says.

    >>> named("table", "01", "Without the line `br -> ar`").about
    '01:missing-rule'
    """
    if asked:
        texts: Sequence[str] = ()
        if kind == PREDICTION:
            texts = [f"{about}:{place}" for place, text in enumerate(predictions(lesson(about).name), 1) if text == asked]
        elif kind == TABLE:
            texts = [f"{about}:{each.id}" for each in lesson(about).tables if each.title == asked]
        about = next(iter(texts), "")
    return question(kind, about)


def asked_of(question: Question) -> Data:
    """What a phone and the board show of a question; nothing in it says what is right."""
    if question.kind == VOTE:
        return dict(_ballot(question.lesson)["asked"])
    if question.kind == TABLE:
        return sheet_of(table_of(question))
    return in_words(question)


def in_words(question: Question) -> Data:
    """What a question asks in words, for which nothing has to be drawn.

    >>> in_words(questions()["prediction", "01:1"])
    {'question': 'Step 3 is `al al br al br`. What is the word of step 4?'}
    """
    of = lesson(question.lesson)
    if question.kind == VOTE and of.vote:
        return {"question": of.vote.question, "options": [each.text for each in of.vote.options]}
    if question.kind == PREDICTION:
        return {"question": predictions(of.name)[int(question.about.partition(":")[2]) - 1]}
    return {"question": question.title}


def sheet_of(found: Table) -> Data:
    rows = [[None if isinstance(cell, Blank) else cell for cell in row] for row in found.rows]
    return {"question": found.title, "columns": list(found.columns), "rows": rows}


def table_of(question: Question) -> Table:
    return table(question.lesson, question.about.partition(":")[2])


@cache
def _ballot(number: str) -> Data:
    box = vote(number, again=True)
    try:
        return box.page_data
    finally:
        box.close()


def right_option(number: str) -> int:
    """The number of the right option of a vote, from 0 on."""
    return next(place for place, each in enumerate(_options(number)) if each.right)


def replies(number: str) -> list[str]:
    """What is said to whoever has voted for each option."""
    return [each.reply for each in _options(number)]


def _options(number: str) -> tuple[Option, ...]:
    of = lesson(number)
    if of.vote is None:
        raise ModelNameError(f"The lesson {of.name} has no vote")
    return of.vote.options


def right_cells(found: Table, entries: Sequence[object]) -> list[bool | None]:
    """For each cell to fill whether an entry is right; None where nothing was entered.

    >>> right_cells(table("01", "counts"), ["2", "3"])[:3]
    [True, False, None]
    """
    texts = [str(each) for each in entries[: len(found.blanks)]]
    marks = marked(found, texts)
    return [
        None if not text.strip() else mark == RIGHT for text, mark in zip([*texts, *[""] * len(marks)], marks, strict=False)
    ]


def value_of(question: Question, value: object) -> object:
    """What was said to a question, as it is kept.

    Raises
    ------
    LSystemError
        It cannot be an answer to it.
    """
    if question.kind == VOTE and type(value) is int and 0 <= value < len(replies(question.lesson)):
        return value
    if question.kind == PREDICTION and isinstance(value, str) and value.strip():
        return " ".join(value.split())[:MOST_TYPED]
    if question.kind == TABLE and isinstance(value, list) and all(isinstance(each, str) for each in value):
        return [each[:MOST_TYPED] for each in value[: len(table_of(question).blanks)]]
    raise LSystemError(f"This is no answer to a {question.kind}")


MOST_TYPED = 100
"""So many characters are kept of what is typed into a box."""
