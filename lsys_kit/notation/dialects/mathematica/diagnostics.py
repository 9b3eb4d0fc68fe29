"""Diagnostics of a text in Mathematica's notation."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.dialects.mathematica.expressions import HEADS, INSTEAD, spelling_hint
from lsys_kit.notation.dialects.mathematica.printed_diagnostics import PRINTED_DIAGNOSTICS
from lsys_kit.notation.dialects.mathematica.statements import without_nested_comments
from lsys_kit.notation.syntax.common_diagnostics import missing_operator, missing_value, misspelling, unreadable_character
from lsys_kit.notation.syntax.dialect import Diagnostic
from lsys_kit.notation.syntax.failure import ParseFailure, excerpt, quoted

RULE_PARTS = HEADS[:4]
_RULE = 'A rule reads "LRule[LEFT[a], PRED[b], RIGHT[], SUCC[b, c]]"; "LEFT[]" and "RIGHT[]" match anything.'
_QUOTES = 'Symbols that are not names need quotation marks, as in \'F, "[", "+", F, "]"\'.'
_CLOSING = {"[": "]", "(": ")", "{": "}"}
_HEAD = re.compile(rf"(?:{'|'.join(HEADS)})(?=\s*\[)", re.IGNORECASE)
_STRING = re.compile(r'"(?:[^"\\\n]|\\.)*+(?:(?P<closed>")|\\?(?=\n|\Z))')


def _crossed_out(quotation: re.Match[str]) -> str:
    """What is quoted, without its signs; a quotation that is never closed as it is."""
    return '"' + "x" * (len(quotation.group()) - 2) + '"' if quotation["closed"] else quotation.group()


def _opened(text: str) -> int | None:
    """The offset of the last bracket that is not closed."""
    opened: list[int] = []
    for match in re.finditer(r"[\[({]|[\])}]", text):
        if match.group() in "[({":
            opened.append(match.start())
        else:
            opened[-1:] = []
    return opened[-1] if opened else None


def _innermost_bracket(failure: ParseFailure) -> tuple[str, int | None]:
    """The last bracket that is not closed: the name before it, in capitals, and its offset."""
    opened = _opened(failure.before)
    if opened is None:
        return "", None
    word = re.search(r"(?<!\w)\w*+$", failure.before[:opened].rstrip())
    return (word[0].upper() if word else ""), failure.start + opened


def _unclosed(failure: ParseFailure) -> ModelSyntaxError | None:
    head, at = _innermost_bracket(failure)
    if at is None:
        return None
    ends = failure.found in (";", "=", ":=") and not failure.after[1:].split("\n")[0].strip()
    next_part = re.match(rf",?\s*(?:{'|'.join(RULE_PARTS)}|LRule)\s*\[", failure.after, re.IGNORECASE)
    if not failure.found or ends or (next_part and head not in ("LRULE", "LRULES", "LSYSTEM")):
        return failure.error(f'This "{failure.text[at]}" is never closed', "Every bracket needs one that closes it.", at, 1)
    return None


def _closed(failure: ParseFailure) -> ModelSyntaxError | None:
    """A bracket that closes nothing, or another kind, or that is empty."""
    head, at = _innermost_bracket(failure)
    if failure.found not in ("]", ")", "}"):
        return None
    if at is None:
        return failure.error(f'This "{failure.found}" closes nothing', "Every bracket needs one before it that it closes.")
    opening = failure.text[at]
    if failure.found != _CLOSING[opening]:
        return failure.error(f'"{opening}" is not closed by "{failure.found}"', f'Type "{_CLOSING[opening]}".')
    if failure.before.endswith(","):
        return failure.error('There is nothing after this ","', "Leave it out.", failure.start + len(failure.before) - 1, 1)
    if failure.start + len(failure.before) == at + 1:
        hint = _EMPTY.get(head, "Write a value there, or leave the brackets out.")
        return failure.error("There is nothing in these brackets", hint, at, failure.at + 1 - at)
    return None


_EMPTY = {"PRED": "Name the module to replace there.", "AXIOM": "Write the first word there: one module or more."}
"""What brackets that cannot be empty must hold."""


def _rule_parts(failure: ParseFailure) -> ModelSyntaxError | None:
    """A part of an LRule that is missing, or outside of it."""
    head, at = _innermost_bracket(failure)
    part = _HEAD.match(failure.after)
    name = part.group() if part else ""
    if head == "LRULE" and at is not None:
        there = re.findall(rf"\b({'|'.join(RULE_PARTS)})\s*\[", failure.text[at : failure.at], re.IGNORECASE)
        wanted = RULE_PARTS[len(there)] if len(there) < len(RULE_PARTS) else ""
        if wanted and wanted == name.upper():
            return failure.error(f'A "," is missing before {name}', _RULE)
        if wanted:
            return failure.error(f"{wanted}[...] is missing in this LRule", _RULE)
    if name.upper() in RULE_PARTS:
        return failure.error(f"{name}[...] is outside of an LRule", _RULE)
    return None


def _arrow_in_brackets(failure: ParseFailure) -> ModelSyntaxError | None:
    """An arrow inside of brackets."""
    if failure.found not in ("->", "→") or _innermost_bracket(failure)[1] is None:
        return None
    return failure.error("An arrow is not possible in brackets", _RULE)


def _round_brackets(failure: ParseFailure) -> ModelSyntaxError | None:
    """Round brackets where square ones belong."""
    name = re.search(r"\b\d*+([A-Za-z]\w*+)$", failure.before)
    if failure.found != "(" or not name:
        return None
    return failure.error("These brackets are round", f'In Mathematica they are square: "{name[1]}[...]".')


def _unknown_call(failure: ParseFailure) -> ModelSyntaxError | None:
    """A call that is not known, in a statement of its own."""
    call = re.fullmatch(r"([A-Za-z]\w*)\s*\[.*\]\s*", failure.text[failure.start : failure.end], re.DOTALL)
    if not call or failure.found:
        return None
    hint = spelling_hint(call[1]) or "What prints or draws can be left out; a rule has an arrow."
    return failure.error(f'I do not know "{call[1]}[...]"', hint, failure.start, len(call[1]))


def _definition(failure: ParseFailure) -> ModelSyntaxError | None:
    """A definition without its "=", or with another sign."""
    name = re.fullmatch(r"\s*([A-Za-z]\w*)\s*:?", failure.before)
    if not name or not re.match(r":(?!=)|==|[A-Za-z\d\"{]", failure.found + failure.after[1:2]):
        return None
    value = excerpt(failure.after.lstrip(":= ").rstrip())
    hint = f'Type "runKLSystem[lsystem, {value}];".' if name[1] == "steps" else f'Type "{name[1]} = {value};".'
    return failure.error('A definition has one "="', hint)


def _condition(failure: ParseFailure) -> ModelSyntaxError | None:
    """A condition where none is possible, or that does not begin with "/;"."""
    begun = failure.found == "/;" or (failure.found == ";" and failure.before.endswith("/"))
    if begun and _innermost_bracket(failure)[1] is not None:
        return failure.error("A condition is not possible here", "Conditions follow the patterns in LEFT, PRED and RIGHT.")
    pattern = re.search(r"\b(\w+)_$", failure.before)
    if not pattern or failure.found not in (";", ":", "|", "?", "&", "if", "when"):
        return None
    hint = f'A condition follows "/;", as in "{pattern[1]}_ /; {pattern[1]} < 5".'
    return failure.error(f"I did not expect {quoted(failure.found)} after a parameter", hint)


def _unreadable(failure: ParseFailure) -> ModelSyntaxError | None:
    """A name that Mathematica knows and the kit does not: with "$", or with Greek letters."""
    letter = re.match(r"\\\[(\w+)\]", failure.after)
    if letter:
        return failure.error(
            f'I cannot read "{letter.group()}"', f'Spell the letter: "{letter[1].lower()}".', length=len(letter.group())
        )
    if re.match(r"\$\w", failure.after) or re.match(r"\w*\$", failure.found):
        return failure.error('A name has no "$"', failure.spelling.name_rule, length=1)
    return unreadable_character(failure)


def _quotation_marks(failure: ParseFailure) -> ModelSyntaxError | None:
    """A symbol without its quotation marks, or with one."""
    if failure.found == '"' and "STRING" in failure.accepted:
        return failure.error("This quotation mark is never closed", _QUOTES + r' A "\" is typed "\\".')
    in_a_word = {"STRING", "COMMA", "RBRACE"} & failure.accepted and not {"NUMBER", "TIMES"} & failure.accepted
    if in_a_word and re.fullmatch(r"[^\w\s,;\])}\"(]", failure.found):
        return failure.error(f"The symbol {quoted(failure.found)} has no quotation marks", _QUOTES)
    if failure.accepted == {"STRING"}:
        return failure.error(
            "Quotation marks are missing here", f'Type "{excerpt(failure.found)}" with a quotation mark on each side.'
        )
    return None


def _commas(failure: ParseFailure) -> ModelSyntaxError | None:
    """Neighbours without a comma, or with too many."""
    head, _ = _innermost_bracket(failure)
    if "COMMA" in failure.accepted and not {"TIMES"} & failure.accepted and re.match(r"[\w\"]", failure.found):
        return failure.error(f'A "," is missing before {quoted(failure.found)}', "Modules and parts are separated by commas.")
    if failure.found == "," and head == "PRED":
        return failure.error("Only one module can be replaced", 'Its neighbours belong in "LEFT[]" or "RIGHT[]".')
    if failure.found == "," and failure.before.endswith(("[", ",")):
        return failure.error('There is nothing before this ","', "Leave it out.")
    return None


def _steps(failure: ParseFailure) -> ModelSyntaxError | None:
    head, _ = _innermost_bracket(failure)
    if failure.found == "]" and failure.accepted == {"COMMA"} and head.startswith("RUN"):
        return failure.error("The number of steps is missing", 'A run reads "runKLSystem[lsystem, 6];".')
    if failure.found == "]" and failure.accepted == {"COMMA"} and head == "LSYSTEM":
        return failure.error("The rules are missing", 'An L-system reads "LSystem[axiom, lrules]".')
    return None


def _lists(failure: ParseFailure) -> ModelSyntaxError | None:
    """A list where none is possible, or braces that are missing."""
    if failure.found == "{":
        return failure.error(
            "A list is not possible here",
            'Rules belong in "LRULES[...]", the axiom in "AXIOM[...]"; what was printed can be left out.',
        )
    if failure.accepted == {"LBRACE"}:
        return failure.error("Braces are missing here", f'Type "{{{excerpt(failure.found)}}}".')
    return None


def _angles(failure: ParseFailure) -> ModelSyntaxError | None:
    inverse = re.search(r"\b(Arc\w++)\s*+\[[^\[\]]*+\]$", failure.before)
    if inverse and failure.accepted == {"TIMES"}:
        return failure.error(
            f"{inverse[1]}[...] is an angle in radians",
            f'Angles are in degrees here: type "{inverse[1]}[x]/Degree".',
            failure.start + inverse.start(),
            len(inverse[1]),
        )
    if failure.found not in ("Degree", "°"):
        return None
    if _innermost_bracket(failure)[0] in ("SIN", "COS", "TAN"):
        return failure.error("Degree belongs to the whole angle", 'Put parentheses around a sum: "Sin[(x + y) Degree]".')
    return failure.error("Degree is not needed here", 'Angles are in degrees; only "Sin[x Degree]" says so.')


def _value_or_operator(failure: ParseFailure) -> ModelSyntaxError | None:
    """A value too few, an operator too few, or a single "=" between values."""
    error = missing_value(failure) or (missing_operator(failure) if "TIMES" in failure.accepted else None)
    if error is None and failure.found == "=":
        return failure.error('A single "=" cannot be used here', 'To compare two values, type "==".')
    return error


def _random(failure: ParseFailure) -> ModelSyntaxError | None:
    head, _ = _innermost_bracket(failure)
    if not head.startswith("RANDOM") or not (failure.found == "{" or "LBRACE" in failure.accepted):
        return None
    if head == "RANDOMINTEGER":
        return failure.error('I do not know the function "RandomInteger"', INSTEAD["RandomInteger"])
    return failure.error("The range of a random number is missing", 'It reads "RandomReal[{0, 1}]".')


_DIAGNOSTICS_OF_BARE_TEXT: Sequence[Diagnostic] = (
    _unclosed,
    _random,
    _steps,
    _closed,
    _rule_parts,
    _condition,
    _round_brackets,
    _arrow_in_brackets,
    _unknown_call,
    _angles,
    _unreadable,
    *PRINTED_DIAGNOSTICS,
    _definition,
    _lists,
    _quotation_marks,
    _commas,
    misspelling,
    _value_or_operator,
)


def _diagnose_bare_text(failure: ParseFailure) -> ModelSyntaxError | None:
    """The first error of these diagnostics, with comments and quoted symbols blanked out."""
    text = without_nested_comments(failure.source)
    bare = _STRING.sub(_crossed_out, text)
    seen = replace(failure, text=bare)
    return next((error for diagnostic in _DIAGNOSTICS_OF_BARE_TEXT if (error := diagnostic(seen)) is not None), None)


DIAGNOSTICS: Sequence[Diagnostic] = (_diagnose_bare_text,)
"""The diagnostics of a text in Mathematica's notation."""
