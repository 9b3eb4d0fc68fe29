"""Laws of cpfg's notation: what is written reads back as the same system, whatever is typed is read or explained."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from lsys_kit.budget import limits
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError
from lsys_kit.notation.dialects.cpfg.dialect import CPFG
from lsys_kit.notation.dialects.cpfg.expressions import expression_text, missing_function
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, is_random
from lsys_kit.notation.model.modules import END, Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read, read_expression, read_word
from lsys_kit.notation.syntax.systems import lacking
from lsys_kit.notation.write import write
from tests.derivation.random_systems import CHANCE, CONTEXT, CUT, DECOMPOSITION, SEVERAL, systems, systems_with
from tests.timing import spent

LETTERS = {"al": "@o", "u_1": "?P"}


def spelt(expression: Any) -> Any:
    """An expression with distributions that cpfg has."""
    if not isinstance(expression, Apply):
        return expression
    operands = tuple(map(spelt, expression.operands))
    if expression.operator == "poisson":
        return Apply("uniform", (Number(0), *operands))
    if expression.operator == "table":
        return Apply("normal", operands[:2])
    return Apply(expression.operator, operands)


def lettered(module: Pattern) -> Pattern:
    return Pattern(LETTERS.get(module.symbol, module.symbol), tuple(map(spelt, module.arguments)))


def in_letters(rule: Production) -> Production:
    return Production(
        tuple(map(lettered, rule.predecessors)),
        tuple(map(lettered, rule.successor)),
        spelt(rule.condition),  # type: ignore[arg-type]
        tuple(map(lettered, rule.left)),
        tuple(map(lettered, rule.right)),
        spelt(rule.probability),
    )


def in_cpfg(system: LSystem) -> LSystem:
    """A system with symbols and distributions that cpfg has."""
    return replace(
        system,
        axiom=tuple(map(lettered, system.axiom)),
        productions=tuple(map(in_letters, system.productions)),
        decomposition=tuple(map(in_letters, system.decomposition)),
    )


def with_ends(system: LSystem) -> LSystem:
    """The branches of every other right context end where they are named."""

    def ended(rule: Production) -> Production:
        right = [part for module in rule.right for part in ((Pattern(END), module) if module.symbol == "]" else (module,))]
        return replace(rule, right=tuple(right))

    return replace(system, productions=tuple(ended(rule) if i % 2 else rule for i, rule in enumerate(system.productions)))


def settings(system: LSystem) -> st.SearchStrategy[LSystem]:
    """A system with all kinds of settings."""
    few = st.none() | st.integers(0, 3)
    angles = st.sampled_from((90, 60, Fraction(257, 10), -45, Fraction(1, 3)))
    return st.builds(
        lambda **made: replace(system, **made),
        angle=angles,
        heading=angles,
        seed=st.none() | st.integers(-2, 9),
        length=st.none() | st.sampled_from((0, 5, Fraction(1, 2))),
        steps=few,
        depth=st.integers(0, 3),
        decomposition_depth=few,
        interpretation=st.sampled_from(((), tuple(system.decomposition[:1]))),
    )


ANY_SYSTEM = (
    st.one_of(systems(), systems_with(CONTEXT, CHANCE, DECOMPOSITION, CUT, SEVERAL))
    .map(in_cpfg)
    .flatmap(lambda system: st.sampled_from((system, with_ends(system))))
    .flatmap(settings)
)


def writable(system: LSystem) -> bool:
    chance = any(
        rule.probability is not None or any(map(is_random, module.arguments))  # type: ignore[arg-type]
        for rule in system.interpretation
        for module in rule.modules
    )
    return not chance and lacking(CPFG, system) is None


@given(ANY_SYSTEM)
def test_what_is_written_reads_back_as_the_same_system(system: LSystem) -> None:
    assume(writable(system))
    written = write(system, "cpfg")
    assert read(written, "cpfg") == system
    assert read(written) == system
    assert write(read(written)) == written


@given(ANY_SYSTEM)
def test_the_same_words_come_out_of_what_is_written(system: LSystem) -> None:
    assume(writable(system))

    def words(system: LSystem) -> list[tuple[Pattern, ...]] | str:
        try:
            return [tuple(word) for word in derive(system, 3)]
        except LSystemError as error:
            return type(error).__name__

    with limits(modules=5_000):
        back = read(write(system, "cpfg"))
        assert words(back) == words(system)
        word = derive(back, 0)[-1]
        assert read_word(str(word), "cpfg") == tuple(word)


@st.composite
def expressions(draw: st.DrawFn, truth: bool = False, depth: int = 3) -> Expression:
    """Any expression that cpfg has."""
    if truth and depth:
        if draw(st.booleans()):
            sides = draw(expressions(depth=depth - 1)), draw(expressions(depth=depth - 1))
            return Apply(draw(st.sampled_from(("==", "!=", "<", "<=", ">", ">="))), sides)
        joined = draw(expressions(True, depth - 1)), draw(expressions(True, depth - 1))
        operator = draw(st.sampled_from(("&&", "||", "!")))
        return Apply(operator, joined[:1] if operator == "!" else joined)
    kind = draw(st.sampled_from(("name", "number", "binary", "unary", "choice", "function"))) if depth else "name"
    if truth:
        return Apply("!=", (Name("t"), Number(0)))
    if kind == "number":
        return Number(draw(st.sampled_from((0, 1, -2, Fraction(1, 2), Fraction(-7, 10)))))
    if kind == "name":
        return Name(draw(st.sampled_from(("t", "x"))))
    operands = draw(expressions(depth=depth - 1)), draw(expressions(depth=depth - 1))
    if kind == "binary":
        operators = ("+", "-", "*", "/", "^", "mod", "rem", "min", "max", "uniform", "normal", "binomial")
        return Apply(draw(st.sampled_from(operators)), operands)
    if kind == "unary":
        return operands[0] if isinstance(operands[0], Number) else Apply("-x", operands[:1])
    if kind == "choice":
        return Apply("if", (draw(expressions(True, depth - 1)), *operands))
    return Apply(draw(st.sampled_from(("abs", "sqrt", "sin", "atan", "floor", "exp"))), operands[:1])


@pytest.mark.parametrize(
    ("kit", "cpfg"),
    [
        ("-t^2", "-(t^2)"),
        ("(-t)^2", "(-t)^2"),
        ("t^x^2", "t^(x^2)"),
        ("(t^x)^2", "(t^x)^2"),
        ("t^-x", "t^(-x)"),
        ("2 * rem(t + 1, x)", "2 * ((t + 1) % x)"),
        ("mod(t, x)", "t - x * floor(t/x)"),
        ("-if(t < 1, x, 2)", "-(t < 1 ? x : 2)"),
        ("t - (x - 1)", "t - (x - 1)"),
        ("max(t, -x)", "(t > -x ? t : -x)"),
        ("uniform(-1, x)", "((-1) + ran(x - -1))"),
    ],
)
def test_what_binds_otherwise_in_cpfg_is_put_in_parentheses(kit: str, cpfg: str) -> None:
    expression = read_expression(kit)
    assert expression_text(expression) == cpfg
    assert read(f"Axiom: A\nA(t,x) --> B({cpfg})", "cpfg").productions[0].successor == (Pattern("B", (expression,)),)


@given(expressions(), expressions(True))
def test_any_expression_binds_as_it_is_written(number: Expression, truth: Expression) -> None:
    assume(not missing_function(number) and not missing_function(truth))
    made = Production((Pattern("A", (Name("t"), Name("x"))),), (Pattern("B", (number, number)),), truth)
    assume(not is_random(truth))
    text = f"Axiom: A(0,1)\nA(t,x) : {expression_text(truth)} --> B({expression_text(number)},{expression_text(number)})"
    assert read(text, "cpfg").productions == (made,)


@pytest.mark.parametrize(
    ("text", "feature"),
    [
        ("axiom: al", 'symbol "al"'),
        ("axiom: A\nA -> repeat(2) <B>", "repetition"),
        ("axiom: f f\nmeta: f f -> f", "meta-rules"),
        ("turtle: grogra\naxiom: F", "turtle commands of GROGRA"),
        ("turtle: plant-string\naxiom: F", "turtle commands of plant strings"),
        ("axiom: A(1)\nA(t) -> A(poisson(t))", 'function "poisson"'),
        ("axiom: A(1)\nA(t) -> A(min(t, 1, 2))", 'function "min" of more than two numbers, or of random numbers'),
        ("axiom: A(1)\nA(t) -> A(uniform(uniform(0, 1), 2))", "random numbers from a random number on"),
        ("axiom: A(1)\nA(t) -> A(if(t < 1, t, 1))", 'other words for "min"'),
        ("k = 1 in 0 .. 2*3\naxiom: A", "ends of sliders that are calculated"),
        ("ignore: al\naxiom: A", 'symbol "al"'),
    ],
)
def test_what_cpfg_lacks_is_named(text: str, feature: str) -> None:
    with pytest.raises(ModelValueError) as caught:
        write(read(text), "cpfg")
    assert caught.value.message == f"The notation cpfg has no {feature}, which this system needs"


def test_the_end_of_a_branch_is_nothing_by_itself() -> None:
    system = LSystem((Pattern("A"),), (Production((Pattern("A"),), (Pattern(END),)),))
    with pytest.raises(ModelValueError, match='The notation cpfg has no symbol "ε", which this system needs'):
        write(system, "cpfg")


# Any text

PIECES = [
    "A",
    "B",
    "F",
    "t",
    "x",
    "[",
    "]",
    "(",
    ")",
    "-->",
    "->",
    ":",
    "=",
    "==",
    "<",
    ">",
    "0",
    "2.5",
    ".5",
    "+",
    "-",
    "*",
    "/",
    "//",
    "^",
    "&&",
    "||",
    "!",
    ",",
    ";",
    "?",
    "%",
    "@",
    "@o",
    "?P",
    "{",
    "}",
    "{x=1;}",
    "if(",
    "else",
    "/*",
    "*/",
    "/* angle: 3 */",
    "/* 1 .. 2 by 1 */",
    "#define n 3",
    "#define",
    "Axiom:",
    "Lsystem: 1",
    "endlsystem",
    "derivation length:",
    "maximum depth: 2",
    "decomposition",
    "homomorphism",
    "ignore:",
    "consider:",
    "seed: 2",
    "Start:",
    "ran(",
    "while",
    "-o>",
    "\n",
    "\n",
    " ",
    "\t",
    "\x00",
    "Ф",
    "−",
    "ε",
]
MODELS = [
    "#define dt 0.7 /* 0.1 .. 2 by 0.1 */\nLsystem: 1\nAxiom: A(0)\nA(t) : t+dt >= 1 && !(t > 3) --> [+A(t+dt-1)]B(sqrt(t)^2)",
    "Axiom: AB\nA < B > [C=]A : {x = 2;} 1 --> F(x)//F : 40\ndecomposition\nmaximum depth: 2\nF(x) : x > 1 {y = x-1;} --> F(y)",
    "Lsystem: 1\nignore: +-\nAxiom: F//F\n/* angle: 25.7 */\nF --> F[+F]F\n  [-F]F /* a plant */\nhomomorphism:\n"
    "F --> ;F(1)\nendlsystem",
]


@st.composite
def spoilt(draw: st.DrawFn) -> str:
    """A good model in which a few pieces were lost or put in."""
    text = draw(st.sampled_from(MODELS))
    for _ in range(draw(st.integers(1, 3))):
        start = draw(st.integers(0, len(text)))
        end = start + draw(st.integers(0, 3))
        text = text[:start] + draw(st.sampled_from(["", *PIECES])) + text[end:]
    return text


def error_of(action: Callable[[], object]) -> LSystemError | None:
    try:
        action()
    except LSystemError as error:
        return error
    return None


@given(st.one_of(spoilt(), st.lists(st.sampled_from(PIECES)).map("".join), st.lists(st.sampled_from(PIECES)).map(" ".join)))
def test_a_text_is_a_system_or_an_explained_slip(text: str) -> None:
    def derived() -> None:
        system = read(text, "cpfg")
        assert read(str(system), "cpfg") == system
        str(derive(system, 3)[-1])

    with limits(modules=500, seconds=2):
        error = error_of(derived)
    assert error is None or isinstance(error, ModelLimitError) or error.line is not None


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        "Axiom: " + "/" * 49_000,
        "Axiom: " + "[" * 49_000,
        "Axiom: A(" + "sqrt(" * 9_000,
        "Axiom: A(" + "!" * 49_000,
        "Axiom: A\nA : {" + "if(1){" * 8_000,
        "Axiom: A\nA : 1 {" + "if(1){" * 4_000 + "}" * 4_000 + "} --> B",
        "Axiom: A(1)\nA(t) : {" + "t=t+t;" * 60 + "} 1 --> A(t)",
        "Axiom: A(1)\nA(t) : {" + "if(t>1){t=t+t;}" * 60 + "} 1 --> A(t)",
        "derivation length: 9^9^9^9\nAxiom: A",
        "#define a 1 /* " * 60_000,
        "a\n" * 400_000,
        "//" * 499_000,
        "#define" + " " * 900_000,
        "A\n" + " B\n" * 300_000,
        "Axiom: A\n" + "".join(f"A(t) : t < {i} --> A(t+1)[+B(t*2)]{'F//F' * 230}\n" for i in range(999)),
    ],
    ids=range(15),
)
def test_no_text_takes_long(text: str) -> None:
    with spent() as taken:
        error_of(lambda: read(text, "cpfg"))
    assert taken.seconds < 2 * 3  # of the processor's time; two on a quick machine
