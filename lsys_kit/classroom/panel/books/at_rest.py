"""Systems of cells at rest under some forces, as many steps of them as a book holds."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Any, NamedTuple

from lsys_kit.budget import current, limits
from lsys_kit.classroom.panel.books.book import FEWEST_STEPS, MOST_BYTES, TIME_FOR_ASKED, sentence
from lsys_kit.derivation.tissues.development import AnyDevelopment, CellDevelopment, develop
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError
from lsys_kit.geometry.tissues.layout import equilibria, place_cellworks, place_on_sphere
from lsys_kit.geometry.tissues.relaxation import Forces
from lsys_kit.notation.model.cells import CellSystem
from lsys_kit.pictures.tissues.chosen import steps_of


class Room(NamedTuple):
    """What a book has room for, of one kind of system, whose cells come to rest by a layout.

    A book holds no step of more edges, which are the walls of a map, than `most`, since nobody could see more of them. Steps
    beyond the last one that the system asks for are held while all together have no more edges than `unasked`, since larger
    ones take long to come to rest. An edge takes about `bytes_each` in a book, where that matters. Steps have a name of their
    own.
    """

    layout: Callable[[Any, Forces], Iterable[object]]
    most: int
    unasked: int
    bytes_each: int = 0
    called: str = "steps"


ROOMS: Mapping[str, Room] = {
    "map": Room(equilibria, 20_000, 320, 80, "maps"),
    "map on a sphere": Room(place_on_sphere, 4_000, 400),
    "cellwork": Room(place_cellworks, 4_000, 800),
}
"""The kinds of systems of cells."""


@dataclass(frozen=True)
class CellsAtRest:
    """The cells that a book holds, under some forces: the maps or cellworks of all steps, and where each comes to rest, as its
    layout says it; and why there are no more steps, "" if nothing is in the way.
    """

    forces: Forces
    steps: AnyDevelopment
    reached: Sequence[Any]
    end: str

    @property
    def last(self) -> int:
        """The last step."""
        return len(self.reached) - 1


def cells_at_rest(system: CellSystem, forces: Forces, least: int = 0) -> CellsAtRest:
    """The steps of a system at rest, up to twice the step that it asks for, or to a later one; an error, if not even the first
    cell comes to rest.
    """
    room, asked, end = ROOMS[system.kind], max(steps_of(system), least), ""
    with limits(modules=min(room.most, current().modules), seconds=TIME_FOR_ASKED * current().seconds):
        try:
            steps = develop(system, max(2 * asked, FEWEST_STEPS))
        except (ModelLimitError, ModelValueError) as error:
            if not isinstance(error.partial, CellDevelopment):
                raise
            steps, end = error.partial, sentence(error)
        last, early = last_held((found.counts[1] for found in steps), asked, room.unasked, room.called)
        steps, end = steps.up_to(last), early or end
        reached, size = list[object](), 0
        try:
            for found, each in zip(steps, room.layout(steps, forces), strict=True):
                size += room.bytes_each * found.counts[1]
                if size > MOST_BYTES:
                    end = f"The panel ends at step {len(reached) - 1}: step {len(reached)} has too many more walls."
                    break
                reached.append(each)
        except LSystemError as error:
            if not reached:
                raise
            end = sentence(error)
    return CellsAtRest(forces, steps.up_to(len(reached) - 1), reached, end)


def last_held(sizes: Iterable[int], asked: int, most: int, called: str) -> tuple[int, str]:
    """The last step that a book holds, and why it ends there: "" if there are no further steps.

    That which is asked for must be held, if there is one; later ones are while all together have no more edges than `most`.

    >>> last_held([4, 7, 12, 24], 1, 20, "maps")[0], last_held([4, 7, 12, 24], 3, 20, "maps")
    (1, (3, ''))
    """
    sums = [*accumulate(sizes)]
    last = min(max([asked, *(step for step, sum in enumerate(sums) if sum <= most)]), len(sums) - 1)
    if last == len(sums) - 1:
        return last, ""
    return last, (
        f"The panel ends at step {last}: later {called} take long to come to rest. "
        f"The rules may ask for more: steps: {last + 1}"
    )
