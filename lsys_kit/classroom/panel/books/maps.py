"""The book of a map system: the walls, points and cells of its steps, for one setting of the forces, as JSON.

As in the book of an L-system, each step has a word: the walls of its map in order. The daughters of a wall stand side by side,
those of the first wall first; behind them stand the walls that divide cells and have no mother. Points keep their numbers, and
new ones say between which others they were made, so that the browser can show how a map grows out of the one before.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from lsys_kit.budget import Task, current, limits
from lsys_kit.classroom.panel.books.book import FEWEST_STEPS, MOST_BYTES, TIME_FOR_ASKED, packed, sentence
from lsys_kit.classroom.panel.books.cells import last_held, span
from lsys_kit.classroom.panel.books.net import net_entry
from lsys_kit.derivation.maps.development import Development, develop, unmatched_markers
from lsys_kit.derivation.maps.map import Map, Wall, cell_words
from lsys_kit.derivation.petri.walls import kind_of, kinds_of_walls, letters_of_walls, wall_stages
from lsys_kit.errors import LSystemError, ModelLimitError
from lsys_kit.files import file_stem
from lsys_kit.geometry.scene import Floats
from lsys_kit.geometry.tissues.equilibrium import Equilibrium
from lsys_kit.geometry.tissues.map_layout import equilibria, polygon, tissue
from lsys_kit.geometry.tissues.relaxation import Forces
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.maps import Edge, MapSystem
from lsys_kit.pictures.style.labels import label_parts, visible
from lsys_kit.pictures.style.palette import colours
from lsys_kit.pictures.tissues.maps import STEPS

MOST_WALLS = 20_000
"""A book holds no map of more walls."""
MOST_UNASKED = 320
"""Steps beyond the last one that the system asks for are held while all maps together have no more walls, since larger ones
take long to come to rest."""
WALL_BYTES = 80
"""About what a wall takes in a book, with its share of points and cells."""
DIGITS = 7
"""The decimals of a coordinate; a wall is about 0.3 long, and areas shall be right to 1e-6."""


@dataclass(frozen=True)
class MapsAtRest:
    """The maps of a system that a book holds, under some forces; where their relaxation ends; and why there are no more, "" if
    nothing is in the way."""

    system: MapSystem
    forces: Forces
    maps: Sequence[Map]
    equilibria: Sequence[Equilibrium]
    end: str

    @property
    def places(self) -> Sequence[Floats]:
        """The positions of the points of each map."""
        return [each.points for each in self.equilibria]

    @property
    def last(self) -> int:
        """The last step."""
        return len(self.equilibria) - 1


def maps_at_rest(system: MapSystem, forces: Forces, least: int = 0) -> MapsAtRest:
    """The maps of a system at rest, up to twice the step that it asks for, or to a later one.

    Raises
    ------
    LSystemError
        Not even the first cell comes to rest.
    """
    asked = max(steps_of(system), least)
    with limits(modules=min(MOST_WALLS, current().modules), seconds=TIME_FOR_ASKED * current().seconds):
        maps, end = _developed(system, asked)
        reached, size = list[Equilibrium](), 0
        try:
            for found, each in zip(maps, equilibria(maps, forces), strict=True):
                size += WALL_BYTES * len(found.walls)
                if size > MOST_BYTES:
                    end = f"The panel ends at step {len(reached) - 1}: step {len(reached)} has too many more walls."
                    break
                reached.append(each)
        except LSystemError as error:
            if not reached:
                raise
            end = sentence(error)
    return MapsAtRest(system, forces, maps[: len(reached)], reached, end)


def steps_of(system: MapSystem) -> int:
    """The step that is shown first."""
    return STEPS if system.steps is None else system.steps


def _developed(system: MapSystem, asked: int) -> tuple[Sequence[Map], str]:
    """The maps that shall come to rest, and why there are no more of them."""
    end = ""
    try:
        found = develop(system, max(2 * asked, FEWEST_STEPS))
    except ModelLimitError as error:
        if not isinstance(error.partial, Development):
            raise
        found, end = error.partial, sentence(error)
    last, early = last_held((len(each.walls) for each in found), asked, MOST_UNASKED, "maps")
    return found[: last + 1], early or end


def map_book(found: MapsAtRest, settings: Mapping[str, Value], title: str = "") -> dict[str, Any]:
    """The book of the maps of a system, ready to be written as JSON.

    Parameters
    ----------
    found
        The maps at rest.
    settings
        The forces.
    title
        What the system is called.

    Examples
    --------
    >>> from lsys_kit.notation.dialects.map.dialect import read_map
    >>> made = map_book(maps_at_rest(read_map("map: ABAB\\nsteps: 1\\nA -> B[-A][+A]B\\nB -> A"), Forces()), {})
    >>> [text for *_, text in made["states"]], made["counts"][:2]
    (['A', 'B'], [(4, 4, 1), (6, 7, 2)])
    """
    system = found.system
    kinds = kinds_of_walls(system)
    numbers = {edge: number for number, edge in enumerate(kinds)}
    letters = letters_of_walls(system)
    with Task("The book was not finished"):
        net, diagram = net_entry(lambda: wall_stages(system), lambda _: frozenset())
        return {
            "title": title,
            "text": system.source,
            "notation": "map",
            "notes": [*map(visible, system.notes)],
            "noun": "wall",
            "mode": "map",
            "settings": {name: number_text(value) for name, value in settings.items()},
            "chance": False,
            "symbols": [[*label_parts(symbol, letters), colours(letters)[symbol], 0] for symbol in kinds.values()],
            "states": [[number, edge.arrow, -1 if net is None else number, str(edge)] for edge, number in numbers.items()],
            "productions": [{"text": str(rule), "at": span(rule)} for rule in system.productions],
            "file": file_stem(title, "map", system.source or repr(system)),
            "steps": found.last,
            "end": found.end,
            "axiom": [numbers[kind_of(edge)] for edge in system.axiom],
            **_history(found, numbers),
            "net": diagram,
            "counts": [each.counts for each in found.maps],
            "forces": asdict(found.forces),
            "first": _flat(polygon(len(system.axiom))),
            "maps": _pages(found),
            "unknown": [],
            "said": "".join(unmatched_markers(system, found.maps)).rstrip("."),
            "growth": None,
        }


def _history(found: MapsAtRest, numbers: Mapping[Edge, int]) -> dict[str, Any]:
    """The walls of all steps as numbers; for those of each step but the last how many walls they become, and by which
    production."""
    rules = {production.predecessor: rule for rule, production in enumerate(found.system.productions)}
    many = [len(production.walls) for production in found.system.productions]
    words = [[_kind(wall) for wall in each.walls] for each in found.maps]
    made = [[rules.get(kind, -1) for kind in word] for word in words[:-1]]
    return {
        "words": [packed(_whole(numbers[kind] for kind in word)) for word in words],
        "made": [packed(_whole(row)) for row in made],
        "daughters": [packed(_whole(1 if rule < 0 else many[rule] for rule in row)) for row in made],
    }


def _kind(wall: Wall) -> Edge:
    return Edge(wall.label, ">" if wall.directed else "")


def _pages(found: MapsAtRest) -> list[dict[str, Any]]:
    """What is drawn of each map: the points, x and y in turn; the points at the ends of walls; those around cells, and where
    each cell starts; the kinds of cells; and where new points were made."""
    pages, kinds = [], dict[tuple[Edge, ...], int]()
    known = 0
    for each, reached in zip(found.maps, found.equilibria, strict=True):
        net = tissue(each)
        new = [(*vertex.between, float(vertex.share)) for vertex in each.vertices[known:] if vertex.between]
        pages.append(
            {
                "points": _flat(reached.points),
                "iterations": reached.iterations,
                "settled": reached.settled,
                "ends": packed(net.ends.ravel()),
                "corners": packed(net.corners),
                "starts": packed(net.starts),
                "new": new,
                "kinds": packed(_whole(kinds.setdefault(word, len(kinds)) for word in cell_words(each))),
            }
        )
        known = len(each.vertices)
    return pages


def _flat(points: Floats) -> list[float]:
    rounded: list[float] = np.round(points, DIGITS).ravel().tolist()
    return rounded


def _whole(numbers: Iterable[int]) -> np.ndarray[Any, Any]:
    return np.array([*numbers], np.int64)
