"""The lessons in a real JupyterLab: every slider moves by keyboard and changes the word, the tokens and the drawing."""

from __future__ import annotations

import pytest
from playwright.sync_api import Locator, expect

LESSONS = ("01_all_at_once", "02_stages_and_life_spans")


def seen(panel: Locator) -> tuple[str, ...]:
    """The word, the tokens of the stages, and the number of the drawing."""
    tokens = panel.locator("[data-place]").evaluate_all("found => found.map(stage => stage.getAttribute('aria-label')).join()")
    return panel.locator(".lsys-word").inner_text(), tokens, panel.locator("canvas.lsys-canvas").get_attribute("data-drawn")


@pytest.mark.parametrize("lesson", LESSONS)
def test_every_slider_of_a_lesson_moves_by_keyboard(open_notebook, lesson):
    notebook = open_notebook(f"notebooks/{lesson}.ipynb")
    notebook.run_all()
    assert notebook.cell_errors() == []
    for number in notebook.cells_showing("explore("):
        panel = notebook.output(number).locator(".lsys-panel")
        expect(panel.locator("canvas[data-drawn]").first).to_be_visible()
        sliders = panel.locator(".lsys-control:not([hidden]) .lsys-range")
        for index in range(sliders.count()):
            before = seen(panel)
            sliders.nth(index).press("ArrowRight")
            expect(panel.locator(".lsys-word")).not_to_have_text(before[0])
            expect(panel.locator("canvas.lsys-canvas")).not_to_have_attribute("data-drawn", before[2])
            assert seen(panel)[1] != before[1]
            sliders.nth(index).press("ArrowLeft")
            expect(panel.locator(".lsys-word")).to_have_text(before[0])
        notebook.shot(f"{lesson}-{number}")
    assert notebook.cell_errors() == []
    assert notebook.console == []
