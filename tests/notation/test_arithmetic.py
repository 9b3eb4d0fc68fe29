"""Arithmetic is that of the papers: exact, until an operation leaves the rational numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import pytest
import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from lsys_kit.budget import limits
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.arithmetic import (
    Decision,
    Formula,
    Value,
    bounded_exact,
    equal_values,
    finite,
    normalised,
    number_text,
    power,
    reason_of,
    short_text,
)
from lsys_kit.notation.model.expressions import (
    OPERATORS,
    Apply,
    Expression,
    Name,
    Number,
    expression_type,
    function_of,
    names_in,
    to_sympy,
)
from lsys_kit.notation.read import read, read_expression
from tests.derivation.reference import value

NAMES = ("t", "x")
ORDER = {"t": 0, "x": 1}
decimals = st.builds(lambda n, p: normalised(Fraction(n, 10**p)), st.integers(-99, 99), st.integers(0, 2))
rationals = st.builds(lambda n, d: normalised(Fraction(n, d)), st.integers(-20, 20), st.integers(1, 12))


def grown(smaller: st.SearchStrategy[Expression]) -> st.SearchStrategy[Expression]:
    two = st.tuples(smaller, smaller)
    return st.one_of(
        st.builds(Apply, st.sampled_from(("+", "-", "*", "/", "min", "max")), two),
        st.builds(Apply, st.just("^"), st.tuples(smaller, st.integers(-3, 3).map(Number))),
        st.builds(Apply, st.sampled_from(("abs", "floor", "ceil")), st.tuples(smaller)),
        smaller.filter(lambda e: not isinstance(e, Number)).map(lambda e: Apply("-x", (e,))),
        st.builds(Apply, st.sampled_from(("min", "max")), st.tuples(smaller, smaller, smaller)),
    )


expressions = st.recursive(st.one_of(decimals.map(Number), st.sampled_from(NAMES).map(Name)), grown, max_leaves=6)
relations = st.builds(Apply, st.sampled_from(("==", "!=", "<", "<=", ">", ">=")), st.tuples(expressions, expressions))
conditions = st.recursive(
    relations,
    lambda smaller: st.one_of(
        st.builds(Apply, st.sampled_from(("&&", "||")), st.tuples(smaller, smaller)),
        st.builds(Apply, st.just("!"), st.tuples(smaller)),
    ),
    max_leaves=3,
)


def oracle(expression: Expression, t: Value, x: Value) -> Any:
    """What the expression comes to with fractions, if anything."""
    try:
        return value(expression, {"t": Fraction(t), "x": Fraction(x)})
    except ZeroDivisionError:
        return None


def parts(expression: Expression) -> Iterator[Expression]:
    """The expression and all within it."""
    yield expression
    for operand in getattr(expression, "operands", ()):
        yield from parts(operand)


@given(st.one_of(expressions, conditions), rationals, rationals)
def test_functions_compute_as_fractions_do(expression: Expression, t: Value, x: Value) -> None:
    expected = oracle(expression, t, x)
    if expected is None:
        with pytest.raises(ZeroDivisionError):
            function_of(expression, ORDER)((t, x))
        return
    found = function_of(expression, ORDER)((t, x))
    assert found == expected
    assert not isinstance(found, float)
    assert not (isinstance(found, Fraction) and found.denominator == 1), "a whole number is an int"


@given(st.one_of(expressions, conditions), rationals, rationals)
def test_sympy_agrees(expression: Expression, t: Value, x: Value) -> None:
    expected = oracle(expression, t, x)
    assume(all(oracle(part, t, x) is not None for part in parts(expression)))  # sympy looks at both sides of "or"
    values = {sympy.Symbol(name): sympy.Rational(v.numerator, v.denominator) for name, v in (("t", t), ("x", x))}  # type: ignore[union-attr]
    found = to_sympy(expression).subs(values, simultaneous=True)
    assert found == (expected if isinstance(expected, bool) else sympy.Rational(expected))


@given(expressions, rationals, rationals)
def test_float_arithmetic_gives_doubles_alone(expression: Expression, t: Value, x: Value) -> None:
    try:
        found = function_of(expression, ORDER, "float")((float(t), float(x)))
    except ArithmeticError:
        return
    assert isinstance(found, float)


@given(st.one_of(expressions, conditions))
def test_an_expression_reads_back(expression: Expression) -> None:
    assert read_expression(str(expression)) == expression


@given(st.one_of(expressions, conditions))
def test_names_are_those_of_the_text(expression: Expression) -> None:
    assert names_in(expression) == {name for name in NAMES if name in str(expression).replace("max", "")}
    assert expression_type(expression) == ("truth" if any(sign in str(expression) for sign in "<>=!&|") else "number")


DT = ("0.1", "0.2", "0.3", "0.6", "0.7", "0.9", "1.1")
STEPS = (3, 6, 7, 10, 11, 17, 30)


def met(dt: str, steps: int, arithmetic: str) -> bool:
    """Whether an age that should be T after so many steps of dt is found to be T (and the cell divides at the next step)."""
    system = read(f"dt = {dt}\nT = {steps}*dt\naxiom: A(0)\nA(t) : t == T -> B\nA(t) -> A(t + dt)")
    return str(derive(system, steps + 1, arithmetic=arithmetic)[-1]) == "B"


@pytest.mark.parametrize("dt", DT)
@pytest.mark.parametrize("steps", STEPS)
def test_an_age_that_should_be_exactly_t_is_t(dt: str, steps: int) -> None:
    assert met(dt, steps, "exact")


def test_in_doubles_most_such_ages_are_missed() -> None:
    missed = [(dt, steps) for dt in DT for steps in STEPS if not met(dt, steps, "float")]
    assert len(missed) > 24


@pytest.mark.parametrize(
    ("text", "result"),
    [
        ("0.1 + 0.2", Fraction(3, 10)),
        ("1/3*3", 1),
        ("2^10", 1024),
        ("2^-1", Fraction(1, 2)),
        ("4^0.5", 2.0),
        ("0.5^2", Fraction(1, 4)),
        ("-2^2", -4),
        ("(-2)^2", 4),
        ("2^3^2", 512),
        ("7 - 2 - 1", 4),
        ("8/4/2", 1),
        ("2*3 + 4", 10),
        ("-3 - -4", 1),
        ("+5", 5),
        ("floor(2.5)", 2),
        ("ceil(2.5)", 3),
        ("floor(-2.5)", -3),
        ("abs(-0.5)", Fraction(1, 2)),
        ("min(3, 1, 2)", 1),
        ("max(1/2, 1/3)", Fraction(1, 2)),
        ("sqrt(4)", 2.0),
        ("exp(0)", 1.0),
        ("log(1)", 0.0),
        ("floor(sqrt(5))", 2.0),
        ("ceil(sqrt(5))", 3.0),
        ("1e-3", Fraction(1, 1000)),
        (".5", Fraction(1, 2)),
        ("2·3 − 1", 5),
        ("6×7", 42),
        ("sqrt(2) / 2", math.sqrt(2) / 2),
        ("1 / sqrt(4)", 0.5),
        ("1 < 2 && !(2 < 1)", True),
        ("1 ≤ 1 ∧ 2 ≥ 3 ∨ 1 ≠ 2", True),
        ("¬(1 == 1)", False),
        ("1 < 2 || 1/0 > 1", True),
        ("1 > 2 && 1/0 > 1", False),
    ],
)
def test_expressions_mean_what_they_mean_on_paper(text: str, result: object) -> None:
    found = function_of(read_expression(text), {})(())
    assert found == result
    assert type(found) is type(result)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0, "0"),
        (-3, "-3"),
        (Fraction(7, 10), "0.7"),
        (Fraction(-1, 8), "-0.125"),
        (Fraction(1, 3), "1/3"),
        (Fraction(-2, 7), "-2/7"),
        (0.1, "0.1"),
        (2.0, "2"),
        (-0.0, "0"),
        (1e16, "1e+16"),
        (1e-7, "1e-07"),
        (Fraction(1, 2**41), f"1/{2**41}"),
        (Fraction(1, 10**3), "0.001"),
    ],
)
def test_values_are_written_as_short_as_they_are_exact(value: Value, text: str) -> None:
    assert number_text(value) == text
    assert function_of(read_expression(text), {})(()) == (Fraction(repr(value)) if isinstance(value, float) else value)


def test_long_values_are_shortened_in_messages() -> None:
    assert short_text(Fraction(1, 3**70)) == "3.99...e-34"
    assert short_text(12345) == "12345"


@pytest.mark.parametrize("value", [2**5_000, Fraction(1, 2**5_000), Fraction(2**2_500, 3**1_500)])
def test_what_is_too_long_is_refused(value: Value) -> None:
    with pytest.raises(OverflowError):
        bounded_exact(value)
    with limits(bits=20_000):
        assert bounded_exact(value) == value


@pytest.mark.parametrize(
    ("base", "exponent"), [(2, 1_001), (2, -1_001), (2**64, 999), (Fraction(1, 2**64), 999), (1e300, 2), (10**400, 0.5)]
)
def test_a_power_that_is_too_large_is_refused(base: Value, exponent: Value) -> None:
    with pytest.raises(OverflowError):
        power(base, exponent)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("1/0", "division by zero"),
        ("0^-1", "division by zero"),
        ("1/(sqrt(4)-2)", "division by zero"),
        ("0.0^-0.5", "division by zero"),
        ("2^1001", "the result is too large"),
        ("exp(1000)", "the result is too large"),
        ("1e300^1.5", "the result is too large"),
        ("sqrt(10^400)", "the result is too large"),
        ("sqrt(-1)", "sqrt(-1) is not a number"),
        ("log(0)", "log(0) is not a number"),
        ("log(-1/3)", "log(-1/3) is not a number"),
        ("(-8)^(1/3)", "(-8)^(1/3) is not a number"),
        ("floor(exp(700)*exp(700))", "the result is too large"),
        ("ceil(exp(700)*exp(700) - exp(700)*exp(700))", "ceil(nan) is not a number"),
    ],
)
def test_a_calculation_that_fails_says_why(text: str, why: str) -> None:
    with pytest.raises((ArithmeticError, ValueError)) as caught:
        function_of(read_expression(text), {})(())
    assert reason_of(caught.value) == why


@pytest.mark.parametrize("value", [float("inf"), -math.inf, 10**400, Fraction(-(10**400), 3)])
def test_infinity_is_no_value(value: Value) -> None:
    with pytest.raises(OverflowError):
        finite(value)


def test_not_a_number_is_no_value() -> None:
    with pytest.raises(ValueError, match="the result is not a number"):
        finite(math.nan)
    assert finite(Fraction(1, 3)) == Fraction(1, 3)


def test_every_operator_can_be_shown_as_mathematics() -> None:
    t, x = Name("t"), Name("x")
    truths = (Apply("<", (t, x)), Apply("==", (t, x)))
    for operator, entry in OPERATORS.items():
        operands = tuple(truths[i % 2] if entry.wanted(i) == "truth" else (t, x)[i % 2] for i in range(entry.arity[0]))
        if entry.random:
            with pytest.raises(ModelValueError, match="is drawn anew at every use: no formula can replace it"):
                to_sympy(Apply(operator, operands))
            continue
        names = {name for operand in operands for name in names_in(operand)}
        assert {symbol.name for symbol in to_sympy(Apply(operator, operands)).free_symbols} == names
    assert to_sympy(Number(0.5)) == sympy.Float(0.5)


MEANT = st.one_of(st.integers(-8, 8), rationals, st.sampled_from((-180, -90, -45, -30, 30, 45, 60, 90, 150, 270)))


@pytest.mark.slow
@pytest.mark.parametrize("operator", [name for name, entry in OPERATORS.items() if not (entry.random or entry.looks)])
@settings(max_examples=25)
@given(data=st.data())
def test_what_is_shown_as_mathematics_is_what_is_computed(operator: str, data: st.DataObject) -> None:
    """The formula of every operator, at random values of its names, is what the engine computes in numbers."""
    entry = OPERATORS[operator]
    count = data.draw(st.integers(entry.arity[0], min(entry.arity[1], 4)))
    values: list[Value] = [data.draw(MEANT) for _ in range(count)]
    names = [f"x{index}" for index in range(count)]
    operands = tuple(
        Apply("<", (Name(name), Number(0))) if entry.wanted(index) == "truth" else Name(name)
        for index, name in enumerate(names)
    )
    tree = Apply(operator, operands)
    try:
        expected = function_of(tree, {name: index for index, name in enumerate(names)})(tuple(values))
    except (ArithmeticError, ValueError):
        return
    shown = to_sympy(tree).subs(
        {
            sympy.Symbol(name): sympy.Rational(Fraction(value).numerator, Fraction(value).denominator)
            for name, value in zip(names, values, strict=True)
        },
        simultaneous=True,
    )
    if isinstance(expected, bool):
        assert bool(shown) is expected
    elif isinstance(expected, int | Fraction):
        assert shown == sympy.Rational(Fraction(expected).numerator, Fraction(expected).denominator)
    else:
        assert complex(shown.evalf(20)) == pytest.approx(complex(expected), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize(
    ("function", "argument", "degrees"),
    [("asin", Fraction(1, 2), 30), ("acos", Fraction(1, 2), 60), ("atan", 1, 45), ("asin", -1, -90), ("acos", -1, 180)],
)
def test_the_inverse_functions_give_degrees(function: str, argument: Value, degrees: int) -> None:
    tree = Apply(function, (Number(argument),))
    assert function_of(tree, {})(()) == degrees
    assert to_sympy(tree) == degrees


@given(rationals, rationals, st.integers(1, 4))
def test_values_with_unknowns_are_equal_if_they_are_for_every_value_of_these(a: Value, b: Value, factor: int) -> None:
    t, one, other = sympy.Symbol("t"), sympy.Rational(Fraction(a)), sympy.Rational(Fraction(b))
    assert equal_values(factor * (t + one), factor * t + factor * other) is (a == b)
    with pytest.raises(TypeError):
        equal_values(t + one, other)
    with pytest.raises(TypeError):
        equal_values(other, t + one)


@pytest.mark.parametrize(("base", "sign"), [(1, 1), (1, -1), (Fraction(1, 2), 1), (-1, -1)])
def test_the_exponent_may_be_as_great_as_the_limit_and_no_greater(base: Value, sign: int) -> None:
    with limits(exponent=12):
        assert power(base, 12 * sign) == Fraction(base) ** (12 * sign)
        with pytest.raises(OverflowError):
            power(base, 13 * sign)
    assert power(1, 1_000 * sign) == 1
    with pytest.raises(OverflowError):
        power(1, 1_001 * sign)


def test_depth_counts_nested_operations() -> None:
    assert Apply("+", (Apply("-x", (Name("t"),)), Number(1))).depth == 2


def test_a_power_of_an_unknown_is_written_with_a_caret() -> None:
    unknown: Any = sympy.Symbol("t")
    assert number_text(power(unknown, 2)) == "t^2"


def test_a_formula_is_computed_with_as_its_number_is() -> None:
    decisions: dict[Decision, None] = {}
    q = Formula(sympy.Symbol("q"), Fraction(1, 2), decisions)
    assert ((1 + q).number, (1 + q).expression) == (Fraction(3, 2), 1 + sympy.Symbol("q"))
    assert q.free_symbols == {sympy.Symbol("q")}
    assert (q <= 1, bool(q), float(q), int(7 * q)) == (True, True, 0.5, 3)
    assert (Fraction(4, 5) % q).number == Fraction(3, 10)
    assert ((sympy.Symbol("q"), "<=", 1)) in decisions


def test_a_comparison_without_letters_decides_nothing() -> None:
    decisions: dict[Decision, None] = {}
    assert Formula(sympy.sqrt(2), 2**0.5, decisions) < 2
    assert not decisions
