"""A class that is opened in a cell of JupyterLab: a phone joins by its QR code, and the board below the cell counts."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import axe_playwright_python
import pytest
from playwright.sync_api import Browser, expect

from tests.browser.homes import show
from tests.browser.lab import OpenNotebook
from tests.browser.test_class import kept, read_codes

pytestmark = [pytest.mark.slow, pytest.mark.browser]
AXE = Path(axe_playwright_python.__file__).parent / "axe.min.js"
CELLS = (
    show("open_class('10b', {folder!r}, port=0, course=False)"),
    "vote('01')",
    "predict('Step 3 is `al al br al br`. What is the word of step 4?', 'x')",
)


def run_cell(notebook: OpenNotebook, number: int) -> None:
    notebook._ask(f"panel.content.activeCellIndex = {number}; await app.commands.execute('notebook:run-cell'); await idle();")


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_a_class_below_a_cell(
    dark: bool,
    browser: Browser,
    open_notebook: Callable[..., OpenNotebook],
    write_notebook: Callable[..., str],
    tmp_path: Path,
    pytestconfig: pytest.Config,
) -> None:
    cells = [each.format(folder=str(tmp_path)) if "open_class" in each else each for each in CELLS]
    notebook = open_notebook(write_notebook("class.ipynb", *cells))
    theme = "JupyterLab Dark" if dark else "JupyterLab Light"
    notebook._ask(f"app.shell.collapseLeft(); await app.commands.execute('apputils:change-theme', {{theme: '{theme}'}});")
    try:
        _through_a_vote(notebook, browser, "dark" if dark else "light", pytestconfig)
    finally:
        notebook._ask("await app.commands.execute('apputils:change-theme', {theme: 'JupyterLab Light'});")


def _through_a_vote(notebook: OpenNotebook, browser: Browser, name: str, config: pytest.Config) -> None:
    page = notebook.page
    run_cell(notebook, 1)
    board = notebook.output(1).locator(".class-board")
    expect(board.locator(".board-letters")).to_have_text(re.compile(r"[A-Z]{4}"), timeout=60_000)
    code = board.locator(".board-letters").inner_text()
    page.wait_for_timeout(300)
    [joined] = read_codes(page)
    assert joined.endswith(f"/{code}/")
    notebook.shot(f"class-cell-join-{name}")
    phone = browser.new_context(viewport={"width": 400, "height": 800}, has_touch=True, is_mobile=True).new_page()
    try:
        phone.goto(re.sub(r"//[^:/]+", "//127.0.0.1", joined))
        expect(board.locator(".board-head")).to_contain_text("1 here")
        run_cell(notebook, 2)
        phone.locator(".choice").nth(2).tap()
        kept(phone)
        board = notebook.output(1).locator(".class-board")
        expect(board.locator(".board-count strong")).to_have_text("1")
        notebook.shot(f"class-cell-open-{name}")
        board.get_by_role("button", name="Show", exact=True).click()
        expect(board.locator(".board-bar strong")).to_have_text(["0", "0", "1", "0"])
        phone.locator(".choice").nth(1).tap()
        expect(board.locator(".board-bar strong")).to_have_text(["0", "1", "0", "0"])
        notebook.shot(f"class-cell-bars-{name}")
        board.locator("button", has_text="Hide").press("s")  # keys are heard where the board has the focus
        expect(board.locator(".board-bar")).to_have_count(0)
        assert axe(notebook) == []
        run_cell(notebook, 3)
        expect(phone.locator(".phone-kind")).to_have_text("Prediction")
        run_cell(notebook, 1)
        board = notebook.output(1).locator(".class-board")
        expect(board.locator(".board-kind")).to_contain_text("Prediction", timeout=60_000)
        expect(board.locator(".board-head")).to_contain_text(code)
        notebook.restart()
        expect(phone.locator("#link[data-there=false]")).to_be_visible(timeout=60_000)
        run_cell(notebook, 1)
        board = notebook.output(1).locator(".class-board")
        expect(board.locator(".board-head")).to_contain_text(code, timeout=60_000)
        expect(board.locator(".board-kind")).to_contain_text("Prediction", timeout=60_000)
        assert notebook.cell_errors() == []
    finally:
        phone.context.close()


def axe(notebook: OpenNotebook) -> list[Any]:
    notebook.page.evaluate(AXE.read_text("utf-8"))
    found = notebook.page.evaluate("axe.run('.class-board')")
    return [f"{each['id']}: {each['nodes'][0]['html'][:200]}" for each in found["violations"]]
