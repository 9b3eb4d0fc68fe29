"""Rules that replace an apex X, which draws nothing (node rewriting: ABOP, section 1.4): X becomes a word of X, F, + and -,
and F becomes a straight row of F.

The first drawing is empty, the second is the stalk that X makes. Each later one is the stalk, made longer, with copies of the
one before it: where they stand says where X is in the word.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget
from lsys_kit.geometry.inference.strokes import NEAR, Points, Strokes, Turning
from lsys_kit.geometry.inference.traversals import START, Apex, Traversal, branching, word_with
from lsys_kit.geometry.scene import Floats

Places = Counter[int]


@dataclass(frozen=True)
class _Copy:
    """A copy of the stalk: which stroke it stands on, with how many turns from the heading of the start, and its strokes."""

    behind: int
    turns: int
    places: Places


class _Drawing:
    """A drawing in which strokes are looked up."""

    def __init__(self, strokes: Strokes) -> None:
        from scipy.spatial import cKDTree

        self.ends = strokes.ends
        self.tree = cKDTree(_features(strokes.ends))
        self.strokes = Counter(int(place) for place in self.places(strokes.ends) or ())

    def places(self, ends: Points) -> list[int] | None:
        near = self.tree.query_ball_point(_features(ends), NEAR)
        return [min(each) for each in near] if all(near) else None


def _features(ends: Points) -> Floats:
    """Strokes as points that are near where strokes are: their middles, and their directions up to reversal."""
    middles, along = ends.mean(axis=1), (ends[:, 1] - ends[:, 0]) ** 2
    return np.column_stack([middles.real, middles.imag, along.real, along.imag])


def node_rules(drawings: Sequence[Strokes], turning: Turning) -> Iterator[tuple[str, int]]:
    """Successors of X that may draw these pictures, each with the number of F that F becomes.

    >>> from lsys_kit.geometry.inference.strokes import read_drawings
    >>> fork = [(0, 0, 0, 1), (0, 1, 1, 1), (0, 1, -1, 1)]
    >>> ("F[-X]+X", 1) in [*node_rules(read_drawings([[], [(0, 0, 0, 1)], fork]), Turning(90))]
    True
    """
    stalk, drawing = drawings[1], _Drawing(drawings[2])
    counts = [len(each) for each in drawings]
    for longer in range(1, counts[2] // counts[1] + 1):
        copies, rest = divmod(counts[2] - longer * counts[1], counts[1])
        if copies and not rest and counts[3:4] in ([], [longer**2 * counts[1] + copies * counts[2]]):
            for way in _ways(stalk, turning):
                for left, found in _standing(way, stalk, drawing, longer, turning):
                    yield from ((_word(way, turning, some), longer) for some in _covers(found, left, copies))


def _ways(stalk: Strokes, turning: Turning) -> Iterator[Traversal]:
    """A way to draw the stalk from each of its points: all of them make the same."""
    seen = set[int]()
    for way in branching(stalk, turning, len(stalk)):
        if way.points[0] not in seen:
            seen.add(way.points[0])
            yield way


def _standing(
    way: Traversal, stalk: Strokes, drawing: _Drawing, longer: int, turning: Turning
) -> Iterator[tuple[Places, list[_Copy]]]:
    """Where the long stalk can be in a drawing: the other strokes, and the copies that can stand on it there."""
    ends = stalk.ends - stalk.point(way.points[0])
    parts = np.concatenate([ends[:, :1] * (longer - each) + ends[:, 1:] * each for each in range(longer + 1)], axis=1)
    long = np.concatenate([parts[:, each : each + 2] for each in range(longer)])
    begin, along = long[0, 0], long[0, 1] - long[0, 0]
    for one, other in np.concatenate([drawing.ends, drawing.ends[:, ::-1]]):
        check_budget()
        turn = (other - one) / along
        places = drawing.places((long - begin) * turn + one)
        if places is not None and not (taken := Counter(places)) - drawing.strokes:
            start = one - begin * turn
            yield (
                drawing.strokes - taken,
                [
                    _Copy(behind, int(turns), Counter(found))
                    for behind, point in enumerate(way.points, START)
                    for turns in turning.several
                    if (
                        found := drawing.places(
                            start
                            + turn * ((stalk.point(point) - stalk.point(way.points[0])) * longer + ends * turning.by(turns))
                        )
                    )
                ],
            )


def _covers(copies: Sequence[_Copy], left: Places, many: int) -> Iterator[tuple[_Copy, ...]]:
    """The choices of so many copies whose strokes are just those that are left."""
    check_budget()
    if not many:
        if not left:
            yield ()
        return
    place = min(left, default=None)
    for copy in copies:
        if place in copy.places and not copy.places - left:
            yield from ((copy, *others) for others in _covers(copies, left - copy.places, many - 1))


def _word(way: Traversal, turning: Turning, copies: Sequence[_Copy]) -> str:
    """The word that draws the stalk, with an apex for each copy."""
    headings = {START: 0}
    for number, (before, turns) in enumerate(zip(way.before, way.turns, strict=True)):
        headings[number] = headings[before] + turns
    apices: dict[int, list[Apex]] = {}
    for copy in copies:
        turn = turning.number(np.radians((copy.turns - headings[copy.behind]) * turning.degrees))
        apices.setdefault(copy.behind, []).append(Apex(turn or 0))
    return word_with(way, apices)
