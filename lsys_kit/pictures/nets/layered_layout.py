"""The layout of a stage diagram in layers, from left to right: for nets whose arcs would cross too often above rows of places.

Circles and bars stand in columns. A line runs straight through a column and slantwise between two of them, so that it meets no
circle and no label; only lines that are in different orders on both sides cross. An arc that leads back leaves its bar to the
left and enters its circle from the right.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import dist
from typing import TypeAlias

import numpy as np

from lsys_kit.derivation.petri.net import Stages
from lsys_kit.pictures.nets.layers import Layers, layered
from lsys_kit.pictures.nets.layout import ARROW_LENGTH, BAR, EDGE, LABEL, RADIUS, BarPosition, Layout, Point, Texts

FEED, ARC, DUMMY = 4, 1, 2
"""How much it matters that the line from a circle to its bar is short and straight, that an arc is, and that a long arc is."""
SPACE, LEAST_GAP, MOST_GAP, SLOPE = 8.0, 22.0, 80.0, 0.3
"""The space between neighbours in a column; the least and the most between two columns; and how steep lines may become before
columns move apart: the gap to the height of the steepest line."""
PORT, HIGHEST_PORT = 7.0, 13.0
"""The distance of lines that end at one side of a circle or bar, and how far from the middle one may meet a circle."""
MOST_PIECES = 1_000
"""Paths are followed first from one place after another, until layers with so many pieces of lines have been made."""
TERMS, NOTE, CLEARANCE = 15.0, 14.0, 6.0
"""The height of the text above a bar, of a note on a line, and the distance from other lines that is enough for a note."""

_Patch: TypeAlias = tuple[float, float, float, float]
"""The space that a text or a shape takes: its middle, and how far it reaches to either side and up or down."""


@dataclass(frozen=True)
class _Graph:
    """The vertices of a net: its places in reading order, then the bars of these; and its edges: feeds, then arcs."""

    places: tuple[int, ...]
    bars: tuple[int, ...]
    arcs: tuple[int, ...]
    edges: tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class _Box:
    """How far a vertex reaches from its middle."""

    left: float
    right: float
    above: float
    below: float


_LINE = _Box(0.0, 0.0, 3.5, 3.5)
"""A dummy: a line that passes."""


def layered_layout(net: Stages, places: Sequence[int], texts: Texts) -> Layout:
    """The layout in layers of a net with some places shown, of which one is followed first that leads to few crossings."""
    graph = _graph(net, places)
    layers = _best_layers(graph)
    ports = _ports(graph, layers)
    boxes = _boxes(graph, layers, ports, texts)
    ys = _rows(graph, layers, ports, boxes)
    xs = _columns(layers, boxes, _rises(layers, ys), max(texts.notes.values(), default=0.0))
    return _placed(graph, layers, ports, boxes, xs, ys, texts)


def _graph(net: Stages, places: Sequence[int]) -> _Graph:
    bars = tuple(number for number, transition in enumerate(net.transitions) if transition.place in places)
    number = {place: i for i, place in enumerate(places)}
    bar = {transition: len(places) + i for i, transition in enumerate(bars)}
    arcs = tuple(i for i, arc in enumerate(net.arcs) if arc.place in number and arc.transition in bar)
    feeds = [(number[net.transitions[one].place], bar[one]) for one in bars]
    products = [(bar[net.arcs[i].transition], number[net.arcs[i].place]) for i in arcs]
    return _Graph(tuple(places), bars, arcs, (*feeds, *products))


def _best_layers(graph: _Graph) -> Layers:
    """The layers with the fewest crossings, then with the fewest arcs that lead back, over the places that may come first."""
    weights = [FEED if i < len(graph.bars) else ARC for i in range(len(graph.edges))]
    tried: list[Layers] = []
    pieces = 0
    for start in range(len(graph.places)):
        tried.append(layered(len(graph.places) + len(graph.bars), graph.edges, weights, [start]))
        pieces += sum(map(len, tried[-1].chains))
        if not tried[-1].crossings or pieces > MOST_PIECES:
            break
    return min(tried, key=lambda layers: (layers.crossings, len(layers.turned)))


def _ports(graph: _Graph, layers: Layers) -> dict[tuple[int, int], float]:
    """How far above or below the middle of a vertex an edge meets it, for each edge and its ends; a feed meets the middle."""
    place = {vertex: i for layer in layers.layers for i, vertex in enumerate(layer)}
    sides: dict[tuple[int, int], list[tuple[float, int]]] = {}
    for edge, chain in enumerate(layers.chains):
        sides.setdefault((chain[0], 1), []).append((place[chain[1]], edge))
        sides.setdefault((chain[-1], -1), []).append((place[chain[-2]], edge))
    found = {}
    for (vertex, _), members in sides.items():
        order = [edge for _, edge in sorted(members)]
        own = [i for i, edge in enumerate(order) if edge < len(graph.bars)]
        middle = own[0] if len(own) == 1 else (len(order) - 1) / 2
        reach = max(middle, len(order) - 1 - middle, 1)
        step = min(PORT, HIGHEST_PORT / reach) if vertex < len(graph.places) else PORT - 1
        found.update({(edge, vertex): (i - middle) * step for i, edge in enumerate(order)})
    return found


def _boxes(graph: _Graph, layers: Layers, ports: Mapping[tuple[int, int], float], texts: Texts) -> dict[int, _Box]:
    boxes = {}
    for i, place in enumerate(graph.places):
        across = texts.labels[place] / 2 + 4
        boxes[i] = _Box(max(RADIUS + ARROW_LENGTH, across), max(RADIUS + ARROW_LENGTH, across), RADIUS + 2, RADIUS + LABEL)
    for i, bar in enumerate(graph.bars, len(graph.places)):
        half, across = _half(i, ports), texts.terms.get(bar, 0.0) / 2 + 4
        boxes[i] = _Box(max(4.0, across), max(4.0, across), half + TERMS * (bar in texts.terms), half)
    return boxes


def _half(vertex: int, ports: Mapping[tuple[int, int], float]) -> float:
    """Half the height of a bar."""
    return max([BAR, *(abs(port) + 4 for (_, at), port in ports.items() if at == vertex)])


def _rises(layers: Layers, ys: Mapping[int, float]) -> list[float]:
    """For each two neighbouring columns the height of the steepest line between them."""
    column = {vertex: i for i, layer in enumerate(layers.layers) for vertex in layer}
    found = [0.0] * len(layers.layers)
    for chain in layers.chains:
        for a, b in pairwise(chain):
            found[column[a]] = max(found[column[a]], abs(ys[a] - ys[b]))
    return found


def _columns(
    layers: Layers, boxes: Mapping[int, _Box], rises: Sequence[float], note: float
) -> list[tuple[float, float, float]]:
    """For each column its left edge, its middle and its right edge; there is room for the widest note between two columns."""
    found, left = [], EDGE
    for i, layer in enumerate(layers.layers):
        members = [boxes.get(vertex, _LINE) for vertex in layer]
        middle = left + max(box.left for box in members)
        right = middle + max(box.right for box in members)
        found.append((left, middle, right))
        left = right + max(LEAST_GAP, 2 * note, min(MOST_GAP, SLOPE * rises[i]))
    return found


def _rows(graph: _Graph, layers: Layers, ports: Mapping[tuple[int, int], float], boxes: Mapping[int, _Box]) -> dict[int, float]:
    """The vertical position of each vertex: the solution of a linear programme, such that lines are as straight as the order of
    the columns allows."""
    from scipy.optimize import linprog
    from scipy.sparse import coo_array

    count = sum(map(len, layers.layers))
    pieces = [
        (a, b, ports.get((edge, a), 0.0) - ports.get((edge, b), 0.0), _weight(edge, a, b, graph))
        for edge, chain in enumerate(layers.chains)
        for a, b in pairwise(chain)
    ]
    neighbours = [
        (a, b, boxes.get(a, _LINE).below + boxes.get(b, _LINE).above + SPACE)
        for layer in layers.layers
        for a, b in pairwise(layer)
    ]
    entries: list[tuple[int, int, float]] = []
    bounds: list[float] = []
    for i, (a, b, shift, _) in enumerate(pieces):  # |a + shift - b| is at most the piece's own variable
        for sign in (1.0, -1.0):
            entries += [(len(bounds), a, sign), (len(bounds), b, -sign), (len(bounds), count + i, -1.0)]
            bounds.append(-sign * shift)
    for a, b, apart in neighbours:
        entries += [(len(bounds), a, 1.0), (len(bounds), b, -1.0)]
        bounds.append(-apart)
    costs = np.array([1e-6] * count + [float(weight) for *_, weight in pieces])
    rows, columns, values = zip(*entries, strict=True) if entries else ((), (), ())
    matrix = coo_array((values, (rows, columns)), shape=(len(bounds), len(costs))).tocsr()
    solved = linprog(costs, matrix if bounds else None, bounds or None, bounds=(0, None), method="highs-ds")
    top = min((solved.x[v] - boxes.get(v, _LINE).above for v in range(count)), default=0.0)
    return {v: float(solved.x[v] - top + EDGE) for v in range(count)}


def _weight(edge: int, a: int, b: int, graph: _Graph) -> int:
    real = len(graph.places) + len(graph.bars)
    return FEED if edge < len(graph.bars) else DUMMY if a >= real and b >= real else ARC


def _placed(
    graph: _Graph,
    layers: Layers,
    ports: Mapping[tuple[int, int], float],
    boxes: Mapping[int, _Box],
    xs: Sequence[tuple[float, float, float]],
    ys: Mapping[int, float],
    texts: Texts,
) -> Layout:
    column = {vertex: xs[i] for i, layer in enumerate(layers.layers) for vertex in layer}
    lines = [_line(edge, chain, graph, ports, column, ys) for edge, chain in enumerate(layers.chains)]
    lines = [line[::-1] if edge in layers.turned else line for edge, line in enumerate(lines)]
    circles = {place: (column[i][1], ys[i]) for i, place in enumerate(graph.places)}
    bars = {}
    for i, bar in enumerate(graph.bars):
        vertex = len(graph.places) + i
        x, y, half = column[vertex][1], ys[vertex], _half(vertex, ports)
        bars[bar] = BarPosition(x, y, half, lines[i], (x - texts.terms.get(bar, 0.0) / 2, y - half - 4))
    arcs = dict(zip(graph.arcs, lines[len(graph.bars) :], strict=True))
    taken = [(x, y + RADIUS + LABEL / 2, texts.labels[place] / 2, LABEL / 2) for place, (x, y) in circles.items()]
    taken += [(x, y, RADIUS, RADIUS) for x, y in circles.values()]
    taken += [(bar.x, bar.y, 2.0, bar.half) for bar in bars.values()]
    taken += [
        (bars[number].x, bars[number].y - bars[number].half - 8, width / 2, 6.0)
        for number, width in texts.terms.items()
        if number in bars
    ]
    notes = _notes(arcs, lines, texts, taken)
    width = max((right for *_, right in xs), default=0.0) + EDGE
    height = max((ys[v] + boxes.get(v, _LINE).below for v in ys), default=0.0) + EDGE
    return Layout(width, height, circles, bars, arcs, notes)


def _line(
    edge: int,
    chain: Sequence[int],
    graph: _Graph,
    ports: Mapping[tuple[int, int], float],
    column: Mapping[int, tuple[float, float, float]],
    ys: Mapping[int, float],
) -> tuple[Point, ...]:
    """The vertices of the line of an edge, from left to right."""
    heights = [ys[vertex] + ports.get((edge, vertex), 0.0) for vertex in chain]
    first, last = chain[0], chain[-1]
    line = [(column[first][1] + _reach(first, heights[0] - ys[first], graph), heights[0])]
    for (a, b), (y, z) in zip(pairwise(chain), pairwise(heights), strict=True):
        line += [(column[a][2], y), (column[b][0], z)]
    line.append((column[last][1] - _reach(last, heights[-1] - ys[last], graph), heights[-1]))
    return tuple(point for i, point in enumerate(line) if not i or point != line[i - 1])


def _reach(vertex: int, port: float, graph: _Graph) -> float:
    """How far from the middle of a vertex a line meets it."""
    return (RADIUS**2 - port**2) ** 0.5 if vertex < len(graph.places) else 0.0


def _notes(
    arcs: Mapping[int, tuple[Point, ...]], lines: Sequence[tuple[Point, ...]], texts: Texts, taken: list[_Patch]
) -> dict[int, Point]:
    """The positions of the notes of arcs: each on its line, as far from other lines and texts as it can be, within reason."""
    found: dict[int, Point] = {}
    for arc in (arc for arc in texts.notes if arc in arcs):
        others = np.array([point for line in lines if line is not arcs[arc] for point in _sampled(line)] or [(-1e6, -1e6)])
        reach = np.array([texts.notes[arc] / 2, NOTE / 2])
        boxes = np.array([(x, y, across, above) for x, y, across, above in taken] or [(-1e6, -1e6, 0, 0)])
        points = np.array(_sampled(arcs[arc])[1:-1])
        clear = np.max(np.abs(points[:, None] - others) - reach, axis=2).min(axis=1)
        apart = np.max(np.abs(points[:, None] - boxes[:, :2]) - reach - boxes[:, 2:], axis=2).min(axis=1)
        best = int(np.argmax(np.minimum(np.minimum(clear, apart), CLEARANCE)))
        found[arc] = (float(points[best][0]), float(points[best][1]))
        taken.append((*found[arc], texts.notes[arc] / 2, NOTE / 2))
    return found


def _sampled(line: Sequence[Point]) -> list[Point]:
    """Points along a line, a few pixels apart."""
    return [
        (a[0] + t / n * (b[0] - a[0]), a[1] + t / n * (b[1] - a[1]))
        for a, b in pairwise(line)
        for n in [max(2, int(dist(a, b) / 4))]
        for t in range(n + 1)
    ]
