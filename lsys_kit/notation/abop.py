"""The kit's own notation, after The Algorithmic Beauty of Plants; its grammar is `abop.lark`."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from lark import Transformer
from lark.visitors import merge_transformers

from lsys_kit.notation.draft import Draft, assembled
from lsys_kit.notation.glued import unglued
from lsys_kit.notation.layout import first_lacking, sections, settings
from lsys_kit.notation.model import LSystem, Production, joined
from lsys_kit.notation.records import Expressions, Statements
from lsys_kit.notation.slips import QUESTIONS
from lsys_kit.notation.statements import statements
from lsys_kit.notation.tradition import Notation


def _records() -> Transformer[Any, Any]:
    return merge_transformers(Statements(), expressions=Expressions())  # type: ignore[no-untyped-call,no-any-return]


def _finish(draft: Draft) -> LSystem:
    """The system with letters that were written together parted, and a note that says so."""
    system = assembled(draft)
    notes: dict[str, None] = {}

    def part(word: tuple[Any, ...]) -> tuple[Any, ...]:
        parted, said = unglued(word, system)
        notes.update(dict.fromkeys(said))
        return parted

    def parted_rules(rules: tuple[Production, ...]) -> tuple[Production, ...]:
        return tuple(replace(rule, left=part(rule.left), right=part(rule.right), successor=part(rule.successor))
                     for rule in rules)

    return replace(system, axiom=part(system.axiom), productions=parted_rules(system.productions),
                   decomposition=parted_rules(system.decomposition), interpretation=parted_rules(system.interpretation),
                   meta=tuple(replace(rule, successor=part(rule.successor)) for rule in system.meta),
                   notes=(*system.notes, *notes))


def _write(system: LSystem) -> str:
    return "\n".join([*map(str, system.constants), *settings(system), f"axiom: {joined(map(str, system.axiom))}",
                      *sections(system, str)])


ABOP = Notation(
    name="abop", statements=statements, records=_records, finish=_finish, questions=QUESTIONS, module=str, joined=joined,
    write=_write, lacking=lambda system: first_lacking(system, "round brackets as branches"), likely=lambda text: 1)
