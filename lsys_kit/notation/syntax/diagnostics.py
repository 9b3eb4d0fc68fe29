"""Syntax errors explained to the person who typed the text.

A parser knows which token it did not expect; a student wants to know what is missing. `diagnose` tries a list of diagnostics
at the place of the failure, the most specific first, and takes the first error that one of them gives. Spellings of other
languages (`=>`, `and`, `**`) are a table (`spelling.CORRECTIONS`).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from difflib import get_close_matches

from lark.exceptions import UnexpectedInput

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.model.turtle_dialects import quoted_dialects
from lsys_kit.notation.syntax.common_diagnostics import (
    VALUE_TOKENS,
    foreign_comment,
    misspelling,
    parentheses,
    repetition,
    second_arrow,
    second_comparison,
    unreadable_character,
    value_in_parentheses,
)
from lsys_kit.notation.syntax.dialect import Diagnostic, Grammar
from lsys_kit.notation.syntax.failure import ParseFailure, excerpt, expected_hint, parse_failure, quoted, unclosed_bracket
from lsys_kit.notation.syntax.predecessor_diagnostics import diagnose_predecessor
from lsys_kit.notation.syntax.text.statements import ARROW

KEYWORDS = (
    "axiom",
    "angle",
    "heading",
    "length",
    "turtle",
    "steps",
    "seed",
    "depth",
    "alphabet",
    "ignore",
    "consider",
    "meta",
    "productions",
    "decomposition",
    "decomposition depth",
    "interpretation",
    "cells",
    "branches",
    "widths",
    "colours",
    "field",
    "surface",
)
_SYNONYMS = {"start": "axiom", "initiator": "axiom", "word": "axiom", "w": "axiom", "delta": "angle", "rules": "productions"}
"""What other programs and books call a keyword."""
_CHOICES = {
    "TRADITION": ("turtle", "turtle", f"Turtles are {quoted_dialects('and')}."),
    "SHAPE": ("cells", "look", 'Cells are drawn as "rectangles" or "ellipses".'),
    "WHICH": ("branches", "kind of branch", 'A right context names "any" branch or the "next" one, or reads the word "flat".'),
    "UNIT": ("widths", "unit", 'Widths of strokes are in "pixels" or "units".'),
    "SOURCE": ("colours", "kind of colours", 'Colours of strokes are "natural" or those of "symbols".'),
}
"""The keywords that take one of a few words, by the token of that word; what it is called, and which there are."""
_NUMBER = (
    'Values are written in parentheses after a symbol, as in "A(2)"; for three turns type "+++", for the colour 2, '
    '";(2)". Where a digit is a symbol, "alphabet: 2" says so.'
)
_BRACED = re.compile(r"\\(vec|over(left|right)arrow|xrightarrow)\b|^V[ \t]*=")


def diagnose(unexpected: UnexpectedInput, source: str, start: int, end: int, notation: Grammar) -> ModelSyntaxError:
    """What is wrong with the statement between two offsets, as an error with its place and a hint."""
    failure = parse_failure(unexpected, source, start, end, notation.spelling)
    errors = (diagnostic(failure) for diagnostic in (*notation.diagnostics, _anything_else))
    return next(error for error in errors if error is not None)


def _arrows(failure: ParseFailure) -> ModelSyntaxError | None:
    """An arrow with nothing before or after it."""
    first = ARROW.search(failure.before)
    if ARROW.match(failure.found):
        if not failure.text[failure.text.rfind("\n", 0, failure.at) + 1 : failure.at].strip():
            return failure.error("There is nothing before the arrow", failure.spelling.rule_example)
        if failure.before.endswith(":"):
            return failure.error("There is no condition before the arrow", 'Write one, as in "t < 5", or leave the ":" out.')
    if not failure.found and first and first.end() == len(failure.before):
        head = re.sub(r"^meta[ \t]*:", "", failure.before[: first.start()], flags=re.IGNORECASE)
        predecessor = excerpt(head.split(":")[0].split("<")[-1].split(">")[0].strip())
        hint = f"To erase {predecessor}, write {failure.spelling.nothing} there."
        return failure.error("There is nothing after the arrow", hint, failure.start + first.start(), len(first.group()))
    return None


def _keyword(failure: ParseFailure) -> ModelSyntaxError | None:
    """A keyword that is misspelt, or without its colon or its value."""
    statement = failure.statement
    word = re.match(r"([A-Za-z_]+(?:[ \t]+depth)?)([ \t]*:(?!=)(?!.*[<>=]))?", statement)
    if not word or ARROW.search(statement):
        return None
    name, rest = word[1].lower(), statement[word.end() :].strip()
    known = name if name in KEYWORDS else _SYNONYMS.get(name) or next(iter(get_close_matches(name, KEYWORDS, 1, 0.75)), None)
    sentences: tuple[str, str | None] | None = None
    if word[2] and known and known != name:
        sentences = f'I do not know "{word[1]}:"', f'Did you mean "{known}:"?'
    elif word[2] and not rest:
        sentences = f'There is nothing after "{word[1]}:"', expected_hint(failure.accepted)
    elif word[2] and not known and rest[0].isdigit():
        sentences = f'I do not know "{word[1]}:"', f'A constant is declared with "=", as in "{word[1]} = {excerpt(rest)}".'
    elif not word[2] and known == name and rest[:1] not in ("(", "=", ":"):
        return missing_keyword_colon(failure.source, failure.start, word[1], rest)
    return failure.error(*sentences, failure.start, len(word[1])) if sentences else None


def _choice(failure: ParseFailure) -> ModelSyntaxError | None:
    """An unknown turtle, look of cells, unit of widths, or kind of colours."""
    kind = next(iter(_CHOICES.keys() & failure.accepted), None)
    if kind is None:
        return None
    keyword, called, choices = _CHOICES[kind]
    if not failure.found:
        return failure.error(f'There is nothing after "{keyword}:"', choices, failure.start, len(keyword))
    found = re.match(r"[\w-]+|.", failure.after)
    return failure.error(f"I do not know the {called} {quoted(found[0] if found else failure.found)}", choices)


def _braces(failure: ParseFailure) -> ModelSyntaxError | None:
    """A brace of the mathematical form that is not closed, or a comma that is missing between two."""
    statement = failure.statement
    opened = unclosed_bracket(statement, "{}") if _BRACED.search(statement) else None
    if opened is not None:
        return failure.error('This "{" is never closed', 'Every "{" needs a "}" after it.', failure.start + opened, 1)
    if {"COMMA", "RBRACE"} <= failure.accepted:
        return failure.error('A "," is missing here', 'The letters of an alphabet are separated by commas, as in "V = {A, B}".')
    return None


def missing_keyword_colon(source: str, start: int, word: str, rest: str) -> ModelSyntaxError:
    """The error for a keyword at an offset without its colon."""
    return ModelSyntaxError(
        f'A ":" is missing after "{word}"', source, start, start + len(word), f'Type "{word.lower()}: {excerpt(rest.strip())}".'
    )


def _repeat(failure: ParseFailure) -> ModelSyntaxError | None:
    """A repetition in an axiom, one that ends with a minus sign, or one without the name of its index."""
    arrow, found = ARROW.search(failure.before), failure.found
    if arrow is None or "RELATION" in failure.accepted:
        return (
            failure.error("Nothing is repeated in an axiom", "Write it out in full.")
            if found == "<" and re.search(r"\brepeat\s*\([^()]*\)$", failure.before)
            else None
        )
    if "MORETHAN" in failure.accepted and found == "->" and not failure.before.endswith(("-", ">")):
        return failure.error('This "->" is read as an arrow', 'Where a repetition ends, type "- >", with a blank between them.')
    if failure.accepted == {"NAME"} and failure.before.endswith(","):
        return failure.error("The name of the index is missing here", failure.spelling.repetition)
    return None


def _equals(failure: ParseFailure) -> ModelSyntaxError | None:
    """A single "=", where an arrow or a comparison is needed."""
    if not failure.found.startswith("="):
        return None
    if "ARROW" in failure.accepted and not ARROW.search(failure.after):
        return failure.error("This is not an arrow", failure.spelling.rule_example)
    return failure.error('A single "=" cannot be used here', 'To compare two values, type "==".')


def _constant_declaration(failure: ParseFailure) -> ModelSyntaxError | None:
    """Something in the declaration of a constant."""
    constant = re.match(r"([A-Za-z_]\w*)\s*=(?!=)\s*([A-Za-z_]\w*$)?", failure.before)
    if not constant or ARROW.search(failure.text, failure.start, failure.end) or "RANGE" in failure.accepted:
        return None
    production = f'; a production, "{constant[1]} {failure.spelling.arrow} {constant[2]}"' if constant[2] else ""
    return failure.error(
        f"I did not expect {quoted(failure.found)} here",
        f'A constant reads "dt = 0.5", or "dt = 0.5 in 0.1 .. 2 by 0.1"{production}.',
    )


def _production_with_equals(failure: ParseFailure) -> ModelSyntaxError | None:
    """A production as other programs write it, with "=" for its arrow."""
    rule = re.fullmatch(r"((?!δ)[^\W\d_])\s*=(?!=)\s*((?:[^\s\d(].*)?)", failure.statement)
    if not rule or ARROW.search(failure.statement) or (rule[2] and not re.search(r"[\[\]]|[+\-]$", rule[2])):
        return None
    arrow, at = failure.spelling.arrow, failure.start + failure.statement.index("=")
    if rule[2]:
        return failure.error("This is not an arrow", f'Type "{rule[1]} {arrow} {excerpt(rule[2])}".', at, 1)
    return failure.error(
        'There is nothing after the "="',
        f'A constant reads "{rule[1]} = 0.5"; to erase {rule[1]}, type "{rule[1]} {arrow} *".',
        at,
        1,
    )


def _in_a_word(failure: ParseFailure) -> ModelSyntaxError | None:
    """Something in a word that is not a module."""
    empty = failure.found if failure.found in ("ε", "*") else failure.before[-1:]
    if empty in ("ε", "*") and ARROW.search(failure.before):
        return failure.error(f"Nothing else is possible beside {quoted(empty)}", "It says that the successor is empty.")
    if failure.found == ":" and ARROW.search(failure.before):
        return failure.error(
            'This ":" comes after the arrow', f'A condition comes before it, as in "A(t) : t < 5 {failure.spelling.arrow} B".'
        )
    if not {"SYMBOL", "NAME"} & failure.accepted or failure.accepted >= VALUE_TOKENS:
        return None
    if failure.found[:1].isdigit():
        hint = _NUMBER if "NAME" in failure.accepted else 'A plant string has no values: "(" and ")" are branches.'
        return failure.error("A number is not a module", hint)
    if failure.found.startswith(","):
        return failure.error('A "," is not needed here', "Modules and names are separated by blanks.")
    return None


def _anything_else(failure: ParseFailure) -> ModelSyntaxError:
    what = f"I did not expect {quoted(failure.found)} here" if failure.found else "The line ends too early"
    return failure.error(what, expected_hint(failure.accepted))


DIAGNOSTICS: Sequence[Diagnostic] = (
    foreign_comment,
    _repeat,
    repetition,
    _choice,
    _keyword,
    _braces,
    parentheses,
    second_arrow,
    _arrows,
    misspelling,
    unreadable_character,
    diagnose_predecessor,
    second_comparison,
    _in_a_word,
    _production_with_equals,
    _equals,
    value_in_parentheses,
    _constant_declaration,
)
"""The diagnostics of the kit's own notation and of plant strings, the most specific first."""
