"""The shapes of which a turtle's drawing is painted, in painter's order: what comes later covers what came before.

The display list knows no scene and no format. SVG, PNG, PDF and figures are painted from it alike, and so is the canvas in the
browser, whose scripts make the same list.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lsys_kit.geometry.scene import Floats, Integers
from lsys_kit.pictures.rendering.looks import BROADEST

NO_COLOUR = -1
"""Stands for the colour inside a shape or of its edge where there is none."""


class Lines(NamedTuple):
    """Straight lines with round ends: shape (n, 4), their ends; (n,), the widths in tenths of a pixel, the numbers of their
    colours, and the states of the modules that drew them."""

    ends: Floats
    widths: Integers
    colours: Integers
    states: Integers


class Areas(NamedTuple):
    """Polygons: their corners and starts as in `Polygons`, the numbers of the colours inside and of their edges."""

    points: Floats
    starts: Integers
    fills: Integers
    edges: Integers


class Rounds(NamedTuple):
    """Discs: shape (n, 2), their centres; (n,), the radii, the numbers of the colours inside and of the edges, and whether they
    are spheres, which are lighter towards the light and darker away from it."""

    centres: Floats
    radii: Floats
    fills: Integers
    edges: Integers
    spheres: NDArray[np.bool_]


class LineRun(NamedTuple):
    """Lines of one colour and width, in tenths of a pixel, by their numbers."""

    numbers: Integers
    colour: str
    width: int


class AreaRun(NamedTuple):
    """Polygons, by their numbers."""

    numbers: Integers


class RoundRun(NamedTuple):
    """Discs, by their numbers."""

    numbers: Integers


Run: TypeAlias = LineRun | AreaRun | RoundRun
"""Shapes that are painted one after another."""
AREA, ROUND = -2, -1
"""The keys of runs that are not of lines, whose keys are not negative."""


@dataclass(frozen=True)
class DisplayList:
    """Shapes in the order in which they are painted, as runs of shapes that look alike.

    In space there may be as many runs as strokes: whoever paints many of them takes the arrays.

    Attributes
    ----------
    lines, areas, rounds
        The shapes, in the units of the plane of the picture.
    palette
        The colours, by their numbers.
    numbers
        Shape (n,): the shapes in their order, each by its number among those of its kind.
    starts
        Shape (m + 1,): the index in `numbers` of the first shape of each run; the last is n.
    keys
        Shape (m,): for each run of lines the key of its looks; `AREA` for polygons, `ROUND` for discs.
    """

    lines: Lines
    areas: Areas
    rounds: Rounds
    palette: Sequence[str]
    numbers: Integers
    starts: Integers
    keys: Integers

    def __iter__(self) -> Iterator[Run]:
        """The runs, one after another."""
        colours, widths = colours_and_widths(self.keys)
        for (start, stop), key, colour, width in zip(
            pairwise(self.starts.tolist()), self.keys.tolist(), colours.tolist(), widths.tolist(), strict=True
        ):
            numbers = self.numbers[start:stop]
            if key >= 0:
                yield LineRun(numbers, self.palette[colour], width)
            else:
                yield AreaRun(numbers) if key == AREA else RoundRun(numbers)


def keys_of(lines: Lines) -> Integers:
    """For each line a number that stands for its colour and its width; keys grow as broad lines get thinner."""
    return lines.colours * (BROADEST + 1) + (BROADEST - lines.widths)


def colours_and_widths(keys: Integers) -> tuple[Integers, Integers]:
    """The numbers of the colours that keys stand for, and the widths in tenths of a pixel."""
    return keys // (BROADEST + 1), BROADEST - keys % (BROADEST + 1)


def in_order(lines: Lines, areas: Areas, rounds: Rounds, palette: Sequence[str], order: Integers) -> DisplayList:
    """Shapes in an order, in which lines are counted first, then areas, then rounds; as long as they look alike in one run."""
    counts = [len(lines.widths), len(areas.fills), len(rounds.radii)]
    keys = np.concatenate([keys_of(lines), np.full(counts[1], AREA), np.full(counts[2], ROUND)])[order]
    numbers = order - np.repeat([0, counts[0], counts[0] + counts[1]], counts)[order]
    starts = np.flatnonzero(np.diff(keys, prepend=AREA - 1))
    return DisplayList(lines, areas, rounds, palette, numbers, np.append(starts, len(order)), keys[starts])
