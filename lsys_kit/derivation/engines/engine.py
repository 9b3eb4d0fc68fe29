"""What every engine offers to a derivation, and what it checks before each step."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Protocol, TypeAlias

from lsys_kit.budget import check_budget, current
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.engines.expansion import code_type
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model.arithmetic import Value

STATE_BYTES = 600
"""About what one state takes in the table."""


class Observation(Protocol):
    """What an observer sees of a word."""

    @property
    def word(self) -> Word:
        """The word, with the values of its query modules filled in."""

    def sees(self, position: int, function: Value, *values: Value) -> Value:
        """What a sensitive function answers to the module at a position."""


Observer: TypeAlias = Callable[[Word], Observation]
"""Looks at a word before a step."""


@dataclass(frozen=True)
class Origins:
    """Where the modules of a word come from.

    Attributes
    ----------
    parents
        For each module the position, in the word before, of the module that it comes from; of several that were replaced
        together, of the first.
    productions
        For each module the place of the production that made it, or None where the module stayed as it was.
    sizes
        Where productions replace several modules together, for each module of the word before how many were replaced from its
        place on: 1, several, or 0 where it was replaced together with one before it. Else empty.
    """

    parents: Sequence[int]
    productions: Sequence[int | None]
    sizes: Sequence[int] = field(default=(), repr=False)


class Engine(Protocol):
    """Derives one system step by step: what is known of a step never changes."""

    @property
    def states(self) -> States:
        """The table of states."""

    @property
    def known(self) -> int:
        """The last step whose size is known."""

    def size(self, step: int) -> int:
        """How many modules a known step has."""

    def counts(self, step: int) -> Counter[int]:
        """How often each state occurs at a known step."""

    def advance(self) -> None:
        """Make one step more known."""

    def word(self, step: int) -> Word:
        """The word of a known step."""

    def origins(self, step: int) -> Origins:
        """Where the modules of a step's word come from."""

    def sight(self, step: int) -> Observation | None:
        """What the next step sees of a known step's word; None without an observer."""


def check_size(states: States, step: int, size: int, word: int | None = None, held: int = 0) -> None:
    """Refuse a step whose word would be past a limit.

    Parameters
    ----------
    states
        The table of states.
    step, size
        The step, and how many modules its word would have.
    word
        How many bytes the word takes, if it is no row of states.
    held
        How many bytes the words of other steps take, and what else is kept of them.
    """
    most = current()
    if size > most.modules:
        raise ModelLimitError(
            f"Step {step} would have {grouped(size)} modules; the limit is {grouped(most.modules)}",
            limit=most.modules,
            needed=size,
            hint="Take fewer steps, or set limits(modules=...).",
        )
    needed = (size * code_type(len(states)).itemsize if word is None else word) + len(states) * STATE_BYTES + held
    if needed > most.bytes:
        raise ModelLimitError(
            f"Step {step} would take {grouped(needed)} bytes; the limit is {grouped(most.bytes)}",
            limit=most.bytes,
            needed=needed,
            hint="Take fewer steps, or set limits(bytes=...).",
        )


def check_step(states: States, step: int, size: int = 0) -> None:
    """Refuse a step that takes too long, or meets too many different modules; `size` is how many it has so far."""
    check_size(states, step, size)
    check_budget()


def grouped(number: float) -> str:
    """A number with its digits in groups of three; a very long one as a power of ten."""
    text = f"{number:,}"
    return text if len(text) <= 40 else f"about 10^{len(str(int(number))) - 1}"
