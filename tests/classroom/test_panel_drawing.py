"""The drawing of the panel: turned, brought nearer and moved by keyboard, by mouse and by finger, in the browser alone."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from lsys_kit import draw, read, system
from tests.classroom.panel_page import PanelPage


@pytest.fixture
def opened(explored):
    """Opens a panel that asks the kernel for nothing."""
    pages = []

    def open_one(*what, **more):
        pages.append(explored(*what, **more))
        return pages[-1]

    yield open_one
    for each in pages:
        assert set(each.asked) <= {"save"}


def canvas_of(panel: PanelPage) -> Locator:
    return panel.at("canvas.lsys-canvas")


def expect_view(canvas: Locator, around: int, above: int) -> None:
    expect(canvas).to_have_attribute("data-around", str(around))
    expect(canvas).to_have_attribute("data-above", str(above))


def pull(page: Page, canvas: Locator, right: float, down: float) -> None:
    box = canvas.bounding_box()
    x, y = box["x"] + 150, box["y"] + 150
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + right, y + down, steps=10)
    page.mouse.up()


def test_a_plant_in_space_turns_by_keyboard(opened):
    canvas = canvas_of(opened("K19", 12))
    pictures = [canvas.screenshot()]
    turns = (("ArrowRight", 35, 15), ("ArrowUp", 35, 20), ("ArrowLeft", 30, 20), ("Home", 30, 15), ("ArrowDown", 30, 10))
    for key, around, above in turns:
        canvas.press(key)
        expect_view(canvas, around, above)
        pictures.append(canvas.screenshot(style=":focus-visible { outline: none !important }"))
    assert len(set(pictures[1:])) == 5


def test_a_plant_goes_all_the_way_round_never_over_the_top_and_comes_nearer(opened):
    canvas = canvas_of(opened("K19", 12))
    for key, times in (("ArrowRight", 31), ("ArrowUp", 20)):
        for _ in range(times):
            canvas.press(key)
    expect_view(canvas, -175, 90)
    whole = canvas.screenshot()
    canvas.press("+")
    canvas.press("+")
    expect(canvas).to_have_attribute("data-near", "1.56")
    near = canvas.screenshot()
    canvas.press("Shift+ArrowUp")
    assert len({whole, near, canvas.screenshot()}) == 3
    canvas.press("-")
    canvas.press("-")
    expect(canvas).to_have_attribute("data-near", "1.00")
    assert canvas.screenshot() == whole


def test_a_plant_turns_by_mouse_and_its_sliders_follow(opened):
    panel = opened("K19", 12)
    canvas, page = canvas_of(panel), panel.page
    pull(page, canvas, 40, 20)
    expect_view(canvas, 10, 25)  # the front goes with the mouse, so the viewer goes the other way
    expect(page.get_by_label("around", exact=True)).to_have_value("10")
    expect(page.get_by_label("above", exact=True)).to_have_value("25")
    page.mouse.wheel(0, -200)
    expect(canvas).to_have_attribute("data-near", "1.56")
    page.get_by_role("button", name="reset").click()
    expect_view(canvas, 30, 15)
    expect(canvas).to_have_attribute("data-near", "1.00")


def test_a_wheel_that_was_not_asked_for_is_the_pages(opened):
    panel = opened("K5", 4)
    canvas = canvas_of(panel)
    canvas.hover()
    panel.page.mouse.wheel(0, -200)
    panel.page.wait_for_timeout(200)
    expect(canvas).to_have_attribute("data-near", "1.00")


def test_sliders_turn_a_plant_and_steps_keep_the_side(opened):
    panel = opened("K19", 12)
    canvas = canvas_of(panel)
    before = canvas.screenshot()
    panel.control("around").press("ArrowRight")
    expect_view(canvas, 31, 15)
    turned = canvas.screenshot()
    panel.control("step").press("ArrowRight")
    expect(canvas).to_have_attribute("data-step", "13")
    expect_view(canvas, 31, 15)
    assert len({before, turned, canvas.screenshot()}) == 3


def test_a_drawing_in_the_plane_comes_nearer_and_moves(opened):
    panel = opened("K5", 4)
    canvas = canvas_of(panel)
    whole = canvas.screenshot()
    for _ in range(3):
        canvas.press("+")
    expect(canvas).to_have_attribute("data-near", "1.95")
    near = canvas.screenshot()
    pull(panel.page, canvas, 60, -40)
    moved = canvas.screenshot()
    canvas.press("ArrowUp")
    assert len({whole, near, moved, canvas.screenshot()}) == 4
    canvas.press("Home")
    expect(canvas).to_have_attribute("data-near", "1.00")


def test_the_angle_turns_in_the_browser(opened):
    panel = opened("K5", 4)
    canvas = canvas_of(panel)
    before = canvas.screenshot()
    panel.control("angle").press("ArrowRight")
    expect(canvas).to_have_attribute("data-angle", "26")
    assert canvas.screenshot() != before
    expect(panel.page.get_by_label("angle", exact=True)).to_have_value("26")


def test_with_one_scale_growth_is_seen(opened):
    panel = opened("K5", 4)
    panel.more()
    panel.page.get_by_label("size", exact=True).select_option("same")
    canvas = canvas_of(panel)
    heights = []
    for step in (4, 3, 2):
        expect(canvas).to_have_attribute("data-step", str(step))
        panel.page.wait_for_timeout(100)
        heights.append(
            canvas.evaluate("""canvas => {
            const { width, height } = canvas, { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
            let first = height, last = 0;
            for (let i = 0; i < width * height; i++) {
                if (data[4 * i] >= 128) continue;
                [first, last] = [Math.min(first, Math.floor(i / width)), Math.floor(i / width)];
            }
            return last - first;
        }""")
        )
        panel.control("step").press("ArrowLeft")
    assert heights[0] / heights[1] == pytest.approx(3, rel=0.1)
    assert heights[1] / heights[2] == pytest.approx(3, rel=0.2)


def test_two_fingers_bring_it_nearer(opened):
    panel = opened("K5", 4, context={"has_touch": True})
    canvas = canvas_of(panel)
    canvas.evaluate("""canvas => {
        const box = canvas.getBoundingClientRect(), send = (type, pointerId, x) => canvas.dispatchEvent(new PointerEvent(type,
            { pointerId, pointerType: "touch", clientX: box.left + x, clientY: box.top + 100, bubbles: true }));
        canvas.setPointerCapture = () => {};
        send("pointerdown", 1, 100); send("pointerdown", 2, 140);
        send("pointermove", 2, 150); send("pointermove", 2, 190);
        send("pointerup", 1, 100); send("pointerup", 2, 190);
    }""")
    expect(canvas).to_have_attribute("data-near", "1.80")


@pytest.mark.parametrize(("name", "step"), [("K5", 3), ("K6", 7), ("J6", 6), ("K19", 9)])
def test_width_and_height_of_a_drawing_are_said_as_the_kit_says_them(opened, name, step):
    words = str(draw(system(name), step))
    said = re.search(r"width [\d.]+, height [\d.]+", words)
    expect(opened(name, step).at(".lsys-status")).to_contain_text(said.group())


def test_a_turn_changes_the_width_that_is_said(opened):
    panel = opened("K5", 3)
    before = panel.at(".lsys-status").inner_text()
    panel.control("angle").press("ArrowRight")
    expect(panel.at(".lsys-status")).not_to_have_text(before)


def test_what_has_no_drawing_has_no_width(opened):
    panel = opened(read("axiom: a\na -> ab\nb -> a"), 4)
    expect(panel.at(".lsys-status")).to_have_text("step 4: 8 letters; 2 of 2 stages occupied")
