"""Between two steps: the words that a turtle interprets while every module becomes its successor in place.

A part of the way from 0 to 1 is a word of the modules of the later step, whose commands are on their way. At 0 those of a
family do together what those of the mother did, at 1 they are what they are: a stroke of the mother is shared out among those
on the trunk of its successor, in the proportion of their lengths; a command that both have goes from one number to the other;
what the successor has besides grows from nothing, and what it lacks shrinks to nothing. So the drawing at 0 and at 1 is that of
the steps. The panel does the same (`drawing/unfolded.js`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

from lsys_kit.arrays import np
from lsys_kit.budget import counted
from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.derive import Derivation
from lsys_kit.geometry.turtle.commands import Instruction, initial_step, instructions

AHEAD = frozenset(("draw", "move", "draw without vertex", "move without vertex"))
GROWING = AHEAD | {
    *("turn", "turn back", "turn by mirrored angle", "turn second heading", "pitch", "roll", "gravitropism"),
    *("draw surface", "draw expected surface", "draw circle", "draw disc", "draw sphere", "draw box"),
    *("draw by second heading", "move by second heading"),
}
"""The actions that do nothing where their amount is 0."""
QUANTITIES = frozenset(
    f"set {name}" for name in ("length", "width", "scale", "gravitropism", "length once", "width once", "gravitropism once")
)
"""The actions that change nothing where they multiply by 1."""
BRACKETS = frozenset(("push", "pop", "begin polygon", "record vertex", "end polygon", "expect surface"))
"""The actions that are done wholly, from the beginning or up to the end: what stands between them grows or shrinks."""

Way: TypeAlias = Callable[[float], Instruction | None]
"""A command on its way, given the part of the way."""
Placed: TypeAlias = tuple[Instruction, int]
"""A command, and how deep in brackets it stands."""


@dataclass(frozen=True)
class WordBetween:
    """A word on a part of the way from a step to the next.

    states
        The table of the derivation.
    sequence
        Its modules, as numbers.
    looks, calls
        For each number the state of which it looks, and its commands.
    mothers, later
        For each module where its mother stands in the earlier word, and where it stands itself in the later one; -1 where it
        is the last of its kind.
    """

    states: States
    sequence: Sequence[int]
    looks: Sequence[int]
    calls: Sequence[Sequence[Instruction]]
    mothers: Sequence[int] = ()
    later: Sequence[int] = ()

    def numbers(self) -> Sequence[int]:
        return self.sequence

    def by_place(self) -> WordBetween:
        """The same word, of which each module looks of its own: what it draws has its place for a state."""
        places = range(len(self.sequence))
        return WordBetween(self.states, places, places, [self.calls[number] for number in self.sequence])


def word_at_rest(derivation: Derivation, step: int) -> WordBetween:
    """The word of a step, whose commands are not on their way.

    >>> from lsys_kit import derive, read
    >>> word_at_rest(derive(read("axiom: F+F"), 0), 0).looks
    [0, 1, 0]
    """
    system, sequence = derivation.states.system, list(derivation[step].numbers())
    calls = instructions(interpretations(derivation.states, sequence), system.turtle, system.angle)
    return WordBetween(derivation.states, range(len(sequence)), sequence, [calls[state] for state in sequence])


def words_between(derivation: Derivation, step: int) -> Callable[[float], WordBetween]:
    """The words between a step of a derivation and the next, as a function of the part of the way.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.turtle.plane import place_path, trace
    >>> between = words_between(derive(read("angle: 60\\naxiom: F\\nF -> F+F--F+F"), 1), 0)
    >>> [place_path(trace(between(part)), 60, 0).measures for part in (0.0, 0.5, 1.0)]
    ['width 1, height 0', 'width 2.33, height 0.31', 'width 3, height 0.87']
    """
    states, system = derivation.states, derivation.states.system
    before, after = (derivation[each].numbers() for each in (step, step + 1))
    calls = instructions(interpretations(states, [*before, *after]), system.turtle, system.angle)
    known: dict[tuple[tuple[int, ...], tuple[int, ...]], range] = {}
    sequence: list[int] = []
    looks: list[int] = []
    ways: list[list[Way]] = []
    origins: list[int] = []
    places: list[int] = []
    at = start = 0
    for mothers, daughters in counted(_families(before, after, derivation, step)):
        if (mothers, daughters) not in known:
            ways += _ways([calls[state] for state in mothers], [calls[state] for state in daughters], initial_step(system))
            known[mothers, daughters] = range(len(looks), len(ways))
            looks += daughters or mothers[:1]
        sequence += known[mothers, daughters]
        origins += [at] * len(known[mothers, daughters])
        places += range(start, start + len(daughters)) if daughters else (-1,)
        at, start = at + len(mothers), start + len(daughters)

    def between(part: float) -> WordBetween:
        rows = [[each for way in row if (each := way(part)) is not None] for row in counted(ways)]
        return WordBetween(states, sequence, looks, rows, origins, places)

    return between


def _families(
    before: Sequence[int], after: Sequence[int], derivation: Derivation, step: int
) -> Iterator[tuple[tuple[int, ...], tuple[int, ...]]]:
    """The modules that were replaced together, mostly one alone, and what they became."""
    origins = derivation.origins(step + 1)
    many = np.bincount(np.asarray(origins.parents, np.int64), minlength=len(before)).tolist()
    at = start = 0
    while at < len(before):
        size, end = max(1, origins.sizes[at] if origins.sizes else 1), start + many[at]
        yield tuple(before[at : at + size]), tuple(after[start:end])
        at, start = at + size, end


def _ways(
    mothers: Sequence[Sequence[Instruction]], daughters: Sequence[Sequence[Instruction]], length: float
) -> list[list[Way]]:
    """For each daughter, or for one where there is none, its commands on their way."""
    earlier, later = (_with_depths([call for calls in family for call in calls]) for family in (mothers, daughters))
    owners = [number for number, calls in enumerate(daughters) for _ in calls]
    found: list[list[Way]] = [[] for _ in range(max(1, len(daughters)))]
    shared, starts = _shares(earlier, later, length)
    at = 0

    def add(place: int, way: Way) -> None:
        found[owners[place] if place < len(owners) else -1].append(way)

    def arrive(end: int) -> None:
        for place in range(at, end):
            call = later[place][0]
            add(place, partial(_on_way, starts[place], call) if place in starts else partial(_grown, call))

    for number, (call, depth) in enumerate(earlier):
        if number == shared:
            continue
        same = (place for place in range(at, len(later)) if place not in starts and _alike((call, depth), later[place]))
        place = next(same, None)
        if place is None:
            add(at, partial(_shrunk, call))
        else:
            arrive(place)
            add(place, partial(_on_way, call, later[place][0]))
            at = place + 1
    arrive(len(later))
    return found


def _alike(one: Placed, other: Placed) -> bool:
    (call, depth), (call2, depth2) = one, other
    surfaces = call.symbol == call2.symbol if call.action == "draw expected surface" else call.surface == call2.surface
    return call.action == call2.action and depth == depth2 and surfaces


def _with_depths(calls: Sequence[Instruction]) -> list[Placed]:
    depth, found = 0, []
    for call in calls:
        depth -= call.action == "pop"
        found.append((call, depth))
        depth += call.action == "push"
    return found


def _shares(earlier: Sequence[Placed], later: Sequence[Placed], length: float) -> tuple[int | None, Mapping[int, Instruction]]:
    """The place of the only stroke of the mothers, and what of it falls to each of those on the trunk of its successor, by the
    places of these among its commands."""
    strokes = [number for number, (call, _) in enumerate(earlier) if call.action in AHEAD]
    if len(strokes) != 1:
        return None, {}
    stroke, _ = earlier[strokes[0]]
    heirs = {number: call for number, (call, depth) in enumerate(later) if call.action == stroke.action and not depth}
    sizes = {number: abs(call.factor * length + call.addend) for number, call in heirs.items()}
    whole = sum(sizes.values())
    shares = {number: size / whole if whole else 1 / len(sizes) for number, size in sizes.items()}
    starts = {
        number: stroke._replace(factor=share * stroke.factor, addend=share * stroke.addend) for number, share in shares.items()
    }
    return (strokes[0] if heirs else None), starts


def _is_number(call: Instruction) -> bool:
    return call.action in GROWING or call.action in QUANTITIES


def _on_way(one: Instruction, other: Instruction, part: float) -> Instruction:
    """From the numbers of one command to those of another of its action; what has no size changes in the middle."""
    if not _is_number(one):
        return one if part < 0.5 else other
    pairs = [*zip(one.values, other.values, strict=True)] if len(one.values) == len(other.values) else []
    return other._replace(
        factor=_between(one.factor, other.factor, part),
        addend=_between(one.addend, other.addend, part),
        values=tuple(_between(*pair, part) for pair in pairs) or other.values,
    )


def _between(one: float, other: float, part: float) -> float:
    if math.isinf(one) or math.isinf(other):
        return one if part < 0.5 else other
    return one + part * (other - one)


def _grown(call: Instruction, part: float) -> Instruction | None:
    """A command of which so much is there."""
    if call.action in BRACKETS:
        return call
    if not _is_number(call):
        return call if part >= 0.5 else None
    if call.action in QUANTITIES:
        return _on_way(call._replace(factor=1.0, addend=0.0), call, part) if part else None
    return _on_way(call._replace(factor=0.0, addend=0.0), call, part)


def _shrunk(call: Instruction, part: float) -> Instruction | None:
    """A command that goes: so much of the way is done."""
    if call.action in BRACKETS:
        return call if part < 1 else None
    if not _is_number(call):
        return call if part < 0.5 else None
    return _grown(call, 1 - part)
