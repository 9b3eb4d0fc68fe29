"""Maps as pictures: the steps of a development side by side, with a common scale, as in The Algorithmic Beauty of Plants,
chapter 7, and W. Kurth's lecture slides on L-systems.

Walls have their labels, and arrows where they have a direction. Cells of one colour have the same walls around them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from lsys_kit.budget import Task, current
from lsys_kit.derivation.tissues.development import Development
from lsys_kit.derivation.tissues.maps import Map
from lsys_kit.errors import ModelLimitError, ModelValueError, require, shown, whole_number
from lsys_kit.geometry.scene import Floats, Polygons, Scene
from lsys_kit.geometry.tissues.layout import equilibria, relaxation_steps, scenes
from lsys_kit.notation.model.cells import MapSystem
from lsys_kit.pictures.formats.notebook import SVGPicture, described
from lsys_kit.pictures.formats.painting import painted
from lsys_kit.pictures.rendering.frames import MARGIN, ViewFrame
from lsys_kit.pictures.shapes import Drawing, Group, Look, Path, Polygon, Shape, Text
from lsys_kit.pictures.sizes import document, resized
from lsys_kit.pictures.style.labels import label_spans
from lsys_kit.pictures.style.palette import PALEST, SERIES, STRONGEST, tinted
from lsys_kit.pictures.style.themes import theme
from lsys_kit.pictures.tissues.chosen import counts_text, developed, forces_of

if TYPE_CHECKING:
    from PIL.Image import Image

WIDTH, HIGHEST = 760, 400
"""The greatest width of a line of maps and height of a map, in pixels."""
LARGE, MIDDLE, SMALL = 180.0, 130.0, 95.0
"""Pixels per unit: for few maps; for maps in several lines; the least for maps in one line."""
SEEN = 150.0
"""The least height of the highest of a few maps, in pixels."""
GAP, CAPTION, NUMBER = 22, 34, 14
"""The space between two maps, that below one, and the size of the number of its step there, in pixels."""
MOST_MAPS = 12
"""The greatest number of maps in a picture, which shows the last ones."""
LABEL, LEAST_LABELLED, LEAST_POINTED = 13.0, 24.0, 13.0
"""The size of a label; the least lengths of walls with a label and with an arrow, in pixels."""
FILLS = tuple((colour, strength) for strength in (PALEST, STRONGEST) for colour in SERIES)
"""The colours of the first kinds of cells, and how strong they are."""
REST = 0.13
"""How strong the grey of all further kinds of cells is."""
ROUNDING = 1e-6
"""Rounding errors up to this, in pixels, do not enlarge a picture."""


@dataclass(frozen=True, eq=False)
class MapPicture(SVGPicture):
    """A picture of the steps of a map system, side by side; or of one step while its cells come to rest.

    Attributes
    ----------
    maps, places, scenes
        The maps that are shown, the positions of their vertices, and their walls and cells as scenes.
    numbers
        The numbers below them: steps, or iterations.
    step
        The step whose relaxation is shown, or None.
    unsettled
        The steps whose cells do not come to rest.
    labels
        Whether walls have their labels.
    """

    maps: Sequence[Map]
    places: Sequence[Floats]
    scenes: Sequence[Scene]
    numbers: Sequence[int]
    step: int | None = None
    unsettled: Sequence[int] = ()
    labels: bool = True

    @property
    def text(self) -> str:
        """What the picture shows, in words."""
        last = counts_text(self.maps[-1].counts)
        if self.step is not None:
            noun = "iteration" if [*self.numbers] == [1] else "iterations"
            return described([f"step {self.step} after {', '.join(f'{number:,}' for number in self.numbers)} {noun}", last])
        steps = f"steps {self.numbers[0]} to {self.numbers[-1]}" if len(self.numbers) > 1 else ""
        return described([steps, ("the last: " if steps else "") + last, _unsettled_text(self.unsettled)])

    def _shown(self, most: int, enlarged: float) -> Drawing:
        """The maps side by side."""
        panels = arranged(self.scenes)
        shown = zip(self.maps, self.places, self.scenes, panels, self.numbers, strict=True)
        body = [shape for each in shown for shape in panel_shapes(*each, self.labels)]
        return document(body, panels[0].frame.width, panels[0].frame.height, described([self.text, self._colours]))

    def film_images(self) -> Sequence[Image]:
        """The maps one after another, on one scale, each in the middle."""
        scale = min(
            _large(self.scenes), *(min((WIDTH - 2 * MARGIN) / scene.width, HIGHEST / scene.height) for scene in self.scenes)
        )
        wide, high = (max(sides) * scale for sides in zip(*((scene.width, scene.height) for scene in self.scenes), strict=True))
        size = math.ceil(wide - ROUNDING) + 2 * MARGIN, math.ceil(high + CAPTION - ROUNDING) + 2 * MARGIN
        with Task("The film was not finished"):
            return [self._one(place, scale, wide, high, size) for place in range(len(self.maps))]

    def _one(self, place: int, scale: float, wide: float, high: float, size: tuple[int, int]) -> Image:
        """One map by itself, in the middle of some room."""
        scene = self.scenes[place]
        left, _, _, top = scene.box
        corner = left - (wide / scale - scene.width) / 2, top + (high / scale - scene.height) / 2
        panel = Panel(ViewFrame(scale, *corner, *size), 5 * size[0], round(10 * (MARGIN + high + NUMBER + 3)))
        body = panel_shapes(self.maps[place], self.places[place], scene, panel, self.numbers[place], self.labels)
        return painted(resized(document(body, *size, self.text), self.pixels))

    @property
    def _colours(self) -> str:
        """What the colours mean, in words."""
        kinds = 1 + max(int(scene.polygons.states.max()) for scene in self.scenes)
        if kinds == 1:
            return "all cells have the same walls around them"
        return "cells of one colour have the same walls around them" + ", but for grey ones" * (kinds > len(FILLS))

    def __repr__(self) -> str:
        return self.text


def _unsettled_text(steps: Sequence[int]) -> str:
    """What is said of steps whose cells do not come to rest."""
    if not steps:
        return ""
    some = ", ".join(map(str, steps))
    return f"step {some} does not settle" if len(steps) == 1 else f"steps {some} do not settle"


def map_picture(
    what: MapSystem | Development, n: int | None = None, iterations: Sequence[int] = (), labels: bool = True, **forces: object
) -> MapPicture:
    """The picture of a map system after `n` steps, or of a development; or of the relaxation of its last step."""
    maps: Development = developed(what, n)
    require(iterations, Sequence, "A list of iterations")
    if iterations:
        iterations = _checked_iterations(iterations)
        shown: Sequence[Map] = [maps[-1]] * len(iterations)
        check_walls(shown)
        places = [*relaxation_steps(maps, iterations, forces_of(forces))]
        return MapPicture(shown, places, [*scenes(shown, places)], iterations, maps.steps, labels=labels)
    first = max(0, len(maps) - MOST_MAPS)
    check_walls(maps[first:])
    reached = [*equilibria(maps, forces_of(forces))]
    places = [each.points for each in reached]
    unsettled = [step for step, each in enumerate(reached) if not each.settled and step >= first]
    return MapPicture(
        maps[first:], places[first:], [*scenes(maps, places)][first:], range(first, len(maps)), None, unsettled, labels
    )


def _checked_iterations(given: Sequence[int]) -> list[int]:
    """Iterations are counted from 0, and grow."""
    if len(given) > MOST_MAPS:
        raise ModelValueError(f"A picture shows {MOST_MAPS} iterations at most, not {len(given)}")
    try:
        iterations = [whole_number(each, "An iteration") for each in given]
    except ModelValueError:
        iterations = []
    if not iterations or iterations != sorted({*iterations}):
        raise ModelValueError(f"Iterations are whole numbers from 0 on, each greater than the one before, not {shown(given)}")
    return iterations


def check_walls(maps: Sequence[Map]) -> None:
    """A picture can have as many walls as some maps."""
    walls = sum(len(found.walls) for found in maps)
    if walls > current().segments:
        raise ModelLimitError(
            f"The picture would have {walls:,} walls; the limit is {current().segments:,}",
            limit=current().segments,
            needed=walls,
            hint="Take fewer steps, or set limits(segments=...).",
        )


class Panel(NamedTuple):
    """The frame of a map in the picture, and the position of its number below, in tenths of a pixel."""

    frame: ViewFrame
    x: int
    y: int


def arranged(some: Sequence[Scene]) -> list[Panel]:
    """The panel of each map: in centred lines, with a common scale."""
    scale = _common_scale(some)
    lines = [*_maps_by_line(some, scale)]
    widths = [math.fsum(scene.width * scale + GAP for scene in line) - GAP for line in lines]
    heights = [max(scene.height for scene in line) * scale for line in lines]
    lowest = math.fsum(heights) + len(lines) * CAPTION
    size = math.ceil(max(widths) - ROUNDING) + 2 * MARGIN, math.ceil(lowest - ROUNDING) + 2 * MARGIN
    panels: list[Panel] = []
    top = 0.0
    for line, width, height in zip(lines, widths, heights, strict=True):
        across = (max(widths) - width) / 2
        for scene in line:
            (left, _, _, highest), own = scene.box, scene.width * scale
            drop = top + (height - scene.height * scale) / 2
            panels.append(
                Panel(
                    ViewFrame(scale, left - across / scale, highest + drop / scale, *size),
                    round((MARGIN + across + own / 2) * 10),
                    round((MARGIN + top + height + NUMBER + 3) * 10),
                )
            )
            across += own + GAP
        top += height + CAPTION
    return panels


def _common_scale(some: Sequence[Scene]) -> float:
    """Pixels per unit: such that all maps fit into one line, if they are large enough then."""
    in_line = (WIDTH - 2 * MARGIN - GAP * (len(some) - 1)) / math.fsum(scene.width for scene in some)
    return min(
        min(_large(some), in_line) if in_line >= SMALL else MIDDLE,
        *((WIDTH - 2 * MARGIN) / scene.width for scene in some),
        *(HIGHEST / scene.height for scene in some),
    )


def _large(some: Sequence[Scene]) -> float:
    """Pixels per unit for a few maps."""
    return max(LARGE, SEEN / max(scene.height for scene in some))


def _maps_by_line(some: Sequence[Scene], scale: float) -> Iterator[list[Scene]]:
    """The maps of each line."""
    line: list[Scene] = []
    across = 0.0
    for scene in some:
        width = scene.width * scale
        if line and across + width > WIDTH - 2 * MARGIN + 1e-6:
            yield line
            line, across = [], 0.0
        line.append(scene)
        across += width + GAP
    yield line


def panel_shapes(found: Map, places: Floats, scene: Scene, panel: Panel, number: int, labels: bool = True) -> list[Shape]:
    """One map: its cells, its walls, their arrows and labels, and the number of the step below."""
    walls = wall_shapes(found, places, panel.frame, labels)
    return [*cell_shapes(scene.polygons, panel.frame), *walls, caption(str(number), panel.x, panel.y)]


def caption(text: str, x: int, y: int) -> Text:
    """What stands below a map."""
    look = Look(font_size=NUMBER * 10, text_anchor="middle", font_family="sans-serif", fill=theme().quiet)
    return Text(x, y, text, look)


def cell_shapes(cells: Polygons, frame: ViewFrame) -> list[Polygon]:
    """The cells, filled: a soft colour for each of the first kinds."""
    kinds = cells.states.tolist()
    return [
        Polygon(frame.points(corners).tolist(), Look(fill=cell_colour(kind)))
        for corners, kind in zip(cells, kinds, strict=True)
    ]


def cell_colour(kind: int) -> str:
    """The colour of the cells of a kind."""
    return tinted(*FILLS[kind]) if kind < len(FILLS) else tinted(theme().quiet, REST)


def wall_shapes(found: Map, places: Floats, frame: ViewFrame, labelled: bool = True) -> list[Shape]:
    """The walls as one path, their arrows as another, then their labels, if they have any."""
    points = frame.points(places).tolist()
    strokes, arrows, labels = [], [], []
    for wall in found.walls:
        (x, y), (to_x, to_y) = points[wall.start], points[wall.end]
        length = math.hypot(to_x - x, to_y - y)
        strokes.append(f"M{x} {y}L{to_x} {to_y}")
        if wall.directed and length > LEAST_POINTED * 10:
            arrows.append(_wall_arrow(x, y, to_x, to_y, length))
        if labelled and length > LEAST_LABELLED * 10:
            labels.append(wall_label(wall.label, (x + to_x) // 2, (y + to_y) // 2))
    look = Look(fill="none", stroke=theme().ink, stroke_width=16, stroke_linecap="round")
    return [Path("".join(strokes), look), Path("".join(arrows), Look(fill=theme().ink)), lettered(labels)]


def lettered(labels: Sequence[Text]) -> Group:
    """The letters of walls."""
    look = Look(
        font_family="Georgia,serif",
        font_size=round(LABEL * 10),
        text_anchor="middle",
        fill=theme().ink,
        stroke=theme().paper,
        stroke_width=40,
        stroke_linejoin="round",
        paint_order="stroke",
    )
    return Group(labels, look)


def _wall_arrow(x: int, y: int, to_x: int, to_y: int, length: float) -> str:
    """An arrowhead along a wall, beyond its middle."""
    along, across = (to_x - x) / length, (to_y - y) / length
    reach = min(70.0, 0.25 * length)
    tip = 0.76 * length + reach / 2
    corners = ((tip, 0.0), (tip - reach, reach * 0.42), (tip - reach, -reach * 0.42))
    at = (f"{x + ahead * along - aside * across:.0f} {y + ahead * across + aside * along:.0f}" for ahead, aside in corners)
    return f"M{'L'.join(at)}Z"


def wall_label(label: str, x: int, y: int, arrow: str = "") -> Text:
    """The letter of a wall, with its number as an index, in the middle of a place; behind that of a marker its arrow."""
    letter, number = re.fullmatch(r"(\D)(\d*)", label).groups()  # type: ignore[union-attr]
    return Text(x, y + round(3.4 * LABEL), label_spans(letter, number, arrow))
