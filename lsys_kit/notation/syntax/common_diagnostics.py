"""Diagnostics that dialects share: each looks at the place where a parser failed, and quotes the dialect's own spelling."""

from __future__ import annotations

import re

from lsys_kit.errors import ModelSyntaxError, named
from lsys_kit.notation.syntax.failure import ParseFailure, quoted, unclosed_bracket
from lsys_kit.notation.syntax.text.statements import blank_parentheses

VALUE_TOKENS = frozenset(("NUMBER", "LPAR"))
"""Tokens with which a value can begin, but no module."""


def unreadable_character(failure: ParseFailure) -> ModelSyntaxError | None:
    """A character that no grammar has."""
    found = failure.found
    if found.isascii() or found[0] in failure.spelling.readable:
        return None
    return failure.error(f"I cannot read the character {named(found[0])}", failure.spelling.name_rule, length=1)


def misspelling(failure: ParseFailure) -> ModelSyntaxError | None:
    """Something that another language spells like this."""
    first, last = max(failure.start, failure.at - 6), min(failure.end, failure.at + 200)
    for pattern, message, hint in failure.spelling.corrections:
        hint = hint.replace("{arrow}", failure.spelling.arrow)
        for match in re.compile(pattern).finditer(failure.text, first, last):
            if match.start() <= failure.at <= match.end() and not failure.spelling.arrows.match(failure.found):
                return failure.error(message, hint, match.start(), len(match.group()))
    return None


def foreign_comment(failure: ParseFailure) -> ModelSyntaxError | None:
    """A line that begins as a comment, or a constant, of another language."""
    spelling, statement = failure.spelling, failure.statement
    mark = re.match(spelling.comment_marks, statement)
    if not mark or spelling.arrows.search(failure.before):
        return None
    hint = f'A constant is declared as in "{spelling.constant}".' if mark[0] == "#define" else spelling.comment
    return failure.error(f"This is not a {spelling.rule}", hint, failure.start, len(mark[0]))


def parentheses(failure: ParseFailure) -> ModelSyntaxError | None:
    """Parentheses that do not match, or that are empty."""
    found, before, opened = failure.found, failure.before, unclosed_bracket(failure.text[failure.start : failure.at])
    ended = not found or found in failure.spelling.outside or failure.spelling.arrows.match(found)
    closes_nowhere = unclosed_bracket(failure.statement) is not None
    unfinished = ended or (found != "," and "RPAR" in failure.accepted and (closes_nowhere or len(failure.accepted) == 1))
    if opened is not None and unfinished and not failure.accepted >= VALUE_TOKENS:
        return failure.error('This "(" is never closed', 'Every "(" needs a ")" after it.', failure.start + opened, 1)
    if found.startswith(",") and (pair := re.search(r"[(,]\s*(\([^()]*)$", before)):
        return failure.error(
            "There are several values in the place of one",
            'Each has a place of its own: type "A(1, 2)", not "A((1, 2))".',
            failure.start + pair.start(1),
            failure.at + 1 - failure.start - pair.start(1),
        )
    if found.startswith(")") and opened is None:
        branch = before.count("[") > before.count("]")
        return failure.error(
            'This ")" closes nothing',
            'A branch that begins with "[" ends with "]".' if branch else 'Every ")" needs a "(" before it.',
        )
    if found.startswith(")") and before.endswith("("):
        return failure.error(
            "There is nothing in these parentheses",
            "Write a value there, or leave the parentheses out.",
            failure.start + len(before) - 1,
            failure.at + 2 - failure.start - len(before),
        )
    return None


def second_arrow(failure: ParseFailure) -> ModelSyntaxError | None:
    """An arrow in a rule that has one already."""
    spelling = failure.spelling
    if not spelling.arrows.match(failure.found) or not spelling.arrows.search(failure.before):
        return None
    return failure.error(f"This is a second arrow in one {spelling.rule}", spelling.apart)


def second_comparison(failure: ParseFailure) -> ModelSyntaxError | None:
    """Two comparisons in a row, as in "1 < t < 5"."""
    relation = failure.spelling.relations
    chain = re.search(rf"(?<![\w.])([\w.]++)\s*+({relation})\s*+([\w.]+)$", failure.before[-200:])
    if not chain or not re.match(relation, failure.found):
        return None
    right = re.match(r"\s*([\w.]+)", failure.after[len(failure.found) :])
    twice = f"{chain[1]} {chain[2]} {chain[3]} && {chain[3]} {failure.found} {right[1] if right else '...'}"
    return failure.error("This is a second comparison", f'Compare twice, as in "{twice}".')


def missing_value(failure: ParseFailure) -> ModelSyntaxError | None:
    """A value too few."""
    if failure.accepted >= VALUE_TOKENS and "IDENTIFIER" not in failure.accepted:
        return failure.error("A value is missing here", 'Possible here: a number, a name or "(".')
    return None


def missing_operator(failure: ParseFailure) -> ModelSyntaxError | None:
    """Two values in a row."""
    if re.match(r"[\w(.]", failure.found):
        return failure.error(f"An operator is missing before {quoted(failure.found)}", 'To multiply, type "*", as in "2*t".')
    return None


def value_in_parentheses(failure: ParseFailure) -> ModelSyntaxError | None:
    """A value too few anywhere, or an operator too few in parentheses."""
    inside = unclosed_bracket(failure.before) is not None and "SYMBOL" not in failure.accepted
    return missing_value(failure) or (missing_operator(failure) if inside and re.search(r"[\w)]$", failure.before) else None)


def repetition(failure: ParseFailure) -> ModelSyntaxError | None:
    """A "<" or ">" of a repetition that is missing, or that is not possible."""
    spelling, found = failure.spelling, failure.found
    arrow = spelling.arrows.search(failure.before)
    if arrow is None or "RELATION" in failure.accepted:
        return None
    if failure.accepted == {"LESSTHAN"}:
        return failure.error('A "<" is missing here', spelling.repetition)
    opened = unclosed_bracket(blank_parentheses(failure.before[arrow.end() :]), "<>")
    ended = not found or found in spelling.outside - {"<", ">"} or spelling.arrows.match(found)
    if "MORETHAN" in failure.accepted and opened is not None and ended:
        return failure.error('This "<" is never closed', spelling.repetition, failure.start + arrow.end() + opened, 1)
    if found == ">" and failure.before.endswith("<"):
        return failure.error("Nothing is repeated here", spelling.repetition)
    if found in ("<", ">") and failure.accepted != {"RPAR"}:
        return failure.error(f"I did not expect {quoted(found)} here", spelling.after_arrow)
    return None


def after_first(failure: ParseFailure) -> int:
    """The offset of what follows the first module of a statement."""
    head = re.match(failure.spelling.first_module, failure.statement)
    rest = blank_parentheses(failure.statement)[head.end() if head else 0 :]
    return failure.end - len(rest.lstrip())
