"""A text cut into statements: a line, with the lines that continue it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError, ModelSyntaxError, ModelValueError

ARROW = re.compile(r"-->|->|→|⟶|::=|\\(?:(?:long)?(?:rightarrow|mapsto)|to)(?![A-Za-z])|\\xrightarrow")
_STARTS = re.compile(
    rf"{ARROW.pattern}|^\s*(?:\\?[A-Za-z_]\w*|[ωδ])\s*=(?!=)|^\s*\\?(?:surface[ \t]+\w+|[A-Za-zωδ]+)\s*:(?!.*[<>=])"
)
_CONTINUES = re.compile(rf"({ARROW.pattern}|&&|\|\||(?<!productions)(?<!decomposition)(?<!interpretation):)$", re.IGNORECASE)
_AT_THE_MARGIN, _INDENT = re.compile(r"^\S", re.MULTILINE), re.compile(r"^[^\S\n]*+(?=\S)", re.MULTILINE)
_FILLED_LINE = re.compile(r"^[^\S\n]*+\S.*", re.MULTILINE)
"""A line that is not blank."""
LABEL, OMEGA = r"[pP]_?(?:\d+|\{\d+\})", r"(?:ω|\\omega)"
"""What a printed production is labelled with, and what the axiom is called there."""
PER_RULE = 64
"""The greatest number of characters per production of the limit, without blanks and comments."""


def statements(text: str) -> Iterator[tuple[int, int]]:
    """The offsets of the statements.

    A line continues the one before it where it begins with an arrow, where it is indented and the one before cannot end there,
    or where it is indented and begins nothing of its own.

    >>> text = "A(t) : t < 5\\n  -> B\\nC -> D"
    >>> [text[start:end] for start, end in statements(text)]
    ['A(t) : t < 5\\n  -> B', 'C -> D']
    """
    plain = without_comments(text)
    base = 0 if _AT_THE_MARGIN.search(plain) else min((len(indent) for indent in _INDENT.findall(plain)), default=0)
    start: int | None = None
    end, last = 0, ""
    for match in _FILLED_LINE.finditer(plain):
        offset, line = match.start(), match.group()
        indented = len(line) - len(line.lstrip()) > base
        goes_on = ARROW.match(line.lstrip()) or (indented and (_CONTINUES.search(last) or not _STARTS.search(line)))
        if start is not None and not goes_on:
            yield start, end
        if start is None or not goes_on:
            start = offset + len(line) - len(line.lstrip())
        last = line.rstrip()
        end = offset + len(last)
    if start is not None:
        yield start, end


def without_comments(text: str) -> str:
    """The text with its comments blanked, every other character in its place.

    >>> without_comments("A /* a cell */ -> B")
    'A              -> B'
    """
    parts: list[str] = []
    at = 0
    while (opened := text.find("/*", at)) >= 0:
        closed = text.find("*/", opened + 2)
        if closed < 0:
            raise ModelSyntaxError("This comment is never closed", text, opened, opened + 2, 'A comment ends with "*/".')
        parts += (text[at:opened], re.sub(r"[^\n]", " ", text[opened : closed + 2]))
        at = closed + 2
    return "".join((*parts, text[at:]))


def blank_parentheses(text: str) -> str:
    """The text with parentheses, and what they contain, blanked.

    >>> blank_parentheses("A(max(1, 2)) < B")
    'A            < B'
    """
    depth, kept = 0, []
    for character in text:
        depth = max(0, depth - (character == ")"))
        kept.append(" " if depth or character in "()" else character)
        depth += character == "("
    return "".join(kept)


_PAIRS = ("[", "]"), ("{", "}"), ("(", ")")
_DEEPEST = 1_000
_TURNS = re.compile(r"[-+&^\\/|!\[\]]")
_UNFINISHED = re.compile(rf"(?:[-+&^\\/|!\[]|{ARROW.pattern})$")


def surely_goes_on(line: str, rule: str, known: frozenset[str]) -> bool:
    """Whether a line without a name and an arrow is a part of the production above it, and no number of a page or caption.

    Parameters
    ----------
    line, rule
        The line, and the production as far as it was read.
    known
        The letters and digits that other lines of the system have.

    Examples
    --------
    >>> [surely_goes_on(line, "F→F[+F]F", frozenset("F")) for line in ("[-F]F", "25", "[3]", "/ b", "KOCH")]
    [True, False, False, False, False]
    >>> surely_goes_on("FF", "F→FF", frozenset("F")), surely_goes_on("F", "F→FF", frozenset("F"))
    (True, False)
    """
    word = blank_parentheses(line).strip()
    letters = [sign for sign in word if sign.isalnum()]
    if _is_open(rule):
        return not (letters and "".join(letters).isdigit() and not {*letters} <= known)
    if len(letters) > 1:
        named = any(sign.isalpha() and sign in known for sign in letters)
        return ({*letters} <= known and not word.isdigit()) or bool(
            named and _TURNS.search(word) and not _UNFINISHED.search(rule.rstrip())
        )
    return {*letters} <= known and bool(letters) and " " not in word and bool(_TURNS.search(word) or "(" in line)


def is_unfinished(rule: str) -> bool:
    """Whether something must follow what was read of a production: a bracket is open, or a turn stands at its end.

    >>> is_unfinished("F→F[+F"), is_unfinished("F→F-"), is_unfinished("F→F")
    (True, True, False)
    """
    return _is_open(rule) or _UNFINISHED.search(rule.rstrip()) is not None


def _is_open(rule: str) -> bool:
    return any(rule.count(opened) > rule.count(closed) for opened, closed in _PAIRS)


def pending(rule: str) -> str:
    """What of a production decides whether something must follow: the brackets that are open, and its end.

    >>> pending("F→F[+F[-F]FFFFFFFFFFFFFFFFFFFFF")
    '[FFFFFFFFFFFFFFFF'
    """
    opened = (each[0] * min(rule.count(each[0]) - rule.count(each[1]), _DEEPEST) for each in _PAIRS)
    return f"{''.join(opened)}{re.sub(r'[][(){}]', '', rule.rstrip()[-16:])}"


def check_text(text: str) -> None:
    """Refuse anything but text, and text that is too long."""
    if not isinstance(text, str):
        raise ModelValueError(f"A model is read from text, not from {type(text).__name__}")
    if len(text) > current().text:
        raise ModelLimitError(
            f"The text has {len(text):,} characters; the limit is {current().text:,}", limit=current().text, needed=len(text)
        )


def bounded(statements: Iterator[tuple[int, int]], text: str) -> list[tuple[int, int]]:
    """The statements, if they are neither too many nor together too long."""
    lines, most = 2 * current().rules, max(current().line, PER_RULE * current().rules)
    found = [*islice(statements, lines + 1)]
    if len(found) > lines:
        raise ModelLimitError(
            f"The model has more than {lines:,} lines that are not blank", limit=lines, source=text, start=found[-1][0]
        )
    characters = 0
    for start, end in found:
        characters += len("".join(text[start:end].split()))
        if characters > most:
            raise ModelLimitError(
                f"The model has more than {most:,} characters, without blanks and comments",
                limit=most,
                source=text,
                start=start,
            )
    return found
