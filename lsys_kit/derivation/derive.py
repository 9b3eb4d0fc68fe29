"""Derivation: from the axiom to the word of any step.

A `Derivation` asks its engine for one step after another, within the limits of size and time, and keeps the steps that fit.
Which engine derives a system follows from the system's traits, and from nothing else: each engine serves the systems that ask
for no more than the traits in its row of the table. The first that serves a system is the fastest for it. Those further down
serve it as well, and must give the same words: the laws in the tests compare them. Columns are no matter of traits alone: an
engine goes over to them when it sees that most modules are different.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from operator import index as place
from types import MappingProxyType
from typing import Any, TypeAlias, overload

from lsys_kit.budget import Task, check_budget, counted
from lsys_kit.derivation.core.letters import conditions_text, letters_from, with_letters
from lsys_kit.derivation.core.states import States, check_d0l
from lsys_kit.derivation.core.traits import ANY, COLUMNS, D0L, S0L, Traits
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.engines.columnar import ColumnarSteps
from lsys_kit.derivation.engines.contexts import ContextEngine
from lsys_kit.derivation.engines.counting import CountingEngine, next_counts
from lsys_kit.derivation.engines.engine import Engine, Observation, Observer, Origins, check_size
from lsys_kit.derivation.engines.stepping import SteppingEngine
from lsys_kit.derivation.engines.stepwise import Stepper
from lsys_kit.derivation.tissues.development import AnyDevelopment, CellworkDevelopment, Development, develop
from lsys_kit.errors import ModelLimitError, ModelValueError, last_reached, require, shown, whole_number
from lsys_kit.notation.model.cells import CellSystem, CellworkSystem, MapSystem
from lsys_kit.notation.model.system import LSystem

ENGINES: Mapping[type, Traits] = MappingProxyType(
    {CountingEngine: D0L, ContextEngine: S0L._replace(context=1, meta=True), Stepper: ANY, ColumnarSteps: COLUMNS}
)
"""The most that a system may have to be derived by counting, by arrays, and module by module; and to go over to columns, where
new states keep coming. What stays module by module: productions that replace several modules together or name branches, what
asks the turtle, cuts, meta-rules, decomposition by chance, and unknown constants."""


def serves(engine: type, traits: Traits) -> bool:
    """Whether an engine can derive systems with some traits.

    >>> serves(CountingEngine, Traits(decomposition=True)), serves(CountingEngine, Traits(stochastic=True))
    (True, False)
    """
    return traits.within(ENGINES[engine])


def engine_for(states: States, seed: int, world: Observer | None = None) -> Engine:
    """The engine that derives a system; where it asks what the turtle sees, in a world that answers."""
    traits = states.traits
    if serves(CountingEngine, traits):
        return CountingEngine(states, serves(ColumnarSteps, traits))
    stepper = Stepper(states, seed)
    arrays = ContextEngine(stepper) if serves(ContextEngine, traits) else None
    return SteppingEngine(stepper, arrays, world if traits.sensitive else None, serves(ColumnarSteps, traits))


Choices: TypeAlias = Mapping[str, Any]
"""What a person chooses, by the names of the arguments."""
_Refusal: TypeAlias = ModelLimitError | ModelValueError
"""Why a step is not made."""


@overload
def derive(
    system: LSystem,
    steps: int,
    *,
    seed: int | None = None,
    arithmetic: str = "exact",
    letters: str | Collection[str] = (),
    **constants: object,
) -> Derivation: ...
@overload
def derive(system: MapSystem, steps: int) -> Development: ...
@overload
def derive(system: CellworkSystem, steps: int) -> CellworkDevelopment: ...
def derive(system: LSystem | CellSystem, steps: int, **choices: Any) -> Derivation | AnyDevelopment:
    """Derive a system by its words alone; `lsys_kit.derive` does the same and also answers what modules ask of the turtle.

    >>> from lsys_kit import read
    >>> fibonacci = read("axiom: a\\na -> ab\\nb -> a")
    >>> [str(word) for word in derive(fibonacci, 3)]
    ['a', 'a b', 'a b a', 'a b a a b']
    """
    if not isinstance(system, CellSystem):
        return derive_observed(system, steps, None, **choices)
    if choices:
        raise ModelValueError(
            f'A {system.notation} system has no "{next(iter(choices))}"', hint="It has neither chance nor declared constants."
        )
    return develop(system, steps)


def derive_observed(
    system: LSystem,
    steps: int,
    world: Observer | None,
    /,
    *,
    seed: int | None = None,
    arithmetic: str = "exact",
    letters: str | Collection[str] = (),
    **constants: object,
) -> Derivation:
    """Derive an L-system; if its modules ask what the turtle sees, an observer looks at each word before the next step."""
    require(system, LSystem, "An L-system or a map system")
    seed = (system.seed or 0) if seed is None else seed
    if isinstance(seed, bool) or not isinstance(seed, int):
        raise ModelValueError(f"The seed must be a whole number, not {shown(seed)}")
    named = letters_from(system, letters)
    if named:
        constants = with_letters(system, named, constants, arithmetic)
    return Derivation(engine_for(States(system, constants, arithmetic), seed, world)).to(steps)


class Derivation(Sequence[Word]):
    """The words of a derivation, each built when it is first asked for and then kept.

    Attributes
    ----------
    states
        The table of the states met.
    steps
        The last step.
    """

    def __init__(self, engine: Engine, steps: int = 0) -> None:
        self.steps, self._engine = steps, engine
        self.states = engine.states

    def to(self, steps: int) -> Derivation:
        """The same derivation up to another step; known steps are not computed again."""
        last, reached = whole_number(steps, "The number of steps"), 0
        try:
            with Task(lambda: f"Step {reached} was not reached"):
                for reached in range(last + 1):
                    self._reach(reached)
        except (ModelLimitError, ModelValueError) as error:
            raise self._refusal(error, reached) from error.__cause__
        return Derivation(self._engine, last)

    def _reach(self, step: int) -> None:
        """Make the next step known; a known one is still refused where it is past a limit."""
        if step > self._engine.known:
            self._engine.advance()
        else:
            check_size(self.states, step, self._engine.size(step))

    def _refusal(self, error: _Refusal, step: int) -> _Refusal:
        error.partial = Derivation(self._engine, step - 1) if step else None
        return error.with_hint(f"{last_reached(step)} {error.hint or ''}".strip())

    def __len__(self) -> int:
        return self.steps + 1

    @overload
    def __getitem__(self, index: int) -> Word: ...
    @overload
    def __getitem__(self, index: slice) -> list[Word]: ...
    def __getitem__(self, index: int | slice) -> Word | list[Word]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        step = place(index)
        step += len(self) if step < 0 else 0
        if not 0 <= step <= self.steps:
            raise IndexError(f"step {shown(index)} of a derivation of {self.steps} steps")
        return self._engine.word(step)

    def __iter__(self) -> Iterator[Word]:
        return (self[step] for step in range(len(self)))

    def __repr__(self) -> str:
        return self.column()

    @property
    def lengths(self) -> list[int]:
        """The number of modules at each step, known without building a word."""
        with Task("The lengths were not found"):
            return [self._engine.size(step) for step in counted(range(len(self)))]

    @property
    def notes(self) -> tuple[str, ...]:
        """Remarks: names that were read as several symbols, values that are no longer exact, conditions under which formulas
        hold.

        >>> from lsys_kit import read
        >>> derive(read("axiom: F(0)\\nF(x) -> F(x^2 + 0.1)"), 8).notes
        ('From step 7 on values outgrow 128 bits and are doubles, such as F(0.11270011762177155).',)
        """
        notes, inexact = self.states.system.notes, self.states.inexact
        with Task("The remarks were not found"):
            if held := conditions_text(self.states):
                notes = (*notes, held)
            for step in range(len(self) if inexact else 0):
                if any(self.states.modules[state] == inexact for state in counted(self._engine.counts(step))):
                    return (*notes, f"From step {step} on values outgrow 128 bits and are doubles, such as {inexact}.")
        return notes

    def counts(self, step: int) -> Counter[int]:
        """How often each state occurs at a step, known without building its word."""
        return self._engine.counts(self._reached(step))

    def _reached(self, step: int) -> int:
        found = whole_number(step, "The step")
        if found > self.steps:
            raise ModelValueError(f"A derivation of {self.steps} steps has no step {shown(step)}")
        return found

    def origins(self, step: int) -> Origins:
        """Where the modules of a step's word come from: which module of the previous word, and which production.

        >>> from lsys_kit import read
        >>> derive(read("axiom: a\\na -> ab\\nb -> a"), 2).origins(2)
        Origins(parents=[0, 0, 1], productions=[0, 0, 1])
        """
        step = self._reached(step)
        if step == 0:
            raise ModelValueError(f"Only the words of steps 1 to {self.steps} have a previous word, not that of step {step}")
        with Task(f"The origins of step {step} were not found"):
            return self._engine.origins(step)

    def sight(self, step: int) -> Observation | None:
        """What the next step sees of a step's word, with its query modules filled in; None in a system that asks nothing.

        >>> from lsys_kit import derive, read
        >>> apex = derive(read("axiom: F A ?P(0,0)\\nA > ?P(x,y) : y < 3 -> F A"), 2)
        >>> print(apex[2], "and", apex.sight(2).word)
        F F F A?P(0,2) and F F F A?P(0,3)
        """
        return self._engine.sight(self._reached(step))

    def ancestors(self, step: int, before: int = 0) -> list[int]:
        """For each module of a step's word the position of its ancestor in the word of an earlier step.

        >>> from lsys_kit import read
        >>> derive(read("axiom: b a\\na -> ab\\nb -> a"), 3).ancestors(3)
        [0, 0, 0, 1, 1, 1, 1, 1]
        """
        step, before = self._reached(step), self._reached(before)
        if before > step:
            raise ModelValueError(f"Step {before} is not before step {step} of a derivation of {self.steps} steps")
        with Task(f"The ancestors of step {step} were not found"):
            positions = list(range(len(self[before])))
            for later in range(before + 1, step + 1):
                positions = [positions[parent] for parent in counted(self.origins(later).parents)]
            return positions

    def column(self, centred: bool = False, coding: Mapping[str, str] | None = None) -> Column:
        """The words below one another, as `ColumnForm` shows them in Jacob, Modeling Growth with L-Systems & Mathematica.

        Parameters
        ----------
        centred
            Whether the words are centred.
        coding
            What is written in place of some modules (see `Word.coded`).

        Examples
        --------
        >>> from lsys_kit import read
        >>> derive(read("axiom: a\\na -> ab\\nb -> a"), 3).column(centred=True)
        0     a
        1    a b
        2   a b a
        3 a b a a b
        """
        require(centred, bool, 'True or False for "centred"')
        with Task("The column was not written"):
            texts = [repr(word) if coding is None else word.coded(coding) for word in counted(self, 1)]
        width = max(map(len, texts)) if centred else 0
        digits = len(str(self.steps))
        return Column("\n".join(f"{step:>{digits}} {text.center(width)}".rstrip() for step, text in enumerate(texts)))


class Column(str):
    """Lines of text that a notebook shows without quotation marks."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def lengths(system: LSystem, steps: int, *, arithmetic: str = "exact", **constants: object) -> Iterator[int]:
    """The number of modules at steps 0 to `steps`, however large, without building a word.

    >>> from lsys_kit import read
    >>> len(str(list(lengths(read("axiom: a\\na -> ab\\nb -> a"), 10_000))[-1]))
    2090
    """
    states, counting = States(system, constants, arithmetic), Task()
    check_d0l(states, "The number of modules of a step that is not derived")
    counts: Mapping[int, int] = Counter(states.axiom)
    yield sum(counts.values())
    for step in range(1, steps + 1):
        with counting, Task(f"Step {step} was not reached"):
            counts = next_counts(states, counts)
            check_budget()
        yield sum(counts.values())
