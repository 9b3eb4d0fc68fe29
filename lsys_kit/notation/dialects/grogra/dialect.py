"""GROGRA's notation (Kurth): rules separated by commas, numbers glued to turtle commands; the grammar is `grammar.lark`.

Its turtle: positive angles turn to the right on the screen, and `L*0.6`, `D+3` change what is set. Spellings
that occur only on Kurth's slides (arrows, comparisons in TeX, "Startwort") are read with a note.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from lark import Token, v_args

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.dialects.grogra.probabilities import complete_probabilities
from lsys_kit.notation.dialects.grogra.variables import Scope, Variable, check_variables, resolve, resolve_items, resolve_rule
from lsys_kit.notation.dialects.grogra.writer import (
    START,
    expression_text,
    joined_word,
    missing_feature,
    module_text,
    system_text,
)
from lsys_kit.notation.model.expressions import OPERATORS, Expression, Name, Number, names_in
from lsys_kit.notation.model.modules import ItemT, Pattern, flat, rewritten
from lsys_kit.notation.model.system import Constant, LSystem, Production
from lsys_kit.notation.syntax.actions import Expressions, Part, Statement, Statements, place_of, transformer
from lsys_kit.notation.syntax.builder import Draft, build_system
from lsys_kit.notation.syntax.diagnostics import compiled
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.syntax.failure import ParseFailure, unclosed_bracket
from lsys_kit.notation.syntax.text.statements import without_comments
from lsys_kit.notation.syntax.text.transcript import edited
from lsys_kit.notation.syntax.text.typesetting import formula_signs
from lsys_kit.notation.syntax.wording import Spelling, reporting

RELATIONS = {"=": "==", "\\leq": "<=", "\\le": "<=", "\\geq": ">=", "\\ge": ">=", "\\neq": "!=", "\\ne": "!="}
"""How GROGRA or Kurth's slides spell comparisons."""
_GLUED = re.compile(r"([^\d.-]+)(-?)([\d.]+)")
_SEPARATORS = re.compile(r"[()]|,[,\s]*|^[ \t]*Startwort[ \t]+[A-Za-z*](?![^\n]*(?:#|->|→|\\rightarrow))", re.MULTILINE)
BLANKS = "\ufeff \t\r\n\u00a0"
"""Characters between statements that mean nothing."""


def statements(text: str) -> Iterator[tuple[int, int]]:
    r"""The offsets of the statements, which are separated by commas outside of parentheses.

    >>> text = "* # F a(1, 2),\n\na(x, y) # F,"
    >>> [text[start:end] for start, end in statements(text)]
    ['* # F a(1, 2)', 'a(x, y) # F']
    """
    text = without_comments(text)
    if (closed := text.find("*/")) >= 0:
        raise problem("comment closed", (closed, closed + 2))
    depth = start = 0
    for part in _SEPARATORS.finditer(text):
        if part.group() in "()":
            depth = max(0, depth + (1 if part.group() == "(" else -1))
        elif depth == 0 or part.group()[0] != ",":
            yield from _stripped(text, start, part.start())
            start, depth = part.end() if part.group()[0] == "," else part.start(), 0
    yield from _stripped(text, start, len(text))


def _stripped(text: str, start: int, end: int) -> Iterator[tuple[int, int]]:
    """The offsets without the blanks around; nothing where there is nothing else."""
    stretch = text[start:end]
    if stretch.strip(BLANKS):
        yield start + len(stretch) - len(stretch.lstrip(BLANKS)), start + len(stretch.rstrip(BLANKS))


@v_args(inline=True)
class _GrograExpressions(Expressions):
    """GROGRA's comparisons, and functions that the text declares."""

    def binary(self, left: Expression, sign: Token, right: Expression) -> Expression:
        return super().binary(left, sign.update(value=RELATIONS.get(sign, str(sign))), right)

    def call(self, name: Token, *operands: Expression) -> Expression:
        operator = OPERATORS.get(name)
        at = name.start_pos or 0, name.end_pos or 0
        if operator is not None and operator.random:
            raise problem("random number in rule", at, name=name)
        if operator is not None and operator.precedence is None and name != "sensed":
            return super().call(name, *operands)
        return self._applied("sensed", (Name(str(name), at), *operands), at)  # the text's own; its name is looked up later


@v_args(inline=True)
class _GrograStatements(_GrograExpressions, Statements):
    def glued(self, token: Token) -> Pattern:
        """A command with its number: in `L*0.6` the symbol is `L*`."""
        symbol, sign, number = (_subtoken(token, *match) for match in _command_parts(token))
        value = self.number(number)
        return self.module(symbol, self.unary(sign, value) if sign else value)

    def axiom(self, _: Token, word: tuple[Pattern, ...], *steps: Token) -> Statement:
        ends = [int(end) for end in steps[0].split("-")] if steps else []
        if ends and ends[0] > ends[-1]:
            raise problem("steps backwards", place_of(steps[0]), steps=steps[0])
        return "deferred", ("axiom", (word, ends[-1] if ends else None))

    def setting(self, keyword: Token, value: Expression) -> Statement:
        return "deferred", ("setting", (keyword.split()[-1].lstrip("\\"), value))

    def turtle(self, _: Token, tradition: Token) -> Statement:
        return "deferred", ("setting", ("turtle", str(tradition)))

    def look(self, token: Token) -> Statement:
        return "deferred", ("setting", super().look(token))

    def unused(self, token: Token) -> Statement:
        return "deferred", ("note", f'"{" ".join(token.split())}" has no meaning here.')

    def constant(self, name: Token, *rest: Part) -> tuple[str, Constant]:
        return super().constant(*rest)  # the first token is "\\const"

    def variable(self, _: Token, name: Token, kind: Token, *values: Expression) -> Statement:
        self.name(name)
        return "deferred", ("variable", Variable(str(name), str(kind), values, (kind.start_pos or 0, kind.end_pos or 0)))

    def production(self, *parts: object) -> Statement:
        return "production", _production_of(parts)

    def interpretation(self, *parts: object) -> Statement:
        return "deferred", ("interpretation", _production_of(parts))


def _command_parts(token: Token) -> list[tuple[str, int]]:
    """The symbol, the sign and the number of a command, each with its offset in it."""
    match = _GLUED.fullmatch(token)
    return [(match[i], match.start(i)) for i in (1, 2, 3)] if match else []


def _subtoken(token: Token, text: str, offset: int) -> Token:
    start = (token.start_pos or 0) + offset
    return Token(token.type, text, start_pos=start, end_pos=start + len(text))


def _production_of(parts: tuple[object, ...]) -> Production:
    """A rule, whose successor may be nothing at all."""
    predecessor = next(part for part in parts if isinstance(part, Pattern))
    named = {part[0]: part[1] for part in parts if isinstance(part, tuple) and part and isinstance(part[0], str)}
    successor = next((part for part in parts if isinstance(part, tuple) and not (part and isinstance(part[0], str))), ())
    return Production((predecessor,), successor, **named)


_SLIDE_SPELLINGS = {
    "→": "#",
    "⟶": "#",
    "\\rightarrow": "#",
    "\\longrightarrow": "#",
    "Startwort": "\\axiom",
    **{tex: sign for tex, sign in RELATIONS.items() if tex != "="},
}
"""How the slides spell words of GROGRA."""
_SPELT = re.compile(r"[→⟶]|\\[A-Za-z]+|\bStartwort\b")
_ARROW = r"(?:##?|->|→|\\rightarrow)"
_MARKS = re.compile(
    r"^[ \t]*\\(?:angle|axiom|var|const|set|length)\b(?![^,\n]{0,200}(?:->|→))"  # a line that begins with a backslash
    rf"|^[ \t]*\*[ \t]*{_ARROW}"  # the rule for the start symbol
    rf"|^[ \t]*\((?![ \t]*\d{{1,3}}[ \t]*\))[^()\n]{{1,80}}\)[ \t]*[A-Za-z*][^:\n#>→]{{0,80}}{_ARROW}"  # a condition in front
    r"|^[ \t]*[A-Za-z]\w{0,30}'*(?:\([^()\n]{1,80}\))?[ \t]+##?[ \t]"  # "#" as an arrow
    rf"|{_ARROW}[^&#→\n]{{0,200}}&[ \t]*(?:\d+|\w+|\([^()\n]{{1,80}}\))[ \t]*<"  # what is repeated
    r"|\?[ \t]*\d*\.\d+[ \t]*(?:,|$)"  # a probability
    r"|(?<![\w'.(,*/+-])R[ULHV]-?\d",
    re.MULTILINE,
)
"""What only texts in this notation have."""


def _finish(draft: Draft) -> LSystem:
    """The system, with variables replaced, an axiom, and probabilities that add up to 1."""
    notes = _resolve_deferred(draft)
    _check_constants(draft)
    variables = [replace(record, at=record.at or at) for kind, record, at in draft.deferred if kind == "variable"]
    _default_axiom(draft, notes)
    _replace_variables(draft, variables)
    system, read_as = with_ones(build_system(draft))
    productions, completed = complete_probabilities(system)
    notes = [*_spelling_notes(draft.source), *notes, *read_as, *completed]
    return replace(system, productions=productions, notes=tuple(dict.fromkeys(notes)))


def _resolve_deferred(draft: Draft) -> list[str]:
    """Take in the settings and the rules of the interpretation; notes on them."""
    notes = []
    for kind, record, at in draft.deferred:
        if kind == "axiom":
            word, steps = record
            draft.add("axiom", word, at)
            if steps is not None:
                _add_setting(draft, at, "steps", Number(steps))
        elif kind == "setting":
            _add_setting(draft, at, *record)
        elif kind == "interpretation":
            draft.sections["interpretation"].append(replace(record, at=at))
        elif kind == "note":
            notes.append(record)
    return notes


def _add_setting(draft: Draft, at: tuple[int, int], name: str, value: object) -> None:
    draft.add(name, value, at)
    if isinstance(value, Expression) and names_in(value):
        raise problem("name in setting", value.at, name=min(names_in(value)), keyword=name)


def _default_axiom(draft: Draft, notes: list[str]) -> None:
    """Without an axiom the first word is "*", or, where no rule is for it, the left side of the first rule."""
    rules = [rule for section in draft.sections.values() for rule in section]
    if draft.axiom is not None:
        return
    if not rules:
        raise problem("no axiom and no rule", (len(draft.source), len(draft.source)))
    draft.axiom = START
    if all(rule.predecessor.symbol != "*" for rule in rules):
        first = rules[0].predecessor
        draft.axiom = (replace(first, arguments=tuple(a if isinstance(a, Number) else Number(0) for a in first.arguments)),)
        notes.append(
            f'No rule is for "*": the axiom is {module_text(draft.axiom[0])}, as in the first rule; '
            'type "\\axiom ...," for another.'
        )


def _check_constants(draft: Draft) -> None:
    """Constants use only those before them."""
    known: set[str] = set()
    for constant in draft.constants:
        for expression in (constant.value, *(constant.range or ())):
            resolve(expression, Scope(frozenset(known), {}))
        known.add(constant.name)


def _replace_variables(draft: Draft, variables: list[Variable]) -> None:
    """Replace the variables in all rules and in the axiom by what they mean."""
    constants = [constant.name for constant in draft.constants]
    check_variables(variables, constants)
    scope = Scope(frozenset(constants), {variable.name: variable for variable in variables})
    draft.axiom = tuple(flat(resolve_items(draft.axiom or (), scope)))
    for section, rules in draft.sections.items():
        draft.sections[section] = [resolve_rule(rule, scope, section == "productions") for rule in rules]


def _spelling_notes(source: str) -> Iterator[str]:
    found = dict.fromkeys(_SPELT.findall(without_comments(source)))
    pairs = [f'"{word}" as "{_SLIDE_SPELLINGS[word]}"' for word in found if word in _SLIDE_SPELLINGS]
    if pairs:
        yield f"Read as in GROGRA: {', '.join(pairs)}."
    if "\\dots" in found:
        yield '"\\dots" marks something that is not printed: it is left out.'


def with_ones(system: LSystem) -> tuple[LSystem, list[str]]:
    """A system whose symbols that end in "l" are read with "1" where only that is a symbol of the rules, and notes on it.

    Print does not distinguish the two: Kurth's slides have `ul` where `u1` is meant.
    """
    heads = {rule.predecessor.symbol for rule in system.rules}
    symbols = dict.fromkeys(module.symbol for module in system.modules)
    ones = {
        symbol: _one(symbol) for symbol in symbols if symbol not in heads and _one(symbol) in symbols and _one(symbol) != symbol
    }
    if not ones:
        return system, []

    def word(items: Iterable[ItemT]) -> tuple[ItemT, ...]:
        return rewritten(items, lambda m: (replace(m, symbol=ones.get(m.symbol, m.symbol)),), lambda count: count)

    def rule(r: Production) -> Production:
        return replace(r, left=word(r.left), right=word(r.right), successor=word(r.successor))

    read = replace(
        system,
        axiom=word(system.axiom),
        productions=tuple(map(rule, system.productions)),
        interpretation=tuple(map(rule, system.interpretation)),
    )
    return read, [f'"{symbol}" is read as "{one}".' for symbol, one in ones.items()]


def _one(symbol: str) -> str:
    """A name with its last letter "l" as the digit; built-in commands such as Ll stay."""
    return symbol if re.fullmatch(r"[FfLDNPVCHU]l", symbol) else re.sub(r"l('*)$", r"1\1", symbol)


def _lacking(system: LSystem) -> str | None:
    with reporting(system.source, GROGRA.spelling):
        missing = missing_feature(system)
    if missing:
        return missing
    changed = with_ones(system)[1]
    return f"such difference between 1 and l ({changed[0][:-1]})" if changed else None


def _comma(failure: ParseFailure) -> ModelSyntaxError | None:
    """Two statements, without a comma between them; a number with a comma in it."""
    arrow = compiled("ARROW", failure.spelling)
    if re.match(r"\d+$", failure.statement) and re.search(r"\d,$", failure.text[: failure.start]):
        return failure.error("A number is typed with a point", 'Type "0.5", not "0,5".', failure.start - 1, 1)
    line = failure.text.rfind("\n", failure.start, failure.at) + 1
    begins = line + len(failure.text[line : failure.end]) - len(failure.text[line : failure.end].lstrip())
    first = arrow.search(failure.before)
    if line <= failure.start or unclosed_bracket(failure.text[failure.start : begins]) is not None:
        return None
    new = begins == failure.at and ("$END" in failure.accepted or failure.found.startswith("\\"))
    later = failure.before.startswith("\\") or (first is not None and first.end() < line - failure.start)
    if not (new or (later and arrow.match(failure.found))):
        return None
    end = failure.start + len(failure.text[failure.start : begins].rstrip())
    if failure.text[end - 1] == ";":
        return failure.error('This ";" does not separate rules', failure.spelling.words["apart"], end - 1, 1)
    return failure.error('A "," is missing here', failure.spelling.words["apart"], end, 1)


GROGRA = Dialect(
    name="grogra",
    statements=statements,
    transformer=transformer(_GrograStatements, _GrograExpressions),
    finish=_finish,
    diagnostics=(
        "foreign_comment",
        "no_predecessor",
        _comma,
        "directive",
        "comparison",
        "predecessor",
        "repeat",
        "repetition",
        "own_misspelling",
        "misspelling",
        "other_notation",
        "parentheses",
        "arrow",
        "second_arrow",
        "unreadable_character",
        "missing_value",
        "missing_operator",
        "stray_number",
        "tex_macro",
    ),
    module=module_text,
    joined=joined_word,
    write=system_text,
    lacks=(
        "round brackets as branches",
        "predecessors of several modules",
        "decomposition rules",
        "meta-rules",
        "ignored symbols",
        "right contexts that name the next branch",
        "right contexts that pass over brackets",
        "field",
    ),
    missing_feature=_lacking,
    likely=lambda text: 2 * len(_MARKS.findall(text)),
    turtle="grogra",
    spelling=Spelling(Path(__file__).parent, expression=expression_text, module=module_text, joined=joined_word),
    transcribe=lambda source: edited(source, formula_signs(source)),
)
