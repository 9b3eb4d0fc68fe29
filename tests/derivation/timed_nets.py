"""Timed Petri nets, fired as the definition says."""

from __future__ import annotations

from fractions import Fraction

from lsys_kit.derivation.petri.stages import Stages


def fired_in_time(net: Stages, until: Fraction | int) -> tuple[int, ...]:
    """The tokens of a timed net at a time: each moves as soon as it has rested in its place for the time of its transition."""
    spans = {transition.place: (number, transition.span) for number, transition in enumerate(net.transitions)}
    todo = [(place, until) for place, count in enumerate(net.start) for _ in range(count)]
    found = [0] * len(net.places)
    while todo:
        place, left = todo.pop()
        number, span = spans.get(place, (None, None))
        if span is None or left < span:
            found[place] += 1
        else:
            todo += [(arc.place, left - span) for arc in net.arcs if arc.transition == number for _ in range(arc.copies)]
    return tuple(found)
