"""Two systems compared: by their axioms, by what becomes of modules, and by their words, up to renaming."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import islice

from lsys_kit.budget import counted
from lsys_kit.classroom.exercises.asked import beginning_with, with_constants
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.renaming import Renaming
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.petri.net import all_outcomes, outcomes_of
from lsys_kit.errors import LSystemError, ModelLimitError
from lsys_kit.notation.analysis.lint import warnings
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Apply, Number
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem, Production, symbols
from lsys_kit.notation.read import read, read_word
from lsys_kit.translation import gettext
from lsys_kit.worlds.derive import derive

MOST_MODULES = 300
"""Of so many different modules it is compared what becomes of them."""


@dataclass(frozen=True)
class SystemAnswer:
    """A system as somebody answers it.

    Attributes
    ----------
    front, behind
        The whole system: with its productions in front of those that the question gives, and behind them.
    own
        The part that was typed, with the axiom that it has or is given; its productions know where they stand in its source.
    """

    front: LSystem
    behind: LSystem
    own: LSystem


def completed(exercise: Exercise, own: LSystem) -> SystemAnswer:
    """A part of a system with what the question gives."""
    if not exercise.given:
        return SystemAnswer(own, own, own)
    given = read(exercise.given)
    rest = tuple(rule for rule in given.productions if rule not in own.productions)
    return SystemAnswer(replace(own, productions=own.productions + rest), replace(own, productions=rest + own.productions), own)


@dataclass(frozen=True)
class Parting:
    """Where two systems part: at the axiom (step 0), at a step, or in what becomes of a module alone."""

    step: int = 0
    position: int = 0
    module: Module | None = None
    setting: str = ""


def renaming(exercise: Exercise, wanted: LSystem) -> Renaming:
    return Renaming(frozenset(symbols(wanted)), "fixed" if exercise.drawn else exercise.names)


def parting(exercise: Exercise, mine: LSystem, wanted: LSystem) -> Parting | None:
    """Where two systems first part, or None where they are the same up to renaming."""
    for setting in ({}, *exercise.settings):
        named = ", ".join(f"{name} = {value}" for name, value in setting.items())
        found = _parting(exercise, with_constants(mine, setting), with_constants(wanted, setting))
        if found is not None:
            return replace(found, setting=", ".join(filter(None, (named, found.setting))))
    return None


def _parting(exercise: Exercise, mine: LSystem, wanted: LSystem) -> Parting | None:
    names = renaming(exercise, wanted)
    certain = not States(wanted).traits.stochastic and not States(mine).traits.stochastic
    found = _words_parting(mine, wanted, names, exercise.steps if certain else 0)
    if found is not None and found.step == 0:
        return found
    wrong = next(wrongly_replaced(exercise, mine, wanted, names), None)
    if wrong is not None:
        return Parting(found.step if found else 0, module=wrong)
    if found is not None:
        return found
    for probe in exercise.probes:
        word = read_word(probe, "abop", wanted)
        own_word = [names.own(module) for module in word]
        found = _words_parting(beginning_with(mine, own_word), beginning_with(wanted, word), names, min(exercise.steps, 5))
        if found is not None:
            return Parting(found.step, found.position, setting=gettext("the axiom {word}", word=probe))
    return None


def _words_parting(mine: LSystem, wanted: LSystem, names: Renaming, steps: int) -> Parting | None:
    own, other = derive(mine, steps), derive(wanted, steps)
    for step, (a, b) in enumerate(zip(own, other, strict=True)):
        at = names.first_difference(a, b)
        if at is not None:
            return Parting(step, at)
    return None


def asked_modules(exercise: Exercise, wanted: LSystem) -> list[Module]:
    """The modules that a question is about: those of the words of the solution, up to a limit."""
    states = States(wanted)
    if states.traits.stochastic and states.traits.s0l:
        all_outcomes(states, MOST_MODULES)
        return states.modules[:MOST_MODULES]
    words = derive(wanted, exercise.steps if states.traits.d0l else 0)
    return list(islice(dict.fromkeys(module for word in words for module in counted(word)), MOST_MODULES))


def wrongly_replaced(exercise: Exercise, mine: LSystem, wanted: LSystem, names: Renaming) -> Iterator[Module]:
    """The modules of the question, as the answer calls them, of which something else becomes."""
    own, other = States(mine), States(wanted)
    simple = all(states.traits.d0l or states.traits.s0l for states in (own, other))
    for module in asked_modules(exercise, wanted) if simple else ():
        called = names.own(module)
        if _fates(own, called, names) != _fates(other, module, None):
            yield called


def _fates(states: States, module: Module, names: Renaming | None) -> Counter[tuple[object, ...]]:
    """What may become of a module, and how likely, in the symbols of the solution."""
    state = states.number(module.symbol, module.arguments)
    found: Counter[tuple[object, ...]] = Counter()
    outcomes = [(outcome.successor, outcome.chance) for outcome in outcomes_of(states, state)] or [((state,), 1)]
    for successor, chance in outcomes:
        word = [states.modules[number] for number in successor]
        found[tuple(map(names.wanted, word)) if names else tuple(word)] += chance  # type: ignore[assignment]
    return found


def unused(own: LSystem) -> Production | None:
    """A production before which another always applies."""
    return next(
        (
            rule
            for problem in warnings(own)
            if problem.code.startswith("production never applied")
            for rule in [problem.subject["rule"]]
            if isinstance(rule, Production)
        ),
        None,
    )


def _same_settings(exercise: Exercise, mine: LSystem, wanted: LSystem) -> bool:
    return not exercise.drawn or mine.angle == wanted.angle


def same(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> bool:
    return (
        _same_settings(exercise, mine.front, wanted.front)
        and unused(mine.own) == unused(wanted.own)
        and parting(exercise, mine.front, wanted.behind) is None
        and (mine.front is mine.behind or parting(exercise, mine.behind, wanted.behind) is None)
    )


def tests_passed(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> tuple[int, int]:
    """How many tests a wrong answer passes, and how many there are; none where chance has a say.

    A test is a step, with each setting of the constants, whose word is not right without what was typed; it is passed if the
    words up to it are right. One more test is all else: other axioms, the angle, that no production is unused.
    """
    if any(States(each).traits.stochastic for each in (mine.behind, wanted.behind)):
        return 0, 0
    untyped = replace(
        wanted.behind, productions=tuple(rule for rule in wanted.behind.productions if rule not in wanted.own.productions)
    )
    passed = asked = 0
    for setting in ({}, *exercise.settings):
        given = _agreeing_steps(exercise, untyped, wanted.behind, setting)
        own = min(_agreeing_steps(exercise, each, wanted.behind, setting) for each in (mine.front, mine.behind))
        passed, asked = passed + max(own - given, 0), asked + exercise.steps - given
    return passed, asked + 1


def _agreeing_steps(exercise: Exercise, mine: LSystem, wanted: LSystem, setting: Mapping[str, Value]) -> int:
    """Up to which step words are the same."""
    try:
        names, each = renaming(exercise, wanted), [with_constants(system, setting) for system in (mine, wanted)]
        found = _words_parting(each[0], each[1], names, exercise.steps)
    except LSystemError:
        return 0
    return exercise.steps if found is None else max(found.step - 1, 0)


def alike(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> bool:
    """Whether an answer is that which a misconception leads to: also for modules that the question does not reach."""
    exercise = replace(exercise, probes=(), settings=())
    if (mine.own.angle, mine.own.heading) != (wanted.own.angle, wanted.own.heading) or unused(mine.own) != unused(wanted.own):
        return False
    if len(_replaced(mine.own)) != len(_replaced(wanted.own)) or not _for_the_same(exercise, mine, wanted):
        return False
    try:
        return all(
            parting(exercise, one, other) is None for one, other in ((mine.behind, wanted.behind), (mine.front, wanted.front))
        ) and _alone(exercise, mine, wanted)
    except ModelLimitError:
        return False


def _replaced(system: LSystem) -> set[tuple[str, ...]]:
    """The symbols for which a system has productions."""
    return {tuple(module.symbol for module in rule.predecessors) for rule in system.productions}


def _for_the_same(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> bool:
    """Whether what was typed has productions for the same symbols, as far as these are those of the question."""
    known = set(symbols(wanted.front)) if exercise.names != "any" else set()
    own, other = ({symbol for each in _replaced(system) for symbol in each} for system in (mine.own, wanted.own))
    return own & known == other & known or not own <= known


def _alone(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> bool:
    """Whether what was typed does the same without what is given, to modules with neighbouring values too."""
    own, other = States(mine.own), States(wanted.own)
    if not (own.traits.d0l and other.traits.d0l):
        return True
    names = renaming(exercise, wanted.front)
    names.first_difference(derive(mine.behind, 0)[0], derive(wanted.behind, 0)[0])
    modules = asked_modules(exercise, wanted.behind)
    nearby = [
        replace(module, arguments=tuple(a + by for a in module.arguments))
        for module in modules
        for by in (-2, -1, 1, 2)
        if module.arguments
    ]
    bounds = {number + by for number in _numbers_compared(mine.own, wanted.own) for by in (-1, 0, 1)}
    at_bounds = [replace(module, arguments=(bound,)) for module in modules if len(module.arguments) == 1 for bound in bounds]
    return all(
        _fates(own, names.own(module), names) == _fates(other, module, None)
        for module in list(dict.fromkeys([*at_bounds, *modules, *nearby]))[:MOST_MODULES]
    )


def _numbers_compared(*systems: LSystem) -> set[Value]:
    """The numbers in the conditions of systems, at which they may differ."""
    found: set[Value] = set()
    waiting = [rule.condition for system in systems for rule in system.productions if rule.condition is not None]
    while waiting:
        part = waiting.pop()
        found |= {part.value} if isinstance(part, Number) else set()
        waiting += part.operands if isinstance(part, Apply) else ()
    return found
