"""Surfaces: leaves, petals, buds and flowers as plane faces in the turtle's axes."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from lsys_kit import derive, draw, read
from lsys_kit.geometry.turtle.plane import place_path, trace
from lsys_kit.geometry.turtle.space import trace_in_space
from lsys_kit.geometry.turtle.surfaces import passed_over, surface_called, surfaces


def in_space(text, notation=None):
    return trace_in_space(derive(read(text, notation), 0)[0])


def in_the_plane(text, notation=None):
    word = derive(read(text, notation), 0)[0]
    return place_path(trace(word), float(word.states.system.angle))


@pytest.mark.parametrize("surface", surfaces().values(), ids=list(surfaces()))
def test_a_surface_touches_the_plant_and_is_about_one_long(surface):
    corners = np.array([corner for face in surface.faces for corner in face])
    assert (corners == 0).all(axis=1).any()
    assert 0.9 <= np.hypot.reduce(corners, axis=1).max() <= 1.1


@pytest.mark.parametrize("surface", surfaces().values(), ids=list(surfaces()))
def test_faces_are_plane(surface):
    for face in surface.faces:
        assert np.linalg.svd(np.array(face) - np.mean(face, axis=0))[1][2] < 2e-3


@pytest.mark.parametrize("surface", surfaces().values(), ids=list(surfaces()))
def test_a_surface_is_the_same_on_both_sides(surface):
    faces = {frozenset((round(ahead, 2), round(left, 2), round(up, 2)) for ahead, left, up in face) for face in surface.faces}
    mirrored = "left" if surface.name in ("leaf", "needle", "petal", "sepal", "rosette") else "up"
    flip = {"left": lambda a, left, u: (a, -left, u), "up": lambda a, left, u: (a, left, -u)}[mirrored]
    assert {frozenset(flip(*corner) for corner in face) for face in faces} == faces


@pytest.mark.parametrize("name", ["bud", "fruit"])
def test_a_solid_is_closed_and_its_faces_look_outwards(name):
    faces = surfaces()[name].faces
    edges = [edge for face in faces for edge in zip(face, (*face[1:], face[0]), strict=True)]
    assert sorted(edges) == sorted((b, a) for a, b in edges)
    volume = sum(np.linalg.det([face[0], b, c]) for face in faces for b, c in pairwise(face[1:])) / 6
    assert volume > 0.04


def test_the_petals_of_a_flower_are_hollow_towards_its_axis():
    for left, right in zip(surfaces()["flower"].faces[::2], surfaces()["flower"].faces[1::2], strict=True):
        midrib, edges = np.array(left[-1]), (np.array(left[4]) + right[4]) / 2
        outward = np.array([0, *midrib[1:]])
        assert edges @ outward / (edges @ midrib) < midrib @ outward / (midrib @ midrib)


def test_each_symbol_stands_for_one_surface():
    symbols = [symbol for surface in surfaces().values() for symbol in surface.symbols]
    assert len(symbols) == len(set(symbols))
    assert [surface_called(symbol).name for symbol in "LPBK"] == ["leaf", "petal", "bud", "flower"]


def test_a_leaf_stands_in_the_turtles_axes_and_is_as_long_as_its_number():
    leaf = in_space("axiom: f &(90) ~L(2)").polygons
    least, greatest = leaf.points.min(axis=0), leaf.points.max(axis=0)
    # wide to the left and right, long away from the viewer
    assert greatest - least == pytest.approx([0.765, 2, 0.117], abs=1e-3)
    assert least[1:] == pytest.approx([0, 1], abs=1e-9), "its base is where the turtle is, its edges are bent upwards"


def test_without_a_number_a_surface_is_as_long_as_the_step():
    assert in_space("length: 5\naxiom: ~L").height == pytest.approx(5)


def test_a_surface_of_size_nothing_is_not_drawn():
    assert len(in_space("axiom: ~L(0)").polygons) == 0


def test_only_the_symbol_behind_a_tilde_is_a_surface():
    scene = in_space("axiom: F L(2) ~L(1) K(3) ~K(2) F")
    assert len(scene.polygons) == len(surfaces()["leaf"].faces) + len(surfaces()["flower"].faces)
    assert len(scene.segments) == 2


def test_a_surface_that_nobody_knows_is_listed_once():
    scene = in_space("axiom: F ~X(2) L ~X(3) [~ L]")
    assert scene.unknown == ("~X",)
    assert len(scene.polygons) == len(surfaces()["leaf"].faces)


@pytest.mark.parametrize(("word", "said"), [
    ("F ~X(2) ~l ~X",
     "no surface is called X or l: there are L (leaf), needle, P (petal), sepal, B (bud), K (flower), rosette, fruit"),
    ("F RH ~ Leaf", "passed over, without a meaning here: RH; no surface is called Leaf: there are L (leaf)"),
    ("F ~", "passed over, because no surface is named after it: ~"), ("F ~L ~rosette(2)", ""),
])
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


def test_leaves_and_flowers_of_plant_strings_stand_where_the_turtle_is():
    scene = in_the_plane("axiom: I[L](L)F", "plant-string")
    leaf, flower = surfaces()["leaf"], surfaces()["rosette"]
    assert len(scene.polygons) == 2 * len(leaf.faces) + len(flower.faces)
    assert len(scene.segments) == 1
    assert all(np.hypot(*(face - (0, 1)).T).max() <= 0.51 for face in scene.polygons)
    assert scene.width > 0
    assert scene.unknown == ()
