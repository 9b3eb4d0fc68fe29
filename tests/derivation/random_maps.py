"""Random map systems for laws: directed rules, and neutral ones that are the same from both ends."""

from __future__ import annotations

from hypothesis import strategies as st

from lsys_kit.notation.model.cells import Edge, EdgeProduction, MapSystem, Marker, SuccessorPart

LABELS = ("A", "B", "C", "x1")

neutral = st.builds(Edge, st.sampled_from(LABELS))
directed = st.builds(Edge, st.sampled_from(LABELS), st.sampled_from("<>"))
edges = st.one_of(neutral, directed)
markers = st.builds(Marker, st.sampled_from("+-"), st.one_of(neutral, neutral, directed))


def _other_end(part: SuccessorPart) -> SuccessorPart:
    return part.turned


@st.composite
def successors(draw: st.DrawFn) -> tuple[SuccessorPart, ...]:
    """Walls with markers between them."""
    parts: list[SuccessorPart] = [draw(edges)]
    for _ in range(draw(st.integers(0, 2))):
        parts += (*draw(st.lists(markers, max_size=3)), draw(edges))
    return tuple(parts)


@st.composite
def palindromes(draw: st.DrawFn) -> tuple[SuccessorPart, ...]:
    """The same from both ends: half of it, something in the middle that is, and the half from the other end."""
    half = draw(successors())
    mirrored = tuple(_other_end(part) for part in reversed(half))
    between = draw(st.lists(markers, max_size=2))
    if draw(st.booleans()):
        middle: tuple[SuccessorPart, ...] = (draw(neutral),)
        between_too = [_other_end(part) for part in reversed(between)]
        return (*half, *between, *middle, *between_too, *mirrored)
    return (*half, *between, *(_other_end(part) for part in reversed(between)), *mirrored)


@st.composite
def map_systems(draw: st.DrawFn) -> MapSystem:
    """A cell with three to five walls, and productions of some of the walls that there may be."""
    axiom = tuple(draw(st.lists(edges, min_size=3, max_size=5)))
    predecessors = draw(st.lists(st.one_of(neutral, st.builds(Edge, st.sampled_from(LABELS), st.just(">"))), unique=True))
    productions = tuple(EdgeProduction(edge, draw(successors() if edge.arrow else palindromes())) for edge in predecessors)
    return MapSystem(axiom, productions, draw(st.none() | st.integers(0, 9)))
