"""Pictures of maps: what is in them, what is said about them."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from lsys_kit import ModelFileError, ModelLimitError, ModelNameError, ModelValueError, animate, derive, draw, limits, map_system
from lsys_kit.notation.dialects.map.dialect import read_map
from lsys_kit.pictures.rendering.frames import MARGIN
from lsys_kit.pictures.style.palette import SERIES
from lsys_kit.pictures.tissues.maps import CAPTION, FILLS, MOST_MAPS, SEEN, MapPicture, arranged, cell_colour
from tests.endings import SAID_OF_FLAT

SVG = "{http://www.w3.org/2000/svg}"
K28 = read_map("map: ABAB\nA -> B[-A][+A]B\nB -> A")
K30 = read_map("map: A>B>C>D>\nsteps: 5\nA> -> D>[-A>]B>\nC> -> B>[-A<]B>\nD> -> C>")


def parsed(picture: MapPicture) -> ET.Element:
    return ET.fromstring(picture.svg)


def test_the_steps_stand_side_by_side() -> None:
    picture = draw(K28, 3)
    assert str(picture) == "steps 0 to 3; the last: 15 vertices, 22 walls, 8 cells"
    assert len(parsed(picture).findall(f".//{SVG}polygon")) == 1 + 2 + 4 + 8
    numbers = [found for found in parsed(picture).findall(f"{SVG}text") if (found.text or "").isdigit()]
    assert [found.text for found in numbers] == ["0", "1", "2", "3"]
    assert [int(found.get("x", "")) for found in numbers] == sorted(int(found.get("x", "")) for found in numbers)
    assert str(draw(K28, 0)) == "4 vertices, 4 walls, 1 cell"


@pytest.mark.slow
def test_a_picture_says_what_its_colours_mean_and_is_the_same_every_time() -> None:
    picture = draw(K28, 2)
    assert parsed(picture).get("aria-label") == f"{picture}; all cells have the same walls around them"
    assert "cells of one colour have the same walls around them" in draw(K30).svg
    assert "but for grey ones" not in draw(K30).svg
    assert picture.svg == draw(K28, 2).svg


def test_cells_of_one_kind_have_one_colour() -> None:
    fills = [polygon.get("fill") for polygon in parsed(draw(K30)).findall(f".//{SVG}polygon")]
    assert fills[:6] == [cell_colour(kind) for kind in (0, 0, 1, 0, 1, 2)]
    assert len({*FILLS}) == 2 * len(SERIES)


def test_a_long_development_shows_its_last_steps() -> None:
    picture = draw(derive(read_map("map: AAA"), 13))
    assert [*picture.numbers] == [*range(14 - MOST_MAPS, 14)]
    assert len(picture.maps) == MOST_MAPS
    assert str(picture) == "steps 2 to 13; the last: 3 vertices, 3 walls, 1 cell"


@pytest.mark.parametrize(("id", "step"), [("K28", 0), ("K31", 0), ("K28", 1), ("K28", 4)])
def test_a_few_maps_are_large_enough_to_be_seen(id: str, step: int) -> None:
    panels = arranged(draw(map_system(id), step).scenes)
    assert panels[0].frame.height - 2 * MARGIN - CAPTION >= SEEN


def test_walls_have_labels_and_those_with_a_direction_arrows() -> None:
    neutral, directed = draw(K28, 1), draw(K30, 1)
    for picture, system, arrows in ((neutral, K28, 0), (directed, K30, 11)):
        texts = ["".join(found.itertext()) for found in parsed(picture).findall(f"{SVG}g/{SVG}text")]
        assert sorted(texts) == sorted(wall.label for found in derive(system, 1) for wall in found.walls)
        assert len(re.findall("Z", picture.svg)) == arrows


def test_labels_can_be_left_out() -> None:
    bare = draw(K30, 1, labels=False)
    assert not parsed(bare).findall(f"{SVG}g/{SVG}text")
    assert len(re.findall("Z", bare.svg)) == 11
    assert not parsed(draw(K30, 2, iterations=[5], labels=False)).findall(f"{SVG}g/{SVG}text")
    with pytest.raises(ModelValueError, match='True or False for "labels"'):
        draw(K30, 1, labels="no")  # type: ignore[call-overload]


@pytest.mark.slow
def test_a_step_that_does_not_settle_is_said_not_to() -> None:
    floppy = draw(read_map("map: ABAB\nA -> B[-A]x[+A]B\nB -> A"), 1, rest=1, pressure="0.01", damping=10)
    assert str(floppy) == "steps 0 to 1; the last: 8 vertices, 9 walls, 2 cells; step 1 does not settle"
    assert "settle" not in str(draw(K28, 1))


def test_a_label_has_its_number_lowered() -> None:
    assert '<tspan font-style="italic">P</tspan><tspan dy="3" font-size="70%">0</tspan>' in draw(read_map("map: P0AB"), 0).svg


@pytest.mark.slow
def test_small_maps_have_no_labels_and_fit_into_the_picture() -> None:
    picture = draw(K28, 8)
    root = parsed(picture)
    assert int(root.get("width", "")) <= 760 + 1
    width, height = (10 * int(root.get(name, "")) for name in ("width", "height"))
    for polygon in root.findall(f".//{SVG}polygon"):
        corners = [tuple(map(int, corner.split(","))) for corner in polygon.get("points", "").split()]
        assert all(0 <= x <= width and 0 <= y <= height for x, y in corners)


def test_maps_do_not_overlap() -> None:
    boxes = []
    for _, places, panel in zip(*_panels(draw(K30, 9)), strict=True):
        points = panel.frame.points(places)
        boxes.append((*points.min(axis=0).tolist(), *points.max(axis=0).tolist()))
    for index, (left, top, right, bottom) in enumerate(boxes):
        assert all(right < l or r < left or bottom < t or b < top for l, t, r, b in boxes[:index])  # noqa: E741


def _panels(picture):  # type: ignore[no-untyped-def]
    from lsys_kit.pictures.tissues.maps import arranged

    return picture.maps, picture.places, arranged(picture.scenes)


def test_a_system_says_how_many_steps_it_wants() -> None:
    assert str(draw(K30)).startswith("steps 0 to 5")
    assert str(draw(K28)).startswith("steps 0 to 4")
    assert str(draw(derive(K28, 2))).startswith("steps 0 to 2")
    with pytest.raises(ModelValueError, match="Steps are chosen when a map system is derived"):
        draw(derive(K28, 2), 3)


def test_more_pressure_makes_larger_cells() -> None:
    small, large = draw(K28, 1), draw(K28, 1, pressure="2/10")
    assert large.scenes[-1].width > 1.1 * small.scenes[-1].width


def test_the_cells_of_a_step_come_to_rest_from_picture_to_picture() -> None:
    picture = draw(K28, 2, iterations=[0, 20, 100])
    assert str(picture) == "step 2 after 0, 20, 100 iterations; 9 vertices, 12 walls, 4 cells"
    assert [scene.width for scene in picture.scenes] == sorted(scene.width for scene in picture.scenes)
    assert [found.text for found in parsed(picture).findall(f"{SVG}text")] == ["0", "20", "100"]
    assert str(draw(K28, 2, iterations=[np.int64(20)])) == str(draw(K28, 2, iterations=[20]))
    at_rest = draw(K28, 2, iterations=[90_000])
    assert at_rest.scenes[0].box == draw(K28, 2).scenes[-1].box
    assert draw(derive(K28, 0), iterations=[0]).maps[0].counts == (4, 4, 1)


@pytest.mark.parametrize(
    ("choices", "kind", "message"),
    [
        ({"iterations": [-1]}, ModelValueError, "Iterations are whole numbers from 0 on, each greater than the one before"),
        ({"iterations": [3, 3]}, ModelValueError, "Iterations are whole numbers from 0 on, each greater than the one before"),
        ({"iterations": ["3"]}, ModelValueError, "Iterations are whole numbers from 0 on, each greater than the one before"),
        ({"iterations": range(13)}, ModelValueError, "A picture shows 12 iterations at most, not 13"),
        ({"angle": 30}, ModelNameError, 'A map has no "angle". Its forces are stiffness, rest, pressure, damping'),
        ({"pressure": -1}, ModelValueError, '"pressure" must lie between 0.001 and 10, not be -1'),
        ({"stiffness": "1e9"}, ModelValueError, '"stiffness" must lie between 0.01 and 100, not be 1e'),
    ],
)
def test_forces_are_named_and_lie_where_they_can_be_computed(choices: dict[str, object], kind: type, message: str) -> None:
    with pytest.raises(kind, match=re.escape(message)):
        draw(K28, 1, **choices)


def test_a_picture_is_kept_as_svg(tmp_path) -> None:  # type: ignore[no-untyped-def]
    picture = draw(K28, 1)
    picture.save(tmp_path / "map.svg")
    assert (tmp_path / "map.svg").read_text().startswith(f"{picture.svg}\n")
    assert picture._repr_mimebundle_()["text/plain"] == str(picture)
    with pytest.raises(ModelFileError, match=re.escape(f"Let the name end in {SAID_OF_FLAT}")):
        picture.save(tmp_path / "map.glb")


def test_a_picture_with_too_many_walls_is_refused() -> None:
    with limits(segments=20), pytest.raises(ModelLimitError, match="The picture would have 23 walls; the limit is 20"):
        draw(K28, 2)


def test_a_step_is_shown_in_its_phases_on_the_cells_before_it() -> None:
    picture = draw(K28, 1, phases=True)
    assert str(picture) == "step 1 in 4 pictures: 2 of 4 markers match; at the end 2 cells"
    drawn = ET.fromstring(picture.svg)
    captions = [found.text for found in drawn.findall(f"{SVG}text")]
    assert captions == ["step 0", "walls replaced", "markers matched", "step 1"]
    assert len(drawn.findall(f".//{SVG}polygon")) == 1 + 1 + 1 + 2
    assert len(animate(K28, 1, phases=True).images) == 4
    assert str(draw(K30, 2, phases=True)) == "step 2 in 4 pictures: 2 of 2 markers match; at the end 3 cells"
    assert "&gt;" in draw(K30, 1, phases=True).svg
    assert "&gt;" not in draw(K30, 1, phases=True, labels=False).svg


def test_a_step_without_markers_has_phases_too() -> None:
    plain = read_map("map: ABC\nA -> B")
    assert str(draw(plain, 1, phases=True)) == "step 1 in 4 pictures: 0 of 0 markers match; at the end 1 cell"


@pytest.mark.parametrize(
    ("steps", "phases", "says"), [(0, True, "Phases are those of a step"), (1, "yes", "True or False"), (1, 1, "True or False")]
)
def test_phases_are_those_of_a_step(steps: int, phases: object, says: str) -> None:
    with pytest.raises(ModelValueError, match=says):
        draw(K28, steps, phases=phases)  # type: ignore[call-overload]
