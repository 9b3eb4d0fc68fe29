"""Text to records: what stands in a model, and what it is read as."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest

from lsys_kit.budget import limits
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.analysis.checks import check_word
from lsys_kit.notation.model.expressions import Name, Number
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import Constant, LSystem, Production, symbols
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS
from lsys_kit.notation.read import read, read_expression, read_number, read_word
from lsys_kit.notation.syntax.text.statements import statements, without_comments
from lsys_kit.notation.write import write

A, B = Pattern("A"), Pattern("B")


def test_a_model_is_read_line_by_line() -> None:
    system = read("""
        /* an example */
        lifeTime = 3 in 1 .. 6
        angle: 25.7
        heading: 0
        steps: 4
        axiom: A(1)[B]      /* the first word */
        A(t) : t < lifeTime -> A(t+1)
        A(t) -> ε
        interpretation:
        B -> F(2)
    """)
    assert system.axiom == (Pattern("A", (Number(1),)), Pattern("["), B, Pattern("]"))
    assert system.constants == (Constant("lifeTime", Number(3), (Number(1), Number(6), Number(1))),)
    assert (system.angle, system.heading, system.steps) == (Fraction(257, 10), 0, 4)
    assert [str(rule) for rule in system.productions] == ["A(t) : t < lifeTime -> A(t + 1)", "A(t) -> ε"]
    assert [str(rule) for rule in system.interpretation] == ["B -> F(2)"]
    assert symbols(system) == ("A", "[", "B", "]")


@pytest.mark.parametrize(
    "text",
    [
        "axiom: A\nA -> B A",
        "AXIOM : A\nA-->B A",
        "ω: A\nA → B A",
        "omega: A\nA ⟶ B A",
        "axiom: A\n\n\nA -> B A\n",
        "axiom: A\r\nA -> B A\r\n",
        "  axiom: A\n  A -> B A",
        "\taxiom: A\n\tA -> B A",
        "axiom: A\nA\n-> B A",
        "axiom: A\nA ->\n  B A",
        "axiom: A\nA -> B\n  A",
        "axiom:\n  A\nA -> B A",
        "axiom: A /* one */\nA /* two\n lines */ -> B A",
        "A -> B A\naxiom: A",
        "productions:\nA -> B A\naxiom: A",
        "axiom: A\nA : * -> B A",
        "\ufeffaxiom: A\nA -> B\u00a0A",
        "axiom: A\ninterpretation:\nproductions:\nA -> B A",
    ],
)
def test_a_production_may_be_laid_out_in_many_ways(text: str) -> None:
    assert read(text) == LSystem((A,), (Production((A,), (B, A)),))


def test_a_condition_may_go_on_over_lines() -> None:
    system = read("axiom: A(1)\nA(t) :\n  t < 5 &&\n  t > 2\n  -> A(t+1)\nA(t) : t == 5 ||\n  t == 6 -> B")
    assert [str(rule) for rule in system.productions] == ["A(t) : t < 5 && t > 2 -> A(t + 1)", "A(t) : t == 5 || t == 6 -> B"]


def test_indented_statements_begin_for_themselves() -> None:
    system = read("axiom: A\n  A -> B\n    k = 2\n  B : k < 3 -> A\n  angle: 60")
    assert len(system.productions) == 2
    assert (system.constants[0].name, system.angle) == ("k", 60)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("", []),
        ("\n \n", []),
        ("a\nb", ["a", "b"]),
        ("a\n  b", ["a\n  b"]),
        (" a\n b", ["a", "b"]),
        ("a ->\n b\nc", ["a ->\n b", "c"]),
        ("a /* x\n y */ b", ["a /* x\n y */ b"]),
        ("/* x */\na", ["a"]),
        ("a -> b /* x */\nc -> d", ["a -> b", "c -> d"]),
    ],
)
def test_statements_are_lines_and_what_goes_on_with_them(text: str, parts: list[str]) -> None:
    assert [text[start:end] for start, end in statements(text)] == parts


def test_a_comment_leaves_everything_in_its_place() -> None:
    text = "A /* a\nb */ -> B /**/ C /***/ D"
    blanked = without_comments(text)
    assert len(blanked) == len(text)
    assert blanked.split() == ["A", "->", "B", "C", "D"]
    assert blanked.index("\n") == text.index("\n")


def test_other_signs_for_operators_are_read_as_the_usual_ones() -> None:
    assert read_expression("¬(a ≤ b) ∧ a ≠ −b ∨ a ≥ 2·b×c") == read_expression("!(a <= b) && a != -b || a >= 2*b*c")
    assert read("axiom: F−F").axiom == read("axiom: F-F").axiom
    assert read("δ: 60\naxiom: A").angle == 60


def test_a_predecessor_may_ask_for_values() -> None:
    system = read("k = 2\naxiom: A(2, 1)\nA(k, t) -> B\nA(3, k + 1) -> B\nA(-1, 1/2) -> B")
    assert [str(rule.predecessor) for rule in system.productions] == ["A(k,t)", "A(3,k + 1)", "A(-1,1 / 2)".replace(" / ", "/")]
    assert system.productions[0].predecessor.arguments == (Name("k"), Name("t"))


def test_an_angle_may_be_calculated() -> None:
    assert read("angle: 360/7\naxiom: A").angle == Fraction(360, 7)
    assert read("angle: sqrt(4)\naxiom: A").angle == 2.0


def test_a_range_may_be_calculated_from_constants_before_it() -> None:
    system = read("n = 3\nk = n in 1/2 .. 2*n by n/6\naxiom: A(k)")
    assert str(system.constants[1]) == "k = n in 1/2 .. 2 * n by n/6"


@pytest.mark.parametrize(
    ("text", "axiom"),
    [
        ("FFF", "F F F"),
        ("FX", "F X"),
        ("al br", "al br"),
        ("F(1)FF(2)", "F(1)F F(2)"),
        ("XFX", "X F X"),
        ("Ff", "F f"),
        ("X1", "X1"),
    ],
)
def test_letters_written_together_are_parted_where_there_is_one_way(text: str, axiom: str) -> None:
    extra = "\nX -> F" if "X" in text and text == "FX" else ""
    assert write(read(f"axiom: {text}{extra}")).split("\n")[0] == f"axiom: {axiom}"


@pytest.mark.parametrize(
    ("rules", "said"),
    [
        ("A -> aAA", "aAA=a A A"),
        ("F -> F[-F]cF[+F][F]", "cF=c F"),
        ("a -> cRb", "cRb"),
        ("X -> XtF", "XtF=X t F"),
        ("A -> FX", "FX=F X"),
        ("A -> AB", "AB=A B"),
        ("A -> Bud A", ""),
        ("A -> Bud A\nB -> A", "Bud"),
        ("a -> leaf a", "leaf"),
        ("A -> Flower(2) A", "Flower"),
        ("A -> Apex(2)", "Apex"),
        ("a -> abc", "abc"),
        ("A -> Bb", ""),
        ("A -> bBb", "bBb"),
        ("A -> [+AxA]A", "AxA=A x A"),
        ("a -> FaF\nF -> FF", "FaF=F a F FF=F F"),
        ("X -> F+X\nF -> FXf", "FXf=F X f"),
        ("Al(t) -> Al(t+1) Br(0)", ""),
        ("ar -> al br\nal -> aRal", ""),
        ("S -> aSb", "aSb=a S b"),
        ("A -> newA", "newA=n e w A"),
        ("alphabet: aAA\nA -> aAA", ""),
        ("A -> a A A", ""),
        ("A -> f(A)", ""),
    ],
)
def test_letters_that_run_together_are_parted_or_it_is_said(rules: str, said: str) -> None:
    first = rules.split("\n")[-1].partition(" ->")[0].partition("(")
    notes = read(f"axiom: {first[0]}{'(0)' * bool(first[1])}\n{rules}").notes
    found = [
        f"{name}={' '.join(parts)}"
        for note in notes
        if (match := re.match(r'"(\w+)" is read as (.*)\.', note))
        for name, parts in [(match[1], match[2].split())]
        if "one symbol" not in note
    ]
    whole = [note.split('"')[1] for note in notes if "is read as one symbol" in note]
    assert " ".join([*found, *whole]) == said


def test_a_name_that_is_rewritten_stays_whole() -> None:
    system = read("axiom: ab\nab -> a b ab\na -> aab")
    assert [str(rule) for rule in system.productions] == ["ab -> a b ab", "a -> aab"]
    assert system.notes == ('"aab" is read as one symbol; for several put blanks between them: a ab.',)


def test_a_name_in_the_alphabet_stays_whole() -> None:
    assert write(read("alphabet: FF\naxiom: F\nF -> FF")) == "alphabet: FF\naxiom: F\nF -> FF"


def test_parted_names_are_told_once() -> None:
    assert read("axiom: a\na -> abb\nb -> abb ba").notes == ('"abb" is read as a b b.', '"ba" is read as b a.')


def test_a_name_with_parameters_gives_them_to_its_last_letter() -> None:
    assert write(read("axiom: FA(1)\nA(t) -> FFA(t)")) == "axiom: F A(1)\nA(t) -> F F A(t)"


def test_words_and_numbers_can_be_read_alone() -> None:
    assert read_word("") == read_word("ε") == read_word(" * ") == ()
    assert read_word("A(1/2, 2*3)[B]") == (Module("A", (Fraction(1, 2), 6)), Module("["), Module("B"), Module("]"))
    assert read_word("I(A)", "plant-string") == tuple(map(Module, "I(A)"))
    assert read_word("BAB", system=read("axiom: A\nA -> B A")) == tuple(map(Module, "BAB"))
    assert read_word("BAB") == (Module("BAB"),)
    assert read_number("1.5e2") == 150


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("A(t)", ModelNameError),
        ("A(1/0)", ModelValueError),
        ("A(1", ModelSyntaxError),
        ("A(1 < 2)", ModelValueError),
        ("[A", ModelSyntaxError),
        ("A -> B", ModelSyntaxError),
    ],
)
def test_a_word_has_numbers_and_closed_brackets(text: str, kind: type[Exception]) -> None:
    with pytest.raises(kind):
        read_word(text)


def test_values_are_what_a_word_may_have() -> None:
    check_word((Pattern("A", (Number(Fraction(1, 2)), Number(3.5))), Pattern("["), Pattern("]")), (), "")


def test_a_long_expression_is_refused() -> None:
    with pytest.raises(ModelSyntaxError, match=r"This expression has more than 2,000 characters"):
        read_expression("1 +" + " " * 2_000 + "1")
    with limits(line=10), pytest.raises(ModelLimitError, match="This line has 11 characters; the limit is 10"):
        read_expression("1 + 1 + 1+1")


def test_limits_of_a_model_can_be_set() -> None:
    with limits(rules=1):
        assert read("axiom: A\nA -> B")
        with pytest.raises(ModelLimitError, match="The model has more than 2 lines that are not blank"):
            read("axiom: A\nA -> B\nB -> A")
    with limits(brackets=2), pytest.raises(ModelSyntaxError, match="More than 2 brackets are open at once"):
        read("axiom: [[[A]]]")
    with limits(name=3), pytest.raises(ModelSyntaxError, match="This name has more than 3 letters"):
        read("life = 3\naxiom: A")


def test_plant_strings_have_two_kinds_of_branches() -> None:
    system = read("Axiom = I\nangle: 30\nsteps: 3\nI -> I[A]A(I)A\nA -> *", "plant-string")
    assert "".join(m.symbol for m in system.productions[0].successor) == "I[A]A(I)A"
    assert system.productions[1].successor == ()
    assert (system.angle, system.steps, system.notation) == (30, 3, "plant-string")
    assert str(system) == "angle: 30\nsteps: 3\nAxiom: I\nI -> I[A]A(I)A\nA -> ε"


@pytest.mark.parametrize(
    ("rules", "successor"),
    [("A -> BA", "B A"), ("A -> FAXF", "F A X F"), ("A -> BUD", "BUD"), ("A -> Bud", "Bud"), ("A -> BA\nBA -> A", "BA")],
)
def test_capital_letters_in_a_row_are_symbols_if_one_of_them_is_rewritten(rules: str, successor: str) -> None:
    system = read(f"axiom: A\n{rules}")
    assert " ".join(module.symbol for module in system.productions[0].successor) == successor
    assert read(write(system)) == system


TURTLES = {
    "abop": (1.0, 1, 2.4, True, False),
    "grogra": (100.0, -1, 0.1, False, False),
    "plant-string": (1.0, 1, 0.1, False, False),
    "fractint": (1.0, 1, 0.1, False, True),
}
"""For each dialect of turtle commands the length of a step, the side of the turtle's left, the width of its strokes, whether
that is in pixels, and whether any sign is a symbol."""


def test_each_turtle_begins_as_its_program_lets_it() -> None:
    found = {name: (one.length, one.left, one.width, one.pixels, one.any_sign) for name, one in TURTLE_DIALECTS.items()}
    assert found == TURTLES
