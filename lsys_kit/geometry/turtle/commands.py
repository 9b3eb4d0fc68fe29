"""What each symbol tells the turtle, in each dialect of turtle commands, side by side; and what follows from it.

ABOP's commands are those of The Algorithmic Beauty of Plants, appendix C, and of cpfg, which follows it, with a few of L-Py,
which follows both; GROGRA's are those of W. Kurth's lecture slides; those of plant strings are the applet's; Fractint's are
those of its documentation. The dialects agree on most symbols and differ on some: in GROGRA `/` is no roll, and a turn to the
left appears as a turn to the right, because its turtle shows the picture its other side; in plant strings round brackets are
branches; Fractint's turtle has two headings, one that `+` and `-` turn by the angle, and another that `\\` and `/` turn by
degrees. A symbol that is in no column tells the turtle nothing.

The tables stand in `commands.toml`. Whatever depends on the kind of a command follows from that of actions: whether a system
stays in the plane, whether copies of a part may be instanced, and which symbols of a word leave something to be seen.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from enum import Enum, Flag, auto
from fractions import Fraction
from functools import cache, reduce
from operator import or_
from typing import Any, Literal, NamedTuple

from lsys_kit.budget import INTERVAL, counted
from lsys_kit.derivation.core.interpretation import is_filament
from lsys_kit.errors import ModelValueError
from lsys_kit.files import toml_tables
from lsys_kit.geometry.scene import OWN
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS, TurtleDialect


class Effect(Flag):
    """What an action does.

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


_DECLARED = toml_tables(__package__, "commands.toml")
ACTIONS: Mapping[str, Effect] = {
    action: reduce(or_, map(Effect.__getitem__, effects.split()), Effect(0)) for action, effects in _DECLARED["actions"].items()
}


@dataclass(frozen=True)
class Command:
    """One command: an action, and how much of it.

    Most actions concern one quantity of the turtle: a stroke its step, a turn the angle, `D` its width. The amount is
    factor * quantity + addend, unless an argument changes it.

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
    """A row of the table: the symbols of each dialect, separated by blanks, and the commands that they give the turtle.

    There are no commands where the meaning of a symbol does not concern the turtle.
    """

    words: str
    abop: str = ""
    grogra: str = ""
    plant_string: str = ""
    fractint: str = ""
    commands: tuple[Command, ...] = ()

    @property
    def symbols(self) -> Mapping[str, tuple[str, ...]]:
        return {name: tuple(getattr(self, dialect.column).split()) for name, dialect in TURTLE_DIALECTS.items()}


def _command(factor: float | str = 1.0, **declared: Any) -> Command:
    return Command(factor=float(Fraction(factor)), **declared)


COMMAND_TABLE: tuple[Row, ...] = tuple(
    Row(**row | {"commands": tuple(_command(**each) for each in row.get("commands", ()))}) for row in _DECLARED["rows"]
)
COMMANDS: Mapping[str, Mapping[str, tuple[Command, ...]]] = {
    name: {symbol: row.commands for row in COMMAND_TABLE for symbol in row.symbols[name]} for name in TURTLE_DIALECTS
}
"""For each dialect its commands, by symbol."""

FIRST_COLOUR = 14
"""The default colour of strokes in the numbering of GROGRA: yellow."""
RAMP_START, RAMP_END = 16, 23
"""The first and the last number of the colours that run from bark to leaves; those below are told apart by hue."""
BLOSSOM = 13
"""The number of the colour of what lies beyond leaves: stamens and other strokes in flowers."""
LAST_COLOUR = 2**31 - 1
WIDTH = 0.1
"""The width of circles, discs and spheres without an argument, where no width of strokes has been set."""


def initial_step(system: LSystem) -> float:
    return TURTLE_DIALECTS[system.turtle].length if system.length is None else float(system.length)


def initial_colour(system: LSystem) -> int:
    """The initial colour of strokes: that of their symbol; the first of the ramp, if the model steps through colours, and the
    last for veins; yellow, as in GROGRA, in a model for its turtle that chooses colours.

    >>> from lsys_kit import read
    >>> initial_colour(read("axiom: F ' F")), initial_colour(read("axiom: F ;(2) F"))
    (16, -1)
    >>> initial_colour(read("\\\\axiom F P2 F,", "grogra")), initial_colour(read("\\\\axiom F F,", "grogra"))
    (14, -1)
    """
    given = list(commands_of(system))
    if any(command.bare == "step colour" and not module.arguments for command, module in given):
        return RAMP_START
    if is_leaf(system) and not system.colours:
        return RAMP_END
    chosen = system.turtle == "grogra" and any(command.action == "set colour" for command, _ in given)
    return FIRST_COLOUR if chosen and system.colours != "natural" else OWN


STROKES = ("draw", "draw without vertex", "draw by second heading")
"""The actions that leave strokes."""


def is_leaf(system: LSystem) -> bool:
    """Whether all strokes of a system are veins, which are drawn within polygons without being their edges (ABOP, page 122).

    >>> from lsys_kit import read
    >>> is_leaf(read("axiom: {.G[-G.]G[+G.]}")), is_leaf(read("axiom: F{.G[-G.]G[+G.]}")), is_leaf(read("axiom: G[-G]"))
    (True, False, False)
    """
    actions = {command.action for command, _ in commands_of(system)}
    return "begin polygon" in actions and actions.intersection(STROKES) == {"draw without vertex"}


def initial_width(system: LSystem) -> float:
    """The initial width of strokes: that from which commands start that change it, if the model has such; else none.

    >>> from lsys_kit import read
    >>> [initial_width(read(f"axiom: {text}")) for text in ("F ! F", "F !(2) F", "F F")]
    [2.4, -1.0, -1.0]
    """
    changes = any(
        command.action.startswith("set width") and (not module.arguments or command.argument != "all")
        for command, module in commands_of(system)
        if module.arguments or not command.bare
    )
    return TURTLE_DIALECTS[system.turtle].width if changes else float(OWN)


def commands_of(system: LSystem) -> Iterator[tuple[Command, Pattern]]:
    """The commands that the axiom and the rules of a system give, each with the pattern that gives it.

    >>> from lsys_kit import read
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

    >>> compiled = instructions({0: (Module("F", (2,)), Module("-")), 1: (Module("A"),)}, "abop")
    >>> {state: [(each.action, each.factor, each.addend) for each in found] for state, found in compiled.items()}
    {0: [('draw', 0.0, 2.0), ('turn', -1.0, 0.0)], 1: []}
    """
    commands = commands_by_symbol({module.symbol for image in counted(drawn.values()) for module in image}, dialect)
    return {
        state: [instruction_of(command, module, angle) for module in _counted(image) for command in commands[module.symbol]]
        for state, image in counted(drawn.items())
    }


def commands_by_symbol(symbols: Set[str], dialect: str) -> dict[str, tuple[Command, ...]]:
    """The commands that each symbol of a word gives: where a surface may be expected, every symbol may name it."""
    table = COMMANDS[dialect]
    called = _EXPECTED_SURFACE if "~" in symbols & table.keys() else ()
    return {symbol: (*(called if symbol != "~" else ()), *table.get(symbol, ())) for symbol in symbols}


def _counted(image: Sequence[Module]) -> Iterable[Module]:
    """The modules that a state is drawn as, with looks at the budget where they are many."""
    return counted(image) if len(image) > INTERVAL else image


def instruction_of(command: Command, module: Module, angle: Value) -> Instruction:
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
    """The arguments of a module as doubles."""
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

    >>> from lsys_kit import read
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

    >>> from lsys_kit import read
    >>> in_plane(read("axiom: F[+F]/(180)F")), in_plane(read("axiom: F[+F]/(90)F"))
    (True, False)
    """
    leaving, table = symbols_with(Effect.LEAVES_PLANE, system.turtle), COMMANDS[system.turtle]
    perhaps = (module for module in system.modules if module.symbol in leaving)
    return all(_stays_in_plane(command, module) for module in perhaps for command in table[module.symbol])


def _stays_in_plane(command: Command, module: Pattern) -> bool:
    if command.action == "roll" and module.arguments:
        argument = module.arguments[0]
        return isinstance(argument, Number) and argument.value % 180 == 0
    return Effect.LEAVES_PLANE not in command.effects
