"""Natural colours: bark where strokes are wide or near the stem, leaves where they are thin or far from it."""

from __future__ import annotations

import pytest

from lsys_kit import ModelSyntaxError, derive, draw, read, write
from lsys_kit.geometry.drawing import has_natural_colours, scene_of
from lsys_kit.geometry.scene import OWN
from lsys_kit.geometry.turtle.commands import BLOSSOM, RAMP_END, RAMP_START
from lsys_kit.pictures.style.palette import RAMP

ORGANS = "axiom: I[+L]I\ninterpretation:\nI -> F\nL -> F F"
TREE = "axiom: F[&F[&F]]F"


def colours(text, n=0):
    return scene_of(derive(read(text), n)).segments.colours.tolist()


@pytest.mark.parametrize("turn", ["&", "+"])
def test_by_the_tips_that_a_stroke_bears_from_bark_to_leaves(turn):
    assert colours(f"axiom: F[{turn}F[{turn}F]F]F") == [16, 19, 23, 23, 23]


def test_by_width_where_it_is_set():
    assert colours("colours: natural\naxiom: !(4)F!(1)F[!(0)F]") == [16, 20, 23]


def test_an_unbranched_stem_is_green_and_a_chosen_colour_stays():
    assert colours("colours: natural\naxiom: F ;(3) F") == [23, 3]


@pytest.mark.parametrize("text", ["colours: symbols\n" + TREE, "axiom: F+F", "axiom: F&F/F", ORGANS])
def test_colours_are_those_of_symbols_where_the_model_says_so_or_shows_kinds_or_nothing_branches(text):
    assert set(colours(text)) == {OWN}


def test_plants_in_space_have_them_by_themselves():
    assert colours(TREE) == colours("colours: natural\n" + TREE)


def test_parts_that_are_drawn_once_and_copied_have_them_too():
    tree = "colours: natural\nangle: 25\naxiom: F\nF -> F[&F]F[^F]F"
    found = colours(tree, 6)
    assert len(found) == 5**6
    assert {*found} == {*range(16, 24)}


def test_a_picture_shows_them():
    svg = draw(read("colours: natural\naxiom: F[+F]"), 0).svg
    assert RAMP[0].lower() in svg.lower()
    assert RAMP[-1].lower() in svg.lower()


def test_the_setting_is_kept_in_what_is_written():
    system = read("colors: natural\naxiom: F")
    assert system.colours == "natural"
    assert read(write(system)).colours == "natural"
    assert "colours" not in write(read("axiom: F[&F]"))
    assert "colours: symbols" in write(read("colours: symbols\naxiom: F[&F]"))


def test_other_colours_are_an_error_that_says_which_there_are():
    with pytest.raises(ModelSyntaxError, match=r'I do not know the kind of colours "pink"'):
        read("colours: pink\naxiom: F")
    with pytest.raises(ModelSyntaxError, match='There is nothing after "colours:"'):
        read("colours:\naxiom: F")


def test_the_farthest_step_that_is_drawn_is_the_end_of_the_ramp():
    assert colours("axiom: F ' F") == [16, 23]
    assert colours("axiom: F ' F ' F ;(3) F") == [16, 20, 23, 3]
    leaf = scene_of(derive(read("axiom: F [' {f+f+f}]"), 0))
    assert (leaf.segments.colours.tolist(), leaf.polygons.colours.tolist()) == ([16], [23])
    assert colours("axiom: F" + " ' F" * 9) == [16, 17, 18, 19, 20, 21, 22, 23, 23, 23]


def test_what_lies_beyond_leaves_is_a_blossom():
    flower = scene_of(derive(read("axiom: F [' {f+f+f} [' F]]"), 0))
    assert (flower.segments.colours.tolist(), flower.polygons.colours.tolist()) == ([16, BLOSSOM], [23])


@pytest.mark.parametrize(("organ", "natural"), [("~leaf", True), ("F", False), ("@O", False)])
def test_stems_of_a_plant_with_several_kinds_are_natural_where_it_has_leaves(organ, natural):
    assert has_natural_colours(read(f"{ORGANS} {organ}")) == natural


@pytest.mark.parametrize(
    ("text", "first"),
    [
        ("axiom: {.G[-G.]G[+G.]}", RAMP_END),
        ("axiom: F{.G[-G.]G[+G.]}", RAMP_START),
        ("colours: symbols\naxiom: {.G[-G.]G[+G.]}", OWN),
    ],
)
def test_veins_of_a_leaf_are_as_green_as_the_leaf_and_no_bark(text, first):
    assert min(colours(text)) == first
