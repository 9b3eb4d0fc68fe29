"""Cells in the panel, in a browser: what is seen from any side is what the kit draws, and cells are lit, traced and turned."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from playwright.sync_api import expect

from lsys_kit import LSystemError, derive, explore, limits, map_system
from lsys_kit.classroom.panel.books.at_rest import cells_at_rest
from lsys_kit.classroom.panel.books.cells import cell_book
from lsys_kit.geometry.tissues.layout import cellwork_scene
from lsys_kit.geometry.tissues.relaxation import SPACE_FORCES, SPHERE_FORCES
from lsys_kit.pictures.rendering.view import axes, project
from lsys_kit.pictures.style.lighting import brightness
from lsys_kit.pictures.tissues.cellworks import wall_labels
from lsys_kit.pictures.tissues.spheres import _seen_outlines, wall_arcs
from tests.classroom.test_panel_maps import PIXELS, asked
from tests.derivation.random_cellworks import cellwork_systems

SIDES = [(30, 25), (0, 0), (90, 0), (-145, -60), (0, 90), (17, -8)]
OBLIQUE = [(20, 25), (-145, -60), (73, 41), (17, -8)]
"""Sides from which no point lies on the rim of a sphere, where rounding would decide whether it is seen."""
APICAL = """
cellwork: 1(0,0,0) 2(1,0,0) 3(1,1,0) 4(0,1,0) 5(0,0,1) 6(1,0,1) 7(1,1,1) 8(0,1,1)
steps: 3
wall S: 1 X> 2 Y 3 X< 4 Y
wall S: 5 X> 6 Y 7 X< 8 Y
wall S: 1 X> 2 Y 6 X< 5 Y
wall S: 4 X> 3 Y 7 X< 8 Y
wall T: 1 Y 4 Y 8 Y 5 Y
wall T: 2 Y 3 Y 7 Y 6 Y
X>: * -> X> [S: S|Y|S, T] Z>
"""
"""A row of cells of which only the first one divides."""
CLOSE = 1e-9
SEEN = """
const opened = openBook(book), shapes = tissueShapes(opened, step);
return sides.map(([around, above]) => {
  const frame = tissueFrame(shapes, 400, 300, { around, above }), seen = seenFrom(frame, shapes), { middle } = frame;
  const at = (point) => [seen.x[point] / 3, seen.y[point] / 3];
  const shown = shapes.isSphere ? [] : wallsSeen(shapes, seen, cells && new Set(cells));
  const parts = shown.map(({ corners, ends, label, bright }) =>
    ({ points: (corners ?? ends).map(at), label: label ?? -1, bright: bright ?? -1 }));
  const number = shapes.isSphere ? shapes.starts.length - 1 : 0, walls = shapes.isSphere ? shapes.kindOf.length : 0;
  return { middle: middle.map((place) => place / 3), parts,
    cells: Array.from({ length: number }, (_, cell) => cellSeen(shapes, seen, cell)),
    walls: Array.from({ length: walls }, (_, wall) => wallSeen(shapes, seen, wall).map((pair) => pair.map(at))) };
});
"""
UNDER = """
const opened = openBook(book), shapes = tissueShapes(opened, step);
const frame = tissueFrame(shapes, 400, 300, { around: 30, above: 25 });
const seen = seenFrom(frame, shapes), { x0, y0, scale } = frame;
const found = (x, y) => cellUnder(shapes, frame, x0 + x * scale, y0 - y * scale, null);
if (shapes.isSphere) return [found(0, 0), found(5, 0)];
return wallsSeen(shapes, seen).filter(({ isFront }) => isFront).map(({ corners, cell }) => {
  const mean = (axis) => corners.reduce((sum, corner) => sum + axis[corner], 0) / corners.length;
  return [cell, found(mean(seen.x), mean(seen.y))];
});
"""


@pytest.fixture(scope="module")
def page(browser):
    return browser.new_page()


def expect_as_drawn(page, rest, step, cells=None):
    """What the browser sees of a cellwork from several sides is what the kit draws, in the same order and shades."""
    labels = {label: number for number, label in enumerate(wall_labels(rest.steps))}
    shown = asked(page, SEEN, book=cell_book(rest, {}), step=step, sides=SIDES, cells=cells)
    lit = range(len(rest.steps[step].cells)) if cells is None else cells
    scene = cellwork_scene(rest.steps[step], rest.reached[step], labels, lit, len(labels))
    for side, seen in zip(SIDES, shown, strict=True):
        [drawn] = project([scene], side)
        polygons, bright, parts = [*drawn.polygons], brightness(drawn.normals), seen["parts"]
        assert len(parts) == len(drawn.order)
        for number, part in zip(drawn.order.tolist(), parts, strict=True):
            if number < len(polygons):
                assert (int(drawn.polygons.states[number]), int(bright[number])) == (part["label"], part["bright"])
                points = polygons[number]
            else:
                points = drawn.segments.ends[number - len(polygons)].reshape(2, 2)
                assert part["label"] == -1
            assert np.allclose(np.array(part["points"]), points, rtol=0, atol=CLOSE)


@pytest.mark.parametrize("cells", [None, [3], [0, 5, 6]])
def test_a_cellwork_is_seen_from_all_sides_as_the_kit_draws_it(page, cells):
    rest = cells_at_rest(explore("K33", 0).system, SPACE_FORCES)
    for step in range(rest.last + 1) if cells is None else (3, 4):
        expect_as_drawn(page, rest, step, cells)


@pytest.mark.slow
@settings(max_examples=4, deadline=None)
@given(system=cellwork_systems(), data=st.data())
def test_random_cellworks_are_seen_so_too(page, system, data):
    try:
        with limits(modules=120, seconds=5):
            rest = cells_at_rest(system, SPACE_FORCES)
    except LSystemError:
        return
    step = data.draw(st.integers(0, min(rest.last, 3)))
    numbers = st.integers(0, len(rest.steps[step].cells) - 1)
    cells = data.draw(st.none() | st.lists(numbers, min_size=1, max_size=3, unique=True))
    expect_as_drawn(page, rest, step, cells)


def test_a_sphere_is_seen_from_all_sides_as_the_kit_draws_it(page):
    rest = cells_at_rest(map_system("K34"), SPHERE_FORCES)
    for step in range(4):
        found = rest.steps[step]
        shown = asked(page, SEEN, book=cell_book(rest, {}), step=step, sides=OBLIQUE, cells=None)
        for side, seen in zip(OBLIQUE, shown, strict=True):
            view = np.column_stack(axes(*map(np.radians, side)))
            arcs = [each @ view for each in wall_arcs(found, *rest.reached[step])]
            for cell, outlines in zip(found.cells, seen["cells"], strict=True):
                around = np.concatenate([arcs[wall][:-1] if forward else arcs[wall][:0:-1] for wall, forward in cell])
                drawn = _seen_outlines(around) if (around[:, 2] > 0).any() else []
                assert len(drawn) == len(outlines)
                assert all(np.allclose(one, other, rtol=0, atol=CLOSE) for one, other in zip(drawn, outlines, strict=True))
            for arc, pairs in zip(arcs, seen["walls"], strict=True):
                front = [arc[at : at + 2, :2] for at in range(len(arc) - 1) if (arc[at : at + 2, 2] >= 0).all()]
                assert np.allclose(np.array(pairs).reshape(-1, 2, 2), np.array(front).reshape(-1, 2, 2), rtol=0, atol=CLOSE)


def test_whoever_points_at_a_wall_finds_its_cell(page):
    found = asked(page, UNDER, book=explore("K33").model["book"], step=4)
    assert len(found) > 10
    assert all(cell == under for cell, under in found)
    cell, outside = asked(page, UNDER, book=explore("K34", 2).model["book"], step=2)
    assert (cell >= 0, outside) == (True, -1)


def test_a_panel_shows_cells_with_their_word_their_stages_and_eulers_number(explored):
    panel = explored("K33", 2)
    expect(panel.at(".lsys-status")).to_have_text(
        "step 2: 18 vertices, 33 edges, 20 walls, 4 cells; 18 \u2212 33 + 20 \u2212 4 = 1; 3 of 3 stages occupied"
    )
    expect(panel.at(".lsys-module")).to_have_count(4)
    expect(panel.at(".lsys-module").first).to_have_text("QRQRQRQRQRQRPQPQPQPRPRPRPRPRPRPQPQPQ")
    assert [panel.at(f"[data-place='{place}']").get_attribute("aria-label") for place in range(3)] == [
        "stage P, 9 tokens",
        "stage Q, 12 tokens",
        "stage R, 12 tokens",
    ]
    panel.page.get_by_role("button", name="one step on").click()
    expect(panel.at(".lsys-status")).to_contain_text("27 vertices, 54 edges, 36 walls, 8 cells; 27 \u2212 54 + 36 \u2212 8 = 1")
    assert "book" not in panel.asked


@pytest.mark.parametrize("id", ["K33", "K34"])
def test_cells_are_turned_by_mouse_by_keys_and_by_sliders(explored, id):
    panel = explored(id, 1)
    canvas, first = panel.at("canvas.lsys-canvas"), panel.page.evaluate(PIXELS)
    around, above = panel.explorer.around, panel.explorer.above
    canvas.focus()
    panel.page.keyboard.press("ArrowLeft")
    panel.page.keyboard.press("ArrowUp")
    expect(canvas).to_have_attribute("data-around", str(around - 5))
    expect(canvas).to_have_attribute("data-above", str(above + 5))
    assert panel.page.evaluate(PIXELS) != first
    panel.page.keyboard.press("Home")
    expect(canvas).to_have_attribute("data-around", str(around))
    box = canvas.bounding_box()
    panel.page.mouse.move(box["x"] + 200, box["y"] + 200)
    panel.page.mouse.down()
    panel.page.mouse.move(box["x"] + 240, box["y"] + 200, steps=4)
    panel.page.mouse.up()
    expect(canvas).to_have_attribute("data-around", str(around - 20))
    panel.control("around").focus()
    panel.page.keyboard.press("ArrowRight")
    expect(canvas).to_have_attribute("data-around", str(around - 19))


def test_cells_are_turned_by_a_finger(explored):
    panel = explored("K33", 1, context={"has_touch": True})
    canvas = panel.at("canvas.lsys-canvas")
    box = canvas.bounding_box()
    touch = panel.page.context.new_cdp_session(panel.page)
    for kind, across in (("touchStart", 0), ("touchMove", 20), ("touchMove", 60), ("touchEnd", None)):
        points = [] if across is None else [{"x": box["x"] + 200 + across, "y": box["y"] + 150}]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    panel.page.wait_for_function("host.get('around') < 30")


def test_a_cell_is_traced_by_a_click_by_keys_and_in_the_word(explored):
    panel = explored("K33", 2)
    canvas, before = panel.at("canvas.lsys-canvas"), panel.page.evaluate(PIXELS)
    panel.at("[data-position='1']").click()
    expect(panel.at(".lsys-sentence")).to_have_text(
        "Cell 2 of step 2, QR: QRQR, QR: QRQR, PQ: PQPQ, PR: PRPR, PR: PRPR, PQ: PQPQ. Mother: cell 1 of step 1, "
        "which was divided into this cell and cell 1; at step 3 it is divided into cells 3 and 4."
    )
    panel.page.wait_for_function(f"{PIXELS} !== {before!r}")
    canvas.focus()
    panel.page.keyboard.press("n")
    expect(panel.at(".lsys-sentence")).to_contain_text("Cell 3 of step 2")
    panel.page.get_by_role("button", name="one step back").click()
    expect(panel.at("[data-traced='mother']")).to_have_attribute("data-position", "1")
    canvas.focus()
    panel.page.keyboard.press("Escape")
    expect(panel.at(".lsys-sentence")).to_have_text("")
    box = canvas.bounding_box()
    panel.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    expect(panel.at(".lsys-sentence")).to_contain_text("of step 1")
    panel.page.mouse.click(box["x"] + 3, box["y"] + 3)
    expect(panel.at(".lsys-sentence")).to_have_text("")


@pytest.mark.parametrize("id", ["K33", "K34"])
def test_a_marked_stage_is_marked_in_the_drawing(explored, id):
    panel = explored(id, 2)
    before = panel.page.evaluate(PIXELS)
    panel.more()
    panel.page.get_by_label("mark", exact=True).select_option(index=1)
    panel.page.wait_for_function(f"{PIXELS} !== {before!r}")


def test_one_generation_is_lit(explored):
    panel = explored(APICAL, 3)
    lit, before = panel.page.get_by_label("lit", exact=True), panel.page.evaluate(PIXELS)
    assert lit.locator("option").all_inner_texts() == ["all cells", "generation 1", "generation 2", "generation 3"]
    lit.select_option("generation 2")
    panel.page.wait_for_function(f"{PIXELS} !== {before!r}")
    panel.page.get_by_role("button", name="one step back").click()
    expect(lit.locator("option")).to_have_text(["all cells", "generation 1", "generation 2"])
    expect(lit).to_have_value("2")
    panel.page.get_by_role("button", name="to step 0").click()
    expect(lit).to_have_value("")
    panel.at("[data-position='0']").click()
    expect(panel.at(".lsys-sentence")).to_contain_text(
        "is there from the beginning; at step 1 it is divided into cells 1 and 2."
    )


def test_a_cell_that_is_not_divided_is_said_to_stay(explored):
    panel = explored(APICAL, 2)
    panel.at("[data-position='2']").click()
    expect(panel.at(".lsys-sentence")).to_contain_text(
        "was cell 2 of step 1, which was not divided; at step 3 it is cell 4, not divided."
    )


def test_what_the_mouse_is_on_is_lit_and_the_other_cells_keep_their_walls(explored):
    panel = explored("K33", 2)
    canvas = panel.at("canvas.lsys-canvas")
    box = canvas.bounding_box()
    panel.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    expect(panel.at(".lsys-sentence")).to_contain_text("of step 2")
    pointed = panel.page.evaluate(PIXELS)
    panel.page.mouse.down()
    panel.page.mouse.up()
    panel.page.wait_for_function(f"{PIXELS} !== {pointed!r}")


def test_no_module_is_marked_at_first(explored):
    panel = explored("K33", 1)
    expect(panel.at(".lsys-marked")).to_have_count(0)


def test_a_force_that_is_moved_asks_for_another_book_and_changes_the_cells(explored):
    panel = explored("K33", 1)
    before = panel.page.evaluate(PIXELS)
    box = panel.page.get_by_role("textbox", name="pressure")
    box.fill("1")
    box.press("Enter")
    panel.page.wait_for_function(f"{PIXELS} !== {before!r}")
    assert "book" in panel.asked
    panel.page.get_by_role("button", name="reset").click()
    panel.page.wait_for_function(f"{PIXELS} === {before!r}")


@pytest.mark.parametrize(
    ("id", "said"), [("K33", "18 vertices, 33 edges, 20 walls, 4 cells"), ("K34", "26 vertices, 40 walls, 16 cells")]
)
def test_a_page_without_a_kernel_shows_cells_that_can_be_turned(browser, tmp_path, id, said):
    file, panel, errors = tmp_path / "cells.html", explore(id, 2), []
    panel.save(file)
    page = browser.new_page()
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(file.as_uri())
    expect(page.locator(".lsys-status")).to_contain_text(f"step 2: {said}")
    canvas = page.locator("canvas.lsys-canvas")
    expect(canvas).to_have_attribute("data-around", str(panel.around))
    canvas.focus()
    page.keyboard.press("ArrowRight")
    expect(canvas).to_have_attribute("data-around", str(panel.around + 5))
    expect(page.get_by_text("Fixed on this page: stiffness = 1")).to_be_visible()
    assert derive(panel.system, 2).counts[-1][-1] == len(page.locator(".lsys-module").all())
    assert not errors
    page.close()


@pytest.mark.parametrize("id", ["K33", "K34"])
def test_code_of_the_panel_names_its_reader(explored, id):
    panel = explored(str(explore(id, 0).system), 1)
    panel.more()
    panel.page.get_by_role("button", name="code", exact=True).click()
    code = panel.at(".lsys-code").input_value()
    assert code.startswith({"K33": 'explore(read_cellwork("cellwork:', "K34": 'explore(read_map("sphere:'}[id])
