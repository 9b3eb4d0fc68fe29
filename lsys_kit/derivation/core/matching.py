"""Contexts: the neighbours of a module to its left and right, across brackets (ABOP, section 1.8; Kurth, lecture slides).

The left context of a module goes back along its branch: it passes finished side branches and crosses an opening bracket to the
parent. The right context goes on along its branch and passes side branches, unless the pattern names one: a named branch must
match the beginning of a branch that stands there, or all of it, where the pattern says that the branch ends. Ignored symbols
are passed on both sides. Beyond the ends of the word there are no neighbours.

Which branch may be the named one is a property of the system. In the book a right context is a subtree that begins at the end
of the segment (ABOP, section 1.8, page 32); of an axial tree it distinguishes the straight segment at a node from the lateral
ones, but numbers these not (section 1.6.1): any of them may be meant, and several that are named are met in their order. Of
GROGRA nothing else is known (Kurth's lecture slides name no branches in contexts), so that its notation reads as the book does.
cpfg reads pattern and word from left to right together, and passes over a branch only where the pattern names none: there a
named branch is the next one. It passes over brackets like any ignored symbol where `consider:` does not list them: then right
contexts read the word as if it were flat, and left contexts follow its branches all the same.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass

from lsys_kit.derivation.core.rules import Branch, Rule, Values, is_branch, kind_of
from lsys_kit.notation.model.modules import CLOSING, END, OPENING, Module
from lsys_kit.notation.model.system import ANY_BRANCH, FLAT, NEXT_BRANCH, LSystem

NO_NEIGHBOUR = -1


@dataclass(frozen=True)
class _AllBut:
    those: frozenset[str]

    def __contains__(self, symbol: object) -> bool:
        return symbol not in self.those


@dataclass(frozen=True)
class Passing:
    """What contexts pass over: symbols that are ignored, and branches.

    ignored
        The symbols.
    branches
        Which branches right contexts may name: see `LSystem.branches`.
    """

    ignored: Container[str] = ()
    branches: str = ANY_BRANCH

    @property
    def flat(self) -> bool:
        """Whether right contexts pass over brackets."""
        return self.branches == FLAT


def passing_of(system: LSystem) -> Passing:
    """What the contexts of a system pass over.

    >>> from lsys_kit import read
    >>> "+" in passing_of(read("ignore: + -\\naxiom: A")).ignored, "B" in passing_of(read("consider: A\\naxiom: A")).ignored
    (True, True)
    """
    return Passing(_AllBut(frozenset(system.considered)) if system.considered else frozenset(system.ignored), system.branches)


@dataclass(frozen=True)
class Neighbours:
    """For each position of a word its neighbours' positions, or `NO_NEIGHBOUR`.

    symbols
        Those of the word.
    passing
        What contexts pass over.
    before
        The module that the left context begins with.
    after
        The module that the right context begins with, side branches passed; for an opening bracket the module behind its
        branch.
    inside
        For an opening bracket the first module of its branch.
    closing
        For an opening bracket the position of its closing one.

    >>> found = neighbours("ABC[DE][SG[HI]M]", Passing())
    >>> "ABC[DE][SG[HI]M]"[found.before[8]], "ABC[DE][SG[HI]M]"[found.after[9]]
    ('C', 'M')
    """

    symbols: Sequence[str]
    passing: Passing
    before: Sequence[int]
    after: Sequence[int]
    inside: Sequence[int]
    closing: Sequence[int]


def neighbours(symbols: Sequence[str], passing: Passing) -> Neighbours:
    """The neighbours of all positions of a word, in one pass in each direction."""
    before, closing = _backwards(symbols, passing.ignored)
    after, inside = _ahead(symbols, passing.ignored) if not passing.flat else _ahead_of_all(symbols, passing.ignored)
    return Neighbours(symbols, passing, before, after, inside, closing)


def _backwards(symbols: Sequence[str], ignored: Container[str]) -> tuple[list[int], list[int]]:
    before, closing = [NO_NEIGHBOUR] * len(symbols), [NO_NEIGHBOUR] * len(symbols)
    last, stack = NO_NEIGHBOUR, []
    for position, symbol in enumerate(symbols):
        before[position] = last
        if symbol in OPENING:
            stack.append((last, position))
        elif symbol in CLOSING:
            if stack:
                last, opened = stack.pop()
                closing[opened] = position
        elif symbol not in ignored:
            last = position
    return before, closing


def _ahead(symbols: Sequence[str], ignored: Container[str]) -> tuple[list[int], list[int]]:
    after, inside = [NO_NEIGHBOUR] * len(symbols), [NO_NEIGHBOUR] * len(symbols)
    following = NO_NEIGHBOUR
    behind: list[int] = []
    for position in range(len(symbols) - 1, -1, -1):
        symbol = symbols[position]
        if symbol in OPENING:
            inside[position] = following
            following = behind.pop() if behind else NO_NEIGHBOUR
        after[position] = following
        if symbol in CLOSING:
            behind.append(following)
            following = NO_NEIGHBOUR
        elif symbol not in OPENING and symbol not in ignored:
            following = position
    return after, inside


def _ahead_of_all(symbols: Sequence[str], ignored: Container[str]) -> tuple[list[int], list[int]]:
    """The same where the word is read flat: the next module that is no bracket, wherever it stands, and no branches."""
    after, following = [NO_NEIGHBOUR] * len(symbols), NO_NEIGHBOUR
    for position in range(len(symbols) - 1, -1, -1):
        after[position] = following
        if symbols[position] not in OPENING and symbols[position] not in CLOSING and symbols[position] not in ignored:
            following = position
    return after, after


def neighbours_along(links: Sequence[int], position: int, length: int) -> tuple[int, ...]:
    """The first so many neighbours of a position, following `before` or `after`; fewer where the branch ends.

    >>> neighbours_along([-1, 0, 1, 2], 3, 2)
    (2, 1)
    """
    found: list[int] = []
    while len(found) < length:
        position = links[position]
        if position == NO_NEIGHBOUR:
            break
        found.append(position)
    return tuple(found)


def branches(around: Neighbours, position: int) -> Iterator[int]:
    """The opening brackets of the side branches that stand right behind a position, before the next module."""
    position += 1
    while position < len(around.symbols):
        symbol = around.symbols[position]
        if symbol in OPENING:
            yield position
            position = around.closing[position]
            if position == NO_NEIGHBOUR:
                return
        elif symbol in CLOSING or symbol not in around.passing.ignored:
            return
        position += 1


def match_predecessor(rule: Rule, word: Sequence[Module], position: int) -> tuple[int, ...] | None:
    """The positions of the modules that a rule replaces, the first of which has the right kind; None where another has not.

    They stand one directly behind the other: no symbol is ignored between them.
    """
    size = len(rule.predecessors)
    if size > 1 and tuple(map(kind_of, word[position + 1 : position + size])) != rule.predecessors[1:]:
        return None
    return tuple(range(position, position + size))


def match_context(rule: Rule, word: Sequence[Module], around: Neighbours, own: tuple[int, ...]) -> tuple[int, ...] | None:
    """The positions of the modules that a rule names, in the order written, where its contexts match; else None.

    What it replaces stands at its own positions; its contexts are what stands before the first of them and behind the last.
    """
    left = neighbours_along(around.before, own[0], len(rule.left))
    if len(left) < len(rule.left) or any(kind_of(word[at]) != kind for at, kind in zip(left, rule.left, strict=True)):
        return None
    right = _followed(rule.right, word, around, own[-1])
    return None if right is None else (*reversed(left), *own, *right)


def values_at(word: Sequence[Module], positions: Sequence[int]) -> Values:
    """The values of the modules at some positions, one after another."""
    return tuple(value for at in positions for value in word[at].arguments)


def _followed(
    row: Branch, word: Sequence[Module], around: Neighbours, position: int, there: Iterator[int] | None = None
) -> tuple[int, ...] | None:
    """The positions of a row of modules and branches behind a position, or None; its branches are some of those there."""
    if not row:
        return ()
    first, rest = row[0], row[1:]
    if is_branch(first):
        there = iter(() if around.passing.flat else branches(around, position)) if there is None else there
        inside = _first_match(first, word, around, there)
        behind = None if inside is None else _followed(rest, word, around, position, there)
        return None if inside is None or behind is None else (*inside, *behind)
    at = around.inside[position] if around.symbols[position] in OPENING else around.after[position]
    if first[0] == END:
        return () if at == NO_NEIGHBOUR else None
    if at == NO_NEIGHBOUR or kind_of(word[at]) != first:
        return None
    found = _followed(rest, word, around, at)
    return None if found is None else (at, *found)


def _first_match(branch: Branch, word: Sequence[Module], around: Neighbours, there: Iterator[int]) -> tuple[int, ...] | None:
    """The positions of a branch that is named, in the first of some branches that it may be; those before are used up."""
    for opened in there:
        inside = _followed(branch, word, around, opened)
        if inside is not None or around.passing.branches == NEXT_BRANCH:
            return inside
    return None
