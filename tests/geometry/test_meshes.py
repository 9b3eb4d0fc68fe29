"""Meshes: closed, facing outwards, as large as the scene, and made all at once."""

import math
import time
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import ModelLimitError, derive, draw, limits, read, system
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.meshes import mesh_of
from lsys_kit.geometry.solids import SIDES
from lsys_kit.geometry.triangulation import triangulate

BUSH = """angle: 22.5
axiom: A
A -> [&F L A] /(120) [&F L A] /(120) [&F L A]
interpretation:
L -> [@O(0.1)^(60){-f+f+f-|-f+f+f}]"""


def scene(text, n=0):
    return scene_of(derive(read(text), n))


def mesh(text, n=0):
    return mesh_of(scene(text, n))


def areas(mesh):
    """Of each triangle the vector that is as long as its area and points where it faces."""
    corners = mesh.vertices.astype(float)[mesh.triangles]
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2


def volume(mesh):
    corners = mesh.vertices.astype(float)[mesh.triangles]
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))) / 6


def prism(radius):
    """The area of a stroke's end."""
    return SIDES / 2 * math.sin(2 * math.pi / SIDES) * radius ** 2


WAYS = st.text("+-&^/\\|", min_size=0, max_size=12)


@given(WAYS, st.floats(0.5, 3))
def test_a_stroke_is_closed_wherever_it_goes(ways, width):
    stroke = mesh(f"angle: 33\naxiom: {ways}!({width:.3f})F(7)&(0)")
    edges = stroke.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).tolist()
    assert sorted(edges) == sorted([b, a] for a, b in edges)
    assert volume(stroke) == pytest.approx(7 * prism(round(width, 3) / 2), rel=1e-5)


@pytest.mark.parametrize("text", ["axiom: F", "axiom: @O(3)", "axiom: &@c(3)", "axiom: {F&F-F+F}", BUSH])
def test_triangles_face_where_their_normals_do(text):
    made = mesh(text, 2)
    along = np.einsum("ij,ij->i", areas(made), made.normals[made.triangles].mean(axis=1))
    assert along.min() > -1e-7  # at the ends of strokes, which share their vertices with the sides, it is 0
    assert np.linalg.norm(made.normals, axis=1) == pytest.approx(1, abs=1e-6)


def test_a_mesh_is_as_large_as_its_scene():
    drawn = scene(BUSH, 4)
    for mine, its in zip(mesh_of(drawn).corners, drawn.corners, strict=True):
        assert mine == pytest.approx(its, abs=0.05)


def test_each_vertex_knows_its_module():
    made = mesh("axiom: F(2);(3)G(2)")
    assert [made.states[0], made.states[-1], made.colours[0], made.colours[-1]] == [0, 2, -1, 3]


def test_a_stroke_runs_from_the_width_of_the_one_before():
    made = mesh("axiom: !(2)F!(1)F&(0)")
    assert volume(made) == pytest.approx(prism(1) + (prism(1) + prism(0.5) + math.sqrt(prism(1) * prism(0.5))) / 3)


def test_a_branch_does_not_begin_as_wide_as_its_stem():
    assert volume(mesh("axiom: !(2)F[&(90)!(1)F]")) == pytest.approx(prism(1) + prism(0.5))


def test_strokes_of_no_length_are_left_out():
    assert len(mesh("axiom: F(0)&F").triangles) == len(mesh("axiom: &F").triangles)


def test_what_lies_in_the_plane_is_set_upright():
    made = mesh("axiom: {F(3)-F(4)-F(3)}")
    flat = made.vertices[-3:]
    assert flat.tolist() == [pytest.approx(corner) for corner in ((0, 0, 3), (4, 0, 3), (4, 0, 0))]


def test_cells_are_spheres_made_longer():
    made = mesh_of(draw(system("J1"), 4).scene)
    assert made.corners[0].tolist() == pytest.approx([0, -0.5, -0.5])
    assert made.corners[1].tolist() == pytest.approx([13, 0.5, 0.5])


@pytest.mark.parametrize("n", range(5))
def test_an_outline_with_bays_is_parted_without_overlaps(n):
    made = mesh("angle: 60\naxiom: {F--F--F}\nF -> F+F--F+F", n)
    flat = [area for area, facing in zip(areas(made), made.normals[made.triangles[:, 0]], strict=True)
            if made.normals[-1] @ facing > 0.999][-(3 * 4 ** n - 2):]
    inside = math.sqrt(3) / 4 * 9 ** n * (8 - 3 * (4 / 9) ** n) / 5
    assert np.linalg.norm(flat, axis=1).sum() == pytest.approx(inside, rel=1e-5)


@given(st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9)), min_size=3, max_size=12))
def test_any_outline_is_parted_into_as_many_triangles_as_it_should(corners):
    points = np.array([(x, 0.0, z) for x, z in corners])
    for way in (1.0, -1.0):
        triangles = triangulate(points, np.array([0.0, way, 0.0]))
        assert len(triangles) == len(corners) - 2
        assert {corner for triangle in triangles for corner in triangle} == set(range(len(corners)))


@given(st.lists(st.floats(0.3, 3), min_size=3, max_size=15))
def test_a_star_is_covered_once(distances):
    around = [(math.cos(a) * r, math.sin(a) * r, 0.0)
              for r, a in zip(distances, np.arange(len(distances)) * 2 * math.pi / len(distances), strict=True)]
    shoelace = sum(ax * by - ay * bx for (ax, ay, _), (bx, by, _) in pairwise([*around, around[0]])) / 2
    points = np.array(around)
    parts = [np.cross(points[b] - points[a], points[c] - points[a])[2] / 2
             for a, b, c in triangulate(points, np.array([0.0, 0.0, 1.0]))]
    assert min(parts) >= -1e-9
    assert sum(parts) == pytest.approx(shoelace)


def test_a_mesh_has_its_limit():
    with limits(triangles=100), pytest.raises(ModelLimitError, match="would have 112 triangles; the limit is 100"):
        mesh("axiom: FFFF")
    with pytest.raises(ModelLimitError, match="A polygon has 12,288 corners"):
        mesh("angle: 60\naxiom: {F--F--F}\nF -> F+F--F+F", 6)


def test_a_hundred_thousand_strokes_are_made_at_once():
    drawn = scene("angle: 22.5\naxiom: F(1)\nF(x) -> !(0.1*x) F(x/2)[&F(x/2)][/(140)&F(x/2)]F(x/2)", 8)
    before = time.process_time()
    assert len(mesh_of(drawn).triangles) == 28 * 65536
    assert time.process_time() - before < 5


def test_a_mesh_with_its_vertices_takes_no_more_memory_than_the_limit():
    with limits(bytes=1_000), pytest.raises(ModelLimitError, match="The mesh was not made: it would take 2,288 bytes"):
        mesh_of(scene_of(derive(read("axiom: F"), 0)))
