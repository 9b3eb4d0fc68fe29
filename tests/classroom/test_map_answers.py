"""Rules for walls as answers: right where the maps are, however the rules are written."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest

from lsys_kit import check, map_system
from lsys_kit.classroom.exercises.kinds.maps import same_maps
from lsys_kit.classroom.exercises.registry import exercise_of
from lsys_kit.classroom.exercises.repairs import table
from lsys_kit.derivation.tissues.development import develop
from lsys_kit.derivation.tissues.edges import Side
from lsys_kit.derivation.tissues.maps import Map


def shuffled(found: Map, chance: random.Random) -> Map:
    """The same map with its walls, vertices and cells in another order."""
    walls, vertices = ([*range(len(each))] for each in (found.walls, found.vertices))
    chance.shuffle(walls)
    chance.shuffle(vertices)
    moved = {old: new for new, old in enumerate(walls)}
    cells = [tuple(Side(moved[side.wall], side.forward) for side in cell) for cell in found.cells]
    turned = [cell[1:] + cell[:1] for cell in chance.sample(cells, len(cells))]
    renamed = [
        found.walls[old]._replace(start=vertices[found.walls[old].start], end=vertices[found.walls[old].end]) for old in walls
    ]
    return replace(found, walls=tuple(renamed), cells=tuple(turned), boundary=())


@pytest.mark.parametrize("id", ["K28", "K29", "K30", "K32"])
def test_a_map_is_the_same_in_whatever_order_its_parts_are_listed(id):
    found = develop(map_system(id), 4)
    for seed, each in enumerate(found):
        assert same_maps(each, shuffled(each, random.Random(seed)))
    assert not any(same_maps(found[3], each) for each in (found[2], found[4]))


def test_maps_with_the_same_cells_and_other_neighbours_are_others():
    """Two walls C that are exchanged leave all cells as they are, and change which cells lie beside each other."""
    found = develop(map_system("K28"), 3)[3]
    inner = [
        number for number in range(len(found.walls)) if sum(side.wall == number for cell in found.cells for side in cell) == 2
    ]
    one, other = next(
        (a, b)
        for a in inner
        for b in inner
        if a < b and found.walls[a].label == found.walls[b].label and not _touching(found, a, b)
    )
    swapped = [list(cell) for cell in found.cells]
    place = next((cell, at) for cell, sides in enumerate(swapped) for at, side in enumerate(sides) if side.wall == one)
    there = next((cell, at) for cell, sides in enumerate(swapped) for at, side in enumerate(sides) if side.wall == other)
    (a, i), (b, j) = place, there
    swapped[a][i], swapped[b][j] = swapped[b][j], swapped[a][i]
    assert not same_maps(found, replace(found, cells=tuple(map(tuple, swapped))))


def _touching(found: Map, one: int, other: int) -> bool:
    return any({one, other} <= {side.wall for side in cell} for cell in found.cells)


def test_the_order_of_two_markers_at_one_vertex_does_not_matter():
    assert check("16.5", "A -> A[-C][+C]A") == check("16.5", "A -> A[+C][-C]A") == 1


def test_a_reply_names_the_part_of_the_rule_that_is_wrong():
    assert check("16.5", "A -> A[-D][+D]A").message == "The label of a marker is not right:\n  A -> A[-D][+D]A"


def test_a_reply_names_the_cell_that_should_not_be_there_where_no_part_is_found(monkeypatch):
    monkeypatch.setattr(table, "MOST_TRIED", 0)
    reply = check("16.5", "A -> A[-D][+D]A")
    assert "the walls A B A D" in reply.message
    assert "C" not in reply.message.split("clockwise")[1].split("Follow")[0]


@pytest.mark.slow
@pytest.mark.parametrize("answer", ["a -> a[-c][+c]a", "A> -> A>[-C][+C]A>", "C -> C", "map: ABAB"])
def test_rules_for_other_walls_are_told_from_rules_whose_markers_do_not_match(answer):
    assert "None of your rules is for a wall of the first cell, A B A B." in check("16.5", answer).message
    assert "None of your rules" not in check("16.5", "A -> ABA").message


def test_two_pairs_of_markers_are_not_taken_for_one_that_is_parted():
    assert "a wall lies between the two markers" in check("16.5", "A -> A[-C]A[+C]A").message
    assert "a wall lies between the two markers" not in check("16.5", "A -> A[-C][+C]A[-C][+C]A").message


def test_a_rule_that_cannot_be_read_is_answered_in_the_words_of_maps():
    assert "Walls are never erased" in check("16.5", "A -> [-C][+C]").message
    assert exercise_of("16.5").solution not in check("16.5", "A -> A[-C]A").message
