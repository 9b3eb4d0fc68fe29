"""A step, production by production: which rule was applied to which module, and why the others were not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.core.matching import neighbours_along, values_at
from lsys_kit.derivation.core.rules import Rule, kind_of
from lsys_kit.derivation.core.states import MODULES_BETWEEN_CHECKS
from lsys_kit.derivation.core.traits import CUT
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.engines.stepwise import ParentWord, Stepper, surviving
from lsys_kit.errors import require, shown
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.expressions import Name, names_in
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.registry import dialect_named
from lsys_kit.notation.write import as_written
from lsys_kit.translation import gettext


@dataclass(frozen=True)
class ModuleOutcome:
    """What became of one module in a step, or of several that were replaced together.

    Attributes
    ----------
    position
        Its place in the old word, from 1, as a reader counts.
    module
        The module; of several that were replaced together the first.
    successor
        What replaced it.
    production
        The production that was applied, in words with its number; or why none was.
    refused
        For each production of its symbol that was not applied, why not.
    notation
        In which notation the module and its successor are shown.
    others
        The modules behind it that were replaced together with it.
    """

    position: int
    module: Module
    successor: tuple[Module, ...]
    production: str
    refused: tuple[str, ...]
    notation: str = "abop"
    others: tuple[Module, ...] = ()

    def __str__(self) -> str:
        own = dialect_named(self.notation)
        made = own.word(self.successor) or "ε"
        last = f"-{self.position + len(self.others)}" if self.others else ""
        said = (
            gettext("{modules} become {made}: {production}")
            if self.others
            else gettext("{module} becomes {made}: {production}")
        )
        words = own.word((self.module, *self.others))
        line = said.format(module=words, modules=words, made=made, production=self.production)
        return "\n     ".join([f"{self.position}{last}. {line}", *self.refused])

    __repr__ = __str__


class Explanation(tuple[ModuleOutcome, ...]):
    """What became of all modules of a word, shown one below the other."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "\n".join(map(str, self))


def explain(derivation: Derivation, step: int) -> Explanation:
    """Why the word of a step is what it is: what became of every module of the word before.

    Parameters
    ----------
    derivation
        Any derivation.
    step
        From 1 on.

    Raises
    ------
    ModelValueError
        The derivation has no such step.

    Examples
    --------
    >>> from lsys_kit import derive, read
    >>> explain(derive(read("axiom: b a\\nb < a -> b\\na -> c"), 1), 1)
    1. b becomes b: no production is for b
    2. a becomes b: production 1, b < a -> b
         production 2, a -> c: matches too, but production 1 stands before it
    """
    require(derivation, Derivation, "A derivation")
    with Task(f"The explanation of step {shown(step)} was not finished"):
        return _explanation(derivation, step)


def _explanation(derivation: Derivation, step: int) -> Explanation:
    origins, new, sight = derivation.origins(step), derivation[step].numbers(), derivation.sight(step - 1)
    stepper = Stepper(derivation.states, 0)
    old = stepper.old(sight.word.numbers(), sight.sees) if sight else stepper.old(derivation[step - 1].numbers())
    successors: dict[int, list[Module]] = {}
    applied: dict[int, int | None] = {}
    for code, parent, production in counted(zip(new, origins.parents, origins.productions, strict=True)):
        successors.setdefault(parent, []).append(derivation.states.modules[code])
        applied[parent] = production
    return Explanation(_outcomes(stepper, old, successors, applied, origins.sizes or [1] * len(old.modules)))


def _outcomes(
    stepper: Stepper, old: ParentWord, successors: dict[int, list[Module]], applied: dict[int, int | None], sizes: Sequence[int]
) -> Iterator[ModuleOutcome]:
    system = stepper.states.system
    outcomes = zip(surviving(old.symbols), sizes, strict=True)
    for position, (kept, size) in enumerate(counted(outcomes, MODULES_BETWEEN_CHECKS)):
        if not size:
            continue  # it was replaced together with one before it
        module = old.modules[position]
        made = tuple(successors.get(position, ()))
        rules = [rule for kind, found in stepper.states.rules.items() if kind[0] == module.symbol for rule in found]
        refusals = [(rule, _refusal(stepper, old, position, rule)) for rule in rules] if kept else []
        matching = [rule for rule, why in refusals if why is None and (made or len(rule.predecessors) == size)]
        chosen = _applied_rule(matching, applied.get(position), bool(made))
        said = (
            _production_text(system, chosen)
            if chosen
            else gettext("it is cut off")
            if not kept
            else gettext("no production matches")
            if rules
            else gettext("no production is for {symbol}", symbol=module.symbol)
        )
        why_not = tuple(
            f"{_production_text(system, rule)}: {why or _passed_over(rule, chosen)}"
            for rule, why in refusals
            if rule is not chosen
        )
        others = tuple(old.modules[position + 1 : position + size])
        yield ModuleOutcome(position + 1, module, made, said, why_not, system.notation, others)


def _applied_rule(matching: list[Rule], applied: int | None, left_something: bool) -> Rule | None:
    """The rule that was applied; where it left nothing, the first that matches."""
    if left_something:
        return next((rule for rule in matching if rule.number == applied), None)
    return matching[0] if matching else None


def _production_text(system: LSystem, rule: Rule) -> str:
    return gettext("production {number}, {rule}", number=rule.number + 1, rule=as_written(system, rule.production))


def _passed_over(rule: Rule, chosen: Rule | None) -> str:
    if chosen is not None and chosen.probability is not None and rule.probability is not None:
        return gettext("matches too, but was not drawn")
    before = chosen and gettext("matches too, but production {number} stands before it", number=chosen.number + 1)
    return before or gettext("matches too")


def _refusal(stepper: Stepper, old: ParentWord, position: int, rule: Rule) -> str | None:
    """Why a rule does not match a module; None where it does."""
    system, module, asked = stepper.states.system, old.modules[position], rule.production.predecessor
    if len(module.arguments) != len(asked.arguments):
        return gettext(
            "is for {symbol} with {asked} parameters, not {number}",
            symbol=asked.symbol,
            asked=len(asked.arguments),
            number=len(module.arguments),
        )
    at = stepper.context(rule, old, position)
    if at is None:
        return _others_missing(system, old, position, rule) or _context_missing(system, old, position, rule)
    values = values_at(old.modules, at)
    given = values + stepper.states.constants
    arguments = [a for m in rule.production.parameters for a in m.arguments]
    for index, wanted in rule.equalities:
        if values[index] != wanted(given):
            wanted_text = str(arguments[index])
            return gettext("asks for {argument}, and there is {value}", argument=wanted_text, value=number_text(values[index]))
    chance = old.chance(0, 0, position)
    if not stepper.states.matches(rule, values, module, chance):
        names = names_in(rule.production.condition) if rule.production.condition else frozenset()
        known = {a.name: value for a, value in zip(arguments, values, strict=True) if isinstance(a, Name)}
        known |= dict(zip((c.name for c in system.constants), stepper.states.constants, strict=True))
        values_text = ", ".join(
            [
                *(f"{name} = {number_text(known[name])}" for name in sorted(names)),
                *(
                    gettext(
                        "{question} is {value}",
                        question=as_written(system, question),
                        value=number_text(answer((*given, chance))),
                    )
                    for question, answer in rule.questions
                ),
            ]
        )
        condition = as_written(system, rule.production.condition)
        if not values_text:
            return gettext("{condition} is false", condition=condition)
        return gettext("{condition} is false where {values}", condition=condition, values=values_text)
    return None


def _others_missing(system: LSystem, old: ParentWord, position: int, rule: Rule) -> str | None:
    """Which modules of those that a rule replaces together are not there."""
    own = old.modules[position : position + len(rule.predecessors)]
    if tuple(map(kind_of, own)) == rule.predecessors:
        return gettext("what is cut off is not replaced") if CUT in old.symbols[position : position + len(own)] else None
    word = dialect_named(system.notation).word
    together = word(rule.production.predecessors)
    return gettext("replaces {modules} together, and there is {there}", modules=together, there=word(own))


def _context_missing(system: LSystem, old: ParentWord, position: int, rule: Rule) -> str:
    assert old.around is not None
    word = dialect_named(system.notation).word
    left = neighbours_along(old.around.before, position, len(rule.left))
    there = word(old.modules[at] for at in reversed(left)) or gettext("nothing")
    if tuple((old.symbols[at], len(old.modules[at].arguments)) for at in left) != rule.left:
        needed = word(rule.production.left)
        return gettext("needs {modules} on its left, and there is {there}", modules=needed, there=there)
    right = neighbours_along(old.around.after, position + len(rule.predecessors) - 1, max(1, len(rule.right)))
    there = word(old.modules[at] for at in right) or gettext("nothing")
    needed = word(rule.production.right)
    return gettext("needs {modules} on its right, and there is {there}", modules=needed, there=there)
