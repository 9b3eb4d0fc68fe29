"""Ages: which parameter of a module grows with time, by how much in a step, and at which age a rule applies.

A production `M(t,p) -> M(t+dt,p)` says that t is an age and that a step takes the time dt; `t+1` says that it takes one unit. A
condition `t >= t_div` says from which age on its rule applies.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from lsys_kit.derivation.core.rules import ModuleKind, Rule, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.notation.model.arithmetic import Value, is_symbolic
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, function_of, is_random, names_in
from lsys_kit.notation.model.system import Module, Production

_COMPARED = {">=": 1, ">": 1, "<=": -1, "<": -1}
"""For each comparison whether its left side must be the greater."""
_NEARLY = 1e-9


@dataclass(frozen=True)
class AgeModel:
    """How the modules of a system grow older.

    Attributes
    ----------
    states
        The table of its modules.
    parameters
        By symbol and number of parameters which parameter is the age.
    step
        How long a step takes; None where nothing says so.
    """

    states: States
    parameters: Mapping[ModuleKind, int]
    step: Value | None

    def age(self, module: Module) -> Value | None:
        """A module's age; None where it has none."""
        at = self.parameters.get(kind_of(module))
        return None if at is None else module.arguments[at]  # type: ignore[return-value]

    def aged(self, module: Module, age: Value) -> Module:
        """A module with another age."""
        at = self.parameters[kind_of(module)]
        return Module(module.symbol, (*module.arguments[:at], age, *module.arguments[at + 1:]))

    def applies_from(self, rule: Rule, module: Module) -> Value | None:
        """The age from which on a rule's condition holds for a module; None where it does not depend on the age like this.

        >>> from lsys_kit.notation.read import read
        >>> states = States(read("dt = 0.7\\naxiom: M(0.4)\\nM(t) : t+dt < 1 -> M(t+dt)\\nM(t) : t+dt >= 1 -> M(t+dt-1) M(0)"))
        >>> age_model(states).applies_from(states.rules["M", 1][1], states.modules[0])
        Fraction(3, 10)
        """
        age = self.age(module)
        if age is None or rule.production.condition is None:
            return None
        bounds = [bound for part in _joined_by_and(rule.production.condition)
                  if (bound := self._bound(part, rule.production, module, age)) is not None]
        return max(bounds, default=None)

    def _bound(self, part: Expression, production: Production, module: Module, age: Value) -> Value | None:
        """The age at which a comparison begins to hold, if it has the form age + something >= something."""
        names = [argument.name if isinstance(argument, Name) else "" for argument in production.predecessor.arguments]
        order = {name: len(names) + at for name, at in _order(self.states).items()}
        order |= {name: at for at, name in enumerate(names) if name not in order}
        if not (isinstance(part, Apply) and part.operator in _COMPARED and names_in(part) <= order.keys()) or is_random(part):
            return None
        left, right = part.operands[::_COMPARED[part.operator]]
        excess = function_of(Apply("-", (left, right)), order, self.states.arithmetic)
        before, now, after = (excess((*self.aged(module, age + step).arguments, *self.states.constants)) for step in (-1, 0, 1))
        if is_symbolic(now) or abs(now - before - 1) > _NEARLY or abs(after - now - 1) > _NEARLY:
            return None
        bound: Value = age - now
        return bound


def age_model(states: States) -> AgeModel:
    """How the modules of a system grow older: what its productions say.

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
    return AgeModel(states, parameters, steps.pop()) if len(steps) == 1 else AgeModel(states, {}, None)


def _grown(states: States, production: Production) -> Iterator[tuple[int, Value]]:
    """The first parameter to which a production adds a declared constant or 1, and how much that is."""
    before, after = production.predecessor, production.successor
    if len(after) != 1 or not isinstance(after[0], Module) or kind_of(after[0]) != kind_of(before):
        return
    for at, (old, new) in enumerate(zip(before.arguments, after[0].arguments, strict=True)):
        added = _added(old, new)
        if added is not None and names_in(added) <= _order(states).keys():
            value = function_of(added, _order(states), states.arithmetic)(states.constants)
            if not is_symbolic(value) and value > 0:
                yield at, value
                return


def _added(old: Any, new: Any) -> Expression | None:
    """What is added to a parameter, if that is a name or 1."""
    if not (isinstance(old, Name) and isinstance(new, Apply) and new.operator == "+" and old in new.operands):
        return None
    added = new.operands[1 - new.operands.index(old)]
    return added if isinstance(added, Name) or (isinstance(added, Number) and added.value == 1) else None


def _joined_by_and(condition: Expression) -> Iterator[Expression]:
    """The parts of a condition that must all hold."""
    if isinstance(condition, Apply) and condition.operator == "&&":
        for operand in condition.operands:
            yield from _joined_by_and(operand)
    else:
        yield condition


def _order(states: States) -> dict[str, int]:
    """The place of each declared constant among their values."""
    return {constant.name: at for at, constant in enumerate(states.system.constants)}
