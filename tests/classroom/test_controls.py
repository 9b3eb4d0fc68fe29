"""Sliders made from the model."""

from fractions import Fraction

import pytest

from lsys_kit import book_systems, read, system, systems
from lsys_kit.classroom.panel.controls import MOST_VALUES, slider_ranges, slider_values
from lsys_kit.notation.model.arithmetic import number_text


def of(text, **changes):
    return slider_ranges(read(f"{text}\naxiom: A(0)\nA(t) : t + c < 9 -> A(t+c)"), changes)


def test_a_declared_range_is_the_sliders():
    span = of("c = 7/10 in 1/10 .. 2 by 1/10")["c"]
    assert (span.low, span.high, span.step) == (Fraction(1, 10), 2, Fraction(1, 10))


def test_a_range_may_depend_on_other_constants():
    assert of("top = 5\nc = 3 in 1 .. 2*top")["c"].high == 10


@pytest.mark.parametrize(
    ("value", "low", "high"), [("3", 1, 6), ("8", 1, 16), ("0.7", 0, Fraction(7, 5)), ("-2", -4, 0), ("0", 0, 1)]
)
def test_a_constant_without_a_range_gets_one_around_its_value(value, low, high):
    span = of(f"c = {value}")["c"]
    assert (span.low, span.high) == (low, high)
    assert span.value in slider_values(span)


def test_a_constant_that_is_only_told_apart_has_no_slider():
    assert {*slider_ranges(system("P4"), {})} == {"lifeTime"}


@pytest.mark.parametrize("value", ["(1 + sqrt(5))/2", "2*top", "top", "-top", "exp(1)"])
def test_a_constant_that_is_derived_has_no_slider_unless_it_declares_a_range(value):
    assert "c" not in of(f"top = 2\nc = {value}")
    assert "c" in of(f"top = 2\nc = {value} in -9 .. 9")


@pytest.mark.parametrize("id", ["J4", "J5", "P3", "P4", "K27"])
def test_each_life_span_has_a_slider(id):
    spans = {name for name in slider_ranges(system(id), {}) if name.startswith("lifeTime")}
    assert spans == ({"lifeTime"} if id in ("P3", "P4") else {"lifeTimeA", "lifeTimeB"})


@pytest.mark.parametrize("id", [*systems(), *book_systems()])
def test_the_values_of_a_slider_are_short(id):
    for span in slider_ranges(system(id), {}).values():
        assert all(len(number_text(value)) <= 10 for value in slider_values(span))


def test_a_slider_moves_through_exact_values():
    assert slider_values(of("c = 7/10 in 1/10 .. 2 by 1/10")["c"]) == tuple(Fraction(k, 10) for k in range(1, 21))


def test_the_first_value_is_offered_though_it_lies_between_others():
    assert slider_values(of("c = 0.25 in 0 .. 1 by 1/2")["c"]) == (0, Fraction(1, 4), Fraction(1, 2), 1)


def test_a_very_fine_range_is_offered_in_coarser_steps():
    values = slider_values(of("c = 0.5 in 0 .. 1 by 1/100000")["c"])
    assert MOST_VALUES / 2 < len(values) <= MOST_VALUES + 2
    assert (values[0], values[-1]) == (0, 1)
