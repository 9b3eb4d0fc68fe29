"""Other libraries at work, which never look at the budget, under the budget of the present task."""

from __future__ import annotations

import signal
import sys
import threading
from contextlib import suppress
from contextvars import ContextVar, copy_context
from itertools import tee
from types import FrameType
from typing import Any

from lsys_kit.budget import SECONDS_BETWEEN_LOOKS, Block, Setting, Variable, check_budget, in_force, in_task, leave
from lsys_kit.errors import ModelLimitError

CALLS_BETWEEN_CHECKS = 500
"""The budget is checked after so many calls of functions that know nothing of budgets."""


class _UsedUp(BaseException):
    """The budget is used up; no library takes this for an error of its own."""

    def __init__(self, error: ModelLimitError) -> None:
        super().__init__()
        self.error = error


class supervised:  # noqa: N801 - used as a function is
    """A `with` block in which another library works, which never looks at the budget.

    In the main thread a timer looks, between two instructions of Python, and costs next to nothing. In other threads, which get
    no signals, and where there is no such timer or others use it, a hook looks that Python calls whenever a function is called,
    and which makes sympy some five times as slow.

    The limits and the task are those of this block. A task of the kit's own within it may have less time, looks for itself, and
    its refusal can be caught there.

    It works in the same thread, since a process of its own would not do everywhere: where one starts, it runs the person's
    program again, unless that is written for it, and in a browser there are none.

    What is used up is refused where a function is called. An error may be swallowed there, as in a finalizer, or by the garbage
    collector; then it is raised again, but not so soon that what is put in order on the way out is disturbed. Of the one that
    was swallowed nothing is printed.
    """

    def __enter__(self) -> None:
        frame = sys._getframe(1)
        self._hooks = _Hooks(frame) if in_task() else None
        self._timed = self._hooks is not None and _has_timer()
        if self._hooks is not None and self._timed:
            _timed.set(Setting(self._hooks, Block(self, frame), in_force(_timed)))
            _start_timer()
        elif self._hooks is not None:
            self._hooks.put_in()

    def __exit__(self, _: object, error: BaseException | None, __: object) -> None:
        if self._hooks is not None:
            self._hooks.take_away()
        if self._timed:
            leave(_timed, self)
            if _timed.get() is None:
                _stop_timer()
        if isinstance(error, _UsedUp):
            raise error.error from None


class _Hooks:
    """The hooks with which a block that is supervised looks at the budget, or refuses what is used up. They go when its frame
    ends, also where an interrupt keeps the block from taking them away, and when there is no task any more."""

    __slots__ = ("_around", "_frame", "_left", "_others")

    def __init__(self, frame: FrameType) -> None:
        self._around, self._frame, self._left = copy_context(), frame, CALLS_BETWEEN_CHECKS
        self._others: tuple[Any, Any, Any] | None = None
        """the hooks that were there before, once these are put in"""

    def put_in(self) -> None:
        """Look at the budget from now on."""
        self._others = sys.getprofile(), sys.gettrace(), sys.unraisablehook
        sys.setprofile(self._look)
        sys.unraisablehook = self._report_others

    def take_away(self) -> None:
        """Put back what was there before; that which takes the others away comes last."""
        if self._others is None:
            return
        profiler, tracer, report = self._others
        if sys.gettrace() == self._go_on:
            sys.settrace(tracer)
        if sys.unraisablehook == self._report_others:
            sys.unraisablehook = report
        if sys.getprofile() in (self._look, None):  # Python takes away one that raises
            _resume(profiler)

    def put_in_if_used_up(self) -> None:
        """Refuse at the next call, if the budget is used up: a signal is handled between any two instructions, where an error
        could not be borne, as at the end of a `finally`."""
        if self._others is None and self._refusal() is not None:
            self._left = 0
            self.put_in()

    def _look(self, frame: FrameType, event: str, _: object) -> None:
        if event == "return" and frame is self._frame:
            _take_away_of(frame)
        if event not in ("call", "c_call"):
            return
        self._left -= 1
        if self._left < 0:
            self._left = CALLS_BETWEEN_CHECKS
            if not in_task():
                self.take_away()
            elif (error := self._refusal()) is not None and not _must_go_on(frame):
                sys.settrace(self._go_on)
                raise _UsedUp(error)

    def _refusal(self) -> ModelLimitError | None:
        try:
            self._around.run(check_budget)
        except ModelLimitError as error:
            return error
        return None

    def _go_on(self, _: FrameType, __: str, ___: object) -> None:
        """Put the hook back, at the next call: Python takes away one that raises."""
        sys.settrace(self._others[1] if self._others else None)
        sys.setprofile(self._look)

    def _report_others(self, swallowed: sys.UnraisableHookArgs) -> None:
        if self._others and not isinstance(swallowed.exc_value, _UsedUp):
            self._others[2](swallowed)


def _take_away_of(frame: FrameType) -> None:
    """Take away the hooks of the blocks of a frame that ends; one that was left properly has taken away its own."""
    while isinstance(found := getattr(sys.getprofile(), "__self__", None), _Hooks) and found._frame is frame:
        found.take_away()


_timed: Variable[_Hooks] = ContextVar("timed", default=None)
"""The blocks at which the timer looks: their hooks are put in when the budget is used up."""


def _has_timer() -> bool:
    """Whether a timer can look here; the handler of its signal stays, so that one that comes late does no harm."""
    if not hasattr(signal, "setitimer") or sys.platform in ("emscripten", "wasi"):
        return False
    if threading.current_thread() is not threading.main_thread() or _are_signals_passed_on():
        return False
    if signal.getsignal(signal.SIGVTALRM) is signal.SIG_DFL:
        signal.signal(signal.SIGVTALRM, _at_signal)
        signal.siginterrupt(signal.SIGVTALRM, False)  # what another library reads or writes is not broken off
    return signal.getsignal(signal.SIGVTALRM) is _at_signal


def _are_signals_passed_on() -> bool:
    """Whether all signals are written to a loop of events, as asyncio's that handles some: they would fill its queue while it
    waits. It can only be asked for by another being set; in one instruction, so that no interrupt keeps it from coming back."""
    first, again = tee(map(signal.set_wakeup_fd, (-1,)))
    with suppress(OSError, ValueError):  # it is closed
        next(map(signal.set_wakeup_fd, first))
    return next(again) != -1


def _start_timer() -> None:
    """Let it go on, if it runs: it would never come to its end where many short blocks are within one."""
    if not signal.getitimer(signal.ITIMER_VIRTUAL)[1]:
        signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS_BETWEEN_LOOKS, SECONDS_BETWEEN_LOOKS)


def _stop_timer() -> None:
    signal.setitimer(signal.ITIMER_VIRTUAL, 0)


def _at_signal(_: int, frame: FrameType | None) -> None:
    """Look at the budget; without a block that is open, as where an interrupt kept one from being left, never again. While it
    is looked at already, that is done in another context, in which no block is open."""
    if _is_looking(frame):
        return
    found = in_force(_timed)
    if found is None or not in_task():
        _stop_timer()
    else:
        found.value.put_in_if_used_up()


def _is_looking(frame: FrameType | None) -> bool:
    """Whether a signal comes while the budget is looked at."""
    while frame is not None and frame.f_code is not _Hooks._refusal.__code__:
        frame = frame.f_back
    return frame is not None


def _resume(profiler: object) -> None:
    """Let the profiler go on that was at work before; one written in C, as `cProfile` is, is no function that could be set."""
    sys.setprofile(profiler if callable(profiler) else None)
    if hasattr(profiler, "enable"):
        profiler.enable()


def _must_go_on(frame: FrameType | None) -> bool:
    """Whether a module is being imported, which could never be used if it were given up half-way, or a block is being left."""
    while frame is not None:
        if frame.f_code is supervised.__exit__.__code__ or frame.f_code.co_filename.startswith("<frozen importlib"):
            return True
        frame = frame.f_back
    return False
