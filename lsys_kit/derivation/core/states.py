"""The table of states: each distinct module that a derivation meets, numbered in the order in which it is met.

Where a module's symbol and values alone decide what becomes of it, its successor is computed once, here, however often the
module occurs. A word is then an array of states, the growth matrix counts states in successors, and the stage diagram is this
table drawn. Where neighbours or chance matter, the table still numbers the modules, and what they become is computed for
each combination that occurs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, TypeVar

from lsys_kit.budget import check_bytes, counted, current
from lsys_kit.derivation.core.application import RuleApplication
from lsys_kit.derivation.core.chance import Chance
from lsys_kit.derivation.core.rule_errors import AXIOM
from lsys_kit.derivation.core.rules import Rule, kind_of, rule_for, rules_of
from lsys_kit.derivation.core.traits import traits_of
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.model.arithmetic import Value, is_symbolic
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.write import as_written

_T = TypeVar("_T")
ROW_BYTES = 8
"""What a state takes in a row of states."""
MODULES_BETWEEN_CHECKS = 100
"""The budget is checked after so many modules have been decomposed."""


class Successors(dict[int, tuple[int, ...]]):
    """What replaces each state that alone decides it in one step, found when it is first asked for."""

    def __init__(self, states: States) -> None:
        self.states = states

    def __missing__(self, state: int) -> tuple[int, ...]:
        states, module = self.states, self.states.modules[state]
        rule = states.rule(state)
        found = states.keep(states.decompose(module) if rule is None else states.replacement(rule, module))
        self[state] = found
        return found


class States(RuleApplication):
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
        The first module with a value that outgrew 128 bits and became a double, or None.

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
        super().__init__(system, constants, arithmetic)
        self.modules: list[Module] = []
        self.inexact: Module | None = None
        self._numbers: dict[tuple[object, ...], int] = {}
        self._row_states = 0
        self.successors = Successors(self)
        self._applied: dict[int, Rule | None] = {}
        self._decompositions: dict[tuple[object, ...], tuple[int, ...]] = {}
        self.rules = rules_of(system, arithmetic)
        self.decomposition = rules_of(system, arithmetic, "decomposition")
        self._joined = frozenset(kind for rules in self.rules.values() for rule in rules for kind in rule.predecessors[1:])
        known = traits_of(system, arithmetic)
        self.traits = known._replace(unknown=True) if any(map(is_symbolic, self.constants)) else known
        self.axiom = tuple(self._axiom())

    def __len__(self) -> int:
        return len(self.modules)

    def __getstate__(self) -> dict[str, Any]:
        """The table without its rules, which are functions; they are made again from the system."""
        return {**vars(self), "rules": {}, "decomposition": {}, "_applied": {}}

    def __setstate__(self, kept: dict[str, Any]) -> None:
        vars(self).update(kept)
        self.rules = rules_of(self.system, self.arithmetic)
        self.decomposition = rules_of(self.system, self.arithmetic, "decomposition")

    def number(self, symbol: str, values: tuple[Value, ...] = ()) -> int:
        """The state of a module, a new one where it has not been met."""
        key = (symbol, values, *map(type, values))
        found = self._numbers.get(key)
        if found is None:
            found = len(self.modules)
            self.modules.append(Module(symbol, values))
            self._numbers[key] = found  # last, so that an interrupt leaves no number without its module
        return found

    def keep(self, row: tuple[int, ...]) -> tuple[int, ...]:
        """A row of states that is going to be kept, if there is room for it."""
        self._row_states += len(row)
        check_bytes(self._row_states * ROW_BYTES, lambda: "What becomes of each module is not known")
        return row

    def candidates(self, state: int) -> tuple[Rule, ...]:
        """The productions for modules of a state's symbol and number of parameters, in the order written."""
        return self.rules.get(kind_of(self.modules[state]), ())

    def is_d0l(self, state: int) -> bool:
        """Whether the state alone decides what becomes of it, unless it is cut off."""
        return (
            not self.traits.varying_decomposition
            and all(rule.d0l for rule in self.candidates(state))
            and not (self._joined and kind_of(self.modules[state]) in self._joined)
        )

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
                raise ModelValueError(
                    f"What becomes of {self.modules[state]} does not depend on its symbol and values alone",
                    hint="Derive the system, and ask for the origins of a step.",
                )
            self._applied[state] = self.matching_rule(self.modules[state], self.rules)
        return self._applied[state]

    def applied_states(
        self, rule: Rule, module: Module, values: Sequence[object] | None = None, chance: Chance | None = None
    ) -> tuple[int, ...]:
        """The states that a rule makes of a module, before any decomposition."""
        return tuple(self.number(*made) for made in self._made(rule, module, values, chance))

    def replacement(
        self, rule: Rule, module: Module, values: Sequence[object] | None = None, chance: Chance | None = None
    ) -> tuple[int, ...]:
        """The states that replace a module by a rule, after decomposition."""
        if not self.decomposition:
            return self.applied_states(rule, module, values, chance)
        found: list[int] = []
        for made in [*self._made(rule, module, values, chance)]:  # all draw their random numbers before any is decomposed
            found += self.decompose(Module(*made), chance)
            if len(found) > current().modules:
                raise self._too_many(rule, module)
        return tuple(found)

    def _made(
        self, rule: Rule, module: Module, values: Sequence[object] | None, chance: Chance | None
    ) -> Iterator[tuple[str, tuple[Value, ...]]]:
        """The symbols and values of the modules that a rule makes; no more of them than a word may have."""
        most = current().modules
        self._outgrown = False
        for number, made in enumerate(self.apply(rule, module, values, chance)):  # type: ignore[arg-type]
            if self._outgrown and self.inexact is None:
                self.inexact = Module(*made)
            if number == most and module is not AXIOM:  # the axiom is step 0, which is checked like any step
                raise self._too_many(rule, module)
            yield made

    def _too_many(self, rule: Rule, module: Module) -> ModelLimitError:
        most, (start, end) = current().modules, rule.production.at or (None, None)
        return ModelLimitError(
            f"{module} becomes more than {most:,} modules in one step",
            limit=most,
            source=self.system.source or None,
            start=start,
            end=end,
        )

    def decompose(self, module: Module, chance: Chance | None = None) -> tuple[int, ...]:
        """The states of a module's parts, and of their parts, until nothing is left to replace or the depth is reached."""
        if self.traits.varying_decomposition:
            return self._decomposed(module, chance)
        key = (module.symbol, module.arguments, *map(type, module.arguments))
        if key not in self._decompositions:
            self._decompositions[key] = self.keep(self._decomposed(module, chance))
        return self._decompositions[key]

    def _decomposed(self, module: Module, chance: Chance | None) -> tuple[int, ...]:
        found: list[int] = []
        most, asked = current().modules, self.system.decomposition_depth
        deepest = current().decomposition if asked is None else current().repetitions
        todo = [(module, 0)]
        for part, depth in counted(popped(todo), MODULES_BETWEEN_CHECKS):
            rule = self.matching_rule(part, self.decomposition, chance) if depth != asked else None
            if rule is None:
                found.append(self.number(part.symbol, part.arguments))
            elif depth == deepest:
                start, end = rule.production.at or (None, None)
                raise ModelLimitError(
                    f"{module} is decomposed more than {deepest} times, last by {as_written(self.system, rule.production)}",
                    limit=deepest,
                    source=self.system.source or None,
                    start=start,
                    end=end,
                    hint="A condition before the arrow can bring it to an end."
                    if rule.production.condition is None
                    else "What is made must come nearer to where the condition ends.",
                )
            else:
                todo += [(Module(*made), depth + 1) for made in reversed([*self._made(rule, part, None, chance)])]
            if len(found) + len(todo) > most:
                raise ModelLimitError(f"{module} is decomposed into more than {most:,} modules", limit=most)
        return tuple(found)

    def _axiom(self) -> Iterable[int]:
        """The axiom's states: its arguments may use the constants, so it is made like a successor."""
        places = [module.at for module in self.system.axiom if module.at]
        start = Production((Pattern(AXIOM.symbol),), self.system.axiom, at=(places[0][0], places[-1][1]) if places else None)
        return self.applied_states(rule_for(self.system, 0, start, self.arithmetic), AXIOM)


def popped(stack: list[_T]) -> Iterator[_T]:
    """The things on a stack, until none is left; whoever takes one may put others there."""
    while stack:
        yield stack.pop()
