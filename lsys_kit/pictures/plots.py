"""Scenes in a matplotlib figure, to stand beside plots of a teacher's own, or to be printed as PDF."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from lsys_kit.geometry.scene import Scene
from lsys_kit.pictures.palette import GREEN, INK, tinted
from lsys_kit.pictures.svg import STROKES, Row, frame_of, stroke_scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def new_axes() -> Axes:
    """The axes of a new figure, of the size of a lesson's picture."""
    from matplotlib.figure import Figure

    return Figure(figsize=(6, 4), layout="constrained").add_subplot()


def plot_strokes(ax: Axes, scene: Scene, colour_of: Mapping[int, str]) -> None:
    """A turtle's strokes."""
    from matplotlib.collections import LineCollection

    thin = stroke_scale(scene.segments, frame_of(scene.box).scale)
    orders = scene.segments.orders.clip(max=len(STROKES) - 1)
    ax.add_collection(LineCollection(scene.segments.ends.reshape(-1, 2, 2).tolist(), capstyle="round",
                                     colors=[colour_of.get(state, GREEN) for state in scene.segments.states.tolist()],
                                     linewidths=[0.8 * STROKES[order] * thin for order in orders.tolist()]))


def plot_rows(ax: Axes, rows: Sequence[Row], colour_of: Mapping[int, str]) -> None:
    """Filaments below one another, centred."""
    from matplotlib.patches import Ellipse, FancyArrowPatch

    pitch = 1.3 * max(row.scene.height for row in rows)
    for place, row in enumerate(rows):
        cells, y = row.scene.cells, -pitch * place
        for (x, _), (length, width), way, shade, state in zip(
                cells.centres.tolist(), cells.sizes.tolist(), cells.polarities.tolist(), cells.shades.tolist(),
                cells.states.tolist(), strict=True):
            colour = colour_of.get(state, GREEN)
            centre = x - row.scene.width / 2
            ax.add_patch(Ellipse((centre, y), length, width, facecolor=tinted(colour, 0.28 + 0.6 * shade), edgecolor=colour,
                                 linewidth=0.6))
            reach = 0.29 * length * way
            ax.add_patch(FancyArrowPatch((centre - reach, y), (centre + reach, y), arrowstyle="->", color=INK, shrinkA=0,
                                         shrinkB=0, linewidth=0.5, mutation_scale=4))
