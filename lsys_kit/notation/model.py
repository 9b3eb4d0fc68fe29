"""The records of a model: modules, productions, constants, and the L-system that they make.

Records are frozen and do nothing. What is optional in the field is an optional part here, not another class: a production
may have a condition or none. `str` of a record is its text in the kit's own notation, which reads back as the same record.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TypeAlias

from lsys_kit.notation.arithmetic import Value, number_text
from lsys_kit.notation.expressions import Expression, Place

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
    at: Place = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        if not self.arguments:
            return self.symbol
        texts = (str(a) if isinstance(a, Expression) else number_text(a) for a in self.arguments)
        return f"{self.symbol}({','.join(texts)})"


def joined(texts: Iterable[str]) -> str:
    """The texts of modules as one word, with a blank only where two names would run together.

    >>> joined(["A(1)", "[", "al", "br", "]", "C"])
    'A(1)[al br]C'
    """
    parts: list[str] = []
    for text in texts:
        if parts and _word_like(text[:1]) and _word_like(parts[-1][-1:]):
            parts.append(" ")
        parts.append(text)
    return "".join(parts)


def _word_like(character: str) -> bool:
    return character.isalnum() or character == "_"


@dataclass(frozen=True)
class Production:
    """What a module becomes in one step: predecessor, optional condition, successor.

    Attributes
    ----------
    predecessor
        The strict predecessor. A parameter is a `Name`; any other expression asks for just that value.
    successor
        The modules that replace it; none erases it.
    condition
        A truth that must hold, or None.
    """

    predecessor: Module
    successor: tuple[Module, ...]
    condition: Expression | None = None
    at: Place = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        condition = f" : {self.condition}" if self.condition is not None else ""
        return f"{self.predecessor}{condition} -> {joined(map(str, self.successor)) or 'ε'}"


@dataclass(frozen=True)
class Constant:
    """A named value that a model declares, with the range over which a slider may move it.

    >>> from lsys_kit.notation.expressions import Number
    >>> print(Constant("lifeTimeA", Number(3), (Number(1), Number(6), Number(1))))
    lifeTimeA = 3 in 1 .. 6 by 1
    """

    name: str
    value: Expression
    range: tuple[Expression, Expression, Expression] | None = None
    at: Place = field(default=None, compare=False, repr=False)

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
    angle, heading
        Degrees: by how much `+` and `-` turn, and in which direction the turtle starts (90 is up).
    steps
        How many steps the model asks for, or None.
    alphabet
        Names of several letters that might be mistaken for a row of symbols.
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
    alphabet: tuple[str, ...] = ()
    notation: str = field(default="abop", compare=False)
    source: str = field(default="", compare=False, repr=False)
    notes: tuple[str, ...] = field(default=(), compare=False, repr=False)

    def __str__(self) -> str:
        from lsys_kit.notation.write import write  # how a whole system is laid out is the next file's one idea

        return write(self)


def symbols(system: LSystem) -> tuple[str, ...]:
    """All symbols of a system, in the order in which they are first read.

    >>> symbols(LSystem((Module("A"),), (Production(Module("A"), (Module("A"), Module("B"))),)))
    ('A', 'B')
    """
    modules = [*system.axiom, *(m for rule in system.productions for m in (rule.predecessor, *rule.successor))]
    return tuple(dict.fromkeys(module.symbol for module in modules))


CELLS = ("L", "R")
"""The cells of a filament, pointing left and right: `L(length, width, shade)` and `R(length, width, shade)`, the modules
that seed 002 (L-system 7, section 7) assumes to be predefined; the shade of age, 0 to 1, is that of seed 000's figures."""
