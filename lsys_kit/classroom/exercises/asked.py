"""What a question asks of a system: from the words of its steps to a word, a number, a table, a net.

The right answer and the answers that misconceptions lead to are computed by the same functions; only the words differ.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import islice
from typing import Any, TypeAlias

from lsys_kit.classroom.catalogue import system as catalogued
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.growth.growth import growth
from lsys_kit.derivation.petri.stages import stages
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelValueError
from lsys_kit.geometry.drawing import number_of_strokes
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read
from lsys_kit.worlds.derive import derive


class Derived(Sequence[Sequence[Module]]):
    """The words of a system's steps, derived when the first of them is looked at; modules are counted without that."""

    def __init__(self, system: LSystem, steps: int) -> None:
        self.system, self.steps = system, steps

    def __len__(self) -> int:
        return self.steps + 1

    @cached_property
    def derivation(self) -> Derivation:
        """The derivation."""
        return derive(self.system, self.steps)

    def __getitem__(self, step: Any) -> Any:
        return self.derivation[step]

    def counted(self, symbol: str, steps: int) -> list[int]:
        """The number of modules, or of those with a symbol, at steps 0 to `steps`; none where words must be looked at."""
        with suppress(ModelValueError, ModelLimitError):
            found = growth(self.system)
            return found.counts_of(symbol, steps) if symbol else found.lengths(steps)
        return []


@dataclass(frozen=True)
class History:
    """The words of a system's steps, as they are or as somebody takes them to be.

    Attributes
    ----------
    system
        The system that is drawn, and whose stages are asked for.
    words
        The word of each step: a derivation, or rows of modules.
    offset
        Which step is taken for step 0: 1 if the count begins one step late, -1 if the axiom is counted as step 1.
    """

    system: LSystem
    words: Sequence[Sequence[Module]]
    offset: int = 0

    def word(self, step: int) -> tuple[Module, ...]:
        """The word that is taken for that of a step."""
        return tuple(self.words[max(step + self.offset, 0)])

    def values(self, exercise: Exercise, steps: int) -> list[int]:
        """The number that is asked for, at each of the steps 0 to `steps`."""
        last = max(steps + self.offset, 0)
        what, _, symbol = exercise.asks.partition(" ")
        symbol = symbol if what in ("count", "counts") else ""
        if what == "strokes":
            found = [number_of_strokes(written(self.system, word), 0) for word in islice(self.words, last + 1)]
        elif isinstance(self.words, Derived) and (counted := self.words.counted(symbol, last)):
            found = counted
        else:
            found = [sum(symbol in ("", module.symbol) for module in word) for word in islice(self.words, last + 1)]
        return found[:1] * -self.offset + found[max(self.offset, 0) :]


def asked_system(exercise: Exercise) -> LSystem:
    """The system that a question is about, with its constants set.

    >>> asked_system(Exercise("1", "", "word", "", "", "", (), system="J1")).axiom[0].symbol
    'ar'
    """
    return with_constants(system_of(exercise.system), exercise.constants)


@lru_cache(maxsize=128)
def system_of(text: str) -> LSystem:
    """The system that a text writes or names; it is read once, however many misconceptions ask for it."""
    return read(text) if ":" in text else catalogued(text)


def with_constants(system: LSystem, values: Mapping[str, Value]) -> LSystem:
    """A system with other values of its constants."""
    known = [constant.name for constant in system.constants]
    for name in values:
        if name not in known:
            raise ModelNameError(f'The system declares no constant "{name}"', hint=suggestion(name, known))
    return replace(
        system, constants=tuple(replace(c, value=Number(values[c.name])) if c.name in values else c for c in system.constants)
    )


def written(system: LSystem, word: Sequence[Module]) -> Derivation:
    """A word as the axiom of a system."""
    return derive(beginning_with(system, word), 0)


def beginning_with(system: LSystem, word: Sequence[Module]) -> LSystem:
    """A system with another axiom."""
    return replace(system, axiom=tuple(Pattern(module.symbol, tuple(map(Number, module.arguments))) for module in word))


def right_history(exercise: Exercise) -> History:
    """The words of the system that a question is about, one step more than it asks for."""
    system = asked_system(exercise)
    return History(system, Derived(system, last_step(exercise) + 1))


def last_step(exercise: Exercise) -> int:
    """The last step that a question asks for."""
    return max(exercise.at, default=exercise.steps)


def asked_steps(exercise: Exercise) -> Sequence[int]:
    """The steps that a table asks for."""
    return exercise.at or range(exercise.steps + 1)


def first_past(values: Iterator[int], bound: int) -> int | None:
    """The first step with a value greater than a bound."""
    return next((step for step, value in enumerate(values) if value > bound), None)


def _counts(exercise: Exercise, history: History) -> tuple[int, ...]:
    found = Counter(module.symbol for module in history.word(exercise.steps))
    return tuple(found[symbol] for symbol in exercise.symbols or sorted(found))


def _of_the_system(found: Callable[[LSystem], object]) -> Asked:
    """What is found of a system, and not of words that somebody has in mind."""
    return lambda _, history: None if history.offset or not isinstance(history.words, Derived) else found(history.system)


def _step_value(exercise: Exercise, history: History) -> int:
    return history.values(exercise, exercise.steps)[exercise.steps]


def _step_values(exercise: Exercise, history: History) -> tuple[int, ...]:
    values = history.values(exercise, last_step(exercise))
    return tuple(values[step] for step in asked_steps(exercise))


def _first_step(exercise: Exercise, history: History) -> int | None:
    return first_past(iter(history.values(exercise, exercise.steps)), bound_of(exercise))


def bound_of(exercise: Exercise) -> int:
    """The length that is to be passed, of a question for the first step past it."""
    return int(exercise.asks.rsplit(" ", 1)[1].replace(",", ""))


Asked: TypeAlias = Callable[[Exercise, History], object]
ASKED: Mapping[str, Asked] = {
    "word": lambda exercise, history: history.word(exercise.steps),
    "length": _step_value,
    "count": _step_value,
    "strokes": _step_value,
    "first": _first_step,
    "lengths": _step_values,
    "counts": lambda exercise, history: (_step_values if " " in exercise.asks else _counts)(exercise, history),
    "matrix": _of_the_system(lambda system: tuple(map(int, growth(system).matrix))),
    "stages": _of_the_system(stages),
    "words": lambda exercise, history: tuple(map(history.word, asked_steps(exercise))),
    "drawing": lambda exercise, history: written(history.system, history.word(exercise.steps)),
}
"""For the first word of `asks` what it asks of a history; None where that makes no sense."""
ASKED_OF_KIND: Mapping[str, tuple[str, ...]] = {
    "word": ("word",),
    "number": ("length", "count", "strokes", "first"),
    "table": ("lengths", "counts", "matrix"),
    "words": ("words",),
    "net": ("stages",),
    "drawing": ("drawing",),
}
"""What each kind may ask; a word, words, a net and a drawing need not say it."""
MORE_ASKED: Mapping[str, tuple[str, str]] = {
    "count": (r" \S+", "count a"),
    "counts": (r"( \S+)?", "counts a"),
    "first": (r" step past \d[\d,]{0,30}", "first step past 1000"),
}
"""For the first words of `asks` that more follows: its form, and an example."""


def is_asked_in_full(asks: str) -> bool:
    """Whether all that `asks` says can be understood.

    >>> is_asked_in_full("first step past 1,000"), is_asked_in_full("first step without a"), is_asked_in_full("length 3")
    (True, False, False)
    """
    what = asks.partition(" ")[0]
    return what in ASKED and re.fullmatch(re.escape(what) + MORE_ASKED.get(what, ("", ""))[0], asks) is not None


def what_is_asked(exercise: Exercise) -> str:
    """The first word of what is asked, or nothing where it is not computed."""
    if not exercise.system:
        return ""
    usual = ASKED_OF_KIND.get(exercise.kind, ())
    return exercise.asks.partition(" ")[0] or (usual[0] if len(usual) == 1 else "")


def is_derived(exercise: Exercise) -> bool:
    """Whether steps must be taken to find the answer; a drawing says so, since it may be that of a word that is asked for."""
    return bool(what_is_asked(exercise)) and (exercise.kind != "drawing" or exercise.asks == "drawing")


def answer_by(exercise: Exercise, history: History) -> object:
    """The answer to a question that somebody with these words in mind gives; None where there is none."""
    return ASKED[what_is_asked(exercise)](exercise, history)
