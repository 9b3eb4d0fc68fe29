"""What can be seen of a model before it runs: productions that never match, and decomposition that never finishes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from graphlib import CycleError, TopologicalSorter

from lsys_kit.errors import ModelValueError
from lsys_kit.notation.analysis.checks import span
from lsys_kit.notation.model.expressions import Name, Number
from lsys_kit.notation.model.system import END, Item, LSystem, Module, Production, flat, joined

_Kind = tuple[str, int]
"""What a rule is found by: the symbol of a module and its number of parameters."""


def _kind(module: Module) -> _Kind:
    return module.symbol, len(module.arguments)


def unused_productions(system: LSystem) -> list[str]:
    """A note for each production that is never applied, for want of its modules or because another is always applied first.

    >>> from lsys_kit.notation.read import read
    >>> unused_productions(read("axiom: M(1)\\nM(t,p) -> M(t+p)"))
    ['The production M(t,p) can never match: no module M with 2 parameters occurs.']
    >>> unused_productions(read("axiom: A\\nA -> B\\nA -> C"))
    ['Production 2, for A, is never applied: production 1 comes before it and matches every A.']
    """
    return [*_unmatched(system), *_overtaken(system.productions, system, "production"),
            *_overtaken(system.decomposition, system, "decomposition rule")]


def _unmatched(system: LSystem) -> Iterator[str]:
    """A note for each production that can never match, because a module that it asks for never occurs."""
    rules = *system.productions, *system.decomposition
    successors = [*(rule.successor for rule in rules), *(rule.successor for rule in system.meta)]
    occurring = {_kind(module) for word in (system.axiom, *successors) for module in flat(word)}
    symbols = {symbol for symbol, _ in occurring}
    for rule in rules:
        asked = rule.predecessor, *rule.left, *rule.right
        missing = next((module for module in asked if _kind(module) not in occurring and module.symbol != END), None)
        if missing is not None:
            yield f"The production {_head(rule)} can never match: no module {_described(missing, symbols)} occurs."


def _overtaken(rules: Iterable[Production], system: LSystem, called: str) -> Iterator[str]:
    """A note for each rule before which another always comes; none where chance is asked first."""
    constants = {constant.name for constant in system.constants}
    sure: dict[_Kind, int] = {}
    chance: set[_Kind] = set()
    for number, rule in enumerate(rules, 1):
        kind = _kind(rule.predecessor)
        if kind in sure:
            yield (f"{called.capitalize()} {number}, for {_head(rule)}, is never applied: {called} {sure[kind]} comes before "
                   f"it and matches every {rule.predecessor}.")
        elif rule.probability is not None:
            chance.add(kind)
        elif kind not in chance and not rule.left and not rule.right and _always(rule, constants):
            sure[kind] = number


def _head(rule: Production) -> str:
    """A production's predecessor with its contexts."""
    left = f"{joined(map(str, rule.left))} < " if rule.left else ""
    right = f" > {joined(map(str, rule.right))}" if rule.right else ""
    return f"{left}{rule.predecessor}{right}"


def _described(module: Module, symbols: Iterable[str]) -> str:
    """A module's symbol, with its number of parameters where others with that symbol occur."""
    count = len(module.arguments)
    if module.symbol not in symbols:
        return module.symbol
    return f"{module.symbol} with {count} parameter{'s' * (count != 1)}" if count else f"{module.symbol} without parameters"


def check_decomposition(system: LSystem) -> None:
    """No module is decomposed into itself again, whatever happens; where a depth is set, that is no fault.

    Only rules that are certain to be applied count: the first for a module, without condition or probability.
    """
    if system.decomposition_depth is not None:
        return
    rules: dict[_Kind, Production] = {}
    for rule in system.decomposition:
        rules.setdefault(_kind(rule.predecessor), rule)
    constants = {constant.name for constant in system.constants}
    sure = {kind: rule for kind, rule in rules.items() if _always(rule, constants)}
    made = {kind: {_kind(module) for module in _surely(rule.successor)} & sure.keys() for kind, rule in sure.items()}
    try:
        TopologicalSorter(made).prepare()
    except CycleError as found:
        raise _endless(found.args[1], sure, system.source) from None


def _always(rule: Production, constants: Iterable[str]) -> bool:
    """Whether a rule applies to every module with its symbol and number of parameters."""
    free = all(isinstance(argument, Name) and argument.name not in constants for argument in rule.predecessor.arguments)
    return free and rule.condition is None and rule.probability is None


def _surely(items: Iterable[Item]) -> Iterator[Module]:
    """The modules of a successor that are there however often its parts are repeated."""
    for item in items:
        if isinstance(item, Module):
            yield item
        elif isinstance(item.count, Number) and item.count.value >= 1:
            yield from _surely(item.body)


def _endless(cycle: list[_Kind], rules: Mapping[_Kind, Production], source: str) -> ModelValueError:
    """The rules that lead to each other, told from the one that is written first."""
    kinds = cycle[:0:-1]  # the sorter tells a cycle backwards, with one of its ends twice
    order = list(rules)
    first = min(kinds, key=order.index)
    at = kinds.index(first)
    names = [symbol for symbol, _ in (*kinds[at:], *kinds[:at], first)]
    shown = names if len(names) <= 8 else [*names[:4], "...", *names[-3:]]
    return ModelValueError(f"Rule {names[0]} decomposes into itself: {' -> '.join(shown)}", source, *span(rules[first]),
                           "It can never finish.")
