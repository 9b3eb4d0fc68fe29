"""Linear recurrences: the shortest rule that a sequence obeys, any of its terms, and a formula for all of them.

A rule is a tuple of coefficients c: a(t) = c1 a(t-1) + ... + cd a(t-d) for all t from d on. Its polynomial is
x^d - c1 x^(d-1) - ... - cd. The coefficients are numbers, or elements of a field of rational functions of letters.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import reduce
from itertools import zip_longest
from math import factorial
from typing import TYPE_CHECKING, Any, TypeAlias

from lsys_kit.budget import check_budget, counted
from lsys_kit.notation.model.arithmetic import is_symbolic

if TYPE_CHECKING:
    import sympy

Element: TypeAlias = Any
"""An element of a field: a whole or rational number, or one of sympy's fields."""
MERSENNE = (61, 127, 521, 1279, 4423)
"""2 to each of these, less 1, is a prime number: a rule is found modulo one of them, and then proved in whole numbers."""


def shortest_rule(terms: Sequence[Element]) -> tuple[Element, ...]:
    """The shortest rule that a sequence obeys from its first terms on, which are as many as the rule has coefficients.

    The terms are whole numbers, or elements of any field, as are the coefficients.

    >>> [int(c) for c in shortest_rule([3, 0, 0, 0])]
    [0]
    """
    for exponent in MERSENNE if all(isinstance(term, int) for term in terms) else ():
        prime = 2**exponent - 1
        rule = tuple(c - prime if c > prime // 2 else c for c in _massey(terms, prime))
        if _obeyed(rule, terms):
            return tuple(map(Fraction, rule))
    return tuple(Fraction(c) if isinstance(c, int) else c for c in _massey(terms, 0))


def shortest_recurrence(terms: Sequence[int]) -> list[Fraction]:
    """The shortest rule that a sequence obeys in the long run (Berlekamp 1968, Massey 1969).

    >>> [int(c) for c in shortest_recurrence([1, 1, 1, 2, 2, 3, 4, 5, 7, 9])]
    [0, 1, 1]
    """
    rule = list(shortest_rule(terms))
    while rule and not rule[-1]:
        rule.pop()
    return rule


def _obeyed(rule: Sequence[int], terms: Sequence[int]) -> bool:
    used = [(k, c) for k, c in enumerate(rule, 1) if c]
    return all(terms[t] == sum(c * terms[t - k] for k, c in used) for t in counted(range(len(rule), len(terms)), 1))


def _massey(terms: Sequence[int], prime: int) -> list[Element]:
    """The shortest rule, modulo a prime number; in rational numbers where that is 0."""
    rule: list[Element] = []
    best: list[Element] = []
    best_end, best_error = -1, 1
    for t, term in enumerate(counted(terms, 1)):
        error: Element = term - sum(c * terms[t - k] for k, c in enumerate(rule, 1) if c)
        error = error % prime if prime else Fraction(error) if isinstance(error, int) else error
        if not error:
            continue
        if best_end < 0:
            best_end, best_error, rule = t, error, [0] * (t + 1)
            continue
        factor = error * pow(best_error, -1, prime) if prime else error / best_error
        update = [0] * (t - best_end - 1) + [factor] + [-factor * c for c in best]
        before, rule = rule, [a + b for a, b in zip_longest(rule, update, fillvalue=0)]
        rule = [c % prime for c in rule] if prime else rule
        if t - len(before) > best_end - len(best):
            best, best_end, best_error = before, t, error
    return rule


def remainder_of_power(rule: Sequence[Element], exponent: int) -> list[Element]:
    """What x^exponent leaves when divided by a rule's polynomial, from the constant term up (Fiduccia 1985).

    So term number `exponent` of any sequence that obeys the rule is a sum of multiples of its first terms.

    >>> remainder_of_power((1, 1), 10)
    [34, 55]
    """
    used = [(k, c) for k, c in enumerate(rule, 1) if c]
    found = [1] + [0] * (len(rule) - 1) if rule else []
    for bit in f"{exponent:b}" if rule else "":
        square = [0] * (2 * len(rule))
        for i, a in enumerate(counted(found, 1)):
            if a:
                square[2 * i + (bit == "1")] += a * a
                for j in range(i):
                    square[i + j + (bit == "1")] += 2 * a * found[j]
        for degree in range(len(square) - 1, len(rule) - 1, -1):
            top = square.pop()
            check_budget()
            for k, c in used if top else ():
                square[degree - k] += c * top
        found = square
    return found


def polynomial(rule: Sequence[int], terms: Sequence[int] = ()) -> sympy.Poly:
    """The polynomial of a rule; its x is none of the letters in the rule and in the terms.

    >>> polynomial((1, 1)).as_expr()
    x**2 - x - 1
    """
    import sympy

    return sympy.Poly([1, *(-c for c in rule)], unknown("x", rule, terms))


def unknown(name: str, *coefficients: Sequence[object]) -> sympy.Symbol:
    """A symbol of this name, or, where coefficients have a letter that is called so, of this name and a number."""
    from sympy.core.symbol import uniquely_named_symbol

    return uniquely_named_symbol(name, [c for each in coefficients for c in each if is_symbolic(c)])


def generating_function(rule: Sequence[int], terms: Sequence[int]) -> sympy.Expr:
    """The quotient of polynomials whose power series has the terms as coefficients.

    >>> generating_function((1, 1), [1, 2])
    (x + 1)/(-x**2 - x + 1)
    """
    import sympy

    x = unknown("x", rule, terms)
    above = [a - sum(c * terms[t - k] for k, c in enumerate(rule[:t], 1)) for t, a in enumerate(terms[: len(rule)])]
    below = [1, *(-c for c in rule)]
    return sympy.Poly(above[::-1] or [0], x).as_expr() / sympy.Poly(below[::-1], x).as_expr()


def closed_form(rule: Sequence[int], terms: Sequence[int], t: sympy.Symbol | None = None) -> sympy.Expr | None:
    """A formula for the terms of a sequence; its t is a whole number from 0 on.

    Roots of degree two and less are written out, others are summed over as roots of their polynomial; None where such a
    root is a multiple one, or has letters. The coefficients are whole numbers, or sympy's expressions in letters.

    >>> closed_form((0, 4), [1, 6])
    -(-2)**t + 2*2**t
    >>> closed_form((2, -1), [3, 5])
    2*t + 3
    """
    import sympy

    whole = polynomial(rule, terms)
    found = solved(whole, sympy.Poly(list(terms[: len(rule)]) or [0], whole.gen), t or unknown("t", rule, terms))
    return None if found is None else found[0]


def solved(whole: sympy.Poly, terms: sympy.Poly, t: sympy.Symbol) -> tuple[sympy.Expr, dict[sympy.Expr, None]] | None:
    """A formula as in `closed_form`, and by which polynomials in the letters it divides: for letters where one of these is 0 it
    says nothing.

    Parameters
    ----------
    whole
        The polynomial of a rule, of degree d.
    terms
        The first d terms as coefficients, from that of x^(d-1) down.
    t
        The step in the formula.
    """
    import sympy

    whole, terms = whole.unify(terms)
    x, whole, terms = whole.gen, whole.to_field(), terms.to_field()
    above, _ = (whole * terms).div(sympy.Poly(x ** whole.degree(), x))  # the terms as digits behind the point, in powers of 1/x
    found, divisors = sympy.Integer(0), dict[sympy.Expr, None]()
    for factor, times in whole.factor_list()[1]:
        monic = factor.monic()
        if monic.as_expr() == x:
            part, weights = _beginning(above, whole, times, t)
        elif monic.degree() > 2 and (times > 1 or _has_letters(monic)):
            return None
        else:
            weights = [*_weights(above, whole, monic, times)]
            part = _part(monic, weights, t)
        found += part
        divisors |= dict.fromkeys(divisor for each in (monic, *weights) for divisor in _divisors(each))
    return found, divisors


def _weights(above: sympy.Poly, whole: sympy.Poly, factor: sympy.Poly, times: int) -> Iterator[sympy.Poly]:
    """By what each root x of a factor contributes to the terms: multiples of x^t, t x^t, t(t-1)/2 x^t and so on, the last of
    these first. They are what is left of polynomials in x when they are divided by the factor.

    With y = x + z for a root x, above/whole is a power series in z, but for z^-times; its coefficients are those of above, of
    which each is a derivative, divided by those of whole.
    """
    import sympy

    x = whole.gen
    series = [_derivative(above, k).rem(factor) for k in range(times)]
    below = [_derivative(whole, times + k).rem(factor) for k in range(times)]
    inverse, back = below[0].invert(factor), sympy.Poly(x, x, domain=factor.domain).invert(factor)
    found: list[sympy.Poly] = []
    for k in range(times):
        check_budget()
        left = reduce(lambda rest, j: rest - below[j] * found[k - j], range(1, k + 1), series[k])
        found.append((left * inverse).rem(factor))
        yield reduce(lambda weight, _: (weight * back).rem(factor), range(times - 1 - k), found[k])


def _derivative(polynomial: sympy.Poly, order: int) -> sympy.Poly:
    """A derivative, divided by the factorial of its order."""
    return polynomial.diff((polynomial.gen, order)).quo_ground(factorial(order))


def _part(factor: sympy.Poly, weights: Sequence[sympy.Poly], t: sympy.Symbol) -> sympy.Expr:
    """What the roots of one factor of the polynomial contribute."""
    import sympy

    x, times = factor.gen, len(weights)
    often = [sympy.ff(t, k) / sympy.factorial(k) for k in range(times)][::-1]
    weight = sympy.Add(*(each.as_expr() * many for each, many in zip(weights, often, strict=True)))
    if factor.degree() > 2:
        return sympy.RootSum(factor.as_expr(), sympy.Lambda(x, weight * x**t))
    roots = [-factor.nth(0)] if factor.degree() == 1 else [*sympy.roots(factor)]
    return sympy.Add(*(_expanded(weight.subs(x, root), t) * root**t for root in roots))


def _expanded(weight: sympy.Expr, t: sympy.Symbol) -> sympy.Expr:
    import sympy

    return weight if weight.is_Rational else sympy.expand(sympy.radsimp(weight))


def _has_letters(polynomial: sympy.Poly) -> bool:
    """Whether a coefficient is no number."""
    return bool(polynomial.free_symbols_in_domain) and not all(
        part.is_ground for each in polynomial.rep.all_coeffs() for part in (each.numer, each.denom)
    )


def _divisors(polynomial: sympy.Poly) -> Iterator[sympy.Expr]:
    """By what the coefficients of a polynomial divide: polynomials in letters that cannot be divided further."""
    for coefficient in polynomial.rep.all_coeffs() if polynomial.free_symbols_in_domain else ():
        for divisor, _ in coefficient.denom.factor_list()[1]:
            yield divisor.as_expr()


def _beginning(above: sympy.Poly, whole: sympy.Poly, times: int, t: sympy.Symbol) -> tuple[sympy.Expr, list[sympy.Poly]]:
    """What the root 0 contributes: a summand for each of the first terms that the rest of the formula does not reach; and the
    polynomial whose coefficients these are."""
    import sympy

    x = whole.gen
    rest = whole.quo(sympy.Poly(x**times, x))
    part = sympy.rem(above * sympy.invert(rest, sympy.Poly(x**times, x)), sympy.Poly(x**times, x))
    digits = part.all_coeffs()[::-1]
    return sympy.Add(*(c * sympy.KroneckerDelta(t, times - 1 - power) for power, c in enumerate(digits))), [part]
