"""A plant in space in a real JupyterLab: turned by keyboard, by mouse and by sliders, without asking the kernel."""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from lsys_kit import derive, read
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.scene import Floats
from lsys_kit.pictures.view import project
from tests.browser.lab import OpenNotebook

CROOKED = "axiom: F(4)[&(60)F(3)][+(50)F(2)]^(30)F(2)/(40)&(50)F"
PLANT = 'from lsys_kit import explore\nexplore("K19", 12)'
INK = """canvas => {
    const {width, height} = canvas, {data} = canvas.getContext('2d').getImageData(0, 0, width, height), found = [];
    for (let i = 0; i < width * height; i++)
        if (data[4 * i + 3] > 128) found.push(i % width, Math.floor(i / width));
    return found;
}"""


@pytest.fixture
def shown(open_notebook: Callable[..., OpenNotebook], write_notebook: Callable[..., str]) -> Callable[[str], OpenNotebook]:
    """Opens a notebook with one cell and runs it."""

    def run(source: str) -> OpenNotebook:
        notebook = open_notebook(write_notebook("space.ipynb", source))
        notebook.run_all()
        expect(canvas_of(notebook)).to_have_attribute("data-around", "0")
        return notebook

    return run


def canvas_of(notebook: OpenNotebook) -> Locator:
    return notebook.output(1).locator("canvas")


def expect_view(canvas: Locator, around: int, above: int) -> None:
    expect(canvas).to_have_attribute("data-around", str(around))
    expect(canvas).to_have_attribute("data-above", str(above))


def test_a_plant_turns_by_keyboard(shown):
    notebook = shown(PLANT)
    canvas = canvas_of(notebook)
    label = canvas.get_attribute("aria-label") or ""
    assert "polygons" in label
    assert "arrow keys" in label
    canvas.focus()
    pictures = [canvas.screenshot()]
    turns = (("ArrowRight", 5, 0), ("ArrowUp", 5, 5), ("ArrowLeft", 0, 5), ("Home", 0, 0), ("ArrowDown", 0, -5))
    for key, around, above in turns:
        canvas.press(key)
        expect_view(canvas, around, above)
        pictures.append(canvas.screenshot())
    assert len(set(pictures)) == 5
    assert pictures[0] == pictures[4]
    notebook.shot("space-keyboard")
    assert notebook.cell_errors() == []
    assert notebook.console == []
    notebook._ask("await panel.sessionContext.shutdown();")
    canvas.press("ArrowLeft")
    expect_view(canvas, -5, -5)


def test_a_plant_goes_all_the_way_round_never_over_the_top_and_comes_nearer(shown):
    notebook = shown(PLANT)
    canvas = canvas_of(notebook)
    canvas.focus()
    for key, times in (("ArrowRight", 37), ("ArrowUp", 20)):
        for _ in range(times):
            canvas.press(key)
    expect_view(canvas, -175, 90)
    whole = canvas.screenshot()
    canvas.press("+")
    canvas.press("+")
    expect(canvas).to_have_attribute("data-near", "1.44")
    near = canvas.screenshot()
    canvas.press("Shift+ArrowUp")
    assert len({whole, near, canvas.screenshot()}) == 3
    canvas.press("-")
    canvas.press("-")
    expect(canvas).to_have_attribute("data-near", "1")
    assert canvas.screenshot() == whole
    assert notebook.console == []


def test_a_plant_turns_by_mouse_and_its_sliders_follow(shown):
    notebook = shown(PLANT)
    canvas, page = canvas_of(notebook), notebook.page
    box = canvas.bounding_box()
    assert box
    pull(page, box["x"] + 150, box["y"] + 150, 40, 20)
    expect_view(canvas, -20, 10)  # the front goes with the mouse, so the viewer goes the other way
    panel = notebook.output(1).locator(".lsys-explorer")
    expect(panel.get_by_label("around", exact=True)).to_have_value("-20")
    expect(panel.get_by_label("above", exact=True)).to_have_value("10")
    page.mouse.wheel(0, -200)
    expect(canvas).to_have_attribute("data-near", "1.44")
    panel.get_by_role("button", name="reset").click()
    expect_view(canvas, 0, 0)
    expect(canvas).to_have_attribute("data-near", "1")
    notebook.shot("space-mouse")
    assert notebook.console == []


def pull(page: Page, x: float, y: float, right: float, down: float) -> None:
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + right, y + down, steps=10)
    page.mouse.up()


def test_sliders_turn_a_plant_and_steps_keep_the_side(shown):
    notebook = shown(PLANT)
    canvas, panel = canvas_of(notebook), notebook.output(1).locator(".lsys-explorer")
    before = canvas.screenshot()
    panel.locator(".noUi-handle").nth(2).press("ArrowRight")
    expect_view(canvas, 1, 0)
    turned = canvas.screenshot()
    panel.locator(".noUi-handle").nth(0).press("ArrowRight")
    expect(canvas).to_have_attribute("aria-label", re.compile("^Drawing of step 13:"))
    expect_view(canvas, 1, 0)
    assert len({before, turned, canvas.screenshot()}) == 3


def test_the_browser_sees_what_the_kernel_sees(shown):
    """Points on every stroke, as `project` has them, are inked where the canvas has drawn the plant."""
    notebook = shown(f"from lsys_kit import explore, read\nexplore(read({CROOKED!r}), 0)")
    canvas, panel = canvas_of(notebook), notebook.output(1).locator(".lsys-explorer")
    scene = scene_of(derive(read(CROOKED), 0))
    for around, above in ((0, 0), (50, 0), (-130, 25), (90, -60), (20, 90)):
        for name, degrees in (("around", around), ("above", above)):
            box = panel.get_by_label(name, exact=True)
            box.fill(str(degrees))
            box.press("Enter")
        expect_view(canvas, around, above)
        inked = np.array(canvas.evaluate(INK)).reshape(-1, 2).astype(float)
        assert farthest(project(scene, around, above).segments.ends, inked) < 3


def farthest(ends: Floats, inked: Floats) -> float:
    """How far from all ink, in pixels, a stroke leads, once it is fitted to where the ink lies."""
    along = np.linspace(0.1, 0.9, 9)[:, None, None]
    points = (ends[:, :2] * (1 - along) + ends[:, 2:] * along).reshape(-1, 2)
    corners = ends.reshape(-1, 2)
    scale = np.ptp(inked, axis=0) / np.ptp(corners, axis=0)
    assert scale[0] == pytest.approx(scale[1], rel=0.03)
    expected = (points - corners.min(axis=0)) * scale * [1, -1] + [inked[:, 0].min(), inked[:, 1].max()]
    return max(float(np.hypot(*(inked - point).T).min()) for point in expected)
