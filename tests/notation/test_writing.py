"""Records to text: what is written reads back as the same system."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from lsys_kit.classroom.catalogue import cellwork_system, map_system, system
from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.model.expressions import Apply, Name, Number
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import Constant, LSystem, Production
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import dialect_named
from lsys_kit.notation.write import write

FULL = """dt = 0.7 in 0.1 .. 2 by 0.1
T = 1
alphabet: al FF
angle: 25.7
heading: 0
steps: 4
axiom: A(0)[+al]FF
A(t) : t + dt < T && !(t > 3) -> A(t + dt)
A(T) -> ε
interpretation:
A(t) -> F(t)"""


def test_a_system_prints_as_it_was_laid_out() -> None:
    assert str(read(FULL)) == FULL
    assert read(str(read(FULL))) == read(FULL)


def test_what_is_usual_is_not_written() -> None:
    assert write(read("angle: 90\nheading: 90\naxiom: A")) == "axiom: A"


def test_a_system_changes_its_notation() -> None:
    system = read("angle: 30\naxiom: I\nI -> I[A]I\nA -> ε")
    assert write(system, "plant-string") == "turtle: abop\nangle: 30\nAxiom: I\nI -> I[A]I\nA -> ε"
    assert read(write(system, "plant-string"), "plant-string") == system


@pytest.mark.parametrize(
    ("text", "lacking"),
    [
        ("axiom: A(1)", "parameters"),
        ("axiom: al", "symbols of several letters"),
        ("axiom: A\nA : 1 < 2 -> B", "conditions"),
        ("k = 1\naxiom: A", "constants"),
        ("axiom: A\ninterpretation:\nA -> F", "interpretation rules"),
        ("heading: 0\naxiom: A", "starting direction"),
        ("axiom: A_", "symbols of several letters"),
        ("axiom: A\nA -> B(1)", "parameters"),
    ],
)
def test_what_a_plant_string_lacks_is_named(text: str, lacking: str) -> None:
    with pytest.raises(ModelValueError, match=f"The notation plant-string has no {lacking}, which this system needs"):
        write(read(text), "plant-string")


def test_round_branches_are_for_plant_strings() -> None:
    with pytest.raises(ModelValueError, match="The notation abop has no round brackets as branches"):
        write(read("Axiom: I\nI -> I(A)", "plant-string"), "abop")


@pytest.mark.parametrize(
    ("text", "notation", "symbol"),
    [("Axiom: F,A", "cpfg", ","), ("* # u1' F,", "grogra", "*"), ("\\axiom L*0.5 F,", "grogra", "L*")],
)
def test_symbols_that_the_kit_s_own_notation_cannot_have_are_named(text: str, notation: str, symbol: str) -> None:
    with pytest.raises(ModelValueError) as caught:
        write(read(text, notation), "abop")
    assert caught.value.message == f'The notation abop has no symbol "{symbol}", which this system needs'


def test_a_roll_stands_apart_from_a_name_that_latex_might_know() -> None:
    system = read("axiom: A \\ vec \\ F \\(90) vec")
    assert write(system) == "axiom: A\\ vec\\F\\(90)vec"
    assert read(write(system)) == system


def test_an_unknown_notation_is_named() -> None:
    with pytest.raises(ModelNameError, match='There is no notation called "lpfg"'):
        write(read("axiom: A"), "lpfg")


def test_names_are_kept_apart_and_nothing_else() -> None:
    word = tuple(map(Pattern, ("A", "B", "[", "+", "F", "]", "al", "_b", "(")))
    assert dialect_named("abop").word(word) == "A B[+F]al _b("
    assert dialect_named("plant-string").word(word) == "AB[+F]al_b("


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        (Apply("*", (Apply("+", (Name("a"), Name("b"))), Name("c"))), "(a + b) * c"),
        (Apply("-", (Name("a"), Apply("-", (Name("b"), Name("c"))))), "a - (b - c)"),
        (Apply("-", (Apply("-", (Name("a"), Name("b"))), Name("c"))), "a - b - c"),
        (Apply("/", (Name("a"), Apply("*", (Name("b"), Name("c"))))), "a/(b * c)"),
        (Apply("^", (Apply("^", (Name("a"), Name("b"))), Name("c"))), "(a^b)^c"),
        (Apply("^", (Name("a"), Apply("^", (Name("b"), Name("c"))))), "a^b^c"),
        (Apply("^", (Number(-2), Number(2))), "(-2)^2"),
        (Apply("-x", (Apply("^", (Name("a"), Number(2))),)), "-a^2"),
        (Apply("^", (Apply("-x", (Name("a"),)), Number(2))), "(-a)^2"),
        (Apply("*", (Number(Fraction(1, 3)), Name("a"))), "1/3 * a"),
        (Apply("^", (Number(Fraction(1, 3)), Name("a"))), "(1/3)^a"),
        (
            Apply("!", (Apply("&&", (Apply("<", (Name("a"), Name("b"))), Apply("!", (Apply(">", (Name("a"), Name("b"))),)))),)),
            "!(a < b && !(a > b))",
        ),
        (Apply("max", (Name("a"), Apply("-x", (Name("b"),)), Number(1))), "max(a, -b, 1)"),
    ],
)
def test_parentheses_stand_where_they_are_needed(expression: Apply, text: str) -> None:
    assert str(expression) == text


def test_equality_ignores_where_a_system_was_read() -> None:
    one, other = read("axiom: A\nA -> B A"), read("\n\naxiom:   A\n/* x */ A -> B  A")
    assert one == other
    assert hash(one) == hash(other)
    assert one.source != other.source
    assert one != read("axiom: A\nA -> A B")


def test_records_print_as_the_notation() -> None:
    assert str(Module("M", (Fraction(1, 2), -1))) == "M(0.5,-1)"
    assert str(Production((Pattern("A"),), ())) == "A -> ε"
    assert str(Constant("k", Number(3))) == "k = 3"
    assert str(LSystem((Pattern("A"),), ())) == "axiom: A"


def test_a_long_system_is_shown_by_its_beginning_and_one_that_cannot_be_written_by_its_rules() -> None:
    long = read("axiom: A\n" + "A -> A B C D E F G\n" * 900)
    assert len(repr(long)) < 2_100
    assert repr(long).endswith("characters)")
    odd = replace(read("axiom: A(1)\nA(t) -> A(t+1)"), notation="plant-string")
    assert repr(odd) == "axiom: A(1)\nA(t) -> A(t + 1)"
    assert repr(LSystem((Pattern("A"),), (), notation="no such")) == "axiom: A"


@pytest.mark.parametrize("found", [system("J4"), map_system("K28"), cellwork_system("K33")], ids=["J4", "K28", "K33"])
def test_a_system_is_shown_as_its_text(found: object) -> None:
    assert repr(found) == str(found)
