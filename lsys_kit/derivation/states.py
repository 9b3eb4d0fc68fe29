"""The table of states: each distinct module that a derivation meets, numbered in the order in which it is met.

A module's fate in a context-free system depends on its symbol and values alone, so its successor is computed once, here,
however often the module occurs. A word is then an array of states, the growth matrix counts states in successors, and the
stage diagram is this table drawn.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from lsys_kit.derivation.rules import Rule, Rules, constants_of, reason, rules_of
from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.expressions import Value
from lsys_kit.notation.model import LSystem, Module

EXACT_BITS = 128
"""A rational value with more bits than this becomes a double."""


class States:
    """The states of a system under given constants.

    Parameters
    ----------
    system
        Any L-system.
    constants
        Values for some of its declared constants.
    arithmetic
        "exact", or "float" to compute in doubles as cpfg and L-Py do.

    Attributes
    ----------
    modules
        The module of each state.
    inexact
        The first module whose value became a double because it outgrew 128 bits, or None.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> states = States(read("axiom: A(4)\\nA(t) : t < 5 -> A(t+1)\\nA(t) -> A(1) B"))
    >>> states.axiom, states.successor(0), states.successor(1), states.successor(3)
    ((0,), (1,), (2, 3), (3,))
    >>> print(*states.modules)
    A(4) A(5) A(1) B
    """

    def __init__(self, system: LSystem, constants: dict[str, object] | None = None, arithmetic: str = "exact") -> None:
        if arithmetic not in ("exact", "float"):
            raise ModelNameError(f'There is no arithmetic called "{arithmetic}"', hint='Choose "exact" or "float".')
        self.system, self.arithmetic = system, arithmetic
        self.constants = constants_of(system, constants or {}, arithmetic)
        self.modules: list[Module] = []
        self.inexact: Module | None = None
        self._numbers: dict[tuple[object, ...], int] = {}
        self._successors: list[tuple[int, ...] | None] = []
        self._rules: list[int | None] = []
        self._ready = rules_of(system, arithmetic)
        self.axiom = tuple(self._axiom())

    def __len__(self) -> int:
        return len(self.modules)

    def number(self, symbol: str, values: tuple[Value, ...] = ()) -> int:
        """The state of a module, a new one where it has not been met."""
        key = (symbol, values, *map(type, values))
        found = self._numbers.get(key)
        if found is None:
            found = self._numbers[key] = len(self.modules)
            self.modules.append(Module(symbol, values))
            self._successors.append(None)
            self._rules.append(None)
        return found

    def successor(self, state: int) -> tuple[int, ...]:
        """The states that replace a state in one step: itself, where no production matches."""
        found = self._successors[state]
        if found is None:
            module = self.modules[state]
            rule = self.matching(module, self._ready)
            found = (state,) if rule is None else tuple(self._made(rule, module))
            self._rules[state] = None if rule is None else rule.number
            self._successors[state] = found
        return found

    def production(self, state: int) -> int | None:
        """Which production rewrites a state: its place in the order written, from 0, or None."""
        self.successor(state)
        return self._rules[state]

    def matching(self, module: Module, rules: Rules) -> Rule | None:
        """The first rule that matches a module."""
        values: tuple[Value, ...] = module.arguments  # type: ignore[assignment]
        given = values + self.constants
        for rule in rules.get((module.symbol, len(values)), ()):
            try:
                if (all(values[i] == wanted(given) for i, wanted in rule.equalities)
                        and (rule.condition is None or rule.condition(given))):
                    return rule
            except (ArithmeticError, ValueError) as fault:
                raise self._fault(module, rule, fault) from None
        return None

    def made(self, rule: Rule, module: Module) -> Iterable[tuple[str, tuple[Value, ...]]]:
        """The symbols and values that a rule makes of a module."""
        given = (*module.arguments, *self.constants)
        try:
            for symbol, arguments in rule.successor:
                yield symbol, tuple([self._kept(argument(given), symbol) for argument in arguments])  # type: ignore[arg-type]
        except (ArithmeticError, ValueError) as fault:
            raise self._fault(module, rule, fault) from None

    def _made(self, rule: Rule, module: Module) -> Iterable[int]:
        return (self.number(symbol, values) for symbol, values in self.made(rule, module))

    def _axiom(self) -> Iterable[int]:
        """The axiom's states: its arguments may use the constants, so it is made like a successor."""
        return self._made(axiom_rule(self.system, self.arithmetic), Module("axiom"))

    def _kept(self, value: Value, symbol: str) -> Value:
        """The value as the table keeps it: rational up to 128 bits, else a double that is a number."""
        if isinstance(value, float):
            if not math.isfinite(value):
                raise ValueError("the result is not a number" if math.isnan(value) else "the result is too large")
            return value
        if max(value.numerator.bit_length(), value.denominator.bit_length()) <= EXACT_BITS:
            return value
        value = float(value)
        self.inexact = self.inexact or Module(symbol, (value,))
        return value

    def _fault(self, module: Module, rule: Rule, fault: Exception) -> ModelValueError:
        what = "The axiom" if module.symbol == "axiom" else f"{module} under production {rule.number + 1}, {rule.production},"
        return ModelValueError(f"{what} has no value: {reason(fault)}", self.system.source or None,
                               *(rule.production.at or (None, None)))


def axiom_rule(system: LSystem, arithmetic: str) -> Rule:
    """The axiom as the rule that makes the first word out of nothing."""
    from dataclasses import replace

    from lsys_kit.notation.model import Production

    start = replace(system, productions=(Production(Module("axiom"), system.axiom),), interpretation=())
    return rules_of(start, arithmetic)["axiom", 0][0]


def closure(states: States, limit: int) -> Sequence[int] | None:
    """All states that are met from the axiom on, in the order of their numbers; None where they are more than `limit`.

    >>> from lsys_kit.notation.read import read
    >>> closure(States(read("axiom: A\\nA -> A B")), 100)
    range(0, 2)
    >>> closure(States(read("axiom: A(0)\\nA(t) -> A(t+1)")), 100) is None
    True
    """
    done = 0
    while done < len(states):
        if len(states) > limit:
            return None
        states.successor(done)
        done += 1
    return range(done)
