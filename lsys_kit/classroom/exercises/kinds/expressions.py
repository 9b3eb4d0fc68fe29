"""Formulas as answers: equal as functions, which sympy proves where they are rational; never read by sympy."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from typing import Any

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference
from lsys_kit.classroom.exercises.kinds.proofs import Valuations, differing_values, is_rational, proved_equal
from lsys_kit.classroom.exercises.typed.formulas import formula_text
from lsys_kit.classroom.exercises.typed.text import assigned_name, text_answer
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.notation.analysis.checks import check_expression
from lsys_kit.notation.model.arithmetic import shortest_decimal
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, expression_type, names_in
from lsys_kit.notation.read import checked_expression, read_expression
from lsys_kit.notation.syntax.wording import reporting
from lsys_kit.translation import gettext


def _read(exercise: Exercise, answer: object) -> Expression:
    wanted = expression_type(read_expression(exercise.solution))
    if not isinstance(answer, str):
        if isinstance(answer, int | float | Fraction) and not isinstance(answer, bool):
            answer = str(answer)
        else:
            return _checked(exercise, from_sympy(answer), wanted)
    text = text_answer(answer, gettext("An expression"), '"t + 1"')
    try:
        return checked_expression(text, exercise.values, wanted)
    except LSystemError:
        other = formula_text(text, exercise.values)
        if other != text and assigned_name(text) not in exercise.values:
            try:
                return checked_expression(other, exercise.values, wanted)
            except LSystemError as mistake:
                if mistake.span is None or other in text:
                    raise
        raise


def _checked(exercise: Exercise, expression: Expression, wanted: str) -> Expression:
    with reporting(str(expression)):
        check_expression(expression, exercise.values, wanted)
    return expression


def from_sympy(formula: object, depth: int = 0) -> Expression:
    """An expression of the kit, from one that was made with sympy: by its tree, never by its text.

    >>> import sympy
    >>> d, s = sympy.symbols("d s")
    >>> print(from_sympy((d - s) / 2))
    0.5 * d + -0.5 * s
    """
    import sympy

    if not isinstance(formula, sympy.Basic) or depth > 50:
        raise ModelValueError(gettext('An expression must be a text such as "t + 1", not {kind}', kind=type(formula).__name__))
    if isinstance(formula, sympy.Symbol):
        return Name(str(formula.name))
    if isinstance(formula, sympy.Rational):
        value = Fraction(int(formula.p), int(formula.q))
        return Number(int(value) if value.denominator == 1 else value)
    if isinstance(formula, sympy.Float):
        return Number(shortest_decimal(float(formula)))
    operator = _operators().get(type(formula))
    if operator is None or not formula.args:
        raise ModelValueError(gettext("The kit's expressions have no {name}", name=type(formula).__name__))
    operands = [from_sympy(argument, depth + 1) for argument in formula.args]
    return operator(operands)


def _operators() -> Mapping[Any, Callable[[list[Expression]], Expression]]:
    """For each class of sympy how the kit writes it."""
    import sympy

    def chain(operator: str) -> Callable[[list[Expression]], Expression]:
        def build(operands: list[Expression]) -> Expression:
            found = operands[0]
            for operand in operands[1:]:
                found = Apply(operator, (found, operand))
            return found

        return build

    def call(operator: str) -> Callable[[list[Expression]], Expression]:
        return lambda operands: Apply(operator, tuple(operands))

    return {
        sympy.Add: chain("+"),
        sympy.Mul: chain("*"),
        sympy.Pow: call("^"),
        sympy.floor: call("floor"),
        sympy.ceiling: call("ceil"),
        sympy.Abs: call("abs"),
        sympy.exp: call("exp"),
        sympy.log: call("log"),
        sympy.Min: chain("min"),
        sympy.Max: chain("max"),
        sympy.Mod: call("mod"),
        sympy.And: chain("&&"),
        sympy.Or: chain("||"),
        sympy.Not: call("!"),
        sympy.Eq: call("=="),
        sympy.Ne: call("!="),
        sympy.Lt: call("<"),
        sympy.Le: call("<="),
        sympy.Gt: call(">"),
        sympy.Ge: call(">="),
    }


def _cases(exercise: Exercise) -> Iterator[Valuations]:
    """All combinations of the values for which the expression is asked."""
    for combination in itertools.product(*exercise.values.values()):
        yield dict(zip(exercise.values, combination, strict=True))


def _same(exercise: Exercise, own: Expression, wanted: Expression) -> bool:
    """Equal for all values asked for, and as functions where that can be decided."""
    if differing_values(own, wanted, _cases(exercise)) is not None:
        return False
    return proved_equal(own, wanted) or not (is_rational(own) and is_rational(wanted))


def _difference(exercise: Exercise, own: Expression, solution: Expression) -> Difference:
    cases = list(_cases(exercise))
    right = sum(differing_values(own, solution, [case]) is None for case in cases)
    message = differing_values(own, solution, cases)
    if message is None:
        return Difference(
            gettext("For the numbers of the question it is right, but not for all others: it is another formula."), 1
        )
    return Difference(message, right / len(cases))


def _praise(_: Exercise, own: Expression, solution: Expression) -> str:
    if proved_equal(own, solution):
        return gettext("It is so whatever the values.")
    return gettext("It is so for all the values in question.")


EXPRESSION = AnswerKind(
    "expression, as a text in quotation marks",
    _read,
    _same,
    _difference,
    lambda _, own, solution: bool(names_in(own)) or not names_in(solution),
    _praise,
)
