"""Stage diagrams: the Petri net of a system (seed 002, figure 2; Peterson 1981).

Places are the states a module passes through, transitions the productions that take it from one to the next, tokens the
modules of a word. In an ordinary Petri net one transition fires at a time; here all tokens move in every step.

A place stands for one state. Cells that differ in their polarity only share a place, as in the paper, where tokens ignore
order and polarity: states that look the same but for the way they point, and whose successors do, are one place. Where
the states do not end, or cannot all be computed, a place stands for all modules of one symbol, and its transitions carry
what the productions ask for: contexts, conditions, probabilities.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass, field

from lsys_kit.derivation.interpret import images
from lsys_kit.derivation.rules import kind_of, rules_of
from lsys_kit.derivation.states import States, closure
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model import CELLS, LSystem, Module, Production, flat, joined

MOST_PLACES = 40
"""A diagram with more states than this is grouped by symbol: nobody reads it otherwise."""


@dataclass(frozen=True)
class Place:
    """A stage.

    Attributes
    ----------
    symbol
        The symbol of its modules; of the first one, where modules of both polarities share the place.
    modules
        The modules that it stands for; none in a net that is grouped by symbol.
    arity
        How many parameters its modules have.
    """

    symbol: str
    modules: tuple[Module, ...]
    arity: int

    def __str__(self) -> str:
        return str(self.modules[0]) if self.modules else self.symbol


@dataclass(frozen=True)
class Transition:
    """A production at work on a place.

    Attributes
    ----------
    place
        The number of the place whose tokens it takes.
    production
        The production's place in the order written, from 0.
    condition
        The production's condition where the net is grouped by symbol and there is one, else empty.
    """

    place: int
    production: int
    condition: str = ""


@dataclass(frozen=True)
class Arc:
    """What a transition puts into a place.

    Attributes
    ----------
    transition, place
        The numbers of its ends.
    copies
        How many tokens it puts there for each that it takes.
    positions
        Where in the successor they stand, from 1; none where that depends on the polarity.
    """

    transition: int
    place: int
    copies: int
    positions: tuple[int, ...] = ()


@dataclass(frozen=True)
class Stages:
    """The net of a system: places, transitions, and arcs from transitions to places.

    Each transition takes one token from its own place, so that arc is not listed.
    """

    system: LSystem
    places: tuple[Place, ...]
    transitions: tuple[Transition, ...]
    arcs: tuple[Arc, ...]
    grouped: bool = False
    _where: dict[Hashable, int] = field(default_factory=dict, compare=False, repr=False)

    def place_of(self, module: Module) -> int | None:
        """The number of the place where a module's token lies."""
        return self._where.get((module.symbol, len(module.arguments)) if self.grouped else module)

    def tokens(self, word: Iterable[Module]) -> tuple[int, ...]:
        """How many modules of a word lie in each place.

        >>> from lsys_kit.notation.read import read
        >>> stages(read("axiom: a\\na -> ab\\nb -> a")).tokens([Module("a"), Module("b"), Module("a")])
        (2, 1)
        """
        found = Counter(self.place_of(module) for module in word)
        return tuple(found[place] for place in range(len(self.places)))

    def fired(self, tokens: Sequence[int]) -> tuple[int, ...]:
        """The tokens after one step, in which all transitions fire at once.

        Raises
        ------
        ModelValueError
            The net is grouped by symbol: which transition fires depends on values that tokens do not have.

        Examples
        --------
        >>> from lsys_kit.notation.read import read
        >>> stages(read("axiom: a\\na -> ab\\nb -> a")).fired((2, 1))
        (3, 2)
        """
        if self.grouped:
            raise ModelValueError("The tokens of a net that is grouped by symbol cannot be moved without their values")
        moved = {transition.place for transition in self.transitions}
        after = [0 if place in moved else count for place, count in enumerate(tokens)]
        for arc in self.arcs:
            after[arc.place] += arc.copies * tokens[self.transitions[arc.transition].place]
        return tuple(after)

    def __repr__(self) -> str:
        parts = []
        for number, transition in enumerate(self.transitions):
            made = [f"{'' if arc.copies == 1 else f'{arc.copies} '}{self.places[arc.place]}"
                    for arc in self.arcs if arc.transition == number]
            condition = f" if {transition.condition}" if transition.condition else ""
            parts.append(f"{self.places[transition.place]} -> {' + '.join(made) or 'ε'}{condition}")
        return "\n".join(parts)


def stages(system: LSystem, polarity: bool = False, **constants: object) -> Stages:
    """The stage diagram of a system.

    Parameters
    ----------
    system
        A context-free system.
    polarity
        Whether cells that point left and right have places of their own.
    **constants
        New values for declared constants.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> stages(read("axiom: A(1)\\nA(t) : t < 3 -> A(t+1)\\nA(t) -> A(1) A(2)"))
    A(1) -> A(2)
    A(2) -> A(3)
    A(3) -> A(1) + A(2)
    """
    states = States(system, dict(constants))
    try:
        known = closure(states, 4 * MOST_PLACES) if states.settled else None
    except ModelValueError:  # a state further on has no successor; the earlier ones are worth a diagram
        known = None
    if known is None:
        return _by_symbol(system, states)
    classes = list(known) if polarity else _merged(states)
    return _by_symbol(system, states) if max(classes, default=0) >= MOST_PLACES else _by_state(states, classes)


def _by_state(states: States, classes: Sequence[int]) -> Stages:
    """The net whose places are classes of states."""
    members = [[s for s, found in enumerate(classes) if found == number] for number in range(max(classes, default=-1) + 1)]
    places = tuple(Place(states.modules[group[0]].symbol, tuple(states.modules[s] for s in group),
                         len(states.modules[group[0]].arguments)) for group in members)
    transitions: list[Transition] = []
    arcs: list[Arc] = []
    for number, group in enumerate(members):
        production = states.production(group[0])
        if production is None:
            continue
        rows = [[classes[s] for s in states.successor(state)] for state in group]
        for target, copies in Counter(rows[0]).items():
            spots = {tuple(i for i, place in enumerate(row, 1) if place == target) for row in rows}
            arcs.append(Arc(len(transitions), target, copies, spots.pop() if len(spots) == 1 else ()))
        transitions.append(Transition(number, production))
    where: dict[Hashable, int] = {module: number for number, place in enumerate(places) for module in place.modules}
    return Stages(states.system, places, tuple(transitions), tuple(arcs), False, where)


def _merged(states: States) -> list[int]:
    """For each state its class: states that look alike but for their polarity and become alike are one class.

    The coarsest partition that is finer than the looks and under which successors count alike, found by refinement.
    """
    looks = [_look(states, state) for state in range(len(states))]
    classes = _numbered(looks)
    while True:
        finer = _numbered([(classes[state], *sorted(classes[s] for s in states.successor(state)))
                           for state in range(len(states))])
        if finer == classes:
            return classes
        classes = finer


def _numbered(keys: Sequence[Hashable]) -> list[int]:
    """Equal keys get equal numbers, in the order of first occurrence."""
    numbers: dict[Hashable, int] = {}
    return [numbers.setdefault(key, len(numbers)) for key in keys]


def _look(states: States, state: int) -> Hashable:
    """What a state looks like without its polarity: its cells' sizes and shades; itself, where it is no cell."""
    module = states.modules[state]
    image = images(states, (state,))[state]
    return tuple(cell.arguments for cell in image) if all(cell.symbol in CELLS for cell in image) else module


def _by_symbol(system: LSystem, states: States) -> Stages:
    """The net whose places are symbols, and whose transitions carry conditions."""
    rules = rules_of(system)
    kinds = dict.fromkeys(map(kind_of, system.axiom))
    for production in (*system.productions, *system.decomposition):
        for module in (production.predecessor, *flat(production.successor)):
            kinds.setdefault(kind_of(module))
    where = {kind: number for number, kind in enumerate(kinds)}
    transitions: list[Transition] = []
    arcs: list[Arc] = []
    for kind, number in where.items():
        for rule in rules.get(kind, ()):
            made = [where[kind_of(module)] for module in flat(rule.production.successor)]
            for target, copies in Counter(made).items():
                arcs.append(Arc(len(transitions), target, copies, tuple(i for i, p in enumerate(made, 1) if p == target)))
            transitions.append(Transition(number, rule.number, _terms(rule.production)))
    places = tuple(Place(symbol, (), arity) for symbol, arity in kinds)
    return Stages(system, places, tuple(transitions), tuple(arcs), True, dict(where))


def _terms(production: Production) -> str:
    """What a production asks for besides its predecessor: contexts, condition, probability."""
    left = f"{joined(map(str, production.left))} <" if production.left else ""
    right = f"> {joined(map(str, production.right))}" if production.right else ""
    condition = str(production.condition) if production.condition is not None else ""
    chance = f"with {production.probability}" if production.probability is not None else ""
    return " ".join(filter(None, (left, right, condition, chance)))
