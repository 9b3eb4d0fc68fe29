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
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, replace
from math import log10
from typing import TypeVar

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
    """shapes of an SVG picture, with the corners of polygons; beyond, a picture of pixels"""
    figure: int = 200_000
    """shapes of a PDF or of a matplotlib figure"""
    triangles: int = 10_000_000
    """triangles of a mesh"""


DEFAULT = Limits()
"""The limits where none are set."""
_current: ContextVar[Limits] = ContextVar("limits", default=DEFAULT)


def current() -> Limits:
    """The limits in force here."""
    return _current.get()


@contextmanager
def limits(**changes: float) -> Iterator[Limits]:
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
    for name, value in changes.items():
        if name not in Limits.__dataclass_fields__:
            known = ", ".join(Limits.__dataclass_fields__)
            raise ModelNameError(f'There is no limit called "{name}"', hint=f"Limits are: {known}.")
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not value > 0:
            raise ModelValueError(f'The limit "{name}" must be a positive number, not {shown(value)}')
    before = current()
    try:  # the limits change within: an interrupt just behind the change puts them back as well
        _current.set(replace(before, **changes))  # type: ignore[arg-type]
        yield current()
    finally:
        _current.set(before)


BLOCK_BYTES = 64
"""About what an object of Python takes in memory, on average."""
SECONDS_BETWEEN_LOOKS = 0.02
"""A budget is looked at no more often than this, by the clock on the wall: the processor has not spent more."""
INTERVAL = 1_024
"""The budget is checked after so many things that take about a microsecond each."""
_processor_time = getattr(time, "thread_time", time.process_time)
_objects = getattr(sys, "getallocatedblocks", int)


class Budget:
    """What is left for a task.

    Memory is measured by the number of all objects in it, so that it counts whatever is held, by whomever. Large arrays are not
    objects: who makes them knows their size beforehand, and asks `check_bytes`.
    """

    __slots__ = ("_first_objects", "_look", "_start")

    def __init__(self) -> None:
        self._start, self._first_objects = _processor_time(), -1
        self._look = time.monotonic() + min(current().seconds, SECONDS_BETWEEN_LOOKS)

    def wait(self) -> None:
        """Stop the clock."""
        self._start -= _processor_time()

    def go_on(self) -> None:
        """Let the clock go on."""
        self._start += _processor_time()

    def check(self, failed: Callable[[], str]) -> None:
        """Refuse to go on where the time or the memory is used up; say then what has failed."""
        if (now := time.monotonic()) < self._look:
            return
        most = current()
        if _processor_time() - self._start > most.seconds:
            raise ModelLimitError(f"{failed()} in {most.seconds:g} seconds", limit=most.seconds,
                                  hint="Take fewer steps, or set limits(seconds=...).")
        if self._first_objects < 0:
            self._first_objects = _objects()
        check_bytes((_objects() - self._first_objects) * BLOCK_BYTES, failed)
        self._look = now + SECONDS_BETWEEN_LOOKS  # not before: what is used up is refused again, at once


_task: ContextVar[tuple[Budget, Callable[[], str]] | None] = ContextVar("task", default=None)


class Task:
    """A task, for a `with` block; one within another shares its budget.

    It can be taken up again where there is more to do; what passes in between is not counted.

    Parameters
    ----------
    failed
        What to say if the budget does not suffice, as in "Step 5 was not reached", or a function that knows.

    Examples
    --------
    >>> with limits(seconds=0.01), Task("The sum was not found"):
    ...     sum(counted(range(10**9)))
    Traceback (most recent call last):
    lsys_kit.errors.ModelLimitError: The sum was not found in 0.01 seconds. Take fewer steps, or set limits(seconds=...).
    """

    __slots__ = ("_failed", "_own", "_token")

    def __init__(self, failed: Callable[[], str] | str = "This was not finished") -> None:
        self._failed = (lambda: failed) if isinstance(failed, str) else failed
        self._own: Budget | None = None

    def __enter__(self) -> None:
        outer = _task.get()
        if self._own is not None:
            self._own.go_on()
        elif outer is None:
            self._own = Budget()
        self._token = _task.set((self._own or outer[0], self._failed))  # type: ignore[index]

    def __exit__(self, *_: object) -> None:
        _task.reset(self._token)
        if self._own is not None:
            self._own.wait()


def in_task() -> bool:
    """Whether there is a task at present, and so a budget."""
    return _task.get() is not None


def check_budget() -> None:
    """Refuse to go on where the budget of the present task is used up.

    Raises
    ------
    ModelLimitError
        The task has taken too long, or holds too much.
    """
    if (now := _task.get()) is not None:
        now[0].check(now[1])


def check_bytes(needed: int, failed: Callable[[], str]) -> None:
    """Refuse what would take too much memory; say then what has failed.

    >>> check_bytes(10**9, lambda: "The word was not built")
    Traceback (most recent call last):
    lsys_kit.errors.ModelLimitError: The word was not built: it would take 1,000,000,000 bytes; the limit is 536,870,912. \
Take fewer steps, or set limits(bytes=...).
    """
    most = current().bytes
    if needed > most:
        raise ModelLimitError(f"{failed()}: it would take {_written(needed)} bytes; the limit is {most:,}", limit=most,
                              needed=needed, hint="Take fewer steps, or set limits(bytes=...).")


def check_step(step: int, size: int, parts: str, bytes_each: int) -> None:
    """Refuse a step that would have more parts, or take more memory, than the limits allow.

    >>> check_step(30, 10**8, "walls", 420)
    Traceback (most recent call last):
    lsys_kit.errors.ModelLimitError: Step 30 would have 100,000,000 walls or more; the limit is 5,000,000. \
Take fewer steps, or set limits(modules=...).
    """
    most = current()
    if size > most.modules:
        raise ModelLimitError(f"Step {step} would have {size:,} {parts} or more; the limit is {most.modules:,}",
                              limit=most.modules, needed=size, hint="Take fewer steps, or set limits(modules=...).")
    if (needed := size * bytes_each) > most.bytes:
        raise ModelLimitError(f"Step {step} would take about {needed:,} bytes; the limit is {most.bytes:,}",
                              limit=most.bytes, needed=needed, hint="Take fewer steps, or set limits(bytes=...).")


def _written(size: int) -> str:
    """A size with its digits, or about how large it is.

    >>> _written(1234567), _written(10**5000)
    ('1,234,567', 'about 10^5000')
    """
    return f"{size:,}" if size < 10**30 else f"about 10^{round((size.bit_length() - 1) * log10(2))}"


def counted(things: Iterable[_T], interval: int = INTERVAL) -> Iterator[_T]:
    """The same things one after another, with a look at the budget after every few of them."""
    for number, thing in enumerate(things, 1):
        yield thing
        if number % interval == 0:
            check_budget()
