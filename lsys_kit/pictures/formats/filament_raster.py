"""Filaments as PNG, without text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from lsys_kit.budget import counted
from lsys_kit.pictures.filaments import DrawnCell, filament_layout, wall_colour, wall_width
from lsys_kit.pictures.formats.raster import FINE, centred, encoded, samples_for
from lsys_kit.pictures.rendering.frames import WIDTH
from lsys_kit.pictures.sizes import Size, enlargement, final_size
from lsys_kit.pictures.style.palette import GREEN, INK, PAPER, cell_fill
from lsys_kit.pictures.svg import FilamentRow

if TYPE_CHECKING:
    from PIL.ImageDraw import ImageDraw

CELLS_A_PIXEL = 16
"""Of more cells than this in one pixel, the others cannot be seen."""


def rows_png(rows: Sequence[FilamentRow], look: str, colour_of: Mapping[int, str],
             size: Size | None = None) -> bytes:
    """Filaments below one another, with a common scale, as a PNG picture."""
    from PIL import Image, ImageDraw

    sheet = filament_layout(rows, written=False)
    wide, high = (round(side * enlargement(WIDTH, sheet.height, size)) for side in (WIDTH, sheet.height))
    samples = samples_for(wide, high)
    fine = samples * enlargement(WIDTH, sheet.height, size)
    image = Image.new("RGB", (wide * samples, high * samples), PAPER)
    pen = ImageDraw.Draw(image)
    for place, row in enumerate(rows):
        middle = sheet.middle(place) * fine
        for cell in counted(sheet.cells(row, CELLS_A_PIXEL)):
            _cell(pen, cell, fine, look, middle, colour_of.get(cell.state, GREEN))
        for wall in counted(sheet.walls(row, CELLS_A_PIXEL)):
            reach, colour = (wall.height + 2) * fine, wall_colour(colour_of.get(wall.state, GREEN), wall.shade)
            pen.line([(wall.x * fine, middle - reach), (wall.x * fine, middle + reach)], fill=colour,
                     width=max(1, round(wall_width(wall.shade) * fine)))
    return encoded(centred(image.resize((wide, high), Image.Resampling.BOX), final_size(WIDTH, sheet.height, size)))


def _cell(pen: ImageDraw, cell: DrawnCell, fine: float, look: str, middle: float, colour: str) -> None:
    edge = max(1, round(fine))
    x, length, width = cell.x * fine, cell.length * fine, cell.width * fine
    box, fill = (x - length, middle - width, x + length, middle + width), cell_fill(colour, cell.shade)
    if look == "ellipses":
        pen.ellipse(box, outline=colour, fill=fill, width=edge)
    else:
        pen.rounded_rectangle(box, min(length, width), outline=colour, fill=fill, width=edge)
    if length > 7 * fine / FINE and cell.way:
        tip, head = x + 0.55 * length * cell.way, 0.3 * min(length, width)
        back = tip - head * cell.way
        pen.line([(2 * x - tip, middle), (tip, middle)], fill=INK, width=edge)
        pen.line([(back, middle - head), (tip, middle), (back, middle + head)], fill=INK, width=edge, joint="curve")
