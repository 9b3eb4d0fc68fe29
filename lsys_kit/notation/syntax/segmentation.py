"""Letters written together: `F -> FF` means two segments, `ar -> al br` means two cells of two letters each.

Books glue one-letter symbols together; the kit's notation has symbols of several letters. A name of several letters that
no production rewrites, and that can be divided in just one way into symbols that the system has, is read as those symbols; so
is a row of capital letters, one of which a production rewrites: in `A -> BA` the B is new. An `alphabet:` line keeps a name
whole.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from dataclasses import replace
from typing import Any

from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.model.modules import Item, Pattern, Repeat, flat
from lsys_kit.notation.model.system import LSystem, Production

_NAME = re.compile(r"[A-Za-z_]\w+")
_ALWAYS = frozenset("Ff")
"""The turtle's own letters: symbols of every system (ABOP, section 1.3)."""


def segment_word(word: Iterable[Item], system: LSystem) -> tuple[Any, ...]:
    """A word with its glued names divided as in a system.

    >>> from lsys_kit.notation.read import read
    >>> [str(module) for module in segment_word(read("axiom: ba").axiom, read("axiom: a\\na -> ab\\nb -> a"))]
    ['b', 'a']
    """
    word = tuple(word)
    return _segmented(word, _glued(flat(word), *_whole_and_parts(system)))


def segment_system(system: LSystem) -> tuple[LSystem, dict[str, list[str]]]:
    """A system with its glued names divided, and the symbols of each.

    The symbols of one name may divide another: names are divided until none is left.

    >>> from lsys_kit.notation.read import read
    >>> segment_system(replace(read("axiom: F\\nF -> F J J"), axiom=(Pattern("JF"),)))[1]
    {'JF': ['J', 'F']}
    """
    made: dict[str, list[str]] = {}
    while found := _glued(_divisible_modules(system), *_whole_and_parts(system)):
        made |= found
        system = replace(system, axiom=_segmented(system.axiom, found), productions=_segmented_rules(system.productions, found),
                         decomposition=_segmented_rules(system.decomposition, found),
                         interpretation=_segmented_rules(system.interpretation, found),
                         meta=tuple(replace(rule, successor=_segmented(rule.successor, found)) for rule in system.meta))
    return system, made


def segment_with_notes(system: LSystem) -> LSystem:
    """What `segment_system` makes of a system, with a note for each name that was divided."""
    segmented, made = segment_system(system)
    notes = (f'"{name}" is read as {" ".join(pieces)}.' for name, pieces in made.items())
    return replace(segmented, notes=(*system.notes, *notes)) if made else system


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
    return tuple(replace(rule, left=_segmented(rule.left, made), right=_segmented(rule.right, made),
                         successor=_segmented(rule.successor, made)) for rule in rules)


def _segmented(word: Iterable[Item], made: dict[str, list[str]]) -> tuple[Any, ...]:
    """The word with its glued names divided; the arguments of a name go to its last symbol."""
    result: list[Item] = []
    for module in word:
        if isinstance(module, Repeat):
            result.append(replace(module, body=_segmented(module.body, made)))
        elif pieces := made.get(module.symbol):
            result += [Pattern(symbol, at=module.at) for symbol in pieces[:-1]]
            result.append(replace(module, symbol=pieces[-1]))
        else:
            result.append(module)
    return tuple(result)


def _glued(modules: Iterable[Pattern], whole: frozenset[str], parts: frozenset[str]) -> dict[str, list[str]]:
    """The glued names among some modules, and the symbols of which each is made."""
    names = dict.fromkeys(module.symbol for module in modules if module.symbol not in whole and _NAME.fullmatch(module.symbol))
    return {name: pieces for name in names if (pieces := _symbols_of_name(name, whole, parts))}


def _whole_and_parts(system: LSystem) -> tuple[frozenset[str], frozenset[str]]:
    """The names that stay whole, and the symbols of which a name may be made."""
    rewritten = {module.symbol for rule in system.rules for module in rule.predecessors}
    rewritten |= {module.symbol for rule in system.meta for module in rule.predecessors}
    shown = [m.symbol for m in (*system.axiom, *(m for rule in system.rules for m in rule.modules))]
    whole = rewritten | set(system.alphabet) | {surface.name for surface in system.surfaces}
    return frozenset(whole), frozenset(whole | {symbol for symbol in shown if len(symbol) == 1} | _ALWAYS)


def _symbols_of_name(name: str, whole: frozenset[str], parts: frozenset[str]) -> list[str]:
    """The symbols that make a name; none where it is a symbol of its own."""
    capitals = name.isalpha() and name.isupper() and not whole.isdisjoint(name)
    return _unique_split(name, parts) or (list(name) if capitals else [])


def _unique_split(name: str, parts: frozenset[str]) -> list[str]:
    """The one way to divide a name into symbols; nothing where there is none or more than one."""
    ways: list[list[list[str]]] = [[[]]]
    for end in range(1, len(name) + 1):
        found = [[*way, name[start:end]] for start in range(max(0, end - 64), end) if name[start:end] in parts
                 for way in ways[start][:2]]
        ways.append(found[:2])
    return ways[-1][0] if len(ways[-1]) == 1 else []
