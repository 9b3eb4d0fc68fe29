"""Rules that replace strokes of two kinds (edge rewriting: ABOP, section 1.3): F_l and F_r become words of both.

The first drawing is one stroke, F_l. A turtle walks along the strokes of the next three drawings as the rules say, and whatever
these do not say yet, a turn or a kind of stroke, is tried in every way: a wrong guess soon leaves the drawing. Turns before the
successor of F_l change nothing, since they can be moved behind it in all places.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from lsys_kit.budget import check_budget
from lsys_kit.geometry.inference.strokes import Strokes, Turning
from lsys_kit.geometry.inference.traversals import turns_text

PICTURES = 4
"""The drawings of so many steps are walked along."""
KINDS = ("l", "r")
Unknown: TypeAlias = tuple[str, str, int]
"""A turn (`turn`), or a kind of stroke (`kind`), in the successor of a kind, with its place there."""
Rules: TypeAlias = Mapping[Unknown, int]
"""What is known of both rules: numbers of turns, and kinds of strokes as places in `KINDS`."""
AXIOM: Unknown = ("kind", "", 0)
FIRST_TURN: Unknown = ("turn", "l", 0)


@dataclass(frozen=True)
class _Item:
    """What a turtle has to do: a turn, or a stroke that is replaced in so many steps; and what it has to do then."""

    what: Unknown
    steps: int
    then: _Item | None


@dataclass(frozen=True)
class _Walk:
    """A turtle on its way.

    rules
        What is known, or was tried.
    item
        What it has to do next; None at the end.
    point, heading
        Where it is, and its direction in radians; None before the first stroke, with which any direction begins.
    turns
        How many turns it has made since the last stroke.
    drawn
        The numbers of the strokes that it has drawn, as the bits of a whole number.
    """

    rules: Rules
    item: _Item | None
    point: int
    heading: float | None = None
    turns: int = 0
    drawn: int = 0


def two_symbol_rules(drawings: Sequence[Strokes], turning: Turning, factor: int) -> Iterator[tuple[str, str]]:
    """Successors of F_l and of F_r, of so many strokes each, that draw the pictures of steps 1 to 3 from the axiom F_l.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> from lsys_kit.geometry.inference.strokes import read_drawings
    >>> dragon = derive(read("axiom: F_l\\nF_l -> F_l+F_r+\\nF_r -> -F_l-F_r"), 3)
    >>> pictures = read_drawings(scene_of(dragon[step]) for step in range(4))
    >>> ("F_l+F_r+", "-F_l-F_r") in [*two_symbol_rules(pictures, Turning(90), 2)]
    True
    """
    known: list[Rules] = [{AXIOM: 0, FIRST_TURN: 0}]
    for step, drawing in enumerate(drawings[1:PICTURES], 1):
        further = (rules for each in known for rules in _walked(each, drawing, turning, factor, step))
        known = [*{tuple(sorted(rules.items())): rules for rules in further if _of_both_kinds(rules, factor)}.values()]
    for rules in known:
        yield _word(rules, "l", factor), _word(rules, "r", factor)


def _of_both_kinds(rules: Rules, factor: int) -> bool:
    """Whether F_l does not become F_l alone, as far as is known."""
    return any(rules.get(("kind", "l", place), 1) for place in range(factor))


def _walked(rules: Rules, strokes: Strokes, turning: Turning, factor: int, steps: int) -> Iterator[Rules]:
    left = [_Walk(rules, _Item(AXIOM, steps, None), point) for point in strokes.leaving]
    while left:
        check_budget()
        walk = left.pop()
        if walk.item is not None:
            left += _further(walk, walk.item, strokes, turning, factor)
        elif walk.drawn.bit_count() == len(strokes):
            yield walk.rules


def _further(walk: _Walk, item: _Item, strokes: Strokes, turning: Turning, factor: int) -> Iterator[_Walk]:
    name, _, _ = item.what
    if name == "kind" and not item.steps:
        yield from _drawing(walk, item, strokes, turning)
    elif item.what not in walk.rules:
        choices = range(len(KINDS)) if name == "kind" else map(int, turning.several)
        for value in choices:
            yield _Walk({**walk.rules, item.what: value}, item, walk.point, walk.heading, walk.turns, walk.drawn)
    elif name == "turn":
        yield _Walk(walk.rules, item.then, walk.point, walk.heading, walk.turns + walk.rules[item.what], walk.drawn)
    else:
        replaced = _successor(KINDS[walk.rules[item.what]], factor, item)
        yield _Walk(walk.rules, replaced, walk.point, walk.heading, walk.turns, walk.drawn)


def _successor(kind: str, factor: int, item: _Item) -> _Item:
    """What stands for a stroke one step later, before what has to be done then."""
    found = _Item(("turn", kind, factor), 0, item.then)
    for place in reversed(range(factor)):
        found = _Item(("turn", kind, place), 0, _Item(("kind", kind, place), item.steps - 1, found))
    return found


def _drawing(walk: _Walk, item: _Item, strokes: Strokes, turning: Turning) -> Iterator[_Walk]:
    """The strokes that lie ahead and are not drawn yet; of several that lie on one another one."""
    ends = set[int]()
    for number, end, direction in strokes.leaving[walk.point]:
        if not walk.drawn >> number & 1 and end not in ends and _ahead(walk, direction, turning):
            ends.add(end)
            yield _Walk(walk.rules, item.then, end, direction, 0, walk.drawn | 1 << number)


def _ahead(walk: _Walk, direction: float, turning: Turning) -> bool:
    return walk.heading is None or turning.is_(direction - walk.heading, walk.turns)


def _word(rules: Rules, kind: str, factor: int) -> str:
    """The successor of a kind of strokes; a turn that no drawing shows is none."""
    parts = [
        f"{turns_text(rules.get(('turn', kind, place), 0))}F_{KINDS[rules[('kind', kind, place)]]}" for place in range(factor)
    ]
    return " ".join(parts).replace(" +", "+").replace(" -", "-") + turns_text(rules.get(("turn", kind, factor), 0))


def may_have_two_symbols(drawings: Sequence[Strokes], factor: int) -> bool:
    """Whether pictures are enough, and begin, as such rules ask."""
    return len(drawings) >= PICTURES and len(drawings[0]) == 1 and factor > 1
