"""Hard limits of a command in a process of its own: what its budget cannot see ends all the same.

A command about one model has time and memory. What works on a folder of them has memory alone: each piece has its own time. The
laboratory runs other programs for as long as they are wanted, and has neither.
"""

from __future__ import annotations

import signal
from contextlib import suppress
from types import FrameType

from lsys_kit.budget import current

SECONDS, BYTES = 12, 8
"""These multiples of the kit's own limits: a command has several tasks, and libraries take memory to begin with."""
MERCY = 30
"""So many seconds of the processor after it was told so a process is ended that goes on."""
LASTING, UNLIMITED = frozenset({"site", "collect", "wall", "exercises"}), frozenset({"lab"})
"""The commands that have as much time as they need, and those that have memory, too."""


class UsedUp(BaseException):
    """The process has had its time; nothing takes this for an error of its own."""


def set_hard_limits(command: str) -> None:
    """Limit the processor time and the memory of this process, where the platform can, for a command.

    Raises
    ------
    UsedUp
        At any time later, from the time on that is the limit.
    """
    try:
        import resource
    except ImportError:  # as on Windows, and in a browser
        return
    if command not in UNLIMITED:
        _lower(resource.RLIMIT_DATA, most_bytes())
    if command not in LASTING | UNLIMITED:
        signal.signal(signal.SIGXCPU, _refuse)
        _lower(resource.RLIMIT_CPU, most_seconds(), MERCY)


def most_seconds() -> int:
    """The seconds of the processor that a command may take."""
    return round(SECONDS * current().seconds)


def most_bytes() -> int:
    """The bytes that a command may take."""
    return BYTES * current().bytes


def _lower(kind: int, most: int, more: int = 0) -> None:
    """Set a limit, unless a lower one is set already; from `more` beyond it on, there is no mercy."""
    import resource

    soft, hard = (
        new if old == resource.RLIM_INFINITY else min(new, old)
        for new, old in zip((most, most + more), resource.getrlimit(kind), strict=True)
    )
    with suppress(OSError, ValueError):  # a platform may have no such limit
        resource.setrlimit(kind, (soft, hard))


def _refuse(_: int, __: FrameType | None) -> None:
    raise UsedUp
