"""Does a map system that can be read also make sense? Cells have walls all around, neutral walls look alike from both ends."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from lsys_kit.errors import ModelValueError
from lsys_kit.notation.analysis.checks import span
from lsys_kit.notation.model.maps import LEFT, RIGHT, Edge, EdgeProduction, MapSystem, Marker, SuccessorPart

LEAST_WALLS = 3
"""A cell with fewer straight walls has no inside."""


def check_map(system: MapSystem) -> None:
    """The first cell has an inside, and each wall one production at most, which can be applied from either of its ends."""
    if len(system.axiom) < LEAST_WALLS:
        walls = "1 wall" if len(system.axiom) == 1 else f"{len(system.axiom)} walls"
        raise ModelValueError(f"The first cell has only {walls}", system.source, *_around(system.axiom),
                              'A cell has three walls or more, as in "map: AAA".')
    met: set[Edge] = set()
    for production in system.productions:
        _check_predecessor(production, met, system.source)
        _check_markers(production, system.source)
        _check_neutral(production, system.source)
        met.add(production.predecessor)


def _check_predecessor(production: EdgeProduction, met: set[Edge], source: str) -> None:
    edge = production.predecessor
    if edge.arrow == "<":
        raise ModelValueError("A production is written in the direction of its wall", source, *span(edge),
                              f'Write "{edge.turned} -> ...": what becomes of the wall, from its beginning to its end.')
    if edge in met:
        raise ModelValueError(f"A second production of {edge} stands here", source, *span(edge),
                              "A wall has one production at most. With an arrow and without, walls are different ones.")


def _check_markers(production: EdgeProduction, source: str) -> None:
    """A marker stands where a wall is parted, not at its ends, where it would touch other walls."""
    parts = production.successor
    if not production.walls:
        raise ModelValueError(f"Nothing is left of the wall {production.predecessor}", source, *_around(parts),
                              "Walls are never erased: write the letter of a wall too.")
    end = next((part for part in (parts[0], parts[-1]) if isinstance(part, Marker)), None)
    if end is not None:
        raise ModelValueError("This marker stands at the end of the wall", source, *span(end),
                              'Markers stand between two parts of a wall, as in "A -> B[-A]B".')


def _check_neutral(production: EdgeProduction, source: str) -> None:
    """A wall without direction may be read from either end, so what it becomes must be the same from both."""
    if production.predecessor.arrow or places(production.successor) == places(production.turned):
        return
    backwards = "".join(map(str, production.turned))
    raise ModelValueError(
        f"The neutral wall {production.predecessor} would become something else from its other end", source,
        *_around(production.successor), f'Read backwards, where left is right, this is "{backwards}", and a wall without an '
        f'arrow has no beginning. Make both the same, or give the wall an arrow: "{production.predecessor}> -> ...".')


def places(parts: tuple[SuccessorPart, ...]) -> list[Edge | tuple[tuple[Edge, ...], ...]]:
    """The walls of a successor, and between them what is marked on the left and on the right.

    Two markers on different sides of one place may be written in any order.
    """
    found: list[Edge | tuple[tuple[Edge, ...], ...]] = []
    for marked, group in groupby(parts, lambda part: isinstance(part, Marker)):
        some = [*group]
        if marked:
            markers = [part for part in some if isinstance(part, Marker)]
            found.append(tuple(tuple(marker.edge for marker in markers if marker.side == side) for side in (LEFT, RIGHT)))
        else:
            found += [part for part in some if isinstance(part, Edge)]
    return found


def _around(parts: tuple[SuccessorPart, ...]) -> tuple[int | None, int | None]:
    """Where a row of parts stood in its text."""
    return span(parts[0])[0], span(parts[-1])[1]


def unused_parts(system: MapSystem) -> Iterator[str]:
    """What can never take part: productions of walls that never occur, markers that never find another half.

    >>> from lsys_kit.notation.model.maps import EdgeProduction
    >>> [*unused_parts(MapSystem((Edge("A"),) * 3, (EdgeProduction(Edge("C"), (Edge("A"),)),)))]
    ['The production C -> A is never used: no wall C occurs.']
    """
    occurring = _occurring(system)
    for production in system.productions:
        if production.predecessor not in occurring:
            yield f"The production {production} is never used: no wall {production.predecessor} occurs."
    markers = {marker.edge for marker in system.markers}
    for edge in dict.fromkeys(marker.edge for marker in system.markers):
        if edge.turned not in markers:
            yield f"Markers of {edge} divide no cell: they need markers of {edge.turned}, and there are none."


def _occurring(system: MapSystem) -> set[Edge]:
    """The walls that can occur, each in its own direction."""
    successors = {production.predecessor: production for production in system.productions}
    found: set[Edge] = set()
    waiting = [*system.axiom]
    while waiting:
        edge = waiting.pop()
        edge = edge.turned if edge.arrow == "<" else edge
        if edge in found:
            continue
        found.add(edge)
        if edge in successors:
            waiting += (part if isinstance(part, Edge) else part.edge for part in successors[edge].successor)
    return found
