"""The book of cells that are seen from all sides, as JSON: of a cellwork, or of a map on a sphere, for one setting of forces.

The word of a step is its cells in order, each written as the edges around its walls, or the walls around it. The daughters of a
cell stand side by side. Beside the cells a step has its tokens, since the stages are those of edges; and what is drawn: of a
cellwork edges and walls, of a map on a sphere the arcs of its walls.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import accumulate, pairwise
from typing import Any, TypeAlias

import numpy as np

from lsys_kit.budget import Task
from lsys_kit.classroom.panel.books.book import packed
from lsys_kit.classroom.panel.books.cells import span
from lsys_kit.classroom.panel.books.net import net_entry
from lsys_kit.classroom.panel.books.tissue_layout import TissueAtRest
from lsys_kit.derivation.cellworks.cellwork import CellEdge, Cellwork
from lsys_kit.derivation.maps.map import Map, Wall, least_rotation
from lsys_kit.derivation.petri.walls import kind_of, kinds_of_walls, letters_of_walls, wall_stages
from lsys_kit.files import file_stem
from lsys_kit.geometry.scene import Floats
from lsys_kit.geometry.tissues.cellwork_layout import solid_tissue
from lsys_kit.geometry.tissues.sphere_layout import Placed
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.maps import Edge, MapSystem
from lsys_kit.pictures.style.labels import label_parts, visible
from lsys_kit.pictures.style.palette import SERIES, colours
from lsys_kit.pictures.tissues.cellworks import wall_labels
from lsys_kit.pictures.tissues.spheres import kinds_of_cells, wall_arcs

NEVER_DIVIDED = "no cell is divided at any step: new edges never go once around one"
"""What is said of rules whose markers do not match, or not around a cell."""
DIGITS = 12
"""The decimals of a coordinate."""

Written: TypeAlias = tuple[tuple[str, str], ...]
"""A cell as it is written: for each wall its label and the edges around it; on a sphere the walls, without a label."""
_NOUNS = (("vertex", "vertices"), ("edge", "edges"), ("wall", "walls"), ("cell", "cells"))


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
    >>> from lsys_kit.classroom.panel.books.tissue_layout import tissue_at_rest
    >>> from lsys_kit.geometry.tissues.sphere_layout import SPHERE_FORCES
    >>> from lsys_kit.notation.dialects.map.dialect import read_map
    >>> three = read_map("sphere: D>D>D>\\nD> -> E>")
    >>> made = tissue_book(tissue_at_rest(three, SPHERE_FORCES), {})
    >>> made["sizes"][1]
    '2 vertices, 3 walls, 3 cells; 2 \u2212 3 + 3 = 2'
    """
    system = found.system
    kinds = kinds_of_walls(system)
    letters = letters_of_walls(system)
    with Task("The book was not finished"):
        _, diagram = net_entry(lambda: wall_stages(system), lambda _: frozenset())
        edges = [[*label_parts(symbol, letters), colours(letters)[symbol], 0] for symbol in kinds.values()]
        return {
            "title": title,
            "text": system.source,
            "notation": "map" if isinstance(system, MapSystem) else "cellwork",
            "notes": [*map(visible, system.notes)],
            "noun": "cell",
            "mode": "tissue",
            "chance": False,
            "settings": {name: number_text(value) for name, value in settings.items()},
            "productions": [{"text": str(rule), "at": span(rule)} for rule in system.productions],
            "file": file_stem(title, "map" if isinstance(system, MapSystem) else "cellwork", system.source or repr(system)),
            "steps": found.last,
            "end": found.end,
            "axiom": [],
            **_cells(found, edges, [*map(str, kinds)]),
            "net": diagram,
            "tokens": [*_tokens(found, kinds)],
            "sizes": [*map(size_text, found.steps)],
            "pages": _pages(found, {edge: number for number, edge in enumerate(kinds)}),
            "unknown": [],
            "said": "" if any(_divided(found)) or not found.last else NEVER_DIVIDED,
            "growth": None,
        }


def _divided(found: TissueAtRest) -> Iterator[bool]:
    """For each step but the first whether there are more cells than before."""
    return (len(after.cells) > len(before.cells) for before, after in pairwise(found.steps))


def size_text(found: Cellwork | Map) -> str:
    """How many vertices, edges, walls and cells there are, and Euler's number of them."""
    nouns = _NOUNS if isinstance(found, Cellwork) else (_NOUNS[0], *_NOUNS[2:])
    told = ", ".join(f"{count:,} {names[count != 1]}" for count, names in zip(found.counts, nouns, strict=True))
    first, *others = found.counts
    terms = "".join(f" {sign} {count:,}" for sign, count in zip("−+−", others, strict=False))
    return f"{told}; {first:,}{terms} = {sum(count * (-1) ** place for place, count in enumerate(found.counts))}"


def _cells(found: TissueAtRest, edges: list[list[Any]], kinds: Sequence[str]) -> dict[str, Any]:
    """The cells of all steps as numbers, how each is written, and how many each becomes.

    States are first those of edges, so that their stages can be marked, then those of cells.
    """
    walls = wall_labels(_cellworks(found))
    order, palette = {label: number for number, label in enumerate(walls)}, [*walls.values()] or [*SERIES]
    numbers: dict[tuple[Written, int], int] = {}
    words = [
        [numbers.setdefault(cell, len(kinds) + len(numbers)) for cell in zip(_written(step), looks, strict=True)]
        for step, looks in zip(found.steps, _looks(found), strict=True)
    ]
    plain = len(edges) + len(palette)
    symbol = {written: plain if look < 0 else len(edges) + look % len(palette) for written, look in numbers}
    many = [np.bincount(step.mothers) for step in found.steps[1:]]
    return {
        "symbols": [*edges, *(["", "", colour, 0] for colour in palette), ["", "", "", 0]],
        "states": [
            *([number, "", number, text] for number, text in enumerate(kinds)),
            *([symbol[written], text_of(written), -1, text_of(written)] for written, _ in numbers),
        ],
        "walls": [[label, colour] for label, colour in walls.items()],
        "around": [[[order[label], cycle] for label, cycle in written if label] for written, _ in numbers],
        "words": [packed(_whole(word)) for word in words],
        "made": [packed(_whole([-1] * len(word))) for word in words[:-1]],
        "daughters": [*map(packed, many)],
    }


def _cellworks(found: TissueAtRest) -> list[Cellwork]:
    return [step for step in found.steps if isinstance(step, Cellwork)]


def _maps(found: TissueAtRest) -> list[Map]:
    return [step for step in found.steps if isinstance(step, Map)]


def _looks(found: TissueAtRest) -> Sequence[Sequence[int]]:
    """For each step the numbers of the colours of its cells: on a sphere those alike have one; -1 where only walls have."""
    return kinds_of_cells(_maps(found)) or [[-1] * len(step.cells) for step in found.steps]


def _written(found: Cellwork | Map) -> Iterator[Written]:
    """Each cell as it is written."""
    if isinstance(found, Map):
        yield from ((("", "".join(map(str, found.word(cell)))),) for cell in found.cells)
    else:
        yield from (
            tuple((found.walls[wall].label, cycle_text(found, wall, forward)) for wall, forward in cell) for cell in found.cells
        )


def cycle_text(found: Cellwork, wall: int, forward: bool) -> str:
    """The edges once around a wall, counter-clockwise as seen from outside of the cell, from where they are the least word."""
    sides = [(found.edges[edge], along == forward) for edge, along in found.walls[wall].sides][:: 1 if forward else -1]
    letters = [(edge.label, (">" if along else "<") if edge.directed else "") for edge, along in sides]
    first = least_rotation(letters)
    return "".join(str(Edge(*letter)) for letter in letters[first:] + letters[:first])


def text_of(written: Iterable[tuple[str, str]]) -> str:
    """A cell in one line.

    >>> text_of([("PQ", "PQPQ"), ("PR", "PRPR")])
    'PQ: PQPQ, PR: PRPR'
    """
    return ", ".join(f"{label}: {edges}" if label else edges for label, edges in written)


def _tokens(found: TissueAtRest, kinds: Iterable[Edge]) -> Iterator[list[int]]:
    """For each step how many edges of each kind there are."""
    for step in found.steps:
        counts = Counter(map(_kind, step.edges if isinstance(step, Cellwork) else step.walls))
        yield [counts[kind] for kind in kinds]


def _kind(edge: CellEdge | Wall) -> Edge:
    return kind_of(Edge(edge.label, ">" if edge.directed else ""))


def _pages(found: TissueAtRest, numbers: Mapping[Edge, int]) -> list[dict[str, Any]]:
    """What is drawn of each step."""
    order = {label: number for number, label in enumerate(wall_labels(_cellworks(found)))}
    kinds, steps = kinds_of_cells(_maps(found)), enumerate(zip(found.steps, found.places, strict=True))
    return [
        _cellwork_page(step, places, numbers, order)
        if isinstance(step, Cellwork)
        else _sphere_page(step, places, numbers, kinds[number])
        for number, (step, places) in steps
    ]


def _cellwork_page(found: Cellwork, points: Floats, numbers: Mapping[Edge, int], order: Mapping[str, int]) -> dict[str, Any]:
    """The vertices, x, y and z in turn; ends and kinds of edges; around each wall the vertices and edges, and its label;
    for each wall of each cell the cell, the wall, and whether its edges run counter-clockwise as seen from outside."""
    tissue = solid_tissue(found)
    return {
        "points": _coordinates(points),
        "ends": packed(tissue.ends.ravel()),
        "edges": packed(_whole(numbers[_kind(edge)] for edge in found.edges)),
        "corners": packed(tissue.corners),
        "starts": packed(tissue.starts),
        "borders": packed(_whole(side.edge for wall in found.walls for side in wall.sides)),
        "labels": packed(_whole(order[wall.label] for wall in found.walls)),
        "sides": packed(_whole(part for side in found.cells_at() for part in side)),
    }


def _sphere_page(found: Map, placed: Placed, numbers: Mapping[Edge, int], kinds: Sequence[int]) -> dict[str, Any]:
    """Points along each wall, x, y and z in turn, and where each wall starts among them; the kinds of walls; the walls around
    each cell, with 1 where their direction runs clockwise around it, and where each cell starts; the kinds of cells."""
    arcs = [*wall_arcs(found, *placed)]
    return {
        "points": _coordinates(np.concatenate(arcs)),
        "arcs": packed(_whole([0, *accumulate(map(len, arcs))])),
        "edges": packed(_whole(numbers[_kind(wall)] for wall in found.walls)),
        "sides": packed(_whole(part for cell in found.cells for side in cell for part in side)),
        "starts": packed(_whole([0, *accumulate(map(len, found.cells))])),
        "kinds": packed(_whole(kinds)),
    }


def _coordinates(points: Floats) -> list[float]:
    found: list[float] = np.round(points, DIGITS).ravel().tolist()
    return found


def _whole(numbers: Iterable[int]) -> np.ndarray[Any, Any]:
    return np.array([*numbers], np.int64)
