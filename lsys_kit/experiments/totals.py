"""Totals: what the values of all modules of a symbol add up to, as a formula in the step and in letters."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING, Any

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.core.rules import constants_of, number_from
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.growth.affine import AffineSums, Case, NotAffine, affine_sums
from lsys_kit.derivation.growth.recurrences import generating_function, polynomial, unknown
from lsys_kit.errors import ModelNameError, ModelValueError, require, whole_number
from lsys_kit.experiments.table import Table, column_label
from lsys_kit.notation.model.arithmetic import Value, expression_of, is_symbolic, normalised, number_text
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.formulas import formula_latex, formula_line, formula_text
from lsys_kit.notation.model.modules import CLOSING, OPENING
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.plots.chart import Axis, Curve, CurveChart, Plot, finite, name_label
from lsys_kit.pictures.style.palette import colour_of
from lsys_kit.supervision import supervised
from lsys_kit.worlds.derive import derive

if TYPE_CHECKING:
    import sympy

FIRST, POINTS, FINE, MOST_STEPS, MOST_SHOWN = 6, 60, 8, 10_000, 3
"""How many totals are shown in a line; how many points a curve over a letter has, and how many a formula from step to
step; the latest step; how many cases of a formula are shown."""


@dataclass(frozen=True)
class Total:
    """What a parameter adds up to over all modules of a symbol, at every step.

    Attributes
    ----------
    system, symbol, parameter, axis, constants
        What was asked for; see `total`.
    sums
        The linear recurrence of the totals, or None where there is none.
    reason
        Why there is none, or None.
    """

    system: LSystem
    symbol: str
    parameter: int
    axis: bool
    constants: dict[str, Any] = field(hash=False)
    sums: AffineSums | None = field(compare=False)
    reason: str | None = field(default=None, compare=False)

    def at(self, n: int) -> Value:
        """The total at step n, exactly: a number, or an expression in the letters.

        >>> from lsys_kit import read
        >>> total(read("q = 1/2\\naxiom: A(1)\\nA(x) -> F(x) A(q*x)"), "F", q="q").at(3)
        q**2 + q + 1
        """
        step = whole_number(n, "The step")
        if step > MOST_STEPS:
            raise ModelValueError(f"The step must be at most {MOST_STEPS:,}")
        with Task(f"The total of step {step:,} was not found"):
            return self._derived(step)[-1] if self.sums is None else self.sums.at(step)

    def values(self, steps: int) -> list[Value]:
        """The totals at steps 0 to `steps`."""
        last = whole_number(steps, "The step")
        with Task("The totals were not found"):
            return self._derived(last) if self.sums is None else [*counted(islice(self.sums, last + 1), 1)]

    def _derived(self, steps: int) -> list[Value]:
        """The totals of derived words."""
        found = derive(self.system, steps, **self.constants)
        return [normalised(sum(self._of_word(found.to(step)[step]), 0)) for step in counted(range(steps + 1), 1)]

    def _of_word(self, word: Word) -> Iterator[Value]:
        depth = 0
        for module in counted(word, 1):
            depth += (module.symbol in OPENING) - (module.symbol in CLOSING)
            if module.symbol == self.symbol and not (self.axis and depth):
                here = len(module.arguments) >= self.parameter > 0
                yield module.arguments[self.parameter - 1] if here else 1

    @property
    def letters(self) -> tuple[str, ...]:
        """The letters in the formula."""
        return tuple(map(str, self.sums.letters)) if self.sums else ()

    @cached_property
    def _rule(self) -> tuple[list[sympy.Expr], list[sympy.Expr]]:
        """The coefficients of the recurrence and the first totals, as sympy has them."""
        if self.sums is None:
            raise ModelValueError(f"{self.reason}", hint="`values(n)` has the numbers themselves.")
        return [expression_of(self.sums.shown(c)) for c in self.sums.rule], [
            expression_of(self.sums.shown(term)) for term in self.sums.first
        ]

    @cached_property
    def formula(self) -> sympy.Expr | None:
        """The total at step n, as a formula in n and the letters; None where there is none in powers and roots.

        Where it would divide by 0 for some letters, it has several cases.

        >>> from lsys_kit import read
        >>> found = total(read("q = 1/2\\naxiom: A(1)\\nA(x) -> F(x) A(q*x)"), "F", q="q")
        >>> found.formula
        Piecewise(((q**n - 1)/(q - 1), Ne(q, 1)), (n, True))
        >>> total(found.system, "F", q=2).formula
        2**n - 1
        """
        return _in_cases(self._cases)

    @cached_property
    def _cases(self) -> list[Case]:
        if self.sums is None:
            return []
        with Task("The formula was not found"), supervised():
            return self.sums.formulas(self.n)

    @property
    def n(self) -> sympy.Symbol:
        """The step in the formula."""
        import sympy

        return sympy.Symbol("n", integer=True, nonnegative=True)

    @property
    def generating_function(self) -> sympy.Expr:
        """The function whose power series in x has the totals as coefficients."""
        with Task("The generating function was not found"), supervised():
            return generating_function(*self._rule)

    @cached_property
    def _limit(self) -> tuple[sympy.Expr | None, sympy.Basic | None]:
        """What the totals come to in the long run, and the condition under which they do."""
        import sympy

        with Task("The limit was not found"), supervised():
            whole = polynomial(self._rule[0])
            condition: sympy.Basic = sympy.true
            for factor, times in whole.factor_list()[1]:
                if factor.degree() == 1 and factor(1) == 0:
                    if times > 1:
                        return None, sympy.false
                    continue
                if factor.degree() <= 2:
                    inside = [_below_one(root) for root in sympy.roots(factor)]
                elif factor.free_symbols_in_domain:
                    return None, None
                else:
                    inside = [sympy.true if all(abs(root) < 1 for root in factor.nroots()) else sympy.false]
                condition = sympy.And(condition, *inside)
            if condition == sympy.false:
                return None, condition
            x = unknown("x", *self._rule)
            found = sympy.factor(sympy.cancel(generating_function(*self._rule) * (1 - x)).subs(x, 1))
            return _without_minus(found), condition

    @property
    def limit(self) -> sympy.Expr | None:
        """What the totals come to for ever larger n, if the condition of `limit_condition` holds; None where they do not.

        >>> from lsys_kit import read
        >>> found = total(read("q = 1/2\\naxiom: A(1)\\nA(x) -> F(x) A(q*x)"), "F", q="q")
        >>> found.limit, found.limit_condition
        (1/(1 - q), Abs(q) < 1)
        """
        return self._limit[0]

    @property
    def limit_condition(self) -> Any:
        """The condition for a limit: sympy's true or false, or a comparison; None where it is not known."""
        return self._limit[1]

    def derivative(self, letter: str) -> sympy.Expr:
        """How the formula changes with a letter.

        >>> from lsys_kit import read
        >>> total(read("s = 2\\naxiom: A\\nA -> F(s) A"), "F", s="s").derivative("s")
        n
        """
        if self.sums is None:
            raise ModelValueError(f"{self.reason}")
        by = self._letter(letter)
        with Task("The derivative was not found"), supervised():
            found = _in_cases(self.sums.derivative(by).formulas(self.n))
        if found is None:
            raise ModelValueError("The totals have no formula in powers and roots")
        return found

    def solve(self, letter: str, value: object, n: int | None = None) -> Solutions:
        """The values of a letter for which the total is as given, at step n or in the long run.

        >>> from lsys_kit import read
        >>> found = total(read("q = 1/2\\naxiom: A(1)\\nA(x) -> F(x) A(q*x)"), "F", q="q")
        >>> found.solve("q", 3), found.solve("q", 3, n=2)
        ([2/3], [2])
        """
        unknown, wanted = self._letter(letter), expression_of(number_from(value))
        found = self.limit if n is None else self.at(n)
        if found is None:
            raise ModelValueError("The totals have no limit that is known", hint="Name a step: n=10.")
        import sympy

        with Task("The equation was not solved"), supervised():
            equation, _ = sympy.fraction(sympy.together(found - wanted))
            if not equation.has(unknown):
                raise ModelValueError(f"The total does not depend on {letter}")
            if equation.free_symbols == {unknown}:
                roots = sympy.Poly(equation, unknown).real_roots(multiple=False)
                roots = [root for root, _ in roots]
            else:
                whole = sympy.Poly(equation, unknown)
                known = sympy.roots(whole)
                if sum(known.values()) < whole.degree():
                    raise ModelValueError("The equation has roots that no formula says", hint="Give the other letters numbers.")
                roots = [root for root in known if root.is_real is not False]
            condition = self.limit_condition if n is None else sympy.true
            return Solutions(letter, [root for root in roots if condition.subs(unknown, root) != sympy.false])

    def _letter(self, letter: str) -> sympy.Symbol:
        require(letter, str, "A letter")
        for each in self.sums.letters if self.sums else ():
            if str(each) == letter:
                return each
        said = (
            f"Its letters are: {', '.join(self.letters)}."
            if self.letters
            else f'Ask for it: total(system, "{self.symbol}", {letter}="{letter}").'
        )
        raise ModelNameError(f'There is no letter "{letter}" in the formula', hint=said)

    def table(self, steps: int = 8) -> Table:
        """The totals at steps 0 to `steps`, as a table.

        >>> from lsys_kit import read
        >>> total(read("axiom: A(1)\\nA(x) -> F(x) A(x+2)"), "F").table(3).rows
        ((0, 0), (1, 1), (2, 4), (3, 9))
        """
        return Table(("step", self._name), tuple(enumerate(map(_cell, self.values(steps)))), 1)

    @property
    def _name(self) -> str:
        return f"total of {self.symbol}"

    def plot(self, steps: int = 10, over: str | None = None, between: Sequence[object] = (), **letters: object) -> Plot:
        """The totals at steps 0 to `steps` as points on the curve of the formula; or, over a letter, the total at step `steps`.

        Where the formula says nothing between two steps, as for powers of negative numbers, the points are joined by lines.

        Other letters take the values that are given, or else those of the model. The curve goes over the values between two
        numbers, by default those of the letter's slider, or else from 0 to twice the value of the model.

        >>> from lsys_kit import read
        >>> total(read("q = 1/2\\naxiom: A(1)\\nA(x) -> F(x) A(q*x)"), "F", q="q").plot(8, q=0.8)
        1 curve of total of F, step n from 0 to 8, largest 4.16114
        >>> total(read("q = 1/2\\naxiom: A(1)\\nA(x) -> F(x) A(q*x)"), "F", q="q").plot(8, over="q")
        1 curve of total of F at step 8, q from 0 to 1, largest 8
        """
        last = whole_number(steps, "The step")
        with Task("The plot was not made"):
            if over is not None:
                return self._plot_over(str(self._letter(over)), last, between, letters)
            found = total(self.system, self.symbol, self.parameter, axis=self.axis, **self._numbers(letters))
            points = tuple((float(n), float(value)) for n, value in enumerate(found.values(last)))
            colour = colour_of(self.symbol, self.system)
            formula = found._between_steps(last)
            curves = (Curve(formula, colour), Curve(points, colour, dots=True)) if formula else (Curve(points, colour),)
            return Plot(CurveChart(curves, Axis(column_label("step"), True), Axis(self._name)))

    def _between_steps(self, last: int) -> tuple[tuple[float, float], ...]:
        """Points of the curve of a formula without letters; none where it has no real values between two steps."""
        import sympy

        if self.formula is None or self.formula.has(sympy.RootSum) or not 0 < last <= POINTS:
            return ()
        formula, first = _later(self.formula)
        found = []
        with supervised():
            for place in range(first * FINE, last * FINE + 1):
                value = formula.subs(self.n, sympy.Rational(place, FINE)).evalf()
                if not (value.is_real and value.is_finite):
                    return ()
                found.append((place / FINE, value))
        return tuple(zip([x for x, _ in found], finite([y for _, y in found], f"The {self._name}"), strict=True))

    def _plot_over(self, letter: str, step: int, between: Sequence[object], letters: dict[str, object]) -> Plot:
        """The total at a step for many values of a letter."""
        import sympy

        ends: list[Value] = [number_from(end, letter) for end in between] if between else [*self._range(letter)]
        if len(ends) != 2 or any(map(is_symbolic, ends)) or not ends[0] < ends[1]:
            raise ModelValueError(f"The values of {letter} must lie between two numbers, the smaller one first")
        values = constants_of(self.system, self._numbers(letters))
        given = {each.name: expression_of(value) for each, value in zip(self.system.constants, values, strict=True)}
        unknown, found = self._letter(letter), []
        with supervised():
            formula = expression_of(self.at(step))
            formula = formula.subs({each: given[str(each)] for each in formula.free_symbols - {unknown}})
            above, below = (sympy.Poly(part, unknown) for part in sympy.fraction(sympy.together(formula)))
            for k in range(POINTS + 1):
                place = Fraction(ends[0] + (ends[1] - ends[0]) * Fraction(k, POINTS))
                divisor = below(expression_of(place))
                if divisor != 0:
                    found.append((float(place), above(expression_of(place)) / divisor))
        points = tuple(zip([x for x, _ in found], finite([y for _, y in found], f"The {self._name}"), strict=True))
        colour = colour_of(self.symbol, self.system)
        return Plot(CurveChart((Curve(points, colour),), Axis(name_label(letter)), Axis(f"{self._name} at step {step}")))

    def _range(self, letter: str) -> tuple[Value, Value]:
        """The range of a constant's slider; where it has none, from 0 to twice its value."""
        values = constants_of(self.system, {})
        value = values[[each.name for each in self.system.constants].index(letter)]
        return slider_range(self.system, letter) or ((0, 2 * max(value, -value)) if value else (0, 1))

    def _numbers(self, letters: dict[str, object]) -> dict[str, object]:
        """The constants of the system, with numbers for the letters."""
        chosen = {name: value for name, value in self.constants.items() if name not in self.letters} | letters
        if any(map(is_symbolic, constants_of(self.system, chosen))):
            raise ModelValueError("Points can only be drawn where each letter has a value")
        return chosen

    @property
    def latex(self) -> str:
        """The formula in LaTeX, with its cases."""
        if not self._cases:
            return ""
        rows = [(formula_latex(formula), ",\\ ".join(map(formula_latex, where))) for formula, where in self._shown]
        if len(rows) > 1:
            lines = r" \\ ".join(rf"{{\displaystyle {formula}}} & {where}" for formula, where in rows)
            return rf"\begin{{cases}} {lines} \end{{cases}}"
        ((formula, where),) = rows
        return rf"{formula} \quad ({where})" if where else formula

    @property
    def _shown(self) -> list[tuple[sympy.Expr, list[sympy.Basic]]]:
        """The cases of the formula if they are few, else that which holds for most letters, and where each holds: of what is
        added at the first steps alone these steps, if they are few."""
        import sympy

        found, latest = [], 0
        for case in self._cases if len(self._cases) <= MOST_SHOWN else self._cases[:1]:
            formula, first = _later(case.formula)
            latest = max(latest, first)
            found.append((formula, [*([sympy.Ge(self.n, first)] if first else []), *_conditions(case)]))
        if len(found) + latest <= MOST_SHOWN:
            found += [(expression_of(self.at(step)), [sympy.Eq(self.n, step)]) for step in range(latest)]
        return found

    def _repr_latex_(self) -> str | None:
        return f"$\\displaystyle {self.latex}$" if self._cases else None

    def __repr__(self) -> str:
        steps = ", ".join(number_text(value) for value in self.values(FIRST - 1))
        if not self._cases:
            why = f"; {self.reason}" if self.reason else ""
            return f"{steps}, ...{why}"
        said = (
            " where ".join(filter(None, [formula_line(formula), ", ".join(map(formula_text, where))]))
            for formula, where in self._shown
        )
        return f"{', '.join(said)}; {steps}, ..."


class Solutions(list["sympy.Expr"]):
    """The values of a letter that solve an equation; of those that no root sign says the decimals are shown.

    >>> from lsys_kit import read
    >>> total(read("q = 1/2\\naxiom: A(1)\\nA(x) -> F(x) A(q*x)"), "F", q="q").solve("q", 2, n=6)
    [about 0.50866]
    """

    def __init__(self, letter: str, roots: Iterable[sympy.Expr]) -> None:
        import sympy

        super().__init__(roots)
        self.letter = letter
        self._decimals = {root: f"{float(root):.6g}" for root in self if root.has(sympy.CRootOf)}

    def __repr__(self) -> str:
        said = (f"about {self._decimals[root]}" if root in self._decimals else number_text(root) for root in self)
        return f"[{', '.join(said)}]"

    def _repr_latex_(self) -> str | None:
        letter, near = formula_latex(unknown(self.letter)), self._decimals
        said = [rf"{letter} \approx {near[each]}" if each in near else f"{letter} = {formula_latex(each)}" for each in self]
        return f"$\\displaystyle {', '.join(said)}$" if said else None


def _below_one(root: sympy.Expr) -> sympy.Basic:
    """That a root without its sign is less than 1, with the number that multiplies its letters on the other side."""
    import sympy

    number, letters = root.as_coeff_Mul()
    return sympy.Abs(letters) < 1 / abs(number) if number else sympy.true


def _without_minus(quotient: sympy.Expr) -> sympy.Expr:
    """A quotient that does not begin with a minus where its denominator can take it.

    >>> from sympy.abc import q
    >>> _without_minus(-q / (2 * q - 1))
    q/(1 - 2*q)
    """
    above, below = quotient.as_numer_denom()
    return -above / -below if above.could_extract_minus_sign() and below.is_Add else quotient


def _conditions(case: Case) -> list[sympy.Basic]:
    """What must hold of the letters."""
    import sympy

    return [*(sympy.Eq(letter, value) for letter, value in case.given.items()), *case.unless]


def _later(formula: sympy.Expr) -> tuple[sympy.Expr, int]:
    """A formula without what is added at the first steps alone, and the step from which on it holds."""
    import sympy

    alone = formula.atoms(sympy.KroneckerDelta)
    first = max((int(place) + 1 for each in alone for place in each.args if place.is_Integer), default=0)
    return formula.xreplace(dict.fromkeys(alone, sympy.Integer(0))), first


def _in_cases(cases: Sequence[Case]) -> sympy.Expr | None:
    """Formulas as one of sympy's."""
    import sympy

    if len(cases) == 1 and not cases[0].unless:
        return cases[0].formula
    return sympy.Piecewise(*((case.formula, sympy.And(*_conditions(case))) for case in cases)) if cases else None


def slider_range(system: LSystem, name: str) -> tuple[Value, Value] | None:
    """The numbers between which the slider of a constant moves it; None where it has no slider.

    >>> from lsys_kit import read
    >>> slider_range(read("q = 1/2 in 0 .. 2\\naxiom: A"), "q")
    (0, 2)
    """
    constant = next(each for each in system.constants if each.name == name)
    ends = [end.value for end in constant.range or () if isinstance(end, Number)]
    return (ends[0], ends[1]) if len(ends) == 3 else None


def _cell(value: Value) -> Value | str:
    return formula_text(value) if is_symbolic(value) else value


def total(system: LSystem, symbol: str, parameter: int = 1, *, axis: bool = False, **constants: object) -> Total:
    """What the values of all modules of a symbol add up to, at every step: a formula in n and in letters.

    The whole length of a plant is the total of `F`, where `F(x)` draws a line of length x; its height, where the main axis
    stands upright, that of the axis. Where chance chooses among productions, it is the mean.

    Parameters
    ----------
    system
        Any L-system.
    symbol
        Whose values are added up; a module without that parameter counts as 1.
    parameter
        Which parameter, from 1; 0 counts the modules.
    axis
        Whether only modules outside brackets are taken: those of the main axis.
    **constants
        New values of declared constants; a letter, as in `q="q"`, stays in the formula.

    Returns
    -------
    Total
        It is displayed as mathematics, with another case for letters where the formula would divide by 0, and has `.formula`,
        `.at(n)`, `.values(n)`, `.limit`, `.derivative("q")`, `.solve("q", 3)`, `.table(n)`, `.plot(n)` and `.latex`. Where no
        formula exists, its `reason` says why, and the exact numbers are there all the same.

    Raises
    ------
    ModelNameError
        There is no such symbol, parameter or constant.

    Examples
    --------
    >>> from lsys_kit import read
    >>> total(read("q = 1/2\\naxiom: A(1)\\nA(x) -> F(x) A(q*x)"), "F", q="q")
    (q^n - 1)/(q - 1) where q ≠ 1, n where q = 1; 0, 1, q + 1, q^2 + q + 1, q^3 + q^2 + q + 1, q^4 + q^3 + q^2 + q + 1, ...
    >>> total(read("axiom: A(2)\\nA(x) -> A(x*x)"), "A").reason
    'There is no formula: values of A are multiplied by one another, or are put into a function.'
    """
    require(system, LSystem, "An L-system")
    require(symbol, str, "A symbol")
    require(axis, bool, 'True or False for "axis"')
    number = whole_number(parameter, "The number of the parameter")
    if "n" in constants and constants["n"] == "n":
        raise ModelNameError('The letter "n" is the step', hint="Give the constant another name in the model.")
    with Task("The total was not found"):
        constants_of(system, constants)
        try:
            sums = affine_sums(system, symbol, number - 1 if number else None, axis, constants)
        except NotAffine as reason:
            return Total(system, symbol, number, axis, constants, None, str(reason))
    return Total(system, symbol, number, axis, constants, sums)
