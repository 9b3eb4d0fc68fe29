"""Applying rules: which rules match a module, which of them is applied, and what it makes, as symbols and values."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

from lsys_kit.budget import check_budget, counted, current
from lsys_kit.derivation.core.chance import Chance, choose
from lsys_kit.derivation.core.rule_errors import UNKNOWN, rule_error, undecided_condition
from lsys_kit.derivation.core.rules import ModuleTemplate, RepeatTemplate, Rule, Rules, constants_of, kind_of
from lsys_kit.errors import ModelNameError, require
from lsys_kit.notation.model.arithmetic import SMALL, Value, equal_values, expanded_value, finite, is_symbolic
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem

Match: TypeAlias = tuple[Rule, tuple[Value, ...]]
"""A rule that matches, with the values of all parameters that it names."""
EXACT_BITS = 128
"""A rational value with more bits than this becomes a double."""


class RuleApplication:
    """The rules of a system at work, under given constants.

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
    constants
        The values of all declared constants, in their order.
    """

    def __init__(self, system: LSystem, constants: dict[str, object] | None = None, arithmetic: str = "exact") -> None:
        require(system, LSystem, "An L-system")
        require(arithmetic, str, "The name of an arithmetic")
        if arithmetic not in ("exact", "float"):
            raise ModelNameError(f'There is no arithmetic called "{arithmetic}"', hint='Choose "exact" or "float".')
        self.system, self.arithmetic = system, arithmetic
        self.constants = constants_of(system, constants or {}, arithmetic)
        self._outgrown = False

    def matching_rule(self, module: Module, rules: Rules, chance: Chance | None = None) -> Rule | None:
        """The rule that rewrites a module, of rules that need no context."""
        return self.choose_rule(self.matching_rules(module, rules, chance), chance)

    def matching_rules(self, module: Module, rules: Rules, chance: Chance | None = None) -> list[Match]:
        """The rules that match a module, up to the first that has no probability."""
        values: tuple[Value, ...] = module.arguments
        found: list[Match] = []
        for rule in rules.get(kind_of(module), ()):
            if self.matches(rule, values, module, chance):
                found.append((rule, values))
                if found[0][0].probability is None:
                    break
        return found

    def matches(self, rule: Rule, values: tuple[Value, ...], module: Module, chance: Chance | None = None) -> bool:
        """Whether a rule accepts some values: they are equal to those it asks for, and its condition is true."""
        given = (*values, *self.constants, chance)
        try:
            return all(equal_values(values[i], wanted(given)) for i, wanted in rule.equalities) and (
                rule.condition is None or bool(rule.condition(given))
            )
        except TypeError:
            raise undecided_condition(self.system, self.constants, module, rule) from None
        except (ArithmeticError, ValueError) as fault:
            raise rule_error(self.system, module, rule, fault) from None

    def choose_rule(self, matched: Sequence[Match], chance: Chance | None) -> Rule | None:
        """The rule that is applied, of those that match: the first, or one at random where the first has a probability."""
        if not matched or matched[0][0].probability is None:
            return matched[0][0] if matched else None
        weighted = self.weighted(matched, chance)
        unit = chance.unit() if chance else 0.0
        try:
            return weighted[choose([weight for _, weight in weighted], unit)][0]
        except ValueError as fault:
            raise rule_error(self.system, weighted[0][0].production.predecessor, weighted[0][0], fault) from None
        except TypeError:
            raise rule_error(self.system, weighted[0][0].production.predecessor, weighted[0][0], ValueError(UNKNOWN)) from None

    def weighted(self, matched: Sequence[Match], chance: Chance | None = None) -> list[tuple[Rule, Value]]:
        """The rules with a probability, of those that match, each with its weight."""
        return [(rule, self.weight(rule, values, chance)) for rule, values in matched if rule.probability]

    def weight(self, rule: Rule, values: tuple[Value, ...], chance: Chance | None = None) -> Value:
        """The weight with which a rule is chosen at random."""
        assert rule.probability
        try:
            return finite(rule.probability((*values, *self.constants, chance)))
        except (ArithmeticError, ValueError) as fault:
            raise rule_error(self.system, rule.production.predecessor, rule, fault) from None

    def apply(
        self, rule: Rule, module: Module, values: tuple[Value, ...] | None = None, chance: Chance | None = None
    ) -> Iterator[tuple[str, tuple[Value, ...]]]:
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

    def _written(
        self, parts: Iterable[ModuleTemplate | RepeatTemplate], given: tuple[object, ...], chance: Chance | None
    ) -> Iterator[tuple[str, tuple[Value, ...]]]:
        values: tuple[object, ...] = (*given, chance)
        for part in parts:
            if isinstance(part, ModuleTemplate):
                yield part.symbol, tuple([self._kept(argument(values)) for argument in part.arguments])
            else:
                check_budget()  # repetitions within repetitions may each be few
                for index in counted(range(_times(part.count(values)))):
                    yield from self._written(part.body, (*given, index), chance)

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
