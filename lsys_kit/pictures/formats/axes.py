"""Pictures in matplotlib figures, to be combined with other plots: scenes in their own units, all else in pixels."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from lsys_kit.geometry.labels import Labels
from lsys_kit.geometry.scene import Floats, Scene
from lsys_kit.pictures.formats.painter import Ink, Lettering, Painter, subpaths
from lsys_kit.pictures.formats.painting import gradient_at
from lsys_kit.pictures.rendering.display_list import AreaRun, DisplayList, LineRun, display_list
from lsys_kit.pictures.rendering.frames import LABEL, LABEL_GAP, MARGIN, ViewFrame, frame_around
from lsys_kit.pictures.shapes import Circle, Drawing, Gradient, Outlined, Place, Raster
from lsys_kit.pictures.style.lighting import HIGHLIGHT, sphere_tone
from lsys_kit.pictures.style.palette import PAPER
from lsys_kit.pictures.style.themes import theme

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.path import Path

RINGS = 12
"""Of so many discs a sphere is made."""
PIXELS = 200
"""The image of a gradient has so many on each side."""
NAMES = {"sans-serif": "DejaVu Sans", "serif": "DejaVu Serif", "monospace": "DejaVu Sans Mono"}
"""The fonts of families of letters, which matplotlib brings."""


def new_axes(ground: str = PAPER) -> Axes:
    """The axes of a new figure, of the size of a lesson's picture."""
    from matplotlib.figure import Figure

    return Figure(figsize=(6, 4), layout="constrained", facecolor=ground).add_subplot()


def set_ground(ax: Axes, ground: str) -> None:
    """Give axes without a frame a ground, if it is not paper as usual."""
    if ground != PAPER:
        ax.patch.set(facecolor=ground, zorder=-1)
        ax.add_artist(ax.patch)


def _room(ax: Axes) -> tuple[float, float]:
    """The width and height of axes in points."""
    sheet = ax.get_figure(root=True)
    assert sheet is not None
    width, height = 72 * sheet.get_size_inches() * ax.get_position().size
    return width, height


# --- shapes, in pixels -------------------------------------------------------------------------------------------------------


class AxesPainter(Painter):
    """What paints a picture in axes that hold all of it, y of which grow downwards from 0."""

    def __init__(self, ax: Axes) -> None:
        self._ax, self._layer, self._points = ax, 0, 1.0

    def draw(self, drawing: Drawing) -> None:
        """Paint a picture."""
        self._points = min(room / size for room, size in zip(_room(self._ax), (drawing.width, drawing.height), strict=True))
        super().draw(drawing)
        self._ax.margins(0)
        self._ax.update_datalim([(0, 0), (drawing.width, -drawing.height)])

    def _next(self) -> int:
        """The layer of the next shape, above all that came before."""
        self._layer += 1
        return self._layer

    def outline(self, shape: Outlined, ink: Ink, place: Place) -> None:
        """Paint an outline as a patch."""
        from matplotlib.colors import to_rgba
        from matplotlib.patches import PathPatch
        from matplotlib.path import Path

        closed = [
            Path(_placed(np.vstack([corners, corners[:1]]) if ends else corners, place), closed=ends)
            for corners, ends in subpaths(shape, place.scale)
        ]
        self._ax.add_patch(
            PathPatch(
                Path.make_compound_path(*closed),
                facecolor=to_rgba(ink.fill or "none", ink.fill_opacity if ink.fill else 0),
                edgecolor=to_rgba(ink.stroke or "none", ink.stroke_opacity if ink.stroke else 0),
                linewidth=ink.width * place.scale * self._points,
                capstyle="round" if ink.round_ends else "butt",
                joinstyle="round",
                linestyle=(0, tuple(dash / ink.width for dash in ink.dashes)) if ink.dashes else "solid",
                zorder=self._next(),
            )
        )

    def sphere(self, circle: Circle, gradient: Gradient, place: Place) -> None:
        """Paint a sphere as an image that is cut out."""
        from matplotlib.patches import Circle as Clip

        (x, y), radius = _placed((circle.x, circle.y), place), circle.radius * place.scale
        down, across = (np.mgrid[:PIXELS, :PIXELS] + 0.5) / PIXELS
        colours, opacity = gradient_at(gradient, across, down)
        image = self._ax.imshow(
            np.dstack([colours, opacity]),
            extent=(x - radius, x + radius, y - radius, y + radius),
            zorder=self._next(),
            interpolation="bilinear",
            aspect="equal",
        )
        image.set_clip_path(Clip((x, y), radius, transform=self._ax.transData))

    def text(self, text: Lettering, place: Place) -> None:
        """Write a text, stretch by stretch."""
        from matplotlib.patheffects import Normal, Stroke

        layer = self._next()
        halo = [Stroke(linewidth=text.halo_width * place.scale * self._points, foreground=text.halo), Normal()]
        for run in text.runs:
            x, y = _placed((run.x, run.y), place)
            self._ax.text(
                x,
                y,
                run.text,
                fontsize=run.size * place.scale * self._points,
                color=text.colour,
                zorder=layer,
                parse_math=False,
                fontfamily=NAMES[text.font.family],
                fontstyle="oblique" if run.italic else "normal",
                fontweight="bold" if text.font.bold else "normal",
                path_effects=halo if text.halo else None,
                clip_on=True,
            )

    def raster(self, raster: Raster, place: Place) -> None:
        """Paint an image."""
        from PIL import Image

        corner = raster.x or 0, raster.y or 0
        (left, top), (right, bottom) = _placed([corner, (corner[0] + raster.width, corner[1] + raster.height)], place)
        pixels = np.asarray(Image.open(io.BytesIO(raster.png)))
        self._ax.imshow(pixels, extent=(left, right, bottom, top), zorder=self._next(), aspect="equal")


def _placed(points: object, place: Place) -> Floats:
    """Points in pixels, with y upwards."""
    found: Floats = (np.asarray(points, float) * place.scale + (place.x, place.y)) * (1, -1)
    return found


# --- scenes, in their own units ----------------------------------------------------------------------------------------------


class PaintedPath(NamedTuple):
    """A path, the colours inside and of its edge, and the width of the edge in points."""

    path: Path
    inside: str
    edge: str
    width: float


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
    width, height = _room(ax)
    return frame_around([scene], max(width, 4 * MARGIN), max(height, 4 * MARGIN))
