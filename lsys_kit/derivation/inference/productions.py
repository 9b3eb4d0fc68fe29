"""Systems from tables: the productions that turn each letter into its successor, with no more context than they need.

What a module becomes nearly everywhere is the last of its productions; what it becomes between some neighbours stands before
it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from lsys_kit.budget import check_budget
from lsys_kit.derivation.inference.problem import Conditions, Letter, Table
from lsys_kit.derivation.inference.words import Row
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem, Production


def system_of(axiom: Row, productions: Iterable[Production], conditions: Conditions) -> LSystem:
    """The system with an axiom and productions; in its contexts constants are passed over.

    >>> from lsys_kit.notation.model.modules import Module
    >>> print(system_of((Module("a"),), [], Conditions()))
    axiom: a
    """
    rules = tuple(productions)
    ignored = tuple(sorted(conditions.constants)) if any(rule.left or rule.right for rule in rules) else ()
    return LSystem(row_of(axiom), rules, ignored=ignored)


def row_of(row: Iterable[Module]) -> tuple[Pattern, ...]:
    """Modules as an axiom or a production writes them."""
    return tuple(Pattern(module.symbol, tuple(map(Number, module.arguments))) for module in row)


def productions_of(table: Table) -> Iterator[Production]:
    """Productions for a table, symbol by symbol; a module that stays as it is needs none.

    >>> a, b = Module("a"), Module("b")
    >>> table = {Letter((), a, (a,)): (a,), Letter((a,), a, (b,)): (b,), Letter((a,), b): (a, b)}
    >>> [str(production) for production in productions_of(table)]
    ['a > b -> b', 'b -> a b']
    """
    for module in dict.fromkeys(letter.module for letter in table):
        yield from _productions_of_one(module, {letter: word for letter, word in table.items() if letter.module == module})


def _productions_of_one(module: Module, table: Table) -> Iterator[Production]:
    usual = _usual(module, table)
    open_letters = _explicit(table, usual)
    while open_letters:
        check_budget()
        letter = open_letters[0]
        context = _least_context(letter, table)
        yield Production(row_of((module,)), row_of(table[letter]), left=row_of(context.left), right=row_of(context.right))
        table = {other: word for other, word in table.items() if not _extends(other, context)}
        open_letters = [other for other in open_letters if other in table]
    if usual != (module,):
        yield Production(row_of((module,)), row_of(usual))


def _usual(module: Module, table: Table) -> Row:
    """What a module becomes where no context says otherwise: itself, if it ever does, else what most of its letters become."""
    found = Counter(table.values())
    return (module,) if (module,) in found else found.most_common(1)[0][0]


def _explicit(table: Table, usual: Row) -> list[Letter]:
    """The letters that need a production with a context, those with the most neighbours first: what becomes something else, and
    what would be taken for it, as where a letter at the end of a word has fewer neighbours."""
    unusual = [letter for letter, word in table.items() if word != usual]
    taken = [letter for letter, word in table.items() if word == usual and any(_extends(letter, other) for other in unusual)]
    return sorted([*unusual, *taken], key=lambda letter: len(letter.left) + len(letter.right), reverse=True)


def _least_context(letter: Letter, table: Table) -> Letter:
    """The letter with as few of its neighbours as distinguish it from those that become something else."""
    sizes = [(left, right) for left in range(len(letter.left) + 1) for right in range(len(letter.right) + 1)]
    contexts = (
        Letter(letter.left[len(letter.left) - left :], letter.module, letter.right[:right])
        for left, right in sorted(sizes, key=sum)
    )
    return next(
        context
        for context in contexts
        if all(word == table[letter] for other, word in table.items() if _extends(other, context))
    )


def _extends(letter: Letter, context: Letter) -> bool:
    """Whether a letter has the neighbours that a context asks for."""
    left, right = len(context.left), len(context.right)
    return letter.left[max(0, len(letter.left) - left) :] == context.left and letter.right[:right] == context.right
