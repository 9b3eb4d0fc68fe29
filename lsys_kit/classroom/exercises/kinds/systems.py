"""Systems as answers: right where their language is, whatever their symbols and parameters are called.

An answer is compared by its axiom, by what becomes of every module that the question is about, and by the words of all steps,
from the axiom and from other axioms. Where the question gives a part, the answer is tried in front of that part and behind it:
a production must itself say to which modules it applies.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import islice, zip_longest

from lsys_kit.budget import counted
from lsys_kit.classroom.exercises.asked import beginning_with, with_constants
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.typed import read_typed, text_answer
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.petri.net import all_outcomes, outcomes_of
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError
from lsys_kit.notation.analysis.lint import warnings
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Apply, Number
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem, Production, symbols
from lsys_kit.notation.read import read, read_word
from lsys_kit.worlds.derive import derive

# Words that are the same but for the names of their symbols


class Renaming:
    """Which symbol of an answer stands for which of the solution, found as words are compared.

    Parameters
    ----------
    known
        The symbols of the solution.
    names
        "new": a symbol of the solution means itself, and a new one may stand for any; "any": any symbol may stand for any;
        "fixed": every symbol means itself. What is no name, such as + or [, always means itself.

    Examples
    --------
    >>> words = [[Module("x"), Module("y")], [Module("a"), Module("b")]]
    >>> Renaming(frozenset("ab"), "new").first_difference(*words), Renaming(frozenset("ab"), "fixed").first_difference(*words)
    (None, 0)
    >>> Renaming(frozenset("ab"), "new").first_difference([Module("b"), Module("a")], words[1])
    0
    """

    def __init__(self, known: Iterable[str], names: str = "new") -> None:
        self.known, self.names = frozenset(known), names
        self._wanted: dict[str, str] = {}
        self._own: dict[str, str] = {}

    def first_difference(self, mine: Sequence[Module], wanted: Sequence[Module]) -> int | None:
        """The first position at which a word of the answer is not that of the solution, or None."""
        for at, (own, other) in enumerate(zip_longest(mine, wanted)):
            if (
                own is None
                or other is None
                or own.arguments != other.arguments
                or not self._may_stand(own.symbol, other.symbol)
            ):
                return at
        return None

    def _may_stand(self, own: str, wanted: str) -> bool:
        """Whether a symbol may stand for another; from now on it does."""
        if own in self._wanted or wanted in self._own:
            return self._wanted.get(own) == wanted
        means_itself = (
            self.names == "fixed"
            or (self.names == "new" and own in self.known)
            or not (own[:1].isalpha() and wanted[:1].isalpha())
        )
        if means_itself and own != wanted:
            return False
        self._wanted[own], self._own[wanted] = wanted, own
        return True

    def own(self, module: Module) -> Module:
        """A module of the solution as the answer calls it."""
        return replace(module, symbol=self._own.get(module.symbol, module.symbol))

    def wanted(self, module: Module) -> Module:
        """A module of the answer as the solution calls it."""
        return replace(module, symbol=self._wanted.get(module.symbol, module.symbol))


# Two systems compared


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
        return _whole(own)
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
            return Parting(found.step, found.position, setting=reply("system.axiom_is", word=probe))
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
    found = (each.subject["rule"] for each in warnings(own) if each.code.startswith("production never applied"))
    return next((rule for rule in found if isinstance(rule, Production)), None)


def same(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> bool:
    return (
        (not exercise.drawn or mine.front.angle == wanted.front.angle)
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
    found: set[Value] = set()
    waiting = [rule.condition for system in systems for rule in system.productions if rule.condition is not None]
    while waiting:
        part = waiting.pop()
        found |= {part.value} if isinstance(part, Number) else set()
        waiting += part.operands if isinstance(part, Apply) else ()
    return found


# As it was typed


_AXIOM_LINE = re.compile(r"^[ \t]*(axiom|omega|ω)[ \t]*:", re.IGNORECASE | re.MULTILINE)
"""An answer with an axiom of its own is the whole system."""
_ARROW = re.compile(r"->|→")
MOST_QUOTED = 200
"""How many characters of a production a reply quotes."""


def _read(exercise: Exercise, answer: object) -> SystemAnswer:
    if isinstance(answer, LSystem):
        return _whole(answer)
    text = text_answer(answer, reply("system.what"), '"axiom: a"')
    return read_typed(text, lambda typed: _read_text(exercise, typed), f"{exercise.given}\n{exercise.solution}")


def _read_text(exercise: Exercise, text: str) -> SystemAnswer:
    if not exercise.given or _AXIOM_LINE.search(text):
        return _whole(read(text))
    given = read(exercise.given)
    with suppress(LSystemError):  # in another notation
        whole = read(text)
        if not all(_ARROW.search(line) for line in text.splitlines() if line.strip()):
            return _whole(whole)
        if whole.notation != given.notation:  # a rule alone is read with its first letter as its axiom
            return completed(exercise, replace(given, productions=whole.productions, source=whole.source))
    together = read(f"{text}\n{exercise.given}")
    own = [rule for rule in together.productions if rule.at and rule.at[1] <= len(text) and rule not in given.productions]
    if not own:
        raise ModelValueError(reply("system.not_given"), hint=reply("system.form"))
    return completed(exercise, replace(together, productions=tuple(own)))


def _whole(system: LSystem) -> SystemAnswer:
    return SystemAnswer(system, system, system)


# What to say


def _difference(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> Difference:
    behind = parting(exercise, mine.behind, wanted.behind)
    front = parting(exercise, mine.front, wanted.behind) if mine.front is not mine.behind else behind
    likeness, near = _likeness(exercise, mine, wanted)
    if front is None and behind is None:
        return _difference_in_writing(mine)
    if behind is None and front is not None:
        said = reply("system.not_by_itself", module=_applied_too(front, mine.front))
        return Difference(said, likeness * 0.9, near)
    found = behind or front
    assert found is not None
    return Difference(_in_words(found, mine, mine.behind if behind else mine.front, wanted.behind), likeness, near)


def _difference_in_writing(mine: SystemAnswer) -> Difference:
    never = unused(mine.own)
    return Difference(reply("system.angle") if never is None else reply("system.never_used") + _typed(never, mine), 1, True)


def _applied_too(found: Parting, system: LSystem) -> str:
    """A module to which a production applies that should not, or the axiom."""
    module = found.module
    if module is None and found.step == 0:
        return reply("system.the_axiom")
    if module is None:
        derivation = derive(system, found.step)
        parents, before = derivation.origins(found.step).parents, derivation[found.step - 1]
        module = before[parents[found.position] if found.position < len(parents) else len(before) - 1]
    return reply("system.module", module=module)


def _in_words(found: Parting, mine: SystemAnswer, system: LSystem, wanted: LSystem) -> str:
    besides = " " + reply("system.with", setting=found.setting) if found.setting else ""
    so_far = reply("system.up_to_step", step=found.step - 1) + " " if found.step > 1 and not besides else ""
    if found.module is not None:
        cause = _decomposition_for(found.module, mine, system, wanted) or _production_for(found.module, mine, system)
        return f"{so_far}{reply('system.becomes', module=found.module, besides=besides)} {cause}".strip()
    if found.step == 0:
        return reply("system.axiom")
    if besides:
        return reply("system.another_start", step=found.step, position=found.position + 1, besides=besides)
    derivation = derive(system, found.step)
    origins = derivation.origins(found.step)
    if found.position >= len(origins.parents):
        return so_far + reply("system.ends", step=found.step, position=found.position)
    production = origins.productions[found.position]
    have, mother = derivation[found.step][found.position], derivation[found.step - 1][origins.parents[found.position]]
    where = {"step": found.step, "position": found.position + 1, "module": have, "mother": mother}
    if production is None:
        return so_far + reply("system.stays", **where)
    return so_far + reply("system.production", **where) + _typed(system.productions[production], mine)


def _decomposition_for(module: Module, mine: SystemAnswer, system: LSystem, wanted: LSystem) -> str:
    """What is said where the production for a module is right, and the decomposition of what it makes is not."""
    if not (wanted.decomposition or system.decomposition):
        return ""
    one, other = (derive(replace(beginning_with(each, [module]), decomposition=()), 1)[1] for each in (system, wanted))
    if tuple(one) != tuple(other):
        return ""
    if not system.decomposition:
        return reply("system.no_decomposition")
    if len(system.decomposition) > 1:
        return reply("system.decompositions")
    return reply("system.decomposition") + _typed(system.decomposition[0], mine)


def _production_for(module: Module, mine: SystemAnswer, system: LSystem) -> str:
    states = States(system)
    state = states.number(module.symbol, module.arguments)
    number = states.production(state) if states.is_d0l(state) else None
    if number is None:
        return reply("system.no_production") if states.is_d0l(state) else ""
    return reply("system.this_production") + _typed(system.productions[number], mine)


def _typed(rule: Production, mine: SystemAnswer) -> str:
    """A production as it was typed, as a quoted line; as the kit writes it, where it was not typed."""
    source = mine.own.source
    own = next((found for found in mine.own.rules if found == rule and found.at), None)
    text = source[own.at[0] : own.at[1]] if own and own.at and source and own.at[1] <= len(source) else str(rule)
    line = " ".join(text.split())
    return f"\n  {line if len(line) <= MOST_QUOTED else f'{line[:MOST_QUOTED]}...'}"


def _likeness(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> tuple[float, bool]:
    """How many of the modules that the solution's own productions rewrite become what they should; whether all but one."""
    names = renaming(exercise, wanted.behind)
    try:
        axiom = names.first_difference(derive(mine.behind, 0)[0], derive(wanted.behind, 0)[0]) is None
        own = {rule.predecessor.symbol for rule in wanted.own.productions}
        modules = [module for module in asked_modules(exercise, wanted.behind) if module.symbol in own]
        wrong = set(wrongly_replaced(exercise, mine.behind, wanted.behind, names))
    except LSystemError:
        return 0, False
    wrong_ones = [module.symbol for module in modules if names.own(module) in wrong]
    near = len({module.symbol for module in modules}) > 2 and len({*wrong_ones}) + (not axiom) == 1
    return (len(modules) + axiom - len(wrong_ones)) / (len(modules) + 1), near


def _honest(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> bool:
    """At least half as many productions as the solution has, which rewrite something that the question is about."""
    known = set(symbols(wanted.behind))
    useful = [rule for rule in mine.own.productions if rule.predecessor.symbol in known or exercise.names == "any"]
    return 2 * len(useful) >= len(wanted.own.productions) and mine.own.productions != ()


def _praise(exercise: Exercise, _: SystemAnswer, wanted: SystemAnswer) -> str:
    return reply("system.agree", last=exercise.steps) if not States(wanted.front).traits.stochastic else reply("system.chance")


SYSTEM = AnswerKind(_read, _difference, same, _honest, _praise, alike, tests_passed)
