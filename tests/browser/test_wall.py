"""Everybody's plants on one page in a real browser: it fits, it asks for nothing, and nothing of a name or a model runs."""

from __future__ import annotations

import json
from pathlib import Path

import axe_playwright_python
import pytest
from playwright.sync_api import Browser, expect

from lsys_kit import link, map_system, read, system
from lsys_kit.__main__ import main

pytestmark = pytest.mark.slow
AXE = Path(axe_playwright_python.__file__).parent / "axe.min.js"
MANY_STROKES = link(read("angle: 25\naxiom: F\nF -> F[+F]F[-F]F"), {"step": 5})
LINKS = {
    "Ann": link(system("K5")),
    "<img src=x onerror=alert(1)>": link(system("J4")),
    "Bea": link(map_system("K28")),
    "Cleo": MANY_STROKES,
    "</title><script>alert(2)</script>": "#lsys=a<script>alert(3)</script>",
    "x" * 70: "#lsys=aaaa",
}


@pytest.fixture(scope="module")
def wall(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wall")
    (folder / "in").mkdir()
    lines = [f"{name}: {address}" for name, address in LINKS.items()]
    (folder / "in" / "links.txt").write_text("\n".join(lines), encoding="utf-8")
    (folder / "in" / "bad.txt").write_text("axiom: F\nF -> <script>alert(4)</script>", encoding="utf-8")
    assert main(["wall", str(folder / "in"), "-o", str(folder / "wall.html")]) == 0
    return folder / "wall.html"


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [400, 1440])
def test_a_wall_fits_asks_for_nothing_and_runs_nothing(wall, browser: Browser, width: int, scheme: str, pytestconfig) -> None:
    asked: list[str] = []
    faults: list[str] = []
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
    page = context.new_page()
    page.on("request", lambda request: asked.append(request.url.partition(",")[0]))
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on("console", lambda message: faults.append(message.text))
    page.on("dialog", lambda dialog: (faults.append(dialog.message), dialog.dismiss()))
    page.goto(wall.as_uri())
    expect(page.get_by_role("figure")).to_have_count(len(LINKS) + 1)
    page.wait_for_function("[...document.images].every((each) => each.complete && each.naturalWidth > 0)")
    assert page.evaluate("document.images.length") == 4
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    page.get_by_text("Rules").first.click()
    expect(page.locator("details[open] pre")).to_be_visible()
    page.evaluate(AXE.read_text(encoding="utf-8"))
    found = page.evaluate("""async () => (await axe.run()).violations
        .filter(({ impact }) => impact === "critical" || impact === "serious")
        .map((each) => [each.id, ...each.nodes.slice(0, 3).map((node) => node.html.slice(0, 200))])""")
    assert found == [], json.dumps(found, indent=1)
    if pytestconfig.getoption("screenshots"):
        page.screenshot(path=Path(pytestconfig.getoption("screenshots")) / f"wall-{width}-{scheme}.png", full_page=True)
    context.close()
    assert faults == []
    assert {*asked} <= {wall.as_uri(), "data:image/svg+xml;base64", "data:image/png;base64", "data:"}
