"""Which settings a page holds: every slider moves, what is asked for is there, and Python and the page agree on where it is."""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from math import prod
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
from playwright.sync_api import Browser, Page

from lsys_kit.classroom.panel.controls import slider
from lsys_kit.classroom.panel.held import SEED, Choice, Held, constant_choice, fewest, held_text, planned, seed_choice, settings
from lsys_kit.notation.model.arithmetic import number_text
from tests.classroom.front_end import joined


@st.composite
def constant_choices(draw: st.DrawFn) -> Choice:
    low, step = draw(st.integers(-3, 3)), draw(st.sampled_from((1, Fraction(1, 10), 2)))
    values = [low + step * number for number in range(draw(st.integers(1, 60)))]
    some = st.sampled_from(values)
    return constant_choice(values, draw(some), draw(st.sets(some, max_size=2)))


CHOICES = st.dictionaries(st.sampled_from("abcd"), constant_choices(), max_size=4)
SEEDS = st.integers(-20, 10_000).map(seed_choice)
ALL = st.tuples(CHOICES, st.none() | SEEDS).map(lambda pair: pair[0] | ({} if pair[1] is None else {SEED: pair[1]}))
ROOM = st.integers(1, 300)


def away(held: Held, setting: dict[str, Any]) -> set[str]:
    return {name for name, value in setting.items() if value != held.first[name]}


# --- what is chosen -----------------------------------------------------------------------------------------------------------


@given(constant_choices())
def test_each_choice_has_fewer_values_and_always_both_ends_and_the_first_one(choice: Choice) -> None:
    assert all(len(fewer) < len(more) for more, fewer in pairwise(choice.choices))
    for each in choice.choices:
        assert {*each} <= {*choice.choices[0]}
        assert list(each) == sorted({*each})
        assert {choice.first, choice.choices[0][0], choice.choices[0][-1]} <= {*each}
    assert len(choice.choices[-1]) <= 6  # ends, first value, 0, and the two asked for


def test_what_is_asked_for_is_never_left_out() -> None:
    assert all({69, 70} <= set(each) for each in constant_choice(range(20, 111), 60, {69, 70}).choices)


def test_the_values_left_are_round() -> None:
    tenths = [Fraction(number, 1000) for number in range(1500, 3001)]
    fewer = constant_choice([*tenths, Fraction("3.0005")], Fraction("2.167")).choices
    assert {Fraction(number, 10) for number in range(15, 31)} | {Fraction("2.167"), Fraction("3.0005")} in map(set, fewer)


def test_odd_values_stay_odd() -> None:
    assert all(value % 2 for each in constant_choice(range(1, 40, 2), 7).choices for value in each)


@given(st.integers(-100, 10_000))
def test_seeds_come_in_whole_rows_from_that_of_the_first_one(seed: int) -> None:
    for seeds in seed_choice(seed).choices:
        assert seeds[0] % 9 == 0
        assert seeds[0] <= seed < seeds[0] + 9
        assert [*seeds] == [*range(int(seeds[0]), int(seeds[0]) + len(seeds))]


@given(ALL, ROOM)
def test_every_slider_moves_and_a_page_holds_no_more_than_it_has_room_for(choices: dict[str, Choice], most: int) -> None:
    held = planned(choices, (), most)
    assert held.values.keys() == choices.keys()
    for name, values in held.values.items():
        assert values in choices[name].choices
        assert held.first[name] == choices[name].first
    coarsest = sum(len(choice.choices[-1]) - 1 for choice in choices.values()) + 1
    assert len([*settings(held)]) <= max(most, coarsest)


@given(ALL)
def test_where_there_is_room_for_all_combinations_they_are_there(choices: dict[str, Choice]) -> None:
    many = prod(len(choice.choices[0]) for choice in choices.values())
    assume(many < 5_000)
    held = planned(choices, (), 2 * many)
    assert len([*settings(held)]) == many
    assert {name: choice.choices[0] for name, choice in choices.items()} == held.values


@given(ALL, ROOM)
def test_a_slider_that_does_not_move_together_with_others_moves_alone(choices: dict[str, Choice], most: int) -> None:
    held = planned(choices, (), most)
    found = [*settings(held)]
    assert len({json.dumps(each, default=str) for each in found}) == len(found)
    for each in found:
        left = away(held, each)
        assert left <= {*held.together} or len(left) == 1
    for name in held.alone:
        assert {each[name] for each in found} == {*held.values[name]}


@given(ALL.filter(lambda choices: len(choices) > 1), ROOM)
def test_what_is_asked_for_together_is_held_together(choices: dict[str, Choice], most: int) -> None:
    asked = [*choices][:2]
    held = planned(choices, asked, most)
    assert {*asked} <= {*held.together}
    floor = prod(len(choices[name].choices[-1]) for name in asked)
    rest = sum(len(choice.choices[-1]) - 1 for name, choice in choices.items() if name not in asked)
    assert len([*settings(held)]) <= max(most, floor + rest)


@given(ALL, ROOM)
def test_sliders_for_which_there_is_no_room_are_left_out(choices: dict[str, Choice], most: int) -> None:
    held = fewest(choices, most)
    assert len([*settings(held)]) <= most
    for name in choices.keys() - held.values.keys():
        assert len([*settings(held)]) + len(choices[name].choices[-1]) - 1 > most


# --- what is said -------------------------------------------------------------------------------------------------------------

FREE = Held({"a": 1, "b": 2}, {"a": (1, 2), "b": (2, 3)}, ("a", "b"))


@pytest.mark.parametrize(
    ("fixed", "held", "said"),
    [
        ({}, Held(), ""),
        ({}, FREE, ""),
        ({}, Held({"a": 1}, {"a": (1, 2)}), ""),
        ({"k": Fraction(5, 2), SEED: 7}, Held(), "Fixed on this page: k = 2.5, seed = 7."),
        ({}, Held({SEED: 0}, {SEED: (*range(9), 30)}), "This page holds 10 seeds."),
        (
            {},
            Held({**FREE.first, "c": 1}, {**FREE.values, "c": (1, 4)}, ("a", "b")),
            "This page holds 2 of the 4 values of c. c moves alone: the other sliders then go back to their first values.",
        ),
    ],
)
def test_a_page_says_what_does_not_move_and_how_the_rest_does(fixed: dict[str, Any], held: Held, said: str) -> None:
    assert held_text(fixed, held, {"a": (1, 2), "b": (2, 3), "c": range(1, 5)}) == said


# --- in a browser -------------------------------------------------------------------------------------------------------------


def model(held: Held) -> dict[str, Any]:
    """What a page knows of the settings that it holds."""
    constants = [slider(name, held.values[name], held.first[name]) for name in held.values if name != SEED]
    return {
        "constants": constants,
        "chance": SEED in held.values,
        "seed": held.first.get(SEED, 0),
        "together": held.together,
        "seeds": [*map(number_text, held.values.get(SEED, ()))],
    }


ROWS = """([model, settings]) => {{ {scripts}
  const held = heldSettings(model), rows = settings.map((each) => held.rowAt(held.placesOf(each)));
  const places = settings.map(held.placesOf);
  const moves = places.flatMap((from) => from.flatMap((_, i) => [0, 1, -1].map((way) => {{
    const to = from.map((place, j) => (j === i ? Math.max(0, place + way) : place));
    const texts = i < model.constants.length ? model.constants[i].texts : model.seeds;
    if (to[i] >= texts.length) return true;
    const there = held.settled(to, from), held_before = held.rowAt(to) >= 0;
    return held.rowAt(there) >= 0 && there[i] === to[i] && (!held_before || there.join() === to.join())
      && (held.told(to, there) === null) === held_before;
  }})));
  return [rows, moves.every(Boolean)];
}}"""


@pytest.fixture(scope="module")
def blank(browser: Browser) -> Iterator[Page]:
    tab = browser.new_page()
    yield tab
    tab.close()


@pytest.mark.slow
@hypothesis_settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(ALL, st.integers(1, 60), st.booleans())
def test_the_page_finds_the_book_of_each_setting_and_stays_at_what_it_holds(
    blank: Page, choices: dict[str, Choice], most: int, joint: bool
) -> None:
    held = planned(choices, [*choices][:2] if joint and len(choices) > 1 else (), most)
    texts = [{name: number_text(value) for name, value in each.items()} for each in settings(held)]
    asked = [
        {"constants": {name: text for name, text in each.items() if name != SEED}, "seed": int(each.get(SEED, 0))}
        for each in texts
    ]
    rows, stays = blank.evaluate(ROWS.format(scripts=joined("held")), [model(held), asked])
    assert rows == [*range(len(asked))]
    assert stays
