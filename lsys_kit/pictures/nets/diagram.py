"""Stage diagrams as pictures, in the style of Petri nets (P. Prusinkiewicz, "Introduction to Modeling with
L-systems", figure 2).

Places are circles and hold tokens, transitions are bars. A row of stages reads from left to right; the arcs of a division
leave its bar and return above the row, each in its own lane, so that no line crosses a circle.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from lsys_kit.derivation.petri.net import Stages
from lsys_kit.errors import ModelValueError
from lsys_kit.pictures.nets.captions import short
from lsys_kit.pictures.nets.layout import EDGE, RADIUS, Point
from lsys_kit.pictures.nets.parts import (
    LABEL_SIZE,
    LINE,
    SMALL,
    ArcPart,
    BarPart,
    NotePart,
    Parts,
    PlacePart,
    parts_of,
    steering_of,
)
from lsys_kit.pictures.style.labels import escaped, letter_svg
from lsys_kit.pictures.style.palette import tinted
from lsys_kit.pictures.style.themes import Theme, line, theme

DOTS: Mapping[int, tuple[Point, ...]] = {
    0: (),
    1: ((0, 0),),
    2: ((-5, 0), (5, 0)),
    3: ((0, -5.5), (-5, 3.5), (5, 3.5)),
    4: ((-5, -5), (5, -5), (-5, 5), (5, 5)),
}


@dataclass(frozen=True)
class Diagram:
    """A stage diagram without its tokens.

    Attributes
    ----------
    parts
        Its parts.
    start
        The SVG up to the end of its description.
    lines
        The bars and arcs, as SVG.
    stages
        For each place that is shown its circle and label, as SVG.
    """

    parts: Parts
    start: str
    lines: str
    stages: tuple[str, ...]


def drawn_stages(
    net: Stages,
    tokens: Sequence[int] | None = None,
    *,
    marked: Collection[int | None] = (),
    positions: bool = False,
    steering: Collection[str] | None = None,
    labels: bool = True,
) -> str:
    """A stage diagram as SVG text.

    Parameters
    ----------
    net
        The stages of a system.
    tokens
        The number of tokens in each place; by default none are drawn.
    marked
        The numbers of the places that are highlighted.
    positions
        Whether arcs are labelled with the positions of their modules in the successor, rather than with their number.
    steering
        Symbols whose places are omitted if they are never rewritten; by default those that only steer the turtle.
    labels
        Whether stages have their names.

    Raises
    ------
    ModelValueError
        The tokens are not one number for each place.

    Examples
    --------
    >>> from lsys_kit import read, stages
    >>> drawn_stages(stages(read("axiom: a\\na -> ab\\nb -> a")), (2, 1)).count('class="token"')
    3
    """
    if tokens is not None and len(tokens) != len(net.places):
        raise ModelValueError(f"The diagram has {len(net.places)} places; {len(tokens)} numbers of tokens do not fit it")
    diagram = _diagram(net, positions, steering_of(net.system) if steering is None else frozenset(steering), theme(), labels)
    body, places = [], diagram.parts.places
    for part, stage in zip(places, diagram.stages, strict=True):
        x, y, chosen = part.x, part.y, part.place in marked
        body.append(
            f'<g class="stage" data-place="{part.place}">{_ring(x, y) if chosen else ""}{stage}'
            f"{_edge(x, y) if chosen else ''}{'' if tokens is None else _tokens(x, y, tokens[part.place])}</g>"
        )
    told = "" if tokens is None else "; tokens " + ", ".join(short(tokens[part.place]) for part in places)
    told += "".join(f"; {part.name} is marked" for part in places if part.place in marked)
    paper = "" if theme().transparent else f'<rect width="100%" height="100%" fill="{theme().ground}"/>'
    return f'{diagram.start}{escaped(told)}">{paper}{"".join(body)}{diagram.lines}</svg>'


@lru_cache(maxsize=64)
def _diagram(net: Stages, positions: bool, steering: frozenset[str], chosen: Theme, labels: bool) -> Diagram:
    """What of the diagram does not depend on the tokens, in the theme in force."""
    parts = parts_of(net, positions, steering, chosen.symbols)
    parts = parts if labels else parts.nameless
    lines = "".join(
        [
            *map(_arc_svg, parts.arcs),
            *map(_bar_svg, parts.bars),
            *map(_note_svg, parts.notes),
            *(_footnote_svg(parts.foot + LINE * line, text) for line, text in enumerate(parts.footnotes)),
        ]
    )
    start = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {parts.width} {parts.height}" width="{parts.width}" '
        f'height="{parts.height}" style="max-width:100%;height:auto" font-family="sans-serif" fill="{chosen.ink}" '
        f'role="img" aria-label="{escaped(parts.description)}'
    )
    return Diagram(parts, start, lines, tuple(map(_stage, parts.places)))


def _stage(part: PlacePart) -> str:
    """A circle with its label and its name in words."""
    x, y = part.x, part.y
    return (
        f'<title>{escaped(part.title)}</title><circle cx="{x:.1f}" cy="{y:.1f}" r="{RADIUS:.1f}" '
        f'fill="{tinted(part.colour, part.strength)}" stroke="{line(part.colour)}" stroke-width="1.8"/>'
        f'<text x="{x:.1f}" y="{y + RADIUS + 17:.1f}" font-size="{LABEL_SIZE}" text-anchor="middle">'
        f"{letter_svg(part.letter, part.subscript, part.values)}</text>"
    )


def _ring(x: float, y: float) -> str:
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{RADIUS + 5:.1f}" fill="{theme().mark}" stroke="{theme().mark_edge}"/>'


def _edge(x: float, y: float) -> str:
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{RADIUS:.1f}" fill="none" stroke="{theme().mark_edge}" stroke-width="3.6"/>'


def _tokens(x: float, y: float, count: int) -> str:
    """Up to four tokens as dots, more as a number."""
    if count < 5:
        return "".join(f'<circle class="token" cx="{x + dx:.1f}" cy="{y + dy:.1f}" r="3.6"/>' for dx, dy in DOTS[count])
    text = short(count)
    size = token_size(text)
    return (
        f'<text class="token" x="{x:.1f}" y="{y + 0.36 * size:.1f}" font-size="{size}" font-weight="bold" '
        f'text-anchor="middle">{text}</text>'
    )


def token_size(text: str) -> int:
    """The size in which a number of tokens fits into a circle.

    >>> token_size("12"), token_size("3.4M")
    (15, 11)
    """
    return 15 if len(text) < 3 else 13 if len(text) < 4 else 11


def _bar_svg(bar: BarPart) -> str:
    """A bar with the line to it and its terms."""
    text = (
        (
            f'<text class="terms" x="{bar.tx:.1f}" y="{bar.ty:.1f}" font-size="{SMALL}"><title>{escaped(bar.full)}</title>'
            f"{escaped(bar.terms)}</text>"
        )
        if bar.terms
        else ""
    )
    return (
        f'<g class="transition"><path class="feed" d="{bar.line}" {_stroke()}/><rect x="{bar.x - 1.8:.1f}" '
        f'y="{bar.y - bar.half:.1f}" width="3.6" height="{2 * bar.half:.1f}" rx="0.8"/>{text}</g>'
    )


def _stroke() -> str:
    return f'fill="none" stroke="{theme().ink}" stroke-width="1.3"'


def _arc_svg(arc: ArcPart) -> str:
    """An arc with its arrowhead, on a band of paper that interrupts the lines it crosses."""
    return (
        f'<path d="{arc.band}" fill="none" stroke="{theme().ground}" stroke-width="5"/><path class="arc" '
        f'data-arc="{arc.arc}" d="{arc.path}" {_stroke()}/><path d="{arc.head}"/>'
    )


def _note_svg(note: NotePart) -> str:
    x, y, width, paper = note.x, note.y, note.width, theme().ground
    return (
        f'<rect x="{x - width / 2:.1f}" y="{y - 6:.1f}" width="{width:.1f}" height="12" fill="{paper}"/><text class="note" '
        f'x="{x:.1f}" y="{y + 0.36 * SMALL:.1f}" font-size="{SMALL}" text-anchor="middle">{escaped(note.text)}</text>'
    )


def _footnote_svg(y: float, text: str) -> str:
    return f'<text class="footnote" x="{EDGE:.1f}" y="{y:.1f}" font-size="{SMALL}">{escaped(text)}</text>'
