"""The page of a lesson's exercises, without Python and without a network: it checks answers, and tells a learning platform.

A page has the replies to all answers that are understood, right and wrong ones, by the answers in a normal form, into which
`practice/typed.js` brings what is typed. They are deflated, so that nobody reads them by chance. That is a courtesy and no
secret: whoever inflates them finds the right answers.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any

from lsys_kit.classroom.exercises.check import checked, picture_of
from lsys_kit.classroom.exercises.exercise import Exercise, Lesson
from lsys_kit.classroom.exercises.judging import wrong_answers
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS, solution_of
from lsys_kit.classroom.exercises.kinds.words import system_of_words
from lsys_kit.classroom.exercises.registry import translated_lesson
from lsys_kit.classroom.exercises.typed import UNITS
from lsys_kit.classroom.panel.bundle import Data, compact, style, translated_words
from lsys_kit.classroom.panel.document import Program, deflated_text, document
from lsys_kit.classroom.site.markdown import markdown_html
from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import symbols
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.translation import gettext, language

PARTS_OF_A_TOLERANCE = 10
"""A number that need not be exact is rounded to so many parts of its tolerance in its normal form."""
DIFFERENT = "Something in it is different. Do it again, one step after another."


def page_data(exercise: Exercise) -> Data | None:
    """What a page needs to check an exercise; None where only Python can check it.

    >>> exercise = Exercise("1", "", "number", "How many?", "21", "Count.", ("Look.",), otherwise="Count again.")
    >>> data = page_data(exercise)
    >>> data["kind"], data["otherwise"], len(data["replies"]) > 0, "21" in data["replies"]
    ('number', 'Count again.', True, False)
    """
    if exercise.kind not in _ANSWERS:
        return None
    with suppress(LSystemError, _NotExact):
        replies = {key: _reply(exercise, answer) for key, answer in sorted(_ANSWERS[exercise.kind](exercise).items())}
        return {
            "id": exercise.id,
            "kind": exercise.kind,
            "hints": list(exercise.hints),
            "otherwise": _otherwise(exercise),
            "replies": deflated_text(json.dumps(replies)),
            **_reading(exercise),
        }
    return None


class _NotExact(Exception):
    """An answer has no exact normal form."""


def _reply(exercise: Exercise, answer: object) -> tuple[str, ...]:
    """What the kit itself says to an answer, a verdict and a message; to a right one why it is right, with a picture if there
    is one."""
    verdict = checked(exercise, answer, 0, False, "")
    if verdict.said != "Correct":
        return verdict.said, verdict.message
    return verdict.said, exercise.explanation, *filter(None, [picture_of(exercise)])


# Normal forms


def number_key(number: Value) -> str:
    """A number in its normal form, a fraction in lowest terms; a double is the number that is printed for it.

    >>> number_key(21), number_key(Fraction(-3, 6)), number_key(0.1)
    ('21/1', '-1/2', '1/10')
    """
    try:
        exact = Fraction(repr(number) if isinstance(number, float) else number)
    except (TypeError, ValueError, OverflowError):
        raise _NotExact from None
    return f"{exact.numerator}/{exact.denominator}"


def rounded_key(number: Value, part: Fraction) -> str:
    """A number in its normal form where it need not be exact: how often a part goes into it, rounded."""
    return f"~{math.floor(Fraction(number) / part + Fraction(1, 2))}"


def word_key(word: tuple[Module, ...]) -> str:
    """A word in its normal form: its modules with blanks between them, numbers as fractions.

    >>> from lsys_kit.notation.read import read_word
    >>> word_key(read_word("M_r(0.5)a"))
    'M_r(1/2) a'
    """
    return " ".join(each.symbol + (f"({','.join(map(number_key, each.arguments))})" if each.arguments else "") for each in word)


# The answers of each kind that are understood, by their normal forms: those that are wrong, then the right one


def _options(exercise: Exercise) -> Data:
    return {letter: letter for letter in letters(exercise)}


def _lines(exercise: Exercise) -> Data:
    return {str(number): number for number in range(1, len(exercise.text.strip("\n").splitlines()) + 1)}


def _numbers(exercise: Exercise) -> Data:
    if exercise.tolerance:
        return _rounded_numbers(exercise)
    if isinstance(solution_of(exercise), float):
        raise _NotExact
    return {number_key(answer): answer for answer in _answers(exercise)}


def _rounded_numbers(exercise: Exercise) -> Data:
    part, solution = Fraction(exercise.tolerance) / PARTS_OF_A_TOLERANCE, Fraction(solution_of(exercise))
    near = range(-PARTS_OF_A_TOLERANCE, PARTS_OF_A_TOLERANCE + 1)
    right = {rounded_key(solution + at * part, part): solution for at in near}
    wrong = {rounded_key(each.answer, part): each.answer for each in wrong_answers(exercise)}
    if right.keys() & wrong.keys():
        raise _NotExact
    return {**wrong, **right}


def _tables(exercise: Exercise) -> Data:
    if exercise.tolerance:
        raise _NotExact
    return {",".join(map(number_key, answer)): answer for answer in _answers(exercise)}


def _words(exercise: Exercise) -> Data:
    return {word_key(answer): list(answer) for answer in _answers(exercise)}


def _answers(exercise: Exercise) -> Iterator[Any]:
    yield from (wrong.answer for wrong in wrong_answers(exercise))
    yield solution_of(exercise)


_ANSWERS: Mapping[str, Callable[[Exercise], Data]] = {
    "choice": _options,
    "line": _lines,
    "number": _numbers,
    "table": _tables,
    "word": _words,
}
"""The kinds of answers that a page can check."""


# What else the page needs


def _otherwise(exercise: Exercise) -> str:
    if exercise.otherwise or exercise.kind != "number":
        return exercise.otherwise or gettext(DIFFERENT)
    solution = solution_of(exercise)
    message = ANSWER_KINDS["number"].difference(exercise, 10 * abs(math.ceil(solution)) + 10, solution).message
    return message.partition(". ")[2] or gettext("Look at the question once more.")  # behind the sentence with the number


def _reading(exercise: Exercise) -> Data:
    if exercise.kind == "word":
        return {"symbols": sorted(symbols(system_of_words(exercise)), key=lambda symbol: (-len(symbol), symbol))}
    if exercise.kind != "number":
        return {}
    part = Fraction(exercise.tolerance) / PARTS_OF_A_TOLERANCE
    unit = exercise.unit if exercise.unit.lower() in UNITS else gettext(exercise.unit)
    return {
        "unit": unit,
        "known": f"{exercise.question} {exercise.unit} {unit}".lower(),
        "part": [str(part.numerator), str(part.denominator)] if part else None,
    }


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
        f'{_html(lesson.introduction)}<div class="note"><p>{gettext(_TOLD)}</p></div>\n'
        f'<noscript><p class="note">{gettext("Answers are checked by scripts, and this browser runs none.")}</p></noscript>\n'
        f"{sections}{_in_the_notebook(lesson, others)}<h2>{gettext('Summary')}</h2>\n{_html(lesson.summary)}</main>\n"
    )
    return document(title, body, style("course"), title, _program([data for _, data in checked]), language())


def _program(exercises: Sequence[Data]) -> Program:
    script = f'"use strict";\n{compact("practice")}\nopenPracticePage();\n'
    return Program(
        script, style("lessons") + style("practice"), {"exercises": list(exercises), "words": translated_words("practice")}
    )


def _html(text: str) -> str:
    return markdown_html(text, lambda address: None)  # links lead nowhere


def _section(exercise: Exercise) -> str:
    title = f"{escaped(exercise.id)} {escaped(exercise.title)}"
    replies = '<div class="lsys-said" role="status"></div><div data-hints></div>'
    return (
        f'<section data-exercise="{escaped(exercise.id)}" aria-label="{title}">\n<h2>{title}</h2>\n'
        f'{_html(exercise.question)}<div class="lsys-lesson">{_answering(exercise)}{replies}</div>\n</section>\n'
    )


def _answering(exercise: Exercise) -> str:
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
    return _html(text).strip().removeprefix("<p>").removesuffix("</p>")


def _in_the_notebook(lesson: Lesson, others: Sequence[Exercise]) -> str:
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
