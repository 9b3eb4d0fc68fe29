"""Ages: which parameter of a module grows with time, by how much in a step, and at which age its life ends.

This is the one model of ageing. Two kinds of systems have ages. In a system of steps a production `M(t,p) -> M(t+dt,p)` says
that t is an age and that a step takes the time dt (`t+1`: one unit of time); the conditions of the other rules, such as
`t >= t_div`, say from which age on they apply. In a timed system the first parameter is the age, and a production
`a(1) -> b(0) a(0)` says at which age a module ends. Words at any time, lineages, life stages and continuity all use this.

In a system of steps a life ends in one of two ways. Where the daughters' ages tell how long ago the division was, as in
`M(t) : t >= 1 -> M(t-1) M(t-0.8)`, a mother divides at just the age of 1, however long the steps are. A production applies at
the beginning of a step, and its daughters are there at the end; a decomposition rule applies at the end. Where the daughters'
ages do not tell that, as in `A(3) -> A(1) B(1)`, a life lasts whole steps: it ends with the first step in which a rule replaces
the module. If one rule is of the second kind, all lives are measured in steps, which is right for rules of both kinds.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NoReturn, TypeAlias

from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of
from lsys_kit.derivation.core.states import States, rule_error
from lsys_kit.derivation.timed.lives import AgelessModule as AgelessModule
from lsys_kit.derivation.timed.lives import AgeModel as AgeModel
from lsys_kit.derivation.timed.lives import End as End
from lsys_kit.derivation.timed.lives import TimedAges, undecided_age
from lsys_kit.derivation.timed.lives import births as births
from lsys_kit.derivation.timed.thresholds import AgeTerms, is_pointwise, unit_slope
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.arithmetic import Value, is_symbolic, normalised
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, function_of, names_in
from lsys_kit.notation.model.modules import Module, Pattern, Repeat, flat
from lsys_kit.notation.model.system import Production
from lsys_kit.notation.write import as_written

Fate: TypeAlias = tuple[Rule | None, Value]
"""What becomes of a module that does not grow older: the rule that replaces it, and how long that takes."""


@dataclass(frozen=True)
class StepAges(AgeModel):
    """The ages of a system of steps."""

    @cached_property
    def growing(self) -> frozenset[int]:
        """The numbers of the productions that do nothing but let time pass."""
        return frozenset(
            rule.number
            for rules in self.states.rules.values()
            for rule in rules
            if _grows(rule.production, self.parameter(kind_of(rule.production.predecessor)))
        )

    @property
    def tells_ends(self) -> bool:
        """Whether modules grow older, and some rule does more than that."""
        return self.step is not None and bool(self._ending)

    @cached_property
    def _ending(self) -> list[Rule]:
        """The rules that do more than let time pass."""
        rules = [rule for rules in self.states.rules.values() for rule in rules if rule.number not in self.growing]
        return [*rules, *(rule for rules in self.states.decomposition.values() for rule in rules)]

    @cached_property
    def even(self) -> bool:
        """Whether daughters always take over the time that has passed since they were born, so that steps do not matter."""
        return all(map(self.carries, self._ending))

    def carries(self, rule: Rule) -> bool:
        """Whether a rule lets the daughters be older the longer ago the mother has reached the age at which it applies."""
        if id(rule) not in self._carried:
            self._carried[id(rule)] = self._carries(rule)
        return self._carried[id(rule)]

    @cached_property
    def _carried(self) -> dict[int, bool]:
        return {}

    def _carries(self, rule: Rule) -> bool:
        made = list(flat(rule.production.successor))
        ages = [self.parameter(kind_of(module)) for module in made]
        at = self.parameter(kind_of(rule.production.predecessor))
        if at is None:
            return rule.production in self.states.system.decomposition and set(ages) <= {None}
        terms = AgeTerms(self.states, rule, at)
        if terms.age is None or is_pointwise(rule.production.condition, terms.age):
            return False
        others = [
            argument
            for module, age in zip(made, ages, strict=True)
            for place, argument in enumerate(module.arguments)
            if place != age
        ]
        counts = [item.count for item in _repeats(rule.production.successor)]
        return not any(map(terms.depends, [*others, *counts])) and all(
            unit_slope(module.arguments[age], terms.age) for module, age in zip(made, ages, strict=True) if age is not None
        )

    def phase(self, age: Value) -> Value:
        return 0 if self.even or self.step is None else normalised(age % self.step)

    def applies_from(self, rule: Rule, module: Module) -> Value | None:
        """The age from which on a rule has applied to a module to which it applies; None where nothing says so.

        >>> from lsys_kit.notation.read import read
        >>> states = States(read("dt = 0.7\\naxiom: M(0.4)\\nM(t) : t+dt < 1 -> M(t+dt)\\nM(t) : t+dt >= 1 -> M(t+dt-1) M(t)"))
        >>> age_model(states).applies_from(states.rules["M", 1][1], states.modules[0])
        Fraction(3, 10)
        """
        at, age = self.parameter(kind_of(module)), self.age(module) or 0
        cuts = [] if at is None else AgeTerms(self.states, rule, at).thresholds(module)
        past = sorted((cut for cut in cuts or () if cut <= age), reverse=True)
        for after, before in pairwise([*past, past[-1] - 2] if past else ()):
            if not self.states.matches(rule, self.aged(module, (before + after) / 2).arguments, module):
                return after
        return None

    def is_late(self, module: Module) -> bool:
        end = self.end(module)
        return (
            self.even
            and end is not None
            and end.rule is not None
            and self.step is not None
            and end.mother != module
            and self.age(end.mother) != end.age
            and end.age - (self.age(module) or 0) < self.step
        )

    def _found_end(self, module: Module) -> End | None:
        if self.step is None:
            raise _untold("no production such as M(t) -> M(t+1) lets time pass")
        kind = kind_of(module)
        rules = (*self.states.rules.get(kind, ()), *self.states.decomposition.get(kind, ()))
        for rule in rules:
            if not rule.d0l:
                self._refuse(rule, "does more than let time pass")
        try:
            if self.parameter(kind) is None:
                return self._end_without_age(module)
            return self._even_end(module, rules) if self.even else self._end_in_steps(module, rules)
        except (ArithmeticError, ValueError) as fault:
            raise rule_error(self.states.system, module, rules[0], fault) from None
        except TypeError:
            raise undecided_age(self.states, module, rules[0].production) from None

    def _fate(self, module: Module) -> Fate | None:
        """What becomes of a module; None where it grows older."""
        rule = self.states.matching_rule(module, self.states.decomposition)
        if rule is not None:
            return rule, 0
        rule = self.states.matching_rule(module, self.states.rules)
        return None if rule is not None and rule.number in self.growing else (rule, self.step or 1)

    def _end_without_age(self, module: Module) -> End | None:
        """How the life of a module without an age ends: within the step, or with the next one."""
        rule, span = self._fate(module) or (None, 0)
        stays = rule is None or rule.production.successor == (rule.production.predecessor,)
        return None if stays else End(rule, span, module, True)

    def _end_in_steps(self, module: Module, rules: Iterable[Rule]) -> End | None:
        """How a life ends that lasts whole steps."""
        age, step = self.age(module) or 0, self.step or 1
        near = {max(0, math.floor((cut - age) / step) + by) for cut in self._cuts(module, rules) for by in (-1, 0, 1, 2)}
        for steps in sorted({0} | near):
            mother = self.aged(module, normalised(age + steps * step))
            if (fate := self._fate(mother)) is not None:
                return End(fate[0], normalised(age + steps * step + (fate[1] if fate[0] else 0)), mother, True)
        return None

    def _even_end(self, module: Module, rules: Sequence[Rule]) -> End | None:
        """How a life ends whose length does not depend on that of steps."""
        age = self.age(module) or 0
        parts = list(self._parts(module, sorted(set(self._cuts(module, rules)))))
        now = max(
            at for at, (start, includes, _) in enumerate(parts) if start is None or start < age or (includes and start == age)
        )
        while now < len(parts) and parts[now][2] is None:
            now += 1
        if now == len(parts):
            return None
        start, includes, fate = parts[now]
        while now and parts[now - 1][2] == fate:
            now -= 1
            start, includes, _ = parts[now]
        rule, span = fate or (None, 0)
        if start is None and rule is not None:
            self._refuse(rule, "says nothing of an age from which on it applies")
        begun = age if start is None else start
        return End(rule, normalised(begun + (span if rule else 0)), self.aged(module, begun), includes or rule is None)

    def _parts(self, module: Module, cuts: Sequence[Value]) -> Iterator[tuple[Value | None, bool, Fate | None]]:
        """The stretches of age in which the same becomes of a module: where each begins, whether it includes that, and what."""
        yield None, False, self._fate(self.aged(module, cuts[0] - 1 if cuts else 0))
        for cut, after in pairwise([*cuts, cuts[-1] + 2] if cuts else ()):
            yield cut, True, self._fate(self.aged(module, cut))
            yield cut, False, self._fate(self.aged(module, (cut + after) / 2))

    def _cuts(self, module: Module, rules: Iterable[Rule]) -> list[Value]:
        """The ages at which something else becomes of a module."""
        found: list[Value] = []
        for rule in rules:
            cuts = AgeTerms(self.states, rule, self.parameter(kind_of(module)) or 0).thresholds(module)
            if cuts is None:
                self._refuse(rule, "does not say from which age on it applies")
            found += cuts
        return found

    def _refuse(self, rule: Rule, why: str) -> NoReturn:
        production, system = rule.production, self.states.system
        raise _untold(f"{as_written(system, production)} {why}", system.source or None, *(production.at or (None, None)))


def _untold(why: str, source: str | None = None, start: int | None = None, end: int | None = None) -> ModelValueError:
    """How long modules live is not known."""
    return ModelValueError(
        f"How long a module lives cannot be told, since {why}",
        source,
        start,
        end,
        'Productions such as "a(t) -> a(t+dt)" with rules such as "a(t) : t > 1 -> b(t-1)" tell it; so do '
        "the productions of timed(system).",
    )


def age_model(states: States) -> StepAges:
    """How the modules of a system of steps grow older, as its productions say.

    >>> from lsys_kit.notation.read import read
    >>> age_model(States(read("dt = 0.7\\naxiom: M(1,0)\\nM(p,t) -> M(p,t+dt)"))).step
    Fraction(7, 10)
    """
    parameters: dict[ModuleKind, int] = {}
    steps: set[Value] = set()
    for production in states.system.productions:
        for at, step in _grown(states, production):
            parameters.setdefault(kind_of(production.predecessor), at)
            steps.add(step)
    if len(steps) != 1:
        return StepAges(states, lambda kind: None, None)
    return StepAges(states, parameters.get, steps.pop())


def timed_age_model(states: States) -> AgeModel:
    """How the modules of a timed system grow older: the first parameter is the age, and productions end their lives."""
    return TimedAges(states, lambda kind: 0 if kind[1] else None, None)


def _grown(states: States, production: Production) -> Iterator[tuple[int, Value]]:
    """The first parameter to which a production adds a declared constant or 1, and how much that is."""
    before, after = production.predecessor, production.successor
    if not len(production.predecessors) == len(after) == 1:
        return
    if not isinstance(after[0], Pattern) or kind_of(after[0]) != kind_of(before):
        return
    order = {constant.name: at for at, constant in enumerate(states.system.constants)}
    for at, (old, new) in enumerate(zip(before.arguments, after[0].arguments, strict=True)):
        added = _added(old, new)
        if added is not None and names_in(added) <= order.keys():
            value = function_of(added, order, states.arithmetic)(states.constants)
            if not is_symbolic(value) and value > 0:
                yield at, value
                return


def _grows(production: Production, age: int | None) -> bool:
    """Whether a production makes a module older and changes nothing else."""
    before, after = production.predecessor, production.successor
    if age is None or not len(production.predecessors) == len(after) == 1:
        return False
    if not isinstance(after[0], Pattern) or kind_of(after[0]) != kind_of(before):
        return False
    return all(
        _added(old, new) is not None if at == age else old == new
        for at, (old, new) in enumerate(zip(before.arguments, after[0].arguments, strict=True))
    )


def _added(old: Any, new: Any) -> Expression | None:
    """What is added to a parameter, if that is a name or 1."""
    if not (isinstance(old, Name) and isinstance(new, Apply) and new.operator == "+" and old in new.operands):
        return None
    added = new.operands[1 - new.operands.index(old)]
    return added if isinstance(added, Name) or (isinstance(added, Number) and added.value == 1) else None


def _repeats(items: Iterable[Any]) -> Iterator[Repeat]:
    """The repeated parts of a successor."""
    for item in items:
        if isinstance(item, Repeat):
            yield item
            yield from _repeats(item.body)
