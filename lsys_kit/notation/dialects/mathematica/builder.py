"""The definitions of a text put together as an L-system, with the checks that only this notation needs."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from graphlib import CycleError, TopologicalSorter

from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError
from lsys_kit.notation.analysis.checks import check_constants, check_expression, span, suggestion, value_of
from lsys_kit.notation.dialects.mathematica.actions import RuleDefinition
from lsys_kit.notation.dialects.mathematica.definitions import Definitions, axiom_in, main_system, rules_in
from lsys_kit.notation.dialects.mathematica.expressions import expression_text
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, names_in
from lsys_kit.notation.model.system import Constant, LSystem, Module
from lsys_kit.notation.syntax.builder import Draft, build_system
from lsys_kit.notation.syntax.segmentation import segment_with_notes

_AXIOM = 'Give the first word, as in "axiom = AXIOM[A];".'
_BRANCH = 'Brackets around values are those of a module; a branch is typed \'F, "[", "+", F, "]"\'.'
_OWN_HINTS = {
    "A parameter is named before the arrow": 'A parameter is named with "_" in a pattern, as in "PRED[A[t_]]"; a constant is '
                                             'defined, as in "dt = 0.5;".',
    "Random numbers stand behind the arrow": 'Random numbers stand in SUCC, as in "SUCC[F[RandomReal[{1, 2}]]]".',
    'Type "axiom: ': _AXIOM,
    "Write the smaller end first": 'Write the smaller end first, as in "(* 1 .. 6 by 1 *)".',
    "It says how far one move": 'It says how far one move of the slider goes, as in "(* 1 .. 6 by 0.1 *)".',
}
"""What the shared checks advise, in this notation's words; by how that begins."""


def finish(draft: Draft) -> LSystem:
    """The system of a text's definitions."""
    definitions = Definitions(draft.source)
    for kind, record, at in draft.more:
        definitions.take(kind, record, at)
    try:
        return _filled(draft, definitions)
    except LSystemError as error:
        raise _in_own_words(error, draft) from None


def _filled(draft: Draft, definitions: Definitions) -> LSystem:
    draft.constants = _in_order(definitions.constants.values(), draft.source)
    names = definitions.constants.keys()
    _check_constants(draft.constants, draft.source)
    system = main_system(definitions)
    draft.axiom = axiom_in(definitions, system)
    if draft.axiom is None:
        raise ModelSyntaxError("There is no axiom", draft.source, len(draft.source), None, _AXIOM)
    for rule in rules_in(definitions, system):
        _check_names(rule, names, draft.source)
        draft.add("production", rule.production, rule.at)
    _set(draft, definitions)
    draft.notes += _notes(draft, definitions)
    whole = build_system(draft)
    return segment_with_notes(whole) if system.printed else whole


def _in_order(constants: Iterable[Constant], source: str) -> list[Constant]:
    """The constants so that each uses only those before it: as they were defined, where that is so already."""
    known = {constant.name: constant for constant in constants}
    uses = {name: _names(constant) & known.keys() for name, constant in known.items()}
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
        raise ModelNameError(f'The constant "{name}" is defined by itself', source, *span(known[name]),
                             "Give it a value that can be computed without it.") from None


def _names(constant: Constant) -> set[str]:
    """The names that a constant's value and range use."""
    return set().union(*(names_in(part) for part in (constant.value, *(constant.range or ()))))


def _check_constants(constants: Iterable[Constant], source: str) -> None:
    """No constant stands for what is no number."""
    names = {constant.name for constant in constants}
    for constant in constants:
        value = constant.value
        if isinstance(value, Name) and value.name not in names:
            hint = suggestion(value.name, names) or (_AXIOM if constant.name.lower() == "axiom" else
                                                     f'A constant is a number, as in "{constant.name} = 3;".')
            raise ModelNameError(f'"{value}" is no number', source, *span(value), hint)
    check_constants(constants, source)


def _check_names(rule: RuleDefinition, constants: Collection[str], source: str) -> None:
    """A parameter has a name of its own, and every value that is asked for is known."""
    for asked in rule.asked:
        value = asked.value
        if asked.named and str(value) in constants:
            raise ModelNameError(f'"{value}" is a constant already', source, *span(value),
                                 f'Give the parameter another name; or type "{value}" to ask for the constant\'s value.')
        strange = () if asked.named else sorted(names_in(value) - set(constants))
        if strange:
            name = re.sub(r"_(Integer|Real|Rational|Symbol|String|List)$", "", strange[0])
            hint = suggestion(strange[0], constants, 0.8) or f'A parameter is named with "_" behind it: "{name}_".'
            raise ModelNameError(f'No constant has the name "{strange[0]}"', source, *span(value), hint)


def _set(draft: Draft, definitions: Definitions) -> None:
    """What is set, with numbers in place of calculations."""
    values: dict[str, Value] = {}
    for constant in draft.constants:
        values[constant.name] = value_of(constant.value, draft.source, values)
    steps = {"steps": definitions.run.steps} if definitions.run else {}
    for name, setting in {**definitions.settings, **steps}.items():
        if isinstance(setting, Expression):
            check_expression(setting, values.keys(), draft.source)
            setting = Number(value_of(setting, draft.source, values), setting.at)
        draft.settings[name] = setting


def _notes(draft: Draft, definitions: Definitions) -> Iterator[str]:
    """What is worth telling."""
    yield from definitions.notes
    unused = {constant.name for constant in draft.constants} - _used(draft, definitions)
    for constant in draft.constants:
        if constant.name in unused:
            yield f'The constant "{constant.name}" is used nowhere.'
    defined = definitions.axioms | definitions.rules | definitions.single | definitions.systems | definitions.constants
    others = [*definitions.others, *(name for name in map(str, definitions.alone) if name not in defined)]
    if others:
        yield f"Passed over, for the kit prints and draws by itself: {', '.join(others)}."


def _used(draft: Draft, definitions: Definitions) -> set[str]:
    """The names that anything uses."""
    rules = draft.sections["productions"]
    steps = definitions.run.steps if definitions.run else None
    parts = [*(argument for module in _modules(draft) for argument in module.arguments), *(rule.condition for rule in rules),
             *definitions.settings.values(), steps]
    names = [names_in(part) for part in parts if isinstance(part, Expression)]
    return set().union(*names, *map(_names, draft.constants))


def _in_own_words(error: LSystemError, draft: Draft) -> LSystemError:
    """An error of the shared checks in this notation's words: expressions as they are spelt here, and its own hints."""
    hint = next((own for begins, own in _OWN_HINTS.items() if (error.hint or "").startswith(begins)), error.hint)
    name = re.match('I do not know the name "(.*)"', error.message)
    if name and name[1] in {module.symbol for module in _modules(draft)}:
        hint = _BRANCH
    kit = {f'"{expression}': f'"{expression_text(expression)}' for expression in _expressions(draft)}
    for text in sorted(kit, key=len, reverse=True):
        error.message = error.message.replace(text, kit[text])
        hint = hint and hint.replace(text, kit[text])
    return error.with_hint(hint or "")


def _modules(draft: Draft) -> list[Module]:
    """All modules of a text."""
    return [*(draft.axiom or ()), *(module for rule in draft.sections["productions"] for module in rule.modules)]


def _expressions(draft: Draft) -> Iterator[Expression]:
    """All operations in a text, with those in them."""
    whole = [*(constant.value for constant in draft.constants),
             *(argument for module in _modules(draft) for argument in module.arguments),
             *(rule.condition for rule in draft.sections["productions"])]
    while whole:
        part = whole.pop()
        if isinstance(part, Apply):
            yield part
            whole.extend(part.operands)
