"""Layers of a directed graph in an order with few crossings.

After K. Sugiyama, S. Tagawa and M. Toda, "Methods for visual understanding of hierarchical system structures" (1981), and
E. R. Gansner, E. Koutsofios, S. C. North and K.-P. Vo, "A technique for drawing directed graphs" (1993): edges that close a
cycle are turned round; each vertex then gets a layer behind those of its predecessors; an edge across several layers is cut by
dummy vertices into pieces; and the vertices of each layer are ordered such that few pieces cross.
"""

from __future__ import annotations

from bisect import bisect_right, insort
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from random import Random

import numpy as np

from lsys_kit.budget import check_budget

SWEEPS, STARTS = 6, 6
"""How often the layers are ordered up and down from one first order, and from how many first orders."""


@dataclass(frozen=True)
class Layers:
    """A graph in layers.

    Attributes
    ----------
    layers
        The vertices of each layer in their order. Those from the graph's number of vertices on are dummies.
    chains
        For each edge the vertices that it runs through, from the first layer to the last.
    turned
        The numbers of the edges that were turned round: their chains run from target to source.
    crossings
        The number of crossings of pieces of edges.
    """

    layers: tuple[tuple[int, ...], ...]
    chains: tuple[tuple[int, ...], ...]
    turned: frozenset[int]
    crossings: int


def layered(count: int, edges: Sequence[tuple[int, int]], weights: Sequence[int], first: Sequence[int] = ()) -> Layers:
    """The layers of a graph.

    Parameters
    ----------
    count
        The number of vertices.
    edges
        Source and target of each edge.
    weights
        How much it matters that each edge is short.
    first
        Vertices from which paths are followed first; an edge that leads back to where a path came from is turned round.

    Examples
    --------
    >>> layered(4, [(0, 1), (1, 2), (2, 0), (0, 3)], [1, 1, 1, 1])
    Layers(layers=((0,), (1, 3, 4), (2,)), chains=((0, 1), (1, 2), (0, 4, 2), (0, 3)), turned=frozenset({2}),
           crossings=0)
    """
    turned = _closing(count, edges, first)
    onward = [(target, source) if number in turned else (source, target) for number, (source, target) in enumerate(edges)]
    ranks = _ranks(count, onward, weights)
    layers, chains = _with_dummies(count, onward, ranks)
    pieces = _pieces(chains)
    best, crossings = _ordered(layers, pieces)
    return Layers(tuple(map(tuple, best)), tuple(map(tuple, chains)), frozenset(turned), crossings)


def _closing(count: int, edges: Sequence[tuple[int, int]], first: Sequence[int]) -> set[int]:
    """The numbers of the edges that close a cycle of a search in depth."""
    leaving: list[list[tuple[int, int]]] = [[] for _ in range(count)]
    for number, (source, target) in enumerate(edges):
        leaving[source].append((number, target))
    found, finished, on_path = set(), set(), set()
    for root in (*first, *range(count)):
        if root in finished:
            continue
        on_path.add(root)
        path = [(root, iter(leaving[root]))]
        while path:
            vertex, onward = path[-1]
            step = next(onward, None)
            if step is None:
                path.pop()
                on_path.discard(vertex)
                finished.add(vertex)
            elif step[1] in on_path:
                found.add(step[0])
            elif step[1] not in finished:
                on_path.add(step[1])
                path.append((step[1], iter(leaving[step[1]])))
    return found


def _ranks(count: int, edges: Sequence[tuple[int, int]], weights: Sequence[int]) -> list[int]:
    """The layer of each vertex such that the weighted sum of the edges' lengths is least: a linear programme with whole numbers
    as its solution."""
    from scipy.optimize import linprog
    from scipy.sparse import coo_array

    if not edges:
        return [0] * count
    numbers, ends = np.arange(len(edges)), np.array(edges)
    costs = np.zeros(count)
    np.add.at(costs, ends[:, 1], weights)
    np.subtract.at(costs, ends[:, 0], weights)
    values = np.repeat([1.0, -1.0], len(edges))
    rows, columns = np.tile(numbers, 2), np.concatenate([ends[:, 0], ends[:, 1]])
    solved = linprog(
        costs,
        coo_array((values, (rows, columns)), shape=(len(edges), count)).tocsr(),
        -np.ones(len(edges)),
        bounds=(0, None),
        method="highs-ds",
    )
    ranks: list[int] = np.rint(solved.x).astype(int).tolist()
    return ranks


def _with_dummies(
    count: int, edges: Sequence[tuple[int, int]], ranks: Sequence[int]
) -> tuple[list[list[int]], list[list[int]]]:
    """The layers with a dummy wherever an edge passes one, and the chain of each edge."""
    layers: list[list[int]] = [[] for _ in range(max(ranks, default=-1) + 1)]
    for vertex, rank in enumerate(ranks):
        layers[rank].append(vertex)
    chains, dummy = [], count
    for source, target in edges:
        between = range(ranks[source] + 1, ranks[target])
        chains.append([source, *range(dummy, dummy + len(between)), target])
        for rank in between:
            layers[rank].append(dummy)
            dummy += 1
    return layers, chains


def _pieces(chains: Sequence[Sequence[int]]) -> tuple[dict[int, list[int]], dict[int, list[int]]]:
    """For each vertex its neighbours in the next layer, and in the one before."""
    after: dict[int, list[int]] = {}
    before: dict[int, list[int]] = {}
    for chain in chains:
        for a, b in pairwise(chain):
            after.setdefault(a, []).append(b)
            before.setdefault(b, []).append(a)
    return after, before


def _ordered(layers: list[list[int]], pieces: tuple[dict[int, list[int]], dict[int, list[int]]]) -> tuple[list[list[int]], int]:
    """The best order found from several first orders: the one given, and shuffled ones that are the same every time."""
    best, fewest = layers, _crossings(layers, pieces[0])
    shuffled = Random(0)  # noqa: S311
    for start in range(STARTS if fewest else 0):
        order = [shuffled.sample(layer, len(layer)) for layer in layers] if start else [list(layer) for layer in layers]
        for now in _swept(order, pieces):
            count = _crossings(now, pieces[0])
            if count < fewest:
                best, fewest = [list(layer) for layer in now], count
            if not fewest:
                return best, 0
    return best, fewest


def _swept(order: list[list[int]], pieces: tuple[dict[int, list[int]], dict[int, list[int]]]) -> Iterator[list[list[int]]]:
    """Orders that become better: each layer by the mean place of its neighbours in the layer before, and after, in turn."""
    after, before = pieces
    for sweep in range(SWEEPS):
        check_budget()
        neighbours, numbers = (before, range(1, len(order))) if sweep % 2 == 0 else (after, range(len(order) - 2, -1, -1))
        for number in numbers:
            beside = order[number - 1] if sweep % 2 == 0 else order[number + 1]
            place = {vertex: float(index) for index, vertex in enumerate(beside)}
            order[number] = _by_means(order[number], neighbours, place)
        _transpose(order, pieces)
        yield order


def _by_means(layer: Sequence[int], neighbours: dict[int, list[int]], place: dict[int, float]) -> list[int]:
    """A layer by the mean place of its vertices' neighbours; vertices without any stay where they are."""
    means = {
        vertex: sum([place[other] for other in neighbours[vertex]]) / len(neighbours[vertex])
        for vertex in layer
        if vertex in neighbours
    }
    movable = iter(sorted(means, key=means.__getitem__))
    return [next(movable) if vertex in means else vertex for vertex in layer]


def _transpose(order: list[list[int]], pieces: tuple[dict[int, list[int]], dict[int, list[int]]]) -> None:
    """Exchange neighbours in a layer as long as that removes crossings."""
    after, before = pieces
    improved = True
    while improved:
        improved = False
        check_budget()
        for number, layer in enumerate(order):
            onward = _places(layer, after, order[number + 1] if number + 1 < len(order) else [])
            back = _places(layer, before, order[number - 1] if number else [])
            for index in range(len(layer) - 1):
                a, b = layer[index], layer[index + 1]
                if _gain(onward[a], onward[b]) + _gain(back[a], back[b]) > 0:
                    layer[index], layer[index + 1] = b, a
                    improved = True


def _places(layer: Sequence[int], neighbours: dict[int, list[int]], beside: Sequence[int]) -> dict[int, list[int]]:
    """For each vertex of a layer the places of its neighbours in a layer beside it."""
    place = {vertex: index for index, vertex in enumerate(beside)}
    return {vertex: [place[other] for other in neighbours.get(vertex, ())] for vertex in layer}


def _gain(first: Sequence[int], second: Sequence[int]) -> int:
    """How many crossings fewer there are if two vertices, one after the other, are exchanged, by the places of their neighbours
    in one of the layers beside them."""
    gain = 0
    for one in first:
        for other in second:
            gain += (one > other) - (one < other)
    return gain


def _crossings(order: Sequence[Sequence[int]], after: dict[int, list[int]]) -> int:
    """The number of pieces that cross."""
    total = 0
    for layer, following in pairwise(order):
        place = {vertex: index for index, vertex in enumerate(following)}
        seen: list[int] = []
        for vertex in layer:
            ends = [place[other] for other in after.get(vertex, ())]
            total += sum(len(seen) - bisect_right(seen, end) for end in ends)
            for end in ends:
                insort(seen, end)
    return total
