"""The book of a system of cells, for one setting of the forces, as JSON.

As in the book of an L-system, each step has a word. Of a map in the plane it is its walls in order: the daughters of a wall
stand side by side, those of the first wall first; behind them stand the walls that divide cells and have no mother. Points keep
their numbers, and new ones say between which others they were made, so that the browser can show how a map grows out of the one
before.

Cells that are seen from all sides are those of a cellwork, or of a map on a sphere. Here the word is the cells in order, each
written as the edges around its walls, or the walls around it; the daughters of a cell stand side by side. Beside the cells a
step has its tokens, since the stages are those of edges; and what is drawn: of a cellwork edges and walls, of a map on a sphere
the arcs of its walls.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from itertools import accumulate, pairwise
from typing import TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import Task
from lsys_kit.classroom.panel.books.at_rest import CellsAtRest
from lsys_kit.classroom.panel.books.book import packed
from lsys_kit.classroom.panel.books.net import net_entry
from lsys_kit.derivation.petri.walls import kind_of, kinds_of_walls, letters_of_walls, wall_stages
from lsys_kit.derivation.tissues.cellworks import Cellwork
from lsys_kit.derivation.tissues.maps import Map, kinds_of_cells, least_word, unmatched_markers
from lsys_kit.files import file_stem
from lsys_kit.geometry.scene import Floats
from lsys_kit.geometry.tissues.layout import Placed, polygon, solid_tissue, tissue
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.cells import CellworkProduction, CellworkSystem, Edge, EdgeProduction
from lsys_kit.pictures.style.labels import label_parts, visible
from lsys_kit.pictures.style.palette import SERIES, colours
from lsys_kit.pictures.tissues.cellworks import wall_labels
from lsys_kit.pictures.tissues.chosen import counts_text
from lsys_kit.pictures.tissues.spheres import wall_arcs

NEVER_DIVIDED = "no cell is divided at any step: new edges never go once around one"
"""What is said of rules whose markers do not match, or not around a cell."""
MAP_DIGITS, DIGITS = 7, 12
"""The decimals of a coordinate; in the plane a wall is about 0.3 long, and areas shall be right to 1e-6."""

Written: TypeAlias = tuple[tuple[str, str], ...]
"""A cell as it is written: for each wall its label and the edges around it; on a sphere the walls, without a label."""


def cell_book(found: CellsAtRest, settings: Mapping[str, Value], title: str = "") -> dict[str, object]:
    """The book of a system of cells, ready to be written as JSON, given its forces and what it is called.

    >>> from lsys_kit.classroom.panel.books.at_rest import cells_at_rest
    >>> from lsys_kit import read_map
    >>> from lsys_kit.pictures.tissues.chosen import USUAL
    >>> halves = read_map("map: ABAB\\nsteps: 1\\nA -> B[-A][+A]B\\nB -> A")
    >>> made = cell_book(cells_at_rest(halves, USUAL["map"]), {})
    >>> [text for *_, text in made["states"]], made["counts"][:2]
    (['A', 'B'], [(4, 4, 1), (6, 7, 2)])
    >>> three = read_map("sphere: D>D>D>\\nD> -> E>")
    >>> cell_book(cells_at_rest(three, USUAL["map on a sphere"]), {})["sizes"][1]
    '2 vertices, 3 walls, 3 cells; 2 \u2212 3 + 3 = 2'
    """
    system = found.steps.system
    kinds, letters = kinds_of_walls(system), letters_of_walls(system)
    with Task("The book was not finished"):
        net, diagram = net_entry(lambda: wall_stages(system), lambda _: frozenset())
        edges = [[*label_parts(symbol, letters), colours(letters)[symbol], 0] for symbol in kinds.values()]
        numbers = {edge: number for number, edge in enumerate(kinds)}
        return {
            "title": title,
            "text": system.source,
            "notation": system.notation,
            "notes": [*map(visible, system.notes)],
            "settings": {name: number_text(value) for name, value in settings.items()},
            "chance": False,
            "productions": [{"text": str(rule), "at": span(rule)} for rule in system.productions],
            "file": file_stem(title, system.notation, system.source or repr(system)),
            "steps": found.last,
            "end": found.end,
            "net": diagram,
            **(_of_map(found, edges, numbers, net is not None) if system.kind == "map" else _of_tissue(found, edges, numbers)),
            "unknown": [],
            "growth": None,
        }


def span(rule: EdgeProduction | CellworkProduction) -> list[int] | None:
    """Between which offsets of its text a production stands."""
    last = rule.successor[-1].at
    return [rule.at[0], last[1]] if rule.at and last else None


# A map in the plane


def _of_map(found: CellsAtRest, edges: list[list[object]], numbers: Mapping[Edge, int], staged: bool) -> dict[str, object]:
    system = found.steps.system
    return {
        "noun": "wall",
        "mode": "map",
        "symbols": edges,
        "states": [[number, edge.arrow, number if staged else -1, str(edge)] for edge, number in numbers.items()],
        "axiom": [numbers[kind_of(edge)] for edge in system.axiom],
        **_history(found, numbers),
        "counts": found.steps.counts,
        "forces": asdict(found.forces),
        "first": _coordinates(polygon(len(system.axiom)), MAP_DIGITS),
        "maps": [*_map_pages(found)],
        "said": "".join(unmatched_markers(system, found.steps)).rstrip("."),
    }


def _history(found: CellsAtRest, numbers: Mapping[Edge, int]) -> dict[str, object]:
    """The walls of all steps as numbers; for those of each step but the last how many walls they become, and by which
    production."""
    rules = {production.predecessor: rule for rule, production in enumerate(found.steps.system.productions)}
    many = [len(production.edges) for production in found.steps.system.productions]
    words = [[wall.kind for wall in each.walls] for each in found.steps]
    made = [[rules.get(kind, -1) for kind in word] for word in words[:-1]]
    return {
        "words": [packed(numbers[kind] for kind in word) for word in words],
        "made": [*map(packed, made)],
        "daughters": [packed(1 if rule < 0 else many[rule] for rule in row) for row in made],
    }


def _map_pages(found: CellsAtRest) -> Iterator[dict[str, object]]:
    """What is drawn of each map: the points, x and y in turn; the points at the ends of walls; those around cells, and where
    each cell starts; the kinds of cells; and where new points were made."""
    known = 0
    for each, reached, kinds in zip(found.steps, found.reached, kinds_of_cells(found.steps), strict=True):
        net = tissue(each)
        yield {
            "points": _coordinates(reached.points, MAP_DIGITS),
            "iterations": reached.iterations,
            "settled": reached.settled,
            "ends": packed(net.ends.ravel().tolist()),
            "corners": packed(net.corners.tolist()),
            "starts": packed(net.starts.tolist()),
            "new": [(*vertex.between, float(vertex.share)) for vertex in each.vertices[known:] if vertex.between],
            "kinds": packed(kinds),
        }
        known = len(each.vertices)


# Cells that are seen from all sides


def _of_tissue(found: CellsAtRest, edges: list[list[object]], numbers: Mapping[Edge, int]) -> dict[str, object]:
    divided = any(len(after.cells) > len(before.cells) for before, after in pairwise(found.steps))
    return {
        "noun": "cell",
        "mode": "tissue",
        "axiom": [],
        **_cells(found, edges, [*map(str, numbers)]),
        "tokens": [[counts[kind] for kind in numbers] for counts in map(_kinds_counted, found.steps)],
        "sizes": [*map(size_text, found.steps)],
        "pages": [*_pages(found, numbers)],
        "said": "" if divided or not found.last else NEVER_DIVIDED,
    }


def size_text(found: Cellwork | Map) -> str:
    """How many vertices, edges, walls and cells there are, and Euler's number of them."""
    first, *others = found.counts
    terms = "".join(f" {sign} {count:,}" for sign, count in zip("−+−", others, strict=False))
    euler = sum(count * (-1) ** place for place, count in enumerate(found.counts))
    return f"{counts_text(found.counts)}; {first:,}{terms} = {euler}"


def _cells(found: CellsAtRest, edges: list[list[object]], kinds: Sequence[str]) -> dict[str, object]:
    """The cells of all steps as numbers, how each is written, and how many each becomes.

    States are first those of edges, so that their stages can be marked, then those of cells.
    """
    walls, looks = _wall_labels(found), _looks(found)
    order, palette = {label: number for number, label in enumerate(walls)}, [*walls.values()] or [*SERIES]
    states: dict[tuple[Written, int], int] = {}
    words = [
        [states.setdefault(cell, len(kinds) + len(states)) for cell in zip(_written(step), its, strict=True)]
        for step, its in zip(found.steps, looks, strict=True)
    ]
    plain = len(edges) + len(palette)
    symbol = {written: plain if look < 0 else len(edges) + look % len(palette) for written, look in states}
    return {
        "symbols": [*edges, *(["", "", colour, 0] for colour in palette), ["", "", "", 0]],
        "states": [
            *([number, "", number, text] for number, text in enumerate(kinds)),
            *([symbol[written], text_of(written), -1, text_of(written)] for written, _ in states),
        ],
        "walls": [[label, colour] for label, colour in walls.items()],
        "around": [[[order[label], cycle] for label, cycle in written if label] for written, _ in states],
        "words": [*map(packed, words)],
        "made": [packed([-1] * len(word)) for word in words[:-1]],
        "daughters": [packed(np.bincount(step.mothers).tolist()) for step in found.steps[1:]],
    }


def _wall_labels(found: CellsAtRest) -> Mapping[str, str]:
    """The labels of the walls of cellworks, each with its colour; none on a sphere, whose walls are edges."""
    return wall_labels(found.steps) if isinstance(found.steps.system, CellworkSystem) else {}


def _looks(found: CellsAtRest) -> list[list[int]]:
    """For each step the numbers of the colours of its cells: on a sphere those alike have one; -1 where only walls have."""
    if isinstance(found.steps.system, CellworkSystem):
        return [[-1] * len(step.cells) for step in found.steps]
    return [*kinds_of_cells(found.steps)]


def _written(found: Cellwork | Map) -> Iterator[Written]:
    if isinstance(found, Map):
        yield from ((("", "".join(map(str, found.word(cell)))),) for cell in found.cells)
    else:
        yield from (
            tuple((found.walls[wall].label, cycle_text(found, wall, forward)) for wall, forward in cell) for cell in found.cells
        )


def cycle_text(found: Cellwork, wall: int, forward: bool) -> str:
    """The edges once around a wall, counter-clockwise as seen from outside of the cell, from where they are the least word."""
    word = [found.edges[edge].met(along == forward) for edge, along in found.walls[wall].sides][:: 1 if forward else -1]
    return "".join(map(str, least_word(word)))


def text_of(written: Iterable[tuple[str, str]]) -> str:
    """A cell in one line.

    >>> text_of([("PQ", "PQPQ"), ("PR", "PRPR")])
    'PQ: PQPQ, PR: PRPR'
    """
    return ", ".join(f"{label}: {edges}" if label else edges for label, edges in written)


def _kinds_counted(found: Cellwork | Map) -> Counter[Edge]:
    return Counter(edge.kind for edge in found.edges)


def _pages(found: CellsAtRest, numbers: Mapping[Edge, int]) -> Iterator[dict[str, object]]:
    """What is drawn of each step, and the kinds of its edges."""
    order = {label: number for number, label in enumerate(_wall_labels(found))}
    for step, placed, kinds in zip(found.steps, found.reached, _looks(found), strict=True):
        page = _cellwork_page(step, placed, order) if isinstance(step, Cellwork) else _sphere_page(step, placed, kinds)
        yield page | {"edges": packed(numbers[edge.kind] for edge in step.edges)}


def _cellwork_page(found: Cellwork, points: Floats, order: Mapping[str, int]) -> dict[str, object]:
    """The vertices, x, y and z in turn; the ends of edges; around each wall the vertices and edges, and its label; for each
    wall of each cell the cell, the wall, and whether its edges run counter-clockwise as seen from outside."""
    net = solid_tissue(found)
    return {
        "points": _coordinates(points),
        "ends": packed(net.ends.ravel().tolist()),
        "corners": packed(net.corners.tolist()),
        "starts": packed(net.starts.tolist()),
        "borders": packed(edge for wall in found.walls for edge, _ in wall.sides),
        "labels": packed(order[wall.label] for wall in found.walls),
        "sides": packed(part for side in found.cells_at() for part in side),
    }


def _sphere_page(found: Map, placed: Placed, kinds: Sequence[int]) -> dict[str, object]:
    """Points along each wall, x, y and z in turn, and where each wall starts among them; the walls around each cell, with 1
    where their direction runs clockwise around it, and where each cell starts; the kinds of cells."""
    arcs = [*wall_arcs(found, *placed)]
    return {
        "points": _coordinates(np.concatenate(arcs)),
        "arcs": packed([0, *accumulate(map(len, arcs))]),
        "sides": packed(part for cell in found.cells for side in cell for part in side),
        "starts": packed([0, *accumulate(map(len, found.cells))]),
        "kinds": packed(kinds),
    }


def _coordinates(points: Floats, digits: int = DIGITS) -> list[float]:
    found: list[float] = np.round(points, digits).ravel().tolist()
    return found
