"""Petri nets with the tokens of a word (Peterson 1981; Prusinkiewicz, Introduction to Modeling with L-systems, figure 2).

Places are the states a module passes through, transitions the productions that take it from one to the next, tokens the
modules of a word. In an ordinary Petri net one transition fires at a time; here all tokens move in every step. Where several
transitions leave a place each token takes one of them, and how likely which one is stands at the transitions.

What may become of a state in one step is an outcome: one, where a module alone decides that; where chance decides which
production rewrites it, one for each of them. All outcomes of all states together are a system's net.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from numbers import Real

from lsys_kit.budget import Task, check_budget, counted
from lsys_kit.derivation.core.chance import Chance, choose, shares
from lsys_kit.derivation.core.states import UNKNOWN, States, rule_error
from lsys_kit.derivation.core.words import Word, state_counts
from lsys_kit.errors import ModelValueError, every, require, whole_number
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem


@dataclass(frozen=True)
class Outcome:
    """What may become of a state: the place of the production in the order written, from 0 (None where a module only grows
    older), the states that replace it, how likely that is, and how long it takes (None: a step)."""

    production: int | None
    successor: tuple[int, ...]
    chance: Value = 1
    span: Value | None = None


def outcomes_of(states: States, state: int) -> tuple[Outcome, ...]:
    """What may become of a state of a system without contexts; nothing where no production matches.

    >>> from lsys_kit import read
    >>> for outcome in outcomes_of(States(read("axiom: F\\nF -> F F : 0.33\\nF -> F : 0.66")), 0):
    ...     print(outcome.production, outcome.successor, outcome.chance)
    0 (0, 0) 1/3
    1 (0,) 2/3
    """
    module = states.modules[state]
    matched = states.matching_rules(module, states.rules)
    if not matched or matched[0][0].probability is None:
        return tuple(Outcome(rule.number, states.replacement(rule, module)) for rule, _ in matched)
    lots = [(rule, weight) for rule, weight in states.weighted(matched) if weight != 0]
    try:
        likely = shares([weight for _, weight in lots] or [0])
    except ValueError as fault:
        raise rule_error(states.system, module, matched[0][0], fault) from None
    except TypeError:
        raise rule_error(states.system, module, matched[0][0], ValueError(UNKNOWN)) from None
    return tuple(
        Outcome(rule.number, states.replacement(rule, module), chance) for (rule, _), chance in zip(lots, likely, strict=True)
    )


def all_outcomes(states: States, limit: int) -> list[tuple[Outcome, ...]] | None:
    """The outcomes of all states that may be met from the axiom on; None where they are more than `limit`."""
    found: list[tuple[Outcome, ...]] = []
    while len(found) < len(states):
        if len(states) > limit:
            return None
        check_budget()
        found.append(outcomes_of(states, len(found)))
    return found


@dataclass(frozen=True)
class Place:
    """A stage.

    Attributes
    ----------
    symbol
        The symbol of its modules; of the first one, where modules of both polarities share the place.
    modules
        The modules that it stands for; none in a net that is grouped by symbol.
    """

    symbol: str
    modules: tuple[Module, ...]

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
        The production's place in the order written, from 0; None where a module only grows older. Where it takes no time, or
        a time of its own, the place among the decomposition rules, if these say so.
    condition
        What the production asks for where the net is grouped by symbol: contexts and condition as they are written, else empty.
    chance
        How likely a token takes this way; None where there is no choice, or where its probability varies.
    span
        How long a token stays; None where that is a step.
    at_once
        Whether it takes no time, as decomposition.
    """

    place: int
    production: int | None
    condition: str = ""
    chance: Value | None = None
    span: Value | None = None
    at_once: bool = False


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
        Where in the successor they stand, from 1; none where that depends on the polarity or on a value.
    factor
        What the copies are multiplied with, as it is written, where that depends on a value; else empty.
    """

    transition: int
    place: int
    copies: int
    positions: tuple[int, ...] = ()
    factor: str = ""


@dataclass(frozen=True)
class Stages:
    """The net of a system: places, transitions, and arcs from transitions to places.

    Each transition takes one token from its own place, so that arc is not listed.

    Attributes
    ----------
    start
        How many modules of the axiom lie in each place.
    grouped
        Whether a place stands for all modules of a symbol, and what they become depends on values that tokens do not have.
    besides
        What else the system does that no transition shows, in words.
    """

    system: LSystem
    places: tuple[Place, ...]
    transitions: tuple[Transition, ...]
    arcs: tuple[Arc, ...]
    start: tuple[int, ...]
    grouped: bool = False
    besides: tuple[str, ...] = ()
    _where: Callable[[Module], int | None] = field(default=lambda _: None, compare=False, repr=False)

    def place_of(self, module: Module) -> int | None:
        """The number of the place where a module's token lies."""
        require(module, Module, "A module")
        return self._where(module)

    def tokens(self, word: Iterable[Module]) -> tuple[int, ...]:
        """How many modules of a word lie in each place.

        >>> from lsys_kit import read, stages
        >>> stages(read("axiom: a\\na -> ab\\nb -> a")).tokens([Module("a"), Module("b"), Module("a")])
        (2, 1)
        """
        require(word, Iterable, "A word")
        found: Counter[int | None] = Counter()
        counts = (
            ((word.states.modules[state], count) for state, count in state_counts(word).items())
            if isinstance(word, Word)
            else ((module, 1) for module in word)
        )
        for module, count in counts:
            require(module, Module, "A word of modules")
            found[self.place_of(module)] += count
        return tuple(found[place] for place in range(len(self.places)))

    def in_places(self, tokens: Sequence[Value]) -> Sequence[Value]:
        """Numbers of tokens, one for each place."""
        require(tokens, Sequence, "A row of numbers of tokens")
        if len(tokens) != len(self.places):
            raise ModelValueError(f"The net has {len(self.places)} places; {len(tokens)} numbers of tokens do not fit it")
        return tokens

    def fired(self, tokens: Sequence[int], chance: Chance | None = None) -> tuple[int, ...]:
        """The tokens after one step, in which every token moves.

        Parameters
        ----------
        tokens
            How many lie in each place before.
        chance
            The random numbers by which each token takes one of several ways.

        Raises
        ------
        ModelValueError
            What a token does depends on values that it does not have, on time, or on a chance that is not given.

        Examples
        --------
        >>> from lsys_kit import read, stages
        >>> stages(read("axiom: a\\na -> ab\\nb -> a")).fired((2, 1))
        (3, 2)
        >>> net = stages(read("axiom: A\\nA -> A A : 1/2\\nA -> ε : 1/2"))
        >>> [net.fired((100,), Chance(seed, 0, 0))[0] for seed in range(4)]
        [94, 104, 92, 104]
        """
        self._check_moving()
        given = [whole_number(each, "A number of tokens") for each in self.in_places(tokens)]
        return tuple(map(int, self._moved(given, self._firings(given, chance))))

    def expected(self, steps: int, tokens: Sequence[Value] | None = None) -> tuple[Value, ...]:
        """How many tokens are expected in each place after some steps: the mean over all that chance may do, exactly.

        Parameters
        ----------
        steps
            How many steps.
        tokens
            How many lie in each place before; by default those of the axiom.

        Raises
        ------
        ModelValueError
            What a token does depends on values that it does not have, or on time.

        Examples
        --------
        >>> from lsys_kit import read, stages
        >>> stages(read("axiom: F\\nF -> F F F : 2\\nF -> F : 1")).expected(2)
        (Fraction(49, 9),)
        """
        last = whole_number(steps, "The number of steps")
        self._check_moving()
        found = tuple(self.start if tokens is None else self.in_places(tokens))
        every(found, Real, "A number of tokens")
        with Task("The tokens that are expected were not found"):
            for _ in counted(range(last), 1):
                found = self._moved(
                    found, [found[way.place] * (1 if way.chance is None else way.chance) for way in self.transitions]
                )
        return found

    def _firings(self, tokens: Sequence[int], chance: Chance | None) -> list[int]:
        """How often each transition fires in a step, each token taking one of its ways at random."""
        found = [tokens[transition.place] for transition in self.transitions]
        ways: dict[int, list[int]] = {}
        for number, transition in enumerate(self.transitions):
            if transition.chance is not None:
                ways.setdefault(transition.place, []).append(number)
        for place, numbers in ways.items():
            if chance is None:
                raise ModelValueError(
                    f"Which transition takes a token of {self.places[place]} is decided by chance",
                    hint="Ask for expected(steps), or choose at random with fired(tokens, Chance(1, 0, 0)).",
                )
            weights = [self.transitions[number].chance or 0 for number in numbers]
            drawn = Counter(choose(weights, chance.unit()) for _ in range(tokens[place]))
            for index, number in enumerate(numbers):
                found[number] = drawn[index]
        return found

    def _moved(self, tokens: Sequence[Value], times: Sequence[Value]) -> tuple[Value, ...]:
        """The tokens after each transition has fired so many times and emptied its place."""
        left = {transition.place for transition in self.transitions}
        after = [0 if place in left else count for place, count in enumerate(tokens)]
        for arc in self.arcs:
            after[arc.place] += arc.copies * times[arc.transition]
        return tuple(map(normalised, after))

    def _check_moving(self) -> None:
        """Refuse to move tokens where it is not known when they move, or to which place."""
        if self.grouped:
            raise ModelValueError("The tokens of a net that is grouped by symbol cannot be moved without their values")
        if any(transition.span is not None for transition in self.transitions):
            raise ModelValueError(
                "The tokens of a timed net move each at its own time, not in steps",
                hint="timed(system).word(t) gives the word at any time, and tokens(word) its tokens.",
            )

    def __repr__(self) -> str:
        return "\n".join(
            [*(self.line(number) for number in range(len(self.transitions))), *(f"besides: {text}" for text in self.besides)]
        )

    def line(self, number: int) -> str:
        """A transition in one line: what it makes of what, and on which terms."""
        if whole_number(number, "The number of a transition") >= len(self.transitions):
            raise ModelValueError(
                f"There are {len(self.transitions)} transitions, and none has the number {number}",
                hint="They are counted from 0.",
            )
        transition = self.transitions[number]
        made = [f"{_times(arc)}{self.places[arc.place]}" for arc in self.arcs if arc.transition == number]
        return " ".join([f"{self.places[transition.place]} -> {' + '.join(made) or 'ε'}", *_terms(transition)])


def _times(arc: Arc) -> str:
    """How many copies an arc makes, with a blank behind; nothing where it is one."""
    return "".join(f"{part} " for part in ("" if arc.copies == 1 else str(arc.copies), arc.factor) if part)


def _terms(transition: Transition) -> Iterator[str]:
    if transition.at_once:
        yield "at once"
    if transition.chance is not None:
        yield f"with probability {likelihood(transition.chance)}"
    if transition.span is not None:
        yield f"after {number_text(transition.span)}"
    if transition.condition:
        yield f"if {transition.condition}"


def likelihood(chance: Value) -> str:
    """A probability as text: exact where it is, else to four digits.

    >>> from fractions import Fraction
    >>> likelihood(Fraction(13, 20)), likelihood(Fraction(1, 3)), likelihood(1 / 3)
    ('0.65', '1/3', '0.3333')
    """
    return f"{chance:.4g}" if isinstance(chance, float) else number_text(chance)
