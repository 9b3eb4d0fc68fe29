"""Texts that are seldom seen: each is read as it is meant, or the slip in it is named at its place."""

from __future__ import annotations

from fractions import Fraction

import pytest

from lsys_kit.errors import LSystemError, ModelLimitError
from lsys_kit.notation.dialects.cpfg.expressions import simplified
from lsys_kit.notation.dialects.fractint import systems as files
from lsys_kit.notation.dialects.grogra.conditions import exclusive
from lsys_kit.notation.model.expressions import Apply, Name, Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read, read_expression
from lsys_kit.notation.write import write

SLIPS = [
    ("cpfg", "Axiom: A(1)\nA(t) : 1 {x = t + 1; --> F(x)", 'This "{" is never closed', 2, 10),
    ("cpfg", "Axiom: A(1)\nA(t) : 1 {x = t + 1; y = 2", 'This "{" is never closed', 2, 10),
    ("cpfg", "Axiom: A(1)\nA(t) : 1 {if (t > 1) {x = 2;} else {x = ran(1);}} --> F(x) F(x)",
     'The random number "x" would be drawn anew at each of its uses', 2, 37),
    ("cpfg", "Axiom: A(1)\nA(t) : 1 {x = t*t*t*t; y = x*x*x*x*x; z = y*y*y*y*y; w = z*z*z*z*z*z; v = w*w*w*w;} --> F(v)",
     "What is computed here becomes too long an expression", 2, 75),
    ("cpfg", f"Axiom: A(1)\nA(t) : 1 {{{'if (t > 1) {' * 60}x = 1;{'}' * 60}}} --> F(x)",
     "Choices are nested more than 50 deep", 2, 123),
    ("fractint", "Koch {\nAngle 6\nAxiom F\nF\n}", "This rule has no successor", 4, 1),
    ("fractint", "Koch {\nAngle 6\nAxiom F\nF  -> FF\n}", "Fractint has no arrows", 4, 4),
    ("fractint", "Angle 6\nAxiom F\nF --> F\u2014F", "Fractint has no arrows", 3, 3),
    ("fractint", "Angle 6\nAxiom F\nF=F}F", 'This "}" closes nothing', 3, 4),
    ("fractint", "Angle 6\nAxiom F\n}\nF=F", 'This "}" closes nothing', 3, 1),
    ("grogra", "\\axiom a;\na # b;\nb # a", 'This ";" does not separate rules', 1, 9),
    ("grogra", "\\axiom a\n\\axiom b", 'A "," is missing here', 1, 9),
    ("grogra", "\\var f function 2 1,\n\\axiom a,\na # F(f)", '"f" is a function, and its values are missing', 3, 7),
]
"""A notation, a text, what is said of it, the line and the column."""


@pytest.mark.parametrize(("notation", "text", "message", "line", "column"), SLIPS)
def test_a_slip_is_named_at_its_place(notation: str, text: str, message: str, line: int, column: int) -> None:
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
