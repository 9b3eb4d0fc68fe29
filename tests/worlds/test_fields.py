"""Fields: what answers the questions of open systems. Laws first, then what a field must not do."""

from __future__ import annotations

import math
import os
import pickle
import subprocess
import sys
from itertools import pairwise, repeat

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelValueError, animate, derive, draw, explain, explore, read, write
from lsys_kit.derivation.derive import Derivation
from lsys_kit.worlds.fields import SKY, Light, Polygon, Question, Shadows, Space, Water
from lsys_kit.worlds.neighbours import Surroundings
from lsys_kit.worlds.sight import observe

coordinates = st.integers(-12, 12).map(lambda fourths: fourths / 4)
points = st.tuples(coordinates, coordinates, coordinates)
spheres = st.lists(st.tuples(points, st.sampled_from((0.3, 0.7, 1.6))), max_size=12)
SHADED = """k = 0.25 in 0 .. 1 by 0.05
field: light(k)
axiom: [F(3)@O(1)] A
A -> F ?E(0) @O(0.4) A
?E(r) : r < 9/10 -> -"""
"""A stem whose nodes ask for light, under spheres."""


class Heights:
    """A field that a student may write."""

    def answer(self, questions: list[Question], scene: Surroundings) -> list[float]:
        return [question.place[1] for question in questions]


class Bad:
    """A field that answers a question about the second step with what it was given."""

    def __init__(self, answer: object) -> None:
        self.given = answer

    def answer(self, questions: list[Question], scene: Surroundings) -> object:
        if len(questions) < 3:
            return [1] * len(questions)
        return self.given(questions) if callable(self.given) else self.given


def scene_of(found: list[tuple[tuple[float, float, float], float]]) -> Surroundings:
    return Surroundings(
        np.empty((0, 2, 3)), np.array([centre for centre, _ in found]).reshape(-1, 3), np.array([radius for _, radius in found])
    )


def at(*places: tuple[float, float, float]) -> list[Question]:
    return [Question(place, (0.0, 1.0, 0.0), (0,)) for place in places]


def plain_light(place: tuple[float, float, float], found: list[tuple[tuple[float, float, float], float]], part: float) -> float:
    """The light at a place, sphere by sphere: a ray p + t d is in a sphere where t^2 - 2 b t + c < 0."""
    total = 0.0
    for weight, direction in SKY:
        crossed = 0
        for centre, radius in found:
            away = np.subtract(centre, place)
            b, c = float(away @ direction), float(away @ away) - radius**2
            crossed += b * b - c > 1e-9 and b + math.sqrt(max(0.0, b * b - c)) > 1e-9 and any(away)
        total += weight * part**crossed
    return total


def test_the_parts_of_the_sky_are_the_whole_sky_and_its_directions_have_length_one() -> None:
    assert sum(part for part, _ in SKY) == pytest.approx(1)
    assert [math.hypot(*direction) for _, direction in SKY] == pytest.approx([1] * len(SKY))


@given(st.lists(points, min_size=1, max_size=5), spheres, st.sampled_from((0.0, 0.25, 0.5, 1.0)))
def test_light_is_that_of_a_plain_sum_over_rays_and_spheres(places, found, part) -> None:
    plain = [plain_light(place, found, part) for place in places]
    assert Light(part).answer(at(*places), scene_of(found)) == pytest.approx(plain)


def plain_shadows(
    place: tuple[float, float, float],
    found: list[tuple[tuple[float, float, float], float]],
    size: float,
    a: float,
    b: float,
    depth: int,
) -> float:
    """The light at a place, each sphere casting its pyramid of shadows downwards."""
    own, left = any(centre == place for centre, _ in found), 1.0
    x, y, z = (math.floor(value / size) for value in place)
    for centre, _ in found:
        i, j, k = (math.floor(value / size) for value in centre)
        if 0 <= (q := j - y) <= depth and abs(i - x) <= q and abs(k - z) <= q:
            left -= a / b**q
    return max(left + a * own, 0.0)


@given(st.lists(points, min_size=1, max_size=5), spheres, st.sampled_from((0.25, 0.5, 1.0)), st.integers(0, 5))
def test_shadows_are_those_of_pyramids_below_each_sphere(places, found, size, depth) -> None:
    asked = [*places, *(centre for centre, _ in found)]
    plain = [plain_shadows(place, found, size, 0.15, 1.5, depth) for place in asked]
    assert Shadows(size, 0.15, 1.5, depth).answer(at(*asked), scene_of(found)) == pytest.approx(plain)


def test_a_shadow_is_darkest_below_and_fades_from_layer_to_layer() -> None:
    below = [(0.5, -height + 0.5, 0.5) for height in range(7)]
    above, beside = (0.5, 1.5, 0.5), (1.5, 0.5, 0.5)
    light = Shadows(1, 0.2, 2, 4).answer(at(*below, above, beside, (1.5, -0.5, 0.5)), scene_of([((0.5, 0.5, 0.6), 0.1)]))
    assert light == pytest.approx([0.8, 0.9, 0.95, 0.975, 0.9875, 1, 1, 1, 1, 0.9])


def test_voxels_that_are_too_small_are_an_error() -> None:
    with pytest.raises(ModelValueError, match="too small"):
        Shadows(1e-12).answer(at((0.0, 0.0, 0.0)), scene_of([((0.0, 0.0, 0.0), 1), ((90.0, 90.0, 90.0), 1)]))


@given(points, spheres, st.integers(0, 11))
def test_no_sphere_brings_light_and_one_taken_away_takes_none(place, found, number) -> None:
    fewer = found[:number] + found[number + 1 :]
    [before], [after] = (Light().answer(at(place), scene_of(each)) for each in (found, fewer))
    assert before <= after + 1e-12 <= 1 + 2e-12


@given(points, spheres, st.integers(1, 7))
def test_an_eighth_of_a_turn_round_the_vertical_changes_no_light(place, found, eighths) -> None:
    c, s = math.cos(eighths * math.pi / 4), math.sin(eighths * math.pi / 4)

    def turned(point: tuple[float, float, float]) -> tuple[float, float, float]:
        return c * point[0] - s * point[2], point[1], s * point[0] + c * point[2]

    grown = [(centre, radius + 0.0123) for centre, radius in found]  # no ray grazes a sphere
    near = min((abs(math.dist(centre, place) - radius) for centre, radius in grown), default=1)
    if near > 1e-3:
        assert Light().answer(
            at(turned(place)), scene_of([(turned(centre), radius) for centre, radius in grown])
        ) == pytest.approx(Light().answer(at(place), scene_of(grown)))


def test_the_sphere_round_the_place_is_its_own_and_one_above_shades_it() -> None:
    own, above = ((0.0, 0.0, 0.0), 0.5), ((0.0, 5.0, 0.0), 0.5)
    assert Light().answer(at((0.0, 0.0, 0.0)), scene_of([own])) == pytest.approx([1])
    assert Light().answer(at((0.0, 0.0, 0.0)), scene_of([own, above])) == pytest.approx([1 - 0.2 * 0.75])
    assert Light().answer(at((0.0, 6.0, 0.0)), scene_of([own, above])) == pytest.approx([1]), "what is below does not shade"


@given(st.lists(points, min_size=1, max_size=5), spheres, st.sampled_from((0.5, 2.0, 50.0)))
def test_space_is_the_least_distance_from_all_spheres_but_the_own(places, found, reach) -> None:
    least = [
        min([reach, *(math.dist(place, centre) - radius for centre, radius in found if place != centre)]) for place in places
    ]
    assert Space(reach).answer(at(*places), scene_of(found)) == pytest.approx(least)


@given(st.lists(points, min_size=1, max_size=20), st.sampled_from((0.25, 1.0, 2.5)))
def test_the_shares_of_a_layer_of_soil_are_what_it_has(places, thickness) -> None:
    shares = Water(6, thickness).answer(at(*places), scene_of([]))
    layers = {math.floor(-y / thickness) for _, y, _ in places if y <= 0}
    assert sum(shares) == pytest.approx(6 * len(layers))
    assert all(share == 0 for share, (_, y, _) in zip(shares, places, strict=True) if y > 0)


def test_a_function_of_the_place_answers_what_the_turtle_knows_of_its_position() -> None:
    asked = "F(2)+(30)F {query} &(50)F(3)/(20)[+F {query}] {query}"
    by_turtle = observe(derive(read("axiom: " + asked.format(query="?P(0,0,0)")), 0)[0]).word
    by_field = observe(derive(read("field: place(x,y,z)\naxiom: " + asked.format(query="?E(0,0,0)")), 0)[0]).word
    assert [module.arguments for module in by_turtle] == [module.arguments for module in by_field]


@given(coordinates, coordinates)
def test_a_square_is_as_deep_as_its_nearest_side_is_far(x, y) -> None:
    dx, dy = abs(x) - 2, abs(y) - 2
    depth = -max(dx, dy) if dx <= 0 and dy <= 0 else -math.hypot(max(dx, 0), max(dy, 0))
    for corners in ((-2, -2, 2, -2, 2, 2, -2, 2), (-2, 2, 2, 2, 2, -2, -2, -2), (2, 2, -2, 2, -2, -2, 2, -2, 2, -2)):
        assert Polygon(*corners).answer(at((x, y, 5.0)), scene_of([])) == pytest.approx([depth])


def test_a_notch_is_outside() -> None:
    arrow = Polygon(0, 0, 4, 4, 0, 2, -4, 4)
    assert [depth > 0 for depth in arrow.answer(at((0.0, 1.0, 0.0), (0.0, 3.0, 0.0), (2.9, 3.2, 0.0)), scene_of([]))] == [
        True,
        False,
        True,
    ]


def test_a_constant_that_is_called_like_a_coordinate_is_the_constant() -> None:
    assert str(observe(derive(read("x = 7\nfield: place(x + y)\naxiom: F ?E(0)"), 0)[0]).word) == "F?E(8)"


@pytest.mark.parametrize(
    "field",
    [
        "light",
        "light(0.25)",
        "light(k/2)",
        "space(3)",
        "shadows",
        "shadows(k, 0.2, 2, 3)",
        "water(k)",
        "water(2, 1/2)",
        "polygon(0,0, 2,0, k,3)",
        "place(x^2 + y - k, z)",
    ],
)
def test_a_field_is_written_as_it_is_read(field) -> None:
    system = read(f"k = 1 in 0 .. 2 by 1\nfield: {field}\naxiom: A?E(0)")
    assert read(str(system)) == system
    assert read(str(system)).field == system.field != read("axiom: A?E(0)").field
    for notation in ("cpfg", "grogra", "mathematica"):
        with pytest.raises(LSystemError, match="field"):
            write(system, notation)


def test_an_apex_asks_a_field_that_a_student_wrote() -> None:
    apex = read("axiom: F A ?E(0)\nA > ?E(y) : y < 3 -> F A")
    assert [len(word) for word in derive(apex, 5, field=Heights())] == [3, 4, 5, 5, 5, 5]
    assert "3 segments" in repr(draw(apex, 5, field=Heights()))


def test_a_single_number_leaves_the_other_values_as_they_are_sent() -> None:
    found = observe(derive(read("axiom: F ?E(0, 7) F ?E(5, 8)"), 0)[0], Heights()).word
    assert str(found) == "F?E(1,7)F?E(2,8)"


def test_what_shades_more_lets_less_grow() -> None:
    turns = [str(derive(read(SHADED), 6, k=k)[-1]).count("-") for k in ("0", "1/2", "1")]
    assert turns == sorted(turns, reverse=True)
    assert turns[0] > turns[-1] == 0


def test_a_question_without_a_field_is_an_error_with_what_was_finished() -> None:
    with pytest.raises(ModelValueError, match=r"Nothing answers \?E\(0\).*Step 3 is the last .*field: light") as caught:
        derive(read("axiom: A(0)\nA(n) : n < 2 -> A(n+1)\nA(n) -> F ?E(0)"), 9)
    with pytest.raises(ModelValueError, match="Nothing answers"):
        derive(read("axiom: ?E(0)"), 1)
    assert isinstance(caught.value.partial, Derivation)
    assert caught.value.partial.steps == 3


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (None, "returned nothing"),
        ([1], "1 values for 3 questions"),
        ([1, 2, math.nan], "nan at .0, 3, 0., which is no finite"),
        ([1, 2, math.inf], "no finite number"),
        ([1, 2, 10**400], "no finite number"),
        ([1, 2, 3, 4], "more than 3 values for 3"),
        (lambda questions: repeat(1), "more than 3 values for 3 questions"),
        ([1, 2, repeat(1)], "no number"),
        ([1, 2, "3"], "no number"),
        ([1, 2, None], "no number"),
        ([1, 2, (1, 2)], "2 values"),
        (7, "TypeError"),
        ([1, 2, 1j], "no number"),
        (lambda questions: 1 / 0, "ZeroDivisionError"),
        (lambda questions: questions[9], "IndexError"),
    ],
)
def test_a_bad_field_is_an_error_that_keeps_the_finished_steps(given, message) -> None:
    grows = read("axiom: A\nA -> F ?E(0) A\n?E(r) -> ?E(r)")
    with pytest.raises(ModelValueError, match=message) as caught:
        derive(grows, 9, field=Bad(given))
    assert caught.value.partial.lengths == derive(grows, 3, field=Heights()).lengths


@pytest.mark.parametrize("field", [3, "light", len, Heights])
def test_what_is_no_field_is_refused(field: object) -> None:
    with pytest.raises(ModelValueError, match="Heights is a class" if field is Heights else "a method answer"):
        derive(read("axiom: ?E(0)"), 1, field=field)


@pytest.mark.parametrize("shows", [draw, animate])
def test_who_draws_is_told_of_a_bad_field_too(shows) -> None:
    grows = read("axiom: A\nA -> F ?E(0) A\n?E(r) -> ?E(r)")
    for field, message in ((Bad([1, 2, "3"]), "no number"), (Bad(None), "returned nothing"), (None, "the model has no field")):
        with pytest.raises(ModelValueError, match=message) as caught:
            shows(grows, 5, field=field)
        assert caught.value.partial.steps == (1 if field is None else 3)


def test_the_explorer_takes_the_field_that_the_text_names_and_no_other() -> None:
    with pytest.raises(ModelValueError, match="no field of Python"):
        explore(read("axiom: F A ?E(0)\nA > ?E(y) : y < 3 -> F A"), 5, field=Heights())


@pytest.mark.parametrize(
    "text",
    [
        "light(2)",
        "light(-1)",
        "shadows(0)",
        "shadows(1, 0)",
        "shadows(1, 1, 1)",
        "shadows(1, 1, 2, 0.5)",
        "shadows(1, 1, 2, 99)",
        "water(1, 0)",
        "polygon(0,0,1,0,1,1,2)",
        "light(log(-1))",
    ],
)
def test_a_field_with_impossible_values_is_an_error(text) -> None:
    with pytest.raises(LSystemError):
        derive(read(f"field: {text}\naxiom: ?E(0)"), 1)


def test_the_steps_asked_for_at_once_are_those_asked_for_one_by_one() -> None:
    at_once, singly = derive(read(SHADED), 7), derive(read(SHADED), 0)
    for step in range(1, 8):
        singly = singly.to(step)
    assert [str(word) for word in singly] == [str(word) for word in at_once]
    resumed = pickle.loads(pickle.dumps(derive(read(SHADED), 3))).to(7)
    assert [str(word) for word in resumed] == [str(word) for word in at_once]
    assert all(len(a) < len(b) for a, b in pairwise(at_once))


@pytest.mark.slow
def test_every_process_gets_the_same_answers() -> None:
    program = "import sys; from lsys_kit import derive, read; print(derive(read(sys.stdin.read()), 7)[-1])"
    texts = {
        subprocess.run(
            [sys.executable, "-c", program],
            input=SHADED,
            capture_output=True,
            text=True,
            check=True,
            env={**os.environ, "PYTHONHASHSEED": seed},
        ).stdout
        for seed in ("1", "2")
    }
    assert texts == {f"{derive(read(SHADED), 7)[-1]}\n"}


def test_an_explanation_tells_the_answer() -> None:
    explained = explain(derive(read("field: place(y)\naxiom: F A ?E(0)\nA > ?E(y) : y < 3 -> F A"), 2), 2)
    assert "y = 2" in str(explained) or "?E(2)" in str(explained)
