"""GROGRA's notation (Kurth; seed 003): rules parted by commas, the turtle's numbers glued on; the grammar is `grammar.lark`.

Its turtle: positive angles turn to the right on the screen, and `L*0.6`, `D+3` change what is set. What only GROGRA's
slides spell so (arrows, comparisons in TeX, "Startwort") is read with a note.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace

from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError
from lsys_kit.notation.analysis.checks import span
from lsys_kit.notation.dialects.grogra.actions import RELATIONS, statements, transformer
from lsys_kit.notation.dialects.grogra.diagnostics import DIAGNOSTICS
from lsys_kit.notation.dialects.grogra.probabilities import complete_probabilities
from lsys_kit.notation.dialects.grogra.spelling import SPELLING
from lsys_kit.notation.dialects.grogra.variables import Scope, Variable, check_variables, resolve, resolve_items, resolve_rule
from lsys_kit.notation.dialects.grogra.writer import START, joined_word, missing_feature, module_text, system_text
from lsys_kit.notation.model.expressions import Expression, Name, Number, names_in
from lsys_kit.notation.model.modules import Item, Pattern, Repeat
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.syntax.builder import Draft, build_system
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.syntax.parser import parse
from lsys_kit.notation.syntax.statements import without_comments
from lsys_kit.notation.syntax.wording import reporting

_SLIDE_SPELLINGS = {"→": "#", "⟶": "#", "\\rightarrow": "#", "\\longrightarrow": "#", "Startwort": "\\axiom",
              **{tex: sign for tex, sign in RELATIONS.items() if tex != "="}}
"""How the slides spell what GROGRA writes otherwise."""
_SPELT = re.compile(r"[→⟶]|\\[A-Za-z]+|\bStartwort\b")
_ARROW = r"(?:##?|->|→|\\rightarrow)"
_MARKS = re.compile(
    r"^[ \t]*\\(?:angle|axiom|var|const|set|length)\b(?![^,\n]{0,200}(?:->|→))"      # a line that begins with a backslash
    rf"|^[ \t]*\*[ \t]*{_ARROW}"                                                     # the rule for the start symbol
    rf"|^[ \t]*\([^()\n]{{1,80}}\)[ \t]*[A-Za-z*][^:\n#>→]{{0,80}}{_ARROW}"           # a condition in front
    r"|^[ \t]*[A-Za-z]\w{0,30}'*(?:\([^()\n]{1,80}\))?[ \t]+##?[ \t]"                # "#" as an arrow
    rf"|{_ARROW}[^\n]{{0,200}}&[ \t]*(?:\d+|\w+|\([^()\n]{{1,80}}\))[ \t]*<"          # what is repeated
    r"|\?[ \t]*\d*\.\d+[ \t]*(?:,|$)"                                                # a probability
    r"|(?<![\w'.(,*/+-])R[ULHV]-?\d", re.MULTILINE)
"""What only texts in this notation have."""


def _finish(draft: Draft) -> LSystem:
    """The system, once variables are replaced, the axiom is found, and chance is whole."""
    notes = _complete(draft)
    _check_constants(draft)
    variables = [replace(record, at=record.at or at) for kind, record, at in draft.deferred if kind == "variable"]
    _default_axiom(draft, notes)
    _replace_variables(draft, variables)
    system, read_as = with_ones(build_system(draft))
    productions, said = complete_probabilities(system)
    notes = [*_spelt(draft.source), *notes, *read_as, *said]
    return replace(system, productions=productions, notes=tuple(dict.fromkeys(notes)))


def _complete(draft: Draft) -> list[str]:
    """Take in the settings and the rules of the interpretation; notes on them."""
    notes = []
    for kind, record, at in draft.deferred:
        if kind == "axiom":
            word, steps = record
            draft.add("axiom", word, at)
            if steps is not None:
                _set(draft, at, "steps", Number(steps))
        elif kind == "setting":
            _set(draft, at, *record)
        elif kind == "interpretation":
            draft.sections["interpretation"].append(replace(record, at=at))
        elif kind == "note":
            notes.append(record)
    return notes


def _set(draft: Draft, at: tuple[int, int], name: str, value: object) -> None:
    """Take in a setting: a number, or a row of names."""
    if name in draft.settings:
        raise ModelSyntaxError(f"The {name} is set a second time", draft.source, *at, "Keep one of the two lines.")
    if isinstance(value, Expression) and names_in(value):
        raise ModelNameError(f'The name "{sorted(names_in(value))[0]}" cannot be used here', draft.source, *span(value),
                             f"The {name} is set to a number.")
    draft.settings[name] = value


def _default_axiom(draft: Draft, notes: list[str]) -> None:
    """Without an axiom the word begins with "*", or, where no rule is for it, with the first rule's left side."""
    rules = [rule for section in draft.sections.values() for rule in section]
    if draft.axiom is not None:
        return
    if not rules:
        raise ModelSyntaxError("There is no axiom and no rule", draft.source, len(draft.source), None,
                               'Give the first word, as in "\\axiom a,".')
    draft.axiom = START
    if all(rule.predecessor.symbol != "*" for rule in rules):
        first = rules[0].predecessor
        draft.axiom = (replace(first, arguments=tuple(a if isinstance(a, Number) else Number(0) for a in first.arguments)),)
        notes.append(f'No rule is for "*": the axiom is {module_text(draft.axiom[0])}, as in the first rule; '
                     'type "\\axiom ...," for another.')


def _check_constants(draft: Draft) -> None:
    """Constants have names of their own, and use only those before them."""
    known: set[str] = set()
    for constant in draft.constants:
        for expression in (constant.value, *(constant.range or ())):
            resolve(expression, Scope(draft.source, frozenset(known), {}))
        known.add(constant.name)


def _replace_variables(draft: Draft, variables: list[Variable]) -> None:
    """Put what the variables mean in their place, in all rules and the axiom."""
    constants = [constant.name for constant in draft.constants]
    check_variables(variables, constants, draft.source)
    scope = Scope(draft.source, frozenset(constants), {variable.name: variable for variable in variables})
    draft.axiom = resolve_items(draft.axiom or (), scope)  # type: ignore[assignment]
    for section, rules in draft.sections.items():
        draft.sections[section] = [resolve_rule(rule, scope, section == "productions") for rule in rules]


def _spelt(source: str) -> Iterator[str]:
    """Notes on what the slides spell otherwise."""
    found = dict.fromkeys(_SPELT.findall(without_comments(source)))
    pairs = [f'"{word}" as "{_SLIDE_SPELLINGS[word]}"' for word in found if word in _SLIDE_SPELLINGS]
    if pairs:
        yield f"Read as in GROGRA: {', '.join(pairs)}."
    if "\\dots" in found:
        yield '"\\dots" stands for what is not printed: it is left out.'


def with_ones(system: LSystem) -> tuple[LSystem, list[str]]:
    """A system whose symbols that end in "l" are read with "1" where only that is a symbol of the rules, and notes on it.

    Print does not tell the two apart: seed 003 has `ul` where `u1` is meant.
    """
    rewritten = {rule.predecessor.symbol for rule in system.rules}
    symbols = dict.fromkeys(module.symbol for module in system.modules)
    ones = {symbol: _one(symbol) for symbol in symbols
            if symbol not in rewritten and _one(symbol) in symbols and _one(symbol) != symbol}
    if not ones:
        return system, []

    def module(m: Pattern) -> Pattern:
        return replace(m, symbol=ones.get(m.symbol, m.symbol))

    def word(items: Iterable[Item]) -> tuple[Item, ...]:
        return tuple(replace(i, body=word(i.body)) if isinstance(i, Repeat) else module(i) for i in items)

    def rule(r: Production) -> Production:
        return replace(r, left=tuple(map(module, r.left)), right=tuple(map(module, r.right)), successor=word(r.successor))

    read = replace(system, axiom=tuple(map(module, system.axiom)), productions=tuple(map(rule, system.productions)),
                   interpretation=tuple(map(rule, system.interpretation)))
    return read, [f'"{symbol}" is read as "{one}".' for symbol, one in ones.items()]


def _one(symbol: str) -> str:
    """A name with its last letter "l" as the digit; built-in commands such as Ll stay."""
    return symbol if re.fullmatch(r"[FfLDNPVCHU]l", symbol) else re.sub(r"l('*)$", r"1\1", symbol)


def _lacking(system: LSystem) -> str | None:
    """The first thing that a system has and the notation lacks, in words."""
    with reporting(system.source, SPELLING):
        missing = missing_feature(system)
    if missing:
        return missing
    for symbol, count in dict.fromkeys((module.symbol, len(module.arguments)) for module in system.modules):
        if not _reads_back(Pattern(symbol, (Name("t"),) * count)):
            return f'symbol "{symbol}"' + (f" with {count} values" if count else "")
    changed = with_ones(system)[1]
    return f"such difference between 1 and l ({changed[0][:-1]})" if changed else None


def _reads_back(module: Pattern) -> bool:
    text = module_text(module)
    try:
        return bool(parse(GROGRA, "word", text, 0, len(text)) == (module,))
    except LSystemError:
        return False


GROGRA = Dialect(
    name="grogra", statements=statements, transformer=transformer, finish=_finish, diagnostics=DIAGNOSTICS, module=module_text,
    joined=joined_word, write=system_text, lacking=_lacking, likely=lambda text: 2 * len(_MARKS.findall(text)), turtle="grogra",
    spelling=SPELLING)
