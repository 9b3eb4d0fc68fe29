"""Maps: laws that hold for every map system, and the maps of the seeds."""

from __future__ import annotations

from collections import Counter
from contextlib import suppress
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit.budget import limits
from lsys_kit.derivation.derive import derive
from lsys_kit.derivation.tissues.development import Development, develop
from lsys_kit.derivation.tissues.maps import (
    Map,
    cell_words,
    dividing_walls,
    kinds_of_cells,
    least_rotation,
    map_step,
    replaced_map,
)
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.dialects.map.dialect import read_map
from lsys_kit.notation.model.cells import Edge, EdgeProduction, MapSystem
from tests.derivation.random_maps import map_systems

STEPS = 4
K28 = "map: ABAB\nA -> B[-A][+A]B\nB -> A"
K29 = "map: ABAB\nA -> B[-A]x[+A]B\nB -> A"
K30 = "map: {}\nA> -> D>[-A>]B>\nB> -> B>\nC> -> B>[-A<]B>\nD> -> C>"


def maps_of(system: MapSystem) -> Development:
    """The first maps, as long as they are small."""
    maps = develop(system, 0)
    with limits(modules=500), suppress(ModelLimitError):
        for step in range(1, STEPS + 1):
            maps = develop(system, step)
    return maps


def rewritten(word: tuple[Edge, ...], productions: dict[Edge, EdgeProduction]) -> tuple[Edge, ...]:
    """The next word of the boundary, as of a context-free L-system: walls that are met against their direction are turned."""
    made: list[Edge] = []
    for edge in word:
        production = productions.get(edge.turned if edge.arrow == "<" else edge)
        parts = production.edges if production else (edge.turned if edge.arrow == "<" else edge,)
        made += (part.turned for part in reversed(parts)) if edge.arrow == "<" else parts
    return tuple(made)


def turning(word: tuple[Edge, ...]) -> Counter[tuple[str, str]]:
    """The letters of a cyclic word, in any order."""
    return Counter((edge.label, edge.arrow) for edge in word)


@given(map_systems())
def test_vertices_less_walls_and_cells_are_one(system: MapSystem) -> None:
    for vertices, walls, cells in maps_of(system).counts:
        assert vertices - walls + cells == 1


@given(map_systems())
def test_each_wall_has_a_region_on_both_sides(system: MapSystem) -> None:
    for found in maps_of(system):
        sides = Counter(side for cell in found.cells for side in cell)
        sides.update((wall, not forward) for wall, forward in found.boundary)
        assert sides == Counter({(wall, way): 1 for wall in range(len(found.walls)) for way in (True, False)})


@given(map_systems())
def test_the_sides_of_a_cell_lead_once_around_it(system: MapSystem) -> None:
    for found in maps_of(system):
        for cell in (*found.cells, found.boundary):
            corners = found.corners(cell)
            ends = [found.walls[wall].end if forward else found.walls[wall].start for wall, forward in cell]
            assert ends == corners[1:] + corners[:1]
            assert len(set(corners)) == len(corners) >= 3


@given(map_systems())
def test_the_boundary_is_rewritten_as_a_word(system: MapSystem) -> None:
    productions = {production.predecessor: production for production in system.productions}
    word = system.axiom
    for found in maps_of(system):
        assert found.word(found.boundary) == word
        word = rewritten(word, productions)


@given(map_systems())
def test_a_cell_has_one_mother_who_has_at_most_two_daughters(system: MapSystem) -> None:
    maps = maps_of(system)
    for before, after in pairwise(maps):
        assert len(after.mothers) == len(after.cells)
        assert {1, 2} >= set(Counter(after.mothers).values())
        assert sorted(set(after.mothers)) == [*range(len(before.cells))]


@given(map_systems())
def test_a_neutral_wall_has_no_beginning(system: MapSystem) -> None:
    """Its ends may be taken in either order: the walls and cells that are made have the same letters."""
    found = maps_of(system)[-1]
    flipped = Map(
        found.vertices,
        tuple(wall if wall.directed else wall._replace(start=wall.end, end=wall.start) for wall in found.walls),
        tuple(_flipped(cell, found) for cell in found.cells),
        _flipped(found.boundary, found),
    )
    assert str(flipped) == str(found)
    assert next_words(found, system) == next_words(flipped, system)


def _flipped(cell, found):  # type: ignore[no-untyped-def]
    return tuple(side if found.walls[side.wall].directed else side._replace(forward=not side.forward) for side in cell)


def next_words(found: Map, system: MapSystem) -> str:
    with limits(modules=1_000_000):
        return str(map_step(found, system, 1))


@given(map_systems())
@settings(max_examples=40)
def test_a_map_without_markers_only_parts_its_walls(system: MapSystem) -> None:
    bare = MapSystem(system.axiom, tuple(EdgeProduction(p.predecessor, p.edges) for p in system.productions))
    for found in maps_of(bare):
        assert len(found.cells) == 1
        assert found.cells[0] == found.boundary


@pytest.mark.parametrize(
    ("text", "counts"),
    [
        (K28, [(4, 4, 1), (6, 7, 2), (9, 12, 4)]),
        (K29, [(4, 4, 1), (8, 9, 2), (14, 17, 4)]),
        (K30.format("A>B>C>D>"), [(4, 4, 1), (6, 7, 2), (8, 10, 3)]),
    ],
)
def test_the_maps_of_seed_003(text: str, counts: list[tuple[int, int, int]]) -> None:
    assert derive(read_map(text), 2).counts == counts


def test_every_cell_of_the_first_example_is_a_square_of_two_letters() -> None:
    for found in derive(read_map(K28), 6):
        assert {"".join(map(str, word)) for word in cell_words(found)} == {"ABAB"}


def test_walls_of_the_second_example_are_offset_by_x() -> None:
    maps = derive(read_map(K29), 5)
    assert {len(cell) for cell in maps[3].cells} == {5, 6, 7}
    kept = [sum(wall.label == "x" for wall in found.walls) for found in maps]
    assert kept == sorted(kept)
    assert kept[:4] == [0, 2, 5, 11]


def test_the_third_example_is_a_spiral() -> None:
    """At each step one cell, which is called apical, has the walls A B C D, and it alone divides."""
    for found in derive(read_map(K30.format("A>B>C>D>")), 12):
        assert sum(turning(found.word(cell)) == turning(read_map(K30.format("A>B>C>D>")).axiom) for cell in found.cells) == 1
    assert [cells for _, _, cells in derive(read_map(K30.format("A>B>C>D>")), 12).counts] == [*range(1, 14)]


def test_a_first_cell_listed_the_other_way_around_never_divides() -> None:
    assert [cells for _, _, cells in derive(read_map(K30.format("D<C<B<A<")), 6).counts] == [1] * 7


@pytest.mark.parametrize("text", [K28, K29, K30.format("A>B>C>D>")])
@pytest.mark.parametrize("turn", [1, 2, 3])
def test_where_the_first_cell_begins_does_not_matter_where_markers_match_one_way_only(text: str, turn: int) -> None:
    system = read_map(text)
    turned = MapSystem(system.axiom[turn:] + system.axiom[:turn], system.productions)
    for found, other in zip(derive(system, 6), derive(turned, 6), strict=True):
        assert Counter(cell_words(found)) == Counter(cell_words(other))


def test_a_new_wall_runs_from_the_marker_that_points_away() -> None:
    found = derive(read_map(K30.format("A>B>C>D>")), 1)[1]
    new = found.walls[-1]
    assert (new.label, new.start, new.end) == ("A", 4, 5)
    assert [found.vertices[vertex].between for vertex in (4, 5)] == [(0, 1), (2, 3)]


@pytest.mark.parametrize(
    ("rules", "cells"),
    [
        ("A -> A[-B][+B]A", 2),
        ("A> -> A>[-B>]A>", 1),
        ("A> -> A>[-B<]A>", 1),
        ("A> -> A>[-B>][-B<]A>", 2),
        ("A> -> A>[+B]A>", 1),
        ("A> -> A>[-B]A>", 2),
        ("A> -> A>[-B][-C]A>", 2),
    ],
)
def test_markers_match_that_point_opposite_ways_or_both_nowhere(rules: str, cells: int) -> None:
    axiom = "A>A>A>" if "A>" in rules else "AAA"
    assert derive(read_map(f"map: {axiom}\n{rules}"), 1).counts[1][2] == cells


def test_markers_of_one_wall_do_not_match() -> None:
    assert derive(read_map("map: A>CD\nA> -> A>[-B]A>[-B]A>"), 1).counts[1] == (5, 5, 1)


def test_a_cell_divides_once_a_step_and_the_first_pair_is_joined() -> None:
    found = derive(read_map("map: A>B>A>B>\nA> -> A>[-X]A>\nB> -> B>[-Y]B>"), 1)[1]
    assert str(found) == "A>XA>B>B> | A>B>B>A>X"
    assert [wall.label for wall in found.walls if not wall.directed] == ["X"]
    assert len(found.cells) == 2


def test_the_maps_before_are_kept_at_a_limit() -> None:
    with limits(modules=100), pytest.raises(ModelLimitError) as caught:
        derive(read_map(K28), 99)
    assert isinstance(caught.value.partial, Development)
    assert caught.value.partial.counts[-1] == derive(read_map(K28), 5).counts[-1]
    assert str(caught.value) == (
        "Step 6 would have 112 walls or more; the limit is 100. Step 5 is the last that can be reached. "
        "Take fewer steps, or set limits(modules=...)."
    )
    with limits(modules=6), pytest.raises(ModelLimitError, match="Step 1 would have 7 walls or more; the limit is 6"):
        derive(read_map(K28), 1)
    with limits(bytes=10_000), pytest.raises(ModelLimitError, match=r"Step 4 would take about 13,440 bytes"):
        derive(read_map(K28), 99)
    with (
        limits(seconds=1e-9),
        pytest.raises(
            ModelLimitError, match=r"Step 1 was not reached in 1e-09 seconds. Step 0 is the last that can be reached"
        ),
    ):
        derive(read_map(K28), 1)


@pytest.mark.parametrize("steps", [-1, True, 1.5, "2"])
def test_steps_are_counted(steps: object) -> None:
    with pytest.raises(ModelValueError, match="must be a whole number from 0 on"):
        derive(read_map(K28), steps)  # type: ignore[call-overload]


def test_a_map_system_has_no_seed_and_no_constants() -> None:
    with pytest.raises(ModelValueError, match='A map system has no "seed"'):
        derive(read_map(K28), 1, seed=2)  # type: ignore[call-overload]


def test_a_long_map_is_shown_in_part() -> None:
    assert max(map(len, repr(derive(read_map(K28), 9)).split("\n"))) == 403


@given(st.lists(st.sampled_from("ABC"), min_size=1, max_size=8))
def test_a_cyclic_word_reads_least_from_where_it_is_said_to(letters: list[str]) -> None:
    row = [(letter, "") for letter in letters]
    first = least_rotation(row)
    assert row[first:] + row[:first] == min(row[start:] + row[:start] for start in range(len(row)))


@given(map_systems())
def test_walls_lead_from_corner_to_corner_around_each_cell(system: MapSystem) -> None:
    assert_corners_meet(maps_of(system))


def test_walls_lead_around_the_cells_of_seed_003() -> None:
    maps = derive(read_map(K29), 3)
    assert (maps.steps, len(maps)) == (3, 4)
    assert_corners_meet(maps)


def assert_corners_meet(maps: Development) -> None:
    """The corner at which a side ends is that at which the next one begins."""
    for found in maps:
        for cell in found.cells:
            turned = [side._replace(forward=not side.forward) for side in cell]
            assert found.corners(turned) == [*found.corners(cell)[1:], found.corners(cell)[0]]


def test_a_sphere_begins_with_its_meridians_and_the_cells_between_them() -> None:
    maps = derive(read_map("sphere: A> B> C<\nA> -> D>[-e]x>[+e]D>"), 1)
    assert str(maps[0]) == "B>A< | C<B< | A>C>"
    assert maps[0].boundary == ()
    assert [vertices - walls + cells for vertices, walls, cells in maps.counts] == [2, 2]
    assert [vertex.wall for vertex in maps[1].vertices] == [None, None, 0, 0]


def test_a_cell_between_meridians_is_divided_from_one_to_the_other() -> None:
    maps = derive(read_map("sphere: D>D>D>D>\nD> -> L>[-e]x>[+e]L>\nL> -> D>[+e]x>[-e]D>"), 2)
    assert maps.counts == [(2, 4, 4), (10, 16, 8), (26, 40, 16)]
    assert str(maps[1]) == " | ".join(["L>ex<L< | x>L>L<e"] * 4)


def test_cells_with_the_same_walls_are_of_one_kind_in_all_steps() -> None:
    maps = derive(read_map(K30.format("A>B>C>D>")), 4)
    kinds = [*kinds_of_cells(maps)]
    assert kinds == [[0], [0, 1], [0, 1, 2], [1, 0, 2, 3], [2, 1, 0, 3, 4]]
    assert [*kinds_of_cells(maps.up_to(2))] == kinds[:3]
    assert maps[1].edges == maps[1].walls


@pytest.mark.parametrize("text", [K28, K29, K30.format("A>B>C>D>")])
def test_markers_that_match_are_not_remarked_on(text: str) -> None:
    for steps in range(5):
        assert derive(read_map(text), steps).notes == ()


def test_markers_that_never_match_are_named_once() -> None:
    """Counter-clockwise the third example has its markers outside of its cell."""
    maps = derive(read_map(K30.format("A<D<C<B<")), 6)
    assert maps.counts[-1][2] == 1
    assert maps.notes == ("Markers of A never match up to step 6: no cell has two on its sides that fit.",)


def test_the_remarks_of_the_rules_are_those_of_the_maps() -> None:
    maps = derive(read_map("map: AAA\nA> -> A>[-x>]A>\nA -> A"), 2)
    assert maps.notes == maps.system.notes
    assert any("markers of x<" in note for note in maps.notes)


@given(map_systems())
def test_the_walls_that_divide_cells_join_the_markers_that_match(system: MapSystem) -> None:
    maps = maps_of(system)
    for before, after in pairwise(maps):
        replaced, stubs = replaced_map(before, system)
        joined = {frozenset((stub.vertex, stub.partner)) for stub in stubs if stub.partner is not None}  # some are typed twice
        assert joined == {frozenset(wall[1:3]) for wall in dividing_walls(before, after, system)}
        assert replaced.vertices == after.vertices
        assert replaced.walls == after.walls[: len(replaced.walls)]
        assert [before.counts[2], replaced.boundary] == [replaced.counts[2], after.boundary]


def test_markers_without_a_partner_are_known() -> None:
    [square] = develop(read_map(K28), 0)
    _, stubs = replaced_map(square, read_map(K28))
    found = [(stub.wall, stub.side, stub.partner) for stub in stubs]
    assert found == [(0, "-", 5), (0, "+", None), (2, "-", 4), (2, "+", None)]
