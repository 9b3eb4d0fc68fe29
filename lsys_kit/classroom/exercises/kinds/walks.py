"""What the turtle of an answer draws, as far as its first stroke that the right drawing lacks, beside the right one."""

from __future__ import annotations

from lsys_kit.arrays import np
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.geometry.scene import Floats
from lsys_kit.pictures.formats.svg import svg
from lsys_kit.pictures.shapes import Look, Polygon, Shape, Strokes, Text
from lsys_kit.pictures.sizes import document
from lsys_kit.pictures.style.palette import BLUE, INK, ORANGE, QUIET

SIDE, MARGIN, CAPTION, CAPTION_WIDE = 200, 20, 22, 110
"""In pixels: the largest side of a drawing, the paper around it, and the height and width of the line below it."""
PARTS = 10
"""So many units are a pixel."""
_TURTLE = np.array([10 + 0j, -7 + 6.5j, -3.5 + 0j, -7 - 6.5j])
"""The corners of a turtle that looks to the right, in pixels from its middle."""


def walks_beside(mine: Floats, fitting: int, wanted: Floats | None, next_right: int | None) -> str:
    """The walk of an answer, its first stroke that does not fit lit and the rest pale, and that of the solution, as SVG.

    Parameters
    ----------
    mine
        The strokes of the answer, from the start of each to its end; shape (n, 2), complex.
    fitting
        How many of them lie in the right drawing.
    wanted
        Those of the solution, at the same place; None where its next stroke would be the answer.
    next_right
        Which of these comes next; None where all are drawn.

    Examples
    --------
    >>> row = np.array([[0, 1j], [1j, 1 + 1j]])
    >>> walks_beside(row, 1, None, None).count("<text")
    1
    """
    step = mine[fitting : fitting + 1]
    panels = [(reply("drawing.your_turtle"), step, ORANGE, mine[fitting + 1 :])]
    if wanted is not None and next_right is not None:
        panels.append((reply("drawing.right_turtle"), wanted[next_right : next_right + 1], BLUE, mine[:0]))
    points = np.concatenate([mine.ravel(), *(lit.ravel() for _, lit, _, _ in panels)])
    low, high = (complex(side(points.real), side(points.imag)) for side in (np.min, np.max))
    scale = SIDE / max(high.real - low.real, high.imag - low.imag, 1e-9)
    across, tall = (round(scale * each) for each in ((high - low).real, (high - low).imag))
    wide, tall, shapes = max(across, CAPTION_WIDE) + 2 * MARGIN, tall + 2 * MARGIN, list[Shape]()
    for number, (caption, lit, colour, rest) in enumerate(panels):
        corner = number * wide + (wide - across) / 2 + 1j * (tall - MARGIN)

        def seen(row: Floats, corner: complex = corner) -> Floats:
            return np.asarray(corner + scale * np.conj(row - low))

        agreed = mine[:fitting]
        for row, look in ((rest, (QUIET, 1)), (agreed, (INK, 2)), (lit, (colour, 4))):
            if len(row):
                shapes.append(_strokes(seen(row), *look))
        last = seen(lit if len(lit) else agreed[-1:])[-1]
        shapes.append(_turtle(last, colour))
        shapes.append(
            Text(
                PARTS * (number * wide + wide // 2),
                PARTS * (tall + 14),
                caption,
                Look(fill=INK, font_size=130, text_anchor="middle"),
            )
        )
    title = reply("drawing.walks", number=fitting + 1) if len(step) else reply("drawing.walk_ends")
    return svg(document(shapes, wide * len(panels), tall + CAPTION, title, PARTS))


def _strokes(row: Floats, colour: str, width: int) -> Strokes:
    ends = np.column_stack([row[:, 0].real, row[:, 0].imag, row[:, 1].real, row[:, 1].imag])
    return Strokes(
        np.rint(PARTS * ends).astype(np.int64), Look(stroke=colour, stroke_width=PARTS * width, stroke_linecap="round")
    )


def _turtle(stroke: Floats, colour: str) -> Polygon:
    """A turtle that has just drawn a stroke, and looks along it."""
    start, end = stroke
    corners = end + _TURTLE * (end - start) / (abs(end - start) or 1)
    return Polygon(
        [(round(PARTS * each.real), round(PARTS * each.imag)) for each in corners],
        Look(fill=colour, stroke=INK, stroke_width=PARTS),
    )
