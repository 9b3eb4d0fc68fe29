"""Numbers as answers: one number, with a unit or without, or a row or table of them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from lsys_kit.classroom.exercises.asked import asked_steps, right_history, what_is_asked
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference, first_difference, one_apart
from lsys_kit.classroom.exercises.typed import number_and_unit, parts
from lsys_kit.errors import ModelNameError, quotable
from lsys_kit.notation.model.arithmetic import Value, number_text

_UNITS: Mapping[str, tuple[str, float]] = {
    "°": ("angle", 1),
    "degree": ("angle", 1),
    "degrees": ("angle", 1),
    "deg": ("angle", 1),
    "rad": ("angle", 180 / math.pi),
    "radian": ("angle", 180 / math.pi),
    "radians": ("angle", 180 / math.pi),
    "pi": ("angle of pi", 1),
    "%": ("share", 1),
    "percent": ("share", 1),
    "": ("", 1),
}
"""For each unit that is converted what it measures, and how much of the first unit of that it is."""
_COUNTED = frozenset(("cell", "letter", "module", "symbol", "character", "element", "piece"))
"""Words for what a word is made of, one as good as the other."""
MOST_APART = 10
"""How many times too large or too small a number may be that counts as a try."""


def _read_number(exercise: Exercise, answer: object) -> Value:
    number, unit = number_and_unit(answer)
    if not unit or unit.lower() == exercise.unit.lower():
        return number
    wanted, given = _UNITS.get(exercise.unit.lower()), _UNITS.get(unit.lower())
    if given and wanted and given[0] == wanted[0]:
        return number if given[1] == wanted[1] else float(number) * given[1] / wanted[1]
    if given and given[0] == "share" and not exercise.unit:
        return number / 100
    noun = unit.lower().rstrip("s")
    if given is None and (
        noun in f"{exercise.question} {exercise.unit}".lower() or {noun, exercise.unit.rstrip("s")} <= _COUNTED
    ):
        return number
    raise ModelNameError(
        f'"{quotable(unit)}" is not the unit that the question asks for',
        hint=f"Its unit is: {exercise.unit}." if exercise.unit else "Write the number alone.",
    )


def _distance(own: Value, wanted: Value) -> Any:
    """How far two numbers are apart, exactly where they are exact."""
    try:
        return abs(own - wanted)
    except OverflowError:
        return math.inf


def same_number(exercise: Exercise, own: Value, wanted: Value) -> bool:
    """Whether two numbers are equal, within the tolerance of the question; doubles up to rounding.

    >>> same_number(Exercise("1", "", "number", "", "", "", (), tolerance=1), 20, 21)
    True
    """
    if _distance(own, wanted) <= exercise.tolerance:
        return True
    with suppress(OverflowError):  # a whole number beyond all doubles equals none of them
        inexact = isinstance(own, float) or isinstance(wanted, float)
        return inexact and math.isclose(own, wanted, rel_tol=1e-9, abs_tol=1e-12)
    return False


def _number_difference(exercise: Exercise, number: Value, solution: Value) -> Difference:
    said = f"{number_text(number)} is not the number that is asked for."
    if isinstance(solution, int) and number != int(number):
        return Difference(f"{said} It must be a whole number.")
    close = bool(exercise.tolerance) and _distance(number, solution) <= 3 * exercise.tolerance
    if close:
        return Difference(f"{said} It is close: was something rounded on the way?", 1, True)
    return Difference(f"{said} {exercise.otherwise or _try_small(exercise)}".rstrip())


def _try_small(exercise: Exercise) -> str:
    """What to compare one's way of counting with: the first steps, which can be written down."""
    if what_is_asked(exercise) not in ("length", "count", "strokes") or exercise.steps < 4:
        return ""
    values = right_history(exercise).values(exercise, 2)
    return f"Try your way on step 2: does it give {values[2]} there?"


def _honest_number(_: Exercise, number: Value, solution: Value) -> bool:
    if not solution:
        return bool(0 < _distance(number, 0) <= MOST_APART)
    size, wanted = _distance(number, 0), _distance(solution, 0)
    return bool((number > 0) == (solution > 0) and number and wanted <= MOST_APART * size and size <= MOST_APART * wanted)


NUMBER = AnswerKind("number", _read_number, same_number, _number_difference, _honest_number)


# Rows and tables


def _read_table(exercise: Exercise, answer: object) -> tuple[Value, ...]:
    return tuple(_read_number(exercise, part) for part in parts(answer, "Numbers"))


def _same_table(exercise: Exercise, own: tuple[Value, ...], wanted: tuple[Value, ...]) -> bool:
    return len(own) == len(wanted) and all(same_number(exercise, a, b) for a, b in zip(own, wanted, strict=True))


def _table_difference(exercise: Exercise, own: tuple[Value, ...], solution: tuple[Value, ...]) -> Difference:
    at = next(
        (i for i, (a, b) in enumerate(zip(own, solution, strict=False)) if not same_number(exercise, a, b)),
        min(len(own), len(solution)),
    )
    likeness = at / max(len(own), len(solution), 1)
    count = "" if len(own) == len(solution) else f"You have {len(own)} numbers, and {len(solution)} are asked for. "
    if at == min(len(own), len(solution)):
        return Difference(f"{count}As far as both go they agree.", likeness, one_apart(own, solution))
    so_far = f"The first {at} are right. " if at > 1 else ""
    return Difference(
        f"{count}{so_far}Look at number {at + 1}{_step_of(exercise, at)}: you have {number_text(own[at])}.",
        likeness,
        one_apart(own, solution),
    )


def _step_of(exercise: Exercise, at: int) -> str:
    if what_is_asked(exercise) in ("lengths", "counts") and not exercise.symbols and at < len(asked_steps(exercise)):
        return f", that of step {asked_steps(exercise)[at]}"
    return ""


TABLE = AnswerKind(
    "numbers, in order, as a text or a list",
    _read_table,
    _same_table,
    _table_difference,
    lambda exercise, own, solution: (
        (2 * len(own) >= len(solution) and first_difference(own, solution) > 0) or (len(own) == len(solution) and any(own))
    ),
)
