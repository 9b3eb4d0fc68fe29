"""Text to records: a system, a word or an expression, read in one of the notations.

A text is cut into statements, each is parsed by the grammar of its notation, and the records are checked. The grammars stand
beside this file: `abop.lark`, `plant_string.lark`, and `expressions.lark`, which they share.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

from lark import Lark, TextSlice
from lark.exceptions import UnexpectedInput
from lark.visitors import merge_transformers

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.arithmetic import Value
from lsys_kit.notation.checks import check_constants, check_expression, check_meta, check_production, check_word, span, value_of
from lsys_kit.notation.expressions import Expression, names_in
from lsys_kit.notation.foresight import check_decomposition, idle
from lsys_kit.notation.glued import unglued
from lsys_kit.notation.model import Constant, LSystem, MetaRule, Module, Production, flat
from lsys_kit.notation.records import Expressions, Misread, Statements
from lsys_kit.notation.slips import explained
from lsys_kit.notation.statements import statements
from lsys_kit.notation.write import known


def read(text: str, notation: str | None = None) -> LSystem:
    """Read a system.

    Parameters
    ----------
    text
        The model: constants, axiom, productions, one a line. `/* ... */` is a comment.
    notation
        "abop" (the default) or "plant-string".

    Raises
    ------
    ModelSyntaxError, ModelNameError, ModelValueError
        The text makes no sense; the error has the place and a hint.
    ModelLimitError
        The text is too long.

    Examples
    --------
    >>> system = read('''
    ...     axiom: ar
    ...     ar -> al br
    ...     al -> bl ar
    ...     br -> ar
    ...     bl -> al''')
    >>> print(system.productions[0])
    ar -> al br
    """
    if not isinstance(text, str):
        raise ModelValueError(f"A model is read from text, not from {type(text).__name__}")
    if len(text) > current().text:
        raise ModelLimitError(f"The text has {len(text):,} characters; the limit is {current().text:,}",
                              limit=current().text, needed=len(text))
    notation = known(notation or "abop")
    draft = _Draft(text)
    for number, (start, end) in enumerate(statements(text)):
        if number >= 2 * current().rules:
            raise ModelLimitError(f"The model has more than {2 * current().rules:,} lines that say something",
                                  limit=2 * current().rules, source=text, start=start)
        kind, record = _parse(notation, "statement", text, start, end)
        draft.add(kind, record, (start, end))
    return draft.system(notation)


def read_word(text: str, notation: str = "abop", system: LSystem | None = None) -> tuple[Module, ...]:
    """Read a word whose arguments are numbers; with a system, letters written together are parted as in its rules.

    >>> [str(module) for module in read_word("A(1/2)[B]")]
    ['A(0.5)', '[', 'B', ']']
    """
    if not text.strip() or text.strip() in ("ε", "*"):
        return ()
    word = _parse(known(notation), "word", text, 0, len(text))
    check_word(word, (), text)
    if system is not None and notation == "abop":
        word, _ = unglued(word, system)
    return tuple(replace(module, arguments=tuple(value_of(a, text) for a in module.arguments if isinstance(a, Expression)))
                 for module in flat(word))


def read_expression(text: str) -> Expression:
    """Read an expression; its names are checked by whoever knows them.

    >>> print(read_expression("2*(t+1)"))
    2 * (t + 1)
    """
    return _parse("abop", "expression", text, 0, len(text))  # type: ignore[no-any-return]


def read_number(text: str) -> Value:
    """Read a number, exactly; it may be written as a calculation.

    >>> read_number("14/10")
    Fraction(7, 5)
    """
    expression = read_expression(text)
    check_expression(expression, (), text)
    return value_of(expression, text)


_SYMBOLS = {"alphabet": "alphabet", "ignore": "ignored", "consider": "considered"}
"""The settings that are rows of symbols, and where a system has them."""


@dataclass
class _Draft:
    """What the statements read so far make of a system."""

    source: str
    axiom: tuple[Module, ...] | None = None
    constants: list[Constant] = field(default_factory=list)
    sections: dict[str, list[Production]] = field(
        default_factory=lambda: {"productions": [], "decomposition": [], "interpretation": []})
    meta: list[MetaRule] = field(default_factory=list)
    settings: dict[str, Any] = field(default_factory=dict)
    section: str = "productions"

    def add(self, kind: str, record: Any, at: tuple[int, int]) -> None:
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
        elif kind in ("ignore", "consider") and {"ignore", "consider"} & self.settings.keys() - {kind}:
            raise ModelSyntaxError('Both "ignore:" and "consider:" stand here', self.source, *at,
                                   "Say either what contexts pass over, or what they do not pass over.")
        elif kind in self.settings:
            raise ModelSyntaxError(f'"{kind}:" stands here a second time', self.source, *at, "A system has one of it.")
        else:
            self.settings[kind] = record

    def system(self, notation: str) -> LSystem:
        source, names = self.source, [constant.name for constant in self.constants]
        check_constants(self.constants, source)
        if self.axiom is None:
            raise ModelSyntaxError("There is no axiom", source, len(source), None,
                                   'Give the first word on a line of its own, as in "axiom: A".')
        check_word(self.axiom, names, source)
        for section, productions in self.sections.items():
            for production in productions:
                check_production(production, names, source, section)
        for rule in self.meta:
            check_meta(rule, names, source)
        sections = {section: tuple(productions) for section, productions in self.sections.items()}
        system = LSystem(self.axiom, constants=tuple(self.constants), meta=tuple(self.meta), notation=notation, source=source,
                         **sections, **self._settings())  # type: ignore[arg-type]
        system = _with_parted_names(system) if notation == "abop" else system
        check_decomposition(system)
        return replace(system, notes=(*system.notes, *idle(system)))

    def _settings(self) -> dict[str, Any]:
        result = {}
        for name, setting in self.settings.items():
            if name in _SYMBOLS:
                result[_SYMBOLS[name]] = setting
                continue
            used = sorted(names_in(setting) & {constant.name for constant in self.constants})
            if used:
                raise ModelNameError(f'The constant "{used[0]}" cannot be used here', self.source, *span(setting),
                                     f'"{name}:" is set to a number.')
            check_expression(setting, (), self.source)
            result[name] = value_of(setting, self.source)
            if name in ("steps", "depth") and not (isinstance(result[name], int) and result[name] >= 0):
                counted = "steps" if name == "steps" else "rounds"
                raise ModelValueError(f'"{setting}" is no number of {counted}', self.source, *span(setting),
                                      f"{counted.capitalize()} are counted from 0: 0, 1, 2, ...")
        return result


def _with_parted_names(system: LSystem) -> LSystem:
    """The system with letters that were written together parted, and a note that says so."""
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
                   meta=tuple(replace(rule, successor=part(rule.successor)) for rule in system.meta), notes=tuple(notes))


def _parse(notation: str, rule: str, text: str, start: int, end: int) -> Any:
    if end - start > current().line:
        raise ModelLimitError(f"This line has {end - start:,} characters; the limit is {current().line:,}",
                              limit=current().line, needed=end - start, source=text, start=start)
    try:
        return _parser(notation).parse(TextSlice(text, start, end), start=rule)
    except UnexpectedInput as slip:
        raise explained(slip, text, start, end) from None
    except Misread as misread:
        raise misread.kind(misread.message, text, *(misread.at or (None, None)), misread.hint) from None


@cache
def _parser(notation: str) -> Lark:
    rules = ["statement", "word"] + (["expression"] if notation == "abop" else [])
    merged = merge_transformers(Statements(), expressions=Expressions())  # type: ignore[no-untyped-call]
    return Lark.open(f"{notation.replace('-', '_')}.lark", rel_to=__file__, parser="lalr", start=rules,
                     maybe_placeholders=False, transformer=merged)
