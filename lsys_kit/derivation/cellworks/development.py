"""Deriving cellworks: from the first cell to the cells of any step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import overload

from lsys_kit.budget import Task, check_budget, counted
from lsys_kit.derivation.cellworks.cellwork import Cellwork
from lsys_kit.derivation.cellworks.divisions import cellwork_step
from lsys_kit.derivation.cellworks.first_cell import first_cellwork
from lsys_kit.errors import ModelLimitError, ModelValueError, whole_number
from lsys_kit.notation.model.cellworks import CellworkSystem

MOST_SHOWN = 400
"""How many characters of a cellwork `repr` shows."""


class CellworkDevelopment(Sequence[Cellwork]):
    """The cellworks of steps 0, 1, 2, ...

    Attributes
    ----------
    system
        The cellwork system.
    """

    def __init__(self, system: CellworkSystem, cellworks: Sequence[Cellwork]) -> None:
        self.system, self._cellworks = system, tuple(cellworks)

    @property
    def steps(self) -> int:
        """The last step."""
        return len(self._cellworks) - 1

    @property
    def counts(self) -> list[tuple[int, int, int, int]]:
        """For each step how many vertices, edges, walls and cells there are."""
        return [found.counts for found in self._cellworks]

    @property
    def generations(self) -> tuple[int, ...]:
        """For each cell of the last step how many divisions lie behind it."""
        found: tuple[int, ...] = (0,)
        for cellwork in self._cellworks[1:]:
            divided = {mother for mother, other in zip(cellwork.mothers, cellwork.mothers[1:], strict=False) if mother == other}
            found = tuple(found[mother] + (mother in divided) for mother in cellwork.mothers)
        return found

    def __len__(self) -> int:
        return len(self._cellworks)

    @overload
    def __getitem__(self, index: int) -> Cellwork: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Cellwork]: ...
    def __getitem__(self, index: int | slice) -> Cellwork | Sequence[Cellwork]:
        return self._cellworks[index]

    def __repr__(self) -> str:
        with Task("The text of the cellworks was not written"):
            lines = (f"{step} {found}" for step, found in enumerate(counted(self._cellworks, 1)))
            return "\n".join(line if len(line) <= MOST_SHOWN else f"{line[:MOST_SHOWN]}..." for line in lines)


def develop_cellwork(system: CellworkSystem, steps: int) -> CellworkDevelopment:
    """The cellworks of a cellwork system, from the first cell on; `derive` does the same for every kind of system.

    Parameters
    ----------
    system
        A cellwork system.
    steps
        How many steps.

    Raises
    ------
    ModelLimitError
        A cellwork would be too large; the error has, in `partial`, the cellworks before.
    ModelValueError
        New edges go around a cell, and do not lie in one new wall; the error has the cellworks before, too.
    """
    steps = whole_number(steps, "The number of steps")
    cellworks = [first_cellwork(system)]
    with Task():
        for step in range(1, steps + 1):
            try:
                cellworks.append(_next(cellworks[-1], system, step))
            except (ModelLimitError, ModelValueError) as error:
                error.partial = CellworkDevelopment(system, cellworks)
                kept = "Step 0 is" if step == 1 else f"Steps 0-{step - 1} are"
                raise error.with_hint(f"{kept} kept. {error.hint}") from None
    return CellworkDevelopment(system, cellworks)


def _next(found: Cellwork, system: CellworkSystem, step: int) -> Cellwork:
    with Task(f"Step {step} was not reached"):
        check_budget()
        return cellwork_step(found, system, step)
