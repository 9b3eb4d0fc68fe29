"""What the statements of a text make of a system, one after another, and the checks of the whole."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.analysis.checks import (
    check_constants,
    check_expression,
    check_meta,
    check_production,
    check_word,
    span,
    value_of,
)
from lsys_kit.notation.model.expressions import names_in
from lsys_kit.notation.model.system import Constant, LSystem, MetaRule, Module, Production

_ROWS = {"alphabet": "alphabet", "ignore": "ignored", "consider": "considered"}
"""The settings that are rows of symbols, and where a system has them."""
_PLAIN = frozenset(("turtle", "cells"))
"""The settings that are texts."""
_COUNTED = {"steps": "steps", "depth": "rounds", "decomposition_depth": "rounds"}
"""The settings that are whole numbers from 0 on, and what they count."""


@dataclass
class Draft:
    """What the statements read so far make of a system.

    Attributes
    ----------
    source, notation, turtle
        The text, the notation in which it is read, and whose turtle commands are meant if it says nothing.
    settings
        What is set, by the names of the statements.
    more
        What only the notation itself knows how to put together.
    notes
        What is worth telling.
    """

    source: str
    notation: str
    turtle: str = "abop"
    axiom: tuple[Module, ...] | None = None
    constants: list[Constant] = field(default_factory=list)
    sections: dict[str, list[Production]] = field(
        default_factory=lambda: {"productions": [], "decomposition": [], "interpretation": []})
    meta: list[MetaRule] = field(default_factory=list)
    settings: dict[str, Any] = field(default_factory=dict)
    section: str = "productions"
    more: list[tuple[str, Any, tuple[int, int]]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def add(self, kind: str, record: Any, at: tuple[int, int]) -> None:
        """Take in what a statement says: its kind and its record."""
        if kind == "axiom":
            if self.axiom is not None:
                raise ModelSyntaxError("A second axiom stands here", self.source, *at, "A system has one axiom.")
            self.axiom = record
        elif kind == "constant":
            self.constants.append(replace(record, at=at))
        elif kind == "production":
            self.sections[self.section].append(replace(record, at=at))
            if len(self.sections[self.section]) > current().rules:
                raise ModelLimitError(f"The model has more than {current().rules:,} productions", limit=current().rules,
                                      source=self.source, start=at[0])
        elif kind == "section":
            self.section = record
        elif kind == "meta":
            self.meta.append(replace(record, at=at))
        elif kind == "more":
            self.more.append((*record, at))
        else:
            self._set(kind, record, at)

    def _set(self, kind: str, record: Any, at: tuple[int, int]) -> None:
        """Take in a setting."""
        if kind in ("ignore", "consider") and {"ignore", "consider"} & self.settings.keys() - {kind}:
            raise ModelSyntaxError('Both "ignore:" and "consider:" stand here', self.source, *at,
                                   "Say either what contexts pass over, or what they do not pass over.")
        if kind in self.settings:
            raise ModelSyntaxError(f'"{kind}:" stands here a second time', self.source, *at, "A system has one of it.")
        self.settings[kind] = record


def build_system(draft: Draft) -> LSystem:
    """The system of a draft, checked."""
    source, names = draft.source, [constant.name for constant in draft.constants]
    check_constants(draft.constants, source)
    if draft.axiom is None:
        raise ModelSyntaxError("There is no axiom", source, len(source), None,
                               'Give the first word on a line of its own, as in "axiom: A".')
    check_word(draft.axiom, names, source)
    for section, productions in draft.sections.items():
        for production in productions:
            check_production(production, names, source, section)
    for rule in draft.meta:
        check_meta(rule, names, source)
    sections = {section: tuple(productions) for section, productions in draft.sections.items()}
    return LSystem(draft.axiom, constants=tuple(draft.constants), meta=tuple(draft.meta), notation=draft.notation,
                   source=source, notes=tuple(draft.notes), **sections, **_settings(draft))  # type: ignore[arg-type]


def _settings(draft: Draft) -> dict[str, Any]:
    """What is set, as a system has it."""
    result: dict[str, Any] = {"turtle": draft.turtle}
    for name, setting in draft.settings.items():
        if name in _ROWS or name in _PLAIN:
            result[_ROWS.get(name, name)] = setting
            continue
        used = sorted(names_in(setting) & {constant.name for constant in draft.constants})
        if used:
            raise ModelNameError(f'The constant "{used[0]}" cannot be used here', draft.source, *span(setting),
                                 f'"{name}:" is set to a number.')
        check_expression(setting, (), draft.source)
        result[name] = value_of(setting, draft.source)
        if name in _COUNTED and not (isinstance(result[name], int) and result[name] >= 0):
            counted = _COUNTED[name]
            raise ModelValueError(f'"{setting}" is no number of {counted}', draft.source, *span(setting),
                                  f"{counted.capitalize()} are counted from 0: 0, 1, 2, ...")
        if name == "seed" and not isinstance(result[name], int):
            raise ModelValueError(f'"{setting}" is no seed', draft.source, *span(setting), "A seed is a whole number.")
    return result
