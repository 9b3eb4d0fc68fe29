"""The units of words, `Module`, and of rules, `Pattern`; parts of successors; the symbols that mean the same everywhere."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import TypeAlias, TypeVar, final

from lsys_kit.notation.model.arithmetic import Value, number_text, rounded
from lsys_kit.notation.model.expressions import Expression, TextSpan

OPENING, CLOSING = frozenset("[("), frozenset("])")
"""The brackets of branches; round ones occur in plant strings only."""
END = "ε"
"""In a right context, before a closing bracket: the branch ends there, with no further modules."""

CELLS = {"L": -1, "R": 1, "O": 0}
"""The cells of a filament, and where they point: `L(length, width, shade)` left and `R(length, width, shade)` right, the
modules that Prusinkiewicz (section 7, L-system 7) assumes to be predefined, and `O(length, width, shade)` nowhere; the shade,
0 to 1, shows age as in Jacob's figures."""
WALL = "W"
"""A wall between two cells, `W(age, shade)`, as in Prusinkiewicz, figure 8; the shade, 0 to 1, is optional."""


@dataclass(frozen=True)
class Module:
    """A unit of a word: a symbol with the values of its parameters (Prusinkiewicz, section 1).

    >>> print(Module("M", (5, -1)))
    M(5,-1)
    """

    symbol: str
    arguments: tuple[Value, ...] = ()
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return f"{self.symbol}({','.join(map(number_text, self.arguments))})" if self.arguments else self.symbol

    __repr__ = __str__


def rounded_module(module: Module) -> Module:
    """A module as it is shown: with the values that a person would write.

    >>> print(rounded_module(Module("F", (1.7185000000000001,))))
    F(1.719)
    """
    return Module(module.symbol, tuple(map(rounded, module.arguments)))


@dataclass(frozen=True)
class Pattern:
    """A module as an axiom or a rule writes it: a symbol with expressions.

    Before the arrow a `Name` that is not a constant is a parameter, and any other expression is a value that the module must
    have; in a successor an expression computes a value.

    >>> from lsys_kit.notation.model.expressions import Apply, Name, Number
    >>> print(Pattern("M", (Apply("+", (Name("t"), Number(1))),)))
    M(t + 1)
    """

    symbol: str
    arguments: tuple[Expression, ...] = ()
    at: TextSpan = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return f"{self.symbol}({','.join(map(str, self.arguments))})" if self.arguments else self.symbol

    __repr__ = __str__


def abridged_text(text: str, most: int = 2_000) -> str:
    """A text that is shown, without what is beyond so many characters.

    >>> abridged_text("axiom: F", 5)
    'axiom ... (8 characters)'
    """
    return text if len(text) <= most else f"{text[:most]} ... ({len(text):,} characters)"


def joined(texts: Iterable[str]) -> str:
    """The texts of modules as one word, with a blank only where two would run together: two names, or a name after a roll or an
    @, which might be taken for a macro of LaTeX or for one symbol.

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
    """Whether a name directly after a module would be read together with it."""
    return _word_like(last[-1:]) or last == "@" or (last == "\\" and name[:1].islower()) or (last == "." and name[:1].isdigit())


def _word_like(character: str) -> bool:
    return character.isalnum() or character == "_"


@final
@dataclass(frozen=True)
class Repeat:
    """A repeated part of a successor (GROGRA's `&(n) < ... >`).

    >>> from lsys_kit.notation.model.expressions import Name
    >>> print(Repeat(Name("n"), (Pattern("F"), Pattern("B", (Name("i"),))), "i"))
    repeat(n,i) <F B(i)>

    Attributes
    ----------
    count
        How many times.
    body
        What is repeated.
    index
        The name that counts 0, 1, 2, ... in the body; empty where there is none.
    """

    count: Expression
    body: tuple[Item, ...]
    index: str = ""
    at: TextSpan = field(default=None, compare=False, repr=False)
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "depth", 1 + max((item.depth for item in self.body if isinstance(item, Repeat)), default=0))

    def __str__(self) -> str:
        body = joined(map(str, self.body))
        end = " >" if body.endswith("-") else ">"  # together they would be an arrow
        return f"repeat({self.count}{f',{self.index}' if self.index else ''}) <{body}{end}"


Item: TypeAlias = Pattern | Repeat
"""A part of a successor."""
ItemT = TypeVar("ItemT", Pattern, Item)


def flat(items: Iterable[Item]) -> Iterator[Pattern]:
    """The modules of a successor, with those of repeated parts once.

    >>> from lsys_kit.notation.model.expressions import Number
    >>> [str(module) for module in flat((Pattern("A"), Repeat(Number(2), (Pattern("B"),))))]
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
            yield from item.arguments


def rewritten(
    items: Iterable[ItemT], module: Callable[[Pattern], Iterable[Pattern]], count: Callable[[Expression], Expression]
) -> tuple[ItemT, ...]:
    """A word or successor with others in place of its modules and of the counts of its repeated parts."""
    found: list[ItemT] = []
    for item in items:
        if isinstance(item, Repeat):
            found.append(replace(item, count=count(item.count), body=rewritten(item.body, module, count)))
        else:
            found += module(item)
    return tuple(found)


def with_expressions(items: Iterable[Item], change: Callable[[Expression], Expression]) -> tuple[Item, ...]:
    """A word or successor in which each expression is replaced by what a function makes of it.

    >>> from lsys_kit.notation.model.expressions import Name
    >>> print(*with_expressions((Pattern("A", (Name("t"),)), Repeat(Name("n"), (Pattern("B"),))), lambda _: Name("x")))
    A(x) repeat(x) <B>
    """
    return rewritten(items, lambda each: (replace(each, arguments=tuple(map(change, each.arguments))),), change)
