"""Two words that are the same but for the names of their symbols."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import zip_longest

from lsys_kit.notation.model.modules import Module


class Renaming:
    """Which symbol of an answer stands for which of the solution, found as words are compared.

    Parameters
    ----------
    known
        The symbols of the solution.
    names
        "new": a symbol of the solution means itself, and a new one may stand for any; "any": any symbol may stand for any;
        "fixed": every symbol means itself. What is no name, such as + or [, always means itself.

    Examples
    --------
    >>> words = [[Module("x"), Module("y")], [Module("a"), Module("b")]]
    >>> Renaming(frozenset("ab"), "new").first_difference(*words), Renaming(frozenset("ab"), "fixed").first_difference(*words)
    (None, 0)
    >>> Renaming(frozenset("ab"), "new").first_difference([Module("b"), Module("a")], words[1])
    0
    """

    def __init__(self, known: Iterable[str], names: str = "new") -> None:
        self.known, self.names = frozenset(known), names
        self._wanted: dict[str, str] = {}
        self._own: dict[str, str] = {}

    def first_difference(self, mine: Sequence[Module], wanted: Sequence[Module]) -> int | None:
        """The first position at which a word of the answer is not that of the solution, or None."""
        for at, (own, other) in enumerate(zip_longest(mine, wanted)):
            if (
                own is None
                or other is None
                or own.arguments != other.arguments
                or not self._may_stand(own.symbol, other.symbol)
            ):
                return at
        return None

    def _may_stand(self, own: str, wanted: str) -> bool:
        """Whether a symbol may stand for another; from now on it does."""
        if own in self._wanted or wanted in self._own:
            return self._wanted.get(own) == wanted
        means_itself = (
            self.names == "fixed"
            or (self.names == "new" and own in self.known)
            or not (own[:1].isalpha() and wanted[:1].isalpha())
        )
        if means_itself and own != wanted:
            return False
        self._wanted[own], self._own[wanted] = wanted, own
        return True

    def own(self, module: Module) -> Module:
        """A module of the solution as the answer calls it."""
        return replace(module, symbol=self._own.get(module.symbol, module.symbol))

    def wanted(self, module: Module) -> Module:
        """A module of the answer as the solution calls it."""
        return replace(module, symbol=self._wanted.get(module.symbol, module.symbol))
