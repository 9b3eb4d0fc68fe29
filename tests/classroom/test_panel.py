"""The panel in a real browser: what a person does in it, and what it asks the kernel."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import expect

from lsys_kit import derive, read, system, systems
from lsys_kit.derivation.core.states import States
from tests.classroom.panel_page import PanelPage

SETTLED = [id for id in systems() if States(system(id)).traits.d0l]


def word_in(panel: PanelPage) -> str:
    return panel.at(".lsys-word").inner_text().replace("\n", "")


@pytest.mark.parametrize("id", SETTLED)
def test_step_angle_view_and_mark_never_ask_the_kernel(explored, id):
    panel = explored(id)
    for name in ("step", "angle", "around", "above"):
        slider = panel.control(name)
        if slider.count():
            slider.press("Home")
            first = int(slider.get_attribute("aria-valuetext"))
            for key, moved in (("ArrowRight", 1), ("ArrowRight", 2), ("ArrowLeft", 1)):
                slider.press(key)
                expect(slider).to_have_attribute("aria-valuetext", str(first + moved))
    if panel.at("[data-place]").count():
        panel.at("[data-place]").first.press("Enter")
        expect(panel.at("[data-place]").first).to_have_attribute("aria-pressed", "true")
    panel.at("canvas").press("n")
    expect(panel.at(".lsys-sentence")).to_contain_text(" 1 of step")
    panel.page.wait_for_function("asked.length > 0")  # where they come to rest the kernel is told, and answers nothing
    assert set(panel.asked) == {"save"}


def test_the_slider_of_the_step_changes_word_tokens_and_drawing(explored):
    panel = explored("J4", 3)
    assert word_in(panel) == "Al(1)Br(1)"
    panel.control("step").press("ArrowRight")
    expect(panel.at(".lsys-status")).to_contain_text("step 4: 2 cells; 2 of 5 stages occupied")
    expect(panel.at(".lsys-word")).to_have_text("Al(2)Br(2)")
    expect(panel.at('[data-place="1"]')).to_have_attribute("aria-label", "stage A(2), 1 token")
    expect(panel.at("canvas")).to_have_attribute("data-step", "4")


def test_a_panel_opens_with_the_views_that_are_asked_for(explored):
    panel = explored("K7", 3, show=["rules", "drawing"])
    assert [each.get_attribute("data-view") for each in panel.at(".lsys-view:not([hidden])").all()] == ["rules", "drawing"]
    pressed = panel.page.get_by_role("toolbar", name="views", exact=True).locator("[aria-pressed=true]")
    assert pressed.all_inner_texts() == ["rules", "drawing"]


def test_notes_on_how_rules_were_read_stand_below_them_and_a_mistake_names_its_line(explored):
    panel = explored("J4", 3, show=["rules", "drawing"])
    notes, rules = panel.at('[data-view="rules"] .lsys-hint'), panel.at(".lsys-rules")
    rules.fill("axiom: A\nA -> BXB\nX -> X")
    expect(notes).to_contain_text("BXB")
    rules.fill("axiom: A\nA -> BXB(\nX -> X")
    expect(panel.at(".lsys-mistake")).to_contain_text("Line 2: ")
    expect(notes).to_have_text("")
    rules.fill("axiom: A\nA -> BXB\nX -> X")
    expect(notes).to_contain_text("BXB")


def test_what_is_pasted_becomes_the_kits_notation_and_one_press_of_undo_brings_it_back(explored):
    panel = explored("K5", 2, show=["rules", "drawing"])
    notes, rules = panel.at('[data-view="rules"] .lsys-hint'), panel.at(".lsys-rules")
    page = "variables : X F\nstart : X\nrules : (X → F[+X]F[−X]+X), (F → FF)\nangle : 20°"
    rules.fill(page)
    expect(notes).to_contain_text("Read as a list of variables and rules")
    expect(rules).to_have_value(page)  # what is typed stays as it was typed
    rules.press("Control+a")
    rules.press("Control+x")
    rules.press("Control+v")
    expect(rules).to_have_value("angle: 20\naxiom: X\nX -> F[+X]F[-X]+X\nF -> F F\n")
    expect(notes).to_contain_text("Read as a list of variables and rules, as encyclopaedias have it; angle 20.")
    rules.press("Control+z")
    expect(rules).to_have_value(page)
    expect(notes).to_contain_text("Read as a list of variables and rules")


def test_while_a_book_is_fetched_a_panel_is_busy(explored):
    panel = explored("J4", 9)
    panel.page.evaluate("window.delay = () => 2000")
    panel.control("lifeTimeA").press("End")
    expect(panel.at(".lsys-panel")).to_have_attribute("aria-busy", "true")
    expect(panel.at(".lsys-status")).to_have_css("opacity", "0.4")
    expect(panel.at(".lsys-panel")).to_have_attribute("aria-busy", "false")
    expect(panel.at(".lsys-status")).to_have_css("opacity", "1")


def test_a_step_that_changes_nothing_is_said_to_do_so(explored):
    panel = explored("K24", 18, L=2)
    words = derive(system("K24"), 20, L=2)
    assert [str(words[step]) == str(words[step - 1]) for step in (17, 18, 19, 20)] == [False, False, True, True]
    for step in (18, 19, 20):
        said = "^(?!.*changes nothing)" if step == 18 else "; this step changes nothing;"
        expect(panel.at(".lsys-status")).to_contain_text(f"step {step}: ")
        expect(panel.at(".lsys-status")).to_have_text(re.compile(said))
        panel.control("step").press("ArrowRight")


@pytest.mark.parametrize(("id", "step", "length"), [("J1", 6, "34"), ("P7", 4, "8.7212"), ("P8", 6, "25.7571")])
def test_the_length_of_a_filament_is_said(explored, id, step, length):
    panel = explored(id, step)
    assert f"Width {round(float(length), 2):g}, height 1" in panel.explorer.text
    expect(panel.at(".lsys-status")).to_contain_text(re.compile(rf"(occupied|cells); length {re.escape(length)}$"))


def test_a_number_is_typed_as_a_person_writes_it(explored):
    panel = explored("P5", 3)
    box = panel.page.get_by_label("dt", exact=True)
    assert box.input_value() == "0.7"
    for typed, shown in (("1,4", "1.4"), ("0.3000001", "0.3"), ("7/10", "0.7")):
        box.fill(typed)
        box.press("Enter")
        expect(box).to_have_value(shown)
    box.fill("x")
    box.press("Enter")
    expect(box).to_have_attribute("aria-invalid", "true")


@pytest.mark.parametrize("touch", [False, True])
def test_what_is_typed_into_a_number_box_replaces_what_stands_in_it(explored, touch):
    panel = explored("K5", 2, context={"has_touch": touch})
    box = panel.page.get_by_label("angle", exact=True)
    for typed in ("60", "45"):
        panel.page.get_by_label("step", exact=True).focus()
        box.tap() if touch else box.click()
        panel.page.keyboard.type(typed)
        panel.page.keyboard.press("Enter")
        expect(box).to_have_value(typed)
        panel.page.wait_for_function(f"host.get('angle') === {typed}")
    panel.page.keyboard.type("30")
    panel.page.keyboard.press("Tab")
    expect(box).to_have_value("30")


@pytest.mark.parametrize("leave", ["Enter", "Tab"])
@pytest.mark.parametrize("typed", ["200", "-1", "x"])
def test_a_number_out_of_range_is_refused_and_the_value_stays(explored, typed, leave):
    panel = explored("K5", 2)
    box = panel.page.get_by_label("angle", exact=True)
    box.click()
    panel.page.keyboard.type(typed)
    panel.page.keyboard.press(leave)
    expect(box).to_have_attribute("aria-invalid", "true")
    expect(box).to_have_accessible_description("0 to 180")
    expect(box).to_have_value("25.7")
    assert panel.page.evaluate("host.get('angle')") == 25.7
    box.click()
    panel.page.keyboard.type("180")
    panel.page.keyboard.press(leave)
    expect(box).not_to_have_attribute("aria-invalid", "true")
    expect(box).to_have_value("180")
    expect(panel.at(".lsys-refused").filter(has_text="to")).to_have_count(0)


def test_after_a_change_of_the_rules_reset_leads_to_the_first_step_of_the_panel(explored):
    panel = explored("K5", 2)
    panel.view("rules")
    panel.page.get_by_label("rules of the model").fill("angle: 25.7\nsteps: 4\naxiom: F\nF -> F F [- F] F")
    expect(panel.at(".lsys-status")).to_contain_text("step 2: 16 strokes")
    panel.control("step").press("End")
    expect(panel.at(".lsys-status")).not_to_contain_text("step 2:")
    panel.at('[data-control="step"]').get_by_role("button", name="reset").click()
    expect(panel.at(".lsys-status")).to_contain_text("step 2: 16 strokes")


def test_a_seed_at_which_nothing_grows_is_said_to_be_one(explored):
    panel = explored("K8", 5, seed=3)
    assert [str(word) for word in derive(system("K8"), 18, seed=3)[5:]] == ["P2 L10 F"] * 14
    expect(panel.at(".lsys-status")).to_contain_text("; nothing changes any more at this seed;")


def test_rows_of_a_word_are_seen_whole(explored):
    for height in (600, 700, 900):
        panel = explored("K5", 4, context={"viewport": {"width": 1440, "height": height}})
        rows = panel.at(".lsys-word").evaluate("""word => [...word.children]
            .map(each => each.getBoundingClientRect()).filter(each => each.top < word.getBoundingClientRect().bottom - 0.5)
            .map(each => each.bottom - word.getBoundingClientRect().bottom)""")
        assert max(rows) < 1


def test_a_hint_stands_below_the_drawing_and_nothing_moves_when_it_goes(explored):
    panel = explored("J4", 9, context={})
    boxes = lambda: [panel.at(each).bounding_box() for each in (".lsys-canvas", '[data-view="drawing"]', ".lsys-panel")]  # noqa: E731
    before, hint = boxes(), panel.at(".lsys-sheet .lsys-hint")
    expect(hint).to_be_visible()
    assert before[0]["y"] + before[0]["height"] <= hint.bounding_box()["y"]
    panel.at(".lsys-canvas").click(position={"x": 2, "y": 2})
    expect(hint).to_be_hidden()
    assert boxes() == before


def test_a_constant_asks_once_for_each_setting_and_neighbours_are_fetched_ahead(explored):
    panel = explored("J4", 9)
    panel.control("lifeTimeB").press("ArrowRight")
    expect(panel.at(".lsys-word")).to_have_text("".join(map(str, derive(system("J4"), 9, lifeTimeB=3)[-1])))
    panel.page.wait_for_timeout(1200)
    asked = len(panel.asked)
    panel.control("lifeTimeB").press("ArrowRight")
    expect(panel.at(".lsys-word")).to_have_text("".join(map(str, derive(system("J4"), 9, lifeTimeB=4)[-1])))
    panel.control("lifeTimeB").press("ArrowLeft")
    expect(panel.at('.lsys-control[data-control="lifeTimeB"] input').first).to_have_value("3")
    assert panel.asked[asked:].count("book") == 0


def test_a_changed_constant_keeps_the_mark(explored):
    panel = explored("J4", 9)
    panel.more()
    panel.page.get_by_label("mark", exact=True).select_option("B(1)")
    panel.control("lifeTimeA").press("ArrowRight")
    expect(panel.at(".lsys-status")).to_contain_text("of 6 stages")
    expect(panel.page.get_by_label("mark", exact=True)).to_have_value("B(1)")
    pressed = panel.at('[data-place][aria-pressed="true"]')
    expect(pressed).to_have_count(1)
    expect(pressed).to_have_attribute("aria-label", re.compile(r"^stage B\(1\)"))


def test_a_setting_with_fewer_steps_does_not_forget_the_step_that_was_wanted(explored):
    panel = explored(read("c = 2 in 0 .. 4\naxiom: A(1)\nA(t) : t/c < 9 -> A(t+1)"), 6)
    for _ in range(2):
        panel.control("c").press("ArrowLeft")
    expect(panel.at(".lsys-status")).to_contain_text("division by zero")
    expect(panel.at(".lsys-status")).to_contain_text("step 0")
    panel.control("c").press("ArrowRight")
    expect(panel.at(".lsys-status")).to_contain_text("step 6")


def test_the_last_step_says_why_there_are_no_more(explored):
    panel = explored("K5", 4)
    panel.control("step").press("End")
    expect(panel.at(".lsys-status")).to_contain_text("Step 8 would have 976,561 modules; the limit is 250,000")


def test_rules_are_changed_broken_and_mended(explored):
    panel = explored("J1", 4)
    panel.view("rules")
    rules = panel.page.get_by_label("rules of the model")
    first = rules.input_value()
    rules.fill("axiom: a\na -> a b\nb -> a")
    expect(panel.at(".lsys-word")).to_have_text("abaababa")
    rules.fill("axiom: a\na -> a b\nb -> a(t)")
    expect(panel.at("mark.lsys-wrong")).to_have_text("t")
    expect(panel.at(".lsys-mistake")).to_contain_text('I do not know the name "t"')
    expect(panel.at(".lsys-word")).to_have_text("abaababa")  # the last good picture stays
    rules.fill("axiom: a\na -> a b\nb -> b")
    expect(panel.at(".lsys-word")).to_have_text("abbbb")
    expect(panel.at("mark.lsys-wrong")).to_have_count(0)
    panel.page.get_by_role("button", name="back to the first rules").click()
    expect(rules).to_have_value(first)
    expect(panel.at(".lsys-word")).to_have_text("".join(map(str, derive(system("J1"), 4)[-1])))


def test_a_module_is_traced_through_all_views(explored):
    panel = explored("J4", 10)
    panel.view("rules")
    panel.at('.lsys-module[data-position="2"]').click()
    expect(panel.at(".lsys-sentence")).to_have_text(
        "Cell 3 of step 10, Al(1). Mother: Bl(2), cell 3 of step 9; it divided by production 3, Bl(lifeTimeB) -> Al(1) Br(1); "
        "it becomes Al(2) at step 11."
    )
    expect(panel.at('[data-traced="self"]')).to_have_attribute("data-position", "2")
    expect(panel.at(".lsys-stage.lsys-lit")).to_have_attribute("aria-label", re.compile(r"^stage A\(1\)"))
    expect(panel.at("mark.lsys-applied")).to_have_text("Bl(lifeTimeB) -> Al(1) Br(1)")
    panel.control("step").press("ArrowLeft")
    expect(panel.at('[data-traced="mother"]')).to_have_attribute("data-position", "2")
    panel.control("step").press("ArrowRight")
    panel.control("step").press("ArrowRight")
    expect(panel.at('[data-traced="daughter"]')).to_have_attribute("data-position", "3")


def test_a_module_is_traced_by_the_keyboard(explored):
    panel = explored("J4", 10)
    word = panel.at(".lsys-word")
    for key, position in (("ArrowRight", "0"), ("ArrowRight", "1"), ("End", "11"), ("ArrowLeft", "10"), ("Home", "0")):
        word.press(key)
        expect(panel.at('[data-traced="self"]')).to_have_attribute("data-position", position)
    word.press("Escape")
    expect(panel.at("[data-traced]")).to_have_count(0)


def test_a_cell_of_the_drawing_is_traced_by_the_pointer(explored):
    panel = explored("J4", 10)
    canvas = panel.at("canvas")
    box = canvas.bounding_box()
    canvas.click(position={"x": box["width"] / 2 + 17, "y": 38})
    expect(panel.at(".lsys-sentence")).to_have_text("Cell 1 of step 0, Al(1) stands in the axiom; it becomes Al(2) at step 1.")


def test_what_the_mouse_is_on_is_lit_until_it_leaves(explored):
    panel = explored("J4", 10)
    canvas = panel.at("canvas")
    box = canvas.bounding_box()
    for position in (2, 5):
        panel.at(f'.lsys-module[data-position="{position}"]').hover()
        expect(panel.at('[data-traced="self"]')).to_have_attribute("data-position", str(position))
        expect(panel.at(".lsys-sentence")).to_contain_text(f"Cell {position + 1} of step 10")
    canvas.hover(position={"x": box["width"] / 2 + 17, "y": 38})
    expect(panel.at(".lsys-sentence")).to_contain_text("Cell 1 of step 0, Al(1) stands in the axiom")
    panel.at(".lsys-status").hover()
    expect(panel.at(".lsys-sentence")).to_have_text("")
    expect(panel.at("[data-traced]")).to_have_count(0)
    stage = panel.at(".lsys-stage").first
    stage.hover()
    expect(stage).to_have_class(re.compile("lsys-lit"))
    expect(stage).to_have_attribute("aria-pressed", "false")


def test_what_was_clicked_stays_lit_wherever_the_mouse_is(explored):
    panel = explored("J4", 10)
    panel.at('.lsys-module[data-position="2"]').click()
    panel.at('.lsys-module[data-position="5"]').hover()
    panel.at(".lsys-status").hover()
    expect(panel.at('[data-traced="self"]')).to_have_attribute("data-position", "2")


def test_long_numbers_of_a_word_are_shown_shorter_and_told_whole(explored):
    panel = explored(read("axiom: A(2/3) B(0.00012345678) C(117.61973158964844) D(0.25) E(1185/3840001)"), 0)
    assert word_in(panel) == "A(2/3)B(0.0001235)C(117.6)D(0.25)E(0.0003086)"
    told = [each.get_attribute("title") for each in panel.at("[data-position]").all()]
    assert told == [None, "B(0.00012345678)", "C(117.61973158964844)", None, "E(1185/3840001)"]


def test_a_small_stage_diagram_leaves_its_room_to_the_drawing(explored):
    wide = {view: explored("K5").at(f'[data-view="{view}"]').bounding_box()["width"] for view in ("stages", "drawing")}
    assert wide["stages"] <= 420
    assert wide["drawing"] > 900


def test_the_word_of_an_empty_drawing_says_so(explored):
    panel = explored(read("axiom: A\nA -> A A"), 2)
    expect(panel.at("canvas")).to_have_attribute("aria-label", re.compile("Drawing of step 2: 4 letters"))


def test_play_goes_on_stops_and_begins_again(explored):
    panel = explored("J1", 8)
    panel.more()
    panel.page.get_by_label("speed", exact=True).select_option("fast")
    panel.page.get_by_role("button", name="play", exact=True).click()
    expect(panel.page.get_by_role("button", name="pause", exact=True)).to_be_visible()
    expect(panel.at(".lsys-status")).to_contain_text(re.compile("step (9|10)"))
    panel.page.get_by_role("button", name="pause", exact=True).click()
    panel.page.get_by_role("button", name="one step back").click()
    panel.page.get_by_role("button", name="to step 0").click()
    expect(panel.at(".lsys-status")).to_contain_text("step 0")
    assert set(panel.asked) <= {"save"}


def test_a_click_into_the_plot_goes_to_a_step(explored):
    panel = explored("J4", 3)
    panel.view("how many")
    plot = panel.at(".lsys-counts")
    box = plot.bounding_box()
    plot.click(position={"x": box["width"] * (52 + 0.5 * 316) / 380, "y": box["height"] / 2})
    expect(panel.at(".lsys-status")).to_contain_text("step 10")
    expect(panel.at(".lsys-caption")).to_contain_text("1.3247")


def test_nine_seeds_beside_each_other(explored):
    panel = explored("K7", 3)
    panel.view("nine seeds")
    tiles = panel.at(".lsys-tile-button")
    expect(tiles).to_have_count(9)
    expect(tiles.first).to_have_attribute("aria-pressed", "true")
    before = panel.at("canvas.lsys-canvas").screenshot()
    tiles.nth(4).click()
    expect(tiles.nth(4)).to_have_attribute("aria-pressed", "true")
    expect(panel.page.get_by_label("seed", exact=True)).to_have_value("4")
    assert panel.at("canvas.lsys-canvas").screenshot() != before


def test_the_seed_given_first_stands_at_its_slider(explored):
    panel = explored("K7", 3, seed=5)
    expect(panel.page.get_by_label("seed", exact=True)).to_have_value("5")


def test_nine_variants_of_which_one_is_taken_on(explored):
    panel = explored("K5", 3)
    panel.view("nine variants")
    expect(panel.at(".lsys-tile-button")).to_have_count(9)
    panel.view("rules")
    rules = panel.page.get_by_label("rules of the model")
    first, before = rules.input_value(), panel.explorer.system
    panel.at(".lsys-tile-button").nth(2).click()
    expect(rules).not_to_have_value(first)
    panel.page.wait_for_function("window.asked.includes('rules')")
    expect(panel.at(".lsys-mistake")).to_have_text("")
    panel.page.wait_for_timeout(200)
    assert panel.explorer.system == read(rules.input_value()) != before


def test_the_code_that_is_taken_along_unfolds_the_same_stages(explored):
    panel = explored("K19", 3, unfold=("A", "I"))
    panel.more()
    panel.page.get_by_role("button", name="code").click()
    expect(panel.page.get_by_label("to be copied")).to_have_value('explore("K19", 3, unfold=["A","I"])')


def test_what_is_taken_along(explored):
    panel = explored("J4", 7)
    panel.more()
    panel.page.get_by_role("button", name="code").click()
    code = panel.page.get_by_label("to be copied")
    expect(code).to_have_value('explore("J4", 7)')
    panel.control("lifeTimeA").press("ArrowRight")
    panel.page.get_by_role("button", name="code").click()
    expect(code).to_have_value('explore("J4", 7, lifeTimeA=4)')
    with panel.page.expect_download() as kept:
        panel.page.get_by_role("button", name="SVG").click()
    assert kept.value.suggested_filename == "J4.svg"
    with panel.page.expect_download() as kept:
        panel.page.get_by_role("button", name="PNG").click()
    assert kept.value.suggested_filename == "J4.png"


@pytest.mark.parametrize(
    ("what", "name"),
    [
        ("K5", "K5"),
        ("axiom: F\nF -> F[+F]F", "L-system-51d4"),
        ("axiom: F\nF -> F[-F]F", "L-system-0e08"),
        ("K28", "K28"),
        ("map: A>B>C>D>\nA> -> A>", "map-5bb3"),
    ],
)
def test_a_file_that_is_taken_along_is_called_after_its_system(explored, what: str, name: str) -> None:
    panel = explored(what, 1)
    panel.more()
    for kind, suffix in (("SVG", "svg"), ("page", "html"), ("PNG", "png")):
        with panel.page.expect_download() as kept:
            panel.page.get_by_role("button", name=kind, exact=True).click()
        assert kept.value.suggested_filename == f"{name}.{suffix}"
