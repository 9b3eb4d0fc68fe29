"""Other libraries at work, which never look at the budget, under the budget of the present task."""

from __future__ import annotations

import sys
from contextvars import copy_context
from types import FrameType

from lsys_kit.budget import check_budget, in_task
from lsys_kit.errors import ModelLimitError

CALLS_BETWEEN_CHECKS = 500
"""The budget is checked after so many calls of functions that know nothing of budgets."""


class _UsedUp(BaseException):
    """The budget is used up; no library takes this for an error of its own."""

    def __init__(self, error: ModelLimitError) -> None:
        super().__init__()
        self.error = error


class supervised:  # noqa: N801 - used as a function is
    """A `with` block in which another library works, which never looks at the budget: it is looked at whenever a function is
    called there.

    The limits and the task are those of this block. A task of the kit's own within it may have less time, looks for itself, and
    its refusal can be caught there.

    It works in the same thread, since a process of its own would not do everywhere: where one starts, it runs the person's
    program again, unless that is written for it, and in a browser there are none.

    An error may be swallowed there, as in a finalizer, or by the garbage collector; then it is raised again, but not so soon
    that what is put in order on the way out is disturbed. Nothing is printed of the one that was swallowed.
    """

    def __enter__(self) -> None:
        self._hooks = _Hooks(sys._getframe(1)) if in_task() else None
        if self._hooks is not None:
            self._hooks.put_in()

    def __exit__(self, _: object, error: BaseException | None, __: object) -> None:
        if self._hooks is not None:
            self._hooks.take_away()
        if isinstance(error, _UsedUp):
            raise error.error from None


class _Hooks:
    """The hooks of a block that is supervised. They go when its frame ends, also where an interrupt keeps the block from taking
    them away, and when there is no task any more."""

    __slots__ = ("_around", "_frame", "_left", "_profiler", "_report", "_tracer")

    def __init__(self, frame: FrameType) -> None:
        self._around, self._frame, self._left = copy_context(), frame, CALLS_BETWEEN_CHECKS
        self._profiler, self._tracer, self._report = sys.getprofile(), sys.gettrace(), sys.unraisablehook

    def put_in(self) -> None:
        """Look at the budget from now on."""
        sys.setprofile(self._look)
        sys.unraisablehook = self._report_others

    def take_away(self) -> None:
        """Put back what was there before; that which takes the others away comes last."""
        if sys.gettrace() == self._go_on:
            sys.settrace(self._tracer)
        if sys.unraisablehook == self._report_others:
            sys.unraisablehook = self._report
        if sys.getprofile() in (self._look, None):  # Python takes away one that raises
            _resume(self._profiler)

    def _look(self, frame: FrameType, event: str, _: object) -> None:
        self._left -= 1
        if frame is self._frame and event == "return":
            self.take_away()
        elif self._left < 0:
            self._left = CALLS_BETWEEN_CHECKS
            if not in_task():
                self.take_away()
            else:
                self._check(frame)

    def _check(self, frame: FrameType) -> None:
        try:
            self._around.run(check_budget)
        except ModelLimitError as error:
            if not _imports(frame):
                sys.settrace(self._go_on)
                raise _UsedUp(error) from None

    def _go_on(self, _: FrameType, __: str, ___: object) -> None:
        """Put the hook back, at the next call: Python takes away one that raises."""
        sys.settrace(self._tracer)
        sys.setprofile(self._look)

    def _report_others(self, swallowed: sys.UnraisableHookArgs) -> None:
        if not isinstance(swallowed.exc_value, _UsedUp):
            self._report(swallowed)


def _resume(profiler: object) -> None:
    """Let the profiler go on that was at work before; one written in C, as `cProfile` is, is no function that could be set."""
    sys.setprofile(profiler if callable(profiler) else None)
    if hasattr(profiler, "enable"):
        profiler.enable()


def _imports(frame: FrameType | None) -> bool:
    """Whether a module is being imported: if it were given up half-way, it could never be used."""
    while frame is not None:
        if frame.f_code.co_filename.startswith("<frozen importlib"):
            return True
        frame = frame.f_back
    return False
