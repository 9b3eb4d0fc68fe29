"""Timed systems: the word at any time, not only after whole steps (ABOP, chapter 6; seed 003).

A module's one parameter is its age. A production `ar(1) -> al(0) br(0)` says at which age a cell divides, its terminal age, and
with which ages its daughters begin. With D(x, t) for what a word x becomes in a time t:

    D(xy, t) = D(x, t) D(y, t)
    D(a(age), t) = a(age + t)                             while age + t <= terminal age
                 = D(successor, t - (terminal - age))     from then on

At its terminal age a cell is not yet divided. How long the cells are is told in `continuity`; here is what its equations need.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise, repeat
from typing import TYPE_CHECKING

from lsys_kit.budget import current
from lsys_kit.derivation.rules import kind_of, number_from
from lsys_kit.derivation.states import States, check_settled
from lsys_kit.derivation.words import Word
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.arithmetic import Value, is_symbolic, number_text
from lsys_kit.notation.model import LSystem, Module, Production

if TYPE_CHECKING:
    import sympy

OFTEN = 1_024
"""After how many cells somebody looks at the clock."""
MOST_DEGREE = 60
"""The highest degree of a polynomial whose roots are all looked for."""
FARTHEST = 700.0
"""The logarithm of the largest root that is looked for, about that of the largest double."""


@dataclass(frozen=True)
class Timed:
    """A timed system.

    Attributes
    ----------
    states
        The table of its modules.
    """

    states: States

    def word(self, at: object) -> Word:
        """The word at a time.

        Parameters
        ----------
        at
            The time since the axiom: a number, exact as in `derive`.

        Raises
        ------
        ModelValueError
            The time is before the axiom, or cells divide without end in no time at all.
        ModelLimitError
            The word would be too large, or takes too long.

        Examples
        --------
        >>> from lsys_kit.notation.read import read
        >>> fibonacci = timed(read("axiom: a(0)\\na(1) -> a(0) b(0)\\nb(1) -> a(0)"))
        >>> print(fibonacci.word("5/2"), fibonacci.word(1))
        a(0.5)b(0.5)a(0.5) a(1)
        """
        given = number_from(at, "time")
        if is_symbolic(given):
            raise ModelValueError(f'"time" must be a number, not {number_text(given)!r}')
        if given < 0:
            raise ModelValueError(f"The time must not be before the axiom, which is at 0, but it is {at}")
        return self.later([self.states.modules[state] for state in self.states.axiom], given)

    def later(self, word: list[Module], passed: Value) -> Word:
        """What a row of modules becomes in a time: D(word, passed)."""
        found: list[int] = []
        until, most, deepest = time.monotonic() + current().seconds, current().modules, current().brackets
        todo = [(module, passed, 0) for module in reversed(word)]
        visited = 0
        while todo:
            module, left, instant = todo.pop()
            rest, daughters = self._division(module, left)
            if daughters is None:
                aged = (*(age + left for age in module.arguments[:1]), *module.arguments[1:])  # type: ignore[operator]
                found.append(self.states.number(module.symbol, aged))  # type: ignore[arg-type]
            elif instant > deepest:
                raise ModelValueError(f"{module} divides without end in no time at all",
                                      hint="Let a daughter begin younger than the age at which she divides.")
            else:
                instant = instant + 1 if rest == left else 0
                todo += zip(reversed(daughters), repeat(rest), repeat(instant))
            visited += 1
            if len(found) + len(todo) > most:
                raise ModelLimitError(f"The word would have more than {most:,} modules", limit=most,
                                      hint="Take an earlier time, or set limits(modules=...).")
            if visited % OFTEN == 0 and time.monotonic() > until:
                raise ModelLimitError(f"The word was not reached in {current().seconds:g} seconds", limit=current().seconds,
                                      hint="Take an earlier time, or set limits(seconds=...).")
        return Word(self.states, found)

    def at_end(self, module: Module) -> Module | None:
        """A module at its terminal age; None where it lives for ever."""
        rules = self.states.rules.get(kind_of(module))
        if rules is None:
            return None
        try:
            terminal = rules[0].equalities[0][1]((*module.arguments, *self.states.constants))
        except (ArithmeticError, ValueError) as fault:
            raise self.states.fault(module, rules[0], fault) from None
        except TypeError:
            raise self._undecided(module, rules[0].production) from None
        return Module(module.symbol, (terminal, *module.arguments[1:]))

    def daughters(self, module: Module) -> list[Module]:
        """What a module at its terminal age becomes: its daughters at their first ages."""
        return [Module(*made) for made in self.states.made(self.states.rules[kind_of(module)][0], module)]

    def _division(self, module: Module, left: Value) -> tuple[Value, list[Module] | None]:
        """The time that is left after a module's division, and its daughters; None where it does not divide in that time."""
        at_end = self.at_end(module)
        if at_end is None:
            return left, None
        rest: Value = left - (at_end.arguments[0] - module.arguments[0])  # type: ignore[operator]
        try:
            return (left, None) if rest <= 0 else (rest, self.daughters(at_end))
        except TypeError:
            raise self._undecided(module, self.states.rules[kind_of(module)][0].production) from None

    def _undecided(self, module: Module, production: Production) -> ModelValueError:
        """The age at which a module divides hangs on a constant that is not known."""
        names = sorted({str(name) for value in self.states.constants for name in getattr(value, "free_symbols", ())})
        start, end = production.at or (None, None)
        return ModelValueError(f"At which age {module} becomes what {production} says cannot be decided",
                               self.states.system.source or None, start, end,
                               f"It depends on {', '.join(names)}: choose a value for {names[0]}.")


def timed(system: LSystem, **constants: object) -> Timed:
    """A system whose modules' one parameter is their age.

    Parameters
    ----------
    system
        A context-free system whose productions give the age at which a module is replaced: `a(1) -> b(0) a(0)`.
    **constants
        New values for declared constants.

    Raises
    ------
    ModelValueError
        The system is no timed one.
    """
    states = States(system, constants)
    check_settled(states, "The word at any time")
    for rules in states.rules.values():
        for rule in rules:
            if [index for index, _ in rule.equalities] != [0] or rule.condition is not None:
                start, end = rule.production.at or (None, None)
                raise ModelValueError(f"The production {rule.production} does not say at which age it applies",
                                      system.source or None, start, end, 'A timed production reads "a(1) -> b(0) a(0)".')
    return Timed(states)


def growth_base(t_div: float, t_s: float, t_l: float) -> float:
    """The base a of exponential growth that is continuous at a division: a^t_div = a^t_s + a^t_l (seed 002, section 8).

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
        raise ModelValueError(f"With daughters of age {t_s} and {t_l} no growth is continuous at the age {t_div}",
                              hint="A daughter begins younger than the age at which cells divide.")
    return positive_root([(t_div, 1), (t_s, -1), (t_l, -1)])


def positive_root(powers: Sequence[tuple[float, float]]) -> float:
    """The one z > 0 at which a sum of powers is 0, whose coefficients change their sign once.

    There is just one such z, by Descartes' rule of signs, which holds for all real exponents.

    Parameters
    ----------
    powers
        An exponent and a coefficient for each summand.

    Examples
    --------
    >>> round(positive_root([(2, 1), (1, -1), (0, -1)]), 9)
    1.618033989
    """
    exponents = [float(exponent) for exponent, _ in powers]

    def total(log: float) -> float:
        """The sum at z = e^log, as a share of its greatest power."""
        greatest = max(exponent * log for exponent in exponents)
        return math.fsum(c * math.exp(exponent * log - greatest) for exponent, (_, c) in zip(exponents, powers, strict=True))

    if (total(-FARTHEST) < 0) == (total(FARTHEST) < 0):
        raise ModelValueError("The solution is larger than a number can be, or smaller",
                              hint="Let a daughter begin clearly younger than the age at which cells divide.")
    return math.exp(bisected(total, -FARTHEST, FARTHEST))


def bisected(function: Callable[[float], float], low: float, high: float) -> float:
    """Where a function changes its sign, found by halving the stretch in which it does."""
    rises = function(low) < 0
    while low < (middle := (low + high) / 2) < high:
        low, high = (middle, high) if (function(middle) < 0) == rises else (low, middle)
    return high


def roots(equation: sympy.Expr, low: float | None = None, high: float | None = None) -> list[sympy.Expr]:
    """The real values of the one name in an expression with which it is 0; exact where they are written with square roots.

    Parameters
    ----------
    equation
        The expression. All values are found where it is a sum of powers of the name, or of e^name.
    low, high
        Between which numbers the values lie. An expression of another kind must have opposite signs there.

    Examples
    --------
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
    return equation.xreplace({part: z ** (exponent / name * sympy.log(base)) for part, (base, exponent) in powers
                              if base.is_number and (exponent / name).is_number})


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
        with suppress(ValueError):  # it compares what is no real number
            found = equation.evalf(subs={name: number})
            return float(found) if found.is_real else math.nan
        return math.nan

    if low is None or high is None or not value(low) * value(high) < 0:
        raise ModelValueError(f'No rule finds where "{number_text(equation)}" is 0',
                              hint=f"Say between which two numbers {name} lies; it must have opposite signs there.")
    return sympy.Float(bisected(value, low, high))
