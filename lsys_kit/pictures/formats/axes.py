"""Scenes in matplotlib figures, to be combined with other plots or printed as PDF."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from lsys_kit.geometry.scene import CIRCLE, Scene
from lsys_kit.pictures.display_list import MARGIN, Faces, Strokes, ViewFrame, display_list, frame_around, shape_colours
from lsys_kit.pictures.filaments import wall_colour, wall_width
from lsys_kit.pictures.style.palette import GREEN, INK, PAPER, tinted
from lsys_kit.pictures.svg import FilamentRow

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.path import Path


def new_axes() -> Axes:
    """The axes of a new figure, of the size of a lesson's picture."""
    from matplotlib.figure import Figure

    return Figure(figsize=(6, 4), layout="constrained").add_subplot()


def plot_turtle(ax: Axes, scene: Scene, colour_of: Mapping[int, str]) -> None:
    """What a turtle has drawn, as one collection, whose paths are painted in their order; the axes hold all of it."""
    from matplotlib.collections import PathCollection
    from matplotlib.colors import to_rgba_array

    frame = _frame(ax, scene)
    shapes = list(_painted(scene, frame.scale, colour_of))
    paths, insides, edges, widths = zip(*shapes, strict=True) if shapes else [()] * 4
    ax.add_collection(PathCollection(paths, facecolors=to_rgba_array(insides), edgecolors=to_rgba_array(edges),
                                     linewidths=widths, capstyle="round", joinstyle="round", transform=ax.transData))
    left, top = frame.left - MARGIN / frame.scale, frame.top + MARGIN / frame.scale
    ax.update_datalim([(left, top), (left + frame.width / frame.scale, top - frame.height / frame.scale)])


def _painted(scene: Scene, scale: float, colour_of: Mapping[int, str]) -> Iterator[tuple[Path, str, str, float]]:
    """For each shape of the display list its path, the colours inside and of its edge, and the width of the edge in points."""
    from matplotlib.path import Path

    strokes, faces, discs = scene.segments.ends.reshape(-1, 2, 2), list(scene.polygons), scene.discs
    of_faces, of_discs = shape_colours(scene.polygons, colour_of), shape_colours(discs, colour_of)
    for run in display_list(scene, scale, colour_of):
        for one in run.numbers.tolist():
            if isinstance(run, Strokes):
                yield Path(strokes[one]), "none", run.colour, run.width / 10
            elif isinstance(run, Faces):
                outline = Path(np.vstack([faces[one], faces[one][:1]]), closed=True)
                yield outline, tinted(of_faces[one], 0.7), of_faces[one], 0.5
            else:
                inside = PAPER if discs.kinds[one] == CIRCLE else tinted(of_discs[one], 0.7)
                yield Path.circle(discs.centres[one].tolist(), float(discs.radii[one])), inside, of_discs[one], 0.8


def _frame(ax: Axes, scene: Scene) -> ViewFrame:
    """The frame of a scene that fills the axes, in points."""
    sheet = ax.get_figure(root=True)
    assert sheet is not None
    width, height = 72 * sheet.get_size_inches() * ax.get_position().size
    return frame_around([scene], max(width, 4 * MARGIN), max(height, 4 * MARGIN))


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
