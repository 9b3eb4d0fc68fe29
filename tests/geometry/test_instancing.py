"""What is drawn at once is what the turtle draws module by module."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from lsys_kit import derive, limits, read
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle import instancing
from lsys_kit.geometry.turtle.commands import in_plane
from lsys_kit.geometry.turtle.instancing import draw_instanced
from lsys_kit.geometry.turtle.plane import place_path, trace
from lsys_kit.geometry.turtle.space import trace_in_space
from lsys_kit.notation.model.system import LSystem

PLANE = (
    "F",
    "f",
    "+",
    "-",
    "F(2)",
    "+(33)",
    "|",
    "!(2)",
    ";",
    "A",
    "B",
    "@o",
    "@c(3)",
    "@D(2)",
    "@Di(0.5)",
    "@B(3,2)",
    "[+A]",
    "[F-B]",
)
SPACE = (*PLANE, "&", "^(20)", "/", "\\(70)", "[&A]", "@O(2)")
SYSTEM = "axiom: {}\nA -> {}\nB -> {}\nF -> {}"


def words(of: tuple[str, ...]) -> st.SearchStrategy[str]:
    return st.lists(st.sampled_from(of), min_size=1, max_size=5).map(" ".join)


def agree(one: Scene, other: Scene) -> None:
    """Two scenes are the same, to a billionth of their extent."""
    extent = max(1.0, *np.ptp(np.array(other.corners), axis=0))
    for ours, theirs in (
        (one.segments.ends, other.segments.ends),
        (one.polygons.points, other.polygons.points),
        (one.discs.centres, other.discs.centres),
    ):
        assert ours.shape == theirs.shape
        assert np.abs(ours - theirs).max(initial=0) <= 1e-9 * extent
    for ours, theirs in ((one.segments, other.segments), (one.polygons, other.polygons), (one.discs, other.discs)):
        for field in ("orders", "states", "widths", "colours", "radii", "kinds", "starts"):
            if hasattr(ours, field) and len(ours):
                size = len(ours) + (field == "starts")
                found, expected = (np.broadcast_to(getattr(shapes, field), size) for shapes in (ours, theirs))
                assert np.array_equal(found, expected)
    assert one.unknown == other.unknown


def draw_all_instanced(system: LSystem, steps: int) -> Scene | None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(instancing, "LEAST_REPETITION", 0)
        return draw_instanced(derive(system, steps), steps, float(system.angle))


@given(words(PLANE), words(PLANE), words(PLANE), words(PLANE), st.sampled_from((90, 60, 25.7)), st.integers(0, 4))
def test_in_the_plane(axiom: str, a: str, b: str, f: str, angle: float, steps: int) -> None:
    system = read(f"angle: {angle}\n" + SYSTEM.format(axiom, a, b, f))
    with limits(modules=1_000_000):
        assume(max(derive(system, 4).lengths) < 3_000)
    assert in_plane(system)
    found = draw_all_instanced(system, steps)
    assert found is not None
    assert found.dimension == 2
    agree(found, place_path(trace(derive(system, steps)[-1]), float(system.angle), float(system.heading)))


@given(words(SPACE), words(SPACE), words(SPACE), words(SPACE), st.integers(0, 4))
def test_in_space(axiom: str, a: str, b: str, f: str, steps: int) -> None:
    system = read("angle: 22.5\n" + SYSTEM.format(axiom + " &", a, b, f))
    with limits(modules=1_000_000):
        assume(max(derive(system, 4).lengths) < 3_000)
    found = draw_all_instanced(system, steps)
    assert found is not None
    assert found.dimension == 3
    agree(found, trace_in_space(derive(system, steps)[-1]))


def test_a_step_that_shrinks_goes_with_the_turtle() -> None:
    """K6: a -> L*0.5 [ RU90 F ] F RH180 a halves the step; the branches of the drawing differ in nothing else."""
    system = read("* # F a,\na # L*0.5 [ RU90 F ] F RH180 a", "grogra")
    found = draw_all_instanced(system, 8)
    assert found is not None
    agree(found, place_path(trace(derive(system, 8)[-1]), float(system.angle), float(system.heading)))
    assert found.height == pytest.approx(200, abs=1)


@pytest.mark.parametrize("text", ["axiom: F $ F", "axiom: {F+F+F}", "axiom: F @L(1) F", "axiom: A F\nF < A -> F"])
def test_what_asks_for_more_goes_module_by_module(text: str) -> None:
    assert draw_all_instanced(read(text), 1) is None


def test_a_branch_is_what_the_turtle_takes_for_one() -> None:
    """Round brackets are branches to the derivation of a plant string, but ABOP's turtle passes them over."""
    system = read("turtle: abop\nAxiom: F\nF -> F(+F)F", "plant-string")
    found = draw_all_instanced(system, 3)
    assert found is not None
    agree(found, place_path(trace(derive(system, 3)[-1]), float(system.angle), float(system.heading)))


def test_interpretation_rules_are_drawn() -> None:
    system = read("angle: 30\naxiom: A(1)\nA(t) -> A(t+1) [+A(t)]\ninterpretation:\nA(t) -> F(t) [-F] @o")
    found = draw_all_instanced(system, 5)
    assert found is not None
    agree(found, place_path(trace(derive(system, 5)[-1]), 30))


@pytest.mark.slow
def test_many_steps_are_no_deep_recursion() -> None:
    system = read("axiom: A\nA -> F A")
    found = draw_all_instanced(system, 3_000)
    assert found is not None
    assert (len(found.segments), found.height) == (3_000, 3_000)
