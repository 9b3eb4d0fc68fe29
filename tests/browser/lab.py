"""A real JupyterLab on the course, and a notebook opened in it by a real browser."""

from __future__ import annotations

import contextlib
import json
import os
import re
import shutil
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Error, Locator, Page, Playwright

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
SOFTWARE = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
"""Where there is no graphics processor, one that is computed (SwiftShader)."""
SECONDS = 120
"""How long anything may take on a slow machine."""
VIEWPORT = {"width": 1400, "height": 1000}
NOISE = re.compile(
    r"favicon|ResizeObserver loop|/api/(me|terminals|kernels|sessions|contents)|/lsp/|net::ERR_ABORTED|@jupyterlite/services"
)
"""What JupyterLab itself may write to the console, also of an extension for JupyterLite alone, which lies beside the others."""

OPENED = """name => {
    const panel = window.jupyterapp?.shell?.currentWidget;
    return panel?.context?.path === name && panel.sessionContext?.session?.kernel != null;
}"""
"""Whether a notebook is open, with a kernel."""
CELL = 'css:light=.jp-Notebook .jp-Cell[data-windowed-list-index="{}"]'
"""A cell of a notebook, found without a look into the shadow of each of the five thousand elements of a page."""
CONFIGURATION = {
    "ServerApp": {"ip": "127.0.0.1", "port_retries": 0, "open_browser": False, "log_level": "WARN"},
    "IdentityProvider": {"token": ""},
    "LabApp": {"expose_app_in_browser": True, "extension_manager": "readonly"},
    "JupyterNotebookApp": {"expose_app_in_browser": True},
}
SETTINGS = {
    "apputils-extension/notification": {"fetchNews": "false", "checkForUpdates": False, "doNotDisturbMode": True},
    "docmanager-extension/plugin": {"autosave": False},
}


@dataclass(frozen=True)
class Lab:
    """A running JupyterLab: its address, and the folder with the course that it shows."""

    url: str
    folder: Path


@contextlib.contextmanager
def started(home: Path) -> Iterator[Lab]:
    """JupyterLab as `lsys-kit lab` starts it, on a course in a new folder, with nothing of the user's own settings."""
    url, log = f"http://127.0.0.1:{_free_port()}", home / "log.txt"
    folder = home / "course"
    with log.open("wb") as out:
        process = subprocess.Popen(
            [sys.executable, "-m", "lsys_kit", "lab", str(folder)],
            env=_environment(home, url),
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=out,
            cwd=home,
        )
        try:
            _await(url, process, log)
            yield Lab(url, folder)
        finally:
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def launched(playwright: Playwright, graphics: bool = False) -> Browser:
    """The machine's Chromium or Chrome, else the one that playwright brings; perhaps with computed graphics."""
    flags = [*(each for each in FLAGS if each != "--disable-gpu"), *SOFTWARE] if graphics else FLAGS
    installed = next(filter(None, map(shutil.which, BROWSERS)), None)
    if installed:
        return playwright.chromium.launch(executable_path=installed, args=flags)
    try:
        return playwright.chromium.launch(args=flags)
    except Error:
        subprocess.run([sys.executable, "-m", "playwright", "install", "chromium"], check=False, timeout=600)
    try:
        return playwright.chromium.launch(args=flags)
    except Error as fault:
        raise RuntimeError(
            "There is no browser for these tests. Install Chromium or Chrome (on Debian: apt-get install "
            f"chromium), or see why playwright's own does not start: {fault}"
        ) from None


@dataclass
class OpenNotebook:
    """A notebook in a browser's tab.

    Attributes
    ----------
    page
        The tab, for whatever playwright can do.
    console
        The errors in the browser's console so far that are not JupyterLab's own.
    shots
        Where `shot` puts its pictures, or None to take none.
    """

    page: Page
    shots: Path | None = None
    console: list[str] = field(default_factory=list)

    def run_all(self) -> None:
        """Run all cells, from a fresh kernel, until the kernel is idle."""
        self._ask("await app.commands.execute('notebook:run-all-cells'); await idle();")

    def reload(self) -> None:
        """Save the notebook and load the page anew, while the kernel lives on."""
        path = self._ask("await panel.context.save(); return panel.context.path;")
        self.page.reload()
        self.page.wait_for_function(OPENED, arg=path)
        self.idle()

    def restart(self) -> None:
        """Restart the kernel, which forgets all that it knew."""
        self._ask("await panel.sessionContext.session.kernel.restart(); await idle();")

    def idle(self) -> None:
        """Wait until the kernel has nothing to do."""
        self._ask("await idle();")

    def run_by_key(self, keys: str = "Shift+Enter") -> None:
        """Run the cell in which the cursor stands, until it has been run and the kernel is idle."""
        number = self._ask("panel.content.activeCell.model.executionCount = null; return panel.content.activeCellIndex;")
        self.page.keyboard.press(keys)
        self._ask("while (panel.content.widgets[given].model.executionCount === null) await wait(20); await idle();", number)

    def cell_errors(self) -> list[str]:
        """What went wrong in cells that are not tagged raises-exception, and what never ran."""
        return [
            str(text)
            for text in self._ask("""
            const wrong = [];
            panel.content.model.sharedModel.cells.forEach((cell, number) => {
                if (cell.cell_type !== 'code' || !cell.getSource().trim()) return;
                const expected = (cell.getMetadata('tags') || []).includes('raises-exception');
                const errors = cell.getOutputs().filter(output => output.output_type === 'error');
                for (const error of expected ? [] : errors) wrong.push(`cell ${number}: ${error.ename}: ${error.evalue}`);
                if (cell.execution_count === null) wrong.push(`cell ${number} did not run`);
            });
            return wrong;""")
        ]

    def cell(self, number: int) -> Locator:
        """A cell, counted from 0, scrolled into view."""
        self._ask(f"panel.content.activeCellIndex = {number}; await panel.content.scrollToItem({number}, 'start');")
        return self.page.locator(CELL.format(number))

    def output(self, number: int) -> Locator:
        """What a cell shows, scrolled into view."""
        self.cell(number)
        return self.page.locator(f"{CELL.format(number)} .jp-Cell-outputWrapper")

    def cells_showing(self, text: str) -> list[int]:
        """The numbers of the cells of code whose source holds a text."""
        return [
            int(n)
            for n in self._ask(
                "return panel.content.model.sharedModel.cells.map((cell, n) => "
                "cell.cell_type === 'code' && cell.getSource().includes(given) ? n : -1)"
                ".filter(n => n >= 0);",
                text,
            )
        ]

    def hide_file_browser(self) -> None:
        """Give the notebook the whole width, as on a narrow screen."""
        self._ask("app.shell.collapseLeft();")

    def shot(self, name: str) -> None:
        """Take a picture of the tab, if pytest was given a folder with `--screenshots`."""
        if self.shots:
            self.shots.mkdir(parents=True, exist_ok=True)
            self.page.screenshot(path=self.shots / f"{name}.png")

    def close(self) -> None:
        """End the kernel, and close the notebook without saving; the tab stays."""
        for ending in ("await panel.sessionContext.shutdown();", "panel.dispose();"):
            with contextlib.suppress(Error):
                self._ask(ending)

    def _ask(self, code: str, given: Any = None) -> Any:
        """Run JavaScript with JupyterLab as `app` and the notebook as `panel`."""
        return self.page.evaluate(
            """async ([code, given]) => {
            const app = window.jupyterapp, panel = app.shell.currentWidget;
            const wait = ms => new Promise(done => setTimeout(done, ms));
            const idle = async () => {
                for (let quiet = 0; quiet < 3; await wait(30))
                    quiet = panel.sessionContext.session?.kernel?.status === 'idle' ? quiet + 1 : 0;
            };
            const AsyncFunction = (async () => {}).constructor;
            return await new AsyncFunction('app', 'panel', 'wait', 'idle', 'given', code)(app, panel, wait, idle, given);
        }""",
            [code, given],
        )


@dataclass
class Tab:
    """JupyterLab in a tab of a browser, in which one notebook after another is opened."""

    page: Page
    lab: Lab
    shots: Path | None = None
    notebook: OpenNotebook | None = None

    def open(self, name: str, viewport: Mapping[str, int] = VIEWPORT) -> OpenNotebook:
        """Open a notebook of the course, with its kernel started and idle, in a window of some size.

        Its name is that from the folder of the course: "notebooks/01_all_at_once.ipynb".
        """
        self.notebook = OpenNotebook(self.page, self.shots)
        self.page.set_viewport_size({"width": viewport["width"], "height": viewport["height"]})
        if not self.page.evaluate("'jupyterapp' in window"):
            self.page.goto(f"{self.lab.url}/lab/tree/{name}?reset")
        else:
            self.page.mouse.move(0, 0)
            self.page.evaluate(
                """async name => {
                window.jupyterapp.shell.expandLeft();
                await window.jupyterapp.commands.execute('docmanager:open', { path: name });
            }""",
                name,
            )
        self.page.wait_for_function(OPENED, arg=name)
        self.notebook.idle()
        return self.notebook


def tab_of(browser: Browser, lab: Lab, shots: Path | None = None, **context: Any) -> Tab:
    """A tab for JupyterLab, with choices for playwright's `new_context`."""
    return tab_in(browser.new_context(**{"viewport": VIEWPORT, **context}), lab, shots)


def tab_in(context: BrowserContext, lab: Lab, shots: Path | None = None) -> Tab:
    """Another tab of a browser that is open."""
    page = context.new_page()
    page.set_default_timeout(SECONDS * 1000)
    tab = Tab(page, lab, shots)
    page.on("console", lambda message: _note(tab.notebook, message) if tab.notebook else None)
    page.on("pageerror", lambda error: tab.notebook.console.append(f"{error}") if tab.notebook else None)
    return tab


def _note(notebook: OpenNotebook, message: ConsoleMessage) -> None:
    """Keep an error of the console, unless it is one of JupyterLab's own."""
    text = f"{message.text} ({message.location.get('url', '')})"
    if message.type == "error" and not NOISE.search(text):
        notebook.console.append(text)


def _free_port() -> int:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return int(found.getsockname()[1])


def _environment(home: Path, url: str) -> dict[str, str]:
    """Jupyter's folders, all of them below `home`; its settings written there."""
    folders = {f"JUPYTER_{name}_DIR": home / name.lower() for name in ("CONFIG", "DATA", "RUNTIME")}
    folders |= {f"JUPYTERLAB_{name}_DIR": home / name.lower() for name in ("SETTINGS", "WORKSPACES")}
    folders["IPYTHONDIR"] = home / "ipython"
    settings = {home / "settings" / "@jupyterlab" / f"{name}.jupyterlab-settings": value for name, value in SETTINGS.items()}
    port = {"port": int(url.rsplit(":", 1)[1])}
    settings[home / "config" / "jupyter_server_config.json"] = {
        **CONFIGURATION,
        "ServerApp": {**CONFIGURATION["ServerApp"], **port},
    }
    for path, value in settings.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(value))
    return {**os.environ, **{name: str(path) for name, path in folders.items()}}


def _await(url: str, process: subprocess.Popen[bytes], log: Path) -> None:
    """Wait until the server answers."""
    end = time.monotonic() + SECONDS
    while time.monotonic() < end and process.poll() is None:
        with contextlib.suppress(OSError), urllib.request.urlopen(f"{url}/api", timeout=5):
            return
        time.sleep(0.1)
    raise RuntimeError(f"JupyterLab did not start:\n{log.read_text(errors='replace')[-3000:]}")
