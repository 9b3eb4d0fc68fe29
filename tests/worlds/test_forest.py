"""Trees that compete for light: what light gives them, what they shed, and that trees far apart do not know of one another."""

from __future__ import annotations

import json
from itertools import pairwise

import pytest

from lsys_kit import derive, explore, limits, read, system
from lsys_kit.classroom.panel.books.book import book
from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.turtle.space import trace_in_space


def count(word: Word, symbol: str) -> int:
    return sum(module.symbol == symbol for module in word)


def leaves(word: Word) -> list[tuple[float, float]]:
    """The living leaf clusters: what each makes, and how long it will live."""
    return [
        (float(module.arguments[0]), float(module.arguments[1]))
        for module in word
        if module.symbol == "L" and module.arguments[1] > 0
    ]


@pytest.fixture(scope="module")
def two():
    return derive(system("K23"), 17)


@pytest.mark.slow
def test_a_leaf_cluster_makes_eight_times_its_light_less_one_and_lives_five_steps(two) -> None:
    assert all(0 <= made <= 7 and 1 <= life <= 5 for word in two for made, life in leaves(word))
    assert leaves(two[2])[0] == (7, 5), "the first cluster stands in full light"


@pytest.mark.slow
def test_a_branch_without_flow_is_cut_off_and_gone_a_step_later(two) -> None:
    shed = [step for step, word in enumerate(two) if count(word, "%")]
    assert shed
    for step, (word, after) in enumerate(pairwise(two)):
        flows = [module.arguments for module in word if module.symbol == "!"]
        assert (count(after, "%") > 0) == any(flow <= 0 and shoots < 25 for shoots, flow in flows), step


@pytest.mark.slow
def test_a_shoot_that_goes_on_takes_the_other_side_and_one_alone_turns_by_five_degrees(two) -> None:
    turns = {
        (module.symbol, abs(module.arguments[0]), module.arguments[0] > 0)
        for word in two
        for module in word
        if module.symbol in "+-" and module.arguments
    }
    assert turns == {("-", angle, left) for angle in (5, 20) for left in (True, False)} | {("+", 32, True), ("+", 32, False)}


def test_a_branch_without_flow_that_stays_takes_nothing_from_the_one_that_bears_it() -> None:
    grown = read(str(system("K23")).replace("axiom: S", "axiom: !(1,1) L(2,0,1) ?E(1) [!(30,-4) L(0,0,1)] [!(5,3) L(0,0,1)]"))
    shoots, flow = next(module.arguments for module in derive(grown, 1)[-1] if module.symbol == "!")
    assert shoots == 35
    assert flow == pytest.approx(2 + 0 + 3 - 0.32 * 35**0.75)


@pytest.mark.slow
def test_two_trees_lean_away_from_one_another(two) -> None:
    centres = trace_in_space(two[15]).discs.centres[:, 0]
    assert centres.min() < -4 < 4 + 4 < centres.max(), "crowns are wider on the outer sides"
    inner = ((centres > 0) & (centres < 4)).sum()
    assert inner < ((centres <= 0) | (centres >= 4)).sum()


@pytest.mark.slow
def test_a_tree_that_stands_close_has_less_leaves_than_one_that_stands_free() -> None:
    made = [sum(flow for flow, _ in leaves(derive(system("K23"), 14, apart=apart)[-1])) for apart in (2, 4, 12)]
    assert made == sorted(made)
    assert made[0] < 0.9 * made[-1]


def test_trees_that_cannot_shade_one_another_grow_as_if_alone() -> None:
    far = read(str(system("K23")).replace("apart = 4 in 2 .. 12 by 1", "apart = 4000 in 2 .. 4000 by 1"))
    alone, three = ([len(word) - 1 for word in derive(far, 10, trees=n)][1:] for n in (1, 3))
    assert [3 * length + 2 for length in alone] == three, "as many modules, each tree, in each step"


def test_nine_trees_stand_in_rows_of_three() -> None:
    word = derive(system("K23"), 1, trees=9)[-1]
    assert [module.arguments for module in word if module.symbol == "@M"] == [(4 * (i % 3), 0, -4 * (i // 3)) for i in range(9)]


@pytest.mark.slow
def test_the_same_forest_grows_whatever_the_seed_is_and_in_which_steps_it_is_asked_for(two) -> None:
    singly = derive(system("K23"), 0, seed=5)
    for step in (3, 9, 12):
        singly = singly.to(step)
    assert [str(word) for word in singly] == [str(two[step]) for step in range(13)]


def test_opaque_leaves_shed_more_than_clear_ones() -> None:
    dark, clear = (derive(system("K23"), 10, k=k)[-1] for k in (0, 1))
    assert len(dark) < len(clear)
    assert count(clear, "%") == 0
    assert {made for made, _ in leaves(derive(system("K23"), 8, k=1)[-1])} <= {1, 7}, "no light is lost where leaves are clear"


@pytest.mark.slow
def test_the_panel_shows_the_forest_with_a_slider_for_each_constant() -> None:
    panel = explore("K23")
    assert {"k", "apart", "trees", "life", "rest", "size"} <= set(panel.trait_names())
    with limits(seconds=3_600):
        made = book(system("K23"))
    assert made["steps"] >= 15
    assert len(json.dumps(made)) < 2_000_000
