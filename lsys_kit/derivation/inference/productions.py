"""Systems from tables: the productions that turn each letter into its successor, with no more context than they need.

What a module becomes nearly everywhere is the last of its productions; what it becomes between some neighbours stands before
it.

Modules with parameters fall into as few cases as possible, each with a condition and laws of its own. The values of a case lie
in a box whose sides are thresholds of single parameters, and boxes of different cases have no value in common: so a condition
compares parameters with numbers, perhaps several in conjunction. By a law a value of the successor stays, is moved by an
amount, is multiplied, or both (affine laws); it may also be that of another parameter, the sum or the difference of two, or
always the same.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import count, product
from typing import TypeAlias

from lsys_kit.budget import check_budget
from lsys_kit.derivation.inference.problem import Conditions, Letter, Row, Table
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem, Production


def system_of(axiom: Row, productions: Iterable[Production], conditions: Conditions) -> LSystem:
    """The system with an axiom and productions; in its contexts constants are passed over.

    >>> print(system_of((Module("a"),), [], Conditions()))
    axiom: a
    """
    rules = tuple(productions)
    ignored = tuple(sorted(conditions.constants)) if any(rule.left or rule.right for rule in rules) else ()
    return LSystem(row_of(axiom), rules, ignored=ignored)


def row_of(row: Iterable[Module]) -> tuple[Pattern, ...]:
    """Modules as an axiom or a production writes them."""
    return tuple(Pattern(module.symbol, tuple(map(Number, module.arguments))) for module in row)


def productions_of(table: Table) -> Iterator[Production]:
    """Productions for a table, symbol by symbol; a module that stays as it is needs none.

    >>> a, b = Module("a"), Module("b")
    >>> table = {Letter((), a, (a,)): (a,), Letter((a,), a, (b,)): (b,), Letter((a,), b): (a, b)}
    >>> [str(production) for production in productions_of(table)]
    ['a > b -> b', 'b -> a b']
    """
    of_one: dict[Module, dict[Letter, Row]] = {}
    for letter, word in table.items():
        of_one.setdefault(letter.module, {})[letter] = word
    for module, own in of_one.items():
        yield from _productions_of_one(module, own)


def _productions_of_one(module: Module, table: Table) -> Iterator[Production]:
    found = Counter(table.values())
    usual = (module,) if (module,) in found else found.most_common(1)[0][0]  # where no context says otherwise
    open_letters = _explicit(table, usual)
    while open_letters:
        check_budget()
        letter = open_letters[0]
        context = _least_context(letter, table)
        yield Production(row_of((module,)), row_of(table[letter]), left=row_of(context.left), right=row_of(context.right))
        table = {other: word for other, word in table.items() if not _extends(other, context)}
        open_letters = [other for other in open_letters if other in table]
    if usual != (module,):
        yield Production(row_of((module,)), row_of(usual))


def _explicit(table: Table, usual: Row) -> list[Letter]:
    """The letters that need a production with a context, those with the most neighbours first: what becomes something else, and
    what would be taken for it, as where a letter at the end of a word has fewer neighbours."""
    unusual = [letter for letter, word in table.items() if word != usual]
    taken = [letter for letter, word in table.items() if word == usual and any(_extends(letter, other) for other in unusual)]
    return sorted([*unusual, *taken], key=lambda letter: len(letter.left) + len(letter.right), reverse=True)


def _least_context(letter: Letter, table: Table) -> Letter:
    """The letter with as few of its neighbours as distinguish it from those that become something else."""
    sizes = [(left, right) for left in range(len(letter.left) + 1) for right in range(len(letter.right) + 1)]
    contexts = (
        Letter(letter.left[len(letter.left) - left :], letter.module, letter.right[:right])
        for left, right in sorted(sizes, key=sum)
    )
    return next(
        context
        for context in contexts
        if all(word == table[letter] for other, word in table.items() if _extends(other, context))
    )


def _extends(letter: Letter, context: Letter) -> bool:
    """Whether a letter has the neighbours that a context asks for."""
    left, right = len(context.left), len(context.right)
    return letter.left[max(0, len(letter.left) - left) :] == context.left and letter.right[:right] == context.right


Values: TypeAlias = tuple[Value, ...]
"""The values of a module's parameters."""
POINTS_FOR_TWO_NUMBERS = 3
"""Through two points there is always a straight line; so many different ones must lie on it."""


def law_of(given: Sequence[Values], made: Sequence[Value], names: Sequence[str], place: int) -> Expression | None:
    """The simplest expression for what became of a value; None where there is none.

    >>> print(law_of([(1, 0), (3, 1)], [2, 4], ["x", "y"], 0))
    x + 1
    >>> print(law_of([(1,), (3,), (4,)], [3, 7, 9], ["x"], 0))
    2 * x + 1
    """
    return next(_laws(given, made, names, place), None)


def _laws(given: Sequence[Values], made: Sequence[Value], names: Sequence[str], place: int) -> Iterator[Expression]:
    """The laws that a value obeys, the simplest first; of a kind that of the parameter at its own place first."""
    if len({*made}) == 1:
        yield Number(made[0])
    axes = sorted(range(len(names)), key=lambda axis: axis != place)
    points = {axis: [(values[axis], value) for values, value in zip(given, made, strict=True)] for axis in axes}
    for axis in axes:
        if all(before == after for before, after in points[axis]):
            yield Name(names[axis])
    for axis in axes:
        amounts = {after - before for before, after in points[axis]}
        if len(amounts) == 1:
            yield plus(Name(names[axis]), amounts.pop())
    for axis in axes:
        factors = {_quotient(after, before) if before else None for before, after in points[axis]}
        if len(factors) == 1 and (factor := factors.pop()) is not None:
            yield Apply("*", (Number(factor), Name(names[axis])))
    for one, other, (operator, sign) in product(axes, range(len(names)), (("+", 1), ("-", -1))):
        if one != other and all(values[one] + sign * values[other] == value for values, value in zip(given, made, strict=True)):
            yield Apply(operator, (Name(names[one]), Name(names[other])))
    for axis in axes:
        if len({x for x, _ in points[axis]}) >= POINTS_FOR_TWO_NUMBERS:
            (x0, y0), (x1, y1) = min(points[axis]), max(points[axis])
            factor = _quotient(y1 - y0, x1 - x0)
            if all(y - y0 == factor * (x - x0) for x, y in points[axis]):
                yield plus(Apply("*", (Number(factor), Name(names[axis]))), y0 - factor * x0)


def _quotient(above: Value, below: Value) -> Value:
    return above / below if isinstance(above, float) or isinstance(below, float) else normalised(Fraction(above) / below)


def plus(expression: Expression, amount: Value) -> Expression:
    """The sum of an expression and a number, as one writes it.

    >>> print(plus(Name("x"), -2))
    x - 2
    """
    return Apply("+" if amount > 0 else "-", (expression, Number(normalised(amount if amount > 0 else -amount))))


Case: TypeAlias = tuple[tuple[Values, Row], ...]
"""The values of some modules of one kind, with their successors."""
Kind: TypeAlias = tuple[str, int]
"""A symbol and the number of its parameters."""
NAMES = ("x", "y", "z")
"""The names of up to so many parameters."""


def general_productions(table: Table, look: Callable[[], None] = check_budget) -> Iterator[Production]:
    """Productions with parameters for a table, as few as possible; modules that stay as they are need none.

    Each way to divide modules into cases is a `look`, which may raise an error where there are too many.

    >>> from lsys_kit.derivation.inference.problem import Letter
    >>> a = [Letter((), Module("a", (age,))) for age in range(4)]
    >>> table = {a[0]: (a[1].module,), a[1]: (a[2].module,), a[2]: (a[3].module,), a[3]: (a[0].module,) * 2}
    >>> [str(production) for production in general_productions(table)]
    ['a(x) : x < 3 -> a(x + 1)', 'a(x) : x >= 3 -> a(0)a(0)']
    """
    kinds: dict[Kind, dict[Values, Row]] = {}
    for letter, word in table.items():
        module = letter.module
        kinds.setdefault((module.symbol, len(module.arguments)), {})[module.arguments] = word
    for kind, successors in kinds.items():
        cases = fewest_cases(kind, successors, look)
        for case in cases:
            if any(word != (Module(kind[0], values),) for values, word in case):
                others = [other for other in cases if other is not case]
                own = Pattern(kind[0], tuple(map(Name, names_of(kind))))
                made = _successor(kind, case, keeps=not others)
                assert made is not None
                yield Production((own,), made, condition=_condition(kind, case, others))


def fewest_cases(kind: Kind, successors: dict[Values, Row], look: Callable[[], None] = check_budget) -> list[Case]:
    """The fewest cases that the modules of a kind fall into, rather with simple laws, which one point shows, than others."""
    values = [sorted({*along}) for along in zip(*successors, strict=True)]
    ranks = [{value: rank for rank, value in enumerate(along)} for along in values]
    points = [
        _Point(point, _symbols(point[1]), tuple((rank[value],) * 2 for rank, value in zip(ranks, point[0], strict=True)))
        for point in sorted(successors.items())
    ]
    fewest = len({point.kinds for point in points})
    return next(
        found
        for most in count(fewest)
        for free in (1, POINTS_FOR_TWO_NUMBERS - 1)
        for found in _divided(kind, points, [], most, free, look)
    )


Box: TypeAlias = tuple[tuple[int, int], ...]
"""For each parameter the least and the greatest value, by their ranks."""


@dataclass(frozen=True)
class _Point:
    """The values of a module with its successor, the kinds of that, and the box of the values."""

    point: tuple[Values, Row]
    kinds: tuple[Kind, ...]
    box: Box


def _divided(
    kind: Kind,
    points: Sequence[_Point],
    cases: list[tuple[Case, tuple[Kind, ...], Box]],
    most: int,
    free: int,
    look: Callable[[], None],
) -> Iterator[list[Case]]:
    """All ways to divide the rest of the points among at most so many cases; so many points of a case need no law yet."""
    look()
    if not points:
        if all(_successor(kind, case, False) is not None for case, _, _ in cases):
            yield [case for case, _, _ in cases]
        return
    here = points[0]
    for number, (case, kinds, box) in enumerate(cases):
        wider, around = (*case, here.point), _around(box, here.box)
        others = cases[:number] + cases[number + 1 :]
        fits = kinds == here.kinds and _apart(around, others)
        if fits and (len(wider) <= free or _successor(kind, wider, False) is not None):
            own = [*cases[:number], (wider, kinds, around), *cases[number + 1 :]]
            yield from _divided(kind, points[1:], own, most, free, look)
    if len(cases) < most and _apart(here.box, cases):
        yield from _divided(kind, points[1:], [*cases, ((here.point,), here.kinds, here.box)], most, free, look)


def _around(one: Box, other: Box) -> Box:
    """The least box around two."""
    return tuple((min(a, c), max(b, d)) for (a, b), (c, d) in zip(one, other, strict=True))


def _symbols(word: Row) -> tuple[Kind, ...]:
    """The kinds of modules of a word, which are the same in a case."""
    return tuple((module.symbol, len(module.arguments)) for module in word)


def _apart(box: Box, others: Iterable[tuple[Case, tuple[Kind, ...], Box]]) -> bool:
    """Whether a box has no value in common with those of the cases."""
    return all(any(b < c or d < a for (a, b), (c, d) in zip(box, other, strict=True)) for _, _, other in others)


def _side(case: Case, other: Case, axis: int) -> int:
    """On which side of another case's box one lies: -1 below, 1 above, 0 where they overlap."""
    own, others = _along(case, axis), _along(other, axis)
    return -1 if max(own) < min(others) else 1 if min(own) > max(others) else 0


def _along(case: Case, axis: int) -> list[Value]:
    return [values[axis] for values, _ in case]


def _successor(kind: Kind, case: Case, keeps: bool) -> tuple[Pattern, ...] | None:
    """The successor of a case's modules as a production writes it; None where no laws give their values.

    It may be asked that a value which is that of a parameter is written as the parameter, though it is always the same number.
    """
    names = names_of(kind)
    given, words = [values for values, _ in case], [word for _, word in case]
    found = []
    for index, module in enumerate(words[0]):
        laws = []
        for place in range(len(module.arguments)):
            values = [word[index].arguments[place] for word in words]
            kept = keeps and place < len(names) and values == [each[place] for each in given]
            law = Name(names[place]) if kept else law_of(given, values, names, place)
            if law is None:
                return None
            laws.append(law)
        found.append(Pattern(module.symbol, tuple(laws)))
    return tuple(found)


def names_of(kind: Kind) -> list[str]:
    """The names of a module's parameters.

    >>> names_of(("F", 2)), names_of(("F", 4))
    (['x', 'y'], ['x1', 'x2', 'x3', 'x4'])
    """
    return [*NAMES[: kind[1]]] if kind[1] <= len(NAMES) else [f"x{number}" for number in range(1, kind[1] + 1)]


def _condition(kind: Kind, case: Case, others: Sequence[Case]) -> Expression | None:
    """What distinguishes the modules of a case from those of the others; None where there are none."""
    comparisons: list[Expression] = []
    left = list(others)
    names = names_of(kind)
    while left:
        axis = max(range(kind[1]), key=lambda axis: sum(map(abs, (_side(case, other, axis) for other in left))))
        there = [other for other in left if _side(case, other, axis)]
        left = [other for other in left if not _side(case, other, axis)]
        comparisons += _comparisons(Name(names[axis]), case, there, axis)
    return reduce(lambda one, another: Apply("&&", (one, another)), comparisons) if comparisons else None


def _comparisons(name: Name, case: Case, others: Sequence[Case], axis: int) -> Iterator[Expression]:
    """The comparisons of a parameter that hold in a case and not in others."""
    own = {*_along(case, axis)}
    below = [min(_along(other, axis)) for other in others if _side(case, other, axis) < 0]
    above = [other for other in others if _side(case, other, axis) > 0]
    if len(own) == 1 and ((below and above) or all(len({*_along(other, axis)}) == 1 for other in others)):
        yield Apply("==", (name, Number(own.pop())))
        return
    if above:
        yield Apply(">=", (name, Number(min(own))))
    if below:
        yield Apply("<", (name, Number(min(below))))
