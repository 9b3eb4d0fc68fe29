"""What a panel has at hand: few things, of which a beginner needs every one; all else is a button away, and out of the way."""

from __future__ import annotations

import itertools
from typing import Any

import pytest
from playwright.sync_api import Locator, expect

from lsys_kit import explore
from lsys_kit.classroom.panel.page import page
from tests.classroom.panel_page import PanelPage, show_more

FEW_STOPS = 20
"""So often at most the Tab key stops in a panel with three sliders and three views."""
STOPS = """panel => [...panel.querySelectorAll("button, input, select, textarea, [tabindex]")]
    .filter(each => each.tabIndex >= 0 && each.getClientRects().length).length"""
PHONE = {"viewport": {"width": 400, "height": 800}, "has_touch": True}


def seen(panel: PanelPage, *names: str) -> list[bool]:
    return [panel.page.get_by_label(name, exact=True).is_visible() for name in names]


def test_tools_are_out_of_the_way_until_somebody_wants_them(explored):
    panel = explored("J4", 9)
    assert panel.at(".lsys-top .lsys-tab:visible").all_inner_texts() == ["rules", "word", "stages", "drawing", "more"]
    tools = ("size", "mark", "speed", "loop", "take along")
    assert seen(panel, *tools) == [False] * len(tools)
    panel.more()
    assert seen(panel, *tools) == [True] * len(tools)


def test_what_a_lesson_does_not_show_stands_behind_more(explored):
    panel = explored("K22", 3, show=["word", "drawing"])
    assert panel.at(".lsys-top .lsys-tab:visible").all_inner_texts() == ["rules", "word", "drawing", "nine seeds", "more"]
    panel.view("stages")
    expect(panel.at('[data-view="stages"]')).to_be_visible()
    expect(panel.at(".lsys-status")).to_contain_text("occupied")


@pytest.mark.parametrize("id", ["J4", "K5", "P5", "K22", "K28"])
def test_the_tab_key_stops_once_at_a_group_of_buttons(explored, id):
    panel = explored(id, 3)
    sliders = panel.at(".lsys-range:visible").count()
    assert panel.at(".lsys-panel").evaluate(STOPS) <= FEW_STOPS - 6 + 2 * sliders


def test_arrow_keys_go_through_a_group_of_buttons(explored):
    panel = explored("J4", 9)
    tabs = panel.page.get_by_role("toolbar", name="views", exact=True).get_by_role("button")
    tabs.first.focus()
    for key, name in (
        ("ArrowRight", "word"),
        ("ArrowLeft", "rules"),
        ("ArrowLeft", "more"),
        ("Home", "rules"),
        ("End", "more"),
    ):
        panel.page.keyboard.press(key)
        expect(panel.page.locator(":focus")).to_have_text(name)
    stages = panel.at("[data-place]")
    stages.first.focus()
    panel.page.keyboard.press("End")
    panel.page.keyboard.press("Enter")
    expect(stages.last).to_have_attribute("aria-pressed", "true")


def test_no_two_panels_are_called_alike(explored):
    panel = explored("J4", 9)
    panel.page.evaluate("window.openOne()")
    names = panel.at(".lsys-panel").evaluate_all("panels => panels.map(each => each.getAttribute('aria-label'))")
    assert names == ["L-system J4", "L-system J4 (2)"]
    assert panel.page.get_by_role("region").count() == 2


def test_word_and_drawing_are_pale_while_the_rules_are_broken(explored):
    panel = explored("J1", 4)
    panel.view("rules")
    rules, drawing = panel.page.get_by_label("rules of the model"), panel.at('[data-view="drawing"]')
    for text, opacity in (("axiom: a\na -> a(", "0.3"), ("axiom: a\na -> ab", "1")):
        rules.fill(text)
        expect(drawing).to_have_css("opacity", opacity)
        expect(panel.at('[data-view="rules"]')).to_have_css("opacity", "1")


@pytest.mark.parametrize(
    ("what", "step", "said"),
    [
        ("J4", 9, "step 9: 9 cells; "),
        ("K5", 2, "step 2: 25 strokes, 61 characters; "),
        ("K19", 12, "step 12: 102 strokes, 199 modules; "),
        ("axiom: A\nA -> AB", 3, "step 3: 4 letters; "),
        ("K28", 2, "step 2: 9 vertices, 12 walls, 4 cells; "),
    ],
)
def test_a_step_is_told_in_the_words_of_its_system(explored, what, step, said):
    panel = explored(what, step)
    expect(panel.at(".lsys-status")).to_contain_text(said)
    assert panel.explorer.text.lower().startswith(said[:-2])


@pytest.mark.parametrize(("id", "step"), [("K22", 8), ("P5", 4), ("K13", 5), ("J4", 9)])
def test_a_stage_diagram_is_seen_whole_and_large_where_it_is_clicked(explored, id, step):
    panel = explored(id, step)
    net = panel.at(".lsys-net")
    assert net.evaluate("net => [net, net.parentElement].every(each => each.scrollWidth <= each.clientWidth + 1)")
    whole = net.bounding_box()
    net.click(position={"x": 1, "y": 1})
    panel.page.wait_for_function("document.fullscreenElement !== null")
    assert net.bounding_box()["width"] > whole["width"]


def test_nine_seeds_fill_the_whole_screen_and_are_drawn_as_large(explored):
    panel = explored("K8", 6, show=["drawing"])
    panel.page.get_by_role("button", name="nine seeds", exact=True).click()
    tile = panel.at(".lsys-tile").first
    small = tile.bounding_box()["height"]
    panel.page.get_by_role("button", name="nine seeds on the whole screen").click()
    panel.page.wait_for_function("small => document.querySelector('.lsys-tile').clientHeight > 2 * small", arg=small)
    panel.page.wait_for_function(
        "() => { const tile = document.querySelector('.lsys-tile'); return tile.height >= tile.clientHeight; }"
    )


@pytest.mark.parametrize("width", [400, 360])
@pytest.mark.parametrize("id", ["J4", "K8"])
def test_on_a_phone_the_buttons_of_the_views_stand_in_one_line(explored, id, width):
    panel = explored(id, context={"viewport": {"width": width, "height": 800}, "has_touch": True})
    tabs = panel.at(".lsys-top .lsys-tab:visible")
    assert len({round(box_of(tab)["top"]) for tab in tabs.all()}) == 1
    more = tabs.last.bounding_box()
    assert more["x"] + more["width"] <= width


def test_where_one_line_has_no_room_for_the_buttons_of_the_views_all_are_seen(explored):
    panel = explored("K8", context={"viewport": {"width": 300, "height": 800}, "has_touch": True})
    boxes = [each.bounding_box() for each in panel.at(".lsys-top .lsys-tab:visible").all()]
    assert len({box["y"] for box in boxes}) == 2
    assert all(box["x"] + box["width"] <= 300 for box in boxes)
    for box, following in itertools.pairwise(boxes):
        assert box["y"] < following["y"] or box["x"] + box["width"] <= following["x"]


@pytest.mark.parametrize(
    ("id", "uses"),
    [
        ("J4", "Two fingers bring it nearer. Tap a cell to trace it."),
        ("K5", "Two fingers bring it nearer. Tap a part to trace it."),
        ("K28", "Two fingers bring it nearer. Tap a wall to trace it."),
        ("K19", "A finger turns it. Tap a part to trace it."),
        ("K33", "A finger turns it. Tap a cell to trace it."),
    ],
)
def test_a_finger_is_told_what_it_can_do(explored, id, uses):
    assert explored(id, context=PHONE).at(".lsys-sheet .lsys-hint").inner_text() == uses


def test_a_finger_beside_a_cell_finds_it_and_the_page_stays_where_it_is(explored):
    panel = explored("J4", 10, context={"viewport": {"width": 400, "height": 500}, "has_touch": True})
    canvas, word = panel.at(".lsys-canvas").bounding_box(), panel.at(".lsys-word").bounding_box()
    assert word["y"] > 500
    panel.page.touchscreen.tap(canvas["x"] + canvas["width"] / 2, canvas["y"] + canvas["height"] - 4)
    expect(panel.at(".lsys-sentence")).to_contain_text("of step 10, ")
    assert panel.page.evaluate("scrollY") == 0


def test_a_long_word_is_moved_until_what_is_traced_is_seen(explored):
    panel = explored("K5", 4)
    word, first, last = (
        panel.at(".lsys-word"),
        panel.at('.lsys-word [data-position="0"]'),
        panel.at(".lsys-word [data-position]").last,
    )
    panel.at(".lsys-canvas").press("p")
    assert box_of(last)["bottom"] <= box_of(word)["bottom"]
    word.press("Home")
    assert box_of(first)["top"] >= box_of(word)["top"]


def test_what_is_told_of_a_part_stands_below_the_view_in_which_it_was_pointed_at(explored):
    panel = explored("K8", 6, context={"viewport": {"width": 1440, "height": 900}})
    panel.view("nine seeds")
    sentence = panel.at(".lsys-sentence")
    trace = {"drawing": lambda: panel.at(".lsys-canvas").press("n"), "word": panel.at('.lsys-module[data-position="0"]').click}
    for view, above in (("drawing", ".lsys-canvas"), ("word", ".lsys-word"), ("drawing", ".lsys-canvas")):
        trace[view]()
        expect(panel.at(f'[data-view="{view}"] .lsys-sentence')).to_contain_text(" of step 6")
        assert sentence.count() == 1
        assert 0 <= box_of(sentence)["top"] - box_of(panel.at(above))["bottom"] < 20
    panel.view("drawing")
    expect(panel.at('[data-view="word"] .lsys-sentence')).to_contain_text(" of step 6")


def test_what_is_told_of_a_cell_of_a_tissue_stands_above_the_list_of_those_that_are_lit(explored):
    panel = explored("K33", 3)
    panel.at(".lsys-canvas").press("n")
    expect(panel.at(".lsys-sentence")).to_contain_text("Cell 1 of step 3")
    assert box_of(panel.at(".lsys-canvas"))["bottom"] <= box_of(panel.at(".lsys-sentence"))["top"]
    assert box_of(panel.at(".lsys-sentence"))["bottom"] <= box_of(panel.at('[data-view="drawing"] select'))["top"]


def box_of(found: Locator) -> dict[str, float]:
    box = found.bounding_box()
    assert box
    return {"top": box["y"], "bottom": box["y"] + box["height"], "width": box["width"]}


def test_on_a_phone_the_drawing_comes_first_and_the_step_stays(browser, tmp_path) -> None:
    panel = explore("K19", 12)
    tab = browser.new_context(**PHONE).new_page()
    (tmp_path / "page.html").write_text(page("K19", panel.page_data(), ""), "utf-8")
    tab.goto((tmp_path / "page.html").as_uri())
    tab.locator("canvas[data-drawn]").wait_for()
    step, drawing, word = (tab.locator(where) for where in (".lsys-top", ".lsys-canvas", ".lsys-word"))
    assert box_of(drawing)["bottom"] < 700
    assert box_of(drawing)["bottom"] < box_of(tab.get_by_label("around", exact=True))["top"] < box_of(word)["top"]
    assert word.evaluate("word => word.clientHeight") < 80
    assert 0 <= box_of(tab.locator(".lsys-sentence"))["top"] - box_of(tab.locator(".lsys-sheet"))["bottom"] < 20
    tab.get_by_role("button", name="show all").click()
    assert word.evaluate("word => word.scrollHeight === word.clientHeight || word.clientHeight > 200")
    tab.evaluate("scrollTo(0, 1e6)")
    assert 0 <= box_of(step)["top"] < 10
    tab.context.close()


def test_more_and_what_was_learnt_are_remembered(browser, tmp_path) -> None:
    def opened(**context: Any) -> Locator:
        tab = browser.contexts[-1].new_page() if context.get("again") else browser.new_context().new_page()
        tab.goto((tmp_path / "page.html").as_uri())
        tab.locator("canvas[data-drawn]").wait_for()
        return tab.locator(".lsys-panel")

    (tmp_path / "page.html").write_text(page("J4", explore("J4", 9).page_data(), ""), "utf-8")
    first = opened()
    first.locator(".lsys-canvas").hover()
    expect(first.locator(".lsys-sheet .lsys-hint")).to_be_visible()
    first.locator(".lsys-canvas").click()
    expect(first.locator(".lsys-sheet .lsys-hint")).to_be_hidden()
    show_more(first)
    second = opened(again=True)
    expect(second.locator(".lsys-more")).to_be_visible()
    expect(second.locator(".lsys-sheet .lsys-hint")).to_be_hidden()
    browser.contexts[-1].close()


@pytest.mark.parametrize("on_a_page", [False, True])
def test_what_is_lit_in_the_rules_lies_behind_their_text(explored, browser, tmp_path, on_a_page):
    """The text and what lies behind it are laid out alike, whether it can be changed or not."""
    if on_a_page:
        explore("J4", 9, show=["rules", "drawing"]).save(tmp_path / "a.html")
        shown = browser.new_page()
        shown.goto((tmp_path / "a.html").as_uri())
        editor = shown.locator(".lsys-editor")
    else:
        panel = explored("J4", 9)
        panel.view("rules")
        editor = panel.at(".lsys-editor")
    expect(editor.locator("textarea")).to_be_visible()
    text, behind = (
        editor.locator(each).evaluate(
            """each => { const { padding, borderWidth, font, lineHeight, whiteSpace } = getComputedStyle(each);
            return [padding, borderWidth, font, lineHeight, whiteSpace, each.clientWidth]; }"""
        )
        for each in ("textarea", ".lsys-backdrop")
    )
    if on_a_page:
        editor.page.close()
    assert text == behind


@pytest.mark.parametrize("width", [1440, 700, 400])
def test_no_view_hides_the_title_of_another_also_with_open_rules(explored, width: int) -> None:
    panel = explored("J4", 9)
    panel.page.set_viewport_size({"width": width, "height": 1600})
    panel.page.get_by_role("button", name="rules", exact=True).click()
    seen = """(titles) => titles.filter((each) => each.checkVisibility()).map((each) => {
      const { left, top, height } = each.getBoundingClientRect();
      return each.contains(document.elementFromPoint(left + 5, top + height / 2));
    })"""
    titles = panel.page.locator(".lsys-title").evaluate_all(seen)
    assert len(titles) == 4
    assert all(titles)
