"""The lengths of letters as functions of their age: read from text, and continuous on their life spans."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING

from lsys_kit.derivation.core.rules import number_from, unknown_constant
from lsys_kit.derivation.timed.timed import Timed
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelValueError, every
from lsys_kit.notation.analysis.checks import check_expression, span, suggestion
from lsys_kit.notation.model.arithmetic import is_symbolic
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, names_in, to_sympy
from lsys_kit.notation.read import read_expression
from lsys_kit.notation.syntax.wording import reporting

if TYPE_CHECKING:
    import sympy

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
    """A growth function as it is written."""
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
