"""The walk of the panel: the turtle obeys a word command by command, and brackets let turtles wait."""

from __future__ import annotations

import math
import re
from itertools import accumulate

import pytest
from playwright.sync_api import expect

from lsys_kit import derive, explore, read
from lsys_kit.classroom.catalogue import system
from lsys_kit.classroom.panel.bundle import source
from lsys_kit.classroom.panel.page import unasked
from tests.classroom.front_end import PAINTER, answers, book_of

PHONE = {"viewport": {"width": 400, "height": 860}, "has_touch": True}
STILL = {"reduced_motion": "reduce"}
VIEWS = ["word", "rules", "drawing", "walk"]
STANCES = """
return given.map(({ book, angle }) => {
  const opened = bookOf(book), walk = walkOf(opened, 0), { stops } = walk, { strokes } = placed(traced(opened, 0), angle);
  return {
    stances: stops.map((stop) => stanceOf(opened, 0, angle, stop)), positions: Array.from(strokes.positions),
    waiting: stops.map((_, at) => waitingAt(walk, at).map(({ place }) => place)),
    turns: stops.map((_, at) => turnBefore(opened, walk, at, angle)?.degrees ?? null),
  };
});
"""


@pytest.fixture(scope="module")
def page(browser):
    return browser.new_page()


def walked(page, word, angle):
    """Where the turtle stands after each module of a word."""
    return answers(page, STANCES, [{"book": book_of([word]), "angle": angle}], *PAINTER, "walking")[0]


SPACE = r"axiom: F /(90) &(60) F [ +(45) F ] \(30) F [ ^(50) F [ -(30) F F ] F ] $ F"
WORDS = {
    "a plant": (derive(system("K5"), 2)[2], 25.7),
    "a curve": (derive(system("T2"), 2)[2], 60.0),
    "a turtle whose left is to the right": (derive(system("K2"), 4)[4], 30.0),
    "in space": (derive(read(SPACE), 0)[0], 22.5),
}


@pytest.mark.parametrize("name", WORDS)
def test_the_turtle_goes_where_its_head_points_and_comes_back_to_where_it_waited(page, name):
    word, angle = WORDS[name]
    found, stack = walked(page, word, angle), []
    stances = found["stances"]
    assert len(stances) == len(word) + 1
    for at, (module, before, after) in enumerate(zip(word, stances, stances[1:], strict=False)):
        way = [b - a for a, b in zip(before["place"], after["place"], strict=True)]
        if at in found["positions"]:
            size = math.hypot(*way)
            assert [part / size for part in way] == pytest.approx(before["head"], abs=1e-9)
        if module.symbol == "[":
            stack.append((at + 1, before))
        elif module.symbol == "]":
            _, waited = stack.pop()
            for part in ("place", "head", "left", "up"):
                assert after[part] == pytest.approx(waited[part], abs=1e-9)
        elif at not in found["positions"]:
            assert way == pytest.approx([0, 0, 0], abs=1e-9)
        assert found["waiting"][at + 1] == [place for place, _ in reversed(stack)]
    for stance in stances:
        axes = [stance[name] for name in ("head", "left", "up")]
        assert [sum(a * b for a, b in zip(one, other, strict=True)) for one in axes for other in axes] == pytest.approx(
            [1, 0, 0, 0, 1, 0, 0, 0, 1], abs=1e-9
        )


def test_a_turn_swings_the_head_by_its_angle(page):
    found = walked(page, derive(read(SPACE), 0)[0], 22.5)
    turns = [each for each in found["turns"] if each is not None]
    assert turns == [-90, 60, 45, 30, -50, -30]
    for degrees, before, after in zip(found["turns"][1:], found["stances"], found["stances"][1:], strict=False):
        if degrees:
            angles = [sum(a * b for a, b in zip(before[each], after[each], strict=True)) for each in ("head", "left", "up")]
            assert sorted(angles) == pytest.approx(sorted([1, *2 * [math.cos(math.radians(degrees))]]), abs=1e-9)


def line(panel):
    return panel.at("[data-view=walk] .lsys-caption[role=status]")


def stride_of(panel):
    return panel.at("[data-control=stride] select")


@pytest.mark.browser
def test_keys_lead_along_the_word_and_letter_production_and_pile_are_shown(explored):
    panel = explored("K5", 1, show=VIEWS)
    expect(line(panel)).to_have_text("The turtle stands at the beginning of the word. It is at (0, 0) and looks towards 90°.")
    bar = panel.control("command")
    told = [
        "1 of 11, F: draws a stroke, 1 long. It is at (0, 1) and looks towards 90°.",
        "2 of 11, [: lets turtle 1 wait here. It is at (0, 1) and looks towards 90°.",
        "3 of 11, +: turns left by 25.7°. It is at (0, 1) and looks towards 115.7°.",
        "4 of 11, F: draws a stroke, 1 long. It is at (-0.43, 1.9) and looks towards 115.7°.",
        "5 of 11, ]: goes back to where turtle 1 waited. It is at (0, 1) and looks towards 90°.",
    ]
    for at, text in enumerate(told):
        bar.press("ArrowRight")
        expect(line(panel)).to_have_text(text)
        expect(panel.at("[data-traced=self]")).to_have_attribute("data-position", str(at))
        expect(panel.at("[data-view=walk] svg g")).to_have_count(1 if at in (1, 2, 3) else 0)
    expect(panel.at(".lsys-backdrop mark.lsys-applied")).to_have_text("F -> F [+ F] F [- F] F")
    bar.press("ArrowLeft")
    expect(line(panel)).to_have_text(told[3])
    bar.press("Home")
    expect(panel.at("[data-traced]")).to_have_count(0)
    stride_of(panel).select_option("bracket")
    panel.at("[data-view=walk]").get_by_role("button", name="one stride on").click()
    expect(line(panel)).to_have_text(told[1])


def ends_of(word, stride):
    """After how many modules of a word a stride ends: where a branch is done, perhaps of an order."""
    depths = list(accumulate([0, *({"[": 1, "]": -1}.get(module.symbol, 0) for module in word)]))
    ends = [at for at in range(1, len(depths)) if depths[at] < depths[at - 1] and stride in ("branch", str(depths[at - 1]))]
    return [*(at for at in ends if at < len(word)), len(word)]


@pytest.mark.browser
@pytest.mark.parametrize("stride", ["branch", "1", "2"])
def test_a_stride_goes_to_where_a_branch_is_done_and_back(explored, stride):
    panel, word = explored("K5", 2, show=VIEWS), derive(system("K5"), 2)[2]
    tools, ends = panel.at("[data-view=walk]"), ends_of(word, stride)
    stride_of(panel).select_option(stride)
    for at in ends:
        tools.get_by_role("button", name="one stride on").press("Enter")
        expect(line(panel)).to_contain_text(f"{at} of {len(word)}, ")
    for at in reversed(ends[:-1]):
        tools.get_by_role("button", name="one stride back").press("Enter")
        expect(line(panel)).to_contain_text(f"{at} of {len(word)}, ]: goes back to where turtle")


@pytest.mark.browser
def test_strides_are_gone_by_themselves_and_are_of_one_command_where_there_are_no_brackets(explored):
    panel = explored("K5", 3, show=VIEWS)
    stride_of(panel).select_option("1")
    panel.control("pace").press("End")
    panel.at("[data-view=walk] .lsys-play").click()
    expect(line(panel)).to_contain_text("311 of 311, F")
    panel.control("step").press("Home")
    expect(stride_of(panel)).to_be_hidden()
    panel.at("[data-view=walk]").get_by_role("button", name="one stride on").click()
    expect(line(panel)).to_contain_text("1 of 1, F: draws a stroke")
    panel.control("step").press("ArrowRight")
    expect(stride_of(panel)).to_have_value("command")


@pytest.mark.browser
def test_a_stroke_that_is_clicked_is_where_the_walk_goes_on(explored):
    panel = explored("K5", 1, show=VIEWS)
    canvas = panel.at("canvas.lsys-canvas")
    expect(canvas).to_be_visible()
    canvas.click()
    expect(line(panel)).to_contain_text("6 of 11, F: draws a stroke")
    panel.at("[data-view=walk]").get_by_role("button", name="one stride on").click()
    expect(line(panel)).to_contain_text("7 of 11, [")


@pytest.mark.browser
def test_what_is_clicked_is_where_the_walk_goes_on(explored):
    panel = explored("K5", 1, show=VIEWS)
    panel.at('.lsys-word [data-position="7"]').click()
    expect(line(panel)).to_contain_text("8 of 11, -: turns right by 25.7°.")
    panel.at("canvas.lsys-canvas").press("n")
    expect(line(panel)).to_contain_text("9 of 11, F: draws a stroke")
    before = panel.at("canvas.lsys-canvas").screenshot()
    panel.at("canvas.lsys-canvas").press("p")
    expect(line(panel)).to_contain_text("8 of 11")
    assert panel.at("canvas.lsys-canvas").screenshot() != before


@pytest.mark.browser
@pytest.mark.parametrize("context", [{}, STILL, PHONE], ids=["moving", "still", "by touch"])
def test_the_turtle_walks_by_itself_to_the_end(explored, context):
    panel = explored("K5", 1, show=VIEWS, context=context)
    play = panel.at("[data-view=walk] .lsys-play")
    panel.control("pace").press("End")
    play.tap() if context is PHONE else play.click()
    expect(line(panel)).to_contain_text("11 of 11, F: draws a stroke, 1 long. It is at (0, 3)")
    expect(play).to_have_attribute("aria-label", "let the turtle walk")


@pytest.mark.browser
def test_another_step_ends_the_walk_and_a_word_that_is_too_long_is_said_to_be(explored):
    panel = explored("K5", 1, show=VIEWS)
    panel.control("command").press("End")
    panel.control("step").press("ArrowRight")
    expect(line(panel)).to_contain_text("The turtle stands at the beginning of the word.")
    panel.control("step").press("End")
    expect(line(panel)).to_contain_text("is too long to be walked; go back to an earlier step.")
    panel.control("step").press("Home")
    expect(line(panel)).to_contain_text("The turtle stands at the beginning of the word.")


@pytest.mark.browser
def test_rules_that_are_typed_have_a_walk_of_their_own(explored):
    panel = explored("axiom: F [ + F ] A", 0, show=VIEWS)
    panel.control("command").press("End")
    expect(line(panel)).to_contain_text("6 of 6, A: is no command, and nothing happens.")
    panel.at("textarea").fill("angle: 30\naxiom: F |(20) X")
    expect(panel.at(".lsys-status").first).to_contain_text("3 modules")
    panel.control("command").press("ArrowRight")
    expect(line(panel)).to_contain_text("1 of 3, F: draws a stroke")


def test_cells_have_no_walk(explored):
    panel = explored("J1", 3, show=["word", "drawing", "walk"])
    expect(panel.at("[data-view=walk]")).to_be_hidden()


def test_a_page_has_the_walk_where_it_is_open(tmp_path):
    sizes = {}
    for views in (["drawing"], ["drawing", "walk"]):
        panel = explore("K5", 1, show=views)
        panel.save(tmp_path / "page.html")
        sizes[len(views)] = (tmp_path / "page.html").stat().st_size
        panel.close()
    assert 2_000 < sizes[2] - sizes[1] < 8_000
    assert unasked([{"show": ["walk"]}]) == {"chance", "gallery", "letters", "sample", "sentence", "unfolding"}


def test_every_text_of_the_walk_can_be_translated():
    spoken = source("walk")
    assert not re.findall(r'textContent = "\w', spoken)


@pytest.mark.browser
def test_the_pile_stays_where_it_is_and_where_a_character_comes_from_is_told_below_it(explored):
    panel = explored("K5", 1, show=["word", "drawing", "walk"])
    pile, tops = panel.at("[data-view=walk] svg[width='220']"), set()
    for _ in range(3):
        tops.add(pile.bounding_box()["y"])
        panel.control("command").press("ArrowRight")
    expect(panel.at("[data-view=walk] .lsys-sentence")).to_contain_text("Character 3 of step 1")
    told = panel.at(".lsys-sentence").bounding_box()["y"]
    assert len(tops) == 1
    assert told >= pile.bounding_box()["y"] + pile.bounding_box()["height"]
