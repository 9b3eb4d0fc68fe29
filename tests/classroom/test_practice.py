"""Exercises made at random: solvable, not trivial, the same for the same seed, and no misconception answers them rightly."""

import re
from fractions import Fraction
from random import Random

import pytest

from lsys_kit import ModelNameError, ModelValueError, infer, language, practice, progress
from lsys_kit.classroom.exercises import progress as kept
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.judging import is_right, is_right_by_mistake, right_by_mistake, wrong_answers
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.lint import HINTS
from lsys_kit.classroom.exercises.practice.drafts import TOPICS, Draft
from lsys_kit.classroom.exercises.practice.makers import DIRECTIONS, TYPES, end_of, growth_type, heading_after
from lsys_kit.classroom.exercises.practice.practice import _made
from lsys_kit.classroom.exercises.practice.schedule import INTERVALS, LEVELS, Practised, due, practised
from lsys_kit.classroom.exercises.progress import FILE, Try, record_so_far
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.notation.model.expressions import function_of
from lsys_kit.notation.read import read, read_expression
from lsys_kit.worlds.derive import derive
from tests.classroom.answers import as_typed

each_topic = pytest.mark.parametrize("topic", TOPICS)
each_level = pytest.mark.parametrize("level", range(1, LEVELS + 1))
SEEDS, DISTINCT = 60, 40


@pytest.fixture(autouse=True)
def new_session(monkeypatch):
    """As if Python had just begun."""
    for name in ("_seen", "_said"):
        monkeypatch.setattr(kept, name, set())
    monkeypatch.setattr(kept, "_not_kept", [])


def _is_worth_solving(asked):
    """What holds for every exercise that chance makes."""
    exercise = asked.exercise
    assert asked.check(exercise.solution).said == "Correct", str(asked)
    assert right_by_mistake(exercise) == ()
    named = {wrong.misconception.name for wrong in wrong_answers(exercise) if wrong.misconception}
    assert set(exercise.expects) <= named
    assert len(exercise.hints) == HINTS


def _has_one_right_answer(asked):
    """None of the wrong answers that are understood is right, and no other option."""
    exercise = asked.exercise
    for wrong in wrong_answers(exercise):
        assert not is_right(exercise, as_typed(exercise, wrong.answer))
    right = [letter for letter in letters(exercise) if is_right(exercise, letter)]
    assert len(right) == bool(exercise.options)


@pytest.mark.slow
@each_topic
@each_level
def test_of_sixty_exercises_of_a_level_forty_are_different_and_each_has_one_right_answer(topic, level):
    questions = set()
    for seed in range(SEEDS):
        asked = practice(topic, level, seed)
        _is_worth_solving(asked)
        _has_one_right_answer(asked)
        questions.add(asked.exercise.question)
    assert len(questions) >= DISTINCT


@each_topic
@each_level
def test_a_misconception_has_its_own_reply(topic, level):
    asked = practice(topic, level, 3)
    _is_worth_solving(asked)
    for wrong in wrong_answers(asked.exercise):
        verdict = asked.check(as_typed(asked.exercise, wrong.answer))
        if verdict.said == "Not answered yet":  # a diagram without any arrow
            continue
        assert 0 <= float(verdict) < 1
        reply = wrong.says or (wrong.misconception.do if wrong.misconception else "")
        told = reply in verdict.message or verdict.message.count(", or ") == 2
        assert told or (wrong.misconception and wrong.misconception.last_resort)


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
    assert {topic["lesson"] for topic in TOPICS.values()} == set(range(20))


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
    cells = question[0] if "row of" in exercise.question else 2 if "two cells" in exercise.question else 1
    sides, steps = question[1 if cells > 2 else 0], int(question[-1])
    corners = cells * sides - 2 * (cells - 1)
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


@pytest.mark.slow
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


# What comes next


def _answered(asked, *rights):
    """An exercise with answers that are right or wrong."""
    for number, right in enumerate(rights):
        asked.check(asked.exercise.solution if right else 9_000_001 + number)
    return asked


def test_two_right_answers_at_once_lead_to_the_next_level_and_it_says_so():
    first = _answered(practice("walls", 1, 3), True)
    second = first.next()
    assert (second.level, second.note) == (1, "")
    third = _answered(second, True).next()
    assert (third.topic, third.level, third.note) == ("walls", 2, "Two right at once: this is level 2.")
    assert repr(third).startswith("Two right at once: this is level 2.\n\nThe walls of a tissue\n\n")
    assert third._repr_markdown_().startswith("*Two right at once: this is level 2.*\n\n**The walls")


def test_two_wrong_answers_lead_to_the_level_before():
    assert _answered(practice("walls", 2, 3), False, False).next().level == 1


def test_two_wrong_answers_may_be_to_different_exercises():
    one = _answered(practice("hedge", 2, 3), False)
    other = _answered(one.next(), False)
    assert (other.level, other.next().level, other.next().note) == (2, 1, "Two wrong: this is level 1 again.")


def test_a_right_answer_between_wrong_ones_keeps_the_level():
    assert _answered(practice("walls", 3, 3), False, False, True).next().level == 3


def test_right_answers_after_a_wrong_one_do_not_count_as_at_once():
    one = _answered(practice("walls", 1, 3), False, True)
    assert _answered(one.next(), True).next().level == 1


@pytest.mark.parametrize(("level", "rights"), [(LEVELS, (True,)), (1, (False, False))])
def test_there_is_no_level_beyond_the_last_one_on_either_side(level, rights):
    asked = _answered(practice("walls", level, 3), *rights)
    assert _answered(asked.next(), *rights).next().level == level


def test_a_topic_that_was_missed_comes_again_and_then_the_other_goes_on():
    _answered(practice("hedge", 1, 0), False, True)
    asked = _answered(practice("walls", 1, 3), True)
    asked = _answered(asked.next(), False, True)
    again = asked.next()
    assert (again.topic, again.level, again.seed) == ("hedge", 1, 1)
    assert again.note == 'Once more "Cut again and again", which you missed not long ago.'
    back = _answered(again, True).next()
    assert (back.topic, back.seed, back.note) == ("walls", asked.seed + 1, 'Back to "The walls of a tissue".')


def test_what_is_solved_again_and_again_comes_after_more_and_more_others():
    done, often, number = [Practised("chance", 1, 0, [False])], [], 0
    while number < 40:
        number += 1
        if due(done, "walls") == "chance":
            often.append(number)
            done.append(Practised("chance", 1, number, [True]))
        else:
            done.append(Practised("walls", 1, number, [True]))
    assert [later - earlier - 1 for earlier, later in zip([0, *often], often, strict=False)] == [*INTERVALS]


def test_an_exercise_that_was_solved_does_not_come_again():
    asked = practice("hedge", 1, 4)
    _answered(practice("hedge", 1, 5), True)
    assert asked.next().seed == 6


def test_tries_are_kept_with_the_progress_and_go_on_from_there(tmp_path, monkeypatch):
    (tmp_path / kept.MANIFEST).write_text("", "utf-8")
    monkeypatch.chdir(tmp_path)
    _answered(practice("life spans", 1, 0), False, True)
    _answered(practice("walls", 1, 0), True)
    lines = (tmp_path / FILE).read_text("utf-8").splitlines()[1:]
    assert [line.partition(",")[2] for line in lines] == [
        "practice: life spans 1 0,tried",
        "practice: life spans 1 0,solved",
        "practice: walls 1 0,solved",
    ]
    assert [(each.topic, each.tries) for each in practised(record_so_far().tries)] == [
        ("life spans", [False, True]),
        ("walls", [True]),
    ]
    assert "Practised: 2 exercises, 1 of them right at once." in repr(progress())
    assert repr(progress(1)).count("Practised") == 0


def test_a_record_with_what_there_is_not_any_more_is_no_obstacle(monkeypatch):
    names = ("practice: gone 1 0", "practice: walls 9 0", "practice: walls 1 x", "1.1")
    monkeypatch.setattr(kept, "_not_kept", [Try(name, False) for name in names])
    asked = practice("hedge", 1, 0)
    for _ in range(4):
        asked = _answered(asked, True).next()
    assert asked.topic == "hedge"


def test_notes_are_in_the_chosen_language():
    language("de")
    try:
        asked = _answered(_answered(practice("walls", 1, 3), True).next(), True).next()
        assert asked.note == "Zwei auf Anhieb richtig: Das ist Stufe 2."
    finally:
        language("en")


@pytest.mark.slow
@pytest.mark.parametrize("level", range(1, LEVELS + 1))
def test_the_formula_of_a_total_is_that_of_the_words(level):
    for seed in range(10):
        exercise = practice("formulas", level, seed).exercise
        words = derive(read(exercise.system), 5)
        solution = function_of(read_expression(exercise.solution), {"n": 0, "q": 1})
        for step in range(6):
            pieces = sum(module.arguments[0] for module in words[step] if module.symbol == "F")
            assert solution((step, Fraction(1, 5))) == pieces


@pytest.mark.parametrize(("topic", "level"), [("first", 1), ("flowering", 1), ("flowering", 3), ("slices", 3), ("walls", 1)])
def test_the_unit_of_a_number_is_checked(topic, level):
    asked = practice(topic, level, 3)
    solution, unit = asked.exercise.solution, asked.exercise.unit
    assert asked.check(f"{solution} {unit}") == 1
    assert f"Its unit is: {unit}." in asked.check(f"{solution} ants").message
