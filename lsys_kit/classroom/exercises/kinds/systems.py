"""Systems as answers: right where their language is, whatever their symbols and parameters are called.

An answer is compared by its axiom, by what becomes of every module that the question is about, and by the words of all steps,
from the axiom and from other axioms. Where the question gives a part, the answer is tried in front of that part and behind it:
a production must itself say to which modules it applies.
"""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import replace

from lsys_kit.classroom.exercises.asked import beginning_with
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference
from lsys_kit.classroom.exercises.kinds.system_comparison import (
    Parting,
    SystemAnswer,
    alike,
    asked_modules,
    completed,
    parting,
    renaming,
    same,
    tests_passed,
    unused,
    wrongly_replaced,
)
from lsys_kit.classroom.exercises.typed.systems import read_typed
from lsys_kit.classroom.exercises.typed.text import text_answer
from lsys_kit.derivation.core.states import States
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem, Production, symbols
from lsys_kit.notation.read import read
from lsys_kit.translation import gettext
from lsys_kit.worlds.derive import derive

_AXIOM_LINE = re.compile(r"^[ \t]*(axiom|omega|ω)[ \t]*:", re.IGNORECASE | re.MULTILINE)
"""An answer with an axiom of its own is the whole system."""
_ARROW = re.compile(r"->|→")
MOST_QUOTED = 200
"""How many characters of a production a reply quotes."""


def _read(exercise: Exercise, answer: object) -> SystemAnswer:
    if isinstance(answer, LSystem):
        return SystemAnswer(answer, answer, answer)
    text = text_answer(answer, gettext("A system"), '"axiom: a"')
    known = f"{exercise.given}\n{exercise.solution}"
    return read_typed(text, lambda typed: _read_text(exercise, typed), known)


def _read_text(exercise: Exercise, text: str) -> SystemAnswer:
    if not exercise.given or _AXIOM_LINE.search(text):
        return _whole(read(text))
    given = read(exercise.given)
    with suppress(LSystemError):  # in another notation
        whole = read(text)
        if not all(_ARROW.search(line) for line in text.splitlines() if line.strip()):
            return _whole(whole)
        return completed(exercise, replace(given, productions=whole.productions, source=whole.source))
    together = read(f"{text}\n{exercise.given}")
    own = [rule for rule in together.productions if rule.at and rule.at[1] <= len(text) and rule not in given.productions]
    if not own:
        raise ModelValueError(
            gettext("There is no production here that the question does not give"), hint=gettext("Write it as: A -> B.")
        )
    return completed(exercise, replace(together, productions=tuple(own)))


def _whole(system: LSystem) -> SystemAnswer:
    return SystemAnswer(system, system, system)


# What to say


def _difference(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> Difference:
    behind = parting(exercise, mine.behind, wanted.behind)
    front = parting(exercise, mine.front, wanted.behind) if mine.front is not mine.behind else behind
    likeness, near = _likeness(exercise, mine, wanted)
    if front is None and behind is None:
        return _difference_in_writing(exercise, mine, wanted)
    if behind is None and front is not None:
        return Difference(_hijacking(front, mine), likeness * 0.9, near)
    found = behind or front
    assert found is not None
    return Difference(_in_words(found, mine, mine.behind if behind else mine.front, wanted.behind), likeness, near)


def _difference_in_writing(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> Difference:
    never = unused(mine.own)
    if never is not None:
        return Difference(
            gettext("One of your productions is never used, because one before it always applies:") + _typed(never, mine),
            1,
            True,
        )
    return Difference(gettext("The words are right, but not the angle, by which the drawing changes."), 1, True)


def _hijacking(found: Parting, mine: SystemAnswer) -> str:
    return gettext(
        "Your production works only where it stands behind those that are given: by itself it applies to other modules too, "
        "such as {module}. To which ones should it apply? Let its condition say so.",
        module=_named(found.module) if found.module is not None else _module_before(found, mine.front),
    )


def _named(module: Module) -> str:
    return gettext("the {module}", module=module)


def _module_before(found: Parting, system: LSystem) -> str:
    if found.step == 0:
        return gettext("the axiom")
    derivation = derive(system, found.step)
    parents = derivation.origins(found.step).parents
    before = derivation[found.step - 1]
    return _named(before[parents[found.position]] if found.position < len(parents) else before[len(before) - 1])


def _in_words(found: Parting, mine: SystemAnswer, system: LSystem, wanted: LSystem) -> str:
    besides = " " + gettext("(with {setting})", setting=found.setting) if found.setting else ""
    so_far = ""
    if found.step > 1 and not besides:
        so_far = gettext("Up to step {step} your words are right.", step=found.step - 1) + " "
    if found.module is not None:
        cause = _decomposition_for(found.module, mine, system, wanted) or _production_for(found.module, mine, system)
        said = gettext("Of {module} something else should become{besides}.", module=found.module, besides=besides)
        return f"{so_far}{said} {cause}".strip()
    if found.step == 0:
        return gettext("Look at your axiom: it is not yet the word with which the development begins.")
    derivation = derive(system, found.step)
    if besides:
        return gettext(
            "From another start it goes wrong at step {step}, position {position}{besides}.",
            step=found.step,
            position=found.position + 1,
            besides=besides,
        )
    parents, before = derivation.origins(found.step).parents, derivation[found.step - 1]
    if found.position >= len(parents):
        return so_far + gettext(
            "At step {step} your word ends after position {position}, which is too early.",
            step=found.step,
            position=found.position,
        )
    mother = before[parents[found.position]]
    production = derivation.origins(found.step).productions[found.position]
    have = derivation[found.step][found.position]
    where = {"step": found.step, "position": found.position + 1, "module": have, "mother": mother}
    if production is None:
        return so_far + gettext(
            "At step {step} look at position {position}, where you have {module}: you have no production for {mother}, so that "
            "it stays as it is.",
            **where,
        )
    said = gettext(
        "At step {step} look at position {position}, where you have {module}. It comes from {mother}, by this production:",
        **where,
    )
    return f"{so_far}{said}{_typed(system.productions[production], mine)}"


def _decomposition_for(module: Module, mine: SystemAnswer, system: LSystem, wanted: LSystem) -> str:
    """What is said where the production for a module is right, and the decomposition of what it makes is not."""
    if not (wanted.decomposition or system.decomposition):
        return ""
    one, other = (derive(replace(beginning_with(each, [module]), decomposition=()), 1)[1] for each in (system, wanted))
    if tuple(one) != tuple(other):
        return ""
    if not system.decomposition:
        return gettext("Its production is right. Is there a rule by which what it makes is decomposed?")
    if len(system.decomposition) > 1:
        return gettext("Its production is right. Look at the rules by which what it makes is decomposed.")
    said = gettext("Its production is right. Look at this rule by which what it makes is decomposed:")
    return said + _typed(system.decomposition[0], mine)


def _production_for(module: Module, mine: SystemAnswer, system: LSystem) -> str:
    states = States(system)
    state = states.number(module.symbol, module.arguments)
    number = states.production(state) if states.is_d0l(state) else None
    if number is None:
        return gettext("You have no production that applies to it.") if states.is_d0l(state) else ""
    return gettext("Look at this production:") + _typed(system.productions[number], mine)


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
        modules = [module for module in asked_modules(exercise, wanted.behind) if _rewritten_by(wanted.own, module)]
        wrong = set(wrongly_replaced(exercise, mine.behind, wanted.behind, names))
    except LSystemError:
        return 0, False
    wrong_ones = sum(names.own(module) in wrong for module in modules)
    kinds = {module.symbol for module in modules if names.own(module) in wrong}
    all_kinds = {module.symbol for module in modules}
    total = len(modules) + 1
    near = len(all_kinds) > 2 and (len(kinds) + (not axiom)) == 1
    return (total - wrong_ones - (not axiom)) / total, near


def _rewritten_by(own: LSystem, module: Module) -> bool:
    return any(rule.predecessor.symbol == module.symbol for rule in own.productions)


def _honest(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> bool:
    """At least half as many productions as the solution has, which rewrite something that the question is about."""
    known = set(symbols(wanted.behind))
    useful = [rule for rule in mine.own.productions if rule.predecessor.symbol in known or exercise.names == "any"]
    return 2 * len(useful) >= len(wanted.own.productions) and mine.own.productions != ()


def _praise(exercise: Exercise, _: SystemAnswer, wanted: SystemAnswer) -> str:
    return (
        gettext("The words of all steps from 0 to {last} agree, and so does what becomes of each module.", last=exercise.steps)
        if not States(wanted.front).traits.stochastic
        else gettext("Each module becomes what it should, as often as it should.")
    )


SYSTEM = AnswerKind(
    'lines of the system, as a text between """ and """',
    _read,
    same,
    _difference,
    _honest,
    _praise,
    alike,
    tests_passed,
    "Passed: {right} of {all} tests.",
)
