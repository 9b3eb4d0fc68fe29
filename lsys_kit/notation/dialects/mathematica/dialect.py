"""Mathematica's notation, after Jacob: definitions of an axiom, of rules and of an L-system; its grammar is
`grammar.lark`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.dialects.mathematica.actions import MathematicaStatements
from lsys_kit.notation.dialects.mathematica.builder import finish
from lsys_kit.notation.dialects.mathematica.expressions import HEADS, KNOWN, expression_text, spelling_hint
from lsys_kit.notation.dialects.mathematica.writer import module_text, system_text
from lsys_kit.notation.model.expressions import Apply, Name, walk
from lsys_kit.notation.model.operators import OPERATORS
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.syntax.actions import transformer
from lsys_kit.notation.syntax.diagnostics import innermost_bracket
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.syntax.failure import ParseFailure
from lsys_kit.notation.syntax.text.statements import ARROW
from lsys_kit.notation.syntax.text.transcript import Transcript, as_typed, edited
from lsys_kit.notation.syntax.text.typesetting import LINE_OF_SUBSCRIPTS, subscripts
from lsys_kit.notation.syntax.wording import Spelling

DEEPEST = 3
"""How deep comments may be nested."""
_STRING = r'"(?:[^"\\\n]|\\.)*+(?:(?P<closed>")|\\?(?=\n|\Z))'
"""What is quoted, to the end of the line where the quotation is never closed."""


def _comment(depth: int) -> str:
    """The pattern of a comment with others in it."""
    inner = rf"|{_comment(depth - 1)}" if depth > 1 else ""
    return rf"\(\*(?>(?:[^*(]++|\*(?!\))|\((?!\*){inner})*)\*\)"


_COMMENTS = re.compile(rf"{_STRING}|{_comment(DEEPEST)}|\(\*|\*\)")
_CUT = re.compile(rf"{_STRING}|[\[({{]|[\])}}]|(?<!/);|\s+")
_CONTINUES = re.compile(r"(:?=|&&|\|\||[,+*^<:]|(?<![-/])/|(?<!-)-|/;)$")
_CONTINUATION = re.compile(rf"{ARROW.pattern}|:?=(?!=)|&&|\|\||/;")
_PART = r"(?:(?!\w\s+(?!by\b)\w|\.\.|\bby\b|\*\)|\(\*).)+"
_RANGE = re.compile(rf";[ \t]*\(\*{_PART}\.\.{_PART}\bby\b{_PART}\*\)")
_CONSTANT = re.compile(r"[A-Za-z_]\w*\s*:?=(?!=)")


def statements(text: str) -> Iterator[tuple[int, int]]:
    """The offsets of the statements, without the ";" that ends them; the range of a constant's slider goes with it.

    >>> text = "w = 11; (* 2 .. 15 by 1 *)\\naxiom = AXIOM[\\n  a[1], b];"
    >>> [text[start:end] for start, end in statements(text)]
    ['w = 11; (* 2 .. 15 by 1 *)', 'axiom = AXIOM[\\n  a[1], b]']
    """
    bare = without_nested_comments(text)
    start = 0
    for end in _statement_ends(bare):
        stretch = bare[start:end].strip()
        if stretch:
            first = bare.index(stretch[0], start)
            slider = _RANGE.match(text, end) if _CONSTANT.match(stretch) else None
            yield first, slider.end() if slider else first + len(stretch)
        start = end + 1


def _statement_ends(bare: str) -> Iterator[int]:
    """The offsets of the ";" and line ends at which statements end, and of the end."""
    depth, start = 0, 0
    for match in _CUT.finditer(bare):
        sign = match.group()
        if sign in "[({":
            depth += 1
        elif sign in "])}":
            depth = max(0, depth - 1)
        elif depth == 0 and (sign == ";" or ("\n" in sign and not _continues(bare, start, *match.span()))):
            yield match.start()
            start = match.end()
    yield len(bare)


def _continues(bare: str, begun: int, start: int, end: int) -> bool:
    """Whether a statement continues after the blanks between two offsets, which contain a line end."""
    return start > begun and bool(_CONTINUES.search(bare, max(begun, start - 3), start) or _CONTINUATION.match(bare, end))


def without_nested_comments(text: str) -> str:
    """The text with its comments blanked, every other character in its place.

    >>> without_nested_comments('w = 11; (* a (* wide *) layer *) "(*"')
    'w = 11;                          "(*"'
    """

    def blanked(match: re.Match[str]) -> str:
        found = match.group()
        if found[0] == '"':
            return found
        if len(found) == 2:
            raise _unmatched_comment(text, match.start(), found)
        return re.sub(r"[^\n]", " ", found) if "\n" in found else " " * len(found)

    return _COMMENTS.sub(blanked, text)


def _unmatched_comment(text: str, at: int, sign: str) -> ModelSyntaxError:
    """What is wrong with the sign of a comment that belongs to none."""
    if sign == "*)":
        return ModelSyntaxError("This comment was never opened", text, at, at + 2, 'A comment begins with "(*".')
    depth = 0
    for match in re.finditer(r"\(\*|\*\)", text[at:]):
        depth += 1 if match.group() == "(*" else -1
        if depth > DEEPEST:
            return ModelSyntaxError(f"Comments are nested more than {DEEPEST} deep", text, at + match.start(), at + match.end())
    return ModelSyntaxError("This comment is never closed", text, at, at + 2, 'A comment ends with "*)".')


_MARKS = re.compile(r"\b(?:LRule|LRULES|AXIOM|LSystem|run\w*System)\s*\[|\w_\s*/;", re.IGNORECASE)
"""What is found in texts of this notation, and in no others."""
_HEADING = re.compile(r"^[^\S\n]*+Rules\s*+:", re.IGNORECASE | re.MULTILINE)
_NOT_PRINTED = re.compile(
    r"^[^\S\n]*+(?:(?:angle|heading|steps|turtle|ignore)[^\S\n]*+:|axiom[^\S\n]*+(?::[^\n\"\[]*?[-+]|=[^\S\n]*+(?!AXIOM|[\"{(]|[^\S\n])))",
    re.IGNORECASE | re.MULTILINE,
)
"""What a printed list of rules does not have: a setting with a colon, or a turn without quotation marks."""
_RULE_PARTS = HEADS[:4]
_HEAD = re.compile(rf"(?:{'|'.join(HEADS)})(?=\s*\[)", re.IGNORECASE)
_SETTING_NAMES = frozenset(("angle", "heading", "length", "seed", "steps", "turtle", "skippattern"))
"""What a definition sets, so that no constant can have that name."""


def _likely(text: str) -> int:
    headings = 0 if _NOT_PRINTED.search(text) else len(_HEADING.findall(text))
    return 3 * (len(_MARKS.findall(text)) + headings)


def _own_lacks(system: LSystem) -> Iterator[str]:
    if any(module.symbol == "ε" for rule in system.rules for module in rule.right):
        yield "branch ends in contexts"
    if system.considered:
        yield "considered symbols"
    if system.depth != 1 or system.decomposition_depth is not None:
        yield "depth"
    names, functions = _names_and_functions(system)
    taken = {constant.name for constant in system.constants if constant.name.lower() in _SETTING_NAMES} | {"Degree"}
    yield from (f'other meaning of the name "{name}"' for name in sorted(names & taken))
    yield from (f'name like "{name}"' for name in sorted(names) if name.endswith("_"))
    yield from (f"function {name}" for name in sorted(functions - KNOWN))


def _names_and_functions(system: LSystem) -> tuple[set[str], set[str]]:
    names, functions = {constant.name for constant in system.constants}, set[str]()
    parts = [
        *(part for constant in system.constants for part in (constant.value, *(constant.range or ()))),
        *(rule.condition for rule in system.rules),
        *(argument for module in system.modules for argument in module.arguments),
    ]
    for part in (inner for each in parts if each is not None for inner in walk(each)):
        if isinstance(part, Name):
            names.add(part.name)
        elif isinstance(part, Apply) and OPERATORS[part.operator].precedence is None:
            functions.add(part.operator)
    return names, functions


def _transcribe(source: str) -> Transcript:
    """A text with each subscript of printed output behind its letter."""
    if not LINE_OF_SUBSCRIPTS.search(source):
        return as_typed(source)
    return edited(source, subscripts(without_nested_comments(source), "", "[]"))


def _bare(source: str) -> str:
    """A text with its comments blanked and its quoted symbols crossed out; a quotation that is never closed stays."""
    return re.sub(
        _STRING,
        lambda found: f'"{"x" * (len(found[0]) - 2)}"' if found["closed"] else found[0],
        without_nested_comments(source),
    )


def _rule_parts(failure: ParseFailure) -> ModelSyntaxError | None:
    """A part of an LRule that is missing, or outside of it."""
    (head, at), rule = innermost_bracket(failure), failure.spelling.words["whole_rule"]
    part = _HEAD.match(failure.after)
    name = part.group() if part else ""
    if head == "LRULE" and at is not None:
        there = re.findall(rf"\b({'|'.join(_RULE_PARTS)})\s*\[", failure.text[at : failure.at], re.IGNORECASE)
        wanted = _RULE_PARTS[len(there)] if len(there) < len(_RULE_PARTS) else ""
        if wanted and wanted == name.upper():
            return failure.error(f'A "," is missing before {name}', rule)
        if wanted:
            return failure.error(f"{wanted}[...] is missing in this LRule", rule)
    return failure.error(f"{name}[...] is outside of an LRule", rule) if name.upper() in _RULE_PARTS else None


def _unknown_call(failure: ParseFailure) -> ModelSyntaxError | None:
    """A call that is not known, in a statement of its own."""
    call = re.fullmatch(r"([A-Za-z]\w*)\s*\[.*\]\s*", failure.statement, re.DOTALL)
    if not call or failure.found:
        return None
    hint = spelling_hint(call[1]) or "What prints or draws can be left out; a rule has an arrow."
    return failure.error(f'I do not know "{call[1]}[...]"', hint, failure.start, len(call[1]))


MATHEMATICA = Dialect(
    name="mathematica",
    statements=statements,
    transformer=transformer(MathematicaStatements),
    finish=finish,
    diagnostics=(
        "unclosed",
        "random",
        "steps",
        "closed",
        _rule_parts,
        "condition",
        "round_brackets",
        "arrow_in_brackets",
        _unknown_call,
        "angles",
        "unreadable",
        "unreadable_character",
        "misplaced_part",
        "printed_arrow",
        "second_arrow",
        "printed_predecessor",
        "definition",
        "lists",
        "quotation_marks",
        "commas",
        "misspelling",
        "missing_value",
        "operator",
    ),
    module=module_text,
    joined=" ".join,
    write=system_text,
    lacks=(
        "predecessors of several modules",
        "probabilities",
        "repetition",
        "decomposition rules",
        "interpretation rules",
        "meta-rules",
        "right contexts that name the next branch",
        "right contexts that pass over brackets",
        "field",
    ),
    missing_feature=lambda system: next(_own_lacks(system), None),
    likely=_likely,
    spelling=Spelling(Path(__file__).parent, expression=expression_text, module=module_text, joined=" ".join),
    bare=_bare,
    transcribe=_transcribe,
)
