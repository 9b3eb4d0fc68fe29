"""Syntax errors explained to the person who typed the text.

A parser knows which token it did not expect; a student wants to know what is missing. The tables of `mistakes.toml` say so:
those of the dialect, and those of this folder, which the dialects share. A dialect names the tables in which the place of a
failure is looked up, the most specific first. A table is a list of rows; the first row whose conditions all hold is the error.

    accepts, any, lacks, only, not_only, not_all
        Tokens with which the parser could have gone on: all of these, one or more, none; these alone, not these alone, not all.
    found, before, after, next, line, near
        Patterns of what was found, of the statement up to it, from it on, behind it, of the line before it, of what is around.
    statement, head, outside, inside, within
        Patterns of the statement, of what precedes its arrow, of what precedes the place outside of parentheses, of the name
        before the innermost bracket, in capitals, and of what stands from that bracket to the place.
    arrow
        Where the arrow is: "before" the place or "not before", "ahead", or in the statement there is "no".
    open, shut; unclosed, closed
        Pairs of brackets of which one is open at the place, or none; of which one is never closed in the statement, or none.
    keyword, likeness; known
        The part of a pattern that may be a keyword; how much it must be like one. Whether it is the "same", the "other" that
        was meant, "any" of both, or "none".
    says, hint; at, to, length; cases
        The message and the hint; where the mark begins and how long it is, unless it is what was found; rows with more
        conditions, or the name of their table, to which all this is handed on.

In patterns, words in capitals stand for those of `[patterns]`; in messages, words in braces for those of `[words]`, the parts
that patterns have named, and what else is known of the place.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from functools import cache
from typing import Any

from lark.exceptions import UnexpectedInput

from lsys_kit.errors import ModelSyntaxError, named
from lsys_kit.files import Entries
from lsys_kit.notation.analysis.problems import Problem
from lsys_kit.notation.syntax.dialect import Diagnostic, Grammar
from lsys_kit.notation.syntax.failure import ParseFailure, excerpt, expected_hint, parse_failure, quoted, unclosed_bracket
from lsys_kit.notation.syntax.text.statements import blank_parentheses
from lsys_kit.notation.syntax.wording import KIT_SPELLING, Spelling, translated, worded
from lsys_kit.translation import gettext

BRACKETS = "[](){}"
"""All pairs of brackets."""
_SAID = ("says", "hint", "at", "to", "length")
_TOKENS: Mapping[str, Callable[[frozenset[str], frozenset[str]], bool]] = {
    "accepts": lambda accepted, asked: asked <= accepted,
    "any": lambda accepted, asked: bool(asked & accepted),
    "lacks": lambda accepted, asked: not asked & accepted,
    "only": lambda accepted, asked: asked == accepted,
    "not_only": lambda accepted, asked: asked != accepted,
    "not_all": lambda accepted, asked: not asked <= accepted,
}
_STRETCHES: Mapping[str, tuple[str, Callable[[ParseFailure], tuple[str, int]]]] = {
    "found": ("fullmatch", lambda failure: (failure.found, failure.at)),
    "before": ("search", lambda failure: (failure.before, failure.start)),
    "after": ("match", lambda failure: (failure.after, failure.at)),
    "next": ("match", lambda failure: (failure.after[len(failure.found) :], failure.at + len(failure.found))),
    "line": ("fullmatch", lambda failure: (failure.text[failure.text.rfind("\n", 0, failure.at) + 1 : failure.at], 0)),
    "statement": ("search", lambda failure: (failure.statement, failure.start)),
    "head": ("search", lambda failure: (_head(failure), failure.start)),
    "outside": ("search", lambda failure: (blank_parentheses(failure.before), failure.start)),
    "inside": ("fullmatch", lambda failure: (innermost_bracket(failure)[0], 0)),
    "within": ("fullmatch", lambda failure: (_within(failure), 0)),
}
"""For each kind of pattern how it is used, and the stretch of the text that it is for, with its offset."""


class _Piece(str):
    """A piece of the text in a message: "quoted", an "excerpt" of it, its "first" character with its name, in "lower" case."""

    __slots__ = ()

    def __format__(self, form: str) -> str:
        return _FORMS[form](self)


_FORMS: Mapping[str, Callable[[str], str]] = {
    "": str,
    "quoted": quoted,
    "excerpt": lambda text: excerpt(text.rstrip()),
    "first": lambda text: named(text[0]),
    "lower": str.lower,
}


@dataclass(frozen=True)
class _Seen:
    """What the conditions of a row have found: parts of the text by their names, where they are, and how known a keyword is."""

    tables: Entries
    parts: dict[str, str] = field(default_factory=dict)
    spans: dict[str, tuple[int, int]] = field(default_factory=dict)


def diagnose(unexpected: UnexpectedInput, source: str, start: int, end: int, notation: Grammar) -> ModelSyntaxError:
    """What is wrong with the statement between two offsets, as an error with its place and a hint."""
    failure = parse_failure(unexpected, source, notation.bare(source), start, end, notation.spelling)
    every = (*notation.diagnostics, "anything_else")
    errors = (explained(failure, each) if isinstance(each, str) else each(failure) for each in every)
    return next(error for error in errors if error is not None)


def explained(failure: ParseFailure, table: str) -> ModelSyntaxError | None:
    """The error of the first row of a table that fits; None where none does."""
    tables = failure.spelling.tables
    tables = tables if table in tables.get("mistakes", {}) else KIT_SPELLING.tables
    return _first(tables["mistakes"][table], failure, _Seen(tables))


def _first(rows: Iterable[Entries], failure: ParseFailure, before: _Seen) -> ModelSyntaxError | None:
    for row in rows:
        seen = _Seen(before.tables, {**before.parts}, {**before.spans})
        if not all(_holds(condition, asked, failure, seen, row) for condition, asked in row.items()):
            continue
        cases = row.get("cases")
        if cases is None:
            return _error(row, failure, seen)
        said = {key: row[key] for key in _SAID if key in row}
        if isinstance(cases, str):
            cases = {**KIT_SPELLING.tables["mistakes"], **failure.spelling.tables["mistakes"]}[cases]
        error = _first(({**said, **case} for case in cases), failure, seen)
        if error is not None:
            return error
    return None


def _holds(condition: str, asked: Any, failure: ParseFailure, seen: _Seen, row: Entries) -> bool:
    """Whether a condition holds; what it finds is kept."""
    if condition in _TOKENS:
        return _TOKENS[condition](failure.accepted, frozenset(asked))
    if condition in _STRETCHES:
        return _matches(condition, asked, failure, seen)
    if condition == "near":
        return _is_near(asked, failure, seen)
    if condition == "arrow":
        place = "before" if _arrow(failure, failure.at) else "ahead" if _arrow(failure) else "no"
        return bool(asked == place or (asked == "not before" and place != "before"))
    if condition in ("open", "shut", "unclosed", "closed"):
        return _is_open(condition, asked, failure, seen) == (condition in ("open", "unclosed"))
    if condition == "keyword":
        seen.parts.update(_keyword(seen.parts[asked], seen.tables, row.get("likeness", 0.75)))
    if condition == "known":
        return bool(asked == seen.parts["known"] or (asked == "any" and seen.parts["known"] != "none"))
    return True


def _matches(condition: str, pattern: str, failure: ParseFailure, seen: _Seen) -> bool:
    way, stretch = _STRETCHES[condition]
    text, offset = stretch(failure)
    match = getattr(compiled(f"(?s:{pattern})" if condition == "found" else pattern, failure.spelling), way)(text)
    return match is not None and _keep(match, offset, seen)


def _keep(match: re.Match[str], offset: int, seen: _Seen) -> bool:
    """Keep the parts that a pattern has named."""
    seen.parts.update(match.groupdict(""))
    seen.spans.update({name: (offset + match.start(name), offset + match.end(name)) for name in match.groupdict()})
    return True


def _is_near(pattern: str, failure: ParseFailure, seen: _Seen) -> bool:
    first, last = max(failure.start, failure.at - 6), min(failure.end, failure.at + 200)
    for match in compiled(pattern, failure.spelling).finditer(failure.text, first, last):
        if match.start() <= failure.at <= match.end():
            seen.spans["near"] = match.span()
            return True
    return False


def _is_open(condition: str, pairs: str, failure: ParseFailure, seen: _Seen) -> bool:
    """Whether a bracket is open; in pairs of "<" and ">", those behind the arrow and outside of parentheses count."""
    whole = condition in ("unclosed", "closed")
    text, offset = failure.statement if whole else failure.before, failure.start
    if pairs == "<>":
        offset = (_arrow(failure) or (0, failure.start))[1]
        text = blank_parentheses(text[offset - failure.start :])
    at = unclosed_bracket(text, pairs)
    if at is None:
        return False
    seen.parts.update({"open": text[at], "close": pairs[pairs.index(text[at]) + 1]})
    seen.spans[condition] = (offset + at, offset + at + 1)
    return True


def _keyword(typed: str, tables: Entries, likeness: float) -> dict[str, str]:
    """The keyword that was meant, an example of what follows it, and how known it is."""
    name = " ".join(typed.lower().split())
    keywords = {keyword.lower(): keyword for keyword in tables["keywords"]}
    meant = tables["synonyms"].get(name) or next(
        (keywords[like] for like in get_close_matches(name, keywords, 1, likeness)), None
    )
    if meant is None:
        return {"known": "none"}
    known = "same" if meant.lower() == name else "other"
    return {"known": known, "meant": meant, "example": tables["keywords"].get(meant, "")}


def _error(row: Entries, failure: ParseFailure, seen: _Seen) -> ModelSyntaxError:
    parts = {**seen.parts, "found": failure.found, "before": failure.before, "possible": expected_hint(failure.accepted) or ""}
    words = {**translated(failure.spelling.words), **{name: _Piece(part) for name, part in parts.items()}}
    start, end = _span(row, failure, seen)
    end = {"here": failure.at + 1, "place": failure.at}.get(row.get("to", ""), end)
    says, hint = (gettext(row.get(part, "")).format_map(words) for part in ("says", "hint"))
    return failure.error(says, hint or None, start, row.get("length") or max(0, end - start))


def _span(row: Entries, failure: ParseFailure, seen: _Seen) -> tuple[int, int]:
    """Where the mark begins and ends; where it ends as it begins, it is as long as what was found."""
    at = row.get("at", "near" if "near" in row else "")
    if at == "second":
        return (after_first(failure),) * 2
    return {"": (failure.at, 0), "start": (failure.start, 0), "arrow": _arrow(failure) or (0, 0), **seen.spans}[at]


@cache
def compiled(pattern: str, spelling: Spelling) -> re.Pattern[str]:
    """A pattern of a table, with those of the dialect in the place of their names."""
    names = rf"\b(?:{'|'.join(spelling.patterns)})\b"
    return re.compile(re.sub(names, lambda name: f"(?:{spelling.patterns[name[0]]})", pattern))


def _arrow(failure: ParseFailure, end: int | None = None) -> tuple[int, int] | None:
    """The offsets of the first arrow of the statement, or of what stands before an offset."""
    match = compiled("ARROW", failure.spelling).search(failure.text, failure.start, failure.end if end is None else end)
    return match and match.span()


def _head(failure: ParseFailure) -> str:
    arrow = _arrow(failure)
    return failure.text[failure.start : arrow[0]] if arrow else ""


def innermost_bracket(failure: ParseFailure) -> tuple[str, int | None]:
    """The last bracket that is open at the place: the name before it, in capitals, and its offset."""
    opened = unclosed_bracket(failure.before, BRACKETS)
    if opened is None:
        return "", None
    word = re.search(r"(?<!\w)\w*+$", failure.before[:opened].rstrip())
    return (word[0].upper() if word else ""), failure.start + opened


def _within(failure: ParseFailure) -> str:
    at = innermost_bracket(failure)[1]
    return "" if at is None else failure.text[at : failure.at + len(failure.found)]


def after_first(failure: ParseFailure) -> int:
    """The offset of what follows the first module of a statement."""
    head = compiled("FIRST", failure.spelling).match(failure.statement)
    rest = blank_parentheses(failure.statement)[head.end() if head else 0 :]
    return failure.end - len(rest.lstrip())


_CONDITION = re.compile(r"(if|when)\b|(\w+)\s*(<=|>=|==|!=|[<>=≤≥≠]|\\[lgn]eq?)\s*(\w+|\S?)")


def condition_without_colon(failure: ParseFailure) -> ModelSyntaxError | None:
    """A condition without its ":": a comparison of a parameter, or with a number."""
    arrow, second = _arrow(failure), after_first(failure)
    if arrow is None or failure.at > arrow[0] or ":" in failure.before or failure.statement.startswith("meta"):
        return None
    found = _CONDITION.match(failure.text, second, arrow[0])
    if not found or not {"COLON", "LESSTHAN", "NAME"} & failure.accepted:
        return None
    parameters = re.findall(r"\w+", failure.text[failure.start : second])[1:]
    if found[1] or found[3] not in "<>" or {found[2], found[4]} & {*parameters} or found[4][:1].isdigit():
        return failure.error(*worded(Problem("condition without colon"), failure.spelling), second)
    return None


DIAGNOSTICS: Sequence[Diagnostic] = (
    "foreign_comment",
    "repeat",
    "repetition",
    "choice",
    "keyword",
    "braces",
    "parentheses",
    "second_arrow",
    "arrows",
    "misspelling",
    "unreadable_character",
    "predecessor",
    condition_without_colon,
    "contexts",
    "second_comparison",
    "in_a_word",
    "production_with_equals",
    "equals",
    "missing_value",
    "missing_operator",
    "constant_declaration",
)
"""Where the mistakes in the kit's own notation and in plant strings are looked up, the most specific first."""
