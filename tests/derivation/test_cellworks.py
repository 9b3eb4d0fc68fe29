"""Cellworks: laws that hold at every step, and the box of the catalogue against a count of its own."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise
from typing import cast

import pytest
from hypothesis import given, settings

from lsys_kit import ModelLimitError, ModelValueError, cellwork_system, derive, limits, read_cellwork
from lsys_kit.derivation.tissues.cellworks import Cellwork
from lsys_kit.derivation.tissues.development import CellworkDevelopment, develop
from lsys_kit.notation.model.cells import CellworkSystem
from tests.derivation.random_cellworks import BOX, CORNERS, cellwork_systems

K33 = cellwork_system("K33")
_DIRECTED = (
    "wall S: 1 A> 2 B 3 A{0} 4 B\nwall S: 5 A> 6 B 7 A{0} 8 B\nwall U: 1 A> 2 B 6 A< 5 B\n"
    "wall U: 4 A{1} 3 B 7 A{0} 8 B\nwall V: 1 B 4 B 8 B 5 B\nwall V: 2 B 3 B 7 B 6 B"
)
ALONG, AGAINST = (f"{CORNERS}\n{_DIRECTED.format(*ways)}" for ways in ("<>", "><"))
"""Boxes with four edges A that point in one direction; with two of them that point in the other."""


def first_steps(system: CellworkSystem) -> CellworkDevelopment:
    """The cellworks of the first steps, or of those that can be derived."""
    try:
        with limits(modules=400):
            return derive(system, 4)
    except (ModelLimitError, ModelValueError) as error:
        return cast(CellworkDevelopment, error.partial)


@settings(deadline=None)
@given(cellwork_systems())
def test_vertices_less_edges_plus_walls_less_cells_are_one(system: CellworkSystem) -> None:
    assert {found.euler for found in first_steps(system)} == {1}


@settings(deadline=None)
@given(cellwork_systems())
def test_each_cell_is_closed_and_its_walls_agree_on_what_is_outside(system: CellworkSystem) -> None:
    for found in first_steps(system):
        for cell in found.cells:
            met = Counter((edge, forward == along) for wall, along in cell for edge, forward in found.walls[wall].sides)
            assert set(met.values()) == {1}
            assert {(edge, not forward) for edge, forward in met} == met.keys()


@settings(deadline=None)
@given(cellwork_systems())
def test_a_wall_lies_between_two_cells_or_on_the_outside_of_one(system: CellworkSystem) -> None:
    for found in first_steps(system):
        met = Counter((wall, forward) for _, wall, forward in found.cells_at())
        assert set(met.values()) == {1}
        assert {wall for wall, _ in met} == {*range(len(found.walls))}


@settings(deadline=None)
@given(cellwork_systems())
def test_the_edges_of_a_wall_lead_once_around_it(system: CellworkSystem) -> None:
    for found in first_steps(system):
        for wall in found.walls:
            corners = found.corners(wall)
            ends = [found.edges[edge].end if forward else found.edges[edge].start for edge, forward in wall.sides]
            assert ends == corners[1:] + corners[:1]
            assert len({*corners}) == len(corners) >= 3


@settings(deadline=None)
@given(cellwork_systems())
def test_a_cell_has_one_mother_and_she_has_at_most_two_daughters(system: CellworkSystem) -> None:
    for before, after in pairwise(first_steps(system)):
        daughters = Counter(after.mothers)
        assert [*daughters] == [*range(len(before.cells))]
        assert {*daughters.values()} <= {1, 2}


def boxes(halvings: int) -> tuple[int, int, int, int]:
    """Vertices, edges, walls and cells of a box whose three sides are halved in turn, counted as those of a grid."""
    a, b, c = (2 ** ((halvings + 2 - side) // 3) for side in range(3))
    return (
        (a + 1) * (b + 1) * (c + 1),
        a * (b + 1) * (c + 1) + (a + 1) * b * (c + 1) + (a + 1) * (b + 1) * c,
        a * b * (c + 1) + a * (b + 1) * c + (a + 1) * b * c,
        a * b * c,
    )


@pytest.mark.slow
def test_a_cuboid_is_divided_into_a_grid_of_boxes() -> None:
    counts = derive(K33, 9).counts
    assert counts[:3] == [(8, 12, 6, 1), (12, 20, 11, 2), (18, 33, 20, 4)]
    assert counts == [boxes(step) for step in range(10)]


def test_a_wall_inside_has_a_cell_on_each_side_and_one_outside_has_one() -> None:
    met = Counter(wall for _, wall, _ in derive(K33, 3)[-1].cells_at())
    assert Counter(met.values()) == {1: 24, 2: 12}


@pytest.mark.slow
def test_every_box_of_a_cuboid_has_two_walls_of_each_kind() -> None:
    for found in derive(K33, 7):
        assert {tuple(sorted(found.labels(cell))) for cell in found.cells} == {("PQ", "PQ", "PR", "PR", "QR", "QR")}


def test_divisions_behind_a_cell_are_counted() -> None:
    assert derive(K33, 3).generations == (3,) * 8
    one_end = read_cellwork(f"{ALONG}\nA>: * -> B> [S: S|c|S, W] [U: U|c|U, W] A>")
    assert [sorted(derive(one_end, step).generations) for step in range(4)] == [[0], [1, 1], [1, 2, 2], [1, 2, 3, 3]]


def test_the_first_production_that_fits_the_walls_of_an_edge_is_applied() -> None:
    text = f"{BOX}\nA: U -> A A\nA: * -> B"
    kinds = Counter(edge.label for edge in derive(read_cellwork(text), 1)[-1].edges)
    assert kinds == {"A": 16, "B": 4}
    none = derive(read_cellwork(f"{BOX}\nA: S T U -> B"), 1)[-1]
    assert Counter(edge.label for edge in none.edges) == {"A": 12}
    between = derive(read_cellwork(f"{BOX}\nA: S U -> B"), 1)[-1]
    assert Counter(edge.label for edge in between.edges) == {"A": 8, "B": 4}


def test_daughters_must_agree_on_both_sides_of_a_new_edge() -> None:
    rule = "A>: * -> A> [S: S|c|T, W] [U: S|c|T, W] A>"
    along, against = read_cellwork(f"{ALONG}\n{rule}"), read_cellwork(f"{AGAINST}\n{rule}")
    assert derive(along, 1).counts[-1] == (12, 20, 11, 2)
    assert sorted(map(sorted, map(derive(along, 1)[-1].labels, derive(along, 1)[-1].cells))) == [
        ["S", "S", "S", "S", "V", "W"],
        ["T", "T", "T", "T", "V", "W"],
    ]
    assert derive(against, 1).counts[-1][3] == 1


def test_new_edges_around_a_cell_must_lie_in_one_new_wall() -> None:
    text = str(K33).replace("[PR: QR|Q|QR, PQ]", "[PR: QR|Q|QR, PR]")
    with pytest.raises(ModelValueError, match="they do not lie in one new wall: they name PQ and PR") as caught:
        derive(read_cellwork(text), 3)
    assert isinstance(caught.value.partial, CellworkDevelopment)
    assert caught.value.partial.counts == [(8, 12, 6, 1)]
    assert "Step 0 is the last that can be reached" in str(caught.value)
    assert (caught.value.line, caught.value.column) == (9, text.splitlines()[8].index("PR: QR") + 1)


def test_walls_may_be_divided_and_the_cell_not() -> None:
    found = derive(read_cellwork(str(K33).replace("[PR: QR|Q|QR, PQ]", "")), 1)[-1]
    assert found.counts == (12, 18, 8, 1)
    assert found.euler == 1


def test_a_limit_keeps_the_finished_steps() -> None:
    with (
        limits(modules=60),
        pytest.raises(ModelLimitError, match=r"Step 4 would have 72 edges .*Step 3 is the last that") as caught,
    ):
        derive(K33, 9)
    assert isinstance(caught.value.partial, CellworkDevelopment)
    assert caught.value.partial.steps == 3
    with limits(bytes=20_000), pytest.raises(ModelLimitError, match="Step 2 would take about"):
        derive(K33, 9)


def test_a_development_is_a_sequence_of_cellworks() -> None:
    found = develop(K33, 5)
    assert (len(found), found.steps) == (6, 5)
    assert isinstance(found[1], Cellwork)
    assert [len(each.cells) for each in found[1:3]] == [2, 4]
    lines = repr(found).splitlines()
    assert lines[1] == "1 PR PR QR QR PQ PQ | PR PR QR QR PQ PQ"
    assert lines[-1].endswith("...")


def test_a_cellwork_system_has_no_seed_and_no_constants() -> None:
    with pytest.raises(ModelValueError, match='A cellwork system has no "seed"'):
        derive(K33, 1, seed=1)  # type: ignore[call-overload]
