"""Filaments: cells in a row."""

from itertools import pairwise

import pytest

from lsys_kit import ModelValueError, derive, draw, read, system
from lsys_kit.geometry.filament import filament


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
