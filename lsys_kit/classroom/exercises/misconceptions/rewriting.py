"""Misconceptions about rewriting: steps that are not those of an L-system, from a row of states to the next."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

from lsys_kit.classroom.exercises.asked import beginning_with
from lsys_kit.derivation.core.states import States
from lsys_kit.notation.model.modules import CLOSING, OPENING, Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.worlds.derive import derive

WrongStep: TypeAlias = Callable[[States, list[int]], list[int]]
MOST_MODULES = 5_000
"""Longer words are not followed."""
MOST_WITH_NEIGHBOURS = 80
"""Nor are words as long as this where each module is looked at in a word of its own."""


def words_by(step: WrongStep, system: LSystem, steps: int) -> Iterator[list[Module]]:
    """The words of steps 0 to `steps`, as somebody derives them who takes wrong steps.

    >>> from lsys_kit.notation.read import read
    >>> fibonacci = read("axiom: a\\na -> ab\\nb -> a")
    >>> ["".join(module.symbol for module in word) for word in words_by(sequential, fibonacci, 3)]
    ['a', 'aa', 'aaaa', 'aaaaaaaa']
    >>> ["".join(module.symbol for module in word) for word in words_by(leftmost_only, fibonacci, 3)]
    ['a', 'ab', 'abb', 'abbb']
    """
    states = States(system)
    word = list(states.axiom)
    yield [states.modules[state] for state in word]
    for _ in range(steps):
        word = step(states, word)
        if len(word) > MOST_MODULES:
            return
        yield [states.modules[state] for state in word]


def sequential(states: States, word: list[int]) -> list[int]:
    """Each production is applied everywhere, one after another, the second to what the first has made."""
    return _each_by(lambda state: _one_after_another(states, state), word)


def _each_by(successor: Callable[[int], Sequence[int]], word: list[int]) -> list[int]:
    """A word with each module replaced, by what is found once for all that are alike."""
    made = {state: successor(state) for state in dict.fromkeys(word)}
    return [after for state in word for after in made[state]]


def _one_after_another(states: States, state: int) -> list[int]:
    """What one production after another makes of a module."""
    word = [state]
    for number in range(len(states.system.productions)):
        word = [after for each in word for after in (states.successor(each) if states.production(each) == number else (each,))]
        if len(word) > MOST_MODULES:
            break
    return word


def one_production(states: States, word: list[int]) -> list[int]:
    """Each step applies the first production that applies anywhere, and no other."""
    first = min((n for n in map(states.production, dict.fromkeys(word)) if n is not None), default=None)
    return _each_by(lambda state: states.successor(state) if states.production(state) == first is not None else (state,), word)


def leftmost_only(states: States, word: list[int]) -> list[int]:
    """Each step rewrites one module, the first that has a production, as a Chomsky grammar may."""
    at = next((i for i, state in enumerate(word) if states.production(state) is not None), len(word))
    return [*word[:at], *(after for state in word[at : at + 1] for after in states.successor(state)), *word[at + 1 :]]


def rightmost_only(states: States, word: list[int]) -> list[int]:
    """Each step rewrites one module, the last that has a production."""
    at = next((i for i in reversed(range(len(word))) if states.production(word[i]) is not None), len(word))
    return [*word[:at], *(after for state in word[at : at + 1] for after in states.successor(state)), *word[at + 1 :]]


def branches_kept(states: States, word: list[int]) -> list[int]:
    """What stands in brackets is not rewritten."""
    found: list[int] = []
    depth = 0
    for state in word:
        symbol = states.modules[state].symbol
        depth += symbol in OPENING
        found += (state,) if depth else states.successor(state)
        depth -= symbol in CLOSING
    return found


def vanishing(states: States, word: list[int]) -> list[int]:
    """A letter without a production vanishes."""

    def successor(state: int) -> Sequence[int]:
        vanishes = states.production(state) is None and states.modules[state].symbol[:1].isalpha()
        return () if vanishes else states.successor(state)

    return _each_by(successor, word)


def all_that_match(states: States, word: list[int]) -> list[int]:
    """Every production that matches a module makes its successor, one beside the other."""
    found: list[int] = []
    for state in word:
        module = states.modules[state]
        rules = [rule for rule in states.candidates(state) if states.matches(rule, module.arguments, module)]
        found += [made for rule in rules for made in states.applied_states(rule, module)] if rules else [state]
    return found


def old_word_kept(states: States, word: list[int]) -> list[int]:
    """What has been made is written behind what was there."""
    return [*word, *_each_by(lambda state: () if states.production(state) is None else states.successor(state), word)]


def context_in_new_word(system: LSystem, steps: int) -> Iterator[list[Module]]:
    """The words where neighbours on the left are those that the same step has made already.

    >>> from lsys_kit.notation.read import read
    >>> signal = read("axiom: b a a a\\nb < a -> b")
    >>> ["".join(module.symbol for module in word) for word in context_in_new_word(signal, 1)]
    ['baaa', 'bbbb']
    """
    word = list(derive(system, 0)[0])
    yield word
    for _ in range(steps):
        made: list[Module] = []
        read: list[Module] = []
        for at in range(len(word) if len(word) < MOST_WITH_NEIGHBOURS else 0):
            if read != [*made, *word[at:]]:  # the last module has changed
                read = [*made, *word[at:]]
                after = derive(beginning_with(system, read), 1)
                becoming = [*zip(after[1], after.origins(1).parents, strict=True)]
            made = [*made, *(module for module, parent in becoming if parent == len(made))]
        if not made:
            return
        word = made
        yield word
