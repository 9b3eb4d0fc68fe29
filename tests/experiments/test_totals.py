"""Totals: the formula at every step is what the derived word adds up to."""

from __future__ import annotations

import re
from contextlib import suppress
from fractions import Fraction
from random import Random

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit import book_systems, derive, limits, plot, read, system, systems, total
from lsys_kit.derivation.derive import Derivation
from lsys_kit.errors import LSystemError, ModelLimitError, ModelNameError, ModelValueError
from lsys_kit.experiments.totals import Total
from lsys_kit.notation.model.system import LSystem, symbols
from tests.derivation.test_affine import added, valued

SHOOT = "q = 1/2\naxiom: A(1)\nA(x) -> F(x) A(q*x)"
Q = sympy.Symbol("q", real=True)
MODULES = 20_000
"""Longer words are not derived here."""


def check(model: LSystem, symbol: str, place: int, axis: bool, values: dict[str, Fraction], steps: int = 8) -> bool:
    """Whether there is a formula; where there is, it says at each step what the derived word adds up to."""
    found = total(model, symbol, place, axis=axis, **{name: name for name in values})
    if found.sums is None:
        assert found.reason
        return False
    words = words_to(model, steps, values)
    for step in range(words.steps + 1):
        wanted = added(words[step], symbol, place - 1 if place else None, axis)
        assert valued(found.at(step), values) == wanted, (symbol, place, step)
    formula = found.formula if len(found.sums.rule) < 5 else None
    if formula is not None and formula.count_ops() < 400 and not formula.has(sympy.RootSum):
        says_the_same(formula, found, values, steps)
    return True


def words_to(model: LSystem, steps: int, values: dict[str, Fraction]) -> Derivation:
    """The words to a step, or as far as they are not too long."""
    found = derive(model, 0, **values)
    with suppress(ModelLimitError):
        for step in range(1, steps + 1):
            with limits(modules=MODULES):
                found = found.to(step)
    return found


def says_the_same(formula: sympy.Expr, found: Total, values: dict[str, Fraction], steps: int) -> None:
    """Where the letters have values, the formula is at each step what the recurrence says; nowhere does it divide by 0."""
    given = {each: sympy.Rational(*values[str(each)].as_integer_ratio()) for each in formula.free_symbols - {found.n}}
    there = formula.subs(given)
    for step in range(steps + 1):
        wanted = float(valued(found.at(step), values))
        assert complex(there.subs(found.n, step).evalf(30)) == pytest.approx(wanted, abs=1e-9), (values, step)


@st.composite
def affine_systems(draw: st.DrawFn) -> str:
    """A system whose values change by affine maps, with a letter q, brackets, and perhaps a delay that decides."""
    coefficients = st.sampled_from(["0", "1", "2", "-1", "1/2", "q", "q*q", "1 - q", "q/3"])

    def value() -> str:
        return " + ".join([draw(coefficients), *(f"({draw(coefficients)})*{name}" for name in "xy")])

    def successor() -> str:
        made = [f"{draw(st.sampled_from('ABF'))}({value()},{value()})" for _ in range(draw(st.integers(1, 3)))]
        return " ".join(f"[{each}]" if draw(st.booleans()) else each for each in made)

    rules = [f"{symbol}(x,y) -> {successor()}" for symbol in draw(st.lists(st.sampled_from("ABF"), min_size=1, unique=True))]
    if draw(st.booleans()):
        rules.append("D(t) : t < 2 -> D(t+1)\nD(t) -> A(1,t) D(0)")
    return "\n".join(["q = 2", f"axiom: A({draw(st.integers(-2, 2))},1) F(1,q) D(0)", *rules])


@pytest.mark.slow
@settings(max_examples=5 * settings.default.max_examples)
@given(affine_systems(), st.fractions(-2, 2, max_denominator=5), st.sampled_from("AF"), st.integers(0, 2), st.booleans())
def test_a_total_is_what_the_word_adds_up_to(text: str, q: Fraction, symbol: str, place: int, axis: bool) -> None:
    with limits(seconds=600):
        model = read(text)
        assert check(model, symbol, place, axis, {"q": q})
        assert check(model, symbol, place, axis, {}, 5)


@given(affine_systems(), st.fractions(-2, 2, max_denominator=5), st.sampled_from("AF"), st.integers(0, 2))
def test_a_limit_is_what_late_steps_come_to(text: str, q: Fraction, symbol: str, place: int) -> None:
    with limits(seconds=600):
        found, general = total(read(text), symbol, place, q=q), total(read(text), symbol, place, q="q")
        if (
            general.limit is not None
            and general.limit_condition.subs(Q, sympy.Rational(q.numerator, q.denominator)) == sympy.true
        ):
            assert general.limit.subs(Q, sympy.Rational(q.numerator, q.denominator)) == found.limit
        if found.limit is not None:
            late = [float(found.at(step)) for step in (200, 201, 400)]
            slow = abs(late[1] - late[0]) > 1e-12  # a root is near the unit circle
            assert abs(late[2] - float(found.limit)) <= (abs(late[0] - float(found.limit)) if slow else 1e-9)


CATALOGUE = [*systems(), *book_systems()]


@pytest.mark.slow
@pytest.mark.parametrize("id", CATALOGUE)
def test_of_the_catalogue_too(id: str) -> None:
    model = system(id)
    if any(rule.probability is not None for rule in model.productions):
        return
    chance = Random(id)
    values = {each.name: Fraction(chance.randint(1, 30), chance.randint(1, 12)) for each in model.constants if each.name != "n"}
    for symbol in symbols(model):
        for given_values in ({}, *({name: value} for name, value in values.items())):
            try:
                check(model, symbol, 1, False, given_values)
            except (ModelValueError, ModelLimitError) as error:
                told = "cannot be decided", "has no value", "not reached", "limit", "not found"
                if not any(said in str(error) for said in told):
                    raise
        found = total(model, symbol)
        if found.sums is not None and found.limit is not None:
            assert float(found.at(200)) == pytest.approx(float(found.limit), abs=1e-9)


@pytest.mark.slow
def test_a_geometric_sum() -> None:
    found = total(read(SHOOT), "F", q="q")
    n = found.n
    assert sympy.simplify(found.formula.args[0][0] - (1 - Q**n) / (1 - Q)) == 0
    assert found.formula.subs(Q, 1) == n, "where the ratio is 1, too"
    assert str(found.limit) == "1/(1 - q)"
    assert found.limit_condition == (sympy.Abs(Q) < 1)
    assert total(read(SHOOT), "F", q=1).formula == n, "also where the ratio is 1"
    assert total(read(SHOOT), "F", q=2).limit is None
    assert found.solve("q", 2) == [sympy.Rational(1, 2)], "for which q does the plant come to twice its first length?"
    assert found.at(200).subs(Q, sympy.Rational(1, 2)) == pytest.approx(2, abs=1e-9)


def test_the_sum_of_odd_numbers_is_a_square() -> None:
    found = total(read("axiom: A(1)\nA(x) -> F(x) A(x+2)"), "F")
    assert found.formula == found.n**2
    assert found.limit is None


def test_the_mean_where_chance_decides() -> None:
    """Each bud becomes two with probability p, or dies: (2p)^n are left in the mean."""
    found = total(read("p = 1/2\naxiom: A\nA -> A A : p\nA -> ε : 1 - p"), "A", p="p")
    p = sympy.Symbol("p", real=True)
    assert sympy.simplify(found.formula - (2 * p) ** found.n) == 0
    assert found.limit == 0
    assert found.limit_condition == (sympy.Abs(p) < sympy.Rational(1, 2))


def test_a_formula_that_holds_from_a_later_step_on_says_so() -> None:
    """What is added at the first steps alone is told apart, with these steps where they are few."""
    bud = read("q = 1/2\naxiom: A(1)\nA(x) -> F(x) [+A(q*x)]")
    found = total(bud, "F", axis=True, q="q")
    assert repr(found).startswith("1 where n ≥ 1, 0 where n = 0; 0, 1, 1, ")
    assert found.latex.endswith(r"1} & n \geq 1 \\ {\displaystyle 0} & n = 0 \end{cases}")
    stops = total(read("axiom: A(1)\nA(x) : x > 3/10 -> F(x) A(4*x/5)"), "F")
    assert repr(stops).startswith("11529/3125 where n ≥ 6; 0, 1, ")
    for total_of in (found, stops):
        assert [total_of.formula.subs(total_of.n, step) for step in range(9)] == total_of.values(8)


def test_solutions_without_roots_have_decimals() -> None:
    found = total(read(SHOOT), "F", q="q").solve("q", 2, n=6)
    assert repr(found) == "[about 0.50866]"
    assert found._repr_latex_() == r"$\displaystyle q \approx 0.50866$"
    assert sum(found[0] ** k for k in range(6)).evalf() == pytest.approx(2)
    assert total(read(SHOOT), "F", q="q").solve("q", 5)._repr_latex_() == r"$\displaystyle q = \frac{4}{5}$"
    assert total(read(SHOOT), "F", q="q").solve("q", -5)._repr_latex_() is None, "no stem is shorter than nothing"


@pytest.mark.slow
def test_points_of_steps_lie_on_the_curve_of_the_formula() -> None:
    """Between two steps, too, where it has real values there; a curve that holds from a later step on begins there."""
    line, dots = total(read(SHOOT), "F", q="q").plot(6, q=0.5).chart.curves
    assert dots.dots
    assert [*dots.points] == [point for point in line.points if point[0] == int(point[0])]
    assert all(y == pytest.approx(2 - 2 * 0.5**x) for x, y in line.points)
    late, _ = total(read("axiom: A(1)\nA(x) -> F(x) [+A(x)]"), "F", axis=True).plot(6).chart.curves
    assert {y for _, y in late.points} == {late.points[0][0]} == {1}
    (joined,) = total(read("axiom: A(1)\nA(x) -> A(-2*x)"), "A").plot(6).chart.curves
    assert [y for _, y in joined.points] == [1, -2, 4, -8, 16, -32, 64]
    assert len(total(system("P4"), "M").plot(6).chart.curves) == 1


def test_the_axis_alone() -> None:
    plant = read("q = 1/2\naxiom: A(1)\nA(x) -> F(x) [+A(q*x)] A(q*x)")
    assert total(plant, "F", axis=True, q="q").formula == total(read(SHOOT), "F", q="q").formula


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("axiom: A(2)\nA(x) -> A(x*x)", "multiplied by one another"),
        ("axiom: A(2)\nA(x) -> A(1/(x+1))", "multiplied by one another, or are put into a function"),
        ("axiom: A(2) B\nA(x) > B -> A(x)", "neighbours"),
        ("axiom: A(2)\nA(x) -> A(uniform(0,1))", "random"),
        ("axiom: A(2)\nA(x) -> A(x*sqrt(2))", "not known exactly"),
    ],
)
def test_where_there_is_no_formula_the_numbers_are_there(text: str, why: str) -> None:
    found = total(read(text), "A")
    assert found.formula is None
    assert why in found.reason
    words = derive(read(text), 4)
    assert found.values(4) == [added(words[n], "A", 0, False) for n in range(5)]
    with pytest.raises(ModelValueError, match=re.escape(found.reason)):
        found.derivative("q")


def test_what_cannot_be_asked_is_told() -> None:
    model = read(SHOOT)
    for call, said in [
        (lambda: total(model, "G"), 'no symbol "G"'),
        (lambda: total(model, "F", 2), "parameter number 2"),
        (lambda: total(model, "F", r=1), 'no constant "r"'),
        (lambda: total(model, "F").solve("q", 2), 'no letter "q"'),
        (lambda: total(model, "F", -1), "whole number"),
        (lambda: total(read("n = 2\naxiom: F(n)"), "F", n="n"), "is the step"),
        (lambda: total(read("d = 3\naxiom: A(0)\nA(t) : t < d -> A(t+1)"), "A", d="d"), "choose a value for d"),
        (lambda: total(model, "F", q="q").at(10**9), "at most"),
    ]:
        with pytest.raises(LSystemError) as error:
            call()
        assert said in str(error.value)
    assert issubclass(ModelNameError, LSystemError)


def test_it_is_shown_as_mathematics_a_table_and_a_plot() -> None:
    found = total(read(SHOOT), "F", q="q")
    rows = r"{\displaystyle \frac{q^{n} - 1}{q - 1}} & q \neq 1 \\ {\displaystyle n} & q = 1"
    assert found._repr_latex_() == rf"$\displaystyle \begin{{cases}} {rows} \end{{cases}}$"
    assert found.table(3).rows == ((0, 0), (1, 1), (2, "q + 1"), (3, "q² + q + 1"))
    assert "largest 1.98438" in repr(found.plot(7))
    assert "largest 5.21703" in repr(found.plot(7, q=0.9))
    assert repr(plot(read(SHOOT), 3))


TWO = "p = 1\nq = 1/2\naxiom: A(1,1)\nA(x,y) -> F(x) A(q*x+y,p*y)"
LATE = "q = 1/2\naxiom: B\nB -> F(1)\nF(x) -> F(q*x)"
TURNS = "q = 1/2\naxiom: F(1) A(2)\nF(x) -> A(x)\nA(x) -> F(x) A(q*x)"
BY = "q = 1/2\naxiom: A(1)\nA(x) -> F(x) A(x/q)"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "values"),
    [
        (SHOOT, [{"q": 1}, {"q": 0}, {"q": -1}]),
        (TWO, [{"p": 1, "q": 3}, {"p": 3, "q": 1}, {"p": 2, "q": 2}, {"p": 1, "q": 1}, {"p": 0, "q": 0}, {"p": 0, "q": 1}]),
        (LATE, [{"q": 0}, {"q": 2}]),
        (TURNS, [{"q": 0}, {"q": 1}, {"q": -2}, {"q": Fraction(-1, 4)}]),
        (BY, [{"q": 1}, {"q": 3}]),
    ],
)
def test_where_a_formula_would_divide_by_0_it_has_another_case(text: str, values: list[dict[str, Fraction]]) -> None:
    """It says what is added up there, and so does its derivative: that of the polynomial at the step."""
    letters = [*values[0]]
    found = total(read(text), "F", **{name: name for name in letters})
    derivatives = {name: found.derivative(name) for name in letters}
    for given_values in values:
        says_the_same(found.formula, found, given_values, 6)
        for name, derivative in derivatives.items():
            there = {each: sympy.sympify(given_values[str(each)]) for each in derivative.free_symbols - {found.n}}
            for step in range(6):
                wanted = sympy.sympify(found.at(step)).diff(found._letter(name)).subs(there)
                assert abs((derivative.subs(there).subs(found.n, step) - wanted).evalf(30)) < 1e-15, (given_values, name, step)


def test_it_is_said_for_which_letters_a_formula_says_nothing() -> None:
    """The roots of x^2 = (q^2 - 3) x - 1 are one where q^2 is 1 or 5; x/q has no value where q is 0; of many cases none is
    shown."""
    found = total(read("q = 1\naxiom: F(1) A(2)\nF(x) -> A(x)\nA(x) -> F(-x) A((q*q - 3)*x)"), "F", q="q")
    assert "where q ≠ 1, q ≠ −1, q² − 5 ≠ 0, (-1)^n*(n + 1) where q = 1" in repr(found)
    assert found.formula.subs(Q, sympy.sqrt(5)) is sympy.nan
    several = total(read(TWO), "F", q="q", p="p")
    assert several.latex.endswith(r"\quad (q \neq 1,\ p \neq 1,\ q \neq p)")
    assert several.formula.subs({Q: 1, sympy.Symbol("p", real=True): 1}) == (several.n * (several.n + 1) / 2).expand()
    assert "where q ≠ 1, q ≠ 0, n where q = 1" in repr(total(read(BY), "F", q="q"))
    assert "where q ≠ 1, p ≠ 1, q ≠ p;" in repr(total(read(TWO), "F", q="q", p="p"))


def test_a_sum_over_roots_says_of_which_polynomial() -> None:
    found = total(system("P4"), "M")
    assert repr(found).startswith("sum(x^n*(575*x^4/2869")
    assert r"\sum_{x^{5} - x - 1 = 0} x^{n}" in found.latex


def test_roots_that_no_formula_says_are_not_kept_back() -> None:
    found = total(read("p = 1\nq = 1/2\naxiom: A(p)\nA(x) -> F(x) A(q*x + x*x*0)"), "F", p="p", q="q")
    assert found.solve("p", 3, n=2) == [3 / (Q + 1)]
    with pytest.raises(ModelValueError, match="no formula says"):
        found.solve("q", 3, n=7)


@pytest.mark.slow
def test_a_curve_over_a_letter_has_the_totals_of_its_values() -> None:
    model = read("q = 0.8 in 0 .. 1.2 by 0.1\nr = 2\naxiom: A(1)\nA(x) -> F(r*x) A(q*x)")
    found = total(model, "F", q="q", r="r")
    for plot_of, wanted in [
        (found.plot(10, over="q"), lambda q: 2 * sum(q**k for k in range(10))),
        (found.plot(3, over="q", between=("1/2", 1), r=3), lambda q: 3 * (1 + q + q * q)),
        (found.plot(2, over="r", q=1), lambda r: 2 * r),
    ]:
        (curve,) = plot_of.chart.curves
        assert all(y == pytest.approx(float(wanted(x))) for x, y in curve.points)
    assert "q from 0 to 1.2" in repr(found.plot(10, over="q"))
    assert "r from 0 to 4" in repr(found.plot(10, over="r"))
    for call, said in [
        (lambda: found.plot(3, over="p"), 'no letter "p"'),
        (lambda: found.plot(3, over="q", between=(1, 0)), "the smaller one first"),
        (lambda: found.plot(3, over="q", between=(1,)), "two numbers"),
        (lambda: total(model, "F").plot(3, over="q"), 'no letter "q"'),
    ]:
        with pytest.raises(LSystemError, match=said):
            call()


@pytest.mark.slow
def test_a_formula_that_explodes_ends_within_the_limit() -> None:
    rules = "\n".join(f"A{i}(x) -> A{(i + 1) % 40}(x*q{i % 6} + 1) A{(i * 7) % 40}(x + q{i % 5})" for i in range(40))
    model = read("\n".join([*(f"q{i} = {i + 1}" for i in range(6)), "axiom: A0(1)", rules]))
    with limits(seconds=2), pytest.raises(ModelLimitError):
        total(model, "A1", **{f"q{i}": f"q{i}" for i in range(6)})


def test_fractions_that_add_up_to_a_whole_number_are_shown_as_one() -> None:
    spread = read("axiom: C(2) C(0)\nC(x) < C(c) -> C(c + (x-c)/4)\nC(c) > C(y) -> C(c + (y-c)/4)")
    assert repr(total(spread, "C")).startswith("2, 2, 2, 2, 2, 2")
