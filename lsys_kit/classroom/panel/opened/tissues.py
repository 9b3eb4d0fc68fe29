"""Cells that are seen from all sides in the panel: a cellwork, or a map on a sphere. Its sliders are the forces of cells."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Any, NamedTuple

from lsys_kit.cache import Cache
from lsys_kit.classroom.link import STEP, link
from lsys_kit.classroom.panel.books.tissue_layout import TissueAtRest, TissueSystem, steps_of, tissue_at_rest
from lsys_kit.classroom.panel.books.tissues import size_text, tissue_book
from lsys_kit.classroom.panel.opened.maps import VALUES, exact
from lsys_kit.classroom.panel.opened.opened import Viewing, read_any
from lsys_kit.classroom.panel.page import deflated, kept_text, shared
from lsys_kit.derivation.cellworks.cellwork import Cellwork
from lsys_kit.derivation.maps.map import Map
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.geometry.cell_relaxation import SPACE_FORCES
from lsys_kit.geometry.relaxation import Forces
from lsys_kit.geometry.sphere_layout import SPHERE_FORCES
from lsys_kit.notation.dialects.cellwork.dialect import CELLWORK, read_cellwork
from lsys_kit.notation.dialects.map.dialect import MAP, read_map
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.cellworks import CellworkSystem
from lsys_kit.notation.model.maps import MapSystem
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures import cellworks, spheres
from lsys_kit.pictures.cellworks import CellworkPicture, picture_at
from lsys_kit.pictures.maps import forces_of
from lsys_kit.pictures.spheres import SpherePicture, spheres_at

EDGE_BYTES, SHARE = 900, 1 / 8
"""About what an edge of cells at rest takes in memory, and the part of the limit of bytes up to which they are kept."""
LONGEST = 160
"""How many characters of the cells are told."""


class Kind(NamedTuple):
    """What the two kinds of systems differ in: what they are called, the usual forces and the values of their sliders, the
    side from which they are seen first, and how they are read."""

    called: str
    page: str
    notation: str
    usual: Forces
    values: Mapping[str, tuple[Value, ...]]
    side: tuple[int, int]
    reader: Callable[[str], TissueSystem]


CELLWORKS = Kind("cellwork", "cellwork L-system", CELLWORK.name, SPACE_FORCES, MappingProxyType({
    **VALUES, "rest": tuple(normalised(Fraction(part, 10)) for part in range(21)),
    "pressure": tuple(normalised(Fraction(part, 2)) for part in range(1, 21))}),
    (cellworks.AZIMUTH, cellworks.ELEVATION), read_cellwork)
SPHERES = Kind("map on a sphere", "map L-system", MAP.name, SPHERE_FORCES, VALUES, (spheres.AZIMUTH, spheres.ELEVATION),
               read_map)


@dataclass(frozen=True)
class TissueSight:
    """What there is to see of cells at a step.

    Attributes
    ----------
    step, found, picture
        The step, its cellwork or map, and the picture of it.
    """

    step: int
    found: Cellwork | Map
    picture: CellworkPicture | SpherePicture

    @property
    def svg(self) -> str:
        return self.picture.svg

    def __str__(self) -> str:
        cells = str(self.found)
        return f"Step {self.step}: {size_text(self.found)}. {cells if len(cells) <= LONGEST else cells[:LONGEST] + '...'}"


class OpenedTissue:
    """A cellwork system, or a map system on a sphere, that the panel shows, with the sliders of its forces.

    Raises
    ------
    LSystemError
        There is no such force, or it is too small or too great.
    """

    hint = "the force of cells and edges:"

    def __init__(self, system: TissueSystem, title: str = "", changes: Mapping[str, object] | None = None) -> None:
        self.system, self.title, self._is = system, title, CELLWORKS if isinstance(system, CellworkSystem) else SPHERES
        self.kind, self.side = self._is.page, self._is.side
        forces = forces_of(dict(changes or {}), self._is.usual, self._is.called)
        self.first: Mapping[str, Value] = {name: exact(getattr(forces, name)) for name in VALUES}
        self.values: Mapping[str, Sequence[Value]] = {
            name: tuple(sorted({*values, self.first[name]})) for name, values in self._is.values.items()}
        self._kept = Cache[tuple[Forces, int], TissueAtRest](_bytes_of, SHARE)

    @property
    def steps(self) -> int:
        return steps_of(self.system)

    @property
    def angle(self) -> float:
        return 0.0

    def turned(self, angle: object) -> float:
        if angle is not None:
            raise ModelValueError(f"A {self._is.called} has no angle",
                                  hint="Its cells come to rest under the forces of its edges.")
        return 0.0

    def book(self, values: Mapping[str, Value], seed: int, least: int) -> dict[str, Any]:
        return tissue_book(self._at_rest(values, least), values, self.title)

    def sight(self, chosen: Viewing) -> TissueSight:
        found, step = self._at_rest(chosen.values, chosen.step), chosen.step
        if step > found.last:
            raise ModelValueError(f"The panel shows steps 0 to {found.last}, not {step}", hint=found.end)
        return TissueSight(step, found.steps[step], _picture(found, step, chosen.around, chosen.above))

    def still(self, chosen: Viewing) -> Mapping[str, str]:
        return {"image/svg+xml": self.sight(chosen).svg}

    def page_data(self, chosen: Viewing) -> dict[str, Any]:
        """On a page the forces stay as they are: cells come to rest in the kernel."""
        made = self.book(chosen.values, 0, chosen.step)
        fixed = made["settings"]
        model = {"constants": [], "chance": False, "fixed": kept_text(fixed, None), "step": min(chosen.step, made["steps"]),
                 "angle": 0, "around": chosen.around, "above": chosen.above, "seed": 0}
        own = {"notation": self._is.notation, "text": str(self.system), "angle": 0}
        return {"model": model, "mode": "tissue", "system": own, "fixed": fixed, "books": deflated(shared([made]))}

    def link(self, chosen: Viewing) -> str:
        return link(self.system, {STEP: chosen.step, **chosen.values})

    def _at_rest(self, values: Mapping[str, Value], least: int) -> TissueAtRest:
        """The cells under some forces, up to the usual step or to a later one."""
        forces, usual = Forces(**{name: float(value) for name, value in values.items()}), self.steps
        found = self._kept.found((forces, usual), lambda: tissue_at_rest(self.system, forces))
        if found.last >= least:
            return found
        return self._kept.found((forces, least), lambda: tissue_at_rest(self.system, forces, least))

    def read(self, text: str) -> LSystem | MapSystem | CellworkSystem:
        """The text as a system of the same kind; where it makes sense as another only, as that."""
        try:
            return self._is.reader(text)
        except LSystemError as error:
            try:
                return read_any(text)
            except LSystemError:
                raise error from None

    def variants(self, many: int) -> Sequence[LSystem]:
        return ()


def _picture(found: TissueAtRest, step: int, azimuth: float, elevation: float) -> CellworkPicture | SpherePicture:
    """The picture of a step, seen from a side."""
    steps, places = found.steps[:step + 1], found.places
    if isinstance(found.system, MapSystem):
        return spheres_at([each for each in steps if isinstance(each, Map)], places, [step], azimuth, elevation)
    cells = range(len(steps[-1].cells))
    return picture_at([each for each in steps if isinstance(each, Cellwork)], places[step], cells, azimuth, elevation)


def _bytes_of(found: TissueAtRest) -> int:
    return EDGE_BYTES * sum(len(each.cells) * 8 for each in found.steps)
