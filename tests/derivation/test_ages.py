"""Ages in systems of steps: what the rules tell of the length of a life, and what they leave open."""

from __future__ import annotations

from dataclasses import replace

import pytest

from lsys_kit import ModelLimitError, ModelValueError, derive, limits, lineage, read, stages, timed
from lsys_kit.derivation.timed import lineage as lineages
from lsys_kit.notation.model.expressions import Apply, Name, Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import Production

TOLD = [
    ("axiom: M(0)\nM(t) -> M(t+1)\nN(t) -> N(t+1)\ndecomposition:\nM(t) : t >= 3 -> N(t-3) N(t-2)", "N(2)N(3)"),
    ("axiom: A(0) X\nA(t) -> A(t+1)\nX -> Y\nY -> A(0)", "A(5)A(3)"),
    ("axiom: A(0) X\nA(t) : t < 2 -> A(t+1)\nA(t) -> X\nX -> X", "X X"),
    ("axiom: A(0)\nA(t) : t > 3 && t - t < 1 -> B(t-3)\nA(t) -> A(t+1)\nB(t) -> B(t+1)", "B(1)"),
]
"""Systems with modules that live for ever, have no age, or are asked for what is the same at all ages; the word of step 5."""


@pytest.mark.parametrize(("text", "word"), TOLD)
def test_at_whole_steps_the_word_in_time_is_the_word_of_the_step(text: str, word: str) -> None:
    growing, derivation = timed(read(text)), derive(read(text), 5)
    assert growing.word(5) == derivation[5]
    assert str(growing.word(5)) == word


NO_AGE = "does not say from which age on it applies"
UNTOLD = [
    ("A(t) : sin(t) > 1/2 -> B(t-1)\nA(t) -> A(t+1)", NO_AGE),
    ("A(t) : t*t > 4 -> B\nA(t) -> A(t+1)", NO_AGE),
    ("A(t) : 1/t > 4 -> B\nA(t) -> A(t+1)", NO_AGE),
    ("A(t) : 1 < 2 -> B\nA(t) -> A(t+1)", "says nothing of an age from which on it applies"),
    ("A(t) : t > log(0-1) -> B\nA(t) -> A(t+1)", "is not a number"),
]
"""Productions of A from which no length of its life follows, and why not."""


@pytest.mark.parametrize(("productions", "why"), UNTOLD)
def test_the_production_that_leaves_a_life_open_is_named(productions: str, why: str) -> None:
    with pytest.raises(ModelValueError, match=why) as caught:
        timed(read(f"axiom: A(0)\n{productions}"))
    assert (caught.value.line, caught.value.column) == (2, 1)


def test_a_value_that_is_calculated_from_the_age_leaves_a_life_open() -> None:
    """No text says that, but records may: A(t,2t) is for modules whose second value is twice their age."""
    doubled = replace(
        read("axiom: A(0,4)\nA(t,x) -> A(t+1,x)"),
        productions=(
            Production((Pattern("A", (Name("t"), Apply("*", (Number(2), Name("t"))))),), (Pattern("B"),)),
            *read("axiom: A(0,4)\nA(t,x) -> A(t+1,x)").productions,
        ),
    )
    assert str(derive(doubled, 3)[3]) == "B"
    with pytest.raises(ModelValueError, match=NO_AGE):
        timed(doubled)


def test_a_negative_constant_lets_no_time_pass() -> None:
    text = "c = {}\naxiom: A(0,5)\nA(t,u) : t > 2 -> B\nA(t,u) -> A(t+c,u)"
    assert str(timed(read(text.format(1))).word(3)) == "A(3,5)"
    with pytest.raises(ModelValueError, match="does not say at which age it applies"):
        timed(read(text.format(-1)))


@pytest.mark.parametrize(
    "text",
    [
        "c = 1\naxiom: A(0)\nA(t) : t > c -> B\nA(t) -> A(t+1)",
        "c = 1\naxiom: A(0)\nA(c) -> B(0)\nA(2) -> B(0)",
        "c = 1\naxiom: A(0)\nA(c*c) -> B(0)",
    ],
)
def test_an_age_that_depends_on_an_unknown_constant_is_not_decided(text: str) -> None:
    with pytest.raises(ModelValueError, match=r"The age at which .* cannot be decided") as caught:
        timed(read(text), c="c").word(3)
    assert caught.value.hint == "It depends on c: choose a value for c."


def test_a_rule_has_applied_since_the_first_of_the_ages_that_it_names() -> None:
    """From 1 on one half of the condition holds; that from 3 on the other does, too, changes nothing."""
    tree = lineage(read("dt = 5\naxiom: M(0)\nM(t) -> M(t+dt)\ndecomposition:\nM(t) : t >= 1 || t >= 3 -> N N"), 1)
    assert tree.divisions == (1,)


def test_divisions_without_end_have_no_stages() -> None:
    with pytest.raises(ModelValueError, match=r"a\(1\) divides endlessly within one instant"):
        stages(timed(read("axiom: a(0)\na(1) -> a(1)")))


def test_a_decomposition_too_deep_for_a_lineage_is_refused() -> None:
    deep = read("axiom: A(0)\nA(t) -> A(t+1)\ndecomposition:\nA(t) : t >= 1 -> B(300)\nB(t) : t > 0 -> B(t-1)")
    with limits(decomposition=400):
        assert len(derive(deep, 1)[1]) == 1
        with pytest.raises(ModelLimitError, match="is decomposed into too many modules for a lineage"):
            lineage(deep, 1)


def test_cells_that_have_died_count_in_a_lineage(monkeypatch: pytest.MonkeyPatch) -> None:
    dying = timed(read("axiom: A(0)\nA(1) -> A(0) B(0) B(0)\nB(1/2) -> ε"))
    assert len(dying.word("9/2")) == 3
    assert len(lineage(dying, "9/2").cells) == 13
    monkeypatch.setattr(lineages, "MOST_CELLS", 12)
    with pytest.raises(ModelLimitError, match="A lineage may have 12 cells"):
        lineage(dying, "9/2")


def test_the_living_cells_of_a_lineage_are_counted_first(monkeypatch: pytest.MonkeyPatch) -> None:
    doubling = timed(read("axiom: A(0)\nA(1) -> A(0) A(0)"))
    monkeypatch.setattr(lineages, "MOST_CELLS", 7)
    assert len(lineage(doubling, 3).cells) == 7
    with pytest.raises(ModelLimitError, match="A lineage may have 7 cells") as caught:
        lineage(doubling, 4)
    assert caught.value.needed == 8


def test_what_comes_and_goes_within_steps_is_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    passing = read("axiom: A\nA -> A X X\nX -> ε")
    assert len(lineage(passing, 3).states) == 2
    monkeypatch.setattr(lineages, "MOST_FOLLOWED", 10)
    with pytest.raises(ModelLimitError, match="More than 10 modules come and go"):
        lineage(passing, 3)


def test_modules_without_an_age_have_stages_too() -> None:
    net = stages(read("axiom: A(0) X\nA(t) -> A(t+1)\nX -> Y\nY -> A(0)"), durations=True)
    assert repr(net) == "X -> Y after 1\nY -> A(0) after 1"
    assert net.tokens(derive(net.system, 2)[2]) == (2, 0, 0)
