"""Captions: the short texts of a stage diagram, at bars, at arcs and in places."""

from __future__ import annotations

import math
from collections.abc import Collection

from lsys_kit.derivation.petri.net import Stages, Transition, likelihood
from lsys_kit.notation.model.arithmetic import number_text

LONGEST_CAPTION, LONGEST_FOOTNOTE = 24, 120
"""Longer terms are footnotes; longer footnotes are abbreviated. A caption's title shows the full text."""
_UNITS = ((10**12, "T"), (10**9, "G"), (10**6, "M"), (10**3, "k"))


def short(count: int) -> str:
    """A number of tokens in at most five characters, rounded down.

    >>> [short(n) for n in (7, 999, 1000, 1250, 31_999, 3_400_000, 10 ** 40)]
    ['7', '999', '1k', '1.2k', '31k', '3.4M', '10^40']
    """
    if count >= 10**15:
        return f"10^{int(math.log10(count))}"
    for size, unit in _UNITS:
        if count >= 10 * size:
            return f"{count // size}{unit}"
        if count >= size:
            return f"{count // size}.{count * 10 // size % 10}{unit}".replace(".0", "")
    return str(count)


def terms_of(transition: Transition) -> str:
    """The text beside a bar: its probability, its duration and its condition.

    >>> terms_of(Transition(0, 0, "t >= 1", at_once=True)), terms_of(Transition(0, 1, chance=0.5))
    ('at once, t ≥ 1', 'p = 0.5')
    """
    return ", ".join(
        filter(
            None,
            (
                "at once" if transition.at_once else "",
                "" if transition.chance is None else f"p = {likelihood(transition.chance)}",
                "" if transition.span is None else f"after {number_text(transition.span)}",
                readable(transition.condition),
            ),
        )
    )


def notes_of(net: Stages, positions: bool) -> dict[int, str]:
    """The text at each arc: the number of copies, unless it is 1, or the positions in a successor of several modules."""
    made = [0] * len(net.transitions)
    for arc in net.arcs:
        made[arc.transition] += arc.copies
    found = {}
    for number, arc in enumerate(net.arcs):
        if positions and arc.positions and made[arc.transition] > 1:
            found[number] = ", ".join(map(str, arc.positions)) if arc.copies > 1 else _ordinal(arc.positions[0])
        elif arc.copies > 1 or arc.factor:
            found[number] = " ".join(filter(None, (str(arc.copies) if arc.copies > 1 else "", arc.factor)))
    return found


def _ordinal(number: int) -> str:
    return f"{number}{'th' if number % 100 in (11, 12, 13) else {1: 'st', 2: 'nd', 3: 'rd'}.get(number % 10, 'th')}"


def readable(condition: str) -> str:
    """A condition as it is typeset beside a bar.

    >>> readable("t >= 1 && p != -1")
    't ≥ 1 and p ≠ -1'
    """
    for code, text in ((">=", "≥"), ("<=", "≤"), ("!=", "≠"), ("==", "="), ("&&", "and"), ("||", "or")):
        condition = condition.replace(code, text)
    return condition


def width_of(text: str, size: float) -> float:
    """An upper estimate of the width of a text, independent of installed fonts."""
    return size * math.fsum(
        0.34 if letter in "iljtf.,:;()[]|'! " else 1.0 if letter in "mwMW" else 0.8 if letter.isupper() else 0.64
        for letter in text
    )


def captions_of(net: Stages, places: Collection[int]) -> tuple[dict[int, str], tuple[str, ...]]:
    """The text at each bar of some places that has any, and the numbered footnotes in which long ones stand.

    >>> from lsys_kit import read, stages
    >>> captions_of(stages(read("axiom: a(0)\\na(t) : t != 50 && t != 60 || t > 100 -> a(t+1)")), {0})
    ({0: '(1)'}, ('(1) t ≠ 50 and t ≠ 60 or t > 100',))
    """
    captions: dict[int, str] = {}
    footnotes: list[str] = []
    for number, transition in enumerate(net.transitions):
        text = terms_of(transition)
        if len(text) > LONGEST_CAPTION and transition.place in places:
            footnotes.append(f"({len(footnotes) + 1}) {text}")
            captions[number] = f"({len(footnotes)})"
        elif text:
            captions[number] = text
    return captions, tuple(map(_abbreviated, footnotes))


def _abbreviated(text: str) -> str:
    return text if len(text) <= LONGEST_FOOTNOTE else text[: LONGEST_FOOTNOTE - 1].rstrip() + "…"
