"""Life spans: what a system of steps tells of the times at which its modules end, compared with its derivation."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import LSystemError, derive, lineage, read, stages, system, timed
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.timed.ages import age_model
from lsys_kit.notation.model.system import LSystem
from tests.derivation.timed_nets import fired_in_time

SPANS = range(1, 5)


def check_against_derivation(model: LSystem, steps: int, **constants: object) -> None:
    """The net fired in time, the words at any time, and the derivation agree after each step."""
    growing = timed(model, **constants)
    assert growing.ages.step is not None
    for polarity in (False, True):
        net = stages(model, polarity=polarity, durations=True, **constants)
        for step, word in enumerate(derive(model, steps, **constants)):
            time = step * growing.ages.step
            assert fired_in_time(net, time) == net.tokens(word)
            assert sum(net.tokens(word)) == len(word)
            assert list(growing.word(time)) == list(word)


@pytest.mark.slow
@pytest.mark.parametrize(("first", "second"), list(product(SPANS, SPANS)))
def test_a_token_rests_as_long_as_a_cell_of_j4_lives(first: int, second: int) -> None:
    check_against_derivation(system("J4"), 11, lifeTimeA=first, lifeTimeB=second)
    spans = {
        place.symbol[0]: transition.span
        for transition in stages(system("J4"), durations=True, lifeTimeA=first, lifeTimeB=second).transitions
        for place in [stages(system("J4"), durations=True, lifeTimeA=first, lifeTimeB=second).places[transition.place]]
    }
    assert first == second or spans == {"A": first, "B": second}


@pytest.mark.parametrize("last", [*SPANS, 5, 9])
def test_a_token_rests_as_long_as_a_cell_of_p4_lives(last: int) -> None:
    text = str(system("P4")).replace("t < 5", f"t < {last}").replace("t == 5", f"t == {last}").replace("M(5", f"M({last}")
    if last > 1:  # a daughter of stage 2 would never divide
        check_against_derivation(read(text), 13)


@pytest.mark.slow
def test_the_net_of_p4_has_two_stages_and_the_cell_that_is_about_to_divide() -> None:
    assert (
        repr(stages(system("P4"), durations=True))
        == "M(1,1) -> M(2,1) after 1\nM(2,1) -> M(5,1) after 3\nM(5,1) -> M(2,1) + M(1,1) after 1"
    )
    assert repr(stages(system("J4"), durations=True)) == "Al(1) -> Al(1) + Br(1) after 3\nBr(1) -> Br(1) + Al(1) after 2"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["P5", "P6"])
@given(
    st.sampled_from(SPANS),
    st.fractions(0, "2/5", max_denominator=5),
    st.fractions(0, "2/5", max_denominator=5),
    st.fractions("1/7", "3/5", max_denominator=10),
)
def test_a_token_rests_as_long_as_a_cell_of_p5_lives(name: str, t_div: int, t_s: Fraction, t_l: Fraction, dt: Fraction) -> None:
    check_against_derivation(system(name), 6, t_div=t_div, t_s=t_s, t_l=t_l, dt=dt)


def test_lives_that_are_shorter_than_a_step_are_said_to_end_late() -> None:
    assert stages(system("P5"), durations=True, dt="1.4").besides == (
        "derived in steps of 1.4, lives shorter than that end late",
    )
    assert stages(system("P5"), durations=True).besides == stages(system("P6"), durations=True, dt="1.4").besides == ()


@pytest.mark.parametrize(
    "text",
    [
        "axiom: M(0)\nM(t) : t >= 1/2 -> M(0) M(0)\nM(t) -> M(t+1)",
        "axiom: M(1/4)\nM(t) : t >= 1 -> M(0) N(1/2)\nM(t) -> M(t+1)\nN(t) : t >= 1 -> M(1/2)\nN(t) -> N(t+1)",
        "axiom: M(0)\nM(t) -> M(t+1)\nN(t) -> N(t+1)\ndecomposition:\nM(t) : t >= 1/2 -> M(t-1/2) N(0)\nN(t) : t > 2 -> M(t-2)",
    ],
)
def test_lives_that_are_measured_in_steps_never_end_late(text: str) -> None:
    ages = age_model(States(read(text)))
    modules = [ages.states.modules[state] for state in ages.states.axiom]
    modules += [daughter for module in modules for daughter in ages.daughters(module)]
    assert not ages.even
    assert not any(map(ages.is_late, modules))
    assert stages(read(text), durations=True).besides == ()


@given(st.fractions("1/7", 2, max_denominator=40), st.integers(0, 6))
def test_k27_is_timed_as_it_stands(dt: Fraction, steps: int) -> None:
    printed = timed(read("axiom: ar(0)\nar(1) -> al(0) br(0)\nal(1) -> bl(0) ar(0)\nbr(1) -> ar(0)\nbl(1) -> al(0)"))
    growing = timed(system("K27"), dt=dt)
    word = derive(system("K27"), steps, dt=dt)[-1]
    assert str(growing.word(steps * dt)) == str(printed.word(steps * dt)) == str(word)
    assert lineage(growing, steps * dt).divisions == lineage(printed, steps * dt).divisions


LETTERS = "abc"


@st.composite
def _even_systems(draw: st.DrawFn) -> str:
    """Systems whose daughters take over the time since they were born; no life is shorter than a step."""
    dt, strict, late = draw(st.fractions("1/5", 1, max_denominator=5)), draw(st.sampled_from([">", ">="])), draw(st.booleans())
    productions, decomposition = [], []
    for letter in LETTERS:
        age = draw(st.fractions(2, 4, max_denominator=5))
        made = (
            " ".join(
                f"{other}(t-({age})+{first}{'+dt' if late else ''})"
                for other, first in draw(
                    st.lists(st.tuples(st.sampled_from(LETTERS), st.sampled_from(["0", "1/5", "1"])), max_size=2)
                )
            )
            or "X"
        )
        if late:
            productions.append(f"{letter}(t) : t+dt >= {age} -> {made}")
        else:
            decomposition.append(f"{letter}(t) : t {strict} {age} -> {made}")
        productions.append(f"{letter}(t) -> {letter}(t+dt)")
    text = f"dt = {dt}\naxiom: a(0) b(1/2)\n" + "\n".join(productions)
    return text + ("\ndecomposition:\n" + "\n".join(decomposition) if decomposition else "")


FORMS = (
    "{0}(t) : t < {1} -> {0}(t+{2})|{0}(t) -> {3}",
    "{0}(t) : t >= {1} -> {3}|{0}(t) -> {0}(t+{2})",
    "{0}({1}) -> {3}|{0}(t) -> {0}(t+{2})",
    "{0}(t) -> {0}(t+{2})|>{0}(t) : t > {1} -> {3}",
    "{0}(t) : t < {1} -> {0}(t+{2})",
    "{0}(t) : !(t < {1}) && t < 9 -> {3}|{0}(t) -> {0}(t+{2})",
)
"""What is said of a letter, given an age, a step and a successor; lines with > are decomposition rules."""
MADE = ("a(0)", "b(0)", "c(1)", "a(t)", "b(1)", "c(t-1)", "X", "repeat(2)<X>", "repeat(max(t, 0)) <X>")


@st.composite
def _systems_in_steps(draw: st.DrawFn) -> str:
    """Systems whose modules live whole steps."""
    step = draw(st.sampled_from(["1", "dt"]))
    lines = ["dt = " + str(draw(st.fractions("2/5", 1, max_denominator=5))), "axiom: a(1) b(0) X"]
    decomposition = []
    for letter in LETTERS:
        age, made = draw(st.integers(1, 4)), " ".join(draw(st.lists(st.sampled_from(MADE), max_size=3))) or "ε"
        form = draw(st.sampled_from(FORMS))
        made = made.replace("(t", f"({age}").replace("max(t", "max(1") if form.startswith("{0}({1})") else made
        for line in form.format(letter, age, step, made).split("|"):
            (decomposition if line[0] == ">" else lines).append(line.lstrip(">"))
    lines.append(draw(st.sampled_from(["X -> X", "X -> a(0)", ""])))
    return "\n".join(lines) + ("\ndecomposition:\n" + "\n".join(decomposition) if decomposition else "")


@pytest.mark.slow
@given(_even_systems())
def test_at_the_end_of_a_step_time_has_made_what_the_step_has(text: str) -> None:
    model = read(text)
    growing = timed(model)
    assert growing.ages.even
    for step, word in enumerate(derive(model, 11)):
        assert list(growing.word(step * growing.ages.step)) == list(word), (text, step)


@pytest.mark.slow
@given(_systems_in_steps())
def test_so_it_has_where_lives_last_whole_steps(text: str) -> None:
    model = read(text)
    try:
        growing = timed(model)
        words = [growing.word(step * (growing.ages.step or 1)) for step in range(9)]
        derivation = derive(model, 8)
    except LSystemError:
        return
    for found, word in zip(words, derivation, strict=True):
        assert growing.ages.even or list(found) == list(word)


@pytest.mark.slow
@given(_systems_in_steps())
def test_tokens_of_lives_in_steps_are_those_of_the_words(text: str) -> None:
    model = read(text)
    try:
        net, growing, derivation = stages(model, durations=True), timed(model), derive(model, 8)
    except LSystemError:
        return
    for step, word in enumerate(derivation):  # a condition such as t > 1 does not yet hold at the age of 1, when a token moves
        assert growing.ages.even or fired_in_time(net, step * (growing.ages.step or 1)) == net.tokens(word)
