"""The panel in JupyterLab, light and dark, in Notebook 7 and in Voila; what it tells the kernel, and what it leaves behind."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import axe_playwright_python
import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.homes import HOMES, show
from tests.browser.lab import OpenNotebook
from tests.classroom.panel_page import show_more
from tests.classroom.test_panel import SETTLED

LOOKED_AT = (
    "explore('J4', 9)",
    "explore('P5', letters='dt')",
    "explore('K19', 12)",
    "draw(system('K5'))",
    "draw(stages(system('J4')))",
    "animate(system('J4'), 4)",
)
AXE = Path(axe_playwright_python.__file__).parent / "axe.min.js"
LATE = 1_000
"""Milliseconds after which a panel has told the kernel where its sliders are."""
SENT = """
    window.sent = [];
    panel.sessionContext.session.kernel.anyMessage.connect((_, { msg, direction }) => {
        if (direction === 'send' && msg.header.msg_type === 'comm_msg') window.sent.push(msg.content.data.method ?? 'other');
    });"""


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
            if (!["step", "angle", "around", "above"].includes(range.closest(".lsys-control").dataset.control)) continue;
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
    expect(panel).not_to_have_attribute("aria-busy", "true")  # else the place may be drawn anew under the press
    panel.locator("[data-place]").first.press("Enter")
    expect(panel.locator("[data-place]").first).to_have_attribute("aria-pressed", "true")
    for _ in range(40):  # what is chosen is sent when the kernel has taken what was chosen before
        notebook.page.wait_for_timeout(500)
        notebook._ask("panel.content.activeCellIndex = 2; await app.commands.execute('notebook:run-cell'); await idle();")
        if "A(1)" in notebook.output(2).inner_text():
            break
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
    panel.locator(".lsys-tabs").get_by_role("button", name="rules", exact=True).click()
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


PAPER = "canvas => [...canvas.getContext('2d').getImageData(1, 1, 1, 1).data].slice(0, 3).every(each => each < 80)"


def test_drawings_have_the_colours_of_another_theme_at_once(shown):
    notebook = shown("explore('K8', 5)")
    panel = panel_of(notebook.page)
    panel.get_by_role("button", name="nine seeds", exact=True).click()
    expect(panel.locator(".lsys-tile-button")).to_have_count(9)
    for theme, dark in (("Dark", True), ("Light", False)):
        notebook._ask(f"await app.commands.execute('apputils:change-theme', {{ theme: 'JupyterLab {theme}' }});")
        expect(notebook.page.locator("body")).to_have_attribute("data-jp-theme-light", str(not dark).lower())
        notebook.page.wait_for_timeout(500)
        assert [canvas.evaluate(PAPER) for canvas in panel.locator("canvas").all()] == [dark] * 10


@pytest.mark.parametrize("dark", [False, True])
def test_every_control_by_mouse_in_light_and_dark(shown, dark):
    notebook = shown("explore('J4', 9)")
    if dark:
        notebook._ask("await app.commands.execute('apputils:change-theme', { theme: 'JupyterLab Dark' });")
        expect(notebook.page.locator("body")).to_have_attribute("data-jp-theme-light", "false")
    panel = panel_of(notebook.page)
    show_more(panel)
    for title in ("rules", "how many", "nine variants"):
        panel.locator(".lsys-tabs").get_by_role("button", name=title, exact=True).click()
    expect(panel.locator(".lsys-tile-button")).to_have_count(9)
    for name in ("one step back", "one step on", "to step 0", "play"):
        panel.get_by_role("button", name=name, exact=True).click()
    expect(panel.locator(".lsys-status")).to_contain_text("step 2")
    panel.get_by_role("button", name="pause", exact=True).click()
    panel.locator('.lsys-module[data-position="0"]').click()
    expect(panel.locator(".lsys-sentence")).to_contain_text("Cell 1 of step")
    notebook.shot(f"panel-{'dark' if dark else 'light'}")
    panel.get_by_role("button", name="reset", exact=True).click()
    expect(panel.locator(".lsys-status")).to_contain_text("step 9")
    notebook._ask("await app.commands.execute('apputils:change-theme', { theme: 'JupyterLab Light' });")
    assert notebook.console == []


def test_a_kernel_that_is_gone_is_told_of_and_the_rest_goes_on(shown):
    notebook = shown("explore('K5', 3)")
    panel = panel_of(notebook.page)
    show_more(panel)
    notebook._ask("await panel.sessionContext.shutdown();")
    slider(panel, "angle").press("Shift+ArrowRight")
    expect(panel.locator("canvas.lsys-canvas")).to_have_attribute("data-angle", "25.8")
    slider(panel, "step").press("ArrowRight")
    expect(panel.locator(".lsys-status")).to_contain_text("step 4")
    panel.get_by_role("button", name="page", exact=True).click()  # which the kernel writes
    expect(panel).to_contain_text("The kernel does not answer")
    notebook.page.wait_for_timeout(LATE)
    assert notebook.console == []


def test_a_kernel_that_starts_again_is_told_of(shown):
    notebook = shown("explore('K5', 3)")
    panel = panel_of(notebook.page)
    notebook._ask("await panel.sessionContext.session.kernel.restart();")
    expect(panel).to_contain_text("The kernel does not answer")
    slider(panel, "step").press("ArrowRight")
    expect(panel.locator(".lsys-status")).to_contain_text("step 4")
    notebook.page.wait_for_timeout(LATE)
    assert notebook.console == []


@pytest.mark.parametrize(("width", "zoom"), [(1440, 1), (900, 1), (400, 1), (1440, 2)])
def test_at_every_width(shown, width, zoom):
    """At 200 % a window has half as many pixels of the style, each twice as large."""
    larger = {"device_scale_factor": zoom} if zoom > 1 else {}
    notebook = shown("explore('J4', 9)", viewport={"width": width // zoom, "height": 900 // zoom}, **larger)
    panel = panel_of(notebook.page)
    panel.scroll_into_view_if_needed()
    box = panel.evaluate("panel => [panel.scrollWidth, panel.clientWidth]")
    assert box[0] <= box[1] + 1
    for part in panel.locator("section:not([hidden])").all():
        assert part.bounding_box()["width"] <= panel.bounding_box()["width"]
    notebook.shot(f"panel-{width}-{zoom}")


def test_on_a_narrow_screen_the_step_stays_in_sight(shown):
    panel = panel_of(shown("explore('J4', 9)", viewport={"width": 400, "height": 800}).page)
    panel.locator(".lsys-net").scroll_into_view_if_needed()
    expect(panel.get_by_label("step", exact=True)).to_be_in_viewport()


def test_compare_has_one_slider_and_marks_differences(shown):
    notebook = shown("compare('J4', {}, {'lifeTimeA': 2, 'lifeTimeB': 3}, step=7)")
    page = notebook.page
    expect(page.locator(".lsys-side .lsys-panel")).to_have_count(2)
    for side in page.locator(".lsys-side").all():
        expect(side.locator(".lsys-different").first).to_be_visible()
    steps = page.get_by_role("slider", name="step, slider", exact=True)
    assert [each.is_visible() for each in steps.all()].count(True) == 1
    steps.first.press("ArrowLeft")
    for status in page.locator(".lsys-side .lsys-status").all():
        expect(status).to_contain_text("step 6")
    said = page.locator(".lsys-both > .lsys-sentence")
    expect(said).to_contain_text(re.compile("the words have 4 and . cells; they differ first at cell"))
    notebook.shot("compare")
    assert notebook.console == []


# --- JupyterLab, Notebook 7 and Voila ---------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def home(request: pytest.FixtureRequest, open_at_home: Callable[..., Page]) -> Callable[[str], Locator]:
    """Finds what is explored or compared in a page of one of the three, each for the tests that act on it."""
    shown = ["explore('J4', 9)", "explore('J4', 9)", "explore('K7', 3)", "compare('P2', 'P3', step=9)"]
    page = open_at_home(request.param, f"from ipywidgets import VBox\nVBox([{', '.join(shown)}])")

    def panel(number: int) -> Locator:
        found = page.locator(".lsys-panel:not(.lsys-both .lsys-panel)").nth(number)
        expect(found.locator("canvas[data-drawn]").first).to_be_visible(timeout=90_000)
        return found

    return panel


@HOMES
def test_every_control_by_the_keyboard(home):
    panel = home(0)
    status = panel.locator(".lsys-status")
    for name, key, told in (
        ("step", "ArrowRight", "step 10"),
        ("step", "Home", "step 0"),
        ("step", "End", "step 20"),
        ("lifeTimeB", "ArrowRight", "of 6 stages"),
        ("lifeTimeA", "ArrowLeft", "of 5 stages"),
    ):
        slider(panel, name).press(key)
        expect(status).to_contain_text(told)
    box = panel.get_by_label("step", exact=True)
    for typed, told in (("7", "step 7"), ("3", "step 3")):
        box.fill(typed)
        box.press("Enter")
        expect(status).to_contain_text(told)
    box.press("ArrowUp")
    expect(status).to_contain_text("step 4")
    for name, told in (("one step on", "step 5"), ("one step back", "step 4"), ("to step 0", "step 0"), ("play", "step 1")):
        panel.get_by_role("button", name=name, exact=True).press("Enter")
        expect(status).to_contain_text(told)
    panel.get_by_role("button", name="pause", exact=True).press("Enter")
    show_more(panel)
    panel.get_by_label("mark", exact=True).press("ArrowDown")
    expect(panel.locator('[data-place][aria-pressed="true"]')).to_have_count(1)
    panel.locator("[data-place]").last.press("Enter")
    expect(panel.locator("[data-place]").last).to_have_attribute("aria-pressed", "true")
    panel.get_by_label("size", exact=True).press("ArrowDown")
    expect(panel.get_by_label("size", exact=True)).to_have_value("same")
    panel.get_by_label("loop", exact=True).press(" ")
    expect(panel.get_by_label("loop", exact=True)).to_be_checked()
    panel.locator(".lsys-word").press("ArrowRight")
    expect(panel.locator(".lsys-sentence")).to_contain_text("Cell 1 of step")
    panel.locator("canvas.lsys-canvas").press("+")
    expect(panel.locator("canvas.lsys-canvas")).to_have_attribute("data-near", "1.25")
    for title in ("rules", "how many", "word", "class"):
        tab = panel.locator(".lsys-tabs").get_by_role("button", name=title, exact=True)
        before = tab.get_attribute("aria-pressed")
        tab.press("Enter")
        expect(tab).to_have_attribute("aria-pressed", "false" if before == "true" else "true")
    rules = panel.get_by_label("rules of the model")
    rules.fill("axiom: a\na -> a b\nb -> a")
    rules.press("End")
    rules.type(" b")
    expect(status).to_contain_text(re.compile("of 2 stages"))
    panel.get_by_role("button", name="back to the first rules").press("Enter")
    expect(status).to_contain_text("of 5 stages")
    panel.get_by_role("button", name="code", exact=True).press("Enter")
    expect(panel.get_by_label("to be copied")).to_have_value(re.compile(r'^explore\("J4", '))
    panel.get_by_role("button", name="reset", exact=True).press("Enter")
    expect(status).to_contain_text("step 9")  # the first one of the panel, whatever rules were typed


@HOMES
def test_every_control_by_the_mouse(home):
    panel = home(1)
    status = panel.locator(".lsys-status")
    for name in ("step", "lifeTimeA", "lifeTimeB"):
        handle = slider(panel, name)
        box, before = handle.bounding_box(), handle.input_value()
        handle.click(position={"x": box["width"] - 3, "y": box["height"] / 2})
        expect(handle).not_to_have_value(before)
    expect(status).to_contain_text("step 20")
    for name, told in (("one step back", "step 19"), ("one step on", "step 20"), ("to step 0", "step 0"), ("play", "step 1")):
        panel.get_by_role("button", name=name, exact=True).click()
        expect(status).to_contain_text(told)
    panel.get_by_role("button", name="pause", exact=True).click()
    panel.get_by_role("button", name="reset", exact=True).click()
    expect(status).to_contain_text("step 9: 9 cells")
    panel.locator("[data-place]").first.click()
    expect(panel.locator("[data-place]").first).to_have_attribute("aria-pressed", "true")
    panel.locator('.lsys-module[data-position="2"]').click()
    expect(panel.locator(".lsys-sentence")).to_contain_text("Cell 3 of step 9")
    canvas = panel.locator("canvas.lsys-canvas")
    canvas.click(position={"x": canvas.bounding_box()["width"] / 2 + 17, "y": 42})
    expect(panel.locator(".lsys-sentence")).to_contain_text("Cell 1 of step 0")
    show_more(panel)
    for title in ("rules", "how many", "nine variants", "class"):
        panel.locator(".lsys-tabs").get_by_role("button", name=title, exact=True).click()
    expect(panel.locator(".lsys-tile-button")).to_have_count(9)
    plot = panel.locator(".lsys-counts")
    plot.click(position={"x": plot.bounding_box()["width"] * 53 / 380, "y": 20})
    expect(status).to_contain_text("step 0")
    for name in ("SVG", "page", "PNG"):
        with panel.page.expect_download() as kept:
            panel.get_by_role("button", name=name, exact=True).click()
        assert kept.value.suggested_filename == {"SVG": "J4.svg", "page": "J4.html", "PNG": "J4.png"}[name]
    panel.get_by_role("button", name="link", exact=True).click()
    expect(panel.get_by_label("to be copied")).to_have_value(re.compile("^#lsys="))


@HOMES
def test_nine_seeds_and_two_systems(home):
    panel = home(2)
    panel.locator(".lsys-tabs").get_by_role("button", name="nine seeds", exact=True).click()
    expect(panel.locator(".lsys-tile-button")).to_have_count(9)
    panel.locator(".lsys-tile-button").nth(5).click()
    expect(panel.get_by_label("seed", exact=True)).to_have_value("5")
    both = home(3)
    both.get_by_role("slider", name="step, slider", exact=True).first.press("ArrowLeft")
    expect(both.page.locator(".lsys-both > .lsys-sentence")).to_contain_text("cell by cell they are drawn alike")


# --- accessibility ----------------------------------------------------------------------------------------------------


def test_axe_finds_nothing(open_notebook, write_notebook):
    notebook = open_notebook(write_notebook("axe.ipynb", *map(show, LOOKED_AT)))
    notebook.run_all()
    notebook.page.evaluate(AXE.read_text(encoding="utf-8"))
    for number, source in enumerate(LOOKED_AT, 1):
        output = notebook.output(number).locator(".jp-OutputArea-output:has(.lsys-panel, svg, img)").first
        expect(output.locator("canvas[data-drawn], svg, img").first).to_be_visible()
        if "explore" in source:
            show_more(output)
            for title in ("rules", "how many"):
                output.locator(".lsys-tabs").get_by_role("button", name=title, exact=True).click()
        found = output.evaluate("""async (output) => {
            const { violations, incomplete } = await axe.run(output);
            return [...violations, ...incomplete].filter(({ impact }) => impact === "critical" || impact === "serious")
                .map((each) => [each.id, ...each.nodes.map((node) => node.html.slice(0, 200))]);
        }""")
        assert found == [], f"{source}: {json.dumps(found, indent=1)}"


# --- what is left behind ----------------------------------------------------------------------------------------------


def test_closed_panels_leave_no_comm_behind(open_notebook, write_notebook):
    source = show(
        "from comm import get_comm_manager\ndef many():\n    for _ in range(20):\n        explore('J1', 3).close()\n"
        "    return len(get_comm_manager().comms)\nprint('left', many() - many())"
    )
    notebook = open_notebook(write_notebook("comms.ipynb", source))
    notebook.run_all()
    expect(notebook.output(1)).to_contain_text("left 0")
