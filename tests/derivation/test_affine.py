"""Sums of values: the linear recurrence says at every step what a derived word adds up to."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from itertools import islice
from typing import Any

import pytest
import sympy

from lsys_kit import derive, read, stages, system
from lsys_kit.derivation.core.chance import splitmix64
from lsys_kit.derivation.growth.affine import AffineSums, NotAffine, affine_sums
from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.model.arithmetic import is_symbolic
from lsys_kit.notation.model.modules import CLOSING, OPENING
from lsys_kit.notation.model.system import LSystem, symbols


def added(word: Any, symbol: str, place: int | None, axis: bool) -> Any:
    """What a parameter, from 0, adds up to in a word, module by module."""
    whole, depth = Fraction(0), 0
    for module in word:
        depth += (module.symbol in OPENING) - (module.symbol in CLOSING)
        if module.symbol == symbol and not (axis and depth):
            whole += module.arguments[place] if place is not None and place < len(module.arguments) else 1
    return whole


def valued(found: Any, values: Mapping[str, Fraction]) -> Fraction:
    """An expression at some values of its letters."""
    if not is_symbolic(found):
        return Fraction(found)
    at = found.subs({each: sympy.Rational(*values[str(each)].as_integer_ratio()) for each in found.free_symbols})
    return Fraction(int(at.p), int(at.q))


def obeyed(model: LSystem, symbol: str, place: int | None, axis: bool, values: Mapping[str, Fraction]) -> AffineSums:
    """The recurrence, with letters for these constants, checked against the words that are derived with their values."""
    found = affine_sums(model, symbol, place, axis, {name: name for name in values})
    for step, word in enumerate(derive(model, 6, **values)):
        assert valued(found.at(step), values) == added(word, symbol, place, axis), step
    return found


Q = {"q": Fraction(3, 5)}
SHOOT = "q = 2\naxiom: A(1)\nA(x) -> F(x) A(q*x)"
BRANCHES = "q = 2\naxiom: A(1)\nA(x) -> F(x) [+A(q*x)] A(x + 1)"
DELAY = "q = 2\naxiom: D(0,1)\nD(t,x) : t < 2 -> D(t+1,q*x)\nD(t,x) -> F(x) D(0,x) D(1,1)"


@pytest.mark.parametrize(("values", "axis"), [({}, False), (Q, False), ({}, True), (Q, True)])
@pytest.mark.parametrize(
    ("text", "symbol", "place"),
    [
        (SHOOT, "F", 0),
        (BRANCHES, "F", 0),
        (BRANCHES, "A", None),
        (DELAY, "F", 0),
        (DELAY, "D", 0),
        (DELAY, "D", 1),
        ("q = 2\naxiom: A(1,2)\nA(x,y) -> A(y, q*x - y/3) F(0*x + 1)", "A", 0),
        ("q = 2\naxiom: A(1)\nA(x) -> A(x/q) F(q) F\nF(x) -> F(q*q)", "F", 0),
        ("q = 2\naxiom: A(1) B\nA(x) -> A(2) B\nB -> F(q)", "F", 0),
        ("q = 2\naxiom: A(1)\nA(x) -> ε", "A", 0),
        ("q = 2\naxiom: A(1)\nA(x) -> B(x)\ndecomposition:\nB(x) -> A(q*x) F(x)", "F", 0),
    ],
)
def test_a_sum_is_what_the_word_adds_up_to(
    text: str, symbol: str, place: int | None, axis: bool, values: dict[str, Fraction]
) -> None:
    obeyed(read(text), symbol, place, axis, values)


def test_the_rule_is_the_shortest_from_the_first_sum_on() -> None:
    """Of the plane's three sums, F(t) needs two; the sum of odd numbers is a square."""
    q = sympy.Symbol("q", real=True)
    found = affine_sums(read(SHOOT), "F", 0, False, {"q": "q"})
    assert [sympy.expand(found.shown(c)) for c in found.rule] == [q + 1, -q]
    squares = affine_sums(read("axiom: A(1)\nA(x) -> F(x) A(x+2)"), "F", 0, False, {})
    assert (squares.rule, squares.first, squares.at(1_000)) == ((3, -3, 1), (0, 1, 4), 1_000_000)


def test_the_main_axis_of_a_plant_is_a_shoot() -> None:
    plant = affine_sums(read("q = 2\naxiom: A(1)\nA(x) -> F(x) [+A(q*x)] A(q*x)"), "F", 0, True, {"q": "q"})
    assert plant == affine_sums(read(SHOOT), "F", 0, False, {"q": "q"})


@pytest.mark.parametrize(("a", "b"), [(2, 3), (5, 2), (4, 4), (1, 6)])
def test_an_age_that_decides_keeps_its_values(a: int, b: int) -> None:
    model = read(f"axiom: A(1)\nA({a}) -> A(1) B(1)\nB({b}) -> A(1) B(1)\nA(t) -> A(t+1)\nB(t) -> B(t+1)")
    obeyed(model, "A", None, False, {})
    obeyed(model, "B", 0, False, {})


def test_values_that_are_multiplied_by_one_another_may_be_few() -> None:
    """-1 and 1, and what they are computed from, are told apart like values that decide something."""
    obeyed(read("axiom: B(-1)\nB(z) -> A(z) B(-z)\nA(x) -> A(x*x) A(x)"), "A", 0, False, {})


def test_what_cancels_in_a_value_is_no_part_of_it() -> None:
    """The first parameter is 1 for ever, whatever the second one is."""
    found = obeyed(read("axiom: A(1,2)\nA(x,y) -> A(x*x + y - y, y + 1)"), "A", 0, False, {})
    assert (found.rule, found.first) == ((1,), (1,))


def test_numbers_in_place_of_letters_that_show_too_short_a_rule_are_changed() -> None:
    """The values of A obey x^2 = q - u; with q = u + 1 they stay 1, as if x = 1 were enough. A quotient by q - u
    has no value where q = u."""
    unlucky = splitmix64(1_000) % 2**31
    turns = read(f"q = 2\naxiom: A(1) B(1)\nA(x) -> B(x) B(0)\nB(x) -> A((q - {unlucky - 1})*x) A(0)")
    assert len(obeyed(turns, "A", 0, False, Q).rule) == 2
    shrinks = read(f"q = 2\naxiom: A(1)\nA(x) -> A(x/(q - {unlucky}))")
    assert str(affine_sums(shrinks, "A", 0, False, {"q": "q"}).at(1)) == f"1/(q - {unlucky})"


def test_the_mean_where_chance_decides() -> None:
    """Each bud becomes two with probability p, or dies: 2p as many are left in the mean."""
    found = affine_sums(read("p = 1/2\naxiom: A\nA -> A A : p\nA -> ε : 1 - p"), "A", None, False, {"p": "p"})
    assert (len(found.rule), found.first) == (1, (1,))
    assert sympy.expand(found.at(3) - 8 * sympy.Symbol("p", real=True) ** 3) == 0


@pytest.mark.parametrize("id", ["K7", "K8", "ABOP-1.27", pytest.param("ABOP-1.28", marks=pytest.mark.slow)])
def test_the_mean_is_that_of_the_stages(id: str) -> None:
    """The tokens that stage diagrams expect are counted by other code."""
    net = stages(system(id))
    for symbol in symbols(system(id)):
        found = affine_sums(system(id), symbol, None, False, {})
        for n in range(5):
            tokens = zip(net.expected(n), net.places, strict=True)
            mean = sum(amount for amount, place in tokens if place.symbol == symbol)
            assert float(found.at(n)) == pytest.approx(float(mean))


TWO = "p = 1\nq = 1/2\naxiom: A(1,1)\nA(x,y) -> F(x) A(q*x+y,p*y)"


@pytest.mark.parametrize(
    ("text", "unless", "given"),
    [
        (SHOOT, ["q != 1"], [{"q": 1}]),
        (BRANCHES.replace("A(x + 1)", "A(x)"), ["q != 0"], [{"q": 0}]),
        ("q = 2\naxiom: A(1)\nA(x) -> F(x) A(x/q)", ["q != 1", "q != 0"], [{"q": 1}]),
        ("q = 2\naxiom: A(1,1)\nA(x,y) -> F(x) A(y+q*x,x+y)", [], []),  # divided by q^2 - 2q + 5
        (
            "q = 2\naxiom: F(1) A(2)\nF(x) -> A(x)\nA(x) -> F(-x) A((q*q - 3)*x)",
            ["q != 1", "q != -1", "q**2 - 5 != 0"],
            [{"q": 1}, {"q": -1}],
        ),
        ("q = 2\naxiom: A(1)\nA(x) -> ε", [], []),
        (TWO, ["q != 1", "p != 1", "q != p"], [{"q": 1}, {"q": 1, "p": 1}, {"p": 1}, {"q": "p"}, {"q": 0, "p": 0}]),
    ],
)
def test_where_a_formula_divides_by_0_there_are_others(text: str, unless: list[str], given: list[dict[str, Any]]) -> None:
    """Each is at all steps what the sum is there; with few cases asked for, the rest is not said."""
    n = sympy.Symbol("n", integer=True, nonnegative=True)
    found = affine_sums(read(text), "F" if "F" in text else "A", 0, False, {"q": "q"} | ({"p": "p"} if "p" in text else {}))
    first, *others = found.formulas(n)
    assert [f"{each.lhs} != {each.rhs}" for each in first.unless] == unless
    assert [{str(k): str(v) for k, v in case.given.items()} for case in others] == [
        {k: str(v) for k, v in each.items()} for each in given
    ]
    for case in (first, *others):
        there = {each: sympy.Rational(3 + 2 * i, 7) for i, each in enumerate(found.letters) if each not in case.given}
        values = {each: value.subs(there) for each, value in case.given.items()} | there
        for step in range(5):
            wanted = sympy.Integer(0) + found.at(step)
            assert abs((case.formula.subs(values).subs(n, step) - wanted.subs(values)).evalf(30)) < 1e-20
    assert len(found.formulas(n, 1)) == 1


def test_sums_without_letters_and_without_a_formula() -> None:
    squares = affine_sums(read("axiom: A(1)\nA(x) -> F(x) A(x+2)"), "F", 0, False, {})
    assert [str(case.formula) for case in squares.formulas(sympy.Symbol("n"))] == ["n**2"]
    assert [*islice(squares, 5)] == [0, 1, 4, 9, 16]
    turns = affine_sums(read("q = 2\naxiom: A(1)\nA(x) -> B(x)\nB(x) -> C(x)\nC(x) -> A(q*x)"), "A", 0, False, {"q": "q"})
    assert turns.formulas(sympy.Symbol("n")) == []


def test_how_a_sum_changes_with_a_letter_is_a_sum() -> None:
    found = affine_sums(read(SHOOT), "F", 0, False, {"q": "q"})
    (letter,) = found.letters
    assert [sympy.expand(each) for each in islice(found.derivative(letter), 5)] == [
        sympy.expand(sympy.diff(each, letter)) for each in islice(found, 5)
    ]


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("axiom: A(2)\nA(x) -> A(x*x)", "values of A are multiplied by one another, or are put into a function"),
        ("axiom: A(2)\nA(x) -> A(1/(x+1))", "values of A are multiplied by one another, or are put into a function"),
        ("axiom: A(2)\nA(x) : x > 0 -> A(x+1)", r"More than 200 kinds .* The last one was A\(20\d\)"),
        ("axiom: A B(0,5)\nB(x,y) : x >= 0 -> B(x+1,y)\nA -> A", r"More than 200 kinds .* The last one was B\("),
        ("axiom: A\nA -> A : 0\nA -> A A : 0", "probabilities of what becomes of A add up to nothing"),
        ("axiom: A(2) B\nA(x) > B -> A(x)", "depends on its neighbours"),
        ("axiom: A(2)\nA(x) -> A(uniform(0,1))", "random numbers are drawn"),
        ("axiom: A(2)\nA(x) -> A(x*sqrt(2))", "not known exactly"),
        ("q = 2\naxiom: A(2)\nA(x) -> A(x*q^0.5)", r"sqrt\(q\) is no quotient of polynomials"),
        ("q = 2\naxiom: A(2)\nA(x) -> A(x + abs(q))", r"Abs\(q\) is no quotient of polynomials"),
        ("q = 2\naxiom: A(2)\nA(x) -> A(x + 2^q)", r"2\*\*q is no quotient of polynomials"),
        ("axiom: A(2)\nA(x) -> A(x/0)", "no quotient of polynomials"),
    ],
)
def test_where_there_is_no_recurrence_it_is_said_why(text: str, why: str) -> None:
    letters = {"q": "q"} if text.startswith("q") else {}
    with pytest.raises(NotAffine, match=why):
        affine_sums(read(text), "A" if "y" not in text else "B", 0 if "y" not in text else 1, False, letters)


def test_what_a_system_does_not_have_has_no_sum() -> None:
    model = read(SHOOT)
    with pytest.raises(ModelNameError, match='The system has no symbol "f"') as refused:
        affine_sums(model, "f", 0, False, {})
    assert "F" in refused.value.hint
    with pytest.raises(ModelNameError, match='The system has no symbol "G"') as refused:
        affine_sums(model, "G", 0, False, {})
    assert refused.value.hint == "Its symbols are: A F."
    with pytest.raises(ModelNameError, match="No module F has a parameter number 2"):
        affine_sums(model, "F", 1, False, {})
    with pytest.raises(ModelValueError, match="choose a value for d"):
        affine_sums(read("d = 3\naxiom: A(0)\nA(t) : t < d -> A(t+1)"), "A", 0, False, {"d": "d"})
