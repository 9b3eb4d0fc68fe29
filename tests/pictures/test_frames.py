"""What is painted lies within the picture: broad strokes with their round ends, discs, text; in every format."""

from __future__ import annotations

import io
import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure
from PIL import Image

from lsys_kit import animate, derive, draw, figure, read, system
from lsys_kit.geometry.scene import OWN
from lsys_kit.pictures.rendering.display_list import BROADEST_CASING
from lsys_kit.pictures.rendering.frames import FINE, frame_around
from lsys_kit.pictures.rendering.looks import THINNEST
from lsys_kit.pictures.style.palette import PAPER

BOOK = Path(__file__).parents[1] / "listings" / "abop"
COMMANDS = st.sampled_from(
    [
        "F",
        "F(3)",
        "F(40)",
        "+",
        "-(50)",
        "#(0.3)",
        "!(2)",
        "!(9)",
        "#(30)",
        "[F]",
        "[+F]",
        "[+(90)F]",
        "@c(2)",
        "@o(1)",
        "{+F+F+F}",
        "~L(3)",
    ]
)
WORDS = st.lists(COMMANDS, min_size=1, max_size=12).map("".join)
MODELS = st.builds(
    "{}angle: 60\naxiom: {}{}".format,
    st.sampled_from(["", "widths: units\n", "widths: pixels\n"]),
    WORDS,
    st.sampled_from(["", "&(30)F", "&(90)!(5)F"]),
)
WIDTHS = re.compile(r'stroke-width="(\d+)"')


def drawn(text):
    return draw(derive(read(text, "abop"), 0))


@pytest.mark.slow
@settings(max_examples=50)
@given(MODELS)
def test_svg_holds_what_is_painted(text):
    picture = drawn(text)
    width, height = map(int, re.search(r'viewBox="0 0 (\d+) (\d+)"', picture.svg).groups())
    for group, broad in re.findall(r'<path d="([^"]*)" stroke="[^"]*" stroke-width="(\d+)"', picture.svg):
        places = np.array(re.findall(r"[ML](-?\d+) (-?\d+)", group), int)
        reach = int(broad) / 2
        assert (places >= reach - 1).all(), broad
        assert (places <= np.array([width, height]) - reach + 11).all(), broad  # sizes are whole pixels
    for x, y, radius in re.findall(r'cx="(-?\d+)" cy="(-?\d+)" r="(\d+)"', picture.svg):
        assert all(int(at) - int(radius) >= 0 and int(at) + int(radius) <= size for at, size in ((x, width), (y, height)))


@pytest.mark.slow
@settings(max_examples=25)
@given(MODELS)
def test_png_holds_what_is_painted(text):
    image = np.array(Image.open(io.BytesIO(drawn(text).png)).convert("RGB"))
    edge = np.concatenate(
        [image[:3].reshape(-1, 3), image[-3:].reshape(-1, 3), image[:, :3].reshape(-1, 3), image[:, -3:].reshape(-1, 3)]
    )
    assert (edge == tuple(bytes.fromhex(PAPER[1:]))).all()


@pytest.mark.slow
@settings(max_examples=25)
@given(MODELS, st.sampled_from([(6, 4), (3, 5), (12, 2)]))
def test_a_figure_holds_what_is_painted(text, size):
    ax = Figure(figsize=size).add_subplot()
    figure(drawn(text), ax)
    ax.apply_aspect()
    room = ax.get_window_extent()
    for shapes in ax.collections:
        for path, width in zip(shapes.get_paths(), shapes.get_linewidths(), strict=True):
            places = ax.transData.transform(path.vertices)
            reach = width / 2 * ax.figure.dpi / 72
            assert (places.min(axis=0) - reach >= room.min - 0.5).all()
            assert (places.max(axis=0) + reach <= room.max + 0.5).all()


def test_a_film_of_thick_strokes_holds_them():
    film = animate(read("widths: pixels\naxiom: !(20)F\nF -> FF"), 3)
    for image in film.images:
        pixels = np.array(image.convert("L"))
        assert (pixels[[0, -1]] == 255).all()
        assert (pixels[:, [0, -1]] == 255).all()
        assert (pixels < 200).any(axis=0).sum() == pytest.approx(20, abs=1)


# --- widths -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("width", [1, 2, 5.5, 10, 40])
@pytest.mark.parametrize("length", [1, 10, 100])
def test_widths_are_pixels_where_the_model_says_so(width, length):
    found = [
        int(each) for each in WIDTHS.findall(drawn(f"widths: pixels\naxiom: F({length})!({width})F({length})+F({length})").svg)
    ]
    assert sorted(found) == pytest.approx(sorted([24, 10 * width]), rel=0.06)  # round ends at the edge take some room


@pytest.mark.parametrize("text", ["axiom: !(0.25)F(2)", "axiom: !(0.5)F(4)", "widths: units\naxiom: !(2)F(16)"])
def test_widths_in_proportion_and_those_that_a_model_calls_so_are_units(text):
    svg = drawn(text).svg
    width, (_, y, _, to_y) = WIDTHS.findall(svg)[-1], re.search(r"M(\d+) (\d+)L(\d+) (\d+)", svg).groups()
    assert abs(int(to_y) - int(y)) / int(width) == pytest.approx(8, rel=0.02)


@pytest.mark.parametrize("width", [1, 0.1, 0.001])
def test_strokes_that_are_far_too_fine_for_a_drawing_are_broader_with_one_another(width):
    widths = [int(each) for each in WIDTHS.findall(drawn(f"axiom: !({width})F(300)!({width / 2})F(300)").svg)]
    assert widths == pytest.approx([6160 * FINE, 3080 * FINE], rel=0.03)
    finest = [int(each) for each in WIDTHS.findall(drawn(f"widths: units\naxiom: !({width})F(600)").svg)]
    assert finest == [max(THINNEST, round(10 * width * 616 / 600))]


def test_a_drawing_that_is_larger_than_the_picture_is_made_smaller_with_its_strokes():
    widths = [
        int(WIDTHS.findall(drawn(f"widths: pixels\naxiom: !(20)F({length})").svg)[-1]) for length in (1, 100, 560, 1120, 2240)
    ]
    assert widths[:3] == [200, 200, 200]
    assert widths[3:] == [pytest.approx(107, abs=3), pytest.approx(54, abs=2)]


def test_widths_of_grogra_are_units():
    svg = draw(derive(read("\\axiom L10 D5 F,", "grogra"), 0)).svg
    assert int(WIDTHS.findall(svg)[-1]) == pytest.approx(616 / 15 * 50, rel=0.02)


def test_a_mesh_has_stems_as_broad_as_those_of_the_picture():
    picture = draw(derive(read("widths: pixels\naxiom: !(10)F&(0)F"), 0))
    least, greatest = picture.mesh.corners
    assert (greatest[2] - least[2]) / (greatest[0] - least[0]) == pytest.approx(2 * 120 / 10, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(("number", "trunk"), [("2.6", 158), ("2.7", 130), ("2.8", 116)])
def test_the_trees_of_the_book_are_drawn_with_stems_and_twigs(number, trunk):
    """Figures 2.6 to 2.8: stems some ten pixels wide, twigs as fine as one can see, and paper between them."""
    picture = draw(read((BOOK / f"{number}.txt").read_text(encoding="utf-8")), arithmetic="float")
    width, parts = map(int, re.search(r'viewBox="0 0 (\d+) .*? width="(\d+)"', picture.svg).groups())
    tenths = [int(each) * 10 * parts / width for each in re.findall(r'stroke="#FFFFFF" stroke-width="(\d+)"', picture.svg)]
    widths = [each - BROADEST_CASING for each in tenths]
    assert max(widths) == pytest.approx(trunk, abs=0.12 * trunk)  # near ones are magnified
    assert min(int(each) * 10 * parts / width for each in WIDTHS.findall(picture.svg)) >= 6
    image = np.array(Image.open(io.BytesIO(picture.png)).convert("L"))
    assert 0.02 < (image < 250).mean() < 0.3


def test_a_width_is_thinned_from_where_strokes_are_by_themselves():
    widths = derive(read("axiom: F[!F[!F]]"), 0)
    found = sorted(int(width) for width in WIDTHS.findall(draw(widths).svg))
    assert [each / found[-1] for each in found] == pytest.approx([0.49, 0.7, 1], abs=0.01)


def looks(text, n=0, **choices):
    """What a drawing looks like: its size and its strokes in whole pixels, each with its width in tenths."""
    svg = draw(read(text), n, **choices).svg
    width, height, units = map(int, re.search(r'viewBox="0 0 (\d+) \d+" width="(\d+)" height="(\d+)"', svg).group(2, 3, 1))
    size = np.array([width, height])
    return size, np.array([int(each) * 10 * width / units for each in WIDTHS.findall(svg)])


PLANTS = ["{0}F[+F]F[-F]F", "{0}F{1}[+F{2}[+F]F][-F]F", "{1}F[&F][^F]F", "{3}F[+{2}F]F"]


@pytest.mark.slow
@pytest.mark.parametrize("word", PLANTS)
@pytest.mark.parametrize("broad", ["", "!({})"])
@pytest.mark.parametrize("factor", [10, 1000, 0.01])
def test_a_model_and_the_same_model_so_many_times_as_large_look_alike(word, broad, factor):
    for first in (0.01, 0.3, 0.99, 1, 1.01, 5, 40):
        sizes, widths = zip(
            *(
                looks(
                    f"angle: 30\nlength: {scale * 3}\naxiom: "
                    + word.format(*(broad.format(scale * first * share) for share in (1, 0.5, 0.25, 2)))
                )
                for scale in (1, factor)
            ),
            strict=True,
        )
        if 3 * 3 * min(1, factor) * 120 < 600:
            continue  # a small drawing is not enlarged without end
        assert np.abs(sizes[0] - sizes[1]).max() <= 1
        assert widths[0] == pytest.approx(widths[1], rel=0.03, abs=1)


@pytest.mark.slow
@pytest.mark.parametrize("text", ["!({})F[+F]F" + "F" * 9, "!({})F(2)[&F]F", "!({})F"])
def test_widths_have_no_cliff(text):
    trunks = [looks("angle: 30\naxiom: " + text.format(width / 100))[1].max() for width in range(2, 300)]
    assert all(later >= before - 1 for before, later in pairwise(trunks))
    assert all(later <= before + 13 for before, later in pairwise(trunks))


@pytest.mark.slow
@pytest.mark.parametrize("size", [60, 200, (100, 300), 1200])
@pytest.mark.parametrize("text", ["angle: 25\naxiom: F\nF -> F[+F]F[-F]F", "angle: 25\naxiom: F\nF -> F[&F]F[^F]F"])
def test_no_stroke_is_finer_than_is_seen_at_the_size_that_is_shown(size, text):
    picture = draw(read(text), 4, size=size)
    drawing = picture.drawing()
    factor = drawing.width / drawing.box[2]
    assert min(int(width) * factor for width in re.findall(r'<path[^>]*stroke-width="(\d+)"', picture.svg)) >= 0.65


def test_no_stroke_is_finer_than_is_seen():
    for text in ("axiom: !(0.001)F[+F]F", "axiom: F\nF -> F[+F]F[-F]F", "widths: pixels\naxiom: !(0.1)FF"):
        assert looks(f"angle: 25\n{text}", 5)[1].min() >= 7 - 0.1


def test_the_unit_of_widths_is_kept_in_what_is_written():
    assert "widths: units" in str(read("widths: units\naxiom: F"))
    assert read(str(read("widths: units\naxiom: F"))).widths == "units"
    assert read("axiom: F").widths == ""
    assert (drawn("axiom: F!(3)F").scene.segments.widths == OWN).tolist() == [True, False]


@pytest.mark.parametrize(("id", "step"), [("K5", 5), ("K5", 6), ("K4", 6)])
def test_rounding_bends_strokes_by_less_than_is_seen(id, step):
    picture = draw(system(id), step)
    places = re.findall(r"M(-?\d+) (-?\d+)L(-?\d+) (-?\d+)", picture.svg)
    x, y, to_x, to_y = np.array(places, float).T
    found = np.sort(np.degrees(np.arctan2(y - to_y, to_x - x)))
    start_x, start_y, end_x, end_y = picture.scene.segments.ends.T
    drawn = np.sort(np.degrees(np.arctan2(end_y - start_y, end_x - start_x)))
    off = np.abs(found - drawn)
    assert np.minimum(off, 360 - off).mean() < 0.5


@pytest.mark.parametrize("short", [10, 1, 0.1, 0.02])
def test_numbers_are_rounded_to_a_fiftieth_of_the_median_stroke(short):
    picture = draw(derive(read("angle: 25\naxiom: F(1000)" + f"+F({short})" * 5), 0))
    units, width = map(int, re.search(r'viewBox="0 0 (\d+) .*? width="(\d+)"', picture.svg).groups())
    median = short * frame_around([picture.scene]).scale * units / width
    assert median >= 50  # of the units in which numbers are whole
    places = np.array(re.findall(r"M(-?\d+) (-?\d+)L(-?\d+) (-?\d+)", picture.svg), float)
    assert np.median(np.hypot(*(places[:, 2:] - places[:, :2]).T)) == pytest.approx(median, abs=1.5)


@pytest.mark.parametrize("text", ["f F(0) [F(0)]", "F(0)[+F(0)]", "[+f]@o", "F(0)[+F(0)]@O(2)"])
def test_a_plant_without_extent_is_drawn(text: str) -> None:
    plant = read(f"axiom: {text}")
    assert draw(plant, 0).svg
    assert draw(plant, steps=[0, 0]).png
