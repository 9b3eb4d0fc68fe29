"""Shapes: the steps along their outlines, what groups pass on, and their pixels."""

from __future__ import annotations

import io
import re
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.path import Path as Outline
from PIL import Image

from lsys_kit import draw, map_system, plot, stages, system
from lsys_kit.pictures.formats.lettering import advance
from lsys_kit.pictures.formats.painter import Subpath, dashed, lettering, subpaths
from lsys_kit.pictures.formats.painting import painted
from lsys_kit.pictures.formats.pdf import number_text
from lsys_kit.pictures.shapes import Circle, Drawing, Group, Look, Path, Place, Rectangle, Shape, Span, Strokes, Text
from lsys_kit.pictures.sizes import document

NUMBERS = st.integers(-1000, 1000)
WHOLE = (None, None, 400, 300)


def pixels(*shapes: Shape, box: tuple[int, int, int, int] = (0, 0, 400, 300)) -> np.ndarray:
    drawing = document(shapes, 40, 30, "-")
    return np.asarray(painted(Drawing(40, 30, "-", drawing.shapes, box, Look())))


# --- paths ------------------------------------------------------------------------------------------------------------


@given(st.lists(st.tuples(NUMBERS, NUMBERS), min_size=2, max_size=6))
def test_relative_and_short_commands_mean_the_same(points: list[tuple[int, int]]) -> None:
    absolute = "M" + "L".join(f"{x} {y}" for x, y in points)
    ways = [(x - a, y - b) for (a, b), (x, y) in pairwise(points)]
    relative = "M{} {}".format(*points[0]) + "".join(f"l{x} {y}" for x, y in ways)
    steps = "M{} {}".format(*points[0]) + "".join(f"h{x}V{y}" for (x, _), (_, y) in zip(ways, points[1:], strict=True))
    corners = [subpaths(Path(data))[0].corners.tolist() for data in (absolute, relative, steps)]
    assert corners[0] == corners[1] == corners[2][::2] == [[*map(float, point)] for point in points]


@given(NUMBERS, NUMBERS, NUMBERS, NUMBERS)
def test_a_quadratic_curve_is_the_same_as_a_cubic_one(x: int, y: int, to_x: int, to_y: int) -> None:
    corners = subpaths(Path(f"M0 0Q{x} {y} {to_x} {to_y}"), 10)[0].corners
    shares = np.linspace(0, 1, len(corners))[:, None]
    expected = 2 * (1 - shares) * shares * (x, y) + shares**2 * (to_x, to_y)
    assert corners == pytest.approx(expected, abs=0.01)


def test_strokes_are_lines_between_their_ends() -> None:
    ends = np.array([[0, 0, 10, 20], [30, 0, 0, 30]])
    parts = [path.corners.tolist() for path in subpaths(Strokes(ends))]
    assert parts == [path.corners.tolist() for path in subpaths(Path("M0 0L10 20M30 0L0 30"))]


def test_a_circle_is_round_and_a_rectangle_holds_its_corners() -> None:
    around = subpaths(Circle(10, 20, 100), 10)[0].corners
    assert np.hypot(*(around - (10, 20)).T) == pytest.approx(100, abs=0.05)
    inside = Outline(subpaths(Rectangle(0, 0, 100, 50, 10))[0].corners)
    assert inside.contains_points([(50, 25), (12, 12)]).all()
    assert not inside.contains_points([(1, 1), (99, 49), (-1, 25)]).any()


@given(st.integers(1, 50), st.integers(1, 50), st.integers(1, 500))
def test_dashes_are_as_long_as_they_should_be(long: int, gap: int, whole: int) -> None:
    lengths = [np.ptp(part.corners[:, 0]) for part in dashed(Subpath(np.array([[0, 0], [whole, 0]]), False), (long, gap))]
    drawn, rest = divmod(whole, long + gap)
    assert sum(lengths) == pytest.approx(drawn * long + min(rest, long))


@given(st.floats(-1e6, 1e6))
def test_a_number_of_a_page_has_no_exponent(value: float) -> None:
    assert re.fullmatch(r"-?\d+(\.\d+)?", number_text(value))
    assert float(number_text(value)) == pytest.approx(value, abs=1e-5)


# --- what is around shapes --------------------------------------------------------------------------------------------


def test_groups_pass_on_how_shapes_look_and_where() -> None:
    found = pixels(Group([Path("M0 0H10V10H0Z")], Look(fill="#FF0000"), place=Place(10, 100, 50)))
    assert found[6:14, 11:19].reshape(-1, 3).tolist() == [[255, 0, 0]] * 64
    assert (found[:4] == 255).all()


def test_a_view_that_does_not_begin_at_nought_is_moved() -> None:
    found = pixels(Rectangle(0, 0, 100, 100, look=Look(fill="#0000FF")), box=(-100, -100, 400, 300))
    assert found[10:20, 10:20].reshape(-1, 3).tolist() == [[0, 0, 255]] * 100
    assert (found[11:, 20:] == 255).all()


@pytest.mark.parametrize(("anchor", "share"), [("start", 0), ("middle", 0.5), ("end", 1)])
def test_a_text_is_held_where_its_anchor_says(anchor: str, share: float) -> None:
    look: Look = {"font_size": 50, **({} if anchor == "start" else {"text_anchor": anchor})}  # type: ignore[typeddict-item]
    text = lettering(Text(200, 150, ["a", Span("1", Look(dy=9, font_size="50%"))]), look)
    assert text.runs[0].x == pytest.approx(200 - share * (advance("a", 50) + advance("1", 25)))
    assert text.runs[1].x == pytest.approx(text.runs[0].x + advance("a", 50))
    assert [run.y for run in text.runs] == [150, 159]


# --- painting ---------------------------------------------------------------------------------------------------------


def test_opacity_mixes_with_what_is_there() -> None:
    over = pixels(
        Rectangle(*WHOLE, look=Look(fill="#FF0000")),
        Rectangle(*WHOLE, look=Look(fill="#0000FF", fill_opacity=0.25)),
        Path("M0 150H400", Look(stroke="#FFFFFF", stroke_width=100, stroke_opacity=0.5)),
    )
    assert over[2, 20].tolist() == pytest.approx([191, 0, 64], abs=2)
    assert over[15, 20].tolist() == pytest.approx([223, 128, 160], abs=2)


def test_a_hole_is_left_out() -> None:
    ring = pixels(Path("M50 50H350V250H50ZM100 100H300V200H100Z", Look(fill="#008000", fill_rule="evenodd")))
    assert ring[7, 20].tolist() == [0, 128, 0]
    assert ring[15, 20].tolist() == [255, 255, 255]


def test_a_letter_has_room_around_it() -> None:
    dark, look = Rectangle(*WHOLE, look=Look(fill="#000000")), Look(font_size=150, text_anchor="middle", fill="#FF0000")
    halo = Look(stroke="#FFFFFF", stroke_width=40, paint_order="stroke")
    plain_one, other = (pixels(dark, Text(200, 200, "l", look | more)) for more in (Look(), halo))
    white = (other == 255).all(axis=2)
    assert white.any()
    assert not (plain_one == 255).all(axis=2).any()


def test_a_sphere_is_lighter_towards_the_light() -> None:
    picture = draw(map_system("K34"), 0)
    image = np.asarray(Image.open(io.BytesIO(picture.png)).convert("L"), float)
    middle, reach = image.shape[1] // 2, image.shape[1] // 5
    assert image[middle - reach, middle - reach] > image[middle + reach, middle + reach] + 30


@pytest.mark.parametrize(
    "make", [lambda: draw(system("J1"), 3), lambda: draw(stages(system("J4"))), lambda: plot(system("J1"), 4)]
)
def test_twice_as_large_is_the_same_with_finer_pixels(make) -> None:  # type: ignore[no-untyped-def]
    drawing = make().drawing()
    usual, large = (np.asarray(painted(drawing, factor).convert("L"), float) for factor in (1.0, 2.0))
    small = (large[::2, ::2] + large[1::2, ::2] + large[::2, 1::2] + large[1::2, 1::2]) / 4
    assert np.abs(small - usual).mean() < 2
