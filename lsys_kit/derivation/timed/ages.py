"""Ages: which parameter of a module grows with time, by how much in a step, and at which age a rule applies.

This is the one model of ageing. Two kinds of systems have ages. In a system of steps a production `M(t,p) -> M(t+dt,p)` says
that t is an age and that a step takes the time dt (`t+1`: one unit of time); a condition `t >= t_div`, mostly that of a
decomposition rule, says from which age on its rule applies. In a timed system the first parameter is the age, and a production
`a(1) -> b(0) a(0)` says at which age a module ends. Words at any time, lineages, life stages and continuity all use this.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

from lsys_kit.derivation.core.rule_errors import rule_error
from lsys_kit.derivation.core.rules import ModuleKind, Rule, Rules, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.arithmetic import Value, is_symbolic
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, function_of, is_random, names_in
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import Production

AgelessModule: TypeAlias = tuple[str, tuple[object, ...]]
"""A symbol with all values but the age."""
RuleAndAge: TypeAlias = tuple[Rule, Value]
"""A rule and the age from which on it applies."""
_OLDER_SIDE = {">=": 1, ">": 1, "<=": -1, "<": -1}
"""For each comparison whether its left side (1) or its right side (-1) must be the greater."""
_TOLERANCE = 1e-9


@dataclass(frozen=True)
class AgeModel:
    """How the modules of a system grow older, and how their lives end.

    Attributes
    ----------
    states
        The table of its modules.
    parameter
        From a symbol and a number of parameters to the parameter that is the age, from 0; None where there is none.
    ending
        The rules that end the lives of modules.
    step
        How long a step takes; None where nothing says so, and in a timed system.
    """

    states: States
    parameter: Callable[[ModuleKind], int | None]
    ending: Rules
    step: Value | None

    def age(self, module: Module) -> Value | None:
        """A module's age; None where it has none."""
        at = self.parameter(kind_of(module))
        return None if at is None else module.arguments[at]

    def aged(self, module: Module, age: Value) -> Module:
        """A module at another age; itself, where it has none."""
        at, values = self.parameter(kind_of(module)), module.arguments
        return module if at is None else Module(module.symbol, (*values[:at], age, *values[at + 1:]))

    def ageless(self, module: Module) -> AgelessModule:
        """A module without its age."""
        at, values = self.parameter(kind_of(module)), module.arguments
        return module.symbol, values if at is None else values[:at] + values[at + 1:]

    def end(self, module: Module) -> RuleAndAge | None:
        """The first rule that ends a module's life as it grows older, and at which age; None where it lives for ever.

        >>> from lsys_kit.notation.read import read
        >>> cells = States(read("axiom: M(0)\\nM(t) -> M(t+1)\\ndecomposition:\\nM(t) : t >= 3 -> M(t-3) M(t-2)"))
        >>> age_model(cells).end(Module("M", (0,)))[1]
        3
        """
        found: list[tuple[Value, int, Rule]] = []
        for rule in self.ending.get(kind_of(module), ()):
            age = self.applies_from(rule, module)
            if age is not None and self._applies_at(rule, module, age):
                found.append((age, rule.number, rule))
        return (min(found)[2], min(found)[0]) if found else None

    def daughters(self, module: Module) -> list[Module]:
        """What a module becomes at the end of its life: its daughters at their first ages; none, where it lives for ever."""
        end = self.end(module)
        return [] if end is None else self.made(end[0], self.aged(module, end[1]))

    def made(self, rule: Rule, module: Module) -> list[Module]:
        """What a rule makes of a module, before any of that is decomposed."""
        return [Module(*part) for part in self.states.apply(rule, module)]

    def applies_from(self, rule: Rule, module: Module) -> Value | None:
        """The age from which on a rule applies to a module; None where it does not depend on the age like this.

        >>> from lsys_kit.notation.read import read
        >>> states = States(read("dt = 0.7\\naxiom: M(0.4)\\nM(t) : t+dt < 1 -> M(t+dt)\\nM(t) : t+dt >= 1 -> M(t+dt-1) M(0)"))
        >>> age_model(states).applies_from(states.rules["M", 1][1], states.modules[0])
        Fraction(3, 10)
        """
        at = self.parameter(kind_of(module))
        if at is None:
            return None
        asked = next((function for index, function in rule.equalities if index == at), None)
        if asked is not None:
            return self._asked_age(rule, module, asked)
        if rule.production.condition is None:
            return None
        bounds = [bound for part in _conjuncts(rule.production.condition)
                  if (bound := self._bound(part, rule.production, module)) is not None]
        return max(bounds, default=None)

    def _asked_age(self, rule: Rule, module: Module, asked: Callable[..., Value]) -> Value:
        """The age that a rule's predecessor asks for."""
        try:
            return asked((*module.arguments, *self.states.constants))
        except (ArithmeticError, ValueError) as fault:
            raise rule_error(self.states.system, module, rule, fault) from None
        except TypeError:
            raise undecided_age(self.states, module, rule.production) from None

    def _applies_at(self, rule: Rule, module: Module, age: Value) -> bool:
        """Whether a rule applies at the age that it asks for; or, where its condition asks for a least age, beyond that."""
        if rule.production.condition is None and len(rule.equalities) == 1:
            return True
        asked = any(index == self.parameter(kind_of(module)) for index, _ in rule.equalities)
        return self.states.matches(rule, self.aged(module, age if asked else age + 1).arguments, module)

    def _bound(self, part: Expression, production: Production, module: Module) -> Value | None:
        """The age at which a comparison begins to hold, if it has the form age + something >= something."""
        names = [argument.name if isinstance(argument, Name) else "" for argument in production.predecessor.arguments]
        order = {name: len(names) + at for name, at in _order_of_constants(self.states).items()}
        order |= {name: at for at, name in enumerate(names) if name not in order}
        if not (isinstance(part, Apply) and part.operator in _OLDER_SIDE and names_in(part) <= order.keys()) or is_random(part):
            return None
        left, right = part.operands[::_OLDER_SIDE[part.operator]]
        excess, age = function_of(Apply("-", (left, right)), order, self.states.arithmetic), self.age(module)
        assert age is not None
        before, now, after = (excess((*self.aged(module, age + step).arguments, *self.states.constants)) for step in (-1, 0, 1))
        if is_symbolic(now) or abs(now - before - 1) > _TOLERANCE or abs(after - now - 1) > _TOLERANCE:
            return None
        bound: Value = age - now
        return bound


def age_model(states: States) -> AgeModel:
    """How the modules of a system of steps grow older, as its productions say; decomposition rules end their lives.

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
        return AgeModel(states, lambda kind: None, states.decomposition, None)
    return AgeModel(states, parameters.get, states.decomposition, steps.pop())


def timed_age_model(states: States) -> AgeModel:
    """How the modules of a timed system grow older: the first parameter is the age, and productions end their lives."""
    return AgeModel(states, lambda kind: 0 if kind[1] else None, states.rules, None)


def undecided_age(states: States, module: Module, production: Production) -> ModelValueError:
    """The age at which a module divides depends on a constant that is not known."""
    names = sorted({str(name) for value in states.constants for name in getattr(value, "free_symbols", ())})
    start, end = production.at or (None, None)
    return ModelValueError(f"The age at which {module} becomes what {production} says cannot be decided",
                           states.system.source or None, start, end,
                           f"It depends on {', '.join(names)}: choose a value for {names[0]}.")


def _grown(states: States, production: Production) -> Iterator[tuple[int, Value]]:
    """The first parameter to which a production adds a declared constant or 1, and how much that is."""
    before, after = production.predecessor, production.successor
    if not len(production.predecessors) == len(after) == 1:
        return
    if not isinstance(after[0], Pattern) or kind_of(after[0]) != kind_of(before):
        return
    for at, (old, new) in enumerate(zip(before.arguments, after[0].arguments, strict=True)):
        added = _added(old, new)
        if added is not None and names_in(added) <= _order_of_constants(states).keys():
            value = function_of(added, _order_of_constants(states), states.arithmetic)(states.constants)
            if not is_symbolic(value) and value > 0:
                yield at, value
                return


def _added(old: Any, new: Any) -> Expression | None:
    """What is added to a parameter, if that is a name or 1."""
    if not (isinstance(old, Name) and isinstance(new, Apply) and new.operator == "+" and old in new.operands):
        return None
    added = new.operands[1 - new.operands.index(old)]
    return added if isinstance(added, Name) or (isinstance(added, Number) and added.value == 1) else None


def _conjuncts(condition: Expression) -> Iterator[Expression]:
    """The parts of a condition that must all hold."""
    if isinstance(condition, Apply) and condition.operator == "&&":
        for operand in condition.operands:
            yield from _conjuncts(operand)
    else:
        yield condition


def _order_of_constants(states: States) -> dict[str, int]:
    """The place of each declared constant among their values."""
    return {constant.name: at for at, constant in enumerate(states.system.constants)}
