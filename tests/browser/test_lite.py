"""JupyterLab in a browser alone, without a network: it starts, the course is there, and a notebook is answered by the kit.

What Pyodide has compiled for browsers, numpy, scipy, matplotlib and pillow, is to be had from its own server alone, so that
drawings and all that needs arrays are not tried here.
"""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from lsys_kit.classroom.course import course_files
from lsys_kit.classroom.lite.build import build_lite
from tests.browser.lab import OPENED, OpenNotebook
from tests.pyodide import pyodide_with_packages

pytestmark = [pytest.mark.slow, pytest.mark.browser]
LONG = 180_000
EXERCISES, LESSON = "exercises/01_all_at_once.ipynb", "notebooks/01_all_at_once.ipynb"
IDLE = "() => window.jupyterapp.shell.currentWidget.sessionContext.session.kernel.status === 'idle'"
CODE = """from lsys_kit import check, derive, progress, read, worksheet
print(derive(read("axiom: ar\\nar -> al br\\nal -> bl ar\\nbr -> ar\\nbl -> al"), 3)[3])
display(check("1.1", "al al br"))
worksheet("01", "counts")"""


class Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture(scope="module")
def address(pytestconfig: pytest.Config, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("lite")
    build_lite(folder, None, pyodide_with_packages(pytestconfig))
    config = json.loads((folder / "jupyter-lite.json").read_bytes())
    config["jupyter-config-data"]["exposeAppInBrowser"] = True
    (folder / "jupyter-lite.json").write_text(json.dumps(config))
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(folder)))
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    server.server_close()
    thread.join()


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1200, "height": 900})
    page = context.new_page()
    page.set_default_timeout(LONG)
    yield page
    context.close()


def opened(page: Page, address: str, name: str) -> OpenNotebook:
    page.goto(f"{address}lab/index.html?path={name}")
    page.wait_for_function(OPENED, arg=name)
    page.wait_for_function(IDLE)
    notebook = OpenNotebook(page)
    notebook.idle()
    return notebook


def test_the_course_is_there(page: Page, address: str) -> None:
    page.goto(f"{address}lab/index.html?path={LESSON}")
    expect(page.locator(".jp-Notebook h1").first).to_contain_text("All at once", timeout=LONG)
    shown = page.locator(".jp-DirListing-itemText")
    expect(shown.filter(has_text="18_your_own_plant")).to_be_visible(timeout=LONG)
    lessons = {Path(name).name for name in course_files() if name.startswith("notebooks/") and name.count("/") == 1}
    assert {*shown.all_inner_texts()} >= lessons


def test_the_kit_answers_in_a_notebook(page: Page, address: str, pytestconfig: pytest.Config) -> None:
    notebook = opened(page, address, EXERCISES)
    number = notebook.cells_showing("import")[0]
    notebook._ask(f"panel.content.model.sharedModel.cells[{number}].setSource(given);", CODE)
    notebook.run_all()
    assert notebook.cell_errors() == []
    shown = notebook.output(number)
    expect(shown).to_contain_text("al al br al br", timeout=30_000)
    expect(shown).to_contain_text("Almost")
    boxes = shown.locator("table input")
    for number in range(boxes.count()):
        boxes.nth(number).fill("5")
    shown.get_by_role("button", name="Check").click()
    expect(shown).to_contain_text("1 of 8 cells is right", timeout=30_000)
    if folder := pytestconfig.getoption("screenshots"):
        page.screenshot(path=Path(folder) / "lite.png")
