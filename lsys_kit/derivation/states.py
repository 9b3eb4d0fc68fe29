"""The table of states: each distinct module that a derivation meets, numbered in the order in which it is met.

A module's fate in a context-free system depends on its symbol and values alone, so its successor is computed once, here,
however often the module occurs. A word is then an array of states, the growth matrix counts states in successors, and the
stage diagram is this table drawn.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from lsys_kit.derivation.rules import Rule, Rules, constants_of, rules_of
from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.arithmetic import Value, reason, sound
from lsys_kit.notation.model import LSystem, Module, Production

EXACT_BITS = 128
"""A rational value with more bits than this becomes a double."""


_AXIOM = Module("axiom")
"""What the axiom is made of."""


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
        The first module that was met with a value that had outgrown 128 bits and become a double, or None.

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
        self._outgrown = False
        self._numbers: dict[tuple[object, ...], int] = {}
        self._successors: dict[int, tuple[int, ...]] = {}
        self._rules: dict[int, Rule | None] = {}
        self._ready = rules_of(system, arithmetic)
        self.axiom = tuple(self._axiom())

    def __len__(self) -> int:
        return len(self.modules)

    def number(self, symbol: str, values: tuple[Value, ...] = ()) -> int:
        """The state of a module, a new one where it has not been met."""
        key = (symbol, values, *map(type, values))
        found = self._numbers.get(key)
        if found is None:
            found = len(self.modules)
            self.modules.append(Module(symbol, values))
            self._numbers[key] = found  # last, so that an interrupt leaves no number without its module
        return found

    def successor(self, state: int) -> tuple[int, ...]:
        """The states that replace a state in one step: itself, where no production matches."""
        found = self._successors.get(state)
        if found is None:
            rule = self._rule(state)
            found = self._successors[state] = (state,) if rule is None else tuple(self._made(rule, self.modules[state]))
        return found

    def width(self, state: int) -> int:
        """How many modules replace a state in one step, known before any of them is made."""
        rule = self._rule(state)
        return 1 if rule is None else len(rule.successor)

    def production(self, state: int) -> int | None:
        """Which production rewrites a state: its place in the order written, from 0, or None."""
        rule = self._rule(state)
        return None if rule is None else rule.number

    def _rule(self, state: int) -> Rule | None:
        if state not in self._rules:
            self._rules[state] = self.matching(self.modules[state], self._ready)
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
                yield symbol, tuple([self._kept(argument(given)) for argument in arguments])  # type: ignore[arg-type]
        except (ArithmeticError, ValueError) as fault:
            raise self._fault(module, rule, fault) from None

    def _made(self, rule: Rule, module: Module) -> Iterable[int]:
        self._outgrown = False
        for symbol, values in self.made(rule, module):
            if self._outgrown and self.inexact is None:
                self.inexact = Module(symbol, values)
            yield self.number(symbol, values)

    def _axiom(self) -> Iterable[int]:
        """The axiom's states: its arguments may use the constants, so it is made like a successor."""
        return self._made(axiom_rule(self.system, self.arithmetic), _AXIOM)

    def _kept(self, value: Value) -> Value:
        """The value as the table keeps it: rational up to 128 bits, else a double that is a number."""
        sound(value)
        if isinstance(value, float):
            return value
        if max(value.numerator.bit_length(), value.denominator.bit_length()) <= EXACT_BITS:
            return value
        self._outgrown = True
        return float(value)

    def _fault(self, module: Module, rule: Rule, fault: Exception) -> ModelValueError:
        what = "The axiom" if module is _AXIOM else f"{module} under production {rule.number + 1}, {rule.production},"
        start, end = rule.production.at or (None, None)
        hint = None if module is _AXIOM else "A condition before the arrow can keep such values out."
        return ModelValueError(f"{what} has no value: {reason(fault)}", self.system.source or None, start, end, hint)


def axiom_rule(system: LSystem, arithmetic: str) -> Rule:
    """The axiom as the rule that makes the first word out of nothing."""
    places = [module.at for module in system.axiom if module.at]
    start = Production(_AXIOM, system.axiom, at=(places[0][0], places[-1][1]) if places else None)
    return rules_of(replace(system, productions=(start,), interpretation=()), arithmetic)[_AXIOM.symbol, 0][0]


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
