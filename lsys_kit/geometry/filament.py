"""Filaments: cells in a row, as in figures 1 to 3 of Jacob and figures 1, 3, 4 and 8 of Prusinkiewicz.

(C. Jacob, "Modeling Growth with L-Systems & Mathematica"; P. Prusinkiewicz, "Introduction to Modeling with L-systems".)

A cell is what the interpretation rules make of a module: `L(length, width, shade)` points left, `R(length, width, shade)`
right, `O(length, width, shade)` nowhere. `W(age, shade)` is a wall between two cells, without thickness. The shade, from 0 to
1, shows an age and can be omitted.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from lsys_kit.arrays import np
from lsys_kit.budget import check_bytes, counted
from lsys_kit.derivation.core.interpretation import interpretations, is_cell, modules_between_checks
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word, blocks
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import Cells, Floats, Scene, Walls
from lsys_kit.geometry.turtle.commands import values_of
from lsys_kit.notation.model.modules import CELLS, WALL, Module

if TYPE_CHECKING:
    from numpy.typing import NDArray

SHAPE_BYTES = 240
"""About what a cell or a wall takes in memory while it is drawn."""


def filament(word: Word) -> Scene:
    """The cells of a word, side by side from x = 0, and the walls between them.

    >>> from lsys_kit import derive, read
    >>> growing = read("axiom: a\\na -> a b\\nb -> a\\ninterpretation:\\na -> R(2,1)\\nb -> L(1,1)")
    >>> print(filament(derive(growing, 2)[-1]))
    3 cells, width 5, height 1
    """
    numbers = word.numbers()
    shapes = shapes_of(word.states, numbers)
    rows: list[tuple[float, ...]] = []
    for block in blocks(numbers, modules_between_checks(shapes.values())):
        rows += [(*shape, state) for state in block for shape in shapes[state]]
        check_bytes(len(rows) * SHAPE_BYTES, lambda: "The cells were not drawn")
    table = np.array(rows, dtype=np.float64).reshape(-1, 6)
    ends = np.cumsum(table[:, 1])
    is_wall = table[:, 0] == 1
    cells, walls = table[~is_wall], table[is_wall]
    centres = np.column_stack([(ends - table[:, 1] / 2)[~is_wall], np.zeros(len(cells))])
    return Scene(
        cells=Cells(centres, cells[:, 1:3], cells[:, 3].astype(np.int64), cells[:, 4], cells[:, 5].astype(np.int64)),
        walls=Walls(ends[is_wall], _wall_heights(is_wall, cells[:, 2]), walls[:, 3], walls[:, 4], walls[:, 5].astype(np.int64)),
    )


def shapes_of(states: States, numbers: Sequence[int]) -> dict[int, list[tuple[float, float, float, float, float]]]:
    """For each of some states the cells and walls that it is drawn as: of a cell 0, its length, width, polarity and shade; of a
    wall 1, 0, 0, its age, which is NaN where it has none, and its shade.

    >>> from lsys_kit import read
    >>> states = States(read("axiom: a\\ninterpretation:\\na -> L(2,1) W(3)"))
    >>> shapes_of(states, states.axiom)
    {0: [(0, 2.0, 1.0, -1, 0.0), (1, 0, 0, 3.0, 0.0)]}
    """
    return {
        state: [_cell_or_wall(made, states.modules[state]) for made in image if made.symbol == WALL or is_cell(made)]
        for state, image in counted(interpretations(states, numbers).items(), 1)
    }


def _wall_heights(is_wall: NDArray[np.bool_], widths: Floats) -> Floats:
    """For each wall the width of the wider of its two neighbours."""
    beside = np.concatenate([[0.0], widths, [0.0]])
    before = np.cumsum(~is_wall)[is_wall]  # how many cells stand before each wall
    heights: Floats = np.maximum(beside[before], beside[before + 1])
    return heights


def _cell_or_wall(made: Module, module: Module) -> tuple[float, float, float, float, float]:
    """Whether a module is drawn as a wall; its length and width, its polarity or age, and its shade."""
    if made.symbol == WALL:
        values = values_of(made)
        return 1, 0, 0, values[0] if values else math.nan, _clamped(values[1] if len(values) > 1 else 0.0)
    length, width, *rest = values_of(made)
    if length <= 0 or width <= 0:
        raise ModelValueError(f"{module} cannot be drawn as {made}: the length and width of a cell must be greater than 0")
    return 0, length, width, CELLS[made.symbol], _clamped(rest[0] if rest else 0.0)


def _clamped(shade: float) -> float:
    return min(1.0, max(0.0, shade))
