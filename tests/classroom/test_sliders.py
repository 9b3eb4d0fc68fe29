"""Sliders that can be hit: where they stop, and what a hand, a key or a number does with them."""

from __future__ import annotations

import itertools
import re
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from playwright.sync_api import Browser, Page, expect

from lsys_kit import explore, read
from lsys_kit.classroom.link import linked
from lsys_kit.classroom.panel.controls import SliderRange, slider_values
from tests.browser.hands import Finger, Mouse, Pointer, control, reach
from tests.classroom.front_end import answers

BESIDE = re.compile("value")
ANGLES = [18, 22.5, 25.7, 30, 36, 45, 60, 72, 90, 108, 120, 137.5, 144]
"""What the slider of the angle stops at, beside the multiples of 5."""
MOUSE, THUMB = 4, 16
"""Pixels: of a mouse between two stops, and of what is dragged."""
RANGES = st.builds(
    lambda low, many, step, own: SliderRange(low + (own % (many + 1)) * step / 2, low, low + many * step, step),
    st.sampled_from([*map(Fraction, (0, 1, -180, "1/10", "3/2"))]),
    st.integers(1, 600),
    st.sampled_from([*map(Fraction, (1, 5, "1/2", "1/10", "1/100"))]),
    st.integers(0, 600),
)


@pytest.fixture(scope="module")
def page(browser: Browser) -> Page:
    return browser.new_page()


def stops(page: Page, numbers: list[float], kept: list[int], most: int, least: int = 1) -> Any:
    code = "return stopsOf(given.numbers, given.kept, given.most, given.least);"
    return answers(page, code, {"numbers": numbers, "kept": kept, "most": most, "least": least}, "stops")


@given(RANGES, st.integers(5, 200))
def test_a_slider_stops_at_its_ends_at_what_matters_and_no_more_often_than_there_is_room(page, span, most):
    values = slider_values(span)
    numbers, own = [*map(float, values)], values.index(span.value)
    found = stops(page, numbers, [own], most)
    assert found == sorted({*found})
    assert {0, own, len(values) - 1} <= {*found}
    assert len(found) <= most
    if len(values) <= most:
        assert found == [*range(len(values))]


def test_stops_are_at_round_values(page):
    tenths = [part / 10 for part in range(1801)]
    found = [tenths[at] for at in stops(page, tenths, [257], 45, 50)]
    assert found == sorted([*range(0, 185, 5), 25.7])
    assert [tenths[at] for at in stops(page, tenths, [], 20, 50)] == [*range(0, 190, 10)]
    assert stops(page, [*range(141)], [10], 40) == [*range(0, 145, 5)]


def test_values_with_other_distances_are_thinned_by_their_number(page):
    assert stops(page, [0.1, 0.12, 0.15, 0.2, 0.3, 0.5, 0.8, 1.3], [3], 6) == [0, 2, 3, 4, 6, 7]


@given(st.lists(st.integers(0, 300), min_size=2, unique=True).map(sorted), st.integers(0, 300))
def test_what_lies_between_two_stops_stands_between_them(page, places, at):
    at = min(max(at, places[0]), places[-1])
    where = answers(page, "return amongStops(given[0], given[1]);", [places, at], "stops")
    below, above = places[int(where)], places[min(int(where) + 1, len(places) - 1)]
    assert below + (where - int(where)) * (above - below) == pytest.approx(at)


@pytest.mark.parametrize(("hand", "width"), [(Mouse, 1440), (Finger, 1440), (Mouse, 400), (Finger, 400)])
def test_each_angle_that_matters_is_hit_without_a_button(explored, hand: type[Pointer], width: int) -> None:
    touch = {"has_touch": True} if hand is Finger else {}
    panel = explored("K5", 4, context={"viewport": {"width": width, "height": 900}, **touch})
    for angle in (*ANGLES, 15, 85, 180, 0):
        assert reach(hand(panel.page), panel.at(".lsys-panel"), "angle", f"{angle:g}") == 0
        expect(panel.at("canvas.lsys-canvas")).to_have_attribute("data-angle", f"{angle:g}")


@pytest.mark.parametrize("id", ["J4", "K5", "K19", "K24", "P8"])
@pytest.mark.parametrize("width", [1440, 700, 400])
def test_numbers_below_a_slider_stand_at_their_values_and_do_not_touch(explored, id: str, width: int) -> None:
    panel = explored(id, context={"viewport": {"width": width, "height": 900}})
    for track in panel.at(".lsys-track:visible").all():
        numbers = track.locator(".lsys-scale > :not(:empty)").all()
        boxes = sorted((each.bounding_box() for each in numbers), key=lambda box: box["x"])
        for box, following in itertools.pairwise(boxes):
            assert box["x"] + box["width"] + 2 <= following["x"]
        for box in boxes:
            assert box["y"] >= track.locator(".lsys-range").bounding_box()["y"] + 20
            assert box["x"] >= panel.at(".lsys-panel").bounding_box()["x"]


def test_a_number_beside_a_slider_is_seen_whole(explored):
    panel = explored(read("turn = 120 in 90 .. 180 by 0.25\naxiom: A\nA -> F+(turn)A"), 3)
    box = panel.at('[data-control="turn"] .lsys-box')
    box.fill("137.25")
    expect(panel.control("turn")).to_have_attribute("aria-valuetext", "137.25")
    assert box.evaluate("(box) => box.scrollWidth <= box.clientWidth")


def test_the_angles_of_a_class_stand_below_their_slider(explored):
    panel = explored("K5", 4, context={"viewport": {"width": 1440, "height": 900}})
    numbers = panel.at('[data-control="angle"] .lsys-scale > :not(:empty)')
    assert {"30", "45", "60", "90", "120"} <= {*numbers.all_inner_texts()}
    bar = panel.control("angle")
    for number in numbers.all():
        box, whole = number.bounding_box(), bar.bounding_box()
        panel.page.mouse.click(box["x"] + box["width"] / 2, whole["y"] + whole["height"] / 2)
        expect(panel.at("canvas.lsys-canvas")).to_have_attribute("data-angle", number.inner_text())


@pytest.mark.parametrize(("hand", "width"), [(Mouse, 1440), (Finger, 400)])
def test_a_number_below_a_slider_is_chosen_by_a_press_on_it(explored, hand: type[Pointer], width: int) -> None:
    touch = {"has_touch": True} if hand is Finger else {}
    panel = explored("K5", 4, context={"viewport": {"width": width, "height": 900}, **touch})
    for number in panel.at('[data-control="angle"] .lsys-scale > :not(:empty)').all():
        hand(panel.page).tap(number)
        expect(panel.at("canvas.lsys-canvas")).to_have_attribute("data-angle", number.inner_text())


@pytest.mark.parametrize("id", ["J4", "K5", "K19", "K24", "P8"])
@pytest.mark.parametrize("width", [1440, 400])
def test_no_slider_has_more_stops_than_a_hand_can_tell_apart(explored, id: str, width: int) -> None:
    panel = explored(id, context={"viewport": {"width": width, "height": 900}})
    for bar in panel.at(".lsys-range:visible").all():
        many, wide = float(bar.get_attribute("max")), bar.bounding_box()["width"]
        assert (wide - THUMB) / many >= MOUSE
        assert wide <= panel.at(".lsys-panel").bounding_box()["width"]


def test_arrow_keys_go_by_degrees_with_shift_by_tenths_and_page_keys_by_stops(explored):
    panel = explored("K5", 4)
    box = panel.page.get_by_label("angle", exact=True)
    keys = (
        ("ArrowRight", "26"),
        ("Shift+ArrowRight", "26.1"),
        ("ArrowLeft", "26"),
        ("PageUp", "30"),
        ("PageDown", "25.7"),
        ("PageDown", "25"),
    )
    for key, value in (
        *keys,
        ("ArrowUp", "26"),
        ("Home", "0"),
        ("ArrowLeft", "0"),
        ("End", "180"),
        ("Shift+ArrowDown", "179.9"),
    ):
        panel.control("angle").press(key)
        expect(box).to_have_value(value)
    for key, value in (("PageDown", "175"), ("ArrowUp", "176"), ("Shift+ArrowDown", "175.9")):
        box.press(key)
        expect(box).to_have_value(value)


def test_with_shift_each_pixel_of_a_movement_is_a_value(explored):
    panel = explored("K5", 4)
    bar, box = panel.control("angle"), panel.page.get_by_label("angle", exact=True)
    seen = bar.bounding_box()
    x, y = seen["x"] + seen["width"] / 2, seen["y"] + seen["height"] / 2
    panel.page.keyboard.down("Shift")
    panel.page.mouse.move(x, y)
    panel.page.mouse.down()
    expect(box).to_have_value("25.7")
    for right, value in ((1, "25.8"), (3, "26"), (-7, "25"), (0, "25.7")):
        panel.page.mouse.move(x + right, y)
        expect(box).to_have_value(value)
    panel.page.mouse.up()
    panel.page.keyboard.up("Shift")
    panel.page.mouse.move(x + 30, y)
    expect(box).to_have_value("25.7")


def test_a_number_between_two_stops_is_typed_and_stays(explored):
    panel = explored("K5", 4)
    box = panel.page.get_by_label("angle", exact=True)
    box.fill("61.3")
    box.press("Enter")
    expect(panel.at("canvas.lsys-canvas")).to_have_attribute("data-angle", "61.3")
    expect(panel.control("angle")).to_have_attribute("aria-valuetext", "61.3")
    panel.control("angle").focus()
    expect(box).to_have_value("61.3")


def test_a_number_is_taken_when_nothing_more_is_typed(explored):
    """What is no such number is refused only at its end."""
    panel = explored("K5", 4)
    box, canvas = panel.page.get_by_label("angle", exact=True), panel.at("canvas.lsys-canvas")
    box.click()
    for typed, angle in (("6", "6"), ("0", "60"), (".", "60"), ("5", "60.5"), ("x", "60.5")):
        panel.page.keyboard.type(typed)
        expect(canvas).to_have_attribute("data-angle", angle)
    expect(box).to_have_value("60.5x")
    expect(panel.at(".lsys-refused").first).to_be_hidden()
    panel.page.keyboard.press("Enter")
    expect(box).to_have_value("60.5")
    expect(panel.page.get_by_text("0 to 180")).to_be_visible()


def test_seeds_go_one_by_one_by_a_die_or_are_typed(explored):
    panel = explored("K7", 3)
    box, message = panel.page.get_by_label("seed", exact=True), panel.at(".lsys-message")
    assert control(panel.at(".lsys-panel"), "seed").locator("input[type=range]").count() == 0
    less, more = (panel.page.get_by_role("button", name=f"seed: the {which}") for which in ("value before", "next value"))
    expect(less).to_be_disabled()
    for button, seed in ((more, "1"), (more, "2"), (less, "1")):
        button.click()
        expect(box).to_have_value(seed)
    panel.page.get_by_role("button", name="another seed").click()
    expect(box).not_to_have_value("1")
    for typed in ("123456", "-3", "5"):
        box.fill(typed)
        box.press("Enter")
        expect(box).to_have_value(typed)
        panel.page.wait_for_function(f"host.get('seed') === {typed}")
    expect(message).to_be_hidden()


def test_a_seed_that_python_sets_is_shown(explored):
    panel = explored("K7", 3, seed=7)
    box = panel.page.get_by_label("seed", exact=True)
    panel.page.evaluate("host.set('seed', 54321)")
    expect(box).to_have_value("54321")


@pytest.mark.parametrize("angle", ANGLES)
def test_an_angle_is_exact_in_a_link(angle):
    panel = explore("K5", 3)
    panel.angle = angle
    expected = {} if angle == 25.7 else {"angle": Fraction(str(angle))}
    assert {**linked(panel.link).settings} == {"step": 3, **expected}
    assert explore(panel.link).angle == angle


def test_values_between_two_stops_have_buttons_and_no_others(explored):
    fine = explored(read("c = 1 in 0 .. 5 by 0.01\nangle: 30\naxiom: F(c)"), 0)
    assert reach(Mouse(fine.page), fine.at(".lsys-panel"), "c", "2.37") <= 5
    expect(control(fine.at(".lsys-panel"), "c").get_by_role("button", name=BESIDE)).to_have_count(2)
    expect(control(explored("J4", 9).at(".lsys-panel"), "lifeTimeA").get_by_role("button", name=BESIDE)).to_have_count(0)


def test_the_first_value_of_a_model_is_a_stop(explored):
    panel = explored("P8", 6)
    own = {name: values[0] for name, values in (("SMALLER", ["0.4614"]), ("gr", ["1.7185"]))}
    for name, value in own.items():
        there = panel.at(".lsys-panel")
        reach(Mouse(panel.page), there, name, "0.5" if name == "SMALLER" else "2")
        assert reach(Mouse(panel.page), there, name, value) == 0
