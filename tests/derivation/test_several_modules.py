"""Strict predecessors of several modules: pseudo-L-systems (Prusinkiewicz, Graphical applications of L-systems, 1986)."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import ModelLimitError, ModelValueError, derive, draw, explain, growth, limits, lineage, read, stages, timed
from lsys_kit.derivation.derive import lengths
from lsys_kit.derivation.engines.engine import Origins
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production

words = st.text("AB", min_size=1, max_size=12)


def letters(word: str) -> tuple[Pattern, ...]:
    return tuple(map(Pattern, word))


def after(axiom: str, *rules: str, settings: str = "") -> str:
    """The word of step 1, glued."""
    word = derive(read("\n".join([settings, f"axiom: {' '.join(axiom)}", *rules])), 1)[1]
    return "".join(module.symbol for module in word)


@given(words, st.lists(st.tuples(st.text("AB", min_size=1, max_size=3), st.text("ABC", max_size=3)), min_size=1, max_size=4))
def test_a_step_is_a_replacement_from_left_to_right_without_overlap(axiom: str, rules: list[tuple[str, str]]) -> None:
    """As the substitution of regular expressions, which tries its alternatives in their order at each place."""
    system = LSystem(letters(axiom), tuple(Production(letters(before), letters(made)) for before, made in rules))
    successors = dict(reversed(rules))
    expected = re.sub("|".join(before for before, _ in rules), lambda match: successors[match[0]], axiom)
    assert "".join(module.symbol for module in derive(system, 1)[1]) == expected


def test_the_dragon_curve_as_a_pseudo_l_system() -> None:
    """ABOP, section 1.4.3: Fl and rF stand for the edges F_l and F_r, and l and r are drawn by nobody."""
    pseudo = read("Lsystem: 1\nAxiom: Fl\nFl --> Fl+rF+\nrF --> -Fl-rF\nendlsystem")
    edges = read("axiom: F_l\nF_l -> F_l + F_r +\nF_r -> - F_l - F_r")
    for mine, theirs in zip(derive(pseudo, 8), derive(edges, 8), strict=True):
        assert "".join(m.symbol for m in mine) == "".join(m.symbol for m in theirs).replace("F_l", "Fl").replace("F_r", "rF")
    assert draw(pseudo, 8).svg == draw(edges, 8).svg


def test_cars_move_on_a_road() -> None:
    """Wolfram's rule 184: each car moves on if the place in front of it is free, all at once."""
    road = "AAOAOOAAOO"
    for _ in range(6):
        expected = "".join(
            "A" if (here == "A" and front == "A") or (here == "O" and behind == "A") else "O"
            for behind, here, front in zip("O" + road, road, road[1:] + "A", strict=False)
        )
        road = after(road, "A O -> O A")
        assert road == expected


def test_a_number_is_halved_while_it_is_even() -> None:
    for n in range(1, 30):
        assert after("A" * n, "A A -> B") == "B" * (n // 2) + "A" * (n % 2)


def test_the_first_production_that_matches_at_a_place_is_applied() -> None:
    assert after("AAB", "A A -> C", "A B -> D") == "CB"
    assert after("AAB", "A B -> D", "A A -> C") == "CB"
    assert after("AAB", "A -> E", "A A -> C") == "EEB"


def test_contexts_are_those_of_the_word_before() -> None:
    """What stands before the first and behind the last module, replaced itself or not."""
    assert after("XABYAB", "X < A B > Y -> C", "X -> Z", "Y -> Z") == "ZCZAB"
    assert after("ABAB", "A B > A -> C", "A B < A B -> D") == "CD"
    assert after("A[X]AB", "A < A B -> C") == "A[X]C"
    assert after("AB[X]Y", "A B > [X] Y -> C") == "C[X]Y"


def test_nothing_is_ignored_between_modules_that_are_replaced_together() -> None:
    assert after("A+BAB", "A B -> C", settings="ignore: +") == "A+BC"
    assert after("A+X+AB+Y", "X < A B > Y -> C", settings="ignore: +") == "A+X+C+Y"


def test_modules_on_different_branches_are_not_replaced_together() -> None:
    assert after("A[B]B[AB]", "A B -> C") == "A[B]B[C]"


def test_what_is_cut_off_is_not_replaced() -> None:
    assert after("A[A%B]B", "A B -> C", "A % -> C", "B -> D") == "A[A]D"


def test_values_of_all_modules_count() -> None:
    system = read(
        "axiom: A(1) B(2) A(3) B(1) A(0) B(0)\nA(x) B(y) : x < y -> C(x+y)\nA(3) B(y) -> C(y)\nA(x) B(x0) -> A(x) A(x0)"
    )
    assert str(derive(system, 1)[1]) == "C(3)C(1)A(0)A(0)"


@pytest.mark.parametrize("seed", range(5))
def test_chance_decides_between_predecessors_of_different_lengths(seed: int) -> None:
    pairs = derive(read("axiom: " + "A B " * 200 + "\nA B -> C : 1\nA -> D : 3"), 1, seed=seed)[1].counts()
    assert pairs["C"] + pairs["D"] == 200
    assert pairs["B"] == pairs["D"]
    assert 25 < pairs["C"] < 75


def test_modules_come_from_the_first_of_those_that_were_replaced() -> None:
    derivation = derive(read("axiom: A A B C\nA B -> D E\nC -> ε"), 2)
    assert derivation.origins(1) == Origins([0, 1, 1], [None, 0, 0], [1, 2, 0, 1])
    assert derivation.ancestors(2) == [0, 1, 1]


EXPLAINED = """1. A becomes A: no production matches
     production 1, A B -> D: replaces A B together, and there is A A
     production 2, A B > A -> E: replaces A B together, and there is A A
2-3. A B become D: production 1, A B -> D
     production 2, A B > A -> E: needs A on its right, and there is C
4. C becomes C: no production matches
     production 3, C C -> ε: replaces C C together, and there is C A
5-6. A B become D: production 1, A B -> D
     production 2, A B > A -> E: needs A on its right, and there is C
7-8. C C become ε: production 3, C C -> ε"""


def test_each_production_is_told_with_all_that_it_replaced() -> None:
    derivation = derive(read("axiom: A A B C A B C C\nA B -> D\nA B > A -> E\nC C -> ε"), 1)
    assert repr(explain(derivation, 1)) == EXPLAINED
    assert [len(outcome.others) for outcome in explain(derivation, 1)] == [0, 1, 0, 1, 1]


@pytest.mark.parametrize("seed", range(8))
def test_what_chance_erased_is_told_with_all_that_it_replaced(seed: int) -> None:
    derivation = derive(read("axiom: A B A B A B\nA B -> ε : 1\nA -> ε : 1"), 1, seed=seed)
    told = explain(derivation, 1)
    assert [1 + len(outcome.others) for outcome in told] == [size for size in derivation.origins(1).sizes if size]
    for outcome in told:
        assert outcome.production == (
            "production 1, A B -> ε : 1"
            if outcome.others
            else "production 2, A -> ε : 1"
            if outcome.module.symbol == "A"
            else "no production is for B"
        )


def test_a_diagram_says_what_it_does_not_show() -> None:
    found = stages(read("axiom: A\nA B -> C\nA -> A B"))
    assert found.besides == ("A B -> C",)
    assert str(found) == "A -> A + B\nbesides: A B -> C"
    assert {place.symbol for place in found.places} == {"A", "B", "C"}


def test_the_share_of_a_production_counts_longer_ones_too() -> None:
    assert "with probability" not in str(stages(read("axiom: A B\nA B -> C : 1\nA -> A B : 1")))


PAIRS = read("axiom: A B\nA B -> B A A\nA(t) -> A(t+1)\ndecomposition:\nA(t) : t > 2 -> A(0)")


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (growth, "Growth is defined for systems that replace each module alone"),
        (timed, "is defined for systems that replace each module alone"),
        (lambda system: lineage(system, 2), "A cell of a lineage has one mother"),
        (lambda system: list(lengths(system, 3)), "that is not derived is defined for systems that replace each module alone"),
        (lambda system: stages(system, durations=True), "How long a module lives cannot be told, since A B -> B A A"),
    ],
)
def test_what_a_pseudo_l_system_has_not_is_refused(ask, message: str) -> None:
    with pytest.raises(ModelValueError, match=message):
        ask(PAIRS)


def test_a_module_that_may_be_replaced_with_one_before_it_has_no_successor_of_its_own() -> None:
    states = derive(read("axiom: A B C\nA B -> C\nB -> A\nC -> A"), 1).states
    for module, alone in (("A", False), ("B", False), ("C", True)):
        assert states.is_d0l(states.number(module)) is alone


def test_a_step_that_would_be_too_large_is_refused() -> None:
    with limits(modules=1_000), pytest.raises(ModelLimitError, match="1,000") as error:
        derive(read("axiom: A A\nA A -> A A A A"), 20)
    assert error.value.partial.lengths == [2**n for n in range(1, 10)]


def test_equal_values_of_different_kinds_are_not_mistaken_for_each_other() -> None:
    word = derive(read("axiom: A B(1) A B(exp(0))\nA B(y) -> C(y)"), 1)[1]
    assert [type(module.arguments[0]) for module in word] == [int, float]


def test_the_first_meta_rule_whose_condition_holds_is_applied() -> None:
    rules = "meta: f(x) f(y) : x > 5 -> f(x+y)\nmeta: f(x) f(y) : x < 5 -> f(y)"
    assert str(derive(read(f"axiom: f(6) f(2)\n{rules}"), 1)[1]) == "f(8)"
    assert str(derive(read(f"axiom: f(1) f(2)\n{rules}"), 1)[1]) == "f(2)"


def test_what_a_meta_rule_makes_comes_from_the_mother_of_the_first_module() -> None:
    joining = read("axiom: g f(1)\nf(x) -> f(x) f(x)\nmeta: f(x) f(y) -> f(x+y)")
    assert derive(joining, 1).origins(1) == Origins([0, 1], [None, 0])


def test_behind_a_rule_with_a_weight_one_without_is_passed_over() -> None:
    """The rules with weights are drawn among themselves; where there are neighbours as well."""
    text = "axiom: B A\nB < A -> C : 0.5\nB < A -> D\nB < A -> E : 0.5"
    assert {str(derive(read(text), 1, seed=seed)[1]) for seed in range(20)} == {"B C", "B E"}
