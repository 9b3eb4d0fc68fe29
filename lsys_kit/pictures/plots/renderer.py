"""A renderer of matplotlib that makes the kit's shapes.

Matplotlib lays a plot out and says what to draw; its own SVG differs between versions and machines in dates, ids, digits and
the shapes of letters. Here coordinates are whole tenths of a pixel and text stays text, so that a picture is the same
everywhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backend_bases import GraphicsContextBase, RendererBase
from matplotlib.colors import to_hex
from matplotlib.path import Path as Outline
from matplotlib.transforms import Affine2D

from lsys_kit.pictures.plots.lettering import spans, width
from lsys_kit.pictures.shapes import Group, Look, Path, Shape, Text

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from matplotlib.font_manager import FontProperties
    from matplotlib.transforms import Transform
    from numpy.typing import ArrayLike, NDArray

ASCENT, DESCENT = 0.76, 0.24
"""How far letters reach above the baseline and below it, to the size of the text."""
NUDGE = 1e-5
"""Added before a coordinate is rounded: one half way between two tenths, but for the last digit, is always rounded up."""
_HELD = {"left": Look(), "center": Look(text_anchor="middle"), "right": Look(text_anchor="end")}
_BELOW = {"baseline": 0.0, "bottom": -DESCENT, "center": (ASCENT - DESCENT) / 2, "center_baseline": ASCENT / 2, "top": ASCENT}
"""How far the baseline lies below the point by which a text is aligned, to its size."""
_COMMANDS = {Outline.MOVETO: "M", Outline.LINETO: "L", Outline.CURVE3: "Q", Outline.CURVE4: "C", Outline.CLOSEPOLY: "Z"}


class ShapesRenderer(RendererBase):
    """A renderer that collects shapes; lengths are tenths of a pixel, which is a point of matplotlib's.

    Parameters
    ----------
    width, height
        The size of the picture in pixels.
    """

    def __init__(self, width: int, height: int) -> None:
        super().__init__()
        self.width, self.height, self.shapes = width, height, list[Shape]()
        self._down = Affine2D().scale(10, -10).translate(0, 10 * height)

    def flipy(self) -> bool:
        """Whether y grows downwards, as in SVG."""
        return True

    def get_canvas_width_height(self) -> tuple[float, float]:
        """The size of the picture."""
        return self.width, self.height

    def points_to_pixels(self, points: ArrayLike) -> ArrayLike:
        """A point is a pixel."""
        return points

    def get_text_width_height_descent(self, s: str, prop: FontProperties, ismath: bool | str) -> tuple[float, float, float]:
        """The extent of a label."""
        size = prop.get_size_in_points()
        return width(_label(s, ismath), size), (ASCENT + DESCENT) * size, DESCENT * size

    def draw_path(self, gc: GraphicsContextBase, path: Outline, transform: Transform, rgbFace: Any = None) -> None:  # noqa: N803
        """Draw a path, filled or not."""
        stroke = _stroke(gc)
        if stroke or rgbFace is not None:
            look = Look(fill="none" if rgbFace is None else to_hex(rgbFace))
            if rgbFace is not None and len(rgbFace) == 4 and rgbFace[3] != 1:
                look["fill_opacity"] = float(f"{rgbFace[3]:.2g}")
            self.shapes.append(Path(_path_data(path, transform + self._down), look | stroke))

    def draw_markers(
        self,
        gc: GraphicsContextBase,
        marker_path: Outline,
        marker_trans: Transform,
        path: Outline,
        trans: Transform,
        rgbFace: Any = None,  # noqa: N803
    ) -> None:
        """Draw markers, all of which are dots: strokes without length and with round ends."""
        broad = marker_path.get_extents(marker_trans).width
        centres = (trans + self._down).transform(path.vertices)
        places = (centres[np.isfinite(centres).all(axis=1)] + NUDGE).round().astype(int).tolist()
        if broad and rgbFace is not None:
            dots = "".join(f"M{x} {y}h0" for x, y in places)
            look = Look(stroke=to_hex(rgbFace), stroke_width=round(10 * broad), stroke_linecap="round")
            self.shapes.append(Path(dots, look | _faint(rgbFace)))

    def draw_text(
        self,
        gc: GraphicsContextBase,
        x: float,
        y: float,
        s: str,
        prop: FontProperties,
        angle: float,
        ismath: bool | str = False,
        mtext: Any = None,
    ) -> None:
        """Write a label at the point by which it is aligned: what surrounds a text differs a little between versions of
        matplotlib, and a page may have other letters."""
        size = prop.get_size_in_points()
        across, up = mtext.get_transform().transform(mtext.get_unitless_position())
        down = self.height - up + _BELOW[mtext.get_verticalalignment()] * size
        look = Look(font_size=round(10 * size), fill=to_hex(gc.get_rgb())) | _HELD[mtext.get_horizontalalignment()]
        place = round(10 * across + NUDGE), round(10 * down + NUDGE)
        self.shapes.append(Text(*place, spans(_label(s, ismath), 10 * size), look))


def shapes_of(figure: Figure, width: int, height: int) -> Group:
    """What a figure shows."""
    renderer = ShapesRenderer(width, height)
    figure.draw(renderer)
    return Group(renderer.shapes, Look(font_family="sans-serif"))


def _label(text: str, mathematical: object) -> str:
    """A text as a label has it: matplotlib has unmasked the signs of one without mathematics."""
    return text if mathematical else text.replace("$", "\\$")


def _path_data(path: Outline, transform: Transform) -> str:
    """A path as SVG writes it."""
    return "".join(
        _COMMANDS[code] + ("" if code == Outline.CLOSEPOLY else _numbers(corners))
        for corners, code in path.iter_segments(transform, simplify=False)
    )


def _numbers(corners: NDArray[np.float64]) -> str:
    return " ".join(map(str, (corners + NUDGE).round().astype(int).tolist()))


def _stroke(gc: Any) -> Look:
    """The look of a stroke; nothing where it is not seen."""
    colour, broad = gc.get_rgb(), gc.get_linewidth()
    if not broad or colour[3] == 0:
        return Look()
    _, dashes = gc.get_dashes()
    broken = Look() if dashes is None else Look(stroke_dasharray=" ".join(f"{10 * each:.0f}" for each in dashes))
    pen = Look(stroke=to_hex(colour), stroke_width=round(10 * broad), stroke_linecap="round", stroke_linejoin="round")
    return pen | _faint(colour) | broken


def _faint(colour: Sequence[float]) -> Look:
    return Look() if colour[3] == 1 else Look(stroke_opacity=float(f"{colour[3]:.2g}"))
