"""Formulas as mathematics sets them."""

from __future__ import annotations

import pytest
import sympy

from lsys_kit.notation.model.formulas import formula_element, formula_text

Q, R, LIFE = sympy.symbols("q r lifeTime")
HALF = sympy.Rational(1, 2)


@pytest.mark.parametrize(
    ("formula", "text"),
    [
        (Q**2, "q²"),
        (Q / 2, "½q"),
        (-Q, "−q"),
        (1 - Q**10, "1 − q¹⁰"),
        (sympy.sqrt(2), "√2"),
        (sympy.root(2, 3) * Q, "∛2 q"),
        (2 * LIFE - Q, "2 lifeTime − q"),
        (1 / (Q + 1), "1/(q + 1)"),
        ((1 - Q**3) / (1 - Q), "(1 − q³)/(1 − q)"),
        (-HALF / Q, "−1/(2q)"),
        (-1 / Q, "−1/q"),
        (sympy.pi * Q, "πq"),
        ((Q + 1) ** 2, "(q + 1)²"),
        (Q**R, "q^r"),
        (Q ** (R + 1), "q^(r + 1)"),
        (sympy.sqrt(Q + 1), "√(q + 1)"),
        (sympy.sin(sympy.pi * Q / 180), "sin(q°)"),
        (sympy.Rational(7, 10) * Q, "0.7q"),
        (sympy.Rational(1, 30) * Q, "(1/30)q"),
        (sympy.Rational(1, 30) - Q, "1/30 − q"),
        (sympy.Rational(1, 3000) * Q, "0.0003333q"),
        (sympy.Float(0.3) * Q, "0.3q"),
        (Q**2 >= HALF, "q² ≥ ½"),
        (sympy.Ne(Q, 1), "q ≠ 1"),
        (2 * sympy.Symbol("t_div") ** 2 - Q * sympy.Symbol("t_s"), "2 t_div² − q t_s"),
        (sympy.Lt(Q, sympy.Pow(sympy.Rational(3, 10), sympy.Rational(1, 4), evaluate=False)), "q < ∜0.3 ≈ 0.7401"),
    ],
)
def test_a_formula_is_a_line_of_text(formula: sympy.Basic, text: str) -> None:
    assert formula_text(formula) == text


def test_a_formula_is_elements_of_mathml_with_texts_in_them() -> None:
    assert formula_element(sympy.sqrt(2) * Q**2 / 2) == ["mrow", ["mfrac", "1", "2"], ["msqrt", "2"], ["msup", "q", "2"]]
    assert formula_element(1 / Q) == ["mfrac", "1", "q"]
