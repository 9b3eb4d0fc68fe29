"""Misconceptions about rules for walls: from a right map system to those that somebody writes instead."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import groupby

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.maps import MapAnswer, with_given
from lsys_kit.classroom.exercises.kinds.table import solution_of
from lsys_kit.classroom.exercises.misconceptions.answers import WrongAnswers
from lsys_kit.classroom.exercises.misconceptions.misconception import Misconception
from lsys_kit.notation.model.cells import Edge, EdgeProduction, Marker, SuccessorPart


def _by_rules(change: Callable[[EdgeProduction], EdgeProduction]) -> WrongAnswers:
    """The answers of somebody who writes another rule for each wall."""

    def answers(exercise: Exercise) -> Iterator[MapAnswer]:
        if exercise.kind == "map":
            right = solution_of(exercise).own
            wrong = tuple(map(change, right))
            if wrong != right:
                yield with_given(exercise, wrong)

    return answers


def _by_parts(change: Callable[[EdgeProduction, SuccessorPart], SuccessorPart | None]) -> WrongAnswers:
    """The same for each part of a rule; what is None is left out."""

    def changed(rule: EdgeProduction) -> EdgeProduction:
        made = (change(rule, part) for part in rule.successor)
        return replace(rule, successor=tuple(part for part in made if part is not None))

    return _by_rules(changed)


def _labels_exchanged(rule: EdgeProduction, part: SuccessorPart) -> SuccessorPart:
    """The label of the first marker for that of the first wall, and the other way round."""
    if not rule.markers:
        return part
    wall, marked = rule.edges[0].label, rule.markers[0].edge.label
    other = {wall: marked, marked: wall}
    if isinstance(part, Edge):
        return replace(part, label=other.get(part.label, part.label))
    return replace(part, edge=replace(part.edge, label=other.get(part.edge.label, part.edge.label)))


def _label_of_the_old_wall(rule: EdgeProduction, part: SuccessorPart) -> SuccessorPart:
    return part if isinstance(part, Edge) else replace(part, edge=replace(part.edge, label=rule.predecessor.label))


def _new_wall_between(rule: EdgeProduction) -> EdgeProduction:
    """The markers of a vertex as a wall between the parts of the old one."""
    parts: list[SuccessorPart] = []
    for marked, group in groupby(rule.successor, lambda part: isinstance(part, Marker)):
        these = [*group]
        parts += [these[0].edge] if marked and isinstance(these[0], Marker) else these
    return replace(rule, successor=tuple(parts))


def _markers_left_out(_: EdgeProduction, part: SuccessorPart) -> SuccessorPart | None:
    return part if isinstance(part, Edge) else None


def _all_leading_away(_: EdgeProduction, part: SuccessorPart) -> SuccessorPart:
    return part if isinstance(part, Edge) else replace(part, edge=replace(part.edge, arrow=">"))


def _sides_exchanged(_: EdgeProduction, part: SuccessorPart) -> SuccessorPart:
    return part if isinstance(part, Edge) else part.turned


_APPLIES = "kind map"

OF_MAPS = (
    Misconception(
        "wall labels exchanged",
        _APPLIES,
        "exchange the labels of the old wall and of the new one",
        "What stands outside the brackets is what the wall itself becomes; the label in the brackets is that of the new wall.",
        _by_parts(_labels_exchanged),
    ),
    Misconception(
        "new wall like the old one",
        _APPLIES,
        "give the new wall the label of the wall from which it begins",
        "The label in the brackets is that of the new wall. It may be any other.",
        _by_parts(_label_of_the_old_wall),
    ),
    Misconception(
        "new wall inside the old one",
        _APPLIES,
        "write the new wall between the parts of the old one",
        "What stands outside the brackets stays in the old wall. A new wall grows out of it from a marker, in brackets.",
        _by_rules(_new_wall_between),
    ),
    Misconception(
        "markers left out",
        _APPLIES,
        "leave the markers out",
        "Walls are divided so, but no cell: a new wall begins and ends at markers.",
        _by_parts(_markers_left_out),
    ),
    Misconception(
        "markers all lead away",
        _APPLIES,
        "let all markers lead away from their walls",
        "Two markers with arrows match if one leads away and the other comes towards, and if their labels are equal.",
        _by_parts(_all_leading_away),
    ),
    Misconception(
        "marker sides exchanged",
        _APPLIES,
        "exchange the two sides of a wall",
        "Clockwise round a cell its inside is on the right of each wall, the side of -.",
        _by_parts(_sides_exchanged),
    ),
)
