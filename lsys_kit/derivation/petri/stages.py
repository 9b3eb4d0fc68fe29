"""Stage diagrams: the Petri net of a system (Prusinkiewicz, Introduction to Modeling with L-systems, figure 2; Peterson 1981).

A place stands for one state. Cells that differ only in their polarity share a place, as in that figure, where tokens ignore
order and polarity: states that look the same but for the way they point, and whose successors do, are one place. Where a
parameter that decides nothing makes the states infinitely many, it is left out (see `slicing`). Where they are infinitely many
all the same, or depend on their neighbours, a place stands for all modules of one symbol (see `by_symbol`).

In a timed system a place is a stage of a module's life, and its transition says how long that is. Lives are divided at the
ages at which modules are born: where a long cell is born at the age at which a short one has become as long, as in
Prusinkiewicz (section 6), the life of a short cell has two stages, and in the second it is a long cell. So every module is in
exactly one stage, whatever its age.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Collection, Hashable, Iterator, Mapping, Sequence, Set
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial
from graphlib import CycleError, TopologicalSorter

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.growth.slicing import ArgumentPosition, deciding_positions, slice_system, without_arguments
from lsys_kit.derivation.petri.by_symbol import Product, Way, by_symbol, net_of, spots_of, unfolded_symbols
from lsys_kit.derivation.petri.net import Arc as Arc
from lsys_kit.derivation.petri.net import Outcome, all_outcomes
from lsys_kit.derivation.petri.net import Place as Place
from lsys_kit.derivation.petri.net import Stages as Stages
from lsys_kit.derivation.petri.net import Transition as Transition
from lsys_kit.derivation.timed.ages import AgelessModule, AgeModel, age_model, births
from lsys_kit.derivation.timed.timed import Timed
from lsys_kit.errors import ModelValueError, require
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.notation.model.modules import CELLS, Module
from lsys_kit.notation.model.system import LSystem


@dataclass(frozen=True)
class LifeStages:
    """The stages of all lives: the module of each at its first age, and what it becomes, and after how long: the next stage, or
    the daughters."""

    ages: AgeModel
    modules: tuple[Module, ...]
    outcomes: tuple[tuple[Outcome, ...], ...]
    _first: Mapping[AgelessModule, Mapping[Value, tuple[int, Sequence[Value]]]] = field(repr=False)

    def stage(self, module: Module) -> int | None:
        """The number of the stage in which a module is at its age; None where it cannot be at that age."""
        phases, age = self._first.get(self.ages.ageless(module), {}), self.ages.age(module) or 0
        found = next(iter(phases.values())) if len(phases) == 1 else phases.get(self.ages.phase(age))
        return None if found is None else found[0] + max(0, bisect_right(found[1], age) - 1)

    @property
    def is_late(self) -> bool:
        """Whether lives are shorter than the steps in which they are derived, so that they end later there."""
        return any(map(self.ages.is_late, self.modules))


def life_stages(ages: AgeModel, limit: int, look: Callable[[Module], Hashable] = lambda module: module) -> LifeStages:
    """The stages of all lives, as many as there may be; those of modules that look alike are divided at the same ages.

    >>> from lsys_kit import read, timed
    >>> found = life_stages(timed(read("axiom: M(0)\\nM(1) -> M(0) M(1/5)")).ages, 9)
    >>> for module, (outcome,) in zip(found.modules, found.outcomes):
    ...     print(module, outcome.span, *(found.modules[state] for state in outcome.successor))
    M(0) 1/5 M(0.2)
    M(0.2) 4/5 M(0) M(0.2)
    """
    try:
        first = births(ages, limit)
        _divide_alike(ages, first, look)
        return _divided_lives(ages, first)
    except TypeError:
        raise ModelValueError(
            "How long a module lives depends on a constant that is not known", hint="Choose a value for it."
        ) from None


def _divide_alike(
    ages: AgeModel, first: Mapping[AgelessModule, Mapping[Value, dict[Value, Module]]], look: Callable[[Module], Hashable]
) -> None:
    """Let lives begin a stage where those of modules that look alike do."""
    rows = [born for phases in first.values() for born in phases.values()]
    begun = [(age, module, look(module)) for born in rows for age, module in born.items()]
    for born in rows:
        youngest = born[min(born)]
        for age, module, seen in begun:
            end, other = ages.end(youngest), ages.aged(youngest, age)
            if (
                age not in born
                and min(born) < age
                and ages.phase(age) == ages.phase(min(born))
                and other != module
                and end is not None
                and end.rule is not None
                and age < end.age
                and look(other) == seen
            ):
                born[age] = other


def _divided_lives(ages: AgeModel, first: Mapping[AgelessModule, Mapping[Value, Mapping[Value, Module]]]) -> LifeStages:
    rows: dict[AgelessModule, dict[Value, tuple[int, Sequence[Value]]]] = {}
    modules: list[Module] = []
    for kind, phases in first.items():
        for phase, born in phases.items():
            mortal = any((end := ages.end(module)) is not None and end.rule is not None for module in born.values())
            rows.setdefault(kind, {})[phase] = len(modules), sorted(born)[: None if mortal else 1]
            modules += [born[age] for age in rows[kind][phase][1]]
    found = LifeStages(ages, tuple(modules), (), rows)
    outcomes = []
    for number, row in (part for phases in rows.values() for part in phases.values()):
        later = [*row[1:], None]
        outcomes += [_outcomes(found, number + at, *both) for at, both in enumerate(zip(row, later, strict=True))]
    at_once = {
        number: [state for outcome in ways if outcome.span == 0 for state in outcome.successor]
        for number, ways in enumerate(outcomes)
    }
    try:
        TopologicalSorter(at_once).prepare()
    except CycleError as cycle:
        raise ModelValueError(
            f"{modules[cycle.args[1][0]]} divides endlessly within one instant",
            hint="Let a daughter begin younger than the age at which she divides.",
        ) from None
    return LifeStages(ages, found.modules, tuple(outcomes), rows)


def _outcomes(found: LifeStages, number: int, age: Value, later: Value | None) -> tuple[Outcome, ...]:
    """What becomes of a stage: the next one, which begins at a later age, if its life lasts so long; else the daughters."""
    module = found.modules[number]
    found.ages.check_birth(module)
    end = found.ages.end(module)
    if end is None or end.rule is None:
        return ()
    if later is not None and later < end.age:
        return (Outcome(None, (number + 1,), 1, normalised(later - age)),)
    daughters = (found.stage(daughter) for daughter in found.ages.daughters(module))
    return (Outcome(end.rule.number, tuple(row for row in daughters if row is not None), 1, normalised(end.age - age)),)


MOST_PLACES, MOST_ARCS = 40, 400
"""A diagram with more states or arcs than this is grouped by symbol, to be legible."""
MOST_UNFOLDED = 400
"""A diagram that is not to be grouped may have so many states."""
MOST_LUMPED = 16
"""So is a diagram that leaves out parameters and still has more transitions than this."""


@dataclass(frozen=True)
class _Table:
    """Modules, what may become of each, the row of each module of a word, and how many transitions are legible."""

    states: States
    modules: Sequence[Module]
    outcomes: Sequence[tuple[Outcome, ...]]
    row: Callable[[Module], int | None]
    most: int = 10 * MOST_PLACES


def stages(
    system: LSystem | Timed,
    polarity: bool = False,
    durations: bool = False,
    unfold: bool | str | Collection[str] = False,
    **constants: object,
) -> Stages:
    """The stage diagram of a system.

    Parameters
    ----------
    system
        A system; or a timed one (see `timed`), whose transitions then say how long they take.
    polarity
        Whether cells that point left and right have places of their own.
    durations
        Whether transitions take the time for which a module lives, which may be many steps or part of one. A timed system's
        always do.
    unfold
        Whether each state has a place of its own, up to 400. By default more than 40 are grouped by symbol. Or a symbol, or
        several: their states have places of their own, and all modules of any other symbol share one.
    **constants
        New values for declared constants.

    Raises
    ------
    ModelNameError
        A symbol that is to be unfolded is never met.
    ModelValueError
        A value cannot be computed, the stages cannot be unfolded, a timed system is given new constants, or the productions of
        a system whose durations are asked for do not tell how long modules live.
    ModelLimitError
        The modules of a timed system are born at too many different ages.

    Examples
    --------
    >>> from lsys_kit import read, timed
    >>> stages(read("axiom: A(1)\\nA(t) : t < 3 -> A(t+1)\\nA(t) -> A(1) A(2)"))
    A(1) -> A(2)
    A(2) -> A(3)
    A(3) -> A(1) + A(2)
    >>> stages(read("axiom: F\\nF -> F [F] F : 0.65\\nF -> L : 0.35"), polarity=True)
    F -> 3 F + [ + ] with probability 0.65
    F -> L with probability 0.35
    >>> stages(read("axiom: A(0)\\nA(t) -> A(t+1) B(1)\\nB(t) : t < 3 -> B(t+1)"), unfold="B")
    A -> A + B(1)
    B(1) -> B(2)
    B(2) -> B(3)
    >>> stages(timed(read("axiom: a(0)\\na(2) -> a(0) b(0)\\nb(1) -> a(0)")))
    a(0) -> a(0) + b(0) after 2
    b(0) -> a(0) after 1
    """
    with Task("The stages were not found"):
        require(polarity, bool, 'True or False for "polarity"')
        require(durations, bool, 'True or False for "durations"')
        symbols = _symbols_from(unfold)
        most = MOST_UNFOLDED if unfold is True else MOST_PLACES
        if durations or isinstance(system, Timed):
            if symbols is not None:
                raise ModelValueError(
                    "Only all symbols of a timed net can be unfolded, because it is never grouped by symbol",
                    hint="Give unfold=True, or leave out the durations.",
                )
            return _timed_net(_ages_of(system, constants), polarity, most)
        states = States(system, constants)
        if symbols is not None:
            return unfolded_symbols(states, constants, symbols, MOST_UNFOLDED)
        for table in _tables(states, constants, 4 * most):
            net = _net(table, states, polarity)
            if len(net.places) <= most and (unfold or (len(net.transitions) <= table.most and len(net.arcs) <= MOST_ARCS)):
                return net
        if unfold:
            raise ModelValueError(
                "The stages of this system cannot be unfolded",
                hint=f"They are more than {MOST_UNFOLDED}, or the neighbours of a module decide what it becomes.",
            )
        return by_symbol(states)


def _ages_of(system: LSystem | Timed, constants: dict[str, object]) -> AgeModel:
    """At which ages the modules of a system are born, and how long they live."""
    if not isinstance(system, Timed):
        return age_model(States(system, constants))
    if constants:
        raise ModelValueError(
            "The constants of a timed system are chosen when it is made", hint="Write stages(timed(system, name=value))."
        )
    return system.ages


def _symbols_from(unfold: bool | str | Collection[str]) -> list[str] | None:
    """The symbols that are to be unfolded; None if that is all or none."""
    require(unfold, (bool, str, Collection), 'True, False, a symbol or several for "unfold"')
    if isinstance(unfold, bool):
        return None
    symbols = []
    for symbol in counted((unfold,) if isinstance(unfold, str) else unfold):
        require(symbol, str, 'A symbol for "unfold"')
        symbols.append(symbol)
    return symbols


def _timed_net(ages: AgeModel, polarity: bool, most: int) -> Stages:
    """The net whose transitions take as long as a stretch of life."""
    found = life_stages(ages, most) if polarity else life_stages(ages, most, partial(_appearance, ages.states))
    net = _net(_Table(ages.states, found.modules, found.outcomes, found.stage), ages.states, polarity)
    late = f"derived in steps of {number_text(ages.step or 1)}, lives shorter than that end late"
    besides = (late,) if found.is_late else ()
    return replace(net, besides=besides)


def _tables(states: States, constants: dict[str, object], limit: int) -> Iterator[_Table]:
    """The states of a system, then those without the parameters that decide nothing; each if they are within a limit."""
    for outcomes in _finite_outcomes(states, limit):
        yield _Table(states, states.modules, outcomes, {module: row for row, module in enumerate(states.modules)}.get)
    system, kept = states.system, deciding_positions(states.system)
    model = slice_system(system)
    if (model.axiom, model.productions, model.decomposition) == (system.axiom, system.productions, system.decomposition):
        return
    whole = tuple(rule for rule in system.interpretation if without_arguments(rule.predecessor, kept) == rule.predecessor)
    fewer = States(replace(model, interpretation=whole), constants)
    for outcomes in _finite_outcomes(fewer, limit):
        rows = {module: row for row, module in enumerate(fewer.modules)}
        yield _Table(fewer, fewer.modules, outcomes, lru_cache(4096)(partial(_row_without, rows, kept)), MOST_LUMPED)


def _finite_outcomes(states: States, limit: int) -> Iterator[list[tuple[Outcome, ...]]]:
    """The outcomes of all states, if these are no more than a limit and no neighbour decides."""
    with suppress(ModelValueError):  # some state has no successor; the sliced system may still have a diagram
        outcomes = all_outcomes(states, limit) if states.traits.s0l else None
        if outcomes is not None:
            yield outcomes


def _row_without(rows: Mapping[Module, int], kept: Set[ArgumentPosition], module: Module) -> int | None:
    return rows.get(without_arguments(module, kept))


def _net(table: _Table, states: States, polarity: bool) -> Stages:
    """The net whose places are classes of a table's rows."""
    classes = list(range(len(table.modules))) if polarity else _merged(table)
    members = [[row for row, found in enumerate(classes) if found == number] for number in range(max(classes, default=-1) + 1)]
    ways: dict[int, list[Way]] = {}
    for number, group in enumerate(members):
        ways[number] = []
        for together in _side_by_side(table, group, classes):
            outcome, rows = together[0], [spots_of(classes[row] for row in each.successor) for each in together]
            chance = None if outcome.chance == 1 else outcome.chance
            products = (
                Product(target, len(spots), tuple(spots) if all(row[target] == spots for row in rows) else ())
                for target, spots in rows[0].items()
            )
            ways[number].append(Way(Transition(number, outcome.production, "", chance, outcome.span), tuple(products)))
    places = [Place(table.modules[group[0]].symbol, tuple(table.modules[row] for row in group)) for group in members]
    return net_of(states, places, ways, partial(_place_of, classes, table.row))


def _place_of(classes: Sequence[int], row_of: Callable[[Module], int | None], module: Module) -> int | None:
    row = row_of(module)
    return None if row is None else classes[row]


def _side_by_side(table: _Table, group: Sequence[int], classes: Sequence[int]) -> Iterator[tuple[Outcome, ...]]:
    """The outcomes of the rows of one class, those together that lead to the same classes, in the order of the productions."""
    ways = zip(*(sorted(table.outcomes[row], key=lambda outcome: _likeness(outcome, classes)) for row in group), strict=True)
    return iter(sorted(ways, key=lambda way: way[0].production or 0))


def _merged(table: _Table) -> list[int]:
    """For each row its class: rows that look alike but for their polarity and become alike are one class.

    The coarsest partition that is finer than the looks and under which outcomes are alike, found by refinement.
    """
    classes = _class_numbers([_appearance(table.states, module) for module in table.modules])
    while True:
        finer = _class_numbers(
            [
                (classes[row], *sorted(_likeness(outcome, classes) for outcome in outcomes))
                for row, outcomes in enumerate(table.outcomes)
            ]
        )
        if finer == classes:
            return classes
        classes = finer


def _likeness(outcome: Outcome, classes: Sequence[int]) -> tuple[Value, Value, tuple[int, ...]]:
    span = -1 if outcome.span is None else outcome.span
    return outcome.chance, span, tuple(sorted(classes[row] for row in outcome.successor))


def _class_numbers(keys: Sequence[Hashable]) -> list[int]:
    """Equal keys get equal numbers, in the order of first occurrence."""
    numbers: dict[Hashable, int] = {}
    return [numbers.setdefault(key, len(numbers)) for key in keys]


def _appearance(states: States, module: Module) -> Hashable:
    """What a module looks like without its polarity: its cells' sizes and shades; itself, where it is no cell."""
    state = states.number(module.symbol, module.arguments)
    image = interpretations(states, (state,))[state]
    return tuple(cell.arguments for cell in image) if all(cell.symbol in CELLS for cell in image) else module
