"""Exercises of all kinds, and answers to them: right ones in five forms, wrong ones as somebody types them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from decimal import Decimal
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lsys_kit import derive, exercises, read, read_map
from lsys_kit.classroom.exercises import registry
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.judging import WrongAnswer, wrong_answers
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.kinds.nets import Net
from lsys_kit.classroom.exercises.kinds.table import solution_of
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.expressions import to_sympy
from lsys_kit.notation.model.modules import joined
from lsys_kit.notation.read import read_expression

OF_EACH_KIND = Path(__file__).parent / "questions"


@contextmanager
def of_each_kind_added() -> Iterator[None]:
    """The folder with exercises of each kind is added, as that of a teacher, and forgotten afterwards."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(registry, "_added", {})
        exercises(OF_EACH_KIND)
        yield


with of_each_kind_added():
    EXERCISES = exercises()


@cache
def wrong_answers_to(exercise: Exercise) -> list[WrongAnswer]:
    """The wrong answers to an exercise that are understood."""
    return list(wrong_answers(exercise))


def right_answers(exercise: Exercise) -> list[object]:
    """The solution in five forms."""
    return _FORMS[exercise.kind](exercise, exercise.solution.strip())


def _word(exercise: Exercise, text: str) -> list[object]:
    symbols = [str(module) for module in solution_of(exercise)]
    return [text, f"  {joined(symbols)}\n", ", ".join(symbols), symbols, "\n".join(symbols)]


def _words(exercise: Exercise, text: str) -> list[object]:
    words = [joined(map(str, word)) for word in solution_of(exercise)]
    return [
        "\n".join(words),
        "; ".join(words),
        words,
        tuple(words),
        "\n".join(f"{number}  {word}" for number, word in enumerate(words)),
    ]


def _number(exercise: Exercise, text: str) -> list[object]:
    number = solution_of(exercise)
    return [
        text,
        f" N = {text} ",
        Decimal(text) if "/" not in text else Fraction(text),
        Fraction(number),
        f"{number_text(number)} {exercise.unit}".strip(),
    ]


def _table(exercise: Exercise, text: str) -> list[object]:
    numbers = list(solution_of(exercise))
    return [text, numbers, tuple(numbers), str([*map(number_text, numbers)]).replace("'", ""), np.array(numbers)]


def _choice(exercise: Exercise, text: str) -> list[object]:
    option = exercise.options[letters(exercise).index(text)]
    return [text, text.lower(), f"({text})", f"option {text}", option.text]


def _symbol(exercise: Exercise, text: str) -> list[object]:
    other = [int(text), f"position {text}"] if text.isdigit() else [f"'{text}'", f"symbol {text}"]
    return [text, f" {text} ", f'"{text}"', *other]


def _line(exercise: Exercise, text: str) -> list[object]:
    return [text, int(text), f"line {text}", f"Line {text}.", exercise.text.strip("\n").splitlines()[int(text) - 1]]


def _system(exercise: Exercise, text: str) -> list[object]:
    whole = read(f"{exercise.given}\n{text}")
    return [text, f"\n{text}\n\n", text.replace("->", "→"), whole, f"/* mine */\n{text}"]


def _map(exercise: Exercise, text: str) -> list[object]:
    whole = f"{exercise.given}\n{text}"
    return [text, f"\n{text}\n\n", text.replace("->", "→"), read_map(whole), whole]


def _expression(exercise: Exercise, text: str) -> list[object]:
    exact = to_sympy(read_expression(text))
    return [text, f"N = {text}", text.replace("^", "**"), f"${text}$", exact]


def _drawing(exercise: Exercise, text: str) -> list[object]:
    if "->" in text:
        system = read(text)
        return [text, f"\n{text}\n", system, derive(system, exercise.steps), text.replace("->", "→")]
    symbols = [str(module) for module in solution_of(exercise).derivation[0]]
    return [text, symbols, " ".join(symbols), f"\n{text}\n", exercise.system]


def _net(exercise: Exercise, text: str) -> list[object]:
    lines = text.splitlines()
    renamed = re.sub(r"\b([A-Za-z]\w*)\b(?!:)", lambda place: place[1] + "_1" * (place[1] not in exercise.symbols), text)
    return [text, "; ".join(lines), "\n".join(reversed(lines)), text.replace("->", "→"), renamed]


_FORMS: dict[str, Any] = {
    "word": _word,
    "words": _words,
    "number": _number,
    "table": _table,
    "choice": _choice,
    "symbol": _symbol,
    "line": _line,
    "system": _system,
    "map": _map,
    "expression": _expression,
    "drawing": _drawing,
    "net": _net,
}


def as_typed(exercise: Exercise, answer: Any) -> object:
    """A wrong answer as somebody gives it."""
    if exercise.kind == "system":
        if exercise.given and answer.front is not answer.own:
            return "\n".join(map(str, answer.own.productions))
        return answer.own
    if exercise.kind == "map":
        return "\n".join(map(str, answer.own))
    if exercise.kind == "drawing":
        return answer.derivation
    if exercise.kind == "symbol":
        return answer[1] or answer[0]
    if isinstance(answer, Net):
        made = [" + ".join(f"{copies} {place}" for place, copies in firing.made) or "ε" for firing in answer.firings]
        return "\n".join(f"{firing.place} -> {each}" for firing, each in zip(answer.firings, made, strict=True))
    return str(answer) if exercise.kind == "expression" else answer
