"""Timed systems: the word at any time, not only after whole steps (ABOP, chapter 6).

A module's one parameter is its age. A production `ar(1) -> al(0) br(0)` says at which age a cell divides, its terminal age, and
with which ages its daughters begin. With D(x, t) for what a word x becomes in a time t:

    D(xy, t) = D(x, t) D(y, t)
    D(a(age), t) = a(age + t)                             while age + t <= terminal age
                 = D(successor, t - (terminal - age))     from then on

At its terminal age a cell is not yet divided. The lengths of cells are the subject of `continuity`.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import cached_property
from itertools import repeat

from lsys_kit.budget import current
from lsys_kit.derivation.core.closure import check_d0l
from lsys_kit.derivation.core.rules import ModuleKind, kind_of, number_from
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.engines.engine import CLOCK_INTERVAL
from lsys_kit.derivation.timed.ages import AgeModel, RuleAndAge, timed_age_model, undecided_age
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.model.arithmetic import Value, is_symbolic, number_text
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.write import as_written


@dataclass(frozen=True)
class Timed:
    """A timed system.

    Attributes
    ----------
    states
        The table of its modules.
    """

    states: States

    @cached_property
    def ages(self) -> AgeModel:
        """How its modules grow older, and how their lives end."""
        return timed_age_model(self.states)

    @cached_property
    def _ends(self) -> dict[ModuleKind, RuleAndAge | None]:
        """How each kind of module ends: its terminal age depends on nothing else."""
        return {}

    def word(self, at: object) -> Word:
        """The word at a time.

        Parameters
        ----------
        at
            The time since the axiom: a number, exact as in `derive`.

        Raises
        ------
        ModelValueError
            The time is before the axiom, or cells divide endlessly within one instant.
        ModelLimitError
            The word would be too large, or takes too long.

        Examples
        --------
        >>> from lsys_kit.notation.read import read
        >>> fibonacci = timed(read("axiom: a(0)\\na(1) -> a(0) b(0)\\nb(1) -> a(0)"))
        >>> print(fibonacci.word("5/2"), fibonacci.word(1))
        a(0.5)b(0.5)a(0.5) a(1)
        """
        given = number_from(at, "time")
        if is_symbolic(given):
            raise ModelValueError(f'"time" must be a number, not {number_text(given)!r}')
        if given < 0:
            raise ModelValueError(f"The time must not be before the axiom, which is at 0, but it is {at}")
        return self.later([self.states.modules[state] for state in self.states.axiom], given)

    def later(self, word: list[Module], passed: Value) -> Word:
        """What a row of modules becomes in a time: D(word, passed)."""
        found: list[int] = []
        until, most, deepest = time.monotonic() + current().seconds, current().modules, current().brackets
        todo = [(module, passed, 0) for module in reversed(word)]
        visited = 0
        while todo:
            module, left, instant = todo.pop()
            rest, daughters = self._division(module, left)
            if daughters is None:
                older = self.ages.aged(module, (self.ages.age(module) or 0) + left)
                found.append(self.states.number(older.symbol, older.arguments))
            elif instant > deepest:
                raise ModelValueError(f"{module} divides endlessly within one instant",
                                      hint="Let a daughter begin younger than the age at which she divides.")
            else:
                instant = instant + 1 if rest == left else 0
                todo += zip(reversed(daughters), repeat(rest), repeat(instant))
            visited += 1
            if len(found) + len(todo) > most:
                raise ModelLimitError(f"The word would have more than {most:,} modules", limit=most,
                                      hint="Take an earlier time, or set limits(modules=...).")
            if visited % CLOCK_INTERVAL == 0 and time.monotonic() > until:
                raise ModelLimitError(f"The word was not reached in {current().seconds:g} seconds", limit=current().seconds,
                                      hint="Take an earlier time, or set limits(seconds=...).")
        return Word(self.states, found)

    def _division(self, module: Module, left: Value) -> tuple[Value, list[Module] | None]:
        """The time that is left after a module's division, and its daughters; None where it does not divide in that time."""
        kind = kind_of(module)
        if kind not in self._ends:
            self._ends[kind] = self.ages.end(module)
        end = self._ends[kind]
        if end is None:
            return left, None
        rule, terminal = end
        rest: Value = left - (terminal - module.arguments[0])
        try:
            return (left, None) if rest <= 0 else (rest, self.ages.made(rule, self.ages.aged(module, terminal)))
        except TypeError:
            raise undecided_age(self.states, module, rule.production) from None


def timed(system: LSystem, **constants: object) -> Timed:
    """A timed system, in which the one parameter of each module is its age.

    Parameters
    ----------
    system
        A context-free system whose productions give the age at which a module is replaced: `a(1) -> b(0) a(0)`.
    **constants
        New values for declared constants.

    Raises
    ------
    ModelValueError
        A production does not say at which age it applies, or depends on neighbours or chance.
    """
    states = States(system, constants)
    check_d0l(states, "The word at any time")
    for rules in states.rules.values():
        for rule in rules:
            if [index for index, _ in rule.equalities] != [0] or rule.condition is not None:
                start, end = rule.production.at or (None, None)
                shown = as_written(system, rule.production)
                raise ModelValueError(f"The production {shown} does not say at which age it applies",
                                      system.source or None, start, end, 'A timed production reads "a(1) -> b(0) a(0)".')
    return Timed(states)
