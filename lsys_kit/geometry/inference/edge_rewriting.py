"""Rules that replace strokes by strokes (edge rewriting: ABOP, section 1.3): F becomes a word of F, + and -, with brackets.

The first drawing is the axiom. Every way to draw it, and the strokes that one of its own becomes, is a candidate, with turns
behind the word. (Turns before it change nothing that others behind it do not: +S- for S turns the drawing of step n by n
turns.)
What candidates draw is computed for all turns at once.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise, product
from typing import TYPE_CHECKING, Any, TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget
from lsys_kit.geometry.inference.strokes import Strokes, Turning
from lsys_kit.geometry.inference.traversals import START, Traversal, branching, in_one_go, word_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

Numbers: TypeAlias = "NDArray[np.complex128]"
Drawn: TypeAlias = tuple[Numbers, Numbers, Numbers, Numbers]
"""Shape (k, n) each, of k candidates: the middle and the direction of each stroke; shape (k,): where the turtle ends, and its
heading then, where it begins at 0 with the heading 1."""
OFF = 1e-3
"""How far the spread of strokes may be off, as a share."""


def factor_of(drawings: Sequence[Strokes]) -> int | None:
    counts = [len(each) for each in drawings]
    if not counts[0]:
        return None
    factor, rest = divmod(counts[1], counts[0])
    grows = all(later == factor * earlier for earlier, later in pairwise(counts))
    return factor if grows and not rest and factor else None


def edge_rules(drawings: Sequence[Strokes], turning: Turning, factor: int) -> Iterator[tuple[str, str]]:
    """Axioms with successors of F that may draw these pictures; those without brackets first, alone if there are any.

    >>> from lsys_kit.geometry.inference.strokes import read_drawings
    >>> pictures = read_drawings([[(0, 0, 0, 1)], [(0, 0, 0, 1), (0, 1, 1, 1)]])
    >>> ("F", "F-F") in [*edge_rules(pictures, Turning(90), 2)]
    True
    """
    for ways in (in_one_go, branching):
        axioms = _different(ways(drawings[0], turning, len(drawings[0])), ends=False)
        successors = _different(ways(drawings[1], turning, factor), ends=True)
        found = False
        for (axiom, first), (_, way) in product(axioms.items(), successors.items()):
            for behind in _fitting(first, way, drawings, turning):
                found = True
                yield axiom, word_of(way, behind)
        if found:
            return


def _different(ways: Iterator[Traversal], ends: bool) -> dict[str, Traversal]:
    """Ways to draw with different words; where a turtle ends may not matter."""
    found: dict[str, Traversal] = {}
    for way in ways:
        if ends or way.last == len(way) - 1:
            found.setdefault(word_of(way), way)
    return dict(sorted(found.items(), key=lambda item: (len(item[0]), item[0])))


def _fitting(axiom: Traversal, way: Traversal, drawings: Sequence[Strokes], turning: Turning) -> Iterator[int]:
    """The turns behind a successor with which the spread of the strokes is that of the drawings."""
    check_budget()
    behind = np.array(sorted(turning.several, key=abs))
    drawn = _stroke(len(behind))
    for drawing in drawings[1:3]:
        drawn = _placed(way, drawn, turning, behind)
        middles, directions, *_ = _placed(axiom, drawn, turning, np.zeros_like(behind))
        fits = _alike(_spread(middles, directions), _spread(*_middles(drawing)))
        behind, drawn = behind[fits], tuple(each[fits] for each in drawn)
    yield from map(int, behind)


def _stroke(many: int) -> Drawn:
    return np.full((many, 1), 0.5 + 0j), np.ones((many, 1), complex), np.ones(many, complex), np.ones(many, complex)


def _placed(way: Traversal, drawn: Drawn, turning: Turning, behind: NDArray[np.int64]) -> Drawn:
    """What a way to draw makes, each of whose strokes has become something, with some turns behind it."""
    middles, directions, end, heading = drawn
    start = np.zeros(len(behind), complex), np.ones(len(behind), complex)
    ends: list[tuple[Numbers, Numbers]] = []
    all_middles, all_directions = [], []
    for before, turns in zip(way.before, way.turns, strict=True):
        place, towards = start if before == START else ends[before]
        towards = towards * turning.by(turns)
        all_middles.append(place[:, None] + towards[:, None] * middles)
        all_directions.append(towards[:, None] * directions)
        ends.append((place + towards * end, towards * heading))
    place, towards = start if way.last == START else ends[way.last]
    return np.hstack(all_middles), np.hstack(all_directions), place, towards * turning.by(behind)


def _middles(strokes: Strokes) -> tuple[Numbers, Numbers]:
    ends = strokes.ends[None]
    return ends.mean(axis=2), ends[:, :, 1] - ends[:, :, 0]


def _spread(middles: Numbers, directions: Numbers) -> Numbers:
    """Numbers that no motion of a drawing changes: how far strokes are from its centre, and how they stand to it."""
    off = middles - middles.mean(axis=1, keepdims=True)
    far = abs(off) ** 2
    return np.stack(
        [
            far.mean(axis=1),
            (far**2).mean(axis=1) ** 0.5,
            (off**2).mean(axis=1).__abs__(),
            ((off * directions.conj()).real ** 2).mean(axis=1),
        ],
        axis=1,
    )


def _alike(own: Numbers, other: Numbers) -> Any:
    return (abs(own - other) <= OFF * (1 + abs(other))).all(axis=1)
