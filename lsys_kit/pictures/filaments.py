"""Filaments as pictures: the rows of a developmental sequence below one another, with a common scale.

Cells are ellipses, as in the figures of C. Jacob ("Modeling Growth with L-Systems & Mathematica"), or rectangles with round
ends, as in those of P. Prusinkiewicz ("Introduction to Modeling with L-systems"), in which the smallest cells are round;
arrows show their polarity. Walls are bars, thicker and darker with age, with their age in figures. Long filaments are folded
into lines, as a text is: in one line their cells would be too narrow to be seen.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from itertools import pairwise
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

from lsys_kit.arrays import np
from lsys_kit.geometry.scene import Cells, Floats, Scene, Walls
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.pictures.rendering.frames import HEIGHT, MARGIN, WIDTH
from lsys_kit.pictures.shapes import Ellipse, Group, Look, Path, Raster, Rectangle, Shape, Span, Text
from lsys_kit.pictures.style.colour_values import mixed
from lsys_kit.pictures.style.palette import GREEN, OLDEST, cell_fill
from lsys_kit.pictures.style.themes import edge_colour, line, theme

if TYPE_CHECKING:
    from numpy.typing import NDArray

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

    >>> from lsys_kit import derive
    >>> from lsys_kit.geometry.filament import filament
    >>> from lsys_kit import read
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
    some = Cells(*(getattr(cells, each.name)[in_line] for each in fields(cells)))
    few = Walls(*(getattr(walls, each.name)[wall_in_line] for each in fields(walls)))
    return replace(
        scene, cells=replace(some, centres=some.centres - [start, 0.0]), walls=replace(few, places=few.places - start)
    )


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


def drawn_cells(cells: Cells, scale: float, some: slice | NDArray[np.intp] = slice(None)) -> Iterator[DrawnCell]:
    """Some cells of a filament in a picture of a scale, whose left end is at 0."""
    columns = (cells.centres[some, 0] * scale, *(cells.sizes[some] * scale / 2).T)
    rest = cells.polarities[some], cells.shades[some], cells.states[some]
    return map(DrawnCell, *(column.tolist() for column in (*columns, *rest)))


@dataclass(frozen=True)
class FilamentLayout:
    """The layout of the rows of a picture, in pixels: whether they are labelled with their steps, and with times (then the
    duration of a step); pixels per unit of length; room to the left of all rows, above them all, and above each row's cells;
    the distance of rows, and the length of the longest."""

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
        some, left = self._seen(row.scene.cells.centres[:, 0], most), self._left(row)
        return (cell._replace(x=left + cell.x) for cell in drawn_cells(row.scene.cells, self.scale, some))

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

    def _seen(self, places: Floats, most: float) -> slice | NDArray[np.intp]:
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
    """The layout of some rows, the long ones folded; labelled with their steps, and with times if that of a step is not 1;
    without room for any text unless it is written."""
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
