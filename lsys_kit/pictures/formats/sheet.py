"""A sheet of white paper on which text, boxes and the shapes of pictures are put, as pixels that are the same on every machine.

Everything is drawn at three times its size and then reduced, as in `raster`.
"""

from __future__ import annotations

import copy
import io
from typing import TYPE_CHECKING, Self, TypeAlias

from lsys_kit.budget import check_bytes
from lsys_kit.pictures.formats.lettering import advance, glyph
from lsys_kit.pictures.formats.raster import FINE
from lsys_kit.pictures.style.themes import theme

if TYPE_CHECKING:
    from PIL import Image
    from PIL.ImageDraw import ImageDraw

Point: TypeAlias = tuple[float, float]
PIXEL_BYTES = 3 * (FINE**2 + 1)
"""What a pixel takes while a sheet is painted and reduced."""
SUBSCRIPT, LOWERED = 0.7, 0.21
"""The size of a subscript and how far it is lowered, to the size of the text."""


class Sheet:
    """White paper, or a part of it with its own origin and unit.

    Parameters
    ----------
    width, height
        Its size in pixels; at first a pixel is the unit, and the left upper corner the origin.
    """

    def __init__(self, width: int, height: int) -> None:
        from PIL import Image, ImageDraw

        check_bytes(width * height * PIXEL_BYTES, lambda: "The picture was not drawn")
        self._size, self._left, self._top, self._unit = (width, height), 0.0, 0.0, float(FINE)
        self._image = Image.new("RGB", (width * FINE, height * FINE), theme().ground)
        self._pen = ImageDraw.Draw(self._image)
        self._pasted: list[tuple[Image.Image, tuple[int, int]]] = []

    @property
    def size(self) -> tuple[int, int]:
        """Its width and height in pixels."""
        return self._size

    @property
    def grid(self) -> Image.Image:
        """The fine grid of points that is painted on."""
        return self._image

    @property
    def pen(self) -> ImageDraw:
        """What paints on the grid."""
        return self._pen

    def part(self, x: float, y: float, unit: float = 1.0) -> Self:
        """The same sheet, measured from another point with another unit."""
        part = copy.copy(self)
        part._left, part._top, part._unit = *self._at(x, y), self._unit * unit
        return part

    def text(self, x: float, y: float, text: str, size: float, colour: str = "", italic: bool = False) -> float:
        """Write a text from a point of its baseline on, and return where it ends."""
        from PIL import Image

        for letter in text:
            mask, left, top = glyph(letter, size * self._unit, italic)
            across, down = self._at(x, y)
            if mask.size:
                self._image.paste(colour or theme().ink, (round(across) + left, round(down) + top), Image.fromarray(mask))
            x += advance(letter, size)
        return x

    def label(self, x: float, y: float, label: tuple[str, str, str], size: float, colour: str = "") -> None:
        """Write a label, given as letter, subscript and values, as mathematics is set."""
        letter, subscript, values = label
        x = self.text(x, y, letter, size, colour, letter[:1].isalpha())
        x = self.text(x, y + LOWERED * size, subscript, SUBSCRIPT * size, colour)
        self.text(x, y, values, size, colour)

    def box(self, x: float, y: float, width: float, height: float, fill: str, corner: float = 0) -> None:
        """A filled rectangle, perhaps with round corners."""
        (left, top), (right, bottom) = self._at(x, y), self._at(x + width, y + height)
        self._pen.rounded_rectangle((round(left), round(top), round(right) - 1, round(bottom) - 1), corner * self._unit, fill)

    def picture(self, x: float, y: float, image: Image.Image) -> None:
        """A picture in its own pixels, above everything else."""
        across, down = self._at(x, y)
        self._pasted.append((image, (round(across / FINE), round(down / FINE))))

    @property
    def png(self) -> bytes:
        """The sheet as PNG."""
        buffer = io.BytesIO()
        self.image.save(buffer, "PNG")
        return buffer.getvalue()

    @property
    def image(self) -> Image.Image:
        """The sheet as an image."""
        from PIL import Image

        image = self._image.resize(self._size, Image.Resampling.BOX)
        for pasted, corner in self._pasted:
            image.paste(pasted, corner)
        return image

    def _at(self, x: float, y: float) -> Point:
        """A point on the fine grid."""
        return self._left + x * self._unit, self._top + y * self._unit


def label_width(label: tuple[str, str, str], size: float) -> float:
    """The width of a label, given as letter, subscript and values."""
    letter, subscript, values = label
    return advance(letter + values, size) + advance(subscript, SUBSCRIPT * size)
