"""Maps on a sphere: laws of the map, and where its vertices come to rest."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit import ModelLimitError, ModelValueError, derive, limits, map_system, read_map
from lsys_kit.derivation.tissues.development import Development
from lsys_kit.geometry.tissues.layout import arc, meridian, place_on_sphere
from lsys_kit.geometry.tissues.relaxation import Forces
from lsys_kit.notation.model.cells import MapSystem
from tests.derivation.random_maps import map_systems

K34 = map_system("K34")
STILL = Forces(stiffness=1e-9, pressure=1e-12)
"""Forces that leave vertices where they were made."""


def on_a_sphere(system: MapSystem) -> Development:
    """The first maps of a system, with its walls from pole to pole, as long as they are small."""
    sphere = MapSystem(system.axiom, system.productions, system.steps, True)
    try:
        with limits(modules=300):
            return derive(sphere, 5)
    except ModelLimitError as error:
        assert isinstance(error.partial, Development)  # noqa: PT017
        return error.partial


@given(map_systems())
def test_vertices_less_walls_plus_cells_are_two_on_a_sphere(system: MapSystem) -> None:
    for vertices, walls, cells in on_a_sphere(system).counts:
        assert vertices - walls + cells == 2


@given(map_systems())
def test_each_wall_of_a_sphere_has_a_cell_on_either_side(system: MapSystem) -> None:
    for found in on_a_sphere(system):
        sides = [side for cell in found.cells for side in cell]
        assert len(sides) == len(set(sides)) == 2 * len(found.walls)
        assert found.boundary == ()


@pytest.mark.slow
@settings(deadline=None, max_examples=25)
@given(map_systems(), st.integers(0, 3))
def test_vertices_stay_on_the_sphere_and_walls_between_poles_keep_their_longitudes(system: MapSystem, step: int) -> None:
    maps = derive(on_a_sphere(system).system, 0)
    with limits(modules=60):
        try:
            maps = derive(maps.system, step)
        except ModelLimitError as error:
            maps = error.partial  # type: ignore[assignment]
    every = {0.0} | {2 * np.pi * number / len(system.axiom) for number in range(len(system.axiom))}
    for found, (points, longitudes) in zip(maps, place_on_sphere(maps), strict=True):
        assert np.linalg.norm(points, axis=1) == pytest.approx(np.ones(len(found.vertices)))
        poles = [number for number, wall in enumerate(found.walls) if {wall.start, wall.end} == {0, 1}]
        assert [*longitudes] == poles
        assert {*longitudes.values()} <= every
        assert [*longitudes.values()] == sorted(longitudes.values())


def test_the_embryo_has_tiers_of_four_cells_which_are_alike() -> None:
    maps = derive(K34, 4)
    assert maps.counts == [(2, 4, 4), (10, 16, 8), (26, 40, 16), (58, 88, 32), (122, 184, 64)]
    for found, (points, _) in zip(maps[1:4], [*place_on_sphere(derive(K34, 3))][1:], strict=True):
        heights = np.round(sorted(points[found.corners(cell), 2].mean() for cell in found.cells), 3)
        tiers, sizes = np.unique(heights, return_counts=True)
        assert sizes.tolist() == [4] * (len(found.cells) // 4)
        assert tiers == pytest.approx(-tiers[::-1])


@pytest.mark.parametrize(("step", "rising"), [(1, True), (2, False)])
def test_new_walls_rise_to_the_right_and_to_the_left_in_turn(step: int, rising: bool) -> None:
    """Seen from outside, right is east."""
    found = derive(K34, step)[-1]
    *_, (points, _) = place_on_sphere(derive(K34, step), STILL)
    new = [wall for wall in found.walls if wall.label == "e"][4 * (step - 1) :]
    assert len(new) == 4 * step
    for wall in new:
        start, end = points[wall.start], points[wall.end]
        assert ((start[0] * end[1] > start[1] * end[0]) == (end[2] > start[2])) == rising


def test_an_arc_is_the_shortest_way_on_the_sphere() -> None:
    x, y = np.eye(3)[:2]
    assert arc(x, y, np.array([0, 1 / 3, 1])) == pytest.approx(np.array([[1, 0, 0], [3**0.5 / 2, 0.5, 0], [0, 1, 0]]))
    assert arc(x, x, np.array([0.5])) == pytest.approx(x[None])
    assert meridian(0, np.array([0, 0.5, 1])) == pytest.approx(np.array([[0, 0, 1], [1, 0, 0], [0, 0, -1]]), abs=1e-12)


def test_a_sphere_that_blows_up_keeps_the_steps_before() -> None:
    with pytest.raises(
        ModelValueError, match=r"The relaxation blows up.*This was step 1. Step 0 is the last that can be reached"
    ) as caught:
        [*place_on_sphere(derive(K34, 2), Forces(stiffness=1e300))]
    assert len(caught.value.partial) == 1  # type: ignore[arg-type]


def test_meridians_may_be_directed_from_either_pole() -> None:
    down, up = (read_map(f"sphere: {4 * wall}\n{wall[0]}> -> a>b>b>") for wall in ("D>", "D<"))
    (_, (one, _)), (_, (other, _)) = (place_on_sphere(derive(system, 1), STILL) for system in (down, up))
    assert one == pytest.approx(-other[np.r_[0:2, 2:10]] * (-1, -1, 1) * np.where(np.arange(10) < 2, -1, 1)[:, None], abs=1e-6)
