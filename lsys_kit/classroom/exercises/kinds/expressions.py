"""Formulas as answers: equal as functions, which sympy proves where they are rational; never read by sympy."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from fractions import Fraction
from functools import reduce
from typing import TypeAlias

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.forms import normal
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.typed import (
    assigned_name,
    formula_text,
    is_unsolved,
    keyboard_text,
    kind_of,
    quoted,
    text_answer,
)
from lsys_kit.errors import LSystemError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.analysis.checks import check_expression
from lsys_kit.notation.model.arithmetic import Value, number_text, reason_of, shortest_decimal
from lsys_kit.notation.model.expressions import (
    Apply,
    Expression,
    Function,
    Name,
    Number,
    expression_type,
    function_of,
    names_in,
    to_sympy,
    walk,
)
from lsys_kit.notation.read import checked_expression, read_expression
from lsys_kit.notation.syntax.wording import reporting

# Whether two expressions are equal


Valuations: TypeAlias = Mapping[str, Value]
"""A value for each name."""
MOST_NODES = 40
"""Operators, names and numbers of an expression that sympy is asked about."""
MOST_PROOF_DEGREE = 12
"""Its degree, with the exponents of its numbers: larger powers are not expanded."""


def differing_values(mine: Expression, wanted: Expression, cases: Iterable[Valuations]) -> str | None:
    """The first case in which two expressions have different values, or None.

    >>> from lsys_kit.notation.read import read_expression
    >>> differing_values(read_expression("t"), read_expression("2*t"), [{"t": 0}, {"t": 1}])
    'With t = 1 your expression gives 1, and it should give 2.'
    """
    run: dict[tuple[str, ...], list[Function]] = {}
    for case in cases:
        names = tuple(case)
        if names not in run:
            run[names] = [function_of(each, {name: i for i, name in enumerate(names)}) for each in (mine, wanted)]
        own, right = (_value(each, tuple(case.values())) for each in run[names])
        if not _equal_values(own, right):
            where = reply("expression.and").join(f"{name} = {number_text(value)}" for name, value in case.items())
            if isinstance(own, str):
                return reply("expression.no_value", values=where, reason=own, right=_value_text(right))
            return reply("expression.value", values=where, own=_value_text(own), right=_value_text(right))
    return None


def _equal_values(own: Value | str, right: Value | str) -> bool:
    if isinstance(own, str) or isinstance(right, str):
        return False
    return math.isclose(own, right, rel_tol=1e-9) if isinstance(own, float) or isinstance(right, float) else own == right


def _value_text(value: Value | str) -> str:
    return str(value).lower() if isinstance(value, str | bool) else number_text(value)


def proved_equal(mine: Expression, wanted: Expression) -> bool:
    """Whether sympy shows that two expressions are equal whatever the values of their names.

    Also False where they are too large to be compared: sympy may never finish with a power of a power.

    >>> from lsys_kit.notation.read import read_expression
    >>> proved_equal(read_expression("(x+1)^2"), read_expression("x^2 + 2*x + 1"))
    True
    >>> proved_equal(read_expression("x^2"), read_expression("x"))
    False
    """
    if not (_is_small(mine) and _is_small(wanted)):
        return False
    import sympy

    left, right = to_sympy(mine), to_sympy(wanted)
    if isinstance(left, sympy.Rel) and isinstance(right, sympy.Rel):
        return bool(left.canonical == right.canonical)
    if not (isinstance(left, sympy.Expr) and isinstance(right, sympy.Expr)):
        return bool(left == right)
    return bool(sympy.cancel(sympy.expand(left - right)) == 0)


def _is_small(expression: Expression) -> bool:
    return _nodes(expression) <= MOST_NODES and _degree(expression) <= MOST_PROOF_DEGREE


def _nodes(expression: Expression) -> int:
    return 1 + (sum(map(_nodes, expression.operands)) if isinstance(expression, Apply) else 0)


def _degree(expression: Expression) -> float:
    """A bound for the degree of an expression; infinite where sympy might have to work out something very large."""
    if not isinstance(expression, Apply):
        return 0 if isinstance(expression, Number) else 1
    degrees = [_degree(operand) for operand in expression.operands]
    if expression.operator == "^":
        return max(1.0, degrees[0]) * _exponent(expression.operands[1])
    if expression.operator in ("&&", "||", "!"):
        return math.inf
    return sum(degrees) if expression.operator in ("*", "/") else max(degrees)


def _exponent(expression: Expression) -> float:
    if isinstance(expression, Number):
        return abs(float(expression.value))
    return 1 if isinstance(expression, Name) else math.inf


def is_rational(expression: Expression) -> bool:
    """Whether an expression is built of numbers, names and + - * / and whole powers, so that equality can be decided.

    >>> from lsys_kit.notation.read import read_expression
    >>> is_rational(read_expression("(d - s)^2 / 2")), is_rational(read_expression("max(d, s)"))
    (True, False)
    """
    if not isinstance(expression, Apply):
        return True
    if expression.operator == "^":
        base, power = expression.operands
        return is_rational(base) and isinstance(power, Number) and power.value == int(power.value) and _is_small(expression)
    return (
        expression.operator in ("+", "-", "*", "/", "-x")
        and _is_small(expression)
        and all(map(is_rational, expression.operands))
    )


# As it was typed


def _read(exercise: Exercise, answer: object) -> Expression:
    wanted = expression_type(read_expression(exercise.solution))
    if not isinstance(answer, str):
        if isinstance(answer, int | float | Fraction) and not isinstance(answer, bool):
            answer = str(answer)
        else:
            return _checked(exercise, from_sympy(answer), wanted)
    text = text_answer(answer, reply("expression.what"), '"t + 1"')
    if _GOES_ON.search(text):
        raise ModelValueError(reply("expression.goes_on"))
    turned = re.search(r"=[<>](?!=)", text)
    if turned:
        raise ModelSyntaxError(reply("expression.comparison"), text, turned.start(), turned.end())
    try:
        return checked_expression(text, exercise.values, wanted)
    except LSystemError as first:
        for changed in (_alone(exercise, text), _in_case_of(exercise.values, text)):
            if changed != text:
                with suppress(LSystemError):
                    return _read(exercise, changed)
        other = formula_text(text, exercise.values)
        if other != text and assigned_name(text) not in exercise.values:
            try:
                return checked_expression(other, exercise.values, wanted)
            except LSystemError as mistake:
                if mistake.span is None or other in text or _is_behind(mistake, first):
                    raise
        if wanted == "number" and is_unsolved(keyboard_text(text), exercise.values):
            raise ModelValueError(reply("expression.equation", text=quoted(text))) from None
        if wanted == "number" and _SEVERAL.search(text):
            raise ModelValueError(reply("expression.one_needed", text=quoted(text))) from None
        raise


def _is_behind(mistake: LSystemError, first: LSystemError) -> bool:
    """Whether a mistake is nearer to the end of its text than another, which is none in the form that the kit writes."""
    left, left_first = (len(each.source) - each.span[0] if each.source and each.span else 0 for each in (mistake, first))
    return left < left_first


_GOES_ON = re.compile(r"\.{3}|…")
_SEVERAL = re.compile(r"\b(?:or|oder|and|und)\b")
_ASKED_FOR = re.compile(r"\*\*.*?\*\*", re.DOTALL)
_VALUE_OF = re.compile(r"\s*+([A-Z])\s*+\((.*)\)\s*", re.DOTALL)
"""A module with one value, as in F(2*q)."""
_NOUN_BEHIND = re.compile(r"(?<=[\w)])\s++([^\W\d_]{3,})\W*\Z")
_ONE_EQUATION = re.compile(r"([^=<>!]++)=(?!=)([^=]++)")


_LETTER = re.compile(r"(?<![A-Za-z_\\])[A-Za-z](?![A-Za-z_0-9])(?!\s*\()")


def _in_case_of(names: Collection[str], text: str) -> str:
    """A formula with the letters of the question for those that it has in the other case alone.

    >>> _in_case_of(["n"], "N + 1"), _in_case_of(["L", "l"], "l + L"), _in_case_of(["n"], "N(n)")
    ('n + 1', 'l + L', 'N(n)')
    """
    others = {name.swapcase(): name for name in names if name.swapcase() not in names}
    return _LETTER.sub(lambda found: others.get(found[0], found[0]), text)


def _alone(exercise: Exercise, text: str) -> str:
    """A formula without a noun of the question behind it, without a left side that the question has, or that is equal.

    And without the module of which the question asks for the value.
    """
    module = _VALUE_OF.fullmatch(text)
    if module and any(f"`{module[1]}`" in asked for asked in _ASKED_FOR.findall(exercise.question)):
        return module[2]
    noun = _NOUN_BEHIND.search(text)
    if noun and noun[1] not in exercise.values and re.search(rf"\b{noun[1]}\b", exercise.question, re.IGNORECASE):
        text = text[: noun.start()]
    both = _ONE_EQUATION.fullmatch(keyboard_text(text))
    if both and f" {' '.join(both[1].split())} = " in " ".join(exercise.question.split()):
        return both[2].strip()
    if both and _LETTER.fullmatch(both[2].strip()) and both[2].strip() not in exercise.values:
        return both[1].strip()
    with suppress(LSystemError):
        if both:
            one, other = (
                checked_expression(formula_text(side, exercise.values), exercise.values, "number") for side in both.groups()
            )
            return both[2].strip() if differing_values(one, other, _cases(exercise)) is None else text
    return text


def _checked(exercise: Exercise, expression: Expression, wanted: str) -> Expression:
    with reporting(str(expression)):
        check_expression(expression, exercise.values, wanted)
    return expression


_OPERATORS = {
    "Add": "+",
    "Mul": "*",
    "Pow": "^",
    "Min": "min",
    "Max": "max",
    "Mod": "mod",
    "Abs": "abs",
    "exp": "exp",
    "log": "log",
}
_OPERATORS |= {"floor": "floor", "ceiling": "ceil", "And": "&&", "Or": "||", "Not": "!"}
_OPERATORS |= {"Eq": "==", "Ne": "!=", "Lt": "<", "Le": "<=", "Gt": ">", "Ge": ">="}
"""For each class of sympy how the kit writes it."""
_OF_TWO = ("+", "*", "min", "max", "&&", "||")
"""What sympy has of any number of operands, and the kit of two."""


def from_sympy(formula: object, depth: int = 0) -> Expression:
    """An expression of the kit, from one that was made with sympy: by its tree, never by its text.

    >>> import sympy
    >>> d, s = sympy.symbols("d s")
    >>> print(from_sympy((d - s) / 2))
    0.5 * d + -0.5 * s
    """
    import sympy

    if not isinstance(formula, sympy.Basic) or depth > 50:
        raise ModelValueError(reply("expression.must_be_text", kind=kind_of(formula)))
    if isinstance(formula, sympy.Symbol):
        return Name(str(formula.name))
    if isinstance(formula, sympy.Rational):
        value = Fraction(int(formula.p), int(formula.q))
        return Number(int(value) if value.denominator == 1 else value)
    if isinstance(formula, sympy.Float):
        return Number(shortest_decimal(float(formula)))
    operator = {getattr(sympy, name): sign for name, sign in _OPERATORS.items()}.get(type(formula))
    if operator is None or not formula.args:
        raise ModelValueError(reply("expression.unknown_function", name=type(formula).__name__))
    operands = [from_sympy(argument, depth + 1) for argument in formula.args]
    if operator in _OF_TWO:
        return reduce(lambda one, other: Apply(operator, (one, other)), operands)
    return Apply(operator, tuple(operands))


# What to say


def _cases(exercise: Exercise) -> Iterator[Valuations]:
    for combination in itertools.product(*exercise.values.values()):
        yield dict(zip(exercise.values, combination, strict=True))


_COMPARED = ["truth", "number", "number"]
MOST_AT_A_BOUND = 10_000
"""The greatest value at which an answer's own bounds are tried."""


def _own_cases(exercise: Exercise, own: Expression, wanted: Expression) -> Iterator[Valuations]:
    """The cases of a question, and those at the bounds of the comparisons that an answer has and the solution has not.

    Nothing is tried below the least value, nor where a name may be a share.
    """
    yield from _cases(exercise)
    if expression_type(own) != "truth" or any(max(each) <= 1 for each in exercise.values.values()):
        return
    known = {*map(str, map(normal, walk(wanted)))}
    for part in walk(own):
        is_compared = isinstance(part, Apply) and [expression_type(each) for each in (part, *part.operands)] == _COMPARED
        if is_compared and isinstance(part, Apply) and str(normal(part)) not in known:
            yield from _at_the_bound(exercise, Apply("-", part.operands))


def _at_the_bound(exercise: Exercise, distance: Expression) -> Iterator[Valuations]:
    """Cases in which a distance is 0 or nearly so, also with another value twice as large, all in the order of the question."""
    cases = list(_cases(exercise))
    ordered = [(a, b) for a, b in itertools.permutations(exercise.values, 2) if all(case[a] < case[b] for case in cases)]
    run = function_of(distance, {name: i for i, name in enumerate(exercise.values)})
    for name, case in itertools.product(sorted(names_in(distance)), cases):
        with suppress(ArithmeticError, ValueError):  # where it has no value, or the same one everywhere
            first, second = (Fraction(run(tuple({**case, name: value}.values()))) for value in (0, 1))
            root = first / (first - second)
            for value in sorted({math.floor(root), math.floor(root) + 1, math.ceil(root) - 1}):
                for other in case:
                    given = {other: 2 * value, name: value}
                    found = {**case, **given}
                    above = all(MOST_AT_A_BOUND > number > min(exercise.values[each]) for each, number in given.items())
                    if above and all(found[a] < found[b] for a, b in ordered):
                        yield found


def _same(exercise: Exercise, own: Expression, wanted: Expression) -> bool:
    """Equal for all values asked for, and as functions where that can be decided."""
    if differing_values(own, wanted, _own_cases(exercise, own, wanted)) is not None:
        return False
    return proved_equal(own, wanted) or not (is_rational(own) and is_rational(wanted))


def agreement(exercise: Exercise, wanted: Expression) -> Callable[[Expression], bool]:
    """Whether an expression has the same values as another in all cases of the question; they are computed once."""
    order = {name: i for i, name in enumerate(exercise.values)}
    right_one = function_of(wanted, order)
    cases = [(case, _value(right_one, case)) for case in itertools.product(*exercise.values.values())]

    def agrees(own: Expression) -> bool:
        run = function_of(own, order)
        with suppress(ArithmeticError, ValueError):
            return all(_equal_values(run(case), right) for case, right in cases)
        return False

    return agrees


def _value(run: Function, case: tuple[Value, ...]) -> Value | str:
    try:
        return run(case)  # type: ignore[no-any-return]
    except (ArithmeticError, ValueError) as fault:
        return reason_of(fault)


def _difference(exercise: Exercise, own: Expression, solution: Expression) -> Difference:
    cases = list(_own_cases(exercise, own, solution))
    right = sum(differing_values(own, solution, [case]) is None for case in cases)
    message = differing_values(own, solution, cases)
    if message is None:
        return Difference(reply("expression.another_formula"), 1, explains=True)
    if missing := sorted(names_in(solution) - names_in(own)):
        message = f"{reply('expression.constant', names=', '.join(missing))} {message}"
    return Difference(message, right / len(cases), at_a_case=True)


def _praise(_: Exercise, own: Expression, solution: Expression) -> str:
    return reply("expression.proved" if proved_equal(own, solution) else "expression.right_here")


def _honest(exercise: Exercise, own: Expression, solution: Expression) -> bool:
    """Whether it is a formula: no number alone, but for one that is right in some case."""
    if names_in(own) or isinstance(own, Apply):
        return True
    return any(differing_values(own, solution, [case]) is None for case in _cases(exercise))


EXPRESSION = AnswerKind(_read, _difference, _same, _honest, _praise)
