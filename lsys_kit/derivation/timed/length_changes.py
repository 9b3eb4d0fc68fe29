"""What a division does to the length of a filament: the length of the mother, and that of her daughters."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.system import Production

if TYPE_CHECKING:
    import sympy

TOLERANCE = 1e-9
"""Lengths that differ by no more than this share are equal."""


@dataclass(frozen=True)
class Division:
    """What a production does to the length of a filament, or to a derivative of that length.

    Attributes
    ----------
    production
        The production.
    order
        0 for the length itself, k for its k-th derivative.
    mother, daughters
        The length of the mother at her terminal age, and that of all daughters together at their first ages.
    """

    production: Production
    order: int
    mother: sympy.Expr
    daughters: sympy.Expr

    @cached_property
    def defect(self) -> sympy.Expr:
        """By how much the mother is longer than her daughters; 0 where the length is continuous."""
        import sympy

        equal = equal_lengths(self.mother, self.daughters)
        return sympy.Integer(0) if equal else sympy.factor_terms(self.mother - self.daughters)

    def __str__(self) -> str:
        what = f"{self.production}: " + (f"derivative {self.order}: " if self.order else "")
        if self.defect == 0:
            return f"{what}continuous"
        before, after, jump = (number_text(_brief(part)) for part in (self.mother, self.daughters, -self.defect))
        return what + (
            f"continuous where {before} = {after}"
            if self.defect.free_symbols
            else f"{before} before, {after} after, a jump of {jump}"
        )


def equal_lengths(before: sympy.Expr, after: sympy.Expr) -> bool:
    """Whether two lengths are equal whatever their unknown names are: compared where nothing is equal by coincidence."""
    import sympy

    symbols = sorted(before.free_symbols | after.free_symbols, key=str)
    point = {symbol: sympy.Float(f"1.{2345679 + 1357913 * i}", 20) for i, symbol in enumerate(symbols)}
    try:
        one, other, left = (abs(value.evalf(20, subs=point)).evalf() for value in (before, after, before - after))
    except ValueError:  # it compares numbers that are not real
        return False
    return all(value.is_Float or value.is_Rational for value in (one, other, left)) and bool(left <= TOLERANCE * (one + other))


def _brief(value: sympy.Expr) -> sympy.Expr | float:
    """A number to six digits; anything else as it is."""
    found = value.evalf()
    return float(f"{float(found):.6g}") if found.is_Float or found.is_Rational else value


def unknown_names(*expressions: sympy.Expr) -> set[str]:
    """The names in some expressions."""
    return {symbol.name for expression in expressions for symbol in expression.free_symbols}
