"""Misconceptions about steps and growth: words derived as no L-system derives them, numbers continued by another rule."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import count, islice, pairwise, permutations
from typing import TypeAlias

from lsys_kit.classroom.exercises.asked import (
    Derived,
    History,
    answer_by,
    asked_steps,
    asked_system,
    beginning_with,
    bound_of,
    first_past,
    is_derived,
    last_step,
    right_history,
    what_is_asked,
)
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.table import solution_of
from lsys_kit.classroom.exercises.misconceptions.misconception import by_history, misconception
from lsys_kit.derivation.core.states import States
from lsys_kit.notation.model.modules import CLOSING, OPENING, Module
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.worlds.derive import derive

WrongStep: TypeAlias = Callable[[States, list[int]], list[int]]
"""From a row of states to the next."""
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


def by_words(words: Callable[[LSystem, int], Iterable[Sequence[Module]]], trait: str, exercise: Exercise) -> Iterator[object]:
    """The answers of somebody who derives other words, of systems that have a trait."""
    system = asked_system(exercise) if is_derived(exercise) else None
    if system is not None and getattr(States(system).traits, trait):
        found = list(words(system, last_step(exercise)))
        if len(found) > last_step(exercise):
            yield from by_history(exercise, History(system, found))


def by_steps(step: WrongStep, exercise: Exercise) -> Iterator[object]:
    """The answers of somebody whose steps are not those of an L-system."""
    return by_words(partial(words_by, step), "d0l", exercise)


MOST_ORDERED = 3
"""Of so many productions all orders are tried, of more that in which they are written and the reverse."""


@misconception("sequential")
def sequential_in_each_order(exercise: Exercise) -> Iterator[object]:
    """Each production is applied everywhere, one after another, the second to what the first has made.

    In the order in which they are written, or in another; one that happens to lead to the right answer shows nothing.
    """
    if not is_derived(exercise):
        return
    yield from by_steps(sequential, exercise)
    number, right = len(asked_system(exercise).productions), answer_by(exercise, right_history(exercise))
    rules = range(number)
    for order in permutations(rules) if number <= MOST_ORDERED else (rules[::-1],):
        yield from (answer for answer in by_steps(partial(sequential, order=order), exercise) if answer != right)


def sequential(states: States, word: list[int], order: Sequence[int] | None = None) -> list[int]:
    """A step in which the productions are applied one after another, in an order of their numbers.

    >>> from lsys_kit.notation.read import read
    >>> states = States(read("axiom: a\\na -> ab\\nb -> a"))
    >>> a, b = (states.number(symbol, ()) for symbol in "ab")
    >>> sequential(states, [a, b]) == [a, a, a], sequential(states, [a, b], (1, 0)) == [a, b, a, b]
    (True, True)
    """
    rules = range(len(states.system.productions)) if order is None else order
    return _each_by(lambda state: _one_after_another(states, state, rules), word)


def _each_by(successor: Callable[[int], Sequence[int]], word: list[int]) -> list[int]:
    """A word with each module replaced, by what is found once for all that are alike."""
    made = {state: successor(state) for state in dict.fromkeys(word)}
    return [after for state in word for after in made[state]]


def _one_after_another(states: States, state: int, order: Sequence[int]) -> list[int]:
    word = [state]
    for number in order:
        word = [after for each in word for after in (states.successor(each) if states.production(each) == number else (each,))]
        if len(word) > MOST_MODULES:
            break
    return word


@misconception("one production a step", by_steps)
def one_production(states: States, word: list[int]) -> list[int]:
    """Each step applies the first production that applies anywhere, and no other."""
    first = min((n for n in map(states.production, dict.fromkeys(word)) if n is not None), default=None)
    return _each_by(lambda state: states.successor(state) if states.production(state) == first is not None else (state,), word)


@misconception("leftmost only", by_steps)
def leftmost_only(states: States, word: list[int]) -> list[int]:
    """Each step rewrites one module, the first that has a production, as a Chomsky grammar may."""
    return _one_rewritten(states, word, range(len(word)))


@misconception("leftmost only", by_steps)
def rightmost_only(states: States, word: list[int]) -> list[int]:
    """Each step rewrites one module, the last that has a production."""
    return _one_rewritten(states, word, reversed(range(len(word))))


def _one_rewritten(states: States, word: list[int], order: Iterable[int]) -> list[int]:
    at = next((at for at in order if states.production(word[at]) is not None), None)
    return word if at is None else [*word[:at], *states.successor(word[at]), *word[at + 1 :]]


@misconception("old word kept", by_steps)
def old_word_kept(states: States, word: list[int]) -> list[int]:
    return [*word, *_each_by(lambda state: () if states.production(state) is None else states.successor(state), word)]


@misconception("branches kept", by_steps)
def branches_kept(states: States, word: list[int]) -> list[int]:
    found: list[int] = []
    depth = 0
    for state in word:
        symbol = states.modules[state].symbol
        depth += symbol in OPENING
        found += (state,) if depth else states.successor(state)
        depth -= symbol in CLOSING
    return found


@misconception("letters vanish", by_steps)
def vanishing(states: States, word: list[int]) -> list[int]:
    def successor(state: int) -> Sequence[int]:
        vanishes = states.production(state) is None and states.modules[state].symbol[:1].isalpha()
        return () if vanishes else states.successor(state)

    return _each_by(successor, word)


@misconception("all matches applied", by_steps)
def all_that_match(states: States, word: list[int]) -> list[int]:
    found: list[int] = []
    for state in word:
        module = states.modules[state]
        rules = [rule for rule in states.candidates(state) if states.matches(rule, module.arguments, module)]
        found += [made for rule in rules for made in states.applied_states(rule, module)] if rules else [state]
    return found


@misconception("context in the new word", by_words, "context")
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


# Which step


def _shifted(offset: int, exercise: Exercise) -> Iterator[object]:
    """The answers of somebody who counts the steps from another one."""
    if is_derived(exercise) and what_is_asked(exercise) != "first":
        yield from by_history(exercise, replace(right_history(exercise), offset=offset))


def _beside_the_first(by: int, exercise: Exercise) -> Iterator[object]:
    """The answers of somebody who names the step before the first that is asked for, or the one after it."""
    if what_is_asked(exercise) == "first":
        yield solution_of(exercise) + by


misconception("one step too few")(partial(_shifted, -1))
misconception("one step too many")(partial(_shifted, 1))
misconception("last step before")(partial(_beside_the_first, -1))
misconception("axiom as step 1")(partial(_beside_the_first, 1))

# How it grows

MOST_GIVEN = 6
"""So many first numbers at most are taken as they are before they are continued."""
MOST_STEPS_CONTINUED = 100_000
"""So far a sequence is followed until it passes a bound."""
MOST_VALUES = 8
"""So many first numbers a sequence is continued from."""
_COUNTED = ("length", "count", "strokes")


def by_sequences(continued: Callable[[Sequence[int]], Iterator[Iterator[int]]], exercise: Exercise) -> Iterator[object]:
    """The answers of somebody who continues the first numbers by another rule."""
    what = what_is_asked(exercise)
    if what not in (*_COUNTED, "lengths", "counts", "first") or exercise.symbols:
        return
    last = last_step(exercise)
    for values in continued(right_history(exercise).values(exercise, min(last, MOST_VALUES))):
        if what == "first":
            yield first_past(islice(values, MOST_STEPS_CONTINUED), bound_of(exercise))
            continue
        found = list(islice(values, last + 1))
        if len(found) > last:
            yield found[last] if exercise.kind == "number" else tuple(found[step] for step in asked_steps(exercise))


def _continued(given: Sequence[int], of_last: int, of_before: int) -> Iterator[int]:
    """Numbers, and behind them without end so many times the last one and so many times the one before."""
    yield from given
    before, last = given[-2:]
    while True:
        before, last = last, of_last * last + of_before * before
        yield last


@misconception("linear growth", by_sequences)
def linear(values: Sequence[int]) -> Iterator[Iterator[int]]:
    """The same is added at each step.

    >>> [list(islice(found, 4)) for found in linear([1, 5, 25, 125])]
    [[1, 5, 9, 13], [1, 5, 25, 45]]
    """
    for given in range(2, min(MOST_GIVEN, len(values))):
        if values[given - 1] != values[given - 2]:
            yield _continued(values[:given], 2, -1)


@misconception("adding for multiplying", by_sequences)
def added_for_multiplied(values: Sequence[int]) -> Iterator[Iterator[int]]:
    """As much for each step as the first one has, added up; where each step multiplies by the same number.

    >>> [list(islice(found, 4)) for numbers in ([1, 5, 25], [1, 2, 3]) for found in added_for_multiplied(numbers)]
    [[1, 5, 10, 15]]
    """
    is_product = all(b * values[0] == a * values[1] for a, b in pairwise(values))
    if len(values) > 1 and is_product and values[1] > values[0] > 0 and values[1] % values[0] == 0:
        yield (values[1] * step if step else values[0] for step in count())


@misconception("Fibonacci by reflex", by_sequences)
def fibonacci(values: Sequence[int]) -> Iterator[Iterator[int]]:
    """Each number the sum of the two before.

    >>> [list(islice(found, 6)) for found in fibonacci([1, 1, 1, 2, 2])][0]
    [1, 1, 2, 3, 5, 8]
    """
    for given in range(2, min(MOST_GIVEN, len(values)) + 1):
        yield _continued(values[:given], 1, 1)


@misconception("doubling by reflex", by_sequences)
def doubling(values: Sequence[int]) -> Iterator[Iterator[int]]:
    """Twice as many at each step.

    >>> [list(islice(found, 4)) for found in doubling([1, 2, 3])]
    [[1, 2, 4, 8]]
    """
    if values and values[0] > 0:
        yield (values[0] * 2**step for step in range(4_000))


def by_values(change: Callable[[Sequence[int]], Iterable[int]], exercise: Exercise) -> Iterator[object]:
    """The answers of somebody who makes something else of the right numbers of all steps."""
    if exercise.kind == "number" and what_is_asked(exercise) in _COUNTED and exercise.steps > 1:
        yield from change(right_history(exercise).values(exercise, exercise.steps))


@misconception("last step only", by_values)
def last_made(values: Sequence[int]) -> list[int]:
    """What the last step has added.

    >>> last_made([1, 3, 7]), last_made([3, 1])
    ([4], [])
    """
    return [values[-1] - values[-2]] if values[-1] > values[-2] > 0 else []


@misconception("steps added up", by_values)
def added_up(values: Sequence[int]) -> list[int]:
    """The numbers of all steps together, with that of step 0 or without.

    >>> added_up([1, 3, 7])
    [11, 10]
    """
    return [sum(values), sum(values[1:])]


@misconception("old word kept")
def kept_in_the_last_step(exercise: Exercise) -> Iterator[int]:
    """The old word beside the new one in the last step alone, with what stays counted once or twice."""
    if _is_counted(exercise):
        before, last = right_history(exercise).values(exercise, exercise.steps)[-2:]
        yield before + last
        if exercise.asks == "length":  # of strokes and of one symbol those that stay are not known so
            yield from (before + last - staying for staying in [_counted_in(exercise, None)] if 0 < staying < before)


@misconception("symbols miscounted")
def miscounted(exercise: Exercise) -> Iterator[int]:
    """One symbol too few or too many in what a module becomes: in the last step alone, or in all."""
    if not _is_counted(exercise):
        return
    system, right = asked_system(exercise), right_history(exercise).values(exercise, exercise.steps)[-1]
    for rule in system.productions:
        if len(rule.successor) > 1:
            many = _counted_in(exercise, rule)
            yield from (right + by for by in (-many, many) if many)
            for changed in _one_more_or_fewer(system, rule):
                found = History(changed, Derived(changed, exercise.steps)).values(exercise, exercise.steps)[-1]
                if found != right:
                    yield found


def _is_counted(exercise: Exercise) -> bool:
    """Whether something is counted that growth tells: no chance, no neighbours."""
    counted = exercise.kind == "number" and what_is_asked(exercise) in _COUNTED and exercise.steps > 0
    return counted and States(asked_system(exercise)).traits.d0l


def _counted_in(exercise: Exercise, rule: Production | None) -> int:
    """How many modules of the word before the last step a production replaces; without one, how many stay. 0 if it is long."""
    history = right_history(exercise)
    if history.values(exercise, exercise.steps)[-2] > MOST_MODULES:
        return 0
    states, rules = States(history.system), history.system.productions
    used = (states.production(states.number(each.symbol, each.arguments)) for each in history.word(exercise.steps - 1))
    return sum((None if number is None else rules[number]) == rule for number in used)


def _one_more_or_fewer(system: LSystem, rule: Production) -> Iterator[LSystem]:
    """A system with a letter of a production left out, and with it written twice, for each of its letters."""
    made = rule.successor
    for at in {str(part): at for at, part in enumerate(made) if str(part)[:1].isalpha()}.values():
        for successor in ((*made[:at], *made[at + 1 :]), (*made[: at + 1], *made[at:])):
            rules = tuple(replace(each, successor=successor) if each is rule else each for each in system.productions)
            yield replace(system, productions=rules)


@misconception("rows and columns")
def transposed(exercise: Exercise) -> Iterator[tuple[object, ...]]:
    if what_is_asked(exercise) == "matrix":
        values = solution_of(exercise)
        size = round(len(values) ** 0.5)
        yield tuple(values[row * size + column] for column in range(size) for row in range(size))
