"""Sliders made from the model."""

from fractions import Fraction

import pytest

from lsys_kit import read, system
from lsys_kit.classroom.panel.controls import control, slider_ranges


def of(text, **changes):
    return slider_ranges(read(f"{text}\naxiom: A(0)\nA(t) : t + c < 9 -> A(t+c)"), changes)


def test_a_declared_range_is_the_sliders():
    span = of("c = 7/10 in 1/10 .. 2 by 1/10")["c"]
    assert (span.low, span.high, span.step) == (Fraction(1, 10), 2, Fraction(1, 10))


def test_a_range_may_depend_on_other_constants():
    assert of("top = 5\nc = 3 in 1 .. 2*top")["c"].high == 10


@pytest.mark.parametrize(("value", "low", "high"),
                         [("3", 1, 6), ("8", 1, 16), ("0.7", 0, Fraction(7, 5)), ("-2", -4, 0), ("0", 0, 1)])
def test_a_constant_without_a_range_gets_one_around_its_value(value, low, high):
    span = of(f"c = {value}")["c"]
    assert (span.low, span.high) == (low, high)
    assert span.nearest(float(span.value)) == span.value


def test_a_constant_that_is_only_told_apart_has_no_slider():
    assert slider_ranges(system("P4"), {}) == {}


def test_every_reading_of_a_slider_is_an_exact_value():
    span = of("c = 7/10 in 1/10 .. 2 by 1/10")["c"]
    for k in range(20):
        assert span.nearest(0.1 + 0.1 * k) == Fraction(1, 10) + k * Fraction(1, 10)


def test_whole_numbers_have_whole_sliders_and_the_box_has_the_name():
    import ipywidgets as widgets

    whole, broken = control("life", of("c = 3 in 1 .. 6")["c"]), control("dt", of("c = 0.5")["c"])
    assert isinstance(whole.slider, widgets.IntSlider)
    assert isinstance(broken.slider, widgets.FloatSlider)
    assert whole.box.description == "life"
    assert whole.value == 3
