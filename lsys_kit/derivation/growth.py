"""Growth: how many modules a system has at any step, from the table of its states alone.

Entry (i, j) of the growth matrix says how many modules of state j the successor of state i holds. The counts at step n are
the axiom's counts times the n-th power of that matrix (Rozenberg and Salomaa, The Mathematical Theory of L Systems, 1980).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from lsys_kit.budget import current
from lsys_kit.derivation.courses import counted
from lsys_kit.derivation.states import States, closure
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model import LSystem, Module

if TYPE_CHECKING:
    import sympy


@dataclass(frozen=True)
class Growth:
    """The growth of a system whose states come to an end.

    Attributes
    ----------
    table
        The table of all states.
    """

    table: States

    @property
    def states(self) -> tuple[Module, ...]:
        """The module of each state, in the order of the rows and columns of the matrix."""
        return tuple(self.table.modules)

    @property
    def matrix(self) -> sympy.Matrix:
        """The growth matrix: entry (i, j) is how many j the successor of i holds.

        >>> from lsys_kit.notation.read import read
        >>> growth(read("axiom: a\\na -> ab\\nb -> a")).matrix
        Matrix([
        [1, 1],
        [1, 0]])
        """
        import sympy

        size = len(self.table)
        rows = [Counter(self.table.successor(state)) for state in range(size)]
        return sympy.Matrix(size, size, lambda i, j: rows[i][j])

    def counts(self, step: int) -> tuple[int, ...]:
        """How often each state occurs at a step."""
        counts = Counter(self.table.axiom)
        for _ in range(step):
            counts = counted(self.table, counts)
        return tuple(counts[state] for state in range(len(self.table)))

    def lengths(self, steps: int) -> list[int]:
        """The number of modules at steps 0 to `steps`, exactly, however large.

        >>> from lsys_kit.notation.read import read
        >>> growth(read("axiom: a\\na -> ab\\nb -> a")).lengths(10)
        [1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144]
        """
        counts = Counter(self.table.axiom)
        found = [counts.total()]
        for _ in range(steps):
            counts = counted(self.table, counts)
            found.append(counts.total())
        return found

    @property
    def recurrence(self) -> tuple[int, ...]:
        """The shortest rule for the lengths: coefficients c of N(t) = c1 N(t-1) + c2 N(t-2) + ...

        >>> from lsys_kit.notation.read import read
        >>> growth(read("axiom: a\\na -> ab\\nb -> a")).recurrence
        (1, 1)
        """
        terms = self.lengths(2 * len(self.table) + 1)
        return tuple(int(c) for c in shortest_recurrence(terms))

    @property
    def rate(self) -> float:
        """By what factor the word grows in one step, in the long run: the largest root of the recurrence's polynomial."""
        roots = np.roots([1, *(-c for c in self.recurrence)])
        return float(max((abs(root) for root in roots), default=0.0))

    def __repr__(self) -> str:
        rule = " + ".join(f"{'' if c == 1 else f'{c} '}N(t-{k})" for k, c in enumerate(self.recurrence, 1) if c)
        rule = rule.replace("+ -1 ", "- ").replace("+ -", "- ")
        return (f"{len(self.table)} states; lengths {', '.join(map(str, self.lengths(9)))}, ...; "
                f"N(t) = {rule or 0}; growth per step {self.rate:.4f}")


def growth(system: LSystem, **constants: object) -> Growth:
    """The growth of a system.

    Parameters
    ----------
    system
        A system whose states come to an end: following it from the axiom, no new module appears after a while.
    **constants
        New values for declared constants.

    Raises
    ------
    ModelLimitError
        The states do not end.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> growth(read("axiom: a\\na -> ab\\nb -> a"))
    2 states; lengths 1, 2, 3, 5, 8, 13, 21, 34, 55, 89, ...; N(t) = N(t-1) + N(t-2); growth per step 1.6180
    """
    states = States(system, constants)
    if closure(states, current().states) is None:
        raise ModelLimitError(f"The states of this system do not end: more than {current().states:,} were met",
                              limit=current().states, needed=len(states),
                              hint=f"The last one was {states.modules[-1]}; a parameter that grows for ever has no growth "
                                   "matrix.")
    return Growth(states)


def shortest_recurrence(terms: Sequence[int]) -> list[Fraction]:
    """The shortest linear recurrence that a sequence obeys (Berlekamp 1968, Massey 1969).

    >>> [int(c) for c in shortest_recurrence([1, 1, 1, 2, 2, 3, 4, 5, 7, 9])]
    [0, 1, 1]
    """
    current_rule: list[Fraction] = []
    best: list[Fraction] = []
    best_end, best_error = -1, Fraction(0)
    for i, term in enumerate(terms):
        error = Fraction(term) - sum((c * terms[i - 1 - k] for k, c in enumerate(current_rule)), Fraction(0))
        if not error:
            continue
        if best_end < 0:
            best_end, best_error, current_rule = i, error, [Fraction(0)] * (i + 1)
            continue
        factor = error / best_error
        update = [Fraction(0)] * (i - best_end - 1) + [factor] + [-factor * c for c in best]
        previous = current_rule
        width = max(len(current_rule), len(update))
        current_rule = [sum((row[k] for row in (previous, update) if k < len(row)), Fraction(0)) for k in range(width)]
        if i - len(previous) > best_end - len(best):
            best, best_end, best_error = previous, i, error
    while current_rule and not current_rule[-1]:
        current_rule.pop()
    return current_rule
