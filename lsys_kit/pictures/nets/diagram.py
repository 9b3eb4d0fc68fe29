"""Stage diagrams as pictures, in the style of Petri nets (P. Prusinkiewicz, "Introduction to Modeling with
L-systems", figure 2).

Places are circles and hold tokens, transitions are bars. A row of stages reads from left to right; the arcs of a division
leave its bar and return above the row, each in its own lane, so that no line crosses a circle.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import lru_cache

from lsys_kit.derivation.petri.net import Stages
from lsys_kit.errors import ModelValueError
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
    short,
    steering_of,
)
from lsys_kit.pictures.style.labels import escaped, letter_svg
from lsys_kit.pictures.style.palette import tinted
from lsys_kit.pictures.style.themes import Theme, line, theme
from lsys_kit.pictures.svg import element

DOTS: Mapping[int, tuple[Point, ...]] = {
    0: (),
    1: ((0, 0),),
    2: ((-5, 0), (5, 0)),
    3: ((0, -5.5), (-5, 3.5), (5, 3.5)),
    4: ((-5, -5), (5, -5), (-5, 5), (5, 5)),
}


def drawn_stages(
    net: Stages,
    tokens: Sequence[int] | None = None,
    *,
    marked: Collection[int | None] = (),
    positions: bool = False,
    steering: Collection[str] | None = None,
    labels: bool = True,
) -> str:
    """A stage diagram as SVG text, with numbers of tokens, one for each place, if they are given, and some places highlighted.

    Arcs may be labelled with the positions of their modules in the successor, rather than with their number. Places of symbols
    that only steer the turtle, or of others that are given, are omitted if they are never rewritten.

    >>> from lsys_kit import read, stages
    >>> drawn_stages(stages(read("axiom: a\\na -> ab\\nb -> a")), (2, 1)).count('class="token"')
    3
    """
    if tokens is not None and len(tokens) != len(net.places):
        raise ModelValueError(f"The diagram has {len(net.places)} places; {len(tokens)} numbers of tokens do not fit it")
    steering = steering_of(net.system) if steering is None else frozenset(steering)
    parts, start, stages, lines = _diagram(net, positions, steering, theme(), labels)
    body = []
    for part, stage in zip(parts.places, stages, strict=True):
        ring, edge = (_ring(part), _edge(part)) if part.place in marked else ("", "")
        tokens_in_it = "" if tokens is None else _tokens(part.x, part.y, tokens[part.place])
        body.append(element("g", f"{ring}{stage}{edge}{tokens_in_it}", class_="stage", data_place=part.place))
    told = "" if tokens is None else "; tokens " + ", ".join(short(tokens[part.place]) for part in parts.places)
    told += "".join(f"; {part.name} is marked" for part in parts.places if part.place in marked)
    paper = "" if theme().transparent else element("rect", width="100%", height="100%", fill=theme().ground)
    return f'{start}{escaped(told)}">{paper}{"".join(body)}{lines}</svg>'


@lru_cache(maxsize=64)
def _diagram(
    net: Stages, positions: bool, steering: frozenset[str], chosen: Theme, labels: bool
) -> tuple[Parts, str, list[str], str]:
    """What of the diagram does not depend on the tokens, in the theme in force: its parts; the SVG up to the end of its
    description; for each place that is shown its circle and label; its bars and arcs."""
    parts = parts_of(net, positions, steering, chosen.symbols)
    parts = parts if labels else parts.nameless
    below = (
        element("text", escaped(text), class_="footnote", x=EDGE, y=parts.foot + LINE * line, font_size=SMALL)
        for line, text in enumerate(parts.footnotes)
    )
    lines = "".join([*map(_arc_svg, parts.arcs), *map(_bar_svg, parts.bars), *map(_note_svg, parts.notes), *below])
    start = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {parts.width} {parts.height}" width="{parts.width}" '
        f'height="{parts.height}" style="max-width:100%;height:auto" font-family="sans-serif" fill="{chosen.ink}" '
        f'role="img" aria-label="{escaped(parts.description)}'
    )
    return parts, start, [*map(_stage, parts.places)], lines


def _stage(part: PlacePart) -> str:
    """A circle with its label and its name in words."""
    fill, edge = tinted(part.colour, part.strength), line(part.colour)
    circle = element("circle", cx=part.x, cy=part.y, r=RADIUS, fill=fill, stroke=edge, stroke_width="1.8")
    label = letter_svg(part.letter, part.subscript, part.values)
    text = element("text", label, x=part.x, y=part.y + RADIUS + 17, font_size=LABEL_SIZE, text_anchor="middle")
    return element("title", escaped(part.title)) + circle + text


def _ring(part: PlacePart) -> str:
    return element("circle", cx=part.x, cy=part.y, r=RADIUS + 5, fill=theme().mark, stroke=theme().mark_edge)


def _edge(part: PlacePart) -> str:
    return element("circle", cx=part.x, cy=part.y, r=RADIUS, fill="none", stroke=theme().mark_edge, stroke_width="3.6")


def _tokens(x: float, y: float, count: int) -> str:
    """Up to four tokens as dots, more as a number."""
    if count < 5:
        return "".join(element("circle", class_="token", cx=x + dx, cy=y + dy, r="3.6") for dx, dy in DOTS[count])
    text = short(count)
    size, down = token_size(text), y + 0.36 * token_size(text)
    return element("text", text, class_="token", x=x, y=down, font_size=size, font_weight="bold", text_anchor="middle")


def token_size(text: str) -> int:
    """The size in which a number of tokens fits into a circle.

    >>> token_size("12"), token_size("3.4M")
    (15, 11)
    """
    return 15 if len(text) < 3 else 13 if len(text) < 4 else 11


def _line_svg(d: str, **look: object) -> str:
    return element("path", None, **look, d=d, fill="none", stroke=theme().ink, stroke_width="1.3")


def _bar_svg(bar: BarPart) -> str:
    """A bar with the line to it and its terms."""
    told = element("title", escaped(bar.full)) + escaped(bar.terms)
    text = element("text", told, class_="terms", x=bar.tx, y=bar.ty, font_size=SMALL) if bar.terms else ""
    shape = element("rect", x=bar.x - 1.8, y=bar.y - bar.half, width=3.6, height=2 * bar.half, rx=0.8)
    return element("g", _line_svg(bar.line, class_="feed") + shape + text, class_="transition")


def _arc_svg(arc: ArcPart) -> str:
    """An arc with its arrowhead, on a band of paper that interrupts the lines it crosses."""
    band = element("path", d=arc.band, fill="none", stroke=theme().ground, stroke_width=5)
    return band + _line_svg(arc.path, class_="arc", data_arc=arc.arc) + element("path", d=arc.head)


def _note_svg(note: NotePart) -> str:
    x, y, width, paper = note.x, note.y, note.width, theme().ground
    box = element("rect", x=x - width / 2, y=y - 6, width=width, height=12, fill=paper)
    down = y + 0.36 * SMALL
    return box + element("text", escaped(note.text), class_="note", x=x, y=down, font_size=SMALL, text_anchor="middle")
