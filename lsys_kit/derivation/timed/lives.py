"""Lives: how modules grow older, and how their lives end."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import islice
from typing import NamedTuple, TypeAlias

from lsys_kit.budget import check_budget, current
from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of
from lsys_kit.derivation.core.states import States, rule_error
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import Production

AgelessModule: TypeAlias = tuple[str, tuple[object, ...]]
"""A symbol with all values but the age."""


class End(NamedTuple):
    """How a module's life ends.

    Attributes
    ----------
    rule
        The rule that replaces it; None where it stays as it is from then on.
    age
        At which age.
    mother
        The module that the rule replaces, as it is when the rule applies.
    already
        Whether it is replaced at just that age, and not only beyond it.
    """

    rule: Rule | None
    age: Value
    mother: Module
    already: bool


@dataclass(frozen=True)
class AgeModel(ABC):
    """How the modules of a system grow older, and how their lives end.

    Attributes
    ----------
    states
        The table of its modules.
    parameter
        From a symbol and a number of parameters to the parameter that is the age, from 0; None where there is none.
    step
        How long a step takes; None where nothing says so, and in a timed system.
    """

    states: States
    parameter: Callable[[ModuleKind], int | None]
    step: Value | None
    _ends: dict[tuple[object, ...], End | None] = field(default_factory=dict, compare=False, repr=False)

    def age(self, module: Module) -> Value | None:
        """A module's age; None where it has none."""
        at = self.parameter(kind_of(module))
        return None if at is None else module.arguments[at]

    def aged(self, module: Module, age: Value) -> Module:
        """A module at another age; itself, where it has none."""
        at, values = self.parameter(kind_of(module)), module.arguments
        return module if at is None else Module(module.symbol, (*values[:at], age, *values[at + 1 :]))

    def ageless(self, module: Module) -> AgelessModule:
        """A module without its age."""
        at, values = self.parameter(kind_of(module)), module.arguments
        return module.symbol, values if at is None else values[:at] + values[at + 1 :]

    def phase(self, _age: Value) -> Value:
        """What distinguishes modules of different ages that never reach the same age; 0 where time passes evenly."""
        return 0

    def is_late(self, _module: Module) -> bool:
        """Whether deriving in steps ends a module's life later than that."""
        return False

    def end(self, module: Module) -> End | None:
        """How a module's life ends as it grows older; None where it lives for ever.

        >>> from lsys_kit.derivation.timed.ages import age_model
        >>> from lsys_kit.notation.read import read
        >>> cells = States(read("axiom: M(0)\\nM(t) -> M(t+1)\\ndecomposition:\\nM(t) : t >= 3 -> M(t-3) M(t-2)"))
        >>> age_model(cells).end(Module("M", (0,))).age
        3
        """
        key = (module.symbol, module.arguments, *map(type, module.arguments))
        if key not in self._ends:
            self._ends[key] = self._found_end(module)
        return self._ends[key]

    @abstractmethod
    def _found_end(self, module: Module) -> End | None:
        """How a module's life ends."""

    def daughters(self, module: Module) -> list[Module]:
        """What a module becomes at the end of its life: its daughters at their first ages; none, where it lives for ever."""
        end = self.end(module)
        return [] if end is None or end.rule is None else self.made(end.rule, end.mother)

    def made(self, rule: Rule, module: Module) -> list[Module]:
        """What a rule makes of a module, before any of that is decomposed.

        Raises
        ------
        ModelLimitError
            That is more than anything may be repeated.
        """
        most = current().repetitions
        found = [Module(*part) for part in islice(self.states.apply(rule, module), most + 1)]
        if len(found) > most:
            start, end = rule.production.at or (None, None)
            raise ModelLimitError(
                f"{module} becomes more than {most:,} modules at once",
                limit=most,
                source=self.states.system.source or None,
                start=start,
                end=end,
                hint="Use smaller numbers of repetitions.",
            )
        return found

    def check_birth(self, module: Module) -> None:
        """Refuse a module that is born older than it can become."""
        end, age = self.end(module), self.age(module) or 0
        if end is None or end.rule is None:
            return
        try:
            older = bool(end.age < age)
        except TypeError:
            raise undecided_age(self.states, module, end.rule.production) from None
        if older:
            raise ModelValueError(f"{module} is born older than it divides, at the age {number_text(end.age)}")


@dataclass(frozen=True)
class TimedAges(AgeModel):
    """The ages of a timed system: the first parameter is the age, and productions end lives beyond the ages that they name."""

    def _found_end(self, module: Module) -> End | None:
        found: list[tuple[Value, int, Rule]] = []
        for rule in self.states.rules.get(kind_of(module), ()):
            ((_, asked),) = rule.equalities
            try:
                found.append((asked((*module.arguments, *self.states.constants)), rule.number, rule))
            except (ArithmeticError, ValueError) as fault:
                raise rule_error(self.states.system, module, rule, fault) from None
            except TypeError:
                raise undecided_age(self.states, module, rule.production) from None
        if not found:
            return None
        try:
            age, _, rule = min(found)
        except TypeError:
            raise undecided_age(self.states, module, found[0][2].production) from None
        return End(rule, age, self.aged(module, age), False)


def births(ages: AgeModel, limit: int) -> dict[AgelessModule, dict[Value, dict[Value, Module]]]:
    """For each kind of module, and each phase, those that are born, by their age."""
    found: dict[AgelessModule, dict[Value, dict[Value, Module]]] = {}
    todo = [ages.states.modules[state] for state in ages.states.axiom][::-1]
    while todo:
        check_budget()
        module = todo.pop()
        age = ages.age(module) or 0
        born = found.setdefault(ages.ageless(module), {}).setdefault(ages.phase(age), {})
        if age in born:
            continue
        born[age] = module
        if sum(len(others) for phases in found.values() for others in phases.values()) > limit:
            raise ModelLimitError(
                f"Modules are born at more than {limit} different ages",
                limit=limit,
                hint="Let the ages of daughters at birth not depend on the age of their mother.",
            )
        todo += dict.fromkeys(ages.daughters(module)[::-1])
    return found


def undecided_age(states: States, module: Module, production: Production) -> ModelValueError:
    """The age at which a module divides depends on a constant that is not known."""
    values = (*states.constants, *module.arguments)
    names = sorted({str(name) for value in values for name in getattr(value, "free_symbols", ())})
    start, end = production.at or (None, None)
    return ModelValueError(
        f"The age at which {module} becomes what {production} says cannot be decided",
        states.system.source or None,
        start,
        end,
        f"It depends on {', '.join(names)}: choose a value for {names[0]}." if names else None,
    )
