"""What a word tells the turtle: the commands of its modules, with their arguments taken in."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from lsys_kit.budget import INTERVAL, counted
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.turtle.commands.table import COMMANDS, Command
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS, TurtleDialect

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
    """A command with the arguments of a module taken in."""
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
