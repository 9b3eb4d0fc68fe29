"""The book of cells that are seen from all sides, as JSON: of a cellwork, or of a map on a sphere, for one setting of the forces.

The word of a step is its cells in order, each written as the edges around its walls, or the walls around it. The daughters of a
cell stand side by side. Beside the cells a step has its tokens, since the stages are those of edges; and what is drawn: of a
cellwork edges and walls, of a map on a sphere the arcs of its walls.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import Any, TypeAlias

import numpy as np

from lsys_kit.budget import Task, current, limits
from lsys_kit.classroom.panel.books.book import FEWEST_STEPS, TIME_FOR_ASKED, packed, sentence
from lsys_kit.classroom.panel.books.net import net_entry
from lsys_kit.derivation.cellworks.cellwork import Cellwork
from lsys_kit.derivation.cellworks.development import CellworkDevelopment, develop_cellwork
from lsys_kit.derivation.maps.development import Development, develop
from lsys_kit.derivation.maps.map import Map, least_rotation
from lsys_kit.derivation.petri.walls import kinds_of_walls, letters_of_walls, wall_stages
from lsys_kit.errors import LSystemError
from lsys_kit.geometry.cellwork_layout import place_cellworks, solid_tissue
from lsys_kit.geometry.relaxation import Forces
from lsys_kit.geometry.scene import Floats
from lsys_kit.geometry.sphere_layout import Placed, place_on_sphere
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.cellworks import CellworkSystem
from lsys_kit.notation.model.maps import Edge, MapSystem
from lsys_kit.pictures.cellworks import STEPS, wall_labels
from lsys_kit.pictures.maps import STEPS as MAP_STEPS
from lsys_kit.pictures.spheres import kinds_of_cells, wall_arcs
from lsys_kit.pictures.style.labels import label_parts
from lsys_kit.pictures.style.palette import SERIES, colours

MOST_EDGES = 4_000
"""A book holds no step of more edges, since nobody could see more of them."""
MOST_UNASKED, MOST_ON_SPHERE = 800, 400
"""Steps beyond the last one that the system asks for are held while all together have no more edges, or walls on a sphere, since
larger ones take long to come to rest."""
NEVER_DIVIDED = "no cell is divided at any step: new edges never go once around one"
"""What is said of rules whose markers do not match, or not around a cell."""
DIGITS = 12
"""The decimals of a coordinate."""

TissueSystem: TypeAlias = CellworkSystem | MapSystem
"""A cellwork system, or a map system on a sphere."""


@dataclass(frozen=True)
class TissueAtRest:
    """The cellworks, or maps on a sphere, that a book holds, where they come to rest, and why there are no more; "" if nothing
    is in the way."""

    system: TissueSystem
    steps: Sequence[Cellwork] | Sequence[Map]
    places: Sequence[Floats] | Sequence[Placed]
    end: str

    @property
    def last(self) -> int:
        """The last step."""
        return len(self.places) - 1


def tissue_at_rest(system: TissueSystem, forces: Forces, least: int = 0) -> TissueAtRest:
    """The steps of a system at rest, up to twice the step that it asks for, or to a later one.

    Raises
    ------
    LSystemError
        Not even the first cell comes to rest.
    """
    asked = max(steps_of(system), least)
    with limits(modules=min(MOST_EDGES, current().modules), seconds=TIME_FOR_ASKED * current().seconds):
        steps, end = _developed(system, asked)
        places: list[Any] = []
        try:
            for points in _placed(steps, forces):
                places.append(points)
        except LSystemError as error:
            if not places:
                raise
            end = sentence(error)
    return TissueAtRest(system, steps[:len(places)], places, end)


def steps_of(system: TissueSystem) -> int:
    """The step that is shown first."""
    usual = STEPS if isinstance(system, CellworkSystem) else MAP_STEPS
    return usual if system.steps is None else system.steps


def _developed(system: TissueSystem, asked: int) -> tuple[CellworkDevelopment | Development, str]:
    """The steps that shall come to rest, and why there are no more of them."""
    end, most = "", max(2 * asked, FEWEST_STEPS)
    try:
        found = develop_cellwork(system, most) if isinstance(system, CellworkSystem) else develop(system, most)
    except LSystemError as error:
        if not isinstance(error.partial, CellworkDevelopment | Development):
            raise
        found, end = error.partial, sentence(error)
    edges, most = accumulate(map(_edges, found)), MOST_UNASKED if isinstance(found, CellworkDevelopment) else MOST_ON_SPHERE
    last = max((step for step, sum in enumerate(edges) if sum <= most), default=0)
    if max(asked, last) < found.steps:
        last = max(asked, last)
        end = f"The panel ends at step {last}: later steps take long to come to rest. The rules may ask for more: steps: {last + 1}"
    return _up_to(found, last), end


def _up_to(found: CellworkDevelopment | Development, last: int) -> CellworkDevelopment | Development:
    if isinstance(found, CellworkDevelopment):
        return CellworkDevelopment(found.system, found[:last + 1])
    return Development(found.system, found[:last + 1])


def _edges(found: Cellwork | Map) -> int:
    return len(found.edges if isinstance(found, Cellwork) else found.walls)


def _placed(steps: CellworkDevelopment | Development, forces: Forces) -> Iterator[Floats] | Iterator[Placed]:
    return place_cellworks(steps, forces) if isinstance(steps, CellworkDevelopment) else place_on_sphere(steps, forces)


def tissue_book(found: TissueAtRest, settings: Mapping[str, Value], title: str = "") -> dict[str, Any]:
    """The book of cells that are seen from all sides, ready to be written as JSON.

    Parameters
    ----------
    found
        The cells at rest.
    settings
        The forces.
    title
        What the system is called.

    Examples
    --------
    >>> from lsys_kit.notation.dialects.map.dialect import read_map
    >>> made = tissue_book(tissue_at_rest(read_map("sphere: D>D>D>\\nsteps: 1\\nD> -> D>[-e]D>[+e]D>"), Forces(rest=0.0)), {})
    >>> made["sizes"][1]
    '8 vertices, 12 walls, 6 cells; 8 \u2212 12 + 6 = 2'
    """
    system = found.system
    kinds = kinds_of_walls(system)
    letters = letters_of_walls(system)
    with Task("The book was not finished"):
        _, diagram = net_entry(lambda: wall_stages(system), lambda _: frozenset())
        edges = [[*label_parts(symbol, letters), colours(letters)[symbol], 0] for symbol in kinds.values()]
        return {
            "title": title, "text": system.source, "notation": "map" if isinstance(system, MapSystem) else "cellwork",
            "noun": "cell", "mode": "tissue", "chance": False,
            "settings": {name: number_text(value) for name, value in settings.items()},
            "productions": [{"text": str(rule), "at": _span(rule)} for rule in system.productions],
            "steps": found.last, "end": found.end, "axiom": [], **_cells(found, edges, [*map(str, kinds)]), "net": diagram,
            "tokens": [*_tokens(found, kinds)], "sizes": [*map(size_text, found.steps)],
            "pages": [*_pages(found, {edge: number for number, edge in enumerate(kinds)})], "unknown": [],
            "said": "" if any(_divided(found)) or not found.last else NEVER_DIVIDED, "growth": None}


def _divided(found: TissueAtRest) -> Iterator[bool]:
    """For each step but the first whether there are more cells than before."""
    return (len(after.cells) > len(before.cells) for before, after in pairwise(found.steps))


def _span(rule: Any) -> list[int] | None:
    """Between which offsets of its text a production stands."""
    last = rule.successor[-1].at
    return [rule.at[0], last[1]] if rule.at and last else None


def size_text(found: Cellwork | Map) -> str:
    """How many vertices, edges, walls and cells there are, and Euler's number of them."""
    nouns = (("vertex", "vertices"), ("edge", "edges"), ("wall", "walls"), ("cell", "cells"))
    nouns = nouns if isinstance(found, Cellwork) else (nouns[0], *nouns[2:])
    counts = ", ".join(f"{count:,} {names[count != 1]}" for count, names in zip(found.counts, nouns, strict=True))
    signed = "".join(f" {'−+'[place % 2 == 0]} {count:,}" if place else f"{count:,}" for place, count in enumerate(found.counts))
    euler = found.euler if isinstance(found, Cellwork) else sum((-1) ** place * count for place, count in enumerate(found.counts))
    return f"{counts}; {signed} = {euler}"


def _cells(found: TissueAtRest, edges: list[list[Any]], kinds: Sequence[str]) -> dict[str, Any]:
    """The cells of all steps as numbers, how each is written, and how many each becomes.

    States are first those of edges, so that their stages can be marked, then those of cells.
    """
    labels = wall_labels(_cellworks(found)) if isinstance(found.system, CellworkSystem) else {}
    palette = [*labels.values()] or [*SERIES]
    numbers: dict[tuple[object, ...], int] = {}
    rows, words = [], []
    for step, look in zip(found.steps, _looks(found), strict=True):
        word = []
        for written, colour in zip(_written(step), look, strict=True):
            key = (written, colour)
            if key not in numbers:
                numbers[key] = len(kinds) + len(numbers)
                rows.append((written, colour))
            word.append(numbers[key])
        words.append(word)
    symbols = [*edges, *(["", "", colour, 0] for colour in palette), ["", "", "", 0]]
    first, plain = len(edges), len(symbols) - 1
    states: list[list[Any]] = [[number, "", number, text] for number, text in enumerate(kinds)]
    states += ([plain if colour is None else first + colour % len(palette), text_of(written), -1, text_of(written)]
               for written, colour in rows)
    order = {label: number for number, label in enumerate(labels)}
    many = [Counter(step.mothers) for step in found.steps[1:]]
    return {
        "symbols": symbols, "states": states, "walls": [[label, colour] for label, colour in labels.items()],
        "around": [[[order[label], edges] for label, edges in written] if labels else [] for written, _ in rows],
        "words": [packed(_whole(word)) for word in words],
        "made": [packed(_whole([-1] * len(word))) for word in words[:-1]],
        "daughters": [packed(_whole(counts[cell] for cell in range(len(word)))) for word, counts in zip(words, many, strict=False)]}


def _cellworks(found: TissueAtRest) -> list[Cellwork]:
    return [step for step in found.steps if isinstance(step, Cellwork)]


def _looks(found: TissueAtRest) -> Iterable[Sequence[int | None]]:
    """For each step the colours of its cells: on a sphere cells that are alike have one; in a cellwork their walls have."""
    if isinstance(found.system, CellworkSystem):
        return ([None] * len(step.cells) for step in found.steps)
    return kinds_of_cells([step for step in found.steps if isinstance(step, Map)])


def _written(found: Cellwork | Map) -> Iterator[tuple[tuple[str, str], ...]]:
    """Each cell as it is written: its walls with their labels, and once around each the edges; on a sphere the walls around it."""
    if isinstance(found, Map):
        yield from ((("", "".join(map(str, found.word(cell)))),) for cell in found.cells)
        return
    for cell in found.cells:
        yield tuple((found.walls[wall].label, cycle_text(found, wall, forward)) for wall, forward in cell)


def cycle_text(found: Cellwork, wall: int, forward: bool) -> str:
    """The edges once around a wall, counter-clockwise as seen from outside of the cell, from where they are the least word."""
    sides = found.walls[wall].sides if forward else tuple((edge, not along) for edge, along in reversed(found.walls[wall].sides))
    edges = ((found.edges[edge], along) for edge, along in sides)
    letters = [(edge.label, (">" if along else "<") if edge.directed else "") for edge, along in edges]
    first = least_rotation(letters)
    return "".join(str(Edge(*letter)) for letter in letters[first:] + letters[:first])


def text_of(written: Iterable[tuple[str, str]]) -> str:
    """A cell in one line.

    >>> text_of([("PQ", "PQPQ"), ("PR", "PRPR")])
    'PQ: PQPQ, PR: PRPR'
    """
    return ", ".join(f"{label}: {edges}" if label else edges for label, edges in written)


def _tokens(found: TissueAtRest, kinds: Mapping[Edge, str]) -> Iterator[list[int]]:
    """For each step how many edges of each kind there are."""
    for step in found.steps:
        counts = Counter(_kind(edge) for edge in (step.edges if isinstance(step, Cellwork) else step.walls))
        yield [counts[kind] for kind in kinds]


def _kind(edge: Any) -> Edge:
    return Edge(edge.label, ">" if edge.directed else "")


def _pages(found: TissueAtRest, numbers: Mapping[Edge, int]) -> Iterator[dict[str, Any]]:
    """What is drawn of each step."""
    order = {label: number for number, label in enumerate(wall_labels(_cellworks(found)))}
    kinds = [] if order else kinds_of_cells([step for step in found.steps if isinstance(step, Map)])
    for number, (step, places) in enumerate(zip(found.steps, found.places, strict=True)):
        if isinstance(step, Cellwork):
            yield _cellwork_page(step, np.asarray(places), numbers, order)
        else:
            yield _sphere_page(step, places, numbers, kinds[number])


def _cellwork_page(found: Cellwork, points: Floats, numbers: Mapping[Edge, int], order: Mapping[str, int]) -> dict[str, Any]:
    """The vertices, x, y and z in turn; the ends and kinds of edges; around each wall the vertices and the edges, and its label;
    for each wall of each cell the cell, the wall, and whether its edges run counter-clockwise as seen from outside."""
    tissue = solid_tissue(found)
    return {
        "points": _coordinates(points), "ends": packed(tissue.ends.ravel()),
        "edges": packed(_whole(numbers[_kind(edge)] for edge in found.edges)),
        "corners": packed(tissue.corners), "starts": packed(tissue.starts),
        "borders": packed(_whole(side.edge for wall in found.walls for side in wall.sides)),
        "labels": packed(_whole(order[wall.label] for wall in found.walls)),
        "sides": packed(_whole(part for side in found.cells_at() for part in side))}


def _sphere_page(found: Map, placed: Placed, numbers: Mapping[Edge, int], kinds: Sequence[int]) -> dict[str, Any]:
    """Points along each wall, x, y and z in turn, and where each wall starts among them; the kinds of walls; the walls around
    each cell, each with 1 where its direction runs clockwise around the cell, and where each cell starts; the kinds of cells."""
    arcs = [*wall_arcs(found, *placed)]
    return {
        "points": _coordinates(np.concatenate(arcs)), "arcs": packed(_whole([0, *accumulate(map(len, arcs))])),
        "edges": packed(_whole(numbers[_kind(wall)] for wall in found.walls)),
        "sides": packed(_whole(part for cell in found.cells for side in cell for part in side)),
        "starts": packed(_whole([0, *accumulate(map(len, found.cells))])), "kinds": packed(_whole(kinds))}


def _coordinates(points: Floats) -> list[float]:
    found: list[float] = np.round(points, DIGITS).ravel().tolist()
    return found


def _whole(numbers: Iterable[int]) -> np.ndarray[Any, Any]:
    return np.array([*numbers], np.int64)
