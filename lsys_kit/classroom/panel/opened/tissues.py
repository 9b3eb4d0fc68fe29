"""Cells that are seen from all sides in the panel: a cellwork, or a map on a sphere. Its sliders are the forces of cells."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from types import MappingProxyType
from typing import Any

from lsys_kit.classroom.panel.books.tissue_layout import TissueAtRest, TissueSystem, steps_of, tissue_at_rest
from lsys_kit.classroom.panel.books.tissues import size_text, tissue_book
from lsys_kit.classroom.panel.held import Held, held_text
from lsys_kit.classroom.panel.labels import translated_labels
from lsys_kit.classroom.panel.opened.cells import VALUES, CellSight, Kind, OpenedCells
from lsys_kit.classroom.panel.opened.opened import Viewing
from lsys_kit.classroom.panel.page import deflated, shared
from lsys_kit.derivation.cellworks.cellwork import Cellwork
from lsys_kit.derivation.maps.map import Map
from lsys_kit.geometry.tissues.cell_relaxation import SPACE_FORCES
from lsys_kit.geometry.tissues.sphere_layout import SPHERE_FORCES
from lsys_kit.notation.dialects.cellwork.dialect import CELLWORK, read_cellwork
from lsys_kit.notation.dialects.map.dialect import MAP, read_map
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.notation.model.cellworks import CellworkSystem
from lsys_kit.notation.model.maps import MapSystem
from lsys_kit.pictures.rendering.view import View
from lsys_kit.pictures.tissues import cellworks, spheres
from lsys_kit.pictures.tissues.cellworks import CellworkPicture, picture_at
from lsys_kit.pictures.tissues.spheres import SpherePicture, spheres_at

EDGE_BYTES = 900
"""About what an edge of cells at rest takes in memory."""


def _bytes_of(found: TissueAtRest) -> int:
    return EDGE_BYTES * sum(len(each.cells) * 8 for each in found.steps)


CELLWORKS = Kind(
    "cellwork",
    "cellwork L-system",
    CELLWORK.name,
    "edges",
    SPACE_FORCES,
    MappingProxyType(
        {
            **VALUES,
            "rest": tuple(normalised(Fraction(part, 10)) for part in range(21)),
            "pressure": tuple(normalised(Fraction(part, 2)) for part in range(1, 21)),
        }
    ),
    cellworks.SIDE,
    read_cellwork,
    steps_of,
    tissue_at_rest,
    _bytes_of,
)
SPHERES = Kind(
    "map on a sphere",
    "map L-system",
    MAP.name,
    "edges",
    SPHERE_FORCES,
    VALUES,
    spheres.SIDE,
    read_map,
    steps_of,
    tissue_at_rest,
    _bytes_of,
)


class OpenedTissue(OpenedCells[TissueAtRest]):
    """A cellwork system, or a map system on a sphere, that the panel shows, with the sliders of its forces.

    Raises
    ------
    LSystemError
        There is no such force, or it is too small or too great.
    """

    def __init__(
        self, system: TissueSystem, title: str = "", changes: Mapping[str, object] | None = None, without: Collection[str] = ()
    ) -> None:
        super().__init__(system, title, changes, without, CELLWORKS if isinstance(system, CellworkSystem) else SPHERES)

    def book(self, values: Mapping[str, Value], seed: int, least: int) -> dict[str, Any]:
        return tissue_book(self.at_rest(values, least), values, self.title)

    def sight(self, chosen: Viewing) -> CellSight:
        found, step = self.shown(chosen), chosen.step
        return CellSight(
            step, size_text(found.steps[step]), found.steps[step], _picture(found, step, (chosen.around, chosen.above))
        )

    def still(self, chosen: Viewing) -> Mapping[str, str]:
        return {"image/svg+xml": self.sight(chosen).svg}

    def page_data(self, chosen: Viewing, asked: Sequence[Mapping[str, object]] = ()) -> dict[str, Any]:
        """On a page the forces stay as they are: cells come to rest in the kernel."""
        made = self.book(chosen.values, 0, chosen.step)
        forces = {**self.fixed, **chosen.values}
        fixed, said = {name: number_text(value) for name, value in forces.items()}, held_text(forces, Held(), {})
        model = {
            "constants": [],
            "chance": False,
            "fixed": said,
            "step": min(chosen.step, made["steps"]),
            "angle": 0,
            "around": chosen.around,
            "above": chosen.above,
            "seed": 0,
            **translated_labels(),
        }
        return {"model": model, "mode": "tissue", "system": self.own(), "fixed": fixed, "books": deflated(shared([made]))}


def _picture(found: TissueAtRest, step: int, view: View) -> CellworkPicture | SpherePicture:
    """The picture of a step, seen from a side."""
    steps, places = found.steps[: step + 1], found.places
    if isinstance(found.system, MapSystem):
        return spheres_at([each for each in steps if isinstance(each, Map)], places, [step], view)
    cells = range(len(steps[-1].cells))
    return picture_at([each for each in steps if isinstance(each, Cellwork)], places[step], cells, view)
