"""Growth: lengths from the table of states, the rule that they obey, the factor of the long run."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import islice
from typing import Any

import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import derive, system
from lsys_kit.budget import Task, limits
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.growth.growth import Growth, counts_of_steps, growth, leading_weights
from lsys_kit.derivation.growth.recurrences import closed_form, shortest_recurrence, shortest_rule
from lsys_kit.derivation.timed.continuity import growth_base
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.read import read

ANABAENA = read("axiom: ar\nar -> al br\nal -> bl ar\nbr -> ar\nbl -> al")
LIFE_SPANS = (
    "lifeTimeA = {}\nlifeTimeB = {}\naxiom: A(1)\nA(lifeTimeA) -> A(1) B(1)\nB(lifeTimeB) -> A(1) B(1)\n"
    "A(t) -> A(t+1)\nB(t) -> B(t+1)"
)


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


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("axiom: A", "N(t) = N(t-1)"),
        ("axiom: A\nA -> A B", "N(t) = 2 N(t-1) - N(t-2)"),
        ("axiom: F\nF -> FFF", "N(t) = 3 N(t-1)"),
        ("axiom: A B\nA -> B\nB -> A A", "N(t) = 2 N(t-2)"),
        ("axiom: A\nA -> B\nB -> A C", "N(t) = N(t-1) + N(t-2) - N(t-3)"),
        ("axiom: A\nA -> A B\nB -> B C", "N(t) = 3 N(t-1) - 3 N(t-2) + N(t-3)"),
    ],
)
def test_the_rule_is_told(text: str, rule: str) -> None:
    found = growth(read(text))
    assert rule in repr(found)
    obeys(found)


def test_states_that_do_not_end_have_no_matrix() -> None:
    with pytest.raises(ModelLimitError) as caught:
        growth(read("axiom: A(0)\nA(t) : t >= 0 -> A(t+1)"))
    assert caught.value.message == ("The system reaches too many distinct modules for a finite growth matrix: more than 1,000")
    assert caught.value.hint == (
        "The last one was A(1000); where a condition depends on a parameter that grows for ever, there is no growth matrix."
    )
    with limits(states=3), pytest.raises(ModelLimitError, match="more than 3"):
        growth(ANABAENA)


@given(st.lists(st.integers(-3, 3), min_size=1, max_size=4), st.lists(st.integers(-5, 5), min_size=4, max_size=4))
def test_the_shortest_recurrence_is_one(rule: list[int], start: list[int]) -> None:
    terms = start[: len(rule)]
    while len(terms) < 4 * len(rule) + 2:
        terms.append(sum(c * terms[-k] for k, c in enumerate(rule, 1)))
    found = shortest_recurrence(terms)
    assert len(found) <= len(rule)
    for i in range(max(len(found), len(rule)), len(terms)):
        assert terms[i] == sum(c * terms[i - k] for k, c in enumerate(found, 1))


def test_nothing_obeys_no_rule() -> None:
    assert shortest_recurrence([0, 0, 0]) == []


# The systems of the seeds


@pytest.mark.parametrize(
    ("id", "rule", "rate"),
    [
        ("J4", (0, 1, 1), 1.3247),
        ("J5", (0, 1, 0, 0, 1), 1.2365),
        ("P2", (0, 0, 0, 1, 1), 1.1673),
        ("K19", (1, 0, 0, 1, -1, 0, 0, 1, -1), 1.1278),
    ],
)
def test_the_growth_of_a_seed_s_system(id: str, rule: tuple[int, ...], rate: float) -> None:
    found = growth(system(id))
    assert found.recurrence == rule
    assert found.rate == pytest.approx(rate, abs=5e-5)


@pytest.mark.parametrize("id", ["J4", "J5", "P2"])
def test_the_counts_are_those_of_the_words(id: str) -> None:
    found = growth(system(id))
    for step, word in enumerate(derive(system(id), 30)):
        counted = {module: number for module, number in zip(found.states, found.counts(step), strict=True) if number}
        assert counted == Counter(word)
        assert found.length(step) == len(word)


@pytest.mark.parametrize("id", ["J4", "J5", "P2", "K19"])
def test_each_symbol_occurs_as_often_as_in_the_words(id: str) -> None:
    found, words = growth(system(id)), derive(system(id), 30)
    for symbol in words[30].counts():
        assert found.counts_of(symbol, 30) == [word.counts().get(symbol, 0) for word in words]


@pytest.mark.parametrize(("id", "step"), [("J4", 45), ("J5", 60), ("P2", 80), ("K19", 75)])
def test_the_length_of_a_late_step_is_that_of_its_word(id: str, step: int) -> None:
    assert growth(system(id)).length(step) == len(derive(system(id), step)[-1]) > 100_000


def test_the_cells_of_j4_are_padovan_s_numbers() -> None:
    """Seed 000, figure 2: N(t) = N(t-2) + N(t-3)."""
    assert growth(system("J4")).lengths(9) == [1, 1, 1, 2, 2, 3, 4, 5, 7, 9]
    assert growth(system("J5")).lengths(8) == [1, 1, 2, 2, 3, 3, 4, 5, 6]


@pytest.mark.parametrize(("id", "a", "b"), [("J4", 3, 2), ("J5", 2, 5), ("J4", 6, 1), ("J5", 4, 4)])
def test_life_spans_decide_the_growth(id: str, a: int, b: int) -> None:
    """1 = x^-lifeTimeA + x^-lifeTimeB (seed 000)."""
    found = growth(system(id), lifeTimeA=a, lifeTimeB=b)
    assert found.rate**-a + found.rate**-b == pytest.approx(1)
    lengths = found.lengths(60)
    assert all(lengths[t] == lengths[t - a] + lengths[t - b] for t in range(max(a, b), 61))


def test_five_stages_grow_as_the_cells_of_l_system_7() -> None:
    """A step of L-system 2 is a fifth of a cell's life: x^5 = x + 1, and x^5 is the base a = 2.1673 (seed 002, section 8)."""
    found = growth(system("P2"))
    x = sympy.Symbol("x")
    assert found.polynomial.as_expr() == x**5 - x - 1
    assert found.rate**5 == pytest.approx(growth_base(1, 0, 0.2), abs=1e-12)


def test_every_four_steps_lychnis_opens_fibonacci_less_one_flowers() -> None:
    """Seed 003: 1 flower from step 1, 2 from 5, 4 from 9."""
    flowers = growth(system("K19")).counts_of("K", 100)
    assert flowers[0] == 0
    assert flowers[1:25:4] == [1, 2, 4, 7, 12, 20]
    assert all(flowers[n] == flowers[n + 1 - (n % 4 or 4)] for n in range(1, 101))
    assert all(flowers[n] == flowers[n - 4] + flowers[n - 8] + 1 for n in range(9, 101))
    assert flowers[:31] == [word.counts().get("K", 0) for word in derive(system("K19"), 30)]


def test_the_rule_of_lychnis_flowers() -> None:
    """x^8 = x^4 + 1, and 1 more in each generation: the golden ratio in four steps."""
    found = growth(system("K19"))
    rule, flowers = found.recurrence_of("K"), found.counts_of("K", 60)
    assert all(flowers[n] == sum(c * flowers[n - k] for k, c in enumerate(rule, 1)) for n in range(len(rule) + 1, 61))
    x = sympy.Symbol("x")
    characteristic = sympy.Poly([1, *(-c for c in rule)], x)
    assert characteristic == sympy.Poly((x - 1) * (x**8 - x**4 - 1), x)
    assert found.rate**4 == pytest.approx((1 + 5**0.5) / 2)


@pytest.mark.slow
@pytest.mark.parametrize("id", ["J1", "J4", "J5", "T2", "P2", "P4", "P5", "P9w", "K2", "K5", "K11", "K19", "K27", "L1"])
def test_a_closed_form_gives_every_length(id: str) -> None:
    found = growth(system(id))
    assert found.closed_form is not None
    written_out = found.closed_form.replace(
        lambda part: isinstance(part, sympy.RootSum),
        lambda part: sympy.Add(*(part.fun(root) for root in part.poly.nroots(n=60, maxsteps=500))),
    )
    for step in (*range(9), 15, 30, 100):
        length = found.length(step)
        assert abs(written_out.evalf(40, subs={"t": step}) - length) < sympy.Float("1e-30") * length


def test_numbers_of_millions_of_digits_are_refused() -> None:
    """2^(10^7) has 10^7 log 2 digits."""
    doubling = growth(read("axiom: a\na -> a a"))
    assert doubling.length(1_000) == 2**1_000
    with pytest.raises(ModelLimitError, match="would have about 3,010,300 digits"):
        doubling.length(10**7)


@pytest.mark.parametrize("step", [-1, 1.0, True])
def test_a_step_is_a_whole_number_from_0_on(step: object) -> None:
    for ask in (growth(ANABAENA).length, growth(ANABAENA).lengths, growth(ANABAENA).counts):
        with pytest.raises(ModelValueError, match="The step must be a whole number from 0 on"):
            ask(step)  # type: ignore[operator]


def test_a_sequence_may_have_a_rule_in_fractions() -> None:
    assert shortest_rule([4, 2, 1]) == (Fraction(1, 2),)
    assert shortest_rule([1, 3, 9]) == (3,)


def test_what_dies_out_has_no_shares_in_the_long_run() -> None:
    dying = growth(read("axiom: a\na -> b b\nb -> ε"))
    assert dying.lengths(3) == [1, 2, 0, 0]
    assert dying.rate == 0
    assert leading_weights((0, 0), 1) is None
    assert dying.frequencies is None


def test_shares_in_the_long_run_are_those_of_the_fastest_factor_of_the_growth() -> None:
    """Here of t -> 2^t, beside a line in t."""
    found = growth(read("axiom: a\na -> a a b\nb -> b c\nc -> c")).frequencies
    assert found == pytest.approx((1 / 3, 1 / 3, 1 / 3))


def test_multiple_roots_of_the_third_degree_are_in_no_closed_form() -> None:
    """Each symbol of Padovan's sequence makes one of a second such sequence, too: (x^3 - x - 1)^2."""
    twofold = growth(read("axiom: p\np -> q x\nq -> r\nr -> p q\nx -> y\ny -> z\nz -> x y"))
    assert twofold.recurrence == (0, 2, 2, -1, -2, -1)
    assert twofold.closed_form is None
    assert growth(read("axiom: p\np -> q\nq -> r\nr -> p q")).closed_form is not None


def test_counting_step_after_step_ends_with_its_budget() -> None:
    states = States(ANABAENA)
    assert len(list(islice(counts_of_steps(states), 3))) == 3
    with limits(seconds=1e-9), pytest.raises(ModelLimitError), Task("The counts were not found"):
        list(islice(counts_of_steps(states), 3))


P, Q, T = sympy.symbols("p q t")


@pytest.mark.parametrize(
    ("rule", "first"),
    [
        ((P, Q), (0, 1)),  # two roots of degree two
        ((2 * P, Q - P * P), (1, P)),
        ((2 * P, -P * P), (1, Q)),  # a root that is a double one
        ((0, 0, Q), (1, 2, 3)),  # of degree three
        ((P, 0, 0), (1, 2, P)),  # the first terms stand apart
    ],
)
def test_a_closed_form_has_letters_in_roots_of_degree_two_and_less(rule: tuple[Any, ...], first: tuple[Any, ...]) -> None:
    rule, terms = tuple(sympy.Integer(0) + c for c in rule), [*first]
    found = closed_form(rule, first)
    if len(rule) == 3 and rule[-1]:
        assert found is None
        return
    while len(terms) < 7:
        terms.append(sum(c * terms[-k] for k, c in enumerate(rule, 1)))
    for step, term in enumerate(terms):
        difference = (found.subs(T, step) - term).subs({P: sympy.Rational(2, 3), Q: 5})
        assert abs(difference.evalf(30)) < 1e-20, step


def test_a_closed_form_sums_over_roots_of_the_third_degree() -> None:
    """Each of the numbers 1, 1, 2, 4, 7, 13 is the sum of the three before; two terms before them obey no rule."""
    found = closed_form((1, 1, 1, 0, 0), (5, 9, 1, 1, 2))
    assert found.has(sympy.RootSum)
    assert found.has(sympy.KroneckerDelta)
    written_out = found.replace(
        lambda part: isinstance(part, sympy.RootSum),
        lambda part: sympy.Add(*(part.fun(root) for root in part.poly.nroots(n=40))),
    )
    for step, term in enumerate((5, 9, 1, 1, 2, 4, 7, 13, 24, 44)):
        assert abs(written_out.subs(T, step).evalf(30) - term) < 1e-20
