"""Exercises made at random: solvable, not trivial, the same for the same seed, and no misconception answers them rightly."""

import re
from fractions import Fraction

import pytest

from lsys_kit import ModelNameError, ModelValueError, practice
from lsys_kit.classroom.exercises.judging import right_by_mistake, wrong_answers
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.lint import HINTS
from lsys_kit.classroom.exercises.practice.of_drawings import end_of
from lsys_kit.classroom.exercises.practice.practice import LEVELS, TOPICS, _made
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.notation.read import read
from lsys_kit.worlds.derive import derive
from tests.classroom.answers import as_typed

each_topic = pytest.mark.parametrize("topic", TOPICS)
OF_EACH = 500


def _is_worth_solving(asked):
    """What holds for every exercise that chance makes."""
    exercise = asked.exercise
    assert asked.check(exercise.solution).said == "Correct", str(asked)
    assert right_by_mistake(exercise) == ()
    named = {wrong.misconception.name for wrong in wrong_answers(exercise) if wrong.misconception}
    assert set(exercise.expects) <= named
    assert len(exercise.hints) == HINTS


@pytest.mark.slow
@each_topic
def test_five_hundred_of_each_kind_are_solved(topic):
    for seed in range(OF_EACH):
        _is_worth_solving(practice(topic, 1 + seed % LEVELS, seed))


@each_topic
@pytest.mark.parametrize("level", range(1, LEVELS + 1))
def test_a_misconception_has_its_own_reply(topic, level):
    asked = practice(topic, level, 3)
    _is_worth_solving(asked)
    for wrong in wrong_answers(asked.exercise):
        verdict = asked.check(as_typed(asked.exercise, wrong.answer))
        if verdict.said == "Not answered yet":  # a diagram without any arrow
            continue
        assert 0 < float(verdict) < 1
        reply = wrong.says or (wrong.misconception.do if wrong.misconception else "")
        assert reply in verdict.message or verdict.message.count(", or ") == 2


@each_topic
def test_no_two_of_the_first_twelve_are_the_same(topic):
    questions = {practice(topic, 2, seed).exercise.question for seed in range(12)}
    assert len(questions) > 9


@each_topic
def test_the_same_seed_gives_the_same_exercise_and_the_next_another(topic):
    asked = practice(topic, 1, 5)
    _made.cache_clear()
    assert practice(topic, 1, 5) == asked
    assert asked.next().seed == 6
    assert asked.next().exercise.question != asked.exercise.question


@each_topic
def test_hints_and_solution_come_after_a_try_and_no_hint_is_the_solution(topic):
    asked = practice(topic, 2, 1)
    exercise = asked.exercise
    assert asked.check().said == "Not answered yet"
    assert exercise.explanation not in asked.check(..., solution=True).message
    after = asked.check(exercise.solution, hint=1, solution=True)
    assert exercise.hints[0] in after.message
    assert "check(answer, hint=2)" in after.message
    assert exercise.explanation in after.message
    if exercise.kind != "choice":
        assert not any(re.search(rf"(?<!\w){re.escape(exercise.solution)}(?!\w)", hint) for hint in exercise.hints)


def test_the_turtle_of_the_squared_paper_is_that_of_the_kit():
    for seed in range(20):
        exercise = practice("turtle", 3, seed).exercise
        word = re.search(r"^    (\S+)$", exercise.question, re.MULTILINE)[1]
        strokes = scene_of(derive(read(f"angle: 90\naxiom: {word}"), 0)).segments.ends
        assert tuple(strokes[-1][2:].round().astype(int)) == end_of(word)
        right = exercise.options[letters(exercise).index(exercise.solution)].text
        assert right == str(end_of(word))


def test_probabilities_sum_to_one():
    for seed in range(20):
        shares = re.findall(r": (\d+(?:/\d+)?)[,.]", practice("chance", 3, seed).exercise.explanation)
        assert sum(map(Fraction, shares)) == 1




def test_it_displays_as_its_question():
    asked = practice("turtle", 1, 0)
    assert asked.exercise.question in asked._repr_markdown_()
    assert "- **A** (" in asked._repr_markdown_()
    assert "**" not in repr(asked)


def test_what_there_is_not_is_said():
    with pytest.raises(ModelNameError, match="Did you mean"):
        practice("derve")
    with pytest.raises(ModelNameError, match="Topics are: derive"):
        practice("zzz")
    with pytest.raises(ModelValueError, match="levels are 1 to 3"):
        practice("derive", 4)
    with pytest.raises(ModelValueError, match="seed"):
        practice("derive", 1, "x")
