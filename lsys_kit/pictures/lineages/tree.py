"""The layout of a lineage: the positions of its lines, and the kinds of its cells.

A line stands above its cell in the filament of the last word; that of a mother half-way between her first and last daughter.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from lsys_kit.derivation.core.interpretation import interpretation_of, is_cell
from lsys_kit.derivation.petri.net import Place
from lsys_kit.derivation.timed.lineage import Lineage
from lsys_kit.geometry.filament import filament
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.modules import CELLS, Module
from lsys_kit.pictures.filaments.layout import DrawnCell
from lsys_kit.pictures.rendering.frames import MARGIN, WIDTH
from lsys_kit.pictures.shapes import Look, Span
from lsys_kit.pictures.style.labels import label_parts, label_spans, place_parts, polar_symbols
from lsys_kit.pictures.style.palette import colour_of

AXIS, HEAD, TREE = 54, 22, 300
"""Room for the axis of time, its heading and the tree, in pixels."""
BROADEST, APART = 30.0, 60.0
"""The most pixels for a unit of length of the filament below the tree; between lines where there is no filament."""
MOST_KINDS = 4
"""The greatest number of kinds of cells that are distinguished."""
DASHES = ("", "80 45", "1 45", "120 40 1 40")
"""The dash pattern of each kind of cells, in tenths of a pixel."""


@dataclass(frozen=True)
class CellKind:
    """Cells that were alike at birth.

    Attributes
    ----------
    label
        What they were, in pieces of text.
    characters
        The number of characters of the label.
    colour, dash
        The colour and the dash pattern of their lines.
    """

    label: Sequence[str | Span]
    characters: int
    colour: str
    dash: str

    @property
    def broken(self) -> Look:
        """How lines are broken."""
        return Look(stroke_dasharray=self.dash) if self.dash else Look()


@dataclass(frozen=True)
class Tree:
    """The layout of a lineage, in pixels.

    Attributes
    ----------
    lineage
        The lineage.
    x
        The horizontal position of the line of each cell.
    row
        The cells of the filament below, or none.
    kinds, kind_of
        The kinds of cells, and for each cell the number of its kind.
    colours
        For each cell of the last word its colour.
    right
        Where the tree ends.
    """

    lineage: Lineage
    x: Mapping[int, float]
    row: Sequence[DrawnCell]
    kinds: Sequence[CellKind]
    kind_of: Sequence[int]
    colours: Mapping[int, str]
    right: float

    def y(self, time: Value) -> float:
        """The vertical position of a time."""
        end = float(self.lineage.times[-1])
        return MARGIN + HEAD + (TREE * float(time) / end if end else 0.0)


def tree_of(lineage: Lineage, right: int = 0) -> Tree:
    """The tree of a lineage, with some room left free to its right."""
    x, row = _line_positions(lineage, WIDTH - MARGIN - right)
    kinds, kind_of, colour_of = _kinds(lineage)
    return Tree(lineage, x, row, kinds, kind_of, colour_of, WIDTH - MARGIN - right)


def _line_positions(lineage: Lineage, right: int) -> tuple[dict[int, float], list[DrawnCell]]:
    """The horizontal position of the line of each cell, and the filament below."""
    ends = list(_leaves(lineage))
    row = _filament(lineage, right) if ends == list(lineage.words[-1]) else []
    if row:
        x = {cell.state: cell.x for cell in row}
    else:
        apart = min(APART, (right - AXIS - 2 * MARGIN) / max(1, len(ends) - 1))
        left = (right + AXIS - apart * (len(ends) - 1)) / 2
        x = {cell: left + apart * place for place, cell in enumerate(ends)}
    for cell in range(len(lineage.cells) - 1, -1, -1):  # daughters stand behind their mothers
        if daughters := lineage.daughters(cell):
            x[cell] = (x[daughters[0]] + x[daughters[-1]]) / 2
    return x, row


def _leaves(lineage: Lineage) -> Iterator[int]:
    """The cells without daughters, from left to right."""
    todo = [cell for cell in range(len(lineage.cells) - 1, -1, -1) if lineage.cells[cell].mother is None]
    while todo:
        cell = todo.pop()
        daughters = lineage.daughters(cell)
        todo += reversed(daughters)
        if not daughters:
            yield cell


def _filament(lineage: Lineage, right: int) -> list[DrawnCell]:
    """The cells of the last word as they are drawn, each with the number of its cell; none where it is no filament."""
    scene = filament(lineage.last)
    if len(scene.cells) != len(lineage.words[-1]):
        return []
    scale = min((right - AXIS - MARGIN) / scene.width, BROADEST / scene.height) if len(scene.cells) else 1.0
    left = (right + AXIS - scene.width * scale) / 2
    cells = scene.cells
    return [
        DrawnCell(left + x * scale, length * scale / 2, width * scale / 2, way, shade, number)
        for number, (x, _), (length, width), way, shade in zip(
            lineage.words[-1],
            cells.centres.tolist(),
            cells.sizes.tolist(),
            cells.polarities.tolist(),
            cells.shades.tolist(),
            strict=True,
        )
    ]


def _kinds(lineage: Lineage) -> tuple[list[CellKind], list[int], dict[int, str]]:
    """The kinds of cells, for each cell the number of its kind, and the colours of the cells in the last word.

    Cells that look alike at birth are of one kind; if there are too many kinds, cells of one symbol are. The colour of a kind
    is that of its symbol, as in every other picture; dashes distinguish the kinds of one symbol.
    """
    births = [cell.at_birth for cell in lineage.cells]
    keys = [(_base(lineage, module), _drawn_shape(lineage, module)) for module in births]
    if len(set(keys)) > MOST_KINDS:
        keys = [(base, None) for base, _ in keys]
    numbers = {key: number for number, key in enumerate(dict.fromkeys(keys))}
    members: list[dict[Module, None]] = [{} for _ in numbers]
    for key, module in zip(keys, births, strict=True):
        members[numbers[key]][module] = None
    kinds = [_cell_kind(lineage, list(modules), number) for number, modules in enumerate(members)]
    system = lineage.states.system
    return (
        kinds,
        [numbers[key] for key in keys],
        {cell: colour_of(lineage.cells[cell].modules[-1][1].symbol, system) for cell in lineage.words[-1]},
    )


def _cell_kind(lineage: Lineage, modules: Sequence[Module], number: int) -> CellKind:
    system, symbol = lineage.states.system, modules[0].symbol
    letter, subscript, values = place_parts(Place(symbol, tuple(modules)), system)
    name = f"{letter}_{subscript}" if subscript else letter
    return CellKind(
        label_spans(*label_parts(name, system), values),
        len(name + values),
        colour_of(symbol, system),
        DASHES[number % len(DASHES)],
    )


def _base(lineage: Lineage, module: Module) -> str:
    """The symbol of a module without its polarity."""
    return polar_symbols(lineage.states.system).get(module.symbol, (module.symbol, ""))[0]


def _drawn_shape(lineage: Lineage, module: Module) -> object:
    """The drawn shape of a module without its polarity; its arguments, if it is not drawn as a cell."""
    return tuple(made.arguments for made in interpretation_of(lineage.states, module) if is_cell(made)) or module.arguments


def polarity_of(lineage: Lineage, module: Module) -> int:
    """The polarity of a cell: -1 to the left, 1 to the right, 0 for none."""
    drawn = [made for made in interpretation_of(lineage.states, module) if is_cell(made)]
    if drawn:
        return CELLS[drawn[0].symbol]
    return {"l": -1, "r": 1}.get(polar_symbols(lineage.states.system).get(module.symbol, ("", ""))[1], 0)
