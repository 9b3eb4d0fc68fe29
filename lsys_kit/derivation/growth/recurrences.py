"""Linear recurrences: sequences of whole numbers in which each term is a fixed linear combination of the terms before it.

The lengths of a D0L system's words are such a sequence (Rozenberg and Salomaa, The Mathematical Theory of L Systems, 1980). A
rule is a tuple of coefficients c: a(t) = c1 a(t-1) + ... + cd a(t-d) for all t from d on. Its polynomial is
x^d - c1 x^(d-1) - ... - cd.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from lsys_kit.budget import check_budget, counted
from lsys_kit.supervision import supervised

if TYPE_CHECKING:
    import sympy

RELATIVE_ZERO = 1e-9
"""A polynomial's value that is no larger than this share of its summands is 0."""

MERSENNE = (61, 127, 521, 1279, 4423)
"""2 to each of these, less 1, is a prime number: a rule is found modulo one of them, and then proved in whole numbers."""


def shortest_rule(terms: Sequence[int]) -> tuple[Fraction, ...]:
    """The shortest rule that a sequence obeys from its first terms on, which are as many as the rule has coefficients.

    >>> [int(c) for c in shortest_rule([3, 0, 0, 0])]
    [0]
    """
    for exponent in MERSENNE:
        prime = 2**exponent - 1
        rule = tuple(c - prime if c > prime // 2 else c for c in _massey(terms, prime))
        if _obeyed(rule, terms):
            return tuple(map(Fraction, rule))
    return tuple(map(Fraction, _massey(terms, 0)))


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


def _massey(terms: Sequence[int], prime: int) -> list[Any]:
    """The shortest rule, modulo a prime number; in rational numbers where that is 0."""
    rule: list[Any] = []
    best: list[Any] = []
    best_end, best_error = -1, 1
    for t, term in enumerate(counted(terms, 1)):
        error: Any = term - sum(c * terms[t - k] for k, c in enumerate(rule, 1) if c)
        error = error % prime if prime else Fraction(error)
        if not error:
            continue
        if best_end < 0:
            best_end, best_error, rule = t, error, [0] * (t + 1)
            continue
        factor = error * pow(best_error, -1, prime) if prime else error / best_error
        update = [0] * (t - best_end - 1) + [factor] + [-factor * c for c in best]
        before, size = rule, max(len(rule), len(update))
        rule = [a + b for a, b in zip(_padded(rule, size), _padded(update, size), strict=True)]
        rule = [c % prime for c in rule] if prime else rule
        if t - len(before) > best_end - len(best):
            best, best_end, best_error = before, t, error
    return rule


def _padded(row: list[Any], size: int) -> list[Any]:
    return row + [0] * (size - len(row))


def remainder_of_power(rule: Sequence[int], exponent: int) -> list[int]:
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


def polynomial(rule: Sequence[int]) -> sympy.Poly:
    """The polynomial of a rule.

    >>> polynomial((1, 1)).as_expr()
    x**2 - x - 1
    """
    import sympy

    return sympy.Poly([1, *(-c for c in rule)], sympy.Symbol("x"))


def generating_function(rule: Sequence[int], terms: Sequence[int]) -> sympy.Expr:
    """The quotient of polynomials whose power series has the terms as coefficients.

    >>> generating_function((1, 1), [1, 2])
    (x + 1)/(-x**2 - x + 1)
    """
    import sympy

    x = sympy.Symbol("x")
    above = [a - sum(c * terms[t - k] for k, c in enumerate(rule[:t], 1)) for t, a in enumerate(terms[: len(rule)])]
    below = [1, *(-c for c in rule)]
    return sympy.Poly(above[::-1] or [0], x).as_expr() / sympy.Poly(below[::-1], x).as_expr()


def greatest_root(rule: Sequence[int], exact: bool = True) -> float:
    """The largest root of the polynomial of a sequence of counts: it is real, and no other is larger in absolute value.

    Newton's method comes down to it from above: beyond its largest root the polynomial and its derivatives are positive.

    Where that is to be exact, multiple roots are made simple first: with them some five digits are right.

    >>> round(greatest_root((3, -3, 1)), 12)
    1.0
    """
    if not any(rule):
        return 0.0
    if exact:
        with supervised():
            rule = [-int(c) for c in polynomial(rule).sqf_part().all_coeffs()[1:]]
    above, root = math.inf, 2 * max(math.exp(math.log(abs(c)) / k) for k, c in enumerate(rule, 1) if c)
    while root < above:
        check_budget()
        value, slope = 1.0, 0.0
        for k, share in _scaled(rule, root):
            value, slope = value - share, slope + k * share
        above, root = root, root * (1 - value / (len(rule) * value + slope)) if value > 0 else root
    return above


def _scaled(rule: Sequence[int], root: float) -> list[tuple[int, float]]:
    """Each coefficient c of a rule, with its number k, as c / root^k."""
    logarithm = math.log(root)
    return [(k, math.copysign(math.exp(math.log(abs(c)) - k * logarithm), c)) for k, c in enumerate(rule, 1) if c]


def leading_weights(rule: Sequence[int], bits: int) -> list[int] | None:
    """The weights, as multiples of a small unit, with which the first terms of sequences that obey a rule add up to what grows
    fastest in each of them.

    None where they die out, or where that swings for ever: where the largest root is not alone, counting as often as it is a
    root. The others are then its products with roots of unity (Perron and Frobenius).

    The rule is the shortest of several sequences of counts together; so many bits the first terms have, for the precision.

    >>> weights = leading_weights((1, 1), 2)
    >>> round(weights[0] / weights[1], 6)
    0.618034
    """
    if not any(rule):
        return None
    peak = greatest_root(rule)
    with supervised():
        rows = [[int(c) for c in factor.all_coeffs()] for factor, _ in polynomial(rule).sqf_list()[1]]
    row = min(rows, key=lambda row: abs(1 - sum(share for _, share in _scaled([-c for c in row[1:]], peak))))
    if _swings([-c for c in row[1:]], peak):
        return None
    digits = len(rule) * math.ceil(math.log2(peak + 2)) + max(abs(c) for c in rule).bit_length()
    places = 128 + 2 * (bits + digits)
    root = _refined(row, round(Fraction(peak) * 2**places), places)
    weights = [2**places]
    for c in rule[:-1]:  # the rule's polynomial, divided by x - root
        weights.append((weights[-1] * root >> places) - (c << places))
    return weights[::-1]


def _swings(rule: Sequence[int], root: float) -> bool:
    """Whether a rule's polynomial has another root, the product of the given one with a root of unity."""
    shares = np.zeros(len(rule) + 1)
    shares[0] = -1
    for k, share in _scaled(rule, root):
        shares[k] = share
    for order in range(2, len(rule) + 1):
        folded = np.bincount(np.arange(len(shares)) % order, weights=shares)
        if np.any(abs(np.fft.fft(folded)[1:]) < RELATIVE_ZERO * abs(shares).sum()):
            return True
    return False


def _refined(row: Sequence[int], root: int, places: int) -> int:
    """A simple root of a polynomial, by Newton's method, as a multiple of 2^-places."""
    for _ in range(places.bit_length()):
        value = slope = 0
        for c in row:
            value, slope = (value * root >> places) + (c << places), (slope * root >> places) + value
        root -= (value << places) // slope
    return root


def closed_form(rule: Sequence[int], terms: Sequence[int]) -> sympy.Expr | None:
    """A formula for the terms of a sequence; its t is a whole number from 0 on.

    Roots of degree two and less are written out, others are summed over as roots of their polynomial; None where such a
    root is a multiple one.

    >>> closed_form((0, 4), [1, 6])
    -(-2)**t + 2*2**t
    >>> closed_form((2, -1), [3, 5])
    2*t + 3
    """
    import sympy

    x, t = sympy.Symbol("x"), sympy.Symbol("t")
    whole = polynomial(rule)
    series = sympy.Poly(list(terms[: len(rule)]) or [0], x)  # the terms as digits behind the point, in powers of 1/x
    above, _ = (whole * series).div(sympy.Poly(x ** len(rule), x))
    total = sympy.Integer(0)
    for factor, times in whole.factor_list()[1]:
        part = _part(above, whole, factor, times, t)
        if part is None:
            return None
        total += part
    return total


def _part(above: sympy.Poly, whole: sympy.Poly, factor: sympy.Poly, times: int, t: sympy.Symbol) -> sympy.Expr | None:
    """What the roots of one factor of the polynomial contribute: the residues of above/whole x^t there."""
    import sympy

    x = whole.gen
    if factor == sympy.Poly(x, x):
        return _beginning(above, whole, times, t)
    if times == 1 and factor.degree() > 2:
        weight = sympy.rem((above * sympy.invert(whole.diff(x), factor)), factor).as_expr()
        return sympy.RootSum(factor.as_expr(), sympy.Lambda(x, weight * x**t))
    if factor.degree() > 2:
        return None
    roots = list(sympy.roots(factor))
    rest = whole.quo(factor**times).as_expr()
    total = sympy.Integer(0)
    for root in roots:
        others = rest * reduce(lambda product, other: product * (x - other) ** times, [r for r in roots if r != root], 1)
        share = sympy.diff(above.as_expr() / others * x**t, x, times - 1) / sympy.factorial(times - 1)
        weight = sympy.expand(sympy.radsimp(sympy.simplify(share.subs(x, root) / root**t)))
        total += sympy.expand(weight) * root**t
    return total


def _beginning(above: sympy.Poly, whole: sympy.Poly, times: int, t: sympy.Symbol) -> sympy.Expr:
    """What the root 0 contributes: a summand for each of the first terms that the rest of the formula does not reach."""
    import sympy

    x = whole.gen
    rest = whole.quo(sympy.Poly(x**times, x))
    part = sympy.rem(above * sympy.invert(rest, sympy.Poly(x**times, x)), sympy.Poly(x**times, x))
    digits = part.all_coeffs()[::-1]
    return sum((c * sympy.KroneckerDelta(t, times - 1 - power) for power, c in enumerate(digits)), sympy.Integer(0))
