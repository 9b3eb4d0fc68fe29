"""One step of a map in its phases, on the cells of the map before, which stay where they are: the map as it was; its walls
replaced, with their markers; the markers that match, while the others vanish; and the cells divided.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from lsys_kit.arrays import np
from lsys_kit.budget import Task
from lsys_kit.derivation.tissues.development import Development
from lsys_kit.derivation.tissues.maps import Map, Stub, replaced_map
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.scene import Floats, Scene
from lsys_kit.geometry.tissues.layout import insert_vertices, place_maps, scenes
from lsys_kit.notation.model.cells import LEFT, MapSystem
from lsys_kit.pictures.formats.notebook import SVGPicture
from lsys_kit.pictures.formats.painting import painted
from lsys_kit.pictures.rendering.frames import MARGIN, ViewFrame
from lsys_kit.pictures.shapes import Drawing, Look, Path, Shape
from lsys_kit.pictures.sizes import document, resized
from lsys_kit.pictures.style.palette import BLUE
from lsys_kit.pictures.style.themes import line, theme
from lsys_kit.pictures.tissues.chosen import developed, forces_of
from lsys_kit.pictures.tissues.maps import (
    CAPTION,
    GAP,
    HIGHEST,
    NUMBER,
    WIDTH,
    caption,
    cell_shapes,
    check_walls,
    lettered,
    wall_label,
    wall_shapes,
)

if TYPE_CHECKING:
    from PIL.Image import Image

PHASES = 4
"""The pictures of a step."""
REACH, WRITTEN = 0.2, 0.32
"""How far a marker reaches from its wall, and where its letter stands, in lengths of the wall."""
STROKE, BROKEN = 24, "50 40"
"""The width of a marker, and the dashes of the wall to come, in tenths of a pixel."""


@dataclass(frozen=True, eq=False)
class PhasesPicture(SVGPicture):
    """The phases of a step side by side; as a film, one after another.

    Attributes
    ----------
    maps
        The map before the step, with its walls replaced, and after the step.
    stubs
        The markers.
    places
        The positions of the vertices.
    step
        The number of the step.
    labels
        Whether walls and markers have their labels.
    """

    maps: tuple[Map, Map, Map]
    stubs: Sequence[Stub]
    places: Floats
    step: int
    labels: bool = True

    @property
    def text(self) -> str:
        """What the picture shows, in words."""
        matched = sum(stub.partner is not None for stub in self.stubs)
        cells = "1 cell" if len(self.maps[2].cells) == 1 else f"{len(self.maps[2].cells):,} cells"
        return f"step {self.step} in {PHASES} pictures: {matched} of {len(self.stubs)} markers match; at the end {cells}"

    def _shown(self, most: int, enlarged: float) -> Drawing:
        """The phases side by side."""
        scale = min((WIDTH - 2 * MARGIN - (PHASES - 1) * GAP) / (PHASES * self._room[0]), HIGHEST / self._room[1])
        return self._drawn(range(PHASES), scale)

    def film_images(self) -> Sequence[Image]:
        """The phases one after another."""
        scale = min(WIDTH / 2 / self._room[0], HIGHEST / self._room[1])
        with Task("The film was not finished"):
            return [painted(resized(self._drawn([phase], scale), self.pixels)) for phase in range(PHASES)]

    @cached_property
    def _scenes(self) -> Sequence[Scene]:
        before = self.places[: len(self.maps[0].vertices)]
        return [*scenes(self.maps, (before, self.places, self.places))]

    @property
    def _room(self) -> tuple[float, float]:
        """The width and height of a map with its markers."""
        scene, more = self._scenes[0], 2 * self._beyond
        return scene.width + more, scene.height + more

    @property
    def _beyond(self) -> float:
        """How far markers and their letters reach beyond the map."""
        return max(((WRITTEN + REACH / 2) * math.hypot(*self._out(stub)) for stub in self.stubs), default=0.0)

    def _drawn(self, phases: Sequence[int], scale: float) -> Drawing:
        wide, high = self._room
        across = wide * scale + GAP
        size = math.ceil(across * len(phases) - GAP) + 2 * MARGIN, math.ceil(high * scale + CAPTION) + 2 * MARGIN
        left, _, _, top = self._scenes[0].box
        body: list[Shape] = []
        for place, phase in enumerate(phases):
            corner = left - self._beyond - place * across / scale, top + self._beyond
            middle = round(10 * (MARGIN + place * across + wide * scale / 2))
            body += self._phase(phase, ViewFrame(scale, *corner, *size))
            body.append(caption(self._names[phase], middle, round(10 * (MARGIN + high * scale + NUMBER + 3))))
        return document(body, *size, self.text)

    def __repr__(self) -> str:
        return self.text

    @property
    def _names(self) -> tuple[str, ...]:
        return f"step {self.step - 1}", "walls replaced", "markers matched", f"step {self.step}"

    def _phase(self, phase: int, frame: ViewFrame) -> list[Shape]:
        which = (0, 1, 1, 2)[phase]
        walls = wall_shapes(self.maps[which], self.places, frame, self.labels)
        markers = self._markers(frame, phase == PHASES - 2) if which == 1 else []
        return [*cell_shapes(self._scenes[which].polygons, frame), *walls, *markers]

    def _markers(self, frame: ViewFrame, matched: bool) -> list[Shape]:
        """The markers: all alike, or those that match with the walls to come, and the others pale."""
        lines, pale, broken, letters = list[str](), list[str](), list[str](), []
        for stub in self.stubs:
            here, out = self.places[stub.vertex], self._out(stub)
            placed = frame.points(np.array([here, here + REACH * out, here + WRITTEN * out]))
            (x, y), (to_x, to_y), (at_x, at_y) = placed.tolist()
            alone = matched and stub.partner is None
            (pale if alone else lines).append(f"M{x} {y}L{to_x} {to_y}")
            if matched and stub.partner is not None:
                broken.append("M{} {}L{} {}".format(x, y, *frame.points(self.places[stub.partner]).tolist()))
            if self.labels and not alone:
                letters.append(wall_label(stub.edge.label, at_x, at_y, stub.edge.arrow))
        return [
            Path("".join(broken), Look(fill="none", stroke=line(BLUE), stroke_width=16, stroke_dasharray=BROKEN)),
            Path("".join(pale), Look(fill="none", stroke=theme().quiet, stroke_width=10, stroke_dasharray=BROKEN)),
            Path("".join(lines), Look(fill="none", stroke=line(BLUE), stroke_width=STROKE)),
            lettered(letters),
        ]

    def _out(self, stub: Stub) -> Floats:
        """A vector as long as the wall of a marker, to the side of it where the marker stands."""
        wall = self.maps[0].walls[stub.wall]
        along = self.places[wall.end] - self.places[wall.start]
        left = np.array([-along[1], along[0]])
        return left if stub.side == LEFT else -left


def phases_picture(what: MapSystem | Development, n: int | None = None, labels: bool = True, **forces: object) -> PhasesPicture:
    """The phases of the last step of a map system, or of a development.

    >>> from lsys_kit import read_map
    >>> phases_picture(read_map("map: ABAB\\nA -> B[-A][+A]B\\nB -> A"), 1)
    step 1 in 4 pictures: 2 of 4 markers match; at the end 2 cells
    """
    maps: Development = developed(what, n)
    if maps.steps == 0:
        raise ModelValueError("Phases are those of a step, and step 0 is the first cell", hint="Draw step 1, or a later one.")
    check_walls(maps[-2:])
    replaced, stubs = replaced_map(maps[-2], maps.system)
    *_, before = place_maps(maps[:-1], forces_of(forces))
    return PhasesPicture((maps[-2], replaced, maps[-1]), stubs, insert_vertices(replaced, before), maps.steps, labels)
