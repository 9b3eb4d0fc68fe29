"""What the definitions of a text say, by name, and which L-system they make together.

A definition may use names that are defined further down, and the last definition of a name counts: so it is in Mathematica
with `:=`, at the time when a system is run.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

from lark import Token

from lsys_kit.errors import ModelNameError
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.dialects.mathematica.actions import RuleDefinition, RuleList, Run, SystemDefinition, WordDefinition
from lsys_kit.notation.model.system import Constant

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
    source
        The text.
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

    source: str
    axioms: dict[str, WordDefinition] = field(default_factory=dict)
    rules: dict[str, RuleList] = field(default_factory=dict)
    single: dict[str, RuleDefinition] = field(default_factory=dict)
    systems: dict[str, SystemDefinition] = field(default_factory=dict)
    constants: dict[str, Constant] = field(default_factory=dict)
    settings: dict[str, Any] = field(default_factory=dict)
    run: Run | None = None
    alone: list[Token] = field(default_factory=list)
    title: str = ""
    printed: str | None = None
    notes: dict[str, None] = field(default_factory=dict)
    others: dict[str, None] = field(default_factory=dict)

    def take(self, kind: str, record: Any, at: tuple[int, int]) -> None:
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
        raise ModelNameError(
            f'No {kind} has the name "{name}"',
            definitions.source,
            name.start_pos,
            name.end_pos,
            suggestion(name, named) or _HINTS[kind],
        )
    definitions.notes[f'"{name}" is read as "{same}".'] = None
    return table[same]
