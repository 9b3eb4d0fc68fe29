"""Systems of cells in the panel: their sliders are the forces under which the cells come to rest."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Any, NamedTuple, Protocol

from lsys_kit.cache import Cache
from lsys_kit.classroom.link import STEP, link
from lsys_kit.classroom.panel.books.at_rest import CellsAtRest, cells_at_rest
from lsys_kit.classroom.panel.books.cells import cell_book, size_text
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.classroom.panel.controls import slider
from lsys_kit.classroom.panel.held import Held, held_text
from lsys_kit.classroom.panel.labels import translated_labels
from lsys_kit.classroom.panel.opened.opened import Viewing
from lsys_kit.classroom.panel.page import deflated, shared
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.geometry.tissues.layout import scenes
from lsys_kit.geometry.tissues.relaxation import Forces
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.notation.model.cells import CellworkSystem, MapSystem
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import CELL_READERS, AnySystem, read_any
from lsys_kit.pictures.rendering.view import View
from lsys_kit.pictures.tissues import cellworks, spheres
from lsys_kit.pictures.tissues.chosen import USUAL, forces_of, steps_of
from lsys_kit.pictures.tissues.maps import MapPicture

SERIES = tuple(map(Fraction, ("1", "1.2", "1.5", "2", "2.5", "3", "4", "5", "6", "8")))
"""Of each power of ten a slider offers these multiples, each about a quarter more than the one before."""


def _decades(*powers: str) -> tuple[Value, ...]:
    """The values of a slider: some powers of ten and what lies between them."""
    parts = [number * Fraction(power) for power in powers[:-1] for number in SERIES]
    return tuple(map(normalised, (*parts, Fraction(powers[-1]))))


VALUES: Mapping[str, tuple[Value, ...]] = MappingProxyType(
    {
        "stiffness": _decades("0.1", "1", "10"),
        "rest": tuple(normalised(Fraction(part, 20)) for part in range(21)),
        "pressure": _decades("0.01", "0.1", "1"),
        "damping": _decades("0.1", "1", "10"),
    }
)
"""The values of the sliders of the forces, where a kind of system has no others."""
SHARE = 1 / 8
"""The part of the limit of bytes up to which cells at rest are kept."""
CELL_BYTES, WALL_BYTES = 7_200, 600
"""About what a cell at rest that is seen from all sides takes in memory, and a wall of a map in the plane."""
LONGEST = 160
"""How many characters of the cells are told."""


class Drawn(Protocol):
    """A picture of cells, and what it shows in words."""

    @property
    def svg(self) -> str: ...
    @property
    def text(self) -> str: ...


class Kind(NamedTuple):
    """What the kinds of systems of cells differ in: what their cells are bounded by; the picture of a step, seen from a side;
    about how many bytes a step at rest takes in memory; the side from which it is seen first; the values of the sliders of its
    forces; and whether it lies in the plane. There its cells come to rest in the browser, too, so that a page has sliders.
    """

    sides: str
    picture: Callable[[CellsAtRest, int, View], Drawn]
    size: Callable[[Any], int]
    view: tuple[int, int]
    values: Mapping[str, tuple[Value, ...]] = VALUES
    flat: bool = False


def _map_at(found: CellsAtRest, step: int, _: View) -> Drawn:
    places = [each.points for each in found.reached]
    drawn = [*scenes(found.steps, places)][step]
    return MapPicture([found.steps[step]], [places[step]], [drawn], [step])


def _sphere_at(found: CellsAtRest, step: int, view: View) -> Drawn:
    return spheres.spheres_at(found.steps[: step + 1], found.reached, [step], view)


def _cellwork_at(found: CellsAtRest, step: int, view: View) -> Drawn:
    steps = found.steps[: step + 1]
    return cellworks.picture_at(steps, found.reached[step], range(len(steps[-1].cells)), view)


def _tissue_bytes(found: Any) -> int:
    return CELL_BYTES * len(found.cells)


_SPACE_VALUES = {
    **VALUES,
    "rest": tuple(normalised(Fraction(part, 10)) for part in range(21)),
    "pressure": tuple(normalised(Fraction(part, 2)) for part in range(1, 21)),
}
KINDS: Mapping[str, Kind] = {
    "map": Kind("walls", _map_at, lambda found: WALL_BYTES * len(found.walls), (0, 0), flat=True),
    "map on a sphere": Kind("edges", _sphere_at, _tissue_bytes, spheres.SIDE),
    "cellwork": Kind("edges", _cellwork_at, _tissue_bytes, cellworks.SIDE, MappingProxyType(_SPACE_VALUES)),
}
"""The kinds of systems of cells."""


@dataclass(frozen=True)
class CellSight:
    """What there is to see of cells at a step: how many there are, in words, the map or cellwork, and the picture of it."""

    step: int
    size: str
    found: object
    picture: Drawn

    @property
    def svg(self) -> str:
        return self.picture.svg

    def told(self, show: Collection[str]) -> str:
        return str(self)

    def __str__(self) -> str:
        cells = str(self.found)
        return f"Step {self.step}: {self.size}. {cells if len(cells) <= LONGEST else cells[:LONGEST] + '...'}"


class OpenedCells:
    """A system of cells that the panel shows, with the sliders of its forces."""

    def __init__(
        self,
        system: MapSystem | CellworkSystem,
        title: str = "",
        changes: Mapping[str, object] | None = None,
        without: Collection[str] = (),
    ) -> None:
        self.system, self.title, self._of = system, title, KINDS[system.kind]
        self.kind, self.side = f"{system.notation} L-system", self._of.view
        self.hint = f"the force of cells and {self._of.sides}:"
        forces = forces_of(changes or {}, system.kind)
        given = {name: exact(getattr(forces, name)) for name in VALUES}
        self.first: Mapping[str, Value] = {name: value for name, value in given.items() if name not in without}
        self.fixed: Mapping[str, Value] = {name: value for name, value in given.items() if name in without}
        self.declared: Mapping[str, Value] = {name: exact(getattr(USUAL[system.kind], name)) for name in VALUES}
        self.given: Mapping[str, Value] = self.fixed
        self.values: Mapping[str, Sequence[Value]] = {
            name: tuple(sorted({*self._of.values[name], value})) for name, value in self.first.items()
        }
        self._kept = Cache[tuple[Forces, int], CellsAtRest](lambda found: sum(map(self._of.size, found.steps)), SHARE)

    @property
    def steps(self) -> int:
        return steps_of(self.system)

    @property
    def angle(self) -> float:
        return 0.0

    def turned(self, angle: object) -> float:
        if angle is not None:
            raise ModelValueError(
                f"A {self.system.kind} has no angle", hint=f"Its cells come to rest under the forces of its {self._of.sides}."
            )
        return 0.0

    def link(self, chosen: Viewing) -> str:
        return link(self.system, {STEP: chosen.step, **self.fixed, **chosen.values})

    def _at_rest(self, values: Mapping[str, Value], least: int) -> CellsAtRest:
        forces = Forces(**{name: float(value) for name, value in {**self.fixed, **values}.items()})
        found = self._kept.found((forces, self.steps), lambda: cells_at_rest(self.system, forces))
        if found.last >= least:
            return found
        return self._kept.found((forces, least), lambda: cells_at_rest(self.system, forces, least))

    @property
    def lettered(self) -> Sequence[str]:
        return ()

    def book(self, values: Mapping[str, Value], seed: int, least: int, letters: Collection[str] = ()) -> Data:
        return cell_book(self._at_rest(values, least), values, self.title)

    def sight(self, chosen: Viewing) -> CellSight:
        found, step = self._at_rest(chosen.values, chosen.step), chosen.step
        if step > found.last:
            raise ModelValueError(f"The panel shows steps 0 to {found.last}, not {step}", hint=found.end)
        picture, cells = self._of.picture(found, step, (chosen.around, chosen.above)), found.steps[step]
        return CellSight(step, picture.text if self._of.flat else size_text(cells), cells, picture)

    def still(self, chosen: Viewing, show: Collection[str] = ()) -> Mapping[str, str]:
        return {"image/svg+xml": self.sight(chosen).svg}

    def page_data(self, chosen: Viewing, asked: Sequence[Mapping[str, object]] = ()) -> dict[str, object]:
        """A page holds the book of one setting of the forces. Under others the cells of a map in the plane come to rest in the
        browser; all else comes to rest in the kernel, and on a page its forces stay as they are."""
        made, flat = self.book(chosen.values, 0, chosen.step), self._of.flat
        moving = chosen.values if flat else {}
        fixed = self.fixed if flat else {**self.fixed, **chosen.values}
        model = {
            "constants": [slider(name, self.values[name], value, self.hint) for name, value in moving.items()],
            "chance": False,
            "fixed": held_text(fixed, Held(), {}),
            "step": min(chosen.step, made["steps"]),
            "angle": 0,
            "around": 0 if flat else chosen.around,
            "above": 0 if flat else chosen.above,
            "seed": 0,
            **translated_labels(),
        }
        return {
            "model": model,
            "mode": made["mode"],
            "system": {"notation": self.system.notation, "text": str(self.system), "angle": 0},
            "fixed": {name: number_text(value) for name, value in fixed.items()},
            "books": deflated(shared([made])),
        }

    def read(self, text: str) -> AnySystem:
        """The text as a system of the same kind; where it makes sense as another only, as that."""
        try:
            return CELL_READERS[self.system.notation](text)
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
