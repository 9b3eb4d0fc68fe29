"""Repairs of stage diagrams: an arrow led elsewhere, left out or added, a stage left out or added, two names exchanged."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import combinations, permutations

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.nets import Firing, Net, places_of, with_places
from lsys_kit.classroom.exercises.repairs.repair import Repair
from lsys_kit.classroom.exercises.replies import reply

NEW = "\N{SECTION SIGN}"
"""A place that no answer has."""
MOST_PLACES = 7
"""Of larger nets no names are exchanged."""


def of_nets(exercise: Exercise, mine: Net, wanted: Net) -> Iterator[Repair]:
    """Repairs of a net: of one arrow, of one stage, of the names that the question fixes."""
    places = sorted({*places_of(mine)})
    if mine.start != wanted.start and wanted.start is not None:
        yield Repair(partial(replace, mine, start=wanted.start), partial(reply, "net.start"))
    for at, firing in enumerate(mine.firings):
        for made, kind in _other_targets(firing, [*places, NEW]):
            said = partial(reply, f"repair.net_{kind}", place=firing.place)
            yield Repair(partial(_with, mine, at, replace(firing, made=made)), said)
        yield Repair(partial(_with, mine, at), partial(reply, "repair.net_extra_transition", place=firing.place))
        if len(firing.made) == 1 and firing.made[0][1] == 1:
            target = firing.made[0][0]
            others = _with(mine, at)
            if target != firing.place:
                yield Repair(partial(with_places, others, {firing.place: target}), partial(reply, "repair.net_extra_stage"))
    emptied = {firing.place for firing in mine.firings}
    for place in places:
        if place not in emptied:
            for other in places:
                new = Firing(place, ((other, 1),))
                said = partial(reply, "repair.net_missing_transition", place=place)
                yield Repair(partial(replace, mine, firings=(*mine.firings, new)), said)
    yield from _stages_between(mine)
    yield from _other_names(exercise, mine, places)


def _with(net: Net, at: int, *firings: Firing) -> Net:
    return replace(net, firings=(*net.firings[:at], *firings, *net.firings[at + 1 :]))


def _other_targets(firing: Firing, places: Sequence[str]) -> Iterator[tuple[tuple[tuple[str, int], ...], str]]:
    """What a transition may make in place of what it makes: one token elsewhere, one more, one less."""
    made = Counter(dict(firing.made))
    for place in places:
        yield _sorted(made + Counter([place])), "missing_daughter" if place not in made else "more"
    for place in made:
        less = made - Counter([place])
        yield _sorted(less), "extra_daughter" if made[place] == 1 else "fewer"
        for other in places:
            if other != place:
                yield _sorted(less + Counter([other])), "elsewhere"


def _sorted(made: Counter[str]) -> tuple[tuple[str, int], ...]:
    return tuple(sorted(made.items()))


def _stages_between(net: Net) -> Iterator[Repair]:
    """One more stage on an arrow."""
    for at, firing in enumerate(net.firings):
        for place, copies in firing.made:
            made = Counter(dict(firing.made)) - Counter({place: copies}) + Counter({NEW: copies})
            longer = _with(net, at, replace(firing, made=_sorted(made)), Firing(NEW, ((place, 1),)))
            yield Repair(partial(replace, longer), partial(reply, "repair.net_missing_stage"))
        before = [replace(f, made=tuple((NEW if p == firing.place else p, n) for p, n in f.made)) for f in net.firings]
        yield Repair(
            partial(replace, net, firings=(*before, Firing(NEW, ((firing.place, 1),)))),
            partial(reply, "repair.net_missing_stage"),
        )


def _other_names(exercise: Exercise, net: Net, places: Sequence[str]) -> Iterator[Repair]:
    """The places that the question names called otherwise."""
    fixed = [name for name in exercise.symbols if name]
    if not fixed or len(places) > MOST_PLACES:
        return
    unnamed = [name for name in fixed if name not in places]
    said = partial(reply, "repair.net_unnamed", place=unnamed[0]) if unnamed else partial(reply, "repair.net_names")
    for chosen in permutations(places, len(fixed)):
        names = dict(zip(chosen, fixed, strict=True))
        free = [place for place in fixed if place in places and place not in chosen]
        names |= {place: f"{NEW}{place}" for place in free}
        if any(own != other for own, other in names.items()):
            yield Repair(partial(with_places, net, names), said)
    for one, other in combinations(places, 2):
        yield Repair(partial(with_places, net, {one: other, other: one}), partial(reply, "repair.net_names"))
