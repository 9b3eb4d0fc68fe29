"""The three in which a notebook of the kit is opened: JupyterLab, Notebook 7 and Voila."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page

from tests.browser.lab import Lab


def show(source: str) -> str:
    return f"from lsys_kit import *\n{source}"


def in_jupyterlab(page: Page, lab: Lab, name: str) -> None:
    page.goto(f"{lab.url}/lab/tree/{name}?reset")
    page.wait_for_function("window.jupyterapp?.shell?.currentWidget?.sessionContext?.session?.kernel?.status === 'idle'")
    page.evaluate("window.jupyterapp.commands.execute('notebook:run-all-cells')")


def in_notebook_7(page: Page, lab: Lab, name: str) -> None:
    page.goto(f"{lab.url}/notebooks/{name}")
    page.wait_for_function("window.jupyterapp?.shell?.currentWidget?.sessionContext?.session?.kernel?.status === 'idle'")
    page.evaluate("window.jupyterapp.commands.execute('notebook:run-all-cells')")


def in_voila(page: Page, lab: Lab, name: str) -> None:
    page.goto(f"{lab.url}/voila/render/{name}")


HOMES = pytest.mark.parametrize("home", [in_jupyterlab, in_notebook_7, in_voila], indirect=True, scope="module")
