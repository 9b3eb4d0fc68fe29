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
    arrowhead,
    parts_of,
    short,
)
from lsys_kit.pictures.shapes import Circle, Drawing, Group, Look, Paper, Path, Rectangle, Shape, Text, Title
from lsys_kit.pictures.style.labels import label_spans, steering_of
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
    lines
        The bars and arcs.
    stages
        For each place that is shown its circle and label.
    """

    parts: Parts
    lines: Sequence[Shape]
    stages: Sequence[Sequence[Shape]]


def drawn_stages(
    net: Stages,
    tokens: Sequence[int] | None = None,
    *,
    marked: Collection[int | None] = (),
    positions: bool = False,
    steering: Collection[str] | None = None,
    labels: bool = True,
) -> Drawing:
    """A stage diagram as shapes, with numbers of tokens, one for each place, if they are given, and some places highlighted.

    Arcs may be labelled with the positions of their modules in the successor, rather than with their number. Places of symbols
    that only steer the turtle, or of others that are given, are omitted if they are never rewritten.

    >>> from lsys_kit import read, stages
    >>> [*drawn_stages(stages(read("axiom: a\\na -> ab\\nb -> a")), (2, 1)).shapes[1].shapes][-1].tags
    {'class': 'token'}
    """
    if tokens is not None and len(tokens) != len(net.places):
        raise ModelValueError(f"The diagram has {len(net.places)} places; {len(tokens)} numbers of tokens do not fit it")
    diagram = _diagram(net, positions, steering_of(net.system) if steering is None else frozenset(steering), theme(), labels)
    parts, places = diagram.parts, diagram.parts.places
    body: list[Shape] = [] if theme().transparent else [Paper(theme().ground)]
    for part, stage in zip(places, diagram.stages, strict=True):
        x, y, chosen = part.x, part.y, part.place in marked
        shapes = [_ring(x, y), *stage, _edge(x, y)] if chosen else stage
        held = [] if tokens is None else _tokens(x, y, tokens[part.place])
        body.append(Group([*shapes, *held], tags={"class": "stage", "data-place": part.place}))
    told = "" if tokens is None else "; tokens " + ", ".join(short(tokens[part.place]) for part in places)
    told += "".join(f"; {part.name} is marked" for part in places if part.place in marked)
    look, box = Look(font_family="sans-serif", fill=theme().ink), (0, 0, parts.width, parts.height)
    return Drawing(parts.width, parts.height, parts.description + told, [*body, *diagram.lines], box, look)


@lru_cache(maxsize=64)
def _diagram(net: Stages, positions: bool, steering: frozenset[str], chosen: Theme, labels: bool) -> Diagram:
    """What of the diagram does not depend on the tokens, in the theme in force."""
    parts = parts_of(net, positions, steering, chosen.symbols)
    parts = parts if labels else parts.nameless
    footnotes = [_footnote(parts.foot + LINE * line, text) for line, text in enumerate(parts.footnotes)]
    lines = [shape for each in (*map(_arc, parts.arcs), *map(_bar, parts.bars), *map(_note, parts.notes)) for shape in each]
    return Diagram(parts, [*lines, *footnotes], [_stage(part) for part in parts.places])


def _stage(part: PlacePart) -> list[Shape]:
    """A circle with its label and its name in words."""
    x, y = float(part.x), float(part.y)
    look = Look(fill=tinted(part.colour, part.strength), stroke=line(part.colour), stroke_width=1.8)
    written = label_spans(part.letter, part.subscript, part.values)
    label = Text(x, y + RADIUS + 17, written, Look(font_size=LABEL_SIZE, text_anchor="middle"))
    return [Title(part.title), Circle(x, y, float(RADIUS), look), label]


def _ring(x: float, y: float) -> Circle:
    return Circle(float(x), float(y), RADIUS + 5.0, Look(fill=theme().mark, stroke=theme().mark_edge))


def _edge(x: float, y: float) -> Circle:
    return Circle(float(x), float(y), float(RADIUS), Look(fill="none", stroke=theme().mark_edge, stroke_width=3.6))


def _tokens(x: float, y: float, count: int) -> list[Shape]:
    """Up to four tokens as dots, more as a number."""
    tags = {"class": "token"}
    if count < 5:
        return [Circle(float(x + dx), float(y + dy), 3.6, tags=tags) for dx, dy in DOTS[count]]
    text = short(count)
    size = token_size(text)
    look = Look(font_size=size, font_weight="bold", text_anchor="middle")
    return [Text(float(x), y + 0.36 * size, text, look, tags)]


def token_size(text: str) -> int:
    """The size in which a number of tokens fits into a circle.

    >>> token_size("12"), token_size("3.4M")
    (15, 11)
    """
    return 15 if len(text) < 3 else 13 if len(text) < 4 else 11


def _bar(bar: BarPart) -> list[Shape]:
    """A bar with the arrow to it, from the left, and its terms."""
    shapes: list[Shape] = [
        Path(bar.line, _stroke(), {"class": "feed"}),
        Path(arrowhead((bar.x - 1.8, bar.y), (bar.x - RADIUS, bar.y))),
        Rectangle(bar.x - 1.8, float(bar.y - bar.half), 3.6, 2.0 * bar.half, 0.8),
    ]
    if bar.terms:
        look, tags = Look(font_size=SMALL), {"class": "terms"}
        shapes.append(Text(float(bar.tx), float(bar.ty), (Title(bar.full), bar.terms), look, tags))
    return [Group(shapes, tags={"class": "transition"})]


def _stroke() -> Look:
    return Look(fill="none", stroke=theme().ink, stroke_width=1.3)


def _arc(arc: ArcPart) -> list[Shape]:
    """An arc with its arrowhead, on a band of paper that interrupts the lines it crosses."""
    band = Look(fill="none", stroke=theme().ground, stroke_width=5)
    return [Path(arc.band, band), Path(arc.path, _stroke(), {"class": "arc", "data-arc": arc.arc}), Path(arc.head)]


def _note(note: NotePart) -> list[Shape]:
    x, y, width = float(note.x), float(note.y), float(note.width)
    look = Look(font_size=SMALL, text_anchor="middle")
    return [
        Rectangle(x - width / 2, y - 6, width, 12, look=Look(fill=theme().ground)),
        Text(x, y + 0.36 * SMALL, note.text, look, {"class": "note"}),
    ]


def _footnote(y: float, text: str) -> Text:
    return Text(float(EDGE), float(y), text, Look(font_size=SMALL), {"class": "footnote"})
