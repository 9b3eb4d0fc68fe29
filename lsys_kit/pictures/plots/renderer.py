"""A renderer of matplotlib that writes the kit's SVG.

Matplotlib lays a plot out and says what to draw; its own SVG differs between versions and machines in dates, ids, digits and
the shapes of letters. Here coordinates are whole tenths of a pixel and text stays text, so that a picture is the same
everywhere.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from matplotlib.backend_bases import RendererBase
from matplotlib.colors import to_hex
from matplotlib.path import Path
from matplotlib.transforms import Affine2D

from lsys_kit.pictures.plots.lettering import spans, width

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ASCENT, DESCENT = 0.76, 0.24
"""How far letters reach above the baseline and below it, to the size of the text."""
NUDGE = 1e-5
"""Added before a coordinate is rounded: one half way between two tenths, but for the last digit, is always rounded up."""
_HELD = {"left": "", "center": ' text-anchor="middle"', "right": ' text-anchor="end"'}
_BELOW = {"baseline": 0.0, "bottom": -DESCENT, "center": (ASCENT - DESCENT) / 2, "center_baseline": ASCENT / 2, "top": ASCENT}
"""How far the baseline lies below the point by which a text is aligned, to its size."""
_COMMANDS = {Path.MOVETO: "M", Path.LINETO: "L", Path.CURVE3: "Q", Path.CURVE4: "C", Path.CLOSEPOLY: "Z"}


class SVGRenderer(RendererBase):
    """A renderer that collects elements of SVG for a picture of so many pixels; lengths are tenths of a pixel, which is a point
    of matplotlib's."""

    def __init__(self, width: int, height: int) -> None:
        super().__init__()
        self.width, self.height, self.elements = width, height, [""]
        self._down = Affine2D().scale(10, -10).translate(0, 10 * height)

    def flipy(self) -> bool:
        """Whether y grows downwards, as in SVG."""
        return True

    def get_canvas_width_height(self) -> tuple[float, float]:
        """The size of the picture."""
        return self.width, self.height

    def points_to_pixels(self, points: Any) -> Any:
        """A point is a pixel."""
        return points

    def get_text_width_height_descent(self, s: str, prop: Any, ismath: Any) -> tuple[float, float, float]:
        """The extent of a label."""
        size = prop.get_size_in_points()
        return width(_label(s, ismath), size), (ASCENT + DESCENT) * size, DESCENT * size

    def draw_path(self, gc: Any, path: Path, transform: Any, rgbFace: Any = None) -> None:  # noqa: N803
        """Draw a path, filled or not."""
        written = _path_data(path, transform + self._down)
        stroke = _stroke(gc)
        if stroke or rgbFace is not None:
            fill = "none" if rgbFace is None else to_hex(rgbFace)
            seen = "" if rgbFace is None or len(rgbFace) < 4 or rgbFace[3] == 1 else f' fill-opacity="{rgbFace[3]:.2g}"'
            self.elements.append(f'<path d="{written}" fill="{fill}"{seen}{stroke}/>')

    def draw_markers(self, gc: Any, marker_path: Path, marker_trans: Any, path: Path, trans: Any, rgbFace: Any = None) -> None:  # noqa: N803
        """Draw markers, all of which are dots: strokes without length and with round ends."""
        broad = marker_path.get_extents(marker_trans).width
        places = ((trans + self._down).transform(path.vertices) + NUDGE).round().astype(int).tolist()
        if broad and rgbFace is not None:
            dots = "".join(f"M{x} {y}h0" for x, y in places)
            faint = "" if rgbFace[3] == 1 else f' stroke-opacity="{rgbFace[3]:.2g}"'
            self.elements.append(
                f'<path d="{dots}" stroke="{to_hex(rgbFace)}" stroke-width="{10 * broad:.0f}" stroke-linecap="round"{faint}/>'
            )

    def draw_text(
        self, gc: Any, x: float, y: float, s: str, prop: Any, angle: float, ismath: Any = False, mtext: Any = None
    ) -> None:
        """Write a label at the point by which it is aligned: what surrounds a text differs a little between versions of
        matplotlib, and a page may have other letters."""
        size = prop.get_size_in_points()
        across, up = mtext.get_transform().transform(mtext.get_unitless_position())
        down = self.height - up + _BELOW[mtext.get_verticalalignment()] * size
        place = f'x="{round(10 * across + NUDGE)}" y="{round(10 * down + NUDGE)}"'
        self.elements.append(
            f'<text {place} font-size="{10 * size:.0f}" '
            f'fill="{to_hex(gc.get_rgb())}"{_HELD[mtext.get_horizontalalignment()]}>'
            f"{spans(_label(s, ismath), 10 * size)}</text>"
        )


def svg_elements(figure: Figure, width: int, height: int) -> str:
    """What a figure shows, as elements of SVG."""
    renderer = SVGRenderer(width, height)
    figure.draw(renderer)
    return f'<g font-family="sans-serif">{"".join(renderer.elements)}</g>'


def _label(text: str, mathematical: object) -> str:
    """A text as a label has it: matplotlib has unmasked the signs of one without mathematics."""
    return text if mathematical else text.replace("$", "\\$")


def _path_data(path: Path, transform: Any) -> str:
    return "".join(
        _COMMANDS[code] + ("" if code == Path.CLOSEPOLY else _numbers(corners))
        for corners, code in path.iter_segments(transform, simplify=False)
    )


def _numbers(corners: Any) -> str:
    return " ".join(map(str, (corners + NUDGE).round().astype(int).tolist()))


def _stroke(gc: Any) -> str:
    """The attributes of a stroke; nothing where it is not seen."""
    colour, broad = gc.get_rgb(), gc.get_linewidth()
    if not broad or colour[3] == 0:
        return ""
    _, dashes = gc.get_dashes()
    broken = f' stroke-dasharray="{" ".join(f"{10 * each:.0f}" for each in dashes)}"' if dashes is not None else ""
    faint = "" if colour[3] == 1 else f' stroke-opacity="{colour[3]:.2g}"'
    return (
        f' stroke="{to_hex(colour)}" stroke-width="{10 * broad:.0f}" stroke-linecap="round" stroke-linejoin="round"'
        f"{faint}{broken}"
    )
