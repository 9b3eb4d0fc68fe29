"""Whatever a person types is a system, or a slip that is explained; nothing takes long and nothing falls over."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.budget import limits
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError, ModelLimitError
from lsys_kit.notation.read import read, read_expression, read_number, read_word
from tests.timing import spent


def error_of(action: Callable[[], object]) -> LSystemError | None:
    """The mistake that an action explains, if it does; anything else goes through."""
    try:
        action()
    except LSystemError as error:
        return error
    return None


def slip(text: str) -> LSystemError:
    """The error that a model ends in, while it is read or derived."""
    error = error_of(lambda: derive(read(text), 3))
    assert error is not None
    return error


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("axiom: " + "N" * 65, "This name has more than 64 letters"),
        ("axiom: A(" + "1," * 16 + "1)", '"A" has more than 16 parameters'),
        ("axiom: A(" + "9" * 1001 + ")", "This number is too long"),
        ("axiom: A(" + "1+" * 51 + "1)", "This expression is nested more than 50 deep"),
        ("axiom: A(" + "abs(" * 51 + "1" + ")" * 52, "This expression is nested more than 50 deep"),
        ("axiom: A(min(" + ",".join(["1 + 1" + " " * 300] * 8) + "))", "This expression has more than 2,000 characters"),
        ("axiom: " + "[" * 10_001 + "]" * 10_001, "More than 10,000 brackets are open at once"),
        ("axiom: A" + " B" * 30_000, "This line has 60,008 characters; the limit is 50,000"),
        ("axiom: A" + "\nA -> B" * 1_001, "The model has more than 1,000 productions"),
        ("c = 1\n" * 2_001, "The model has more than 2,000 lines that are not blank"),
        ("axiom: A" + ("\nA -> " + "B " * 100) * 700, "The model has more than 64,000 characters, without blanks and comments"),
        ("axiom: A" + " " * 1_000_000, "The text has 1,000,008 characters; the limit is 1,000,000"),
    ],
)
def test_what_is_too_long_is_refused(text: str, message: str) -> None:
    assert slip(text).message == message


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        "axiom: " + "[" * 10**6,
        "axiom: A" + "(" * 10**6,
        "axiom: " + "A(" * 499_990,
        "axiom: A(" + "-" * 999_980 + "1)",
        "axiom: " + "A " * 499_990,
        "axiom: A(" + "9" * 999_980 + ")",
        "/* " * 333_333,
        "axiom: A\n" * 111_111,
        "axiom: A\nA " + "->" * 499_980,
        "productions:\n" * 70_000,
        "axiom: A(9^9^9^9)",
        "x = 9^9^9^9\naxiom: A",
        "axiom: A(1e999999999)",
        "axiom: A(0)\nA(t) : t < 9^9^9^9 -> A(t)",
        "axiom: A(0)\nA(t) -> A(floor(9^9^9^9))",
        "axiom: " + "[" * 49_000,
        "axiom: " + "A(" * 24_000,
        "axiom: A(" + "1," * 24_000 + "1)",
        "axiom: " + "]" * 49_000,
        "a = 3^600\n" + "".join(f"a{i} = a{i - 1 if i else ''}*a{i - 1 if i else ''}\n" for i in range(900)) + "axiom: A",
        "axiom: A(" + "*".join(["9^600"] * 50) + ")",
        "axiom: A(" + "1" + "." * 40_000 + "<2<3)",
    ],
    ids=range(22),
)
def test_no_text_takes_long(text: str) -> None:
    with spent() as taken:
        assert isinstance(slip(text), LSystemError)
    assert taken.seconds < 2 * 3  # of the processor's time; two on a quick machine


PIECES = [
    "A",
    "B",
    "F",
    "al",
    "t",
    "[",
    "]",
    "(",
    ")",
    "->",
    "-->",
    "→",
    ":",
    "=",
    "==",
    "<",
    "<=",
    "0",
    "2.5",
    "1e9",
    ".",
    "+",
    "-",
    "*",
    "/",
    "^",
    "&&",
    "||",
    "!",
    ",",
    ";",
    "ε",
    "in",
    "..",
    "by",
    "min(",
    "log(",
    "/*",
    "*/",
    "#",
    "%",
    "'",
    '"',
    "~",
    "{",
    "axiom:",
    "angle:",
    "steps:",
    "alphabet:",
    "interpretation:",
    "decomposition:",
    "meta:",
    "ignore:",
    "depth:",
    "repeat(2, i) <",
    "repeat(",
    "uniform(",
    "> ",
    "\n",
    " ",
    "  ",
    "\t",
    "\r",
    "\x00",
    "\ufeff",
    "\u202e",
    "\ud800",
    "Ф",
    "p_1:",
    "V = {",
    "P = {",
    "ω =",
    "\\omega:",
    "δ =",
    "°",
    "::=",
    "\\vec{",
    "\\overleftarrow{A}",
    "A\u20d7",
    "F=",
    "Angle 6\n",
    "Axiom ",
    "Koch {\n",
    "}\n",
    "@iq",
    "\\30",
    "c",
    "_{r}",
    "\\rightarrow",
    "\\xrightarrow{",
    "\\geq",
    "(A, 0)",
    "@o",
    "@Ts",
    "?P",
    "turtle:",
    "seed:",
    "Number of productions:",
]
MODELS = [
    "dt = 0.7 in 0.1 .. 2 by 0.1\naxiom: A(0)\nA(t) : t+dt >= 1 && !(t > 3) -> [+A(t+dt-1)]B(sqrt(t)^2)\nA(t) -> A(t+dt)",
    "angle: 25.7\nsteps: 4\naxiom: F\nF -> F[+F]F[-F]F /* a plant */",
    "ignore: + -\naxiom: A B\nA < B > [C]A : 1 < 2 -> repeat(2, i) <F(uniform(0, i))> A : 1/3\nB -> C\nmeta: F F -> F",
    "axiom: ar\nar -> al br\nal -> bl ar\nbr -> ar\nbl -> al\ninterpretation:\nar -> R(2,1)",
    "V = {\\vec{A}, b_r}\nω = \\vec{A}\np_1 : \\vec{A} \\rightarrow A\u20d6 b_{r},\n"
    "p_2 : A\u20d6 > b_r \\rightarrow ,\nδ = 60°\nd = 2",
    "P = {F ::= F+F--F+F, f ::= f}\naxiom F\nG(t) : t \\geq 1 \\xrightarrow{0.5} F@o",
    "ω : (a, 0)\np_1 : (a, 1) → (a, 0)(b, 0)\np_2 : b < a > [b ε] → ?P",
    "Number of productions: 1\nI -> I[A](I)\nStage 0 string: I",
    "Koch { ; a curve\n  Angle 6\n  Axiom F--F--F\n  F=F+F\n  F=--F@.5!<1F|[\\30D]\n  }\nDot (old) {\n Axiom c1f\nangle=4\n}",
]


@st.composite
def spoilt(draw: st.DrawFn) -> str:
    """A good model in which a few pieces were lost, put in or moved."""
    text = draw(st.sampled_from(MODELS))
    for _ in range(draw(st.integers(1, 3))):
        start, end = sorted((draw(st.integers(0, len(text))), draw(st.integers(0, len(text)))))
        end = min(end, start + draw(st.integers(0, 3)))
        text = text[:start] + draw(st.sampled_from(["", *PIECES])) + text[end:]
    return text


ANY_TEXT = st.one_of(
    spoilt(),
    st.lists(st.sampled_from(PIECES)).map("".join),
    st.lists(st.sampled_from(PIECES)).map(" ".join),
    st.text(max_size=40),
)


@given(ANY_TEXT, st.sampled_from(["abop", "plant-string", "fractint"]))
def test_a_text_is_a_system_or_an_explained_slip(text: str, notation: str) -> None:
    def derived() -> None:
        system = read(text, notation)
        assert read(str(system), notation) == system
        str(derive(system, 3)[-1])

    with limits(modules=500, seconds=2):
        error = error_of(derived)
    assert error is None or isinstance(error, ModelLimitError) or error.line is not None


@pytest.mark.parametrize("reader", [read_word, read_expression, read_number])
@given(ANY_TEXT)
def test_other_texts_are_read_or_explained(reader: Callable[[str], object], text: str) -> None:
    error = error_of(lambda: reader(text))
    assert error is None or error.line is not None
