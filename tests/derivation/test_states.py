"""The table of states: a module's fate is worked out once."""

from __future__ import annotations

from dataclasses import replace

import pytest

from lsys_kit.derivation.core.interpretation import interpretations, is_filament
from lsys_kit.derivation.core.states import States, closure
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read

AGES = read("k = 2\naxiom: A(k) B\nA(t) : t < 3 -> A(t+1)\nA(3) -> A(1) A(1)\nA(k) -> C\nC ->  ε\nA(t) -> ε")


def test_states_are_numbered_as_they_are_met() -> None:
    states = States(AGES)
    assert states.axiom == (0, 1)
    assert [str(module) for module in states.modules] == ["A(2)", "B"]
    assert (states.successor(0), states.successor(2), states.successor(1)) == ((2,), (3, 3), (1,))
    assert len(states) == 4


def test_the_first_production_that_matches_is_applied() -> None:
    states = States(AGES)
    assert states.production(0) == 0
    assert states.production(1) is None
    assert States(AGES, {"k": 5}).production(0) == 2
    assert States(AGES, {"k": 3}).production(0) == 1
    assert states.production(states.number("A", (9,))) == 4


def test_the_width_of_a_successor_is_known_before_it_is_made() -> None:
    states = States(AGES, {"k": 3})
    assert (states.width(0), states.width(1)) == (2, 1)
    assert len(states) == 2


def test_a_double_is_not_the_number_it_equals() -> None:
    states = States(AGES)
    assert states.number("A", (2,)) == 0
    assert states.number("A", (2.0,)) != 0


def test_the_number_of_parameters_belongs_to_the_symbol() -> None:
    states = States(read("axiom: A A(1) A(1,2)\nA(t) -> B\nA -> C"))
    assert [str(states.modules[states.successor(s)[0]]) for s in states.axiom] == ["C", "B", "A(1,2)"]


def test_a_production_made_by_hand_has_no_place_in_a_text() -> None:
    system = replace(
        AGES, source="", axiom=(Pattern("axiom"),), productions=(Production((Pattern("axiom"),), read("axiom: A(1/0)").axiom),)
    )
    with pytest.raises(ModelValueError) as caught:
        States(system).successor(0)
    assert caught.value.message == "axiom under production 1, axiom -> A(1/0), has no value: division by zero"
    assert caught.value.line is None


def test_a_fault_in_a_condition_names_the_production() -> None:
    states = States(read("axiom: A(0)\nA(t) : t < 0 -> A(1)\nA(t) : 1/t > 0 -> B"))
    with pytest.raises(ModelValueError) as caught:
        states.width(0)
    assert caught.value.message == "A(0) under production 2, A(t) : 1/t > 0 -> B, has no value: division by zero"
    assert (caught.value.line, caught.value.hint) == (3, "A condition before the arrow can keep such values out.")


def test_a_table_that_ends_is_closed() -> None:
    states = States(AGES)
    assert closure(states, 10) == range(4)
    assert closure(states, 3) is None
    assert closure(States(LSystem((), ())), 1) == range(0)


def test_drawing_rules_leave_the_table_alone() -> None:
    states = States(read("axiom: A(2) B\ninterpretation:\nA(t) : t > 1 -> F(t/3)[C]\nA(t) -> F"))
    drawn = interpretations(states, (*states.axiom, *states.axiom))
    assert [" ".join(map(str, image)) for image in drawn.values()] == ["F(2/3) [ C ]", "B"]
    assert len(states) == 2
    assert states.inexact is None


@pytest.mark.parametrize(
    ("rules", "filament"),
    [
        ("", False),
        ("interpretation:\nA -> R(1,1)\nB -> L(1,1,0.5)", True),
        ("interpretation:\nA -> R(1)", False),
        ("interpretation:\nA -> R(1,1) F", False),
        ("interpretation:\nA -> ε", False),
    ],
)
def test_a_filament_is_drawn_as_cells_alone(rules: str, filament: bool) -> None:
    assert is_filament(read(f"axiom: A B\n{rules}")) is filament
