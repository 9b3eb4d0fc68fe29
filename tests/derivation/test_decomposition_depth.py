"""How often decomposition is applied to what it makes: until none applies, or so often and no more."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.derivation.derive import derive
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read
from tests.derivation import reference
from tests.derivation.random_systems import CHANCE, DECOMPOSITION, systems_with

HALVED = "axiom: A\nA -> D(8)\ndecomposition:\nD(n) : n > 1 -> D(n/2) D(n/2)"


@pytest.mark.parametrize(
    ("depth", "word"),
    [(0, "D(8)"), (1, "D(4)D(4)"), (2, "D(2)D(2)D(2)D(2)"), (3, "D(1)" * 8), (4, "D(1)" * 8), (None, "D(1)" * 8)],
)
def test_what_lies_deeper_stays_as_it_is(depth: int | None, word: str) -> None:
    system = replace(read(HALVED), decomposition_depth=depth)
    assert str(derive(system, 1)[-1]) == word


def test_the_next_step_decomposes_what_was_left() -> None:
    system = replace(read(HALVED), decomposition_depth=1)
    assert [len(word) for word in derive(system, 4)] == [1, 2, 4, 8, 8]


def test_a_depth_makes_an_end_of_what_has_none() -> None:
    endless = "axiom: A\ndecomposition:\nA -> A B"
    with pytest.raises(ModelValueError, match="Rule A decomposes into itself"):
        read(endless)
    assert str(derive(read(f"decomposition depth: 3\n{endless}"), 2)[-1]) == "A B B B B B B"


def test_without_a_depth_an_end_must_come_of_itself() -> None:
    system = read("axiom: A(0)\ndecomposition:\nA(t) : t >= 0 -> A(t+1)")
    with pytest.raises(ModelLimitError, match=r"A\(0\) is decomposed more than 100 times") as limit:
        derive(system, 1)
    assert (
        limit.value.hint == "Step 0 is the last that can be reached. What is made must come nearer to where the condition ends."
    )


@pytest.mark.parametrize("depth", [100, 101, 500, 25_000])
def test_a_depth_that_the_model_sets_is_kept(depth: int) -> None:
    system = read(f"Lsystem: 1\nAxiom: A(0)\ndecomposition\nmaximum depth: {depth}\nA(t) --> A(t+1)")
    assert str(derive(system, 1)[-1]) == f"A({depth})"
    words = read(f"Lsystem: 1\nAxiom: X({depth})\ndecomposition\nmaximum depth: {depth}\nX(n) : n>0 --> FX(n-1)")
    assert len(derive(words, 1)[-1]) == depth + 1


def test_a_depth_without_end_has_one() -> None:
    system = read("decomposition depth: 1000000000\naxiom: A\ndecomposition:\nA -> A")
    with pytest.raises(ModelLimitError, match="A is decomposed more than 100000 times"):
        derive(system, 1)


@pytest.mark.slow
@given(systems_with(DECOMPOSITION, CHANCE), st.integers(0, 3))
def test_any_depth_is_as_defined(system: LSystem, depth: int) -> None:
    system = replace(system, decomposition_depth=depth)
    for word, expected in zip(derive(system, 3), reference.words(system, 3)[0], strict=True):
        assert [(module.symbol, module.arguments) for module in word] == expected
