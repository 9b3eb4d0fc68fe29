"""The panel in JupyterLab, light and dark, in Notebook 7 and in Voila; what it tells the kernel, and what it leaves behind."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import axe_playwright_python
import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.lab import Lab, OpenNotebook
from tests.classroom.test_panel import SETTLED

AXE = Path(axe_playwright_python.__file__).parent / "axe.min.js"
SENT = """
    window.sent = [];
    panel.sessionContext.session.kernel.anyMessage.connect((_, { msg, direction }) => {
        if (direction === 'send' && msg.header.msg_type === 'comm_msg') window.sent.push(msg.content.data.method ?? 'other');
    });"""


def show(source: str) -> str:
    return f"from lsys_kit import *\n{source}"


@pytest.fixture
def shown(open_notebook: Callable[..., OpenNotebook], write_notebook: Callable[..., str]) -> Callable[..., OpenNotebook]:
    """Opens a notebook with one cell and runs it."""

    def run(source: str, **context: object) -> OpenNotebook:
        notebook = open_notebook(write_notebook("panel.ipynb", show(source)), **context)
        notebook._ask("app.shell.collapseLeft();")
        notebook.run_all()
        expect(panel_of(notebook.page).locator("canvas[data-drawn]").first).to_be_visible()
        return notebook

    return run


def panel_of(page: Page) -> Locator:
    return page.locator(".lsys-panel").first


def slider(panel: Locator, name: str) -> Locator:
    return panel.get_by_role("slider", name=f"{name}, slider", exact=True)


@pytest.mark.slow
def test_no_message_goes_to_the_kernel_while_anything_moves(shown):
    """On every settled system of the catalogue, in one page; where a slider has come to rest, one message tells the kernel."""
    notebook = shown(f"from ipywidgets import VBox\nVBox([explore(id) for id in {SETTLED!r}])")
    notebook._ask(SENT)
    panels = notebook.page.locator(".lsys-panel")
    expect(panels).to_have_count(len(SETTLED))
    notebook.page.evaluate("""() => {
        for (const range of document.querySelectorAll(".lsys-panel .lsys-range")) {
            if (!["step", "angle", "around", "above"].includes(range.parentElement.dataset.control)) continue;
            for (const value of [0, 3, 1, 2]) {
                range.value = value;
                range.dispatchEvent(new Event("input", { bubbles: true }));
            }
        }
        for (const stage of document.querySelectorAll(".lsys-panel [data-place]")) stage.dispatchEvent(new MouseEvent("click"));
        window.sentWhileMoving = window.sent.length;
    }""")
    assert notebook.page.evaluate("window.sentWhileMoving") == 0
    notebook.page.wait_for_timeout(1500)
    found = notebook.page.evaluate("window.sent")
    assert set(found) == {"update"}
    assert len(found) <= len(SETTLED)
    assert notebook.console == []


def test_python_sees_what_the_panel_shows(open_notebook, write_notebook):
    asked = "print(panel.step, panel.settings, panel.mark)"
    notebook = open_notebook(write_notebook("python.ipynb", show("panel = explore('J4', 9)\npanel"), asked))
    notebook._ask("panel.content.activeCellIndex = 1; await app.commands.execute('notebook:run-cell'); await idle();")
    panel = panel_of(notebook.page)
    slider(panel, "step").press("ArrowRight")
    slider(panel, "lifeTimeB").press("ArrowRight")
    panel.locator("[data-place]").first.press("Enter")
    notebook.page.wait_for_timeout(1000)
    notebook._ask("panel.content.activeCellIndex = 2; await app.commands.execute('notebook:run-cell'); await idle();")
    expect(notebook.output(2)).to_contain_text("10 {'lifeTimeA': '3', 'lifeTimeB': '3'} A(1)")


def test_what_python_sets_the_panel_shows(open_notebook, write_notebook):
    said = "panel.step, panel.lifeTimeA = 3, 5"
    notebook = open_notebook(write_notebook("python.ipynb", show("panel = explore('J4', 9)\npanel"), said))
    notebook.run_all()
    panel = panel_of(notebook.page)
    notebook.output(1)
    expect(panel.locator(".lsys-status")).to_contain_text("step 3")
    expect(panel.get_by_label("lifeTimeA", exact=True)).to_have_value("5")


def test_rules_that_are_typed_are_the_systems_of_python_too(open_notebook, write_notebook):
    asked = "print(panel.system.productions[0], '|', panel.settings, '|', panel.text[:8])"
    notebook = open_notebook(write_notebook("rules.ipynb", show("panel = explore('J4', 9)\npanel"), asked))
    notebook._ask("panel.content.activeCellIndex = 1; await app.commands.execute('notebook:run-cell'); await idle();")
    panel = panel_of(notebook.page)
    panel.get_by_role("group", name="views").get_by_role("button", name="rules", exact=True).click()
    rules = panel.get_by_label("rules of the model")
    rules.fill("c = 2 in 1 .. 5\naxiom: A(1)\nA(t) : t < c -> A(t+1)\nA(t) -> A(1)A(")
    expect(panel.locator("mark.lsys-wrong")).to_have_count(1)
    rules.fill("c = 2 in 1 .. 5\naxiom: A(1)\nA(t) : t < c -> A(t+1)\nA(t) -> A(1)A(1)")
    expect(panel.locator(".lsys-status")).to_contain_text("16 modules")
    expect(panel.locator("mark.lsys-wrong")).to_have_count(0)
    slider(panel, "c").press("ArrowRight")
    expect(panel.locator(".lsys-status")).to_contain_text("8 modules")
    notebook.page.wait_for_timeout(1000)
    notebook._ask("panel.content.activeCellIndex = 2; await app.commands.execute('notebook:run-cell'); await idle();")
    expect(notebook.output(2)).to_contain_text("A(t) : t < c -> A(t + 1) | {'c': '3'} | Step 9:")
    assert notebook.console == []


@pytest.mark.parametrize("dark", [False, True])
def test_every_control_by_mouse_in_light_and_dark(shown, dark):
    notebook = shown("explore('J4', 9)")
    if dark:
        notebook._ask("await app.commands.execute('apputils:change-theme', { theme: 'JupyterLab Dark' });")
        expect(notebook.page.locator("body")).to_have_attribute("data-jp-theme-light", "false")
    panel = panel_of(notebook.page)
    for title in ("rules", "how many", "nine variants"):
        panel.get_by_role("group", name="views").get_by_role("button", name=title, exact=True).click()
    expect(panel.locator(".lsys-tile-button")).to_have_count(9)
    for name in ("one step back", "one step on", "to step 0", "play"):
        panel.get_by_role("button", name=name, exact=True).click()
    expect(panel.locator(".lsys-status")).to_contain_text("step 2")
    panel.get_by_role("button", name="pause", exact=True).click()
    panel.locator('.lsys-module[data-position="0"]').click()
    expect(panel.locator(".lsys-sentence")).to_contain_text("Module 1 of step")
    notebook.shot(f"panel-{'dark' if dark else 'light'}")
    panel.get_by_role("button", name="reset", exact=True).click()
    expect(panel.locator(".lsys-status")).to_contain_text("step 9")
    notebook._ask("await app.commands.execute('apputils:change-theme', { theme: 'JupyterLab Light' });")
    assert notebook.console == []


def test_a_kernel_that_is_gone_is_told_of_and_the_rest_goes_on(shown):
    notebook = shown("explore('K5', 3)")
    notebook._ask("await panel.sessionContext.shutdown();")
    panel = panel_of(notebook.page)
    slider(panel, "angle").press("ArrowRight")
    expect(panel.locator("canvas.lsys-canvas")).to_have_attribute("data-angle", "25.8")
    slider(panel, "step").press("ArrowRight")
    expect(panel.locator(".lsys-status")).to_contain_text("step 4")


@pytest.mark.parametrize(("width", "zoom"), [(1440, 1), (900, 1), (400, 1), (1440, 2)])
def test_at_every_width(shown, width, zoom):
    """At 200 % a window has half as many pixels of the style, each twice as large."""
    notebook = shown("explore('J4', 9)", viewport={"width": width // zoom, "height": 900 // zoom}, device_scale_factor=zoom)
    panel = panel_of(notebook.page)
    panel.scroll_into_view_if_needed()
    box = panel.evaluate("panel => [panel.scrollWidth, panel.clientWidth]")
    assert box[0] <= box[1] + 1
    for part in panel.locator("section:not([hidden])").all():
        assert part.bounding_box()["width"] <= panel.bounding_box()["width"]
    notebook.shot(f"panel-{width}-{zoom}")


def test_compare_has_one_slider_and_marks_differences(shown):
    notebook = shown("compare('J4', {}, {'lifeTimeA': 2, 'lifeTimeB': 3}, step=7)")
    page = notebook.page
    expect(page.locator(".lsys-side .lsys-panel")).to_have_count(2)
    steps = page.get_by_role("slider", name="step, slider", exact=True)
    assert [each.is_visible() for each in steps.all()].count(True) == 1
    steps.first.press("ArrowLeft")
    for status in page.locator(".lsys-side .lsys-status").all():
        expect(status).to_contain_text("step 6")
    said = page.locator(".lsys-both > .lsys-sentence")
    expect(said).to_contain_text(re.compile("the words have 4 and . modules; they differ first at module"))
    assert page.locator(".lsys-different").count() > 0
    notebook.shot("compare")
    assert notebook.console == []


# --- Notebook 7 and Voila ---------------------------------------------------------------------------------------------

def test_in_notebook_7_arrow_keys_move_the_sliders(browser: Browser, lab: Lab, write_notebook):
    name = write_notebook("seven.ipynb", show("explore('J4', 9)"))
    page = browser.new_page(viewport={"width": 1200, "height": 900})
    page.goto(f"{lab.url}/notebooks/{name}")
    page.wait_for_function("window.jupyterapp?.shell?.currentWidget?.sessionContext?.session?.kernel?.status === 'idle'")
    page.evaluate("window.jupyterapp.commands.execute('notebook:run-all-cells')")
    panel = panel_of(page)
    expect(panel.locator("canvas[data-drawn]").first).to_be_visible(timeout=90_000)
    slider(panel, "step").press("ArrowRight")
    expect(panel.locator(".lsys-status")).to_contain_text("step 10")
    page.close()


def test_voila_serves_a_panel(browser: Browser, lab: Lab, write_notebook):
    name = write_notebook("voila.ipynb", show("explore('J4', 9)"))
    page = browser.new_page(viewport={"width": 1200, "height": 900})
    page.goto(f"{lab.url}/voila/render/{name}")
    panel = panel_of(page)
    expect(panel.locator("canvas[data-drawn]").first).to_be_visible(timeout=90_000)
    slider(panel, "step").press("ArrowRight")
    expect(panel.locator(".lsys-status")).to_contain_text("step 10")
    slider(panel, "lifeTimeB").press("ArrowRight")
    expect(panel.locator(".lsys-status")).to_contain_text("of 6 stages")
    page.close()


# --- accessibility ----------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("source", [
    "explore('J4', 9)", "explore('K19', 12)", "draw(system('K5'))", "draw(stages(system('J4')))", "animate(system('J4'), 4)"])
def test_axe_finds_nothing(open_notebook, write_notebook, source):
    notebook = open_notebook(write_notebook("axe.ipynb", show(source)))
    notebook.run_all()
    output = notebook.output(1)
    expect(output.locator("canvas[data-drawn], svg, img").first).to_be_visible()
    if "explore" in source:
        for title in ("rules", "how many"):
            output.get_by_role("group", name="views").get_by_role("button", name=title, exact=True).click()
    notebook.page.evaluate(AXE.read_text(encoding="utf-8"))
    found = notebook.page.evaluate("""async () => {
        const output = document.querySelector(".jp-OutputArea-output:has(.lsys-panel, svg, img)");
        const { violations, incomplete } = await axe.run(output);
        return [...violations, ...incomplete].filter(({ impact }) => impact === "critical" || impact === "serious")
            .map((each) => [each.id, ...each.nodes.map((node) => node.html.slice(0, 200))]);
    }""")
    assert found == [], json.dumps(found, indent=1)


# --- what is left behind ----------------------------------------------------------------------------------------------

def test_closed_panels_leave_no_comm_behind(open_notebook, write_notebook):
    source = show("from comm import get_comm_manager\ndef many():\n    for _ in range(200):\n        explore('J1', 3).close()\n"
                  "    return len(get_comm_manager().comms)\nprint('left', many() - many())")
    notebook = open_notebook(write_notebook("comms.ipynb", source))
    notebook.run_all()
    expect(notebook.output(1)).to_contain_text("left 0")

