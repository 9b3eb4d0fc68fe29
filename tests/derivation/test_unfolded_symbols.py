"""Stage diagrams in which some symbols are unfolded are finer than the grouped net, and their tokens are the words' counts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import derive
from lsys_kit.classroom.catalogue import system as catalogued
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.petri.stages import Stages, stages
from lsys_kit.derivation.timed.timed import timed
from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.read import read

ENDLESS = """
k = 4
axiom: A(0,1) C(1)
A(t,x) : t < k -> A(t+1,2*x)
A(t,x) -> A(0,x) B(k-2) C(t)
B(t) : t < 5 -> B(t+1) repeat(2) <D>
B(t) -> C(1)
C(x) : x < 9 -> C(x+1) B(1)
C(x) -> C(x+1)"""
"""Its modules C have states without end, and A would have if its second parameter decided anything."""


def grouped(net: Stages) -> Counter[tuple[object, ...]]:
    """The transitions of a net grouped by symbol, each with its symbols before and behind it."""
    found: Counter[tuple[object, ...]] = Counter()
    for number, transition in enumerate(net.transitions):
        made: Counter[str] = Counter()
        for arc in net.arcs:
            if arc.transition == number:
                made[net.places[arc.place].symbol] += arc.copies
        found[net.places[transition.place].symbol, transition.production, transition.at_once, frozenset(made.items())] += 1
    return found


@given(st.sets(st.sampled_from("ABD")))
def test_grouped_again_it_is_the_grouped_net(symbols: set[str]) -> None:
    net, whole = stages(read(ENDLESS), unfold=symbols), stages(read(ENDLESS), unfold=[])
    assert {place.symbol for place in net.places} == {place.symbol for place in whole.places}
    assert set(grouped(net)) == set(grouped(whole))
    assert {place.symbol for place in net.places if place.modules} == symbols
    assert len({*map(str, net.places)}) == len(net.places)


@given(st.sets(st.sampled_from("ABD")))
def test_a_production_moves_tokens_along_one_transition(symbols: set[str]) -> None:
    net = stages(read(ENDLESS), unfold=symbols)
    for before, after in pairwise(derive(read(ENDLESS), 12)):
        moved: Counter[int | None] = Counter()
        for module, production in zip(before, produced(before.states, before), strict=True):
            [*ways] = (
                number
                for number, way in enumerate(net.transitions)
                if way.place == net.place_of(module) and way.production == production
            )
            assert len(ways) == (production is not None)
            moved += Counter(
                {arc.place: arc.copies for arc in net.arcs if arc.transition in ways} if ways else {net.place_of(module): 1}
            )
        assert tuple(moved[place] for place in range(len(net.places))) == net.tokens(after)
        assert sum(net.tokens(after)) == len(after)


def produced(states: States, word: object) -> Iterator[int | None]:
    """The production that rewrites each module of a word."""
    return (states.production(states.number(module.symbol, module.arguments)) for module in word)  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("name", "symbols"), [("K19", "A"), ("K19", "AI"), ("K14", "AB"), ("P4", "M"), ("K8", "*"), ("J4", ())]
)
def test_systems_of_the_catalogue(name: str, symbols: tuple[str, ...]) -> None:
    system = catalogued(name)
    net, whole = stages(system, unfold=[*symbols]), stages(system, unfold=[])
    assert set(grouped(net)) <= set(grouped(whole)), "productions that are never applied are not there"
    word = derive(system, 4, seed=1)[-1]
    assert sum(net.tokens(word)) == len(word)
    assert net.tokens(derive(system, 0)[0]) == net.start


def test_where_no_other_symbol_s_values_matter_the_tokens_can_be_moved() -> None:
    system = read("axiom: A(1) C(0)\nA(t) : t < 50 -> A(t+1)\nA(t) -> A(1) A(2) C(t)\nC(x) -> C(x+1)")
    net = stages(system, unfold="A")
    assert not net.grouped
    assert [place.symbol for place in net.places] == ["A"] * 50 + ["C"]
    for before, after in pairwise(derive(system, 60)):
        assert net.fired(net.tokens(before)) == net.tokens(after)
    assert stages(read(ENDLESS), unfold="A").grouped


def test_a_parameter_that_decides_nothing_is_left_out() -> None:
    net = stages(read("axiom: A(0,1)\nA(t,x) : t < 2 -> A(t+1,2*x) L(x) L(2*x)\nA(t,x) -> A(0,x)\nL(x) -> L(x+1)"), unfold="A")
    assert repr(net) == "A(0) -> A(1) + 2 L\nA(1) -> A(2) + 2 L\nA(2) -> A(0)\nL -> L"
    assert [arc.positions for arc in net.arcs] == [(1,), (2, 3), (1,), (2, 3), (1,), (1,)]
    assert net.tokens([Module("A", (2, 4)), Module("L", (7,)), Module("B")]) == (0, 0, 1, 1)


def test_chance_that_hangs_on_a_value_is_that_of_each_stage() -> None:
    net = stages(read("axiom: A(1)\nA(t) : t < 3 -> A(t+1) C(0) : t\nA(t) : t < 3 -> C(1) : 2\nC(x) -> C(x+1)"), unfold="A")
    assert repr(net) == (
        "A(1) -> A(2) + C with probability 1/3\nA(1) -> C with probability 2/3\n"
        "A(2) -> A(3) + C with probability 0.5\nA(2) -> C with probability 0.5\nC -> C"
    )


def test_neighbours_may_decide_what_becomes_of_the_others() -> None:
    net = stages(read("axiom: A S(0)\nA > S -> A\nA -> S(0)\nS(t) : t < 2 -> S(t+1)"), unfold=("S",))
    assert repr(net) == "A -> A if A > S\nA -> S(0)\nS(0) -> S(1)\nS(1) -> S(2)"
    net = stages(read("axiom: A B S(0)\nA B -> A\nS(t) : t < 1 -> S(t+1)"), unfold="S")
    assert repr(net) == "S(0) -> S(1)\nbesides: A B -> A"
    assert net.grouped


def test_decomposition_of_the_others_takes_no_time() -> None:
    net = stages(
        read("axiom: A(0)\nA(t) -> A(t+1)\nB(t) : t < 2 -> B(t+1)\ndecomposition:\nA(t) : t > 3 -> A(0) B(1)"), unfold="B"
    )
    assert repr(net) == "A -> A\nB(1) -> B(2)\nA -> A + B(1) at once if t > 3"
    with pytest.raises(ModelValueError, match="The stages of A cannot be unfolded"):
        stages(net.system, unfold="A")


@pytest.mark.parametrize(
    ("text", "symbol", "hint"),
    [
        ("axiom: A B\nA > B -> B", "A", "neighbours"),
        ("axiom: A\nA -> A(uniform(0,1))", "A", "random numbers"),
        ("axiom: A B\nA B -> B", "B", "neighbours"),
        ("axiom: A(1)\nA(t) : t > 0 -> A(t+1)", "A", "more than 400"),
        ("axiom: A(1)\nA(t) : t < 401 -> A(t+1)\nA(t) -> A(1)", "A", "more than 400"),
        ("axiom: A(0)\nA(t) -> B(t)\nB(t) : t < 4 -> B(t+1)", "B", "unfold A, too"),
        ("axiom: A\nA -> A B(uniform(0,1))\nB(t) : t < 1/2 -> B(t)", "B", "unfold A, too"),
        ("axiom: A\nA > A -> repeat(3, i) <B(i)>\nB(t) : t > 0 -> B(t-1)", "B", "unfold A, too"),
        ("axiom: A\nA > A -> B(1/0)\nB(t) : t > 0 -> B(t-1)", "B", "unfold A, too"),
    ],
)
def test_stages_that_cannot_be_told(text: str, symbol: str, hint: str) -> None:
    with pytest.raises(ModelValueError, match=f"The stages of {symbol} cannot be unfolded") as caught:
        stages(read(text), unfold=symbol)
    assert hint in str(caught.value.hint)


def test_symbols_that_there_are_not() -> None:
    system = read("axiom: stem(1)\nstem(t) -> stem(t+1)\nleaf -> stem(1)")
    with pytest.raises(ModelNameError, match='There is no symbol "sten" here') as caught:
        stages(system, unfold=["stem", "sten"])
    assert caught.value.hint == 'Did you mean "stem"?'
    with pytest.raises(ModelNameError, match='There is no symbol "leaf" here') as caught:
        stages(system, unfold="leaf")
    assert caught.value.hint == "Symbols are: stem."
    for odd in (7, [7], None):
        with pytest.raises(ModelValueError, match="is needed"):
            stages(system, unfold=odd)  # type: ignore[arg-type]
    with pytest.raises(ModelValueError, match="never grouped by symbol"):
        stages(timed(read("axiom: a(0)\na(1) -> a(0)")), unfold="a")
