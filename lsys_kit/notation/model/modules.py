"""The units of words, `Module`, and of rules, `Pattern`; the parts of a successor; symbols that mean the same in all notations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TypeAlias

from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.expressions import Expression, TextSpan

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
