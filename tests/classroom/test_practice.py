"""Exercises made at random: solvable, not trivial, the same for the same seed, and no misconception answers them rightly."""

import re
from fractions import Fraction
from random import Random

import pytest

from lsys_kit import ModelNameError, ModelValueError, infer, practice
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.judging import is_right_by_mistake, right_by_mistake, wrong_answers
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.lint import HINTS
from lsys_kit.classroom.exercises.practice.drafts import TOPICS, Draft
from lsys_kit.classroom.exercises.practice.makers import DIRECTIONS, TYPES, end_of, growth_type, heading_after
from lsys_kit.classroom.exercises.practice.practice import LEVELS, _made
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
        assert 0 <= float(verdict) < 1
        reply = wrong.says or (wrong.misconception.do if wrong.misconception else "")
        assert reply in verdict.message or verdict.message.count(", or ") == 2


@pytest.mark.slow
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


def test_every_lesson_has_something_to_practise():
    assert {topic["lesson"] for topic in TOPICS.values()} == set(range(19))


@pytest.mark.parametrize("seed", range(30))
def test_the_turtle_in_space_is_that_of_the_kit(seed):
    exercise = practice("space", 1 + seed % 3, seed).exercise
    word = re.search(r"^    (\S+)$", exercise.question, re.MULTILINE)[1]
    x, y, z, u, v, w = scene_of(derive(read(f"angle: 90\naxiom: {word}"), 0)).segments.ends[-1].round(6)
    assert (u - x, v - y, w - z) == heading_after(word)
    assert exercise.options[letters(exercise).index(exercise.solution)].text == DIRECTIONS[heading_after(word)]


def _numbers(topic, level, seed):
    """The numbers of a question, and the answer."""
    exercise = practice(topic, level, seed).exercise
    return [Fraction(each) for each in re.findall(r"\d+(?:\.\d+)?", exercise.question)], Fraction(exercise.solution), exercise


@pytest.mark.parametrize("seed", range(20))
def test_the_signal_arrives_when_the_axis_has_no_more_internodes(seed):
    question, answer, _ = _numbers("flowering", 1, seed)
    every, starts, through = question[1], question[2], question[3] if len(question) > 3 else 1
    passed = (answer - starts) / through
    assert answer // every <= passed
    assert all((starts + k * through) // every > k for k in range(int(passed)))


@pytest.mark.parametrize("seed", range(20))
def test_a_hedge_grown_step_by_step_has_as_many_shoots(seed):
    exercise = practice("hedge", 1 + seed % 3, seed).exercise
    words = exercise.question.replace("one shoot,", "1 shoots,")
    start = int(re.search(r"begins with (\d+) shoots", words)[1])
    height, lost = (int(re.search(each, words)[1]) for each in (r"(\d+) internodes above", r"the last (\d+)"))
    buds, steps = (int(re.search(each, words)[1]) for each in (r"the cut (\d+) buds", r"after (\d+) steps"))
    shoots = [0] * start
    for _ in range(steps):
        shoots = [each + 1 for each in shoots]
        shoots = [each - lost if each == height else each for each in shoots for _ in range(buds if each == height else 1)]
    assert len(shoots) == int(exercise.solution)


@pytest.mark.parametrize("seed", range(20))
def test_walls_cells_and_corners_are_those_of_a_map(seed):
    """Euler: corners - walls + cells = 1."""
    question, answer, exercise = _numbers("walls", 1 + seed % 3, seed)
    sides, steps = question[0], int(question[-1])
    cells, corners = (2, 2 * sides - 2) if "two cells" in exercise.question else (1, sides)
    for _ in range(steps):
        cells, corners = 2 * cells, corners + 2 * cells
    assert corners - answer + cells == 1


@pytest.mark.parametrize("seed", range(20))
def test_daughters_are_as_old_as_in_small_slices(seed):
    (life, *others), answer, _ = _numbers("slices", 1 + seed % 2, seed)
    newborn, slice_ = others[0], others[1]
    time = slice_ * next(count for count in range(1, 99) if count * slice_ >= life)
    assert answer == time - life + newborn


@pytest.mark.parametrize("seed", range(20))
def test_the_rule_asked_for_is_the_only_one(seed):
    exercise = practice("rules", 1 + seed % 3, seed).exercise
    words = re.findall(r"^    (.+)$", exercise.question, re.MULTILINE)
    [fit] = infer([word.replace(" ", "") for word in words])
    asked = re.search(r"What does (\w) become", exercise.question)[1]
    [made] = [rule.successor for rule in fit.productions if rule.predecessor.symbol == asked]
    assert exercise.solution == " ".join(module.symbol for module in made)


@pytest.mark.parametrize("seed", range(20))
def test_a_word_of_the_language_is_derived_and_the_others_are_not(seed):
    exercise = practice("language", 1 + seed % 3, seed).exercise
    rules = "\n".join(re.findall(r"^    (.+)$", exercise.question, re.MULTILINE))
    words = [str(word) for word in derive(read(rules), 14)]
    right = letters(exercise).index(exercise.solution)
    assert [option.text in words for option in exercise.options] == [number == right for number in range(4)]


def test_types_of_growth():
    assert [
        growth_type([f(n) for n in range(48)])
        for f in (lambda n: 3 + n % 2, lambda n: n + n % 3, lambda n: n * n // 2, lambda n: round(1.2**n))
    ] == list(TYPES)
    assert growth_type([n**3 for n in range(48)]) in ("", "exponential")


def test_misconceptions_are_looked_for_until_one_is_right():
    squares = Exercise("1", "", "number", "", "4", "", (), system="axiom: a\na -> aa", asks="length", steps=2)
    assert is_right_by_mistake(squares)
    assert right_by_mistake(squares)[0] == "sequential"


def test_questions_whose_answers_are_the_same_are_no_exercises():
    draft = Draft({"kind": "number", "hints": [], "replies": ["", ""]})
    assert draft.number(3, [4, 5]).solution == "3"
    assert draft.number(3, [4, 4]) is None
    assert draft.number(3, [3, 4]) is None
    assert draft.number(0, [4, 5]) is None
    assert draft.choice(Random(1), "a", [("b", ""), ("b", "")]) is None


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
