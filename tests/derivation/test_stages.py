"""Stage diagrams: places, transitions and tokens of a Petri net that fires everywhere at once (seed 002, figure 2)."""

from __future__ import annotations

from itertools import pairwise

import pytest

from lsys_kit.derivation.derive import derive
from lsys_kit.derivation.stages import stages
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model import Module
from lsys_kit.notation.read import read

FILAMENT = """
a_r(t) : t < {0} -> a_r(t+1)
a_r(t) -> b_l(1) a_r(1)
a_l(t) : t < {0} -> a_l(t+1)
a_l(t) -> a_l(1) b_r(1)
b_r(t) : t < {1} -> b_r(t+1)
b_r(t) -> b_l(1) a_r(1)
b_l(t) : t < {1} -> b_l(t+1)
b_l(t) -> a_l(1) b_r(1)
interpretation:
a_r(t) -> R(2, 1, t)
a_l(t) -> L(2, 1, t)
b_r(t) -> R(1, 1, t)
b_l(t) -> L(1, 1, t)
axiom: a_r(1)"""


def test_places_are_states_and_transitions_are_productions() -> None:
    net = stages(read("axiom: S\nS -> L\nL -> A\nA -> L S S"))
    assert list(map(str, net.places)) == ["S", "L", "A"]
    assert [(t.place, t.production) for t in net.transitions] == [(0, 0), (1, 1), (2, 2)]
    assert repr(net) == "S -> L\nL -> A\nA -> L + 2 S"
    assert [(a.transition, a.place, a.copies, a.positions) for a in net.arcs] == [
        (0, 1, 1, (1,)), (1, 2, 1, (1,)), (2, 1, 1, (1,)), (2, 0, 2, (2, 3))]


def test_a_place_that_nothing_leaves_keeps_its_tokens() -> None:
    net = stages(read("axiom: A\nA -> B C\nB -> ε"))
    assert repr(net) == "A -> B + C\nB -> ε"
    assert net.fired((1, 2, 3)) == (0, 1, 4)


@pytest.mark.parametrize("life_spans", [(3, 2), (2, 5), (1, 1)])
def test_tokens_ignore_order_and_polarity(life_spans: tuple[int, int]) -> None:
    system = read(FILAMENT.format(*life_spans))
    net, both = stages(system), stages(system, polarity=True)
    assert len(net.places) == sum(life_spans)
    assert len(both.places) >= 2 * len(net.places) - 2
    for before, after in pairwise(derive(system, 9)):
        assert net.fired(net.tokens(before)) == net.tokens(after)
        assert both.fired(both.tokens(before)) == both.tokens(after)
        assert sum(net.tokens(after)) == len(after)


def test_cells_that_differ_in_more_than_polarity_have_places_of_their_own() -> None:
    system = read("axiom: A B\nA -> B\nB -> A\ninterpretation:\nA -> R(1,1)\nB -> L(2,1)")
    assert len(stages(system).places) == 2
    assert len(stages(read("axiom: A B\nA -> B\nB -> A\ninterpretation:\nA -> R(1,1)\nB -> L(1,1)")).places) == 1
    assert len(stages(read("axiom: A B\nA -> B\nB -> A\ninterpretation:\nA -> R(1,1)\nB -> F")).places) == 2


def test_positions_that_depend_on_the_polarity_are_not_told() -> None:
    net = stages(read(FILAMENT.format(1, 1)))
    assert {arc.positions for arc in net.arcs} == {()}


def test_states_that_do_not_end_are_grouped_by_symbol() -> None:
    net = stages(read("k = 3\naxiom: A(0)\nA(t) : t < k -> A(t+1)\nA(t) -> A(t+1) A(t) B\nB -> C(1)"))
    assert net.grouped
    assert list(map(str, net.places)) == ["A", "B", "C"]
    assert repr(net) == "A -> A if t < k\nA -> 2 A + B\nB -> C"
    assert net.tokens([Module("A", (7,)), Module("C", (1,)), Module("A", (2,))]) == (2, 0, 1)
    with pytest.raises(ModelValueError, match="grouped by symbol"):
        net.fired((1, 0, 0))


def test_a_diagram_that_nobody_could_read_is_grouped() -> None:
    text = "axiom: A(1)\nA(t) : t < {0} -> A(t+1)\nA(t) -> A(1) A(2)"
    assert not stages(read(text.format(40))).grouped
    assert stages(read(text.format(41))).grouped


def test_states_without_a_successor_are_grouped_too() -> None:
    net = stages(read("axiom: A(3)\nA(t) -> A(t - 1) B(1/t)"))
    assert net.grouped
    assert repr(net) == "A -> A + B"


def test_places_are_parted_as_far_as_their_futures_differ() -> None:
    rules = "\ninterpretation:\nA -> R(1,1)\nB -> L(1,1)\nC -> R(1,1)\nD -> L(1,1)"
    assert [len(stages(read(text + rules)).places) for text in (
        "axiom: A B\nA -> B\nB -> A", "axiom: A\nA -> B\nB -> C\nC -> C D\nD -> D C", "axiom: A\nA -> B\nB -> C\nC -> F",
    )] == [1, 3, 4]


def test_a_module_that_is_not_met_has_no_place() -> None:
    net = stages(read("axiom: A\nA -> A B"))
    assert net.place_of(Module("C")) is None
    assert net.tokens([Module("C"), Module("B")]) == (0, 1)


def test_an_empty_net() -> None:
    from lsys_kit.notation.model import LSystem

    net = stages(LSystem((), ()))
    assert (net.places, net.tokens([]), net.fired(()), repr(net)) == ((), (), (), "")
