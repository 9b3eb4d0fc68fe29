"""Small multiples: several steps and seeds side by side on one scale; and pictures of any size."""

from __future__ import annotations

import io
import re

import numpy as np
import pytest
from PIL import Image

from lsys_kit import (
    ModelLimitError,
    ModelValueError,
    animate,
    cellwork_system,
    derive,
    draw,
    lineage,
    map_system,
    read,
    stages,
    system,
)
from lsys_kit.__main__ import main
from lsys_kit.pictures.multiples import SmallMultiples, arranged

GROWING = read("axiom: F\nF -> FF")
HEAD = re.compile(r'viewBox="(-?\d+) (-?\d+) (\d+) (\d+)" width="(\d+)" height="(\d+)"')


def png_size(picture):
    return Image.open(io.BytesIO(picture.png)).size


def head(svg):
    return [int(number) for number in HEAD.search(svg).groups()]


def lengths(svg):
    """How long the lines of each drawing are together, in units of the picture."""
    places = (np.array(re.findall(r"M(-?\d+) (-?\d+)L(-?\d+) (-?\d+)", part), float) for part in svg.split("<text ")[:-1])
    return [np.hypot(*(lines[:, 2:] - lines[:, :2]).T).sum() for lines in places]


# --- steps and seeds --------------------------------------------------------------------------------------------------


def test_steps_stand_side_by_side_on_one_scale():
    found = draw(GROWING, steps=[1, 2, 4])
    assert isinstance(found, SmallMultiples)
    assert re.findall(r">(step \d)<", found.svg) == ["step 1", "step 2", "step 4"]
    short, middle, tall = lengths(found.svg)
    assert (middle / short, tall / short) == pytest.approx((2, 8), rel=0.01)


def test_each_drawing_is_the_one_of_its_step_and_its_seed():
    found = draw(system("K7"), steps=[3, 4], seeds=[5, 6])
    assert found.captions == ["seed 5, step 3", "seed 5, step 4", "seed 6, step 3", "seed 6, step 4"]
    for picture, (seed, step) in zip(found.pictures, [(5, 3), (5, 4), (6, 3), (6, 4)], strict=True):
        alone = draw(system("K7"), step, seed=seed)
        assert (picture.scene.segments.ends == alone.scene.segments.ends).all()


def test_drawings_of_a_line_stand_on_one_ground_and_do_not_meet():
    scenes = [each.scene for each in draw(system("K7"), steps=[3, 4, 5], seeds=[1, 2, 3], widths="order").pictures]
    panels = arranged(scenes, 3)
    boxes = []
    for scene, panel in zip(scenes, panels, strict=True):
        x, y = panel.frame.points(scene.segments.points).T / panel.frame.parts
        assert y.max() == pytest.approx(panel.ground, abs=0.2)
        boxes.append((x.min(), y.min(), x.max(), y.max()))
    for number, (left, top, right, bottom) in enumerate(boxes):
        assert min(left, top) >= 0
        for x, y, to_x, to_y in boxes[:number]:
            assert right < x or to_x < left or bottom < y or to_y < top


def test_what_is_in_space_is_seen_from_one_place():
    found = draw(system("K19"), steps=[9, 15], view=(60, 20))
    assert found.pictures[1].scene.segments.ends == pytest.approx(draw(system("K19"), 15, view=(60, 20)).scene.segments.ends)


def test_rows_of_a_filament_are_chosen_by_steps():
    assert [row.step for row in draw(system("J1"), steps=[1, 3, 6]).rows] == [1, 3, 6]


@pytest.mark.parametrize(
    ("what", "choices", "message"),
    [
        (GROWING, {"n": 3, "steps": [1]}, "Steps are chosen by n or by steps"),
        (GROWING, {"steps": [-1]}, "must be a whole number"),
        (GROWING, {"steps": "12"}, "takes a list of whole numbers"),
        (GROWING, {"seed": 1, "seeds": [1, 2]}, "Give either seed=1 or seeds"),
        (derive(GROWING, 3), {"steps": [1, 5]}, "Step 5 has not been derived"),
        (derive(GROWING, 3), {"seeds": [1, 2]}, "Seeds are chosen when a system is derived"),
        (derive(GROWING, 3)[1], {"steps": [1]}, "a word has none"),
        (system("J1"), {"seeds": [1, 2]}, "the steps of one seed"),
    ],
)
def test_what_makes_no_sense_is_told(what, choices, message):
    with pytest.raises(ModelValueError, match=message):
        draw(what, **choices)


def test_there_are_not_too_many():
    with pytest.raises(ModelLimitError, match="36 drawings at most, not 49"):
        draw(system("K7"), steps=[*range(7)], seeds=[*range(7)])


# --- sizes ------------------------------------------------------------------------------------------------------------

PICTURES = {
    "plant": lambda **size: draw(system("K5"), 3, **size),
    "filament": lambda **size: draw(system("J1"), 5, **size),
    "in space": lambda **size: draw(system("K19"), 9, **size),
    "cells": lambda **size: draw(cellwork_system("K33"), 1, **size),
    "steps": lambda **size: draw(GROWING, steps=[1, 2], **size),
}
SVG_ONLY = {
    "net": lambda **size: draw(stages(system("P2")), **size),
    "map": lambda **size: draw(map_system("K28"), 1, **size),
    "lineage": lambda **size: draw(lineage(system("P6"), 2), **size),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", PICTURES | SVG_ONLY)
def test_a_picture_is_enlarged_as_a_whole(name):
    make = (PICTURES | SVG_ONLY)[name]
    _, _, across, down, width, height = head(make().svg)
    assert head(make(size=900).svg) == [0, 0, across, down, 900, round(height * 900 / width)]
    x, y, wide, high, *size = head(make(size=(700, 900)).svg)
    assert size == [700, 900]
    assert wide / high == pytest.approx(7 / 9, rel=0.01)
    assert (2 * x + wide, 2 * y + high) == pytest.approx((across, down), abs=1)
    assert make(size=900).svg.split("</title>")[1] == make().svg.split("</title>")[1]


@pytest.mark.slow
@pytest.mark.parametrize("name", PICTURES)
def test_a_png_has_the_size_that_was_chosen_and_shows_the_same(name):
    usual = Image.open(io.BytesIO(PICTURES[name]().png)).convert("L")
    for size in (2 * usual.width, (2 * usual.width, 3 * usual.height)):
        image = Image.open(io.BytesIO(PICTURES[name](size=size).png)).convert("L")
        assert image.size == (size if isinstance(size, tuple) else (size, 2 * usual.height))
        middle = image.crop((0, (image.height - 2 * usual.height) // 2, image.width, (image.height + 2 * usual.height) // 2))
        small = np.asarray(middle.resize(usual.size, Image.Resampling.BOX), float)
        assert np.abs(small - np.asarray(usual, float)).mean() < 3


@pytest.mark.parametrize("size", [0, 15, 10**6, "big", (1, 2, 3), (600, -1), 1.5])
def test_a_size_that_makes_no_sense_is_told(size):
    with pytest.raises(ModelValueError):
        draw(GROWING, 1, size=size)


@pytest.mark.slow
def test_a_picture_that_needs_too_much_memory_is_refused():
    with pytest.raises(ModelLimitError):
        _ = draw(GROWING, 3, size=(20_000, 20_000)).png


@pytest.mark.parametrize("what", [system("K5"), system("J1"), system("K19")])
def test_a_film_has_the_size_that_was_chosen(what):
    assert {image.size for image in animate(what, 4, size=(300, 500)).images} == {(300, 500)}


# --- the shell --------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_shell_draws_steps_and_seeds_from_a_side_in_a_size(tmp_path, capsys):
    main(["draw", "K7", "-n", "3,4", "--seeds", "1,2", "--size", "900", "-o", str(tmp_path / "k7.png")])
    main(["draw", "K19", "-n", "9", "--view", "60,20", "--size", "300,300", "-o", str(tmp_path / "k19.svg")])
    assert Image.open(tmp_path / "k7.png").width == 900
    assert draw(system("K19"), 9, view=(60, 20), size=(300, 300)).svg in (tmp_path / "k19.svg").read_text()
    assert "seed 1, step 3 to seed 2, step 4" in capsys.readouterr().out
