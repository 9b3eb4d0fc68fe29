"""JupyterLab and what kernels are forked from once for all tests, Chromium once a file; each test opens notebooks of its own in
the tab of its file, of which nothing was answered before."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import nbformat
import pytest
from filelock import FileLock
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from playwright.sync_api import Browser, Page, expect, sync_playwright

from lsys_kit.classroom.course import course_files
from lsys_kit.classroom.lessons.kept import FILE
from lsys_kit.classroom.site.build import build_site
from tests.browser.homes import show
from tests.browser.lab import VIEWPORT, Lab, OpenNotebook, Tab, launched, started, tab_of
from tests.notebooks.kernels import ARE_FORKED, forked

expect.set_options(timeout=20_000)
ALWAYS = (
    "notebooks/gallery.html",
    "notebooks/00_five_characters_one_plant.html",
    "notebooks/01_all_at_once.html",
    "exercises/01_all_at_once.html",
)
"""The pages that tests without variants open."""


@pytest.fixture(scope="session")
def kernels(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Kernels that start at once, for all that Jupyter runs."""
    if not ARE_FORKED:
        yield
        return
    with forked(tmp_path_factory.mktemp("kernels")) as folder, pytest.MonkeyPatch.context() as patch:
        patch.setenv("JUPYTER_PATH", str(folder), prepend=os.pathsep)
        yield


@pytest.fixture(scope="session")
def lab(tmp_path_factory: pytest.TempPathFactory, kernels: None) -> Iterator[Lab]:
    with started(tmp_path_factory.mktemp("lab")) as running:
        yield running


@pytest.fixture(scope="session")
def site(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, kernels: None) -> Path:
    """The pages that the tests of this run open, in a thorough run the whole course; made once, for all processes."""
    asked = [
        item for item in request.session.items if "site" in getattr(item, "fixturenames", ()) and hasattr(item, "callspec")
    ]
    opened = {*ALWAYS, *(str(item.callspec.params.get("name")) for item in asked)}
    own = tmp_path_factory.getbasetemp()
    made = (own.parent if hasattr(request.config, "workerinput") else own) / "site"
    with FileLock(made.with_suffix(".lock")):
        if not made.exists():
            course, pages = tmp_path_factory.mktemp("course"), tmp_path_factory.mktemp("pages")
            for name, path in course_files().items():
                if name.replace(".ipynb", ".html") in opened:
                    (course / name).parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(path, course / name)
            build_site(pages, course)
            pages.rename(made)
    return made


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        running = launched(playwright)
        yield running
        running.close()


@pytest.fixture(scope="module")
def lab_tab(browser: Browser, lab: Lab, pytestconfig: pytest.Config) -> Tab:
    """The tab in which the tests of a file open one notebook after another."""
    return tab_of(browser, lab, _shots(pytestconfig))


@pytest.fixture
def open_notebook(
    browser: Browser, lab: Lab, lab_tab: Tab, pytestconfig: pytest.Config
) -> Iterator[Callable[..., OpenNotebook]]:
    """Opens a notebook of the course: `open_notebook("notebooks/01_all_at_once.ipynb")`; in a tab of its own if it asks for a
    context of its own, as for `device_scale_factor=2`."""
    used, own = [], []

    def open_one(name: str, viewport: Mapping[str, int] = VIEWPORT, **context: Any) -> OpenNotebook:
        if context:
            own.append(tab_of(browser, lab, _shots(pytestconfig), **context))
        (lab.folder / FILE).unlink(missing_ok=True)
        used.append((own[-1] if context else lab_tab).open(name, viewport))
        return used[-1]

    yield open_one
    for notebook in used:
        notebook.close()
    for tab in own:
        tab.page.context.close()


def _shots(config: pytest.Config) -> Path | None:
    folder = config.getoption("screenshots")
    return Path(folder) if folder else None


@pytest.fixture(scope="session")
def write_notebook(lab: Lab) -> Callable[..., str]:
    """Writes a notebook of a title and some code cells into the course: `write_notebook("name.ipynb", "1 + 1")`."""

    def written(name: str, *sources: str, tags: tuple[str, ...] = ()) -> str:
        cells = [new_markdown_cell("# Title"), *(new_code_cell(source, metadata={"tags": list(tags)}) for source in sources)]
        kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3 (ipykernel)", "language": "python"}}
        (lab.folder / "notebooks" / name).write_text(nbformat.writes(new_notebook(cells=cells, metadata=kernel)))
        return f"notebooks/{name}"

    return written


@pytest.fixture(scope="module")
def open_at_home(
    browser: Browser, lab: Lab, write_notebook: Callable[..., str], pytestconfig: pytest.Config
) -> Iterator[Callable[..., Page]]:
    """Opens a notebook in JupyterLab, Notebook 7 or Voila; of each a picture is kept at the end."""
    pages: list[tuple[Page, str]] = []

    def open_one(
        home: Callable[[Page, Lab, str], None], *sources: str, name: str = "panel", viewport: Mapping[str, int] = VIEWPORT
    ) -> Page:
        (lab.folder / FILE).unlink(missing_ok=True)
        page = browser.new_context(viewport={"width": viewport["width"], "height": viewport["height"]}).new_page()
        pages.append((page, f"{name}-{home.__name__}"))
        home(page, lab, write_notebook(f"{name}_{home.__name__}.ipynb", *map(show, sources)))
        return page

    yield open_one
    for page, name in pages:
        if folder := _shots(pytestconfig):
            folder.mkdir(parents=True, exist_ok=True)
            page.screenshot(path=folder / f"{name}.png")
        page.context.close()


@pytest.fixture(scope="module")
def panel_tab(browser: Browser) -> Any:
    """A tab in which the tests of a file open one panel after another."""
    from tests.classroom.panel_page import open_tab

    return open_tab(browser)


@pytest.fixture
def explored(browser: Browser, panel_tab: Any) -> Iterator[Callable[..., Any]]:
    """Opens a panel in a page without Jupyter: `explored("J4", 9, dark=True, context={"has_touch": True})`.

    The first of a test is opened in the tab of the file, unless it asks for a context of its own.
    """
    from lsys_kit import explore
    from tests.classroom.panel_page import open_panel, open_tab

    panels, own = [], []

    def open_one(*what: Any, dark: bool = False, context: Mapping[str, Any] | None = None, **choices: Any) -> Any:
        if panels or context is not None:
            own.append(open_tab(browser, **(context or {})))
        panels.append(open_panel(own[-1] if own else panel_tab, explore(*what, **choices), dark))
        return panels[-1]

    yield open_one
    for tab in own:
        tab.page.context.close()
    for each in panels:
        assert each.errors == []
