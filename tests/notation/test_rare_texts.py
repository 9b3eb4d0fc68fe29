"""Texts that are seldom seen: each is read as it is meant, or the slip in it is named at its place."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction

import pytest
import sympy

from lsys_kit.budget import limits
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError
from lsys_kit.notation.analysis.lint import warnings
from lsys_kit.notation.dialects.abop.dialect import ABOP
from lsys_kit.notation.dialects.cpfg.expressions import simplified
from lsys_kit.notation.dialects.fractint import systems as files
from lsys_kit.notation.dialects.grogra.probabilities import exclusive
from lsys_kit.notation.model.arithmetic import equal_values, expanded_value
from lsys_kit.notation.model.expressions import Apply, Name, Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import Constant, LSystem, Production
from lsys_kit.notation.read import read, read_expression
from lsys_kit.notation.syntax.systems import text_in
from lsys_kit.notation.syntax.text.transcript import Edit, edited
from lsys_kit.notation.write import write

SLIPS = [
    ("cpfg", "Axiom: A(1)\nA(t) : 1 {x = t + 1; --> F(x)", 'This "{" is never closed', 2, 10),
    ("cpfg", "Axiom: A(1)\nA(t) : 1 {x = t + 1; y = 2", 'This "{" is never closed', 2, 10),
    (
        "cpfg",
        "Axiom: A(1)\nA(t) : 1 {if (t > 1) {x = 2;} else {x = ran(1);}} --> F(x) : x",
        'The random number "x" would be drawn anew at each of its uses',
        2,
        37,
    ),
    (
        "cpfg",
        "Axiom: A(1)\nA(t) : 1 {x = t*t*t*t; y = x*x*x*x*x; z = y*y*y*y*y; w = z*z*z*z*z*z; v = w*w*w*w;} --> F(v)",
        "What is computed here becomes too long an expression",
        2,
        75,
    ),
    (
        "cpfg",
        f"Axiom: A(1)\nA(t) : 1 {{{'if (t > 1) {' * 60}x = 1;{'}' * 60}}} --> F(x)",
        "Choices are nested more than 50 deep",
        2,
        123,
    ),
    ("fractint", "Koch {\nAngle 6\nAxiom F\nF\n}", "This rule has no successor", 4, 1),
    ("fractint", "Angle 6\nAxiom F\nF\u2003", "This rule has no successor", 3, 1),
    ("fractint", "Koch {\nAngle 6\nAxiom F\nF  -> FF\n}", "Fractint has no arrows", 4, 4),
    ("fractint", "Angle 6\nAxiom F\nF --> F\u2014F", "Fractint has no arrows", 3, 3),
    ("fractint", "Angle 6\nAxiom F\nF=F}F", 'This "}" closes nothing', 3, 4),
    ("fractint", "Angle 6\nAxiom F\n}\nF=F", 'This "}" closes nothing', 3, 1),
    ("grogra", "\\axiom a;\na # b;\nb # a", 'This ";" does not separate rules', 1, 9),
    ("grogra", "\\axiom a\n\\axiom b", 'A "," is missing here', 1, 9),
    ("cpfg", "Axiom: A(1)\nA(t) : 1 {x = t + 1 ]} --> F(x)", 'I did not expect "]} " here', 2, 21),
    ("cpfg", "#define a ,1\nAxiom: A", 'The macro "a" is not a number', 1, 11),
    ("mathematica", "LRule[LEFT[], PRED[a], RIGHT[], SUCC[b] PRED[c]]\nAXIOM[a]", "PRED[...] is outside of an LRule", 1, 41),
    ("mathematica", "LRule[LEFT[], PRED[a], RIGHT[], SUCC[b] x]\nAXIOM[a]", 'I did not expect "x" here', 1, 41),
    ("grogra", "\\axiom a,\na # b\n c ,d @", "An arrow is missing here", 3, 7),
    ("grogra", "\\axiom a,\na\n b @ # c", "Only one symbol can be replaced", 3, 2),
    ("abop", "axiom: A(1)\nA(t) B < C < D -> B", 'This is a second "<"', 2, 12),
    ("abop", "axiom: A\n{A, B}", "An arrow is missing here", 2, 2),
    ("abop", "axiom: A\nP = {A, B}", "A value is missing here", 2, 5),
    ("abop", "axiom: A\n{A -> B, C -> D} E", 'A "," is not needed here', 2, 8),
    (None, "I -> I[A]A /* and so on", "This comment is never closed", 1, 12),
    ("grogra", "\\var f function 2 1,\n\\axiom a,\na # F(f)", '"f" is a function, and its values are missing', 3, 7),
]
"""A notation, or None where the text is to show which, a text, what is said of it, the line and the column."""


@pytest.mark.parametrize(("notation", "text", "message", "line", "column"), SLIPS)
def test_a_slip_is_named_at_its_place(notation: str | None, text: str, message: str, line: int, column: int) -> None:
    with pytest.raises(LSystemError) as caught:
        read(text, notation)
    assert (caught.value.message, caught.value.line, caught.value.column) == (message, line, column)


def test_what_a_lesson_prints_around_its_productions_is_passed_over() -> None:
    text = "Productions:\nNumber of productions: 1\nI -> IA\nStage 1 string: IA"
    for found in (read(text), read(text, "plant-string")):
        assert write(found, "plant-string") == "Axiom: I\nI -> IA"
        assert "No axiom is given: it is I." in found.notes


def test_names_are_divided_in_what_is_repeated_too() -> None:
    assert str(read("axiom: ab\na -> repeat(2) <ab>\nb -> a", "abop").productions[0]) == "a -> repeat(2) <a b>"


def test_an_inclusion_is_passed_over() -> None:
    found = read("p1 : A → B\nω : A\n#include K", "abop")
    assert '"#include K" is passed over.' in found.notes
    assert write(found, "abop") == "axiom: A\nA -> B"


def test_a_printed_production_may_go_on_in_the_next_line() -> None:
    found = read("ω : A\np1 : A → B\n     C\np2 : B → C", "abop")
    assert [str(rule) for rule in found.productions] == ["A -> B C", "B -> C"]


def test_a_random_number_whose_variance_is_no_square_keeps_its_root() -> None:
    for variance, deviation in ((15, "sqrt(15)"), (-4, "sqrt(-4)"), (16, "4")):
        found = read(f"\\var n normal 0 {variance},\n\\axiom a,\na # F(n)", "grogra")
        assert str(found.productions[0].successor[0]) == f"F(normal(0, {deviation}))"


def test_it_is_certain_of_few_conditions_that_they_exclude_each_other() -> None:
    young, old = read_expression("t < 5"), read_expression("t >= 5")
    assert exclusive(young, old)
    assert not exclusive(young, Name("t")), "a number is no condition"
    names = [" && ".join(f"{name} {sign} 1" for name in "abcdefgh") for sign in ("<", ">=")]
    assert not exclusive(*map(read_expression, names)), "there are too many cases"


def test_a_random_number_from_a_range_is_one_function() -> None:
    x, y, zero = Name("x"), Name("y"), Number(0)

    def drawn(low: Number, width: Apply | Name) -> Apply:
        return simplified(Apply("+", (x, Apply("uniform", (low, width)))))

    assert str(drawn(zero, Apply("-", (y, x)))) == "uniform(x, y)"
    for low, width in ((Number(1), Apply("-", (y, x))), (zero, y), (zero, Apply("+", (y, x))), (zero, Apply("-", (x, y)))):
        assert drawn(low, width) == Apply("+", (x, Apply("uniform", (low, width))))


def test_a_file_has_no_more_systems_than_the_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "MOST_ENTRIES", 2)
    text = "A {\nAxiom F\n}\n"
    assert len(files.entries(text * 2)) == 2
    with pytest.raises(ModelLimitError, match="This text has more than 2 systems"):
        files.entries(text * 3)


def test_fractint_has_no_empty_axiom() -> None:
    with pytest.raises(LSystemError, match="empty axiom"):
        write(LSystem((), (Production((Pattern("F"),), (Pattern("F"),)),), turtle="fractint", heading=0), "fractint")


def test_a_digit_that_nothing_declares_is_declared() -> None:
    system = LSystem((Pattern("1"),), (Production((Pattern("1"),), (Pattern("F"), Pattern("1"))),), angle=Fraction(90))
    assert read(write(system, "abop"), "abop").productions == system.productions


def test_a_function_of_grogra_without_values_is_called_by_its_name() -> None:
    found = read("\\var f function 2 0,\n\\axiom a,\na # F(f)", "grogra")
    assert str(found.productions[0].successor[0]) == "F(sensed(2))"


def test_a_star_alone_needs_no_axiom_in_grogra() -> None:
    found = read("* # A", "grogra")
    assert write(found, "grogra") == "* # A"
    assert write(replace(found, steps=3), "grogra") == "\\axiom * 1-3,\n* # A"


def test_empty_lines_that_a_condition_leaves_out_are_not_told() -> None:
    found = read("#if 0\n\n  \nA --> B\n#endif\nAxiom: A\nA --> C", "cpfg")
    assert found.notes == ("Left out, because of the conditions around: line 4.",)


def test_a_macro_or_an_array_without_its_brackets_is_a_name() -> None:
    """As for the preprocessor of C: only f(...) is put in place."""
    called = read("#define f(x) B(x+x)\nAxiom: A(1)\nA(t) --> f(t) [f]", "cpfg")
    assert str(called.productions[0]) == "A(t) -> B(t + t)[f]"
    indexed = read("Define: { array a[2] = {1,2}; }\nAxiom: A(1)\nA(t) --> B(a[1]) [a]", "cpfg")
    assert str(indexed.productions[0]) == "A(t) -> B(2)[a]"


COUNTED = [
    (
        "n = 0; m = 0;",
        "n = n + m; m = m + 1;",
        "A : n < 3 --> F A",
        "Axiom: A(0,0)\nA(n,m) : n < 3 --> FA(n + m,m + 1)\nA(n,m) --> A(n + m,m + 1)",
        "A carries n, m as parameters",
    ),
    (
        "n = 0;",
        "n = n + 1;",
        "A --> C\nC < B : n < 3 --> A\nB --> B\nC --> B",
        "Axiom: A(0)\nA(n) --> C(n + 1)\nC(n_l0) < B(n) : n < 3 --> A(n + 1)\nB(n) --> B(n + 1)\nC(n) --> B(n + 1)",
        "A, B, C carry n as a parameter",
    ),
]
"""Counters of cpfg, how they change, productions, the system whose modules carry them, and what is said of it."""


@pytest.mark.parametrize(("first", "then", "productions", "carrying", "said"), COUNTED)
def test_counters_that_depend_on_one_another_or_have_neighbours_are_carried(
    first: str, then: str, productions: str, carrying: str, said: str
) -> None:
    found = read(f"Axiom: A\nStart: {{{first}}}\nEndEach: {{{then}}}\n{productions}", "cpfg")
    assert write(found, "cpfg") == f"Lsystem: 1\n{carrying}\nendlsystem"
    assert found.notes == (f"To follow the steps {said}.",)


def test_cpfg_has_no_remainder_of_a_random_number() -> None:
    random = read("axiom: A\nA -> B(mod(uniform(0,1),2))")
    with pytest.raises(ModelValueError, match='The notation cpfg has no function "mod" of random numbers'):
        write(random, "cpfg")
    assert "mod" not in write(read("axiom: A(5)\nA(t) -> A(mod(t,2))"), "cpfg")


@pytest.mark.parametrize("source", ["natural", "symbols"])
def test_a_model_says_where_its_colours_come_from(source: str) -> None:
    found = read(f"colours: {source}\naxiom: A")
    assert found.colours == source
    assert read(write(found, "abop")) == found


def test_widths_may_be_in_pixels() -> None:
    found = read("widths: pixels\naxiom: A")
    assert found.widths == "pixels"
    assert read(write(found, "abop"), "abop") == found


def test_a_name_that_might_be_glued_is_declared() -> None:
    """JF reads as J F where both are symbols, unless the alphabet names it."""
    glued = LSystem((Pattern("JF"), Pattern("J")), (Production((Pattern("F"),), (Pattern("J"), Pattern("J"))),))
    assert write(glued, "abop") == "alphabet: JF\naxiom: JF J\nF -> J J"


LOST = [
    ("axiom: A\nA -> B", '"angle: 60"'),
    ("angle: 60\naxiom: B\nA -> B", '"axiom: A"'),
    ("angle: 60\naxiom: A\nA -> C", '"A -> B"'),
    ("angle: 60\naxiom: A\nA -> B\nB -> A", 'the productions without "B -> A"'),
    ("angle: 60\naxiom: A\n?", '"?"'),
]
"""What a careless writer might make of a system, and what of it does not read back."""


@pytest.mark.slow
@pytest.mark.parametrize(("text", "lost"), LOST)
def test_a_text_that_reads_back_as_another_system_is_never_given(text: str, lost: str) -> None:
    careless = replace(ABOP, write=lambda _: text)
    with pytest.raises(ModelValueError, match=re.escape(f"no way to write {lost}, which")):
        text_in(careless, read("angle: 60\naxiom: A\nA -> B"))


def test_a_text_that_is_longer_than_what_is_read_is_never_given() -> None:
    system = read("axiom: AAAAAAAA\nA -> B")
    with limits(line=10), pytest.raises(ModelLimitError, match="the limit is 10"):
        write(system, "abop")


def test_of_overlapping_edits_the_first_is_made() -> None:
    assert edited("ABCD", [Edit(1, 3, "x"), Edit(2, 4, "y")]).text == "AxD"


@pytest.mark.parametrize("rest", ["C", "+C", "[-F]F", "C\n\n  D"])
def test_a_production_with_its_probability_over_the_arrow_may_go_on_below(rest: str) -> None:
    found = read(f"ω : F\np1 : F .5→ F[+F]\n  {rest}\np2 : F .5→ F", "abop")
    assert found.productions[0] == read(f"axiom: F\nF -> F[+F] {' '.join(rest.split())} : 0.5").productions[0]
    assert len(found.productions) == 2


def test_rows_of_latex_end_with_two_backslashes() -> None:
    found = read("\\omega : A \\\\\nA \\rightarrow B \\\\\nB \\rightarrow A")
    assert write(found, "abop") == "axiom: A\nA -> B\nB -> A"


def test_an_and_within_a_word_joins_no_productions() -> None:
    found = read("Axiom: I\nRules: I -> IA and A -> I", "plant-string")
    assert write(found, "plant-string") == "Axiom: I\nI -> IA\nA -> I"
    assert str(read("Axiom: I\nRules: I -> I and A", "plant-string").productions[0]) == "I -> I a n d A"


def test_a_constant_without_a_value_warns_of_nothing() -> None:
    """Neither does a value that is not known: whether A(d) is ever A(1) is open."""
    rules = (Production((Pattern("A", (Number(1),)),), (Pattern("B"),)),)
    young = Pattern("A", (Number(0),))
    assert [found.code for found in warnings(LSystem((young,), rules))] == ["only in time"]
    assert warnings(LSystem((young,), rules, constants=(Constant("c", Name("d")),))) == []
    assert warnings(LSystem((Pattern("A", (Name("d"),)),), rules)) == []


@pytest.mark.slow
def test_sums_are_multiplied_out_before_they_are_compared() -> None:
    k = sympy.Symbol("k", real=True)
    assert equal_values(k * (k + 1), k**2 + k)
    with pytest.raises(TypeError):
        equal_values(k, 2 * k)
    with pytest.raises(OverflowError):
        expanded_value((k + 1) ** 1_000)


@pytest.mark.parametrize(("text", "marked"), [("Axiom  :", "Axiom"), ("Axiomm : A", "Axiomm"), ("Axiom A", "Axiom")])
def test_the_keyword_alone_is_marked(text: str, marked: str) -> None:
    with pytest.raises(LSystemError) as caught:
        read(text, "cpfg")
    assert caught.value.column == 1
    assert caught.value.end == 1 + len(marked)


@pytest.mark.parametrize("notation", ["abop", "cpfg", "grogra", "mathematica"])
def test_what_a_limit_refuses_is_not_taken_for_what_a_notation_lacks(notation: str) -> None:
    system = read("axiom: A(1) B")
    with limits(line=2), pytest.raises(ModelLimitError, match="This line has 4 characters; the limit is 2"):
        write(system, notation)
