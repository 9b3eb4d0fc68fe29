"""GROGRA's probabilities: `?p` after a rule is the chance that it is applied, and what the rules leave of 1 is the chance that
nothing happens (Kurth).

One random number decides: of the rules that match, in the order written, the first up to whose sum of probabilities it is.
The kit chooses among weights, whatever they add up to. So the rest becomes a rule of its own that changes nothing, a rule
without `?` after others gets what those leave, and a sum beyond 1 is cut off. Only where rules with probabilities and
different contexts, or values, match at once are their weights taken in proportion.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from itertools import pairwise, product
from math import prod

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.analysis.checks import value_of
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.expressions import (
    OPERATORS,
    Apply,
    Expression,
    Name,
    Number,
    calls_in,
    function_of,
    names_in,
    substituted,
)
from lsys_kit.notation.model.modules import Pattern, with_expressions
from lsys_kit.notation.model.system import LSystem, Production

_TRIED = 1_000
"""So many combinations of values are tried."""


def exclusive(one: Expression | None, other: Expression | None) -> bool:
    """Whether it is certain that two conditions never hold at once; no condition always holds.

    What compares names with numbers alone changes its truth only at those numbers: these, and what lies between and beyond
    them, are tried.

    >>> young, old = (Apply(sign, (Name("t"), Number(5))) for sign in ("<", ">="))
    >>> exclusive(young, old), exclusive(young, young), exclusive(young, None)
    (True, False, False)
    """
    if one is None or other is None or not (_is_plain(one) and _is_plain(other)):
        return False
    names = sorted(names_in(one) | names_in(other))
    values = [_values(name, (one, other)) for name in names]
    if prod(map(len, values)) > _TRIED:
        return False
    order = {name: index for index, name in enumerate(names)}
    both = function_of(Apply("&&", (one, other)), order)
    return not any(both(tried) for tried in product(*values))


def _is_plain(condition: Expression) -> bool:
    """Whether a condition only compares names with numbers."""
    if not isinstance(condition, Apply):
        return False
    if OPERATORS[condition.operator].takes == "truth":
        return all(map(_is_plain, condition.operands))
    kinds = {type(operand) for operand in condition.operands}
    return OPERATORS[condition.operator].gives == "truth" and kinds == {Name, Number}


def _values(name: str, conditions: tuple[Expression, ...]) -> list[Value]:
    """The numbers with which a name is compared, and others between and beyond them."""
    found = sorted({Fraction(value) for condition in conditions for value in _compared(name, condition)})
    between = [(low + high) / 2 for low, high in pairwise(found)]
    return [found[0] - 1, *found, *between, found[-1] + 1]


def _compared(name: str, condition: Expression) -> Iterator[Value]:
    """The numbers with which a condition compares a name."""
    for call in calls_in(condition):
        if Name(name) in call.operands:
            yield from (operand.value for operand in call.operands if isinstance(operand, Number))


_Condition = Expression | None
_MOST_COMPARED = 100
"""The number of conditions that are compared with each other; of more, any two are taken to be compatible."""


def complete_probabilities(system: LSystem) -> tuple[tuple[Production, ...], tuple[str, ...]]:
    """The productions with the chance that nothing happens, and notes that say so.

    >>> from lsys_kit.notation.read import read
    >>> for rule in complete_probabilities(read("axiom: a\\na -> b : 0.3\\na -> c : 0.5"))[0]:
    ...     print(rule)
    a -> b : 0.3
    a -> c : 0.5
    a -> a : 0.2
    """
    constants = frozenset(constant.name for constant in system.constants)
    rows: dict[object, list[int]] = {}
    for number, rule in enumerate(system.productions):
        rows.setdefault(_left_side(rule, constants), []).append(number)
    found = [[rule] for rule in system.productions]
    notes: list[str] = []
    for row in rows.values():
        first = next((number for number in row if system.productions[number].probability is not None), None)
        if first is not None:
            row = [number for number in row if number >= first]
            notes += _complete_row(system, row, constants, found)
    return tuple(rule for rules in found for rule in rules), tuple(notes)


def _left_side(rule: Production, constants: frozenset[str]) -> object:
    """What rules share that are for the same modules: contexts and predecessor, whatever the parameters are called."""
    names = {name: Name(f"?{number}") for number, name in enumerate(_parameters(rule, constants))}

    def plain(module: Pattern) -> Pattern:
        return replace(module, arguments=tuple(substituted(a, names) for a in module.arguments))

    return tuple(map(plain, rule.left)), plain(rule.predecessor), tuple(map(plain, rule.right))


def _parameters(rule: Production, constants: frozenset[str]) -> list[str]:
    arguments = [argument for module in rule.parameters for argument in module.arguments]
    return [a.name for a in arguments if isinstance(a, Name) and a.name not in constants]


def _candidates(rules: Sequence[Production], row: Sequence[int], constants: frozenset[str]) -> Iterator[tuple[int, Production]]:
    """The rules of a row, and between them those for all modules of the kind, made for the modules of the row."""
    first, places = rules[row[0]], set(row)
    for number in range(row[0], len(rules)):
        rule = rules[number]
        if number in places:
            yield number, rule
        elif rule.probability is None and _is_for_all(rule, first, constants):
            names = dict(zip(_parameters(rule, constants), first.predecessor.arguments, strict=True))
            condition = None if rule.condition is None else substituted(rule.condition, names)
            if condition is None or names_in(condition) or value_of(condition):
                yield (
                    number,
                    replace(
                        first,
                        successor=with_expressions(rule.successor, partial(substituted, values=names)),
                        probability=None,
                        condition=condition if condition and names_in(condition) else None,
                    ),
                )


def _is_for_all(rule: Production, other: Production, constants: frozenset[str]) -> bool:
    """Whether a rule is for all modules of the kind that another is for, whatever their values and neighbours."""
    one, two = rule.predecessor, other.predecessor
    return (
        (one.symbol, len(one.arguments)) == (two.symbol, len(two.arguments))
        and not rule.left
        and not rule.right
        and len(_parameters(rule, constants)) == len(one.arguments)
    )


@dataclass
class _Shares:
    """How rules for the same modules share a probability of 1, one after another.

    Attributes
    ----------
    parts
        For each condition the probabilities of its rules; 1 for all that is left.
    bounds
        Their sums; those that are calculated from names are taken to leave room for others.
    closed
        The conditions under which nothing is left.
    """

    parts: dict[_Condition, list[Expression]] = field(default_factory=dict)
    bounds: dict[_Condition, Fraction] = field(default_factory=dict)
    closed: set[_Condition] = field(default_factory=set)

    @property
    def common(self) -> _Condition:
        """The condition under which all the rules match; None where they have none or different ones."""
        return next(iter(self.parts)) if len(self.parts) == 1 else None

    @property
    def complete(self) -> bool:
        """Whether nothing is left wherever one of the rules matches."""
        return None in self.closed or self.common in self.closed

    def beside(self, condition: _Condition) -> list[_Condition]:
        """The conditions that may hold together with another."""
        return [
            other
            for other in self.parts
            if other in (None, condition) or len(self.parts) > _MOST_COMPARED or not exclusive(other, condition)
        ]

    def taken(self, condition: _Condition) -> Fraction:
        """What is taken at most where a condition holds."""
        return sum((self.bounds[other] for other in self.beside(condition)), Fraction(0))

    def left(self, condition: _Condition) -> Expression:
        """What is left where a condition holds: a number, if that is known."""
        beside = self.beside(condition)
        asked = [(other, share) for other in beside for share in self.parts[other]]
        if {*beside} <= {None, condition} and not any(names_in(share) for _, share in asked):
            return _exact_number(max(Fraction(0), 1 - self.taken(condition)))
        return _remaining([s if other in (None, condition) else Apply("if", (other, s, Number(0))) for other, s in asked])

    def give(self, condition: _Condition, share: Expression | None) -> Expression:
        """The probability of a rule that claims a share, or all that is left."""
        given, claimed, closes = self._share_of(condition, share)
        if closes:
            self.closed.add(condition)
        self.parts.setdefault(condition, []).append(claimed)
        value = Fraction(0) if names_in(claimed) else Fraction(value_of(claimed))
        self.bounds[condition] = self.bounds.get(condition, Fraction(0)) + value
        return given

    def _share_of(self, condition: _Condition, share: Expression | None) -> tuple[Expression, Expression, bool]:
        """The probability of a rule, what counts for the next ones, and whether nothing is left for these."""
        if share is not None and not names_in(share):
            together = self.taken(condition) + Fraction(value_of(share))
            if together < 1:
                return share, share, False
            left = self.left(condition)
            if together == 1:
                return share, share, not names_in(left)
        else:
            left = self.left(condition)
            if share is None or share in (left, *(left.operands[1:] if isinstance(left, Apply) else ())):
                return share or left, Number(1) if names_in(left) else left, True
            if isinstance(share, Apply) and share == Apply("min", (share.operands[0], left)):
                return share, share.operands[0], False  # cut off already
            if self.taken(condition) < 1:
                return share, share, False
        return (Apply("min", (share, left)), share, False) if names_in(left) else (left, left, True)


def _remaining(terms: list[Expression]) -> Expression:
    """What is left by probabilities that are not all numbers."""
    count = len(terms)
    while len(terms) > 1:  # in pairs, so that a long sum is not nested deeply
        terms = [Apply("+", (*terms[i : i + 2],)) if terms[i + 1 :] else terms[i] for i in range(0, len(terms), 2)]
    left = Apply("max", (Number(0), Apply("-", (Number(1), *terms)))) if terms else Number(1)
    if len(str(left)) > current().expression:
        raise ModelLimitError(
            f"What {count} rules leave is written with more than {current().expression:,} characters",
            limit=current().expression,
            hint="Write their probabilities as numbers.",
        )
    return left


def _complete_row(system: LSystem, row: Sequence[int], constants: frozenset[str], found: list[list[Production]]) -> list[str]:
    """Put the rules for the same modules, with probabilities that add up to 1, where they belong; notes on them."""
    first = system.productions[row[0]]
    names, shares, notes = _parameters(first, constants), _Shares(), list[str]()
    for number, rule in _candidates(system.productions, row, constants):
        there = dict(zip(_parameters(rule, constants), map(Name, names), strict=True))
        condition = None if rule.condition is None else substituted(rule.condition, there)
        if rule.probability is None and (shares.closed & {None, condition} or (number not in row and shares.complete)):
            continue  # never applied where the others are
        share = None if rule.probability is None else substituted(rule.probability, there)
        given = shares.give(condition, share)
        if share not in (None, given):
            notes.append(f"The probabilities of {rule.predecessor} add up to more than 1: {share} is read as {given}.")
        whole = replace(rule, probability=substituted(given, {new.name: Name(old) for old, new in there.items()}))
        if number in row:
            found[number][-1] = whole
        else:
            found[number].insert(0, whole)
    if not shares.complete:
        condition = shares.common
        rest = replace(first, successor=(first.predecessor,), condition=condition, probability=shares.left(condition))
        found[row[-1]].append(rest)
        notes.append(f"{rest.predecessor} stays as it is with the probability that its rules leave: {rest.probability}.")
    return notes


def _exact_number(value: Fraction) -> Expression:
    """A number as it reads: a decimal fraction, or a quotient."""
    if "/" in number_text(value):
        return Apply("/", (Number(value.numerator), Number(value.denominator)))
    return Number(value.numerator if value.denominator == 1 else value)
