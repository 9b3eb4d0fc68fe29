"""The scale of the turtle: `@D`, `@Di` and `@Dd`."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import read
from lsys_kit.geometry.scene import OWN
from lsys_kit.geometry.turtle.commands import in_plane
from lsys_kit.geometry.turtle.plane import place_path, trace
from lsys_kit.geometry.turtle.space import trace_in_space
from tests.geometry.test_space import SHAPES, STROKES, TURNS, branched, command, drawn, extent, lengths, same, word_of

CYLINDERS = st.sampled_from([("@Gs",), ("@Gc",), ("@Ge",)])
LOOKS = command("#!") | command("#!", lengths) | command(";,'")
FLAT = branched(STROKES["abop"] | SHAPES["abop"] | LOOKS)
FREE = branched(STROKES["abop"] | SHAPES["abop"] | LOOKS | TURNS["abop"] | CYLINDERS)
FACTORS = st.sampled_from((0.25, 0.5, 2, 3, 10))


def flat_drawing(modules):
    word = word_of(modules)
    assert in_plane(word.states.system)
    return place_path(trace(word), 90)


@given(st.sampled_from((flat_drawing, lambda modules: trace_in_space(word_of(modules)))), st.data(), FACTORS)
def test_what_is_drawn_at_a_scale_is_so_many_times_as_large(drawing, data, factor):
    modules = data.draw(FLAT if drawing is flat_drawing else FREE)
    leaf = [("~",), ("L",), ("f",), ("~",), ("L", 2)]
    plain, scaled = (drawing([*first, *modules, *leaf]) for first in ([], [("@D", factor)]))
    near = 1e-9 * factor * extent(plain)
    for found, expected in (
        (scaled.segments.ends, plain.segments.ends),
        (scaled.polygons.points, plain.polygons.points),
        (scaled.discs.centres, plain.discs.centres),
        (scaled.discs.radii, plain.discs.radii),
    ):
        assert found == pytest.approx(factor * expected, rel=0, abs=near)
    widths = plain.segments.widths
    assert scaled.segments.widths == pytest.approx(np.where(widths == OWN, OWN, factor * widths))
    assert (scaled.segments.colours == plain.segments.colours).all()
    assert scaled.polygons.normals == pytest.approx(plain.polygons.normals)


@given(FREE, FACTORS, st.data())
def test_scales_that_leave_it_as_it_is_change_nothing(modules, factor, data):
    at = data.draw(st.integers(0, len(modules)))
    nothing = data.draw(
        st.sampled_from(
            (
                [("@D",)],
                [("@D", 1)],
                [("@Di",)],
                [("@Dd", 1)],
                [("@Di", factor), ("@Dd", factor)],
                [("[",), ("@D", factor), ("]",)],
                [("@D", factor), ("@D",)],
            )
        )
    )
    assert same(*(trace_in_space(word_of(word)) for word in (modules, [*modules[:at], *nothing, *modules[at:]])))


def test_a_scale_multiplies_lengths_and_widths_that_are_given_and_a_branch_ends_it():
    segments = drawn("F @D(2) F F(3) [ @Di(3) F !(2) F ] F @Dd(4) F @D F").segments
    assert segments.ends[:, 5].tolist() == [1, 3, 9, 15, 21, 11, 11.5, 12.5]
    assert segments.widths.tolist() == [OWN] * 4 + [12] + [OWN] * 3


def test_a_place_that_is_given_stays_where_it_is():
    assert drawn("@D(3) @M(1,2,0) F").segments.ends[0].tolist() == [1, 0, 2, 1, 0, 5]


def test_a_negative_scale_is_none():
    assert drawn("@D(-1) F @O(2)").discs.radii.tolist() == [0]


@pytest.mark.parametrize("notation", ["abop", "cpfg"])
def test_scales_are_symbols(notation):
    head = "Lsystem: 1\n" if notation == "cpfg" else ""
    found = read(f"{head}{'Axiom' if head else 'axiom'}: @D(2)@Di@Dd(2)F", notation).axiom
    assert [module.symbol for module in found] == ["@D", "@Di", "@Dd", "F"]
