"""The page of a lesson's exercises, without Python and without a network: it checks answers, and tells a learning platform."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lsys_kit.classroom.exercises.exercise import Exercise, Lesson
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.panel.bundle import compact, style
from lsys_kit.classroom.panel.document import Program, document
from lsys_kit.classroom.scorm.answers import page_data
from lsys_kit.classroom.site.markdown import markdown_html
from lsys_kit.pictures.style.labels import escaped

_TOLD = """<div class="note"><p>This is practice, not an examination. What is right is in this page, hidden only so that nobody
reads it by chance. The learning platform is told how many of these exercises are solved, and when all of them are; how often
something was tried it is not told.</p></div>
"""
_NO_SCRIPTS = '<noscript><p class="note">Answers are checked by scripts, and this browser runs none.</p></noscript>\n'
_ASKED = {"number": "Your answer, a number", "table": "Your answer, numbers in order", "word": "Your answer, a word"}


def exercise_page(lesson: Lesson) -> str | None:
    """The page of a lesson as HTML; None if none of its exercises can be checked without Python.

    >>> from lsys_kit.classroom.exercises.declared.registry import lessons
    >>> exercise_page(lessons()[1]).count("data-exercise")
    3
    """
    checked = [(exercise, data) for exercise in lesson.exercises if (data := page_data(exercise))]
    if not checked:
        return None
    others = [exercise for exercise in lesson.exercises if exercise not in [each for each, _ in checked]]
    sections = "".join(_section(exercise) for exercise, _ in checked)
    body = (f'<a class="skip" href="#main">Skip to the exercises</a>\n<header><div id="told" role="status"></div></header>\n'
            f'<main id="main">\n<h1>Exercises: {escaped(lesson.title)}</h1>\n{_html(lesson.introduction)}{_TOLD}{_NO_SCRIPTS}'
            f"{sections}{_in_the_notebook(lesson, others)}<h2>Summary</h2>\n{_html(lesson.summary)}</main>\n")
    return document(f"Exercises: {lesson.title}", body, style("course"), f"Exercises: {lesson.title}",
                    _program([data for _, data in checked]))


def _program(exercises: Sequence[dict[str, Any]]) -> Program:
    script = f'"use strict";\n{compact("practice")}\nopenPracticePage();\n'
    return Program(script, style("lessons") + style("practice"), {"exercises": list(exercises)})


def _html(text: str) -> str:
    """Markdown as HTML, in which links lead nowhere."""
    return markdown_html(text, lambda address: None)


def _section(exercise: Exercise) -> str:
    """An exercise: its question, what is typed or chosen, and room for the reply and for hints."""
    title = f"{escaped(exercise.id)} {escaped(exercise.title)}"
    replies = '<div class="lsys-said" role="status"></div><div data-hints></div>'
    return (f'<section data-exercise="{escaped(exercise.id)}" aria-label="{title}">\n<h2>{title}</h2>\n'
            f'{_html(exercise.question)}<div class="lsys-lesson">{_answering(exercise)}{replies}</div>\n</section>\n')


def _answering(exercise: Exercise) -> str:
    """Buttons to choose from, or a box to type in."""
    if exercise.kind == "choice":
        options = zip(letters(exercise), exercise.options, strict=True)
        return _buttons("", [(letter, _inline(option.text)) for letter, option in options])
    if exercise.kind == "line":
        lines = enumerate(exercise.text.strip("\n").splitlines(), 1)
        return _buttons(" lsys-lines", [(str(at), f"<code>{escaped(line)}</code>") for at, line in lines])
    field = f"answer-{escaped(exercise.id)}"
    return (f'<form class="lsys-predict"><label for="{field}">{_ASKED[exercise.kind]}</label><input id="{field}" type="text" '
            'autocomplete="off" autocapitalize="off" spellcheck="false"><button type="submit">Check</button></form>')


def _buttons(kind: str, options: Sequence[tuple[str, str]]) -> str:
    inside = "".join(f'<button type="button" class="lsys-option" data-key="{key}" aria-pressed="false">'
                     f'<b class="lsys-letter">{key}</b><span>{html}</span></button>' for key, html in options)
    return f'<div class="lsys-options{kind}" role="group" aria-label="Your answer">{inside}</div>'


def _inline(text: str) -> str:
    """Markdown of one line, without the paragraph around it."""
    return _html(text).strip().removeprefix("<p>").removesuffix("</p>")


def _in_the_notebook(lesson: Lesson, others: Sequence[Exercise]) -> str:
    """The exercises that only the kit itself can check."""
    if not others:
        return ""
    listed = "".join(f"<li>{escaped(each.id)} {escaped(each.title)}</li>\n" for each in others)
    notebook = f"<code>{escaped(lesson.name)}.ipynb</code>"
    return ("<h2>In the notebook</h2>\n<p>Systems, drawings, formulas and diagrams can be right in many ways. The kit itself "
            f"checks them, in the notebook {notebook}, which <code>lsys-kit lab</code> opens. They do not count here:</p>\n"
            f"<ul>\n{listed}</ul>\n")
