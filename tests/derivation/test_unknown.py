"""Constants that are not known: words with symbols in them, as long as every condition can be decided."""

from __future__ import annotations

import pytest
import sympy

from lsys_kit import LSystemError, ModelValueError, derive, read, system

AGEING = read("dt = 0.7\naxiom: M(0)\nM(t) -> M(t+dt)")


def test_an_unknown_constant_stays_a_symbol() -> None:
    assert [str(word) for word in derive(AGEING, 3, dt="dt")] == ["M(0)", "M(dt)", "M(2*dt)", "M(3*dt)"]


def test_a_sympy_expression_may_be_given() -> None:
    x = sympy.Symbol("x")
    assert str(derive(AGEING, 2, dt=x / 2)[-1]) == "M(x)"
    assert derive(AGEING, 2, dt=sympy.Rational(1, 2))[-1] == derive(AGEING, 2, dt="1/2")[-1]


def test_equal_expressions_are_one_state() -> None:
    states = derive(read("c = 1\naxiom: A(c) \nA(x) -> A(c*(c+1)) A(c^2+c)"), 1, c="c").states
    assert [str(module) for module in states.modules] == ["A(c)", "A(c^2 + c)"]


def test_what_cancels_is_a_number_again() -> None:
    word = derive(read("c = 1\naxiom: A(c)\nA(x) : x - c < 1 -> B(x - c)"), 1, c="c")[-1]
    assert word[0].arguments == (0,)


def test_every_number_put_in_gives_the_word_of_that_number() -> None:
    unknown = derive(system("P5"), 2, t_l="t_l")[-1]
    for value in (0, sympy.Rational(1, 5), sympy.Rational(1, 2)):
        put_in = [tuple(sympy.sympify(a).subs(sympy.Symbol("t_l", real=True), value) for a in m.arguments) for m in unknown]
        assert put_in == [m.arguments for m in derive(system("P5"), 2, t_l=value)[-1]]


def test_an_open_condition_is_named_with_what_to_choose() -> None:
    with pytest.raises(ModelValueError) as error:
        derive(system("P5"), 3, dt="dt")
    assert str(error.value).startswith("Whether production 1, M(t,p) : t+dt < t_div -> M(t+dt, p), applies to M(0,1) cannot be")
    assert error.value.hint == (
        "Step 0 is the last that can be reached. It depends on whether t + dt < t_div: "
        'choose a value for dt, or derive with letters="dt", where its own value decides.'
    )


@pytest.mark.parametrize("rule", ["A(x) : x == 3 -> B", "A(3) -> B", "A(x) : x != 3 -> B", "A(x) : x > 0 && x < 9 -> B"])
def test_equality_with_an_unknown_is_no_answer(rule: str) -> None:
    with pytest.raises(ModelValueError, match="cannot be decided"):
        derive(read(f"c = 1\naxiom: A(c)\n{rule}"), 1, c="c")


@pytest.mark.parametrize("value", ["sqrt(x)", "log(x)", "floor(x)", "max(x, 1)", "sin(x)"])
def test_functions_of_an_unknown_have_no_value(value: str) -> None:
    with pytest.raises(LSystemError):
        derive(read(f"c = 1\naxiom: A(c)\nA(x) -> A({value})"), 1, c="c")
