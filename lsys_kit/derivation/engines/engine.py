"""What every engine offers to a derivation, what it checks before each step, and how rows of states become words.

Expansion builds the word of a step without the words of earlier steps. The length of what a state becomes in k steps is known
beforehand, so each piece has its place in one array. What a state becomes in k steps is written where it is first needed, and
every later occurrence is a copy of that stretch.
"""

from __future__ import annotations

from array import array
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import chain, repeat
from typing import TYPE_CHECKING, Protocol, TypeAlias, TypeVar

from lsys_kit.arrays import arrays_pay, np
from lsys_kit.budget import check_budget, check_limit, counted
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Codes, Word
from lsys_kit.notation.model.arithmetic import Value

if TYPE_CHECKING:
    from numpy.typing import NDArray

_T = TypeVar("_T")
BYTES = 256
MOST_LISTED = 4_096
"""Words up to this length are lists, which are quicker than arrays at that size."""
MODULES_BETWEEN_CHECKS = 2**16
"""The budget is checked after so many modules that are written one by one or copied."""
STEPS_BETWEEN_CHECKS = 10
"""The budget is checked after so many steps of a few thousand states at most."""
PIECE = 64
"""Pieces up to this length, at least 1, are assembled first and written at once."""


@lru_cache(maxsize=1_024)
def code_type(states: int) -> str:
    """The code of the smallest unsigned type that can number so many states.

    >>> code_type(256), code_type(257)
    ('B', 'H')
    """
    return next(code for code in "BHIQ" if states <= 256 ** array(code).itemsize)


def compact(codes: list[int], states: int) -> Codes:
    """A word of a table of so many states: a list where it is short, else an array of the smallest type."""
    return codes if len(codes) <= MOST_LISTED else array(code_type(states), codes)


def repeated(things: Iterable[_T], times: Iterable[int]) -> list[_T]:
    """Each thing as often as is said.

    >>> repeated("abc", (2, 0, 1))
    ['a', 'a', 'c']
    """
    return list(chain.from_iterable(map(repeat, things, times)))


class ByteTable:
    """Rows of states by number, where both fit into bytes: a string of numbers is replaced by `bytes.translate` and `replace`.

    Attributes
    ----------
    known
        The numbers whose rows are in the table.

    Notes
    -----
    A number whose row has one state is translated. One whose row has several states, or none, is translated into a byte that
    stands for no state, and that byte is replaced by the row: so what is put in is never replaced itself. For words of 3,000
    and of a million modules this takes a quarter to a twentieth of the time of any way through arrays of places.

    Examples
    --------
    >>> from lsys_kit import read
    >>> states = States(read("axiom: a\\na -> ab\\nb -> a"))
    >>> table = ByteTable(states)
    >>> [table.add(state, states.successor(state)) for state in (0, 1)]
    [True, True]
    >>> table.replaced(bytes([0, 1, 0])).tolist()
    [0, 1, 0, 0, 1]
    """

    def __init__(self, states: States) -> None:
        self.states = states
        self.known: set[int] = set()
        self._table = bytearray(range(BYTES))
        self._several: list[tuple[bytes, bytes]] = []

    def add(self, number: int, row: Sequence[int]) -> bool:
        """Put the row of a number into the table; False where bytes run out."""
        if number in self.known:
            return True
        free = BYTES - 1 - len(self._several)
        if number >= BYTES or free < len(self.states):
            return False
        if len(row) != 1:
            self._several.append((bytes((free,)), bytes(row)))
        self._table[number] = row[0] if len(row) == 1 else free
        self.known.add(number)
        return True

    def replaced(self, word: bytes) -> array[int]:
        """The rows of some numbers, one after another."""
        word = word.translate(self._table)
        for free, row in self._several:
            word = word.replace(free, row)
        return array("B", word)


def expand(states: States, present: Sequence[Collection[int]]) -> array[int] | NDArray[np.integer]:
    """The word of the last step, as an array of states."""
    sizes = _sizes(states, present)
    pieces = _pieces(states, present, sizes)
    length, kind = sum(sizes[0][state] for state in states.axiom), code_type(len(states))
    whole = np.empty(length, kind) if arrays_pay(length, MOST_LISTED) else array(kind, (0,)) * length
    word = memoryview(whole)  # type: ignore[arg-type]
    written: dict[tuple[int, int], int] = {}
    todo = [(state, 0) for state in reversed(states.axiom)]
    at = look = 0
    while todo:
        state, step = todo.pop()
        if at >= look:
            check_budget()
            look = at + MODULES_BETWEEN_CHECKS
        size = sizes[step][state]
        if size <= PIECE:
            word[at : at + size] = pieces[step][state]
        elif (state, step) in written:
            start = written[state, step]
            word[at : at + size] = word[start : start + size]
        else:
            written[state, step] = at
            todo += [(successor, step + 1) for successor in reversed(states.successor(state))]
            continue
        at += size
    return whole


def _sizes(states: States, present: Sequence[Collection[int]]) -> list[dict[int, int]]:
    """For each step and state the length of what the state becomes by the last step."""
    sizes = [dict.fromkeys(present[-1], 1)]
    for here in counted(reversed(present[:-1]), STEPS_BETWEEN_CHECKS):
        after = sizes[-1]
        sizes.append({state: sum(after[s] for s in states.successor(state)) for state in here})
    return sizes[::-1]


def _pieces(states: States, present: Sequence[Collection[int]], sizes: Sequence[dict[int, int]]) -> list[dict[int, array[int]]]:
    """For each step and state whose size is small, what the state becomes by the last step."""
    kind = code_type(len(states))
    pieces = [{state: array(kind, (state,)) for state in present[-1]}]
    for step in counted(range(len(present) - 2, -1, -1), STEPS_BETWEEN_CHECKS):
        after = pieces[-1]
        pieces.append(
            {
                state: array(kind, [code for s in states.successor(state) for code in after[s]])
                for state in present[step]
                if sizes[step][state] <= PIECE
            }
        )
    return pieces[::-1]


FEWEST_NEW = 50
"""Words become columns after a step in which more new states than this are met, and they are no small part of its word."""
SMALL_PART = 1 / 8
"""A new state takes about eight times as long in the table as a module of columns takes to be numbered afterwards."""


def many_new(new: int, size: int) -> bool:
    """Whether so many modules of a word were met for the first time in it that columns pay.

    They are not most of it where the turtle turns at each of them: brackets and turns are the same, or stay.
    """
    return new > SMALL_PART * size and arrays_pay(new, FEWEST_NEW)


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

    states
        The table of states.
    step, size
        The step, and how many modules its word would have.
    word
        How many bytes the word takes, if it is no row of states.
    held
        How many bytes the words of other steps take, and what else is kept of them.
    """
    check_limit("modules", size, lambda: f"Step {step} would have {grouped(size)} modules")
    needed = (size * array(code_type(len(states))).itemsize if word is None else word) + len(states) * STATE_BYTES + held
    check_limit("bytes", needed, lambda: f"Step {step} would take {grouped(needed)} bytes")


def check_step(states: States, step: int, size: int = 0) -> None:
    """Refuse a step that takes too long, or meets too many different modules; `size` is how many it has so far."""
    check_size(states, step, size)
    check_budget()


def grouped(number: float) -> str:
    """A number with its digits in groups of three; a very long one as a power of ten."""
    text = f"{number:,}"
    return text if len(text) <= 40 else f"about 10^{len(str(int(number))) - 1}"
