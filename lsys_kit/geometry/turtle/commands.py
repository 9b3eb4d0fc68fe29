"""What each symbol tells the turtle, in each dialect of turtle commands, side by side; and what follows from it.

ABOP's commands are those of The Algorithmic Beauty of Plants, appendix C, and of cpfg, which follows it, with a few of L-Py,
which follows both; GROGRA's are those of W. Kurth's lecture slides; those of plant strings are the applet's; Fractint's are
those of its documentation. The dialects agree on most symbols and differ on some: in GROGRA `/` is no roll, and a turn to the
left appears as a turn to the right, because its turtle shows the picture its other side; in plant strings round brackets are
branches; Fractint's turtle has two headings, one that `+` and `-` turn by the angle, and another that `\\` and `/` turn by
degrees. A symbol that is in no column tells the turtle nothing.

Whatever depends on the kind of a command follows from the table of actions: whether a system stays in the plane, whether copies
of a part may be instanced, and which symbols of a word leave something to be seen. An action that is not declared instanceable
is always drawn module by module, which is slower but never wrong.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum, Flag, auto
from functools import cache, partial
from typing import Literal, NamedTuple

from lsys_kit.budget import INTERVAL, counted
from lsys_kit.derivation.core.interpretation import is_filament
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import OWN
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS, TurtleDialect


class Effect(Flag):
    """What an action does.

    Attributes
    ----------
    VISIBLE
        It leaves something to be seen: a stroke, a shape, or the gap of a step forward.
    MOVES
        It changes the position of the turtle.
    TURNS
        It changes the orientation of the turtle.
    LEAVES_PLANE
        It may lead out of the plane of the picture.
    INSTANCEABLE
        What it does depends only on what the turtle carries (its step, width, colour and the like), and is moved and rotated
        with the turtle. So a copy of a part with such actions can be placed anywhere.
    OPENS, CLOSES
        It saves the state of the turtle at the beginning of a branch, or restores it at the end.
    """

    VISIBLE = auto()
    MOVES = auto()
    TURNS = auto()
    LEAVES_PLANE = auto()
    INSTANCEABLE = auto()
    OPENS = auto()
    CLOSES = auto()


_VISIBLE, _MOVES, _TURNS, _LEAVES_PLANE, _INSTANCEABLE, _OPENS, _CLOSES = Effect
_NOTHING = Effect(0)

ACTIONS: Mapping[str, Effect] = {
    "draw": _VISIBLE | _MOVES | _INSTANCEABLE,
    "move": _VISIBLE | _MOVES | _INSTANCEABLE,
    "draw without vertex": _VISIBLE | _MOVES | _INSTANCEABLE,
    "move without vertex": _VISIBLE | _MOVES | _INSTANCEABLE,
    "set position": _MOVES | _LEAVES_PLANE,
    "return to stroke": _MOVES,
    "draw by second heading": _VISIBLE | _MOVES,
    "move by second heading": _VISIBLE | _MOVES,
    "turn": _TURNS | _INSTANCEABLE,
    "turn by mirrored angle": _TURNS | _INSTANCEABLE,
    "turn back": _TURNS | _INSTANCEABLE,
    "mirror turns": _INSTANCEABLE,
    "turn second heading": _INSTANCEABLE,
    "pitch": _TURNS | _LEAVES_PLANE | _INSTANCEABLE,
    "roll": _TURNS | _LEAVES_PLANE | _INSTANCEABLE,
    "level": _TURNS | _LEAVES_PLANE,
    "gravitropism": _TURNS | _LEAVES_PLANE,
    "set tropism": _LEAVES_PLANE,
    "set heading": _TURNS | _LEAVES_PLANE,
    "set length": _INSTANCEABLE,
    "reset length": _INSTANCEABLE,
    "set length once": _INSTANCEABLE,
    "set width": _INSTANCEABLE,
    "reset width": _INSTANCEABLE,
    "set width once": _INSTANCEABLE,
    "set scale": _INSTANCEABLE,
    "set colour": _INSTANCEABLE,
    "step colour": _INSTANCEABLE,
    "reset colour": _INSTANCEABLE,
    "set palette colour": _INSTANCEABLE,
    "set gravitropism": _INSTANCEABLE,
    "reset gravitropism": _INSTANCEABLE,
    "set gravitropism once": _INSTANCEABLE,
    "push": _OPENS | _INSTANCEABLE,
    "pop": _CLOSES | _MOVES | _TURNS | _INSTANCEABLE,
    "begin polygon": _NOTHING,
    "record vertex": _NOTHING,
    "end polygon": _VISIBLE,
    "expect surface": _NOTHING,
    "draw expected surface": _VISIBLE,
    "draw surface": _VISIBLE | _INSTANCEABLE,
    "draw circle": _VISIBLE | _INSTANCEABLE,
    "draw disc": _VISIBLE | _INSTANCEABLE,
    "draw sphere": _VISIBLE | _INSTANCEABLE,
    "draw box": _VISIBLE | _INSTANCEABLE,
    "draw label": _VISIBLE,
    "begin cylinder": _LEAVES_PLANE,
    "continue cylinder": _VISIBLE | _LEAVES_PLANE,
    "end cylinder": _VISIBLE | _LEAVES_PLANE,
    "begin patch": _LEAVES_PLANE,
    "set control point": _LEAVES_PLANE,
    "draw patch": _VISIBLE | _LEAVES_PLANE,
}
"""What each action does."""


@dataclass(frozen=True)
class Command:
    """One command: an action, and how much of it.

    Most actions concern one quantity of the turtle: a stroke its step, a turn the angle, `D` its width. The amount is
    factor * quantity + addend, unless an argument changes it.

    Attributes
    ----------
    action
        What to do, by its name in `ACTIONS`.
    factor, addend
        The amount where there is no argument.
    argument
        What an argument x stands for: the amount itself ("all", with the sign of the factor), what is added to or subtracted
        from the quantity ("more", "less"), or what the quantity is multiplied by: x, 1/x or a root of these ("times",
        "inverse", "root", "inverse root"); "" where arguments are ignored.
    bare
        The action where there is no argument, if that is a different one.
    surface
        The surface that is drawn.
    """

    action: str
    factor: float = 1.0
    addend: float = 0.0
    argument: Literal["all", "more", "less", "times", "inverse", "root", "inverse root", ""] = "all"
    bare: str = ""
    surface: str = ""

    @property
    def effects(self) -> Effect:
        """What the command does, with an argument or without."""
        return ACTIONS[self.action] | ACTIONS[self.bare or self.action]

    @property
    def instanceable(self) -> bool:
        """Whether copies of what the command does can be placed anywhere, with an argument or without."""
        return Effect.INSTANCEABLE in ACTIONS[self.action] & ACTIONS[self.bare or self.action]


class Row(NamedTuple):
    """A row of the table: the symbols of each dialect, separated by blanks, and the commands that they give the turtle."""

    abop: str
    grogra: str
    plant_string: str
    words: str
    command: Command | None = None
    then: Command | None = None
    fractint: str = ""

    @property
    def symbols(self) -> Mapping[str, tuple[str, ...]]:
        return {name: tuple(getattr(self, dialect.column).split()) for name, dialect in TURTLE_DIALECTS.items()}

    @property
    def commands(self) -> tuple[Command, ...]:
        """What the turtle does; empty for a symbol whose meaning does not concern the turtle."""
        return tuple(command for command in (self.command, self.then) if command)


def _settable(quantity: str) -> Command:
    """Set a quantity of the turtle; without an argument, to what it was at first."""
    return Command(f"set {quantity}", bare=f"reset {quantity}")


def _colour_step(addend: int) -> Command:
    """Set the colour; without an argument, to the next one or the one before."""
    return Command("set colour", addend=addend, bare="step colour")


_plain, _more, _times = partial(Command, argument=""), partial(Command, argument="more"), partial(Command, argument="times")
_LEFT, _RIGHT, _ROUND = Command("turn"), Command("turn", -1.0), Command("turn", 0.0, 180, "")
_DOWN, _OPEN = Command("gravitropism", 0.0, math.inf, ""), _plain("push")
_PARTS = 8
"""A curve has so many parts, where no number says otherwise."""
_LEAF, _FLOWER = Command("draw surface", 1 / 2, surface="leaf"), Command("draw surface", 1 / 4, surface="rosette")

COMMAND_TABLE: tuple[Row, ...] = (
    #   ABOP    GROGRA  plants in words; x is the argument                               what to do
    Row("F", "F", "I", "a stroke forward, as long as the step or x", Command("draw"), fractint="F"),
    Row("", "", "A", "a stroke of two thirds of the step", Command("draw", 2 / 3)),
    Row("", "", "B", "a stroke of a third of the step", Command("draw", 1 / 3)),
    Row("", "F+", "", "a stroke that is longer than the step by x", _more("draw")),
    Row("", "F*", "", "a stroke of x times the step", _times("draw")),
    Row("f", "f", "", "forward like `F`, without a stroke", Command("move"), fractint="G"),
    Row("G", "", "", "a stroke like `F` that makes no corner in `{ }`", Command("draw without vertex")),
    Row("g", "", "", "forward, without a stroke and without a corner", Command("move without vertex")),
    Row("@M", "", "", "to the point (x, y, z): z towards the viewer", Command("set position")),
    Row("", "@", "", "on the last stroke: 0 its start, 1 its end", Command("return to stroke")),
    Row("+", "+ RU", "+", "turn to its left, by the angle or x degrees", _LEFT),
    Row("- RU", "-", "-", "turn to its right", _RIGHT),
    Row("|", "", "", "turn round", _ROUND),
    Row("&", "RL", "", "pitch its head down, by the angle or x degrees", Command("pitch")),
    Row("^", "", "", "pitch its head up", Command("pitch", -1.0)),
    Row("\\", "", "", "roll to its left, by the angle or x degrees", Command("roll")),
    Row("/", "RH", "", "roll to its right", Command("roll", -1.0)),
    Row("@R", "", "", "its head points in the direction (x, y, z)", Command("set heading")),
    Row("$ @v", "$", "", "roll until its left is level and its up points up", _plain("level")),
    Row("", "RV", "", "bend down, with the strength x or that of `V`", Command("gravitropism")),
    Row("", "RG", "", "bend straight down", _DOWN),
    Row("@Ts", "", "", "bend towards gravity after each stroke, elasticity x", Command("set tropism")),
    Row("", "L", "", "the step is x, or what it was at first", _settable("length")),
    Row("", "L+", "", "the step is longer by x", _more("set length")),
    Row("", "L*", "", "the step is x times as long", _times("set length")),
    Row("", "Ll", "", "the step is x up to the next stroke", Command("set length once")),
    Row("", "Ll+", "", "the step is longer by x up to the next stroke", _more("set length once")),
    Row("", "Ll*", "", "the step is x times as long up to the next stroke", _times("set length once")),
    Row("#", "", "", "strokes are x wide, or 10/7 times as wide", Command("set width", 10 / 7)),
    Row("!", "", "", "strokes are x wide, or 7/10 times as wide", Command("set width", 7 / 10)),
    Row("", "D", "", "strokes are x wide, or as wide as at first", _settable("width")),
    Row("", "D+", "", "strokes are wider by x", _more("set width")),
    Row("", "D*", "", "strokes are x times as wide", _times("set width")),
    Row("", "Dl", "", "the next stroke is x wide", Command("set width once")),
    Row("", "Dl+", "", "the next stroke is wider by x", _more("set width once")),
    Row("", "Dl*", "", "the next stroke is x times as wide", _times("set width once")),
    Row("@D", "", "", "the scale of all that is drawn is x, or 1", Command("set scale", 0.0, 1.0)),
    Row("@Di", "", "", "the scale is x times as great", _times("set scale")),
    Row("@Dd", "", "", "the scale is 1/x times as great", Command("set scale", argument="inverse")),
    Row("; '", "", "", "colour x, or the next one", _colour_step(1)),
    Row(",", "", "", "colour x, or the one before", _colour_step(-1)),
    Row("", "P", "", "colour x, or that at first", _settable("colour")),
    Row("", "V", "", "the strength of `RV` is x, or 0 as at first", _settable("gravitropism")),
    Row("", "V+", "", "the strength of `RV` is greater by x", _more("set gravitropism")),
    Row("", "V*", "", "the strength of `RV` is x times as great", _times("set gravitropism")),
    Row("", "Vl", "", "the strength of `RV` is x up to the next stroke", Command("set gravitropism once")),
    Row("", "Vl+", "", "the same, greater by x", _more("set gravitropism once")),
    Row("", "Vl*", "", "the same, x times as great", _times("set gravitropism once")),
    Row("[", "[", "", "a branch begins: the turtle remembers how it is", _OPEN, fractint="["),
    Row("", "", "[", "a branch begins, to the left", _OPEN, _LEFT),
    Row("", "", "(", "a branch begins, to the right", _OPEN, _RIGHT),
    Row("]", "]", "] )", "the branch ends: the turtle is as it was", _plain("pop"), fractint="]"),
    Row("{", "", "", "a polygon begins: `F` and `f` end in its corners", _plain("begin polygon")),
    Row(".", "", "", "a corner of the polygon", _plain("record vertex")),
    Row("}", "", "", "the polygon ends", _plain("end polygon")),
    Row("~", "", "", "a surface: the next symbol, as long as the step or x", _plain("expect surface")),
    Row("", "", "L", "a leaf", _LEAF),
    Row("", "", "F", "a flower", _FLOWER),
    Row("@Gs", "", "", "a generalised cylinder begins: `F` leaves no stroke", _plain("begin cylinder")),
    Row("@Gc", "", "", "the cylinder comes here in a curve of x parts", Command("continue cylinder", 0.0, _PARTS)),
    Row("@Ge", "", "", "the same, and the cylinder ends", Command("end cylinder", 0.0, _PARTS)),
    Row("@PS", "", "", "a patch with the number x begins", Command("begin patch")),
    Row("@PC", "", "", "here is a control point of patch x, in row y and column z", Command("set control point")),
    Row("@PD", "", "", "the patch x is drawn, in y rows and z columns", Command("draw patch")),
    Row("@o", "", "", "a circle, as wide as a stroke or x", Command("draw circle")),
    Row("@c", "", "", "a disc, as wide as a stroke or x", Command("draw disc")),
    Row("@O", "", "", "a sphere, as wide as a stroke or x", Command("draw sphere")),
    Row("@L", "", "", "a label: x, or several numbers", Command("draw label")),
    Row("@B", "", "", "a box ahead, as long as the step or x, as wide and deep as a stroke or y", Command("draw box")),
    Row("", "", "", "a stroke by its second heading, as long as the step", _plain("draw by second heading"), fractint="D"),
    Row("", "", "", "forward like `D`, without a stroke", _plain("move by second heading"), fractint="M"),
    Row("", "", "", "turn to its left, by the angle", _plain("turn by mirrored angle"), fractint="+"),
    Row("", "", "", "turn to its right, by the angle", _plain("turn by mirrored angle", -1.0), fractint="-"),
    Row("", "", "", "turn round, or to its right by as many angles as fit into half a turn", _plain("turn back"), fractint="|"),
    Row("", "", "", "turn its second heading to the left, by x degrees", Command("turn second heading"), fractint="\\"),
    Row("", "", "", "turn its second heading to the right, by x degrees", Command("turn second heading", -1.0), fractint="/"),
    Row("", "", "", "left and right change places in these turns", _plain("mirror turns"), fractint="!"),
    Row("", "", "", "the step is x times as long", _times("set length", 0.0), fractint="@"),
    Row("", "", "", "the step is 1/x times as long", Command("set length", 0.0, argument="inverse"), fractint="@I"),
    Row("", "", "", "the step is √x times as long", Command("set length", 0.0, argument="root"), fractint="@Q"),
    Row("", "", "", "the step is 1/√x times as long", Command("set length", 0.0, argument="inverse root"), fractint="@IQ @QI"),
    Row("", "", "", "colour x", Command("set palette colour", 0.0), fractint="C"),
    Row("", "", "", "the colour that is x places further", _more("set palette colour"), fractint="<"),
    Row("", "", "", "the colour that is x places before", Command("set palette colour", argument="less"), fractint=">"),
    Row("%", "%", "", "the rest of the branch is cut off in the next step"),
    Row("?P ?H ?U ?L ?E", "", "", "a question to the surroundings"),
    Row("", "/", "", "a finer scale"),
    Row("", "*", "", "the start word"),
    Row("", "N N+ N* Nl Nl+ Nl*", "", "leaves: not seen"),
    Row("", "C C+ C* Cl Cl+ Cl*", "", "carbon: not seen"),
    Row("", "H H+ H* Hl Hl+ Hl*", "", "heartwood: not seen"),
    Row("", "U U+ U* Ul Ul+ Ul*", "", "internodes: not seen"),
)

COMMANDS: Mapping[str, Mapping[str, tuple[Command, ...]]] = {
    name: {symbol: row.commands for row in COMMAND_TABLE for symbol in row.symbols[name]} for name in TURTLE_DIALECTS
}
"""For each dialect its commands, by symbol."""

FIRST_COLOUR = 14
"""The default colour of strokes in the numbering of GROGRA: yellow."""
RAMP_START, RAMP_END = 16, 23
"""The first and the last number of the colours that run from bark to leaves; those below are told apart by hue."""
WIDTH = 0.1
"""The width of circles, discs and spheres without an argument, where no width of strokes has been set."""


def initial_step(system: LSystem) -> float:
    return TURTLE_DIALECTS[system.turtle].length if system.length is None else float(system.length)


def initial_colour(system: LSystem) -> int:
    """The initial colour of strokes: that of their symbol; the first of the ramp, if the model steps through colours; yellow,
    as in GROGRA, in a model for its turtle that chooses colours.

    >>> from lsys_kit.notation.read import read
    >>> initial_colour(read("axiom: F ' F")), initial_colour(read("axiom: F ;(2) F"))
    (16, -1)
    >>> initial_colour(read("\\\\axiom F P2 F,", "grogra")), initial_colour(read("\\\\axiom F F,", "grogra"))
    (14, -1)
    """
    given = list(commands_of(system))
    if any(command.bare == "step colour" and not module.arguments for command, module in given):
        return RAMP_START
    chosen = system.turtle == "grogra" and any(command.action == "set colour" for command, _ in given)
    return FIRST_COLOUR if chosen and system.colours != "natural" else OWN


def commands_of(system: LSystem) -> Iterator[tuple[Command, Pattern]]:
    """The commands that the axiom and the rules of a system give, each with the pattern that gives it.

    >>> from lsys_kit.notation.read import read
    >>> [command.action for command, _ in commands_of(read("axiom: F + A\\nA -> f A"))]
    ['draw', 'turn', 'move']
    """
    table = COMMANDS[system.turtle]
    return ((command, module) for module in system.modules for command in table.get(module.symbol, ()))


@cache
def symbols_with(effect: Effect, turtle: str) -> frozenset[str]:
    """The symbols of a dialect whose commands have an effect.

    >>> sorted(symbols_with(Effect.OPENS, "plant-string"))
    ['(', '[']
    """
    return frozenset(
        symbol for symbol, commands in COMMANDS[turtle].items() if any(effect in command.effects for command in commands)
    )


LARGEST = 1e50
"""The turtle draws no greater number than this."""


class Instruction(NamedTuple):
    """A command with its numbers: the amount is factor * quantity + addend.

    Attributes
    ----------
    action, factor, addend
        As of `Command`, with the argument taken in.
    values
        All arguments.
    symbol, surface
        The symbol of the command, and the surface that is drawn.
    """

    action: str
    factor: float
    addend: float
    values: tuple[float, ...] = ()
    symbol: str = ""
    surface: str = ""


_EXPECTED_SURFACE = (Command("draw expected surface"),)
"""Draw the surface named by the symbol, if a tilde stands before it."""


def instructions(drawn: Mapping[int, Sequence[Module]], dialect: str, angle: Value = 90) -> dict[int, list[Instruction]]:
    """The instructions for each state, given the modules that it is drawn as, and the angle of the system.

    Raises
    ------
    ModelValueError
        An argument is too large to draw, or symbolic.

    Examples
    --------
    >>> compiled = instructions({0: (Module("F", (2,)), Module("-")), 1: (Module("A"),)}, "abop")
    >>> {state: [(each.action, each.factor, each.addend) for each in found] for state, found in compiled.items()}
    {0: [('draw', 0.0, 2.0), ('turn', -1.0, 0.0)], 1: []}
    """
    table, symbols = COMMANDS[dialect], {module.symbol for image in counted(drawn.values()) for module in image}
    called = _EXPECTED_SURFACE if "~" in symbols & table.keys() else ()
    commands = {symbol: (*(called if symbol != "~" else ()), *table.get(symbol, ())) for symbol in symbols}
    return {
        state: [_instruction(command, module, angle) for module in _counted(image) for command in commands[module.symbol]]
        for state, image in counted(drawn.items())
    }


def _counted(image: Sequence[Module]) -> Iterable[Module]:
    """The modules that a state is drawn as, with looks at the budget where they are many."""
    return counted(image) if len(image) > INTERVAL else image


def _instruction(command: Command, module: Module, angle: Value) -> Instruction:
    values = values_of(module) if command.argument else ()
    action, factor, addend = command.action, command.factor, command.addend
    if action == "turn back":
        factor, addend = _turn_back(angle)
    elif not values:
        action = command.bare or action
    elif command.argument == "all":
        factor, addend = 0.0, math.copysign(1.0, factor) * values[0]
    elif command.argument in ("more", "less"):
        factor, addend = 1.0, values[0] if command.argument == "more" else -values[0]
    else:
        factor, addend = _multiple(command.argument, values[0]), 0.0
    return Instruction(action, factor, addend, values, module.symbol, command.surface)


def _turn_back(angle: Value) -> tuple[float, float]:
    """How Fractint turns round, as a factor of the angle and further degrees: by 180 degrees if the angle divides them, else to
    the right by the greatest multiple of the angle that is less.

    >>> _turn_back(60), _turn_back(72)
    ((0.0, 180.0), (-2.0, 0.0))
    """
    turns = 180 / angle if angle else 0
    return (0.0, 180.0) if turns == math.floor(turns) else (-float(math.floor(turns)), 0.0)


def _multiple(argument: str, value: float) -> float:
    """By what a quantity is multiplied, given what the argument stands for; roots and inverses of what is not positive are 0.

    >>> _multiple("times", 3), _multiple("inverse", 4), _multiple("root", 4), _multiple("inverse root", 4)
    (3, 0.25, 2.0, 0.5)
    """
    if argument == "times":
        return value
    root = math.sqrt(max(value, 0.0)) if argument.endswith("root") else max(value, 0.0)
    return 1 / root if argument.startswith("inverse") and root else root


def values_of(module: Module) -> tuple[float, ...]:
    """The arguments of a module as doubles.

    Raises
    ------
    ModelValueError
        An argument is too large to draw, or symbolic.
    """
    if not module.arguments:
        return ()
    try:
        values = tuple(map(float, module.arguments))
    except (TypeError, OverflowError):
        values = (math.nan,)
    for value in values:
        if not -LARGEST <= value <= LARGEST:
            raise ModelValueError(f"{module} cannot be drawn: a value is too large to draw, or symbolic")
    return values


def unknown_commands(drawn: Mapping[int, Sequence[Module]], system: LSystem) -> tuple[str, ...]:
    """The symbols without a meaning that look like commands: signs, and commands of another dialect.

    Letters without a meaning are normal, and so are symbols that productions rewrite: they are apices, buds and signals.

    >>> unknown_commands({0: [Module(symbol) for symbol in ("F", "#", "A", "RH", "=")]}, LSystem((), ()))
    ('RH', '=')
    """
    known = {module.symbol for rule in (*system.productions, *system.decomposition) for module in rule.predecessors}
    known |= COMMANDS[system.turtle].keys()
    met = dict.fromkeys(module.symbol for image in counted(drawn.values()) for module in image)
    return tuple(
        symbol for symbol in met if symbol not in known and _looks_like_a_command(symbol, TURTLE_DIALECTS[system.turtle])
    )


def _looks_like_a_command(symbol: str, dialect: TurtleDialect) -> bool:
    sign = not (dialect.any_sign or symbol[0].isalnum() or symbol[0] == "_")
    return sign or (len(symbol) > 1 and any(symbol in column for column in COMMANDS.values()))


class DrawingMode(Enum):
    """How the words of a system are drawn.

    Attributes
    ----------
    FILAMENT
        As cells in a row; the words of a derivation form a developmental sequence.
    PLANE
        By a turtle that stays in the plane of the picture.
    SPACE
        By a turtle in space, whose drawing can be seen from any side.
    """

    FILAMENT = auto()
    PLANE = auto()
    SPACE = auto()


def drawing_mode(system: LSystem) -> DrawingMode:
    """How the words of a system are drawn.

    >>> from lsys_kit.notation.read import read
    >>> drawing_mode(read("axiom: a\\ninterpretation:\\na -> R(2,1)")).name
    'FILAMENT'
    >>> drawing_mode(read("axiom: F[+F]F")).name, drawing_mode(read("axiom: F[&F]F")).name
    ('PLANE', 'SPACE')
    """
    if is_filament(system):
        return DrawingMode.FILAMENT
    return DrawingMode.PLANE if in_plane(system) else DrawingMode.SPACE


def in_plane(system: LSystem) -> bool:
    """Whether the turtle stays in the plane of the picture, however long a system develops.

    A roll by half a turn stays there: left and right change places.

    >>> from lsys_kit.notation.read import read
    >>> in_plane(read("axiom: F[+F]/(180)F")), in_plane(read("axiom: F[+F]/(90)F"))
    (True, False)
    """
    return all(_stays_in_plane(command, module) for command, module in commands_of(system))


def _stays_in_plane(command: Command, module: Pattern) -> bool:
    if command.action == "roll" and module.arguments:
        argument = module.arguments[0]
        return isinstance(argument, Number) and argument.value % 180 == 0
    return Effect.LEAVES_PLANE not in command.effects
