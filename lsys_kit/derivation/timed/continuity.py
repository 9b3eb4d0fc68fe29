"""Continuity: does a filament grow without a jump where its cells divide? (ABOP,
section 6.2; P. Prusinkiewicz, Introduction to Modeling with L-systems, section 8)

A growth function g gives the length of a cell at an age. The length of the filament is continuous where

    R1  each growth function is continuous on the life span of its letter, from the first age to the terminal age;
    R2  at each division g(mother, terminal age) is the sum of g(daughter, first age) over the daughters.

Of order k it is continuous where the same holds for the derivatives up to the k-th. Names in a growth function that have
no value are unknown: R2 is then an equation for them, such as a^t_div = a^t_s + a^t_l.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

from lsys_kit.budget import Task
from lsys_kit.derivation.core.rules import number_from, real_from, unknown_constant
from lsys_kit.derivation.timed.ages import AgeModel, births
from lsys_kit.derivation.timed.timed import Timed, timed
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelValueError, every, require, shown
from lsys_kit.notation.analysis.checks import check_expression, span, suggestion
from lsys_kit.notation.model.arithmetic import Value, is_symbolic, number_text
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, names_in, to_sympy
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read_expression
from lsys_kit.notation.syntax.wording import reporting
from lsys_kit.supervision import supervised

if TYPE_CHECKING:
    import sympy


GREATEST_DEGREE = 60
"""The highest degree of a polynomial whose roots are all looked for."""
FARTHEST = 700.0
"""The logarithm of the largest root that is looked for, about that of the largest double."""


def growth_base(t_div: float, t_s: float, t_l: float) -> float:
    """The base a of exponential growth that is continuous at a division: a^t_div = a^t_s + a^t_l (Prusinkiewicz,
    Introduction to Modeling with L-systems, section 8).

    Parameters
    ----------
    t_div, t_s, t_l
        The age at division, and the ages at which the short and the long daughter begin.

    Raises
    ------
    ModelValueError
        No base above 1 does: a daughter begins as old as the mother divides, or older.

    Examples
    --------
    >>> round(growth_base(1, 0, 0.2), 9)
    2.167303978
    """
    if not (max(t_s, t_l) < t_div and math.isfinite(t_div - min(t_s, t_l))):
        raise ModelValueError(
            f"With daughters of age {t_s} and {t_l} no growth is continuous at the age {t_div}",
            hint="A daughter begins younger than the age at which cells divide.",
        )
    return positive_root([(t_div, 1), (t_s, -1), (t_l, -1)])


def positive_root(powers: Sequence[tuple[float, float]]) -> float:
    """The one z > 0 at which a sum of powers is 0, each an exponent with a coefficient, whose coefficients change their sign
    once: there is just one such z, by Descartes' rule of signs, which holds for all real exponents.

    >>> round(positive_root([(2, 1), (1, -1), (0, -1)]), 9)
    1.618033989
    """
    exponents = [float(exponent) for exponent, _ in powers]

    def total(log: float) -> float:
        """The sum at z = e^log, as a share of its greatest power."""
        greatest = max(exponent * log for exponent in exponents)
        return math.fsum(c * math.exp(exponent * log - greatest) for exponent, (_, c) in zip(exponents, powers, strict=True))

    if (total(-FARTHEST) < 0) == (total(FARTHEST) < 0):
        raise ModelValueError(
            "The solution is too large or too small for a floating-point number",
            hint="Let a daughter begin clearly younger than the age at which cells divide.",
        )
    return math.exp(bisected(total, -FARTHEST, FARTHEST))


def bisected(function: Callable[[float], float], low: float, high: float) -> float:
    """Where a function changes its sign, found by halving the stretch in which it does."""
    rises = function(low) < 0
    while low < (middle := (low + high) / 2) < high:
        low, high = (middle, high) if (function(middle) < 0) == rises else (low, middle)
    return high


def roots(equation: sympy.Expr, low: float | None = None, high: float | None = None) -> list[sympy.Expr]:
    """The real values of the one name in an expression with which it is 0; exact where they are written with square roots.

    All values are found where it is a sum of powers of the name, or of e^name; an expression of another kind must have opposite
    signs at the two numbers between which the values lie.

    >>> import sympy
    >>> rate = sympy.Symbol("B", real=True)
    >>> roots(sympy.exp(2*rate) - sympy.exp(rate) - 1)
    [log(1/2 + sqrt(5)/2)]
    """
    import sympy

    name, z = equation.free_symbols.pop(), sympy.Dummy(positive=True)
    least, greatest = -sympy.oo if low is None else low, sympy.oo if high is None else high
    found = _roots_of_powers(equation, name)
    if found is None:
        by_power = _roots_of_powers(_in_powers(sympy.expand(equation, multinomial=False), name, z), z)
        found = [_root_between(equation, name, low, high)] if by_power is None else list(map(sympy.log, by_power))
    return [root.evalf() if root.has(sympy.CRootOf) else root for root in found if least <= root <= greatest]


def _in_powers(equation: sympy.Expr, name: sympy.Symbol, z: sympy.Symbol) -> sympy.Expr:
    """An expression with z for e^name, where that is all it has of the name."""
    import sympy
    from sympy.core.function import Application

    if any(part.has(name) and not isinstance(part, sympy.exp) for part in equation.atoms(Application)):
        return equation
    powers = [(part, part.as_base_exp()) for part in equation.atoms(sympy.Pow, sympy.exp) if part.has(name)]
    return equation.xreplace(
        {
            part: z ** (exponent / name * sympy.log(base))
            for part, (base, exponent) in powers
            if base.is_number and (exponent / name).is_number
        }
    )


def _roots_of_powers(equation: sympy.Expr, z: sympy.Symbol) -> list[sympy.Expr] | None:
    """Where a sum of powers of z is 0; None where it is no such sum, or where its roots are too hard to find."""
    import sympy

    small = all(p.exp <= GREATEST_DEGREE for p in equation.atoms(sympy.Pow) if p.base.is_Add and p.exp.is_Integer)
    summands = sympy.Add.make_args(sympy.expand(equation, multinomial=small))
    terms = [term.as_coeff_exponent(z) for term in summands]
    if not all(part.is_number and part.is_real for term in terms for part in term):
        return None
    powers = sorted((exponent, c) for c, exponent in terms)
    parts = math.lcm(*(int(exponent.q) for exponent, _ in powers if exponent.is_Rational))
    positive = z.is_positive or not all(exponent.is_Integer for exponent, _ in powers)
    degrees = [(exponent - min(powers[0][0], 0)) * parts for exponent, _ in powers]
    if all(d.is_Integer and d <= GREATEST_DEGREE for d in degrees) and all(c.is_Rational for _, c in powers):
        x = sympy.Dummy()
        whole = sympy.Poly(sum(c * x**degree for degree, (_, c) in zip(degrees, powers, strict=True)), x)
        return [root**parts for root in dict.fromkeys(whole.real_roots()) if root > 0 or not positive]
    changes = sum(bool(c * after < 0) for (_, c), (_, after) in pairwise(powers))
    if changes > 1 or not positive:
        return None
    greatest = max(abs(c) for _, c in powers)
    return [sympy.Float(positive_root([(float(exponent), float(c / greatest)) for exponent, c in powers]))] if changes else []


def _root_between(equation: sympy.Expr, name: sympy.Symbol, low: float | None, high: float | None) -> sympy.Expr:
    """A root between two numbers at which an expression has opposite signs."""
    import sympy

    def value(number: float) -> float:
        with suppress(ValueError):  # it compares numbers that are not real
            found = equation.evalf(subs={name: number})
            return float(found) if found.is_real else math.nan
        return math.nan

    if low is None or high is None or not value(low) * value(high) < 0:
        raise ModelValueError(
            f'No rule finds where "{number_text(equation)}" is 0',
            hint=f"Give two numbers between which {name} lies, where the expression has opposite signs.",
        )
    return sympy.Float(bisected(value, low, high))


AGE = "t"
"""What a growth function calls the age."""
MOST_TEXT, MOST_TOWERS, MOST_BITS, MOST_DEGREE = 300, 3, 10**8, 12
"""How long a growth function is; how deep powers, how long numbers and how high powers in it are."""
JUMPS = frozenset(("if", "floor", "ceil", "mod", "rem"))
"""Operators that are not continuous where their operands are."""


def written_functions(lengths: Mapping[str, str], lives: Mapping[str, sympy.Set]) -> dict[str, str]:
    """The growth function of each letter as it is written."""
    every(lengths, str, "A letter, or several with blanks between them,")
    texts = {symbol: text for symbols, text in lengths.items() for symbol in symbols.split()}
    for symbol in (*texts, *lives):
        if symbol not in lives:
            raise ModelNameError(
                f'The system has no letter "{symbol}" with an age',
                hint=suggestion(symbol, lives) or f"Its letters are: {', '.join(lives)}.",
            )
        if symbol not in texts:
            raise ModelNameError(f'The letter "{symbol}" has no growth function', hint='Where it has no length, write "0".')
    return texts


def length_functions(
    growing: Timed, texts: Mapping[str, str], given: Mapping[str, object], lives: Mapping[str, sympy.Set]
) -> dict[str, sympy.Expr]:
    """The growth function of each letter, with the values of all known names in it."""
    import sympy

    trees = {text: _read(text) for text in texts.values()}
    constants = [constant.name for constant in growing.states.system.constants]
    if AGE in constants:
        raise ModelNameError(
            f'The system has a constant "{AGE}", which is the age in a growth function', hint="Give the constant another name."
        )
    used = {name for tree in trees.values() for name in names_in(tree)} - {AGE, *constants}
    for name in given.keys() - used:
        raise ModelNameError(
            f'Neither the system nor a growth function has the name "{name}"', hint=suggestion(name, {*used, *constants})
        )
    values = {name: in_sympy(value) for name, value in zip(constants, growing.states.constants, strict=True)}
    values |= {name: in_sympy(given[name], name) if name in given else unknown_constant(name) for name in used}
    sizes = {name: _size(value) for name, value in values.items()}
    sizes[AGE] = max((_size(end) for life in lives.values() for end in (life.inf, life.sup)), default=0)
    symbols = {sympy.Symbol(name): value for name, value in {**values, AGE: the_age()}.items()}
    functions = {}
    for text, tree in trees.items():
        if _bits(tree, sizes) > MOST_BITS:
            raise ModelLimitError("The powers here are too large", limit=MOST_BITS, source=text, start=0, end=len(text))
        try:
            functions[text] = to_sympy(tree).xreplace(symbols)
        except ValueError:  # it compares numbers that are not real
            raise ModelValueError("This growth function has no value", text, 0, len(text)) from None
    return {symbol: functions[texts[symbol]] for symbol in lives}


def _read(text: object) -> Expression:
    if not isinstance(text, str):
        raise ModelValueError(f'A growth function is a text, such as "1 + t", not {type(text).__name__}')
    if len(text) > MOST_TEXT:
        raise ModelLimitError(f"A growth function has at most {MOST_TEXT} characters", limit=MOST_TEXT, needed=len(text))
    tree = read_expression(text)
    with reporting(text):
        check_expression(tree, names_in(tree))
    if _towers(tree, text) > MOST_TOWERS:
        raise ModelLimitError("The powers here are too large", limit=MOST_TOWERS, source=text, start=0, end=len(text))
    return tree


def _towers(tree: Expression, text: str) -> int:
    """How deeply powers stand in the exponents of others, where nothing jumps."""
    if not isinstance(tree, Apply):
        return 0
    if tree.operator in JUMPS:
        raise ModelValueError(
            f'"{tree}" may jump, which no length does',
            text,
            *span(tree),
            "A length that stays within limits is written with min, max and abs.",
        )
    return max(_towers(operand, text) for operand in tree.operands) + (tree.operator in ("^", "exp"))


def _bits(tree: Expression, sizes: Mapping[str, float]) -> float:
    """About how long the numbers are that an expression comes to, in bits."""
    if isinstance(tree, Number):
        return _size(in_sympy(tree.value))
    if isinstance(tree, Name):
        return sizes[tree.name]
    parts = [_bits(operand, sizes) for operand in tree.operands]
    return parts[0] * 2 ** min(parts[1], 1000) if tree.operator == "^" else 1 + sum(parts)


def _size(value: sympy.Expr) -> float:
    """The length of a rational number in bits; names and what is not rational stay as they are."""
    return float(max(int(value.p).bit_length(), int(value.q).bit_length())) if value.is_Rational else 1.0


def is_decided(letter: str, text: str, function: sympy.Expr, life: sympy.Set, order: int) -> bool:
    """Whether a growth function and its derivatives are known to be continuous on a life span; refused where they are not."""
    import sympy

    verdicts = [is_continuous(sympy.diff(function, the_age(), k), life) for k in range(order + 1)]
    if False in verdicts:
        which = f"Derivative {verdicts.index(False)} of the" if verdicts.index(False) else "The"
        raise ModelValueError(
            f'{which} growth function "{text}" is not continuous on the life span of {letter}, from {life.inf} to {life.sup}'
        )
    if None in verdicts and not (function.free_symbols | life.free_symbols) - {the_age()}:
        raise ModelValueError(
            f'Whether the growth function "{text}" is continuous on the life span of {letter} is undecided',
            hint="Write it in a simpler way.",
        )
    return None not in verdicts


def is_continuous(function: sympy.Expr, life: sympy.Set) -> bool | None:
    """Whether a function is continuous at all ages of a life span; None where that is not known."""
    import sympy
    from sympy.calculus.util import continuous_domain

    if function.has(sympy.zoo, sympy.nan, sympy.I, sympy.DiracDelta):
        return False
    age, names = the_age(), (function.free_symbols | life.free_symbols) - {the_age()}
    if _is_hard(function):
        return None
    positive = {name: sympy.Dummy(positive=True) for name in names}
    real = function.replace(
        lambda part: part.is_Pow and part.exp.is_Rational and part.exp.q > 1, lambda part: part.base ** (part.exp / 2)
    )  # an odd root of a negative number is none here
    whole = life.xreplace(positive)
    try:
        found = continuous_domain(real.xreplace(positive), age, whole)
    except (NotImplementedError, TypeError, ValueError):  # as where an unknown name stands in an inequality
        return None
    if found == whole:
        return True
    return None if found.free_symbols or found.has(sympy.ConditionSet, sympy.Complement) else False


def _is_hard(function: sympy.Expr) -> bool:
    """Whether finding where a function is continuous might not terminate."""
    import sympy

    def bent(part: sympy.Expr) -> bool:
        return bool(sympy.diff(part, the_age()).has(the_age()))

    everywhere = (sympy.exp, sympy.sin, sympy.cos, sympy.atan, sympy.Abs)
    parts = {part for part in function.atoms(sympy.Pow, sympy.Function) if part.has(the_age())}
    for outer in parts:
        inner = outer.args[0]
        if isinstance(outer, sympy.Function) and not isinstance(outer, (*everywhere, sympy.log)) and bent(inner):
            return True
        for part in () if isinstance(outer, everywhere) else parts & inner.atoms(sympy.Pow, sympy.Function):
            base, exponent = part.as_base_exp()
            if bent(part.args[0] if base == part else exponent) or bool(
                base.has(the_age()) and not (exponent.is_Rational and max(abs(exponent.p), exponent.q) <= MOST_DEGREE)
            ):
                return True
    return False


def in_sympy(value: object, name: str = "age") -> sympy.Expr:
    """A value as sympy has it; a number or a text is read exactly."""
    import sympy

    found = value if isinstance(value, sympy.Expr) else number_from(value, name)
    return found if is_symbolic(found) else to_sympy(Number(found))


@cache
def the_age() -> sympy.Symbol:
    """The age in a growth function, which no unknown name is."""
    import sympy

    return sympy.Dummy(AGE, real=True)


TOLERANCE = 1e-9
"""Lengths that differ by no more than this share are equal."""


@dataclass(frozen=True)
class Division:
    """What a production does to the length of a filament, or to its derivative of some order: the length of the mother at her
    terminal age, and that of all daughters together at their first ages."""

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


MOST_ORDER, MOST_LETTERS = 9, 500
"""The highest derivative; the most ages at which modules may be born."""


@dataclass(frozen=True)
class Continuity:
    """What happens to the length of a filament where its cells divide.

    Attributes
    ----------
    divisions
        Each production with the lengths before and after it, and with their derivatives up to the order asked for.
    undecided
        The letters of which unknown names decide whether their growth function is continuous on their life span.
    """

    divisions: tuple[Division, ...]
    undecided: tuple[str, ...]
    _growth: tuple[tuple[sympy.Expr, sympy.Set], ...] = field(repr=False)

    @property
    def continuous(self) -> bool:
        """Whether the length never jumps, whatever the unknown names are."""
        return not self.undecided and all(division.defect == 0 for division in self.divisions)

    @property
    def equations(self) -> tuple[sympy.Eq, ...]:
        """The equations that the unknown names must satisfy."""
        import sympy

        return tuple(
            dict.fromkeys(
                sympy.Eq(division.mother, division.daughters) for division in self.divisions if division.defect.free_symbols
            )
        )

    @property
    def unknowns(self) -> tuple[str, ...]:
        """The unknown names in these equations."""
        return tuple(sorted({name for division in self.divisions for name in unknown_names(division.defect)}))

    def solve(self, name: str, low: object = None, high: object = None) -> sympy.Expr:
        """The value of an unknown name with which the length is continuous.

        Parameters
        ----------
        name
            One of `unknowns`.
        low, high
            Between which numbers it lies: needed where more than one value does, or where no rule finds them all.

        Returns
        -------
        value
            A number of sympy, exact where it is the root of a polynomial of degree one or two.

        Raises
        ------
        ModelNameError
            No equation has that name.
        ModelValueError
            There is no such value, or more than one, or another name must be known first.

        Examples
        --------
        >>> from lsys_kit import read
        >>> anabaena = read("axiom: a(0)\\na(1) -> a(0) b(0)\\nb(1) -> a(0)")
        >>> continuity(anabaena, {"a": "A * exp(B*(t+1))", "b": "A * exp(B*t)"}).solve("B")
        log(1/2 + sqrt(5)/2)
        """
        require(name, str, "The name of an unknown number")
        if name not in self.unknowns:
            hint = suggestion(name, self.unknowns) or (f"They have: {', '.join(self.unknowns)}." if self.unknowns else None)
            raise ModelNameError(f'No equation for the length to be continuous has the name "{name}"', hint=hint)
        jumps = [division for division in self.divisions if division.defect != 0 and not division.defect.free_symbols]
        if jumps:
            raise ModelValueError(f'Whatever "{name}" is, the length jumps: {jumps[0]}')
        hint = f'Give the range in which it lies, as in solve("{name}", 1, 10).'
        ends = [None if end is None else real_from(end, "limit", hint) for end in (low, high)]
        with Task(f"The value of {name} was not found"), supervised():
            found = [root for root in roots(self._equation(name), *ends) if self._is_solved(name, root)]
        if len(found) == 1:
            return found[0]
        if not found:
            where = "" if ends == [None, None] else " in that range"
            raise ModelValueError(f'No value of "{name}"{where} makes the length continuous')
        values = ", ".join(f"{float(root):.6g}" for root in found)
        raise ModelValueError(f'More than one value of "{name}" makes the length continuous: {values}', hint=hint)

    def _equation(self, name: str) -> sympy.Expr:
        """What is 0 where the length is continuous, with no other unknown name in it."""
        import sympy

        others = set()
        for division in self.divisions:
            above, _ = sympy.fraction(sympy.together(division.defect))
            factors = [part for part in sympy.Mul.make_args(sympy.factor_terms(above)) if name in unknown_names(part)]
            if factors and unknown_names(*factors) == {name}:
                return sympy.Mul(*factors)
            others |= unknown_names(*factors) - {name}
        if not others:
            raise ModelValueError(f'No value of "{name}" makes the length continuous')
        raise ModelValueError(
            f'The value of "{name}" depends on {", ".join(sorted(others))}',
            hint=f"Give {min(others)} a value: continuity(..., {min(others)}=1).",
        )

    def _is_solved(self, name: str, value: sympy.Expr) -> bool:
        """Whether a value leaves no jump that its name decides, and no mother without a length."""
        symbols = {symbol for growth in self._growth for part in growth for symbol in part.free_symbols}
        point = {symbol: value.evalf(20) for symbol in symbols if symbol.name == name}
        asked = [division for division in self.divisions if name in unknown_names(division.defect)]
        try:
            lengths = [(d.order, d.mother.subs(point), d.daughters.subs(point)) for d in asked]
            growth = [(function.subs(point), life.subs(point)) for function, life in self._growth]
        except ValueError:  # it compares numbers that are not real
            return False
        return all(equal_lengths(before, after) and (order or before != 0) for order, before, after in lengths) and all(
            is_continuous(function, life) is not False for function, life in growth
        )

    def __repr__(self) -> str:
        return "\n".join(
            [
                *map(str, self.divisions),
                *(f"{letter}: unknown names decide whether its growth is continuous" for letter in self.undecided),
            ]
        )


def continuity(system: LSystem | Timed, lengths: Mapping[str, str], order: int = 0, **constants: object) -> Continuity:
    """Whether a filament grows without a jump, where the length of a cell is a function of its letter and age.

    Parameters
    ----------
    system
        A timed system (see `timed`).
    lengths
        For each letter its growth function, a text in which t is the age; letters with the same one may stand together:
        {"ar al": "1 + t", "br bl": "t"}.
    order
        0 for the length itself, k for its derivatives up to the k-th too.
    **constants
        Values for constants of the system and for names in the growth functions. What has none is unknown, and whether a
        growth function is continuous on a life span is asked for positive values of it.

    Raises
    ------
    ModelSyntaxError
        A growth function cannot be read.
    ModelNameError
        A letter or a name is not there, or a letter has no growth function.
    ModelValueError
        A growth function is not continuous on the life span of its letter.
    ModelLimitError
        That takes too long to decide.

    Examples
    --------
    >>> from lsys_kit import read
    >>> cells = read("axiom: L(0)\\nL(1) -> L(0) R(1/5)\\nR(1) -> L(1/5) R(0)")
    >>> found = continuity(cells, {"L R": "a^t"})
    >>> found
    L(1) -> L(0)R(1/5): continuous where a = a^(1/5) + 1
    R(1) -> L(1/5)R(0): continuous where a = a^(1/5) + 1
    >>> round(float(found.solve("a")), 9)
    2.167303978
    >>> continuity(cells, {"L R": "1 + t"})
    L(1) -> L(0)R(1/5): 2 before, 2.2 after, a jump of 0.2
    R(1) -> L(1/5)R(0): 2 before, 2.2 after, a jump of 0.2
    """
    if isinstance(order, bool) or not isinstance(order, int) or not 0 <= order <= MOST_ORDER:
        raise ModelValueError(f"The order of continuity is a whole number from 0 to {MOST_ORDER}, not {shown(order)}")
    require(system, (LSystem, Timed), "An L-system or a timed system")
    require(lengths, Mapping, "A growth function for each letter, as a dictionary,")
    the_age()  # so that sympy is imported before it is supervised
    with Task("Whether the length is continuous was not decided"), supervised():
        growing, given = _timed_with_values(system, constants)
        productions = list(_divisions(growing))
        lives = _life_spans(growing, productions)
        texts = written_functions(lengths, lives)
        functions = length_functions(growing, texts, given, lives)
        undecided = tuple(
            letter for letter, life in lives.items() if not is_decided(letter, texts[letter], functions[letter], life, order)
        )
        divisions = tuple(
            Division(production, k, *(_total_length(growing.ages, modules, functions, k) for modules in ([mother], daughters)))
            for k in range(order + 1)
            for production, mother, daughters in productions
        )
        for division in divisions:
            _ = division.defect  # found here, where the time that it takes counts
        return Continuity(divisions, undecided, tuple((functions[letter], life) for letter, life in lives.items()))


def _timed_with_values(system: LSystem | Timed, constants: Mapping[str, object]) -> tuple[Timed, dict[str, object]]:
    model = system.states.system if isinstance(system, Timed) else system
    names = [constant.name for constant in model.constants]
    values: dict[str, object] = dict(zip(names, system.states.constants, strict=True)) if isinstance(system, Timed) else {}
    values.update((name, _solved_value(value)) for name, value in constants.items() if name in names)
    return timed(model, **values), {name: value for name, value in constants.items() if name not in names}


def _solved_value(value: object) -> object:
    """A value that was solved for as one that a system takes."""
    import sympy

    return float(value) if isinstance(value, sympy.Expr) and value.is_number and not value.is_Rational else value


def _divisions(growing: Timed) -> Iterator[tuple[Production, Module, list[Module]]]:
    """Each production, its mother at her terminal age, her daughters at their first ages."""
    for letter in _letters(growing):
        end = growing.ages.end(letter)
        if end is not None and end.rule is not None:
            yield end.rule.production, growing.ages.aged(letter, end.age), growing.ages.daughters(letter)


def _letters(growing: Timed) -> Iterator[Module]:
    """A module of each kind whose lives end: of a timed system with values that are not known, of steps those that are born."""
    if growing.ages.step is not None:
        for phases in births(growing.ages, MOST_LETTERS).values():
            for born in phases.values():
                yield born[min(born)]
    for (symbol, _), (rule, *_) in growing.states.rules.items() if growing.ages.step is None else ():
        yield Module(symbol, (0, *(unknown_constant(str(name)) for name in rule.production.predecessor.arguments[1:])))


def _life_spans(growing: Timed, divisions: Iterable[tuple[Production, Module, list[Module]]]) -> dict[str, sympy.Set]:
    """The life span of each letter, from its least age to its greatest; without end where no production ends it."""
    import sympy

    ages: dict[str, set[Value]] = {}
    ended = [mother for _, mother, _ in divisions]
    for module in (
        *(growing.states.modules[state] for state in growing.states.axiom),
        *ended,
        *(made for _, _, daughters in divisions for made in daughters),
    ):
        age = growing.ages.age(module)
        if age is not None:
            ages.setdefault(module.symbol, set()).add(age)
            if len(ages[module.symbol]) > MOST_LETTERS:
                raise ModelLimitError(f"{module.symbol} has more than {MOST_LETTERS:,} first and last ages", limit=MOST_LETTERS)
    endless = ages.keys() - {module.symbol for module in ended}
    known = {symbol: list(map(in_sympy, found)) for symbol, found in ages.items()}
    return {
        symbol: sympy.Interval(sympy.Min(*found), sympy.oo if symbol in endless else sympy.Max(*found))
        for symbol, found in known.items()
    }


def _total_length(ages: AgeModel, modules: Iterable[Module], functions: Mapping[str, sympy.Expr], order: int) -> sympy.Expr:
    """The length of some modules together, or a derivative of it."""
    import sympy

    counts = Counter((module.symbol, age) for module in modules if (age := ages.age(module)) is not None)
    cells = {(symbol, in_sympy(age)): number for (symbol, age), number in counts.items()}
    try:
        return sympy.Add(
            *(
                number * sympy.diff(functions[symbol], the_age(), order).subs(the_age(), age)
                for (symbol, age), number in cells.items()
            )
        )
    except ValueError:  # it compares numbers that are not real
        letters = " or ".join(symbol for symbol, _ in cells)
        raise ModelValueError(f"The length of {letters} has no value at a division") from None
