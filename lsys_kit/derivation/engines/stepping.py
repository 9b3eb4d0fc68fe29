"""Stepping: the engine of systems in which neighbours, chance or what the turtle sees have a say.

Every step needs the whole word before it. All its modules are replaced at once by arrays, where that is possible, else one by
one; then meta-rules shorten the word, until none applies (Kurth, lecture slides, on sessile organisms). Where rules ask what
the turtle sees, an observer looks at the word before each step; which one is not known here.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import cached_property, lru_cache, partial

from lsys_kit.arrays import arrays_pay
from lsys_kit.budget import INTERVAL, check_budget
from lsys_kit.derivation.core.rules import ModuleKind, Rule, Values, kind_of, rule_for
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word, state_counts
from lsys_kit.derivation.engines.columnar import ColumnarSteps, ColumnWord
from lsys_kit.derivation.engines.contexts import ContextEngine
from lsys_kit.derivation.engines.engine import (
    Observation,
    Observer,
    Origins,
    check_size,
    check_step,
    compact,
    many_new,
    repeated,
)
from lsys_kit.derivation.engines.kept import KeptStep, KeptSteps
from lsys_kit.derivation.engines.stepwise import SensingFunction, Stepper
from lsys_kit.notation.model.system import LSystem, Production


@lru_cache(maxsize=64)
def meta_rules(system: LSystem, arithmetic: str) -> tuple[tuple[tuple[ModuleKind, ...], Rule], ...]:
    """The meta-rules of a system: the kinds of the modules that each replaces, and the rule that replaces them.

    All modules but the last are treated like the left context of a production.
    """
    found = []
    for number, meta in enumerate(system.meta):
        *before, last = meta.predecessors
        production = Production((last,), meta.successor, meta.condition, left=tuple(before), at=meta.at)
        found.append((tuple(map(kind_of, meta.predecessors)), rule_for(system, number, production, arithmetic)))
    return tuple(found)


def apply_meta_rules(states: States, codes: Sequence[int]) -> tuple[list[int], list[int]]:
    """A word after its meta-rules, and for each module of it the position of the first module that it stands for.

    >>> from lsys_kit import read
    >>> states = States(read("axiom: f(1) f(2) f(3) A\\nmeta: f(x) f(y) -> f(x+y)"))
    >>> codes, origins = apply_meta_rules(states, states.axiom)
    >>> [str(states.modules[code]) for code in codes], origins
    (['f(6)', 'A'], [0, 3])
    """
    rules = meta_rules(states.system, states.arithmetic)
    done: list[int] = []
    origins: list[int] = []
    for position, code in enumerate(codes):
        todo = [code]
        while todo:
            done.append(todo.pop())
            origins.append(position)
            made = _applied(states, rules, done)
            if made is not None:
                size, successor = made
                position_of_first = origins[-size]
                del done[-size:], origins[-size:]
                todo += reversed(successor)
                position = position_of_first
    return done, origins


def _applied(
    states: States, rules: Sequence[tuple[tuple[ModuleKind, ...], Rule]], done: Sequence[int]
) -> tuple[int, tuple[int, ...]] | None:
    """How many of the last modules the first matching meta-rule takes, and what it makes of them."""
    for kinds, rule in rules:
        last = [states.modules[code] for code in done[-len(kinds) :]]
        if tuple(map(kind_of, last)) != kinds:
            continue
        values: Values = tuple(value for module in last for value in module.arguments)
        if states.matches(rule, values, last[-1]):
            return len(kinds), states.applied_states(rule, last[-1], values)
    return None


ORIGIN_BYTES = 16
"""About what is kept for each module, to know where those come from that replace it."""
FEW_NEW, STATES_OF_A_MODULE, STATES_AT_LEAST = 4, 4, 1_000
"""Words also become columns after a step in which more new states than these are met, if the table has several times as many
states as the word has modules, and is no small one."""
STEPS_BETWEEN_LOOKS = 64
"""After so many steps a word in columns is looked at, whether numbering its states pays again."""
MOST_FAILED = 2
"""After more steps than these that failed in columns, no other is tried."""


class SteppingEngine:
    """The derivation of a system step by step, by arrays where these are given, in a world if it asks what the turtle sees."""

    def __init__(
        self, stepper: Stepper, arrays: ContextEngine | None, world: Observer | None = None, columnar: bool = False
    ) -> None:
        states = stepper.states
        self.states, self._world, self._stepper, self._arrays, self._columnar = states, world, stepper, arrays, columnar
        self._new = len(states)  # so many states were met first at the last step
        self._failed = 0  # so many steps failed in columns
        self._seen: frozenset[object] = frozenset()
        self._steps = KeptSteps(self._made_again if columnar else None)
        self._steps.add(Word(states, list(states.axiom)), lambda: Origins((), ()))

    def __reduce__(self) -> tuple[object, ...]:
        """The words and their origins, without what was computed on the way: functions and tables are made again."""
        steps = [(step.size, step.word, step.origins and step.origins()) for step in self._steps]
        return _resumed, (self.states, self._stepper.seed, self._arrays is not None, self._world, self._columnar, steps)

    @property
    def known(self) -> int:
        return len(self._steps) - 1

    def size(self, step: int) -> int:
        return self._steps[step].size

    def counts(self, step: int) -> Counter[int]:
        return state_counts(self.word(step))

    def advance(self) -> None:
        step, before, sees = self.known + 1, self.word(self.known), None
        if self._world:
            sight = self._world(before)
            before, sees = sight.word, sight.sees
        word, origins = self._made(before, step, sees)
        check_budget()
        self._steps.add(word, origins, len(before) * ORIGIN_BYTES if origins else 0)

    def _made_again(self, before: Word, step: int) -> Word:
        return self._made(before, step, None)[0]

    def _made(self, before: Word, step: int, sees: SensingFunction | None) -> tuple[Word, Callable[[], Origins] | None]:
        """The next word, and its origins, unless they are found by columns."""
        if self._in_columns(before):
            with suppress(ArithmeticError):
                word = self._columns.after(before, step, self._steps.bytes)
                self._stepper.forget()
                return word, None
            self._failed += 1
        met = len(self.states)
        made = self._by_arrays(self._arrays, before, step) if self._arrays else self._one_by_one(before.numbers(), step, sees)
        self._new = len(self.states) - met
        return self._shortened(*made) if self.states.system.meta else made

    def _in_columns(self, before: Word) -> bool:
        """Whether the word after another is made in columns: many modules are different, and columns have seldom failed."""
        if not self._columnar or self._failed > MOST_FAILED:
            return False
        if not isinstance(before, ColumnWord):
            return many_new(self._new, len(before)) or self._keep_coming(len(before))
        return self.known % STEPS_BETWEEN_LOOKS > 0 or not self._repeats(before)

    def _keep_coming(self, size: int) -> bool:
        """Whether new states have come for long: the table has many more of them than a word has modules."""
        met = len(self.states)
        return self._new > FEW_NEW and met > STATES_OF_A_MODULE * size and arrays_pay(met, STATES_AT_LEAST)

    def _repeats(self, word: ColumnWord) -> bool:
        """Whether few modules of a word in columns differ, and half of them were there when a word was last looked at."""
        seen, self._seen = self._seen, word.different()
        return 0 < len(self._seen) <= 2 * len(self._seen & seen)

    @cached_property
    def _columns(self) -> ColumnarSteps:
        return ColumnarSteps(self.states, self._stepper.seed)

    def _by_arrays(self, arrays: ContextEngine, before: Word, step: int) -> tuple[Word, Callable[[], Origins]]:
        """The next word and its origins, all modules at once."""
        chosen = arrays.chosen(before.codes, step - 1)
        check_size(self.states, step, arrays.outcomes.size(chosen), held=self._steps.bytes)
        word = Word(self.states, arrays.outcomes.replaced(chosen))
        return word, lambda: arrays.outcomes.origins(chosen)

    def _one_by_one(self, codes: Sequence[int], step: int, sees: SensingFunction | None) -> tuple[Word, Callable[[], Origins]]:
        """The next word and its origins, module by module."""
        sizes, productions, replaced, word = list[int](), list[int | None](), list[int](), list[int]()
        for number, replacement in enumerate(self._stepper.replacements(codes, step - 1, sees)):
            sizes.append(len(replacement.states))
            productions.append(replacement.production)
            replaced.append(replacement.size)
            word += replacement.states
            if number % INTERVAL == 0 or sizes[-1] > INTERVAL:
                check_step(self.states, step, len(word))
        check_size(self.states, step, len(word), held=self._steps.bytes)

        def origins() -> Origins:
            return Origins(
                repeated(range(len(sizes)), sizes),
                repeated(productions, sizes),
                replaced if self.states.traits.predecessor > 1 else (),
            )

        return self._word(word), origins

    def _shortened(self, word: Word, origins: Callable[[], Origins]) -> tuple[Word, Callable[[], Origins]]:
        """A word after its meta-rules, with its origins."""
        short, first = apply_meta_rules(self.states, word.numbers())

        def after() -> Origins:
            old = origins()
            return Origins([old.parents[at] for at in first], [old.productions[at] for at in first], old.sizes)

        return self._word(short), after

    def _word(self, codes: list[int]) -> Word:
        return Word(self.states, compact(codes, len(self.states)))

    def word(self, step: int) -> Word:
        return self._steps.word(step)

    def origins(self, step: int) -> Origins:
        origins = self._steps[step].origins
        if origins is not None:
            return origins()
        before = self.word(step - 1)
        return self._columns.origins(before if isinstance(before, ColumnWord) else self._columns.word(before), step)

    def sight(self, step: int) -> Observation | None:
        return self._world(self.word(step)) if self._world else None


def _resumed(
    states: States,
    seed: int,
    by_arrays: bool,
    world: Observer | None,
    columnar: bool,
    steps: Sequence[tuple[int, Word | None, Origins | None]],
) -> SteppingEngine:
    stepper = Stepper(states, seed)
    engine = SteppingEngine(stepper, ContextEngine(stepper) if by_arrays else None, world, columnar)
    engine._steps[:] = [KeptStep(size, word, partial(_same, origins) if origins else None) for size, word, origins in steps]
    engine._steps.bytes = sum(word.bytes for _, word, _ in steps if word)
    return engine


def _same(origins: Origins) -> Origins:
    return origins
