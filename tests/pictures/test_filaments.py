"""Developmental sequences as pictures: rows with a common scale, their steps and times, cells, arrows and walls."""

from __future__ import annotations

import io
import re
from xml.etree import ElementTree as ET

import pytest
from PIL import Image

from lsys_kit import ModelValueError, animate, derive, draw, figure, read, system
from lsys_kit.pictures.filaments import DrawnCell, FilamentLayout, filament_layout
from lsys_kit.pictures.picture import Picture
from lsys_kit.pictures.rendering.frames import WIDTH

SVG = "{http://www.w3.org/2000/svg}"


def shapes(picture: Picture, kind: str) -> list[ET.Element]:
    return [shape for shape in ET.fromstring(picture.svg).iter(f"{SVG}{kind}") if shape.get("stroke")]


def texts(picture: Picture) -> list[str]:
    return ["".join(text.itertext()) for text in ET.fromstring(picture.svg).iter(f"{SVG}text")]


def sheet(id: str, steps: int) -> FilamentLayout:
    return filament_layout(draw(system(id), steps).rows, numbered=True)


def test_cells_are_drawn_as_their_seed_draws_them() -> None:
    """Ellipses in seed 000, rectangles with round ends in seed 002."""
    assert (len(shapes(draw(system("J1"), 3), "ellipse")), len(shapes(draw(system("J1"), 3), "rect"))) == (11, 0)
    assert (len(shapes(draw(system("P1"), 3), "ellipse")), len(shapes(draw(system("P1"), 3), "rect"))) == (0, 11)


@pytest.mark.parametrize("age", ["1/3", "7", "1234567", "1e-7"])
def test_ages_of_walls_lie_within_the_picture(age: str) -> None:
    rules = f"axiom: V({age}) a V({age}) a V({age})\nV(t) -> V(t)\ninterpretation:\na -> R(30,1)\nV(t) -> W(t)"
    ages = [
        (int(text.get("x", "")), text.text or "")
        for text in ET.fromstring(draw(read(rules), 1).svg).iter(f"{SVG}text")
        if text.get("font-size") == "105"
    ]
    assert len(ages) == 6
    for x, text in ages:
        assert 30 * len(text) <= x <= WIDTH * 10 - 30 * len(text), "a figure is six tenths as wide as high"


def test_cells_are_drawn_as_a_teacher_wants_them() -> None:
    assert len(shapes(draw(system("J1"), 3, cells="rectangles"), "rect")) == 11
    assert len(shapes(draw(system("P1"), 3, cells="ellipses"), "ellipse")) == 11
    with pytest.raises(ModelValueError, match="rectangles or ellipses, not as 'squares'"):
        draw(system("P1"), 3, cells="squares")


def test_the_smallest_cells_of_l_system_7_are_round() -> None:
    """Seed 002, section 8: the width of a cell is the length of a new short one."""
    cell = shapes(draw(system("P7"), 0), "rect")[0]
    assert cell.get("width") == cell.get("height") == str(2 * int(cell.get("rx")))  # type: ignore[arg-type]


@pytest.mark.parametrize(("id", "steps"), [("J1", 6), ("P5", 6), ("P9w", 6), ("J4", 12)])
def test_all_rows_have_one_scale_and_one_middle(id: str, steps: int) -> None:
    found = sheet(id, steps)
    middles = set()
    for row in found.rows:
        cells: list[DrawnCell] = list(found.cells(row))
        assert sum(2 * cell.length for cell in cells) == pytest.approx(found.scale * row.scene.width)
        middles.add(round(cells[0].x - cells[0].length + cells[-1].x + cells[-1].length, 6))
    assert len(middles) == 1
    assert max(cells[-1].x + cells[-1].length for cells in (list(found.cells(row)) for row in found.rows)) < WIDTH


@pytest.mark.parametrize(("id", "steps"), [("J1", 6), ("P5", 6), ("P9", 6), ("J5", 20), ("J3", 40), ("P1", 0)])
def test_rows_do_not_touch(id: str, steps: int) -> None:
    found = sheet(id, steps)
    tall = max(row.scene.height for row in found.rows) * found.scale + found.above
    assert tall <= 0.95 * found.pitch


@pytest.mark.parametrize(("id", "steps"), [("P1", 10), ("P1", 12), ("P9w", 10), ("J5", 24)])
def test_a_row_of_more_than_a_hundred_cells_is_folded_into_equal_lines(id: str, steps: int) -> None:
    rows, found = draw(system(id), steps).rows, sheet(id, steps)
    assert len(found.rows) > len(rows)
    for row in rows:
        lines = [line for line in found.rows if line.step == row.step]
        for values in (lambda scene: scene.cells.states.tolist(), lambda scene: scene.walls.states.tolist()):
            assert [state for line in lines for state in values(line.scene)] == values(row.scene)
        lengths, longest = [line.scene.width for line in lines], row.scene.cells.sizes[:, 0].max()
        assert sum(lengths) == pytest.approx(row.scene.width)
        assert max(lengths) - min(lengths) <= 2 * longest
        assert len({round(next(found.cells(line)).x - next(found.cells(line)).length, 6) for line in lines}) == 1
    assert min(cell.length for line in found.rows for cell in found.cells(line)) > 2, "pixels"


def test_a_folded_row_has_its_number_once_and_is_marked_as_a_whole() -> None:
    root = ET.fromstring(draw(system("P1"), 10).svg)
    assert texts(draw(system("P1"), 10)) == ["step", *map(str, range(11))]
    assert len([band for band in root.iter(f"{SVG}rect") if band.get("rx") == "60" and not band.get("stroke")]) == 3


@pytest.mark.slow
def test_a_film_of_folded_rows_ends_with_their_picture() -> None:
    images = animate(system("P1"), 10).images
    assert len(images) == 11
    assert images[-1].tobytes() == Image.open(io.BytesIO(draw(system("P1"), 10).png)).convert("RGB").tobytes()


@pytest.mark.parametrize("cells", [89, 100])
def test_a_row_of_at_most_a_hundred_cells_is_a_line(cells: int) -> None:
    row = draw(read("axiom: " + "a " * cells + "\ninterpretation:\na -> R(2,1)"), 0).rows
    assert filament_layout(row).rows == row


def test_a_filament_of_too_many_lines_is_shown_as_a_whole() -> None:
    rows = draw(derive(system("P1"), 20)[-1]).rows
    assert filament_layout(rows).rows == rows


def test_rows_have_their_steps_and_times_where_a_step_is_no_unit_of_time() -> None:
    assert texts(draw(system("P5"), 2)) == ["step", "t", "0", "0", "1", "0.7", "2", "1.4"]
    assert texts(draw(system("P5"), 1, dt="1/3"))[-2:] == ["1", "1/3"]
    assert texts(draw(system("J4"), 2)) == ["step", "0", "1", "2"]


def test_a_word_by_itself_has_no_number() -> None:
    assert texts(draw(derive(system("J1"), 3)[-1])) == []


def test_the_last_row_is_marked_by_more_than_colour() -> None:
    root = ET.fromstring(draw(system("J1"), 3).svg)
    assert ["".join(text.itertext()) for text in root.iter(f"{SVG}text") if text.get("font-weight") == "bold"] == ["3"]


def test_every_cell_with_a_polarity_has_an_arrow() -> None:
    data = "".join(path.get("d", "") for path in ET.fromstring(draw(system("J1"), 3).svg).iter(f"{SVG}path"))
    assert data.count("H") == 11


def test_walls_are_drawn_with_their_ages_and_the_older_ones_thicker() -> None:
    picture = draw(derive(system("P9w"), 3)[-1])
    walls = [path for path in shapes(picture, "path") if re.fullmatch(r"M\d+ \d+V\d+", path.get("d", ""))]
    assert texts(picture) == ["3", "1", "0", "2", "0", "4"]
    widths = [int(wall.get("stroke-width", "0")) for wall in walls]
    assert sorted(range(6), key=widths.__getitem__) == sorted(range(6), key=[3, 1, 0, 2, 0, 4].__getitem__)


def test_ages_that_would_stand_too_close_are_left_out() -> None:
    crowded = read("axiom: W(1.25) a W(2.25)\na -> a W(0.25) a\ninterpretation:\na -> O(0.1,1)")
    assert "0.25" not in texts(draw(derive(crowded, 2)[-1]))


def test_a_figure_shows_the_same_cells_and_texts() -> None:
    ax, picture = figure(system("P9w"), n=2), draw(system("P9w"), 2)
    assert [text.get_text() for text in ax.texts] == texts(picture)
    assert (
        sum(len(shapes.get_paths()) for shapes in ax.collections)
        == len(re.findall(r"<(rect|ellipse|path(?! d=\"\"))", picture.svg))
        > 9
    )


def test_a_look_reads_back_and_is_no_part_of_what_a_system_is() -> None:
    model = read("cells: ellipses\naxiom: a\na -> a b\ninterpretation:\na -> R(2,1)")
    assert read(str(model)).cells == "ellipses"
    assert model == read(str(model).replace("cells: ellipses\n", ""))
