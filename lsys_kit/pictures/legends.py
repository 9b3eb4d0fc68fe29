"""Legends: which colour stands for which symbol, below a picture, and which commands the turtle has passed over."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.derivation.core.states import States
from lsys_kit.geometry.scene import OWN, Scene
from lsys_kit.geometry.turtle.commands import RAMP_END, RAMP_START
from lsys_kit.geometry.turtle.surfaces import passed_over
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.formats.painting import painted
from lsys_kit.pictures.nets.parts import width_of
from lsys_kit.pictures.rendering.frames import MARGIN
from lsys_kit.pictures.rendering.light import sunlit_colours
from lsys_kit.pictures.shapes import Drawing, Group, Look, Place, Rectangle, Shape, Text
from lsys_kit.pictures.sizes import document
from lsys_kit.pictures.style.labels import label_parts, label_spans, polar_symbols
from lsys_kit.pictures.style.palette import CHOSEN, RAMP, colour_of
from lsys_kit.pictures.style.themes import line, theme

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


def legend_of(tables: Sequence[States], scenes: Sequence[Scene], lit: bool = False) -> Legend:
    """The legend of scenes of some words, given the states of each; perhaps of scenes in sun and sky.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
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
    found = Legend((*entries, *(Entry((), ("", "", remark)) for remark in remarks)))
    return in_sunlight(found) if lit else found


def in_sunlight(legend: Legend) -> Legend:
    """A legend with the colours that things have in sunlight."""
    return Legend(tuple(entry._replace(colours=tuple(sunlit_colours(entry.colours))) for entry in legend.entries))


def letters_of(states: States, scenes: Sequence[Scene], labels: bool | None = None) -> Mapping[int, str]:
    """What is written into cells, by their states: their letters if labels are wanted, or if there are many and nobody says.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
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


# --- in each format ---


def with_legend(drawing: Drawing, legend: Legend | None) -> Drawing:
    """A picture with a legend below it."""
    if legend is None:
        return drawing
    wide, more = legend.size(drawing.width)
    parts, aside = drawing.box[2] // drawing.width, (wide - drawing.width) // 2
    moved = [Group(drawing.shapes, place=Place(1, aside * parts, 0))] if aside else drawing.shapes
    look = Look(font_family="sans-serif", font_size=TEXT, fill=theme().ink)
    place = Place(parts, MARGIN * parts, drawing.height * parts)
    below = Group([*_entries(legend, wide)], look, {"class": "legend"}, place)
    return document([*moved, below], wide, drawing.height + more, drawing.title, parts)


def _entries(legend: Legend, width: float) -> Iterator[Shape]:
    for number, entries in enumerate(legend.lines(width - 2 * MARGIN)):
        for x, entry in entries:
            y, step = float(number * LINE + TEXT), SWATCH / max(len(entry.colours), 1)
            for along, colour in enumerate(entry.colours):
                yield Rectangle(x + along * step, y - HIGH + 1, step, HIGH, look=Look(fill=line(colour)))
            written = [*label_spans(*entry.label[:2]), entry.label[2]]
            yield Text(x + (SWATCH + 6) * bool(entry.colours), y, written)


def image_with_legend(image: Image, legend: Legend | None, enlarged: float = 1.0) -> Image:
    """An image, enlarged by a factor, with a legend below it, if there is one."""
    if legend is None:
        return image
    from PIL import Image

    drawn = painted(with_legend(document([], round(image.width / enlarged), 0, ""), legend), enlarged)
    whole = Image.new("RGB", (drawn.width, image.height + drawn.height), theme().ground)
    whole.paste(image, ((whole.width - image.width) // 2, 0))
    whole.paste(drawn, (0, image.height))
    return whole


def plot_legend(ax: Axes, legend: Legend) -> None:
    """A legend below axes, whose entries the axes know."""
    from matplotlib.patches import Rectangle as Swatch

    handles = [
        Swatch(
            (0, 0),
            0,
            0,
            linewidth=0,
            color=line(colours[len(colours) // 2]) if colours else "none",
            label=f"{letter}_{subscript}{values}" if subscript else f"{letter}{values}",
        )
        for colours, (letter, subscript, values) in legend.entries
    ]
    for handle in handles:
        ax.add_artist(handle)
    ax.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), frameon=False, labelcolor=theme().ink, ncols=4)
