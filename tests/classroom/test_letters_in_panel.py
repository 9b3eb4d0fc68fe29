"""Letters in the panel: formulas in its word, its stages and what is told of a module; the drawing goes on with numbers."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import axe_playwright_python
import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from lsys_kit import ModelNameError, explore, linked, read
from lsys_kit.classroom.catalogue import system
from lsys_kit.classroom.panel.books.book import book
from lsys_kit.classroom.panel.page import page as page_of
from tests.browser.hands import Finger, Mouse, Pointer, reach
from tests.classroom.panel_page import PanelPage

AXE = Path(axe_playwright_python.__file__).parent / "axe.min.js"
SHRINKING = """q = 0.8 in 0.1 .. 1.5 by 0.1
angle: 30
steps: 4
axiom: A(1)
A(x) : x > 0.3 -> F(x) [+A(q*x)] A(q^2*x)"""
HALVES = "q = 1/2 in 1/10 .. 2 by 1/10\nr = sqrt(2)\nsteps: 3\naxiom: A(1)\nA(x) -> F(x) F(x*r) F(x*q/2) A(q*x)"
PHONE = {"viewport": {"width": 400, "height": 800}, "has_touch": True}


def switch(panel: Locator, name: str) -> Locator:
    return panel.get_by_role("button", name=f"{name} as a letter: formulas in place of numbers", exact=True)


def hand_of(page: Page, touch: bool) -> Pointer:
    return Finger(page) if touch else Mouse(page)


def findings(page: Page) -> Any:
    page.evaluate(AXE.read_text(encoding="utf-8"))
    return page.evaluate("""async () => {
        const { violations, incomplete } = await axe.run(".lsys-panel");
        const unsure = incomplete.filter(({ id }) => id !== "color-contrast"); // of a text of one character it is
        return [...violations, ...unsure].filter(({ impact }) => impact === "critical" || impact === "serious")
            .map((each) => [each.id, ...each.nodes.map((node) => node.html.slice(0, 200))]);
    }""")


@pytest.mark.parametrize("touch", [False, True], ids=["mouse", "finger"])
def test_a_switch_beside_the_slider_puts_formulas_in_place_of_numbers(explored, touch):
    panel = explored(read(SHRINKING), 2, unfold=True, context=PHONE if touch else None)
    root, hand = panel.at(".lsys-panel"), hand_of(panel.page, touch)
    word = panel.at(".lsys-word")
    expect(word).to_have_text("F(1)[+F(0.8)[+A(0.64)]A(0.512)]F(0.64)[+A(0.512)]A(0.4096)")
    hand.tap(switch(root, "q"))
    expect(switch(root, "q")).to_have_attribute("aria-pressed", "true")
    expect(word.locator("math").first).to_have_attribute("alttext", "(q)")
    assert word.locator("math").evaluate_all("all => all.map(each => each.getAttribute('alttext'))") == [
        "(q)", "(q²)", "(q³)", "(q²)", "(q³)", "(q⁴)",
    ]  # fmt: skip
    assert panel.page.evaluate("getComputedStyle(document.querySelector('math')).display") == "math"
    expect(panel.at(".lsys-status")).to_contain_text("the formulas hold where q > √0.3 ≈ 0.5477")
    assert {"(1)", "(q)", "(q²)", "(q³)"} <= {*panel.at(".lsys-stage .lsys-label tspan:last-child").all_text_contents()}
    hand.tap(panel.at('.lsys-word [data-position="3"]'))
    expect(panel.at(".lsys-sentence")).to_contain_text("Module 4 of step 2, F(q) (length q = 0.8) comes from A(q)")
    hand.tap(switch(root, "q"))
    expect(word).to_have_text("F(1)[+F(0.8)[+A(0.64)]A(0.512)]F(0.64)[+A(0.512)]A(0.4096)")
    expect(panel.at(".lsys-status")).not_to_contain_text("formulas")


def test_the_drawing_goes_on_with_the_number_of_the_slider(explored):
    panel = explored(read(SHRINKING), 2, letters="q")
    before = panel.at(".lsys-status").inner_text()
    reach(Mouse(panel.page), panel.at(".lsys-panel"), "q", "0.9")
    expect(panel.at(".lsys-status")).not_to_have_text(before)
    assert panel.at(".lsys-word math").first.get_attribute("alttext") == "(q)"
    panel.at('.lsys-word [data-position="3"]').click()
    expect(panel.at(".lsys-sentence")).to_contain_text("(length q = 0.9)")
    assert panel.explorer.text.startswith("Step 2")


def test_a_stroke_that_is_pointed_at_is_told_with_its_formula_and_its_number(explored):
    panel = explored(read("q = 1/2\nsteps: 3\naxiom: A(1)\nA(x) -> F(x) A(q*x)"), 3, letters="q", show=["drawing"])
    box = panel.at("canvas").bounding_box()
    found = set()
    for part in range(2, 40):
        panel.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] * part / 40)
        panel.page.evaluate("() => new Promise(painted => requestAnimationFrame(() => requestAnimationFrame(painted)))")
        found.add(panel.at(".lsys-sentence").inner_text().split("(length ")[-1].split(")")[0])
    assert {"q = 0.5", "q² = 0.25"} <= found


def test_roots_and_fractions_are_mathematics(explored):
    panel = explored(read(HALVES), 1, letters="q")
    assert panel.at(".lsys-word math").evaluate_all("all => all.map(each => each.getAttribute('alttext'))") == [
        "(√2)",
        "(½q)",
        "(q)",
    ]
    assert panel.at(".lsys-word math msqrt").count() == panel.at(".lsys-word math mfrac").count() == 1


def test_reset_brings_back_the_letters_of_the_beginning(explored):
    panel = explored(read(SHRINKING), 2, letters="q")
    switch(panel.at(".lsys-panel"), "q").click()
    expect(panel.at(".lsys-word math")).to_have_count(0)
    panel.at(".lsys-panel").get_by_role("button", name="reset", exact=True).click()
    expect(panel.at(".lsys-word math")).not_to_have_count(0)


def test_rules_that_are_typed_keep_the_letters_that_they_declare(explored):
    panel = explored(read(SHRINKING), 2, letters="q", show=["rules", "word", "drawing"])
    panel.at(".lsys-rules").fill("q = 0.5\naxiom: B(q)\nB(x) -> F(x) B(q*x)")
    expect(panel.at(".lsys-word math").first).to_have_attribute("alttext", "(q)")
    assert panel.explorer.letters == ["q"]
    panel.at(".lsys-rules").fill("p = 0.5\naxiom: B(p)\nB(x) -> F(x) B(p*x)")
    expect(switch(panel.at(".lsys-panel"), "p")).to_have_attribute("aria-pressed", "false")
    assert panel.explorer.letters == []


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_axe_finds_nothing_in_formulas(explored, dark):
    panel: PanelPage = explored(read(SHRINKING), 3, letters="q", unfold=True, dark=dark)
    expect(panel.at(".lsys-word math").first).to_be_visible()
    assert findings(panel.page) == []


def test_letters_are_constants_that_are_declared() -> None:
    panel = explore(read(SHRINKING), letters="q")
    assert panel.letters == ["q"]
    panel.letters = []
    with pytest.raises(ModelNameError, match="no letter 'p'"):
        panel.letters = ["p"]
    with pytest.raises(ModelNameError, match='declares no constant "p"'):
        explore(read(SHRINKING), letters=["p"])
    with pytest.raises(ModelNameError, match="no letter 'stiffness'"):
        explore("K28", letters="stiffness")


@pytest.mark.parametrize("touch", [False, True], ids=["mouse", "finger"])
def test_a_page_has_its_formulas_with_it(browser: Browser, tmp_path: Path, touch: bool) -> None:
    (tmp_path / "q.html").write_text(explore(read(SHRINKING), 3, letters="q")._page(), "utf-8")
    context = browser.new_context(offline=True, **(PHONE if touch else {}))
    page, faults = context.new_page(), []
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on("console", lambda message: faults.append(message.text))
    page.goto((tmp_path / "q.html").as_uri())
    root, hand = page.locator(".lsys-panel"), hand_of(page, touch)
    expect(page.locator(".lsys-word math").first).to_have_attribute("alttext", "(q)")
    hand.tap(switch(root, "q"))
    expect(page.locator(".lsys-word math")).to_have_count(0)
    hand.tap(switch(root, "q"))
    expect(page.locator(".lsys-word math")).not_to_have_count(0)
    reach(hand, root, "q", "0.9")
    expect(page.locator(".lsys-status")).to_contain_text("formulas hold where q")
    hand.tap(page.locator('.lsys-word [data-position="3"]'))
    expect(page.locator(".lsys-sentence")).to_contain_text("(length q = 0.9)")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert faults == []
    context.close()


def test_what_is_stored_of_a_panel_has_its_formulas() -> None:
    """The word and the stages, and where the formulas hold; stages that were not reached have numbers."""
    panel = explore(read(SHRINKING), 2, letters="q")
    said, drawn = panel._repr_mimebundle_()["text/plain"], panel.still["image/png"]
    assert "Step 2: 3 strokes, 16 modules. F(1)[+F(q)[+A(q^2)]A(q^3)]F(q^2)[+A(q^3)]A(q^4). " in said
    assert "The formulas hold where q > √0.3 ≈ 0.5477." in said
    assert "A(q): 0, A(q²): 1" in said
    assert "F(0.512): 0" in said
    panel.letters = []
    assert "F(1)[+F(0.8)[" in panel.text
    assert panel.still["image/png"] != drawn


def test_where_no_value_has_a_letter_it_is_said_and_where_the_word_is_the_same() -> None:
    found = book(system("J4"), letters=["lifeTimeA", "lifeTimeB"], least=5)
    assert found["conditions"][0] == "no value contains lifeTimeA or lifeTimeB"
    assert found["conditions"][4].endswith("lifeTimeB; the word is the same where lifeTimeA = 3, lifeTimeB > 1")
    assert "The word is the same where lifeTimeA = 3." in explore("J4", 5, letters="lifeTimeA").text
    assert not any("no value" in each for each in book(read(SHRINKING), letters=["q"], least=3)["conditions"])


def test_a_stage_whose_modules_have_no_formula_in_common_keeps_its_number() -> None:
    """q is 1/2 and so is r: A(q) and A(r) are one stage, and two formulas."""
    twice = explore(read("q = 1/2 in 0 .. 1\nr = 1/2\naxiom: A(q) A(r)\nA(x) -> B(x*q)\nB(x) -> B(x)"), 1, letters=["q", "r"])
    assert "Stages A(0.5): 0, B(0.25): 2." in twice.text


def test_the_address_of_a_page_says_which_constants_are_letters(browser: Browser, tmp_path: Path) -> None:
    panel = explore(read(SHRINKING), 2, letters="q")
    (tmp_path / "q.html").write_text(panel._page(), "utf-8")
    page = browser.new_page()
    page.goto((tmp_path / "q.html").as_uri())
    switch(page.locator(".lsys-panel"), "q").click()
    expect(page).to_have_url(re.compile("#lsys="))
    without = page.url
    assert "letters" not in linked(without).settings
    switch(page.locator(".lsys-panel"), "q").click()
    expect(page).not_to_have_url(without)
    assert linked(page.url).settings["letters"] == ("q",)
    for address, many in ((without, 0), (page.url, 6)):
        page.goto("about:blank")
        page.goto(address)
        expect(page.locator(".lsys-word math")).to_have_count(many)
        expect(page.locator(".lsys-panel")).not_to_contain_text("does not hold all")
    (tmp_path / "q.html").write_text(explore(read(SHRINKING), 2)._page(), "utf-8")
    page.goto("about:blank")
    page.goto(address)
    expect(page.locator(".lsys-panel")).to_contain_text("does not hold all")
    page.close()


@pytest.mark.slow
def test_a_page_without_letters_has_no_script_of_formulas() -> None:
    assert "MathML" not in page_of("J4", explore("J4").page_data(), "J4")
    assert explore(read(SHRINKING), letters="q").page_data()["model"]["letters"] == ["q"]
