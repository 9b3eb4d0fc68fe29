"""What each symbol tells the turtle, in the traditions of the seeds, side by side.

ABOP's are those of The Algorithmic Beauty of Plants, appendix C, and of cpfg, which follows it; GROGRA's those of seed 003;
plant strings are those of seed 004. The traditions agree on most symbols and differ on some: in GROGRA `/` is no roll, and a
turn to the left is a turn to the right in the picture, because there the turtle shows its other side; in plant strings round
brackets are branches. A symbol that is in no column tells the turtle nothing.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.system import LSystem, Module


@dataclass(frozen=True)
class Command:
    """One command: something to do, and how much of it.

    Most commands are about one quantity of the turtle: strokes about its step, turns about the angle, `D` about its width.
    The amount is then factor * quantity + addend; an argument changes that.

    Attributes
    ----------
    action
        What to do: a name that the turtles know.
    factor, addend
        The amount where there is no argument.
    argument
        What an argument x is: the amount itself ("all", with the sign of the factor), how much more than the quantity
        ("more"), how many times the quantity ("times"); where it is "", arguments are passed over.
    bare
        The action where there is no argument, if that is another one.
    surface
        Which surface is drawn.
    """

    action: str
    factor: float = 1.0
    addend: float = 0.0
    argument: Literal["all", "more", "times", ""] = "all"
    bare: str = ""
    surface: str = ""


class Row(NamedTuple):
    """A line of the table: symbols of each tradition, parted by blanks, and what they tell the turtle: a command, or two."""

    abop: str
    grogra: str
    plant_string: str
    words: str
    command: Command | None = None
    then: Command | None = None

    @property
    def commands(self) -> tuple[Command, ...]:
        """What the turtle does; nothing where a symbol has a meaning, but not for the turtle."""
        return tuple(command for command in (self.command, self.then) if command)


_LEFT, _RIGHT, _ROUND = Command("turn"), Command("turn", -1.0), Command("turn", 0.0, 180, "")
_DOWN, _OPEN = Command("droop", 0.0, math.inf, ""), Command("open", argument="")
_LEAF, _FLOWER = Command("surface", 1 / 2, surface="leaf"), Command("surface", 1 / 4, surface="rosette")

COMMAND_TABLE: tuple[Row, ...] = (
    #   ABOP    GROGRA  plants in words; x is the argument                               what to do
    Row("F",    "F",    "I",   "a stroke forward, as long as the step or x",           Command("draw")),
    Row("",     "",     "A",   "a stroke of two thirds of the step",                   Command("draw", 2 / 3)),
    Row("",     "",     "B",   "a stroke of a third of the step",                      Command("draw", 1 / 3)),
    Row("",     "F+",   "",    "a stroke that is longer than the step by x",           Command("draw", argument="more")),
    Row("",     "F*",   "",    "a stroke of x times the step",                         Command("draw", argument="times")),
    Row("f",    "f",    "",    "forward like `F`, without a stroke",                   Command("move")),
    Row("G",    "",     "",    "a stroke like `F` that makes no corner in `{ }`",      Command("draw past")),
    Row("g",    "",     "",    "forward, without a stroke and without a corner",       Command("move past")),
    Row("@M",   "",     "",    "to the point (x, y, z): z towards the viewer",         Command("jump")),
    Row("",     "@",    "",    "on the last stroke: 0 its start, 1 its end",           Command("back")),

    Row("+",    "+ RU", "+",   "turn to its left, by the angle or x degrees",          _LEFT),
    Row("- RU", "-",    "-",   "turn to its right",                                    _RIGHT),
    Row("|",    "",     "",    "turn round",                                           _ROUND),
    Row("&",    "RL",   "",    "pitch its head down, by the angle or x degrees",       Command("pitch")),
    Row("^",    "",     "",    "pitch its head up",                                    Command("pitch", -1.0)),
    Row("\\",   "",     "",    "roll to its left, by the angle or x degrees",          Command("roll")),
    Row("/",    "RH",   "",    "roll to its right",                                    Command("roll", -1.0)),
    Row("$ @v", "$",    "",    "roll until its left is level and its up points up",    Command("level", argument="")),
    Row("",     "RV",   "",    "bend down, with the strength x or that of `V`",        Command("droop")),
    Row("",     "RG",   "",    "bend straight down",                                   _DOWN),
    Row("@Ts",  "",     "",    "bend towards gravity after each stroke, elasticity x", Command("tropism")),

    Row("",     "L",    "",    "the step is x, or what it was at first",               Command("length", bare="first length")),
    Row("",     "L+",   "",    "the step is longer by x",                              Command("length", argument="more")),
    Row("",     "L*",   "",    "the step is x times as long",                          Command("length", argument="times")),
    Row("",     "Ll",   "",    "the step is x up to the next stroke",                  Command("next length")),
    Row("",     "Ll+",  "",    "the step is longer by x up to the next stroke",        Command("next length", argument="more")),
    Row("", "Ll*", "", "the step is x times as long up to the next stroke", Command("next length", argument="times")),
    Row("#",    "",     "",    "strokes are x wide, or 10/7 times as wide",            Command("width", 10 / 7)),
    Row("!",    "",     "",    "strokes are x wide, or 7/10 times as wide",            Command("width", 7 / 10)),
    Row("",     "D",    "",    "strokes are x wide, or as wide as at first",           Command("width", bare="first width")),
    Row("",     "D+",   "",    "strokes are wider by x",                               Command("width", argument="more")),
    Row("",     "D*",   "",    "strokes are x times as wide",                          Command("width", argument="times")),
    Row("",     "Dl",   "",    "the next stroke is x wide",                            Command("next width")),
    Row("",     "Dl+",  "",    "the next stroke is wider by x",                        Command("next width", argument="more")),
    Row("",     "Dl*",  "",    "the next stroke is x times as wide",                   Command("next width", argument="times")),
    Row("; '",  "",     "",    "colour x, or the next one",                            Command("colour", addend=1)),
    Row(",",    "",     "",    "colour x, or the one before",                          Command("colour", addend=-1)),
    Row("",     "P",    "",    "colour x, or that at first",                           Command("colour", bare="first colour")),
    Row("",     "V",    "",    "the strength of `RV` is x, or 0 as at first",          Command("sag", bare="first sag")),
    Row("",     "V+",   "",    "the strength of `RV` is greater by x",                 Command("sag", argument="more")),
    Row("",     "V*",   "",    "the strength of `RV` is x times as great",             Command("sag", argument="times")),
    Row("",     "Vl",   "",    "the strength of `RV` is x up to the next stroke",      Command("next sag")),
    Row("",     "Vl+",  "",    "the same, greater by x",                               Command("next sag", argument="more")),
    Row("",     "Vl*",  "",    "the same, x times as great",                           Command("next sag", argument="times")),

    Row("[",    "[",    "",    "a branch begins: the turtle remembers how it is",      _OPEN),
    Row("",     "",     "[",   "a branch begins, to the left",                         _OPEN, _LEFT),
    Row("",     "",     "(",   "a branch begins, to the right",                        _OPEN, _RIGHT),
    Row("]",    "]",    "] )", "the branch ends: the turtle is as it was",             Command("close", argument="")),

    Row("{",    "",     "",    "a polygon begins: `F` and `f` end in its corners",     Command("outline", argument="")),
    Row(".",    "",     "",    "a corner of the polygon",                              Command("corner", argument="")),
    Row("}",    "",     "",    "the polygon ends",                                     Command("fill", argument="")),
    Row("~",    "",     "",    "a surface: the next symbol, as long as the step or x", Command("announce", argument="")),
    Row("",     "",     "L",   "a leaf",                                               _LEAF),
    Row("",     "",     "F",   "a flower",                                             _FLOWER),
    Row("@o",   "",     "",    "a circle, as wide as a stroke or x",                   Command("circle")),
    Row("@c",   "",     "",    "a disc, as wide as a stroke or x",                     Command("disc")),
    Row("@O",   "",     "",    "a sphere, as wide as a stroke or x",                   Command("sphere")),

    Row("%",    "%",    "",    "the rest of the branch is cut off in the next step"),
    Row("?P ?H ?U ?L ?E", "", "", "a question to the surroundings"),
    Row("",     "/",    "",    "a finer scale"),
    Row("",     "*",    "",    "the start word"),
    Row("", "N N+ N* Nl Nl+ Nl*", "", "leaves: not seen"),
    Row("", "C C+ C* Cl Cl+ Cl*", "", "carbon: not seen"),
    Row("", "H H+ H* Hl Hl+ Hl*", "", "heartwood: not seen"),
    Row("", "U U+ U* Ul Ul+ Ul*", "", "internodes: not seen"),
)

COMMANDS: Mapping[str, Mapping[str, tuple[Command, ...]]] = {
    tradition: {symbol: row.commands for row in COMMAND_TABLE for symbol in row[:3][column].split()}
    for column, tradition in enumerate(("abop", "grogra", "plant-string"))}
"""For each tradition its commands, by symbol."""

LEFT_SIDE: Mapping[str, int] = {"abop": 1, "grogra": -1, "plant-string": 1}
"""Where the turtle's left is in the picture when it starts: 1 to the left of its way, -1 to the right."""

STEP: Mapping[str, float] = {"abop": 1.0, "grogra": 100.0, "plant-string": 1.0}
"""How long a step is, where the system does not say."""
FIRST_COLOUR = 14
"""The colour of strokes where none was set, as GROGRA numbers it: yellow."""
WIDTH = 0.1
"""How wide a stroke is, where a command asks for the width and none was set."""
REACH = 1e50
"""Numbers beyond this are not drawn."""


def initial_step(system: LSystem) -> float:
    """How long a step is at first."""
    return STEP[system.turtle] if system.length is None else float(system.length)


class Instruction(NamedTuple):
    """A command with its numbers: the amount is factor * quantity + addend.

    Attributes
    ----------
    action, factor, addend
        As of `Command`, with the argument taken in.
    values
        All arguments.
    symbol, surface
        The symbol that gave the order, and which surface it draws.
    """

    action: str
    factor: float
    addend: float
    values: tuple[float, ...] = ()
    symbol: str = ""
    surface: str = ""


_CALLED = (Command("called"),)
"""Draw the surface of the symbol's name, if a tilde stands before it."""


def instructions(drawn: Mapping[int, Sequence[Module]], tradition: str) -> dict[int, list[Instruction]]:
    """What the modules tell the turtle that each state is drawn as.

    Raises
    ------
    ModelValueError
        An argument is no number that can be drawn.

    Examples
    --------
    >>> told = instructions({0: (Module("F", (2,)), Module("-")), 1: (Module("A"),)}, "abop")
    >>> {state: [(order.action, order.factor, order.addend) for order in found] for state, found in told.items()}
    {0: [('draw', 0.0, 2.0), ('turn', -1.0, 0.0)], 1: []}
    """
    table, symbols = COMMANDS[tradition], {module.symbol for image in drawn.values() for module in image}
    called = _CALLED if "~" in symbols & table.keys() else ()
    commands = {symbol: (*(called if symbol != "~" else ()), *table.get(symbol, ())) for symbol in symbols}
    return {state: [_order(command, module) for module in image for command in commands[module.symbol]]
            for state, image in drawn.items()}


def _order(command: Command, module: Module) -> Instruction:
    """A command with a module's argument."""
    values = values_of(module) if command.argument else ()
    action, factor, addend = command.action, command.factor, command.addend
    if not values:
        action = command.bare or action
    elif command.argument == "all":
        factor, addend = 0.0, math.copysign(1.0, factor) * values[0]
    elif command.argument == "more":
        factor, addend = 1.0, values[0]
    else:
        factor, addend = values[0], 0.0
    return Instruction(action, factor, addend, values, module.symbol, command.surface)


def values_of(module: Module) -> tuple[float, ...]:
    """A module's arguments as doubles.

    Raises
    ------
    ModelValueError
        An argument is no number that can be drawn.
    """
    if not module.arguments:
        return ()
    try:
        values = tuple(map(float, module.arguments))  # type: ignore[arg-type]
    except (TypeError, OverflowError):
        values = (math.nan,)
    for value in values:
        if not -REACH <= value <= REACH:
            raise ModelValueError(f"{module} cannot be drawn: a value is out of reach, or not known")
    return values


def unknown_commands(drawn: Mapping[int, Sequence[Module]], system: LSystem) -> tuple[str, ...]:
    """The symbols without a meaning that look like commands: signs, and commands of another tradition.

    Letters without a meaning are normal, and so are symbols that productions rewrite: they are apices, buds and signals.

    >>> unknown_commands({0: [Module(symbol) for symbol in ("F", "#", "A", "RH", "=")]}, LSystem((), ()))
    ('RH', '=')
    """
    own = {production.predecessor.symbol for production in (*system.productions, *system.decomposition)}
    met = dict.fromkeys(module.symbol for image in drawn.values() for module in image)
    return tuple(symbol for symbol in met
                 if symbol not in COMMANDS[system.turtle] and symbol not in own and _looks_like_a_command(symbol))


def _looks_like_a_command(symbol: str) -> bool:
    sign = not (symbol[0].isalnum() or symbol[0] == "_")
    return sign or (len(symbol) > 1 and any(symbol in column for column in COMMANDS.values()))
