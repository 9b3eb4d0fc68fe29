"""Continuity: does a filament grow without a jump where its cells divide? (ABOP,
section 6.2; P. Prusinkiewicz, Introduction to Modeling with L-systems, section 8)

A growth function g gives the length of a cell at an age. The length of the filament is continuous where

    R1  each growth function is continuous on the life span of its letter, from the first age to the terminal age;
    R2  at each division g(mother, terminal age) is the sum of g(daughter, first age) over the daughters.

Of order k it is continuous where the same holds for the derivatives up to the k-th. Names in a growth function that have
no value are unknown: R2 is then an equation for them, such as a^t_div = a^t_s + a^t_l.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from lsys_kit.budget import Task
from lsys_kit.derivation.core.rules import real_from, unknown_constant
from lsys_kit.derivation.timed.ages import AgeModel, births
from lsys_kit.derivation.timed.equations import roots
from lsys_kit.derivation.timed.length_changes import Division, equal_lengths, unknown_names
from lsys_kit.derivation.timed.length_functions import (
    in_sympy,
    is_continuous,
    is_decided,
    length_functions,
    the_age,
    written_functions,
)
from lsys_kit.derivation.timed.timed import Timed, timed
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelValueError, require, shown
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.supervision import supervised

if TYPE_CHECKING:
    import sympy

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
        >>> from lsys_kit.notation.read import read
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

        others: set[str] = set()
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
    >>> from lsys_kit.notation.read import read
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
        return _continuity(system, lengths, order, constants)


def _continuity(system: LSystem | Timed, lengths: Mapping[str, str], order: int, constants: Mapping[str, object]) -> Continuity:
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
    """The timed system with its constants set, and the values of other names."""
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
