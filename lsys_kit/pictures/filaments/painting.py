"""Filaments as pictures: the rows of a developmental sequence below one another, with a common scale.

Cells are ellipses, as in the figures of C. Jacob ("Modeling Growth with L-Systems & Mathematica"), or rectangles with round
ends, as in those of P. Prusinkiewicz ("Introduction to Modeling with L-systems"), in which the smallest cells are round; arrows
show their polarity. Walls are bars, thicker and darker with age, with their age in figures.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from itertools import pairwise
from types import MappingProxyType

from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.pictures.filaments.folding import FilamentRow
from lsys_kit.pictures.filaments.layout import STEPS, TIMES, DrawnCell, DrawnWall, FilamentLayout
from lsys_kit.pictures.rendering.frames import MARGIN, WIDTH
from lsys_kit.pictures.shapes import Ellipse, Group, Look, Path, Raster, Rectangle, Shape, Span, Text
from lsys_kit.pictures.style.colour_values import mixed
from lsys_kit.pictures.style.palette import GREEN, OLDEST, cell_fill
from lsys_kit.pictures.style.themes import edge_colour, line, theme

LOOKS = ("rectangles", "ellipses")
"""The shapes in which cells can be drawn."""
CELLS_A_PIXEL = 16
"""Of more cells than this in one pixel, the others cannot be seen."""
MARKED = 3.2
"""The width of the edges of marked cells, in pixels."""
LETTER = 11
"""The size of letters in cells, in pixels."""


def row_shapes(
    sheet: FilamentLayout,
    look: str,
    colour_of: Mapping[int, str],
    current: int | None = None,
    marked: Collection[int] = (),
    image: Raster | None = None,
    letters: Mapping[int, str] = MappingProxyType({}),
    bare: bool = False,
) -> list[Shape]:
    """Filaments below one another, centred, with a common scale; the current row on a tinted band. An image, if there is one,
    stands for the band and for all cells; bare these are alone, and no more of them than can be seen. Letters are written into
    cells, as far as they fit."""
    most, written = CELLS_A_PIXEL if bare else math.inf, sheet.numbered and not bare
    body: list[Shape] = [*([image] if image else []), *(_heading(sheet) if written else [])]
    for place, row in enumerate(sheet.rows):
        middle = sheet.middle(place)
        if sheet.numbered and row.step == current and not image:
            body.append(_band(sheet, place))
        body += _row_labels(sheet, row, middle, row.step == current) if written else []
        if not image:
            cells = list(sheet.cells(row, most))
            body += filament_shapes(cells, look, middle, colour_of, marked)
            body += _letters(cells, middle, colour_of, letters)
            body += _walls(list(sheet.walls(row, most)), middle, bool(sheet.above) and not bare, colour_of, marked)
    return body


def _heading(sheet: FilamentLayout) -> list[Text]:
    """The headings of the columns."""
    look = Look(font_size=110, text_anchor="end", font_family="sans-serif", fill=theme().quiet)
    y, time = tenths(MARGIN + sheet.head - 7), Span("t", Look(font_style="italic"))
    headings = [Text(tenths(MARGIN + STEPS - 8), y, "step", look), Text(tenths(MARGIN + STEPS + TIMES - 8), y, [time], look)]
    return headings[: 1 if sheet.time is None else 2]


def _band(sheet: FilamentLayout, place: int) -> Rectangle:
    """The band behind the current row."""
    top = sheet.middle(place) - sheet.above / 2 - sheet.pitch / 2
    return Rectangle(40, tenths(top), tenths(WIDTH - 8), tenths(sheet.pitch), 60, Look(fill=theme().mark))


def _row_labels(sheet: FilamentLayout, row: FilamentRow, middle: float, current: bool) -> list[Text]:
    """The step and time of a row, bold if it is the current one; a folded row has them at its first line."""
    if row.part:
        return []
    size, texts = tenths(min(14.0, 0.8 * sheet.pitch)), [(MARGIN + STEPS - 8, str(row.step))]
    if sheet.time is not None:
        texts.append((MARGIN + STEPS + TIMES - 8, time_text(row.step * sheet.time)))
    weight = Look(fill=theme().ink, font_weight="bold") if current else Look(fill=theme().quiet)
    look: Look = {"font_size": size, "text_anchor": "end", "font_family": "sans-serif", **weight}
    return [Text(tenths(x), tenths(middle) + round(0.35 * size), text, look) for x, text in texts]


def time_text(time: Value) -> str:
    """A time in figures, exact if that is short.

    >>> time_text(0.7), time_text(2 / 3)
    ('0.7', '0.6667')
    """
    text = number_text(normalised(time))
    return text if len(text) <= 6 else f"{float(time):.4g}"


def filament_shapes(
    cells: Sequence[DrawnCell], look: str, middle: float, colour_of: Mapping[int, str], marked: Collection[int] = ()
) -> list[Shape]:
    """One filament: cells, lighter when young, with arrows for their polarity."""
    looks = {
        key: _cell_look(colour_of.get(key[0], GREEN), key[1], key[0] in marked) for key in {(c.state, c.shade) for c in cells}
    }
    y, shapes, arrows = tenths(middle), list[Shape](), []
    for cell in cells:
        x, rx, ry = tenths(cell.x), tenths(cell.length), tenths(cell.width)
        own = looks[cell.state, cell.shade]
        shapes.append(
            Ellipse(x, y, rx, ry, own) if look == "ellipses" else Rectangle(x - rx, y - ry, 2 * rx, 2 * ry, min(rx, ry), own)
        )
        if cell.way and rx > 25:
            arrows.append(arrow(x, y, rx, ry, cell.way))
    pen = Look(fill="none", stroke=theme().ink, stroke_width=10, stroke_linecap="round", stroke_linejoin="round")
    return [Group(shapes, Look(stroke_width=10)), Path("".join(arrows), pen)]


def _cell_look(colour: str, shade: float, marked: bool) -> Look:
    fill = cell_fill(colour, shade)
    if marked:
        return Look(fill=fill, stroke=theme().mark_edge, stroke_width=round(10 * MARKED))
    return Look(fill=fill, stroke=edge_colour(colour))


def letters_fit(sheet: FilamentLayout, letters: Mapping[int, str]) -> bool:
    """Whether there is room for the letters of all cells."""
    return all(_fits(cell, letters) for row in sheet.rows for cell in sheet.cells(row))


def _letters(
    cells: Sequence[DrawnCell], middle: float, colour_of: Mapping[int, str], letters: Mapping[int, str]
) -> list[Shape]:
    """The letters in cells, where there is room, each on its cell's own colour."""
    y = tenths(middle + 0.36 * LETTER)
    texts = [
        Text(tenths(cell.x), y, letters[cell.state], Look(stroke=cell_fill(colour_of.get(cell.state, GREEN), cell.shade)))
        for cell in cells
        if letters.get(cell.state) and _fits(cell, letters)
    ]
    look = Look(
        font_size=10 * LETTER,
        font_family="sans-serif",
        font_style="italic",
        text_anchor="middle",
        fill=theme().ink,
        stroke_width=40,
        paint_order="stroke",
    )
    return [Group(texts, look)] if texts else []


def _fits(cell: DrawnCell, letters: Mapping[int, str]) -> bool:
    """Whether there is room for the letter of a cell, besides its arrow."""
    return cell.length > LETTER * (0.4 * len(letters.get(cell.state, "")) + 0.7 * (cell.way != 0)) and cell.width > 0.6 * LETTER


def arrow(x: int, y: int, rx: int, ry: int, way: int) -> str:
    """The arrow of a cell that points to the left or right, as the data of a path."""
    reach, head = round(0.55 * rx), max(12, round(0.3 * min(rx, ry)))
    tip = x + way * reach
    return f"M{x - way * reach} {y}H{tip}M{tip - way * head} {y - head}L{tip} {y}L{tip - way * head} {y + head}"


def _wall_look(colour: str, shade: float, marked: bool) -> Look:
    """How a wall looks, given the colour of its symbol: the older, the broader and the nearer to ink."""
    aged = mixed(line(colour), theme().ink, 1 - (1 - OLDEST) * shade)
    return Look(stroke=theme().mark_edge if marked else aged, stroke_width=tenths(1.5 + 3.0 * shade))


def _walls(
    walls: Sequence[DrawnWall], middle: float, aged: bool, colour_of: Mapping[int, str], marked: Collection[int]
) -> list[Shape]:
    """The walls of a filament, with their ages above."""
    parts: list[Shape] = []
    for wall in walls:
        x, top, bottom = tenths(wall.x), tenths(middle - wall.height - 2), tenths(middle + wall.height + 2)
        look = _wall_look(colour_of.get(wall.state, GREEN), wall.shade, wall.state in marked)
        parts.append(Path(f"M{x} {top}V{bottom}", look))
    if aged and _ages_fit(walls):
        look = Look(font_size=105, text_anchor="middle", font_family="sans-serif", fill=theme().ink)
        parts += [Text(tenths(_age_place(wall)), tenths(middle - wall.height - 4.5), wall.age, look) for wall in walls]
    return [Group(parts, Look(stroke_linecap="round"))] if parts else []


def _ages_fit(walls: Sequence[DrawnWall]) -> bool:
    """Whether the ages of walls fit side by side."""
    return all(_age_place(left) + _age_reach(left) < _age_place(right) - _age_reach(right) for left, right in pairwise(walls))


def _age_place(wall: DrawnWall) -> float:
    """Where the age of a wall is centred: above the wall, or as near as the edge of the picture allows."""
    return min(max(wall.x, _age_reach(wall)), WIDTH - _age_reach(wall))


def _age_reach(wall: DrawnWall) -> float:
    """Half the width of the age of a wall."""
    return 3.2 * len(wall.age)


def tenths(pixels: float) -> int:
    """Whole tenths of a pixel; halves are always rounded the same way."""
    return math.floor(pixels * 10 + 0.5001)
