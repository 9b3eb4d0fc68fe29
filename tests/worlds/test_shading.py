"""Trees that shade one another (seed 003): a bud grows where no shoot begins in a cone above it."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

import numpy as np
import pytest

from lsys_kit import derive, draw, explain, read, system
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from tests.worlds.shading_by_hand import LONG, SHORT, WHERE, numbers_of_shoots

NEIGHBOURS = {"[T t(-later,0)]": 0, "[RU(90) f(apart) RU(-90) T t(0,0)]": 1, "[RU(-90) f(apart) RU(90) T t(-2*later,0)]": 2}


def trees(word: Iterable[Module]) -> list[int]:
    """How many shoots each tree has."""
    counts, depth = [0], 0
    for module in word:
        depth += (module.symbol == "[") - (module.symbol == "]")
        counts[-1] += module.symbol == "s"
        if module.symbol == "]" and depth == 0:
            counts.append(0)
    return counts[:-1]


def alone(tree: str) -> LSystem:
    """The model with one of its trees."""
    text = system("K22").source
    for other in NEIGHBOURS.keys() - {tree}:
        assert text.count(other) == 1
        text = text.replace(other, "")
    return read(text)


def test_the_trees_have_the_shoots_of_the_table_of_systems() -> None:
    words = derive(system("K22"), 8)
    assert (trees(words[4]), trees(words[8])) == ([0, 16, 0], [16, 64, 0])


@pytest.fixture(scope="module")
def of_mean_lengths() -> LSystem:
    text = system("K22").source
    for drawn, mean in (("uniform(80,120)", LONG), ("uniform(60,90)", SHORT), ("uniform(0.5,0.9)", WHERE)):
        assert drawn in text
        text = text.replace(drawn, str(mean))
    return read(text)


@pytest.mark.slow
@pytest.mark.parametrize("m", [1, 2, 3, 4])
@pytest.mark.parametrize("apart", [600, 350])
def test_trees_of_mean_lengths_have_the_shoots_that_an_interpreter_without_the_kit_counts(
    of_mean_lengths: LSystem, m: int, apart: int
) -> None:
    words = derive(of_mean_lengths, 18, m=m, apart=apart)
    assert [trees(word) for word in words] == numbers_of_shoots(18, m, apart)


def test_the_numbers_of_the_note_are_those_of_mean_lengths() -> None:
    counted = numbers_of_shoots(16)
    assert (counted[12], counted[16]) == ([54, 120, 16], [87, 124, 54])


@pytest.mark.parametrize("tree", NEIGHBOURS)
@pytest.mark.parametrize("seed", [0, 1])
def test_a_tree_in_the_open_shades_none_of_its_branches(tree: str, seed: int) -> None:
    start = {0: 4, 1: 0, 2: 8}[NEIGHBOURS[tree]]
    words = derive(alone(tree), start + 7, seed=seed)
    assert [max(trees(word)) for word in words[start:]] == [n * n for n in range(8)]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_a_tree_beside_an_older_one_has_fewer_shoots(seed: int) -> None:
    together = trees(derive(system("K22"), 16, seed=seed)[-1])
    for tree, number in NEIGHBOURS.items():
        lonely = max(trees(derive(alone(tree), 16, seed=seed)[-1]))
        if number == 1:
            assert together[number] > 0.9 * lonely
        else:
            assert together[number] < 0.9 * lonely


SHOOTS = (2, 6)
"""The colours of shoots, of branches and of trunks; cones have others."""


def test_branches_are_shorter_on_the_shaded_side() -> None:
    word = derive(system("K22"), 14)[-1]
    strokes = scene_of(word).segments
    across = strokes.ends[np.isin(strokes.colours, SHOOTS)][
        : trees(word)[0], 3
    ]  # the first tree's, whose older neighbour is on the right
    assert max(across) < 0.7 * -min(across)


def test_the_explanation_counts_who_shades() -> None:
    fates = [fate for fate in explain(derive(system("K22"), 12), 12) if fate.module.symbol == "b"]
    shaded = [fate for fate in fates if "b(i+1)" in fate.production or "-> d" in fate.production]
    assert shaded
    assert "sensed(4,45,55) == 0 is false where sensed(4,45,55) is " in shaded[0].refused[0]


def count(word: Iterable[Module], symbol: str) -> int:
    return sum(module.symbol == symbol for module in word)


@pytest.fixture(scope="module")
def crowded():
    return derive(system("K22"), 26, apart=400)


@pytest.mark.slow
def test_a_bud_that_has_been_idle_for_m_steps_is_dead(crowded) -> None:
    assert {module.arguments[0] for word in crowded for module in word if module.symbol == "b"} == {0, 1, 2, 3}
    impatient = derive(system("K22"), 14, m=1)
    assert {module.arguments[0] for word in impatient for module in word if module.symbol == "b"} == {0, 1}
    assert sum(count(word, "d") for word in impatient) > sum(count(word, "d") for word in crowded[:15])


def test_a_dead_branch_is_cut_off_in_the_next_step(crowded) -> None:
    dead = [_dead_branches(word) for word in crowded]
    assert sum(map(len, dead)) > 10
    assert not any(before & after for before, after in pairwise(dead))


def _dead_branches(word: Iterable[Module]) -> set[tuple[str, ...]]:
    """The branches that end in a dead bud and are not yet cut off, each by the lengths of its shoots."""
    found, branch = set(), []
    for module in word:
        branch = [] if module.symbol == "[" else [*branch, str(module)]
        if module.symbol == "d" and "z" in branch:
            found.add(tuple(part for part in branch if part.startswith(("L", "@"))))
    return found


def test_a_tree_topples_when_its_top_and_its_branches_are_dead(crowded) -> None:
    standing = [count(word, "T") for word in crowded]
    assert [step for step in range(1, 27) if standing[step] < standing[step - 1]] == [22, 24]
    up, down = (draw(crowded[step]).scene.height for step in (21, 26))
    assert up > 1000
    assert down > 1000, "the first tree still stands"
    fallen = scene_of(crowded[26]).segments
    lying = (abs(fallen.ends[:, 2]) < 1e-6) & (abs(fallen.ends[:, 5]) < 1e-6)
    assert lying[np.isin(fallen.colours, SHOOTS)].sum() > 10, "shoots of the two others lie on the ground"


@pytest.mark.slow
@pytest.mark.parametrize("m", [1, 5])
def test_a_tree_in_the_open_never_topples(m: int) -> None:
    for tree in NEIGHBOURS:
        assert count(derive(alone(tree), 24, m=m)[-1], "T") == 1


def test_an_open_bud_is_drawn_with_its_cone_and_an_idle_one_in_grey() -> None:
    word = derive(system("K22"), 17)[-1]
    strokes = scene_of(word).segments
    for colour, wanted in ((4, lambda i: i == 0), (7, lambda i: i > 0)):
        buds = [module for module in word if module.symbol == "b" and wanted(module.arguments[0])]
        tops = [module for module in word if module.symbol == "t" and module.arguments[0] >= 0 and wanted(module.arguments[1])]
        assert (strokes.colours == colour).sum() == 2 * (len(buds) + len(tops)) > 0


@pytest.mark.slow
def test_the_same_seed_gives_the_same_trees() -> None:
    assert str(derive(system("K22"), 14, seed=2)[-1]) == str(derive(system("K22"), 14, seed=2)[-1])
    assert str(draw(system("K22"), 14, seed=2)) != str(draw(system("K22"), 14, seed=3))
