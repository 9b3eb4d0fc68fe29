"""What the parser stumbled over, in the words of the person who typed it.

A parser knows which token it did not expect; a student wants to know what is missing. `diagnose` asks a list of questions
about the place, the most telling first; the first that knows an answer gives the error. What is merely spelt as elsewhere
(`=>`, `and`, `**`) stands in a table.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from difflib import get_close_matches

from lark.exceptions import UnexpectedInput

from lsys_kit.errors import ModelSyntaxError, named
from lsys_kit.notation.model.turtle_dialects import quoted_dialects
from lsys_kit.notation.syntax.dialect import Diagnostic, Grammar
from lsys_kit.notation.syntax.failure import (
    ParseFailure,
    blank_parentheses,
    excerpt,
    expected_hint,
    parse_failure,
    quoted,
    unclosed_bracket,
)
from lsys_kit.notation.syntax.predecessor_diagnostics import PRODUCTION, diagnose_predecessor
from lsys_kit.notation.syntax.statements import ARROW

KEYWORDS = ("axiom", "angle", "heading", "length", "turtle", "steps", "seed", "depth", "alphabet", "ignore", "consider",
            "meta", "productions", "decomposition", "decomposition depth", "interpretation", "cells")
_ALSO = {"start": "axiom", "initiator": "axiom", "word": "axiom", "w": "axiom", "delta": "angle", "rules": "productions"}
"""What other programs and books say for a keyword."""
_READ = frozenset("→⟶εωδ∨∧¬≤≥≠−·×")
"""The characters beyond ASCII that the grammars know."""
_A_VALUE = frozenset(("NUMBER", "LPAR"))
_AN_ARROW = "This is no arrow"
_CHOICES = {"TRADITION": ("turtle", "turtle", f'Turtles are {quoted_dialects("and")}.'),
            "LOOK": ("cells", "look", 'Cells are drawn as "rectangles" or "ellipses".')}
"""The keywords behind which one of some words stands, by the kind of that word; what it is called, and which there are."""
_BRACED = re.compile(r"\\(vec|over(left|right)arrow|xrightarrow)\b|^V[ \t]*=")
_REPEAT = 'What is repeated reads "repeat(3) <F>", or, with a name that counts from 0, "repeat(3, i) <F(i)>".'
_BEFORE_ARROW, _NO_ARROW = rf"(?=.*(?:{ARROW.pattern}))", rf"(?!.*(?:{ARROW.pattern}))"

CORRECTIONS: Sequence[tuple[str, str, str]] = (
    (r"={3,}", "This is no comparison", 'To compare two values, type "==".'),
    (rf"=>{_BEFORE_ARROW}", "This is no comparison", '"At least" is typed ">=".'),
    (rf"=<{_BEFORE_ARROW}", "This is no comparison", '"At most" is typed "<=".'),
    (r"<>|=/=|~=", "This is no comparison", '"Not equal" is typed "!=".'),
    (rf"(?:::=|:=|=>|⇒|↦|[–—−~]>|-[ \t]+>){_NO_ARROW}", _AN_ARROW, 'An arrow is typed "->", in one piece.'),
    (r"\band\b|(?<!&)&(?!&)", "This joins no conditions", '"And" is typed "&&".'),
    (r"\bor\b|(?<!\|)\|(?!\|)", "This joins no conditions", '"Or" is typed "||".'),
    (r"\bnot\s+", "This denies no condition", '"Not" is typed "!", as in "!(t < 5)".'),
    (r"[‐‑‒–—―]+", "This dash is no minus sign", 'A minus sign is typed "-".'),
    (r"\*\*", "This is no operator", 'A power is typed "t^2".'),
    (r"\d,\d", "A number is typed with a point", 'Type "1.4", not "1,4".'),
    (r"\d\.(?![\d.])", "This number is not finished", 'Type "1" or "1.0".'),
    (r"\*/", "This comment was never opened", 'A comment begins with "/*".'),
    (r";", 'This ";" parts no values', 'Values are parted by ",", as in "A(1, 2)".'),
    (r"°", "This sign is not needed", "Angles are in degrees."),
    (r"[\"“”„«»]", "A quotation mark stands here", "Words are typed without quotation marks."),
)
"""What is spelt as elsewhere: a pattern, what to say of it, what to type here."""


def diagnose(slip: UnexpectedInput, source: str, start: int, end: int, notation: Grammar) -> ModelSyntaxError:
    """The slip in the statement between two offsets, as an error with its place and a hint."""
    failure = parse_failure(slip, source, start, end)
    answers = (question(failure) for question in (*notation.diagnostics, _anything_else))
    return next(answer for answer in answers if answer is not None)


def _spelt_otherwise(failure: ParseFailure) -> ModelSyntaxError | None:
    first = max(failure.start, failure.at - 4)
    for pattern, message, hint in CORRECTIONS:
        for match in re.compile(pattern).finditer(failure.text, first, min(failure.end, failure.at + 200)):
            if match.start() <= failure.at <= match.end() and not ARROW.match(failure.found):
                return failure.error(message, hint, match.start(), len(match.group()))
    return None


def _unreadable(failure: ParseFailure) -> ModelSyntaxError | None:
    if failure.found.isascii() or failure.found[0] in _READ:
        return None
    return failure.error(f"I cannot read the character {named(failure.found[0])}",
                         "Names are made of the letters A to Z, digits and _.", length=1)


def _comment(failure: ParseFailure) -> ModelSyntaxError | None:
    statement = failure.text[failure.start:failure.end]
    if not statement.startswith(("#", "//", "%")) or ARROW.search(failure.before):
        return None
    if statement.startswith("#define"):
        return failure.error("This is no production", 'A constant is declared with "=", as in "dt = 0.5".', failure.start, 7)
    return failure.error("This is no production", 'A comment stands between "/*" and "*/".', failure.start, 1)


def _parentheses(failure: ParseFailure) -> ModelSyntaxError | None:
    found, opened = failure.found, unclosed_bracket(failure.text[failure.start:failure.at])
    ended = not found or found == ":" or ARROW.match(found) or failure.accepted == {"RPAR"}
    if opened is not None and ended and not failure.accepted >= _A_VALUE:
        return failure.error('This "(" is never closed', 'Every "(" needs a ")" behind it.', failure.start + opened, 1)
    if found.startswith(")") and opened is None:
        branch = failure.before.count("[") > failure.before.count("]")
        return failure.error('This ")" closes nothing', 'A branch that begins with "[" ends with "]".' if branch else
                             'Every ")" needs a "(" before it.')
    if found.startswith(")") and failure.before.endswith("("):
        return failure.error("Nothing stands in these parentheses", "Write a value there, or leave the parentheses out.",
                             failure.start + len(failure.before) - 1, failure.at + 2 - failure.start - len(failure.before))
    return None


def _arrows(failure: ParseFailure) -> ModelSyntaxError | None:
    first = ARROW.search(failure.before)
    if ARROW.match(failure.found):
        if first:
            return failure.error("A second arrow stands in this production", "Write one production a line.")
        if not failure.text[failure.text.rfind("\n", 0, failure.at) + 1:failure.at].strip():
            return failure.error("Nothing stands before the arrow", PRODUCTION)
        if failure.before.endswith(":"):
            return failure.error("There is no condition before the arrow", 'Write one, as in "t < 5", or leave the ":" out.')
    if not failure.found and first and first.end() == len(failure.before):
        head = re.sub(r"^meta[ \t]*:", "", failure.before[:first.start()], flags=re.IGNORECASE)
        predecessor = excerpt(head.split(":")[0].split("<")[-1].split(">")[0].strip())
        return failure.error("Nothing stands behind the arrow", f'To erase {predecessor}, write "ε" or "*" there.',
                             failure.start + first.start(), len(first.group()))
    return None


def _keyword(failure: ParseFailure) -> ModelSyntaxError | None:
    statement = failure.text[failure.start:failure.end]
    word = re.match(r"([A-Za-z_]+(?:[ \t]+depth)?)([ \t]*:(?!=)(?!.*[<>=]))?", statement)
    if not word or ARROW.search(statement):
        return None
    name, rest = word[1].lower(), statement[word.end():].strip()
    meant = name if name in KEYWORDS else _ALSO.get(name) or next(iter(get_close_matches(name, KEYWORDS, 1, 0.75)), None)
    said: tuple[str, str | None] | None = None
    if word[2] and meant and meant != name:
        said = f'I do not know "{word[1]}:"', f'Did you mean "{meant}:"?'
    elif word[2] and not rest:
        said = f'Nothing stands behind "{word[1]}:"', expected_hint(failure.accepted)
    elif word[2] and not meant and rest[0].isdigit():
        said = f'I do not know "{word[1]}:"', f'A constant is declared with "=", as in "{word[1]} = {excerpt(rest)}".'
    elif not word[2] and meant == name and rest[:1] not in ("(", "=", ":"):
        return missing_keyword_colon(failure.source, failure.start, word[1], rest)
    return failure.error(*said, failure.start, len(word[1])) if said else None


def _chosen(failure: ParseFailure) -> ModelSyntaxError | None:
    """Whose turtle it is, or how cells look: nothing that is known."""
    kind = next(iter(_CHOICES.keys() & failure.accepted), None)
    if kind is None:
        return None
    keyword, called, choices = _CHOICES[kind]
    if not failure.found:
        return failure.error(f'Nothing stands behind "{keyword}:"', choices, failure.start, len(keyword))
    found = re.match(r"[\w-]+|.", failure.after)
    return failure.error(f"I do not know the {called} {quoted(found[0] if found else failure.found)}", choices)


def _braces(failure: ParseFailure) -> ModelSyntaxError | None:
    """A brace of the mathematical form that is not closed, or a comma that is missing between two."""
    statement = failure.text[failure.start:failure.end]
    opened = unclosed_bracket(statement, "{}") if _BRACED.search(statement) else None
    if opened is not None:
        return failure.error('This "{" is never closed', 'Every "{" needs a "}" behind it.', failure.start + opened, 1)
    if {"COMMA", "RBRACE"} <= failure.accepted:
        return failure.error('A "," is missing here', 'The letters of an alphabet are parted by commas, as in "V = {A, B}".')
    return None


def missing_keyword_colon(source: str, start: int, word: str, rest: str) -> ModelSyntaxError:
    """What is wrong where a keyword stands at an offset without its colon."""
    return ModelSyntaxError(f'A ":" is missing behind "{word}"', source, start, start + len(word),
                            f'Type "{word.lower()}: {excerpt(rest.strip())}".')


def _repetition(failure: ParseFailure) -> ModelSyntaxError | None:
    """A "<" or ">" of what is repeated, where it is missing or has no place."""
    arrow, found = ARROW.search(failure.before), failure.found
    if arrow is None or "RELATION" in failure.accepted:
        return failure.error("Nothing is repeated in an axiom", "Write it out in full.") \
            if found == "<" and re.search(r"\brepeat\s*\([^()]*\)$", failure.before) else None
    if failure.accepted == {"LESSTHAN"}:
        return failure.error('A "<" is missing here', _REPEAT)
    if "MORETHAN" in failure.accepted and found == "->" and not failure.before.endswith(("-", ">")):
        return failure.error('This "->" is read as an arrow', 'Where a repetition ends, type "- >", with a blank between them.')
    if "MORETHAN" in failure.accepted and (not found or found == ":" or ARROW.match(found)):
        opened = unclosed_bracket(blank_parentheses(failure.before[arrow.end():]), "<>")
        return failure.error('This "<" is never closed', _REPEAT, failure.start + arrow.end() + (opened or 0), 1)
    if found == ">" and failure.before.endswith("<"):
        return failure.error("Nothing is repeated here", _REPEAT)
    if found in ("<", ">") and failure.accepted != {"RPAR"}:
        return failure.error(f"I did not expect {quoted(found)} here",
                             'A context stands before the arrow; behind it "<" and ">" go with "repeat(3)".')
    if failure.accepted == {"NAME"} and failure.before.endswith(","):
        return failure.error("A name that counts the repetitions is missing here", _REPEAT)
    return None


def _equals(failure: ParseFailure) -> ModelSyntaxError | None:
    if not failure.found.startswith("="):
        return None
    if "ARROW" in failure.accepted and not ARROW.search(failure.after):
        return failure.error(_AN_ARROW, PRODUCTION)
    return failure.error('A single "=" cannot be used here', 'To compare two values, type "==".')


def _comparison(failure: ParseFailure) -> ModelSyntaxError | None:
    relation = r"([<>]=?|[=!]=|[≤≥≠])"
    chain = re.search(rf"([\w.]+)\s*{relation}\s*([\w.]+)$", failure.before[-200:])
    if not chain or not re.match(relation, failure.found):
        return None
    right = re.match(r"\s*([\w.]+)", failure.after[len(failure.found):])
    twice = f"{chain[1]} {chain[2]} {chain[3]} && {chain[3]} {failure.found} {right[1] if right else '...'}"
    return failure.error("A second comparison stands here", f'Compare twice, as in "{twice}".')


def _value(failure: ParseFailure) -> ModelSyntaxError | None:
    """A value too few, or an operator too few."""
    if failure.accepted >= _A_VALUE:
        return failure.error("A value is missing here", 'Possible here: a number, a name or "(".')
    inside = unclosed_bracket(failure.before) is not None and "SYMBOL" not in failure.accepted
    if inside and re.search(r"[\w)]$", failure.before) and re.match(r"[\w(.]", failure.found):
        return failure.error(f"An operator is missing before {quoted(failure.found)}", 'To multiply, type "*", as in "2*t".')
    return None


def _constant(failure: ParseFailure) -> ModelSyntaxError | None:
    constant = re.match(r"([A-Za-z_]\w*)\s*=(?!=)\s*([A-Za-z_]\w*$)?", failure.before)
    if not constant or ARROW.search(failure.text, failure.start, failure.end) or "RANGE" in failure.accepted:
        return None
    production = f'; a production, "{constant[1]} -> {constant[2]}"' if constant[2] else ""
    return failure.error(f"I did not expect {quoted(failure.found)} here",
                         f'A constant reads "dt = 0.5", or "dt = 0.5 in 0.1 .. 2 by 0.1"{production}.')


def _in_a_word(failure: ParseFailure) -> ModelSyntaxError | None:
    """What stands in a word, but is no module."""
    empty = failure.found if failure.found in ("ε", "*") else failure.before[-1:]
    if empty in ("ε", "*") and ARROW.search(failure.before):
        return failure.error(f"Nothing else may stand beside {quoted(empty)}", "It says that the successor is empty.")
    if failure.found == ":" and ARROW.search(failure.before):
        return failure.error('This ":" stands behind the arrow', 'A condition stands before it, as in "A(t) : t < 5 -> B".')
    if not {"SYMBOL", "NAME"} & failure.accepted or failure.accepted >= _A_VALUE:
        return None
    if failure.found[:1].isdigit():
        hint = 'Values stand in parentheses behind a symbol, as in "A(2)".' if "NAME" in failure.accepted \
            else 'A plant string has no values: "(" and ")" are branches.'
        return failure.error("A number stands alone in a word", hint)
    if failure.found.startswith(","):
        return failure.error('A "," is not needed here', "Modules and names stand side by side, with blanks between them.")
    return None


def _anything_else(failure: ParseFailure) -> ModelSyntaxError:
    what = f"I did not expect {quoted(failure.found)} here" if failure.found else "The line ends too early"
    return failure.error(what, expected_hint(failure.accepted))


DIAGNOSTICS: Sequence[Diagnostic] = (
    _comment, _repetition, _chosen, _keyword, _braces, _parentheses, _arrows, _spelt_otherwise, _unreadable,
    diagnose_predecessor, _comparison, _in_a_word, _equals, _value, _constant)
"""What is asked about a slip in the kit's own notation and in plant strings, the most telling first."""
