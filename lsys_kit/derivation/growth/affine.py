"""Systems whose values change by affine maps: what the values of all modules add up to obeys a linear recurrence.

A production `A(x) -> F(x) A(q*x + 1)` makes of every x a value that is a sum of multiples of the parameters and of a constant.
What all x of all modules A add up to at a step, and how many of these there are, then depends linearly on the same numbers a
step before: on the vector of all such sums and counts, one growth matrix works, as on the counts alone (see `growth`). Its
entries are rational functions of the constants that are left unknown.

Parameters that decide which production is applied keep their values: modules with different ones are different kinds. Where
productions are chosen by chance, the vector is the mean.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import nullcontext, suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias, TypeVar

from lsys_kit.budget import check_budget
from lsys_kit.derivation.core.chance import splitmix64
from lsys_kit.derivation.core.rules import Rule, kind_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.traits import S0L
from lsys_kit.derivation.growth.recurrences import remainder_of_power, shortest_rule, solved, unknown
from lsys_kit.derivation.growth.slicing import ArgumentPosition, deciding_positions, slice_system
from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import Value, divide, expanded_value, expression_of, is_symbolic, normalised
from lsys_kit.notation.model.modules import CLOSING, OPENING, Module
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.supervision import supervised

if TYPE_CHECKING:
    import sympy
    from sympy.polys.domains.domain import Domain
    from sympy.polys.fields import FracElement
    from sympy.polys.rings import PolyElement

Kind: TypeAlias = tuple[str, tuple[Value | None, ...]]
"""A symbol, and the values of its parameters that decide something; None stands for the others."""
Sum: TypeAlias = tuple[Kind, int]
"""The sum of the parameter at a place over all modules of a kind; at place -1, how many there are."""
Coefficient: TypeAlias = "Fraction | FracElement"
"""An element of a field, see `field_of`."""
Combination: TypeAlias = dict[Sum, Coefficient]
"""A sum of multiples of such sums."""
MOST_SUMS, MOST_CASES = 200, 8
"""So many sums at most: their recurrence is found from twice as many steps; so many formulas, each for values of letters."""
_Name = TypeVar("_Name")


class NotAffine(ModelValueError):
    """There is no linear recurrence for what is to be added up; the message says why."""


@dataclass(frozen=True)
class AffineSums:
    """What the values of the modules of a symbol add up to, step by step, as a linear recurrence says.

    Attributes
    ----------
    letters
        The constants that are left unknown, as sympy's symbols.
    rule
        The shortest rule of the sums from the first on: a(t) = c1 a(t-1) + c2 a(t-2) + ...
    first
        As many sums as the rule has coefficients, from step 0 on.
    """

    letters: tuple[sympy.Symbol, ...]
    rule: tuple[Coefficient, ...]
    first: tuple[Coefficient, ...]

    def at(self, step: int) -> Value | sympy.Expr:
        """The sum at a step: a number, or an expression in the letters."""
        with supervised() if self.letters else nullcontext():
            weights = remainder_of_power(self.rule, step)
            return self.shown(sum((c * term for c, term in zip(weights, self.first, strict=True)), self._field(0)))

    def __iter__(self) -> Iterator[Value | sympy.Expr]:
        """The sums from step 0 on, without end."""
        yield from map(self.shown, self._elements())

    def _elements(self) -> Iterator[Coefficient]:
        """The sums as elements of the field."""
        latest: deque[Coefficient] = deque(self.first, len(self.rule))
        yield from self.first
        while True:
            term = sum((c * term for c, term in zip(self.rule, reversed(latest), strict=True)), self._field(0))
            latest.append(term)
            yield term

    @cached_property
    def _field(self) -> Domain:
        return field_of(self.letters)

    def shown(self, element: Coefficient) -> Value | sympy.Expr:
        """An element of the field of coefficients as a number or as sympy's expression."""
        return shown_element(element, self._field)

    def formulas(self, n: sympy.Symbol, most: int = MOST_CASES) -> list[Case]:
        """The sum at step n in powers and roots, and where that divides by 0, for each letter that is to blame a formula in
        the others, down to `most` cases. None where there are only sums that no power or root says.

        >>> from sympy.abc import n
        >>> from lsys_kit import read
        >>> shoot = read("q = 1/2\\naxiom: A(1)\\nA(x) -> F(x) A(q*x)")
        >>> affine_sums(shoot, "F", 0, False, {"q": "q"}).formulas(n)
        [Case(formula=(q**n - 1)/(q - 1), given={}, unless=(Ne(q, 1),)), Case(formula=n, given={q: 1}, unless=())]
        """
        import sympy

        domain, x = self._field if self.letters else sympy.QQ, unknown("x", self.letters)
        rule, first = ([_in_domain(c, domain) for c in each] for each in (self.rule, self.first))
        whole = sympy.Poly.from_list([domain(1), *(-c for c in rule)], x, domain=domain)
        terms = sympy.Poly.from_list(first or [domain(0)], x, domain=domain)
        found = solved(whole, terms, n)
        if found is None:
            return []
        formula, divisors = found
        if self.letters:
            formula = sympy.powsimp(sympy.factor(sympy.together(formula)), combine="base", force=True)
        unless, others = list[sympy.Basic](), dict[frozenset[object], Case]()
        for divisor in divisors:
            check_budget()
            letter, root = _root(divisor, self.letters)
            if letter is not None:
                unless.append(sympy.Ne(letter, root))
                for case in self._cases(letter, root, n, most - 1 - len(others)):
                    others.setdefault(frozenset(case.given.items()), case)
            elif not _has_no_root(divisor):
                unless.append(sympy.Ne(divisor, 0))
        return [Case(formula, {}, tuple(unless)), *others.values()]

    def _cases(self, letter: sympy.Symbol, root: sympy.Expr, n: sympy.Symbol, most: int) -> list[Case]:
        """The formulas where a letter has a value, which may depend on the others."""
        there = self.where(letter, root) if most > 0 else None
        found = there.formulas(n, most) if there else []
        return [case._replace(given={letter: root.subs(case.given), **case.given}) for case in found]

    def where(self, letter: sympy.Symbol, value: sympy.Expr) -> AffineSums | None:
        """The sums where a letter has a value; None where there they have none."""
        letters = tuple(each for each in self.letters if each != letter)
        field = field_of(letters)
        found = []
        for element in (*self.rule, *self.first):
            there = expression_of(self.shown(element)).subs(letter, value)
            if not there.is_finite and there.is_number:
                return None
            found.append(field.from_sympy(there) if letters else Fraction(int(there.p), int(there.q)))
        return AffineSums(letters, tuple(found[: len(self.rule)]), tuple(found[len(self.rule) :]))

    def derivative(self, letter: sympy.Symbol) -> AffineSums:
        """How the sums change with a letter: they obey the rule whose polynomial is the square of theirs."""
        squared = _product([self._field(1), *(-c for c in self.rule)], [self._field(1), *(-c for c in self.rule)])
        generator = self._field.from_sympy(letter)
        terms = islice(self._elements(), 2 * len(self.rule))
        return AffineSums(self.letters, tuple(-c for c in squared[1:]), tuple(self._field(c).diff(generator) for c in terms))


def _in_domain(element: Coefficient, domain: Domain) -> Any:
    """An element of a field of coefficients as sympy's polynomials have it."""
    return domain(element.numerator, element.denominator) if domain.is_QQ else domain.convert(element)


class Case(NamedTuple):
    """A formula for a sum at step n.

    formula
        The formula.
    given
        The values of letters for which it is meant.
    unless
        What else must hold of the letters: it divides by what must not be 0.
    """

    formula: sympy.Expr
    given: dict[sympy.Symbol, sympy.Expr]
    unless: tuple[sympy.Basic, ...]


def _root(divisor: sympy.Expr, letters: Sequence[sympy.Symbol]) -> tuple[sympy.Symbol, sympy.Expr] | tuple[None, None]:
    """A letter, and the only value of it for which a polynomial is 0, whatever the other letters are; or None."""
    for letter in reversed(letters):
        slope = divisor.diff(letter)
        if slope and slope.is_number:
            return letter, (letter - divisor / slope).expand()
    return None, None


def _has_no_root(divisor: sympy.Expr) -> bool:
    """Whether a polynomial in one letter is never 0."""
    import sympy

    return len(divisor.free_symbols) == 1 and not sympy.Poly(divisor).count_roots()


def field_of(letters: Sequence[sympy.Symbol]) -> Domain:
    """The rational numbers, or the rational functions of some letters: a field as sympy has it."""
    if not letters:
        return Fraction
    import sympy

    return sympy.ZZ.frac_field(*letters)


def shown_element(element: Coefficient, field: Domain) -> Value | sympy.Expr:
    """An element of a field of coefficients as a number or as sympy's expression."""
    if field is Fraction:
        return normalised(Fraction(element))
    found = field.to_sympy(field.convert(element))
    return normalised(Fraction(int(found.p), int(found.q))) if found.is_Rational else found


def affine_sums(system: LSystem, symbol: str, place: int | None, on_axis: bool, constants: Mapping[str, object]) -> AffineSums:
    """The recurrence of what a parameter adds up to over all modules of a symbol.

    Parameters
    ----------
    system
        Any L-system.
    symbol
        The symbol of the modules.
    place
        Which parameter, from 0; a module that has none counts as 1. None: how many modules there are.
    on_axis
        Whether only modules outside all brackets are taken.
    constants
        New values of declared constants; a letter stands for itself.

    Raises
    ------
    NotAffine
        The values are not sums of multiples of values, or depend on neighbours or on random numbers.

    Examples
    --------
    >>> from lsys_kit import read
    >>> found = affine_sums(read("q = 1/2\\naxiom: A(1)\\nA(x) -> F(x) A(q*x)"), "F", 0, False, {"q": "q"})
    >>> found.at(3), found.rule, found.first
    (q**2 + q + 1, (q + 1, -q), (0, 1))
    """
    kinds = {kind_of(module) for module in system.modules if module.symbol == symbol}
    if not kinds:
        hint = suggestion(symbol, symbols(system)) or f"Its symbols are: {' '.join(symbols(system))}."
        raise ModelNameError(f'The system has no symbol "{symbol}"', hint=hint)
    wanted = frozenset((symbol, size, place) for _, size in kinds if place is not None and place < size)
    if place and not wanted:
        raise ModelNameError(f"No module {symbol} has a parameter number {place + 1}")
    return _Maps(system, wanted, on_axis, constants).sums(symbol, place)


class _Maps:
    """What becomes of each kind of module, as a linear map of counts and sums."""

    def __init__(self, system: LSystem, wanted: frozenset[ArgumentPosition], on_axis: bool, constants: Mapping[str, object]):
        self.system, self.on_axis = slice_system(system, wanted), on_axis
        self.places = _places_kept(system, wanted)
        self.states = States(self.system, dict(constants))
        _refuse_interactions(self.states)
        self.deciding = deciding_positions(self.system)
        self.letters = tuple(
            sorted({each for value in self.states.constants for each in getattr(value, "free_symbols", ())}, key=str)
        )
        self.field = field_of(self.letters)
        self.one = self.field(1)
        self._numbers: dict[Value, Coefficient] = {1: self.one}

    def sums(self, symbol: str, place: int | None) -> AffineSums:
        """Follow the kinds from the axiom on; where values are not affine, the parameters behind them decide something too."""
        bent: frozenset[ArgumentPosition] = frozenset()
        while True:
            try:
                with supervised() if self.letters else nullcontext():
                    return self._recurrence(symbol, place)
            except _Bent as found:
                bent |= found.positions
                self.deciding |= found.positions
            except ModelValueError as error:
                if not bent:
                    raise
                names = ", ".join(sorted({name for name, _, _ in bent}))
                raise NotAffine(
                    f"There is no formula: values of {names} are multiplied by one another, or are put into a function"
                ) from error

    def _recurrence(self, symbol: str, place: int | None) -> AffineSums:
        rows, start = self._closed()
        asked = {key: often for key in rows if (often := self._often(key, symbol, place))}
        rows = _leading_to(asked, rows)
        rows, start = _merged(rows, start, asked)
        if not self.letters:
            rule = shortest_rule([*_terms(rows, start, asked, 2 * len(rows) + 2)])
        else:
            rule = self._rule_in_letters(rows, start, asked)
        return AffineSums(self.letters, rule, tuple(_terms(rows, start, asked, len(rule))))

    def _rule_in_letters(
        self, rows: Mapping[Sum, Combination], start: Combination, asked: Combination
    ) -> tuple[Coefficient, ...]:
        """The shortest rule: a product of factors of the matrix's characteristic polynomial, of which numbers in place of the
        letters show which are needed. The numbers are large, so that no two factors are likely to become alike by chance."""
        from sympy.polys.matrices import DomainMatrix

        numbers = {source: number for number, source in enumerate(rows)}
        entries = {
            numbers[source]: {numbers[key]: factor for key, factor in row.items()} for source, row in rows.items() if row
        }
        matrix = DomainMatrix(entries, (len(rows), len(rows)), self.field)
        factors: list[tuple[list[Coefficient], int]] = []
        trial = 0
        while True:
            check_budget()
            trial += 1
            values = [Fraction(splitmix64(trial * 1_000 + place) % 2**31) for place in range(len(self.letters))]
            try:
                known = {source: {key: _valued(factor, values) for key, factor in row.items()} for source, row in rows.items()}
                begun, weights = ({key: _valued(amount, values) for key, amount in each.items()} for each in (start, asked))
                left = [Fraction(1), *(-c for c in shortest_rule([*_terms(known, begun, weights, 2 * len(rows) + 2)]))]
                if len(left) == len(rows) + 1:
                    return tuple(-c for c in matrix.charpoly()[1:])
                factors = factors or [
                    ([self.field.convert(c) / self.field.convert(coefficients[0]) for c in coefficients], times)
                    for coefficients, times in matrix.charpoly_factor_list()
                ]
                needed: list[Coefficient] = [self.one]
                for coefficients, times in factors:
                    divisor = [_valued(c, values) for c in coefficients]
                    for _ in range(times):
                        quotient = _quotient(left, divisor)
                        if quotient is None:
                            break
                        left, needed = quotient, _product(needed, coefficients)
            except ZeroDivisionError:
                continue
            if len(left) == 1:
                return tuple(-self.field.convert(c) for c in needed[1:])

    def _often(self, key: Sum, symbol: str, place: int | None) -> Coefficient:
        """How often a sum is a part of what is asked for."""
        kind, at = key
        if kind[0] != symbol:
            return 0
        kept = None if place is None else self.places.get((symbol, len(kind[1])), {}).get(place)
        if kept is None:
            return self.one if at == -1 else 0
        if kind[1][kept] is None:
            return self.one if at == kept else 0
        return self._element(kind[1][kept]) if at == -1 else 0

    def _closed(self) -> tuple[dict[Sum, Combination], Combination]:
        """What each sum adds to the sums of the next step, and the sums of the axiom."""
        start: Combination = {}
        for module in self._outside(self.states.modules[state] for state in self.states.axiom):
            _add(start, self._made(module, {}, None), self.one)
        rows: dict[Sum, Combination] = {}
        waiting = list(dict.fromkeys(kind for kind, _ in start))
        met = set(waiting)
        while waiting:
            kind = waiting.pop()
            own = self._rows_of(kind)
            rows |= own
            if len(rows) > MOST_SUMS:
                raise NotAffine(
                    f"More than {MOST_SUMS} kinds of modules would have to be told apart",
                    hint=f"The last one was {_kind_text(kind)}: a parameter that decides something takes ever new values.",
                )
            new = dict.fromkeys(made for row in own.values() for made, _ in row if made not in met)
            waiting += new
            met |= set(new)
        return rows, start

    def _rows_of(self, kind: Kind) -> dict[Sum, Combination]:
        """What the count of a kind, and the sum of each of its parameters that decide nothing, add to the next step."""
        import sympy

        unknown = {place: sympy.Dummy(f"x{place}", real=True) for place, value in enumerate(kind[1]) if value is None}
        arguments: tuple[Value | sympy.Expr, ...] = tuple(unknown.get(place, value) for place, value in enumerate(kind[1]))
        module = Module(kind[0], arguments)
        positions = {symbol: (kind[0], len(kind[1]), place) for place, symbol in unknown.items()}
        rows: dict[Sum, Combination] = {(kind, place): {} for place in (-1, *unknown)}
        for share, made in self._successors(module):
            for each in self._outside(made):
                for key, parts in self._made(each, positions, kind).items():
                    for source, factor in parts.items():
                        row = rows[kind, source]
                        part = factor if share is self.one else share * factor
                        row[key] = row[key] + part if key in row else part
        return rows

    def _successors(self, module: Module) -> Iterator[tuple[Coefficient, list[Module]]]:
        """What may replace a module, and how likely that is."""
        states = self.states
        matched = states.matching_rules(module, states.rules)
        weighted: list[tuple[Rule | None, Value]] = [(matched[0][0] if matched else None, 1)]
        if matched and matched[0][0].probability is not None:
            weighted = [*states.weighted(matched)]
        whole = sum((weight for _, weight in weighted), 0)
        if not is_symbolic(whole) and not whole > 0:
            raise NotAffine(f"The probabilities of what becomes of {module.symbol} add up to nothing")
        for rule, weight in weighted:
            row = states.decompose(module) if rule is None else states.replacement(rule, module)
            yield self._element(divide(weight, whole)), [states.modules[state] for state in row]

    def _outside(self, modules: Iterable[Module]) -> Iterator[Module]:
        """The modules that are followed: all, or those outside brackets."""
        depth = 0
        for module in modules:
            depth += (module.symbol in OPENING) - (module.symbol in CLOSING)
            if not (self.on_axis and (depth or module.symbol in CLOSING)):
                yield module

    def _made(
        self, module: Module, positions: Mapping[sympy.Symbol, ArgumentPosition], source: Kind | None
    ) -> dict[Sum, dict[int, Coefficient]]:
        """The sums to which a module adds: for each, how much one module of its source does, and each of its parameters."""
        size = len(module.arguments)
        kept = tuple(
            value if (module.symbol, size, place) in self.deciding else None for place, value in enumerate(module.arguments)
        )
        for value in kept:
            found: set[sympy.Symbol] = getattr(value, "free_symbols", set()) & set(positions)
            if found:
                raise _Bent(frozenset(positions[symbol] for symbol in found))
        kind = module.symbol, kept
        made: dict[Sum, dict[int, Coefficient]] = {(kind, -1): {-1: self.one}}
        for place, value in enumerate(module.arguments):
            if kept[place] is None:
                made[kind, place] = self._parts(value, positions)
        return made

    def _parts(self, value: Any, positions: Mapping[sympy.Symbol, ArgumentPosition]) -> dict[int, Coefficient]:
        """A value as a constant, at place -1, and a multiple of each parameter."""
        if not is_symbolic(value):
            return {-1: self._element(value)}
        own = value.free_symbols & set(positions)
        with supervised():
            factors = {symbol: value.diff(symbol) for symbol in own}
            bent = {symbol for symbol, factor in factors.items() if factor.free_symbols & set(positions)}
            rest = value.subs(dict.fromkeys(own, 0)) if not bent else value
        if bent:
            raise _Bent(frozenset(positions[symbol] for symbol in own))
        return {-1: self._element(rest)} | {positions[symbol][2]: self._element(factors[symbol]) for symbol in own}

    def _element(self, value: Value | sympy.Expr) -> Coefficient:
        """A number, or an expression in the letters, as an element of the field."""
        value = expanded_value(value) if is_symbolic(value) else value
        if isinstance(value, float):
            raise NotAffine(
                f"The value {value:.6g} is not known exactly",
                hint="Roots, sines and most powers of numbers have no exact form.",
            )
        if not is_symbolic(value):
            if value not in self._numbers:
                self._numbers[value] = self.field(value.numerator) / self.field(value.denominator)
            return self._numbers[value]
        with supervised(), suppress(ValueError):
            if self.field is not Fraction:
                return self.field.from_sympy(value)
        raise NotAffine(f"{value} is no quotient of polynomials")


class _Bent(Exception):
    """Some values are not affine: the parameters from which they are computed decide something."""

    def __init__(self, positions: frozenset[ArgumentPosition]) -> None:
        super().__init__()
        self.positions = positions


def _places_kept(system: LSystem, wanted: frozenset[ArgumentPosition]) -> dict[tuple[str, int], dict[int, int]]:
    """Where each parameter that is kept stands among those of its module that are."""
    kept = deciding_positions(system, wanted)
    places: dict[tuple[str, int], dict[int, int]] = {}
    for symbol, size in dict.fromkeys(map(kind_of, system.modules)):
        own = [place for place in range(size) if (symbol, size, place) in kept]
        places[symbol, len(own)] = {place: new for new, place in enumerate(own)}
    return places


def _refuse_interactions(states: States) -> None:
    """Refuse a system in which more than a module's own values and a choice by chance decides what becomes of it."""
    if states.traits.within(S0L._replace(meta=False)):
        return
    asked = {
        "context": "what becomes of a module depends on its neighbours",
        "predecessor": "several neighbours are replaced together",
        "random": "random numbers are drawn",
        "sensitive": "it depends on what the turtle sees",
        "cut": "branches are cut off",
        "meta": "meta-rules shorten the words",
    }
    why = next(
        (text for name, text in asked.items() if getattr(states.traits, name) > getattr(S0L, name)), "a step depends on more"
    )
    raise NotAffine(f"There is no formula: {why}")


def _valued(element: FracElement, values: Sequence[Fraction]) -> Fraction:
    """An element of a field of rational functions where its letters have values."""
    above, below = (_polynomial_value(part, values) for part in (element.numer, element.denom))
    return above / below


def _polynomial_value(polynomial: PolyElement, values: Sequence[Fraction]) -> Fraction:
    whole = Fraction(0)
    for exponents, coefficient in polynomial.terms():
        part = Fraction(int(coefficient.numerator), int(coefficient.denominator))
        for value, exponent in zip(values, exponents, strict=True):
            part *= value**exponent
        whole += part
    return whole


def _quotient(dividend: Sequence[Fraction], divisor: Sequence[Fraction]) -> list[Fraction] | None:
    """A polynomial divided by one whose first coefficient is 1, or None where something is left."""
    left = [*dividend]
    for place in range(len(dividend) - len(divisor) + 1):
        for k, c in enumerate(divisor[1:], 1):
            left[place + k] -= left[place] * c
    size = max(0, len(dividend) - len(divisor) + 1)
    return left[:size] if size and not any(left[size:]) else None


def _product(one: Sequence[Coefficient], other: Sequence[Coefficient]) -> list[Coefficient]:
    made: list[Coefficient] = [0] * (len(one) + len(other) - 1)
    for i, a in enumerate(one):
        for j, b in enumerate(other):
            made[i + j] += a * b
    return made


def _add(whole: Combination, made: Mapping[Sum, Mapping[int, Coefficient]], share: Coefficient) -> None:
    for key, parts in made.items():
        whole[key] = whole.get(key, 0 * share) + share * parts[-1]


def _leading_to(asked: Iterable[Sum], rows: Mapping[Sum, Combination]) -> dict[Sum, Combination]:
    """The rows of those sums that are a part of what is asked for, now or later."""
    sources: dict[Sum, list[Sum]] = {}
    for source, row in rows.items():
        for key, factor in row.items():
            if factor:
                sources.setdefault(key, []).append(source)
    met, waiting = {*asked}, [*asked]
    while waiting:
        new = {source for source in sources.get(waiting.pop(), ()) if source not in met}
        met |= new
        waiting += new
    return {source: {key: c for key, c in row.items() if key in met} for source, row in rows.items() if source in met}


def _merged(
    rows: Mapping[Sum, Combination], start: Combination, asked: Combination
) -> tuple[dict[Sum, Combination], Combination]:
    """The rows and the beginning, where sums that have the same part in what is asked for, now and ever after, are one."""
    classes: dict[Sum, object] = {key: asked.get(key, 0) for key in rows}
    many, own = 0, dict[Sum, int]()
    while many < len(set(classes.values())):
        numbers = {each: number for number, each in enumerate(dict.fromkeys(classes.values()))}
        many, own = len(numbers), {key: numbers[each] for key, each in classes.items()}
        classes = {key: (own[key], frozenset(_gathered(row, own).items())) for key, row in rows.items()}
    names = {number: key for key, number in reversed(own.items())}
    into = {key: names[number] for key, number in own.items()}
    return {key: _gathered(rows[key], into) for key in names.values()}, _gathered(start, into)


def _gathered(row: Combination, into: Mapping[Sum, _Name]) -> dict[_Name, Coefficient]:
    """A sum of multiples where several sums have the same name; those that have none are left out."""
    found: dict[_Name, Coefficient] = {}
    for key, factor in row.items():
        if key in into:
            name = into[key]
            found[name] = found[name] + factor if name in found else factor
    return {name: factor for name, factor in found.items() if factor}


def _terms(rows: Mapping[Sum, Combination], vector: Combination, asked: Combination, many: int) -> Iterator[Coefficient]:
    """What is asked for at the first steps."""
    for _ in range(many):
        total = sum((amount * asked[key] for key, amount in vector.items() if key in asked), 0)
        yield int(total) if isinstance(total, Fraction) and total.denominator == 1 else total
        vector = _applied(rows, vector)
        check_budget()


def _applied(rows: Mapping[Sum, Combination], vector: Combination) -> Combination:
    """The sums a step later."""
    found: Combination = {}
    for source, amount in vector.items():
        for key, factor in rows[source].items():
            found[key] = found[key] + amount * factor if key in found else amount * factor
    return {key: amount for key, amount in found.items() if amount}


def _kind_text(kind: Kind) -> str:
    symbol, values = kind
    shown = ",".join("·" if value is None else str(value) for value in values)
    return f"{symbol}({shown})" if values else symbol
