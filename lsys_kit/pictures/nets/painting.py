"""Stage diagrams painted on a sheet, as `diagram` writes them as SVG."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from lsys_kit.pictures.formats.sheet import Sheet, corners_of, label_width
from lsys_kit.pictures.nets.captions import short
from lsys_kit.pictures.nets.diagram import DOTS, token_size
from lsys_kit.pictures.nets.layout import EDGE, RADIUS
from lsys_kit.pictures.nets.parts import LABEL_SIZE, LINE, SMALL, ArcPart, BarPart, NotePart, Parts, PlacePart
from lsys_kit.pictures.style.palette import tinted
from lsys_kit.pictures.style.themes import line, theme

STROKE = 1.3


def paint_stages(sheet: Sheet, parts: Parts, tokens: Sequence[int], marked: Collection[int | None] = ()) -> None:
    """Paint a stage diagram with its tokens; marked places, given by their numbers, are highlighted."""
    for place in parts.places:
        _paint_place(sheet, place, tokens[place.place], place.place in marked)
    for arc in parts.arcs:
        _paint_arc(sheet, arc)
    for bar in parts.bars:
        _paint_bar(sheet, bar)
    for note in parts.notes:
        _paint_note(sheet, note)
    for number, text in enumerate(parts.footnotes):
        sheet.text(EDGE, parts.foot + LINE * number, text, SMALL)


def _paint_place(sheet: Sheet, place: PlacePart, tokens: int, marked: bool) -> None:
    x, y, label = place.x, place.y, (place.letter, place.subscript, place.values)
    if marked:
        sheet.circle(x, y, RADIUS + 5, theme().mark, theme().mark_edge, 1)
    edge, width = (theme().mark_edge, 3.6) if marked else (line(place.colour), 1.8)
    sheet.circle(x, y, RADIUS, tinted(place.colour, place.strength), edge, width)
    sheet.label(x - label_width(label, LABEL_SIZE) / 2, y + RADIUS + 17, label, LABEL_SIZE)
    for across, down in DOTS.get(tokens, ()):
        sheet.circle(x + across, y + down, 3.6, theme().ink)
    if tokens not in DOTS:
        size = token_size(short(tokens))
        sheet.centred(x, y + 0.36 * size, short(tokens), size)


def _paint_arc(sheet: Sheet, arc: ArcPart) -> None:
    sheet.line(corners_of(arc.band), theme().ground, 5)
    sheet.line(corners_of(arc.path), theme().ink, STROKE)
    sheet.polygon(corners_of(arc.head), theme().ink)


def _paint_bar(sheet: Sheet, bar: BarPart) -> None:
    sheet.line(corners_of(bar.line), theme().ink, STROKE)
    sheet.box(bar.x - 1.8, bar.y - bar.half, 3.6, 2 * bar.half, theme().ink)
    sheet.text(bar.tx, bar.ty, bar.terms, SMALL)


def _paint_note(sheet: Sheet, note: NotePart) -> None:
    sheet.box(note.x - note.width / 2, note.y - 6, note.width, 12, theme().ground)
    sheet.centred(note.x, note.y + 0.36 * SMALL, note.text, SMALL)
