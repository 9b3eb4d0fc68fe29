"""Text as pixels that are the same on every machine: letters of the DejaVu fonts, filled from their outlines.

Programs that set text differ in how they round the shapes of letters, and so do their versions. Here the outlines are read from
the font in its own whole units, and a point of the grid is inside where a ray to the left crosses them an odd number of times.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache, lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.errors import printable
from lsys_kit.geometry.scene import Floats

if TYPE_CHECKING:
    from fontTools.ttLib import TTFont
    from numpy.typing import NDArray

Mask: TypeAlias = "NDArray[np.bool_]"
FONTS = "mpl-data/fonts/ttf"
"""Where matplotlib keeps its fonts."""
FAMILIES = {"sans-serif": "DejaVuSans", "serif": "DejaVuSerif", "monospace": "DejaVuSansMono"}
"""The fonts of families of letters."""
PIECES = 6
"""The straight pieces of a curve."""
SLANT = 0.2
"""How far an italic letter leans, to its height."""


class Font(NamedTuple):
    """A family of letters, and whether they are bold."""

    family: str = "sans-serif"
    bold: bool = False


PLAIN = Font()
"""The usual font."""


class Glyph(NamedTuple):
    """A letter on a grid: its points, and where their left upper corner lies from the beginning of the baseline."""

    mask: Mask
    left: int
    top: int


def advance(text: str, size: float, face: Font = PLAIN) -> float:
    """The width of a text.

    >>> advance("step", 10) == sum(advance(letter, 10) for letter in "step") > 20
    True
    """
    units = sum(_width(letter, face) for letter in text)
    return units * size / _units(face)


@cache
def _width(letter: str, face: Font) -> int:
    name = glyph_name(letter, face)
    with opened_font(face) as font:
        return int(font["hmtx"][name][0])


@cache
def _units(face: Font) -> int:
    with opened_font(face) as font:
        return int(font["head"].unitsPerEm)


@lru_cache(maxsize=2_048)
def glyph(letter: str, size: float, italic: bool = False, face: Font = PLAIN) -> Glyph:
    """A letter of a size in points of the grid.

    >>> glyph("l", 20).mask.shape, glyph(" ", 20).mask.size
    ((16, 3), 0)
    """
    contours = outlines(letter, size, italic, face)
    corners = np.concatenate(contours) if contours else np.zeros((1, 2))
    (left, top), (right, bottom) = np.floor(corners.min(0)).astype(int), np.ceil(corners.max(0)).astype(int)
    mask = np.zeros((bottom - top, right - left), bool)
    for points in contours:
        _cross(mask, points - (left, top))
    return Glyph(mask, int(left), int(top))


def outlines(letter: str, size: float, italic: bool = False, face: Font = PLAIN) -> list[Floats]:
    """The outlines of a letter as closed lines of corners, from the beginning of its baseline."""
    scale = size / _units(face)
    contours = [np.array(contour) * (scale, -scale) for contour in _contours(glyph_name(letter, face), face)]
    return [points - [[SLANT * y, 0] for y in points[:, 1]] for points in contours] if italic else contours


def _cross(mask: Mask, contour: Floats) -> None:
    """Turn over every point to the right of a closed line: in the end those inside have been turned an odd number of times."""
    for (x, y), (x_next, y_next) in zip(contour.tolist(), np.roll(contour, -1, axis=0).tolist(), strict=True):
        rows = np.arange(round(min(y, y_next)), round(max(y, y_next)))  # whose middles lie between the ends
        for row in rows.tolist():
            across = x + (row + 0.5 - y) * (x_next - x) / (y_next - y)
            mask[row, max(0, round(across)) :] ^= True


def font_path(face: Font) -> Path:
    """The file of a font."""
    package = find_spec("matplotlib")
    assert package is not None
    assert package.origin is not None
    return Path(package.origin).parent / FONTS / f"{FAMILIES[face.family]}{'-Bold' * face.bold}.ttf"


@cache
def _font_of(face: Font) -> TTFont:
    from fontTools.ttLib import TTFont

    return TTFont(font_path(face), lazy=True)


@contextmanager
def opened_font(face: Font) -> Iterator[TTFont]:
    """A font, to be read only. Its tables are read when they are first needed; where that is broken off, it is opened anew."""
    font = _font_of(face)
    try:
        yield font
    except BaseException:
        font.close()
        _font_of.cache_clear()
        raise


@cache
def glyph_name(letter: str, face: Font) -> str:
    """The name of a letter's glyph; that of an empty box where the font has none, of a "?" for what cannot be seen."""
    with opened_font(face) as font:
        found: str = font.getBestCmap().get(ord(printable(letter)), ".notdef")
        return found


@cache
def _contours(name: str, face: Font) -> tuple[tuple[tuple[float, float], ...], ...]:
    """The outlines of a glyph as closed lines of corners, in units of the font."""
    from fontTools.pens.recordingPen import DecomposingRecordingPen

    with opened_font(face) as font:
        glyphs = font.getGlyphSet()
        pen = DecomposingRecordingPen(glyphs)
        glyphs[name].draw(pen)
    contours: list[list[tuple[float, float]]] = []
    for command, points in pen.value:
        if command == "moveTo":
            contours.append([*points])
        elif command == "lineTo":
            contours[-1] += points
        elif command == "qCurveTo":
            contours[-1] += _curve(contours[-1][-1], points)
    return tuple(map(tuple, contours))


def _curve(start: tuple[float, float], points: object) -> list[tuple[float, float]]:
    """The corners of quadratic curves behind one another, as TrueType writes them: between two controls lies a point."""
    from fontTools.pens.basePen import decomposeQuadraticSegment

    corners: list[tuple[float, float]] = []
    for control, end in decomposeQuadraticSegment(points):
        for t in (number / PIECES for number in range(1, PIECES + 1)):
            x, y = ((1 - t) ** 2 * a + 2 * t * (1 - t) * b + t * t * c for a, b, c in zip(start, control, end, strict=True))
            corners.append((x, y))
        start = end
    return corners
