"""Cellworks, and maps on a sphere, at rest under some forces, as many steps of them as a book holds."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from lsys_kit.budget import current, limits
from lsys_kit.classroom.panel.books.book import FEWEST_STEPS, TIME_FOR_ASKED, sentence
from lsys_kit.classroom.panel.books.cells import last_held
from lsys_kit.derivation.cellworks.cellwork import Cellwork
from lsys_kit.derivation.cellworks.development import CellworkDevelopment, develop_cellwork
from lsys_kit.derivation.maps.development import Development, develop
from lsys_kit.derivation.maps.map import Map
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError
from lsys_kit.geometry.scene import Floats
from lsys_kit.geometry.tissues.cellwork_layout import place_cellworks
from lsys_kit.geometry.tissues.relaxation import Forces
from lsys_kit.geometry.tissues.sphere_layout import Placed, place_on_sphere
from lsys_kit.notation.model.cellworks import CellworkSystem
from lsys_kit.notation.model.maps import MapSystem
from lsys_kit.pictures.tissues.cellworks import STEPS
from lsys_kit.pictures.tissues.maps import STEPS as MAP_STEPS

MOST_EDGES = 4_000
"""A book holds no step of more edges, since nobody could see more of them."""
MOST_UNASKED, MOST_ON_SPHERE = 800, 400
"""Steps beyond the last one that the system asks for are held while all together have no more edges, or walls on a sphere;
larger ones take long to come to rest."""

TissueSystem: TypeAlias = CellworkSystem | MapSystem
"""A cellwork system, or a map system on a sphere."""


@dataclass(frozen=True)
class TissueAtRest:
    """The cells that a book holds.

    Attributes
    ----------
    system
        Their system.
    steps, places
        The cellwork or the map of each step, and where it comes to rest: the positions of its vertices, on a sphere `Placed`.
    end
        Why there are no more steps; "" if nothing is in the way.
    """

    system: TissueSystem
    steps: Sequence[Cellwork | Map]
    places: Sequence[Any]
    end: str

    @property
    def last(self) -> int:
        """The last step."""
        return len(self.places) - 1


def tissue_at_rest(system: TissueSystem, forces: Forces, least: int = 0) -> TissueAtRest:
    """The steps of a system at rest, up to twice the step that it asks for, or to a later one.

    Raises
    ------
    LSystemError
        Not even the first cell comes to rest.
    """
    asked = max(steps_of(system), least)
    with limits(modules=min(MOST_EDGES, current().modules), seconds=TIME_FOR_ASKED * current().seconds):
        steps, end = _developed(system, asked)
        places: list[Any] = []
        try:
            for points in _placed(steps, forces):
                places.append(points)
        except LSystemError as error:
            if not places:
                raise
            end = sentence(error)
    return TissueAtRest(system, steps[: len(places)], places, end)


def steps_of(system: TissueSystem) -> int:
    """The step that is shown first."""
    usual = STEPS if isinstance(system, CellworkSystem) else MAP_STEPS
    return usual if system.steps is None else system.steps


def _developed(system: TissueSystem, asked: int) -> tuple[CellworkDevelopment | Development, str]:
    """The steps that shall come to rest, and why there are no more of them."""
    end, most = "", max(2 * asked, FEWEST_STEPS)
    try:
        found = develop_cellwork(system, most) if isinstance(system, CellworkSystem) else develop(system, most)
    except (ModelLimitError, ModelValueError) as error:
        if not isinstance(error.partial, CellworkDevelopment | Development):
            raise
        found, end = error.partial, sentence(error)
    unasked = MOST_UNASKED if isinstance(found, CellworkDevelopment) else MOST_ON_SPHERE
    last, early = last_held(map(_edges, found), asked, unasked, "steps")
    return _up_to(found, last), early or end


def _up_to(found: CellworkDevelopment | Development, last: int) -> CellworkDevelopment | Development:
    if isinstance(found, CellworkDevelopment):
        return CellworkDevelopment(found.system, found[: last + 1])
    return Development(found.system, found[: last + 1])


def _edges(found: Cellwork | Map) -> int:
    return len(found.edges if isinstance(found, Cellwork) else found.walls)


def _placed(steps: CellworkDevelopment | Development, forces: Forces) -> Iterator[Floats] | Iterator[Placed]:
    return place_cellworks(steps, forces) if isinstance(steps, CellworkDevelopment) else place_on_sphere(steps, forces)
