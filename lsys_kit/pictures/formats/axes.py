"""Pictures in matplotlib figures, to be combined with other plots: scenes in their own units, all else in pixels."""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import TYPE_CHECKING

from lsys_kit.arrays import np
from lsys_kit.geometry.scene import Floats, Scene
from lsys_kit.pictures.formats.painter import Ink, Lettering, Painter, subpaths
from lsys_kit.pictures.formats.painting import gradient_at
from lsys_kit.pictures.rendering.frames import MARGIN, ViewFrame, frame_around, in_fine_parts
from lsys_kit.pictures.rendering.scene_shapes import scene_shapes
from lsys_kit.pictures.shapes import Circle, Drawing, Gradient, Look, Outlined, Path, Place, Raster, Strokes
from lsys_kit.pictures.style.palette import PAPER

if TYPE_CHECKING:
    from matplotlib.axes import Axes

RINGS = 12
"""Of so many discs a sphere is made that hides what is behind it."""
PIXELS = 200
"""The image of a gradient through which one sees has so many on each side."""
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


def plot_drawing(ax: Axes, drawing: Drawing) -> None:
    """A picture in pixels, y of which grow downwards from 0; the axes hold all of it."""
    points = min(room / size for room, size in zip(_room(ax), (drawing.width, drawing.height), strict=True))
    ax.margins(0)
    AxesPainter(ax, points, drawing.place).draw(drawing)


def plot_turtle(ax: Axes, scene: Scene, colour_of: Mapping[int, str]) -> None:
    """What a turtle has drawn, in its own units; the axes hold all of it."""
    frame = in_fine_parts(frame_in(ax, scene), scene)
    place = Place(1 / (frame.scale * frame.parts), frame.left - MARGIN / frame.scale, -frame.top - MARGIN / frame.scale)
    box = (0, 0, frame.width * frame.parts, frame.height * frame.parts)
    shapes = scene_shapes(scene, frame, colour_of)
    AxesPainter(ax, frame.scale, place).draw(Drawing(frame.width, frame.height, "", shapes, box, Look()))


def frame_in(ax: Axes, scene: Scene) -> ViewFrame:
    """The frame of a scene that fills the axes, in points."""
    width, height = _room(ax)
    return frame_around([scene], (max(width, 4 * MARGIN), max(height, 4 * MARGIN)))


def _room(ax: Axes) -> tuple[float, float]:
    sheet = ax.get_figure(root=True)
    assert sheet is not None
    width, height = 72 * sheet.get_size_inches() * ax.get_position().size
    return width, height


class AxesPainter(Painter):
    """What paints a picture in axes: outlines one after another in collections, with what is no outline between them.

    Parameters
    ----------
    ax
        The axes.
    points
        How many points a unit of the axes has.
    place
        Where the units of the picture lie in those of the axes, but with y downwards.
    """

    def __init__(self, ax: Axes, points: float, place: Place) -> None:
        self._ax, self._points, self._place, self._layer = ax, points, place, 0
        self._outlines: list[tuple[object, ...]] = []
        self._ends = "butt"

    def draw(self, drawing: Drawing) -> None:
        """Paint a picture."""
        left, top, across, down = self._box = drawing.box
        self.paint(drawing.shapes, drawing.look, self._place)
        self._next()
        self._ax.update_datalim(_placed([(left, top), (left + across, top + down)], self._place))

    def _next(self) -> int:
        """The layer of what comes next, above the outlines so far, which are added."""
        from matplotlib.collections import PathCollection

        if self._outlines:
            paths, insides, edges, widths, dashes = zip(*self._outlines, strict=True)
            found = PathCollection(
                paths,
                facecolors=insides,
                edgecolors=edges,
                linewidths=widths,
                linestyles=[*dashes],
                capstyle=self._ends,
                joinstyle="round",
                transform=self._ax.transData,
                zorder=self._layer,
            )
            self._ax.add_collection(found, autolim=False)
            self._outlines = []
        self._layer += 1
        return self._layer

    def outline(self, shape: Outlined, ink: Ink, place: Place) -> None:
        """Paint an outline."""
        from matplotlib.colors import to_rgba
        from matplotlib.path import Path as Outline

        ends = "round" if ink.round_ends else "butt"
        if ends != self._ends and isinstance(shape, Path | Strokes):
            self._next()
            self._ends = ends
        paths = [
            Outline(_placed(np.vstack([corners, corners[:1]]) if closed else corners, place), closed=closed)
            for corners, closed in subpaths(shape, place.scale * self._points)
        ]
        look = (
            to_rgba(ink.fill or "none", ink.fill_opacity if ink.fill else 0),
            to_rgba(ink.stroke or "none", ink.stroke_opacity if ink.stroke else 0),
            ink.width * place.scale * self._points,
            (0, tuple(dash / ink.width for dash in ink.dashes)) if ink.dashes else "solid",
        )
        whole = paths if isinstance(shape, Strokes) else [Outline.make_compound_path(*paths)]
        self._outlines += [(path, *look) for path in whole]

    def sphere(self, circle: Circle, gradient: Gradient, place: Place) -> None:
        """Paint a sphere as discs within one another, or as an image that is cut out."""
        if all(stop.opacity == 1 for stop in gradient.stops):
            self._discs(circle, gradient, place)
            return
        from matplotlib.patches import Circle as Clip

        (x, y), radius = _placed((circle.x, circle.y), place), circle.radius * place.scale
        down, across = (np.mgrid[:PIXELS, :PIXELS] + 0.5) / PIXELS
        image = self._ax.imshow(
            np.dstack(gradient_at(gradient, across, down)),
            extent=(x - radius, x + radius, y - radius, y + radius),
            zorder=self._next(),
            interpolation="bilinear",
            aspect="equal",
        )
        image.set_clip_path(Clip((x, y), radius, transform=self._ax.transData))

    def _discs(self, circle: Circle, gradient: Gradient, place: Place) -> None:
        """Discs from the rim of a sphere to where it is brightest."""
        aside, down = 2 * circle.radius * (gradient.x - 0.5), 2 * circle.radius * (gradient.y - 0.5)
        for share in np.linspace(1, 0, RINGS, endpoint=False).tolist():
            tone = gradient_at(gradient, np.array(gradient.x + share * gradient.radius), np.array(gradient.y))[0]
            disc = Circle(circle.x + (1 - share) * aside, circle.y + (1 - share) * down, share * circle.radius)
            self.outline(disc, Ink(f"#{bytes(tone).hex()}", "", 0, True, (), 1, 1, False), place)

    def text(self, text: Lettering, place: Place) -> None:
        """Write a text, stretch by stretch."""
        from matplotlib.patheffects import Normal, Stroke

        layer, unit = self._next(), place.scale * self._points
        halo = [Stroke(linewidth=text.halo_width * unit, foreground=text.halo), Normal()]
        for run in text.runs:
            x, y = _placed((run.x, run.y), place)
            self._ax.text(
                x,
                y,
                run.text,
                fontsize=run.size * unit,
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
    """Points with y upwards."""
    found: Floats = (np.asarray(points, float) * place.scale + (place.x, place.y)) * (1, -1)
    return found
