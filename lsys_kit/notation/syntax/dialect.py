"""What a notation consists of: how its text is cut, parsed and completed, and how a system is written in it.

Each notation has a file of its own, with its grammar beside it; `registry` has them all.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from lark import Token, Transformer

from lsys_kit.errors import ModelSyntaxError, ModelValueError
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.syntax.text.statements import without_comments
from lsys_kit.notation.syntax.text.transcript import Transcript, as_typed
from lsys_kit.notation.syntax.wording import KIT_SPELLING, Spelling

if TYPE_CHECKING:
    from lsys_kit.notation.syntax.builder import Draft
    from lsys_kit.notation.syntax.failure import ParseFailure


def whole(text: str, name: str | None) -> str:
    """A text that holds one system, which has no name."""
    if name is not None:
        raise ModelValueError("A text in this notation holds a single system, without a name", hint="Leave the name out.")
    return text


Diagnostic: TypeAlias = "str | Callable[[ParseFailure], ModelSyntaxError | None]"
"""What looks at the place where a parser failed: a table of mistakes, by name, or a function that finds an error or None."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Grammar:
    """How a statement is read.

    Attributes
    ----------
    name
        What the notation is called.
    transformer
        What makes records of what its grammar names.
    diagnostics
        What may be wrong where the parser fails, the most specific first.
    starts
        What can be parsed: a statement, and perhaps a word or an expression alone.
    spelling
        How messages spell what they quote.
    bare
        A text as mistakes are looked for in it: without its comments, every other character in its place.
    """

    name: str
    transformer: Callable[[], Transformer[Token, object]]
    diagnostics: Sequence[Diagnostic]
    starts: Sequence[str] = ("statement", "word", "expression")
    spelling: Spelling = KIT_SPELLING
    bare: Callable[[str], str] = without_comments

    @property
    def file(self) -> str:
        """The file of the grammar, in the folder of the dialects."""
        return f"{self.name.replace('-', '_')}/grammar.lark"


@dataclass(frozen=True, kw_only=True, eq=False)
class Dialect(Grammar):
    """One notation of L-systems, by the name that it has in `read` and `write`.

    Attributes
    ----------
    statements
        The offsets of a text's statements.
    finish
        What the statements mean together, as a system without its notes.
    module
        The text of a module.
    joined
        The texts of modules, as one word.
    write
        The text of a system that lacks nothing in the notation.
    lacks
        The features that the notation lacks, by their names in `formatting.FEATURES`.
    missing_feature
        What else a system has and the notation lacks, in words, or None; symbols are looked at apart.
    entry
        The text with the system of a name in it alone; without a name, with the only one.
    transcribe
        A text as its grammar reads it, where prints have it otherwise.
    translated
        A system with the notation's own turtle commands that draws the same; where there is none, the system itself.
    turtle
        Whose turtle commands its symbols are, if the text says nothing.
    likely
        How likely a text is in this notation: a count of its distinctive features.
    """

    statements: Callable[[str], Iterator[tuple[int, int]]]
    finish: Callable[[Draft], LSystem]
    module: Callable[[Module | Pattern], str]
    joined: Callable[[Iterable[str]], str]
    write: Callable[[LSystem], str]
    lacks: Sequence[str] = ()
    missing_feature: Callable[[LSystem], str | None] = lambda system: None
    likely: Callable[[str], int]
    entry: Callable[[str, str | None], str] = whole
    turtle: str = "abop"
    transcribe: Callable[[str], Transcript] = as_typed
    translated: Callable[[LSystem], LSystem] = lambda system: system

    def word(self, modules: Iterable[Module | Pattern]) -> str:
        """The text of a word."""
        return self.joined(map(self.module, modules))
