"""Life stages: the lives of ageing modules, divided at the ages at which modules are born.

Where a long cell is born at the age at which a short one has become as long, as in Prusinkiewicz (Introduction to Modeling with
L-systems, section 6), the life of a short cell has two stages: in the second it is a long cell. So every module is in exactly
one stage, whatever its age.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter

from lsys_kit.derivation.petri.outcomes import Outcome
from lsys_kit.derivation.timed.ages import AgelessModule, AgeModel, births
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.modules import Module


@dataclass(frozen=True)
class LifeStages:
    """The stages of all lives.

    Attributes
    ----------
    ages
        How the modules grow older.
    modules
        The module of each stage at its first age.
    outcomes
        For each stage what it becomes, and after how long: the next stage, or the daughters.
    """

    ages: AgeModel
    modules: tuple[Module, ...]
    outcomes: tuple[tuple[Outcome, ...], ...]
    _first: Mapping[AgelessModule, Mapping[Value, tuple[int, Sequence[Value]]]] = field(repr=False)

    def stage(self, module: Module) -> int | None:
        """The number of the stage in which a module is at its age; None where it cannot be at that age."""
        phases, age = self._first.get(self.ages.ageless(module), {}), self.ages.age(module) or 0
        found = next(iter(phases.values())) if len(phases) == 1 else phases.get(self.ages.phase(age))
        return None if found is None else found[0] + max(0, bisect_right(found[1], age) - 1)

    @property
    def is_late(self) -> bool:
        """Whether lives are shorter than the steps in which they are derived, so that they end later there."""
        return any(map(self.ages.is_late, self.modules))


def life_stages(ages: AgeModel, limit: int, look: Callable[[Module], Hashable] = lambda module: module) -> LifeStages:
    """The stages of all lives.

    Parameters
    ----------
    ages
        How the modules grow older.
    limit
        How many stages there may be.
    look
        What a module looks like: lives of modules that look alike are divided at the same ages.

    Raises
    ------
    ModelLimitError
        They are more than `limit`.
    ModelValueError
        An age is not known, or a module is born older than it divides.

    Examples
    --------
    >>> from lsys_kit.derivation.timed.timed import timed
    >>> from lsys_kit.notation.read import read
    >>> found = life_stages(timed(read("axiom: M(0)\\nM(1) -> M(0) M(1/5)")).ages, 9)
    >>> for module, (outcome,) in zip(found.modules, found.outcomes):
    ...     print(module, outcome.span, *(found.modules[state] for state in outcome.successor))
    M(0) 1/5 M(0.2)
    M(0.2) 4/5 M(0) M(0.2)
    """
    try:
        first = births(ages, limit)
        _divide_alike(ages, first, look)
        return _divided_lives(ages, first)
    except TypeError:
        raise ModelValueError(
            "How long a module lives depends on a constant that is not known", hint="Choose a value for it."
        ) from None


def _divide_alike(
    ages: AgeModel, first: Mapping[AgelessModule, Mapping[Value, dict[Value, Module]]], look: Callable[[Module], Hashable]
) -> None:
    """Let lives begin a stage where those of modules that look alike do."""
    rows = [born for phases in first.values() for born in phases.values()]
    begun = [(age, module, look(module)) for born in rows for age, module in born.items()]
    for born in rows:
        youngest = born[min(born)]
        for age, module, seen in begun:
            end, other = ages.end(youngest), ages.aged(youngest, age)
            if (
                age not in born
                and min(born) < age
                and ages.phase(age) == ages.phase(min(born))
                and other != module
                and end is not None
                and end.rule is not None
                and age < end.age
                and look(other) == seen
            ):
                born[age] = other


def _divided_lives(ages: AgeModel, first: Mapping[AgelessModule, Mapping[Value, Mapping[Value, Module]]]) -> LifeStages:
    rows: dict[AgelessModule, dict[Value, tuple[int, Sequence[Value]]]] = {}
    modules: list[Module] = []
    for kind, phases in first.items():
        for phase, born in phases.items():
            mortal = any(_is_mortal(ages, module) for module in born.values())
            rows.setdefault(kind, {})[phase] = len(modules), sorted(born)[: None if mortal else 1]
            modules += [born[age] for age in rows[kind][phase][1]]
    found = LifeStages(ages, tuple(modules), (), rows)
    outcomes: list[tuple[Outcome, ...]] = []
    for number, row in (part for phases in rows.values() for part in phases.values()):
        outcomes += [
            _outcomes(found, number + at, age, row[at + 1] if at + 1 < len(row) else None) for at, age in enumerate(row)
        ]
    _check_time_passes(modules, outcomes)
    return LifeStages(ages, found.modules, tuple(outcomes), rows)


def _check_time_passes(modules: Sequence[Module], outcomes: Sequence[Sequence[Outcome]]) -> None:
    """Refuse modules that lead back to themselves in no time."""
    at_once = {
        number: [state for outcome in ways if outcome.span == 0 for state in outcome.successor]
        for number, ways in enumerate(outcomes)
    }
    try:
        TopologicalSorter(at_once).prepare()
    except CycleError as found:
        raise ModelValueError(
            f"{modules[found.args[1][0]]} divides endlessly within one instant",
            hint="Let a daughter begin younger than the age at which she divides.",
        ) from None


def _is_mortal(ages: AgeModel, module: Module) -> bool:
    end = ages.end(module)
    return end is not None and end.rule is not None


def _outcomes(found: LifeStages, number: int, age: Value, later: Value | None) -> tuple[Outcome, ...]:
    """What becomes of a stage: the next one, which begins at a later age, if its life lasts so long; else the daughters."""
    module = found.modules[number]
    found.ages.check_birth(module)
    end = found.ages.end(module)
    if end is None or end.rule is None:
        return ()
    if later is not None and later < end.age:
        return (Outcome(None, (number + 1,), 1, normalised(later - age)),)
    daughters = (found.stage(daughter) for daughter in found.ages.daughters(module))
    return (Outcome(end.rule.number, tuple(row for row in daughters if row is not None), 1, normalised(end.age - age)),)
