"""The turtle in the plane (seed 001; ABOP, sections 1.3 and 1.6.1).

Drawing goes in two steps. `traced` walks through a word once and notes for each step forward how often the turtle has
turned by the angle, how many degrees it has turned besides, how far it goes, and at the end of which earlier step it starts.
None of this depends on the angle. `placed` then puts the path into the plane for a given angle; a browser can do that by
itself, without the word and without its rules.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lsys_kit.budget import current
from lsys_kit.derivation.interpret import images
from lsys_kit.derivation.states import States
from lsys_kit.derivation.words import Word
from lsys_kit.errors import ModelLimitError
from lsys_kit.geometry.commands import COMMANDS, Command
from lsys_kit.geometry.scene import Floats, Integers, Scene, Segments
from lsys_kit.notation.model import Module


@dataclass(frozen=True)
class Path:
    """The steps forward of a turtle, before the angle is known.

    Attributes
    ----------
    turns, offsets
        Shape (n,): the heading is turns * angle + offset, in degrees from the turtle's first heading, to the left.
    lengths
        Shape (n,): how far it goes.
    parents
        Shape (n,): the number of the earlier step at whose end it starts; -1 for the origin.
    drawn
        Shape (n,): whether it leaves a stroke.
    orders
        Shape (n,): in how many brackets it stands.
    states
        Shape (n,): the state of its module.
    """

    turns: Floats
    offsets: Floats
    lengths: Floats
    parents: Integers
    drawn: np.ndarray[tuple[int], np.dtype[np.bool_]]
    orders: Integers
    states: Integers

    def __len__(self) -> int:
        return len(self.turns)


def traced(word: Word) -> Path:
    """The path of a turtle that follows a word.

    Raises
    ------
    ModelLimitError
        More brackets are open at once than the limit allows.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> path = traced(derive(read("axiom: F[+F]-(30)F(2)"), 0)[0])
    >>> path.turns.tolist(), path.offsets.tolist(), path.lengths.tolist(), path.parents.tolist()
    ([0.0, 1.0, 0.0], [0.0, 0.0, -30.0], [1.0, 1.0, 2.0], [-1, 0, 0])
    """
    orders = _orders(word.states, word.numbers())
    steps: list[tuple[float, float, float, int, bool, int, int]] = []
    turns, offset, parent = 0.0, 0.0, -1
    stack: list[tuple[float, float, int]] = []
    deepest = current().brackets
    for state in word.numbers():
        for action, amount, degrees in orders[state]:
            if action == "turn":
                turns, offset = turns + amount, offset + degrees
            elif action == "open":
                stack.append((turns, offset, parent))
                turns += amount
                if len(stack) > deepest:
                    raise ModelLimitError(f"More than {deepest:,} brackets are open at once", limit=deepest)
            elif action == "close":
                if stack:
                    turns, offset, parent = stack.pop()
            else:
                steps.append((turns, offset, amount, parent, action == "draw", len(stack), state))
                parent = len(steps) - 1
    columns = list(zip(*steps, strict=True)) or [()] * 7
    kinds = (np.float64, np.float64, np.float64, np.int64, np.bool_, np.int64, np.int64)
    return Path(*(np.array(column, dtype=kind) for column, kind in zip(columns, kinds, strict=True)))


def placed(path: Path, angle: float, heading: float = 90.0) -> Scene:
    """The strokes of a path for an angle and a first heading, in degrees.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> koch = derive(read("axiom: F--F--F\\nF -> F+F--F+F"), 3)[-1]
    >>> print(placed(traced(koch), 60, 0))
    192 segments, width 27, height 31.18
    """
    radians = np.radians(path.turns * angle + path.offsets + heading)
    vectors = path.lengths[:, None] * np.column_stack([np.cos(radians), np.sin(radians)])
    ends = _summed(vectors, path.parents)
    strokes = np.concatenate([ends - vectors, ends], axis=1)[path.drawn]
    return Scene(Segments(strokes, path.orders[path.drawn], path.states[path.drawn]))


def _summed(vectors: Floats, parents: Integers) -> Floats:
    """Each vector added to the sum of its parent, the parent's parent and so on: by doubling, all at once."""
    sums = np.vstack([vectors, np.zeros(2)])
    above = np.append(parents, -1)
    while np.any(above >= 0):
        sums = sums + sums[above]
        above = above[above]
    return sums[:-1]


def _orders(states: States, numbers: Sequence[int]) -> dict[int, list[tuple[str, float, float]]]:
    """For each state what it tells the turtle: an action, an amount, and degrees besides."""
    table = COMMANDS[states.system.turtle]
    return {state: [order for module in image for order in _order(table.get(module.symbol), module)]
            for state, image in images(states, numbers).items()}


def _order(command: Command | None, module: Module) -> list[tuple[str, float, float]]:
    if command is None:
        return []
    if not module.arguments or command.action in ("open", "close"):
        return [(command.action, float(command.amount), 0.0)]
    value = float(module.arguments[0])  # type: ignore[arg-type]
    if command.action == "turn":
        return [("turn", 0.0, command.argument * value)]
    return [(command.action, value, 0.0)]
