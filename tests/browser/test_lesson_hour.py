"""What happens in every lesson hour: rules are taken back, Python is busy or restarted, a cell is run again and again."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.homes import in_jupyterlab, in_notebook_7, show
from tests.browser.lab import OpenNotebook

pytestmark = [pytest.mark.slow, pytest.mark.browser]
ALGA = "axiom: a\na -> a b\nb -> a"
RUN = "panel.content.activeCellIndex = {}; await app.commands.execute('notebook:run-cell');"


def panel_of(page: Page) -> Locator:
    return page.locator(".lsys-panel").first


def rules_of(panel: Locator) -> Locator:
    tab = panel.locator(".lsys-tabs").get_by_role("button", name="rules", exact=True)
    if tab.get_attribute("aria-pressed") == "false":
        tab.click()
    return panel.get_by_label("rules of the model")


@pytest.fixture
def shown(open_notebook: Callable[..., OpenNotebook], write_notebook: Callable[..., str]) -> Callable[..., OpenNotebook]:
    """Opens a notebook of some cells, and runs the first."""

    def run(name: str, *sources: str) -> OpenNotebook:
        notebook = open_notebook(write_notebook(name, *map(show, sources)))
        notebook._ask("app.shell.collapseLeft();" + RUN.format(1) + "await idle();")
        expect(panel_of(notebook.page).locator("canvas[data-drawn]").first).to_be_visible()
        return notebook

    return run


@pytest.mark.parametrize("home", [in_jupyterlab, in_notebook_7])
def test_rules_are_taken_back_by_keys_in_every_home(open_at_home, home) -> None:
    page = open_at_home(home, "explore('K5', 2)", name="undo")
    panel = panel_of(page)
    expect(panel.locator("canvas[data-drawn]").first).to_be_visible(timeout=90_000)
    rules = rules_of(panel)
    first = rules.input_value()
    rules.fill(ALGA)
    expect(panel.locator(".lsys-status")).to_contain_text("3 letters")
    rules.press("Control+End")
    page.keyboard.type(" b")
    for keys, text in (("Control+z", ALGA), ("Control+z", first), ("Control+y", ALGA), ("Control+Shift+z", f"{ALGA} b")):
        page.keyboard.press(keys)
        expect(rules).to_have_value(text)
    expect(panel.locator(".lsys-status")).to_contain_text("4 letters")
    panel.get_by_role("button", name="back to the first rules").click()
    expect(rules).to_have_value(first)
    panel.get_by_role("button", name="undo", exact=True).click()
    expect(rules).to_have_value(f"{ALGA} b")


def test_what_was_typed_is_offered_again_after_a_restart(shown) -> None:
    notebook = shown("restarted.ipynb", "explore('J4', 9)")
    panel = panel_of(notebook.page)
    rules = rules_of(panel)
    first = rules.input_value()
    rules.fill(ALGA)
    expect(panel.locator(".lsys-status")).to_contain_text("of 2 stages")
    notebook._ask("await panel.sessionContext.session.kernel.restart();")
    rules.fill(f"{ALGA} b")
    expect(panel).to_contain_text("The kernel does not answer. Restart it and run the cell again")
    notebook._ask("await idle();" + RUN.format(1) + "await idle();")
    panel = panel_of(notebook.page)
    offer = panel.locator(".lsys-offer")
    expect(offer).to_contain_text("You had changed the rules here.")
    notebook.shot("offered")
    assert rules_of(panel).input_value() == first
    offer.get_by_role("button", name="take up my rules").click()
    expect(offer).to_be_hidden()
    expect(rules_of(panel)).to_have_value(f"{ALGA} b")
    expect(panel.locator(".lsys-status")).to_contain_text("of 2 stages")
    panel.get_by_role("button", name="back to the first rules").click()
    notebook._ask(RUN.format(1) + "await idle();")
    expect(panel_of(notebook.page).locator("canvas[data-drawn]").first).to_be_visible()
    expect(panel_of(notebook.page).locator(".lsys-offer")).to_be_hidden()
    assert notebook.console == []


def test_each_panel_of_a_notebook_keeps_its_own_rules(shown) -> None:
    """Also where two have the same rules at first, and where a panel that lives on is shown in another tab."""
    notebook = shown("two.ipynb", "explore('J4', 9)", "explore('J4', 9)")
    notebook.page.set_viewport_size({"width": 1400, "height": 4000})  # Jupyter keeps what is out of sight out of the page
    notebook._ask(RUN.format(2) + "await idle();")
    panels = notebook.page.locator(".lsys-panel")
    expect(panels).to_have_count(2)
    texts = [f"{ALGA} {letter}" for letter in "ab"]
    for number, text in enumerate(texts):
        rules_of(panels.nth(number)).fill(text)
        expect(panels.nth(number).locator(".lsys-status")).to_contain_text("of 2 stages")
    rules_of(panels.nth(1)).fill(f"{ALGA} (")
    expect(panels.nth(1).locator(".lsys-mistake")).to_contain_text("Line 3")
    notebook.reload()
    expect(rules_of(panels.nth(0))).to_have_value(texts[0])
    expect(panels.nth(0).locator(".lsys-offer")).to_be_hidden()
    panels.nth(1).get_by_role("button", name="take up my rules").click()
    expect(rules_of(panels.nth(1))).to_have_value(f"{ALGA} (")
    notebook.restart()
    for cell in (1, 2):
        notebook._ask(RUN.format(cell) + "await idle();")
    for number, text in enumerate([texts[0], f"{ALGA} ("]):
        panels.nth(number).get_by_role("button", name="take up my rules").click()
        expect(rules_of(panels.nth(number))).to_have_value(text)
    assert notebook.console == []


def test_the_word_that_python_has_ended_stays(shown) -> None:
    notebook = shown("ended.ipynb", "explore('K5', 3)")
    panel = panel_of(notebook.page)
    notebook._ask("await panel.sessionContext.session.kernel.restart();")
    expect(panel).to_contain_text("The kernel does not answer")
    notebook._ask("await app.commands.execute('apputils:change-theme', { theme: 'JupyterLab Dark' });")
    expect(notebook.page.locator("body")).to_have_attribute("data-jp-theme-light", "false")
    notebook.page.wait_for_timeout(500)
    expect(panel).to_contain_text("The kernel does not answer")
    notebook._ask("await app.commands.execute('apputils:change-theme', { theme: 'JupyterLab Light' });")


def test_a_busy_kernel_is_shown_as_busy_and_the_last_question_wins(shown) -> None:
    notebook = shown("busy.ipynb", "panel = explore('J4', 9)\npanel", "import time\ntime.sleep(25)")
    panel = panel_of(notebook.page)
    rules = rules_of(panel)
    notebook._ask("panel.content.activeCellIndex = 2; app.commands.execute('notebook:run-cell');")
    notebook.page.wait_for_function("window.jupyterapp.shell.currentWidget.sessionContext.session.kernel.status === 'busy'")
    for word in ("b", "bc", "bcd"):
        rules.fill(f"axiom: a\na -> {word}")
        notebook.page.wait_for_timeout(400)
    expect(panel).to_have_attribute("aria-busy", "true")
    expect(panel).to_contain_text("Python is busy.")
    notebook.shot("busy")
    notebook.page.wait_for_timeout(21_500)  # longer than a kernel is waited for that does nothing
    expect(panel).not_to_contain_text("The kernel does not answer")
    expect(panel.locator(".lsys-word")).to_have_text("bcd")
    expect(panel).to_have_attribute("aria-busy", "false")
    expect(panel).not_to_contain_text("Python is busy.")
    assert notebook.console == []


RUNS, MOST = 40, 100_000
"""How often a cell is run, and how many bytes of the browser's memory each run may keep."""


def test_a_cell_that_is_run_again_and_again_keeps_little_of_the_browsers_memory(shown) -> None:
    notebook = shown("again.ipynb", "explore('J4', 9)")
    session = notebook.page.context.new_cdp_session(notebook.page)

    def held() -> int:
        for _ in range(3):
            session.send("HeapProfiler.collectGarbage")
            notebook.page.wait_for_timeout(300)
        return int(session.send("Runtime.getHeapUsage")["usedSize"])

    def run(times: int) -> None:
        for _ in range(times):
            notebook._ask(RUN.format(1) + "await idle();")
            expect(panel_of(notebook.page).locator("canvas[data-drawn]").first).to_be_visible()

    run(5)
    before = held()
    run(RUNS)
    kept = (held() - before) / RUNS
    assert kept < MOST
