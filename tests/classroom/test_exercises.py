"""Every exercise that there is: untouched, solved in five forms, and with each wrong answer that is understood.

The exercises are found from the files: those of the kit, and one of each kind in `questions` beside this file.
"""

import re
import tomllib
from fractions import Fraction
from pathlib import Path

import pytest

from lsys_kit import ModelNameError, ModelValueError, check, limits
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS
from lsys_kit.classroom.exercises.lint import problems_in
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.verdict import Verdict
from tests.classroom.answers import EXERCISES, OF_EACH_KIND, as_typed, of_each_kind_added, right_answers, wrong_answers_to
from tests.timing import spent

IDS = [exercise.id for exercise in EXERCISES]
each_exercise = pytest.mark.parametrize("exercise", EXERCISES, ids=IDS)


@pytest.fixture(autouse=True, scope="module")
def of_each_kind():
    with of_each_kind_added():
        yield


def test_there_is_an_exercise_of_each_kind():
    assert {exercise.kind for exercise in EXERCISES} == set(ANSWER_KINDS)


@pytest.mark.slow
@pytest.mark.parametrize("folder", [None, OF_EACH_KIND], ids=["the kit's", "one of each kind"])
def test_nothing_is_wrong_with_the_files(folder):
    assert [str(problem) for problem in (problems_in(folder) if folder else problems_in())] == []


@each_exercise
def test_an_untouched_exercise_is_told_apart_from_a_wrong_one(exercise):
    for answer in (..., None, "", "  \n", "...", '"..."', "axiom: ...\na -> ...", exercise.template):
        verdict = check(exercise.id, answer, solution=True, hint=1)
        assert (verdict.said, float(verdict)) == ("Not answered yet", 0)
        assert exercise.explanation not in verdict.message
        assert exercise.hints[0] not in verdict.message


@each_exercise
def test_the_solution_is_right_in_five_forms(exercise):
    forms = right_answers(exercise)
    assert len(forms) == 5
    for form in forms:
        verdict = check(exercise.id, form)
        assert (verdict.said, float(verdict)) == ("Correct", 1), f"{form!r}: {verdict}"


@pytest.mark.slow
@each_exercise
def test_a_misconception_has_its_own_reply_and_earns_the_parts_that_are_right(exercise):
    for wrong in wrong_answers_to(exercise):
        answer = as_typed(exercise, wrong.answer)
        verdict = check(exercise.id, answer)
        mark = Fraction(MARKS.get(exercise.id, {}).get(as_text(answer), 0))
        assert float(verdict) == mark_said(verdict) == float(mark) < 1, str(verdict)
        name = wrong.misconception.name if wrong.misconception else ""
        own = [slip.says for slip in exercise.slips if slip.says and name and slip.misconception == name]
        expected = (wrong.says or wrong.misconception.do, *own)
        told = any(says in verdict.message for says in expected) or verdict.message.count(", or ") == 2
        assert told or (wrong.misconception and wrong.misconception.last_resort), f"{name}: {verdict}"


@pytest.mark.slow
@pytest.mark.parametrize(
    "exercise", [each for each in EXERCISES if each.kind not in ("choice", "symbol", "line")], ids=lambda each: each.id
)
def test_no_reply_gives_the_solution_away(exercise):
    answer = " ".join(exercise.solution.split())
    for wrong in wrong_answers_to(exercise):
        message = check(exercise.id, as_typed(exercise, wrong.answer)).message
        reply = " ".join(message.replace(wrong.misconception.but if wrong.misconception else "", "").split())
        assert not re.search(rf"(?<!\w){re.escape(answer)}(?!\w)", reply), wrong


# Marks


MARKS = tomllib.loads((Path(__file__).parent / "data" / "marks.toml").read_text("utf-8"))
_PARTS = re.compile(r"(?:Right|Passed): (?:the first )?(\d+) of (\d+) (?:numbers|words|tests|steps|transitions)\.")


def mark_said(verdict: Verdict) -> float:
    """The mark that the first words of a reply to a wrong answer give: the share of the parts that are right, else nothing."""
    found = _PARTS.match(verdict.message)
    return int(found[1]) / int(found[2]) if found else 0


def as_text(answer: object) -> str:
    """An answer as the table of marks has it."""
    if not isinstance(answer, tuple | list):
        return str(answer)
    rows = any(isinstance(each, tuple) for each in answer)
    return "\n".join(map(as_text, answer)) if rows else " ".join(map(str, answer))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("exercise", "answer", "mark", "said"),
    [
        ("1.2", 63, 0, "63 is not the number"),
        ("kinds.angle", 77, 0, "77 degrees is not the number"),
        ("kinds.word", "abaabaaa", 0, "Up to position 6 your word is right"),
        ("kinds.word", "bbabbaba", 0, "At position 1 you have b."),
        ("kinds.words", "a\nab\nbba\nabaab", 2 / 4, "Right: the first 2 of 4 words. Word 3"),
        ("kinds.words", "b\nab\naba\nabaab", 0, "Word 1, that of step 0"),
        ("kinds.table", "1 1 2 5", 3 / 4, "Right: 3 of 4 numbers. The first 3"),
        ("kinds.table", "7 7 7 7", 0, "Look at number 1"),
        ("kinds.lengths", "1, 2, 3, 5, 9, 13", 5 / 6, "Right: 5 of 6 numbers. The first 4"),
        ("kinds.symbol", "1", 0, "At position 1 stands F. Count the brackets"),
        ("kinds.line", 1, 0, "It is not line 1."),
        ("1.3", "axiom: al\nal -> bl al\nbl -> ar\nar -> ar br\nbr -> al", 0, "Of al something else should become"),
        ("1.3", "axiom: al\nal -> bl ar\nbl -> ar\nar -> ar br\nbr -> al", 1 / 9, "Passed: 1 of 9 tests. Up to step 1"),
        ("kinds.expression", "d + 7", 0, "Your expression gives the same whatever the value of n"),
        ("kinds.expression", "d + 7*n", 0, "With d = 1 and n = "),
        ("kinds.drawing", "FFFFF", 0, "Your first 2 strokes are right"),
        ("kinds.net", "S -> L\nL -> A\nA -> L + 3 S", 2 / 3, "Right: 2 of 3 transitions. Look"),
        ("kinds.net", "S -> S\nL -> L\nA -> A", 0, "Look at the transition that empties S"),
        (
            "kinds.map",
            "map: A> B> C> D>\nA> -> B>[-A>]D>\nB> -> B>\nC> -> B>[-A<]B>\nD> -> A>",
            0,
            "At step 1 the number of cells is right.",
        ),
    ],
)
def test_a_wrong_answer_that_nothing_explains_earns_the_parts_that_are_right(exercise, answer, mark, said):
    verdict = check(exercise, answer)
    assert (float(verdict), verdict.message[: len(said)]) == (mark, said)


@pytest.mark.parametrize(
    ("exercise", "answer", "said"),
    [
        ("kinds.system", "axiom: S\nL -> L S\nS -> L L", "There is one module too many. Look at this production:\n  S -> L L"),
        ("kinds.drawing", "F[+F]FF", "There is one stroke too many. Your first 3 strokes are right"),
        ("kinds.map", "A> -> B>[-A>]D>", "All parts are right, but not their order.\n  A> -> B>[-A>]D>"),
    ],
)
def test_a_wrong_answer_that_one_change_makes_right_is_almost_right_and_earns_no_more(exercise, answer, said):
    verdict = check(exercise, answer)
    assert (verdict.said, float(verdict), verdict.message[: len(said)]) == ("Almost", 0, said)


IN_PARTS = {"table", "words", "system", "map", "net"}


def test_the_guide_says_of_each_kind_which_parts_count_and_in_which_words():
    guide = (Path(__file__).parents[2] / ".github" / "EXERCISES.md").read_text("utf-8")
    assert {name for name, kind in ANSWER_KINDS.items() if kind.parts_right} == IN_PARTS
    said = {name: reply(f"{name}.parts", right=3, all=4) for name in IN_PARTS}
    assert [name for name, words in said.items() if f"| {name} |" not in guide or f'"{words}"' not in guide] == []


@each_exercise
def test_nonsense_earns_nothing(exercise):
    assert float(check(exercise.id, _nonsense(exercise))) == 0


CHOICES = [exercise for exercise in EXERCISES if exercise.kind == "choice" and exercise.id[0].isdigit()]


@pytest.mark.parametrize("letter", "ABCD")
def test_who_always_gives_one_letter_earns_a_fifth_to_a_third_of_the_choices(letter):
    earned = sum(map(float, (check(exercise.id, letter) for exercise in CHOICES)))
    assert earned == sum(exercise.solution == letter for exercise in CHOICES)
    assert len(CHOICES) / 5 <= earned <= len(CHOICES) / 3


def _nonsense(exercise: Exercise) -> object:
    """An answer that can be read and that no misconception yields."""
    made = {"number": 987_654_321, "table": [9, 9], "system": "axiom: Z\nZ -> Z Z Z", "expression": "987654321"}
    return made.get(exercise.kind, "%%")


# Hints and solutions


@each_exercise
def test_hints_come_one_by_one_after_a_try(exercise):
    shown = [check(exercise.id, exercise.solution, hint=number).message for number in (1, 2, 3)]
    for number, message in enumerate(shown, 1):
        assert [hint in message for hint in exercise.hints] == [at < number for at in range(3)]
    assert f'check("{exercise.id}", answer, hint=2)' in shown[0]
    assert "One more" not in shown[2]


@each_exercise
def test_what_is_replied_is_shown_as_it_stands_and_has_no_marks(exercise):
    said = (each.says for each in (*exercise.options, *exercise.slips))
    assert not re.search("`|[*]{2}", " ".join((*exercise.hints, exercise.explanation, exercise.otherwise, *said)))


@each_exercise
def test_the_solution_is_there_after_a_try_and_not_before(exercise):
    first_line = exercise.solution.strip().splitlines()[0]
    assert exercise.explanation not in check(exercise.id, "((", solution=True).message
    wrong = wrong_answers_to(exercise)[0]
    after = check(exercise.id, as_typed(exercise, wrong.answer), solution=True)
    assert f"The solution:\n  {first_line}" in after.message
    assert exercise.explanation in after.message
    assert float(after) == float(check(exercise.id, as_typed(exercise, wrong.answer)))


def test_an_explanation_comes_with_its_picture_and_nothing_else_does():
    after = check("15.4", "17", solution=True)
    assert ">13<" in after.picture
    assert "<img" in after._repr_html_()
    assert "<img" not in check("15.4", "17", hint=3)._repr_html_()


@pytest.mark.parametrize("hint", [4, -1, True, "1", 1.0])
def test_there_are_no_other_hints(hint):
    with pytest.raises(ModelValueError, match="has the hints 1 to 3"):
        check("kinds.word", "a", hint=hint)


# What goes wrong


HOSTILE = [
    "__import__('os').system('echo run')",
    "().__class__.__bases__",
    "lambda: 0",
    "9^9^9^9",
    "1e999999999",
    "((((((",
    "[" * 4_000,
    "x" * 100_000,
    "axiom: " + "a " * 2_000,
    "axiom: ar\nar -> " + "ar " * 1_000,
    "\u202e\ud800",
    "<script>",
    "axiom: A(2)\nA(x) -> A(x^1000)A(x)A(x)A(x)A(x)A(x)A(x)A(x)",
    "axiom: A(1)\nA(x) -> A(1/(x-1))",
    "\\frac{" * 500,
    "A -> " + "B + " * 1_000 + "B",
    "F" * 4_000,
    "1," * 2_000,
    "a;" * 2_000,
]


@pytest.mark.slow
@each_exercise
def test_whatever_is_typed_is_answered_soon_and_never_run(exercise, capfd):
    for answer in HOSTILE:
        with spent() as taken:
            verdict = check(exercise.id, answer)
        assert taken.seconds < 10, answer[:60]
        assert float(verdict) < 1, answer[:60]
        assert "<script" not in verdict._repr_html_()
        assert len(repr(verdict)) < 2_000, answer[:60]
        assert "run" not in capfd.readouterr().out


@each_exercise
def test_an_answer_of_another_kind_is_refused_in_words(exercise):
    for answer in ({}, object(), True, b"al", float("nan"), 1j, print, [[[[[[1]]]]]], [object()]):
        assert check(exercise.id, answer).said in ("Not readable yet", "Not yet"), answer


def test_an_answer_is_checked_within_the_limits_in_force():
    with limits(modules=50):
        assert "the limit is 50" in repr(check("kinds.system", "axiom: a\na -> a a a a a a a a a a"))


def test_an_unknown_exercise_is_an_error_with_a_suggestion():
    with pytest.raises(ModelNameError, match="Exercises are: "):
        check("xyz")
    with pytest.raises(ModelNameError, match="Did you mean"):
        check("kinds.wort")
    with pytest.raises(ModelValueError, match="The id of an exercise must be a text"):
        check(1.1)


def test_where_nothing_can_be_typed_it_is_said_where_it_can(monkeypatch):
    assert check("1.1", ...).message.startswith("Replace the ... with your ")
    monkeypatch.setenv("SERVER_SOFTWARE", "voila/0.5.8")
    assert check("1.1", ...).message.startswith("Voila has no place for an answer: open this notebook in JupyterLab")
