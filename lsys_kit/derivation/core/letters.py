"""Letters in place of constants whose numbers are known: formulas beside the numbers of a derivation.

The numbers decide which productions are applied, and the formulas are computed along with them (see `Formula`). So every system
that can be derived can be derived with letters, and the word says under which conditions its formulas hold.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from copy import copy
from functools import lru_cache
from types import ModuleType
from typing import TYPE_CHECKING

from lsys_kit.derivation.core.rules import constants_of, unknown_constant
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.traits import traits_of
from lsys_kit.errors import ModelNameError, ModelValueError, every, quotable, require
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import Decision, Formula, Value, expression_of, formulas_in, is_symbolic, number_of
from lsys_kit.notation.model.expressions import to_sympy
from lsys_kit.notation.model.formulas import formula_text
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.supervision import supervised

if TYPE_CHECKING:
    import sympy


def letters_from(system: LSystem, letters: str | Collection[str]) -> tuple[str, ...]:
    """The names of constants that are to be letters, in the order in which they are declared.

    >>> from lsys_kit import read
    >>> letters_from(read("q = 1/2\\nd = 1\\naxiom: A(d)"), ["d", "q"])
    ('q', 'd')
    """
    require(letters, Collection, "A letter or a list of letters")
    asked = [letters] if isinstance(letters, str) else [*letters]
    every(asked, str, "A letter")
    names = [constant.name for constant in system.constants]
    for name in asked:
        if name not in names:
            hint = suggestion(name, names) or (f"Its constants are: {', '.join(names)}." if names else "It has none.")
            raise ModelNameError(f'The system declares no constant "{quotable(name)}"', hint=hint)
    if asked and traits_of(system).sensitive:
        raise ModelValueError(
            "A system that asks what the turtle sees has no formulas: the turtle walks by numbers",
            hint="Derive it without letters.",
        )
    return tuple(name for name in names if name in asked)


def with_letters(
    system: LSystem, letters: Collection[str], changes: Mapping[str, object], arithmetic: str = "exact"
) -> dict[str, object]:
    """The values of constants for a derivation with letters: of each letter its name and its number; and constants that are no
    rational numbers as they are written.

    >>> from lsys_kit import read
    >>> with_letters(read("q = 1/2\\nr = sqrt(2)\\ns = q + r\\naxiom: A(q)"), ["q"], {})
    {'q': q, 'r': sqrt(2), 's': q + sqrt(2)}
    """
    import sympy

    values = constants_of(system, changes, arithmetic)
    decisions: dict[Decision, None] = {}
    found, known = dict(changes), dict[str, object]()
    for constant, value in zip(system.constants, values, strict=True):
        if is_symbolic(value):
            continue
        name = constant.name
        if name in letters:
            found[name] = Formula(unknown_constant(name), value, decisions)
        elif isinstance(value, float) and name not in changes:
            with suppress(ModelValueError):
                found[name] = Formula(to_sympy(constant.value).xreplace(known), value, decisions)
        known[sympy.Symbol(name)] = expression_of(found.get(name, value))
    return found


def numbered(states: States) -> States:
    """A table of states in which formulas are numbers, for whatever needs numbers, as a drawing does; the numbers of its states
    are the same.
    """
    if not formulas_in(states.constants):
        return states
    found = copy(states)
    found.modules = [Module(module.symbol, tuple(map(number_of, module.arguments))) for module in states.modules]
    found.constants = tuple(map(number_of, states.constants))
    return found


def decisions_of(states: States) -> tuple[Decision, ...]:
    """What numbers have decided so far in a derivation with letters."""
    return next((tuple(value.decisions) for value in formulas_in(states.constants)), ())


def conditions(states: States, decided: Sequence[Decision] | None = None) -> list[sympy.Basic]:
    """Under which conditions the formulas of a derivation so far hold, as sympy has them, or of some of its decisions; of a
    letter with a number above 0 those for that letter alone are solved.

    >>> from lsys_kit import derive, read
    >>> shrinking = read("q = 0.8\\naxiom: A(1)\\nA(x) : x > 0.3 -> F(x) A(q*x)")
    >>> conditions(derive(shrinking, 3, letters="q").states)
    [q > sqrt(3/10)]
    """
    letters = {value.expression: value.number for value in formulas_in(states.constants)}
    if not letters:
        return []
    with supervised():
        return _conditions(decisions_of(states) if decided is None else decided, letters)


def _conditions(decided: Iterable[Decision], letters: Mapping[sympy.Expr, Value]) -> list[sympy.Basic]:
    import sympy

    solved: dict[sympy.Symbol, list[tuple[str, sympy.Expr]]] = {}
    others: dict[sympy.Rel, None] = {}
    for left, relation, right in decided:
        difference = _difference(left, right)
        found = _solved(difference, relation, letters)
        for letter, *bound in found:
            solved.setdefault(letter, []).append((bound[0], bound[1]))
        if not found and difference.free_symbols:
            others.setdefault(_RELATIONS[relation](sympy)(left, right, evaluate=False))
    return [*(each for letter in letters for each in _narrowed(letter, solved.get(letter, ()))), *others]


@lru_cache(maxsize=4096)
def _difference(left: sympy.Expr, right: sympy.Expr) -> sympy.Expr:
    return (left - right).expand()


_RELATIONS: Mapping[str, Callable[[ModuleType], type[sympy.Rel]]] = {
    "<": lambda sympy: sympy.Lt,
    "<=": lambda sympy: sympy.Le,
    ">": lambda sympy: sympy.Gt,
    ">=": lambda sympy: sympy.Ge,
    "==": lambda sympy: sympy.Eq,
    "!=": lambda sympy: sympy.Ne,
}
_TURNED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}


def _solved(
    difference: sympy.Expr, relation: str, letters: Mapping[sympy.Expr, Value]
) -> list[tuple[sympy.Symbol, str, sympy.Expr]]:
    """What a comparison with 0 says of a letter, where it is about a power of one letter, times a number and with another: a
    letter, a relation and a number; of a higher power than the first also that the letter is greater than 0. Nothing of others.
    """
    import sympy

    constant, rest = difference.as_coeff_Add()
    factor, power = rest.as_coeff_Mul()
    letter, exponent = power.as_base_exp()
    if letter not in letters or not (constant.is_Rational and factor.is_Rational and exponent.is_Integer and exponent > 0):
        return []
    value = sympy.Rational(-constant, factor)
    relation = relation if factor > 0 else _TURNED[relation]
    if exponent == 1:
        return [(letter, relation, value)]
    if not letters[letter] > 0:
        return []
    positive = (letter, ">", sympy.Integer(0))
    return [positive, (letter, relation, sympy.Pow(value, 1 / exponent, evaluate=False))] if value > 0 else [positive]


def _narrowed(letter: sympy.Symbol, bounds: Iterable[tuple[str, sympy.Expr]]) -> list[sympy.Basic]:
    """The narrowest of some bounds of a letter."""
    import sympy

    least: tuple[sympy.Expr, bool] | None = None
    most: tuple[sympy.Expr, bool] | None = None
    apart: dict[sympy.Expr, None] = {}
    for relation, value in bounds:
        if relation == "==":
            return [sympy.Eq(letter, value)]
        if relation == "!=":
            apart.setdefault(value)
        elif relation[0] == ">":
            least = max(least or (value, False), (value, relation == ">"), key=_from_below)
        else:
            most = min(most or (value, False), (value, relation == "<"), key=_from_above)
    if least and least[0] in apart:
        least = (least[0], True)
    if most and most[0] in apart:
        most = (most[0], True)
    found = []
    if least:
        found.append((sympy.Gt if least[1] else sympy.Ge)(letter, least[0]))
    if most:
        found.append((sympy.Lt if most[1] else sympy.Le)(letter, most[0]))
    within = [value for value in apart if not ((least and value <= least[0]) or (most and value >= most[0]))]
    return [*found, *(sympy.Ne(letter, value) for value in within)]


def _from_below(bound: tuple[sympy.Expr, bool]) -> tuple[float, bool]:
    return float(bound[0]), bound[1]


def _from_above(bound: tuple[sympy.Expr, bool]) -> tuple[float, bool]:
    return float(bound[0]), not bound[1]


MOST_TOLD = 4
"""So many conditions are said; of others how many there are."""


def conditions_text(states: States, decided: Sequence[Decision] | None = None) -> str:
    """Under which conditions the formulas hold, or the word is the same if no value is a formula, in a sentence; "" if always.

    >>> from lsys_kit import derive, read
    >>> conditions_text(derive(read("q = 3/4\\naxiom: A(1)\\nA(x) : x > 1/2 -> F(x) A(q*x)"), 2, letters="q").states)
    'The formulas hold where q > ½.'
    """
    if not (found := conditions(states, decided)):
        return ""
    more = [f"{len(found) - MOST_TOLD} more"] if len(found) > MOST_TOLD else []
    what = "formulas hold" if any(formulas_in(module.arguments) for module in states.modules) else "word is the same"
    return f"The {what} where {', '.join([*map(formula_text, found[:MOST_TOLD]), *more])}."
