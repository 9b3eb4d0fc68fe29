"""The turtle in the plane: laws first, then the seeds' figures."""

import cmath
import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from lsys_kit import ModelLimitError, derive, limits, read, system
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.turtle.plane import place_path, trace


def scene(text, angle=60.0, heading=0.0, notation=None):
    return place_path(trace(derive(read(f"axiom: {text}", notation), 0)[0]), angle, heading)


def plain_turtle(text, angle, heading):
    """The definition, read literally: a position and a direction, and a stack of both (seed 001)."""
    at, way, stack, strokes = 0j, heading, [], []
    for symbol in text:
        if symbol in "Ff":
            to = at + cmath.exp(1j * math.radians(way))
            if symbol == "F":
                strokes.append((at.real, at.imag, to.real, to.imag))
            at = to
        elif symbol in "+-":
            way += angle if symbol == "+" else -angle
        elif symbol == "[":
            stack.append((at, way))
        else:
            at, way = stack.pop()
    return np.array(strokes).reshape(-1, 4)


branched = st.recursive(
    st.text("Ff+-", max_size=8),
    lambda inner: st.lists(st.one_of(inner, inner.map(lambda text: f"[{text}]")), max_size=4).map("".join),
    max_leaves=20,
)


@given(branched, st.floats(0, 180), st.floats(-180, 180))
def test_the_traced_path_is_what_a_plain_turtle_draws(text, angle, heading):
    word = " ".join(text) or "ε"
    if word == "ε":
        return
    expected = plain_turtle(text, angle, heading)
    assert np.allclose(scene(word, angle, heading).segments.ends, expected, atol=1e-9)


@given(branched.filter(bool), st.floats(-360, 360))
def test_turning_the_start_turns_the_picture(text, turn):
    word = " ".join(text)
    straight, turned = scene(word, 25, 0).segments.ends, scene(word, 25, turn).segments.ends
    rotation = cmath.exp(1j * math.radians(turn))
    assert np.allclose(
        straight.view(complex) * rotation if len(straight) else straight,
        turned.view(complex) if len(turned) else turned,
        atol=1e-9,
    )


ONCE_ROUND = [*(f"{symbol}({degrees})" for symbol in "+-/\\&^" for degrees in (0, 360, -360, 720)), "| |", "/(180) \\(180)"]


@given(branched, branched.filter(bool), st.sampled_from(ONCE_ROUND))
@example("F", "+F", "/(360)")
@example("F", "+F", "\\(0)")
def test_a_full_turn_changes_nothing(before, behind, turn):
    texts = " ".join([*before, *behind]), " ".join([*before, turn, *behind])
    plain, turned = (scene(text, 25).segments.ends for text in texts)
    assert np.allclose(plain, turned, atol=1e-9)
    drawn, anyhow = (scene_of(derive(read(f"angle: 25\naxiom: {text}"), 0)).segments.ends for text in texts)
    seen = anyhow if anyhow.shape[1] == 4 else anyhow[:, [0, 2, 3, 5]]  # pitches are made in space
    assert np.allclose(drawn, seen, atol=1e-9)


def test_a_branch_brings_the_turtle_back():
    assert scene("F[+F F[-F]]F").segments.ends[-1].tolist() == pytest.approx([1, 0, 2, 0])


@pytest.mark.parametrize("step", range(5))
def test_the_koch_snowflake_closes(step):
    ends = place_path(trace(derive(system("T2"), step)[-1]), 60, 0).segments.ends
    assert len(ends) == 3 * 4**step
    assert ends[-1, 2:] == pytest.approx([0, 0], abs=1e-9)


def test_the_angle_does_not_enter_the_path():
    path = trace(derive(system("K5"), 3)[-1])
    for angle in (0, 25.7, 90):
        assert len(place_path(path, angle).segments) == 5**3
    assert place_path(path, 0).height == pytest.approx(3**3)


def test_kurths_ru_turns_clockwise_on_the_screen():
    branch = place_path(trace(derive(system("K2"), 2)[-1]), 90).segments.ends[1]
    assert branch[2] > branch[0]
    assert branch[3] > branch[1]


def test_an_argument_gives_the_length_and_the_degrees():
    assert scene("+(90)F(2.5)").segments.ends[0].tolist() == pytest.approx([0, 0, 0, 2.5])
    assert scene("-(90)F").segments.ends[0].tolist() == pytest.approx([0, 0, 0, -1])


def test_both_brackets_of_plant_strings_branch_and_their_strokes_are_thirds():
    ends = scene("I[A](B)I", 45, 90, "plant-string").segments.ends
    lengths = np.hypot(ends[:, 2] - ends[:, 0], ends[:, 3] - ends[:, 1])
    assert lengths.tolist() == pytest.approx([1, 2 / 3, 1 / 3, 1])
    assert ends[1, 2] < 0 < ends[2, 2], "[ ] turns left, ( ) right"
    assert ends[3].tolist() == pytest.approx([0, 1, 0, 2])


def test_a_point_of_the_last_stroke_is_where_the_turtle_stands_before_the_first():
    word = derive(read("turtle: grogra\naxiom: @(0.5) F(4) @(0.25) RU(90) F(1)"), 0)[0]
    assert place_path(trace(word), 90).segments.ends == pytest.approx(np.array([[0, 0, 0, 4], [0, 1, 1, 1]]))


def test_strokes_remember_their_order_and_their_state():
    path = trace(derive(system("K5"), 1)[-1])
    assert path.orders.tolist() == [0, 1, 0, 1, 0]
    assert {derive(system("K5"), 1).states.modules[state].symbol for state in path.states} == {"F"}


def test_too_many_open_brackets_are_an_error():
    word = derive(read(f"axiom: {'[' * 20} F {']' * 20}"), 0)[0]
    with limits(brackets=10), pytest.raises(ModelLimitError, match="More than 10 brackets"):
        trace(word)


def test_a_word_without_strokes_is_an_empty_scene():
    assert str(scene("+ - X")) == "nothing to draw, width 0, height 0"


def test_interpretation_rules_are_drawn_and_leave_the_word():
    word = derive(read("axiom: A(2)\ninterpretation:\nA(t) -> F(t) + F"), 0)[0]
    assert len(place_path(trace(word), 90).segments) == 2
    assert str(word) == "A(2)"
