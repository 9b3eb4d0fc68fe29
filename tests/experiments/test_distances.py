"""How far apart the modules of one kind stand, and a parameter along a word."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import LSystemError, derive, distances, plot, read, system

letters = st.lists(st.sampled_from("abH"), min_size=1, max_size=40)


@given(letters, st.integers(0, 3))
def test_the_distances_lead_from_the_first_to_the_last(word: list[str], steps: int) -> None:
    places = [place for place, letter in enumerate(word) if letter == "H"]
    filament = read(f"axiom: {' '.join(word)}\nH -> H")
    if len(places) < 2:
        return
    found = distances(filament, "H", steps=steps)["distance"]
    assert len(found) == len(places) - 1
    assert sum(found) == places[-1] - places[0]


def test_a_distance_is_one_where_two_stand_side_by_side() -> None:
    assert distances(read("axiom: H H a H"), "H", steps=0)["distance"] == (1, 2)


def test_the_runs_are_those_of_the_seeds() -> None:
    both, alone = distances(system("N4"), "H", [3, 5], steps=[10, 20]), distances(system("N4"), "H", [5], steps=20)
    assert both.where(seed=5, step=20)["distance"] == alone["distance"]


def test_they_are_shown_as_a_histogram_even_of_one_run() -> None:
    found = distances(read("axiom: H a H a a H"), "H", steps=0)
    assert repr(found.plot()) == "2 pairs, distance: least 2, mean 2.5, greatest 3"
    assert found.summary().columns == ("step", "pairs", "mean", "sd", "least", "median", "greatest")


def test_cells_of_two_polarities_have_one_letter() -> None:
    assert distances(system("J1"), "b", steps=3)["distance"] == (2,)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (lambda: distances(read("axiom: F [+ F] F"), "F", steps=0), "A word with branches has no distances along it"),
        (lambda: distances(read("axiom: a"), "a", steps=0), 'Nowhere are there two modules "a" in a word'),
        (lambda: distances(read("axiom: a b"), "c", steps=0), 'No module is called "c"'),
        (lambda: distances(read("axiom: a a"), "a", steps=0, q=1), "The system has no constant"),
        (lambda: distances("axiom: a", "a"), "An L-system is needed"),
        (lambda: plot(derive(system("N5"), 1)[-1]), "Along a word one parameter is shown"),
        (lambda: plot(derive(system("N5"), 1)[-1], measure="q"), 'No module has a parameter "q"'),
        (lambda: plot(derive(read("axiom: a"), 1)[-1], measure="q"), "Parameters are: none"),
        (lambda: plot(derive(system("N5"), 1)[-1], 3, measure="c"), "A word is at a step"),
        (lambda: plot({"one": derive(system("N5"), 1)[-1], "all": system("N5")}, measure="c"), "can be plotted, not Word"),
    ],
)
def test_what_cannot_be_measured_is_told(asked: Any, said: str) -> None:
    with pytest.raises(LSystemError) as caught:
        asked()
    assert said in f"{caught.value} {caught.value.hint}"


def test_a_parameter_is_plotted_along_a_word() -> None:
    """A module without it leaves its place free."""
    word = derive(read("axiom: C(2) H C(5)\nC(c) -> C(c+1)"), 1)[-1]
    [curve] = plot(word, measure="c").chart.curves
    assert curve.points == ((1, 3), (3, 6))


def test_several_words_have_a_curve_each() -> None:
    words = derive(system("N1"), 2)
    shown = plot({"step 0": words[0], "step 2": words[2]}, measure="c")
    assert repr(shown) == "2 curves (step 0, step 2) of c, place in the word from 1 to 9, largest 8"
