"""QR codes: what a phone sees is what the code says, in every format."""

from __future__ import annotations

import io
import re
import sys
import xml.etree.ElementTree as ET

import pytest
import segno
from PIL import Image

from lsys_kit import LSystemError, ModelFileError, ModelLimitError, ModelValueError, link, qr_code, system, systems
from lsys_kit.pictures.qr_codes import MOST_BYTES, QUIET_ZONE, SIDE
from tests.endings import SAID_OF_FLAT
from tests.test_hostile_names import HOSTILE, check_svg, refused


def painted(image: Image.Image) -> list[list[bool]]:
    """Which pixels of a picture are dark."""
    grey = image.convert("L")
    return [[grey.getpixel((x, y)) < 128 for x in range(grey.width)] for y in range(grey.height)]


def wanted(text: str) -> list[list[bool]]:
    """The pixels of the code that another program makes, with the margin of the standard."""
    rows = [*segno.make_qr(text, encoding="utf-8").matrix_iter(scale=SIDE, border=4)]
    return [[bool(module) for module in row] for row in rows]


@pytest.mark.parametrize("text", ["A", "https://example.org/", "ω: Ä → 日", link(system("J4"), {"step": 9})], ids=ascii)
def test_a_png_has_the_dark_modules_and_a_white_margin(text: str) -> None:
    image = Image.open(io.BytesIO(qr_code(text).png))
    assert image.size == (qr_code(text).size,) * 2
    assert painted(image) == wanted(text)


def test_an_svg_has_the_same_dark_modules() -> None:
    code = qr_code("https://example.org/")
    path = ET.fromstring(code.svg).find("{http://www.w3.org/2000/svg}path")
    dark = set()
    for run in path.get("d").split("M")[1:]:
        corner, _, rest = run.partition("h")
        x, y = (int(part) // (10 * SIDE) for part in corner.split())
        dark |= {(x + along, y) for along in range(int(rest.partition("v")[0]) // (10 * SIDE))}
        assert rest.partition("v")[2].startswith(f"{10 * SIDE}h-")
    assert dark == {(x + QUIET_ZONE, y + QUIET_ZONE) for y, row in enumerate(code.rows) for x, dark in enumerate(row) if dark}


@pytest.mark.parametrize("id", systems())
def test_the_link_of_a_system_of_the_catalogue_is_a_code_that_can_be_projected(id: str) -> None:
    code = qr_code(link(system(id), {"step": 4}, "https://example.org/panel.html"))
    most = 93 if id in ("K22", "K23", "K25") else 77  # version 15: half a centimetre a module on a projection of half a metre
    assert len(code.rows) <= most


def test_a_code_is_saved_as_it_is(tmp_path) -> None:
    code = qr_code("A")
    code.save(tmp_path / "a.svg")
    code.save(tmp_path / "a.png")
    code.save(tmp_path / "a.png")
    assert painted(Image.open(tmp_path / "a.png")) == wanted("A")
    with pytest.raises(ModelFileError, match=re.escape(SAID_OF_FLAT)):
        code.save(tmp_path / "a.gif")


@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_any_text_is_shown_as_text_or_refused(text: str) -> None:
    code = refused(lambda: qr_code(text))
    if code is not None:
        check_svg(code.svg)


def test_what_a_code_cannot_hold_is_refused() -> None:
    assert qr_code("a" * MOST_BYTES)
    for text, kind in (("a" * (MOST_BYTES + 1), ModelLimitError), ("", ModelValueError), (3, ModelValueError)):
        with pytest.raises(kind):
            qr_code(text)


def test_without_its_library_one_is_told_what_to_install(monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "segno", None)
    with pytest.raises(LSystemError, match=r"pip install 'lsys-kit\[qr\]'"):
        qr_code("A")
