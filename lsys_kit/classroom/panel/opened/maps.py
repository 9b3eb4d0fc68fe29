"""A map system in the panel: its sliders are the forces under which its cells come to rest."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

from lsys_kit.classroom.panel.books.maps import MapsAtRest, map_book, maps_at_rest, steps_of
from lsys_kit.classroom.panel.controls import slider
from lsys_kit.classroom.panel.held import Held, held_text
from lsys_kit.classroom.panel.labels import translated_labels
from lsys_kit.classroom.panel.opened.cells import VALUES, CellSight, Kind, OpenedCells
from lsys_kit.classroom.panel.opened.opened import Viewing
from lsys_kit.classroom.panel.page import deflated, shared
from lsys_kit.geometry.tissues.map_layout import scenes
from lsys_kit.geometry.tissues.relaxation import DEFAULT_FORCES
from lsys_kit.notation.dialects.map.dialect import MAP, read_map
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.maps import MapSystem
from lsys_kit.pictures.tissues.maps import MapPicture

WALL_BYTES = 600
"""About what a wall of a map at rest takes in memory."""


def _bytes_of(found: MapsAtRest) -> int:
    return WALL_BYTES * sum(len(each.walls) for each in found.maps)


MAPS = Kind(
    "map", "map L-system", MAP.name, "walls", DEFAULT_FORCES, VALUES, (0, 0), read_map, steps_of, maps_at_rest, _bytes_of
)


class OpenedMap(OpenedCells[MapsAtRest]):
    """A map system that the panel shows, with the sliders of its forces.

    Raises
    ------
    LSystemError
        There is no such force, or it is too small or too great.
    """

    def __init__(
        self, system: MapSystem, title: str = "", changes: Mapping[str, object] | None = None, without: Collection[str] = ()
    ) -> None:
        super().__init__(system, title, changes, without, MAPS)

    def book(self, values: Mapping[str, Value], seed: int, least: int) -> dict[str, Any]:
        return map_book(self.at_rest(values, least), values, self.title)

    def sight(self, chosen: Viewing) -> CellSight:
        found, step = self.shown(chosen), chosen.step
        drawn = [*scenes(found.maps, found.places)][step]
        picture = MapPicture([found.maps[step]], [found.places[step]], [drawn], [step])
        return CellSight(step, picture.text, found.maps[step], picture)

    def still(self, chosen: Viewing) -> Mapping[str, str]:
        return {"image/svg+xml": self.sight(chosen).svg}

    def page_data(self, chosen: Viewing, asked: Sequence[Mapping[str, object]] = ()) -> dict[str, Any]:
        """A page holds the book of one setting of the forces: under others cells come to rest in the browser."""
        made = self.book(chosen.values, 0, chosen.step)
        sliders = [slider(name, self.values[name], value, self.hint) for name, value in chosen.values.items()]
        fixed, said = {name: number_text(value) for name, value in self.fixed.items()}, held_text(self.fixed, Held(), {})
        model = {
            "constants": sliders,
            "chance": False,
            "fixed": said,
            "step": min(chosen.step, made["steps"]),
            "angle": 0,
            "around": 0,
            "above": 0,
            "seed": 0,
            **translated_labels(),
        }
        return {"model": model, "mode": "map", "system": self.own(), "fixed": fixed, "books": deflated(shared([made]))}
