"""From a misconception about systems, steps, growth, formulas or nets to the wrong answers that it yields to a question.

Each function here takes a misconception of one of these sorts and returns a function of exercises: the answers that somebody
with this misconception gives, in the form in which an answer to the exercise is read; none where it does not apply.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import islice
from typing import Any, TypeAlias

from lsys_kit.classroom.exercises.asked import (
    Derived,
    History,
    answer_by,
    asked_steps,
    asked_system,
    bound_of,
    first_past,
    last_step,
    right_history,
    what_is_asked,
)
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.drawings import Drawn
from lsys_kit.classroom.exercises.kinds.nets import Firing, Net
from lsys_kit.classroom.exercises.kinds.systems import completed
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS, solution_of
from lsys_kit.classroom.exercises.misconceptions.rewriting import WrongStep, words_by
from lsys_kit.classroom.exercises.misconceptions.systems import is_sensible
from lsys_kit.derivation.core.states import States
from lsys_kit.notation.model.modules import CLOSING, OPENING, Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.worlds.derive import derive

WrongAnswers: TypeAlias = Callable[[Exercise], Iterator[Any]]
MOST_STEPS_CONTINUED = 100_000
"""So far a sequence is followed until it passes a bound."""
MOST_VALUES = 8
"""So many first numbers a sequence is continued from."""
_OF_GROWTH = ("length", "count", "strokes", "lengths", "counts", "first")


def by_systems(change_system: Callable[[LSystem], Iterator[LSystem]], typed: bool = True) -> WrongAnswers:
    """The answers of somebody who has another system in mind, or, where that is `typed`, writes it."""

    def change(system: LSystem) -> Iterator[LSystem]:
        return filter(is_sensible, change_system(system))

    def answers(exercise: Exercise) -> Iterator[Any]:
        if exercise.kind == "system" and not typed:
            return
        if exercise.kind == "system":
            yield from (completed(exercise, wrong) for wrong in change(solution_of(exercise).own))
        elif exercise.kind == "drawing":
            right = solution_of(exercise).derivation
            drawings = (Drawn(derive(wrong, right.steps)) for wrong in change(right.states.system))
            yield from (drawing for drawing in drawings if len(drawing.strokes))
        elif what_is_asked(exercise):
            for wrong in change(asked_system(exercise)):
                yield from _by_history(exercise, History(wrong, Derived(wrong, last_step(exercise))))

    return answers


def by_steps(step: WrongStep) -> WrongAnswers:
    """The answers of somebody whose steps are not those of an L-system."""

    def answers(exercise: Exercise) -> Iterator[Any]:
        system = asked_system(exercise) if what_is_asked(exercise) else None
        if system is not None and States(system).traits.d0l:
            yield from _by_words(exercise, system, words_by(step, system, last_step(exercise)))

    return answers


def by_contexts(words: Callable[[LSystem, int], Iterator[Sequence[Module]]]) -> WrongAnswers:
    """The answers of somebody who reads neighbours in another word."""

    def answers(exercise: Exercise) -> Iterator[Any]:
        system = asked_system(exercise) if what_is_asked(exercise) else None
        if system is not None and States(system).traits.context:
            yield from _by_words(exercise, system, words(system, last_step(exercise)))

    return answers


def _by_words(exercise: Exercise, system: LSystem, words: Iterable[Sequence[Module]]) -> Iterator[Any]:
    found = list(words)
    if len(found) > last_step(exercise):
        yield from _by_history(exercise, History(system, found))


def _by_history(exercise: Exercise, history: History) -> Iterator[Any]:
    answer = answer_by(exercise, history)
    if answer is not None:
        yield ANSWER_KINDS[exercise.kind].read(exercise, answer) if exercise.kind in ("net", "drawing") else answer


def shifted(offset: int) -> WrongAnswers:
    """The answers of somebody who counts the steps from another one."""

    def answers(exercise: Exercise) -> Iterator[Any]:
        asked = what_is_asked(exercise)
        if asked not in ("", "first") and not (asked == "drawing" and exercise.steps < 2):
            yield from _by_history(exercise, replace(right_history(exercise), offset=offset))

    return answers


def beside_the_first(by: int) -> WrongAnswers:
    """The answers of somebody who names the step before the first that is asked for, or the one after it."""

    def answers(exercise: Exercise) -> Iterator[Any]:
        if what_is_asked(exercise) == "first":
            yield solution_of(exercise) + by

    return answers


def by_sequences(continued: Callable[[Sequence[int]], Iterator[Iterator[int]]]) -> WrongAnswers:
    """The answers of somebody who continues the first numbers by another rule."""

    def answers(exercise: Exercise) -> Iterator[Any]:
        what = what_is_asked(exercise)
        if what not in _OF_GROWTH or exercise.symbols:
            return
        last = last_step(exercise)
        for values in continued(right_history(exercise).values(exercise, min(last, MOST_VALUES))):
            if what == "first":
                yield first_past(islice(values, MOST_STEPS_CONTINUED), bound_of(exercise))
                continue
            found = list(islice(values, last + 1))
            if len(found) > last:
                yield found[last] if exercise.kind == "number" else tuple(found[step] for step in asked_steps(exercise))

    return answers


def by_values(change: Callable[[Sequence[int]], Iterator[int]]) -> WrongAnswers:
    """The answers of somebody who makes something else of the right numbers of all steps."""

    def answers(exercise: Exercise) -> Iterator[Any]:
        if exercise.kind == "number" and what_is_asked(exercise) in ("length", "count", "strokes") and exercise.steps > 1:
            yield from change(right_history(exercise).values(exercise, exercise.steps))

    return answers


def by_turns(change_system: Callable[[LSystem], Iterator[LSystem]]) -> WrongAnswers:
    """The answers of somebody who has another angle in mind, in questions that do not give it."""
    of_systems = by_systems(change_system)

    def answers(exercise: Exercise) -> Iterator[Any]:
        if exercise.kind != "drawing" or not exercise.system:
            yield from of_systems(exercise)

    return answers


def by_solutions(kind: str, change: Callable[[Any], Iterator[Any]]) -> WrongAnswers:
    """The answers that are the right one changed, in questions of one kind."""

    def answers(exercise: Exercise) -> Iterator[Any]:
        if exercise.kind == kind:
            yield from change(solution_of(exercise))

    return answers


def by_angles(change: Callable[[Any], Iterator[Any]]) -> WrongAnswers:
    """The same for numbers that are angles."""

    def answers(exercise: Exercise) -> Iterator[Any]:
        if exercise.kind == "number" and exercise.unit in ("degrees", "radians", "°"):
            yield from change(solution_of(exercise))

    return answers


def together(*several: WrongAnswers) -> WrongAnswers:
    """The answers of all."""

    def answers(exercise: Exercise) -> Iterator[Any]:
        for each in several:
            yield from each(exercise)

    return answers


def transposed(exercise: Exercise) -> Iterator[tuple[object, ...]]:
    """A square matrix with its rows for columns."""
    if what_is_asked(exercise) == "matrix":
        values = solution_of(exercise)
        size = round(len(values) ** 0.5)
        yield tuple(values[row * size + column] for column in range(size) for row in range(size))


def backwards(solution: Sequence[Any]) -> Iterator[tuple[Any, ...]]:
    """A row from its end to its beginning; none of a word with brackets, which read backwards close nothing."""
    if not any(isinstance(each, Module) and each.symbol in OPENING | CLOSING for each in solution):
        yield tuple(reversed(solution))


def never(_: Exercise) -> Iterator[Any]:
    """No answer is computed: the exercise says which one it is, by a slip or an option."""
    return iter(())


# Nets


def arcs_reversed(net: Net) -> Iterator[Net]:
    """Every arrow the other way round."""
    yield Net(
        tuple(Firing(place, ((firing.place, copies),)) for firing in net.firings for place, copies in firing.made), net.start
    )


def copies_not_counted(net: Net) -> Iterator[Net]:
    """One token wherever there are several."""
    yield Net(tuple(replace(f, made=tuple((place, 1) for place, _ in f.made)) for f in net.firings), net.start)


def one_daughter(net: Net) -> Iterator[Net]:
    """A token that moves to one place only, where it should be copied into several."""
    for at in (0, -1):
        yield Net(tuple(replace(f, made=f.made[at:][:1]) for f in net.firings), net.start)


def last_stage_skipped(net: Net) -> Iterator[Net]:
    """A net that lacks one of the places that tokens only pass through."""
    for passed in net.firings:
        if sum(copies for _, copies in passed.made) == 1 and passed.made[0][0] != passed.place:
            target = passed.made[0][0]
            yield Net(tuple(_led_to(f, passed.place, target) for f in net.firings if f is not passed), net.start)


def _led_to(firing: Firing, place: str, target: str) -> Firing:
    """A transition whose arcs into one place lead to another."""
    copies: Counter[str] = Counter()
    for each, count in firing.made:
        copies[target if each == place else each] += count
    return replace(firing, made=tuple(sorted(copies.items())))
