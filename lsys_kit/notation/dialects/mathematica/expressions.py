"""Expressions as Mathematica writes them: its functions, with square brackets, and what it spells differently from the kit."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches

from lsys_kit.notation.model.expressions import Apply, Expression, Name, Style, styled_text

FUNCTIONS: Mapping[str, str] = {
    "Abs": "abs",
    "Floor": "floor",
    "Ceiling": "ceil",
    "Min": "min",
    "Max": "max",
    "Mod": "mod",
    "If": "if",
    "Sqrt": "sqrt",
    "Exp": "exp",
    "Log": "log",
}
"""The functions of Mathematica that are the kit's under another name."""
TESTS: Mapping[str, tuple[str | None, str, int]] = {
    "EvenQ": ("mod", "==", 0),
    "OddQ": ("mod", "==", 1),
    "Positive": (None, ">", 0),
    "Negative": (None, "<", 0),
    "NonNegative": (None, ">=", 0),
    "NonPositive": (None, "<=", 0),
}
"""Tests of a number: how it, or what is left of it modulo 2, compares with which number."""
ANGLES: Mapping[str, str] = {"Sin": "sin", "Cos": "cos", "Tan": "tan"}
"""Those that take an angle, and ..."""
INVERSES: Mapping[str, str] = {f"Arc{name}": f"a{function}" for name, function in ANGLES.items()}
"""... those that give one."""
DISTRIBUTIONS: Mapping[str, str] = {
    "NormalDistribution": "normal",
    "BinomialDistribution": "binomial",
    "PoissonDistribution": "poisson",
}
"""What a random number is drawn from."""

_BY_FUNCTION = {function: name for table in (ANGLES, INVERSES, DISTRIBUTIONS) for name, function in table.items()}
_STYLE = Style({function: name for name, function in FUNCTIONS.items()}, ("[", "]"))
_DEGREE = Name("Degree")
INSTEAD = {
    "RandomInteger": 'A whole number from 1 to 6 is "Floor[RandomReal[{1, 7}]]".',
    "Power": 'A power is typed "t^2".',
    "IntegerQ": 'Whether x is whole is asked by "Floor[x] == x".',
    "Divisible": 'Whether n can be divided by 3 is asked by "Mod[n, 3] == 0".',
}
"""What to type for some functions of Mathematica that the kit lacks."""
HEADS = ("LEFT", "PRED", "RIGHT", "SUCC", "LRule", "LRULES", "AXIOM", "LSystem", "runKLSystem")
"""What an L-system is made of."""
KNOWN = frozenset((*FUNCTIONS.values(), *_BY_FUNCTION, "uniform", "table"))
"""The functions of the kit that Mathematica has too."""


def spelling_hint(name: str) -> str | None:
    """A hint that names the function, or the part of an L-system, that was probably meant.

    >>> spelling_hint("AXOIM")
    'Did you mean "AXIOM"?'
    """
    known = {known.upper(): known for known in (*HEADS, *FUNCTIONS, *TESTS, *ANGLES)}
    close = get_close_matches(name.upper(), known, 1, 0.78)
    return f'Did you mean "{known[close[0]]}"?' if close else None


def expression_text(expression: Expression) -> str:
    """An expression in Mathematica's spelling.

    >>> expression_text(Apply("sqrt", (Apply("sin", (Apply("+", (Name("t"), Name("x"))),)),)))
    'Sqrt[Sin[(t + x) * Degree]]'
    """
    return styled_text(_respelt(expression), _STYLE)


def _respelt(expression: Expression) -> Expression:
    """The expression with a name in place of what Mathematica spells with several calls."""
    if not isinstance(expression, Apply):
        return expression
    operator, operands = expression.operator, tuple(map(_respelt, expression.operands))
    texts = ", ".join(styled_text(operand, _STYLE) for operand in operands)
    if operator in ANGLES.values():
        return Name(f"{_BY_FUNCTION[operator]}[{styled_text(Apply('*', (operands[0], _DEGREE)), _STYLE)}]")
    if operator in INVERSES.values():
        return Name(f"({_BY_FUNCTION[operator]}[{texts}]/{_DEGREE})")
    if operator in DISTRIBUTIONS.values():
        return Name(f"RandomVariate[{_BY_FUNCTION[operator]}[{texts}]]")
    if operator == "uniform":
        return Name(f"RandomReal[{{{texts}}}]")
    if operator == "table":
        return Name(f"RandomChoice[{{{texts}}} -> {{{', '.join(map(str, range(len(operands))))}}}]")
    return Apply(operator, operands)
