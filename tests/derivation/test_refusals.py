"""What cannot be computed is refused: the error says which module, which production, and why."""

from __future__ import annotations

import dataclasses
import math

import pytest

from lsys_kit.budget import limits
from lsys_kit.derivation.core import rules
from lsys_kit.derivation.core.chance import Chance, choose
from lsys_kit.derivation.core.interpretation import interpretation_of, interpretations
from lsys_kit.derivation.core.rules import ModuleTemplate, real_from
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read

REFUSED = [
    ("A -> repeat(1/2) <B>", "it is repeated 0.5 times, which is no whole number from 0 on"),
    ("A -> repeat(1 - 2) <B>", "it is repeated -1 times, which is no whole number from 0 on"),
    ("A -> repeat(100000 + 1) <B>", "it is repeated 100,001 times; the limit is 100,000"),
    ("A -> B(normal(0, -1))", "a standard deviation is not negative"),
    ("A -> B(binomial(1/2, 1/2))", "trials are counted: a whole number from 0 to 100,000"),
    ("A -> B(binomial(100001, 1/2))", "trials are counted: a whole number from 0 to 100,000"),
    ("A -> B(binomial(2, 3/2))", "a probability is from 0 to 1"),
    ("A -> B(poisson(501))", "the mean of a Poisson distribution is from 0 to 500 here"),
    ("A -> B(poisson(-1))", "the mean of a Poisson distribution is from 0 to 500 here"),
    ("A -> B(table(0, 0))", "probabilities are not negative, and one of them is greater than 0"),
    ("A -> B : 1 - 2\nA -> C : 2", "probabilities are not negative, and one of them is greater than 0"),
    ("A -> B : 0\nA -> C : 0", "probabilities are not negative, and one of them is greater than 0"),
    ("A -> B : 1/0\nA -> C : 1", "division by zero"),
    ("A -> B : exp(1000)\nA -> C : 1", "the result is too large"),
]
"""Productions of A that cannot be applied, and why not."""


@pytest.mark.parametrize(("productions", "why"), REFUSED)
@pytest.mark.parametrize("more", ["", "decomposition:\nX -> B : 1\nX -> C : 1"], ids=["alone", "with a decomposition"])
def test_what_cannot_be_computed_is_refused(productions: str, why: str, more: str) -> None:
    with pytest.raises(ModelValueError) as caught:
        derive(read(f"axiom: A\n{productions}\n{more}"), 1)
    assert why in caught.value.message
    assert caught.value.line == 2


@pytest.mark.parametrize("weights", ["k", "k + 1"])
def test_a_choice_between_unknown_probabilities_is_refused(weights: str) -> None:
    with pytest.raises(ModelValueError, match="unknown constant"):
        derive(read(f"k = 1\naxiom: A\nA -> B : {weights}\nA -> C : 1"), 1, k="k")


def test_a_constant_that_depends_on_an_unknown_one_is_refused() -> None:
    with pytest.raises(ModelValueError, match='The constant "c" has no value: it depends on an unknown constant'):
        derive(read("k = 1\nc = floor(k)\naxiom: A(c)"), 0, k="k")


def test_an_angle_must_be_known() -> None:
    with pytest.raises(ModelValueError, match="\"angle\" must be a number that is known and not too large, not 'angle'"):
        real_from("angle", "angle")
    with pytest.raises(ModelValueError, match="not one of thousands of digits"):
        real_from(10**5_000, "angle")


@pytest.mark.parametrize("given", ["x", "2*x", "angle"])
def test_what_is_no_number_is_refused_with_the_hint_of_who_asks(given: str) -> None:
    with pytest.raises(ModelValueError, match='"angle" must be a number') as refusal:
        real_from(given, "angle", "An angle is in degrees.")
    assert refusal.value.hint == "An angle is in degrees."


def test_what_is_unknown_makes_no_whole_number() -> None:
    with pytest.raises(ModelValueError, match="unknown constant"):
        derive(read("k = 1\naxiom: A\nA -> repeat(k) <B>"), 1, k="k")


def test_a_fault_of_the_kit_is_not_put_down_to_the_model(monkeypatch: pytest.MonkeyPatch) -> None:
    """A `TypeError` speaks of unknown constants only where there are some."""

    def broken(*_: object) -> object:
        raise TypeError("a fault of the kit")

    states = States(read("axiom: A\nA -> B"))
    rule = dataclasses.replace(states.rules["A", 0][0], successor=(ModuleTemplate("B", (broken,)),))
    with pytest.raises(TypeError, match="a fault of the kit"):
        states.applied_states(rule, Module("A"))
    monkeypatch.setattr(rules, "function_of", lambda *_: broken)
    with pytest.raises(TypeError, match="a fault of the kit"):
        States(read("k = 1\naxiom: A"))


def test_one_module_makes_no_more_than_a_word_holds() -> None:
    with limits(modules=50):
        with pytest.raises(ModelLimitError, match="A becomes more than 50 modules in one step") as caught:
            derive(read("axiom: A B\nA -> repeat(51) <B>"), 1)
        assert caught.value.line == 2
        with pytest.raises(ModelLimitError, match="A is decomposed into more than 50 modules"):
            derive(read("axiom: A\nA -> A\ndecomposition:\nA -> repeat(26) <C>\nC -> B B"), 1)
        with pytest.raises(ModelLimitError, match="A is decomposed into more than 50 modules"):
            derive(read("axiom: A\nA -> A\ndecomposition:\nA -> repeat(26) <C>\nC -> B B : 1\nC -> C : 0"), 1)


def test_one_module_is_drawn_as_no_more_than_the_limit() -> None:
    states = States(read("axiom: A\ninterpretation:\nA -> repeat(20) <F F>"))
    assert len(interpretation_of(states, Module("A"))) == 40
    with limits(interpretation=39), pytest.raises(ModelLimitError, match="A is drawn as more than 39 modules"):
        interpretation_of(states, Module("A"))


def test_a_choice_that_rounding_leaves_open_falls_on_the_last_that_can_happen() -> None:
    assert choose((1, 2, 0), 1.0) == 1
    assert choose((1, 0), math.nextafter(1, 0)) == 0


def test_rare_events_are_counted() -> None:
    draws = [Chance(1, 0, position).poisson(3) for position in range(2_000)]
    assert min(draws) == 0
    assert math.isclose(sum(draws) / len(draws), 3, rel_tol=0.05)
    assert Chance(1, 0, 0).poisson(0) == 0


def test_brackets_without_partners_open_and_close_nothing() -> None:
    system = LSystem(
        tuple(map(Pattern, "A]B[C")),
        tuple(
            Production((Pattern(letter),), (Pattern("X"),), left=tuple(map(Pattern, left)), right=tuple(map(Pattern, right)))
            for letter, left, right in (("B", "A", ""), ("C", "B", ""), ("A", "", "[D]"))
        ),
    )
    assert str(derive(system, 1)[1]) == "A]X[X"
    assert str(derive(dataclasses.replace(system, axiom=tuple(map(Pattern, "A[D"))), 1)[1]) == "X[D"
    assert str(derive(dataclasses.replace(system, axiom=tuple(map(Pattern, "A[E"))), 1)[1]) == "A[E"


def test_different_modules_are_drawn_as_no_more_than_a_word_may_have() -> None:
    states = States(read("axiom: A(1)A(2)A(1)\ninterpretation:\nA(t) -> repeat(20) <F>"))
    with limits(modules=40):
        assert sum(map(len, interpretations(states, states.axiom).values())) == 40
    with limits(modules=39), pytest.raises(ModelLimitError, match="drawn as more than 39 different ones"):
        interpretations(states, states.axiom)


def test_what_the_modules_of_a_successor_are_decomposed_into_adds_up() -> None:
    doubling = read("axiom: A\nA -> B B\ndecomposition:\nB -> repeat(30) <C>")
    with limits(modules=60):
        assert len(derive(doubling, 1)[1]) == 60
    with limits(modules=59), pytest.raises(ModelLimitError, match="A becomes more than 59 modules in one step") as caught:
        derive(doubling, 1)
    assert caught.value.line == 2


@pytest.mark.parametrize("seed", [1.5, True, "1"])
def test_a_seed_is_a_whole_number(seed: object) -> None:
    with pytest.raises(ModelValueError, match="The seed must be a whole number, not "):
        derive(read("axiom: A"), 1, seed=seed)  # type: ignore[arg-type]


def test_neighbours_decide_which_rule_rewrites_a_state() -> None:
    states = States(read("axiom: A B\nA < B -> C"))
    with pytest.raises(ModelValueError, match="What becomes of B does not depend on its symbol and values alone"):
        states.rule(1)
