"""What can be seen of a model before it runs: productions that never match, and decomposition that never finishes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from graphlib import CycleError, TopologicalSorter

from lsys_kit.notation.analysis.problems import Problem, ProblemFound, problem
from lsys_kit.notation.model.expressions import Name, Number
from lsys_kit.notation.model.modules import END, Item, Pattern, flat
from lsys_kit.notation.model.system import LSystem, Production

_ModuleKind = tuple[str, int]
"""A symbol and a number of parameters: what a module is to the rules."""


def _kind(module: Pattern) -> _ModuleKind:
    return module.symbol, len(module.arguments)


def unused_productions(system: LSystem) -> list[Problem]:
    """The productions that are never applied: a module they need never occurs, or another always comes first.

    >>> from lsys_kit.notation.read import read
    >>> [problem.code for problem in unused_productions(read("axiom: M(1)\\nM(t,p) -> M(t+p)"))]
    ['never matches']
    >>> read("axiom: A\\nA -> B\\nA -> C").notes
    ('Production 2, for A, is never applied: production 1 comes before it and matches every A.',)
    """
    return [*_unmatched(system), *_overtaken(system.productions, system, "production"),
            *_overtaken(system.decomposition, system, "decomposition rule")]


def _unmatched(system: LSystem) -> Iterator[Problem]:
    """The rules that can never match, because a module that they need never occurs."""
    rules = *system.productions, *system.decomposition
    successors = [*(rule.successor for rule in rules), *(rule.successor for rule in system.meta)]
    occurring = {_kind(module) for word in (system.axiom, *successors) for module in flat(word)}
    symbols = {symbol for symbol, _ in occurring}
    for rule in rules:
        needed = rule.predecessor, *rule.left, *rule.right
        missing = next((module for module in needed if _kind(module) not in occurring and module.symbol != END), None)
        if missing is not None:
            yield Problem("never matches", rule.at, {"rule": rule, "missing": _described(missing, symbols)})


def _overtaken(rules: Iterable[Production], system: LSystem, called: str) -> Iterator[Problem]:
    """The rules before which another always applies; none where a rule with a probability comes first."""
    constants = {constant.name for constant in system.constants}
    certain: dict[_ModuleKind, int] = {}
    random: set[_ModuleKind] = set()
    for number, rule in enumerate(rules, 1):
        kind = _kind(rule.predecessor)
        if kind in certain:
            yield Problem(f"{called} never applied", rule.at, {
                "number": number, "rule": rule, "first": certain[kind], "module": rule.predecessor})
        elif rule.probability is not None:
            random.add(kind)
        elif kind not in random and not rule.left and not rule.right and _always(rule, constants):
            certain[kind] = number


def _described(module: Pattern, symbols: Iterable[str]) -> str:
    """A module's symbol, with its number of parameters where others with that symbol occur."""
    count = len(module.arguments)
    if module.symbol not in symbols:
        return module.symbol
    return f"{module.symbol} with {count} parameter{'s' * (count != 1)}" if count else f"{module.symbol} without parameters"


def check_decomposition(system: LSystem) -> None:
    """No module is certain to be decomposed into itself again; where a depth is set, it may be.

    Only rules that are certain to be applied count: the first for a module, without condition or probability.
    """
    if system.decomposition_depth is not None:
        return
    rules: dict[_ModuleKind, Production] = {}
    for rule in system.decomposition:
        rules.setdefault(_kind(rule.predecessor), rule)
    constants = {constant.name for constant in system.constants}
    certain = {kind: rule for kind, rule in rules.items() if _always(rule, constants)}
    made = {kind: {_kind(module) for module in _always_made(rule.successor)} & certain.keys() for kind, rule in certain.items()}
    try:
        TopologicalSorter(made).prepare()
    except CycleError as error:
        raise _endless(error.args[1], certain) from None


def _always(rule: Production, constants: Iterable[str]) -> bool:
    """Whether a rule applies to every module with its symbol and number of parameters."""
    free = all(isinstance(argument, Name) and argument.name not in constants for argument in rule.predecessor.arguments)
    return free and rule.condition is None and rule.probability is None


def _always_made(items: Iterable[Item]) -> Iterator[Pattern]:
    """The modules of a successor that occur however often its parts are repeated."""
    for item in items:
        if isinstance(item, Pattern):
            yield item
        elif isinstance(item.count, Number) and item.count.value >= 1:
            yield from _always_made(item.body)


def _endless(cycle: list[_ModuleKind], rules: Mapping[_ModuleKind, Production]) -> ProblemFound:
    """The rules that lead to each other, beginning with the one that is written first."""
    kinds = cycle[:0:-1]  # the sorter gives a cycle backwards, with one of its ends twice
    order = list(rules)
    first = min(kinds, key=order.index)
    at = kinds.index(first)
    names = [symbol for symbol, _ in (*kinds[at:], *kinds[:at], first)]
    shown = names if len(names) <= 8 else [*names[:4], "...", *names[-3:]]
    return problem("endless decomposition", rules[first].at, symbol=names[0], cycle=" -> ".join(shown))
