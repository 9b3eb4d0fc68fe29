"""The page of a lesson's exercises, without Python and without a network: it checks answers, and tells a learning platform."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lsys_kit.classroom.exercises.exercise import Exercise, Lesson
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.registry import translated_lesson
from lsys_kit.classroom.panel.bundle import compact, style
from lsys_kit.classroom.panel.document import Program, document
from lsys_kit.classroom.scorm.answers import page_data
from lsys_kit.classroom.site.markdown import markdown_html
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.translation import gettext, language

WORDS = (
    "Correct",
    "Almost",
    "Not yet",
    "Not readable yet",
    "Not answered yet",
    "{number} of {total} solved.",
    "The learning platform knows: score {score} of 100, completed.",
    "The learning platform knows: score {score} of 100, incomplete.",
    "The learning platform did not take the score.",
    "The learning platform cannot be read, so that nothing is written there.",
    "No learning platform is there: nobody is told.",
    "You solved this before.",
    "Hint {number} of {total}",
    "That is longer than {most} characters.",
    "A number is needed here, such as 21, 0.5 or 3/4.",
    "Its unit is: {unit}.",
    "Write the number alone.",
    '"{text}" is no number.',
    "Numbers are needed here, such as 1, 2, 3.",
    'The question has no symbol "{symbol}". The symbols are: {symbols}.',
    "The numbers behind {symbol} cannot be read.",
    "A word is needed here.",
)
"""What the scripts of a page say by themselves."""
_TOLD = (
    "This is practice, not an examination. What is right is in this page, hidden only so that nobody reads it by chance. "
    "The learning platform is told how many of these exercises are solved, and when all of them are, and keeps what was "
    "typed last; how often something was tried it is not told."
)
ASKED = {"number": "Your answer, a number", "table": "Your answer, numbers in order", "word": "Your answer, a word"}


def exercise_page(lesson: Lesson) -> str | None:
    """The page of a lesson as HTML; None if none of its exercises can be checked without Python.

    >>> from lsys_kit.classroom.exercises.registry import lessons
    >>> exercise_page(lessons()[1]).count("data-exercise")
    3
    """
    lesson = translated_lesson(lesson)
    checked = [(exercise, data) for exercise in lesson.exercises if (data := page_data(exercise))]
    if not checked:
        return None
    others = [exercise for exercise in lesson.exercises if exercise not in [each for each, _ in checked]]
    sections = "".join(_section(exercise) for exercise, _ in checked)
    title = gettext("Exercises: {lesson}", lesson=lesson.title)
    body = (
        f'<a class="skip" href="#main">{gettext("Skip to the exercises")}</a>\n'
        f'<header><div id="told" role="status"></div></header>\n<main id="main">\n<h1>{escaped(title)}</h1>\n'
        f'{_html(lesson.introduction)}<div class="note"><p>{gettext(_TOLD)}</p></div>\n{_without_scripts()}'
        f"{sections}{_in_the_notebook(lesson, others)}<h2>{gettext('Summary')}</h2>\n{_html(lesson.summary)}</main>\n"
    )
    return document(title, body, style("course"), title, _program([data for _, data in checked]), language())


def _without_scripts() -> str:
    said = gettext("Answers are checked by scripts, and this browser runs none.")
    return f'<noscript><p class="note">{said}</p></noscript>\n'


def _program(exercises: Sequence[dict[str, Any]]) -> Program:
    script = f'"use strict";\n{compact("practice")}\nopenPracticePage();\n'
    return Program(script, style("lessons") + style("practice"), {"exercises": list(exercises), "words": words_of_page()})


def words_of_page() -> dict[str, str]:
    """The texts that another language has other words for."""
    return {text: gettext(text) for text in WORDS if gettext(text) != text}


def _html(text: str) -> str:
    """Markdown as HTML, in which links lead nowhere."""
    return markdown_html(text, lambda address: None)


def _section(exercise: Exercise) -> str:
    """An exercise: its question, what is typed or chosen, and room for the reply and for hints."""
    title = f"{escaped(exercise.id)} {escaped(exercise.title)}"
    replies = '<div class="lsys-said" role="status"></div><div data-hints></div>'
    return (
        f'<section data-exercise="{escaped(exercise.id)}" aria-label="{title}">\n<h2>{title}</h2>\n'
        f'{_html(exercise.question)}<div class="lsys-lesson">{_answering(exercise)}{replies}</div>\n</section>\n'
    )


def _answering(exercise: Exercise) -> str:
    """Buttons to choose from, or a box to type in."""
    if exercise.kind == "choice":
        options = zip(letters(exercise), exercise.options, strict=True)
        return _buttons("", [(letter, _inline(option.text)) for letter, option in options])
    if exercise.kind == "line":
        lines = enumerate(exercise.text.strip("\n").splitlines(), 1)
        return _buttons(" lsys-lines", [(str(at), f"<code>{escaped(line)}</code>") for at, line in lines])
    field = f"answer-{escaped(exercise.id)}"
    label, check = gettext(ASKED[exercise.kind]), gettext("Check")
    return (
        f'<form class="lsys-predict"><label for="{field}">{label}</label><input id="{field}" type="text" '
        f'autocomplete="off" autocapitalize="off" spellcheck="false"><button type="submit">{check}</button></form>'
    )


def _buttons(kind: str, options: Sequence[tuple[str, str]]) -> str:
    inside = "".join(
        f'<button type="button" class="lsys-option" data-key="{key}" aria-pressed="false">'
        f'<b class="lsys-letter">{key}</b><span>{html}</span></button>'
        for key, html in options
    )
    return f'<div class="lsys-options{kind}" role="group" aria-label="{gettext("Your answer")}">{inside}</div>'


def _inline(text: str) -> str:
    """Markdown of one line, without the paragraph around it."""
    return _html(text).strip().removeprefix("<p>").removesuffix("</p>")


def _in_the_notebook(lesson: Lesson, others: Sequence[Exercise]) -> str:
    """The exercises that only the kit itself can check."""
    if not others:
        return ""
    listed = "".join(f"<li>{escaped(each.id)} {escaped(each.title)}</li>\n" for each in others)
    notebook = f"<code>{escaped(lesson.name)}.ipynb</code>"
    said = gettext(
        "Systems, drawings, formulas and diagrams can be right in many ways. The kit itself checks them, in the "
        "notebook {notebook}, which {command} opens. They do not count here:",
        notebook=notebook,
        command="<code>lsys-kit lab</code>",
    )
    return f"<h2>{gettext('In the notebook')}</h2>\n<p>{said}</p>\n<ul>\n{listed}</ul>\n"
