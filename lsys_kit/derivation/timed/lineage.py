"""Lineages: which cell comes from which, and when each divides (P. Prusinkiewicz, Introduction to Modeling with L-systems,
figures 5 and 6).

A step leads from one word to the next, but events within it have times of their own. Where a cell's age grows with time and a
condition such as `t >= t_div` says at which age it divides, the age that it would have by the step's end tells how long ago it
divided. So the lineage has a place in continuous time, however long the steps are; and it shows where a division is late,
because the productions let a cell divide only once in a step.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from lsys_kit.budget import Task
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation, derive
from lsys_kit.derivation.timed.cell_lineage import MOST_CELLS, CellDivisions, CellGrowth, CellPart, LineageCell
from lsys_kit.derivation.timed.timed import Timed
from lsys_kit.errors import ModelLimitError, ModelValueError, whole_number
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem


@dataclass(frozen=True)
class Lineage:
    """The cells of a development.

    Attributes
    ----------
    last
        The word at the end.
    cells
        All cells; a mother stands before her daughters, and these from left to right.
    words
        For each step its cells, by their numbers, in the order of the word.
    times
        When each step is; of a timed system its beginning and its end.
    stepwise
        Whether there are steps, or words at any time.
    """

    last: Word
    cells: tuple[LineageCell, ...]
    words: tuple[tuple[int, ...], ...]
    times: tuple[Value, ...]
    stepwise: bool = True

    @property
    def states(self) -> States:
        """The table of its modules."""
        return self.last.states

    def daughters(self, cell: int) -> tuple[int, ...]:
        """The numbers of the cells that a cell has become, from left to right."""
        return self._daughters.get(whole_number(cell, "The number of a cell"), ())

    @property
    def divisions(self) -> tuple[Value, ...]:
        """When cells divide, in the order of time."""
        return tuple(
            sorted(
                cell.ended
                for number, cell in enumerate(self.cells)
                if cell.ended is not None and len(self.daughters(number)) > 1
            )
        )

    @cached_property
    def _daughters(self) -> dict[int, tuple[int, ...]]:
        found: dict[int, list[int]] = {}
        for number, cell in enumerate(self.cells):
            if cell.mother is not None:
                found.setdefault(cell.mother, []).append(number)
        return {mother: tuple(daughters) for mother, daughters in found.items()}

    def __str__(self) -> str:
        living, late = len(self.words[-1]), sum(cell.due is not None for cell in self.cells)
        divided = len(self.divisions)
        return (
            f"{living:,} cell{'s' * (living != 1)} at time {number_text(self.times[-1])}, after {divided:,} "
            f"division{'s' * (divided != 1)}" + (f"; {late:,} late" if late else "")
        )

    __repr__ = __str__


def lineage(
    what: LSystem | Derivation | Timed,
    n: object = None,
    *,
    seed: int | None = None,
    arithmetic: str = "exact",
    **constants: object,
) -> Lineage:
    """Which cell comes from which, and when each divides.

    Parameters
    ----------
    what
        A system is derived first. A module that continues as one module stays the same cell; one that is replaced by several
        has divided. In a filament only what is drawn as a cell is one.
    n
        For a system how many steps, by default those that it asks for; for a timed system the time at which to end.
    seed, arithmetic, **constants
        For a system as for `derive`.

    Raises
    ------
    ModelLimitError
        There are too many cells.
    ModelValueError
        The argument has no lineage, or a choice is missing or does not apply to it.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> ageing = read("dt = 1.4\\naxiom: M(0)\\nM(t) -> M(t+dt)\\ndecomposition:\\nM(t) : t >= 1 -> M(t-1) M(t-0.8)")
    >>> tree = lineage(ageing, 2)
    >>> tree, [float(time) for time in tree.divisions]
    (7 cells at time 2.8, after 6 divisions, [1.0, 1.8, 2.0, 2.6, 2.8, 2.8])

    See P. Prusinkiewicz, Introduction to Modeling with L-systems, sections 5 and 6, figures 5 and 6.
    """
    with Task("The lineage was not found"):
        return _lineage(what, n, seed, arithmetic, constants)


def _lineage(
    what: LSystem | Derivation | Timed, n: object, seed: int | None, arithmetic: str, constants: dict[str, object]
) -> Lineage:
    if isinstance(what, LSystem):
        steps: Any = n if n is not None else what.steps if what.steps is not None else 5
        start = derive(what, 0, seed=seed, arithmetic=arithmetic, **constants)
        if start.states.traits.sensitive:
            raise ModelValueError(
                "The system asks what the turtle sees, which words alone do not say",
                hint="Derive it first, and ask for the lineage of the derivation.",
            )
        return _derived_lineage(start.to(steps))
    if isinstance(what, Timed) and n is not None and not constants:
        return _timed_lineage(what, number_from(n, "time"))
    if isinstance(what, Timed):
        raise ModelValueError(
            "The lineage of a timed system needs the time at which it ends, and nothing else",
            hint="Ask for lineage(timed(system), 5).",
        )
    if not isinstance(what, Derivation):
        raise ModelValueError(f"Only systems, derivations and timed systems have a lineage, not {type(what).__name__}")
    if n is not None or constants:
        raise ModelValueError("Steps and constants are chosen when a system is derived, not when its lineage is asked for")
    return _derived_lineage(what)


def _derived_lineage(derivation: Derivation) -> Lineage:
    """The lineage of a derivation."""
    states = derivation.states
    if states.traits.predecessor > 1:
        raise ModelValueError(
            "A cell of a lineage has one mother, but this system replaces several modules together",
            hint="explain(derivation, step) tells which modules become which.",
        )
    if sum(derivation.lengths) > MOST_CELLS:
        raise ModelLimitError(
            f"The words of a lineage may have {MOST_CELLS:,} modules together",
            limit=MOST_CELLS,
            needed=sum(derivation.lengths),
            hint="Take fewer steps.",
        )
    growth, divisions = CellGrowth(states), CellDivisions(states)
    length = divisions.ages.step or 1
    for module in derivation[0]:
        growth.found(growth.born(None, 0, module) if growth.is_cell(module) else None, 0, module)
    words = [growth.places]
    for step in range(1, len(derivation)):
        before, growth.places = growth.places, []
        parts = map(divisions.of, derivation[step - 1].numbers()) if states.traits.d0l else _flat_parts(derivation, step)
        for owner, part in zip(before, parts, strict=True):
            growth.follow(part, owner, step, (normalised((step - 1) * length), normalised(step * length)))
        words.append(growth.places)
    end = normalised(derivation.steps * length)
    if states.traits.d0l and divisions.ages.step is not None:
        for owner, state in zip(growth.places, derivation[-1].numbers(), strict=True):
            due = growth.overdue(divisions.of(state), end + length) if owner is not None else None
            if owner is not None and due is not None and due < end:
                growth.cells[owner] = replace(growth.cells[owner], due=due)
    found = tuple(tuple(cell for cell in word if cell is not None) for word in words)
    times = tuple(normalised(step * length) for step in range(len(derivation)))
    return Lineage(derivation[-1], growth.finished(), found, times)


def _flat_parts(derivation: Derivation, step: int) -> list[CellPart]:
    """What becomes of each module of the word before a step, where neighbours or chance have a say."""
    made: list[list[CellPart]] = [[] for _ in derivation[step - 1]]
    for parent, module in zip(derivation.origins(step).parents, derivation[step], strict=True):
        made[parent].append(CellPart(module, module))
    return [CellPart(module, module, tuple(parts)) for module, parts in zip(derivation[step - 1], made, strict=True)]


def _timed_lineage(system: Timed, end: Value) -> Lineage:
    """The lineage of a timed system up to a time."""
    word, growth = system.word(end), CellGrowth(system.states)
    if len(word) > MOST_CELLS:
        raise ModelLimitError(
            f"A lineage may have {MOST_CELLS:,} cells", limit=MOST_CELLS, needed=len(word), hint="Take an earlier time."
        )
    axiom = [system.states.modules[state] for state in system.states.axiom]
    for module in axiom:
        growth.found(growth.born(None, 0, module), 0, module)
    todo: list[tuple[Module, Value, int]] = [(module, 0, cell) for cell, module in reversed(list(enumerate(axiom)))]
    first, growth.places = tuple(range(len(axiom))), []
    while todo:
        module, since, cell = todo.pop()
        left, daughters = system.division(module, end - since)
        if daughters is None:
            growth.found(cell, 1, word[len(growth.places)])
            continue
        moment = normalised(end - left)
        if len(daughters) != 1:
            growth.cells[cell] = replace(growth.cells[cell], ended=moment)
        numbers = [cell] if len(daughters) == 1 else [growth.born(cell, moment, daughter) for daughter in daughters]
        todo += [(daughter, moment, number) for daughter, number in reversed(list(zip(daughters, numbers, strict=True)))]
    living = tuple(cell for cell in growth.places if cell is not None)
    return Lineage(word, growth.finished(), (first, living), (0, end), False)
