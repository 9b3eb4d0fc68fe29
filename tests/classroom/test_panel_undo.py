"""Whatever changed the rules of a panel is taken back and done again; settings whose constant is still there stay."""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from lsys_kit import derive, system

pytestmark = pytest.mark.browser
ALGA = "axiom: a\na -> a b\nb -> a"


def opened(explored, what="J1", step=4, **choices):
    """A panel with its rules, its buttons, and the text that stands there."""
    panel = explored(what, step, show=["rules", "word", "drawing"], **choices)
    button = {name: panel.page.get_by_role("button", name=name, exact=True) for name in ("undo", "redo")}
    return panel, panel.page.get_by_label("rules of the model"), button


@pytest.mark.parametrize("keys", [("Control+z", "Control+Shift+z"), ("Control+z", "Control+y"), ("Meta+z", "Meta+Shift+z")])
def test_what_was_typed_is_taken_back_and_made_again_by_keys(explored, keys):
    undo, redo = keys
    panel, rules, _ = opened(explored)
    first = rules.input_value()
    rules.fill(ALGA)
    expect(panel.at(".lsys-word")).to_have_text("abaababa")
    rules.press(undo)
    expect(rules).to_have_value(first)
    expect(panel.at(".lsys-word")).to_have_text("".join(map(str, derive(system("J1"), 4)[-1])))
    rules.press(redo)
    expect(rules).to_have_value(ALGA)
    expect(panel.at(".lsys-word")).to_have_text("abaababa")
    rules.press(redo)
    expect(rules).to_have_value(ALGA)


def test_all_that_changed_the_rules_is_taken_back_by_buttons(explored):
    panel, rules, button = opened(explored, "K5", 2)
    texts = [rules.input_value()]
    expect(button["undo"]).to_be_hidden()
    panel.view("nine variants")
    expect(panel.at(".lsys-tile-button")).to_have_count(9)
    panel.at(".lsys-tile-button").nth(3).click()
    expect(rules).not_to_have_value(texts[0])
    texts.append(rules.input_value())
    rules.fill(ALGA)
    texts.append(ALGA)
    expect(panel.at(".lsys-word")).to_have_text("aba")
    panel.page.get_by_role("button", name="back to the first rules").click()
    expect(rules).to_have_value(texts[0])
    for text in (texts[2], texts[1], texts[0]):
        button["undo"].click()
        expect(rules).to_have_value(text)
        panel.page.wait_for_timeout(500)  # the kernel's answer changes nothing
        expect(rules).to_have_value(text)
    expect(button["undo"]).to_be_disabled()
    for text in (texts[1], texts[2], texts[0]):
        button["redo"].click()
        expect(rules).to_have_value(text)
    expect(button["redo"]).to_be_disabled()


def test_keys_take_back_what_a_button_did_but_not_what_stands_in_other_boxes(explored):
    panel, rules, _ = opened(explored)
    first = rules.input_value()
    rules.fill(ALGA)
    panel.page.get_by_role("button", name="back to the first rules").click()
    expect(rules).to_have_value(first)
    panel.page.keyboard.press("Control+z")
    expect(rules).to_have_value(ALGA)
    box = panel.page.get_by_label("step", exact=True)
    box.press("7")
    box.press("Control+z")
    expect(rules).to_have_value(ALGA)


def test_what_is_typed_in_one_go_is_taken_back_word_by_word(explored):
    panel, rules, _ = opened(explored)
    rules.fill("axiom: a\na -> ")
    rules.press("Control+End")
    panel.page.keyboard.type("bcd efg")
    for left in ("bcd", ""):
        rules.press("Control+z")
        expect(rules).to_have_value(f"axiom: a\na -> {left}")
    assert rules.evaluate("area => area.selectionStart") == len("axiom: a\na -> ")


def test_another_change_after_undo_ends_what_could_be_made_again(explored):
    _, rules, button = opened(explored)
    rules.fill(ALGA)
    rules.press("Control+z")
    expect(button["redo"]).to_be_enabled()
    rules.fill("axiom: c")
    expect(button["redo"]).to_be_disabled()


@pytest.mark.parametrize(
    "change",
    [
        lambda text: f"{text}\n",
        lambda text: text.replace("axiom", "/* a remark */\naxiom"),
        lambda text: text.replace("lifeTimeB = 2", "lifeTimeB = 1"),
        lambda text: text.replace("Al(lifeTimeA) -> Al(1) Br(1)", "Al(lifeTimeA) -> Bl(1) Br(1)"),
    ],
)
def test_settings_whose_constant_is_still_there_stay(explored, change):
    panel, rules, _ = opened(explored, "J4", 9)
    for _ in range(2):
        panel.control("lifeTimeA").press("ArrowRight")
    before = rules.input_value()
    rules.fill(change(before))
    expect(panel.page.get_by_label("lifeTimeA", exact=True)).to_have_value("5")
    panel.page.wait_for_timeout(600)
    expect(panel.page.get_by_label("lifeTimeA", exact=True)).to_have_value("5")
    assert panel.explorer.settings["lifeTimeA"] == "5"


def test_settings_come_back_with_the_rules_that_had_them(explored):
    panel, rules, button = opened(explored, "J4", 9)
    for _ in range(2):
        panel.control("lifeTimeA").press("ArrowRight")
    rules.fill(ALGA)
    expect(panel.control("lifeTimeA")).to_have_count(0)
    button["undo"].click()
    expect(panel.page.get_by_label("lifeTimeA", exact=True)).to_have_value("5")
    expect(panel.at(".lsys-status")).to_contain_text("step 9")


def test_while_rules_are_read_the_last_ones_win(explored):
    panel, rules, _ = opened(explored)
    panel.page.evaluate("""() => {
        const { kernel } = window, held = new Promise((resolve) => { window.letGo = resolve; });
        window.kernel = async (content) => { await held; return kernel(content); };
    }""")
    for word in ("b", "bc", "bcd", "bcde"):
        rules.fill(f"axiom: a\na -> {word}")
        panel.page.wait_for_timeout(350)
    expect(panel.at(".lsys-panel")).to_have_attribute("aria-busy", "true")
    expect(panel.at(".lsys-panel").get_by_text("Python is busy.")).to_be_visible()
    expect(panel.at('[data-view="word"]')).to_have_css("opacity", "0.4")
    expect(panel.at('[data-view="rules"]')).to_have_css("opacity", "1")  # in which somebody types
    panel.page.evaluate("window.letGo()")
    expect(panel.at(".lsys-word")).to_have_text("bcde")
    expect(panel.at(".lsys-panel")).to_have_attribute("aria-busy", "false")
    expect(panel.at(".lsys-panel").get_by_text("Python is busy.")).to_have_count(0)
    assert panel.asked.count("rules") == 2  # the first, and the last
