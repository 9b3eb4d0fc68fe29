"""Diagnostics of a text in GROGRA's notation."""

from __future__ import annotations

import re
from collections.abc import Sequence
from difflib import get_close_matches

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.dialects.grogra.spelling import RULE_ARROW, SPELLING
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS
from lsys_kit.notation.syntax.common_diagnostics import (
    VALUE_TOKENS,
    after_first,
    foreign_comment,
    misspelling,
    parentheses,
    repetition,
    second_arrow,
    second_comparison,
    unreadable_character,
    value_in_parentheses,
)
from lsys_kit.notation.syntax.dialect import Diagnostic
from lsys_kit.notation.syntax.failure import ParseFailure, excerpt, expected_hint, quoted, unclosed_bracket
from lsys_kit.notation.syntax.text.statements import blank_parentheses

_IN_FRONT = 'It is written in front, in parentheses: "(t < 6) k(t) # k(t+1)".'
_NUMBER = 'Numbers are glued to a turtle command, as in "F100", or written in parentheses after a symbol, as in "a(2)".'
_DIRECTIVES = {"axiom": "a", "angle": "60", "length": "100", "const": "k 3", "var": "x uniform 0 360", "set": "turtle abop"}
"""The words that follow a backslash, each with an example of what comes next."""
_SYNONYMS = {
    "start": "axiom",
    "startwort": "axiom",
    "winkel": "angle",
    "delta": "angle",
    "constant": "const",
    "variable": "var",
}


def _no_predecessor(failure: ParseFailure) -> ModelSyntaxError | None:
    """An arrow at the beginning of a rule."""
    arrow = RULE_ARROW.match(failure.statement)
    if arrow is None:
        return None
    hint = f"{SPELLING.rule_example} {SPELLING.comment}" if arrow[0] == "#" else SPELLING.rule_example
    return failure.error(f"There is nothing before the {quoted(arrow[0])}", hint, failure.start, len(arrow[0]))


def _comma(failure: ParseFailure) -> ModelSyntaxError | None:
    """Two statements, without a comma between them; a number with a comma in it."""
    if re.match(r"\d+$", failure.statement) and re.search(r"\d,$", failure.text[: failure.start]):
        return failure.error("A number is typed with a point", 'Type "0.5", not "0,5".', failure.start - 1, 1)
    line = failure.text.rfind("\n", failure.start, failure.at) + 1
    begins = line + len(failure.text[line : failure.end]) - len(failure.text[line : failure.end].lstrip())
    first = RULE_ARROW.search(failure.before)
    if line <= failure.start or unclosed_bracket(failure.text[failure.start : begins]) is not None:
        return None
    new = begins == failure.at and ("$END" in failure.accepted or failure.found.startswith("\\"))
    later = failure.before.startswith("\\") or (first is not None and first.end() < line - failure.start)
    if not (new or (later and RULE_ARROW.match(failure.found))):
        return None
    end = failure.start + len(failure.text[failure.start : begins].rstrip())
    if failure.text[end - 1] == ";":
        return failure.error('This ";" does not separate rules', SPELLING.apart, end - 1, 1)
    return failure.error('A "," is missing here', SPELLING.apart, end, 1)


def _directive(failure: ParseFailure) -> ModelSyntaxError | None:
    """A line that begins with a backslash, or as a setting of another notation."""
    word = re.match(r"\\([A-Za-z]+)", failure.statement)
    foreign = re.match(r"([A-Za-z]+)[ \t]*:", failure.statement)
    if not word:
        meant = _similar_directive(foreign[1]) if foreign and failure.found == ":" else None
        rest = failure.after[1:].strip()
        return (
            failure.error(
                "This setting is written as in another notation",
                f'Type "\\{meant} {excerpt(rest)},".',
                failure.start,
                len(foreign[0]),
            )
            if meant and foreign
            else None
        )
    name, meant = word[1], _similar_directive(word[1])
    if name not in _DIRECTIVES:
        hint = f'Did you mean "\\{meant}"?' if meant else f"Possible are: {', '.join(chr(92) + n for n in _DIRECTIVES)}."
        return failure.error(f'I do not know "\\{name}"', hint, failure.start, len(word[0]))
    if failure.found.startswith("=") and failure.before.split()[0] == "\\const":
        return failure.error('This "=" is not needed', f'Type "{failure.before} {excerpt(failure.after[1:].strip())},".')
    if "TRADITION" in failure.accepted:
        return failure.error(
            f"There is no turtle called {quoted(failure.found)}", f"Turtles are: {', '.join(TURTLE_DIALECTS)}."
        )
    behind = failure.text[failure.start + len(word[0]) : failure.at].strip()
    if failure.found or (behind and name not in ("const", "var")):
        return None
    return failure.error(
        f'Something is missing after "\\{name}"',
        f'It reads as in "\\{name} {_DIRECTIVES[name]},".',
        failure.start,
        len(word[0]),
    )


def _similar_directive(word: str) -> str | None:
    """The directive that a word resembles."""
    name = word.lower()
    return _SYNONYMS.get(name) or next(iter(get_close_matches(name, _DIRECTIVES, 1, 0.6)), None)


def _predecessor(failure: ParseFailure) -> ModelSyntaxError | None:
    """No symbol to replace, or more than one; a second context."""
    found, before = failure.found, failure.before
    if RULE_ARROW.search(before) or before.startswith("\\"):
        return None
    if found in ("<", ">") and found in blank_parentheses(before) and not {"RELATION", "RPAR"} & failure.accepted:
        return failure.error(f'This is a second "{found}"', SPELLING.contexts)
    if RULE_ARROW.match(found) and before.endswith("<"):
        return failure.error("The symbol to replace is missing", SPELLING.contexts)
    if RULE_ARROW.match(found) and before.startswith("(") and not blank_parentheses(before).strip():
        return failure.error("The symbol to replace is missing", 'It is written after its condition: "(t < 6) k(t) # k(t+1)".')
    if RULE_ARROW.match(found) and "LESSTHAN" in failure.accepted:
        return failure.error("Only one symbol can be replaced", SPELLING.contexts, after_first(failure), 1)
    if re.match(r"[A-Za-z]", found) and "ARROW" in failure.accepted and RULE_ARROW.search(failure.after):
        return failure.error("Only one symbol can be replaced", SPELLING.contexts)
    return None


def _repeat(failure: ParseFailure) -> ModelSyntaxError | None:
    """A repetition without its number, or before the arrow."""
    if RULE_ARROW.search(failure.before) and failure.before.endswith("&"):
        return failure.error('A number is missing after "&"', SPELLING.repetition)
    if failure.found == "&":
        return failure.error('"&" repeats a part of what follows the "#"', SPELLING.repetition)
    return None


def _other_notation(failure: ParseFailure) -> ModelSyntaxError | None:
    """A condition or a probability as in other notations."""
    arrow = RULE_ARROW.search(failure.before)
    if failure.found == ":" and arrow:
        return failure.error('A probability is written with "?"', f'Type "?{excerpt(failure.after[1:].strip())}".')
    if failure.found == ":":
        return failure.error("A condition is not possible here", _IN_FRONT)
    inside = unclosed_bracket(failure.before) is not None
    compared = re.search(r"[<>]$", failure.before) and failure.found[:1].isdigit()
    if (
        not arrow
        and not inside
        and "RELATION" not in failure.accepted
        and (compared or re.match(r"[<>!=]?=|[≤≥≠]|\\[lgn]e", failure.found))
    ):
        return failure.error("This condition has no parentheses", _IN_FRONT, failure.start, max(1, len(failure.before)))
    if failure.before.endswith("?") and failure.accepted >= VALUE_TOKENS:
        return failure.error('A probability is missing after "?"', 'Type it as in "?0.5", at the end of the rule.')
    return None


def _arrow(failure: ParseFailure) -> ModelSyntaxError | None:
    """Two arrows side by side, or none."""
    arrows = RULE_ARROW.search(failure.before), RULE_ARROW.search(failure.after)
    if RULE_ARROW.match(failure.found) and RULE_ARROW.search(failure.before[-2:]):
        return failure.error(f"This is a second {quoted(failure.found)}", 'One "#" is enough; "##" says how a symbol is drawn.')
    if any(arrows) or failure.before.startswith("\\") or not {"ARROW", "LESSTHAN"} & failure.accepted:
        return None
    return failure.error("An arrow is missing here", SPELLING.rule_example, after_first(failure))


def _comparison(failure: ParseFailure) -> ModelSyntaxError | None:
    """A second comparison, inside parentheses: outside of them "<" and ">" are contexts."""
    return None if unclosed_bracket(failure.before) is None else second_comparison(failure)


def _stray_number(failure: ParseFailure) -> ModelSyntaxError | None:
    """A number that belongs to nothing."""
    if failure.found[:1].isdigit() and "IDENTIFIER" in failure.accepted:
        return failure.error("A number is not a module", _NUMBER)
    return None


def _tex_macro(failure: ParseFailure) -> ModelSyntaxError | None:
    word = re.match(r"\\[A-Za-z]+", failure.after)
    return failure.error(f'I do not know "{word[0]}"', expected_hint(failure.accepted), length=len(word[0])) if word else None


DIAGNOSTICS: Sequence[Diagnostic] = (
    foreign_comment,
    _no_predecessor,
    _comma,
    _directive,
    _comparison,
    _predecessor,
    _repeat,
    repetition,
    misspelling,
    _other_notation,
    parentheses,
    _arrow,
    second_arrow,
    unreadable_character,
    value_in_parentheses,
    _stray_number,
    _tex_macro,
)
"""The diagnostics of a text in GROGRA's notation, the most specific first."""
