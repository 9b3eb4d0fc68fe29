"""Counters of a cpfg model, which depend on nothing but the step: modules whose productions use them carry them as parameters.

Where `EndEach: {n = n+1;}` counts, `A : n < 5 --> FA` becomes `A(n) : n < 5 --> FA(n+1)`, and `A(n) --> A(n+1)` comes last, so
that a module that waits counts too. What makes an A must carry the counter as well, to hand it on.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from lsys_kit.notation.model.expressions import Expression, Name, Number, is_random, names_in
from lsys_kit.notation.model.modules import Pattern, expressions_of, flat
from lsys_kit.notation.model.system import Production

_DRAWN = frozenset("FfGg")
"""Symbols whose first value is a length, so that they carry no counter without one."""


@dataclass(frozen=True)
class Counters:
    """Variables that change with the steps.

    Attributes
    ----------
    first
        Their values in the first step.
    following
        From their values in a step those in the next.
    """

    first: Mapping[str, Expression]
    following: Mapping[str, Expression]


def used_expressions(production: Production) -> Iterator[Expression]:
    """The expressions of a production that may use variables."""
    yield from (part for part in (production.condition, production.probability) if part is not None)
    yield from expressions_of(production.successor)


def names_used(production: Production) -> frozenset[str]:
    """The names that a production uses and that are not its own parameters."""
    return frozenset().union(*map(names_in, used_expressions(production))) - _own_names(production)


def _own_names(production: Production) -> set[str]:
    return {a.name for module in production.parameters for a in module.arguments if isinstance(a, Name)}


def with_counters(
    axiom: Sequence[Pattern], productions: Sequence[Production], others: Iterable[Production], counters: Counters
) -> tuple[tuple[Pattern, ...], list[Production], str] | None:
    """An axiom and productions whose modules carry the counters that they use, and what to say of it.

    Parameters
    ----------
    axiom, productions
        A model.
    others
        Its rules of decomposition and interpretation, which no counter reaches.
    counters
        All its counters.

    Examples
    --------
    >>> from lsys_kit.notation.model.expressions import Apply
    >>> n = Name("n")
    >>> rule = Production((Pattern("A"),), (Pattern("F"), Pattern("A")), Apply("<", (n, Number(5))))
    >>> count = Counters({"n": Number(0)}, {"n": Apply("+", (n, Number(1)))})
    >>> axiom, rules, said = with_counters((Pattern("A"),), (rule,), (), count)
    >>> print(*axiom, *rules, said, sep="; ")
    A(0); A(n) : n < 5 -> F A(n + 1); A(n) -> A(n + 1); To follow the steps A carries n as a parameter.
    """
    names = _needed(productions, counters.following) if counters.following else ()
    kinds = _carriers(productions, names) if names else set()
    if not kinds or not _possible(axiom, productions, others, counters, names, kinds):
        return None
    carrying = _Carrying(names, kinds, counters)
    symbols, plural = sorted({symbol for symbol, _ in kinds}), len(names) > 1
    said = (
        f"To follow the steps {', '.join(symbols)} {'carries' if len(symbols) == 1 else 'carry'} {', '.join(names)} as "
        f"{'parameters' if plural else 'a parameter'}."
    )
    rules = [carrying.production(rule) for rule in productions]
    return tuple(carrying.made(module, counters.first) for module in axiom), [*rules, *carrying.waiting(rules)], said


def _needed(productions: Iterable[Production], following: Mapping[str, Expression]) -> tuple[str, ...]:
    """The counters that productions use, and those on which they depend."""
    found = {name for rule in productions for name in names_used(rule) & following.keys()}
    while more := {other for name in found for other in names_in(following[name]) & following.keys()} - found:
        found |= more
    return tuple(name for name in following if name in found)


def _kind(module: Pattern) -> tuple[str, int]:
    return module.symbol, len(module.arguments)


def _carriers(productions: Sequence[Production], names: Collection[str]) -> set[tuple[str, int]]:
    """The kinds of modules that carry counters: those whose productions use them, and those that make such modules."""
    kinds = {_kind(rule.predecessor) for rule in productions if not names_used(rule).isdisjoint(names)}
    while (
        more := {_kind(rule.predecessor) for rule in productions if not kinds.isdisjoint(map(_kind, flat(rule.successor)))}
        - kinds
    ):
        kinds |= more
    return kinds


def _possible(
    axiom: Sequence[Pattern],
    productions: Sequence[Production],
    others: Iterable[Production],
    counters: Counters,
    names: Sequence[str],
    kinds: Collection[tuple[str, int]],
) -> bool:
    """Whether the modules can carry the counters, and nothing else is about them."""
    modules = [*axiom, *(module for rule in productions for module in rule.modules)]
    met = set(map(_kind, modules))
    drawn = any(not symbol.isalpha() or (symbol in _DRAWN and not size) for symbol, size in kinds)
    taken = any((symbol, size + len(names)) in met for symbol, size in kinds)
    own = any(not _own_names(rule).isdisjoint(names) for rule in productions)
    elsewhere = any(_kind(module) in kinds for rule in others for module in rule.modules)
    chance = any(is_random(values[name]) for values in (counters.first, counters.following) for name in names if name in values)
    together = any(len(rule.predecessors) > 1 for rule in productions)
    return not (drawn or taken or own or elsewhere or chance or together)


@dataclass(frozen=True)
class _Carrying:
    """How modules carry counters."""

    names: tuple[str, ...]
    kinds: Collection[tuple[str, int]]
    counters: Counters

    def made(self, module: Pattern, values: Mapping[str, Expression]) -> Pattern:
        """A module with some values of the counters."""
        if _kind(module) not in self.kinds:
            return module
        return replace(module, arguments=(*module.arguments, *(values.get(name, Number(0)) for name in self.names)))

    def production(self, rule: Production) -> Production:
        """A production that hands the counters on."""
        following = self.counters.following
        return replace(
            rule,
            predecessors=(self.made(rule.predecessor, {name: Name(name) for name in self.names}),),
            left=tuple(self._beside(module, f"l{at}") for at, module in enumerate(rule.left)),
            right=tuple(self._beside(module, f"r{at}") for at, module in enumerate(rule.right)),
            successor=tuple(self.made(module, following) for module in flat(rule.successor)),
        )

    def _beside(self, module: Pattern, mark: str) -> Pattern:
        """A module of a context, whose counters have names that nothing uses."""
        return self.made(module, {name: Name(f"{name}_{mark}") for name in self.names})

    def waiting(self, rules: Iterable[Production]) -> Iterator[Production]:
        """The productions of modules that wait: nothing changes but the counters."""
        always = {
            _kind(rule.predecessor)
            for rule in rules
            if not (rule.left or rule.right)
            and rule.condition is None
            and rule.probability is None
            and all(isinstance(a, Name) for a in rule.predecessor.arguments)
        }
        for symbol, size in sorted(self.kinds):
            if (symbol, size + len(self.names)) not in always:
                values = tuple(Name(f"x_{place}") for place in range(1, size + 1))
                module = Pattern(symbol, values)
                yield Production(
                    (self.made(module, {name: Name(name) for name in self.names}),),
                    (self.made(module, self.counters.following),),
                )
