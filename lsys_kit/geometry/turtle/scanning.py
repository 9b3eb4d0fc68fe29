"""The turtle in columns: what long words draw, by scans along the branches (prefix sums, Blelloch 1990).

What the turtle is like at a command is what it was like at first, changed by every command on the way there, from the start of
the word along the branches. Changes of one kind can be put together, two into one: turns and steps are added, rotations
multiplied, lengths and widths scaled and shifted. So a word is cut into pieces, in all of which changes are put together side
by side, and then those of whole pieces. The numbers are those that come out module by module, up to their last digits. Shapes,
which only look at the turtle, are drawn afterwards, in the order of the word. What bends strokes, levels the turtle, is
restored by the next stroke or returns to the last one is done module by module.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget, check_bytes, counted
from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.engines.columnar import ColumnWord
from lsys_kit.geometry.turtle.commands import (
    LARGEST,
    LAST_COLOUR,
    RAMP_END,
    RAMP_START,
    Command,
    Instruction,
    commands_by_symbol,
    instruction_of,
    unknown_commands,
    values_of,
)
from lsys_kit.geometry.turtle.surfaces import MOST_CURVED
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.modules import Module

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Choice = NDArray[np.bool_]
    Numbers = NDArray[Any]

Columns: TypeAlias = "tuple[Numbers, ...]"
"""What commands change, or what the turtle is like there: columns with a row for each command."""
Then: TypeAlias = Callable[[Columns, Columns], Columns]
"""Puts changes together: the first, then the second."""

DRAWS = "draw", "draw without vertex"
MOVES = *DRAWS, "move", "move without vertex"
CORNERS = "draw", "move", "record vertex"
"""The actions that end in a corner of a polygon."""
TURNS = "turn", "turn back", "turn by mirrored angle", "pitch", "roll"
SHAPES = (
    *("draw circle", "draw disc", "draw sphere", "draw box", "draw label", "draw surface"),
    *("expect surface", "draw expected surface", "begin polygon", "record vertex", "end polygon"),
)
_SETS = tuple(f"{does} {name}" for does in ("set", "reset") for name in ("length", "width", "colour", "gravitropism"))
SCANNED = frozenset((*MOVES, *TURNS, *SHAPES, *_SETS, "push", "pop", "mirror turns", "set scale", "step colour"))
"""The actions that are done so."""
LEAST = 2**12
"""Shorter words are interpreted module by module."""
LEAST_OF_AN_ORDER, LEAST_OF_A_SHAPE = 2**6, 8
"""Scans pay where so many commands, on average, stand in as many brackets, and for each shape, which is drawn by itself."""
LEAST_IN_PIECES = 2**6
"""So many changes are put together one after another."""
BYTES = 500
"""About what a command takes in memory."""


class Commands(NamedTuple):
    """The commands of a word, in its order.

    actions, action
        The names of the actions, and the number of that of each command.
    factor, addend
        As of `Instruction`.
    module, rank
        The number of its module among those that are drawn, and its own among the commands of the module.
    state, place
        The state of the module of the word, and its place there. Of a word in columns the first module of a kind stands for
        all of them.
    """

    actions: list[str]
    action: Numbers
    factor: Numbers
    addend: Numbers
    module: Numbers
    rank: Numbers
    state: Numbers
    place: Numbers

    def calling(self, *names: str) -> Choice:
        """Which commands call an action of these names."""
        return np.array([action in names for action in self.actions], bool)[self.action]

    def at(self, which: Choice | Numbers) -> Commands:
        return Commands(self.actions, *(column[which] for column in self[1:]))


def commands_of(
    codes: Numbers, drawn: Mapping[int, Sequence[Module]], given: Mapping[str, Sequence[Command]], angle: Value
) -> Commands:
    """The commands of a word, given its states, what each of them is drawn as, and the commands of each symbol."""
    modules = [*chain.from_iterable(drawn.values())]
    number_of = {symbol: number for number, symbol in enumerate(given)}
    kind = np.array([number_of[module.symbol] for module in modules], np.int64)
    many = np.array([*map(len, given.values())])[kind]
    before = np.concatenate([[0], np.cumsum(many)])  # how many commands stand before each module
    actions: dict[str, int] = {}
    action, module, rank = (np.zeros(before[-1], np.int64) for _ in range(3))
    factor, addend = np.zeros(before[-1]), np.zeros(before[-1])
    for symbol, number in number_of.items():
        found = np.flatnonzero(kind == number)
        here = [modules[each] for each in found.tolist()]
        for place, command in enumerate(given[symbol]):
            rows = before[found] + place
            module[rows], rank[rows] = found, place
            action[rows], factor[rows], addend[rows] = _amounts(command, here, angle, actions)
    known, sizes = (np.fromiter(each, np.int64, len(drawn)) for each in (drawn, map(len, drawn.values())))
    ends = np.cumsum(sizes)
    first, times = (np.zeros(int(known.max()) + 1, np.int64) for _ in range(2))
    first[known], times[known] = before[ends - sizes], before[ends] - before[ends - sizes]
    times = times[codes]
    size = int(times.sum())
    check_bytes(BYTES * size, lambda: "The word was not drawn")
    rows = np.repeat(first[codes] - np.cumsum(times) + times, times) + np.arange(size)
    columns = action[rows], factor[rows], addend[rows], module[rows], rank[rows]
    return Commands([*actions], *columns, np.repeat(codes, times), np.repeat(np.arange(len(codes)), times))


def _with_values(
    commands: Commands, word: ColumnWord, modules: Sequence[Module], given: Mapping[str, Sequence[Command]], angle: Value
) -> Commands | None:
    """The commands of a word in columns with the values of their own modules; None where one of these cannot be drawn."""
    factor, addend = commands.factor.copy(), commands.addend.copy()
    for number, module in enumerate(modules):
        for rank, command in enumerate(given[module.symbol] if module.arguments else ()):
            rows = np.flatnonzero((commands.module == number) & (commands.rank == rank) & (command.argument != ""))
            values = [word.floats(each, commands.place[rows]) for each in range(len(module.arguments))]
            if not all(np.all(abs(each) <= LARGEST) for each in values):
                return None
            factor[rows], addend[rows] = _of_values(command, values[0], angle)
    return commands._replace(factor=factor, addend=addend)


def _of_values(command: Command, values: Numbers, angle: Value) -> Numbers:
    """The factors and addends of a command with values."""
    if command.argument in ("all", "more", "less"):
        sign = math.copysign(1.0, command.factor) if command.argument == "all" else -1.0 if command.argument == "less" else 1.0
        return np.stack([np.full(len(values), float(command.argument != "all")), sign * values])
    return np.array([instruction_of(command, Module("", (value,)), angle)[1:3] for value in values.tolist()]).reshape(-1, 2).T


def _amounts(command: Command, modules: Sequence[Module], angle: Value, actions: dict[str, int]) -> Numbers:
    """The number of the action, the factor and the addend of a command at modules with its symbol."""
    bare = instruction_of(command, Module(modules[0].symbol), angle)
    columns = np.array([actions.setdefault(bare.action, len(actions)), bare.factor, bare.addend])[:, None]
    with_values = np.array([command.argument != "" and module.arguments != () for module in modules])
    if not with_values.any():
        return np.broadcast_to(columns, (3, len(modules)))
    values = np.array([values_of(module)[0] for module in modules if module.arguments])
    called = actions.setdefault(bare.action if command.action == "turn back" else command.action, len(actions))
    columns = columns.repeat(len(modules), axis=1)
    columns[0, with_values], columns[1:, with_values] = called, _of_values(command, values, angle)
    return columns


def scan(change: Columns, begins: Numbers, then: Then) -> Columns:
    """What rows of changes make up to each of them: of all since the last that begins anew.

    >>> ones, begins = np.ones(7), np.array([1, 0, 0, 1, 0, 0, 0]) > 0
    >>> scan((ones,), begins, added)[0].tolist()
    [1.0, 2.0, 3.0, 1.0, 2.0, 3.0, 4.0]
    """
    size = len(begins)
    rows = max(1, math.isqrt(size)) if size > LEAST_IN_PIECES else size
    pieces = -(-size // rows)
    found = tuple(_in_pieces(column, rows, pieces) for column in change)
    begun = _in_pieces(begins, rows, pieces)
    for row in range(1, rows):
        check_budget()
        made = then(tuple(column[row - 1] for column in found), tuple(column[row] for column in found))
        for column, values in zip(found, made, strict=True):
            np.copyto(column[row], values, where=~begun[row])
    if pieces > 1:
        carried = scan(tuple(column[-1] for column in found), np.logical_or.reduce(begun, axis=0), then)
        open_still = ~np.logical_or.accumulate(begun, axis=0)
        open_still[:, 0] = False
        made = then(tuple(np.roll(column, 1) for column in carried), found)
        for column, values in zip(found, made, strict=True):
            np.copyto(column, values, where=open_still)
    return tuple(column.T.reshape(-1)[:size] for column in found)


def _in_pieces(column: Numbers, rows: int, pieces: int) -> Numbers:
    """A column in pieces, side by side."""
    whole = np.zeros(rows * pieces, column.dtype)
    whole[: len(column)] = column
    return np.ascontiguousarray(whole.reshape(pieces, rows).T)


def added(first: Columns, second: Columns) -> Columns:
    return tuple(a + b for a, b in zip(first, second, strict=True))


def latter(first: Columns, second: Columns) -> Columns:
    return second


def scaled(first: Columns, second: Columns) -> Columns:
    """Changes factor * x + addend put together."""
    (factor, addend), (by, more) = first, second
    return by * factor, by * addend + more


def clipped(first: Columns, second: Columns) -> Columns:
    """Changes put together that add to x and keep it within a least and a greatest number."""
    (more, least, most), (then, lower, upper) = first, second
    return more + then, np.clip(least + then, lower, upper), np.clip(most + then, lower, upper)


def turned(first: Columns, second: Columns) -> Columns:
    """Rotations put together, each a matrix of three rows."""
    return tuple(
        first[row] * second[column] + first[row + 1] * second[column + 3] + first[row + 2] * second[column + 6]
        for row in (0, 3, 6)
        for column in range(3)
    )


class Branches:
    """The branches of a word; a bracket that closes none is none.

    branch, order
        Of each command the branch in which it stands, numbered as they are opened, and in how many brackets; a bracket that
        opens stands outside of its branch.
    before
        The command before it on the way from the start of the word; -1 where there is none.
    last
        The last command on the way to the end of the word.

    >>> found = Branches(np.array([0, 1, 0, 0, 0, 1, 0]) > 0, np.array([0, 0, 0, 1, 0, 0, 0]) > 0)  # a [ b ] c [ d
    >>> found.branch.tolist(), found.order.tolist()
    ([0, 0, 1, 0, 0, 0, 2], [0, 0, 1, 0, 0, 0, 1])
    """

    def __init__(self, opens: Choice, closes: Choice) -> None:
        balance = np.cumsum(opens.astype(np.int64) - closes)
        depth = balance - np.minimum(np.minimum.accumulate(balance), 0)  # after the command
        self._opened = np.cumsum(opens) * opens
        here = np.empty_like(depth)  # the branch after the command: the last that was opened at its depth
        sorted_ = np.argsort(_small(depth), kind="stable")
        floor = depth[sorted_] * (len(opens) + 1)
        here[sorted_] = np.maximum.accumulate(floor + self._opened[sorted_] * (depth[sorted_] > 0)) - floor
        self.branch, self.order = np.where(opens, np.concatenate([[0], here[:-1]]), here), depth - opens
        inside = np.flatnonzero(~closes)
        self._rows = inside[np.argsort(_small(self.order[inside]), kind="stable")]  # one branch after another
        self._of_rows = self.branch[self._rows]
        opening = np.concatenate([[-1], np.flatnonzero(opens)])
        self.before = np.full(len(opens), -1)
        first = _changes(self._of_rows)
        self.before[self._rows] = np.where(first, opening[self._of_rows], np.concatenate([[-1], self._rows[:-1]]))
        self.orders = np.searchsorted(self.order[self._rows], np.arange(int(self.order.max(initial=0)) + 2))
        ended = self._rows[self._of_rows == here[-1]]
        self.last = int(ended[-1]) if len(ended) else int(opening[here[-1]])

    def before_each(self, column: Numbers, first: float) -> Numbers:
        """A column of what the turtle is like after each command, as a column of what it is like before."""
        return np.where(self.before >= 0, column[self.before], first)

    def along(self, which: Choice, change: Columns, then: Then, start: tuple[float, ...]) -> Columns:
        """What the turtle is like after each command.

        Parameters
        ----------
        which, change
            The commands that change it, and how.
        then
            Puts changes together.
        start
            What it is like at first, as a change.
        """
        if not which.any():
            return tuple(np.broadcast_to(np.asarray(each), len(which)) for each in start)
        rows, of_rows = self._rows, self._of_rows
        latest = np.cumsum(which[rows]) - 1
        chosen = rows[which[rows]]
        branch, numbers = self.branch[chosen], (np.cumsum(which) - 1)[chosen]
        local = scan(tuple(column[numbers] for column in change), _changes(branch), then)
        starts = tuple(
            np.full(int(self._opened.max()) + 1, each, column.dtype) for each, column in zip(start, change, strict=True)
        )
        found = tuple(np.zeros(len(which), column.dtype) for column in change)
        for begin, end in zip(self.orders[:-1].tolist(), self.orders[1:].tolist(), strict=True):
            check_budget()
            here, mine = rows[begin:end], of_rows[begin:end]
            first, last = (int(latest[place - 1]) + 1 if place else 0 for place in (begin, end))
            values = tuple(column[mine] for column in starts)
            if last > first:
                at = latest[begin:end]
                own = (at >= first) & (branch[at] == mine)
                total = then(
                    tuple(column[branch[first:last]] for column in starts), tuple(column[first:last] for column in local)
                )
                values = tuple(np.where(own, some[at - first], value) for some, value in zip(total, values, strict=True))
            opened = self._opened[here]
            for column, start_, value in zip(found, starts, values, strict=True):
                column[here] = value
                start_[opened[opened > 0]] = value[opened > 0]
        return found


def _changes(numbers: Numbers) -> Choice:
    """Where a row of numbers is another one than before."""
    changes: Choice = np.diff(numbers, prepend=-1) != 0
    return changes


def _small(numbers: Numbers) -> Numbers:
    """Numbers as those of the type that is sorted fastest, if they are small."""
    return numbers.astype(np.uint16) if numbers.max(initial=0) < 2**16 else numbers


class Carried(NamedTuple):
    """What the turtle carries after each command: the step, width and scale, the colour, and which way Fractint's turns go."""

    length: Numbers
    width: Numbers
    scale: Numbers
    colour: Numbers
    mirror: Numbers

    @property
    def stroke_width(self) -> Numbers:
        return np.where(self.width > 0, self.width * self.scale, self.width)


def carried_by(turtle: Any, commands: Commands, branches: Branches) -> Carried | None:
    """What a turtle carries; None where the changes cannot be put together, or lead to numbers that are refused."""

    def quantity(name: str) -> Numbers:
        resets = commands.calling(f"reset {name}")
        which = resets | commands.calling(f"set {name}")
        change = np.where(resets, 0.0, commands.factor), np.where(resets, turtle.initial.get(name, 1.0), commands.addend)
        return branches.along(which, tuple(column[which] for column in change), scaled, (0.0, getattr(turtle, name)))[1]

    length, width, scale = map(quantity, ("length", "width", "scale"))
    colour = _colours(turtle, commands, branches)
    within = all(np.all(abs(each) <= LARGEST) for each in (length, width, scale))
    sets = commands.calling("set width", "set scale")
    below = np.minimum(commands.factor, commands.addend)[sets] < 0  # it may lead to what is set to 0
    if colour is None or not within or below.any():
        return None
    return Carried(length, width, scale, colour, turtle.mirror * signs(commands.calling("mirror turns"), branches))


def _colours(turtle: Any, commands: Commands, branches: Branches) -> Numbers | None:
    sets, steps, resets = (commands.calling(f"{does} colour") for does in ("set", "step", "reset"))
    given = np.where(resets, turtle.initial["colour"], np.clip(np.round(commands.addend), 0, LAST_COLOUR))
    in_ramp = np.append(given[sets | resets], turtle.colour) >= RAMP_START
    if commands.factor[sets].any() or (steps.any() and not in_ramp.all()):
        return None
    more = np.where(steps, np.round(commands.addend), 0.0)
    least, most = (np.where(steps, end, given) for end in (RAMP_START, RAMP_END))
    which = sets | steps | resets
    start = 0.0, float(turtle.colour), float(turtle.colour)
    return branches.along(which, (more[which], least[which], most[which]), clipped, start)[1].astype(np.int64)


def signs(flips: Choice, branches: Branches) -> Numbers:
    """After each command 1, or -1 after an odd number of some."""
    return 1 - 2 * (branches.along(flips, (np.ones(int(flips.sum())),), added, (0.0,))[0] % 2)


def interpreted(
    turtle: Any, word: Word, handlers: Mapping[str, Callable[[Any, Any], None]], prepare: Callable[[Instruction], object]
) -> bool:
    """Let a turtle interpret a word by scans, where that is possible and pays; whether it has.

    The parameters are those of `run_turtle`.
    """
    system = word.states.system
    columns = word if isinstance(word, ColumnWord) and not system.interpretation else None
    codes = np.asarray(word.codes, np.int64) if columns is None else columns.examples()
    drawn = interpretations(word.states, word.numbers() if columns is None else np.unique(codes).tolist())
    modules = [*chain.from_iterable(drawn.values())]
    given = commands_by_symbol({module.symbol for image in drawn.values() for module in image}, system.turtle)
    called = {action for found in given.values() for each in found for action in (each.action, each.bare or each.action)}
    if not called or called & handlers.keys() - SCANNED:
        return False
    commands = commands_of(codes, drawn, given, system.angle)
    if columns is not None:
        found = _with_values(commands, columns, modules, given, system.angle)
        if found is None:
            return False
        commands = found
    commands = commands.at(np.array([action in handlers for action in commands.actions], bool)[commands.action])
    expecting, naming = commands.calling("expect surface"), commands.calling("draw expected surface")
    both = np.flatnonzero(expecting | naming)
    naming[both[np.concatenate([[False], expecting[both]])[:-1]]] = False
    commands = commands.at(~naming)  # without those that are not expected
    shown = np.flatnonzero(commands.calling(*SHAPES, *(CORNERS if "begin polygon" in commands.actions else ())))
    opens = commands.calling("push")
    branches = Branches(opens, commands.calling("pop"))
    if len(opens) < max(LEAST_OF_AN_ORDER * (len(branches.orders) - 1), LEAST_OF_A_SHAPE * len(shown)):
        return False
    turtle.check_depth(int(branches.order[opens].max(initial=0)))
    carried = carried_by(turtle, commands, branches)
    if carried is None:
        return False
    orientation = turtle.scanned_orientation(commands, branches, carried, prepare)
    position = turtle.scanned_position(commands, branches, carried, orientation)
    turtle.unknown = dict.fromkeys(unknown_commands(drawn, system))
    turtle.flat = turtle.in_plane or int(commands.calling("expect surface", "draw surface").sum()) > MOST_CURVED
    seen = {**carried._asdict(), "position": position, "orientation": orientation, "state": commands.state}
    seen = {name: columns for name, columns in seen.items() if _varies(columns) or name == "position"}
    at, corners = [*seen].index("position"), {commands.actions.index(each) for each in CORNERS if each in commands.actions}
    shapes = commands.at(shown)
    orders = branches.order[shown].tolist()
    called_by = shapes.action, shapes.module, shapes.rank, shapes.place
    calls = zip(*(column.tolist() for column in called_by), orders, strict=True)
    attributes = zip(*(_rows(columns, shown) for columns in seen.values()), strict=True)
    for (action, number, rank, place, order), values in counted(zip(calls, attributes, strict=True)):
        if action in corners:
            turtle.record_vertex(values[at])
            continue
        for name, value in zip(seen, values, strict=True):
            setattr(turtle, name, value)
        turtle.stack = [()] * order
        module = modules[number] if columns is None else columns[place]
        instruction = instruction_of(given[module.symbol][rank], module, system.angle)
        handlers[instruction.action](turtle, instruction)
    if turtle.expects_surface:
        turtle.unknown["~"] = None
    turtle.stack = []
    turtle.position = _rows(position, np.array([branches.last]))[0] if branches.last >= 0 else turtle.position
    return True


def _varies(columns: Any) -> bool:
    """Whether a column, or some of several, is more than one number repeated."""
    return any(map(_varies, columns)) if isinstance(columns, tuple) else columns.strides != (0,)


def _rows(columns: Any, which: Numbers) -> list[Any]:
    """Some rows of columns, as the turtle has them."""
    if isinstance(columns, tuple):
        return [*zip(*(_rows(column, which) for column in columns), strict=True)]
    listed: list[Any] = columns[which].tolist()
    return listed
