"""The traits of systems, and the engine that follows from them: no engine derives what it does not serve."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import HealthCheck, given, settings

from lsys_kit import ModelValueError, derive, read, stages
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.traits import Traits, traits_of
from lsys_kit.derivation.derive import ENGINES, serves
from lsys_kit.derivation.engines.columnar import ColumnarSteps
from lsys_kit.derivation.engines.contexts import ContextEngine
from lsys_kit.derivation.engines.counting import CountingEngine
from lsys_kit.derivation.engines.stepwise import Stepper
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production
from tests.derivation.random_systems import systems_with

TRAITS = {
    "axiom: A(0)\nA(t) -> A(t+1) B": Traits(),
    "axiom: A(0)\nA(t) -> A(sin(t)) B": Traits(),
    "axiom: A(0)\nA(t) : sin(t) > 0 -> A(1) B": Traits(),
    "axiom: A B\nA < B -> B A": Traits(context=1),
    "axiom: A B\nA B < B > A -> B A": Traits(context=2),
    "axiom: A B\nB > [A] -> B A": Traits(context=1, branching_context=True),
    "axiom: A\nA -> A B : 0.5\nA -> A : 0.5": Traits(stochastic=True),
    "axiom: A\nA -> A B(uniform(0,1))": Traits(random=True),
    "axiom: A ?P(0,0)\nA -> A": Traits(sensitive=True),
    "axiom: A f f\nmeta: f(x) f(y) -> ?P(0)": Traits(meta=True, sensitive=True),
    "axiom: A f f\nmeta: f f -> %": Traits(meta=True, cut=True),
    "axiom: A\nA -> B % B": Traits(cut=True),
    "axiom: A\nA -> repeat(3) <B>": Traits(repetition=True),
    "axiom: A\nA -> A A\ndecomposition:\nA -> B": Traits(decomposition=True),
    "axiom: A\nA -> A A\ndecomposition:\nA -> B : 1\nA -> C : 1": Traits(decomposition=True, varying_decomposition=True),
}


@pytest.mark.parametrize("text", TRAITS)
def test_the_traits_of_a_system(text: str) -> None:
    assert traits_of(read(text)) == TRAITS[text]


def test_an_unknown_constant_is_a_trait_of_the_states() -> None:
    system = read("dt = 1\naxiom: A(2)\nA(t) -> A(t+dt)")
    assert States(system, {"dt": "dt"}).traits == Traits(unknown=True)
    assert States(system, {"dt": 2}).traits == Traits()


def test_later_engines_serve_whatever_earlier_ones_serve() -> None:
    traits = [most for engine, most in ENGINES.items() if engine is not ColumnarSteps]
    assert all(earlier.within(later) for earlier, later in pairwise(traits))


@pytest.mark.parametrize(
    ("traits", "engine"),
    [
        (Traits(), CountingEngine),
        (Traits(unknown=True), CountingEngine),
        (Traits(context=1, stochastic=True, meta=True), ContextEngine),
        (Traits(context=2), Stepper),
        (Traits(branching_context=True, context=1), Stepper),
        (Traits(meta=True, cut=True), Stepper),
        (Traits(random=True), Stepper),
        (Traits(decomposition=True, varying_decomposition=True), Stepper),
        (Traits(sensitive=True), Stepper),
    ],
)
def test_the_first_engine_that_serves(traits: Traits, engine: type) -> None:
    assert next(engine for engine in ENGINES if serves(engine, traits)) is engine


@pytest.mark.slow
@settings(suppress_health_check=list(HealthCheck), max_examples=60)
@given(systems_with())
def test_what_alone_decides_has_a_successor_and_nothing_else_has(system: LSystem) -> None:
    states = States(system)
    for state in states.axiom:
        if states.is_d0l(state):
            assert states.successor(state) is not None
        else:
            with pytest.raises(ModelValueError, match="does not depend on its symbol and values alone"):
                states.successor(state)


def test_a_system_is_d0l_where_each_module_alone_decides() -> None:
    assert States(read("axiom: A\nA -> A B")).traits.d0l
    for text in ("A < B -> C", "A -> B : 1", "A -> B(uniform(0,1))", "A -> %", "meta: A A -> A", "A -> ?P(0)"):
        assert not States(read(f"axiom: A B\n{text}")).traits.d0l


def test_a_cut_that_a_meta_rule_makes_cuts_long_words_too() -> None:
    system = read("axiom: a" + " f f B [ f f C ] D" * 20 + "\nb < a -> b\nmeta: f f -> %")
    assert [str(word) for word in derive(system, 3)][2:] == ["a", "a"]


def test_a_random_condition_is_decided_anew_for_each_module() -> None:
    heads = Apply("<", (Apply("uniform", (Number(0), Number(1))), Number(Fraction(1, 2))))
    a, b = Pattern("A"), Pattern("B")
    word = derive(LSystem((a,) * 200, (Production((a,), (b,), heads),)), 1)[-1]
    assert 60 < word.counts()["B"] < 140


def test_a_random_weight_is_drawn_for_each_module() -> None:
    a, weight = Pattern("A"), Apply("uniform", (Number(0), Number(1)))
    rules = tuple(Production((a,), (Pattern(made),), probability=p) for made, p in (("B", weight), ("C", Number(1))))
    counts = derive(LSystem((a,) * 400, rules), 1)[-1].counts()
    assert 60 < counts["B"] < 190  # of 400, about 1 - log 2 of them


def test_a_weight_that_is_unknown_is_said_to_be() -> None:
    with pytest.raises(ModelValueError, match="it depends on an unknown constant"):
        derive(read("p = 1\naxiom: A\nA -> A A : p\nA -> B : 1"), 3, p="p")


def test_an_unknown_constant_in_doubles_is_no_column() -> None:
    system = read("dt = 1\naxiom: " + " ".join(f"A({n})" for n in range(60)) + "\nA(t) -> A(t+dt) B(t)")
    assert str(derive(system, 2, arithmetic="float", dt="dt")[-1][0]) == "A(2*dt)"


def test_a_module_may_be_its_own_successor_as_one_record() -> None:
    parameter: Expression = Name("x")
    apex = Pattern("A", (parameter,))
    axiom = tuple(replace(apex, arguments=(Number(n),)) for n in range(60))
    assert len(derive(LSystem(axiom, (Production((apex,), (apex, apex)),)), 2, arithmetic="float")[-1]) == 240


def test_more_cases_than_a_short_number_counts() -> None:
    """The states of three neighbours make a number of 64 bits, which no sign may turn into a double."""
    word = derive(read("axiom: A\nA -> repeat(2000,i) <B(i)>\nB(x) < B(y) : x > y -> C"), 2)[-1]
    assert len(word) == 2000
    descending = read("axiom: A\nA -> repeat(2000,i) <B(2000-i)>\nB(x) < B(y) : x > y -> C")
    assert derive(descending, 2)[-1].counts() == {"B": 1, "C": 1999}


def test_a_meta_rule_that_cuts_is_told_beside_a_diagram() -> None:
    assert "% cuts off the rest of its branch" in stages(read("axiom: A\nA -> f f\nmeta: f f -> %")).besides
