"""What a panel must not do: leak, be illegible, or take what was typed for a part of the page."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import expect

from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production
from tests.classroom.panel_page import PanelPage
from tests.test_hostile_names import HOSTILE

CONTRASTS = """() => {
    const parsed = (text) => {
        const [r, g, b, a = 1] = text.match(/[\\d.]+/g).map(Number);
        return text.startsWith("color(") ? [255 * r, 255 * g, 255 * b, a] : [r, g, b, a];
    };
    const over = ([r, g, b, a], below) => [r, g, b].map((channel, i) => a * channel + (1 - a) * below[i]);
    const ground = (element) => {
        const chain = [];
        for (let each = element; each; each = each.parentElement) chain.unshift(getComputedStyle(each).backgroundColor);
        return chain.reduce((below, colour) => over(parsed(colour), below), [255, 255, 255]);
    };
    const luminance = (rgb) => {
        const [r, g, b] = rgb.map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const found = [], walker = document.createTreeWalker(document.querySelector(".lsys-panel"), NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        const element = walker.currentNode.parentElement, box = element.getBoundingClientRect();
        if (!walker.currentNode.textContent.trim() || !box.width || element.closest(".lsys-backdrop, title, option")) continue;
        const style = getComputedStyle(element), paper = ground(element);
        const ink = over(parsed(element instanceof SVGElement ? style.fill : style.color), paper);
        const [less, more] = [luminance(ink), luminance(paper)].sort((a, b) => a - b);
        const name = element.className.baseVal ?? element.className;
        found.push([(more + 0.05) / (less + 0.05), name, walker.currentNode.textContent.slice(0, 30)]);
    }
    return found;
}"""


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("id", ["J4", "K5", "K19", "P9"])
def test_every_text_can_be_read(explored, id, dark):
    panel = explored(id, dark=dark)
    for title in ("rules", "how many", "nine variants"):
        panel.view(title)
    panel.at("canvas.lsys-canvas").press("n")
    panel.at("[data-place]").first.press("Enter")
    panel.page.wait_for_timeout(300)
    found = panel.page.evaluate(CONTRASTS)
    assert len(found) > 40
    assert [each for each in found if each[0] < 4.5] == []


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_a_mistake_can_be_read(explored, dark):
    panel = explored("J1", dark=dark)
    panel.view("rules")
    panel.page.get_by_label("rules of the model").fill("axiom: a(t)")
    expect(panel.at(".lsys-mistake")).to_contain_text("I do not know")
    assert [each for each in panel.page.evaluate(CONTRASTS) if each[0] < 4.5] == []


def metrics(panel: PanelPage) -> dict[str, float]:
    session = panel.page.context.new_cdp_session(panel.page)
    session.send("HeapProfiler.collectGarbage")
    session.send("Performance.enable")
    return {each["name"]: each["value"] for each in session.send("Performance.getMetrics")["metrics"]}


@pytest.mark.slow
def test_two_hundred_panels_made_and_closed_leave_nothing_behind(explored):
    panel = explored("J4", 9, context={})
    turn = """async (times) => {
        window.panel?.close();
        for (let i = 0; i < times; i++) {
            window.openOne().close();
            if (i % 20 === 0) await new Promise((done) => setTimeout(done, 30));
        }
    }"""
    panel.page.evaluate(turn, 20)
    before = metrics(panel)
    panel.page.evaluate(turn, 200)
    panel.page.wait_for_timeout(600)
    after = metrics(panel)
    assert panel.page.locator(".lsys-panel").count() == 0
    assert after["Nodes"] - before["Nodes"] < 500  # a panel has some 400
    assert after["JSEventListeners"] - before["JSEventListeners"] < 60  # a panel has some 100
    assert panel.page.evaluate("Object.values(window.handlersOf()).every((each) => each.length === 0)")


@pytest.mark.slow
def test_ten_thousand_moves_of_a_slider_take_no_memory(explored):
    panel = explored("J4", 9, context={})
    turn = """async (times) => {
        for (let i = 0; i < times; i++) {
            host.set("step", i % 21);
            if (i % 10 === 0) await new Promise(requestAnimationFrame);
        }
    }"""
    panel.page.evaluate(turn, 500)
    before = metrics(panel)
    panel.page.evaluate(turn, 10_000)
    after = metrics(panel)
    assert after["JSHeapUsedSize"] - before["JSHeapUsedSize"] < 5e6
    assert after["Nodes"] - before["Nodes"] < 500


TYPED = [text for text in HOSTILE if "\0" not in text and text != "\ud800"]
"""What a browser can be given."""
FOREIGN = ".lsys-panel script, .lsys-panel iframe, .lsys-panel img, .lsys-panel [onerror], .lsys-panel b"


@pytest.mark.parametrize("text", TYPED, ids=ascii)
def test_what_is_typed_into_the_rules_stays_text(explored, text):
    panel = explored("J1", 2)
    panel.view("rules")
    rules = panel.page.get_by_label("rules of the model")
    for number, model in enumerate((f"axiom: {text}", f"axiom: A\nA -> {text} A", f"/* {text} */\naxiom: A\nA -> A B"), 1):
        rules.fill(model)
        panel.page.wait_for_function("number => answered.filter(kind => kind === 'rules').length === number", arg=number)
    assert panel.errors == []
    assert panel.page.locator(FOREIGN).count() == 0


@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_a_name_is_shown_as_it_was_given_and_is_no_part_of_the_page(explored, text):
    panel = explored(LSystem((Pattern(text), Pattern("F")), (Production((Pattern("F"),), (Pattern("F"), Pattern(text))),)), 2)
    panel.at("canvas.lsys-canvas").press("n")
    expect(panel.at(".lsys-sentence")).to_contain_text(re.compile("(Module|Character) 1 of step 2"))
    assert panel.page.locator(FOREIGN).count() == 0
