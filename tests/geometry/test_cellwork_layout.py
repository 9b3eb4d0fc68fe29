"""Cellworks come to rest in space: balances of forces that can be computed by hand, and laws."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit import ModelValueError, cellwork_system, derive, read_cellwork
from lsys_kit.geometry.tissues.layout import cellwork_scene, place_cellworks, solid_tissue
from lsys_kit.geometry.tissues.relaxation import SPACE_FORCES, Forces, area_vectors, relax, volumes

K33 = cellwork_system("K33")


def rooms(found, points):  # type: ignore[no-untyped-def]
    return volumes(points, solid_tissue(found))


@pytest.mark.parametrize(
    ("forces", "side"),
    [
        (SPACE_FORCES, 2.0),
        (Forces(rest=1, pressure=24), 3.0),
        (Forces(rest=0, pressure=4), 1.0),
        (Forces(stiffness=2, rest=1, pressure=16), 2.0),
    ],
)
def test_a_cube_is_as_large_as_springs_and_pressure_balance(forces: Forces, side: float) -> None:
    """At a corner each spring pulls with k (s - l0), each of three walls pushes with a quarter of s² P0 / s³."""
    assert forces.stiffness * (side - forces.rest) == pytest.approx(forces.pressure / (4 * side))
    [points] = place_cellworks(derive(K33, 0), forces)
    assert np.ptp(points, axis=0) == pytest.approx([side] * 3, abs=1e-3)
    assert rooms(derive(K33, 0)[0], points) == pytest.approx([side**3], rel=1e-3)


def test_the_volume_of_a_box_is_the_product_of_its_sides_wherever_it_lies() -> None:
    tissue, cube = solid_tissue(derive(K33, 0)[0]), np.array([[float(x) for x in corner.place] for corner in K33.corners])
    points = cube * (2, 3, 5) + (100, -7, 11)
    vectors = area_vectors(points, tissue)
    assert volumes(points, tissue) == pytest.approx([30])
    assert sorted(np.linalg.norm(vectors, axis=1)) == pytest.approx([6, 6, 10, 10, 15, 15])
    assert (vectors[tissue.walls] * tissue.signs[:, None]).sum(axis=0) == pytest.approx([0, 0, 0])


def test_no_cell_is_turned_inside_out_and_halves_are_alike() -> None:
    for found, points in zip(derive(K33, 4), place_cellworks(derive(K33, 4)), strict=True):
        assert (rooms(found, points) > 7).all()
        assert points.mean(axis=0) == pytest.approx([0, 0, 0], abs=1e-6)
        if len(found.cells) <= 8:
            assert np.ptp(rooms(found, points)) < 1e-6


@pytest.mark.slow
@settings(deadline=None, max_examples=20)
@given(st.lists(st.floats(-0.2, 0.2), min_size=24, max_size=24))
def test_wherever_the_corners_begin_they_come_to_rest_in_the_same_cube(shifts: list[float]) -> None:
    [points] = place_cellworks(derive(K33, 0))
    *_, rest = relax(points + np.array(shifts).reshape(8, 3), solid_tissue(derive(K33, 0)[0]), SPACE_FORCES)
    assert rooms(derive(K33, 0)[0], rest) == pytest.approx([8], rel=1e-2)


def test_a_first_cell_listed_inside_out_is_the_same_cell() -> None:
    lines = str(K33).split("\n")
    turned = read_cellwork("\n".join(lines).replace("wall PQ: 1 P 2 Q 3 P 4 Q", "wall PQ: 1 Q 4 P 3 Q 2 P"))
    for one, other in zip(place_cellworks(derive(K33, 2)), place_cellworks(derive(turned, 2)), strict=True):
        assert np.ptp(one, axis=0) == pytest.approx(np.ptp(other, axis=0), abs=1e-6)


@pytest.mark.slow
def test_a_relaxation_that_blows_up_is_said_and_the_finished_steps_are_kept() -> None:
    wild = Forces(stiffness=100, rest=10, damping=0.1, pressure=8)
    with pytest.raises(ModelValueError, match="The relaxation blows up") as caught:
        [*place_cellworks(derive(K33, 3), wild)]
    kept = caught.value.partial
    assert isinstance(kept, list)
    assert kept
    assert f"This was step {len(kept)}. Step" in (caught.value.hint or "")
    np.testing.assert_equal(kept, [*place_cellworks(derive(K33, len(kept) - 1), wild)])
    with pytest.raises(ModelValueError, match=r"This was step 0. Make stiffness"):
        [*place_cellworks(derive(K33, 3), Forces(stiffness=1e5))]


def test_corners_in_one_place_are_refused() -> None:
    text = str(K33)
    for corner in K33.corners:
        text = text.replace(str(corner), f"{corner.name}(1, 1, 1)")
    with pytest.raises(ModelValueError, match="The corners of the first cell all lie in one place"):
        [*place_cellworks(derive(read_cellwork(text), 0))]


def test_outer_walls_are_seen_and_those_between_lit_cells_are_not() -> None:
    found = derive(K33, 3)
    *_, points = place_cellworks(found)
    numbers = {"PQ": 0, "PR": 1, "QR": 2}
    everything = cellwork_scene(found[-1], points, numbers, range(8), 9)
    assert (len(everything.polygons), len(everything.segments)) == (24, 0)
    one = cellwork_scene(found[-1], points, numbers, {3}, 9)
    assert (len(one.polygons), len(one.segments)) == (6, 54 - 12)
    assert sorted(one.polygons.states.tolist()) == [0, 0, 1, 1, 2, 2]
    for corners in one.polygons:
        outward = np.cross(corners[1] - corners[0], corners[2] - corners[1])
        assert outward @ (corners.mean(axis=0) - one.polygons.points.mean(axis=0)) > 0
    assert cellwork_scene(found[-1], points, numbers, (), 9).size == 54
