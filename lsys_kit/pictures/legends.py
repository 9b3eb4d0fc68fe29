"""Legends: which colour stands for which symbol, below a picture, and which commands the turtle has passed over."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from lsys_kit.derivation.core.states import States
from lsys_kit.geometry.scene import OWN, Scene
from lsys_kit.geometry.turtle.commands import RAMP_END, RAMP_START
from lsys_kit.geometry.turtle.surfaces import passed_over
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.formats.painting import painted
from lsys_kit.pictures.formats.vector.reading import drawing_of
from lsys_kit.pictures.nets.parts import width_of
from lsys_kit.pictures.rendering.frames import MARGIN
from lsys_kit.pictures.style.labels import escaped, label_parts, letter_svg, polar_symbols
from lsys_kit.pictures.style.palette import CHOSEN, RAMP, colour_of
from lsys_kit.pictures.style.themes import line, theme
from lsys_kit.pictures.svg import document

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from PIL.Image import Image

Label: TypeAlias = tuple[str, str, str]
"""A letter, its subscript, and what stands behind it, upright."""
TEXT, LINE, SWATCH, HIGH, GAP, NARROWEST = 13, 20, 24, 11, 18, 150
"""The size of letters, the height of a line, the width and height of a swatch, the space between entries, and the least width
of a legend, in pixels."""
MOST_WITHOUT_LETTERS = 2
"""Of more kinds of cells each has its letter, because their colours differ too little in grey."""
NATURAL = "natural colours, from the stem to the tips"
_HEAD = re.compile(r'viewBox="0 0 (\d+) (\d+)" width="(\d+)" height="(\d+)"')


class Entry(NamedTuple):
    """What a colour, or a ramp of several, stands for; without colours a remark."""

    colours: tuple[str, ...]
    label: Label

    @property
    def width(self) -> float:
        """An upper estimate of its width, in pixels."""
        return (SWATCH + 6) * bool(self.colours) + width_of("".join(self.label), TEXT)


@dataclass(frozen=True)
class Legend:
    """What the colours of a picture stand for."""

    entries: tuple[Entry, ...]

    def lines(self, width: float) -> list[list[tuple[float, Entry]]]:
        """The lines in a width, each with its entries and where these begin."""
        found: list[list[tuple[float, Entry]]] = [[]]
        x = 0.0
        for entry in self.entries:
            if found[-1] and (x + entry.width > width or not entry.colours):
                found.append([])
                x = 0.0
            found[-1].append((x, entry))
            x += entry.width + GAP
        return found

    def size(self, width: float) -> tuple[int, int]:
        """The width and height of a picture of some width with the legend, and of the legend."""
        wide = max([width - 2 * MARGIN, NARROWEST, *(entry.width for entry in self.entries)])
        return round(wide) + 2 * MARGIN, LINE * len(self.lines(wide)) + MARGIN


def legend_of(tables: Sequence[States], scenes: Sequence[Scene]) -> Legend:
    """The legend of scenes of some words, given the states of each.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.notation.read import read
    >>> word = derive(read("axiom: F ;(3) F RX"), 0)
    >>> [(entry.colours, "".join(entry.label)) for entry in legend_of([word.states], [scene_of(word)]).entries]
    [(('#28A964',), 'F'), (('#3BA7A0',), 'colour 3')]
    """
    numbers, seen = set[int](), dict[Label, str]()
    for states, scene in zip(tables, scenes, strict=True):
        used = set[int]()
        for kind in (scene.segments, scene.polygons, scene.discs):
            colours = np.broadcast_to(kind.colours, len(kind))
            used |= {*np.unique(kind.states[colours == OWN]).tolist()}
            numbers |= {*np.unique(colours[colours != OWN] % len(CHOSEN)).tolist()}
        used |= {*np.unique(np.concatenate([scene.cells.states, scene.walls.states])).tolist()}
        modules = [states.modules[state] for state in sorted(used)]
        seen |= {_label(module.symbol, states.system): colour_of(module.symbol, states.system) for module in modules}
    ramp = {number for number in numbers if RAMP_START <= number <= RAMP_END}
    entries = [Entry((colour,), label) for label, colour in seen.items()]
    entries += [Entry((CHOSEN[number],), ("", "", f"colour {number}")) for number in sorted(numbers - ramp)]
    entries += [Entry(RAMP, ("", "", NATURAL))] * bool(ramp)
    remarks = dict.fromkeys(filter(None, (passed_over(scene.unknown) for scene in scenes)))
    return Legend((*entries, *(Entry((), ("", "", remark)) for remark in remarks)))


def letters_of(states: States, scenes: Sequence[Scene], labels: bool | None = None) -> Mapping[int, str]:
    """What is written into cells, by their states: their letters if labels are wanted, or if there are many and nobody says.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.notation.read import read
    >>> word = derive(read("axiom: ar al\\ninterpretation:\\nar -> R(1,1)\\nal -> L(1,1)"), 0)
    >>> letters_of(word.states, [scene_of(word)], True), letters_of(word.states, [scene_of(word)])
    ({0: 'a', 1: 'a'}, {})
    """
    cells = np.unique(np.concatenate([scene.cells.states for scene in scenes])).tolist()
    letters = {state: _label(states.modules[state].symbol, states.system)[0] for state in cells}
    many = len({*letters.values()}) > MOST_WITHOUT_LETTERS
    return letters if labels or (many and labels is None) else {}


def _label(symbol: str, system: LSystem) -> Label:
    """The label of a symbol, without the polarity, of which both have one colour."""
    if symbol in polar_symbols(system):
        return polar_symbols(system)[symbol][0], "", ""
    return (*label_parts(symbol, system), "")


# --- in each format ----------------------------------------------------------------------------------------------------------


def with_legend(svg: str, legend: Legend | None) -> str:
    """A whole SVG picture with a legend below it."""
    found = _HEAD.search(svg)
    if legend is None or found is None:
        return svg
    across, _, width, height = map(int, found.groups())
    wide, more = legend.size(width)
    parts, aside = across // width, (wide - width) // 2
    head = f'viewBox="0 0 {wide * parts} {(height + more) * parts}" width="{wide}" height="{height + more}"'
    title, body = svg[found.end() :].removesuffix("</svg>").split("</title>", 1)
    paper = (
        ""
        if theme().transparent
        else f'<rect width="{wide * parts}" height="{(height + more) * parts}" fill="{theme().ground}"/>'
    )
    moved = f'<g transform="translate({aside * parts} 0)">{body}</g>' if aside else body
    return (
        f"{svg[: found.start()]}{head}{title}</title>{paper}{moved}"
        f'<g class="legend" transform="translate({MARGIN * parts} {height * parts}) scale({parts})" '
        f'font-family="sans-serif" font-size="{TEXT}" fill="{theme().ink}">{_entries_svg(legend, wide)}</g></svg>'
    )


def _entries_svg(legend: Legend, width: float) -> str:
    texts = []
    for x, y, entry in _placed(legend, width):
        step = SWATCH / max(len(entry.colours), 1)
        texts += [
            f'<rect x="{x + number * step:.1f}" y="{y - HIGH + 1:.1f}" width="{step:.1f}" height="{HIGH}" '
            f'fill="{line(colour)}"/>'
            for number, colour in enumerate(entry.colours)
        ]
        texts.append(
            f'<text x="{_text_place(x, entry):.1f}" y="{y:.1f}">{letter_svg(*entry.label[:2])}{escaped(entry.label[2])}</text>'
        )
    return "".join(texts)


def _placed(legend: Legend, width: float) -> Iterator[tuple[float, float, Entry]]:
    """Each entry with the left end of its baseline, from the corner of the legend."""
    for number, entries in enumerate(legend.lines(width - 2 * MARGIN)):
        for x, entry in entries:
            yield x, number * LINE + TEXT, entry


def _text_place(x: float, entry: Entry) -> float:
    return x + (SWATCH + 6) * bool(entry.colours)


def image_with_legend(image: Image, legend: Legend | None, enlarged: float = 1.0) -> Image:
    """An image, enlarged by a factor, with a legend below it, if there is one."""
    if legend is None:
        return image
    from PIL import Image

    drawn = painted(drawing_of(with_legend(document("", round(image.width / enlarged), 0, ""), legend)), enlarged)
    whole = Image.new("RGB", (drawn.width, image.height + drawn.height), theme().ground)
    whole.paste(image, ((whole.width - image.width) // 2, 0))
    whole.paste(drawn, (0, image.height))
    return whole


def plot_legend(ax: Axes, legend: Legend) -> None:
    """A legend below axes."""
    from matplotlib.patches import Patch

    handles = [
        Patch(color=line(entry.colours[len(entry.colours) // 2]) if entry.colours else "none", label=_plain(entry.label))
        for entry in legend.entries
    ]
    ax.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), frameon=False, labelcolor=theme().ink, ncols=4)


def _plain(label: Label) -> str:
    letter, subscript, values = label
    return f"{letter}_{subscript}{values}" if subscript else f"{letter}{values}"
