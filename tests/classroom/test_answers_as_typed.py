"""Answers to all exercises as students type them: right ones in many forms, and wrong ones, by what the reply does.

`data/wrong_answers.toml` and `data/right_answers.toml` were written by hand, without a look at what the exercises expect.
"""

import re
import tomllib
from collections import Counter
from decimal import Decimal
from fractions import Fraction
from itertools import permutations, product
from pathlib import Path

import numpy as np
import pytest
import sympy

from lsys_kit import check, derive, exercises, read
from lsys_kit.classroom.exercises import registry
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.judging import is_right, wrong_answers
from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS
from lsys_kit.classroom.exercises.replies import REPLIES
from lsys_kit.notation.model.expressions import function_of
from lsys_kit.notation.read import read_expression

DATA = Path(__file__).parent / "data"
WRONG = tomllib.loads((DATA / "wrong_answers.toml").read_text(encoding="utf-8"))
RIGHT = tomllib.loads((DATA / "right_answers.toml").read_text(encoding="utf-8"))
KIT = {exercise.id: exercise for exercise in exercises() if exercise.id in WRONG}
NAMING = (
    "repair",
    "system.joined",
    "system.given_already",
    "word.of_step",
    "word.erased",
    "number.one_off",
    "number.of_step",
    "drawing.turned",
)
NAMING += "number.decimals", "number.close", "number.whole", "number.not_negative", "number.probability", "table.late"
NAMING += "table.early", "table.exchanged", "net.start", "system.never_used", "map.no_rule", "drawing.nothing"
"""The replies that name what is wrong, by their places in the table of replies."""


def _pattern(text: str) -> str:
    """A reply as a pattern, with anything for its values."""
    return re.sub(r"\\\{\w+\\\}", ".+?", re.escape(text))


def _naming() -> re.Pattern[str]:
    texts = []
    for name in NAMING:
        place, _, part = name.partition(".")
        found = [REPLIES[place][part]] if part else [*REPLIES[place].values()]
        texts += [form for text in found for form in ([text] if isinstance(text, str) else text)]
    return re.compile("|".join(map(_pattern, texts)))


NAMES = _naming()
IS_NOT = re.compile(r"^\S+( \w+)? is not the number that is asked for\.")
SAME_FOR_ALL = re.compile(r"^(Try your way on step \d+: does it give \d+ there\?)?$")


def reply_class(exercise: Exercise, verdict) -> str:
    """What a reply does: it names the mistake, shows where or by what the answer is wrong, or says nothing of it."""
    if verdict == 1:
        return "accepted"
    if verdict.said == "Not readable yet":
        return "form"
    said = [
        *(slip.says for slip in exercise.slips),
        *(option.says for option in exercise.options),
        *(misconception.do for misconception in MISCONCEPTIONS.values()),
    ]
    if any(sentence.strip() in verdict.message for sentence in said if sentence) or NAMES.search(verdict.message):
        return "names"
    if exercise.kind == "line":
        return "verdict"
    if exercise.kind == "number":
        rest = IS_NOT.sub("", verdict.message).strip()
        return "verdict" if rest == exercise.otherwise or SAME_FOR_ALL.match(rest) else "shows"
    return "verdict" if exercise.kind == "drawing" and "stroke" not in verdict.message else "shows"


def test_there_are_answers_to_every_exercise():
    kit = {exercise.id for exercise in exercises() if re.fullmatch(r"\d+\.\d+", exercise.id)}
    assert set(WRONG) == set(RIGHT) == kit
    assert min(map(len, RIGHT.values())) >= 2
    assert min(sum(map(len, answers.values())) for answers in WRONG.values()) >= 2


def test_at_most_three_wrong_answers_in_a_hundred_get_only_a_verdict():
    shares = Counter(does for answers in WRONG.values() for does, several in answers.items() for _ in several)
    assert set(shares) <= {"names", "shows", "verdict", "form"}
    assert shares["verdict"] <= 0.03 * shares.total()
    assert shares["names"] >= 0.5 * shares.total()


@pytest.mark.slow
@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_answer_is_not_accepted_and_its_reply_does_what_it_did(name):
    exercise = KIT[name]
    for does, answers in WRONG[name].items():
        for answer in answers:
            verdict = check(name, answer)
            assert (answer, reply_class(exercise, verdict)) == (answer, does), str(verdict)


@pytest.mark.parametrize("name", RIGHT)
def test_a_right_answer_is_accepted_in_other_forms(name):
    refused = {str(answer): str(verdict) for answer in RIGHT[name] if (verdict := check(name, answer)) != 1}
    assert refused == {}


@pytest.mark.parametrize("name", [name for name, each in KIT.items() if each.kind in ("choice", "line")])
def test_of_two_options_or_lines_one_is_needed(name):
    two = ("A", "B") if KIT[name].options else ("1", "2")
    for joint in (" and ", " or ", ", ", "/", " oder ", " & "):
        assert "is needed, and you give" in check(name, joint.join(two)).message, joint


@pytest.mark.parametrize(
    "name", [name for name, each in KIT.items() if each.kind == "system" and "\n" not in each.solution.strip()]
)
def test_an_arrow_that_is_turned_round_is_shown(name):
    verdict = check(name, KIT[name].solution.replace("->", "<-"))
    assert verdict.said == "Not readable yet"
    assert "This arrow is turned round" in verdict.message


@pytest.mark.parametrize(("name", "names"), [("10.5", "mnv"), ("15.5", "xyL"), ("19.7", "ij")])
def test_a_condition_has_no_exceptions_that_the_question_does_not_have(name, names):
    for each in names:
        assert check(name, f"({KIT[name].solution}) && {each} != 37") < 1, each
        assert check(name, f"({KIT[name].solution}) && {each} > {min(KIT[name].values[each]) - 1}") == 1, each


FURTHER = {
    "10.5": dict.fromkeys("mnuv", range(1, 13)),
    "15.5": {"x": range(-9, 10), "y": range(-9, 10), "L": range(1, 9)},
    "19.7": {"i": range(1, 60), "j": range(1, 60)},
}
"""Values beyond those that a question compares with."""


@pytest.mark.slow
@pytest.mark.parametrize("joint", ["&&", "||"])
@pytest.mark.parametrize("name", FURTHER)
def test_a_condition_with_a_further_comparison_of_two_names_is_right_only_where_that_changes_nothing(name, joint):
    order = {each: number for number, each in enumerate(FURTHER[name])}
    cases = [case for case in product(*FURTHER[name].values()) if name != "10.5" or case[3] < case[1]]
    right = function_of(read_expression(KIT[name].solution), order)
    for (a, b), comparison in product(permutations(order, 2), ["{} < {}", "{} <= {} + 1", "{} == 2*{}", "{} != {}"]):
        text = f"({KIT[name].solution}) {joint} {comparison.format(a, b)}"
        own = function_of(read_expression(text), order)
        assert is_right(KIT[name], text) == all(own(case) == right(case) for case in cases), text


@pytest.mark.parametrize(
    ("name", "words", "does"),
    [
        ("15.3", "B sleeps", 1),
        ("15.3", "B 0", 1),
        ("15.3", "C full", "how full"),
        ("15.3", "B not", "none of the options"),
        ("15.3", "B no", "none of the options"),
        ("15.3", "B is wrong", "none of the options"),
        ("7.4", "B becomes two", "none of the options"),
        ("16.4", "D the other side", 1),
        ("19.6", "A chance", 1),
        ("19.6", "A filament", "none of the options"),
        ("15.3", "B, no wait, C", "you give 2"),
        ("15.3", "B. Rather C", "you give 2"),
        ("15.3", "B C", "none of the options"),
        ("12.4", "A 0.2", "none of the options"),
        ("8.3", "line 5: 1", 1),
        ("8.3", "X comes back, line 5", 1),
        ("8.3", "line 3 is fine, but 5 is wrong", 1),
        ("8.3", "all but line 5", "no line"),
        ("8.3", "not 4, line 5", "no line"),
    ],
)
def test_a_letter_or_line_is_read_with_words_of_ones_own_that_do_not_deny_it(name, words, does):
    verdict = check(name, words)
    assert verdict == 1 if does == 1 else does in verdict.message, str(verdict)


@pytest.mark.parametrize(("answer", "right"), [("27/255", "54/512"), ("28/264", "27/256"), ("27 in 255", "27 in 256")])
def test_a_fraction_is_compared_exactly_with_a_fraction(answer, right):
    assert check("8.1", answer) < 1 == check("8.1", right)


def test_a_mistake_is_shown_that_is_left_in_the_form_of_the_kit():
    assert "A value is missing here (line 1, column 5)" in check("7.6", "2**n//d").message
    assert "is an equation, and what it is to be solved for" in check("12.6", "b*(1-c) = 1").message
    assert check("12.6", "1/(1-c) = b") == 1


U, N, V, M, X, Y, L = sympy.symbols("u n v m x y L")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "answer"),
    [
        ("0.2", np.int64(64)),
        ("1.1", derive(read("axiom: bl\nar -> al br\nal -> bl ar\nbr -> ar\nbl -> al"), 4)[4]),
        ("1.2", Decimal(21)),
        ("1.2", 21.0),
        ("1.2", sympy.Integer(21)),
        ("2.1", np.array([2, 3, 5, 8, 13, 21])),
        ("2.1", (2, 3, 5, 8, 13, 21)),
        ("2.1", {0: 2, 1: 3, 2: 5, 3: 8, 4: 13, 5: 21}),
        ("2.2", sympy.Matrix([[1, 2], [1, 0]])),
        ("2.2", np.array([[1, 2], [1, 0]])),
        ("4.1", ((2, 2), 0)),
        ("4.2", 72.0),
        ("4.2", Fraction(360, 5)),
        ("7.2", 1.272),
        ("7.2", Decimal("1.272")),
        ("8.1", Fraction(27, 256)),
        ("8.1", sympy.Rational(27, 256)),
        ("8.1", 0.105),
        ("8.6", Decimal("0.8")),
        ("7.2", sympy.sqrt((1 + sympy.sqrt(5)) / 2)),
        ("10.5", U * N < V * M),
        ("10.5", V * M - U * N > 0),
        ("12.2", 2.618034),
        ("15.5", (Y < 0) | (X**2 + Y**2 > L**2)),
        ("17.1", ("b", "cba", "ccbaa", "cccbaaa")),
        ("17.1", derive(read("axiom: b\nb -> c b a\na -> a\nc -> c"), 3)),
        ("18.3", Fraction(4, 5)),
    ],
)
def test_an_object_is_a_right_answer_too(name, answer):
    assert check(name, answer) == 1, str(check(name, answer))


SHOWN_BY_QUOTING = "Not readable yet"
"""A reply about the form of an answer may repeat what was typed in the right form."""


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, exercise in KIT.items() if exercise.kind not in ("choice", "symbol", "line")])
def test_no_reply_gives_the_solution_away(name):
    solution = " ".join(KIT[name].solution.split())
    buts = [wrong.misconception.but for wrong in wrong_answers(KIT[name]) if wrong.misconception]
    for answer in [each for several in WRONG[name].values() for each in several]:
        verdict = check(name, answer)
        reply = " ".join(verdict.message.split())
        for sentence in (*buts, " ".join(str(answer).split())):
            reply = reply.replace(sentence, "")
        if verdict.said != SHOWN_BY_QUOTING:
            assert not re.search(rf"(?<![\w.]){re.escape(solution)}(?![\w.]|, )", reply), (answer, reply)


# What is said of commas and units


def test_a_comma_that_may_be_either_is_asked_about(tmp_path, monkeypatch):
    monkeypatch.setattr(registry, "_added", {})
    (tmp_path / "t.toml").write_text(
        'title = "T"\nobjectives = ["o"]\nintroduction = "i"\nsummary = "s"\n[[exercise]]\nid = "comma.1"\ntitle = "t"\n'
        'kind = "number"\nquestion = "q"\nexplanation = "e"\nhints = ["1", "2", "3"]\nobjective = 1\nsolution = "1234.5"\n'
        'tolerance = 1\notherwise = "o"\nexpects = ["sign reversed"]\n',
        encoding="utf-8",
    )
    exercises(tmp_path)
    assert "may stand before decimals or between thousands" in check("comma.1", "1,234").message
    assert check("comma.1", "1234,5") == check("comma.1", "1 234") == check("comma.1", "1234.5") == 1


def test_a_comma_is_between_thousands_where_things_are_counted_and_before_decimals_where_they_are_not():
    assert "1048575 is not" in check("2.4", "1,048,575").message
    assert check("7.2", "1,272") == check("12.2", "2,618") == 1


def test_the_unit_that_is_asked_for_is_named():
    assert "Its unit is: cm." in check("8.5", "20 degrees").message
    assert "2000 cm is not" in check("8.5", "20 m").message
    assert check("8.5", "0.2 m") == check("4.2", "0.4π") == 1
    assert check("3.2", "709 steps").said == "Not readable yet"


@pytest.mark.parametrize("answer", ["not 21", "more than 21", "20 or 21", "at least 21", "21 or so", "almost 21"])
def test_a_doubtful_number_is_none(answer):
    assert check("1.2", answer).said == "Not readable yet"


def test_a_word_among_the_numbers_of_a_table_is_passed_over_only_where_the_question_has_it():
    assert check("2.1", "2, cells, 3, 5, 8, 13, 21") == 1
    for odd in ("banana", "not"):
        assert check("2.1", f"2, 3, 5, 8, 13, 21, {odd}") == 0


# Steps that are named, and decimals


@pytest.mark.parametrize(
    "answer", ["64 at step 3", "step 3: 64", "N(3) = 64", "16 at step 2, 64 at step 3", "step 2: 16 and step 3: 64"]
)
def test_of_numbers_of_several_steps_that_of_the_step_in_question_is_taken(answer):
    assert check("0.2", answer) == 1


@pytest.mark.parametrize("answer", ["64 at step 4", "step 2: 64", "N(4) = 64", "64 at step " + "9" * 40])
def test_a_number_of_another_step_is_none(answer):
    assert check("0.2", answer).said == "Not readable yet"


@pytest.mark.parametrize(
    ("answer", "step"), [("the step after 18", 19), ("one step before 20", 19), ("2 steps after step 17", 19)]
)
def test_a_step_may_be_told_by_another_one(answer, step):
    assert check("2.4", answer) == check("2.4", step) == 1


DECIMALS = {"Two decimals": 2, "Three decimals": 3, "three decimals": 3}


@pytest.mark.parametrize("name", [name for name, each in KIT.items() if any(words in each.question for words in DECIMALS)])
def test_a_number_that_is_one_off_in_the_last_decimal_that_is_asked_for_is_wrong(name):
    exercise = KIT[name]
    places = next(number for words, number in DECIMALS.items() if words in exercise.question)
    right = round(float(Fraction(exercise.solution)), places)
    assert check(name, right) == 1
    for by in (-1, 1):
        assert check(name, round(right + by * 10**-places, places)) != 1
