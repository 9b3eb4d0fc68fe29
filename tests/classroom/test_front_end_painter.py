"""The canvas paints in the order of the pictures that stay, shows what is traced without colours, and finds what lies there."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit import derive, read
from lsys_kit.classroom.catalogue import system, systems
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.pictures.draw import state_colours
from lsys_kit.pictures.rendering.display_list import AreaRun, LineRun, display_list
from lsys_kit.pictures.rendering.view import far_to_near, project
from lsys_kit.pictures.style.colour_values import contrast, mixed
from tests.classroom.front_end import PAINTER, answers, book_of
from tests.classroom.test_front_end_turtle import MOST_MODULES, scene_by_kit, words

SIDES = [(0, 0), (90, 0), (30, 20), (-145, -60), (0, 90)]
TURTLES = [id for id in systems() if drawing_mode(system(id)) is not DrawingMode.FILAMENT]
THEME = {"ink": "#22303c", "paper": "#ffffff", "markEdge": "#8f6400", "lit": "#b03a00", "dark": False}
DARK = {"ink": "#e8edf2", "paper": "#161b20", "markEdge": "#e5b84a", "lit": "#ff9a66", "dark": True}
SIZE = 400

ORDERS = """
const light = { ink: "#22303c", paper: "#ffffff" };
return given.map(({ book, sides }) => sides.map(([around, above]) => {
  const shapes = placed(traced(bookOf(book), 0), book.turtle.angle), frame = frameOf(shapes, 600, 400, { around, above });
  const { order, painted, widths, x, y } = seenIn(frame, shapes), { strokes, palette } = shapes;
  const pointsOf = (numbers) => Array.from(numbers, (number) => [x[number], y[number]]);
  return { scale: frame.scale, order: Array.from(order), painted: Array.from(painted),
    from: pointsOf(strokes.from), to: pointsOf(strokes.to),
    looks: Array.from(widths, (width, i) => [lineColour(palette[strokes.colours[i]], light), width]) };
}));
"""
PAINTED = """
const canvas = document.createElement("canvas"), pen = canvas.getContext("2d", { willReadFrequently: true });
canvas.width = canvas.height = SIZE;
const shapesOfStep = (step) => placed(traced(bookOf(given.book), step), given.book.turtle.angle);
const shapes = shapesOfStep(given.step ?? 0), box = given.boxed === undefined ? null : boundsOf(shapesOfStep(given.boxed));
const frame = frameOf(shapes, SIZE, SIZE, { ...given.view, box });
const inked = (look) => {
  pen.fillStyle = given.theme.paper;
  pen.fillRect(0, 0, SIZE, SIZE);
  paint(pen, shapes, frame, { theme: given.theme, ...look });
  return pen.getImageData(0, 0, SIZE, SIZE).data;
};
"""


@pytest.fixture(scope="module")
def page(browser):
    return browser.new_page()


def test_colours_are_mixed_and_compared_as_in_the_pictures_that_stay(page):
    colours = ["#000000", "#ffffff", "#0072b2", "#d55e00", "#0a0b0c", THEME["paper"], DARK["paper"]]
    asked = [[one, other, strength] for one in colours for other in colours for strength in (0, 0.3, 1)]
    code = "return given.map(([one, other, strength]) => [contrast(one, other), mixed(one, other, strength)]);"
    for (one, other, strength), (compared, made) in zip(asked, answers(page, code, asked, "colours"), strict=True):
        assert compared == pytest.approx(contrast(one, other))
        assert made == mixed(one, other, strength)


def painted(page, code, word, theme=THEME, **more):
    """What some code makes of a painted word."""
    return answers(page, PAINTED.replace("SIZE", str(SIZE)) + code, {"book": book_of([word]), "theme": theme, **more}, *PAINTER)


def word_of(text):
    return derive(read(f"angle: 90\naxiom: {text}"), 0)[0]


def order_with_casings(flat):
    """The numbers of shapes from far to near, and of the casings of strokes, which follow all others and are painted first."""
    cased, depths = len(flat.casing_depths), np.concatenate([flat.casing_depths, flat.depths])
    order = far_to_near(np.maximum(depths, flat.depths.min(initial=np.inf)), flat.extent)
    return np.where(order < cased, order + len(flat.depths), order - cased).tolist()


def expect_painted(page, found):
    """The canvas paints some words, seen from several sides, in the order of the kit's pictures."""
    given = [{"book": book_of([word]), "sides": SIDES if book_of([word])["mode"] == "space" else SIDES[:1]} for word in found]
    for word, case, shown in zip(found, given, answers(page, ORDERS, given, *PAINTER), strict=True):
        scene = scene_by_kit(word, case["book"]["turtle"]["angle"])
        for side, seen in zip(case["sides"], shown, strict=True):
            [flat] = project([scene], side)
            expect_in_place(seen, flat.segments.points)
            if scene.dimension == 3:
                assert seen["order"] == flat.order.tolist()
                assert seen["painted"] == order_with_casings(flat)
                continue
            runs = list(display_list(flat, seen["scale"], state_colours(word)))
            assert seen["order"] == [number + first(run, scene) for run in runs for number in run.numbers.tolist()]
            for run in runs:
                if isinstance(run, LineRun):
                    assert {tuple(seen["looks"][number]) for number in run.numbers.tolist()} == {(run.colour, run.width)}


def expect_in_place(seen, points):
    """The ends of strokes lie on the canvas as in the projection, enlarged and moved, with y downwards."""
    shown = np.array(list(zip(seen["from"], seen["to"], strict=True))).reshape(-1, 2)
    moved = (shown - shown[:1]) / seen["scale"] * (1, -1)
    assert moved == pytest.approx(points - points[:1], rel=1e-6, abs=1e-6 * max(1.0, *np.abs(points).max(initial=0, axis=0)))


def first(run, scene):
    """The number of the first shape of a kind: faces are counted first, then strokes, then rounds."""
    faces, strokes = len(scene.polygons), len(scene.segments)
    return 0 if isinstance(run, AreaRun) else faces if isinstance(run, LineRun) else faces + strokes


@pytest.mark.parametrize("id", TURTLES)
def test_drawings_of_the_catalogue_are_painted_as_in_the_pictures_that_stay(page, id):
    expect_painted(page, [[word for word in derive(system(id), 4, seed=1) if len(word) <= MOST_MODULES][-1]])


@pytest.mark.slow
@pytest.mark.parametrize(("dialect", "flat"), [("abop", False), ("abop", True), ("grogra", False), ("fractint", True)])
@settings(max_examples=8)
@given(data=st.data())
def test_words_of_all_commands_are_painted_so_too(page, dialect, flat, data):
    expect_painted(page, data.draw(st.lists(words(dialect, flat=flat), min_size=8, max_size=8)))


POINTED = """
const seen = seenIn(frame, shapes), at = (x, y) => shapeAt(shapes, frame, x, y, 6), { strokes } = shapes;
const middle = (i) => [strokes.from, strokes.to].map((ends) => [seen.x[ends[i]], seen.y[ends[i]]])
  .reduce(([ax, ay], [bx, by]) => [(ax + bx) / 2, (ay + by) / 2]);
"""


@pytest.mark.parametrize("text", ["F[+F]F[-F]{-f+f+f}F", "F[&F]F[^F]/(60)[&F]F"], ids=["plane", "space"])
def test_whoever_points_at_a_stroke_finds_its_module(page, text):
    code = POINTED + "return Array.from(strokes.positions, (position, i) => [position, at(...middle(i))]);"
    for pointed, found in painted(page, code, word_of(text), view={"around": 35, "above": 20}):
        assert pointed == found


def test_where_nothing_is_near_nothing_is_found(page):
    assert painted(
        page, POINTED + "return [at(5, 200), at(middle(0)[0] + 5, 200), at(middle(0)[0] + 9, 200)];", word_of("FF")
    ) == [-1, 1, -1]


def test_of_two_shapes_the_one_in_front_is_found(page):
    """The turtle turns towards the viewer, who sees its second sphere before the first, and from behind the other way round."""
    word = word_of("@O(2)^(90)f(3)@O(2)")
    for around, position in ((0, 3), (180, 0)):
        assert painted(page, "return shapeAt(shapes, frame, 200, 200, 6);", word, view={"around": around}) == position


def test_inside_a_face_it_is_found_and_outside_it_is_not(page):
    found = painted(
        page,
        POINTED + "return [[200, 210], [200, 180], [60, 150]].map((point) => at(...point));",
        word_of("{-(45)f(5)+(90)f(5)+(90)f(5)}"),
    )
    assert found == [0, 0, -1]


KINDS = ("self", "mother", "daughter")


@pytest.mark.parametrize("theme", [THEME, DARK], ids=["light", "dark"])
@pytest.mark.parametrize("text", ["FF", "{-f+f+f}FF", "@O(2)f(3)FF"], ids=["stroke", "face", "sphere"])
def test_mother_and_daughters_are_told_apart_without_colour(page, text, theme):
    """In one colour, what surrounds what is traced has three shapes."""
    word = word_of(text)
    pictures = painted(
        page,
        """
        const one = { ...given.theme, lit: given.theme.ink };
        return given.kinds.map((kind) => inked({ theme: one, lit: new Map([[0, kind]]) }).join());""",
        word,
        theme,
        kinds=KINDS,
    )
    plain = painted(page, "return inked({}).join();", word, theme)
    assert len({plain, *pictures}) == 4


def test_what_is_marked_lies_on_a_band(page):
    """Of a line of 372 pixels two fifths are marked, with a band that is more than five pixels broader than the line."""
    word = word_of("F(2)F(3)")
    plain, marked = (
        painted(
            page,
            f"""
        const data = inked({{ marked: new Set({states}) }});
        return data.filter((part, at) => at % 4 === 0 && part < 255).length;""",
            word,
        )
        for states in ([], [0])
    )
    assert marked > plain + 5 * 372 * 2 / 5


@pytest.mark.parametrize("id", ["K5", "K12", "K19", "J6", "L3"])
@pytest.mark.parametrize("theme", [THEME, DARK], ids=["light", "dark"])
def test_lines_can_be_seen_on_their_paper(page, id, theme):
    """The nearest strokes have a contrast of 3 to 1 at least to the paper (WCAG 2.2, criterion 1.4.11)."""
    word = derive(system(id), 3, seed=1)[-1]
    ratios = painted(
        page,
        """const shade = shades(shapes.palette, given.theme);
        return shapes.palette.map((_, colour) => contrast(shade(colour), given.theme.paper));""",
        word,
        theme,
    )
    assert min(ratios) >= 3


def test_in_a_frame_that_stays_a_plant_grows(page):
    plant = derive(read("axiom: F\nF -> FF"), 3)
    book = book_of(list(plant))
    code = (
        PAINTED.replace("SIZE", str(SIZE))
        + """
        const { x, y } = seenIn(frame, shapes);
        return [Math.min(...y), Math.max(...y)];"""
    )
    ends = [answers(page, code, {"book": book, "theme": THEME, "step": step, "boxed": 3}, *PAINTER) for step in range(4)]
    assert [bottom for _, bottom in ends] == pytest.approx([ends[0][1]] * 4)
    assert [bottom - top for top, bottom in ends] == pytest.approx([(SIZE - 28) / 8 * 2**step for step in range(4)])


ROOM = """
const shapes = placed(traced(bookOf(given), 0), given.turtle.angle), box = boundsOf(shapes), found = [];
for (const above of [-90, -40, 0, 15, 60, 90]) {
  let share = 0;
  for (let around = -180; around < 180; around += 5) {
    const { x, y } = seenIn(frameOf(shapes, 600, 400, { around, above, box }), shapes);
    const seen = shapes.strokes.n ? [...shapes.strokes.from, ...shapes.strokes.to] : [];
    for (const point of seen) {
      const reach = Math.max(Math.abs(x[point] - 300) / 300, Math.abs(y[point] - 200) / 200);
      share = Math.max(share, reach);
    }
  }
  found.push(share);
}
return found;
"""


@pytest.mark.parametrize("id", ["K13", "K19", "L1", "K15"])
def test_no_turn_leads_a_plant_out_of_its_frame_and_some_turn_nearly_fills_it(page, id):
    plant = system(id)
    shares = answers(page, ROOM, book_of([derive(plant, min(6, plant.steps or 4))[-1]]), *PAINTER)
    assert max(shares) <= 1
    if drawing_mode(plant) is DrawingMode.SPACE:
        assert min(shares) > 0.6
