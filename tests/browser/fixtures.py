"""JupyterLab once for all browser tests, Chromium once a file, a notebook in a tab of its own for each test."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from playwright.sync_api import Browser, expect, sync_playwright

from tests.browser.lab import Lab, OpenNotebook, launched, opened, started

expect.set_options(timeout=20_000)


@pytest.fixture(scope="session")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    with started(tmp_path_factory.mktemp("lab")) as running:
        yield running


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        running = launched(playwright)
        yield running
        running.close()


@pytest.fixture
def open_notebook(browser: Browser, lab: Lab, pytestconfig: pytest.Config) -> Iterator[Callable[..., OpenNotebook]]:
    """Opens a notebook of the course: `open_notebook("notebooks/01_all_at_once.ipynb")`."""
    folder, tabs = pytestconfig.getoption("screenshots"), []

    def open_one(name: str, **context: Any) -> OpenNotebook:
        tabs.append(opened(browser, lab, name, Path(folder) if folder else None, **context))
        return tabs[-1]

    yield open_one
    for tab in tabs:
        tab.close()


@pytest.fixture
def write_notebook(lab: Lab) -> Callable[..., str]:
    """Writes a notebook of a title and some code cells into the course: `write_notebook("name.ipynb", "1 + 1")`."""

    def written(name: str, *sources: str, tags: tuple[str, ...] = ()) -> str:
        cells = [new_markdown_cell("# Title"), *(new_code_cell(source, metadata={"tags": list(tags)}) for source in sources)]
        kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3 (ipykernel)", "language": "python"}}
        (lab.folder / "notebooks" / name).write_text(nbformat.writes(new_notebook(cells=cells, metadata=kernel)))
        return f"notebooks/{name}"

    return written


@pytest.fixture
def explored(browser: Browser) -> Iterator[Callable[..., Any]]:
    """Opens a panel in a page without Jupyter: `explored("J4", 9, dark=True, context={"has_touch": True})`."""
    from lsys_kit import explore
    from tests.classroom.panel_page import open_panel

    pages = []

    def open_one(*what: Any, dark: bool = False, context: Mapping[str, Any] | None = None, **choices: Any) -> Any:
        pages.append(open_panel(browser, explore(*what, **choices), dark, **(context or {})))
        return pages[-1]

    yield open_one
    for each in pages:
        assert each.errors == []
        each.page.context.close()
