"""cpfg's notation (Prusinkiewicz), the language of the Virtual Laboratory; its grammar is `grammar.lark`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from heapq import merge
from itertools import chain
from pathlib import Path
from string import ascii_uppercase

from lsys_kit.notation.analysis.checks import SETTINGS, check_constants, check_expression, value_of
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.dialects.cpfg.actions import SILENT, CpfgStatements
from lsys_kit.notation.dialects.cpfg.expressions import expression_text
from lsys_kit.notation.dialects.cpfg.preprocessor import preprocessed
from lsys_kit.notation.dialects.cpfg.variables import (
    Block,
    Counters,
    Variables,
    check_changing,
    substitute,
    variables_of,
    with_counters,
)
from lsys_kit.notation.dialects.cpfg.writer import joined_word, missing_feature, module_text, system_text
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import OPERATORS, Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Pattern, flat
from lsys_kit.notation.model.system import FLAT, NEXT_BRANCH, LSystem, Production
from lsys_kit.notation.syntax.builder import Draft, build_system, check_colons
from lsys_kit.notation.syntax.diagnostics import DIAGNOSTICS
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.syntax.parser import parse
from lsys_kit.notation.syntax.text.statements import ARROW, LABEL, blank_parentheses, without_comments
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, edited
from lsys_kit.notation.syntax.wording import Spelling

KEPT = re.compile(
    r"^[ \t]*/\*[ \t]*((?:angle|heading|length):[ \t]*-?\d[\d.]*(?:e[+-]?\d+)?(?:/\d+)?"
    r"|cells:[ \t]*(?:ellipses|rectangles)|widths:[ \t]*(?:pixels|units)|colours:[ \t]*(?:natural|symbols))[ \t]*\*/[ \t]*$",
    re.MULTILINE,
)
"""A comment in which a text keeps what cpfg has in other files: `/* angle: 25.7 */`, alone on its line."""
_RANGED = re.compile(r"[ \t]*/\*[ \t]*-?[\d./]+[ \t]+\.\.[ \t]+-?[\d./]+([ \t]+by[ \t]+[\d./]+)?[ \t]*\*/")
"""A comment after a constant that gives the range of its slider."""
_KEYWORD = re.compile(
    r"#[ \t]*(define|undef|include|if\w*|el\w+|endif)\b"
    r"|(lsystem|derivation[ \t]*length|maximum[ \t]+depth|seed|ignore|consider|angle|heading|length|surface)[ \t]*:"
    r"|(productions?|decomposition|homomorphism|interpretation)\b(?![^\n]*[<>])|endlsystem\b",
    re.IGNORECASE,
)
_PHASE = re.compile(r"(start|end)[ \t]*+(each)?[ \t]*+:", re.IGNORECASE)
_AXIOM_START = re.compile(r"axiom[ \t]*:(?![^\n]*-->)", re.IGNORECASE)
_BEGIN = re.compile(r"lsystem[ \t]*:", re.IGNORECASE)
_END = re.compile(r"endlsystem\b", re.IGNORECASE)


@dataclass(frozen=True)
class _Line:
    """A line without its comments: where it begins and ends, apart from blanks, and how far it is indented."""

    start: int
    end: int
    text: str
    indent: int


def statements(text: str) -> Iterator[tuple[int, int]]:
    r"""The offsets of the statements.

    A production or an axiom continues on the lines below that are indented further; a line with an arrow of its own continues
    only a statement without one. Statements that run around the steps end with their braces. `//` begins a comment at the
    beginning of a line and after a setting or a condition; in a word it is two rolls.

    >>> text = "Axiom: F//F\nF : 1 // always\n    --> FF\n// the end"
    >>> [text[start:end] for start, end in statements(text)]
    ['Axiom: F//F', 'F : 1 // always\n    --> FF']
    """
    begun = ended = False
    for start, end in merge(_cut(text), (match.span(1) for match in KEPT.finditer(text))):
        begins = _BEGIN.match(text, start) is not None
        if begins and begun:
            raise problem("second system", (start, end))
        if ended:
            raise problem("after the end", (start, end))
        begun, ended = begun or begins, _END.match(text, start) is not None
        yield start, end


def _cut(text: str) -> Iterator[tuple[int, int]]:
    first: _Line | None = None
    end, has_arrow, depth = 0, False, 0
    for line in _nonblank_lines(text):
        inside = depth > 0
        if inside or _PHASE.match(line.text):
            depth = max(0, depth + line.text.count("{") - line.text.count("}"))
        if first is not None and not inside and not _continues(line, first, has_arrow):
            yield first.start, end
            first = None
        if line.text.startswith("//") and (first is None or line.text[2:3].isspace()):
            continue
        if first is None:
            first, has_arrow = line, _AXIOM_START.match(line.text) is not None
        end, has_arrow = line.end, has_arrow or ARROW.search(line.text) is not None
    if first is not None:
        yield first.start, end


def _continues(line: _Line, first: _Line, has_arrow: bool) -> bool:
    """Whether a line continues a statement that begins with another; an axiom counts as having its arrow."""
    if _KEYWORD.match(first.text) or _KEYWORD.match(line.text) or _AXIOM_START.match(line.text):
        return False
    if ARROW.match(line.text):
        return not _AXIOM_START.match(first.text)
    return line.indent > first.indent and not (has_arrow and ARROW.search(line.text))


def _nonblank_lines(text: str) -> Iterator[_Line]:
    """The lines that are not blank, without comments after settings."""
    for found in re.finditer(r"[^\n]+", without_comments(text)):
        line, content = found.group(), found.group().strip()
        if not content:
            continue
        blank = line[: len(line) - len(line.lstrip())]
        start = found.start() + len(blank)
        if _KEYWORD.match(content):
            content = content.split("//")[0].rstrip()
        ranged = _RANGED.match(text, start + len(content)) if content.startswith("#") else None
        yield _Line(start, ranged.end() if ranged else start + len(content), content, len(blank.expandtabs()))


_MARKS = re.compile(
    r"^[ \t]*(#[ \t]*define\b|(lsystem|derivation[ \t]+length|maximum[ \t]+depth)[ \t]*:|endlsystem\b|homomorphism\b)",
    re.MULTILINE | re.IGNORECASE,
)
_NUMBERED = re.compile(r"^[ \t]*Lsystem[ \t]*:", re.MULTILINE | re.IGNORECASE)
_LABEL = re.compile(rf"^[ \t]*+{LABEL}[ \t]*+:[ \t]*+(?=[^\n]*-->)", re.MULTILINE)
_TEXT = re.compile(r'@L\s*\(\s*"(?P<text>[^"\n]*)"\s*(?P<sign>[,)])')
"""A label that is drawn beside the turtle; its text may have values behind it."""
_AXIOM_MARK = re.compile(r"^[ \t]*Axiom[ \t]*:", re.MULTILINE)
_TURNS = frozenset("+-&^\\/")
_DEFINED = re.compile(r"^#[ \t]*define[ \t]+\w+[ \t]*")
_PROSE = re.compile(r"//[ \t]+[A-Za-z]{2}[^\n]*|(?://|(?<=[ \t])#)[ \t]*(?P<word>[a-z]{3,})[^\n]*")
"""What reads like a comment: two rolls and words, or a word of small letters after two rolls or a #."""


def _finish(draft: Draft) -> LSystem:
    _check_macros(draft)
    _resolve_deferred(draft)
    draft.notes += _notes(draft)
    check_colons(draft)
    return build_system(draft)


def _resolve_deferred(draft: Draft) -> None:
    """Take in what is known only when the whole text is read: the sections, and what the blocks of the rules compute."""
    section, variables = "productions", _variables(draft)
    constants = [constant.name for constant in draft.constants]
    spares, drawn = [*_spare_symbols(draft)], list[Production]()
    draft.settings["branches"] = NEXT_BRANCH
    for kind, record, at in sorted(draft.deferred, key=lambda deferred: deferred[0] == "passed"):
        if kind == "section":
            section = record
            draft.add(kind, record, at)
        elif kind == "rule":
            production, before, after = record
            spare = spares[0] if spares and section == "productions" else ""
            made, *decomposed = substitute(production, before, after, constants, spare)
            draft.add("production", made, at)
            for rule in decomposed:
                spares.remove(spare)
                drawn.append(replace(rule, at=at))
                draft.notes.append(f"{rule.predecessor} carries what is drawn once and used more than once.")
        elif kind == "passed":
            _resolve_passed(draft, record, at)
        elif kind == "count":
            keyword, expression = record
            _resolve_count(draft, section, keyword, expression, at)
    draft.sections["decomposition"] += drawn
    _carry_counters(draft, variables.counters)
    axiom = Production((Pattern("axiom"),), draft.axiom or ())
    check_changing((axiom, *(rule for rules in draft.sections.values() for rule in rules)), variables.changing)


def _spare_symbols(draft: Draft) -> Iterator[str]:
    """Capitals that no module has; none where decomposition ends at some depth, so that one more rule would count."""
    section = ""
    for kind, record, _ in draft.deferred:
        section = record if kind == "section" else section
        if kind == "count" and record[0] == "maximum depth" and section == "decomposition":
            return
    rules = [record[0] for kind, record, _ in draft.deferred if kind == "rule"]
    used = {module.symbol for module in chain(draft.axiom or (), *(rule.modules for rule in rules))}
    yield from (symbol for symbol in reversed(ascii_uppercase) if symbol not in used | {"F", "G"})


def _carry_counters(draft: Draft, counters: Counters) -> None:
    """Let modules carry the counters that their productions use, where they can."""
    sections = draft.sections
    carried = with_counters(
        draft.axiom or (), sections["productions"], sections["decomposition"], sections["interpretation"], counters
    )
    if carried is not None:
        draft.axiom, sections["productions"], sections["interpretation"], said = carried
        draft.notes.append(said)


def _variables(draft: Draft) -> Variables:
    """Take in what is computed around the steps."""
    phases: dict[str, list[Block]] = {}
    blocks: list[Block] = []
    for kind, record, _ in draft.deferred:
        if kind == "phase":
            phases.setdefault(record[0], []).append(record[1])
        elif kind == "rule":
            blocks += record[1:]
    found = variables_of(phases, blocks, [constant.name for constant in draft.constants])
    draft.constants += found.constants
    check_constants(draft.constants)
    if found.seed is not None and all(record[0] != "seed" for kind, record, _ in draft.deferred if kind == "count"):
        draft.deferred.append(("count", ("seed", found.seed), found.seed.at or (0, 0)))
    called = {name for name in SILENT if name in draft.source and re.search(rf"\b{name}[ \t]*\(", draft.source)}
    silent = sorted(called | {"End:" for phase in phases if phase == "end"})
    if silent:
        draft.notes.append(f"Left out, because it changes nothing in the model: {', '.join(silent)}.")
    return found


def _resolve_passed(draft: Draft, passed: tuple[str, tuple[str, ...], bool], at: tuple[int, int]) -> None:
    """Take in what contexts pass over, or what they see: right contexts pass over brackets that they are not to see."""
    keyword, symbols, brackets = passed
    draft.add(keyword, symbols, at)
    if brackets != (keyword == "ignore"):
        return
    draft.settings["branches"] = FLAT
    rules = draft.sections["productions"]
    words = (draft.axiom or (), *(flat(rule.successor) for rule in rules))
    if keyword == "consider" and any(rule.right for rule in rules) and any(module.symbol == "[" for module in chain(*words)):
        draft.notes.append(
            'Right contexts pass over brackets, as in cpfg, because "consider:" does not list them: they read '
            f'the word as if it were flat. To follow its branches, write "consider: {"".join(symbols)}[]".'
        )


def _resolve_count(draft: Draft, section: str, keyword: str, expression: Expression, at: tuple[int, int]) -> None:
    """Take in a number of steps or rounds, or a seed, which may be calculated from constants."""
    depths = {"decomposition": "decomposition_depth", "interpretation": "depth"}
    if keyword == "maximum depth" and section not in depths:
        raise problem("depth in no section", at)
    name = depths[section] if keyword == "maximum depth" else "seed" if keyword == "seed" else "steps"
    if name in draft.settings:
        raise problem("setting twice", at, keyword=keyword)
    values: dict[str, Value] = {}
    for constant in draft.constants:
        values[constant.name] = value_of(constant.value, values)
    check_expression(expression, values.keys())
    draft.add(name, Number(value_of(expression, values), expression.at), at)


def _check_macros(draft: Draft) -> None:
    """Each macro is a number, made of those before it."""
    names = [constant.name for constant in draft.constants]
    for index, constant in enumerate(draft.constants):
        value = constant.value
        if constant.name in SETTINGS:
            raise problem("macro as setting", constant.at, name=constant.name, other=constant.name.upper())
        if isinstance(value, Name) and value.name not in names[:index]:
            raise problem(
                "macro further down" if value.name in names else "macro of a name", value.at, value=value, name=constant.name
            )
    check_constants(draft.constants)


def _notes(draft: Draft) -> Iterator[str]:
    """Notes on what cpfg would read differently, or a person may have meant differently."""
    text = without_comments(draft.source)
    for constant in draft.constants:
        start, end = constant.at or (0, 0)
        value = _DEFINED.sub("", text[start:end]).strip()
        if constant.at and _infix(constant.value) and not _enclosed(value):
            yield f'The macro "{constant.name}" is a number here; cpfg puts its text in place: write "({value})".'
    for kind, record, _ in draft.deferred:
        if kind == "view surface":
            yield (
                f'The surface "~{record[0]}" is in the file "{record[1]}", which a model does not open: '
                f'with_surface(system, "{record[0]}", text) takes it out of its text.'
            )
    yield from _split_symbols(draft)
    words = [*chain(draft.axiom or (), *(flat(rule.successor) for rules in draft.sections.values() for rule in rules))]
    if contours := sorted({module.symbol for module in words} & {"@#", "@!"}):
        yield f"Stems are round: {' and '.join(contours)}, which give contours to those of cpfg, draw nothing here."
    if "angle" not in draft.settings and any(module.symbol in _TURNS and not module.arguments for module in words):
        yield (
            "cpfg keeps the angle by which + turns in a file of the view. It is 90 degrees here; for 22.5 put the line "
            '"/* angle: 22.5 */" above the axiom.'
        )
    productions = [production for rules in draft.sections.values() for production in rules]
    rewritten = {module.symbol for production in productions for module in production.predecessors}
    for production in productions:
        start, end = production.at or (0, 0)
        arrow = ARROW.search(text, start, end)
        prose = _PROSE.search(text, arrow.end(), end) if arrow else None
        if prose and rewritten.isdisjoint(prose["word"] or ""):
            rolls = ", two rolls first" * prose.group().startswith("/")
            yield f'"{prose.group()}" is read as symbols{rolls}; a comment is written between "/*" and "*/".'


def _split_symbols(draft: Draft) -> Iterator[str]:
    """Notes on "@o" and the like, which to cpfg are two symbols, so that a rule for the letter applies to the second."""
    rules = [rule for rules in draft.sections.values() for rule in rules]
    words = chain(draft.axiom or (), *(flat(rule.successor) for rule in rules))
    pairs = {
        (module.symbol[1:], len(module.arguments)): module
        for module in words
        if len(module.symbol) > 1 and module.symbol[0] in "@?"
    }
    for asked in dict.fromkeys((m.symbol, len(m.arguments)) for rule in rules for m in rule.parameters):
        if asked in pairs:
            pair = pairs[asked].symbol
            yield (
                f'"{pair}" is one symbol here, and what is said of "{pair[1:]}" before an arrow is not about it; to cpfg '
                f'"{pair}" is "{pair[0]}" and "{pair[1:]}".'
            )


def _infix(expression: Expression) -> bool:
    """Whether an expression is made with an operator between two others."""
    return (
        isinstance(expression, Apply)
        and len(expression.operands) == 2
        and OPERATORS[expression.operator].precedence is not None
    )


def _enclosed(value: str) -> bool:
    """Whether one pair of parentheses encloses a text."""
    return value.startswith("(") and not blank_parentheses(value).strip()


def _likely(text: str) -> int:
    """Ten for each mark that only cpfg has, more for its own name; two for a capital "Axiom:" and long arrows after letters."""
    marks = len(_MARKS.findall(text))
    if not marks and _AXIOM_MARK.search(text):
        heads = [
            line[: arrow.start()] for line in text.splitlines() if (arrow := ARROW.search(line)) and arrow.group() == "-->"
        ]
        single = all(len(name) == 1 for head in heads for name in re.findall(r"\w+", blank_parentheses(head).split(":")[0]))
        return 2 * (bool(heads) and single)
    return 10 * marks + 200 * bool(_NUMBERED.search(text))


def _transcribe(source: str) -> Transcript:
    """A text after the preprocessor of C, but for the macros that are numbers, and without the labels of productions."""
    transcript = preprocessed(source, lambda rule, text: parse(CPFG, rule, text, 0, len(text)))
    labels = [Edit(*label.span(), "") for label in _LABEL.finditer(transcript.text)]
    texts = [*_TEXT.finditer(transcript.text)]
    labels += [Edit(*text.span(), "@L(" if text["sign"] == "," else "@L") for text in texts]
    shown = ", ".join(dict.fromkeys(f'"{text["text"]}"' for text in texts))
    return edited(transcript, labels, [f"Labels have no texts here: {shown}."] if texts else []) if labels else transcript


CPFG = Dialect(
    name="cpfg",
    statements=statements,
    transformer=CpfgStatements,
    finish=_finish,
    diagnostics=(
        "feature",
        "included",
        "label",
        "in_a_block",
        "end_of_block",
        "macro_definition",
        "own_keyword",
        *DIAGNOSTICS,
        "constant",
    ),
    module=module_text,
    joined=joined_word,
    write=system_text,
    missing_feature=missing_feature,
    likely=_likely,
    spelling=Spelling(Path(__file__).parent, expression=expression_text, module=module_text, joined=joined_word),
    transcribe=_transcribe,
)
