"""Letters in place of constants whose numbers are known: formula = number wherever the conditions of the formulas hold."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest
import sympy
from hypothesis import assume, given
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelNameError, ModelValueError, derive, read, system, systems
from lsys_kit.classroom.panel.controls import slider_ranges
from lsys_kit.derivation.core.letters import conditions, numbered
from lsys_kit.derivation.core.traits import traits_of
from lsys_kit.derivation.derive import Derivation
from lsys_kit.notation.model.arithmetic import expression_of
from lsys_kit.notation.model.system import LSystem
from tests.derivation.random_systems import systems as random_systems
from tests.derivation.random_systems import systems_with

LETTERED = [id for id in systems() if slider_ranges(system(id), {}) and not traits_of(system(id)).sensitive]
"""Systems of the catalogue with constants that can be letters."""
SHRINKING = read("q = 0.8\naxiom: A(1)\nA(x) : x > 0.3 -> F(x) A(q*x)")


def put_in(derived: Derivation, values: dict[Any, Any]) -> list[tuple[str, list[Any]]]:
    """The last word of a derivation with numbers put in for its letters."""
    return [(module.symbol, [expression_of(value).subs(values) for value in module.arguments]) for module in derived[-1]]


def rows(derived: Derivation) -> list[tuple[str, list[Any]]]:
    return [(module.symbol, [expression_of(value) for value in module.arguments]) for module in derived[-1]]


def alike(one: Any, other: Any) -> bool:
    return bool(one == other or abs(sympy.N(one - other)) <= 1e-9 * max(1, abs(sympy.N(other))))


def check(found: LSystem, steps: int, change: st.DataObject, letters: list[str]) -> None:
    """The numbers are those of the derivation without letters; where the conditions hold so are the formulas."""
    lettered = derive(found, steps, letters=letters)
    plain, states = derive(found, steps), numbered(lettered.states)
    assert [states.modules[code] for code in lettered[-1].codes] == [*plain[-1]]
    assert lettered.lengths == plain.lengths
    own = dict(zip((constant.name for constant in found.constants), numbered(lettered.states).constants, strict=True))
    factors = [Fraction(1), Fraction(101, 100), Fraction(49, 50), Fraction(7, 6), Fraction(1, 2), Fraction(3)]
    chosen: dict[str, object] = {name: Fraction(own[name]) * change.draw(st.sampled_from(factors)) for name in letters}
    values = {sympy.Symbol(name, real=True): expression_of(value) for name, value in chosen.items()}
    if not all(condition.subs(values) == sympy.true for condition in conditions(lettered.states)):
        return
    there = derive(found, steps, **chosen)
    assert len(there[-1]) == len(lettered[-1])
    for (symbol, numbers), (same, formulas) in zip(rows(there), put_in(lettered, values), strict=True):
        assert symbol == same
        assert all(map(alike, formulas, numbers))


@pytest.mark.slow
@pytest.mark.parametrize("id", LETTERED)
@given(st.data())
def test_formula_and_number_agree_in_the_catalogue_where_the_conditions_hold(id: str, data: st.DataObject) -> None:
    found = system(id)
    check(found, min(found.steps or 4, 4), data, [*slider_ranges(found, {})])


@pytest.mark.slow
@given(random_systems() | systems_with(), st.data())
def test_formula_and_number_agree_where_the_conditions_hold(found: LSystem, data: st.DataObject) -> None:
    names = [constant.name for constant in found.constants]
    assume(names)
    try:
        derive(found, 3)
    except LSystemError:
        return
    check(found, 3, data, names)


def test_the_number_of_a_letter_decides_which_productions_are_applied() -> None:
    found = derive(SHRINKING, 3, letters="q")
    assert [str(word) for word in found] == ["A(1)", "F(1)A(q)", "F(1)F(q)A(q^2)", "F(1)F(q)F(q^2)A(q^3)"]
    assert found.notes == ("The formulas hold where q > √0.3 ≈ 0.5477.",)
    assert [str(module) for module in derive(SHRINKING, 2, letters="q", q="1/4")[-1]] == ["F(1)", "A(q)"]


def test_of_the_conditions_for_one_letter_the_narrowest_are_said() -> None:
    q = sympy.Symbol("q", real=True)
    assert derive(SHRINKING, 9, letters="q").notes[0].startswith("The formulas hold where q > ⁵√0.3 ≈ 0.786, q ≤ ⁶√0.3 ≈ 0.81")
    halving = read("q = 3/4\naxiom: A(q)\nA(x) : x > 1/2 && x >= 1/4 && x != 9 -> A(x - 1/8)")
    assert conditions(derive(halving, 1, letters="q").states) == [q > sympy.Rational(1, 2), sympy.Ne(q, 9)]
    assert derive(halving, 2, letters="q").notes == ("The formulas hold where q > ⅝, q ≠ 9, q ≠ 73/8.",)


@pytest.mark.parametrize(
    ("made", "formula", "held"),
    [
        ("x + 1", "q + 1", ""),
        ("1/x", "1/q", ""),
        ("x^3 - x*x", "q^3 - q^2", ""),
        ("sqrt(x)", "sqrt(q)", ""),
        ("2^x", "2^q", ""),
        ("max(x, 1)", "q", "q ≥ 1"),
        ("abs(1 - x)", "q - 1", "q > 1"),
        ("floor(x)", "2", "q ≥ 2, q < 3"),
        ("ceil(x)", "3", "q > 2, q ≤ 3"),
        ("mod(x, 2)", "q - 2", "q ≥ 2, q < 4"),
        ("if(x > 2, x, 0)", "q", "q > 2"),
        ("sin(60*x)", "sin(pi*q/3)", ""),
        ("x - x + 4", "4", ""),
    ],
)
def test_every_operator_keeps_the_formula_or_says_on_what_it_relied(made: str, formula: str, held: str) -> None:
    found = derive(read(f"q = 5/2\naxiom: A(q)\nA(x) -> B({made})"), 1, letters="q")
    assert str(found[-1]) == f"B({formula})"
    assert found.notes == ((f"The formulas hold where {held}.",) if held else ())


def test_how_often_something_is_repeated_is_decided_by_the_number() -> None:
    found = derive(read("n = 3\naxiom: A(n)\nA(x) -> F(x) A(x - 1)\ninterpretation:\nF(x) -> F"), 1, letters="n")
    assert str(found[-1]) == "F(n)A(n - 1)"
    repeated = derive(system("K11"), 2, letters="branches")
    assert len(repeated[-1]) == len(derive(system("K11"), 2)[-1])
    assert "branches = 5" in repeated.notes[-1]


def test_chance_is_that_of_the_number() -> None:
    sown = read("p = 1/3\naxiom: A(p)\nA(x) -> A(x + p) A(x) : p\nA(x) -> B(x) : 1 - p")
    for seed in range(5):
        plain = derive(sown, 4, seed=seed)
        lettered = derive(sown, 4, seed=seed, letters="p")
        assert [numbered(lettered.states).modules[code] for code in lettered[-1].codes] == [*plain[-1]]


def test_a_root_in_the_model_stays_a_root() -> None:
    found = derive(read("q = 1/2\nr = sqrt(2)\naxiom: A(q)\nA(x) -> F(x*r) A(x)"), 1, letters="q")
    assert str(found[-1]) == "F(sqrt(2)*q)A(q)"
    assert numbered(found.states).modules == [
        *derive(read("q = 1/2\nr = sqrt(2)\naxiom: A(q)\nA(x) -> F(x*r) A(x)"), 1).states.modules
    ]


def test_only_declared_constants_are_letters_and_no_turtle_walks_by_formulas() -> None:
    with pytest.raises(ModelNameError, match='declares no constant "p"'):
        derive(SHRINKING, 1, letters="p")
    with pytest.raises(ModelValueError, match="A letter or a list of letters is needed"):
        derive(SHRINKING, 1, letters=3)  # type: ignore[arg-type]
    with pytest.raises(ModelValueError, match="asks what the turtle sees"):
        derive(system("K24"), 1, letters="L")


def test_an_open_comparison_is_named_with_what_to_declare() -> None:
    with pytest.raises(ModelValueError) as error:
        derive(SHRINKING, 3, q="q")
    assert error.value.hint == (
        "Step 1 is the last that can be reached. It depends on whether x > 0.3: "
        'choose a value for q, or derive with letters="q", where its own value decides.'
    )


@pytest.mark.slow
def test_formulas_have_bounds() -> None:
    logistic = read("r = 3.7\naxiom: A(r/9)\nA(x) -> A(r*x*(1-x))")
    with pytest.raises(LSystemError, match="the formula has more than 100 terms") as error:
        derive(logistic, 30, letters="r")
    assert isinstance(error.value.partial, Derivation)


def test_conditions_of_several_letters_and_of_bounds_that_are_left_out_are_told() -> None:
    both = read("q = 0.8\nr = 0.5\nd = 1\naxiom: A(1)\nA(x) : q*x > r*x -> F(d) A(q*x)")
    assert [*map(str, conditions(derive(both, 1, letters=["q", "r"]).states))] == ["q > r"]
    below = read("q = -1/2\naxiom: A(1)\nA(x) : q*q < 1 -> A(q*x)")
    assert [*map(str, conditions(derive(below, 1, letters="q").states))] == ["q**2 < 1"]
    apart = read("q = 2\naxiom: A(1)\nA(x) : q >= 1 && q != 1 && q <= 3 && q != 3 -> A(x)")
    assert [*map(str, conditions(derive(apart, 1, letters="q").states))] == ["q > 1", "q < 3"]


def test_a_constant_without_a_value_stays_beside_letters_that_have_one() -> None:
    two = read("q = 1/2\nr = 3\naxiom: A(q, r)\nA(x, y) -> A(q*x, y + r)")
    assert str(derive(two, 1, letters="q", r="r")[-1]).replace(" ", "") == "A(q^2,2*r)"
