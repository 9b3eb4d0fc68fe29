"""The pipe model: strokes that meet are together as broad, in a power, as the one from which they go on."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import derive, draw, read
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.pipe_model import EXPONENT, SLENDER, TRUNK, strokes_below, tips_borne
from lsys_kit.geometry.turtle.plane import place_path, trace

WORDS = st.recursive(
    st.sampled_from(["F", "F F", "+", "-(20)", "f", "&(30)F", "A"]),
    lambda parts: st.tuples(parts, parts, parts).map(lambda three: f"{three[0]} [{three[1]}] {three[2]}"),
    max_leaves=14,
)
PLANT = read("angle: 25\naxiom: X\nX -> F+[[X]-X]-F[-FX]+X\nF -> FF")


def strokes(text):
    return scene_of(derive(read(f"angle: 37\naxiom: F {text}"), 0)).segments


def tips_along_the_word(text):
    """What each stroke bears, counted module by module, with a stack of brackets."""
    found, axes, below, at_end = [], [], -1, True
    for symbol in text.replace("+", "").split():
        if symbol == "[":
            axes.append((below, at_end))
        elif symbol == "]":
            below, at_end = axes.pop()
        elif symbol[0] == "F":
            found.append((below, len(axes)))
            below = len(found) - 1
    counts = [1] * len(found)
    for mother, order in found:
        if mother >= 0 and found[mother][1] == order:
            counts[mother] = 0
    for number in reversed(range(len(found))):
        if found[number][0] >= 0:
            counts[found[number][0]] += counts[number]
    return counts


@pytest.mark.parametrize("text", ["F", "F F", "F [ F ] F", "F [ F [ F ] F ] [ F ] F", "[ F ] [ F ] F [ [ F ] F ] F"])
def test_a_stroke_bears_as_many_tips_as_axes_end_in_it_and_above(text):
    angled = text.replace("[", "[ +").replace("[ + [ + F", "[ + [ +(77) F").replace("] [ +", "] [ -")
    found = scene_of(derive(read(f"angle: 37\naxiom: {angled}"), 0)).segments
    assert tips_borne(found).tolist() == tips_along_the_word(text)


@pytest.mark.parametrize(
    ("text", "tips"), [("F [F(0)] [F]", [2, 1, 1]), ("F F(0) [F] F", [2, 1, 1, 1]), ("F(0) F(0) F", [1, 1, 1])]
)
def test_what_starts_where_a_stroke_of_no_length_ends_is_borne_by_the_one_below(text, tips):
    assert tips_borne(scene_of(derive(read(f"axiom: {text}"), 0)).segments).tolist() == tips


@given(WORDS)
def test_the_strokes_on_one_are_together_as_broad_as_it(text):
    found = strokes(text)
    tips, below = tips_borne(found), strokes_below(found)
    assert (below < np.arange(len(below))).all()
    for number in range(len(tips)):
        above = below == number
        goes_on = (found.orders[above] == found.orders[number]).any()
        assert tips[number] == tips[above].sum() + (not goes_on)


@given(WORDS)
def test_a_stroke_goes_on_where_the_one_below_it_ends(text):
    found = strokes(text)
    below = strokes_below(found)
    starts, ends = np.split(found.ends, 2, axis=1)
    there = below >= 0
    assert ends[below[there]] == pytest.approx(starts[there], abs=1e-5)


@pytest.mark.parametrize("step", [3, 5])
def test_what_is_drawn_once_and_copied_bears_the_same(step):
    derivation = derive(PLANT, step)
    alone = place_path(trace(derivation[step]), 25).segments
    assert tips_borne(scene_of(derivation).segments).tolist() == tips_borne(alone).tolist()


def test_widths_are_the_power_of_tips_and_the_trunk_is_a_part_of_the_plant():
    picture = draw(PLANT, 4)
    segments = picture.scene.segments
    assert segments.widths.max() == pytest.approx(TRUNK * max(picture.scene.width, picture.scene.height))
    relative = (segments.widths / segments.widths.min()) ** EXPONENT
    assert relative == pytest.approx(tips_borne(segments) / tips_borne(segments).min())


@pytest.mark.parametrize("turn", [90, 30, 8, 2, 0])
def test_the_trunk_of_a_slender_plant_is_slender(turn):
    scene = draw(read(f"angle: {turn}\naxiom: F(9)[+F(6)]F(6)"), 0).scene
    lesser, greatest = sorted((scene.width, scene.height))
    expected = TRUNK * min(greatest, max(SLENDER * lesser, greatest / SLENDER))
    assert scene.segments.widths.max() == pytest.approx(expected)
    assert (expected < TRUNK * greatest) == (turn < 50)


@pytest.mark.parametrize("text", ["axiom: F[+F]!(0.1)F", "axiom: F+F", "axiom: F[+F]\nheading: 90\nF -> F#F"])
def test_a_curve_and_a_plant_with_widths_keep_theirs(text):
    usual, chosen = (draw(read(text), 1, widths=widths).svg for widths in (None, "pipes"))
    assert usual != chosen


def test_a_plant_without_strokes_is_an_empty_picture():
    assert "nothing to draw" in repr(draw(read("axiom: A[B]"), 0))
    assert "nothing to draw" in repr(draw(read("axiom: A[&B]"), 0))


def test_a_pipe_is_as_broad_in_all_pictures_that_stand_together():
    young, old = (each.scene.segments for each in draw(PLANT, steps=[2, 4]).pictures)
    assert young.widths.min() == pytest.approx(old.widths.min())
    assert young.widths.max() < old.widths.max()
    assert "step 0" in draw(read("axiom: A\nA -> F[+A]A"), steps=[0, 1]).svg, "also beside one without strokes"
