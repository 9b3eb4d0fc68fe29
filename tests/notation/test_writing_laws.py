"""What is written reads back as the same system, or the writer says what the notation lacks: with every symbol that any reader
takes, with numbers of any size, and with texts that were spoilt in a few places."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read, read_expression
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.notation.write import write
from tests.notation.foreign_systems import LOOKS, SYMBOLS, Systems, mutated, record
from tests.notation.test_any_text import MODELS
from tests.plants import plant

RANDOM = st.randoms(use_true_random=False)
TEXTS = [*(("abop", text) for text in MODELS), *((notation, write(plant(notation), notation)) for notation in DIALECTS)]


def reads_back(system: LSystem, notation: str) -> bool:
    """Whether a system is written, and so that it reads back; else the refusal names what is lacking."""
    try:
        text = write(system, notation)
    except ModelValueError as error:
        refusal = error.message
    else:
        refusal = ""
    if refusal:
        assert refusal.startswith(f"The notation {notation} has no ")
        assert refusal.endswith(", which this system needs")
        return False
    assert record(read(text, notation)) == record(DIALECTS[notation].translated(system))
    assert write(read(text, notation)) == text
    return True


@pytest.mark.slow
@pytest.mark.parametrize("notation", DIALECTS)
@given(RANDOM)
def test_a_system_reads_back_or_what_the_notation_lacks_is_named(notation: str, random: Random) -> None:
    reads_back(Systems(random).system(), notation)


@pytest.mark.slow
@given(RANDOM, st.sampled_from(TEXTS), st.sampled_from(TEXTS))
def test_what_a_notation_reads_it_can_write(random: Random, one: tuple[str, str], other: tuple[str, str]) -> None:
    notation, text = one
    try:
        system = read(mutated(random, text, other[1]), notation)
    except LSystemError:
        return
    assert reads_back(system, notation)


@pytest.mark.parametrize("notation", DIALECTS)
@pytest.mark.parametrize("look", [{name: said} for name, words in LOOKS.items() for said in words], ids=str)
def test_how_a_system_looks_is_kept_or_its_loss_is_named(notation: str, look: dict[str, str]) -> None:
    kept = notation != "fractint" or look == {"cells": "rectangles"}
    assert reads_back(replace(plant(notation), **look), notation) == kept  # type: ignore[arg-type]


@pytest.mark.slow
@pytest.mark.parametrize("notation", DIALECTS)
def test_a_symbol_is_written_where_it_can_be_read_and_named_where_it_cannot(notation: str) -> None:
    """As an axiom, beside itself, as predecessor and successor, and among the symbols that contexts pass over."""
    turtle, heading = ("fractint", 0) if notation == "fractint" else (DIALECTS[notation].turtle, 90)
    written = set()
    for symbol in {symbol for symbols in SYMBOLS for symbol in symbols}:
        one, rules = Pattern(symbol), (Production((Pattern("A"),), (Pattern(symbol), Pattern("A"), Pattern(symbol))),)
        heads = (Production((one,), (Pattern("F"),)),)
        for system in (LSystem((one,), rules), LSystem((one, one), heads), LSystem((one,), rules, ignored=(symbol,))):
            angled = LSystem(system.axiom, system.productions, ignored=system.ignored, turtle=turtle, heading=heading, angle=60)
            if reads_back(angled, notation):
                written.add(symbol)
    assert {"A", "F", "X"} <= written


@pytest.mark.parametrize("notation", DIALECTS)
@pytest.mark.parametrize(
    "number",
    [
        "0",
        "4444444444",
        "1e300",
        "0.5",
        "3e-99",
        "7e-400",
        "1e-999",
        "0." + "4" * 299,
        "0." + "7" * 900,
        "1" * 308,
        "1." + "2" * 400 + "e-300",
    ],
)
def test_a_number_of_any_size_reads_back(notation: str, number: str) -> None:
    value = read_expression(number)
    assert isinstance(value, Number)
    reads_back(LSystem((Pattern("F", (value,)),), ()), notation)
    for settings in ({"angle": value.value}, {"length": value.value}, {"steps": 4444444444}):
        reads_back(LSystem((Pattern("F"),), (), **settings), notation)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("number", "text"),
    [("7e-400", "7e-400"), ("1.25e-350", "1.25e-350"), ("3e-9", "0.000000003"), ("0." + "7" * 900, "0." + "7" * 900)],
)
def test_a_long_decimal_has_an_exponent_where_that_is_shorter(number: str, text: str) -> None:
    assert str(read_expression(number)) == text


@pytest.mark.parametrize("number", ["1e-1001", "0.01e-999", "0." + "0" * 400 + "1e-700", "1" * 1001])
def test_a_number_that_could_not_be_written_is_not_read(number: str) -> None:
    with pytest.raises(LSystemError, match="This number is too long"):
        read_expression(number)


@pytest.mark.parametrize(("value", "exact"), [(25.7, Fraction(257, 10)), (2**0.5, Fraction("1.4142135623730951")), (60.0, 60)])
def test_a_setting_is_the_decimal_that_it_is_printed_as(value: float, exact: Fraction) -> None:
    system = LSystem((Pattern("F"),), (), angle=value)
    assert system.angle == exact
    assert read(write(system)) == system
    assert read("angle: sqrt(2)\naxiom: F").angle == Fraction("1.4142135623730951")


@pytest.mark.parametrize(
    ("text", "source", "notation", "lost"),
    [
        ("\\axiom F_A", "grogra", "abop", 'the interpretation without "F_A -> F"'),
        ("\\axiom F,\n{(t) # F(t)", "grogra", "abop", '"{(t) -> F(t)"'),
        ("#define turtle 3\nAxiom: F", "cpfg", "mathematica", 'other meaning of the name "turtle"'),
        ("depth: 2\naxiom: F", "abop", "plant-string", '"depth: 2"'),
    ],
)
def test_what_would_be_read_otherwise_is_quoted(text: str, source: str, notation: str, lost: str) -> None:
    with pytest.raises(ModelValueError) as refused:
        write(read(text, source), notation)
    assert lost in refused.value.message


@pytest.mark.parametrize(
    ("text", "source", "notation"),
    [
        ("Axiom: 0", "cpfg", "plant-string"),
        ("Axiom: A\nA --> AB//grows", "cpfg", "plant-string"),
        ("Axiom: ;", "cpfg", "plant-string"),
        ("axiom: @G . F", "abop", "mathematica"),
        ("axiom: @ G //", "abop", "mathematica"),
        ("axiom: F\nsteps: 4444444444", "abop", "grogra"),
        ("ignore: 3\nalphabet: 3\naxiom: 3", "abop", "abop"),
        ("axiom: @G @ G\nG -> @G", "abop", "abop"),
        ("Lsystem: 1\nAxiom: @Ts\n@Ts --> F@Ts", "cpfg", "cpfg"),
        ("angle: -45\nAxiom: A", "plant-string", "plant-string"),
        ("angle: 1/3\nAxiom: A", "plant-string", "plant-string"),
    ],
)
def test_what_was_once_written_and_refused(text: str, source: str, notation: str) -> None:
    assert reads_back(read(text, source), notation) == (notation != "plant-string" or source == notation)
