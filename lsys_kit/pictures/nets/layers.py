"""The layout of a stage diagram in layers, from left to right: for nets whose arcs would cross too often above rows of places.

After K. Sugiyama, S. Tagawa and M. Toda, "Methods for visual understanding of hierarchical system structures" (1981), and
E. R. Gansner, E. Koutsofios, S. C. North and K.-P. Vo, "A technique for drawing directed graphs" (1993): edges that close a
cycle are turned round; each vertex then gets a layer behind those of its predecessors; an edge across several layers is cut by
dummy vertices into pieces; and the vertices of each layer are ordered such that few pieces cross.

Circles and bars stand in columns. A line runs straight through a column and slantwise between two of them, so that it meets no
circle and no label; only lines that are in different orders on both sides cross. An arc that leads back leaves its bar to the
left and enters its circle from the right.

What is too wide is folded, as a line of text is broken: its columns go on in a tier below, where few lines lead from one column
to the next. These turn round side by side.
"""

from __future__ import annotations

from bisect import bisect_right, insort
from collections import defaultdict, deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from math import dist, inf
from random import Random
from typing import NamedTuple, TypeAlias

from lsys_kit.budget import check_budget
from lsys_kit.derivation.petri.net import Stages
from lsys_kit.pictures.nets.layout import ARROW_LENGTH, BAR, EDGE, LABEL, RADIUS, BarPosition, Layout, Point, Texts

SWEEPS, STARTS = 6, 6
"""How often the layers are ordered up and down from one first order, and from how many first orders."""
FEED, ARC, DUMMY = 4, 1, 2
"""How much it matters that the line from a circle to its bar is short and straight, that an arc is, and that a long arc is."""
SPACE = 8.0
"""The space between neighbours in a column."""
GAPS = ((22.0, 80.0, 0.3), (8.0, 24.0, 0.1))
"""The least and the most space between two columns, and how steep lines may become before these move apart: the gap to the
height of the steepest line; and the same where there is too little room for that."""
HEAD = 9.0
"""The least straight piece of a line before a bar: room for the head of an arrow."""
PORT, HIGHEST_PORT = 7.0, 13.0
"""The distance of lines that end at one side of a circle or bar, and how far from the middle one may meet a circle."""
MOST_FOR_AXIOM = 2
"""So many crossings more there may be where the stage of the axiom comes first."""
MOST_PIECES = 1_000
"""Paths are followed first from one place after another, until layers with so many pieces of lines have been made."""
TIER, BESIDE = 6, 12.0
"""One tier more is as bad as so many lines that turn round; and how far these are from what they pass."""
TERMS, NOTE, CLEARANCE = 15.0, 14.0, 6.0
"""The height of the text above a bar, of a note on a line, and the distance from other lines that is enough for a note."""

_Patch: TypeAlias = tuple[float, float, float, float]
"""The space that a text or a shape takes: its middle, and how far it reaches to either side and up or down."""
_Column: TypeAlias = tuple[float, float, float]
"""The left edge, the middle and the right edge of a column."""
_Piece: TypeAlias = tuple[int, int, int]
"""A piece of a line: the number of its edge, and the vertices from which and to which it leads, from left to right."""
_Arc: TypeAlias = tuple[int, int, int, float]
"""The number of a pull, 1 upwards or -1 downwards, where it leads, and how much higher that is."""
NEGLIGIBLE = 1e-9
_Neighbours: TypeAlias = Mapping[int, Sequence[int]]
"""For each vertex its neighbours in the next layer, or in the one before."""


class Layers(NamedTuple):
    """A graph in layers: the vertices of each in their order (those from the graph's number of vertices on are dummies); for
    each edge the vertices that it runs through, from the first layer to the last; the numbers of the edges that were turned
    round, whose chains run from target to source; and the number of crossings of pieces of edges."""

    layers: tuple[tuple[int, ...], ...]
    chains: tuple[tuple[int, ...], ...]
    turned: frozenset[int]
    crossings: int


def layered(count: int, edges: Sequence[tuple[int, int]], weights: Sequence[int], first: Sequence[int] = ()) -> Layers:
    """The layers of a graph of so many vertices, given source and target of each edge, how much it matters that it is short,
    and vertices from which paths are followed first; an edge that leads back to where a path came from is turned round.

    >>> layered(4, [(0, 1), (1, 2), (2, 0), (0, 3)], [1, 1, 1, 1])
    Layers(layers=((0,), (1, 3, 4), (2,)), chains=((0, 1), (1, 2), (0, 4, 2), (0, 3)), turned=frozenset({2}), crossings=0)
    """
    turned = _closing(count, edges, first)
    onward = [(target, source) if number in turned else (source, target) for number, (source, target) in enumerate(edges)]
    ranks = _ranks(count, onward, weights)
    order: list[list[int]] = [[] for _ in range(max(ranks, default=-1) + 1)]
    for vertex, rank in enumerate(ranks):
        order[rank].append(vertex)
    chains, dummy = [], count
    for source, target in onward:
        between = range(ranks[source] + 1, ranks[target])
        chains.append((source, *range(dummy, dummy + len(between)), target))
        for rank in between:
            order[rank].append(dummy)
            dummy += 1
    best, crossings = _ordered(order, [piece for chain in chains for piece in pairwise(chain)])
    return Layers(tuple(map(tuple, best)), tuple(chains), frozenset(turned), crossings)


def _closing(count: int, edges: Sequence[tuple[int, int]], first: Sequence[int]) -> set[int]:
    """The numbers of the edges that close a cycle of a search in depth: they lead to where it is not finished yet."""
    after: list[list[int]] = [[] for _ in range(count)]
    for source, target in edges:
        after[source].append(target)
    finished, seen = dict[int, int](), set[int]()
    for start in (*first, *range(count)):
        way = [] if start in seen else [(start, iter(after[start]))]
        seen.add(start)
        while way:
            vertex, onward = way[-1]
            other = next((each for each in onward if each not in seen), None)
            if other is None:
                finished[vertex] = len(finished)
                way.pop()
            else:
                seen.add(other)
                way.append((other, iter(after[other])))
    return {number for number, (source, target) in enumerate(edges) if finished[target] >= finished[source]}


def _ranks(count: int, edges: Sequence[tuple[int, int]], weights: Sequence[int]) -> list[int]:
    """The layer of each vertex such that the weighted sum of the edges' lengths is least."""
    pulls = [_Pull(source, target, weight, 1) for (source, target), weight in zip(edges, weights, strict=True)]
    return [round(rank) for rank in _least(count, pulls)]


class _Pull(NamedTuple):
    """An edge that is to be short: the value of its upper end is by so much above that of its lower end at least."""

    lower: int
    upper: int
    weight: int
    least: float


def _least(count: int, pulls: Sequence[_Pull], helping: int = 0) -> list[float]:
    """The values of variables for which the weighted sum of the lengths of pulls is least, each as small as it can be then, and
    none below 0 but of those that help, which come last.

    The dual is a flow of greatest gain: pulls that carry some of it are as short as they may be. It begins with each pull's own
    weight, and goes round cycles of gain, until there is none (M. Klein, 1967).
    """
    flow, values = [pull.weight for pull in pulls], [0.0] * (count + helping)
    arcs: list[list[_Arc]] = [[] for _ in values]
    for number, (lower, upper, _, least) in enumerate(pulls):
        arcs[lower].append((number, 1, upper, least))
        arcs[upper].append((number, -1, lower, -least))
    while cycle := _raised(values, arcs, flow):
        check_budget()
        more = min(flow[number] for number, way in cycle if way < 0)
        for number, way in cycle:
            flow[number] += way * more
    values = [0.0] * count + [-inf] * helping
    _raised(values, arcs, flow)
    return values


def _raised(values: list[float], arcs: Sequence[Sequence[_Arc]], flow: Sequence[int]) -> list[tuple[int, int]]:
    """Raise values as far as pulls, and those with a flow in both directions, ask for it; or a cycle that raises itself."""
    queue, behind = deque(range(len(values))), dict[int, tuple[int, int, int]]()
    while queue:
        vertex = queue.popleft()
        for number, way, other, gain in arcs[vertex]:
            if (way > 0 or flow[number]) and values[vertex] + gain > values[other] + NEGLIGIBLE:
                values[other], behind[other] = values[vertex] + gain, (vertex, number, way)
                cycle, at = [(number, way)], vertex
                while at != other and at in behind:
                    at, *arc = behind[at]
                    cycle.append((arc[0], arc[1]))
                if at == other:
                    return cycle
                if other not in queue:
                    queue.append(other)
    return []


def _ordered(layers: list[list[int]], pieces: Iterable[tuple[int, int]]) -> tuple[list[list[int]], int]:
    """The best order found from several first orders: the one given, and shuffled ones that are the same every time."""
    after, before = defaultdict[int, list[int]](list), defaultdict[int, list[int]](list)
    for a, b in pieces:
        after[a].append(b)
        before[b].append(a)
    best, fewest = layers, _crossings(layers, after)
    shuffled = Random(0)  # noqa: S311
    for start in range(STARTS if fewest else 0):
        order = [shuffled.sample(layer, len(layer)) for layer in layers] if start else [list(layer) for layer in layers]
        for now in _swept(order, after, before):
            count = _crossings(now, after)
            if count < fewest:
                best, fewest = [list(layer) for layer in now], count
            if not fewest:
                return best, 0
    return best, fewest


def _swept(order: list[list[int]], after: _Neighbours, before: _Neighbours) -> Iterator[list[list[int]]]:
    """Orders that become better: each layer by the mean place of its neighbours in the layer before, and after, in turn."""
    for sweep in range(SWEEPS):
        check_budget()
        neighbours, way = (before, -1) if sweep % 2 == 0 else (after, 1)
        for number in range(1, len(order)) if way < 0 else range(len(order) - 2, -1, -1):
            places = _places(order[number], neighbours, order[number + way])
            means = {vertex: sum(found) / len(found) for vertex, found in places.items() if found}
            movable = iter(sorted(means, key=means.__getitem__))  # others stay where they are
            order[number] = [next(movable) if vertex in means else vertex for vertex in order[number]]
        _transpose(order, after, before)
        yield order


def _transpose(order: list[list[int]], after: _Neighbours, before: _Neighbours) -> None:
    """Exchange neighbours in a layer as long as that removes crossings."""
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


def _places(layer: Sequence[int], neighbours: _Neighbours, beside: Sequence[int]) -> dict[int, list[int]]:
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


def _crossings(order: Sequence[Sequence[int]], after: _Neighbours) -> int:
    total = 0
    for layer, following in pairwise(order):
        seen: list[int] = []
        for ends in _places(layer, after, following).values():
            total += sum(len(seen) - bisect_right(seen, end) for end in ends)
            for end in ends:
                insort(seen, end)
    return total


class _Box(NamedTuple):
    """How far a vertex reaches from its middle."""

    left: float
    right: float
    above: float
    below: float


_LINE = _Box(0.0, 0.0, 3.5, 3.5)
"""A dummy: a line that passes."""


def layered_layout(net: Stages, places: Sequence[int], texts: Texts, widest: float = inf) -> Layout:
    """The layout in layers of a net with some places shown, of which one is followed first that leads to few crossings.

    Where it would be too wide, columns stand closer, or else in tiers, if these begin with the place that comes first.
    """
    found, (usual, close) = _InLayers(net, places, texts), GAPS
    for gaps in (usual, close):
        width, _ = found.arranged(gaps)
        if width <= widest:
            return found.layout()
    if 0 in found.layers.layers[0]:
        sizes = {gaps: found.arranged(gaps, widest) for gaps in GAPS}
        found.arranged(min(sizes, key=lambda gaps: (sizes[gaps][0] > widest, sizes[gaps][1])), widest)
    return found.layout()


class _InLayers:
    """A diagram in layers. Its vertices are the places in reading order, then their bars, its edges the feeds of bars, then
    arcs; an edge meets a vertex at a port, so far above or below its middle."""

    def __init__(self, net: Stages, places: Sequence[int], texts: Texts) -> None:
        self.places, self.texts = places, texts
        self.bars = [number for number, transition in enumerate(net.transitions) if transition.place in places]
        number = {place: i for i, place in enumerate(places)}
        bar = {transition: len(places) + i for i, transition in enumerate(self.bars)}
        self.arcs = [i for i, arc in enumerate(net.arcs) if arc.place in number and arc.transition in bar]
        self.edges = [(number[net.transitions[one].place], bar[one]) for one in self.bars]
        self.edges += [(bar[net.arcs[i].transition], number[net.arcs[i].place]) for i in self.arcs]
        self.vertices = len(places) + len(self.bars)
        self.layers = self._best_layers()
        self.ports = self._ports()
        self.boxes = self._boxes()
        self.heights = self._rows([0])

    def _best_layers(self) -> Layers:
        """The layers with the fewest crossings, then with the fewest arcs that lead back, over the places that may come
        first; that of the axiom comes first unless that costs too many."""
        weights = [FEED if i < len(self.bars) else ARC for i in range(len(self.edges))]
        tried = []
        pieces = 0
        for start in range(len(self.places)):
            tried.append(layered(self.vertices, self.edges, weights, [start]))
            pieces += sum(map(len, tried[-1].chains))
            if not tried[-1].crossings or pieces > MOST_PIECES:
                break
        best = min(tried, key=lambda layers: (layers.crossings, len(layers.turned)))
        axiom = self.places.index(min(self.places)) if self.places else 0
        from_axiom = tried[axiom] if axiom < len(tried) else best
        return from_axiom if from_axiom.crossings <= best.crossings + MOST_FOR_AXIOM else best

    def _ports(self) -> dict[tuple[int, int], float]:
        """For each edge and its ends the port; a feed meets the middle."""
        place = {vertex: i for layer in self.layers.layers for i, vertex in enumerate(layer)}
        sides: dict[tuple[int, int], list[tuple[int, int]]] = {}
        for edge, chain in enumerate(self.layers.chains):
            sides.setdefault((chain[0], 1), []).append((place[chain[1]], edge))
            sides.setdefault((chain[-1], -1), []).append((place[chain[-2]], edge))
        found = {}
        for (vertex, _), members in sides.items():
            order = [edge for _, edge in sorted(members)]
            own = [i for i, edge in enumerate(order) if edge < len(self.bars)]
            middle = own[0] if len(own) == 1 else (len(order) - 1) / 2
            reach = max(middle, len(order) - 1 - middle, 1)
            step = min(PORT, HIGHEST_PORT / reach) if vertex < len(self.places) else PORT - 1
            found.update({(edge, vertex): (i - middle) * step for i, edge in enumerate(order)})
        return found

    def _boxes(self) -> defaultdict[int, _Box]:
        boxes: defaultdict[int, _Box] = defaultdict(lambda: _LINE)
        for i, place in enumerate(self.places):
            across = max(RADIUS + ARROW_LENGTH, self.texts.labels[place] / 2 + 4)
            boxes[i] = _Box(across, across, RADIUS + 2, RADIUS + LABEL)
        for i, bar in enumerate(self.bars, len(self.places)):
            half, across = self._half(i), max(4.0, self.texts.terms.get(bar, 0.0) / 2 + 4)
            boxes[i] = _Box(max(across, HEAD), across, half + TERMS * (bar in self.texts.terms), half)
        return boxes

    def _half(self, vertex: int) -> float:
        """Half the height of a bar."""
        return max([BAR, *(abs(port) + 4 for (_, at), port in self.ports.items() if at == vertex)])

    def _rows(self, tiers: Sequence[int]) -> dict[int, float]:
        """The vertical position of each vertex, such that lines are as straight as the order of the columns allows.

        Lines between two tiers, which begin with some layers, need not be straight.
        """
        bent = {piece for start in tiers if start for piece in self._cut(start)}
        count, pulls = sum(map(len, self.layers.layers)), list[_Pull]()
        lines = [(edge, a, b) for edge, chain in enumerate(self.layers.chains) for a, b in pairwise(chain)]
        pieces = [piece for piece in lines if piece not in bent]
        for number, (edge, a, b) in enumerate(pieces, count):  # a variable of its own below both ends draws them together
            shift = self.ports.get((edge, a), 0.0) - self.ports.get((edge, b), 0.0)
            weight = FEED if edge < len(self.bars) else DUMMY if min(a, b) >= self.vertices else ARC
            pulls += [_Pull(number, a, weight, -shift), _Pull(number, b, weight, 0.0)]
        for layer in self.layers.layers:
            for a, b in pairwise(layer):
                pulls.append(_Pull(a, b, 0, self.boxes[a].below + self.boxes[b].above + SPACE))
        ys = _least(count, pulls, len(pieces))
        top = min((ys[v] - self.boxes[v].above for v in range(count)), default=0.0)
        return {v: float(ys[v] - top + EDGE) for v in range(count)}

    def _columns(self, least: float, most: float, slope: float) -> dict[int, _Column]:
        """For each vertex the left edge, the middle and the right edge of its column; between two columns there is room for the
        widest note and the steepest line."""
        found, left, note = dict[int, _Column](), EDGE, max(self.texts.notes.values(), default=0.0)
        rise: defaultdict[int, float] = defaultdict(float)  # of the steepest line onward from a vertex
        for a, b in (piece for chain in self.layers.chains for piece in pairwise(chain)):
            rise[a] = max(rise[a], abs(self.heights[a] - self.heights[b]))
        for layer in self.layers.layers:
            middle = left + max(self.boxes[vertex].left for vertex in layer)
            right = middle + max(self.boxes[vertex].right for vertex in layer)
            found.update(dict.fromkeys(layer, (left, middle, right)))
            left = right + max(least, 2 * note, min(most, slope * max(rise[vertex] for vertex in layer)))
        return found

    def _tiers(self, columns: Mapping[int, _Column], widest: float) -> list[int]:
        """The layers with which tiers begin that are narrow enough, if there are such, and few lines turn round."""
        layers, count, shown = self.layers.layers, len(self.layers.layers), len(self.bars)
        round_ends = [self._cut(layer) for layer in range(count + 1)]
        costs = [sum(MOST_PIECES if edge < shown else 1 for edge, *_ in cut) for cut in round_ends]  # no feed, if possible
        best: list[tuple[float, list[int]]] = [(0, [])]
        for end in range(1, count + 1):
            found = []
            for start in range(end):
                width = columns[layers[end - 1][0]][2] - columns[layers[start][0]][0] + 2 * EDGE
                fits = width + self._room(round_ends[start]) + self._room(round_ends[end]) <= widest
                found.append((best[start][0] + costs[start] + TIER + (0 if fits else inf), [*best[start][1], start]))
            best.append(min(found))
        return best[count][1]

    def _cut(self, layer: int) -> list[_Piece]:
        """The pieces of lines that lead to a layer from the one before."""
        behind = {*(self.layers.layers[layer] if layer < len(self.layers.layers) else ())}
        chains = enumerate(self.layers.chains)
        return [(edge, a, b) for edge, chain in chains for a, b in pairwise(chain) if b in behind]

    def _pitch(self, cut: Sequence[_Piece]) -> float:
        """How far lines that turn round are from one another: there is room for notes, if they have any."""
        arcs = (self.arcs[edge - len(self.bars)] for edge, *_ in cut if edge >= len(self.bars))
        return NOTE if any(arc in self.texts.notes for arc in arcs) else PORT

    def _room(self, cut: Sequence[_Piece]) -> float:
        """How much room they take."""
        return BESIDE + self._pitch(cut) * len(cut) if cut else 0.0

    def _at(self, edge: int, vertex: int) -> float:
        """How high a line meets a vertex."""
        return self.ys[vertex] + self.ports.get((edge, vertex), 0.0)

    def _fold(self, columns: Mapping[int, _Column], tiers: Sequence[int]) -> None:
        """Set columns and heights in tiers, for each piece of a line between two of these its corners; and the size of all."""
        self.column, self.ys, self.corners = dict[int, _Column](), dict[int, float](), dict[tuple[int, int], list[Point]]()
        heights, right, bottom, width = self._rows(tiers) if tiers[1:] else self.heights, 0.0, 0.0, 0.0
        for start, end in pairwise([*tiers, len(self.layers.layers)]):
            tier, cut = [v for layer in self.layers.layers[start:end] for v in layer], self._cut(start) if start else []
            cut.sort(key=lambda piece: self._at(*piece[:2]))
            left = EDGE + self._room(cut)
            aside = left - columns[tier[0]][0]
            down = bottom + self._room(cut) + (BESIDE if start else EDGE) - min(heights[v] - self.boxes[v].above for v in tier)
            self.column |= {v: (a + aside, b + aside, c + aside) for v in tier for a, b, c in [columns[v]]}
            self.ys |= {v: heights[v] + down for v in tier}
            entering = sorted(cut, key=lambda piece: self._at(piece[0], piece[2]))
            for place, (edge, a, b) in enumerate(cut):
                lane = BESIDE + self._pitch(cut) * (len(cut) - 1 - place)
                back = left - BESIDE - self._pitch(cut) * entering.index((edge, a, b))
                x, y = right + lane, bottom + lane
                self.corners[edge, a] = [(x, self._at(edge, a)), (x, y), (back, y), (back, self._at(edge, b))]
            right = max(self.column[v][2] for v in tier)
            bottom = max(self.ys[v] + self.boxes[v].below for v in tier)
            width = max(width, right + self._room(self._cut(end)))
        self.size = width + EDGE, bottom + EDGE

    def arranged(self, gaps: tuple[float, float, float], widest: float = inf) -> tuple[float, float]:
        """The width and height with some gaps between the columns, in tiers of at most a width; the layout has these then."""
        columns = self._columns(*gaps)
        self._fold(columns, self._tiers(columns, widest))
        return self.size

    def layout(self) -> Layout:
        """The coordinates."""
        lines = [self._line(edge, chain) for edge, chain in enumerate(self.layers.chains)]
        lines = [line[::-1] if edge in self.layers.turned else line for edge, line in enumerate(lines)]
        circles = {place: (self.column[i][1], self.ys[i]) for i, place in enumerate(self.places)}
        bars = {}
        for i, bar in enumerate(self.bars):
            vertex = len(self.places) + i
            x, y, half = self.column[vertex][1], self.ys[vertex], self._half(vertex)
            bars[bar] = BarPosition(x, y, half, lines[i], (x - self.texts.terms.get(bar, 0.0) / 2, y - half - 4))
        arcs = dict(zip(self.arcs, lines[len(self.bars) :], strict=True))
        taken = [(x, y + RADIUS + LABEL / 2, self.texts.labels[place] / 2, LABEL / 2) for place, (x, y) in circles.items()]
        taken += [(x, y, RADIUS, RADIUS) for x, y in circles.values()]
        taken += [(bar.x, bar.y, 2.0, bar.half) for bar in bars.values()]
        terms = ((bars[number], width) for number, width in self.texts.terms.items() if number in bars)
        taken += [(bar.x, bar.y - bar.half - 8, width / 2, 6.0) for bar, width in terms]
        return Layout(*self.size, circles, bars, arcs, _notes(arcs, lines, self.texts, taken))

    def _line(self, edge: int, chain: Sequence[int]) -> tuple[Point, ...]:
        """The vertices of the line of an edge, from left to right."""
        ports = [self.ports.get((edge, vertex), 0.0) for vertex in chain]
        heights = [self._at(edge, vertex) for vertex in chain]
        line = [(self.column[chain[0]][1] + self._reach(chain[0], ports[0]), heights[0])]
        for (a, b), (y, z) in zip(pairwise(chain), pairwise(heights), strict=True):
            line += [(self.column[a][2], y), *self.corners.get((edge, a), ()), (self.column[b][0], z)]
        line.append((self.column[chain[-1]][1] - self._reach(chain[-1], ports[-1]), heights[-1]))
        return tuple(point for i, point in enumerate(line) if not i or point != line[i - 1])

    def _reach(self, vertex: int, port: float) -> float:
        """How far from the middle of a vertex a line meets it."""
        return (RADIUS**2 - port**2) ** 0.5 if vertex < len(self.places) else 0.0


def _notes(
    arcs: Mapping[int, tuple[Point, ...]], lines: Sequence[tuple[Point, ...]], texts: Texts, taken: list[_Patch]
) -> dict[int, Point]:
    """The positions of the notes of arcs: each on its line, as far from other lines and texts as it can be, within reason."""
    found = {}
    for arc in (arc for arc in texts.notes if arc in arcs):
        across, above = texts.notes[arc] / 2, NOTE / 2
        others = [(*point, 0.0, 0.0) for line in lines if line is not arcs[arc] for point in _sampled(line)]
        best, most = (0.0, 0.0), -inf
        for x, y in _sampled(arcs[arc])[1:-1]:
            room = CLEARANCE
            for left, top, width, height in (*taken, *others):
                room = min(room, max(abs(x - left) - across - width, abs(y - top) - above - height))
                if room <= most:
                    break
            if room > most:
                best, most = (x, y), room
            if most == CLEARANCE:
                break
        found[arc] = best
        taken.append((*best, across, above))
    return found


def _sampled(line: Sequence[Point]) -> list[Point]:
    """Points along a line, a few pixels apart."""
    return [
        (a[0] + t / n * (b[0] - a[0]), a[1] + t / n * (b[1] - a[1]))
        for a, b in pairwise(line)
        for n in [max(2, int(dist(a, b) / 4))]
        for t in range(n + 1)
    ]
