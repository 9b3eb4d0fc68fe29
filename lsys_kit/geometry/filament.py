"""Filaments: cells in a row, as in seed 000's figures 1 to 3 and seed 002's figures 1 and 3.

A cell is what the interpretation rules make of a module: `L(length, width, shade)` points left, `R(length, width, shade)`
right, `O(length, width, shade)` nowhere; the shade, from 0 to 1, shows its age and may be left out.
"""

from __future__ import annotations

import numpy as np

from lsys_kit.derivation.interpret import images
from lsys_kit.derivation.words import Word
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import Cells, Scene
from lsys_kit.notation.model import CELLS, Module


def filament(word: Word) -> Scene:
    """The cells of a word, side by side from x = 0.

    Raises
    ------
    ModelValueError
        A cell has a length or width that is not positive.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> growing = read("axiom: a\\na -> a b\\nb -> a\\ninterpretation:\\na -> R(2,1)\\nb -> L(1,1)")
    >>> print(filament(derive(growing, 2)[-1]))
    3 cells, width 5, height 1
    """
    numbers = word.numbers()
    cells_of = {state: [_cell(made, word.states.modules[state]) for made in image if made.symbol in CELLS]
                for state, image in images(word.states, numbers).items()}
    rows = [(*cell, state) for state in numbers for cell in cells_of[state]]
    table = np.array(rows, dtype=np.float64).reshape(-1, 5)
    right_ends = np.cumsum(table[:, 0])
    centres = np.column_stack([right_ends - table[:, 0] / 2, np.zeros(len(table))])
    return Scene(cells=Cells(centres, table[:, :2], table[:, 2].astype(np.int64), table[:, 3],
                             table[:, 4].astype(np.int64)))


def _cell(made: Module, module: Module) -> tuple[float, float, int, float]:
    """Length, width, polarity and shade of a cell."""
    length, width, *rest = (float(value) for value in made.arguments)  # type: ignore[arg-type]
    if length <= 0 or width <= 0:
        raise ModelValueError(f"{module} cannot be drawn as {made}: a cell's length and width are greater than 0")
    return length, width, CELLS[made.symbol], min(1.0, max(0.0, rest[0])) if rest else 0.0
