"""Lineages: which cell comes from which, and when each divides."""

from __future__ import annotations

import re
from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelLimitError, ModelValueError, derive, limits, lineage, read, system, timed
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.timed.lineage import Lineage
from tests.derivation.random_systems import systems, systems_with

TIMED = read("t_div = 1\nt_s = 0\nt_l = 0.2\naxiom: R(0)\nL(t_div) -> L(t_s) R(t_l)\nR(t_div) -> L(t_l) R(t_s)")
"""Seed 002's L-systems 5 and 6 in continuous time."""
TRUE = lineage(timed(TIMED), 7)
ANABAENA = timed(read("axiom: ar(0)\nar(1) -> al(0) br(0)\nal(1) -> bl(0) ar(0)\nbr(1) -> ar(0)\nbl(1) -> al(0)"))
LOOKING = read("turtle: grogra\naxiom: a\na : sensed(2,1) > 60 -> RH(180) F(100) [ - b ] + a\nb -> a")
"""Seed 003's sensitive dichotomy: a branches where no shoot is near."""
STEPS = st.fractions("1/10", 3, max_denominator=20)


def words(tree: Lineage) -> list[list[object]]:
    """For each step the modules of its cells, in order."""
    return [[dict(tree.cells[cell].modules)[step] for cell in word] for step, word in enumerate(tree.words)]


def named(derivation: Derivation) -> list[list[object]]:
    """For each step the modules of its word that are no brackets, and no signs except those of which letters come."""
    system = derivation.states.system
    dividing = {
        rule.predecessor.symbol
        for rule in (*system.productions, *system.decomposition)
        if re.search(r"[A-Za-z]", " ".join(str(made) for made in rule.successor))
    }
    return [[module for module in word if module.symbol[0].isalpha() or module.symbol in dividing] for word in derivation]


def founder(tree: Lineage, cell: int) -> int:
    while (mother := tree.cells[cell].mother) is not None:
        cell = mother
    return cell


@pytest.mark.parametrize("id", ["J1", "J4", "J5", "P1", "P2", "P4", "P5", "P6", "P8", "K27", "J3", "K5", "K7", "K19", "K3"])
def test_the_cells_of_each_step_are_the_modules_of_its_word(id: str) -> None:
    derivation = derive(system(id), 4)
    assert words(lineage(derivation)) == named(derivation)


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(st.one_of(systems(), *map(systems_with, ("context", "chance", "decomposition", "cut"))))
def test_so_they_are_in_random_systems(model: object) -> None:
    try:
        with limits(modules=2_000):
            derivation = derive(model, 3)  # type: ignore[arg-type]
    except LSystemError:
        return
    assert words(lineage(derivation)) == named(derivation)


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(st.one_of(systems(), systems_with("context"), systems_with("decomposition")))
def test_a_cell_is_born_when_its_mother_ends_and_never_ends_before(model: object) -> None:
    try:
        with limits(modules=2_000):
            tree = lineage(derive(model, 3))  # type: ignore[arg-type]
    except LSystemError:
        return
    for number, cell in enumerate(tree.cells):
        assert cell.ended is None or cell.born <= cell.ended <= tree.times[-1]
        assert cell.mother is None or (cell.mother < number and tree.cells[cell.mother].ended == cell.born)
        assert tree.daughters(number) == tuple(n for n, other in enumerate(tree.cells) if other.mother == number)


@pytest.mark.parametrize("id", ["P1", "J4", "K7"])
def test_a_cell_descends_from_the_cell_that_the_derivation_says(id: str) -> None:
    derivation = derive(system(id), 4)
    tree = lineage(derivation)
    order = {cell: place for place, cell in enumerate(tree.words[0])}
    letters = [place for place, module in enumerate(derivation[-1]) if module.symbol[0].isalpha()]
    assert [order[founder(tree, cell)] for cell in tree.words[-1]] == [derivation.ancestors(4)[place] for place in letters]


@given(STEPS)
def test_the_divisions_of_l_system_6_are_the_same_for_any_step(dt: Fraction) -> None:
    tree = lineage(system("P6"), int(Fraction(4) / dt), dt=dt)
    end = tree.times[-1]
    assert tree.divisions == tuple(time for time in TRUE.divisions if time <= end)
    assert not any(cell.due for cell in tree.cells)


@pytest.mark.slow
@given(st.fractions("1/10", "3/4", max_denominator=20))
def test_l_system_5_divides_in_time_where_steps_are_short(dt: Fraction) -> None:
    tree = lineage(system("P5"), int(Fraction(4) / dt), dt=dt)
    assert tree.divisions == tuple(time for time in TRUE.divisions if time <= tree.times[-1])
    assert not any(cell.due for cell in tree.cells)


def test_l_system_5_divides_late_where_steps_are_long() -> None:
    """Seed 002, figures 4 and 5: with dt = 1.4 there are cells past their division age."""
    tree = lineage(system("P5"), 3, dt="1.4")
    late = [cell for cell in tree.cells if cell.due is not None]
    assert [float(cell.due) for cell in late if cell.ended is not None] == [2.6]
    assert len([cell for cell in late if cell.ended is None]) == 8
    assert {cell.due for cell in late} <= set(lineage(system("P6"), 3, dt="1.4").divisions)


def test_a_cell_that_is_just_old_enough_is_not_late() -> None:
    """At step 2 of dt = 1.4 two cells have the age 1, and one has 1.2."""
    assert [cell.due for cell in lineage(system("P5"), 2, dt="1.4").cells if cell.due] == [Fraction(13, 5)]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("id", "times"),
    [
        ("P5", ["1", "9/5", "2", "13/5", "14/5", "14/5", "3"]),
        ("P6", ["1", "9/5", "2", "13/5", "14/5", "14/5", "3"]),
        ("K27", ["1", "2", "3", "3", "4", "4", "4"]),
        ("J4", ["3", "5", "6", "7", "8", "8", "9"]),
    ],
)
def test_the_first_divisions(id: str, times: list[str]) -> None:
    assert [str(time) for time in lineage(system(id), 12).divisions[:7]] == times


@given(st.fractions(0, 6, max_denominator=12))
def test_the_cells_of_a_timed_system_at_its_end_are_those_of_its_word(end: Fraction) -> None:
    tree = lineage(ANABAENA, end)
    assert words(tree)[-1] == list(ANABAENA.word(end))
    assert tree.divisions == tuple(time for time in lineage(ANABAENA, 6).divisions if time < end)


def test_the_steps_of_k27_are_its_time() -> None:
    stepwise, whole = lineage(system("K27"), 9), lineage(ANABAENA, "9/2")
    assert stepwise.times[-1] == Fraction(9, 2)
    assert stepwise.divisions == whole.divisions
    assert [cell.born for cell in sorted(stepwise.cells, key=lambda cell: cell.born)] == [
        cell.born for cell in sorted(whole.cells, key=lambda cell: cell.born)
    ]


def test_cells_are_known_as_they_were_at_birth() -> None:
    """In L-systems 5 and 6 a short cell begins at the age 0, a long one at 0.2, within whichever step."""
    for id in ("P5", "P6"):
        tree = lineage(system(id), 6)
        assert {str(cell.at_birth) for cell in tree.cells} == {"M(0,-1)", "M(0,1)", "M(0.2,-1)", "M(0.2,1)"}
        for number, cell in enumerate(tree.cells):
            if tree.daughters(number):
                assert cell.ended - cell.born == 1 - cell.at_birth.arguments[0]  # type: ignore[operator]


def test_a_short_cell_lives_a_quarter_longer_than_a_long_one() -> None:
    """Seed 002, section 3: four and five steps."""
    tree = lineage(system("P2"), 30)
    lives = {(cell.at_birth.symbol[0], cell.ended - cell.born) for cell in tree.cells if cell.ended and cell.mother is not None}
    assert lives == {("S", 5), ("L", 4)}


def test_walls_are_no_cells() -> None:
    tree = lineage(system("P9w"), 5)
    assert len(tree.words[-1]) == 13
    assert {cell.at_birth.symbol for cell in tree.cells} == {"L_r", "L_l", "S_r", "S_l"}


def test_cells_may_die() -> None:
    tree = lineage(read("axiom: A B\nA -> A\nB -> ε"), 2)
    assert [(cell.born, cell.ended) for cell in tree.cells] == [(0, None), (0, 1)]
    assert tree.divisions == ()


def test_a_rule_that_decomposes_once_lets_cells_divide_late() -> None:
    rules = "dt = 3\ndecomposition depth: 1\naxiom: M(0)\nM(t) -> M(t+dt)\ndecomposition:\nM(t) : t >= 1 -> M(t-1) M(t-1)"
    tree = lineage(read(rules), 1)
    assert [cell.due for cell in tree.cells] == [None, 2, 2]


def test_ages_in_floats_give_the_same_lineage_but_for_the_trap() -> None:
    assert len(lineage(system("P5"), 4, arithmetic="float").words[-1]) == 5
    assert lineage(system("P5"), 3, arithmetic="float").divisions == pytest.approx([1.0, 1.8, 2.0])


def test_a_lineage_is_told_in_a_line() -> None:
    assert str(lineage(system("P5"), 3, dt="1.4")) == "8 cells at time 4.2, after 7 divisions; 9 late"
    assert repr(lineage(read("axiom: A"), 0)) == "1 cell at time 0, after 0 divisions"


@pytest.mark.parametrize(
    ("what", "n", "choices", "said"),
    [
        ("P6", 2, {}, "not str"),
        (LOOKING, 2, {}, "Derive it first"),
        (timed(TIMED), None, {}, "needs the time at which it ends"),
        (derive(system("P6"), 2), 3, {}, "chosen when a system is derived"),
        (derive(system("P6"), 2), None, {"dt": 1}, "chosen when a system is derived"),
        (timed(TIMED), -1, {}, "before the axiom"),
    ],
)
def test_what_has_no_lineage_is_explained(what: object, n: object, choices: dict[str, object], said: str) -> None:
    with pytest.raises(ModelValueError, match=said):
        lineage(what, n, **choices)  # type: ignore[arg-type]


@pytest.mark.slow
def test_a_lineage_does_not_run_away() -> None:
    with pytest.raises(ModelLimitError, match="100,000 modules together"):
        lineage(system("P1"), 30)
    with limits(seconds=600), pytest.raises(ModelLimitError, match=r"more than|may have"):
        lineage(timed(TIMED), 16)


def test_times_are_those_of_the_steps() -> None:
    tree = lineage(system("P6"), 4)
    assert [after - before for before, after in pairwise(tree.times)] == [Fraction(7, 10)] * 4
    assert lineage(system("P8"), 3).times == (0, 1, 2, 3)


def test_a_system_that_looks_around_has_a_lineage_once_it_is_derived() -> None:
    derivation = derive(LOOKING, 3)
    assert words(lineage(derivation)) == named(derivation)
