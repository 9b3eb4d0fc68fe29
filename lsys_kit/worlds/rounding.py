"""Measured values: rounded, so that no rule depends on the last bits of a sine."""

from __future__ import annotations

import math
from fractions import Fraction

from lsys_kit.derivation.core.rules import number_from
from lsys_kit.notation.model.arithmetic import Value

DECIMALS = 9
"""The number of decimals to which measured values are rounded."""
_PARTS = 10**DECIMALS
_READ_OFF = 1e6
"""Below, a double times the parts is so exact that the nearest whole number is the one meant."""


def rounded(value: float, arithmetic: str = "exact") -> Value:
    """A measured value, exact to nine decimals; an infinite one stays infinite.

    >>> rounded(0.1 + 0.2), rounded(4.000000000000001), rounded(math.inf)
    (Fraction(3, 10), 4, inf)
    """
    if not math.isfinite(value):
        return value
    nearest = round(value, DECIMALS) + 0.0
    if arithmetic == "float":
        return nearest
    if abs(nearest) >= _READ_OFF:
        return number_from(nearest)
    return int(nearest) if nearest.is_integer() else Fraction(round(nearest * _PARTS), _PARTS)
