"""Maps in the panel, in a browser: it has the maps that are derived, shows them, and answers to whoever points at them."""

from __future__ import annotations

import re
from itertools import pairwise

import numpy as np
import pytest
from playwright.sync_api import expect

from lsys_kit import derive, explore, map_system, read_map
from lsys_kit.classroom.panel.bundle import bundled
from lsys_kit.geometry.tissues.layout import initial_vertices, place_maps, tissue
from lsys_kit.geometry.tissues.relaxation import Forces, areas, force, relax
from tests.classroom.front_end import called
from tests.classroom.test_map_book import FLAT

MAPS = """
const opened = openBook(book), plain = (numbers) => Array.from(numbers);
return opened.lengths().map((_, step) => {
  const { n, x, y, strokes, cells } = mapShapes(opened, step), word = plain(opened.word(step));
  const first = step && grownShapes(opened, step, 0), last = step && grownShapes(opened, step, 1);
  return {
    walls: word.map((state) => opened.label(state).text),
    letters: word.map((state) => opened.label(state).letter + opened.label(state).subscript),
    ends: plain(strokes.from).map((from, i) => [from, strokes.to[i]]), points: plain(x).map((place, i) => [place, y[i]]),
    counts: [n, opened.length(step), cells.starts.length - 1], tokens: opened.tokens(step), size: sizeOf(opened, step),
    mothers: word.map((_, i) => opened.mother(step, i)),
    halves: word.flatMap((_, i) => step && opened.mother(step, i) < 0 ? [wallsBeside(opened, step, i)] : []).map((pair) =>
      pair.map((each) => opened.production(step, each))),
    first: step && plain(first.x).slice(0, n).map((place, i) => [place, first.y[i]]),
    moved: step && plain(last.x).slice(0, n).map((place, i) => [place, last.y[i]]),
    short: step && plain(first.strokes.from).map((one, i) => ["x", "y"].map((axis) =>
      first[axis][one] - first[axis][first.strokes.to[i]])),
  };
});
"""
HITS = """
const opened = openBook(book), shapes = mapShapes(opened, step), { from, to } = shapes.strokes;
const frame = frameOf(shapes, 400, 300), { x0, y0, scale, middle } = frame;
const seen = (point) => [x0 + (shapes.x[point] - middle[0]) * scale, y0 - (shapes.y[point] - middle[1]) * scale];
return Array.from(from, (one, wall) => {
  const [[a, b], [c, d]] = [seen(one), seen(to[wall])];
  return shapeAt(shapes, frame, (a + c) / 2, (b + d) / 2, 6);
});
"""
PIXELS = "document.querySelector('canvas.lsys-canvas').toDataURL()"
UNIT = 8


@pytest.fixture(scope="module")
def page(browser):
    return browser.new_page()


def asked(page, code, **given):
    """What some code makes of what is given, with the scripts of the panel before it."""
    names = frozenset(re.findall(r"\b\w+(?=\()", code))
    return called(page, bundled("page", also=names), f"({{ {', '.join(given)} }}) => {{ {code} }}", given)


@pytest.mark.parametrize("id", FLAT)
def test_the_browser_has_the_maps_that_are_derived(page, id):
    made = map_system(id)
    shown = asked(page, MAPS, book=explore(id).model["book"])
    maps = derive(made, len(shown) - 1)
    places = [*place_maps(maps)]
    assert len(shown) > made.steps
    for step, (found, here) in enumerate(zip(maps, shown, strict=True)):
        assert here["walls"] == [wall.label + ">" * wall.directed for wall in found.walls]
        assert here["letters"] == [wall.label for wall in found.walls]
        assert here["ends"] == [[wall.start, wall.end] for wall in found.walls]
        assert tuple(here["counts"]) == found.counts
        assert sum(here["tokens"]) == len(found.walls)
        assert np.allclose(np.array(here["points"]) / UNIT, places[step], atol=1e-4)
        vertices, walls, cells = found.counts
        assert here["size"] == f"{vertices} vertices, {walls} wall{'s' * (walls != 1)}, {cells} cell{'s' * (cells != 1)}"
        if step:
            assert np.allclose(np.array(here["first"]) / UNIT, initial_vertices(found, places[step - 1]), atol=1e-4)
            assert np.allclose(here["moved"], here["points"], atol=1e-9)


@pytest.mark.parametrize("id", FLAT)
def test_walls_without_a_mother_grow_from_a_point(page, id):
    shown = asked(page, MAPS, book=explore(id).model["book"])
    for before, here in pairwise(shown):
        assert here["mothers"].count(-1) == here["counts"][2] - before["counts"][2]
        for mother, (across, up) in zip(here["mothers"], here["short"], strict=True):
            assert (mother == -1) == (abs(across) + abs(up) < 1e-9)


@pytest.mark.parametrize("id", FLAT)
def test_a_wall_without_a_mother_was_made_by_two_markers_of_its_letter(page, id):
    productions = map_system(id).productions
    for here in asked(page, MAPS, book=explore(id).model["book"])[1:]:
        new = [letter for letter, mother in zip(here["letters"], here["mothers"], strict=True) if mother < 0]
        for letter, halves in zip(new, here["halves"], strict=True):
            assert all(letter in {marker.edge.label for marker in productions[rule].markers} for rule in halves)
            assert len(halves) == 2


@pytest.mark.parametrize("id", FLAT)
def test_whoever_points_at_the_middle_of_a_wall_finds_it(page, id):
    panel = explore(id)
    found = asked(page, HITS, book=panel.model["book"], step=panel.step)
    assert found == [*range(len(found))]


def test_a_panel_shows_a_map_with_its_word_its_stages_and_its_size(explored):
    panel = explored("K30", 2)
    expect(panel.at(".lsys-status")).to_have_text("step 2: 8 vertices, 10 walls, 3 cells; 4 of 4 stages occupied")
    assert panel.at(".lsys-module").all_inner_texts() == [f"{wall.label}>" for wall in derive(map_system("K30"), 2)[-1].walls]
    assert [panel.at(f"[data-place='{place}']").get_attribute("aria-label") for place in range(4)] == [
        "stage A, 1 token",
        "stage B, 7 tokens",
        "stage C, 1 token",
        "stage D, 1 token",
    ]
    panel.view("how many")
    expect(panel.at(".lsys-counts")).to_have_attribute(
        "aria-label", "Walls a step: " + "; ".join(f"step {step}, {4 + 3 * step}" for step in range(12))
    )
    panel.page.get_by_role("button", name="one step on").click()
    expect(panel.at(".lsys-status")).to_contain_text("10 vertices, 13 walls, 4 cells")
    assert "book" not in panel.asked


def test_directions_and_labels_can_be_left_out(explored):
    panel = explored("K30", 3)
    seen = [panel.page.evaluate(PIXELS)]
    for name in ("directions", "labels"):
        panel.page.get_by_label(name, exact=True).uncheck()
        panel.page.wait_for_timeout(200)
        seen.append(panel.page.evaluate(PIXELS))
    assert len(set(seen)) == 3
    panel.page.get_by_label("directions", exact=True).check()
    panel.page.get_by_label("labels", exact=True).check()
    panel.page.wait_for_timeout(200)
    assert panel.page.evaluate(PIXELS) == seen[0]


def test_walls_that_point_nowhere_have_no_directions_to_be_left_out(explored):
    panel = explored("K28", 1)
    expect(panel.page.get_by_label("labels", exact=True)).to_be_visible()
    expect(panel.page.get_by_label("directions", exact=True)).to_be_hidden()


def test_a_panel_of_cells_has_no_signs_of_walls(explored):
    panel = explored("J4", 3)
    assert panel.page.get_by_label("labels", exact=True).count() == 0


def test_a_wall_is_traced_to_its_mother_and_its_daughters(explored):
    panel = explored("K30", 1)
    panel.view("rules")
    panel.at("[data-position='0']").click()
    expect(panel.at(".lsys-sentence")).to_have_text(
        "Wall 1 of step 1, D> comes from A>, wall 1 of step 0, by production 1, A> -> D>[-A>]B>; it becomes C> at step 2."
    )
    expect(panel.at(".lsys-applied")).to_have_text("A> -> D>[-A>]B>")
    panel.at("[data-position='6']").click()
    expect(panel.at(".lsys-sentence")).to_contain_text(
        "Wall 7 of step 1, A> is new and divides a cell: markers of A>, wall 1, and C>, wall 3 of step 0 match"
    )
    expect(panel.at(".lsys-applied")).to_have_text(["A> -> D>[-A>]B>", "C> -> B>[-A<]B>"])
    panel.page.get_by_role("button", name="one step back").click()
    expect(panel.at("[data-traced='mother']")).to_have_text(["A>", "C>"])


def test_a_wall_of_the_drawing_is_traced_by_a_click(explored):
    panel = explored("K28", 0)
    box = panel.at("canvas.lsys-canvas").bounding_box()
    found = set()
    for across, up in ((0, -1), (1, 0), (0, 1), (-1, 0)):
        side = 0.2791 * UNIT * 120 / 2  # at rest a square cell has this wall; its scale is the greatest one
        panel.page.mouse.click(box["x"] + box["width"] / 2 + across * side, box["y"] + box["height"] / 2 + up * side)
        found.add(panel.at(".lsys-sentence").inner_text().partition(" of step 0")[0])
    assert found == {"Wall 1", "Wall 2", "Wall 3", "Wall 4"}
    expect(panel.at(".lsys-module[data-traced='self']")).to_have_text("B")


def test_a_force_that_is_moved_asks_for_another_book_and_changes_the_map(explored):
    panel = explored("K29", 3)
    before = panel.page.evaluate(PIXELS)
    box = panel.page.get_by_role("textbox", name="pressure")
    box.fill("0.8")
    box.press("Enter")
    panel.page.wait_for_function("host.get('settings').pressure === '0.8' && window.asked.includes('save')")
    panel.page.wait_for_function(f"{PIXELS} !== before".replace("before", repr(before)))
    assert panel.asked[0] == "book"
    panel.page.get_by_role("button", name="reset").click()
    panel.page.wait_for_function(f"{PIXELS} === {before!r}")


def test_rules_of_a_map_are_broken_and_mended_in_the_editor(explored):
    panel = explored("K28", 2)
    panel.view("rules")
    editor = panel.at("textarea.lsys-rules")
    text = map_system("K28").source
    editor.fill(text.replace("[+A]B", "[+A B"))
    expect(panel.at(".lsys-mistake")).to_contain_text("A marker has one letter")
    expect(editor).to_have_attribute("aria-invalid", "true")
    expect(panel.at(".lsys-status")).to_contain_text("step 2: 9 vertices, 12 walls, 4 cells")
    mended = text.replace("[-A][+A]", "x[-A][+A]x")
    editor.fill(mended)
    vertices, walls, cells = derive(read_map(mended), 2)[-1].counts
    assert walls > 12
    expect(panel.at(".lsys-status")).to_contain_text(f"step 2: {vertices} vertices, {walls} walls, {cells} cells")
    expect(panel.at(".lsys-mistake")).to_be_empty()
    expect(editor).not_to_have_attribute("aria-invalid", "true")
    assert str(panel.explorer.system.productions[0]) == "A -> Bx[-A][+A]xB"


@pytest.mark.parametrize("dark", [False, True])
def test_marked_walls_are_marked_in_word_and_drawing(explored, dark):
    panel = explored("K32", 8, dark=dark)
    before = panel.page.evaluate(PIXELS)
    panel.more()
    panel.page.get_by_label("mark", exact=True).select_option("V")
    expect(panel.at(".lsys-marked")).to_have_text(["V>"] * 4)
    panel.page.wait_for_function(f"{PIXELS} !== {before!r}")


def test_playing_ends_at_the_last_step(explored):
    panel = explored("K30", 10)
    panel.page.get_by_role("button", name="play", exact=True).click()
    expect(panel.at(".lsys-status")).to_contain_text("step 12: 28 vertices, 40 walls, 13 cells")
    expect(panel.at("canvas.lsys-canvas")).to_have_attribute("data-step", "12")


def test_a_page_without_a_kernel_shows_a_map(explored, browser, tmp_path):
    file = tmp_path / "map.html"
    panel = explore("K29", 2)
    panel.pressure = 0.5
    panel.save(file)
    page = browser.new_page()
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(file.as_uri())
    expect(page.locator(".lsys-status")).to_contain_text("step 2: 14 vertices, 17 walls, 4 cells")
    box = page.get_by_role("textbox", name="pressure")
    expect(box).to_have_value("0.5")
    before = page.evaluate(PIXELS)
    box.fill("0.8")
    box.press("Enter")
    page.wait_for_url("**/map.html#*")  # what is seen is put into the address when the movement has come to rest
    assert page.evaluate(PIXELS) != before
    again = browser.new_page()
    again.goto(page.url)
    expect(again.get_by_role("textbox", name="pressure")).to_have_value("0.8")
    assert not errors
    page.close()
    again.close()


# -- relaxation -------------------------------------------------------------------------------------------------------------

RELAXATION = """
const opened = openBook(book), tissue = tissueOf(opened, step), way = relaxation(tissue, startOf(opened, step), book.forces);
const plain = ({ x, y }) => Array.from(x, (place, i) => [place, y[i]]), frames = [plain(way.now)];
while (!way.now.end && way.now.iteration < most) {
  way.next();
  if (way.now.end || way.now.iteration % 25 === 0) frames.push(plain(way.now));
}
const { tensions, net } = forcesOf(tissue, way.now, book.forces);
return { frames, end: way.now.end, iteration: way.now.iteration, tensions: Array.from(tensions), net: Array.from(net) };
"""
RELAXED = """
return relaxedBook(book, {}, forces, 60_000).book;
"""
OTHER_FORCES = [{}, {"pressure": "1"}, {"stiffness": 5, "rest": 0.5}, {"damping": 3, "pressure": "0.02"}]


@pytest.mark.slow
@pytest.mark.parametrize("forces", OTHER_FORCES, ids=str)
@pytest.mark.parametrize("id", FLAT)
def test_the_browser_relaxes_as_the_kernel_does(page, id, forces):
    book = explore(id, **forces).model["book"]
    kinds = Forces(**book["forces"])
    for step, found in enumerate(derive(map_system(id), 3)):
        shown = asked(page, RELAXATION, book=book, step=step, most=30_000)
        here = [*relax(np.array(shown["frames"][0]), tissue(found), kinds)]
        seen = here[::25] + here[-1:] * (len(here) % 25 != 1)
        assert np.abs(np.array(shown["frames"]) - np.array(seen)).max() < 1e-9
        assert (shown["end"], shown["iteration"]) == ("rest", len(here) - 1)
        assert abs(shown["iteration"] - book["maps"][step]["iterations"]) <= 1  # which starts from points with more digits
        reached = np.array(book["maps"][step]["points"]).reshape(-1, 2)
        assert np.abs(reached - here[-1]).max() < 1e-2


@pytest.mark.parametrize("id", FLAT)
def test_tensions_and_pressures_that_are_painted_are_the_forces_on_the_points(page, id):
    book = explore(id).model["book"]
    shown = asked(page, RELAXATION, book=book, step=3, most=50)
    found, at = derive(map_system(id), 3)[-1], np.array(shown["frames"][-1])
    net = tissue(found)
    sums = np.zeros_like(at)
    for (start, end), tension, pressure in zip(net.ends, shown["tensions"], shown["net"], strict=True):
        along = at[end] - at[start]
        pull, push = tension * along / np.hypot(*along), pressure * np.array([-along[1], along[0]]) / 2
        sums[start] += pull + push
        sums[end] += push - pull
    assert np.abs(sums - force(at, net, areas(at, net), Forces())).max() < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("forces", OTHER_FORCES[1:], ids=str)
@pytest.mark.parametrize("id", FLAT)
def test_a_page_finds_where_cells_are_at_rest_under_other_forces(page, id, forces):
    wanted = explore(id, **forces).model["book"]
    found = asked(page, RELAXED, book={**explore(id).model["book"], "steps": 3}, forces=wanted["forces"])
    for made, here, there in zip(derive(map_system(id), 3), found["maps"], wanted["maps"], strict=False):
        points, others = (np.array(each["points"]).reshape(-1, 2) for each in (here, there))
        assert here["settled"]
        assert abs(here["iterations"] - there["iterations"]) <= 2
        assert areas(points, tissue(made)) == pytest.approx(areas(others, tissue(made)), abs=1e-6)


def watching(panel):
    """The controls of the relaxation, and what is said of it."""
    group = panel.page.get_by_role("group", name="relaxation")
    return group, group.get_by_role("status")


def test_the_relaxation_is_played_until_all_points_are_at_rest(explored):
    panel = explored("K28", 1)
    group, said = watching(panel)
    expect(said).to_have_text("at rest after 309 iterations")
    at_rest = panel.page.evaluate(PIXELS)
    group.get_by_label("relaxation", exact=True).select_option("fast")
    group.get_by_role("button", name="play the relaxation").click()
    expect(said).to_have_text("at rest after 309 iterations", timeout=20_000)
    expect(group.get_by_role("button", name="play the relaxation")).to_be_visible()
    expect(group.get_by_label("forces", exact=True)).to_be_checked()
    expect(panel.at("[data-view=drawing] .lsys-caption")).to_contain_text("pulls, at most with")
    group.get_by_label("forces", exact=True).uncheck()
    group.get_by_role("button", name="to rest").click()
    panel.page.wait_for_function(f"{PIXELS} === {at_rest!r}")
    assert panel.asked == []


def test_the_relaxation_goes_on_iteration_by_iteration_by_keyboard(explored):
    panel = explored("K28", 1)
    group, said = watching(panel)
    seen = [panel.page.evaluate(PIXELS)]
    forward = group.get_by_role("button", name="one iteration on")
    forward.focus()
    for iteration in range(1, 4):
        panel.page.keyboard.press("Enter")
        expect(said).to_contain_text(f"iteration {iteration}: a vertex moved by 0.0")
        panel.page.wait_for_timeout(100)
        seen.append(panel.page.evaluate(PIXELS))
    assert len({*seen}) == 4
    group.get_by_role("button", name="iteration 0 of the relaxation").click()
    expect(said).to_have_text("iteration 0")
    panel.page.get_by_role("button", name="one step on").click()
    expect(said).to_have_text("at rest after 315 iterations")


def test_who_wants_no_motion_sees_stills_of_the_relaxation(explored):
    panel = explored("K28", 1, context={"reduced_motion": "reduce"})
    group, said = watching(panel)
    group.get_by_role("button", name="play the relaxation").click()
    expect(said).to_contain_text("iteration 39:")
    group.get_by_role("button", name="pause the relaxation").click()
    panel.page.wait_for_timeout(1_200)
    expect(said).to_contain_text("iteration 39:")


def test_a_page_that_cannot_find_rest_in_time_says_so_and_keeps_the_steps_before(page):
    book = explore("K29").model["book"]
    late = asked(page, "return relaxedBook(book, {}, book.forces, -1);", book=book)
    assert "takes long to come to rest" in late["mistake"]["message"]
    wild = {"stiffness": 100, "rest": 1, "pressure": 0.01, "damping": 0.1}
    kept = asked(page, "return relaxedBook(book, {}, wild, 60_000).book;", book=explore("K28").model["book"], wild=wild)
    assert len(kept["maps"]) == kept["steps"] + 1 == 2
    assert kept["end"].startswith("The panel ends at step 1: at step 2 the relaxation blows up under these forces")


def test_cells_that_do_not_come_to_rest_are_said_not_to(explored):
    panel = explored("K29", 1, rest=1, pressure="0.01", damping=10)
    expect(watching(panel)[1]).to_have_text("does not settle: still moving after 20,000 iterations")
