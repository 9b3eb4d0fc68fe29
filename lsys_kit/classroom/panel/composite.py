"""One picture of a step, for a page without a kernel and for paper: the word, the stage diagram and the drawing.

Its pixels are the same on every machine, so that stored notebooks are.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from PIL import Image

from lsys_kit.classroom.panel.view_model import StepView
from lsys_kit.pictures.formats.lettering import advance
from lsys_kit.pictures.formats.painting import PixelPainter, Sheet, label_width
from lsys_kit.pictures.nets.diagram import drawn_stages
from lsys_kit.pictures.nets.parts import parts_of, steering_of
from lsys_kit.pictures.shapes import Place
from lsys_kit.pictures.style.labels import label_parts, values_text
from lsys_kit.pictures.style.palette import INK, MARK, MARK_EDGE, QUIET, colours, tinted

WIDEST, NARROWEST, MARGIN, GAP = 1200, 640, 24, 44
"""The greatest width of the picture, the least of its content, the white space around it and between its parts, in pixels."""
TITLE, STATUS, HEADING, LETTER = 30, 15, 13, 17
"""Sizes of letters, in pixels."""
ABOVE = 70
"""From the upper edge of the title to the word."""
LINE, LINES, CHIP, BETWEEN, INSIDE = 33, 6, 25, 3, 3
"""The height and the number of the lines of a word; the height of a module there, the space beside it and within."""
MOST = 500
"""The lines have no room for more modules."""
LONGEST = 40
"""So many characters of a name, and of values, are shown."""


class Chip(NamedTuple):
    """A module in the word: its label, its width, its colour or "" where it only steers, and whether it is marked."""

    label: tuple[str, str, str]
    width: float
    colour: str = ""
    marked: bool = False


def composite_png(view: StepView) -> bytes:
    """The word, the stage diagram and the drawing of a step as one PNG picture.

    >>> from lsys_kit.classroom.catalogue import system
    >>> from lsys_kit.classroom.panel.view_model import ViewModel
    >>> Image.open(io.BytesIO(composite_png(ViewModel(system("J4")).sight(9, {})))).size
    (968, 595)
    """
    net = parts_of(view.net, False, steering_of(view.net.system))
    drawing = Image.open(io.BytesIO(view.picture.png))
    most, together = WIDEST - 2 * MARGIN, net.width + GAP + drawing.width
    beside = together <= most
    inner = min(most, max(NARROWEST, together if beside else net.width, drawing.width))
    unit = min(1.0, inner / net.width)
    lines, across = lines_of(view, inner), (net.width + GAP, 0.0) if beside else (0.0, net.height * unit + GAP)
    top = MARGIN + ABOVE + LINE * len(lines) + GAP
    bottom = max(net.height * unit, across[1] + drawing.height)
    sheet = Sheet(inner + 2 * MARGIN, round(top + bottom + MARGIN))
    _paint_title(sheet.part(MARGIN, MARGIN), view, inner)
    _paint_word(sheet.part(MARGIN, MARGIN + ABOVE), lines)
    _paint_heading(sheet.part(MARGIN, top), "stages")
    marked = {view.net.place_of(view.word.states.modules[state]) for state in view.marked}
    PixelPainter(sheet, Place(unit, MARGIN, top)).draw(drawn_stages(view.net, view.tokens, marked=marked))
    _paint_heading(sheet.part(MARGIN + across[0], top + across[1]), "drawing")
    sheet.picture(MARGIN + across[0], top + across[1], drawing)
    return sheet.png


def _paint_title(sheet: Sheet, view: StepView, width: float) -> None:
    states = sum(count > 0 for count in view.tokens)
    said = f"{view.modules}, {states} state{'s' * (states != 1)}; {view.scene}"
    start = sheet.text(0, TITLE, f"step {view.step}", TITLE) + 18
    while start + advance(said, STATUS) > width:
        said = f"{said[:-2]}…"
    sheet.text(start, TITLE, said, STATUS, QUIET)
    _paint_heading(sheet.part(0, ABOVE), "word")


def _paint_heading(sheet: Sheet, text: str) -> None:
    sheet.text(0, -10, text, HEADING, QUIET)


def _paint_word(sheet: Sheet, lines: Sequence[Sequence[Chip]]) -> None:
    for number, line in enumerate(lines):
        x = 0.0
        for chip in line:
            _paint_chip(sheet.part(x, number * LINE), chip)
            x += chip.width + BETWEEN


def _paint_chip(sheet: Sheet, chip: Chip) -> None:
    if chip.colour:
        fill, edge, height = (MARK, MARK_EDGE, 3) if chip.marked else (tinted(chip.colour, 0.22), chip.colour, 2)
        sheet.box(0, 0, chip.width, CHIP, fill, 3)
        sheet.box(0, CHIP - height, chip.width, height, edge)
    sheet.label(INSIDE, CHIP - 7, chip.label, LETTER, INK if chip.colour else QUIET)


def lines_of(view: StepView, width: float) -> list[list[Chip]]:
    """The word in lines; a long one without its middle."""
    numbers, kept = view.word.numbers(), min(len(view.word), MOST)
    chips = {state: _module_chip(view, state) for state in {*numbers[:kept], *numbers[-kept:]}}
    while True:
        lines = [*_wrapped([*_abridged(numbers, kept, chips)], width)]
        if len(lines) <= LINES:
            return lines
        kept -= max(1, kept * (len(lines) - LINES) // len(lines) - 1)


def _abridged(numbers: Sequence[int], kept: int, chips: Mapping[int, Chip]) -> Iterator[Chip]:
    """The first and the last modules of a word, so many together, and how many there are between them."""
    head, left_out = (kept + 1) // 2, len(numbers) - kept
    yield from (chips[state] for state in numbers[:head])
    if left_out or not kept:
        yield _chip((f"… {left_out:,} more …" if left_out else "the empty word", "", ""))
    yield from (chips[state] for state in numbers[head + left_out :])


def _wrapped(chips: Sequence[Chip], width: float) -> Iterator[list[Chip]]:
    """The chips in lines of a width."""
    line: list[Chip] = []
    taken = 0.0
    for chip in chips:
        if line and taken + chip.width > width:
            yield line
            line, taken = [], 0.0
        line.append(chip)
        taken += chip.width + BETWEEN
    yield line


def _module_chip(view: StepView, state: int) -> Chip:
    module, system = view.word.states.modules[state], view.word.states.system
    label = (*label_parts(module.symbol, system), values_text(module))
    return _chip(tuple(map(_short, label)), colours(system).get(module.symbol, ""), state in view.marked)


def _chip(label: tuple[str, ...], colour: str = "", marked: bool = False) -> Chip:
    letter, subscript, values = label
    return Chip((letter, subscript, values), label_width((letter, subscript, values), LETTER) + 2 * INSIDE, colour, marked)


def _short(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"
