"""What the turtle of an answer draws, as far as its first stroke that the right drawing lacks, beside the right one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain
from typing import TypeAlias

from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.pictures.formats.svg import svg
from lsys_kit.pictures.shapes import Look, Path, Polygon, Shape, Text
from lsys_kit.pictures.sizes import document
from lsys_kit.pictures.style.palette import BLUE, INK, ORANGE, QUIET

SIDE, MARGIN, CAPTION, CAPTION_WIDE = 200, 20, 22, 110
"""In pixels: the largest side of a drawing, the paper around it, and the height and width of the line below it."""
PARTS = 10
"""So many units are a pixel."""
_TURTLE = 10 + 0j, -7 + 6.5j, -3.5 + 0j, -7 - 6.5j
"""The corners of a turtle that looks to the right, in pixels from its middle."""

Row: TypeAlias = tuple[complex, complex]
"""A stroke, from its start to its end."""


def walks_beside(mine: Sequence[Row], fitting: int, wanted: Sequence[Row] | None, next_right: int | None) -> str:
    """The walk of an answer, its first stroke that does not fit lit and the rest pale, and that of the solution, as SVG.

    Parameters
    ----------
    mine
        The strokes of the answer.
    fitting
        How many of them lie in the right drawing.
    wanted
        Those of the solution, at the same place; None where its next stroke would be the answer.
    next_right
        Which of these comes next; None where all are drawn.

    Examples
    --------
    >>> walks_beside([(0, 1j), (1j, 1 + 1j)], 1, None, None).count("<text")
    1
    """
    step = mine[fitting : fitting + 1]
    panels = [(reply("drawing.your_turtle"), step, ORANGE, mine[fitting + 1 :])]
    if wanted is not None and next_right is not None:
        panels.append((reply("drawing.right_turtle"), wanted[next_right : next_right + 1], BLUE, mine[:0]))
    points = [*chain.from_iterable(mine), *(point for _, lit, _, _ in panels for row in lit for point in row)]
    low, high = (complex(side(at.real for at in points), side(at.imag for at in points)) for side in (min, max))
    scale = SIDE / max(high.real - low.real, high.imag - low.imag, 1e-9)
    across, tall = (round(scale * each) for each in ((high - low).real, (high - low).imag))
    wide, tall, shapes = max(across, CAPTION_WIDE) + 2 * MARGIN, tall + 2 * MARGIN, list[Shape]()
    for number, (caption, lit, colour, rest) in enumerate(panels):
        corner = number * wide + (wide - across) / 2 + 1j * (tall - MARGIN)

        def seen(rows: Iterable[Row], corner: complex = corner) -> list[Row]:
            start, end = ([corner + scale * (at - low).conjugate() for at in side] for side in zip(*rows, strict=True))
            return [*zip(start, end, strict=True)]

        agreed = mine[:fitting]
        for rows, look in ((rest, (QUIET, 1)), (agreed, (INK, 2)), (lit, (colour, 4))):
            if rows:
                shapes.append(_strokes(seen(rows), *look))
        shapes.append(_turtle(*seen(lit or agreed[-1:])[-1], colour))
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


def _strokes(rows: Iterable[Row], colour: str, width: int) -> Path:
    drawn = "".join("M{} {}L{} {}".format(*_units(start), *_units(end)) for start, end in rows)
    return Path(drawn, Look(stroke=colour, stroke_width=PARTS * width, stroke_linecap="round"))


def _units(point: complex) -> tuple[int, int]:
    return round(PARTS * point.real), round(PARTS * point.imag)


def _turtle(start: complex, end: complex, colour: str) -> Polygon:
    """A turtle that has just drawn a stroke, and looks along it."""
    corners = [end + each * (end - start) / (abs(end - start) or 1) for each in _TURTLE]
    return Polygon([*map(_units, corners)], Look(fill=colour, stroke=INK, stroke_width=PARTS))
