"""Stage diagrams as pictures, in the style of Petri nets (P. Prusinkiewicz, "Introduction to Modeling with
L-systems", figure 2).

Places are circles and hold tokens, transitions are bars. A row of stages reads from left to right; the arcs of a division
leave its bar and return above the row, each in its own lane, so that no line crosses a circle.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from string import punctuation

from lsys_kit.derivation.petri.net import Place, Stages
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.turtle.actions import Effect
from lsys_kit.geometry.turtle.commands import COMMANDS, symbols_with
from lsys_kit.notation.model.arithmetic import is_symbolic
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.nets.captions import abbreviated, notes_of, readable, short, terms_of, width_of
from lsys_kit.pictures.nets.layout import EDGE, RADIUS, ROUND, Layout, Point, Texts, layout_of
from lsys_kit.pictures.nets.routes import planned, rows_of, shown_places
from lsys_kit.pictures.style.labels import escaped, place_parts, place_text, svg_label
from lsys_kit.pictures.style.palette import INK, MARK, MARK_EDGE, PAPER, QUIET, colours, tinted

LABEL_SIZE, SMALL = 14, 11
"""Font sizes, in pixels."""
LINE = 16.0
"""The height of a line below the diagram."""

_DOTS: Mapping[int, tuple[Point, ...]] = {
    0: (), 1: ((0, 0),), 2: ((-5, 0), (5, 0)), 3: ((0, -5.5), (-5, 3.5), (5, 3.5)), 4: ((-5, -5), (5, -5), (-5, 5), (5, 5))}


@dataclass(frozen=True)
class Diagram:
    """A stage diagram without its tokens.

    Attributes
    ----------
    order
        The places in reading order.
    names
        Their labels, in words.
    layout
        The positions of circles, bars and arcs.
    start
        The SVG up to the end of its description.
    lines
        The bars and arcs, as SVG.
    stages
        For each place in `order` its circle and label, as SVG.
    """

    order: tuple[int, ...]
    names: tuple[str, ...]
    layout: Layout
    start: str
    lines: str
    stages: tuple[str, ...]


def drawn_stages(net: Stages, tokens: Sequence[int] | None = None, *, marked: int | None = None, positions: bool = False,
                 steering: Collection[str] | None = None) -> str:
    """A stage diagram as SVG text.

    Parameters
    ----------
    net
        The stages of a system.
    tokens
        The number of tokens in each place; by default none are drawn.
    marked
        The number of the place that is highlighted.
    positions
        Whether arcs are labelled with the positions of their modules in the successor, rather than with their number.
    steering
        Symbols whose places are omitted if they are never rewritten; by default those that only steer the turtle.

    Raises
    ------
    ModelValueError
        The tokens are not one number for each place.

    Examples
    --------
    >>> from lsys_kit.derivation.petri.stages import stages
    >>> from lsys_kit.notation.read import read
    >>> drawn_stages(stages(read("axiom: a\\na -> ab\\nb -> a")), (2, 1)).count('class="token"')
    3
    """
    if tokens is not None and len(tokens) != len(net.places):
        raise ModelValueError(f"The diagram has {len(net.places)} places; {len(tokens)} numbers of tokens do not fit it")
    diagram = _diagram(net, positions, steering_of(net.system) if steering is None else frozenset(steering))
    body = []
    for place, stage in zip(diagram.order, diagram.stages, strict=True):
        x, y = diagram.layout.circles[place]
        body.append(f'<g class="stage" data-place="{place}">{_ring(x, y) if place == marked else ""}{stage}'
                    f'{_edge(x, y) if place == marked else ""}{"" if tokens is None else _tokens(x, y, tokens[place])}</g>')
    told = "" if tokens is None else "; tokens " + ", ".join(short(tokens[place]) for place in diagram.order)
    told += f"; {diagram.names[diagram.order.index(marked)]} is marked" if marked in diagram.order else ""
    paper = f'<rect width="100%" height="100%" fill="{PAPER}"/>'
    return f'{diagram.start}{escaped(told)}">{paper}{"".join(body)}{diagram.lines}</svg>'


def steering_of(system: LSystem) -> frozenset[str]:
    """The symbols that only steer the turtle, and so are no stages.

    >>> from lsys_kit.notation.read import read
    >>> sorted(steering_of(read("axiom: F [+ &(60) f] A")) & set("F[+&]fA"))
    ['&', '+', '[', ']']
    """
    interpreted = {rule.predecessor.symbol for rule in system.interpretation}
    invisible = COMMANDS[system.turtle].keys() - symbols_with(Effect.VISIBLE, system.turtle)
    return frozenset(punctuation) | (invisible - interpreted)


@lru_cache(maxsize=64)
def _diagram(net: Stages, positions: bool, steering: frozenset[str]) -> Diagram:
    """The parts of the diagram that do not depend on the tokens."""
    rows = rows_of(net, shown_places(net, steering))
    plan = planned(net, rows)
    order = tuple(place for row in rows for place in row)
    names = tuple(place_text(net.places[place], net.system) for place in order)
    notes = notes_of(net, positions)
    besides = tuple(f"besides: {readable(text)}" for text in net.besides)
    terms = {number: abbreviated(text) for number, transition in enumerate(net.transitions) if (text := terms_of(transition))}
    layout = layout_of(net, plan, Texts({place: width_of(name, LABEL_SIZE) for place, name in zip(order, names, strict=True)},
                                       {number: width_of(text, SMALL) for number, text in terms.items()},
                                       {arc: width_of(text, SMALL) for arc, text in notes.items()}))
    fills = _fills(net, order)
    stages = tuple(_stage(net, place, layout.circles[place], fills[place]) for place in order)
    lines = "".join([*(_arc_svg(arc, corners) for arc, corners in layout.arcs.items()),
                     *(_bar_svg(net, layout, number, terms.get(number, "")) for number in layout.bars),
                     *(_note_svg(layout.notes[arc], text) for arc, text in notes.items() if arc in layout.notes),
                     *(_besides_svg(layout, line, text) for line, text in enumerate(besides))])
    return Diagram(order, names, layout, _svg_head(layout, names, besides), lines, stages)


def _svg_head(layout: Layout, names: Sequence[str], besides: Sequence[str]) -> str:
    width = math.ceil(max([layout.width, *(width_of(text, SMALL) + 2 * EDGE for text in besides)]))
    height = math.ceil(layout.height + LINE * len(besides))
    told = f"Stage diagram: {len(names)} stage{'' if len(names) == 1 else 's'} {', '.join(names)}".rstrip()
    told = "; ".join((told, *besides))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            f'style="max-width:100%;height:auto" font-family="sans-serif" fill="{INK}" role="img" '
            f'aria-label="{escaped(told)}')


def _fills(net: Stages, order: Sequence[int]) -> dict[int, tuple[str, str]]:
    """The fill and stroke of each circle; fills of one symbol darken with its values."""
    palette = colours(net.system)
    groups: dict[str, list[int]] = {}
    for place in sorted(order, key=lambda place: _rank(net.places[place])):
        groups.setdefault(palette.get(net.places[place].symbol, QUIET), []).append(place)
    return {place: (tinted(colour, 0.14 + 0.3 * number / (len(group) - 1) if len(group) > 1 else 0.2), colour)
            for colour, group in groups.items() for number, place in enumerate(group)}


def _rank(place: Place) -> tuple[float, ...]:
    """By what a place comes before others of its symbol: its values; unknown ones say nothing."""
    return tuple(0.0 if is_symbolic(value) else float(value) for value in place.modules[0].arguments) if place.modules else ()


def _stage(net: Stages, number: int, centre: Point, colours_: tuple[str, str]) -> str:
    """A circle with its label and its name in words."""
    (x, y), (fill, edge), place = centre, colours_, net.places[number]
    letter, subscript, values = place_parts(place, net.system)
    label = svg_label(place.symbol if subscript else letter, net.system, values)
    said = place_text(place, net.system) + (", of either polarity" if len(place.modules) > 1 else "")
    return (f'<title>{escaped(said)}</title><circle cx="{x:.1f}" cy="{y:.1f}" r="{RADIUS:.1f}" fill="{fill}" stroke="{edge}" '
            f'stroke-width="1.8"/><text x="{x:.1f}" y="{y + RADIUS + 17:.1f}" font-size="{LABEL_SIZE}" '
            f'text-anchor="middle">{label}</text>')


def _ring(x: float, y: float) -> str:
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{RADIUS + 5:.1f}" fill="{MARK}" stroke="{MARK_EDGE}"/>'


def _edge(x: float, y: float) -> str:
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{RADIUS:.1f}" fill="none" stroke="{MARK_EDGE}" stroke-width="3.6"/>'


def _tokens(x: float, y: float, count: int) -> str:
    """Up to four tokens as dots, more as a number."""
    if count < 5:
        return "".join(f'<circle class="token" cx="{x + dx:.1f}" cy="{y + dy:.1f}" r="3.6"/>' for dx, dy in _DOTS[count])
    text = short(count)
    size = 15 if len(text) < 3 else 13 if len(text) < 4 else 11
    return (f'<text class="token" x="{x:.1f}" y="{y + 0.36 * size:.1f}" font-size="{size}" font-weight="bold" '
            f'text-anchor="middle">{text}</text>')


def _bar_svg(net: Stages, layout: Layout, number: int, terms: str) -> str:
    """A bar with the line to it and its terms."""
    bar = layout.bars[number]
    text = ""
    if terms:
        x, y = bar.terms
        text = (f'<text class="terms" x="{x:.1f}" y="{y:.1f}" font-size="{SMALL}">'
                f'<title>{escaped(terms_of(net.transitions[number]))}</title>{escaped(terms)}</text>')
    return (f'<g class="transition"><path class="feed" d="{rounded_path(bar.line)}" {_STROKE}/><rect x="{bar.x - 1.8:.1f}" '
            f'y="{bar.y - bar.half:.1f}" width="3.6" height="{2 * bar.half:.1f}" rx="0.8"/>{text}</g>')


_STROKE = f'fill="none" stroke="{INK}" stroke-width="1.3"'


def _arc_svg(number: int, corners: Sequence[Point]) -> str:
    """An arc with its arrowhead, on a white band that interrupts the lines it crosses."""
    path, band = rounded_path(corners), rounded_path([*corners[:-1], _point_towards(corners[-1], corners[-2], 10)])
    (x, y), down = corners[-1], corners[-1][0] == corners[-2][0]
    (a, b), (c, d) = ((-3.4, -8.5), (3.4, -8.5)) if down else ((-8.5, -3.4), (-8.5, 3.4))
    return (f'<path d="{band}" fill="none" stroke="{PAPER}" stroke-width="5"/><path class="arc" data-arc="{number}" d="{path}" '
            f'{_STROKE}/><path d="M{x:.1f} {y:.1f}L{x + a:.1f} {y + b:.1f}L{x + c:.1f} {y + d:.1f}Z"/>')


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


def _note_svg(centre: Point, text: str) -> str:
    (x, y), width = centre, width_of(text, SMALL)
    return (f'<rect x="{x - width / 2:.1f}" y="{y - 6:.1f}" width="{width:.1f}" height="12" fill="{PAPER}"/><text class="note" '
            f'x="{x:.1f}" y="{y + 0.36 * SMALL:.1f}" font-size="{SMALL}" text-anchor="middle">{escaped(text)}</text>')


def _besides_svg(layout: Layout, line: int, text: str) -> str:
    return (f'<text class="besides" x="{EDGE:.1f}" y="{layout.height + LINE * line:.1f}" font-size="{SMALL}">'
            f'{escaped(text)}</text>')
