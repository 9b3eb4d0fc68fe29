"""One step of any system, module by module: all modules of a word are replaced, each by what the definition says.

Where a production's strict predecessor has several modules, these are replaced together. The word is scanned from left to
right: at each place the production is looked for that begins there, and the scan goes on behind what it replaces, so that no
module is replaced twice. Contexts are those of the word before the step (pseudo-L-systems: Prusinkiewicz, Graphical
applications of L-systems, Graphics Interface 1986).

What a module becomes depends on its state, on the states that the contexts of its rules name, and on chance. Results of equal
cases are computed once and kept, unless a rule draws random values or asks what the turtle sees.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

from lsys_kit.derivation.core.chance import Chance
from lsys_kit.derivation.core.matching import (
    Neighbours,
    match_context,
    match_predecessor,
    neighbours,
    neighbours_along,
    passing_of,
    values_at,
)
from lsys_kit.derivation.core.rules import Rule, is_branch
from lsys_kit.derivation.core.states import Match, States
from lsys_kit.derivation.core.traits import CUT
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.modules import CLOSING, OPENING, Module

SensingFunction: TypeAlias = Callable[..., Value]
"""Answers a module: from its position, the number of a sensitive function and the function's arguments."""


@dataclass(frozen=True)
class Replacement:
    """What one module becomes, or several that are replaced together.

    states
        The states that replace it.
    production
        The place of the production in the order written, or None where none was applied.
    size
        How many modules it replaces, from its own place on; 0 where the module is replaced together with one before it.
    """

    states: tuple[int, ...]
    production: int | None
    size: int = 1


@dataclass(frozen=True)
class ParentWord:
    """The word before a step: its states, modules and symbols, their neighbours, and what each module sees."""

    codes: Sequence[int]
    modules: Sequence[Module]
    symbols: Sequence[str]
    around: Neighbours | None
    sees: SensingFunction | None

    def chance(self, seed: int, step: int, position: int) -> Chance:
        """The random numbers of a module, with what it sees."""
        return Chance(seed, step, position, self.sees and partial(self.sees, position))


class Stepper:
    """The steps of one system under one seed; equal cases are computed once.

    >>> from lsys_kit import read
    >>> states = States(read("axiom: b a a\\nb < a -> b"))
    >>> stepper = Stepper(states, 0)
    >>> [replaced.states for replaced in stepper.replacements(list(states.axiom), 0)]
    [(0,), (0,), (1,)]
    """

    def __init__(self, states: States, seed: int) -> None:
        self.states, self.seed = states, seed
        self.passing = passing_of(states.system)
        self.in_context, self.together = states.traits.context > 0, states.traits.predecessor > 1
        self._alone: dict[int, Replacement] = {}
        self._matched: dict[tuple[object, ...], list[Match]] = {}
        self._made: dict[tuple[object, ...], Replacement] = {}

    def forget(self) -> None:
        """Give back what is kept of cases."""
        for kept in (self._alone, self._matched, self._made):
            kept.clear()

    def old(self, codes: Sequence[int], sees: SensingFunction | None = None) -> ParentWord:
        """A word as the parent of the next one."""
        modules = [self.states.modules[code] for code in codes]
        symbols = [module.symbol for module in modules]
        return ParentWord(codes, modules, symbols, neighbours(symbols, self.passing) if self.in_context else None, sees)

    def replacements(self, codes: Sequence[int], step: int, sees: SensingFunction | None = None) -> Iterator[Replacement]:
        """What each module of a word becomes; what is cut off becomes nothing.

        What several modules become together is given with the first of them.
        """
        old, nothing, taken = self.old(codes, sees), Replacement((), None), Replacement((), None, 0)
        behind = 0  # where the scan goes on
        for position, (code, kept) in enumerate(zip(codes, surviving(old.symbols), strict=True)):
            if not kept:
                yield nothing
            elif position < behind:
                yield taken
            elif code in self._alone:
                yield self._alone[code]
            elif self.states.is_d0l(code):
                yield self._alone.setdefault(code, Replacement(self.states.successor(code), self.states.production(code)))
            else:
                replacement = self._open(old, position, old.chance(self.seed, step, position))
                behind = position + replacement.size
                yield replacement

    def _open(self, old: ParentWord, position: int, chance: Chance) -> Replacement:
        """What becomes of a module whose state does not decide that alone."""
        matched = self.matched(old, position, chance)
        rule = self.states.choose_rule(matched, chance)
        if rule is None:
            return Replacement(self.states.decompose(old.modules[position], chance), None)
        values = next(values for found, values in matched if found is rule)
        size = len(rule.predecessors)
        key = old.codes[position] if size == 1 else tuple(old.codes[position : position + size]), values, rule.number
        repeatable = not (rule.random or rule.looks or self.states.traits.varying_decomposition)
        if repeatable and key in self._made:
            return self._made[key]
        replacement = Replacement(self.states.replacement(rule, old.modules[position], values, chance), rule.number, size)
        if repeatable:
            self.states.keep(replacement.states)
            self._made[key] = replacement
        return replacement

    def matched(self, old: ParentWord, position: int, chance: Chance | None = None) -> list[Match]:
        """The rules that match the module at a position."""
        rules = self.states.candidates(old.codes[position])
        case = self._case(rules, old, position)
        if case is None:
            return self._matching(rules, old, position, chance)
        if case not in self._matched:
            self._matched[case] = self._matching(rules, old, position, chance)
        return self._matched[case]

    def _case(self, rules: Sequence[Rule], old: ParentWord, position: int) -> tuple[object, ...] | None:
        """The states on which matching depends; None where it depends on what is seen, on chance, on whole branches, or on the
        contexts of several modules."""
        if any(rule.matches_anew for rule in rules):
            return None
        longest = max((len(rule.predecessors) for rule in rules), default=1) if self.together else 1
        if old.around is None:
            return tuple(old.codes[position : position + longest])
        if longest > 1 or any(is_branch(item) for rule in rules for item in rule.right):
            return None
        left = neighbours_along(old.around.before, position, max((len(rule.left) for rule in rules), default=0))
        right = neighbours_along(old.around.after, position, max((len(rule.right) for rule in rules), default=0))
        return (old.codes[position], *(old.codes[at] for at in left), None, *(old.codes[at] for at in right))

    def context(self, rule: Rule, old: ParentWord, position: int) -> tuple[int, ...] | None:
        """The positions of the modules that a rule names, where what it replaces is there and its contexts match; else None."""
        own = match_predecessor(rule, old.modules, position) if self.together else (position,)
        if own is None or (len(own) > 1 and CUT in old.symbols[own[1] : own[-1] + 1]):  # no rule replaces what is cut off
            return None
        return own if old.around is None else match_context(rule, old.modules, old.around, own)

    def _matching(self, rules: Sequence[Rule], old: ParentWord, position: int, chance: Chance | None) -> list[Match]:
        found: list[Match] = []
        for rule in rules:
            at = self.context(rule, old, position)
            if at is None:
                continue
            values = values_at(old.modules, at)
            if self.states.matches(rule, values, old.modules[position], chance):
                if not found and rule.probability is None:
                    return [(rule, values)]
                if rule.probability is not None:
                    found.append((rule, values))
        return found


def surviving(symbols: Sequence[str]) -> Iterator[bool]:
    """For each position whether it is kept: a cut takes itself away and all behind it, up to the end of its branch.

    >>> [symbol for symbol, kept in zip("A[B%C[D]]E", surviving("A[B%C[D]]E")) if kept]
    ['A', '[', 'B', ']', 'E']
    """
    depth = 0  # of the brackets inside what is cut off, from 1 on
    for symbol in symbols:
        if depth:
            depth += (symbol in OPENING) - (symbol in CLOSING)
        elif symbol == CUT:
            depth = 1
        yield not depth
