"""Closed figures: the walk ends where the formula says, and is closed for the angles that are found, and for no others."""

from __future__ import annotations

import cmath
import math
from contextlib import suppress
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import closing_angles, derive, limits, read, system
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError
from lsys_kit.experiments.closing import Closing

WALKS = st.text(alphabet="F+-|", min_size=1, max_size=24)


def end_of(word: str, degrees: float) -> complex:
    """Where a turtle ends that looks ahead at first, by a walk of its own."""
    place, way = 0j, 1 + 0j
    for letter in word:
        if letter == "F":
            place += way
        else:
            way *= cmath.exp(1j * math.radians({"+": degrees, "-": -degrees, "|": 180}[letter]))
    return place


@given(WALKS, st.floats(-180, 180))
def test_the_walk_ends_where_the_formula_says(word: str, degrees: float) -> None:
    found = closing_angles(read(f"axiom: {word}"), 0)
    assert found.distance(degrees) == pytest.approx(abs(end_of(word, degrees)), abs=1e-9)


@given(WALKS)
def test_it_is_closed_for_the_angles_that_are_found_and_for_no_others(word: str) -> None:
    found = closing_angles(read(f"axiom: {word}"), 0)
    assert list(found.angles) == sorted(set(found.angles))
    for angle in found.angles:
        assert abs(end_of(word, float(angle))) < 1e-7
    if found.always:
        assert all(abs(end_of(word, degrees)) < 1e-9 for degrees in range(180))
        return
    near = {float(angle) for angle in found.angles}
    for tenth in range(1801):
        if abs(end_of(word, tenth / 10)) < 1e-9:
            assert any(abs(tenth / 10 - angle) < 1e-6 for angle in near), tenth


def test_kochs_snowflake() -> None:
    """Three strokes close for 60 and 120 degrees; every later word for half a turn, too (lesson 4)."""
    assert closing_angles(system("T2"), 0).angles == (60, 120)
    for step in (1, 2, 3):
        found = closing_angles(system("T2"), step)
        assert found.angles == (60, 120, 180)
        assert str(found.factors) == f"(z + 1)**{2 * step}*(z**2 - z + 1)*(z**2 + z + 1)/z**{4 + step}"


@pytest.mark.parametrize("corners", range(3, 13))
def test_a_regular_polygon_closes_for_its_outer_angle_and_its_stars(corners: int) -> None:
    found = closing_angles(read("axiom: " + "F+" * corners), 0).angles
    assert found == tuple(Fraction(360 * k, corners) for k in range(1, corners // 2 + 1))


def test_an_angle_that_is_no_fraction_of_a_turn() -> None:
    """An isosceles triangle with sides 2, 3, 2: at its outer angles the cosine is -3/4."""
    found = closing_angles(read("axiom: F(2)+F(3)+F(2)"), 0)
    assert found.angles == (pytest.approx(math.degrees(math.acos(-3 / 4)), abs=1e-9),)
    assert "138.5904" in repr(found)
    assert closing_angles(read("axiom: F(2)+F(5)+F(2)"), 0).angles == (), "two sides are too short to meet"


def test_brackets_lead_back() -> None:
    assert closing_angles(read("axiom: F[+F-F]+F+F"), 0).angles == (120,)
    assert closing_angles(read("axiom: [F]"), 0).always


def test_kurths_curve_with_lengths_and_a_first_turn_of_its_own() -> None:
    assert closing_angles(system("K3"), 1).angles == ()
    assert closing_angles(system("K3"), 3).angles == (180,)


def test_it_is_shown_and_drawn() -> None:
    found = closing_angles(system("T2"), 1)
    assert repr(found).endswith("closed for 60, 120, 180 degrees")
    rows = found._repr_latex_().removesuffix(r" \end{array}$").split(r" \\ ")
    assert len(rows) == 3, "where it ends, its factors, and the angles, each on a line of its own"
    assert rows[-1] == r"z = e^{i\delta}:\quad \delta = 60^\circ,\ 120^\circ,\ 180^\circ"
    picture = found.draw()
    assert picture.captions == ["60°", "120°", "180°"]
    assert repr(closing_angles(read("axiom: FF"), 0)) == "end 2, z = e^(i angle); closed for no angle"
    every = closing_angles(read("axiom: F|F"), 0)
    assert repr(every) == "closed for every angle"
    assert "none" not in every._repr_latex_()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("axiom: F+(30)F", "turns by 30 degrees"),
        ("axiom: F&F", "stays in the plane"),
        ("axiom: F+F(x)\nx = sqrt(2)", "no fractions of one another"),
    ],
)
def test_what_has_no_such_formula_is_told(text: str, said: str) -> None:
    model = read("\n".join(sorted(text.split("\n"), key=lambda line: line.startswith("axiom"))))
    with pytest.raises(ModelValueError, match=said):
        closing_angles(model, 0)
    with pytest.raises(LSystemError):
        closing_angles(model, -1)


@pytest.mark.slow
def test_the_degree_is_limited_and_so_is_the_time() -> None:
    with pytest.raises(ModelLimitError, match="300 turns apart"):
        closing_angles(read("axiom: F" + "+F" * 300), 0)
    with pytest.raises(ModelValueError, match="no closed figure"):
        closing_angles(read("axiom: FF"), 0).draw()
    with pytest.raises(ModelValueError, match="every angle"):
        closing_angles(read("axiom: F|F"), 0).draw()
    assert len(closing_angles(read("axiom: F" + "+F" * 199), 0).angles) == 100
    hard = Closing(derive(read("axiom: F"), 0)[0], {k: 1 + k * k % 7 + (k * 31) % 11 for k in range(200)})
    with limits(seconds=1), suppress(ModelLimitError):
        assert all(0 <= angle <= 180 for angle in hard.angles)
