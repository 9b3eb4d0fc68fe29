"""Walk, unfolding and sample for everyone: axe finds nothing while they are on their way, on screens and phones."""

from __future__ import annotations

from pathlib import Path

import axe_playwright_python
import pytest
from playwright.sync_api import expect

AXE = Path(axe_playwright_python.__file__).parent / "axe.min.js"
SHOWN = ["word", "rules", "stages", "drawing", "walk", "unfolding", "sample"]
FOUND = """async () => {
  const { violations, incomplete } = await axe.run(document.querySelector(".lsys-panel"));
  return [...violations, ...incomplete.filter(({ id }) => id !== "color-contrast")] // which axe cannot tell of a single letter
    .map((each) => [each.id, ...each.nodes.map((node) => node.html.slice(0, 200))]);
}"""
PLANTS = {
    "in the plane": "angle: 25\naxiom: F\nF -> F[+F]F[-F]F : 1/2\nF -> F[+F] : 1/2",
    "in space": "angle: 25\naxiom: A\nA -> F[&A]/(120)[&A] : 1/2\nA -> F[&A] : 1/2",
}


def motion_seen(panel):
    """A turtle waits, a step is on its way, and of ten plants the mean, what is exact and the first throw are seen."""
    for _ in range(3):
        panel.at("[data-view=walk]").get_by_role("button", name="one stride on").click()
    expect(panel.at("[data-view=walk] .lsys-caption[role=status]")).to_contain_text("3 of ")
    panel.control("unfolding").press("ArrowRight")
    expect(panel.at("[data-view=unfolding] .lsys-caption[role=status]")).to_contain_text("5 of 100 on the way")
    sample = panel.at("[data-view=sample]")
    for name in ("ten more plants", "the exact mean and the exact distribution", "colour the plants by what was thrown first"):
        sample.get_by_role("button", name=name).or_(sample.get_by_title(name)).first.click()
    expect(sample.locator(".lsys-caption[role=status]")).to_contain_text("Exactly: ")


@pytest.mark.browser
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1440, 400])
@pytest.mark.parametrize("plant", PLANTS)
def test_axe_finds_nothing_in_walk_unfolding_and_sample(explored, plant, width, scheme):
    context = {"viewport": {"width": width, "height": 860}, "color_scheme": scheme}
    panel = explored(PLANTS[plant], 1, show=SHOWN, context=context)
    motion_seen(panel)
    panel.page.evaluate(AXE.read_text("utf-8"))
    assert panel.page.evaluate(FOUND) == []
