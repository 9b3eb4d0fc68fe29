"""The mathematical form, as articles print it: `p_1 : a_r → a_l b_r`, `{ar -> al br, al -> bl ar}`, `s < a > → a s,`.

Labels and separators are not part of a production: they are cut off before a grammar reads the rest.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.syntax.text.statements import ARROW, LABEL, blank_parentheses, statements, without_comments

# What labels and sets of productions look like, and what cannot follow a label.
_LABEL = re.compile(rf"({LABEL})[ \t]*:[ \t]*")
_LABELLED = re.compile(rf"^[ \t]*{_LABEL.pattern}", re.MULTILINE)
_SET_OPENING = re.compile(r"(?:P[ \t]*=[ \t]*)?\{(?=\s*[A-Za-z\\(])")
IN_A_SET = re.compile(rf"^[ \t]*{_SET_OPENING.pattern}", re.MULTILINE)
_RELATION = re.compile(r"[<>=!]=|&&|\|\||[≤≥≠∧∨]|\\[lgn]eq?\b")
_TWO_NAMES = re.compile(r"\s*(?!not\b)[A-Za-z_]\w*\s+(?!and\b|or\b)[A-Za-z_]")
_BRACKET_OR_COMMA = re.compile(r"[()\[\]{},]")


def printed_statements(text: str) -> Iterator[tuple[int, int]]:
    """The offsets of the statements, without their labels and separators.

    >>> text = "p_1: a -> b,\\nP = {b -> a, c -> b}"
    >>> [text[start:end] for start, end in printed_statements(text)]
    ['a -> b', 'b -> a', 'c -> b']
    """
    plain = without_comments(text)
    used = frozenset(re.findall(r"\b\w++(?!\s*:)", plain)) if _LABELLED.search(plain) else frozenset()
    for start, end in _members(plain, text):
        label = _LABEL.match(plain, start, end)
        if label and _is_label(plain[label.end() : end], label[1] in used):
            start = label.end()
        if plain[end - 1] == ",":
            rule = plain[start : end - 1].rstrip()
            arrow = ARROW.search(rule)
            end = start + len(rule) if arrow and arrow.end() < len(rule) else end
        yield start, end


def _is_label(rest: str, used: bool) -> bool:
    """Whether a name with a colon after it labels a production, and is not a module with a condition."""
    arrow = ARROW.search(rest)
    head = rest[: arrow.start()] if arrow else ""
    bare = blank_parentheses(head)
    if ":" in bare or _TWO_NAMES.match(bare):
        return True
    if head.strip() in ("", "*") or _RELATION.search(head) or re.search(r"\([^()]*[<>]", head):
        return False
    sides = re.split("[<>]", bare)
    numbers = any(re.search(r"(?<![\w.])[\d.]", side) for side in sides)
    return len(sides) == 1 or not (numbers or (used and all(map(str.strip, sides))))


def _members(plain: str, source: str) -> Iterator[tuple[int, int]]:
    """The offsets of the statements, those of a set of productions one after another."""
    opened, first, depth = None, 0, 0
    for start, end in statements(source):
        if opened is None:
            opened = _SET_OPENING.match(plain, start)
            first, depth = start, 0
        if opened is None:
            yield start, end
            continue
        depth += plain.count("{", start, end) - plain.count("}", start, end)
        if depth <= 0:
            closed = plain[end - 1] == "}" and ARROW.search(plain, first, end)
            yield from _split_at_commas(plain, opened.end(), end - 1) if closed else [(first, end)]
            opened = None
    if opened is not None:
        raise ModelSyntaxError(
            'This "{" is never closed', source, opened.end() - 1, opened.end(), 'Every "{" needs a "}" after it.'
        )


def _split_at_commas(plain: str, start: int, end: int) -> Iterator[tuple[int, int]]:
    """The offsets between commas that are not in brackets."""
    depth = 0
    for match in (*_BRACKET_OR_COMMA.finditer(plain, start, end), None):
        if match is None or (match[0] == "," and depth == 0):
            member = plain[start : match.start() if match else end]
            if member.strip():
                yield start + len(member) - len(member.lstrip()), start + len(member.rstrip())
            start += len(member) + 1
        else:
            depth += (match[0] in "([{") - (match[0] in ")]}")
