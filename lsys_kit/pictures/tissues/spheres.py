"""Maps on a sphere as pictures: the steps of a development side by side, each a shaded sphere.

Cells of one colour have the same walls around them. Walls are arcs of great circles; what lies behind is not seen.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING

from lsys_kit.arrays import np
from lsys_kit.budget import Task, counted
from lsys_kit.derivation.tissues.development import Development
from lsys_kit.derivation.tissues.maps import Map, kinds_of_cells
from lsys_kit.geometry.scene import Floats
from lsys_kit.geometry.tissues.layout import Placed, arc, meridian, place_on_sphere
from lsys_kit.notation.model.cells import MapSystem
from lsys_kit.pictures.formats.notebook import described
from lsys_kit.pictures.formats.painting import painted
from lsys_kit.pictures.rendering.frames import MARGIN
from lsys_kit.pictures.rendering.view import View, axes, view_from
from lsys_kit.pictures.shapes import Circle, Drawing, Gradient, Gradients, Look, Path, Shape, Stop
from lsys_kit.pictures.sizes import document, resized
from lsys_kit.pictures.style.themes import theme
from lsys_kit.pictures.tissues.chosen import developed, forces_of
from lsys_kit.pictures.tissues.maps import CAPTION, GAP, MOST_MAPS, NUMBER, WIDTH, MapPicture, caption, cell_colour

if TYPE_CHECKING:
    from PIL.Image import Image

SIDE = 20, 25
"""From where spheres are seen, in degrees: somewhat from the right, and from above."""
LARGEST = 120.0
"""The greatest radius of a sphere, in pixels."""
STRAIGHT = math.radians(6)
"""Arcs are drawn as straight pieces that turn by this angle at most."""
SLIVER = 0.1
"""Twice the area that an outline along the rim may enclose, because it is made of straight pieces."""
_STOPS = Stop(0, "#FFFFFF", 0.5), Stop(0.5, "#FFFFFF", 0), Stop(0.55, "#000000", 0), Stop(1, "#000000", 0.45)
_SHADE = Gradient("lsys-sphere", 0.38, 0.32, 0.72, _STOPS)


@dataclass(frozen=True)
class SphereView:
    """A map on a sphere as it is seen: for each of its walls some points, to the right, up and towards the viewer."""

    arcs: Sequence[Floats]
    kinds: Sequence[int]


@dataclass(frozen=True, repr=False, eq=False)
class SpherePicture(MapPicture):
    """A picture of the steps of a map on a sphere, side by side.

    Attributes
    ----------
    views
        The maps as they are seen.
    """

    views: Sequence[SphereView] = ()

    def _shown(self, most: int, enlarged: float) -> Drawing:
        """The spheres side by side."""
        return self._side_by_side(range(len(self.views)))

    def film_images(self) -> Sequence[Image]:
        """The spheres one after another."""
        with Task("The film was not finished"):
            return [painted(resized(self._side_by_side([place]), self.pixels)) for place in range(len(self.views))]

    def _side_by_side(self, places: Sequence[int]) -> Drawing:
        many = len(places)
        radius = min(LARGEST, (WIDTH - 2 * MARGIN - GAP * (many - 1)) / (2 * many))
        spheres = [
            _sphere(
                self.maps[place],
                self.views[place],
                MARGIN + radius + number * (2 * radius + GAP),
                MARGIN + radius,
                radius,
                self.numbers[place],
            )
            for number, place in enumerate(places)
        ]
        width = math.ceil(2 * MARGIN + many * 2 * radius + (many - 1) * GAP)
        height = math.ceil(2 * MARGIN + 2 * radius + CAPTION)
        words = described([self.text, "cells of one colour have the same walls around them"])
        return document([Gradients([_SHADE]), *chain(*spheres)], width, height, words)


def sphere_picture(
    what: MapSystem | Development, n: int | None = None, *, view: object = SIDE, **forces: object
) -> SpherePicture:
    """The picture of a map system on a sphere after `n` steps, or of a development."""
    maps: Development = developed(what, n)
    chosen, side = forces_of(forces, "map on a sphere"), view_from(view)
    return spheres_at(maps, [*place_on_sphere(maps, chosen)], range(max(0, len(maps) - MOST_MAPS), len(maps)), side)


def spheres_at(maps: Sequence[Map], placed: Sequence[Placed], steps: Sequence[int], view: View) -> SpherePicture:
    """The picture of some steps, given the maps of all steps and where each lies on the sphere."""
    side, kinds = np.column_stack(axes(*map(math.radians, view))), [*kinds_of_cells(maps)]
    views = [SphereView([each @ side for each in wall_arcs(maps[step], *placed[step])], kinds[step]) for step in steps]
    return SpherePicture([maps[step] for step in steps], [placed[step][0] for step in steps], (), steps, views=views)


def wall_arcs(found: Map, points: Floats, longitudes: Mapping[int, float]) -> Iterator[Floats]:
    """Points along each wall, from its beginning to its end."""
    for number, wall in enumerate(counted(found.walls)):
        if number in longitudes:
            shares = _shares(math.pi)
            yield meridian(longitudes[number], shares if wall.start == 0 else 1 - shares)
        else:
            start, end = points[wall.start], points[wall.end]
            yield arc(start, end, _shares(float(np.linalg.norm(end - start))))


def _shares(angle: float) -> Floats:
    """The shares of the way at which the straight pieces of an arc end."""
    return np.linspace(0, 1, 2 + math.ceil(angle / STRAIGHT))


def _around_cells(found: Map, view: SphereView) -> Iterator[tuple[Floats, int]]:
    """The points around each cell of which something is seen, and its kind."""
    for cell, kind in zip(found.cells, view.kinds, strict=True):
        around = np.concatenate([view.arcs[wall][:-1] if forward else view.arcs[wall][:0:-1] for wall, forward in cell])
        if (around[:, 2] > 0).any():
            yield around, kind


def _sphere(found: Map, view: SphereView, x: float, y: float, radius: float, step: int) -> list[Shape]:
    """A sphere: its cells, its walls, its shade, and the number of the step below."""
    shapes: list[Shape] = []
    for around, kind in _around_cells(found, view):
        outline = "".join(_closed(row, x, y, radius) for row in _seen_outlines(around))
        shapes.append(Path(outline, Look(fill=cell_colour(kind), fill_rule="evenodd")))
    walls = "".join(_visible(each, x, y, radius) for each in view.arcs)
    circle, rim = (round(10 * x), round(10 * y), round(10 * radius)), Look(fill="none", stroke=theme().ink, stroke_width=14)
    return [
        *shapes,
        Circle(*circle, Look(fill=_SHADE)),
        Path(walls, rim | Look(stroke_linecap="round", stroke_linejoin="round")),
        Circle(*circle, rim),
        caption(str(step), circle[0], round(10 * (y + radius + NUMBER + 8))),
    ]


def _seen_outlines(around: Floats) -> list[Floats]:
    """The outline of what is seen of a cell; with that of the whole sphere, if the cell lies all around what is not it.

    Cells run clockwise, as seen from outside. A cell whose outline does not, after what is hidden has moved to the rim, has the
    point in it that is farthest from the viewer.
    """
    front = _to_the_front(around)
    (x, y), (beyond, above) = front.T, np.roll(front, -1, axis=0).T
    if (x * above - beyond * y).sum() < SLIVER:
        return [front]
    rim = 2 * math.pi * _shares(2 * math.pi)
    return [front, np.column_stack([np.cos(rim), np.sin(rim)])]


def _closed(points: Floats, x: float, y: float, radius: float) -> str:
    """An outline as part of a path."""
    return f"M{'L'.join(map('{} {}'.format, *_pixels(points, x, y, radius)))}Z"


def _to_the_front(points: Floats) -> Floats:
    """An outline whose hidden parts run along the rim of the sphere, with as many points there as an arc needs."""
    hidden, angles = points[:, 2] < 0, np.arctan2(points[:, 1], points[:, 0])
    rows = []
    for here, there in zip(range(-1, len(points) - 1), range(len(points)), strict=True):
        if hidden[here] and hidden[there]:
            turn = (angles[there] - angles[here] + math.pi) % (2 * math.pi) - math.pi
            between = angles[here] + turn * _shares(abs(turn))[1:]
            rows.append(np.column_stack([np.cos(between), np.sin(between)]))
        else:
            rows.append(points[there : there + 1, :2] / (np.linalg.norm(points[there, :2]) if hidden[there] else 1.0))
    return np.concatenate(rows)


def _visible(points: Floats, x: float, y: float, radius: float) -> str:
    """The part of a wall that is seen, as pieces of a path."""
    seen = points[:, 2] >= 0
    places = list(zip(*_pixels(points[:, :2], x, y, radius), strict=True))
    return "".join(
        f"M{places[at][0]} {places[at][1]}L{places[at + 1][0]} {places[at + 1][1]}"
        for at in range(len(points) - 1)
        if seen[at] and seen[at + 1]
    )


def _pixels(points: Floats, x: float, y: float, radius: float) -> tuple[list[int], list[int]]:
    """Points in tenths of a pixel."""
    across, down = np.floor(10 * (points * (radius, -radius) + (x, y)) + 0.5001).astype(np.int64).T.tolist()
    return across, down
