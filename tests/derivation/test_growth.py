"""Growth: lengths from the table of states, the rule that they obey, the factor of the long run."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.budget import limits
from lsys_kit.derivation.growth import Growth, growth
from lsys_kit.derivation.sequences import shortest_recurrence
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.read import read

ANABAENA = read("axiom: ar\nar -> al br\nal -> bl ar\nbr -> ar\nbl -> al")
LIFE_SPANS = ("lifeTimeA = {}\nlifeTimeB = {}\naxiom: A(1)\nA(lifeTimeA) -> A(1) B(1)\nB(lifeTimeB) -> A(1) B(1)\n"
              "A(t) -> A(t+1)\nB(t) -> B(t+1)")


def obeys(found: Growth) -> None:
    lengths, rule = found.lengths(30), found.recurrence
    for step in range(len(rule), 31):
        assert lengths[step] == sum(c * lengths[step - k] for k, c in enumerate(rule, 1))


def test_anabaena_grows_as_fibonacci_s_numbers() -> None:
    found = growth(ANABAENA)
    assert found.lengths(7) == [1, 2, 3, 5, 8, 13, 21, 34]
    assert found.recurrence == (1, 1)
    assert found.rate == pytest.approx((1 + 5**0.5) / 2)
    assert [str(state) for state in found.states] == ["ar", "al", "br", "bl"]
    assert found.counts(2) == (2, 0, 0, 1)


@pytest.mark.parametrize(("a", "b"), [(3, 2), (2, 5), (1, 1), (4, 4), (1, 3)])
def test_with_life_spans_a_and_b_the_filament_obeys_its_law(a: int, b: int) -> None:
    """N(t) = N(t - lifeTimeA) + N(t - lifeTimeB) (systems J4 and J5)."""
    found = growth(read(LIFE_SPANS.format(a, b)))
    lengths = found.lengths(40)
    assert all(lengths[t] == lengths[t - a] + lengths[t - b] for t in range(a + b, 41))
    assert found.rate**-a + found.rate**-b == pytest.approx(1)
    obeys(found)


def test_what_erases_itself_has_no_growth() -> None:
    found = growth(read("axiom: A\nA -> ε"))
    assert (found.lengths(3), found.recurrence, found.rate) == ([1, 0, 0, 0], (), 0.0)
    assert repr(found) == "1 states; lengths 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, ...; N(t) = 0; growth per step 0.0000"


@pytest.mark.parametrize(("text", "rule"), [
    ("axiom: A", "N(t) = N(t-1)"), ("axiom: A\nA -> A B", "N(t) = 2 N(t-1) - N(t-2)"),
    ("axiom: F\nF -> FFF", "N(t) = 3 N(t-1)"),
    ("axiom: A B\nA -> B\nB -> A A", "N(t) = 2 N(t-2)"), ("axiom: A\nA -> B\nB -> A C", "N(t) = N(t-1) + N(t-2) - N(t-3)"),
    ("axiom: A\nA -> A B\nB -> B C", "N(t) = 3 N(t-1) - 3 N(t-2) + N(t-3)"),
])
def test_the_rule_is_told(text: str, rule: str) -> None:
    found = growth(read(text))
    assert rule in repr(found)
    obeys(found)


def test_states_that_do_not_end_have_no_matrix() -> None:
    with pytest.raises(ModelLimitError) as caught:
        growth(read("axiom: A(0)\nA(t) : t >= 0 -> A(t+1)"))
    assert caught.value.message == "The states of this system do not end: more than 1,000 were met"
    assert caught.value.hint == ("The last one was A(1000); a parameter that grows for ever, and on which a condition "
                                 "depends, has no growth matrix.")
    with limits(states=3), pytest.raises(ModelLimitError, match="more than 3 were met"):
        growth(ANABAENA)


@given(st.lists(st.integers(-3, 3), min_size=1, max_size=4), st.lists(st.integers(-5, 5), min_size=4, max_size=4))
def test_the_shortest_recurrence_is_one(rule: list[int], start: list[int]) -> None:
    terms = start[:len(rule)]
    while len(terms) < 4 * len(rule) + 2:
        terms.append(sum(c * terms[-k] for k, c in enumerate(rule, 1)))
    found = shortest_recurrence(terms)
    assert len(found) <= len(rule)
    for i in range(max(len(found), len(rule)), len(terms)):
        assert terms[i] == sum(c * terms[i - k] for k, c in enumerate(found, 1))


def test_nothing_obeys_no_rule() -> None:
    assert shortest_recurrence([0, 0, 0]) == []
