"""What is seen of a model before it runs."""

from __future__ import annotations

from fractions import Fraction

import pytest

from lsys_kit.budget import limits
from lsys_kit.derivation.core.interpretation import interpretation_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.notation.analysis.lint import check_decomposition, warnings
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import function_of, is_random
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.read import read, read_expression, read_number
from tests.timing import spent

WALLS = """
dt = 0.7
axiom: W(0) M(0) W(dt)
W(t) -> W(t+dt)
M(t) : t < 1 -> M(t+dt)
W(tl) < M(t,p) > W(tr) : t >= 1 && tl < tr -> M(t) W(t-1) M(t+1)
W(tl) < M(t,p) > W(tr) : t >= 1 && tr > tl -> M(t+1) W(t-1) M(t)"""
"""L-system 9 of seed 002 as it is printed: its divisions ask for cells with two parameters, and there are none."""


def test_the_printed_l_system_9_cannot_divide() -> None:
    said = "The production W(tl) < M(t,p) > W(tr) can never match: no module M with 2 parameters occurs."
    assert read(WALLS).notes == (said, said)
    assert read(WALLS.replace("M(t,p)", "M(t)")).notes == ()


@pytest.mark.parametrize(
    ("rules", "missing"),
    [
        ("B -> A", "B"),
        ("A(t) -> A", "A with 1 parameter"),
        ("X < A -> A", "X"),
        ("A > [X]A -> A", "["),
        ("A > X -> A", "X"),
        ("A -> B(1)\nB -> A", "B without parameters"),
        ("decomposition:\nB -> C", "B"),
    ],
)
def test_a_production_that_never_matches_is_told(rules: str, missing: str) -> None:
    (note,) = read(f"axiom: A\n{rules}").notes
    assert note.endswith(f" can never match: no module {missing} occurs.")


STAYS = (
    "{} stays as it is in what {} is drawn as, though it has a rule too: {} rules are applied {}. To apply them to what "
    'they make, type "{}".'
)


@pytest.mark.parametrize(
    ("rules", "made", "rule", "often", "depth"),
    [
        ("M -> Q Q\nQ -> F", "Q", "M", "once", "depth: 2"),
        ("M -> [Q]\nQ -> R\nR -> F", "Q", "M", "once", "depth: 3"),
        ("M -> A\nA -> B\nB -> C\nC -> F\ndepth: 3", "C", "B", "3 times", "depth: 4"),
        ("M -> T(3)\nT(n) : n > 0 -> F T(n-1)", "T", "M", "once", "depth: 10"),
        ("M : 1 > 0 -> F M", "M", "M", "once", "depth: 10"),
    ],
)
def test_what_is_drawn_unfinished_is_told(rules: str, made: str, rule: str, often: str, depth: str) -> None:
    """Kurth and Prusinkiewicz apply interpretation rules to what they make; the kit does so as often as the depth says."""
    assert read(f"axiom: M\ninterpretation:\n{rules}").notes == (STAYS.format(made, rule, "interpretation", often, depth),)


@pytest.mark.parametrize(
    "rules",
    [
        "M -> F\nF -> !F",
        "M -> @o M",
        "M -> Q\nX -> Q",
        "M -> Q\nQ -> F\ndepth: 2",
        "M -> Q\nQ -> F\ndepth: 0",
        "M : 1 > 0 -> F M\ndepth: 7",
        "X -> Q\nQ -> F",
    ],
)
def test_what_is_drawn_as_it_is_meant_is_not_told(rules: str) -> None:
    assert read(f"axiom: M\ninterpretation:\n{rules}").notes == ()


@pytest.mark.parametrize(
    ("notation", "text", "interpretation", "depth"),
    [
        ("cpfg", "Axiom: M\nhomomorphism\nM --> QQ\nQ --> F", "homomorphism", "maximum depth: 2"),
        ("grogra", "\\axiom M,\nM ## Q Q,\nQ ## F", "interpretation", "\\set depth 2"),
    ],
)
def test_the_depth_to_type_is_that_of_the_notation(notation: str, text: str, interpretation: str, depth: str) -> None:
    system = read(text, notation)
    assert system.notes == (STAYS.format("Q", "M", interpretation, "once", depth),)
    deeper = text.replace("M --> QQ", f"{depth}\nM --> QQ").replace("\\axiom", f"{depth},\n\\axiom")
    assert read(deeper, notation).notes == ()
    assert [str(module) for module in interpretation_of(States(read(deeper, notation)), Module("M"))] == ["F", "F"]


def test_what_is_drawn_as_itself_again_is_told_before_it_is_drawn() -> None:
    assert read("depth: 40\naxiom: A\ninterpretation:\nA -> F B\nB -> A A").notes == (
        "A is drawn as itself again (A -> B -> A): the depth ends that after 40 times.",
    )


@pytest.mark.parametrize(
    "rules",
    [
        "A -> B\nB -> A",
        "A -> repeat(2) <B>\nB -> A",
        "A -> A\ndecomposition:\nA -> B\nB -> ε",
        "A -> A A\nmeta: A A -> C\nC -> A",
        "A -> A\ninterpretation:\nX -> F",
    ],
)
def test_what_may_match_is_not_told(rules: str) -> None:
    assert read(f"axiom: A\n{rules}").notes == ()


@pytest.mark.parametrize(
    ("rules", "note"),
    [
        ("A -> B\nA -> C", "Production 2, for A, is never applied: production 1 comes before it and matches every A."),
        (
            "B(t) : t > 2 -> A\nB(t) -> A\nB(1) -> C\nA -> B(1)",
            "Production 3, for B(1), is never applied: production 2 comes before it and matches every B(1).",
        ),
        (
            "A -> B\nB < A > B : 1 < 2 -> C\nB -> A",
            "Production 2, for B < A > B, is never applied: production 1 comes before it and matches every A.",
        ),
        ("A -> B\nA -> C : 1/2", "Production 2, for A, is never applied: production 1 comes before it and matches every A."),
        (
            "decomposition:\nA -> B\nA -> C",
            "Decomposition rule 2, for A, is never applied: decomposition rule 1 comes before it and matches every A.",
        ),
    ],
)
def test_a_production_that_another_always_precedes_is_told(rules: str, note: str) -> None:
    assert read(f"axiom: A\n{rules}").notes == (note,)


@pytest.mark.parametrize(
    "rules",
    [
        "A : 1 < 2 -> B\nA -> C",
        "B < A -> B\nA -> C B\nB -> A",
        "A > B -> B\nA -> C B\nB -> A",
        "A -> B : 1/2\nA -> C : 1/2",
        "A -> B(1)\nB(1) -> A\nB(t) -> C",
        "A -> B(1)\nB(k) -> A\nB(t) -> C",
        "A -> B\nB -> A\ndecomposition:\nB -> C",
        "A -> B(1)\nB(t) -> B\nB -> A",
    ],
)
def test_productions_that_have_their_turn_are_not_told(rules: str) -> None:
    assert read(f"k = 1\nalphabet: k\naxiom: A\n{rules}").notes == ()


def test_no_certain_production_is_told_behind_chance() -> None:
    assert not any("never applied" in note for note in read("axiom: A\nA -> B : 1/2\nA -> C\nA -> D").notes)


@pytest.mark.parametrize("rules", ["A -> A", "A -> B\nB -> C\nC -> x A", "A -> repeat(1) <A>", "A(t) -> A(t-1)", "A -> [A]"])
def test_endless_decomposition_is_told_before_it_runs(rules: str) -> None:
    with pytest.raises(ModelValueError, match=r"Rule A decomposes into itself: A -> .* It can never finish"):
        read(f"axiom: B\ndecomposition:\n{rules}")


@pytest.mark.parametrize(
    "rules",
    [
        "A(t) : t > 0 -> A(t-1)",
        "A -> A : 0.5\nA -> B : 0.5",
        "A(1) -> A(2)",
        "A(k) -> A(2)",
        "A(t) -> A",
        "A -> repeat(0) <A>",
        "A -> B\nA -> A",
        "A(t) : t > 0 -> x\nA(t) -> A(1)",
        "A -> B\nB -> C\nC -> D D",
    ],
)
def test_decomposition_that_may_finish_is_read(rules: str) -> None:
    assert read(f"k = 1\naxiom: A\ndecomposition:\n{rules}").decomposition


@pytest.mark.slow
def test_many_rules_are_looked_through_quickly() -> None:
    with limits(rules=5_000):
        system = read("axiom: A0\ndecomposition:\n" + "\n".join(f"A{i} -> A{i + 1} A{i + 2}" for i in range(5_000)))
    with spent() as taken:
        check_decomposition(system)
        warnings(system)
    assert taken.seconds < 2  # comparing each rule with each would take longer on any machine


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("sin(30)", Fraction(1, 2)),
        ("cos(60)", Fraction(1, 2)),
        ("cos(240)", Fraction(-1, 2)),
        ("sin(-450)", -1),
        ("cos(90)", 0),
        ("tan(45)", 1),
        ("tan(135)", -1),
        ("tan(180)", 0),
        ("asin(1/2)", 30),
        ("acos(-1)", 180),
        ("acos(1/2)", 60),
        ("atan(-1)", -45),
        ("mod(7, 3)", 1),
        ("mod(-1/2, 1)", Fraction(1, 2)),
        ("if(1 < 2, 3, 1/0)", 3),
        ("if(1 > 2, 1/0, 4)", 4),
    ],
)
def test_functions_are_exact_where_they_can_be(text: str, value: Value) -> None:
    assert read_number(text) == value
    assert not isinstance(read_number(text), float)


def test_other_angles_are_doubles() -> None:
    assert read_number("sin(45)^2") == pytest.approx(0.5)
    assert read_number("atan(1000000)") == pytest.approx(90, abs=1e-4)
    assert read_number("cos(1/3) - cos(1080 + 1/3)") == 0
    assert isinstance(function_of(read_expression("sin(30)"), {}, "float")(()), float)


@pytest.mark.parametrize("text", ["tan(90)", "tan(-270)", "asin(2)", "acos(-1.5)"])
def test_where_a_function_has_no_value_it_is_said(text: str) -> None:
    with pytest.raises(ModelValueError, match="is not a number"):
        read_number(text)


class Dice:
    """Draws what was written down."""

    def __getattr__(self, name: str) -> object:
        return lambda *values: (name, values)


@pytest.mark.parametrize(
    "text", ["uniform(t, 2)", "normal(t, 2)", "binomial(t, 2)", "poisson(t)", "table(t, 1, 2)", "table(t)"]
)
def test_random_numbers_are_drawn_by_what_stands_behind_the_values(text: str) -> None:
    expression = read_expression(text)
    assert is_random(expression)
    name, values = function_of(expression, {"t": 0})((5, Dice()))
    assert (name, values[0], len(values)) == (text.split("(")[0], 5, text.count(",") + 1)
    assert not is_random(read_expression("sin(t) + if(t < 1, 2, 3)"))
    assert is_random(read_expression(f"1 + max(2, {text})"))


@pytest.mark.parametrize(
    ("text", "note"),
    [
        ("axiom: a\nA -> A B", 'The production A can never match: no module A occurs. Did you mean "a"?'),
        ("axiom: A\nA -> B\nC -> D\nD -> C", "The production C can never match: no module C occurs."),
        ("axiom: A(1)\nA(t) -> A(t,1)", "No production matches A with 2 values: that for A has 1."),
        (
            "axiom: A B\nA -> B;",
            'The ";" after the production for A is read as a command of the turtle; a line needs no sign at its end.',
        ),
        (
            "axiom: A\nA -> B.",
            'The "." after the production for A is read as a command of the turtle; a line needs no sign at its end.',
        ),
        (
            "axiom: A\nA -> B : 0.5\nA -> C",
            "Production 2, for A, has no probability: it is applied only where none of those that have one matches.",
        ),
        (
            "axiom: A ?E(0)\nA -> A",
            'Nothing in the model answers ?E: name a field, as in "field: light", or derive with field=...',
        ),
    ],
)
def test_what_is_probably_not_meant_is_noted(text: str, note: str) -> None:
    assert note in read(text).notes


@pytest.mark.parametrize(
    "text",
    [
        "axiom: F(2) F\nF -> F F",
        "axiom: A\nA -> {F.F.F.}",
        "axiom: A\nA -> B ; C",
        "axiom: a\na -> ab\nb -> a",
        "axiom: A\nA -> B\nB -> ;;",
        "axiom: A\nA -> B\nB -> ;",
        "axiom: A\nA -> B;\nB -> F;F",
        "axiom: A\nA -> B : 0.5\nA -> C : 0.5",
        "axiom: A\nA -> B\nB < A -> C\nB -> A B",
    ],
)
def test_what_may_well_be_meant_is_not_noted(text: str) -> None:
    assert not any(
        "never match" in note or "No production" in note or "line needs" in note or "no probability" in note
        for note in read(text).notes
    )


@pytest.mark.parametrize(
    ("rules", "said"),
    [
        ("A -> A B # grow", "#grow"),
        ("A -> AB//grow", "//grow"),
        ("A -> A // it grows", "//it grows"),
        ("A -> A % a leaf.", "%a leaf."),
        ("A -> A -- grow", "--grow"),
        ("A -> A ; grow", ";grow"),
        ("A -> [A] # grow", "#grow"),
    ],
)
def test_a_comment_in_another_language_is_noted_as_modules(rules: str, said: str) -> None:
    assert (
        f'The "{said}" after the production for A is read as modules, not as a comment, which is written '
        'between "/*" and "*/".' in read(f"axiom: A\n{rules}").notes
    )


@pytest.mark.parametrize(
    ("rule", "said"),
    [
        ("A --> AB//grow", '"//grow" is read as symbols, two rolls first; a'),
        ("A --> A # grow", '"# grow" is read as symbols; a'),
    ],
)
def test_a_comment_in_a_word_of_cpfg_is_noted_as_symbols(rule: str, said: str) -> None:
    assert f'{said} comment is written between "/*" and "*/".' in read(f"Axiom: A\n{rule}", "cpfg").notes


@pytest.mark.parametrize(
    "rules",
    [
        "A -> A//F#F",
        "A -> A # leaf\nleaf -> A",
        "A -> A;leaf",
        "A -> A//(90)leaf",
        "A -> A [# leaf]",
        "A -> # leaf A leaf\nB -> leaf",
        "A -> repeat(2) <# A>",
    ],
)
def test_signs_before_symbols_are_no_comments(rules: str) -> None:
    assert not any("is read as modules" in note for note in read(f"axiom: A\n{rules}").notes)


@pytest.mark.parametrize(
    ("text", "note"),
    [
        ("axiom: A\nA -> F(0,5)A", 'F(0,5) has two values: a decimal is written with a point. Did you mean "F(0.5)"?'),
        ("axiom: A\nA -> +(22, 5)A", '+(22,5) has two values: a decimal is written with a point. Did you mean "+(22.5)"?'),
        ("axiom: A(1)\nA(t) -> A(0,05)", 'A(0,5) has two values: a decimal is written with a point. Did you mean "A(0.05)"?'),
    ],
)
def test_a_decimal_with_a_comma_is_noted(text: str, note: str) -> None:
    assert note in read(text).notes


@pytest.mark.parametrize(
    "text",
    [
        "axiom: A(0,5)\nA(x,y) -> A(y,x)",
        "axiom: A(1)\nA(t) -> A(t)L(0,5)",
        "axiom: A\nA -> F(0.5)",
        "axiom: A(1)\nA(t) -> B(t,2)",
    ],
)
def test_two_values_where_there_are_two_are_not_noted(text: str) -> None:
    assert not any("a decimal" in note for note in read(text).notes)


def test_a_context_that_is_passed_over_is_noted() -> None:
    assert read("ignore: +\naxiom: A + B\n+ < B -> A").notes == ("The production + < B can never match: contexts pass over +.",)
    assert read("consider: A\naxiom: A + B\n+ < B -> A").notes[0].endswith("contexts pass over +.")
    assert read("consider: A\naxiom: A + B\nA < B > [A] -> A").notes == (
        "The production A < B > [A] can never match: no module [ occurs.",
    )


@pytest.mark.parametrize(
    ("text", "waits"),
    [("axiom: a(0)\na(1) -> a(0) b(0)\nb(1) -> a(0)", "a(1)"), ("d = 1\naxiom: a(0,2) X\na(2*d,x) -> a(0,x)", "a(2 * d,x)")],
)
def test_a_timed_system_stays_as_it_is_in_steps(text: str, waits: str) -> None:
    system = read(text)
    (note,) = system.notes
    assert f"that for {waits} wait for an age" in note
    assert "timed(system).word(t)" in note
    assert list(derive(system, 3)[3]) == list(derive(system, 3)[0])


@pytest.mark.parametrize(
    "text",
    [
        "axiom: A(0)\nA(0) -> A(1)\nA(1) -> B",
        "d = 0\naxiom: A(0)\nA(d) -> B",
        "axiom: A\nA -> A(1)\nA(1) -> A",
        "axiom: a(0)\na(1) -> a(0)\na(t) : t < 1 -> a(t+1)",
        "axiom: a(0)\na(1) -> b\ndecomposition:\na(0) -> a(1)",
    ],
)
def test_what_happens_in_steps_is_no_timed_system(text: str) -> None:
    assert not any("wait for an age" in note for note in read(text).notes)


def test_nothing_is_said_of_an_age_that_has_no_value() -> None:
    assert not read("axiom: A(1/0)\nA(2) -> B").notes


@pytest.mark.parametrize("text", ["axiom: A or B\nA -> A B", "axiom: A\nA -> A B or B", "axiom: A\nA -> A und B"])
def test_a_word_of_a_language_between_modules_is_told(text: str) -> None:
    assert any("is read as a symbol. A system has one axiom" in note for note in read(text).notes)


@pytest.mark.parametrize("text", ["axiom: A or B\nor -> A", "axiom: or B\nB -> B or", "alphabet: or\naxiom: A or B\nA -> B"])
def test_nothing_is_said_of_such_a_word_where_it_is_a_symbol(text: str) -> None:
    assert not any("is read as a symbol. A system" in note for note in read(text).notes)


def test_an_angle_that_is_a_difference_is_told() -> None:
    assert read("angle: 20-30\naxiom: F").notes == ('The angle "20-30" is a difference. Give one number.',)
    assert read("angle: 360/7\naxiom: F").notes == ()


def test_a_row_of_a_table_is_no_rule() -> None:
    with pytest.raises(LSystemError, match="This is a row of a table"):
        read("axiom: A\n| A -> | A B |\n| B -> | A |", "abop")
