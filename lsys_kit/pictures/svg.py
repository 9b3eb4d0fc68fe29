"""Scenes as SVG text: the form of lesson pictures, because it scales, prints, and carries its own description.

Coordinates are whole tenths of a pixel, or hundredths or thousandths where strokes are short, so that the text of a picture is
the same on every machine.
"""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from lsys_kit.geometry.scene import Integers, Scene
from lsys_kit.pictures.rendering.display_list import NO_COLOUR, AreaRun, DisplayList, LineRun, Lines
from lsys_kit.pictures.rendering.frames import LABEL, LABEL_GAP, ViewFrame, label_width
from lsys_kit.pictures.rendering.looks import stroke_scale
from lsys_kit.pictures.rendering.painters_order import display_list
from lsys_kit.pictures.sizes import Size, enlargement, final_size
from lsys_kit.pictures.style.lighting import HIGHLIGHT, REACH, sphere_tones
from lsys_kit.pictures.style.themes import theme

if TYPE_CHECKING:
    from PIL.Image import Image


def document(body: str, width: int, height: int, description: str, parts: int = 10) -> str:
    """A whole SVG picture with its text alternative; its units are parts of a pixel."""
    words = escape(description, quote=True)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width * parts} {height * parts}" width="{width}" '
        f'height="{height}" role="img" aria-label="{words}" style="max-width:100%;height:auto">'
        f"<title>{words}</title>{body}</svg>"
    )


def element(tag: str, body: str | None = None, **look: object) -> str:
    """An element: of a name with an underscore instead of each hyphen, and of numbers with one digit behind the point.

    >>> element("text", "a", class_="token", x=1.25, font_size=11)
    '<text class="token" x="1.2" font-size="11">a</text>'
    """
    written = ""
    for name, value in look.items():
        name = name.rstrip("_").replace("_", "-") if "_" in name else name
        written += f' {name}="{value:.1f}"' if isinstance(value, float) else f' {name}="{value}"'
    return f"<{tag}{written}/>" if body is None else f"<{tag}{written}>{body}</{tag}>"


_HEAD = re.compile(r'viewBox="0 0 (\d+) (\d+)" width="(\d+)" height="(\d+)"')


def resized(svg: str, size: Size | None) -> str:
    """A whole SVG picture enlarged to a size; where that has other proportions, it lies in the middle of more paper.

    >>> resized('<svg viewBox="0 0 60 40" width="6" height="4"><title>-</title></svg>', (60, 60))
    '<svg viewBox="0 -10 60 60" width="60" height="60"><title>-</title><rect x="0" y="-10" ...
    """
    found = _HEAD.search(svg)
    if size is None or found is None:
        return svg
    across, down, width, height = map(int, found.groups())
    factor, (wide, high) = enlargement(width, height, size), final_size(width, height, size)
    sides = () if size[1] is None else ((across, wide, width), (down, high, height))
    more = [round(side * (room / factor / own - 1) / 2) for side, room, own in sides] or [0, 0]
    box = f"{-more[0]} {-more[1]} {across + 2 * more[0]} {down + 2 * more[1]}"
    svg = f'{svg[: found.start()]}viewBox="{box}" width="{wide}" height="{high}"{svg[found.end() :]}'
    corner_and_size = 'x="{}" y="{}" width="{}" height="{}"'.format(*box.split())
    paper = f'<rect {corner_and_size} fill="{theme().ground}"/>' if any(more) and not theme().transparent else ""
    return svg.replace("</title>", f"</title>{paper}", 1)


def embedded(width: int, height: int, image: Image, corner: tuple[int, int] | None = None) -> str:
    """An image in a picture, as broad and high as it is there, perhaps with its left upper corner at some place."""
    buffer = io.BytesIO()
    image.save(buffer, "PNG")
    data = base64.b64encode(buffer.getvalue()).decode()
    place = "" if corner is None else 'x="{}" y="{}" '.format(*corner)
    return f'<image {place}width="{width}" height="{height}" href="data:image/png;base64,{data}"/>'


def turtle_svg(scene: Scene, frame: ViewFrame, colour_of: Mapping[int, str], marked: Collection[int] = ()) -> str:
    """A scene of a turtle as SVG, in the order in which it is painted."""
    shapes = display_list(scene, frame.scale, colour_of)
    areas, rounds, broad = _areas(shapes, frame), _rounds(shapes, frame), max(5, 9 * stroke_scale(scene.segments, frame.scale))
    points, parts = frame.points(shapes.lines.ends), [_gradients(shapes)]
    for kind, runs in groupby(shapes, type):
        if kind is LineRun:
            lines = [run for run in runs if isinstance(run, LineRun)]
            parts.append(_lines_svg(shapes.lines, points, lines, (frame.parts, broad), marked))
        else:
            texts, look = (areas, _AREAS) if kind is AreaRun else (rounds, _ROUNDS)
            body = "".join(texts[number] for run in runs for number in run.numbers.tolist())
            parts.append(f'<g stroke-width="{look * frame.parts:.0f}" stroke-linejoin="round">{body}</g>' if body else "")
    return "".join(parts) + labels_svg(scene, frame)


def labels_svg(scene: Scene, frame: ViewFrame) -> str:
    """The labels of a scene, each to the right of its point, as far as the picture goes."""
    texts = []
    for (x, y), text in zip(frame.points(scene.labels.points).tolist(), scene.labels.texts, strict=True):
        start = min(x + LABEL_GAP * frame.parts, (frame.width + LABEL_GAP - label_width(text)) * frame.parts)
        texts.append(f'<text x="{start:.0f}" y="{y + 0.36 * LABEL * frame.parts:.0f}">{escape(text)}</text>')
    return (
        (
            f'<g class="label" font-size="{LABEL * frame.parts}" font-family="sans-serif" fill="{theme().ink}" '
            f'stroke="{theme().paper}" stroke-width="{3 * frame.parts}" stroke-linejoin="round" paint-order="stroke">'
            f"{''.join(texts)}</g>"
        )
        if texts
        else ""
    )


_AREAS, _ROUNDS = 0.6, 1.0
"""The widths of the edges of polygons and of discs, in pixels."""
SMALLEST = 0.8
"""The least radius of a disc, in pixels."""


def _areas(shapes: DisplayList, frame: ViewFrame) -> list[str]:
    """Polygons, most with an edge."""
    areas, texts = shapes.areas, []
    points, starts = frame.points(areas.points).tolist(), areas.starts.tolist()
    for first, last, fill, edge in zip(starts, starts[1:], areas.fills.tolist(), areas.edges.tolist(), strict=False):
        corners = " ".join(f"{x},{y}" for x, y in points[first:last])
        texts.append(f'<polygon points="{corners}" fill="{shapes.palette[fill]}"{_edge(shapes, edge)}/>')
    return texts


def _edge(shapes: DisplayList, colour: int) -> str:
    return "" if colour == NO_COLOUR else f' stroke="{shapes.palette[colour]}"'


def _rounds(shapes: DisplayList, frame: ViewFrame) -> list[str]:
    """Discs, and spheres with a gradient."""
    rounds, texts = shapes.rounds, []
    for (x, y), radius, fill, edge, sphere in zip(
        frame.points(rounds.centres).tolist(),
        rounds.radii.tolist(),
        rounds.fills.tolist(),
        rounds.edges.tolist(),
        rounds.spheres.tolist(),
        strict=True,
    ):
        reach = max(SMALLEST, radius * frame.scale) * frame.parts
        colour = "none" if fill == NO_COLOUR else shapes.palette[fill]
        inside = f"url(#{_gradient_name(colour)})" if sphere else colour
        texts.append(f'<circle cx="{x}" cy="{y}" r="{reach:.0f}" fill="{inside}"{_edge(shapes, edge)}/>')
    return texts


def _gradients(shapes: DisplayList) -> str:
    """The gradients of spheres, one for each of their colours."""
    colours = [shapes.palette[number] for number in np.unique(shapes.rounds.fills[shapes.rounds.spheres]).tolist()]
    x, y = 0.5 + HIGHLIGHT[0] / 2, 0.5 - HIGHLIGHT[1] / 2
    found = []
    for colour in colours:
        stops = "".join(f'<stop offset="{share}" stop-color="{tone}"/>' for share, tone in sphere_tones(colour))
        found.append(
            f'<radialGradient id="{_gradient_name(colour)}" cx="{x:.2f}" cy="{y:.2f}" r="{REACH / 2:.2f}">{stops}'
            "</radialGradient>"
        )
    return f"<defs>{''.join(found)}</defs>" if found else ""


def _gradient_name(colour: str) -> str:
    """The name of the gradient of spheres of a colour; what has the same name in one page is the same."""
    return f"lsys-sphere-{colour[1:]}"


def _lines_svg(
    lines: Lines, points: Integers, runs: Sequence[LineRun], look: tuple[int, float], marked: Collection[int]
) -> str:
    """Lines that nothing lies between: a path for each colour and width; marked ones lie on a broad band.

    The look says how many parts a pixel has, and how many pixels broad the band is.
    """
    body, (parts, broad) = [], look
    if marked:
        numbers = np.concatenate([run.numbers for run in runs])
        chosen = points[numbers[np.isin(lines.states[numbers], list(marked))]]
        body += [
            f'<path class="marked" d="{_path(chosen)}" stroke="{theme().mark_edge}" stroke-width="{broad * parts:.0f}" '
            'stroke-opacity="0.45"/>'
        ] * bool(len(chosen))
    for run in runs:
        body.append(f'<path d="{_path(points[run.numbers])}" stroke="{run.colour}" stroke-width="{run.width * parts // 10}"/>')
    return f'<g fill="none" stroke-linecap="round">{"".join(body)}</g>'


def _path(points: Integers) -> str:
    return "M%d %dL%d %d" * len(points) % tuple(points.ravel().tolist())


@dataclass(frozen=True)
class FilamentRow:
    """One step of a developmental sequence; or one line of it, if it is folded, with its number from 0."""

    step: int
    scene: Scene
    part: int | None = None


def background(width: int, height: int, parts: int = 10) -> str:
    """Paper, so that a picture can be read on any page; nothing where it is to lie on that of the page."""
    ground = theme().ground
    return "" if theme().transparent else f'<rect width="{width * parts}" height="{height * parts}" fill="{ground}"/>'


def described(parts: Iterable[str]) -> str:
    """Parts of a description, joined as a sentence."""
    return "; ".join(part for part in parts if part)
