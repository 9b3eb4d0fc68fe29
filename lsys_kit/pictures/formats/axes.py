"""Scenes in matplotlib figures, to be combined with other plots or printed as PDF."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from lsys_kit.geometry.scene import CIRCLE, Scene
from lsys_kit.pictures.display_list import MARGIN, frame_of, groups, shape_colours
from lsys_kit.pictures.filaments import wall_colour, wall_width
from lsys_kit.pictures.style.palette import GREEN, INK, PAPER, tinted
from lsys_kit.pictures.svg import FilamentRow

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def new_axes() -> Axes:
    """The axes of a new figure, of the size of a lesson's picture."""
    from matplotlib.figure import Figure

    return Figure(figsize=(6, 4), layout="constrained").add_subplot()


def plot_turtle(ax: Axes, scene: Scene, colour_of: Mapping[int, str]) -> None:
    """What a turtle has drawn: surfaces, strokes, discs."""
    from matplotlib.collections import LineCollection, PolyCollection
    from matplotlib.patches import Circle

    if len(scene.polygons):
        edges = shape_colours(scene.polygons, colour_of)
        ax.add_collection(PolyCollection(list(scene.polygons), edgecolors=edges, linewidths=0.5,
                                         facecolors=[tinted(colour, 0.7) for colour in edges]))
    for colour, width, chosen in groups(scene.segments, _points_per_unit(ax, scene), colour_of):
        strokes = scene.segments.ends[chosen].reshape(-1, 2, 2).tolist()
        ax.add_collection(LineCollection(strokes, capstyle="round", colors=colour, linewidths=width / 10))
    discs = scene.discs
    for centre, radius, kind, colour in zip(discs.centres.tolist(), discs.radii.tolist(), discs.kinds.tolist(),
                                            shape_colours(discs, colour_of), strict=True):
        ax.add_patch(Circle(centre, radius, edgecolor=colour, linewidth=0.8,
                            facecolor=PAPER if kind == CIRCLE else tinted(colour, 0.7)))


def _points_per_unit(ax: Axes, scene: Scene) -> float:
    """The length of a unit of the model in points, if the drawing fills the axes."""
    sheet = ax.get_figure(root=True)
    assert sheet is not None
    width, height = 72 * sheet.get_size_inches() * ax.get_position().size
    return frame_of(scene.box, max(width, 4 * MARGIN), max(height, 4 * MARGIN)).scale


def plot_rows(ax: Axes, rows: Sequence[FilamentRow], look: str, colour_of: Mapping[int, str]) -> None:
    """Filaments below one another, centred."""
    from matplotlib.patches import Ellipse, FancyArrowPatch, FancyBboxPatch, Patch

    pitch = (1.8 if any(len(row.scene.walls) for row in rows) else 1.4) * max(row.scene.height for row in rows)
    for place, row in enumerate(rows):
        cells, y = row.scene.cells, -pitch * place
        for (x, _), (length, width), way, shade, state in zip(
                cells.centres.tolist(), cells.sizes.tolist(), cells.polarities.tolist(), cells.shades.tolist(),
                cells.states.tolist(), strict=True):
            colour = colour_of.get(state, GREEN)
            centre, style = x - row.scene.width / 2, f"round,pad=0,rounding_size={min(length, width) / 2}"
            shape: Patch = Ellipse((centre, y), length, width) if look == "ellipses" else \
                FancyBboxPatch((centre - length / 2, y - width / 2), length, width, boxstyle=style)
            shape.set(facecolor=tinted(colour, 0.28 + 0.6 * shade), edgecolor=colour, linewidth=0.6)
            ax.add_patch(shape)
            reach = 0.29 * length * way
            if way:
                ax.add_patch(FancyArrowPatch((centre - reach, y), (centre + reach, y), arrowstyle="->", color=INK, shrinkA=0,
                                             shrinkB=0, linewidth=0.5, mutation_scale=4))
        _plot_walls(ax, row, y, colour_of)


def _plot_walls(ax: Axes, row: FilamentRow, y: float, colour_of: Mapping[int, str]) -> None:
    """The walls of a filament, with their ages."""
    walls = row.scene.walls
    for x, height, age, shade, state in zip((walls.places - row.scene.width / 2).tolist(), walls.heights.tolist(),
                                            walls.ages.tolist(), walls.shades.tolist(), walls.states.tolist(), strict=True):
        ax.plot([x, x], [y - 0.55 * height, y + 0.55 * height], color=wall_colour(colour_of.get(state, GREEN), shade),
                linewidth=0.6 * wall_width(shade))
        if not math.isnan(age):
            ax.annotate(f"{age:.4g}", (x, y + 0.55 * height), (0, 1), textcoords="offset points", ha="center", color=INK,
                        fontsize=5)
