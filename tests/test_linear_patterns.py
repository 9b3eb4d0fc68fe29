"""No regular expression of the kit takes long: what it repeats is repeated for a whole text, and nothing fits behind it.

A run that a pattern can divide in two ways, as in `(a+)+` or `a*b?a*`, is divided in all ways before the pattern gives up;
one that a search tries from each of its characters takes the square of their number. The texts are made from the patterns
themselves.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import reduce
from importlib import import_module
from itertools import product
from operator import or_
from pathlib import Path
from pkgutil import walk_packages
from typing import Any

import pytest

import lsys_kit
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.notation.syntax.diagnostics import _STRETCHES, compiled
from lsys_kit.notation.syntax.parser import _parser
from lsys_kit.notation.syntax.wording import KIT_SPELLING
from tests.pattern_texts import repeats_wrongly, repetitions
from tests.timing import spent

Used = tuple[str, str, int, str]
"""Where a pattern is, its text and its flags, and how it is used: "match", "fullmatch", "search" or "finditer"."""
WAYS = {
    "match": "match",
    "fullmatch": "fullmatch",
    "search": "search",
    "finditer": "finditer",
    "findall": "finditer",
    "sub": "finditer",
    "subn": "finditer",
    "split": "finditer",
}
SIZES = (*range(8, 60, 4), 240, 1_200, 12_000)
"""The short ones show what doubles with each character, before it takes a day."""
SECONDS = 0.012
"""What the longest may take: one microsecond a character, which is dozens of comparisons, and no thousands."""
SOURCES = {
    module.name: Path(import_module(module.name).__file__ or "").read_text(encoding="utf-8")
    for module in walk_packages(lsys_kit.__path__, "lsys_kit.")
}


def named_patterns() -> Iterator[Used]:
    """The patterns that have a name, with each way in which a module uses it, or are in a table that has one."""
    for module, (name, value) in ((each, item) for each in SOURCES for item in vars(import_module(each)).items()):
        for pattern in _patterns_in(value):
            calls = {*re.findall(rf"\b{name}\.(\w+)", SOURCES[module])} & WAYS.keys()
            handed_on = not isinstance(value, re.Pattern) or not (calls or _is_imported(name, SOURCES[module]))
            ways = {"match", "finditer"} if handed_on else {WAYS[call] for call in calls}
            yield from ((f"{module}.{name}", pattern.pattern, pattern.flags, way) for way in ways)


def _is_imported(name: str, source: str) -> bool:
    return re.search(rf"^{name}\b", source, re.MULTILINE) is None


def _patterns_in(value: object) -> Iterator[re.Pattern[str]]:
    if isinstance(value, re.Pattern):
        yield value
    elif isinstance(value, tuple | list | Mapping):
        for each in value.values() if isinstance(value, Mapping) else value:
            yield from _patterns_in(each)


def patterns_in_calls() -> Iterator[Used]:
    """The patterns that are written where they are used, as in `re.match("a*", text, re.IGNORECASE)`."""
    for module, source in SOURCES.items():
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, ast.Call) and ast.unparse(node.func).removeprefix("re.") in WAYS and node.args:
                pattern, way = _written(node.args[0], module), WAYS[ast.unparse(node.func).removeprefix("re.")]
                flags = [re.RegexFlag[each] for each in re.findall(r"\bre\.([A-Z]+)", ast.unparse(node))]
                if pattern:
                    yield f"{module}:{node.lineno}", pattern, reduce(or_, flags, re.RegexFlag(0)), way


def _written(node: ast.expr, module: str) -> str:
    """The text of a pattern, in which "ab" stands for what is known only when it is used."""
    if isinstance(node, ast.Constant):
        return str(node.value)
    parts = node.values if isinstance(node, ast.JoinedStr) else []
    names = vars(import_module(module))
    return "".join(
        str(part.value) if isinstance(part, ast.Constant) else str(names.get(ast.unparse(part)[3:-2], "ab")) for part in parts
    )


def patterns_of_mistakes() -> Iterator[Used]:
    """The patterns of the tables of mistakes, but for those of what is near: they see 200 characters."""
    for dialect in DIALECTS.values():
        for tables in (KIT_SPELLING.tables, dialect.spelling.tables):
            for name, rows in tables.get("mistakes", {}).items():
                for condition, pattern in conditions(rows):
                    if condition in _STRETCHES:
                        found = compiled(f"(?s:{pattern})" if condition == "found" else pattern, dialect.spelling)
                        yield f"{dialect.name}: {name}", found.pattern, found.flags, _STRETCHES[condition][0]


def conditions(rows: Iterable[Mapping[str, Any]]) -> Iterator[tuple[str, Any]]:
    """What rows of mistakes ask for, and their cases."""
    for row in rows:
        yield from row.items()
        if not isinstance(row.get("cases", ""), str):
            yield from conditions(row["cases"])


def tokens() -> Iterator[Used]:
    """The tokens of the grammars."""
    for name, dialect in DIALECTS.items():
        yield from ((f"{name}: {token.name}", token.pattern.to_regexp(), 0, "match") for token in _parser(dialect).terminals)


def slowest(pattern: re.Pattern[str], way: str) -> tuple[float, str]:
    """The processor's seconds for a text that a pattern repeats, up to the first that takes too long."""
    found = 0.0, ""
    for (before, piece), size, after in product(repetitions(pattern), SIZES, ("", "!", "\n\x00")):
        for text in {before + piece * (size // len(piece)) + after, (before + piece) * (size // len(before + piece)) + after}:
            found = max(found, (_seconds(pattern, way, text), f"{before!a} {piece!a} * {size} {after!a}"))
            if found[0] > SECONDS:
                return found
    return found


def _seconds(pattern: re.Pattern[str], way: str, text: str) -> float:
    """What finding all that is looked for takes, at the second try where the first took long."""
    for _ in range(2):
        with spent() as taken:
            for _found in pattern.finditer(text) if way == "finditer" else (getattr(pattern, way)(text),):
                pass
        if taken.seconds <= SECONDS:
            break
    return taken.seconds


@pytest.mark.slow
@pytest.mark.parametrize("patterns", [named_patterns, patterns_in_calls, patterns_of_mistakes, tokens])
def test_what_a_pattern_repeats_takes_linear_time(patterns: Callable[[], Iterator[Used]]) -> None:
    used = {each[1:]: each[0] for each in patterns()}
    assert len(used) > 50
    for text, flags, _ in [each for each in used if each[2] == "finditer"]:
        used.pop((text, flags, "search"), None)  # which is how finding all begins
        used.pop((text, flags, "match"), None)
    times = {(where, text): slowest(re.compile(text, flags), way) for (text, flags, way), where in used.items()}
    assert {where: each for where, each in times.items() if each[0] > SECONDS} == {}


@pytest.mark.slow
@pytest.mark.parametrize("pattern", [r"(?:a+)+b", r"\(\s*(?:\w+\s*,?\s*)*\)", r"x[ \t]*y?[ \t]*:", r"(?:a|b|ab)*c"])
def test_a_run_that_can_be_divided_in_two_ways_is_seen(pattern: str) -> None:
    assert slowest(re.compile(pattern), "match")[0] > SECONDS


@pytest.mark.slow
@pytest.mark.parametrize("pattern", [r"\w+:", r"\w+$", r"\s*axiom", r"(?:ab)+c"])
def test_a_search_that_tries_each_character_of_a_run_is_seen(pattern: str) -> None:
    assert slowest(re.compile(pattern), "search")[0] > SECONDS
    assert slowest(re.compile(pattern), "match")[0] < SECONDS


@pytest.mark.parametrize("pattern", [r",(?![^(]*\))", r"<[^>]*>"])
def test_looking_to_the_end_of_a_text_for_each_that_is_found_is_seen(pattern: str) -> None:
    assert slowest(re.compile(pattern), "finditer")[0] > SECONDS


@pytest.mark.slow
def test_what_is_repeated_possessively_does_not_fail_in_its_middle() -> None:
    """Python 3.11.2, which Debian 12 has, matches such patterns wrongly (its issue 106052): an atomic group is right there."""
    used = {
        (where, text)
        for kind in (named_patterns, patterns_in_calls, patterns_of_mistakes, tokens)
        for where, text, *_ in kind()
    }
    assert [each for each in used if repeats_wrongly(each[1])] == []
