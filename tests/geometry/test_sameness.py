"""Drawings without arrays: their strokes are those of the scene, and are compared up to position, turn and size."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import derive, read, system, systems
from lsys_kit.derivation.core.traits import traits_of
from lsys_kit.geometry.drawing import drawn_strokes, number_of_strokes, scene_of
from lsys_kit.geometry.sameness import normalised, same_strokes
from lsys_kit.geometry.scene import Stroke
from lsys_kit.geometry.turtle.scanning import LEAST

PLANE, SPACE = "F[+F]F-F[f+F]", "F[&F]/(40)F^F[\\fF]+F"
HOOK = ((0.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 2.0), (0.0, 2.0, 1.0, 2.0))
"""Another one than its mirror image."""


def drawing(text: str) -> list[Stroke]:
    return normalised(drawn_strokes(derive(read(f"angle: 37\naxiom: {text}"), 0)[0]))


def rotated(strokes: list[Stroke], chance: random.Random) -> list[Stroke]:
    """Strokes moved, turned and enlarged, in the plane or in space."""
    dimension = len(strokes[0]) // 2
    axes, _ = np.linalg.qr(np.array([[chance.gauss(0, 1) for _ in range(dimension)] for _ in range(dimension)]))
    axes[0] *= np.sign(np.linalg.det(axes))
    points = np.array(strokes).reshape(-1, dimension) @ axes * chance.uniform(0.1, 9) + chance.uniform(-9, 9)
    return normalised([tuple(row) for row in points.reshape(-1, 2 * dimension).tolist()])


chances = st.integers(0, 2**32).map(random.Random)


def words(symbols: str) -> st.SearchStrategy[str]:
    return st.lists(st.sampled_from(symbols.split()), min_size=1, max_size=30).map(lambda word: " ".join(("F", *word)))


@pytest.mark.slow
@pytest.mark.parametrize("id", systems())
def test_the_strokes_are_those_of_the_scene(id: str) -> None:
    given = system(id)
    if traits_of(given).sensitive:
        return
    derivation = derive(given, min(given.steps or 4, 4))
    found, ends = drawn_strokes(derivation[-1]), scene_of(derivation[-1]).segments.ends
    assert np.allclose(np.array(found).reshape(-1, ends.shape[1]), ends, atol=1e-9)
    if "@Gc" not in str(given):
        assert number_of_strokes(derivation, derivation.steps) == len(ends)


def test_the_strokes_of_words_that_are_scanned_are_those_of_the_scene() -> None:
    derivation = derive(read("angle: 22.5\naxiom: F\nF -> F[+F]F[-F]F"), 5)
    assert len(derivation[5]) > LEAST
    assert np.allclose(drawn_strokes(derivation[5]), scene_of(derivation[5]).segments.ends, atol=1e-9)


@given(st.one_of(words("F f + - [+F] [-fF]"), words("F f + & / [^F] [\\fF]")), chances)
def test_what_is_moved_turned_and_enlarged_is_the_same(word: str, chance: random.Random) -> None:
    mine = drawing(word)
    assert same_strokes(rotated(mine, chance), mine)


@given(words("F f + - [+F] [-fF]"), chances)
def test_order_and_direction_of_strokes_in_the_plane_do_not_count(word: str, chance: random.Random) -> None:
    mine = drawing(word)
    other = [each if chance.random() < 0.5 else each[2:] + each[:2] for each in mine]
    chance.shuffle(other)
    assert same_strokes(other, mine)
    assert same_strokes(other, mine, turned=False)


@given(st.one_of(words("F f + - [+F] [-fF]"), words("F f + & / [^F] [\\fF]")), chances)
def test_a_stroke_that_is_moved_is_seen(word: str, chance: random.Random) -> None:
    mine = drawing(word)
    number = chance.randrange(len(mine))
    moved = [tuple(at + 0.01 * (which == number) for at in stroke) for which, stroke in enumerate(mine)]
    assert not same_strokes(moved, mine, turned=False)


def test_a_mirror_image_is_another_drawing_and_in_space_one_that_lies_in_a_plane_is_not() -> None:
    mine = normalised(HOOK)
    mirrored = [(-x, y, -u, v) for x, y, u, v in mine]
    assert not same_strokes(mirrored, mine)
    flat, turned = ([(x, y, 0.0, u, v, 0.0) for x, y, u, v in strokes] for strokes in (mine, mirrored))
    assert same_strokes(turned, flat)
    deep = drawing(SPACE)
    assert not same_strokes([(-x, y, z, -u, v, w) for x, y, z, u, v, w in deep], deep)


def test_a_turn_counts_where_it_is_said() -> None:
    mine = normalised(HOOK)
    quarter = [(-y, x, -v, u) for x, y, u, v in mine]
    assert same_strokes(quarter, mine)
    assert not same_strokes(quarter, mine, turned=False)


def test_how_often_a_stroke_is_drawn_counts() -> None:
    one, other = ([HOOK[which] for which in numbers] for numbers in ((0, 0, 1), (0, 1, 1)))
    assert not same_strokes(one, other)
    assert same_strokes(one, one[::-1])


def test_drawings_without_size_and_on_one_line_are_compared_too() -> None:
    assert same_strokes([], [])
    assert not same_strokes([], normalised(HOOK))
    assert not same_strokes(drawing("FF&F"), drawing("FF+F"))
    dot, line = normalised([(0.0,) * 6] * 2), normalised([(0.0, 0.0, 0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 0.0, 0.0, 3.0)])
    assert same_strokes(dot, dot)
    assert not same_strokes(dot, line)
    assert not same_strokes(line, dot)
    along = [(z, x, y, w, u, v) for x, y, z, u, v, w in line]
    assert same_strokes(along, line)
    bent = normalised([(0.0, 0.0, 0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 0.0, 2 * math.sin(0.1), 1 + 2 * math.cos(0.1))])
    assert not same_strokes(bent, line)
    assert not same_strokes(line, bent)
