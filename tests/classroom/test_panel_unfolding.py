"""The unfolding of the panel: between two steps every module becomes its successor in place, all at the same time."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from playwright.sync_api import expect

from lsys_kit import derive, read
from lsys_kit.budget import limits
from lsys_kit.classroom.catalogue import system, systems
from lsys_kit.classroom.panel.books.book import book
from lsys_kit.errors import LSystemError
from lsys_kit.geometry.scene import OWN
from lsys_kit.geometry.unfolded import scenes_between
from lsys_kit.pictures.draw import state_colours
from tests.classroom.front_end import TURTLE, answers

STILL = {"reduced_motion": "reduce"}
VIEWS = ["word", "drawing", "unfolding"]
MOST_MODULES = 1_500
WAY = """
const opened = openBook(given.book), { angle } = given.book.turtle;
const drawn = (step) => placed(traced(opened, step), angle);
const betweenSteps = (step, part) => shapesBetween(opened, step, angle, part, [drawn(step), drawn(step + 1)]);
const taken = ({ x, y, z, strokes, palette, pixel }) => Array.from(strokes.positions, (position, i) =>
  [position, ...[strokes.from[i], strokes.to[i]].map((point) => [x[point], y[point], z ? z[point] : 0]),
    [strokes.widths[i] / (strokes.widths[i] < 0 ? 1 : pixel), palette[strokes.colours[i]]]]);
return given.steps.map((step) => ({
  before: taken(placed(traced(opened, step), angle)), after: taken(placed(traced(opened, step + 1), angle)),
  parts: given.parts.map((part) => taken(betweenSteps(step, part))),
}));
"""
OTHERS = {
    "a signal": "ignore: +-\naxiom: F(1)[+F(0)]F(0)[-F(0)]F(0)\nF(a) < F(b) : a == 1 && b == 0 -> F(1)\nF(a) -> F(a+1)",
    "chance": "axiom: F\nF -> F[+F]F : 1/3\nF -> F[-F]F : 1/3\nF -> FF : 1/3",
    "a stroke that becomes shorter": "angle: 60\naxiom: F(9)\nF(x) -> F(x/3) + F(x/3) - - F(x/3) + F(x/3)",
    "a stroke that becomes none": "axiom: F+F+F+F\nF -> A\nA -> F(2)",
    "turns that grow": "axiom: F +(10) F\n+(a) -> +(2*a)\nF -> F",
    "a branch that is cut": "axiom: F [ + F F ] F C(0)\nC(t) : t == 0 -> C(1)\nC(t) : t == 1 -> %\nF -> F F",
    "two letters replaced at once": "axiom: A B F\nA -> F [ + A ] B\nB -> F",
    "a plant": "axiom: F\nF -> F[+F]F[-F]F",
    "widths": "axiom: !(0.2) F [ + A ] A\nA -> !(0.1) F A\n!(w) -> !(1.2*w)",
    "widths in units": "widths: units\naxiom: !(0.2) F [ + A ] A\nA -> !(0.1) F A\n!(w) -> !(1.2*w)",
    "widths in pixels": "widths: pixels\naxiom: !(9) F [ + A ] A\nA -> !(3) F A\n!(w) -> !(1.2*w)",
    "colours that are chosen": "axiom: ;(3) F A\nA -> ;(5) F [ + A ]\n;(c) -> ;(c+1)",
}


@pytest.fixture(scope="module")
def page(browser):
    return browser.new_page()


def way(page, found, parts, most=MOST_MODULES):
    """For each step of a book, but the last, its strokes, those of the next step, and those of some parts of the way."""
    with limits(modules=most, seconds=5):
        made = book(found)
    asked = {"book": made, "steps": [*range(min(made["steps"], 6))], "parts": parts}
    return answers(page, WAY, asked, *TURTLE, "chance", "book", "unfolded")


def size(start, end):
    return sum((a - b) ** 2 for a, b in zip(start, end, strict=True)) ** 0.5


def chains(strokes):
    """For each module that draws how far it draws, and from where to where."""
    found = {}
    for position, group in itertools.groupby((each for each in strokes if size(*each[1:3]) > 1e-12), key=lambda each: each[0]):
        rows = [*group]
        found.setdefault(position, []).extend([rows[0][1], rows[-1][2], [sum(size(*row[1:3]) for row in rows)]])
    return found


def looks(strokes):
    """For each module that draws how broad, and of which colours, its strokes are."""
    found = {}
    for position, start, end, look in strokes:
        if size(start, end) > 1e-12:
            found.setdefault(position, []).append(look)
    return found


def expect_ends(page, found, *parts):
    """The ends of the way are the steps; so are other parts of it, next to its ends, as far as one can see."""
    for ends in way(page, found, [0, 1, *parts]):
        for number in range(0, len(ends["parts"]), 2):
            expect_end(ends, *ends["parts"][number : number + 2])


def expect_end(ends, begun, done):
    for one, other in ((chains(begun), chains(ends["before"])),):
        assert one.keys() == other.keys()
        for position, places in one.items():
            for place, same in zip(places, other[position], strict=True):
                assert place == pytest.approx(same, abs=1e-9, rel=1e-9)
    assert looks(begun).keys() == looks(ends["before"]).keys()
    for position, there in looks(begun).items():
        allowed = looks(ends["before"])[position]
        for width, colour in there:
            assert any(colour == same and width == pytest.approx(wide, abs=1e-9, rel=1e-9) for wide, same in allowed)
    drawn, later = ([each[1:] for each in strokes if size(*each[1:3]) > 1e-12] for strokes in (done, ends["after"]))
    assert len(drawn) == len(later)
    for (*one, (width, colour)), (*other, (wide, same)) in zip(drawn, later, strict=True):
        for place, there in zip(one, other, strict=True):
            assert place == pytest.approx(there, abs=1e-9, rel=1e-9)
        assert (width, colour) == (pytest.approx(wide, abs=1e-9, rel=1e-9), same)


@pytest.mark.parametrize("text", OTHERS.values(), ids=OTHERS)
def test_the_unfolding_begins_with_a_step_and_ends_with_the_next(page, text):
    expect_ends(page, read(text), 1e-14, 1 - 1e-14)


def drawn_by_turtles():
    for id in systems():
        try:
            with limits(modules=300, seconds=5):
                if book(system(id))["mode"] in ("plane", "space"):
                    yield id
        except LSystemError:
            continue


def by_kit(found, step, part):
    """The ends, the widths and the colours of all strokes of a part of the way, as the turtle of the kit draws them."""
    derivation = derive(found, step + 1, seed=found.seed)
    segments = scenes_between(derivation, step)(part).segments
    ends = segments.ends if segments.ends.shape[1] == 6 else np.insert(segments.ends, (2, 4), 0, axis=1)
    own, turtle, many = state_colours(derivation), book(found)["turtle"], len(segments)
    looks = zip(segments.states, np.broadcast_to(segments.colours, many), strict=True)
    chosen = turtle["colours"]
    colours = [own[state] if number == OWN else chosen[number % len(chosen)] for state, number in looks]
    return ends, None if turtle["widths"] == "auto" else [*np.broadcast_to(segments.widths, many)], colours


@pytest.mark.parametrize("id", ["T2", "K2", "K4", "K6", "K12", "K19", "K22", "L3", *OTHERS])
def test_the_panel_and_the_films_of_the_kit_unfold_alike(page, id):
    found = read(OTHERS[id]) if id in OTHERS else system(id)
    for step, ends in enumerate(way(page, found, [0.3, 0.75], 500)):
        for part, strokes in zip((0.3, 0.75), ends["parts"], strict=True):
            drawn = np.array([[*start, *end] for _, start, end, _ in strokes]).reshape(-1, 6)
            places, widths, colours = by_kit(found, step, part)
            assert drawn == pytest.approx(places, abs=1e-9, rel=1e-9)
            if widths:  # others are fitted to a frame: that of a step in a panel, and of all in a film
                assert [look[0] for *_, look in strokes] == pytest.approx(widths, abs=1e-9, rel=1e-9)
            assert [look[1] for *_, look in strokes] == colours


@pytest.mark.slow
def test_so_it_does_for_every_system_of_the_catalogue(page):
    wrong = {}
    for id in drawn_by_turtles():
        try:
            expect_ends(page, system(id))
        except AssertionError as error:
            wrong[id] = str(error).splitlines()[0]
    assert wrong == {}


ROWS = """
const opened = openBook(given.book);
return given.steps.map((step) => {
  const [sheet, next] = [step, step + 1].map((each) => sequence(opened, each));
  const mothers = singleRow(sheet, sheet.rows.length - 1), last = singleRow(next, next.rows.length - 1);
  const spans = spansOf(opened, step, mothers, last), taken = ({ cells, middle }) =>
    Array.from(cells.x, (x, i) => [x - cells.length[i] / 2, x + cells.length[i] / 2, middle]);
  return {
    before: taken(mothers), after: taken(last), own: Array.from(mothers.cells.position),
    mothers: Array.from(last.cells.position, (position) => opened.mother(step + 1, position)),
    begun: taken(moved(mothers, last, spans.before, 0)), done: taken(moved(mothers, last, spans.before, 1)),
    divided: taken(moved(last, mothers, spans.after, 1)), grown: taken(moved(last, mothers, spans.after, 0)),
  };
});
"""
FILAMENT = ("numbers", "constants", "colours", "outlines", "filament", "book", "dividing")


@pytest.mark.parametrize("id", ["J1", "J4", "P6"])
def test_a_row_of_cells_becomes_the_next_and_daughters_fill_their_mother(page, id):
    made = book(system(id))
    for ends in answers(page, ROWS, {"book": made, "steps": [*range(8)]}, *FILAMENT):
        for one, other in (("begun", "before"), ("grown", "after")):
            assert [*itertools.chain(*ends[one])] == pytest.approx([*itertools.chain(*ends[other])], abs=1e-9)
        for position, (start, end, middle) in zip(ends["own"], ends["before"], strict=True):
            cells = [cell for cell, mother in zip(ends["divided"], ends["mothers"], strict=True) if mother == position]
            edges = [start, *(edge for cell in cells for edge in cell[:2]), end]
            assert edges[::2] == pytest.approx(edges[1::2], abs=1e-9)
            assert [cell[2] for cell in cells] == pytest.approx([middle] * len(cells))
        assert [cell[2] for cell in ends["done"]] == pytest.approx([ends["after"][0][2]] * len(ends["done"]))


def line(panel):
    return panel.at("[data-view=unfolding] .lsys-caption[role=status]")


@pytest.mark.browser
@pytest.mark.parametrize("id", ["T2", "J1", "K19"])
def test_one_slider_leads_from_a_step_to_the_next_as_a_film(explored, id):
    panel = explored(id, 2, show=VIEWS)
    canvas, bar = panel.at("canvas.lsys-canvas"), panel.control("unfolding")
    pictures = [canvas.screenshot()]
    for at in range(1, 20):
        bar.press("ArrowRight")
        expect(line(panel)).to_have_text(f"{5 * at} of 100 on the way from step 2 to step 3.")
        if not at % 6:
            pictures.append(canvas.screenshot())
    assert len({*pictures}) == 4
    bar.press("ArrowRight")
    expect(line(panel)).to_have_text("0 of 100 on the way from step 3 to step 4.")
    expect(canvas).to_have_attribute("data-step", "3")
    arrived = canvas.screenshot()
    panel.control("step").press("ArrowLeft")
    panel.control("step").press("ArrowRight")
    expect(canvas).to_have_attribute("data-step", "3")
    assert canvas.screenshot() == arrived


@pytest.mark.browser
def test_what_is_dragged_to_the_next_step_stays_there_until_it_is_let_go(explored):
    panel = explored("K5", 1, show=VIEWS)
    bar, mouse = panel.control("unfolding"), panel.page.mouse
    box = bar.bounding_box()
    start, end, height = box["x"] + 8, box["x"] + box["width"] - 8, box["y"] + box["height"] / 2
    for step in (2, 3):
        mouse.move(start, height)
        mouse.down()
        for x in (end, end + 1, end + 2, end - 1, end):
            mouse.move(x, height)
        expect(line(panel)).to_have_text(f"0 of 100 on the way from step {step} to step {step + 1}.")
        mouse.up()
        expect(bar).to_have_value("0")
        height = (box := bar.bounding_box())["y"] + box["height"] / 2


@pytest.mark.browser
@pytest.mark.parametrize("context", [{}, STILL], ids=["moving", "still"])
def test_it_unfolds_by_itself_up_to_the_last_step(explored, context):
    panel = explored("axiom: F\nF -> F+F", 8, show=VIEWS, context=context)
    panel.at("[data-view=unfolding] select").select_option("1.5")
    panel.at("[data-view=unfolding] .lsys-play").click()
    expect(line(panel)).to_have_text("This is the last step that is here.")
    expect(panel.at("canvas.lsys-canvas")).to_have_attribute("data-step", "10")
    expect(panel.at("[data-view=unfolding] .lsys-play")).to_have_attribute("aria-label", "let it unfold")


@pytest.mark.browser
def test_the_letters_of_the_word_part(explored):
    panel = explored("J1", 2, show=VIEWS)
    pieces = panel.at("[data-view=unfolding] .lsys-word > span")
    widths = [pieces.nth(2).bounding_box()["width"]]
    for _ in range(2):
        for _ in range(8):
            panel.control("unfolding").press("ArrowRight")
        expect(line(panel)).to_contain_text("0 of 100")
        widths.append(pieces.nth(2).bounding_box()["width"])
    assert widths == sorted({*widths})
    expect(pieces).to_have_count(3)


@pytest.mark.browser
def test_what_cannot_unfold_is_said(explored):
    panel = explored("K5", 1, show=VIEWS)
    panel.control("step").press("End")
    expect(line(panel)).to_have_text("This is the last step that is here.")
    panel.control("unfolding").press("End")
    expect(line(panel)).to_have_text("This is the last step that is here.")
    panel.control("step").press("ArrowLeft")
    expect(line(panel)).to_contain_text("is too large to be seen to unfold; go back to an earlier step.")
