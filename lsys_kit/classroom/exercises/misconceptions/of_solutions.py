"""Misconceptions about formulas, numbers, rows, stage diagrams and rules for walls: from the right answer to wrong ones."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import combinations, groupby
from typing import Any

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.maps import with_given
from lsys_kit.classroom.exercises.kinds.nets import Firing, Net
from lsys_kit.classroom.exercises.kinds.table import solution_of
from lsys_kit.classroom.exercises.misconceptions.misconception import misconception
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.cells import Edge, EdgeProduction, Marker, SuccessorPart
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, expression_type, names_in
from lsys_kit.notation.model.modules import CLOSING, OPENING, Module


def of_kind(change: Callable[[Any], Iterable[object]], kind: str, exercise: Exercise) -> Iterator[Any]:
    """The answers that are the right one changed, in questions of one kind."""
    if exercise.kind == kind:
        yield from change(solution_of(exercise))


# Formulas


def in_formulas(change: Callable[[Expression], Expression], exercise: Exercise) -> Iterator[Expression]:
    """The right formula with each of its parts changed, if that changes anything."""
    if exercise.kind == "expression":
        right = solution_of(exercise)
        wrong = changed(right, change)
        if wrong != right:
            yield wrong


def changed(formula: Expression, change: Callable[[Expression], Expression]) -> Expression:
    """A formula with each of its parts changed, from the innermost on."""
    if isinstance(formula, Apply):
        formula = replace(formula, operands=tuple(changed(operand, change) for operand in formula.operands))
    return change(formula)


def substituted(formula: Expression, values: Mapping[str, Expression]) -> Expression:
    """A formula with other expressions for its names."""
    return changed(formula, lambda found: values.get(found.name, found) if isinstance(found, Name) else found)


def with_operator(others: Mapping[str, str], found: Expression) -> Expression:
    return replace(found, operator=others.get(found.operator, found.operator)) if isinstance(found, Apply) else found


OTHER_STRICTNESS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
OTHER_DIRECTION = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "!=", "!=": "=="}
misconception("adding for multiplying", in_formulas)(partial(with_operator, {"*": "+"}))
misconception("strictness confused", in_formulas)(partial(with_operator, OTHER_STRICTNESS))
misconception("comparison reversed", in_formulas)(partial(with_operator, OTHER_DIRECTION))


def _is_power(found: Expression, of_names: bool) -> bool:
    """Whether an expression is a power, with names in the exponent or without."""
    return isinstance(found, Apply) and found.operator == "^" and bool(names_in(found.operands[1])) == of_names


def multiplied_for_raised(of_names: bool, found: Expression) -> Expression:
    """A product in place of a power: where the exponent grows, growth that is linear in place of exponential.

    >>> from lsys_kit.notation.read import read_expression
    >>> print(changed(read_expression("x^2 > L^n"), partial(multiplied_for_raised, False)))
    x * 2 > L^n
    """
    return with_operator({"^": "*"}, found) if _is_power(found, of_names) else found


misconception("linear for exponential", in_formulas)(partial(multiplied_for_raised, True))
misconception("power as product", in_formulas)(partial(multiplied_for_raised, False))


@misconception("power left out", in_formulas)
def power_left_out(found: Expression) -> Expression:
    return found.operands[0] if isinstance(found, Apply) and _is_power(found, of_names=False) else found


@misconception("ratio inverted", in_formulas)
def ratio_inverted(found: Expression) -> Expression:
    return replace(found, operands=found.operands[::-1]) if isinstance(found, Apply) and found.operator == "/" else found


@misconception("degrees and radians", in_formulas)
def radians_in_formula(found: Expression) -> Expression:
    """Angles of sine, cosine and tangent in radians, where the kit's are in degrees."""
    if not (isinstance(found, Apply) and found.operator in ("sin", "cos", "tan")):
        return found
    return replace(found, operands=(Apply("*", (found.operands[0], Number(Fraction(math.pi / 180)))),))


@misconception("names exchanged", of_kind, "expression")
def names_exchanged(formula: Expression) -> Iterator[Expression]:
    """Two names exchanged.

    >>> from lsys_kit.notation.read import read_expression
    >>> print(*names_exchanged(read_expression("d - s + 1")))
    s - d + 1
    """
    for one, other in combinations(sorted(names_in(formula)), 2):
        yield substituted(formula, {one: Name(other), other: Name(one)})


def of_counts(change: Callable[[Expression], Iterable[Expression]], exercise: Exercise) -> Iterator[object]:
    """The right formula changed, where something in it is counted: a name that stands for whole numbers alone."""
    if any(all(isinstance(value, int) for value in values) for values in exercise.values.values()):
        yield from of_kind(change, "expression", exercise)


def _as_a_whole(operator: str, others: tuple[Expression, ...], formula: Expression) -> list[Expression]:
    return [Apply(operator, (formula, *others))] if expression_type(formula) == "number" else []


misconception("one too many", of_counts)(partial(_as_a_whole, "+", (Number(1),)))
misconception("one too few", of_counts)(partial(_as_a_whole, "-", (Number(1),)))
misconception("sign reversed", of_kind, "expression")(partial(_as_a_whole, "-x", ()))


# Numbers


def of_angles(change: Callable[[Value], Iterable[Value]], exercise: Exercise) -> Iterator[Value]:
    """The right number changed, where it is an angle."""
    if exercise.unit in ("degrees", "radians", "°"):
        yield from of_kind(change, "number", exercise)


@misconception("fence post", of_kind, "number")
@misconception("walls for cells", of_kind, "number")
def next_number(number: Value) -> list[Value]:
    return [number + 1, number - 1]


@misconception("degrees and radians", of_angles)
def other_angle_unit(number: Value) -> list[Value]:
    return [math.degrees(number), math.radians(number)]


@misconception("angle between strokes", of_angles)
def supplement(number: Value) -> list[Value]:
    return [180 - number]


@misconception("sign reversed", of_kind, "number")
def opposite(number: Value) -> list[Value]:
    return [-number] if number else []


@misconception("number inverted", of_kind, "number")
def inverse(number: Value) -> list[Value]:
    return [] if number in (0, 1, -1) else [1 / number if isinstance(number, float) else Fraction(1) / number]


@misconception("contrary", of_kind, "number")
def complement(number: Value) -> list[Value]:
    """The rest to one: the probability of the contrary."""
    return [1 - number] if 0 <= number <= 1 else []


@misconception("percent", of_kind, "number")
def percent(number: Value) -> list[Value]:
    return [100 * number] if number else []


@misconception("word reversed", of_kind, "word")
@misconception("word reversed", of_kind, "table")
def backwards(solution: Sequence[object]) -> list[tuple[object, ...]]:
    """A row from its end to its beginning; none of a word with brackets, which read backwards close nothing."""
    brackets = any(isinstance(each, Module) and each.symbol in OPENING | CLOSING for each in solution)
    return [] if brackets else [tuple(reversed(solution))]


# Nets


@misconception("arcs reversed", of_kind, "net")
def arcs_reversed(net: Net) -> Iterator[Net]:
    yield replace(
        net, firings=tuple(Firing(place, ((firing.place, copies),)) for firing in net.firings for place, copies in firing.made)
    )


@misconception("copies not counted", of_kind, "net")
def copies_not_counted(net: Net) -> Iterator[Net]:
    yield replace(net, firings=tuple(replace(f, made=tuple((place, 1) for place, _ in f.made)) for f in net.firings))


@misconception("one daughter", of_kind, "net")
def one_daughter(net: Net) -> Iterator[Net]:
    for at in (0, -1):
        yield replace(net, firings=tuple(replace(f, made=f.made[at:][:1]) for f in net.firings))


@misconception("stage left out", of_kind, "net")
def last_stage_skipped(net: Net) -> Iterator[Net]:
    """A net that lacks one of the places that tokens only pass through."""
    for passed in net.firings:
        if sum(copies for _, copies in passed.made) == 1 and passed.made[0][0] != passed.place:
            target = passed.made[0][0]
            yield replace(net, firings=tuple(_led_to(f, passed.place, target) for f in net.firings if f is not passed))


def _led_to(firing: Firing, place: str, target: str) -> Firing:
    copies: Counter[str] = Counter()
    for each, count in firing.made:
        copies[target if each == place else each] += count
    return replace(firing, made=tuple(sorted(copies.items())))


# Walls


def in_wall_rules(change: Callable[[EdgeProduction], EdgeProduction], exercise: Exercise) -> Iterator[object]:
    """The answers of somebody who writes another rule for each wall."""
    if exercise.kind == "map":
        right = solution_of(exercise).own
        wrong = tuple(map(change, right))
        if wrong != right:
            yield with_given(exercise, wrong)


def in_markers(change: Callable[[EdgeProduction, Marker], Marker], exercise: Exercise) -> Iterator[object]:
    """The same for each marker of a rule."""

    def with_markers(rule: EdgeProduction) -> EdgeProduction:
        return replace(
            rule, successor=tuple(change(rule, part) if isinstance(part, Marker) else part for part in rule.successor)
        )

    return in_wall_rules(with_markers, exercise)


@misconception("wall labels exchanged", in_wall_rules)
def wall_labels_exchanged(rule: EdgeProduction) -> EdgeProduction:
    """The label of the first marker for that of the first wall, and the other way round."""
    if not rule.markers:
        return rule
    wall, marked = rule.edges[0].label, rule.markers[0].edge.label
    other = {wall: marked, marked: wall}

    def renamed(edge: Edge) -> Edge:
        return replace(edge, label=other.get(edge.label, edge.label))

    parts = (renamed(part) if isinstance(part, Edge) else replace(part, edge=renamed(part.edge)) for part in rule.successor)
    return replace(rule, successor=tuple(parts))


@misconception("new wall like the old one", in_markers)
def label_of_the_old_wall(rule: EdgeProduction, marker: Marker) -> Marker:
    return replace(marker, edge=replace(marker.edge, label=rule.predecessor.label))


@misconception("new wall inside the old one", in_wall_rules)
def new_wall_between(rule: EdgeProduction) -> EdgeProduction:
    """The markers of a vertex as a wall between the parts of the old one."""
    parts: list[SuccessorPart] = []
    for marked, group in groupby(rule.successor, lambda part: isinstance(part, Marker)):
        these = [*group]
        parts += [these[0].edge] if marked and isinstance(these[0], Marker) else these
    return replace(rule, successor=tuple(parts))


@misconception("markers left out", in_wall_rules)
def markers_left_out(rule: EdgeProduction) -> EdgeProduction:
    return replace(rule, successor=tuple(part for part in rule.successor if isinstance(part, Edge)))


@misconception("markers all lead away", in_markers)
def all_leading_away(_: EdgeProduction, marker: Marker) -> Marker:
    return replace(marker, edge=replace(marker.edge, arrow=">"))


@misconception("marker sides exchanged", in_markers)
def sides_exchanged(_: EdgeProduction, marker: Marker) -> Marker:
    return marker.turned
