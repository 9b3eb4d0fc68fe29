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

A condition that compares sums and multiples of the age with values that do not change, as `t + dt >= t_div && p == LEFT`, is
true or false on whole stretches of age. Its thresholds are where these meet.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import islice, pairwise
from typing import Any, NamedTuple, NoReturn, TypeAlias

from lsys_kit.budget import check_budget, current
from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of
from lsys_kit.derivation.core.states import States, rule_error
from lsys_kit.derivation.growth.slicing import repetitions
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.model.arithmetic import Value, divide, is_symbolic, normalised, number_text
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, function_of, names_in
from lsys_kit.notation.model.modules import Module, Pattern, flat
from lsys_kit.notation.model.system import Production
from lsys_kit.notation.write import as_written

AgelessModule: TypeAlias = tuple[str, tuple[object, ...]]
"""A symbol with all values but the age."""


class End(NamedTuple):
    """How a module's life ends: the rule that replaces it (None where it stays as it is from then on); at which age; the module
    as it is when the rule applies; and whether it is replaced at just that age, and not only beyond it."""

    rule: Rule | None
    age: Value
    mother: Module
    already: bool


@dataclass(frozen=True)
class AgeModel(ABC):
    """How the modules of a system grow older, and how their lives end.

    From a symbol and a number of parameters `parameter` gives that which is the age, from 0; None where there is none. How long
    a `step` takes is None where nothing says so, and in a timed system.
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
        """Whether deriving in steps ends a module's life later than it ends."""
        return False

    def end(self, module: Module) -> End | None:
        """How a module's life ends as it grows older; None where it lives for ever.

        >>> from lsys_kit import read
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
        """What a rule makes of a module, before any of that is decomposed; no more than anything may be repeated."""
        most = current().repetitions
        found = [Module(*part) for part in islice(self.states.apply(rule, module), most + 1)]
        if len(found) > most:
            hint, (source, start, end) = "Use smaller numbers of repetitions.", place_of(self.states, rule.production)
            message = f"{module} becomes more than {most:,} modules at once"
            raise ModelLimitError(message, limit=most, source=source, start=start, end=end, hint=hint)
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
        found = []
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
    many = 0
    todo = [ages.states.modules[state] for state in ages.states.axiom][::-1]
    while todo:
        check_budget()
        module = todo.pop()
        age = ages.age(module) or 0
        born = found.setdefault(ages.ageless(module), {}).setdefault(ages.phase(age), {})
        if age in born:
            continue
        born[age] = module
        many += 1
        if many > limit:
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
    return ModelValueError(
        f"The age at which {module} becomes what {production} says cannot be decided",
        *place_of(states, production),
        f"It depends on {', '.join(names)}: choose a value for {names[0]}." if names else None,
    )


def place_of(states: States, production: Production) -> tuple[str | None, int | None, int | None]:
    """The text in which a production stands, and where."""
    return states.system.source or None, *(production.at or (None, None))


_LINEAR: Mapping[str, Callable[[Sequence[Any], Sequence[Value]], Value]] = {
    "+": lambda slopes, _: slopes[0] + slopes[1],
    "-": lambda slopes, _: slopes[0] - slopes[1],
    "-x": lambda slopes, _: -slopes[0],
    "*": lambda slopes, factors: slopes[0] * factors[1] + slopes[1] * factors[0],
    "/": lambda slopes, factors: divide(slopes[0], factors[1]),
}
"""For each operator that may keep a slope the same at all ages how it does, given slopes and fixed values of its operands."""
_CONNECTIVES = frozenset(("&&", "||", "!"))
_COMPARISONS = frozenset(("<", "<=", ">", ">=", "==", "!="))


@dataclass(frozen=True)
class AgeTerms:
    """The expressions of a rule as functions of the age of the module that it replaces, a parameter of its predecessor."""

    states: States
    rule: Rule
    parameter: int

    @cached_property
    def age(self) -> str | None:
        """What the rule calls the age; None where it has no name for it."""
        asked = self.rule.production.predecessor.arguments[self.parameter]
        return asked.name if isinstance(asked, Name) and asked.name not in self._constants else None

    @cached_property
    def _constants(self) -> Mapping[str, int]:
        """The place of each declared constant among the values of a module and of the constants."""
        first = len(self.rule.production.predecessor.arguments)
        return {constant.name: at for at, constant in enumerate(self.states.system.constants, first)}

    @cached_property
    def _order(self) -> Mapping[str, int]:
        """The place of each name there."""
        asked = enumerate(self.rule.production.predecessor.arguments)
        return {**{argument.name: at for at, argument in asked if isinstance(argument, Name)}, **self._constants}

    def depends(self, expression: Expression) -> bool:
        """Whether an expression depends on the age."""
        return self.age is not None and self.age in names_in(expression)

    def value(self, expression: Expression, module: Module) -> Value:
        """The value of an expression for a module."""
        found: Value = function_of(expression, self._order, self.states.arithmetic)((*module.arguments, *self.states.constants))
        return found

    def slope(self, expression: Expression, module: Module) -> Value | None:
        """By how much an expression grows while the age grows by 1; None where that is not the same at all ages.

        >>> from lsys_kit import read
        >>> states = States(read("axiom: M(0,3)\\nM(t,p) -> M(2*t-p,p)"))
        >>> rule, = states.rules["M", 2]
        >>> AgeTerms(states, rule, 0).slope(rule.production.successor[0].arguments[0], states.modules[0])
        2
        """
        if not self.depends(expression):
            return 0
        if not isinstance(expression, Apply):
            return 1
        parts = expression.operands
        slopes = [self.slope(part, module) for part in parts]
        if None in slopes or expression.operator not in _LINEAR:
            return None
        if expression.operator == "*" and all(map(self.depends, parts)):
            return None
        if expression.operator == "/" and self.depends(parts[1]):
            return None
        factors = [0 if self.depends(part) else self.value(part, module) for part in parts]
        return _LINEAR[expression.operator](slopes, factors)

    def thresholds(self, module: Module) -> list[Value] | None:
        """The ages at which the rule may begin or cease to match a module; None where its condition asks otherwise for the age.

        >>> from lsys_kit import read
        >>> states = States(read("dt = 0.7\\naxiom: M(0.4)\\nM(t) : t+dt < 1 || t > 5 -> M(t+dt)"))
        >>> print(*AgeTerms(states, states.rules["M", 1][0], 0).thresholds(states.modules[0]))
        3/10 5
        """
        found = []
        for difference in self._compared():
            slope = None if difference is None else self.slope(difference, module)
            if difference is None or slope is None:
                return None
            if slope != 0:
                young = tuple(0 if at == self.parameter else value for at, value in enumerate(module.arguments))
                found.append(divide(-self.value(difference, replace(module, arguments=young)), slope))
        asked = self.rule.production.predecessor.arguments[self.parameter]
        return found if self.age is not None else [*found, self.value(asked, module)]

    def _compared(self) -> Iterator[Expression | None]:
        """What is compared with 0 wherever the age is asked for; None for a question of another kind."""
        arguments = self.rule.production.predecessor.arguments
        for at, _ in self.rule.equalities:
            if self.depends(arguments[at]):
                yield None
        todo = [] if self.rule.production.condition is None else [self.rule.production.condition]
        while todo:
            part = todo.pop()
            if not self.depends(part):
                continue
            if isinstance(part, Apply) and part.operator in _CONNECTIVES:
                todo += part.operands[::-1]
            elif isinstance(part, Apply) and part.operator in _COMPARISONS:
                yield Apply("-", part.operands)
            else:
                yield None


def unit_slope(expression: Expression, age: str) -> bool:
    """Whether an expression is the age plus or minus something that does not depend on it.

    >>> from lsys_kit.notation.read import read_expression
    >>> [unit_slope(read_expression(text), "t") for text in ("t + dt - 1", "1 - t", "2*t", "3")]
    [True, False, False, False]
    """
    if not isinstance(expression, Apply):
        return expression == Name(age)
    if expression.operator not in ("+", "-") or sum(age in names_in(part) for part in expression.operands) != 1:
        return False
    part = next(part for part in expression.operands if age in names_in(part))
    return unit_slope(part, age) and (expression.operator == "+" or part is expression.operands[0])


def is_pointwise(condition: Expression | None, age: str) -> bool:
    """Whether a condition asks somewhere whether the age has just a certain value."""
    if not isinstance(condition, Apply) or age not in names_in(condition):
        return False
    return condition.operator in ("==", "!=") or any(is_pointwise(part, age) for part in condition.operands)


Fate: TypeAlias = tuple[Rule | None, Value]
"""What becomes of a module that does not grow older: the rule that replaces it, and how long that takes."""


@dataclass(frozen=True)
class StepAges(AgeModel):
    """The ages of a system of steps."""

    _carried: dict[int, bool] = field(default_factory=dict, compare=False, repr=False)

    @cached_property
    def growing(self) -> frozenset[int]:
        """The numbers of the productions that do nothing but let time pass."""
        productions = [rule for rules in self.states.rules.values() for rule in rules]
        return frozenset(
            rule.number for rule in productions if _grows(rule.production, self.parameter(kind_of(rule.production.predecessor)))
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
        return not any(map(terms.depends, [*others, *repetitions(rule.production.successor)])) and all(
            unit_slope(module.arguments[age], terms.age) for module, age in zip(made, ages, strict=True) if age is not None
        )

    def phase(self, age: Value) -> Value:
        return 0 if self.even or self.step is None else normalised(age % self.step)

    def applies_from(self, rule: Rule, module: Module) -> Value | None:
        """The age from which on a rule has applied to a module to which it applies; None where nothing says so.

        >>> from lsys_kit import read
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
            self._untold("no production such as M(t) -> M(t+1) lets time pass")
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
        found = []
        for rule in rules:
            cuts = AgeTerms(self.states, rule, self.parameter(kind_of(module)) or 0).thresholds(module)
            if cuts is None:
                self._refuse(rule, "does not say from which age on it applies")
            found += cuts
        return found

    def _refuse(self, rule: Rule, why: str) -> NoReturn:
        self._untold(f"{as_written(self.states.system, rule.production)} {why}", *place_of(self.states, rule.production))

    def _untold(self, why: str, source: str | None = None, start: int | None = None, end: int | None = None) -> NoReturn:
        raise ModelValueError(
            f"How long a module lives cannot be told, since {why}",
            source,
            start,
            end,
            'Productions such as "a(t) -> a(t+dt)" with rules such as "a(t) : t > 1 -> b(t-1)" tell it; so do '
            "the productions of timed(system).",
        )


def age_model(states: States) -> StepAges:
    """How the modules of a system of steps grow older, as its productions say.

    >>> from lsys_kit import read
    >>> age_model(States(read("dt = 0.7\\naxiom: M(1,0)\\nM(p,t) -> M(p,t+dt)"))).step
    Fraction(7, 10)
    """
    parameters: dict[ModuleKind, int] = {}
    steps = set()
    for production in states.system.productions:
        for at, step in _grown(states, production):
            parameters.setdefault(kind_of(production.predecessor), at)
            steps.add(step)
    if len(steps) != 1:
        return StepAges(states, lambda kind: None, None)
    return StepAges(states, parameters.get, steps.pop())


def _grown(states: States, production: Production) -> Iterator[tuple[int, Value]]:
    """The first parameter to which a production adds a declared constant or 1, and how much that is."""
    order = {constant.name: at for at, constant in enumerate(states.system.constants)}
    for at, (old, new) in enumerate(_continued(production)):
        added = _added(old, new)
        if added is not None and names_in(added) <= order.keys():
            value = function_of(added, order, states.arithmetic)(states.constants)
            if not is_symbolic(value) and value > 0:
                yield at, value
                return


def _grows(production: Production, age: int | None) -> bool:
    """Whether a production makes a module older and changes nothing else."""
    pairs = [] if age is None else _continued(production)
    return bool(pairs) and all(_added(old, new) is not None if at == age else old == new for at, (old, new) in enumerate(pairs))


def _continued(production: Production) -> list[tuple[Expression, Expression]]:
    """The parameters of a module before and after a production that makes it a module of the same kind; else none."""
    before, after = production.predecessor, production.successor
    if (
        len(production.predecessors) == len(after) == 1
        and isinstance(after[0], Pattern)
        and kind_of(after[0]) == kind_of(before)
    ):
        return list(zip(before.arguments, after[0].arguments, strict=True))
    return []


def _added(old: Expression, new: Expression) -> Expression | None:
    """What is added to a parameter, if that is a name or 1."""
    if not (isinstance(old, Name) and isinstance(new, Apply) and new.operator == "+" and old in new.operands):
        return None
    added = new.operands[1 - new.operands.index(old)]
    return added if isinstance(added, Name) or (isinstance(added, Number) and added.value == 1) else None
