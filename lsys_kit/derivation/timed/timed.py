"""Timed systems: the word at any time, not only after whole steps (ABOP, chapter 6).

A module's one parameter is its age. A production `ar(1) -> al(0) br(0)` says at which age a cell divides, its terminal age, and
with which ages its daughters begin. With D(x, t) for what a word x becomes in a time t:

    D(xy, t) = D(x, t) D(y, t)
    D(a(age), t) = a(age + t)                             while age + t <= terminal age
                 = D(successor, t - (terminal - age))     from then on

At its terminal age a cell is not yet divided. The lengths of cells are the subject of `continuity`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import count, repeat

from lsys_kit.budget import Task, check_budget, current
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.derivation.core.states import MODULES_BETWEEN_CHECKS, States, check_d0l
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.timed.ages import AgeModel, TimedAges, age_model, place_of, undecided_age
from lsys_kit.errors import ModelLimitError, ModelValueError, every, require
from lsys_kit.notation.model.arithmetic import Value, is_symbolic, normalised, number_text
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.write import as_written


@dataclass(frozen=True)
class Timed:
    """A timed system: how its modules grow older, and how their lives end."""

    ages: AgeModel

    def __repr__(self) -> str:
        return f"In continuous time:\n{self.states.system!r}"

    @property
    def states(self) -> States:
        """The table of its modules."""
        return self.ages.states

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
        >>> from lsys_kit import read
        >>> fibonacci = timed(read("axiom: a(0)\\na(1) -> a(0) b(0)\\nb(1) -> a(0)"))
        >>> print(fibonacci.word("5/2"), fibonacci.word(1))
        a(0.5)b(0.5)a(0.5) a(1)
        """
        given = number_from(at, "time")
        if is_symbolic(given):
            raise ModelValueError(f'"time" must be a number, not {number_text(given)!r}')
        if given < 0:
            raise ModelValueError(f"The time must not be before the axiom, which is at 0, but it is {at}")
        with Task("The word was not reached"):
            return self.later(self._axiom(), given)

    def _axiom(self) -> list[Module]:
        return [self.states.modules[state] for state in self.states.axiom]

    def around(self, at: Value) -> tuple[Word, Word]:
        """The words just before and just after what happens at a time: in the first no module divides at this very time.

        >>> from lsys_kit import read
        >>> fibonacci = timed(read("axiom: a(0)\\na(1) -> a(0) b(0)\\nb(1) -> a(0)"))
        >>> print(*fibonacci.around(1))
        a(1) a(0)b(0)
        """
        time = number_from(at, "time")
        return self.later(self._axiom(), time, already=False), self.later(self._axiom(), time, already=True)

    def divisions(self, until: Value) -> Iterator[Value]:
        """The times at which modules divide, each once, the earliest first, up to a time.

        >>> from lsys_kit import read
        >>> [*timed(read("axiom: a(0)\\na(1) -> a(0.5) b(0)\\nb(2) -> a(0)")).divisions(3)]
        [1, Fraction(3, 2), 2, Fraction(5, 2), 3]
        """
        order, told, until = count(), None, number_from(until, "time")
        born: Value = 0
        todo: list[tuple[Value, int, list[Module]]] = []
        modules = self._axiom()
        while True:
            for module in modules:
                rest, daughters = self.division(module, until - born, already=True)
                if daughters is not None:
                    heappush(todo, (normalised(until - rest), next(order), daughters))
            if not todo:
                return
            born, _, modules = heappop(todo)
            if born != told:
                yield born
            told = born

    def later(self, word: list[Module], passed: Value, already: bool | None = None) -> Word:
        """What a row of modules becomes in a time: D(word, passed); `already` as for `division`."""
        found = []
        most, deepest, passed = current().modules, current().brackets, number_from(passed, "time")
        every(word, Module, "A module")
        todo = [(module, passed, 0) for module in reversed(word)]
        visited = 0
        while todo:
            module, left, instant = todo.pop()
            rest, daughters = self.division(module, left, already)
            if daughters is None:
                end, age = self.ages.end(module), (self.ages.age(module) or 0) + left
                stays = end is not None and end.rule is None and age > end.age
                older = self.ages.aged(module, normalised(end.age if end is not None and stays else age))
                found.append(self.states.number(older.symbol, older.arguments))
            elif instant > deepest:
                raise ModelValueError(
                    f"{module} divides endlessly within one instant",
                    hint="Let a daughter begin younger than the age at which she divides.",
                )
            else:
                instant = instant + 1 if rest == left else 0
                todo += zip(reversed(daughters), repeat(rest), repeat(instant))
            visited += 1
            if len(found) + len(todo) > most:
                raise ModelLimitError(
                    f"The word would have more than {most:,} modules",
                    limit=most,
                    hint="Take an earlier time, or set limits(modules=...).",
                )
            if visited % MODULES_BETWEEN_CHECKS == 0:
                check_budget()
        return Word(self.states, found)

    def division(self, module: Module, left: Value, already: bool | None = None) -> tuple[Value, list[Module] | None]:
        """The time that is left after a module's division, and its daughters; None where it does not divide in that time.

        Whether it has divided already where no time is left is said by its rule, unless `already` says it.
        """
        require(module, Module, "A module")
        end = self.ages.end(module)
        if end is None or end.rule is None:
            return left, None
        self.ages.check_birth(module)
        rest: Value = normalised(left - (end.age - (self.ages.age(module) or 0)))
        try:
            divides = rest > 0 or (rest == 0 and (end.already if already is None else already))
        except TypeError:
            raise undecided_age(self.states, module, end.rule.production) from None
        return (rest, self.ages.daughters(module)) if divides else (left, None)


def timed(system: LSystem, **constants: object) -> Timed:
    """A system as it is at any time, not only after whole steps.

    Parameters
    ----------
    system
        A context-free system without chance, in which the one parameter of each module is its age and productions give the age
        at which it is replaced: `a(1) -> b(0) a(0)`. Or one whose productions let time pass in steps, `a(t) -> a(t+dt)`, and
        whose other rules tell how long a module lives: `a(t) : t >= 1 -> b(t-1) a(t-1)`.
    **constants
        New values for declared constants.

    Raises
    ------
    ModelValueError
        The productions do not say how long modules live, or depend on neighbours or chance.

    Examples
    --------
    >>> from lsys_kit import read
    >>> print(timed(read("axiom: a(1)\\na(t) : t < 3 -> a(t+1)\\na(3) -> a(1) b(1)\\nb(t) -> b(t+1)")).word("7/2"))
    a(1.5)b(1.5)
    """
    states = States(system, constants)
    check_d0l(states, "The word at any time")
    stepwise = age_model(states)
    if stepwise.tells_ends:
        for state in states.axiom:
            stepwise.end(states.modules[state])
        return Timed(stepwise)
    for rules in states.rules.values():
        for rule in rules:
            if [index for index, _ in rule.equalities] != [0] or rule.condition is not None:
                shown = as_written(system, rule.production)
                raise ModelValueError(
                    f"The production {shown} does not say at which age it applies",
                    *place_of(states, rule.production),
                    'A timed production reads "a(1) -> b(0) a(0)"; in steps of time it reads '
                    '"a(t) : t >= 1 -> b(t-1) a(t-1)", beside "a(t) -> a(t+dt)".',
                )
    return Timed(TimedAges(states, lambda kind: 0 if kind[1] else None, None))
