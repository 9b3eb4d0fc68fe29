"""QR codes (ISO/IEC 18004): a text, such as a link, as a square that a phone reads from a projected page."""

from __future__ import annotations

import io
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby

from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError, require
from lsys_kit.pictures.formats.notebook import SVGPicture
from lsys_kit.pictures.shapes import Drawing, Look, Path
from lsys_kit.pictures.sizes import document
from lsys_kit.pictures.style.palette import PAPER

BLACK = "#000000"
SIDE = 4
"""The side of a module of the code, in pixels."""
QUIET_ZONE = 4
"""The white margin that the standard asks for, in modules."""
MOST_BYTES = 2_953
"""What the largest code holds, in bytes."""


@dataclass(frozen=True)
class QRCode(SVGPicture):
    """The QR code of a text.

    Attributes
    ----------
    text
        The text.
    rows
        The modules of the code, row by row, without the white margin: dark ones are True.
    """

    text: str
    rows: tuple[tuple[bool, ...], ...]

    @property
    def size(self) -> int:
        """Its width and height with the margin, in pixels."""
        return (len(self.rows) + 2 * QUIET_ZONE) * SIDE

    def _shown(self, most: int, enlarged: float) -> Drawing:
        """The dark modules."""
        path = "".join(f"M{10 * x} {10 * y}h{10 * wide}v{10 * SIDE}h{-10 * wide}z" for x, y, wide in self._dark)
        return document([Path(path, Look(fill=BLACK))], self.size, self.size, f"QR code: {self.text}")

    @cached_property
    def png(self) -> bytes:
        """The code as PNG."""
        from PIL import Image, ImageDraw

        image, buffer = Image.new("1", (self.size, self.size), PAPER), io.BytesIO()
        pen = ImageDraw.Draw(image)
        for x, y, wide in self._dark:
            pen.rectangle((x, y, x + wide - 1, y + SIDE - 1), fill=BLACK)
        image.save(buffer, "PNG")
        return buffer.getvalue()

    @property
    def _dark(self) -> list[tuple[int, int, int]]:
        """The dark stretches of the rows: where each begins, and how wide it is, in pixels."""
        found = []
        for down, row in enumerate(self.rows, QUIET_ZONE):
            along = QUIET_ZONE
            for dark, run in groupby(row):
                wide = len([*run])
                if dark:
                    found.append((along * SIDE, down * SIDE, wide * SIDE))
                along += wide
        return found

    def __repr__(self) -> str:
        return f"QR code of {len(self.text):,} characters, {len(self.rows)} by {len(self.rows)}"


def qr_code(text: str) -> QRCode:
    """The QR code of a text, with as much correction of errors as its size allows.

    Raises
    ------
    ModelValueError, ModelLimitError
        The text is empty, has characters that cannot be seen, or is too long.
    LSystemError
        The library segno is not installed.

    Examples
    --------
    >>> qr_code("https://example.org/")
    QR code of 20 characters, 25 by 25
    """
    require(text, str, "A text")
    length = len(text.encode("utf-8", "replace"))
    if not text or not text.isprintable():
        raise ModelValueError("The text of a QR code has characters, and all of them are visible")
    if length > MOST_BYTES:
        raise ModelLimitError(
            f"A QR code holds at most {MOST_BYTES:,} bytes; this text has {length:,}", limit=MOST_BYTES, needed=length
        )
    try:
        import segno
    except ImportError:
        raise LSystemError(
            "QR codes need the library segno, which is not installed", hint="Install it with: pip install 'lsys-kit[qr]'"
        ) from None
    code = segno.make_qr(text, encoding="utf-8")
    return QRCode(text, tuple(tuple(map(bool, row)) for row in code.matrix))
