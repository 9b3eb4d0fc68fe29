"""What is seen of a word: laws first, then small scenes that can be checked by hand."""

from __future__ import annotations

import math
from itertools import chain

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import ModelLimitError, ModelValueError, derive, limits, read
from lsys_kit.budget import Task
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.engines.stepping import SteppingEngine
from lsys_kit.derivation.engines.stepwise import Stepper
from lsys_kit.geometry.turtle.space import trace_in_space
from lsys_kit.notation.model.expressions import Apply, Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.worlds.sight import TurtleObservation, observe
from tests.derivation.random_systems import CHANCE, CONTEXT, CUT, REPETITION, systems, systems_with

FUNCTIONS = {1: (1,), 2: (1,), 4: (60, 1), 7: (), 9: (60, 1)}
ASKING = tuple(
    Production((Pattern("x"),), (), Apply(">", (Apply("sensed", (Number(number), *map(Number, values))), Number(0))))
    for number, values in FUNCTIONS.items()
)
"""Rules that make modules x ask; they are never applied here."""


def word_of(modules: str | list[Pattern], **settings) -> Word:
    """A word as it is: its modules parted by blanks, such as `F(2)` or `+(45)`, and those called x ask."""
    if isinstance(modules, str):
        modules = [
            Pattern(symbol, tuple(Number(float(value)) for value in values.rstrip(")").split(",") if value))
            for symbol, _, values in (part.partition("(") for part in modules.split())
        ]
    return derive(LSystem(tuple(modules), ASKING, **settings), 0)[0]


def asked(sight: TurtleObservation, number: int, *values: float) -> list[float]:
    """What a function answers to the modules x of a word, one after another."""
    return [float(sight.sees(position, number, *values)) for position, module in enumerate(sight.word) if module.symbol == "x"]


def all_answers(word: Word) -> list[list[float]]:
    sight = observe(word)
    return [asked(sight, number, *values) for number, values in FUNCTIONS.items()]


degrees = st.integers(-72, 72).map(lambda tens: Number(5 * tens))
lengths = st.integers(1, 6).map(lambda halves: Number(halves / 2))
moves = st.one_of(
    st.builds(lambda symbol, value: [Pattern(symbol, (value,)), Pattern("x")], st.sampled_from("FFf"), lengths),
    st.builds(lambda symbol, value: [Pattern(symbol, (value,))], st.sampled_from("+&/"), degrees),
)
plants = st.recursive(
    st.lists(moves, min_size=1, max_size=5).map(lambda parts: list(chain.from_iterable(parts))),
    lambda inner: st.lists(inner | inner.map(lambda word: [Pattern("["), *word, Pattern("]")]), min_size=1, max_size=4).map(
        lambda parts: list(chain.from_iterable(parts))
    ),
    max_leaves=8,
)


@given(systems_with({CONTEXT}) | systems_with({CHANCE, REPETITION}) | systems_with({CUT, CONTEXT}) | systems())
def test_a_system_without_questions_derives_the_same_in_a_world(system: LSystem) -> None:
    alone = derive(system, 3, seed=5)
    looked_at = Derivation(SteppingEngine(Stepper(States(system), 5), None, observe)).to(3)
    assert list(map(str, looked_at)) == list(map(str, alone))
    assert looked_at.lengths == alone.lengths
    assert alone.sight(2) is None


@given(plants)
def test_a_query_module_behind_a_stroke_has_the_end_of_the_stroke(modules: list[Pattern]) -> None:
    query = Pattern("?P", tuple(map(Number, (0, 0, 0))))
    word = word_of([query if module.symbol == "x" else module for module in modules])
    places = [module.arguments for module in observe(word).word if module.symbol == "?P"]
    behind = [modules[at - 1].symbol == "F" for at, module in enumerate(modules) if module.symbol == "x"]
    found = [place for place, drawn in zip(places, behind, strict=True) if drawn]
    ends = trace_in_space(word).segments.ends[:, 3:]
    expected = np.column_stack((ends[:, 0], ends[:, 2], -ends[:, 1]))
    assert np.array(found, float).reshape(-1, 3) == pytest.approx(expected, abs=2e-9)


@given(plants, st.tuples(degrees, degrees, degrees))
def test_the_turtles_axes_are_told_at_right_angles(modules: list[Pattern], turns: tuple[Number, ...]) -> None:
    queries = [Pattern(symbol, tuple(map(Number, (0, 0, 0)))) for symbol in ("?H", "?L", "?U")]
    prefix = [Pattern(symbol, (turn,)) for symbol, turn in zip("+&/", turns, strict=True)]
    word = [module for module in observe(word_of([*prefix, *modules, *queries])).word if module.symbol in ("?H", "?L", "?U")]
    head, left, up = (np.array(module.arguments, float) for module in word)
    assert np.cross(head, left) == pytest.approx(up, abs=1e-8)
    assert [head @ head, left @ left, head @ left] == pytest.approx([1, 1, 0], abs=1e-8)


@given(plants, lengths, st.tuples(degrees, degrees, degrees))
def test_moving_and_turning_a_whole_plant_changes_no_distance(
    modules: list[Pattern], far: Number, turns: tuple[Number, ...]
) -> None:
    prefix = [Pattern("f", (far,)), *(Pattern(symbol, (turn,)) for symbol, turn in zip("+&/", turns, strict=True))]
    here, there = observe(word_of(modules)), observe(word_of([*prefix, Pattern("f", (far,)), *modules]))
    for number, values in ((2, (1,)), (9, (180, 1))):
        assert asked(there, number, *values) == pytest.approx(asked(here, number, *values), abs=1e-8)


@given(plants, lengths, degrees)
def test_moving_a_plant_to_another_place_changes_nothing(modules: list[Pattern], far: Number, turn: Number) -> None:
    back = Number(-float(turn.value))
    prefix = [Pattern("+", (turn,)), Pattern("f", (far,)), Pattern("+", (back,))]
    inclinations = asked(observe(word_of(modules)), 7)
    assert asked(observe(word_of([*prefix, *modules])), 7) == pytest.approx(inclinations, abs=1e-6)


@given(plants)
def test_twice_as_large_a_plant_has_twice_the_distances(modules: list[Pattern]) -> None:
    larger = [Pattern(m.symbol, (Number(2 * float(m.arguments[0].value)),)) if m.symbol in "Ff" else m for m in modules]
    assert asked(observe(word_of(larger)), 2, 2) == pytest.approx(
        [2 * d for d in asked(observe(word_of(modules)), 2, 1)], abs=1e-8
    )


def by_definition(word: Word, at: int, least: float) -> float:
    """Function 2 read literally: of all shoots but the last on the branch and its mother the nearest begin or end point."""
    branch, stack, mothers, lengths, shoot = [], [], [], [], None
    for position, module in enumerate(word):
        if position == at:
            shoot = branch[-2:] if branch else []
        if module.symbol == "F":
            mothers.append(branch[-1:])
            lengths.append(float(module.arguments[0]))
            branch = [*branch, len(lengths) - 1]
        elif module.symbol == "[":
            stack.append(branch)
        elif module.symbol == "]":
            branch = stack.pop()
    ends = trace_in_space(word).segments.ends
    assert shoot
    points = [ends[n, i : i + 3] for n in range(len(ends)) for i in (0, 3) if n not in shoot and lengths[n] >= least]
    return min((math.dist(ends[shoot[-1], 3:], point) for point in points), default=math.inf)


@pytest.mark.slow
@given(plants, st.sampled_from((0.5, 1, 2)))
def test_the_nearest_shoot_is_that_of_the_definition(modules: list[Pattern], least: float) -> None:
    word = word_of([Pattern("F", (Number(1),)), *modules])
    sight = observe(word)
    for position, module in enumerate(word):
        if module.symbol == "x":
            assert float(sight.sees(position, 2, least)) == pytest.approx(by_definition(word, position, least), abs=1e-8)


def test_the_nearest_of_many_shoots_is_found_wherever_they_stand() -> None:
    rng = np.random.default_rng(7)
    places = rng.normal(size=(400, 3)) * (50, 1, 5)
    prefix = " ".join(f"[ @M({x},{y},{z}) F(1) x ]" for x, y, z in places)
    word = word_of(prefix)
    ends = trace_in_space(word).segments.ends
    points = ends.reshape(-1, 3)
    expected = [np.delete(np.linalg.norm(points - tip, axis=1), (2 * n, 2 * n + 1)).min() for n, tip in enumerate(ends[:, 3:])]
    assert asked(observe(word), 2, 1) == pytest.approx(expected, abs=1e-8)


@given(plants, st.integers(0, 18))
def test_a_wider_cone_shows_nothing_farther(modules: list[Pattern], tens: int) -> None:
    sight = observe(word_of(modules))
    narrow, wide, all_around = (asked(sight, 9, angle, 1) for angle in (10 * tens, 10 * tens + 10, 180))
    assert all(a >= b >= c for a, b, c in zip(narrow, wide, all_around, strict=True))
    assert all_around == asked(sight, 2, 1)


def test_the_nearest_point_may_lie_straight_behind() -> None:
    """The turns are a right angle, but for a rounding error."""
    word = derive(read("axiom: F(0.5) +(-100) +(-350) F(1) F(0.5) F(1) x\nx -> F(sensed(2, 1))"), 0)[0]
    assert observe(word).sees(len(word) - 1, 2, 1) == 1.5


@given(plants)
def test_nobody_is_answered_with_something_that_is_no_number(modules: list[Pattern]) -> None:
    answers = [answer for row in all_answers(word_of(modules)) for answer in row]
    assert all(answer >= 0 for answer in answers)


def test_a_lonely_shoot_sees_no_other() -> None:
    assert asked(observe(word_of("F(2) F(3) x")), 2, 1) == [math.inf]
    assert asked(observe(word_of("x")), 2, 1) == [math.inf]


def test_a_shoot_sees_its_grandmother() -> None:
    assert asked(observe(word_of("F(2) F(3) F(4) x")), 2, 1) == [7]


def test_a_short_shoot_is_not_seen() -> None:
    sight = observe(word_of("F(10) [ +(90) F(0.5) ] [ -(90) F(3) ] x"))
    assert asked(sight, 2, 0.5) == [0]
    assert asked(observe(word_of("[ F(10) ] f(5) +(90) [ F(0.5) ] f(1) F(2) x")), 2, 1) == [pytest.approx(math.hypot(3, 5))]
    assert asked(observe(word_of("[ F(10) ] f(5) +(90) [ F(0.5) ] f(1) F(2) x")), 2, 0.5) == [2.5]


def test_a_shoot_of_another_colour_is_not_seen() -> None:
    word = word_of("F(10) [ P(2) RU(90) f(3) F(1) ] [ P(4) RU(-90) f(2) F(1) ] RL(90) F(1) x", turtle="grogra")
    sight = observe(word)
    assert asked(sight, 2, 1) == [pytest.approx(math.sqrt(5))]
    assert asked(sight, 2, 1, 2) == [pytest.approx(math.sqrt(10))]
    assert asked(sight, 2, 1, 14) == [math.inf]  # its mother alone has the colour that is the first
    assert asked(sight, 2, 1, 1) == [math.inf]


def test_before_the_first_shoot_a_module_asks_from_where_the_turtle_is() -> None:
    assert asked(observe(word_of("[ f(3) x ] [ +(90) f(4) F(1) ]")), 2, 1) == [5]
    assert asked(observe(word_of("[ +(70) x ]")), 7) == [70]


@pytest.mark.parametrize(
    ("word", "answer"),
    [("F(1) x", 0), ("+(90) F(1) x", 90), ("&(35) F(1) x", 35), ("+(180) F(1) x", 180), ("+(20) F(1) -(20) x", 20)],
)
def test_an_inclination_is_that_of_the_shoot(word: str, answer: float) -> None:
    assert asked(observe(word_of(word)), 7) == [pytest.approx(answer)]


@pytest.mark.parametrize(
    ("word", "answer"),
    [
        ("F(1) x", math.inf),
        ("F(1) x [ +(30) F(1) ]", 30),
        ("F(1) x [ F(1) ]", 0),
        ("F(1) x [ +(60) F(1) ] [ -(40) F(1) ]", 40),
        ("F(1) x [ f(3) +(90) f(2) +(180) F(4) ]", 0),
        ("F(1) x [ f(3) +(90) f(1) F(4) ]", math.degrees(math.atan2(1, 3))),
        ("F(1) x [ ^(90) f(5) &(90) f(1) +(90) f(1) +(180) F(2) ]", 0),
        ("[ -(90) F(3) x ] F(5)", math.degrees(math.atan2(3, 5))),
        ("f(2) [ +(90) F(3) x ] [ -(90) F(3) ]", math.inf),
        ("+(90) f(2) -(90) F(4) +(180) f(1) F(2) x", 0),
    ],
)
def test_the_steepest_way_up_is_measured_from_the_vertical(word: str, answer: float) -> None:
    assert asked(observe(word_of(word)), 1, 1) == [pytest.approx(answer)]


@pytest.mark.parametrize(
    ("word", "angle", "count"),
    [
        ("F(1) x", 180, 0),
        ("F(1) x [ f(1) F(1) ]", 10, 1),
        ("F(1) x [ F(1) ]", 90, 0),
        ("F(1) x [ f(1) +(90) f(1) F(1) ] [ f(2) F(1) ]", 44, 1),
        ("F(1) x [ f(1) +(90) f(1) F(1) ] [ f(2) F(1) ]", 45, 2),
        ("F(1) x [ f(1) +(90) f(1) F(1) ] [ f(2) F(0.5) ]", 45, 1),
        ("[ F(1) +(90) F(1) ] [ -(90) f(3) F(1) x ]", 45, 0),
        ("[ F(1) +(90) F(1) ] [ -(90) f(3) F(1) x ]", 90, 2),
    ],
)
def test_shoots_that_begin_in_a_cone_above_are_counted(word: str, angle: float, count: int) -> None:
    assert asked(observe(word_of(word)), 4, angle, 1) == [count]


def test_a_cone_points_where_the_shoot_points() -> None:
    word = "F(4) x [ f(3) F(1) ] [ +(90) f(1) F(1) ]"
    sight = observe(word_of(word))
    assert [asked(sight, 9, angle, 1) for angle in (0, 30, 89, 90)] == [[3], [3], [3], [1]]


def test_what_is_measured_is_told_exactly() -> None:
    system = read("axiom: [+(30) F(1) ?P(0,0)] [-(60) F(0.1) F(0.2) ?P(0,0)] A\nA -> B")
    word = derive(system, 1)[-1]
    assert [str(module) for module in word if module.symbol == "?P"] == ["?P(-0.5,0.866025404)", "?P(0.259807621,0.15)"]
    doubles = [m.arguments for m in derive(system, 1, arithmetic="float")[-1] if m.symbol == "?P"]
    assert all(type(value) is float for values in doubles for value in values)


@pytest.mark.parametrize(("values", "told"), [("", "?P"), ("(9)", "?P(-1)"), ("(9,9)", "?P(-1,0)"), ("(9,9,9)", "?P(-1,0,0)")])
def test_a_query_module_gets_as_many_values_as_it_has_room_for(values: str, told: str) -> None:
    assert str(derive(read(f"axiom: +(90)F(1)?P{values}"), 1)[-1]) == f"+(90)F(1){told}"


def test_a_fourth_value_is_not_to_be_had() -> None:
    with pytest.raises(ModelValueError, match=r"\?P\(0,0,0,0\) asks for more than the three values"):
        derive(read("axiom: ?P(0,0,0,0)"), 1)


def test_interpretation_rules_are_followed() -> None:
    system = read("axiom: I ?P(0,0)\nI -> I\ninterpretation:\nI -> F(3) -(90) F(1)")
    assert str(derive(system, 1)[-1]) == "I?P(1,3)"


def test_a_plant_with_a_million_open_brackets_is_an_error() -> None:
    with limits(brackets=50), pytest.raises(ModelLimitError, match="More than 50 brackets"):
        derive(read("axiom: A ?P(0,0)\nA -> [A]"), 60)


def test_somebody_looks_at_the_clock_while_the_turtle_goes_on() -> None:
    word = derive(read("axiom: A ?P(0,0)\nA -> F A A"), 13)[-1]
    with limits(seconds=1e-9), Task("It was not seen"), pytest.raises(ModelLimitError, match="It was not seen in 1e-09"):
        observe(word)


@pytest.mark.slow
def test_looking_is_given_up_in_time() -> None:
    with limits(seconds=1), pytest.raises(ModelLimitError, match=r"was not reached in 1 seconds") as caught:
        derive(read("axiom: A ?P(0,0)\nA -> [+F A][-F A]"), 30)
    assert isinstance(caught.value.partial, Derivation)
    assert caught.value.partial.steps > 5
