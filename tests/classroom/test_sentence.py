"""The sentence above a panel: its numbers are moved where they stand, and those that are counted follow."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from lsys_kit import LSystemError, ModelNameError, ModelValueError, derive, explore, read, system
from tests.browser.hands import Finger, Mouse
from tests.classroom.test_letters_in_panel import PHONE, findings

SPANS = (
    "A lives {{lifeTimeA}} steps and B {{lifeTimeB}}. After {{step}} steps there are {{cells}} cells, {{Al}} of them {{ Al }}."
)


def read_out(page: Page) -> str:
    """The sentence as it is read, with what stands in its boxes."""
    text = "node => [...node.childNodes].map(each => each.querySelector?.('input')?.value ?? each.textContent).join('')"
    return str(page.locator(".lsys-says").evaluate(text))


def box(page: Page, name: str) -> Locator:
    return page.locator(".lsys-says").get_by_label(f"{name}: drag it, type it, or use the arrow keys")


def test_it_is_read_where_nothing_moves() -> None:
    panel = explore("J4", 9, sentence=SPANS)
    made = derive(system("J4"), 9)[9].counts()
    said = f"A lives 3 steps and B 2. After 9 steps there are 9 cells, {made['Al']} of them {made['Al']}. Step 9: "
    assert panel.text.startswith(said)
    panel.lifeTimeA = 1
    assert panel.text.startswith("A lives 1 steps")


@pytest.mark.parametrize(
    ("sentence", "kind", "says"),
    [
        ("{{stepp}} steps", ModelNameError, "step"),
        ("{{}}", ModelNameError, "Such names are: step, angle, lifeTimeA, lifeTimeB"),
        (3, ModelValueError, "A sentence"),
    ],
)
def test_names_without_a_number_are_refused(sentence: Any, kind: type[LSystemError], says: str) -> None:
    with pytest.raises(kind, match=says):
        explore("J4", sentence=sentence)


def test_braces_that_name_nothing_are_text() -> None:
    assert explore("J4", 0, sentence="{a} {{step}} {").text.startswith("{a} 0 { Step 0: ")


def test_of_maps_what_moves_can_be_named() -> None:
    assert explore("K28", 1, sentence="Pressure {{pressure}}.").text.startswith("Pressure ")
    with pytest.raises(ModelNameError):
        explore("K28", sentence="{{cells}}")


@pytest.mark.parametrize("touch", [False, True])
def test_a_number_is_dragged(explored: Any, touch: bool) -> None:
    panel = explored("J4", 9, sentence=SPANS, context=PHONE if touch else {})
    hand, place = (Finger if touch else Mouse)(panel.page), box(panel.page, "step").bounding_box()
    assert place
    x, y = place["x"] + place["width"] / 2, place["y"] + place["height"] / 2
    with hand.pressed(x, y) as move:
        move(x - 26, y)
    made = derive(system("J4"), 5)[5].counts()
    said = f"A lives 3 steps and B 2. After 5 steps there are {sum(made.values())} cells, {made['Al']} of them {made['Al']}."
    expect(panel.at(".lsys-status")).to_contain_text("step 5")
    assert read_out(panel.page) == said


def test_a_number_is_typed_and_set_by_keys(explored: Any) -> None:
    panel = explored("J4", 9, sentence=SPANS)
    life = box(panel.page, "lifeTimeA")
    life.click()
    life.press("1")
    life.press("Enter")
    expect(panel.control("lifeTimeA")).to_have_attribute("aria-valuetext", "1")
    life.press("ArrowUp")
    made = derive(system("J4"), 9, lifeTimeA=2)[9].counts()
    expect(panel.at(".lsys-says")).to_contain_text(f"there are {sum(made.values())} cells")
    panel.control("step").press("Home")
    expect(box(panel.page, "step")).to_have_value("0")
    life.fill("400")
    life.press("Enter")
    expect(panel.at(".lsys-says .lsys-refused").first).to_have_text("1 to 6")


def test_it_follows_rules_that_are_typed(explored: Any) -> None:
    algae = "axiom: a\na -> ab\nb -> a"
    panel = explored(algae, 4, sentence="Step {{step}}: {{b}} b of {{letters}}.", show=["rules", "word", "drawing"])
    assert read_out(panel.page) == "Step 4: 3 b of 8."
    panel.page.get_by_label("rules of the model").fill("axiom: a\na -> abb\nb -> a")
    made = derive(read("axiom: a\na -> abb\nb -> a"), 4)[4].counts()
    expect(panel.at(".lsys-says")).to_contain_text(f"{made['b']} b of {sum(made.values())}.")


@pytest.mark.parametrize("dark", [False, True])
def test_it_can_be_read_and_told(explored: Any, dark: bool) -> None:
    assert findings(explored("J4", 9, sentence=SPANS, dark=dark).page) == []


def test_a_page_has_it_too(browser: Browser, tmp_path: Path) -> None:
    explore("J4", 9, sentence=SPANS).save(tmp_path / "panel.html")
    page = browser.new_page()
    page.goto((tmp_path / "panel.html").as_uri())
    box(page, "lifeTimeA").press("ArrowDown")
    made = derive(system("J4"), 9, lifeTimeA=2)[9].counts()
    expect(page.locator(".lsys-says")).to_contain_text(f"there are {sum(made.values())} cells")
    page.close()
    assert "lsys-says" not in explore("J4", 9)._page()
