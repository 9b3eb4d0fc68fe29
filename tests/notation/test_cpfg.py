"""cpfg's notation: what its texts say, and that a system written in it reads back as the same."""

from __future__ import annotations

import math
from contextlib import suppress
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.classroom.catalogue import system as catalogued
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.dialects.cpfg.dialect import CPFG
from lsys_kit.notation.model.arithmetic import Value, normalised, remainder
from lsys_kit.notation.model.expressions import Apply, Number, function_of, to_sympy
from lsys_kit.notation.model.modules import flat
from lsys_kit.notation.model.system import Production
from lsys_kit.notation.read import read, read_word
from lsys_kit.notation.write import write
from tests.timing import spent

LISTINGS = Path(__file__).parents[1] / "listings"


def rule(text: str) -> Production:
    """The first rule of a system with a constant."""
    return read(f"#define k 3\nAxiom: A\n{text}", "cpfg").rules[0]


def abop(text: str) -> Production:
    return read(f"k = 3\naxiom: A\n{text}").productions[0]


@pytest.mark.parametrize("id", ["P4", "P5", "P6", "P7", "P8"])
def test_a_listing_and_the_catalogue_have_the_same_words(id: str) -> None:
    listing = (LISTINGS / f"002-L{id[1:]}.cpfg.txt").read_text(encoding="utf-8")
    assert read(listing) == read(listing, "cpfg")
    assert list(map(str, derive(read(listing), 5))) == list(map(str, derive(catalogued(id), 5)))


# What a text says

FULL = """#define dt 0.7 /* 0.1 .. 2 by 0.1 */
#define k (dt * 2)
Lsystem: 1
seed: 3
derivation length: 9
ignore: +-?P
/* angle: 25.7 */
/* heading: 0 */
/* length: 5 */
Axiom: A(0)F//F[+F]@o;(2)
/ / < A(t) > [B=]F : t < 5 --> A(t + dt)
A > [B]F[C[D=]] --> *
B --> [+B]B : 40
B --> B : 0.6
decomposition
maximum depth: 2
M(t) --> I(t)I(t)
homomorphism
maximum depth: 3
I(x) --> ;F(x)
endlsystem"""


def test_a_text_is_written_as_it_was_laid_out() -> None:
    system = read(FULL)
    assert (system.notation, system.seed, system.steps, system.angle, system.heading, system.length) == (
        "cpfg",
        3,
        9,
        Fraction(257, 10),
        0,
        5,
    )
    assert (system.decomposition_depth, system.depth, system.ignored) == (2, 3, ("+", "-", "?P"))
    assert str(system) == FULL
    assert read(str(system)) == system


@pytest.mark.parametrize(
    ("word", "symbols"),
    [
        ("/////", "/ / / / /"),
        ("0F1", "0 F 1"),
        ("F(1)F", "F F"),
        ("@o@Ts@M(1,2,3)?P(0,0,0)", "@o @Ts @M ?P"),
        (",;'#!", ", ; ' # !"),
        ("~H(1)|$%{.}\\^&", "~ H | $ % { . } \\ ^ &"),
        ("@T s", "@T s"),
        ("F [ +F ]\n  F", "F [ + F ] F"),
    ],
)
def test_every_character_is_a_symbol_but_for_those_of_two(word: str, symbols: str) -> None:
    system = read(f"Lsystem: 1\nAxiom: {word}")
    assert [module.symbol for module in system.axiom] == symbols.split()
    assert read_word(CPFG.word(system.axiom), "cpfg") == read_word(word, "cpfg")


def test_a_comment_stands_anywhere_and_rolls_stay_rolls() -> None:
    text = """// a comment
        Lsystem: 1
        #define n 3   // how many
        derivation length: n // as many
        /* before
           the axiom */ Axiom: F /* in a word */ F//F
            // below, not in the word
        F : 1 // always
            --> F//F
             //(90)F
        endlsystem // the end"""
    system = read(text)
    assert (system.steps, len(system.axiom), len(system.productions), len(system.productions[0].successor)) == (3, 5, 1, 7)


def test_indented_lines_go_on_unless_they_have_an_arrow_of_their_own() -> None:
    text = "Lsystem: 1\n  Axiom: A\n\tB\n  A -->\n    B\n  B : 1\n  --> C\n  decomposition\n  C --> D\n    E\nendlsystem"
    assert str(read(text)) == "Lsystem: 1\nAxiom: AB\nA --> B\nB --> C\ndecomposition\nC --> DE\nendlsystem"


@pytest.mark.parametrize(
    ("line", "rolls"),
    [
        ("F --> FF // doubles", 0),
        ("F --> FF //doubles", 0),
        ("F --> FF // It doubles", 0),
        ("F --> FF // FF", 2),
        ("F --> F//F", 2),
        ("F --> F //F", 2),
        ("F --> F// ab", 2),
        ("F --> F //ab(1)", 2),
        ("F --> F // + F", 2),
        ("F : 1 // always\n  --> F", 0),
        ("// F doubles\nF --> F", 0),
        ("F --> F /* // */", 0),
    ],
)
def test_two_rolls_begin_a_comment_behind_a_blank_and_before_a_word(line: str, rolls: int) -> None:
    system = read(f"Lsystem: 1\nAxiom: F\n{line}", "cpfg")
    assert [module.symbol for module in flat(system.productions[0].successor)].count("/") == rolls
    assert any("is read as a comment" in note for note in system.notes) == ("doubles" in line and line[0] == "F")


def test_prose_that_may_be_symbols_is_pointed_out() -> None:
    assert read("Lsystem: 1\n/* angle: 90 */\nAxiom: F\nF --> FF // FF", "cpfg").notes == (
        '"// FF" is read as symbols, two rolls first; a comment is written between "/*" and "*/".',
    )


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (
            "#define BOX [+F]\n#define APEX -(30,0)/(-10);(140)A\nAxiom: APEX BOX\nA --> BOX F",
            "Axiom: -(30,0)/(-10);(140)A[+F]\nA --> [+F]F",
        ),
        ("#define mid(x,y) ((x+y)/2)\nAxiom: A(mid(1,mid(2,3)))", "Axiom: A((1+(2+3)/2)/2)"),
        (
            "#define older(t) t+1\nAxiom: A(1)\nA(x) : older(x) < 5 --> A(older(x*2))",
            "Axiom: A(1)\nA(x) : x+1 < 5 --> A(x*2+1)",
        ),
        ("#define SIZE (2*t)\nAxiom: A(1)\nA(t) --> F(SIZE)", "Axiom: A(1)\nA(t) --> F(2*t)"),
        ("#define NOISE ran(5)\nAxiom: A\nA --> F(NOISE)", "Axiom: A\nA --> F(ran(5))"),
        ("#define PAIR(x) [+x][-x]\nAxiom: PAIR(F(2))", "Axiom: [+F(2)][-F(2)]"),
        ("#define none() F\nAxiom: none()B", "Axiom: FB"),
        ("#define A1 [B]\nAxiom: A1 A11", "Axiom: [B]A11"),
        ("#define LOOP A(LOOP)\n#define LOOP [LOOP]\nAxiom: F\nF --> [LOOP]", "Axiom: F\nF --> [[LOOP]]"),
        ("#define LONG [+F] \\\n [-F]\nAxiom: LONG", "Axiom: [+F][-F]"),
        ("#define X [F]\n#undef X\nAxiom: X", "Axiom: X"),
        ("#define n 3\n#if n > 2 && defined(n)\nAxiom: A\n#else\nAxiom: B\n#endif", "#define n 3\nAxiom: A"),
        ("#define FULL\n#ifdef FULL\nAxiom: A\n#endif\n#ifndef FULL\nAxiom: B\n#endif", "Axiom: A"),
        (
            "#if 0\n#if 1\nAxiom: B\n#else\nAxiom: C\n#endif\n#elif unknown\nAxiom: D\n#elif !defined unknown\nAxiom: A\n"
            "#else\nAxiom: E\n#endif",
            "Axiom: A",
        ),
        ("Axiom: A\n#if 0\n#define F [+F\n#include <x.h>\nA --> (\n#endif\nA --> B", "Axiom: A\nA --> B"),
        ("#define n (1 + \\\n 2)\nAxiom: A(n)", "#define n (1 + 2)\nAxiom: A(n)"),
    ],
)
def test_macros_that_are_no_numbers_are_put_in_place(text: str, meant: str) -> None:
    assert read(text, "cpfg") == read(meant, "cpfg")


def test_a_mistake_in_a_macro_is_shown_where_it_is_used() -> None:
    with pytest.raises(ModelSyntaxError) as caught:
        read("#define BOX(x) [+(x)F(y)]\nAxiom: A\nA --> FF BOX(2) F BOX(1", "cpfg")
    assert (caught.value.line, caught.value.column) == (3, 19)
    with pytest.raises(ModelNameError) as named:
        read("#define BOX(x) [+(x)F(y)]\nAxiom: A\nA --> FF BOX(2) F", "cpfg")
    assert (named.value.line, named.value.column) == (3, 10)


@pytest.mark.parametrize(
    "text",
    [
        "\n".join(f"#define A{i} A{i + 1} A{i + 1}" for i in range(40)) + "\nAxiom: F A0",
        "\n".join(f"#define A{i} [A{i + 1}]" for i in range(400)) + "\nAxiom: F A0",
        "#define f(x) [x x]\nAxiom: " + "f(" * 300 + "F" + ")" * 300,
        "#if 1\n" * 5000 + "Axiom: A",
        "#define X [F]\nAxiom: " + "X(" * 20_000,
        "#if 0\n" + "F\n" * 100_000,
        "#define g(x) [x]\nAxiom: " + "g(" * 20_000,
        "Axiom: F\nF --> F " + "// " * 15_000,
    ],
)
@pytest.mark.slow
def test_macros_that_grow_or_nest_without_end_are_refused(text: str) -> None:
    with spent() as taken, suppress(LSystemError):
        read(text, "cpfg")
    assert taken.seconds < 4


def test_numbers_are_those_of_c() -> None:
    assert [module.arguments for module in read_word("A(.5)B(5e-1)C(1.)D(1e1)E(-2^2)", "cpfg")] == [
        (Fraction(1, 2),),
        (Fraction(1, 2),),
        (1,),
        (10,),
        (4,),
    ]


@pytest.mark.parametrize(
    ("cpfg", "kit"),
    [
        ("x ? 1 : 2", "if(x != 0, 1, 2)"),
        ("x < 1 ? 1 : x < 2 ? 2 : 3", "if(x < 1, 1, if(x < 2, 2, 3))"),
        ("(x < 5) * 2", "if(x < 5, 1, 0) * 2"),
        ("2^x^3", "(2^x)^3"),
        ("-x^2", "(-x)^2"),
        ("-(x^2)", "-(x^2)"),
        ("fabs(x)", "abs(x)"),
        ("abs(x)", "abs(x)"),
        ("pow(x,2)", "x^2"),
        ("sin(x)", "sin(x)"),
        ("x % 3", "rem(x, 3)"),
        ("x - 3*floor(x/3)", "mod(x, 3)"),
        ("ran(x)", "uniform(0, x)"),
        ("nran(1, x)", "normal(1, x)"),
        ("biran(x, 0.5)", "binomial(x, 0.5)"),
        ("x + ran(5 - x)", "uniform(x, 5)"),
        ("x < 2 ? x : 2", "min(x, 2)"),
        ("x > 2 ? x : 2", "max(x, 2)"),
        ("trunc(x)", "if(x < 0, ceil(x), floor(x))"),
        ("sign(x)", "if(x < 0, -1, if(x > 0, 1, 0))"),
    ],
)
def test_expressions_mean_what_they_mean_in_c(cpfg: str, kit: str) -> None:
    assert rule(f"A(x) --> B({cpfg})") == abop(f"A(x) -> B({kit})")


@pytest.mark.parametrize(
    ("cpfg", "kit"),
    [
        ("1", "*"),
        ("*", "*"),
        ("0.5", "*"),
        ("0", "0 != 0"),
        ("x", "x != 0"),
        ("!x", "!(x != 0)"),
        ("x <> 3", "x != 3"),
        ("x && !(x > 5)", "x != 0 && !(x > 5)"),
        ("!x < 5", "if(!(x != 0), 1, 0) < 5"),
        ("x == 3 || x", "x == 3 || x != 0"),
        ("x - k", "x - k != 0"),
    ],
)
def test_conditions_are_numbers_and_numbers_conditions(cpfg: str, kit: str) -> None:
    assert rule(f"A(x) : {cpfg} --> B") == abop(f"A(x) : {kit} -> B")


def test_angles_of_functions_are_in_degrees() -> None:
    assert str(derive(read("Lsystem: 1\nAxiom: A(30)\nA(x) --> B(sin(x),cos(2*x),atan(1))"), 1)[-1]) == "B(0.5,0.5,45)"


@pytest.mark.parametrize(
    ("cpfg", "branch"),
    [("[B]", "[ B ε ]"), ("[B=]", "[ B ]"), ("[=]", "[ ]"), ("[]", "[ ε ]"), ("[B(x)[C=]]D", "[ B [ C ] ε ] D")],
)
def test_a_named_branch_is_a_whole_branch_unless_something_stands_for_the_rest(cpfg: str, branch: str) -> None:
    assert [module.symbol for module in rule(f"A > {cpfg} --> E").right] == branch.split()


def test_contexts_of_anything_are_no_contexts() -> None:
    assert rule("* < A > * : * --> B") == rule("A --> B")
    assert rule("* < A > B --> B") == rule("A > B --> B")


@pytest.mark.parametrize(
    ("blocks", "condition", "successor"),
    [
        ("t > 1 {x = t - 1; y = x^2;}", "t > 1", "B(t - 1,(t - 1)^2)"),
        ("{x = t + k; y = 1;} x > 5", "t + k > 5", "B(t + k,1)"),
        ("{t = t * 2;} t > 1 {x = t; y = 1;}", "t * 2 > 1", "B(t * 2,1)"),
        ("1 {if (t > 1) {x = 1;} else {x = 2;} y = x;}", "*", "B(if(t > 1, 1, 2),if(t > 1, 1, 2))"),
        ("1 {x = t; if (t) x = 5; y = 0;}", "*", "B(if(t != 0, 5, t),0)"),
        (
            "1 {if (t > 1) {x = 1; y = 1;} else if (t < 0) {x = 2; y = 2;} else {x = 3; y = 3;}}",
            "*",
            "B(if(t > 1, 1, if(t < 0, 2, 3)),if(t > 1, 1, if(t < 0, 2, 3)))",
        ),
        ("1 {x = ran(1); y = x + 1; x = 2;}", "*", "B(2,uniform(0, 1) + 1)"),
    ],
)
def test_what_a_block_computes_stands_where_it_is_used(blocks: str, condition: str, successor: str) -> None:
    assert rule(f"A(t) : {blocks} --> B(x,y)") == abop(f"A(t) : {condition} -> {successor}")


def test_sections_go_with_a_colon_or_without() -> None:
    text = "Lsystem: 1\nAxiom: A\nA --> B\ndecomposition{0}\nB --> C\nhomomorphism{0}\nC --> F\nproductions{0}\nC --> A"
    system = read(text.format(""))
    assert system == read(text.format(":"))
    assert [len(rules) for rules in (system.productions, system.decomposition, system.interpretation)] == [2, 1, 1]
    assert system == read(text.format(" no warnings").replace("homomorphism", "interpretation"))


def test_brackets_may_be_considered_like_other_symbols() -> None:
    assert read("Lsystem: 1\nConsider: JFD?P[]\nAxiom: J").considered == ("J", "F", "D", "?P")


def test_a_named_branch_is_the_next_one() -> None:
    """As in cpfg, which reads a right context and the word together from left to right."""
    text = "Lsystem: 1\nAxiom: F[-X][+D]F\nF > [+D=] --> G"
    assert str(derive(read(text), 1)[-1]) == "F[-X][+D]F"
    assert str(derive(read(text.replace("[-X]", "")), 1)[-1]) == "G[+D]F"
    assert read(text) == read("branches: next\naxiom: F[-X][+D]F\nF > [+D] -> G")
    with pytest.raises(ModelValueError, match="has no right contexts that name any branch"):
        write(read("axiom: F[-X][+D]F\nF > [+D] -> G"), "cpfg")


@pytest.mark.parametrize(
    ("line", "branches"),
    [("consider: AB", "flat"), ("consider: AB[]", "any"), ("ignore: +", "any"), ("ignore: +[]", "flat"), ("", "any")],
)
def test_brackets_that_are_not_considered_are_passed_over_by_right_contexts(line: str, branches: str) -> None:
    system = read(f"Lsystem: 1\n{line}\nAxiom: A[B]\nA > B --> A(1)\nA < B --> B(1)")
    assert system.branches == branches
    assert str(derive(system, 1)[-1]) == ("A(1)[B(1)]" if branches == "flat" else "A[B(1)]")
    assert read(write(system)) == system
    assert any("pass over brackets" in note for note in system.notes) == (line == "consider: AB")


@pytest.mark.parametrize(
    ("text", "value"),
    [("-7%3", -1), ("7.9%3", 1), ("7%-3", 1), ("-7%-3", -1), ("7%3.9", 1), ("0.5%2", 0), ("-7-3*floor(-7/3)", 2), ("-2^2", 4)],
)
def test_remainders_are_those_of_c(text: str, value: int) -> None:
    assert derive(read(f"Axiom: A({text})\nA(x) --> A(x)", "cpfg"), 0)[0][0].arguments == (value,)


@given(
    st.fractions(-50, 50, max_denominator=4).map(normalised),
    st.fractions(1, 9, max_denominator=4).map(normalised),
    st.sampled_from((1, -1)),
)
def test_a_remainder_has_the_sign_of_what_is_divided(left: Value, right: Value, sign: int) -> None:
    divided = Apply("rem", (Number(left), Number(sign * right)))
    assert function_of(divided, {})(()) == to_sympy(divided) == int(math.fmod(math.trunc(left), math.trunc(sign * right)))
    assert function_of(divided, {}, "float")(()) == math.fmod(math.trunc(left), math.trunc(sign * right))


@pytest.mark.parametrize(("left", "right"), [(7.0, 3), (7, 3.0), (7.0, 3.0)])
def test_what_a_double_leaves_is_a_double(left: Value, right: Value) -> None:
    assert repr(remainder(left, right)) == "1.0"


@pytest.mark.parametrize(
    "text", ["Axiom: A(1/0)", "Axiom: A(0)\nA(x) --> A(1/x)", "Axiom: A(0)\nA(x) --> A(5%x)", "#define c 1/0\nAxiom: A(c)"]
)
def test_the_error_for_a_division_by_zero_says_what_cpfg_does(text: str) -> None:
    with pytest.raises(ModelValueError, match="division by zero") as caught:
        derive(read(text, "cpfg"), 1)
    assert "cpfg warns of it and divides by 1" in (caught.value.hint or "")


def test_what_other_notations_lack_of_cpfg_is_said() -> None:
    system = read("Lsystem: 1\nAxiom: A(1)\nA(x) --> A((x+1)%5)")
    assert read(write(system, "abop")) == system
    with pytest.raises(ModelValueError, match="function rem"):
        write(system, "mathematica")


@pytest.mark.parametrize(
    ("text", "noted"),
    [
        ("Axiom: A@o(2)B\no(r) --> o(r+1)", True),
        ("Axiom: A@oB\no(r) --> o(r+1)\nA --> o(1)", False),
        ("Axiom: A@o(2)B\nB --> C", False),
        ("Axiom: A@o(2)B\no(r) < B --> C", True),
        ("Axiom: A\nA --> ?P(1,2)\nP(x,y) --> A", True),
        ("Axiom: A@o(2)B\n@o(r) --> @o(r+1)", False),
    ],
)
def test_a_rule_for_half_of_a_symbol_gets_a_note(text: str, noted: bool) -> None:
    assert any("is one symbol here" in note for note in read(text, "cpfg").notes) == noted


def test_a_rule_for_the_word_axiom_is_no_axiom() -> None:
    system = read("Lsystem: 1\nAxiom: AXIOM\nAXIOM : 1 --> B")
    assert [module.symbol for module in system.productions[0].predecessors] == [*"AXIOM"]
    assert str(derive(system, 1)[-1]) == "B"


@pytest.mark.parametrize(
    ("word", "meant", "note"),
    [
        ('F@L("leaf %f", 2)A', "F@L(2)A", 'Labels have no texts here: "leaf %f".'),
        ('F@L("leaf")@L("leaf")@L("stem")', "F@L@L@L", 'Labels have no texts here: "leaf", "stem".'),
        ("F@#(1)F", "F@#(1)F", "Stems are round: @#, which give contours to those of cpfg, draw nothing here."),
        ("@!(2)F@#", "@!(2)F@#", "Stems are round: @! and @#, which give contours to those of cpfg, draw nothing here."),
    ],
)
def test_labels_and_contours_are_told_and_draw_nothing(word: str, meant: str, note: str) -> None:
    system = read(f"Lsystem: 1\nAxiom: {word}")
    assert system == read(f"Lsystem: 1\nAxiom: {meant}")
    assert note in system.notes
    assert read(write(system)) == system


def test_a_macro_is_a_number_and_not_its_text() -> None:
    system = read("#define a 1\n#define b a+1\n#define c (a+1)\n#define d -a\nAxiom: F(2*b)", "cpfg")
    assert system.notes == ('The macro "b" is a number here; cpfg puts its text in place: write "(a+1)".',)
    assert str(derive(system, 0)[0]) == "F(4)"
    assert "#define b (a + 1)" in write(system)


def test_a_model_is_recognised() -> None:
    for text in (
        "#define n 1\naxiom: A",
        "Lsystem: 1\nAxiom: A",
        "Axiom: A\nendlsystem",
        "derivation length: 1\nAxiom: A",
        "Axiom: A\nA --> B\nhomomorphism\nB --> F",
        "Axiom: FX\nX < F(x) : x > limit --> FF",
    ):
        assert CPFG.likely(text) > 1, text
    for text in ("axiom: A\nA -> B", "Axiom: al\nal --> bl", "Axiom: I\nI -> I[A]I", "axiom: A\nA --> B", ""):
        assert CPFG.likely(text) == 0, text
