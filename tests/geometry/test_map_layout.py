"""Where maps lie: laws of the forces, and the maps of seed 003 at rest."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit.budget import limits
from lsys_kit.derivation.tissues.development import develop
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.geometry.tissues.equilibrium import BALANCED, cell_hessian, equilibrium, wall_hessian
from lsys_kit.geometry.tissues.layout import equilibria, insert_vertices, place_maps, polygon, scenes, tissue
from lsys_kit.geometry.tissues.relaxation import DEFAULT_FORCES, MOST_ITERATIONS, Forces, Tissue, areas, force, relax
from lsys_kit.notation.dialects.map.dialect import read_map
from lsys_kit.notation.model.cells import MapSystem
from tests.derivation.random_maps import map_systems
from tests.derivation.test_maps import K28, K29, K30, maps_of

SQUARE = Tissue(np.array([[0, 1], [1, 2], [2, 3], [3, 0]]), np.arange(4), np.array([0, 4]))
SIDE = (0.1 + 0.21**0.5) / 2
"""Where k (s - l0) = P0 / (2 s) for the square of K31, with k = 1, l0 = 0.1, P0 = 0.1."""
SYSTEMS = {"K28": K28, "K29": K29, "K30": K30.format("A>B>C>D>")}


def square(side: float) -> np.ndarray:
    return np.array([[0, side], [side, side], [side, 0], [0, 0]])


def pushes(points: np.ndarray, net: Tissue, forces: Forces = DEFAULT_FORCES) -> np.ndarray:
    return force(points, net, areas(points, net), forces)


def test_a_single_square_is_at_rest_where_walls_and_pressure_balance() -> None:
    assert pytest.approx(0.2791, abs=5e-5) == SIDE
    assert np.abs(pushes(square(SIDE), SQUARE)).max() < 1e-12
    assert areas(square(SIDE), SQUARE) == pytest.approx([0.0779], abs=5e-5)


@pytest.mark.parametrize("side", [0.05, 0.2, 0.28, 1.0, 3.0])
def test_a_square_of_any_size_comes_to_rest_as_that_one(side: float) -> None:
    at_rest, _, settled = equilibrium(square(side), SQUARE)
    assert settled
    assert np.ptp(at_rest, axis=0) == pytest.approx([SIDE, SIDE], abs=1e-9)


@pytest.mark.parametrize(("stiffness", "rest", "pressure"), [(2, 0.1, 0.1), (1, 0.5, 0.1), (1, 0.1, 0.4), (0.5, 0, 0.2)])
def test_other_forces_have_another_balance(stiffness: float, rest: float, pressure: float) -> None:
    side = (rest + (rest**2 + 2 * pressure / stiffness) ** 0.5) / 2
    at_rest, *_ = equilibrium(square(0.3), SQUARE, Forces(stiffness, rest, pressure))
    assert np.ptp(at_rest, axis=0) == pytest.approx([side, side], abs=1e-9)


@pytest.mark.slow
@given(map_systems())
@settings(max_examples=40)
def test_forces_move_and_turn_nothing_as_a_whole(system: MapSystem) -> None:
    found = maps_of(system)[min(2, maps_of(system).steps)]
    points = np.random.default_rng(1).random((len(found.vertices), 2))
    push = pushes(points, tissue(found))
    size = np.abs(push).max() + 1
    assert push.sum(axis=0) == pytest.approx([0, 0], abs=1e-9 * size)
    assert (points[:, 0] * push[:, 1] - points[:, 1] * push[:, 0]).sum() == pytest.approx(0, abs=1e-9 * size)


@pytest.mark.slow
@given(map_systems(), st.floats(-3, 3), st.floats(-3, 3))
@settings(max_examples=30)
def test_forces_turn_with_the_map(system: MapSystem, angle: float, shift: float) -> None:
    found = maps_of(system)[min(2, maps_of(system).steps)]
    points = np.random.default_rng(2).random((len(found.vertices), 2))
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    net = tissue(found)
    push = pushes(points, net)
    assert pushes(points @ turn + shift, net) == pytest.approx(push @ turn, rel=1e-6, abs=1e-6 * (1 + np.abs(push).max()))


def test_a_force_is_the_slope_of_an_energy() -> None:
    """Walls store half their stiffness times the square of their stretch, cells the logarithm of their area."""
    found = develop(read_map(K29), 2)[-1]
    *_, points = place_maps(develop(read_map(K29), 2))
    points = points + np.random.default_rng(3).normal(0, 0.01, points.shape)
    net = tissue(found)

    def energy(at: np.ndarray) -> float:
        lengths = np.hypot(*(at[net.ends[:, 1]] - at[net.ends[:, 0]]).T)
        return float(((lengths - 0.1) ** 2).sum() / 2 - 0.1 * np.log(areas(at, net)).sum())

    push = pushes(points, net)
    for vertex, axis in ((0, 0), (3, 1), (9, 0), (13, 1)):
        step = np.zeros_like(points)
        step[vertex, axis] = 1e-6
        assert push[vertex, axis] == pytest.approx(-(energy(points + step) - energy(points - step)) / 2e-6, abs=1e-6)


@pytest.mark.parametrize("id", SYSTEMS)
def test_second_derivatives_of_the_energy_say_how_forces_change(id: str) -> None:
    maps, random = develop(read_map(SYSTEMS[id]), 3), np.random.default_rng(4)
    *_, points = place_maps(maps)
    net, points = tissue(maps[-1]), points + random.normal(0, 0.01, points.shape)
    way = random.normal(size=points.shape)
    slope = (pushes(points - 1e-6 * way, net) - pushes(points + 1e-6 * way, net)) / 2e-6
    hessian = wall_hessian(points, net, DEFAULT_FORCES) + cell_hessian(points, areas(points, net), net, DEFAULT_FORCES)
    assert (hessian @ way.ravel()).reshape(-1, 2) == pytest.approx(slope, abs=1e-6)


@pytest.mark.parametrize("id", SYSTEMS)
def test_the_maps_of_the_seed_come_to_rest_with_no_cell_inside_out(id: str) -> None:
    maps = develop(read_map(SYSTEMS[id]), 4)
    for found, points in zip(maps, place_maps(maps), strict=True):
        net = tissue(found)
        assert areas(points, net).min() > 0.04
        assert np.abs(pushes(points, net)).max() < BALANCED


def test_new_vertices_part_their_walls_into_equal_parts() -> None:
    maps = develop(read_map(K29), 1)
    points = insert_vertices(maps[1], polygon(4))
    assert points[:4] == pytest.approx(polygon(4))
    top_left, top_right = points[0], points[1]
    assert points[4] == pytest.approx((2 * top_left + top_right) / 3)
    assert points[5] == pytest.approx((top_left + 2 * top_right) / 3)


@pytest.mark.parametrize("corners", [3, 4, 5, 8])
def test_the_first_wall_lies_on_top_and_leads_to_the_right(corners: int) -> None:
    points = polygon(corners)
    assert points[0, 1] == pytest.approx(points[1, 1])
    assert points[0, 1] == pytest.approx(points[:, 1].max())
    assert points[1, 0] - points[0, 0] == pytest.approx(0.28)
    assert np.hypot(*(np.roll(points, -1, axis=0) - points).T) == pytest.approx([0.28] * corners)
    net = Tissue(np.array([[0, 1]]), np.arange(corners), np.array([0, corners]))
    assert areas(points, net)[0] > 0


@pytest.mark.slow
@given(map_systems())
@settings(max_examples=10)
def test_any_map_lies_somewhere(system: MapSystem) -> None:
    maps = maps_of(system)[:3]
    with limits(seconds=3_600):  # however busy the machine is
        placed = [*place_maps(maps)]
    for found, points in zip(maps, placed, strict=True):
        assert points.shape == (len(found.vertices), 2)
        assert np.isfinite(points).all()


def test_relaxing_shows_the_way() -> None:
    way = [*relax(square(0.3), SQUARE)]
    assert 50 < len(way) < 500
    assert way[0] == pytest.approx(square(0.3))
    assert np.ptp(way[-1], axis=0) == pytest.approx(0.2793, abs=1e-3)


def test_cells_of_one_kind_have_one_number() -> None:
    maps = develop(read_map(SYSTEMS["K30"]), 4)
    drawn = [*scenes(maps, place_maps(maps))]
    assert [scene.polygons.states.tolist() for scene in drawn] == [[0], [0, 1], [0, 1, 2], [1, 0, 2, 3], [2, 1, 0, 3, 4]]
    assert str(drawn[-1]).startswith("16 segments, 5 polygons")


def test_what_takes_too_long_is_stopped() -> None:
    with limits(seconds=1e-9), pytest.raises(ModelLimitError, match="The cells of step 0 did not come to rest in 1e-09 s"):
        next(place_maps(develop(read_map(K28), 0)))


@pytest.mark.slow
def test_a_relaxation_that_does_not_come_to_rest_says_so() -> None:
    """Long springs in weak, strongly damped walls: they buckle, and go on moving."""
    forces = Forces(stiffness=1, rest=1, pressure=0.01, damping=10)
    found = [*equilibria(develop(read_map(K29), 1), forces)]
    assert [each.settled for each in found] == [True, False]
    assert found[-1].iterations == MOST_ITERATIONS


@pytest.mark.slow
def test_a_relaxation_that_blows_up_keeps_the_steps_before() -> None:
    """By which step it blows up is chaotic: another machine may find another one."""
    maps, forces = [*develop(read_map(K28), 2)], Forces(stiffness=100, rest=1, pressure=0.01, damping=0.1)
    with pytest.raises(ModelValueError, match="blows up") as error:
        [*place_maps(maps, forces)]
    kept = error.value.partial
    assert isinstance(kept, list)
    assert kept
    assert f"This was step {len(kept)}. Step" in (error.value.hint or "")
    np.testing.assert_equal(kept, [*place_maps(maps[: len(kept)], forces)])
