"""Timed systems: the word at any time."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelLimitError, ModelValueError, derive, limits, lineage, read, stages, system
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.timed.ages import age_model
from lsys_kit.derivation.timed.continuity import growth_base, positive_root, roots
from lsys_kit.derivation.timed.timed import timed
from lsys_kit.notation.model.modules import Module

ANABAENA = timed(read("axiom: ar(0)\nar(1) -> al(0) br(0)\nal(1) -> bl(0) ar(0)\nbr(1) -> ar(0)\nbl(1) -> al(0)"))
TIMES = st.fractions(0, 4, max_denominator=12)


@pytest.mark.parametrize(
    ("at", "word"),
    [
        ("1/2", "ar(0.5)"),
        (1, "ar(1)"),
        (1.5, "al(0.5)br(0.5)"),
        (2.5, "bl(0.5)ar(0.5)ar(0.5)"),
        (3.5, "al(0.5)al(0.5)br(0.5)al(0.5)br(0.5)"),
    ],
)
def test_the_words_of_seed_003(at: object, word: str) -> None:
    assert str(ANABAENA.word(at)) == word


def test_at_its_terminal_age_a_cell_is_not_yet_divided() -> None:
    assert len(ANABAENA.word(6)) == 13
    assert {module.arguments for module in ANABAENA.word(6)} == {(1,)}


@given(TIMES, TIMES)
def test_time_passes_in_parts_as_in_one(first: Fraction, second: Fraction) -> None:
    """D(D(x, s), t) = D(x, s + t)."""
    assert ANABAENA.later(list(ANABAENA.word(first)), second) == ANABAENA.word(first + second)


def test_between_divisions_it_is_the_system_of_whole_steps() -> None:
    for step, word in enumerate(derive(system("J1"), 7)):
        assert [module.symbol for module in ANABAENA.word(step + 0.5)] == [module.symbol for module in word]


def test_life_spans_may_differ_and_be_constants() -> None:
    growing = timed(read("short = 1/2\naxiom: a(0)\na(2) -> a(0) b(short/2)\nb(short) -> a(0)"), short=1)
    assert str(growing.word(3)) == "a(1)a(0.5)"


@pytest.mark.parametrize("text", ["A(t) -> B", "A -> B", "A(1) : 1 < 2 -> B(0)", "B < A(1) -> A(0)", "A(1) -> A(0) : 1/2"])
def test_a_production_gives_an_age(text: str) -> None:
    with pytest.raises(ModelValueError):
        timed(read(f"axiom: A(0) B\n{text}"))


@pytest.mark.slow
def test_no_time_before_the_axiom_and_no_division_without_end() -> None:
    with pytest.raises(ModelValueError, match="before the axiom"):
        ANABAENA.word(-1)
    with pytest.raises(LSystemError, match=r"divides endlessly|more than"):
        timed(read("axiom: A(0)\nA(1) -> A(1) A(1)")).word(2)
    with limits(modules=100), pytest.raises(ModelLimitError, match="more than 100 modules"):
        ANABAENA.word(20)


def test_a_terminal_age_that_is_no_number_is_explained() -> None:
    with pytest.raises(ModelValueError, match=r"division by zero \(line 2, column 1\)"):
        timed(read("axiom: A(0)\nA(1/0) -> A(0)")).word(1)
    for age in ("c", "sqrt(c)"):
        with pytest.raises(ModelValueError, match="cannot be decided") as caught:
            timed(read(f"c = 1\naxiom: A(0)\nA({age}) -> A(0)"), c="c").word(2)
        assert caught.value.hint == "It depends on c: choose a value for c."
    with pytest.raises(ModelValueError, match='"time" must be a number'):
        ANABAENA.word(sympy.Symbol("x"))


def test_a_constant_that_no_age_depends_on_may_be_unknown() -> None:
    assert str(timed(read("a = 2\naxiom: A(0)\nA(1) -> A(0) B(a)"), a="a").word("3/2")) == "A(0.5)B(a + 1/2)"


def test_growth_that_is_continuous_at_a_division() -> None:
    assert growth_base(1, 0, 0.2) == pytest.approx(2.167303978, abs=1e-9)
    assert growth_base(1, 0, 0) == pytest.approx(2)
    for t_div, t_s, t_l in ((2, 0, 1), (0.5, 0.1, 0.4), (3, 1, 0)):
        base = growth_base(t_div, t_s, t_l)
        assert base**t_div == pytest.approx(base**t_s + base**t_l)
    with pytest.raises(ModelValueError, match="no growth is continuous"):
        growth_base(1, 0, 1)


@given(st.floats(-10, 10), st.floats(-10, 10), st.floats(0.02, 10))
def test_a_mother_is_as_long_as_her_daughters(t_s: float, t_l: float, older: float) -> None:
    t_div = max(t_s, t_l) + older
    base = growth_base(t_div, t_s, t_l)
    assert base > 1
    assert base ** (t_s - t_div) + base ** (t_l - t_div) == pytest.approx(1, abs=1e-9)


@pytest.mark.parametrize(
    "ages", [(math.inf, 0, 0), (math.nan, 0, 0), (1, 0, math.nan), (5e-324, 0, 0), (1, -math.inf, 0), (1, 1, 0)]
)
def test_there_is_no_base_for_ages_that_make_no_sense(ages: tuple[float, float, float]) -> None:
    with pytest.raises(ModelValueError):
        growth_base(*ages)


@given(
    st.floats(-3, 3), st.lists(st.floats(0.1, 3), min_size=1, max_size=4), st.lists(st.floats(0.1, 9), min_size=5, max_size=5)
)
def test_coefficients_that_change_their_sign_once_have_one_root(least: float, gaps: list[float], sizes: list[float]) -> None:
    exponents = [least + sum(gaps[:index]) for index in range(len(gaps) + 1)]
    for changed in range(1, len(exponents)):
        powers = [
            (exponent, -size if index < changed else size)
            for index, (exponent, size) in enumerate(zip(exponents, sizes, strict=False))
        ]
        root = positive_root(powers)
        terms = [c * root**exponent for exponent, c in powers]
        assert abs(sum(terms)) <= 1e-9 * max(map(abs, terms))


X = sympy.Symbol("x", real=True)


@given(st.lists(st.fractions(-5, 5, max_denominator=6), min_size=1, max_size=5))
def test_all_roots_of_a_polynomial_are_found(planted: list[Fraction]) -> None:
    polynomial = sympy.prod([X - sympy.Rational(*root.as_integer_ratio()) for root in planted])
    assert sorted(float(root) for root in roots(polynomial)) == pytest.approx(sorted({float(root) for root in planted}))


@pytest.mark.slow
@settings(max_examples=30)
@given(
    st.lists(st.fractions(Fraction(1, 5), 5, max_denominator=6), min_size=1, max_size=4),
    st.sampled_from([1, 3, Fraction(1, 2)]),
)
def test_all_roots_of_a_sum_of_exponentials_are_found(planted: list[Fraction], rate: Fraction) -> None:
    z = sympy.exp(sympy.Rational(*Fraction(rate).as_integer_ratio()) * X)
    found = roots(sympy.expand(sympy.prod([z - sympy.Rational(*root.as_integer_ratio()) for root in planted])))
    assert sorted(map(float, found)) == pytest.approx(sorted({math.log(root) / float(rate) for root in planted}), abs=1e-9)


def test_an_exact_root_is_given_exactly() -> None:
    assert roots(X**2 - X - 1) == [(1 - sympy.sqrt(5)) / 2, (1 + sympy.sqrt(5)) / 2]
    assert roots(X**2 - X - 1, 0) == [(1 + sympy.sqrt(5)) / 2]
    assert roots(5 * X - 4) == [sympy.Rational(4, 5)]
    assert roots(X) == [0]
    assert roots(X**2 + 1) == roots(2**X + 1) == []
    assert roots(sympy.sqrt(X) - 3) == [9]


@settings(max_examples=10)
@given(st.floats(0.1, 0.99), st.floats(1.01, 3))
def test_any_other_equation_is_solved_between_opposite_signs(low: float, high: float) -> None:
    (root,) = roots(X * sympy.exp(X) - sympy.E, low, high)
    assert float(root) == pytest.approx(1)
    for ends in ((), (low,), (low, low / 2), (2, 3)):
        with pytest.raises(ModelValueError, match="No rule finds where"):
            roots(X * sympy.exp(X) - sympy.E, *ends)


@pytest.mark.parametrize(
    "equation", [3**X - 5 * 2**X + 5, X ** sympy.Rational(137, 100) - 3 * X ** sympy.Rational(31, 100) + 1, X**99 - 3 * X + 1]
)
def test_where_signs_change_twice_no_root_is_taken_for_the_only_one(equation: sympy.Expr) -> None:
    with pytest.raises(ModelValueError, match="No rule finds where"):
        roots(equation)
    (root,) = roots(equation, 0.01, 0.9)
    (other,) = roots(equation, 0.95, 5)
    assert [equation.evalf(subs={X: found}) for found in (root, other)] == pytest.approx([0, 0], abs=1e-6)


def test_the_first_age_at_which_a_production_applies_ends_a_life() -> None:
    """Whichever production is written first: words, diagrams and lineages have one model of ageing."""
    early_last = timed(read("axiom: a(0)\na(2) -> a(0) b(0)\na(1) -> c(0)"))
    early_first = timed(read("axiom: a(0)\na(1) -> c(0)\na(2) -> a(0) b(0)"))
    assert str(early_last.word("3/2")) == str(early_first.word("3/2")) == "c(0.5)"
    assert [str(part) for part in early_last.ages.daughters(Module("a", (0,)))] == ["c(0)"]
    assert repr(stages(early_last)) == repr(stages(early_first)) == "a(0) -> c(0) after 1"
    assert str(lineage(early_last, 3).last) == "c(2)"


def test_a_life_ends_alike_in_steps_and_in_time() -> None:
    in_time = timed(read("axiom: M(0)\nM(3) -> M(0) M(1)")).ages
    in_steps = age_model(States(read("axiom: M(0)\nM(t) -> M(t+1)\ndecomposition:\nM(t) : t >= 3 -> M(t-3) M(t-2)")))
    young = Module("M", (1,))
    assert in_time.end(young)[1] == in_steps.end(young)[1] == 3
    assert in_time.daughters(young) == in_steps.daughters(young) == [Module("M", (0,)), Module("M", (1,))]
    assert in_time.aged(young, 2) == in_steps.aged(young, 2) == Module("M", (2,))
    assert in_time.ageless(young) == in_steps.ageless(young) == ("M", ())


def test_a_timed_system_is_shown_as_its_text() -> None:
    assert repr(timed(read("axiom: a(0)\na(1) -> a(0) a(0)"))) == "In continuous time:\naxiom: a(0)\na(1) -> a(0)a(0)"
