"""Systems as articles print them are those of the kit's own spelling, and the kit's own rules are never taken for print."""

from __future__ import annotations

import re
from collections.abc import Sequence

import pytest

from lsys_kit.classroom.catalogue import system, systems
from lsys_kit.derivation.timed.timed import timed
from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import symbols
from lsys_kit.notation.read import read, read_word
from lsys_kit.notation.syntax.text.printed import printed_statements
from lsys_kit.notation.write import write
from tests.notation.test_diagnostics import A_VALUE, NO_NAMES, PRODUCTION

RULES = [
    ("F ::= F+F--F+F", "F -> F+F--F+F"),
    ("F \\rightarrow F F", "F -> F F"),
    ("F \\longrightarrow F F", "F -> F F"),
    ("F ⟶ F F", "F -> F F"),
    ("F \\xrightarrow{0.33} F[+F]F", "F -> F[+F]F : 0.33"),
    ("F(x) : x > 1 \\xrightarrow{x/2} F(x)", "F(x) : x > 1 -> F(x) : x/2"),
    ("p1: F -> F F", "F -> F F"),
    ("p_1: F -> F F", "F -> F F"),
    ("P_1 : F -> F F", "F -> F F"),
    ("p_{12}: F -> F F", "F -> F F"),
    ("p1: F(x) : x > 1 -> F(x)", "F(x) : x > 1 -> F(x)"),
    ("p_2: G < F > H -> F", "G < F > H -> F"),
    ("p2: F > -> G", "F -> G"),
    ("p1: (a_r, 1) -> (a_l, 0)", "a_r(1) -> a_l(0)"),
    ("L⃗ → L⃖ S⃗", "L_r -> L_l S_r"),
    ("L⃗ → SL⃗S⃖(1)", "L_r -> S L_r S_l(1)"),
    ("\\vec{L} → \\overleftarrow{L}\\overrightarrow{S}", "L_r -> L_l S_r"),
    ("\\vec L → \\vec{ L }", "L_r -> L_r"),
    ("\\vec{M}(s) : s < 5 → M⃖(s+1)", "M_r(s) : s < 5 -> M_l(s+1)"),
    ("a_{r} → a_{l}b_{r}", "a_r -> a_l b_r"),
    ("F(x) : x \\geq 1 && x \\neq 2 || x \\leq 0 → G", "F(x) : x >= 1 && x != 2 || x <= 0 -> G"),
    ("F(x) : x \\ge 1 && x \\ne 2 || x \\le 0 → G", "F(x) : x >= 1 && x != 2 || x <= 0 -> G"),
    ("s < a > \\rightarrow a s,", "s < a -> a s"),
    ("s \\rightarrow ,", "s -> ε"),
    ("s \\rightarrow , /* the empty word */", "s -> ε"),
    ("s \\rightarrow \\varepsilon", "s -> ε"),
    ("{F -> G, G -> F F}", "F -> G\nG -> F F"),
    ("P = {F ::= F+F}", "F -> F+F"),
    ("P = {\n  F ::= F,\n  G ::= \\vec{F}(1, 2)\n}", "F -> F\nG -> F_r(1,2)"),
    ("P = {F -> {F},\nG -> F(1, 2),}", "F -> {F}\nG -> F(1,2)"),
    ("{p1: F -> G, p2: G -> F}", "F -> G\nG -> F"),
    ("(a_r, 1) → (a_l, 0)(b_r, 0)", "a_r(1) -> a_l(0) b_r(0)"),
    ("(a, 1) → [(a, 0)] (b, 1/2, 2)", "a(1) -> [a(0)] b(1/2, 2)"),
]
"""Productions in mathematical form, and in the kit's own spelling."""
MODELS = [
    ("ω: F", "axiom: F"),
    ("ω = F", "axiom: F"),
    ("\\omega: F", "axiom: F"),
    ("\\omega = \\vec{F}", "axiom: F_r"),
    ("ω : (a_r, 0)", "axiom: a_r(0)"),
    ("ω: F\nδ = 60°", "axiom: F\nangle: 60"),
    ("ω: F\nδ = 360/7", "axiom: F\nangle: 360/7"),
    ("ω: F\n\\delta = 30^\\circ", "axiom: F\nangle: 30"),
    ("ω: F\n\\delta: 30^{\\circ}", "axiom: F\nangle: 30"),
    ("ω: F\nδ = 60°\nd = 1", "axiom: F\nangle: 60\nlength: 1"),
    ("V = {F, +, -}\nω: F", "axiom: F"),
    ("V = {ab, a, b, \\vec{A}}\nω: ab", "alphabet: ab A_r\naxiom: ab"),
    ("{a -> b}\naxiom a", "axiom: a\na -> b"),
    ("Axiom a b\nP = {a -> b}", "axiom: a b\na -> b"),
]
OWN = [
    "axiom: A(1)\nA(t) : t < 5 -> A(t+1)",
    "axiom: p1 x\np1 : 2 > 1 -> x",
    "axiom: p1(1)\np1(x) : x > 2 -> p1(x)",
    "k = 1\naxiom: p1\np1 : k > 0 -> A",
    "k = 1\nn = 2\naxiom: p1\np1 : k < n -> A",
    "k = 1\naxiom: p1\np1 : k == 1 -> A",
    "k = 1\naxiom: p1\np1 : (k > 0) -> A",
    "k = 1\naxiom: p1\np1 : k+1 > 0 && k < 3 -> A",
    "axiom: p_1 B\nB < p_1 -> A\np_1 > B -> A",
    "axiom: p1(1) B\nB < p1(t) : t > 1 -> p1(t)",
    "V = 3\nP = 2\nd = 1\naxiom: F(V)\nF(x) -> F(x+P)",
    "axiom: F\nF -> {F}[-F]\\(90)F",
    "delta = 3\nomega = 4\naxiom: F(delta)",
    "axiom: F(1)\nF(x) -> F(x+1)F (x)",
]
"""Models of the kit's own spelling in which something looks like print."""
UNREADABLE = [
    ("ω: A\np_1: A B", "An arrow is missing here", 2, 8, PRODUCTION),
    ("ω: A\np_1: A →", "There is nothing after the arrow", 2, 8, 'To erase A, write "ε" or "*" there.'),
    ("ω: A\np_1: → B", "There is no condition before the arrow", 2, 6, 'Write one, as in "t < 5", or leave the ":" out.'),
    ("ω: A\np_1: A → B → C", "This is a second arrow in one production", 2, 12, "Write one production per line."),
    (
        "ω: A\np_1: A(t) t \\geq 5 → C",
        'A ":" is missing before the condition',
        2,
        11,
        'A condition is written between ":" and the arrow, as in "A(t) : t < 5 -> B".',
    ),
    ("ω: A\nA \\rightarrow", "There is nothing after the arrow", 2, 3, 'To erase A, write "ε" or "*" there.'),
    ("ω: A\nA(1 \\longrightarrow B", 'This "(" is never closed', 2, 2, 'Every "(" needs a ")" after it.'),
    (
        "ω: A\nA \\rightarrow B \\rightarrow C",
        "This is a second arrow in one production",
        2,
        17,
        "Write one production per line.",
    ),
    ("ω: A\nA \\xrightarrow{} B", "A value is missing here", 2, 16, A_VALUE),
    ("ω: A\nA \\xrightarrow{0.5 B", 'This "{" is never closed', 2, 15, CLOSING := 'Every "{" needs a "}" after it.'),
    ("ω: A\n\\vec{A → B", 'This "{" is never closed', 2, 5, CLOSING),
    ("ω: A\nP = {A → B, B → A", 'This "{" is never closed', 2, 5, CLOSING),
    ("V = {A, B\nω: A", 'This "{" is never closed', 1, 5, CLOSING),
    (
        "V = {A B}\nω: A",
        'A "," is missing here',
        1,
        8,
        'The letters of an alphabet are separated by commas, as in "V = {A, B}".',
    ),
    ("V = {F, +, \u2014}\nω: F", "This dash is not a minus sign", 1, 12, 'A minus sign is typed "-".'),
    ("ω: F\nF ::= F \u2014F", "This dash is not a minus sign", 2, 9, 'A minus sign is typed "-".'),
    ("{ar.. al br, br -> ar}\naxiom ar", "This is not an arrow", 1, 4, 'An arrow is typed "->", in one piece.'),
    ("{A -> B, B -> }\naxiom A", "There is nothing after the arrow", 1, 12, 'To erase B, write "ε" or "*" there.'),
    ("axiom A B\nA -> B", 'A ":" is missing after "axiom"', 1, 1, 'Type "axiom: A B".'),
    ("ω = A, B", 'A "," is not needed here', 1, 6, "Modules and names are separated by blanks."),
    ("ω: A\nA → B, C", 'A "," is not needed here', 2, 6, "Modules and names are separated by blanks."),
    ("δ = \nω: A", "A value is missing here", 1, 4, A_VALUE),
    ("angle: 30\nω: A\nδ = 60°", '"angle:" is set a second time', 3, 1, "Keep one of the two lines."),
    ("ω: A\nA → +(60°)", "This sign is not needed", 2, 9, "Angles are in degrees."),
    ("ω: A\nω = B", "This is a second axiom", 2, 1, "A system has one axiom."),
    (
        "axiom: A\nA -> [B ε]",
        'Nothing else is possible beside "ε" (GREEK SMALL LETTER EPSILON)',
        2,
        9,
        "It says that the successor is empty.",
    ),
    (
        "axiom: A\nA > B ε -> C",
        'This "ε" does not end a branch',
        2,
        7,
        'It is written before the "]" of a branch in a right context, as in "A > [B ε]C -> D".',
    ),
    (
        "axiom: A\nε -> B",
        'Only modules are replaced, and "ε" is none',
        2,
        1,
        'A production reads "A -> B": what is replaced, an arrow, what replaces it.',
    ),
    (
        "axiom: A\nturtle: logo",
        'I do not know the turtle "logo"',
        2,
        9,
        TURTLES := 'Turtles are "abop", "grogra", "plant-string" and "fractint".',
    ),
    ("axiom: A\nturtle:", 'There is nothing after "turtle:"', 2, 1, TURTLES),
    (
        "axiom: A\ncells: round",
        'I do not know the look "round"',
        2,
        8,
        LOOKS := 'Cells are drawn as "rectangles" or "ellipses".',
    ),
    ("axiom: A\ncells:", 'There is nothing after "cells:"', 2, 1, LOOKS),
    ("axiom: A\ncells ellipses", 'A ":" is missing after "cells"', 2, 1, 'Type "cells: ellipses".'),
    ("axiom: A\nturtle grogra", 'A ":" is missing after "turtle"', 2, 1, 'Type "turtle: grogra".'),
    ("axiom: A\ndecomposition depth 2", 'A ":" is missing after "decomposition depth"', 2, 1, 'Type "decomposition depth: 2".'),
    ("axiom: A\nlenght: 3", 'I do not know "lenght:"', 2, 1, 'Did you mean "length:"?'),
    ("axiom: A\nseed 3", 'A ":" is missing after "seed"', 2, 1, 'Type "seed: 3".'),
]
"""A model, what is said of it, the line and the column, and the hint."""
MEANINGLESS = [
    (ModelNameError, "δ = x\nω: A", 'I do not know the name "x"', 1, 5, NO_NAMES),
    (ModelNameError, "ω: A\nA \\xrightarrow{p} B", 'I do not know the name "p"', 2, 16, NO_NAMES),
    (ModelNameError, "axiom: A\nlength: x", 'I do not know the name "x"', 2, 9, NO_NAMES),
    (ModelValueError, "axiom: A\nlength: 1 < 2", '"1 < 2" is true or false, but a number is needed here', 2, 9, None),
    (ModelValueError, "axiom: A\nseed: 1.5", '"1.5" is not a seed', 2, 7, "A seed is a whole number."),
    (
        ModelValueError,
        "axiom: A\ndecomposition depth: -1",
        '"-1" is not a number of rounds',
        2,
        22,
        "Rounds are counted from 0: 0, 1, 2, ...",
    ),
]
"""The same of names that stand for nothing and of senseless values."""


def slip(text: str) -> LSystemError:
    """The error in which a model ends while it is read."""
    with pytest.raises(LSystemError) as caught:
        read(text, "abop")
    return caught.value


@pytest.mark.parametrize(("form", "own"), RULES)
def test_a_printed_production_is_one_of_the_kits_own(form: str, own: str) -> None:
    found = read(f"axiom: F\n{form}", "abop").productions
    assert found
    assert found == read(f"axiom: F\n{own}", "abop").productions


@pytest.mark.parametrize(("form", "own"), MODELS)
def test_a_printed_model_is_one_of_the_kits_own(form: str, own: str) -> None:
    assert read(form) == read(own, "abop")


@pytest.mark.parametrize("arrow", ["→", "⟶", "-->", "::=", "\\rightarrow", "\\longrightarrow"])
@pytest.mark.parametrize("id", [id for id in systems() if system(id).notation == "abop"])
def test_every_system_may_be_printed_with_labels_and_commas(id: str, arrow: str) -> None:
    form = re.sub(
        r"^(?!meta)(.*) -> (.*)$",
        lambda rule: f"p_{{1}} : {rule[1]} {arrow} {rule[2]} ,",
        write(system(id), "abop"),
        flags=re.MULTILINE,
    )
    assert read(form, "abop") == system(id)


@pytest.mark.parametrize("text", OWN)
def test_the_kits_own_rules_stay_what_they_are(text: str) -> None:
    own = read(text, "abop")
    lines = [line for line in text.split("\n") if "->" in line]
    assert [text[start:end] for start, end in printed_statements(text) if "->" in text[start:end]] == lines
    assert len(own.productions) == len(lines)
    assert own.length is None
    assert read(str(own), "abop") == own


@pytest.mark.parametrize(
    ("rule", "label"),
    [
        ("p1 : x > 2 -> B", False),
        ("p1 : x < 2 -> B", False),
        ("p1 : 2 > x -> B", False),
        ("p1 : x != y -> B", False),
        ("p1 : * -> B", False),
        ("p1 : (x > y) -> B", False),
        ("p1 : max(x < y, 1) -> B", False),
        ("p1 : -> B", False),
        ("p1 : A", False),
        ("p1(x) : x -> B", False),
        ("p : A -> B", False),
        ("q1 : A -> B", False),
        ("p1A : A -> B", False),
        ("p1 : not x > 2 -> B", False),
        ("p1 : x and y > 2 -> B", False),
        ("p1 : x -> B", True),
        ("p1 : x(1) -> B", True),
        ("p1 : x > y -> B", True),
        ("p1 : x < y > z -> B", True),
        ("p1 : x y > 2 -> B", True),
        ("p1 : x(y) y > 2 -> B", True),
        ("p1 : x : x > 2 -> B", True),
        ("p1:s<a>->B", True),
        ("p1 : (x, 1) -> B", True),
        ("p1 : + -> B", True),
    ],
)
def test_a_label_is_told_from_a_predecessor(rule: str, label: bool) -> None:
    ((start, _),) = printed_statements(rule)
    assert (start > 0) is label


def test_a_name_that_words_have_is_a_predecessor_where_it_may_be_one() -> None:
    assert [rule.condition is None for rule in read("axiom: A\np1 : A > B -> B", "abop").productions] == [True]
    assert slip("axiom: p1\np1 : A > B -> B").message == 'I do not know the name "A"'


def test_a_timed_system_lives_in_continuous_time() -> None:
    cells = read(
        "ω : (a_r, 0)\np_1 : (a_r, 1) → (a_l, 0)(b_r, 0)\np_2 : (a_l, 1) → (b_l, 0)(a_r, 0)\n"
        "p_3 : (b_r, 1) → (a_r, 0)\np_4 : (b_l, 1) → (a_l, 0)"
    )
    assert str(timed(cells).word("5/2")) == "b_l(0.5)a_r(0.5)a_r(0.5)"


def test_the_letter_d_is_the_length_beside_the_angle_alone() -> None:
    assert read("ω → F\nF → F+F") == read("ω: F\nF → F+F")
    assert read("ω -> F\nF -> F+F\nδ = 60°").notes == ()
    assert read("ω: F\nδ = 60°\nd = 2").notes == ('"d" is read as the length of a segment.',)
    assert read("ω: F\nd = 2").constants[0].name == "d"
    assert read("angle: 60\naxiom: F\nd = 2").constants[0].name == "d"
    used = read("ω: F(d)\nδ = 60°\nd = 2")
    assert (used.length, used.constants[0].value, used.notes) == (None, Number(2), ())


def test_a_right_context_may_say_that_a_branch_ends() -> None:
    model = read("axiom: A[B]C\nA > [B ε]C -> A\nA > [[B ε]B ε]C -> A")
    assert [module.symbol for module in model.productions[0].right] == ["[", "B", "ε", "]", "C"]
    assert str(model.productions[1]) == "A > [[B ε]B ε]C -> A"
    assert read(str(model)) == model


@pytest.mark.parametrize(
    ("text", "modules"),
    [
        ("@oF@cF", "@o F @c F"),
        ("@O(2)@v@M(1,2)@D", "@O(2) @v @M(1,2) @D"),
        ("F@Ts@Tx(1)", "F @Ts @Tx(1)"),
        ("?P(1,2)?H?U?LA?E(0)", "?P(1,2) ?H ?U ?L A ?E(0)"),
        ("@(0.5)F", "@(0.5) F"),
        ("~L(0)~K", "~ L(0) ~ K"),
        ("@T S", "@T S"),
        ("@ F", "@ F"),
    ],
)
def test_commands_of_two_characters_are_symbols(text: str, modules: str) -> None:
    word = read_word(text)
    assert " ".join(map(str, word)) == modules
    assert read(f"axiom: {text}").axiom == read(str(read(f"axiom: {text}"))).axiom
    assert symbols(read(f"axiom: X\nX -> {text}"))[1:] == tuple(dict.fromkeys(module.symbol for module in word))


def test_settings_read_back() -> None:
    text = "turtle: grogra\nlength: 2.5\nseed: 3\ndecomposition depth: 2\naxiom: A"
    model = read(text)
    assert (model.turtle, model.length, model.seed, model.decomposition_depth) == ("grogra", 2.5, 3, 2)
    assert str(model) == text


@pytest.mark.parametrize("row", UNREADABLE)
def test_a_slip_is_explained(row: Sequence[object]) -> None:
    text, *expected = row
    error = slip(str(text))
    assert [error.message, error.line, error.column, error.hint] == expected
    assert type(error) is ModelSyntaxError


@pytest.mark.parametrize("row", MEANINGLESS)
def test_what_makes_no_sense_is_explained(row: Sequence[object]) -> None:
    kind, text, *expected = row
    error = slip(str(text))
    assert [error.message, error.line, error.column, error.hint] == expected
    assert type(error) is kind


@pytest.mark.slow
@pytest.mark.parametrize(
    ("rule", "column"),
    [
        ("A(t) t < T -> B", 6),
        ("A(t) t > T -> B", 6),
        ("A(t) T < t -> B", 6),
        ("A(t) T > t -> B", 6),
        ("A(x,t)t < x -> B", 7),
        ("A(t) t < T && t > 1 -> B", 6),
        ("A(t) if t < T -> B", 6),
        ("X A(t) t < T -> B", 8),
    ],
)
def test_a_condition_without_its_colon_is_no_context(rule: str, column: int) -> None:
    error = slip(f"T = 5\naxiom: A(1)\n{rule}")
    assert (error.message, error.line, error.column) == ('A ":" is missing before the condition', 3, column)
    assert re.search(r'":" and the arrow', error.hint or "")


def test_a_context_whose_symbol_is_also_a_parameter_stays_a_context() -> None:
    model = read("axiom: A(1) t B\nA(t) t < B -> t")
    assert model.productions[0].left[1] == Pattern("t")
