"""The kinds of answers: how each is read, when two are equal, and how a wrong one differs.

An answer is a word, a number, a system or an expression. It is read by the kit's own grammars and never run, and compared by
its meaning: words module by module, systems by the words that they derive, expressions as functions.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from lsys_kit.classroom.catalogue import system as catalogued
from lsys_kit.classroom.exercises.differences import Valuations, differing_system, differing_values, differing_word
from lsys_kit.classroom.exercises.verdict import Verdict
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation
from lsys_kit.errors import ModelNameError, ModelValueError, quotable
from lsys_kit.notation.analysis.checks import span, suggestion
from lsys_kit.notation.model.arithmetic import Value, is_symbolic, number_text
from lsys_kit.notation.model.expressions import Expression, expression_type
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.notation.read import checked_expression, read, read_expression, read_word
from lsys_kit.worlds.derive import derive


@dataclass(frozen=True)
class KnownMistake:
    """A wrong answer that is to be expected, and the reply to it."""

    answer: str
    says: str


@dataclass(frozen=True)
class Exercise:
    """An exercise, as it is declared.

    Attributes
    ----------
    id, title, question
        What is asked; the question is Markdown.
    kind
        "word", "number", "system" or "expression": a key of `ANSWER_KINDS`.
    solution
        The right answer, as text; `explanation` says why.
    hints, slips
        Help on request, in order, and the mistakes that are to be expected.
    system
        For a word: the system that it comes from, by its id in the catalogue or as text.
    given
        For a system: the part of it that the question gives; the answer is the rest.
    steps
        For a word its step; for a system how many steps must agree.
    values
        For an expression: its names, each with the values for which it is asked.
    """

    id: str
    title: str
    kind: str
    question: str
    solution: str
    explanation: str
    hints: tuple[str, ...]
    slips: tuple[KnownMistake, ...] = ()
    system: str = ""
    given: str = ""
    steps: int = 0
    values: Mapping[str, Sequence[Value]] = field(default_factory=dict, hash=False)


@dataclass(frozen=True)
class AnswerKind:
    """One kind of answer.

    Attributes
    ----------
    what
        What a student puts in the place of the `...`.
    read
        From the exercise and the answer as given to its meaning.
    same
        Whether two answers to an exercise are equal.
    reply
        From the exercise, a wrong answer and the solution to the verdict.
    """

    what: str
    read: Callable[[Exercise, object], Any]
    same: Callable[[Exercise, Any, Any], bool]
    reply: Callable[[Exercise, Any, Any], Verdict]


def _text_answer(answer: object, what: str, example: str) -> str:
    if not isinstance(answer, str):
        raise ModelValueError(f"{what} must be a text such as {example}, not {type(answer).__name__}")
    return answer


_AXIOM_LINE = re.compile(r"^\s*(axiom|omega|ω)\s*:", re.IGNORECASE | re.MULTILINE)
"""An answer with an axiom of its own is the whole system."""


# Words


def _asked_system(exercise: Exercise) -> LSystem:
    """The system that the question is about."""
    return read(exercise.system) if ":" in exercise.system else catalogued(exercise.system)


def _read_word(exercise: Exercise, answer: object) -> tuple[Module, ...]:
    if isinstance(answer, Word):
        return tuple(answer)
    system = _asked_system(exercise)
    text = _text_answer(answer, "A word", '"al br"')
    known = symbols(system)
    for module in (word := read_word(text, system.notation, system)):
        if module.symbol not in known:
            hint = suggestion(module.symbol, known) or f"Its symbols are: {', '.join(known)}."
            raise ModelNameError(f'The system has no symbol "{module.symbol}"', text, *span(module), hint)
    return word


def _reply_to_word(exercise: Exercise, word: tuple[Module, ...], solution: tuple[Module, ...]) -> Verdict:
    """The reply to a wrong word: a miscounted step, rewriting that is not parallel, else the first difference."""
    derivation = derive(_asked_system(exercise), exercise.steps + 1)
    for step in (exercise.steps - 1, exercise.steps + 1):
        if word == tuple(derivation[step]):
            return Verdict("Almost", f"This is the word of step {step}, but the question asks for step {exercise.steps}. "
                                     "Step 0 is the axiom itself.")
    for rewritten, says in _NOT_PARALLEL if derivation.states.traits.d0l else ():
        modules = derivation.states.modules
        if word == tuple(modules[state] for state in rewritten(derivation.states, exercise.steps)):
            return Verdict("Not yet", says)
    return Verdict("Almost", differing_word(derivation, exercise.steps, word))


def sequential(states: States, steps: int) -> list[int]:
    """The word of a sequential rewriter: each step applies the first production everywhere, then the second to the result.

    >>> states = States(read("axiom: a\\na -> ab\\nb -> a"))
    >>> "".join(states.modules[state].symbol for state in sequential(states, 2))
    'aaaa'
    """
    word = list(states.axiom)
    for number in list(range(len(states.system.productions))) * steps:
        word = [after for state in word
                for after in (states.successor(state) if states.production(state) == number else (state,))]
    return word


def leftmost_only(states: States, steps: int) -> list[int]:
    """The word that comes out where each step rewrites one module only, as a Chomsky grammar may.

    >>> states = States(read("axiom: a\\na -> ab\\nb -> a"))
    >>> "".join(states.modules[state].symbol for state in leftmost_only(states, 2))
    'abb'
    """
    word = list(states.axiom)
    for _ in range(steps):
        at = next((i for i, state in enumerate(word) if states.production(state) is not None), len(word))
        word[at:at + 1] = [after for state in word[at:at + 1] for after in states.successor(state)]
    return word


_NOT_PARALLEL: tuple[tuple[Callable[[States, int], list[int]], str], ...] = (
    (sequential, "You applied one production after another, the second to what the first had made. All modules are "
                        "rewritten at the same time: what a step makes is rewritten in the next step, not in the same."),
    (leftmost_only, "You replaced one module in each step. In each step every module of the word is replaced."),
)


# Numbers


def _read_number(_: Exercise, answer: object) -> Value:
    number = number_from(answer, "answer")
    if is_symbolic(number):
        raise ModelValueError(f'A number is needed, and "{quotable(str(number))}" is none')
    return number


def _reply_to_number(_: Exercise, number: Value, solution: Value) -> Verdict:
    return Verdict("Not yet", f"You have {number_text(number)}, which is too {'few' if number < solution else 'many'}.")


# Systems


def _read_system(exercise: Exercise, answer: object) -> Derivation:
    """The words of the answer, appended to what the question gives.

    It is first read in front of it, so that an error names the line that the student sees.
    """
    if not isinstance(answer, LSystem):
        text = _text_answer(answer, "A system", '"axiom: a"')
        given = "" if _AXIOM_LINE.search(text) else exercise.given
        read(f"{text}\n{given}")
        answer = read(f"{given}\n{text}")
    return derive(answer, exercise.steps)


def _reply_to_system(_: Exercise, derivation: Derivation, solution: Derivation) -> Verdict:
    step = next(step for step, word in enumerate(derivation) if word != solution[step])
    return Verdict("Almost", differing_system(derivation, solution, step), step / len(solution))


# Expressions


def _read_expression(exercise: Exercise, answer: object) -> Expression:
    text = _text_answer(answer, "An expression", '"t + 1"')
    return checked_expression(text, exercise.values, expression_type(read_expression(exercise.solution)))


def _asked_values(exercise: Exercise) -> Iterator[Valuations]:
    """All combinations of the values for which the expression is asked."""
    for combination in itertools.product(*exercise.values.values()):
        yield dict(zip(exercise.values, combination, strict=True))


def _reply_to_expression(exercise: Exercise, expression: Expression, solution: Expression) -> Verdict:
    return Verdict("Not yet", differing_values(expression, solution, _asked_values(exercise)) or "")


ANSWER_KINDS: Mapping[str, AnswerKind] = {
    "word": AnswerKind("word, as a text in quotation marks", _read_word, lambda _, a, b: a == b, _reply_to_word),
    "number": AnswerKind("number", _read_number, lambda _, a, b: a == b, _reply_to_number),
    "system": AnswerKind('lines of the system, as a text between """ and """', _read_system, lambda _, a, b: list(a) == list(b),
                   _reply_to_system),
    "expression": AnswerKind("expression, as a text in quotation marks", _read_expression,
                       lambda exercise, a, b: differing_values(a, b, _asked_values(exercise)) is None, _reply_to_expression),
}
"""The kinds of answers, by their names."""
