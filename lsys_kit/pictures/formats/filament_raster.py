"""The cells of filaments as pixels, where there are too many for shapes of their own."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

from lsys_kit.budget import counted
from lsys_kit.pictures.filaments import MARKED, DrawnCell, FilamentLayout, band_of, wall_colour, wall_width
from lsys_kit.pictures.formats.raster import FINE, samples_for
from lsys_kit.pictures.rendering.frames import WIDTH
from lsys_kit.pictures.style.palette import GREEN, cell_fill
from lsys_kit.pictures.style.themes import edge_colour, theme

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

CELLS_A_PIXEL = 16
"""Of more cells than this in one pixel, the others cannot be seen."""


def rows_image(
    sheet: FilamentLayout,
    look: str,
    colour_of: Mapping[int, str],
    current: int | None = None,
    marked: Collection[int] = (),
    enlarged: float = 1.0,
) -> Image:
    """Filaments below one another, with a common scale, without text; the current row on a tinted band."""
    from PIL import Image, ImageDraw

    wide, high = round(WIDTH * enlarged), round(sheet.height * enlarged)
    samples = samples_for(wide, high)
    fine = samples * enlarged
    image = Image.new("RGB", (wide * samples, high * samples), theme().ground)
    pen = ImageDraw.Draw(image)
    for place, row in enumerate(sheet.rows):
        middle = sheet.middle(place) * fine
        if row.step == current:
            left, top, right, bottom, corner = (each * fine for each in band_of(sheet, place))
            pen.rounded_rectangle((left, top, right, bottom), corner, theme().mark)
        for cell in counted(sheet.cells(row, CELLS_A_PIXEL)):
            _cell(pen, cell, fine, look, middle, colour_of.get(cell.state, GREEN), cell.state in marked)
        for wall in counted(sheet.walls(row, CELLS_A_PIXEL)):
            reach, colour = (wall.height + 2) * fine, wall_colour(colour_of.get(wall.state, GREEN), wall.shade)
            colour = theme().mark_edge if wall.state in marked else colour
            pen.line(
                [(wall.x * fine, middle - reach), (wall.x * fine, middle + reach)],
                fill=colour,
                width=max(1, round(wall_width(wall.shade) * fine)),
            )
    return image.resize((wide, high), Image.Resampling.BOX)


def _cell(pen: ImageDraw, cell: DrawnCell, fine: float, look: str, middle: float, colour: str, marked: bool) -> None:
    fine_line = max(1, round(fine))
    edge, outline = (round(MARKED * fine), theme().mark_edge) if marked else (fine_line, edge_colour(colour))
    x, length, width = cell.x * fine, cell.length * fine, cell.width * fine
    box, fill = (x - length, middle - width, x + length, middle + width), cell_fill(colour, cell.shade)
    if look == "ellipses":
        pen.ellipse(box, outline=outline, fill=fill, width=edge)
    else:
        pen.rounded_rectangle(box, min(length, width), outline=outline, fill=fill, width=edge)
    if length > 7 * fine / FINE and cell.way:
        tip, head = x + 0.55 * length * cell.way, 0.3 * min(length, width)
        back = tip - head * cell.way
        for corners in ([(2 * x - tip, middle), (tip, middle)], [(back, middle - head), (tip, middle), (back, middle + head)]):
            pen.line(corners, fill=theme().ink, width=fine_line, joint="curve")
