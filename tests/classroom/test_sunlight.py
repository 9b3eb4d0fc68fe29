"""Plants in space in the browser's sun and sky: as the kit's renderer has them, a few calls a frame, and the painter where they
cannot be.

Chromium computes here what a graphics processor would. A page asks for none that is so slow; so that is taken back first.
"""

from __future__ import annotations

import base64
import io
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageFilter
from playwright.sync_api import Browser, Page, sync_playwright

from lsys_kit import derive, explore, read, system
from lsys_kit.classroom.panel.bundle import compact
from lsys_kit.classroom.panel.page import not_needed
from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.pictures.draw import state_colours
from lsys_kit.pictures.rendering.frames import MARGIN, ViewFrame, in_units
from lsys_kit.pictures.rendering.light import LitScene, Sheet, Sun, rendered, seen_smoothly, surfaces_of
from lsys_kit.pictures.style.themes import drawn_on, theme_from
from tests.browser.lab import launched
from tests.classroom.front_end import PAINTER, answers, book_of

ANY_PROCESSOR = """
const { getContext } = HTMLCanvasElement.prototype, { getExtension } = WebGL2RenderingContext.prototype;
HTMLCanvasElement.prototype.getContext = function (kind, given) {
  return getContext.call(this, kind, given && { ...given, failIfMajorPerformanceCaveat: false });
};
WebGL2RenderingContext.prototype.getExtension = function (name) {
  return name === "WEBGL_debug_renderer_info" ? null : getExtension.call(this, name);
};
"""
THEMES = {
    "light": {"ink": "#22303c", "paper": "#ffffff", "markEdge": "#8f6400", "lit": "#b03a00", "dark": False},
    "dark": {"ink": "#e8edf2", "paper": "#161b20", "markEdge": "#e5b84a", "lit": "#ff9a66", "dark": True},
}
PICTURE = """
const canvas = document.createElement("canvas"), pen = canvas.getContext("2d", { willReadFrequently: true });
[canvas.width, canvas.height] = given.size;
const shapes = placed(traced(bookOf(given.book), 0), given.book.turtle.angle);
const frameAt = (around, above) => frameOf(shapes, ...given.size, { around, above });
const painted = (around, above, look = {}) => {
  const frame = frameAt(around, above);
  pen.fillStyle = given.theme.paper;
  pen.fillRect(0, 0, ...given.size);
  paint(pen, shapes, frame, { theme: given.theme, ...look });
  return canvas.toDataURL();
};
"""
SIZE, SMALL = (640, 360), (240, 135)
"""Wide, so that shadows have room."""
TREE = "angle: 25\naxiom: A\nA -> F[&A]/(120)[&A]/(120)[&A]"


@pytest.fixture(scope="module")
def graphics() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        running = launched(playwright, graphics=True)
        yield running
        running.close()


@pytest.fixture
def sunny(graphics: Browser) -> Iterator[Page]:
    context = graphics.new_context()
    context.add_init_script(ANY_PROCESSOR)
    yield context.new_page()
    context.close()


def made(page: Page, code: str, word: Word, theme: str = "light", size: tuple[int, int] = SMALL) -> Any:
    """What some code makes of a word's picture."""
    given = {"book": book_of([word]), "size": size, "theme": THEMES[theme]}
    return answers(page, PICTURE + code, given, *PAINTER)


def pixels(address: str) -> NDArray[np.uint8]:
    return np.array(Image.open(io.BytesIO(base64.b64decode(address.partition(",")[2]))).convert("RGB"))


def word_of(text: str, steps: int = 0) -> Word:
    return derive(read(text), steps)[-1]


def by_the_renderer(word: Word, frame: Mapping[str, Any], theme: str) -> NDArray[np.uint8]:
    """The kit's own picture of a word, in a frame of the panel."""
    with drawn_on(theme_from(theme)):
        [scene] = seen_smoothly(in_units([scene_of(word)], word.states.system), (30, 15), Sun())
        assert isinstance(scene, LitScene)
        left, top = (MARGIN - frame["x0"]) / frame["scale"], (frame["y0"] - MARGIN) / frame["scale"]
        sheet = Sheet(ViewFrame(frame["scale"], left, top, *SIZE), 1.0, *SIZE)
        return rendered(scene, surfaces_of(scene, state_colours(word), sheet), sheet)


@pytest.mark.slow
@pytest.mark.parametrize(("id", "theme"), [("K19", "light"), ("J6", "dark"), ("K14", "light"), ("ABOP-2.8a", "dark")])
def test_the_light_is_that_of_the_renderer(sunny: Page, id: str, theme: str) -> None:
    """Within a few grey levels, where one looks at no single pixel: edges are smoothed from other samples."""
    drawn = system(id)
    word = derive(drawn, drawn.steps or 0)[-1]
    found = made(sunny, "return { picture: painted(30, 15), ...frameAt(30, 15) };", word, theme, SIZE)
    pictures = [pixels(found["picture"]), by_the_renderer(word, found, theme)]
    one, other = (np.array(Image.fromarray(each).filter(ImageFilter.BoxBlur(2))).astype(int) for each in pictures)
    apart, inked = np.abs(one - other), np.abs(other - other[0, 0]).max(axis=2) > 3
    assert inked.mean() > 0.02
    assert apart.mean() < 0.6
    assert apart[inked].mean() < 4
    assert np.percentile(apart[inked], 95) < 16


def test_a_full_turn_changes_nothing_and_half_a_turn_does(sunny: Page) -> None:
    once, again, half = map(
        pixels, made(sunny, "return [painted(30, 15), painted(390, 15), painted(210, 15)];", word_of(TREE, 3))
    )
    assert np.abs(once.astype(int) - again).max() <= 2
    assert np.abs(once.astype(int) - half).max() > 50


def test_a_shadow_falls_to_the_right_and_nothing_is_seen_of_it_from_below(sunny: Page) -> None:
    post = word_of("axiom: !(0.3)&(0)F(5)")
    above, below = map(pixels, made(sunny, "return [painted(0, 30), painted(0, -30)];", post))
    right, left = slice(SMALL[0] // 2 + 10, None), slice(None, SMALL[0] // 2 - 25)
    seen, from_below = ((each != 255).any(axis=2).sum(axis=0) for each in (above, below))
    assert seen[right].sum() > 100 > 5 > seen[left].sum()
    assert from_below.sum() > 100 > 5 > from_below[right].sum()


def test_turning_many_strokes_takes_a_few_calls_and_sends_no_strokes_again(sunny: Page) -> None:
    counted = """
    const calls = { drawn: 0, sent: 0 }, known = WebGL2RenderingContext.prototype;
    const kinds = { drawArrays: "drawn", drawArraysInstanced: "drawn", bufferData: "sent", texSubImage2D: "sent" };
    painted(0, 15);
    for (const [name, kind] of Object.entries(kinds)) {
      const own = known[name];
      known[name] = function (...given) { calls[kind]++; return own.apply(this, given); };
    }
    for (let turn = 1; turn <= 2; turn++) painted(20 * turn, 15 + turn);
    return { ...calls, strokes: shapes.strokes.n };
    """
    found = made(sunny, counted, word_of(TREE, 7))
    assert found == {"drawn": 2 * 11, "sent": 0, "strokes": 1_093}


def test_what_is_traced_and_written_is_painted_over_it(sunny: Page) -> None:
    word = word_of("axiom: !(0.2)F[&F]@L(1)F")
    code = "return [painted(30, 15), painted(30, 15, { lit: new Map([[1, 'self']]) })];"
    plain, traced = map(pixels, made(sunny, code, word))
    ring = (traced == [0xB0, 0x3A, 0x00]).all(axis=2)
    assert ring.sum() > 20
    assert not (plain == [0xB0, 0x3A, 0x00]).all(axis=2).any()
    assert (plain == [0x22, 0x30, 0x3C]).all(axis=2).any(), "the label is written"


def test_a_lost_processor_is_asked_for_again(sunny: Page) -> None:
    code = """
    const before = painted(30, 15);
    screen.gl.getExtension("WEBGL_lose_context").loseContext();
    return [before, painted(30, 15)];
    """
    before, after = map(pixels, made(sunny, code, word_of(TREE, 3)))
    assert (before == after).all()


def test_where_the_processor_is_slow_the_painter_paints(graphics: Browser) -> None:
    code = "return [sunlit(pen, shapes, frameAt(30, 15), given.theme, new Set(), new Map()), painted(30, 15)];"
    none, picture = made(graphics.new_page(), code, word_of(TREE, 3))
    assert none is None
    assert (pixels(picture) != 255).any()


@pytest.mark.parametrize("mode", ["plane", "filament", "map", "tissue", "space"])
def test_only_pages_of_plants_in_space_have_its_scripts(mode: str) -> None:
    assert ("webgl2" in compact("page", not_needed(mode))) == (mode == "space")


@pytest.mark.slow
def test_a_page_of_a_plant_in_space_is_small(tmp_path: Path) -> None:
    explore(system("K19")).save(tmp_path / "K19.html")
    assert (tmp_path / "K19.html").stat().st_size < 90_000
