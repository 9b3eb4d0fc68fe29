"""What a parser stumbled over in Mathematica's notation, in the words of the person who typed it: the questions that are asked
about the place, the most telling first."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from lsys_kit.errors import ModelSyntaxError, named
from lsys_kit.notation.dialects.mathematica.expressions import HEADS, INSTEAD, meant
from lsys_kit.notation.dialects.mathematica.printed_diagnostics import PRINTED
from lsys_kit.notation.dialects.mathematica.statements import without_comments
from lsys_kit.notation.syntax.dialect import Question
from lsys_kit.notation.syntax.failure import Stumble, printed, quoted

PARTS = HEADS[:4]
_RULE = 'A rule reads "LRule[LEFT[a], PRED[b], RIGHT[], SUCC[b, c]]"; "LEFT[]" and "RIGHT[]" ask for nothing.'
_QUOTES = 'Symbols that are no names stand in quotation marks, as in \'F, "[", "+", F, "]"\'.'
_A_VALUE = frozenset(("NUMBER", "LPAR"))
_CLOSING = {"[": "]", "(": ")", "{": "}"}
_HEAD = re.compile(rf"(?:{'|'.join(HEADS)})(?=\s*\[)", re.IGNORECASE)
_STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"')

SPELT: Sequence[tuple[str, str, str]] = (
    (r"=!=|<>", "This is no comparison", '"Not equal" is typed "!=".'),
    (r"={3,}", "This is no comparison", 'To compare two values, type "==".'),
    (r"=>", "This is no comparison", '"At least" is typed ">=".'),
    (r"=<", "This is no comparison", '"At most" is typed "<=".'),
    (r"(?<!&)&(?!&)|\band\b", "This joins no conditions", '"And" is typed "&&".'),
    (r"(?<!\|)\|(?!\|)|\bor\b", "This joins no conditions", '"Or" is typed "||".'),
    (r"\bnot\s+", "This denies no condition", '"Not" is typed "!", as in "!(t < 5)".'),
    (r"\d,\d", "A number is typed with a point", 'Type "1.4", not "1,4".'),
    (r"\*\*", "This is no operator", 'A power is typed "t^2".'),
    (r"\+\+", "This is no operator", 'One more is typed "t + 1".'),
)
"""What is spelt as elsewhere: a pattern, what to say of it, what to type here."""


def _opened(text: str) -> int | None:
    """The offset of the last bracket that is not closed."""
    opened: list[int] = []
    for match in re.finditer(r"[\[({]|[\])}]", text):
        if match.group() in "[({":
            opened.append(match.start())
        else:
            opened[-1:] = []
    return opened[-1] if opened else None


def _around(stumble: Stumble) -> tuple[str, int | None]:
    """The last bracket that is not closed: the name before it, in capitals, and its offset."""
    opened = _opened(stumble.before)
    if opened is None:
        return "", None
    word = re.search(r"(\w*)\s*$", stumble.before[:opened])
    return (word[1].upper() if word else ""), stumble.start + opened


def _unclosed(stumble: Stumble) -> ModelSyntaxError | None:
    head, at = _around(stumble)
    if at is None:
        return None
    ends = stumble.found in (";", "=", ":=") and not stumble.after[1:].split("\n")[0].strip()
    next_part = re.match(rf",?\s*(?:{'|'.join(PARTS)}|LRule)\s*\[", stumble.after, re.IGNORECASE)
    if not stumble.found or ends or (next_part and head not in ("LRULE", "LRULES", "LSYSTEM")):
        return stumble.error(f'This "{stumble.text[at]}" is never closed', "Every bracket needs one that closes it.", at, 1)
    return None


def _closed(stumble: Stumble) -> ModelSyntaxError | None:
    """A bracket that closes nothing, or another kind, or in which nothing stands."""
    head, at = _around(stumble)
    if stumble.found not in ("]", ")", "}"):
        return None
    if at is None:
        return stumble.error(f'This "{stumble.found}" closes nothing', "Every bracket needs one before it that it closes.")
    opening = stumble.text[at]
    if stumble.found != _CLOSING[opening]:
        return stumble.error(f'"{opening}" is not closed by "{stumble.found}"', f'Type "{_CLOSING[opening]}".')
    if stumble.before.endswith(","):
        return stumble.error('Nothing stands behind this ","', "Leave it out.", stumble.start + len(stumble.before) - 1, 1)
    if stumble.start + len(stumble.before) == at + 1:
        hint = _EMPTY.get(head, "Write a value there, or leave the brackets out.")
        return stumble.error("Nothing stands in these brackets", hint, at, stumble.at + 1 - at)
    return None


_EMPTY = {"PRED": "Name the module that is replaced there.", "AXIOM": "Write the first word there: one module or more."}
"""What belongs into brackets that cannot be empty."""


def _parts(stumble: Stumble) -> ModelSyntaxError | None:
    """The parts of an LRule: one that is missing, or stands where it cannot."""
    head, at = _around(stumble)
    part = _HEAD.match(stumble.after)
    name = part.group() if part else ""
    if head == "LRULE" and at is not None:
        there = re.findall(rf"\b({'|'.join(PARTS)})\s*\[", stumble.text[at:stumble.at], re.IGNORECASE)
        wanted = PARTS[len(there)] if len(there) < len(PARTS) else ""
        if wanted and wanted == name.upper():
            return stumble.error(f'A "," is missing before {name}', _RULE)
        if wanted:
            return stumble.error(f"{wanted}[...] is missing in this LRule", _RULE)
    if name.upper() in PARTS:
        return stumble.error(f"{name}[...] stands outside of an LRule", _RULE)
    return None


def _arrows(stumble: Stumble) -> ModelSyntaxError | None:
    if stumble.found not in ("->", "→") or _around(stumble)[1] is None:
        return None
    return stumble.error("An arrow stands in brackets", _RULE)


def _round(stumble: Stumble) -> ModelSyntaxError | None:
    """Round brackets where square ones belong."""
    name = re.search(r"([A-Za-z]\w*)$", stumble.before)
    if stumble.found != "(" or not name:
        return None
    return stumble.error("Round brackets stand here", f'In Mathematica they are square: "{name[1]}[...]".')


def _misspelt(stumble: Stumble) -> ModelSyntaxError | None:
    """A call that is neither one of the notation's own nor one that draws or prints."""
    call = re.fullmatch(r"([A-Za-z]\w*)\s*\[.*\]\s*", stumble.text[stumble.start:stumble.end], re.DOTALL)
    if not call or stumble.found:
        return None
    hint = meant(call[1]) or "What prints or draws can be left out; a rule has an arrow."
    return stumble.error(f'I do not know "{call[1]}[...]"', hint, stumble.start, len(call[1]))


def _definition(stumble: Stumble) -> ModelSyntaxError | None:
    """A definition without its "=", or with another sign."""
    name = re.fullmatch(r"\s*([A-Za-z]\w*)\s*:?", stumble.before)
    if not name or not re.match(r":(?!=)|==|[A-Za-z\d\"{]", stumble.found + stumble.after[1:2]):
        return None
    value = printed(stumble.after.lstrip(":= ").rstrip())
    hint = f'Type "runKLSystem[lsystem, {value}];".' if name[1] == "steps" else f'Type "{name[1]} = {value};".'
    return stumble.error('A definition has one "="', hint)


def _condition(stumble: Stumble) -> ModelSyntaxError | None:
    """A condition where none can stand, or that begins otherwise than with "/;"."""
    begun = stumble.found == "/;" or (stumble.found == ";" and stumble.before.endswith("/"))
    if begun and _around(stumble)[1] is not None:
        return stumble.error("A condition cannot stand here", "Conditions stand behind what LEFT, PRED and RIGHT ask for.")
    pattern = re.search(r"\b(\w+)_$", stumble.before)
    if not pattern or stumble.found not in (";", ":", "|", "?", "&", "if", "when"):
        return None
    hint = f'A condition stands behind "/;", as in "{pattern[1]}_ /; {pattern[1]} < 5".'
    return stumble.error(f"I did not expect {quoted(stumble.found)} behind a parameter", hint)


def _spelt_otherwise(stumble: Stumble) -> ModelSyntaxError | None:
    first, last = max(stumble.start, stumble.at - 6), min(stumble.end, stumble.at + 4)
    for pattern, message, hint in SPELT:
        for match in re.compile(pattern).finditer(stumble.text, first, last):
            if match.start() <= stumble.at <= match.end() and stumble.found not in ("->", "→"):
                return stumble.error(message, hint, match.start(), len(match.group()))
    return None


def _unreadable(stumble: Stumble) -> ModelSyntaxError | None:
    """A name that Mathematica knows and the kit does not: with "$", or with Greek letters."""
    letter = re.match(r"\\\[(\w+)\]", stumble.after)
    if letter:
        return stumble.error(f'I cannot read "{letter.group()}"', f'Spell the letter: "{letter[1].lower()}".',
                             length=len(letter.group()))
    if re.match(r"\$\w", stumble.after) or re.match(r"\w*\$", stumble.found):
        return stumble.error('A name has no "$"', "Names are made of the letters A to Z, digits and _.", length=1)
    if stumble.found and not stumble.found.isascii() and stumble.found != "→":
        return stumble.error(f"I cannot read the character {named(stumble.found[0])}",
                             "Names are made of the letters A to Z, digits and _.", length=1)
    return None


def _quotation(stumble: Stumble) -> ModelSyntaxError | None:
    """A symbol without its quotation marks, or with one."""
    if stumble.found == '"' and "STRING" in stumble.accepted:
        return stumble.error("This quotation mark is never closed", _QUOTES + r' A "\" is typed "\\".')
    in_a_word = {"STRING", "COMMA", "RBRACE"} & stumble.accepted and not {"NUMBER", "TIMES"} & stumble.accepted
    if in_a_word and re.fullmatch(r"[^\w\s,;\])}\"(]", stumble.found):
        return stumble.error(f'The symbol {quoted(stumble.found)} stands here without quotation marks', _QUOTES)
    if stumble.accepted == {"STRING"}:
        return stumble.error("Quotation marks are missing here",
                             f'Type "{printed(stumble.found)}" with a quotation mark on each side.')
    return None


def _commas(stumble: Stumble) -> ModelSyntaxError | None:
    """Neighbours without a comma, or with too many."""
    head, _ = _around(stumble)
    if "COMMA" in stumble.accepted and not {"TIMES"} & stumble.accepted and re.match(r"[\w\"]", stumble.found):
        return stumble.error(f'A "," is missing before {quoted(stumble.found)}', "Modules and parts stand between commas.")
    if stumble.found == "," and head == "PRED":
        return stumble.error("Only one module can be replaced", 'What stands beside it belongs into "LEFT[]" or "RIGHT[]".')
    if stumble.found == "," and stumble.before.endswith(("[", ",")):
        return stumble.error('Nothing stands before this ","', "Leave it out.")
    return None


def _steps(stumble: Stumble) -> ModelSyntaxError | None:
    head, _ = _around(stumble)
    if stumble.found == "]" and stumble.accepted == {"COMMA"} and head.startswith("RUN"):
        return stumble.error("The number of steps is missing", 'A run reads "runKLSystem[lsystem, 6];".')
    if stumble.found == "]" and stumble.accepted == {"COMMA"} and head == "LSYSTEM":
        return stumble.error("The rules are missing", 'An L-system reads "LSystem[axiom, lrules]".')
    return None


def _braces(stumble: Stumble) -> ModelSyntaxError | None:
    if stumble.found == "{":
        return stumble.error("A list stands here", 'Rules stand in "LRULES[...]", the axiom in "AXIOM[...]"; what was printed '
                             "can be left out.")
    if stumble.accepted == {"LBRACE"}:
        return stumble.error("Braces are missing here", f'Type "{{{printed(stumble.found)}}}".')
    return None


def _angles(stumble: Stumble) -> ModelSyntaxError | None:
    inverse = re.search(r"(Arc\w+)\s*\[[^\[\]]*\]$", stumble.before)
    if inverse and stumble.accepted == {"TIMES"}:
        return stumble.error(f"{inverse[1]}[...] is an angle in radians",
                             f'Angles are in degrees here: type "{inverse[1]}[x]/Degree".',
                             stumble.start + inverse.start(), len(inverse[1]))
    if stumble.found not in ("Degree", "°"):
        return None
    if _around(stumble)[0] in ("SIN", "COS", "TAN"):
        return stumble.error("Degree belongs to the whole angle", 'Put parentheses around a sum: "Sin[(x + y) Degree]".')
    return stumble.error("Degree is not needed here", 'Angles are in degrees; only "Sin[x Degree]" says so.')


def _value(stumble: Stumble) -> ModelSyntaxError | None:
    """A value too few, an operator too few, or a single "=" between values."""
    if stumble.accepted >= _A_VALUE:
        return stumble.error("A value is missing here", 'Possible here: a number, a name or "(".')
    if "TIMES" in stumble.accepted and re.match(r"[\w(.]", stumble.found):
        return stumble.error(f"An operator is missing before {quoted(stumble.found)}", 'To multiply, type "*", as in "2*t".')
    if stumble.found == "=":
        return stumble.error('A single "=" cannot be used here', 'To compare two values, type "==".')
    return None


def _random(stumble: Stumble) -> ModelSyntaxError | None:
    head, _ = _around(stumble)
    if not head.startswith("RANDOM") or not (stumble.found == "{" or "LBRACE" in stumble.accepted):
        return None
    if head == "RANDOMINTEGER":
        return stumble.error('I do not know the function "RandomInteger"', INSTEAD["RandomInteger"])
    return stumble.error("The range of a random number is missing", 'It reads "RandomReal[{0, 1}]".')


_ASKED: Sequence[Question] = (
    _unclosed, _random, _steps, _closed, _parts, _condition, _round, _arrows, _misspelt, _angles, _unreadable, *PRINTED,
    _definition, _braces, _quotation, _commas, _spelt_otherwise, _value)


def _answer(stumble: Stumble) -> ModelSyntaxError | None:
    """The first answer, with comments and quoted symbols out of the way."""
    bare = _STRING.sub(lambda quotation: '"' + "x" * (len(quotation.group()) - 2) + '"', without_comments(stumble.source))
    seen = replace(stumble, text=bare)
    return next((answer for question in _ASKED if (answer := question(seen)) is not None), None)


QUESTIONS: Sequence[Question] = (_answer,)
"""What is asked about a slip in Mathematica's notation."""
