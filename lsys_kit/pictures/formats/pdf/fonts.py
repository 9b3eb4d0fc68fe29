"""Fonts in a PDF file: of each what its letters need, with what they stand for, so that text can be selected and found.

Source: ISO 32000-1:2008, chapters 9.7 and 9.10.
"""

from __future__ import annotations

import io
import zlib
from collections.abc import Iterable, Mapping, Sequence

from lsys_kit.errors import printable
from lsys_kit.pictures.formats.pdf.objects import Objects, dictionary, reference
from lsys_kit.pictures.formats.vector.lettering import FAMILIES, font_path, glyph_name
from lsys_kit.pictures.formats.vector.shapes import Font

UPRIGHT, SYMBOLIC = 0, 4
_MAP = """/CIDInit /ProcSet findresource begin
12 dict begin
begincmap
/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def
/CMapName /Adobe-Identity-UCS def
/CMapType 2 def
1 begincodespacerange
<0000> <FFFF>
endcodespacerange
{}endcmap
CMapName currentdict /CMap defineresource pop
end
end
"""
_UNREAD = frozenset(("GPOS", "GSUB", "GDEF", "kern", "name", "OS/2", "gasp"))
"""Tables of a font that a PDF does without, and that take time to read."""
MOST_ENTRIES = 100
"""So many letters may stand in a block of the table of what letters stand for."""


def add_font(objects: Objects, font: Font, letters: Iterable[str]) -> tuple[int, Mapping[str, int]]:
    """Add the part of a font that some letters need; return its number, and the numbers of the letters in it."""
    from fontTools import subset
    from fontTools.ttLib import TTFont

    used = sorted({printable(letter) for letter in letters})
    whole = TTFont(font_path(font), recalcTimestamp=False)
    whole.getGlyphOrder()  # before the table with the names is dropped
    for table in _UNREAD & {*whole.keys()}:
        del whole[table]
    options = subset.Options(hinting=False, notdef_outline=True, glyph_names=True, drop_tables=["post", "cmap", "FFTM"])
    part = subset.Subsetter(options)
    names = {letter: glyph_name(letter, font) for letter in used}
    part.populate(glyphs=names.values())
    part.subset(whole)
    order, buffer = {name: code for code, name in enumerate(whole.getGlyphOrder())}, io.BytesIO()
    widths = [whole["hmtx"][name][0] for name in order]
    whole.save(buffer)
    codes = {letter: order[name] for letter, name in names.items()}
    return _add(objects, whole, _base_name(font, used), buffer.getvalue(), codes, widths), codes


def _base_name(font: Font, letters: Iterable[str]) -> str:
    """The name of a part of a font: six capitals that differ where the letters do, and the name of the font."""
    number, tag = zlib.crc32("".join(letters).encode()), ""
    for _ in range(6):
        number, place = divmod(number, 26)
        tag += chr(ord("A") + place)
    return f"{tag}+{FAMILIES[font.family]}{'-Bold' * font.bold}"


def _add(objects: Objects, part: object, name: str, data: bytes, codes: Mapping[str, int], widths: Sequence[int]) -> int:
    """Add the objects of a font."""
    head, across = part["head"], part["hhea"]  # type: ignore[index]
    unit = 1000 / head.unitsPerEm
    file = objects.stream(data, {"Length1": len(data)})
    about = objects.add(
        dictionary(
            {
                "Type": "/FontDescriptor",
                "FontName": f"/{name}",
                "Flags": SYMBOLIC,
                "ItalicAngle": UPRIGHT,
                "StemV": 80,
                "FontBBox": [round(unit * each) for each in (head.xMin, head.yMin, head.xMax, head.yMax)],
                "Ascent": round(unit * across.ascent),
                "Descent": round(unit * across.descent),
                "CapHeight": round(unit * 0.73 * head.unitsPerEm),
                "FontFile2": reference(file),
            }
        )
    )
    inner = objects.add(
        dictionary(
            {
                "Type": "/Font",
                "Subtype": "/CIDFontType2",
                "BaseFont": f"/{name}",
                "CIDToGIDMap": "/Identity",
                "CIDSystemInfo": {"Registry": "(Adobe)", "Ordering": "(Identity)", "Supplement": 0},
                "FontDescriptor": reference(about),
                "W": [0, [round(unit * width, 3) for width in widths]],
            }
        )
    )
    return objects.add(
        dictionary(
            {
                "Type": "/Font",
                "Subtype": "/Type0",
                "BaseFont": f"/{name}",
                "Encoding": "/Identity-H",
                "DescendantFonts": [reference(inner)],
                "ToUnicode": reference(objects.stream(_letters_of(codes))),
            }
        )
    )


def _letters_of(codes: Mapping[str, int]) -> bytes:
    """The table of what the letters of a font stand for."""
    rows = [f"<{code:04X}> <{letter.encode('utf-16-be').hex().upper()}>\n" for letter, code in codes.items() if code]
    blocks = [rows[first : first + MOST_ENTRIES] for first in range(0, len(rows), MOST_ENTRIES)]
    return _MAP.format("".join(f"{len(block)} beginbfchar\n{''.join(block)}endbfchar\n" for block in blocks)).encode()
