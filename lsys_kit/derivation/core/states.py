"""The table of states: each distinct module that a derivation meets, numbered in the order in which it is met.

Where a module's fate depends on its symbol and values alone, its successor is computed once, here, however often the module
occurs. A word is then an array of states, the growth matrix counts states in successors, and the stage diagram is this
table drawn. Where neighbours or chance have a say, the table still numbers the modules, and what they become is computed
for each combination that occurs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from lsys_kit.budget import current
from lsys_kit.derivation.core.chance import Chance, choose
from lsys_kit.derivation.core.rule_errors import AXIOM, UNKNOWN, rule_error, undecided_condition
from lsys_kit.derivation.core.rules import (
    ModuleTemplate,
    RepeatTemplate,
    Rule,
    Rules,
    constants_of,
    kind_of,
    rule_for,
    rules_of,
)
from lsys_kit.derivation.core.traits import traits_of
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelValueError
from lsys_kit.notation.model.arithmetic import SMALL, Value, equal_values, expanded_value, finite, is_symbolic
from lsys_kit.notation.model.system import LSystem, Module, Production
from lsys_kit.notation.write import as_written

EXACT_BITS = 128
"""A rational value with more bits than this becomes a double."""


class Successors(dict[int, tuple[int, ...]]):
    """What replaces each state that alone decides it in one step, found when it is first asked for."""

    def __init__(self, states: States) -> None:
        self.states = states

    def __missing__(self, state: int) -> tuple[int, ...]:
        states, module = self.states, self.states.modules[state]
        rule = states.rule(state)
        found = self[state] = states.parts(module) if rule is None else states.replaced(rule, module)
        return found


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
    traits
        What the system has that decides how it can be derived.
    successors
        The successor of each state that alone decides it.
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
        self.successors = Successors(self)
        self._applied: dict[int, Rule | None] = {}
        self._parts: dict[tuple[object, ...], tuple[int, ...]] = {}
        self.rules = rules_of(system, arithmetic)
        self.decomposition = rules_of(system, arithmetic, "decomposition")
        known = traits_of(system, arithmetic)
        self.traits = replace(known, unknown=True) if any(map(is_symbolic, self.constants)) else known
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

    def candidates(self, state: int) -> tuple[Rule, ...]:
        """The productions for modules of a state's symbol and number of parameters, in the order written."""
        return self.rules.get(kind_of(self.modules[state]), ())

    def is_d0l(self, state: int) -> bool:
        """Whether the state alone decides what becomes of it, unless it is cut off."""
        return not self.traits.varying_decomposition and all(rule.d0l for rule in self.candidates(state))

    def successor(self, state: int) -> tuple[int, ...]:
        """The states that replace a state in one step: itself, where no production matches.

        Raises
        ------
        ModelValueError
            Its neighbours, chance or what the turtle sees decide that as well.
        """
        return self.successors[state]

    def width(self, state: int) -> int:
        """How many modules at least replace a state in one step, known before any of them is made."""
        rule = self.rule(state)
        return 1 if rule is None or self.decomposition else rule.least

    def production(self, state: int) -> int | None:
        """Which production rewrites a state: its place in the order written, from 0, or None."""
        rule = self.rule(state)
        return None if rule is None else rule.number

    def rule(self, state: int) -> Rule | None:
        """The rule that rewrites a state, or None; a `ModelValueError` where the state alone does not decide that."""
        if state not in self._applied:
            if not self.is_d0l(state):
                raise ModelValueError(f"What becomes of {self.modules[state]} does not depend on its symbol and values alone",
                                      hint="Derive the system, and ask for the origins of a step.")
            self._applied[state] = self.matching(self.modules[state], self.rules)
        return self._applied[state]

    def matching(self, module: Module, rules: Rules, chance: Chance | None = None) -> Rule | None:
        """The rule that rewrites a module, of rules that need no context."""
        return self.drawn(self.matched(module, rules, chance), chance)

    def matched(self, module: Module, rules: Rules, chance: Chance | None = None) -> list[tuple[Rule, tuple[Value, ...]]]:
        """The rules that match a module, up to a first that leaves nothing to chance, each with the module's values."""
        values: tuple[Value, ...] = module.arguments  # type: ignore[assignment]
        found: list[tuple[Rule, tuple[Value, ...]]] = []
        for rule in rules.get(kind_of(module), ()):
            if self.holds(rule, values, module, chance):
                found.append((rule, values))
                if found[0][0].probability is None:
                    break
        return found

    def holds(self, rule: Rule, values: tuple[Value, ...], module: Module, chance: Chance | None = None) -> bool:
        """Whether a rule's values are what it asks for and its condition is true."""
        given = (*values, *self.constants, chance)
        try:
            return (all(equal_values(values[i], wanted(given)) for i, wanted in rule.equalities)
                    and (rule.condition is None or bool(rule.condition(given))))
        except TypeError:
            raise undecided_condition(self.system, self.constants, module, rule) from None
        except (ArithmeticError, ValueError) as fault:
            raise rule_error(self.system, module, rule, fault) from None

    def drawn(self, matched: Sequence[tuple[Rule, tuple[Value, ...]]], chance: Chance | None) -> Rule | None:
        """Of the rules that match the one that is applied: the first, or one by lot where the first has a probability."""
        if not matched or matched[0][0].probability is None:
            return matched[0][0] if matched else None
        lots = self.lots(matched, chance)
        unit = chance.unit() if chance else 0.0
        try:
            return lots[choose([weight for _, weight in lots], unit)][0]
        except ValueError as fault:
            raise rule_error(self.system, lots[0][0].production.predecessor, lots[0][0], fault) from None
        except TypeError:
            raise rule_error(self.system, lots[0][0].production.predecessor, lots[0][0], ValueError(UNKNOWN)) from None

    def lots(self, matched: Sequence[tuple[Rule, tuple[Value, ...]]], chance: Chance | None = None) -> list[tuple[Rule, Value]]:
        """Of the rules that match those that are chosen by lot, each with its weight."""
        return [(rule, self.weight(rule, values, chance)) for rule, values in matched if rule.probability]

    def weight(self, rule: Rule, values: tuple[Value, ...], chance: Chance | None = None) -> Value:
        """How likely a rule that is left to chance is chosen, beside others."""
        assert rule.probability
        try:
            return finite(rule.probability((*values, *self.constants, chance)))
        except (ArithmeticError, ValueError) as fault:
            raise rule_error(self.system, rule.production.predecessor, rule, fault) from None

    def made(self, rule: Rule, module: Module, values: tuple[Value, ...] | None = None,
             chance: Chance | None = None) -> Iterator[tuple[str, tuple[Value, ...]]]:
        """The symbols and values that a rule makes of a module, given the values of all parameters that it names."""
        given = (*(module.arguments if values is None else values), *self.constants)
        try:
            yield from self._written(rule.successor, given, chance)
        except (ArithmeticError, ValueError) as fault:
            raise rule_error(self.system, module, rule, fault) from None
        except TypeError:
            if not any(map(is_symbolic, given)):
                raise
            raise rule_error(self.system, module, rule, ValueError(UNKNOWN)) from None

    def _written(self, parts: Iterable[ModuleTemplate | RepeatTemplate], given: tuple[object, ...],
                 chance: Chance | None) -> Iterator[tuple[str, tuple[Value, ...]]]:
        values: tuple[object, ...] = (*given, chance)
        for part in parts:
            if isinstance(part, ModuleTemplate):
                yield part.symbol, tuple([self._kept(argument(values)) for argument in part.arguments])
            else:
                for index in range(_times(part.count(values))):
                    yield from self._written(part.body, (*given, index), chance)

    def made_numbers(self, rule: Rule, module: Module, values: Sequence[object] | None = None,
                     chance: Chance | None = None) -> tuple[int, ...]:
        """The states that a rule makes of a module, before any decomposition."""
        return tuple(self.number(made.symbol, made.arguments) for made in self._made(rule, module, values, chance))  # type: ignore[arg-type]

    def replaced(self, rule: Rule, module: Module, values: Sequence[object] | None = None,
                 chance: Chance | None = None) -> tuple[int, ...]:
        """The states that replace a module by a rule, after decomposition."""
        if not self.decomposition:
            return self.made_numbers(rule, module, values, chance)
        return tuple(state for made in self._made(rule, module, values, chance) for state in self.parts(made, chance))

    def _made(self, rule: Rule, module: Module, values: Sequence[object] | None, chance: Chance | None) -> list[Module]:
        """The modules that a rule makes; no more of them than a word may have."""
        found, most = [], current().modules
        self._outgrown = False
        for symbol, made in self.made(rule, module, values, chance):  # type: ignore[arg-type]
            if self._outgrown and self.inexact is None:
                self.inexact = Module(symbol, made)
            found.append(Module(symbol, made))
            if len(found) > most and module is not AXIOM:  # the axiom is step 0, which is checked like any step
                start, end = rule.production.at or (None, None)
                raise ModelLimitError(f"{module} becomes more than {most:,} modules in one step", limit=most,
                                      source=self.system.source or None, start=start, end=end)
        return found

    def parts(self, module: Module, chance: Chance | None = None) -> tuple[int, ...]:
        """The states of a module's parts, and of their parts, until nothing is left to replace or the depth is reached."""
        if self.traits.varying_decomposition:
            return self._taken_apart(module, chance)
        key = (module.symbol, module.arguments, *map(type, module.arguments))
        if key not in self._parts:
            self._parts[key] = self._taken_apart(module, chance)
        return self._parts[key]

    def _taken_apart(self, module: Module, chance: Chance | None) -> tuple[int, ...]:
        found: list[int] = []
        deepest, most, asked = current().decomposition, current().modules, self.system.decomposition_depth
        todo = [(module, 0)]
        while todo:
            part, depth = todo.pop()
            rule = self.matching(part, self.decomposition, chance) if depth != asked else None
            if rule is None:
                found.append(self.number(part.symbol, part.arguments))  # type: ignore[arg-type]
            elif depth == deepest:
                start, end = rule.production.at or (None, None)
                raise ModelLimitError(f"{part} is decomposed more than {deepest} times, last by "
                                      f"{as_written(self.system, rule.production)}",
                                      limit=deepest, source=self.system.source or None, start=start, end=end,
                                      hint="A condition before the arrow can bring it to an end.")
            else:
                todo += [(made, depth + 1) for made in reversed(self._made(rule, part, None, chance))]
            if len(found) + len(todo) > most:
                raise ModelLimitError(f"{module} is decomposed into more than {most:,} modules", limit=most)
        return tuple(found)

    def _axiom(self) -> Iterable[int]:
        """The axiom's states: its arguments may use the constants, so it is made like a successor."""
        places = [module.at for module in self.system.axiom if module.at]
        start = Production(AXIOM, self.system.axiom, at=(places[0][0], places[-1][1]) if places else None)
        return self.made_numbers(rule_for(self.system, 0, start, self.arithmetic), AXIOM)

    def _kept(self, value: Value) -> Value:
        """The value as the table keeps it: rational up to 128 bits, else a double that is a number."""
        if value.__class__ is int and -SMALL < value < SMALL:
            return value
        finite(value)
        if is_symbolic(value):
            value = expanded_value(value)
        if isinstance(value, float) or is_symbolic(value):
            return value
        if max(value.numerator.bit_length(), value.denominator.bit_length()) <= EXACT_BITS:
            return value
        self._outgrown = True
        return float(value)


def _times(count: Value) -> int:
    """How often something is repeated."""
    most = current().repetitions
    if count != int(count) or count < 0:
        raise ValueError(f"it is repeated {float(count):g} times, which is no whole number from 0 on")
    if count > most:
        raise ValueError(f"it is repeated {int(count):,} times; the limit is {most:,}")
    return int(count)
