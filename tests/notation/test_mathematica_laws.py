"""What is written in Mathematica's notation reads back as the same system; any text is a system or an explained slip."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit.budget import limits
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError
from lsys_kit.notation.dialects.mathematica.dialect import MATHEMATICA
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read, read_word
from lsys_kit.notation.syntax.parser import parse
from lsys_kit.notation.syntax.systems import lacking
from lsys_kit.notation.write import write
from tests.derivation.random_systems import CHANCE, CONTEXT, CUT, conditions, systems, systems_with
from tests.timing import spent

LISTINGS = [file.read_text("utf-8") for file in sorted((Path(__file__).parents[1] / "listings").glob("*.mathematica.txt"))]


FULL = """lifeTime = 3; (* 1 .. 6 by 1 *)
dt = lifeTime/2;
turtle = "grogra";
angle = 25.7;
heading = 0;
length = 5;
seed = 3;
axiom = AXIOM[al[1], "+"[30]];
lrules =
  LRULES[
    LRule[LEFT[a[i_ /; i < lifeTime], b], PRED[M[t_, p_] /; t < dt && p == 1], RIGHT["[", c[j_ /; j > 0], "]"], SUCC[]],
    LRule[LEFT[], PRED[M[lifeTime, p_]], RIGHT[], SUCC[F, "[", "+", F, "]"]]
  ];
lsystem = LSystem[axiom, lrules];
skipPattern = {F, "+"};
growth = runKLSystem[lsystem, 4];"""


def test_a_system_prints_as_it_was_laid_out() -> None:
    assert str(read(FULL)) == FULL
    assert read(str(read(FULL))) == read(FULL)


def test_a_word_prints_with_blanks_and_reads_back() -> None:
    word = derive(read("AXIOM[Al[3]]; LRule[LEFT[], PRED[Al[3]], RIGHT[], SUCC[Al[1], Br[1]]]"), 1)[-1]
    assert str(word) == "Al[1] Br[1]"
    assert read_word(str(word), "mathematica") == tuple(word)
    assert read_word('F "[" "+"[1/2] M[-1, 0.5] "]"', "mathematica") == (
        Module("F"),
        Module("["),
        Module("+", (Fraction(1, 2),)),
        Module("M", (-1, Fraction(1, 2))),
        Module("]"),
    )


@pytest.mark.parametrize("condition", ["p && q", "p && (q && r)", "(p && q) && (r && s)", "r && p && q", "p || q", "q && p"])
def test_a_condition_is_parted_so_that_it_reads_back(condition: str) -> None:
    """Parts stand with the modules that they are about, where they are joined again as they were."""
    text = re.sub("[pqrs]", lambda part: {"p": "i > 1", "q": "t < i", "r": "j != 0", "s": "j < 9"}[part[0]], condition)
    system = read(f"axiom: A(1)\nA(i) < B(t) > C(j) : {text} -> D")
    assert read(write(system, "mathematica")) == system


def test_names_of_definitions_are_no_constants() -> None:
    system = read("lrules = 1\nlsystem = 2\ngrowth = 3\nsteps: 2\naxiom: A(lrules)")
    assert read(write(system, "mathematica")) == system


@pytest.mark.parametrize(
    ("text", "lacking"),
    [
        ("axiom: A\nA -> B : 0.5", "probabilities"),
        ("axiom: A\ndecomposition:\nA -> B", "decomposition rules"),
        ("axiom: A\ninterpretation:\nA -> F", "interpretation rules"),
        ("axiom: A\nmeta: A A -> A", "meta-rules"),
        ("axiom: A\nA -> repeat(2) <B>", "repetition"),
        ("consider: A\naxiom: A", "considered symbols"),
        ("depth: 2\naxiom: A", "depth"),
        ("decomposition depth: 2\naxiom: A", "depth"),
        ("axiom: A(1)\nA(t_) -> A(t_)", 'name like "t_"'),
        ("length = 3\naxiom: A(length)", 'other meaning of the name "length"'),
        ("axiom: A(1)\nA(Degree) -> A(1)", 'other meaning of the name "Degree"'),
    ],
)
def test_what_mathematica_lacks_is_named(text: str, lacking: str) -> None:
    message = re.escape(f"The notation mathematica has no {lacking}, which this system needs")
    with pytest.raises(ModelValueError, match=message):
        write(read(text), "mathematica")


def test_the_end_of_a_branch_is_lacking() -> None:
    system = LSystem((Pattern("A"),), (Production((Pattern("A"),), (), right=tuple(map(Pattern, ("[", "B", "ε", "]")))),))
    assert lacking(MATHEMATICA, system) == "branch ends in contexts"


def expressed(system: LSystem) -> LSystem:
    """A system without what Mathematica's notation lacks."""
    productions = tuple(replace(rule, probability=None) for rule in system.productions)
    return replace(system, considered=(), branches="any", productions=productions)


SEEN: Counter[str] = Counter()


@pytest.mark.slow
@settings(max_examples=200)
@given(systems() | systems_with(CONTEXT, CUT).map(expressed) | systems_with(CONTEXT, CHANCE).map(expressed))
def test_what_is_written_is_read_again(system: LSystem) -> None:
    text = write(system, "mathematica")
    again = read(text, "mathematica")
    assert again == system
    assert write(again) == text
    one, other = (derive(each, 2, seed=5)[-1] for each in (system, again))
    assert tuple(one) == tuple(other)
    assert read_word(MATHEMATICA.word(one), "mathematica") == tuple(one) or any(
        isinstance(argument, float) for module in one for argument in module.arguments
    )
    SEEN.update(
        {
            "systems": 1,
            "inside": bool(re.search(r"_ /; [^]]*\]\]", text)),
            "behind": "] /;" in text,
            "random": "Random" in text,
            "ignored": bool(system.ignored),
            "constants": bool(system.constants),
            "quoted": '"[", ' in text,
        }
    )


def test_the_systems_written_had_everything() -> None:
    assert {kind for kind, count in SEEN.items() if count < 3} == set()


@given(conditions(("i", "t", "j"), 1), conditions(("i", "t", "j"), 1), conditions(("i", "t", "j"), 1), st.booleans())
def test_every_condition_is_read_again(one: Expression, two: Expression, three: Expression, leftward: bool) -> None:
    joined = Apply("&&", (Apply("&&", (one, two)), three)) if leftward else Apply("&&", (one, Apply("&&", (two, three))))
    production = Production(
        (Pattern("B", (Name("t"),)),),
        (),
        joined,
        (Pattern("A", (Name("i"),)), Pattern("x")),
        (Pattern("["), Pattern("C", (Name("j"),)), Pattern("]")),
    )
    system = LSystem((Pattern("B", (Number(1),)),), (production,))
    assert read(write(system, "mathematica"), "mathematica") == system


def test_conditions_are_not_nested_without_end() -> None:
    patterns = ", ".join(f"a[i{number}_ /; i{number} > 0]" for number in range(60))
    error = error_of(f"AXIOM[a[1]]; LRule[LEFT[{patterns}], PRED[b], RIGHT[], SUCC[]]")
    assert error is not None
    assert (error.message, error.column) == ("The conditions of this rule are nested more than 50 deep", 14)


PIECES = [
    "A",
    "b",
    "LEFT[",
    "PRED[",
    "SUCC[",
    "LRule[",
    "LRULES[",
    "AXIOM[",
    "LSystem[",
    "run[",
    "Sin[",
    "ArcSin[",
    "RandomReal[{",
    "If[",
    "]",
    "[",
    "{",
    "}",
    "(",
    ")",
    ",",
    ";",
    "=",
    ":=",
    "==",
    "_",
    "i_",
    "x__",
    "/;",
    "<",
    ">",
    "->",
    "→",
    '"',
    '"+"',
    "(*",
    "*)",
    "1",
    "2.5",
    "1*^3",
    "Degree",
    "/",
    "Rules:",
    "Axiom:",
    "skipPattern",
    "angle",
    "&",
    "#",
    "//",
    "@",
    "%",
    "<<",
    "$",
    "α",
    "Null",
    "\n",
    " ",
    "\x00",
    "\ud800",
    "/*",
    "..",
    "by",
    ".",
    "?",
]


@st.composite
def spoilt(draw: st.DrawFn) -> str:
    """A good text in which a few pieces were lost or put in."""
    text = draw(st.sampled_from([FULL, *LISTINGS]))
    for _ in range(draw(st.integers(1, 3))):
        start = draw(st.integers(0, len(text)))
        text = text[:start] + draw(st.sampled_from(["", *PIECES])) + text[start + draw(st.integers(0, 3)) :]
    return text


def error_of(text: str) -> LSystemError | None:
    """What is wrong with a text, if it is no system that is written, read again and derived."""
    try:
        system = read(text, "mathematica")
        assert read(str(system), "mathematica") == system
        str(derive(system, 3)[-1])
    except LSystemError as error:
        return error
    return None


@given(spoilt() | st.lists(st.sampled_from(PIECES)).map("".join))
def test_a_text_is_a_system_or_an_explained_slip(text: str) -> None:
    with limits(modules=500, seconds=2):
        error = error_of(text)
    assert error is None or isinstance(error, ModelLimitError) or error.line is not None


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        "axiom = AXIOM[" + "a," * 490_000,
        "[" * 10**6,
        "(* " * 333_333,
        "(* *)" * 200_000,
        '"' * 10**6,
        ";" * 10**6,
        "x = " + "\n" * 999_990,
        "a[1] " * 9_900,
        "a_ " * 300_000,
        "x =\n\n" * 180_000,
        "k = 1; (* 1 .. " * 60_000,
        "x = " + "1+" * 20_000,
        "a[:= " * 200_000,
        "LRULES[" + "LRule[LEFT[], PRED[a[i_ /; i < 3]], RIGHT[b], SUCC[a[i + 1], b]],\n" * 14_000,
        "".join(f"k{i} = k{i + 1} + 1;\n" for i in range(1_800)),
    ],
    ids=range(15),
)
def test_no_text_takes_long(text: str) -> None:
    with spent() as taken, pytest.raises(LSystemError):
        read(text, "mathematica")
    assert taken.seconds < 2 * 3  # of the processor's time; two on a quick machine


def test_an_expression_is_read_at_once() -> None:
    text = "If[i < w, Max[i, 3], i^2 - 0.5]"
    parse(MATHEMATICA, "expression", text, 0, len(text))
    with spent() as taken:
        for _ in range(100):
            parse(MATHEMATICA, "expression", text, 0, len(text))
    assert taken.seconds < 100 * 0.003  # a tenth of that on a quick machine
