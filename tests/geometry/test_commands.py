"""The table of commands: what a symbol means in each tradition."""

from __future__ import annotations

from collections import Counter

import pytest
import sympy

from lsys_kit import ModelValueError, derive, read
from lsys_kit.geometry import space, turtle
from lsys_kit.geometry.commands import COMMAND_TABLE, COMMANDS, instructions, unknown_commands
from lsys_kit.geometry.space import in_plane, trace_in_space
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.system import LSystem, Module


def test_a_symbol_means_one_thing_in_a_tradition():
    for column in range(3):
        assert max(Counter(symbol for row in COMMAND_TABLE for symbol in row[column].split()).values()) == 1


def test_each_command_is_one_that_the_turtle_in_space_follows():
    commands = [command for row in COMMAND_TABLE for command in row.commands]
    assert {name for command in commands for name in (command.action, command.bare) if name} <= space.SPACE_ACTS.keys()


def test_each_command_that_stays_in_the_plane_is_one_that_the_turtle_there_follows():
    for tradition, column in COMMANDS.items():
        for symbol, commands in column.items():
            if in_plane(LSystem((Module(symbol, (Number(180),)),), (), turtle=tradition)):
                assert {command.action for command in commands} <= turtle.PLANE_ACTS.keys()


@pytest.mark.parametrize("symbol", ["F", "f", "G", "g", "@M", "+", "-", "&", "^", "\\", "/", "|", "$", "@v", ";", ",", "#", "!",
                                    "'", "[", "]", "{", ".", "}", "~", "@o", "@c", "@O", "%", "?P", "?H", "?U", "?L", "?E",
                                    "@Ts"])
def test_abop_has_the_commands_of_appendix_c_and_of_cpfg(symbol):
    assert symbol in COMMANDS["abop"]


@pytest.mark.parametrize("symbol", ["F", "F+", "F*", "f", "@", "P", "RU", "RL", "RH", "RV", "RG", "$", "+", "-", "[", "]", "/",
                                    "%", *(letter + more for letter in "LDNVCHU" for more in ("", "+", "*", "l", "l+", "l*"))])
def test_grogra_has_the_commands_of_kurths_lectures(symbol):
    assert symbol in COMMANDS["grogra"]


def test_plant_strings_have_those_of_seed_004():
    assert set("IAB[]()LF") <= COMMANDS["plant-string"].keys()


def order(command, tradition="abop"):
    symbol, *values = command
    (found,) = instructions({0: (Module(symbol, tuple(values)),)}, tradition)[0]
    return found.action, found.factor, found.addend


def test_an_argument_is_the_amount_of_a_command():
    assert order(("F", 2)) == ("draw", 0, 2)
    assert order(("-", 30)) == ("turn", 0, -30)
    assert order(("-", -30)) == ("turn", 0, 30)
    assert order(("!", 3)) == ("width", 0, 3)
    assert order((",", 3)) == ("colour", 0, 3)


def test_without_an_argument_it_is_the_turtles_own_step_angle_or_width():
    assert order(("F",)) == ("draw", 1, 0)
    assert order(("-",)) == ("turn", -1, 0)
    assert order(("RV",), "grogra") == ("droop", 1, 0)
    assert order((",",)) == ("colour", 1, -1)


def test_an_argument_of_a_command_with_plus_or_times_changes_it():
    assert order(("L+", 20), "grogra") == ("length", 1, 20)
    assert order(("L*", 0.5), "grogra") == ("length", 0.5, 0)
    assert order(("D",), "grogra") == ("first width", 1, 0)


@pytest.mark.parametrize("value", [1e60, 10**400, sympy.Symbol("t")])
def test_a_value_that_cannot_be_drawn_is_an_error_that_names_the_module(value):
    with pytest.raises(ModelValueError, match=r"^F\(.*cannot be drawn: a value is out of reach, or not known"):
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
