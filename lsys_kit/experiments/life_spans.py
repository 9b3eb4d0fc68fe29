"""Life spans as letters: what the number of cells obeys, and how fast it grows, whatever the life spans are.

Each cell that is born with a life span s leaves, when that is over, the daughters that its production names. If the number of
cells grows as x^t, the numbers of births b of the kinds of cells obey b = b X D: X has x^-s on its diagonal for each kind, and
entry (i, j) of D says how many daughters j a cell i leaves. So det(1 - X D) = 0 is the equation for the growth x, a sum of
powers of x (Euler's and Lotka's equation for populations). Each of its terms belongs to a set of kinds, and its coefficient is
a principal minor of D. It also says how many cells there are: N(t) = N(t - A) + N(t - B) for 1 = x^-A + x^-B.

The life spans are sums of multiples of the constants of the model. Which ones is found from ages at birth and at division for
several values of these constants, near those of the model, in rational numbers.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import combinations, pairwise
from typing import TYPE_CHECKING, NamedTuple

from lsys_kit.budget import Task, check_budget
from lsys_kit.derivation.core.rules import constants_of, number_from, unknown_constant, with_constants
from lsys_kit.derivation.timed.ages import StepAges
from lsys_kit.derivation.timed.timed import timed
from lsys_kit.errors import LSystemError, ModelLimitError, ModelNameError, ModelValueError, require
from lsys_kit.experiments.table import Table
from lsys_kit.experiments.totals import slider_range
from lsys_kit.notation.model.arithmetic import Value, is_symbolic, normalised, number_text
from lsys_kit.notation.model.expressions import names_in
from lsys_kit.notation.model.formulas import formula_latex, formula_text
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.plots.chart import Axis, Level, LevelChart, Plot, name_label

if TYPE_CHECKING:
    import sympy

MOST_BORN, MOST_KINDS = 200, 10
"""So many modules are born at most; so many kinds are told apart: the equation has up to 2 to this power terms."""
SMALL = Fraction(1, 64)
"""By how much a constant is changed that is no number of steps."""
FASTEST = 1e12
"""No greater growth is looked for."""
ACROSS, HEIGHTS, LEVELS, NEAR = 60, 8, 5, 0.18
"""Points of a curve of equal growth; at how many heights it is looked for; into how many parts curves divide the diagonal; a
curve that is nearer to that of the model's own values is left out."""


class _Cell(NamedTuple):
    """A module that is born: its life span, and the numbers of its daughters whose lives end, too."""

    module: Module
    span: Value
    daughters: tuple[int, ...]


class Kind(NamedTuple):
    """Modules that live equally long and leave the same daughters.

    born
        One of them, as it is born with the model's own constants.
    span
        Its life span: a number, and how often each letter is added to it.
    daughters
        How many daughters of each kind it leaves.
    """

    born: Module
    span: tuple[Value, ...]
    daughters: tuple[int, ...]


@dataclass(frozen=True)
class LifeSpans:
    """What the life spans of cells say of their number.

    Attributes
    ----------
    system
        The system.
    letters
        The constants that the life spans depend on and that were given no value.
    kinds
        The kinds of cells whose lives end.
    """

    system: LSystem
    letters: tuple[str, ...]
    kinds: tuple[Kind, ...] = field(hash=False)
    _values: Mapping[str, Value] = field(hash=False, repr=False)

    @cached_property
    def _terms(self) -> dict[tuple[Value, ...], int]:
        """The equation for the growth x: for each life span s, as in `Kind`, the coefficient of x^-s."""
        from sympy import ZZ
        from sympy.polys.matrices import DomainMatrix

        found: Counter[tuple[Value, ...]] = Counter()
        many = range(len(self.kinds))
        for size in range(len(self.kinds) + 1):
            for chosen in combinations(many, size):
                check_budget()
                minor = int(
                    DomainMatrix([[self.kinds[i].daughters[j] for j in chosen] for i in chosen], (size, size), ZZ).det()
                )
                spans = [self.kinds[i].span for i in chosen]
                whole = tuple(normalised(sum(parts, Fraction())) for parts in zip(*spans, self._none, strict=True))
                found[whole] += (-1) ** size * minor
        return {span: c for span, c in found.items() if c}

    @property
    def _none(self) -> tuple[Value, ...]:
        return (0,) * (len(self.letters) + 1)

    def _shown(self, span: Sequence[Value]) -> sympy.Expr:
        import sympy

        number, *often = (sympy.Rational(*Fraction(part).as_integer_ratio()) for part in span)
        return number + sympy.Add(*(c * unknown_constant(name) for c, name in zip(often, self.letters, strict=True)))

    def _ordered(self) -> list[tuple[tuple[Value, ...], int]]:
        """The terms but the first, which is 1; the kinds that the axiom leads to first come first."""
        return [(span, -c) for span, c in self._terms.items() if span != self._none]

    @property
    def recurrence(self) -> str:
        """What the number of cells obeys in the long run.

        >>> from lsys_kit import system
        >>> life_spans(system("J4")).recurrence
        'N(t) = N(t - lifeTimeA) + N(t - lifeTimeB)'
        """
        said = ""
        for span, c in self._ordered():
            sign = (" - " if c < 0 else " + ") if said else "-" if c < 0 else ""
            said += f"{sign}{'' if abs(c) == 1 else f'{abs(c)} '}N(t - {self._in_brackets(span)})"
        return f"N(t) = {said or 0}"

    def _in_brackets(self, span: Sequence[Value]) -> str:
        shown = self._shown(span)
        return f"({number_text(shown)})" if shown.is_Add else number_text(shown)

    @property
    def equation(self) -> sympy.Eq:
        """The equation for the growth x in a unit of time.

        >>> from lsys_kit import system
        >>> life_spans(system("J4")).equation
        Eq(1, x**(-lifeTimeB) + x**(-lifeTimeA))
        """
        import sympy

        left, right = self._sides
        return sympy.Eq(sympy.Add(1, *left), sympy.Add(*right), evaluate=False)

    @property
    def _sides(self) -> tuple[list[sympy.Expr], list[sympy.Expr]]:
        """The terms that are added to 1, and those that are together as much."""
        terms = [(c, self.x ** -self._shown(span)) for span, c in self._ordered()]
        return [-c * power for c, power in terms if c < 0], [c * power for c, power in terms if c > 0]

    @property
    def x(self) -> sympy.Symbol:
        """The growth in the equation."""
        import sympy

        return sympy.Symbol("x" if "x" not in self.letters else "X", positive=True)

    def rate(self, **letters: object) -> float:
        """By what factor the number of cells grows in a unit of time: the greatest root of the equation.

        Letters take the values that are given, or else those of the model.

        >>> from lsys_kit import system
        >>> found = life_spans(system("J4"))
        >>> [round(found.rate(lifeTimeA=a, lifeTimeB=b), 4) for a, b in ((3, 2), (2, 3), (5, 1), (4, 1))]
        [1.3247, 1.3247, 1.3247, 1.3803]
        """
        with Task("The growth was not found"):
            return self._rate(self._spans(self._chosen(letters)))

    def _chosen(self, letters: Mapping[str, object]) -> list[Value]:
        for name in letters:
            self._check(name)
        chosen = [number_from(letters.get(name, self._values[name]), name) for name in self.letters]
        if any(map(is_symbolic, chosen)):
            raise ModelValueError("The growth is a number only where each life span is one")
        return chosen

    def _check(self, letter: object) -> str:
        require(letter, str, "A letter")
        if letter not in self.letters:
            said = f"Its letters are: {', '.join(self.letters)}." if self.letters else "It has none."
            raise ModelNameError(f'No life span depends on a letter "{letter}"', hint=said)
        return str(letter)

    def _spans(self, values: Sequence[Value]) -> list[float]:
        """The life spans in numbers."""
        spans = [
            float(number + sum(c * v for c, v in zip(often, values, strict=True))) for _, (number, *often), _ in self.kinds
        ]
        if min(spans, default=1) <= 0:
            raise ModelValueError("A life span would not be above 0", hint="Take other numbers for the letters.")
        return spans

    def _rate(self, spans: Sequence[float]) -> float:
        high = math.log(FASTEST)
        if self._grows_faster(high, spans):
            raise ModelValueError(f"The cells grow by more than {FASTEST:g} in a unit of time")
        return math.exp(_crossing(lambda log: self._grows_faster(log, spans), 0.0, high))

    def _grows_faster(self, log: float, spans: Sequence[float]) -> bool:
        """Whether the number of cells grows as fast as x^t or faster: whether 1 - X D is no M-matrix, so that elimination meets
        a number that is not above 0."""
        check_budget()
        weights = [math.exp(-span * log) for span in spans]
        rows = [
            [(i == j) - weight * c for j, c in enumerate(kind.daughters)]
            for i, (kind, weight) in enumerate(zip(self.kinds, weights, strict=True))
        ]
        for i, row in enumerate(rows):
            if row[i] <= 1e-13:
                return True
            for other in rows[i + 1 :]:
                share = other[i] / row[i]
                for j in range(i, len(row)):
                    other[j] -= share * row[j]
        return False

    def solve(self, letter: str, rate: object, **letters: object) -> float:
        """The value of a letter for which the cells grow by a factor in a unit of time.

        >>> from lsys_kit import system
        >>> round(life_spans(system("J4")).solve("lifeTimeB", 1.3247179572447, lifeTimeA=5), 6)
        1.0
        """
        name, wanted = self._check(letter), number_from(rate, "rate")
        if is_symbolic(wanted) or wanted <= 1:
            raise ModelValueError("The growth that is asked for must be a number above 1")
        with Task("The equation was not solved"):
            values, at = self._chosen(letters), self.letters.index(name)
            unit = max((abs(float(value)) for value in values), default=1.0) or 1.0
            places = [0.0, *(unit * 2.0 ** (k / 4) for k in range(-40, 41))]
            found = self._solved([*map(float, values)], at, math.log(wanted), places)
            if found is None:
                raise ModelValueError(f"For no value of {name} do the cells grow by {number_text(wanted)} in a unit of time")
            return found

    @cached_property
    def _numbers(self) -> list[tuple[float, list[float]]]:
        """The life spans as doubles: a number, and how often each letter is added to it."""
        return [(float(number), [*map(float, often)]) for _, (number, *often), _ in self.kinds]

    def _solved(self, values: Sequence[float], at: int, log: float, places: Sequence[float]) -> float | None:
        """The value of a letter between the first and the last place for which the growth is e^log; None if there is none."""

        def faster(value: float) -> bool | None:
            spans = [
                number + sum(c * (value if i == at else values[i]) for i, c in enumerate(often))
                for number, often in self._numbers
            ]
            return None if min(spans) <= 0 else self._grows_faster(log, spans)

        known = [(place, found) for place in places if (found := faster(place)) is not None]
        for (left, before), (right, after) in pairwise(known):
            if before != after:
                return _crossing(lambda value, before=before: faster(value) == before, left, right)  # type: ignore[misc]
        return None

    @property
    def table(self) -> Table:
        """The kinds of cells: how they are born, how long they live, and what they leave."""
        names = [str(kind.born) for kind in self.kinds]
        rows = tuple(
            (
                name,
                formula_text(self._shown(kind.span)),
                ", ".join(n if c == 1 else f"{c} {n}" for n, c in zip(names, kind.daughters, strict=True) if c),
            )
            for name, kind in zip(names, self.kinds, strict=True)
        )
        return Table(("born as", "life span", "daughters"), rows, 1)

    def plot(self, across: str | None = None, up: str | None = None, **letters: object) -> Plot:
        """Curves of equal growth over two letters, by default the first two; that of the model's own values is marked.

        >>> from lsys_kit import system
        >>> life_spans(system("J4")).plot()
        5 curves of equal growth, 1.149 to 1.414, marked: 1.325; lifeTimeA from 1 to 6, lifeTimeB from 1 to 6
        """
        for given in (across, up):
            require(given, (str, type(None)), "A letter")
        if len(self.letters) < 2 and not (across and up):
            raise ModelValueError(
                "Curves of equal growth need two letters", hint=f"There is {', '.join(self.letters) or 'none'}."
            )
        names = [self._check(across or next(name for name in self.letters if name != up))]
        names.append(self._check(up or next(name for name in self.letters if name != names[0])))
        if names[0] == names[1]:
            raise ModelValueError("The two letters must be different")
        with Task("The plot was not made"):
            values = self._chosen(letters)
            at = self.letters.index(names[0]), self.letters.index(names[1])
            ranges = self._range(names[0]), self._range(names[1])
            own = self._level(values, at, ranges, self.rate(**letters), True)
            levels = {own.value: own}
            for k in range(1, LEVELS):
                place = [low + (high - low) * Fraction(k, LEVELS) for low, high in ranges]
                on_diagonal = [place[at.index(i)] if i in at else value for i, value in enumerate(values)]
                rate = self._rate(self._spans(on_diagonal)) if self._lives(on_diagonal) else 0.0
                if rate > 1 and abs(rate - own.value) > NEAR * (own.value - 1):
                    levels.setdefault(rate, self._level(values, at, ranges, rate, False))
            axes = Axis(name_label(names[0])), Axis(name_label(names[1]))
            box = tuple((float(low), float(high)) for low, high in ranges)
            return Plot(LevelChart(tuple(levels.values()), *axes, box))  # type: ignore[arg-type]

    def _lives(self, values: Sequence[Value]) -> bool:
        return all(n + sum(c * v for c, v in zip(often, values, strict=True)) > 0 for _, (n, *often), _ in self.kinds)

    def _level(
        self, values: Sequence[Value], at: tuple[int, int], ranges: Sequence[tuple[Value, Value]], rate: float, own: bool
    ) -> Level:
        """The curve on which the growth has a value; on the model's own the points where both letters are whole numbers."""
        (left, right), (low, high) = ranges
        points, whole = [], []
        heights = [float(low + (high - low) * Fraction(k, HEIGHTS)) for k in range(HEIGHTS + 1)]
        places = {left + (right - left) * Fraction(k, ACROSS) for k in range(ACROSS + 1)}
        places |= {Fraction(k) for k in range(math.ceil(left), math.floor(right) + 1)}
        for place in sorted(places):
            chosen = [float(place if i == at[0] else value) for i, value in enumerate(values)]
            found = self._solved(chosen, at[1], math.log(rate), heights) if rate > 1 else None
            if found is not None:
                points.append((float(place), found))
                if float(place).is_integer() and abs(found - round(found)) < 1e-6:
                    whole.append(points[-1])
        for height in (low, high) if rate > 1 else ():
            chosen = [float(height if i == at[1] else value) for i, value in enumerate(values)]
            there = self._solved(chosen, at[0], math.log(rate), [float(left), float(right)])
            if there is not None:
                points.append((there, float(height)))
        return Level(rate, tuple(sorted(points)), tuple(whole) if own else (), own)

    def _range(self, name: str) -> tuple[Value, Value]:
        """The range of a constant's slider; where it has none, from half its value to twice that."""
        value = Fraction(self._values[name]) or Fraction(1)
        return slider_range(self.system, name) or (normalised(value / 2), normalised(2 * value))

    @property
    def latex(self) -> str:
        """The equation in LaTeX."""

        left, right = (map(formula_latex, side) for side in self._sides)
        return f"{' + '.join(['1', *left])} = {' + '.join(right)}"

    def _repr_latex_(self) -> str:
        return f"$\\Large {self.latex}$"

    def __repr__(self) -> str:
        left, right = (map(number_text, side) for side in self._sides)
        return f"{self.recurrence}; {' + '.join(['1', *left])} = {' + '.join(right)}; growth {self.rate():.4f}"


def _crossing(holds: Callable[[float], bool], low: float, high: float) -> float:
    """Where a statement that holds at the lower number ceases to hold."""
    while low < (middle := (low + high) / 2) < high:
        low, high = (middle, high) if holds(middle) else (low, middle)
    return high


def life_spans(system: LSystem, **constants: object) -> LifeSpans:
    """What the number of cells obeys, and how fast it grows, with life spans as letters.

    Parameters
    ----------
    system
        A system in which cells have ages, in steps or as a timed system (see `timed`).
    **constants
        Values for declared constants. Any other constant that a life span depends on is a letter.

    Returns
    -------
    LifeSpans
        It has `.recurrence`, `.equation`, `.rate(...)`, `.solve(...)`, `.table`, `.plot()`, which draws the curves of equal
        growth over two letters, and `.latex`. The formulas hold as long as cells divide in the same way as with the model's
        own values.

    Raises
    ------
    ModelValueError
        The productions do not say how long modules live, or no kind of cells has descendants of its own kind.
    ModelLimitError
        There are too many kinds of cells.

    Examples
    --------
    >>> from lsys_kit import system
    >>> life_spans(system("J4"))
    N(t) = N(t - lifeTimeA) + N(t - lifeTimeB); 1 = x^(-lifeTimeA) + x^(-lifeTimeB); growth 1.3247
    >>> life_spans(system("P6"), t_s=0).recurrence
    'N(t) = N(t - t_div) + N(t - (t_div - t_l))'
    """
    require(system, LSystem, "An L-system")
    with Task("The life spans were not found"):
        values = constants_of(system, constants)
        if any(map(is_symbolic, values)):
            raise ModelValueError("Letters need no value here", hint="Leave them out: what has no value is a letter.")
        free = [each.name for each in system.constants if each.name not in constants and not names_in(each.value)]
        chosen = {each.name: value for each, value in zip(system.constants, values, strict=True)}
        own = {name: chosen[name] for name in (*constants, *free)}  # the others follow from these
        steps = _in_steps(system, own)
        near = own if steps else _told_apart(system, own, free)
        cells = _cells(system, near)
        letters, slopes = _slopes(system, near, free, cells, steps)
        rows = [*zip(*slopes, strict=True)] if slopes else [()] * len(cells)
        there = [near[name] for name in letters]
        spans = [(_less(cell.span, row, there), *row) for cell, row in zip(cells, rows, strict=True)]
        born = [cell.module for cell in _cells(system, own)]
        kinds = _kinds(cells, spans, [_nearest(cell.module, born) for cell in cells])
        if not kinds:
            raise ModelValueError("No cell has descendants of its own kind, so that their number does not grow for ever")
        return LifeSpans(system, letters, kinds, {name: own[name] for name in letters})


def _less(span: Value, row: Sequence[Value], values: Sequence[Value]) -> Value:
    """What is left of a life span without the multiples of the letters."""
    return normalised(Fraction(span - sum(c * value for c, value in zip(row, values, strict=True))))


def _nearest(module: Module, born: Sequence[Module]) -> Module:
    """The module that is most like another."""

    def distance(other: Module) -> float:
        if (other.symbol, len(other.arguments)) != (module.symbol, len(module.arguments)):
            return math.inf
        return sum(abs(float(a) - float(b)) for a, b in zip(other.arguments, module.arguments, strict=True))

    return min(born, key=distance)


def _told_apart(system: LSystem, own: Mapping[str, Value], names: Sequence[str]) -> dict[str, Value]:
    """Constants near those of the model, so that modules are told apart that only happen to be born at the same age."""
    near = dict(own)
    for many, name in enumerate(names, 2):
        moved = near | {name: near[name] + SMALL / many**2}
        with suppress(LSystemError):
            if len(_cells(system, moved)) > len(_cells(system, near)):
                near = moved
    return near


def _in_steps(system: LSystem, values: Mapping[str, Value]) -> bool:
    """Whether lives last whole steps."""
    ages = timed(with_constants(system, values)).ages
    return isinstance(ages, StepAges) and not ages.even


def _cells(system: LSystem, values: Mapping[str, Value]) -> list[_Cell]:
    """The modules that are born and whose lives end, in the order in which they are met."""
    growing = timed(with_constants(system, values))
    ages, numbers = growing.ages, dict[Module, int]()
    order: list[tuple[Module, Value, list[Module]]] = []
    todo = [growing.states.modules[state] for state in growing.states.axiom]
    for module in todo:
        check_budget()
        end = None if module in numbers else ages.end(module)
        if end is None or end.rule is None:
            continue
        ages.check_birth(module)
        numbers[module] = len(order)
        order.append((module, normalised(end.age - (ages.age(module) or 0)), daughters := ages.daughters(module)))
        todo += daughters
        if len(order) > MOST_BORN:
            raise ModelLimitError(f"More than {MOST_BORN} different modules are born", limit=MOST_BORN)
    return [_Cell(module, span, tuple(numbers[d] for d in made if d in numbers)) for module, span, made in order]


def _slopes(
    system: LSystem, own: Mapping[str, Value], names: Sequence[str], cells: Sequence[_Cell], steps: bool
) -> tuple[tuple[str, ...], list[list[Value]]]:
    """The constants that life spans depend on, and by how much each span grows when each of them grows by 1."""
    amount = Fraction(1) if steps else SMALL

    def changes(moved: Mapping[str, int]) -> list[Value] | None:
        """By how much the life spans change; None where cells divide in another way."""
        values = {name: normalised(own[name] + moved.get(name, 0) * amount) for name in own}
        try:
            there = _cells(system, values)
        except LSystemError:
            return None
        if [cell.daughters for cell in there] != [cell.daughters for cell in cells]:
            return None
        return [normalised(Fraction(a.span - b.span) / amount) for a, b in zip(there, cells, strict=True)]

    found = {name: slope for name in names if (slope := changes({name: 1})) is not None and any(slope)}
    letters, slopes = tuple(found), list(found.values())
    for moved in (dict.fromkeys(letters, 2), {name: 1 + i for i, name in enumerate(letters)}):
        wanted = [sum(each[i] * moved[name] for name, each in zip(letters, slopes, strict=True)) for i in range(len(cells))]
        if letters and changes(moved) != wanted:
            raise ModelValueError(
                "The life spans are no sums of multiples of the constants near their values",
                hint=f"Give some of these a value: {', '.join(letters)}.",
            )
    return letters, slopes


def _kinds(cells: Sequence[_Cell], spans: Sequence[tuple[Value, ...]], born: Sequence[Module]) -> tuple[Kind, ...]:
    """The kinds of cells that have descendants of their own kind, and are descendants of one that has."""
    classes: list[object] = list(spans)
    while True:
        finer = [
            (classes[i], tuple(sorted(Counter(map(classes.__getitem__, cell.daughters)).items(), key=str)))
            for i, cell in enumerate(cells)
        ]
        numbers = {each: n for n, each in enumerate(dict.fromkeys(finer))}
        if len(numbers) == len(set(classes)):
            break
        classes = [numbers[each] for each in finer]
    firsts = {each: i for i, each in reversed([*enumerate(classes)])}
    made = {each: Counter(classes[d] for d in cells[i].daughters) for each, i in firsts.items()}
    kept = list(dict.fromkeys(classes))
    while True:
        mothers = {d for each in kept for d in made[each]}
        still = [each for each in kept if each in mothers and any(d in kept for d in made[each])]
        if still == kept:
            break
        kept = still
    if len(kept) > MOST_KINDS:
        raise ModelLimitError(f"There are more than {MOST_KINDS} kinds of cells", limit=MOST_KINDS, needed=len(kept))
    return tuple(Kind(born[firsts[each]], spans[firsts[each]], tuple(made[each][d] for d in kept)) for each in kept)
