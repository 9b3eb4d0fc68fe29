"""Other libraries at work, which never look at the budget, under the budget of the present task."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from lsys_kit.budget import check_budget, in_task
from lsys_kit.errors import ModelLimitError

CALLS_BETWEEN_CHECKS = 500
"""The budget is checked after so many calls of functions that know nothing of budgets."""


class _UsedUp(BaseException):
    """The budget is used up; no library takes this for an error of its own."""

    def __init__(self, error: ModelLimitError) -> None:
        super().__init__()
        self.error = error


@contextmanager
def supervised() -> Iterator[None]:
    """A `with` block in which another library works, which never looks at the budget: it is looked at whenever a function is
    called there.

    It works in the same thread, since a process of its own would not do everywhere: where one starts, it runs the person's
    program again, unless that is written for it, and in a browser there are none.

    An error may be swallowed there, as in a finalizer, or by the garbage collector; then it is raised again, but not so soon
    that what is put in order on the way out is disturbed. Nothing is printed of the one that was swallowed.
    """
    left, before, tracer, report = CALLS_BETWEEN_CHECKS, sys.getprofile(), sys.gettrace(), sys.unraisablehook
    if not in_task():
        yield
        return

    def look(frame: FrameType, _: str, __: Any) -> None:
        nonlocal left
        left -= 1
        if left < 0:
            left = CALLS_BETWEEN_CHECKS
            try:
                check_budget()
            except ModelLimitError as error:
                if not _imports(frame):
                    sys.settrace(go_on)
                    raise _UsedUp(error) from None

    def go_on(_: FrameType, __: str, ___: Any) -> None:
        """Put the hook back, at the next call: Python takes away one that raises."""
        sys.settrace(tracer)
        sys.setprofile(look)

    def report_others(swallowed: sys.UnraisableHookArgs) -> None:
        if not isinstance(swallowed.exc_value, _UsedUp):
            report(swallowed)

    sys.unraisablehook = report_others
    sys.setprofile(look)
    try:
        yield
    except _UsedUp as used_up:
        raise used_up.error from None
    finally:
        _resume(before)
        sys.unraisablehook = report
        if sys.gettrace() is go_on:
            sys.settrace(tracer)


def _resume(profiler: Any) -> None:
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
