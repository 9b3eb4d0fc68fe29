"""What JavaScript makes of a book is what Python derives, counts and draws."""

from __future__ import annotations

import json
from collections import Counter
from itertools import product
from math import isnan

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lsys_kit import LSystemError, derive, limits, read, stages, system, systems
from lsys_kit.classroom.panel import bundle
from lsys_kit.classroom.panel.books.book import book
from lsys_kit.derivation.timed.ages import age_model
from lsys_kit.geometry.filament import filament
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.notation.registry import dialect_named
from lsys_kit.pictures.draw import MOST_ROWS
from lsys_kit.pictures.filaments import MOST_CELLS, FilamentRow, filament_layout
from lsys_kit.pictures.style.labels import visible
from tests.classroom.front_end import called, joined
from tests.derivation.random_systems import KINDS, systems_with
from tests.derivation.random_systems import systems as random_systems

FILAMENTS = [name for name in systems() if drawing_mode(system(name)) is DrawingMode.FILAMENT]
LIFE_SPANS = [{"lifeTimeA": a, "lifeTimeB": b} for a, b in product(range(1, 7), repeat=2)]
PAGES = """([data, steps]) => {
  const book = openBook(data), all = (n, of) => Array.from({ length: n }, (_, i) => of(i));
  return { lengths: book.lengths(), pages: all(steps + 1, (step) => ({
    word: Array.from(book.word(step)), length: book.length(step),
    tokens: book.tokens(step), counts: Array.from(book.counts(step)),
    mothers: all(book.length(step), (at) => book.mother(step, at)),
    made: all(book.length(step), (at) => book.production(step, at)),
    daughters: all(book.length(step), (at) => book.daughters(step, at)),
  })), labels: all(data.states.length, (state) => book.label(state)) };
}"""
ROWS = """([data, step, sheet]) => {
  const made = sequence(openBook(data), step, sheet);
  const listed = (table) => Object.fromEntries(Object.entries(table).map(([name, column]) =>
    [name, name === "n" ? column : Array.from(column)]));
  return { ...made, cells: listed(made.cells), walls: listed(made.walls) };
}"""
FOUND = """([data, step]) => {
  const sheet = sequence(openBook(data), step), { cells } = sheet;
  return Array.from({ length: cells.n }, (_, i) => [...[-0.45, 0, 0.45].map((part) => cellAt(sheet,
    cells.x[i] + part * cells.length[i], cells.y[i])), { step: sheet.rows[cells.row[i]].step, position: cells.position[i] }]);
}"""
BESIDE = """([data, step, reach]) => {
  const sheet = sequence(openBook(data), step), { cells, rows, pitch } = sheet, last = rows.length - 1;
  const from = cells.starts[last];
  const found = (x, y) => cellAt(sheet, x, y, reach)?.position ?? null, bottom = rows[last].top + pitch;
  const left = cells.x[from] - cells.length[from] / 2;
  return [0.1, -0.1].map((inside) => [found(cells.x[from], bottom + reach - inside),
    found(left - reach + inside, bottom - pitch / 2), found(cells.x[0], rows[0].top - reach + inside)]);
}"""
PAINTED = """([data, step, look]) => {
  const canvas = document.createElement("canvas"), sheet = sequence(openBook(data), step);
  [canvas.width, canvas.height] = [sheet.width, sheet.height];
  const pen = canvas.getContext("2d"), theme = { ink: "#22303C", quiet: "#7A8794", paper: "#FFFFFF", mark: "#FFF2C2",
    markEdge: "#B8860B", lit: "#D55E00", dark: false };
  pen.fillStyle = theme.paper;
  pen.fillRect(0, 0, sheet.width, sheet.height);
  paintSequence(pen, sheet, { theme, marked: new Set(look.marked), litAt: (at) => new Map(look.lit[at] ?? []), current: step });
  const colour = (x, y) => Array.from(pen.getImageData(x, y, 1, 1).data).slice(0, 3);
  const { cells } = sheet, above = (i) => colour(cells.x[i], cells.y[i] - cells.width[i] / 2);
  return { band: sheet.rows.map((row) => colour(sheet.width - 8, row.middle)),
    edges: Array.from({ length: cells.n }, (_, i) => above(i)),
    states: [...cells.state], rows: [...cells.row].map((row) => sheet.rows[row].step), positions: [...cells.position] };
}"""


@pytest.fixture(scope="module")
def page(browser):
    tab = browser.new_page()
    tab.add_script_tag(content=joined("constants", "numbers", "colours", "outlines", "filament", "chance", "book"))
    yield tab
    tab.close()


def sent(made):
    """A book as it comes to the browser."""
    return json.loads(json.dumps(made, allow_nan=False))


def daughters_of(origins, length):
    """For each module of a word the positions from which and up to which its daughters stand."""
    leaders, found = list(range(length)), []
    for at, size in enumerate(origins.sizes):
        leaders[at] = at if size else leaders[at - 1]
    for leader in leaders:
        before = sum(parent < leader for parent in origins.parents)
        found.append([before, before + origins.parents.count(leader)])
    return found


def check_pages(page, model, most=8, **constants):
    """All that the browser makes of a book of the first steps is what the derivation says."""
    made = book(model, constants)
    steps = min(most, made["steps"])
    found = called(page, "", PAGES, [sent(made), steps])
    derivation, notation = derive(model, made["steps"], **constants), dialect_named(model.notation)
    assert found["lengths"] == derivation.lengths
    try:
        net = stages(model, **constants)
    except LSystemError:
        net = None
    for step, seen in enumerate(found["pages"]):
        word = derivation[step]
        assert [made["states"][state][3] for state in seen["word"]] == [visible(notation.module(module)) for module in word]
        assert seen["length"] == len(word)
        assert seen["tokens"] == ([] if net is None or not made["net"]["names"] else [*net.tokens(word)])
        assert sum(seen["counts"]) == len(word)
        assert all(seen["counts"][state] == seen["word"].count(state) for state in set(seen["word"]))
        if step:
            origins = derivation.origins(step)
            assert seen["mothers"] == [*origins.parents]
            assert seen["made"] == [-1 if number is None else number for number in origins.productions]
            before = found["pages"][step - 1]
            if len(word) < 300:
                assert before["daughters"] == daughters_of(origins, before["length"])
        else:
            assert set(seen["mothers"]) | set(seen["made"]) <= {-1}
    assert [label["text"] for label in found["labels"]] == [row[3] for row in made["states"]]


@pytest.mark.parametrize("name", systems())
def test_words_counts_and_origins_are_those_of_the_derivation(page, name):
    with limits(modules=20_000):
        check_pages(page, system(name))


@pytest.mark.parametrize("constants", LIFE_SPANS, ids=str)
def test_at_every_setting_of_the_life_spans(page, constants):
    check_pages(page, system("J4"), **constants)


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(random_systems() | systems_with() | st.sampled_from(KINDS).flatmap(systems_with))
def test_of_random_systems(page, model):
    with limits(modules=1_000, seconds=2):
        try:
            check_pages(page, model, 6)
        except LSystemError:
            with pytest.raises(LSystemError):
                book(model)


@given(st.sampled_from(["K7", "K8"]), st.integers(-(2**70), 2**70))
@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_chance_is_thrown_in_the_browser_as_in_the_kernel_at_any_seed(page, name, seed):
    with limits(modules=3_000):
        made = book(system(name), seed=seed)
        assert "words" not in made
        found = called(page, "", PAGES, [sent(made), made["steps"]])
        assert found["lengths"] == derive(system(name), made["steps"], seed=seed).lengths


def test_words_that_answer_questions_are_those_that_are_shown(page):
    check_pages(page, read("axiom: F A ?P(0,0)\nA > ?P(x,y) : y < 3 -> F A"))


def test_modules_that_are_replaced_together_have_the_same_daughters(page):
    made = book(read("axiom: A B C\nA B -> D E\nC -> C C"))
    seen = called(page, "", PAGES, [sent(made), 1])["pages"]
    assert seen[0]["daughters"] == [[0, 2], [0, 2], [2, 4]]
    assert seen[1]["mothers"] == [0, 0, 2, 2]


def test_the_last_step_of_a_book_has_no_daughters(page):
    made = book(system("J1"))
    assert set(map(str, called(page, "", PAGES, [sent(made), made["steps"]])["pages"][-1]["daughters"])) == {"None"}


# -- filaments ------------------------------------------------------------------------------------------------------------


def layout_of(derivation):
    """The layout of the picture of a developmental sequence."""
    step = derivation.steps
    rows = [FilamentRow(at, filament(derivation[at])) for at in range(max(0, step + 1 - MOST_ROWS), step + 1)]
    return filament_layout(rows, True, age_model(derivation.states).step)


@pytest.mark.parametrize("name", FILAMENTS)
@pytest.mark.parametrize("step", [0, 4, 7, 27])
def test_rows_are_laid_out_as_in_the_picture(page, name, step):
    check_rows(page, system(name), step)


@pytest.mark.parametrize("step", [0, 1, 2, 5])
def test_walls_are_as_high_as_the_wider_of_their_neighbours(page, step):
    check_rows(
        page,
        read(
            "axiom: w a w w b w c w\na -> a w b\nb -> c w(1) a\ninterpretation:\na -> R(2,1,0.3)\n"
            "b -> L(1,3)\nc -> O(1,2)W(7,0.5)\nw -> W\nw(t) -> W(t)"
        ),
        step,
    )


def check_rows(page, model, step):
    """The rows of a sequence are those of the picture, which does not fold rows of a hundred cells."""
    with limits(modules=MOST_CELLS):
        made = book(model, least=step)
    step = min(step, made["steps"])
    found = page.evaluate(ROWS, [sent(made), step, {}])
    derivation = derive(model, step)
    sheet = layout_of(derivation)
    cells = [(cell, sheet.middle(at)) for at, row in enumerate(sheet.rows) for cell in sheet.cells(row)]
    walls = [(wall, sheet.middle(at)) for at, row in enumerate(sheet.rows) for wall in sheet.walls(row)]
    for names, expected, drawn in (
        (
            ("x", "y", "length", "width", "sign", "shade"),
            [(cell.x, y, 2 * cell.length, 2 * cell.width, cell.way, cell.shade) for cell, y in cells],
            found["cells"],
        ),
        (("x", "y", "width", "shade"), [(wall.x, y, 2 * wall.height, wall.shade) for wall, y in walls], found["walls"]),
    ):
        rows = [*zip(*(drawn[each] for each in names), strict=True)]
        assert len(rows) == len(expected)
        assert not rows or np.abs(np.array(rows, float) - np.array(expected, float)).max() < 1e-6
    assert ["" if isnan(age) else f"{age:.4g}" for age in found["walls"]["sign"]] == [wall.age for wall, _ in walls]
    assert (found["scale"], found["pitch"], found["above"]) == pytest.approx((sheet.scale, sheet.pitch, sheet.above))
    states, notation = derivation.states, dialect_named(model.notation)
    texts = {cell: notation.module(states.modules[cell.state]) for cell, _ in cells}
    assert [made["states"][state][3] for state in found["cells"]["state"]] == [texts[cell] for cell, _ in cells]


@pytest.mark.parametrize("name", ["J4", "P2", "K27"])
@pytest.mark.parametrize("size", [(320, 240), (500, 900), (1800, 1000)])
def test_rows_lie_on_a_sheet_of_any_size(page, name, size):
    width, height = size
    sheet = page.evaluate(ROWS, [sent(book(system(name))), 18, {"width": width, "height": height}])
    cells = sheet["cells"]
    assert cells["n"]
    for x, y, length, across in zip(cells["x"], cells["y"], cells["length"], cells["width"], strict=True):
        assert 0 < x - length / 2 < x + length / 2 < width
        assert 0 < y - across / 2 < y + across / 2 < height


def test_the_scale_is_kept_as_far_as_a_step(page):
    made = sent(book(system("J4")))
    scales = {page.evaluate(ROWS, [made, step, {"boxed": 15}])["scale"] for step in range(16)}
    assert scales == {page.evaluate(ROWS, [made, 15, {}])["scale"]}
    assert page.evaluate(ROWS, [made, 3, {}])["scale"] > scales.pop()


@pytest.mark.parametrize("name", ["J1", "J4", "P5", "P4"])
def test_a_point_within_a_cell_finds_its_module(page, name):
    found = page.evaluate(FOUND, [sent(book(system(name))), 9])
    assert found
    assert all([expected] * 3 == there for *there, expected in found)


@pytest.mark.parametrize("reach", [0, 6, 14])
def test_a_point_beside_a_cell_finds_its_module_as_far_as_a_hand_reaches(page, reach):
    assert page.evaluate(BESIDE, [sent(book(system("J4"))), 9, reach]) == [[0, 0, 0], [None, None, None]]


def test_what_is_marked_or_traced_is_painted_so(page):
    made = book(system("J4"))
    marked = [state for state, row in enumerate(made["states"]) if row[2] == 0]
    found = page.evaluate(PAINTED, [sent(made), 6, {"marked": marked, "lit": {"3": [[0, "self"]]}}])
    assert found["band"][:-1] == [[255, 255, 255]] * 6
    assert found["band"][-1] == [0xFF, 0xF2, 0xC2]
    for edge, state, step, position in zip(*(found[each] for each in ("edges", "states", "rows", "positions")), strict=True):
        traced = step == 3 and position == 0
        assert (edge == [0xD5, 0x5E, 0x00]) == traced
        assert (edge == [0xB8, 0x86, 0x0B]) == (state in marked and not traced)


def test_scripts_that_are_joined_share_no_names():
    names = Counter(name for script in bundle._scripts() for name in bundle._EXPORT.findall(bundle.source(script)))
    assert [name for name, count in names.items() if count > 1] == []
