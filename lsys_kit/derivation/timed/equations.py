"""Equations of growth: where a sum of powers, or any expression with one name, is 0."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from itertools import pairwise
from typing import TYPE_CHECKING

from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.arithmetic import number_text

if TYPE_CHECKING:
    import sympy

MOST_DEGREE = 60
"""The highest degree of a polynomial whose roots are all looked for."""
FARTHEST = 700.0
"""The logarithm of the largest root that is looked for, about that of the largest double."""


def growth_base(t_div: float, t_s: float, t_l: float) -> float:
    """The base a of exponential growth that is continuous at a division: a^t_div = a^t_s + a^t_l (Prusinkiewicz,
    Introduction to Modeling with L-systems, section 8).

    Parameters
    ----------
    t_div, t_s, t_l
        The age at division, and the ages at which the short and the long daughter begin.

    Raises
    ------
    ModelValueError
        No base above 1 does: a daughter begins as old as the mother divides, or older.

    Examples
    --------
    >>> round(growth_base(1, 0, 0.2), 9)
    2.167303978
    """
    if not (max(t_s, t_l) < t_div and math.isfinite(t_div - min(t_s, t_l))):
        raise ModelValueError(
            f"With daughters of age {t_s} and {t_l} no growth is continuous at the age {t_div}",
            hint="A daughter begins younger than the age at which cells divide.",
        )
    return positive_root([(t_div, 1), (t_s, -1), (t_l, -1)])


def positive_root(powers: Sequence[tuple[float, float]]) -> float:
    """The one z > 0 at which a sum of powers is 0, each an exponent with a coefficient, whose coefficients change their sign
    once: there is just one such z, by Descartes' rule of signs, which holds for all real exponents.

    >>> round(positive_root([(2, 1), (1, -1), (0, -1)]), 9)
    1.618033989
    """
    exponents = [float(exponent) for exponent, _ in powers]

    def total(log: float) -> float:
        """The sum at z = e^log, as a share of its greatest power."""
        greatest = max(exponent * log for exponent in exponents)
        return math.fsum(c * math.exp(exponent * log - greatest) for exponent, (_, c) in zip(exponents, powers, strict=True))

    if (total(-FARTHEST) < 0) == (total(FARTHEST) < 0):
        raise ModelValueError(
            "The solution is too large or too small for a floating-point number",
            hint="Let a daughter begin clearly younger than the age at which cells divide.",
        )
    return math.exp(bisected(total, -FARTHEST, FARTHEST))


def bisected(function: Callable[[float], float], low: float, high: float) -> float:
    """Where a function changes its sign, found by halving the stretch in which it does."""
    rises = function(low) < 0
    while low < (middle := (low + high) / 2) < high:
        low, high = (middle, high) if (function(middle) < 0) == rises else (low, middle)
    return high


def roots(equation: sympy.Expr, low: float | None = None, high: float | None = None) -> list[sympy.Expr]:
    """The real values of the one name in an expression with which it is 0; exact where they are written with square roots.

    All values are found where it is a sum of powers of the name, or of e^name; an expression of another kind must have opposite
    signs at the two numbers between which the values lie.

    >>> import sympy
    >>> rate = sympy.Symbol("B", real=True)
    >>> roots(sympy.exp(2*rate) - sympy.exp(rate) - 1)
    [log(1/2 + sqrt(5)/2)]
    """
    import sympy

    name, z = equation.free_symbols.pop(), sympy.Dummy(positive=True)
    least, greatest = -sympy.oo if low is None else low, sympy.oo if high is None else high
    found = _roots_of_powers(equation, name)
    if found is None:
        by_power = _roots_of_powers(_in_powers(sympy.expand(equation, multinomial=False), name, z), z)
        found = [_root_between(equation, name, low, high)] if by_power is None else list(map(sympy.log, by_power))
    return [root.evalf() if root.has(sympy.CRootOf) else root for root in found if least <= root <= greatest]


def _in_powers(equation: sympy.Expr, name: sympy.Symbol, z: sympy.Symbol) -> sympy.Expr:
    """An expression with z for e^name, where that is all it has of the name."""
    import sympy
    from sympy.core.function import Application

    if any(part.has(name) and not isinstance(part, sympy.exp) for part in equation.atoms(Application)):
        return equation
    powers = [(part, part.as_base_exp()) for part in equation.atoms(sympy.Pow, sympy.exp) if part.has(name)]
    return equation.xreplace(
        {
            part: z ** (exponent / name * sympy.log(base))
            for part, (base, exponent) in powers
            if base.is_number and (exponent / name).is_number
        }
    )


def _roots_of_powers(equation: sympy.Expr, z: sympy.Symbol) -> list[sympy.Expr] | None:
    """Where a sum of powers of z is 0; None where it is no such sum, or where its roots are too hard to find."""
    import sympy

    small = all(p.exp <= MOST_DEGREE for p in equation.atoms(sympy.Pow) if p.base.is_Add and p.exp.is_Integer)
    summands = sympy.Add.make_args(sympy.expand(equation, multinomial=small))
    terms = [term.as_coeff_exponent(z) for term in summands]
    if not all(part.is_number and part.is_real for term in terms for part in term):
        return None
    powers = sorted((exponent, c) for c, exponent in terms)
    parts = math.lcm(*(int(exponent.q) for exponent, _ in powers if exponent.is_Rational))
    positive = z.is_positive or not all(exponent.is_Integer for exponent, _ in powers)
    degrees = [(exponent - min(powers[0][0], 0)) * parts for exponent, _ in powers]
    if all(d.is_Integer and d <= MOST_DEGREE for d in degrees) and all(c.is_Rational for _, c in powers):
        x = sympy.Dummy()
        whole = sympy.Poly(sum(c * x**degree for degree, (_, c) in zip(degrees, powers, strict=True)), x)
        return [root**parts for root in dict.fromkeys(whole.real_roots()) if root > 0 or not positive]
    changes = sum(bool(c * after < 0) for (_, c), (_, after) in pairwise(powers))
    if changes > 1 or not positive:
        return None
    greatest = max(abs(c) for _, c in powers)
    return [sympy.Float(positive_root([(float(exponent), float(c / greatest)) for exponent, c in powers]))] if changes else []


def _root_between(equation: sympy.Expr, name: sympy.Symbol, low: float | None, high: float | None) -> sympy.Expr:
    """A root between two numbers at which an expression has opposite signs."""
    import sympy

    def value(number: float) -> float:
        with suppress(ValueError):  # it compares numbers that are not real
            found = equation.evalf(subs={name: number})
            return float(found) if found.is_real else math.nan
        return math.nan

    if low is None or high is None or not value(low) * value(high) < 0:
        raise ModelValueError(
            f'No rule finds where "{number_text(equation)}" is 0',
            hint=f"Give two numbers between which {name} lies, where the expression has opposite signs.",
        )
    return sympy.Float(bisected(value, low, high))
