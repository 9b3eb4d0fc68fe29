"""The definitions of a text, and the L-system that they make together, with the checks that only this notation needs.

A definition may use names that are defined further down, and the last definition of a name counts: so it is in Mathematica
with `:=`, at the time when a system is run.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from graphlib import CycleError, TopologicalSorter
from typing import TypeVar

from lark import Token

from lsys_kit.notation.analysis.checks import check_constants, check_expression, closest, suggestion, value_of
from lsys_kit.notation.analysis.problems import Problem, ProblemFound, problem
from lsys_kit.notation.dialects.mathematica.actions import RuleDefinition, RuleList, Run, SystemDefinition, WordDefinition
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Expression, Name, Number, names_in
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import Constant, LSystem
from lsys_kit.notation.syntax.actions import Part, place_of
from lsys_kit.notation.syntax.builder import Draft, Settings, build_system
from lsys_kit.notation.syntax.segmentation import segment_with_notes

Thing = TypeVar("Thing")
_SYSTEM_EXAMPLE = 'An L-system reads "lsystem = LSystem[axiom, lrules];": its axiom, then its rules.'
_HINTS = {
    "system": 'A system is run after it is defined: "lsystem = LSystem[axiom, lrules];".',
    "axiom": _SYSTEM_EXAMPLE,
    "list of rules": _SYSTEM_EXAMPLE,
    "rule": 'A rule is defined before its name is used in LRULES: "grow = LRule[LEFT[], PRED[A], RIGHT[], SUCC[A, A]];".',
}


@dataclass
class Definitions:
    """The definitions read so far, each kind by name; what has no name is kept under its number.

    Attributes
    ----------
    single
        Rules outside of LRULES.
    run
        The last run.
    alone, title
        The names on a line of their own, and the last of them: it is the name of a system that is printed below it.
    printed
        The name of the system whose printed form is being read.
    notes, others
        Notes, and the statements that are ignored: in order, each once.
    """

    axioms: dict[str, WordDefinition] = field(default_factory=dict)
    rules: dict[str, RuleList] = field(default_factory=dict)
    single: dict[str, RuleDefinition] = field(default_factory=dict)
    systems: dict[str, SystemDefinition] = field(default_factory=dict)
    constants: dict[str, Constant] = field(default_factory=dict)
    settings: Settings = field(default_factory=dict)
    run: Run | None = None
    alone: list[Token] = field(default_factory=list)
    title: str = ""
    printed: str | None = None
    notes: dict[str, None] = field(default_factory=dict)
    others: dict[str, None] = field(default_factory=dict)

    def take(self, kind: str, record: Part, at: tuple[int, int]) -> None:
        """Take in what a statement says."""
        if kind == "constant":
            self._keep(self.constants, record.name, replace(record, at=at))
        elif kind == "setting":
            self._keep(self.settings, *record)
        elif kind == "other":
            self.others[record] = None
        elif kind == "alone":
            self.alone.append(record)
            self.title, self.printed = str(record), None
        elif kind == "printed_axiom":
            self.printed = self._keep(self.systems, self.title, SystemDefinition(record, printed=True))
        elif kind == "printed_rule":
            self._print(replace(record, at=at))
        else:
            self._define(*record)

    def _define(self, name: str, thing: WordDefinition | RuleList | RuleDefinition | SystemDefinition | Run) -> None:
        if isinstance(thing, Run):
            self.run = thing
        elif isinstance(thing, SystemDefinition):
            self._keep(self.systems, name, thing)
        elif isinstance(thing, RuleList):
            self._keep(self.rules, name, thing)
        elif isinstance(thing, RuleDefinition):
            self._keep(self.single, name, thing)
        else:
            self._keep(self.axioms, name, thing)

    def _keep(self, table: dict[str, Thing], name: str, thing: Thing) -> str:
        """Keep a thing, as the last of its kind; where its name meant another thing before, say so."""
        if table.pop(name, thing) != thing:
            self.notes[f'"{name}" is defined more than once: the last definition counts.'] = None
        key = name or str(len(table))
        table[key] = thing
        return key

    def _print(self, rule: RuleDefinition) -> None:
        """A printed rule belongs to the axiom printed above it, if there is one."""
        if self.printed is None:
            self._keep(self.single, "", rule)
            return
        system = self.systems[self.printed]
        before = system.rules.members if isinstance(system.rules, RuleList) else ()
        self.systems[self.printed] = replace(system, rules=RuleList((*before, rule)))


def main_system(definitions: Definitions) -> SystemDefinition:
    """The system of a text: the last that is run, else the last that is defined, else what is defined without a system."""
    found, run = definitions, definitions.run
    only = len(found.systems) < 2 and all(name.isdigit() for name in found.systems)
    if run is None or (isinstance(run.system, Token) and only):
        if run is not None:
            found.notes[f'"{run.system}" is not defined: what the text defines is run.'] = None
        if run is None and len(found.systems) > 1:
            found.notes["Several systems are defined and none is run: the last is read."] = None
        return next(reversed(found.systems.values()), SystemDefinition())
    if len(found.systems) > 1:
        found.notes["Several systems are defined: the last that is run is read."] = None
    return run.system if isinstance(run.system, SystemDefinition) else _lookup(found, found.systems, run.system, "system")


def axiom_in(definitions: Definitions, system: SystemDefinition) -> WordDefinition | None:
    """The axiom of a system, or the last of the text; None where there is none."""
    if isinstance(system.axiom, Token):
        return _lookup(definitions, definitions.axioms, system.axiom, "axiom")
    return system.axiom or next(reversed(definitions.axioms.values()), None)


def rules_in(definitions: Definitions, system: SystemDefinition) -> Iterator[RuleDefinition]:
    """The rules of a system, or the last LRULES of the text, or the rules outside of both."""
    alone = [rule for name, rule in definitions.single.items() if name.isdigit()]
    rules = system.rules or next(reversed(definitions.rules.values()), None)
    if rules is None:
        rules, alone = RuleList(tuple(definitions.single.values())), []
    if alone:
        definitions.notes["A rule outside of LRULES is not used."] = None
    if isinstance(rules, Token):
        rules = _lookup(definitions, definitions.rules, rules, "list of rules")
    if rules.comma:
        definitions.notes["The comma after the last LRule is ignored."] = None
    for member in rules.members:
        yield member if isinstance(member, RuleDefinition) else _lookup(definitions, definitions.single, member, "rule")


def _lookup(definitions: Definitions, table: Mapping[str, Thing], name: Token, kind: str) -> Thing:
    """What has a name; one that is spelt in other cases is read too, with a note."""
    if name in table:
        return table[name]
    same = next((known for known in table if known.casefold() == name.casefold()), None)
    if same is None:
        named = [known for known in table if not known.isdigit()]
        raise problem("unknown definition", place_of(name), kind=kind, name=name, hint=suggestion(name, named) or _HINTS[kind])
    definitions.notes[f'"{name}" is read as "{same}".'] = None
    return table[same]


def finish(draft: Draft) -> LSystem:
    """The system of a text's definitions."""
    definitions = Definitions()
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
    draft.constants = _in_order(definitions.constants.values())
    names = definitions.constants.keys()
    _check_constants(draft.constants)
    system = main_system(definitions)
    draft.axiom = axiom_in(definitions, system)
    if draft.axiom is None:
        raise problem("no axiom", (len(draft.source), len(draft.source)))
    for rule in rules_in(definitions, system):
        _check_names(rule, names)
        draft.add("production", rule.production, rule.at)
    _add_settings(draft, definitions)
    draft.notes += _notes(draft, definitions)
    whole = build_system(draft)
    return segment_with_notes(whole) if system.printed else whole


def _in_order(constants: Iterable[Constant]) -> list[Constant]:
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
        raise problem("constant in terms of itself", known[name].at, name=name) from None


def _names_of_constant(constant: Constant) -> set[str]:
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


def _check_names(rule: RuleDefinition, constants: Collection[str]) -> None:
    """A parameter has a name of its own, and every value in a pattern is known."""
    for argument in rule.arguments:
        value = argument.value
        if argument.named and str(value) in constants:
            raise problem("parameter as constant", value.at, name=value)
        strange = () if argument.named else sorted(names_in(value) - set(constants))
        if strange:
            name = re.sub(r"_(Integer|Real|Rational|Symbol|String|List)$", "", strange[0])
            hint = suggestion(strange[0], constants, 0.8) or f'A parameter is named with "_" after it: "{name}_".'
            raise problem("no constant", value.at, name=strange[0], hint=hint)


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
    return [*(draft.axiom or ()), *(module for rule in draft.sections["productions"] for module in rule.modules)]
