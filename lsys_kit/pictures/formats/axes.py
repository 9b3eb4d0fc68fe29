"""Scenes in matplotlib figures, in their own units, to be combined with other plots."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from lsys_kit.geometry.scene import Floats, Labels, Scene
from lsys_kit.pictures.rendering.display_list import AreaRun, DisplayList, LineRun
from lsys_kit.pictures.rendering.frames import LABEL, LABEL_GAP, MARGIN, ViewFrame, frame_around
from lsys_kit.pictures.rendering.painters_order import display_list
from lsys_kit.pictures.style.lighting import HIGHLIGHT, sphere_tone
from lsys_kit.pictures.style.palette import PAPER
from lsys_kit.pictures.style.themes import theme

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


def new_axes(ground: str = PAPER) -> Axes:
    """The axes of a new figure, of the size of a lesson's picture."""
    from matplotlib.figure import Figure

    return Figure(figsize=(6, 4), layout="constrained", facecolor=ground).add_subplot()


def set_ground(ax: Axes, ground: str) -> None:
    """Give axes without a frame a ground, if it is not paper as usual."""
    if ground != PAPER:
        ax.patch.set(facecolor=ground, zorder=-1)
        ax.add_artist(ax.patch)


def plot_turtle(ax: Axes, scene: Scene, colour_of: Mapping[int, str]) -> None:
    """What a turtle has drawn, as one collection, whose paths are painted in their order; the axes hold all of it."""
    from matplotlib.collections import PathCollection
    from matplotlib.colors import to_rgba_array

    frame = frame_in(ax, scene)
    shapes = list(_painted(display_list(scene, frame.scale, colour_of)))
    paths, insides, edges, widths = zip(*shapes, strict=True) if shapes else [()] * 4
    ax.add_collection(
        PathCollection(
            paths,
            facecolors=to_rgba_array(insides),
            edgecolors=to_rgba_array(edges),
            linewidths=widths,
            capstyle="round",
            joinstyle="round",
            transform=ax.transData,
        )
    )
    left, top = frame.left - MARGIN / frame.scale, frame.top + MARGIN / frame.scale
    _plot_labels(ax, scene.labels)
    ax.update_datalim([(left, top), (left + frame.width / frame.scale, top - frame.height / frame.scale)])


def _plot_labels(ax: Axes, labels: Labels) -> None:
    """What the turtle has written, each text to the right of its point."""
    from matplotlib.patheffects import withStroke

    halo = [withStroke(linewidth=3, foreground=theme().paper)]
    for place, text in zip(labels.points.tolist(), labels.texts, strict=True):
        ax.annotate(
            text,
            place,
            (LABEL_GAP, 0),
            textcoords="offset points",
            va="center",
            fontsize=LABEL,
            color=theme().ink,
            path_effects=halo,
        )


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
