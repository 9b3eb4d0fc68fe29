"""The systems in which a substance spreads: what is kept, what becomes steady, and where a heterocyst arises."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import pairwise

import pytest

from lsys_kit import derive, distances, read, system, total
from lsys_kit.classroom.catalogue import entry
from lsys_kit.derivation.core.words import Word

HETEROCYST = "H"


def concentrations(word: Word) -> list[float]:
    return [float(module.arguments[-1]) for module in word]


def places(word: Word) -> list[int]:
    return [place for place, module in enumerate(word) if module.symbol == HETEROCYST]


@pytest.mark.parametrize("dt", ["0.5", "1", "2", "3"])
def test_what_spreads_is_kept_with_any_time_step(dt: str) -> None:
    assert total(system("N1"), "C", dt=dt).values(12) == [8] * 13


@pytest.mark.parametrize(("dt", "swings"), [("0.5", False), ("1", False), ("2", False), ("2.5", True), ("3", True)])
def test_a_time_step_is_too_long_where_a_cell_gives_more_than_it_has(dt: str, swings: bool) -> None:
    assert (min(map(min, map(concentrations, derive(system("N1"), 12, dt=dt)))) < 0) == swings


@pytest.mark.parametrize(
    ("diffusion", "decay", "factor"),
    [("0.3", "0.05", Fraction(2, 3)), ("0.3", "0.15", Fraction(1, 2)), ("0.1", "0.05", Fraction(1, 2))],
)
def test_it_thins_out_by_the_same_factor_from_cell_to_cell(diffusion: str, decay: str, factor: Fraction) -> None:
    assert Fraction(diffusion) * (1 / factor + factor - 2) == Fraction(decay)
    steady = concentrations(derive(system("N1b"), 200, D=diffusion, decay=decay)[-1])
    assert steady[:6] == pytest.approx([float(factor**k) for k in range(6)], abs=1e-3)


def test_a_new_heterocyst_arises_near_the_middle_of_a_gap() -> None:
    rows = [places(word) for word in derive(system("N5"), 150)]
    new = [step for step, (before, after) in enumerate(pairwise(rows), 1) if len(after) > len(before)]
    assert new == [59, 102, 136, 138]
    assert [rows[step] for step in new[:2]] == [[0, 10, 17], [0, 9, 19, 32]]


@pytest.mark.parametrize("seed", range(4))
def test_a_gap_below_the_shortest_is_never_divided(seed: int) -> None:
    """With r = 2/3 and the threshold 0.2 it is 12 in the steady state, and cells begin with more than the threshold."""
    rows = [places(word) for word in derive(system("N5"), 150, seed=seed)]
    for before, after in pairwise(rows):
        if len(after) > len(before):
            assert max(right - left for left, right in pairwise(before)) >= 11


@pytest.mark.slow
def test_four_explanations_leave_four_kinds_of_distances() -> None:
    count, chief, dice, substance = (
        distances(system(id), HETEROCYST, seeds, steps=steps)["distance"]
        for id, seeds, steps in (("N2", 20, 150), ("N3", 20, 30), ("N4", 40, 30), ("N5", 8, 150))
    )
    assert Counter(count).most_common(1) == [(1, 368)]
    assert max(count) == 12
    assert (min(chief), max(chief)) == (10, 37)
    assert (min(dice), max(dice)) == (1, 58)
    assert (min(substance), max(substance)) == (4, 20)


def test_heterocysts_that_give_off_nothing_crowd_together() -> None:
    mutant = read(entry("N5").rules.replace("C(uniform(0,0.3), c) H(1)", "C(uniform(0,0.3), c) H(0)"))
    assert Counter(distances(mutant, HETEROCYST, steps=150)["distance"]).keys() == {1, 2, 5, 8}


def test_activator_and_inhibitor_make_peaks_out_of_nearly_nothing() -> None:
    word = derive(system("N6"), 200)[-1]
    amount = [0.0, *(float(module.arguments[0]) for module in word), 0.0]
    peaks = [place for place in range(1, 61) if amount[place] > 2 and amount[place - 1] < amount[place] > amount[place + 1]]
    assert peaks == [4, 12, 22, 30, 35, 46, 53, 60]
    assert max(float(module.arguments[0]) for module in derive(system("N6"), 200, Da="0.05")[-1]) < 1.2


def test_what_leaves_make_is_in_the_plant_or_in_its_root() -> None:
    words = derive(system("N7"), 20)
    sums = [sum(module.arguments[0] for module in word if module.symbol in "RF") for word in words]
    leaves = [word.counts().get("L", 0) for word in words]
    assert [after - before for before, after in pairwise(sums)] == leaves[:-1]
    assert next(step for step, word in enumerate(words) if word[1].arguments == (21,)) == 14
