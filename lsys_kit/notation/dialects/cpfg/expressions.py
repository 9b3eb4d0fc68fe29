"""Expressions as cpfg has them: C's truths, which are numbers, and the functions of its manual.

cpfg's signs bind more tightly than `^`, and `^` goes from left to right: `-2^2` is 4, `2^3^2` is 64. `%` is that of C for whole
numbers, to which its operands are cut: `-7%3` is -1, `7.9%3` is 1. Angles are in degrees (CPFG User's Manual, "Predefined
functions").
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.model.expressions import (
    OPERATORS,
    Apply,
    Expression,
    Name,
    Number,
    Style,
    TextSpan,
    calls_in,
    expression_type,
    is_random,
    styled_text,
)
from lsys_kit.notation.syntax.actions import values_text

SAME = ("sin", "cos", "tan", "asin", "acos", "atan", "exp", "log", "sqrt", "floor", "ceil")
"""The functions that cpfg and the kit call alike."""
RENAMED: Mapping[str, str] = {"fabs": "abs", "nran": "normal", "biran": "binomial"}
"""Functions of cpfg that have another name in the kit."""
ZERO, ONE = Number(0), Number(1)


def _uniform(x: Expression, at: TextSpan) -> Apply:
    return Apply("uniform", (ZERO, x), at)


def _truncated(x: Expression, at: TextSpan) -> Apply:
    return Apply("if", (Apply("<", (x, ZERO)), Apply("ceil", (x,)), Apply("floor", (x,))), at)


def _sign(x: Expression, at: TextSpan) -> Apply:
    return Apply("if", (Apply("<", (x, ZERO)), Number(-1), Apply("if", (Apply(">", (x, ZERO)), ONE, ZERO))), at)


BUILT: Mapping[str, Callable[[Expression, TextSpan], Apply]] = {"ran": _uniform, "trunc": _truncated, "sign": _sign}
"""Functions of one value that the kit expresses with other operators."""
ALSO: Mapping[str, str] = {"abs": "abs", "pow": "^"}
"""Functions that C has and people type."""
_FUNCTIONS: Mapping[str, str] = {**{name: name for name in SAME}, **RENAMED, **ALSO}
ABSENT = (
    "atan2",
    "bran",
    "func",
    "inblob",
    "printf",
    "fprintf",
    "fopen",
    "fclose",
    "fflush",
    "fscanf",
    "srand",
    "stop",
    "play",
    "curveX",
    "curveY",
    "curveZ",
)
"""Functions of cpfg that the kit does not have."""
_BESIDE = "Its values are in a file beside the model: read its folder, or write an expression in its place."
_CONTOURS = "Its values are in a file of contours, which the kit does not read: write an expression in its place."
CURVES: Mapping[str, str] = {"func": _BESIDE, **dict.fromkeys(("curveX", "curveY", "curveZ"), _CONTOURS)}
"""Functions whose values are in files, and what to do about it."""
_ROUNDED = 'Type "floor" or "ceil".'


def as_truth(expression: Expression) -> Expression:
    """What is true where the expression is: a number is true where it is not 0.

    >>> print(as_truth(Name("t")))
    t != 0
    """
    return expression if expression_type(expression) == "truth" else Apply("!=", (expression, ZERO), expression.at)


def as_number(expression: Expression) -> Expression:
    """The number that an expression is: a truth is 1 or 0.

    >>> print(as_number(Apply("<", (Name("t"), Number(5)))))
    if(t < 5, 1, 0)
    """
    return expression if expression_type(expression) == "number" else Apply("if", (expression, ONE, ZERO), expression.at)


def wanted(operator: str, operands: tuple[Expression, ...]) -> tuple[Expression, ...]:
    """The operands of an operator as it takes them: truths or numbers."""
    entry = OPERATORS[operator]
    return tuple(
        as_truth(operand) if entry.wanted(index) == "truth" else as_number(operand) for index, operand in enumerate(operands)
    )


def resolve_call(name: str, operands: tuple[Expression, ...], at: TextSpan) -> Apply:
    """What a function of cpfg gives.

    >>> print(resolve_call("ran", (Number(5),), None))
    uniform(0, 5)
    """
    place = at or (0, 0)
    if name in ABSENT:
        raise problem("absent function", place, name=name, hint=CURVES.get(name, ""))
    if name not in _FUNCTIONS and name not in BUILT:
        known = (*SAME, *RENAMED, *BUILT)
        hint = _instead(name) or suggestion(name, known, 0.7) or f"Functions are: {', '.join(sorted(known))}."
        raise problem("unknown function", place, name=name, hint=hint)
    count = 1 if name in BUILT else OPERATORS[_FUNCTIONS[name]].arity[0]
    if len(operands) != count:
        raise problem("number of arguments", place, name=name, wanted=values_text(count), given=len(operands))
    if name not in BUILT:
        return Apply(_FUNCTIONS[name], wanted(_FUNCTIONS[name], operands), at)
    if name != "ran" and is_random(operands[0]):
        raise problem("function of random number", place, name=name, hint=_ROUNDED if name == "trunc" else "")
    return BUILT[name](as_number(operands[0]), at)


def _instead(name: str) -> str | None:
    """What cpfg has in place of a function of the kit."""
    return {
        "if": 'A choice is typed "t < 5 ? 1 : 2".',
        "min": 'Type "x < y ? x : y".',
        "max": 'Type "x > y ? x : y".',
        "mod": 'Type "x - y*floor(x/y)".',
        "rem": 'Type "x % y".',
        "uniform": 'Type "ran(x)", a number from 0 to x.',
    }.get(name)


_LESS: Mapping[str, str] = {"<": "min", ">": "max"}
"""What `x < y ? x : y` says."""
_STYLE = Style({kit: cpfg for cpfg, kit in RENAMED.items()})
_KNOWN = frozenset((*SAME, *RENAMED.values(), *_LESS.values(), "if", "mod", "rem", "uniform"))


def expression_text(expression: Expression) -> str:
    """An expression as cpfg reads it.

    >>> expression_text(Apply("if", (Apply("<", (Name("t"), Apply("abs", (Name("x"),)))), Number(1), Name("t"))))
    '(t < fabs(x) ? 1 : t)'
    """
    return styled_text(_respelt(expression), _STYLE)


def _respelt(expression: Expression) -> Expression:
    """The expression with a name in place of each part that a style cannot express in cpfg."""
    if not isinstance(expression, Apply):
        return expression
    operator, operands = expression.operator, tuple(map(_respelt, expression.operands))
    texts = [styled_text(operand, _STYLE) for operand in operands]
    if operator == "if":
        return Name("({} ? {} : {})".format(*texts))
    if operator in ("min", "max"):
        return Name(f"({texts[0]} {'<' if operator == 'min' else '>'} {texts[1]} ? {texts[0]} : {texts[1]})")
    if operator == "uniform":
        if operands[0] == ZERO:
            return Name(f"ran({texts[1]})")
        return Name(f"({_parenthesised(operands[0])} + ran({_between(expression)}))")
    if operator == "mod":
        return _respelt(_floored(*expression.operands))
    if operator == "rem":
        return Name(f"({_parenthesised(operands[0])} % {_parenthesised(operands[1])})")
    if operator in ("-x", "^"):  # both bind differently in cpfg and in the kit
        operands = (*operands[:-1], Name(_parenthesised(operands[-1])))
    return Apply(operator, operands)


def _floored(left: Expression, right: Expression) -> Apply:
    """What is left of a number when another is taken away as often as it goes."""
    return Apply("-", (left, Apply("*", (right, Apply("floor", (Apply("/", (left, right)),))))))


def _parenthesised(expression: Expression) -> str:
    """The text of an operand, in parentheses where it is made with an operator or has a sign."""
    text = styled_text(expression, _STYLE)
    plain = isinstance(expression, Name) or (isinstance(expression, Number) and text[0] != "-" and "/" not in text)
    function = isinstance(expression, Apply) and OPERATORS[expression.operator].precedence is None
    return text if plain or function else f"({text})"


def _between(uniform: Apply) -> str:
    """How far the ends of a random number lie apart."""
    low, high = uniform.operands
    return expression_text(Apply("-", (high, low)))


def simplified(applied: Apply) -> Apply:
    """What cpfg writes with several operators and the kit with one: the lesser of two numbers, a random number from a range.

    >>> print(simplified(Apply("+", (Number(2), Apply("uniform", (ZERO, Apply("-", (Number(5), Number(2)))))))))
    uniform(2, 5)
    """
    first, *others = applied.operands
    if applied.operator == "if" and isinstance(first, Apply) and first.operator in _LESS and first.operands == tuple(others):
        return applied if is_random(first) else Apply(_LESS[first.operator], first.operands, applied.at)
    if applied.operator == "-" and isinstance(others[0], Apply) and others[0].operator == "*":
        divisor = others[0].operands[0]
        return Apply("mod", (first, divisor), applied.at) if _floored(first, divisor) == applied else applied
    if applied.operator == "+" and isinstance(others[0], Apply) and others[0].operator == "uniform" and not is_random(first):
        zero, width = others[0].operands
        if zero == ZERO and isinstance(width, Apply) and width.operator == "-" and width.operands[1:] == (first,):
            return Apply("uniform", (first, width.operands[0]), applied.at)
    return applied


def missing_function(expression: Expression) -> str | None:
    """What cpfg lacks to write an expression, in words.

    >>> missing_function(Apply("poisson", (Name("t"),)))
    'function "poisson"'
    """
    return next(filter(None, map(_missing_call, calls_in(expression))), None)


def _missing_call(expression: Apply) -> str | None:
    if OPERATORS[expression.operator].precedence is None and expression.operator not in _KNOWN:
        return f'function "{expression.operator}"'
    if expression.operator in _LESS.values() and (len(expression.operands) > 2 or is_random(expression)):
        return f'function "{expression.operator}" of more than two numbers, or of random numbers'
    if expression.operator == "mod" and is_random(expression):
        return 'function "mod" of random numbers'
    if expression.operator == "uniform" and is_random(expression.operands[0]):
        return "random numbers from a random number on"
    if simplified(expression) != expression:
        return f'other words for "{simplified(expression).operator}"'
    return None
