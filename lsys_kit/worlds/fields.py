"""Fields: what answers the query modules `?E` of open systems (Mech and Prusinkiewicz, 1996).

A field is any object with a method `answer(questions, scene)`. It gets all questions of a word at once, and what is drawn of
the word, and returns a value for each question. What it returns must depend on these alone, so that a word has one successor.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import islice
from numbers import Real
from typing import Any, NamedTuple, Protocol

import numpy as np

from lsys_kit.budget import counted
from lsys_kit.errors import LSystemError, ModelValueError, shown
from lsys_kit.geometry.scene import Floats
from lsys_kit.geometry.turtle.frames import Vector
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.modules import Module
from lsys_kit.worlds.rounding import rounded


class Question(NamedTuple):
    """What a query module asks.

    Attributes
    ----------
    place, head
        Where it stands and in which direction the turtle looks there: x to the right, y upwards, z towards the viewer.
    values
        The values that it has, of which the answer takes the place.
    before, after
        The modules beside it in the word, or None at an end.
    """

    place: Vector
    head: Vector
    values: tuple[Value, ...]
    before: Module | None = None
    after: Module | None = None


@dataclass(frozen=True)
class Surroundings:
    """What is drawn of a word, in the same axes.

    Attributes
    ----------
    strokes
        Shape (n, 2, 3): their start and end points.
    centres, radii
        Shape (m, 3) and (m,): the spheres.
    """

    strokes: Floats
    centres: Floats
    radii: Floats


class Field(Protocol):
    """Answers query modules `?E`."""

    def answer(self, questions: Sequence[Question], scene: Surroundings, /) -> Iterable[Any]:
        """A value for each question, or as many values as the query module has."""


def answered(
    field: Field, questions: Sequence[Question], scene: Surroundings, arithmetic: str = "exact"
) -> list[tuple[Value, ...]]:
    """The values that the query modules have after a field has answered; a single number takes the place of the first.

    Raises
    ------
    ModelValueError
        The field fails, or does not return a number for each question.

    Examples
    --------
    >>> import numpy as np
    >>> class Height:
    ...     def answer(self, questions, scene):
    ...         return [question.place[1] for question in questions]
    >>> nothing = Surroundings(np.empty((0, 2, 3)), np.empty((0, 3)), np.empty(0))
    >>> answered(Height(), [Question((0, 2.5, 0), (0, 1, 0), (0, 7))], nothing)
    [(Fraction(5, 2), 7)]
    """
    name = f"The field {type(field).__name__}"
    if isinstance(field, type):
        raise ModelValueError(
            f"{field.__name__} is a class, not a field", hint=f"Give an object of it: field={field.__name__}()."
        )
    if not callable(getattr(field, "answer", None)):
        raise ModelValueError(
            f"A field has a method answer(questions, scene), and {shown(field)} has none",
            hint='A field that a text names stands in the text, as in "field: light".',
        )
    try:
        given = field.answer(questions, scene)
        answers = None if given is None else list(counted(islice(given, len(questions) + 1)))
    except LSystemError:
        raise
    except Exception as fault:
        raise ModelValueError(f"{name} failed with {type(fault).__name__}: {fault}") from fault
    if answers is None:
        raise ModelValueError(f"{name} returned nothing", hint="It must return a value for each question.")
    if len(answers) != len(questions):
        returned = f"more than {len(questions)}" if len(answers) > len(questions) else f"{len(answers)}"
        raise ModelValueError(
            f"{name} returned {returned} values for {len(questions)} questions",
            hint="It must return a value for each question.",
        )
    return [_taken(name, question, answer, arithmetic) for question, answer in zip(questions, answers, strict=True)]


def _taken(name: str, question: Question, answer: Any, arithmetic: str) -> tuple[Value, ...]:
    """The values of a query module with its answer."""
    if isinstance(answer, Real):
        return _number(name, question, answer, arithmetic), *question.values[1:]
    if not isinstance(answer, Sequence | np.ndarray) or isinstance(answer, str):
        raise ModelValueError(f"{name} answered {shown(answer)} at {_at(question)}, which is no number")
    values = list(answer)
    if len(values) != len(question.values):
        raise ModelValueError(
            f"{name} answered {len(values)} values at {_at(question)}, and the module there has {len(question.values)}"
        )
    return tuple(_number(name, question, value, arithmetic) for value in values)


def _number(name: str, question: Question, value: Any, arithmetic: str) -> Value:
    if not isinstance(value, Real):
        raise ModelValueError(f"{name} answered {shown(value)} at {_at(question)}, which is no number")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ModelValueError(f"{name} answered {shown(number)} at {_at(question)}, which is no finite number")
    return rounded(number, arithmetic)


def _at(question: Question) -> str:
    return f"({', '.join(f'{coordinate + 0.0:.6g}' for coordinate in question.place)})"
