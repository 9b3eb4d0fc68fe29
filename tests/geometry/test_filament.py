"""Filaments: cells in a row."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise

import pytest

from lsys_kit import ModelLimitError, ModelValueError, continuity, derive, draw, limits, read, system, timed
from lsys_kit.geometry.filament import filament

CELLS = read("t_div = 1\nt_s = 0\nt_l = 0.2\naxiom: R(0)\nL(t_div) -> L(t_s) R(t_l)\nR(t_div) -> L(t_l) R(t_s)")


@pytest.mark.parametrize(("step", "length"), [*enumerate([2, 3, 5, 8, 13, 21, 34])])
def test_the_filament_of_j1_is_as_long_as_jacob_says(step, length):
    assert filament(derive(system("J1"), step)[-1]).width == length


def test_cells_lie_side_by_side_and_point_as_their_names_say():
    cells = filament(derive(system("J1"), 2)[-1]).cells  # bl ar ar
    assert cells.centres[:, 0].tolist() == [0.5, 2, 4]
    assert cells.sizes.tolist() == [[1, 1], [2, 1], [2, 1]]
    assert cells.polarities.tolist() == [-1, 1, 1]


def test_older_cells_are_darker():
    shades = [filament(word).cells.shades[0] for word in derive(system("J4"), 2)]
    assert shades == sorted(shades)
    assert shades[0] == 0
    assert shades[2] > shades[1]


def test_shades_stay_between_light_and_dark():
    word = derive(read("axiom: a\ninterpretation:\na -> L(1, 1, 7) R(1, 1, -7)"), 0)[0]
    assert filament(word).cells.shades.tolist() == [1, 0]


@pytest.mark.parametrize("size", ["0, 1", "1, -1"])
def test_a_cell_without_length_or_width_is_an_error_that_names_it(size):
    word = derive(read(f"axiom: a\ninterpretation:\na -> L({size})"), 0)[0]
    with pytest.raises(ModelValueError, match="a cannot be drawn as L"):
        filament(word)


def test_the_filament_of_p2_grows_by_the_same_factor_in_every_step():
    lengths = [filament(word).width for word in derive(system("P2"), 12)]
    factors = [after / before for before, after in pairwise(lengths)]
    assert factors == pytest.approx([1.1673] * 12, abs=1e-3)


def test_a_cell_without_polarity_has_no_arrow() -> None:
    """Seed 000's ILSystem1 (J2): its cells are letters that point nowhere."""
    picture = draw(system("J2"), 3)
    assert set(picture.scene.cells.polarities.tolist()) == {0}
    assert 'd=""' in picture.svg


def lengths(id: str, steps: int, **constants: object) -> list[float]:
    return [filament(word).width for word in derive(system(id), steps, **constants)]


@pytest.mark.parametrize("id", ["J1", "J2", "J3", "J4", "J5", "P1", "P2", "P3", "P4", "P5", "P6", "P7", "P8", "P9", "K27"])
def test_the_cells_of_a_row_are_together_as_long_as_the_filament(id: str) -> None:
    for word in derive(system(id), 6):
        scene = filament(word)
        assert scene.cells.sizes[:, 0].sum() == pytest.approx(scene.width, abs=1e-9)
        edges = scene.cells.centres[:, 0] + scene.cells.sizes[:, 0] / 2
        assert edges[:-1] == pytest.approx((scene.cells.centres[:, 0] - scene.cells.sizes[:, 0] / 2)[1:], abs=1e-9)


@pytest.mark.parametrize("dt", ["0.7", "1.4", "0.05", "3/11"])
def test_the_filament_of_p7_is_a_to_the_n_dt_long(dt: str) -> None:
    base = float(continuity(timed(CELLS), {"L R": "a^t"}).solve("a"))
    found = lengths("P7", 6, dt=dt, a=base)
    assert found == pytest.approx([base ** (n * float(Fraction(dt))) for n in range(7)], rel=1e-9)


def test_the_filament_of_p8_is_that_of_p7() -> None:
    assert lengths("P8", 8) == pytest.approx(lengths("P7", 8), rel=1e-3)


@pytest.mark.parametrize("id", ["P9", "P9w"])
def test_a_wall_stands_at_each_end_of_each_cell(id: str) -> None:
    for word in derive(system(id), 6):
        scene = filament(word)
        ends = [0.0, *(scene.cells.centres[:, 0] + scene.cells.sizes[:, 0] / 2).tolist()]
        assert scene.walls.places.tolist() == pytest.approx(ends)
        assert set(scene.walls.heights.tolist()) == {1.0}


def test_the_short_cell_lies_on_the_side_of_the_older_wall() -> None:
    """Seed 002, figure 8: of the two cells beside a new wall the shorter one has the older wall behind it."""
    for word in derive(system("P9w"), 6)[1:]:
        scene = filament(word)
        ages, sizes = scene.walls.ages.tolist(), scene.cells.sizes[:, 0].tolist()
        for wall in (number for number, age in enumerate(ages) if age == 0):
            left, right = sizes[wall - 1], sizes[wall]
            assert (left < right) == (ages[wall - 1] > ages[wall + 1])


def test_a_wall_takes_no_room_and_may_have_no_age() -> None:
    model = read("axiom: W a W(3) W(1,7) b\ninterpretation:\na -> R(2,1)\nb -> L(1,4)")
    walls = filament(derive(model, 0)[0]).walls
    assert walls.places.tolist() == [0, 2, 2]
    assert walls.heights.tolist() == [1, 4, 4]
    assert walls.ages.tolist()[1:] == [3, 1]
    assert math.isnan(walls.ages[0])
    assert walls.shades.tolist() == [0, 0, 1]


def test_a_letter_like_a_cell_without_a_length_is_none() -> None:
    scene = filament(derive(read("axiom: L a R(2)\ninterpretation:\na -> R(2,1)"), 0)[0])
    assert str(scene) == "1 cell, width 2, height 1"


def test_a_cell_whose_length_is_not_known_is_an_error_that_names_it() -> None:
    word = derive(read("dt = 1\naxiom: a(dt)\ninterpretation:\na(t) -> R(t,1)"), 0, dt="dt")[0]
    with pytest.raises(ModelValueError, match="cannot be drawn"):
        filament(word)


def test_a_filament_has_its_limits() -> None:
    many = derive(read("axiom: a\na -> a a\ninterpretation:\na -> repeat(1000,i)<R(1,1)>"), 3)[-1]
    with limits(bytes=1_000_000), pytest.raises(ModelLimitError, match="were not drawn: it would take 1,200,000 bytes"):
        filament(many)
