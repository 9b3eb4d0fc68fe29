"""Random cellwork systems for laws: boxes whose neutral edges become the same from both ends, or are divided in the middle."""

from __future__ import annotations

from hypothesis import strategies as st

from lsys_kit.notation.dialects.cellwork.dialect import read_cellwork
from lsys_kit.notation.model.cells import CellworkProduction, CellworkSystem, Edge, EdgeMarker, WallProduction

CORNERS = "cellwork: 1(0,0,0) 2(1,0,0) 3(1,1,0) 4(0,1,0) 5(0,0,1) 6(1,0,1) 7(1,1,1) 8(0,1,1)"
WALLS = (
    "1 {a} 2 {b} 3 {a} 4 {b}",
    "5 {a} 6 {b} 7 {a} 8 {b}",
    "1 {a} 2 {c} 6 {a} 5 {c}",
    "4 {a} 3 {c} 7 {a} 8 {c}",
    "1 {b} 4 {c} 8 {b} 5 {c}",
    "2 {b} 3 {c} 7 {b} 6 {c}",
)
EDGES, KINDS = ("A", "B", "C"), ("S", "T", "U")
BOX = "\n".join(
    (CORNERS, *(f"wall {label}: {wall.format(a='A', b='A', c='A')}" for label, wall in zip("SSTTUU", WALLS, strict=True)))
)
"""A box with edges A and walls S below and above, T in front and behind, U on the left and on the right."""

neutral = st.builds(Edge, st.sampled_from(EDGES))
kinds = st.sampled_from(KINDS)


@st.composite
def markers(draw: st.DrawFn) -> EdgeMarker:
    """A marker with the same daughters on both sides."""
    daughter = draw(kinds)
    wall = draw(st.sampled_from((*KINDS, "*", "*", "*")))
    return EdgeMarker(wall, draw(neutral), (daughter, daughter), draw(st.sampled_from("SSSSST")))


@st.composite
def productions(draw: st.DrawFn, label: str) -> CellworkProduction:
    """An edge becomes another one, or two with markers between them, or three."""
    one, count = draw(neutral), draw(st.sampled_from((1, 2, 2, 2, 3)))
    some = [*{marker.wall: marker for marker in draw(st.lists(markers(), max_size=3))}.values()]
    successor: tuple[Edge | EdgeMarker, ...] = (one,) if count == 1 else (one, *some, one)
    if count == 3:
        successor = (one, *some, draw(neutral), *some, one)
    return CellworkProduction(Edge(label), successor)


@st.composite
def cellwork_systems(draw: st.DrawFn) -> CellworkSystem:
    """A box, and productions of some of its edges and walls."""
    a, b, c = (draw(st.sampled_from(EDGES)) for _ in range(3))
    b, c = draw(st.sampled_from(((b, c), (b, b), (a, a), ("A", "B"))))
    walls = [f"wall {draw(kinds)}: {wall.format(a=a, b=b, c=c)}" for wall in WALLS]
    box = read_cellwork("\n".join((CORNERS, *walls)))
    made = tuple(draw(productions(label)) for label in EDGES if draw(st.integers(0, 3)))
    undivided = tuple(WallProduction(kind, draw(kinds)) for kind in KINDS if draw(st.booleans()))
    return CellworkSystem(box.corners, box.walls, made, undivided, draw(st.none() | st.integers(0, 9)))
