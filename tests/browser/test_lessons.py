"""The lessons in a real JupyterLab: every slider moves by keyboard and changes the word, the tokens and the drawing."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Locator, expect

LESSONS = ("01_parallel_rewriting", "02_stages_and_life_spans")
TURTLES = 'from lsys_kit import explore\nexplore("K5", 3)'


def seen(panel: Locator) -> tuple[str, str, str]:
    """The word, the stage diagram's description with its tokens, and the drawing's description."""
    word = panel.locator(".lsys-word").inner_text()
    stages, drawing = (panel.locator("[role=img]").nth(n).get_attribute("aria-label") for n in (0, 1))
    return word, stages, drawing


def expect_change(panel: Locator, before: tuple[str, str, str]) -> tuple[str, str, str]:
    for number, old in enumerate(before[1:]):
        expect(panel.locator("[role=img]").nth(number)).not_to_have_attribute("aria-label", old)
    expect(panel.locator(".lsys-word")).not_to_have_text(before[0])
    return seen(panel)


@pytest.mark.parametrize("lesson", LESSONS)
def test_every_slider_of_a_lesson_moves_by_keyboard(open_notebook, lesson):
    notebook = open_notebook(f"notebooks/{lesson}.ipynb")
    notebook.run_all()
    assert notebook.cell_errors() == []
    for number in notebook.cells_showing("explore("):
        panel = notebook.output(number).locator(".lsys-explorer")
        expect(panel.locator(".lsys-word")).to_be_visible()
        handles = panel.locator(".noUi-handle")
        for index in range(handles.count()):
            before = seen(panel)
            handles.nth(index).press("ArrowRight")
            after = expect_change(panel, before)
            handles.nth(index).press("ArrowLeft")
            expect(panel.locator("[role=img]").nth(1)).not_to_have_attribute("aria-label", after[2])
            assert seen(panel) == before
        notebook.shot(f"{lesson}-{number}")
    assert notebook.cell_errors() == []
    assert notebook.console == []


def test_number_boxes_play_reset_and_stages(open_notebook):
    notebook = open_notebook("notebooks/02_stages_and_life_spans.ipynb")
    notebook.run_all()
    panel = notebook.output(notebook.cells_showing('explore("J4"')[0]).locator(".lsys-explorer")
    box = panel.get_by_label("step", exact=True)
    box.fill("3")
    box.press("Enter")
    expect(panel.locator(".lsys-word")).to_have_text(re.compile(r"^Al\(1\)Br\(1\)$"))
    panel.locator("[data-place]").first.press("Enter")
    expect(panel.get_by_label("mark", exact=True).last).to_have_value("A(1)")
    expect(panel.locator("[role=img]").nth(0)).to_have_attribute("aria-label", re.compile(r"A\(1\) is marked"))
    expect(panel.locator('ellipse[stroke-width="32"]').first).to_be_attached()
    panel.locator("[data-place]").first.click()
    expect(panel.get_by_label("mark", exact=True).last).to_have_value("no stage")
    panel.get_by_role("button", name="play").click()
    expect(panel.locator("[role=status]")).to_contain_text("step 5")
    panel.get_by_role("button", name="pause").click()
    expect(panel.get_by_role("button", name="play")).to_be_visible()
    panel.get_by_role("button", name="reset").click()
    expect(panel.locator("[role=status]")).to_contain_text("step 10: 12 modules")
    assert notebook.console == []


@pytest.fixture
def plant(open_notebook, write_notebook):
    notebook = open_notebook(write_notebook("plant.ipynb", TURTLES))
    notebook.run_all()
    return notebook


def test_a_drawing_turns_without_the_kernel(plant):
    panel = plant.output(1).locator(".lsys-explorer")
    canvas = panel.locator("canvas")
    expect(canvas).to_have_attribute("data-angle", "25.7")
    before = canvas.screenshot()
    plant._ask("await panel.sessionContext.shutdown();")
    panel.locator(".noUi-handle").nth(1).press("ArrowRight")
    expect(canvas).to_have_attribute("data-angle", re.compile(r"^25\.8"))
    assert canvas.screenshot() != before
    plant.shot("plant")


def test_a_step_past_the_limit_says_so_and_keeps_the_picture(plant):
    panel = plant.output(1).locator(".lsys-explorer")
    box = panel.get_by_label("step", exact=True)
    drawing = panel.locator("canvas").get_attribute("aria-label")
    box.fill("9")
    box.press("Enter")
    expect(panel.get_by_role("alert")).to_contain_text("Step 7 would have 195,311 modules; the limit is 100,000")
    assert panel.locator("canvas").get_attribute("aria-label") == drawing
    box.fill("4")
    box.press("Enter")
    expect(panel.get_by_role("alert")).to_have_count(0)
    expect(panel.locator("canvas")).to_have_attribute("aria-label", "Drawing of step 4: 625 segments")


def test_on_a_narrow_screen_the_views_stand_below_one_another(open_notebook, write_notebook):
    notebook = open_notebook(write_notebook("narrow.ipynb", 'from lsys_kit import explore\nexplore("J4", 8)'),
                             viewport={"width": 620, "height": 1000})
    notebook.run_all()
    panel = notebook.output(1).locator(".lsys-explorer")
    tops = [panel.locator(where).first.bounding_box()["y"] for where in (".lsys-word", "[role=img]")]
    assert tops[1] > tops[0] + 20
    notebook.shot("narrow")
