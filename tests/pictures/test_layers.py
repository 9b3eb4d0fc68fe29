"""Layers of graphs: laws of every layering, and how seldom the arcs of the catalogue's stage diagrams cross."""

from __future__ import annotations

import re
from itertools import combinations, pairwise
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from lsys_kit import book_systems, draw, read, stages, system, systems
from lsys_kit.errors import LSystemError
from lsys_kit.pictures.nets import parts
from lsys_kit.pictures.nets.layers import Layers, _least, _Pull, layered
from lsys_kit.pictures.nets.layout import Layout, Texts, crossings
from lsys_kit.pictures.nets.parts import LABEL_SIZE, LEGIBLE, PAGE, clearest_layout
from lsys_kit.pictures.nets.rows import rows_of, shown_places
from lsys_kit.pictures.style.labels import steering_of


@st.composite
def graphs(drawn: st.DrawFn) -> tuple[int, list[tuple[int, int]]]:
    """Graphs without loops, as those of places and bars are."""
    count = drawn(st.integers(1, 9))
    vertex = st.integers(0, count - 1)
    return count, [(a, b) for a, b in drawn(st.lists(st.tuples(vertex, vertex), max_size=16)) if a != b]


def layers_of(graph: tuple[int, list[tuple[int, int]]]) -> Layers:
    return layered(*graph, [1] * len(graph[1]))


@given(graphs())
def test_an_edge_runs_from_layer_to_layer(graph: tuple[int, list[tuple[int, int]]]) -> None:
    found = layers_of(graph)
    rank = {vertex: number for number, layer in enumerate(found.layers) for vertex in layer}
    for number, (edge, chain) in enumerate(zip(graph[1], found.chains, strict=True)):
        assert (chain[0], chain[-1]) == (edge[::-1] if number in found.turned else edge)
        assert all(rank[b] == rank[a] + 1 for a, b in pairwise(chain))


@given(graphs(), st.randoms(use_true_random=False))
def test_lengths_are_as_short_as_a_linear_programme_makes_them(
    graph: tuple[int, list[tuple[int, int]]], chance: Random
) -> None:
    """And the values are the least of those with which they are."""
    count, edges = graph
    pulls = [_Pull(min(edge), max(edge), chance.randint(0, 4), chance.choice((0.0, 1.0, 2.5))) for edge in edges]
    found = _least(count, pulls)
    costs = np.zeros(count)
    for pull in pulls:
        costs[[pull.lower, pull.upper]] += -pull.weight, pull.weight
        assert found[pull.upper] - found[pull.lower] >= pull.least - 1e-6
    rows = np.array([[(v == pull.lower) - (v == pull.upper) for v in range(count)] for pull in pulls], float).reshape(-1, count)
    least = linprog(costs + 1e-4, rows, [-pull.least for pull in pulls], bounds=(0, None)).x
    assert found == pytest.approx(least, abs=1e-5)


@given(graphs())
def test_each_vertex_stands_in_one_layer(graph: tuple[int, list[tuple[int, int]]]) -> None:
    found = layers_of(graph)
    placed = [vertex for layer in found.layers for vertex in layer]
    assert sorted(placed) == [*range(graph[0]), *sorted({v for chain in found.chains for v in chain if v >= graph[0]})]


@given(graphs())
def test_crossings_are_counted_as_one_sees_them(graph: tuple[int, list[tuple[int, int]]]) -> None:
    found = layers_of(graph)
    place = {vertex: number for layer in found.layers for number, vertex in enumerate(layer)}
    rank = {vertex: number for number, layer in enumerate(found.layers) for vertex in layer}
    pieces = [piece for chain in found.chains for piece in pairwise(chain)]
    assert found.crossings == sum(
        rank[a] == rank[c] and (place[a] - place[c]) * (place[b] - place[d]) < 0 for (a, b), (c, d) in combinations(pieces, 2)
    )


def test_a_tree_has_no_crossings() -> None:
    assert layered(7, [(0, 5), (0, 4), (5, 1), (5, 2), (4, 3), (4, 6)], [1] * 6).crossings == 0


def test_an_edge_that_closes_a_cycle_leads_back() -> None:
    assert layered(3, [(0, 1), (1, 2), (2, 0)], [1] * 3).turned == {2}
    assert layered(3, [(0, 1), (1, 2), (2, 0)], [1] * 3, [1]).turned == {0}


def layout(name: str) -> Layout | None:
    try:
        net = stages(system(name))
    except LSystemError:
        return None
    rows = rows_of(net, shown_places(net, steering_of(net.system)))
    return clearest_layout(net, rows, Texts(dict.fromkeys(range(len(net.places)), 20.0), {}, {}))


@pytest.mark.slow
def test_arcs_cross_seldom() -> None:
    layouts = [found for name in systems() if (found := layout(name))]
    assert sum(map(crossings, layouts)) <= 45


def smallest_text_on_a_page(svg: str) -> float:
    """The size of the smallest text of a picture that is made as small as a page is wide."""
    sizes = [float(size) for size in re.findall(r'<text [^>]*font-size="([\d.]+)"', svg)]
    sizes += [LABEL_SIZE * float(share) / 100 for share in re.findall(r'font-size="(\d+)%"', svg)]
    width = int(re.findall(r'width="(\d+)"', svg)[0])
    return min(sizes) * min(1.0, PAGE / width)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["J6", "K12", "K15", "P5", "ABOP-3.2", "ABOP-5.12b"])
def test_text_is_legible_on_a_page(name: str) -> None:
    assert smallest_text_on_a_page(draw(stages(system(name))).svg) >= LEGIBLE


def layout_within(name: str, widest: float) -> Layout:
    net = stages(system(name))
    shown = rows_of(net, shown_places(net, steering_of(net.system)))
    return clearest_layout(net, shown, Texts(dict.fromkeys(range(len(net.places)), 20.0), {}, {}), widest)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["K12", "ABOP-3.2", "J6"])
def test_what_would_be_too_wide_is_folded_without_more_crossings(name: str) -> None:
    wide, narrow, line = (layout_within(name, widest) for widest in (10_000, 700, 1))
    assert line.width < narrow.width <= 700 < wide.width
    assert narrow.height > wide.height
    assert crossings(narrow) == crossings(wide)
    for x, y in [point for points in narrow.arcs.values() for point in points]:
        assert 0 < x < narrow.width
        assert 0 < y < narrow.height


@pytest.mark.slow
def test_what_would_begin_with_another_stage_than_rows_stands_in_rows() -> None:
    wide, narrow = layout_within("P5", 10_000), layout_within("P5", 700)
    assert wide.width > 700 > narrow.width
    assert len({y for _, y in narrow.circles.values()}) == 2


@pytest.mark.slow
@pytest.mark.parametrize("name", [*systems(), *book_systems()])
def test_a_diagram_fits_a_column_and_arrows_lead_to_its_bars(name: str) -> None:
    net = stages(system(name))
    found = parts.parts_of(net, False, steering_of(net.system))
    assert max(bar.x for bar in found.bars) <= PAGE * 11 / LEGIBLE if found.bars else True
    for bar in found.bars:
        *_, turn, end = re.findall(r"(-?[\d.]+) (-?[\d.]+)(?=[A-Z]|$)", bar.line)
        assert float(end[0]) == pytest.approx(bar.x, abs=0.1)
        assert float(turn[0]) < float(end[0]), "from the left"


@pytest.mark.parametrize("name", ["P5", "P6", "P7"])
def test_the_stage_of_the_axiom_comes_first(name: str) -> None:
    net = stages(system(name))
    first, *others = parts.parts_of(net, False, steering_of(net.system)).places
    assert first.place == 0
    assert all((first.y, first.x) < (place.y, place.x) for place in others)


def test_a_row_of_stages_without_crossings_stays_a_row() -> None:
    found = layout("J4")
    assert found is not None
    assert len({y for _, y in found.circles.values()}) == 2


@pytest.mark.slow
def test_a_net_with_very_many_arcs_stands_in_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of 60 symbols becomes 4 others: to look for layers of so many arcs would take minutes."""
    names = [f"s{number}" for number in range(60)]
    rules = [
        f"{name} -> {' '.join(names[(7 * number + 11 * copy) % 60] for copy in range(4))}" for number, name in enumerate(names)
    ]
    net = stages(read("\n".join([f"alphabet: {' '.join(names)}", f"axiom: {' '.join(names)}", *rules])))
    monkeypatch.setattr(parts, "layered_layout", None)
    assert len(parts.parts_of(net, False, steering_of(net.system)).arcs) == 240


def test_a_sensitive_function_is_called_as_the_model_calls_it() -> None:
    net = stages(read("\\angle 30,\n\\var f0 function 2 1,\n\\axiom a,\n(f0(1) > 60) a # F100 a"))
    assert [transition.condition for transition in net.transitions] == ["f0(1) > 60"]
