"""A step of all modules at once is the step module by module: who stands beside whom, and what becomes of all."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import lsys_kit.derivation.engines.contexts as bulk
import lsys_kit.derivation.engines.stepping as stepping
from lsys_kit.derivation.core.matching import NO_NEIGHBOUR, neighbours
from lsys_kit.derivation.derive import derive
from lsys_kit.notation.read import read

ROLES = {"A": bulk.ORDINARY, "B": bulk.ORDINARY, "+": bulk.PASSED, "-": bulk.PASSED, "[": bulk.OPENS, "]": bulk.CLOSES}
words = st.recursive(st.text("AB+-", max_size=4), lambda inner: st.lists(
    st.one_of(inner, inner.map("[{}]".format)), max_size=6).map("".join), max_leaves=30)
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
CHANCE = "axiom: F F F F F\nF -> F [+ F] F [- F] F : 0.33\nF -> F [+ F] F : 0.33\nF -> ε : 0.1"


@given(words)
def test_neighbours_are_found_at_once(word: str) -> None:
    """Of modules that are passed over as well: they may have contexts of their own."""
    places = np.arange(len(word))
    left, right = bulk.context_neighbours(places, np.array([ROLES[symbol] for symbol in word], dtype=np.uint8), NO_NEIGHBOUR)
    found, modules = neighbours(word, "+-"), np.array([symbol not in "[]" for symbol in word], dtype=bool)
    assert left[modules].tolist() == np.array(found.before, dtype=int)[modules].tolist()
    assert right[modules].tolist() == np.array(found.after, dtype=int)[modules].tolist()


@pytest.mark.parametrize("table", [bulk.LARGEST_TABLE, 0], ids=["looked up", "sorted"])
@pytest.mark.parametrize(("text", "steps"), [(SIGNALS, 24), (GROWING, 9), (CHANCE, 6)], ids=["signals", "growing", "chance"])
def test_a_step_at_once_is_the_step_one_by_one(monkeypatch, text, steps, table):
    system = read(text)
    monkeypatch.setattr(stepping, "BULK", 10**9)
    one_by_one = [str(word) for word in derive(system, steps, seed=5)]
    monkeypatch.setattr(stepping, "BULK", 0)
    monkeypatch.setattr(bulk, "LARGEST_TABLE", table)
    assert [str(word) for word in derive(system, steps, seed=5)] == one_by_one
    assert len(one_by_one[-1]) > 100
