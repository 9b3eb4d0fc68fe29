"""Repairs: a wrong answer is answered by the smallest change that makes it right, and by nothing that is not true of it."""

import re
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from random import Random
from time import thread_time

import pytest

from lsys_kit import check, exercises, language
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.judging import judged, wrong_answers
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS, solution_of
from lsys_kit.classroom.exercises.repairs import table
from lsys_kit.classroom.exercises.repairs.of_expressions import _grouped_otherwise
from lsys_kit.classroom.exercises.repairs.of_systems import changed_once
from lsys_kit.classroom.exercises.repairs.table import REPAIRS, repaired
from lsys_kit.classroom.exercises.typed import means_the_same
from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.expressions import Apply
from lsys_kit.notation.model.modules import Pattern
from tests.classroom.answers import as_typed

FIBONACCI = "axiom: a\na -> a b\nb -> a"
AGES = "axiom: A(0)\nA(t) : t < 3 -> A(t+1)\nA(t) : t == 3 -> A(0) A(1)"
ALL = exercises()


def asked(kind, solution, **keys):
    return Exercise("t", "", kind, "q", solution, "e", ("1", "2", "3"), **keys)


def said(exercise, answer):
    return judged(exercise, answer)[0].message


# Systems


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ("axiom: a\na -> a b", "One production is missing: what becomes of b?"),
        ("axiom: a\na -> a b\nb -> a\nb -> b a", "One of your productions is never used"),
        ("axiom: b\na -> a b\nb -> a", "The productions are right, and the axiom is not"),
        ("axiom: a\na -> a\nb -> a", "One module is missing. Look at this production:\n  a -> a"),
        ("axiom: a\na -> a b b\nb -> a", "There is one module too many. Look at this production:\n  a -> a b b"),
        ("axiom: a\na -> b a\nb -> a", "write the daughters in the reverse order"),
        ("axiom: a\na -> a b\nb -> b", "One module is not right. Look at this production:\n  b -> b"),
        ("axiom: a\na -> a\nb -> a b", "exchange what two kinds of modules become"),
        ("axiom: a\na -> ab", "One production is missing: what becomes of b?"),
        ("axiom: b\na -> a a b\nb -> a", "Two things are not right yet."),
    ],
)
def test_what_is_to_be_changed_in_a_system_is_said(answer, words):
    assert words in said(asked("system", FIBONACCI, steps=6), answer)


@pytest.mark.parametrize(
    ("condition", "words"),
    [
        (": t < 5", "One bound is not right. Try this production with A(3)"),
        (": t < 1", "One bound is not right. Try this production with A(1)"),
        (": t != 3 || t > 9", None),
        (": t != 2", "Try this production with A(2)"),
        (": t > 3", "One comparison is not right. Try this production with A(0)"),
    ],
)
def test_a_condition_is_answered_with_a_module_for_which_it_is_not_right(condition, words):
    answer = AGES.replace(": t < 3", condition)
    message = said(asked("system", AGES, steps=8), answer)
    assert words is None or words in message
    if words:
        assert message.endswith(f"\n  A(t) {condition} -> A(t+1)")


@pytest.mark.slow
def test_a_right_production_is_not_blamed_for_one_that_is_missing():
    literal = "axiom: M(1)\nM(1) -> M(2)\nM(2) -> M(3)\nM(3) -> M(1) M(2)"
    assert "\n  M(1) -> M(2)" not in check("6.5", literal).message
    assert "\n  M(2) -> M(3)" not in check("6.5", literal).message


def test_a_production_of_the_question_is_not_blamed():
    for answer in ("F(l) : l <= 40 -> F(2*l)", "F(l) : l < 90 -> F(2*l)", "F(l) -> F(3*l)"):
        assert "A -> F(10)" not in check("18.5", answer).message


@pytest.mark.slow
@pytest.mark.parametrize("name", [exercise.id for exercise in ALL if exercise.kind in ("system", "drawing")])
def test_a_misconception_is_named_only_of_an_answer_of_its_form(name):
    """No complete system is said to lack a production, and none without conditions to have left one out."""
    exercise = next(each for each in ALL if each.id == name)
    for wrong in wrong_answers(exercise):
        if exercise.kind == "system" and wrong.misconception and wrong.misconception.name == "production missing":
            changing = [rule for rule in wrong.answer.own.productions if rule.successor != rule.predecessors]
            assert len(changing) < len(solution_of(exercise).own.productions)


@pytest.mark.slow
@pytest.mark.parametrize("name", [exercise.id for exercise in ALL if exercise.kind == "system"])
def test_a_system_of_another_question_is_answered_too(name):
    literal = "axiom: a(1)\na(1) -> a(2)\na(2) -> a(1) b(1)\nb(i) : i < 3 -> b(i+1)\nb(3) -> a(1) b(1)"
    for answer, right in ((literal, ("7.5",)), ("axiom: A\nA -> F(10) A\nF(l) : l < 80 -> F(2*l)", ("18.5",))):
        assert (check(name, answer) == 1) is (name in right), answer


def test_opposite_turns_by_opposite_angles_are_the_same():
    assert check("13.5", r"A -> F [&(45) F] \(240) A") == check("13.5", "A -> F [^(-45) F] /(480) A") == 1
    assert check("13.5", r"A -> F [&(45) F] \(120) A") < 1


def test_what_stands_behind_the_given_productions_need_not_be_right_in_front_of_them():
    given = "axiom: M(1)\nM(s) : s < 4 -> M(s+1)"
    last = asked("system", "M(s) : s == 4 -> M(2) M(1)", given=given, steps=9)
    answer = "M(s) -> M(2) M(1)"
    assert judged(last, answer)[0] < 1
    assert judged(replace(last, behind=True), answer)[0] == 1


@pytest.mark.parametrize(
    ("answer", "what"),
    [("s == 6", "is a condition"), ("s>5 and s<7", "is a condition"), ("6", "is a number"), ("M(3) M(1)", "is a word")],
)
def test_a_part_of_a_production_is_taken_for_what_it_is(answer, what):
    verdict = check("6.3", answer)
    assert (verdict.said, what in verdict.message) == ("Not readable yet", True)


# Drawings, formulas, nets, maps


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ("F[-F]F[-FF]F", "One sign is not right."),
        ("F[-F]F[+F]F", "One stroke is missing."),
        ("F[-F]F[+FFF]F", "There is one stroke too many."),
        ("F[-F]F+FFF", "Brackets are missing."),
        ("f[-F]F[+FF]F", "One of F and f is taken for the other."),
        ("F[+F]F[-FF]F", "take + for -"),
        ("FF[-F]F[+FF]F", "There is one stroke too many."),
        ("F[-F]F", "Several characters in a row are missing."),
    ],
)
def test_what_is_to_be_changed_in_a_drawn_word_is_said(answer, words):
    message = check("4.3", answer).message
    assert words in message
    assert "old word" not in message  # nothing is rewritten


def test_an_angle_is_told_from_rules():
    assert check("0.5", "angle: 45\naxiom: F\nF -> F[+F]F[+F]F").message == "The rules are right, and the angle is not."


@pytest.mark.slow
@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ("y < 1 || x^2 + y^2 > L^2", "Only one number is not right."),
        ("x < 0 || x^2 + y^2 > L^2 ", "exchange two of the names"),
        ("y < 0 || x^2 + x^2 > L^2", "Only one name is not right."),
        ("y < 0 && x^2 + y^2 > L^2", "Only && and || are exchanged."),
        ("x^2 + y^2 > L^2", "Only one part is missing."),
        ("y < 0 || x^2 + y^2 > L^2 || x < 0", "Only one part should not be there."),
        ("y <= -1 || x^2 + y^2 > L^2", "With x = "),
    ],
)
def test_what_is_to_be_changed_in_a_formula_is_said(answer, words):
    assert words in check("15.5", answer).message


@pytest.mark.parametrize(
    ("name", "answer", "words"),
    [
        ("6.6", "q^n - 1", "not where the parentheses stand"),
        ("6.7", "(2*q^n-1)/(2*q-1)", "not where the parentheses stand"),
        ("2.7", "5^(n+1) - 1/4", "not where the parentheses stand"),
        ("2.7", "(5^(n+1) + 1)/4", "Only one sign is not right."),
        ("12.6", "1", "Only one part is missing."),
        ("12.6", "c/(1-c)", "Only one part is missing."),
        ("8.7", "2^n*p", "Only one part is missing."),
        ("2.6", "n", "put n = 0 into your formula"),
    ],
)
def test_of_a_formula_the_smallest_change_is_said(name, answer, words):
    assert words in check(name, answer).message


@pytest.mark.parametrize("exercise", [each for each in ALL if each.kind == "expression"], ids=lambda each: each.id)
def test_a_formula_without_one_of_its_parentheses_is_told_so(exercise):
    solution = solution_of(exercise)
    for other in (changed for changed, _ in changed_once(solution, lambda part: _regrouped(part))):
        if not ANSWER_KINDS["expression"].same(exercise, other, solution):
            found = repaired(exercise, other, solution)
            assert found is not None
            assert "parentheses" in found.said(), str(other)


def _regrouped(part):
    return ((other, "") for other in _grouped_otherwise(part)) if isinstance(part, Apply) else iter(())


@pytest.mark.slow
@pytest.mark.parametrize("exercise", [each for each in ALL if each.kind in ("system", "map")], ids=lambda each: each.id)
def test_a_production_too_many_is_told_as_such(exercise):
    """Where the answer is right without it, no other production is blamed, nor a part of it."""
    extra = "B -> A" if exercise.kind == "map" else _extra(exercise)
    typed = f"{exercise.solution.strip()}\n{extra}"
    verdict = judged(exercise, typed)[0]
    assert verdict == 1 or verdict.message.endswith(f"too many:\n  {extra}") or "never used" in verdict.message, verdict


def _extra(exercise):
    """A production that makes two of a symbol that the solution leaves as it is."""
    own = solution_of(exercise).behind
    replaced = {rule.predecessor.symbol for rule in own.productions}
    made = [each for rule in own.productions for each in rule.successor if isinstance(each, Pattern)]
    for each in made:
        if each.symbol not in replaced and each.symbol.isalpha():
            values = f"({', '.join('xyz'[: len(each.arguments)])})" if each.arguments else ""
            return f"{each.symbol}{values} -> {each.symbol}{values} {each.symbol}{values}"
    return f"{next(iter(replaced))} -> ε"


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ("L -> S\nS -> A\nA -> B\nB -> L + S", "The diagram is right, but not the names of its stages"),
        ("A -> B\nB -> C\nC -> D\nD -> A + B", "The question names a stage S"),
        ("L -> A\nA -> B\nB -> L + S", "One transition is missing: what becomes of a token in S?"),
        ("S -> L\nL -> A\nA -> B\nB -> L + L", "One arrow leads to the wrong place. Look at the transition that empties B."),
        ("S -> L\nL -> A\nA -> B\nB -> L + 2 S", "how many tokens does it put into each place?"),
        ("S -> X\nX -> L\nL -> A\nA -> B\nB -> L + S", "There is one stage too many."),
        ("S -> L\nL -> Y\nY -> Z\nZ -> L + S", ""),
    ],
)
def test_a_net_holds_the_names_that_the_question_gives(answer, words):
    assert check("5.5", answer).message.endswith(words) or words in check("5.5", answer).message
    assert (check("5.5", answer) == 1) is (words == "")


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ("A -> A[-D][+D]A", "The label of a marker is not right:"),
        ("A -> A[-C][+C]A[-C][+C]A", ""),
        ("C -> A[-C][+C]A", "None of your rules is for a wall of the first cell"),
        ("A -> A[-C][+C]A\nB -> A", "There is one production too many:\n  B -> A"),
    ],
)
def test_what_is_to_be_changed_in_a_rule_for_walls_is_said(answer, words):
    verdict = check("16.5", answer)
    assert verdict < 1
    assert words in verdict.message


def test_a_marker_whose_arrow_is_wrong_is_not_said_to_lie_on_the_other_side():
    exercises(Path(__file__).parent / "questions")
    assert check("kinds.map", "A> -> D>[-A<]B>").message.startswith("An arrow is not right:")
    assert "the two sides of a wall" in check("kinds.map", "A> -> D>[+A>]B>").message


# Laws


REPAIRED = [exercise for exercise in ALL if exercise.kind in REPAIRS]


def _changed_solutions(exercise):
    """The solution with one thing changed: its own repairs towards the wrong answers that are understood."""
    solution = solution_of(exercise)
    for wrong in wrong_answers(exercise):
        for repair in REPAIRS[exercise.kind](exercise, solution, wrong.answer):
            try:
                answer = repair.answer()
                if not ANSWER_KINDS[exercise.kind].same(exercise, answer, solution):
                    yield answer
            except LSystemError:
                continue


@pytest.mark.slow
@pytest.mark.parametrize("exercise", REPAIRED, ids=lambda each: each.id)
def test_a_solution_with_one_thing_changed_is_repaired_and_the_repair_is_right(exercise):
    kind, solution = ANSWER_KINDS[exercise.kind], solution_of(exercise)
    alike = kind.alike or kind.same
    changed = [answer for answer, _ in zip(_changed_solutions(exercise), range(400), strict=False)]
    for each in Random(1).sample(changed, min(len(changed), 20)):
        try:
            answer = kind.read(exercise, as_typed(exercise, each))
        except LSystemError:  # nobody can type that
            continue
        found = repaired(exercise, answer, solution)
        assert found is not None or any(alike(exercise, answer, wrong.answer) for wrong in wrong_answers(exercise)), answer
        if found is not None:
            assert kind.same(exercise, found.answer(), solution)
            assert exercise.solution not in found.said()


def test_where_no_more_changes_are_tried_the_first_difference_is_shown(monkeypatch):
    monkeypatch.setattr(table, "MOST_TRIED", 0)
    assert "One production is missing" not in said(asked("system", FIBONACCI, steps=6), "axiom: a\na -> a b\nc -> a")
    assert said(asked("system", FIBONACCI, steps=6), "axiom: a\na -> a b\nc -> a")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "answer"),
    [
        ("7.5", "axiom: a(1)\na(i) : i <= 2 -> a(i+1)\na(i) : i > 2 -> a(1) b(1)\nb(i) : i < 3 -> b(i+1)\nb(3) -> a(1) b(1)"),
        ("1.3", "axiom: al\nal -> ar bl\nar -> br al\nbl -> ar\nbr -> al"),
        ("2.6", "7*n + 3"),
        ("4.5", "FffF+FffF+FffF+FffF"),
    ],
)
def test_a_slow_machine_says_what_a_fast_one_says(name, answer, monkeypatch):
    message = check(name, answer).message
    monkeypatch.setattr(table, "processor_time", lambda: 4 * thread_time())
    assert check(name, answer).message == message


def test_of_long_words_fewer_changes_are_tried():
    long = asked("system", "axiom: a\na -> a a", steps=14)
    assert table._most_tried(long, solution_of(long)) == 3


NOUNS = "cells walls steps strokes letters words leaves shoots ants families buds moves systems tips rules branches".split()  # noqa: SIM905


@pytest.mark.slow
@pytest.mark.parametrize("exercise", [each for each in ALL if each.kind == "number"], ids=lambda each: each.id)
def test_a_number_of_other_things_is_not_the_right_one(exercise):
    for noun in NOUNS:
        is_unit = bool(exercise.unit) and means_the_same(noun, exercise.unit)
        assert (check(exercise.id, f"{exercise.solution} {noun}") == 1) is is_unit, noun
    for form in ("about {}", "It is {}.", "x = {}", f"{{}} {exercise.unit}"):
        assert check(exercise.id, form.format(exercise.solution)) == 1, form
    is_a_factorial = exercise.solution in [*map(str, range(3, 11))]  # a small one, as somebody may mean it
    assert (check(exercise.id, f"{exercise.solution}!") == 1) is not is_a_factorial


def _words_of(text):
    return " ".join(word.strip(".,:") for word in text.split())


@pytest.mark.parametrize("exercise", [each for each in ALL if each.kind == "choice"], ids=lambda each: each.id)
def test_words_that_several_options_have_are_asked_about(exercise):
    texts = [" ".join(option.text.replace("`", "").split()).casefold() for option in exercise.options]
    words = [text.split() for text in texts]
    for own in words:
        for first, last in combinations(range(len(own) + 1), 2):
            part = " ".join(own[first:last]).strip(".,:")
            if (
                len(part) > 4
                and part[0].isalpha()
                and sum(f" {part} " in f" {_words_of(text)} " for text in texts) > 1
                and part not in texts
            ):
                assert check(exercise.id, part).said == "Not readable yet", part


@pytest.mark.parametrize("exercise", [each for each in ALL if each.kind == "choice"], ids=lambda each: each.id)
def test_an_option_with_a_reason_is_that_option(exercise):
    for letter in letters(exercise):
        assert (check(exercise.id, f"{letter}, because I think so") == 1) is (letter == exercise.solution)
        assert (check(exercise.id, [letter]) == 1) is (letter == exercise.solution)
    assert check(exercise.id, ["A", "B"]).said == check(exercise.id, "A and B").said == "Not readable yet"


# Numbers, tables, words


def test_decimals_that_are_wanted_must_be_given():
    assert "more decimals are asked for" in check("12.3", 0.4).message
    assert [check("12.3", number) == 1 for number in (0.38, 0.382, 0.38197)] == [False, True, True]


def test_an_answer_that_is_a_step_is_shown_what_there_is_at_it():
    assert "At step 18 the length" in check("2.4", 18).message or "not yet past it" in check("2.4", 18).message
    assert "At step 21 the length of the word is 4,194,303, which is more than 1,000,000." in check("2.4", 21).message


@pytest.mark.parametrize("answer", ["2w", "x < 3", "s == 6", "a = 1 + a^0.5", "3 and 1"])
def test_what_is_no_number_is_taken_for_what_it_is(answer):
    assert check("9.3", answer).said == "Not readable yet"


def test_no_sentence_of_a_reply_hangs_in_the_air():
    for name, answer in (("12.2", -1), ("7.2", 0), ("8.6", -1), ("15.2", 0), ("15.2", -3)):
        message = check(name, answer).message
        assert not re.search(r"Which of the two|If the sum|that share|-\d", re.sub(r"^-?\d+ ", "", message)), message


@pytest.mark.parametrize(
    ("name", "answer"), [("18.1", "20"), ("2.4", "1048575"), ("8.5", "160000"), ("17.5", "axiom: C\nC -> A C B")]
)
def test_a_real_try_earns_hints(name, answer):
    assert "Hint 1 of 3" in check(name, answer, hint=1).message


def test_one_off_is_said_of_what_is_counted():
    assert "one off" in check("9.2", 22).message
    for name, answer in (("15.4", 12), ("12.1", 5), ("7.2", 2.272)):
        assert "one off" not in check(name, answer).message


def test_a_number_of_another_step_is_told_before_a_slip_that_may_give_it():
    exercises(Path(__file__).parent / "questions")
    assert "That is how many there are at step 9." in check("anabaena.21", 9).message
    assert "one symbol too few" not in check("anabaena.21", 9).message


@pytest.mark.parametrize(
    "answer",
    [
        "outside at step 9, T at step 10",
        "At step 9 it is outside, so T is there at step 10.",
        "step 10 (it is outside at step 9)",
        "10, because at step 9 it is outside",
        "step 9 is too high; step 10 T",
    ],
)
def test_of_several_steps_that_of_which_the_question_asks_is_the_answer(answer):
    assert check("15.2", answer) == 1
    assert check("15.2", answer.replace("10", "11")) < 1


@pytest.mark.parametrize(
    ("name", "answer"), [("0.1", "the third one"), ("0.1", "die dritte"), ("2.3", "a -> bb, b -> ab"), ("0.4", "Antwort B")]
)
def test_an_option_is_named_by_its_place_and_by_its_text(name, answer):
    assert check(name, answer) == 1


def test_what_should_vanish_is_pointed_at_and_not_what_stands_behind_it():
    message = check("10.1", "F S [ + F S B ] F S A").message
    assert "Look at what becomes of the S at position 2 of step 1" in message


def test_numbers_in_the_order_of_another_step_are_told():
    assert "one place too late" in check("2.1", "1, 2, 3, 5, 8, 13").message
    assert "stand in each other's place" in check("2.1", "2, 3, 8, 5, 13, 21").message
    assert "And what? " not in check("2.1", 21).message
    assert "You have 1 number" in check("2.1", 21).message


@pytest.mark.parametrize("order", ["XF", "FX"])
def test_sequential_rewriting_is_named_in_either_order_of_the_productions(order):
    rules = {"F": "FX", "X": "F[+X]"}
    word = "F"
    for _ in range(3):
        for symbol in order:
            word = "".join(rules[symbol] if each == symbol else each for each in word)
    text = "angle: 30\naxiom: F\nF -> F X\nX -> F[+X]"
    for asks, answer in (("", " ".join(word)), ("length", len(word)), ("strokes", word.count("F"))):
        exercise = asked("number" if asks else "word", "1" if asks else "F", system=text, steps=3, asks=asks)
        assert "apply one production after another" in said(exercise, answer)


# What is true of an answer, and what is not


GROWTH = {
    "11.5": ("axiom: M(0)\nM(t) -> M(t+2.5)\ndecomposition:\nM(t) : t >= {} -> M(t-1) M(t-1)", 1),
    "12.5": ("axiom: M(1)\nM(x) -> M(2*x)\ndecomposition:\nM(x) : x >= {} -> M(2*x/3) M(x/3)", 4),
    "18.5": ("F(l) : l < {} -> F(2*l)", 80),
}


@pytest.mark.parametrize("name", GROWTH)
@pytest.mark.parametrize("by", ["0.5", "0.01", "0.0001", "-0.0001", "-0.01", "-0.3"])
def test_a_bound_that_is_a_little_off_is_not_right_where_numbers_need_not_be_whole(name, by):
    text, bound = GROWTH[name]
    assert check(name, text.format(bound)) == 1
    moved = check(name, text.format(f"{bound + float(by):.4f}"))
    assert moved < 1
    assert moved.message


@pytest.mark.parametrize("bound", ["3.2", "3.5", "3.99"])
def test_a_bound_between_whole_numbers_is_right_where_there_are_no_others(bound):
    assert check("6.5", f"axiom: M(1)\nM(s) : s < {bound} -> M(s+1)\nM(s) : s > {bound} -> M(1) M(2)") == 1


def test_a_bound_beyond_all_that_is_asked_for_does_no_harm():
    text, _ = GROWTH["12.5"]
    assert check("12.5", text.format("4 && x < 1000")) == 1


@pytest.mark.parametrize(
    ("name", "answer", "words", "others"),
    [
        ("7.7", "x^-p * 2*x^-q", "Only one sign is not right.", "parentheses"),
        ("7.7", "x^-p - 2*x^-q", "Only one sign is not right.", "parentheses"),
        ("15.5", "y < 0 || x^2 + y^2 > L", "Only one power is missing.", "not right"),
        ("15.5", "y >= 0 && x^2 + y^2 <= L^2", "This is the contrary", "Only"),
        ("2.6", "1 + 2 + 3", "gives the same whatever the value of n", "sign"),
        ("12.6", "1", "gives the same whatever the value of c", "Two things"),
        ("13.5", "A -> F [&(45) F] / A", "One module has no number in parentheses", "What stands"),
        ("5.5", "S -> L\nL -> A\nA -> B\nB -> L - S", '"-" is no name of a place (line 4', "arrow too many"),
        ("0.5", "angle: 25.7\naxiom: F\nF -> F[+F]F[+F]F\nF -> F[-F]F", "is never used", "sign"),
        ("1.4", "br = ar", "An arrow is needed here", "axiom"),
        ("9.6", "a > s = s a", "One production is missing: what becomes of s?", "axiom"),
        ("18.5", "F(l) : l < 80 -> 2*l", "numbers are multiplied in the parentheses", "successor"),
        ("7.2", "1 = x^-2 + x^-4", "is an equation", "With your number"),
        ("11.2", "dt < 1.3", "is a condition", "equation"),
        ("16.2", "1.5", "none of the options", "Several"),
        ("16.2", "2 cells", "Several options contain", "you give 2"),
        ("14.2", "p, r", "you give 2", "contain"),
        ("16.4", "A<", "none of the options", "divided"),
        ("5.4", "1", "none of the options", "contain"),
        ("17.3", "Nothing", "The first sentence names two axioms", "none of"),
        ("18.1", "minus 25%", "-0.25 is not", "unit"),
        ("18.3", "0.8 or -1.8", "several numbers", "true or false"),
        ("15.2", "height 10", '"height" is not the unit', "step 9"),
        ("6.2", "M(5,1)", "M(5,1)", "M(5.1)"),
        ("10.1", "f [+ f s b] f s a", 'no symbol "s"', "position"),
        ("2.7", "1 + 5 + ... + 5^n", "A formula has no dots", "Replace"),
        ("16.1", "9 edges and 2", "several numbers", "unit"),
        ("13.4", "left side", "none of the options", "roll"),
        ("18.6", "3 of 4", "What is counted is a whole number", "unit"),
        ("6.6", "2^(n-1)", "the same whatever the value of q", "n, q"),
    ],
)
def test_what_is_said_is_true_of_what_was_typed(name, answer, words, others):
    verdict = check(name, answer)
    assert verdict < 1
    assert words in verdict.message
    assert others not in verdict.message


# Both languages


def test_repairs_are_said_in_german():
    language("de")
    try:
        assert check("1.3", "axiom: bl\nar -> al br\nal -> bl ar\nbr -> ar\nbl -> al").message.startswith(
            "Die Produktionen stimmen"
        )
    finally:
        language("en")
