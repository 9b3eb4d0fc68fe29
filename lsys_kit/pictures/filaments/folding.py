"""Long filaments folded into lines, as a text is: in one line their cells would be too narrow to be seen."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lsys_kit.geometry.scene import Cells, Scene, Walls

MOST_CELLS, A_LINE = 100, 60
"""The greatest number of cells of a row that is not folded, and about how many stand in a line then."""
SLACK = 0.2
"""A row that is longer than a line by no more than this part is not folded for its last cells."""
MOST_LINES = 60
"""What would have more lines than this is not folded: a person wants to see it as a whole."""


@dataclass(frozen=True)
class FilamentRow:
    """One step of a developmental sequence; or one line of it, if it is folded, with its number from 0."""

    step: int
    scene: Scene
    part: int | None = None


def folded(rows: Sequence[FilamentRow]) -> Sequence[FilamentRow]:
    """Some rows, each in as many lines as it needs, which are equally long.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.filament import filament
    >>> from lsys_kit.notation.read import read
    >>> growing = derive(read("axiom: a\\na -> a b\\nb -> a\\ninterpretation:\\na -> R(2,1)\\nb -> L(1,1)"), 10)
    >>> lines = folded([FilamentRow(step, filament(growing[step])) for step in (0, 10)])
    >>> [(line.step, line.part, len(line.scene.cells)) for line in lines]
    [(0, None, 1), (10, 0, 48), (10, 1, 48), (10, 2, 48)]
    """
    longest = max(rows, key=lambda row: len(row.scene.cells))
    if len(longest.scene.cells) <= MOST_CELLS:
        return rows
    length = longest.scene.width / math.ceil(len(longest.scene.cells) / A_LINE)
    lines = [max(1, math.ceil(row.scene.width / length - SLACK)) for row in rows]
    if sum(lines) > MOST_LINES:
        return rows
    return [line for row, many in zip(rows, lines, strict=True) for line in (_lines(row, many) if many > 1 else [row])]


def _lines(row: FilamentRow, many: int) -> Iterator[FilamentRow]:
    """The lines of a row: a cell stands where its centre lies."""
    cells, walls, length = row.scene.cells, row.scene.walls, row.scene.width / many
    where = np.minimum(cells.centres[:, 0] // length, many - 1)
    ends = cells.centres[:, 0] + cells.sizes[:, 0] / 2
    before = np.maximum(np.searchsorted(ends, walls.places + 1e-9 * length, side="right") - 1, 0)
    for part in range(many):
        yield FilamentRow(row.step, _piece(row.scene, where == part, where[before] == part), part)


def _piece(scene: Scene, in_line: NDArray[np.bool_], wall_in_line: NDArray[np.bool_]) -> Scene:
    """Some cells and walls of a filament, from 0 on."""
    cells, walls = scene.cells, scene.walls
    start = float(cells.centres[in_line, 0][0] - cells.sizes[in_line, 0][0] / 2)
    return replace(
        scene,
        cells=Cells(
            cells.centres[in_line] - [start, 0.0],
            cells.sizes[in_line],
            cells.polarities[in_line],
            cells.shades[in_line],
            cells.states[in_line],
        ),
        walls=Walls(
            walls.places[wall_in_line] - start,
            walls.heights[wall_in_line],
            walls.ages[wall_in_line],
            walls.shades[wall_in_line],
            walls.states[wall_in_line],
        ),
    )
