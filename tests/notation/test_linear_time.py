"""No text takes long: each reader, with each token of each grammar, and any two of them, repeated until the text is full.

A line of a model has at most 50,000 characters. What is done with a whole text is tried on almost as many, what is done within
a line on 12,000: enough to see what takes the square of their number.
"""

from __future__ import annotations

import re
from contextlib import suppress

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit.errors import LSystemError
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import DIALECTS, recognise
from lsys_kit.notation.syntax.parser import _parser
from tests.timing import spent

TOKENS = (
    "field:",
    "axiom:",
    "\\omega :",
    "ω =",
    "theta pi/6",
    "theta ",
    "axiom A",
    "angle:",
    "δ:",
    "decomposition depth:",
    "δ =",
    "\\delta :",
    "°",
    "^\\circ",
    "turtle:",
    "abop",
    "fractint",
    "cells:",
    "ellipses",
    "ignore:",
    "meta:",
    "repeat(",
    "alphabet:",
    "V = {",
    "P = {",
    "productions:",
    "decomposition",
    "homomorphism",
    "interpretation:",
    "->",
    "-->",
    "→",
    "⟶",
    "::=",
    "\\rightarrow",
    "\\xrightarrow{",
    "in",
    "by",
    "..",
    "ε",
    "*",
    "\\varepsilon",
    ", ",
    "ε]",
    "(A, ",
    "(A,",
    "\\vec{A}",
    "A⃗",
    "b_{r}",
    "@Ts",
    "@T",
    "@o",
    "?P",
    "+",
    "-",
    "−",
    "&",
    "^",
    "\\",
    "/",
    "|",
    "{",
    "}",
    "$",
    "!",
    "'",
    "#",
    "~",
    ";",
    ".",
    "%",
    "@",
    "0",
    "1",
    "12",
    "1.5",
    ".5",
    "1e5",
    "[",
    "]",
    "(",
    ")",
    "/*",
    "*/",
    "/* x */",
    "A",
    "a",
    "al",
    "A ",
    "F",
    "p_1 :",
    "p1:",
    "_",
    "<",
    ">",
    "<=",
    "==",
    "=",
    "!=",
    "<>",
    "≤",
    "&&",
    "||",
    "∨",
    "∧",
    "¬",
    "·",
    "×",
    ":",
    ",",
    "Number of productions:",
    "Stage 1 string:",
    "\\axiom",
    "Startwort",
    "\\angle",
    "\\set depth",
    "\\set x",
    "\\set turtle",
    "\\const",
    "\\var",
    "1-8",
    "##",
    "\\dots",
    "&(",
    "RU45",
    "L*(",
    "L*",
    "u1'",
    "?0.5",
    "\\var x uniform",
    "index",
    "#define",
    "# define x",
    "#define dt 0.7 /* 1 .. 2 */",
    "/* 1 .. 2 */",
    "/* angle: 3 */",
    "derivation length:",
    "maximum depth:",
    "seed:",
    "lsystem:",
    "Lsystem: 1",
    "endlsystem",
    "if",
    "else",
    "if(",
    "=]",
    "//",
    "// x",
    " //",
    "x = 1;",
    "Angle 6",
    "angle",
    "Axiom F",
    "F=",
    "F =",
    "@.5",
    "\\30",
    "<I1",
    "@IQ",
    "Koch {",
    "; x",
    "AXIOM[",
    "LRULES[",
    "LRule[",
    "LEFT[",
    "PRED[",
    "RIGHT[",
    "SUCC[",
    "LSystem[",
    "runKLSystem[",
    "skipPattern =",
    "skipPattern=",
    "turtle=",
    "angle =",
    "lrules =",
    "axiom =",
    "Axiom:",
    "Rules:",
    "i_",
    "i_ /;",
    "/;",
    "Null",
    '"',
    '"+"',
    '"\\',
    '\\"',
    "Sin[",
    "ArcTan[",
    "Degree",
    "RandomReal[",
    "RandomVariate[",
    "RandomChoice[",
    "Show[",
    "Plot[",
    "Clear[",
    "x[",
    "foo[",
    "(*",
    "*)",
    "(* x *)",
    "(* (* *) *)",
    "<<",
    "x/:",
    ":=",
    ":>",
    "/.",
    "#&",
    "& ",
    "*^5",
    "1*^5",
    "1.",
    "]]",
    "],",
    "\n",
    "\n\n",
    "\t",
    " ",
    "\r",
    "\x0b",
    "\xa0",
    "\ufeff",
    "n=3, ",
    "n=5, δ=25.7°\n",
    "Start:",
    "-  A → ",
    "• ",
    "0.5 → ",
    "1\n",
    " .5",
    "\\bar{A}",
    "branches:",
    "next",
    "surface leaf:",
    "surface: l x",
    "patch",
    "(0, 1)",
    "widths:",
    "pixels",
    "colours:",
    "natural",
    "symbols",
    "cells: ellipses",
    "\\set widths units",
    'colours = "natural"',
    "; steps: ",
    "\\quad",
    "\\begin{array}",
    "\\\\",
    "∗",
    "’",
    "–",
    "|-",
    ">*",
    "*<",
    "#include",
    "A -> B\n",
    "A\n",
    "A -> ",
    "A : t < 5 -> ",
    "B < ",
    "> B",
    "A(t)",
    "A(",
    "A(1)",
    "F[+F]",
    "{A}",
    "{}",
    "[]",
    "()",
    "&& ",
    "|| ",
    "!(",
)
"""Something for each token of each grammar, and what a printed listing has beside them."""
BEGINNINGS = {
    "abop": ("", "axiom: A\nA -> ", "axiom: A\nA(t) : t > "),
    "plant-string": ("", "Axiom: A\nA -> "),
    "cpfg": (
        "",
        "Axiom: A\nA --> ",
        "Axiom: A\nA(t) : t > ",
        "Axiom: A\n#define x(",
        "Axiom: A\n#define x ",
        "Axiom: A\narray x[1] = {1};\nstart: {",
    ),
    "grogra": ("", "\\axiom A,\nA # ", "\\axiom A,\n(t > "),
    "fractint": ("", "K {\nAngle 8\nAxiom A\nA="),
    "mathematica": ("", "axiom = AXIOM[A];\nlrules = LRULES[LRule[LEFT[], PRED[A], RIGHT[], SUCC["),
}
RECOGNISED, TEXT, LINE = 100_000, 48_000, 12_000
EXAMPLES = 20


def seconds(text: str, notation: str) -> float:
    """How long it takes to read a text, or to say what is wrong with it."""
    with spent() as taken, suppress(LSystemError):
        read(text, notation)
    return taken.seconds


def filled(beginning: str, piece: str, size: int = 0) -> str:
    """A beginning and a piece as often as there is room."""
    return beginning + piece * (((size or (LINE if beginning else TEXT)) - len(beginning)) // len(piece))


@pytest.mark.parametrize("notation", DIALECTS)
def test_every_token_of_the_grammar_is_tried(notation: str) -> None:
    missing = [
        token.name
        for token in _parser(DIALECTS[notation]).terminals
        if not any(re.search(token.pattern.to_regexp(), sample) for sample in TOKENS)
    ]
    assert missing == []


@pytest.mark.slow
def test_a_long_text_of_any_token_is_recognised_in_linear_time() -> None:
    """A tenth of a million characters in a second: what takes the square of their number takes longer by far."""
    slow = {}
    for token in TOKENS:
        with spent() as taken:
            recognise(filled("", token, RECOGNISED))
        if taken.seconds > 1:
            slow[token] = taken.seconds
    assert slow == {}


@pytest.mark.slow
@pytest.mark.parametrize("notation", DIALECTS)
@settings(max_examples=EXAMPLES)
@given(st.data())
def test_a_line_of_any_token_or_any_two_is_read_in_linear_time(notation: str, data: st.DataObject) -> None:
    """Some tokens, and some pairs of them."""
    piece = "".join(data.draw(st.lists(st.sampled_from(TOKENS), min_size=1, max_size=2)))
    seconds("A", notation)  # the first makes the parser
    assert seconds(filled(data.draw(st.sampled_from(BEGINNINGS[notation])), piece), notation) < 2
