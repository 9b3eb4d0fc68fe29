"""Lineages: which cell comes from which, and when each divides (P. Prusinkiewicz, Introduction to Modeling with L-systems,
figures 5 and 6).

A step leads from one word to the next, but events within it have times of their own. Where a cell's age grows with time and a
condition such as `t >= t_div` says at which age it divides, the age that it would have by the step's end tells how long ago it
divided. So the lineage has a place in continuous time, however long the steps are; and it shows where a division is late,
because the productions let a cell divide only once in a step.

A rule gives the daughters of a cell as they are at the end of the step. What they were at birth follows from the age at which
the rule began to apply.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from lsys_kit.budget import Task, check_budget, current
from lsys_kit.derivation.core.interpretation import is_cell, is_filament
from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of, number_from
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Choices, Derivation, derive
from lsys_kit.derivation.timed.ages import age_model
from lsys_kit.derivation.timed.timed import Timed
from lsys_kit.errors import ModelLimitError, ModelValueError, whole_number
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.notation.model.modules import Module, flat
from lsys_kit.notation.model.system import LSystem

MOST_CELLS, MOST_PARTS, MOST_FOLLOWED = 100_000, 10_000, 1_000_000
"""A lineage has at most so many cells; a module is decomposed into so many in a step, all modules together into so many."""
MOST_DEPTH = 200
"""The most decompositions of what a decomposition made."""


@dataclass(frozen=True)
class LineageCell:
    """One cell of a lineage, from its birth to its division: the number of its mother, if it has one; when it was born, and the
    module that it was then; when it divided or died, if it is not alive at the end; when it should have divided, where that is
    before; and what it is in the words that have it, by their steps."""

    mother: int | None
    born: Value
    at_birth: Module
    ended: Value | None = None
    due: Value | None = None
    modules: tuple[tuple[int, Module], ...] = ()


@dataclass(frozen=True)
class CellPart:
    """What becomes of a module within a step: what it is at the step's end, and what it was when it came to be; what it is
    replaced by (None where it is there at the step's end), and how long before the end that was, if anything says so."""

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
        self._kinds, self._signs = cell_kinds(states.system), dividing_signs(states.system)

    def is_cell(self, module: Module) -> bool:
        """Whether a module is a cell."""
        if self._kinds:
            return kind_of(module) in self._kinds
        return module.symbol[0].isalpha() or module.symbol in self._signs

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


def dividing_signs(system: LSystem) -> frozenset[str]:
    """The symbols without letters of which letters come, as `*` in GROGRA.

    >>> from lsys_kit.notation.read import read
    >>> sorted(dividing_signs(read("axiom: F + !\\n+ -> -\\n! -> ! F")))
    ['!']
    """
    rules = (*system.productions, *system.decomposition)
    return frozenset(
        rule.predecessor.symbol
        for rule in rules
        if not rule.predecessor.symbol[0].isalpha() and any(made.symbol[0].isalpha() for made in flat(rule.successor))
    )


def cell_kinds(system: LSystem) -> frozenset[ModuleKind]:
    """The symbols and numbers of parameters of what is drawn as cells; none where the system is no filament."""
    if not is_filament(system):
        return frozenset()
    return frozenset(kind_of(rule.predecessor) for rule in system.interpretation if any(map(is_cell, flat(rule.successor))))


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
    >>> from lsys_kit import read
    >>> ageing = read("dt = 1.4\\naxiom: M(0)\\nM(t) -> M(t+dt)\\ndecomposition:\\nM(t) : t >= 1 -> M(t-1) M(t-0.8)")
    >>> tree = lineage(ageing, 2)
    >>> tree, [float(time) for time in tree.divisions]
    (7 cells at time 2.8, after 6 divisions, [1.0, 1.8, 2.0, 2.6, 2.8, 2.8])

    See P. Prusinkiewicz, Introduction to Modeling with L-systems, sections 5 and 6, figures 5 and 6.
    """
    with Task("The lineage was not found"):
        if isinstance(what, LSystem):
            steps: Any = n if n is not None else what.steps if what.steps is not None else 5
            given: Choices = constants
            start = derive(what, 0, seed=seed, arithmetic=arithmetic, **given)
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
