"""A step, production by production; and where modules come from, over many steps."""

from __future__ import annotations

import pytest

from lsys_kit import ModelValueError, derive, read
from lsys_kit.derivation.explain import explain

TEXT = """
limit = 3
ignore: +
axiom: A(1) + B [A(3)] C(1,2) A(5)
A(t) : t < limit -> A(t+1)
A(3) -> ε
B < C(x,y) -> D(x+y)
C(x) -> D(x)
A(t) > Z -> Y
"""


def test_each_module_is_told_what_it_became_and_why_not_something_else() -> None:
    told = repr(explain(derive(read(TEXT), 1), 1))
    assert "1. A(1) becomes A(2): production 1, A(t) : t < limit -> A(t+1)" in told
    assert "production 2, A(3) -> ε: asks for 3, and there is 1" in told
    assert "2. + becomes +: no production is for +" in told
    assert "5. A(3) becomes ε: production 2, A(3) -> ε" in told
    assert "production 1, A(t) : t < limit -> A(t+1): t < limit is false where limit = 3, t = 3" in told
    assert "7. C(1,2) becomes D(3): production 3, B < C(x,y) -> D(x+y)" in told
    assert "production 4, C(x) -> D(x): is for C with 1 parameters, not 2" in told
    assert "8. A(5) becomes A(5): no production matches" in told
    assert "production 5, A(t) > Z -> Y: needs Z on its right, and there is nothing" in told


@pytest.mark.parametrize(
    ("notation", "text", "told"),
    [
        (
            "grogra",
            "* # L*0.5 k(5),\n(t<6)  k(t) # RU45 k(t+1)",
            "2. k(5) becomes RU45 k(6): production 2, (t<6) k(t) # RU45 k(t+1)",
        ),
        (
            "mathematica",
            "LSystem[AXIOM[a[1], b], LRULES[LRule[LEFT[], PRED[a[i_ /; i < 3]], RIGHT[b], SUCC[a[i+1]]]]]",
            "1. a[1] becomes a[2]: production 1, LRule[LEFT[], PRED[a[i_ /; i < 3]], RIGHT[b], SUCC[a[i+1]]]",
        ),
        ("cpfg", "Axiom: A(1)\nA(t) : t<3 --> A(t+1)", "1. A(1) becomes A(2): production 1, A(t) : t<3 --> A(t+1)"),
    ],
)
def test_a_step_is_told_in_the_words_of_the_model(notation: str, text: str, told: str) -> None:
    step = 2 if notation == "grogra" else 1
    assert told in repr(explain(derive(read(text, notation), step), step))


def test_an_equal_system_that_was_written_otherwise_is_told_as_it_was_written() -> None:
    for text in ("axiom: A(1)\nA(t) : t<3 -> A(t+1)", "axiom: A(1)\n\n/* grows */  A(t) : t < 3 -> A(t + 1)"):
        told = repr(explain(derive(read(text), 1), 1))
        assert told.endswith(text.splitlines()[-1].rpartition("  ")[2])


def test_a_lot_and_a_cut_are_told() -> None:
    told = repr(explain(derive(read("axiom: A % B\nA -> A A : 1/2\nA -> C : 1/2"), 1, seed=1), 1))
    assert "matches too, but was not drawn" in told
    assert "3. B becomes ε: it is cut off" in told


def test_an_earlier_production_wins() -> None:
    told = repr(explain(derive(read("axiom: A\nA -> B\nA -> C"), 1), 1))
    assert "production 2, A -> C: matches too, but production 1 stands before it" in told


@pytest.mark.parametrize("rules", ["A -> B A\nB -> A", "A < B -> A B\nA -> A B", "A -> B A : 1/2\nA -> A A : 1/2\nB -> ε"])
def test_ancestors_go_back_step_by_step(rules: str) -> None:
    derivation = derive(read(f"axiom: A B A\n{rules}"), 5, seed=2)
    one_by_one = list(range(len(derivation[5])))
    for step in range(5, 0, -1):
        one_by_one = [derivation.origins(step).parents[at] for at in one_by_one]
    assert derivation.ancestors(5) == one_by_one
    assert derivation.ancestors(4, 4) == list(range(len(derivation[4])))


@pytest.mark.parametrize("step", [0, 3])
def test_only_later_words_come_from_a_word(step: int) -> None:
    with pytest.raises(ModelValueError):
        derive(read("axiom: A"), 2).origins(step)
    with pytest.raises(ModelValueError):
        derive(read("axiom: A"), 2).ancestors(1, 2)


def test_a_left_context_that_is_not_there_is_named() -> None:
    told = str(explain(derive(read("axiom: B A\nC < A -> C"), 1), 1))
    assert "production 1, C < A -> C: needs C on its left, and there is B" in told


def test_a_condition_without_values_is_told() -> None:
    assert repr(explain(derive(read("axiom: A\nA : 1 > 2 -> B"), 1), 1)).count("1 > 2 is false") == 1
