"""Repairs of rules for walls: a side, a label, an arrow changed, a marker or a wall left out or added."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.maps import MapAnswer, with_given
from lsys_kit.classroom.exercises.repairs.repair import Repair
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.notation.model.cells import OTHER_SIDE, Edge, EdgeProduction, Marker, SuccessorPart

ARROWS = ("", ">", "<")


def of_maps(exercise: Exercise, mine: MapAnswer, wanted: MapAnswer) -> Iterator[Repair]:
    """Repairs of rules for walls: of one part, then of two of the same kind."""
    labels = sorted({edge.label for rule in (*mine.own, *wanted.own) for edge in (rule.predecessor, *rule.named)})
    right = [part for rule in wanted.own for part in rule.successor]
    for at, rule in enumerate(mine.own):
        rest = (*mine.own[:at], *mine.own[at + 1 :])
        yield Repair(partial(_made, exercise, mine, rest), partial(_said, "extra_production", rule))
    for at, rule in enumerate(mine.own):
        for successor, kind in _changed(rule, labels, right):
            if not (successor and isinstance(successor[0], Edge) and isinstance(successor[-1], Edge)):
                continue
            rules = (*mine.own[:at], replace(rule, successor=successor), *mine.own[at + 1 :])
            yield Repair(partial(_made, exercise, mine, rules), partial(_said, kind, rule))
        for other in wanted.own:
            rules = (*mine.own[:at], replace(rule, predecessor=other.predecessor), *mine.own[at + 1 :])
            yield Repair(partial(_made, exercise, mine, rules), partial(_said, "predecessor", rule))
            yield Repair(
                partial(_made, exercise, mine, (*mine.own[:at], other, *mine.own[at + 1 :])),
                partial(_whole, rule, other),
                near=False,
            )
    for other in wanted.own:
        if other.predecessor not in {rule.predecessor for rule in mine.own}:
            said = partial(reply, "repair.missing_production", module=other.predecessor)
            yield Repair(partial(_made, exercise, mine, (*mine.own, other)), said)


def _made(exercise: Exercise, mine: MapAnswer, rules: Sequence[EdgeProduction]) -> MapAnswer:
    if mine.own == mine.system.productions or not exercise.given:
        return MapAnswer(replace(mine.system, productions=tuple(rules)), tuple(rules))
    return with_given(exercise, rules)


def _said(kind: str, rule: EdgeProduction) -> str:
    return f"{reply(f'repair.{kind}')}\n  {rule}"


def _whole(rule: EdgeProduction, right: EdgeProduction) -> str:
    """What is said of a rule that differs by more than one thing: of its walls, its markers or both."""
    own, other = ([edge.label for edge in each.edges] for each in (rule, right))
    if own == other:
        return _said("markers", rule)
    return _said("walls_number" if len(own) != len(other) else "walls_labels", rule)


def _changed(
    rule: EdgeProduction, labels: Sequence[str], right: Sequence[SuccessorPart]
) -> Iterator[tuple[tuple[Any, ...], str]]:
    row = rule.successor
    for at, part in enumerate(row):
        for changed, kind in _variants(part, labels):
            yield (*row[:at], changed, *row[at + 1 :]), kind
        yield (*row[:at], *row[at + 1 :]), "extra_marker" if isinstance(part, Marker) else "extra_wall"
    for at in range(len(row) - 1):
        yield (*row[:at], row[at + 1], row[at], *row[at + 2 :]), "order"
    for new in dict.fromkeys((*right, *row)):
        for at in range(len(row) + 1):
            yield (*row[:at], new, *row[at:]), "missing_marker" if isinstance(new, Marker) else "missing_wall"
    yield from _all_changed(row)
    yield row[::-1], "order"


def _variants(part: SuccessorPart, labels: Sequence[str]) -> Iterator[tuple[SuccessorPart, str]]:
    edge = part.edge if isinstance(part, Marker) else part
    of_label = "label" if isinstance(part, Marker) else "walls_labels"
    others = [(replace(edge, label=label), of_label) for label in labels if label != edge.label]
    others += [(replace(edge, arrow=arrow), "arrow") for arrow in ARROWS if arrow != edge.arrow]
    if isinstance(part, Marker):
        yield replace(part, side=OTHER_SIDE[part.side]), "side"
        yield from ((replace(part, edge=other), kind) for other, kind in others)
    else:
        yield from others


def _all_changed(row: Sequence[SuccessorPart]) -> Iterator[tuple[tuple[object, ...], str]]:
    """All walls, or all markers, with another label or without an arrow."""
    labels = {(part.edge if isinstance(part, Marker) else part).label for part in row}
    for label in sorted(labels):
        yield tuple(replace(p, label=label) if isinstance(p, Edge) else p for p in row), "walls_labels"
        yield tuple(replace(p, edge=replace(p.edge, label=label)) if isinstance(p, Marker) else p for p in row), "label"
    for arrow in ARROWS:
        yield tuple(replace(p, arrow=arrow) if isinstance(p, Edge) else p for p in row), "arrow"
        yield tuple(replace(p, edge=replace(p.edge, arrow=arrow)) if isinstance(p, Marker) else p for p in row), "arrow"
