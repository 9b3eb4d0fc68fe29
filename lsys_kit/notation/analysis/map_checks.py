"""Does a map system that can be read also make sense? Cells need walls all around, neutral walls are symmetric."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from lsys_kit.notation.analysis.edge_checks import occurring_edges, unpaired_edges
from lsys_kit.notation.analysis.problems import Problem, problem
from lsys_kit.notation.model.expressions import TextSpan
from lsys_kit.notation.model.maps import LEFT, RIGHT, Edge, EdgeProduction, MapSystem, Marker, SuccessorPart

LEAST_WALLS, LEAST_MERIDIANS = 3, 2
"""A cell with fewer straight walls has no inside; on a sphere walls are round, and two of them divide it."""


def check_map(system: MapSystem) -> None:
    """The first cell has an inside, and each wall has at most one production, which can be applied from either of its ends."""
    if len(system.axiom) < (LEAST_MERIDIANS if system.sphere else LEAST_WALLS):
        raise problem(
            "undivided sphere" if system.sphere else "cell without inside",
            _row_span(system.axiom),
            walls="1 wall" if len(system.axiom) == 1 else f"{len(system.axiom)} walls",
        )
    met: set[Edge] = set()
    for production in system.productions:
        _check_predecessor(production, met)
        _check_markers(production)
        _check_neutral(production)
        met.add(production.predecessor)


def _check_predecessor(production: EdgeProduction, met: set[Edge]) -> None:
    edge = production.predecessor
    if edge.arrow == "<":
        raise problem("wall against its direction", edge.at, turned=edge.turned)
    if edge in met:
        raise problem("second production of wall", edge.at, wall=edge)


def _check_markers(production: EdgeProduction) -> None:
    """Markers belong between two parts of a wall, not at its ends, where they would touch other walls."""
    parts = production.successor
    if not production.walls:
        raise problem("wall erased", _row_span(parts), wall=production.predecessor)
    end = next((part for part in (parts[0], parts[-1]) if isinstance(part, Marker)), None)
    if end is not None:
        raise problem("marker at end", end.at)


def _check_neutral(production: EdgeProduction) -> None:
    """A wall without direction may be read from either end, so what it becomes must be the same from both."""
    if production.predecessor.arrow or places(production.successor) == places(production.turned):
        return
    raise problem(
        "neutral wall not symmetric",
        _row_span(production.successor),
        wall=production.predecessor,
        backwards="".join(map(str, production.turned)),
    )


def places(parts: tuple[SuccessorPart, ...]) -> list[Edge | tuple[tuple[Edge, ...], ...]]:
    """The walls of a successor, and between them the markers on the left and on the right.

    Two markers at one place on different sides may be written in any order.
    """
    sides: list[Edge | tuple[tuple[Edge, ...], ...]] = []
    for marked, group in groupby(parts, lambda part: isinstance(part, Marker)):
        some = [*group]
        if marked:
            markers = [part for part in some if isinstance(part, Marker)]
            sides.append(tuple(tuple(marker.edge for marker in markers if marker.side == side) for side in (LEFT, RIGHT)))
        else:
            sides += [part for part in some if isinstance(part, Edge)]
    return sides


def _row_span(parts: tuple[SuccessorPart, ...]) -> TextSpan:
    """The offsets of a row of parts."""
    first, last = parts[0].at, parts[-1].at
    return (first[0], last[1]) if first and last else None


def unused_parts(system: MapSystem) -> Iterator[Problem]:
    """Productions of walls that never occur, and markers that never find another half.

    >>> from lsys_kit.notation.model.maps import EdgeProduction
    >>> [problem.code for problem in unused_parts(MapSystem((Edge("A"),) * 3, (EdgeProduction(Edge("C"), (Edge("A"),)),)))]
    ['wall never occurs']
    """
    occurring = occurring_edges(system.axiom, system.productions)
    for production in system.productions:
        if production.predecessor not in occurring:
            yield Problem("wall never occurs", production.at, {"production": production, "wall": production.predecessor})
    for edge in unpaired_edges(marker.edge for marker in system.markers):
        yield Problem("marker without partner", None, {"wall": edge, "partner": edge.turned})
