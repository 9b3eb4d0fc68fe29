"""Those who ask are answered together: what each is told is what a plain loop over all shoots finds, whoever else asks."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit import derive, read
from lsys_kit.derivation.core.words import Word
from lsys_kit.worlds.fields import Light, Question, Shadows, Space
from lsys_kit.worlds.neighbours import Surroundings
from lsys_kit.worlds.sight import TurtleObservation, observe

FUNCTIONS = {1: (1,), 2: (1,), 4: (50, 1), 7: (), 9: (35, 1)}
ASKING = "\n".join(f"x : sensed({', '.join(map(str, (number, *values)))}) > 0 -> y" for number, values in FUNCTIONS.items())


def scattered(count: int, seed: int, flat: bool = False) -> Word:
    """A word of branches at random places, each of two or three shoots that end in one who asks."""
    chance = random.Random(seed)

    def branch() -> str:
        x, y, z = (round(chance.uniform(-5, 5), 2) for _ in range(3))
        turn = f"+({chance.randrange(360)})" if flat else f"/({chance.randrange(360)}) &({chance.randrange(180)})"
        shoots = " +(40) ".join(f"F({length})" for length in chance.choices((0.5, 1, 2), k=chance.randint(2, 3)))
        return f"[ @M({x},{y},{0 if flat else z}) {turn} {shoots} x ]"

    return derive(read(f"axiom: x {' '.join(branch() for _ in range(count))}\n{ASKING}"), 0)[0]


def plain(sight: TurtleObservation, at: int, function: int) -> float:
    """The answer by a loop over all shoots."""
    place, ends = sight.places[at], sight.shoots.ends
    own = place.shoot
    mother = int(sight.shoots.mothers[own]) if own >= 0 else own
    tip = ends[own, 1] if own >= 0 else np.array(place.position)
    head = (tip - ends[own, 0]) / np.linalg.norm(tip - ends[own, 0]) if own >= 0 else np.array(place.frame[0])
    seen = [n for n, (start, end) in enumerate(ends) if n != own and math.dist(start, end) >= 1 - 1e-9]

    def within(point: np.ndarray, axis: np.ndarray, angle: float) -> bool:
        return bool((point - tip) @ axis >= math.cos(math.radians(angle)) * math.dist(point, tip) - 1e-9)

    if function == 7:
        return math.degrees(math.acos(head[2]))
    if function == 4:
        return sum(math.dist(ends[n, 0], tip) > 1e-9 and within(ends[n, 0], np.array((0, 0, 1.0)), 50) for n in seen)
    if function == 1:
        return min((slant(*(ends[n] - tip)[:, ::2]) for n in seen), default=math.inf)
    points = [point for n in seen if n != mother for point in ends[n]]
    return min((math.dist(point, tip) for point in points if function == 2 or within(point, head, 35)), default=math.inf)


def slant(start: np.ndarray, end: np.ndarray) -> float:
    """The least angle from the vertical among points of a stroke above the origin: it is at an end, or straight up."""
    (x0, z0), (x1, z1) = start, end
    if x0 * x1 <= 0 and x0 != x1 and z0 - x0 * (z1 - z0) / (x1 - x0) > 1e-9:
        return 0.0
    return min((math.degrees(math.atan2(abs(x), z)) for x, z in (start, end) if z > 1e-9), default=math.inf)


def asking(sight: TurtleObservation) -> list[int]:
    return [at for at, module in enumerate(sight.word) if module.symbol == "x"]


@pytest.mark.slow
@pytest.mark.parametrize("function", FUNCTIONS)
@pytest.mark.parametrize(("count", "flat"), [(0, False), (3, False), (60, False), (60, True)])
def test_the_answers_are_those_of_a_loop_over_all_shoots(function: int, count: int, flat: bool) -> None:
    sight = observe(scattered(count, 3, flat))
    for at in asking(sight):
        assert float(sight.sees(at, function, *FUNCTIONS[function])) == pytest.approx(plain(sight, at, function), abs=2e-6)


@pytest.mark.slow
@settings(max_examples=30)
@given(st.integers(1, 150), st.integers(0, 99), st.booleans(), st.sampled_from(list(FUNCTIONS)))
def test_the_answers_are_those_of_a_loop_in_any_scene(count: int, seed: int, flat: bool, function: int) -> None:
    sight = observe(scattered(count, seed, flat))
    for at in asking(sight):
        assert float(sight.sees(at, function, *FUNCTIONS[function])) == pytest.approx(plain(sight, at, function), abs=2e-6)


@pytest.mark.slow
@pytest.mark.parametrize("function", FUNCTIONS)
def test_an_answer_does_not_depend_on_who_else_asks_nor_on_the_order(function: int) -> None:
    word = scattered(80, 5)
    forwards, backwards = observe(word), observe(word)
    answers = {at: forwards.sees(at, function, *FUNCTIONS[function]) for at in asking(forwards)}
    assert {at: backwards.sees(at, function, *FUNCTIONS[function]) for at in reversed(asking(backwards))} == answers
    for at in asking(forwards)[::17]:
        assert observe(word).sees(at, function, *FUNCTIONS[function]) == answers[at]


def test_values_of_its_own_are_answered_to_each() -> None:
    sight = observe(scattered(40, 8))
    for at in asking(sight):
        assert sight.sees(at, 9, at % 180, 1) == observe(sight.word).sees(at, 9, at % 180, 1)


@pytest.mark.parametrize("field", [Light(), Space(2), Shadows()])
def test_a_field_answers_each_as_if_alone(field: Light | Space | Shadows) -> None:
    chance = np.random.default_rng(4)
    scene = Surroundings(np.empty((0, 2, 3)), chance.uniform(-4, 4, (300, 3)), chance.uniform(0.1, 1, 300))
    asked = [Question(tuple(place), (0.0, 1.0, 0.0), (0,)) for place in [*chance.uniform(-4, 4, (50, 3)), *scene.centres[:9]]]
    together = list(field.answer(asked, scene))
    assert [answer for question in asked for answer in field.answer([question], scene)] == together
    assert len(set(together)) > 5
