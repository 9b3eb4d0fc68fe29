"""Statements of cpfg, `{x = t + 1;}`: in the blocks of rules, and around the steps of a whole model.

In a rule, what follows a statement has the expression in place of the name. What `Start:` computes once and nothing changes is
a constant. What depends on nothing but the step is a parameter of the modules whose productions use it: where
`EndEach: {n = n+1;}` counts, `A : n < 5 --> FA` becomes `A(n) : n < 5 --> FA(n+1)`, and `A(n) --> A(n+1)` comes last, so that a
module that waits counts too. What makes an A must carry the counter as well, to hand it on.

Other variables no record of a system holds, so that productions cannot use them; what they do not use, as where steps are only
counted to be printed, is left out.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from typing import TypeAlias

from lsys_kit.budget import current
from lsys_kit.notation.analysis.problems import ProblemFound, problem
from lsys_kit.notation.model.expressions import (
    OPERATORS,
    Apply,
    Expression,
    Name,
    Number,
    calls_in,
    is_random,
    names_in,
    substituted,
)
from lsys_kit.notation.model.modules import Pattern, expressions_of, flat, with_expressions
from lsys_kit.notation.model.system import Constant, Production

Bindings: TypeAlias = Mapping[str, Expression]
"""The expressions of names at some place of a rule."""
MOST_OPERATORS = 1_000
"""The greatest number of operators in an expression, after substitution."""


@dataclass(frozen=True)
class Assignment:
    """A name and its expression from there on."""

    name: Name
    value: Expression


@dataclass(frozen=True)
class Choice:
    """The blocks for a condition that is true, and that is false."""

    condition: Expression
    then: Block
    otherwise: Block
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        inner = (part.depth for part in (*self.then, *self.otherwise) if isinstance(part, Choice))
        object.__setattr__(self, "depth", 1 + max(inner, default=0))


Instruction: TypeAlias = Assignment | Choice
Block: TypeAlias = tuple[Instruction, ...]
"""Statements, in the order written."""


def substitute(
    production: Production, before: Block, after: Block, constants: Collection[str], spare: str = ""
) -> tuple[Production, ...]:
    """A rule with what its blocks compute: one before its condition, one after it.

    A random number that its successor uses more than once is drawn first, for a module with a symbol that nothing else has,
    which a second rule decomposes in the same step.

    Parameters
    ----------
    production, before, after
        The rule and its blocks.
    constants
        The names of the constants.
    spare
        Such a symbol; where none can be had, such a number is refused.

    Examples
    --------
    >>> x, doubled, drawn = Name("x"), Apply("+", (Name("t"), Name("t"))), Apply("uniform", (Number(0), Number(1)))
    >>> rule = Production((Pattern("M", (Name("t"),)),), (Pattern("I", (x,)), Pattern("J", (x,))))
    >>> print(*substitute(rule, (), (Assignment(x, doubled),), ()))
    M(t) -> I(t + t)J(t + t)
    >>> print(*substitute(rule, (), (Assignment(x, drawn),), (), "Z"), sep=", ")
    M(t) -> Z(t,uniform(0, 1)), Z(t,x) -> I(x)J(x)
    """
    if not before and not after:
        return (production,)
    names = [argument.name for module in production.parameters for argument in module.arguments if isinstance(argument, Name)]
    rule = _Rule(frozenset(names), frozenset(constants))
    first = rule.computed(before, {})
    last = rule.computed(after, first)
    condition, probability = production.condition, production.probability
    done = replace(
        production,
        condition=None if condition is None else rule.replaced(condition, first),
        successor=with_expressions(production.successor, lambda expression: rule.replaced(expression, last)),
        probability=None if probability is None else rule.replaced(probability, last),
    )
    block = (*before, *after)
    again = [*_drawn_again(done)]
    outside = (part for part in (done.condition, done.probability) if part is not None)
    inside = {id(part) for draw in again for operand in draw.operands for part in calls_in(operand)}
    judged = {id(part) for expression in outside for part in calls_in(expression)} | inside
    if again and (not spare or not judged.isdisjoint(map(id, again))):
        raise _drawn_twice(again[0], block)
    return _drawn_first(done, again, block, spare) if again else (done,)


def _drawn_first(production: Production, draws: Sequence[Apply], block: Block, spare: str) -> tuple[Production, ...]:
    """A production that draws some numbers for a module, and the rule that makes its successor of them."""
    own = tuple(sorted(_own_names(production)))
    names: dict[int, Name] = {}
    for number, draw in enumerate(draws, 1):
        owner = next((a.name.name for a in _assignments(block) if a.value is draw), f"drawn_{number}")
        taken = {*own, *(name.name for name in names.values())}
        names[id(draw)] = Name(owner if owner not in taken else f"{owner}_{number}")
    carrier = Pattern(spare, (*map(Name, own), *draws))
    successor = with_expressions(production.successor, lambda expression: _with_names(expression, names))
    decomposed = Production((Pattern(spare, (*map(Name, own), *names.values())),), successor)
    return replace(production, successor=(carrier,)), decomposed


def _with_names(expression: Expression, names: Mapping[int, Name]) -> Expression:
    """An expression with names in place of some of its parts."""
    if not isinstance(expression, Apply):
        return expression
    return names.get(id(expression)) or replace(
        expression, operands=tuple(_with_names(operand, names) for operand in expression.operands)
    )


def computed(block: Block, constants: Iterable[str], before: Iterable[str] = ()) -> Bindings:
    """What the statements of a block compute, by name, perhaps from values before; they use constants, and do not change them.

    >>> print(computed((Assignment(Name("n"), Name("k")), Assignment(Name("m"), Name("n"))), ["k"])["m"])
    k
    """
    return _Rule(frozenset(before), frozenset(constants)).computed(block, {})


def assigned_names(block: Block) -> set[str]:
    """The names to which the statements of a block give values."""
    return {assignment.name.name for assignment in _assignments(block)}


@dataclass(frozen=True)
class _Rule:
    """What a rule's blocks may use: its parameters, and the constants, which they may not change."""

    parameters: frozenset[str]
    constants: frozenset[str]

    def computed(self, block: Block, values: Bindings) -> Bindings:
        """The bindings after a block."""
        for statement in block:
            if isinstance(statement, Choice):
                values = self._chosen(statement, values)
            elif statement.name.name in self.constants:
                raise problem("constant changed", statement.name.at, name=statement.name)
            else:
                values = {**values, statement.name.name: self.replaced(statement.value, values)}
        return values

    def _chosen(self, choice: Choice, values: Bindings) -> Bindings:
        condition = self.replaced(choice.condition, values)
        then, otherwise = self.computed(choice.then, values), self.computed(choice.otherwise, values)
        changed = [name for name in {**then, **otherwise} if then.get(name) is not otherwise.get(name)]
        return {
            **values,
            **{
                name: Apply(
                    "if", (condition, self._value(name, then, choice, "false"), self._value(name, otherwise, choice, "true"))
                )
                for name in changed
            },
        }

    def _value(self, name: str, values: Bindings, choice: Choice, truth: str) -> Expression:
        """The expression of a name in one of the two cases."""
        if name in values or name in self.parameters:
            return values.get(name, Name(name))
        raise problem("value in one case", choice.condition.at, name=name, truth=truth)

    def replaced(self, expression: Expression, values: Bindings) -> Expression:
        """An expression with its names replaced."""
        result = substituted(expression, values)
        if getattr(result, "depth", 0) > current().depth or _long(result):
            raise problem("computed too long", expression.at)
        return result


def _long(expression: Expression) -> bool:
    return any(number == MOST_OPERATORS for number, _ in enumerate(calls_in(expression)))


def _assignments(block: Block) -> Iterator[Assignment]:
    for statement in block:
        if isinstance(statement, Assignment):
            yield statement
        else:
            yield from (*_assignments(statement.then), *_assignments(statement.otherwise))


def _drawn_again(production: Production) -> Iterator[Apply]:
    """The random numbers that were drawn once in a block, and twice in what became of the rule."""
    drawn: dict[int, int] = {}
    for expression in used_expressions(production):
        for applied in calls_in(expression):
            if OPERATORS[applied.operator].random:
                drawn[id(applied)] = drawn.get(id(applied), 0) + 1
                if drawn[id(applied)] == 2:
                    yield applied


def _drawn_twice(draw: Apply, block: Block) -> ProblemFound:
    """The error for a random number that is used twice, with its name, if it has one."""
    owner = next((a for a in _assignments(block) if any(applied is draw for applied in calls_in(a.value))), None)
    what = f'The random number "{owner.name}"' if owner else "This random number"
    return problem("drawn twice", (owner.name if owner else draw).at, what=what)


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
    drawn
        Whether they are the same when a word is drawn: nothing changes them before a step.
    """

    first: Mapping[str, Expression]
    following: Mapping[str, Expression]
    drawn: bool = True


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
    axiom: Sequence[Pattern],
    productions: Sequence[Production],
    decomposition: Sequence[Production],
    interpretation: Sequence[Production],
    counters: Counters,
) -> tuple[tuple[Pattern, ...], list[Production], list[Production], str] | None:
    """An axiom, productions and rules of interpretation whose modules carry the counters that they use, and what to say of it.

    Parameters
    ----------
    axiom, productions, decomposition, interpretation
        A model; no counter reaches rules of decomposition.
    counters
        All its counters.

    Examples
    --------
    >>> from lsys_kit.notation.model.expressions import Apply
    >>> n = Name("n")
    >>> rule = Production((Pattern("A"),), (Pattern("F"), Pattern("A")), Apply("<", (n, Number(5))))
    >>> count = Counters({"n": Number(0)}, {"n": Apply("+", (n, Number(1)))})
    >>> axiom, rules, _, said = with_counters((Pattern("A"),), (rule,), (), (), count)
    >>> print(*axiom, *rules, said, sep="; ")
    A(0); A(n) : n < 5 -> F A(n + 1); A(n) -> A(n + 1); To follow the steps A carries n as a parameter.
    """
    shown = [rule for rule in interpretation if counters.drawn and not names_used(rule).isdisjoint(counters.following)]
    names = _needed((*productions, *shown), counters.following) if counters.following else ()
    kinds = _carriers(productions, shown, names) if names else set()
    drawn = (rule.predecessors if _kind(rule.predecessor) not in kinds else () for rule in interpretation)
    others = [*(module for rule in decomposition for module in rule.modules), *chain.from_iterable(drawn)]
    others += [module for rule in interpretation for module in flat(rule.successor)]
    if not kinds or not _possible(axiom, productions, others, counters, names, kinds):
        return None
    carrying = _Carrying(names, kinds, counters)
    symbols, plural = sorted({symbol for symbol, _ in kinds}), len(names) > 1
    said = (
        f"To follow the steps {', '.join(symbols)} {'carries' if len(symbols) == 1 else 'carry'} {', '.join(names)} as "
        f"{'parameters' if plural else 'a parameter'}."
    )
    rules = [carrying.production(rule) for rule in productions]
    word = tuple(carrying.made(module, counters.first) for module in axiom)
    return word, [*rules, *carrying.waiting(rules)], [carrying.drawn(rule) for rule in interpretation], said


def _needed(productions: Iterable[Production], following: Mapping[str, Expression]) -> tuple[str, ...]:
    """The counters that productions use, and those on which they depend."""
    found = {name for rule in productions for name in names_used(rule) & following.keys()}
    while more := {other for name in found for other in names_in(following[name]) & following.keys()} - found:
        found |= more
    return tuple(name for name in following if name in found)


def _kind(module: Pattern) -> tuple[str, int]:
    return module.symbol, len(module.arguments)


def _carriers(productions: Sequence[Production], shown: Sequence[Production], names: Collection[str]) -> set[tuple[str, int]]:
    """The kinds of modules that carry counters: those whose productions use them, and those that make such modules."""
    kinds = {_kind(rule.predecessor) for rule in (*productions, *shown) if not names_used(rule).isdisjoint(names)}
    while (
        more := {_kind(rule.predecessor) for rule in productions if not kinds.isdisjoint(map(_kind, flat(rule.successor)))}
        - kinds
    ):
        kinds |= more
    return kinds


def _possible(
    axiom: Sequence[Pattern],
    productions: Sequence[Production],
    others: Iterable[Pattern],
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
    elsewhere = any(_kind(module) in kinds for module in others)
    chance = any(is_random(values[name]) for values in (counters.first, counters.following) for name in names if name in values)
    together = any(len(rule.predecessors) > 1 for rule in productions)
    return not (drawn or taken or own or elsewhere or chance or together)


@dataclass(frozen=True)
class _Carrying:
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

    def drawn(self, rule: Production) -> Production:
        """A rule of interpretation, which reads the counters."""
        return replace(rule, predecessors=(self.made(rule.predecessor, {name: Name(name) for name in self.names}),))

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


SEED = "srand"
"""The function that starts chance anew, whose value `Start:` stores under this name."""


@dataclass(frozen=True)
class Variables:
    """What the statements of a model around its steps come to.

    Attributes
    ----------
    constants
        What is computed once.
    seed
        Where chance begins, or None.
    changing
        The names of what changes while the model runs.
    counters
        Those of them that depend on nothing but the step.
    """

    constants: tuple[Constant, ...] = ()
    seed: Expression | None = None
    changing: frozenset[str] = frozenset()
    counters: Counters = field(default_factory=lambda: Counters({}, {}))


def variables_of(phases: Mapping[str, Sequence[Block]], rules: Iterable[Block], macros: Iterable[str]) -> Variables:
    """The variables of a model.

    Parameters
    ----------
    phases
        For "start", "end", "starteach" and "endeach" the blocks of statements.
    rules
        The blocks of the productions.
    macros
        The names of the macros, which no statement changes.

    Examples
    --------
    >>> from lsys_kit.notation.dialects.cpfg.variables import Assignment
    >>> from lsys_kit.notation.model.expressions import Name, Number
    >>> found = variables_of({"start": [(Assignment(Name("n"), Number(3)),)], "endeach": [(Assignment(Name("k"), Name("n")),)]},
    ...                      [], [])
    >>> [str(constant) for constant in found.constants], sorted(found.changing)
    (['n = 3'], ['k'])
    """
    known = (*macros,)
    begun, before, after = (_joined(phases.get(phase, ())) for phase in ("start", "starteach", "endeach"))
    start = computed(begun, known)
    each = assigned_names((*before, *after))
    local = {name for block in rules for name in assigned_names(block)}
    constants = tuple(Constant(name, value) for name, value in start.items() if name not in {*each, *local, SEED})
    first = computed((*begun, *before), known, each)
    following = computed((*after, *before), known, each)
    counters = Counters(first, {name: value for name, value in following.items() if name not in {*local, SEED}}, not before)
    return Variables(constants, start.get(SEED), frozenset((*each, *(local & start.keys()))), counters)


def _joined(blocks: Iterable[Block]) -> Block:
    return tuple(statement for block in blocks for statement in block)


def check_changing(productions: Iterable[Production], changing: frozenset[str]) -> None:
    """No production uses what changes while the model runs, unless its own block computes it."""
    for production in productions if changing else ():
        used = names_used(production) & changing
        for expression in used_expressions(production):
            found = sorted(names_in(expression) & used)
            if found:
                raise problem("changing variable", expression.at, name=found[0])
