"""The picture of a stored notebook: word, stage diagram and drawing of one step, the same pixels on every machine."""

from __future__ import annotations

import base64
import hashlib
import io
import os
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from lsys_kit import compare, explore, read, system, systems
from lsys_kit.classroom.panel.view_model import BETWEEN, LINES, MARGIN, WIDEST, StepView, ViewModel, composite_png, lines_of
from lsys_kit.pictures.style.palette import MARK, MARK_EDGE, tinted
from tests.test_hostile_names import HOSTILE, made, refused


def sight(id: str, step: int, place: int = -1) -> StepView:
    return ViewModel(system(id)).sight(step, {}, place=place)


def pixels(png: bytes) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB"))


def has(image: np.ndarray, colour: str) -> bool:
    """Whether a picture has a colour."""
    return bool((image == [*bytes.fromhex(colour[1:])]).all(axis=2).any())


def shown(view: StepView, width: float) -> str:
    """The word as the picture shows it."""
    return "".join("".join(chip.label) for line in lines_of(view, width) for chip in line)


@pytest.mark.slow
@pytest.mark.parametrize("id", systems())
def test_every_system_of_the_catalogue_fits_on_a_page(id: str) -> None:
    found = system(id)
    image = pixels(composite_png(sight(id, found.steps or 3)))
    assert image.shape[1] <= WIDEST
    edges = np.concatenate([image[:, : MARGIN - 6].reshape(-1, 3), image[:, -MARGIN + 6 :].reshape(-1, 3)])
    assert (edges == 255).all()


def test_it_holds_the_drawing_as_it_is() -> None:
    view = sight("J4", 9)
    drawing, image = pixels(view.picture.png), pixels(composite_png(view))
    height, width = drawing.shape[:2]
    corner = image[-MARGIN - height : -MARGIN, -MARGIN - width : -MARGIN]
    assert (corner == drawing).all()


def test_a_short_word_is_shown_whole() -> None:
    assert shown(sight("J4", 9), 900) == "Al(1)Br(1)Bl(2)Ar(2)Al(3)Bl(1)Ar(1)Bl(2)Ar(2)"
    assert shown(ViewModel(read("axiom: A\nA -> ε")).sight(1, {}), 900) == "the empty word"


@pytest.mark.slow
@pytest.mark.parametrize("width", [200, 640, 1152])
@pytest.mark.parametrize(("id", "step"), [("K5", 4), ("K12", 5), ("P9", 9), ("J4", 40)])
def test_of_a_long_word_the_middle_is_left_out(id: str, step: int, width: int) -> None:
    view = sight(id, step)
    lines = lines_of(view, width)
    assert len(lines) <= LINES
    assert all(sum(chip.width + BETWEEN for chip in line) - BETWEEN <= width for line in lines if len(line) > 1)
    chips = [chip for line in lines for chip in line]
    gaps = [chip for chip in chips if chip.label[0].startswith("…")]
    left_out = len(view.word) - (len(chips) - len(gaps))
    assert [chip.label[0] for chip in gaps] == ([f"… {left_out:,} more …"] if left_out else [])
    assert left_out == 0 or len(lines) >= LINES - 1


def test_what_is_marked_is_marked_in_the_word_and_in_the_diagram() -> None:
    plain, marked = (pixels(composite_png(sight("J4", 9, place))) for place in (-1, 0))
    for colour in (MARK, MARK_EDGE):
        assert not has(plain[:, :340], colour)  # to the left of the current row of the drawing
        assert has(marked, colour)
        assert has(marked[:130], colour)
        assert has(marked[150:, :340], colour)
    assert has(plain[:130], tinted("#28A964", 0.22))


def test_every_token_is_painted() -> None:
    def ink(system_text: str) -> int:
        image = pixels(composite_png(ViewModel(read(system_text)).sight(0, {})))
        return int((image[150:, :300] == [0x22, 0x30, 0x3C]).all(axis=2).sum())

    dots = np.diff([ink(f"axiom: B{' A' * count}\nA -> A\nB -> B") for count in range(1, 5)])
    assert dots.min() > 20
    assert dots.max() < 1.5 * dots.min()


@pytest.mark.slow
def test_the_pixels_do_not_depend_on_the_process() -> None:
    code = (
        "import hashlib; from tests.classroom.test_composite import *\n"
        "print(hashlib.sha256(composite_png(sight('K19', 12))).hexdigest())"
    )
    said = {
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
            timeout=300,
        ).stdout.strip()
        for seed in ("1", "2")
    }
    assert said == {hashlib.sha256(composite_png(sight("K19", 12))).hexdigest()}


def test_a_page_without_a_kernel_shows_it() -> None:
    panel = explore("J4", 9)
    bundle = panel._repr_mimebundle_()
    assert base64.b64decode(bundle["image/png"]) == composite_png(sight("J4", 9))
    assert bundle["text/plain"].startswith("Step 9: 9 cells. Al(1)Br(1)")
    assert bundle["text/plain"].endswith(". Run this cell to play.")


@pytest.mark.slow
@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_names_of_any_kind_are_painted(text: str) -> None:
    view = refused(lambda: ViewModel(made(text)).sight(1, {}))
    if view is not None:
        assert pixels(composite_png(view)).shape[1] <= WIDEST


def stored(widget: object) -> np.ndarray:
    return pixels(base64.b64decode(widget._repr_mimebundle_()["image/png"]))


@pytest.mark.slow
def test_a_comparison_is_stored_with_both_sides_and_the_views_that_are_asked_for() -> None:
    both = stored(compare("J4", {}, {"lifeTimeA": 2}, step=7))
    left, right = (
        pixels(composite_png(ViewModel(system("J4")).sight(7, given), ("word", "drawing"))) for given in ({}, {"lifeTimeA": 2})
    )
    assert (both[: left.shape[0], : left.shape[1]] == left).all()
    assert (both[: right.shape[0], -right.shape[1] :] == right).all()
    assert stored(compare("K5", "L1", step=3, show="drawing")).shape[0] < stored(compare("K5", "L1", step=3)).shape[0]
    high, wide, _ = stored(explore("J4", 9)).shape  # two of them are too wide to stand side by side
    assert stored(compare("J4", "J4", step=9, show=["word", "stages", "drawing"])).shape == (2 * high, wide, 3)
    assert stored(compare("K28", "K29", step=1)).size


@pytest.mark.slow
def test_a_panel_is_stored_with_the_views_that_are_asked_for() -> None:
    view = sight("J4", 7)
    assert (stored(explore("J4", 7, show="drawing")) == pixels(composite_png(view, ("drawing",)))).all()
    assert (stored(explore("J4", 7, show="rules")) == pixels(composite_png(view, ("drawing",)))).all()
    assert (stored(explore("J4", 7)) == pixels(composite_png(view))).all()
