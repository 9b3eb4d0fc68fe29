"""The shapes of a picture in a matplotlib figure, to be combined with other plots."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np

from lsys_kit.budget import counted
from lsys_kit.geometry.scene import Floats
from lsys_kit.pictures.formats.painting import gradient_at
from lsys_kit.pictures.formats.vector.paths import subpaths
from lsys_kit.pictures.formats.vector.shapes import Drawing, Outline, Place, Raster, Sphere, Text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PIXELS = 200
"""The image of a gradient has so many on each side."""
NAMES = {"sans-serif": "DejaVu Sans", "serif": "DejaVu Serif", "monospace": "DejaVu Sans Mono"}
"""The fonts of families of letters, which matplotlib brings."""


def plot_drawing(ax: Axes, drawing: Drawing) -> None:
    """A drawing, painted in pixels, y of which grow downwards from 0; the axes hold all of it."""
    sheet = ax.get_figure(root=True)
    assert sheet is not None
    wide, high = 72 * sheet.get_size_inches() * ax.get_position().size
    points = min(wide / drawing.width, high / drawing.height)
    for layer, shape in enumerate(counted(drawing.shapes), 1):
        place = shape.place
        if isinstance(shape, Outline):
            _plot_outline(ax, shape, place, points, layer)
        elif isinstance(shape, Sphere):
            _plot_sphere(ax, shape, place, layer)
        elif isinstance(shape, Text):
            _plot_text(ax, shape, place, points, layer)
        else:
            _plot_raster(ax, shape, place, layer)
    ax.margins(0)
    ax.update_datalim([(0, 0), (drawing.width, -drawing.height)])


def _placed(points: object, place: Place) -> Floats:
    """Points in pixels, with y upwards."""
    found: Floats = (np.asarray(points, float) * place.scale + (place.x, place.y)) * (1, -1)
    return found


def _plot_outline(ax: Axes, shape: Outline, place: Place, points: float, layer: int) -> None:
    from matplotlib.colors import to_rgba
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    look, paths = shape.look, subpaths(shape.data, place.scale)
    closed = [
        Path(_placed(np.vstack([each.corners, each.corners[:1]]) if each.closed else each.corners, place), closed=each.closed)
        for each in paths
    ]
    width, ends = look.width * place.scale * points, "round" if look.round_ends else "butt"
    dashes = (0, tuple(dash / look.width for dash in look.dashes)) if look.dashes else "solid"
    ax.add_patch(
        PathPatch(
            Path.make_compound_path(*closed),
            facecolor=to_rgba(look.fill or "none", look.fill_opacity if look.fill else 0),
            edgecolor=to_rgba(look.stroke or "none", look.stroke_opacity if look.stroke else 0),
            linewidth=width,
            capstyle=ends,
            joinstyle="round",
            linestyle=dashes,
            zorder=layer,
        )
    )


def _plot_raster(ax: Axes, shape: Raster, place: Place, layer: int) -> None:
    from PIL import Image

    (left, top), (right, bottom) = _placed([(shape.x, shape.y), (shape.x + shape.width, shape.y + shape.height)], place)
    ax.imshow(np.asarray(Image.open(io.BytesIO(shape.png))), extent=(left, right, bottom, top), zorder=layer, aspect="equal")


def _plot_sphere(ax: Axes, shape: Sphere, place: Place, layer: int) -> None:
    from matplotlib.patches import Circle

    (x, y), radius = _placed((shape.x, shape.y), place), shape.radius * place.scale
    down, across = (np.mgrid[:PIXELS, :PIXELS] + 0.5) / PIXELS
    colours, opacity = gradient_at(shape.gradient, across, down)
    image = ax.imshow(
        np.dstack([colours, opacity]),
        extent=(x - radius, x + radius, y - radius, y + radius),
        zorder=layer,
        interpolation="bilinear",
        aspect="equal",
    )
    image.set_clip_path(Circle((x, y), radius, transform=ax.transData))


def _plot_text(ax: Axes, shape: Text, place: Place, points: float, layer: int) -> None:
    from matplotlib.patheffects import Normal, Stroke

    halo = [Stroke(linewidth=shape.halo_width * place.scale * points, foreground=shape.halo), Normal()]
    weight = "bold" if shape.font.bold else "normal"
    for run in shape.runs:
        x, y = _placed((run.x, run.y), place)
        ax.text(
            x,
            y,
            run.text,
            fontsize=run.size * place.scale * points,
            color=shape.colour,
            zorder=layer,
            parse_math=False,
            fontfamily=NAMES[shape.font.family],
            fontstyle="oblique" if run.italic else "normal",
            fontweight=weight,
            path_effects=halo if shape.halo else None,
            clip_on=True,
        )
