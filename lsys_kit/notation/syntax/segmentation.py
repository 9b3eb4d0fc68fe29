"""Letters written together: `F -> FF` means two segments, `ar -> al br` means two cells of two letters each.

Books glue one-letter symbols together; the kit's notation has symbols of several letters. A name of several letters that
no production rewrites, and that can be divided in just one way into symbols that the system has, is read as those symbols.
Where productions rewrite single letters alone, so is a row of letters with capitals behind the first, one of which the system
knows: in `A -> BA` the B is new, in `A -> aAA` the a. A word, as `Bud` beside `B`, stays whole. Both ways are noted wherever
the other could be meant, with what to type for it: an `alphabet:` line keeps a name whole, blanks divide it.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

from lsys_kit.notation.analysis.checks import check_shorter
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.model.modules import ItemT, Pattern, flat, rewritten
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS

_NAME, _ROW = re.compile(r"[A-Za-z_]\w+"), re.compile(r"[A-Za-z][a-z]*+[A-Z][A-Za-z]*+")
"""A name of several signs; and one that is a row of letters rather than a word."""
_NUMBERED = re.compile(r"(?:[Ff](\d+)|[A-Za-z](\d+)[A-Za-z]\w*)")
"""The turtle's own letter with digits behind it, or any letter with digits and more: elsewhere a length, a colour, a count."""
_ALWAYS = frozenset("Ff")
"""The turtle's own letters: symbols of every system (ABOP, section 1.3)."""


class _Known(NamedTuple):
    """The symbols of a system: those that stay whole, those of which a name may be made, and whether all are single letters."""

    whole: frozenset[str]
    parts: frozenset[str]
    letters: bool


def segment_word(word: Iterable[ItemT], system: LSystem) -> tuple[ItemT, ...]:
    """A word with its glued names divided as in a system.

    >>> from lsys_kit.notation.read import read
    >>> [str(module) for module in segment_word(read("axiom: ba").axiom, read("axiom: a\\na -> ab\\nb -> a"))]
    ['b', 'a']
    """
    word = tuple(word)
    return _segmented(word, _glued(flat(word), _known(system)))


def segment_system(system: LSystem) -> tuple[LSystem, dict[str, list[str]]]:
    """A system with its glued names divided, and the symbols of each.

    The symbols of one name may divide another: names are divided until none is left.

    >>> from lsys_kit.notation.read import read
    >>> segment_system(replace(read("axiom: F\\nF -> F J J"), axiom=(Pattern("JF"),)))[1]
    {'JF': ['J', 'F']}
    """
    made: dict[str, list[str]] = {}
    while found := _glued(_divisible_modules(system), _known(system)):
        made |= found
        system = replace(
            system,
            axiom=_segmented(system.axiom, found),
            productions=_segmented_rules(system.productions, found),
            decomposition=_segmented_rules(system.decomposition, found),
            interpretation=_segmented_rules(system.interpretation, found),
            meta=tuple(replace(rule, successor=_segmented(rule.successor, found)) for rule in system.meta),
        )
    return system, made


def segment_with_notes(system: LSystem) -> LSystem:
    """What `segment_system` makes of a system, with a note for each name that was divided."""
    segmented, made = segment_system(system)
    for rule in segmented.meta:
        check_shorter(rule)
    notes = [f'"{name}" is read as {" ".join(pieces)}.' for name, pieces in made.items()]
    notes += [
        f'"{name}" is read as one symbol; for several put blanks between them: {" ".join(pieces)}.'
        for name, pieces in _words(segmented)
    ]
    notes += [
        f'"{name}" is read as one symbol, which draws nothing. {name[0]} with a value is typed {name[0]}({digits}); '
        'what is repeated is written out, as in "+++".'
        for name, digits in _numbered(segmented)
    ]
    return replace(segmented, notes=(*system.notes, *notes)) if notes else system


def _words(system: LSystem) -> Iterator[tuple[str, list[str]]]:
    """The names that stay whole and may be meant otherwise, each with the symbols that it would be."""
    known = _known(system)
    for name in _names(system):
        if name not in known.whole and len(name) > 1 and name.isascii() and name.isalpha():
            if ways := _ways(name, known.parts):
                yield name, ways[0]
            elif known.letters and (_ROW.fullmatch(name) or not known.parts.isdisjoint(name)):
                yield name, list(name)


def _names(system: LSystem) -> Iterator[str]:
    """The symbols that may be glued; behind "~" stands the name of a surface, which is none."""
    modules = [Pattern(""), *_divisible_modules(system)]
    yield from dict.fromkeys(module.symbol for before, module in pairwise(modules) if before.symbol != "~")


def _numbered(system: LSystem) -> Iterator[tuple[str, str]]:
    """The names with digits in them that may be meant otherwise, in a system whose other symbols are single letters."""
    known = _known(system)
    if known.letters:
        for name in _names(system):
            if name not in known.whole and (found := _NUMBERED.fullmatch(name)):
                yield name, found[1] or found[2]


def check_digits(word: Iterable[Pattern], alphabet: Collection[str]) -> None:
    """Refuse digits that are not declared as symbols: they are values outside of parentheses."""
    alone = next((module for module in word if module.symbol.isdigit() and module.symbol not in alphabet), None)
    if alone:
        raise problem("number in word", alone.at)


def _divisible_modules(system: LSystem) -> Iterable[Pattern]:
    """The modules that may be glued: a predecessor is what it is."""
    yield from system.axiom
    for rule in system.rules:
        yield from (*rule.left, *rule.right, *flat(rule.successor))
    for meta in system.meta:
        yield from flat(meta.successor)


def _segmented_rules(rules: Iterable[Production], made: dict[str, list[str]]) -> tuple[Production, ...]:
    return tuple(
        replace(
            rule,
            left=_segmented(rule.left, made),
            right=_segmented(rule.right, made),
            successor=_segmented(rule.successor, made),
        )
        for rule in rules
    )


def _segmented(word: Iterable[ItemT], made: dict[str, list[str]]) -> tuple[ItemT, ...]:
    """The word with its glued names divided; the arguments of a name go to its last symbol."""

    def pieces(module: Pattern) -> Iterable[Pattern]:
        *first, last = made.get(module.symbol, (module.symbol,))
        return (*(Pattern(symbol, at=module.at) for symbol in first), replace(module, symbol=last)) if first else (module,)

    return rewritten(word, pieces, lambda count: count)


def _glued(modules: Iterable[Pattern], known: _Known) -> dict[str, list[str]]:
    """The glued names among some modules, and the symbols of which each is made."""
    names = dict.fromkeys(each.symbol for each in modules if each.symbol not in known.whole and _NAME.fullmatch(each.symbol))
    return {name: pieces for name in names if (pieces := _symbols_of_name(name, known))}


def _known(system: LSystem) -> _Known:
    rewritten = {module.symbol for rule in system.rules for module in rule.predecessors}
    rewritten |= {module.symbol for rule in system.meta for module in rule.predecessors}
    shown = [m.symbol for m in (*system.axiom, *(m for rule in system.rules for m in rule.modules))]
    whole = rewritten | set(system.alphabet) | {surface.name for surface in system.surfaces}
    letters = not TURTLE_DIALECTS[system.turtle].names and all(len(symbol) == 1 for symbol in whole)
    return _Known(frozenset(whole), frozenset(whole | {symbol for symbol in shown if len(symbol) == 1} | _ALWAYS), letters)


def _symbols_of_name(name: str, known: _Known) -> list[str]:
    """The symbols that make a name; none where it is a symbol of its own."""
    if known.letters:
        row = _ROW.fullmatch(name) and not known.parts.isdisjoint(name)
    else:
        row = name.isalpha() and name.isupper() and not known.whole.isdisjoint(name)
    ways = _ways(name, known.parts)
    return ways[0] if len(ways) == 1 else list(name) if row and not ways else []


def _ways(name: str, parts: frozenset[str]) -> list[list[str]]:
    """The ways to divide a name into symbols, two at most."""
    ways: list[list[list[str]]] = [[[]]]
    for end in range(1, len(name) + 1):
        found = [
            [*way, name[start:end]]
            for start in range(max(0, end - 64), end)
            if name[start:end] in parts
            for way in ways[start][:2]
        ]
        ways.append(found[:2])
    return ways[-1]
