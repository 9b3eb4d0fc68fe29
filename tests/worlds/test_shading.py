"""Trees that shade one another (seed 003): a bud grows where no shoot begins in a cone above it."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

from lsys_kit import derive, draw, explain, read, system, write
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem

NEIGHBOURS = {"[t(0 - 4)]": 0, "[RU90 f600 RU-90 t(0)]": 1, "[RU-90 f600 RU90 t(0 - 8)]": 2}


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
    text = write(system("K22"))
    for other in NEIGHBOURS.keys() - {tree}:
        assert text.count(other) == 1
        text = text.replace(other, "[ ]")
    return read(text, "grogra")


def test_the_trees_have_the_shoots_of_the_table_of_systems() -> None:
    words = derive(system("K22"), 8)
    assert (trees(words[4]), trees(words[8])) == ([0, 16, 0], [16, 64, 0])


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


def test_branches_are_shorter_on_the_shaded_side() -> None:
    word = derive(system("K22"), 14)[-1]
    across = scene_of(word).segments.ends[:trees(word)[0], 3]  # the first tree's, whose older neighbour stands on the right
    assert max(across) < 0.7 * -min(across)


def test_the_explanation_counts_who_shades() -> None:
    fates = [fate for fate in explain(derive(system("K22"), 12), 12) if fate.module.symbol == "b"]
    shaded = [fate for fate in fates if fate.production == "no production matches"]
    assert shaded
    assert "c(45, 1) = 0 is false where c is " in shaded[0].refused[0]


def test_the_same_seed_gives_the_same_trees() -> None:
    assert str(derive(system("K22"), 14, seed=2)[-1]) == str(derive(system("K22"), 14, seed=2)[-1])
    assert str(draw(system("K22"), 14, seed=2)) != str(draw(system("K22"), 14, seed=3))
