"""Every kind of picture in every format, each opened by somebody else's reader; and films of all that develops."""

from __future__ import annotations

import io
import re
import sys
import types
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import defusedxml.ElementTree
import imageio_ffmpeg
import numpy as np
import pikepdf
import pypdfium2
import pytest
import trimesh
from matplotlib.figure import Figure
from PIL import Image, ImageSequence

from lsys_kit import (
    LSystemError,
    ModelFileError,
    ModelNameError,
    ModelValueError,
    animate,
    cellwork_system,
    derive,
    draw,
    draw_hierarchy,
    figure,
    limits,
    lineage,
    map_system,
    plot,
    qr_code,
    read,
    stages,
    system,
)
from lsys_kit.__main__ import main
from lsys_kit.files import made_by_the_kit
from tests.endings import BEGINNINGS, DRAWINGS, FLAT, MESHES, NETS, SAID_OF_FLAT
from tests.endings import FILMS as FILM_ENDINGS

GROWING = read("axiom: F\nF -> FF")
TURNING = read("angle: 60\naxiom: F\nF -> F+F--F+F")
BUSH = read("angle: 25\naxiom: !(0.4)F[&!(0.3)F@O(0.4);(4)@O(0.3)]^F{-f+f+f}")
KINDS: dict[str, Callable[[], Any]] = {
    "plane": lambda: draw(system("K5"), 3),
    "space": lambda: draw(BUSH, 0),
    "filament": lambda: draw(system("J1"), 4),
    "timed filament": lambda: draw(system("P6"), 3),
    "walls": lambda: draw(system("P9w"), 2),
    "steps": lambda: draw(GROWING, steps=[1, 2]),
    "net": lambda: draw(stages(system("J4")), tokens=derive(system("J4"), 9)[-1]),
    "lineage": lambda: draw(lineage(system("P6"), 5), intervals=[(1, 2)]),
    "map": lambda: draw(map_system("K28"), 2),
    "sphere": lambda: draw(map_system("K34"), 2),
    "cells": lambda: draw(cellwork_system("K33"), 1),
    "languages": draw_hierarchy,
    "code": lambda: qr_code("https://example.org/"),
    "plot": lambda: plot(system("J1"), 6),
}
SOLID = ("plane", "space", "filament", "timed filament", "walls", "cells")
IN_UNITS = ("plane", "space", "cells")
"""What stands in a figure in its own units; all else in pixels."""


@pytest.fixture(scope="module", params=KINDS)
def picture(request: pytest.FixtureRequest) -> Any:
    return KINDS[request.param]()


def texts(svg: str) -> list[str]:
    """The texts in a picture."""
    root = defusedxml.ElementTree.fromstring(svg)
    return [
        "".join(piece for piece in each.itertext() if piece not in titles(each))
        for each in root.iter()
        if each.tag.endswith("}text")
    ]


def titles(element: Any) -> list[str]:
    return [each.text for each in element.iter() if each.tag.endswith("}title")]


def page_of(content: bytes) -> pypdfium2.PdfPage:
    return pypdfium2.PdfDocument(content)[0]


def pixels(image: Image.Image, size: tuple[int, int] | None = None) -> np.ndarray:
    """An image, of some size, as fewer grey pixels."""
    wide, high = image.size if size is None else size
    return np.asarray(image.convert("L").resize((wide // 6, high // 6), Image.Resampling.BOX), float)


# --- files ------------------------------------------------------------------------------------------------------------


def test_the_beginning_of_each_format_is_known() -> None:
    assert {*BEGINNINGS, ".mp4", ".pnml"} == {*DRAWINGS, *NETS, *FILM_ENDINGS}


@pytest.mark.slow
def test_each_picture_is_kept_in_all_flat_formats_in_one_size(picture: Any, tmp_path: Path) -> None:
    for ending in FLAT:
        picture.save(tmp_path / f"a{ending}")
        assert made_by_the_kit(tmp_path / f"a{ending}")
    root = defusedxml.ElementTree.parse(tmp_path / "a.svg").getroot()
    size = int(root.attrib["width"]), int(root.attrib["height"])
    assert Image.open(tmp_path / "a.png").size == size
    assert page_of((tmp_path / "a.pdf").read_bytes()).get_size() == pytest.approx([0.75 * side for side in size])
    with pytest.raises(ModelFileError, match=re.escape(SAID_OF_FLAT[:10])):
        picture.save(tmp_path / "a.bmp")


@pytest.mark.slow
def test_a_page_is_sound_and_the_same_every_time(picture: Any) -> None:
    with pikepdf.open(io.BytesIO(picture.pdf)) as file:
        assert file.check_pdf_syntax() == []
        fonts = [font for font in file.objects if isinstance(font, pikepdf.Dictionary) and "/FontFile2" in font]
        names = [str(font.FontName) for font in fonts]
        assert all(re.fullmatch(r"/[A-Z]{6}\+DejaVu\w+(-Bold)?", name) for name in names)
        assert bool(names) == bool(texts(picture.svg))
        assert "/CreationDate" not in file.docinfo
        assert str(file.docinfo["/Title"]) == defusedxml.ElementTree.fromstring(picture.svg).attrib["aria-label"]
    again = type(picture).pdf.func(picture)
    assert again == picture.pdf


@pytest.mark.slow
def test_nothing_is_painted_at_the_border(picture: Any) -> None:
    image = np.asarray(Image.open(io.BytesIO(picture.png)).convert("L"))
    for edge in (image[0], image[-1], image[:, 0], image[:, -1]):
        assert edge.min() == 255


@pytest.mark.slow
def test_the_text_of_a_page_can_be_found(picture: Any) -> None:
    text = page_of(picture.pdf).get_textpage()
    found = sorted("".join(text.get_text_range().split()))
    assert found == sorted("".join("".join(texts(picture.svg)).split()))


@pytest.mark.slow
def test_a_page_and_pixels_show_the_same(picture: Any) -> None:
    page, image = page_of(picture.pdf).render(scale=4 / 3).to_pil(), Image.open(io.BytesIO(picture.png))
    ours, theirs = pixels(image), pixels(page, image.size)
    assert np.abs(ours - theirs).mean() < 2
    assert np.abs(ours - theirs).max() < 45
    assert ours.min() < 250


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_a_figure_shows_the_same(kind: str) -> None:
    picture = KINDS[kind]()
    image = Image.open(io.BytesIO(picture.png))
    sheet = Figure(figsize=(image.width / 100, image.height / 100), dpi=100)
    ax = sheet.add_axes((0, 0, 1, 1))
    assert figure(picture, ax) is ax
    buffer = io.BytesIO()
    sheet.savefig(buffer, format="png")
    theirs = Image.open(buffer).convert("RGB").resize(image.size)
    assert pixels(theirs).min() < 250
    if kind not in (*IN_UNITS, "plot"):
        assert np.abs(pixels(image) - pixels(theirs)).mean() < 3


@pytest.mark.parametrize("kind", SOLID)
def test_what_has_a_body_is_kept_as_a_mesh(kind: str, tmp_path: Path) -> None:
    for ending in MESHES:
        KINDS[kind]().save(tmp_path / f"a{ending}")
        assert len(trimesh.load(tmp_path / f"a{ending}", force="scene").to_geometry().faces)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["plane", "filament", "steps", "net", "code"])
def test_a_png_has_so_many_dots_per_inch(kind: str, tmp_path: Path) -> None:
    picture = KINDS[kind]()
    picture.save(tmp_path / "a.png", dpi="192")
    image, usual = Image.open(tmp_path / "a.png"), Image.open(io.BytesIO(picture.png))
    assert image.size == (2 * usual.width, 2 * usual.height)
    assert image.info["dpi"] == pytest.approx((192, 192), abs=0.1)
    assert np.abs(pixels(image, usual.size) - pixels(usual)).mean() < 3


@pytest.mark.parametrize(
    ("name", "dpi", "said"),
    [("a.svg", 300, "chosen for .png files"), ("a.png", 0, "24 to 2,400 dots"), ("a.png", "3000", "not 3000")],
)
def test_dots_that_make_no_sense_are_told(name: str, dpi: object, said: str, tmp_path: Path) -> None:
    with pytest.raises(ModelValueError, match=said):
        draw(GROWING, 1).save(tmp_path / name, dpi=dpi)


# --- what belongs in every format -------------------------------------------------------------------------------------


@pytest.mark.slow
def test_rows_keep_their_steps_their_times_and_the_mark_in_every_format(monkeypatch: pytest.MonkeyPatch) -> None:
    picture = draw(system("P6"), 3)
    for pixels_from in (1, 10**6):
        monkeypatch.setattr("lsys_kit.pictures.picture.MOST_PAINTED", pixels_from)
        with limits(segments=pixels_from, figure=pixels_from):
            rows = draw(system("P6"), 3)
            assert ("<image" in rows.svg) == (pixels_from == 1)
            assert texts(rows.svg) == texts(picture.svg)
            assert texts(rows.svg)[-2:] == ["3", "2.1"]
            page = page_of(rows.pdf)
            assert "2.1" in page.get_textpage().get_text_range()
            for image in (Image.open(io.BytesIO(rows.png)), page.render(scale=4 / 3).to_pil()):
                left = image.convert("RGB").getpixel((6, image.height - 26))
                assert left == pytest.approx((255, 242, 194), abs=2)  # the mark behind the last row


@pytest.mark.slow
@pytest.mark.parametrize(
    "make", [lambda: draw(system("K5"), 4), lambda: draw(GROWING, steps=[3, 4]), lambda: draw(system("K19"), 9)]
)
def test_what_is_too_much_for_a_page_has_three_hundred_dots_per_inch(make: Callable[[], Any]) -> None:
    with limits(figure=10):
        picture = make()
        with pikepdf.open(io.BytesIO(picture.pdf)) as file:
            images = [each for each in file.pages[0].Resources.XObject.values() if each.Subtype == "/Image"]
            places = [
                [float(number) for number in operands]
                for operands, operator in pikepdf.parse_content_stream(file.pages[0])
                if str(operator) == "cm"
            ]
    across = [place[0] for place in places if place[1] == 0 and place[0] > 50]
    for image, units in zip(images, across, strict=True):
        scale = next(place[0] for place in places if place[0] < 1 and place[0] != 0.75) * 0.75
        assert int(image.Width) / (units * scale / 72) == pytest.approx(300, rel=0.01)


# --- films ------------------------------------------------------------------------------------------------------------

FILMS: dict[str, tuple[Callable[[], Any], int]] = {
    "plant": (lambda: animate(system("K5"), 2, size=(201, 151)), 3),
    "filament": (lambda: animate(system("J1"), 3, size=200), 4),
    "tokens": (lambda: animate(stages(system("J4")), 3), 4),
    "lineage": (lambda: animate(lineage(system("P6"), 3), size=200), 4),
    "map": (lambda: animate(map_system("K28"), 2), 3),
    "sphere": (lambda: animate(map_system("K34"), 1), 2),
    "cells": (lambda: animate(cellwork_system("K33"), 1, size=200), 2),
    "pictures": (lambda: animate([draw(GROWING, 1), plot(system("J1"), 3)], size=200), 2),
    "turntable": (lambda: animate(BUSH, 0, turntable=True, size=100), 60),
    "unfolding": (lambda: animate(TURNING, 2, unfold=True, size=(100, 80), seconds=1), 41),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", FILMS)
def test_each_film_is_kept_in_three_formats(kind: str, tmp_path: Path) -> None:
    make, many = FILMS[kind]
    film = make()
    assert len(film.images) == many
    assert {image.size for image in film.images} == {film.images[0].size}
    assert film.images[0].tobytes() != film.images[-1].tobytes()
    for ending in FILM_ENDINGS:
        film.save(tmp_path / f"a{ending}")
        assert made_by_the_kit(tmp_path / f"a{ending}")
    for ending in ("gif", "apng"):
        assert len([*ImageSequence.Iterator(Image.open(tmp_path / f"a.{ending}"))]) <= many
    moving = imageio_ffmpeg.read_frames(str(tmp_path / "a.mp4"))
    facts = next(moving)
    wide, high = film.images[0].size
    assert facts["size"] == (wide + wide % 2, high + high % 2)
    assert facts["duration"] == pytest.approx(film.seconds * (many - 1 + film.held), abs=0.1)
    *_, last = moving
    ours = np.asarray(film.images[-1].convert("RGB"), int)
    theirs = np.frombuffer(last, np.uint8).reshape(high + high % 2, wide + wide % 2, 3)[:high, :wide]
    assert np.abs(ours - theirs).mean() < 4


def test_an_mp4_is_the_same_every_time() -> None:
    assert animate(GROWING, 2, size=50).mp4 == animate(GROWING, 2, size=50).mp4


def no_program() -> str:
    raise RuntimeError


@pytest.mark.parametrize("library", [None, types.SimpleNamespace(get_ffmpeg_exe=no_program, write_frames=None)])
def test_without_ffmpeg_one_is_told_what_to_install(library: Any, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", library)
    with pytest.raises(LSystemError, match="written by the program ffmpeg, which is not installed") as told:
        animate(GROWING, 1).save(tmp_path / "a.mp4")
    assert "pip install 'lsys-kit[film]'" in str(told.value)
    assert not [*tmp_path.iterdir()]


def test_where_ffmpeg_fails_one_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("IMAGEIO_FFMPEG_EXE", "/bin/false")
    with pytest.raises(LSystemError, match="ffmpeg did not write the film"):
        _ = animate(GROWING, 1).mp4


@pytest.mark.slow
def test_a_turntable_is_a_whole_turn() -> None:
    film = animate(BUSH, 0, turntable=True, view=(10, 20), size=100)
    step, closing = (np.abs(np.asarray(film.images[0], int) - np.asarray(film.images[other])).mean() for other in (1, -1))
    across = np.abs(np.asarray(film.images[0], int) - np.asarray(film.images[30])).mean()
    assert closing == pytest.approx(step, rel=0.5)
    assert across > 1.5 * step
    assert film.seconds * len(film.images) == pytest.approx(6)


@pytest.mark.slow
@pytest.mark.parametrize("what", [GROWING, system("K5")])
def test_what_unfolds_is_as_large_as_it_fits_and_hardly_moves_from_one_picture_to_the_next(what: Any) -> None:
    images = [np.asarray(image.convert("L"), int) for image in animate(what, 3, unfold=True, size=(120, 90)).images]
    moved = [np.abs(one - other).mean() for one, other in pairwise(images)]
    assert max(moved) < 1.5
    heights = [np.ptp(np.nonzero((image != image[0, 0]).any(axis=1))[0]) for image in images]
    assert min(heights) > 0.9 * max(heights)


@pytest.mark.parametrize(
    ("what", "choices", "said"),
    [
        (system("J1"), {}, "Only what a turtle draws unfolds"),
        (map_system("K28"), {}, "Only what a turtle draws unfolds"),
        (draw(GROWING, 1), {}, "Only what a turtle draws unfolds"),
        (BUSH, {"turntable": True}, "On a turntable nothing unfolds"),
        (BUSH, {"unfold": 1}, "True or False"),
    ],
)
def test_what_cannot_unfold_is_said_to(what: Any, choices: dict[str, Any], said: str) -> None:
    with pytest.raises(ModelValueError, match=said):
        animate(what, **{"unfold": True} | choices)


@pytest.mark.parametrize("what", [system("K5"), system("J1"), map_system("K28")])
def test_what_lies_in_the_plane_is_not_turned(what: Any) -> None:
    with pytest.raises(ModelValueError, match="shows what is in space"):
        animate(what, 1, turntable=True)


@pytest.mark.parametrize("what", [[], [1], "K5", None])
def test_what_is_no_picture_makes_no_film(what: object) -> None:
    with pytest.raises(ModelValueError, match="can be animated"):
        animate(what)


@pytest.mark.parametrize("choices", [{"n": 3}, {"view": (90, 0)}, {"angle": 20}, {"background": "dark"}], ids=str)
def test_what_a_picture_shows_is_not_chosen_for_its_film(choices: dict[str, Any]) -> None:
    with pytest.raises(ModelValueError, match="is chosen when it is drawn"):
        animate(draw(system("K5"), 1), **choices)


@pytest.mark.parametrize(
    ("what", "choices", "said"),
    [
        (system("K5"), {"steps": [1, 2]}, 'no option "steps"'),
        (system("K5"), {"colour": "red"}, 'Did you mean "colours"'),
        (stages(system("J4")), {"angle": 20}, 'no option "angle"'),
    ],
    ids=str,
)
def test_what_is_no_choice_of_a_film_is_said(what: Any, choices: dict[str, Any], said: str) -> None:
    with pytest.raises(ModelNameError, match=said):
        animate(what, 1, **choices)


def test_a_picture_keeps_its_paper_on_a_turntable() -> None:
    film = animate(draw(system("K19"), 1, background="dark"), turntable=True, size=20)
    assert film.images[0].getpixel((0, 0)) == (0x16, 0x1B, 0x20)


@pytest.mark.parametrize("path", [None, 3, b"x.png"])
def test_a_name_of_a_file_is_a_text_or_a_path(path: Any) -> None:
    for shown in (draw(system("K5"), 1), draw(stages(system("J4"))), animate(system("K5"), 1)):
        with pytest.raises(ModelValueError, match="The name of a file is needed"):
            shown.save(path)


# --- the shell --------------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("typed", "name"),
    [
        (["draw", "K5", "-n", "2", "--dpi", "192"], "k5.png"),
        (["draw", "K28", "-n", "1"], "k28.gif"),
        (["draw", "K19", "-n", "5", "--turntable", "--size", "60"], "k19.mp4"),
        (["stages", "J4", "-n", "2"], "j4.apng"),
        (["stages", "J4", "-n", "2", "--dpi", "100"], "j4.png"),
        (["stages", "J4"], "j4.pdf"),
    ],
)
def test_the_shell_writes_them(typed: list[str], name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*typed, "-o", str(tmp_path / name)]) == 0
    assert made_by_the_kit(tmp_path / name)
    assert capsys.readouterr().out


def test_the_shell_says_that_a_film_has_no_dots_per_inch(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["draw", "K5", "-n", "2", "--dpi", "300", "-o", str(tmp_path / "a.gif")]) == 2
    assert "A film has no dots per inch" in capsys.readouterr().err
