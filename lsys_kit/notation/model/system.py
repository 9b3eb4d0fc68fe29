"""The records of a model: modules, productions, constants, and the L-system that they make.

Records are frozen and do nothing. What is optional in the field is an optional part here, not another class: a production
may have a condition or none. `str` of a record is its text in the kit's own notation, which reads back as the same record.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, fields
from functools import cached_property
from importlib import import_module
from typing import Any, TypeAlias

from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.expressions import Expression, TextSpan

Argument: TypeAlias = Expression | Value
"""What stands in a module's parentheses: an expression in a production, a value in a word."""


@dataclass(frozen=True)
class Module:
    """A symbol with its arguments: one unit of the organism (seed 002, section 1).

    >>> print(Module("M", (5, -1)))
    M(5,-1)
    """

    symbol: str
    arguments: tuple[Argument, ...] = ()
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        if not self.arguments:
            return self.symbol
        texts = (str(a) if isinstance(a, Expression) else number_text(a) for a in self.arguments)
        return f"{self.symbol}({','.join(texts)})"


def joined(texts: Iterable[str]) -> str:
    """The texts of modules as one word, with a blank only where two would run together: two names, or a name behind a roll or
    an @, which might be taken for a macro of LaTeX or for one symbol.

    >>> joined(["A(1)", "[", "al", "br", "]", "C", "\\\\", "vec", "@", "o"])
    'A(1)[al br]C\\\\ vec@ o'
    """
    parts: list[str] = []
    for text in texts:
        if parts and _word_like(text[:1]) and _runs_on(parts[-1], text):
            parts.append(" ")
        parts.append(text)
    return "".join(parts)


def _runs_on(last: str, name: str) -> bool:
    """Whether a name directly behind a module would be read together with it."""
    return _word_like(last[-1:]) or last == "@" or (last == "\\" and name[:1].islower())


def _word_like(character: str) -> bool:
    return character.isalnum() or character == "_"


@dataclass(frozen=True)
class Repeat:
    """A part of a successor that is written several times (GROGRA's `&(n) < ... >`).

    >>> from lsys_kit.notation.model.expressions import Name
    >>> print(Repeat(Name("n"), (Module("F"), Module("B", (Name("i"),))), "i"))
    repeat(n,i) <F B(i)>

    Attributes
    ----------
    count
        How many times.
    body
        What is written.
    index
        The name that counts 0, 1, 2, ... in the body; empty where nothing counts.
    """

    count: Expression
    body: tuple[Module | Repeat, ...]
    index: str = ""
    at: TextSpan = field(default=None, compare=False, repr=False)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "depth", 1 + max((item.depth for item in self.body if isinstance(item, Repeat)), default=0))

    def __str__(self) -> str:
        body = joined(map(str, self.body))
        end = " >" if body.endswith("-") else ">"  # together they would be an arrow
        return f"repeat({self.count}{f',{self.index}' if self.index else ''}) <{body}{end}"


Item: TypeAlias = Module | Repeat
"""What stands in a successor."""


def flat(items: Iterable[Item]) -> Iterator[Module]:
    """The modules of a successor, those of repeated parts once.

    >>> [str(module) for module in flat((Module("A"), Repeat(2, (Module("B"),))))]
    ['A', 'B']
    """
    for item in items:
        if isinstance(item, Repeat):
            yield from flat(item.body)
        else:
            yield item


def expressions_of(items: Iterable[Item]) -> Iterator[Expression]:
    """All expressions of a word or successor, in the order written."""
    for item in items:
        if isinstance(item, Repeat):
            yield item.count
            yield from expressions_of(item.body)
        else:
            yield from item.arguments  # type: ignore[misc]


@dataclass(frozen=True)
class Production:
    """What a module becomes in one step: predecessor and successor, perhaps contexts, a condition, a probability.

    Attributes
    ----------
    predecessor
        The strict predecessor. A parameter is a `Name`; any other expression asks for just that value.
    successor
        The modules that replace it; none erases it.
    condition
        A truth that must hold, or None.
    left, right
        The modules that must stand to its left and right; a right context may name branches, with their brackets.
    probability
        How likely it is chosen among the productions with a probability that match; None where nothing is left to chance.
    """

    predecessor: Module
    successor: tuple[Item, ...]
    condition: Expression | None = None
    left: tuple[Module, ...] = ()
    right: tuple[Module, ...] = ()
    probability: Expression | None = None
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        left = f"{joined(map(str, self.left))} < " if self.left else ""
        right = f" > {joined(map(str, self.right))}" if self.right else ""
        condition = f" : {self.condition}" if self.condition is not None else ""
        probability = f" : {self.probability}" if self.probability is not None else ""
        return f"{left}{self.predecessor}{right}{condition} -> {joined(map(str, self.successor)) or 'ε'}{probability}"

    @property
    def modules(self) -> Iterator[Module]:
        """All its modules, in the order written."""
        yield from (*self.left, self.predecessor, *self.right)
        yield from flat(self.successor)

    @property
    def parameters(self) -> tuple[Module, ...]:
        """The modules whose arguments name its parameters."""
        return *self.left, self.predecessor, *self.right


@dataclass(frozen=True)
class MetaRule:
    """A rule that shortens a word after a step: neighbouring modules and what stands for them (seed 003, on movement).

    >>> from lsys_kit.notation.model.expressions import Apply, Name
    >>> print(MetaRule((Module("f", (Name("a"),)), Module("f", (Name("b"),))),
    ...                (Module("f", (Apply("+", (Name("a"), Name("b"))),)),)))
    meta: f(a)f(b) -> f(a + b)
    """

    predecessors: tuple[Module, ...]
    successor: tuple[Item, ...]
    condition: Expression | None = None
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        condition = f" : {self.condition}" if self.condition is not None else ""
        return f"meta: {joined(map(str, self.predecessors))}{condition} -> {joined(map(str, self.successor)) or 'ε'}"


@dataclass(frozen=True)
class Constant:
    """A named value that a model declares, with the range over which a slider may move it.

    >>> from lsys_kit.notation.model.expressions import Number
    >>> print(Constant("lifeTimeA", Number(3), (Number(1), Number(6), Number(1))))
    lifeTimeA = 3 in 1 .. 6 by 1
    """

    name: str
    value: Expression
    range: tuple[Expression, Expression, Expression] | None = None
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        span = f" in {self.range[0]} .. {self.range[1]} by {self.range[2]}" if self.range else ""
        return f"{self.name} = {self.value}{span}"


@dataclass(frozen=True)
class LSystem:
    """An L-system: axiom and productions, with what is needed to derive and draw them.

    Attributes
    ----------
    axiom
        The first word.
    productions
        In the order written; the first that matches is applied.
    constants
        Declared names, each of which may use those before it.
    interpretation
        Productions that turn a word into what is drawn, without changing the derivation.
    decomposition
        Productions that are applied after each step to what they themselves make too, until none applies.
    meta
        Rules that shorten the word after a step, until none applies.
    ignored, considered
        Symbols that contexts pass over; or, where these are given, the only ones that they do not pass over.
    depth
        How often interpretation rules are applied to what they make.
    decomposition_depth
        How often decomposition rules are applied to what they make; None: until none applies.
    angle, heading
        Degrees: by how much `+` and `-` turn, and in which direction the turtle starts (90 is up).
    length
        How far one segment goes where it does not say so itself; None where that is left to the turtle.
    turtle
        Whose turtle commands the symbols are: a name in `TURTLE_DIALECTS`.
    steps, seed
        How many steps the model asks for, and where its chance begins; or None.
    alphabet
        Names of several letters that a reader might mistake for a row of symbols. No part of what the system is: equality
        ignores it.
    cells
        How the cells of a filament are drawn: as "rectangles" with round ends or as "ellipses". Equality ignores it.
    notation
        In which notation it was read and prints itself. Not a part of what the system is: equality ignores it.
    source, notes
        The text it was read from, and what the reader found worth telling. Equality ignores them too.
    """

    axiom: tuple[Module, ...]
    productions: tuple[Production, ...]
    constants: tuple[Constant, ...] = ()
    interpretation: tuple[Production, ...] = ()
    angle: Value = 90
    heading: Value = 90
    steps: int | None = None
    alphabet: tuple[str, ...] = field(default=(), compare=False)
    decomposition: tuple[Production, ...] = ()
    meta: tuple[MetaRule, ...] = ()
    ignored: tuple[str, ...] = ()
    considered: tuple[str, ...] = ()
    depth: int = 1
    length: Value | None = None
    seed: int | None = None
    decomposition_depth: int | None = None
    turtle: str = "abop"
    cells: str = field(default="rectangles", compare=False)
    notation: str = field(default="abop", compare=False)
    source: str = field(default="", compare=False, repr=False)
    notes: tuple[str, ...] = field(default=(), compare=False, repr=False)

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        """The hash, computed once: ready-made rules are looked up by their system."""
        return hash(tuple(getattr(self, part.name) for part in fields(self) if part.compare))

    def __str__(self) -> str:
        return WRITERS[self.notation](self)

    def picture(self, n: int | None = None, **choices: Any) -> Any:
        """The picture that `draw(system, n)` makes.

        >>> LSystem((Module("F"),), (Production(Module("F"), (Module("F"), Module("F"))),)).picture(3)
        8 segments, width 0, height 8
        """
        return import_module("lsys_kit").draw(self, n, **choices)  # asked for by name: this room knows no pictures

    @property
    def rules(self) -> tuple[Production, ...]:
        """Productions, decomposition rules and interpretation rules."""
        return *self.productions, *self.decomposition, *self.interpretation

    @property
    def modules(self) -> Iterator[Module]:
        """All modules of the axiom and the rules, in the order written."""
        yield from self.axiom
        for rule in self.rules:
            yield from rule.modules
        for meta in self.meta:
            yield from (*meta.predecessors, *flat(meta.successor))


WRITERS: dict[str, Callable[[LSystem], str]] = {}
"""How each notation writes a system: the registry of the notations fills this table, for the records know none of them."""


def symbols(system: LSystem) -> tuple[str, ...]:
    """All symbols of a system, in the order in which they are first read.

    >>> symbols(LSystem((Module("A"),), (Production(Module("A"), (Module("A"), Module("B"))),)))
    ('A', 'B')
    """
    modules = [*system.axiom, *(m for rule in (*system.productions, *system.decomposition) for m in rule.modules)]
    return tuple(dict.fromkeys(module.symbol for module in modules if module.symbol != END))


OPENING, CLOSING = frozenset("[("), frozenset("])")
"""The brackets of branches; round ones stand in plant strings only."""
END = "ε"
"""What a right context has before the closing bracket of a branch of which it names all modules: the branch ends there."""

CELLS = {"L": -1, "R": 1, "O": 0}
"""The cells of a filament, and where they point: `L(length, width, shade)` left and `R(length, width, shade)` right, the
modules that seed 002 (L-system 7, section 7) assumes to be predefined, and `O(length, width, shade)` nowhere; the shade of age,
0 to 1, is that of seed 000's figures."""
WALL = "W"
"""A wall between two cells, `W(age, shade)`, as in seed 002's figure 8; the shade, 0 to 1, may be left out."""
