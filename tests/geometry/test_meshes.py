"""Meshes: closed, facing outwards, as large as the scene, and made all at once."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import ModelLimitError, derive, draw, limits, read, system
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.meshes.mesh import mesh_of, triangulate
from lsys_kit.geometry.meshes.solids import SIDES, THIN_SIDES
from tests.timing import spent

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
    return SIDES / 2 * math.sin(2 * math.pi / SIDES) * radius**2


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
    flat = [
        area
        for area, facing in zip(areas(made), made.normals[made.triangles[:, 0]], strict=True)
        if made.normals[-1] @ facing > 0.999
    ][-(3 * 4**n - 2) :]
    inside = math.sqrt(3) / 4 * 9**n * (8 - 3 * (4 / 9) ** n) / 5
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
    around = [
        (math.cos(a) * r, math.sin(a) * r, 0.0)
        for r, a in zip(distances, np.arange(len(distances)) * 2 * math.pi / len(distances), strict=True)
    ]
    shoelace = sum(ax * by - ay * bx for (ax, ay, _), (bx, by, _) in pairwise([*around, around[0]])) / 2
    points = np.array(around)
    parts = [
        np.cross(points[b] - points[a], points[c] - points[a])[2] / 2
        for a, b, c in triangulate(points, np.array([0.0, 0.0, 1.0]))
    ]
    assert min(parts) >= -1e-9
    assert sum(parts) == pytest.approx(shoelace)


def test_a_mesh_has_its_limit():
    with limits(triangles=100), pytest.raises(ModelLimitError, match="would have up to 112 triangles; the limit is 100"):
        mesh("axiom: FFFF")
    with pytest.raises(ModelLimitError, match="A polygon has 12,288 corners"):
        mesh("angle: 60\naxiom: {F--F--F}\nF -> F+F--F+F", 6)


def test_a_hundred_thousand_strokes_are_made_at_once():
    drawn = scene("angle: 22.5\naxiom: F(1)\nF(x) -> !(0.1*x) F(x/2)[&F(x/2)][/(140)&F(x/2)]F(x/2)", 8)
    with spent() as taken:
        assert 10 * 65536 < len(mesh_of(drawn).triangles) <= 28 * 65536
    assert taken.seconds < 5


def edges_by_place(made):
    """The edges of a mesh from place to place; vertices at one place are one."""
    places = np.unique(made.vertices.round(5), axis=0, return_inverse=True)[1].reshape(-1)
    return [tuple(edge) for edge in places[made.triangles[:, [0, 1, 1, 2, 2, 0]]].reshape(-1, 2).tolist()]


@pytest.mark.slow
@given(st.lists(st.tuples(st.sampled_from("+-&^"), st.integers(0, 80), st.floats(0.1, 1), st.booleans()), max_size=7))
def test_a_path_is_one_closed_tube_however_it_bends(bends):
    made = mesh(
        "axiom: !(0.1)F"
        + "".join(f"{way}({turn}) {';(3)' if other else ''} !({width / 5:.3f}) F(2)" for way, turn, width, other in bends)
        + "&(0)"
    )
    edges = edges_by_place(made)
    assert sorted(edges) == sorted((b, a) for a, b in edges)
    places = len(np.unique(made.vertices.round(5), axis=0))
    assert places % SIDES == 0 or places % THIN_SIDES == 0
    corners = np.unique(np.sort(np.array(edges), axis=1), axis=0)
    assert len(set(corners.ravel().tolist())) - len(corners) + len(made.triangles) == 2, "one surface without holes (Euler)"


@pytest.mark.parametrize("turn", [1, 10, 45, 60, 90])
def test_a_tube_keeps_its_width_where_it_bends(turn):
    made = mesh(f"axiom: !(1)F(4)&({turn})F(4)")
    assert volume(made) == pytest.approx(8 * prism(0.5), rel=1e-5)  # Pappus and Guldin: as long as its axis


def test_the_ring_of_a_bend_lies_in_the_plane_that_bisects_it():
    made = mesh("axiom: !(1)F(4)&(90)F(4)")
    ring = made.vertices[SIDES : 2 * SIDES]
    assert np.ptp(ring @ np.array([0, -1, -1])) < 1e-5 or np.ptp(ring @ np.array([0, 1, -1])) < 1e-5


def test_tubes_are_not_twisted():
    """Along a helix the edges of a tube are carried in parallel: those of a ring differ by no rotation about the axis."""
    made = mesh("axiom: !(0.1)" + "F&(20)/(35)" * 40)
    rings = made.vertices.reshape(-1, SIDES, 3)
    normals = made.normals.reshape(-1, SIDES, 3)[1:-1]
    middle = rings[1:].mean(axis=1) - rings[:-1].mean(axis=1)
    ways = middle / np.linalg.norm(middle, axis=1)[:, None]
    for before, after, way, following in zip(normals, normals[1:], ways[1:], ways[2:], strict=False):
        drift = np.einsum("i,ki->k", way, np.cross(before, after))
        assert abs(drift.mean()) < 1e-4, following


def test_equal_strokes_on_a_line_are_one_tube():
    assert len(mesh("axiom: FFFF&(0)").vertices) == len(mesh("axiom: F(4)&(0)").vertices)
    assert len(mesh("axiom: !(1)F[+F]F[-F]F").vertices) == 3 * 2 * SIDES


def test_a_stroke_that_goes_back_begins_a_tube_of_its_own():
    assert len(mesh("axiom: F|F(0.5)&(0)").vertices) == 4 * SIDES


def test_wide_short_strokes_do_not_turn_inside_out():
    made = mesh("axiom: !(3)" + "F(0.3)&(70)" * 5)
    assert np.einsum("ij,ij->i", areas(made), made.normals[made.triangles].mean(axis=1)).min() > -1e-6


def test_a_mesh_with_its_vertices_takes_no_more_memory_than_the_limit():
    with limits(bytes=1_000), pytest.raises(ModelLimitError, match="The mesh was not made: it would take 2,288 bytes"):
        mesh_of(scene_of(derive(read("axiom: F"), 0)))
