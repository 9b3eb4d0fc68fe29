"""The pipe model: a stroke of a plant is a bundle of pipes, one for each tip that it bears.

So the strokes that meet in one are together as broad as it, in a power: with the exponent 2 their cross-sections add up, as
Leonardo da Vinci observed on trees; with 3 the flow in them costs least (Murray, 1926). Trees lie between.

Sources: K. Shinozaki et al., "A quantitative analysis of plant form: the pipe model theory", Japanese Journal of Ecology 14,
1964; ABOP, section 2.1 (p. 57).
"""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING

from lsys_kit.arrays import np
from lsys_kit.budget import counted
from lsys_kit.geometry.scene import Floats, Integers, Segments

if TYPE_CHECKING:
    from numpy.typing import NDArray

EXPONENT = 2.5
"""The power in which widths add up."""
TRUNK, SLENDER = 1 / 50, 3
"""The width of the broadest stroke, as a part of the extent of the drawing; of one that is more than so many times as high as
wide, or the other way round, it is as much less, at most so many times."""
NEAR = 1e-6
"""Points that are closer, relative to the extent of all strokes, are one."""


def pipe_widths(tips: Integers, extents: Floats) -> Floats:
    """How broad strokes are that bear some tips, in a drawing of some extents along the axes, in the units of these.

    >>> [pipe_widths(np.array([3, 1]), np.array([across, 100.0])).round(2).tolist() for across in (90, 20, 1)]
    [[2.0, 1.29], [1.2, 0.77], [0.67, 0.43]]
    """
    relative = np.power(tips, 1 / EXPONENT, dtype=np.float64)
    lesser, greatest = np.sort(extents)[-2:]
    trunk = TRUNK * np.clip(SLENDER * lesser, greatest / SLENDER, greatest)
    found: Floats = relative * (trunk / relative.max(initial=1.0))
    return found


def tips_borne(segments: Segments) -> Integers:
    """For each stroke, in the order of the word, how many axes end in it and in what it bears.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> strokes = scene_of(derive(read("axiom: F[+F][-F]F[+F]"), 0)).segments
    >>> tips_borne(strokes).tolist()
    [4, 1, 1, 2, 1]
    """
    found = strokes_below(segments)
    borne = np.ones(len(found), np.int64)
    borne[found[(found >= 0) & (segments.orders == segments.orders[found])]] = 0  # the axis goes on
    below, tips = array("q", found.tobytes()), array("q", borne.tobytes())
    for number in counted(range(len(tips) - 1, -1, -1)):
        if below[number] >= 0:
            tips[below[number]] += tips[number]
    return np.array(tips, np.int64)


def strokes_below(segments: Segments) -> Integers:
    """For each stroke the one at whose end it starts, or -1: before it in the word, and in no bracket that is closed there.
    What starts at the end of a stroke of no length starts at that of the one below it; and it starts at none itself.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> strokes_below(scene_of(derive(read("axiom: F[+F F][-F]fF"), 0)).segments).tolist()
    [-1, 0, 1, 0, -1]
    """
    starts, ends = np.split(segments.ends, 2, axis=1)
    before, below = _strokes_before(segments.orders, (starts != ends).any(axis=1))
    near = NEAR * float(np.ptp(segments.points, axis=0).max(initial=0.0)) if len(segments) else 0.0
    apart = np.flatnonzero(before >= 0)
    while len(apart):
        apart = apart[np.abs(ends[before[apart]] - starts[apart]).max(axis=1) > near]
        before[apart] = below[before[apart]]
        apart = apart[before[apart] >= 0]
    return before


def _strokes_before(orders: Integers, long: NDArray[np.bool_]) -> tuple[Integers, Integers]:
    """For each stroke the last long one before it of the same order or a lower one; and that of a lower one, or -1."""
    before, below = np.full(len(orders), -1), np.full(len(orders), -1)
    open_ones: list[tuple[int, int]] = [(-1, -1)]
    for number, (order, is_long) in enumerate(counted(zip(orders.tolist(), long.tolist(), strict=True))):
        while open_ones[-1][0] > order:
            open_ones.pop()
        if is_long:
            before[number] = open_ones[-1][1]
            if open_ones[-1][0] == order:
                open_ones.pop()
            below[number] = open_ones[-1][1]
            open_ones.append((order, number))
    return before, below
