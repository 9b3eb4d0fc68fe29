"""Maps on a sphere as PNG and PDF."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from lsys_kit.files import KIT_MARK
from lsys_kit.geometry.scene import Floats
from lsys_kit.pictures.sizes import Size, enlargement
from lsys_kit.pictures.style.palette import INK, QUIET

if TYPE_CHECKING:
    from matplotlib.axes import Axes

APART, BELOW = 2.2, -1.18
"""The distance of two spheres of radius 1, and how far below its middle the number of a step stands."""
INCHES, DOTS = 1.25, 192
"""The radius of a sphere on paper, where there are few; and the dots of an inch."""
WIDEST = 8.0
"""The greatest width of a picture, in inches."""
LIGHT, REACH = (-0.24, 0.36), 1.44
"""From where the shade grows darker, and how far it reaches."""
SHADE = ((0.0, 0.5), (0.5, 0.0), (0.55, 0.0), (1.0, -0.45))
"""At which share of that way how much is mixed with white, or with black where it is negative."""
GRID = 400
"""The shade has so many pixels on each side."""


class SphereShapes(NamedTuple):
    """A sphere of radius 1 as it is seen: for each cell its outlines and its colour, pieces of walls, and the step."""

    cells: Sequence[tuple[Sequence[Floats], str]]
    walls: Sequence[Floats]
    step: int


def spheres_file(spheres: Sequence[SphereShapes], title: str, kind: str, size: Size | None = None) -> bytes:
    """The bytes of a "png" or "pdf" picture of spheres side by side."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    radius = min(INCHES, WIDEST / (APART * len(spheres)))
    sheet = Figure(figsize=(radius * APART * len(spheres), radius * 2.5))
    ax = sheet.add_axes((0.0, 0.0, 1.0, 1.0))
    for place, each in enumerate(spheres):
        _paint(ax, each, APART * place, radius)
    ax.set(xlim=(-APART / 2, APART * (len(spheres) - 0.5)), ylim=(-1.4, 1.1), aspect="equal")
    ax.set_axis_off()
    dots = DOTS if size is None else enlargement(float(sheet.get_figwidth()), float(sheet.get_figheight()), size)
    buffer = io.BytesIO()
    facts = {"CreationDate": None, "Title": title, "Creator": KIT_MARK.decode()} if kind == "pdf" else {"Title": title}
    with rc_context({"pdf.fonttype": 42}):
        sheet.savefig(buffer, format=kind, dpi=dots, metadata=facts)
    return buffer.getvalue()


def _paint(ax: Axes, sphere: SphereShapes, x: float, radius: float) -> None:
    """A sphere with its middle at x: its cells, its shade, its walls, and the number of the step below."""
    from matplotlib.collections import LineCollection
    from matplotlib.patches import Circle, PathPatch
    from matplotlib.path import Path

    middle = np.array([x, 0.0])
    for outlines, colour in sphere.cells:
        rows = [Path(np.vstack([row, row[:1]]) + middle, closed=True) for row in outlines]
        ax.add_patch(PathPatch(Path.make_compound_path(*rows), facecolor=colour, edgecolor="none"))
    shade = ax.imshow(_shade(), extent=(x - 1, x + 1, -1, 1), origin="lower", interpolation="bilinear", zorder=2)
    shade.set_clip_path(Circle((x, 0), 1, transform=ax.transData))
    width = radius / INCHES * 1.1
    ax.add_collection(LineCollection([row + middle for row in sphere.walls], colors=INK, linewidths=width, capstyle="round",
                                     zorder=3))
    ax.add_patch(Circle((x, 0), 1, facecolor="none", edgecolor=INK, linewidth=width, zorder=3))
    ax.text(x, BELOW, str(sphere.step), ha="center", va="center", color=QUIET, fontsize=10)


def _shade() -> Floats:
    """White and black over a sphere, each pixel with its opacity."""
    across, up = np.meshgrid(*[np.linspace(-1, 1, GRID)] * 2)
    way = np.hypot(across - LIGHT[0], up - LIGHT[1]) / REACH
    mixed = np.interp(way, [share for share, _ in SHADE], [amount for _, amount in SHADE])
    white = (mixed > 0).astype(np.float64)
    return np.stack([white, white, white, np.abs(mixed)], axis=2)
