"""Limits: nothing that a person types may exhaust the machine.

Like `errors`, this is above all rooms, because every room has something to limit. Limits are set for a block of code:

>>> with limits(modules=1000):
...     current().modules
1000
>>> current().modules
5000000

Whatever the kit is asked to do is a task with one budget of time and memory, however many functions share the work: whoever
repeats, grows or nests something calls `check_budget` now and then. The time is that of the processor in this thread, so that
what else the machine does changes nothing.
"""

from __future__ import annotations

import sys
import time
import weakref
from collections.abc import Callable, Iterable, Iterator
from contextlib import ContextDecorator
from contextvars import ContextVar
from dataclasses import dataclass, replace
from inspect import CO_ASYNC_GENERATOR, CO_COROUTINE, CO_GENERATOR
from math import log10
from types import FrameType
from typing import Any, Generic, NamedTuple, TypeAlias, TypeVar

from lsys_kit.errors import ModelLimitError, ModelNameError, ModelValueError, shown

_T = TypeVar("_T")


@dataclass(frozen=True)
class Limits:
    """The limits in force, each with its unit."""

    modules: int = 5_000_000
    """modules of one word"""
    bytes: int = 512 * 2**20
    """bytes that a task or a derivation holds"""
    seconds: float = 10.0
    """seconds of the processor for a task"""
    states: int = 1_000
    """states of a stage diagram or growth matrix"""
    text: int = 1_000_000
    """characters of a model"""
    line: int = 50_000
    """characters of a line of a model, or of a word that is read"""
    rules: int = 1_000
    """productions of a model"""
    parameters: int = 16
    """parameters of a module"""
    name: int = 64
    """characters of a name"""
    expression: int = 2_000
    """characters of an expression"""
    depth: int = 50
    """nested operations of an expression"""
    bits: int = 4_096
    """bits of an exact number while it is computed"""
    exponent: int = 1_000
    """absolute value of an exact exponent"""
    repetitions: int = 100_000
    """how often a part of a successor is repeated, or decomposed, where the model says how often"""
    decomposition: int = 100
    """decompositions of what a decomposition made, where the model does not say how often"""
    interpretation: int = 500_000
    """modules that one module is drawn as"""
    brackets: int = 10_000
    """nested brackets of a word"""
    segments: int = 20_000
    """shapes of an SVG picture in a page, with the corners of polygons; beyond, a picture of pixels"""
    figure: int = 200_000
    """shapes of a saved SVG or PDF, or of a matplotlib figure"""
    triangles: int = 10_000_000
    """triangles of a mesh"""


DEFAULT = Limits()


class Block:
    """A `with` block, as who opened it knows it: whether it is still at work.

    An interrupt may fall between any two instructions of what opens and closes a block, also behind the first and before the
    last, where no `finally` sees it. So what a block sets is never believed for longer than its frame runs and its context
    manager lives. Of a generator, which rests between, and of a stack of contexts the frame is not known.
    """

    __slots__ = ("_frame", "_manager")

    def __init__(self, manager: object, frame: FrameType) -> None:
        rests = frame.f_code.co_flags & (CO_GENERATOR | CO_COROUTINE | CO_ASYNC_GENERATOR)
        self._manager = weakref.ref(manager)
        self._frame = None if rests or frame.f_globals.get("__name__") == "contextlib" else frame

    def belongs_to(self, manager: object) -> bool:
        """Whether a context manager has opened the block."""
        return self._manager() is manager

    def is_open(self) -> bool:
        """Whether the block has not been left, in whatever way."""
        return self._manager() is not None and (self._frame is None or _runs(self._frame))


def _runs(wanted: FrameType) -> bool:
    return _calls(wanted, sys._getframe(1)) or any(_calls(wanted, top) for top in sys._current_frames().values())


def _calls(wanted: FrameType, frame: FrameType | None) -> bool:
    """Whether a frame is another, or waits for it to return."""
    while frame is not None and frame is not wanted:
        frame = frame.f_back
    return frame is not None


class Setting(NamedTuple, Generic[_T]):
    """What a block sets, on top of what was set around it."""

    value: _T
    block: Block
    outer: Setting[_T] | None


Variable: TypeAlias = "ContextVar[Setting[_T] | None]"
"""What blocks set, the innermost last."""


def in_force(variable: Variable[_T]) -> Setting[_T] | None:
    """What is set by the innermost block that is open; what others have left behind is taken away."""
    first = found = variable.get()
    while found is not None and not found.block.is_open():
        found = found.outer
    if found is not first:
        variable.set(found)
    return found


def leave(variable: Variable[_T], manager: object) -> None:
    """Take away what the block of a context manager has set."""
    found = variable.get()
    while found is not None and not found.block.belongs_to(manager):
        found = found.outer
    if found is not None:
        variable.set(found.outer)


_limits: Variable[Limits] = ContextVar("limits", default=None)


def current() -> Limits:
    """The limits in force here."""
    found = in_force(_limits)
    return DEFAULT if found is None else found.value


class limits(ContextDecorator):  # noqa: N801 - used as a function is
    """Set limits for a `with` block.

    Parameters
    ----------
    **changes
        New values for any fields of `Limits`: `modules`, `bytes` and `seconds` above all.

    Raises
    ------
    ModelNameError
        A keyword is not a limit.
    ModelValueError
        A limit is not a positive number.
    """

    def __init__(self, **changes: float) -> None:
        for name, value in changes.items():
            if name not in Limits.__dataclass_fields__:
                known = ", ".join(Limits.__dataclass_fields__)
                raise ModelNameError(f'There is no limit called "{name}"', hint=f"Limits are: {known}.")
            if isinstance(value, bool) or not isinstance(value, (int, float)) or not value > 0:
                raise ModelValueError(f'The limit "{name}" must be a positive number, not {shown(value)}')
        self._changes: dict[str, Any] = changes

    def __repr__(self) -> str:
        return f"limits({', '.join(f'{name}={shown(value)}' for name, value in self._changes.items())})"

    def __enter__(self) -> Limits:
        outer = in_force(_limits)
        set_here = replace(outer.value if outer else DEFAULT, **self._changes)
        _limits.set(Setting(set_here, Block(self, sys._getframe(1)), outer))
        return set_here

    def __exit__(self, *_: object) -> None:
        leave(_limits, self)


BLOCK_BYTES = 64
"""About what an object of Python takes in memory, on average."""
SECONDS_BETWEEN_LOOKS = 0.02
"""A budget is looked at no more often than this, by the clock on the wall: the processor has not spent more."""
INTERVAL = 1_024
"""The budget is checked after so many things that take about a microsecond each."""
PACE = 4 if sys.platform == "emscripten" else 1
"""By so much limits of time for answers are longer in a browser, whose Python takes several times as long."""
processor_time = getattr(time, "thread_time", time.process_time)
"""Seconds of the processor in this thread; of the process where threads have no clocks of their own, as in WebAssembly."""
_objects = getattr(sys, "getallocatedblocks", int)


class Budget:
    """What is left for a task.

    Memory is measured by the number of all objects in it, so that it counts whatever is held, by whomever. Large arrays are not
    objects: who makes them knows their size beforehand, and asks `check_bytes`.
    """

    __slots__ = ("_clock", "_first_objects", "_look")

    def __init__(self) -> None:
        self._clock, self._first_objects = (0.0, processor_time()), -1
        """the seconds that were spent before, and when the clock was started"""
        self._look = time.monotonic() + min(current().seconds, SECONDS_BETWEEN_LOOKS)

    def wait(self) -> None:
        """Stop the clock."""
        self._clock = self._spent(), 0.0

    def go_on(self) -> None:
        """Let the clock go on. Where an interrupt kept it from being stopped, what has passed since is not counted."""
        self._clock = self._clock[0], processor_time()

    def _spent(self) -> float:
        before, started = self._clock
        return before + processor_time() - started

    def is_due(self) -> bool:
        """Whether it is time to look at what is left."""
        return time.monotonic() >= self._look

    def check(self, failed: Callable[[], str]) -> None:
        """Refuse to go on where the time or the memory is used up; say then what has failed."""
        most = current()
        if self._spent() > most.seconds:
            raise ModelLimitError(
                f"{failed()} in {most.seconds:g} seconds",
                limit=most.seconds,
                hint="Take fewer steps, or set limits(seconds=...).",
            )
        if self._first_objects < 0:
            self._first_objects = _objects()
        check_bytes((_objects() - self._first_objects) * BLOCK_BYTES, failed)
        self._look = time.monotonic() + SECONDS_BETWEEN_LOOKS  # not before: what is used up is refused again, at once


_task: Variable[tuple[Budget, Callable[[], str]]] = ContextVar("task", default=None)


class Task:
    """A task, for a `with` block; one within another shares its budget.

    It can be taken up again where there is more to do; what passes in between is not counted.

    failed
        What to say if the budget does not suffice, as in "Step 5 was not reached", or a function that knows.

    >>> with limits(seconds=0.01), Task("The sum was not found"):
    ...     sum(counted(range(10**9)))
    Traceback (most recent call last):
    lsys_kit.errors.ModelLimitError: The sum was not found in 0.01 seconds. Take fewer steps, or set limits(seconds=...).
    """

    __slots__ = ("__weakref__", "_failed", "_own")

    def __init__(self, failed: Callable[[], str] | str = "This was not finished") -> None:
        self._failed = (lambda: failed) if isinstance(failed, str) else failed
        self._own: Budget | None = None

    def __enter__(self) -> None:
        outer = in_force(_task)
        shared = outer.value[0] if outer else None
        if self._own is None:
            self._own = None if shared else Budget()
        elif self._own is not shared:
            self._own.go_on()
        _task.set(Setting((self._own or shared, self._failed), Block(self, sys._getframe(1)), outer))  # type: ignore[arg-type]

    def __exit__(self, *_: object) -> None:
        leave(_task, self)
        outer = _task.get()
        if self._own is not None and not (outer and outer.value[0] is self._own):
            self._own.wait()


def in_task() -> bool:
    """Whether there is a task at present, and so a budget."""
    return in_force(_task) is not None


def check_budget() -> None:
    """Refuse to go on where the budget of the present task is used up.

    Raises
    ------
    ModelLimitError
        The task has taken too long, or holds too much.
    """
    if (first := _task.get()) is not None and first.value[0].is_due() and (now := in_force(_task)) is not None:
        budget, failed = now.value
        budget.check(failed)


def check_bytes(needed: int, failed: Callable[[], str]) -> None:
    """Refuse what would take too much memory; say then what has failed.

    >>> check_bytes(10**9, lambda: "The word was not built")
    Traceback (most recent call last):
    lsys_kit.errors.ModelLimitError: The word was not built: it would take 1,000,000,000 bytes; the limit is 536,870,912. \
Take fewer steps, or set limits(bytes=...).
    """
    check_limit("bytes", needed, lambda: f"{failed()}: it would take {_written(needed)} bytes")


def check_limit(name: str, needed: int, said: Callable[[], str]) -> None:
    """Refuse what would be past one of the limits; say then how much it would be."""
    most = getattr(current(), name)
    if needed > most:
        hint = f"Take fewer steps, or set limits({name}=...)."
        raise ModelLimitError(f"{said()}; the limit is {_written(most)}", limit=most, needed=needed, hint=hint)


def check_step(step: int, size: int, parts: str, bytes_each: int) -> None:
    """Refuse a step that would have more parts, or take more memory, than the limits allow.

    >>> check_step(30, 10**8, "walls", 420)
    Traceback (most recent call last):
    lsys_kit.errors.ModelLimitError: Step 30 would have 100,000,000 walls or more; the limit is 5,000,000. \
Take fewer steps, or set limits(modules=...).
    """
    check_limit("modules", size, lambda: f"Step {step} would have {size:,} {parts} or more")
    check_limit("bytes", needed := size * bytes_each, lambda: f"Step {step} would take about {needed:,} bytes")


def _written(size: float) -> str:
    """A size with its digits, or about how large it is.

    >>> _written(1234567), _written(10**5000)
    ('1,234,567', 'about 10^5000')
    """
    return f"{size:,}" if size < 10**30 else f"about 10^{round((int(size).bit_length() - 1) * log10(2))}"


def counted(things: Iterable[_T], interval: int = INTERVAL) -> Iterator[_T]:
    """The same things one after another, with a look at the budget after every few of them."""
    for number, thing in enumerate(things, 1):
        yield thing
        if number % interval == 0:
            check_budget()
