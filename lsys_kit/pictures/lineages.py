"""Lineages as trees in continuous time (P. Prusinkiewicz, "Introduction to Modeling with L-systems",
figures 5 and 6).

Time runs down. A line is a cell from its birth to its division, thin until the first word that has it, so that what happens
within a step is told from what the words show. Cells have the colour of their symbol, as in the filament; those that began
alike have the same dashes. A flag shows where a cell points. Where a cell divides late, a broad band begins at the time at
which it should have divided. Below the tree stands the last word, each cell at the end of its line.

A line stands above its cell in the filament of the last word; that of a mother half-way between her first and last daughter.
What only steers the turtle has none. Where lines would be dense, those of cells of a kind that never divides are fine and pale.
Where they would be too dense, sisters side by side that are alike and stay so share one; if that does not help, the tree has
the first steps alone, and says so.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, takewhile
from typing import TYPE_CHECKING

from lsys_kit.budget import current
from lsys_kit.derivation.core.interpretation import interpretation_of, is_cell, is_filament
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.derivation.petri.net import Place as Stage
from lsys_kit.derivation.timed.lineage import Lineage
from lsys_kit.errors import ModelLimitError, ModelValueError, require, shown
from lsys_kit.geometry.filament import filament
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.modules import CELLS, Module
from lsys_kit.pictures.filaments import DrawnCell, drawn_cells, filament_shapes, tenths, time_text
from lsys_kit.pictures.formats.notebook import SVGPicture
from lsys_kit.pictures.rendering.frames import MARGIN, WIDTH
from lsys_kit.pictures.shapes import Drawing, Group, Look, Path, Place, Shape, Span, Text
from lsys_kit.pictures.sizes import document
from lsys_kit.pictures.style.labels import label_parts, label_spans, place_parts, polar_symbols, steering_of, values_text
from lsys_kit.pictures.style.palette import LABELLED, QUIET, VERMILION, colour_of, colours, tinted
from lsys_kit.pictures.style.themes import line, theme

if TYPE_CHECKING:
    from PIL.Image import Image


AXIS, HEAD, TREE = 54, 22, 300
"""Room for the axis of time, its heading and the tree, in pixels."""
BROADEST, APART, DENSE, DENSEST = 30.0, 60.0, 9.0, 6.0
"""The most pixels for a unit of length of the filament below the tree; between lines where there is no filament; and lines that
would be closer than this are dense, or too dense."""
MOST_KINDS = 4
"""The greatest number of kinds of cells that are distinguished."""
DASHES = ("", "80 45", "1 45", "120 40 1 40", "160 60", "60 40 1 40 1 40")
"""The dash pattern of each kind of cells, in tenths of a pixel."""


@dataclass(frozen=True)
class CellKind:
    """Cells that were alike at birth: what they were, in pieces of text of so many characters; the look of their lines."""

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
    """The layout of a lineage, in pixels: the horizontal position of the line of each cell; the cells of the filament below, or
    none; the kinds of cells, and for each cell the number of its kind; for each cell of the last word its colour; where the
    tree ends to the right; and the kinds of cells that are pale."""

    lineage: Lineage
    x: Mapping[int, float]
    row: Sequence[DrawnCell]
    kinds: Sequence[CellKind]
    kind_of: Mapping[int, int]
    colours: Mapping[int, str]
    right: float
    pale: Collection[int] = ()

    def y(self, time: Value) -> float:
        """The vertical position of a time."""
        end = float(self.lineage.times[-1])
        return MARGIN + HEAD + (TREE * float(time) / end if end else 0.0)


def tree_of(lineage: Lineage, right: int = 0) -> Tree:
    """The tree of a lineage, with some room left free to its right."""
    right = WIDTH - MARGIN - right
    x, row, dense = _line_positions(lineage, right)
    kinds, kind_of, ends = _kinds(lineage, sorted(x))
    dividing = {kind_of[cell] for cell in x if lineage.daughters(cell)}
    return Tree(lineage, x, row, kinds, kind_of, ends, right, {*kind_of.values()} - dividing if dense else ())


def _line_positions(lineage: Lineage, right: int) -> tuple[dict[int, float], list[DrawnCell], bool]:
    """The horizontal position of the line of each cell that has one, the filament below, and whether lines are dense."""
    ends, dense = list(_leaves(lineage)), False
    row = _filament(lineage, right) if ends == list(lineage.words[-1]) else []
    if row:
        x = {cell.state: cell.x for cell in row}
    else:
        room = right - AXIS - 2 * MARGIN
        ends, dense = _ends_with_lines(lineage, ends, room)
        apart = min(APART, room / max(1, len(ends) - 1))
        left = (right + AXIS - apart * (len(ends) - 1)) / 2
        x = {cell: left + apart * place for place, cell in enumerate(ends)}
    for cell in range(len(lineage.cells) - 1, -1, -1):  # daughters stand behind their mothers
        if daughters := [daughter for daughter in lineage.daughters(cell) if daughter in x]:
            x[cell] = (x[daughters[0]] + x[daughters[-1]]) / 2
    return x, row, dense


def _ends_with_lines(lineage: Lineage, ends: Sequence[int], room: float) -> tuple[list[int], bool]:
    """Those of the cells at the ends of a tree that have lines in some room, and whether lines would be dense without that."""
    hidden = _without_line(lineage)
    lines = [cell for cell in ends if cell not in hidden]
    apart = room / max(1, len(lines) - 1)
    if apart < DENSEST:
        lines = lines[:1] + [cell for before, cell in pairwise(lines) if not _alike(lineage, before, cell)]
    return lines, apart < DENSE


def _legible(lineage: Lineage) -> Lineage:
    """A lineage of steps without a filament below it as far as its lines are not too dense."""
    steps, room = len(lineage.times) - 1, WIDTH - AXIS - 3 * MARGIN
    if steps < 2 or not lineage.stepwise or _filament(lineage, WIDTH - MARGIN):
        return lineage

    def legible(first: Lineage) -> bool:
        lines, _ = _ends_with_lines(first, [*_leaves(first)], room)
        return len(first.words[-1]) <= MOST_LINES and len(lines) <= room / DENSEST + 1

    firsts = (_first_steps(lineage, step) for step in range(1, steps + 1))
    return max(takewhile(legible, firsts), key=lambda first: len(first.times), default=_first_steps(lineage, 1))


def _first_steps(lineage: Lineage, step: int) -> Lineage:
    """The part of a lineage until a step, whose cells live on there; its last word stays that of the end."""
    if step == len(lineage.times) - 1:
        return lineage
    words = lineage.words[: step + 1]
    living, many = {*words[-1]}, 1 + max(cell for word in words for cell in word)
    cells = [
        replace(cell, ended=None, due=None) if number in living else cell for number, cell in enumerate(lineage.cells[:many])
    ]
    return replace(lineage, cells=tuple(cells), words=words, times=lineage.times[: step + 1])


def _without_line(lineage: Lineage) -> set[int]:
    """The cells that only steer the turtle, never become anything else, and have sisters that do not."""
    system = lineage.states.system
    signs = steering_of(system) - {rule.predecessor.symbol for rule in (*system.productions, *system.decomposition)}
    families: dict[int | None, list[int]] = {}
    for number, cell in enumerate(lineage.cells):
        families.setdefault(cell.mother, []).append(number)
    found = set[int]()
    for family in families.values():
        steering = {cell for cell in family if lineage.cells[cell].at_birth.symbol in signs}
        found |= steering if len(steering) < len(family) else set()
    return found


def _alike(lineage: Lineage, before: int, after: int) -> bool:
    """Whether two cells that do not divide are sisters of one kind with the same end."""
    one, other = lineage.cells[before], lineage.cells[after]
    same = one.mother == other.mother is not None and one.ended == other.ended
    return same and _base(lineage, one.at_birth) == _base(lineage, other.at_birth)


def _leaves(lineage: Lineage) -> Iterator[int]:
    todo = [cell for cell in range(len(lineage.cells) - 1, -1, -1) if lineage.cells[cell].mother is None]
    while todo:
        cell = todo.pop()
        daughters = lineage.daughters(cell)
        todo += reversed(daughters)
        if not daughters:
            yield cell


def _filament(lineage: Lineage, right: int) -> list[DrawnCell]:
    """The cells of the last word as they are drawn, each with the number of its cell; none where it is no filament."""
    if not is_filament(lineage.states.system):
        return []
    scene = filament(lineage.last)
    if len(scene.cells) != len(lineage.words[-1]):
        return []
    scale = min((right - AXIS - MARGIN) / scene.width, BROADEST / scene.height) if len(scene.cells) else 1.0
    left = (right + AXIS - scene.width * scale) / 2
    return [
        cell._replace(x=left + cell.x, state=number)
        for number, cell in zip(lineage.words[-1], drawn_cells(scene.cells, scale), strict=True)
    ]


def _kinds(lineage: Lineage, cells: Sequence[int]) -> tuple[list[CellKind], dict[int, int], dict[int, str]]:
    """The kinds of cells that have lines, for each of these the number of its kind, and the colours of the cells in the last
    word.

    Cells that look alike at birth are of one kind; if there are too many kinds, cells of one symbol are. The colour of a kind
    is that of its symbol, as in every other picture; dashes distinguish the kinds of one colour.
    """
    births = [lineage.cells[cell].at_birth for cell in cells]
    keys = [(_base(lineage, module), _drawn_shape(lineage, module)) for module in births]
    if len(set(keys)) > MOST_KINDS:
        keys = [(base, None) for base, _ in keys]
    members: dict[tuple[str, object], dict[Module, None]] = {}
    for key, module in zip(keys, births, strict=True):
        members.setdefault(key, {})[module] = None
    numbers = {key: number for number, key in enumerate(members)}
    system, kinds = lineage.states.system, list[CellKind]()
    for number, modules in enumerate(members.values()):
        symbol = next(iter(modules)).symbol
        colour = colours(system).get(symbol, QUIET)
        taken = [kind.dash for kind in kinds if kind.colour == colour]
        order = [*DASHES[number % 4 :], *DASHES[: number % 4]]
        dash = min(order, key=taken.count)
        letter, subscript, values = place_parts(Stage(symbol, tuple(modules)), system)
        name = f"{letter}_{subscript}" if subscript else letter
        kinds.append(CellKind(label_spans(*label_parts(name, system), values), len(name + values), colour, dash))
    ends = {cell: colour_of(lineage.cells[cell].modules[-1][1].symbol, system) for cell in lineage.words[-1]}
    return kinds, {cell: numbers[key] for cell, key in zip(cells, keys, strict=True)}, ends


def _base(lineage: Lineage, module: Module) -> str:
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


TAIL, BEND, BRACKET = 14.0, 6.0, 46
"""The length of lines below the last time, the radius of corners, and the width of an interval, in pixels."""
THICK, FINE, THIN, LATE = 24, 16, 11, 90
"""Widths of lines, in tenths of a pixel."""
LABEL, LETTER, SPACE = 6, 7, 3
"""How far the figures of a time reach below its line; the width of a letter, and what is left free between names, in pixels."""
ROW = 20
"""The height of a row of the legend, in pixels."""
MOST_LINES, MOST_TICKS = 400, 14
"""The greatest numbers of cells at the end, and of times on the axis."""


@dataclass(frozen=True)
class LineagePicture(SVGPicture):
    """A picture of a lineage, perhaps with intervals of time marked beside the tree, with times and the modules of the last
    word written, and with a legend; and of how many steps the lineage is, of which these may be the first."""

    lineage: Lineage
    intervals: tuple[tuple[Value, Value], ...] = ()
    labels: bool = True
    legend: bool = True
    steps: int = 0

    def _shown(self, most: int, enlarged: float) -> Drawing:
        """The tree, with what stands beside and below it."""
        return drawn_lineage(self.lineage, self.intervals, self.labels, self.legend, self._part)

    @property
    def _part(self) -> str:
        """Which steps are shown, where they are not all."""
        shown = len(self.lineage.times) - 1
        return f"steps 0 to {shown} of {self.steps}" if shown < self.steps else ""

    def film_images(self) -> Sequence[Image]:
        """The tree as it grows, one time after another; at the end with what stands below it."""
        from PIL import Image

        whole, tree = self.image(), tree_of(self.lineage, BRACKET * len(self.intervals))
        enlarged, images = whole.width / WIDTH, []
        for time in self.lineage.times[:-1]:
            image = Image.new("RGB", whole.size, theme().ground)
            image.paste(whole.crop((0, 0, whole.width, round((tree.y(time) + LABEL) * enlarged))))
            images.append(image)
        return [*images, whole]

    def __repr__(self) -> str:
        return f"lineage of {self.lineage}" + (f"; {self._part}" if self._part else "")


def _interval(given: object) -> tuple[Value, Value]:
    if not isinstance(given, Sequence) or len(given) != 2:
        raise ModelValueError(f"An interval is a pair of times, not {shown(given)}")
    return number_from(given[0], "interval"), number_from(given[1], "interval")


def lineage_picture(
    lineage: Lineage, intervals: Iterable[tuple[object, object]] = (), *, labels: bool = True, legend: bool = True
) -> LineagePicture:
    """The picture of a lineage, with some intervals of time marked that lie within its time."""
    require(intervals, Iterable, "A list of intervals, each a pair of times,")
    found, steps = tuple(map(_interval, intervals)), len(lineage.times) - 1
    lineage = lineage if found else _legible(lineage)
    living, cells, most = len(lineage.words[-1]), len(lineage.cells), current().segments
    if living > MOST_LINES:
        message = f"{living:,} cells are too many for a picture of their lineage; it can have {MOST_LINES}"
        raise ModelLimitError(message, limit=MOST_LINES, needed=living, hint="Take fewer steps.")
    if cells > most:
        message = f"The tree of this lineage would have {cells:,} lines; a picture may have {most:,}"
        raise ModelLimitError(message, limit=most, needed=cells, hint="Take fewer steps, or set limits(segments=...).")
    for first, last in found:
        if not 0 <= first < last <= lineage.times[-1]:
            raise ModelValueError(
                f"No interval from {time_text(first)} to {time_text(last)} can be marked",
                hint=f"The lineage lasts from 0 to {time_text(lineage.times[-1])}.",
            )
    return LineagePicture(lineage, found, labels, legend, steps)


def drawn_lineage(
    lineage: Lineage, intervals: Sequence[tuple[Value, Value]] = (), labels: bool = True, legend: bool = True, part: str = ""
) -> Drawing:
    """A lineage as shapes; perhaps with a text that says which part it is."""
    tree = tree_of(lineage, BRACKET * len(intervals))
    painted = sorted(tree.x, key=lambda cell: (tree.kind_of[cell] not in tree.pale, cell))
    half = max((cell.width for cell in tree.row), default=8.0)
    middle = tree.y(lineage.times[-1]) + TAIL + half
    meaning, rows = _legend(tree) if legend else ([], 0)
    parts = middle + half + 24
    body: list[Shape] = [
        *([_axis(tree, part)] if labels else []),
        *(shape for place, interval in enumerate(intervals) for shape in _bracket(tree, place, *interval)),
        *(shape for cell in painted for shape in _line(tree, cell)),
        _flags(tree),
        *_last_word(tree, middle, labels),
        Group(meaning, Look(font_family="sans-serif", font_size=13), place=Place(1, AXIS * 10, tenths(parts))),
    ]
    height = round(parts) + (MARGIN + ROW * (rows - 1) if meaning else -MARGIN)
    return document(body, WIDTH, height, f"Lineage of {lineage}" + (f"; {part}" if part else ""))


def _axis(tree: Tree, part: str) -> Group:
    """The axis of time: a fine line through the tree at each time on it; above, which part it is."""
    lineage = tree.lineage
    whole = lineage.stepwise and lineage.times == tuple(range(len(lineage.times)))
    name = "step" if whole else [Span("t", Look(font_style="italic"))]
    quiet, fine = theme().quiet, Look(stroke=tinted(theme().quiet, 0.3), stroke_width=8)
    parts: list[Shape] = [Text(tenths(AXIS - 10), tenths(MARGIN + HEAD - 16), name, Look(font_size=110, fill=quiet))]
    if part:
        parts.append(Text(tenths(WIDTH - MARGIN), tenths(MARGIN + HEAD - 16), part, Look(font_size=110, fill=quiet)))
    for time in _ticks(lineage):
        y = tenths(tree.y(time))
        parts += [
            Path(f"M{tenths(AXIS)} {y}H{tenths(WIDTH - MARGIN)}", fine),
            Text(tenths(AXIS - 10), y + 42, time_text(time), Look(font_size=120, fill=quiet)),
        ]
    return Group(parts, Look(text_anchor="end", font_family="sans-serif"))


def _ticks(lineage: Lineage) -> Sequence[Value]:
    """The times on the axis: those of steps, or whole ones."""
    if lineage.stepwise:
        return lineage.times[:: -(-len(lineage.times) // MOST_TICKS)]
    end = lineage.times[-1]
    return range(0, int(end) + 1, max(1, -(-int(end) // MOST_TICKS)))


def _bracket(tree: Tree, place: int, first: Value, last: Value) -> list[Shape]:
    """An interval beside the tree, with its length."""
    x, top, bottom = tree.right + BRACKET * place + 18, tree.y(first), tree.y(last)
    data = f"M{tenths(x - 5)} {tenths(top)}h100M{tenths(x)} {tenths(top)}V{tenths(bottom)}m-50 0h100"
    look = Look(font_size=130, font_family="sans-serif", fill=theme().ink)
    return [
        Path(data, Look(fill="none", stroke=theme().ink, stroke_width=14)),
        Text(tenths(x + 8), tenths((top + bottom) / 2 + 4.5), time_text(last - first), look),
    ]


def _line(tree: Tree, number: int) -> list[Path]:
    """A cell's line, from its mother's; broad behind it the time by which it divides late."""
    cell, kind, x = tree.lineage.cells[number], tree.kinds[tree.kind_of[number]], tree.x[number]
    bottom = tree.y(tree.lineage.times[-1]) + TAIL if cell.ended is None else tree.y(cell.ended)
    seen = tree.y(tree.lineage.times[cell.modules[0][0]]) if cell.modules else bottom
    found = []
    if cell.due is not None:
        data = f"M{tenths(x)} {tenths(tree.y(max(cell.due, cell.born)))}V{tenths(bottom)}"
        found.append(Path(data, {**_late_look(), "fill": "none"}))
    start, turned = _branch_path(tree, number, bottom)
    pale = tree.kind_of[number] in tree.pale
    stroke = tinted(line(kind.colour), LABELLED) if pale else line(kind.colour)
    look: Look = {"fill": "none", "stroke": stroke, "stroke_linecap": "round", **kind.broken}
    thick, thin = (look | Look(stroke_width=width) for width in (FINE if pale else THICK, THIN))
    if seen <= turned or not tree.lineage.stepwise:
        return [*found, Path(f"{start}V{tenths(bottom)}", thick)]
    found.append(Path(f"{start}V{tenths(seen)}", thin))
    return [*found, *([Path(f"M{tenths(x)} {tenths(seen)}V{tenths(bottom)}", thick)] if bottom > seen else [])]


def _late_look() -> Look:
    """How the time is shown by which a cell divides late."""
    return Look(stroke=line(VERMILION), stroke_width=LATE, stroke_opacity=0.35)


def _branch_path(tree: Tree, number: int, bottom: float) -> tuple[str, float]:
    """The beginning of a cell's line, from that of its mother round a corner, and how far down it leads."""
    cell, x = tree.lineage.cells[number], tree.x[number]
    top = tree.y(cell.born)
    if cell.mother is None:
        return f"M{tenths(x)} {tenths(top)}", top
    away = x - tree.x[cell.mother]
    bend = min(BEND, abs(away), bottom - top)
    return (
        f"M{tenths(x - away)} {tenths(top)}H{tenths(x - (bend if away > 0 else -bend))}"
        f"Q{tenths(x)} {tenths(top)} {tenths(x)} {tenths(top + bend)}"
    ), top + bend


def _flags(tree: Tree) -> Path:
    """A flag at the beginning of each line, to the side to which the cell points."""
    parts = []
    for number in sorted(tree.x):
        cell = tree.lineage.cells[number]
        way = polarity_of(tree.lineage, cell.at_birth)
        top, end = tree.y(cell.born), tree.y(tree.lineage.times[-1] if cell.ended is None else cell.ended)
        if way and end - top > 16:
            x, y = tenths(tree.x[number]), tenths(top + 7)
            parts.append(f"M{x} {y}L{x + way * 65} {y + 32}L{x} {y + 64}Z")
    return Path("".join(parts), Look(fill=theme().ink))


def _last_word(tree: Tree, middle: float, labels: bool) -> list[Shape]:
    """The last word below the tree: its cells as they are drawn, else their names where there is room."""
    lineage, system = tree.lineage, tree.lineage.states.system
    if tree.row:
        return filament_shapes(tree.row, system.cells, middle, tree.colours)
    cells = [cell for cell in lineage.words[-1] if cell in tree.x]
    modules, places = [lineage.cells[cell].modules[-1][1] for cell in cells], [tree.x[cell] for cell in cells]
    longest = max((len(str(module)) for module in modules), default=0)
    if not labels or tree.pale or any(after - before < LETTER * longest + SPACE for before, after in pairwise(places)):
        return []
    look = Look(font_size=13, text_anchor="middle", font_family="sans-serif", fill=theme().ink)
    names = [label_spans(*label_parts(module.symbol, system), values_text(module)) for module in modules]
    spots = [Place(10, tenths(x), tenths(middle + 6)) for x in places]
    return [Text(None, None, name, look, place=place) for name, place in zip(names, spots, strict=True)]


def _legend(tree: Tree) -> tuple[list[Shape], int]:
    """What the lines mean: kinds of cells by what they are at birth; what is not in a word yet, what is late. And how many rows
    that takes."""
    cells, entries = tree.lineage.cells, list[tuple[Look, str | Sequence[str | Span], int]]()
    for number, kind in enumerate(tree.kinds if len(tree.kinds) > 1 else ()):
        look = Look(stroke=line(kind.colour), stroke_width=THICK, stroke_linecap="round") | kind.broken
        if number in tree.pale:
            look |= Look(stroke=tinted(line(kind.colour), LABELLED), stroke_width=FINE)
        entries.append((look, kind.label, kind.characters))
    if tree.lineage.stepwise and any(not cell.modules or tree.lineage.times[cell.modules[0][0]] > cell.born for cell in cells):
        entries.append((Look(stroke=theme().quiet, stroke_width=THIN), "within a step", 13))
    if any(cell.due is not None for cell in cells):
        entries.append((_late_look(), "should have divided", 19))
    parts, x, y = list[Shape](), 0, 0
    for look, label, characters in entries:
        if x and x + 360 + 85 * characters > tenths(WIDTH - MARGIN - AXIS):
            x, y = 0, y + 10 * ROW
        place = Place(10, x + 360, y + 45)
        parts += [Path(f"M{x} {y}h280", look), Text(None, None, label, Look(fill=theme().ink), place=place)]
        x += 360 + 65 * characters + 280
    return parts, y // (10 * ROW) + 1
