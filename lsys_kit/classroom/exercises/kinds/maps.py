"""Map systems as answers: right where their maps are, in every step, however their rules are written.

Two maps are the same if one can be laid on the other: their walls with labels and directions, their cells with the walls around
them, clockwise, and which walls and vertices lie next to which. So the order of two markers at one vertex does not matter.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from lsys_kit.budget import counted
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.typed import read_typed, text_answer
from lsys_kit.derivation.tissues.development import develop
from lsys_kit.derivation.tissues.maps import Map, cell_words
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.dialects.map.dialect import read_map
from lsys_kit.notation.model.cells import Edge, EdgeProduction, MapSystem
from lsys_kit.notation.read import cells_notation

if TYPE_CHECKING:
    import networkx as nx

_AXIOM = re.compile(r"\s*(axiom|\\?omega|ω)\s*[:=]", re.IGNORECASE)
"""How L-systems begin, and maps too, if somebody likes."""
MOST_WALLS_LAID = 200
"""Larger maps are compared by their cells and walls alone."""


@dataclass(frozen=True)
class MapAnswer:
    """A map system as somebody answers it: the whole, and the productions that were typed."""

    system: MapSystem
    own: tuple[EdgeProduction, ...]


def with_given(exercise: Exercise, own: Sequence[EdgeProduction]) -> MapAnswer:
    """Some productions with what the question gives, which must have the first cell.

    >>> rule = read_map("map: AAB\\nA -> AA").productions
    >>> print(with_given(Exercise("1", "", "map", "", "", "", (), given="map: AAA"), rule).system)
    map: AAA
    A -> AA
    """
    given = read_map(exercise.given)
    system = MapSystem(given.axiom, (*own, *given.productions), given.steps, given.sphere)
    return MapAnswer(read_map(str(system)), tuple(own))  # which finds what is wrong with the rules together


def _read(exercise: Exercise, answer: object) -> MapAnswer:
    if isinstance(answer, MapSystem):
        return MapAnswer(answer, answer.productions)
    return read_typed(text_answer(answer, reply("map.what"), '"A -> B[-A][+A]B"'), lambda typed: _read_text(exercise, typed))


def _read_text(exercise: Exercise, text: str) -> MapAnswer:
    if cells_notation(text) == "map" or _AXIOM.match(text) or not exercise.given:
        whole = read_map(text)
        return MapAnswer(whole, whole.productions)
    given = read_map(exercise.given).productions
    own = tuple(each for each in read_map(f"{text}\n{exercise.given}").productions if each not in given)
    if not own:
        raise ModelValueError(reply("system.not_given"), hint=reply("map.form"))
    return with_given(exercise, own)


# Which maps are the same


def same_maps(one: Map, other: Map) -> bool:
    """Whether one map can be laid on the other.

    >>> ring, row = (develop(read_map(f"map: {walls}"), 0)[0] for walls in ("ABAB", "AABB"))
    >>> same_maps(ring, ring), same_maps(ring, row)
    (True, False)
    """
    if one.counts != other.counts or cells_of(one) != cells_of(other) or _walls_of(one) != _walls_of(other):
        return False
    return len(one.walls) > MOST_WALLS_LAID or _same_graphs(_graph(one), _graph(other))


def _same_graphs(one: nx.Graph[tuple[str, int]], other: nx.Graph[tuple[str, int]]) -> bool:
    import networkx as nx

    return bool(nx.is_isomorphic(one, other, lambda a, b: a["kind"] == b["kind"], lambda a, b: a["way"] == b["way"]))


def cells_of(found: Map) -> Counter[tuple[Edge, ...]]:
    """How many cells there are with the same walls around them."""
    return Counter(cell_words(found))


def _walls_of(found: Map) -> Counter[tuple[str, bool]]:
    return Counter((wall.label, wall.directed) for wall in found.walls)


def _graph(found: Map) -> nx.Graph[tuple[str, int]]:
    import networkx as nx

    graph: nx.Graph[tuple[str, int]] = nx.Graph()
    for number, wall in enumerate(counted(found.walls)):
        graph.add_node(("wall", number), kind=(wall.label, wall.directed))
        for vertex, way in ((wall.start, 1), (wall.end, -1)):
            graph.add_node(("vertex", vertex), kind="vertex")
            graph.add_edge(("wall", number), ("vertex", vertex), way=way if wall.directed else 0)
    for number, cell in enumerate(counted(found.cells)):
        graph.add_node(("cell", number), kind="cell")
        for side in cell:
            forward = found.walls[side.wall].directed and side.forward
            graph.add_edge(("cell", number), ("wall", side.wall), way=forward)
    return graph


def _same(exercise: Exercise, mine: MapAnswer, wanted: MapAnswer) -> bool:
    return _first_step_apart(exercise, mine, wanted) is None


def _alike(exercise: Exercise, mine: MapAnswer, other: MapAnswer) -> bool:
    """Whether an answer is a wrong one that is understood: it has the same markers, and not others that never match."""
    markers, others = (Counter(marker for each in answer.own for marker in each.markers) for answer in (mine, other))
    return markers == others and _same(exercise, mine, other)


def _first_step_apart(exercise: Exercise, mine: MapAnswer, wanted: MapAnswer) -> int | None:
    pairs = zip(develop(mine.system, exercise.steps), develop(wanted.system, exercise.steps), strict=True)
    return next((step for step, (one, other) in enumerate(pairs) if not same_maps(one, other)), None)


def _steps_right(exercise: Exercise, mine: MapAnswer, wanted: MapAnswer) -> tuple[int, int]:
    """How many steps are right in a row, of those that are not right without the rules that were typed."""
    rules = read_map(exercise.given).productions if exercise.given else ()
    untyped = MapAnswer(MapSystem(wanted.system.axiom, rules, sphere=wanted.system.sphere), ())
    given = _agreeing_steps(exercise, untyped, wanted)
    return max(_agreeing_steps(exercise, mine, wanted) - given, 0), exercise.steps - given


def _agreeing_steps(exercise: Exercise, mine: MapAnswer, wanted: MapAnswer) -> int:
    apart = _first_step_apart(exercise, mine, wanted)
    return exercise.steps if apart is None else max(apart - 1, 0)


# What to say


def _difference(exercise: Exercise, mine: MapAnswer, wanted: MapAnswer) -> Difference:
    step = _first_step_apart(exercise, mine, wanted)
    if not step:
        return Difference(reply("map.first_cell"))
    own, other = develop(mine.system, step)[step], develop(wanted.system, step)[step]
    mine_cells, wanted_cells = cells_of(own), cells_of(other)
    likeness = (mine_cells & wanted_cells).total() / max(mine_cells.total(), wanted_cells.total())
    if not _has_rule(mine.system):
        return Difference(reply("map.no_rule", walls=" ".join(map(str, mine.system.axiom))), likeness, explains=True)
    return Difference(_in_words(step, own, other), likeness)


def _has_rule(system: MapSystem) -> bool:
    replaced = {(rule.predecessor.label, bool(rule.predecessor.arrow)) for rule in system.productions}
    return any((edge.label, bool(edge.arrow)) in replaced for edge in system.axiom)


def _in_words(step: int, own: Map, other: Map) -> str:
    many = len(own.cells)
    if many != len(other.cells):
        return f"{reply('map.cells', number=many, step=step, count=many)} {reply('map.wrong_number')}"
    strange = next((cell for cell in cell_words(own) if cell not in cells_of(other)), None)
    if strange is None:
        return reply("map.neighbours", step=step)
    return reply("map.strange_cell", step=step, walls=" ".join(map(str, strange)))


def _honest(_: Exercise, mine: MapAnswer, __: MapAnswer) -> bool:
    """There is a rule with a marker, without which no cell can be divided."""
    return any(each.markers for each in mine.own)


def _praise(exercise: Exercise, _: MapAnswer, __: MapAnswer) -> str:
    return reply("map.agree", last=exercise.steps)


MAP = AnswerKind(_read, _difference, _same, _honest, _praise, _alike, _steps_right)
