"""Scenes as PNG: for pictures with more strokes than SVG is good for, and for what a stored notebook shows.

Drawn without text, at three times the size and then reduced, so that edges are smooth and pixels the same everywhere.
"""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence

import numpy as np

from lsys_kit.geometry.scene import Cells, Scene
from lsys_kit.pictures.palette import GREEN, INK, PAPER, tinted
from lsys_kit.pictures.svg import HEIGHT, MARGIN, STROKES, WIDTH, frame_of, stroke_scale

FINE = 3


def strokes_png(scene: Scene, colour_of: Mapping[int, str]) -> bytes:
    """A turtle's strokes as a PNG picture."""
    from PIL import Image, ImageDraw

    frame = frame_of(scene.box)
    image = Image.new("RGB", (frame.width * FINE, frame.height * FINE), PAPER)
    pen = ImageDraw.Draw(image)
    thin = stroke_scale(scene.segments, frame.scale)
    points = (frame.points(scene.segments.ends) * (FINE / 10)).tolist()
    orders = np.minimum(scene.segments.orders, len(STROKES) - 1).tolist()
    for ends, order, state in zip(points, orders, scene.segments.states.tolist(), strict=True):
        pen.line(ends, fill=colour_of.get(state, GREEN), width=max(1, round(STROKES[order] * thin * FINE)))
    return _png(image.resize((frame.width, frame.height), Image.Resampling.BOX))


def rows_png(scenes: Sequence[Scene], colour_of: Mapping[int, str]) -> bytes:
    """Filaments below one another, with a common scale, as a PNG picture."""
    from PIL import Image, ImageDraw

    longest = max(scene.width for scene in scenes)
    tallest = max(scene.height for scene in scenes)
    pitch = min(46.0, (HEIGHT - 2 * MARGIN) / len(scenes))
    scale = min((WIDTH - 2 * MARGIN) / max(longest, 1e-9), 0.78 * pitch / max(tallest, 1e-9))
    height = round(pitch * len(scenes)) + 2 * MARGIN
    image = Image.new("RGB", (WIDTH * FINE, height * FINE), PAPER)
    pen = ImageDraw.Draw(image)
    for place, scene in enumerate(scenes):
        middle = (MARGIN + pitch * (place + 0.5)) * FINE
        left = (WIDTH - scene.width * scale) / 2 * FINE
        _row(pen, scene.cells, scale * FINE, left, middle, colour_of)
    return _png(image.resize((WIDTH, height), Image.Resampling.BOX))


def _row(pen: object, cells: Cells, scale: float, left: float, middle: float, colour_of: Mapping[int, str]) -> None:
    for x, (length, width), way, shade, state in zip(
            (cells.centres[:, 0] * scale + left).tolist(), (cells.sizes * scale / 2).tolist(), cells.polarities.tolist(),
            cells.shades.tolist(), cells.states.tolist(), strict=True):
        colour = colour_of.get(state, GREEN)
        pen.ellipse((x - length, middle - width, x + length, middle + width), outline=colour,  # type: ignore[attr-defined]
                    fill=tinted(colour, 0.28 + 0.6 * shade), width=FINE)
        if length > 7:
            reach, head = 0.58 * length * way, 0.32 * min(length, width)
            tip = x + reach
            back = tip - head * way
            pen.line([(x - reach, middle), (tip, middle)], fill=INK, width=FINE)  # type: ignore[attr-defined]
            pen.line([(back, middle - head), (tip, middle), (back, middle + head)],  # type: ignore[attr-defined]
                     fill=INK, width=FINE, joint="curve")


def _png(image: object) -> bytes:
    buffer = io.BytesIO()
    image.save(buffer, "PNG", optimize=True)  # type: ignore[attr-defined]
    return buffer.getvalue()
