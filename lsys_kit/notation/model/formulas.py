"""Formulas as mathematics sets them: as elements of MathML, and as a line of text.

An element is a list, its name and what is in it; a number, a name or a sign is a text. So nothing in a formula can become
markup, and whoever shows it makes an element of each list, and of each text a number (`mn`), a name (`mi`) or a sign (`mo`).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias

from lsys_kit.notation.model.arithmetic import Value, expression_of, is_symbolic, normalised, number_text, rounded

if TYPE_CHECKING:
    import sympy

Element: TypeAlias = "str | list[Element]"
"""A text, or the name of an element of MathML and what is in it."""
_SMALL = 9
"""Fractions up to this denominator are written as fractions, others as decimals where those are short."""
_RAISED = str.maketrans("0123456789+−n()", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ⁿ⁽⁾")
_VULGAR = {
    "1/2": "½", "1/3": "⅓", "2/3": "⅔", "1/4": "¼", "3/4": "¾", "1/5": "⅕", "2/5": "⅖", "3/5": "⅗", "4/5": "⅘",
    "1/6": "⅙", "5/6": "⅚", "1/7": "⅐", "1/8": "⅛", "3/8": "⅜", "5/8": "⅝", "7/8": "⅞", "1/9": "⅑",
}  # fmt: skip
_ROOTS = {"3": "∛", "4": "∜"}
_SIGNS = {"<": "<", "<=": "≤", ">": ">", ">=": "≥", "==": "=", "!=": "≠"}
_MINUS = "−"
_NAME = re.compile(r"(?<![\\A-Za-z])[A-Za-z]{2,}+")
"""Several letters in LaTeX that are no command."""


def formula_element(value: object) -> Element:
    """A number, a formula or a comparison as an element of MathML.

    >>> import sympy
    >>> q = sympy.Symbol("q")
    >>> formula_element(q**2), formula_element((1 - q) / 2)
    (['msup', 'q', '2'], ['mrow', ['mfrac', '1', '2'], '−', ['mrow', ['mfrac', '1', '2'], 'q']])
    """
    expression = expression_of(value)
    if getattr(expression, "is_Relational", False):
        left, right = formula_element(expression.lhs), formula_element(expression.rhs)
        near = [] if expression.rhs.free_symbols or expression.rhs.is_Rational else ["≈", _number(float(expression.rhs))]
        return ["mrow", left, _SIGNS[expression.rel_op], right, *near]
    return _element(expression)


def formula_text(value: object) -> str:
    """The same as a line of text.

    >>> import sympy
    >>> q = sympy.Symbol("q")
    >>> [formula_text(each) for each in (q**2, q / 2, 1 - q**10, sympy.sqrt(2) * q, 1 / (q + 1), q**2 > sympy.Rational(1, 2))]
    ['q²', '½q', '1 − q¹⁰', '√2 q', '1/(q + 1)', 'q² > ½']
    """
    return element_text(formula_element(value))


def formula_latex(value: object) -> str:
    """The same in LaTeX. A name of several letters is one name; a sum over roots says of which polynomial.

    >>> import sympy
    >>> spans, q = sympy.Symbol("lifeTimeA"), sympy.Symbol("q")
    >>> formula_latex(q**-spans), formula_latex(sympy.Ne(q, 1))
    ('q^{- \\\\textit{lifeTimeA}}', 'q \\\\neq 1')
    >>> formula_latex(sympy.RootSum(q**3 - q - 1, sympy.Lambda(q, 2**q)))
    '\\\\sum_{q^{3} - q - 1 = 0} 2^{q}'
    """
    import sympy

    expression = expression_of(value)
    names = {each: _NAME.sub(r"\\textit{\g<0>}", str(sympy.latex(each))) for each in expression.free_symbols}
    sums = {each: sympy.Dummy() for each in expression.atoms(sympy.RootSum)}
    for each, stand_in in sums.items():
        body = formula_latex(each.fun.expr)
        names[stand_in] = rf"\sum_{{{formula_latex(each.poly.as_expr())} = 0}} {body}"
    return str(sympy.latex(expression.xreplace(sums), symbol_names=names))


def formula_line(value: object) -> str:
    """The same as the notations write it. A sum over roots says of which polynomial.

    >>> import sympy
    >>> x = sympy.Symbol("x")
    >>> formula_line(2 + sympy.RootSum(x**3 - x - 1, sympy.Lambda(x, 2**x)))
    'sum(2^x for x^3 - x - 1 = 0) + 2'
    """
    import sympy

    expression = expression_of(value)
    sums = {
        each: sympy.Symbol(f"sum({formula_line(each.fun.expr)} for {formula_line(each.poly.as_expr())} = 0)")
        for each in expression.atoms(sympy.RootSum)
    }
    return number_text(expression.xreplace(sums))


def element_text(element: Element) -> str:
    """The text of an element of MathML that `formula_element` made."""
    if isinstance(element, str):
        return element
    tag, *parts = element
    if tag == "mrow":
        return _joined(parts)
    if tag == "mfrac":
        above, below = (_closed(part) for part in parts)
        return _VULGAR.get(f"{above}/{below}", f"{above}/{below}")
    if tag == "msqrt":
        return f"√{_closed(parts[0])}"
    base, index = parts
    if tag == "msub":
        return f"{base}_{index}"
    if tag == "mroot":
        return f"{_ROOTS.get(element_text(index)) or _lifted(element_text(index)) + '√'}{_closed(base)}"
    return _closed(base) + _lifted(element_text(index))


def _lifted(text: str) -> str:
    return (
        text.translate(_RAISED) if all(ord(sign) in _RAISED for sign in text) else f"^({text})" if len(text) > 1 else f"^{text}"
    )


def _closed(element: Element) -> str:
    """A text that can stand beside a sign: in parentheses, where it has several parts."""
    text = element_text(element)
    several = isinstance(element, list) and element[0] in ("mrow", "mfrac") and len(text) > 1 and element[1] != "("
    return f"({text})" if several else text


def _joined(parts: Sequence[Element]) -> str:
    """What stands side by side: binary signs have blanks around them, and so have two things that would run together."""
    text, signs = "", ("+", _MINUS, "≈", *_SIGNS.values())
    for number, part in enumerate(parts):
        said = element_text(part)
        if part in signs and number and parts[number - 1] != "(":
            text += f" {said} "
        else:
            beside = [*parts[max(0, number - 1) : number], *parts[number + 1 : number + 2]]
            if (
                isinstance(part, list)
                and part[0] == "mfrac"
                and "/" in said
                and not all(each in (*signs, "(", ")") for each in beside)
            ):
                said = f"({said})"
            apart = text[-1:].isalnum() and said[:1].isalnum() and ((number and _long(parts[number - 1])) or _long(part))
            text += (" " if apart or (number and _is_root(parts[number - 1]) and said[:1].isalnum()) else "") + said
    return text


def _long(part: Element) -> bool:
    """Whether a name has several letters."""
    name = part[1] if isinstance(part, list) and part[0] == "msup" else part
    return name[0] == "msub" or (isinstance(name, str) and len(name) > 1 and name[0].isalpha())


def _is_root(part: Element) -> bool:
    return isinstance(part, list) and part[0] in ("msqrt", "mroot")


def _number(value: Value) -> str:
    return number_text(rounded(value)).replace("-", _MINUS)


def _plain(number: sympy.Number) -> Value:
    return float(number) if number.is_Float else normalised(Fraction(int(number.p), int(number.q)))


def _rational(value: Value) -> Element:
    """A number that is not negative: a fraction, where its denominator is small."""
    if isinstance(value, Fraction) and (value.denominator <= _SMALL or "/" in number_text(rounded(value))):
        return ["mfrac", str(value.numerator), str(value.denominator)]
    return _number(value)


@lru_cache(maxsize=4_096)
def _element(expression: sympy.Expr) -> Element:
    if expression.is_Add:
        terms = expression.as_ordered_terms()
        terms.sort(key=_is_negative)  # stable: 1 - q, and no sign at the beginning where that can be
        parts: list[Element] = []
        for term in terms:
            negative = _is_negative(term)
            sign = [_MINUS] if negative else ["+"] if parts else []
            parts += [*sign, _element(-term if negative else term)]
        return ["mrow", *parts]
    if _is_negative(expression):
        return ["mrow", _MINUS, _factor(-expression)]
    below = expression.is_Pow and _is_below(expression.exp)
    return _product(expression) if expression.is_Mul or expression.is_Number or below else _atom(expression)


def _is_negative(expression: sympy.Expr) -> bool:
    return bool(expression.could_extract_minus_sign()) if not expression.is_Add else False


def _product(expression: sympy.Expr) -> Element:
    """A number, and powers: those with negative exponents below a line."""
    number, rest = expression.as_coeff_Mul()
    factors = [factor.as_base_exp() for factor in rest.as_ordered_factors() if factor != 1]
    above = [base**exponent for base, exponent in factors if not _is_below(exponent)]
    below = [base**-exponent for base, exponent in factors if _is_below(exponent)]
    if below and not number.is_Float:
        above, below = [*([number.p] if number.p != 1 else []), *above], [*([number.q] if number.q != 1 else []), *below]
        return ["mfrac", _row(above or [1]), _row(below)]
    front = [] if number == 1 and above else [_rational(_plain(number))]
    factors_above = [*front, *map(_factor, above)]
    whole: Element = ["mrow", *factors_above] if len(factors_above) > 1 else factors_above[0]
    return ["mfrac", whole, _row(below)] if below else whole


def _is_below(exponent: sympy.Expr) -> bool:
    return bool(exponent.could_extract_minus_sign())


def _row(factors: list[sympy.Expr | int]) -> Element:
    """Factors above or below a line; a sum that is alone there needs no parentheses."""
    if len(factors) == 1 and not isinstance(factors[0], int):
        return _element(factors[0])
    return ["mrow", *map(_factor, factors)] if len(factors) > 1 else str(factors[0])


def _factor(expression: sympy.Expr) -> Element:
    """A part of a product: a sum in parentheses."""
    if isinstance(expression, int):
        return str(expression)
    found = _element(expression) if expression.is_Add or expression.is_Mul or expression.is_Number else _atom(expression)
    return ["mrow", "(", *found[1:], ")"] if expression.is_Add else found


def _atom(expression: sympy.Expr) -> Element:
    """A letter, a power, a root, or a function."""
    if expression.is_Symbol:
        name, joint, subscript = str(expression.name).partition("_")
        return ["msub", name, subscript] if name and subscript else name + joint + subscript
    if expression.is_Pow:
        base, exponent = expression.as_base_exp()
        if _is_below(exponent):
            return _product(expression)
        if exponent.is_Rational and exponent.p == 1 and exponent.q > 1:
            decimal = base.is_Rational and "/" not in number_text(rounded(_plain(base)))
            under = _number(_plain(base)) if decimal else _element(base)
            return ["msqrt", under] if exponent.q == 2 else ["mroot", under, str(exponent.q)]
        inner = (
            _factor(base)
            if base.is_Symbol or base.is_Add or (base.is_Integer and base >= 0)
            else ["mrow", "(", _element(base), ")"]
        )
        return ["msup", inner, _element(exponent)]
    if expression.is_Function:
        inside: list[Element] = []
        for argument in expression.args:
            inside += [*([","] if inside else []), *_argument(argument)]
        return ["mrow", str(expression.func.__name__), "(", *inside, ")"]
    return "π" if str(expression) == "pi" else str(expression)


def _argument(argument: sympy.Expr) -> list[Element]:
    """What a function is applied to: an angle in degrees."""
    import sympy

    degrees = argument * 180 / sympy.pi
    return [_element(argument)] if degrees.has(sympy.pi) else [_factor(degrees), "°"]


def _signed(value: Value) -> Element:
    return ["mrow", _MINUS, _number(-value)] if value < 0 else _number(value)


def values_element(values: Sequence[Value]) -> tuple[Element, str] | None:
    """The values of a module in parentheses, as an element and as a text, if one of them is a formula.

    >>> import sympy
    >>> values_element((1, sympy.Symbol("q") ** 2))
    (['mrow', '(', '1', ',', ['msup', 'q', '2'], ')'], '(1,q²)')
    """
    if not any(map(is_symbolic, values)):
        return None
    elements = [formula_element(value) if is_symbolic(value) else _signed(value) for value in values]
    inside = [part for element in elements for part in (",", element)][1:]
    return ["mrow", "(", *inside, ")"], f"({','.join(map(element_text, elements))})"
