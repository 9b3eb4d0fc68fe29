"""Growth: how many modules a system has at any step, from the table of its states alone.

Entry (i, j) of the growth matrix says how many modules of state j the successor of state i holds. The counts at step n are the
axiom's counts times the n-th power of that matrix (Rozenberg and Salomaa, The Mathematical Theory of L Systems, 1980).

The lengths, and the counts, are sequences of whole numbers in which each term is a fixed linear combination of the terms
before it: linear recurrences. A rule is a tuple of coefficients c: a(t) = c1 a(t-1) + ... + cd a(t-d) for all t from d on. Its
polynomial is x^d - c1 x^(d-1) - ... - cd.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial, reduce
from itertools import count, islice, zip_longest
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from lsys_kit.budget import Task, check_budget, check_bytes, counted, current
from lsys_kit.derivation.core.chance import splitmix64
from lsys_kit.derivation.core.states import States, check_d0l, closure
from lsys_kit.derivation.engines.counting import next_counts
from lsys_kit.derivation.growth.slicing import slice_system
from lsys_kit.errors import ModelLimitError, ModelValueError, require, shown, whole_number
from lsys_kit.notation.model.arithmetic import is_symbolic
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.supervision import supervised

if TYPE_CHECKING:
    import sympy


RELATIVE_ZERO = 1e-9
"""A polynomial's value that is no larger than this share of its summands is 0."""

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


def _massey(terms: Sequence[Element], prime: int) -> list[Element]:
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
    x, t = whole.gen, t or unknown("t", rule, terms)
    series = sympy.Poly(list(terms[: len(rule)]) or [0], x)  # the terms as digits behind the point, in powers of 1/x
    above, _ = (whole * series).div(sympy.Poly(x ** len(rule), x))
    factors = [(factor.to_field().monic(), times) for factor, times in whole.factor_list()[1]]
    if any(factor.degree() > 2 and (times > 1 or factor.free_symbols_in_domain) for factor, times in factors):
        return None
    return sum((_part(above, whole, factor, times, t) for factor, times in factors), sympy.Integer(0))


def _part(above: sympy.Poly, whole: sympy.Poly, factor: sympy.Poly, times: int, t: sympy.Symbol) -> sympy.Expr:
    """What the roots of one factor of the polynomial contribute: the residues of above/whole x^t there."""
    import sympy

    x = whole.gen
    if factor.as_expr() == x:
        return _beginning(above, whole, times, t)
    if factor.degree() > 2:
        weight = sympy.rem((above * sympy.invert(whole.diff(x), factor)), factor).as_expr()
        return sympy.RootSum(factor.as_expr(), sympy.Lambda(x, weight * x**t))
    if times == factor.degree() == 1:
        root = -factor.nth(0)
        return sympy.cancel(above.as_expr() / whole.quo(factor).as_expr()).subs(x, root) * root**t
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


OBJECT_BYTES = 36
"""What an integer and its place in a row take, besides its digits."""


def counts_of_steps(table: States) -> Iterator[Mapping[int, int]]:
    """How often each state occurs at step 0, 1, 2, ...

    >>> from lsys_kit import read
    >>> [dict(counts) for counts in islice(counts_of_steps(States(read("axiom: a\\na -> ab\\nb -> a"))), 3)]
    [{0: 1}, {0: 1, 1: 1}, {0: 2, 1: 1}]
    """
    counts: Mapping[int, int] = Counter(table.axiom)
    while True:
        yield counts
        check_budget()
        counts = next_counts(table, counts)


def row_of(table: States, counts: Mapping[int, int]) -> tuple[int, ...]:
    """The count of each state."""
    return tuple(counts.get(state, 0) for state in range(len(table)))


def held(rows: Iterator[tuple[int, ...]]) -> Iterator[tuple[int, ...]]:
    """The same rows of counts, as long as there is room for all of them."""
    size = 0
    for row in rows:
        size += sum(OBJECT_BYTES + number.bit_length() // 8 for number in row)
        check_bytes(size, lambda: "The counts of so many steps were not found")
        yield row


def orbit(table: States) -> tuple[tuple[int, ...], list[tuple[int, ...]]]:
    """The shortest rule that the counts of all states obey together, and as many rows of counts.

    It is the rule of a weighted sum of the counts, unless the weights are unlucky; so it is checked against the counts.

    >>> from lsys_kit import read
    >>> states = States(read("axiom: a\\na -> ab\\nb -> a"))
    >>> [len(states.successor(state)) for state in (0, 1)], orbit(states)
    ([2, 1], ((1, 1), [(1, 0), (1, 1)]))
    """
    rows = list(held(row_of(table, counts) for counts in islice(counts_of_steps(table), 2 * len(table) + 2)))
    rule = next(rule for rule in map(partial(_rule_of_weighted_sum, rows), count()) if _continued(rule, rows))
    return rule, rows[: len(rule)]


def _rule_of_weighted_sum(rows: Sequence[Sequence[int]], trial: int) -> tuple[int, ...]:
    """The shortest rule of a sum of the counts, with other weights at each trial."""
    weights = [splitmix64(splitmix64(trial) ^ state) % 2**20 for state in range(len(rows[0]))]
    return tuple(map(int, shortest_rule([sum(map(int.__mul__, weights, row)) for row in rows])))


def _continued(rule: Sequence[int], rows: Sequence[Sequence[int]]) -> bool:
    """Whether a rule gives each count of the row behind the first ones."""
    size = len(rule)
    return all(
        column[size] == sum(c * column[size - k] for k, c in enumerate(rule, 1) if c) for column in zip(*rows, strict=True)
    )


DIGITS, RECURRENCE_MISSING = 3_000_000, "The recurrence of the lengths was not found"
"""The most digits of a count."""


@dataclass(frozen=True)
class Growth:
    """The growth of a system with finitely many states.

    Attributes
    ----------
    table
        The table of all states.
    """

    table: States

    @property
    def states(self) -> tuple[Module, ...]:
        """The module of each state, in the order of the rows and columns of the matrix."""
        return tuple(self.table.modules)

    @property
    def matrix(self) -> sympy.Matrix:
        """The growth matrix: entry (i, j) is how many j the successor of i holds.

        >>> from lsys_kit import read
        >>> growth(read("axiom: a\\na -> ab\\nb -> a")).matrix
        Matrix([
        [1, 1],
        [1, 0]])
        """
        import sympy

        with Task("The growth matrix was not found"), supervised():
            rows = [Counter(self.table.successor(state)) for state in range(len(self.table))]
            return sympy.Matrix(len(rows), len(rows), lambda i, j: rows[i][j])

    def counts(self, step: int) -> tuple[int, ...]:
        """How often each state occurs at a step, exactly, however late the step is.

        >>> from lsys_kit import read
        >>> found = growth(read("axiom: a\\na -> ab\\nb -> a"))
        >>> found.counts(10), found.counts(1_000_000)[0].bit_length()
        ((89, 55), 694242)
        """
        with Task(f"The counts of step {shown(step)} were not found"):
            self._check(step)
            if step <= 4 * len(self.table):
                return row_of(self.table, next(islice(counts_of_steps(self.table), step, None)))
            rule, first = self._orbit
            weights = remainder_of_power(rule, step)
            return tuple(sum(c * n for c, n in zip(weights, column, strict=True) if n) for column in zip(*first, strict=True))

    def lengths(self, steps: int) -> list[int]:
        """The number of modules at steps 0 to `steps`, exactly, however large.

        >>> from lsys_kit import read
        >>> growth(read("axiom: a\\na -> ab\\nb -> a")).lengths(10)
        [1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144]
        """
        return self._summed(steps, range(len(self.table)))

    def counts_of(self, symbol: str, steps: int) -> list[int]:
        """The number of modules with a symbol at steps 0 to `steps`.

        >>> from lsys_kit import read
        >>> growth(read("axiom: a\\na -> ab\\nb -> a")).counts_of("b", 6)
        [0, 1, 1, 2, 3, 5, 8]
        """
        require(symbol, str, "A symbol")
        return self._summed(steps, [state for state, module in enumerate(self.states) if module.symbol == symbol])

    def _summed(self, steps: int, states: Sequence[int]) -> list[int]:
        last = whole_number(steps, "The step")
        with Task("The lengths were not found"):
            followed = islice(counts_of_steps(self.table), last + 1)
            rows = ((sum(counts.get(state, 0) for state in states),) for counts in followed)
            return [length for (length,) in held(rows)]

    def _check(self, step: int) -> None:
        """Refuse a step that is no whole number, or so late that its counts would be too long to use."""
        step = whole_number(step, "The step")
        digits = step * math.log10(max(greatest_root(self.recurrence, exact=False), 1)) if step > DIGITS else 0
        if digits > DIGITS:
            raise ModelLimitError(
                f"The numbers of step {step:,} would have about {digits:,.0f} digits; the limit is {DIGITS:,}",
                limit=DIGITS,
                needed=digits,
                hint="Take fewer steps.",
            )

    def length(self, step: int) -> int:
        """The number of modules at a step, exactly, without the steps before.

        >>> from lsys_kit import read
        >>> growth(read("axiom: a\\na -> ab\\nb -> a")).length(100)
        927372692193078999176
        """
        with Task(f"The length of step {shown(step)} was not found"):
            self._check(step)
            rule, terms = self._rule
            return sum(c * term for c, term in zip(remainder_of_power(rule, step), terms, strict=True))

    def recurrence_of(self, symbol: str) -> tuple[int, ...]:
        """The shortest rule for the number of modules with a symbol, in the long run.

        >>> from lsys_kit import read
        >>> growth(read("axiom: A\\nA -> A B\\nB -> B C")).recurrence_of("B")
        (2, -1)
        """
        with Task(RECURRENCE_MISSING):
            return tuple(map(int, shortest_recurrence(self.counts_of(symbol, 2 * len(self.table) + 1))))

    @cached_property
    def recurrence(self) -> tuple[int, ...]:
        """The shortest rule for the lengths in the long run: coefficients c of N(t) = c1 N(t-1) + c2 N(t-2) + ...

        >>> from lsys_kit import read
        >>> growth(read("axiom: a\\na -> ab\\nb -> a")).recurrence
        (1, 1)
        """
        with Task(RECURRENCE_MISSING):
            return tuple(map(int, shortest_recurrence(self._terms)))

    @cached_property
    def _rule(self) -> tuple[tuple[int, ...], list[int]]:
        """The shortest rule that the lengths obey from the first on, and as many lengths."""
        rule = tuple(map(int, shortest_rule(self._terms)))
        return rule, self._terms[: len(rule)]

    @cached_property
    def _terms(self) -> list[int]:
        """As many lengths as determine their shortest rule (Massey 1969)."""
        return self.lengths(2 * len(self.table) + 1)

    @cached_property
    def _orbit(self) -> tuple[tuple[int, ...], list[tuple[int, ...]]]:
        return orbit(self.table)

    @property
    def characteristic(self) -> sympy.Poly:
        """The characteristic polynomial of the growth matrix: a multiple of `polynomial`.

        >>> from lsys_kit import read
        >>> growth(read("axiom: a\\na -> ab\\nb -> a")).characteristic.as_expr()
        x**2 - x - 1
        """
        import sympy

        with Task("The characteristic polynomial was not found"), supervised():
            return self.matrix.charpoly(sympy.Symbol("x"))

    @property
    def polynomial(self) -> sympy.Poly:
        """The polynomial of the recurrence, whose largest root is the growth per step."""
        return polynomial(self.recurrence)

    @property
    def generating_function(self) -> sympy.Expr:
        """The function whose power series in x has the lengths as coefficients.

        >>> from lsys_kit import read
        >>> growth(read("axiom: a\\na -> ab\\nb -> a")).generating_function
        (x + 1)/(-x**2 - x + 1)
        """
        return generating_function(*self._rule)

    @property
    def closed_form(self) -> sympy.Expr | None:
        """A formula for the length at step t; None where it would need a multiple root of a polynomial of degree three or more.

        >>> from lsys_kit import read
        >>> growth(read("axiom: b\\na -> ab\\nb -> a")).closed_form
        (1/2 - sqrt(5)/2)**t*(1/2 - sqrt(5)/10) + (1/2 + sqrt(5)/2)**t*(sqrt(5)/10 + 1/2)
        >>> growth(read("axiom: F\\nF -> F+F")).closed_form
        2*2**t - 1
        """
        with Task("The closed form was not found"), supervised():
            return closed_form(*self._rule)

    @property
    def rate(self) -> float:
        """By what factor the word grows in one step, in the long run: the largest root of the recurrence's polynomial.

        Where the lengths oscillate, as those of A -> BB, B -> A do, it is the factor of a whole period, spread over its steps.

        >>> from lsys_kit import read
        >>> round(growth(read("axiom: A\\nA -> BB\\nB -> A")).rate**2, 9)
        2.0
        """
        with Task("The growth per step was not found"):
            return greatest_root(self.recurrence)

    @property
    def frequencies(self) -> tuple[float, ...] | None:
        """What share of the word each state has in the long run; None where they do not converge, or the word vanishes.

        >>> from lsys_kit import read
        >>> [round(share, 6) for share in growth(read("axiom: a\\na -> ab\\nb -> a")).frequencies]
        [0.618034, 0.381966]
        >>> growth(read("axiom: A\\nA -> BB\\nB -> A")).frequencies is None
        True
        """
        with Task("The shares of the states were not found"):
            rule, first = self._orbit
            weights = leading_weights(rule, max((n for row in first for n in row), default=0).bit_length())
            if weights is None:
                return None
            parts = [max(0, sum(w * n for w, n in zip(weights, column, strict=True))) for column in zip(*first, strict=True)]
            whole = sum(parts)
            return tuple(round(part / whole, 15) for part in parts)

    def __repr__(self) -> str:
        rule = " + ".join(f"{'' if c == 1 else f'{c} '}N(t-{k})" for k, c in enumerate(self.recurrence, 1) if c)
        rule = rule.replace("+ -1 ", "- ").replace("+ -", "- ")
        return (
            f"{len(self.table)} states; lengths {', '.join(map(str, self.lengths(9)))}, ...; "
            f"N(t) = {rule or 0}; growth per step {self.rate:.4f}"
        )


def growth(system: LSystem, **constants: object) -> Growth:
    """The growth of a system.

    Parameters
    ----------
    system
        A system with finitely many states: from some step on, no new module appears. Where there are too many, modules that
        differ only in parameters that decide nothing are counted as one (see `slice_system`).
    **constants
        New values for declared constants.

    Raises
    ------
    ModelLimitError
        The system reaches too many distinct modules.
    ModelValueError
        What becomes of a module depends on its neighbours or on chance.

    Examples
    --------
    >>> from lsys_kit import read
    >>> growth(read("axiom: a\\na -> ab\\nb -> a"))
    2 states; lengths 1, 2, 3, 5, 8, 13, 21, 34, 55, 89, ...; N(t) = N(t-1) + N(t-2); growth per step 1.6180
    """
    require(system, LSystem, "An L-system")
    with Task("The growth was not found"):
        with suppress(ModelValueError):  # what cannot be counted may not matter, and be sliced away
            states = States(system, constants)
            if states.traits.d0l and closure(states, current().states) is not None:
                return Growth(states)
        states = States(slice_system(system), constants)
        check_d0l(states, "Growth")
        if closure(states, current().states) is None:
            raise ModelLimitError(
                f"The system reaches too many distinct modules for a finite growth matrix: more than {current().states:,}",
                limit=current().states,
                needed=len(states),
                hint=f"The last one was {states.modules[-1]}; where a condition depends on a parameter that "
                "grows for ever, there is no growth matrix.",
            )
        return Growth(states)
