"""The net of a map or cellwork system: a place for each wall of a map, or edge of a cellwork, that its rules name, and what
becomes of its tokens in a step.

A wall becomes walls, and markers between them are halves of walls to come. Whether two halves match is decided by the cells,
of which tokens know nothing; so an arc that stands for markers names them, instead of a number of tokens.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

from lsys_kit.derivation.petri.net import Arc, Place, Stages, Transition
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model.cells import AnyMarker, CellSystem, CellworkSystem, Edge, EdgeRule
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem, Production

MOST_PLACES, MOST_ARCS = 60, 400
"""A diagram with more walls or arcs is not legible."""
MARKERS = "two markers [ ] that match make {what}"


def kinds_of_walls(system: CellSystem) -> Mapping[Edge, str]:
    """The walls, or edges of a cellwork, that the rules name, in the order in which they are first read, each with the symbol
    that stands for it: its letter, and its arrow where the same letter names a neutral wall too.

    >>> from lsys_kit import read_map
    >>> [*kinds_of_walls(read_map("map: A>B>C<\\nB> -> C>[-D]C")).values()]
    ['A', 'B', 'C>', 'D', 'C']
    """
    read = (edge for rule in system.productions for edge in (rule.predecessor, *rule.named))
    edges = dict.fromkeys(map(kind_of, (*system.axiom, *read)))
    letters = Counter(edge.label for edge in edges)
    return {edge: edge.label if letters[edge.label] == 1 else str(edge) for edge in edges}


def kind_of(edge: Edge) -> Edge:
    """A wall, read in its own direction."""
    return Edge(edge.label, ">" if edge.arrow else "")


def letters_of_walls(system: CellSystem) -> LSystem:
    """The L-system of the letters of a map's walls or a cellwork's edges, which knows nothing of cells: for labels and colours.

    >>> from lsys_kit import read_map
    >>> print(letters_of_walls(read_map("map: ABAB\\nA -> B[-A][+A]B")))
    axiom: A B A B
    A -> B A A B
    """
    symbols = kinds_of_walls(system)

    def patterns(edges: Iterable[Edge]) -> tuple[Pattern, ...]:
        return tuple(Pattern(symbols[kind_of(edge)]) for edge in edges)

    rules = (Production(patterns([made.predecessor]), patterns(made.named)) for made in system.productions)
    return LSystem(patterns(system.axiom), tuple(rules))


def wall_stages(system: CellSystem) -> Stages:
    """The stage diagram of the walls of a map system, or of the edges of a cellwork system; an error, if it is not legible.

    >>> from lsys_kit import read_map
    >>> wall_stages(read_map("map: ABAB\\nA -> B[-A][+A]B\\nB -> A"))
    A -> 2 B + [-A][+A] A
    B -> A
    besides: two markers [ ] that match make a wall
    """
    symbols = kinds_of_walls(system)
    numbers = {edge: number for number, edge in enumerate(symbols)}
    transitions, arcs = list[Transition](), list[Arc]()
    one, many = ("an edge", "edges") if isinstance(system, CellworkSystem) else ("a wall", "walls")
    for rule, production in enumerate(system.productions):
        walls = getattr(production, "walls", ())  # to which an edge of a cellwork must belong
        transitions.append(Transition(numbers[production.predecessor], rule, f"in {' '.join(walls)}" if walls else ""))
        arcs += _arcs(rule, production, numbers)
    for what, size, most in ((many, len(symbols), MOST_PLACES), ("arrows", len(arcs), MOST_ARCS)):
        if size > most:
            raise ModelLimitError(
                f"It would have {size:,} {what}, and with more than {most} it is not legible", limit=most, needed=size
            )
    start = Counter(numbers[kind_of(edge)] for edge in system.axiom)
    places = tuple(Place(symbol, (Module(symbol),)) for symbol in symbols.values())
    by_module = {place.modules[0]: number for number, place in enumerate(places)}
    besides = (MARKERS.format(what=one),) if any(system.markers) else ()
    return Stages(
        letters_of_walls(system),
        places,
        tuple(transitions),
        tuple(arcs),
        tuple(start[n] for n in numbers.values()),
        True,
        besides,
        _where=by_module.get,
    )


def _arcs(transition: int, production: EdgeRule[AnyMarker], numbers: Mapping[Edge, int]) -> Iterator[Arc]:
    """The arcs of a production: to the walls of its successor, then to those whose markers it has."""
    for edge, copies in Counter(map(kind_of, production.edges)).items():
        yield Arc(transition, numbers[edge], copies)
    markers: dict[Edge, str] = {}
    for marker in production.markers:
        kind = kind_of(marker.edge)
        markers[kind] = markers.get(kind, "") + marker.short
    for kind, text in markers.items():
        yield Arc(transition, numbers[kind], 1, factor=text)
