"""Between two steps every module becomes its successor in place, and the drawing with it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import derive, read
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.turtle.unfolding import words_between

COMMANDS = st.lists(
    st.sampled_from(["F", "f", "+", "-", "+(10)", "F(2)", "A", "[F]", "[+A]", "[-FA]", "F(0.5)", "&(20)", "/(90)", "!(0.2)"]),
    max_size=6,
).map("".join)


def system_with(axiom, *successors):
    rules = "\n".join(f"{symbol} -> {successor or 'ε'}" for symbol, successor in zip("FA+", successors, strict=True))
    return read(f"angle: 40\naxiom: {axiom or 'F'}\n{rules}")


def drawn(scene):
    """The strokes of some length, and how long all are together."""
    ends = scene.segments.ends
    half = ends.shape[1] // 2
    lengths = np.linalg.norm(ends[:, half:] - ends[:, :half], axis=1)
    return ends[lengths > 1e-12], float(lengths.sum())


def room(scene):
    """The bounding box of the strokes of some length."""
    points = drawn(scene)[0].reshape(-1, scene.dimension)
    return [*points.min(axis=0), *points.max(axis=0)] if len(points) else []


@given(COMMANDS, COMMANDS, COMMANDS, COMMANDS, st.integers(0, 2))
def test_it_begins_with_a_step_and_ends_with_the_next(axiom, f, a, plus, step):
    derivation = derive(system_with(axiom, f, a, plus), step + 1)
    between = words_between(derivation, step)
    begun, before, done, after = (
        scene_of(word) for word in (between(0.0), derivation[step], between(1.0), derivation[step + 1])
    )
    assert drawn(begun)[1] == pytest.approx(drawn(before)[1], abs=1e-9)
    assert room(begun) == pytest.approx(room(before), abs=1e-9)
    assert drawn(done)[0] == pytest.approx(drawn(after)[0], abs=1e-9)


@given(COMMANDS, COMMANDS, COMMANDS, st.floats(0.01, 0.45))
def test_nothing_jumps_on_the_way(axiom, f, a, part):
    between = words_between(derive(system_with(axiom, f, a, "+"), 2), 1)
    one, other = (scene_of(between(at)).segments.ends for at in (part, part + 1e-9))
    assert one.shape == other.shape
    assert np.abs(one - other).max(initial=0) < 1e-5


def test_the_strokes_of_a_branch_grow_out_of_their_fork():
    between = words_between(derive(read("angle: 90\naxiom: F\nF -> F[+F]F"), 1), 0)
    scene = scene_of(between(0.5))
    assert scene.segments.ends.round(6).tolist() == [[0, 0, 0, 0.75], [0, 0.75, -0.353553, 1.103553], [0, 0.75, 0, 1.5]]


def test_modules_that_are_replaced_together_become_what_they_become_together():
    derivation = derive(read("axiom: F\nF -> F F"), 3)
    assert [len(words_between(derivation, step)(0.5).numbers()) for step in range(3)] == [2, 4, 8]
