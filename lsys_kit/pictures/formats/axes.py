"""Scenes in matplotlib figures, to be combined with other plots or printed as PDF."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from lsys_kit.geometry.scene import Floats, Scene
from lsys_kit.pictures.filaments import wall_colour, wall_width
from lsys_kit.pictures.rendering.display_list import AreaRun, DisplayList, LineRun
from lsys_kit.pictures.rendering.frames import MARGIN, ViewFrame, frame_around
from lsys_kit.pictures.rendering.painters_order import display_list
from lsys_kit.pictures.style.lighting import HIGHLIGHT, sphere_tone
from lsys_kit.pictures.style.palette import GREEN, INK, cell_fill
from lsys_kit.pictures.svg import FilamentRow

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.path import Path

RINGS = 12
"""Of so many discs a sphere is made."""


class PaintedPath(NamedTuple):
    """A path, the colours inside and of its edge, and the width of the edge in points."""

    path: Path
    inside: str
    edge: str
    width: float


def new_axes() -> Axes:
    """The axes of a new figure, of the size of a lesson's picture."""
    from matplotlib.figure import Figure

    return Figure(figsize=(6, 4), layout="constrained").add_subplot()


def plot_turtle(ax: Axes, scene: Scene, colour_of: Mapping[int, str]) -> None:
    """What a turtle has drawn, as one collection, whose paths are painted in their order; the axes hold all of it."""
    from matplotlib.collections import PathCollection
    from matplotlib.colors import to_rgba_array

    frame = frame_in(ax, scene)
    shapes = list(_painted(display_list(scene, frame.scale, colour_of)))
    paths, insides, edges, widths = zip(*shapes, strict=True) if shapes else [()] * 4
    ax.add_collection(PathCollection(paths, facecolors=to_rgba_array(insides), edgecolors=to_rgba_array(edges),
                                     linewidths=widths, capstyle="round", joinstyle="round", transform=ax.transData))
    left, top = frame.left - MARGIN / frame.scale, frame.top + MARGIN / frame.scale
    ax.update_datalim([(left, top), (left + frame.width / frame.scale, top - frame.height / frame.scale)])


def _painted(shapes: DisplayList) -> Iterator[PaintedPath]:
    """What is painted, in its order."""
    from matplotlib.path import Path

    lines, areas, rounds, names = shapes.lines.ends.reshape(-1, 2, 2), shapes.areas, shapes.rounds, [*shapes.palette, "none"]
    outlines = np.split(areas.points, areas.starts[1:-1])
    for run in shapes:
        for one in run.numbers.tolist():
            if isinstance(run, LineRun):
                yield PaintedPath(Path(lines[one]), "none", run.colour, run.width / 10)
            elif isinstance(run, AreaRun):
                outline = Path(np.vstack([outlines[one], outlines[one][:1]]), closed=True)
                yield PaintedPath(outline, names[areas.fills[one]], names[areas.edges[one]], 0.5)
            elif rounds.spheres[one]:
                yield from _sphere(rounds.centres[one], float(rounds.radii[one]), names[rounds.fills[one]])
            else:
                disc = Path.circle(rounds.centres[one].tolist(), float(rounds.radii[one]))
                yield PaintedPath(disc, names[rounds.fills[one]], names[rounds.edges[one]], 0.8)


def _sphere(centre: Floats, radius: float, colour: str) -> Iterator[PaintedPath]:
    """A sphere as discs within one another, from its rim to where it is brightest."""
    from matplotlib.path import Path

    for share in np.linspace(1, 0, RINGS, endpoint=False).tolist():
        middle = centre + radius * (1 - share) * HIGHLIGHT
        yield PaintedPath(Path.circle(middle.tolist(), radius * share), sphere_tone(colour, share), "none", 0.0)


def frame_in(ax: Axes, scene: Scene) -> ViewFrame:
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
            shape.set(facecolor=cell_fill(colour, shade), edgecolor=colour, linewidth=0.6)
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
