"""Timed systems: the word at any time."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelLimitError, ModelValueError, derive, limits, read, system
from lsys_kit.derivation.timed import growth_base, timed

ANABAENA = timed(read("axiom: ar(0)\nar(1) -> al(0) br(0)\nal(1) -> bl(0) ar(0)\nbr(1) -> ar(0)\nbl(1) -> al(0)"))
TIMES = st.fractions(0, 4, max_denominator=12)


@pytest.mark.parametrize(("at", "word"), [
    ("1/2", "ar(0.5)"), (1, "ar(1)"), (1.5, "al(0.5)br(0.5)"), (2.5, "bl(0.5)ar(0.5)ar(0.5)"),
    (3.5, "al(0.5)al(0.5)br(0.5)al(0.5)br(0.5)")])
def test_the_words_of_seed_003(at: object, word: str) -> None:
    assert str(ANABAENA.word(at)) == word


def test_at_its_terminal_age_a_cell_is_not_yet_divided() -> None:
    assert len(ANABAENA.word(6)) == 13
    assert {module.arguments for module in ANABAENA.word(6)} == {(1,)}


@given(TIMES, TIMES)
def test_time_passes_in_parts_as_in_one(first: Fraction, second: Fraction) -> None:
    """D(D(x, s), t) = D(x, s + t)."""
    assert ANABAENA.later(list(ANABAENA.word(first)), second) == ANABAENA.word(first + second)


def test_between_divisions_it_is_the_system_of_whole_steps() -> None:
    for step, word in enumerate(derive(system("J1"), 7)):
        assert [module.symbol for module in ANABAENA.word(step + 0.5)] == [module.symbol for module in word]


def test_life_spans_may_differ_and_be_constants() -> None:
    growing = timed(read("short = 1/2\naxiom: a(0)\na(2) -> a(0) b(short/2)\nb(short) -> a(0)"), short=1)
    assert str(growing.word(3)) == "a(1)a(0.5)"


@pytest.mark.parametrize("text", ["A(t) -> B", "A -> B", "A(1) : 1 < 2 -> B(0)", "B < A(1) -> A(0)", "A(1) -> A(0) : 1/2"])
def test_a_production_gives_an_age(text: str) -> None:
    with pytest.raises(ModelValueError):
        timed(read(f"axiom: A(0) B\n{text}"))


def test_no_time_before_the_axiom_and_no_division_without_end() -> None:
    with pytest.raises(ModelValueError, match="before the axiom"):
        ANABAENA.word(-1)
    with pytest.raises(LSystemError, match=r"divides without end|more than"):
        timed(read("axiom: A(0)\nA(1) -> A(1) A(1)")).word(2)
    with limits(modules=100), pytest.raises(ModelLimitError, match="more than 100 modules"):
        ANABAENA.word(20)


def test_growth_that_is_continuous_at_a_division() -> None:
    assert growth_base(1, 0, 0.2) == pytest.approx(2.167303978, abs=1e-9)
    assert growth_base(1, 0, 0) == pytest.approx(2)
    for t_div, t_s, t_l in ((2, 0, 1), (0.5, 0.1, 0.4), (3, 1, 0)):
        base = growth_base(t_div, t_s, t_l)
        assert base**t_div == pytest.approx(base**t_s + base**t_l)
    with pytest.raises(ModelValueError, match="no growth is continuous"):
        growth_base(1, 0, 1)
