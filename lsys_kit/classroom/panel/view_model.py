"""What a system looks like at a step, for given constants, each computed once; and one picture of it, with the word, the stage
diagram and the drawing, for a page without a kernel and for paper. Its pixels are the same on every machine, so that stored
notebooks are.
"""

from __future__ import annotations

import io
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple, TypeAlias

from lsys_kit.cache import Cache
from lsys_kit.classroom.panel.books.net import Unfolding, net_of
from lsys_kit.classroom.panel.labels import noun_of
from lsys_kit.derivation.core.letters import conditions_text
from lsys_kit.derivation.core.words import Word, shortened
from lsys_kit.derivation.derive import Choices, Derivation
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.geometry.drawing import coloured, scene_of
from lsys_kit.geometry.filament import filament
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.geometry.turtle.plane import Path, place_path, trace
from lsys_kit.notation.model.arithmetic import Value, number_of
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.draw import MOST_ROWS, filament_picture, state_colours
from lsys_kit.pictures.filaments import FilamentRow
from lsys_kit.pictures.formats.lettering import advance
from lsys_kit.pictures.formats.painting import PixelPainter, Sheet, label_width
from lsys_kit.pictures.nets.diagram import drawn_stages
from lsys_kit.pictures.nets.parts import parts_of
from lsys_kit.pictures.picture import Picture
from lsys_kit.pictures.rendering.frames import in_units
from lsys_kit.pictures.rendering.view import project_smoothly
from lsys_kit.pictures.shapes import Place
from lsys_kit.pictures.style.labels import label_parts, place_text, shared_formulas, steering_of, values_text
from lsys_kit.pictures.style.palette import INK, MARK, MARK_EDGE, QUIET, colours, tinted
from lsys_kit.worlds.derive import derive

DERIVATION_BYTES, SHAPE_BYTES = 16 * 2**20, 100
"""About what a derivation and a shape take in memory."""
SHARE = 1 / 8
"""The part of the limit of bytes up to which each kind of result is kept."""


@dataclass(frozen=True)
class StepView:
    """What is shown for one step: its word, the stage diagram with the number of modules in each place, the states that are
    marked, and what is drawn, as a scene and as a picture from one side; and the word with formulas, where constants are
    letters.
    """

    step: int
    word: Word
    net: Stages
    tokens: tuple[int, ...]
    marked: frozenset[int]
    scene: Scene
    picture: Picture
    lettered: Word | None = None

    @property
    def said(self) -> Word:
        """The word as it is shown: with formulas, where constants are letters."""
        return self.word if self.lettered is None else self.lettered

    @property
    def named(self) -> Stages:
        """The net as it is shown: its stages named by the formulas that their modules have in common."""
        if self.lettered is None:
            return self.net
        found: dict[int | None, list[Module]] = {}
        for module in self.lettered.states.modules:
            number = self.net.place_of(Module(module.symbol, tuple(map(number_of, module.arguments))))
            found.setdefault(number, []).append(module)
        places = (
            replace(place, modules=tuple(Module(each.symbol, shared) for each in place.modules))
            if (shared := shared_formulas(found.get(number, ())))
            else place
            for number, place in enumerate(self.net.places)
        )
        return replace(self.net, places=tuple(places))

    @property
    def size(self) -> str:
        """How many cells or strokes and modules there are, in the words of the system, as in the line of a panel."""
        system = self.net.system
        is_filament, modules = drawing_mode(system) is DrawingMode.FILAMENT, _counted(len(self.word), noun_of(system))
        seen = len(self.scene.cells if is_filament else self.scene.segments)
        if is_filament and seen == len(self.word):
            return _counted(seen, "cell")
        return f"{_counted(seen, 'cell' if is_filament else 'stroke')}, {modules}" if seen else modules

    @property
    def svg(self) -> str:
        """The drawing as SVG text."""
        return self.picture.svg

    def told(self, show: Collection[str]) -> str:
        """What there is to see in words; the stages where they are among the views that are shown."""
        places = [
            f"{place_text(place, self.net.system)}: {count:,}"
            for place, count in zip(self.named.places, self.tokens, strict=True)
            if place.symbol[0].isalpha()
        ]
        stages = f" Stages {', '.join(places)}." if "stages" in show else ""
        measures = self.scene.measures if self.scene.size else "nothing to draw"
        held = conditions_text(self.said.states)
        formulas = f" {held}" if held else ""
        return f"Step {self.step}: {self.size}. {shortened(self.said, 160)}.{formulas}{stages} {measures.capitalize()}."

    def __str__(self) -> str:
        return self.told(STILL)


def _counted(number: int, noun: str) -> str:
    return f"{number:,} {noun}{'s' * (number != 1)}"


class ViewModel:
    """A system under changing constants: its derivations, nets, scenes and paths, each computed once.

    >>> from lsys_kit.classroom.catalogue import system
    >>> print(ViewModel(system("J4")).sight(3, {"lifeTimeB": 5}))
    Step 3: 2 cells. Al(1)Br(1). Stages A(1): 1, A(2): 0, A(3): 0, B(1): 1, B(2): 0, B(3): 0, B(4): 0, B(5): 0. \
    Width 3, height 1.
    """

    def __init__(self, system: LSystem, seed: int | None = None, unfold: Unfolding = False) -> None:
        self.system, self.seed, self.mode, self._unfold = system, seed, drawing_mode(system), unfold
        self._known = Cache[tuple[object, ...], tuple[Derivation, Stages]](lambda _: DERIVATION_BYTES, SHARE)
        self._rows = Cache[tuple[tuple[Value, ...], int], FilamentRow](lambda row: row.scene.size * SHAPE_BYTES, SHARE)
        self._paths = Cache[tuple[tuple[Value, ...], int], Path](lambda path: len(path.turns) * SHAPE_BYTES, SHARE)
        self._scenes = Cache[tuple[tuple[Value, ...], int, float], Scene](lambda scene: scene.size * SHAPE_BYTES, SHARE)

    def known(self, constants: Mapping[str, object]) -> tuple[Derivation, Stages]:
        """The derivation and the net for given constants."""
        key = tuple(constants.items())
        given: Choices = dict(constants)
        return self._known.found(
            key, lambda: (derive(self.system, 0, seed=self.seed, **given), net_of(self.system, given, self._unfold))
        )

    def sight(
        self,
        step: int,
        constants: Mapping[str, object],
        angle: float | None = None,
        place: int = -1,
        around: float = 0.0,
        above: float = 0.0,
        letters: Collection[str] = (),
    ) -> StepView:
        """What there is to see at a step, with the turtle's angle, by default the system's, with a stage that is marked, -1
        for none, and seen from a side, as `project` counts; some constants as letters.
        """
        derivation, net = self.known(constants)
        derivation = derivation.to(step)
        word = derivation[step]
        marked = frozenset(s for s, module in enumerate(word.states.modules) if net.place_of(module) == place)
        turn = float(self.system.angle) if angle is None else angle
        path = self._path(derivation, step) if self.mode is DrawingMode.PLANE else None
        if self.mode is DrawingMode.FILAMENT:
            rows = self._sequence(derivation, step)
            scene = rows[-1].scene
            picture = filament_picture(derivation, rows, step, marked)
        else:
            scene = (
                coloured(place_path(path, turn, float(self.system.heading)), self.system)
                if path is not None
                else self._scene(derivation, turn)
            )
            [scene] = in_units([scene], self.system)
            [seen] = project_smoothly([scene], (around, above))
            picture = Picture(
                (FilamentRow(step, seen),), state_colours(derivation), None, marked, scene if scene.dimension == 3 else None
            )
        given: Choices = dict(constants)
        lettered = derive(self.system, 0, seed=self.seed, letters=letters, **given).to(step)[step] if letters else None
        return StepView(step, word, net, net.tokens(word), marked, scene, picture, lettered)

    def _sequence(self, derivation: Derivation, last: int) -> tuple[FilamentRow, ...]:
        constants = derivation.states.constants
        steps = range(max(0, last + 1 - MOST_ROWS), last + 1)
        return tuple(self._rows.found((constants, step), partial(_row, derivation, step)) for step in steps)

    def _path(self, derivation: Derivation, step: int) -> Path:
        key = derivation.states.constants, step
        return self._paths.found(key, lambda: trace(derivation[step]))

    def _scene(self, derivation: Derivation, angle: float) -> Scene:
        key = derivation.states.constants, derivation.steps, angle
        return self._scenes.found(key, lambda: scene_of(derivation, angle))


def _row(derivation: Derivation, step: int) -> FilamentRow:
    return FilamentRow(step, filament(derivation[step]))


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


_States: TypeAlias = tuple[int, int]
"""The state of a module, and what it is in the word as it is shown."""
STILL = ("word", "stages", "drawing")
"""The views of which there are still pictures."""
BESIDE = 1400
"""Two pictures stand side by side if they are no wider together, else one above the other."""


def composite_png(view: StepView, show: Collection[str] = STILL) -> bytes:
    """The word, the stage diagram and the drawing of a step as one PNG picture, or those of them that are to be shown; where
    none is, the drawing.

    >>> from lsys_kit.classroom.catalogue import system
    >>> from lsys_kit.classroom.panel.view_model import ViewModel
    >>> from PIL import Image
    >>> Image.open(io.BytesIO(composite_png(ViewModel(system("J4")).sight(9, {})))).size
    (968, 595)
    """
    from PIL import Image

    shown = [each for each in STILL if each in show] or [STILL[-1]]
    net = parts_of(view.named, False, steering_of(view.net.system)) if "stages" in shown else None
    drawing = Image.open(io.BytesIO(view.picture.png)) if "drawing" in shown else None
    across, down = (net.width, net.height) if net else (0, 0)
    wide, high = drawing.size if drawing else (0, 0)
    gap = GAP if net and drawing else 0
    most, together = WIDEST - 2 * MARGIN, across + gap + wide
    beside = together <= most
    inner = min(most, max(NARROWEST, together if beside else across, wide))
    unit = min(1.0, inner / across) if net else 1.0
    lines, place = lines_of(view, inner) if "word" in shown else [], (across + gap, 0.0) if beside else (0.0, down * unit + gap)
    top = MARGIN + ABOVE + (LINE * len(lines) + GAP if lines else 0)
    sheet = Sheet(inner + 2 * MARGIN, round(top + max(down * unit, place[1] + high) + MARGIN))
    _paint_title(sheet.part(MARGIN, MARGIN), view, inner)
    if lines:
        _paint_heading(sheet.part(MARGIN, MARGIN + ABOVE), "word")
        _paint_word(sheet.part(MARGIN, MARGIN + ABOVE), lines)
    if net:
        _paint_heading(sheet.part(MARGIN, top), "stages")
        marked = {view.net.place_of(view.word.states.modules[state]) for state in view.marked}
        PixelPainter(sheet, Place(unit, MARGIN, top)).draw(drawn_stages(view.named, view.tokens, marked=marked))
    if drawing:
        _paint_heading(sheet.part(MARGIN + place[0], top + place[1]), "drawing")
        sheet.picture(MARGIN + place[0], top + place[1], drawing)
    return sheet.png


def both_png(left: bytes, right: bytes) -> bytes:
    """Two pictures as one, side by side where there is room, else the left one above the right one."""
    from PIL import Image

    pictures = [Image.open(io.BytesIO(each)).convert("RGB") for each in (left, right)]
    (wide, high), (width, height) = (each.size for each in pictures)
    beside = wide + width <= BESIDE
    sheet = Sheet(wide + width if beside else max(wide, width), max(high, height) if beside else high + height)
    sheet.picture(0, 0, pictures[0])
    sheet.picture(*((wide, 0) if beside else (0, high)), pictures[1])
    return sheet.png


def _paint_title(sheet: Sheet, view: StepView, width: float) -> None:
    said = f"{view.size}; {view.scene.measures if view.scene.size else 'nothing to draw'}"
    start = sheet.text(0, TITLE, f"step {view.step}", TITLE) + 18
    while start + advance(said, STATUS) > width:
        said = f"{said[:-2]}…"
    sheet.text(start, TITLE, said, STATUS, QUIET)


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
    numbers, kept = [*zip(view.word.numbers(), view.said.numbers(), strict=True)], min(len(view.word), MOST)
    chips = {states: _module_chip(view, *states) for states in {*numbers[:kept], *numbers[-kept:]}}
    while True:
        lines = [*_wrapped([*_abridged(numbers, kept, chips)], width)]
        if len(lines) <= LINES:
            return lines
        kept -= max(1, kept * (len(lines) - LINES) // len(lines) - 1)


def _abridged(numbers: Sequence[_States], kept: int, chips: Mapping[_States, Chip]) -> Iterator[Chip]:
    """The first and the last modules of a word, so many together, and how many there are between them."""
    head, left_out = (kept + 1) // 2, len(numbers) - kept
    yield from (chips[states] for states in numbers[:head])
    if left_out or not kept:
        yield _chip((f"… {left_out:,} more …" if left_out else "the empty word", "", ""))
    yield from (chips[states] for states in numbers[head + left_out :])


def _wrapped(chips: Sequence[Chip], width: float) -> Iterator[list[Chip]]:
    line: list[Chip] = []
    taken = 0.0
    for chip in chips:
        if line and taken + chip.width > width:
            yield line
            line, taken = [], 0.0
        line.append(chip)
        taken += chip.width + BETWEEN
    yield line


def _module_chip(view: StepView, state: int, said: int) -> Chip:
    module, system = view.said.states.modules[said], view.word.states.system
    label = (*label_parts(module.symbol, system), values_text(module))
    return _chip(tuple(map(_short, label)), colours(system).get(module.symbol, ""), state in view.marked)


def _chip(label: tuple[str, ...], colour: str = "", marked: bool = False) -> Chip:
    letter, subscript, values = label
    return Chip((letter, subscript, values), label_width((letter, subscript, values), LETTER) + 2 * INSIDE, colour, marked)


def _short(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"
