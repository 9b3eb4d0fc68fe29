"""Each exercise untouched, with every listed mistake, and solved; what is typed is read, never run."""

import json
import re
import time
from pathlib import Path

import pytest

from lsys_kit import ModelNameError, ModelValueError, check, derive, limits, read, system
from lsys_kit.classroom.exercises.answers import ANSWER_KINDS, leftmost_only, sequential
from lsys_kit.classroom.exercises.check import exercise_of, lessons
from lsys_kit.classroom.exercises.differences import differing_system, differing_word, proved_equal
from lsys_kit.classroom.exercises.notebooks import exercise_notebook, write_notebooks
from lsys_kit.classroom.exercises.verdict import Verdict
from lsys_kit.derivation.core.states import States
from lsys_kit.notation.read import read_expression

EXERCISES = [exercise for lesson in lessons() for exercise in lesson.exercises]
IDS = [exercise.id for exercise in EXERCISES]
SLIPS = [pytest.param(exercise.id, slip.answer, slip.says, id=f"{exercise.id}-{number}")
         for exercise in EXERCISES for number, slip in enumerate(exercise.slips, 1)]
FOLDER = Path(__file__).parents[2] / "exercises"

J1 = "ar -> al br\nal -> bl ar\nbr -> ar\nbl -> al"


def test_three_exercises_for_each_of_the_first_two_lessons():
    assert IDS[:6] == ["1.1", "1.2", "1.3", "2.1", "2.2", "2.3"]
    assert {exercise.kind for exercise in EXERCISES} == set(ANSWER_KINDS)


@pytest.mark.parametrize("id", IDS)
@pytest.mark.parametrize("untouched", [..., None, "", "  \n", "...", '"..."'])
def test_an_untouched_exercise_is_told_apart_from_a_wrong_one(id, untouched):
    verdict = check(id, untouched)
    assert (verdict.said, float(verdict)) == ("Not answered yet", 0)
    assert verdict.message.startswith("Replace the ... with your ")


@pytest.mark.parametrize("id", IDS)
def test_the_solution_is_correct(id):
    verdict = check(id, exercise_of(id).solution)
    assert (verdict.said, float(verdict)) == ("Correct", 1)


@pytest.mark.parametrize(("id", "answer", "says"), SLIPS)
def test_every_listed_mistake_has_its_own_reply(id, answer, says):
    verdict = check(id, answer)
    assert (verdict.said, float(verdict), verdict.message) == ("Almost", 0, says)


@pytest.mark.parametrize("id", IDS)
def test_an_exercise_lists_mistakes_and_three_hints(id):
    assert len(exercise_of(id).slips) >= 2
    assert len(exercise_of(id).hints) == 3
    assert len({slip.says for slip in exercise_of(id).slips}) == len(exercise_of(id).slips)


# Words


def test_the_word_may_be_written_with_or_without_blanks():
    assert check("1.1", "bl ar bl ar ar") == check("1.1", "blarblarar") == check("1.1", "  bl ar\nbl ar ar ") == 1


def test_a_word_that_the_kit_derived_is_an_answer():
    assert check("1.1", derive(read(f"axiom: bl\n{J1}"), 4)[-1]) == 1


def test_rewriting_one_production_after_another_is_named():
    states = States(read(f"axiom: bl\n{J1}"))
    word = " ".join(states.modules[state].symbol for state in sequential(states, 4))
    assert check("1.1", word).said == "Not yet"
    assert "All modules are rewritten at the same time" in check("1.1", word).message


def test_the_sequential_rewriter_doubles_what_should_grow_as_fibonacci():
    states = States(read("axiom: a\na -> ab\nb -> a"))
    assert [len(sequential(states, n)) for n in range(7)] == [1, 2, 4, 8, 16, 32, 64]
    assert derive(states.system, 6).lengths == [1, 2, 3, 5, 8, 13, 21]


def test_rewriting_one_module_in_each_step_is_named():
    states = States(read(f"axiom: bl\n{J1}"))
    word = " ".join(states.modules[state].symbol for state in leftmost_only(states, 4))
    assert "You replaced one module in each step" in check("1.1", word).message


@pytest.mark.parametrize(("word", "step"), [("al al br", 3), ("al al br al al br al br", 5)])
def test_a_miscounted_step_is_named(word, step):
    assert f"This is the word of step {step}" in check("1.1", word).message


def test_the_first_difference_of_a_word_names_the_cell_that_made_it():
    assert repr(check("1.1", "bl ar al ar ar")) == \
        "Almost. Position 3: you have al, the word has bl; look at what becomes of the al at position 2 of step 3."
    assert repr(check("1.1", "bl ar bl")) == \
        ("Almost. Position 4: you have the end of the word, the word has ar; "
         "look at what becomes of the al at position 2 of step 3.")
    assert repr(check("1.1", "bl ar bl ar ar ar")) == \
        "Almost. You have 6 modules, the word has 5: up to position 5 yours is right."


# Numbers


def test_the_numbers_of_the_exercises_are_those_of_the_systems():
    fibonacci = derive(read("axiom: a\na -> ab\nb -> a"), 7).lengths
    cells = derive(system("J4"), 13).lengths
    assert [fibonacci[5], fibonacci[6], fibonacci[7]] == [13, 21, 34]
    assert [cells[11], cells[12], cells[13]] == [16, 21, 28]


@pytest.mark.parametrize("answer", [21, 21.0, "21", "42/2", " 21 "])
def test_a_number_may_be_a_number_or_a_text(answer):
    assert check("1.2", answer) == check("2.1", answer) == 1


def test_an_unknown_wrong_number_is_too_few_or_too_many():
    assert repr(check("2.1", 20)) == "Not yet. You have 20, which is too few."
    assert repr(check("2.1", "45/2")) == "Not yet. You have 22.5, which is too many."
    assert check("2.1", 0).said == "Not yet"


# Systems


def test_the_first_difference_of_a_system_names_step_position_and_production():
    verdict = check("1.3", "axiom: al\nar -> al br\nal -> bl ar\nbr -> ar\nbl -> ar")
    assert repr(verdict) == """\
Almost. Step 2, position 1: you have ar, the system has al; look at your production for bl, which is
  bl -> ar"""
    assert float(verdict) == pytest.approx(2 / 9)


def test_a_wrong_axiom_is_named():
    assert repr(check("1.3", f"axiom: bl\n{J1}")) == \
        "Almost. Step 0, position 1: you have bl, the system has al; look at your axiom."


def test_a_missing_production_is_named():
    verdict = check("1.3", f"axiom: al\n{J1}".replace("bl -> al", ""))
    assert verdict.message == ("Step 2, position 1: you have bl, the system has al; "
                               "you have no production for bl, position 1 of step 1, so that it stays as it is.")


def test_the_production_to_blame_may_stand_before_the_first_difference():
    verdict = check("1.3", "axiom: al\nal -> bl\nar -> al br\nbr -> ar\nbl -> al")
    assert "position 2: you have the end of the word, the system has ar" in verdict.message
    assert verdict.message.endswith("look at your production for al, which is\n  al -> bl")


@pytest.mark.parametrize("answer", [
    "M_r(5) -> M_l(2) M_r(1)", "M_r(t) : 5 == t -> M_l(4 - 2)M_r(1)", "M_r(s) : s >= 5 -> M_l(2) M_r(1)",
    "axiom: M_r(2)\nM_r(s) : s == 5 -> M_l(2)M_r(1)\nM_l(s) : s == 5 -> M_l(1)M_r(2)\nM_r(s) -> M_r(s+1)\nM_l(s) -> M_l(s+1)"])
def test_systems_are_compared_by_the_words_that_they_derive(answer):
    assert check("2.2", answer) == 1


def test_a_system_that_the_kit_read_is_an_answer():
    assert check("2.2", system("P3")) == 1
    assert check("2.2", system("P4")).said == "Almost"


def test_an_error_in_an_answer_names_the_line_that_the_student_sees():
    assert repr(check("2.2", "M_r(s) : s = 5 -> M_l(2) M_r(1)")) == """\
Not readable yet. A single "=" cannot be used here (line 1, column 12). To compare two values, type "==".
  M_r(s) : s = 5 -> M_l(2) M_r(1)
             ^"""


# Expressions


@pytest.mark.parametrize("answer", ["d - s + 1", "1 + d - s", "(d+1)-s", "-(s - d) + 1", "d - (s - 1)", "(2*d - 2*s + 2)/2"])
def test_expressions_are_compared_as_functions(answer):
    assert repr(check("2.3", answer)) == "Correct. It equals d - s + 1, whatever the values."


def test_an_expression_that_is_right_for_all_values_asked_for_is_right():
    assert repr(check("2.3", "max(d - s, -1) + 1")) == "Correct. It equals d - s + 1 for all the values in question."
    assert check("2.3", "sqrt((d - s + 1)^2)") == 1


def test_a_wrong_expression_is_shown_a_case():
    assert repr(check("2.3", "d + 1")) == "Not yet. With s = 1 and d = 5 your expression gives 6, and it should give 5."
    assert repr(check("2.3", "1/(s-1)")) == \
        "Not yet. With s = 1 and d = 5 your expression has no value (division by zero), and it should give 5."


def test_an_expression_may_use_the_names_of_the_question_only():
    assert 'I do not know the name "t"' in check("2.3", "d - t + 1").message
    assert check("2.3", "d > s").said == "Not readable yet"


@pytest.mark.parametrize(("one", "other", "equal"), [
    ("(x + y)^3", "x^3 + 3*x^2*y + 3*x*y^2 + y^3", True), ("x < 5", "5 > x", True), ("x < 5", "x <= 4", False),
    ("(x^2 - 1)/(x - 1)", "x + 1", True), ("a^t", "t^a", False), ("0.5*x", "x/2", True),
    ("x^(9^9^9)", "x^(9^9^9)", False), ("(x+y)^1000", "(y+x)^1000", False), ("2^(x + 10^9)", "2^x", False),
    ("x < 1 || 0 > 1 && floor(exp(exp(exp(99)))) > 0", "x < 1", False)])
def test_equality_is_shown_quickly_or_not_claimed(one, other, equal):
    started = time.process_time()
    assert proved_equal(read_expression(one), read_expression(other)) is equal
    assert time.process_time() - started < 5


# What goes wrong


HOSTILE = ["__import__('os').system('echo run')", "().__class__.__bases__", "lambda: 0", "9^9^9^9", "1e999999999", "((((((",
           "[" * 4_000, "x" * 100_000, "axiom: " + "a " * 2_000, "axiom: ar\nar -> " + "ar " * 1_000, "\u202e\ud800",
           "<script>", "axiom: A(2)\nA(x) -> A(x^1000)A(x)A(x)A(x)A(x)A(x)A(x)A(x)", "axiom: A(1)\nA(x) -> A(1/(x-1))"]


@pytest.mark.parametrize("id", IDS)
@pytest.mark.parametrize("answer", HOSTILE, ids=range(len(HOSTILE)))
def test_whatever_is_typed_is_answered_soon_and_never_run(id, answer, capfd):
    started = time.process_time()
    verdict = check(id, answer)
    assert time.process_time() - started < 5
    assert float(verdict) < 1
    assert "<script" not in verdict._repr_html_()
    assert len(repr(verdict)) < 2_000
    assert "run" not in capfd.readouterr().out


@pytest.mark.parametrize("id", IDS)
@pytest.mark.parametrize("answer", [[], {}, object(), True, b"al", float("nan"), 1j, print])
def test_an_answer_of_another_kind_is_refused_in_words(id, answer):
    assert check(id, answer).said == "Not readable yet"


def test_a_system_that_grows_too_large_is_refused_in_words():
    verdict = check("1.3", "axiom: a\na -> " + "a " * 50)
    assert repr(verdict) == "Not yet. Your answer is too large. Step 3 would have 125,000 modules; the limit is 100,000."


def test_an_unknown_exercise_is_an_error_with_a_suggestion():
    with pytest.raises(ModelNameError, match=r"Exercises are: 1\.1, 1\.2"):
        check("xyz")
    with pytest.raises(ModelNameError, match="Did you mean"):
        check("1.11")
    with pytest.raises(ModelValueError, match="The id of an exercise must be a text"):
        check(1.1)


# Hints and solutions


@pytest.mark.parametrize("id", IDS)
def test_hints_come_one_by_one(id):
    shown = [check(id, hint=number) for number in (1, 2, 3)]
    assert [verdict.said for verdict in shown] == ["Hint"] * 3
    assert f'check("{id}", hint=2)' in shown[0].message
    assert "One more" not in shown[2].message
    assert all(hint in verdict.message for hint, verdict in zip(exercise_of(id).hints, shown, strict=True))


@pytest.mark.parametrize("id", IDS)
def test_no_hint_gives_the_solution_away(id):
    answer = exercise_of(id).solution.strip()
    for hint in exercise_of(id).hints:
        assert not re.search(rf"(?<!\w){re.escape(answer)}(?!\w)", hint)


@pytest.mark.parametrize("hint", [4, -1, True, "1", 1.0])
def test_there_are_no_other_hints(hint):
    with pytest.raises(ModelValueError, match="has the hints 1 to 3"):
        check("1.1", hint=hint)


@pytest.mark.parametrize("id", IDS)
def test_the_solution_is_there_after_a_try_and_not_before(id):
    exercise = exercise_of(id)
    first_line = exercise.solution.strip().splitlines()[0]
    assert exercise.explanation not in check(id, ..., solution=True).message
    assert exercise.explanation not in check(id, "((", solution=True).message
    after = check(id, exercise.slips[0].answer, solution=True)
    assert (after.said, float(after)) == ("Almost", 0)
    assert f"The solution:\n  {first_line}" in after.message
    assert exercise.explanation in after.message


# Verdicts and notebooks


def test_a_verdict_is_a_number_a_sentence_and_a_box():
    verdict = check("1.1", "bl ar bl ar ar")
    assert isinstance(verdict, float)
    assert repr(verdict) == str(verdict) == "Correct."
    assert "<b>Correct.</b>" in verdict._repr_html_()
    assert "✓" in verdict._repr_html_()


def test_no_verdict_is_told_by_its_colour_alone():
    boxes = [Verdict(said)._repr_html_() for said in
             ("Correct", "Almost", "Not yet", "Not readable yet", "Not answered yet", "Hint")]
    assert len({re.sub(r"#\w+", "", box) for box in boxes}) == 6


def test_a_box_shows_what_was_typed_as_text():
    html = Verdict("Not readable yet", "No.\n  <img src=x onerror=alert(1)>\n  ^")._repr_html_()
    assert "<img" not in html
    assert "&lt;img" in html


@pytest.mark.parametrize("lesson", lessons(), ids=lambda lesson: lesson.name)
def test_rebuilding_a_notebook_changes_no_byte(lesson, tmp_path):
    written = {path.name: path.read_bytes() for path in write_notebooks(tmp_path)}
    assert (FOLDER / f"{lesson.name}.ipynb").read_bytes() == written[f"{lesson.name}.ipynb"]


@pytest.mark.parametrize("lesson", lessons(), ids=lambda lesson: lesson.name)
def test_a_notebook_has_short_cells_one_title_and_a_way_back(lesson):
    import nbformat

    notebook = json.loads(exercise_notebook(lesson))
    nbformat.validate(notebook)
    assert notebook["nbformat_minor"] == 5
    text = "".join("".join(cell["source"]) + "\n" for cell in notebook["cells"] if cell["cell_type"] == "markdown")
    assert len(re.findall(r"^# ", text, re.MULTILINE)) == 1
    assert f"(../notebooks/{lesson.name}.ipynb)" in text
    assert "not an examination" in text
    assert all(len(cell["source"]) <= 6 for cell in notebook["cells"] if cell["cell_type"] == "code")


def test_where_neighbours_have_a_say_the_first_difference_is_found_in_the_words():
    """No module alone decides what becomes of it: both systems have the same productions for a module without a context."""
    mine, wanted = (derive(read(f"axiom: b a a c\nb < a -> {made}\nc -> ε"), 2) for made in ("b", "b b"))
    assert differing_system(mine, wanted, 1) == (
        "Step 1, position 3: you have a, the system has b; look at your production for a, which is\n  b < a -> b")
    assert "look at what becomes of the a at position 2 of step 0" in differing_word(mine, 1, [*mine[0][:1], *mine[0][3:]])
    erased, kept = (derive(read(f"axiom: b a\nb < a -> {made}"), 1) for made in ("ε", "a"))
    assert differing_system(erased, kept, 1).endswith("look at your productions for a, position 2 of step 0.")
    unlucky, lucky = (derive(read(f"axiom: a\na -> {made} : 1"), 1) for made in ("b", "c"))
    assert differing_system(unlucky, lucky, 1).endswith("which is\n  a -> b : 1")


def test_an_answer_is_checked_within_the_limits_in_force():
    with limits(modules=50):
        assert "the limit is 50" in repr(check("1.3", "axiom: a\na -> a a a a a a a a a a"))
