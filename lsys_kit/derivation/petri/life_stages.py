"""Lives: the stretches into which the ages at which modules begin part the lives of modules that grow older.

Where a long cell begins at the age at which a short one has become as long, as in seed 002, the life of a short cell has two
stretches: a module that has reached the second is a long cell. So every module lies in just one stretch, whatever its age.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise
from typing import TypeAlias

from lsys_kit.derivation.core.rules import Rule, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.petri.outcomes import Outcome
from lsys_kit.derivation.timed.ages import AgeModel, age_model
from lsys_kit.derivation.timed.timed import Timed
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.system import Module
from lsys_kit.notation.write import as_written

End: TypeAlias = tuple[Rule, Value] | None
"""The rule by which a module ends, and at which age; None where it lives for ever."""
_Kind: TypeAlias = tuple[str, tuple[object, ...]]
"""A symbol with all values but the age."""
_Ages: TypeAlias = Sequence[Value]


@dataclass(frozen=True)
class AgeingStates:
    """How the modules of a system grow older, and how they end.

    Attributes
    ----------
    states
        The table of its modules.
    age_at
        Which parameter of a module is its age, from 0; None where it has none.
    end
        How a module ends.
    """

    states: States
    age_at: Callable[[Module], int | None]
    end: Callable[[Module], End]

    def parted(self, module: Module) -> tuple[_Kind, Value]:
        """A module's symbol and other values, and its age; 0 where it has none."""
        at, values = self.age_at(module), module.arguments
        return ((module.symbol, values), 0) if at is None else (
            (module.symbol, values[:at] + values[at + 1:]), values[at])  # type: ignore[return-value]

    def aged(self, module: Module, age: Value) -> Module:
        """A module at another age."""
        at, values = self.age_at(module), module.arguments
        return module if at is None else Module(module.symbol, (*values[:at], age, *values[at + 1:]))

    def daughters(self, module: Module) -> list[Module]:
        """What a module becomes in the end: its daughters at their first ages."""
        end = self.end(module)
        return [] if end is None else [Module(*made) for made in self.states.made(end[0], self.aged(module, end[1]))]


def ageing_in_time(system: Timed) -> AgeingStates:
    """A timed system."""
    def end(module: Module) -> End:
        found = system.at_end(module)
        rule = system.states.rules.get(kind_of(module), (None,))[0]
        return None if found is None or rule is None else (rule, found.arguments[0])  # type: ignore[return-value]

    return AgeingStates(system.states, lambda module: 0 if module.arguments else None, end)


def ageing_in_steps(states: States) -> AgeingStates:
    """A system whose productions let time pass, and whose decomposition rules say at which age a module divides.

    Raises
    ------
    ModelValueError
        A production does anything else.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> cells = read("axiom: M(0)\\nM(t) -> M(t+1)\\ndecomposition:\\nM(t) : t >= 3 -> M(t-3) M(t-2)")
    >>> found = ageing_in_steps(States(cells))
    >>> str(found.end(Module("M", (0,)))[1]), list(map(str, found.daughters(Module("M", (0,)))))
    ('3', ['M(0)', 'M(1)'])
    """
    ageing = age_model(states)
    for rules in states.rules.values():
        for rule in rules:
            if not _lets_time_pass(rule, ageing):
                start, end = rule.production.at or (None, None)
                shown = as_written(states.system, rule.production)
                said = f"How long a module lives is not told where {shown} does more than let time pass"
                raise ModelValueError(said, states.system.source or None, start, end,
                                      'It is told by productions such as "a(t) -> a(t+dt)" and decomposition rules such as '
                                      '"a(t) : t > 1 -> b(t-1)"; and by those of timed(system).')
    return AgeingStates(states, lambda module: ageing.parameters.get(kind_of(module)), partial(_decomposed, ageing))


def _lets_time_pass(rule: Rule, ageing: AgeModel) -> bool:
    """Whether all that a rule does is make a module of some kind older."""
    made = rule.production.successor
    return (rule.d0l and rule.condition is None and not rule.equalities and len(made) == 1
            and isinstance(made[0], Module) and kind_of(made[0]) == kind_of(rule.production.predecessor) in ageing.parameters)


def _decomposed(ageing: AgeModel, module: Module) -> End:
    """The decomposition rule that is the first to apply as a module grows older, and the age from which on it does."""
    found: list[tuple[Value, int, Rule]] = []
    for rule in ageing.states.decomposition.get(kind_of(module), ()):
        age = ageing.applies_from(rule, module)
        if age is not None:
            older = ageing.aged(module, age + 1)
            if ageing.states.holds(rule, older.arguments, module):  # type: ignore[arg-type]
                found.append((age, rule.number, rule))
    return (min(found)[2], min(found)[0]) if found else None


@dataclass(frozen=True)
class LifeStages:
    """The stretches of all lives.

    Attributes
    ----------
    modules
        For each stretch its module at its first age.
    fates
        For each stretch what it becomes, and after how long: the next stretch, or the daughters.
    """

    growing: AgeingStates
    modules: tuple[Module, ...]
    fates: tuple[tuple[Outcome, ...], ...]
    _first: Mapping[_Kind, tuple[int, _Ages]] = field(repr=False)

    def stretch(self, module: Module) -> int | None:
        """The number of the stretch in which a module is at its age."""
        kind, age = self.growing.parted(module)
        if kind not in self._first:
            return None
        number, ages = self._first[kind]
        return number + max(0, bisect_right(ages, age) - 1)


def life_stages(growing: AgeingStates, limit: int) -> LifeStages:
    """The stretches of all lives.

    Raises
    ------
    ModelLimitError
        They are more than `limit`.
    ModelValueError
        An age is not known, or a module begins older than it divides.

    Examples
    --------
    >>> from lsys_kit.derivation.timed.timed import timed
    >>> from lsys_kit.notation.read import read
    >>> found = life_stages(ageing_in_time(timed(read("axiom: M(0)\\nM(1) -> M(0) M(1/5)"))), 9)
    >>> for module, (fate,) in zip(found.modules, found.fates):
    ...     print(module, fate.span, *(found.modules[state] for state in fate.successor))
    M(0) 1/5 M(0.2)
    M(0.2) 4/5 M(0) M(0.2)
    """
    try:
        return _stretched(growing, _first_ages(growing, limit))
    except TypeError:
        raise ModelValueError("How long a module lives depends on a constant that is not known",
                              hint="Choose a value for it.") from None


def _first_ages(growing: AgeingStates, limit: int) -> dict[_Kind, dict[Value, Module]]:
    """For each kind of module those that begin, by their age."""
    found: dict[_Kind, dict[Value, Module]] = {}
    todo = [growing.states.modules[state] for state in growing.states.axiom][::-1]
    while todo:
        module = todo.pop()
        kind, age = growing.parted(module)
        if age in found.setdefault(kind, {}):
            continue
        found[kind][age] = module
        if sum(map(len, found.values())) > limit:
            raise ModelLimitError(f"Modules begin at more than {limit} different ages", limit=limit,
                                  hint="Let daughters begin at ages that do not depend on their mother's.")
        todo += growing.daughters(module)[::-1]
    return found


def _stretched(growing: AgeingStates, first: Mapping[_Kind, Mapping[Value, Module]]) -> LifeStages:
    ages: dict[_Kind, tuple[int, _Ages]] = {}
    modules: list[Module] = []
    for kind, begun in first.items():
        mortal = growing.end(next(iter(begun.values()))) is not None
        ages[kind] = len(modules), sorted(begun)[:None if mortal else 1]
        modules += [begun[age] for age in ages[kind][1]]
    found = LifeStages(growing, tuple(modules), (), ages)
    fates: list[tuple[Outcome, ...]] = []
    for number, row in ages.values():
        fates += [(Outcome(None, (later,), 1, after - age),) for later, (age, after) in enumerate(pairwise(row), number + 1)]
        fates.append(_last(found, modules[len(fates)], row[-1]))
    return LifeStages(growing, found.modules, tuple(fates), ages)


def _last(found: LifeStages, module: Module, age: Value) -> tuple[Outcome, ...]:
    """What becomes of a module in its last stretch."""
    end = found.growing.end(module)
    if end is None:
        return ()
    if end[1] < age:
        raise ModelValueError(f"{module} begins older than it divides, at the age {number_text(end[1])}")
    daughters = (found.stretch(daughter) for daughter in found.growing.daughters(module))
    return (Outcome(end[0].number, tuple(row for row in daughters if row is not None), 1, end[1] - age),)
