"""The records of a model: productions, constants, and the L-system that they make.

Records are frozen and do nothing. An optional part is an optional attribute, not another class: a production may have a
condition or none. `str` of a record is its text in the kit's own notation, which reads back as the same record.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any

from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.arithmetic import Value, shortest_decimal
from lsys_kit.notation.model.expressions import Expression, TextSpan
from lsys_kit.notation.model.modules import END, OPENING, Item, Pattern, abridged_text, flat, joined
from lsys_kit.notation.model.surfaces import SurfaceShape

LOOK = "cells", "widths", "colours"
"""Settings that say how a system looks: equality ignores them, and what is written keeps them."""
USUAL_STEPS = 5
"""How many steps a system is derived that does not say how many."""


@dataclass(frozen=True)
class Production:
    """What modules become in one step: strict predecessor and successor, perhaps contexts, a condition, a probability.

    Attributes
    ----------
    predecessors
        The strict predecessor: the module that is replaced, or several neighbours that are replaced together (pseudo-L-systems:
        Prusinkiewicz, Graphical applications of L-systems, 1986). A parameter is a `Name`; any other expression matches that
        value alone.
    successor
        The modules that replace it; none erases it.
    condition
        A condition that must hold, or None.
    left, right
        The modules that must be to its left and right; a right context may name branches, with their brackets.
    probability
        Its weight among the matching productions with a probability; None for a production without chance.
    """

    predecessors: tuple[Pattern, ...]
    successor: tuple[Item, ...]
    condition: Expression | None = None
    left: tuple[Pattern, ...] = ()
    right: tuple[Pattern, ...] = ()
    probability: Expression | None = None
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        left = f"{joined(map(str, self.left))} < " if self.left else ""
        right = f" > {joined(map(str, self.right))}" if self.right else ""
        condition = f" : {self.condition}" if self.condition is not None else ""
        probability = f" : {self.probability}" if self.probability is not None else ""
        own = joined(map(str, self.predecessors))
        return f"{left}{own}{right}{condition} -> {joined(map(str, self.successor)) or 'ε'}{probability}"

    __repr__ = __str__

    @property
    def predecessor(self) -> Pattern:
        """The module that is replaced; of several that are replaced together the first."""
        return self.predecessors[0]

    @property
    def modules(self) -> Iterator[Pattern]:
        """All its modules, in the order written."""
        yield from self.parameters
        yield from flat(self.successor)

    @property
    def parameters(self) -> tuple[Pattern, ...]:
        """The modules whose arguments name its parameters."""
        return *self.left, *self.predecessors, *self.right


@dataclass(frozen=True)
class MetaRule:
    """A rule that shortens a word after a step: neighbouring modules, and what replaces them (Kurth, on movement).

    >>> from lsys_kit.notation.model.expressions import Apply, Name
    >>> print(MetaRule((Pattern("f", (Name("a"),)), Pattern("f", (Name("b"),))),
    ...                (Pattern("f", (Apply("+", (Name("a"), Name("b"))),)),)))
    meta: f(a)f(b) -> f(a + b)
    """

    predecessors: tuple[Pattern, ...]
    successor: tuple[Item, ...]
    condition: Expression | None = None
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        condition = f" : {self.condition}" if self.condition is not None else ""
        return f"meta: {joined(map(str, self.predecessors))}{condition} -> {joined(map(str, self.successor)) or 'ε'}"

    __repr__ = __str__


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

    __repr__ = __str__


ANY_BRANCH, NEXT_BRANCH, FLAT = BRANCHES = ("any", "next", "flat")
"""How right contexts treat the branches behind a module; see `LSystem.branches`."""


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
    surfaces
        The surfaces that it declares, which `~` draws by their names.
    branches
        Which branches a right context may name: "any" of those behind a module, in their order, whatever stands between them;
        the "next" alone, as in cpfg; or none, where right contexts read the word "flat", as if it had no brackets. It is "any"
        where the right contexts mean the same in any case.
    depth
        How often interpretation rules are applied to what they make.
    decomposition_depth
        How often decomposition rules are applied to what they make; None: until none applies.
    angle, heading
        Degrees: by how much `+` and `-` turn, and in which direction the turtle starts (90 is up).
    length
        The default length of a segment; None where that is left to the turtle.
    turtle
        Whose turtle commands the symbols are: a name in `TURTLE_DIALECTS`.
    steps, seed
        The number of steps and the seed of the random numbers that the model sets, or None.
    alphabet
        Names of several letters that could be taken for a row of symbols. Equality ignores it.
    cells
        How the cells of a filament are drawn: as "rectangles" with round ends or as "ellipses". Equality ignores it.
    widths
        The unit of the widths of strokes: "pixels" or "units", those of lengths; "" where that is left to the turtle. Equality
        ignores it.
    colours
        Whose colours strokes have: those of "symbols", or "natural" ones, from bark to leaves, by their width or branch order;
        "" where that is left to whoever draws. Equality ignores it.
    notation
        The notation in which it was read and prints itself. Equality ignores it.
    source, notes
        The text it was read from, and notes on how it was read. Equality ignores them too.
    field
        What answers its query modules `?E`: the name of a ready-made field with the values that shape it, or None.
    """

    axiom: tuple[Pattern, ...]
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
    branches: str = ANY_BRANCH
    surfaces: tuple[SurfaceShape, ...] = ()
    cells: str = field(default="rectangles", compare=False)
    widths: str = field(default="", compare=False)
    colours: str = field(default="", compare=False)
    notation: str = field(default="abop", compare=False)
    source: str = field(default="", compare=False, repr=False)
    notes: tuple[str, ...] = field(default=(), compare=False, repr=False)
    field: Pattern | None = None  # the last: below it the name is no longer that of the function

    def __post_init__(self) -> None:
        """Settings are exact: a double is taken as the decimal that it is printed as. Where no production depends on what
        contexts do with branches, that makes no difference between systems."""
        for name in ("angle", "heading", "length"):
            if isinstance(getattr(self, name), float):
                object.__setattr__(self, name, shortest_decimal(getattr(self, name)))
        if self.branches != ANY_BRANCH and not any(_depends_on_branches(rule, self.branches) for rule in self.productions):
            object.__setattr__(self, "branches", ANY_BRANCH)

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        """The hash, computed once: ready-made rules are looked up by their system."""
        return hash(tuple(getattr(self, part.name) for part in fields(self) if part.compare))

    def __str__(self) -> str:
        return WRITERS[self.notation](self)

    def __repr__(self) -> str:
        """Its text, abridged; where its notation has no text of it, its axiom and its rules."""
        try:
            text = str(self)
        except (KeyError, LSystemError):
            text = "\n".join([f"axiom: {joined(map(str, self.axiom))}", *map(str, self.rules)])
        return abridged_text(text)

    def picture(self, n: int | None = None, **choices: Any) -> Any:
        """The picture that `draw(system, n)` makes.

        >>> LSystem((Pattern("F"),), (Production((Pattern("F"),), (Pattern("F"), Pattern("F"))),)).picture(3)
        8 segments, width 0, height 8
        """
        from lsys_kit import draw  # imported late: this room knows no pictures, only what the package offers

        return draw(self, n, **choices)

    @property
    def rules(self) -> tuple[Production, ...]:
        """Productions, decomposition rules and interpretation rules."""
        return *self.productions, *self.decomposition, *self.interpretation

    @property
    def modules(self) -> Iterator[Pattern]:
        """All modules of the axiom and the rules, in the order written."""
        yield from self.axiom
        for rule in self.rules:
            yield from rule.modules
        for meta in self.meta:
            yield from (*meta.predecessors, *flat(meta.successor))


def _depends_on_branches(rule: Production, branches: str) -> bool:
    """Whether a right context means something else than where it may name any branch."""
    return bool(rule.right) and (branches == FLAT or any(module.symbol in OPENING for module in rule.right))


WRITERS: dict[str, Callable[[LSystem], str]] = {}
"""How each notation writes a system. The registry of the notations fills this table: the records know no notation."""


def symbols(system: LSystem) -> tuple[str, ...]:
    """All symbols of a system, in the order in which they are first read.

    >>> symbols(LSystem((Pattern("A"),), (Production((Pattern("A"),), (Pattern("A"), Pattern("B"))),)))
    ('A', 'B')
    """
    modules = [*system.axiom, *(m for rule in (*system.productions, *system.decomposition) for m in rule.modules)]
    return tuple(dict.fromkeys(module.symbol for module in modules if module.symbol != END))
