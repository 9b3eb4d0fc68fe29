"""Deriving systems of cells: from the first cell to the cells of any step."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Generic, Self, TypeAlias, TypeVar, overload

from lsys_kit.budget import Task, check_budget, counted
from lsys_kit.derivation.tissues.cellworks import Cellwork, cellwork_step, first_cellwork
from lsys_kit.derivation.tissues.maps import Map, first_map, map_step, unmatched_markers
from lsys_kit.errors import ModelLimitError, ModelValueError, last_reached, whole_number
from lsys_kit.notation.model.cells import CellSystem, CellworkSystem, MapSystem

MOST_SHOWN = 400
"""How many characters of the cells of a step `repr` shows."""
S = TypeVar("S", bound=CellSystem)
F = TypeVar("F", Map, Cellwork)


class CellDevelopment(Sequence[F], Generic[S, F]):
    """The maps or cellworks of steps 0, 1, 2, ... of a system."""

    def __init__(self, system: S, found: Sequence[F]) -> None:
        self.system = system
        self._found: tuple[F, ...] = tuple(found)

    @property
    def steps(self) -> int:
        """The last step."""
        return len(self._found) - 1

    @property
    def counts(self) -> list[tuple[int, ...]]:
        """For each step how many vertices, walls and cells there are; of a cellwork also edges, behind the vertices."""
        return [found.counts for found in self._found]

    def up_to(self, step: int) -> Self:
        """The same up to an earlier step."""
        return type(self)(self.system, self._found[: whole_number(step, "The step") + 1])

    def __len__(self) -> int:
        return len(self._found)

    @overload
    def __getitem__(self, index: int) -> F: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[F]: ...
    def __getitem__(self, index: int | slice) -> F | Sequence[F]:
        return self._found[index]

    def __repr__(self) -> str:
        with Task(f"The text of the {self.system.notation}s was not written"):
            lines = (f"{step} {found}" for step, found in enumerate(counted(self._found, 1)))
            return "\n".join(line if len(line) <= MOST_SHOWN else f"{line[:MOST_SHOWN]}..." for line in lines)


AnyDevelopment: TypeAlias = CellDevelopment[Any, Any]


class Development(CellDevelopment[MapSystem, Map]):
    """The maps of steps 0, 1, 2, ..."""

    @property
    def notes(self) -> tuple[str, ...]:
        """Remarks: on the rules, and on markers that find no other half.

        >>> from lsys_kit import read_map
        >>> develop(read_map("map: A>B>C>\\nA> -> D>[+A>]B>\\nC> -> B>[+A<]B>"), 1).notes
        ('Markers of A never match up to step 1: no cell has two on its sides that fit.',)
        """
        with Task("The remarks were not found"):
            return (*self.system.notes, *unmatched_markers(self.system, self._found))


class CellworkDevelopment(CellDevelopment[CellworkSystem, Cellwork]):
    """The cellworks of steps 0, 1, 2, ..."""

    @property
    def generations(self) -> tuple[int, ...]:
        """For each cell of the last step how many divisions lie behind it."""
        found: tuple[int, ...] = (0,)
        for cellwork in self._found[1:]:
            divided = {mother for mother, other in zip(cellwork.mothers, cellwork.mothers[1:], strict=False) if mother == other}
            found = tuple(found[mother] + (mother in divided) for mother in cellwork.mothers)
        return found


_KINDS: Mapping[type, tuple[Callable[..., AnyDevelopment], Callable[[Any], Any], Callable[[Any, Any, int], Any]]] = {
    MapSystem: (Development, first_map, map_step),
    CellworkSystem: (CellworkDevelopment, first_cellwork, cellwork_step),
}
"""How the kinds of systems of cells develop: the whole, its first cell, and what becomes of cells in a step."""


@overload
def develop(system: MapSystem, steps: int) -> Development: ...
@overload
def develop(system: CellworkSystem, steps: int) -> CellworkDevelopment: ...
@overload
def develop(system: CellSystem, steps: int) -> AnyDevelopment: ...
def develop(system: CellSystem, steps: int) -> AnyDevelopment:
    """The cells of a map system or a cellwork system, from the first one on; `derive` does the same for every kind of system.

    An error has the step and, in `partial`, the steps before.

    >>> from lsys_kit import read_map
    >>> develop(read_map("map: A>B>C>D>\\nA> -> D>[-A>]B>\\nC> -> B>[-A<]B>\\nD> -> C>"), 2)
    0 A>B>C>D>
    1 D>A>B>C> | B>B>B>A<
    2 C>D>A>B> | B>B>B>A< | B>B>B>B<D<
    """
    steps, (made, first, next_step) = whole_number(steps, "The number of steps"), _KINDS[type(system)]
    found = [first(system)]
    with Task():
        for step in range(1, steps + 1):
            try:
                with Task(f"Step {step} was not reached"):
                    check_budget()
                    found.append(next_step(found[-1], system, step))
            except (ModelLimitError, ModelValueError) as error:
                error.partial = made(system, found)
                raise error.with_hint(f"{last_reached(step)} {error.hint}") from None
    return made(system, found)
