"""What the parser stumbled over, in the words of the person who typed it.

A parser knows which token it did not expect; a student wants to know what is missing. `explained` asks a list of questions
about the place, the most telling first; the first that knows an answer gives the error. What is merely spelt as elsewhere
(`=>`, `and`, `**`) stands in a table.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from difflib import get_close_matches

from lark.exceptions import UnexpectedInput

from lsys_kit.errors import ModelSyntaxError, named
from lsys_kit.notation.syntax.dialect import Grammar, Question
from lsys_kit.notation.syntax.failure import Stumble, outside, possible, printed, quoted, stumbled, unclosed
from lsys_kit.notation.syntax.predecessor_diagnostics import PRODUCTION, before_arrow
from lsys_kit.notation.syntax.statements import ARROW

KEYWORDS = ("axiom", "angle", "heading", "length", "turtle", "steps", "seed", "depth", "alphabet", "ignore", "consider",
            "meta", "productions", "decomposition", "decomposition depth", "interpretation", "cells")
_ALSO = {"start": "axiom", "initiator": "axiom", "word": "axiom", "w": "axiom", "delta": "angle", "rules": "productions"}
"""What other programs and books say for a keyword."""
_READ = frozenset("→⟶εωδ∨∧¬≤≥≠−·×")
"""The characters beyond ASCII that the grammars know."""
_A_VALUE = frozenset(("NUMBER", "LPAR"))
_AN_ARROW = "This is no arrow"
_CHOICES = {"TRADITION": ("turtle", "turtle", 'Turtles are "abop", "grogra", "plant-string" and "fractint".'),
            "LOOK": ("cells", "look", 'Cells are drawn as "rectangles" or "ellipses".')}
"""The keywords behind which one of some words stands, by the kind of that word; what it is called, and which there are."""
_BRACED = re.compile(r"\\(vec|over(left|right)arrow|xrightarrow)\b|^V[ \t]*=")
_REPEAT = 'What is repeated reads "repeat(3) <F>", or, with a name that counts from 0, "repeat(3, i) <F(i)>".'
_BEFORE_ARROW, _NO_ARROW = rf"(?=.*(?:{ARROW.pattern}))", rf"(?!.*(?:{ARROW.pattern}))"

SPELT: Sequence[tuple[str, str, str]] = (
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


def explained(slip: UnexpectedInput, source: str, start: int, end: int, notation: Grammar) -> ModelSyntaxError:
    """The slip in the statement between two offsets, as an error with its place and a hint."""
    stumble = stumbled(slip, source, start, end)
    answers = (question(stumble) for question in (*notation.questions, _anything_else))
    return next(answer for answer in answers if answer is not None)


def _spelt_otherwise(stumble: Stumble) -> ModelSyntaxError | None:
    first = max(stumble.start, stumble.at - 4)
    for pattern, message, hint in SPELT:
        for match in re.compile(pattern).finditer(stumble.text, first, min(stumble.end, stumble.at + 200)):
            if match.start() <= stumble.at <= match.end() and not ARROW.match(stumble.found):
                return stumble.error(message, hint, match.start(), len(match.group()))
    return None


def _unreadable(stumble: Stumble) -> ModelSyntaxError | None:
    if stumble.found.isascii() or stumble.found[0] in _READ:
        return None
    return stumble.error(f"I cannot read the character {named(stumble.found[0])}",
                         "Names are made of the letters A to Z, digits and _.", length=1)


def _comment(stumble: Stumble) -> ModelSyntaxError | None:
    statement = stumble.text[stumble.start:stumble.end]
    if not statement.startswith(("#", "//", "%")) or ARROW.search(stumble.before):
        return None
    if statement.startswith("#define"):
        return stumble.error("This is no production", 'A constant is declared with "=", as in "dt = 0.5".', stumble.start, 7)
    return stumble.error("This is no production", 'A comment stands between "/*" and "*/".', stumble.start, 1)


def _parentheses(stumble: Stumble) -> ModelSyntaxError | None:
    found, opened = stumble.found, unclosed(stumble.text[stumble.start:stumble.at])
    ended = not found or found == ":" or ARROW.match(found) or stumble.accepted == {"RPAR"}
    if opened is not None and ended and not stumble.accepted >= _A_VALUE:
        return stumble.error('This "(" is never closed', 'Every "(" needs a ")" behind it.', stumble.start + opened, 1)
    if found.startswith(")") and opened is None:
        branch = stumble.before.count("[") > stumble.before.count("]")
        return stumble.error('This ")" closes nothing', 'A branch that begins with "[" ends with "]".' if branch else
                             'Every ")" needs a "(" before it.')
    if found.startswith(")") and stumble.before.endswith("("):
        return stumble.error("Nothing stands in these parentheses", "Write a value there, or leave the parentheses out.",
                             stumble.start + len(stumble.before) - 1, stumble.at + 2 - stumble.start - len(stumble.before))
    return None


def _arrows(stumble: Stumble) -> ModelSyntaxError | None:
    first = ARROW.search(stumble.before)
    if ARROW.match(stumble.found):
        if first:
            return stumble.error("A second arrow stands in this production", "Write one production a line.")
        if not stumble.text[stumble.text.rfind("\n", 0, stumble.at) + 1:stumble.at].strip():
            return stumble.error("Nothing stands before the arrow", PRODUCTION)
        if stumble.before.endswith(":"):
            return stumble.error("There is no condition before the arrow", 'Write one, as in "t < 5", or leave the ":" out.')
    if not stumble.found and first and first.end() == len(stumble.before):
        head = re.sub(r"^meta[ \t]*:", "", stumble.before[:first.start()], flags=re.IGNORECASE)
        predecessor = printed(head.split(":")[0].split("<")[-1].split(">")[0].strip())
        return stumble.error("Nothing stands behind the arrow", f'To erase {predecessor}, write "ε" or "*" there.',
                             stumble.start + first.start(), len(first.group()))
    return None


def _keyword(stumble: Stumble) -> ModelSyntaxError | None:
    statement = stumble.text[stumble.start:stumble.end]
    word = re.match(r"([A-Za-z_]+(?:[ \t]+depth)?)([ \t]*:(?!=)(?!.*[<>=]))?", statement)
    if not word or ARROW.search(statement):
        return None
    name, rest = word[1].lower(), statement[word.end():].strip()
    meant = name if name in KEYWORDS else _ALSO.get(name) or next(iter(get_close_matches(name, KEYWORDS, 1, 0.75)), None)
    said: tuple[str, str | None] | None = None
    if word[2] and meant and meant != name:
        said = f'I do not know "{word[1]}:"', f'Did you mean "{meant}:"?'
    elif word[2] and not rest:
        said = f'Nothing stands behind "{word[1]}:"', possible(stumble.accepted)
    elif word[2] and not meant and rest[0].isdigit():
        said = f'I do not know "{word[1]}:"', f'A constant is declared with "=", as in "{word[1]} = {printed(rest)}".'
    elif not word[2] and meant == name and rest[:1] not in ("(", "=", ":"):
        return without_colon(stumble.source, stumble.start, word[1], rest)
    return stumble.error(*said, stumble.start, len(word[1])) if said else None


def _chosen(stumble: Stumble) -> ModelSyntaxError | None:
    """Whose turtle it is, or how cells look: nothing that is known."""
    kind = next(iter(_CHOICES.keys() & stumble.accepted), None)
    if kind is None:
        return None
    keyword, called, choices = _CHOICES[kind]
    if not stumble.found:
        return stumble.error(f'Nothing stands behind "{keyword}:"', choices, stumble.start, len(keyword))
    found = re.match(r"[\w-]+|.", stumble.after)
    return stumble.error(f"I do not know the {called} {quoted(found[0] if found else stumble.found)}", choices)


def _braces(stumble: Stumble) -> ModelSyntaxError | None:
    """A brace of the mathematical form that is not closed, or a comma that is missing between two."""
    statement = stumble.text[stumble.start:stumble.end]
    opened = unclosed(statement, "{}") if _BRACED.search(statement) else None
    if opened is not None:
        return stumble.error('This "{" is never closed', 'Every "{" needs a "}" behind it.', stumble.start + opened, 1)
    if {"COMMA", "RBRACE"} <= stumble.accepted:
        return stumble.error('A "," is missing here', 'The letters of an alphabet are parted by commas, as in "V = {A, B}".')
    return None


def without_colon(source: str, start: int, word: str, rest: str) -> ModelSyntaxError:
    """What is wrong where a keyword stands at an offset without its colon."""
    return ModelSyntaxError(f'A ":" is missing behind "{word}"', source, start, start + len(word),
                            f'Type "{word.lower()}: {printed(rest.strip())}".')


def _repetition(stumble: Stumble) -> ModelSyntaxError | None:
    """A "<" or ">" of what is repeated, where it is missing or has no place."""
    arrow, found = ARROW.search(stumble.before), stumble.found
    if arrow is None or "RELATION" in stumble.accepted:
        return stumble.error("Nothing is repeated in an axiom", "Write it out in full.") \
            if found == "<" and re.search(r"\brepeat\s*\([^()]*\)$", stumble.before) else None
    if stumble.accepted == {"LESSTHAN"}:
        return stumble.error('A "<" is missing here', _REPEAT)
    if "MORETHAN" in stumble.accepted and found == "->" and not stumble.before.endswith(("-", ">")):
        return stumble.error('This "->" is read as an arrow', 'Where a repetition ends, type "- >", with a blank between them.')
    if "MORETHAN" in stumble.accepted and (not found or found == ":" or ARROW.match(found)):
        opened = unclosed(outside(stumble.before[arrow.end():]), "<>")
        return stumble.error('This "<" is never closed', _REPEAT, stumble.start + arrow.end() + (opened or 0), 1)
    if found == ">" and stumble.before.endswith("<"):
        return stumble.error("Nothing is repeated here", _REPEAT)
    if found in ("<", ">") and stumble.accepted != {"RPAR"}:
        return stumble.error(f"I did not expect {quoted(found)} here",
                             'A context stands before the arrow; behind it "<" and ">" go with "repeat(3)".')
    if stumble.accepted == {"NAME"} and stumble.before.endswith(","):
        return stumble.error("A name that counts the repetitions is missing here", _REPEAT)
    return None


def _equals(stumble: Stumble) -> ModelSyntaxError | None:
    if not stumble.found.startswith("="):
        return None
    if "ARROW" in stumble.accepted and not ARROW.search(stumble.after):
        return stumble.error(_AN_ARROW, PRODUCTION)
    return stumble.error('A single "=" cannot be used here', 'To compare two values, type "==".')


def _comparison(stumble: Stumble) -> ModelSyntaxError | None:
    relation = r"([<>]=?|[=!]=|[≤≥≠])"
    chain = re.search(rf"([\w.]+)\s*{relation}\s*([\w.]+)$", stumble.before[-200:])
    if not chain or not re.match(relation, stumble.found):
        return None
    right = re.match(r"\s*([\w.]+)", stumble.after[len(stumble.found):])
    twice = f"{chain[1]} {chain[2]} {chain[3]} && {chain[3]} {stumble.found} {right[1] if right else '...'}"
    return stumble.error("A second comparison stands here", f'Compare twice, as in "{twice}".')


def _value(stumble: Stumble) -> ModelSyntaxError | None:
    """A value too few, or an operator too few."""
    if stumble.accepted >= _A_VALUE:
        return stumble.error("A value is missing here", 'Possible here: a number, a name or "(".')
    inside = unclosed(stumble.before) is not None and "SYMBOL" not in stumble.accepted
    if inside and re.search(r"[\w)]$", stumble.before) and re.match(r"[\w(.]", stumble.found):
        return stumble.error(f"An operator is missing before {quoted(stumble.found)}", 'To multiply, type "*", as in "2*t".')
    return None


def _constant(stumble: Stumble) -> ModelSyntaxError | None:
    constant = re.match(r"([A-Za-z_]\w*)\s*=(?!=)\s*([A-Za-z_]\w*$)?", stumble.before)
    if not constant or ARROW.search(stumble.text, stumble.start, stumble.end) or "RANGE" in stumble.accepted:
        return None
    production = f'; a production, "{constant[1]} -> {constant[2]}"' if constant[2] else ""
    return stumble.error(f"I did not expect {quoted(stumble.found)} here",
                         f'A constant reads "dt = 0.5", or "dt = 0.5 in 0.1 .. 2 by 0.1"{production}.')


def _in_a_word(stumble: Stumble) -> ModelSyntaxError | None:
    """What stands in a word, but is no module."""
    empty = stumble.found if stumble.found in ("ε", "*") else stumble.before[-1:]
    if empty in ("ε", "*") and ARROW.search(stumble.before):
        return stumble.error(f"Nothing else may stand beside {quoted(empty)}", "It says that the successor is empty.")
    if stumble.found == ":" and ARROW.search(stumble.before):
        return stumble.error('This ":" stands behind the arrow', 'A condition stands before it, as in "A(t) : t < 5 -> B".')
    if not {"SYMBOL", "NAME"} & stumble.accepted or stumble.accepted >= _A_VALUE:
        return None
    if stumble.found[:1].isdigit():
        hint = 'Values stand in parentheses behind a symbol, as in "A(2)".' if "NAME" in stumble.accepted \
            else 'A plant string has no values: "(" and ")" are branches.'
        return stumble.error("A number stands alone in a word", hint)
    if stumble.found.startswith(","):
        return stumble.error('A "," is not needed here', "Modules and names stand side by side, with blanks between them.")
    return None


def _anything_else(stumble: Stumble) -> ModelSyntaxError:
    what = f"I did not expect {quoted(stumble.found)} here" if stumble.found else "The line ends too early"
    return stumble.error(what, possible(stumble.accepted))


QUESTIONS: Sequence[Question] = (
    _comment, _repetition, _chosen, _keyword, _braces, _parentheses, _arrows, _spelt_otherwise, _unreadable, before_arrow,
    _comparison, _in_a_word, _equals, _value, _constant)
"""What is asked about a slip in the kit's own notation and in plant strings, the most telling first."""
