"""Letters written together: `F -> FF` means two segments, `ar -> al br` means two cells of two letters each.

Books glue one-letter symbols together; the kit's notation has symbols of several letters. A name of several letters that
no production rewrites, and that can be parted in just one way into symbols that the system has, is read as those symbols; so
is a row of capital letters, one of which a production rewrites: in `A -> BA` the B is new. An `alphabet:` line keeps a name
whole.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import TypeAlias

from lsys_kit.notation.model import Item, LSystem, Module, Repeat

_ALWAYS = frozenset("Ff")
"""The turtle's own letters: symbols of every system (ABOP, section 1.3)."""
Parting: TypeAlias = Callable[[Iterable[Item]], tuple[tuple[Item, ...], list[str]]]
"""What parts the glued names of a word; with the word come notes on what was parted."""


def unglued(word: Iterable[Item], system: LSystem) -> tuple[tuple[Item, ...], list[str]]:
    """A word with its glued names parted, and a note for each name that was.

    >>> from lsys_kit.notation.read import read
    >>> read("axiom: a\\na -> ab\\nb -> a").productions[0].successor
    (Module(symbol='a', arguments=()), Module(symbol='b', arguments=()))
    """
    return parting(system)(word)


def parting(system: LSystem) -> Parting:
    """What parts the glued names of any word of a system."""
    whole, parts = _symbols(system)
    return partial(_parted, whole, parts)


def _parted(whole: frozenset[str], parts: frozenset[str], word: Iterable[Item]) -> tuple[tuple[Item, ...], list[str]]:
    """The word with its glued names parted, and a note for each."""
    result: list[Item] = []
    notes: list[str] = []
    for module in word:
        if isinstance(module, Repeat):
            body, said = _parted(whole, parts, module.body)
            result.append(replace(module, body=body))
            notes += said
            continue
        pieces = [] if len(module.symbol) < 2 or module.symbol in whole else _pieces(module.symbol, whole, parts)
        if not pieces:
            result.append(module)
            continue
        result += [Module(symbol, at=module.at) for symbol in pieces[:-1]]
        result.append(replace(module, symbol=pieces[-1]))
        notes.append(f'"{module.symbol}" is read as {" ".join(pieces)}.')
    return tuple(result), notes


def _symbols(system: LSystem) -> tuple[frozenset[str], frozenset[str]]:
    """The names that stay whole, and the symbols of which a name may be made."""
    rewritten = {rule.predecessor.symbol for rule in system.rules}
    rewritten |= {module.symbol for rule in system.meta for module in rule.predecessors}
    shown = [m.symbol for m in (*system.axiom, *(m for rule in system.rules for m in rule.modules))]
    whole = rewritten | set(system.alphabet)
    return frozenset(whole), frozenset(whole | {symbol for symbol in shown if len(symbol) == 1} | _ALWAYS)


def _pieces(name: str, whole: frozenset[str], parts: frozenset[str]) -> list[str]:
    """The symbols that a name stands for; nothing where it is a symbol of its own."""
    capitals = name.isalpha() and name.isupper() and not whole.isdisjoint(name)
    return _partings(name, parts) or (list(name) if capitals else [])


def _partings(name: str, parts: frozenset[str]) -> list[str]:
    """The one way to part a name into symbols, or nothing where there is none or more than one."""
    ways: list[list[list[str]]] = [[[]]]
    for end in range(1, len(name) + 1):
        found = [[*way, name[start:end]] for start in range(max(0, end - 64), end) if name[start:end] in parts
                 for way in ways[start][:2]]
        ways.append(found[:2])
    return ways[-1][0] if len(ways[-1]) == 1 else []
