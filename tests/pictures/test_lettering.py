"""Letters on a sheet are those of the font, whoever else sets them."""

from __future__ import annotations

import io
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from PIL import Image, ImageDraw, ImageFont

from lsys_kit.pictures.formats.lettering import PLAIN, advance, glyph, opened_font
from lsys_kit.pictures.formats.painting import Sheet, label_width
from lsys_kit.pictures.style.palette import INK

SIZE = 400
FONT = ImageFont.truetype(
    Path(matplotlib.get_data_path()) / "fonts/ttf/DejaVuSans.ttf", SIZE, layout_engine=ImageFont.Layout.BASIC
)


def painted_by_another(letter: str) -> np.ndarray:
    """A letter as FreeType paints it, on a grid whose origin of the baseline is in the middle."""
    image = Image.new("L", (4 * SIZE, 4 * SIZE))
    ImageDraw.Draw(image).text((2 * SIZE, 2 * SIZE), letter, fill=255, font=FONT, anchor="ls")
    return np.asarray(image) > 127


@pytest.mark.parametrize("letter", [*"ABgjQ&@%80iß+-()[],.~≥≠…ωδ"])
def test_a_letter_has_the_shape_that_another_program_gives_it(letter: str) -> None:
    mask, left, top = glyph(letter, SIZE)
    ours = np.zeros((4 * SIZE, 4 * SIZE), bool)
    ours[2 * SIZE + top : 2 * SIZE + top + mask.shape[0], 2 * SIZE + left : 2 * SIZE + left + mask.shape[1]] = mask
    theirs = painted_by_another(letter)
    assert (ours & theirs).sum() > 0.9 * (ours | theirs).sum()  # the other program moves edges to whole pixels
    assert abs(advance(letter, SIZE) - FONT.getlength(letter)) < 1


def test_what_the_font_has_not_is_a_box_and_what_cannot_be_seen_a_question_mark() -> None:
    assert (glyph("日", SIZE).mask == glyph("本", SIZE).mask).all()
    for letter in "\x1b\u202e\ud800\u200b":
        assert (glyph(letter, SIZE).mask == glyph("?", SIZE).mask).all()


def test_an_italic_letter_leans_to_the_right() -> None:
    rows = glyph("l", SIZE, True).mask
    assert rows[0].nonzero()[0].mean() > rows[-1].nonzero()[0].mean() + 0.15 * len(rows)


def test_a_label_ends_where_its_width_says() -> None:
    sheet = Sheet(200, 60)
    sheet.label(10, 40, ("A", "r", "(2,1)"), 20)
    dark = np.asarray(Image.open(io.BytesIO(sheet.png)).convert("L")) < 128
    assert 8 <= dark.any(axis=0).nonzero()[0][0] <= 12
    assert dark.any(axis=0).nonzero()[0][-1] <= 10 + label_width(("A", "r", "(2,1)"), 20)


def test_a_part_of_a_sheet_has_its_own_unit() -> None:
    one, other = Sheet(100, 100), Sheet(100, 100)
    one.part(20, 10, 2).box(10, 15, 5, 6, INK)
    one.part(20, 10, 2).text(1, 30, "ab", 7)
    other.box(40, 40, 10, 12, INK)
    other.text(22, 70, "ab", 14)
    assert one.png == other.png != Sheet(100, 100).png


def test_a_font_that_was_read_in_part_is_opened_anew() -> None:
    with opened_font(PLAIN) as broken:
        pass
    with pytest.raises(KeyboardInterrupt), opened_font(PLAIN):
        raise KeyboardInterrupt
    with opened_font(PLAIN) as font:
        assert font is not broken
