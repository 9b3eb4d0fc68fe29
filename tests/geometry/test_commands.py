"""The table of commands: what a symbol means in each tradition."""

from __future__ import annotations

from collections import Counter

import pytest
import sympy

from lsys_kit import ModelValueError, derive, read, write
from lsys_kit.geometry.turtle.commands import COMMAND_TABLE, COMMANDS, instructions, unknown_commands
from lsys_kit.geometry.turtle.space import trace_in_space
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS


def test_a_symbol_means_one_thing_in_a_dialect():
    for dialect in TURTLE_DIALECTS.values():
        symbols = Counter(symbol for row in COMMAND_TABLE for symbol in getattr(row, dialect.column).split())
        assert max(symbols.values()) == 1


@pytest.mark.parametrize(
    "symbol",
    [
        "F",
        "f",
        "G",
        "g",
        "@M",
        "+",
        "-",
        "&",
        "^",
        "\\",
        "/",
        "|",
        "$",
        "@v",
        ";",
        ",",
        "#",
        "!",
        "'",
        "[",
        "]",
        "{",
        ".",
        "}",
        "~",
        "@o",
        "@c",
        "@O",
        "%",
        "?P",
        "?H",
        "?U",
        "?L",
        "?E",
        "@Ts",
        "@R",
        "@Gs",
        "@Gc",
        "@Ge",
        "@PS",
        "@PC",
        "@PD",
        "@D",
        "@Di",
        "@B",
        "@L",
    ],
)
def test_abop_has_the_commands_of_appendix_c_and_of_cpfg(symbol):
    assert symbol in COMMANDS["abop"]


@pytest.mark.parametrize(
    "symbol",
    [
        "F",
        "F+",
        "F*",
        "f",
        "@",
        "P",
        "RU",
        "RL",
        "RH",
        "RV",
        "RG",
        "$",
        "+",
        "-",
        "[",
        "]",
        "/",
        "%",
        *(letter + more for letter in "LDNVCHU" for more in ("", "+", "*", "l", "l+", "l*")),
    ],
)
def test_grogra_has_the_commands_of_kurths_lectures(symbol):
    assert symbol in COMMANDS["grogra"]


@pytest.mark.parametrize("notation", ["abop", "grogra", "mathematica", "plant-string"])
@pytest.mark.parametrize("turtle", TURTLE_DIALECTS)
def test_a_text_can_choose_every_dialect_of_turtle_commands(notation, turtle):
    system = LSystem((Pattern("F"),), (), turtle=turtle)
    assert read(write(system, notation), notation).turtle == turtle


def test_plant_strings_have_those_of_seed_004():
    assert set("IAB[]()LF") <= COMMANDS["plant-string"].keys()


def test_fractint_has_those_of_its_documentation():
    assert COMMANDS["fractint"].keys() == {*"FGDM+-|\\/!C<>[]@", "@I", "@Q", "@IQ", "@QI"}


def order(command, tradition="abop"):
    symbol, *values = command
    (found,) = instructions({0: (Module(symbol, tuple(values)),)}, tradition)[0]
    return found.action, found.factor, found.addend


def test_an_argument_is_the_amount_of_a_command():
    assert order(("F", 2)) == ("draw", 0, 2)
    assert order(("-", 30)) == ("turn", 0, -30)
    assert order(("-", -30)) == ("turn", 0, 30)
    assert order(("!", 3)) == ("set width", 0, 3)
    assert order((",", 3)) == ("set colour", 0, 3)


def test_without_an_argument_it_is_the_turtles_own_step_angle_or_width():
    assert order(("F",)) == ("draw", 1, 0)
    assert order(("-",)) == ("turn", -1, 0)
    assert order(("RV",), "grogra") == ("gravitropism", 1, 0)
    assert order((",",)) == ("step colour", 1, -1)


def test_an_argument_of_a_command_with_plus_or_times_changes_it():
    assert order(("L+", 20), "grogra") == ("set length", 1, 20)
    assert order(("L*", 0.5), "grogra") == ("set length", 0.5, 0)
    assert order(("D",), "grogra") == ("reset width", 1, 0)


@pytest.mark.parametrize("value", [1e60, 10**400, sympy.Symbol("t")])
def test_a_value_that_cannot_be_drawn_is_an_error_that_names_the_module(value):
    with pytest.raises(ModelValueError, match=r"^F\(.*cannot be drawn: a value is too large to draw, or symbolic"):
        instructions({0: (Module("F", (value,)),)}, "abop")


def test_what_looks_like_a_command_and_is_none_is_listed_once():
    drawn = {0: [Module(symbol) for symbol in ("F", "A", "&", "k", "@o", "&")], 1: [Module("&"), Module("=")]}
    assert unknown_commands(drawn, LSystem((), (), turtle="grogra")) == ("&", "@o", "=")
    assert trace_in_space(derive(read("turtle: grogra\naxiom: F & F & A"), 0)[0]).unknown == ("&",)


def test_commands_of_another_tradition_are_listed_but_not_single_letters():
    drawn = {0: [Module(symbol) for symbol in ("RH", "L", "L*", "I", "D", "P", "bud", "RU")]}
    assert unknown_commands(drawn, LSystem((), ())) == ("RH", "L*")


def test_a_symbol_that_productions_rewrite_is_not_listed():
    assert trace_in_space(derive(read("axiom: # RH @\n@ -> RH\nRH -> @"), 1)[-1]).unknown == ()
