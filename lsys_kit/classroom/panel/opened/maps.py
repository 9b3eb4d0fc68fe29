"""A map system in the panel: its sliders are the forces under which its cells come to rest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Any

from lsys_kit.cache import Cache
from lsys_kit.classroom.link import STEP, link
from lsys_kit.classroom.panel.books.maps import MapsAtRest, map_book, maps_at_rest, steps_of
from lsys_kit.classroom.panel.controls import slider
from lsys_kit.classroom.panel.opened.opened import Viewing, read_any
from lsys_kit.classroom.panel.page import deflated, shared
from lsys_kit.derivation.maps.map import Map
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.geometry.map_layout import scenes
from lsys_kit.geometry.relaxation import Forces
from lsys_kit.notation.dialects.map.dialect import MAP, read_map
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.cellworks import CellworkSystem
from lsys_kit.notation.model.maps import MapSystem
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.maps import MapPicture, forces_of

SERIES = tuple(map(Fraction, ("1", "1.2", "1.5", "2", "2.5", "3", "4", "5", "6", "8")))
"""Of each power of ten a slider offers these multiples, each about a quarter more than the one before."""


def _decades(*powers: str) -> tuple[Value, ...]:
    """The values of a slider: some powers of ten and what lies between them."""
    parts = [number * Fraction(power) for power in powers[:-1] for number in SERIES]
    return tuple(map(normalised, (*parts, Fraction(powers[-1]))))


VALUES: Mapping[str, tuple[Value, ...]] = MappingProxyType({
    "stiffness": _decades("0.1", "1", "10"), "rest": tuple(normalised(Fraction(part, 20)) for part in range(21)),
    "pressure": _decades("0.01", "0.1", "1"), "damping": _decades("0.1", "1", "10")})
"""The values of the sliders of the forces."""
WALL_BYTES, SHARE = 600, 1 / 8
"""About what a wall of a map at rest takes in memory, and the part of the limit of bytes up to which maps are kept."""
LONGEST = 160
"""How many characters of a map are told."""


@dataclass(frozen=True)
class MapSight:
    """What there is to see of a map system at a step.

    Attributes
    ----------
    step, map, picture
        The step, its map, and the picture of it.
    """

    step: int
    map: Map
    picture: MapPicture

    @property
    def svg(self) -> str:
        return self.picture.svg

    def __str__(self) -> str:
        cells = str(self.map)
        return f"Step {self.step}: {self.picture.text}. {cells if len(cells) <= LONGEST else cells[:LONGEST] + '...'}"


class OpenedMap:
    """A map system that the panel shows, with the sliders of its forces.

    Raises
    ------
    LSystemError
        There is no such force, or it is too small or too great.
    """

    hint, kind = "the force of cells and walls:", "map L-system"
    side = 0, 0

    def __init__(self, system: MapSystem, title: str = "", changes: Mapping[str, object] | None = None) -> None:
        self.system, self.title = system, title
        forces = forces_of(dict(changes or {}))
        self.first: Mapping[str, Value] = {name: exact(getattr(forces, name)) for name in VALUES}
        self.values: Mapping[str, Sequence[Value]] = {
            name: tuple(sorted({*values, self.first[name]})) for name, values in VALUES.items()}
        self._kept = Cache[tuple[Forces, int], MapsAtRest](_bytes_of, SHARE)

    @property
    def steps(self) -> int:
        return steps_of(self.system)

    @property
    def angle(self) -> float:
        return 0.0

    def turned(self, angle: object) -> float:
        if angle is not None:
            raise ModelValueError("A map has no angle", hint="Its cells come to rest under the forces of its walls.")
        return 0.0

    def book(self, values: Mapping[str, Value], seed: int, least: int) -> dict[str, Any]:
        return map_book(self._at_rest(values, least), values, self.title)

    def sight(self, chosen: Viewing) -> MapSight:
        found = self._at_rest(chosen.values, chosen.step)
        if chosen.step > found.last:
            raise ModelValueError(f"The panel shows steps 0 to {found.last}, not {chosen.step}", hint=found.end)
        shown = [*scenes(found.maps, found.places)][chosen.step]
        made, places = found.maps[chosen.step], found.places[chosen.step]
        return MapSight(chosen.step, made, MapPicture([made], [places], [shown], [chosen.step]))

    def still(self, chosen: Viewing) -> Mapping[str, str]:
        return {"image/svg+xml": self.sight(chosen).svg}

    def page_data(self, chosen: Viewing) -> dict[str, Any]:
        """A page holds the book of one setting of the forces: under others cells come to rest in the browser."""
        made = self.book(chosen.values, 0, chosen.step)
        sliders = [slider(name, self.values[name], value, self.hint) for name, value in chosen.values.items()]
        model = {"constants": sliders, "chance": False, "fixed": "", "step": min(chosen.step, made["steps"]),
                 "angle": 0, "around": 0, "above": 0, "seed": 0}
        own = {"notation": MAP.name, "text": str(self.system), "angle": 0}
        return {"model": model, "mode": "map", "system": own, "fixed": {}, "books": deflated(shared([made]))}

    def link(self, chosen: Viewing) -> str:
        return link(self.system, {STEP: chosen.step, **chosen.values})

    def _at_rest(self, values: Mapping[str, Value], least: int) -> MapsAtRest:
        """The maps under some forces, up to the usual step or to a later one."""
        forces, usual = Forces(**{name: float(value) for name, value in values.items()}), self.steps
        found = self._kept.found((forces, usual), lambda: maps_at_rest(self.system, forces))
        if found.last >= least:
            return found
        return self._kept.found((forces, least), lambda: maps_at_rest(self.system, forces, least))

    def read(self, text: str) -> LSystem | MapSystem | CellworkSystem:
        """The text as a map system; where it makes sense as another only, as that."""
        try:
            return read_map(text)
        except LSystemError as error:
            try:
                return read_any(text)
            except LSystemError:
                raise error from None

    def variants(self, many: int) -> Sequence[LSystem]:
        return ()


def exact(number: float) -> Value:
    """The value that is written with the fewest digits among those nearest to a number.

    >>> exact(0.1), exact(1.0)
    (Fraction(1, 10), 1)
    """
    return normalised(Fraction(repr(number)))


def _bytes_of(found: MapsAtRest) -> int:
    return WALL_BYTES * sum(len(each.walls) for each in found.maps)
