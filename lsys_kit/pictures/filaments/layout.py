"""The layout of filaments: rows below one another with a common scale, long ones folded; where their cells and walls stand."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from lsys_kit.geometry.scene import Floats
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.pictures.filaments.folding import FilamentRow, folded
from lsys_kit.pictures.rendering.frames import HEIGHT, MARGIN, WIDTH

HEAD, STEPS, TIMES, AGES = 18, 34, 46, 12
"""Room for the heading, the column of steps, that of times, and the ages of walls, in pixels."""
TALLEST, NEAREST, FILLED = 46.0, 14.0, 0.66
"""The greatest and the least distance of rows, in pixels, and the part of it that cells fill."""
LEGIBLE = 28
"""Ages of walls are written where the distance of rows is greater than this, in pixels."""


class DrawnCell(NamedTuple):
    """A cell in the picture: its centre, half its length and width, its polarity, shade and state."""

    x: float
    length: float
    width: float
    way: int
    shade: float
    state: int


class DrawnWall(NamedTuple):
    """A wall in the picture: its position, half its height, its age in figures, its shade and state."""

    x: float
    height: float
    age: str
    shade: float
    state: int


@dataclass(frozen=True)
class FilamentLayout:
    """The layout of the rows of a picture, in pixels.

    Attributes
    ----------
    rows
        The rows.
    numbered
        Whether the rows are labelled with their steps.
    time
        The duration of a step; None if rows are not labelled with times.
    scale
        Pixels per unit of length.
    gutter, head, above
        Room to the left of all rows, above them all, and above each row's cells.
    pitch
        The distance of rows.
    longest
        The length of the longest row.
    """

    rows: Sequence[FilamentRow]
    numbered: bool
    time: Value | None
    scale: float
    gutter: int
    head: int
    above: int
    pitch: float
    longest: float

    @property
    def height(self) -> int:
        """The height of the picture."""
        return round(self.pitch * len(self.rows)) + self.head + 2 * MARGIN

    def middle(self, place: int) -> float:
        """The vertical position of the cells of a row."""
        return MARGIN + self.head + self.pitch * (place + 0.5) + self.above / 2

    def cells(self, row: FilamentRow, most: float = math.inf) -> Iterator[DrawnCell]:
        """The cells of a row; no more than so many in a pixel."""
        cells, left = row.scene.cells, self._left(row)
        some = self._seen(cells.centres[:, 0], most)
        return (
            DrawnCell(left + x, length / 2, width / 2, way, shade, state)
            for x, (length, width), way, shade, state in zip(
                (cells.centres[some, 0] * self.scale).tolist(),
                (cells.sizes[some] * self.scale).tolist(),
                cells.polarities[some].tolist(),
                cells.shades[some].tolist(),
                cells.states[some].tolist(),
                strict=True,
            )
        )

    def walls(self, row: FilamentRow, most: float = math.inf) -> Iterator[DrawnWall]:
        """The walls of a row; no more than so many in a pixel."""
        walls, left = row.scene.walls, self._left(row)
        some = self._seen(walls.places, most)
        return (
            DrawnWall(left + x, height / 2, "" if math.isnan(age) else f"{age:.4g}", shade, state)
            for x, height, age, shade, state in zip(
                (walls.places[some] * self.scale).tolist(),
                (walls.heights[some] * self.scale).tolist(),
                walls.ages[some].tolist(),
                walls.shades[some].tolist(),
                walls.states[some].tolist(),
                strict=True,
            )
        )

    def _seen(self, places: Floats, most: float) -> Any:
        """Which of the shapes at some places are drawn, if no more than so many can be seen in a pixel: the first at each."""
        if len(places) <= WIDTH * most:
            return slice(None)
        return np.unique(np.floor(places * self.scale * most), return_index=True)[1]

    def _left(self, row: FilamentRow) -> float:
        """The left end of a row: all rows are centred; the lines of a folded one begin at the same place."""
        length = row.scene.width if row.part is None else self.longest
        return self.gutter + (WIDTH - self.gutter - MARGIN - length * self.scale) / 2


def filament_layout(
    rows: Sequence[FilamentRow], numbered: bool = False, time: Value | None = None, written: bool = True
) -> FilamentLayout:
    """The layout of some rows.

    Parameters
    ----------
    rows
        The rows; long ones are folded.
    numbered
        Whether the rows are labelled with their steps.
    time
        The duration of a step; rows are labelled with times too, if that is not 1.
    written
        Whether there is any text.
    """
    time, rows = time if numbered and time != 1 else None, folded(rows)
    gutter, head = MARGIN + STEPS * numbered + TIMES * (time is not None), HEAD * numbered
    longest = max(max(row.scene.width for row in rows), 1e-9)
    tallest = max(max(row.scene.height for row in rows), 1e-9)
    most = min(TALLEST, (HEIGHT - 2 * MARGIN - head) / len(rows))
    if any(row.part for row in rows):
        most = max(most, NEAREST)
    above = AGES if written and most > LEGIBLE and any(len(row.scene.walls) for row in rows) else 0
    scale = min((WIDTH - gutter - 2 * MARGIN) / longest, (FILLED * most - above) / tallest)
    pitch = max(NEAREST, min(most, (tallest * scale + above) / FILLED))
    return FilamentLayout(rows, numbered, time, scale, gutter, head, above, pitch, longest)
