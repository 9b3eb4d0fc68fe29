"""A step of all modules at once is the step module by module: who stands beside whom, and what becomes of all."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import lsys_kit.derivation.engines.contexts as bulk
from lsys_kit.derivation.core.matching import NO_NEIGHBOUR, Passing, neighbours
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.derive import Derivation, derive
from lsys_kit.derivation.engines.stepping import SteppingEngine
from lsys_kit.derivation.engines.stepwise import Stepper
from lsys_kit.notation.model.system import BRANCHES
from lsys_kit.notation.read import read

ROLES = {"A": bulk.ORDINARY, "B": bulk.ORDINARY, "+": bulk.PASSED, "-": bulk.PASSED, "[": bulk.OPENS, "]": bulk.CLOSES}
words = st.recursive(
    st.text("AB+-", max_size=4),
    lambda inner: st.lists(st.one_of(inner, inner.map("[{}]".format)), max_size=6).map("".join),
    max_leaves=30,
)
SIGNALS = """
ignore: + - F
axiom: F i F i F i
o < o > o -> i
o < o > i -> i [- F i F i]
o < i -> i
i < o > o -> o
i < o > i -> i F i
i < i > o -> i
i < i > i -> o
+ -> -
- -> +"""
GROWING = "axiom: A(0) b\nA(x) > b -> A(x+1) [b] A(x+2)\nA(x) > A(y) : x < 9 -> A(y+1) b\nb < A(x) -> b A(x/2)"
FLAT = "branches: flat\naxiom: B A A\nB > A -> A [B]\nA > B -> B [A] A\nA > A -> [A] B"
CHANCE = "axiom: F F F F F\nF -> F [+ F] F [- F] F : 0.33\nF -> F [+ F] F : 0.33\nF -> ε : 0.1"


@given(words, st.sampled_from(BRANCHES))
def test_neighbours_are_found_at_once(word: str, branches: str) -> None:
    """Of modules that are passed over as well: they may have contexts of their own."""
    places = np.arange(len(word))
    left, right = bulk.context_neighbours(
        places, np.array([ROLES[symbol] for symbol in word], dtype=np.uint8), NO_NEIGHBOUR, branches == "flat"
    )
    found, modules = neighbours(word, Passing("+-", branches)), np.array([symbol not in "[]" for symbol in word], dtype=bool)
    assert left[modules].tolist() == np.array(found.before, dtype=int)[modules].tolist()
    assert right[modules].tolist() == np.array(found.after, dtype=int)[modules].tolist()


@pytest.mark.slow
@pytest.mark.parametrize("table", [bulk.LARGEST_TABLE, 0], ids=["looked up", "sorted"])
@pytest.mark.parametrize(
    ("text", "steps"), [(SIGNALS, 24), (GROWING, 9), (CHANCE, 6), (FLAT, 10)], ids=["signals", "growing", "chance", "flat"]
)
def test_a_step_at_once_is_the_step_one_by_one(monkeypatch, text, steps, table):
    system = read(text)
    one_by_one = list(map(str, Derivation(SteppingEngine(Stepper(States(system), 5), None)).to(steps)))
    monkeypatch.setattr(bulk, "LARGEST_TABLE", table)
    assert [str(word) for word in derive(system, steps, seed=5)] == one_by_one
    assert len(one_by_one[-1]) > 100


def test_in_long_words_right_neighbours_are_found_past_brackets_too():
    system = read(FLAT)
    *_, word = Derivation(SteppingEngine(Stepper(States(system), 0), None)).to(9)
    found = derive(system, 9)
    assert len(found[8]) > bulk.FEW_MODULES
    assert str(found[9]) == str(word)


def test_a_rule_that_is_never_drawn_need_not_have_a_value():
    """The engines agree on it: what a rule makes is computed when chance chooses the rule, and not before."""
    system = read("axiom: A(0)\nA(x) -> A(x) B : 1\nA(x) -> C(1/x) : 0")
    assert str(derive(system, 3)[-1]) == "A(0)B B B"


def test_a_word_that_vanishes_stays_empty():
    assert derive(read("axiom: A B\nA < B -> ε\nA -> ε"), 5).lengths == [2, 0, 0, 0, 0, 0]


def test_weights_are_added_exactly():
    """Ten tenths are one, however they are rounded: both engines draw on the same line."""
    rules = "\n".join(f"A -> B({n}) : 0.1" for n in range(10))
    system = read("axiom:" + " A" * 300 + f"\n{rules}")
    one_by_one = Derivation(SteppingEngine(Stepper(States(system), 1), None)).to(1)
    assert derive(system, 1, seed=1)[-1] == one_by_one[-1]
