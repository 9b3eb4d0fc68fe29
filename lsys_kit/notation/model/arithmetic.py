"""Arithmetic as the papers mean it: exact where that is possible.

Sums, differences, products, quotients and whole powers of rational numbers stay rational; results that are not rational
(`sqrt(2)`, `2^0.5`, `exp(1)`) are doubles. A result that is too long is refused.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias

from lsys_kit.budget import current
from lsys_kit.supervision import supervised
from lsys_kit.translation import gettext

if TYPE_CHECKING:
    import sympy

Value: TypeAlias = int | Fraction | float
"""A parameter's value: whole, rational, or a double."""
SMALL = 2**63
"""Whole numbers below this need no check of their size."""
FEW_BITS = 64
"""Nor do numbers with no more bits than this."""


SHORT = 40
"""A decimal with at most so many places is easier to read than a quotient."""
PLAIN = 300
"""A literal of more characters is written with an exponent, where that makes it shorter."""


def number_text(value: Value) -> str:
    """A value as the notations write it: decimal where that is exact and short, else a quotient.

    >>> [number_text(v) for v in (3, Fraction(7, 10), Fraction(1, 3), 0.1, 2.0)]
    ['3', '0.7', '1/3', '0.1', '2']
    """
    if isinstance(value, int):
        return str(value)
    if is_symbolic(value):
        return str(value).replace("**", "^")
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 1e16 else repr(value)
    places = _places(value)
    return f"{value.numerator}/{value.denominator}" if places is None or places > SHORT else _decimal(value, places)


def literal_text(value: Value) -> str:
    """A literal number: decimal wherever that is exact, however long, so that it reads back as one number.

    >>> literal_text(Fraction(1, 2**41)) == f"{1 / 2**41:.41f}", literal_text(Fraction(1, 3))
    (True, '1/3')
    >>> literal_text(Fraction(3, 10**400))
    '3e-400'
    """
    if not isinstance(value, Fraction) or (places := _places(value)) is None:
        return number_text(value)
    text = _decimal(value, places)
    return text if len(text) <= PLAIN else min(text, _scientific(value, places), key=len)


def _places(value: Fraction) -> int | None:
    """How many decimal places a fraction has; None where they never end."""
    rest, twos, fives = value.denominator, 0, 0
    while rest % 2 == 0:
        rest, twos = rest // 2, twos + 1
    while rest % 5 == 0:
        rest, fives = rest // 5, fives + 1
    return max(twos, fives) if rest == 1 else None


def _decimal(value: Fraction, places: int) -> str:
    digits = str(abs(value.numerator) * 10**places // value.denominator).rjust(places + 1, "0")
    return ("-" if value < 0 else "") + f"{digits[:-places]}.{digits[-places:]}"


def _scientific(value: Fraction, places: int) -> str:
    """A decimal fraction with an exponent, and one digit before the point."""
    digits = str(abs(value.numerator) * 10**places // value.denominator)
    point = f".{digits[1:]}" if digits[1:] else ""
    return f"{'-' * (value < 0)}{digits[0]}{point}e{len(digits) - 1 - places}"


def shortest_decimal(value: Value) -> Value:
    """A double as the decimal that it is printed as; any other value as it is.

    >>> shortest_decimal(0.1), shortest_decimal(2.0), shortest_decimal(3)
    (Fraction(1, 10), 2, 3)
    """
    return normalised(Fraction(repr(value))) if isinstance(value, float) and math.isfinite(value) else value


def is_symbolic(value: object) -> bool:
    """Whether a value contains a letter: a sympy expression, as in `derive(system, 3, dt="dt")`, or a `Formula`."""
    return not isinstance(value, int | Fraction | float)


MOST_TERMS, MOST_FORMULA_TERMS = 1_000, 100
"""A symbolic value has at most so many terms, and one that is to be read beside its number."""


def equal_values(left: Value, right: Value) -> bool:
    """Whether two values are equal; undecided where that depends on an unknown constant.

    >>> equal_values(Fraction(4, 2), 2)
    True

    Raises
    ------
    TypeError
        The values are equal for some values of an unknown constant.
    """
    if (left.__class__ is int and right.__class__ is int) or not (is_symbolic(left) or is_symbolic(right)):
        return left == right
    if isinstance(left, Formula) or isinstance(right, Formula):
        one, other = (left, right) if isinstance(left, Formula) else (right, left)
        return one.equals(other)
    difference = _expanded(left - right)
    if difference.free_symbols:
        raise TypeError
    return bool(difference == 0)


def expanded_value(value: object) -> Value:
    """A value that may hold unknown constants, multiplied out; a number where they cancel.

    >>> import sympy
    >>> t = sympy.Symbol("t")
    >>> expanded_value(t + 2 * (t + 1)), expanded_value(t - t + sympy.Rational(1, 2))
    (3*t + 2, Fraction(1, 2))
    """
    if isinstance(value, Formula):
        expression = value.expression if _is_multiplied_out(value.expression) else _expanded(value.expression)
        if expression.is_Add and len(expression.args) > MOST_FORMULA_TERMS:
            raise ValueError(gettext("the formula has more than {number} terms", number=MOST_FORMULA_TERMS))
        found: sympy.Expr = Formula(expression, value.number, value.decisions)
        return value.number if expression.is_Rational else found
    found = _expanded(value)
    if found.is_Rational:
        return normalised(Fraction(int(found.p), int(found.q)))
    return float(found) if found.is_Float else found


def _expanded(value: sympy.Expr) -> sympy.Expr:
    """A symbolic value, multiplied out; refused where that has too many terms."""
    with supervised():
        found = value.expand()
    if len(found.args) > MOST_TERMS:
        raise OverflowError
    return found


def _is_multiplied_out(expression: sympy.Expr) -> bool:
    """Whether an expression is plainly a product of powers of letters."""
    return expression.is_Symbol or all(
        part.is_Number or part.is_Symbol or (part.is_Pow and part.base.is_Symbol)
        for part in (expression.args if expression.is_Mul else (expression,))
    )


def short_text(value: Value) -> str:
    """A value in a message: shortened, where it is long.

    >>> short_text(Fraction(1, 2)), short_text(Fraction(1, 3**70))
    ('0.5', '3.99...e-34')
    """
    text = number_text(value)
    return text if len(text) <= 20 else f"{float(value):.2e}".replace("e", "...e")


DIGITS = 4
"""A value that is only shown has at most so many digits, unless it is whole."""
ALIKE = 1e-6
"""Numbers whose difference is a smaller part of them look alike."""


def rounded(value: Value) -> Value:
    """A value as a person would write it down: a whole number or a short fraction as it is, any other with four digits, unless
    it would look like a number from which it only just differs.

    >>> [number_text(rounded(v)) for v in (Fraction(118587876497, 38400000000), Fraction(80, 3), 123456, 12345.678, 1e-9 / 3)]
    ['3.088', '80/3', '123456', '12346', '3.333e-10']
    >>> number_text(rounded(0.7 + 0.1 + 0.1 + 0.1))
    '0.9999999999999999'
    """
    if isinstance(value, int) or is_symbolic(value):
        return value
    text = number_text(value)
    if "/" in text and sum(map(str.isdigit, text)) <= DIGITS:
        return value
    near = float(value)
    if 10**DIGITS <= abs(near) < 1e16:
        return float(round(near))
    short = float(f"{near:.{DIGITS}g}")
    return short if short and math.isfinite(short) and abs(short - near) >= ALIKE * abs(near) else value


def normalised(value: Value) -> Value:
    """A whole rational number as an int.

    >>> normalised(Fraction(4, 2))
    2
    """
    return value.numerator if isinstance(value, Fraction) and value.denominator == 1 else value


def bounded_exact(value: Value) -> Value:
    """The result of an operation in its simplest form; an exact result that is too long is refused."""
    if value.__class__ is int and -SMALL < value < SMALL:
        return value
    if isinstance(value, float) or is_symbolic(value):
        return value
    if (bits := value.numerator.bit_length() + value.denominator.bit_length()) > FEW_BITS and bits > current().bits:
        raise OverflowError
    return normalised(value)


def finite(value: Value) -> Value:
    """The value, unless it is too large for a double or not a number."""
    if is_symbolic(value) or math.isfinite(value):  # an OverflowError by itself, where a rational number is past that
        return value
    raise ValueError(gettext("the result is not a number")) if math.isnan(value) else OverflowError


def divide(left: Value, right: Value) -> Value:
    """The exact quotient of rational numbers; the quotient in doubles where one of them is a double."""
    if isinstance(left, float) or isinstance(right, float) or is_symbolic(left) or is_symbolic(right):
        return left / right
    return bounded_exact(Fraction(left) / right)


def power(base: Value, exponent: Value) -> Value:
    """The exact power where the exponent is whole and the base rational; else the power in doubles.

    >>> power(Fraction(1, 2), 3), power(2, -1), power(4, Fraction(1, 2))
    (Fraction(1, 8), Fraction(1, 2), 2.0)
    """
    if is_symbolic(base) or is_symbolic(exponent):
        return base**exponent
    if isinstance(base, float) or not isinstance(exponent, int):
        result: float | complex = float(base) ** float(exponent)
        if isinstance(result, complex):
            raise ValueError(gettext("{value} is not a number", value=f"({short_text(base)})^({short_text(exponent)})"))
        return result
    if abs(exponent) > current().exponent:
        raise OverflowError
    if max(base.numerator.bit_length(), base.denominator.bit_length()) * abs(exponent) > 4 * current().bits:
        raise OverflowError
    return bounded_exact(Fraction(base) ** exponent)


def rounding(function: Callable[[Value], int]) -> Callable[[Value], Value]:
    """A function that rounds to whole numbers: a double stays a double."""
    return lambda x: float(function(x)) if isinstance(x, float) else function(x)


def remainder(left: Value, right: Value) -> Value:
    """What C's `%` leaves of two numbers: both lose what follows their points, and the sign is that of the first.

    >>> remainder(-7, 3), remainder(Fraction(79, 10), 3), remainder(7, -3), remainder(-0.5, 2.0)
    (-1, 1, 1, 0.0)
    """
    whole, by = int(left), int(right)  # a TypeError where an unknown constant decides
    rest = abs(whole) % abs(by)
    rest = -rest if whole < 0 else rest
    return float(rest) if isinstance(left, float) or isinstance(right, float) else rest


def partial_function(name: str, function: Callable[[Value], Value]) -> Callable[[Value], Value]:
    """A function that is not defined everywhere; where it is not, the error says so in plain words."""

    def value(x: Value) -> Value:
        try:
            if isinstance(x, Formula) and name in symbolic_functions():
                return Formula(symbolic_functions()[name](x.expression), function(x.number), x.decisions)
            return function(x)
        except ValueError:
            raise ValueError(gettext("{value} is not a number", value=f"{name}({short_text(x)})")) from None

    return value


def reason_of(fault: Exception) -> str:
    """Why a calculation failed, in words.

    >>> reason_of(ZeroDivisionError())
    'division by zero'
    """
    if isinstance(fault, ZeroDivisionError):
        return gettext("division by zero")
    if isinstance(fault, OverflowError):
        return gettext("the result is too large")
    return str(fault)


@lru_cache(maxsize=1)
def symbolic_functions() -> Mapping[str, Callable[[sympy.Expr], sympy.Expr]]:
    """The functions of one number, by their names, as sympy has them; angles are in degrees.

    >>> import sympy
    >>> symbolic_functions()["sqrt"](2), symbolic_functions()["sin"](sympy.Integer(60))
    (sqrt(2), sqrt(3)/2)
    """
    import sympy

    degree = sympy.pi / 180
    return {
        "sqrt": sympy.sqrt,
        "exp": sympy.exp,
        "log": sympy.log,
        "sin": lambda x: sympy.sin(x * degree),
        "cos": lambda x: sympy.cos(x * degree),
        "tan": lambda x: sympy.tan(x * degree),
        "asin": lambda x: sympy.asin(x) / degree,
        "acos": lambda x: sympy.acos(x) / degree,
        "atan": lambda x: sympy.atan(x) / degree,
    }


Decision: TypeAlias = "tuple[sympy.Expr, str, sympy.Expr]"
"""A comparison that was found true: two sympy expressions, and the relation between them."""
_OPPOSITE = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!="}


class Formula:
    """A value with letters in it whose numbers are known: an expression, and the number that it is.

    What is computed of it is computed of both. What only a number can answer, a comparison or how often something is repeated,
    is answered by the number, and becomes a decision: what must be so of other numbers, for the formulas to hold for them too.

    Attributes
    ----------
    expression
        The formula, as sympy has it.
    number
        Its value.
    decisions
        What was decided by numbers so far, in the order of time; all formulas of a derivation share it.

    Examples
    --------
    >>> import sympy
    >>> decisions = {}
    >>> q = Formula(sympy.Symbol("q"), Fraction(1, 2), decisions)
    >>> (3 * q**2).number, 1 - q, q * q < q
    (Fraction(3, 4), 1 - q, True)
    >>> [*decisions]
    [(q**2, '<', q)]
    """

    __slots__ = ("decisions", "expression", "number")

    def __init__(self, expression: sympy.Expr, number: Value, decisions: dict[Decision, None]) -> None:
        self.expression, self.number, self.decisions = expression, number, decisions

    def __eq__(self, other: object) -> bool:
        """The same formula with the same number: by this, states are told apart."""
        return (
            isinstance(other, Formula)
            and self.expression == other.expression
            and self.number == other.number
            and type(self.number) is type(other.number)
        )

    def __hash__(self) -> int:
        return hash(self.expression)

    def __repr__(self) -> str:
        return str(self.expression)

    @property
    def free_symbols(self) -> set[sympy.Symbol]:
        """The letters in it."""
        found: set[sympy.Symbol] = self.expression.free_symbols
        return found

    def _with(
        self,
        function: Callable[[sympy.Expr, sympy.Expr], sympy.Expr],
        left: Value | Formula,
        right: Value | Formula,
        numbers: Callable[[Value, Value], Value],
    ) -> Formula:
        number = bounded_exact(numbers(number_of(left), number_of(right)))
        return Formula(function(expression_of(left), expression_of(right)), number, self.decisions)

    def __add__(self, other: Value | Formula) -> Formula:
        return self._with(operator.add, self, other, operator.add)

    def __radd__(self, other: Value | Formula) -> Formula:
        return self._with(operator.add, other, self, operator.add)

    def __sub__(self, other: Value | Formula) -> Formula:
        return self._with(operator.sub, self, other, operator.sub)

    def __rsub__(self, other: Value | Formula) -> Formula:
        return self._with(operator.sub, other, self, operator.sub)

    def __mul__(self, other: Value | Formula) -> Formula:
        return self._with(operator.mul, self, other, operator.mul)

    def __rmul__(self, other: Value | Formula) -> Formula:
        return self._with(operator.mul, other, self, operator.mul)

    def __truediv__(self, other: Value | Formula) -> Formula:
        return self._with(operator.truediv, self, other, divide)

    def __rtruediv__(self, other: Value | Formula) -> Formula:
        return self._with(operator.truediv, other, self, divide)

    def __pow__(self, other: Value | Formula) -> Formula:
        return self._with(operator.pow, self, other, power)

    def __rpow__(self, other: Value | Formula) -> Formula:
        return self._with(operator.pow, other, self, power)

    def __mod__(self, other: Value | Formula) -> Formula:
        return self - other * math.floor(self / other)

    def __rmod__(self, other: Value | Formula) -> Formula:
        return other - self * math.floor(other / self)

    def __neg__(self) -> Formula:
        return Formula(-self.expression, -self.number, self.decisions)

    def __abs__(self) -> Formula:
        return self if self >= 0 else -self

    def _decided(self, other: object, relation: str, truth: bool) -> bool:
        """A comparison that the numbers have decided, kept in mind where letters have a say."""
        left, right = self.expression, expression_of(other)
        if left != right and (left.free_symbols or right.free_symbols):
            self.decisions.setdefault((left, relation if truth else _OPPOSITE[relation], right))
        return truth

    def __lt__(self, other: Value | Formula) -> bool:
        return self._decided(other, "<", self.number < number_of(other))

    def __le__(self, other: Value | Formula) -> bool:
        return self._decided(other, "<=", self.number <= number_of(other))

    def __gt__(self, other: Value | Formula) -> bool:
        return self._decided(other, ">", self.number > number_of(other))

    def __ge__(self, other: Value | Formula) -> bool:
        return self._decided(other, ">=", self.number >= number_of(other))

    def equals(self, other: Value | Formula) -> bool:
        """Whether its number is the same; `==` says whether the formula is."""
        return self._decided(other, "==", bool(self.number == number_of(other)))

    def __bool__(self) -> bool:
        return not self.equals(0)

    def known(self) -> Value:
        """Its number, where a formula is of no use: what follows holds for other numbers only if it is the same for them."""
        self._decided(self.number, "==", True)
        return self.number

    def __float__(self) -> float:
        return float(self.known())

    def _whole(self, function: Callable[[Value], int], least: str, most: str, away: int) -> Value:
        """A whole number near it, by which all is decided that lies between that and the next one."""
        found = rounding(function)(self.number)
        self._decided(found, least, True)
        self._decided(found + away, most, True)
        return found

    def __floor__(self) -> Value:
        return self._whole(math.floor, ">=", "<", 1)

    def __ceil__(self) -> Value:
        return self._whole(math.ceil, "<=", ">", -1)

    def __int__(self) -> int:
        return int(math.floor(self) if self >= 0 else math.ceil(self))


def formulas_in(values: Iterable[object]) -> list[Formula]:
    """The formulas among some values."""
    return [value for value in values if isinstance(value, Formula)]


def number_of(value: Value | Formula) -> Value:
    """The number of a formula; any other value as it is."""
    return value.number if isinstance(value, Formula) else value


def expression_of(value: object) -> sympy.Expr:
    """A value as sympy has it.

    >>> expression_of(Fraction(1, 2))
    1/2
    """
    if isinstance(value, Formula):
        return value.expression
    if not isinstance(value, int | Fraction | float):
        return value
    import sympy

    return sympy.Float(value) if isinstance(value, float) else sympy.Rational(value.numerator, value.denominator)
