"""Boxes: `@B`."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import derive, draw, read
from lsys_kit.geometry.meshes.mesh import mesh_of
from lsys_kit.geometry.scene import OWN
from lsys_kit.geometry.turtle.plane import place_path, trace
from tests.endings import MESHES
from tests.geometry.test_curves import PlainTurtle, scales, steps, turns
from tests.geometry.test_curves import drawn as drawn_modules
from tests.geometry.test_space import drawn

sizes = st.integers(1, 40).map(lambda tenths: tenths / 10)


@given(st.lists(turns | steps | scales, max_size=8), sizes | sizes.map(lambda size: -size), sizes)
def test_a_box_stands_in_the_frame_of_the_turtle(way, length, width):
    plain = PlainTurtle()
    for module in way:
        plain.obey(*module)
    corners = [
        plain.place + plain.scale * plain.frame @ corner
        for corner in product((0, length), (-width / 2, width / 2), (-width / 2, width / 2))
    ]
    sides = list(drawn_modules([*way, ("&", 0), ("@B", length, width)]).polygons)
    near = 1e-9 * max(1.0, np.abs(corners).max())
    assert len(sides) == 6
    for side in sides:
        assert all(min(np.abs(corner - known).max() for known in corners) <= near for corner in side)
    assert all(sum(np.abs(side - known).max(axis=1).min() <= near for side in sides) == 3 for known in corners)


@given(st.lists(turns, max_size=5), sizes | sizes.map(lambda size: -size), sizes)
def test_its_mesh_is_closed_and_its_normals_point_outwards(way, length, width):
    mesh = mesh_of(drawn_modules([*way, ("&", 0), ("@B", length, width)]))
    solid = trimesh.Trimesh(mesh.vertices, mesh.triangles, vertex_normals=mesh.normals, process=False)
    assert (solid.vertices.shape, solid.faces.shape) == ((24, 3), (12, 3)), "each side has corners of its own"
    outward = solid.vertices - solid.vertices.mean(axis=0)
    assert (np.einsum("ij,ij->i", mesh.normals, outward) > 0).all()
    assert solid.face_normals == pytest.approx(mesh.normals[mesh.triangles[:, 0]], abs=1e-5)
    solid.merge_vertices(merge_norm=True)
    assert solid.is_watertight
    assert solid.is_winding_consistent
    assert solid.volume == pytest.approx(abs(length) * width**2, rel=1e-4)


@pytest.mark.parametrize("ending", MESHES)
def test_files_hold_it(ending, tmp_path):
    draw(read("axiom: F(2)&(30)@B(3,2)"), 0).save(tmp_path / f"box{ending}")
    parts = trimesh.load(tmp_path / f"box{ending}", force="scene").to_geometry().split(only_watertight=False)
    boxes = trimesh.util.concatenate([part for part in parts if len(part.faces) <= 12])
    boxes.merge_vertices(merge_norm=True)
    assert boxes.is_watertight
    assert boxes.volume == pytest.approx(12, rel=1e-5)


def test_in_the_plane_it_is_a_rectangle_and_the_turtle_stays():
    scene = place_path(trace(derive(read("axiom: +(90)@B(3,2)F"), 0)[0]), 90)
    assert [corner.round(9).tolist() for corner in scene.polygons] == [[[0, 1], [-3, 1], [-3, -1], [0, -1]]]
    assert scene.segments.ends[0] == pytest.approx([0, 0, -1, 0])


def test_without_numbers_it_is_a_step_long_and_as_wide_as_a_stroke():
    extents = [
        np.ptp(drawn(f"{text} &").polygons.points, axis=0).round(9).tolist()
        for text in ("@B", "@B(3)", "!(2) @B", "!(2) @D(2) @B(3)", "@D(2) @B(3,1)")
    ]
    assert extents == [[0.1, 0.1, 1], [0.1, 0.1, 3], [2, 2, 1], [4, 4, 6], [2, 2, 6]]


def test_a_box_without_extent_is_none_and_it_has_the_colour_of_the_turtle():
    polygons = drawn("@B(0) @B(2,0) !(0) @B ;(3) @B(1,1) ;(4) @B(1,1) &").polygons
    assert polygons.colours.tolist() == [3] * 6 + [4] * 6
    assert (drawn("@B(1,1) &").polygons.colours == OWN).all()


def test_many_surfaces_leave_boxes_as_they_are():
    assert len(drawn("& @B(1,1) " + "~ L f " * 151).polygons) == 6 + 151 * len(drawn("~ L").polygons)
