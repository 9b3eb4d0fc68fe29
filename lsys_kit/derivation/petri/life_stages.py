"""Life stages: the lives of ageing modules, divided at the ages at which modules are born.

Where a long cell is born at the age at which a short one has become as long, as in Prusinkiewicz (Introduction to Modeling with
L-systems, section 6), the life of a short cell has two stages: in the second it is a long cell. So every module is in exactly
one stage, whatever its age.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from lsys_kit.derivation.core.rules import Rule, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.petri.outcomes import Outcome
from lsys_kit.derivation.timed.ages import AgelessModule, AgeModel, age_model
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.write import as_written


def ages_in_steps(states: States) -> AgeModel:
    """The ages of a system whose productions let time pass, and whose decomposition rules say at which age a module divides.

    Raises
    ------
    ModelValueError
        A production does anything else.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> cells = read("axiom: M(0)\\nM(t) -> M(t+1)\\ndecomposition:\\nM(t) : t >= 3 -> M(t-3) M(t-2)")
    >>> list(map(str, ages_in_steps(States(cells)).daughters(Module("M", (0,)))))
    ['M(0)', 'M(1)']
    """
    ages = age_model(states)
    for rules in states.rules.values():
        for rule in rules:
            if not _lets_time_pass(rule, ages):
                start, end = rule.production.at or (None, None)
                shown = as_written(states.system, rule.production)
                raise ModelValueError(f"How long a module lives cannot be told, since {shown} does more than let time pass",
                                      states.system.source or None, start, end,
                                      'Productions such as "a(t) -> a(t+dt)" with decomposition rules such as '
                                      '"a(t) : t > 1 -> b(t-1)" tell it; so do the productions of timed(system).')
    return ages


def _lets_time_pass(rule: Rule, ages: AgeModel) -> bool:
    """Whether all that a rule does is make a module of some kind older."""
    made = rule.production.successor
    return (rule.d0l and rule.condition is None and not rule.equalities and len(made) == 1 and isinstance(made[0], Pattern)
            and kind_of(made[0]) == kind_of(rule.production.predecessor) and ages.parameter(kind_of(made[0])) is not None)


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
    _first: Mapping[AgelessModule, tuple[int, Sequence[Value]]] = field(repr=False)

    def stage(self, module: Module) -> int | None:
        """The number of the stage in which a module is at its age."""
        kind, age = self.ages.ageless(module), self.ages.age(module) or 0
        if kind not in self._first:
            return None
        number, row = self._first[kind]
        return number + max(0, bisect_right(row, age) - 1)


def life_stages(ages: AgeModel, limit: int) -> LifeStages:
    """The stages of all lives.

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
        return _divided_lives(ages, _first_ages(ages, limit))
    except TypeError:
        raise ModelValueError("How long a module lives depends on a constant that is not known",
                              hint="Choose a value for it.") from None


def _first_ages(ages: AgeModel, limit: int) -> dict[AgelessModule, dict[Value, Module]]:
    """For each kind of module those that are born, by their age."""
    found: dict[AgelessModule, dict[Value, Module]] = {}
    todo = [ages.states.modules[state] for state in ages.states.axiom][::-1]
    while todo:
        module = todo.pop()
        kind, age = ages.ageless(module), ages.age(module) or 0
        if age in found.setdefault(kind, {}):
            continue
        found[kind][age] = module
        if sum(map(len, found.values())) > limit:
            raise ModelLimitError(f"Modules are born at more than {limit} different ages", limit=limit,
                                  hint="Let the ages of daughters at birth not depend on the age of their mother.")
        todo += ages.daughters(module)[::-1]
    return found


def _divided_lives(ages: AgeModel, first: Mapping[AgelessModule, Mapping[Value, Module]]) -> LifeStages:
    rows: dict[AgelessModule, tuple[int, Sequence[Value]]] = {}
    modules: list[Module] = []
    for kind, begun in first.items():
        mortal = ages.end(next(iter(begun.values()))) is not None
        rows[kind] = len(modules), sorted(begun)[:None if mortal else 1]
        modules += [begun[age] for age in rows[kind][1]]
    found = LifeStages(ages, tuple(modules), (), rows)
    outcomes: list[tuple[Outcome, ...]] = []
    for number, row in rows.values():
        outcomes += [(Outcome(None, (later,), 1, after - age),)
                     for later, (age, after) in enumerate(pairwise(row), number + 1)]
        outcomes.append(_last(found, modules[len(outcomes)], row[-1]))
    return LifeStages(ages, found.modules, tuple(outcomes), rows)


def _last(found: LifeStages, module: Module, age: Value) -> tuple[Outcome, ...]:
    """What becomes of a module in its last stage."""
    end = found.ages.end(module)
    if end is None:
        return ()
    if end[1] < age:
        raise ModelValueError(f"{module} is born older than it divides, at the age {number_text(end[1])}")
    daughters = (found.stage(daughter) for daughter in found.ages.daughters(module))
    return (Outcome(end[0].number, tuple(row for row in daughters if row is not None), 1, end[1] - age),)
