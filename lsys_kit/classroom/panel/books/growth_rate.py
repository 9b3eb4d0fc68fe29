"""By what factor a word grows in a step, in the long run, where that is known at once."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

from lsys_kit.budget import limits
from lsys_kit.derivation.core.traits import traits_of
from lsys_kit.derivation.growth.growth import greatest_root, growth
from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.system import LSystem

MOST_STATES = 40
"""Of systems with more states the rate takes too long."""
GREATEST = 1_000
"""Of greater roots only decimals are given."""
NEAR = 1e-6
"""A number that is nearer to a whole number than this may be one; whether it is, is then computed exactly."""


def growth_entry(system: LSystem, constants: Mapping[str, Any]) -> dict[str, str] | None:
    """The growth rate as a book holds it, or None.

    >>> from lsys_kit.notation.read import read
    >>> growth_entry(read("axiom: a\\na -> ab\\nb -> a"), {})
    {'rate': '(1 + √5)/2 ≈ 1.618'}
    """
    if traits_of(system).d0l:
        with suppress(LSystemError), limits(states=MOST_STATES):
            return {"rate": rate_text(growth(system, **constants).recurrence)}
    return None


def rate_text(rule: Sequence[int]) -> str:
    """The greatest root of the polynomial of a recurrence: exactly where it is whole or the root of a quadratic equation.

    >>> rate_text((4, -4)), rate_text((0, 2)), rate_text((1, 0, 1))
    ('2', '√2 ≈ 1.4142', '≈ 1.4656')
    """
    if not any(rule):
        return "0"
    polynomial, root = [1, *(-c for c in rule)], greatest_root(rule, exact=False)
    if abs(root - round(root)) < math.sqrt(NEAR) and not any(_remainder(polynomial, [1, -round(root)])):
        return str(round(root))
    decimals = f"≈ {root:.5g}"
    reach = math.ceil(2 * root) if root < GREATEST else 0
    for p in range(-reach, reach + 1):
        q = round(root * (root - p))
        if abs(root * (root - p) - q) < NEAR * root and not any(_remainder(polynomial, [1, -p, -q])):
            return f"{_quadratic_root(p, p * p + 4 * q)} {decimals}"
    return decimals


def _remainder(polynomial: Sequence[int], divisor: Sequence[int]) -> list[int]:
    """The remainder of a polynomial in whole numbers; the first coefficient of the divisor is 1."""
    left = [*polynomial]
    for at in range(len(left) - len(divisor) + 1):
        for k, c in enumerate(divisor[1:], 1):
            left[at + k] -= left[at] * c
    return left[max(0, len(left) - len(divisor) + 1) :]


def _quadratic_root(p: int, discriminant: int) -> str:
    """(p + √discriminant)/2, in lowest terms.

    >>> _quadratic_root(2, 12), _quadratic_root(1, 5), _quadratic_root(0, 8), _quadratic_root(0, 12)
    ('1 + √3', '(1 + √5)/2', '√2', '√3')
    """
    square = next(k for k in range(math.isqrt(discriminant), 0, -1) if discriminant % (k * k) == 0)
    inner, whole = discriminant // (square * square), p % 2 == 0 and square % 2 == 0
    p, square = (p // 2, square // 2) if whole else (p, square)
    text = f"{p} + " * (p != 0) + f"{square}" * (square != 1) + f"√{inner}"
    return text if whole else f"({text})/2"
