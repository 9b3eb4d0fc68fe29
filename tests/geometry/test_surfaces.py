"""Surfaces: leaves, petals, buds and flowers as faces in the turtle's axes, and those that a model declares."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from lsys_kit import derive, draw, read
from lsys_kit.geometry.scene import Scene, no_segments
from lsys_kit.geometry.smoothing import smoothed
from lsys_kit.geometry.turtle.plane import place_path, trace
from lsys_kit.geometry.turtle.space import SpaceTurtle, initial_frame, trace_in_space
from lsys_kit.geometry.turtle.surfaces import Surface, passed_over, patch_grid, revolved_facets, surfaces, surfaces_by_symbol
from lsys_kit.geometry.turtle.turtle import collected_shapes
from lsys_kit.notation.model.system import LSystem


def in_space(text, notation=None):
    return trace_in_space(derive(read(text, notation), 0)[0])


def in_the_plane(text, notation=None):
    word = derive(read(text, notation), 0)[0]
    return place_path(trace(word), float(word.states.system.angle))


@pytest.mark.parametrize("surface", surfaces().values(), ids=list(surfaces()))
def test_a_surface_touches_the_plant_and_is_about_one_long(surface):
    corners = np.array([corner for face in surface.facets.faces for corner in face])
    assert (corners == 0).all(axis=1).any()
    assert 0.9 <= np.hypot.reduce(corners, axis=1).max() <= 1.1


@pytest.mark.parametrize("surface", surfaces().values(), ids=list(surfaces()))
def test_faces_are_nearly_plane_and_their_normals_are_those_of_the_surface(surface):
    assert len(surface.facets.normals) == len(surface.facets.faces)
    for face, normals in zip(surface.facets.faces, surface.facets.normals, strict=True):
        corners = np.array(face)
        assert np.linalg.svd(corners - corners.mean(axis=0))[1][2] < 0.02
        assert np.hypot.reduce(normals, axis=1) == pytest.approx(np.ones(len(face)), abs=1e-3)
        own = np.sum([np.cross(b - corners[0], c - corners[0]) for b, c in pairwise(corners[1:])], axis=0)
        assert (np.array(normals) @ own > 0.5 * np.linalg.norm(own)).mean() > 0.5


@pytest.mark.parametrize("surface", surfaces().values(), ids=list(surfaces()))
def test_a_surface_is_the_same_on_both_sides(surface):
    faces = {
        frozenset((round(ahead, 2), round(left, 2), round(up, 2)) for ahead, left, up in face) for face in surface.facets.faces
    }
    mirrored = "left" if surface.name in ("leaf", "needle", "petal", "sepal", "rosette") else "up"
    flip = {"left": lambda a, left, u: (a, -left, u), "up": lambda a, left, u: (a, left, -u)}[mirrored]
    assert {frozenset(flip(*corner) for corner in face) for face in faces} == faces


@pytest.mark.parametrize("name", ["bud", "fruit"])
def test_a_solid_is_closed_and_its_faces_look_outwards(name):
    faces = surfaces()[name].facets.faces
    edges = [edge for face in faces for edge in zip(face, (*face[1:], face[0]), strict=True)]
    assert sorted(edges) == sorted((b, a) for a, b in edges)
    volume = sum(np.linalg.det([face[0], b, c]) for face in faces for b, c in pairwise(face[1:])) / 6
    assert volume > 0.04


def test_the_petals_of_a_flower_are_hollow_towards_its_axis():
    outlines = surfaces()["flower"].facets.outlines
    for left, right in zip(outlines[::2], outlines[1::2], strict=True):
        midrib = np.array(max(set(left) & set(right), key=np.linalg.norm))
        edges = np.mean(
            [
                max(half, key=lambda corner, other=other: min(np.hypot.reduce(np.array(other) - corner, axis=1)))
                for half, other in ((left, right), (right, left))
            ],
            axis=0,
        )
        outward = np.array([0, *midrib[1:]])
        assert edges @ outward / (edges @ midrib) < midrib @ outward / (midrib @ midrib)


def test_each_symbol_stands_for_one_surface():
    symbols = [symbol for surface in surfaces().values() for symbol in surface.symbols]
    assert len(symbols) == len(set(symbols))
    assert [surfaces_by_symbol(LSystem((), ()))[symbol].name for symbol in "LPBK"] == ["leaf", "petal", "bud", "flower"]


def test_a_leaf_stands_in_the_turtles_axes_and_is_as_long_as_its_number():
    leaf = in_space("axiom: f &(90) ~L(2)").polygons
    least, greatest = leaf.points.min(axis=0), leaf.points.max(axis=0)
    # wide to the left and right, long away from the viewer
    assert greatest - least == pytest.approx([0.836, 2, 0.310], abs=1e-3)
    assert least[1] == pytest.approx(0, abs=1e-9), "its base is where the turtle is"
    tip = leaf.points[leaf.points[:, 1].argmax()]
    assert tip == pytest.approx([0, 2, least[2]], abs=1e-9), "its tip hangs"
    assert greatest[2] > 1, "its edges are bent upwards"


def test_without_a_number_a_surface_is_as_long_as_the_step():
    assert in_space("length: 5\naxiom: ~L").height == pytest.approx(5)


def test_a_surface_of_size_nothing_is_not_drawn():
    assert len(in_space("axiom: ~L(0)").polygons) == 0


def test_only_the_symbol_behind_a_tilde_is_a_surface():
    scene = in_space("axiom: F L(2) & ~L(1) K(3) ~K(2) F")
    assert len(scene.polygons) == len(surfaces()["leaf"].facets.faces) + len(surfaces()["flower"].facets.faces)
    assert len(scene.segments) == 2


def test_a_surface_that_nobody_knows_is_listed_once():
    scene = in_space("axiom: F & ~X(2) L ~X(3) [~ L]")
    assert scene.unknown == ("~X",)
    assert len(scene.polygons) == len(surfaces()["leaf"].facets.faces)


@pytest.mark.parametrize(
    ("word", "said"),
    [
        (
            "F ~X(2) ~l ~X",
            "no surface is called X or l: there are L (leaf), needle, P (petal), sepal, B (bud), K (flower), rosette, fruit; "
            "a model declares others",
        ),
        ("F RH ~ Leaf", "passed over, without a meaning here: RH; no surface is called Leaf: there are L (leaf)"),
        ("F ~", "passed over, because no surface is named after it: ~"),
        ("F ~L ~rosette(2)", ""),
    ],
)
@pytest.mark.parametrize("more", ["", "&(30)F"])
def test_what_is_no_surface_is_said_with_those_that_there_are(word, said, more):
    text = f"axiom: {more} {word}"
    scene = in_space(text) if more else in_the_plane(text)
    assert passed_over(scene.unknown).startswith(said)
    assert bool(scene.unknown) == bool(said)
    assert repr(draw(derive(read(text), 0))).endswith(passed_over(scene.unknown))


def test_in_the_plane_a_surface_is_flat():
    text = "angle: 40\naxiom: F + ~L(2) - F ~K(1) [- f ~B(3)] /(180) ~L(1) + ~K(2)"
    flat, whole = in_the_plane(text).polygons, in_space(text).polygons
    assert flat.points == pytest.approx(whole.points[:, [0, 2]])
    assert (flat.starts == whole.starts).all()
    assert len(flat) == sum(len(surfaces()[name].facets.outlines) for name in ("leaf", "flower", "bud", "leaf", "flower"))
    assert not flat.smooth.any()


def test_leaves_and_flowers_of_plant_strings_stand_where_the_turtle_is():
    scene = in_the_plane("axiom: I[L](L)F", "plant-string")
    leaf, flower = surfaces()["leaf"], surfaces()["rosette"]
    assert len(scene.polygons) == 2 * len(leaf.facets.outlines) + len(flower.facets.outlines)
    assert len(scene.segments) == 1
    assert all(np.hypot(*(face - (0, 1)).T).max() <= 0.51 for face in scene.polygons)
    assert scene.width > 0
    assert scene.unknown == ()


PATCH = " ".join(f"({row}/3, {column}/3, {row * column}/90)" for row in range(4) for column in range(4))
DECLARED = f"surface L: (0, 0) (1, 0.5) (1, -0.5, 0.25)\nsurface wing: patch {PATCH}\n"


def test_a_surface_that_a_model_declares_is_drawn_instead_of_the_kits():
    scene = in_space(f"{DECLARED}axiom: f &(90) ~L(2)")
    assert scene.polygons.points == pytest.approx(np.array([[0, 0, 1], [-1, 2, 1], [1, 2, 1.5]]))
    assert not scene.polygons.smooth.any()
    assert surfaces_by_symbol(read("axiom: A"))["L"].name == "leaf", "other models have the kit's"


def test_a_patch_is_drawn_as_the_surface_of_its_control_points():
    """That of this one is the saddle up = ahead * left / 10, as its control points lie on it in even rows and columns."""
    polygons = in_space(f"{DECLARED}axiom: &(90) ~wing").polygons
    left, ahead, up = (polygons.points * [-1, 1, 1]).T
    assert up == pytest.approx(ahead * left / 10, abs=1e-4)
    assert {0.0, 1.0} <= set(ahead.round(4)) & set(left.round(4))
    gradient = np.stack([ahead / 10, -left / 10, np.ones(len(up))], axis=1)  # x is to the right, y ahead, z up
    assert polygons.normals == pytest.approx(gradient / np.linalg.norm(gradient, axis=1, keepdims=True), abs=2e-3)
    assert len(in_the_plane(f"{DECLARED}axiom: ~wing").polygons) == 1


def test_a_patch_that_is_a_point_faces_upwards():
    points, normals = map(np.array, patch_grid(4 * [4 * [(2.0, 2.0, 2.0)]], 1, 1))
    assert (points == 2).all()
    assert (normals == [0, 0, 1]).all()


def test_a_declared_surface_keeps_its_name_whole():
    system = read(f"{DECLARED}axiom: w i n g ~wing(2)")
    assert [module.symbol for module in system.axiom] == ["w", "i", "n", "g", "~", "wing"]
    assert read(str(system)) == system


def test_of_many_surfaces_the_outlines_are_drawn():
    few, many = (in_space("axiom: &(1)" + "[f(9)~L]" * number).polygons for number in (150, 151))
    assert len(few) == 150 * len(surfaces()["leaf"].facets.faces)
    assert len(many) == 151 * len(surfaces()["leaf"].facets.outlines)
    assert not many.smooth.any()


def test_a_few_curved_faces_become_finer_and_lie_nearer_to_the_surface():
    flat_and_round = in_space("axiom: {f+f+f}~fruit &(1)")
    fine = smoothed(flat_and_round).polygons
    assert len(fine) == 1 + 9 * 96
    assert (fine.points[:3] == flat_and_round.polygons.points[:3]).all(), "what is flat stays as it is"
    assert len(smoothed(in_space("axiom: &(1)" + "~fruit" * 5)).polygons) == 5 * 96
    ball = revolved_facets([(-1, 0), (-1, 4 / 3), (1, 4 / 3), (1, 0)], 8, 4)
    turtle = SpaceTurtle(initial_frame("abop"), 1.0)
    turtle.draw_surface(Surface("ball", (), lambda: ball), 1.0)
    rough = Scene(no_segments(3), polygons=collected_shapes(turtle.outlines, (), np.array)[0])
    errors = []
    for polygons in (rough.polygons, smoothed(rough).polygons):
        middles = np.array([corners.mean(axis=0) for corners in polygons])
        errors.append(abs(np.linalg.norm(middles[abs(middles[:, 2]) < 0.7], axis=1) - 1).max())
    assert errors[1] < errors[0] / 3
