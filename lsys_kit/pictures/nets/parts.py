"""The parts of a stage diagram before it is written in any format: labels, captions, colours and positions of places, bars and
arcs."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

from lsys_kit.derivation.petri.net import Place, Stages, Transition, likelihood
from lsys_kit.notation.model.arithmetic import is_symbolic, number_text
from lsys_kit.pictures.nets.layers import layered_layout
from lsys_kit.pictures.nets.layout import EDGE, ROUND, Layout, Point, Texts, crossed_notes, crossings
from lsys_kit.pictures.nets.rows import layout_in_rows, rows_of, shown_places
from lsys_kit.pictures.style.labels import label_parts, place_parts, place_text, steering_of
from lsys_kit.pictures.style.palette import LABELLED, PALEST, QUIET, colours

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
    ('at once, t ≥ 1', 'chance 0.5')
    """
    terms = (
        "at once" if transition.at_once else "",
        "" if transition.chance is None else f"chance {likelihood(transition.chance)}",
        "" if transition.span is None else f"after {number_text(transition.span)}",
        readable(transition.condition),
    )
    return ", ".join(filter(None, terms))


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
    captions = {}
    footnotes: list[str] = []
    for number, transition in enumerate(net.transitions):
        text = terms_of(transition)
        if len(text) > LONGEST_CAPTION and transition.place in places:
            footnotes.append(f"({len(footnotes) + 1}) {text}")
            captions[number] = f"({len(footnotes)})"
        elif text:
            captions[number] = text
    short_enough = (
        text if len(text) <= LONGEST_FOOTNOTE else text[: LONGEST_FOOTNOTE - 1].rstrip() + "…" for text in footnotes
    )
    return captions, tuple(short_enough)


LABEL_SIZE, SMALL = 14, 11
"""Font sizes, in pixels."""
LINE = 16.0
"""The height of a line below the diagram."""
SUBSCRIPT = 0.7
"""The size of a subscript, relative to its label."""
MOST_CROSSINGS, MOST_LAYERED = 1, 60
"""So many crossings are allowed in rows of places; nets with more arcs than so many stand in rows all the same."""
PAGE, LEGIBLE = 480, 7
"""The width of a column, in pixels, in which a wider diagram is made smaller; and the least size that its text has then."""
SHORTER_ROWS = (6, 5, 4, 3, 2, 1)
"""How many places rows may have at most where longer ones are too wide."""


class PlacePart(NamedTuple):
    """A place: its number and the centre of its circle; its label in parts and in words; its colour and how strong that is."""

    place: int
    x: float
    y: float
    letter: str
    subscript: str
    values: str
    name: str
    title: str
    colour: str
    strength: float


class BarPart(NamedTuple):
    """A bar: the number of its transition; its centre, half its height, the line to it as an SVG path; its terms, in short
    and in full, and the left end of their baseline."""

    transition: int
    x: float
    y: float
    half: float
    line: str
    terms: str
    full: str
    tx: float
    ty: float


class ArcPart(NamedTuple):
    """An arc: its number in the net; its line, the band that interrupts the lines it crosses, and its head, as SVG paths."""

    arc: int
    path: str
    band: str
    head: str


class NotePart(NamedTuple):
    """The note of an arc: its centre, its width and its text."""

    x: float
    y: float
    width: float
    text: str


class Parts(NamedTuple):
    """A stage diagram without its tokens, its places in reading order. Footnotes are the terms for which there is no room at
    their bars, and what else the system does, a line each; the foot is the baseline of the first."""

    width: int
    height: int
    description: str
    places: tuple[PlacePart, ...]
    bars: tuple[BarPart, ...]
    arcs: tuple[ArcPart, ...]
    notes: tuple[NotePart, ...]
    footnotes: tuple[str, ...]
    foot: float

    @property
    def nameless(self) -> Parts:
        """The same without the names of stages."""
        return self._replace(places=tuple(place._replace(letter="", subscript="", values="") for place in self.places))


@lru_cache(maxsize=64)
def parts_of(net: Stages, positions: bool, steering: frozenset[str], chosen: tuple[tuple[str, str], ...] = ()) -> Parts:
    """The parts of the diagram of a net; `positions` and `steering` as for `drawn_stages`, and chosen colours of symbols."""
    rows = rows_of(net, shown_places(net, steering))
    order = tuple(place for row in rows for place in row)
    names = {place: place_text(net.places[place], net.system) for place in order}
    notes = notes_of(net, positions)
    terms, numbered = captions_of(net, order)
    texts = Texts(
        {place: width_of(name, LABEL_SIZE) for place, name in names.items()},
        {number: width_of(text, SMALL) for number, text in terms.items()},
        {arc: width_of(text, SMALL) for arc, text in notes.items()},
    )
    layout = clearest_layout(net, rows, texts, widest_legible(net, order))
    besides = tuple(f"besides: {readable(text)}" for text in net.besides)
    footnotes = (*numbered, *besides)
    fills = _fills(net, order, dict(chosen))
    return Parts(
        math.ceil(max([layout.width, *(width_of(text, SMALL) + 2 * EDGE for text in footnotes)])),
        math.ceil(layout.height + LINE * len(footnotes)),
        "; ".join(
            (f"Stage diagram: {len(names)} stage{'s' * (len(names) != 1)} {', '.join(names.values())}".rstrip(), *besides)
        ),
        tuple(_place(net, place, names[place], layout, *fills[place]) for place in order),
        tuple(
            BarPart(number, x, y, half, rounded_path(line), terms.get(number, ""), terms_of(net.transitions[number]), *place)
            for number, (x, y, half, line, place) in layout.bars.items()
        ),
        tuple(_arc(arc, corners) for arc, corners in layout.arcs.items()),
        tuple(NotePart(*layout.notes[arc], width_of(text, SMALL), text) for arc, text in notes.items() if arc in layout.notes),
        footnotes,
        layout.height,
    )


def positions_in(net: Stages) -> dict[str, Point]:
    """Where places and transitions stand in the picture of a net, by their names in PNML."""
    parts = parts_of(net, False, steering_of(net.system))
    places = {f"p{part.place}": (part.x, part.y) for part in parts.places}
    return places | {f"t{part.transition}": (part.x, part.y) for part in parts.bars}


def widest_legible(net: Stages, places: Iterable[int]) -> float:
    """How wide a diagram may be, in pixels, for its smallest text to be legible in a column."""
    has_subscripts = any(place_parts(net.places[place], net.system)[1] for place in places)
    return PAGE * (SUBSCRIPT * LABEL_SIZE if has_subscripts else SMALL) / LEGIBLE


def clearest_layout(net: Stages, rows: Sequence[tuple[int, ...]], texts: Texts, widest: float = math.inf) -> Layout:
    """Rows of places as in print, unless their arcs are few enough, cross more than once, and less often in layers.

    Layers that are too wide are moved together; what still is too wide, in rows or in layers, stands in shorter rows.
    """
    in_rows, places = layout_in_rows(net, rows, texts), [place for row in rows for place in row]
    clearest = in_rows
    if len(in_rows.arcs) <= MOST_LAYERED and crossings(in_rows) > MOST_CROSSINGS:
        clearest = min(in_rows, layered_layout(net, places, texts, widest), key=crossings)
    return clearest if clearest.width <= widest else _in_shorter_rows(net, in_rows, places, texts, widest)


def _in_shorter_rows(net: Stages, in_rows: Layout, places: Sequence[int], texts: Texts, widest: float) -> Layout:
    """Of the layouts in rows that are no wider than allowed the one with the fewest notes that lines run through, and then the
    fewest crossings; else the narrowest."""
    wrapped = [in_rows, *(layout_in_rows(net, rows_of(net, places, longest), texts) for longest in SHORTER_ROWS)]
    fitting = [layout for layout in wrapped if layout.width <= widest]
    if not fitting:
        return min(wrapped, key=lambda layout: layout.width)
    if len(in_rows.arcs) > MOST_LAYERED:
        return fitting[0]
    return min(fitting, key=lambda layout: (crossed_notes(layout, texts.notes), crossings(layout)))


def _place(net: Stages, number: int, name: str, layout: Layout, colour: str, strength: float) -> PlacePart:
    place = net.places[number]
    letter, subscript, values = place_parts(place, net.system)
    label = (letter, subscript) if subscript else label_parts(letter, net.system)
    title = name + (", of either polarity" if len(place.modules) > 1 else "")
    return PlacePart(number, *layout.circles[number], *label, values, name, title, colour, strength)


def _fills(net: Stages, order: Sequence[int], chosen: Mapping[str, str]) -> dict[int, tuple[str, float]]:
    """The colour of each circle and how strong its fill is; fills of one symbol darken with its values."""
    palette = {**colours(net.system), **chosen}
    groups: dict[str, list[int]] = {}
    for place in sorted(order, key=lambda place: _rank(net.places[place])):
        groups.setdefault(palette.get(net.places[place].symbol, QUIET), []).append(place)
    return {
        place: (colour, PALEST + (LABELLED - PALEST) * number / (max(len(group), 2) - 1))
        for colour, group in groups.items()
        for number, place in enumerate(group)
    }


def _rank(place: Place) -> tuple[float, ...]:
    """By what a place comes before others of its symbol: its values; unknown ones say nothing."""
    return tuple(0.0 if is_symbolic(value) else float(value) for value in place.modules[0].arguments) if place.modules else ()


def _arc(number: int, corners: Sequence[Point]) -> ArcPart:
    return ArcPart(
        number,
        rounded_path(corners),
        rounded_path([*corners[:-1], _point_towards(corners[-1], corners[-2], 10)]),
        arrowhead(corners[-1], corners[-2]),
    )


def arrowhead(tip: Point, start: Point) -> str:
    """The head of an arrow as an SVG path.

    >>> arrowhead((20, 0), (0, 0))
    'M20.0 0.0L11.5 -3.4L11.5 3.4Z'
    """
    (x, y), (nx, ny) = tip, _point_towards(tip, start, 1.0)
    back, aside = (8.5 * (nx - x), 8.5 * (ny - y)), (3.4 * (ny - y), 3.4 * (x - nx))
    ends = sorted((x + back[0] + side * aside[0], y + back[1] + side * aside[1]) for side in (1, -1))
    return f"M{x:.1f} {y:.1f}{''.join(f'L{a:.1f} {b:.1f}' for a, b in ends)}Z"


def rounded_path(corners: Sequence[Point]) -> str:
    """A line through corners as an SVG path, the corners rounded.

    >>> rounded_path([(0, 0), (20, 0), (20, 20)])
    'M0.0 0.0L10.0 0.0Q20.0 0.0 20.0 10.0L20.0 20.0'
    """
    path = ["M{:.1f} {:.1f}".format(*corners[0])]
    for before, corner, after in zip(corners, corners[1:], corners[2:], strict=False):
        reach = min(ROUND, math.dist(before, corner) / 2, math.dist(corner, after) / 2)
        start, end = _point_towards(corner, before, reach), _point_towards(corner, after, reach)
        path.append("L{:.1f} {:.1f}Q{:.1f} {:.1f} {:.1f} {:.1f}".format(*start, *corner, *end))
    return "".join(path) + "L{:.1f} {:.1f}".format(*corners[-1])


def _point_towards(start: Point, end: Point, reach: float) -> Point:
    """The point at some distance from the start towards the end."""
    share = reach / (math.dist(start, end) or 1.0)
    return start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])
