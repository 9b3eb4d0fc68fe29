"""GROGRA's probabilities: `?p` behind a rule is the chance that it is applied, and what the rules leave is the chance that
nothing happens (seed 003).

The kit chooses among weights, whatever they add up to. So the rest becomes a rule of its own that changes nothing, a rule
without `?` behind others gets what those leave, and a number that goes beyond 1 is cut off there. Only where rules with
probabilities and different contexts, or more than 1 in all under different conditions, match at once are their weights taken
in proportion.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.arithmetic import Value, number_text
from lsys_kit.notation.checks import value_of
from lsys_kit.notation.expressions import Apply, Expression, Name, Number, names_in
from lsys_kit.notation.model import Item, LSystem, Module, Production, Repeat

_Share = tuple[Expression | None, Expression]
"""When a rule matches, and with what probability it is applied then."""


def completed(system: LSystem) -> tuple[tuple[Production, ...], tuple[str, ...]]:
    """The productions with the chance that nothing happens, and notes that say so.

    >>> from lsys_kit.notation.read import read
    >>> for rule in completed(read("axiom: a\\na -> b : 0.3\\na -> c : 0.5"))[0]:
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
            rules, said = _whole(list(_candidates(system.productions, row, constants, system.source)), constants, system.source)
            for number, rule in zip(row, rules, strict=False):
                found[number] = [rule]
            found[row[-1]] += rules[len(row):]
            notes += said
    return tuple(rule for rules in found for rule in rules), tuple(notes)


def _left_side(rule: Production, constants: frozenset[str]) -> object:
    """What rules share that are for the same modules: contexts and predecessor, whatever the parameters are called."""
    names = {name: Name(f"?{number}") for number, name in enumerate(_parameters(rule, constants))}

    def plain(module: Module) -> Module:
        return replace(module, arguments=tuple(renamed(a, names) for a in module.arguments))  # type: ignore[arg-type]

    return tuple(map(plain, rule.left)), plain(rule.predecessor), tuple(map(plain, rule.right))


def _parameters(rule: Production, constants: frozenset[str]) -> list[str]:
    arguments = [argument for module in rule.parameters for argument in module.arguments]
    return [a.name for a in arguments if isinstance(a, Name) and a.name not in constants]


def _candidates(rules: Sequence[Production], row: Sequence[int], constants: frozenset[str],
                source: str) -> Iterator[tuple[Production, bool]]:
    """The rules of a row, and between them those for all modules of the kind; the second of a pair says which is which."""
    first, places = rules[row[0]], set(row)
    for number in range(row[0], len(rules)):
        rule = rules[number]
        if number in places:
            yield rule, True
        elif rule.probability is None and _is_for_all(rule, first, constants):
            names = dict(zip(_parameters(rule, constants), first.predecessor.arguments, strict=True))
            condition = None if rule.condition is None else renamed(rule.condition, names)  # type: ignore[arg-type]
            if condition is None or names_in(condition) or value_of(condition, source):
                yield replace(first, successor=renamed_items(rule.successor, names), probability=None,  # type: ignore[arg-type]
                              condition=condition if condition and names_in(condition) else None), False


def _is_for_all(rule: Production, other: Production, constants: frozenset[str]) -> bool:
    """Whether a rule is for all modules of the kind that another is for, whatever their values and neighbours."""
    one, two = rule.predecessor, other.predecessor
    return ((one.symbol, len(one.arguments)) == (two.symbol, len(two.arguments)) and not rule.left and not rule.right
            and len(_parameters(rule, constants)) == len(one.arguments))


def renamed(expression: Expression, names: Mapping[str, Expression]) -> Expression:
    """An expression with others in place of some names.

    >>> print(renamed(Apply("+", (Name("t"), Number(1))), {"t": Name("s")}))
    s + 1
    """
    if isinstance(expression, Name):
        return names.get(expression.name, expression)
    if isinstance(expression, Apply):
        return Apply(expression.operator, tuple(renamed(operand, names) for operand in expression.operands), expression.at)
    return expression


def renamed_items(items: Iterable[Item], names: Mapping[str, Expression]) -> tuple[Item, ...]:
    """A word with others in place of some names."""
    return tuple(
        Repeat(renamed(item.count, names), renamed_items(item.body, names), item.index, item.at) if isinstance(item, Repeat)
        else replace(item, arguments=tuple(renamed(a, names) for a in item.arguments))  # type: ignore[arg-type]
        for item in items)


@dataclass
class _Shares:
    """What rules for the same modules take of a probability of 1.

    Attributes
    ----------
    parts
        For each rule its condition, and the probability with which it is applied where that holds.
    total
        Their sum, if all of them are numbers.
    conditions
        All conditions, each once.
    """

    parts: list[_Share] = field(default_factory=list)
    total: Fraction | None = Fraction(0)
    conditions: dict[Expression | None, None] = field(default_factory=dict)

    def add(self, condition: Expression | None, share: Expression, source: str) -> None:
        """Take in one rule more."""
        value = _value(share, source)
        self.total = None if self.total is None or value is None else self.total + Fraction(value)
        self.conditions[condition] = None
        self.parts.append((condition, share))

    @property
    def common(self) -> Expression | None:
        """The condition under which all the rules match; None where they have none or different ones."""
        return self.parts[0][0] if len(self.conditions) == 1 else None

    def known(self, condition: Expression | None) -> Fraction | None:
        """What they leave where a condition holds, if that is a number."""
        apart = len(self.conditions) > 2 or self.conditions.keys() - {None, condition}
        return None if apart or self.total is None else max(Fraction(0), 1 - self.total)

    def left(self, condition: Expression | None) -> Expression:
        """What they leave where a condition holds."""
        known = self.known(condition)
        return _remaining(self.parts, condition) if known is None else _number(known)

    def complete(self) -> bool:
        """Whether nothing is left: the sum is 1, or the last rule has just what the others leave."""
        if self.known(self.common) is not None:
            return self.known(self.common) == 0
        condition, last = self.parts[-1]
        return condition == self.common and last == _remaining(self.parts[:-1], condition)


def _remaining(parts: Sequence[_Share], condition: Expression | None) -> Expression:
    """What is left by probabilities that are not all numbers."""
    terms = [share if when in (None, condition) else Apply("if", (when, share, Number(0))) for when, share in parts]
    while len(terms) > 1:  # in pairs, so that a long sum is not nested deeply
        terms = [Apply("+", (*terms[i:i + 2],)) if terms[i + 1:] else terms[i] for i in range(0, len(terms), 2)]
    left = Apply("max", (Number(0), Apply("-", (Number(1), *terms))))
    if len(str(left)) > current().expression:
        raise ModelLimitError(f"What {len(parts)} rules leave is written with more than {current().expression:,} characters",
                              limit=current().expression, hint="Write their probabilities as numbers.")
    return left


def _whole(candidates: Sequence[tuple[Production, bool]], constants: frozenset[str],
           source: str) -> tuple[list[Production], list[str]]:
    """The rules for the same modules with probabilities that add up to 1, those that are added last; and notes."""
    first = candidates[0][0]
    names = _parameters(first, constants)
    found, added, notes, shares = list[Production](), list[Production](), list[str](), _Shares()
    for rule, own in candidates:
        if not own and shares.complete():
            continue
        there = dict(zip(_parameters(rule, constants), map(Name, names), strict=True))
        condition = None if rule.condition is None else renamed(rule.condition, there)
        known = shares.known(condition)
        if rule.probability is None and known == 0:
            found += [rule] * own  # never applied where the others are
            continue
        if rule.probability is None:
            share = shares.left(condition)
        else:
            share, value = renamed(rule.probability, there), _value(rule.probability, source)
            if known is not None and value is not None and value > known:
                share = _number(known)
                notes.append(f"The probabilities of {rule.predecessor} add up to more than 1: {rule.probability} is read as "
                             f"{share}.")
        back = {new.name: Name(old) for old, new in there.items()}
        (found if own else added).append(replace(rule, probability=renamed(share, back)))
        shares.add(condition, share, source)
    if not shares.complete():
        rest = replace(first, successor=(first.predecessor,), condition=shares.common, probability=shares.left(shares.common))
        added.append(rest)
        notes.append(f"{rest.predecessor} stays as it is with the probability that its rules leave: {rest.probability}.")
    return [*found, *added], notes


def _value(expression: Expression, source: str) -> Value | None:
    """What an expression comes to, where it uses no names."""
    return None if names_in(expression) else value_of(expression, source)


def _number(value: Fraction) -> Expression:
    """A number as it reads: a decimal fraction, or a quotient."""
    if "/" in number_text(value):
        return Apply("/", (Number(value.numerator), Number(value.denominator)))
    return Number(value.numerator if value.denominator == 1 else value)
