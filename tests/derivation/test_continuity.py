"""Continuity: growth functions, and what happens to the length of a filament where its cells divide."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import pytest
import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelLimitError, ModelNameError, ModelSyntaxError, ModelValueError, read, system, timed
from lsys_kit.derivation.timed.continuity import Continuity, continuity, growth_base

ANABAENA = read("axiom: ar(0)\nar(1) -> al(0) br(0)\nal(1) -> bl(0) ar(0)\nbr(1) -> ar(0)\nbl(1) -> al(0)")
EXPONENTIAL = {"ar al": "A * exp(B*(t+1))", "br bl": "A * exp(B*t)"}
GOLDEN = (1 + 5**0.5) / 2

CELLS = read("t_div = 1\nt_s = 0\nt_l = 0.2\naxiom: R(0)\nL(t_div) -> L(t_s) R(t_l)\nR(t_div) -> L(t_l) R(t_s)")
"""The cells of L-system 7, as a timed system."""

HUNDREDTHS = st.integers(0, 300).map(lambda number: Fraction(number, 100))
FACTORS = st.fractions(Fraction(1, 5), 5, max_denominator=20)


def cells(lengths: str, order: int = 0, **constants: object) -> Continuity:
    return continuity(CELLS, {"L R": lengths}, order, **constants)


def jumps(found: Continuity) -> list[float]:
    return [float(division.defect) for division in found.divisions]


# What the seeds and the book say


def test_anabaena_with_exponential_growth() -> None:
    """A b-cell is a young a-cell: e^(2B) = e^B + 1, so B = ln((1 + sqrt(5))/2) = 0.4812 (ABOP, section 6.2)."""
    found = continuity(ANABAENA, EXPONENTIAL)
    rate = found.solve("B")
    assert rate == sympy.log((1 + sympy.sqrt(5)) / 2)
    assert float(rate) == pytest.approx(0.4812, abs=5e-5)
    assert continuity(ANABAENA, EXPONENTIAL, B=rate).continuous


def test_a_young_a_cell_is_a_b_cell() -> None:
    """The same filament with one letter that lives twice as long: a(2) -> a(1) a(0)."""
    found = continuity(read("axiom: a(1)\na(2) -> a(1) a(0)"), {"a": "A * exp(B*t)"})
    assert found.solve("B") == continuity(ANABAENA, EXPONENTIAL).solve("B")
    assert found.equations == continuity(ANABAENA, EXPONENTIAL).equations


def test_the_equation_of_seed_002() -> None:
    """a^t_div = a^t_s + a^t_l (section 8)."""
    found = cells("a^t", t_div="t_div", t_s="t_s", t_l="t_l")
    a, t_div, t_s, t_l = sympy.symbols("a t_div t_s t_l", real=True)
    assert found.equations == (sympy.Eq(a**t_div, a**t_s + a**t_l),)
    assert found.unknowns == ("a", "t_div", "t_l", "t_s")
    assert not found.continuous


def test_the_base_of_seed_002() -> None:
    base = cells("a^t").solve("a")
    assert float(base) == pytest.approx(2.167303978, abs=1e-9)
    assert cells("a^t", a=base).continuous


def test_the_base_as_it_is_printed_leaves_a_small_jump() -> None:
    found = cells("a^t", a="2.1673")
    assert not found.continuous
    assert all(0 < abs(jump) < 1e-5 for jump in jumps(found))


def test_a_base_that_the_system_declares_may_be_unknown() -> None:
    """As in `derive`: a constant that is given its own name has no value."""
    system = read(f"a = 2.1673\nhalf = t_l/2\n{CELLS.source}".replace("half = t_l/2\nt_div", "t_div"))
    found = continuity(system, {"L R": "a^t"}, a="a")
    base = found.solve("a")
    assert float(base) == pytest.approx(growth_base(1, 0, 0.2), abs=1e-12)
    assert continuity(system, {"L R": "a^t"}, a=base).continuous


# Laws


@pytest.mark.slow
@settings(max_examples=20)
@given(HUNDREDTHS, HUNDREDTHS, HUNDREDTHS)
def test_daughters_that_begin_younger_have_one_base(t_div: Fraction, t_s: Fraction, t_l: Fraction) -> None:
    assume(t_div > max(t_s, t_l))
    found = cells("a^t", t_div=t_div, t_s=t_s, t_l=t_l)
    base = float(found.solve("a"))
    assert base > 1
    assert base == pytest.approx(growth_base(float(t_div), float(t_s), float(t_l)), rel=1e-9)
    assert abs(1 - base ** float(t_s - t_div) - base ** float(t_l - t_div)) < 1e-9
    assert cells("a^t", t_div=t_div, t_s=t_s, t_l=t_l, a=base).continuous


@pytest.mark.slow
@settings(max_examples=20)
@given(HUNDREDTHS, HUNDREDTHS, HUNDREDTHS)
def test_a_base_and_a_rate_say_the_same(t_div: Fraction, t_s: Fraction, t_l: Fraction) -> None:
    assume(t_div > max(t_s, t_l))
    ages: dict[str, Any] = {"t_div": t_div, "t_s": t_s, "t_l": t_l}
    base, rate = cells("a^t", **ages).solve("a"), cells("exp(B*t)", **ages).solve("B")
    assert float(rate) == pytest.approx(math.log(float(base)), rel=1e-9)


@given(st.fractions(0, 6, max_denominator=50))
def test_a_filament_of_continuous_cells_grows_as_one_cell(at: Fraction) -> None:
    """Its length is that of a single cell that never divides, at every time."""
    base = growth_base(1, 0, 0.2)
    word = timed(CELLS).word(at)
    assert sum(base ** float(module.arguments[0]) for module in word) == pytest.approx(base ** float(at))  # type: ignore[arg-type]


@pytest.mark.parametrize("division", [1, 2, 3, "9/5", "13/5"])
def test_the_length_is_the_same_just_before_and_just_after_a_division(division: object) -> None:
    found, moment = timed(CELLS), Fraction(str(division))
    moments = [found.word(moment + Fraction(shift, 10**9)) for shift in (-1, 0, 1)]
    assert len(moments[0]) == len(moments[1]) < len(moments[2])
    for base, jump in ((growth_base(1, 0, 0.2), 0), (2, 0.1)):
        lengths = [sum(base ** float(module.arguments[0]) for module in word) for word in moments]  # type: ignore[arg-type]
        assert lengths[1] - lengths[0] == pytest.approx(0, abs=1e-6)
        assert (lengths[2] - lengths[1] > jump) if jump else lengths[2] - lengths[1] == pytest.approx(0, abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("order", [1, 2, 5, 9])
def test_exponential_growth_is_continuous_of_every_order(order: int) -> None:
    """g' = B g: what holds for the length holds for all its derivatives."""
    rate = continuity(ANABAENA, EXPONENTIAL).solve("B")
    assert continuity(ANABAENA, EXPONENTIAL, order, B=rate).continuous
    assert continuity(ANABAENA, EXPONENTIAL, order, A="3/7", B=rate).continuous
    assert continuity(ANABAENA, EXPONENTIAL, order).solve("B") == rate


def test_anabaena_with_linear_growth_has_a_jump_or_a_bend() -> None:
    """Two daughters that both grow as fast as their mother grow twice as fast together."""
    jumping = continuity(ANABAENA, {"ar al br bl": "1 + t"})
    assert jumps(jumping) == [0, 0, 1, 1]
    assert str(jumping.divisions[2]) == "br(1) -> ar(0): 2 before, 1 after, a jump of -1"
    bent = continuity(ANABAENA, {"ar al": "2 + t", "br bl": "1 + t"}, 1)
    assert continuity(ANABAENA, {"ar al": "2 + t", "br bl": "1 + t"}).continuous
    assert not bent.continuous
    assert jumps(bent) == [0, 0, 0, 0, -1, -1, 0, 0]
    assert str(bent.divisions[4]) == "ar(1) -> al(0)br(0): derivative 1: 1 before, 2 after, a jump of 1"


@pytest.mark.slow
@settings(max_examples=20)
@given(HUNDREDTHS, HUNDREDTHS, HUNDREDTHS, FACTORS)
def test_linear_growth_of_equal_cells_is_never_smooth(t_div: Fraction, t_s: Fraction, t_l: Fraction, first: Fraction) -> None:
    """p + c t_div = 2p + c (t_s + t_l) has one c, and then the slope doubles."""
    assume(t_div > max(t_s, t_l) and t_div != t_s + t_l)
    ages: dict[str, Any] = {"t_div": t_div, "t_s": t_s, "t_l": t_l, "p": first}
    slope = cells("p + c*t", **ages).solve("c")
    assert slope == sympy.Rational(*(first / (t_div - t_s - t_l)).as_integer_ratio())
    assert cells("p + c*t", **ages, c=slope).continuous
    assert [division.defect for division in cells("p + c*t", 1, **ages, c=slope).divisions] == [0, 0, -slope, -slope]
    with pytest.raises(ModelValueError, match='No value of "c" makes'):
        cells("p + c*t", 1, **ages).solve("c")


@pytest.mark.slow
@settings(max_examples=20)
@given(FACTORS, FACTORS)
def test_the_unit_of_length_does_not_matter(base: Fraction, unit: Fraction) -> None:
    one, other = cells("a^t", a=base), cells("u * a^t", a=base, u=unit)
    assert jumps(other) == pytest.approx([float(unit) * jump for jump in jumps(one)])
    assert cells("u * a^t").solve("a") == cells("a^t").solve("a")


@settings(max_examples=20)
@given(st.integers(1, 40))
def test_each_of_many_daughters_is_counted(number: int) -> None:
    """n daughters of age 0 for a mother of age 1: a = n."""
    found = continuity(read(f"n = {number}\naxiom: A(0)\nA(1) -> repeat(n) <A(0)>"), {"A": "a^t"})
    assert [division.daughters for division in found.divisions] == [number]
    if number > 1:
        assert found.solve("a") == number


def test_a_timed_system_keeps_its_constants() -> None:
    assert cells("a^t", t_l="0.3").equations == continuity(timed(CELLS, t_l="0.3"), {"L R": "a^t"}).equations
    assert cells("a^t", t_l="0.3").equations == continuity(timed(CELLS, t_s="0.3"), {"L R": "a^t"}, t_l="0.3", t_s=0).equations


def test_only_the_first_parameter_is_an_age() -> None:
    polar = read("axiom: M(0,1)\nM(1,p) -> M(0,p) M(1/5,-p) [x]")
    assert continuity(polar, {"M": "a^t"}).solve("a") == cells("a^t").solve("a")


# R1: growth functions are continuous on the life spans


@pytest.mark.slow
@pytest.mark.parametrize(
    "lengths",
    [
        "1/(t-1)",
        "A/(t-1)",
        "1/t",
        "log(t)",
        "sqrt(t - 1/2)",
        "(t - 1/2)^(1/3)",
        "tan(90*t)",
        "1 + 1/(2*t-1)^2",
        "(-2)^t",
        "asin(2*t)",
        "1/0 + t",
        "exp(1/(t-1/3))",
    ],
)
def test_a_growth_function_is_continuous_while_its_cell_lives(lengths: str) -> None:
    with pytest.raises(ModelValueError, match=r"is not continuous on the life span of R, from 0 to 1"):
        cells(lengths)


@pytest.mark.slow
@pytest.mark.parametrize(
    "lengths",
    [
        "1/(t-2)",
        "sqrt(t)",
        "1 + log(t+1)",
        "min(1, 2*t)",
        "max(t, 1/2)",
        "1 + abs(t-1/2)",
        "3/(1+exp(-2*(t-1/2)))",
        "t^3 - 2*t^2 + 5",
        "t^0.37",
        "sin(90*t)",
        "A*t^c",
        "a^t",
        "t/(t+c)",
    ],
)
def test_what_is_continuous_passes(lengths: str) -> None:
    assert cells(lengths).undecided == ()


def test_outside_of_its_life_span_a_growth_function_may_do_as_it_likes() -> None:
    late = read("axiom: A(2)\nA(3) -> A(2) B(5)")
    assert continuity(late, {"A": "1/(t-1)", "B": "1/(t-4)"}).divisions[0].daughters == 2
    with pytest.raises(ModelValueError, match="on the life span of B, from 5 to oo"):
        continuity(late, {"A": "t", "B": "1/(t-1000)"})


@pytest.mark.slow
def test_a_bend_is_no_jump_but_no_derivative_either() -> None:
    assert cells("sqrt(t)").undecided == ()
    with pytest.raises(ModelValueError, match=r'^Derivative 1 of the growth function "sqrt\(t\)" is not continuous'):
        cells("sqrt(t)", 1)
    with pytest.raises(LSystemError, match="is undecided"):
        cells("1 + abs(t-1/2)", 1)


@pytest.mark.parametrize("lengths", ["1/(t^1.37 - t^0.31 - 2)", "log(t^100 + 2)", "tan(t^10 + exp(3))", "1/(2^(t^2) - 5)"])
def test_what_would_take_for_ever_to_find_out_is_not_told(lengths: str) -> None:
    with pytest.raises(ModelValueError, match="on the life span of R is undecided"):
        cells(lengths)


def test_an_unknown_name_may_decide() -> None:
    found = cells("1/(t-c)")
    assert found.undecided == ("R", "L")
    assert not found.continuous
    assert "L: unknown names decide whether its growth is continuous" in repr(found)
    assert cells("1/(t-c)", c=2).undecided == ()
    renewed = continuity(read("axiom: A(0)\nA(1) -> A(0)"), {"A": "1 + t*(1-t)/(t-c)"})
    assert [division.defect for division in renewed.divisions] == [0]
    assert not renewed.continuous
    with pytest.raises(ModelValueError, match="is not continuous"):
        cells("1/(t-c)", c="1/2")


def test_a_solution_is_none_where_a_growth_function_breaks() -> None:
    """a^2 = a + 1 has a negative root, of which (-0.618)^t is no length."""
    assert cells("a^t", t_div=2, t_l=1).solve("a") == (1 + sympy.sqrt(5)) / 2


# Solving


@pytest.mark.slow
@pytest.mark.parametrize(
    ("lengths", "limits", "value"),
    [
        ("(t+x)^2", (0, None), (2 + 10**0.5) / 5 * 2),
        ("(t+x)^2", (None, 0), -0.464911),
        ("exp(c*t) - c", (0.1, 5), 0.481954),
        ("1/(1+exp(-k*(t-1/2)))", (None, None), 1.608094),
        ("2^(c*t)", (None, None), math.log2(2.167303978)),
        ("1 + c*t", (None, None), 1.25),
        ("1 + c^3*t", (None, None), 1.25 ** (1 / 3)),
    ],
)
def test_one_unknown_name_is_found(lengths: str, limits: tuple[object, object], value: float) -> None:
    found = cells(lengths)
    (name,) = found.unknowns
    root = found.solve(name, *limits)
    assert float(root) == pytest.approx(value, rel=1e-5)
    assert cells(lengths, **{name: root}).continuous


def test_with_fixed_growth_the_age_of_a_daughter_is_found() -> None:
    found = cells("a^t", a=3, t_l="t_l")
    age = found.solve("t_l")
    assert float(age) == pytest.approx(math.log(2, 3))
    assert cells("a^t", a=3, t_l=age).continuous


@pytest.mark.parametrize(
    ("lengths", "name", "limits", "error", "message"),
    [
        ("a^t", "b", (), ModelNameError, 'has the name "b"'),
        ("1 + t", "t", (), ModelNameError, 'has the name "t"'),
        ("p + c*t", "c", (), ModelValueError, 'The value of "c" depends on p. Give p a value: continuity(..., p=1).'),
        ("p * (1+t)", "p", (), ModelValueError, 'No value of "p" makes the length continuous'),
        ("c*t + c", "c", (), ModelValueError, 'No value of "c" makes the length continuous'),
        ("1/c", "c", (), ModelValueError, 'No value of "c" makes the length continuous'),
        ("a^t", "a", (3, 9), ModelValueError, 'No value of "a" in that range makes the length continuous'),
        ("(t+x)^2", "x", (), ModelValueError, 'More than one value of "x" makes the length continuous: -0.464911, 2.06491'),
        ("exp(c*t) - c", "c", (), ModelValueError, 'No rule finds where "c - exp(c/5) + exp(c) - 1" is 0'),
        ("exp(c*t) - c", "c", (4, 5), ModelValueError, "No rule finds where"),
    ],
)
def test_what_cannot_be_solved_is_told(
    lengths: str, name: str, limits: tuple[object, ...], error: type[LSystemError], message: str
) -> None:
    with pytest.raises(error) as caught:
        cells(lengths).solve(name, *limits)
    assert message in str(caught.value)


def test_a_jump_that_no_value_mends_is_named() -> None:
    found = continuity(ANABAENA, {"ar al": "c + t", "br bl": "1 + t"})
    assert jumps(continuity(ANABAENA, {"ar al": "c + t", "br bl": "1 + t"}, c=2)) == [0, 0, 0, 0]
    assert found.solve("c") == 2
    with pytest.raises(ModelValueError, match=r'Whatever "c" is, the length jumps: ar\(1\) -> al\(0\)br\(0\): 1 before'):
        continuity(ANABAENA, {"ar": "t", "al": "c*t", "br": "5", "bl": "0"}).solve("c")


# Mistakes


@pytest.mark.parametrize(
    ("lengths", "error", "message"),
    [
        ({"L": "t"}, ModelNameError, 'The letter "R" has no growth function. Where it has no length, write "0".'),
        ({"L R X": "t"}, ModelNameError, 'The system has no letter "X" with an age. Its letters are: R, L.'),
        ({"L R": "1 +"}, ModelSyntaxError, "A value is missing here (line 1, column 4)"),
        ({"L R": "1 +\n  )"}, ModelSyntaxError, "(line 2, column 3)"),
        ({"L R": "t < 1"}, ModelValueError, '"t < 1" is true or false, but a number is needed here (line 1, column 1)'),
        ({"L R": "uniform(0, 1)"}, ModelValueError, "draws a new number at every use"),
        (
            {"L R": "1 + if(t < 1, t, 2)"},
            ModelValueError,
            '"if(t < 1, t, 2)" may jump, which no length does (line 1, column 5)',
        ),
        ({"L R": "floor(t)"}, ModelValueError, "may jump"),
        ({"L R": 5}, ModelValueError, "A growth function is a text"),
        ({"L R": "max(asin(3), t)"}, ModelValueError, "has no value"),
        ({"L R": "t" + "+t" * 200}, ModelLimitError, "at most 300 characters"),
        ({"L R": "2^(10^9 * 10^9 * t)"}, ModelLimitError, "The powers here are too large"),
        ({"L R": "t + 9^9^9^9"}, ModelLimitError, "The powers here are too large"),
        ({"L R": "((t^1000)^1000)^1000"}, ModelLimitError, "The powers here are too large"),
        ({"L R": "exp(exp(exp(exp(t))))"}, ModelLimitError, "The powers here are too large"),
        ({"L R": "__import__('os')"}, ModelSyntaxError, "line 1"),
    ],
)
def test_a_mistake_is_explained(lengths: dict[str, str], error: type[LSystemError], message: str) -> None:
    with pytest.raises(error) as caught:
        continuity(CELLS, lengths)
    assert message in str(caught.value)


@pytest.mark.parametrize("order", [-1, 10, 1.0, True, "1"])
def test_an_order_is_a_small_whole_number(order: Any) -> None:
    with pytest.raises(ModelValueError, match="The order of continuity is a whole number from 0 to 9"):
        cells("a^t", order)


def test_a_name_that_nobody_knows_is_refused() -> None:
    with pytest.raises(ModelNameError, match='has the name "growth"'):
        cells("grow * t", growth=1)
    with pytest.raises(ModelNameError, match='has the name "t"'):
        cells("a^t", t=1)
    with pytest.raises(ModelNameError, match='a constant "t", which is the age'):
        continuity(read("t = 1\naxiom: A(0)\nA(1) -> A(0)"), {"A": "a^t"})


def test_a_system_without_ages_has_no_growth_functions() -> None:
    with pytest.raises(ModelValueError, match="does not say at which age"):
        continuity(read("axiom: A(0)\nA(t) -> A(t+1)"), {"A": "t"})


def test_a_system_of_steps_is_asked_like_a_timed_one() -> None:
    found = continuity(system("K27"), {"ar al": "A * exp(B*(t+1))", "br bl": "A * exp(B*t)"})
    assert str(found.solve("B")) == "log(1/2 + sqrt(5)/2)"
    for name in ("P5", "P6"):
        assert float(continuity(system(name), {"M": "g^t"}).solve("g")) == pytest.approx(2.167303978, abs=1e-9)
    assert continuity(system("J4"), {"Al Ar": "t + 1", "Bl Br": "t + 1"}, lifeTimeA=3, lifeTimeB=3).divisions[0].defect == 1


def test_ages_may_stand_behind_other_values() -> None:
    cells = read(
        "dt = 1/4\naxiom: M(LEFT,0)\nM(p,t) -> M(p,t+dt)\ndecomposition:\nM(p,t) : t >= 1 -> M(p,t-1) M(1-p,t-1)".replace(
            "LEFT", "0"
        )
    )
    assert continuity(cells, {"M": "2^t"}).continuous
    assert not continuity(cells, {"M": "1 + t^2"}, order=1).continuous


ONE_OR_TWO = read("axiom: a(0)\na(1) -> a(0) b(0)\nb(1) -> a(0)")


def test_a_letter_that_lives_for_ever_never_jumps() -> None:
    found = continuity(
        read("axiom: M(0)\nM(t) -> M(t+1)\nN(t) -> N(t+1)\ndecomposition:\nM(t) : t >= 3 -> N(t-3) N(t-2)"), {"M N": "t + 1"}
    )
    assert str(found) == "M(t) : t >= 3 -> N(t - 3)N(t - 2): 4 before, 3 after, a jump of -1"


def test_each_division_says_whether_it_is_continuous() -> None:
    assert str(continuity(ONE_OR_TWO, {"a": "1", "b": "t"})) == "a(1) -> a(0)b(0): continuous\nb(1) -> a(0): continuous"


def test_a_sine_is_solved_between_two_numbers() -> None:
    found = continuity(read("axiom: a(0)\na(1) -> a(0) a(0)"), {"a": "2 + 4*sin(c*t)"})
    assert float(found.solve("c", 1, 80)) == pytest.approx(30)


def test_where_a_length_is_not_real_it_is_no_solution() -> None:
    rooted = {"a": "1 + max(sqrt(c-2),1)*t", "b": "1 + c*t"}
    with pytest.raises(ModelValueError, match='No rule finds where "Max\\(1, sqrt\\(c - 2\\)\\) - 1" is 0'):
        continuity(ONE_OR_TWO, rooted).solve("c", -5, 9)
    with pytest.raises(ModelValueError, match='No value of "c" in that range'):
        continuity(ONE_OR_TWO, {"a": "c*t", "b": "c*(c+4)*(1 + max(sqrt(c),1)*t)"}).solve("c", -5, 9)


def test_a_length_at_a_first_age_must_be_real() -> None:
    born_early = read("c = 2\naxiom: a(0)\na(3) -> b(1)\nb(c) -> a(0)")
    with pytest.raises(ModelValueError, match="The length of b has no value at a division"):
        continuity(born_early, {"a": "1", "b": "max(sqrt(t-9),1)"}, c="c")
