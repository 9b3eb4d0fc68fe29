"""Cell lineage within a step: divisions, with the cells that appear and divide again between two words.

A rule gives the daughters of a cell as they are at the end of the step. What they were at birth follows from the age at which
the rule began to apply.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from lsys_kit.budget import check_budget, current
from lsys_kit.derivation.core.interpretation import is_cell, is_filament
from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.timed.ages import age_model
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.modules import Module, flat
from lsys_kit.notation.model.system import LSystem

MOST_CELLS, MOST_PARTS, MOST_FOLLOWED = 100_000, 10_000, 1_000_000
"""A lineage has at most so many cells; a module is decomposed into so many in a step, all modules together into so many."""
MOST_DEPTH = 200
"""The most decompositions of what a decomposition made."""


@dataclass(frozen=True)
class LineageCell:
    """One cell of a lineage, from its birth to its division.

    Attributes
    ----------
    mother
        The number of the cell that it comes from, or None.
    born
        When.
    at_birth
        The module that it was then.
    ended
        When it divided or died; None where it is alive at the end.
    due
        When it should have divided, where that is before `ended`, or before the end.
    modules
        What it is in the words that have it, by their steps.
    """

    mother: int | None
    born: Value
    at_birth: Module
    ended: Value | None = None
    due: Value | None = None
    modules: tuple[tuple[int, Module], ...] = ()


@dataclass(frozen=True)
class CellPart:
    """What becomes of a module within a step.

    Attributes
    ----------
    module, at_birth
        What it is at the step's end, and what it was when it came to be.
    parts
        What it is replaced by; None where it is there at the step's end.
    ago
        How long before the step's end it was replaced; None where nothing says so.
    """

    module: Module
    at_birth: Module
    parts: tuple[CellPart, ...] | None = None
    ago: Value | None = None


class CellDivisions:
    """What becomes of each state within a step, with what comes and goes in between."""

    def __init__(self, states: States) -> None:
        self.states, self.ages = states, age_model(states)
        self._known: dict[int, CellPart] = {}
        self._parts = 0

    def of(self, state: int) -> CellPart:
        """What becomes of a state that alone decides it."""
        if state not in self._known:
            self._parts = 0
            module, rule = self.states.modules[state], self.states.rule(state)
            self._known[state] = self._replaced(module, module, rule, 0) if rule else self._decomposed(module, module, 0)
        return self._known[state]

    def _replaced(self, module: Module, at_birth: Module, rule: Rule, depth: int) -> CellPart:
        """A module with the parts by which a rule replaces it, as they are now and as they were at first."""
        made = self.ages.made(rule, module)
        age = self.ages.age(module)
        threshold = self.ages.applies_from(rule, module) if age is not None and self.ages.carries(rule) else None
        if age is None or threshold is None:
            return CellPart(module, at_birth, tuple(self._decomposed(part, part, depth) for part in made))
        first = self.ages.made(rule, self.ages.aged(module, threshold))
        parts = tuple(self._decomposed(part, was, depth) for part, was in zip(made, first, strict=True))
        return CellPart(module, at_birth, parts, age - threshold)

    def _decomposed(self, module: Module, at_birth: Module, depth: int) -> CellPart:
        """A module with its parts, and theirs."""
        check_budget()
        self._parts += 1
        if self._parts > MOST_PARTS or depth > min(current().decomposition, MOST_DEPTH):
            raise ModelLimitError(
                f"{module} is decomposed into too many modules for a lineage",
                limit=MOST_PARTS,
                hint="A condition before the arrow can bring it to an end.",
            )
        rule = (
            None
            if depth == self.states.system.decomposition_depth
            else self.states.matching_rule(module, self.states.decomposition)
        )
        return CellPart(module, at_birth) if rule is None else self._replaced(module, at_birth, rule, depth + 1)


class CellGrowth:
    """A lineage that is assembled step by step."""

    def __init__(self, states: States) -> None:
        self.cells: list[LineageCell] = []
        self.places: list[int | None] = []  # the cell of each module of the word
        self._modules: list[list[tuple[int, Module]]] = []  # for each cell what it is in the words that have it
        self._parts = 0
        self._kinds = cell_kinds(states.system)

    def is_cell(self, module: Module) -> bool:
        """Whether a module is a cell."""
        return kind_of(module) in self._kinds if self._kinds else module.symbol[0].isalpha()

    def born(self, mother: int | None, moment: Value, module: Module) -> int:
        """A new cell's number."""
        if len(self.cells) == MOST_CELLS:
            raise ModelLimitError(f"A lineage may have {MOST_CELLS:,} cells", limit=MOST_CELLS, hint="Take an earlier time.")
        self.cells.append(LineageCell(mother, moment, module))
        self._modules.append([])
        return len(self.cells) - 1

    def found(self, owner: int | None, step: int, module: Module) -> None:
        """A module of the word of a step."""
        self.places.append(owner)
        if owner is not None:
            self._modules[owner].append((step, module))

    def finished(self) -> tuple[LineageCell, ...]:
        """All cells, each with what it is in the words that have it."""
        return tuple(replace(cell, modules=tuple(modules)) for cell, modules in zip(self.cells, self._modules, strict=True))

    def follow(self, part: CellPart, owner: int | None, step: int, span: tuple[Value, Value]) -> None:
        """What becomes of a cell within a step that lasts from one time to another."""
        check_budget()
        self._parts += 1
        if self._parts > MOST_FOLLOWED:
            raise ModelLimitError(
                f"More than {MOST_FOLLOWED:,} modules come and go in the steps of this lineage",
                limit=MOST_FOLLOWED,
                hint="Take fewer steps.",
            )
        if part.parts is None:
            self.found(owner, step, part.module)
            return
        cells, moment = sum(self.is_cell(each.module) for each in part.parts), span[1]
        if owner is not None and cells != 1:
            moment = self._ends(owner, part.ago, span)
        for each in part.parts:
            if not self.is_cell(each.module):
                number = None
            elif owner is not None and cells == 1:
                number = owner
            else:
                number = self.born(owner, moment, each.at_birth)
            self.follow(each, number, step, span)

    def _ends(self, owner: int, ago: Value | None, span: tuple[Value, Value]) -> Value:
        """When a cell divides or dies: not before it is born, and not before the step begins, in whose word it still is."""
        due = normalised(span[1] - (ago or 0))
        moment = max(due, span[0], self.cells[owner].born)
        self.cells[owner] = replace(self.cells[owner], ended=moment, due=due if due < moment else None)
        return moment

    def overdue(self, part: CellPart, end: Value) -> Value | None:
        """When a cell should have divided that has not by a time, given what would become of it in a step from then on."""
        while part.parts is not None:
            cells = [each for each in part.parts if self.is_cell(each.module)]
            if len(cells) != 1:
                return normalised(end - part.ago) if part.ago is not None else None
            part = cells[0]
        return None


def cell_kinds(system: LSystem) -> frozenset[ModuleKind]:
    """The symbols and numbers of parameters of what is drawn as cells; none where the system is no filament."""
    if not is_filament(system):
        return frozenset()
    return frozenset(kind_of(rule.predecessor) for rule in system.interpretation if any(map(is_cell, flat(rule.successor))))
