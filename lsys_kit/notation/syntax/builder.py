"""The statements of a text gathered into a draft of a system, and the checks of the whole."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, TypeAlias

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.analysis.checks import (
    SurfaceText,
    check_constants,
    check_expression,
    check_field,
    check_meta,
    check_production,
    check_word,
    checked_surfaces,
    value_of,
)
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.model.expressions import Name, names_in
from lsys_kit.notation.model.modules import Pattern, flat
from lsys_kit.notation.model.system import Constant, LSystem, MetaRule, Production
from lsys_kit.notation.syntax.actions import Part

Settings: TypeAlias = dict[str, Any]
"""What settings say, by their names."""
_SYMBOL_LISTS = {"alphabet": "alphabet", "ignore": "ignored", "consider": "considered"}
"""The settings that are lists of symbols, and their attributes of a system."""
_TEXT_SETTINGS = frozenset(("turtle", "cells", "branches", "widths", "colours", "field"))
"""The settings that are words, or a field."""
_COUNTS = {"steps": "steps", "depth": "rounds", "decomposition_depth": "rounds"}
"""The settings that are whole numbers from 0 on, and what they count."""


@dataclass
class Draft:
    """The system that the statements read so far make.

    Attributes
    ----------
    source, notation, turtle
        The text, the notation in which it is read, and its tradition of turtle commands by default.
    settings
        The settings, by keyword.
    deferred
        Statements that only the dialect itself can complete, once all are read.
    notes
        Notes on how the text is read.
    """

    source: str
    notation: str
    turtle: str = "abop"
    axiom: tuple[Pattern, ...] | None = None
    constants: list[Constant] = field(default_factory=list)
    sections: dict[str, list[Production]] = field(
        default_factory=lambda: {"productions": [], "decomposition": [], "interpretation": []}
    )
    meta: list[MetaRule] = field(default_factory=list)
    surfaces: list[SurfaceText] = field(default_factory=list)
    settings: Settings = field(default_factory=dict)
    section: str = "productions"
    deferred: list[tuple[str, Part, tuple[int, int]]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def add(self, kind: str, record: Part, at: tuple[int, int]) -> None:
        """Take in what a statement says: its kind and its record."""
        if kind == "axiom":
            if self.axiom is not None:
                raise problem("second axiom", at)
            self.axiom = record
        elif kind == "constant":
            self.constants.append(replace(record, at=at))
        elif kind == "production":
            self.sections[self.section].append(replace(record, at=at))
            if len(self.sections[self.section]) > current().rules:
                raise ModelLimitError(
                    f"The model has more than {current().rules:,} productions",
                    limit=current().rules,
                    source=self.source,
                    start=at[0],
                )
        elif kind == "section":
            self.section = record
        elif kind == "meta":
            self.meta.append(replace(record, at=at))
        elif kind == "surface":
            self.surfaces.append(record)
        elif kind == "deferred":
            self.deferred.append((*record, at))
        else:
            self._set(kind, record, at)

    def _set(self, kind: str, record: object, at: tuple[int, int]) -> None:
        if kind in ("ignore", "consider") and {"ignore", "consider"} & self.settings.keys() - {kind}:
            raise problem("ignore and consider", at)
        if kind in self.settings:
            raise problem("setting twice", at, keyword=kind)
        self.settings[kind] = record


def _occurring_symbols(draft: Draft) -> set[str]:
    productions = [rule.successor for rules in draft.sections.values() for rule in rules]
    words = (draft.axiom or (), *productions, *(rule.successor for rule in draft.meta))
    return {module.symbol for word in words for module in flat(word)}


def check_colons(draft: Draft) -> None:
    """What is replaced and its left context must not be a condition without its colon, as in "A(t) t < T -> B".

    It is one where a parameter is used as if it were a module, and no module has its name.
    """
    symbols = _occurring_symbols(draft)
    for production in draft.sections["productions"]:
        before = [*production.left, *production.predecessors]
        compared = [*before, *production.right[:1]]
        parameters = {argument.name for module in before for argument in module.arguments if isinstance(argument, Name)}
        strange = parameters.intersection(module.symbol for module in compared if not module.arguments).difference(symbols)
        if strange and len(before) > 1 and (production.left or production.right):
            first = next(index for index, module in enumerate(before) if module.arguments)
            raise problem("condition without colon", before[min(first + 1, len(before) - 1)].at)


def build_system(draft: Draft) -> LSystem:
    """The system of a draft, checked."""
    source, names = draft.source, [constant.name for constant in draft.constants]
    check_constants(draft.constants)
    if draft.axiom is None:
        raise problem("no axiom", (len(source), len(source)))
    check_word(draft.axiom, names)
    for section, productions in draft.sections.items():
        for production in productions:
            check_production(production, names, section)
    for rule in draft.meta:
        check_meta(rule, names)
    if "field" in draft.settings:
        check_field(draft.settings["field"], names)
    return LSystem(
        draft.axiom,
        constants=tuple(draft.constants),
        meta=tuple(draft.meta),
        notation=draft.notation,
        source=source,
        notes=tuple(draft.notes),
        surfaces=checked_surfaces(draft.surfaces),
        **_checked_settings(draft) | {section: tuple(rules) for section, rules in draft.sections.items()},
    )


def _checked_settings(draft: Draft) -> Settings:
    result: Settings = {"turtle": draft.turtle}
    for name, setting in draft.settings.items():
        if name in _SYMBOL_LISTS or name in _TEXT_SETTINGS:
            result[_SYMBOL_LISTS.get(name, name)] = setting
            continue
        used = sorted(names_in(setting) & {constant.name for constant in draft.constants})
        if used:
            raise problem("constant in setting", setting.at, name=used[0], keyword=name)
        check_expression(setting, ())
        result[name] = value_of(setting)
        if name in _COUNTS and not (isinstance(result[name], int) and result[name] >= 0):
            raise problem(f"number of {_COUNTS[name]}", setting.at, expression=setting)
        if name == "seed" and not isinstance(result[name], int):
            raise problem("seed", setting.at, expression=setting)
    return result
