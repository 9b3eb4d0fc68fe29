"""The definitions of a text put together as an L-system, with the checks that only this notation needs."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from graphlib import CycleError, TopologicalSorter

from lsys_kit.errors import ModelNameError
from lsys_kit.notation.analysis.checks import check_constants, check_expression, closest, span, suggestion, value_of
from lsys_kit.notation.analysis.problems import Problem, ProblemFound, problem
from lsys_kit.notation.dialects.mathematica.actions import RuleDefinition
from lsys_kit.notation.dialects.mathematica.definitions import Definitions, axiom_in, main_system, rules_in
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Expression, Name, Number, names_in
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import Constant, LSystem
from lsys_kit.notation.syntax.builder import Draft, build_system
from lsys_kit.notation.syntax.segmentation import segment_with_notes


def finish(draft: Draft) -> LSystem:
    """The system of a text's definitions."""
    definitions = Definitions(draft.source)
    for kind, record, at in draft.deferred:
        definitions.take(kind, record, at)
    try:
        return _system(draft, definitions)
    except ProblemFound as error:
        raise _about_symbol(error.problem, draft) from None


def _about_symbol(unworded: Problem, draft: Draft) -> ProblemFound:
    """A problem with a name; where that is a symbol of the text, it is used as a value, probably in brackets of a branch."""
    symbols = {module.symbol for module in _modules(draft)}
    mistaken = unworded.code in ("unknown name", "name among none") and unworded.subject["name"] in symbols
    return ProblemFound(Problem("symbol as value", unworded.place, unworded.subject) if mistaken else unworded)


def _system(draft: Draft, definitions: Definitions) -> LSystem:
    """The L-system that the definitions make together."""
    draft.constants = _in_order(definitions.constants.values(), draft.source)
    names = definitions.constants.keys()
    _check_constants(draft.constants)
    system = main_system(definitions)
    draft.axiom = axiom_in(definitions, system)
    if draft.axiom is None:
        raise problem("no axiom", (len(draft.source), len(draft.source)))
    for rule in rules_in(definitions, system):
        _check_names(rule, names, draft.source)
        draft.add("production", rule.production, rule.at)
    _add_settings(draft, definitions)
    draft.notes += _notes(draft, definitions)
    whole = build_system(draft)
    return segment_with_notes(whole) if system.printed else whole


def _in_order(constants: Iterable[Constant], source: str) -> list[Constant]:
    """The constants so that each uses only those before it: as they were defined, where that is so already."""
    known = {constant.name: constant for constant in constants}
    uses = {name: _names_of_constant(constant) & known.keys() for name, constant in known.items()}
    before: set[str] = set()
    for name in known:
        if not uses[name] <= before:
            break
        before.add(name)
    else:
        return list(known.values())
    try:
        return [known[name] for name in TopologicalSorter(uses).static_order()]
    except CycleError as found:
        name = found.args[1][0]
        raise ModelNameError(
            f'The constant "{name}" is defined in terms of itself',
            source,
            *span(known[name]),
            "Give it a value that can be computed without it.",
        ) from None


def _names_of_constant(constant: Constant) -> set[str]:
    """The names that a constant's value and range use."""
    return set().union(*(names_in(part) for part in (constant.value, *(constant.range or ()))))


def _check_constants(constants: Iterable[Constant]) -> None:
    """The value of every constant is a number."""
    names = {constant.name for constant in constants}
    for constant in constants:
        value = constant.value
        if isinstance(value, Name) and value.name not in names:
            raise problem(
                "word as axiom" if constant.name.lower() == "axiom" else "name as constant",
                value.at,
                closest(value.name, names),
                name=value,
                constant=constant.name,
            )
    check_constants(constants)


def _check_names(rule: RuleDefinition, constants: Collection[str], source: str) -> None:
    """A parameter has a name of its own, and every value in a pattern is known."""
    for argument in rule.arguments:
        value = argument.value
        if argument.named and str(value) in constants:
            raise ModelNameError(
                f'"{value}" is already a constant',
                source,
                *span(value),
                f'Give the parameter another name; or type "{value}" to match the constant\'s value.',
            )
        strange = () if argument.named else sorted(names_in(value) - set(constants))
        if strange:
            name = re.sub(r"_(Integer|Real|Rational|Symbol|String|List)$", "", strange[0])
            hint = suggestion(strange[0], constants, 0.8) or f'A parameter is named with "_" after it: "{name}_".'
            raise ModelNameError(f'No constant has the name "{strange[0]}"', source, *span(value), hint)


def _add_settings(draft: Draft, definitions: Definitions) -> None:
    """Take in the settings, with numbers in place of calculations."""
    values: dict[str, Value] = {}
    for constant in draft.constants:
        values[constant.name] = value_of(constant.value, values)
    steps = {"steps": definitions.run.steps} if definitions.run else {}
    for name, setting in {**definitions.settings, **steps}.items():
        if isinstance(setting, Expression):
            check_expression(setting, values.keys())
            setting = Number(value_of(setting, values), setting.at)
        draft.settings[name] = setting


def _notes(draft: Draft, definitions: Definitions) -> Iterator[str]:
    """Notes on definitions that are not used."""
    yield from definitions.notes
    unused = {constant.name for constant in draft.constants} - _used_names(draft, definitions)
    for constant in draft.constants:
        if constant.name in unused:
            yield f'The constant "{constant.name}" is used nowhere.'
    defined = definitions.axioms | definitions.rules | definitions.single | definitions.systems | definitions.constants
    others = [*definitions.others, *(name for name in map(str, definitions.alone) if name not in defined)]
    if others:
        yield f"Ignored, because the kit prints and draws by itself: {', '.join(others)}."


def _used_names(draft: Draft, definitions: Definitions) -> set[str]:
    """The names that anything uses."""
    rules = draft.sections["productions"]
    steps = definitions.run.steps if definitions.run else None
    parts = [
        *(argument for module in _modules(draft) for argument in module.arguments),
        *(rule.condition for rule in rules),
        *definitions.settings.values(),
        steps,
    ]
    names = [names_in(part) for part in parts if isinstance(part, Expression)]
    return set().union(*names, *map(_names_of_constant, draft.constants))


def _modules(draft: Draft) -> list[Pattern]:
    """All modules of a text."""
    return [*(draft.axiom or ()), *(module for rule in draft.sections["productions"] for module in rule.modules)]
