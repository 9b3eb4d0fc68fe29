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
from html import escape
from itertools import pairwise
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lsys_kit.geometry.scene import Cells, Floats, Scene, Walls
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.pictures.rendering.frames import HEIGHT, MARGIN, WIDTH
from lsys_kit.pictures.style.colour_values import mixed
from lsys_kit.pictures.style.palette import GREEN, OLDEST, cell_fill
from lsys_kit.pictures.style.themes import edge_colour, line, theme
from lsys_kit.pictures.svg import FilamentRow, element

MOST_CELLS, A_LINE = 100, 60
"""The greatest number of cells of a row that is not folded, and about how many stand in a line then."""
SLACK = 0.2
"""A row that is longer than a line by no more than this part is not folded for its last cells."""
MOST_LINES = 60
"""What would have more lines than this is not folded: a person wants to see it as a whole."""


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


def drawn_cells(cells: Cells, left: float, scale: float, some: Any = slice(None)) -> Iterator[DrawnCell]:
    """Some cells of a filament in a picture of a scale, with its left end."""
    places = left + cells.centres[some, 0] * scale, *(cells.sizes[some] * scale / 2).T
    rest = cells.polarities[some], cells.shades[some], cells.states[some]
    return map(DrawnCell, *(column.tolist() for column in (*places, *rest)))


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
        cells = row.scene.cells
        return drawn_cells(cells, self._left(row), self.scale, self._seen(cells.centres[:, 0], most))

    def walls(self, row: FilamentRow, most: float = math.inf) -> Iterator[DrawnWall]:
        """The walls of a row; no more than so many in a pixel."""
        walls, some = row.scene.walls, self._seen(row.scene.walls.places, most)
        places = self._left(row) + walls.places[some] * self.scale, walls.heights[some] * self.scale / 2
        ages = ["" if math.isnan(age) else f"{age:.4g}" for age in walls.ages[some].tolist()]
        columns = places[0].tolist(), places[1].tolist(), ages, walls.shades[some].tolist(), walls.states[some].tolist()
        return map(DrawnWall, *columns)

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
MARKED = 3.2
"""The width of the edges of marked cells, in pixels."""
LETTER = 11
"""The size of letters in cells, in pixels."""


def rows_svg(
    sheet: FilamentLayout,
    look: str,
    colour_of: Mapping[int, str],
    current: int | None = None,
    marked: Collection[int] = (),
    image: str = "",
    letters: Mapping[int, str] = MappingProxyType({}),
) -> str:
    """Filaments below one another, centred, with a common scale; the current row on a tinted band. An image, if there is one,
    stands for the band and for all cells. Letters are written into cells, as far as they fit."""
    body = [image, _heading(sheet)] if sheet.numbered else [image]
    for place, row in enumerate(sheet.rows):
        middle = sheet.middle(place)
        if sheet.numbered:
            body += [_band(sheet, place)] if row.step == current and not image else []
            body.append(_row_labels(sheet, row, middle, row.step == current))
        if not image:
            cells = list(sheet.cells(row))
            body.append(filament_svg(cells, look, middle, colour_of, marked))
            body.append(_letters_svg(cells, middle, colour_of, letters))
            body.append(_walls_svg(list(sheet.walls(row)), middle, bool(sheet.above), colour_of, marked))
    return "".join(body)


def _heading(sheet: FilamentLayout) -> str:
    time = None if sheet.time is None else '<tspan font-style="italic">t</tspan>'
    return _in_columns("step", time, tenths(MARGIN + sheet.head - 7), 110, fill=theme().quiet)


def _in_columns(step: str, time: str | None, y: int, size: int, **look: object) -> str:
    """A text in the column of steps, and one in that of times, if there is one."""
    texts = [(MARGIN + STEPS - 8, step), (MARGIN + STEPS + TIMES - 8, time)]
    return "".join(
        element("text", text, x=tenths(x), y=y, font_size=size, text_anchor="end", font_family="sans-serif", **look)
        for x, text in texts
        if text is not None
    )


def band_of(sheet: FilamentLayout, place: int) -> tuple[float, float, float, float, float]:
    """The band behind the current row: its left, upper, right and lower edge, and the radius of its corners, in pixels."""
    top = sheet.middle(place) - sheet.above / 2 - sheet.pitch / 2
    return 4.0, top, WIDTH - 4.0, top + sheet.pitch, 6.0


def _band(sheet: FilamentLayout, place: int) -> str:
    left, top, right, _, corner = band_of(sheet, place)
    size = {"width": tenths(right - left), "height": tenths(sheet.pitch)}
    return element("rect", None, x=tenths(left), y=tenths(top), **size, rx=tenths(corner), fill=theme().mark)


def _row_labels(sheet: FilamentLayout, row: FilamentRow, middle: float, current: bool) -> str:
    """The step and time of a row, bold if it is the current one; a folded row has them at its first line."""
    if row.part:
        return ""
    size, time = tenths(min(14.0, 0.8 * sheet.pitch)), None if sheet.time is None else time_text(row.step * sheet.time)
    look = {"fill": theme().ink, "font_weight": "bold"} if current else {"fill": theme().quiet}
    return _in_columns(str(row.step), time, tenths(middle) + round(0.35 * size), size, **look)


def time_text(time: Value) -> str:
    """A time in figures, exact if that is short.

    >>> time_text(0.7), time_text(2 / 3)
    ('0.7', '0.6667')
    """
    text = number_text(normalised(time))
    return escape(text if len(text) <= 6 else f"{float(time):.4g}")


def filament_svg(
    cells: Sequence[DrawnCell], look: str, middle: float, colour_of: Mapping[int, str], marked: Collection[int] = ()
) -> str:
    """One filament: cells, lighter when young, with arrows for their polarity."""
    fills = {key: cell_fill(colour_of.get(key[0], GREEN), key[1]) for key in {(c.state, c.shade) for c in cells}}
    y, shapes, arrows = tenths(middle), [], []
    for cell in cells:
        x, rx, ry = tenths(cell.x), tenths(cell.length), tenths(cell.width)
        outline = edge_colour(colour_of.get(cell.state, GREEN))
        if cell.state in marked:
            outline = f'{theme().mark_edge}" stroke-width="{10 * MARKED:.0f}'
        shape = f'<rect x="{x - rx}" y="{y - ry}" width="{2 * rx}" height="{2 * ry}" rx="{min(rx, ry)}"'
        if look == "ellipses":
            shape = f'<ellipse cx="{x}" cy="{y}" rx="{rx}" ry="{ry}"'
        shapes.append(f'{shape} fill="{fills[cell.state, cell.shade]}" stroke="{outline}"/>')
        if cell.way and rx > 25:
            arrows.append(arrow(x, y, rx, ry, cell.way))
    return (
        f'<g stroke-width="10">{"".join(shapes)}</g>'
        f'<path d="{"".join(arrows)}" fill="none" stroke="{theme().ink}" stroke-width="10" stroke-linecap="round" '
        f'stroke-linejoin="round"/>'
    )


def letters_fit(sheet: FilamentLayout, letters: Mapping[int, str]) -> bool:
    """Whether there is room for the letters of all cells."""
    return all(_fits(cell, letters) for row in sheet.rows for cell in sheet.cells(row))


def _letters_svg(cells: Sequence[DrawnCell], middle: float, colour_of: Mapping[int, str], letters: Mapping[int, str]) -> str:
    y = tenths(middle + 0.36 * LETTER)
    texts = [
        f'<text x="{tenths(cell.x)}" y="{y}" stroke="{cell_fill(colour_of.get(cell.state, GREEN), cell.shade)}">'
        f"{escape(letters[cell.state])}</text>"
        for cell in cells
        if letters.get(cell.state) and _fits(cell, letters)
    ]
    look = f'font-size="{10 * LETTER}" font-family="sans-serif" font-style="italic" text-anchor="middle" fill="{theme().ink}"'
    return f'<g {look} stroke-width="40" paint-order="stroke">{"".join(texts)}</g>' if texts else ""


def _fits(cell: DrawnCell, letters: Mapping[int, str]) -> bool:
    return cell.length > LETTER * (0.4 * len(letters.get(cell.state, "")) + 0.7 * (cell.way != 0)) and cell.width > 0.6 * LETTER


def arrow(x: int, y: int, rx: int, ry: int, way: int) -> str:
    """The arrow of a cell that points to the left or right, as the data of a path."""
    reach, head = round(0.55 * rx), max(12, round(0.3 * min(rx, ry)))
    tip = x + way * reach
    return f"M{x - way * reach} {y}H{tip}M{tip - way * head} {y - head}L{tip} {y}L{tip - way * head} {y + head}"


def wall_width(shade: float) -> float:
    """The width of the line of a wall, in pixels."""
    return 1.5 + 3.0 * shade


def wall_colour(colour: str, shade: float) -> str:
    """The colour of a wall, given that of its symbol: the older, the nearer to that of ink."""
    return mixed(line(colour), theme().ink, 1 - (1 - OLDEST) * shade)


def _walls_svg(
    walls: Sequence[DrawnWall], middle: float, aged: bool, colour_of: Mapping[int, str], marked: Collection[int]
) -> str:
    parts = []
    for wall in walls:
        x, top, bottom = tenths(wall.x), tenths(middle - wall.height - 2), tenths(middle + wall.height + 2)
        colour = theme().mark_edge if wall.state in marked else wall_colour(colour_of.get(wall.state, GREEN), wall.shade)
        broad = tenths(wall_width(wall.shade))
        parts.append(element("path", d=f"M{x} {top}V{bottom}", stroke=colour, stroke_width=broad))
    places = [_age_place(wall) for wall in walls]
    ends = [(x - _age_reach(wall), x + _age_reach(wall)) for x, wall in zip(places, walls, strict=True)]
    look = {"font_size": 105, "text_anchor": "middle", "font_family": "sans-serif", "fill": theme().ink}
    if aged and all(left[1] < right[0] for left, right in pairwise(ends)):
        for place, wall in zip(places, walls, strict=True):
            parts.append(element("text", wall.age, x=tenths(place), y=tenths(middle - wall.height - 4.5), **look))
    return element("g", "".join(parts), stroke_linecap="round") if parts else ""


def _age_place(wall: DrawnWall) -> float:
    """Where the age of a wall is centred: above the wall, or as near as the edge of the picture allows."""
    return min(max(wall.x, _age_reach(wall)), WIDTH - _age_reach(wall))


def _age_reach(wall: DrawnWall) -> float:
    return 3.2 * len(wall.age)


def tenths(pixels: float) -> int:
    """Whole tenths of a pixel; halves are always rounded the same way."""
    return math.floor(pixels * 10 + 0.5001)
