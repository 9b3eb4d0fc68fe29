"""Differences in the terms of the field: where two words, systems or expressions differ, and what to look at."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from lsys_kit.derivation.derive import Derivation
from lsys_kit.notation.model.arithmetic import Value, number_text, reason_of
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number, function_of, to_sympy
from lsys_kit.notation.model.modules import Module

Valuations: TypeAlias = Mapping[str, Value]
"""A value for each name."""
MOST_NODES = 40
"""Operators, names and numbers of an expression that sympy is asked about."""
MOST_PROOF_DEGREE = 12
"""Its degree, with the exponents of its numbers: larger powers are not expanded."""


def differing_word(derivation: Derivation, step: int, word: Sequence[Module]) -> str:
    """Where a word differs from the word of a step, and which module produced what should be there.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read, read_word
    >>> derivation = derive(read("axiom: a\\na -> ab\\nb -> a"), 3)
    >>> differing_word(derivation, 3, read_word("a b b b a"))
    'Position 3: you have b, the word has a; look at what becomes of the b at position 2 of step 2.'
    """
    at = _parting(word, derivation[step])
    if at == len(derivation[step]):
        return f"You have {len(word)} modules, the word has {at}: up to position {at} yours is right."
    origins = derivation.origins(step)
    parent = origins.parents[at]
    size = origins.sizes[parent] if origins.sizes else 1
    where = f"position {parent + 1}" if size == 1 else f"positions {parent + 1} to {parent + size}"
    return (f"Position {at + 1}: you have {_shown(word, at)}, the word has {derivation[step][at]}; look at what becomes of "
            f"the {derivation[step - 1][parent:parent + size]} at {where} of step {step - 1}.")


def differing_system(mine: Derivation, wanted: Derivation, step: int) -> str:
    """Where the words of two systems first differ, and which production of the first is to blame.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> mine, wanted = (derive(read(f"axiom: a\\na -> ab\\nb -> {b}"), 3) for b in ("b", "a"))
    >>> print(differing_system(mine, wanted, 2))
    Step 2, position 3: you have b, the system has a; look at your production for b, which is
      b -> b
    """
    at = _parting(mine[step], wanted[step])
    said = f"Step {step}, position {at + 1}: you have {_shown(mine[step], at)}, the system has {_shown(wanted[step], at)}"
    return f"{said}; look at your axiom." if step == 0 else f"{said}; {_blamed(mine, wanted, step)}"


def _blamed(mine: Derivation, wanted: Derivation, step: int) -> str:
    """The production of the first module that the two systems rewrite differently: until then their words are equal."""
    own, other = _replacements(mine, step), _replacements(wanted, step)
    at = next(i for i, (made, right) in enumerate(zip(own, other, strict=True)) if made != right)
    return _about_production(mine, step, at, own[at])


def _about_production(mine: Derivation, step: int, at: int, made: Sequence[Module]) -> str:
    """Where to look, given the position of a module in the word before a step and what it became."""
    module, origins = mine[step - 1][at], mine.origins(step)
    if made:
        production = origins.productions[origins.parents.index(at)]
    elif mine.states.traits.d0l:
        production = mine.states.production(mine[step - 1].numbers()[at])
    else:
        return f"look at your productions for {module}, position {at + 1} of step {step - 1}."
    if production is None:
        return f"you have no production for {module}, position {at + 1} of step {step - 1}, so that it stays as it is."
    return f"look at your production for {module}, which is\n  {mine.states.system.productions[production]}"


def _replacements(derivation: Derivation, step: int) -> list[list[Module]]:
    """What each module of the word before a step became."""
    found: list[list[Module]] = [[] for _ in derivation[step - 1]]
    for parent, module in zip(derivation.origins(step).parents, derivation[step], strict=True):
        found[parent].append(module)
    return found


def _parting(mine: Sequence[Module], wanted: Sequence[Module]) -> int:
    """The first position, from 0, at which two words differ; the length of the shorter where it begins the longer."""
    shorter = min(len(mine), len(wanted))
    return next((i for i in range(shorter) if mine[i] != wanted[i]), shorter)


def _shown(word: Sequence[Module], at: int) -> str:
    return str(word[at]) if at < len(word) else "the end of the word"


def differing_values(mine: Expression, wanted: Expression, cases: Iterable[Valuations]) -> str | None:
    """The first case in which two expressions have different values, or None.

    >>> from lsys_kit.notation.read import read_expression
    >>> differing_values(read_expression("t"), read_expression("2*t"), [{"t": 0}, {"t": 1}])
    'With t = 1 your expression gives 1, and it should give 2.'
    """
    for case in cases:
        own, right = _value_or_reason(mine, case), _value_or_reason(wanted, case)
        if not _equal_values(own, right):
            where = " and ".join(f"{name} = {number_text(value)}" for name, value in case.items())
            gives = own if isinstance(own, str) else f"gives {_value_text(own)}"
            return f"With {where} your expression {gives}, and it should give {_value_text(right)}."
    return None


def _value_or_reason(expression: Expression, case: Valuations) -> Value | str:
    """The value, or in words the reason why there is none."""
    try:
        run = function_of(expression, {name: i for i, name in enumerate(case)})
        return run(tuple(case.values()))  # type: ignore[no-any-return]
    except (ArithmeticError, ValueError) as fault:
        return f"has no value ({reason_of(fault)})"


def _equal_values(own: Value | str, right: Value | str) -> bool:
    """Whether two values are equal: exactly where they are exact, up to rounding where one is a double."""
    if isinstance(own, str) or isinstance(right, str):
        return False
    return math.isclose(own, right, rel_tol=1e-9) if isinstance(own, float) or isinstance(right, float) else own == right


def _value_text(value: Value | str) -> str:
    return str(value).lower() if isinstance(value, str | bool) else number_text(value)


def proved_equal(mine: Expression, wanted: Expression) -> bool:
    """Whether sympy shows that two expressions are equal whatever the values of their names.

    Also False where they are too large to be compared: sympy may never finish with a power of a power.

    >>> from lsys_kit.notation.read import read_expression
    >>> proved_equal(read_expression("(x+1)^2"), read_expression("x^2 + 2*x + 1"))
    True
    >>> proved_equal(read_expression("x^2"), read_expression("x"))
    False
    """
    if not (_is_small(mine) and _is_small(wanted)):
        return False
    import sympy

    left, right = to_sympy(mine), to_sympy(wanted)
    if isinstance(left, sympy.Rel) and isinstance(right, sympy.Rel):
        return bool(left.canonical == right.canonical)
    if not (isinstance(left, sympy.Expr) and isinstance(right, sympy.Expr)):
        return bool(left == right)
    return bool(sympy.cancel(sympy.expand(left - right)) == 0)


def _is_small(expression: Expression) -> bool:
    return _nodes(expression) <= MOST_NODES and _degree(expression) <= MOST_PROOF_DEGREE


def _nodes(expression: Expression) -> int:
    return 1 + (sum(map(_nodes, expression.operands)) if isinstance(expression, Apply) else 0)


def _degree(expression: Expression) -> float:
    """A bound for the degree of an expression; infinite where sympy might have to work out something very large."""
    if not isinstance(expression, Apply):
        return 0 if isinstance(expression, Number) else 1
    degrees = [_degree(operand) for operand in expression.operands]
    if expression.operator == "^":
        return max(1.0, degrees[0]) * _exponent(expression.operands[1])
    if expression.operator in ("&&", "||", "!"):
        return math.inf
    return sum(degrees) if expression.operator in ("*", "/") else max(degrees)


def _exponent(expression: Expression) -> float:
    if isinstance(expression, Number):
        return abs(float(expression.value))
    return 1 if isinstance(expression, Name) else math.inf
