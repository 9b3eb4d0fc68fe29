"""What can be said of the edges of maps and cellworks, which are walls there and edges here: which occur, which are halves."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import Any

from lsys_kit.notation.model.maps import Edge


def occurring_edges(first: Iterable[Edge], productions: Iterable[Any]) -> set[Edge]:
    """The edges that can occur, each in its own direction, given the first ones and the productions of edges.

    >>> from lsys_kit.notation.model.maps import EdgeProduction
    >>> rules = EdgeProduction(Edge("A"), (Edge("B", "<"),)), EdgeProduction(Edge("C"), (Edge("D"),))
    >>> sorted(map(str, occurring_edges([Edge("A")], rules)))
    ['A', 'B>']
    """
    made = defaultdict[Edge, list[Edge]](list)
    for production in productions:
        made[production.predecessor] += (part if isinstance(part, Edge) else part.edge for part in production.successor)
    occurring: set[Edge] = set()
    waiting = [*first]
    while waiting:
        edge = waiting.pop()
        edge = edge.turned if edge.arrow == "<" else edge
        if edge not in occurring:
            occurring.add(edge)
            waiting += made[edge]
    return occurring


def unpaired_edges(markers: Iterable[Edge]) -> Iterator[Edge]:
    """The edges of markers of which no other half is ever made.

    >>> [str(edge) for edge in unpaired_edges([Edge("A", ">"), Edge("A", "<"), Edge("B", ">"), Edge("C")])]
    ['B>']
    """
    edges = dict.fromkeys(markers)
    return (edge for edge in edges if edge.turned not in edges)
